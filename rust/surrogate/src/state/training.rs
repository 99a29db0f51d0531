//! Training of the state model.

use super::composed_fit::RatesFit;
use super::core::Core;
use super::fit::{PerceptronFit, Sample};
use super::mean::MeanState;
use super::model::StateModel;
use super::pairs::{self, Pair};
use super::provenance::{FitReport, Provenance, StateReport};
use super::rates::Rates;
use super::readout::Readout;
use super::variables::{FeatureRanges, PRESSURE, Point};
use crate::SurrogateError;
use crate::composition::{self, Composed};
use crate::dataset::{self, ConductivityKind, Ramp, Split, StateRow};
use crate::document::hash;
use crate::kernel::LANES;
use crate::levenberg_marquardt::{LeastSquares, Limits, minimise};
use crate::mechanics::{Mechanics, WallStrain};
use crate::perceptron::Perceptron;
use crate::region::{Region, Spread};
use crate::report::Parts;
use crate::scaling::Range;
use crate::solid_fraction::SolidFraction;
use crate::wall_friction::{WallFriction, WallSlip};
use nalgebra::DVector;
use std::ops::ControlFlow;

pub use super::provenance::StateOptions;

/// Training data besides the thermal ramps.
#[derive(Clone, Debug, Default)]
pub struct Mechanical {
    pub wall_strains: Vec<WallStrain>,
    pub wall_slips: Vec<WallSlip>,
}

/// Trains a state model on thermal ramps. Its mechanical tangent and wall friction are fitted when the data for them is
/// there.
///
/// # Errors
/// [`SurrogateError::Data`] for unusable rows, [`SurrogateError::Option`] for unusable options.
pub fn train(
    rows: &[StateRow],
    mechanical: &Mechanical,
    options: &StateOptions,
) -> Result<StateModel, SurrogateError> {
    train_blind(rows, mechanical, options, None)
}

/// As [`train`]. With `Some(blind)` the model is fitted to single steps alone, for comparisons, and its networks do not
/// get that even input.
pub(crate) fn train_blind(
    rows: &[StateRow],
    mechanical: &Mechanical,
    options: &StateOptions,
    single: Option<Option<usize>>,
) -> Result<StateModel, SurrogateError> {
    options.check()?;
    let blind = single.flatten();
    let kinds = kinds(rows);
    let split = dataset::split(dataset::ramps(rows)?, options.common.seed)?;
    let parts = Parts::of(&split, |ramps| pairs::pairs(options.variables, kinds[0], ramps));
    let points = |ramps: &[Ramp], kind| pairs::points(options.variables, kind, ramps);
    let training_points = points(&split.training, kinds[0]);
    let ranges = FeatureRanges::of(&training_points, strains(&parts.training)?);
    ranges.check()?;

    let scaled = |rates: &Rates, pairs: &[Pair]| {
        without(blind, pairs::rate_samples(options.variables, &ranges, rates, pairs))
    };
    let blank = pairs::blank_rates(options.variables, &options.hidden, &parts.training, &split.training);
    let fit = |ramps: &[Ramp], pairs: &[Pair], threads| RatesFit {
        single: PerceptronFit::new(blank.network.sizes.clone(), &scaled(&blank, pairs), threads),
        tracks: if single.is_some() { Vec::new() } else { pairs::tracks(options.variables, kinds[0], ramps) },
        variables: options.variables,
        ranges: &ranges,
        rates: &blank,
    };
    let validation = fit(&split.validation, &parts.validation, 1);
    let threads = options.fit_threads();
    let training = fit(&split.training, &parts.training, threads);
    let (mut network, rates_report) =
        best_of_starts(&training, &validation, &blank.network.sizes, options, 0);
    drop((training, validation));
    blind.inspect(|input| network.forget(*input));
    let rates = Rates { network, ..blank };

    let (mut readouts, mut readout_reports) = (Vec::new(), Vec::new());
    for (index, kind) in kinds.iter().enumerate() {
        let carried = index == 0 && options.variables.fabric_conductivity;
        let sizes = Readout::sizes(options.variables, carried, &options.readout_hidden);
        let samples = |ramps: &[Ramp]| {
            let samples = pairs::readout_samples(options.variables, carried, &ranges, &points(ramps, *kind));
            without(blind, samples)
        };
        let fit = |ramps, threads| PerceptronFit::new(sizes.clone(), &samples(ramps), threads);
        let (training, validation) = (fit(&split.training, options.fit_threads()), fit(&split.validation, 1));
        let stream = 100 * (index as u64 + 1);
        let (mut network, report) = best_of_starts(&training, &validation, &sizes, options, stream);
        blind.filter(|input| *input < sizes[0]).inspect(|input| network.forget(*input));
        let (offset, scale) = pairs::READOUT_SCALES;
        readouts.push(Readout { kind: *kind, network, offset, scale, carried });
        readout_reports.push(report);
    }
    let core = Core { variables: options.variables, ranges, rates, readouts, active: 0 };
    let packed: Vec<Point> = pairs::packed_points(options.variables, kinds[0], &split.training);
    let mut report = StateReport {
        packings: Parts::of(&split, dataset::packings),
        samples: parts.map(Vec::len),
        rates: rates_report,
        readouts: readout_reports,
        composed: Vec::new(),
    };
    let mut model = StateModel {
        mean: MeanState::fit(&packed),
        region: region(&core, &training_points),
        spread: spread(&core, &split, kinds[0]),
        solid_fraction: SolidFraction::fit(rows)?,
        mechanics: Mechanics::fit(&mechanical.wall_strains),
        wall_friction: WallFriction::fit(&mechanical.wall_slips),
        name: options.common.name.clone(),
        provenance: Provenance {
            library_version: env!("CARGO_PKG_VERSION").to_string(),
            training: options.clone(),
            report: report.clone(),
        },
        hash: String::new(),
        core,
    };
    model.provenance.training.common.threads = 0;
    report.composed = held_out(&model, &split.test);
    model.provenance.report = report;
    model.hash = hash(&model.text());
    Ok(model)
}

/// The samples with one scaled input set to 0, the middle of its range.
fn without(blind: Option<usize>, mut samples: Vec<Sample>) -> Vec<Sample> {
    for input in samples.iter_mut().filter_map(|sample| sample.inputs.get_mut(blind?)) {
        *input = 0.0;
    }
    samples
}

/// Kinds of conductivity that all rows contain, the default one first.
pub fn kinds(rows: &[StateRow]) -> Vec<ConductivityKind> {
    match rows.iter().all(|row| row.conductivity_network.is_some()) {
        true => vec![ConductivityKind::Network, ConductivityKind::Affine],
        false => vec![ConductivityKind::Affine],
    }
}

fn strains(pairs: &[Pair]) -> Result<Range, SurrogateError> {
    let range = Range::of(pairs.iter().map(|pair| pair.strain));
    if range.width() > 0.0 && range.width().is_finite() {
        Ok(range)
    } else {
        Err(SurrogateError::Data("no two stops of a ramp differ in strain".to_string()))
    }
}

fn region(core: &Core, points: &[Point]) -> Region {
    let coordinates = points.iter().filter(|p| p.jammed).flat_map(|p| {
        let mut turned = p.state;
        core.variables.odd().for_each(|column| turned[column] = -turned[column]);
        [p.state, turned].map(|state| core.ranges.coordinates(core.variables, &state))
    });
    Region::of(&coordinates.collect::<Vec<_>>(), core.variables.names().len())
}

/// Scatter of the errors on packings that the fit did not see: validation and test packings together, as each alone
/// would be too few.
fn spread(core: &Core, split: &Split, kind: ConductivityKind) -> Spread {
    let unseen: Vec<Ramp> = split.validation.iter().chain(&split.test).cloned().collect();
    let (mut conductivity, mut rate) = (Vec::new(), Vec::new());
    for pair in pairs::pairs(core.variables, kind, &unseen).iter().filter(|pair| pair.jammed()) {
        let lanes = pair.from.state.map(|value| [value; LANES]);
        let answer = core.block(&lanes, &[pair.strain; LANES]);
        let (start, end) = (pair.from.state[PRESSURE], pair.to.state[PRESSURE]);
        rate.push((start, (answer.state[PRESSURE][0] - end) / pair.strain));
    }
    for point in pairs::points(core.variables, kind, &unseen).iter().filter(|p| p.jammed) {
        let answer = core.block(&point.state.map(|v| [v; LANES]), &[0.0; LANES]);
        let mean = 0.5 * (answer.conductivity[0][0] + answer.conductivity[1][0]);
        conductivity.push((point.state[PRESSURE], mean / point.conductivity - 1.0));
    }
    Spread::of(core.ranges.pressure, &conductivity, &rate)
}

/// Strains and numbers of increments of the errors in the training report.
const JUDGED: [(f64, u32); 6] =
    [(0.02, 1), (0.02, 500), (-0.02, 500), (0.05, 500), (-0.05, 500), (-0.05, 5000)];

fn held_out(model: &StateModel, ramps: &[Ramp]) -> Vec<Composed> {
    let judged = JUDGED.map(|(strain, increments)| {
        let paths = composition::paths(ramps, strain);
        composition::errors(model, &paths, strain, increments)
    });
    judged.into_iter().filter(|composed| composed.ramps > 0).collect()
}

/// Limit for the largest component of the mean gradient. Errors are of order 1e-3, so below it the fit is at a minimum
/// for all practical purposes.
const GRADIENT_LIMIT: f64 = 1e-10;

/// Fits a network from several starts and keeps the one with the lowest validation error. The starts run in parallel;
/// which one is kept does not depend on the number of threads.
fn best_of_starts<P: LeastSquares + Sync>(
    training: &P,
    validation: &P,
    sizes: &[usize],
    options: &StateOptions,
    stream: u64,
) -> (Perceptron, FitReport) {
    let starts = options.common.restarts as usize;
    let side_by_side = options.common.threads_used().min(starts);
    let one = |restart: usize| {
        let stream = stream + restart as u64 + 1;
        let start = Perceptron::initial(sizes, options.common.seed, stream);
        fit_from(training, validation, start, restart as u32, options)
    };
    let mut all: Vec<(Perceptron, FitReport)> = std::thread::scope(|scope| {
        let one = &one;
        let worker = |first: usize| {
            scope.spawn(move || (first..starts).step_by(side_by_side).map(one).collect::<Vec<_>>())
        };
        let workers: Vec<_> = (0..side_by_side).map(worker).collect();
        let results = workers.into_iter().map(|worker| worker.join());
        results.flat_map(|done| done.unwrap_or_else(|panic| std::panic::resume_unwind(panic))).collect()
    });
    all.sort_by(|(_, a), (_, b)| {
        a.validation_error.total_cmp(&b.validation_error).then(a.restart.cmp(&b.restart))
    });
    all.swap_remove(0)
}

/// Minimises the training error, and keeps the weights with the lowest validation error.
fn fit_from<P: LeastSquares>(
    training: &P,
    validation: &P,
    start: Perceptron,
    restart: u32,
    options: &StateOptions,
) -> (Perceptron, FitReport) {
    let (sizes, start) = (start.sizes, DVector::from_vec(start.weights));
    let mut best = (0, start.clone(), training.mean_square(&start), validation.mean_square(&start));
    let limits = Limits { max_epochs: options.common.max_epochs, gradient: GRADIENT_LIMIT };
    let minimum = minimise(training, start, limits, |epoch, weights, training_error| {
        let validation_error = validation.mean_square(weights);
        if validation_error < best.3 {
            best = (epoch, weights.clone(), training_error, validation_error);
        }
        let patient = epoch - best.0 < options.common.patience;
        if patient { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    let (best_epoch, weights, training_error, validation_error) = best;
    let report = FitReport {
        weights: weights.len(),
        restart,
        epochs: minimum.epochs,
        best_epoch,
        stopping: minimum.stopping,
        training_error,
        validation_error,
    };
    (Perceptron { sizes, weights: weights.as_slice().to_vec() }, report)
}
