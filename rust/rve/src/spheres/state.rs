//! State files of spheres: one assembly as JSON, as those of discs ([`crate::state`]), with `dimension` 3. A state that is written and
//! read back continues bit for bit.
//!
//! The units are those of the assembly: SI, or diameters and E* for boxes that [`super::prepare()`] makes. A periodic box has `box` with
//! its corner and edges, and the velocity gradient; `walls` has the walls, if there are any. As i of a contact, wall k of the list is −1 − k.
//! The columns of the contacts are the friction history: tangential force on j and radius of the contact when it was stored.

use crate::state_file::{
    ANY, POSITIVE, SCHEMA, StateError, check_column, check_lengths, digest, is_allowed, read,
};
use msdd_spheres::state::{Friction, State};
use msdd_spheres::{Boundary, Cell, Material, Partner, Simulation, SmallCell, Sphere, Surface, Wall};
use serde::{Deserialize, Serialize};

/// Largest shift of an image.
const FARTHEST: u32 = 4000;
/// How far the square of the length of a unit vector may be from 1.
const UNIT: f64 = 1e-9;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    /// `msdd-state-1`.
    schema: String,
    /// 3.
    dimension: u32,
    /// The grains: its entries follow in a table of their own.
    material: Material,
    /// Of a box that repeats itself: its entries follow; absent between walls alone.
    #[serde(rename = "box", skip_serializing_if = "Option::is_none")]
    cell: Option<Box>,
    /// List of walls, each with `point`, `surface` (`flat` with `normal`, or `cylinder` with `axis`, `radius`, `growth`, `stretch`) and
    /// `velocity` [m, –, m/s].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    walls: Vec<Wall>,
    /// The grains: lists of equal length.
    particles: Particles,
    /// Contacts with friction: lists of equal length.
    #[serde(default)]
    contacts: Contacts,
    /// What else is required to go on.
    #[serde(default)]
    run: Run,
    /// SHA-256 over the values; take it out after editing a file by hand.
    #[serde(skip_serializing_if = "Option::is_none")]
    checksum: Option<String>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Box {
    /// A corner \[m\].
    origin: [f64; 3],
    /// The edges from it: the first along x, the second in the plane of x and y \[m\].
    edges: [[f64; 3]; 3],
    /// With which it deforms: row k has the derivatives of the k-th component of the velocity [1/s].
    #[serde(default)]
    velocity_gradient: [[f64; 3]; 3],
}

/// One list a component.
#[derive(Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Particles {
    /// Centre along x \[m\].
    x: Vec<f64>,
    /// Centre along y \[m\].
    y: Vec<f64>,
    /// Centre along z \[m\].
    z: Vec<f64>,
    /// Radius \[m\].
    radius: Vec<f64>,
    /// Mass \[kg\].
    mass: Vec<f64>,
    /// Velocity along x; in a box that deforms, relative to it [m/s].
    vx: Option<Vec<f64>>,
    /// Along y [m/s].
    vy: Option<Vec<f64>>,
    /// Along z [m/s].
    vz: Option<Vec<f64>>,
    /// Angular velocity about x [rad/s].
    wx: Option<Vec<f64>>,
    /// About y [rad/s].
    wy: Option<Vec<f64>>,
    /// About z [rad/s].
    wz: Option<Vec<f64>>,
    /// Temperature \[K\].
    temperature: Option<Vec<f64>>,
    /// Radius at strain 0; absent: the radius \[m\].
    reference_radius: Option<Vec<f64>>,
}

#[derive(Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Contacts {
    /// Number of the one grain, from 0, or a wall: −1 the first of the list, −2 the second, and so on.
    i: Vec<i64>,
    /// Number of the other grain.
    j: Vec<i64>,
    /// The contact is with the image of j moved by so many edges.
    shift: Vec<[i32; 3]>,
    /// Tangential force on j \[N\].
    tangential_force: Vec<[f64; 3]>,
    /// Radius of the contact when it was stored \[m\].
    contact_radius: Vec<f64>,
}

/// Absent in states from other programs: the assembly is then at zero strain.
#[derive(Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Run {
    /// Time \[s\].
    time: f64,
    /// Steps so far.
    steps: u64,
    /// Size of a step; absent: the largest stable one \[s\].
    time_step: Option<f64>,
    /// Strain of the radii since `reference_radius`.
    strain: f64,
    /// Its rate [1/s].
    strain_rate: f64,
    /// Drag on all grains [1/s].
    drag: f64,
    /// Gravity [m/s²].
    gravity: [f64; 3],
}

/// The state as JSON text, with a checksum over its values. Numbers are in the shortest form that reads back exactly.
///
/// # Errors
/// [`StateError::Json`].
pub fn to_file(simulation: &Simulation) -> Result<String, StateError> {
    let mut file = file(simulation.state());
    file.checksum = Some(digest(&file)?);
    Ok(serde_json::to_string(&file)?)
}

fn file(state: State) -> File {
    let column = |field: fn(&Sphere) -> f64| state.spheres.iter().map(field).collect::<Vec<f64>>();
    let particles = Particles {
        x: column(|s| s.position[0]),
        y: column(|s| s.position[1]),
        z: column(|s| s.position[2]),
        radius: column(|s| s.radius),
        mass: column(|s| s.mass),
        vx: Some(column(|s| s.velocity[0])),
        vy: Some(column(|s| s.velocity[1])),
        vz: Some(column(|s| s.velocity[2])),
        wx: Some(column(|s| s.angular_velocity[0])),
        wy: Some(column(|s| s.angular_velocity[1])),
        wz: Some(column(|s| s.angular_velocity[2])),
        temperature: Some(column(|s| s.temperature)),
        reference_radius: Some(column(|s| s.reference_radius)),
    };
    let mut contacts = Contacts::default();
    for Friction { i, j, shift, history: [x, y, z, radius] } in state.friction {
        contacts.i.push(match i {
            Partner::Sphere(i) => i as i64,
            Partner::Wall(wall) => -1 - wall as i64,
        });
        contacts.j.push(j as i64);
        contacts.shift.push(shift);
        contacts.tangential_force.push([x, y, z]);
        contacts.contact_radius.push(radius);
    }
    let walls = state.boundary.walls().to_vec();
    let cell = state.boundary.cell().map(|Cell { lattice, velocity_gradient }| Box {
        origin: lattice.origin,
        edges: lattice.edges,
        velocity_gradient: *velocity_gradient,
    });
    let run = Run {
        time: state.time,
        steps: state.steps,
        time_step: Some(state.time_step),
        strain: state.strain,
        strain_rate: state.strain_rate,
        drag: state.drag,
        gravity: state.gravity,
    };
    let (schema, material) = (SCHEMA.to_string(), state.material);
    File { schema, dimension: 3, material, cell, walls, particles, contacts, run, checksum: None }
}

/// Reads a state.
///
/// # Errors
/// [`StateError`] names what is wrong, the particle or contact, and the value.
pub fn from_json(text: &str) -> Result<Simulation, StateError> {
    let file: File = read(text, (3, "3, the state of spheres"), |file: &mut File| file.checksum.take())?;
    file.material.check()?;
    let spheres = spheres(&file.particles)?;
    let boundary = boundary(file.cell, file.walls)?;
    let friction = friction(&file.contacts, spheres.len(), &boundary)?;
    let run = &file.run;
    let numbers = [run.time, run.strain, run.strain_rate, run.drag];
    let numbers = numbers.iter().chain(&run.gravity).chain(&run.time_step);
    if !numbers.clone().all(|&number| is_allowed(number, ANY)) || run.drag < 0.0 || run.strain <= -1.0 {
        return Err(StateError::Run("needs numbers from -1e30 to 1e30, drag >= 0, strain > -1".to_string()));
    }
    let problem = |problem: SmallCell| StateError::Box(problem.to_string());
    let mut simulation = Simulation::new(file.material, spheres, boundary).map_err(problem)?;
    let time_step = match run.time_step {
        None => simulation.time_step,
        Some(step) if step > 0.0 => step,
        Some(step) => return Err(StateError::Run(format!("time_step = {step}, allowed: above 0"))),
    };
    for (contact, friction) in friction.into_iter().enumerate() {
        if !simulation.set_history(friction) {
            let problem = format!("{:?} and {} are not near each other", friction.i, friction.j);
            return Err(StateError::Contact { contact, problem });
        }
    }
    let state = State {
        gravity: run.gravity,
        drag: run.drag,
        time: run.time,
        time_step,
        steps: run.steps,
        strain: run.strain,
        strain_rate: run.strain_rate,
        ..simulation.state()
    };
    let simulation = Simulation::from_state(state).map_err(problem)?;
    simulation.check().map_err(|failure| StateError::Run(failure.to_string()))?;
    Ok(simulation)
}

fn spheres(columns: &Particles) -> Result<Vec<Sphere>, StateError> {
    let expected = columns.x.len();
    let zero = vec![0.0; expected];
    let or = |column: &Option<Vec<f64>>, usual: &Vec<f64>| column.clone().unwrap_or_else(|| usual.clone());
    let table: [(&'static str, Vec<f64>, &'static str); 13] = [
        ("x", columns.x.clone(), ANY),
        ("y", columns.y.clone(), ANY),
        ("z", columns.z.clone(), ANY),
        ("radius", columns.radius.clone(), POSITIVE),
        ("mass", columns.mass.clone(), POSITIVE),
        ("vx", or(&columns.vx, &zero), ANY),
        ("vy", or(&columns.vy, &zero), ANY),
        ("vz", or(&columns.vz, &zero), ANY),
        ("wx", or(&columns.wx, &zero), ANY),
        ("wy", or(&columns.wy, &zero), ANY),
        ("wz", or(&columns.wz, &zero), ANY),
        ("temperature", or(&columns.temperature, &zero), ANY),
        ("reference_radius", or(&columns.reference_radius, &columns.radius), POSITIVE),
    ];
    for (column, values, allowed) in &table {
        check_column(column, values, allowed, expected)?;
    }
    let sphere = |k: usize| {
        let [x, y, z, radius, mass, vx, vy, vz, wx, wy, wz, temperature, reference_radius] =
            table.each_ref().map(|(_, values, _)| values[k]);
        let mut sphere = Sphere::at_rest([x, y, z], radius, 1.0);
        sphere.mass = mass;
        sphere.velocity = [vx, vy, vz];
        sphere.angular_velocity = [wx, wy, wz];
        (sphere.temperature, sphere.reference_radius) = (temperature, reference_radius);
        sphere
    };
    Ok((0..expected).map(sphere).collect())
}

fn boundary(cell: Option<Box>, walls: Vec<Wall>) -> Result<Boundary, StateError> {
    walls.iter().enumerate().try_for_each(|(number, wall)| check_wall(number, wall))?;
    let Some(cell) = cell else { return Ok(Boundary::Walls(walls)) };
    let wrong = |problem: &str| Err(StateError::Box(problem.to_string()));
    let (edges, gradient) = (cell.edges, cell.velocity_gradient);
    let all = cell.origin.iter().chain(edges.iter().flatten()).chain(gradient.iter().flatten());
    if !all.clone().all(|&number| is_allowed(number, ANY)) {
        return wrong("numbers, allowed: -1e30 to 1e30");
    }
    let beyond = [(0, 1), (0, 2), (1, 2)];
    if beyond.iter().any(|&(a, b)| edges[a][b] != 0.0 || gradient[b][a] != 0.0) {
        return wrong("the first edge lies along x, the second in the plane of x and y, and they move so");
    }
    let lengths = [0, 1, 2].map(|k| edges[k][k]);
    if !lengths.iter().all(|&length| is_allowed(length, POSITIVE)) {
        return wrong("extents along x, y and z, allowed: 1e-30 to 1e30");
    }
    let mut periodic = Cell::block(lengths);
    (periodic.lattice.origin, periodic.lattice.edges) = (cell.origin, edges);
    periodic.velocity_gradient = gradient;
    Ok(if walls.is_empty() { Boundary::Periodic(periodic) } else { Boundary::Between(periodic, walls) })
}

fn check_wall(number: usize, wall: &Wall) -> Result<(), StateError> {
    let wrong = |problem: &str| Err(StateError::Box(format!("wall {number}: {problem}")));
    let (direction, radius, rates) = match wall.surface {
        Surface::Flat { normal } => (normal, 1.0, [0.0; 2]),
        Surface::Cylinder { axis, radius, growth, stretch } => (axis, radius, [growth, stretch]),
    };
    let mut all = wall.point.iter().chain(&wall.velocity).chain(&direction).chain(&rates);
    if !all.all(|&number| is_allowed(number, ANY)) {
        return wrong("numbers, allowed: -1e30 to 1e30");
    }
    if (direction.iter().map(|part| part * part).sum::<f64>() - 1.0).abs() > UNIT {
        return wrong("normal and axis, allowed: of length 1");
    }
    if !is_allowed(radius, POSITIVE) {
        return wrong("radius, allowed: 1e-30 to 1e30");
    }
    Ok(())
}

fn friction(columns: &Contacts, count: usize, boundary: &Boundary) -> Result<Vec<Friction>, StateError> {
    let expected = columns.i.len();
    let lengths = [
        ("contacts.j", columns.j.len()),
        ("contacts.shift", columns.shift.len()),
        ("contacts.tangential_force", columns.tangential_force.len()),
        ("contacts.contact_radius", columns.contact_radius.len()),
    ];
    check_lengths(lengths, expected)?;
    let walls = boundary.walls().len() as i64;
    let of = |contact: usize| {
        let problem = |problem: String| Err(StateError::Contact { contact, problem });
        let (i, j, shift) = (columns.i[contact], columns.j[contact], columns.shift[contact]);
        let count = count as i64;
        let periodic = boundary.cell().is_some();
        if !((-walls..count).contains(&i) && (0..count).contains(&j) && (i != j || shift != [0; 3])) {
            return problem(format!(
                "i = {i}, j = {j}, allowed: i from {}, both below {count}, different",
                -walls
            ));
        }
        if shift.iter().any(|&k| k != 0 && (!periodic || k.unsigned_abs() > FARTHEST)) {
            return problem(format!("shift = {shift:?}, allowed: 0, or up to {FARTHEST} in a periodic box"));
        }
        let ([x, y, z], radius) = (columns.tangential_force[contact], columns.contact_radius[contact]);
        if ![x, y, z, radius].iter().all(|&number| is_allowed(number, ANY)) {
            return problem("tangential_force and contact_radius, allowed: -1e30 to 1e30".to_string());
        }
        let i = usize::try_from(i).map_or(Partner::Wall((-1 - i) as usize), Partner::Sphere);
        Ok(Friction { i, j: j as usize, shift, history: [x, y, z, radius] })
    };
    (0..expected).map(of).collect()
}

#[cfg(test)]
#[path = "state_tests.rs"]
mod tests;
