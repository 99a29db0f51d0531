//! The law of a packing of spheres, as in [`super`].

use super::components::six;
use super::contacts::{Contacts, HARDLY, Usual};
use super::number::Number;
use super::state::{ELEMENTS, FABRIC, MIN_COMPRESSION, State};
use super::tensor::{Rotation, Tensor, contraction, deviator, scaled, square, sum, turned};
use crate::kernel::elementary;
use crate::kernel::vector::{Arithmetic, part};
use serde::{Deserialize, Serialize};

/// The element with whose sliding goes the dilatancy. In all but the loosest packings it slides first, and its sliding is nearly the
/// whole shear strain.
const FIRST: usize = 1;

/// Numbers of the law. Stresses are over E*, compression positive; x is the solid fraction at jamming less 0.6, u = v/0.005.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Law {
    /// A = b₀ e^(b₁ x + b₂ g + b₆ g o) v^(3/2) (1 + √u)^(b₃ + b₄ g + b₅ x), with the part g of the friction that is not mobilised
    /// and o = 1/(1 + v/1.5e-4).
    pub bulk: [f64; 7],
    /// Stiffnesses of the elements of friction go with e^(`shear`₀ x + `shear`₂ g) u^`shear`₁.
    pub shear: [f64; 3],
    /// z₀: contacts per sphere of a packing whose fabric does not turn.
    pub least_contacts: f64,
    /// α: the part of the fabric's forgetting that does not wait until the fabric is near its strength, see `reoriented`.
    pub forgetting: f64,
    pub elements: [Element; ELEMENTS],
    /// Loss of compression by a unit of sliding of the second element: d₀ + d₁ x + d₂ g − (d₃ + d₄ x) η_f·n, with the stress ratio of the fabric η_f and the
    /// direction n of sliding; negative where grains climb over each other. Beside it the fabric changes the compression without
    /// sliding, see [`super`].
    pub dilatancy: [f64; 5],
    /// Loss of compression by a unit of that sliding next to it, of packings whose friction is mobilised and that hardly carry load:
    /// (1 − g)^c₃ c₀ e^(−c₁ x) u^(−c₂).
    pub collapse: [f64; 4],
    /// Growth of the mobilised friction by sliding: dg = −m g ds/(v + 5e-5).
    pub mobilising: f64,
    /// Loss of compression by a unit of opening: s₀/(1 + (v/v₀)²) + s₃ (1 − g), v₀ = s₁ e^(−s₂ x). The first is that of packings
    /// that are about to lose their load, the second that of all whose friction is mobilised.
    #[serde(rename = "settling")]
    pub opening_densification: [f64; 4],
    /// Stress ratio of the fabric over the deviator of the fabric, and its usual part of the stress ratio, for packings whose
    /// fabric is not known.
    pub fabric: [f64; 2],
    /// Λ: the deviator of the stress over A is η + Λ dev(η η), with the stress ratio η = Σ η_k.
    pub lode: f64,
    pub contacts: Contacts,
}

/// A part of the deviator.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Element {
    /// Growth of the stress ratio by a unit of shear strain over v, at x = 0 and u = 1. Of the fabric: over v_f, for each
    /// contact per sphere beyond [`Law::least_contacts`], at any x, u and g.
    pub stiffness: f64,
    /// The stress ratio is at most `strength` e^(`growth` x + `free` g) min(√u, 1)^`hardening`.
    pub strength: f64,
    pub growth: f64,
    #[serde(rename = "free")]
    pub unmobilised: f64,
    pub hardening: f64,
    /// The stress ratio goes with this power of v where the packing is compressed without shear: 0 where new contacts have the
    /// directions of the old ones, −1 where none are made.
    pub power: f64,
}

/// A usual elastic compression, over which u is counted.
const REFERENCE_COMPRESSION: f64 = 0.005;
/// Largest v: far beyond the elasticity of real grains.
pub(super) const MAX_COMPRESSION: f64 = 0.5;
/// Largest work of grains that climb over that of friction.
const MAX_CLIMBING: f64 = 0.9;
/// Length of a stress ratio over its strength from which an element slides: so little above 1 that a state which slides
/// stays as it is when it is evaluated again.
const SLACK: f64 = 1.0 + 1e-9;
/// Added to squares of lengths before their root is taken, so that its derivative exists.
const TINY: f64 = 1e-30;
/// Largest factor of the strengths of friction.
pub(super) const MAX_OF_FRICTION: f64 = 2.0;
/// Largest [`State::strength`]: there friction is twice as strong as it usually is, and the fabric four times.
pub const MAX_STRENGTH: f64 = 8.0;
/// Least part of mobilised friction of which a power is taken.
const MIN_MOBILISED: f64 = 1e-6;
/// Added to v where sliding is counted over it.
const SOFT: f64 = 5e-5;
/// Contacts per sphere over which the fabric's stiffness goes from none to its slope.
const ROUNDING: f64 = 0.2;
/// Largest exponent of the exponential functions of x.
const MAX_EXPONENT: f64 = 8.0;

/// Strain of an increment: growth of the radii positive, extension of the cell positive; xy, xz, yz are twice the shears.
#[derive(Clone, Copy, Debug)]
pub struct Strain<N: Number = f64> {
    pub thermal: N::Values,
    pub cell: Tensor<N>,
}

impl Law {
    #[inline(always)]
    fn exponential<N: Number>(x: N, rate: f64) -> N {
        x.times(rate).not_below(-MAX_EXPONENT).not_above(MAX_EXPONENT).exp()
    }

    /// v, and u, between bounds.
    #[inline(always)]
    pub(super) fn compressions<N: Number>(compression: N) -> (N, N) {
        let v = compression.not_below(MIN_COMPRESSION).not_above(MAX_COMPRESSION);
        (v, v.times(1.0 / REFERENCE_COMPRESSION))
    }

    /// A: the pressure over E* without shear.
    #[inline(always)]
    pub fn pressure<N: Number>(&self, compression: N, x: N, unmobilised: N) -> N {
        let (v, u) = Self::compressions(compression);
        let [b0, b1, b2, b3, b4, b5, b6] = self.bulk;
        let hardly = v.times(1.0 / HARDLY).plus(1.0).inverse();
        let contacts = u.root().plus(1.0).ln();
        let exponent = x.times(b1)
            + unmobilised * hardly.times(b6).plus(b2)
            + contacts * (unmobilised.times(b4) + x.times(b5)).plus(b3);
        (exponent.exp() * v * v.root()).times(b0)
    }

    /// The factor that the stiffnesses of all elements of friction have next to [`Element::stiffness`], by ln u.
    #[inline(always)]
    pub(super) fn stiffening<N: Number>(&self, x: N, unmobilised: N, loaded: N) -> N {
        let [of_density, power, of_unmobilised] = self.shear;
        let exponent = (x.times(of_density) + unmobilised.times(of_unmobilised))
            .not_below(-MAX_EXPONENT)
            .not_above(MAX_EXPONENT);
        (exponent + loaded.times(power)).exp()
    }

    /// c: the stiffness of the fabric's element, [`Element::stiffness`] (z_b − z₀) where there are contacts enough, and smoothly none
    /// below, with the contacts z_b of [`Usual::bearing`].
    #[inline(always)]
    fn turning<N: Number>(&self, bearing: N) -> N {
        let more = bearing.plus(-self.least_contacts);
        let length = (more * more).plus(ROUNDING * ROUNDING).root();
        (more + length).times(0.5 * self.elements[FABRIC].stiffness)
    }

    /// ln u.
    #[inline(always)]
    pub(super) fn loaded<N: Number>(compression: N) -> N {
        Self::compressions(compression).1.ln()
    }

    /// Strength of an element, by ln u.
    #[inline(always)]
    pub(super) fn strength<N: Number>(&self, k: usize, x: N, unmobilised: N, loaded: N) -> N {
        let Element { strength, growth, unmobilised: of_unmobilised, hardening, .. } = self.elements[k];
        let exponent = x.times(growth)
            + unmobilised.times(of_unmobilised)
            + loaded.not_above(0.0).times(0.5 * hardening);
        exponent.not_below(-MAX_EXPONENT).not_above(MAX_EXPONENT).exp().times(strength)
    }

    /// The factor of an element's strength in a packing with this [`State::strength`]: friction is as strong as that, up to twice as
    /// strong as it usually is, and beyond that the fabric is stronger.
    #[inline(always)]
    pub(super) fn factor<V: Arithmetic>(k: usize, strength: V) -> V {
        let most = V::all(MAX_OF_FRICTION);
        if k == FABRIC { (strength / most).at_least(V::all(1.0)) } else { strength.at_most(most) }
    }

    /// σ over E*, compression positive.
    #[inline(always)]
    pub fn stress<N: Number>(&self, state: &State<N>) -> Tensor<N> {
        let (x, unmobilised) = (state.density(), state.unmobilised());
        let (least, zero) = (N::constant(MIN_COMPRESSION), N::constant(0.0));
        let pressure = self.pressure(state.compression, x, unmobilised);
        let pressure = state.compression.where_above(least, pressure, zero);
        // The sums with zero make it 0, and not −0, where there is no pressure.
        let [xx, yy, zz, xy, xz, yz] = scaled(&self.deviator(&state.ratio()), pressure);
        [xx + pressure, yy + pressure, zz + pressure, xy + zero, xz + zero, yz + zero]
    }

    /// Deviator of the stress over A, of the stress ratio η: η + Λ dev(η η). The strengths of the elements are lengths of tensors, the
    /// same in all directions; by the second term a packing carries a larger deviator where one axis is compressed than where two are, and
    /// where one is compressed as another is extended the third carries less than the mean. So it is in soils (Lade, 1977, Int. J. Solids
    /// Struct. 13:1019) and in boxes of spheres (Thornton, 2000, Géotechnique 50:43). Named after the angle of Lode, which distinguishes these
    /// directions apart.
    #[inline(always)]
    pub fn deviator<N: Number>(&self, ratio: &Tensor<N>) -> Tensor<N> {
        let second = deviator(square(ratio));
        six!(k => ratio[k] + second[k].times(self.lode))
    }

    /// State after a strain, in substeps. `half` is half of the cell's rotation.
    #[inline(always)]
    pub fn advanced<N: Number>(
        &self,
        state: &State<N>,
        strain: &Strain<N>,
        half: &Rotation<N::Values>,
    ) -> State<N> {
        let mut next = *state;
        turn(&mut next.ratios, half);
        let [xx, yy, zz, xy, xz, yz] = strain.cell;
        let cell = [xx, yy, zz, xy.times(0.5), xz.times(0.5), yz.times(0.5)];
        let square = square(&cell);
        let count = substeps(state.compression.value(), strain.thermal, six!(k => strain.cell[k].value()));
        let share = N::Values::all(1.0) / count;
        let mut usual = self.contacts.usual(&next);
        for number in 0..MAX_SUBSTEPS {
            // Cells with fewer substeps stay as they are.
            let number = N::Values::all(f64::from(number));
            if !count.any_greater(number) {
                break;
            }
            // Equal parts of the whole, E/n (1 + k E/n)⁻¹, which compose to it; of the cell to the second order.
            let thermal = strain.thermal / (strain.thermal * number + count);
            let second = number * share * share;
            let cell: Tensor<N> = six!(c => cell[c].by(share) - square[c].by(second));
            substep(self, &mut next, &mut usual, thermal, &cell, [count, number]);
        }
        turn(&mut next.ratios, half);
        next
    }

    /// Strains the cells in which the first of `more` is larger than the second; `usual` is that of the state.
    #[inline(always)]
    fn substep<N: Number>(
        &self,
        next: &mut State<N>,
        usual: &mut Usual<N>,
        thermal: N::Values,
        cell: &Tensor<N>,
        more: [N::Values; 2],
    ) {
        let mut reached = self.part(next, usual, thermal, cell);
        let usual_there = self.contacts.usual(&reached);
        reached.coordination = self.contacts.after([next, &reached], [usual, &usual_there], cell);
        *next = State::where_greater(more, &reached, next);
        *usual = usual_there;
    }

    /// Loss of compression by a unit of sliding of the second element, see [`Law::dilatancy`], along a tensor of this length; `loaded` is
    /// ln u where it is reached.
    #[inline(always)]
    fn lost<N: Number>(&self, state: &State<N>, loaded: N, (along, length): (&Tensor<N>, N)) -> N {
        let (x, unmobilised) = (state.density(), state.unmobilised());
        let [c0, c1, c2, c3] = self.collapse;
        let bound = unmobilised.times(-1.0).plus(1.0).not_below(MIN_MOBILISED);
        let dense = x.times(-c1).not_below(-MAX_EXPONENT).not_above(MAX_EXPONENT);
        let collapse = (dense - loaded.times(c2) + bound.ln().times(c3)).exp().times(c0);
        let [d0, d1, d2, d3, d4] = self.dilatancy;
        let always = (x.times(d1) + unmobilised.times(d2)).plus(d0) + collapse;
        let climbs = scaled(&state.ratios[FABRIC], x.times(d4).plus(d3));
        always - contraction(&climbs, along) * length.inverse()
    }

    /// After growth of the radii and a strain of the cell, whose shears are not doubled; `usual` is that of the state before.
    #[inline(always)]
    fn part<N: Number>(
        &self,
        state: &State<N>,
        usual: &Usual<N>,
        thermal: N::Values,
        strain: &Tensor<N>,
    ) -> State<N> {
        let [xx, yy, zz, xy, xz, yz] = *strain;
        // Growth of the volume of the cell, and of the grains.
        let second = xx * yy + yy * zz + zz * xx - (xy * xy + xz * xz + yz * yz);
        let third = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
        let cell = xx + yy + zz + second + third;
        let three = N::Values::all(3.0);
        let grains = thermal * three + thermal * thermal * (thermal + three);
        let denser = cell.times(-1.0).plus_values(grains) * cell.plus(1.0).inverse();
        let tried = state.compression + state.compression.plus(1.0) * denser;
        let (x, unmobilised) = (state.density(), state.unmobilised());
        let before = state.compression.not_below(MIN_COMPRESSION);
        let after = tried.not_below(MIN_COMPRESSION);
        let over = after.inverse();
        let opening = after * before.inverse();
        let distortion = deviator(*strain);
        let loaded = Self::loaded(after);
        let stiffening = self.stiffening(x, unmobilised, loaded);
        let opened = opening.ln();
        let mut ratios = state.ratios;
        let zero = N::constant(0.0);
        let [mut loss, mut sliding, mut work] = [zero; 3];
        // Lengths of the stress ratios of friction, and their strengths.
        let mut limits = [(zero, zero); FABRIC];
        for (k, ratio) in ratios.iter_mut().enumerate() {
            let most = self.strength(k, x, unmobilised, loaded).by(Self::factor(k, state.strength));
            if k == FABRIC {
                let stiffness = self.turning(usual.bearing(state.coordination)) * over_strain(after, usual);
                *ratio = reoriented(ratio, &distortion, stiffness, most, self.forgetting);
                continue;
            }
            let stiffness = stiffening.times(self.elements[k].stiffness);
            let power = self.elements[k].power;
            let faded = within(&scaled(ratio, opened.times(power).exp()), most).0;
            let added = scaled(&distortion, stiffness * over);
            let elastic: Tensor<N> = six!(c => faded[c] - added[c]);
            let length = contraction(&elastic, &elastic).plus(TINY).root();
            let excess = length.where_above(most.times(SLACK), length - most, zero);
            (*ratio, limits[k]) = (elastic, (length, most));
            let slid = excess * after * stiffness.inverse();
            sliding = sliding + slid;
            work = work + slid * most;
            if k == FIRST {
                loss = slid * self.lost(state, loaded, (&elastic, length));
            }
        }
        loss = loss.not_below_number(work.times(-MAX_CLIMBING));
        // What the stress of the fabric does is stored in the compression.
        let middle = sum(&state.ratios[FABRIC], &ratios[FABRIC]);
        loss = loss + contraction(&middle, &distortion).times(0.5);
        let [s0, s1, s2, s3] = self.opening_densification;
        let usual = Self::exponential(x, -s2).times(s1);
        let level = after * usual.inverse();
        let always = unmobilised.times(-s3).plus(s3);
        let settled = (state.compression - tried) * ((level * level).plus(1.0).inverse().times(s0) + always);
        let loss = (loss + state.compression.where_above(tried, settled, zero)).not_above_number(tried);
        let compression = tried - loss;
        // Contacts keep their directions where grains yield.
        let kept = (compression.not_below(MIN_COMPRESSION) * before.inverse()).ln();
        ratios[FABRIC] = scaled(&ratios[FABRIC], kept.times(self.elements[FABRIC].power).exp());
        let jamming = state.jamming + state.jamming * loss * compression.plus(1.0).inverse();
        // Where packings are about to lose their load, v is small compared with any sliding.
        let soft = after.plus(SOFT).inverse();
        let left = unmobilised * (sliding * soft).times(-self.mobilising).not_below(-MAX_EXPONENT).exp();
        let mobilised = left.times(-1.0).plus(1.0);
        // Strengths are those of the state that is reached, if it is weaker: else the next strain, however small, would change the
        // stress.
        let denser = jamming - state.jamming;
        let freer = left - unmobilised;
        let loosened = (loaded + kept - opened).not_above(0.0) - loaded.not_above(0.0);
        for (k, (length, most)) in limits.into_iter().enumerate() {
            let Element { growth, unmobilised: of_unmobilised, hardening, .. } = self.elements[k];
            let exponent =
                denser.times(growth) + freer.times(of_unmobilised) + loosened.times(0.5 * hardening);
            let limit = (most * near_exponential(exponent)).not_above_number(most);
            let one = N::constant(1.0);
            let factor = length.where_above(limit.times(SLACK), limit * length.inverse(), one);
            ratios[k] = scaled(&ratios[k], factor);
        }
        let after = State { jamming, compression, ratios, mobilised, ..*state };
        // Grains that do not touch forget the deviator.
        let apart = State { compression: tried, ratios: [[zero; 6]; ELEMENTS], ..*state };
        State::where_greater([tried.value(), N::Values::zero()], &after, &apart)
    }
}

part! {
    /// [`Law::substep`].
    by N::apart => fn substep<'a, N: Number>(
        law: &'a Law, next: &'a mut State<N>, usual: &'a mut Usual<N>, thermal: N::Values, cell: &'a Tensor<N>, more: [N::Values; 2],
    ) {
        law.substep(next, usual, thermal, cell, more);
    }
}
part! {
    /// [`turned`] of each.
    by N::apart => fn turn<'a, N: Number>(ratios: &'a mut [Tensor<N>; ELEMENTS], half: &'a Rotation<N::Values>) {
        for ratio in ratios {
            *ratio = turned(ratio, half);
        }
    }
}

/// 1/v_f, see [`super`].
#[inline(always)]
fn over_strain<N: Number>(v: N, usual: &Usual<N>) -> N {
    let least = usual.forgets.times(-HARDLY).plus(HARDLY);
    (v * v + least * least).root().inverse()
}

/// The exponential function to the fourth order, for exponents that are small but where nearly all load is lost.
#[inline(always)]
fn near_exponential<N: Number>(x: N) -> N {
    let third = x.times(0.25).plus(1.0) * x.times(1.0 / 3.0);
    let second = third.plus(1.0) * x.times(0.5);
    (second.plus(1.0) * x).plus(1.0)
}

/// The stress ratio of the fabric after a shear strain: dη = −c de/v_f − (c/M) (α + (1 − α) f²) η |de|/v_f with f = (η·t)₊/M and the
/// direction t of −de, so that it goes to its strength M along t; `stiffness` is c/v_f, `always` is α: with 1 it would be the rule of
/// Armstrong and Frederick, with 0 small cycles would hardly change the fabric.
#[inline(always)]
fn reoriented<N: Number>(
    ratio: &Tensor<N>,
    distortion: &Tensor<N>,
    stiffness: N,
    most: N,
    always: f64,
) -> Tensor<N> {
    let over = most.inverse();
    let size = contraction(distortion, distortion).plus(TINY).root();
    let near = (contraction(ratio, distortion) * (size * most).inverse()).times(-1.0).not_below(0.0);
    let forgets = (near * near).times(1.0 - always).plus(always);
    let rate = (stiffness * size * forgets * over).not_above(MAX_RATE);
    let (value, one) = (rate.value(), N::Values::all(1.0));
    let gone = elementary::exp_less_one(N::Values::zero() - value);
    let left = one + gone;
    let kept = rate.chain(left, N::Values::zero() - left);
    // (1 − e^(−rate))/rate.
    let least = N::constant(MIN_RATE);
    let ratio_of_gone = rate.chain(N::Values::zero() - gone, left) * rate.not_below(MIN_RATE).inverse();
    let share = rate.where_above(least, ratio_of_gone, rate.times(-0.5).plus(1.0));
    let added = share * stiffness;
    let reached: Tensor<N> = six!(c => ratio[c] * kept - distortion[c] * added);
    // A fabric that is beyond its strength returns by forgetting, not at once.
    let present = contraction(ratio, ratio).plus(TINY).root();
    within(&reached, most.not_below_number(present)).0
}

/// The exponent with which the fabric forgets in one part counts to the first order below this.
const MIN_RATE: f64 = 1e-6;
/// The largest such exponent: it forgets all.
const MAX_RATE: f64 = 30.0;

/// The size of a part of a strain over the elastic compression, at most; as long as there are not more than [`MAX_SUBSTEPS`].
const SUBSTEP: f64 = 0.1;
const MAX_SUBSTEPS: u32 = 16;

/// Number of equal substeps in which a strain is applied: the more, the larger what it strains the contacts is compared with the elastic
/// compression v, or the gap that is left where grains do not touch (v below 0), because stress and strengths follow from v.
#[inline(always)]
fn substeps<V: Arithmetic>(compression: V, thermal: V, cell: Tensor<V>) -> V {
    let [xx, yy, zz, xy, xz, yz] = cell;
    let (half, one, most) = (V::all(0.5), V::all(1.0), V::all(f64::from(MAX_SUBSTEPS)));
    let contacts = [xx - thermal, yy - thermal, zz - thermal, half * xy, half * xz, half * yz];
    let size = contraction(&contacts, &contacts).sqrt();
    let v = compression.abs().at_least(V::all(MIN_COMPRESSION));
    let needed = (size / (V::all(SUBSTEP) * v)).at_most(most);
    // The next integer.
    let (half, rounder) = (V::all(0.5), V::all(ROUNDER));
    let below = (needed - half + rounder) - rounder;
    needed.where_greater(below, below + one, below).at_least(one)
}

/// 2^52 and half of it, among numbers of which all are integers: a sum with it is rounded to one.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// The tensor, shortened to `most` where it is longer; then by how much it was longer, and its length.
#[inline(always)]
pub(super) fn within<N: Number>(tensor: &Tensor<N>, most: N) -> (Tensor<N>, N, N) {
    let length = contraction(tensor, tensor).plus(TINY).root();
    let (limit, one, zero) = (most.times(SLACK), N::constant(1.0), N::constant(0.0));
    let factor = length.where_above(limit, most * length.inverse(), one);
    (scaled(tensor, factor), length.where_above(limit, length - most, zero), length)
}
