//! `msdd bench`: measures speed, stability limits and rates; prints JSON.

mod inference;
mod limits;
mod stability;

use crate::error::CliError;
use crate::rve::read_state;
use crate::simd::SimdArgument;
use clap::{Args, Subcommand};
use msdd_dem::{Stage, Thermal, WallHeat};
use msdd_rve::{Compression, Material, PackingSpec, Simulation, pack};
use serde_json::{Map, Value, json};
use std::path::PathBuf;
use std::time::Instant;

#[derive(Subcommand)]
pub enum Command {
    /// Time of a step of the discrete element engine, in all and by stage of the step.
    Dem(DemArguments),
    /// Largest stable mechanical and thermal time steps: predicted by the bounds, and measured.
    Stability(stability::Arguments),
    /// How slowly RVEs have to be packed and strained, how well forces have to balance, and how models follow as contacts open.
    Limits(limits::Arguments),
    /// Time that a surrogate model needs for a step of one cell, by size of the batch.
    Inference(inference::Arguments),
}

#[derive(Args)]
#[command(
    after_help = "Each block of 500 steps starts from the given state and expands the grains at a strain rate of 0.1 1/s, so \
that steps are typical of a dense packing in motion. Without --state, discs are packed isotropically to a porosity of 0.12 first."
)]
pub struct DemArguments {
    /// Discs to pack when no state is given. Allowed: 10 to 1000000.
    #[arg(long, default_value_t = 500)]
    particles: usize,
    /// State file to start from.
    #[arg(long, value_name = "FILE")]
    state: Option<PathBuf>,
    /// Steps to time. Allowed: ≥ 1.
    #[arg(long, default_value_t = 5000)]
    steps: u64,
    #[command(flatten)]
    simd: SimdArgument,
    /// Threads of the simulation; small packings use one all the same.
    #[arg(long, default_value_t = 1, value_parser = crate::threads::parser())]
    threads: u32,
    /// Simulate heat conduction, too: the walls are 50 K hotter than the grains (Table 2 of the paper), whose expansion then
    /// follows from their temperatures.
    #[arg(long)]
    heat: bool,
}

/// Steps before the start state is taken again, so that the strain stays below 2 %.
const BLOCK: u64 = 500;
const STRAIN_RATE: f64 = 0.1;

pub fn run(command: &Command) -> Result<(), CliError> {
    match command {
        Command::Dem(arguments) => dem(arguments),
        Command::Stability(arguments) => stability::run(arguments),
        Command::Limits(arguments) => limits::run(arguments),
        Command::Inference(arguments) => inference::run(arguments),
    }
}

fn dem(arguments: &DemArguments) -> Result<(), CliError> {
    arguments.simd.apply()?;
    let mut start = match &arguments.state {
        Some(path) => read_state(path)?,
        None => packed(arguments.particles)?,
    };
    start.reset_strain();
    if arguments.heat {
        start.enable_heat(Thermal::default(), [WallHeat::Temperature(50.0); 4]);
    } else {
        start.set_strain_rate(STRAIN_RATE);
    }
    let alone = start.clone();
    start
        .set_threads(arguments.threads as usize)
        .map_err(|error| CliError::Message(format!("--threads {}: {error}", arguments.threads)))?;
    let json = serde_json::to_string_pretty(&measure(&start, &alone, arguments.steps, arguments.threads));
    outln!("{}", json.map_err(|error| CliError::Message(error.to_string()))?);
    Ok(())
}

fn packed(discs: usize) -> Result<Simulation, CliError> {
    let compression = Compression::Isotropic;
    let spec = PackingSpec { discs, seed: 1, porosity: 0.12, compression, ..PackingSpec::default() };
    Ok(pack(&spec, &Material::default())?.simulation)
}

/// Takes `steps` steps from `start`; returns the seconds they took, and the end.
fn timed(start: &Simulation, steps: u64) -> (f64, Simulation) {
    let mut simulation = start.clone();
    let begin = Instant::now();
    simulation.take_steps(steps);
    (begin.elapsed().as_secs_f64(), simulation)
}

fn measure(start: &Simulation, alone: &Simulation, steps: u64, threads: u32) -> Value {
    let particles = start.discs.len() as f64;
    let (mut seconds, mut best, mut done, mut rebuilds) = (0.0, f64::INFINITY, 0, 0);
    let (mut gains, mut substeps) = (Vec::new(), 0);
    while done < steps {
        let block = BLOCK.min(steps - done);
        let (elapsed, end) = timed(start, block);
        seconds += elapsed;
        best = f64::min(best, elapsed * BLOCK as f64 / block as f64);
        rebuilds += end.rebuilds() - start.rebuilds();
        substeps += end.heat().map_or(0, |pipes| pipes.substeps);
        done += block;
        if threads > 1 {
            gains.push(timed(alone, block).0 / elapsed);
        }
    }
    gains.sort_by(f64::total_cmp);
    let mut contacts = 0u64;
    start.for_each_contact(|_| contacts += 1);
    let per_step = 1e9 * seconds / (steps as f64 * particles);
    json!({
        "particles": start.discs.len(),
        "contacts": contacts,
        "candidates": start.candidates(),
        "steps": steps,
        "threads": threads,
        "simd": start.simd(),
        "particle_steps_per_second": 1e9 / per_step,
        "ns_per_particle_step": per_step,
        // Of the fastest block, the one that other programs have disturbed least.
        "ns_per_particle_step_best": 1e9 * best / (BLOCK as f64 * particles),
        "ns_per_particle_step_by_stage": by_stage(start, steps.min(BLOCK)),
        "rebuilds": rebuilds,
        "heat_substeps": substeps,
        // Median over blocks; each is timed with all threads and then with one.
        "speed_over_one_thread": gains.get(gains.len() / 2),
    })
}

/// Time of the stages of a step [ns]. Measured in a separate run, because reading the clock in every stage takes time.
fn by_stage(start: &Simulation, steps: u64) -> Value {
    let mut nanoseconds = [0.0f64; Stage::ALL.len()];
    let mut simulation = start.clone();
    for _ in 0..steps {
        let mut last = Instant::now();
        simulation.step_marked(|stage| {
            let now = Instant::now();
            nanoseconds[stage as usize] += (now - last).as_nanos() as f64;
            last = now;
        });
    }
    let count = steps.max(1) as f64 * start.discs.len() as f64;
    let entry =
        |stage: &Stage| (format!("{stage:?}").to_lowercase(), json!(nanoseconds[*stage as usize] / count));
    Value::Object(Stage::ALL.iter().map(entry).collect::<Map<String, Value>>())
}
