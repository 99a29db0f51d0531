//! Active learning: states in which a solver asked a model outside of its trained range (offenders) become a plan of
//! new RVEs.

use super::{DatabaseError, Plan, Recipe, plan::Block};
use crate::{Boundary, Compression};
use serde::Deserialize;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// Name of the schema. Its number is increased when a reader of the old schema would misread the new one.
pub const SCHEMA: &str = "msdd-offenders-1";

/// `offenders.json`, as `msddFoam` writes it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Offenders {
    pub schema: String,
    /// SHA-256 of the model that the solver used.
    pub model_hash: String,
    /// Columns of `state`; "porosity" and "fabric_index" are among them.
    pub state_names: Vec<String>,
    pub rows: Vec<Offender>,
}

/// One query outside the trained range.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Offender {
    /// State before the step, in the units of the model's inputs.
    pub state: Vec<f64>,
    /// Thermal strain of the step [-].
    pub strain: f64,
    /// The input that lay outside of its range: a name of the state, or "thermal_strain".
    pub column: String,
    /// Whether it lay below or above its range.
    pub side: Side,
    /// Distance from the range [unit of that input], above 0.
    pub distance: f64,
    /// Cell and time \[s\] in the solver; for information only.
    #[serde(default)]
    pub cell: i64,
    #[serde(default)]
    pub time: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    Below,
    Above,
}

/// Size and number of the packings to plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Discs in a packing.
    pub discs: usize,
    /// Packings for each porosity and compression.
    pub repeats: u32,
}

/// Width of the classes into which porosities are sorted: packings of one target porosity scatter about as much.
const CLASS: f64 = 0.005;
/// Least and largest porosity at which packings can be made.
const TARGETS: [f64; 2] = [0.03, 0.2];
/// |f| up to which a state counts as isotropic, and as intermediate. The values lie half way between the mean |f| of isotropic, intermediate and horizontal packings in the full database: 0, 0.025 and 0.05.
const FABRIC: [f64; 2] = [0.0125, 0.0375];
/// Magnitudes of the strains at which the ramps stop: from those of a solver's step to those of a whole history.
const STOPS: [f64; 8] = [0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.03, 0.05];

impl Offenders {
    /// Reads the text of a file; `file` names it in errors.
    ///
    /// # Errors
    /// [`DatabaseError::Plan`] with what is wrong.
    pub fn parse(text: &str, file: &str) -> Result<Self, DatabaseError> {
        let problem = |problem: String| DatabaseError::Plan { file: file.to_string(), problem };
        let offenders: Self = serde_json::from_str(text).map_err(|error| problem(error.to_string()))?;
        offenders.check().map_err(problem)?;
        Ok(offenders)
    }

    fn check(&self) -> Result<(), String> {
        if self.schema != SCHEMA {
            return Err(format!("schema = {:?}, allowed: {SCHEMA:?}", self.schema));
        }
        if self.rows.is_empty() {
            return Err("rows: empty, at least one is needed".to_string());
        }
        ["porosity", "fabric_index"].iter().try_for_each(|name| self.column(name).map(|_| ()))?;
        for (k, row) in self.rows.iter().enumerate() {
            if row.state.len() != self.state_names.len() {
                let (found, names) = (row.state.len(), self.state_names.len());
                return Err(format!("rows[{k}].state: {found} values, allowed: {names}, one a state name"));
            }
            if !row.state.iter().chain([&row.strain, &row.distance]).all(|value| value.is_finite()) {
                return Err(format!("rows[{k}]: not finite"));
            }
            if row.column != "thermal_strain" && !self.state_names.contains(&row.column) {
                return Err(format!(
                    "rows[{k}].column = {:?}, allowed: a state name, thermal_strain",
                    row.column
                ));
            }
        }
        Ok(())
    }

    fn column(&self, name: &str) -> Result<usize, String> {
        let found = self.state_names.iter().position(|known| known == name);
        found.ok_or_else(|| format!("state_names: no {name:?}"))
    }

    /// A plan of thermal ramps whose packings lie around the offending states, with the grains and the boundary of
    /// `like`. For a state that no packing can have, for example one above the porosity of unjamming, the nearest
    /// possible packing is planned.
    ///
    /// # Errors
    /// [`DatabaseError::Plan`] when `effort` asks for no discs or no packings.
    pub fn plan(&self, like: &Plan, effort: Effort) -> Result<Plan, DatabaseError> {
        let problem = |problem: String| DatabaseError::Plan { file: "offenders".to_string(), problem };
        let (porosity, fabric) =
            (self.column("porosity").map_err(problem)?, self.column("fabric_index").map_err(problem)?);
        // Key: kind of compression; value: classes of porosity. All porosities of a kind go into one block.
        let mut wanted: BTreeMap<usize, Vec<i64>> = BTreeMap::new();
        for row in &self.rows {
            let class = (row.state[porosity].clamp(TARGETS[0], TARGETS[1]) / CLASS).round() as i64;
            let kind = FABRIC.iter().filter(|limit| row.state[fabric].abs() > **limit).count();
            wanted.entry(kind).or_default().push(class);
        }
        let kinds = [Compression::Isotropic, Compression::Intermediate, Compression::Horizontal];
        let paths = || like.paths.first().map(|_| Boundary::Periodic);
        let boundary = like.thermal.first().map(|block| block.boundary).or_else(paths).unwrap_or_default();
        let thermal = wanted.into_iter().map(|(kind, mut classes)| {
            classes.sort_unstable();
            classes.dedup();
            Block {
                discs: effort.discs,
                // A class times its width of 0.005, written as a division by 200 because its result prints without
                // rounding digits.
                porosities: classes.iter().map(|class| *class as f64 / (1.0 / CLASS).round()).collect(),
                compressions: vec![kinds[kind]],
                repeats: effort.repeats,
                stops: STOPS.to_vec(),
                boundary,
                ..Block::default()
            }
        });
        let plan = Plan {
            seed: self.seed(like.seed),
            thermal: thermal.collect(),
            mechanics: Vec::new(),
            wall_shear: Vec::new(),
            paths: Vec::new(),
            text: String::new(),
            ..like.clone()
        };
        let text = toml::to_string(&plan).map_err(|error| problem(error.to_string()))?;
        Plan::parse(&text, "offenders")
    }

    /// A seed other than that of the database on which the model was trained: with the same seed the same packings
    /// would be made again.
    fn seed(&self, other: u64) -> u64 {
        let digest = Sha256::digest(format!("{}{other}{:?}", self.model_hash, self.rows));
        digest.iter().take(4).fold(0, |value, &byte| value << 8 | u64::from(byte))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIKE: &str = "radius_min = 2e-3\nradius_max = 6e-3\nseed = 7\n[[thermal]]\ndiscs = 500\nboundary = \"periodic\"\n\
        porosities = [0.1]\ncompressions = [\"isotropic\"]\nrepeats = 1\nstops = [0.01]\n";

    fn file(rows: &str) -> String {
        format!(
            "{{\"schema\": \"{SCHEMA}\", \"model_hash\": \"00\", \"state_names\": [\"porosity\", \"fabric_index\"], \
             \"rows\": [{rows}]}}"
        )
    }

    fn row(porosity: f64, fabric: f64) -> String {
        format!(
            "{{\"state\": [{porosity}, {fabric}], \"strain\": 1e-5, \"column\": \"porosity\", \"side\": \"below\", \
             \"distance\": 0.01, \"cell\": 5, \"time\": 0.5}}"
        )
    }

    #[test]
    fn packings_surround_the_states() {
        let rows = [row(0.0502, 0.0), row(0.0498, 0.001), row(0.041, -0.06), row(0.3, 0.02)].join(",");
        let offenders = Offenders::parse(&file(&rows), "offenders.json").expect("sound");
        let like = Plan::parse(LIKE, "like").expect("sound");
        let plan = offenders.plan(&like, Effort { discs: 200, repeats: 3 }).expect("plan");
        let made: Vec<_> = plan.jobs().iter().map(|job| (job.spec.porosity, job.spec.compression)).collect();
        let expected = [
            (0.05, Compression::Isotropic),
            (0.2, Compression::Intermediate),
            (0.04, Compression::Horizontal),
        ];
        assert_eq!(made.len(), 9);
        assert!(expected.iter().all(|kind| made.iter().filter(|m| *m == kind).count() == 3), "{made:?}");
        assert_eq!((plan.radius_min, plan.radius_max), (2e-3, 6e-3));
        assert!(plan.thermal.iter().all(|block| block.boundary == Boundary::Periodic));
        assert_ne!(plan.seed, like.seed);
        assert_eq!(Plan::parse(&plan.text, "again").expect("own text"), plan);
        // Paths are in periodic boxes, too; the new plan has none.
        let (head, _) = LIKE.split_once("[[thermal]]").expect("a block");
        let paths = "[[paths]]\ndiscs = 50\nporosities = [0.1]\ncompressions = [\"isotropic\"]\nrepeats = 1\n\
            paths = [\"mixed\"]\n";
        let like = Plan::parse(&format!("{head}{paths}"), "like").expect("sound");
        let plan = offenders.plan(&like, Effort { discs: 200, repeats: 3 }).expect("plan");
        assert!(plan.paths.is_empty());
        assert!(plan.thermal.iter().all(|block| block.boundary == Boundary::Periodic));
    }

    #[test]
    fn unsound_files_are_refused_with_what_is_wrong() {
        let message = |text: &str| Offenders::parse(text, "o.json").expect_err("unsound").to_string();
        assert!(message(&file("")).contains("o.json: rows: empty"));
        assert!(message(&file(&row(0.1, 0.0)).replace("offenders-1", "offenders-2")).contains("offenders-2"));
        assert!(message(&file(&row(0.1, 0.0)).replace("below", "left")).contains("left"));
        assert!(
            message(&file(&row(0.1, 0.0)).replace("[0.1, 0]", "[0.1]")).contains("rows[0].state: 1 values")
        );
        assert!(
            message(&file(&row(0.1, 0.0)).replace("\"column\": \"porosity\"", "\"column\": \"p\""))
                .contains("column = \"p\"")
        );
        assert!(message("{").contains("o.json"));
    }
}
