//! Converts rows of a database to paths of strain, on which the law of the increments is fitted.

use msdd_rve::database::{Kind, RampName, Record};
use msdd_surrogate::tracks::{Point, Step, Track};
use std::collections::BTreeMap;

/// A state of a periodic box; `None` for a stop that was not reached.
fn point(record: &Record) -> Option<Point> {
    let scale = record.young_modulus * record.mean_radius?;
    let reduced = |stress: Option<f64>| Some(stress? / scale);
    let network = record.conductivity_network_xx.zip(record.conductivity_network_yy);
    Some(Point {
        porosity: record.porosity?,
        solid: 1.0 - record.porosity_sum_of_areas?,
        stress: [
            reduced(record.stress_xx)?,
            reduced(record.stress_yy)?,
            0.5 * (reduced(record.stress_xy)? + reduced(record.stress_yx)?),
        ],
        affine: [record.conductivity_xx?, record.conductivity_yy?, record.conductivity_xy?],
        network: network.zip(record.conductivity_network_xy).map(|((xx, yy), xy)| [xx, yy, xy]),
        fabric_index: record.fabric_index?,
        fabric_shear: record.fabric_xy.map(|xy| 2.0 * xy),
        load_bearing: record.carries_load(),
    })
}

/// All paths of periodic boxes: those of the kind `paths`, thermal ramps with their ways back, and ramps of the box.
pub fn tracks(records: &[Record]) -> Vec<Track> {
    let mut packings: BTreeMap<i64, Vec<&Record>> = BTreeMap::new();
    for record in records.iter().filter(|record| record.region == "cell") {
        packings.entry(record.packing).or_default().push(record);
    }
    packings.into_values().flat_map(|rows| tracks_of(&rows)).collect()
}

fn tracks_of(rows: &[&Record]) -> Vec<Track> {
    let Some(packed) = rows.iter().find(|row| row.ramp == RampName::Packed) else { return Vec::new() };
    let Some(start) = point(packed) else { return Vec::new() };
    let mut ramps: BTreeMap<RampName, Vec<&Record>> = BTreeMap::new();
    for row in rows.iter().filter(|row| row.ramp != RampName::Packed) {
        ramps.entry(row.ramp).or_default().push(row);
    }
    let mut all = Vec::new();
    for (&ramp, stops) in &mut ramps {
        stops.sort_by_key(|row| row.stop);
        let steps = match (packed.kind, ramp) {
            (Kind::Paths, _) => on_path(stops),
            (_, RampName::Up | RampName::Down) => chain(packed, stops),
            (_, RampName::Xx | RampName::Yy | RampName::Xy) => {
                let (closing, opening): (Vec<&Record>, Vec<&Record>) =
                    stops.iter().partition(|row| row.stop < 0);
                let closing: Vec<&Record> = closing.into_iter().rev().collect();
                for part in [closing, opening] {
                    all.push(track(packed, ramp, start, chain(packed, &part)));
                }
                continue;
            }
            _ => continue,
        };
        all.push(track(packed, ramp, start, steps));
    }
    for (turned, first) in [(RampName::UpDown, RampName::Up), (RampName::DownUp, RampName::Down)] {
        if let (Some(first), Some(back)) = (ramps.get(&first), ramps.get(&turned)) {
            let whole: Vec<&Record> = first.iter().chain(back).copied().collect();
            all.push(track(packed, turned, start, chain(packed, &whole)));
        }
    }
    all.retain(|track| start.load_bearing && !track.steps.is_empty());
    all
}

fn track(packed: &Record, ramp: RampName, start: Point, steps: Vec<Step>) -> Track {
    let name = ramp.to_string();
    Track { packing: packed.packing, name, discs: packed.discs as usize, packed: start, steps }
}

/// Steps of a path, as far as each state was reached from which one starts.
fn on_path(stops: &[&Record]) -> Vec<Step> {
    let mut numbers: BTreeMap<i64, usize> = BTreeMap::from([(0, 0)]);
    let mut steps = Vec::new();
    for row in stops {
        let (Some(increment), Some(to)) = (row.increment(), point(row)) else { break };
        let Some(&from) = numbers.get(&increment.from_stop) else { break };
        let strain = [increment.step.thermal, increment.step.xx, increment.step.yy, increment.step.xy];
        steps.push(Step { from, strain, to, probe: increment.probe });
        numbers.insert(row.stop, steps.len());
    }
    steps
}

/// Steps from stop to stop.
fn chain(packed: &Record, stops: &[&Record]) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    let mut before = packed.strains();
    for row in stops {
        let Some(to) = point(row) else { break };
        let now = row.strains();
        let ratio = |a: f64, b: f64| (1.0 + b) / (1.0 + a) - 1.0;
        let strain = [
            ratio(before.thermal, now.thermal),
            ratio(before.xx, now.xx),
            ratio(before.yy, now.yy),
            (now.xy - before.xy) / (1.0 + before.yy),
        ];
        steps.push(Step { from: steps.len(), strain, to, probe: false });
        before = now;
    }
    steps
}
