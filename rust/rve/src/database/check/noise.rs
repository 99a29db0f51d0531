//! Scatter of the outputs at equal inputs η₀, f₀, ε: a lower bound for the error of any surrogate with these inputs.

use super::local::{NEIGHBOURS, Points, variance};
use crate::database::Record;
use crate::database::plan::{Kind, RampName};
use std::collections::{BTreeMap, BTreeSet};

/// Scatter of one output over packings of one size.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    pub discs: u64,
    pub output: &'static str,
    /// Number of states that the mean is taken over.
    pub states: usize,
    /// Standard deviation of single values at equal η₀, f₀ and ε.
    pub deviation: f64,
    /// `deviation` over the standard deviation of all values of this output.
    pub share: f64,
}

type Output = (&'static str, fn(&Record) -> Option<f64>);

/// The outputs of the paper's database and further quantities that a surrogate may learn. Stresses are reduced (σ ℓ/(E
/// r̄)).
const OUTPUTS: [Output; 9] = [
    ("delta_porosity", |r| Some(r.porosity? - r.initial_porosity?)),
    ("delta_fabric_index", |r| Some(r.fabric_index? - r.initial_fabric_index?)),
    ("delta_fabric_conductivity", |r| Some(r.fabric_conductivity? - r.initial_fabric_conductivity?)),
    ("conductivity_xx", |r| r.conductivity_xx),
    ("conductivity_yy", |r| r.conductivity_yy),
    ("conductivity_network_xx", |r| r.conductivity_network_xx),
    ("conductivity_network_yy", |r| r.conductivity_network_yy),
    ("stress_xx_reduced", |r| r.stress_xx_reduced),
    ("stress_yy_reduced", |r| r.stress_yy_reduced),
];

/// Scatter by size, then output. Only thermal ramps from the packed state and states that bear load are used; sizes
/// with too few packings for a local fit are left out.
pub(super) fn noise(records: &[Record]) -> Vec<Noise> {
    let ramps = [RampName::Packed, RampName::Up, RampName::Down];
    let rows: Vec<&Record> = records
        .iter()
        .filter(|r| r.kind == Kind::Thermal && ramps.contains(&r.ramp) && r.bears_load())
        .collect();
    let sizes: BTreeSet<u64> = rows.iter().map(|r| r.discs).collect();
    let pairs = sizes.iter().flat_map(|&discs| OUTPUTS.iter().map(move |output| (discs, *output)));
    pairs.filter_map(|(discs, output)| of_output(&rows, discs, output)).collect()
}

fn of_output(rows: &[&Record], discs: u64, (output, value): Output) -> Option<Noise> {
    // Groups of states with equal ε. The key is the bit pattern of ε; equal strains have equal bits, and the order of
    // the groups does not matter.
    let mut strains: BTreeMap<u64, Vec<([f64; 2], f64)>> = BTreeMap::new();
    for record in rows.iter().filter(|r| r.discs == discs) {
        let inputs = [record.initial_porosity?, record.initial_fabric_index?];
        if let Some(value) = value(record) {
            strains.entry(record.strain.to_bits()).or_default().push((inputs, value));
        }
    }
    let mut variances = Vec::new();
    let mut values = Vec::new();
    for group in strains.into_values().filter(|group| group.len() >= NEIGHBOURS) {
        let (inputs, output): (Vec<[f64; 2]>, Vec<f64>) = group.into_iter().unzip();
        let points = Points { inputs: &inputs, output: &output };
        variances.extend(inputs.iter().filter_map(|&at| points.fit(at)).map(|(_, variance)| variance));
        values.extend(output);
    }
    if variances.is_empty() {
        return None;
    }
    let deviation = (variances.iter().sum::<f64>() / variances.len() as f64).sqrt();
    let all = variance(&values).sqrt();
    let share = if all > 0.0 { deviation / all } else { 0.0 };
    Some(Noise { discs, output, states: variances.len(), deviation, share })
}
