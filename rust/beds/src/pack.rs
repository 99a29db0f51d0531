//! Packing: a periodic box of spheres is compressed until it carries a pressure, isotropically or along given axes.
//!
//! Friction while packing decides how dense the packing gets: from a solid fraction of 0.64 without friction to 0.57.

use crate::BedError;
use crate::averages::{Averages, averages, stress};
use crate::random::Random;
use crate::scatter::scatter;
use crate::sizes::{Moments, Sizes, radii};
use msdd_spheres::{Boundary, Cell, Material, Simulation, Sphere, Stiffness};
use std::f64::consts::PI;

/// Solid fraction at the start; random sequential addition ends at 0.38.
const LOOSE: f64 = 0.3;
/// Solid fraction near which a box that is compressed along given axes becomes a cube.
const DENSE: f64 = 0.6;
/// Least edge of a dense box over the largest diameter: a sphere must not meet two images of another.
const NARROWEST: f64 = 2.5;
/// Steps between two adjustments of the rate.
const LOOK_EVERY: u64 = 20;
/// Largest strain rate over √(p/ρ)/d, the inertial number of the compression. Not settled by any reference; chosen because
/// from 3e-3 to 3e-2 the solid fraction changes by at most 0.006 and the coordination by at most 0.1.
const FASTEST: f64 = 1e-2;
/// Strain rate over that largest one, per relative error of the pressure, once the spheres carry it.
const GAIN: f64 = 0.1;
/// Drag over √(p/ρ)/d once they do.
const DRAG: f64 = 1.0;
/// Mixing: largest velocity along each axis over √(p/ρ), and its path over the opening, so that a sphere collides some fifty times.
const MIXING_SPEED: f64 = 0.3;
const MIXING_PATH: f64 = 50.0;
/// Makes the random numbers of mixing others than those of the first places.
const MIXING_SEED: u64 = 0x5bd1_e995;
/// Relative error of the pressure, and kinetic energy over pV, at which a packing counts as at rest.
const BALANCED: [f64; 2] = [1e-4, 1e-8];

/// What to pack.
#[derive(Clone, Debug, PartialEq)]
pub struct Packing {
    pub spheres: usize,
    pub seed: u64,
    /// d \[m\], the Sauter mean.
    pub diameter: f64,
    /// Of the diameters; none: equal ones.
    pub sizes: Option<Sizes>,
    /// The friction in it is that while packing.
    pub material: Material,
    /// p \[Pa\]
    pub pressure: f64,
    /// Steps after which a packing that is not at rest is given up.
    pub steps: u64,
}

/// A packing, and whether it came to rest at the pressure.
#[derive(Clone, Debug)]
pub struct Packed {
    pub simulation: Simulation,
    pub averages: Averages,
    pub settled: bool,
}

impl Packing {
    fn check(&self) -> Result<(), BedError> {
        self.material.check()?;
        let positive = |v: f64| v.is_finite() && v > 0.0;
        self.sizes.as_ref().map_or(Ok(()), Sizes::check)?;
        let moments = Moments::new(self.sizes.as_ref(), self.spheres);
        let dense = libm::cbrt(self.spheres as f64 * PI / 6.0 * moments.volume / DENSE);
        let across = dense / moments.largest;
        let parameters = [
            ("spheres", self.spheres as f64, (50..=10_000_000).contains(&self.spheres), "50 to 10000000"),
            ("edge over the largest diameter", across, across >= NARROWEST, "2.5 or more: more spheres"),
            ("diameter", self.diameter, positive(self.diameter), "above 0 m"),
            ("pressure", self.pressure, positive(self.pressure), "above 0 Pa"),
            (
                "pressure",
                self.pressure,
                match self.material.stiffness {
                    Stiffness::HertzMindlin { young_modulus, .. } => self.pressure < 1e-2 * young_modulus,
                    Stiffness::Linear { normal, .. } => self.pressure < 1e-2 * normal / self.diameter,
                },
                "below 0.01 E",
            ),
        ];
        match parameters.into_iter().find(|parameter| !parameter.2) {
            None => Ok(()),
            Some((key, value, _, allowed)) => Err(BedError::Packing { key, value, allowed }),
        }
    }
}

/// Packs isotropically.
///
/// # Errors
/// A parameter outside its range; a run that fails.
pub fn pack(packing: &Packing) -> Result<Packed, BedError> {
    pack_along(packing, [1.0; 3])
}

/// Packs by rates of closing along the axes in the ratio of `rates` \[-\]: the largest is 1, their sum is above 0, and an axis
/// whose rate is below 0 opens. p is the mean pressure.
///
/// # Errors
/// A parameter outside its range; a run that fails.
pub fn pack_along(packing: &Packing, rates: [f64; 3]) -> Result<Packed, BedError> {
    packing.check()?;
    let &Packing { spheres: count, seed, diameter, pressure, .. } = packing;
    let density = packing.material.density;
    let sizes = packing.sizes.as_ref();
    let radii = radii(sizes, count, diameter);
    let volume = count as f64 * PI / 6.0 * diameter.powi(3) * Moments::new(sizes, count).volume;
    let edge = libm::cbrt(volume / LOOSE);
    let sum: f64 = rates.iter().sum();
    let edges = rates.map(|rate| edge * libm::pow(DENSE / LOOSE, rate / sum - 1.0 / 3.0));
    let places = scatter(&mut Random::new(seed), &radii, edges)?;
    let spheres =
        places.into_iter().map(|(centre, radius)| Sphere::at_rest(centre, radius, density)).collect();
    let cell = Cell::block(edges);
    let mut simulation = Simulation::new(packing.material.clone(), spheres, Boundary::Periodic(cell))?;
    let settled = compress(&mut simulation, packing, rates, (pressure / density).sqrt() / diameter)?;
    simulation.drag = 0.0;
    let averages = averages(&simulation);
    Ok(Packed { simulation, averages, settled })
}

/// Shakes a packed box and presses it again with the friction and to the pressure of `packing`. First it is opened by `opening` along
/// all axes, so that no spheres touch, and their places are mixed by random velocities without friction or damping. So it
/// is nearly as dense as before, but every contact was made under friction, as where grains rain down or are shaken (Agnolin and
/// Roux, 2007, Phys. Rev. E 76:061302, packings C). `packing.steps` are counted from here.
///
/// # Errors
/// A parameter outside its range; a run that fails.
pub fn shake(
    simulation: &mut Simulation,
    packing: &Packing,
    rates: [f64; 3],
    opening: f64,
) -> Result<bool, BedError> {
    packing.check()?;
    let &Packing { seed, diameter, pressure, .. } = packing;
    let per_time = (pressure / packing.material.density).sqrt() / diameter;
    simulation.scale_cell(1.0 + opening);
    let mut random = Random::new(seed ^ MIXING_SEED);
    let speed = MIXING_SPEED * per_time * diameter;
    for sphere in &mut simulation.spheres {
        sphere.velocity = std::array::from_fn(|_| random.uniform(-speed, speed));
        sphere.angular_velocity = [0.0; 3];
    }
    simulation.material = Material { friction: 0.0, restitution: 1.0, ..packing.material.clone() };
    simulation.drag = 0.0;
    let until = simulation.time + MIXING_PATH * opening * diameter / speed;
    while simulation.time < until {
        simulation.run(LOOK_EVERY)?;
    }
    simulation.material = packing.material.clone();
    let settled = compress(simulation, packing, rates, per_time)?;
    simulation.drag = 0.0;
    Ok(settled)
}

/// `per_time` \[1/s\] is √(p/ρ)/d.
fn compress(
    simulation: &mut Simulation,
    packing: &Packing,
    rates: [f64; 3],
    per_time: f64,
) -> Result<bool, BedError> {
    // The same volume per time along whatever axes, once the pressure is borne.
    let evenly = 3.0 / rates.iter().sum::<f64>();
    let target = packing.pressure;
    let fastest = FASTEST * per_time;
    let mut borne = false;
    let end = simulation.steps + packing.steps;
    while simulation.steps < end {
        let stress = stress(simulation);
        let pressure = (stress[0][0] + stress[1][1] + stress[2][2]) / 3.0;
        let error = (pressure - target) / target;
        if error > 0.0 && !borne {
            borne = true;
            simulation.drag = DRAG * per_time;
        }
        let volume = simulation.cell().map_or(0.0, Cell::volume);
        let at_rest = simulation.kinetic_energy() < BALANCED[1] * target * volume;
        if borne && error.abs() < BALANCED[0] && at_rest {
            simulation.set_velocity_gradient([[0.0; 3]; 3]);
            return Ok(true);
        }
        let [x, y, z] = if borne {
            let rate = fastest * (GAIN * error).clamp(-1.0, 1.0);
            rates.map(|along| rate * evenly * along)
        } else {
            rates.map(|along| fastest * error.clamp(-1.0, 1.0) * along)
        };
        simulation.set_velocity_gradient([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]);
        simulation.run(LOOK_EVERY)?;
    }
    simulation.set_velocity_gradient([[0.0; 3]; 3]);
    Ok(false)
}
