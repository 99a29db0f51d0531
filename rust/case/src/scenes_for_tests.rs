//! Scenes that tests change, and how they look at what is made of them.

use crate::CaseError;
use crate::disc_model::DiscModel;
use crate::folder::File;
use crate::grains::Grains;
use crate::material::{OF_DISCS, OF_SPHERES, Values};
use crate::packing::InitialPacking;
use crate::scene::{DiscCase, Mechanics, parse_wall, proposed_cells, proposed_probes};
use crate::spheres::material::Spheres;
use crate::spheres::scene::{Lid, SphereCase};
use crate::spheres::shape::Shape;
use crate::spheres::wall;
use crate::walls::WallOverTime;
use msdd_beds::case::GasKeys;
use msdd_beds::named_gases::GasName;
use msdd_rve::Compression;

/// The grains of a named material of discs.
pub fn disc(number: usize) -> Grains {
    OF_DISCS[number].grains(&Values::default()).expect("a shipped material")
}

/// The spheres of the first material.
pub fn steel() -> Spheres {
    let steel = &OF_SPHERES[0];
    Spheres::of(steel, steel.grains(&Values::default()).expect("all values")).expect("all values")
}

pub fn walls<const N: usize>(texts: [&str; N]) -> [WallOverTime; N] {
    texts.map(|text| parse_wall(text).unwrap())
}

pub fn discs() -> DiscCase {
    let size = [0.2, 0.1];
    DiscCase {
        size,
        cells: proposed_cells(size, 1e-3),
        walls: walls(["350", "insulated", "0:293,60:350", "insulated"]),
        initial_temperature: 293.15,
        material: "steel".to_string(),
        grains: disc(1),
        model: DiscModel::shipped().unwrap(),
        start: InitialPacking::Porosity(0.125),
        compression: Compression::Horizontal,
        mechanics: Mechanics::Equilibrium,
        heat_source: None,
        end_time: 60.0,
        tolerance: None,
        steady: false,
        probes: proposed_probes(size),
    }
}

pub fn spheres() -> SphereCase {
    SphereCase {
        shape: Shape::Cylinder { radius: 0.1, height: 0.4 },
        cells: vec![10, 24],
        walls: walls(["400", "293", "insulated"]).to_vec(),
        initial_temperature: 293.0,
        material: "steel".to_string(),
        spheres: steel(),
        gas: GasKeys::new(GasName::Helium, 1e5),
        flow: None,
        porosity: 0.4,
        pressure: 2e4,
        mechanics: Mechanics::Equilibrium,
        lid: Lid::Presses,
        shell: None,
        slack_layer: 0.0,
        wall_friction: 0.0,
        wall_material: Some(wall::MATERIALS[0]),
        gravity: 0.0,
        heat_source: None,
        end_time: 1e4,
        tolerance: None,
        steady: false,
        probes: vec![vec![0.05, 0.2]],
    }
}

/// A change of a scene, and how the message begins that refuses it.
pub type Wrong<'a, S> = (fn(&mut S), &'a str);

pub fn each_is_refused<S: Clone>(scene: &S, check: fn(&S) -> Result<(), CaseError>, wrong: &[Wrong<S>]) {
    check(scene).unwrap();
    for (change, message) in wrong {
        let mut changed = scene.clone();
        change(&mut changed);
        let error = check(&changed).unwrap_err().to_string();
        assert!(error.starts_with(message), "{error}");
    }
}

pub fn text<'a>(files: &'a [File], path: &str) -> &'a str {
    files.iter().find(|file| file.path == path).map_or("", |file| &file.text)
}
