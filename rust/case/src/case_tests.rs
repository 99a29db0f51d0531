//! Tests of reading patches and boxes: what is read, and what is refused with which message.

use super::*;

#[test]
fn grains_need_every_key_and_no_other() {
    let full =
        "density 3000; youngModulus 1e+07; thermalConductivity 100; heatCapacity 1; thermalExpansion 0;
                meanRadius 0.005; bulkDensity paper;";
    let read = |text: &str| {
        let text = format!("{text} surrogate {{ type onlineRve; onlineRveCoeffs {{ frictionAngle 0.3; }} }}");
        let file = Dictionary::parse(Path::new("constant/granularProperties"), &text).unwrap();
        let model = ModelGrains::of(Path::new("."), &file).unwrap();
        read_grains(&file, &model).map_err(|error| error.to_string())
    };
    let (material, thermal, mean_radius) = read(full).unwrap();
    assert_eq!((material, mean_radius), (Material { friction_angle: 0.3, ..Material::default() }, 0.005));
    assert_eq!(thermal, Thermal { expansion: 0.0, ..Thermal::default() });
    let error = read(&full.replace("density 3000", "density -1")).unwrap_err();
    assert_eq!(error, "constant/granularProperties: density = -1, allowed: > 0");
    let error = read(&format!("{full} frictionAngel 0.5;")).unwrap_err();
    assert!(error.contains("frictionAngel = 0.5, allowed: the keys density, youngModulus"), "{error}");
    assert!(read(&full.replace("heatCapacity 1;", "")).unwrap_err().contains("heatCapacity = missing"));
}

#[test]
fn box_from_the_vertices() {
    let bounds_of = |vertices: &str| {
        let text = format!("scale 0.001; vertices ( {vertices} );");
        bounds(&Dictionary::parse(Path::new("system/blockMeshDict"), &text).unwrap())
    };
    let plane = |z: f64| format!("( 1 2 {z} ) ( 11 2 {z} ) ( 11 5 {z} ) ( 1 5 {z} )");
    let (low, high) = bounds_of(&format!("{} {}", plane(0.0), plane(10.0))).unwrap();
    assert_eq!((low, high), ([0.001, 0.002], [0.011, 0.005]));
    let skew = plane(0.0).replace("( 11 5", "( 12 5");
    assert!(bounds_of(&format!("{skew} {}", plane(10.0))).is_err());
    assert!(bounds_of(&plane(0.0)).is_err());
}
