//! State files: exact continuation, states of other programs, refusal of values that make no sense.

use msdd_rve::state::{from_json, to_file, to_json};
use msdd_rve::{Compression, Material, PackingSpec, RegionKind, Simulation, homogenise, pack};

fn packed() -> Simulation {
    let spec = PackingSpec {
        discs: 80,
        seed: 11,
        porosity: 0.14,
        compression: Compression::Horizontal,
        ..PackingSpec::default()
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

/// A changed digit is detected, a file without checksum is accepted, and the layout of the file does not matter.
#[test]
fn a_wrong_checksum_is_refused_and_none_is_allowed() {
    let packed = packed();
    let text = to_file(&packed).unwrap();
    assert_eq!(to_json(&from_json(&text).unwrap()).unwrap(), to_json(&packed).unwrap());
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    from_json(&serde_json::to_string_pretty(&json).unwrap()).unwrap();
    let mut edited = json.clone();
    edited["particles"]["vx"][3] = 0.25.into();
    let error = from_json(&edited.to_string()).err().unwrap().to_string();
    assert!(error.contains("the file is damaged, or was edited"), "{error}");
    edited.as_object_mut().unwrap().remove("checksum");
    assert_eq!(from_json(&edited.to_string()).unwrap().discs[3].vx, 0.25);
    for (at, byte) in text.bytes().enumerate().filter(|(_, byte)| byte.is_ascii_digit()).step_by(97) {
        let mut flipped = text.clone().into_bytes();
        flipped[at] = byte ^ 1;
        let flipped = String::from_utf8(flipped).unwrap();
        let same = |state: Simulation| to_json(&state).unwrap() == to_json(&packed).unwrap();
        assert!(from_json(&flipped).map_or(true, same), "the digit at {at}");
    }
}

#[test]
fn messages_are_short() {
    let text = to_json(&packed()).unwrap();
    let mut json: serde_json::Value = serde_json::from_str(&text).unwrap();
    json["particles"]["x"][2] = 1e300.into();
    let error = from_json(&json.to_string()).err().unwrap().to_string();
    assert!(error.contains("x = 1e300,"), "{error}");
    json["x".repeat(1_000_000)] = 1.into();
    let error = from_json(&json.to_string()).err().unwrap().to_string();
    assert!(error.len() < 600 && error.contains("characters left out"), "{}", error.len());
}
