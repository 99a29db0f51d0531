//! Compares packings with the model, and tests what is refused.

use super::*;
use crate::grains::PRESETS;
use msdd_rve::database::plan::Plan;

const EFFORT: Effort = Effort { boxes: 4, seed: 1, threads: 2 };

#[test]
fn porosities_are_those_of_the_plan_that_the_model_was_trained_with() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases/database/periodic.toml");
    let plan = Plan::parse(&std::fs::read_to_string(file).unwrap(), file).unwrap();
    let all = || plan.thermal.iter().flat_map(|block| block.porosities.iter().copied());
    assert_eq!(POROSITIES, [all().fold(1.0, f64::min), all().fold(0.0, f64::max)]);
}

#[test]
fn packed_boxes_are_what_the_model_expects_at_any_size_and_stiffness() {
    let model = msdd_surrogate::models::builtin("builtin").unwrap();
    for preset in &PRESETS[..2] {
        let packing =
            pack(&preset.grains, Start::Porosity(0.12), Compression::Horizontal, EFFORT, &|_, _| ()).unwrap();
        assert!((packing.porosity.mean - 0.12).abs() < 1e-3, "{packing:?}");
        let reduced = packing.pressure.mean / preset.grains.stress_scale();
        let expected = expected(model.as_ref(), 0.12, Compression::Horizontal);
        assert!((reduced / expected - 1.0).abs() < 0.1, "{}: {reduced} {expected}", preset.name);
        assert!(packing.fabric_index.mean > 0.02 && packing.stress[0].mean > packing.stress[1].mean);
    }
}

#[test]
fn a_pressure_is_met_and_one_that_no_packing_has_is_refused_with_the_range() {
    let grains = PRESETS[1].grains;
    let wanted = 0.05 * grains.stress_scale();
    let packing = pack(&grains, Start::Pressure(wanted), Compression::Isotropic, EFFORT, &|_, _| ()).unwrap();
    assert!((packing.pressure.mean / wanted - 1.0).abs() < PRESSURE_TOLERANCE, "{packing:?}");
    assert_eq!(packing.stress[0].mean, packing.stress[1].mean);
    let refused = |start| check(&grains, start, Compression::Isotropic).unwrap_err().to_string();
    let error = refused(Start::Pressure(1e3));
    assert!(
        error.starts_with("pressure = 1000 Pa, allowed: 1.5") && error.contains("youngModulus"),
        "{error}"
    );
    assert!(refused(Start::Porosity(0.4)).starts_with("porosity = 0.4, allowed: 0.06 to 0.19"));
    assert!(refused(Start::Porosity(f64::NAN)).contains("allowed: 0.06 to 0.19"));
}
