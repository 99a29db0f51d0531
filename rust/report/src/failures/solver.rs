//! Where the discretisation of the solver loses accuracy: long time steps, contrasts of conductivity, slanted cells.

use crate::jobs::job::{BOX, Job, PROBES, SolverJob};
use crate::jobs::pool::Records;
use crate::settings::Settings;
use msdd_dem_reference::series::{at, largest};
use msdd_dem_reference::solver::Run;
use serde::Serialize;

/// Error in time of a coupling scheme with fixed steps, for case H on 25 x 8 cells, against a run with adaptive steps and a
/// tolerance of 0.0005 K.
#[derive(Clone, Debug, Serialize)]
pub struct Coupling {
    pub scheme: String,
    /// Time step \[s\].
    pub step: f64,
    /// Largest error of T at the probes from 1 s on \[K\]; `None` when the run ended early.
    pub error: Option<f64>,
    pub outcome: String,
    pub message: String,
}

/// Steady heat flow through two halves of different conductivity.
#[derive(Clone, Debug, Serialize)]
pub struct Contrast {
    /// Larger over smaller conductivity [-].
    pub contrast: f64,
    /// Number of cells along x.
    pub cells: usize,
    /// Error of the heat flow [%]: predicted, by the scheme as a chain of thermal resistances, and measured.
    pub predicted: f64,
    pub measured: Option<f64>,
    pub outcome: String,
}

/// Case H* in a box whose ends are slanted.
#[derive(Clone, Debug, Serialize)]
pub struct Slant {
    /// Angle between the line through the centres of two cells and the normal of their face \[degrees\].
    pub angle: f64,
    pub cells: [usize; 2],
    pub correctors: usize,
    /// Largest error of T at the probes from 0.5 s on, against a run with 200 x 60 cells and five non-orthogonal correctors
    /// [% of the range].
    pub error: Option<f64>,
    pub outcome: String,
    pub message: String,
}

const STEPS: [f64; 9] = [2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005];
const SCHEMES: [&str; 2] = ["paper", "secondOrder"];
/// Contrasts as powers of ten, and numbers of cells along x.
const DECADES: [i32; 6] = [0, 1, 2, 3, 4, 6];
const ALONG: [usize; 3] = [10, 30, 100];
const ANGLES: [f64; 8] = [0.0, 20.0, 40.0, 50.0, 60.0, 70.0, 75.0, 80.0];
/// Meshes and numbers of non-orthogonal correctors.
const SLANTED: [([usize; 2], usize); 3] = [([50, 15], 0), ([50, 15], 3), ([100, 30], 0)];
const FINE: ([usize; 2], usize) = ([200, 60], 5);
/// Range of T of case H* [K].
const RANGE: f64 = 50.0;

pub fn jobs(quick: bool) -> Vec<Job> {
    let steps = if quick { &STEPS[3..6] } else { &STEPS[..] };
    let mut jobs = vec![converged()];
    jobs.extend(SCHEMES.iter().flat_map(|scheme| steps.iter().map(|step| coupled(scheme, *step))));
    jobs.extend(contrasts(quick).map(|(decades, cells)| halves(decades, cells)));
    if !quick {
        for angle in ANGLES {
            jobs.extend(SLANTED.iter().chain([&FINE]).map(|&(cells, count)| slanted(angle, cells, count)));
        }
    }
    jobs.into_iter().map(Job::Solver).collect()
}

fn coupled(scheme: &str, step: f64) -> SolverJob {
    let job = SolverJob::coarse("H").control(&format!("deltaT {step};"));
    job.solution(&format!("msddFoam {{ timeScheme {scheme}; }}"))
}

/// The run with very small errors, with which the others are compared.
fn converged() -> SolverJob {
    SolverJob::coarse("H")
        .control("deltaT 1e-3; adjustTimeStep yes;")
        .solution("msddFoam { timeScheme secondOrder; temperatureTolerance 0.0005; stateTolerance 0.5; }")
        .solution("solvers { T { tolerance 1e-12; } }")
}

pub fn coupling(settings: &Settings, records: &Records) -> Vec<Coupling> {
    let exact = settings.record(records, &converged().into()).and_then(|record| record.run.clone());
    let Some(exact) = exact else { return Vec::new() };
    let mut list = Vec::new();
    for scheme in SCHEMES {
        for step in STEPS {
            let Some(record) = settings.record(records, &coupled(scheme, step).into()) else { continue };
            list.push(Coupling {
                scheme: scheme.to_string(),
                step,
                error: record.run.as_ref().map(|run| difference(run, &exact, 1.0)),
                outcome: record.outcome.as_str().to_string(),
                message: record.message.clone(),
            });
        }
    }
    list
}

/// Largest difference of T at the probes, over the times of the run from `from` [s] on [K].
fn difference(run: &Run, exact: &Run, from: f64) -> f64 {
    let series = |p: usize| -> Vec<[f64; 2]> { exact.temperature.iter().map(|r| [r[0], r[1 + p]]).collect() };
    let exact = [0, 1, 2].map(series);
    let rows = run.temperature.iter().filter(|row| row[0] >= from);
    let differences: Vec<f64> =
        rows.flat_map(|row| [0, 1, 2].map(|p| row[1 + p] - at(&exact[p], row[0]))).collect();
    largest(&differences).abs()
}

fn contrasts(quick: bool) -> impl Iterator<Item = (i32, usize)> {
    let along = if quick { &ALONG[..1] } else { &ALONG[..] };
    let decades = if quick { &DECADES[2..3] } else { &DECADES[..] };
    along.iter().flat_map(move |cells| decades.iter().map(move |decades| (*decades, *cells)))
}

/// A box of two halves whose conductivities differ by 10^`decades`, by the plug-in `contrast.c`: its conductivity falls by a
/// factor of ten for each 0.01 of porosity above 0.10.
fn halves(decades: i32, cells: usize) -> SolverJob {
    let porosity = |k: usize| if k < cells / 2 { 0.10 } else { 0.10 + 0.01 * f64::from(decades) };
    let list: Vec<String> = (0..cells).map(|k| porosity(k).to_string()).collect();
    let walls = "left { type fixedValue; value uniform 100; } right { type fixedValue; value uniform 0; } \
                 \"bottom|top\" { type zeroGradient; }";
    let mut job = SolverJob::new("HCstar", 1)
        .control("deltaT 1e12; functions { spaceProbes { writeInterval 1e12; } wallPressure { writeInterval 1e12; } }")
        .temperature(&format!("boundaryField {{ {walls} }}"))
        .grains("surrogate { type plugin; pluginCoeffs { library plugin.so; } }")
        .with("0/porosity", &format!("internalField nonuniform List<scalar> {cells}({});", list.join(" ")))
        .solution("solvers { T { tolerance 1e-14; } }");
    job.mesh = [cells, 1];
    job.uniform = Some([0.1, 0.0]);
    job.plugin = Some("rust/report/plugins/contrast.c".to_string());
    // Long enough for the steady state at any conductivity, in few steps.
    job.end = 5e12;
    job.limit = 60;
    job
}

/// Predicted error of the heat flow [%]. The scheme is a chain of thermal resistances: half cells at both ends, whole ones
/// between, and at the face between the halves the mean of the two conductivities. The heat flow is the inverse of their sum.
fn predicted_contrast(decades: i32, cells: usize) -> f64 {
    let (n, low) = (cells as f64, 10f64.powi(-decades));
    let exact = 0.5 * n * (1.0 + 1.0 / low);
    let chain = (0.5 * n - 0.5) * (1.0 + 1.0 / low) + 2.0 / (1.0 + low);
    100.0 * (exact / chain - 1.0)
}

/// Measured error of the heat flow, from T at P3 in the half that conducts less [%].
fn measured_contrast(run: &Run, decades: i32) -> Option<f64> {
    let low = 10f64.powi(-decades);
    let slope = run.temperature.last()?[3] / (BOX[0] - PROBES[2][0]);
    let exact = 100.0 / (0.5 * BOX[0] * (1.0 + 1.0 / low));
    Some(100.0 * (low * slope / exact - 1.0))
}

pub fn contrast(settings: &Settings, records: &Records) -> Vec<Contrast> {
    let one = |(decades, cells): (i32, usize)| {
        let record = settings.record(records, &halves(decades, cells).into())?;
        Some(Contrast {
            contrast: 10f64.powi(decades),
            cells,
            predicted: predicted_contrast(decades, cells),
            measured: record.run.as_ref().and_then(|run| measured_contrast(run, decades)),
            outcome: record.outcome.as_str().to_string(),
        })
    };
    contrasts(false).filter_map(one).collect()
}

pub fn slanted(angle: f64, cells: [usize; 2], correctors: usize) -> SolverJob {
    let mut job = SolverJob::new("Hstar", 1)
        .control("deltaT 0.1;")
        .solution(&format!("msddFoam {{ nNonOrthogonalCorrectors {correctors}; }}"));
    job.uniform = Some([0.125, 0.04]);
    job.mesh = cells;
    job.slant = angle;
    job.end = 5.0;
    job.limit = 300;
    job
}

pub fn slant(settings: &Settings, records: &Records) -> Vec<Slant> {
    let mut list = Vec::new();
    for angle in ANGLES {
        let fine = settings.record(records, &slanted(angle, FINE.0, FINE.1).into());
        let Some(fine) = fine.and_then(|record| record.run.as_ref()) else { continue };
        for (cells, correctors) in SLANTED {
            let record = settings.record(records, &slanted(angle, cells, correctors).into());
            list.extend(record.map(|record| Slant {
                angle,
                cells,
                correctors,
                error: record.run.as_ref().map(|run| 100.0 / RANGE * difference(run, fine, 0.5)),
                outcome: record.outcome.as_str().to_string(),
                message: record.message.clone(),
            }));
        }
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chain_of_resistances_is_exact_without_contrast_and_half_a_cell_short_with_much() {
        assert!(predicted_contrast(0, 10).abs() < 1e-12);
        assert!((predicted_contrast(6, 10) - 100.0 / 9.0).abs() < 1e-3);
    }
}
