//! `msdd score`: errors of a model on packings that were not used in its training.

mod plot;

use crate::error::CliError;
use crate::output::write_json;
use crate::spheres;
use clap::Args;
use msdd_case::numbers::short;
use msdd_files::{check_target, write};
use msdd_rve::database::read_all;
use msdd_surrogate::SurrogateError;
use msdd_surrogate::composition::Composed;
use msdd_surrogate::models;
use msdd_surrogate::score::{OneStep, Score, ramps, score};
use msdd_surrogate::surrogate::Surrogate;
use msdd_surrogate::tracks::PathErrors;
use msdd_surrogate::training_data::TrainingData;
use msdd_surrogate::wall_friction::WallFriction;
use msdd_training::training_data;
use std::path::PathBuf;

#[derive(Args)]
pub struct Arguments {
    /// Model file, or a shipped model (builtin, builtin:paper, builtin:spheres); given several times, the main errors of the models are printed side by side at the end.
    #[arg(long, value_name = "FILE", required = true)]
    model: Vec<PathBuf>,
    /// Database, or the CSV that was exported from one; given several times, all of them together. If the model was trained
    /// on it, the packings that were held out of the training are used, else all. For spheres also a folder of beds.
    #[arg(long, value_name = "FILE", required = true)]
    database: Vec<PathBuf>,
    /// JSON file to write: a list with one entry for each model.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Folder for the plots (SVG): parity, response surfaces.
    #[arg(long, value_name = "DIR")]
    plot: Option<PathBuf>,
}

pub fn run(arguments: &Arguments) -> Result<(), CliError> {
    arguments.json.iter().try_for_each(|json| check_target(json))?;
    if spheres::is_model(&arguments.model[0])? {
        return spheres::score_models(&arguments.model, &arguments.database, arguments.json.as_deref());
    }
    let dataset = read_all(&arguments.database)?;
    let data = training_data(&dataset.records);
    let plan_hash = dataset.provenance.get("plan_hash").cloned().unwrap_or_default();
    let mut scores = Vec::new();
    for file in &arguments.model {
        let failed = |source| CliError::Model { file: file.clone(), source };
        let model = models::read(&spheres::model_text(file)?).map_err(failed)?;
        let failed = |source| CliError::Model { file: arguments.database[0].clone(), source };
        let ramps = ramps(model.as_ref(), &data, &plan_hash).map_err(failed)?;
        let result = score(model.as_ref(), &ramps);
        print(&result);
        outln!();
        scores.push(result);
        if let Some(folder) = &arguments.plot {
            let folder = if arguments.model.len() > 1 { folder.join(model.name()) } else { folder.clone() };
            for (name, svg) in plot::all(model.as_ref(), &ramps.unseen)? {
                write(&folder.join(name), svg.as_bytes())?;
            }
        }
    }
    if scores.len() > 1 {
        print_side_by_side(&scores);
    }
    if let Some(path) = &arguments.json {
        write_json(path, &scores)?;
    }
    Ok(())
}

/// Increments of a strain when models are compared: many, because a solver takes many small ones.
const MANY: u32 = 500;

fn print_side_by_side(scores: &[Score]) {
    outln!("Side by side: R2 of one step; rms error of K, sigma in % after a strain in {MANY} increments");
    out!("{:<16} {:>7} {:>7} {:>7}", "model", "d eta", "K", "sigma");
    let strains = [0.02, -0.02, 0.05, -0.05];
    strains.iter().for_each(|strain| out!(" {:>15}", format!("{:+.0} %: K sigma", 100.0 * strain)));
    outln!();
    for score in scores {
        let s = &score.unseen;
        out!("{:<16} {:>7.4} {:>7.4} {:>7.4}", score.name, s.delta_porosity, s.conductivity, s.stress);
        for strain in strains {
            let found = score.composed.iter().find(|c| c.strain == strain && c.increments == MANY);
            let errors = found.map(|c| format!("{:.1} {:.1}", 100.0 * c.conductivity, 100.0 * c.stress));
            out!(" {:>15}", errors.unwrap_or_default());
        }
        outln!();
    }
}

/// Prints what `msdd train` reports of a new model.
pub fn print_training(
    model: &dyn Surrogate,
    data: &TrainingData,
    plan_hash: &str,
) -> Result<(), SurrogateError> {
    let found = score(model, &ramps(model, data, plan_hash)?);
    outln!("{}", verdict(&found));
    if let Some(friction) = model.wall_friction() {
        outln!("{}", friction_of_walls(friction));
    }
    outln!();
    print(&found);
    Ok(())
}

/// How good a model is, in a sentence.
fn verdict(score: &Score) -> String {
    let many = || score.composed.iter().filter(|errors| errors.increments == MANY);
    let largest = |error: fn(&Composed) -> f64| 100.0 * many().map(error).fold(0.0, f64::max);
    let strain = 100.0 * many().map(|errors| errors.strain.abs()).fold(0.0, f64::max);
    let packings = if score.held_out { "packings that were held out of the training" } else { "packings" };
    format!(
        "Largest error on {} {packings}: {:.1} % of K, {:.1} % of the stress (rms, strains up to {strain:.0} % in {MANY} increments). \
         Tables below, or by 'msdd score'.",
        score.unseen.packings,
        largest(|errors| errors.conductivity),
        largest(|errors| errors.stress),
    )
}

fn friction_of_walls(friction: &WallFriction) -> String {
    format!(
        "Friction of walls: {} at most, half of it at a slip of {} mean radii (scatter {}, {} measured values).",
        short(friction.limit),
        short(friction.slip),
        short(friction.scatter),
        friction.samples
    )
}

fn print(score: &Score) {
    outln!("{} \"{}\" {}", score.kind, score.name, &score.hash[..12]);
    outln!();
    outln!("R2 (Eq. 12), one step  packings samples  d eta    d f       K    sigma");
    let line = |name: &str, s: &OneStep| {
        outln!(
            "{name:<22} {:>8} {:>7} {:.4} {:>7.4} {:>7.4} {:.5}",
            s.packings,
            s.samples,
            s.delta_porosity,
            s.delta_fabric_index,
            s.conductivity,
            s.stress
        );
    };
    if let Some(training) = &score.training {
        line("training packings", training);
    }
    line(if score.held_out { "held-out packings" } else { "all packings" }, &score.unseen);
    outln!();
    outln!(
        "A strain in increments; rms error, relative in % (eta, f: absolute); mean of 30 packings: largest"
    );
    outln!(" strain    in  ramps       K   sigma       p      eta        f  mean K  mean p");
    for c in &score.composed {
        row(c);
    }
    outln!();
    outln!("Noise floor (Gamma test on the model's state)");
    outln!(" strain            K   sigma       p      eta        f");
    let percent = |value: Option<f64>| value.map_or("-".to_string(), |v| format!("{:.2}", 100.0 * v));
    let plain = |value: Option<f64>| value.map_or("-".to_string(), |v| format!("{v:.5}"));
    for f in &score.noise_floor {
        outln!(
            "{:>+7.3}       {:>7} {:>7} {:>7} {:>8} {:>8}",
            f.strain,
            percent(f.conductivity),
            percent(f.stress),
            percent(f.pressure),
            plain(f.porosity),
            plain(f.fabric_index)
        );
    }
    outln!();
    outln!("Strained and strained back: difference from the initial state, relative in % (eta: absolute)");
    for t in &score.there_and_back {
        outln!(
            "{:>+7.3} in {}: p {:.3}, K {:.3}, eta {:.6}",
            t.strain,
            t.increments,
            100.0 * t.pressure,
            100.0 * t.conductivity,
            t.porosity
        );
    }
    if !score.way_back.is_empty() {
        outln!();
        outln!("Errors on ramps back to the packed radii");
        outln!(" strain    in  ramps       K   sigma       p      eta        f  mean K  mean p");
        for way in &score.way_back {
            row(&way.errors);
        }
    }
    if !score.paths.is_empty() {
        outln!();
        outln!(
            "Along paths of strain; rms error, p and q in % of the path's mean pressure; f_K, eta, f absolute"
        );
        print_paths(&score.paths);
    }
    if !score.probes.is_empty() {
        outln!();
        outln!(
            "Small strains tried on the way, in % of the discs' stiffness: rms of all entries over xx by xx; means"
        );
        outln!("  size discs number  entries  xx by xx  xy by xy");
        for e in &score.probes {
            let [tangent, normal, shear] = [e.tangent, e.normal, e.shear].map(|error| 100.0 * error);
            outln!(
                "{:.4} {:>5} {:>6} {tangent:>8.1} {normal:>+9.1} {shear:>+9.1}",
                e.size,
                e.discs,
                e.probes
            );
        }
    }
}

/// Prints errors along paths of strain.
pub fn print_paths(paths: &[PathErrors]) {
    outln!("paths          discs number    p %   q %   K %  f_K      eta        f");
    for e in paths {
        outln!(
            "{:<14} {:>5} {:>6} {:>6.2} {:>5.2} {:>5.2} {:.4} {:>8.5} {:>8.5}",
            e.name,
            e.discs,
            e.paths,
            100.0 * e.pressure,
            100.0 * e.deviator,
            100.0 * e.conductivity,
            e.anisotropy,
            e.porosity,
            e.fabric_index
        );
    }
}

fn row(c: &Composed) {
    outln!(
        "{:>+7.3} {:>5} {:>6} {:>7.2} {:>7.2} {:>7.2} {:>8.5} {:>8.5} {:>7.2} {:>7.2}",
        c.strain,
        c.increments,
        c.ramps,
        100.0 * c.conductivity,
        100.0 * c.stress,
        100.0 * c.pressure,
        c.porosity,
        c.fabric_index,
        100.0 * c.mean_conductivity,
        100.0 * c.mean_pressure
    );
}
