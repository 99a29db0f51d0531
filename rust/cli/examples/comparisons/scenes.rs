//! `comparisons scenes`: makes the reference scenes of a plan, and sets the solver next to them.

use crate::bands::{self, Done};
use crate::dem::discs::{packed, packing_of, simulate};
use crate::dem::table::{Row, row};
use crate::dem::{Plan, PlannedScene, SceneResults, data};
use crate::requests;
use clap::Args;
use msdd_autotune::bands::Law;
use msdd_autotune::bed::Grains;
use msdd_case::folder;
use msdd_cli::shared::{CliError, checkout, read_state, threads_parser, write_state};
use msdd_dem_reference::{ReferenceError, fields};
use msdd_files::write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

#[derive(Args)]
#[command(
    after_help = "Example: comparisons scenes --plan cases/scenes/plan.toml --out results/scenes --solver
What is there already is not made again; results of a scene that has changed in the plan are replaced."
)]
pub struct Arguments {
    /// The plan.
    #[arg(long, value_name = "FILE")]
    plan: PathBuf,
    /// Folder for the results: for each scene and packing the packed box, a case folder for the solver, and the results of the
    /// discs.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Only the scene of this name; may be given several times. Default: all.
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// Run the solver in the case folders, too, always again, and print its errors next to the scatter of DEM; --bands and --requests
    /// do that, too.
    #[arg(long)]
    solver: bool,
    /// Fit the error bands of the solver to the scenes for calibration, write their numbers into this file (JSON), and print
    /// how they do in all scenes; not with --only.
    #[arg(long, value_name = "FILE", conflicts_with = "only")]
    bands: Option<PathBuf>,
    /// Request accuracies of 5, 2 and 1 % in the first packing of each scene, compare what is chosen with the discs, and
    /// write that into this file (CSV).
    #[arg(long, value_name = "FILE")]
    requests: Option<PathBuf>,
    /// Folder for the tables of all scenes, packings.csv, probes.csv.gz and windows.csv.gz; not with --only.
    #[arg(long, value_name = "DIR", conflicts_with = "only")]
    tables: Option<PathBuf>,
    /// Number of threads; the results do not depend on it.
    #[arg(long, default_value_t = 1, value_parser = threads_parser())]
    threads: u32,
    /// MSDD's checkout, whose solver the case folders run. Default: the one that this program was built in.
    #[arg(long, value_name = "DIR")]
    checkout: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let plan = Plan::read(&arguments.plan)?;
    let names: Vec<&str> = plan.scenes.iter().map(|scene| scene.name.as_str()).collect();
    if let Some(name) = arguments.only.iter().find(|name| !names.contains(&name.as_str())) {
        let text = format!("--only = {name}, allowed: {}", names.join(", "));
        return Err(CliError::Message(text));
    }
    let checkout = checkout(arguments.checkout.as_deref())?;
    let wanted = |scene: &&PlannedScene| arguments.only.is_empty() || arguments.only.contains(&scene.name);
    let mut all: Vec<Done> = Vec::new();
    for scene in plan.scenes.iter().filter(wanted) {
        let folder = arguments.out.join(&scene.name);
        begin(&folder, &plan, scene)?;
        let packing = |&seed: &u64| {
            let results = discs(&folder, &plan, scene, seed, arguments.threads as usize, &checkout)?;
            Ok::<_, CliError>((results, case_folder(&folder, seed)))
        };
        all.push((scene, scene.seeds.iter().map(packing).collect::<Result<_, _>>()?));
    }
    if let Some(folder) = &arguments.tables {
        let rows = all.iter().flat_map(|(scene, packings)| packings.iter().map(|p| (*scene, p.0.clone())));
        data::write(folder, &rows.collect::<Vec<_>>())?;
    }
    if arguments.solver || arguments.bands.is_some() || arguments.requests.is_some() {
        print_table(&all, &checkout)?;
    }
    let law = match &arguments.bands {
        Some(file) => bands::calibrate(&all, file, arguments.tables.as_deref())?,
        None => Law::shipped(Grains::Discs),
    };
    match &arguments.requests {
        Some(file) => requests::judge(&all, &law, file),
        None => Ok(()),
    }
}

fn case_folder(folder: &Path, seed: u64) -> PathBuf {
    folder.join(format!("seed{seed}"))
}

/// Makes the folder of a scene, or removes what is in it if it was made for another plan.
fn begin(folder: &Path, plan: &Plan, scene: &PlannedScene) -> Result<(), CliError> {
    let file = folder.join("scene.json");
    let text = serde_json::to_string(&(plan.outputs, scene)).map_err(ReferenceError::from)?;
    if file.exists() && msdd_files::read_text(&file)? == text {
        return Ok(());
    }
    for seed in file.exists().then_some(&scene.seeds).into_iter().flatten() {
        println!("{}, seed {seed}: the plan has changed, begun anew", scene.name);
        for file in [state_file(folder, *seed), result_file(folder, *seed)] {
            let _ = std::fs::remove_file(file);
        }
        let _ = std::fs::remove_dir_all(case_folder(folder, *seed));
    }
    Ok(write(&file, text.as_bytes())?)
}

fn state_file(folder: &Path, seed: u64) -> PathBuf {
    folder.join(format!("packed_seed{seed}.json"))
}

fn result_file(folder: &Path, seed: u64) -> PathBuf {
    folder.join(format!("discs_seed{seed}.json"))
}

/// The results of a packing's discs: read, or else packed, written as a case folder, and simulated.
fn discs(
    folder: &Path,
    plan: &Plan,
    scene: &PlannedScene,
    seed: u64,
    threads: usize,
    checkout: &Path,
) -> Result<SceneResults, CliError> {
    let (state, result) = (state_file(folder, seed), result_file(folder, seed));
    if result.exists() {
        return Ok(SceneResults::read(&result)?);
    }
    let begin = Instant::now();
    if !state.exists() {
        write_state(&state, &packed(scene, seed, threads)?)?;
    }
    // The state is always read from its file, so that a run does not depend on whether it packed the box itself.
    let start = read_state(&state)?;
    write_case(&case_folder(folder, seed), scene, &start, seed, threads, checkout)?;
    let packed = begin.elapsed().as_secs_f64();
    let results = simulate(plan, scene, &start, seed, threads)?;
    write(&result, serde_json::to_string(&results).map_err(ReferenceError::from)?.as_bytes())?;
    println!(
        "{}, seed {seed}: {} discs packed in {packed:.1} s, run in {:.1} s",
        scene.name,
        start.discs.len(),
        begin.elapsed().as_secs_f64() - packed
    );
    Ok(results)
}

/// Writes a case folder for the solver, with the packing's own initial fields.
fn write_case(
    folder: &Path,
    scene: &PlannedScene,
    start: &msdd_dem::Simulation,
    seed: u64,
    threads: usize,
    checkout: &Path,
) -> Result<(), CliError> {
    let packing = packing_of(scene, start)?;
    let solver = scene.scene(packing.porosity.mean)?;
    folder::write(folder, &folder::files(&solver, &packing, &scene.name, checkout))?;
    let (cell, [nx, ny]) = (solver.cell(), solver.cells);
    let centre = |k: usize| [(k % nx) as f64 + 0.5, (k / nx) as f64 + 0.5];
    let centres: Vec<[f64; 2]> = (0..nx * ny)
        .map(|k| {
            let [x, y] = centre(k);
            [x * cell[0], y * cell[1]]
        })
        .collect();
    let averages = fields::around(start, &centres, fields::WINDOW * scene.mean_radius, threads)?;
    let note = format!("Windows of the packing of the scene {}, seed {seed}", scene.name);
    for (name, text) in fields::files(&averages, scene.thermal_conductivity, &note) {
        write(&folder.join("0").join(name), text.as_bytes())?;
    }
    Ok(())
}

/// Runs the solver in a case folder, always anew, since the solver may have changed; the message if it fails.
pub fn solve(folder: &Path, checkout: &Path) -> Result<(), String> {
    let mut program = Command::new("bash");
    program.arg("Allrun").current_dir(folder).env("MSDD", checkout).stdin(Stdio::null());
    let output = program.output().map_err(|error| format!("cannot start bash: {error}"))?;
    if output.status.success() {
        return Ok(());
    }
    Err(String::from_utf8_lossy(&output.stderr).trim().to_string())
}

fn print_table(all: &[Done], checkout: &Path) -> Result<(), CliError> {
    println!(
        "T: at the probes, in % of the scene's range of T; p: mean of the box, in % of the scene's largest p"
    );
    println!("differences of solver and discs, and standard deviations between packings: mean and largest");
    println!(
        "{:25} {:9} {:>5} {:>7}  {:>13}  {:>13}  {:>13}  {:>13}",
        "scene", "use", "discs", "range", "T", "T scatter", "p", "p scatter"
    );
    for (scene, packings) in all {
        let head = format!("{:25} {:9}", scene.name, scene.purpose.as_str());
        let failed: Vec<String> =
            packings.iter().filter_map(|(_, folder)| solve(folder, checkout).err()).collect();
        if let Some(problem) = failed.first() {
            println!("{head} the solver failed in {} of {}: {problem}", failed.len(), packings.len());
            continue;
        }
        let range = scene.case()?.temperature_range();
        let list: Vec<(&SceneResults, &Path)> =
            packings.iter().map(|(results, folder)| (results, folder.as_path())).collect();
        let Row { temperature, temperature_scatter, pressure, pressure_scatter } = row(&list, range)?;
        let sizes = [temperature, temperature_scatter, pressure, pressure_scatter];
        let cells = sizes.map(|size| format!("{:>6.2} {:>6.2}", size.mean, size.worst));
        println!("{head} {:>5} {range:>7}  {}", list[0].0.packing.rows[0][0], cells.join("  "));
    }
    Ok(())
}
