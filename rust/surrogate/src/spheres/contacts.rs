//! The number of contacts per sphere along a path of strain.
//!
//! z = z̄ + ζ: the number z̄ of boxes that were sheared, or whose friction is mobilised, which is a function of compression and
//! density; and what a packing has more than that, ζ. Packings that were made with less friction than they have afterwards have more
//! contacts where they are neither hardly nor much compressed, in proportion to the part g of their friction that is not mobilised and to
//! h = 4 w/(1 + w)², w = v/0.005. Where h grows with the compression v,
//!
//! dζ = S g dh − F a ζ |dv|/v,
//!
//! and where it falls, dζ = (F ζ/h + (1 − F) S g) dh: contacts that are lost when a packing opens come back when it closes. Shear makes it
//! forget them, dζ = −F b ζ |de|/v with the deviator de of the strain. F = 1/(1 + (0.25/g)¹⁶) is 0 where nearly all friction is mobilised,
//! as in beds that were poured: these have more contacts than boxes because grains without load rest on others, and keep them.

use super::number::Number;
use super::state::{MIN_COMPRESSION, State};
use super::tensor::{Tensor, contraction, deviator};
use serde::{Deserialize, Serialize};

/// Number of coefficients of z̄.
pub const COEFFICIENTS: usize = 6;

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Contacts {
    /// z̄: coefficients of [`row`].
    pub sheared: [f64; COEFFICIENTS],
    /// S.
    pub surplus: f64,
    /// a and b.
    pub fading: [f64; 2],
}

/// The elastic compression at which packings have the most contacts beyond z̄.
const LEVEL: f64 = 5e-3;
/// Added to h before a ratio of two is taken.
const MIN_SHARE: f64 = 1e-3;
/// The part of the friction that is not mobilised below which a packing keeps ζ.
const KEEPING: f64 = 0.25;
/// How sharply: the power 16, by so many squares.
const SHARPLY: u32 = 4;
/// Least part of which that power is taken.
const MIN_FREE: f64 = 1e-3;
/// Largest exponent with which shear makes ζ forgotten in one part of a strain.
const MAX_EXPONENT: f64 = 8.0;
/// Compression below which packings have fewer contacts the less they are compressed.
pub(super) const HARDLY: f64 = 1.5e-4;
/// Largest S.
pub(super) const MAX_SURPLUS: f64 = 10.0;
/// Most contacts per sphere of grains that only rest on others: as many as beds that were poured with little friction have.
const MAX_RESTING: f64 = 0.6;
/// Bounds of z: none has more than equal spheres of the densest packings.
const CONTACTS: [f64; 2] = [0.0, 12.0];
/// Added to squares of lengths before their root is taken, so that its derivative exists.
const TINY: f64 = 1e-30;

/// 1, s, v, x, x s, o, with s = √v and o = 1/(1 + v/1.5e-4), of the elastic compression v and x = φ_J − 0.6.
#[inline(always)]
pub fn row<N: Number>(state: &State<N>) -> [N; COEFFICIENTS] {
    let (v, x) = (state.compression.not_below(MIN_COMPRESSION), state.density());
    let s = v.root();
    [N::constant(1.0), s, v, x, x * s, v.times(1.0 / HARDLY).plus(1.0).inverse()]
}

/// h.
#[inline(always)]
fn share<N: Number>(compression: N) -> N {
    let w = compression.times(1.0 / LEVEL);
    let over = w.plus(1.0).inverse();
    (w * over * over).times(4.0)
}

/// F, with the part of the friction that is not mobilised.
#[inline(always)]
fn forgets<N: Number>(unmobilised: N) -> N {
    let mut power = unmobilised.not_below(MIN_FREE).inverse().times(KEEPING);
    for _ in 0..SHARPLY {
        power = power.squared();
    }
    power.plus(1.0).inverse()
}

/// What the number of contacts of a state is compared with, which one state asks for several times.
#[derive(Clone, Copy, Debug)]
pub struct Usual<N> {
    /// z̄.
    pub contacts: N,
    /// F.
    pub forgets: N,
}

impl<N: Number> Usual<N> {
    /// Of the contacts z those of grains that only rest on others: where nearly all friction is mobilised, what a packing has beyond z̄.
    #[inline(always)]
    pub fn resting(&self, coordination: N) -> N {
        let kept = self.forgets.times(-1.0).plus(1.0) * (coordination - self.contacts);
        kept.not_below(0.0).not_above(MAX_RESTING)
    }

    /// The others, which carry load, and by which the fabric turns.
    #[inline(always)]
    pub fn bearing(&self, coordination: N) -> N {
        coordination - self.resting(coordination)
    }
}

impl Contacts {
    /// z̄ and F of a state.
    #[inline(always)]
    pub fn usual<N: Number>(&self, state: &State<N>) -> Usual<N> {
        Usual { contacts: self.sheared(state), forgets: forgets(state.unmobilised()) }
    }

    /// z̄ of a state.
    #[inline(always)]
    pub fn sheared<N: Number>(&self, state: &State<N>) -> N {
        let [first, others @ ..] = row(state);
        let [c0, coefficients @ ..] = self.sheared;
        let mut sum = first.times(c0);
        for (part, c) in others.into_iter().zip(coefficients) {
            sum = sum + part.times(c);
        }
        sum.not_below(CONTACTS[0]).not_above(CONTACTS[1])
    }

    /// z of a packing that was not strained since it was made.
    pub fn packed(&self, state: &State) -> f64 {
        let more = self.surplus * state.unmobilised() * share(state.compression.max(0.0));
        (self.sheared(state) + more).clamp(CONTACTS[0], CONTACTS[1])
    }

    /// z after a strain, which takes the packing from one state to the other.
    #[inline(always)]
    pub fn after<N: Number>(
        &self,
        [from, to]: [&State<N>; 2],
        [before, after]: [&Usual<N>; 2],
        strain: &Tensor<N>,
    ) -> N {
        let [left, more] = self.shares([from, to], before.forgets, strain);
        let kept = left * (from.coordination - before.contacts);
        (after.contacts + kept + more.times(self.surplus)).not_below(CONTACTS[0]).not_above(CONTACTS[1])
    }

    /// What a strain leaves of ζ, and what it adds to it, over S, with F of the state before.
    #[inline(always)]
    pub fn shares<N: Number>(&self, [from, to]: [&State<N>; 2], forgets: N, strain: &Tensor<N>) -> [N; 2] {
        let [of_compression, of_shear] = self.fading;
        let before = from.compression.not_below(MIN_COMPRESSION);
        let after = to.compression.not_below(MIN_COMPRESSION);
        let unmobilised = from.unmobilised();
        let distortion = deviator(*strain);
        let length = contraction(&distortion, &distortion).plus(TINY).root() * after.inverse();
        let sheared = length.times(-of_shear).not_below(-MAX_EXPONENT);
        let [had, has] = [share(before), share(after)];
        let keeps = forgets.times(-1.0).plus(1.0);
        let opened = (has.plus(MIN_SHARE) * had.plus(MIN_SHARE).inverse()).ln();
        let closed = (after * before.inverse()).ln();
        let faded = N::constant(0.0)
            - closed.where_above(N::constant(0.0), closed, closed.times(-1.0)).times(of_compression);
        // Half of what is new has seen the shear.
        let seen = (forgets * sheared).times(0.5).exp();
        let left = (forgets * (sheared + has.where_above(had, faded, opened))).exp();
        [left, (has - had) * unmobilised * has.where_above(had, seen, keeps)]
    }

    /// Numbers for [`super::law::Law::check`]: name, value, whether it is allowed, and what is.
    pub(super) fn numbers(&self) -> impl Iterator<Item = (&'static str, f64, bool, &'static str)> {
        let large = |value: f64| ("contacts.sheared", value, value.abs() <= 1e6, "-1e6 to 1e6");
        let sheared = self.sheared.into_iter().map(large);
        let surplus =
            ("contacts.surplus", self.surplus, (0.0..=MAX_SURPLUS).contains(&self.surplus), "0 to 10");
        let fading = |value: f64| ("contacts.fading", value, (0.0..=100.0).contains(&value), "0 to 100");
        sheared.chain([surplus]).chain(self.fading.into_iter().map(fading))
    }
}
