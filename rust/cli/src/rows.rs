//! Converts rows of a database to training data of the surrogate models.

use msdd_rve::database::{Kind, RampName, Record};
use msdd_surrogate::StateRow;
use msdd_surrogate::mechanics::{LINEAR_STRAIN, WallStrain};
use msdd_surrogate::models::TrainingData;
use msdd_surrogate::state::training::Mechanical;
use msdd_surrogate::state::variables::stress_ratio;
use msdd_surrogate::wall_friction::WallSlip;
use std::collections::BTreeMap;

/// Training data from all rows but those of failed simulations.
pub fn training_data(records: &[Record]) -> TrainingData {
    let of = |kind: Kind| records.iter().filter(move |r| r.kind == kind).collect::<Vec<_>>();
    TrainingData {
        rows: thermal_rows(&of(Kind::Thermal)),
        mechanical: Mechanical {
            wall_strains: wall_strains(&of(Kind::Mechanics)),
            wall_slips: of(Kind::WallShear).into_iter().filter_map(wall_slip).collect(),
        },
    }
}

/// One row. Stresses become dimensionless, σ ℓ/(E r̄) with ℓ = 1 m and the current r̄; the solid fraction is that of the
/// averaging region. `None` for a stop (a strain at which the state is recorded) that was not reached.
fn state_row(record: &Record, ramp: RampName, stop: i64) -> Option<StateRow> {
    let network = [record.conductivity_network_xx, record.conductivity_network_yy];
    Some(StateRow {
        packing: record.packing,
        ramp: ramp.as_str().to_string(),
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
        load_bearing: record.bears_load(),
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

/// Strain increments between neighbouring stops of the ramps along x and y, from boxes with walls and periodic ones; the
/// packed state lies between the compressive and the extensive stops. Shear (xy) is left out: the tangent takes the shear
/// modulus as (c11 − c12)/2, which agrees with simulated shear within 3 % at small strain (isotropic packings).
fn wall_strains(mechanics: &[&Record]) -> Vec<WallStrain> {
    let mut ramps: BTreeMap<(i64, RampName), Vec<&Record>> = BTreeMap::new();
    for record in mechanics.iter().filter(|r| matches!(r.ramp, RampName::Xx | RampName::Yy)) {
        ramps.entry((record.packing, record.ramp)).or_default().push(record);
    }
    for packed in mechanics.iter().filter(|r| r.ramp == RampName::Packed) {
        for ramp in [RampName::Xx, RampName::Yy] {
            ramps.entry((packed.packing, ramp)).or_default().push(packed);
        }
    }
    let mut samples = Vec::new();
    for ramp in ramps.values_mut() {
        ramp.sort_by_key(|record| record.stop);
        samples.extend(ramp.windows(2).filter_map(|pair| wall_strain(pair[0], pair[1])));
    }
    samples
}

/// Differences between two neighbouring stops; `None` when one was not reached, or lies beyond the linear range.
fn wall_strain(a: &Record, b: &Record) -> Option<WallStrain> {
    let linear = |r: &Record| r.strain_xx.abs().max(r.strain_yy.abs()) <= LINEAR_STRAIN;
    if a.stop + 1 != b.stop || !linear(a) || !linear(b) {
        return None;
    }
    let state = |record: &Record| state_row(record, record.ramp, record.stop);
    between(&(state(a)?, [a.strain_xx, a.strain_yy]), &(state(b)?, [b.strain_xx, b.strain_yy]))
}

fn between((a, strain_a): &(StateRow, [f64; 2]), (b, strain_b): &(StateRow, [f64; 2])) -> Option<WallStrain> {
    let jammed = a.load_bearing && b.load_bearing;
    let strain = [0, 1].map(|k| (1.0 + strain_b[k]) / (1.0 + strain_a[k]) - 1.0);
    if !jammed || strain == [0.0; 2] {
        return None;
    }
    let pressure = 0.25 * (a.stress_xx + a.stress_yy + b.stress_xx + b.stress_yy);
    let deviator = 0.25 * (a.stress_xx - a.stress_yy + b.stress_xx - b.stress_yy);
    let fabric = |row: &StateRow| {
        let [xx, yy] = row.conductivity_network.unwrap_or([row.conductivity_xx, row.conductivity_yy]);
        (xx - yy) / (xx + yy)
    };
    Some(WallStrain {
        packing: a.packing,
        strain,
        pressure,
        stress_ratio: stress_ratio(deviator, pressure),
        porosity: 0.5 * (a.porosity + b.porosity),
        stress: [b.stress_xx - a.stress_xx, b.stress_yy - a.stress_yy],
        delta_porosity: b.porosity - a.porosity,
        delta_fabric_index: b.fabric_index - a.fabric_index,
        delta_fabric_conductivity: fabric(b) - fabric(a),
    })
}

fn wall_slip(record: &Record) -> Option<WallSlip> {
    // The slip of the grains at the wall alone: the deformation of the bed behind them is computed by the solver.
    let slip = record.wall_slip_of_grains? / record.mean_radius?;
    Some(WallSlip { slip, friction: record.wall_friction? })
}
