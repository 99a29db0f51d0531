//! Fit of the law to paths of strain: least squares of the stress along them.

use super::core::{COMPRESSION, Core, JAMMING, SHEAR, STRENGTH};
use super::law::{ELEMENTS, Elastic, Element, Law, least_third_bulk};
use super::paths::{States, follow, stresses};
use super::readout::{Conductivity, Features, Readout, conductivity_row, direction_rows, fabric_rows};
use crate::dataset::ConductivityKind;
use crate::kernel::vector::{Arithmetic, Portable};
use crate::least_squares;
use crate::levenberg_marquardt::{Limits, Minimum, minimise};
use crate::path_fit::Paths;
use crate::surrogate::MAX_STATE;
use crate::tracks::{Point, Track};
use nalgebra::DVector;
use std::ops::ControlFlow;

/// Elastic compression at which contacts have mostly formed; too small for the data to determine.
const ONSET: f64 = 1e-3;
/// Added to the pressure of a state, over which its errors are taken: a fifth of that of the loosest packings, so that states
/// that hardly carry load do not dominate.
const PRESSURE_SCALE: f64 = 0.003;
/// Weight of the differences of probes over their strain.
pub(super) const PROBE_WEIGHT: f64 = 0.6;
/// Number of grains of a packing whose errors have the weight 1; that of others goes with the root of their number.
pub(super) const DEFAULT_DISCS: f64 = 500.0;
/// Largest residual.
pub(super) const MOST: f64 = 1.0;
/// Usual size of the coefficients of z, by which they are divided so that all parameters are of about equal size: z varies by
/// a tenth of this number's inverse.
const SIZE: f64 = 10.0;

/// The law's numbers as parameters without bounds.
pub fn parameters(law: &Law) -> DVector<f64> {
    let [k0, k1, k2] = law.bulk;
    let [g0, a, g1] = law.shear;
    let [first, second] = law.elements;
    DVector::from_vec(vec![
        k0.ln(),
        law.looseness[0] / SIZE,
        k1,
        k2,
        g0.ln(),
        a.ln(),
        g1.ln(),
        (first.share / second.share).ln(),
        first.strength.ln(),
        second.strength.ln(),
        first.dilatancy,
        second.dilatancy,
        law.dilatancy_of_looseness / SIZE,
        law.looseness[1] / (SIZE * SIZE),
        law.looseness[2] / SIZE,
        SIZE * law.opening_densification,
    ])
}

/// The law of these parameters, with the nearest numbers that [`Law::check`] allows.
pub fn law(x: &DVector<f64>) -> Law {
    let positive = |k: usize, least: f64, most: f64| x[k].exp().clamp(least, most);
    let share = (1.0 / (1.0 + (-x[7]).exp())).clamp(MIN_SHARE, 1.0 - MIN_SHARE);
    let element = |share, k, dilatancy| Element { share, strength: positive(k, 1e-6, 1e3), dilatancy };
    let (first, second) = (positive(0, 1e-6, 1e6), x[2].clamp(-1e6, 1e6));
    Law {
        bulk: [first, second, x[3].min(1e6).max(least_third_bulk(first, second))],
        looseness: [SIZE * x[1], SIZE * SIZE * x[13], SIZE * x[14]].map(|l| l.clamp(-1e4, 1e4)),
        onset: ONSET,
        shear: [positive(4, 0.0, 1e6), positive(5, 1e-9, 1e6), positive(6, 0.0, 1e6)],
        elements: [element(share, 8, x[10]), element(1.0 - share, 9, x[11])],
        dilatancy_of_looseness: SIZE * x[12],
        opening_densification: (x[15] / SIZE).clamp(0.0, 1.0),
    }
}

/// Least part of the shear modulus that an element has.
const MIN_SHARE: f64 = 2e-6;

/// Where the fit begins: values of the grains of the paper, to one digit.
pub fn beginning() -> Law {
    let element = |share, strength, dilatancy| Element { share, strength, dilatancy };
    Law {
        bulk: [0.5, 0.5, 0.0],
        looseness: [-5.0, 0.0, 0.0],
        onset: ONSET,
        shear: [0.4, 0.02, 0.2],
        elements: [element(0.6, 0.05, 0.0), element(0.4, 0.2, 0.0)],
        dilatancy_of_looseness: 5.0,
        opening_densification: 0.05,
    }
}
const _: () = assert!(ELEMENTS == 2);

/// Residuals of the stress along tracks.
pub struct PathFit<'a> {
    pub tracks: &'a [Track],
    pub threads: usize,
}

impl Paths for PathFit<'_> {
    /// Some packings rearrange suddenly.
    const ROBUST: f64 = 0.03;

    fn threads(&self) -> usize {
        self.threads
    }

    fn residuals(&self, x: &DVector<f64>) -> Vec<f64> {
        let core = Core::of(law(x));
        let mut residuals = Vec::new();
        for (track, states) in self.tracks.iter().zip(follow(&core, self.tracks)) {
            add_residuals(track, &stresses(&core, &states), &mut residuals);
        }
        residuals
    }
}

/// One over the pressure by which the error of a state's stress counts. `pressure`: p̃ of the state in the database.
pub(super) fn over(pressure: f64) -> f64 {
    1.0 / (pressure + PRESSURE_SCALE)
}

fn add_residuals(track: &Track, found: &[[f64; 3]], residuals: &mut Vec<f64>) {
    let weight = (track.discs as f64 / DEFAULT_DISCS).sqrt();
    let mut push = |error: f64| residuals.push((weight * error).clamp(-MOST, MOST));
    for (k, step) in track.steps.iter().enumerate() {
        if !step.to.load_bearing {
            continue;
        }
        let (data, law) = (step.to.invariants(), found[k + 1]);
        if step.probe {
            let size = step.strain.iter().fold(0.0f64, |a, b| a.max(b.abs())).max(1e-12);
            let base = track.point(step.from).invariants();
            for c in 0..3 {
                push(PROBE_WEIGHT * ((law[c] - found[step.from][c]) - (data[c] - base[c])) / size);
            }
        } else {
            (0..3).for_each(|c| push((law[c] - data[c]) * over(data[0])));
        }
    }
}

/// Fits the law; `watch` is called with the number of the epoch and the mean square.
pub fn fit(problem: &PathFit, epochs: u32, mut watch: impl FnMut(u32, f64)) -> (Law, Minimum) {
    let limits = Limits { max_epochs: epochs, gradient: 1e-10 };
    let start = parameters(&beginning());
    let minimum = minimise(problem, start, limits, |epoch, _, square| {
        watch(epoch, square);
        ControlFlow::Continue(())
    });
    (law(&minimum.parameters), minimum)
}

/// Least p̃ of states to which the readouts are fitted: below, the packings are losing their contacts one by one.
const MIN_PRESSURE: f64 = 1e-3;

/// A state of the database next to the law's.
struct Seen<'a> {
    point: &'a Point,
    /// Number of the state of its packing in the list.
    start: usize,
    features: Features<f64>,
    /// Fabric minus that of the packing.
    fabric: [Option<f64>; 2],
}

/// Features of the measured stress and the law's looseness.
fn features(point: &Point, loose: f64) -> Features<f64> {
    let stress = point.invariants().map(Portable::all);
    Features::of(&stress, Portable::all(loose)).first()
}

/// Fits overlaps and fabric, and each kind of conductivity, to the states of tracks that the law has followed.
pub fn readouts(
    tracks: &[Track],
    states: &[States],
    kinds: &[ConductivityKind],
) -> (Readout, Vec<Conductivity>) {
    let mut all = Vec::new();
    for (track, states) in tracks.iter().zip(states) {
        let first = all.len();
        let usable = |point: &Point| point.load_bearing && point.invariants()[0] >= MIN_PRESSURE;
        if !usable(&track.packed) {
            continue;
        }
        for (k, state) in states.iter().enumerate() {
            let point = track.point(k);
            if !usable(point) {
                continue;
            }
            all.push(Seen {
                point,
                start: first,
                features: features(point, looseness(state)),
                fabric: [
                    (k > 0).then_some(point.fabric_index - track.packed.fabric_index),
                    point.fabric_shear.zip(track.packed.fabric_shear).filter(|_| k > 0).map(|(a, b)| a - b),
                ],
            });
        }
    }
    let all = all.as_slice();
    let overlap = all.iter().map(|seen| {
        let x = &seen.features;
        let found = seen.point.solid - (1.0 - seen.point.porosity);
        let row = [1.0, x.root, x.pressure, x.root * x.loose, x.root * x.square];
        let weight = 1.0 / (found.max(0.0) + 0.01);
        (row.map(|value| value * x.pressure), found, weight)
    });
    let fabric = all.iter().flat_map(|seen| {
        let rows = |seen: &Seen| fabric_rows(&seen.features.everywhere(), Portable::all(seen.point.porosity));
        let (now, before) = (rows(seen), rows(&all[seen.start]));
        [0, 1].into_iter().filter_map(move |c| {
            let row = std::array::from_fn(|k| (now[c][k] - before[c][k]).into_first());
            Some((row, seen.fabric[c]?, weight(seen, all)))
        })
    });
    let readout = Readout { overlap: least_squares::fit(overlap), fabric: least_squares::fit(fabric) };
    (readout, kinds.iter().map(|kind| conductivity(all, *kind)).collect())
}

/// Number of rounds in which the packings' own conductivities and the coefficients are found in turn.
const ROUNDS: usize = 10;
/// A state of a path counts as much as the logarithm of its pressure over that of its packing, but within these bounds: most
/// of the states are near their packing, and what matters is how far they are right on the way.
const MIN_WEIGHT: f64 = 0.1;
const MAX_WEIGHT: f64 = 1.0;

fn weight(seen: &Seen, all: &[Seen]) -> f64 {
    let pressures = seen.features.pressure / all[seen.start].features.pressure;
    (MIN_WEIGHT + pressures.ln().abs()).min(MAX_WEIGHT)
}

/// Fits the conductivities of the packings, and how they change along the paths: a packing's own conductivity stays.
fn conductivity(all: &[Seen], kind: ConductivityKind) -> Conductivity {
    // Mean conductivity over √p̃, and the terms.
    let terms = |seen: &Seen| -> Option<(f64, [f64; 11])> {
        let [xx, yy, _] = seen.point.conductivity(kind)?;
        let row = conductivity_row(&seen.features.everywhere(), Portable::all(seen.point.porosity));
        Some((0.5 * (xx + yy) / seen.features.root, row.map(Portable::into_first)))
    };
    let known: Vec<Option<(f64, [f64; 11])>> = all.iter().map(terms).collect();
    let of_row = |mean: &[f64; 11], row: &[f64; 11]| mean.iter().zip(row).map(|(c, x)| c * x).sum::<f64>();
    let packing = |k: usize| all[k].start == k;
    let (mut own, mut mean) = (vec![1.0; all.len()], [0.0; 11]);
    for _ in 0..ROUNDS {
        let samples = all.iter().zip(&known).enumerate().filter_map(|(k, (seen, known))| {
            let (found, row) = (*known)?;
            let (own, weight) = if packing(k) { (1.0, 1.0) } else { (own[seen.start], weight(seen, all)) };
            Some((row.map(|value| value * own / found), 1.0, weight))
        });
        mean = least_squares::fit(samples);
        for (k, known) in known.iter().enumerate().filter(|(k, _)| packing(*k)) {
            own[k] = known.as_ref().map_or(1.0, |(found, row)| found / of_row(&mean, row));
        }
    }
    let direction = all.iter().enumerate().flat_map(|(k, seen)| {
        let (now, before) = (directions(seen, kind), directions(&all[seen.start], kind));
        // The packing itself counts as it is, later states by their difference from it.
        let (part, weight) = if packing(k) { (0.0, 1.0) } else { (1.0, weight(seen, all)) };
        [0, 1].into_iter().filter_map(move |c| {
            let (here, row) = now[c]?;
            let (there, first) = before[c]?;
            Some((std::array::from_fn(|n| row[n] - part * first[n]), here - part * there, weight))
        })
    });
    Conductivity { kind, mean, direction: least_squares::fit(direction) }
}

/// For both components of (K_xx − K_yy, 2 K_xy)/(K_xx + K_yy): it, and its terms.
fn directions(seen: &Seen, kind: ConductivityKind) -> [Option<(f64, [f64; 3])>; 2] {
    let [xx, yy, xy] = seen.point.conductivity(kind).unwrap_or([0.0; 3]);
    let mean = 0.5 * (xx + yy);
    let parts = [0.5 * (xx - yy), xy].map(|part| if mean > 0.0 { part / mean } else { 0.0 });
    let fabric = [Some(seen.point.fabric_index), seen.point.fabric_shear];
    let known = fabric.map(|part| Portable::all(part.unwrap_or(0.0)));
    let rows = direction_rows(&seen.features.everywhere(), Portable::all(seen.point.porosity), known);
    [0, 1].map(|c| fabric[c].map(|_| (parts[c], rows[c].map(Portable::into_first))))
}

/// z of a state, see [`super::law`].
pub(super) fn looseness(state: &[f64; MAX_STATE]) -> f64 {
    elastic(state).looseness().into_first()
}

fn elastic(state: &[f64; MAX_STATE]) -> Elastic<Portable> {
    let column = |k: usize| Portable::all(state[k]);
    Elastic {
        jamming: column(JAMMING),
        compression: column(COMPRESSION),
        shear: std::array::from_fn(|k| [column(SHEAR + 2 * k), column(SHEAR + 2 * k + 1)]),
        strength: column(STRENGTH),
    }
}
