//! `msdd reference`: simulates the whole box of a case by DEM.

mod compare;
mod summary;

use crate::confirm;
use crate::error::CliError;
use crate::named::parser;
use crate::progress::Progress;
use crate::rve::{read_state, write_state, write_vtk};
use clap::{Args, Subcommand};
use msdd_case::Case;
use msdd_case::mesh::Mesh;
use msdd_case::numbers::rounded;
use msdd_case::packing::sum_porosity;
use msdd_case::values::{contact_period, discs_seconds};
use msdd_dem::Simulation;
use msdd_dem_reference::model::{DISCS, Filling, ModelSpec, check_state, pack, statistics};
use msdd_dem_reference::run::Watch;
use msdd_dem_reference::start::InitialMeans;
use msdd_dem_reference::{ReferenceError, RunSpec, Statistics, fields, results::Results, run as run_case};
use msdd_files::{check_target, write};
use msdd_rve::Compression;
use msdd_rve::message::number;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

#[derive(Subcommand)]
pub enum Command {
    /// Pack the initial model of a case, and print its statistics next to the paper's.
    Pack(PackArguments),
    /// Run a case by DEM, with which the solver is compared, or continue a run that was killed.
    ///
    /// The discs have the friction, the stiffness ratio and the radii that the surrogate of the case was trained with
    /// (constant/granularProperties); a plug-in does not hold these, and is refused. The packing has its own porosity and
    /// pressure: where these differ from the start of the case, a warning gives the numbers. A run of more than an hour, by
    /// an estimate, needs a yes on the terminal, or --yes. A bed of spheres is refused: `msdd bed run` computes it.
    Run(RunArguments),
    /// Write the initial fields of the solver: averages over windows of the packed model around the cells.
    Fields(FieldsArguments),
    /// Print a table of results: mean and scatter over the seeds.
    Summary(summary::Arguments),
    /// Print the differences of a run of the solver from DEM in the temperatures at the probes. Results with
    /// grains other than in the case are refused; another start is a warning.
    Compare(compare::Arguments),
}

/// How a box is closed.
const CLOSINGS: [&str; 2] = ["horizontal", "isotropic"];

/// Which packed model.
#[derive(Args)]
pub struct ModelArguments {
    /// Case folder whose patches are left, right, bottom and top; materials, temperatures, times and box are read from its
    /// files.
    #[arg(long, value_name = "DIR")]
    case: PathBuf,
    /// Number that all random choices follow from.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Number of discs. The box is scaled, with the same shape and porosity, so that they fill it. Allowed: 100 to 1000000.
    /// Default: as many as fill the box of the case, 15000 for H, C and HC.
    #[arg(long)]
    discs: Option<usize>,
    /// State file of the packed model; if it does not exist, the model is packed and the file written. Default:
    /// `results/reference/packed_seed<N>.json`.
    #[arg(long, value_name = "FILE")]
    state: Option<PathBuf>,
    /// Porosity of the packing, overlaps counted once; the shipped model says how many discs that takes. Needs --state.
    /// Allowed: 0.06 to 0.19. Default: as full as in the cases of the paper.
    #[arg(long, value_name = "RATIO", requires = "state")]
    porosity: Option<f64>,
    /// How the box is closed: along x alone, as in the cases of the paper, or along x and y. Needs --state.
    #[arg(long, value_parser = parser::<Compression>(&CLOSINGS), default_value = CLOSINGS[0], requires = "state")]
    compression: Compression,
    /// Number of threads. Default: 2, or 1 on a machine with one core.
    #[arg(long, default_value_t = threads(), value_parser = crate::threads::parser())]
    threads: u32,
}

#[derive(Args)]
#[command(after_help = "Example: msdd reference pack --case cases/H --seed 1")]
pub struct PackArguments {
    #[command(flatten)]
    model: ModelArguments,
    /// Pack again even if the state file exists.
    #[arg(long)]
    force: bool,
}

#[derive(Args)]
#[command(after_help = "Example: msdd reference run --case cases/HC --seed 1 --out results/reference
writes HC_seed1.json and HC_seed1.csv there, and HC_seed1.checkpoint.json while it runs.")]
pub struct RunArguments {
    #[command(flatten)]
    model: ModelArguments,
    /// Folder for the results.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// End of the simulation [s]. Allowed: > 0. Default: endTime of the case.
    #[arg(long)]
    end: Option<f64>,
    /// Time between two lines of the time series [s]. Allowed: > 0, at most the end. Default: a 200th of the end, rounded to
    /// two digits.
    #[arg(long)]
    interval: Option<f64>,
    /// Number of times, evenly spaced over the run, at which profiles along x are recorded.
    #[arg(long, default_value_t = 21)]
    profiles: usize,
    /// Largest mechanical time step [s]. Allowed: > 0, at most the interval. Default: the stability bound.
    #[arg(long)]
    time_step: Option<f64>,
    /// Least time between two checkpoints, from which a killed run continues [s of the clock]. Allowed: ≥ 0.
    #[arg(long, default_value_t = 20.0)]
    checkpoint_every: f64,
    /// Divide heat capacity and all times of the case by this number, and multiply the times of the results by it. Grains
    /// that are in equilibrium all the time have the same temperatures and stresses then. Allowed: ≥ 1.
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0)]
    speed_up: f64,
    /// Begin a run of more than an hour without asking.
    #[arg(long)]
    yes: bool,
    /// Folder for a ParaView series, with one state for each time at which profiles are recorded.
    #[arg(long, value_name = "DIR")]
    vtk: Option<PathBuf>,
}

#[derive(Args)]
#[command(after_help = "Example: msdd reference fields --case cases/H --seed 1
writes porosity, fabricIndex and stress into cases/H/0 for the mesh in cases/H/constant/polyMesh.")]
pub struct FieldsArguments {
    #[command(flatten)]
    model: ModelArguments,
    /// Folder for the fields; default: the folder 0 of the case.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Shortest end of a run over the period of a contact \[-\] for which the discs were found to stay in equilibrium (book, Your own
/// material).
const SLOWEST: f64 = 2400.0;

fn threads() -> u32 {
    std::thread::available_parallelism().map_or(1, |n| n.get().min(2) as u32)
}

pub fn run(command: &Command) -> Result<(), CliError> {
    match command {
        Command::Pack(arguments) => pack_model(arguments),
        Command::Run(arguments) => run_model(arguments),
        Command::Fields(arguments) => write_fields(arguments),
        Command::Summary(arguments) => summary::run(arguments),
        Command::Compare(arguments) => compare::run(arguments),
    }
}

impl ModelArguments {
    fn filling(&self, case: &Case) -> Result<Filling, CliError> {
        let usual = Filling { isotropic: self.compression == Compression::Isotropic, ..Filling::of(case) };
        let Some(porosity) = self.porosity else { return Ok(usual) };
        let porosity = sum_porosity(porosity).map_err(ReferenceError::from)?;
        Ok(Filling { porosity, ..usual })
    }

    fn discs(&self, case: &Case) -> Result<usize, CliError> {
        Ok(self.discs.unwrap_or(self.filling(case)?.discs(case)))
    }

    fn path(&self, case: &Case) -> Result<PathBuf, CliError> {
        let name = match self.discs(case)? {
            DISCS => format!("packed_seed{}.json", self.seed),
            discs => format!("packed_{discs}_seed{}.json", self.seed),
        };
        Ok(self.state.clone().unwrap_or_else(|| Path::new("results/reference").join(name)))
    }

    /// The packed model: read from its file, or else packed now and written there.
    fn load(&self, case: &Case) -> Result<Simulation, CliError> {
        let path = self.path(case)?;
        if !path.exists() {
            self.pack(case)?;
        }
        // The state is always read from the file, so that a run does not depend on whether it packed the model itself.
        let simulation = read_state(&path)?;
        let refused = |error: ReferenceError| CliError::Message(format!("{}: {error}", path.display()));
        check_state(&simulation, case).map_err(refused)?;
        let wanted = self.discs(case)?;
        if self.state.is_none() && simulation.discs.len() != wanted {
            let found = simulation.discs.len();
            let message = format!("{}: {found} particles, allowed: {wanted}, or --state", path.display());
            return Err(CliError::Message(message));
        }
        Ok(simulation)
    }

    fn pack(&self, case: &Case) -> Result<(), CliError> {
        let path = self.path(case)?;
        check_target(&path)?;
        let begin = Instant::now();
        let mut progress = Progress::new("packing, %", 100);
        let spec = ModelSpec { discs: self.discs(case)?, seed: self.seed, filling: self.filling(case)? };
        let watch = |done: f64| progress.set((100.0 * done) as u64, 100, "");
        let model = pack(spec, case, self.threads as usize, watch)?;
        progress.finish();
        write_state(&path, &model.simulation)?;
        outln!(
            "packed seed {} in {:.1} s: {} after {} steps, {}",
            self.seed,
            begin.elapsed().as_secs_f64(),
            model.settled.outcome,
            model.settled.steps,
            path.display()
        );
        Ok(())
    }
}

fn pack_model(arguments: &PackArguments) -> Result<(), CliError> {
    let case = Case::read(&arguments.model.case)?;
    if arguments.force {
        arguments.model.pack(&case)?;
    }
    let simulation = arguments.model.load(&case)?;
    let packing = statistics(&simulation);
    print_statistics(&packing);
    print_grains(&case, &packing)
}

/// The grains that are simulated, and how the packing differs from the start of the case.
fn print_grains(case: &Case, packing: &Statistics) -> Result<(), CliError> {
    outln!("grains: {}", case.grains_of_surrogate());
    let start = match InitialMeans::of(case) {
        Ok(Some(start)) => start,
        Ok(None) => return Ok(()),
        // Such as fields that are made from this packing
        Err(error) => {
            outln!("Warning: the packing is not compared with the start of the case: {error}");
            return Ok(());
        }
    };
    if let Some(difference) = start.difference(packing) {
        outln!(
            "Warning: {difference}. Before a comparison, start the solver from this packing (msdd reference fields), or pack one like the \
             case's (msdd reference pack --force --porosity {:.4} --state FILE)",
            start.porosity
        );
    }
    Ok(())
}

/// Asks before a run that takes long, and warns of one that is too short for the discs to stay in equilibrium. Grains that stay where
/// they are conduct heat alone, which is quick. `end` \[s\]: of the run, which is sped up.
fn ask(arguments: &RunArguments, case: &Case, discs: usize, end: f64) -> Result<(), CliError> {
    if case.thermal.expansion == 0.0 {
        return Ok(());
    }
    let period = contact_period(&case.material, case.mean_radius);
    let seconds = discs_seconds(end, period, discs as f64) / f64::from(arguments.model.threads);
    let possible = end / (SLOWEST * period);
    if arguments.speed_up > 1.0 && possible < 1.0 {
        outln!(
            "Warning: the run lasts {:.0} vibrations of a contact. With fewer than {SLOWEST} it was not tried whether the grains stay in \
             equilibrium",
            end / period
        );
    }
    let advice = if possible > 1.0 {
        format!(
            "Grains this slow are in equilibrium all the time: a --speed-up of up to {} gives the same temperatures and stresses (book, Your \
             own material)",
            number(rounded(arguments.speed_up * possible, 1))
        )
    } else {
        "Fewer grains (--discs) or a shorter time (--end) take less".to_string()
    };
    confirm::long_run(seconds, &advice, arguments.yes)
}

fn print_statistics(s: &Statistics) {
    let [low, high] = s.porosity_range;
    outln!("porosity             {:.4}   paper 0.125", s.porosity);
    outln!("  of 10 x 3 regions  {low:.4} to {high:.4}   paper, windows: 0.117 to 0.131");
    outln!("  sum of areas       {:.4}", s.porosity_sum_of_areas);
    let [low, high] = s.fabric_range;
    outln!("fabric index         {:.4}   paper 0.050", s.fabric_index);
    outln!("  of 10 x 3 regions  {low:.4} to {high:.4}   paper, windows: 0.030 to 0.064");
    outln!("pressure [Pa]        {:.1}, stress_xx over stress_yy {:.3}", s.pressure, s.stress_ratio);
    let [left, right] = s.stress_xx_ends;
    outln!("stress_xx at the ends {left:.1} {right:.1} Pa, mean of the left and right tenth");
    let ([xx, yy], [nxx, nyy]) = (s.conductivity, s.conductivity_network);
    outln!("K/k, xx and yy       {xx:.4} {yy:.4}, network {nxx:.4} {nyy:.4}");
    outln!("coordination         {:.3}, rattlers {}", s.coordination, s.rattlers);
}

fn run_model(arguments: &RunArguments) -> Result<(), CliError> {
    let factor = arguments.speed_up;
    if !(factor >= 1.0 && factor.is_finite()) {
        return Err(CliError::Message(format!("--speed-up = {factor}, allowed: 1 or more")));
    }
    let case = Case::read(&arguments.model.case)?.sped_up(factor);
    let end = arguments.end.map_or(case.end_time, |end| end / factor);
    let start = arguments.model.load(&case)?;
    print_grains(&case, &statistics(&start))?;
    ask(arguments, &case, start.discs.len(), end)?;
    let every = Duration::try_from_secs_f64(arguments.checkpoint_every);
    let spec = RunSpec {
        seed: arguments.model.seed,
        end,
        interval: arguments.interval.unwrap_or_else(|| rounded(end * factor / 200.0, 2)) / factor,
        profiles: arguments.profiles,
        time_step: arguments.time_step,
        threads: arguments.model.threads as usize,
        checkpoint_every: every.map_err(|error| CliError::Message(format!("--checkpoint-every: {error}")))?,
    };
    let name = format!("{}_seed{}", case.name, arguments.model.seed);
    let file = |suffix: &str| arguments.out.join(format!("{name}.{suffix}"));
    let checkpoint = file("checkpoint.json");
    // Files that cannot be written are refused now rather than at the end of a long run.
    [&checkpoint, &file("json"), &file("csv")].into_iter().try_for_each(|file| check_target(file))?;
    let begin = Instant::now();
    let mut results = watched(&case, &start, &spec, &checkpoint, arguments)?;
    if factor > 1.0 {
        results = results.of_sped_up(factor);
    }
    let json = serde_json::to_string(&results).map_err(ReferenceError::from)?;
    write(&file("json"), json.as_bytes())?;
    write(&file("csv"), results.series.to_csv().as_bytes())?;
    let _ = std::fs::remove_file(&checkpoint);
    report(&name, &results, begin.elapsed());
    Ok(())
}

fn watched(
    case: &Case,
    start: &Simulation,
    spec: &RunSpec,
    checkpoint: &Path,
    arguments: &RunArguments,
) -> Result<Results, CliError> {
    // Progress is counted in milliseconds of simulated time
    let total = (1e3 * spec.end).ceil() as u64;
    let mut progress = Progress::new("simulated ms", total);
    let io = |error: CliError| ReferenceError::Watch(error.to_string());
    let mut watch = Watch {
        progress: &mut |time| progress.set(((1e3 * time) as u64).min(total), total, ""),
        profile: &mut |times, simulation| {
            let times: Vec<f64> = times.iter().map(|time| time * arguments.speed_up).collect();
            write_vtk(arguments.vtk.as_deref(), &times, simulation).map_err(io)
        },
        save: &mut |text| Ok(write(checkpoint, text.as_bytes())?),
    };
    let results = run_case(case, start, spec, checkpoint, &mut watch)?;
    progress.finish();
    Ok(results)
}

fn report(name: &str, results: &Results, elapsed: Duration) {
    let last = |column: &str| results.series.column(column).and_then(|values| values.last().copied());
    let show = |column: &str| last(column).map_or("-".to_string(), |value| format!("{value:.4}"));
    outln!(
        "{name}: {} steps, {} thermal sub-steps in {:.1} s; at the end T {}, porosity {}, fabric index {}, \
         pressure {} Pa, K/k {} {}",
        results.steps,
        results.thermal_substeps,
        elapsed.as_secs_f64(),
        show("T_mean"),
        show("porosity"),
        show("fabric_index"),
        show("pressure"),
        show("conductivity_xx"),
        show("conductivity_yy"),
    );
}

fn write_fields(arguments: &FieldsArguments) -> Result<(), CliError> {
    let case = Case::read(&arguments.model.case)?;
    let mesh = Mesh::read(&case.folder, "")?;
    let simulation = arguments.model.load(&case)?;
    let scale = simulation.walls.width() / case.size[0];
    let [left, _, bottom, _] = simulation.walls.position;
    let at =
        |[x, y, _]: [f64; 3]| [left + scale * (x - case.origin[0]), bottom + scale * (y - case.origin[1])];
    let centres: Vec<[f64; 2]> = mesh.centres.into_iter().map(at).collect();
    let begin = Instant::now();
    let window = fields::WINDOW * case.mean_radius;
    let averages = fields::around(&simulation, &centres, window, arguments.model.threads as usize)?;
    let note = format!(
        "Windows of {} mm of {} packed grains, seed {}: written by msdd reference fields",
        number(1e3 * window),
        simulation.discs.len(),
        arguments.model.seed
    );
    let out = arguments.out.clone().unwrap_or_else(|| case.folder.join("0"));
    for (name, text) in fields::files(&averages, case.thermal.conductivity, &note) {
        write(&out.join(name), text.as_bytes())?;
    }
    outln!(
        "{} cells in {:.1} s: porosity {:.4} to {:.4}, fabric index {:.4} to {:.4}, pressure {:.1} to {:.1} Pa, {}",
        averages.len(),
        begin.elapsed().as_secs_f64(),
        least(&averages, |a| a.porosity),
        -least(&averages, |a| -a.porosity),
        least(&averages, |a| a.fabric_index),
        -least(&averages, |a| -a.fabric_index),
        least(&averages, |a| a.pressure),
        -least(&averages, |a| -a.pressure),
        out.display()
    );
    Ok(())
}

fn least(averages: &[msdd_rve::Averages], value: impl Fn(&msdd_rve::Averages) -> f64) -> f64 {
    averages.iter().map(value).fold(f64::INFINITY, f64::min)
}
