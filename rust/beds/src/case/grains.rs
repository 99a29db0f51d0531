//! The sections of a bed that all ways to compute it have: the spheres, what they are poured into, the gas.

use crate::effective::{GOOD, MIN_RATIO, closure_error};
use crate::exchange::{Emissivities, Exchange, OutOfRange, RADIATING, Tracing, exchange};
use crate::named_gases::GasName;
use crate::network::Materials;
use crate::pour::{Container, Pouring, WIDEST};
use crate::property::{Property, VALUES};
use crate::rays::Enclosure;
use crate::settle::longest;
use crate::sizes::{MAX_SPREAD, Moments, Sizes};
use crate::solid::{PeakStress, Roughness};
use msdd_engine::message::{number, range};
use msdd_spheres::law::effective_modulus;
use msdd_spheres::{Material, Partner, Simulation, Stiffness};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// A value that is wrong: its key, the value, what is allowed.
pub(super) type Wrong = (String, String, String);

/// The spheres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grains {
    /// Number of spheres. Allowed: `NUMBERS`. Default: those that fill `container.height` with `container.porosity`.
    #[serde(default)]
    pub number: usize,
    /// Diameter of all of them; with `sizes`, their Sauter mean Σ d³/Σ d² \[m\]. Allowed: `POSITIVE`.
    pub diameter: f64,
    /// Density of their material [kg/m³]. Allowed: `POSITIVE`.
    pub density: f64,
    /// Young's modulus of their material: how large contacts are for heat \[Pa\]. Allowed: `POSITIVE`.
    pub young_modulus: f64,
    /// Poisson's ratio. Allowed: `POISSON_RATIOS`.
    pub poisson_ratio: f64,
    /// Young's modulus with which the grains move; with a softer one steps are longer \[Pa\]. Allowed: `SIMULATED`. Default: a quarter
    /// of `young_modulus`.
    #[serde(default = "absent")]
    pub simulated_young_modulus: f64,
    /// Coefficient of friction of two grains. Allowed: `FRICTIONS`; by the solver 0.1 to 0.5. Default: 0.3.
    #[serde(default = "usual_friction")]
    pub friction: f64,
    /// Coefficient of friction of a grain and a wall. Allowed: `FRICTIONS`. Default: 0.3.
    #[serde(default = "usual_friction")]
    pub wall_friction: f64,
    /// Ratio of the speeds after and before a collision. Allowed: `RESTITUTIONS`. Default: 0.5.
    #[serde(default = "usual_restitution")]
    pub restitution: f64,
    /// Thermal conductivity: a number, or a table of pairs of temperature and value, straight in between, which covers all
    /// temperatures of the run [W/(m K)]. Allowed: `MIN_RATIO` or more times the conductivity of the gas at all temperatures of the
    /// run; below `GOOD` times, a closure for poor conductors is used, and the run says so.
    pub conductivity: Property,
    /// Specific heat capacity: a number or a table, as the conductivity [J/(kg K)]. Allowed: `VALUES`.
    pub heat_capacity: Property,
    /// Height of the asperities (root mean square) over their slope, σ/m \[m\]. Allowed: 0 (smooth), or `POSITIVE`. Default: smooth.
    pub roughness: Option<f64>,
    /// Hardness of the surface \[Pa\]. Allowed: `POSITIVE`; required with a roughness above 0.
    pub hardness: Option<f64>,
    /// Yield stress; contacts beyond it are reported \[Pa\]. Allowed: `POSITIVE`. Default: nothing is reported.
    pub yield_stress: Option<f64>,
    /// Emissivity of the surface, a number or a table, as the conductivity: grains above 0 exchange heat by radiation, as opaque,
    /// grey and diffuse bodies, along rays that are traced once, with the value in the middle of the temperatures of the run.
    /// Allowed: 0 (without radiation), or `RADIATING`. Default: without radiation.
    pub emissivity: Option<Property>,
    /// Rays from each grain. Allowed: `RAYS`; below `FEW_RAYS` the run says what noise they leave. Default: 1000.
    pub rays: Option<usize>,
    /// Linear coefficient of thermal expansion, not next to a `plate` [1/K]. Allowed: `EXPANSIONS`. Default: spheres keep their
    /// size.
    pub thermal_expansion: Option<f64>,
    /// Force on a contact at which a sphere breaks, with which the solver's case compares \[N\]. Allowed: `POSITIVE`. Default: not
    /// known.
    pub crush_load: Option<f64>,
    /// Standard deviation of the diameters over their mean, both weighted by surface, instead of `sizes`; DEM takes a log-normal
    /// distribution. Allowed: 0 to 0.25. Default: that of `sizes`.
    pub size_spread: Option<f64>,
    /// Distribution of the diameters, scaled so that their Sauter mean is `diameter`: `uniform` with the least and the largest one (by
    /// number), `normal` or `log_normal` with the standard deviation over the mean (by number, cut at two standard deviations), or
    /// `sieve` with rows of an opening and the share of the mass that passes it; two rows of one opening are spheres of that
    /// diameter. As `sieve=[[1,0],[1,0.3],[2,0.3],[2,1]]`. Allowed: up to 1:4. Default: equal spheres.
    pub sizes: Option<Sizes>,
}

/// What the grains are poured into: `base` or `radius`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vessel {
    /// A box: its lengths along x and y. Its walls are `floor`, `x_low`, `x_high`, `y_low`, `y_high`, `lid` \[m\].
    /// Allowed: `TWO_DIAMETERS`; `WIDE`. Default: this or `radius`.
    pub base: Option<[f64; 2]>,
    /// An upright cylinder: its radius. Its walls are `floor`, `side`, `lid` \[m\]. Allowed: `ONE_DIAMETER`; `WIDE`.
    /// Default: this or `base`.
    pub radius: Option<f64>,
    /// Whether the bed is periodic across the sides of `base`; its walls are `floor`, `lid`. Not next to a `plate`.
    /// Allowed: `true`, `false`; the `base` has `MORE_DIAMETERS`.
    #[serde(default)]
    pub endless: bool,
    /// Acceleration of gravity, first along −z [m/s²]. Allowed: `POSITIVE`, and so large that the spheres come to rest within
    /// `MAX_STEPS` steps.
    #[serde(default = "usual_gravity")]
    pub gravity: f64,
    /// Height of the bed, which the solver's case has; DEM finds it from the number of spheres \[m\]. Allowed: `POSITIVE`.
    /// Default: required by `case new`.
    pub height: Option<f64>,
    /// Porosity at the start, which the solver's case has; DEM finds it. Allowed: 0.2 to 0.7, and the range of the law. Default: 0.4,
    /// less for unequal spheres.
    pub porosity: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GasKeys {
    /// The gas; its properties depend on temperature.
    pub name: GasName,
    /// Its pressure, which sets the mean free path \[Pa\]. Allowed: `POSITIVE`.
    #[serde(default = "usual_pressure")]
    pub pressure: f64,
    /// Thermal accommodation at all surfaces. Allowed: `ACCOMMODATION`.
    #[serde(default = "usual_accommodation")]
    pub accommodation: f64,
}

/// The wall that is heated.
/// A number: its key, the value, what is allowed, whether it is so.
pub(crate) type Ranged = (&'static str, f64, String, bool);
/// A number that is not given, until [`super::BedCase::filled`].
pub(super) fn absent() -> f64 {
    f64::NAN
}

/// Friction for which the law of spheres is valid, and usual restitution, which hardly matters.
pub const FRICTION: f64 = 0.3;
pub const RESTITUTION: f64 = 0.5;

fn usual_friction() -> f64 {
    FRICTION
}

fn usual_restitution() -> f64 {
    RESTITUTION
}

fn usual_gravity() -> f64 {
    9.81
}

fn usual_pressure() -> f64 {
    101_325.0
}

/// Thermal accommodation of the gas at spheres, also the solver's default.
fn usual_accommodation() -> f64 {
    0.9
}

/// Young's modulus over that with which grains move, which hardly matters.
const SOFTER: f64 = 4.0;
/// Spheres of which moments are taken while their number is not known.
const MANY: usize = 1000;
/// Most steps in which poured grains have to come to rest: those of cases/beds have some 500 000.
const MAX_STEPS: f64 = 1e8;
/// Parts of the temperatures of a run at which the conductivity of the grains is compared with that of the gas.
const LOOKS: u32 = 50;
/// Solid fraction of a bed whose porosity is not known.
pub(super) const REFERENCE_FRACTION: f64 = 0.6;

/// What numbers may be; the comments of the keys name these.
pub(crate) const POSITIVE: [f64; 2] = [1e-12, 1e15];
pub(crate) const TEMPERATURES: [f64; 2] = [1.0, 5000.0];
pub(crate) const EXPANSIONS: [f64; 2] = [0.0, 0.01];
pub(crate) const POISSON_RATIOS: [f64; 2] = [0.0, 0.5];
const NUMBERS: [f64; 2] = [1.0, 1_000_000.0];
const FRICTIONS: [f64; 2] = [0.0, 10.0];
const RESTITUTIONS: [f64; 2] = [0.001, 1.0];
const RAYS: [f64; 2] = [1.0, 1_000_000.0];
const DEFAULT_RAYS: usize = 1000;
/// Difference of scaled exchanges from those traced with their own emissivity, see `tests/radiation.rs` \[%\].
const SCALED_ERROR: f64 = 2.0;
const SIMULATED: &str = "1e-12 to that of the material, young_modulus";
const ACCOMMODATION: &str = "0 < accommodation <= 1";
const ONE_DIAMETER: &str = "one diameter of the largest grain at least";
const TWO_DIAMETERS: &str = "two diameters of the largest grain at least";
const MORE_DIAMETERS: &str = "two and a half diameters of the largest grain at least";
const WIDE: &str = "a floor of at most 10 squares of the diameter for each grain";

fn inside(value: f64, [low, high]: [f64; 2]) -> bool {
    (low..=high).contains(&value)
}

pub(crate) fn ranged(key: &'static str, value: f64, allowed: [f64; 2]) -> Ranged {
    (key, value, range(allowed), inside(value, allowed))
}

pub(crate) fn temperature(key: &'static str, value: f64) -> Ranged {
    (key, value, range(TEMPERATURES) + " K", inside(value, TEMPERATURES))
}

pub(crate) fn emissivity(key: &'static str, value: f64, none: &str) -> Ranged {
    let good = value == 0.0 || inside(value, RADIATING);
    (key, value, format!("0 ({none}), or {}", range(RADIATING)), good)
}

pub(crate) fn rough(key: &'static str, value: Option<f64>) -> Ranged {
    let good = value.is_none_or(|v| v == 0.0 || inside(v, POSITIVE));
    (key, value.unwrap_or_default(), format!("0 (smooth), or {}", range(POSITIVE)), good)
}

pub(crate) fn hardness(key: &str, roughness: Option<f64>, hardness: Option<f64>) -> Result<(), Wrong> {
    if roughness.is_some_and(|height| height > 0.0) && hardness.is_none() {
        let allowed = "a value, because a roughness is given".to_string();
        return Err((key.to_string(), "not given".to_string(), allowed));
    }
    Ok(())
}

impl Grains {
    /// ε in the middle of two temperatures \[K\], with which rays are traced, if the grains radiate.
    fn emissivity_between(&self, [low, high]: [f64; 2]) -> Option<f64> {
        let emissivity = self.emissivity.as_ref().map(|emissivity| emissivity.at(0.5 * (low + high)));
        emissivity.filter(|emissivity| *emissivity > 0.0)
    }

    /// What the run says if the emissivity depends on the temperature.
    pub(crate) fn varying_emissivity(&self, [low, high]: [f64; 2]) -> Option<String> {
        let table @ Property::Table(_) = self.emissivity.as_ref()? else { return None };
        Some(format!(
            "radiation: the emissivity of the grains is {:.3} at {low:.0} K and {:.3} at {high:.0} K; rays are traced with {:.3}, and what grains \
             exchange is scaled by the law's conductivity by radiation, which is within {SCALED_ERROR} % of rays with each emissivity",
            table.at(low),
            table.at(high),
            self.emissivity_between([low, high])?
        ))
    }

    /// Traces the radiation in a bed between two temperatures \[K\], if the grains radiate. `walls`: numbers of those that do, and their
    /// emissivities unless they are those of the grains; others reflect everything.
    pub(crate) fn exchange(
        &self,
        simulation: &Simulation,
        walls: &[(usize, Option<f64>)],
        range: [f64; 2],
        (seed, threads): (u64, usize),
    ) -> Result<Option<Exchange>, OutOfRange> {
        let Some(spheres) = self.emissivity_between(range) else { return Ok(None) };
        let mut emissivities = Emissivities { spheres, walls: vec![0.0; simulation.boundary.walls().len()] };
        walls.iter().for_each(|&(wall, own)| emissivities.walls[wall] = own.unwrap_or(spheres));
        let tracing = Tracing { rays: self.rays.unwrap_or(DEFAULT_RAYS), seed, threads };
        exchange(&Enclosure::new(simulation), &emissivities, &tracing).map(Some)
    }

    /// What conducts heat in a bed of them with a solid fraction.
    pub(crate) fn materials(&self, gas: &GasKeys, solid_fraction: f64) -> Materials {
        Materials {
            conductivity: self.conductivity.clone(),
            heat_capacity: self.heat_capacity.clone(),
            effective_modulus: effective_modulus(self.young_modulus, self.poisson_ratio),
            roughness: Roughness::given(self.roughness, self.hardness),
            gas: gas.name,
            gas_pressure: gas.pressure,
            accommodation: gas.accommodation,
            solid_fraction: Some(solid_fraction),
        }
    }

    /// The stress in the contacts of a bed against the yield stress, if that is given.
    pub fn peak_stress(&self, simulation: &Simulation) -> Option<PeakStress> {
        let mut contacts = Vec::new();
        simulation.for_each_contact(|contact| {
            if let Partner::Sphere(_) = contact.i {
                contacts.push((contact.normal_force, contact.effective_radius));
            }
        });
        let modulus = effective_modulus(self.young_modulus, self.poisson_ratio);
        self.yield_stress.map(|limit| PeakStress::new(contacts.into_iter(), modulus, limit))
    }

    /// Pours the grains into a container under `gravity` \[m/s²\].
    pub(crate) fn pouring(&self, seed: u64, container: Container, gravity: f64, threads: usize) -> Pouring {
        let mut pouring = Pouring {
            spheres: self.number,
            seed,
            diameter: self.diameter,
            sizes: self.sizes.clone(),
            material: Material {
                density: self.density,
                stiffness: Stiffness::HertzMindlin {
                    young_modulus: self.simulated_young_modulus,
                    poisson_ratio: self.poisson_ratio,
                },
                friction: self.friction,
                wall_friction: self.wall_friction,
                restitution: self.restitution,
            },
            container,
            gravity,
            longest: 0.0,
            threads,
        };
        pouring.longest = longest(self.diameter, gravity, pouring.height().max(container.width()));
        pouring
    }

    /// With what follows from other values instead of what is not given.
    pub(super) fn filled(&mut self, container: &Vessel) {
        if self.simulated_young_modulus.is_nan() {
            self.simulated_young_modulus = self.young_modulus / SOFTER;
        }
        if self.sizes.is_none() {
            self.sizes = self.size_spread.filter(|spread| *spread > 0.0).map(Sizes::of_spread);
        }
        if self.number == 0
            && let Some(height) = container.height
        {
            let solid = container.porosity.map_or(REFERENCE_FRACTION, |porosity| 1.0 - porosity);
            let volume = PI / 6.0 * self.diameter.powi(3) * Moments::new(self.sizes.as_ref(), MANY).volume;
            self.number = (container.container().area() * height * solid / volume).round() as usize;
        }
    }

    pub(crate) fn check_sizes(&self) -> Result<(), Wrong> {
        let checked = self.sizes.as_ref().map_or(Ok(()), Sizes::check);
        checked.map_err(|problem| ("grains.sizes".into(), problem.value, problem.allowed))
    }

    /// Of the diameters over the Sauter mean.
    pub fn moments(&self) -> Moments {
        Moments::new(self.sizes.as_ref(), self.number)
    }

    /// Volume of all grains \[m³\].
    pub fn volume(&self) -> f64 {
        self.number as f64 * PI / 6.0 * self.diameter.powi(3) * self.moments().volume
    }

    pub(crate) fn numbers(&self) -> Vec<Ranged> {
        let simulated = self.simulated_young_modulus;
        let constant = match self.emissivity {
            Some(Property::Constant(emissivity)) => emissivity,
            _ => RADIATING[1],
        };
        vec![
            ranged("grains.diameter", self.diameter, POSITIVE),
            ranged("grains.density", self.density, POSITIVE),
            ranged("grains.young_modulus", self.young_modulus, POSITIVE),
            ranged("grains.hardness", self.hardness.unwrap_or(1.0), POSITIVE),
            ranged("grains.yield_stress", self.yield_stress.unwrap_or(1.0), POSITIVE),
            ranged("grains.number", self.number as f64, NUMBERS),
            ranged("grains.friction", self.friction, FRICTIONS),
            ranged("grains.wall_friction", self.wall_friction, FRICTIONS),
            ranged("grains.restitution", self.restitution, RESTITUTIONS),
            ranged("grains.poisson_ratio", self.poisson_ratio, POISSON_RATIOS),
            (
                "grains.simulated_young_modulus",
                simulated,
                SIMULATED.into(),
                inside(simulated, POSITIVE) && simulated <= self.young_modulus,
            ),
            emissivity("grains.emissivity", constant, "without radiation"),
            ranged("grains.rays", self.rays.unwrap_or(DEFAULT_RAYS) as f64, RAYS),
            rough("grains.roughness", self.roughness),
            ranged("grains.crush_load", self.crush_load.unwrap_or(1.0), POSITIVE),
            ranged("grains.size_spread", self.size_spread.unwrap_or(0.0), [0.0, MAX_SPREAD]),
            ranged("grains.thermal_expansion", self.thermal_expansion.unwrap_or(0.0), EXPANSIONS),
        ]
    }

    /// Checks what depends on the temperatures of a run \[K\] and on the gas.
    pub(crate) fn check(&self, range: [f64; 2], keys: &GasKeys) -> Result<(), Wrong> {
        hardness("grains.hardness", self.roughness, self.hardness)?;
        let mut properties = vec![
            ("grains.conductivity", &self.conductivity, VALUES),
            ("grains.heat_capacity", &self.heat_capacity, VALUES),
        ];
        if let Some(table @ Property::Table(_)) = &self.emissivity {
            properties.push(("grains.emissivity", table, RADIATING));
        }
        for (key, property, values) in properties {
            property.check(range, values).map_err(|(value, allowed)| (key.to_string(), value, allowed))?;
        }
        let [low, high] = keys.name.range();
        if range[0] < low || range[1] > high {
            let allowed = format!("a gas that is known there; this one: {low} to {high} K");
            return Err((
                "gas.name".into(),
                format!("{} at {} K to {} K", keys.name, number(range[0]), number(range[1])),
                allowed,
            ));
        }
        let [least, _] = self.ratios(range, keys);
        if least < MIN_RATIO {
            let text = format!("grains that conduct {MIN_RATIO} times as well as the gas, at least");
            return Err(("grains.conductivity".into(), format!("{least:.2} times that of the gas"), text));
        }
        Ok(())
    }

    /// What a run between two temperatures \[K\] says of grains so poor that a closure takes the place of the law of pairs.
    pub(crate) fn closure(&self, range: [f64; 2], keys: &GasKeys) -> Option<String> {
        let [least, most] = self.ratios(range, keys);
        (least < GOOD).then(|| {
            format!(
                "the grains conduct {least:.1} to {most:.1} times as well as the gas: heat also flows through the gas around the contacts, so the conductances \
                 follow a closure for poor conductors, which is within {:.0} % of direct solutions of the heat equation",
                100.0 * closure_error(most.min(GOOD)).max(closure_error(least))
            )
        })
    }

    /// The least and the largest conductivity over that of the gas, between two temperatures \[K\].
    pub fn ratios(&self, range: [f64; 2], keys: &GasKeys) -> [f64; 2] {
        let ratio = |t: f64| {
            let gas = keys.name.at(t, keys.pressure, keys.accommodation);
            gas.map_or(f64::INFINITY, |gas| self.conductivity.at(t) / gas.conductivity)
        };
        // A table may dip at a row, and the gas is no straight line between two.
        let between = (0..=LOOKS).map(|k| range[0] + (range[1] - range[0]) * f64::from(k) / f64::from(LOOKS));
        let rows = self.conductivity.rows().into_iter().filter(|t| (range[0]..=range[1]).contains(t));
        let all: Vec<f64> = between.chain(rows).map(ratio).collect();
        [all.iter().copied().fold(f64::INFINITY, f64::min), all.iter().copied().fold(0.0, f64::max)]
    }
}

impl GasKeys {
    /// A gas of this pressure \[Pa\] with the usual accommodation.
    pub fn new(name: GasName, pressure: f64) -> Self {
        Self { name, pressure, accommodation: usual_accommodation() }
    }

    pub(crate) fn numbers(&self) -> Vec<Ranged> {
        let accommodation = self.accommodation;
        vec![
            ranged("gas.pressure", self.pressure, POSITIVE),
            (
                "gas.accommodation",
                accommodation,
                ACCOMMODATION.into(),
                accommodation > 0.0 && accommodation <= 1.0,
            ),
        ]
    }
}

impl Vessel {
    pub(crate) fn container(&self) -> Container {
        match (self.base, self.radius) {
            (Some(base), _) if self.endless => Container::Endless { base },
            (Some(base), _) => Container::Box { base },
            (None, radius) => Container::Cylinder { radius: radius.unwrap_or_default() },
        }
    }

    pub(crate) fn check(&self, grains: &Grains) -> Result<(), Wrong> {
        let (value, allowed) = match (self.base, self.radius) {
            (None, Some(_)) if self.endless => ("endless with a radius", "endless with a base"),
            (Some(_), None) | (None, Some(_)) => return self.check_gravity(grains),
            _ => ("both or neither of base and radius", "one of base and radius"),
        };
        Err(("container".into(), value.into(), allowed.into()))
    }

    /// Refuses a gravity so low that the grains would take too many steps to come to rest.
    fn check_gravity(&self, grains: &Grains) -> Result<(), Wrong> {
        let pouring = grains.pouring(0, self.container(), self.gravity, 1);
        let excess = pouring.longest / pouring.step() / MAX_STEPS;
        if excess.is_nan() || excess <= 1.0 {
            return Ok(());
        }
        // The time goes with g^(-1/2), and the time step at most with g^(-1/10).
        let least = self.gravity * excess.powf(2.5);
        let allowed = format!(
            "about {least:.0e} m/s2 at least for these grains, which would take up to {:.0e} steps to come to rest; {MAX_STEPS:.0e} are allowed",
            excess * MAX_STEPS
        );
        Err(("container.gravity".into(), number(self.gravity), allowed))
    }

    pub(crate) fn numbers(&self, grains: &Grains) -> Vec<Ranged> {
        let (d, count) = (grains.diameter * grains.moments().largest, grains.number as f64);
        let base = self.base.unwrap_or([2.0 * d; 2]);
        let radius = self.radius.unwrap_or(d);
        // The other one of base and radius is just large enough.
        let floor =
            (base[0] * base[1]).max(PI * radius * radius) / (count * grains.diameter * grains.diameter);
        // A grain must not meet two images of another.
        let (least, narrow) = match self.endless {
            false => (2.0, TWO_DIAMETERS),
            true => (2.5, MORE_DIAMETERS),
        };
        vec![
            ranged("container.gravity", self.gravity, POSITIVE),
            ranged("container.height", self.height.unwrap_or(1.0), POSITIVE),
            ranged("container.porosity", self.porosity.unwrap_or(0.4), [0.2, 0.7]),
            ("container.base", base[0], narrow.into(), self.base.is_none() || base[0] >= least * d),
            ("container.base", base[1], narrow.into(), self.base.is_none() || base[1] >= least * d),
            ("container.radius", radius, ONE_DIAMETER.into(), radius >= d),
            (
                if self.base.is_some() { "container.base" } else { "container.radius" },
                if self.base.is_some() { base[0].max(base[1]) } else { radius },
                WIDE.into(),
                floor.is_finite() && floor <= WIDEST.max(4.0 / count),
            ),
        ]
    }
}
