//! Laws of the rows of paths: each follows from the row that its increment starts from.

use crate::database::check::planned::{Found, jobs, named, within};
use crate::database::spheres::kind::PathName;
use crate::database::spheres::paths::{Increment, Planned};
use crate::database::spheres::plan::{SphereJob, SpherePlan};
use crate::database::spheres::record::SphereRecord;
use crate::database::{Dataset, Violation};
use crate::spheres::Strain;
use std::collections::BTreeMap;

type Key = (i64, PathName, i64);

/// All violated laws of the rows of paths, and of their columns in packed rows.
pub(super) fn violations(dataset: &Dataset<SphereRecord>, tolerance: f64) -> Vec<Violation> {
    let rows: BTreeMap<Key, &SphereRecord> =
        dataset.records.iter().map(|r| ((r.packing, r.path, r.stop), r)).collect();
    // A plan that cannot be read is a violation of its own.
    let planned = planned(&jobs::<SpherePlan>(dataset).unwrap_or_default());
    let mut violations = Vec::new();
    for record in &dataset.records {
        let found = match record.path {
            PathName::Packed => packed_laws(record),
            _ => row_laws(record, &rows, &planned, tolerance),
        };
        violations.extend(named(record, found));
    }
    violations
}

fn planned(jobs: &[SphereJob]) -> BTreeMap<Key, Planned> {
    let mut plans = BTreeMap::new();
    for job in jobs {
        for &path in &job.paths {
            let rows = job.path(path).into_iter();
            plans.extend(rows.map(|row| ((job.packing, path, row.stop), row)));
        }
    }
    plans
}

fn packed_laws(record: &SphereRecord) -> Found {
    let sound = record.increment().is_none() && record.strain() == Strain::default();
    if sound { Vec::new() } else { vec![("a packed state has no strain", format!("{:?}", record.strain()))] }
}

fn parts(strain: Strain) -> impl Iterator<Item = f64> {
    std::iter::once(strain.thermal).chain(strain.stretch)
}

/// Whether all parts agree within the tolerance, relative to each part.
fn agree(a: Strain, b: Strain, tolerance: f64) -> bool {
    parts(a).zip(parts(b)).all(|(a, b)| within(a - b, tolerance * b.abs().max(tolerance)))
}

fn row_laws(
    record: &SphereRecord,
    rows: &BTreeMap<Key, &SphereRecord>,
    plans: &BTreeMap<Key, Planned>,
    tolerance: f64,
) -> Found {
    let Some(increment) = record.increment() else {
        return vec![("a row of a path has its increment", format!("from_stop {:?}", record.from_stop))];
    };
    let mut found = Vec::new();
    let plan = plans.get(&(record.packing, record.path, record.stop));
    let same = |plan: &Planned| {
        let Increment { from_stop, turned, step } = plan.increment;
        let mut made = increment.step;
        plan.free_axis.into_iter().for_each(|axis| made.stretch[axis] = step.stretch[axis]);
        (from_stop, turned) == (increment.from_stop, increment.turned) && agree(made, step, 4.0 * tolerance)
    };
    if plan.is_some_and(|plan| !same(plan)) {
        found.push(("the increment is the plan's", format!("{increment:?}, plan {plan:?}")));
    }
    let path = if increment.from_stop == 0 { PathName::Packed } else { record.path };
    let Some(from) = rows.get(&(record.packing, path, increment.from_stop)) else {
        found.push(("an increment starts from a row", format!("stop {} is absent", increment.from_stop)));
        return found;
    };
    let sum = from.strain().then(increment.step);
    if !parts(sum).zip(parts(record.strain())).all(|(a, b)| within(a - b, tolerance)) {
        found.push(("strains add up", format!("{sum:?}, found {:?}", record.strain())));
    }
    if let (Some(before), Some(now)) = (from.solid_fraction, record.solid_fraction) {
        let growth = (1.0 + increment.step.thermal).powi(3) / increment.step.volume_ratio();
        if !within(now - before * growth, 4.0 * tolerance) {
            found.push(("the solid fraction follows", format!("off by {:.3e}", now - before * growth)));
        }
        if !from.carries_load() {
            let text = format!("stop {}", increment.from_stop);
            found.push(("a path ends where no load is borne", text));
        }
    }
    found
}
