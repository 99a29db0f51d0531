//! Spheres and gas of a caller, and the conductivity of a bed of them.

use crate::abi::msdd_sphere_material;
use crate::status::{Failure, utf8};
use ::msdd_surrogate::spheres::model::Answer;
use ::msdd_surrogate::spheres::readout::GAS_RANGE;
use ::msdd_surrogate::spheres::tensor::{Tensor, mean};
use msdd_beds::effective::{BedMaterial, LEAST_RATIO, Packed};
use msdd_beds::gas::Gas;
use msdd_beds::named_gases::GasName;
use msdd_beds::solid::{Roughness, Solid};
use std::ffi::CStr;

/// A checked material.
#[derive(Clone, Copy)]
pub(crate) struct Material {
    bed: BedMaterial,
}

/// The gas at a temperature.
pub(crate) struct GasThere {
    /// ln(R/h).
    pub number: f64,
    /// Whether that is outside of the range of the law.
    pub outside: bool,
    /// None in a vacuum.
    gas: Option<Gas>,
}

/// Conductivity of a bed \[W/(m K)\], and the part of it by gas.
pub(crate) struct Conductivity {
    pub tensor: Tensor,
    pub gas: f64,
}

/// Least number of contacts per sphere of a packing that bears load.
const LEAST_CONTACTS: f64 = 2.0;

impl Material {
    /// # Safety
    /// The material's gas is null or a C string.
    pub unsafe fn new(given: &msdd_sphere_material) -> Result<Self, Failure> {
        let ranged = |name: &str, value: f64, [low, high]: [f64; 2], allowed: &str| match (low..=high)
            .contains(&value)
        {
            true => Ok(value),
            false => Err(Failure::number(format!("material.{name}"), value, allowed)),
        };
        let diameter = ranged("diameter", given.diameter, [1e-9, 1e3], "1e-9 to 1e3 m")?;
        let young = ranged("young_modulus", given.young_modulus, [1e-9, 1e15], "1e-9 to 1e15 Pa")?;
        let poisson = ranged("poisson_ratio", given.poisson_ratio, [-0.99, 0.5], "-0.99 to 0.5")?;
        let conductivity =
            ranged("conductivity", given.conductivity, [1e-12, 1e12], "1e-12 to 1e12 W/(m K)")?;
        let height_over_slope = ranged("roughness", given.roughness, [0.0, 1.0], "0 to 1 m; 0 is smooth")?;
        let roughness = match height_over_slope > 0.0 {
            true => {
                let hardness = ranged("hardness", given.hardness, [1.0, 1e15], "1 to 1e15 Pa")?;
                Some(Roughness { height_over_slope, hardness })
            }
            false => None,
        };
        let gas = match given.gas.is_null() {
            true => GasName::Vacuum,
            // SAFETY: not null, a C string by this function's contract.
            false => named(&utf8("material.gas", unsafe { CStr::from_ptr(given.gas) })?)?,
        };
        let (mut gas_pressure, mut accommodation) = (1.0, 1.0);
        if gas != GasName::Vacuum {
            gas_pressure = ranged("gas_pressure", given.gas_pressure, [1e-3, 1e9], "1e-3 to 1e9 Pa")?;
            accommodation = ranged("accommodation", given.accommodation, [0.01, 1.0], "0.01 to 1")?;
        }
        let effective_modulus = 0.5 * young / (1.0 - poisson * poisson);
        let solid = Solid { conductivity, effective_modulus, roughness };
        Ok(Self { bed: BedMaterial { radius: 0.5 * diameter, solid, gas, gas_pressure, accommodation } })
    }

    /// k_s \[W/(m K)\].
    pub fn solid_conductivity(&self) -> f64 {
        self.bed.solid.conductivity
    }

    /// The same with this k_s.
    pub fn with_conductivity(mut self, conductivity: f64) -> Self {
        self.bed.solid.conductivity = conductivity;
        self
    }

    /// E* \[Pa\].
    pub fn modulus(&self) -> f64 {
        self.bed.solid.effective_modulus
    }

    /// The gas at a temperature \[K\].
    pub fn gas(&self, temperature: f64) -> Result<GasThere, Failure> {
        let Some(gas) = self.bed.gas_at(temperature) else {
            return Ok(GasThere { number: GAS_RANGE[1], outside: false, gas: None });
        };
        if self.bed.ratio(&gas) < LEAST_RATIO {
            let least =
                format!("at least that of the gas, which is {:.4} at {temperature} K", gas.conductivity);
            return Err(Failure::number("material.conductivity", self.bed.solid.conductivity, least));
        }
        let (number, [low, high]) = (self.bed.gas_number(&gas), GAS_RANGE);
        // The number is that of the law of pairs, which poor conductors do not have.
        let outside = (number < low || number > high) && self.bed.share_of_pairs(&gas) > 0.0;
        Ok(GasThere { number, outside, gas: Some(gas) })
    }

    /// Conductivity of a bed for which the law answers this.
    pub fn conductivity(&self, answer: &Answer, gas: &GasThere) -> Conductivity {
        let pressure = mean(answer.stress);
        let conduction = self.bed.conduction(
            gas.gas.as_ref(),
            &Packed {
                pressure: pressure * self.modulus(),
                solid_fraction: answer.solid,
                coordination: answer.coordination.max(LEAST_CONTACTS),
                gas: answer.gas,
            },
        );
        let solid = self.bed.solid.conductivity * conduction.contacts;
        let normal = |k: usize| if k < 3 { conduction.gas } else { 0.0 };
        let tensor = std::array::from_fn(|k| solid * answer.contact[k] + normal(k));
        Conductivity { tensor, gas: conduction.gas }
    }
}

fn named(name: &str) -> Result<GasName, Failure> {
    let known = GasName::ALL.into_iter().find(|gas| gas.as_str() == name);
    known.ok_or_else(|| Failure::argument("material.gas", name, GasName::ALL.map(GasName::as_str).join(", ")))
}
