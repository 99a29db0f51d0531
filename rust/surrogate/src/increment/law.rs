//! The law of the increments: elastic energy, sliding, dilatancy and settling of grains, as in [`super`].

use crate::SurrogateError;
use crate::document::field;
use crate::kernel::vector::Vector;
use crate::number::Number;
use serde::{Deserialize, Serialize};

/// Number of parallel elements, each with an elastic shear strain of its own.
pub const ELEMENTS: usize = 2;

/// Numbers of the law. Stresses and moduli are reduced (times ℓ/(E r̄), ℓ = 1 m), compression positive.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Law {
    /// A = k₀ (1 + l₀ z + l₁ z²) v²/(v + `onset`) + k₁ (1 + l₂ z) v²/2 + k₂ v³/3: k₀, k₁, k₂.
    pub bulk: [f64; 3],
    /// l₀, l₁, l₂.
    pub looseness: [f64; 3],
    /// Elastic compression at which contacts have mostly formed [-].
    pub onset: f64,
    /// G/A = g₀/(A + a) + g₁: g₀, a, g₁.
    pub shear: [f64; 3],
    pub elements: [Element; ELEMENTS],
    /// Growth of all elements' dilatancy with z.
    pub dilatancy_of_looseness: f64,
    /// Relative growth of φ_J by a unit of v by which grains that have lost contact part, up to `SETTLED` [0 to 1].
    #[serde(default, rename = "settling")]
    pub opening_densification: f64,
}

/// An element slides when its part of the deviator exceeds `strength` times A.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Element {
    /// Part of the shear modulus [0 to 1]; 1 in sum.
    pub share: f64,
    /// Largest part of the deviator over A [-].
    pub strength: f64,
    /// Loss of elastic compression by a unit of sliding, at z = 0 [-]: negative where grains climb over each other.
    pub dilatancy: f64,
}

/// Porosity without stress of the packing for which k₀ and the dilatancies are given: z is measured from it.
const REFERENCE_POROSITY: f64 = 0.17;
/// Between these lie all packings of the training, and the polynomials in z make sense.
const MIN_LOOSENESS: f64 = -0.035;
const MAX_LOOSENESS: f64 = 0.05;
/// Least k₀ (1 + looseness·z) over k₀.
const MIN_BULK: f64 = 0.1;
/// How far grains part until they have settled [-]: v reaches this below 0.
const SETTLED: f64 = 0.02;
/// Largest elastic compression: that of grains which overlap by a third of their radius.
const MAX_COMPRESSION: f64 = 0.6;
/// Least p/A, which only packings far beyond all known ones reach. The largest deviator over A is smaller.
const MIN_SHARE: f64 = 0.75;
/// Largest deviator over A, whatever a state's factor of the strengths.
const MAX_DEVIATOR: f64 = 0.74;
/// Largest factor of the strengths, also where the deviator over A would still be smaller.
const MAX_STRENGTH: f64 = 3.0;
/// Far below all pressures, and such that no quotient overflows.
const MIN_PRESSURE: f64 = 1e-100;
/// Largest work of dilatancy over that of friction: less than 1, so that sliding always dissipates.
const MAX_CLIMBING: f64 = 0.9;
/// Load over strength from which an element slides: so little above 1 that a state which slides stays as it is, to the last
/// bit, when it is evaluated again.
const SLACK: f64 = 1.0 + 1e-9;
/// Added to squares of lengths before their root is taken, so that its derivative exists.
const TINY: f64 = 1e-30;

/// What determines the stress of a cell.
#[derive(Clone, Copy)]
pub struct Elastic<N> {
    /// φ_J: the solid fraction (overlaps counted twice) at which the packing would carry no load [-].
    pub jamming: N,
    /// v = φ_s/φ_J − 1: how far the packing is compressed beyond φ_J [-]; negative where the grains do not touch.
    pub compression: N,
    /// Elastic shear strain of each element: γ₁ = e_yy − e_xx and γ₂ = −2 e_xy.
    pub shear: [[N; 2]; ELEMENTS],
    /// Factor of all elements' strengths, which does not change: 1 but for packings that carry more.
    pub strength: N,
}

impl<N: Number> Elastic<N> {
    /// φ_s: sum of the grains' areas over the area [-].
    #[inline(always)]
    pub fn solid(&self) -> N {
        self.jamming + self.jamming * self.compression
    }

    /// z: the porosity without stress, less the usual one; for packings denser or looser than all that are known, theirs.
    #[inline(always)]
    pub fn looseness(&self) -> N {
        let (least, most) = (N::constant(MIN_LOOSENESS), N::constant(MAX_LOOSENESS));
        let loose = self.jamming.times(-1.0).plus(1.0 - REFERENCE_POROSITY);
        let loose = loose.where_above(least, loose, least);
        loose.where_above(most, most, loose)
    }
}

/// Moduli at a compression, per unit of E r̄/ℓ.
#[derive(Clone, Copy)]
pub struct Moduli<N> {
    /// A, the pressure without shear.
    pub pressure: N,
    /// G/A, finite also where the grains do not touch.
    pub ratio: N,
    /// (1 + v)² d(G/(1 + v))/dv = (1 + v) dG/dv − G: how the elastic energy of shear, over the area without load, grows with a
    /// compression of the cell.
    pub growth: N,
}

impl<N: Number> Moduli<N> {
    /// p of a packing with this Σ w γ². It is never so small that a direction is in tension.
    #[inline(always)]
    fn under_shear(&self, square: N) -> N {
        let (shear, least) = ((self.growth * square).times(0.5), self.pressure.times(MIN_SHARE - 1.0));
        self.pressure + shear.where_above(least, shear, least)
    }
}

/// p, and (σ_xx − σ_yy)/2 and σ_xy.
pub type Stress<N> = [N; 3];

/// Strains of an increment: extension positive, radii's growth positive.
#[derive(Clone, Copy)]
pub struct Strain<N> {
    pub thermal: N,
    pub xx: N,
    pub yy: N,
    /// 2 e_xy.
    pub xy: N,
}

impl Law {
    #[inline(always)]
    pub fn moduli<N: Number>(&self, compression: N, loose: N) -> Moduli<N> {
        let zero = N::constant(0.0);
        let (most, least) = (N::constant(MAX_COMPRESSION), N::constant(MIN_BULK));
        let touching = compression.where_above(zero, compression, zero);
        let v = touching.where_above(most, most, touching);
        let [l0, l1, l2] = self.looseness;
        let [first, second, third] = self.bulk;
        let stiffer = (loose * loose.times(l1).plus(l0)).plus(1.0);
        let first = stiffer.where_above(least, stiffer, least).times(first);
        let stiffer = loose.times(l2).plus(1.0);
        let stiffer = stiffer.where_above(least, stiffer, least);
        // A second term that softens does not soften more than the file says.
        let limit = if second < 0.0 { N::constant(1.0) } else { stiffer };
        let second = stiffer.where_above(limit, limit, stiffer).times(second);
        // The bulk modulus stays positive up to the largest compression, however loose the packing is.
        let softest = (first.times(0.5) + second.times(MAX_COMPRESSION))
            .times(-1.0 / (MAX_COMPRESSION * MAX_COMPRESSION));
        let limited = |third: f64, softest: N| {
            let third = N::constant(third);
            third.where_above(softest, third, softest)
        };
        let (third, a_third) = (limited(third, softest), limited(third / 3.0, softest.times(1.0 / 3.0)));
        let share = v * v.plus(self.onset).inverse();
        let pressure = v * (first * share + v * (v * a_third + second.times(0.5)));
        let bulk = first * share * share.times(-1.0).plus(2.0) + v * (v * third + second);
        let [g0, a, g1] = self.shear;
        let inverse = pressure.plus(a).inverse();
        let ratio = inverse.times(g0).plus(g1);
        let stiffer = (inverse * inverse).times(g0 * a).plus(g1) * bulk * v.plus(1.0);
        Moduli { pressure, ratio, growth: stiffer - pressure * ratio }
    }

    /// Largest factor of the strengths that a state may have: with it no direction is in tension. At least 1.
    #[inline(always)]
    pub fn most_strength(&self) -> f64 {
        (MAX_DEVIATOR / self.strength()).clamp(1.0, MAX_STRENGTH)
    }

    /// Largest deviator over A of a state whose factor of the strengths is 1.
    #[inline(always)]
    pub fn strength(&self) -> f64 {
        self.elements.iter().map(|element| element.strength).sum()
    }

    /// Stress of a state with these moduli.
    #[inline(always)]
    pub fn stress<N: Number>(&self, state: &Elastic<N>, moduli: &Moduli<N>) -> Stress<N> {
        let zero = N::constant(0.0);
        let (mut square, mut along, mut across) = (zero, zero, zero);
        for k in 0..ELEMENTS {
            let (share, [a, b]) = (self.elements[k].share, state.shear[k]);
            square = square + (a * a + b * b).times(share);
            along = along + a.times(share);
            across = across + b.times(share);
        }
        let shear = moduli.pressure * moduli.ratio;
        [moduli.under_shear(square), shear * along, shear * across]
    }

    /// State after a strain, and its moduli. `turn` is the cosine and sine of the angle by which the cell turns. Zero strain
    /// changes nothing, but in a state that no strain leads to.
    #[inline(always)]
    pub fn advanced<N: Number>(
        &self,
        state: &Elastic<N>,
        strain: &Strain<N>,
        turn: [N; 2],
    ) -> (Elastic<N>, Moduli<N>) {
        let (zero, one, slack) = (N::constant(0.0), N::constant(1.0), N::constant(SLACK));
        let Strain { thermal, xx, yy, xy } = *strain;
        let half = xy.times(0.5);
        // Growth of the area of the grains, and of the cell.
        let (grains, cell) = (thermal + thermal + thermal * thermal, xx + yy + (xx * yy - half * half));
        // φ_s after over φ_s before, less 1; exactly 0 without strain.
        let denser = (grains - cell) * cell.plus(1.0).inverse();
        let tried = state.compression + state.compression.plus(1.0) * denser;
        let loose = state.looseness();
        let moduli = self.moduli(tried, loose);
        let more = loose.times(self.dilatancy_of_looseness);
        let weaker = state.strength.inverse();
        let (mut shear, mut lengths, mut slid) = (state.shear, [zero; ELEMENTS], [zero; ELEMENTS]);
        let mut square = zero;
        for k in 0..ELEMENTS {
            let Element { share, strength, .. } = self.elements[k];
            // The shear strains turn by twice the angle of the cell: half of it before the strain, half after.
            let [along, across] = turned(shear[k], turn);
            shear[k] = turned([along + yy - xx, across - xy], turn);
            let [along, across] = shear[k];
            let length = (along * along + across * across).plus(TINY).root();
            // Elastic load of the element over its strength.
            let load = (moduli.ratio * length * weaker).times(share / strength);
            let kept = load.where_above(slack, load.inverse(), one);
            shear[k] = [along * kept, across * kept];
            lengths[k] = length * kept;
            slid[k] = length * (one - kept);
            square = square + (lengths[k] * lengths[k]).times(share);
        }
        // Grains that climb work against the pressure, at most as much as friction lets them.
        let most = moduli.under_shear(square).plus(MIN_PRESSURE).inverse();
        let most = most * moduli.pressure.plus(MIN_PRESSURE) * state.strength.times(-MAX_CLIMBING);
        let mut loss = zero;
        for (slid, element) in slid.into_iter().zip(&self.elements) {
            let (climbing, least) = (more.plus(element.dilatancy), most.times(element.strength));
            loss = loss + slid * climbing.where_above(least, climbing, least);
        }
        // Sliding ends where the grains lose contact, and those that do not touch do not climb.
        let loss = loss.where_above(tried, tried, loss);
        let loss = tried.where_above(zero, loss, zero);
        // Grains that part settle: they will touch again later than they came apart.
        let gap = |v: N| {
            let open = v.where_above(zero, zero, v);
            let far = N::constant(-SETTLED);
            open.where_above(far, open, far)
        };
        let wider = gap(state.compression) - gap(tried);
        let loss = loss + wider.where_above(zero, wider, zero).times(self.opening_densification);
        let compression = tried - loss;
        let jamming = state.jamming + state.jamming * loss * compression.plus(1.0).inverse();
        let next = Elastic { jamming, compression, shear, strength: state.strength };
        // The strength changes with the compression.
        let moduli = self.moduli(compression, next.looseness());
        for k in 0..ELEMENTS {
            let Element { share, strength, .. } = self.elements[k];
            let load = (moduli.ratio * lengths[k] * weaker).times(share / strength);
            let kept = load.where_above(slack, load.inverse(), one);
            shear[k] = [shear[k][0] * kept, shear[k][1] * kept];
        }
        (Elastic { shear, ..next }, moduli)
    }

    /// Refuses numbers for which the law has no meaning.
    ///
    /// # Errors
    /// [`SurrogateError::Field`] with key, value and what is allowed.
    pub fn check(&self) -> Result<(), SurrogateError> {
        let [k0, k1, k2] = self.bulk;
        let [g0, a, g1] = self.shear;
        // The bulk modulus must stay positive up to the largest compression.
        let stiff = |v: f64| MIN_BULK * k0 + k1 * v + k2 * v * v > 0.0;
        let numbers = [
            ("bulk[0]", k0, (1e-6..=1e6).contains(&k0), "1e-6 to 1e6"),
            ("bulk[1]", k1, k1.abs() <= 1e6, "-1e6 to 1e6"),
            (
                "bulk[2]",
                k2,
                k2.abs() <= 1e6 && (0..=60).all(|k| stiff(0.01 * f64::from(k))),
                "a bulk modulus above 0 up to a compression of 0.6",
            ),
            ("looseness[0]", self.looseness[0], self.looseness[0].abs() <= 1e4, "-1e4 to 1e4"),
            ("looseness[1]", self.looseness[1], self.looseness[1].abs() <= 1e4, "-1e4 to 1e4"),
            ("looseness[2]", self.looseness[2], self.looseness[2].abs() <= 1e4, "-1e4 to 1e4"),
            ("onset", self.onset, (1e-9..=1.0).contains(&self.onset), "1e-9 to 1"),
            ("shear[0]", g0, (0.0..=1e6).contains(&g0), "0 to 1e6"),
            ("shear[1]", a, (1e-9..=1e6).contains(&a), "1e-9 to 1e6"),
            ("shear[2]", g1, (0.0..=1e6).contains(&g1) && g0 + g1 > 1e-6, "0 to 1e6, and not both 0"),
            (
                "dilatancy_of_looseness",
                self.dilatancy_of_looseness,
                self.dilatancy_of_looseness.abs() <= 1e3,
                "-1e3 to 1e3",
            ),
            (
                "settling",
                self.opening_densification,
                (0.0..=1.0).contains(&self.opening_densification),
                "0 to 1",
            ),
        ];
        if let Some((key, value, _, allowed)) = numbers.iter().find(|(_, _, good, _)| !good) {
            return field(&format!("law.{key}"), value, *allowed);
        }
        let shares: f64 = self.elements.iter().map(|element| element.share).sum();
        if (shares - 1.0).abs() > 1e-9 {
            return field("law.elements (sum of shares)", shares, "1");
        }
        for (k, element) in self.elements.iter().enumerate() {
            let Element { share, strength, dilatancy } = *element;
            let good =
                (1e-6..=1.0).contains(&share) && (1e-6..=1e3).contains(&strength) && dilatancy.abs() <= 1e3;
            if !good {
                let found = format!("share {share}, strength {strength}, dilatancy {dilatancy}");
                let allowed = "share 1e-6 to 1, strength 1e-6 to 1e3, dilatancy -1e3 to 1e3";
                return field(&format!("law.elements[{k}]"), found, allowed);
            }
        }
        Ok(())
    }
}

/// Least k₂ with which the bulk modulus stays positive up to the largest compression, as [`Law::check`] wants it.
pub fn least_third_bulk(first: f64, second: f64) -> f64 {
    let least = |v: f64| -(0.99 * MIN_BULK * first + second * v) / (v * v);
    (1..=60).map(|k| least(0.01 * f64::from(k))).fold(-1e6, f64::max)
}

/// A shear strain turned by the angle of this cosine and sine.
#[inline(always)]
fn turned<N: Number>([along, across]: [N; 2], [cosine, sine]: [N; 2]) -> [N; 2] {
    [cosine * along - sine * across, sine * along + cosine * across]
}

/// Cosine and sine of small angles: the sum of their squares is 1 to rounding, and the angle is right within θ³/12.
#[inline(always)]
pub fn rotation<V: Vector>(angle: V) -> [V; 2] {
    let half = angle * V::all(0.5);
    let square = half * half;
    let inverse = V::all(1.0) / (V::all(1.0) + square);
    [(V::all(1.0) - square) * inverse, (half + half) * inverse]
}
