//! Converts results of `msdd bed run` to paths of strain, on which the law of spheres is fitted: beds that were poured, and whose strain is
//! known inside.

use super::same::SeenValues;
use crate::dem_start::{FirstRow, packings};
use crate::error::TrainingError;
use msdd_beds::case::{BedCase, FILE, file_in};
use msdd_beds::effective::BedMaterial;
use msdd_beds::packings::column;
use msdd_beds::sizes::equal_density;
use msdd_beds::solid::Solid;
use msdd_files::{list, read_text};
use msdd_spheres::law::effective_modulus;
use msdd_surrogate::spheres::tensor::Tensor;
use msdd_surrogate::spheres::tracks::{Point, Step, Track};
use std::f64::consts::PI;
use std::path::Path;

/// Kind of path of a bed.
const NAME: &str = "poured";
/// [`Track::weight`]: there are thirty beds compared with some three hundred and sixty boxes, and beds are what the law is for.
const WEIGHT: f64 = 5.0;
/// Columns of the strains, and of the state.
const STRAIN: [&str; 4] = ["thermal_strain", "strain_1", "strain_2", "strain_3"];
const STATE: [&str; 10] = [
    "porosity",
    "stress_1",
    "stress_2",
    "stress_3",
    "coordination",
    "fabric_1",
    "fabric_2",
    "fabric_3",
    "K_contacts",
    "K_gas",
];

/// The paths of all packings of the beds below a folder, and the text of their files. Packings are numbered on from `first`, by their
/// seeds: beds of one seed have the spheres at the same places before they are pressed.
///
/// # Errors
/// A folder without beds or results; results without strains; a bed whose conductivity by contacts is not that of the law; a bed of
/// another friction than `material`.
pub fn tracks(
    root: &Path,
    first: i64,
    material: &mut SeenValues,
) -> Result<(Vec<Track>, String), TrainingError> {
    let folders = list(root)?.into_iter().filter(|folder| file_in(folder).is_file());
    let (mut all, mut texts) = (Vec::new(), String::new());
    let mut seeds: Vec<u64> = Vec::new();
    for folder in folders {
        let scene = BedCase::read(&folder)?;
        // Beds differ from boxes in Poisson's ratio: their law is asked with stresses over E* of their own.
        material.agree(&file_in(&folder), [Some(scene.grains.friction), None])?;
        for (seed, file) in packings(&folder)? {
            let known = seeds.iter().position(|known| *known == seed).unwrap_or_else(|| {
                seeds.push(seed);
                seeds.len() - 1
            });
            let text = read_text(&file)?;
            check_spheres(&folder, &scene)?;
            all.push(track(&folder, &scene, &file, &text, first + known as i64)?);
            texts += &text;
        }
    }
    match all.is_empty() {
        true => Err(TrainingError::Data(format!(
            "{}: no folder with {FILE}, allowed: a folder of beds, each with results of 'msdd bed run --packings'",
            root.display()
        ))),
        false => Ok((all, texts)),
    }
}

/// Refuses beds whose spheres are unequal, or conduct in another way than those of the training.
fn check_spheres(folder: &Path, scene: &BedCase) -> Result<(), TrainingError> {
    let refuse = |text: &str| Err(TrainingError::Data(format!("{}: {text}", file_in(folder).display())));
    if scene.grains.sizes.is_some() {
        return refuse("spheres of unequal size, allowed for a training: equal ones");
    }
    if scene.grains.roughness.is_some() {
        return refuse("spheres that are rough, allowed for a training: no roughness");
    }
    if scene.closure().is_some() {
        return refuse(
            "spheres that conduct less than 60 times as well as the gas, allowed for a training: better ones, whose contacts conduct \
             as in a vacuum",
        );
    }
    Ok(())
}

/// The path of one packing of a bed; `file` and its `text`: results of 'msdd bed run'.
///
/// # Errors
/// Results without strains.
pub fn track(
    folder: &Path,
    scene: &BedCase,
    file: &Path,
    text: &str,
    packing: i64,
) -> Result<Track, TrainingError> {
    let grains = &scene.grains;
    let values = |name: &&str| {
        column(text, name).ok_or_else(|| {
            let allowed = "dem.csv of this version's 'msdd bed run'";
            TrainingError::Data(format!(
                "{}: no column {name} of numbers, allowed: {allowed}",
                file.display()
            ))
        })
    };
    let strains: Vec<Vec<f64>> = STRAIN.iter().map(values).collect::<Result<_, _>>()?;
    let states: Vec<Vec<f64>> = STATE.iter().map(values).collect::<Result<_, _>>()?;
    let temperatures = values(&"T_mean")?;
    let modulus = effective_modulus(grains.young_modulus, grains.poisson_ratio);
    let density = equal_density(grains.moments().spread);
    let mobilised = FirstRow::read(file)?.mobilised;
    let gas_along = |temperature: f64, conductivity: f64| {
        let solid = Solid {
            conductivity: grains.conductivity.at(temperature),
            effective_modulus: modulus,
            roughness: None,
        };
        let bed = BedMaterial {
            radius: 0.5 * grains.diameter,
            solid,
            gas: scene.gas.name,
            gas_pressure: scene.gas.pressure,
            accommodation: scene.gas.accommodation,
        };
        let known =
            bed.gas_at(temperature).map(|gas| [bed.gas_number(&gas), conductivity / gas.conductivity]);
        known.unwrap_or([f64::NAN; 2])
    };
    let point = |k: usize| {
        let [porosity, a, b, c, coordination, x, y, z, conductivity, by_gas] =
            std::array::from_fn(|column| states[column][k]);
        let along = conductivity / grains.conductivity.at(temperatures[k]);
        Point {
            solid: density * (1.0 - porosity),
            stress: diagonal([a, b, c].map(|stress| stress / modulus)),
            contact: diagonal([f64::NAN, f64::NAN, along]),
            gas: [f64::NAN; 3],
            gas_along: gas_along(temperatures[k], by_gas),
            coordination,
            fabric: diagonal([x, y, z]),
            mobilised,
        }
    };
    // Where the lid keeps its pressure, and where the bed is spread and may lose all but its weight.
    let spreads = scene.shell.is_some() || scene.sides.is_some();
    let free_axis = (scene.lid_moves().1.is_some() || spreads).then_some(2);
    let steps = (1..temperatures.len()).map(|k| {
        let [thermal, x, y, z] =
            std::array::from_fn(|column| (1.0 + strains[column][k]) / (1.0 + strains[column][k - 1]) - 1.0);
        Step { from: k - 1, thermal, stretch: diagonal([x, y, z]), free_axis, to: point(k) }
    });
    // Spheres in the region of the averages.
    let [low, high] = scene.record.heights;
    let area = scene.record.radius.map_or(scene.vessel().area(), |radius| PI * radius * radius);
    let volume = area * (high - low) * point(0).solid;
    Ok(Track {
        packing,
        name: NAME.to_string(),
        recipe: folder.file_name().unwrap_or_default().display().to_string(),
        is_isotropic: false,
        spheres: (volume / (PI / 6.0 * grains.diameter.powi(3))) as usize,
        weight: WEIGHT,
        packed: point(0),
        aside: 0.0,
        steps: steps.collect(),
        loses_load: false,
    })
}

fn diagonal([x, y, z]: [f64; 3]) -> Tensor {
    [x, y, z, 0.0, 0.0, 0.0]
}
