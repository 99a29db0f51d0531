//! Checks one bed: a whole case of `msddFoam`, or a region of a case of several.

use super::domain::Mesh;
use super::fields::{self, FIELDS};
use super::files::{self, Files};
use super::finding::Findings;
use super::start::Start;
use super::temperatures::{self, Temperatures};
use super::{
    conditions, control, domain, gas, grains, gravity, held, keys, probes, scales, sizes, sources, spheres,
    state, tables, walls, weight, zones,
};
use crate::dictionary::Dictionary;
use crate::grains::Grains;
use msdd_surrogate::spheres::model::NAMES;
use std::path::Path;

/// Path of the thermo of a bed that is a region of OpenFOAM's own solvers.
pub const THERMO: &str = "constant/thermophysicalProperties";

/// Checks grains, fields and their state; paths in the findings are those of a case of `msddFoam` that begins at time 0. `region`: its
/// name, empty in such a case.
pub fn check(
    [folder, region]: [&Path; 2],
    files: &Files,
    mesh: &Mesh,
    (times, start): (Option<control::Times>, &Start),
    found: &mut Findings,
) {
    let file = |name: &str| files::file(files, name);
    let properties = file(grains::FILE);
    let model = properties.and_then(|properties| grains::check(folder, properties, &mesh.names(), found));
    let columns: Vec<String> = match (properties, &model) {
        (Some(properties), _) if spheres::are_meant(properties) => {
            NAMES.iter().map(|name| grains::field_name(name)).collect()
        }
        // Beside porosity and fabricIndex, which are always there
        (_, Some(model)) => model.state_names().iter().skip(2).map(|name| grains::field_name(name)).collect(),
        _ => Vec::new(),
    };
    // Also of fields that were mapped, or copied from a later time
    let restarted = start.restarted || start.has_state(folder, region, &columns);
    if let Some(properties) = properties {
        let stress = (!restarted).then(|| file("0/stress").is_some());
        gravity::check(properties, file(gravity::FILE), stress, found);
    }
    let values = FIELDS
        .each_ref()
        .map(|field| file(field.file).and_then(|dictionary| fields::check(field, dictionary, mesh, found)));
    let [temperature, porosity, fabric_index, conductivity, stress] = &values;
    if let Some(properties) = properties {
        // After a restart the state of the grains does not follow from these
        let start = if restarted { [None, None] } else { [porosity.as_ref(), stress.as_ref()] };
        spheres::check(folder, properties, mesh, start, found);
        walls::check(properties, mesh, found);
        walls::check_pressures(properties, times, found);
        held::check(properties, mesh, found);
        if let Some(gravity) = file(gravity::FILE) {
            weight::check(properties, gravity, mesh, start, found);
        }
    }
    for name in [grains::FILE, "0/T"] {
        file(name).into_iter().for_each(|dictionary| tables::check(name, dictionary, found));
    }
    if let Some(temperature) = file("0/T") {
        let alone = file(THERMO).is_none();
        // Those of function objects are loaded after T is read
        let closed = alone && file(control::CONTROL).is_some_and(|control| control.get_any("libs").is_none());
        conditions::check(temperature, mesh, [alone, closed], found);
    }
    sources::check(files, mesh, file(THERMO).is_none(), found);
    if let Some(control) = file(control::CONTROL) {
        zones::check(control::CONTROL, control, mesh, found);
        probes::check(control, file(domain::BLOCKS), mesh, found);
    }
    if let Some(properties) = properties {
        sizes::check(properties, found);
        if let Some(sources) = sources::of(files) {
            sizes::check_sources(sources, properties, mesh, times.map(|times| times.end), found);
        }
    }
    let sources = sources::of(files).map(|(_, sources)| sources);
    let scene = scales::Scene::new(file("0/T"), temperature.as_ref(), sources, mesh, times);
    scene.check_walls(found);
    if let Some(properties) = properties {
        let (walls, heated) = (scene.wall_temperatures().collect(), scene.is_heated());
        let temperatures = Temperatures { start: temperature.as_ref(), walls, heated };
        temperatures::check(properties, &temperatures, found);
        gas::check(properties, &temperatures, found);
        gas::check_range(properties, &temperatures, scene.walls(), found);
        gas::check_pressure(properties, &temperatures, found);
    }
    if restarted {
        return;
    }
    let grains = properties.and_then(numbers);
    if let (Some(grains), Some(porosity), Some(fabric_index)) = (grains, porosity, fabric_index) {
        // Of discs: what a mesh for spheres may be is looked at with their law
        if !properties.is_some_and(spheres::are_meant) {
            scene.check_cells(&grains, porosity.mean(0), found);
        }
        let (conductivity, stress) = (conductivity.as_ref(), stress.as_ref());
        let start = state::Start { porosity, fabric_index, conductivity, stress };
        if let (Some(model), Some(properties)) = (&model, properties) {
            let bed = state::check(model.as_ref(), &start, &grains, properties, found);
            scene.check_strains(&grains, &bed, found, |strain, found| {
                state::walk(model.as_ref(), &start, &grains, strain, found);
            });
            scene.check_times(&bed, found);
        }
    }
}

/// The six properties of the grains, if all are valid.
fn numbers(file: &Dictionary) -> Option<Grains> {
    let value = |key: &str| keys::size(file, key);
    let grains = Grains {
        density: value("density")?,
        young_modulus: value("youngModulus")?,
        thermal_conductivity: value("thermalConductivity")?,
        heat_capacity: value("heatCapacity")?,
        thermal_expansion: value("thermalExpansion")?,
        mean_radius: value("meanRadius")?,
    };
    grains.check().ok().map(|()| grains)
}
