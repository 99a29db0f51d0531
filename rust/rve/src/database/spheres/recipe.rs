//! Plans of spheres, as the parts that are common to all plans need them.

use super::check;
use super::kind::{PathName, SphereCompression};
use super::paths::Steps;
use super::plan::{POISSON_RATIOS, RESTITUTIONS, SphereBlock, SphereJob, SpherePlan};
use super::record::SphereRecord;
use super::rows::rows;
use crate::database::recipe::Recipe;
use crate::database::seed::{check_count, packing_seed};
use crate::database::{Dataset, Violation};
use crate::spheres::Preparation;
use crate::spheres::prepare::MAX_FRICTION;

impl SpherePlan {
    fn job(
        &self,
        packing: u64,
        block: &SphereBlock,
        (packing_friction, compression, pressure): (f64, SphereCompression, f64),
    ) -> SphereJob {
        let seed = packing_seed(self.seed, packing);
        SphereJob {
            packing: packing as i64,
            compression,
            preparation: Preparation {
                spheres: block.spheres,
                seed,
                sizes: block.sizes.clone(),
                poisson_ratio: self.poisson_ratio,
                restitution: self.restitution,
                packing_friction,
                friction: self.friction,
                rates: compression.rates(),
                shaking: block.shaking,
                pressure,
            },
            paths: block.paths.clone(),
            steps: Steps { seed, pressure, strain: block.strain, size: block.step, cycles: block.cycles },
        }
    }
}

impl Recipe for SpherePlan {
    type Row = SphereRecord;
    type Job = SphereJob;
    const ENGINE_VERSION: i64 = 1;

    fn check(&self) -> Result<(), String> {
        if !(0.0..=MAX_FRICTION).contains(&self.friction) {
            return Err(format!("friction: {}, allowed: 0 to {MAX_FRICTION}", self.friction));
        }
        for (key, value, [least, most]) in [
            ("poisson_ratio", self.poisson_ratio, POISSON_RATIOS),
            ("restitution", self.restitution, RESTITUTIONS),
        ] {
            if !(least..=most).contains(&value) {
                return Err(format!("{key}: {value}, allowed: {least} to {most}"));
            }
        }
        if self.spheres.is_empty() {
            return Err("at least one block of packings is needed".to_string());
        }
        for (block, number) in self.spheres.iter().zip(1..) {
            block.check(self.friction).map_err(|problem| format!("[[spheres]] {number}: {problem}"))?;
        }
        check_count(self.spheres.iter().map(|block| block.count(self.friction)))
    }

    fn with_text(mut self, text: String) -> Self {
        self.text = text;
        self
    }

    fn text(&self) -> &str {
        &self.text
    }

    fn grains(&self) -> Vec<(&'static str, String)> {
        let material = serde_json::json!({
            "friction": self.friction,
            "poisson_ratio": self.poisson_ratio,
            "restitution": self.restitution,
        });
        vec![("grains", "spheres".to_string()), ("material", material.to_string())]
    }

    /// The packings, in order of block, repeat, friction, compression, pressure: so that any first part of a block has all
    /// kinds.
    fn jobs(&self) -> Vec<SphereJob> {
        let mut jobs = Vec::new();
        for block in &self.spheres {
            for _ in 0..block.repeats {
                for &packing_friction in &block.frictions(self.friction) {
                    for &compression in &block.compressions {
                        for &pressure in &block.pressures {
                            let packing = jobs.len() as u64;
                            jobs.push(self.job(packing, block, (packing_friction, compression, pressure)));
                        }
                    }
                }
            }
        }
        jobs
    }

    fn packing(job: &SphereJob) -> (i64, u64) {
        (job.packing, job.preparation.seed)
    }

    fn places(job: &SphereJob) -> Vec<(PathName, i64)> {
        job.rows()
    }

    fn make(&self, job: &SphereJob) -> Vec<SphereRecord> {
        rows(job)
    }

    fn violations(dataset: &Dataset<SphereRecord>) -> Vec<Violation> {
        check::check(dataset).violations
    }
}
