//! Checks function objects that need what `msddFoam` does not have: its runs have neither a flow nor a thermo of OpenFOAM.

use super::control::CONTROL as FILE;
use super::finding::Findings;
use crate::dictionary::{Dictionary, Entry};

/// Types that end a run at its first step.
const ENDING: [&str; 6] =
    ["forceCoeffs", "forces", "heatTransferCoeff", "turbulenceFields", "wallHeatFlux", "wallShearStress"];
/// Types that warn at each step, and write nothing.
const SILENT: [&str; 7] = ["CourantNo", "MachNo", "Q", "flowType", "pressure", "vorticity", "yPlus"];
/// Fields of flows, which are not there.
const OF_FLOWS: [&str; 5] = ["U", "p", "p_rgh", "phi", "rho"];

/// Checks the function objects of a case of `msddFoam`.
pub fn check(control: &Dictionary, found: &mut Findings) {
    let Ok(functions) = control.dictionary_at("functions") else { return };
    let all = || {
        functions.keys().filter_map(|key| match functions.get_any(&key.text) {
            Some(Entry::Dictionary(function)) => Some(function),
            _ => None,
        })
    };
    // Another may read such a field, or make it
    let reads = all().any(|function| {
        function.text("type").is_ok_and(|kind| kind == "readFields") || function.get("result").is_some()
    });
    for function in all() {
        let off = |word: &str| ["false", "no", "off"].contains(&word);
        if function.text("enabled").is_ok_and(|word| off(&word)) {
            continue;
        }
        let place = function.path_of("type");
        let Ok(kind) = function.text("type") else {
            found.error([FILE, &place], "missing", "the type of the function object", "");
            continue;
        };
        let allowed = "types that need neither a flow nor a thermo of OpenFOAM";
        if ENDING.contains(&kind.as_str()) {
            let advice = match kind.as_str() {
                "wallHeatFlux" | "heatTransferCoeff" => {
                    "It ends the run. The function object heatAudit has the heat that came in through the patches"
                }
                _ => "It ends the run",
            };
            found.error([FILE, &place], &kind, allowed, advice);
        } else if SILENT.contains(&kind.as_str()) {
            found.doubt([FILE, &place], &kind, allowed, "It warns at each step and writes nothing");
        } else if !reads {
            check_fields(function, found);
        }
    }
}

/// Doubts fields of flows in `field` and `fields`.
fn check_fields(function: &Dictionary, found: &mut Findings) {
    for key in ["field", "fields"] {
        let Ok(tokens) = function.value(key) else { continue };
        if let Some(name) =
            tokens.iter().map(|token| token.text.as_str()).find(|name| OF_FLOWS.contains(name))
        {
            let allowed = "fields of the solver, such as T, porosity, stress and conductivity";
            let advice = "There is no such field in a run of msddFoam: OpenFOAM leaves it out, with a warning or without";
            found.doubt([FILE, &function.path_of(key)], name, allowed, advice);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn functions_of_flows_are_found() {
        let lines = |text: &str| {
            let control = Dictionary::parse(Path::new(FILE), &format!("functions {{ {text} }}")).unwrap();
            let mut found = Findings::default();
            check(&control, &mut found);
            found.0.iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        for good in [
            "one { type probes; fields (T porosity); }",
            "one { type wallHeatFlux; enabled false; }",
            "r { type readFields; fields (U); } one { type mag; field U; }",
            "one { type fieldAverage; fields ( T { mean on; base time; } ); }",
        ] {
            assert_eq!(lines(good), Vec::<String>::new(), "{good}");
        }
        for (bad, wanted) in [
            (
                "one { type wallHeatFlux; }",
                "error: system/controlDict: functions/one/type = wallHeatFlux, allowed: types",
            ),
            ("one { type forces; }", "error: system/controlDict: functions/one/type = forces"),
            ("one { fields (T); }", "error: system/controlDict: functions/one/type = missing"),
            ("one { type yPlus; }", "doubt: system/controlDict: functions/one/type = yPlus"),
            (
                "one { type mag; field U; }",
                "doubt: system/controlDict: functions/one/field = U, allowed: fields",
            ),
            ("one { type probes; fields (T U); }", "doubt: system/controlDict: functions/one/fields = U"),
        ] {
            let found = lines(bad);
            assert!(found.len() == 1 && found[0].starts_with(wanted), "{wanted}\n{found:?}");
        }
    }
}
