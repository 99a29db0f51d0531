//! Compares packings with the model, and tests what is refused.

use super::*;
use crate::grains::PRESETS;
use msdd_rve::database::plan::Plan;

const EFFORT: Effort = Effort { boxes: 4, seed: 1, threads: 2 };

fn discs<'a>(grains: &'a Grains, model: &'a DiscModel, compression: Compression) -> Discs<'a> {
    Discs { grains, model, compression }
}

#[test]
fn porosities_are_those_of_the_plan_that_the_model_was_trained_with() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases/database/periodic.toml");
    let plan = Plan::parse(&std::fs::read_to_string(file).unwrap(), file).unwrap();
    let all = || plan.thermal.iter().flat_map(|block| block.porosities.iter().copied());
    assert_eq!(POROSITIES, [all().fold(1.0, f64::min), all().fold(0.0, f64::max)]);
}

#[test]
fn packed_boxes_are_what_the_model_expects_at_any_size_and_stiffness() {
    let model = DiscModel::shipped().unwrap();
    for preset in &PRESETS[..2] {
        let discs = discs(&preset.grains, &model, Compression::Horizontal);
        let packing = pack(discs, Start::Porosity(0.12), EFFORT, &|_, _| ()).unwrap();
        assert!((packing.porosity.mean - 0.12).abs() < 1e-3, "{packing:?}");
        let reduced = packing.pressure.mean / preset.grains.stress_scale();
        let expected = discs.expected(0.12);
        assert!((reduced / expected - 1.0).abs() < 0.1, "{}: {reduced} {expected}", preset.name);
        assert!(packing.fabric_index.mean > 0.02 && packing.stress[0].mean > packing.stress[1].mean);
    }
}

#[test]
fn a_pressure_is_met_and_one_that_no_packing_has_is_refused_with_the_range() {
    let grains = PRESETS[1].grains;
    let wanted = 0.05 * grains.stress_scale();
    let model = DiscModel::shipped().unwrap();
    let discs = discs(&grains, &model, Compression::Isotropic);
    let packing = pack(discs, Start::Pressure(wanted), EFFORT, &|_, _| ()).unwrap();
    assert!((packing.pressure.mean / wanted - 1.0).abs() < PRESSURE_TOLERANCE, "{packing:?}");
    assert_eq!(packing.stress[0].mean, packing.stress[1].mean);
    let refused = |start| check(discs, start).unwrap_err().to_string();
    let error = refused(Start::Pressure(1e3));
    assert!(
        error.starts_with("pressure = 1000 Pa, allowed: 1.5") && error.contains("youngModulus"),
        "{error}"
    );
    assert!(refused(Start::Porosity(0.4)).starts_with("porosity = 0.4, allowed: 0.06 to 0.19"));
    assert!(refused(Start::Porosity(f64::NAN)).contains("allowed: 0.06 to 0.19"));
}

/// Grains of less friction reach a pressure at a lower porosity.
#[test]
fn the_start_is_packed_with_the_friction_of_the_model() {
    let grains = PRESETS[1].grains;
    let shipped = DiscModel::shipped().unwrap();
    let file = std::env::temp_dir().join(format!("msdd-smooth-{}.json", std::process::id()));
    let text = shipped.law().to_json().replace("\"friction_angle\": 0.5", "\"friction_angle\": 0.1");
    msdd_files::write(&file, text.as_bytes()).unwrap();
    let smooth = DiscModel::read(&file).unwrap();
    std::fs::remove_file(&file).unwrap();
    let wanted = Start::Pressure(0.05 * grains.stress_scale());
    let of = |model: &DiscModel| {
        pack(discs(&grains, model, Compression::Isotropic), wanted, EFFORT, &|_, _| ()).unwrap().porosity.mean
    };
    let (rough, slippery) = (of(&shipped), of(&smooth));
    assert!(slippery < rough - 0.005, "{slippery} {rough}");
}
