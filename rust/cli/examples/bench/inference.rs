//! `bench inference`: time that a surrogate model needs for a query, that is for one step of one cell.

use clap::Args;
use msdd_cli::shared::{CliError, SimdArgument};
use msdd_files::read_text;
use msdd_surrogate::kernel;
use msdd_surrogate::kernel::LANES;
use msdd_surrogate::models;
use msdd_surrogate::spheres::model::{Answers, Block, SphereModel, Wanted};
use msdd_surrogate::spheres::state;
use msdd_surrogate::surrogate::{Answer, Increment, InitialData, StateLanes, Surrogate, Tangent};
use serde_json::{Map, Value, json};
use std::path::PathBuf;
use std::time::Instant;

#[derive(Args)]
#[command(
    after_help = "A query is one step of one cell, with all outputs: state, conductivity, stress, and where said the tangent. One thread."
)]
pub struct Arguments {
    /// Model file; may be given several times.
    #[arg(long, value_name = "FILE", required = true)]
    model: Vec<PathBuf>,
    /// Queries to time for each batch size. Allowed: ≥ 1.
    #[arg(long, default_value_t = 3_000_000)]
    queries: usize,
    #[command(flatten)]
    simd: SimdArgument,
}

/// Numbers of cells in a batch: one cell, a few vector registers, a typical case, and more than fits into the caches.
const BATCHES: [usize; 4] = [1, 64, 3_000, 1_000_000];

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    arguments.simd.apply()?;
    let mut results = Map::new();
    let queries = arguments.queries;
    for file in &arguments.model {
        let failed = |source| CliError::Model { file: file.clone(), source };
        let text = read_text(file)?;
        let (name, hash, times) = if SphereModel::has_sphere_schema(&text) {
            let model = SphereModel::read(&text).map_err(failed)?;
            let times = BATCHES.map(|cells| {
                let [plain, tangent] = [false, true].map(|tangent| spheres(&model, cells, queries, tangent));
                times(cells, plain, Some(tangent))
            });
            (model.file.name.clone(), model.hash().to_string(), times)
        } else {
            let model = models::read(&text).map_err(failed)?;
            let times = BATCHES.map(|cells| {
                let tangent = model.has_tangent().then(|| discs(model.as_ref(), cells, queries, true));
                times(cells, discs(model.as_ref(), cells, queries, false), tangent)
            });
            (model.name().to_string(), model.hash().to_string(), times)
        };
        results.insert(name, json!({ "file": file, "hash": hash, "batches": times }));
    }
    let result = json!({ "simd": kernel::simd(), "models": Value::Object(results) });
    let text = serde_json::to_string_pretty(&result);
    println!("{}", text.map_err(|error| CliError::Message(error.to_string()))?);
    Ok(())
}

fn times(cells: usize, plain: f64, tangent: Option<f64>) -> Value {
    json!({ "batch": cells, "ns_per_query": plain, "ns_per_query_with_tangent": tangent })
}

/// Many short rounds: on a busy machine, some of them fall between two interruptions and are measured undisturbed.
const ROUNDS: usize = 300;

/// Nanoseconds per query in the fastest of several rounds of this work, the one that other programs have disturbed least.
fn nanoseconds(cells: usize, queries: usize, mut work: impl FnMut()) -> f64 {
    let repeats = (queries / (ROUNDS * cells)).max(1);
    let rounds = (queries / (repeats * cells)).clamp(3, ROUNDS);
    let mut best = f64::INFINITY;
    for _ in 0..rounds {
        let begin = Instant::now();
        (0..repeats).for_each(|_| work());
        best = best.min(begin.elapsed().as_secs_f64() * 1e9 / (repeats * cells) as f64);
    }
    best
}

/// Strains of both signs, as small as in a step of the solver.
fn strain(cell: usize) -> f64 {
    1e-5 * ((cell % 7) as f64 - 3.0)
}

/// Nanoseconds per query of a model of discs.
fn discs(model: &dyn Surrogate, cells: usize, queries: usize, with_tangent: bool) -> f64 {
    let start = |cell: usize| {
        let porosity = 0.08 + 0.1 * (cell % 97) as f64 / 97.0;
        let fabric_index = 0.1 * ((cell % 31) as f64 / 31.0 - 0.5);
        model.initial_state(&InitialData { porosity, fabric_index, ..InitialData::default() })
    };
    let block = |first: usize| {
        let (mut state, mut thermal) = (StateLanes::default(), [0.0; LANES]);
        for (lane, cell) in (first..first + LANES).enumerate() {
            state.iter_mut().zip(start(cell)).for_each(|(column, value)| column[lane] = value);
            thermal[lane] = strain(cell);
        }
        (state, Increment::thermal(&thermal))
    };
    let blocks: Vec<(StateLanes, Increment)> = (0..cells).step_by(LANES).map(block).collect();
    let (mut answer, mut tangent) = (Answer::default(), Tangent::default());
    nanoseconds(cells, queries, || {
        for (state, strain) in &blocks {
            model.advance(state, strain, &mut answer, with_tangent.then_some(&mut tangent));
            std::hint::black_box((&answer, &tangent));
        }
    })
}

/// Logarithm of R/h of a usual gas, for [`SphereModel::advance`].
const GAS_NUMBER: f64 = 6.0;

/// Nanoseconds per query of a law of spheres.
fn spheres(model: &SphereModel, cells: usize, queries: usize, with_tangent: bool) -> f64 {
    // Pressures from those of a bed under its own weight to those of one that is pressed by its vessel.
    let start = |cell: usize| {
        let solid = 0.59 + 0.04 * (cell % 97) as f64 / 97.0;
        let pressure = 1e-7 * 1.2_f64.powi((cell % 31) as i32);
        let stress = [pressure, pressure, 1.5 * pressure, 0.0, 0.0, 0.0];
        model.initial_state(solid, stress, &state::PackingData::default())
    };
    let block = |first: usize| {
        let mut block = Block::default();
        for (lane, cell) in (first..cells.min(first + LANES)).enumerate() {
            block.state.iter_mut().zip(start(cell)).for_each(|(column, value)| column[lane] = value);
            block.thermal[lane] = strain(cell);
            block.cell[2][lane] = 0.5 * strain(cell + 2);
            block.gas_number[lane] = GAS_NUMBER;
        }
        (block, LANES.min(cells - first))
    };
    let blocks: Vec<(Block, usize)> = (0..cells).step_by(LANES).map(block).collect();
    let mut answers = Answers::default();
    let wanted = Wanted { strains: if with_tangent { 6 } else { 0 }, conduction: true };
    nanoseconds(cells, queries, || {
        for (block, cells) in &blocks {
            model.advance_block(block, *cells, wanted, &mut answers);
            std::hint::black_box(&answers);
        }
    })
}
