//! Answers of the law, a block of cells at a time.

use super::law::{ELEMENTS, Elastic, Law, Moduli, Strain, rotation};
use super::readout::{CONDUCTIVITY_FLOOR, Conductivity, Features, Readout};
use crate::dataset::ConductivityKind;
use crate::kernel::vector::Vector;
use crate::kernel::{LANES, Lanes, Task, dispatch};
use crate::number::{Dual, Number};
use crate::scaling::Range;
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
    /// InitialData ranges of the state columns and of the thermal strain.
    pub ranges: [Range; COLUMNS + 1],
}

/// A range without ends.
pub const ANY: Range = Range { min: f64::NEG_INFINITY, max: f64::INFINITY };

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
            Conductivity { kind: ConductivityKind::Network, mean: [0.0; 11], direction: [0.0; 3] };
        Self { law, readout: Readout::default(), conductivity, ranges: [ANY; COLUMNS + 1] }
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
            state[OWN_MEAN] = limited((known - floor) / contacts - 1.0, MAX_GIVEN);
        }
        let known = known.max(f64::MIN_POSITIVE);
        state[OWN_INDEX] = limited((xx - yy) / known - (kxx - kyy) / found, MAX_GIVEN);
        state[OWN_SHEAR] = limited(2.0 * xy / known - 2.0 * kxy / found, MAX_GIVEN);
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
        let turn = rotation(read::<V>(&strain.rotation, MAX_TURN));
        let before = elastic::<V>(&self.law, state);
        let thermal = read::<V>(&strain.thermal, MAX_STRAIN);
        let (xx, yy) = (read::<V>(&strain.xx, MAX_STRAIN), read::<V>(&strain.yy, MAX_STRAIN));
        let xy = read::<V>(&strain.xy, MAX_STRAIN);
        let (next, moduli) = match tangent {
            None => {
                let strain = Strain { thermal, xx, yy, xy };
                self.law.advanced(&before, &strain, [turn[0], turn[1]])
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
        for ((values, range), outside) in state.iter().zip(&self.ranges[..COLUMNS]).zip(&mut after.outside) {
            beyond::<V>(values, range, outside);
        }
        beyond::<V>(&strain.thermal, &self.ranges[COLUMNS], &mut after.outside[MAX_STATE]);
        let moved = thermal.abs() + xx.abs() + yy.abs() + xy.abs() + V::read(&strain.rotation).abs();
        self.write::<V>(state, &before, (&next, &moduli), (turn, moved), after);
    }

    /// The advance with its derivatives; returns the values.
    #[inline(always)]
    fn with_tangent<V: Vector>(
        &self,
        before: &Elastic<V>,
        strain: &Strain<Dual<V, 3>>,
        turn: [V; 2],
        tangent: &mut Tangent,
    ) -> (Elastic<V>, Moduli<V>) {
        let mut from = Elastic {
            jamming: Dual::of(before.jamming),
            compression: Dual::of(before.compression),
            shear: [[Dual::of(V::zero()); 2]; ELEMENTS],
            strength: Dual::of(before.strength),
        };
        for k in 0..ELEMENTS {
            from.shear[k] = [Dual::of(before.shear[k][0]), Dual::of(before.shear[k][1])];
        }
        let (next, moduli) = self.law.advanced(&from, strain, [Dual::of(turn[0]), Dual::of(turn[1])]);
        let [p, q1, q2] = self.law.stress(&next, &moduli);
        for (row, stress) in tangent.iter_mut().zip([p + q1, p - q1, q2]) {
            for (lanes, derivative) in row.iter_mut().zip(stress.by) {
                (V::zero() - derivative).write(lanes);
            }
        }
        let mut values = Elastic {
            jamming: next.jamming.value,
            compression: next.compression.value,
            shear: before.shear,
            strength: before.strength,
        };
        for k in 0..ELEMENTS {
            values.shear[k] = [next.shear[k][0].value, next.shear[k][1].value];
        }
        let moduli = Moduli {
            pressure: moduli.pressure.value,
            ratio: moduli.ratio.value,
            growth: moduli.growth.value,
        };
        (values, moduli)
    }

    /// Writes the answer. Where `moved` is 0 the state stays as it was, to the last bit.
    #[inline(always)]
    fn write<V: Vector>(
        &self,
        state: &StateLanes,
        before: &Elastic<V>,
        (next, moduli): (&Elastic<V>, &Moduli<V>),
        (turn, moved): ([V; 2], V),
        after: &mut Answer,
    ) {
        let stress = self.law.stress(next, moduli);
        let features = Features::of(&stress, next.looseness());
        let porosity = V::all(1.0) - next.solid() + self.readout.overlap(&features);
        let porosity = porosity.within(V::zero(), V::all(MAX_POROSITY));
        // Part of the fabric follows the stress; the rest of it turns with the cell, by twice its angle.
        let old = self.law.stress(before, &self.law.moduli(before.compression, before.looseness()));
        let old = Features::of(&old, before.looseness());
        let from =
            self.readout.fabric(&old, V::read(&state[POROSITY]).within(V::zero(), V::all(MAX_POROSITY)));
        let to = self.readout.fabric(&features, porosity);
        let along = read::<V>(&state[FABRIC_INDEX], MAX_FABRIC) - from[0];
        let rest = [along, read::<V>(&state[FABRIC_SHEAR], MAX_FABRIC) - from[1]];
        let rest = turned_twice(rest, turn);
        let (low, high) = (V::all(-MAX_FABRIC), V::all(MAX_FABRIC));
        let fabric = [(rest[0] + to[0]).within(low, high), (rest[1] + to[1]).within(low, high)];
        let own = [read::<V>(&state[OWN_INDEX], MAX_FABRIC), read::<V>(&state[OWN_SHEAR], MAX_FABRIC)];
        let own = turned_twice(own, turn);
        let mut values = [V::zero(); COLUMNS];
        values[POROSITY] = porosity;
        values[FABRIC_INDEX] = fabric[0];
        values[FABRIC_SHEAR] = fabric[1];
        values[JAMMING] = next.jamming;
        values[COMPRESSION] = next.compression;
        for k in 0..ELEMENTS {
            values[SHEAR + 2 * k] = next.shear[k][0];
            values[SHEAR + 2 * k + 1] = next.shear[k][1];
        }
        values[STRENGTH] = V::read(&state[STRENGTH]);
        values[OWN_MEAN] = V::read(&state[OWN_MEAN]);
        values[OWN_INDEX] = own[0];
        values[OWN_SHEAR] = own[1];
        for k in 0..COLUMNS {
            values[k] = moved.where_greater(V::zero(), values[k], V::read(&state[k]));
            values[k].write(&mut after.state[k]);
        }
        let [p, q1, q2] = stress;
        (p + q1).write(&mut after.stress[0]);
        (p - q1).write(&mut after.stress[1]);
        q2.write(&mut after.stress[2]);
        // The conductivity is that of the state that is answered, so that it is the same, to the last bit, when that state is
        // evaluated again.
        let porosity = values[POROSITY].within(V::zero(), V::all(MAX_POROSITY));
        let fabric = [values[FABRIC_INDEX].within(low, high), values[FABRIC_SHEAR].within(low, high)];
        let own = [values[OWN_INDEX].within(low, high), values[OWN_SHEAR].within(low, high)];
        let own = (values[OWN_MEAN].within(V::all(-MAX_OWN), V::all(MAX_OWN)), own);
        let conductivity = self.conductivity.at(&features, porosity, fabric, own);
        for (value, column) in conductivity.into_iter().zip(&mut after.conductivity) {
            value.write(column);
        }
    }
}

#[inline(always)]
fn turned_twice<V: Vector>(vector: [V; 2], [cosine, sine]: [V; 2]) -> [V; 2] {
    let [a, b] = vector;
    let (a, b) = (cosine * a - sine * b, sine * a + cosine * b);
    [cosine * a - sine * b, sine * a + cosine * b]
}

/// How far values are outside of a range.
#[inline(always)]
fn beyond<V: Vector>(values: &Lanes, range: &Range, outside: &mut Lanes) {
    let value = V::read(values);
    (value - value.within(V::all(range.min), V::all(range.max))).write(outside);
}

/// Largest porosity and fabric that a state may reach.
const MAX_POROSITY: f64 = 0.99;
const MAX_FABRIC: f64 = 0.9;
/// Beyond these, states and strains are taken at these ends, so that no input overflows. All are far from what grains do.
const MIN_JAMMING: f64 = 0.3;
const MAX_JAMMING: f64 = 1.3;
const MIN_COMPRESSION: f64 = -0.9;
const MAX_COMPRESSION: f64 = 1.0;
const MAX_SHEAR: f64 = 1.0;
const MIN_STRENGTH: f64 = 0.01;
const MAX_STRAIN: f64 = 0.5;
const MAX_TURN: f64 = 1.0;
const MAX_OWN: f64 = 0.9;
/// Largest difference of a packing's own conductivity that is taken over.
const MAX_GIVEN: f64 = 0.5;

/// A column, limited on both sides.
#[inline(always)]
fn read<V: Vector>(lanes: &Lanes, most: f64) -> V {
    V::read(lanes).within(V::all(-most), V::all(most))
}

#[inline(always)]
fn elastic<V: Vector>(law: &Law, state: &StateLanes) -> Elastic<V> {
    let jamming = V::read(&state[JAMMING]).within(V::all(MIN_JAMMING), V::all(MAX_JAMMING));
    let compression = V::read(&state[COMPRESSION]).within(V::all(MIN_COMPRESSION), V::all(MAX_COMPRESSION));
    let mut all = [[jamming; 2]; ELEMENTS];
    for k in 0..ELEMENTS {
        let along = read::<V>(&state[SHEAR + 2 * k], MAX_SHEAR);
        all[k] = [along, read::<V>(&state[SHEAR + 2 * k + 1], MAX_SHEAR)];
    }
    let strength = V::read(&state[STRENGTH]).within(V::all(MIN_STRENGTH), V::all(law.most_strength()));
    Elastic { jamming, compression, shear: all, strength }
}

const _: () = assert!(COLUMNS <= MAX_STATE);

#[cfg(test)]
#[path = "core_tests.rs"]
mod tests;
