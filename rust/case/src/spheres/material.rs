//! The spheres of a new case.

use crate::CaseError;
use crate::grains::Grains;
use crate::material::{CRUSH_LOADS, HARDNESSES, Material, POISSON_RATIOS};
use crate::ranges::allow;
use msdd_beds::case::{FRICTION, Grains as Keys, RESTITUTION};
use msdd_beds::property::Property;
use msdd_beds::sizes::{MAX_SPREAD, equal_density};
use msdd_beds::units;

/// Spheres of one material. The law of spheres is valid for one friction between them, 0.3.
#[derive(Clone, Debug, PartialEq)]
pub struct Spheres {
    /// `mean_radius` is the radius of the spheres, `young_modulus` that of the solid; properties at the start.
    pub grains: Grains,
    pub conductivity: Property,
    pub heat_capacity: Property,
    /// Poisson's ratio \[-\].
    pub poisson_ratio: f64,
    /// Height of the asperities (root mean square) over their slope \[m\]; 0: smooth.
    pub roughness: f64,
    /// Hardness of the surface \[Pa\], which counts where it is rough.
    pub hardness: f64,
    /// 0: without radiation.
    pub emissivity: Property,
    /// Force on a contact at which a sphere breaks \[N\], if it is known.
    pub crush_load: Option<f64>,
    /// Standard deviation of the diameters over their mean, both weighted by surface; `mean_radius` is half the mean.
    pub size_spread: f64,
}

/// Hardness of smooth spheres, which counts where they are rough \[Pa\].
const ANY_HARDNESS: f64 = 1e9;

impl Spheres {
    /// Equal spheres of a material, with these grains.
    ///
    /// # Errors
    /// A value that the material does not have.
    pub fn of(material: &Material, grains: Grains) -> Result<Self, CaseError> {
        // A value that was replaced holds at all temperatures.
        let over = |property: &Option<Property>, value: f64| match property {
            Some(table) if table.at(material.temperature) == value => table.clone(),
            _ => Property::Constant(value),
        };
        let roughness = material.roughness.unwrap_or(0.0);
        let hardness =
            if roughness > 0.0 { material.hardness } else { material.hardness.or(Some(ANY_HARDNESS)) };
        Ok(Self {
            conductivity: over(&material.thermal_conductivity, grains.thermal_conductivity),
            heat_capacity: over(&material.heat_capacity, grains.heat_capacity),
            poisson_ratio: material.required("poisson_ratio", None, material.poisson_ratio, &units::RATIO)?,
            hardness: material.required("hardness", None, hardness, &units::STRESS)?,
            emissivity: material.emissivity.clone().unwrap_or(Property::Constant(0.0)),
            crush_load: material.crush_load,
            size_spread: 0.0,
            roughness,
            grains,
        })
    }

    /// Those of a bed, at a temperature \[K\].
    pub fn of_bed(keys: &Keys, temperature: f64) -> Self {
        let spread = || keys.sizes.as_ref().map_or(0.0, |_| keys.moments().spread);
        Self {
            grains: Grains {
                density: keys.density,
                young_modulus: keys.young_modulus,
                thermal_conductivity: keys.conductivity.at(temperature),
                heat_capacity: keys.heat_capacity.at(temperature),
                thermal_expansion: keys.thermal_expansion.unwrap_or(0.0),
                mean_radius: 0.5 * keys.diameter,
            },
            conductivity: keys.conductivity.clone(),
            heat_capacity: keys.heat_capacity.clone(),
            poisson_ratio: keys.poisson_ratio,
            roughness: keys.roughness.unwrap_or(0.0),
            hardness: keys.hardness.unwrap_or(ANY_HARDNESS),
            emissivity: keys.emissivity.clone().unwrap_or(Property::Constant(0.0)),
            crush_load: keys.crush_load,
            size_spread: keys.size_spread.unwrap_or_else(spread),
        }
    }

    /// As the description of a bed has them, with a friction of the walls.
    pub fn keys(&self, wall_friction: f64) -> Keys {
        let grains = &self.grains;
        Keys {
            number: 0,
            diameter: 2.0 * grains.mean_radius,
            density: grains.density,
            young_modulus: grains.young_modulus,
            poisson_ratio: self.poisson_ratio,
            simulated_young_modulus: f64::NAN,
            friction: FRICTION,
            wall_friction,
            restitution: RESTITUTION,
            conductivity: self.conductivity.clone(),
            heat_capacity: self.heat_capacity.clone(),
            roughness: Some(self.roughness),
            hardness: Some(self.hardness),
            yield_stress: None,
            emissivity: Some(self.emissivity.clone()),
            rays: None,
            thermal_expansion: Some(grains.thermal_expansion),
            crush_load: self.crush_load,
            size_spread: Some(self.size_spread),
            sizes: None,
        }
    }

    /// With the conductivity and the heat capacity at this temperature \[K\] in `grains`.
    pub fn starting_at(mut self, temperature: f64) -> Self {
        self.grains.thermal_conductivity = self.conductivity.at(temperature);
        self.grains.heat_capacity = self.heat_capacity.at(temperature);
        self
    }

    /// Numbers of the law of spheres alone, by the names that they have in `spheresCoeffs`, with unit.
    pub fn named(&self) -> [(&'static str, f64, &'static str); 3] {
        [
            ("poissonRatio", self.poisson_ratio, ""),
            ("roughness", self.roughness, "m"),
            ("hardness", self.hardness, "Pa"),
        ]
    }

    /// Refuses values out of range; the error names the first of them.
    ///
    /// # Errors
    /// [`CaseError::Parameter`].
    pub fn check(&self) -> Result<(), CaseError> {
        self.grains.check()?;
        let ranges = [
            (POISSON_RATIOS[0], POISSON_RATIOS[1], "-0.99 to 0.5"),
            (0.0, 0.01 * self.radius(), "0 (smooth) to a hundredth of the radius [m]"),
            (HARDNESSES[0], HARDNESSES[1], "1 to 1e15 Pa"),
        ];
        for ((key, value, _), (least, most, allowed)) in self.named().into_iter().zip(ranges) {
            allow(key, value, (least..=most).contains(&value), || allowed.to_string())?;
        }
        allow("sizeSpread", self.size_spread, (0.0..=MAX_SPREAD).contains(&self.size_spread), || {
            format!("0 (equal spheres) to {MAX_SPREAD}")
        })?;
        if let Some(load) = self.crush_load {
            let inside = (CRUSH_LOADS[0]..=CRUSH_LOADS[1]).contains(&load);
            allow("crush_load", load, inside, || "1e-12 to 1e9 N".into())?;
        }
        match self.emissivity {
            Property::Constant(value) => allow("emissivity", value, (0.0..=1.0).contains(&value), || {
                "0 (without radiation) to 1".into()
            }),
            Property::Table(_) => Ok(()),
        }
    }

    /// φ of equal spheres that the law takes for these, over φ.
    pub fn equal_density(&self) -> f64 {
        equal_density(self.size_spread)
    }

    /// \[m\]
    pub fn radius(&self) -> f64 {
        self.grains.mean_radius
    }

    /// Diameter \[m\] and Young's modulus \[Pa\].
    pub fn sphere(&self) -> [f64; 2] {
        [2.0 * self.radius(), self.grains.young_modulus]
    }

    /// E* = E/(2 (1 − ν²)) \[Pa\]: the law's stresses are in proportion to it.
    pub fn contact_modulus(&self) -> f64 {
        0.5 * self.grains.young_modulus / (1.0 - self.poisson_ratio * self.poisson_ratio)
    }
}
