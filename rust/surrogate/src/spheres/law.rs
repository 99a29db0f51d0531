//! The law of a packing of spheres, as in [`super`].

use super::contacts::{COEFFICIENTS, Contacts, row};
use super::number::Number;
use super::tensor::{Rotation, Tensor, contraction, deviator, scaled, square, sum, turned};
use crate::SurrogateError;
use crate::document::field;
use serde::{Deserialize, Serialize};

/// Number of elements, each of which bears a part of the deviator. The last is that of the fabric.
pub const ELEMENTS: usize = 3;
/// The element whose stress ratio is that of the directions of the contacts.
pub const FABRIC: usize = ELEMENTS - 1;

/// Numbers of the law. Stresses are over E*, compression positive; x is the solid fraction at jamming less 0.6, u = v/0.005.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Law {
    /// A = b₀ e^(b₁ x + b₂ g) v^(3/2) u^(b₃ + b₄ g), with the part g of the friction that is not mobilised.
    pub bulk: [f64; 5],
    /// Stiffnesses go with e^(`shear`₀ x + `shear`₂ g) u^`shear`₁.
    pub shear: [f64; 3],
    /// Growth of the pressure by the stress ratios: p = A (1 + `lift` Σ |η_k|²/c_k).
    pub lift: f64,
    pub elements: [Element; ELEMENTS],
    /// Loss of compression by a unit of sliding: d₀ (d₁ + d₂ x + d₃ g − η·n), with n the direction of sliding; negative where
    /// grains climb over each other.
    pub dilatancy: [f64; 4],
    /// Loss of compression by a unit of sliding beside it, of packings whose friction is mobilised and that hardly bear load:
    /// (1 − g) c₀ e^(−c₁ x) u^(−c₂) (1 − η·n/c₃), 0 where that is negative.
    pub collapse: [f64; 4],
    /// Growth of the mobilised friction by sliding: dg = −m g ds/v.
    pub mobilising: f64,
    /// Loss of compression by a unit of opening: s₀/(1 + (v/v₀)²), v₀ = s₁ e^(−s₂ x), of packings that lose their load.
    pub settling: [f64; 3],
    /// Stress ratio of the fabric over the deviator of the fabric, and its usual part of the stress ratio, for packings whose
    /// fabric is not known.
    pub fabric: [f64; 2],
    pub contacts: Contacts,
}

/// A part of the deviator.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Element {
    /// Growth of the stress ratio by a unit of shear strain over v, at x = 0 and u = 1.
    pub stiffness: f64,
    /// It slides when it exceeds `strength` e^(`growth` x + `free` g + `hardening` √v) times A.
    pub strength: f64,
    pub growth: f64,
    pub free: f64,
    pub hardening: f64,
    /// The stress ratio goes with this power of v where the packing is compressed without shear: 0 where new contacts have the
    /// directions of the old ones, −1 where none are made.
    pub power: f64,
}

/// Solid fraction from which x is measured.
const USUAL_FRACTION: f64 = 0.6;
/// A usual elastic compression, over which u is counted.
const USUAL_COMPRESSION: f64 = 0.005;
/// x of all packings of the training lies between these; others have the numbers of these.
const MOST_LOOSE: f64 = -0.045;
const MOST_DENSE: f64 = 0.045;
/// v below which grains count as touching by this much: its pressure is far below that of any bed.
pub const LEAST_COMPRESSION: f64 = 1e-7;
/// Largest v: far beyond the elasticity of real grains.
const MOST_COMPRESSION: f64 = 0.5;
/// Largest work of grains that climb over that of friction.
const MOST_CLIMBING: f64 = 0.9;
/// Length of a stress ratio over its strength from which an element slides: so little above 1 that a state which slides
/// stays as it is when it is evaluated again.
const SLACK: f64 = 1.0 + 1e-9;
/// Added to squares of lengths before their root is taken, so that its derivative exists.
const TINY: f64 = 1e-30;
/// Least p/A; only states far beyond all known ones reach it.
const LEAST_SHARE: f64 = 0.5;
/// Largest factor of the strengths.
pub const MOST_STRENGTH: f64 = 2.0;
/// Largest exponent of the exponential functions of x.
const MOST_EXPONENT: f64 = 8.0;

/// What determines the stress of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<N = f64> {
    /// φ_J: the solid fraction at which the packing would bear no load \[-\].
    pub jamming: N,
    /// v = φ/φ_J − 1; negative where the grains do not touch.
    pub compression: N,
    /// η_k: parts of the deviator of the stress over A.
    pub ratios: [Tensor<N>; ELEMENTS],
    /// Factor of the strengths but that of the fabric, which does not change: 1 but for packings that bear more.
    pub strength: f64,
    /// Part of the friction that is mobilised, 0 to 1: as where all contacts were made under friction (1), or without any (0).
    pub mobilised: N,
    /// ζ = z − z̄: contacts per sphere, all spheres counted, more than those of usual packings in this state, see [`Contacts`].
    pub surplus: N,
    /// z, by [`Law::counted`].
    pub coordination: f64,
}

/// What may be known of a packing beside its solid fraction and stress. What is not known is as it usually is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Known {
    /// Contacts per sphere, all spheres counted.
    pub coordination: Option<f64>,
    /// Mean of n n over the contacts, with the normals n.
    pub fabric: Option<Tensor>,
    /// The mobilised part of the friction: 1 is usual, for beds that were poured or shaken.
    pub mobilised: Option<f64>,
}

impl<N: Number> State<N> {
    /// x, between those of the packings of the training.
    pub fn density(&self) -> N {
        self.jamming.plus(-USUAL_FRACTION).at_least(MOST_LOOSE).at_most(MOST_DENSE)
    }

    /// g: the part of the friction that is not mobilised.
    fn free(&self) -> N {
        self.mobilised.times(-1.0).plus(1.0).at_least(0.0).at_most(1.0)
    }

    /// φ: volume of the grains over the volume \[-\].
    pub fn solid(&self) -> N {
        self.jamming + self.jamming * self.compression
    }

    /// Deviator of the stress over A.
    pub fn ratio(&self) -> Tensor<N> {
        let [first, second, fabric] = &self.ratios;
        sum(&sum(first, second), fabric)
    }
}

impl State {
    /// What the usual number of contacts depends on.
    pub fn contact_row(&self) -> [f64; COEFFICIENTS] {
        row(self.compression, self.density(), &self.ratio())
    }

    /// The same state, as numbers that do not depend on the strain.
    pub fn fixed<N: Number>(&self) -> State<N> {
        State {
            jamming: N::of(self.jamming),
            compression: N::of(self.compression),
            ratios: self.ratios.map(|ratio| ratio.map(N::of)),
            mobilised: N::of(self.mobilised),
            strength: self.strength,
            surplus: N::of(self.surplus),
            coordination: self.coordination,
        }
    }
}

impl<N: Number> State<N> {
    pub fn value(&self) -> State {
        State {
            jamming: self.jamming.value(),
            compression: self.compression.value(),
            ratios: self.ratios.map(|ratio| ratio.map(Number::value)),
            mobilised: self.mobilised.value(),
            strength: self.strength,
            surplus: self.surplus.value(),
            coordination: self.coordination,
        }
    }
}

/// Strain of an increment: growth of the radii positive, extension of the cell positive; xy, xz, yz are twice the shears.
#[derive(Clone, Copy, Debug)]
pub struct Strain<N = f64> {
    pub thermal: N,
    pub cell: Tensor<N>,
}

impl Law {
    fn exponential<N: Number>(x: N, rate: f64) -> N {
        x.times(rate).at_least(-MOST_EXPONENT).at_most(MOST_EXPONENT).exp()
    }

    /// v, and u, between bounds.
    fn compressions<N: Number>(compression: N) -> (N, N) {
        let v = compression.at_least(LEAST_COMPRESSION).at_most(MOST_COMPRESSION);
        (v, v.times(1.0 / USUAL_COMPRESSION))
    }

    /// A: the pressure over E* without shear.
    pub fn pressure<N: Number>(&self, compression: N, x: N, free: N, surplus: N) -> N {
        let (v, u) = Self::compressions(compression);
        let [b0, b1, b2, b3, b4] = self.bulk;
        let exponent = x.times(b1) + free.times(b2) + u.ln() * free.times(b4).plus(b3);
        let stiffer = self.contacts.stiffer(surplus);
        (exponent.exp() * v * v.sqrt() * stiffer * stiffer.sqrt()).times(b0)
    }

    /// The stiffnesses' dependence on the state.
    fn shear<N: Number>(&self, compression: N, x: N, free: N) -> N {
        let [stiffening, power, of_free] = self.shear;
        let exponent =
            (x.times(stiffening) + free.times(of_free)).at_least(-MOST_EXPONENT).at_most(MOST_EXPONENT);
        exponent.exp() * Self::compressions(compression).1.power(power)
    }

    /// Strength of an element, by the root of v.
    fn strength<N: Number>(&self, k: usize, x: N, free: N, root: N) -> N {
        let Element { strength, growth, free: of_free, hardening, .. } = self.elements[k];
        let exponent = x.times(growth) + free.times(of_free) + root.times(hardening);
        exponent.at_least(-MOST_EXPONENT).at_most(MOST_EXPONENT).exp().times(strength)
    }

    /// σ over E*, compression positive.
    pub fn stress<N: Number>(&self, state: &State<N>) -> Tensor<N> {
        let (x, free) = (state.density(), state.free());
        let pressure = if state.compression.value() > LEAST_COMPRESSION {
            self.pressure(state.compression, x, free, state.surplus)
        } else {
            return [N::of(0.0); 6];
        };
        let mut lift = N::of(1.0);
        let over = self.shear(state.compression, x, free).inverse();
        for (ratio, element) in state.ratios.iter().zip(&self.elements) {
            lift = lift + contraction(ratio, ratio).times(self.lift / element.stiffness) * over;
        }
        let mean = pressure * lift.at_least(LEAST_SHARE);
        let mut stress = scaled(&state.ratio(), pressure);
        for normal in &mut stress[..3] {
            *normal = *normal + mean;
        }
        stress
    }

    /// State after a strain, in parts where the packing is hardly compressed. `half` is half of the cell's rotation.
    pub fn advanced<N: Number>(&self, state: &State<N>, strain: &Strain<N>, half: &Rotation) -> State<N> {
        let mut next = *state;
        next.ratios = next.ratios.map(|ratio| turned(&ratio, half));
        let [xx, yy, zz, xy, xz, yz] = strain.cell;
        let cell = [xx, yy, zz, xy.times(0.5), xz.times(0.5), yz.times(0.5)];
        let square = square(&cell);
        let count = parts(state.compression.value());
        for part in 0..count {
            // Equal parts of the whole, E/n (1 + k E/n)⁻¹, which compose to it; of the cell to the second order.
            let (part, share) = (f64::from(part), 1.0 / f64::from(count));
            let thermal = strain.thermal * strain.thermal.times(part).plus(f64::from(count)).inverse();
            let cell = std::array::from_fn(|c| cell[c].times(share) - square[c].times(part * share * share));
            let before = next.compression.at_least(LEAST_COMPRESSION);
            next = self.part(&next, thermal, cell);
            let after = next.compression.at_least(LEAST_COMPRESSION);
            self.forget(&mut next, before, after, &cell);
        }
        next.ratios = next.ratios.map(|ratio| turned(&ratio, half));
        next.coordination = self.coordination(&next.value());
        next
    }

    /// Forgets of ζ what a strain between two compressions makes it forget. Where that makes the packing stiffer, it keeps its
    /// pressure, so that no work comes of it.
    fn forget<N: Number>(&self, state: &mut State<N>, before: N, after: N, strain: &Tensor<N>) {
        let left = self.contacts.left(before, after, strain);
        let surplus = state.surplus * left;
        let [old, new] = [state.surplus, surplus].map(|surplus| self.contacts.stiffer(surplus));
        state.surplus = surplus;
        if new.value() > old.value() && state.compression.value() > 0.0 {
            let solid = state.solid();
            state.compression = state.compression * old * new.inverse();
            state.jamming = solid * state.compression.plus(1.0).inverse();
        }
    }

    /// z of a state.
    pub fn coordination(&self, state: &State) -> f64 {
        self.contacts.usual(&state.contact_row()) + state.surplus
    }

    /// The state with its z.
    pub fn counted(&self, state: State) -> State {
        State { coordination: self.coordination(&state), ..state }
    }

    /// After growth of the radii and a strain of the cell, whose shears are not doubled.
    fn part<N: Number>(&self, state: &State<N>, thermal: N, strain: Tensor<N>) -> State<N> {
        let [xx, yy, zz, xy, xz, yz] = strain;
        // Growth of the volume of the cell, and of the grains.
        let second = xx * yy + yy * zz + zz * xx - (xy * xy + xz * xz + yz * yz);
        let third = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
        let cell = xx + yy + zz + second + third;
        let grains = thermal.times(3.0) + thermal * thermal * thermal.plus(3.0);
        let denser = (grains - cell) * cell.plus(1.0).inverse();
        let tried = state.compression + state.compression.plus(1.0) * denser;
        if tried.value() <= 0.0 {
            // Grains that do not touch forget the deviator.
            let zero = [N::of(0.0); 6];
            return State { compression: tried, ratios: [zero; ELEMENTS], ..*state };
        }
        let (x, free) = (state.density(), state.free());
        let before = state.compression.at_least(LEAST_COMPRESSION);
        let after = tried.at_least(LEAST_COMPRESSION);
        let over = after.inverse();
        let opening = after * before.inverse();
        let distortion = deviator(strain);
        let total = state.ratio();
        let [d0, d1, d2, d3] = self.dilatancy;
        let usual = (x.times(d2) + free.times(d3)).plus(d1);
        let (shear, root) = (self.shear(after, x, free), Self::compressions(after).0.sqrt());
        let mut ratios = state.ratios;
        let [c0, c1, c2, c3] = self.collapse;
        let collapse = (Self::exponential(x, -c1) * Self::compressions(after).1.power(-c2)).times(c0)
            * free.times(-1.0).plus(1.0);
        let (mut loss, mut sliding) = (N::of(0.0), N::of(0.0));
        for (k, ratio) in ratios.iter_mut().enumerate() {
            let stiffness = shear.times(self.elements[k].stiffness);
            let most = self.strength(k, x, free, root).times(if k == FABRIC { 1.0 } else { state.strength });
            let faded = scaled(ratio, opening.power(self.elements[k].power));
            let faded = within(&faded, most).0;
            let added = scaled(&distortion, stiffness * over);
            let elastic: Tensor<N> = std::array::from_fn(|c| faded[c] - added[c]);
            let (kept, excess, length) = within(&elastic, most);
            *ratio = kept;
            if let Some(excess) = excess {
                let slid = excess * after * stiffness.inverse();
                sliding = sliding + slid;
                let along = contraction(&total, &elastic) * length.inverse();
                let climbing =
                    (usual - along).times(d0) + collapse * along.times(-1.0 / c3).plus(1.0).at_least(0.0);
                let least = most.times(-MOST_CLIMBING);
                loss = loss + slid * (if climbing.value() > least.value() { climbing } else { least });
            }
        }
        let [s0, s1, s2] = self.settling;
        if tried.value() < before.value() {
            let usual = Self::exponential(x, -s2).times(s1);
            let level = after * usual.inverse();
            loss = loss + (before - tried) * (level * level).plus(1.0).inverse().times(s0);
        }
        let loss = if loss.value() < tried.value() { loss } else { tried };
        let compression = tried - loss;
        let jamming = state.jamming + state.jamming * loss * compression.plus(1.0).inverse();
        let left = free * (sliding * over).times(-self.mobilising).at_least(-MOST_EXPONENT).exp();
        let mobilised = left.times(-1.0).plus(1.0);
        State { jamming, compression, ratios, mobilised, ..*state }
    }

    /// The state with a solid fraction, a stress over E*, and what else is known. The fabric bears its part; the other elements
    /// share the rest of the deviator as after a proportional load: each bears its part until it slides. A packing that bears more
    /// than all strengths has larger strengths, by a common factor.
    pub fn start(&self, solid: f64, stress: Tensor, known: &Known) -> State {
        let mobilised = known.mobilised.unwrap_or(1.0).clamp(0.0, 1.0);
        let fabric = known.fabric.map(deviator);
        let at =
            |surplus: f64| self.counted(self.start_of_stress(solid, stress, fabric, [mobilised, surplus]));
        let mut state = at(0.0);
        let Some(coordination) = known.coordination else { return state };
        for _ in 0..COUNTS {
            state = at(coordination - (state.coordination - state.surplus));
        }
        state
    }

    fn start_of_stress(&self, solid: f64, stress: Tensor, fabric: Option<Tensor>, of: [f64; 2]) -> State {
        let (pressure, load) = (super::tensor::mean(stress), deviator(stress));
        let fabric = fabric.map_or(Borne::Usual(pressure), Borne::Fabric);
        let at = |compression: f64| self.loaded(solid, compression, &load, &fabric, of);
        if pressure <= 0.0 {
            return State { ratios: [[0.0; 6]; ELEMENTS], strength: 1.0, ..at(0.0) };
        }
        // The pressure of a packing with this deviator falls with v, and below some v it would grow again: the larger root counts.
        let beyond = |compression: f64| super::tensor::mean(self.stress(&at(compression))) - pressure;
        let (mut high, mut excess) = (MOST_COMPRESSION, beyond(MOST_COMPRESSION));
        let mut low = high;
        while low > LEAST_COMPRESSION {
            low = START_RATIO * high;
            let found = beyond(low);
            if found <= 0.0 {
                break;
            }
            if found > excess {
                return at(high);
            }
            (high, excess) = (low, found);
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            match beyond(middle) > 0.0 {
                true => high = middle,
                false => low = middle,
            }
        }
        at(high)
    }

    fn loaded(
        &self,
        solid: f64,
        compression: f64,
        load: &Tensor,
        fabric: &Borne,
        [mobilised, surplus]: [f64; 2],
    ) -> State {
        let mut state = State {
            jamming: solid / (1.0 + compression),
            compression,
            ratios: [[0.0; 6]; ELEMENTS],
            strength: 1.0,
            mobilised,
            surplus,
            coordination: 0.0,
        };
        let (x, free) = (state.density(), state.free());
        let root = Self::compressions(compression).0.sqrt();
        let over = 1.0 / self.pressure(compression, x, free, surplus).max(f64::MIN_POSITIVE);
        if compression <= LEAST_COMPRESSION || !load.iter().all(|part| (part * over).is_finite()) {
            return state;
        }
        let ratio = load.map(|part| part * over);
        let [per_anisotropy, usual] = self.fabric;
        let strengths: [f64; FABRIC] = std::array::from_fn(|k| self.strength(k, x, free, root));
        let strongest = MOST_STRENGTH * strengths.iter().sum::<f64>();
        let of_fabric = match fabric {
            Borne::Fabric(fabric) => fabric.map(|part| per_anisotropy * part),
            // At least what the other elements cannot bear.
            Borne::Usual(pressure) => {
                let least = 1.0 - strongest / contraction(&ratio, &ratio).sqrt().max(f64::MIN_POSITIVE);
                // A share of the deviator over the pressure, which a deviator makes larger than A.
                let share = (usual / (over * pressure)).min(usual).max(least);
                ratio.map(|part| share * part)
            }
        };
        state.ratios[FABRIC] = within(&of_fabric, self.strength(FABRIC, x, free, root)).0;
        let rest: Tensor = std::array::from_fn(|k| ratio[k] - state.ratios[FABRIC][k]);
        let size = contraction(&rest, &rest).sqrt();
        if size <= 0.0 {
            return state;
        }
        let shear = self.shear(compression, x, free);
        let stiffness: [f64; FABRIC] = std::array::from_fn(|k| shear * self.elements[k].stiffness);
        state.strength = (size / strengths.iter().sum::<f64>()).clamp(1.0, MOST_STRENGTH);
        let limits: [f64; FABRIC] = std::array::from_fn(|k| state.strength * strengths[k] / stiffness[k]);
        let common = shared(limits, stiffness, size);
        for k in 0..FABRIC {
            let bears = common.min(limits[k]) * stiffness[k] / size;
            state.ratios[k] = rest.map(|part| part * bears);
        }
        state
    }

    /// Refuses numbers for which the law has no meaning.
    ///
    /// # Errors
    /// [`SurrogateError::Field`] with key, value and what is allowed.
    pub fn check(&self) -> Result<(), SurrogateError> {
        let [b0, b1, b2, b3, b4] = self.bulk;
        let [stiffening, shear_power, of_free] = self.shear;
        let [d0, ..] = self.dilatancy;
        let [c0, c1, c2, c3] = self.collapse;
        let [s0, s1, s2] = self.settling;
        let [per_anisotropy, usual] = self.fabric;
        let mut numbers = vec![
            ("bulk[0]", b0, (1e-6..=1e6).contains(&b0), "1e-6 to 1e6"),
            ("bulk[1]", b1, b1.abs() <= LARGE, "-1e4 to 1e4"),
            ("bulk[2]", b2, b2.abs() <= 5.0, "-5 to 5"),
            // The pressure grows with the compression at any g.
            ("bulk[3]", b3, b3.abs() <= 0.5, "-0.5 to 0.5"),
            ("bulk[4]", b4, b4.abs() <= 0.5, "-0.5 to 0.5"),
            ("shear[0]", stiffening, stiffening.abs() <= LARGE, "-1e4 to 1e4"),
            ("shear[1]", shear_power, shear_power.abs() <= 1.0, "-1 to 1"),
            ("shear[2]", of_free, of_free.abs() <= 5.0, "-5 to 5"),
            ("mobilising", self.mobilising, (0.0..=100.0).contains(&self.mobilising), "0 to 100"),
            ("lift", self.lift, self.lift.abs() <= 10.0, "-10 to 10"),
            ("dilatancy[0]", d0, (0.0..=10.0).contains(&d0), "0 to 10"),
            ("collapse[0]", c0, (0.0..=10.0).contains(&c0), "0 to 10"),
            ("collapse[1]", c1, c1.abs() <= LARGE, "-1e4 to 1e4"),
            ("collapse[2]", c2, (0.0..=3.0).contains(&c2), "0 to 3"),
            ("collapse[3]", c3, (0.01..=10.0).contains(&c3), "0.01 to 10"),
            ("settling[0]", s0, (0.0..=10.0).contains(&s0), "0 to 10"),
            ("settling[1]", s1, (1e-9..=1.0).contains(&s1), "1e-9 to 1"),
            ("settling[2]", s2, s2.abs() <= LARGE, "-1e4 to 1e4"),
            ("fabric[0]", per_anisotropy, (0.0..=100.0).contains(&per_anisotropy), "0 to 100"),
            ("fabric[1]", usual, (0.0..=1.0).contains(&usual), "0 to 1"),
        ];
        numbers
            .extend(self.dilatancy[1..].iter().map(|d| ("dilatancy", *d, d.abs() <= LARGE, "-1e4 to 1e4")));
        for element in &self.elements {
            let Element { stiffness, strength, growth, free, hardening, power } = *element;
            numbers.extend([
                ("element.stiffness", stiffness, (1e-6..=1e6).contains(&stiffness), "1e-6 to 1e6"),
                ("element.strength", strength, (1e-6..=2.0).contains(&strength), "1e-6 to 2"),
                ("element.growth", growth, growth.abs() <= LARGE, "-1e4 to 1e4"),
                ("element.free", free, free.abs() <= 10.0, "-10 to 10"),
                ("element.hardening", hardening, hardening.abs() <= 100.0, "-100 to 100"),
                ("element.power", power, (-2.0..=1.0).contains(&power), "-2 to 1"),
            ]);
        }
        numbers.extend(self.contacts.numbers());
        match numbers.into_iter().find(|(_, _, good, _)| !good) {
            Some((key, value, _, allowed)) => field(&format!("law.{key}"), value, allowed),
            None => Ok(()),
        }
    }
}

/// What tells the part of the deviator that the fabric bears.
enum Borne {
    /// The deviator of the fabric, which is known.
    Fabric(Tensor),
    /// The pressure over E* of a packing whose fabric is not known: it is that of usual packings.
    Usual(f64),
}

/// Largest coefficient of x.
const LARGE: f64 = 1e4;
/// Halvings of an interval, after which its ends are neighbouring numbers; and the ratio of the compressions that are looked at before.
const HALVINGS: usize = 52;
const START_RATIO: f64 = 0.7;
/// Rounds in which the number of contacts and what the stress says of the state are brought together.
const COUNTS: u32 = 4;

/// Number of parts of an increment: more where the packing is hardly compressed, because there its stress changes more.
fn parts(compression: f64) -> u32 {
    match compression {
        v if v > 1e-2 => 1,
        v if v > 1e-3 => 2,
        v if v > 1e-4 => 4,
        _ => 8,
    }
}

/// The tensor, shortened to `most` where it is longer; then by how much it was longer, and its length.
fn within<N: Number>(tensor: &Tensor<N>, most: N) -> (Tensor<N>, Option<N>, N) {
    let length = contraction(tensor, tensor).plus(TINY).sqrt();
    if length.value() <= most.value() * SLACK {
        return (*tensor, None, length);
    }
    (scaled(tensor, most * length.inverse()), Some(length - most), length)
}

/// The shear strain over v that all elements have which do not slide, when together they bear a deviator of this size.
fn shared(limits: [f64; FABRIC], stiffness: [f64; FABRIC], size: f64) -> f64 {
    let mut order: [usize; FABRIC] = std::array::from_fn(|k| k);
    order.sort_by(|a, b| limits[*a].total_cmp(&limits[*b]));
    let (mut rest, mut stiff) = (size, stiffness.iter().sum::<f64>());
    let mut common = 0.0;
    for k in order {
        common = rest / stiff.max(f64::MIN_POSITIVE);
        if common <= limits[k] {
            break;
        }
        rest -= stiffness[k] * limits[k];
        stiff -= stiffness[k];
        common = limits[k];
    }
    common
}
