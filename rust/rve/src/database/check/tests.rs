use super::*;
use crate::database::plan::RampName;
use crate::database::{Plan, Run, generate, read};
use std::ops::ControlFlow;
use std::sync::OnceLock;

const PLAN: &str = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 3\n\
    [[thermal]]\ndiscs = 40\nporosities = [0.12, 0.13]\ncompressions = [\"isotropic\"]\nrepeats = 8\nstops = [0.01]\n\
    [[mechanics]]\ndiscs = 60\nporosities = [0.13]\ncompressions = [\"horizontal\"]\nrepeats = 1\nstops = [0.01]\n";

fn dataset() -> Dataset {
    static MADE: OnceLock<Dataset> = OnceLock::new();
    let make = || {
        let path = std::env::temp_dir().join(format!("msdd-check-{}.msdd", std::process::id()));
        let _ = std::fs::remove_file(&path);
        generate(&Plan::parse(PLAN, "plan").unwrap(), &path, &Run::default(), |_| ControlFlow::Continue(()))
            .unwrap();
        let dataset = read(&path).unwrap();
        std::fs::remove_file(&path).unwrap();
        dataset
    };
    MADE.get_or_init(make).clone()
}

#[test]
fn a_generated_database_is_sound_and_its_noise_is_measured() {
    let report = check(&dataset());
    assert_eq!(report.violations, []);
    assert_eq!(report.rows, 16 * 3 + 5);
    assert!(report.symmetry.iter().all(|mean| mean.packings == 16 && mean.discs == 40));
    let pressure = report.noise.iter().find(|noise| noise.output == "stress_xx_reduced").unwrap();
    assert!(pressure.states == 48 && pressure.share > 0.05 && pressure.share < 1.5, "{pressure:?}");
}

#[test]
fn every_broken_law_is_found_and_its_row_named() {
    type Damage = fn(&mut Dataset);
    let cases: [(&str, &str, Damage); 9] = [
        ("mass", "packing 0, ramp up, stop 1", |d| d.records[1].strain += 1e-8),
        ("mass", "packing 16, ramp xx, stop -1", |d| d.records[49].strain_xx += 1e-8),
        ("trace of F is 1", "packing 0, ramp packed, stop 0", |d| shift(&mut d.records[0].fabric_xx)),
        ("f_K = (K_xx - K_yy)/(K_xx + K_yy)", "packing 0, ramp down, stop 1", |d| {
            shift(&mut d.records[2].fabric_conductivity);
        }),
        ("p = (sigma_xx + sigma_yy)/2", "packing 0, ramp up, stop 1", |d| shift(&mut d.records[1].pressure)),
        ("K is positive", "packing 0, ramp up, stop 1", |d| d.records[1].conductivity_xy = Some(10.0)),
        ("a state has all averages", "packing 0, ramp up, stop 1", |d| d.records[1].stress_xx = None),
        ("every row of the plan", "packing 0, ramp up, stop 1", |d| drop(d.records.remove(1))),
        ("the seed is the plan's", "packing 0, ramp up, stop 1", |d| d.records[1].seed += 1),
    ];
    for (law, row, damage) in cases {
        let mut damaged = dataset();
        damage(&mut damaged);
        let violations = check(&damaged).violations;
        assert!(violations.iter().any(|v| v.law == law && v.row == row), "{law}: {violations:?}");
    }
}

fn shift(value: &mut Option<f64>) {
    *value = value.map(|v| v * (1.0 + 1e-6) + 1e-6);
}

#[test]
fn a_preferred_direction_is_found() {
    let mut skewed = dataset();
    for record in skewed.records.iter_mut().filter(|r| r.ramp == RampName::Packed && r.discs == 40) {
        record.fabric_index = record.fabric_index.map(|f| f + 0.5);
    }
    let violations = check(&skewed).violations;
    assert!(violations.iter().any(|v| v.law == "x and y are alike" && v.found.contains("fabric_index")));
}
