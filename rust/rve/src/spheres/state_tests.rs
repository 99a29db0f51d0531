use super::*;
use crate::spheres::material;
use serde_json::{Value, json};

/// Spheres that overlap, move and turn, without order.
fn some(boundary: Boundary) -> Simulation {
    let material = material(0.25, 0.3, 0.3);
    let spheres = (0..64usize).map(|k| {
        let u = |a: f64| (a * (k + 1) as f64).fract() - 0.5;
        let place = [k % 4, k / 4 % 4, k / 16];
        let shift = [u(0.618_034), u(0.414_214), u(0.732_051)];
        let position = std::array::from_fn(|m| 0.97 * (place[m] as f64 + 0.5) + 0.03 * shift[m]);
        let mut sphere = Sphere::at_rest(position, 0.5, material.density);
        sphere.velocity = [1e-3 * u(0.324_718), 1e-3 * u(0.287_9), 1e-3 * u(0.193_7)];
        sphere.angular_velocity = [1e-3 * u(0.154_3), 0.0, 1e-3];
        sphere
    });
    let mut simulation = Simulation::new(material.clone(), spheres.collect(), boundary).unwrap();
    simulation.gravity = [0.0, 0.0, -1e-6];
    simulation.run(200).unwrap();
    simulation
}

fn all() -> [Simulation; 3] {
    let mut cell = Cell::block([3.88; 3]);
    cell.lattice.edges[1][0] = 0.1;
    cell.velocity_gradient = [[-1e-5, 2e-5, 0.0], [0.0; 3], [0.0; 3]];
    let round = Wall::cylinder([1.94, 1.94, 0.0], [0.0, 0.0, 1.0], 2.7);
    let mut tall = Cell::block([3.88; 3]);
    tall.lattice.edges[2][2] = 40.0;
    let plates =
        [Wall::at_rest([0.0; 3], [0.0, 0.0, 1.0]), Wall::at_rest([0.0, 0.0, 3.88], [0.0, 0.0, -1.0])];
    [
        Boundary::Periodic(cell),
        Boundary::Walls([&Wall::block([3.88; 3])[..], &[round]].concat()),
        Boundary::Between(tall, plates.to_vec()),
    ]
    .map(some)
}

#[test]
fn a_state_goes_on_bit_for_bit() {
    for mut whole in all() {
        let text = to_file(&whole).unwrap();
        let mut read = from_json(&text).unwrap();
        assert_eq!(to_file(&read).unwrap(), text);
        assert!(read.state().friction.len() > 50);
        whole.run(300).unwrap();
        read.run(300).unwrap();
        assert_eq!(read.state(), whole.state());
    }
}

/// Without checksum, and with one entry replaced.
fn changed(simulation: &Simulation, pointer: &str, value: Value) -> String {
    let mut file: Value = serde_json::from_str(&to_file(simulation).unwrap()).unwrap();
    file.as_object_mut().unwrap().remove("checksum");
    *file.pointer_mut(pointer).unwrap() = value;
    file.to_string()
}

#[test]
fn what_makes_no_sense_is_refused_by_name() {
    let [periodic, walls, _] = all();
    let text = to_file(&periodic).unwrap();
    let damaged = text.replacen("\"steps\":200", "\"steps\":201", 1);
    let cases = [
        (damaged, "checksum = "),
        (changed(&periodic, "/dimension", json!(4)), "dimension = 4, allowed: 2 for discs, 3 for spheres"),
        (changed(&periodic, "/dimension", json!(2)), "dimension = 2, allowed: 3, the state of spheres"),
        (changed(&periodic, "/schema", json!("other")), "schema: 'other', allowed: 'msdd-state-1'"),
        (
            changed(&periodic, "/particles/radius/7", json!(-1.0)),
            "particle 7: radius = -1, allowed: 1e-30 to 1e30",
        ),
        (changed(&periodic, "/particles/x/3", json!(1e31)), "particle 3: x = 1e31"),
        (changed(&periodic, "/particles/wz", json!([0.0])), "wz has 1 values, x has 64"),
        (changed(&periodic, "/material/friction", json!(-0.1)), "material: friction = -0.1"),
        (changed(&periodic, "/box/edges/0/1", json!(0.1)), "box: the first edge lies along x"),
        (changed(&periodic, "/box/edges/2/2", json!(0.0)), "box: extents along x, y and z, allowed: 1e-30"),
        (changed(&periodic, "/box/edges/2/2", json!(1.5)), "box: periodic box: height over face 2 = 1.5 m"),
        (changed(&periodic, "/contacts/j/0", json!(64)), "contact 0: i = "),
        (changed(&periodic, "/contacts/shift/0", json!([5, 0, 0])), "are not near each other"),
        (changed(&periodic, "/contacts/i", json!([])), "contacts.j has "),
        (changed(&periodic, "/run/time_step", json!(0.0)), "run: time_step = 0, allowed: above 0"),
        (changed(&periodic, "/run/drag", json!(-1.0)), "run: needs numbers"),
        (
            changed(&walls, "/walls/0/surface/flat/normal", json!([2.0, 0.0, 0.0])),
            "box: wall 0: normal and axis",
        ),
        (changed(&walls, "/walls/6/surface/cylinder/radius", json!(0.0)), "box: wall 6: radius, allowed"),
        (changed(&walls, "/particles/radius/0", json!(2.0)), "spheres 0 and 1 overlap by"),
    ];
    for (text, reason) in cases {
        let error = from_json(&text).err().map(|error| error.to_string()).unwrap_or_default();
        assert!(error.contains(reason), "{reason}: {error}");
    }
    let error = crate::state::from_json(&text).err().map(|error| error.to_string());
    assert_eq!(error.as_deref(), Some("dimension = 3, allowed: 2, the state of discs"));
}
