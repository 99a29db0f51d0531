//! The function of `msdd.h` about walls of beds of spheres.

use super::sized;
use crate::abi::{msdd_grains, msdd_sphere_wall};
use crate::columns::{Input, Output, check_length};
use crate::grains::Grains;
use crate::si::LARGEST_STRESS;
use crate::sphere_material::{Material, compliance, conductivity, ranged, roughness};
use crate::status::{Failure, status};
use msdd_beds::wall::{Radiating, Wall};

/// Largest resistance that is answered \[m² K/W\], where nothing conducts.
const LARGEST: f64 = 1e9;

/// A caller's wall next to spheres of (1 − ν²)/E \[1/Pa\].
fn surface(given: &msdd_sphere_wall, spheres_give: f64) -> Result<Wall, Failure> {
    const OF: &str = "wall";
    let both = compliance(OF, given.young_modulus, given.poisson_ratio)? + spheres_give;
    // Hexagonal: 2/√3 on the square of a diameter.
    let spheres = ranged("wall.spheres", given.spheres, [0.01, 1.16], "0.01 to 1.16")?;
    let conductivity = Some(conductivity(OF, given.conductivity)?);
    let roughness = roughness(OF, given.roughness, given.hardness)?;
    Ok(Wall { conductivity, effective_modulus: 1.0 / both, roughness, spheres })
}

/// `msdd_wall_resistance`
///
/// # Safety
/// `material` is null or points to its struct, whose gas is null or a C string; `wall` is null or points to its struct; the columns are
/// null or hold `faces` values, `resistance` writable ones.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_wall_resistance(
    material: *const msdd_grains,
    wall: *const msdd_sphere_wall,
    faces: usize,
    stress: *const f64,
    temperature: *const f64,
    conductivity: *const f64,
    resistance: *mut f64,
) -> i32 {
    status(|| {
        check_length(faces)?;
        // SAFETY: null or pointing to their structs with a C string, by this function's contract.
        let (material, wall) =
            unsafe { (Material::new(&Grains::new(sized("material", material)?)?)?, sized("wall", wall)?) };
        let bed = material.bed();
        let emissivity = ranged("wall.emissivity", wall.emissivity, [0.0, 1.0], "0 to 1")?;
        let wall = surface(&wall, 0.5 / material.modulus())?;
        if resistance.is_null() && faces > 0 {
            return Err(Failure::null("resistance"));
        }
        // SAFETY: `faces` values, writable ones of the last, by this function's contract.
        let (stress, temperature, conductivity, resistance) = unsafe {
            (
                Input::contiguous("stress", stress, faces)?,
                Input::contiguous("temperature", temperature, faces)?,
                Input::contiguous("conductivity", conductivity, faces)?,
                Output::contiguous("resistance", resistance, faces),
            )
        };
        stress.check_range(-LARGEST_STRESS, LARGEST_STRESS, "-1e30 to 1e30 Pa")?;
        temperature.check_range(0.0, 1e5, "0 to 1e5 K")?;
        conductivity.check_range(0.0, 1e30, "0 to 1e30 W/(m K)")?;
        for face in 0..faces {
            // Where grains do not touch and there is no gas
            let found = match conductivity.at(face) {
                0.0 => LARGEST,
                across => {
                    let there = temperature.at(face);
                    let radiating = Radiating { emissivity, ..material.radiating(there, across) };
                    wall.resistance(bed, stress.at(face), there, across, &radiating)
                }
            };
            resistance.write_one(face, found.min(LARGEST));
        }
        Ok(())
    })
}
