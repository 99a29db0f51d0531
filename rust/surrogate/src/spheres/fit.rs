//! Fit of the law to paths of strain: least squares of the stress along them, and of the fabric.

use super::contacts::Contacts;
use super::law::Law;
use super::parameters::Free;
use super::state::FABRIC;
use super::tensor::{Tensor, contraction, deviator, mean, sum};
use super::tracks::{Track, follow};
use crate::levenberg_marquardt::{Limits, Minimum, minimise};
use crate::path_fit::Paths;
use nalgebra::DVector;
use std::ops::ControlFlow;

/// Largest residuals of pressure, and of deviator and fabric.
const MOST: [f64; 2] = [5.0, 3.0];
/// Number of spheres of a packing whose errors have the weight 1; that of others goes with the root of their number.
const DEFAULT_SPHERES: f64 = 1000.0;

/// Residuals of paths that turn more often than this count by this factor: there are few of them, and a law that is a little off in
/// each cycle is far off after ten.
const TURNS: usize = 7;
const OF_CYCLES: f64 = 1.7;
/// Factor of the residuals of paths of shear alone, and of compression alone: by these the law has an error of nearly one and a half times what
/// packings that were made equally differ.
const OF_ONE_KIND: f64 = 2.5;

/// A stress counts over the largest of these: the pressure, that of the packing, a share of the largest on the path so far, and
/// the pressure that a share of the largest strain so far would build up. So an error of strain that is small compared with the strain counts
/// little where a packing is about to lose its load and a small strain changes its pressure by decades.
const SHARE_OF_LARGEST: f64 = 0.1;
const SHARE_OF_STRAIN: f64 = 0.2;
/// p/E* over v^(3/2) of usual packings.
const REFERENCE_BULK: f64 = 0.075;

/// Over what the stress of each state after a step counts.
pub fn scales(track: &Track) -> Vec<f64> {
    let packed = mean(track.packed.stress);
    let (mut largest, mut farthest) = (packed, 0.0f64);
    // Of each state, since the packing.
    let mut strains = vec![[0.0; 6]];
    let each = track.steps.iter().map(|step| {
        // A packing whose load is held along an axis does not lose it.
        let strain = match step.free_axis {
            None => sum(&strains[step.from], &step.strain()),
            Some(_) => strains[step.from],
        };
        strains.push(strain);
        let distortion = deviator(strain);
        farthest = farthest.max(contraction(&distortion, &distortion).sqrt() + 3.0 * mean(strain).abs());
        let pressure = mean(step.to.stress);
        largest = largest.max(pressure);
        let built_up = REFERENCE_BULK * libm::pow(SHARE_OF_STRAIN * farthest, 1.5);
        pressure.max(packed).max(SHARE_OF_LARGEST * largest).max(built_up)
    });
    each.collect()
}

/// Weight of the errors of the fabric relative to those of the stress. They hold the fourth element to the fabric that was counted; else it
/// would take any value that fits the stress.
const OF_FABRIC: f64 = 0.3;
/// Usual stress ratio over the deviator of the fabric: it turns errors of the fabric into errors of a stress ratio.
const REFERENCE_RATIO: f64 = 5.0;
/// Least such number by which is divided.
const MIN_RATIO: f64 = 0.1;
/// Least p/E* of states whose fabric counts.
const MIN_PRESSURE: f64 = 3e-9;

/// Residuals of the stress and the fabric along tracks.
pub struct PathFit<'a> {
    pub tracks: &'a [Track],
    pub threads: usize,
    /// How the number of contacts changes, by which the fabric turns.
    pub contacts: Contacts,
    /// The parameters that are fitted.
    pub free: Free,
}

impl Paths for PathFit<'_> {
    /// Some packings rearrange suddenly.
    const ROBUST: f64 = 0.2;

    fn threads(&self) -> usize {
        self.threads
    }

    fn residuals(&self, x: &DVector<f64>) -> Vec<f64> {
        let law = Law { contacts: self.contacts, ..self.free.law(x) };
        let both = |k: usize| if k < 3 { 1.0 } else { std::f64::consts::SQRT_2 };
        let mut residuals = Vec::new();
        for track in self.tracks {
            let of_cycles = if track.turns() > TURNS { OF_CYCLES } else { 1.0 };
            let of_kind = match track.name.as_str() {
                "shear" | "thermal" | "isotropic" => OF_ONE_KIND,
                _ => 1.0,
            };
            let weight = of_cycles * of_kind * track.weight * (track.spheres as f64 / DEFAULT_SPHERES).sqrt();
            let states = follow(&law, track);
            for ((step, state), scale) in track.steps.iter().zip(&states[1..]).zip(scales(track)) {
                let (found, data) = (law.stress(state), step.to.stress);
                // Of a compression, in which the pressure goes with the power 3/2, so that the error of a packing that has lost
                // its load still tells by how much.
                let power = |stress: Tensor| libm::pow(mean(stress).max(0.0) / scale, 2.0 / 3.0);
                let error = 1.5 * weight * (power(found) - power(data));
                residuals.push(error.clamp(-MOST[0], MOST[0]));
                let (found, data) = (deviator(found), deviator(data));
                residuals.extend(
                    (0..6)
                        .map(|k| (both(k) * weight * (found[k] - data[k]) / scale).clamp(-MOST[1], MOST[1])),
                );
                let carries = mean(step.to.stress) > MIN_PRESSURE;
                let weight = if carries { OF_FABRIC * REFERENCE_RATIO * weight } else { 0.0 };
                let (fabric, known) = (state.ratios[FABRIC], deviator(step.to.fabric));
                let per_anisotropy = law.fabric[0].max(MIN_RATIO);
                residuals.extend((0..6).map(|k| {
                    (both(k) * weight * (fabric[k] / per_anisotropy - known[k])).clamp(-MOST[1], MOST[1])
                }));
            }
        }
        residuals
    }
}

/// Fits the law, from [`super::parameters::beginning`].
pub fn fit(problem: &PathFit, epochs: u32) -> (Law, Minimum) {
    let limits = Limits { max_epochs: epochs, gradient: 1e-10 };
    let minimum = minimise(problem, problem.free.start(), limits, |_, _, _| ControlFlow::Continue(()));
    (Law { contacts: problem.contacts, ..problem.free.law(&minimum.parameters) }, minimum)
}
