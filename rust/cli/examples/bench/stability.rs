//! `bench stability`: the largest stable time steps, predicted and measured.

use clap::Args;
use msdd_cli::shared::CliError;
use msdd_dem::{Simulation, Thermal, WallHeat};
use msdd_rve::{Compression, Material, PackingSpec, pack};
use serde_json::{Value, json};

#[derive(Args)]
#[command(
    after_help = "Mechanical: the packing is shaken a little and runs 4000 steps; a step counts as unstable when the \
kinetic energy ends above a thousand times that of the shake. Thermal: one disc in two is heated by 1 K and heat \
flows for 4000 sub-steps; unstable when a temperature leaves the range of discs and walls by 10 K. Both limits by \
bisection. Prints them [s] as JSON: predicted, measured."
)]
pub struct Arguments {
    /// Porosities to pack 500 discs to, with commas between. Allowed: 0.01 to 0.3.
    #[arg(long, value_delimiter = ',', default_values_t = [0.06, 0.09, 0.12, 0.17])]
    porosity: Vec<f64>,
}

const STEPS: u64 = 4000;
/// The measured limit is sought between these factors times the predicted one, by so many bisections.
const FACTORS: [f64; 2] = [0.5, 2.0];
const BISECTIONS: u32 = 6;

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let rows = arguments.porosity.iter().map(|&porosity| {
        let (discs, compression) = (500, Compression::Isotropic);
        let spec = PackingSpec { discs, seed: 1, porosity, compression, ..PackingSpec::default() };
        Ok(row(porosity, &pack(&spec, &Material::default())?.simulation))
    });
    println!("{:#}", Value::Array(rows.collect::<Result<_, CliError>>()?));
    Ok(())
}

/// Predicted and measured limits [s].
fn row(porosity: f64, simulation: &Simulation) -> Value {
    let mechanical = simulation.stable_step();
    let mechanical_ratio = largest_factor(|factor| shaken_is_stable(simulation, factor * mechanical));
    let mut warm = simulation.clone();
    if warm.heat().is_none() {
        warm.enable_heat(Thermal { expansion: 0.0, ..Thermal::default() }, [WallHeat::Insulated; 4]);
    }
    (0..200).for_each(|_| warm.conduct(1e-9)); // lets the power iteration converge
    let thermal = warm.heat().map_or(f64::NAN, |heat| heat.stable_step());
    let thermal_ratio = largest_factor(|factor| heat_is_stable(&warm, factor * thermal));
    json!({
        "porosity": porosity,
        "mechanical": [mechanical, mechanical * mechanical_ratio],
        "thermal": [thermal, thermal * thermal_ratio],
    })
}

/// The largest factor that is stable, by bisection between [`FACTORS`].
fn largest_factor(stable: impl Fn(f64) -> bool) -> f64 {
    let [mut low, mut high] = FACTORS;
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if stable(middle) { low = middle } else { high = middle }
    }
    low
}

fn kinetic_energy(simulation: &Simulation) -> f64 {
    simulation.discs.iter().map(|d| 0.5 * d.mass * (d.vx * d.vx + d.vy * d.vy)).sum()
}

fn shaken_is_stable(start: &Simulation, step: f64) -> bool {
    let mut simulation = start.clone();
    for (k, disc) in simulation.discs.iter_mut().enumerate() {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        disc.vx += 1e-4 * sign;
        disc.vy += 1e-4;
    }
    let shake = kinetic_energy(&simulation);
    simulation.time_step = step;
    (0..STEPS / 100).all(|_| {
        simulation.take_steps(100);
        kinetic_energy(&simulation) < 1e3 * shake // false for NaN, too
    })
}

fn heat_is_stable(start: &Simulation, step: f64) -> bool {
    let mut simulation = start.clone();
    for disc in simulation.discs.iter_mut().step_by(2) {
        disc.temperature += 1.0;
    }
    let walls = simulation.heat().map_or([WallHeat::Insulated; 4], |heat| heat.walls);
    let fixed = walls.iter().filter_map(|wall| match wall {
        WallHeat::Temperature(temperature) => Some(*temperature),
        _ => None,
    });
    let all = simulation.discs.iter().map(|d| d.temperature).chain(fixed);
    let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), t| (l.min(t), h.max(t)));
    (0..STEPS).for_each(|_| simulation.conduct_once(step));
    simulation.discs.iter().all(|d| (low - 10.0..high + 10.0).contains(&d.temperature))
}
