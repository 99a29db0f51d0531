//! The law of the increments with all that a case needs besides, as a [`Surrogate`].

use super::core::{
    COLUMNS, COMPRESSION, Core, FABRIC_INDEX, FABRIC_SHEAR, JAMMING, NAMES, POROSITY, SHEAR, STRENGTH,
};
use super::errors::{path_errors, probe_errors};
use super::mean::MeanStress;
use super::readout::{Conductivity, Features};
use super::start::start;
use crate::SurrogateError;
use crate::dataset::ConductivityKind;
use crate::document::{field, hash, json, schema};
use crate::kernel::LANES;
use crate::kernel::vector::{Arithmetic, Portable};
use crate::network::WEIGHT_LIMIT;
use crate::options::TrainingOptions;
use crate::region::{Coordinates, MAX_COORDINATES, Region, Spread};
use crate::scaling::Range;
use crate::solid_fraction::SolidFraction;
use crate::surrogate::{
    Answer, Increment, InitialData, MAX_STATE, StateLanes, Surrogate, Tangent, Uncertainty,
};
use crate::tracks::{PathErrors, ProbeErrors, Track};
use crate::wall_friction::WallFriction;
use serde::{Deserialize, Serialize};

/// Name of the schema. Its number is increased when a reader of the old schema would misread the new one.
pub const SCHEMA: &str = "msdd-increment-model-1";

/// A trained model; the module [`super`] explains its law.
#[derive(Clone, Debug, PartialEq)]
pub struct IncrementModel {
    pub core: Core,
    pub file: File,
    pub(crate) hash: String,
}

/// The model file: JSON; every number is kept to the last bit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    /// `msdd-increment-model-1`.
    pub schema: String,
    /// Name of the model.
    pub name: String,
    /// Smallest and largest value of each input along the paths of the training, and of the reduced pressure.
    pub ranges: Ranges,
    /// The numbers of the law: `bulk`, `looseness`, `onset`, `shear`, for each of two `elements` its `share`, `strength` and
    /// `dilatancy`, `dilatancy_of_looseness`, and `settling` (0 in files without it).
    pub law: super::law::Law,
    /// Coefficients of the overlaps and of the fabric.
    pub readout: super::readout::Readout,
    /// Coefficients of the conductivity, one entry for each kind; the first answers unless the case says otherwise.
    pub conductivities: Vec<Conductivity>,
    /// Mean stress of packed states as a function of porosity and fabric, for what a case does not give.
    pub mean_stress: MeanStress,
    /// The states along the paths of the training: a cover of their convex hull.
    pub region: Region,
    /// Relative standard deviation of the conductivity between packings of equal state, and of the growth of the pressure
    /// with the thermal strain.
    pub spread: Spread,
    /// Sum of the areas of grains over area, for a porosity that counts overlaps once.
    pub solid_fraction: SolidFraction,
    /// Friction at walls; `null` if the database had no `wall_shear`.
    pub wall_friction: Option<WallFriction>,
    /// `library_version`, options of the training with the hash of the database's plan and rows, and its report.
    pub provenance: Provenance,
}

/// Ranges of the states and strains of the training.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ranges {
    pub porosity: Range,
    /// Of both components, symmetric.
    pub fabric: Range,
    pub jamming_fraction: Range,
    pub elastic_compression: Range,
    /// Of an element's shear strain, both components, symmetric.
    pub elastic_shear: Range,
    pub strength: Range,
    /// Of the packed radii, to the ends of all ramps.
    pub thermal_strain: Range,
    /// p̃.
    pub pressure: Range,
}

/// How the model was made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// Version of the library that trained it.
    pub library_version: String,
    pub training: TrainingOptions,
    pub report: Report,
}

/// Results of a training.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Report {
    /// Packings that were fitted and held out, and their paths.
    pub packings: [usize; 2],
    pub paths: [usize; 2],
    /// Numbers of the law that were fitted.
    pub parameters: usize,
    pub epochs: u32,
    /// Mean square of the weighted residuals, of large ones less.
    pub mean_square: f64,
}

impl IncrementModel {
    pub(crate) fn of(file: File) -> Self {
        let core = Core {
            law: file.law.clone(),
            readout: file.readout.clone(),
            conductivity: file.conductivities[0].clone(),
            ranges: file.ranges.columns(),
        };
        let hash = hash(&(json(&file) + "\n"));
        Self { core, file, hash }
    }

    /// The state of a cell with this porosity, fabric and stress (p̃, q̃₁, q̃₂).
    fn state(&self, porosity: f64, fabric: [f64; 2], [p, q1, q2]: [f64; 3]) -> [f64; MAX_STATE] {
        let found = start(&self.core.law, &self.core.readout, porosity, p, [q1, q2]);
        let mut state = [0.0; MAX_STATE];
        state[POROSITY] = porosity;
        [state[FABRIC_INDEX], state[FABRIC_SHEAR]] = fabric;
        state[JAMMING] = found.jamming;
        state[COMPRESSION] = found.compression;
        state[SHEAR..STRENGTH].copy_from_slice(found.shear.as_flattened());
        state[STRENGTH] = found.strength;
        state
    }
}

impl Ranges {
    /// For each state column, and for the thermal strain.
    fn columns(&self) -> [Range; COLUMNS + 1] {
        let Self { porosity, fabric, jamming_fraction, elastic_compression, elastic_shear: shear, .. } =
            *self;
        let strength = self.strength;
        let (own, wide) = (OWN, Range { min: -1.0, max: 1.0 });
        [
            porosity,
            fabric,
            fabric,
            jamming_fraction,
            elastic_compression,
            shear,
            shear,
            shear,
            shear,
            strength,
            own,
            wide,
            wide,
            self.thermal_strain,
        ]
    }

    /// Porosity, length of the fabric, √p̃ and length of q̃/p̃, about from −1 to 1: they do not depend on the axes.
    pub(crate) fn coordinates(&self, state: &[f64; MAX_STATE], features: &Features<f64>) -> Coordinates {
        let mut point = [0.0; MAX_COORDINATES];
        let Range { min, max } = self.porosity;
        point[0] = (2.0 * state[POROSITY] - min - max) / (max - min).max(f64::MIN_POSITIVE);
        point[1] = 2.0 * state[FABRIC_INDEX].hypot(state[FABRIC_SHEAR]) / self.fabric.max - 1.0;
        point[2] = 2.0 * features.root / self.pressure.max.sqrt() - 1.0;
        point[3] = 2.0 * features.square.sqrt() / LARGEST_RATIO - 1.0;
        point
    }

    fn check(&self) -> Result<(), SurrogateError> {
        let all = [
            ("porosity", self.porosity, 0.0, 1.0),
            ("fabric", self.fabric, -1.0, 1.0),
            ("jamming_fraction", self.jamming_fraction, 0.3, 1.3),
            ("elastic_compression", self.elastic_compression, -0.9, 1.0),
            ("elastic_shear", self.elastic_shear, -1.0, 1.0),
            ("strength", self.strength, 0.01, 3.0),
            ("thermal_strain", self.thermal_strain, -0.5, 0.5),
            ("pressure", self.pressure, 0.0, 1e3),
        ];
        match all.iter().find(|(_, Range { min, max }, low, high)| !(low <= min && min < max && max <= high))
        {
            Some((key, Range { min, max }, low, high)) => {
                let found = format!("{min} to {max}, within {low} to {high}");
                field(&format!("ranges.{key}"), found, "min < max, within what grains can have")
            }
            None => Ok(()),
        }
    }
}

/// Range of a packing's own mean conductivity over that of the model, less 1, beyond which something is wrong.
const OWN: Range = Range { min: -0.2, max: 0.2 };
/// Number of coordinates of [`Ranges::coordinates`].
pub(crate) const COORDINATES: usize = 4;
/// About the largest q̃/p̃ of a packing.
const LARGEST_RATIO: f64 = 0.4;

/// Features of a state, one cell.
pub(crate) fn features(core: &Core, state: &[f64; MAX_STATE]) -> Features<f64> {
    let (block, mut answer) = (state.map(|value| [value; LANES]), Answer::default());
    core.advance(&block, &Increment::default(), &mut answer, None);
    let [xx, yy, xy] = answer.stress.map(|column| column[0]);
    let stress = [0.5 * (xx + yy), 0.5 * (xx - yy), xy].map(Portable::all);
    Features::of(&stress, Portable::all(1.0 - state[JAMMING])).first()
}

/// Reads the text of a model file.
///
/// # Errors
/// [`SurrogateError::Damaged`], [`SurrogateError::Schema`] or [`SurrogateError::Field`].
pub fn read(text: &str) -> Result<IncrementModel, SurrogateError> {
    let found = schema(text)?;
    if found != SCHEMA {
        return Err(SurrogateError::Schema { found, expected: SCHEMA });
    }
    let file: File =
        serde_json::from_str(text).map_err(|error| SurrogateError::Damaged(error.to_string()))?;
    file.check()?;
    Ok(IncrementModel { hash: hash(text), ..IncrementModel::of(file) })
}

impl File {
    fn check(&self) -> Result<(), SurrogateError> {
        self.ranges.check()?;
        self.law.check()?;
        self.readout.check()?;
        if self.conductivities.is_empty() {
            return field("conductivities (count)", 0, "1 or more");
        }
        self.conductivities.iter().try_for_each(Conductivity::check)?;
        self.mean_stress.check()?;
        let Region { dimensions, support, states, spacing } = &self.region;
        let sound = *dimensions == COORDINATES
            && support.len() == Region::support_count(COORDINATES)
            && !states.is_empty()
            && *spacing > 0.0;
        if !sound {
            return field("region", format!("{dimensions} dimensions"), "4 dimensions, with states");
        }
        let Spread { pressure, conductivity, pressure_rate } = &self.spread;
        if conductivity.len() != Spread::BINS || pressure_rate.len() != Spread::BINS {
            return field("spread (bins)", conductivity.len(), "6");
        }
        if !(0.0 <= pressure.min && pressure.min <= pressure.max && pressure.max <= 1e3) {
            return field("spread.pressure", format!("{} to {}", pressure.min, pressure.max), "0 to 1e3");
        }
        let unsound = |value: &&f64| !(0.0..=WEIGHT_LIMIT).contains(*value);
        if let Some(value) = conductivity.iter().chain(pressure_rate).find(unsound) {
            return field("spread", value, "0 to 1e9");
        }
        self.solid_fraction.check()?;
        self.wall_friction.as_ref().map_or(Ok(()), WallFriction::check)
    }
}

impl Surrogate for IncrementModel {
    fn kind(&self) -> &'static str {
        "increment"
    }

    fn name(&self) -> &str {
        &self.file.name
    }

    fn hash(&self) -> &str {
        &self.hash
    }

    fn training(&self) -> &TrainingOptions {
        &self.file.provenance.training
    }

    fn conductivity_kind(&self) -> ConductivityKind {
        self.core.conductivity.kind
    }

    fn conductivity_kinds(&self) -> Vec<ConductivityKind> {
        self.file.conductivities.iter().map(|conductivity| conductivity.kind).collect()
    }

    fn answering_with(&self, kind: ConductivityKind) -> Option<Box<dyn Surrogate>> {
        let conductivity = self.file.conductivities.iter().find(|conductivity| conductivity.kind == kind)?;
        let mut model = self.clone();
        model.core.conductivity = conductivity.clone();
        Some(Box::new(model))
    }

    fn has_tangent(&self) -> bool {
        true
    }

    fn path_errors(&self, tracks: &[Track]) -> Vec<PathErrors> {
        path_errors(&self.core, tracks)
    }

    fn probe_errors(&self, tracks: &[Track]) -> Vec<ProbeErrors> {
        probe_errors(&self.core, tracks)
    }

    fn wall_friction(&self) -> Option<&WallFriction> {
        self.file.wall_friction.as_ref()
    }

    fn to_json(&self) -> String {
        json(&self.file) + "\n"
    }

    fn state_names(&self) -> &[&'static str] {
        &NAMES
    }

    fn initial_state(&self, known: &InitialData) -> [f64; MAX_STATE] {
        let fabric = [known.fabric_index, 2.0 * known.fabric_xy];
        let stress = known.reduced_stress.map_or_else(
            || self.file.mean_stress.at(known.porosity, fabric),
            |[xx, yy, xy]| [0.5 * (xx + yy), 0.5 * (xx - yy), xy],
        );
        let mut state = self.state(known.porosity, fabric, stress);
        if let Some(conductivity) = known.conductivity {
            self.core.give(&mut state, conductivity);
        }
        state
    }

    fn advance(
        &self,
        state: &StateLanes,
        strain: &Increment,
        answer: &mut Answer,
        tangent: Option<&mut Tangent>,
    ) {
        self.core.advance(state, strain, answer, tangent);
    }

    fn uncertainty(&self, state: &[f64; MAX_STATE]) -> Option<Uncertainty> {
        let features = features(&self.core, state);
        let point = self.file.ranges.coordinates(state, &features);
        let [conductivity_spread, pressure_rate_spread] = self.file.spread.at(features.pressure);
        Some(Uncertainty {
            beyond_hull: self.file.region.beyond_hull(&point),
            distance: self.file.region.distance(&point),
            conductivity_spread,
            pressure_rate_spread,
        })
    }

    fn solid_fraction(&self, porosity: f64) -> f64 {
        self.file.solid_fraction.at(porosity)
    }

    fn packed_porosities(&self) -> [f64; 2] {
        let range = self.file.solid_fraction.porosity;
        [range.min, range.max]
    }
}

#[cfg(test)]
#[path = "model_tests.rs"]
mod tests;
