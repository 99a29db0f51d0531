//! Tests of the files of a new case of spheres.

use super::*;
use crate::scenes_for_tests::{spheres, text, walls as walls_of};
use msdd_beds::case::{End, Flow, Shell};

#[test]
fn walls_and_stress_stand_where_the_solver_looks_for_them() {
    let insulated = walls_of(["insulated"; 6]).to_vec();
    let plates = SphereCase {
        shape: Shape::Box([0.3, 0.1, 0.2]),
        cells: vec![20, 1, 1],
        walls: insulated,
        probes: vec![vec![0.1; 3]],
        ..spheres()
    };
    let closed = SphereCase { lid: Lid::Stays, slack_layer: 1.0, gravity: 9.81, ..spheres() };
    let shell = Some(Shell { young_modulus: 2e11, thickness: 0.002, thermal_expansion: 1.2e-5 });
    let vessel = SphereCase { shell: shell.clone(), ..closed.clone() };
    let rough = SphereCase { wall_friction: 0.3, ..closed };
    let bare = SphereCase { wall_material: None, steady: true, ..spheres() };
    let rough_vessel = SphereCase { shell, lid: Lid::Presses, slack_layer: 0.0, ..rough.clone() };
    let still = SphereCase { mechanics: Mechanics::None, ..spheres() };
    let flow = Some(Flow { mass: 0.0072, temperature: 813.0, from: End::Bottom });
    let blown = SphereCase { flow, walls: walls_of(["insulated"; 3]).to_vec(), ..spheres() };
    const GRAINS: &str = "constant/granularProperties";
    for (scene, path, words, there) in [
        (&plates, "0/stress", "uniform (-16000 0 0 -16000 0 -20000);", true),
        (&spheres(), "0/stress", "uniform (-20000 0 0 -16000 0 -16000);", true),
        (&spheres(), GRAINS, "top      { type piston; pressure constant 20000; }", true),
        (&spheres(), GRAINS, "inner    { type frictionless; }", true),
        (&vessel, GRAINS, "top      { type frictionless; slackLayer 1; slackRecovery 0.1; }", true),
        (
            &vessel,
            GRAINS,
            "side     { type shell; youngModulus 2e11; thickness 0.002; radius 0.1; thermalExpansion 1.2e-5;",
            true,
        ),
        (&vessel, "constant/g", "value           (-9.81 0 0);", true),
        // With gravity its file stands instead of that of the stress.
        (&vessel, "0/stress", "uniform", false),
        (&vessel, GRAINS, "restStress", true),
        (&rough, GRAINS, "side     { type rigid; friction 0.154; slip 1.54e-6; }", true),
        (
            &rough,
            GRAINS,
            "bottom   { type rigid; friction 0.154; slip 1.54e-6; slackLayer 1; slackRecovery 0.1; }",
            true,
        ),
        (
            &rough,
            GRAINS,
            "top      { type rigid; friction 0.154; slip 1.54e-6; slackLayer 1; slackRecovery 0.1; }",
            true,
        ),
        (&rough, GRAINS, "inner    { type frictionless; }", true),
        (&rough, GRAINS, "restStress", true),
        (&rough, "constant/g", "value", true),
        (
            &still,
            "0/T",
            "type            granularWall;\n        mode            temperature;\n        temperature     400;",
            true,
        ),
        (
            &still,
            GRAINS,
            "wall { thermalConductivity 50; youngModulus 2.1e11; poissonRatio 0.3; roughness 3.4e-7; hardness 1.5e9; }",
            true,
        ),
        (&still, "system/controlDict", "libgranularThermo.so", true),
        (&bare, "0/T", "granularWall;", false),
        (&bare, "0/T", "type    fixedValue;\n        value   uniform 400;", true),
        (&bare, GRAINS, "wall {", false),
        (&bare, "system/fvSolution", "stopWhenSteady          1e-3;", true),
        (&rough, "0/stress", "uniform", false),
        (&rough_vessel, GRAINS, "fixedPoint (0 0 0); friction 0.154; slip 1.54e-6; }", true),
        (
            &rough_vessel,
            GRAINS,
            "type piston; pressure constant 20000; friction 0.154; slip 1.54e-6; }",
            true,
        ),
        (&still, GRAINS, "equilibriumCoeffs", false),
        (&still, GRAINS, "throughCoeffs", false),
        (&blown, GRAINS, "massFlow        0.0001;", true),
        (&blown, GRAINS, "inlet           { patch bottom; temperature 813; }", true),
        (&blown, "README.md", "| flow | 0.0072 kg/s of 813 K from bottom to top |", true),
    ] {
        let files =
            files(&SphereCase { heat_source: Some(3000.0), ..scene.clone() }, "bed", Path::new("/checkout"));
        let files = files.unwrap();
        assert_eq!(text(&files, path).contains(words), there, "{path}: {words}\n{}", text(&files, path));
    }
}
