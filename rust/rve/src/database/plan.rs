//! A plan of packings and ramps: a TOML file with blocks `[[thermal]]`, `[[mechanics]]`, `[[wall_shear]]` and `[[paths]]`.

use super::paths::{Planned, Steps, planned};
use crate::{Material, PackingSpec, Preparation, Relaxation};
use serde::{Deserialize, Serialize};

pub use super::block::{Block, PathBlock};
pub use super::kind::{Kind, RampName};

/// A plan: blocks of packings, each taken through ramps with stops.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Radii are uniform from this \[m\]. Allowed: `RADII`.
    pub radius_min: f64,
    /// To this \[m\]. Allowed: `RADII_ABOVE`.
    pub radius_max: f64,
    /// Number from which the random places and radii of all packings follow. Allowed: whole number from 0.
    pub seed: u64,
    /// How grains come to rest: `damped`, by their own motion with damping; `fire`, by a method of minimisation that is several
    /// times as fast.
    #[serde(default)]
    pub relaxation: Relaxation,
    /// The grains. Default: those of the paper.
    #[serde(default)]
    pub material: Material,
    /// Blocks of packings whose grains grow and shrink while the box stays.
    #[serde(default)]
    pub thermal: Vec<Block>,
    /// Blocks of packings whose box closes, opens or is sheared while the grains keep their size: for what strains of a cell do.
    #[serde(default)]
    pub mechanics: Vec<Block>,
    /// Blocks of packings, in boxes twice as wide as high, whose bottom and top slip along the grains: for the friction of walls.
    #[serde(default)]
    pub wall_shear: Vec<Block>,
    /// Blocks of packings, in periodic boxes, that follow paths of strain of the grains and of the box: for a constitutive law.
    #[serde(default)]
    pub paths: Vec<PathBlock>,
    /// The text that the plan was read from; the provenance has its hash.
    #[serde(skip)]
    pub text: String,
}

/// One packing of a plan.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Job {
    /// Index in the plan.
    pub packing: i64,
    pub kind: Kind,
    pub spec: PackingSpec,
    pub preparation: Preparation,
    /// Ramps, or paths.
    pub ramps: Vec<RampName>,
    /// Magnitudes, growing; see [`Block`]. Empty for paths.
    pub stops: Vec<f64>,
    pub return_stops: Vec<f64>,
    pub release_walls: bool,
    /// How paths are followed; none for ramps.
    pub steps: Option<Steps>,
}

impl Job {
    /// Every row that the packing has, in order: ramp and stop.
    pub fn rows(&self) -> Vec<(RampName, i64)> {
        let mut rows = vec![(RampName::Packed, 0)];
        for &ramp in &self.ramps {
            rows.extend(self.stops_of(ramp).into_iter().map(|(stop, _)| (ramp, stop)));
        }
        rows
    }

    /// The rows of a path, in the order in which they are made; none of a ramp. The packed state is probed in the first
    /// path only, since the others would find the same.
    pub fn path(&self, path: RampName) -> Vec<Planned> {
        let first = self.ramps.first() == Some(&path);
        self.steps.as_ref().map_or_else(Vec::new, |steps| planned(path, self.spec.seed, steps, first))
    }

    /// Stops of a ramp: index and signed value, which is 0 for paths ([`Job::path`] has their strains).
    pub fn stops_of(&self, ramp: RampName) -> Vec<(i64, f64)> {
        let numbered = |values: &[f64], sign: f64| -> Vec<(i64, f64)> {
            values.iter().zip(1..).map(|(&value, stop)| (stop, sign * value + 0.0)).collect()
        };
        match ramp {
            RampName::Packed => vec![(0, 0.0)],
            RampName::Up | RampName::WallShear => numbered(&self.stops, 1.0),
            RampName::Down => numbered(&self.stops, -1.0),
            RampName::UpDown => numbered(&self.return_stops, 1.0),
            RampName::DownUp => numbered(&self.return_stops, -1.0),
            RampName::Xx | RampName::Yy | RampName::Xy => {
                let closing = numbered(&self.stops, -1.0).into_iter().map(|(stop, strain)| (-stop, strain));
                closing.chain(numbered(&self.stops, 1.0)).collect()
            }
            path => self.path(path).iter().map(|planned| (planned.stop, 0.0)).collect(),
        }
    }
}

impl Plan {
    /// Mean of the radius distribution \[m\].
    pub fn mean_radius(&self) -> f64 {
        0.5 * (self.radius_min + self.radius_max)
    }
}

#[cfg(test)]
#[path = "plan_tests.rs"]
mod tests;
