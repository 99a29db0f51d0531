//! One packing of a scene by DEM, and what is recorded of it: T around the probes, and averages over windows.

use super::plan::{Plan, PlannedScene};
use msdd_case::packing::{Packing, Spread};
use msdd_dem::Simulation;
use msdd_dem_reference::model::{Model, pack, statistics};
use msdd_dem_reference::observe::{MARGIN, PROBE_WINDOW, mean_temperature};
use msdd_dem_reference::results::Table;
use msdd_dem_reference::run::Watch;
use msdd_dem_reference::{ReferenceError, RunSpec, run};
use msdd_files::{Column, read_text};
use msdd_rve::{Averages, window};
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::time::Duration;

/// Least side of a window in mean radii: about 70 discs.
const WINDOW: f64 = 16.0;

pub const PROBE_COLUMNS: [Column; 5] = [
    ("time", "s", "time"),
    ("probe", "-", "number of the probe, from 0"),
    ("x", "m", "its place along x"),
    ("y", "m", "its place along y"),
    ("T", "K", "mean temperature over a square of eight mean radii around it, weighted by mass"),
];
pub const WINDOW_COLUMNS: [Column; 15] = [
    ("time", "s", "time"),
    ("x_window", "-", "number of the window along x, from 0"),
    ("y_window", "-", "number of the window along y, from 0"),
    ("x", "m", "its centre along x"),
    ("y", "m", "its centre along y"),
    ("T", "K", "mean temperature of the discs with their centre in it, weighted by mass"),
    ("porosity", "-", "porosity, overlaps counted once"),
    ("fabric_index", "-", "F_xx - F_yy"),
    ("pressure", "Pa", "(stress_xx + stress_yy)/2"),
    ("stress_xx", "Pa", "stress along x"),
    ("stress_yy", "Pa", "stress along y"),
    ("conductivity_xx", "W/(m K)", "conductivity along x, network"),
    ("conductivity_yy", "W/(m K)", "conductivity along y, network"),
    ("displacement_x", "m", "mean displacement along x of the discs that were in it at the start"),
    ("displacement_y", "m", "the same along y"),
];
pub const PACKING_COLUMNS: [Column; 19] = [
    ("discs", "-", "number of discs"),
    ("width", "m", "width of the box"),
    ("height", "m", "height of the box"),
    ("mean_radius", "m", "mean radius, as in the plan"),
    ("temperature_range", "K", "highest less lowest temperature of the walls at any time and of the start"),
    ("steps", "-", "mechanical steps of the run; 0 where grains do not expand"),
    ("windows_x", "-", "number of windows along x"),
    ("windows_y", "-", "number of windows along y"),
    ("window_width", "m", "width of a window"),
    ("window_height", "m", "height of a window"),
    ("porosity", "-", "of the whole box before heating, overlaps counted once"),
    ("fabric_index", "-", "F_xx - F_yy of the whole box before heating"),
    ("pressure", "Pa", "of the whole box before heating"),
    ("stress_ratio", "-", "stress_xx/stress_yy of the whole box before heating"),
    ("conductivity_xx", "W/(m K)", "along x, of the whole box before heating, network"),
    ("conductivity_yy", "W/(m K)", "along y, of the whole box before heating, network"),
    ("coordination", "-", "contacts of a disc that has any, before heating"),
    ("rattlers", "-", "number of discs without contact, before heating"),
    ("end", "s", "end of the run"),
];

/// Results of one packing. SI units, compression positive.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneResults {
    pub seed: u64,
    pub packing: Table,
    pub probes: Table,
    pub windows: Table,
}

impl SceneResults {
    /// Reads a result file.
    ///
    /// # Errors
    /// [`ReferenceError::File`]; [`ReferenceError::Read`] when it is not a result file.
    pub fn read(file: &Path) -> Result<Self, ReferenceError> {
        serde_json::from_str(&read_text(file)?)
            .map_err(|error| ReferenceError::Read { file: file.to_path_buf(), problem: error.to_string() })
    }
}

fn table(columns: &[Column]) -> Table {
    Table::new(columns.iter().map(|(name, _, _)| (*name).to_string()).collect())
}

/// Packs the box of a scene.
///
/// # Errors
/// As [`pack`].
pub fn packed(scene: &PlannedScene, seed: u64, threads: usize) -> Result<Simulation, ReferenceError> {
    let Model { simulation, .. } = pack(scene.spec(seed)?, &scene.case()?, threads, |_| ())?;
    Ok(simulation)
}

/// Simulates a scene from a packed box to its end.
///
/// # Errors
/// As [`run`](run::run); [`ReferenceError::Watch`] when a recorded number is not finite.
pub fn simulate(
    plan: &Plan,
    scene: &PlannedScene,
    start: &Simulation,
    seed: u64,
    threads: usize,
) -> Result<SceneResults, ReferenceError> {
    let case = scene.case()?;
    let spec = RunSpec {
        seed,
        end: scene.end,
        interval: scene.end / plan.outputs as f64,
        profiles: plan.outputs + 1,
        time_step: None,
        threads,
        checkpoint_every: Duration::MAX,
    };
    let conductivity = scene.thermal_conductivity;
    let probe_window = PROBE_WINDOW * scene.mean_radius;
    let windows = Windows::of(scene, start);
    let (mut probes, mut rows) = (table(&PROBE_COLUMNS), table(&WINDOW_COLUMNS));
    let mut watch = Watch {
        progress: &mut |_| (),
        profile: &mut |times, simulation| {
            let time = times[times.len() - 1];
            for (k, &at) in case.probes.iter().enumerate() {
                let corner = |side: f64| at.map(|x| x + side * 0.5 * probe_window);
                let temperature = mean_temperature(simulation, corner(-1.0), corner(1.0));
                probes.push(vec![time, k as f64, at[0], at[1], temperature]);
            }
            windows.rows(simulation, time, conductivity).into_iter().for_each(|row| rows.push(row));
            Ok(())
        },
        save: &mut |_| Ok(()),
    };
    // No checkpoint is written, since such a run takes less than a minute.
    let results = run(&case, start, &spec, Path::new(""), &mut watch)?;
    let model = statistics(start);
    let mut packing = table(&PACKING_COLUMNS);
    let [nx, ny] = windows.count;
    let side = windows.side();
    packing.push(vec![
        start.discs.len() as f64,
        case.size[0],
        case.size[1],
        case.mean_radius,
        case.temperature_range(),
        results.steps as f64,
        nx as f64,
        ny as f64,
        side[0],
        side[1],
        model.porosity,
        model.fabric_index,
        model.pressure,
        model.stress_ratio,
        conductivity * model.conductivity_network[0],
        conductivity * model.conductivity_network[1],
        model.coordination,
        model.rattlers as f64,
        scene.end,
    ]);
    let all = [&packing, &probes, &rows];
    if all.iter().any(|table| table.rows.iter().flatten().any(|value| !value.is_finite())) {
        let problem = format!("scene {}, seed {seed}: a recorded number is not finite", scene.name);
        return Err(ReferenceError::Watch(problem));
    }
    Ok(SceneResults { seed, packing, probes, windows: rows })
}

/// Equal windows of the box without a margin of [`MARGIN`] mean radii along its walls, where grains are packed more loosely.
struct Windows {
    count: [usize; 2],
    low: [f64; 2],
    high: [f64; 2],
    /// Places of the discs at the start [m].
    start: Vec<[f64; 2]>,
}

impl Windows {
    /// The same windows for all packings of a scene.
    fn of(scene: &PlannedScene, start: &Simulation) -> Self {
        let margin = MARGIN * scene.mean_radius;
        let count = scene.size.map(|length| (((length - 2.0 * MARGIN) / WINDOW) as usize).max(1));
        let (low, high) = ([margin; 2], scene.box_size().map(|length| length - margin));
        Self { count, low, high, start: start.discs.iter().map(|disc| [disc.x, disc.y]).collect() }
    }

    /// Width and height of a window [m].
    fn side(&self) -> [f64; 2] {
        [0, 1].map(|k| (self.high[k] - self.low[k]) / self.count[k] as f64)
    }

    fn rows(&self, simulation: &Simulation, time: f64, conductivity: f64) -> Vec<Vec<f64>> {
        let side = self.side();
        let moved = self.displacement(simulation);
        let row = |k: usize| {
            let place = [k % self.count[0], k / self.count[0]];
            let corner = |shift: f64| [0, 1].map(|c| self.low[c] + (place[c] as f64 + shift) * side[c]);
            let (low, high, centre) = (corner(0.0), corner(1.0), corner(0.5));
            let a: Averages = window(simulation, low, high).averages;
            let temperature = mean_temperature(simulation, low, high);
            let mut row = vec![time, place[0] as f64, place[1] as f64, centre[0], centre[1], temperature];
            row.extend([a.porosity, a.fabric_index, a.pressure, a.stress_xx, a.stress_yy]);
            row.extend([a.conductivity_network_xx, a.conductivity_network_yy].map(|k| k * conductivity));
            row.extend(moved[k]);
            row
        };
        (0..self.count[0] * self.count[1]).map(row).collect()
    }

    /// Mean displacement [m] of the discs that were in each window at the start.
    fn displacement(&self, simulation: &Simulation) -> Vec<[f64; 2]> {
        let side = self.side();
        let mut sums = vec![([0.0; 2], 0.0f64); self.count[0] * self.count[1]];
        for (disc, start) in simulation.discs.iter().zip(&self.start) {
            let place = [0, 1].map(|k| ((start[k] - self.low[k]) / side[k]).floor());
            if (0..2).all(|k| place[k] >= 0.0 && place[k] < self.count[k] as f64) {
                let (sum, count) = &mut sums[place[0] as usize + self.count[0] * place[1] as usize];
                sum[0] += disc.x - start[0];
                sum[1] += disc.y - start[1];
                *count += 1.0;
            }
        }
        sums.into_iter().map(|(sum, count)| sum.map(|u| u / count.max(1.0))).collect()
    }
}

/// The packed box as the initial packing of a new case; the scatter between boxes is not known.
pub fn packing_of(scene: &PlannedScene, start: &Simulation) -> Result<Packing, ReferenceError> {
    let model = statistics(start);
    let one = |mean: f64| Spread { mean, deviation: 0.0 };
    let stress_yy = 2.0 * model.pressure / (1.0 + model.stress_ratio);
    Ok(Packing {
        boxes: 1,
        grains: start.discs.len(),
        compression: scene.scene(model.porosity)?.compression,
        porosity: one(model.porosity),
        fabric_index: one(model.fabric_index),
        stress: [one(stress_yy * model.stress_ratio), one(stress_yy)],
        pressure: one(model.pressure),
        conductivity: one(0.5 * (model.conductivity_network[0] + model.conductivity_network[1])),
    })
}
