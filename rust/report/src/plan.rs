//! The configurations of the report. To add one, add an entry in [`chart`].

use crate::jobs::job::{ENGINE, Job, SolverJob, ToolJob};
use crate::jobs::pool::Asked;

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
    pub family: &'static str,
    /// The job without case and packing.
    template: SolverJob,
    pub cases: Vec<&'static str>,
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
    fn named(mut self, name: &str, family: &'static str) -> Self {
        self.name = name.to_string();
        self.family = family;
        self
    }
    fn only(mut self, cases: &[&'static str]) -> Self {
        self.cases = cases.to_vec();
        self
    }
    fn change(mut self, change: impl Fn(SolverJob) -> SolverJob) -> Self {
        self.template = change(self.template);
        self
    }
    fn on(mut self, mesh: [usize; 2]) -> Self {
        self.template.mesh = mesh;
        self
    }
}

/// The cases of the chart.
pub const CHARTED: [&str; 3] = ["H", "C", "HC"];

/// The paper's scheme with fixed steps of `step` [s], the law of the increments, and grains that stay where they are.
fn fixed(step: &str, guess: f64) -> Configuration {
    let milliseconds = 1e3 * step.parse::<f64>().unwrap_or(0.0);
    Configuration {
        name: format!("fixed steps {milliseconds} ms"),
        family: FAMILIES[0],
        template: SolverJob::new("", 0).control(&format!("deltaT {step};")),
        cases: CHARTED.to_vec(),
        affine: false,
        known: CostSource::Run,
        packings: usize::MAX,
        guess,
    }
}

fn second_order(step: &str, guess: f64) -> Configuration {
    let base = fixed(step, guess).change(|job| job.solution("msddFoam { timeScheme secondOrder; }"));
    let name = base.name.replace("fixed", "second order, fixed");
    base.named(&name, FAMILIES[0])
}

/// Adaptive steps of second order with an error of at most `tolerance` [K] in each.
fn adaptive(tolerance: f64, guess: f64) -> Configuration {
    let keys = format!(
        "msddFoam {{ timeScheme secondOrder; temperatureTolerance {tolerance}; stateTolerance 0.5; }}\n\
         solvers {{ T {{ tolerance 1e-8; }} }}"
    );
    fixed("1e-2", guess)
        .named(&format!("adaptive, {tolerance} K"), FAMILIES[0])
        .change(|job| job.solution(&keys).control("adjustTimeStep yes;"))
}

fn moving(step: &str, guess: f64) -> Configuration {
    let base = fixed(step, guess).change(|job| job.grains("mechanics equilibrium;"));
    let name = format!("equilibrium, {}", base.name.replace("fixed ", ""));
    base.named(&name, FAMILIES[1])
}

fn moving_adaptive(tolerance: f64, guess: f64) -> Configuration {
    let base = adaptive(tolerance, guess).change(|job| job.grains("mechanics equilibrium;"));
    let name = format!("equilibrium, {}", base.name);
    base.named(&name, FAMILIES[1])
}

fn model(name: &str, family: &'static str, keys: &str, guess: f64) -> Configuration {
    let base = fixed("1e-2", guess).named(name, family);
    base.change(|job| job.grains(keys))
}

const PAPER: &str = "surrogate { model builtin:paper; }";
const MEDIUM: &str = "surrogate { type plugin; pluginCoeffs { library plugin.so; } }";

/// The configurations of the validation: the paper's algorithm with the law, the paper's network and boxes of
/// grains in all cells, and the law with grains that move.
pub fn validated(quick: bool) -> Vec<Configuration> {
    let all: Vec<&'static str> = msdd_reference::packings::CASES.iter().map(|case| case.0).collect();
    let mut law = fixed("1e-2", 2.0).named("law of the increments", FAMILIES[0]).only(&all);
    let mut paper = model("paper's network", FAMILIES[2], PAPER, 3.0).only(&all);
    let mut moves = moving("2e-2", 25.0).named("law of the increments, grains move", FAMILIES[1]);
    paper.affine = true;
    if quick {
        // On a coarser mesh, and fewer of them
        (law, paper, moves) =
            (law.on([25, 8]).only(&CHARTED), paper.on([25, 8]).only(&["HC"]), moves.on([10, 3]));
        moves = moves.change(|job| job.control("deltaT 0.1;"));
        moves.guess = 2.0;
    }
    let mut list = vec![law, moves, paper];
    if !quick {
        list.push(all_boxes().only(&all));
    }
    list
}

/// All points of the chart except those of DEM.
pub fn chart(quick: bool) -> Vec<Configuration> {
    let coarse = |base: Configuration, mesh: [usize; 2]| {
        let (name, family) = (format!("{}, {}x{}", base.name, mesh[0], mesh[1]), base.family);
        base.on(mesh).named(&name, family)
    };
    if quick {
        return vec![
            coarse(fixed("1e-1", 0.5), [25, 8]),
            coarse(adaptive(0.5, 0.5), [25, 8]),
            coarse(model("constant", FAMILIES[4], "surrogate { type constant; }", 0.5), [25, 8])
                .only(&["HC"]),
            coarse(fixed("1e-1", 0.5).named("steps 100 ms", FAMILIES[6]), [100, 1]).only(&["HC"]),
        ];
    }
    let mut affine = model("affine conductivity", FAMILIES[0], "surrogate { conductivity affine; }", 2.0);
    affine.affine = true;
    let mut paper = model("paper's network, steps 10 ms", FAMILIES[2], PAPER, 3.0);
    let mut paper_coarse = model("paper's network, steps 100 ms", FAMILIES[2], PAPER, 0.6)
        .change(|job| job.control("deltaT 0.1;"));
    (paper.affine, paper_coarse.affine) = (true, true);
    let mut segment = fixed("1e-4", 10.0).named("fixed steps 0.1 ms", FAMILIES[0]);
    segment.known = CostSource::Segment(1.0, "fixed steps 1 ms".to_string());
    segment = segment.change(|mut job| {
        job.end = 1.0;
        job
    });
    let mut list = vec![
        fixed("1e-1", 0.5),
        fixed("1e-2", 2.0),
        fixed("1e-3", 15.0),
        segment,
        second_order("5e-2", 1.0),
        second_order("1e-2", 4.0),
        adaptive(1.0, 0.5),
        adaptive(0.05, 0.8),
        adaptive(0.005, 2.0),
        coarse(adaptive(0.5, 0.3), [10, 3]),
        coarse(adaptive(0.5, 0.3), [25, 8]),
        coarse(adaptive(0.05, 0.4), [50, 15]),
        coarse(adaptive(0.05, 3.0), [200, 60]),
        paper_coarse,
        paper,
        affine,
        model("constant", FAMILIES[4], "surrogate { type constant; }", 1.0),
        coarse(model("constant", FAMILIES[4], "surrogate { type constant; }", 0.4), [25, 8]),
        model("steps 10 ms", FAMILIES[3], MEDIUM, 3.0).change(|mut job| {
            job.plugin = Some("rust/capi/examples/effective_medium.c".to_string());
            job
        }),
        moving("1e-1", 6.0),
        moving("2e-2", 25.0),
        coarse(moving("1e-1", 1.0), [10, 3]),
        coarse(moving("1e-1", 2.0), [25, 8]),
        coarse(moving("1e-1", 3.0), [50, 15]),
        moving_adaptive(0.05, 2.0),
        coarse(moving_adaptive(0.05, 0.7), [50, 15]),
        coarse(moving_adaptive(0.5, 0.3), [25, 8]),
        coarse(fixed("1e-1", 0.4).named("steps 100 ms", FAMILIES[6]), [100, 1]).only(&["HC"]),
        coarse(moving("1e-1", 2.0).named("equilibrium, steps 100 ms", FAMILIES[6]), [100, 1]).only(&["HC"]),
    ];
    list.extend(online());
    list
}

/// Configurations with boxes of grains that are simulated during the run: one for every cell on coarse meshes; shared by cells
/// of similar state; and one for every cell of the fine mesh, for which only the cost is estimated.
fn online() -> Vec<Configuration> {
    let mut fine = all_cells("2e-3", 150.0).named("all cells, 100x30, one packing", FAMILIES[5]);
    fine.known = CostSource::Answers(0.4, all_boxes().name);
    fine = fine.change(|mut job| {
        job.end = 0.4;
        job
    });
    let mut list = vec![
        all_cells("1e-3", 40.0).on([10, 3]).named("all cells, 10x3, one packing", FAMILIES[5]),
        all_boxes(),
    ];
    list.push(fine);
    list.extend([("2e-2", 15.0), ("5e-3", 20.0), ("1e-3", 50.0)].map(|(tolerance, guess)| {
        let keys = format!("rvePer history; strainTolerance {tolerance};");
        boxes(&format!("shared, tolerance {tolerance}, 100x30, one packing"), "", &keys, guess)
    }));
    let few = "rvePer history; strainTolerance 5e-3; porosityTolerance 5e-3; fabricTolerance 0.1;";
    list.push(boxes("shared, tolerance 5e-3, few packings, 100x30, one packing", "", few, 10.0));
    list
}

/// A box for every cell, on a mesh so coarse that a run takes minutes. Also part of the validation.
fn all_boxes() -> Configuration {
    all_cells("2e-3", 200.0).on([30, 9]).named("all cells, 30x9, one packing", FAMILIES[5])
}

/// A box for every cell, which is simulated again whenever the cell has strained by `strain`.
fn all_cells(strain: &str, guess: f64) -> Configuration {
    boxes("", &format!("smallestStrain {strain};"), "", guess)
}

/// Boxes of grains simulated while the solver runs.
fn boxes(name: &str, keys: &str, coefficients: &str, guess: f64) -> Configuration {
    let text = format!(
        "surrogate {{ type onlineRve; {keys} onlineRveCoeffs {{ conductivity network; compression horizontal; {coefficients} }} }}"
    );
    let mut base = model(name, FAMILIES[5], &text, guess).change(|job| job.control("deltaT 0.1;"));
    base = base.change(|mut job| {
        job.limit = 1800;
        job
    });
    // One packing only, because these runs cost as much as the rest of the chart together.
    base.packings = 1;
    base
}

/// A run of a case by DEM on one thread, to `end` \[s\]. `step`: largest time step \[s\]; `None`: that of the
/// stability bound.
pub fn elements(case: &str, end: f64, step: Option<f64>, limit: u64) -> Job {
    let mut arguments: Vec<String> = ["reference", "run", "--case", &format!("cases/{case}"), "--seed", "1"]
        .iter()
        .chain(&["--out", "WORK", "--threads", "1", "--end", &end.to_string()])
        .map(|text| (*text).to_string())
        .collect();
    if let Some(step) = step {
        arguments.extend(["--time-step".to_string(), step.to_string()]);
    }
    tool(arguments, &["cases/common"], limit)
}

pub fn tool(arguments: Vec<String>, inputs: &[&str], limit: u64) -> Job {
    let inputs = ENGINE.iter().chain(inputs).map(|text| (*text).to_string()).collect();
    Job::Tool(ToolJob { arguments, inputs, output: None, limit })
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
            assert_eq!(names.len(), list.len());
            assert!(list.iter().chain(&validated(quick)).all(|c| FAMILIES.contains(&c.family)));
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
