//! What `msdd train` and `msdd score` print of the law of spheres.

use crate::error::CliError;
use crate::output::write_json;
use msdd_files::read_text;
use msdd_surrogate::models::{self, BUILTIN};
use msdd_surrogate::spheres::errors::Errors;
use msdd_surrogate::spheres::model::SphereModel;
use msdd_surrogate::spheres::score::{PathErrors, score};
use msdd_surrogate::spheres::tracks::Track;
use msdd_surrogate::spheres::training::is_held_out;
use msdd_training::spheres::read;
use std::path::{Path, PathBuf};

/// Prints what `msdd train` reports of a new model.
pub fn print_training(model: &SphereModel, tracks: &[Track]) -> Result<(), CliError> {
    let report = &model.file.report;
    outln!(
        "{} parameters of the law fitted to {} paths of {} packings, {} packings held out: mean square {:.3e} after {} epochs",
        report.parameters,
        report.paths[0],
        report.packings[0],
        report.packings[1],
        report.mean_square,
        report.epochs
    );
    print_scores(model, tracks, true)?;
    Ok(())
}

/// Whether a file is a model of spheres.
pub fn is_model(file: &Path) -> Result<bool, CliError> {
    Ok(SphereModel::has_sphere_schema(&model_text(file)?))
}

/// Text of a model file, or of a shipped model: `builtin`, `builtin:…`.
pub fn model_text(file: &Path) -> Result<String, CliError> {
    let failed = |source| CliError::Model { file: file.into(), source };
    match file.to_str().filter(|name| name.split(':').next() == Some(BUILTIN)) {
        Some("builtin:spheres") => Ok(SphereModel::builtin().map_err(failed)?.to_json()),
        Some(name) => Ok(models::builtin(name).map_err(failed)?.to_json()),
        None => Ok(read_text(file)?),
    }
}

pub fn score_models(models: &[PathBuf], database: &[PathBuf], json: Option<&Path>) -> Result<(), CliError> {
    let (tracks, provenance) = read(database)?;
    let mut all = Vec::new();
    for file in models {
        let failed = |source| CliError::Model { file: file.clone(), source };
        let model = SphereModel::read(&model_text(file)?).map_err(failed)?;
        let is_trained_on_it = model.file.training.database.plan_hash == provenance.plan_hash;
        all.push(print_scores(&model, &tracks, is_trained_on_it)?);
    }
    if let Some(path) = json {
        write_json(path, &all)?;
    }
    Ok(())
}

/// Scores over the packings that were held out of the model's training, or over all if it was not trained on them; and scatter over all.
fn print_scores(
    model: &SphereModel,
    tracks: &[Track],
    is_trained_on_it: bool,
) -> Result<Vec<PathErrors>, CliError> {
    let seed = model.file.training.seed;
    let is_unseen = |track: &&Track| !is_trained_on_it || is_held_out(track.packing, seed);
    let unseen: Vec<Track> = tracks.iter().filter(is_unseen).cloned().collect();
    let over_all = score(model, tracks);
    let mut found = score(model, &unseen);
    for errors in &mut found {
        let all = over_all.iter().find(|all| all.name == errors.name);
        errors.noise = all.and_then(|all| all.noise);
        errors.beside_noise = all.and_then(|all| all.beside_noise);
    }
    print_along(&found, is_trained_on_it);
    print_of_state(&found);
    Ok(found)
}

/// Errors along paths, compared with the scatter.
fn print_along(found: &[PathErrors], is_trained_on_it: bool) {
    let of = if is_trained_on_it { "packings that were held out" } else { "all packings" };
    outln!(
        "errors along the paths of {of}, % (scatter between packings that were made and strained equally; errors of the model along their paths)"
    );
    let columns = ["pressure", "deviator", "K by contacts", "K by gas"];
    out!("{:<11} {:>5} {:>6}", "path", "paths", "states");
    columns.iter().for_each(|column| out!(" {column:>18}"));
    outln!();
    for errors in found {
        out!("{:<11} {:>5} {:>6}", errors.name, errors.paths, errors.states);
        let of = |errors: &Option<Errors>| errors.as_ref().map_or([f64::NAN; 4], numbers).map(percent);
        let (scatter, beside) = (of(&errors.noise), of(&errors.beside_noise));
        for (k, error) in numbers(&errors.along).into_iter().enumerate() {
            let pair = if errors.noise.is_some() {
                format!("{}; {}", scatter[k], beside[k])
            } else {
                "–".to_string()
            };
            out!(" {:>18}", format!("{} ({pair})", percent(error)));
        }
        outln!();
    }
}

/// Errors of the conductivities of known states, and those along paths where less is known at the start.
fn print_of_state(found: &[PathErrors]) {
    outln!(
        "errors of given states, %; and along the paths where solid fraction, stress and mobilised friction alone are given at their start, %"
    );
    let of_state = ["K by contacts", "direction", "K by gas"];
    let along = ["pressure", "deviator", "K by contacts", "K by gas"];
    out!("{:<11}", "path");
    of_state.iter().chain(&along).for_each(|column| out!(" {column:>13}"));
    outln!();
    for errors in found {
        let of_state = [errors.contact_of_state, errors.direction, errors.gas_of_state];
        out!("{:<11}", errors.name);
        let all = of_state.into_iter().chain(numbers(&errors.of_stress_alone));
        all.for_each(|error| out!(" {:>13}", percent(error)));
        outln!();
    }
}

/// With a decimal; a dash for what is not known.
fn percent(value: f64) -> String {
    if value.is_finite() { format!("{:.1}", 100.0 * value) } else { "–".to_string() }
}

fn numbers(errors: &Errors) -> [f64; 4] {
    [errors.pressure, errors.deviator, errors.contact, errors.gas]
}
