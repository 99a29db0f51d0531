//! Conductivity of a bed from what the law of spheres says of it: from reduced conductivities to W/(m K).
//!
//! K = k_s κ_c f + k_g κ_g. κ_c and κ_g are those of smooth spheres over the conductivities of solid and gas, κ_g at the number
//! ln(R/h) of the gas, with the distance h of [`crate::gas`] at a contact. The factor f is what roughness leaves of the contacts,
//! taken at the mean contact force p π d²/(φ z): within 1.3 % of networks with the resistance in every contact while f is above 0.5,
//! and 4 % too low at 0.25.

use crate::gas::{Gas, LEAST_RATIO};
use crate::named_gases::GasName;
use crate::solid::Solid;
use std::f64::consts::PI;

/// Equal spheres and the gas between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BedMaterial {
    /// \[m\]
    pub radius: f64,
    pub solid: Solid,
    pub gas: GasName,
    /// \[Pa\]
    pub gas_pressure: f64,
    /// \[-\]
    pub accommodation: f64,
}

impl BedMaterial {
    /// The gas at a temperature \[K\], which is taken at the nearest known one; none in a vacuum.
    pub fn gas_at(&self, temperature: f64) -> Option<Gas> {
        let [low, high] = self.gas.range();
        self.gas.at(temperature.clamp(low, high), self.gas_pressure, self.accommodation)
    }

    /// ln(R/h) \[-\]: 8.5 for steel spheres of 6 mm in air, less for small spheres, poor solids and thin gases.
    pub fn gas_number(&self, gas: &Gas) -> f64 {
        (self.radius / gas.least_distance(self.radius, self.solid.conductivity)).ln()
    }

    /// Whether the law for gas holds: k_s/k_g of at least 30, see [`crate::gas`].
    pub fn conducts_well(&self, gas: &Gas) -> bool {
        self.solid.conductivity >= LEAST_RATIO * gas.conductivity
    }

    /// f: what roughness leaves of the conduction by contacts \[-\], at a pressure \[Pa\], solid fraction φ and contacts z per sphere.
    pub fn roughness_factor(&self, pressure: f64, solid_fraction: f64, coordination: f64) -> f64 {
        if self.solid.roughness.is_none() || pressure <= 0.0 {
            return 1.0;
        }
        let diameter = 2.0 * self.radius;
        let force = pressure * PI * diameter * diameter / (solid_fraction * coordination);
        let smooth = Solid { roughness: None, ..self.solid };
        let size = |solid: &Solid| solid.contact_size(force, 0.5 * self.radius);
        size(&self.solid) / size(&smooth)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::Roughness;

    fn steel() -> BedMaterial {
        let roughness = Some(Roughness { height_over_slope: 3.4e-7, hardness: 3e9 });
        let solid = Solid { conductivity: 42.0, effective_modulus: 1.09e11, roughness };
        BedMaterial { radius: 3.2e-3, solid, gas: GasName::Air, gas_pressure: 1.013e5, accommodation: 0.7 }
    }

    #[test]
    fn steel_in_air_has_the_number_of_the_literature() {
        let bed = steel();
        let air = bed.gas_at(293.15).expect("no vacuum");
        let number = bed.gas_number(&air);
        assert!((8.0..9.0).contains(&number), "{number}");
        assert!(bed.conducts_well(&air));
        let helium = BedMaterial { gas: GasName::Helium, ..bed }.gas_at(293.15).expect("no vacuum");
        assert!(bed.gas_number(&helium) < number);
        assert!(BedMaterial { gas: GasName::Vacuum, ..bed }.gas_at(300.0).is_none());
        let poor =
            BedMaterial { solid: Solid { conductivity: 2.0, ..bed.solid }, gas: GasName::Helium, ..bed };
        assert!(!poor.conducts_well(&poor.gas_at(300.0).expect("no vacuum")));
    }

    /// Roughness leaves more of contacts that bear more, and all of smooth ones.
    #[test]
    fn roughness_counts_less_under_pressure() {
        let bed = steel();
        let [low, high] = [1e3, 1e6].map(|pressure| bed.roughness_factor(pressure, 0.58, 5.0));
        assert!(0.3 < low && low < high && high < 1.0, "{low} {high}");
        assert_eq!(bed.roughness_factor(0.0, 0.58, 5.0), 1.0);
        let smooth = BedMaterial { solid: Solid { roughness: None, ..bed.solid }, ..bed };
        assert_eq!(smooth.roughness_factor(1e3, 0.58, 5.0), 1.0);
    }
}
