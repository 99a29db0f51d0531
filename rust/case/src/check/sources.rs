//! Checks `fvOptions`, the sources and constraints of a case.

use super::domain::Mesh;
use super::files::{self, Files};
use super::finding::Findings;
use super::keys::{self, Key, Kind};
use super::zones;
use crate::dictionary::{Dictionary, Entry, joined};

/// Paths in the case folder; OpenFOAM reads the first that is there.
pub const FILES: [&str; 2] = ["constant/fvOptions", "system/fvOptions"];
/// Types that look for the enthalpy of OpenFOAM's own solvers as soon as they are made, even if they are switched off.
const OF_ENTHALPY: [&str; 4] = [
    "fixedTemperatureConstraint",
    "limitTemperature",
    "jouleHeatingSource",
    "effectivenessHeatExchangerSource",
];
/// Types that act on any scalar field in chosen cells.
const OF_SCALARS: [&str; 3] = [SEMI_IMPLICIT, FIXED_VALUE, CODED];
const SEMI_IMPLICIT: &str = "scalarSemiImplicitSource";
const FIXED_VALUE: &str = "scalarFixedValueConstraint";
const CODED: &str = "scalarCodedSource";
/// Ends of the names of those types, which act on vectors and tensors with another beginning.
const ENDS: [&str; 3] = ["SemiImplicitSource", "FixedValueConstraint", "CodedSource"];

/// The sources of a bed, with the file in which they stand.
pub fn of(files: &Files) -> Option<(&'static str, &Dictionary)> {
    let (name, file) = FILES.iter().find_map(|&name| Some((name, files::file(files, name)?)))?;
    Some((name, file.dictionary_at("options").unwrap_or(file)))
}

/// Checks the sources; `alone`: whether msddFoam solves the bed, which knows no enthalpy.
pub fn check(files: &Files, mesh: &Mesh, alone: bool, found: &mut Findings) {
    let Some((name, sources)) = of(files) else { return };
    zones::check(name, sources, mesh, found);
    for key in sources.keys().filter(|key| key.text != "FoamFile") {
        let Some(Entry::Dictionary(source)) = sources.get_any(&key.text) else { continue };
        let Ok(kind) = source.text("type") else {
            found.error([name, &source.path_of("type")], "missing", &OF_SCALARS.join(", "), "");
            continue;
        };
        if alone {
            check_kind([name, &source.path_of("type")], &kind, found);
        }
        if OF_SCALARS.contains(&kind.as_str()) {
            let own = source.dictionary_at(&format!("{kind}Coeffs")).unwrap_or(source);
            check_cells(name, own, found);
            check_field(name, &kind, own, alone, found);
        }
    }
}

/// Reports types that cannot act on T.
fn check_kind(place: [&str; 2], kind: &str, found: &mut Findings) {
    let allowed = "types that act on T, such as scalarSemiImplicitSource and scalarFixedValueConstraint";
    if OF_ENTHALPY.contains(&kind) {
        let advice = "This type needs the enthalpy of OpenFOAM's own solvers; msddFoam solves for T";
        found.error(place, kind, allowed, advice);
    } else if !OF_SCALARS.contains(&kind)
        && ENDS.iter().any(|end| kind.to_lowercase().ends_with(&end.to_lowercase()))
    {
        let near = keys::nearest(kind, &OF_SCALARS).unwrap_or(SEMI_IMPLICIT);
        found.error(place, kind, allowed, &format!("T is a scalar: is '{near}' meant?"));
    }
}

/// Checks what says where and when a source acts. OpenFOAM v1912 needs it even of a source that is switched off.
fn check_cells(file: &str, own: &Dictionary, found: &mut Findings) {
    let must = |name: &'static str, kind: Kind, found: &mut Findings| {
        keys::value(own, file, &Key { name, required: true, kind }, found);
    };
    must("selectionMode", Kind::Word(&["all", "cellSet", "cellZone", "points"]), found);
    match own.text("selectionMode").as_deref() {
        Ok("cellSet") => must("cellSet", Kind::Any, found),
        Ok("cellZone") => must("cellZone", Kind::Any, found),
        Ok("points") => must("points", Kind::Any, found),
        _ => {}
    }
    if own.get("timeStart").is_some() {
        must("duration", Kind::Any, found);
    }
}

/// Checks what a source does to which field; `alone`: that must be T.
fn check_field(file: &str, kind: &str, own: &Dictionary, alone: bool, found: &mut Findings) {
    let must = |name: &'static str, kind: Kind, found: &mut Findings| {
        keys::value(own, file, &Key { name, required: true, kind }, found);
    };
    let (values, count, example) = match kind {
        SEMI_IMPLICIT => {
            must("volumeMode", Kind::Word(&["absolute", "specific"]), found);
            ("injectionRateSuSp", 2, "(S Sp), two numbers: S + Sp T is the heat released")
        }
        FIXED_VALUE => ("fieldValues", 1, "a number [K]"),
        _ => {
            must("fields", Kind::Any, found);
            return;
        }
    };
    must(values, Kind::Dictionary, found);
    let Ok(values) = own.dictionary_at(values) else { return };
    let place = values.path_of("T");
    match values.value("T") {
        Ok(tokens) => {
            let list: Vec<&str> = tokens.iter().map(|token| token.text.as_str()).collect();
            let inner = match list.as_slice() {
                ["(", inner @ .., ")"] if count == 2 => inner,
                [one] if count == 1 => std::slice::from_ref(one),
                _ => &[],
            };
            if inner.len() != count || inner.iter().any(|word| word.parse::<f64>().is_err()) {
                found.error([file, &place], &joined(tokens), example, "");
            }
        }
        Err(_) if alone => {
            let advice = "msddFoam solves for T, and for no other field";
            found.error([file, &place], "missing", example, advice);
        }
        Err(_) => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn lines(text: &str, alone: bool) -> Vec<String> {
        let file = Dictionary::parse(Path::new("fvOptions"), text).unwrap();
        let mut found = Findings::default();
        check(&Files::from([(FILES[0], file)]), &Mesh::default(), alone, &mut found);
        found.0.iter().map(ToString::to_string).collect()
    }

    const GOOD: &str = "type scalarSemiImplicitSource; selectionMode all; volumeMode specific; injectionRateSuSp { T (1e6 0); }";

    #[test]
    fn entries_that_openfoam_needs_are_found() {
        let header = "FoamFile { version 2.0; format ascii; }";
        for good in [
            format!("one {{ {GOOD} }}"),
            format!("options {{ one {{ {GOOD} }} }}"),
            format!("one {{ type scalarSemiImplicitSource; scalarSemiImplicitSourceCoeffs {{ {GOOD} h (1 0); }} }}"),
            "one { type scalarFixedValueConstraint; selectionMode points; points ((0 0 0)); fieldValues { T 300; } }".into(),
            "one { type scalarCodedSource; selectionMode cellSet; cellSet hot; fields (T); timeStart 0; duration 3; }".into(),
            "one { type radiation; }".into(),
        ] {
            assert_eq!(lines(&format!("{header} {good}"), true), Vec::<String>::new(), "{good}");
        }
        let fixed = "type scalarFixedValueConstraint; selectionMode all; fieldValues { T 300; }";
        for (text, from, to, wanted) in [
            (
                GOOD,
                "selectionMode all;",
                "",
                "selectionMode = missing, allowed: all, cellSet, cellZone, points. The solver needs it",
            ),
            (
                GOOD,
                "all",
                "al",
                "selectionMode = al, allowed: all, cellSet, cellZone, points. Is 'all' meant?",
            ),
            (GOOD, "all", "cellZone", "cellZone = missing, allowed: a value"),
            (GOOD, "all", "all; timeStart 0", "duration = missing"),
            (GOOD, "volumeMode specific;", "active no;", "volumeMode = missing, allowed: absolute, specific"),
            (GOOD, "SuSp", "SuSP", "injectionRateSuSp = missing, allowed: a dictionary in braces"),
            (GOOD, "(1e6 0)", "1e6", "injectionRateSuSp/T = 1e6, allowed: (S Sp), two numbers"),
            (GOOD, "(1e6 0)", "(1e6)", "injectionRateSuSp/T = ( 1e6 ), allowed: (S Sp), two numbers"),
            (GOOD, "T (", "h (", "injectionRateSuSp/T = missing, allowed: (S Sp), two numbers"),
            (
                GOOD,
                "type scalar",
                "type vector",
                "type = vectorSemiImplicitSource, allowed: types that act on T",
            ),
            (GOOD, "Source", "source", "type = scalarSemiImplicitsource, allowed: types that act on T"),
            (GOOD, "type ", "kind ", "type = missing, allowed: scalarSemiImplicitSource, "),
            (fixed, "T 300;", "T (300);", "fieldValues/T = ( 300 ), allowed: a number [K]"),
            (fixed, "Values", "Value", "fieldValues = missing"),
            (
                fixed,
                fixed,
                "type jouleHeatingSource;",
                "type = jouleHeatingSource, allowed: types that act on T",
            ),
        ] {
            let found = lines(&format!("one {{ {} }}", text.replacen(from, to, 1)), true);
            let wanted = format!("error: constant/fvOptions: one/{wanted}");
            assert!(found.len() == 1 && found[0].starts_with(&wanted), "{wanted}\n{found:#?}");
        }
        // Regions are solved for the enthalpy
        assert_eq!(lines(&format!("one {{ {} }}", GOOD.replace("T (", "h (")), false), Vec::<String>::new());
    }

    #[test]
    fn the_first_file_counts_and_types_without_t_are_refused() {
        let file = |kind: &str| {
            let text = format!("one {{ {} active no; }}", GOOD.replace(SEMI_IMPLICIT, kind));
            Dictionary::parse(Path::new("fvOptions"), &text).unwrap()
        };
        let lines = |files: &[(&'static str, &str)], alone: bool| {
            let files: Files = files.iter().map(|(name, kind)| (*name, file(kind))).collect();
            let mut found = Findings::default();
            check(&files, &Mesh::default(), alone, &mut found);
            found.0.iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        let [first, second] = FILES;
        let wrong = lines(&[(second, "limitTemperature")], true);
        assert!(
            wrong[0].starts_with("error: system/fvOptions: one/type = limitTemperature, allowed: types"),
            "{wrong:?}"
        );
        assert_eq!(lines(&[(second, "limitTemperature")], false), Vec::<String>::new());
        let both = [(second, "limitTemperature"), (first, "scalarSemiImplicitSource")];
        assert_eq!(lines(&both, true), Vec::<String>::new());
    }
}
