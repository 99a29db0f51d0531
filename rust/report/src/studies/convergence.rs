//! Order of the coupling in time (section 3.4 of the paper): mean T of case H with fixed steps against a run with far smaller
//! errors.

use crate::jobs::execute::Outcome;
use crate::jobs::job::{Job, SolverJob};
use crate::jobs::pool::{Asked, Records};
use crate::settings::Settings;
use msdd_dem_reference::series::{at, root_mean_square};
use serde::Serialize;

/// Function object that writes the mean over the box, as a single sub-region.
const MEAN: &str = "watchMean";
/// Column of T in its rows.
const TEMPERATURE: usize = 3;

/// Errors of one scheme.
#[derive(Clone, Debug, Serialize)]
pub struct Convergence {
    pub scheme: String,
    /// Step \[s\] and root mean square over 20 s of the error of the mean T \[K\].
    pub errors: Vec<[f64; 2]>,
    /// Error = factor × step ^ order, least squares of the logarithms; with two steps or more.
    pub factor: Option<f64>,
    pub order: Option<f64>,
}

/// Schemes and their steps [s]. The second-order scheme has no step of 0.1 s, because the first one would strain the cells at
/// the walls by more than the model was trained for.
fn schemes(quick: bool) -> [(&'static str, Vec<f64>); 2] {
    if quick {
        return [("paper", vec![0.1, 0.05, 0.02]), ("secondOrder", vec![0.05, 0.02])];
    }
    [("paper", vec![0.1, 0.05, 0.02, 0.01, 0.005, 0.002]), ("secondOrder", vec![0.05, 0.02, 0.01])]
}

fn job(scheme: &str, step: f64, quick: bool) -> SolverJob {
    let mut job = SolverJob::new("H", 1)
        .control(&format!(
            "deltaT {step};\nfunctions {{ {MEAN} {{ type subRegions; windows (1 1); \
             libs (\"libgranularFunctionObjects.so\"); writeControl runTime; writeInterval 0.1; }} }}"
        ))
        .solution(&format!("msddFoam {{ timeScheme {scheme}; }}\nsolvers {{ T {{ tolerance 1e-12; }} }}"));
    if quick {
        job.mesh = [25, 8];
    }
    job
}

/// The run with far smaller errors, with which the others are compared.
fn finest(quick: bool) -> SolverJob {
    job("secondOrder", if quick { 0.01 } else { 0.002 }, quick)
}

pub fn jobs(settings: &Settings) -> Vec<Asked> {
    let quick = settings.quick;
    let mut jobs = vec![Asked { job: finest(quick).into(), guess: if quick { 1.0 } else { 20.0 } }];
    for (scheme, steps) in schemes(quick) {
        let asked = |step: f64| Asked { job: job(scheme, step, quick).into(), guess: 0.5 + 0.02 / step };
        jobs.extend(steps.into_iter().map(asked));
    }
    jobs
}

pub fn read(settings: &Settings, records: &Records) -> Vec<Convergence> {
    let means = |job: SolverJob| -> Option<Vec<[f64; 2]>> {
        let record = settings.record(records, &Job::Solver(job)).filter(|r| r.outcome == Outcome::Done)?;
        let rows = record.run.as_ref()?.watched.get(MEAN)?;
        rows.iter().map(|row| Some([row[0], *row.get(TEMPERATURE)?])).collect()
    };
    let Some(exact) = means(finest(settings.quick)) else { return Vec::new() };
    let of = |(scheme, steps): (&str, Vec<f64>)| {
        let error = |step: f64| {
            let found = means(job(scheme, step, settings.quick))?;
            let differences: Vec<f64> = found.iter().map(|row| row[1] - at(&exact, row[0])).collect();
            Some([step, root_mean_square(&differences)])
        };
        let errors: Vec<[f64; 2]> = steps.into_iter().filter_map(error).collect();
        let line = power_law(&errors);
        let (factor, order) = (line.map(|l| l.0), line.map(|l| l.1));
        Convergence { scheme: scheme.to_string(), errors, factor, order }
    };
    schemes(settings.quick).into_iter().map(of).collect()
}

/// Fits error = factor × step ^ order; returns (factor, order).
fn power_law(errors: &[[f64; 2]]) -> Option<(f64, f64)> {
    let points: Vec<[f64; 2]> = errors.iter().filter(|e| e[1] > 0.0).map(|e| e.map(f64::ln)).collect();
    if points.len() < 2 {
        return None;
    }
    let mean = |k: usize| points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(0), mean(1));
    let order = points.iter().map(|p| (p[0] - x) * (p[1] - y)).sum::<f64>()
        / points.iter().map(|p| (p[0] - x).powi(2)).sum::<f64>();
    Some(((y - order * x).exp(), order))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_is_found_again() {
        let errors: Vec<[f64; 2]> =
            [0.1, 0.02, 0.004].iter().map(|h: &f64| [*h, 2.2 * h.powf(1.14)]).collect();
        let (factor, order) = power_law(&errors).unwrap();
        assert!((factor - 2.2).abs() < 1e-9 && (order - 1.14).abs() < 1e-9);
        assert!(power_law(&errors[..1]).is_none());
    }
}
