//! Configurations at the edge of what a method can do, or beyond. Each is run, and must be refused, ended, cut (repeated with
//! smaller time steps) or reported, as its entry in `edges.toml` says. To add one, add an entry there.

use crate::ReportError;
use crate::jobs::execute::{Outcome, Record};
use crate::jobs::job::{Job, SolverJob};
use crate::jobs::pool::Records;
use crate::plan;
use crate::settings::Settings;
use msdd_dem_reference::solver::Run;
use serde::{Deserialize, Serialize};

/// A configuration at or beyond the edge of a method, and how its run ended.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    pub method: String,
    pub condition: String,
    /// What was expected before the run.
    pub predicted: String,
    /// "refused", "ended", "cut", "reported", "done", "stopped at the limit".
    pub behaviour: String,
    /// Whether the behaviour is one of those allowed.
    pub as_allowed: bool,
    /// The message of the program, or results of the run.
    pub message: String,
}

/// A configuration at or beyond the edge of a method, as `edges.toml` describes it.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Edge {
    method: String,
    condition: String,
    predicted: String,
    allowed: Vec<String>,
    case: String,
    porosity: Option<f64>,
    control: String,
    solution: String,
    grains: String,
    temperature: String,
    slant: Option<f64>,
    cycle: bool,
    tool: String,
    inputs: Vec<String>,
    /// Whether a quick report leaves it out.
    full_alone: bool,
}

/// All configurations, in the order of the table.
///
/// # Errors
/// [`ReportError::Read`] for a table that is not as its head says.
pub fn edges(quick: bool) -> Result<Vec<Edge>, ReportError> {
    #[derive(Deserialize)]
    struct Table {
        edge: Vec<Edge>,
    }
    let failed =
        |error: toml::de::Error| ReportError::Read { file: "edges.toml".into(), problem: error.to_string() };
    let table: Table = toml::from_str(include_str!("edges.toml")).map_err(failed)?;
    Ok(table.edge.into_iter().filter(|edge| !quick || !edge.full_alone).collect())
}

impl Edge {
    pub fn job(&self) -> Job {
        if let Some(angle) = self.slant {
            return super::solver::slanted(angle, [50, 15], 0).into();
        }
        if self.cycle {
            return super::cycles::job("equilibrium").into();
        }
        if !self.tool.is_empty() {
            let inputs: Vec<&str> = self.inputs.iter().map(String::as_str).collect();
            return plan::tool(&self.tool, &inputs, None, 300);
        }
        let mut job = SolverJob::coarse(&self.case);
        job.uniform = self.porosity.map(|porosity| [porosity, 0.04]);
        for (file, text) in [
            ("system/controlDict", &self.control),
            ("system/fvSolution", &self.solution),
            ("constant/granularProperties", &self.grains),
            ("0/T", &self.temperature),
        ] {
            if !text.is_empty() {
                job = job.with(file, text);
            }
        }
        job.into()
    }
}

/// # Errors
/// As [`edges`].
pub fn read(settings: &Settings, records: &Records) -> Result<Vec<Row>, ReportError> {
    let one = |edge: Edge| settings.record(records, &edge.job()).map(|record| row(&edge, record));
    Ok(edges(settings.quick)?.into_iter().filter_map(one).collect())
}

fn row(edge: &Edge, record: &Record) -> Row {
    let run = record.run.clone().unwrap_or_default();
    let (behaviour, message) = match record.outcome {
        Outcome::Refused => ("refused", record.message.clone()),
        // A tool whose message refuses a value has not computed anything yet, so it counts as refused, too.
        Outcome::Failed if is_refusal(&record.message) => ("refused", record.message.clone()),
        Outcome::Failed => ("ended", record.message.clone()),
        Outcome::TimedOut => ("stopped at the limit", record.message.clone()),
        Outcome::NotRun => ("not run", String::new()),
        Outcome::Done if run.rejected_steps > 0 && run.clamped_queries == 0 => {
            ("cut", format!("{} steps repeated with half the size; {}", run.rejected_steps, state(&run)))
        }
        Outcome::Done if run.clamped_queries > 0 || !record.message.is_empty() => {
            let said =
                if record.message.is_empty() { String::new() } else { format!(" \"{}\"", record.message) };
            ("reported", format!("{} answers beyond the data;{said} {}", run.clamped_queries, state(&run)))
        }
        Outcome::Done => ("done", state(&run)),
    };
    Row {
        method: edge.method.clone(),
        condition: edge.condition.clone(),
        predicted: edge.predicted.clone(),
        behaviour: behaviour.to_string(),
        as_allowed: edge.allowed.iter().any(|allowed| allowed == behaviour),
        message,
    }
}

/// Whether this is a message about a value that is not allowed, which comes before or at the first step (a box may have been
/// packed before).
fn is_refusal(message: &str) -> bool {
    let Some(at) = message.find("msdd: ") else { return false };
    message[at..].starts_with("msdd: t = 0 s") || message[at..].contains(", allowed: ")
}

fn state(run: &Run) -> String {
    format!("at the end porosity {:.4}, pressure {:.3} kPa", run.end_porosity, 1e-3 * run.end_pressure)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_read_and_a_wrong_key_is_refused() {
        let [quick, all] = [true, false].map(|quick| edges(quick).unwrap());
        assert_eq!((quick.len() + 1, all.len()), (all.len(), 23));
        let known = ["refused", "ended", "cut", "reported", "done"];
        assert!(all.iter().all(|edge| edge.allowed.iter().all(|allowed| known.contains(&allowed.as_str()))));
        let Job::Solver(job) = all[2].job() else { panic!("{:?}", all[2]) };
        assert_eq!(job.append["system/controlDict"], "deltaT 1e-2;\ndeltaT 5;\nadjustTimeStep yes;\n");
        assert!(toml::from_str::<Edge>("metod = \"a\"").unwrap_err().to_string().contains("metod"));
    }
}
