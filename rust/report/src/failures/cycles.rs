//! Ten thermal cycles of 50 K ± 20 K (case `cycle`): the solver compared with DEM.

use crate::jobs::job::{Job, Part, SolverJob};
use crate::jobs::pool::Records;
use crate::read_text;
use crate::settings::Settings;
use msdd_dem_reference::compare::{reference_sub_regions, sub_regions};
use msdd_dem_reference::packings::Reference;
use msdd_dem_reference::series::at;
use msdd_dem_reference::series::statistics;
use serde::Serialize;
use std::path::Path;

/// Results of the cycles: pressure over that at the start [-], at the start and at the end of each quarter of a cycle.
#[derive(Clone, Debug, Serialize)]
pub struct Cycles {
    pub name: String,
    pub stops: Vec<f64>,
    /// K_xx/K_yy at the end [-].
    pub anisotropy: f64,
}

/// Duration of a cycle \[s\]. The walls have 50 K at its start, 70 K after a quarter, 30 K after three quarters.
pub const PERIOD: f64 = 8.0;
pub const COUNT: usize = 10;
const SEEDS: [u32; 3] = [21, 22, 23];
const CONDUCTIVITY: [&str; 2] = ["conductivity_xx", "conductivity_yy"];

pub fn job(mechanics: &str) -> SolverJob {
    let mut job = SolverJob::new("cycle", 1).grains(&format!("mechanics {mechanics};"));
    job.part = Part::Shipped;
    job.end = PERIOD * COUNT as f64;
    job
}

pub fn jobs() -> Vec<Job> {
    ["none", "equilibrium"].map(|mechanics| job(mechanics).into()).to_vec()
}

/// Reads the results of the solver and of DEM (mean of the packings).
pub fn read(settings: &Settings, records: &Records) -> Vec<Cycles> {
    let mut list = Vec::new();
    for (name, mechanics) in
        [("solver, cells keep their place", "none"), ("solver, grains move", "equilibrium")]
    {
        let record = settings.record(records, &job(mechanics).into());
        if let Some(run) = record.and_then(|record| record.run.as_ref()) {
            let start = start(&settings.place.checkout).map(|pressure| [0.0, pressure]);
            // Runs of an older solver have no row at the start.
            let rows = run.pressure.iter().copied().filter(|row| row[0] > 0.0);
            let series: Vec<[f64; 2]> = start.into_iter().chain(rows).collect();
            let [xx, yy] = CONDUCTIVITY.map(|quantity| sub_regions(run, quantity).iter().sum::<f64>());
            list.push(Cycles::new(name, &series, xx / yy));
        }
    }
    list.extend(elements(&settings.place.checkout));
    list
}

/// Mean of σ_xx and σ_yy in the case's initial stress [Pa]: "uniform (-3496 0 0 -1922 0 0)", tension positive.
fn start(checkout: &Path) -> Option<f64> {
    let text = read_text(&checkout.join("cases/cycle/0/stress")).ok()?;
    let (_, rest) = text.split_once("uniform (")?;
    let components: Vec<f64> = rest.split_whitespace().map_while(|word| word.parse().ok()).collect();
    Some(-0.5 * (components.first()? + components.get(3)?))
}

fn elements(checkout: &Path) -> Option<Cycles> {
    let reference = Reference::read(checkout, "cycle", &SEEDS).ok()?;
    // The inner region, because grains at the walls are packed more loosely, which matters in this small box.
    let pressure = statistics(&reference.series("pressure_inner"));
    let rows: Vec<[f64; 2]> =
        reference.times().iter().zip(pressure).map(|(&t, (mean, _))| [t, mean]).collect();
    let sum = |quantity| reference_sub_regions(&reference, quantity, false).iter().flatten().sum::<f64>();
    let [xx, yy] = CONDUCTIVITY.map(sum);
    Some(Cycles::new("1 502 discs, mean of three packings", &rows, xx / yy))
}

impl Cycles {
    /// Makes the results from a series of time [s] and pressure [Pa], and from K_xx/K_yy at its end.
    fn new(name: &str, series: &[[f64; 2]], anisotropy: f64) -> Self {
        let quarter = 0.25 * PERIOD;
        let start = at(series, 0.0);
        let stops = (0..=4 * COUNT).map(|k| at(series, quarter * k as f64) / start).collect();
        Self { name: name.to_string(), stops, anisotropy }
    }
}

/// Largest difference of the pressure, over that at the start, between a run of the solver and DEM [%].
pub fn worst(cycles: &[Cycles], name: &str) -> Option<f64> {
    let of = |part: &str| cycles.iter().find(|c| c.name.contains(part));
    let (run, discs) = (of(name)?, of("discs")?);
    let differences = run.stops.iter().zip(&discs.stops).map(|(a, b)| 100.0 * (a - b).abs());
    Some(differences.fold(0.0, f64::max))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_case_says_at_which_pressure_it_starts() {
        let checkout = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        assert_eq!(start(&checkout), Some(2709.0));
        let discs = elements(&checkout).expect("committed");
        assert_eq!(discs.stops.len(), 4 * COUNT + 1);
        // 1.348, 1.368 and 1.313 in the three packings
        assert!((discs.anisotropy - 1.343).abs() < 0.01, "{}", discs.anisotropy);
    }
}
