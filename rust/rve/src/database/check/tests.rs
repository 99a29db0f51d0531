use super::*;
use crate::database::plan::RampName;
use crate::database::{Plan, Recipe, Record, Run, generate, read};
use std::ops::ControlFlow;
use std::sync::OnceLock;

const PLAN: &str = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 3\n\
    [[thermal]]\ndiscs = 40\nporosities = [0.12, 0.13]\ncompressions = [\"isotropic\"]\nrepeats = 8\nstops = [0.01]\n\
    [[mechanics]]\ndiscs = 60\nporosities = [0.13]\ncompressions = [\"horizontal\"]\nrepeats = 1\nstops = [0.01]\n";

const PATHS: &str = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 3\n\
    [[paths]]\ndiscs = 40\nporosities = [0.12, 0.13]\ncompressions = [\"isotropic\"]\nrepeats = 1\n\
    paths = [\"equivalence\", \"uniaxial\"]\nprobes = [1e-3]\nprobe_every = 50\n";

fn dataset() -> Dataset {
    static MADE: OnceLock<Dataset> = OnceLock::new();
    MADE.get_or_init(|| made(PLAN, "ramps")).clone()
}

fn paths() -> Dataset {
    static MADE: OnceLock<Dataset> = OnceLock::new();
    MADE.get_or_init(|| made(PATHS, "paths")).clone()
}

fn made(plan: &str, name: &str) -> Dataset {
    let path = std::env::temp_dir().join(format!("msdd-check-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&path);
    generate(&Plan::parse(plan, "plan").unwrap(), &path, &Run::default(), |_| ControlFlow::Continue(()))
        .unwrap();
    let dataset = read(&path).unwrap();
    std::fs::remove_dir_all(&path).unwrap();
    dataset
}

#[test]
fn a_generated_database_is_sound() {
    let report = check(&dataset());
    assert_eq!(report.violations, []);
    assert!(report.symmetry.iter().all(|mean| mean.packings == 16 && mean.count == 40));
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

/// The row of the second packing with this name.
fn of_path(dataset: &mut Dataset, ramp: RampName, stop: i64) -> &mut Record {
    let found = |r: &&mut Record| (r.packing, r.ramp, r.stop) == (1, ramp, stop);
    dataset.records.iter_mut().find(found).expect("a row of the plan")
}

#[test]
fn every_broken_law_of_paths_is_found_and_its_row_named() {
    assert_eq!(check(&paths()).violations, []);
    assert_eq!(paths().records.len(), 2 * (1 + 6 + 12 + 65 + 6));
    type Damage = fn(&mut Record);
    let uniaxial = RampName::Uniaxial;
    let cases: [(&str, RampName, i64, Damage); 14] = [
        ("the mean radius follows", uniaxial, 5, |r| scale(&mut r.mean_radius, 1e-8)),
        ("the solid fraction follows", uniaxial, 5, |r| scale(&mut r.porosity_sum_of_areas, 1e-7)),
        ("strains add up", uniaxial, 5, |r| r.strain_xy += 1e-8),
        ("no increment, no change", uniaxial, 5, |r| scale(&mut r.mean_radius, 1e-13)),
        ("the increment is the plan's", uniaxial, 5, |r| add(&mut r.step_yy, 1e-7)),
        ("the increment is the plan's", uniaxial, 5, |r| add(&mut r.step_xx, 1e-7)),
        ("the increment is the plan's", uniaxial, 5, |r| r.from_stop = Some(3)),
        ("the increment is the plan's", uniaxial, 5, |r| r.probe = Some(1)),
        ("a row of a path has its increment", uniaxial, 5, |r| r.probe = Some(2)),
        ("a row of a path has its increment", uniaxial, 5, |r| r.step_thermal = None),
        ("a state has all averages", uniaxial, 5, |r| r.fabric_xy = None),
        ("F is positive", uniaxial, 5, |r| r.fabric_xy = Some(0.6)),
        ("only rows of paths have an increment", RampName::Packed, 0, |r| r.step_xy = Some(0.0)),
        // The damaged row is the thermal one of a pair.
        ("twins have one solid fraction", RampName::Equivalence, 7, |r| {
            scale(&mut r.porosity_sum_of_areas, 1e-7);
        }),
    ];
    for (law, ramp, stop, damage) in cases {
        let mut damaged = paths();
        damage(of_path(&mut damaged, ramp, stop));
        let violations = check(&damaged).violations;
        let row = format!("packing 1, ramp {ramp}, stop {stop}");
        assert!(violations.iter().any(|v| v.law == law && v.row == row), "{law}: {violations:?}");
    }
}

#[test]
fn gaps_and_states_without_load_on_a_path_are_found() {
    let mut damaged = paths();
    damaged.records.retain(|r| (r.packing, r.ramp, r.stop) != (1, RampName::Uniaxial, 5));
    let violations = check(&damaged).violations;
    assert!(violations.iter().any(|v| v.law == "an increment starts from a row"), "{violations:?}");
    let mut damaged = paths();
    of_path(&mut damaged, RampName::Uniaxial, 5).outcome = "unjammed".to_string();
    let violations = check(&damaged).violations;
    let named = violations.iter().any(|v| {
        v.law == "a path ends where no load is borne" && v.row == "packing 1, ramp uniaxial, stop 6"
    });
    assert!(named, "{violations:?}");
}

/// One pair that is far off is found, and so are many that are a little off.
#[test]
fn twins_that_differ_are_found() {
    type Quantity = fn(&mut Record) -> &mut Option<f64>;
    let cases: [(&str, Quantity, f64); 4] = [
        ("twins have one porosity", |r| &mut r.porosity, 1e-3),
        ("twins have one reduced stress", |r| &mut r.stress_yy_reduced, 0.05),
        ("twins have one fabric", |r| &mut r.fabric_xy, 0.01),
        ("twins have one K", |r| &mut r.conductivity_network_xx, 3e-3),
    ];
    for (law, quantity, little) in cases {
        let mut one = paths();
        add(quantity(of_path(&mut one, RampName::Equivalence, 7)), 0.2);
        let named = |v: &Violation| v.law == law && v.row == "packing 1, ramp equivalence, stop 7";
        assert!(check(&one).violations.iter().any(named), "{law}: {:?}", check(&one).violations);
        let mut all = paths();
        let thermal = |r: &&mut Record| r.ramp == RampName::Equivalence && r.step_thermal != Some(0.0);
        for record in all.records.iter_mut().filter(thermal) {
            add(quantity(record), little);
        }
        let median = |v: &Violation| v.law == law && v.row.contains("pairs of equivalence");
        assert!(check(&all).violations.iter().any(median), "{law}: {:?}", check(&all).violations);
    }
}

fn add(value: &mut Option<f64>, more: f64) {
    *value = value.map(|v| v + more);
}

fn scale(value: &mut Option<f64>, relative: f64) {
    *value = value.map(|v| v * (1.0 + relative));
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
    assert!(violations.iter().any(|v| v.law == "axes are equal" && v.found.contains("fabric_index")));
}
