//! A plan of packings of spheres and of the paths that they follow: a TOML file with blocks `[[spheres]]`.

use super::kind::{PathName, SphereCompression};
use super::paths::{Planned, Steps, planned};
use crate::spheres::Preparation;
use crate::spheres::prepare::{PACKED_PRESSURES, SHAKING, SPHERES};
use msdd_beds::sizes::Sizes;
use serde::{Deserialize, Serialize};

/// Sizes that increments and whole paths may have \[-\].
const STEPS: [f64; 2] = [1e-5, 1e-2];
const STRAINS: [f64; 2] = [1e-4, 5e-2];
pub(super) const POISSON_RATIOS: [f64; 2] = [0.0, 0.5];
pub(super) const RESTITUTIONS: [f64; 2] = [0.001, 1.0];
/// Times that a path may go there and back.
const CYCLES: [u32; 2] = [1, 1000];
/// A plan: blocks of packings, each of which follows paths.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpherePlan {
    /// Number from which the random places of all packings and their random paths follow. Allowed: whole number from 0.
    pub seed: u64,
    /// Friction of the spheres on the paths. Allowed: 0 to `MAX_FRICTION`.
    #[serde(default = "usual_friction")]
    pub friction: f64,
    /// Poisson's ratio ν. Allowed: `POISSON_RATIOS`.
    #[serde(default = "usual_poisson_ratio")]
    pub poisson_ratio: f64,
    /// Speed after a collision over the speed before: only how fast boxes come to rest. Allowed: `RESTITUTIONS`.
    #[serde(default = "usual_restitution")]
    pub restitution: f64,
    /// Blocks of packings.
    pub spheres: Vec<SphereBlock>,
    /// The text that the plan was read from.
    #[serde(skip)]
    pub text: String,
}

/// Packings of one size: every friction while packing with every compression and pressure, `repeats` of each.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SphereBlock {
    /// Spheres in a packing. Allowed: `SPHERES`.
    pub spheres: usize,
    /// Distribution of the diameters: `uniform`, `normal`, `log_normal` or `sieve`, as `sizes` of `bed.toml`. Lengths are over their
    /// Sauter mean. The law is not trained on unequal spheres. Default: equal spheres.
    pub sizes: Option<Sizes>,
    /// Frictions while the box closes: 0 packs densest (0.63 to 0.64 of the space), 0.3 looser (0.58). Not above `friction`: a
    /// packing whose friction falls collapses. Allowed: 0 to `friction`. Default: `friction` alone.
    #[serde(default)]
    pub packing_frictions: Vec<f64>,
    /// How far packed boxes are opened along all axes to be shaken: their spheres are mixed by random velocities, and the boxes are
    /// pressed again with `friction`; 0: they are not. So they are dense though every contact was made under friction. They are
    /// softer than beds that were poured, and the shipped law was not trained on them. Allowed: 0, or `SHAKING`.
    #[serde(default)]
    pub shaking: f64,
    /// How the boxes close.
    pub compressions: Vec<SphereCompression>,
    /// Pressures over E* of the packed states: 1e-8 is a bed of steel under its own weight, 1e-3 what a hundred kelvin do to a bed
    /// between fixed walls. Boxes are packed at 1e-6 at least and opened to what is below; those that are shaken are pressed to the
    /// pressure itself. Allowed: `PACKED_PRESSURES`.
    pub pressures: Vec<f64>,
    /// Packings of each kind. Allowed: 1 or more.
    pub repeats: u32,
    /// Paths that every packing follows, each at most once and each from the packed state.
    pub paths: Vec<PathName>,
    /// How far a path goes. Allowed: `STRAINS`.
    #[serde(default = "usual_strain")]
    pub strain: f64,
    /// Size of an increment. The first ones are smaller: half of (p/E*)^(2/3), the strain that changes the pressure much, or an
    /// eighth of `step` after a turn; then each is 1.5 times the one before. Allowed: `STEPS`.
    #[serde(default = "usual_step")]
    pub step: f64,
    /// How often a path that goes there and back does so, before it goes there once more. Allowed: `CYCLES`.
    #[serde(default = "usual_cycles")]
    pub cycles: u32,
}

fn usual_friction() -> f64 {
    0.3
}

fn usual_poisson_ratio() -> f64 {
    0.25
}

fn usual_restitution() -> f64 {
    0.3
}

fn usual_strain() -> f64 {
    0.01
}

fn usual_step() -> f64 {
    5e-4
}

fn usual_cycles() -> u32 {
    1
}

/// One packing of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereJob {
    /// Index in the plan.
    pub packing: i64,
    pub compression: SphereCompression,
    pub preparation: Preparation,
    pub paths: Vec<PathName>,
    pub steps: Steps,
}

impl SphereJob {
    /// The rows of a path, in the order in which they are made.
    pub fn path(&self, path: PathName) -> Vec<Planned> {
        planned(path, &self.steps)
    }

    /// Every row that the packing has, in order: path and stop.
    pub fn rows(&self) -> Vec<(PathName, i64)> {
        let mut rows = vec![(PathName::Packed, 0)];
        for &path in &self.paths {
            rows.extend(self.path(path).into_iter().map(|planned| (path, planned.stop)));
        }
        rows
    }
}

impl SpherePlan {
    /// Whether the text of a plan has blocks of spheres.
    pub fn has_sphere_schema(text: &str) -> bool {
        text.parse::<toml::Table>().is_ok_and(|table| table.contains_key("spheres"))
    }
}

impl SphereBlock {
    pub(super) fn frictions(&self, friction: f64) -> Vec<f64> {
        if self.packing_frictions.is_empty() { vec![friction] } else { self.packing_frictions.clone() }
    }

    pub(super) fn count(&self, friction: f64) -> u64 {
        let factors = [self.frictions(friction).len(), self.compressions.len(), self.pressures.len()];
        factors.into_iter().fold(u64::from(self.repeats), |count, factor| count.saturating_mul(factor as u64))
    }

    pub(super) fn check(&self, friction: f64) -> Result<(), String> {
        let [least, most] = SPHERES;
        if !(least..=most).contains(&self.spheres) {
            return Err(format!("spheres: {}, allowed: {least} to {most}", self.spheres));
        }
        if let Some(Err(problem)) = self.sizes.as_ref().map(Sizes::check) {
            return Err(format!("sizes: {problem}"));
        }
        if self.compressions.is_empty() || self.pressures.is_empty() || self.repeats == 0 {
            return Err("compressions, pressures and repeats: at least one of each is needed".into());
        }
        // A packing whose friction is lowered afterwards collapses.
        if let Some(value) = self.packing_frictions.iter().find(|value| !(0.0..=friction).contains(*value)) {
            return Err(format!(
                "packing_frictions: {value}, allowed: 0 to the friction of the plan, {friction}"
            ));
        }
        let [least, most] = SHAKING;
        if self.shaking != 0.0 && !(least..=most).contains(&self.shaking) {
            return Err(format!("shaking: {}, allowed: 0, or {least} to {most}", self.shaking));
        }
        let [least, most] = PACKED_PRESSURES;
        if let Some(value) = self.pressures.iter().find(|value| !(least..=most).contains(*value)) {
            return Err(format!("pressures: {value:e}, allowed: {least:e} to {most:e}"));
        }
        for (key, value, [least, most]) in [("strain", self.strain, STRAINS), ("step", self.step, STEPS)] {
            if !(least..=most).contains(&value) {
                return Err(format!("{key}: {value:e}, allowed: {least:e} to {most:e}"));
            }
        }
        let [least, most] = CYCLES;
        if !(least..=most).contains(&self.cycles) {
            return Err(format!("cycles: {}, allowed: {least} to {most}", self.cycles));
        }
        if self.paths.is_empty() {
            return Err("paths: at least one is needed".into());
        }
        for (k, path) in self.paths.iter().enumerate() {
            if *path == PathName::Packed {
                let allowed = PathName::ALL.map(|path| path.to_string()).join(", ");
                return Err(format!("paths: {path}: allowed: {allowed}"));
            }
            if self.paths[..k].contains(path) {
                return Err(format!("paths: {path}: is named twice"));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::database::recipe::Recipe;

    const PLAN: &str = "seed = 5\n[[spheres]]\nspheres = 100\npacking_frictions = [0.0, 0.3]\n\
        compressions = [\"isotropic\", \"sheared\"]\npressures = [1e-6, 1e-4]\nrepeats = 2\npaths = [\"thermal\"]\n";

    #[test]
    fn a_plan_has_every_packing_once_and_its_own_seed() {
        let plan = SpherePlan::parse(PLAN, "plan").unwrap();
        let jobs = plan.jobs();
        assert_eq!(jobs.len(), 16);
        let seeds: std::collections::BTreeSet<u64> = jobs.iter().map(|job| job.preparation.seed).collect();
        assert_eq!(seeds.len(), 16);
        assert_eq!(plan.rows(), jobs.iter().map(|job| job.rows().len()).sum::<usize>());
        assert!(
            SpherePlan::has_sphere_schema(PLAN)
                && !SpherePlan::has_sphere_schema("seed = 5\n[[paths]]\ndiscs = 3\n")
        );
        assert_eq!(jobs[0].preparation.friction, 0.3);
    }

    #[test]
    fn what_is_not_allowed_is_refused_by_file_key_value_and_range() {
        let cases = [
            ("spheres = 100", "spheres = 10", "spheres: 10, allowed: 50 to 1000000"),
            (
                "repeats = ",
                "sizes = { uniform = [1.0, 5.0] }\nrepeats = ",
                "sizes: diameters from 1 to 5, allowed: up to 1:4",
            ),
            ("repeats = ", "shaking = 0.2\nrepeats = ", "shaking: 0.2, allowed: 0, or 0.002 to 0.1"),
            ("[0.0, 0.3]", "[0.4]", "packing_frictions: 0.4, allowed: 0 to the friction of the plan, 0.3"),
            ("[1e-6, 1e-4]", "[1e-9]", "pressures: 1e-9, allowed: 1e-8 to 1e-3"),
            ("[1e-6, 1e-4]", "[]", "at least one of each is needed"),
            ("[\"thermal\"]", "[\"packed\"]", "paths: packed: allowed: isotropic, thermal"),
            ("[\"thermal\"]", "[\"thermal\", \"thermal\"]", "paths: thermal: is named twice"),
            ("[\"thermal\"]", "[\"thermal\"]\nstep = 0.1", "step: 1e-1, allowed: 1e-5 to 1e-2"),
            ("[\"thermal\"]", "[\"thermal\"]\nstrain = 1.0", "strain: 1e0, allowed: 1e-4 to 5e-2"),
            ("[\"thermal\"]", "[\"thermal\"]\ncycles = 0", "cycles: 0, allowed: 1 to 1000"),
            ("[\"thermal\"]", "[\"circle\"]", "unknown variant `circle`"),
            ("seed = 5", "seed = 5\nfriction = 3.0", "friction: 3, allowed: 0 to 2"),
            ("seed = 5", "seed = 5\npoisson_ratio = 0.6", "poisson_ratio: 0.6, allowed: 0 to 0.5"),
            ("seed = 5", "seed = 5\nrestitution = 0.0", "restitution: 0, allowed: 0.001 to 1"),
            ("seed = 5", "seed = 5\nradius_min = 1.0", "unknown field `radius_min`"),
        ];
        for (from, to, expected) in cases {
            let error = SpherePlan::parse(&PLAN.replace(from, to), "my.toml").unwrap_err().to_string();
            assert!(error.starts_with("my.toml: ") && error.contains(expected), "{expected}: {error}");
        }
    }
}
