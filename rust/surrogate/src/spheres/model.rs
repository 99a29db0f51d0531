//! The model of spheres: law and readouts, and their file.

use super::components::{six, three};
use super::law::{Law, Strain};
use super::number::{Differentiable, Dual, Number};
use super::readout::Readout;
use super::state::{ELEMENTS, PackingData, State};
use super::tensor::{Tensor, contraction, mean, rotation};
use crate::SurrogateError;
use crate::document::{field, hash, json, schema};
use crate::kernel::vector::{Arithmetic, Vector, part};
use crate::kernel::{LANES, Lanes, Task, dispatch_narrow};
use crate::options::TrainingOptions;
use crate::scaling::Range;
use serde::{Deserialize, Serialize};

pub const SCHEMA: &str = "msdd-spheres-model-13";

/// Number of state columns of a cell, and of those before the stress ratios.
pub const COLUMNS: usize = SCALARS + 5 * ELEMENTS;
const SCALARS: usize = 5;

/// Names of the state columns. The component zz of a stress ratio is that without which its trace is not 0.
pub const NAMES: [&str; COLUMNS] = [
    "jamming_fraction",
    "elastic_compression",
    "strength",
    "mobilised",
    "coordination",
    "stress_ratio_1_xx",
    "stress_ratio_1_yy",
    "stress_ratio_1_xy",
    "stress_ratio_1_xz",
    "stress_ratio_1_yz",
    "stress_ratio_2_xx",
    "stress_ratio_2_yy",
    "stress_ratio_2_xy",
    "stress_ratio_2_xz",
    "stress_ratio_2_yz",
    "stress_ratio_3_xx",
    "stress_ratio_3_yy",
    "stress_ratio_3_xy",
    "stress_ratio_3_xz",
    "stress_ratio_3_yz",
    "stress_ratio_4_xx",
    "stress_ratio_4_yy",
    "stress_ratio_4_xy",
    "stress_ratio_4_xz",
    "stress_ratio_4_yz",
];

/// Ranges of the states of the training.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ranges {
    pub jamming_fraction: Range,
    /// p/E*.
    pub pressure: Range,
    /// Largest length of η.
    pub stress_ratio: f64,
}

/// What the training found.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Report {
    /// Packings and paths that were seen, and that were held out.
    pub packings: [usize; 2],
    pub paths: [usize; 2],
    pub parameters: usize,
    pub epochs: u32,
    pub mean_square: f64,
}

/// The file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    pub schema: String,
    pub name: String,
    pub law: Law,
    pub readout: Readout,
    pub ranges: Ranges,
    pub library_version: String,
    pub training: TrainingOptions,
    pub report: Report,
}

/// A model that can be asked; immutable.
#[derive(Clone, Debug)]
pub struct SphereModel {
    pub file: File,
    hash: String,
}

/// What may be outside of the training: jamming fraction, pressure, stress ratio.
pub const OUTSIDE: [u8; 3] = [1, 2, 4];

/// What a model answers for a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// State after the strain; after no strain it is the state before, bit for bit.
    pub state: [f64; COLUMNS],
    /// σ over E*, compression positive.
    pub stress: Tensor,
    /// −dσ/de for e_xx, e_yy, e_zz, 2 e_xy, 2 e_xz, 2 e_yz, row by row; asked for or zero.
    pub tangent: [Tensor; 6],
    /// κ_c, the mean of κ_g, and its deviator over that.
    pub contact: Tensor,
    pub gas: f64,
    pub gas_deviator: Tensor,
    /// φ.
    pub solid: f64,
    /// z.
    pub coordination: f64,
    /// What is outside of the training: the sum of [`OUTSIDE`].
    pub outside: u8,
}

/// The strain of a cell: extension positive; xy, xz, yz are twice the shears.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Increment {
    /// Growth of the radii.
    pub thermal: f64,
    pub cell: Tensor,
    /// Vector of the angle by which the cell turns \[rad\].
    pub rotation: [f64; 3],
}

/// Beyond these, states and strains are taken at these ends, so that no input overflows. All are far from what grains do.
const JAMMING: [f64; 2] = [0.3, 0.8];
const COMPRESSION: [f64; 2] = [-0.9, 0.5];
const STRENGTH: [f64; 2] = [0.01, super::law::MAX_STRENGTH];
const MOBILISED: [f64; 2] = [0.0, 1.0];
const COORDINATION: [f64; 2] = [0.0, 12.0];
const MAX_RATIO: f64 = 2.0;
const MAX_STRAIN: f64 = 0.2;

/// The states that the model takes, which are those that it answers: least and largest value of a column, and both as text. A packing of
/// another state does not exist.
pub fn allowed(column: usize) -> ([f64; 2], &'static str) {
    match column {
        0 => (JAMMING, "0.3 to 0.8"),
        1 => (COMPRESSION, "-0.9 to 0.5"),
        2 => (STRENGTH, "0.01 to 8"),
        3 => (MOBILISED, "0 to 1"),
        4 => (COORDINATION, "0 to 12"),
        _ => ([-MAX_RATIO, MAX_RATIO], "-2 to 2"),
    }
}

/// ln(R/h) of the gas of a test packing, and between what its answers lie: the shipped model's by factors of about 4 on either side.
const TEST_GAS: f64 = 6.0;
const TEST_PRESSURE: [f64; 2] = [0.3, 1e4];
const TEST_CONTACT: [f64; 2] = [0.2, 5.0];
const TEST_GAS_CONDUCTION: [f64; 2] = [3.0, 50.0];

/// Numbers within an interval; its lower end for those that are none.
#[inline(always)]
fn between<V: Arithmetic>(value: V, [low, high]: [f64; 2]) -> V {
    value.within(V::all(low), V::all(high))
}

/// Numbers of at most this size; 0 for those that are none.
#[inline(always)]
fn small<V: Arithmetic>(value: V, most: f64) -> V {
    value.abs().where_greater(V::all(-1.0), between(value, [-most, most]), V::zero())
}

/// The columns of a state.
#[inline(always)]
pub fn columns<V: Arithmetic + Number<Values = V>>(state: &State<V>) -> [V; COLUMNS] {
    let mut columns = [V::zero(); COLUMNS];
    let State { jamming, compression, strength, mobilised, coordination, .. } = *state;
    columns[..SCALARS].copy_from_slice(&[jamming, compression, strength, mobilised, coordination]);
    for (k, &[xx, yy, _, xy, xz, yz]) in state.ratios.iter().enumerate() {
        columns[SCALARS + 5 * k..][..5].copy_from_slice(&[xx, yy, xy, xz, yz]);
    }
    columns
}

/// The state of columns.
#[inline(always)]
pub fn state<V: Arithmetic + Number<Values = V>>(columns: &[V; COLUMNS]) -> State<V> {
    let mut ratios = [[V::zero(); 6]; ELEMENTS];
    for (k, ratio) in ratios.iter_mut().enumerate() {
        let first = SCALARS + 5 * k;
        let xx = small(columns[first], MAX_RATIO);
        let yy = small(columns[first + 1], MAX_RATIO);
        let xy = small(columns[first + 2], MAX_RATIO);
        let xz = small(columns[first + 3], MAX_RATIO);
        let yz = small(columns[first + 4], MAX_RATIO);
        *ratio = [xx, yy, V::zero() - xx - yy, xy, xz, yz];
    }
    State {
        jamming: between(columns[0], JAMMING),
        compression: between(columns[1], COMPRESSION),
        strength: between(columns[2], STRENGTH),
        mobilised: between(columns[3], MOBILISED),
        coordination: between(columns[4], COORDINATION),
        ratios,
    }
}

/// What is asked for a block of cells, in columns: the state before, the strain and rotation of [`Increment`], and the number of the gas.
#[derive(Clone, Debug)]
pub struct Block {
    pub state: [Lanes; COLUMNS],
    pub thermal: Lanes,
    pub cell: [Lanes; 6],
    pub rotation: [Lanes; 3],
    pub gas_number: Lanes,
}

impl Default for Block {
    fn default() -> Self {
        let zero = [0.0; LANES];
        Self { state: [zero; COLUMNS], thermal: zero, cell: [zero; 6], rotation: [zero; 3], gas_number: zero }
    }
}

/// What is wanted of the answers for a block, apart from state and stress.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wanted {
    /// The derivatives of the stress by this many of the strains xx, yy, zz, xy, xz, yz: 0, 4 (in the plane) or 6. A number between is
    /// taken as the next larger one.
    pub strains: usize,
    /// κ_c and κ_g.
    pub conduction: bool,
}

/// The answers for a block, in columns: those of [`Answer`]. What is not wanted stays as it is.
#[derive(Clone, Debug)]
pub struct Answers {
    pub state: [Lanes; COLUMNS],
    pub stress: [Lanes; 6],
    pub tangent: [[Lanes; 6]; 6],
    pub contact: [Lanes; 6],
    pub gas: Lanes,
    pub gas_deviator: [Lanes; 6],
    pub solid: Lanes,
    pub coordination: Lanes,
    pub outside: Lanes,
}

impl Default for Answers {
    fn default() -> Self {
        let zero = [0.0; LANES];
        Self {
            state: [zero; COLUMNS],
            stress: [zero; 6],
            tangent: [[zero; 6]; 6],
            contact: [zero; 6],
            gas: zero,
            gas_deviator: [zero; 6],
            solid: zero,
            coordination: zero,
            outside: zero,
        }
    }
}

impl Answers {
    /// [`Answer::outside`] of one cell.
    pub fn outside_at(&self, cell: usize) -> u8 {
        // A sum of three small integers.
        self.outside[cell] as u8
    }

    /// The answer for one cell.
    pub fn at(&self, cell: usize) -> Answer {
        Answer {
            state: self.state.map(|column| column[cell]),
            stress: self.stress.map(|column| column[cell]),
            tangent: self.tangent.map(|row| row.map(|column| column[cell])),
            contact: self.contact.map(|column| column[cell]),
            gas: self.gas[cell],
            gas_deviator: self.gas_deviator.map(|column| column[cell]),
            solid: self.solid[cell],
            coordination: self.coordination[cell],
            outside: self.outside_at(cell),
        }
    }
}

/// The work of [`SphereModel::advance_block`].
struct Advance<'a> {
    model: &'a SphereModel,
    block: &'a Block,
    cells: usize,
    wanted: Wanted,
    answers: &'a mut Answers,
}

impl Task for Advance<'_> {
    #[inline(always)]
    fn run<V: Vector>(self) {
        for first in (0..self.cells).step_by(V::WIDTH) {
            let Wanted { strains, conduction } = self.wanted;
            match strains {
                0 => some::<V, V>(self.model, self.block, first, conduction, self.answers),
                1..=4 => some::<V, Dual<V, 4>>(self.model, self.block, first, conduction, self.answers),
                _ => some::<V, Dual<V, 6>>(self.model, self.block, first, conduction, self.answers),
            }
        }
    }
}

impl SphereModel {
    pub fn of(file: File) -> Self {
        let hash = hash(&(json(&file) + "\n"));
        Self { file, hash }
    }

    /// Reads the text of a model file.
    ///
    /// # Errors
    /// [`SurrogateError::Damaged`], [`SurrogateError::Schema`] or [`SurrogateError::Field`].
    pub fn read(text: &str) -> Result<Self, SurrogateError> {
        let found = schema(text)?;
        if found != SCHEMA {
            return Err(SurrogateError::Schema { found, expected: SCHEMA });
        }
        let file: File =
            serde_json::from_str(text).map_err(|error| SurrogateError::Damaged(error.to_string()))?;
        file.law.check()?;
        let Readout { contact, direction, gas, gas_direction } = &file.readout;
        let all = contact.iter().chain(direction).chain(gas.as_flattened()).chain([gas_direction]);
        if let Some(value) = all.into_iter().find(|value| value.is_nan() || value.abs() > 1e9) {
            return field("readout (a coefficient)", value, "-1e9 to 1e9");
        }
        let model = Self { file, hash: hash(text) };
        model.check_answers()?;
        Ok(model)
    }

    /// Refuses a model whose answers are far from those of any packing of spheres, as of a file with a digit changed.
    fn check_answers(&self) -> Result<(), SurrogateError> {
        for (solid, pressure) in [(0.58, 1e-6), (0.58, 1e-4), (0.62, 1e-6), (0.62, 1e-4)] {
            let state = self.initial_state(
                solid,
                [pressure, pressure, pressure, 0.0, 0.0, 0.0],
                &PackingData::default(),
            );
            for cell in [[0.0; 6], [-1e-4, -1e-4, -1e-4, 0.0, 0.0, 0.0], [0.0, 0.0, -1e-3, 0.0, 0.0, 0.0]] {
                let strain = Increment { cell, ..Increment::default() };
                let Answer { stress, contact, gas, .. } = self.advance(&state, &strain, TEST_GAS, false);
                let borne = mean(stress);
                let contact = mean(contact) / libm::cbrt(borne);
                for (key, value, [least, most], allowed) in [
                    ("pressure over the initial one", borne / pressure, TEST_PRESSURE, "0.3 to 1e4"),
                    ("conduction by contacts over (p/E*)^(1/3)", contact, TEST_CONTACT, "0.2 to 5"),
                    ("conductivity by gas over k of the gas", gas, TEST_GAS_CONDUCTION, "3 to 50"),
                ] {
                    if !(least..=most).contains(&value) {
                        return field(&format!("{key} of a test packing"), value, allowed);
                    }
                }
            }
        }
        Ok(())
    }

    /// Whether a text is the file of such a model.
    pub fn has_sphere_schema(text: &str) -> bool {
        schema(text).is_ok_and(|found| found.starts_with("msdd-spheres-model-"))
    }

    /// The model compiled into the library.
    ///
    /// # Errors
    /// Those of [`SphereModel::read`].
    pub fn builtin() -> Result<Self, SurrogateError> {
        Self::read(include_str!("../../models/spheres.json"))
    }

    pub fn to_json(&self) -> String {
        json(&self.file) + "\n"
    }

    /// SHA-256 of the model's file, 64 hexadecimal digits.
    pub fn hash(&self) -> &str {
        &self.hash
    }

    /// The state of a cell with this solid fraction φ, stress over E*, and what else is known of it.
    pub fn initial_state(&self, solid: f64, stress: Tensor, known: &PackingData) -> [f64; COLUMNS] {
        // As it is read again from its columns.
        columns(&state(&columns(&self.file.law.start(between(solid, JAMMING), stress, known))))
    }

    /// Strains a cell. Finite inputs give finite answers.
    pub fn advance(
        &self,
        before: &[f64; COLUMNS],
        strain: &Increment,
        gas_number: f64,
        tangent: bool,
    ) -> Answer {
        let all = |value: f64| [value; LANES];
        let block = Block {
            state: before.map(all),
            thermal: all(strain.thermal),
            cell: strain.cell.map(all),
            rotation: strain.rotation.map(all),
            gas_number: all(gas_number),
        };
        let mut answers = Answers::default();
        let wanted = Wanted { strains: if tangent { 6 } else { 0 }, conduction: true };
        self.advance_block(&block, 1, wanted, &mut answers);
        answers.at(0)
    }

    /// Strains the first `cells` of a block. The answer for a cell does not depend on the others, nor on the processor. That for others
    /// of the block stays as it is or is that of their columns.
    pub fn advance_block(&self, block: &Block, cells: usize, wanted: Wanted, answers: &mut Answers) {
        dispatch_narrow(Advance { model: self, block, cells: cells.min(LANES), wanted, answers });
    }

    /// The answers for the cells from `first` on, by numbers with their derivatives or without.
    #[inline(always)]
    fn some<V: Vector, N: Differentiable<V>>(
        &self,
        block: &Block,
        first: usize,
        conduction: bool,
        answers: &mut Answers,
    ) {
        let law = &self.file.law;
        let mut before = [V::zero(); COLUMNS];
        for (value, column) in before.iter_mut().zip(&block.state) {
            *value = V::read(&column[first..]);
        }
        let from = state(&before);
        let thermal = small(V::read(&block.thermal[first..]), MAX_STRAIN);
        let cell = six!(k => small(V::read(&block.cell[k][first..]), MAX_STRAIN));
        let turn = three!(k => small(V::read(&block.rotation[k][first..]), 1.0));
        // 0 where nothing happens.
        let mut moved = thermal.abs();
        for part in cell.iter().chain(&turn) {
            moved = moved + part.abs();
        }
        let mut next = from;
        if N::DIFFERENTIATES || moved.any_greater(V::zero()) {
            let strain = Strain { thermal, cell: N::strains(cell) };
            let half = rotation(three!(k => turn[k] * V::all(0.5)));
            let reached = law.advanced(&State::<N>::fixed(&from), &strain, &half);
            if N::DIFFERENTIATES {
                let stress = law.stress(&reached);
                for (row, part) in answers.tangent.iter_mut().zip(&stress) {
                    for (column, by) in row.iter_mut().zip(&part.derivatives()) {
                        (V::zero() - *by).write(&mut column[first..]);
                    }
                }
            }
            // As it is read again from its columns, so that it answers the same then, to the last bit.
            let reached = state(&columns(&reached.values()));
            next = State::where_greater([moved, V::zero()], &reached, &from);
        }
        answer(self, block, first, conduction, (&before, &next, moved), answers);
    }

    /// Writes the answers for states before and after a strain, without derivatives. Where `moved` is 0 the state stays as it was.
    #[inline(always)]
    fn write<V: Vector>(
        &self,
        block: &Block,
        first: usize,
        conduction: bool,
        (before, next, moved): (&[V; COLUMNS], &State<V>, V),
        answers: &mut Answers,
    ) {
        let law = &self.file.law;
        let stress = law.stress(next);
        let ratio = law.deviator(&next.ratio());
        let Ranges { jamming_fraction, pressure, stress_ratio } = self.file.ranges;
        let zero = V::zero();
        let [density, pressed, sheared] = OUTSIDE.map(f64::from);
        let dense = next.jamming.where_greater(V::all(jamming_fraction.max), V::all(density), zero);
        let of_density = V::all(jamming_fraction.min).where_greater(next.jamming, V::all(density), dense);
        let of_pressure = mean(stress).where_greater(V::all(pressure.max), V::all(pressed), zero);
        let most = V::all(stress_ratio * stress_ratio);
        let of_ratio = contraction(&ratio, &ratio).where_greater(most, V::all(sheared), zero);
        let outside = of_density + of_pressure + of_ratio;
        let readout = &self.file.readout;
        // After no strain the state before, bit for bit.
        for ((column, value), before) in answers.state.iter_mut().zip(&columns(next)).zip(before) {
            moved.where_greater(zero, *value, *before).write(&mut column[first..]);
        }
        for (column, value) in answers.stress.iter_mut().zip(&stress) {
            value.write(&mut column[first..]);
        }
        next.solid().write(&mut answers.solid[first..]);
        next.coordination.write(&mut answers.coordination[first..]);
        outside.write(&mut answers.outside[first..]);
        if !conduction {
            return;
        }
        for (column, value) in answers.contact.iter_mut().zip(&readout.contact(&law.contacts, next, &stress))
        {
            value.write(&mut column[first..]);
        }
        readout.gas(next, V::read(&block.gas_number[first..])).write(&mut answers.gas[first..]);
        for (column, value) in answers.gas_deviator.iter_mut().zip(&readout.gas_deviator(next)) {
            value.write(&mut column[first..]);
        }
    }
}

part! {
    /// [`SphereModel::some`].
    by V::apart => fn some<'a, V: Vector, N: Differentiable<V>>(
        model: &'a SphereModel, block: &'a Block, first: usize, conduction: bool, answers: &'a mut Answers,
    ) {
        model.some::<V, N>(block, first, conduction, answers);
    }
}
part! {
    /// [`SphereModel::write`].
    by V::apart => fn answer<'a, V: Vector>(
        model: &'a SphereModel, block: &'a Block, first: usize, conduction: bool, states: (&'a [V; COLUMNS], &'a State<V>, V),
        answers: &'a mut Answers,
    ) {
        model.write(block, first, conduction, states, answers);
    }
}
