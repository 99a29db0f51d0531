//! The grains of a new case.

use crate::CaseError;
use crate::ranges::allow;
use msdd_dem::{Material, Thermal};

/// Properties of the grains that the solver needs. All grains are of one material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grains {
    /// Density ρ of a grain, not of the bed [kg/m³].
    pub density: f64,
    /// Young's modulus E \[Pa\]. Contact forces are E r δ (r: harmonic mean of the two radii, δ: overlap), so the pressure is
    /// in proportion to E.
    pub young_modulus: f64,
    /// Thermal conductivity k [W/(m K)].
    pub thermal_conductivity: f64,
    /// Specific heat capacity c [J/(kg K)].
    pub heat_capacity: f64,
    /// Linear thermal expansion coefficient α [1/K].
    pub thermal_expansion: f64,
    /// Mean radius r̄ \[m\]; the radii are uniformly distributed between 0.6 r̄ and 1.4 r̄.
    pub mean_radius: f64,
}

/// What properties of grains may be; so narrow that products of such numbers cannot overflow.
pub const GRAIN_VALUES: [f64; 2] = [1e-12, 1e15];
pub const GRAIN_EXPANSIONS: [f64; 2] = [0.0, 1.0];

/// Refuses a value out of range, of [`Grains::named`].
///
/// # Errors
/// [`CaseError::Parameter`].
pub fn check_value((key, value, unit): (&str, f64, &str)) -> Result<(), CaseError> {
    let [least, most] = if key == "thermalExpansion" { GRAIN_EXPANSIONS } else { GRAIN_VALUES };
    allow(key, value, (least..=most).contains(&value), || format!("{least:e} to {most:e} {unit}"))
}

impl From<[f64; 6]> for Grains {
    /// Of values in the order of [`Grains::named`].
    fn from(values: [f64; 6]) -> Self {
        let [density, young_modulus, thermal_conductivity, heat_capacity, thermal_expansion, mean_radius] =
            values;
        Self { density, young_modulus, thermal_conductivity, heat_capacity, thermal_expansion, mean_radius }
    }
}

impl Grains {
    /// Values by the names that they have in `constant/granularProperties`, with unit.
    pub fn named(&self) -> [(&'static str, f64, &'static str); 6] {
        [
            ("density", self.density, "kg/m3"),
            ("youngModulus", self.young_modulus, "Pa"),
            ("thermalConductivity", self.thermal_conductivity, "W/(m K)"),
            ("heatCapacity", self.heat_capacity, "J/(kg K)"),
            ("thermalExpansion", self.thermal_expansion, "1/K"),
            ("meanRadius", self.mean_radius, "m"),
        ]
    }

    /// Refuses values out of range; the error names the first of them.
    ///
    /// # Errors
    /// [`CaseError::Parameter`].
    pub fn check(&self) -> Result<(), CaseError> {
        self.named().into_iter().try_for_each(check_value)
    }

    /// The material for the discrete element engine. Friction, stiffness ratio and damping are those of the paper, for which
    /// the shipped model was trained.
    pub fn material(&self) -> Material {
        Material { density: self.density, young_modulus: self.young_modulus, ..Material::default() }
    }

    /// E r̄/ℓ with ℓ = 1 m \[Pa\]. The stresses of packings of equal structure are in proportion to this scale.
    pub fn stress_scale(&self) -> f64 {
        self.young_modulus * self.mean_radius
    }

    /// The grains of a case that was read.
    pub fn of(material: &Material, thermal: &Thermal, mean_radius: f64) -> Self {
        Self {
            density: material.density,
            young_modulus: material.young_modulus,
            thermal_conductivity: thermal.conductivity,
            heat_capacity: thermal.heat_capacity,
            thermal_expansion: thermal.expansion,
            mean_radius,
        }
    }
}
