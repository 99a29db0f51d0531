//! Converts rows of a database of spheres to paths of strain, on which the law of spheres is fitted.

use msdd_rve::database::spheres::{PathName, SphereCompression, SphereRecord};
use msdd_surrogate::spheres::tracks::{Point, Step, Track};
use std::collections::BTreeMap;

/// A state that carries load; `None` for others.
fn point(record: &SphereRecord) -> Option<Point> {
    if !matches!(record.outcome.as_str(), "settled" | "capped") {
        return None;
    }
    Some(Point {
        solid: record.solid_fraction?,
        stress: [
            record.stress_xx?,
            record.stress_yy?,
            record.stress_zz?,
            record.stress_xy?,
            record.stress_xz?,
            record.stress_yz?,
        ],
        contact: [
            record.contact_conductivity_xx?,
            record.contact_conductivity_yy?,
            record.contact_conductivity_zz?,
            record.contact_conductivity_xy?,
            record.contact_conductivity_xz?,
            record.contact_conductivity_yz?,
        ],
        gas: [record.gas_conductivity_3_5?, record.gas_conductivity_6_0?, record.gas_conductivity_8_5?],
        gas_along: [f64::NAN; 2],
        coordination: record.coordination?,
        fabric: [
            record.fabric_xx?,
            record.fabric_yy?,
            record.fabric_zz?,
            record.fabric_xy?,
            record.fabric_xz?,
            record.fabric_yz?,
        ],
        mobilised: match record.shaking {
            Some(_) => 1.0,
            None if record.friction > 0.0 => (record.packing_friction / record.friction).min(1.0),
            None => 0.0,
        },
    })
}

fn step(record: &SphereRecord) -> Option<Step> {
    let increment = record.increment()?;
    let stretch = increment.step.stretch;
    // The box closes or opens equally along the two other axes.
    let [x, y, z, ..] = stretch;
    let free_axis = match record.path {
        PathName::Pressed => [(y, z), (x, z), (x, y)].iter().position(|(a, b)| a == b),
        _ => None,
    };
    let from = usize::try_from(increment.from_stop).ok()?;
    Some(Step { from, thermal: increment.step.thermal, stretch, free_axis, to: point(record)? })
}

/// All paths, each as far as the box carries load. Those of `equivalence`, whose strains all start from the packed state, are left out.
pub fn tracks(records: &[SphereRecord]) -> Vec<Track> {
    let mut all: BTreeMap<(i64, PathName), Vec<&SphereRecord>> = BTreeMap::new();
    let mut packed: BTreeMap<i64, Point> = BTreeMap::new();
    for record in records {
        match record.path {
            PathName::Packed => {
                packed.extend(point(record).map(|point| (record.packing, point)));
            }
            PathName::Equivalence => {}
            path => all.entry((record.packing, path)).or_default().push(record),
        }
    }
    let tracks = all.into_iter().filter_map(|((packing, path), mut rows)| {
        rows.sort_by_key(|row| row.stop);
        let first = rows.first()?;
        let steps: Vec<Step> = rows.iter().map_while(|row| step(row)).collect();
        let loses_load = rows.get(steps.len()).is_some_and(|row| row.outcome == "unjammed");
        let recipe = format!(
            "{:?} {} {} {:?} {} {}",
            first.compression,
            first.packing_friction,
            first.friction,
            first.shaking,
            first.packing_pressure,
            first.spheres
        );
        let is_isotropic = first.compression == SphereCompression::Isotropic;
        let (name, spheres) = (path.to_string(), first.spheres as usize);
        let packed = *packed.get(&packing)?;
        let weight = 1.0;
        (!steps.is_empty()).then_some(Track {
            packing,
            name,
            recipe,
            is_isotropic,
            spheres,
            weight,
            packed,
            aside: 0.0,
            steps,
            loses_load,
        })
    });
    tracks.collect()
}
