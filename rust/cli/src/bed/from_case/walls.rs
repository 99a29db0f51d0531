//! The walls of a case: what holds its bed.

use super::shape::{DIGITS, Mesh};
use crate::error::CliError;
use msdd_beds::case::Shell;
use msdd_beds::schedule::Schedule;
use msdd_case::dictionary::{Dictionary, Entry};
use msdd_case::functions::schedule;
use msdd_case::numbers::{plain, rounded};
use msdd_case::spheres::wall::of_spheres;

/// Coefficient of friction of a wall along which a bed slips at the most that a flat wall has.
const ROUGH: f64 = 1.0;

/// Walls that move, and the coefficient of friction of spheres and all walls.
#[derive(Default)]
pub struct Walls {
    pub friction: f64,
    /// Of the lid: how far it moves over the depth, or its pressure [Pa].
    pub strain: Option<Schedule>,
    pub pressing: Option<Schedule>,
    pub shell: Option<Shell>,
}

impl Walls {
    /// Reads `equilibriumCoeffs/walls`; what DEM cannot model is noted.
    ///
    /// # Errors
    /// Numbers that are missing.
    pub fn read(properties: &Dictionary, mesh: &Mesh, notes: &mut Vec<String>) -> Result<Self, CliError> {
        let entries =
            properties.dictionary_at("equilibriumCoeffs").and_then(|own| own.dictionary_at("walls"));
        let (mut walls, (axis, _)) = (Self::default(), mesh.axis());
        let mut frictions: Vec<(&str, f64)> = Vec::new();
        for &(patch, wall) in &mesh.walls {
            let entry = entries.as_ref().ok().and_then(|entries| entries.matching(patch));
            let Some(Entry::Dictionary(entry)) = entry else {
                notes.push(format!("the wall '{patch}' has no entry in walls: it is smooth and stays"));
                continue;
            };
            let kind = entry.text("type")?;
            // The side of 'msdd bed case' has that of the others, for a larger radius.
            if kind != "pressure" && !(mesh.is_of_elements && wall == "side") {
                frictions.push((patch, friction(entry, patch, notes)?));
            }
            match (kind.as_str(), wall) {
                ("shell", "side") => walls.shell = Some(shell(entry)?),
                ("piston" | "pressure", "lid") => {
                    walls.pressing = over_time(entry, "pressure", 1, |value| value[0]);
                    if walls.pressing.is_none() {
                        notes.push(unread(patch, "pressure"));
                    }
                }
                ("rigid" | "frictionless" | "displacement", "lid") if entry.get("displacement").is_some() => {
                    let strain = |value: &[f64]| rounded(-value[axis] / mesh.depth(), DIGITS) + 0.0;
                    walls.strain = over_time(entry, "displacement", 3, strain);
                    if walls.strain.is_none() {
                        notes.push(unread(patch, "displacement"));
                    }
                }
                ("rigid" | "frictionless", _) if entry.get("displacement").is_none() => {}
                _ => notes.push(format!("the wall '{patch}' of type {kind} neither moves nor yields in DEM")),
            }
        }
        walls.friction = frictions.iter().map(|one| one.1).fold(0.0, f64::max);
        if frictions.iter().any(|(_, value)| *value != walls.friction) {
            let all: Vec<String> =
                frictions.iter().map(|(patch, value)| format!("{patch} {}", plain(*value))).collect();
            notes.push(format!(
                "the friction of the walls differs ({}): all walls of DEM have the largest",
                all.join(", ")
            ));
        }
        Ok(walls)
    }
}

fn unread(patch: &str, key: &str) -> String {
    format!("the {key} of the wall '{patch}' is left out; possible: constant or a table over time")
}

fn over_time(
    entry: &Dictionary,
    key: &str,
    components: usize,
    value: impl Fn(&[f64]) -> f64,
) -> Option<Schedule> {
    schedule(entry.value(key).ok()?, components, value)
}

/// The coefficient of friction of spheres and a wall, from that of the bed.
fn friction(entry: &Dictionary, patch: &str, notes: &mut Vec<String>) -> Result<f64, CliError> {
    if entry.get("friction").is_none() {
        return Ok(0.0);
    }
    let of_bed = entry.number("friction", |value| value >= 0.0, ">= 0")?;
    Ok(of_spheres(of_bed).map_or_else(
        || {
            notes.push(format!(
                "the wall '{patch}' has more friction ({}) than spheres on a flat wall: they get a coefficient of {ROUGH}",
                plain(of_bed)
            ));
            ROUGH
        },
        |value| rounded(value, 3),
    ))
}

fn shell(entry: &Dictionary) -> Result<Shell, CliError> {
    let positive = |key: &str| entry.number(key, |value| value > 0.0 && value.is_finite(), "above 0");
    let thermal_expansion = entry.number_or("thermalExpansion", 0.0)?;
    Ok(Shell {
        young_modulus: positive("youngModulus")?,
        thickness: positive("thickness")?,
        thermal_expansion,
    })
}
