//! Plans of discs, as the parts that are common to all plans need them.

use super::block::AnyBlock;
use super::plan::{Job, Kind, Plan, RampName};
use super::recipe::Recipe;
use super::record::Record;
use super::rows::rows;
use super::seed::{check_count, packing_seed};
use super::{Dataset, ENGINE_VERSION, Violation, check};
use crate::{Compression, PackingSpec, Preparation};

/// Width over height of the boxes of `[[wall_shear]]`.
const SHEAR_ASPECT: f64 = 2.0;

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
