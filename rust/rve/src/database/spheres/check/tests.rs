use super::*;
use crate::database::spheres::kind::PathName;
use crate::database::{Recipe, Run, generate, read_spheres};
use std::ops::ControlFlow;
use std::sync::OnceLock;

const PLAN: &str = "seed = 3\n[[spheres]]\nspheres = 60\npacking_frictions = [0.3, 0.0]\ncompressions = [\"isotropic\"]\n\
    pressures = [1e-5, 1e-4]\nrepeats = 1\npaths = [\"equivalence\", \"uniaxial\", \"pressed\"]\nstep = 2e-3\n";

fn dataset() -> Dataset<SphereRecord> {
    static MADE: OnceLock<Dataset<SphereRecord>> = OnceLock::new();
    let make = || {
        let path = std::env::temp_dir().join(format!("msdd-check-spheres-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        let plan = SpherePlan::parse(PLAN, "plan").unwrap();
        generate(&plan, &path, &Run::default(), |_| ControlFlow::Continue(())).unwrap();
        let dataset = read_spheres(&path).unwrap();
        std::fs::remove_dir_all(&path).unwrap();
        dataset
    };
    MADE.get_or_init(make).clone()
}

#[test]
fn a_generated_database_is_sound() {
    let report = check(&dataset());
    assert_eq!(report.violations, []);
    let turned = report.twins.iter().find(|twin| twin.turned && twin.quantity == "stress").unwrap();
    let grown = report.twins.iter().find(|twin| !twin.turned && twin.quantity == "stress").unwrap();
    assert!(turned.pairs >= 12 && turned.median < 1e-10, "{turned:?}");
    assert!(grown.pairs >= 12 && grown.median < 3e-4, "{grown:?}");
}

/// The row of the second packing with this name.
fn of_path(dataset: &mut Dataset<SphereRecord>, path: PathName, stop: i64) -> &mut SphereRecord {
    let found = |r: &&mut SphereRecord| (r.packing, r.path, r.stop) == (1, path, stop);
    dataset.records.iter_mut().find(found).expect("a row of the plan")
}

#[test]
fn every_broken_law_is_found_and_its_row_named() {
    type Damage = fn(&mut SphereRecord);
    let (uniaxial, twins, packed) = (PathName::Uniaxial, PathName::Equivalence, PathName::Packed);
    let pressed = PathName::Pressed;
    let cases: [(&str, PathName, i64, Damage); 18] = [
        ("p = (sigma_xx + sigma_yy + sigma_zz)/3", uniaxial, 1, |r| scale(&mut r.pressure, 1.0 + 1e-7)),
        ("trace of F is 1", uniaxial, 1, |r| scale(&mut r.fabric_xx, 1.0 + 1e-7)),
        ("the solid fraction follows", uniaxial, 2, |r| scale(&mut r.solid_fraction, 1.0 + 1e-7)),
        ("rattlers are 0 to 1", packed, 0, |r| r.rattlers = Some(1.1)),
        ("contacts are among the neighbours", packed, 0, |r| scale(&mut r.neighbours, 0.5)),
        ("F is positive", uniaxial, 1, |r| r.fabric_xy = Some(0.5)),
        ("conductivity by contacts is positive", uniaxial, 1, |r| r.contact_conductivity_yz = Some(9.0)),
        ("more gas number, more conductivity", packed, 0, |r| r.gas_conductivity_6_0 = Some(1.0)),
        ("a state has all averages", uniaxial, 1, |r| r.stress_xz = None),
        ("a failure has a reason and no averages", uniaxial, 1, |r| r.failure = Some("lost".to_string())),
        ("a packed state has no strain", packed, 0, |r| r.strain_xy = 0.1),
        ("a row of a path has its increment", uniaxial, 1, |r| r.step_yz = None),
        ("the increment is the plan's", uniaxial, 1, |r| r.step_thermal = Some(1e-4)),
        ("strains add up", uniaxial, 2, |r| r.strain_zz += 1e-6),
        ("the increment is the plan's", pressed, 2, |r| r.step_thermal = Some(1e-4)),
        // Along any axis, also that along which the box yields.
        ("strains add up", pressed, 2, |r| [r.step_xx, r.step_yy, r.step_zz] = [Some(-1e-4); 3]),
        ("radii that grow are a box that shrinks", twins, 1, |r| scale(&mut r.contact_conductivity_xx, 1.2)),
        ("all directions are equal", twins, 3, |r| r.stress_xy = Some(1e-5)),
    ];
    for (law, path, stop, damage) in cases {
        let mut damaged = dataset();
        damage(of_path(&mut damaged, path, stop));
        let name = format!("packing 1, path {path}, stop {stop}");
        let violations = check(&damaged).violations;
        assert!(violations.iter().any(|v| v.law == law && v.row == name), "{law}: {violations:?}");
    }
}

fn scale(value: &mut Option<f64>, factor: f64) {
    *value = value.map(|value| factor * value);
}

/// A common shift of all packings is found in the mean, however small it is in each.
#[test]
fn a_preferred_direction_is_found() {
    let one = dataset().records[0].clone();
    let mut dataset = dataset();
    dataset.records = (0..20)
        .map(|k| {
            let off = 1e-3 + 1e-4 * f64::from(k % 3);
            let fabric = |off: f64| Some(1.0 / 3.0 + off);
            let mut record = one.clone();
            (record.fabric_xx, record.fabric_yy) = (fabric(off), fabric(-off));
            record
        })
        .collect();
    let violations = check(&dataset).violations;
    assert!(violations.iter().any(|v| v.law == "axes are equal" && v.found.contains("F: xx - yy")));
}
