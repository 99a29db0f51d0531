//! The sections of a bed that some ways to compute it have: lid, walls, plate, flow, times, what is recorded, what the solver needs.

use super::grains::absent;
use crate::schedule::Schedule;
use crate::units::{kelvin, kelvin_over_time};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Least height of a region of averages in diameters, and least number of spheres in it. Layers next to a plate alternate every 0.82
/// diameters; of 30 spheres, with some 70 contacts, a mean stress scatters by about 15 %, as forces scatter about as much as their mean.
pub(super) const MIN_HEIGHT: f64 = 2.0;
pub(super) const MIN_SPHERES: f64 = 30.0;
/// What numbers may be.
pub(super) const STRAINS: [f64; 2] = [-0.2, 0.2];
pub(super) const SOURCES: [f64; 2] = [0.0, 1e12];
pub(super) const STEPS: [f64; 2] = [100.0, 10_000_000.0];
pub(super) const INTERVAL: &str = "a hundred-thousandth of end, to output_every";
pub(super) const OUTPUT_EVERY: &str = "interval to end";
pub(super) const POROSITIES: [f64; 2] = [0.35, 0.7];

/// The lid: pressed on, while grains that move harden, and then at rest or moved.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lid {
    /// Pressure with which the lid is pressed on before the start \[Pa\]. Allowed: `POSITIVE`. Default: this or `porosity`.
    pub pressure: Option<f64>,
    /// Share of the pores in the volume between floor and lid at which the lid stops, with a `plate` alone. Its pressure then is that of
    /// spheres with `simulated_young_modulus`, and in proportion to it. Allowed: `POROSITIES`. Default: this or `pressure`.
    pub porosity: Option<f64>,
    /// Over time: how far it has moved towards the spheres since the start, over the depth of the bed. Allowed: `STRAINS`.
    /// Default: it stays where it is.
    pub strain: Option<Schedule>,
    /// Over time: the constant pressure of the lid, instead of `strain` \[Pa\]. Allowed: `POSITIVE`; by `case new`
    /// `pressure`. Default: it stays where it is.
    pub pressing: Option<Schedule>,
}

impl Lid {
    /// Its height above the floor \[m\], if a porosity is given, for a volume of grains \[m³\] on an area \[m²\].
    pub fn depth(&self, solid: f64, area: f64) -> Option<f64> {
        self.porosity.map(|porosity| solid / (area * (1.0 - porosity)))
    }
}

/// A wall that heat passes: of given temperature, or for the solver alone with a heat transfer coefficient or a heat flux.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Heated {
    /// Name of the wall. Allowed: a wall of the container.
    pub wall: String,
    /// Its temperature over time; each may be a text with a unit, as `"80C"` \[K\]. Allowed: `TEMPERATURES`. Default: this, or `flux`,
    /// or `coefficient` and `outside`.
    #[serde(default, deserialize_with = "kelvin_over_time", skip_serializing_if = "Option::is_none")]
    pub temperature: Option<Schedule>,
    /// Heat transfer coefficient to the outside, for the solver alone [W/(m² K)]. Default: none.
    pub coefficient: Option<f64>,
    /// Temperature outside \[K\]. Default: required with `coefficient`.
    pub outside: Option<f64>,
    /// Heat flux into the bed, for the solver alone [W/m²]. Default: none.
    pub flux: Option<f64>,
    /// Whether heat passes through the contacts and the gas between the wall and each sphere; the surface of the wall has one temperature,
    /// and the stiffness and asperities of the spheres. Allowed: `true`, `false`: spheres whose centre is within a diameter of the wall
    /// have its temperature.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub resists: bool,
}

impl Heated {
    /// A wall of this temperature.
    pub fn new(wall: &str, temperature: Schedule) -> Self {
        Self { wall: wall.to_string(), temperature: Some(temperature), ..Self::default() }
    }

    /// Its temperature at a time \[s\], of a wall that has one.
    pub fn at(&self, time: f64) -> f64 {
        self.temperature.as_ref().map_or(f64::NAN, |temperature| temperature.at(time))
    }
}

/// Gas that flows through the bed from one end to the other.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Flow {
    /// Mass flow through the whole bed [kg/s]. Allowed: above 0, to 1e6.
    pub mass: f64,
    /// Temperature of the gas that enters, a number or a text with a unit \[K\]. Allowed: where the gas is known.
    #[serde(deserialize_with = "kelvin")]
    pub temperature: f64,
    /// Where it enters. Default: `top`.
    #[serde(default)]
    pub from: End,
}

/// An end of the bed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    #[default]
    Top,
    Bottom,
}

impl Flow {
    /// Names of the walls where the gas enters and leaves, in the solver's mesh.
    pub fn ends(&self) -> [&'static str; 2] {
        if self.from == End::Bottom { ["bottom", "top"] } else { ["top", "bottom"] }
    }
}

/// The wall that is heated.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlateKeys {
    /// The wall that is heated. Allowed: a flat wall that the bed touches; with `pressure`, not the one on which the bed rests.
    pub wall: String,
    /// Its temperature from t = 0 on, a number or a text with a unit, as `"80C"` \[K\]. Allowed: `TEMPERATURES`.
    #[serde(deserialize_with = "kelvin")]
    pub temperature: f64,
    /// Pressure with which it is pressed onto the bed before that \[Pa\]. Allowed: `POSITIVE`. Default: it stays where it is.
    pub pressure: Option<f64>,
    /// Young's modulus of its material \[Pa\]. Allowed: `POSITIVE`.
    pub young_modulus: f64,
    /// Poisson's ratio of its material. Allowed: `POISSON_RATIOS`.
    pub poisson_ratio: f64,
    /// Thermal conductivity of its material [W/(m K)]. Allowed: `POSITIVE`. Default: its surface has one temperature.
    pub conductivity: Option<f64>,
    /// σ/m of a grain and the plate \[m\]. Allowed: 0 (smooth), or `POSITIVE`. Default: smooth.
    pub roughness: Option<f64>,
    /// Hardness of the softer of the two \[Pa\]. Allowed: `POSITIVE`; required with a roughness above 0.
    pub hardness: Option<f64>,
    /// Emissivity of its surface, which radiates to grains that do. Allowed: 0 (reflects everything), or `RADIATING`. Default: that
    /// of the grains.
    pub emissivity: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Turn {
    /// The wall that is the floor afterwards. Allowed: a flat wall.
    pub down: String,
}

/// The compliant side of a cylinder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shell {
    /// Young's modulus E_w of the side of the cylinder. Its radius R grows by R²/(E_w t) times the pressure beyond that of the
    /// start \[Pa\]. Allowed: `POSITIVE`.
    pub young_modulus: f64,
    /// Its thickness t \[m\]. Allowed: `POSITIVE`.
    pub thickness: f64,
    /// Its linear coefficient of thermal expansion, by which it grows around and, if spheres rub on it, along its axis, from the floor on; it has the temperature of the heated wall `side`, else the initial one
    /// [1/K]. Allowed: `EXPANSIONS`.
    #[serde(default)]
    pub thermal_expansion: f64,
}

/// Strain of the base of a bed without sides (`container.endless`).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sides {
    /// Over time: extension of the base along x since the start, over its length \[-\]. Allowed: `STRAINS`.
    pub strain_x: Schedule,
    /// The same along y. Allowed: `STRAINS`.
    pub strain_y: Schedule,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Time {
    /// Temperature of all spheres at the start, a number or a text with a unit \[K\]. Allowed: `TEMPERATURES`.
    #[serde(deserialize_with = "kelvin")]
    pub initial_temperature: f64,
    /// End of the run \[s\]. Allowed: `POSITIVE`.
    pub end: f64,
    /// Time between two changes of radii, walls and contacts, of spheres that move: heat flows, then grains grow and walls move. Heated
    /// walls have the temperature of the middle of each interval, so it has to be short where that changes fast \[s\]. Allowed:
    /// `INTERVAL`. Default: a fortieth of `end`, or less.
    #[serde(default = "absent", skip_serializing_if = "is_absent")]
    pub interval: f64,
    /// Steps of DEM in each interval, at least; where the bed lags there are more. Allowed: `STEPS`. Default: 4000.
    #[serde(default = "usual_steps")]
    pub steps: u64,
    /// Time between two rows of the results \[s\]. Allowed: `OUTPUT_EVERY`. Default: a fortieth of `end`.
    #[serde(default = "absent")]
    pub output_every: f64,
    /// Estimated error of T that a step of heat may make \[K\]. Allowed: `POSITIVE`. Default: 0.02; 0.05 with a `plate`.
    #[serde(default = "absent")]
    pub tolerance: f64,
}

impl Time {
    /// From a temperature \[K\] to an end \[s\].
    pub fn new(initial_temperature: f64, end: f64) -> Self {
        let [interval, output_every, tolerance] = [absent(); 3];
        Self { initial_temperature, end, interval, steps: usual_steps(), output_every, tolerance }
    }
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RecordKeys {
    /// The wall from which distances are counted. Allowed: a wall of the container; with a `plate` that one. Default: with a
    /// `plate` required; else the first heated one, or the floor.
    pub wall: String,
    /// Distances at which T is recorded: the value there of a straight line through the spheres within 1.5 diameters, from `side`
    /// those between `heights` \[m\]. Allowed: where there are spheres. Default: half of the bed; with a `plate` required.
    pub distances: Vec<f64>,
    /// Two heights above the floor, between which averages are taken \[m\]. Allowed: rising, `MIN_HEIGHT` diameters apart at
    /// least, within the bed; about `MIN_SPHERES` spheres at least between them. Default: two diameters off the ends; none with a `plate`.
    pub heights: [f64; 2],
    /// In a cylinder, the distance from the axis within which averages are taken \[m\]. Allowed: a diameter to the radius of the
    /// container. Default: with `heights` required in a cylinder, else two diameters off its side.
    pub radius: Option<f64>,
}

/// What a case of the solver needs beyond the bed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SolverKeys {
    /// Cells along x, y and z, or along radius and axis. Default: a proposal.
    pub cells: Option<Vec<usize>>,
    /// Whether the spheres move. Default: `equilibrium`.
    pub mechanics: Option<Mechanics>,
    /// Slack of the spheres at bottom and top where these stay \[diameters\]. Default: 1; 0 under a lid that presses.
    pub slack_layer: Option<f64>,
    /// Material of the walls that heat passes: `steel`, `stainless-steel`, `aluminium`, `glass`, or `none`. Default: `steel`.
    pub wall_material: Option<String>,
    /// Largest error of T that a time step may add \[K\]. Default: a thousandth of the range of T.
    pub tolerance: Option<f64>,
    /// Whether the run ends before `end`, once it is steady. Default: `false`.
    pub steady: bool,
    /// Points where T is recorded: x, y, z, or distance from the axis and height \[m\]. Default: three points.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub probes: Vec<Vec<f64>>,
}

impl SolverKeys {
    pub(super) fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// Whether the grains move until the stress is in equilibrium.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Mechanics {
    /// The grains do not move: the paper's algorithm.
    None,
    #[default]
    Equilibrium,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExperimentKeys {
    /// A CSV file in the folder of the case: the header `distance_m,time_s,temperature_C`, then one measurement a line; lines
    /// that begin with `#` are comments. Allowed: each distance is one of `record.distances`.
    pub file: PathBuf,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vary {
    /// The value that is changed, as `seed` or `gas.accommodation`; the bed is poured again if its packing depends on it.
    /// Allowed: any key but `experiment.file`.
    pub key: String,
    /// The other value. Allowed: as for the key.
    pub value: toml::Value,
}

fn usual_steps() -> u64 {
    4000
}

fn is_absent(value: &f64) -> bool {
    value.is_nan()
}

/// Beginnings of the keys that the packing does not depend on.
const HEAT_ONLY: [&str; 15] = [
    "grains.conductivity",
    "grains.heat_capacity",
    "grains.young_modulus",
    "grains.roughness",
    "grains.hardness",
    "grains.yield_stress",
    "gas.",
    "time.",
    "record.",
    "plate.temperature",
    "plate.conductivity",
    "plate.young_modulus",
    "plate.poisson_ratio",
    "plate.roughness",
    "plate.hardness",
];

impl Vary {
    /// Whether the bed has to be poured again.
    pub fn changes_packing(&self) -> bool {
        !HEAT_ONLY.iter().any(|key| self.key.starts_with(key))
    }
}
