//! Doubts values that the solver takes, but no bed has.

use super::domain::{Kind, Mesh};
use super::finding::Findings;
use super::grains::FILE;
use super::keys;
use crate::dictionary::{Dictionary, Entry};
use crate::numbers::rounded;
use msdd_rve::message::number;

/// The largest values of solids, and what has them.
const MOST: [(&str, f64, &str, &str); 3] = [
    ("density", 3e4, "kg/m3", "Osmium, the heaviest of all, has 22600"),
    ("youngModulus", 2e12, "Pa", "Diamond, the stiffest of all, has 1.2e12"),
    ("thermalConductivity", 1e4, "W/(m K)", "Diamond and graphite have 2000 to 5000"),
];
/// Ratios of lateral to vertical stress between which grains slide: those of friction angles up to 55 degrees where the bed gives way
/// sideways, and up to 30 where it is pressed from there.
const LATERAL: [f64; 2] = [0.1, 3.0];
/// By how much a source may warm a bed without doubt \[K\]: no solid stays solid beyond.
const MOST_RISE: f64 = 5000.0;

/// Checks the grains and the stress at rest.
pub fn check(properties: &Dictionary, found: &mut Findings) {
    for (key, most, unit, advice) in MOST {
        if let Some(value) = keys::size(properties, key).filter(|&value| value > most) {
            let [value, allowed] = [number(value), format!("up to {} {unit} in solids", number(most))];
            found.doubt([FILE, key], &value, &allowed, advice);
        }
    }
    let lateral =
        properties.dictionary_at("restStress").ok().and_then(|own| keys::number(own, "lateral", ""));
    if let Some(value) = lateral.filter(|value| !(LATERAL[0]..=LATERAL[1]).contains(value)) {
        let allowed = format!("about {} to {}", LATERAL[0], LATERAL[1]);
        let advice =
            "Grains slide until the lateral stress is at least and at most that much of the vertical one";
        found.doubt([FILE, "restStress/lateral"], &number(value), &allowed, advice);
    }
}

/// Doubts sources of heat that must warm the bed beyond all solids: even if it conducts as well as its grains, to the nearest walls.
/// `run`: its length \[s\].
pub fn check_sources(
    (file, sources): (&str, &Dictionary),
    properties: &Dictionary,
    mesh: &Mesh,
    run: Option<f64>,
    found: &mut Findings,
) {
    let size = |key: &str| keys::size(properties, key);
    let (Some(conductivity), Some(narrow)) = (size("thermalConductivity"), narrow(mesh)) else { return };
    let steady = narrow * narrow / (8.0 * conductivity);
    let (Some(density), Some(heat), Some(run)) = (size("density"), size("heatCapacity"), run) else { return };
    // K by each W/m3, without pores
    let rise = steady.min(run / (density * heat));
    for key in sources.keys() {
        let Some(Entry::Dictionary(source)) = sources.get_any(&key.text) else { continue };
        let own = source.dictionary_at("scalarSemiImplicitSourceCoeffs").unwrap_or(source);
        let is = |key: &str, word: &str| own.text(key).is_ok_and(|text| text == word);
        if !is("selectionMode", "all") || !is("volumeMode", "specific") || own.get("timeStart").is_some() {
            continue;
        }
        let Ok(rates) = own.dictionary_at("injectionRateSuSp") else { continue };
        let tokens = rates.value("T").unwrap_or_default();
        let numbers: Vec<f64> = tokens.iter().filter_map(|token| token.text.parse().ok()).collect();
        // A part that depends on T holds the bed at a temperature
        if let [rate, 0.0] = numbers[..]
            && rate.abs() * rise > MOST_RISE
        {
            let value = format!("{} W/m3", number(rate));
            let allowed = format!("up to about {} W/m3", number(rounded(MOST_RISE / rise, 2)));
            let advice = "More than that warms or cools this bed by more than 5000 K, which no grains stand";
            found.doubt([file, &rates.path_of("T")], &value, &allowed, advice);
        }
    }
}

/// The shortest side of the mesh along which heat flows \[m\].
fn narrow(mesh: &Mesh) -> Option<f64> {
    let [low, high] = mesh.extent?;
    let none = match (mesh.kind(), mesh.axis) {
        (Kind::Wedge, Some([_, normal])) => Some(normal),
        (Kind::Plane, _) => Some(2),
        (Kind::Solid, _) => None,
        _ => return None,
    };
    (0..3).filter(|k| Some(*k) != none).map(|k| high[k] - low[k]).reduce(f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn read(text: &str) -> Dictionary {
        Dictionary::parse(Path::new(FILE), text).unwrap()
    }

    fn lines(check: impl Fn(&mut Findings)) -> Vec<String> {
        let mut found = Findings::default();
        check(&mut found);
        found.0.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn values_beyond_all_solids_are_doubted() {
        let of = |text: &str| lines(|found| check(&read(text), found));
        let diamond =
            "density 3500; youngModulus 1.2e12; thermalConductivity 2200; restStress { lateral 0.6; }";
        assert_eq!(of(diamond), Vec::<String>::new());
        assert_eq!(of("thermalConductivity table ((0 1) (9 1e9));"), Vec::<String>::new());
        let wrong = of("thermalConductivity 1e13;");
        let wanted = "doubt: constant/granularProperties: thermalConductivity = 10000000000000, allowed: up to 10000 W/(m K) in solids";
        assert!(wrong.len() == 1 && wrong[0].starts_with(wanted), "{wrong:?}");
        for lateral in ["5", "0.01"] {
            let wrong = of(&format!("restStress {{ lateral {lateral}; }}"));
            let wanted = format!(
                "doubt: constant/granularProperties: restStress/lateral = {lateral}, allowed: about 0.1 to 3"
            );
            assert!(wrong.len() == 1 && wrong[0].starts_with(&wanted), "{wrong:?}");
        }
    }

    #[test]
    fn sources_that_melt_all_solids_are_doubted() {
        let grains = read("thermalConductivity 100; density 3000; heatCapacity 1;");
        let patches = [["a", "wall"], ["b", "empty"]].map(|pair| pair.map(str::to_string)).to_vec();
        let extent = Some([[0.0; 3], [0.6, 0.2, 0.01]]);
        let mesh = Mesh { patches, extent, ..Mesh::default() };
        let of = |rates: &str, more: &str, run: f64| {
            let source = read(&format!(
                "one {{ selectionMode all; volumeMode specific; {more} injectionRateSuSp {{ T {rates}; }} }}"
            ));
            lines(|found| check_sources(("constant/fvOptions", &source), &grains, &mesh, Some(run), found))
        };
        // 1e9 0.04/800 = 50000 K; within a millisecond 333 K
        let found = of("(1e9 0)", "", 8.0);
        let wanted = "doubt: constant/fvOptions: one/injectionRateSuSp/T = 1000000000 W/m3, allowed: up to about 100000000 W/m3";
        assert!(found.len() == 1 && found[0].starts_with(wanted), "{found:?}");
        for (rates, more, run) in [
            ("(9e7 0)", "", 8.0),
            ("(1e9 0)", "", 1e-3),
            ("(1e9 -1e7)", "", 8.0),
            ("(1e9 0)", "timeStart 0;", 8.0),
        ] {
            assert_eq!(of(rates, more, run), Vec::<String>::new(), "{rates} {more} {run}");
        }
    }
}
