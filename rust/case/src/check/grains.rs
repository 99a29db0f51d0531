//! Checks `constant/granularProperties`: its keys, their values, and the model that is named there.

use super::finding::Findings;
use super::keys::{self, Key, Kind};
use crate::dictionary::{Dictionary, Entry, joined};
use msdd_rve::message::number as number_text;
use msdd_surrogate::{Surrogate, models};
use std::path::{Path, PathBuf};

/// Path in the case folder.
pub const FILE: &str = "constant/granularProperties";

/// Checks the file; returns the model, if it is a neural network that can be loaded.
pub fn check(
    folder: &Path,
    file: &Dictionary,
    patches: &[String],
    found: &mut Findings,
) -> Option<Box<dyn Surrogate>> {
    keys::check(file, FILE, keys::GRAINS, &[], found);
    let model = match file.dictionary_at("surrogate") {
        Ok(surrogate) => {
            check_conductivity(file, surrogate, found);
            check_surrogate(folder, surrogate, found)
        }
        Err(_) => None,
    };
    check_mechanics(file, patches, model.as_deref(), found);
    model
}

/// Whether the model of these properties knows the plane alone.
pub fn is_plane(properties: &Dictionary) -> bool {
    let kind = properties.dictionary_at("surrogate").and_then(|surrogate| surrogate.text("type"));
    !matches!(kind.as_deref(), Ok("spheres" | "constant"))
}

/// The law of spheres alone follows a conductivity that depends on the temperature.
fn check_conductivity(file: &Dictionary, surrogate: &Dictionary, found: &mut Findings) {
    let kind = surrogate.text("type").unwrap_or_default();
    if keys::is_function(file, "thermalConductivity") && kind != "spheres" {
        let given = file.value("thermalConductivity").map_or("{...}".to_string(), joined);
        let allowed = format!("a number with surrogate type {kind}");
        found.error(
            [FILE, "thermalConductivity"],
            &given,
            &allowed,
            "The surrogate type spheres takes a function of the temperature",
        );
    }
}

fn check_surrogate(
    folder: &Path,
    surrogate: &Dictionary,
    found: &mut Findings,
) -> Option<Box<dyn Surrogate>> {
    let kind = surrogate.text("type").unwrap_or_default();
    let table = match kind.as_str() {
        "network" => keys::NETWORK,
        "constant" => keys::CONSTANT,
        "plugin" => keys::PLUGIN,
        "onlineRve" => keys::ONLINE_RVE,
        "spheres" => keys::SPHERES,
        _ => &[],
    };
    let coefficients = match surrogate.get(&format!("{kind}Coeffs")) {
        Some(Entry::Dictionary(own)) => {
            keys::check(own, FILE, table, &[], found);
            if let ("spheres", Ok(wall)) = (kind.as_str(), own.dictionary_at("wall")) {
                keys::check(wall, FILE, keys::SPHERE_WALL, &[], found);
            }
            own
        }
        _ => {
            table.iter().for_each(|key| keys::value(surrogate, FILE, key, found));
            surrogate
        }
    };
    stray_keys(surrogate, table, found);
    for key in keys::SURROGATE {
        keys::value(surrogate, FILE, key, found);
    }
    let model = match kind.as_str() {
        "network" => load(folder, coefficients, None, found),
        "constant" => {
            check_tensor(coefficients, found);
            if coefficients.get("conductivity").is_none() && surrogate.get("spheresCoeffs").is_some() {
                let advice = "Without it the surrogate type constant takes conductivity and stress from a model of discs without gas, \
                              and does not read spheresCoeffs";
                let place = coefficients.path_of("conductivity");
                found.doubt([FILE, &place], "missing", "that of the bed of spheres [W/(m K)]", advice);
            }
            load(folder, coefficients, Some("builtin"), found).and(None)
        }
        "plugin" => {
            check_plugin(folder, coefficients, found);
            None
        }
        _ => None,
    };
    check_policy(surrogate, model.as_deref(), found);
    model
}

/// Reports unknown keys of `surrogate` itself. The solver ignores them, so a mistyped key has no effect.
fn stray_keys(surrogate: &Dictionary, table: &[Key], found: &mut Findings) {
    let all = [keys::SURROGATE, keys::NETWORK, keys::CONSTANT, keys::PLUGIN, keys::ONLINE_RVE, keys::SPHERES];
    let is_known = |name: &str| all.iter().flat_map(|list| list.iter()).any(|key| key.name == name);
    for key in surrogate.keys().filter(|key| !is_known(&key.text)) {
        let names: Vec<&str> = keys::SURROGATE.iter().chain(table).map(|key| key.name).collect();
        let meant = match keys::nearest(&key.text, &names) {
            Some(near) => format!("The solver does not know this key and ignores it: is '{near}' meant?"),
            None => "The solver does not know this key and ignores it".to_string(),
        };
        found.doubt([FILE, &surrogate.path_of(&key.text)], "", "", &meant);
    }
}

/// Loads a model that is compiled in, or one from a file relative to the case folder.
fn load(
    folder: &Path,
    coefficients: &Dictionary,
    default: Option<&str>,
    found: &mut Findings,
) -> Option<Box<dyn Surrogate>> {
    let name = match coefficients.value("model") {
        Ok(tokens) => joined(tokens),
        Err(_) => default?.to_string(),
    };
    let read = if name == models::BUILTIN || name.starts_with("builtin:") {
        models::builtin(&name).map_err(|error| error.to_string())
    } else {
        let text = msdd_files::read_text(&in_case(folder, &name)).map_err(|error| error.to_string());
        text.and_then(|text| models::read(&text).map_err(|error| error.to_string()))
    };
    let model = match read {
        Ok(model) => model,
        Err(problem) => {
            let allowed = "builtin, builtin:paper, or a readable model file, relative to the case folder";
            found.error([FILE, &coefficients.path_of("model")], &name, allowed, &problem);
            return None;
        }
    };
    if let Ok(tokens) = coefficients.value("hash")
        && !joined(tokens).is_empty()
        && joined(tokens) != model.hash()
    {
        let advice = "It is another model than the one that was meant; without 'hash', any is taken";
        found.error([FILE, &coefficients.path_of("hash")], &joined(tokens), model.hash(), advice);
    }
    if let Ok(kind) = coefficients.text("conductivity")
        && default.is_none()
        && ["affine", "network"].contains(&kind.as_str())
        && !model.conductivity_kinds().iter().any(|known| known.as_str() == kind)
    {
        let known: Vec<&str> = model.conductivity_kinds().iter().map(|kind| kind.as_str()).collect();
        let place = coefficients.path_of("conductivity");
        found.error(
            [FILE, &place],
            &kind,
            &known.join(", "),
            &format!("Model {name} was trained for no other"),
        );
    }
    Some(model)
}

/// A path relative to the case folder, with the values of environment variables in it, as the solver expands them.
fn in_case(folder: &Path, name: &str) -> PathBuf {
    let path = match name.strip_prefix("~/") {
        Some(rest) => std::env::home_dir().unwrap_or_default().join(rest),
        None => PathBuf::from(name),
    };
    folder.join(path)
}

/// Checks `conductivity` of a constant model.
fn check_tensor(coefficients: &Dictionary, found: &mut Findings) {
    let Ok(tokens) = coefficients.value("conductivity") else { return };
    let numbers: Vec<f64> = tokens.iter().filter_map(|token| token.text.parse().ok()).collect();
    let good = matches!(numbers[..], [xx, xy, _, yy, ..] if numbers.len() == 6 && xx > 0.0 && yy > 0.0 && xy * xy < xx * yy);
    if !good {
        let allowed = "(xx xy xz yy yz zz), positive definite in the plane [W/(m K)]";
        found.error([FILE, &coefficients.path_of("conductivity")], &joined(tokens), allowed, "");
    }
}

fn check_plugin(folder: &Path, coefficients: &Dictionary, found: &mut Findings) {
    let Ok(tokens) = coefficients.value("library") else { return };
    let (name, place) = (joined(tokens), coefficients.path_of("library"));
    if in_case(folder, &name).is_file() {
        let advice = "This case loads a plug-in: running the case runs its code, with all your rights. Run it only if you trust \
                      who wrote it. It was not loaded for this check, so its answers were not looked at";
        found.doubt([FILE, &place], &name, "", advice);
    } else {
        let advice = "There is no such file; the path is relative to the case folder";
        found.error([FILE, &place], &name, "a shared library made against msdd.h", advice);
    }
}

fn check_policy(surrogate: &Dictionary, model: Option<&dyn Surrogate>, found: &mut Findings) {
    let Ok(policy) = surrogate.dictionary_at("outOfRegion") else { return };
    let own: Vec<String> = model
        .map(|model| model.state_names().iter().map(|name| field_name(name)).collect())
        .unwrap_or_default();
    let own: Vec<&str> = own.iter().map(String::as_str).collect();
    keys::check(policy, FILE, keys::OUT_OF_REGION, &own, found);
    for key in policy.keys() {
        if let Some(Entry::Dictionary(sides)) = policy.get(&key.text) {
            keys::check(sides, FILE, keys::SIDES, &[], found);
        }
    }
}

/// Name of the field of a state column: reduced_pressure becomes reducedPressure.
pub fn field_name(column: &str) -> String {
    let mut parts = column.split('_');
    let first = parts.next().unwrap_or_default().to_string();
    parts.fold(first, |name, part| {
        let (head, tail) = part.split_at(part.chars().next().map_or(0, char::len_utf8));
        name + &head.to_uppercase() + tail
    })
}

fn check_mechanics(
    file: &Dictionary,
    patches: &[String],
    model: Option<&dyn Surrogate>,
    found: &mut Findings,
) {
    let equilibrium = file.text("mechanics").is_ok_and(|kind| kind == "equilibrium");
    let elastic = matches!(
        file.dictionary_at("equilibriumCoeffs"), Ok(settings) if settings.text("law").is_ok_and(|law| law == "elastic")
    );
    let constant = file.dictionary_at("surrogate").and_then(|surrogate| surrogate.text("type"));
    if equilibrium && !elastic && constant.is_ok_and(|kind| kind == "constant") {
        let advice = "The surrogate type constant has no grains that resist a strain";
        found.error([FILE, "mechanics"], "equilibrium", "none, or equilibrium with law elastic", advice);
    }
    if equilibrium && !elastic && model.is_some_and(|model| !model.has_tangent()) {
        let advice = "The model has no mechanical tangent, which this needs; builtin has one";
        found.error([FILE, "mechanics"], "equilibrium", "none with this model", advice);
    }
    let Ok(settings) = file.dictionary_at("equilibriumCoeffs") else { return };
    if !equilibrium {
        let advice = "Nothing here has an effect while mechanics is none";
        found.doubt([FILE, "equilibriumCoeffs"], "", "", advice);
    }
    keys::check(settings, FILE, keys::EQUILIBRIUM, &[], found);
    let value = |key: &str| keys::size(file, key).unwrap_or(0.0);
    let scale = value("youngModulus") * value("meanRadius");
    let mut scales = [scale, scale];
    let mut usual = 1e-4 * scale;
    if elastic {
        let Ok(solid) = settings.dictionary_at("elasticCoeffs") else {
            let allowed = "a dictionary with youngModulus and poissonRatio";
            found.error([FILE, "equilibriumCoeffs/elasticCoeffs"], "missing", allowed, "");
            return;
        };
        keys::check(solid, FILE, keys::ELASTIC, &[], found);
        let number = |key: &str| keys::size(solid, key).unwrap_or(0.0);
        let scale = number("youngModulus") / (2.0 + 2.0 * number("poissonRatio")) / 0.3;
        scales = [scale, scale];
        usual = 1e-9 * scale;
    } else if let Some(modulus) = contact_modulus(file) {
        // E* (p/E*)^(1/3) with the mean pressure at the start, which lies between these in any bed.
        scales = [1e-9, 1e-3].map(|pressure: f64| modulus * pressure.cbrt());
        usual = 1e-12 * modulus;
    }
    if scales[0] > 0.0 {
        between(settings, "residual", [2e-14 * scales[0], 2e4 * scales[1]], "Pa", found);
        let residual = keys::number(settings, "residual", "").unwrap_or(usual);
        between(settings, "maxResidual", [residual, 2e7 * scales[1]], "Pa", found);
    }
    let Ok(walls) = settings.dictionary_at("walls") else { return };
    for key in walls.keys() {
        let names_one =
            patches.iter().any(|patch| if key.quoted { key.matches(patch) } else { key.text == *patch });
        if !names_one && !patches.is_empty() {
            let allowed = format!("{}, or a quoted regular expression", patches.join(", "));
            found.error([FILE, &walls.path_of(&key.text)], "{...}", &allowed, "The mesh has no such patch");
        }
        if let Some(Entry::Dictionary(wall)) = walls.get_any(&key.text) {
            keys::check(wall, FILE, keys::WALL, &[], found);
            let radius = value("meanRadius");
            between(wall, "layer", [0.0, 1e6 * radius], "m", found);
            between(wall, "slip", [2e-7 * radius, 2000.0 * radius], "m", found);
            give(wall, elastic, found);
        }
    }
}

/// Grains give way at walls that hold them along the normal alone.
fn give(wall: &Dictionary, elastic: bool, found: &mut Findings) {
    let holds = wall.text("type").map_or(true, |kind| kind == "rigid" || kind == "frictionless");
    for key in ["give", "giveBack"] {
        let Some(value) = keys::number(wall, key, "") else { continue };
        let place = wall.path_of(key);
        let shown = number_text(value);
        if !holds {
            found.error([FILE, &place], &shown, "in walls of type rigid or frictionless", "");
        } else if elastic && key == "give" && value > 0.0 {
            found.error([FILE, &place], &shown, "0 with law elastic, which has no grains that give way", "");
        }
    }
}

/// E* = E/(2 - 2 nu^2) [Pa] of the surrogate type spheres.
fn contact_modulus(file: &Dictionary) -> Option<f64> {
    let surrogate = file.dictionary_at("surrogate").ok()?;
    let own = surrogate.dictionary_at("spheresCoeffs").ok()?;
    let ratio = keys::number(own, "poissonRatio", "")?;
    let modulus = keys::size(file, "youngModulus")?;
    surrogate.text("type").is_ok_and(|kind| kind == "spheres").then(|| 0.5 * modulus / (1.0 - ratio * ratio))
}

/// Checks a value against a range that depends on the grains.
fn between(
    dictionary: &Dictionary,
    name: &'static str,
    [least, most]: [f64; 2],
    unit: &'static str,
    found: &mut Findings,
) {
    let key = Key { name, required: false, kind: Kind::Range(least, most, unit) };
    let count = found.0.len();
    keys::value(dictionary, FILE, &key, found);
    if let Some(finding) = found.0.get_mut(count) {
        let short = |value: f64| number_text(crate::numbers::rounded(value, 6));
        finding.allowed = format!("{} to {} {unit} for these grains", short(least), short(most));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spheres_do_not_get_the_conductivity_of_discs_without_a_doubt() {
        let lines = |more: &str| {
            let text = format!("surrogate {{ spheresCoeffs {{ poissonRatio 0.3; }} type constant; {more} }}");
            let file = Dictionary::parse(Path::new(FILE), &text).unwrap();
            let mut found = Findings::default();
            check(Path::new(""), &file, &[], &mut found);
            let lines = found.0.iter().map(ToString::to_string);
            lines.filter(|line| line.contains("conductivity = ")).collect::<Vec<_>>()
        };
        let bare = lines("");
        let start = "doubt: constant/granularProperties: surrogate/conductivity = missing, allowed: that of the bed of spheres [W/(m K)]. \
                     Without it the surrogate type constant takes conductivity and stress from a model of discs";
        assert!(bare.len() == 1 && bare[0].starts_with(start), "{bare:?}");
        assert_eq!(lines("conductivity (1 0 0 1 0 1);"), Vec::<String>::new());
        assert_eq!(lines("constantCoeffs { conductivity (1 0 0 1 0 1); }"), Vec::<String>::new());
    }
}
