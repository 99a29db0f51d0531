//! The walls of a bed of spheres: the friction of a flat wall, and its material, from which the resistance between wall and spheres
//! follows.

use crate::numbers::{plain, short};
use crate::values::when;
use crate::{CaseError, refused};

/// The material of a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallMaterial {
    pub name: &'static str,
    /// k \[W/(m K)\]
    pub thermal_conductivity: f64,
    /// \[Pa\]
    pub young_modulus: f64,
    pub poisson_ratio: f64,
    /// \[Pa\], which counts where the spheres are rough.
    pub hardness: f64,
}

/// Named materials of walls near room temperature, usual values of handbooks: structural steel, AISI 304, EN AW-6061, float glass. The
/// first one is the default.
pub const MATERIALS: [WallMaterial; 4] = [
    of_values("steel", 50.0, 210e9, 0.3, 1.5e9),
    of_values("stainless-steel", 15.0, 195e9, 0.29, 2e9),
    of_values("aluminium", 167.0, 69e9, 0.33, 1.1e9),
    of_values("glass", 1.0, 71e9, 0.22, 5.5e9),
];

const fn of_values(
    name: &'static str,
    k: f64,
    young_modulus: f64,
    poisson_ratio: f64,
    hardness: f64,
) -> WallMaterial {
    WallMaterial { name, thermal_conductivity: k, young_modulus, poisson_ratio, hardness }
}

impl WallMaterial {
    /// One of [`MATERIALS`], the first one unless a name is given; none by the name `none`.
    ///
    /// # Errors
    /// [`CaseError::Parameter`] for another name.
    pub fn named(name: Option<&str>) -> Result<Option<Self>, CaseError> {
        let name = name.unwrap_or(MATERIALS[0].name);
        let known = MATERIALS.into_iter().find(|material| material.name == name);
        match known {
            None if name != "none" => {
                let allowed = MATERIALS.map(|material| material.name).join(", ") + ", none";
                Err(refused("wall material", name, allowed))
            }
            known => Ok(known),
        }
    }

    /// The entry `wall` of `spheresCoeffs`, for spheres of this roughness \[m\] and hardness \[Pa\] on a polished wall: they have the
    /// asperities, and the softer of both yields. The mesh ends `gap` diameters before the wall.
    pub fn entry(&self, roughness: f64, hardness: f64, gap: f64) -> String {
        let softer = self.hardness.min(hardness);
        let rough =
            when(roughness > 0.0, || format!(" roughness {}; hardness {};", plain(roughness), plain(softer)));
        let gap = when(gap > 0.0, || format!(" gap {};", plain(gap)));
        format!(
            "\n        // Walls with the condition granularWall in 0/T: {}, polished. The resistance between wall and spheres follows from it\n\
             \x20       wall {{ thermalConductivity {}; youngModulus {}; poissonRatio {};{rough}{gap} }}\n",
            self.name,
            plain(self.thermal_conductivity),
            plain(self.young_modulus),
            plain(self.poisson_ratio)
        )
    }
}

/// Usual coefficient of friction of a sphere on a wall: that between spheres, for which their law is valid.
pub const OF_SPHERE: f64 = 0.3;

/// Most friction that a flat wall has for a bed, however rough it is.
const MOST: f64 = 0.18;
/// Slip at which half of it is reached \[diameters of a sphere\], of spheres of glass; that of others is to it as their overlaps under equal
/// stress, which Hertz's law has with E^(-2/3).
const SLIP: f64 = 5e-4;
const GLASS: f64 = 70e9;

/// Tangential over normal stress at a flat wall along which a bed slips, of spheres that slide on it with this coefficient of friction:
/// less, because spheres also roll along it. The form is a fit to beds of DEM in cylinders, heated and cooled: 0.08, 0.13
/// and 0.15 where the coefficient is 0.1, 0.2 and 0.3.
pub fn of_bed(friction: f64) -> f64 {
    friction / (friction / MOST).hypot(1.0)
}

/// What a coefficient of friction of a sphere means for a bed, as text.
pub fn sentence(friction: f64) -> String {
    format!("a friction of {} of a sphere acts on the bed as {}", plain(friction), short(of_bed(friction)))
}

/// The coefficient of friction of spheres and a wall along which a bed slips with this tangential over normal stress: the inverse of
/// [`of_bed`]. `None` beyond the most that a flat wall has.
pub fn of_spheres(friction: f64) -> Option<f64> {
    (friction < MOST).then(|| friction / (1.0 - (friction / MOST).powi(2)).sqrt())
}

/// The keys of friction of a wall in `constant/granularProperties`, each after a blank; diameter \[m\] and Young's modulus \[Pa\] of the
/// spheres.
pub fn friction(friction: f64, sphere: [f64; 2]) -> String {
    widened_friction(friction, sphere, 1.0)
}

/// The same for a mesh that ends before the side of a cylinder, whose radius is larger by the factor `widening`: so much more friction goes to
/// the side as it is longer.
pub fn widened_friction(friction: f64, [diameter, young_modulus]: [f64; 2], widening: f64) -> String {
    when(friction > 0.0, || {
        let slip = SLIP * diameter * (GLASS / young_modulus).powf(2.0 / 3.0);
        let [friction, slip] = [widening * of_bed(friction), slip].map(short);
        format!(" friction {friction}; slip {slip};")
    })
}

/// A wall that stays, as an entry of `walls` in `constant/granularProperties`; `sphere` as in [`friction`](fn@friction).
pub fn entry(friction: f64, sphere: [f64; 2]) -> String {
    match friction > 0.0 {
        true => format!("type rigid;{}", self::friction(friction, sphere)),
        false => "type frictionless;".to_string(),
    }
}

/// Keys of the thermal expansion \[1/K\] of a shell that is at its initial place at a temperature \[K\], each after a blank. With
/// friction it expands from the floor, where the axis of the mesh begins.
pub fn expansion(expansion: f64, temperature: f64, friction: f64) -> String {
    let fixed = if friction > 0.0 { " fixedPoint (0 0 0);" } else { "" };
    when(expansion > 0.0, || {
        format!(" thermalExpansion {}; temperature {};{fixed}", plain(expansion), plain(temperature))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn friction_of_a_bed_is_that_of_its_spheres_where_small_and_has_a_limit() {
        for (coefficient, counted, error) in [
            (0.0, 0.0, 1e-99),
            (1e-3, 1e-3, 1e-7),
            (0.1, 0.078, 0.01),
            (0.2, 0.130, 0.01),
            (0.3, 0.149, 0.01),
        ] {
            assert!((of_bed(coefficient) - counted).abs() < error, "{}", of_bed(coefficient));
        }
        assert!(of_bed(10.0) < MOST && of_bed(10.0) > 0.99 * MOST);
        assert!((of_spheres(of_bed(0.3)).unwrap() - 0.3).abs() < 1e-12 && of_spheres(0.2).is_none());
    }
}
