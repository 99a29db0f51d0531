//! Rows of a database as the surrogate's training data. Columns are taken by name, so that databases of an older schema,
//! which lack some, do as well.

use msdd_rve::database::Record;
use msdd_surrogate::StateRow;
use msdd_surrogate::mechanics::WallStrain;
use msdd_surrogate::models::TrainingData;
use msdd_surrogate::state::training::Mechanical;
use msdd_surrogate::state::variables::stress_ratio;
use msdd_surrogate::wall_friction::WallSlip;
use serde_json::Value;
use std::collections::BTreeMap;

/// What training can use: all but failures.
pub fn training_data(records: &[Record]) -> TrainingData {
    let records: Vec<(&Record, Value)> = records.iter().map(|r| (r, serde_json::json!(r))).collect();
    let kind = |fields: &Value| fields["kind"].as_str().unwrap_or("thermal").to_string();
    let of = |wanted: &str| records.iter().filter(|(_, f)| kind(f) == wanted).collect::<Vec<_>>();
    let thermal = of("thermal");
    TrainingData {
        rows: thermal_rows(&thermal),
        mechanical: Mechanical {
            wall_strains: wall_strains(&of("mechanics"), &thermal),
            wall_slips: of("wall_shear").into_iter().filter_map(wall_slip).collect(),
        },
    }
}

/// Stresses become dimensionless, σ ℓ/(E r̄) with ℓ = 1 m and the current r̄; the solid fraction is that of the averaging
/// region.
fn state_row((record, fields): &(&Record, Value), ramp: &str, stop: i64) -> Option<StateRow> {
    let scale = record.young_modulus * record.mean_radius?;
    let network = |key: &str| fields[key].as_f64();
    Some(StateRow {
        packing: record.packing,
        ramp: ramp.to_string(),
        stop,
        strain: record.strain,
        porosity: record.porosity?,
        fabric_index: record.fabric_index?,
        conductivity_xx: record.conductivity_xx?,
        conductivity_yy: record.conductivity_yy?,
        conductivity_network: network("conductivity_network_xx")
            .and_then(|xx| Some([xx, network("conductivity_network_yy")?])),
        stress_xx: record.stress_xx? / scale,
        stress_yy: record.stress_yy? / scale,
        porosity_sum_of_areas: record.porosity? - record.overlap_fraction?,
        load_bearing: record.outcome != "unjammed",
    })
}

/// The packed state is stop 0 of the ramps that start from it; a reversed ramp starts from the end of the other.
fn thermal_rows(records: &[&(&Record, Value)]) -> Vec<StateRow> {
    let mut rows = Vec::new();
    let mut last: BTreeMap<(i64, &str), &(&Record, Value)> = BTreeMap::new();
    for entry in records {
        let record = entry.0;
        let key = (record.packing, record.ramp.as_str());
        if last.get(&key).is_none_or(|other| other.0.stop < record.stop) {
            last.insert(key, entry);
        }
        match record.ramp.as_str() {
            "packed" => rows.extend(["up", "down"].iter().filter_map(|ramp| state_row(entry, ramp, 0))),
            ramp => rows.extend(state_row(entry, ramp, record.stop)),
        }
    }
    for (reversed, parent) in [("up_down", "up"), ("down_up", "down")] {
        let turned: Vec<i64> = last.keys().filter(|(_, ramp)| *ramp == reversed).map(|(p, _)| *p).collect();
        for packing in turned {
            let turn = last.get(&(packing, parent)).and_then(|entry| state_row(entry, reversed, -1));
            rows.extend(turn);
        }
    }
    rows
}

/// A state and the strains ε_xx, ε_yy of the box.
type Strained = (StateRow, [f64; 2]);

/// Neighbouring stops of the wall-strain ramps. Each starts from the packed state.
fn wall_strains(mechanics: &[&(&Record, Value)], thermal: &[&(&Record, Value)]) -> Vec<WallStrain> {
    let strain =
        |fields: &Value| [&fields["strain_xx"], &fields["strain_yy"]].map(|v| v.as_f64().unwrap_or(0.0));
    let mut ramps: BTreeMap<(i64, &str), Vec<Strained>> = BTreeMap::new();
    for entry in mechanics {
        if let Some(row) = state_row(entry, entry.0.ramp.as_str(), entry.0.stop) {
            ramps.entry((entry.0.packing, entry.0.ramp.as_str())).or_default().push((row, strain(&entry.1)));
        }
    }
    for ((packing, _), ramp) in &mut ramps {
        if ramp.iter().all(|(row, _)| row.stop != 0) {
            let packed = thermal
                .iter()
                .chain(mechanics)
                .find(|e| e.0.packing == *packing && e.0.ramp.as_str() == "packed");
            ramp.extend(packed.and_then(|entry| Some((state_row(entry, "packed", 0)?, [0.0; 2]))));
        }
        ramp.sort_by_key(|(row, _)| row.stop);
    }
    let sample = |pair: &[(StateRow, [f64; 2])]| between(&pair[0], &pair[1]);
    ramps.values().flat_map(|ramp| ramp.windows(2).filter_map(sample)).collect()
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

fn wall_slip((record, fields): &(&Record, Value)) -> Option<WallSlip> {
    let slip = fields["wall_slip"].as_f64()?.abs() / record.mean_radius?;
    Some(WallSlip { slip, friction: fields["wall_friction"].as_f64()?.abs() })
}
