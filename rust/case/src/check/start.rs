//! The folder of the time at which a run begins, which system/controlDict and the folders of the case say.

use super::keys;
use crate::dictionary::Dictionary;
use msdd_rve::message::number;
use std::path::Path;

/// By how much the name of a folder may differ from startTime, as a share of it.
const ROUND_OFF: f64 = 1e-6;

/// The time whose fields are checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// Name of its folder.
    pub name: String,
    /// Its value \[s\].
    pub time: f64,
    /// Whether a solver has written it, with the whole state of the grains.
    pub restarted: bool,
}

impl Start {
    /// Finds the time. From the latest time a run may go on that has begun before: then that is meant with whose fields it began.
    pub fn find(folder: &Path, control: Option<&Dictionary>) -> Self {
        let times = times_in(folder);
        let holds = |name: &str, file: &str| {
            let file = format!("{name}/{file}");
            folder.join(&file).exists() || folder.join(file + ".gz").exists()
        };
        let restarted = |name: &str| holds(name, "uniform/time");
        let from = control.and_then(|control| control.text("startFrom").ok());
        let chosen = match from.as_deref() {
            Some("startTime") => {
                let wanted =
                    control.and_then(|control| keys::number(control, "startTime", "")).unwrap_or(0.0);
                let is_near = |time: f64| (time - wanted).abs() <= ROUND_OFF * wanted.abs();
                let there = times.into_iter().find(|(time, _)| is_near(*time));
                Some(there.unwrap_or((wanted, number(wanted))))
            }
            Some("firstTime") => times.into_iter().next(),
            _ => {
                let begun = || times.iter().rev().filter(|(_, name)| !restarted(name));
                // msddFoam skips times without T; regions have theirs further inside
                let whole = begun().find(|(_, name)| holds(name, "T"));
                whole.or_else(|| begun().next()).or(times.last()).cloned()
            }
        };
        let (time, name) = chosen.unwrap_or((0.0, "0".to_string()));
        let restarted = restarted(&name);
        Self { name, time, restarted }
    }

    /// Whether these columns of the state of the grains are all there as fields; the solver then takes nothing else for the state.
    pub fn has_state(&self, folder: &Path, region: &Path, columns: &[String]) -> bool {
        let fields = folder.join(&self.name).join(region);
        let is_there =
            |name: &String| fields.join(name).exists() || fields.join(format!("{name}.gz")).exists();
        !columns.is_empty() && columns.iter().all(is_there)
    }

    /// Path of a file of the start: 0/T becomes 5/T.
    pub fn path(&self, file: &str) -> String {
        match file.strip_prefix("0/") {
            Some(rest) => format!("{}/{rest}", self.name),
            None => file.to_string(),
        }
    }
}

/// Values and names of the folders of times, in their order.
fn times_in(folder: &Path) -> Vec<(f64, String)> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let time = |name: String| {
        let is_number = name.starts_with(|c: char| c.is_ascii_digit() || c == '-');
        let value = name.parse::<f64>().ok().filter(|value| is_number && value.is_finite())?;
        Some((value, name))
    };
    let mut times: Vec<(f64, String)> = entries
        .filter(|entry| entry.path().is_dir())
        .filter_map(|entry| time(entry.file_name().into_string().ok()?))
        .collect();
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    times
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_start_is_where_the_solver_begins() {
        let folder = std::env::temp_dir().join(format!("msdd-start-{}", std::process::id()));
        for name in ["0.orig", "constant", "-1", "5", "10/uniform"] {
            std::fs::create_dir_all(folder.join(name)).unwrap();
        }
        std::fs::write(folder.join("10/uniform/time"), "").unwrap();
        let start = |control: &str| {
            let control = Dictionary::parse(Path::new("system/controlDict"), control).unwrap();
            Start::find(&folder, Some(&control))
        };
        let of = |name: &str, time: f64, restarted: bool| Start { name: name.to_string(), time, restarted };
        assert_eq!(start("startTime 10;"), of("5", 5.0, false));
        std::fs::create_dir_all(folder.join("2")).unwrap();
        std::fs::write(folder.join("2/T.gz"), "").unwrap();
        assert_eq!(start("startTime 10;"), of("2", 2.0, false));
        std::fs::remove_dir_all(folder.join("2")).unwrap();
        assert_eq!(start("startFrom firstTime;"), of("-1", -1.0, false));
        assert_eq!(start("startFrom startTime; startTime 10;"), of("10", 10.0, true));
        assert_eq!(start("startFrom startTime; startTime 0.5;"), of("0.5", 0.5, false));
        let columns = ["jammingFraction", "strength"].map(str::to_string);
        let whole = |region| of("5", 5.0, false).has_state(&folder, Path::new(region), &columns);
        std::fs::create_dir_all(folder.join("5/bed")).unwrap();
        for file in ["5/jammingFraction", "5/bed/jammingFraction", "5/bed/strength.gz"] {
            std::fs::write(folder.join(file), "").unwrap();
        }
        assert!(!whole("") && whole("bed") && !of("5", 5.0, false).has_state(&folder, Path::new("bed"), &[]));
        assert_eq!(start("startFrom latestTime;").path("0/T"), "5/T");
        assert_eq!(start("startFrom latestTime;").path("constant/g"), "constant/g");
        std::fs::remove_dir_all(&folder).unwrap();
        assert_eq!(Start::find(&folder, None), of("0", 0.0, false));
    }
}
