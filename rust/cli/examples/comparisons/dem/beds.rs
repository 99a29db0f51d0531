//! The plan of the beds of spheres: a TOML file with a name and a use for each. The beds themselves stand in folders next to it.

use super::Use;
use msdd_dem_reference::ReferenceError;
use msdd_files::read_text;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::path::Path;

/// What the names of beds may be.
const BED_NAMES: &str = "lower-case letters, digits and '-'; no other scene has it";

/// What is computed of which bed.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BedPlan {
    pub scenes: Vec<PlannedBed>,
}

/// One scene of the plan.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedBed {
    /// Name of the bed: next to the plan stands a folder of this name, with `bed.toml` and the files `dem-<seed>.csv` of
    /// its packings. Allowed: `BED_NAMES`.
    pub name: String,
    /// What it is for, as above.
    #[serde(rename = "use")]
    pub purpose: Use,
}

impl BedPlan {
    /// Reads and checks a plan.
    ///
    /// # Errors
    /// [`ReferenceError::Read`], also for names that are there twice or are no names of folders.
    pub fn read(file: &Path) -> Result<Self, ReferenceError> {
        let wrong = |problem: String| ReferenceError::Read { file: file.to_path_buf(), problem };
        let plan: Self =
            toml::from_str(&read_text(file)?).map_err(|error| wrong(error.to_string().trim().to_string()))?;
        if plan.scenes.is_empty() {
            return Err(wrong("scenes = none, allowed: one at least".to_string()));
        }
        let mut names = BTreeSet::new();
        for PlannedBed { name, .. } in &plan.scenes {
            let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
            if name.is_empty() || !name.chars().all(plain) || !names.insert(name) {
                return Err(wrong(format!("name = {name}, allowed: {BED_NAMES}")));
            }
        }
        Ok(plan)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<BedPlan, String> {
        let name = format!("msdd-bed-plan-{}-{}.toml", std::process::id(), text.len());
        let file = std::env::temp_dir().join(name);
        std::fs::write(&file, text).unwrap();
        let plan = BedPlan::read(&file).map_err(|error| error.to_string());
        std::fs::remove_file(&file).unwrap();
        plan
    }

    #[test]
    fn plans_are_read_and_what_is_wrong_is_named() {
        let one = "[[scenes]]\nname = \"a-1\"\nuse = \"judge\"\n";
        let plan = read(one).unwrap();
        assert_eq!(plan.scenes, [PlannedBed { name: "a-1".to_string(), purpose: Use::Judge }]);
        for (text, problem) in [
            ("scenes = []\n".to_string(), "one at least"),
            (one.repeat(2), "name = a-1"),
            (one.replace("a-1", "../a"), "name = ../a"),
            (one.replace("judge", "fun"), "fun"),
            (format!("{one}seed = 3\n"), "seed"),
        ] {
            assert!(read(&text).unwrap_err().contains(problem), "{text}");
        }
    }
}
