//! A plan of packings and ramps: a TOML file with blocks `[[thermal]]`, `[[mechanics]]`, `[[wall_shear]]` and `[[paths]]`.

use super::block::AnyBlock;
use super::paths::{Planned, Steps, planned};
use super::recipe::{Recipe, check_count};
use super::record::Record;
use super::rows::rows;
use super::seed::packing_seed;
use super::{Dataset, ENGINE_VERSION, Violation, check};
use crate::{Compression, Material, PackingSpec, Preparation, Relaxation};
use serde::{Deserialize, Serialize};

pub use super::block::{Block, PathBlock};
pub use super::kind::{Kind, RampName};

/// Width over height of the boxes of `[[wall_shear]]`.
const SHEAR_ASPECT: f64 = 2.0;

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
    /// All blocks, with their number among the blocks of the same kind.
    fn blocks(&self) -> impl Iterator<Item = (usize, AnyBlock<'_>)> {
        let lists = [
            (Kind::Thermal, &self.thermal),
            (Kind::Mechanics, &self.mechanics),
            (Kind::WallShear, &self.wall_shear),
        ];
        let ramps = lists.into_iter().flat_map(|(kind, list)| {
            list.iter().enumerate().map(move |(k, block)| (k + 1, AnyBlock::Ramps(kind, block)))
        });
        let paths = self.paths.iter().enumerate().map(|(k, block)| (k + 1, AnyBlock::Paths(block)));
        ramps.chain(paths)
    }

    fn job(
        &self,
        packing: u64,
        block: AnyBlock,
        (porosity, compression, friction_angle): (f64, Compression, f64),
    ) -> Job {
        let kind = block.kind();
        let spec = PackingSpec {
            discs: block.packings().discs,
            seed: packing_seed(self.seed, packing),
            porosity,
            compression,
            radius_min: self.radius_min,
            radius_max: self.radius_max,
            boundary: block.packings().boundary,
            relaxation: self.relaxation,
        };
        let aspect = if kind == Kind::WallShear { SHEAR_ASPECT } else { 1.0 };
        let preparation =
            Preparation { friction_angle: Some(friction_angle), aspect, ..Preparation::default() };
        let job = Job { packing: packing as i64, kind, spec, preparation, ..Job::default() };
        match block {
            AnyBlock::Paths(block) => Job { ramps: block.paths.clone(), steps: Some(block.steps()), ..job },
            AnyBlock::Ramps(kind, block) => {
                let back = || block.stops.iter().rev().skip(1).copied().chain([0.0]).collect();
                let given = !block.return_stops.is_empty();
                Job {
                    ramps: block.ramps(kind).to_vec(),
                    stops: block.stops.clone(),
                    return_stops: if given { block.return_stops.clone() } else { back() },
                    release_walls: block.release_walls,
                    ..job
                }
            }
        }
    }

    /// Mean of the radius distribution \[m\].
    pub fn mean_radius(&self) -> f64 {
        0.5 * (self.radius_min + self.radius_max)
    }
}

impl Recipe for Plan {
    type Row = Record;
    type Job = Job;
    const ENGINE_VERSION: i64 = ENGINE_VERSION;

    fn check(&self) -> Result<(), String> {
        self.material.check().map_err(|error| error.to_string())?;
        for (number, block) in self.blocks() {
            let within = |problem| format!("[[{}]] {number}: {problem}", block.kind());
            block.check().map_err(within)?;
        }
        check_count(self.blocks().map(|(_, block)| block.packings().count()))?;
        let jobs = self.jobs();
        if jobs.is_empty() {
            return Err("at least one block of packings is needed".to_string());
        }
        jobs.iter().try_for_each(|job| job.spec.check().map_err(|error| error.to_string()))
    }

    fn with_text(mut self, text: String) -> Self {
        self.text = text;
        self
    }

    fn text(&self) -> &str {
        &self.text
    }

    fn grains(&self) -> Vec<(&'static str, String)> {
        vec![
            ("material", serde_json::json!(self.material).to_string()),
            ("radius_distribution", "uniform".to_string()),
            ("radius_min", self.radius_min.to_string()),
            ("radius_max", self.radius_max.to_string()),
            ("mean_radius", self.mean_radius().to_string()),
        ]
    }

    /// The packings, in order of block, porosity, compression, packing friction, repeat.
    fn jobs(&self) -> Vec<Job> {
        let mut jobs = Vec::new();
        for (_, block) in self.blocks() {
            let packings = block.packings();
            for &porosity in packings.porosities {
                for &compression in packings.compressions {
                    for &friction in &packings.frictions(&self.material) {
                        for _ in 0..packings.repeats {
                            let packing = jobs.len() as u64;
                            jobs.push(self.job(packing, block, (porosity, compression, friction)));
                        }
                    }
                }
            }
        }
        jobs
    }

    fn packing(job: &Job) -> (i64, u64) {
        (job.packing, job.spec.seed)
    }

    fn places(job: &Job) -> Vec<(RampName, i64)> {
        job.rows()
    }

    fn cost(job: &Job) -> usize {
        job.spec.discs * job.rows().len()
    }

    fn make(&self, job: &Job) -> Vec<Record> {
        rows(self, job)
    }

    fn violations(dataset: &Dataset) -> Vec<Violation> {
        check::violations(dataset)
    }
}

#[cfg(test)]
#[path = "plan_tests.rs"]
mod tests;
