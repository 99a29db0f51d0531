//! Conductivities as functions of a state of the law.
//!
//! K = k_s κ_c + k_g κ_g. By contacts, κ_c = C (p/E*)^(1/3) in the mean, which is the conductance 2 a k of Hertz's contacts
//! (Batchelor and O'Brien, 1977, Proc. R. Soc. A 355:313), with more of it along the larger stress and along more contacts. C grows
//! with the number of contacts. By gas, κ_g depends on the solid fraction, the number of contacts, and one number of the gas, ln(R/h).

use super::components::{six, three};
use super::contacts::{Contacts, HARDLY};
use super::number::Number;
use super::state::{FABRIC, State};
use super::tensor::{Tensor, contraction, mean, scaled};
use serde::{Deserialize, Serialize};

/// Numbers ln(R/h) of the gas for which κ_g is known: h is the width of the gap at a contact, for heat.
pub const GAS_NUMBERS: [f64; 3] = [3.5, 6.0, 8.5];
/// Numbers of gas for which κ_g may be asked: parabolas through the three known ones.
pub const GAS_RANGE: [f64; 2] = [2.5, 9.5];

/// Coefficients. s = √v, x = φ_J − 0.6, y = φ − 0.6, n = z − 5.5 with the contacts per sphere z, and
///
/// m = z_b + z_r v/(v + 0.001) − 5.5, with the contacts z_b that carry load and those z_r of grains that only rest on others, which come
/// to carry as the packing is pressed, see [`super::contacts::Usual`];
///
/// q = r²/(r² + 0.003), with the length r of the stress ratio that friction carries: forces of a packing that was sheared are less even.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Readout {
    /// C: coefficients of 1, m, s, x, q.
    pub contact: [f64; 5],
    /// Deviator of κ_c over its mean: coefficients of η without the fabric's part, and of that.
    pub direction: [f64; 2],
    /// κ_g in the mean at each of [`GAS_NUMBERS`]: coefficients of 1, y, y², v, s y, n, n s, o, g with o = 1/(1 + v/1.5e-4) and the
    /// part g of the friction that is not mobilised.
    pub gas: [[f64; 9]; 3],
    /// Deviator of κ_g over its mean: coefficient of the fabric's part of η, because near pairs point where contacts do.
    pub gas_direction: f64,
}

/// Least and largest κ_g: those of grains that do not touch, and far above all packings.
const GAS: [f64; 2] = [1.0, 100.0];
/// Largest length of the deviator of κ_c and κ_g over their means, so that the conductivity is positive in every direction.
const MAX_DEVIATOR: f64 = 0.7;

/// Largest compression, least and largest numbers of contacts, and solid fractions less 0.6, of the training, roughly.
const MAX_COMPRESSION: f64 = 0.15;
const CONTACTS: [f64; 2] = [2.0, 9.0];
const SOLID: [f64; 2] = [-0.1, 0.15];

/// √v, v and n.
#[inline(always)]
fn common<N: Number>(state: &State<N>) -> [N; 3] {
    let v = state.compression.not_below(0.0).not_above(MAX_COMPRESSION);
    let contacts = state.coordination.not_below(CONTACTS[0]).not_above(CONTACTS[1]);
    [v.root(), v, contacts.plus(-REFERENCE_CONTACTS)]
}

#[inline(always)]
pub fn contact_row<N: Number>(contacts: &Contacts, state: &State<N>) -> [N; 5] {
    let ([s, v, _], [borne, _]) = (common(state), directions(state));
    let square = contraction(&borne, &borne);
    let sheared = square * square.plus(SHEARED).inverse();
    let resting = contacts.usual(state).resting(state.coordination);
    let still = v.times(1.0 / PRESSED).plus(1.0).inverse();
    let conducting = (state.coordination - resting * still).not_below(CONTACTS[0]).not_above(CONTACTS[1]);
    [N::constant(1.0), conducting.plus(-REFERENCE_CONTACTS), s, state.density(), sheared]
}

/// η without the fabric's part, and that.
#[inline(always)]
pub fn directions<N: Number>(state: &State<N>) -> [Tensor<N>; 2] {
    let (all, fabric) = (state.ratio(), state.ratios[FABRIC]);
    [six!(k => all[k] - fabric[k]), fabric]
}

/// κ_c over its mean, with the coefficients of [`Readout::direction`].
#[inline(always)]
pub fn relative<N: Number>([of_elastic, of_fabric]: &[f64; 2], state: &State<N>) -> Tensor<N> {
    let [elastic, fabric] = directions(state);
    let ratio: Tensor<N> = six!(k => elastic[k].times(*of_elastic) + fabric[k].times(*of_fabric));
    let length = contraction(&ratio, &ratio).root();
    let limit = length.not_below(MAX_DEVIATOR).inverse().times(MAX_DEVIATOR);
    let [xx, yy, zz, xy, xz, yz] = scaled(&ratio, limit);
    [xx.plus(1.0), yy.plus(1.0), zz.plus(1.0), xy, xz, yz]
}

#[inline(always)]
pub fn gas_row<N: Number>(state: &State<N>) -> [N; 9] {
    let [s, v, n] = common(state);
    let y = state.solid().plus(-0.6).not_below(SOLID[0]).not_above(SOLID[1]);
    let hardly = v.times(1.0 / HARDLY).plus(1.0).inverse();
    [N::constant(1.0), y, y * y, v, s * y, n, n * s, hardly, state.unmobilised()]
}

/// Compression at which grains that only rest on others conduct half as well as those that carry.
const PRESSED: f64 = 1e-3;
/// Square of the stress ratio that friction carries at which half of what shear does to C is done.
const SHEARED: f64 = 0.003;
/// Contacts per sphere from which n and m are counted.
const REFERENCE_CONTACTS: f64 = 5.5;

#[inline(always)]
fn product<N: Number, const M: usize>(row: &[N; M], coefficients: &[f64; M]) -> N {
    let mut sum = row[0].times(coefficients[0]);
    for k in 1..M {
        sum = sum + row[k].times(coefficients[k]);
    }
    sum
}

impl Readout {
    /// κ_c of a state with this stress over E*; 0 without load.
    #[inline(always)]
    pub fn contact<N: Number>(&self, contacts: &Contacts, state: &State<N>, stress: &Tensor<N>) -> Tensor<N> {
        let (pressure, zero) = (mean(*stress), N::constant(0.0));
        let per_root = product(&contact_row(contacts, state), &self.contact).not_below(MIN_CONTACT);
        let size = per_root * pressure.not_below(MIN_PRESSURE).power(1.0 / 3.0);
        let size = pressure.where_above(zero, size, zero);
        let [xx, yy, zz, xy, xz, yz] = scaled(&relative(&self.direction, state), size);
        // The sums with zero make it 0, and not −0, where there is no load.
        [xx, yy, zz, xy + zero, xz + zero, yz + zero]
    }

    /// κ_g at each of [`GAS_NUMBERS`].
    #[inline(always)]
    pub fn gases<N: Number>(&self, state: &State<N>) -> [N; 3] {
        let row = gas_row(state);
        three!(k => product(&row, &self.gas[k]).not_below(GAS[0]).not_above(GAS[1]))
    }

    /// The deviator of κ_g over its mean.
    #[inline(always)]
    pub fn gas_deviator<N: Number>(&self, state: &State<N>) -> Tensor<N> {
        let fabric = scaled(&state.ratios[FABRIC], N::constant(self.gas_direction));
        let length = contraction(&fabric, &fabric).root();
        let limit = length.not_below(MAX_DEVIATOR).inverse().times(MAX_DEVIATOR);
        scaled(&fabric, limit)
    }

    /// κ_g in the mean at a number of the gas.
    #[inline(always)]
    pub fn gas<N: Number>(&self, state: &State<N>, number: N) -> N {
        let [a, b, c] = GAS_NUMBERS;
        let [low, high] = GAS_RANGE;
        let n = number.not_below(low).not_above(high);
        let [of_a, of_b, of_c] = self.gases(state);
        let [to_a, to_b, to_c] = [n.plus(-a), n.plus(-b), n.plus(-c)];
        let sum = of_a * (to_b * to_c).times(1.0 / ((a - b) * (a - c)))
            + of_b * (to_a * to_c).times(1.0 / ((b - a) * (b - c)))
            + of_c * (to_a * to_b).times(1.0 / ((c - a) * (c - b)));
        sum.not_below(GAS[0])
    }
}

/// Least p/E* of which a root is taken.
const MIN_PRESSURE: f64 = 1e-100;
/// Least C: a third of that of the loosest packings.
const MIN_CONTACT: f64 = 0.25;
