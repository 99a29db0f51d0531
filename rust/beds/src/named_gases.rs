//! Gases that have a name, with properties by temperature.
//!
//! | gas | viscosity and conductivity | from | to |
//! |---|---|---|---|
//! | air, nitrogen, argon | the limits at low density of Lemmon & Jacobsen, Int. J. Thermophys. 25, 21, 2004 (within 1 to 2 %) | 200 K | 2000 K |
//! | helium | Petersen, The properties of helium, Risø report 224, 1970, at 1 bar | 273 K | 1800 K |
//!
//! Heat capacities are those of ideal gases: 5/2 R of single atoms; 7/2 R and one harmonic vibration of molecules (nitrogen
//! 3393 K, oxygen 2273 K). The mean free path is Λ = η/p √(π R T/(2 M)) (Kennard, Kinetic Theory of Gases, 1938).

use crate::gas::Gas;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// R \[J/(mol K)\].
const GAS_CONSTANT: f64 = 8.314_462_618;

/// A gas that flows, at low density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowingGas {
    /// \[Pa s\]
    pub viscosity: f64,
    /// \[W/(m K)\]
    pub conductivity: f64,
    /// At constant pressure \[J/(kg K)\].
    pub heat_capacity: f64,
    /// \[kg/mol\]
    pub molar_mass: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GasName {
    Air,
    Nitrogen,
    Helium,
    Argon,
    /// Nothing that conducts.
    Vacuum,
}

named!(GasName);

impl GasName {
    pub const ALL: [Self; 5] = [Self::Air, Self::Nitrogen, Self::Helium, Self::Argon, Self::Vacuum];

    /// Temperatures \[K\] between which the properties are known.
    pub fn range(self) -> [f64; 2] {
        match self {
            Self::Air | Self::Nitrogen | Self::Argon => [200.0, 2000.0],
            Self::Helium => [273.0, 1800.0],
            Self::Vacuum => [0.0, f64::INFINITY],
        }
    }

    /// The gas at a temperature \[K\] and pressure \[Pa\], with the accommodation at the spheres; none in a vacuum.
    pub fn at(self, temperature: f64, pressure: f64, accommodation: f64) -> Option<Gas> {
        let FlowingGas { viscosity, conductivity, molar_mass, .. } = self.flowing(temperature)?;
        let heat_capacity = self.heat_capacity(temperature);
        let speed = (PI * GAS_CONSTANT * temperature / (2.0 * molar_mass)).sqrt();
        Some(Gas {
            conductivity,
            mean_free_path: viscosity / pressure * speed,
            prandtl: viscosity * heat_capacity * GAS_CONSTANT / molar_mass / conductivity,
            heat_capacity_ratio: heat_capacity / (heat_capacity - 1.0),
            accommodation,
        })
    }

    /// What a flow of the gas depends on at a temperature \[K\]; none in a vacuum.
    pub fn flowing(self, temperature: f64) -> Option<FlowingGas> {
        let molar_mass = self.molar_mass()?;
        let (viscosity, conductivity) = self.transport(temperature)?;
        let heat_capacity = self.heat_capacity(temperature) * GAS_CONSTANT / molar_mass;
        Some(FlowingGas { viscosity, conductivity, heat_capacity, molar_mass })
    }

    /// \[kg/mol\]
    fn molar_mass(self) -> Option<f64> {
        match self {
            Self::Air => Some(28.9586e-3),
            Self::Nitrogen => Some(28.01348e-3),
            Self::Argon => Some(39.948e-3),
            Self::Helium => Some(4.002602e-3),
            Self::Vacuum => None,
        }
    }

    /// c_p of the ideal gas over R \[-\].
    fn heat_capacity(self, temperature: f64) -> f64 {
        let vibration = |at: f64| {
            let x = at / temperature;
            let e = libm::exp(-x);
            x * x * e / ((1.0 - e) * (1.0 - e))
        };
        match self {
            Self::Air => 3.5 + 0.78 * vibration(3393.0) + 0.21 * vibration(2273.0),
            Self::Nitrogen => 3.5 + vibration(3393.0),
            Self::Helium | Self::Argon | Self::Vacuum => 2.5,
        }
    }

    /// Viscosity \[Pa s\] and conductivity \[W/(m K)\].
    fn transport(self, temperature: f64) -> Option<(f64, f64)> {
        // Lennard-Jones energy [K] and diameter [nm]; critical temperature [K]; factors and exponents of the conductivity.
        let (energy, diameter, critical, first, [(second, a), (third, b)]) = match self {
            Self::Air => (103.3, 0.360, 132.6312, 1.308, [(1.405, -1.1), (-1.036, -0.3)]),
            Self::Nitrogen => (98.94, 0.3656, 126.192, 1.511, [(2.117, -1.0), (-3.332, -0.7)]),
            Self::Argon => (143.2, 0.335, 150.687, 0.8158, [(-0.4320, -0.77), (0.0, -1.0)]),
            Self::Helium => {
                let power = |exponent| libm::pow(temperature, exponent);
                return Some((3.674e-7 * power(0.7), 2.682e-3 * (1.0 + 1.123e-3) * power(0.7099)));
            }
            Self::Vacuum => return None,
        };
        let log = libm::log(temperature / energy);
        let terms = [0.431, -0.4623, 0.08406, 0.005341, -0.00331];
        let collisions = libm::exp(terms.iter().rev().fold(0.0, |sum, b| sum * log + b));
        // In µPa s with the molar mass in g/mol and the diameter in nm.
        let root = (1e3 * self.molar_mass()? * temperature).sqrt();
        let viscosity = 0.0266958 * root / (diameter * diameter * collisions);
        let power = |exponent| libm::pow(critical / temperature, exponent);
        let conductivity = first * viscosity + second * power(a) + third * power(b);
        Some((1e-6 * viscosity, 1e-3 * conductivity))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of handbooks (VDI Heat Atlas, 2nd ed., part D; Incropera and DeWitt, table A.4), which have 1 to 2 %.
    #[test]
    fn properties_are_those_of_handbooks() {
        let cases = [
            (GasName::Air, 300.0, 26.3e-3, 0.707),
            (GasName::Air, 600.0, 46.9e-3, 0.685),
            (GasName::Air, 1000.0, 66.7e-3, 0.726),
            (GasName::Nitrogen, 300.0, 25.9e-3, 0.716),
            (GasName::Nitrogen, 600.0, 44.6e-3, 0.701),
            (GasName::Nitrogen, 1000.0, 64.7e-3, 0.721),
            (GasName::Helium, 300.0, 152e-3, 0.68),
            (GasName::Helium, 700.0, 278e-3, 0.654),
            (GasName::Argon, 300.0, 17.7e-3, 0.67),
            (GasName::Argon, 1000.0, 42.7e-3, 0.67),
        ];
        for (name, temperature, conductivity, prandtl) in cases {
            let gas = name.at(temperature, 101_325.0, 0.9).unwrap();
            let errors = [gas.conductivity / conductivity - 1.0, gas.prandtl / prandtl - 1.0];
            assert!(errors[0].abs() < 0.03 && errors[1].abs() < 0.05, "{name:?} {temperature} {errors:?}");
        }
    }

    /// Viscosity and heat capacity of handbooks (VDI Heat Atlas, 2nd ed., D2.2 air; Incropera and DeWitt, table A.4).
    #[test]
    fn flowing_gases_are_those_of_handbooks() {
        let cases = [
            (GasName::Air, 300.0, 184.6e-7, 1007.0),
            (GasName::Air, 600.0, 305.8e-7, 1051.0),
            (GasName::Air, 1000.0, 424.4e-7, 1141.0),
            (GasName::Nitrogen, 600.0, 290.8e-7, 1075.0),
            (GasName::Helium, 300.0, 199.0e-7, 5193.0),
        ];
        for (name, temperature, viscosity, heat_capacity) in cases {
            let gas = name.flowing(temperature).unwrap();
            let errors = [gas.viscosity / viscosity - 1.0, gas.heat_capacity / heat_capacity - 1.0];
            assert!(errors[0].abs() < 0.02 && errors[1].abs() < 0.006, "{name:?} {temperature} {errors:?}");
        }
    }

    #[test]
    fn mean_free_path_goes_as_one_over_the_pressure() {
        let at = |pressure| GasName::Air.at(293.15, pressure, 0.9).unwrap().mean_free_path;
        // 65 to 68 nm, by the definition taken.
        assert!((6.4e-8..6.9e-8).contains(&at(101_325.0)), "{}", at(101_325.0));
        assert!((at(101.325) / at(101_325.0) - 1000.0).abs() < 1e-9);
        assert_eq!(GasName::Vacuum.at(293.15, 1.0, 0.9), None);
        assert!((GasName::Helium.at(300.0, 1e5, 0.9).unwrap().heat_capacity_ratio - 5.0 / 3.0).abs() < 1e-15);
        let air = GasName::Air.at(300.0, 1e5, 0.9).unwrap();
        assert!((air.heat_capacity_ratio - 1.4).abs() < 0.002, "{air:?}");
    }
}
