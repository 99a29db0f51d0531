//! Packing: walls, or the borders of a periodic box, close on randomly placed discs until a target porosity is reached;
//! then the assembly relaxes (section 2.4).

use crate::area::porosity_of_box;
use crate::message::range;
use crate::place::{Random, radii, scatter, scatter_periodic};
use crate::scale::{rate_factor, speed_factor};
use crate::settle::{KEEP_EVERY, Relaxation, Settled, settle};
use crate::stopwatch::{self, Stage};
use crate::{Material, RveError, Simulation};
use msdd_dem::{Periodic, Side, Walls};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Area fraction of the discs at the start: well below 0.55, at which random sequential addition finds no more places.
const START_DENSITY: f64 = 0.42;
/// Default speed of each wall [m/s] for the paper's grains; for others it is scaled with the speed of motion in them
/// (see `scale`). Up to 0.05 the packing of 500 discs is quasi-static; a slower speed does not change the statistics.
pub const WALL_SPEED: f64 = 0.03;
/// Drag on discs without contact while an RVE is made [1/s], for the paper's grains. The paper's damping acts on discs
/// with contacts only, so without drag free discs would never come to rest.
pub const FREE_DRAG: f64 = 20.0;
/// The compression fails after this many times the number of steps in which the x walls would meet.
const STEP_CAP_FACTOR: f64 = 1.5;

/// In which directions the walls close.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Compression {
    /// Along x and y by the same strain: fabric index near 0.
    #[default]
    Isotropic,
    /// Along x only: fabric index above 0.
    Horizontal,
    /// Twice as fast along x as along y.
    Intermediate,
    /// Along x, while it opens along y an eighth as fast: most fabric, and most difference between σ_xx and σ_yy.
    Sheared,
}

impl Compression {
    /// Speed of the x walls and of the y walls over [`WALL_SPEED`], such that the box ends with the given width over
    /// height.
    fn speeds(self, aspect: f64) -> [f64; 2] {
        let [x, y] = match self {
            Self::Isotropic => [aspect, 1.0],
            Self::Horizontal => [1.0, 0.0],
            Self::Intermediate => [2.0 * aspect, 1.0],
            Self::Sheared => [8.0 * aspect, -1.0],
        };
        let fastest = f64::max(x, y);
        [x / fastest, y / fastest]
    }
}

/// Boundary of the box.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Boundary {
    /// Four rigid walls, as in the paper.
    #[default]
    Walls,
    /// No walls: the box repeats itself periodically, and carries the grains along as it deforms.
    Periodic,
}

/// What a specification may have.
const DISCS: [f64; 2] = [10.0, 1_000_000.0];
const POROSITIES: [f64; 2] = [0.01, 0.3];
const RADII: [f64; 2] = [1e-30, 1e30];
const RADII_ABOVE: &str = "radius_min to 10 radius_min";

/// Specification of a packing.
#[derive(Clone, Debug, PartialEq)]
pub struct PackingSpec {
    /// Number of grains. Allowed: `DISCS`.
    pub discs: usize,
    /// Number from which places and radii of the grains follow. Allowed: whole number from 0.
    pub seed: u64,
    /// Target porosity of the whole box, overlaps counted once. It is reached before the relaxation, which changes it little.
    /// Allowed: `POROSITIES`.
    pub porosity: f64,
    /// How the box closes.
    pub compression: Compression,
    /// Radii are uniform from this \[m\]. Allowed: `RADII`.
    pub radius_min: f64,
    /// To this \[m\]. Allowed: `RADII_ABOVE`.
    pub radius_max: f64,
    /// What is around the box.
    pub boundary: Boundary,
    /// How grains come to rest.
    pub relaxation: Relaxation,
}

impl Default for PackingSpec {
    /// 500 discs as in the paper, at a porosity of 0.12.
    fn default() -> Self {
        Self {
            discs: 500,
            seed: 1,
            porosity: 0.12,
            compression: Compression::Isotropic,
            radius_min: 3e-3,
            radius_max: 7e-3,
            boundary: Boundary::default(),
            relaxation: Relaxation::default(),
        }
    }
}

/// Details of the packing procedure, with the usual values as default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preparation {
    /// Friction angle of the grains while the walls close \[rad\]; none: that of the material. Before the final
    /// relaxation the material's own angle is restored, so that all packed states are in equilibrium under the same
    /// contact law. Less friction gives denser packings at equal pressure.
    pub friction_angle: Option<f64>,
    /// Width over height of the box at the target porosity [-].
    pub aspect: f64,
    /// Speed of the faster walls while they close [m/s]; none: [`WALL_SPEED`], scaled for the grains.
    pub wall_speed: Option<f64>,
}

impl Default for Preparation {
    /// Friction of the material, a square box.
    fn default() -> Self {
        Self { friction_angle: None, aspect: 1.0, wall_speed: None }
    }
}

impl Preparation {
    /// `factor`: ratio of the speeds suitable for these grains to those for the paper's grains.
    fn check(&self, factor: f64) -> Result<(), RveError> {
        if !(0.1..=10.0).contains(&self.aspect) {
            return RveError::parameter("aspect", self.aspect, "0.1 to 10");
        }
        let allowed = "1e-4 to 10 m/s for the paper's grains, others as a push runs faster or slower in them";
        match self.wall_speed {
            Some(speed) if !(1e-4 * factor..=10.0 * factor).contains(&speed) => {
                RveError::parameter("wall speed", speed, allowed)
            }
            _ => Ok(()),
        }
    }
}

/// A packed assembly in equilibrium, walls at rest, at zero strain.
#[derive(Clone, Debug)]
pub struct Packed {
    pub simulation: Simulation,
    pub settled: Settled,
}

/// Why a packing failed, and its last good state.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{error}")]
pub struct Stopped {
    pub error: RveError,
    /// Absent when the packing failed before the first step.
    pub last_good: Option<Box<Simulation>>,
}

impl PackingSpec {
    /// Checks the specification; the error names key, value and allowed range.
    pub fn check(&self) -> Result<(), RveError> {
        let inside = |value: f64, [least, most]: [f64; 2]| (least..=most).contains(&value);
        if !inside(self.discs as f64, DISCS) {
            return RveError::parameter("discs", self.discs, range(DISCS));
        }
        if !inside(self.porosity, POROSITIES) {
            return RveError::parameter("porosity", self.porosity, range(POROSITIES));
        }
        if !inside(self.radius_min, RADII) {
            return RveError::parameter("radius_min", self.radius_min, range(RADII) + " m");
        }
        if !(self.radius_max >= self.radius_min && self.radius_max <= 10.0 * self.radius_min) {
            return RveError::parameter("radius_max", self.radius_max, RADII_ABOVE);
        }
        Ok(())
    }
}

/// Packs one RVE. The final box is about square.
///
/// # Errors
/// [`RveError::Parameter`] or [`RveError::Material`] for bad input; [`RveError::NoRoom`],
/// [`RveError::TargetNotReached`] or [`RveError::Failure`] when the packing fails.
pub fn pack(spec: &PackingSpec, material: &Material) -> Result<Packed, RveError> {
    pack_as(spec, &Preparation::default(), material)
}

/// As [`pack`], with details of the procedure given by `preparation`.
///
/// # Errors
/// As [`pack`].
pub fn pack_as(
    spec: &PackingSpec,
    preparation: &Preparation,
    material: &Material,
) -> Result<Packed, RveError> {
    pack_watched(spec, preparation, material).map_err(|stopped| stopped.error)
}

/// As [`pack_as`], but the error of a failed packing contains its last good state.
///
/// # Errors
/// Those of [`pack`].
pub fn pack_watched(
    spec: &PackingSpec,
    preparation: &Preparation,
    material: &Material,
) -> Result<Packed, Stopped> {
    let start = checked_start(spec, preparation, material);
    let mut simulation = start.map_err(|error| Stopped { error, last_good: None })?;
    simulation.keep_last_good(KEEP_EVERY);
    let settled = close_and_settle(&mut simulation, spec, preparation, material);
    let last_good = simulation.take_last_good().map(Box::new);
    match settled {
        Ok(settled) => Ok(Packed { simulation, settled }),
        Err(error) => Err(Stopped { error, last_good }),
    }
}

fn checked_start(
    spec: &PackingSpec,
    preparation: &Preparation,
    material: &Material,
) -> Result<Simulation, RveError> {
    spec.check()?;
    material.check()?;
    preparation.check(speed_factor(material, 0.5 * (spec.radius_min + spec.radius_max)))?;
    let friction_angle = preparation.friction_angle.unwrap_or(material.friction_angle);
    let packing_material = Material { friction_angle, ..material.clone() };
    packing_material.check()?;
    loose_start(spec, preparation.aspect, &packing_material)
}

fn close_and_settle(
    simulation: &mut Simulation,
    spec: &PackingSpec,
    preparation: &Preparation,
    material: &Material,
) -> Result<Settled, RveError> {
    stopwatch::time(Stage::Packing, || compress(simulation, spec, preparation))?;
    simulation.walls.stop();
    simulation.material.friction_angle = material.friction_angle;
    let settled = stopwatch::time(Stage::PackingSettle, || settle(simulation, spec.relaxation, 0))?;
    simulation.reset_strain();
    Ok(settled)
}

fn loose_start(spec: &PackingSpec, aspect: f64, material: &Material) -> Result<Simulation, RveError> {
    let mut random = Random::new(spec.seed);
    let radii = radii(&mut random, spec.discs, spec.radius_min, spec.radius_max);
    let area: f64 = radii.iter().map(|r| PI * r * r).sum();
    let (width, height) = start_box(spec, aspect, area);
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
    simulation.free_drag = free_drag(&simulation);
    Ok(simulation)
}

/// [`FREE_DRAG`] scaled for the grains of `simulation` [1/s].
pub fn free_drag(simulation: &Simulation) -> f64 {
    FREE_DRAG * rate_factor(&simulation.material, simulation.mean_radius())
}

/// Width and height [m] of the loose box for discs of total area `area` [m²], such that it has the wanted aspect ratio
/// when the walls have closed to the target porosity.
fn start_box(spec: &PackingSpec, aspect: f64, area: f64) -> (f64, f64) {
    let loose = area / START_DENSITY;
    let dense = area / (1.0 - spec.porosity);
    match spec.compression {
        Compression::Isotropic => ((loose * aspect).sqrt(), (loose / aspect).sqrt()),
        Compression::Horizontal => {
            let height = (dense / aspect).sqrt();
            (loose / height, height)
        }
        Compression::Intermediate | Compression::Sheared => {
            // Solves (w + a vx)(h + a vy) = loose for the distance a that the faster walls move.
            let ([vx, vy], [w, h]) =
                (spec.compression.speeds(aspect), [(dense * aspect).sqrt(), (dense / aspect).sqrt()]);
            let half = 0.5 * (w * vy + h * vx);
            let way = (-half + (half * half + vx * vy * (loose - dense)).sqrt()) / (vx * vy);
            (w + way * vx, h + way * vy)
        }
    }
}

/// Closes the walls until the box has the target porosity.
fn compress(
    simulation: &mut Simulation,
    spec: &PackingSpec,
    preparation: &Preparation,
) -> Result<(), RveError> {
    let speeds = spec.compression.speeds(preparation.aspect);
    let usual = || WALL_SPEED * speed_factor(&simulation.material, simulation.mean_radius());
    let wall_speed = preparation.wall_speed.unwrap_or_else(usual);
    let [x, y] = speeds.map(|speed| speed * wall_speed);
    simulation.walls.normal_velocity = [x, -x, y, -y];
    let cap = STEP_CAP_FACTOR * 0.5 * simulation.walls.width() / x / simulation.time_step;
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

/// Steps in which the walls close about half of the remaining distance, so that the porosity is computed more often as
/// the target comes near.
fn steps_to_halve(simulation: &Simulation, excess: f64) -> u64 {
    let walls = &simulation.walls;
    let [left, right, bottom, top] = Side::ALL.map(|side| walls.normal_velocity[side as usize]);
    let rate = (left - right) / walls.width() + (bottom - top) / walls.height();
    ((0.5 * excess / (rate * simulation.time_step)) as u64).clamp(1, 100)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spec(compression: Compression) -> PackingSpec {
        PackingSpec {
            discs: 120,
            seed: 7,
            porosity: 0.13,
            compression,
            radius_min: 3e-3,
            radius_max: 7e-3,
            ..PackingSpec::default()
        }
    }

    #[test]
    fn boxes_close_to_their_shape() {
        for compression in
            [Compression::Isotropic, Compression::Horizontal, Compression::Intermediate, Compression::Sheared]
        {
            for aspect in [1.0, 2.0] {
                let preparation = Preparation { aspect, ..Preparation::default() };
                let walls =
                    pack_as(&spec(compression), &preparation, &Material::default()).unwrap().simulation.walls;
                let off = walls.width() / walls.height() / aspect - 1.0;
                // The start box does not account for overlaps, so the moving walls overshoot its shape a little. With
                // `Sheared`, where y opens, the same change of area needs 1.125/0.875 times the change of shape.
                let bound = if compression == Compression::Sheared { 0.06 * 1.125 / 0.875 } else { 0.06 };
                assert!(off.abs() < bound, "{compression:?} {aspect}: {off}");
            }
        }
    }

    #[test]
    fn friction_while_packing_leaves_the_material_as_it_was() {
        let material = Material::default();
        let packed = |angle| {
            let preparation = Preparation { friction_angle: angle, ..Preparation::default() };
            pack_as(&spec(Compression::Isotropic), &preparation, &material).unwrap()
        };
        let (usual, smooth) = (packed(None), packed(Some(0.1)));
        assert_eq!((&usual.simulation.material, &smooth.simulation.material), (&material, &material));
        assert_eq!(usual.simulation.discs.len(), 120);
        assert!(usual.simulation.discs[0].x != smooth.simulation.discs[0].x);
        let bad = Preparation { friction_angle: Some(2.0), ..Preparation::default() };
        let error = pack_as(&spec(Compression::Isotropic), &bad, &material).unwrap_err().to_string();
        assert!(error.contains("friction_angle = 2"), "{error}");
    }
}
