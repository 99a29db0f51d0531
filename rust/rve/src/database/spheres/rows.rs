//! The rows of one packing of spheres: its packed state and every stop of its paths.

use super::free_axis::FreeAxis;
use super::kind::PathName;
use super::paths::Planned;
use super::plan::SphereJob;
use super::record::SphereRecord;
use crate::Settled;
use crate::database::path_rows::goes_on;
use crate::spheres::turn::{turned, turned_strain};
use crate::spheres::{Averages, Strain, advance, averages, prepare};
use crate::stopwatch::{self, Stage};
use msdd_spheres::Simulation;

/// A state that was reached.
type State = (Settled, Averages);

/// Makes a packing and takes it along its paths. A stop that was not reached has a row, too, with the reason.
pub(super) fn rows(job: &SphereJob) -> Vec<SphereRecord> {
    let prepared = match prepare(&job.preparation) {
        Ok(prepared) => prepared,
        Err(error) => return unreached(job, &format!("packing: {error}")),
    };
    let state = averaged(&prepared.simulation).map(|averages| (prepared.rest, averages));
    let state = match state {
        Ok(state) => state,
        Err(reason) => return unreached(job, &format!("packing: {reason}")),
    };
    let mut records = vec![SphereRecord::packed(job, Ok(&state))];
    for &path in &job.paths {
        let mut planned = job.path(path);
        let results = follow(&prepared.simulation, prepared.rest, path, &mut planned);
        let row = |(planned, result): (&Planned, Result<State, String>)| {
            SphereRecord::on_path(job, path, planned, result.as_ref().map_err(String::as_str))
        };
        records.extend(planned.iter().zip(results).map(row));
    }
    records
}

fn unreached(job: &SphereJob, reason: &str) -> Vec<SphereRecord> {
    let mut records = vec![SphereRecord::packed(job, Err(reason))];
    for &path in &job.paths {
        let row = |planned: &Planned| SphereRecord::on_path(job, path, planned, Err(reason));
        records.extend(job.path(path).iter().map(row));
    }
    records
}

fn averaged(simulation: &Simulation) -> Result<Averages, String> {
    let found = stopwatch::time(Stage::Averaging, || averages(simulation));
    found.ok_or_else(|| "the network of its contacts was not solved".to_string())
}

/// The states of one path, or why they were not reached. A path ends where a failure happens or where the box carries no load
/// any more. Where the box yields along an axis, that part of the plan is filled in.
fn follow(
    packed: &Simulation,
    rest: Settled,
    path: PathName,
    planned: &mut [Planned],
) -> Vec<Result<State, String>> {
    let start = goes_on(packed.clone(), rest, 0);
    let mut here = start.clone();
    let mut results = Vec::new();
    let mut free_axis = FreeAxis::of(packed);
    let mut strain = Strain::default();
    for row in planned {
        if let Some(axis) = row.free_axis {
            if let Ok(simulation) = &here {
                row.increment.step.stretch[axis] = free_axis.next(simulation, axis, &row.increment.step);
            }
            strain = strain.then(row.increment.step);
            row.strain = strain;
        }
        let from = if path == PathName::Equivalence { &start } else { &here };
        let increment = row.increment;
        let reached = from.clone().and_then(|simulation| match increment.turned {
            true => step_turned(&simulation, increment.step),
            false => step(simulation, increment.step),
        });
        let (result, next) = match reached {
            Ok((state, simulation)) => (Ok(state), goes_on(simulation, state.0, row.stop)),
            Err(reason) => (Err(reason.clone()), Err(reason)),
        };
        results.push(result);
        here = next;
    }
    results
}

/// Applies one increment and lets the box come to rest.
fn step(mut simulation: Simulation, step: Strain) -> Result<(State, Simulation), String> {
    let rest = advance(&mut simulation, step).map_err(|error| error.to_string())?;
    Ok(((rest, averaged(&simulation)?), simulation))
}

/// As [`step`], in the turned box; averages in the axes of the box that was turned.
fn step_turned(simulation: &Simulation, strain: Strain) -> Result<(State, Simulation), String> {
    let turned = turned(simulation).ok_or_else(|| "the box is sheared and cannot be turned".to_string())?;
    let ((rest, averages), simulation) = step(turned, turned_strain(strain))?;
    Ok(((rest, averages.turned_back()), simulation))
}
