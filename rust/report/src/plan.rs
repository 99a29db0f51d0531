//! The configurations of the report. To add one, add an entry in `plan.toml`.

use crate::jobs::job::{ENGINE, Job, SolverJob, ToolJob};
use crate::jobs::pool::Asked;
use serde::Deserialize;
use std::collections::BTreeMap;

/// Kinds of configurations, which are drawn with different markers and colours.
pub const FAMILIES: [&str; 9] = [
    "law of the increments",
    "law of the increments, grains move",
    "paper's network",
    "effective medium (plug-in)",
    "constant conductivity",
    "online RVEs",
    "one-dimensional",
    "DEM",
    "quoted from the paper",
];

/// How a configuration's cost and error are known.
#[derive(Clone, Debug, PartialEq)]
pub enum CostSource {
    /// The configuration is run to the end for all packings.
    Run,
    /// It is run to this time \[s\] to measure its cost alone; the error is that of the configuration with this name.
    Segment(f64, String),
    /// It is run to this time \[s\] to measure the cost of one evaluation of the model; the number of evaluations for each cell,
    /// and the error, are those of the configuration with this name, which has another mesh.
    Answers(f64, String),
}

impl CostSource {
    /// Name of the configuration whose error is used.
    pub fn borrowed(&self) -> Option<&str> {
        match self {
            Self::Run => None,
            Self::Segment(_, name) | Self::Answers(_, name) => Some(name),
        }
    }
}

/// One configuration: a point of the chart of error against cost, for some of the cases.
#[derive(Clone, Debug)]
pub struct Configuration {
    pub name: String,
    pub family: String,
    /// The job without case and packing.
    template: SolverJob,
    pub cases: Vec<String>,
    /// Whether its K is that of Eq. 9, an upper bound, which is compared with the same of the discs.
    pub affine: bool,
    pub known: CostSource,
    /// Number of the report's packings that it is run for.
    pub packings: usize,
    /// Estimate of its processor time \[s\].
    pub guess: f64,
}

impl Configuration {
    pub fn job(&self, case: &str, seed: u32) -> SolverJob {
        SolverJob { case: case.to_string(), seed, ..self.template.clone() }
    }
    pub fn asked(&self, case: &str, seed: u32) -> Asked {
        Asked { job: Job::Solver(self.job(case, seed)), guess: self.guess }
    }
}

/// The cases of the chart.
pub const CHARTED: [&str; 3] = ["H", "C", "HC"];

/// A configuration as `plan.toml` describes it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    name: String,
    family: String,
    guess: f64,
    mesh: Option<[usize; 2]>,
    cases: Option<Vec<String>>,
    control: Option<String>,
    solution: Option<String>,
    grains: Option<String>,
    #[serde(default)]
    affine: bool,
    packings: Option<usize>,
    end: Option<f64>,
    limit: Option<u64>,
    plugin: Option<String>,
    segment: Option<Other>,
    answers: Option<Other>,
}

/// The end of a short run \[s\], and the configuration that has the rest.
#[derive(Deserialize)]
struct Other {
    end: f64,
    other: String,
}

impl From<Entry> for Configuration {
    fn from(entry: Entry) -> Self {
        let mut template = SolverJob::new("", 0);
        for (file, text) in [
            ("system/controlDict", entry.control),
            ("system/fvSolution", entry.solution),
            ("constant/granularProperties", entry.grains),
        ] {
            template = text.into_iter().fold(template, |job, text| job.with(file, &text));
        }
        template.mesh = entry.mesh.unwrap_or(template.mesh);
        template.end = entry.end.unwrap_or(template.end);
        template.limit = entry.limit.unwrap_or(template.limit);
        template.plugin = entry.plugin;
        let known = match (entry.segment, entry.answers) {
            (Some(short), _) => CostSource::Segment(short.end, short.other),
            (None, Some(short)) => CostSource::Answers(short.end, short.other),
            (None, None) => CostSource::Run,
        };
        Self {
            name: entry.name,
            family: entry.family,
            template,
            cases: entry.cases.unwrap_or_else(|| CHARTED.map(str::to_string).to_vec()),
            affine: entry.affine,
            known,
            packings: entry.packings.unwrap_or(usize::MAX),
            guess: entry.guess,
        }
    }
}

/// A list of `plan.toml`; a test reads all of them.
fn list(name: &str, quick: bool) -> Vec<Configuration> {
    let mut plan: BTreeMap<String, Vec<Entry>> =
        toml::from_str(include_str!("plan.toml")).unwrap_or_default();
    let name = if quick { format!("quick-{name}") } else { name.to_string() };
    plan.remove(&name).unwrap_or_default().into_iter().map(Configuration::from).collect()
}

/// The configurations of the validation: the paper's algorithm with the law, the paper's network and boxes of
/// grains in all cells, and the law with grains that move.
pub fn validated(quick: bool) -> Vec<Configuration> {
    list("validation", quick)
}

/// All points of the chart except those of DEM.
pub fn chart(quick: bool) -> Vec<Configuration> {
    list("chart", quick)
}

/// A run of a case by DEM on one thread, to `end` \[s\]. `step`: largest time step \[s\]; `None`: that of the
/// stability bound.
pub fn elements(case: &str, end: f64, step: Option<f64>, limit: u64) -> Job {
    let step = step.map_or(String::new(), |step| format!(" --time-step {step}"));
    let run = format!("reference run --case cases/{case} --seed 1 --out WORK --threads 1 --end {end}{step}");
    tool(&run, &["cases/common"], None, limit)
}

/// A run of `msdd` that depends on the DEM engine and on `inputs`.
pub fn tool(arguments: &str, inputs: &[&str], output: Option<&str>, limit: u64) -> Job {
    command(arguments, &[&ENGINE, inputs].concat(), output, limit)
}

/// A run of `msdd` that depends on `inputs` alone.
pub fn command(arguments: &str, inputs: &[&str], output: Option<&str>, limit: u64) -> Job {
    Job::Tool(ToolJob {
        arguments: arguments.split_whitespace().map(str::to_string).collect(),
        inputs: inputs.iter().map(|input| (*input).to_string()).collect(),
        output: output.map(str::to_string),
        limit,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn names_are_unique_and_families_known() {
        for quick in [true, false] {
            let list = chart(quick);
            let names: BTreeSet<String> = list.iter().map(|c| format!("{} {}", c.family, c.name)).collect();
            assert!(names.len() == list.len() && list.len() > 3 && validated(quick).len() > 2);
            assert!(list.iter().chain(&validated(quick)).all(|c| FAMILIES.contains(&c.family.as_str())));
        }
    }

    #[test]
    fn a_segment_names_a_configuration_that_is_run() {
        let list = chart(false);
        for configuration in &list {
            if let Some(name) = configuration.known.borrowed() {
                assert!(list.iter().any(|c| c.name == name && c.known == CostSource::Run), "{name}");
            }
        }
    }
}
