//! What the law of spheres says of a bed at the start, which is taken as one that was poured and pressed from above.

use super::material::Spheres;
use crate::CaseError;
use msdd_beds::case::GasKeys;
use msdd_beds::effective::{BedMaterial, BedState};
use msdd_beds::radiation::{Dark, black};
use msdd_beds::sizes::gas_factor;
use msdd_beds::solid::{Roughness, Solid};
use msdd_surrogate::spheres::model::{Answer, Increment, SphereModel};
use msdd_surrogate::spheres::state::PackingData;
use msdd_surrogate::spheres::tensor::mean;

/// Horizontal over vertical stress: 0.81 and 0.85 in the beds of cases/store and cases/column, which were poured and pressed.
pub const LATERAL: f64 = 0.8;
/// Fabric along the horizontal and the vertical of beds that were poured, see the book's page on the law of spheres: gravity leaves
/// more contacts along the vertical.
pub const FABRIC: [f64; 2] = [0.325, 0.35];
/// Contacts per sphere that a bed under gravity has more than boxes with its solid fraction and stress.
const MORE_CONTACTS: f64 = 0.4;
/// ln(R/h) where no gas matters.
const ANY_GAS: f64 = 6.0;
/// Porosities that are tried to find those that the law covers, in thousandths.
const TRIED: std::ops::Range<u32> = 200..700;

/// A bed that was poured.
pub struct PouredBed {
    model: SphereModel,
    spheres: Spheres,
    /// Vertical stress \[Pa\].
    pressure: f64,
}

/// A bed of a porosity at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InitialBed {
    /// Contacts per sphere.
    pub coordination: f64,
    /// Mean over the directions \[W/(m K)\], and the parts of it by gas and radiation.
    pub conductivity: f64,
    pub by_gas: f64,
    pub by_radiation: f64,
}

impl PouredBed {
    /// Of these spheres with this vertical stress \[Pa\].
    ///
    /// # Errors
    /// [`CaseError::Model`] when the shipped model cannot be read.
    pub fn new(spheres: Spheres, pressure: f64) -> Result<Self, CaseError> {
        Ok(Self { model: SphereModel::builtin()?, spheres, pressure })
    }

    /// Least and largest vertical stress that the law covers \[Pa\].
    pub fn pressures(&self) -> [f64; 2] {
        let known = self.model.file.ranges.pressure;
        let vertical = 3.0 / (1.0 + 2.0 * LATERAL) * self.spheres.contact_modulus();
        [known.min, known.max].map(|pressure| pressure * vertical)
    }

    /// Least and largest porosity that the law covers under this stress, to a thousandth; none under a stress outside of its range.
    pub fn porosities(&self) -> Option<[f64; 2]> {
        let mut known = TRIED.map(|k| f64::from(k) / 1000.0).filter(|&porosity| self.knows(porosity));
        let least = known.next()?;
        Some([least, known.next_back().unwrap_or(least)])
    }

    /// What the law answers for a porosity, contacts per sphere if they are known, and ln(R/h) of a gas.
    fn answer(&self, porosity: f64, coordination: Option<f64>, gas_number: f64) -> Answer {
        let pressure = self.pressure / self.spheres.contact_modulus();
        let diagonal = |[along, up]: [f64; 2]| [along, along, up, 0.0, 0.0, 0.0];
        let known = PackingData { coordination, fabric: Some(diagonal(FABRIC)), mobilised: None };
        let stress = diagonal([LATERAL * pressure, pressure]);
        let solid = self.spheres.equal_density() * (1.0 - porosity);
        let state = self.model.initial_state(solid, stress, &known);
        self.model.advance(&state, &Increment::default(), gas_number, false)
    }

    fn knows(&self, porosity: f64) -> bool {
        self.answer(porosity, None, ANY_GAS).outside == 0
    }

    /// The bed with this porosity and gas at a temperature \[K\].
    pub fn start(&self, porosity: f64, gas: &GasKeys, temperature: f64) -> InitialBed {
        let coordination = self.answer(porosity, None, ANY_GAS).coordination + MORE_CONTACTS;
        let material = self.material(gas);
        let between = material.gas_at(temperature);
        let number = between.as_ref().map_or(ANY_GAS, |gas| material.gas_number(gas));
        let answer = self.answer(porosity, Some(coordination), number);
        let conduction = material.conduction(
            between.as_ref(),
            &BedState {
                pressure: mean(answer.stress) * material.solid.effective_modulus,
                solid_fraction: 1.0 - porosity,
                coordination,
                gas: answer.gas * gas_factor(self.spheres.size_spread),
            },
        );
        let by_contacts = material.solid.conductivity * conduction.contacts * mean(answer.contact);
        let dark = Dark {
            conductivity: by_contacts + conduction.gas,
            solid: material.solid.conductivity,
            gas: between.map_or(0.0, |gas| gas.conductivity),
            solid_fraction: 1.0 - porosity,
        };
        let black = black(temperature, 2.0 * material.radius);
        let by_radiation = match self.spheres.emissivity.at(temperature) {
            0.0 => 0.0,
            emissivity => dark.radiation(black, emissivity),
        };
        let conductivity = dark.conductivity + by_radiation;
        InitialBed { coordination, conductivity, by_gas: conduction.gas, by_radiation }
    }

    fn material(&self, gas: &GasKeys) -> BedMaterial {
        let spheres = &self.spheres;
        let rough = Roughness { height_over_slope: spheres.roughness, hardness: spheres.hardness };
        let solid = Solid {
            conductivity: spheres.grains.thermal_conductivity,
            effective_modulus: spheres.contact_modulus(),
            roughness: (spheres.roughness > 0.0).then_some(rough),
        };
        BedMaterial {
            radius: spheres.radius(),
            solid,
            gas: gas.name,
            gas_pressure: gas.pressure,
            accommodation: gas.accommodation,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes_for_tests::steel;
    use msdd_beds::named_gases::GasName;

    /// DEM of cases/column (steel in air, 24 kPa, porosity 0.4037) have 4.70 contacts per sphere at the start and
    /// conduct 0.233 W/(m K) through contacts and 0.415 through the gas, along z. More of the contacts point there (fabric 0.3527), for
    /// which the law has 1.08 and 1.027 times the means over all directions.
    #[test]
    fn a_poured_bed_is_that_of_discrete_elements() {
        let bed = |pressure| PouredBed::new(steel(), pressure).unwrap();
        let start = |name, pressure| bed(24e3).start(0.4037, &GasKeys::new(name, pressure), 293.15);
        let (air, vacuum) = (start(GasName::Air, 101_325.0), start(GasName::Vacuum, 1.0));
        for (found, expected, error) in [
            (air.coordination, 4.70, 0.03),
            (1.027 * air.by_gas, 0.415, 0.03),
            (1.08 * (vacuum.conductivity - vacuum.by_radiation), 0.233, 0.05),
        ] {
            assert!((found / expected - 1.0).abs() < error, "{found} {expected}");
        }
        assert_eq!(vacuum.by_gas, 0.0);
        // Those of packings of spheres; 10 GPa is beyond all packings of the training
        let [least, most] = bed(2e4).porosities().unwrap();
        assert!((0.34..0.37).contains(&least) && (0.42..0.44).contains(&most), "{least} {most}");
        assert_eq!(bed(1e10).porosities(), None);
    }
}
