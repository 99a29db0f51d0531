//! A box of spheres that is packed and then brought to the pressure at which paths begin.

use super::follow::{UNJAMMED_PRESSURE, advance, pressure, rest};
use super::material;
use super::strain::Strain;
use crate::Settled;
use crate::message::{number, range};
use crate::stopwatch::{self, Stage};
use msdd_beds::sizes::Sizes;
use msdd_beds::{BedError, Packing, pack_along, shake};
use msdd_spheres::{Failure, Simulation};

/// Least p/E* at which a box is packed; lower ones are reached by opening it, or by pressing it again where it is shaken. A packing
/// below has to creep for hundreds of thousands of steps, and the number of contacts changes less with the pressure the lower it is.
const MIN_PACKING_PRESSURE: f64 = 1e-6;
/// Steps after which packing is given up; at the least pressure and without friction it takes about 150 000.
const PACKING_STEPS: u64 = 600_000;
/// Relative error of the pressure that is accepted.
const NEAR: f64 = 0.05;
/// Attempts to come near it.
const ATTEMPTS: u32 = 40;
/// Slope of p^(2/3) over the strain per axis that attempts count on, and how far one opens: the pressure afterwards over
/// before.
const SLOPE: f64 = 0.45;
const OPENS_TO: f64 = 0.3;
/// Part of an increment at which a box that loses its load at once is left with the pressure that it still carries.
const MIN_SCALE: f64 = 0.05;

/// Spheres of a packing, pressures over E*, and openings of boxes that are shaken: with less, spheres still touch.
pub const SPHERES: [usize; 2] = [50, 1_000_000];
pub const PACKED_PRESSURES: [f64; 2] = [1e-8, 1e-3];
pub const SHAKING: [f64; 2] = [0.002, 0.1];
/// Largest friction of spheres.
pub const MAX_FRICTION: f64 = 2.0;

/// What to prepare.
#[derive(Clone, Debug, PartialEq)]
pub struct Preparation {
    pub spheres: usize,
    pub seed: u64,
    /// Of the diameters, whose Sauter mean is 1; none: equal spheres.
    pub sizes: Option<Sizes>,
    pub poisson_ratio: f64,
    pub restitution: f64,
    /// μ while the box closes, and afterwards.
    pub packing_friction: f64,
    pub friction: f64,
    /// Ratio of the rates at which the box closes along its axes, see [`pack_along`].
    pub rates: [f64; 3],
    /// How far the packed box is opened along all axes to be shaken, and then pressed again with the friction of
    /// afterwards, see [`shake`]; 0: it is not.
    pub shaking: f64,
    /// p/E*.
    pub pressure: f64,
}

/// A box at rest.
#[derive(Clone, Debug)]
pub struct Prepared {
    pub simulation: Simulation,
    pub rest: Settled,
}

/// Why a box was not prepared.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PrepareError {
    #[error("{key} = {value}, allowed: {allowed}", value = number(*value))]
    Parameter { key: &'static str, value: f64, allowed: String },
    #[error(transparent)]
    Bed(#[from] BedError),
    #[error(transparent)]
    Failure(#[from] Failure),
    #[error("at rest it has a pressure over E* of {found:.3e}, allowed: within 5 % of {target:e}")]
    Pressure { found: f64, target: f64 },
}

impl Preparation {
    /// The error names key, value and allowed range.
    fn check(&self) -> Result<(), PrepareError> {
        let shaking = if self.shaking == 0.0 { SHAKING[0] } else { self.shaking };
        let parameters = [
            ("spheres", self.spheres as f64, SPHERES.map(|count| count as f64)),
            ("friction", self.friction, [0.0, MAX_FRICTION]),
            // A packing whose friction is lowered afterwards collapses.
            ("packing_friction", self.packing_friction, [0.0, self.friction]),
            ("shaking", shaking, SHAKING),
            ("pressure", self.pressure, PACKED_PRESSURES),
        ];
        let wrong = parameters.into_iter().find(|(_, value, [least, most])| !(least..=most).contains(&value));
        let Some((key, value, ends)) = wrong else { return Ok(()) };
        let allowed = match key {
            "packing_friction" => format!("0 to the friction, {}", self.friction),
            "shaking" => format!("0, or {}", range(ends)),
            _ => range(ends),
        };
        Err(PrepareError::Parameter { key, value, allowed })
    }
}

/// Packs and brings to the pressure.
///
/// # Errors
/// A parameter outside its range; a run that fails; a pressure that is not reached.
pub fn prepare(preparation: &Preparation) -> Result<Prepared, PrepareError> {
    preparation.check()?;
    let &Preparation { spheres, seed, poisson_ratio, restitution, rates, .. } = preparation;
    let mut packing = Packing {
        spheres,
        seed,
        diameter: 1.0,
        sizes: preparation.sizes.clone(),
        material: material(poisson_ratio, preparation.packing_friction, restitution),
        pressure: preparation.pressure.max(MIN_PACKING_PRESSURE),
        steps: PACKING_STEPS,
    };
    let mut simulation = stopwatch::time(Stage::Packing, || pack_along(&packing, rates))?.simulation;
    packing.material = material(poisson_ratio, preparation.friction, restitution);
    if preparation.shaking > 0.0 {
        packing.pressure = preparation.pressure;
        let opening = preparation.shaking;
        stopwatch::time(Stage::Packing, || shake(&mut simulation, &packing, rates, opening))?;
    }
    simulation.material = packing.material;
    let rest = stopwatch::time(Stage::PackingSettle, || rest(&mut simulation, 0))?;
    let sum: f64 = rates.iter().sum();
    let rates = rates.map(|rate| 3.0 * rate / sum);
    let rest = bring_to(&mut simulation, preparation.pressure, rates, rest)?;
    Ok(Prepared { simulation, rest })
}

/// Closes or opens the box in the ratio of `rates`, whose sum is 3, until it carries the pressure; or until it would lose its
/// load suddenly if it were opened further, with the least pressure found.
fn bring_to(
    simulation: &mut Simulation,
    target: f64,
    rates: [f64; 3],
    mut rest: Settled,
) -> Result<Settled, PrepareError> {
    let power = |p: f64| libm::pow(p.max(0.0), 2.0 / 3.0);
    let mut scale = 1.0;
    for _ in 0..ATTEMPTS {
        let now = pressure(simulation);
        if (now / target - 1.0).abs() < NEAR {
            return Ok(rest);
        }
        let opens = now > target;
        let goal = if opens { target.max(OPENS_TO * now) } else { target };
        let [x, y, z] = rates.map(|rate| rate * scale * (power(now) - power(goal)) / SLOPE);
        let step = Strain { stretch: [x, y, z, 0.0, 0.0, 0.0], ..Strain::default() };
        let mut tried = simulation.clone();
        let mut after = advance(&mut tried, step)?;
        if opens && pressure(&tried) < (1.0 - NEAR) * target {
            // Contact is lost suddenly: it is tried again with less.
            scale *= 0.5;
            if scale < MIN_SCALE {
                return Ok(rest);
            }
            continue;
        }
        // A box that carries nothing may have to close by more than the pressure says.
        scale = if pressure(&tried) < UNJAMMED_PRESSURE { 2.0 * scale } else { 1.0 };
        after.steps += rest.steps;
        (*simulation, rest) = (tried, after);
    }
    Err(PrepareError::Pressure { found: pressure(simulation), target })
}
