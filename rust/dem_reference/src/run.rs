//! Runs a case from its start to its end: heat conduction, expansion and motion of the grains. When the grains do not
//! expand, they stay at rest and only heat is conducted through their contacts.

use crate::ReferenceError;
use crate::checkpoint::{Checkpoint, Records};
use crate::model::statistics;
use crate::observe::{
    GRAINS_WINDOW, PROBE_WINDOW, add_network, add_profile, displacements, grains, network_table,
    profile_table, series_columns, series_row, sub_regions,
};
use crate::results::{Properties, Results, SCHEMA, Table};
use msdd_case::Case;
use msdd_dem::time_step::SAFETY;
use msdd_dem::{Excess, Failure, Simulation, StepChoice, WallHeat};
use msdd_rve::state;
use std::path::Path;
use std::time::{Duration, Instant};

/// Steps after which the stable time step is computed again.
const RUN: u64 = 50;

/// How to run a case.
#[derive(Clone, Debug, PartialEq)]
pub struct RunSpec {
    pub seed: u64,
    /// End of the run \[s\]; usually that of the case.
    pub end: f64,
    /// Time between two rows of the time series \[s\].
    pub interval: f64,
    /// Number of profiles, evenly spaced over the run, the first at the start and the last at the end.
    pub profiles: usize,
    /// Largest mechanical time step \[s\], also when heat alone is conducted; `None`: that of the stability bound.
    pub time_step: Option<f64>,
    /// Number of threads; results do not depend on it.
    pub threads: usize,
    /// Least time between two checkpoints, of the clock.
    pub checkpoint_every: Duration,
}

impl RunSpec {
    fn check(&self) -> Result<(), ReferenceError> {
        let refuse = |key, value: f64, allowed: &str| {
            Err(ReferenceError::Parameter { key, value: value.to_string(), allowed: allowed.to_string() })
        };
        if !(self.end > 0.0 && self.end.is_finite()) {
            return refuse("end", self.end, "> 0 s");
        }
        if !(self.interval > 0.0 && self.interval <= self.end) {
            return refuse("interval", self.interval, "> 0 s and at most the end");
        }
        match self.time_step {
            Some(step) if !(step > 0.0 && step <= self.interval) => {
                refuse("time step", step, "> 0 s and at most the interval")
            }
            _ => Ok(()),
        }
    }

    /// Times of the series [s]: the start, then one every interval, and the end.
    fn times(&self) -> Vec<f64> {
        let count = (self.end / self.interval - 1e-9).ceil() as usize;
        (0..count).map(|k| k as f64 * self.interval).chain([self.end]).collect()
    }

    /// Whether a profile is recorded at time number `k` of `count`.
    fn has_profile(&self, k: usize, count: usize) -> bool {
        let parts = self.profiles.max(2) - 1;
        (0..=parts).any(|part| k == (part * (count - 1) + parts / 2) / parts)
    }
}

/// Called whenever a profile is recorded, with the times of the profiles so far \[s\] and the state.
pub type OnProfile<'a> = &'a mut dyn FnMut(&[f64], &Simulation) -> Result<(), ReferenceError>;

/// Functions that are called during a run.
pub struct Watch<'a> {
    /// Called from time to time with the simulated time \[s\].
    pub progress: &'a mut dyn FnMut(f64),
    pub profile: OnProfile<'a>,
    /// Writes the text of a checkpoint to its file.
    pub save: &'a mut dyn FnMut(&str) -> Result<(), ReferenceError>,
}

/// Runs a case from a packed box, or continues from the checkpoint when there is one.
///
/// # Errors
/// [`ReferenceError::Parameter`] for a value of `spec` that is out of range, [`ReferenceError::Checkpoint`],
/// [`ReferenceError::Failure`] when the simulation diverges or a given time step is too long.
pub fn run(
    case: &Case,
    start: &Simulation,
    spec: &RunSpec,
    checkpoint: &Path,
    watch: &mut Watch,
) -> Result<Results, ReferenceError> {
    spec.check()?;
    crate::model::check_state(start, case)?;
    let scale = start.walls.width() / case.size[0];
    let probes: Vec<[f64; 2]> = case.probes.iter().map(|at| at.map(|x| x * scale)).collect();
    let probe_window = PROBE_WINDOW * case.mean_radius;
    let asked = asked(case, start, spec);
    let (mut simulation, mut records) = match Checkpoint::read(checkpoint, &asked)? {
        Some(checkpoint) => resume(case, checkpoint)?,
        None => begin(case, start, probes.len()),
    };
    simulation.set_threads(spec.threads)?;
    let centres: Vec<[f64; 2]> = start.discs.iter().map(|d| [d.x, d.y]).collect();
    let times = spec.times();
    let mut saved = Instant::now();
    let mut profile_times: Vec<f64> = Vec::new();
    for (k, &time) in times.iter().enumerate() {
        let profile = spec.has_profile(k, times.len());
        if profile {
            profile_times.push(time);
        }
        if k < records.series.rows.len() {
            continue;
        }
        advance(&mut simulation, case, spec, time, watch)?;
        records.series.push(series_row(&simulation, &probes, probe_window));
        if profile {
            add_profile(&mut records.profiles, &simulation, &centres);
            add_network(&mut records.network, &simulation);
            (watch.profile)(&profile_times, &simulation)?;
        }
        if saved.elapsed() >= spec.checkpoint_every && k + 1 < times.len() {
            if let Some(text) = Checkpoint::text(&asked, &simulation, &records)? {
                (watch.save)(&text)?;
            }
            saved = Instant::now();
        }
    }
    Ok(Results {
        schema: SCHEMA.to_string(),
        case: case.name.clone(),
        seed: spec.seed,
        discs: start.discs.len(),
        properties: Some(Properties::of(case)),
        size: [start.walls.width(), start.walls.height()],
        grains: probes.get(1).map(|&at| {
            grains(start, case.initial_temperature, &simulation, at, GRAINS_WINDOW * case.mean_radius)
        }),
        displacement: Some(displacements(&simulation, &centres)),
        probes,
        probe_window,
        model: statistics(start),
        steps: simulation.steps,
        thermal_substeps: simulation.heat().map_or(0, |heat| heat.substeps),
        time_step: spec.time_step,
        speed_up: None,
        series: records.series,
        sub_regions_start: records.sub_regions_start,
        sub_regions_end: sub_regions(&simulation),
        profiles: records.profiles,
        network: records.network,
    })
}

/// Steps that the discs of a case take to its end, about: a quarter of the stability bound of a disc of mean radius with four
/// contacts, by which the cases of the paper are met within a few percent. 0 if nothing moves.
pub fn estimated_steps(case: &Case) -> f64 {
    if case.thermal.expansion == 0.0 {
        return 0.0;
    }
    let mass = std::f64::consts::PI * case.mean_radius * case.mean_radius * case.material.density;
    let bound = 2.0 / (8.0 * case.material.young_modulus * case.mean_radius / mass).sqrt();
    case.end_time / (0.25 * bound)
}

/// All parameters of a run in one line; a checkpoint with another line is refused.
fn asked(case: &Case, start: &Simulation, spec: &RunSpec) -> String {
    let mix =
        |sum: u64, d: &msdd_dem::Disc| sum.rotate_left(5) ^ d.x.to_bits() ^ d.y.to_bits().rotate_left(32);
    let place = start.discs.iter().fold(0, mix);
    format!(
        "case {} {:?} {:?} {:?} {} K, seed {}, places {place:016x}, end {}, interval {}, profiles {}, step {:?}",
        case.name,
        case.material,
        case.thermal,
        case.walls,
        case.initial_temperature,
        spec.seed,
        spec.end,
        spec.interval,
        spec.profiles,
        spec.time_step
    )
}

fn begin(case: &Case, start: &Simulation, probes: usize) -> (Simulation, Records) {
    let mut simulation = start.clone();
    simulation.discs.iter_mut().for_each(|disc| disc.temperature = case.initial_temperature);
    simulation.enable_heat(case.thermal, walls_at(case, 0.0));
    let records = Records {
        series: Table::new(series_columns(probes)),
        sub_regions_start: sub_regions(&simulation),
        profiles: profile_table(),
        network: network_table(),
    };
    (simulation, records)
}

fn resume(case: &Case, checkpoint: Checkpoint) -> Result<(Simulation, Records), ReferenceError> {
    let mut simulation = state::from_json(checkpoint.state.get())?;
    simulation.resume_heat(case.thermal, walls_at(case, simulation.time), checkpoint.heat);
    Ok((simulation, checkpoint.records))
}

/// Thermal boundary conditions of the walls at `time` [s].
fn walls_at(case: &Case, time: f64) -> [WallHeat; 4] {
    // Files with other conditions are refused
    std::array::from_fn(|side| case.walls[side].at(time).unwrap_or(WallHeat::Insulated))
}

/// Advances the simulation to exactly `time` [s]. A wall whose temperature changes has, during a block of steps, its
/// temperature at the middle of the block.
fn advance(
    simulation: &mut Simulation,
    case: &Case,
    spec: &RunSpec,
    time: f64,
    watch: &mut Watch,
) -> Result<(), ReferenceError> {
    if case.thermal.expansion == 0.0 {
        // Nothing moves, so the engine's thermal sub-steps are all that is needed.
        let way = time - simulation.time;
        let steps = spec.time_step.map_or(1.0, |step| (way / step - 1e-9).ceil()).max(1.0);
        for step in 0..steps as u64 {
            simulation.set_wall_heat(walls_at(case, simulation.time + (step as f64 + 0.5) * way / steps));
            simulation.conduct(way / steps);
        }
        simulation.time = time;
        (watch.progress)(time);
        return Ok(());
    }
    loop {
        let left = time - simulation.time;
        if left < 1e-9 {
            return Ok(());
        }
        let bound = simulation.stable_step();
        let limit = match spec.time_step {
            None => SAFETY * bound,
            Some(step) if step <= bound => step,
            Some(step) => return Err(Failure::TimeStep { step, bound, time: simulation.time }.into()),
        };
        // Equal steps that end exactly at `time`.
        let steps = (left / limit - 1e-9).ceil().max(1.0);
        simulation.choose_time_step(StepChoice::Fixed { step: left / steps, on_excess: Excess::Refuse })?;
        let now = (steps as u64).min(RUN);
        let middle = simulation.time + 0.5 * now as f64 * left / steps;
        simulation.set_wall_heat(walls_at(case, middle));
        simulation.run(now)?;
        (watch.progress)(simulation.time);
    }
}
