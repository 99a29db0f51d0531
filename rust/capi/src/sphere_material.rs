//! Properties of spheres and gas, and the conductivity of a bed of them.

use crate::grains::Grains;
use crate::status::Failure;
use ::msdd_surrogate::spheres::model::Answers;
use ::msdd_surrogate::spheres::readout::GAS_RANGE;
use ::msdd_surrogate::spheres::tensor::Tensor;
use msdd_beds::effective::{BedMaterial, BedState, MIN_NUMBER, MIN_RATIO};
use msdd_beds::gas::Gas;
use msdd_beds::named_gases::GasName;
use msdd_beds::radiation::{Dark, black, part};
use msdd_beds::sizes::{MAX_SPREAD, equal_density, gas_factor, more_contacts};
use msdd_beds::solid::{Roughness, Solid};
use msdd_beds::wall::Radiating;

/// A checked material.
#[derive(Clone, Copy)]
pub(crate) struct Material {
    bed: BedMaterial,
    /// ε, 0: without radiation.
    emissivity: f64,
    /// φ of equal spheres that are like these, over φ; their contacts less those of these; and what the gas conducts over that between those.
    density: f64,
    more_contacts: f64,
    more_gas: f64,
}

/// The gas at a temperature.
pub(crate) struct GasThere {
    /// ln(R/h).
    pub number: f64,
    /// Whether that is outside of the range of the law.
    pub outside: bool,
    /// None in a vacuum.
    gas: Option<Gas>,
    temperature: f64,
}

/// Conductivity of a bed \[W/(m K)\], and the parts of it by gas and radiation.
pub(crate) struct Conductivity {
    pub tensor: Tensor,
    pub gas: f64,
    pub radiation: f64,
}

// Below the law's range the closure goes on from its end.
const _: () = assert!(GAS_RANGE[0] == MIN_NUMBER);

/// Solid fraction of a bed next to a wall, which hardly matters for the part of radiation in its conductivity.
const REFERENCE_SOLID: f64 = 0.6;

/// Least number of contacts per sphere of a packing that carries load.
const MIN_CONTACTS: f64 = 2.0;

/// A value within its range.
pub(crate) fn ranged(name: &str, value: f64, [low, high]: [f64; 2], allowed: &str) -> Result<f64, Failure> {
    match (low..=high).contains(&value) {
        true => Ok(value),
        false => Err(Failure::number(name.to_string(), value, allowed)),
    }
}

/// k \[W/(m K)\] of a body called `of`.
pub(crate) fn conductivity(of: &str, value: f64) -> Result<f64, Failure> {
    ranged(&format!("{of}.conductivity"), value, [1e-12, 1e12], "1e-12 to 1e12 W/(m K)")
}

/// (1 − ν²)/E \[1/Pa\].
pub(crate) fn compliance(of: &str, young: f64, poisson: f64) -> Result<f64, Failure> {
    let young = ranged(&format!("{of}.young_modulus"), young, [1e-9, 1e15], "1e-9 to 1e15 Pa")?;
    let poisson = ranged(&format!("{of}.poisson_ratio"), poisson, [-0.99, 0.5], "-0.99 to 0.5")?;
    Ok((1.0 - poisson * poisson) / young)
}

/// None for a smooth surface.
pub(crate) fn roughness(of: &str, height: f64, hardness: f64) -> Result<Option<Roughness>, Failure> {
    let height_over_slope = ranged(&format!("{of}.roughness"), height, [0.0, 1.0], "0 to 1 m; 0 is smooth")?;
    if height_over_slope == 0.0 {
        return Ok(None);
    }
    let hardness = ranged(&format!("{of}.hardness"), hardness, [1.0, 1e15], "1 to 1e15 Pa")?;
    Ok(Some(Roughness { height_over_slope, hardness }))
}

impl Material {
    /// Checks the numbers.
    pub fn new(grains: &Grains) -> Result<Self, Failure> {
        const OF: &str = "material";
        let given = &grains.numbers;
        let radius = ranged("material.radius", given.radius, [5e-10, 500.0], "5e-10 to 500 m")?;
        let effective_modulus = 0.5 / compliance(OF, given.young_modulus, given.poisson_ratio)?;
        let conductivity = conductivity(OF, given.conductivity)?;
        let roughness = roughness(OF, given.roughness, given.hardness)?;
        let gas = match &grains.gas {
            None => GasName::Vacuum,
            Some(name) => named("material.gas", name)?,
        };
        let (mut gas_pressure, mut accommodation) = (1.0, 1.0);
        if gas != GasName::Vacuum {
            gas_pressure =
                ranged("material.gas_pressure", given.gas_pressure, [1e-3, 1e9], "1e-3 to 1e9 Pa")?;
            accommodation = ranged("material.accommodation", given.accommodation, [0.01, 1.0], "0.01 to 1")?;
        }
        let emissivity =
            ranged("material.emissivity", given.emissivity, [0.0, 1.0], "0 to 1; 0: without radiation")?;
        let allowed = format!("0 to {MAX_SPREAD}");
        let spread = ranged("material.size_spread", given.size_spread, [0.0, MAX_SPREAD], &allowed)?;
        let solid = Solid { conductivity, effective_modulus, roughness };
        let bed = BedMaterial { radius, solid, gas, gas_pressure, accommodation };
        Ok(Self {
            bed,
            emissivity,
            density: equal_density(spread),
            more_contacts: more_contacts(spread),
            more_gas: gas_factor(spread),
        })
    }

    /// k_s \[W/(m K)\].
    pub fn solid_conductivity(&self) -> f64 {
        self.bed.solid.conductivity
    }

    /// The same with this k_s and ε.
    pub fn with(mut self, conductivity: f64, emissivity: f64) -> Self {
        (self.bed.solid.conductivity, self.emissivity) = (conductivity, emissivity);
        self
    }

    /// ε.
    pub fn emissivity(&self) -> f64 {
        self.emissivity
    }

    /// φ of equal spheres with the properties of these, over φ of these.
    pub fn density(&self) -> f64 {
        self.density
    }

    /// Contacts per sphere of equal spheres with the properties of these, less those counted in a poured bed of these.
    pub fn more_contacts(&self) -> f64 {
        self.more_contacts
    }

    pub fn bed(&self) -> &BedMaterial {
        &self.bed
    }

    /// E* \[Pa\].
    pub fn modulus(&self) -> f64 {
        self.bed.solid.effective_modulus
    }

    /// The gas at a temperature \[K\].
    pub fn gas(&self, temperature: f64) -> Result<GasThere, Failure> {
        let Some(gas) = self.bed.gas_at(temperature) else {
            return Ok(GasThere { number: GAS_RANGE[1], outside: false, gas: None, temperature });
        };
        if self.bed.ratio(&gas) < MIN_RATIO {
            let least =
                format!("at least that of the gas, which is {:.4} at {temperature} K", gas.conductivity);
            return Err(Failure::number("material.conductivity", self.bed.solid.conductivity, least));
        }
        let number = self.bed.gas_number(&gas);
        let [coldest, hottest] = self.bed.gas.range();
        let outside = !self.bed.knows(&gas, GAS_RANGE) || temperature < coldest || temperature > hottest;
        Ok(GasThere { number, outside, gas: Some(gas), temperature })
    }

    /// What a bed that conducts this \[W/(m K)\] at a temperature exchanges with a wall.
    pub fn radiating(&self, temperature: f64, conductivity: f64) -> Radiating {
        if self.emissivity == 0.0 {
            return Radiating::NONE;
        }
        let gas = self.bed.gas_at(temperature).map_or(0.0, |gas| gas.conductivity);
        let black = black(temperature, 2.0 * self.bed.radius);
        let bed =
            Dark { conductivity, solid: self.bed.solid.conductivity, gas, solid_fraction: REFERENCE_SOLID };
        Radiating { emissivity: 0.0, black, bed: part(&bed, black, self.emissivity) }
    }

    /// Conductivity of a bed for which the law answers this, as the cell of a block.
    pub fn conductivity(&self, answers: &Answers, cell: usize, gas: &GasThere) -> Conductivity {
        let [xx, yy, zz, ..] = &answers.stress;
        let solid_fraction = answers.solid[cell] / self.density;
        let conduction = self.bed.conduction(
            gas.gas.as_ref(),
            &BedState {
                pressure: (xx[cell] + yy[cell] + zz[cell]) / 3.0 * self.modulus(),
                solid_fraction,
                coordination: answers.coordination[cell].max(MIN_CONTACTS),
                gas: answers.gas[cell] * self.more_gas,
            },
        );
        let solid = self.bed.solid.conductivity * conduction.contacts;
        let normal = |k: usize| if k < 3 { conduction.gas } else { 0.0 };
        let mut tensor: Tensor = std::array::from_fn(|k| {
            let of_gas = normal(k) + conduction.gas_of_pairs * answers.gas_deviator[k][cell];
            solid * answers.contact[k][cell] + of_gas
        });
        let mut radiation = 0.0;
        if self.emissivity > 0.0 {
            let dark = Dark {
                conductivity: (tensor[0] + tensor[1] + tensor[2]) / 3.0,
                solid: self.bed.solid.conductivity,
                gas: gas.gas.map_or(0.0, |gas| gas.conductivity),
                solid_fraction,
            };
            radiation = dark.radiation(black(gas.temperature, 2.0 * self.bed.radius), self.emissivity);
            tensor[..3].iter_mut().for_each(|along| *along += radiation);
        }
        Conductivity { tensor, gas: conduction.gas, radiation }
    }
}

/// The gas that a key called `key` names.
pub(crate) fn named(key: &str, name: &str) -> Result<GasName, Failure> {
    let known = GasName::ALL.into_iter().find(|gas| gas.to_string() == name);
    known.ok_or_else(|| Failure::argument(key, name, GasName::ALL.map(|gas| gas.to_string()).join(", ")))
}
