//! Converts rows of a database to training data of the surrogate models.

use crate::tracks::tracks;
use msdd_rve::database::{Kind, RampName, Record};
use msdd_surrogate::StateRow;
use msdd_surrogate::training_data::TrainingData;
use msdd_surrogate::wall_friction::WallSlip;
use std::collections::BTreeMap;

/// Training data from all rows but those of failed simulations.
pub fn training_data(records: &[Record]) -> TrainingData {
    let of = |kind: Kind| records.iter().filter(move |r| r.kind == kind).collect::<Vec<_>>();
    TrainingData {
        rows: thermal_rows(&of(Kind::Thermal)),
        tracks: tracks(records),
        wall_slips: of(Kind::WallShear).into_iter().filter_map(wall_slip).collect(),
    }
}

/// One row. Stresses become dimensionless, σ ℓ/(E r̄) with ℓ = 1 m and the current r̄; the solid fraction is that of the
/// averaging region. `None` for a stop (a strain at which the state is recorded) that was not reached.
fn state_row(record: &Record, ramp: RampName, stop: i64) -> Option<StateRow> {
    let network = [record.conductivity_network_xx, record.conductivity_network_yy];
    Some(StateRow {
        packing: record.packing,
        ramp: ramp.to_string(),
        stop,
        strain: record.strain,
        porosity: record.porosity?,
        fabric_index: record.fabric_index?,
        conductivity_xx: record.conductivity_xx?,
        conductivity_yy: record.conductivity_yy?,
        conductivity_network: network[0].zip(network[1]).map(|(xx, yy)| [xx, yy]),
        stress_xx: record.stress_xx_reduced?,
        stress_yy: record.stress_yy_reduced?,
        porosity_sum_of_areas: record.porosity? - record.overlap_fraction?,
        load_bearing: record.carries_load(),
    })
}

/// The packed state is stop 0 of the ramps that start from it; a reversed ramp starts from the end of the other.
fn thermal_rows(records: &[&Record]) -> Vec<StateRow> {
    let mut rows = Vec::new();
    let mut last: BTreeMap<(i64, RampName), &Record> = BTreeMap::new();
    for &record in records {
        let key = (record.packing, record.ramp);
        if last.get(&key).is_none_or(|other| other.stop < record.stop) {
            last.insert(key, record);
        }
        match record.ramp {
            RampName::Packed => {
                rows.extend([RampName::Up, RampName::Down].iter().filter_map(|r| state_row(record, *r, 0)));
            }
            ramp => rows.extend(state_row(record, ramp, record.stop)),
        }
    }
    for (reversed, parent) in [(RampName::UpDown, RampName::Up), (RampName::DownUp, RampName::Down)] {
        let turned: Vec<i64> = last.keys().filter(|(_, ramp)| *ramp == reversed).map(|(p, _)| *p).collect();
        for packing in turned {
            let turn = last.get(&(packing, parent)).and_then(|record| state_row(record, reversed, -1));
            rows.extend(turn);
        }
    }
    rows
}

/// Largest (σ_xx − σ_yy)/(σ_xx + σ_yy) of packings whose friction at walls counts: grains that carry more slide past each other
/// before they slide along a wall, so that the friction is theirs.
const FAR_FROM_SLIDING: f64 = 0.2;

fn wall_slip(record: &Record) -> Option<WallSlip> {
    let (xx, yy) = (record.initial_stress_xx?, record.initial_stress_yy?);
    if (xx - yy).abs() > FAR_FROM_SLIDING * (xx + yy) {
        return None;
    }
    // The slip of the grains at the wall alone: the deformation of the bed behind them is computed by the solver.
    let slip = record.wall_slip_of_grains? / record.mean_radius?;
    Some(WallSlip { slip, friction: record.wall_friction? })
}
