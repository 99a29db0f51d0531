//! State files: exact continuation, foreign states, refused nonsense.

use msdd_rve::state::{from_json, to_json};
use msdd_rve::{Boundary, Compression, Material, PackingSpec, RegionKind, Simulation, homogenise, pack};

fn packed() -> Simulation {
    let spec = PackingSpec {
        discs: 80,
        seed: 11,
        porosity: 0.14,
        compression: Compression::Horizontal,
        radius_min: 3e-3,
        radius_max: 7e-3,
        boundary: Boundary::Walls,
    };
    pack(&spec, &Material::default()).unwrap().simulation
}

#[test]
fn a_state_read_back_continues_bit_for_bit() {
    let mut original = packed();
    original.set_strain_rate(0.1);
    original.walls.normal_velocity = [0.01, 0.0, 0.0, -0.01];
    original.walls.tangential_velocity = [0.0, 0.0, 0.02, 0.0];
    original.run(150).unwrap();
    let mut copy = from_json(&to_json(&original).unwrap()).unwrap();
    for simulation in [&mut original, &mut copy] {
        simulation.run(700).unwrap();
    }
    assert_eq!(original.discs, copy.discs);
    assert_eq!(to_json(&original).unwrap(), to_json(&copy).unwrap());
}

#[test]
fn a_foreign_state_needs_no_velocities_and_may_swap_i_and_j() {
    let original = packed();
    let mut json: serde_json::Value = serde_json::from_str(&to_json(&original).unwrap()).unwrap();
    for key in ["vx", "vy", "angular_velocity", "temperature"] {
        json["particles"].as_object_mut().unwrap().remove(key);
    }
    json.as_object_mut().unwrap().remove("run");
    let (i, j) = (json["contacts"]["i"].clone(), json["contacts"]["j"].clone());
    let (mut new_i, mut new_j) = (i.clone(), j.clone());
    for k in (0..i.as_array().unwrap().len()).filter(|&k| i[k].as_i64().unwrap() >= 0) {
        new_i[k] = j[k].clone();
        new_j[k] = i[k].clone();
    }
    json["contacts"]["i"] = new_i;
    json["contacts"]["j"] = new_j;
    let foreign = from_json(&json.to_string()).unwrap();
    assert_eq!(homogenise(&foreign, RegionKind::Hull), homogenise(&original, RegionKind::Hull));
}

#[test]
fn nonsense_is_refused_with_particle_and_value() {
    let good: serde_json::Value = serde_json::from_str(&to_json(&packed()).unwrap()).unwrap();
    let message = |change: &dyn Fn(&mut serde_json::Value)| {
        let mut json = good.clone();
        change(&mut json);
        from_json(&json.to_string()).unwrap_err().to_string()
    };
    assert_eq!(message(&|j| j["schema"] = "other".into()), "schema: 'other', allowed: 'msdd-state-1'");
    assert!(message(&|j| j["particles"]["colour"] = 1.into()).contains("unknown field `colour`"));
    assert!(
        message(&|j| j["particles"]["x"][3] = 9.0.into()).starts_with("particle 3: x = 9, allowed: inside")
    );
    assert!(message(&|j| j["particles"]["radius"][2] = (-1.0).into()).contains("particle 2: radius = -1"));
    assert!(message(&|j| j["particles"]["x"][3] = serde_json::Value::Null).contains("not a state"));
    assert!(
        message(&|j| {
            j["particles"]["mass"].as_array_mut().unwrap().pop();
        })
        .contains("mass has 79 values, x has 80")
    );
    assert!(message(&|j| j["particles"]["radius"][0] = 0.05.into()).contains("overlap"));
    assert!(message(&|j| j["contacts"]["j"][0] = 80.into()).starts_with("contact 0: i = "));
    assert!(message(&|j| j["box"]["x_min"] = 1.0.into()).starts_with("box: "));
    assert!(message(&|j| j["material"]["density"] = 0.0.into()).contains("density = 0"));
}
