//! `bench dem`: time of a step of the discrete element engine; `cargo bench -p msdd-dem` has its stages.

use clap::Args;
use msdd_cli::shared::{CliError, SimdArgument, read_state};
use msdd_dem::{Thermal, WallHeat};
use msdd_rve::{Compression, Material, PackingSpec, Simulation, pack};
use serde_json::json;
use std::path::PathBuf;
use std::time::Instant;

#[derive(Args)]
#[command(
    after_help = "Each block of 500 steps starts from the given state and expands the grains at a strain rate of 0.1 1/s, so \
that steps are typical of a dense packing in motion. Without --state, 500 discs are packed isotropically to a porosity of 0.12 first."
)]
pub struct Arguments {
    /// State file to start from.
    #[arg(long, value_name = "FILE")]
    state: Option<PathBuf>,
    /// Steps to time.
    #[arg(long, default_value_t = 5000)]
    steps: u64,
    #[command(flatten)]
    simd: SimdArgument,
    /// Simulate heat conduction, too: the walls are 50 K hotter than the grains (Table 2 of the paper), whose expansion then
    /// follows from their temperatures.
    #[arg(long)]
    heat: bool,
}

/// Steps before the start state is taken again, so that the strain stays below 2 %.
const BLOCK: u64 = 500;
const STRAIN_RATE: f64 = 0.1;

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    arguments.simd.apply()?;
    let mut start = match &arguments.state {
        Some(path) => read_state(path)?,
        None => packed()?,
    };
    start.reset_strain();
    if arguments.heat {
        start.enable_heat(Thermal::default(), [WallHeat::Temperature(50.0); 4]);
    } else {
        start.set_strain_rate(STRAIN_RATE);
    }
    let particles = start.discs.len() as f64;
    let (mut seconds, mut best, mut done) = (0.0, f64::INFINITY, 0);
    while done < arguments.steps {
        let block = BLOCK.min(arguments.steps - done);
        let mut simulation = start.clone();
        let begin = Instant::now();
        simulation.take_steps(block);
        let elapsed = begin.elapsed().as_secs_f64();
        seconds += elapsed;
        best = f64::min(best, elapsed / block as f64);
        done += block;
    }
    let result = json!({
        "particles": start.discs.len(),
        "steps": arguments.steps,
        "simd": start.simd(),
        "ns_per_particle_step": 1e9 * seconds / (arguments.steps as f64 * particles),
        // Of the fastest block, the one that other programs have disturbed least.
        "ns_per_particle_step_best": 1e9 * best / particles,
    });
    println!("{result:#}");
    Ok(())
}

fn packed() -> Result<Simulation, CliError> {
    let compression = Compression::Isotropic;
    let spec = PackingSpec { discs: 500, seed: 1, porosity: 0.12, compression, ..PackingSpec::default() };
    Ok(pack(&spec, &Material::default())?.simulation)
}
