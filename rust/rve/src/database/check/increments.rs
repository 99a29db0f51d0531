//! Laws of the rows of paths: each follows from the row that its increment starts from.

use super::planned::{Found, jobs, named, tolerance, within};
use crate::Strains;
use crate::database::kind::{Kind, RampName};
use crate::database::paths::Increment;
use crate::database::plan::Job;
use crate::database::{Dataset, Plan, Record, Violation};
use std::collections::BTreeMap;

/// Rows by packing, ramp and stop.
type Rows<'a> = BTreeMap<(i64, RampName, i64), &'a Record>;

/// All violated laws of the rows of paths, and of their columns in other rows.
pub(super) fn violations(dataset: &Dataset) -> Vec<Violation> {
    let (records, tolerance) = (&dataset.records, tolerance(dataset));
    let is_path = |record: &&Record| record.kind == Kind::Paths && record.ramp != RampName::Packed;
    let rows: Rows = records.iter().map(|r| ((r.packing, r.ramp, r.stop), r)).collect();
    let mut violations = Vec::new();
    for record in records.iter().filter(|record| !is_path(record)) {
        let steps = [record.step_thermal, record.step_xx, record.step_yy, record.step_xy];
        if (record.from_stop, record.probe, steps) != (None, None, [None; 4]) {
            let text = format!("from_stop {:?}, steps {steps:?}", record.from_stop);
            violations.extend(named(record, vec![("only rows of paths have an increment", text)]));
        }
    }
    // A plan that cannot be read is a violation of its own.
    let planned = planned(&jobs::<Plan>(dataset).unwrap_or_default());
    for record in records.iter().filter(is_path) {
        violations.extend(named(record, row_laws(record, &rows, &planned, tolerance)));
    }
    violations
}

/// Planned increments by packing, path and stop.
type Plans = BTreeMap<(i64, RampName, i64), Increment>;

fn planned(jobs: &[Job]) -> Plans {
    let mut plans = Plans::new();
    for job in jobs {
        for &path in &job.ramps {
            let rows = job.path(path).into_iter();
            plans.extend(rows.map(|row| ((job.packing, path, row.stop), row.increment)));
        }
    }
    plans
}

/// Whether all parts agree within the tolerance, relative to each part.
fn agree(a: Strains, b: Strains, tolerance: f64) -> bool {
    a.parts().iter().zip(b.parts()).all(|(a, b)| within(a - b, tolerance * b.abs().max(tolerance)))
}

fn row_laws(record: &Record, rows: &Rows, plans: &Plans, tolerance: f64) -> Found {
    let Some(increment) = record.increment().filter(|_| record.probe.is_some_and(|probe| probe < 2)) else {
        let text = format!("from_stop {:?}, probe {:?}", record.from_stop, record.probe);
        return vec![("a row of a path has its increment", text)];
    };
    let mut found = Vec::new();
    let plan = plans.get(&(record.packing, record.ramp, record.stop));
    let same = |plan: &&Increment| {
        (plan.from_stop, plan.probe) == (increment.from_stop, increment.probe)
            && agree(increment.step, plan.step, 4.0 * tolerance)
    };
    if plan.is_some_and(|plan| !same(&plan)) {
        found.push(("the increment is the plan's", format!("{increment:?}, plan {plan:?}")));
    }
    let ramp = if increment.from_stop == 0 { RampName::Packed } else { record.ramp };
    let Some(from) = rows.get(&(record.packing, ramp, increment.from_stop)) else {
        found.push(("an increment starts from a row", format!("stop {} is absent", increment.from_stop)));
        return found;
    };
    if !strains_add_up(from.strains(), increment.step, record.strains(), tolerance) {
        let text = format!("{:?} and {:?} give {:?}", from.strains(), increment.step, record.strains());
        found.push(("strains add up", text));
    }
    if record.porosity.is_some() {
        if record.fabric_xy.is_none() {
            found.push(("a state has all averages", "fabric_xy is absent".to_string()));
        }
        if from.carries_load() {
            found.extend(state_laws([from, record], increment.step, tolerance));
        } else {
            found.push(("a path ends where no load is borne", format!("stop {}", increment.from_stop)));
        }
    }
    found
}

/// Whether `now` is what `from` and then `step` give.
fn strains_add_up(from: Strains, step: Strains, now: Strains, tolerance: f64) -> bool {
    let off = from.then(step).parts().into_iter().zip(now.parts()).map(|(a, b)| a - b);
    off.into_iter().all(|off| within(off, tolerance))
}

/// Mean radius and solid fraction follow the increment exactly; what it leaves alone does not change.
fn state_laws(
    [from, now]: [&Record; 2],
    step: Strains,
    tolerance: f64,
) -> impl Iterator<Item = (&'static str, String)> {
    let radius = || Some(now.mean_radius? / (from.mean_radius? * (1.0 + step.thermal)) - 1.0);
    let solid = |r: &Record| r.porosity_sum_of_areas.map(|porosity| 1.0 - porosity);
    let growth = (1.0 + step.thermal).powi(2) / ((1.0 + step.xx) * (1.0 + step.yy));
    let area = || Some(solid(now)? - solid(from)? * growth);
    // The values of both rows are the same text where nothing changes, however many digits they have.
    let unchanged = |still: bool, now: Option<f64>, from: Option<f64>| {
        (still && now != from).then(|| format!("{now:?} after {from:?}"))
    };
    let still = [
        unchanged(step.thermal == 0.0, now.mean_radius, from.mean_radius),
        unchanged(step.thermal == 0.0, Some(now.strain), Some(from.strain)),
        unchanged(step.xx == 0.0, Some(now.strain_xx), Some(from.strain_xx)),
        unchanged(step.yy == 0.0, Some(now.strain_yy), Some(from.strain_yy)),
    ];
    let off = |law, off: Option<f64>| match off {
        Some(off) if within(off, 4.0 * tolerance) => None,
        off => Some((law, format!("off by {:.3e}", off.unwrap_or(f64::NAN)))),
    };
    let exact = [off("the mean radius follows", radius()), off("the solid fraction follows", area())];
    let still = still.into_iter().flatten().map(|text| ("no increment, no change", text));
    exact.into_iter().flatten().chain(still)
}
