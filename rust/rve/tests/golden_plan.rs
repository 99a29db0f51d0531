//! Guards the engine version: a change of the results of a plan requires that it be raised.

use msdd_rve::database::{ENGINE_VERSION, Plan, Recipe, Run, generate, read};
use std::ops::ControlFlow;
use std::path::Path;

const PLAN: &str = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 11\n\
    [[thermal]]\ndiscs = 40\nporosities = [0.12]\ncompressions = [\"horizontal\"]\nrepeats = 1\n\
    ramps = [\"up\", \"down\", \"up_down\"]\nstops = [0.01]\n\
    [[mechanics]]\ndiscs = 40\nporosities = [0.12]\ncompressions = [\"intermediate\"]\n\
    packing_friction_angles = [0.3]\nrepeats = 1\nramps = [\"yy\"]\nstops = [0.01]\n\
    [[mechanics]]\ndiscs = 40\nboundary = \"periodic\"\nporosities = [0.12]\ncompressions = [\"isotropic\"]\n\
    repeats = 1\nramps = [\"xy\"]\nstops = [0.01]\n\
    [[wall_shear]]\ndiscs = 40\nporosities = [0.12]\ncompressions = [\"isotropic\"]\nrepeats = 1\nstops = [0.001]\n\
    [[paths]]\ndiscs = 40\nporosities = [0.12]\ncompressions = [\"isotropic\"]\nrepeats = 1\n\
    paths = [\"mixed\"]\n";

/// Engine version, and pressure, conductivity and steps of each row of the plan with that version.
const GOLDEN: (i64, &str) = (
    4,
    "\
packed 0 5.50791e3 5.10991e-1 4110
up 1 6.10212e3 5.40583e-1 780
down 1 4.97810e3 4.83063e-1 1381
up_down 1 5.50789e3 5.10990e-1 1326
packed 0 4.23301e3 4.19895e-1 2556
yy -1 4.45601e3 4.30164e-1 862
yy 1 4.01035e3 4.09560e-1 1359
packed 0 2.62593e3 3.18822e-1 2897
xy -1 2.62289e3 3.17931e-1 1384
xy 1 2.60046e3 3.16389e-1 1384
packed 0 4.88252e3 4.80689e-1 3165
wall_shear 1 5.00578e3 4.88704e-1 1177
packed 0 3.79286e3 4.01141e-1 2942
mixed 10 3.53788e3 3.90593e-1 567
mixed 20 3.60383e3 3.98327e-1 826
mixed 30 3.98596e3 4.19268e-1 725
mixed 40 3.99744e3 4.13490e-1 368
mixed 50 3.77714e3 3.96514e-1 318
mixed 60 4.07569e3 4.17076e-1 368
mixed 70 3.66166e3 3.89487e-1 367
",
);

#[test]
fn other_results_need_another_engine_version() {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("golden.msdd");
    let _ = std::fs::remove_file(&path);
    generate(&Plan::parse(PLAN, "plan").unwrap(), &path, &Run::default(), |_| ControlFlow::Continue(()))
        .unwrap();
    let mut found = String::new();
    // Of the path every tenth row.
    for r in read(&path).unwrap().records.iter().filter(|r| !r.ramp.is_path() || r.stop % 10 == 0) {
        let (pressure, conductivity) = (r.pressure.unwrap(), r.conductivity_xx.unwrap());
        found += &format!("{} {} {pressure:.5e} {conductivity:.5e} {}\n", r.ramp, r.stop, r.steps);
    }
    assert!(
        (ENGINE_VERSION, found.as_str()) == GOLDEN,
        "version {ENGINE_VERSION} now gives\n{found}Where results changed on purpose, raise ENGINE_VERSION and put both here."
    );
}
