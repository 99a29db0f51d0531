//! Where methods break: predicted and measured, and what the program does there. Adding a row is a line in [`rows`].

use crate::compare::{at, largest};
use crate::execute::{Outcome, Record};
use crate::job::{Job, SolverJob, ToolJob};
use crate::output::Run;
use crate::plan;
use crate::pool::{Asked, Records};
use crate::report::Settings;
use serde::Serialize;
use serde_json::Value;

/// One configuration at or beyond the edge of a method.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    pub method: String,
    pub condition: String,
    /// What was to be expected, before it was run.
    pub predicted: String,
    /// "refused", "ended", "cut", "reported", "done", "stopped at the limit".
    pub behaviour: String,
    /// What the program said, or what came out.
    pub message: String,
}

/// Largest stable steps of 500 discs [s].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StableStep {
    pub porosity: f64,
    /// Predicted, measured.
    pub mechanical: [f64; 2],
    pub thermal: [f64; 2],
}

/// Error in time of the coupled steps, case H on 25 x 8 cells, against adaptive steps of 0.0005 K.
#[derive(Clone, Debug, Serialize)]
pub struct Coupling {
    pub scheme: String,
    /// [s]
    pub step: f64,
    /// Largest error of T at the probes from 1 s on [K]; none when the run ended early.
    pub error: Option<f64>,
    pub outcome: String,
    pub message: String,
}

/// Pressure after each half cycle [Pa].
#[derive(Clone, Debug, Serialize)]
pub struct Cycles {
    pub name: String,
    /// Thermal strain, pressure [Pa], porosity.
    pub stops: Vec<[f64; 3]>,
}

/// Drift of a network with the number of increments.
#[derive(Clone, Debug, Serialize)]
pub struct Drift {
    pub model: String,
    pub strain: f64,
    /// Increments, rms error of the stress [%].
    pub stress: Vec<[f64; 2]>,
}

#[derive(Clone, Debug, Default, Serialize)]
pub struct Failures {
    pub rows: Vec<Row>,
    pub stable_steps: Vec<StableStep>,
    pub coupling: Vec<Coupling>,
    pub cycles: Vec<Cycles>,
    pub drift: Vec<Drift>,
}

/// Case H on few cells, which is enough to see a method break.
fn small(case: &str) -> SolverJob {
    SolverJob { mesh: [25, 8], limit: 120, ..SolverJob::new(case, 1) }
}

fn uniform(case: &str, porosity: f64) -> SolverJob {
    SolverJob { uniform: Some([porosity, 0.04]), ..small(case).control("deltaT 0.02;") }
}

fn policy(column: &str, side: &str, action: &str) -> String {
    format!("surrogate {{ outOfRegion {{ {column} {{ {side} {action}; }} }} }}")
}

/// Method, condition, what is to be expected, and the job.
fn rows(quick: bool) -> Vec<(&'static str, &'static str, &'static str, Job)> {
    let step = |step: &str| small("H").control(&format!("deltaT {step};"));
    let walls = |job: SolverJob, kelvin: f64| {
        let wall = format!("\"left|right|bottom|top\" {{ type fixedValue; value uniform {kelvin}; }}");
        job.temperature(&format!("boundaryField {{ {wall} }}"))
    };
    let hot = |keys: &str| walls(step(keys), 200.0);
    let cold = || walls(small("C").control("deltaT 0.02;"), -50.0);
    let adaptive = "msddFoam { timeScheme secondOrder; temperatureTolerance 0.05; }";
    let mut rows: Vec<(&str, &str, &str, Job)> = vec![
        (
            "explicit coupling",
            "walls at 200 K, fixed steps of 5 s",
            "strain of a step beyond the data (5 %): ends",
            hot("5").into(),
        ),
        (
            "explicit coupling",
            "the same, thermalStrain warn",
            "goes on with the region's end, says so",
            hot("5").grains("surrogate { outOfRegion { thermalStrain { below warn; above warn; } } }").into(),
        ),
        (
            "explicit coupling",
            "case H, adaptive, first step 5 s",
            "cuts its step",
            step("5").control("adjustTimeStep yes;").solution(adaptive).into(),
        ),
        (
            "porosity below the data",
            "porosity 0.05, default policy (error)",
            "ends",
            uniform("H", 0.05).into(),
        ),
        (
            "porosity below the data",
            "porosity 0.05, porosity clamp",
            "counts clamped answers",
            uniform("H", 0.05).grains(&policy("porosity", "below", "clamp")).into(),
        ),
    ];
    if quick {
        return rows;
    }
    let limits = ["reference", "run", "--case", "cases/H", "--seed", "1", "--discs", "500"];
    let long = limits.iter().chain(&[
        "--state",
        "WORK/packed.json",
        "--out",
        "WORK",
        "--end",
        "1",
        "--time-step",
        "2e-3",
    ]);
    let more: Vec<(&str, &str, &str, Job)> = vec![
        (
            "DEM mechanical step",
            "500 discs, case H, steps of 2 ms asked for",
            "beyond the bound of 1 ms: refused",
            plan::tool(long.map(|text| (*text).to_string()).collect(), &["cases/common"], 300),
        ),
        (
            "porosity below the data",
            "porosity 0.05, porosity warn",
            "goes on, says so",
            uniform("H", 0.05).grains(&policy("porosity", "below", "warn")).into(),
        ),
        (
            "porosity below the data",
            "porosity 0.05, cutStep with fixed steps",
            "cannot cut: ends",
            uniform("H", 0.05).grains(&policy("porosity", "below", "cutStep")).into(),
        ),
        (
            "unjamming",
            "case C from porosity 0.16",
            "grains lose touch near 0.19: clamped, counted",
            uniform("C", 0.16).into(),
        ),
        (
            "unjamming",
            "case C, walls at -50 K (strain -10 %)",
            "beyond the data: clamped, counted",
            cold().into(),
        ),
        (
            "unjamming",
            "the same, grains move",
            "as before, or ends",
            cold().grains("mechanics equilibrium;").into(),
        ),
        (
            "equilibrium",
            "case H, steps of 1 s",
            "increments too large: cut or ended",
            step("1").grains("mechanics equilibrium;").into(),
        ),
        (
            "equilibrium",
            "residual of 1e-6 Pa",
            "cannot be reached: ends, fields written",
            small("HC")
                .control("deltaT 0.1;")
                .grains("mechanics equilibrium; equilibriumCoeffs { residual 1e-6; maxResidual 1e-5; }")
                .into(),
        ),
        (
            "equilibrium",
            "with the paper's network, which has no tangent",
            "refused",
            step("0.1").grains("mechanics equilibrium; surrogate { model builtin:paper; }").into(),
        ),
        (
            "paper's network",
            "case C from porosity 0.16",
            "outside of its data: clamped, counted",
            uniform("C", 0.16).grains("surrogate { model builtin:paper; }").into(),
        ),
        (
            "conductivity",
            "constant, not positive definite",
            "refused",
            step("0.1")
                .grains("surrogate { type constant; constantCoeffs { conductivity (10 20 0 10 0 10); } }")
                .into(),
        ),
        (
            "adaptive steps",
            "asked of the paper's scheme",
            "refused",
            step("0.1").control("adjustTimeStep yes;").into(),
        ),
    ];
    rows.extend(more);
    rows
}

const STEPS: [f64; 9] = [2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005];
const SCHEMES: [&str; 2] = ["paper", "secondOrder"];

fn coupled(scheme: &str, step: f64) -> SolverJob {
    let job = small("H").control(&format!("deltaT {step};"));
    job.solution(&format!("msddFoam {{ timeScheme {scheme}; }}"))
}

/// What the coupled steps are measured against.
fn converged() -> SolverJob {
    small("H")
        .control("deltaT 1e-3; adjustTimeStep yes;")
        .solution("msddFoam { timeScheme secondOrder; temperatureTolerance 0.0005; stateTolerance 0.5; }")
        .solution("solvers { T { tolerance 1e-12; } }")
}

fn stability(quick: bool) -> Job {
    let porosities = if quick { "0.09,0.12" } else { "0.06,0.07,0.08,0.09,0.1,0.12,0.14,0.17" };
    plan::tool(
        ["bench", "stability", "--porosity", porosities].map(str::to_string).to_vec(),
        &["rust/cli/src/bench"],
        300,
    )
}

fn score() -> Job {
    let models = ["rust/surrogate/models/state.json", "rust/surrogate/models/paper.json"];
    let database = "cases/database/full.csv.gz";
    let arguments = ["score", "--model", models[0], "--model", models[1], "--database", database];
    let arguments =
        arguments.iter().chain(&["--json", "WORK/score.json"]).map(|text| (*text).to_string()).collect();
    let inputs = [&models[..], &[database, "rust/surrogate/src", "rust/rve/src"]].concat();
    Job::Tool(ToolJob {
        arguments,
        inputs: inputs.into_iter().map(str::to_string).collect(),
        output: Some("score.json".to_string()),
        limit: 600,
    })
}

/// Cycles of +-20 K: ten, slow enough for T to follow the walls.
const CYCLES: usize = 10;
/// One cycle [s]; at 20 K a second the middle would lag.
const PERIOD: f64 = 40.0;
const AMPLITUDE: f64 = 20.0;

fn cycled(keys: &str) -> SolverJob {
    let mut table = String::new();
    for half in 0..=2 * CYCLES {
        // 50 K, then 70 and 30 K in turns with a stop at 50 K between two.
        let quarter = PERIOD / 4.0;
        let t = 2.0 * quarter * half as f64;
        table += &format!("({t} 50) ");
        if half < 2 * CYCLES {
            let peak = if half % 2 == 0 { AMPLITUDE } else { -AMPLITUDE };
            table += &format!("({} {}) ", t + quarter, 50.0 + peak);
        }
    }
    let wall = format!(
        "\"left|right|bottom|top\" {{ type uniformFixedValue; uniformValue table ({table}); value uniform 50; }}"
    );
    let mut job =
        small("H").control("deltaT 0.1;").grains(keys).temperature(&format!("boundaryField {{ {wall} }}"));
    job.mesh = [10, 3];
    job.end = PERIOD * CYCLES as f64;
    job
}

/// The same strains in one box of 500 grains, packed as the cases are.
fn cycled_box() -> [Vec<String>; 2] {
    let pack =
        ["rve", "pack", "--porosity", "0.13", "--compression", "horizontal", "--out", "WORK/packed.json"];
    let stops: Vec<&str> = (0..CYCLES).flat_map(|_| ["0.02", "0", "-0.02", "0"]).collect();
    let stops = stops.join(",");
    let expand =
        ["rve", "expand", "--state", "WORK/packed.json", "--stops", &stops, "--out", "WORK/out.json"];
    [pack.map(str::to_string).to_vec(), expand.map(str::to_string).to_vec()]
}

/// Two commands one after the other count as one job: the second needs what the first wrote.
fn box_job() -> Job {
    let [pack, expand] = cycled_box();
    let arguments = [pack, vec![crate::execute::THEN.to_string()], expand].concat();
    plan::tool(arguments, &[], 600)
}

pub fn jobs(quick: bool) -> Vec<Asked> {
    let mut jobs: Vec<Job> = rows(quick).into_iter().map(|row| row.3).collect();
    jobs.push(stability(quick));
    let steps = if quick { &STEPS[3..6] } else { &STEPS[..] };
    jobs.push(converged().into());
    jobs.extend(SCHEMES.iter().flat_map(|scheme| steps.iter().map(|step| coupled(scheme, *step).into())));
    if !quick {
        jobs.push(score());
        jobs.push(box_job());
        jobs.extend(["", "mechanics equilibrium;"].map(|keys| cycled(keys).into()));
    }
    jobs.into_iter().map(|job| Asked { job, guess: 2.0 }).collect()
}

/// The failure map from the records.
pub fn read(settings: &Settings, records: &Records) -> Failures {
    let find = |job: &Job| settings.record(records, job);
    let done = |job: &Job| find(job).filter(|record| record.outcome == Outcome::Done);
    Failures {
        rows: rows(settings.quick)
            .into_iter()
            .filter_map(|(method, condition, predicted, job)| {
                find(&job).map(|record| row(method, condition, predicted, record))
            })
            .collect(),
        stable_steps: done(&stability(settings.quick)).map(|r| stable_steps(&r.printed)).unwrap_or_default(),
        coupling: coupling(settings, records),
        cycles: cycles(settings, records),
        drift: done(&score()).and_then(|r| r.file.as_deref().map(drift)).unwrap_or_default(),
    }
}

fn row(method: &str, condition: &str, predicted: &str, record: &Record) -> Row {
    let run = record.run.clone().unwrap_or_default();
    let (behaviour, message) = match record.outcome {
        Outcome::Refused => ("refused", record.message.clone()),
        // A tool that refuses has done nothing yet either.
        Outcome::Failed if record.message.starts_with("msdd: t = 0 s") => ("refused", record.message.clone()),
        Outcome::Failed => ("ended", record.message.clone()),
        Outcome::TimedOut => ("stopped at the limit", record.message.clone()),
        Outcome::NotRun => ("not run", String::new()),
        Outcome::Done if run.rejected_steps > 0 && run.clamped_queries == 0 => {
            ("cut", format!("{} steps repeated with half the size; {}", run.rejected_steps, state(&run)))
        }
        Outcome::Done if run.clamped_queries > 0 || !record.message.is_empty() => {
            let said =
                if record.message.is_empty() { String::new() } else { format!(" \"{}\"", record.message) };
            ("reported", format!("{} answers clamped;{said} {}", run.clamped_queries, state(&run)))
        }
        Outcome::Done => ("done", state(&run)),
    };
    Row {
        method: method.to_string(),
        condition: condition.to_string(),
        predicted: predicted.to_string(),
        behaviour: behaviour.to_string(),
        message,
    }
}

fn state(run: &Run) -> String {
    format!("at the end porosity {:.4}, pressure {:.3} kPa", run.end_porosity, 1e-3 * run.end_pressure)
}

/// Lines "porosity 0.06  1.011e-3  1.051e-3  1.04  4.973e-4  4.934e-4  0.99".
fn stable_steps(printed: &str) -> Vec<StableStep> {
    let line = |line: &str| -> Option<StableStep> {
        let numbers: Vec<f64> =
            line.strip_prefix("porosity")?.split_whitespace().map_while(|w| w.parse().ok()).collect();
        let &[porosity, mp, mm, _, tp, tm, _] = numbers.as_slice() else { return None };
        Some(StableStep { porosity, mechanical: [mp, mm], thermal: [tp, tm] })
    };
    printed.lines().filter_map(line).collect()
}

fn coupling(settings: &Settings, records: &Records) -> Vec<Coupling> {
    let exact = settings.record(records, &converged().into()).and_then(|record| record.run.clone());
    let Some(exact) = exact else { return Vec::new() };
    let mut list = Vec::new();
    for scheme in SCHEMES {
        for step in STEPS {
            let Some(record) = settings.record(records, &coupled(scheme, step).into()) else { continue };
            list.push(Coupling {
                scheme: scheme.to_string(),
                step,
                error: record.run.as_ref().map(|run| error_in_time(run, &exact)),
                outcome: record.outcome.as_str().to_string(),
                message: record.message.clone(),
            });
        }
    }
    list
}

/// At the times that the run has, from 1 s on [K].
fn error_in_time(run: &Run, exact: &Run) -> f64 {
    let series = |p: usize| -> Vec<[f64; 2]> { exact.temperature.iter().map(|r| [r[0], r[1 + p]]).collect() };
    let exact = [0, 1, 2].map(series);
    let rows = run.temperature.iter().filter(|row| row[0] >= 1.0);
    let differences: Vec<f64> =
        rows.flat_map(|row| [0, 1, 2].map(|p| row[1 + p] - at(&exact[p], row[0]))).collect();
    largest(&differences).abs()
}

fn cycles(settings: &Settings, records: &Records) -> Vec<Cycles> {
    let mut list = Vec::new();
    for (name, keys) in
        [("solver, cells keep their place", ""), ("solver, grains move", "mechanics equilibrium;")]
    {
        let record = settings.record(records, &cycled(keys).into());
        let Some(run) = record.and_then(|record| record.run.as_ref()) else { continue };
        let quarter = PERIOD / 4.0;
        let stop = |k: usize| {
            let strain = [0.0, 0.02, 0.0, -0.02][k % 4];
            [strain, at(&run.pressure, quarter * k as f64), f64::NAN]
        };
        list.push(Cycles { name: name.to_string(), stops: (1..=4 * CYCLES).map(stop).collect() });
    }
    if let Some(record) = settings.record(records, &box_job()) {
        list.push(Cycles { name: "one box of 500 grains".to_string(), stops: box_stops(&record.printed) });
    }
    list
}

/// Lines "strain +0.02: settled after 1089 steps, porosity 0.0982, ..., pressure 4255.4 Pa, ...".
fn box_stops(printed: &str) -> Vec<[f64; 3]> {
    let after = |line: &str, word: &str| -> Option<f64> {
        let rest = &line[line.find(word)? + word.len()..];
        rest.split_whitespace().next()?.trim_end_matches([',', ':']).parse().ok()
    };
    let line =
        |line: &str| Some([after(line, "strain ")?, after(line, "pressure ")?, after(line, "porosity ")?]);
    printed.lines().filter(|l| l.starts_with("strain ")).filter_map(line).collect()
}

fn drift(text: &str) -> Vec<Drift> {
    let models: Vec<Value> = serde_json::from_str(text).unwrap_or_default();
    let mut list = Vec::new();
    for model in &models {
        for strain in [0.02, -0.02, -0.05] {
            let composed = model["composed"].as_array().cloned().unwrap_or_default();
            let number = |entry: &Value, key: &str| entry[key].as_f64().unwrap_or(f64::NAN);
            let rows = composed.iter().filter(|entry| (number(entry, "strain") - strain).abs() < 1e-9);
            list.push(Drift {
                model: model["name"].as_str().unwrap_or("?").to_string(),
                strain,
                stress: rows.map(|e| [number(e, "increments"), 100.0 * number(e, "stress")]).collect(),
            });
        }
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_programs_print_is_read() {
        let steps = stable_steps(
            "largest ...\nporosity 0.06          1.011e-3   1.051e-3   1.04      4.973e-4  4.934e-4   0.99\n",
        );
        assert_eq!(
            steps,
            [StableStep { porosity: 0.06, mechanical: [1.011e-3, 1.051e-3], thermal: [4.973e-4, 4.934e-4] }]
        );
        let line = "strain -0.02: settled after 5661 steps, porosity 0.1388, fabric index +0.0674, pressure 2039.6 Pa, rattlers 8";
        assert_eq!(box_stops(line), [[-0.02, 2039.6, 0.1388]]);
        let score =
            r#"[{"name": "state", "composed": [{"strain": -0.02, "increments": 5, "stress": 0.02}]}]"#;
        assert_eq!(drift(score)[1].stress, [[5.0, 2.0]]);
    }

    #[test]
    fn walls_go_through_all_cycles() {
        let text = &cycled("").append["0/T"];
        assert_eq!(text.matches(" 70)").count(), CYCLES);
        assert_eq!(text.matches(" 30)").count(), CYCLES);
        assert!(text.contains("(400 50)"), "{text}");
    }
}
