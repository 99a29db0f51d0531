//! Answers of the law, a block of cells at a time.

use super::law::{ELEMENTS, Elastic, Law, Moduli, Strain, rotation};
use super::number::{Dual, Number, Plain};
use super::readout::{CONDUCTIVITY_FLOOR, Conductivity, Features, Readout};
use crate::dataset::ConductivityKind;
use crate::kernel::vector::Vector;
use crate::kernel::{LANES, Lanes, Task, dispatch};
use crate::surrogate::{Answer, Increment, MAX_STATE, StateLanes, Tangent};

/// Columns of the state.
pub const POROSITY: usize = 0;
pub const FABRIC_INDEX: usize = 1;
pub const FABRIC_SHEAR: usize = 2;
pub const JAMMING: usize = 3;
pub const COMPRESSION: usize = 4;
/// First of the elements' shear strains, two columns for each element.
pub const SHEAR: usize = 5;
/// Number of columns.
pub const COLUMNS: usize = OWN_SHEAR + 1;
pub const STRENGTH: usize = SHEAR + 2 * ELEMENTS;
/// The packing's own conductivity, see [`Conductivity::at`]: mean, then direction.
pub const OWN_MEAN: usize = STRENGTH + 1;
pub const OWN_INDEX: usize = STRENGTH + 2;
pub const OWN_SHEAR: usize = STRENGTH + 3;

/// Names of the columns.
pub const NAMES: [&str; COLUMNS] = [
    "porosity",
    "fabric_index",
    "fabric_shear",
    "jamming_fraction",
    "elastic_compression",
    "elastic_shear_1",
    "elastic_shear_1_xy",
    "elastic_shear_2",
    "elastic_shear_2_xy",
    "strength",
    "own_conductivity",
    "own_conductivity_index",
    "own_conductivity_shear",
];

/// What answers queries.
#[derive(Clone, Debug, PartialEq)]
pub struct Core {
    pub law: Law,
    pub readout: Readout,
    pub conductivity: Conductivity,
}

struct Query<'a> {
    core: &'a Core,
    state: &'a StateLanes,
    strain: &'a Increment,
    after: &'a mut Answer,
    tangent: Option<&'a mut Tangent>,
}

impl Task for Query<'_> {
    #[inline(always)]
    fn run<V: Vector>(self) {
        let Self { core, state, strain, after, tangent } = self;
        core.advance_as::<V>(state, strain, after, tangent);
    }
}

impl Core {
    /// A core that answers with stress and state, but not with overlaps, fabric and conductivity.
    pub fn of(law: Law) -> Self {
        let conductivity =
            Conductivity { kind: ConductivityKind::Network, mean: [0.0; 11], direction: [0.0; 2] };
        Self { law, readout: Readout::default(), conductivity }
    }

    /// Lets a state have this conductivity, K_xx/k, K_yy/k, K_xy/k, as the packing's own. One that no packing has is taken as
    /// the nearest that one may have.
    pub fn give(&self, state: &mut [f64; MAX_STATE], [xx, yy, xy]: [f64; 3]) {
        state[OWN_MEAN..COLUMNS].fill(0.0);
        let mut answer = Answer::default();
        self.advance(&state.map(|value| [value; LANES]), &Increment::default(), &mut answer, None);
        let [kxx, kyy, kxy] = answer.conductivity.map(|column| column[0]);
        let (known, found) = (xx + yy, kxx + kyy);
        let limited = |value: f64, most: f64| if value.is_finite() { value.clamp(-most, most) } else { 0.0 };
        // The floor is the same for all packings; one without contacts has nothing of its own. No denominator is 0.
        let floor = 2.0 * CONDUCTIVITY_FLOOR;
        if found > floor {
            let contacts = (found - floor).max(f64::EPSILON * floor);
            state[OWN_MEAN] = limited((known - floor) / contacts - 1.0, MOST_GIVEN);
        }
        let known = known.max(f64::MIN_POSITIVE);
        state[OWN_INDEX] = limited((xx - yy) / known - (kxx - kyy) / found, MOST_GIVEN);
        state[OWN_SHEAR] = limited(2.0 * xy / known - 2.0 * kxy / found, MOST_GIVEN);
    }

    /// Strains a block of cells. Without strain the state stays as it is, bit for bit. A lane's answer depends on that lane
    /// alone, and is the same with and without `tangent`, which is the derivative of the stress by the strain at its end.
    pub fn advance(
        &self,
        state: &StateLanes,
        strain: &Increment,
        after: &mut Answer,
        tangent: Option<&mut Tangent>,
    ) {
        dispatch(Query { core: self, state, strain, after, tangent });
    }

    #[inline(always)]
    fn advance_as<V: Vector>(
        &self,
        state: &StateLanes,
        strain: &Increment,
        after: &mut Answer,
        tangent: Option<&mut Tangent>,
    ) {
        let turn = rotation(read::<V>(&strain.rotation, MOST_TURN));
        let before = elastic::<V>(state);
        let thermal = read::<V>(&strain.thermal, MOST_STRAIN);
        let [xx, yy, xy] = [&strain.xx, &strain.yy, &strain.xy].map(|part| read::<V>(part, MOST_STRAIN));
        let (next, moduli) = match tangent {
            None => {
                let strain = Strain { thermal: Plain(thermal), xx: Plain(xx), yy: Plain(yy), xy: Plain(xy) };
                self.law.advanced(&before, &strain, [Plain(turn[0]), Plain(turn[1])])
            }
            Some(tangent) => {
                let strain = Strain {
                    thermal: Dual::of(thermal),
                    xx: Dual::strain(xx, 0),
                    yy: Dual::strain(yy, 1),
                    xy: Dual::strain(xy, 2),
                };
                self.with_tangent::<V>(&before, &strain, turn, tangent)
            }
        };
        let moved = thermal.abs() + xx.abs() + yy.abs() + xy.abs() + V::read(&strain.rotation).abs();
        self.write::<V>(state, &before, (&next, &moduli), (turn, moved), after);
    }

    /// The advance with its derivatives; returns the values.
    #[inline(always)]
    fn with_tangent<V: Vector>(
        &self,
        before: &Elastic<Plain<V>>,
        strain: &Strain<Dual<V>>,
        turn: [V; 2],
        tangent: &mut Tangent,
    ) -> (Elastic<Plain<V>>, Moduli<Plain<V>>) {
        let mut from = Elastic {
            jamming: Dual::of(before.jamming.0),
            compression: Dual::of(before.compression.0),
            shear: [[Dual::of(V::zero()); 2]; ELEMENTS],
            strength: Dual::of(before.strength.0),
        };
        for k in 0..ELEMENTS {
            from.shear[k] = [Dual::of(before.shear[k][0].0), Dual::of(before.shear[k][1].0)];
        }
        let (next, moduli) = self.law.advanced(&from, strain, [Dual::of(turn[0]), Dual::of(turn[1])]);
        let [p, q1, q2] = self.law.stress(&next, &moduli);
        for (row, stress) in tangent.iter_mut().zip([p + q1, p - q1, q2]) {
            for (lanes, derivative) in row.iter_mut().zip(stress.by) {
                (V::zero() - derivative).write(lanes);
            }
        }
        let mut values = Elastic {
            jamming: Plain(next.jamming.value),
            compression: Plain(next.compression.value),
            shear: before.shear,
            strength: before.strength,
        };
        for k in 0..ELEMENTS {
            values.shear[k] = [Plain(next.shear[k][0].value), Plain(next.shear[k][1].value)];
        }
        let moduli = Moduli {
            pressure: Plain(moduli.pressure.value),
            ratio: Plain(moduli.ratio.value),
            growth: Plain(moduli.growth.value),
        };
        (values, moduli)
    }

    /// Writes the answer. Where `moved` is 0 the state stays as it was, to the last bit.
    #[inline(always)]
    fn write<V: Vector>(
        &self,
        state: &StateLanes,
        before: &Elastic<Plain<V>>,
        (next, moduli): (&Elastic<Plain<V>>, &Moduli<Plain<V>>),
        (turn, moved): ([V; 2], V),
        after: &mut Answer,
    ) {
        let stress = self.law.stress(next, moduli);
        let features = Features::of(&stress, next.looseness().0);
        let porosity = V::all(1.0) - next.solid().0 + self.readout.overlap(&features);
        let porosity = porosity.within(V::zero(), V::all(MOST_POROSITY));
        // The fabric follows the elastic state; the rest of it turns with the cell, by twice its angle.
        let old = self.law.moduli(before.compression, before.looseness());
        let from = self.readout.fabric(before, old.ratio.0);
        let to = self.readout.fabric(next, moduli.ratio.0);
        let [along, across] = [FABRIC_INDEX, FABRIC_SHEAR].map(|k| read::<V>(&state[k], MOST_FABRIC));
        let rest = [along - from[0], across - from[1]];
        let rest = turned_twice(rest, turn);
        let (low, high) = (V::all(-MOST_FABRIC), V::all(MOST_FABRIC));
        let fabric = [(rest[0] + to[0]).within(low, high), (rest[1] + to[1]).within(low, high)];
        let mut keep = |column: usize, value: V| {
            moved.where_greater(V::zero(), value, V::read(&state[column])).write(&mut after.state[column]);
        };
        keep(POROSITY, porosity);
        keep(FABRIC_INDEX, fabric[0]);
        keep(FABRIC_SHEAR, fabric[1]);
        keep(JAMMING, next.jamming.0);
        keep(COMPRESSION, next.compression.0);
        for k in 0..ELEMENTS {
            keep(SHEAR + 2 * k, next.shear[k][0].0);
            keep(SHEAR + 2 * k + 1, next.shear[k][1].0);
        }
        let own = [OWN_INDEX, OWN_SHEAR].map(|k| read::<V>(&state[k], MOST_FABRIC));
        let own = turned_twice(own, turn);
        keep(OWN_INDEX, own[0]);
        keep(OWN_SHEAR, own[1]);
        after.state[STRENGTH] = state[STRENGTH];
        after.state[OWN_MEAN] = state[OWN_MEAN];
        let [Plain(p), Plain(q1), Plain(q2)] = stress;
        (p + q1).write(&mut after.stress[0]);
        (p - q1).write(&mut after.stress[1]);
        q2.write(&mut after.stress[2]);
        let own = (read::<V>(&state[OWN_MEAN], MOST_OWN), own);
        let conductivity = self.conductivity.at(&features, porosity, fabric, own);
        for (value, column) in conductivity.into_iter().zip(&mut after.conductivity) {
            value.write(column);
        }
    }
}

#[inline(always)]
fn turned_twice<V: Vector>(vector: [V; 2], [cosine, sine]: [V; 2]) -> [V; 2] {
    let turned = |[a, b]: [V; 2]| [cosine * a - sine * b, sine * a + cosine * b];
    turned(turned(vector))
}

/// Largest porosity and fabric that a state may reach.
const MOST_POROSITY: f64 = 0.99;
const MOST_FABRIC: f64 = 0.9;
/// Beyond these, states and strains are taken at these ends, so that no input overflows. All are far from what grains do.
const LEAST_JAMMING: f64 = 0.3;
const MOST_JAMMING: f64 = 1.3;
const LEAST_COMPRESSION: f64 = -0.9;
const MOST_COMPRESSION: f64 = 1.0;
const MOST_SHEAR: f64 = 1.0;
const LEAST_STRENGTH: f64 = 0.01;
const MOST_STRENGTH: f64 = 3.0;
const MOST_STRAIN: f64 = 0.5;
const MOST_TURN: f64 = 1.0;
const MOST_OWN: f64 = 0.9;
/// Largest difference of a packing's own conductivity that is taken over.
const MOST_GIVEN: f64 = 0.5;

/// A column, limited on both sides.
#[inline(always)]
fn read<V: Vector>(lanes: &Lanes, most: f64) -> V {
    V::read(lanes).within(V::all(-most), V::all(most))
}

#[inline(always)]
fn elastic<V: Vector>(state: &StateLanes) -> Elastic<Plain<V>> {
    let between =
        |column: usize, low: f64, high: f64| Plain(V::read(&state[column]).within(V::all(low), V::all(high)));
    let jamming = between(JAMMING, LEAST_JAMMING, MOST_JAMMING);
    let compression = between(COMPRESSION, LEAST_COMPRESSION, MOST_COMPRESSION);
    let shear = |column: usize| between(column, -MOST_SHEAR, MOST_SHEAR);
    let mut all = [[jamming; 2]; ELEMENTS];
    for (k, both) in all.iter_mut().enumerate() {
        *both = [shear(SHEAR + 2 * k), shear(SHEAR + 2 * k + 1)];
    }
    let strength = between(STRENGTH, LEAST_STRENGTH, MOST_STRENGTH);
    Elastic { jamming, compression, shear: all, strength }
}

const _: () = assert!(COLUMNS <= MAX_STATE);

#[cfg(test)]
#[path = "core_tests.rs"]
mod tests;
