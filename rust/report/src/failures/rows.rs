//! Configurations at the edge of what a method can do, or beyond. Each is run, and must be refused, ended, cut (repeated with
//! smaller time steps) or reported, as its entry in [`edges`] says. To add one, add an entry there.

use crate::jobs::execute::{Outcome, Record};
use crate::jobs::job::{Job, SolverJob};
use crate::jobs::pool::Records;
use crate::plan;
use crate::settings::Settings;
use msdd_reference::solver::Run;
use serde::Serialize;

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

/// A configuration at or beyond the edge of a method.
pub struct Edge {
    method: &'static str,
    condition: &'static str,
    predicted: &'static str,
    allowed: &'static [&'static str],
    pub job: Job,
}

/// The program refused to start: nothing was computed.
const REFUSED: &[&str] = &["refused"];
/// The run stopped with a message.
const ENDED: &[&str] = &["ended"];
const CUT: &[&str] = &["cut"];
const REPORTED: &[&str] = &["reported"];
/// The run ended as usual, because the configuration is still inside of the edge.
const DONE: &[&str] = &["done"];

fn edge(
    method: &'static str,
    condition: &'static str,
    predicted: &'static str,
    allowed: &'static [&'static str],
    job: impl Into<Job>,
) -> Edge {
    Edge { method, condition, predicted, allowed, job: job.into() }
}

fn uniform(case: &str, porosity: f64) -> SolverJob {
    SolverJob { uniform: Some([porosity, 0.04]), ..SolverJob::coarse(case).control("deltaT 0.02;") }
}

fn policy(column: &str, side: &str, action: &str) -> String {
    format!("surrogate {{ outOfTrainingRange {{ {column} {{ {side} {action}; }} }} }}")
}

fn stepped(step: &str) -> SolverJob {
    SolverJob::coarse("H").control(&format!("deltaT {step};"))
}

fn walls(job: SolverJob, kelvin: &str) -> SolverJob {
    let wall = format!("\"left|right|bottom|top\" {{ type fixedValue; value uniform {kelvin}; }}");
    job.temperature(&format!("boundaryField {{ {wall} }}"))
}

/// All configurations, in the order of the table.
pub fn edges(quick: bool) -> Vec<Edge> {
    [coupling(), region(), unjamming(), equilibrium(), numbers(), scenes(), elements(quick)]
        .into_iter()
        .flatten()
        .collect()
}

fn coupling() -> Vec<Edge> {
    let hot = || walls(stepped("5"), "200");
    let warn = "surrogate { outOfTrainingRange { thermalStrain { below warn; above warn; } porosity { below warn; } \
                elasticCompression { above warn; } } }";
    let adaptive = "msddFoam { timeScheme secondOrder; temperatureTolerance 0.05; }";
    vec![
        edge(
            "explicit coupling",
            "walls at 200 K, fixed steps of 5 s",
            "strain of a step beyond the data (5 %): ends",
            ENDED,
            hot(),
        ),
        edge(
            "explicit coupling",
            "the same, warn for thermalStrain, porosity, elasticCompression",
            "goes on beyond the data, says so",
            REPORTED,
            hot().grains(warn),
        ),
        edge(
            "explicit coupling",
            "case H, adaptive, first step 5 s",
            "cuts its step",
            CUT,
            stepped("5").control("adjustTimeStep yes;").solution(adaptive),
        ),
        edge(
            "adaptive steps",
            "asked of the paper's scheme",
            "refused",
            REFUSED,
            stepped("0.1").control("adjustTimeStep yes;"),
        ),
    ]
}

fn region() -> Vec<Edge> {
    // Beds so dense are known only when they are pressed more: without load the packing would be denser than any of the data
    let above = |action: &str| uniform("H", 0.052).grains(&policy("jammingFraction", "above", action));
    let method = "packing denser than the data";
    vec![
        edge(
            method,
            "porosity 0.052, default policy (clamp)",
            "counts answers",
            REPORTED,
            uniform("H", 0.052),
        ),
        edge(method, "porosity 0.052, jammingFraction error", "ends", &["ended", "refused"], above("error")),
        edge(method, "porosity 0.052, jammingFraction warn", "goes on, says so", REPORTED, above("warn")),
        edge(
            method,
            "porosity 0.052, jammingFraction cutStep with fixed steps",
            "cannot cut: ends",
            &["ended", "refused"],
            above("cutStep"),
        ),
    ]
}

fn unjamming() -> Vec<Edge> {
    let cold = || {
        walls(SolverJob::coarse("C").control("deltaT 0.02;"), "0").temperature("internalField uniform 100;")
    };
    let paper = "surrogate { model builtin:paper; }";
    vec![
        edge(
            "unjamming",
            "case C from porosity 0.16",
            "hardly touch at the end, inside of the data",
            DONE,
            uniform("C", 0.16),
        ),
        edge(
            "unjamming",
            "case C from 100 K (strain -10 %)",
            "loses contact: goes on, counts answers beyond the data",
            &["done", "reported"],
            cold(),
        ),
        edge(
            "unjamming",
            "the same, grains move",
            "as before, or ends",
            &["done", "reported", "ended"],
            cold().grains("mechanics equilibrium;"),
        ),
        edge(
            "paper's network",
            "case C from porosity 0.16",
            "hardly touch at the end, inside of the data",
            DONE,
            uniform("C", 0.16).grains(paper),
        ),
    ]
}

fn equilibrium() -> Vec<Edge> {
    let exact = "mechanics equilibrium; equilibriumCoeffs { residual 1e-9; maxResidual 1e-9; }";
    vec![
        edge(
            "equilibrium",
            "case H, steps of 1 s",
            "increments too large: brought in by parts, cut or ended",
            &["done", "cut", "ended", "reported"],
            stepped("1").grains("mechanics equilibrium;"),
        ),
        edge(
            "equilibrium",
            "residual of 1e-9 Pa",
            "near round-off: is reached, or ends with fields written",
            // Some cells have more fabric than the data.
            &["reported", "ended"],
            SolverJob::coarse("HC").control("deltaT 0.1;").grains(exact),
        ),
        edge(
            "equilibrium",
            "with the paper's network, which has no tangent",
            "refused",
            REFUSED,
            stepped("0.1").grains("mechanics equilibrium; surrogate { model builtin:paper; }"),
        ),
    ]
}

/// Material and temperature values that no material has. OpenFOAM's floating-point traps are on in all runs of this report.
fn numbers() -> Vec<Edge> {
    let indefinite = "surrogate { type constant; constantCoeffs { conductivity (10 20 0 10 0 10); } }";
    vec![
        edge(
            "conductivity",
            "constant, not positive definite",
            "refused",
            REFUSED,
            stepped("0.1").grains(indefinite),
        ),
        edge(
            "floating-point traps",
            "walls at 1e30 K",
            "strain beyond the data: ends, no trap",
            ENDED,
            walls(stepped("0.1"), "1e30"),
        ),
        edge(
            "floating-point traps",
            "heat capacity 1e-300 J/(kg K)",
            "read as 0: refused",
            REFUSED,
            stepped("0.1").grains("heatCapacity 1e-300;"),
        ),
    ]
}

/// Cases that a mesh or a model was not made for.
fn scenes() -> Vec<Edge> {
    let lean = |angle: f64| super::solver::slanted(angle, [50, 15], 0);
    vec![
        edge(
            "cycles",
            "case cycle: ten of 20 K to and fro",
            "does not drift, and its states are within the data",
            &["done", "cut"],
            super::cycles::job("equilibrium"),
        ),
        edge("slanted cells", "60 degrees", "goes on", DONE, lean(60.0)),
        edge("slanted cells", "80 degrees, beyond 70", "goes on, says so", REPORTED, lean(80.0)),
    ]
}

fn elements(quick: bool) -> Vec<Edge> {
    let run = |keys: &[&str]| {
        let begin =
            ["reference", "run", "--case", "cases/H", "--seed", "1", "--discs", "500", "--out", "WORK"];
        let state = ["--state", "WORK/packed.json", "--end", "1"];
        let all = begin.iter().chain(&state).chain(keys).map(|text| (*text).to_string());
        plan::tool(all.collect(), &["cases/common"], 300)
    };
    let pack = |keys: &[&str]| {
        let begin = ["rve", "pack", "--out", "WORK/packed.json"];
        plan::tool(begin.iter().chain(keys).map(|text| (*text).to_string()).collect(), &[], 300)
    };
    let mut edges = vec![edge(
        "DEM packing",
        "porosity 0.005",
        "not possible: refused",
        REFUSED,
        pack(&["--porosity", "0.005", "--discs", "100"]),
    )];
    if !quick {
        edges.push(edge(
            "DEM mechanical step",
            "500 discs, case H, steps of 2 ms asked for",
            "beyond the bound of 1 ms: refused",
            REFUSED,
            run(&["--time-step", "2e-3"]),
        ));
    }
    edges
}

pub fn read(settings: &Settings, records: &Records) -> Vec<Row> {
    let one = |edge: Edge| settings.record(records, &edge.job).map(|record| row(&edge, record));
    edges(settings.quick).into_iter().filter_map(one).collect()
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
        method: edge.method.to_string(),
        condition: edge.condition.to_string(),
        predicted: edge.predicted.to_string(),
        behaviour: behaviour.to_string(),
        as_allowed: edge.allowed.contains(&behaviour),
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
