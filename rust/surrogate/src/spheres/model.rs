//! The model of spheres: law and readouts, and their file.

use super::law::{Law, Strain};
use super::number::Dual;
use super::readout::Readout;
use super::state::{ELEMENTS, Known, State};
use super::tensor::{Rotation, Tensor, contraction};
use crate::SurrogateError;
use crate::document::{field, hash, json, schema};
use crate::options::TrainingOptions;
use crate::scaling::Range;
use serde::{Deserialize, Serialize};

pub const SCHEMA: &str = "msdd-spheres-model-8";

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

/// What a model answers for a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// State after the strain; after no strain it is the state before, bit for bit.
    pub state: [f64; COLUMNS],
    /// σ over E*, compression positive.
    pub stress: Tensor,
    /// −dσ/de for e_xx, e_yy, e_zz, 2 e_xy, 2 e_xz, 2 e_yz, row by row; asked for or zero.
    pub tangent: [Tensor; 6],
    /// κ_c and κ_g.
    pub contact: Tensor,
    pub gas: f64,
    /// φ.
    pub solid: f64,
    /// z.
    pub coordination: f64,
    /// Whether jamming fraction, pressure or stress ratio are outside of those of the training.
    pub outside: bool,
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
const STRENGTH: [f64; 2] = [0.01, super::law::MOST_STRENGTH];
const MOBILISED: [f64; 2] = [0.0, 1.0];
const COORDINATION: [f64; 2] = [0.0, 12.0];
const MOST_RATIO: f64 = 2.0;
const MOST_STRAIN: f64 = 0.2;

/// A number within an interval; its lower end for one that is none.
fn limited(value: f64, [low, high]: [f64; 2]) -> f64 {
    if value > low { value.min(high) } else { low }
}

/// A number of at most this size; 0 for one that is none.
fn small(value: f64, most: f64) -> f64 {
    if value.is_nan() { 0.0 } else { value.clamp(-most, most) }
}

/// The columns of a state.
pub fn columns(state: &State) -> [f64; COLUMNS] {
    let mut columns = [0.0; COLUMNS];
    let State { jamming, compression, strength, mobilised, coordination, .. } = *state;
    columns[..SCALARS].copy_from_slice(&[jamming, compression, strength, mobilised, coordination]);
    for (k, [xx, yy, _, xy, xz, yz]) in state.ratios.into_iter().enumerate() {
        columns[SCALARS + 5 * k..][..5].copy_from_slice(&[xx, yy, xy, xz, yz]);
    }
    columns
}

/// The state of columns.
pub fn state(columns: &[f64; COLUMNS]) -> State {
    let ratios = std::array::from_fn(|k| {
        let part = |i: usize| small(columns[SCALARS + 5 * k + i], MOST_RATIO);
        let (xx, yy) = (part(0), part(1));
        [xx, yy, -xx - yy, part(2), part(3), part(4)]
    });
    State {
        jamming: limited(columns[0], JAMMING),
        compression: limited(columns[1], COMPRESSION),
        strength: limited(columns[2], STRENGTH),
        mobilised: limited(columns[3], MOBILISED),
        coordination: limited(columns[4], COORDINATION),
        ratios,
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
        let Readout { contact, direction, gas } = &file.readout;
        let all = contact.iter().chain(direction).chain(gas.as_flattened());
        if let Some(value) = all.into_iter().find(|value| value.is_nan() || value.abs() > 1e9) {
            return field("readout (a coefficient)", value, "-1e9 to 1e9");
        }
        Ok(Self { file, hash: hash(text) })
    }

    /// Whether a text is the file of such a model.
    pub fn is_meant(text: &str) -> bool {
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
    pub fn initial_state(&self, solid: f64, stress: Tensor, known: &Known) -> [f64; COLUMNS] {
        columns(&self.file.law.start(limited(solid, JAMMING), stress, known))
    }

    /// Strains a cell. Finite inputs give finite answers.
    pub fn advance(
        &self,
        before: &[f64; COLUMNS],
        strain: &Increment,
        gas_number: f64,
        tangent: bool,
    ) -> Answer {
        let law = &self.file.law;
        let from = state(before);
        let thermal = small(strain.thermal, MOST_STRAIN);
        let cell = strain.cell.map(|part| small(part, MOST_STRAIN));
        let half = super::tensor::rotation(strain.rotation.map(|angle| 0.5 * small(angle, 1.0)));
        let still = strain == &Increment::default();
        let (next, derivatives) = if tangent {
            self.with_tangent(&from, thermal, cell, &half)
        } else {
            let next = if still { from } else { law.advanced(&from, &Strain { thermal, cell }, &half) };
            (next, [[0.0; 6]; 6])
        };
        // As it is read again from its columns, so that it answers the same then, to the last bit.
        let next = if still { from } else { state(&columns(&next)) };
        let stress = law.stress(&next);
        let ratio = next.ratio();
        let Ranges { jamming_fraction, pressure, stress_ratio } = self.file.ranges;
        let within = |range: Range, value: f64| range.min <= value && value <= range.max;
        let inside = within(jamming_fraction, next.jamming)
            && super::tensor::mean(stress) <= pressure.max
            && contraction(&ratio, &ratio) <= stress_ratio * stress_ratio;
        Answer {
            state: if still { *before } else { columns(&next) },
            stress,
            tangent: derivatives,
            contact: self.file.readout.contact(&next, &stress),
            gas: self.file.readout.gas(&next, gas_number),
            solid: next.solid(),
            coordination: next.coordination,
            outside: !inside,
        }
    }

    fn with_tangent(
        &self,
        from: &State,
        thermal: f64,
        cell: Tensor,
        half: &Rotation,
    ) -> (State, [Tensor; 6]) {
        let law = &self.file.law;
        let mut k = 0;
        let cell = cell.map(|part| {
            k += 1;
            Dual::strain(part, k - 1)
        });
        let strain = Strain { thermal: super::number::Number::of(thermal), cell };
        let next = law.advanced(&from.fixed::<Dual>(), &strain, half);
        let stress = law.stress(&next);
        (next.value(), stress.map(|component| component.by.map(|by| -by)))
    }
}
