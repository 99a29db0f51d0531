//! `msdd case new`.

use super::common_options::{CommonOptions, summary};
use super::prompts::Prompter;
use super::sphere_options::{self, SphereOptions};
use crate::error::CliError;
use crate::progress::Progress;
use clap::Args;
use msdd_beds::case::BedCase;
use msdd_case::CaseError;
use msdd_case::folder::{self, File, check_folder, files};
use msdd_case::material::{DISCS, SPHERES};
use msdd_case::packing::{Effort, pack};
use msdd_case::scene::DiscCase;
use msdd_case::spheres::{self, scene::SphereCase};
use msdd_case::values::packing_rows;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// Boxes of discs that are packed unless another number is given.
const PACKINGS: u32 = 16;

#[derive(Args)]
#[command(
    after_help = "On a terminal the program prompts for everything that is not given as an option, and proposes a value; an empty answer \
takes the proposal. Without a terminal, or with --yes, all proposals are taken.

Examples:
  msdd case new ~/beds/bed                            prompts
  msdd case new store --yes --spheres --radius 0.1 --height 0.4 --side 400 --bottom 293 --gas helium
  msdd case new store --from mybed/bed.toml           the bed of a description
  msdd case new bed --yes                             discs: the model material of the paper, hot on the left
  msdd case new bed --yes --material glass --box 0.05x0.02 --left 350 --pressure 2e6
  msdd case new bed --yes --box 0.5x0.2 --left insulated --right insulated --top 50 --bottom 50 --heat-source 3000

Then: bed/Allrun. The folder needs no files of other cases, so it may stand anywhere and be copied."
)]
pub struct Arguments {
    /// The new case folder; it must not exist yet, or be empty. Default: required, except with --list-materials.
    #[arg(required_unless_present = "list_materials")]
    folder: Option<PathBuf>,
    /// No questions: take the proposed value of everything that is not given as an option.
    #[arg(long, visible_alias = "non-interactive", conflicts_with = "ask")]
    yes: bool,
    /// Prompt even if the input is not a terminal; answers are read line by line.
    #[arg(long)]
    ask: bool,
    /// Write into a folder that is not empty: files of the same name are replaced, all others stay.
    #[arg(long)]
    force: bool,
    /// List the materials that can be named by --material, as files with their values and sources.
    #[arg(long)]
    list_materials: bool,
    /// A bed of equal spheres with gas between them, in a box or in a cylinder, with gravity and rough walls; else discs in
    /// the plane.
    #[arg(long)]
    spheres: bool,
    /// Number of threads; the results do not depend on it. Default: all processor cores, at most 64.
    #[arg(long, default_value_t = threads(), value_parser = crate::threads::parser())]
    threads: u32,
    /// MSDD's checkout, whose solver the case will run. Default: the one that this program was built in.
    #[arg(long, value_name = "DIR")]
    checkout: Option<PathBuf>,
    /// The bed of a file bed.toml, as `msdd bed run` and `msdd bed from-case` read and write it, instead of options. The file needs
    /// `container.height`; cells, points and whatever else its section `[solver]` does not give are proposals.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["spheres", "ask", "packings", "seed", "CommonOptions", "GrainWishes", "SphereOptions"])]
    from: Option<PathBuf>,
    #[command(flatten)]
    wishes: CommonOptions,
    /// Number of boxes of 500 discs that are packed to find the initial state; their averages are averaged. Default: 16.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1000), help_heading = "Packing at the start")]
    packings: Option<u32>,
    /// Seed of the random numbers for the first box, a whole number; each further box has the next one. Default: 1.
    #[arg(long, help_heading = "Packing at the start")]
    seed: Option<u64>,
    #[command(flatten)]
    sphere_wishes: SphereOptions,
}

fn threads() -> u32 {
    std::thread::available_parallelism().map_or(1, |n| n.get().min(64) as u32)
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    let Some(folder) = &arguments.folder else {
        list_materials();
        return Ok(());
    };
    arguments.wishes.grains.refuse_foreign()?;
    let whole = check_folder(folder, arguments.force)?;
    let checkout = checkout(arguments.checkout.as_deref())?;
    let terminal = std::io::stdin().is_terminal() && std::io::stdout().is_terminal();
    let prompter = Prompter { interactive: arguments.ask || (terminal && !arguments.yes) };
    let name = whole.file_name().unwrap_or_default().to_string_lossy();
    let made = if let Some(file) = &arguments.from {
        spheres_made(&of_file(file)?, &name, &checkout)?
    } else if asks_for_spheres(arguments, &prompter)? {
        spheres_made(&of_options(arguments, &prompter)?, &name, &checkout)?
    } else {
        discs_made(arguments, &prompter, &name, &checkout)?
    };
    folder::write(folder, &made)?;
    outln!("written: {}", folder.display());
    super::check::report_or_note(folder)?;
    outln!("{}", next_steps(folder, &name));
    Ok(())
}

/// What to do with a new case.
fn next_steps(folder: &Path, name: &str) -> String {
    let folder = folder.display();
    format!(
        "Next:\n    {folder}/Allrun    makes the mesh and runs msddFoam; its log ends with results, accuracy and warnings\n    \
         results: {folder}/show.html, a page with maps, curves and key numbers; tables in {folder}/postProcessing\n    \
         fields: open {folder}/{name}.foam in ParaView; {folder}/README.md says what is where"
    )
}

fn asks_for_spheres(arguments: &Arguments, prompter: &Prompter) -> Result<bool, CliError> {
    let help = "The bed is of equal spheres with gas between them, in space; or of discs in the plane, the model material of the paper.";
    // Scripts that do not say what they want get discs, as ever.
    let proposal = if prompter.interactive { "spheres" } else { "discs" };
    prompter.value(arguments.spheres.then_some(true), help, "Grains (spheres or discs)", proposal, |text| {
        match text {
            "spheres" => Ok(true),
            "discs" => Ok(false),
            _ => Err("spheres, discs".to_string()),
        }
    })
}

fn of_file(file: &Path) -> Result<SphereCase, CliError> {
    let bed = BedCase::read_file(file)?;
    let named = |error: CaseError| CliError::Message(format!("{}: {error}", file.display()));
    SphereCase::new(&bed, &format!("spheres of {}", file.display())).map_err(named)
}

fn of_options(arguments: &Arguments, prompter: &Prompter) -> Result<SphereCase, CliError> {
    // Not by clap: where an option conflicts with --spheres, it forgets that others require --spheres.
    let of_discs = [
        ("--packings", arguments.packings.is_some()),
        ("--seed", arguments.seed.is_some()),
        ("--compression", arguments.wishes.compression.is_some()),
        ("--model", arguments.wishes.model.is_some()),
    ];
    if let Some((option, _)) = of_discs.iter().find(|(_, given)| *given) {
        let message = format!("{option} cannot be used with --spheres: it belongs to discs");
        return Err(CliError::Message(message));
    }
    arguments.sphere_wishes.scene(&arguments.wishes, prompter)
}

fn spheres_made(scene: &SphereCase, name: &str, checkout: &Path) -> Result<Vec<File>, CliError> {
    outln!("{}", sphere_options::summary(scene)?);
    for note in scene.notes() {
        outln!("Note: {note}");
    }
    Ok(spheres::folder::files(scene, name, checkout)?)
}

fn discs_made(
    arguments: &Arguments,
    prompter: &Prompter,
    name: &str,
    checkout: &Path,
) -> Result<Vec<File>, CliError> {
    let scene = arguments.wishes.scene(prompter)?;
    outln!("{}", summary(&scene));
    let packing = packed(&scene, arguments)?;
    outln!(
        "packing at the start, mean of {} boxes of {} grains, and scatter between boxes:",
        packing.boxes,
        packing.grains
    );
    for [what, mean, deviation] in packing_rows(&packing) {
        outln!("    {what:55} {mean:>10} +- {deviation}");
    }
    Ok(files(&scene, &packing, name, checkout))
}

fn packed(scene: &DiscCase, arguments: &Arguments) -> Result<msdd_case::packing::Packing, CliError> {
    let boxes = arguments.packings.unwrap_or(PACKINGS) as usize;
    let progress = Mutex::new(Progress::new("packing boxes of grains", boxes as u64));
    let watch = |done: usize, all: usize| {
        if let Ok(mut progress) = progress.lock() {
            progress.set(done as u64, all as u64, "");
        }
    };
    let effort = Effort { boxes, seed: arguments.seed.unwrap_or(1), threads: arguments.threads as usize };
    let packing = pack(scene.discs(), scene.start, effort, &watch)?;
    if let Ok(progress) = progress.lock() {
        progress.finish();
    }
    Ok(packing)
}

/// The checkout with the solver: the one that was named, else the one that contains this program, else the one that it was
/// compiled in.
pub fn checkout(named: Option<&Path>) -> Result<PathBuf, CliError> {
    let is_checkout = |folder: &Path| folder.join("scripts/foam-env").is_file();
    let missing = |folder: &Path| {
        let folder = folder.display();
        CliError::Message(format!(
            "--checkout = {folder}, allowed: a checkout of MSDD, which has scripts/foam-env"
        ))
    };
    if let Some(folder) = named {
        let whole = folder.canonicalize().unwrap_or(folder.to_path_buf());
        return if is_checkout(&whole) { Ok(whole) } else { Err(missing(folder)) };
    }
    let program = std::env::current_exe().and_then(|path| path.canonicalize()).unwrap_or_default();
    let built = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap_or_default();
    let found = program.ancestors().find(|folder| is_checkout(folder)).map(Path::to_path_buf);
    found.or_else(|| is_checkout(&built).then_some(built)).ok_or_else(|| {
        CliError::Message("no checkout of MSDD above this program; name it by --checkout DIR".to_string())
    })
}

/// The files of the named materials: any of them may be the beginning of the user's own.
fn list_materials() {
    let print = |materials: &[(&str, &str)]| {
        materials.iter().for_each(|(name, text)| outln!("\n# {name}\n{}", text.trim_end()));
    };
    outln!("# Discs");
    print(&DISCS);
    outln!("\n# Spheres (--spheres); their law is valid for a friction of 0.3");
    print(&SPHERES);
}
