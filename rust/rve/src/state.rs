//! State files: one assembly as JSON, SI units. A state that is written and read back continues bit for bit. States
//! from other programs (contacts given, velocities absent) are accepted; values that make no sense are refused with an
//! error that names particle and value.
//!
//! As i of a contact, the walls are −1 left, −2 right, −3 bottom, −4 top. n points from i to j (from the wall inwards),
//! t = (−n_y, n_x), the force on j is f_n n + f_t t.
//!
//! A periodic box has `periodic = true` and its shear offset s. It has no wall contacts, particles may lie outside of
//! it, and a contact is that of i with the image of j moved by shift_x (W, 0) + shift_y (s, H); absent shifts are zero.
//!
//! Files written by this program have a checksum over their values, which does not depend on the layout of the text. A
//! file without checksum is accepted, one with a wrong checksum is refused.
//!
//! `dimension` is 2, or absent, for discs; 3 for spheres, whose states are in [`crate::spheres::state`].

use crate::state_file::{ANY, LARGEST, POSITIVE, check_column, check_lengths, digest, read};
pub use crate::state_file::{SCHEMA, StateError, dimension};
use msdd_dem::failure::LARGEST_OVERLAP;
use msdd_dem::{Disc, Material, Periodic, RunState, Side, Simulation, Walls};
use serde::{Deserialize, Serialize};

/// Largest distance of a disc from its periodic box, in box lengths: farther away, its position would have lost digits.
const FARTHEST_CELL: f64 = 1000.0;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    /// `msdd-state-1`.
    schema: String,
    /// 2, or absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    dimension: Option<u32>,
    /// The grains, as in plans of databases.
    material: Material,
    /// The box: its entries follow.
    #[serde(rename = "box")]
    bounds: Bounds,
    /// The grains: lists of equal length.
    particles: Particles,
    /// The contacts: lists of equal length. Absent in states from other programs.
    #[serde(default)]
    contacts: Contacts,
    /// What else is required to go on. Absent in states from other programs: the assembly is then at rest and at zero strain.
    #[serde(skip_serializing_if = "Option::is_none")]
    run: Option<Run>,
    /// SHA-256 over the values; take it out after editing a file by hand.
    #[serde(skip_serializing_if = "Option::is_none")]
    checksum: Option<String>,
}

#[derive(Clone, Copy, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Bounds {
    /// Place of the left wall, or edge of the periodic box \[m\].
    x_min: f64,
    /// Of the right one \[m\].
    x_max: f64,
    /// Of the lower one \[m\].
    y_min: f64,
    /// Of the upper one \[m\].
    y_max: f64,
    /// Whether the box repeats itself without end; absent: no.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    periodic: bool,
    /// Of a periodic box: way of the top along x; absent: 0 \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    shear_offset: Option<f64>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Particles {
    /// Centre along x \[m\].
    x: Vec<f64>,
    /// Centre along y \[m\].
    y: Vec<f64>,
    /// Radius \[m\].
    radius: Vec<f64>,
    /// Mass \[kg\].
    mass: Vec<f64>,
    /// Velocity along x [m/s].
    vx: Option<Vec<f64>>,
    /// Velocity along y [m/s].
    vy: Option<Vec<f64>>,
    /// Rotation to the left [rad/s].
    angular_velocity: Option<Vec<f64>>,
    /// Temperature \[K\].
    temperature: Option<Vec<f64>>,
}

#[derive(Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Contacts {
    /// Number of the one grain, from 0, or a wall: −1 left, −2 right, −3 bottom, −4 top.
    i: Vec<i64>,
    /// Number of the other grain.
    j: Vec<i64>,
    /// Force on j along t = (−n_y, n_x), n from i to j \[N\].
    tangential_force: Vec<f64>,
    /// Of a periodic box: the contact is with the image of j moved by so many boxes along x; absent: 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    shift_x: Option<Vec<i32>>,
    /// The same along y.
    #[serde(skip_serializing_if = "Option::is_none")]
    shift_y: Option<Vec<i32>>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Run {
    /// Time \[s\].
    time: f64,
    /// Steps so far.
    steps: u64,
    /// Size of a step \[s\].
    time_step: f64,
    /// Strain of the radii since `reference_radius`.
    strain: f64,
    /// Its rate [1/s].
    strain_rate: f64,
    /// Drag on grains without contact [1/s].
    free_drag: f64,
    /// Radii at strain 0 \[m\].
    reference_radius: Vec<f64>,
    /// Velocity of the four walls across them [m/s].
    wall_normal_velocity: [f64; 4],
    /// The same along them [m/s].
    wall_tangential_velocity: [f64; 4],
    /// Of a periodic box [1/s].
    #[serde(skip_serializing_if = "Option::is_none")]
    shear_rate: Option<f64>,
}

/// The state as JSON text. Numbers are in the shortest form that reads back exactly.
///
/// # Errors
/// [`StateError::Json`].
pub fn to_json(simulation: &Simulation) -> Result<String, StateError> {
    Ok(serde_json::to_string(&file(simulation))?)
}

/// As [`to_json`], with a checksum over the values, for a file.
///
/// # Errors
/// [`StateError::Json`].
pub fn to_file(simulation: &Simulation) -> Result<String, StateError> {
    let mut file = file(simulation);
    file.checksum = Some(digest(&file)?);
    Ok(serde_json::to_string(&file)?)
}

fn file(simulation: &Simulation) -> File {
    let column = |field: fn(&Disc) -> f64| simulation.discs.iter().map(field).collect::<Vec<f64>>();
    let [x_min, x_max, y_min, y_max] = simulation.walls.position;
    let run = simulation.run_state();
    File {
        schema: SCHEMA.to_string(),
        dimension: None,
        material: simulation.material.clone(),
        bounds: Bounds {
            x_min,
            x_max,
            y_min,
            y_max,
            periodic: simulation.periodic.is_some(),
            shear_offset: simulation.periodic.map(|periodic| periodic.shear_offset),
        },
        particles: Particles {
            x: column(|d| d.x),
            y: column(|d| d.y),
            radius: column(|d| d.radius),
            mass: column(|d| d.mass),
            vx: Some(column(|d| d.vx)),
            vy: Some(column(|d| d.vy)),
            angular_velocity: Some(column(|d| d.angular_velocity)),
            temperature: Some(column(|d| d.temperature)),
        },
        contacts: contacts(simulation),
        run: Some(Run {
            time: run.time,
            steps: run.steps,
            time_step: run.time_step,
            strain: run.strain,
            strain_rate: run.strain_rate,
            free_drag: simulation.free_drag,
            reference_radius: run.reference_radius,
            wall_normal_velocity: simulation.walls.normal_velocity,
            wall_tangential_velocity: simulation.walls.tangential_velocity,
            shear_rate: simulation.periodic.map(|periodic| periodic.shear_rate),
        }),
        checksum: None,
    }
}

fn contacts(simulation: &Simulation) -> Contacts {
    let mut columns = Contacts::default();
    let (mut shift_x, mut shift_y) = (Vec::new(), Vec::new());
    simulation.for_each_contact(|contact| {
        columns.i.push(contact.i.map_or_else(|side| -1 - side as i64, |i| i as i64));
        columns.j.push(contact.j as i64);
        columns.tangential_force.push(contact.tangential_force);
        shift_x.push(contact.shift[0]);
        shift_y.push(contact.shift[1]);
    });
    if simulation.periodic.is_some() {
        (columns.shift_x, columns.shift_y) = (Some(shift_x), Some(shift_y));
    }
    columns
}

/// Reads a state. Without a `run` block the assembly is at zero strain, its walls are at rest, and discs without
/// contact feel the same drag as while an RVE is made.
///
/// # Errors
/// [`StateError`] names what is wrong, the particle or contact, and the value.
pub fn from_json(text: &str) -> Result<Simulation, StateError> {
    let file: File = read(text, (2, "2, the state of discs"), |file: &mut File| file.checksum.take())?;
    file.material.check()?;
    let walls = walls(file.bounds)?;
    let discs = discs(&file.particles)?;
    let mut simulation = match periodic(file.bounds)? {
        None => {
            check_inside(&discs, &walls)?;
            Simulation::new(file.material, discs, walls)
        }
        Some(periodic) => {
            check_near(&discs, &walls)?;
            Simulation::new_periodic(file.material, discs, walls, periodic)
                .map_err(|problem| StateError::Box(problem.to_string()))?
        }
    };
    check_overlaps(&simulation)?;
    simulation.free_drag = crate::pack::free_drag(&simulation);
    set_contacts(&mut simulation, &file.contacts)?;
    if let Some(run) = file.run {
        set_run(&mut simulation, run)?;
    }
    Ok(simulation)
}

fn walls(bounds: Bounds) -> Result<Walls, StateError> {
    let position = [bounds.x_min, bounds.x_max, bounds.y_min, bounds.y_max];
    let moderate = position.iter().all(|p| p.abs() <= LARGEST);
    if !(moderate && bounds.x_max > bounds.x_min && bounds.y_max > bounds.y_min) {
        let allowed = "x_min < x_max, y_min < y_max, from -1e30 to 1e30";
        return Err(StateError::Box(format!("{position:?}, allowed: {allowed}")));
    }
    Ok(Walls { position, ..Walls::around(1.0, 1.0) })
}

fn discs(columns: &Particles) -> Result<Vec<Disc>, StateError> {
    let expected = columns.x.len();
    let zero = vec![0.0; expected];
    let or_zero = |column: &Option<Vec<f64>>| column.clone().unwrap_or_else(|| zero.clone());
    let (any, positive) = (ANY, POSITIVE);
    let table: [(&'static str, Vec<f64>, &'static str); 8] = [
        ("x", columns.x.clone(), any),
        ("y", columns.y.clone(), any),
        ("radius", columns.radius.clone(), positive),
        ("mass", columns.mass.clone(), positive),
        ("vx", or_zero(&columns.vx), any),
        ("vy", or_zero(&columns.vy), any),
        ("angular_velocity", or_zero(&columns.angular_velocity), any),
        ("temperature", or_zero(&columns.temperature), any),
    ];
    for (column, values, allowed) in &table {
        check_column(column, values, allowed, expected)?;
    }
    let disc = |k: usize| {
        let [x, y, radius, mass, vx, vy, angular_velocity, temperature] =
            table.each_ref().map(|(_, values, _)| values[k]);
        Disc { x, y, radius, vx, vy, angular_velocity, mass, temperature }
    };
    Ok((0..expected).map(disc).collect())
}

/// Shear of a periodic box; none between walls.
fn periodic(bounds: Bounds) -> Result<Option<Periodic>, StateError> {
    let shear_offset = bounds.shear_offset.unwrap_or(0.0);
    if shear_offset.is_nan()
        || shear_offset.abs() > LARGEST
        || (bounds.shear_offset.is_some() && !bounds.periodic)
    {
        return Err(StateError::Box(format!(
            "shear_offset = {shear_offset}, allowed: -1e30 to 1e30, with periodic = true"
        )));
    }
    Ok(bounds.periodic.then_some(Periodic { shear_offset, shear_rate: 0.0 }))
}

/// Discs of a periodic box may drift out of it, but not far.
fn check_near(discs: &[Disc], walls: &Walls) -> Result<(), StateError> {
    let [left, right, bottom, top] = walls.position;
    let reach = FARTHEST_CELL * walls.width().max(walls.height());
    for (particle, disc) in discs.iter().enumerate() {
        let axes = [("x", disc.x, 0.5 * (left + right)), ("y", disc.y, 0.5 * (bottom + top))];
        if let Some((column, value, _)) = axes.into_iter().find(|(_, x, middle)| (x - middle).abs() > reach) {
            let allowed = "at most 1000 box lengths from the box";
            return Err(StateError::Particle { particle, column, value, allowed });
        }
    }
    Ok(())
}

/// Discs must have their centre in the box.
fn check_inside(discs: &[Disc], walls: &Walls) -> Result<(), StateError> {
    for (particle, disc) in discs.iter().enumerate() {
        let outside = Side::ALL.into_iter().find(|&side| walls.distance(side, disc.x, disc.y) <= 0.0);
        if let Some(side) = outside {
            let (column, value) = match side {
                Side::Left | Side::Right => ("x", disc.x),
                Side::Bottom | Side::Top => ("y", disc.y),
            };
            return Err(StateError::Particle { particle, column, value, allowed: "inside the box" });
        }
    }
    Ok(())
}

/// Discs must not overlap by more than the mean of their radii.
fn check_overlaps(simulation: &Simulation) -> Result<(), StateError> {
    let mut problem = None;
    simulation.for_each_contact(|contact| {
        if let Ok(i) = contact.i {
            let mean = 0.5 * (simulation.discs[i].radius + simulation.discs[contact.j].radius);
            if contact.overlap > LARGEST_OVERLAP * mean && problem.is_none() {
                problem = Some(StateError::Particle {
                    particle: contact.j,
                    column: "overlap",
                    value: contact.overlap,
                    allowed: "at most the mean of the two radii",
                });
            }
        }
    });
    problem.map_or(Ok(()), Err)
}

fn set_contacts(simulation: &mut Simulation, columns: &Contacts) -> Result<(), StateError> {
    let expected = columns.i.len();
    let lengths =
        [("contacts.j", columns.j.len()), ("contacts.tangential_force", columns.tangential_force.len())];
    check_lengths(lengths, expected)?;
    let shifts = shifts(columns, simulation.periodic.is_some())?;
    let count = simulation.discs.len() as i64;
    for (contact, shift) in shifts.into_iter().enumerate() {
        let (i, j, force) = (columns.i[contact], columns.j[contact], columns.tangential_force[contact]);
        let problem = |problem: String| StateError::Contact { contact, problem };
        let lowest = if simulation.periodic.is_some() { 0 } else { -4 };
        if !((lowest..count).contains(&i) && (0..count).contains(&j) && i != j) {
            return Err(problem(format!(
                "i = {i}, j = {j}, allowed: i from {lowest}, both below {count}, different"
            )));
        }
        if force.is_nan() || force.abs() > LARGEST {
            return Err(problem(format!("tangential_force = {force}, allowed: -1e30 to 1e30 N")));
        }
        let near = match usize::try_from(i) {
            Ok(i) => simulation.set_tangential_force_across(i, j as usize, shift, force),
            Err(_) => simulation.set_tangential_force(Err(Side::ALL[(-1 - i) as usize]), j as usize, force),
        };
        if !near {
            let across = if shift == [0, 0] { String::new() } else { format!(" moved by {shift:?} cells") };
            return Err(problem(format!("{i} and {j}{across} are not near each other")));
        }
    }
    Ok(())
}

/// Shift of j's image for each contact.
fn shifts(columns: &Contacts, periodic: bool) -> Result<Vec<[i32; 2]>, StateError> {
    let expected = columns.i.len();
    let mut shifts = vec![[0, 0]; expected];
    let given = [("contacts.shift_x", &columns.shift_x), ("contacts.shift_y", &columns.shift_y)];
    for (axis, (column, values)) in given.into_iter().enumerate() {
        let Some(values) = values else { continue };
        check_lengths([(column, values.len())], expected)?;
        for (contact, &value) in values.iter().enumerate() {
            // Discs and images are near the box (see `check_near`), so shifts are small.
            if value != 0 && (!periodic || value.unsigned_abs() > 4 * FARTHEST_CELL as u32) {
                let problem = format!("{column} = {value}, allowed: 0, or up to 4000 in a periodic box");
                return Err(StateError::Contact { contact, problem });
            }
            shifts[contact][axis] = value;
        }
    }
    Ok(shifts)
}

fn set_run(simulation: &mut Simulation, run: Run) -> Result<(), StateError> {
    let numbers = [run.time, run.time_step, run.strain, run.strain_rate, run.free_drag];
    let walls = run.wall_normal_velocity.iter().chain(&run.wall_tangential_velocity);
    let all = numbers.iter().chain(walls).chain(&run.reference_radius);
    let wrong = |problem: &str| Err(StateError::Run(problem.to_string()));
    if run.reference_radius.len() != simulation.discs.len()
        || all.clone().any(|v| v.is_nan() || v.abs() > LARGEST)
    {
        return wrong("needs numbers from -1e30 to 1e30 and one reference radius a particle");
    }
    if !(run.time_step > 0.0 && run.free_drag >= 0.0 && run.reference_radius.iter().all(|&r| r > 0.0)) {
        return wrong("time_step and reference_radius must be > 0, free_drag >= 0");
    }
    let shear_rate = run.shear_rate.unwrap_or(0.0);
    match &mut simulation.periodic {
        Some(periodic) if shear_rate.abs() <= LARGEST => periodic.shear_rate = shear_rate,
        None if run.shear_rate.is_none() => (),
        _ => {
            return wrong(&format!("shear_rate = {shear_rate}, allowed: -1e30 to 1e30, in a periodic box"));
        }
    }
    simulation.free_drag = run.free_drag;
    simulation.walls.normal_velocity = run.wall_normal_velocity;
    simulation.walls.tangential_velocity = run.wall_tangential_velocity;
    let Run { time, steps, time_step, strain, strain_rate, reference_radius, .. } = run;
    simulation.set_run_state(RunState { time, steps, time_step, strain, strain_rate, reference_radius });
    Ok(())
}
