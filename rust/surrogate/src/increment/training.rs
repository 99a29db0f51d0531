//! Training: the law is fitted to the stress along paths, then everything else to the states that it follows.

use super::core::{COMPRESSION, Core, FABRIC_INDEX, FABRIC_SHEAR, JAMMING, SHEAR, STRENGTH};
use super::fit::{PathFit, fit, parameters, readouts};
use super::mean::MeanStress;
use super::model::{COORDINATES, File, IncrementModel, Provenance, Ranges, Report, SCHEMA, features};
use super::paths::{States, conductivities, follow, stresses};
use crate::SurrogateError;
use crate::dataset::ConductivityKind;
use crate::options::TrainingOptions;
use crate::region::{Coordinates, Region, Spread};
use crate::scaling::Range;
use crate::solid_fraction::SolidFraction;
use crate::surrogate::MAX_STATE;
use crate::tracks::{Point, Track};
use crate::training_data::TrainingData;
use crate::wall_friction::WallFriction;
use std::collections::BTreeSet;

/// Usual number of epochs, after which the fit is at its minimum for all practical purposes.
pub const DEFAULT_EPOCHS: u32 = 60;

/// Trains on paths of periodic boxes; wall friction is fitted when the data for it is there.
///
/// # Errors
/// [`SurrogateError::Data`] for unusable data, [`SurrogateError::Option`] for unusable options.
pub fn train(data: &TrainingData, options: &TrainingOptions) -> Result<IncrementModel, SurrogateError> {
    options.check()?;
    let held_out = data.split(options.seed)?.test;
    let (unseen, seen): (Vec<Track>, Vec<Track>) =
        data.tracks.iter().cloned().partition(|track| held_out.contains(&track.packing));
    if seen.iter().map(|track| track.steps.len()).sum::<usize>() < MIN_STEPS {
        let text = "fewer than 100 states of periodic boxes, to which this kind of model is fitted";
        return Err(SurrogateError::Data(text.to_string()));
    }
    let problem = PathFit { tracks: &seen, threads: options.threads_used() };
    let (law, minimum) = fit(&problem, options.max_epochs, |_, _| ());
    let states = follow(&Core::of(law.clone()), &seen);
    let kinds = kinds(&seen);
    let (readout, conductivities) = readouts(&seen, &states, &kinds);
    let packed: Vec<Point> = seen.iter().map(|track| track.packed).collect();
    let core = Core { readout, conductivity: conductivities[0].clone(), ..Core::of(law) };
    let ranges = ranges(&seen, &states);
    let judged: &[Track] = if unseen.len() < MIN_TRACKS { &seen } else { &unseen };
    let report = Report {
        packings: [packings(&seen), packings(&unseen)],
        paths: [seen.len(), unseen.len()],
        parameters: parameters(&core.law).len(),
        epochs: minimum.epochs,
        mean_square: minimum.mean_square,
    };
    let model = IncrementModel::of(File {
        schema: SCHEMA.to_string(),
        name: options.name.clone(),
        ranges,
        region: region(&core, &ranges, &states),
        spread: spread(&core, &ranges, judged),
        mean_stress: MeanStress::fit(&packed),
        solid_fraction: SolidFraction::of(
            packed.iter().filter(|point| point.load_bearing).map(|point| (point.porosity, point.solid)),
        )?,
        wall_friction: WallFriction::fit(&data.wall_slips),
        law: core.law,
        readout: core.readout,
        conductivities,
        provenance: Provenance {
            library_version: env!("CARGO_PKG_VERSION").to_string(),
            training: TrainingOptions { threads: 0, ..options.clone() },
            report,
        },
    });
    // Whatever the data were, a model that is written can be read.
    super::model::read(&model_text(&model))
}

fn model_text(model: &IncrementModel) -> String {
    crate::Surrogate::to_json(model)
}

/// Least number of states to which the law is fitted, and of paths by which its spread is judged.
const MIN_STEPS: usize = 100;
const MIN_TRACKS: usize = 20;

fn packings(tracks: &[Track]) -> usize {
    tracks.iter().map(|track| track.packing).collect::<BTreeSet<_>>().len()
}

/// Kinds of conductivity that all states have, the default one first.
fn kinds(tracks: &[Track]) -> Vec<ConductivityKind> {
    let network = |point: &Point| point.network.is_some();
    let all =
        tracks.iter().all(|track| network(&track.packed) && track.steps.iter().all(|step| network(&step.to)));
    if all {
        vec![ConductivityKind::Network, ConductivityKind::Affine]
    } else {
        vec![ConductivityKind::Affine]
    }
}

fn ranges(tracks: &[Track], states: &[States]) -> Ranges {
    let all = || states.iter().flatten();
    let of = |column: usize| Range::of(all().map(|state| state[column]));
    let symmetric = |columns: &[usize]| {
        let values = all().flat_map(|state| columns.iter().map(|k| state[*k].abs()));
        // Shear strains and fabrics beyond 1 are taken as 1, see `Core`.
        let largest = values.fold(0.0, f64::max).min(1.0);
        Range { min: -largest, max: largest }
    };
    let (mut strain, mut pressure) = (Range { min: 0.0, max: 0.0 }, Range { min: 0.0, max: 0.0 });
    for track in tracks {
        let mut radius = vec![1.0];
        for (k, step) in track.steps.iter().enumerate() {
            radius.push(radius[step.from] * (1.0 + step.strain[0]));
            strain.min = strain.min.min(radius[k + 1] - 1.0);
            strain.max = strain.max.max(radius[k + 1] - 1.0);
            pressure.max = pressure.max.max(step.to.invariants()[0]);
        }
    }
    let shears: Vec<usize> = (SHEAR..STRENGTH).collect();
    Ranges {
        porosity: Range::of(
            tracks.iter().flat_map(|track| (0..=track.steps.len()).map(|k| track.point(k).porosity)),
        ),
        fabric: symmetric(&[FABRIC_INDEX, FABRIC_SHEAR]),
        jamming_fraction: of(JAMMING),
        elastic_compression: of(COMPRESSION),
        elastic_shear: symmetric(&shears),
        strength: KNOWN_STRENGTH,
        thermal_strain: strain,
        pressure,
    }
}

/// Factors of the strengths that the law takes: they scale the sliding alone, as users may wish.
const KNOWN_STRENGTH: Range = Range { min: 0.01, max: 3.0 };

/// About this many states describe the region.
const REGION_STATES: usize = 20_000;

fn region(core: &Core, ranges: &Ranges, states: &[States]) -> Region {
    let all: Vec<&[f64; MAX_STATE]> = states.iter().flatten().collect();
    let each = all.len().div_ceil(REGION_STATES).max(1);
    let coordinates = |state: &&[f64; MAX_STATE]| ranges.coordinates(state, &features(core, state));
    let points: Vec<Coordinates> = all.iter().step_by(each).map(coordinates).collect();
    Region::of(&points, COORDINATES)
}

/// Scatter of the errors along these paths.
fn spread(core: &Core, ranges: &Ranges, tracks: &[Track]) -> Spread {
    let (mut conductivity, mut rate) = (Vec::new(), Vec::new());
    for (track, states) in tracks.iter().zip(follow(core, tracks)) {
        let (found, means) = (stresses(core, &states), conductivities(core, &states));
        for (k, step) in
            track.steps.iter().enumerate().filter(|(_, step)| step.to.load_bearing && !step.probe)
        {
            let (before, after) = (track.point(step.from).invariants()[0], step.to.invariants()[0]);
            if step.strain[0].abs() > MIN_STRAIN {
                let error = (found[k + 1][0] - found[step.from][0]) - (after - before);
                rate.push((before, error / step.strain[0]));
            }
            if let Some([xx, yy, _]) = step.to.conductivity(core.conductivity.kind) {
                let [x, y, _] = means[k + 1];
                conductivity.push((after, (x + y) / (xx + yy) - 1.0));
            }
        }
    }
    Spread::of(ranges.pressure, &conductivity, &rate)
}

/// Smallest thermal strain of a step from which a rate is taken.
const MIN_STRAIN: f64 = 1e-4;
