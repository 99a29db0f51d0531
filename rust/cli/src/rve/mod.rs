//! `msdd rve`: single RVEs, of discs and (module [`spheres`]) of spheres. The state file says which it has.

mod arguments;
mod spheres;

use crate::error::CliError;
use crate::named;
use crate::output::print_json;
use arguments::{ExpandArguments, HomogeniseArguments, PackArguments, strains};
use clap::Subcommand;
use msdd_files::{check_target, read_text, write};
use msdd_rve::{
    Averages, Material, PackingSpec, Preparation, Protocol, RegionKind, RveError, Settled, Simulation,
    Strains, follow, homogenise_in, last_good, pack_watched, region, state, unbalanced_force, vtk,
};
use serde_json::json;
use std::path::Path;

#[derive(Subcommand)]
pub enum Command {
    /// Pack random discs to a porosity, or spheres to a pressure, and let them come to equilibrium.
    Pack(PackArguments),
    /// Strain a packed state: expand or contract the grains, or deform the box.
    Expand(ExpandArguments),
    /// Print the averages of a state as JSON: of spheres the columns of their database, with stresses over E* and
    /// conductivities over solid and gas.
    Homogenise(HomogeniseArguments),
    /// Draw the grains of a state and the forces between them as SVG, alone or next to a field of the solver.
    Draw(crate::draw::Arguments),
}

pub fn run(command: &Command) -> Result<(), CliError> {
    match command {
        Command::Pack(arguments) => pack_one(arguments),
        Command::Expand(arguments) => expand_one(arguments),
        Command::Homogenise(arguments) => homogenise_one(arguments),
        Command::Draw(arguments) => crate::draw::run(arguments),
    }
}

/// What a state file has.
enum Assembly {
    Discs(Simulation),
    Spheres(msdd_spheres::Simulation),
}

/// Reads a state file of discs or of spheres.
fn read_either(path: &Path) -> Result<Assembly, CliError> {
    let failed = |source| CliError::State { file: path.to_path_buf(), source };
    let text = read_text(path)?;
    match state::dimension(&text).map_err(failed)? {
        3 => msdd_rve::spheres::state::from_json(&text).map(Assembly::Spheres),
        _ => state::from_json(&text).map(Assembly::Discs),
    }
    .map_err(failed)
}

/// Reads a state file of discs.
pub fn read_state(path: &Path) -> Result<Simulation, CliError> {
    let failed = |source| CliError::State { file: path.to_path_buf(), source };
    state::from_json(&read_text(path)?).map_err(failed)
}

/// Writes a state file.
pub fn write_state(path: &Path, simulation: &Simulation) -> Result<(), CliError> {
    let failed = |source| CliError::State { file: path.to_path_buf(), source };
    Ok(write(path, state::to_file(simulation).map_err(failed)?.as_bytes())?)
}

/// Writes the last good state of a failed run next to `out`, and names it in the error.
fn failed(out: &Path, source: RveError, last_good: Option<&Simulation>) -> CliError {
    let Some(state) = last_good else { return CliError::Rve(source) };
    match last_good::write(out, state) {
        Ok(file) => CliError::Stopped { source, file, steps: state.steps, time: state.time },
        Err(error) => CliError::Message(format!("{source}; its last good state cannot be written: {error}")),
    }
}

fn pack_one(arguments: &PackArguments) -> Result<(), CliError> {
    check_target(&arguments.out)?;
    arguments.simd.apply()?;
    let porosity = match (arguments.of_spheres.spheres, arguments.porosity) {
        (Some(count), _) => return spheres::pack(arguments, count),
        (None, Some(porosity)) => porosity,
        (None, None) => return Err(CliError::Message("give --porosity, or --spheres".to_string())),
    };
    let spec = PackingSpec {
        discs: arguments.discs,
        seed: arguments.seed,
        porosity,
        compression: named::read(&arguments.compression).map_err(|_| {
            let allowed = "isotropic, horizontal, intermediate, sheared; uniaxial is for spheres";
            CliError::Message(format!("--compression: uniaxial, allowed: {allowed}"))
        })?,
        radius_min: arguments.radius_min,
        radius_max: arguments.radius_max,
        relaxation: arguments.relaxation,
        boundary: arguments.boundary,
    };
    let packed = pack_watched(&spec, &Preparation::default(), &Material::default())
        .map_err(|stopped| failed(&arguments.out, stopped.error, stopped.last_good.as_deref()))?;
    write_state(&arguments.out, &packed.simulation)?;
    write_vtk(arguments.vtk.as_deref(), &[0.0], &packed.simulation)?;
    report("packed", &packed.settled, &msdd_rve::homogenise(&packed.simulation, RegionKind::default()));
    Ok(())
}

fn expand_one(arguments: &ExpandArguments) -> Result<(), CliError> {
    check_target(&arguments.out)?;
    arguments.simd.apply()?;
    let mut simulation = match read_either(&arguments.state)? {
        Assembly::Discs(simulation) => simulation,
        Assembly::Spheres(simulation) => return spheres::expand(arguments, simulation),
    };
    if ![&arguments.zz, &arguments.xz, &arguments.yz].iter().all(|list| list.is_empty()) {
        return Err(CliError::Message("--zz, --xz, --yz: are for boxes of spheres".to_string()));
    }
    let path = path(arguments)?;
    let mut protocol = Protocol { relaxation: arguments.relaxation, ..Protocol::usual(&simulation) };
    if let Some(rate) = arguments.rate {
        (protocol.expansion_rate, protocol.contraction_rate) = (rate, rate);
    }
    let mut times = vec![0.0];
    let mut written = write_vtk(arguments.vtk.as_deref(), &times, &simulation);
    let ramp = follow(&mut simulation, &path, protocol, |stop, simulation| {
        times.push(times.len() as f64);
        if written.is_ok() {
            written = write_vtk(arguments.vtk.as_deref(), &times, simulation);
        }
        let Strains { thermal, xx, yy, xy } = stop.strains;
        let walls = if xx == 0.0 && yy == 0.0 { String::new() } else { format!(", walls {xx:+} {yy:+}") };
        let shear = if xy == 0.0 { String::new() } else { format!(", shear {xy:+}") };
        report(&format!("strain {thermal:+}{walls}{shear}"), &stop.settled, &stop.averages);
    })?;
    written?;
    match ramp.failure {
        Some(failure) => Err(failed(&arguments.out, failure, simulation.take_last_good().as_ref())),
        None => write_state(&arguments.out, &simulation),
    }
}

/// The strains of discs at the stops.
fn path(arguments: &ExpandArguments) -> Result<Vec<Strains>, CliError> {
    let of = |[thermal, xx, yy, _, xy, ..]: [f64; 7]| Strains { thermal, xx, yy, xy };
    Ok(strains(arguments)?.into_iter().map(of).collect())
}

/// Prints one line about a state.
fn report(what: &str, settled: &Settled, averages: &Averages) {
    outln!(
        "{what}: {} after {} steps, porosity {:.4}, fabric index {:+.4}, K/k {:.4} {:.4}, pressure {:.1} Pa, \
         coordination {:.2}, rattlers {}",
        settled.outcome,
        settled.steps,
        averages.porosity,
        averages.fabric_index,
        averages.conductivity_xx,
        averages.conductivity_yy,
        averages.pressure,
        averages.coordination,
        averages.rattlers
    );
}

fn homogenise_one(arguments: &HomogeniseArguments) -> Result<(), CliError> {
    let simulation = match read_either(&arguments.state)? {
        Assembly::Discs(simulation) => simulation,
        Assembly::Spheres(simulation) => return spheres::homogenise(&simulation),
    };
    let region = region::region(&simulation, arguments.region);
    let averages = homogenise_in(&simulation, &region, arguments.cut);
    let json = as_json(&averages, unbalanced_force(&simulation));
    print_json(&json)
}

/// The averages as JSON: conductivities over k; stresses in Pa, compression positive.
fn as_json(a: &Averages, unbalanced: f64) -> serde_json::Value {
    json!({
        "porosity": a.porosity,
        "porosity_sum_of_areas": a.porosity_sum_of_areas,
        "overlap_fraction": a.overlap_fraction,
        "fabric_index": a.fabric_index,
        "fabric_conductivity": a.fabric_conductivity,
        "conductivity": {"xx": a.conductivity_xx, "yy": a.conductivity_yy, "xy": a.conductivity_xy},
        "conductivity_network": {
            "xx": a.conductivity_network_xx, "yy": a.conductivity_network_yy, "xy": a.conductivity_network_xy
        },
        "stress": {"xx": a.stress_xx, "yy": a.stress_yy, "xy": a.stress_xy, "yx": a.stress_yx},
        "pressure": a.pressure,
        "coordination": a.coordination,
        "rattlers": a.rattlers,
        "contacts": a.contacts,
        "mean_radius": a.mean_radius,
        "unbalanced": unbalanced,
    })
}

/// Writes the state at the last of `times` \[s\], and the ParaView series file that lists all of them; without a folder, it writes nothing.
pub fn write_vtk(folder: Option<&Path>, times: &[f64], simulation: &Simulation) -> Result<(), CliError> {
    let Some(folder) = folder else { return Ok(()) };
    for (name, text) in [("particles", vtk::particles(simulation)), ("contacts", vtk::contacts(simulation))] {
        let file = |k: usize| format!("{name}_{k:04}.vtp");
        write(&folder.join(file(times.len() - 1)), text.as_bytes())?;
        let list: Vec<(f64, String)> = times.iter().enumerate().map(|(k, &time)| (time, file(k))).collect();
        write(&folder.join(format!("{name}.pvd")), vtk::series(&list).as_bytes())?;
    }
    Ok(())
}
