//! Compares packings with the model.

use super::*;
use crate::scenes_for_tests::disc;
use msdd_rve::database::{Plan, Recipe};

#[test]
fn porosities_are_those_of_the_plan_that_the_model_was_trained_with() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases/database/periodic.toml");
    let plan = Plan::parse(&std::fs::read_to_string(file).unwrap(), file).unwrap();
    let all = || plan.thermal.iter().flat_map(|block| block.porosities.iter().copied());
    assert_eq!(POROSITIES, [all().fold(1.0, f64::min), all().fold(0.0, f64::max)]);
}

#[test]
fn packed_boxes_are_what_the_model_expects_at_any_size_and_stiffness_and_meet_a_pressure() {
    let model = DiscModel::shipped().unwrap();
    for grains in [&disc(0), &disc(1)] {
        let packed = |compression, start| {
            let (discs, effort) =
                (Discs { grains, model: &model, compression }, Effort { boxes: 4, seed: 1, threads: 2 });
            (discs.expected(0.12), pack(discs, start, effort, &|_, _| ()).unwrap())
        };
        let (expected, packing) = packed(Compression::Horizontal, InitialPacking::Porosity(0.12));
        assert!((packing.porosity.mean - 0.12).abs() < 1e-3, "{packing:?}");
        let reduced = packing.pressure.mean / grains.stress_scale();
        assert!((reduced / expected - 1.0).abs() < 0.1, "{reduced} {expected}");
        assert!(packing.fabric_index.mean > 0.02 && packing.stress[0].mean > packing.stress[1].mean);
        let wanted = 0.05 * grains.stress_scale();
        let (_, packing) = packed(Compression::Isotropic, InitialPacking::Pressure(wanted));
        assert!((packing.pressure.mean / wanted - 1.0).abs() < PRESSURE_TOLERANCE, "{packing:?}");
        assert_eq!(packing.stress[0].mean, packing.stress[1].mean);
    }
}
