//! What to make: a TOML file.

use super::DatabaseError;
use crate::{Boundary, Compression, Material, PackingSpec};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// A plan: every porosity with every compression, `repeats` packings each, and every strain for each packing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Discs in a packing.
    pub discs: usize,
    /// Radii are uniform between these [m].
    pub radius_min: f64,
    pub radius_max: f64,
    /// Seed of the whole plan.
    pub seed: u64,
    /// Target porosities of the packings, whole box, overlaps counted once [-].
    pub porosities: Vec<f64>,
    pub compressions: Vec<Compression>,
    /// Packings for each porosity and compression.
    pub repeats: u32,
    /// Thermal strains relative to the packed state [-], both signs, in any order.
    pub strains: Vec<f64>,
    /// Grain material.
    #[serde(default)]
    pub material: Material,
    /// The text the plan was read from; what the hash is of.
    #[serde(skip)]
    pub text: String,
}

/// One packing of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Job {
    /// Index in the plan.
    pub packing: i64,
    pub spec: PackingSpec,
}

impl Plan {
    /// Reads a plan. `file` names it in errors.
    pub fn parse(text: &str, file: &str) -> Result<Self, DatabaseError> {
        let problem = |problem: String| DatabaseError::Plan { file: file.to_string(), problem };
        let mut plan: Self = toml::from_str(text).map_err(|error| problem(error.to_string()))?;
        plan.text = text.to_string();
        plan.check().map_err(problem)?;
        Ok(plan)
    }

    /// SHA-256 of the plan's text, hexadecimal.
    pub fn hash(&self) -> String {
        Sha256::digest(self.text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
    }

    fn check(&self) -> Result<(), String> {
        self.material.check().map_err(|error| error.to_string())?;
        if self.porosities.is_empty() || self.compressions.is_empty() || self.repeats == 0 {
            return Err("porosities, compressions and repeats: at least one of each is needed".into());
        }
        for job in self.jobs() {
            job.spec.check().map_err(|error| error.to_string())?;
        }
        for &strain in &self.strains {
            if !(strain.abs() <= 0.2 && strain != 0.0) {
                return Err(format!(
                    "strains: {strain}, allowed: -0.2 to 0.2 without 0 (it is always there)"
                ));
            }
        }
        let (up, down) = self.ramps();
        if up.windows(2).chain(down.windows(2)).any(|pair| pair[0] == pair[1]) {
            return Err(format!("strains: {:?} holds a value twice", self.strains));
        }
        Ok(())
    }

    /// The packings, in order of porosity, compression, repeat.
    pub fn jobs(&self) -> Vec<Job> {
        let mut jobs = Vec::new();
        for &porosity in &self.porosities {
            for &compression in &self.compressions {
                for _ in 0..self.repeats {
                    let packing = jobs.len() as i64;
                    let spec = PackingSpec {
                        discs: self.discs,
                        seed: packing_seed(self.seed, packing as u64),
                        porosity,
                        compression,
                        radius_min: self.radius_min,
                        radius_max: self.radius_max,
                        boundary: Boundary::Walls,
                    };
                    jobs.push(Job { packing, spec });
                }
            }
        }
        jobs
    }

    /// Stops of the expansion and of the contraction ramp, growing in magnitude.
    pub fn ramps(&self) -> (Vec<f64>, Vec<f64>) {
        let mut up: Vec<f64> = self.strains.iter().copied().filter(|&s| s > 0.0).collect();
        let mut down: Vec<f64> = self.strains.iter().copied().filter(|&s| s < 0.0).collect();
        up.sort_by(f64::total_cmp);
        down.sort_by(|a, b| b.total_cmp(a));
        (up, down)
    }

    /// Rows that the plan makes.
    pub fn rows(&self) -> usize {
        self.jobs().len() * (self.strains.len() + 1)
    }
}

/// Seed of one packing: depends on the plan's seed and the index only, not on order or threads. 53 bits, so that CSV
/// readers which hold numbers as f64 keep it.
fn packing_seed(plan_seed: u64, packing: u64) -> u64 {
    let mut bytes = plan_seed.to_le_bytes().to_vec();
    bytes.extend(packing.to_le_bytes());
    let digest = Sha256::digest(&bytes);
    let first = digest.iter().take(8).fold(0u64, |value, &byte| value << 8 | u64::from(byte));
    first >> 11
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "discs = 100\nradius_min = 3e-3\nradius_max = 7e-3\nseed = 1\nporosities = [0.1, 0.15]\n\
                        compressions = [\"isotropic\", \"horizontal\"]\nrepeats = 2\nstrains = [0.01, -0.01, 0.002]\n";

    fn error(text: &str) -> String {
        Plan::parse(text, "plan.toml").unwrap_err().to_string()
    }

    #[test]
    fn a_plan_lists_its_packings_and_ramps() {
        let plan = Plan::parse(GOOD, "plan.toml").unwrap();
        assert_eq!(plan.jobs().len(), 8);
        assert_eq!(plan.ramps(), (vec![0.002, 0.01], vec![-0.01]));
        assert_eq!(plan.rows(), 32);
        assert_ne!(plan.jobs()[0].spec.seed, plan.jobs()[1].spec.seed);
        assert!(plan.jobs().iter().all(|job| job.spec.seed < 1 << 53));
    }

    #[test]
    fn bad_plans_name_file_key_and_range() {
        assert!(error(&GOOD.replace("repeats", "repeat")).contains("plan.toml: TOML parse error"));
        assert!(error(&GOOD.replace("repeats", "repeat")).contains("unknown field `repeat`"));
        assert!(error(&GOOD.replace("0.15]", "0.5]")).contains("porosity = 0.5, allowed: 0.01 to 0.3"));
        assert!(error(&GOOD.replace("0.002]", "0.01]")).contains("holds a value twice"));
        assert!(error(&GOOD.replace("0.002]", "0.9]")).contains("strains: 0.9, allowed: -0.2 to 0.2"));
        assert!(
            error(&format!(
                "{GOOD}[material]\ndensity = -1\nyoung_modulus = 1e7\nstiffness_ratio = 0.8\n\
            friction_angle = 0.5\nwall_stiffness_factor = 1\ndamping = 0.1"
            ))
            .contains("density = -1, allowed: > 0")
        );
    }
}
