//! Tests of reading patches and boxes: what is read, and what is refused with which message.

use super::*;

#[test]
fn grains_need_every_key_and_no_other() {
    let full =
        "density 3000; youngModulus 1e+07; thermalConductivity 100; heatCapacity 1; thermalExpansion 0;
                meanRadius 0.005; bulkDensity paper; surrogate { type onlineRve; frictionAngle 0.3; }";
    let read = |from: &str, to: &str| {
        let file =
            Dictionary::parse(Path::new("constant/granularProperties"), &full.replace(from, to)).unwrap();
        let model = ModelGrains::of(Path::new("."), &file).unwrap();
        read_grains(&file, &model).map_err(|error| error.to_string())
    };
    let material = Material { friction_angle: 0.3, ..Material::default() };
    let thermal = Thermal { expansion: 0.0, ..Thermal::default() };
    assert_eq!(read("", "").unwrap(), (material, thermal, 0.005));
    for (from, to, message) in [
        ("density 3000", "density -1", "constant/granularProperties: density = -1, allowed: > 0"),
        ("bulkDensity", "bulkDensty", "bulkDensty = paper, allowed: the keys density, youngModulus"),
        ("heatCapacity 1;", "", "heatCapacity = missing"),
    ] {
        let error = read(from, to).unwrap_err();
        assert!(error.contains(message), "{error}");
    }
}

#[test]
fn box_from_the_vertices() {
    let plane = |z: f64| format!("( 1 2 {z} ) ( 11 2 {z} ) ( 11 5 {z} ) ( 1 5 {z} ) ");
    let bounds_of = |vertices: String| {
        let text = format!("scale 0.001; vertices ( {vertices} );");
        bounds(&Dictionary::parse(Path::new("system/blockMeshDict"), &text).unwrap()).ok()
    };
    let whole = plane(0.0) + &plane(10.0);
    assert_eq!(bounds_of(whole.clone()), Some(([0.001, 0.002], [0.011, 0.005])));
    assert_eq!([bounds_of(whole.replacen("( 11 5", "( 12 5", 1)), bounds_of(plane(0.0))], [None, None]);
}
