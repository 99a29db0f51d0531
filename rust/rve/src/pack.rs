//! Packing: walls, or the borders of a periodic box, close on randomly placed discs until a target porosity, then the assembly relaxes (section 2.4).

use crate::area::porosity_of_box;
use crate::place::{Random, radii, scatter, scatter_periodic};
use crate::settle::{Settled, settle};
use crate::{Material, RveError, Simulation};
use msdd_dem::{Periodic, Side, Walls};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Area fraction of the discs at the start: well below the 0.55 at which random addition stops finding places.
const START_DENSITY: f64 = 0.42;
/// Speed of each wall [m/s]. At most 0.05 is quasi-static for 500 discs; slower changes no statistics.
const WALL_SPEED: f64 = 0.03;
/// Drag on contact-free discs while an RVE is made [1/s]: the paper's damping leaves them flying for ever.
pub(crate) const FREE_DRAG: f64 = 20.0;
/// Compression is given up after this many times the steps that the way of the walls needs.
const STEP_CAP_FACTOR: f64 = 1.5;

/// In which directions the walls close.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Compression {
    /// Both directions alike: fabric index near 0.
    Isotropic,
    /// x only: positive fabric index.
    Horizontal,
}

/// What is around the box.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Boundary {
    /// Four rigid walls, as in the paper.
    #[default]
    Walls,
    /// Nothing: the box repeats itself, and carries the grains along as it deforms.
    Periodic,
}

impl Boundary {
    fn is_walls(&self) -> bool {
        *self == Self::Walls
    }
}

/// What to pack.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PackingSpec {
    pub discs: usize,
    pub seed: u64,
    /// Target for the whole box, overlaps counted once [-]; reached before the relaxation, which changes it little.
    pub porosity: f64,
    pub compression: Compression,
    /// Radii are uniform between these [m].
    pub radius_min: f64,
    pub radius_max: f64,
    #[serde(default, skip_serializing_if = "Boundary::is_walls")]
    pub boundary: Boundary,
}

/// A packed assembly at rest in resting walls, at zero strain.
#[derive(Clone, Debug)]
pub struct Packed {
    pub simulation: Simulation,
    pub settled: Settled,
}

impl PackingSpec {
    /// Refuses what cannot be packed; names key, value and range.
    pub fn check(&self) -> Result<(), RveError> {
        let parameter = |key, value: String, allowed| Err(RveError::Parameter { key, value, allowed });
        if !(10..=1_000_000).contains(&self.discs) {
            return parameter("discs", self.discs.to_string(), "10 to 1000000");
        }
        if !(0.01..=0.3).contains(&self.porosity) {
            return parameter("porosity", self.porosity.to_string(), "0.01 to 0.3");
        }
        if !(self.radius_min > 0.0 && self.radius_min.is_finite()) {
            return parameter("radius_min", self.radius_min.to_string(), "> 0 m");
        }
        if !(self.radius_max >= self.radius_min && self.radius_max <= 10.0 * self.radius_min) {
            return parameter("radius_max", self.radius_max.to_string(), "radius_min to 10 radius_min");
        }
        Ok(())
    }
}

/// Packs one RVE. The box ends about square.
///
/// # Errors
/// [`RveError::Parameter`] or [`RveError::Material`] for bad input; [`RveError::NoRoom`],
/// [`RveError::TargetNotReached`] or [`RveError::Failure`] when the packing fails.
pub fn pack(spec: &PackingSpec, material: &Material) -> Result<Packed, RveError> {
    spec.check()?;
    material.check()?;
    let mut simulation = loose_start(spec, material)?;
    compress(&mut simulation, spec)?;
    simulation.walls.stop();
    let settled = settle(&mut simulation, 0)?;
    simulation.reset_strain();
    Ok(Packed { simulation, settled })
}

fn loose_start(spec: &PackingSpec, material: &Material) -> Result<Simulation, RveError> {
    let mut random = Random::new(spec.seed);
    let radii = radii(&mut random, spec.discs, spec.radius_min, spec.radius_max);
    let area: f64 = radii.iter().map(|r| PI * r * r).sum();
    let (width, height) = match spec.compression {
        Compression::Isotropic => ((area / START_DENSITY).sqrt(), (area / START_DENSITY).sqrt()),
        Compression::Horizontal => {
            let side = (area / (1.0 - spec.porosity)).sqrt();
            (area / START_DENSITY / side, side)
        }
    };
    let walls = Walls::around(width, height);
    let mut simulation = match spec.boundary {
        Boundary::Walls => {
            let discs = scatter(&mut random, radii, width, height, material.density)?;
            Simulation::new(material.clone(), discs, walls)
        }
        Boundary::Periodic => {
            let discs = scatter_periodic(&mut random, radii, width, height, material.density)?;
            Simulation::new_periodic(material.clone(), discs, walls, Periodic::default())?
        }
    };
    simulation.free_drag = FREE_DRAG;
    Ok(simulation)
}

/// Closes the walls until the box has the target porosity.
fn compress(simulation: &mut Simulation, spec: &PackingSpec) -> Result<(), RveError> {
    let speed = WALL_SPEED;
    simulation.walls.normal_velocity = match spec.compression {
        Compression::Isotropic => [speed, -speed, speed, -speed],
        Compression::Horizontal => [speed, -speed, 0.0, 0.0],
    };
    let cap = STEP_CAP_FACTOR * 0.5 * simulation.walls.width() / speed / simulation.time_step;
    loop {
        let porosity = porosity_of_box(simulation);
        if porosity <= spec.porosity {
            return Ok(());
        }
        if simulation.steps as f64 > cap {
            let (reached, target, steps) = (porosity, spec.porosity, simulation.steps);
            return Err(RveError::TargetNotReached { reached, target, steps });
        }
        simulation.run(steps_to_halve(simulation, porosity - spec.porosity))?;
    }
}

/// Steps in which the walls close about half of the way to the target: looks get closer as the target nears.
fn steps_to_halve(simulation: &Simulation, excess: f64) -> u64 {
    let walls = &simulation.walls;
    let [left, right, bottom, top] = Side::ALL.map(|side| walls.normal_velocity[side as usize]);
    let rate = (left - right) / walls.width() + (bottom - top) / walls.height();
    ((0.5 * excess / (rate * simulation.time_step)) as u64).clamp(1, 100)
}
