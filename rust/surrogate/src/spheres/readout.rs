//! Conductivities as functions of a state of the law.
//!
//! K = k_s κ_c + k_g κ_g. By contacts, κ_c = C (p/E*)^(1/3) in the mean, which is the conductance 2 a k of Hertz's contacts
//! (Batchelor and O'Brien, 1977, Proc. R. Soc. A 355:313), with more of it along the larger stress and along more contacts. C grows
//! with the number of contacts. By gas, κ_g depends on the solid fraction, the number of contacts, and one number of the gas, ln(R/h).

use super::state::{FABRIC, State};
use super::tensor::{Tensor, contraction, mean};
use serde::{Deserialize, Serialize};

/// Numbers ln(R/h) of the gas for which κ_g is known: h is the width of the gap at a contact, for heat.
pub const GAS_NUMBERS: [f64; 3] = [3.5, 6.0, 8.5];
/// Numbers of gas for which κ_g may be asked: parabolas through the three known ones.
pub const GAS_RANGE: [f64; 2] = [2.5, 9.5];

/// Coefficients. s = √v, x = φ_J − 0.6, y = φ − 0.6, r = |η|, n = z − 5.5 with the contacts per sphere z, and the part g of the
/// friction that is not mobilised.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Readout {
    /// C: coefficients of 1, n, n², s, v, n s, x, r, g, g n.
    pub contact: [f64; 10],
    /// Deviator of κ_c over its mean: coefficients of η without the fabric's part, and of that.
    pub direction: [f64; 2],
    /// κ_g at each of [`GAS_NUMBERS`]: coefficients of 1, y, y², s, v, s y, n, n s.
    pub gas: [[f64; 8]; 3],
}

/// Least and largest κ_g: those of grains that do not touch, and far above all packings.
const GAS: [f64; 2] = [1.0, 100.0];
/// Largest length of the deviator of κ_c over its mean, so that the conductivity is positive in every direction.
const MOST_DEVIATOR: f64 = 0.7;

/// Largest compression, least and largest numbers of contacts, and solid fractions less 0.6, of the training, roughly.
const MOST_COMPRESSION: f64 = 0.15;
const CONTACTS: [f64; 2] = [2.0, 9.0];
const SOLID: [f64; 2] = [-0.1, 0.15];

/// √v, v and n.
fn common(state: &State) -> [f64; 3] {
    let v = state.compression.clamp(0.0, MOST_COMPRESSION);
    [v.sqrt(), v, state.coordination.clamp(CONTACTS[0], CONTACTS[1]) - USUAL_CONTACTS]
}

pub fn contact_row(state: &State) -> [f64; 10] {
    let ([s, v, n], ratio, free) = (common(state), state.ratio(), state.free());
    [1.0, n, n * n, s, v, n * s, state.density(), contraction(&ratio, &ratio).sqrt(), free, free * n]
}

/// η without the fabric's part, and that.
pub fn directions(state: &State) -> [Tensor; 2] {
    let (all, fabric) = (state.ratio(), state.ratios[FABRIC]);
    [std::array::from_fn(|k| all[k] - fabric[k]), fabric]
}

/// κ_c over its mean, with the coefficients of [`Readout::direction`].
pub fn relative([of_elastic, of_fabric]: &[f64; 2], state: &State) -> Tensor {
    let [elastic, fabric] = directions(state);
    let ratio: Tensor = std::array::from_fn(|k| of_elastic * elastic[k] + of_fabric * fabric[k]);
    let length = contraction(&ratio, &ratio).sqrt();
    let limit = if length > MOST_DEVIATOR { MOST_DEVIATOR / length } else { 1.0 };
    std::array::from_fn(|k| f64::from(u8::from(k < 3)) + limit * ratio[k])
}

pub fn gas_row(state: &State) -> [f64; 8] {
    let [s, v, n] = common(state);
    let y = (state.solid() - 0.6).clamp(SOLID[0], SOLID[1]);
    [1.0, y, y * y, s, v, s * y, n, n * s]
}

/// Contacts per sphere from which n is counted.
const USUAL_CONTACTS: f64 = 5.5;

fn product<const M: usize>(row: &[f64; M], coefficients: &[f64; M]) -> f64 {
    row.iter().zip(coefficients).map(|(a, b)| a * b).sum()
}

impl Readout {
    /// κ_c of a state with this stress over E*; 0 without load.
    pub fn contact(&self, state: &State, stress: &Tensor) -> Tensor {
        let pressure = mean(*stress);
        if pressure <= 0.0 {
            return [0.0; 6];
        }
        let size = product(&contact_row(state), &self.contact).max(LEAST_CONTACT) * libm::cbrt(pressure);
        relative(&self.direction, state).map(|part| size * part)
    }

    /// κ_g at each of [`GAS_NUMBERS`].
    pub fn gases(&self, state: &State) -> [f64; 3] {
        let row = gas_row(state);
        self.gas.map(|coefficients| product(&row, &coefficients).clamp(GAS[0], GAS[1]))
    }

    /// κ_g at a number of the gas.
    pub fn gas(&self, state: &State, number: f64) -> f64 {
        let [a, b, c] = GAS_NUMBERS;
        let [low, high] = GAS_RANGE;
        let n = number.clamp(low, high);
        let weights = [
            (n - b) * (n - c) / ((a - b) * (a - c)),
            (n - a) * (n - c) / ((b - a) * (b - c)),
            (n - a) * (n - b) / ((c - a) * (c - b)),
        ];
        product(&self.gases(state), &weights).max(GAS[0])
    }
}

/// Least C: a third of that of the loosest packings.
const LEAST_CONTACT: f64 = 0.25;
