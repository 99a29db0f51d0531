//! `msdd rve` with boxes of spheres.

use super::arguments::{ExpandArguments, PackArguments, strains};
use crate::error::CliError;
use crate::named;
use crate::output::print_json;
use msdd_beds::sizes::Moments;
use msdd_beds::vtk;
use msdd_files::{check_target, write};
use msdd_rve::database::spheres::SphereCompression;
use msdd_rve::last_good::{self, LastGoodError};
use msdd_rve::spheres::{Averages, Preparation, Strain, advance, averages, prepare, state};
use msdd_rve::{Relaxation, Settled};
use msdd_spheres::Simulation;
use serde_json::json;
use std::path::{Path, PathBuf};

/// Pressures over that which was asked for that need no word.
const NEAR: [f64; 2] = [0.8, 1.25];

pub fn pack(arguments: &PackArguments, count: usize) -> Result<(), CliError> {
    let compression: SphereCompression = named::read(&arguments.compression).map_err(|_| {
        CliError::Message("--compression: allowed: isotropic, uniaxial, sheared for spheres".to_string())
    })?;
    let of = &arguments.of_spheres;
    let preparation = Preparation {
        spheres: count,
        seed: arguments.seed,
        sizes: of.sizes.clone(),
        poisson_ratio: of.poisson_ratio,
        restitution: of.restitution,
        packing_friction: of.packing_friction.unwrap_or(of.friction),
        friction: of.friction,
        rates: compression.rates(),
        shaking: of.shaking,
        pressure: of.pressure,
    };
    let prepared = prepare(&preparation).map_err(|error| CliError::Message(error.to_string()))?;
    write_state(&arguments.out, &prepared.simulation)?;
    series(arguments.vtk.as_deref(), 0, &prepared.simulation)?;
    let averages = averaged(&prepared.simulation)?;
    if let Some(sizes) = &of.sizes {
        outln!("{}", Moments::new(Some(sizes), count));
    }
    report("packed", &prepared.rest, &averages);
    let (asked, reached) = (arguments.of_spheres.pressure, averages.pressure());
    if !(NEAR[0]..=NEAR[1]).contains(&(reached / asked)) {
        outln!(
            "The requested pressure was {asked:e} E* and is {reached:.2e} E*: so near to where contacts open, boxes of {count} spheres come to rest at \
             others. More spheres, or a higher pressure, are met better."
        );
    }
    Ok(())
}

pub fn expand(arguments: &ExpandArguments, mut simulation: Simulation) -> Result<(), CliError> {
    check_target(&arguments.out)?;
    let only_discs =
        [("rate", arguments.rate.is_some()), ("relaxation fire", arguments.relaxation == Relaxation::Fire)];
    if let Some((name, _)) = only_discs.into_iter().find(|(_, given)| *given) {
        return Err(CliError::Message(format!("--{name}: is for discs")));
    }
    averaged(&simulation)?;
    let folder = arguments.vtk.as_deref();
    series(folder, 0, &simulation)?;
    let mut here = Strain::default();
    for (number, [thermal, xx, yy, zz, xy, xz, yz]) in (1..).zip(strains(arguments)?) {
        let target = Strain { thermal, stretch: [xx, yy, zz, xy, xz, yz] };
        if target.largest().is_nan() || target.largest() > LARGEST_STRAIN {
            let text = format!("stop {number}: {target:?}, allowed: -{LARGEST_STRAIN} to {LARGEST_STRAIN}");
            return Err(CliError::Message(text));
        }
        let mut next = simulation.clone();
        let rest = advance(&mut next, here.to(target)).map_err(|failure| {
            let text = match keep(&arguments.out, &simulation) {
                Ok(file) => format!("the last good state, before stop {number}, is in {}", file.display()),
                Err(error) => format!("its last good state cannot be written: {error}"),
            };
            CliError::Message(format!("{failure}; {text}"))
        })?;
        (simulation, here) = (next, target);
        series(folder, number, &simulation)?;
        let what = format!("strain {thermal:+}, box {xx:+} {yy:+} {zz:+} {xy:+} {xz:+} {yz:+}");
        report(&what, &rest, &averaged(&simulation)?);
    }
    write_state(&arguments.out, &simulation)
}

/// Writes the last good state of a failed run next to `out`.
fn keep(out: &Path, simulation: &Simulation) -> Result<PathBuf, LastGoodError> {
    last_good::write_text(out, &state::to_file(simulation)?)
}

/// Largest strain of a stop.
const LARGEST_STRAIN: f64 = 0.2;

pub fn homogenise(simulation: &Simulation) -> Result<(), CliError> {
    let a = averaged(simulation)?;
    let tensor = |[xx, yy, zz, xy, xz, yz]: [f64; 6]| json!({"xx": xx, "yy": yy, "zz": zz, "xy": xy, "xz": xz, "yz": yz});
    let [low, middle, high] = a.gas_conductivity;
    print_json(&json!({
        "solid_fraction": a.solid_fraction,
        "coordination": a.coordination,
        "backbone_coordination": a.backbone_coordination,
        "rattlers": a.rattlers,
        "neighbours": a.neighbours,
        "fabric": tensor(a.fabric),
        "stress": tensor(a.stress),
        "pressure": a.pressure(),
        "contact_conductivity": tensor(a.contact_conductivity),
        "gas_conductivity": {"3.5": low, "6.0": middle, "8.5": high},
        "unbalanced": msdd_rve::spheres::follow::unbalanced_force(simulation),
    }))
}

fn averaged(simulation: &Simulation) -> Result<Averages, CliError> {
    let none = "averages are of periodic boxes of spheres whose contacts conduct heat through all of it";
    averages(simulation).ok_or_else(|| CliError::Message(none.to_string()))
}

fn write_state(path: &Path, simulation: &Simulation) -> Result<(), CliError> {
    let failed = |source| CliError::State { file: path.to_path_buf(), source };
    Ok(write(path, state::to_file(simulation).map_err(failed)?.as_bytes())?)
}

/// Writes the file of a stop for ParaView, which takes numbered files for a series.
fn series(folder: Option<&Path>, number: usize, simulation: &Simulation) -> Result<(), CliError> {
    let Some(folder) = folder else { return Ok(()) };
    let file = folder.join(format!("spheres_{number:04}.vtp"));
    Ok(write(&file, vtk::grains(simulation, &[]).as_bytes())?)
}

/// Prints one line about a state.
fn report(what: &str, rest: &Settled, a: &Averages) {
    let mean = |tensor: [f64; 6]| (tensor[0] + tensor[1] + tensor[2]) / 3.0;
    outln!(
        "{what}: {} after {} steps, solid fraction {:.4}, coordination {:.3}, pressure/E* {:.4e}, K by contacts/k_s {:.5}, \
         K by gas/k_g {:.3}",
        rest.outcome,
        rest.steps,
        a.solid_fraction,
        a.coordination,
        a.pressure(),
        mean(a.contact_conductivity),
        a.gas_conductivity[2]
    );
}
