//! Checks `constant/g` and the stress at the start that follows from it.

use super::dimensions::Dimensions;
use super::finding::Findings;
use super::grains;
use super::keys;
use crate::dictionary::{Dictionary, joined};

/// Path in the case folder.
pub const FILE: &str = "constant/g";

const DIMENSIONS: &str = "[ 0 1 -2 0 0 0 0 ]";
/// Longest vector \[m/s²\].
const MOST: f64 = 1e6;

/// Checks gravity, and whether the stress at the start is given once: by the field, or by `restStress`. `stress`: whether the field is
/// there; none at a time that the solver has written, with the whole state.
pub fn check(
    properties: &Dictionary,
    gravity: Option<&Dictionary>,
    stress: Option<bool>,
    found: &mut Findings,
) {
    if let Some(gravity) = gravity {
        check_vector(gravity, found);
    }
    let rest = properties.dictionary_at("restStress").ok();
    if let Some(rest) = rest {
        keys::check(rest, grains::FILE, keys::REST_STRESS, &[], found);
        if stress == Some(true) {
            let advice = "The stress at the start is given twice: the field stress is there, too";
            found.error([grains::FILE, "restStress"], "{...}", "one of both", advice);
        }
        if gravity.is_none() {
            let advice = "The stress at rest follows from the weight: add constant/g";
            found.error([FILE, ""], "missing", "", advice);
        }
        if let Some(value) = gravity.and_then(|gravity| gravity.value("value").ok())
            && value.iter().filter_map(|token| token.text.parse::<f64>().ok()).all(|part| part == 0.0)
        {
            let advice = "The stress at rest follows from the weight";
            found.error([FILE, "value"], &joined(value), "a vector longer than 0 with restStress", advice);
        }
    }
    let spheres = properties
        .dictionary_at("surrogate")
        .is_ok_and(|own| own.text("type").is_ok_and(|kind| kind == "spheres"));
    if spheres && stress == Some(false) && rest.is_none() {
        let advice = "The law of spheres needs the stress at the start; or, under the weight of the bed, restStress in \
                      constant/granularProperties";
        found.error(["0/stress", ""], "missing", "", advice);
    }
}

fn check_vector(gravity: &Dictionary, found: &mut Findings) {
    let given = gravity.value("dimensions").unwrap_or_default();
    if !Dimensions::read(given).is_some_and(|given| given.are(DIMENSIONS)) {
        found.error([FILE, "dimensions"], &joined(given), DIMENSIONS, "");
    }
    let tokens = gravity.value("value").unwrap_or_default();
    let numbers: Vec<f64> = tokens.iter().filter_map(|token| token.text.parse().ok()).collect();
    if numbers.len() != 3
        || numbers.iter().map(|x| x * x).sum::<f64>().sqrt().is_nan()
        || numbers.iter().any(|x| x.abs() >= MOST)
    {
        let value = if tokens.is_empty() { "missing".to_string() } else { joined(tokens) };
        found.error([FILE, "value"], &value, "(x y z), a vector shorter than 1e6 m/s2", "");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn lines(properties: &str, gravity: Option<&str>, stress: bool) -> Vec<String> {
        let read = |name: &str, text: &str| Dictionary::parse(Path::new(name), text).unwrap();
        let (properties, gravity) = (read(grains::FILE, properties), gravity.map(|text| read(FILE, text)));
        let mut found = Findings::default();
        check(&properties, gravity.as_ref(), Some(stress), &mut found);
        found.0.iter().map(ToString::to_string).collect()
    }

    const EARTH: &str = "dimensions [0 1 -2 0 0 0 0]; value (0 0 -9.81);";

    #[test]
    fn the_stress_at_the_start_is_given_once() {
        let spheres = "surrogate { type spheres; }";
        let rest = "surrogate { type spheres; } restStress { lateral 0.6; }";
        assert!(lines(spheres, None, true).is_empty());
        assert!(lines(rest, Some(EARTH), false).is_empty());
        assert!(lines("surrogate { type network; }", None, false).is_empty());
        assert!(lines(spheres, Some(EARTH), false)[0].starts_with("error: 0/stress: missing"));
        assert!(lines(rest, Some(EARTH), true)[0].contains("restStress = {...}, allowed: one of both"));
        assert!(lines(rest, None, false)[0].starts_with("error: constant/g: missing"));
        let weightless = lines(rest, Some(&EARTH.replace("-9.81", "0")), false);
        assert!(
            weightless.len() == 1
                && weightless[0]
                    .starts_with("error: constant/g: value = ( 0 0 0 ), allowed: a vector longer"),
            "{weightless:?}"
        );
        let twice = lines("surrogate { type spheres; } restStress { latera 0.6; }", Some(EARTH), false);
        assert!(
            twice[0].contains("Is 'lateral' meant?") || twice[0].contains("is 'lateral' meant?"),
            "{twice:#?}"
        );
    }

    #[test]
    fn gravity_is_a_vector_with_its_dimensions() {
        for dimensions in ["[0 1 -2 0 0]", "[m s^-2]", "[ m / s^2 ]"] {
            let good = format!("dimensions {dimensions}; value (0 0 -9.81);");
            assert_eq!(lines("", Some(&good), false), Vec::<String>::new());
        }
        let wrong = lines("", Some("dimensions [0 1 -1 0 0 0 0]; value (0 -9.81);"), false);
        assert!(
            wrong[0].starts_with(
                "error: constant/g: dimensions = [ 0 1 -1 0 0 0 0 ], allowed: [ 0 1 -2 0 0 0 0 ]"
            ),
            "{wrong:#?}"
        );
        assert!(
            wrong[1].starts_with("error: constant/g: value = ( 0 -9.81 ), allowed: (x y z)"),
            "{wrong:#?}"
        );
    }
}
