//! Checks `system/controlDict` and `system/fvSolution`.

use super::finding::Findings;
use super::keys;
use crate::dictionary::{Dictionary, Entry};
use msdd_rve::message::number;

/// Path in the case folder.
pub const CONTROL: &str = "system/controlDict";
/// Path in the case folder.
pub const SOLUTION: &str = "system/fvSolution";

/// Keys of controlDict that OpenFOAM looks for, to find mistyped ones.
const OPENFOAM: [&str; 31] = [
    "FoamFile",
    "application",
    "startFrom",
    "startTime",
    "stopAt",
    "endTime",
    "deltaT",
    "writeControl",
    "writeInterval",
    "purgeWrite",
    "writeFormat",
    "writePrecision",
    "writeCompression",
    "timeFormat",
    "timePrecision",
    "runTimeModifiable",
    "adjustTimeStep",
    "maxDeltaT",
    "minDeltaT",
    "maxCo",
    "maxDi",
    "functions",
    "libs",
    "graphFormat",
    "DebugSwitches",
    "InfoSwitches",
    "OptimisationSwitches",
    "DimensionedConstants",
    "secondaryWriteControl",
    "secondaryWriteInterval",
    "writeOnceNow",
];

/// Libraries that come with OpenFOAM or with this project. Others contain code of somebody else, and are reported.
const LIBRARIES: [&str; 8] = [
    "libsampling.so",
    "libfieldFunctionObjects.so",
    "libutilityFunctionObjects.so",
    "libforces.so",
    "libgranularFunctionObjects.so",
    "libgranularModels.so",
    BEDS,
    "libsolverFunctionObjects.so",
];

/// The library that makes a region of OpenFOAM's own solvers a bed.
const BEDS: &str = "libgranularThermo.so";

/// Times of the case, which checks of other files need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Times {
    /// End of the simulation [s].
    pub end: f64,
    /// Time step, or the first one when steps are adaptive [s].
    pub step: f64,
    /// Whether steps are adaptive: their length follows from their error.
    pub adaptive: bool,
}

/// Checks both files; returns the times when they are known.
pub fn check(control: &Dictionary, solution: Option<&Dictionary>, found: &mut Findings) -> Option<Times> {
    for key in keys::CONTROL {
        keys::value(control, CONTROL, key, found);
    }
    for key in control.keys().filter(|key| !OPENFOAM.contains(&key.text.as_str())) {
        if let Some(near) = keys::nearest(&key.text, &OPENFOAM) {
            let advice = format!("OpenFOAM does not know this key and ignores it: is '{near}' meant?");
            found.doubt([CONTROL, &key.text], "", "", &advice);
        }
    }
    let adaptive = is_adaptive(control);
    let scheme = solution.map_or_else(|| "paper".to_string(), |solution| check_solution(solution, found));
    if adaptive && scheme == "paper" {
        let advice = "The paper's scheme has fixed steps; for adaptive ones, give 'msddFoam { timeScheme secondOrder; }' in \
                      system/fvSolution";
        found.error([CONTROL, "adjustTimeStep"], "yes", "no with timeScheme paper", advice);
    }
    check_code(control, found);
    times(control, adaptive, found)
}

/// Checks `system/controlDict` of a case of several regions, in which the regions have their own `fvSolution`.
pub fn check_of_regions(control: &Dictionary, found: &mut Findings) -> Option<Times> {
    for key in keys::CONTROL {
        keys::value(control, CONTROL, key, found);
    }
    let listed = control.value("libs").is_ok_and(|libs| libs.iter().any(|library| library.text == BEDS));
    if !listed {
        let allowed = format!("a list with \"{BEDS}\"");
        found.error([CONTROL, "libs"], "", &allowed, "The library that makes a region a bed");
    }
    check_code(control, found);
    times(control, is_adaptive(control), found)
}

fn is_adaptive(control: &Dictionary) -> bool {
    matches!(control.text("adjustTimeStep").as_deref(), Ok("yes" | "on" | "true"))
}

fn times(control: &Dictionary, adaptive: bool, found: &mut Findings) -> Option<Times> {
    let number = |key: &str| keys::number(control, key, "");
    let (start, end, step) = (number("startTime").unwrap_or(0.0), number("endTime")?, number("deltaT")?);
    if step > 0.0 && end - start <= 0.5 * step {
        let allowed = format!("more than half of deltaT = {step} s after startTime = {start} s");
        found.error([CONTROL, "endTime"], &end.to_string(), &allowed, "No step would be taken");
        return None;
    }
    let times = Times { end: end - start, step, adaptive };
    check_writes(control, times, found);
    Some(times)
}

/// The solver writes at these times alone, not at the end.
fn check_writes(control: &Dictionary, times: Times, found: &mut Findings) {
    let Some(interval) = keys::number(control, "writeInterval", "") else { return };
    let kind = control.text("writeControl").unwrap_or_else(|_| "timeStep".to_string());
    let (longest, unit) = match kind.as_str() {
        "runTime" | "adjustable" | "adjustableRunTime" => (times.end, "s"),
        "timeStep" if !times.adaptive => ((times.end / times.step).round(), "steps"),
        _ => return,
    };
    // OpenFOAM writes half a step before a time, too
    let rest = if unit == "s" { 0.5 * times.step } else { 0.0 };
    if interval > longest + rest {
        let value = format!("{} {unit}", number(interval));
        let allowed = format!("at most the length of the run, {} {unit}", number(longest));
        let advice = "No fields will be written: the solver does not write at the end by itself";
        found.doubt([CONTROL, "writeInterval"], &value, &allowed, advice);
    }
}

/// Checks `system/fvSolution`; returns the time scheme.
fn check_solution(solution: &Dictionary, found: &mut Findings) -> String {
    let solves = matches!(solution.dictionary_at("solvers"), Ok(solvers) if solvers.matching("T").is_some());
    if !solves {
        let allowed = "a dictionary with the linear solver of T, such as { solver PCG; preconditioner DIC; tolerance 1e-10; relTol 0; }";
        found.error([SOLUTION, "solvers/T"], "missing", allowed, "");
    }
    if let Ok(Ok(linear)) =
        solution.dictionary_at("solvers").map(|solvers| solvers.dictionary_at("equilibrium"))
    {
        keys::check(linear, SOLUTION, keys::LINEAR, &[], found);
    }
    let Ok(own) = solution.dictionary_at("msddFoam") else { return "paper".to_string() };
    keys::check(own, SOLUTION, keys::SOLVER, &[], found);
    own.text("timeScheme").unwrap_or_else(|_| "paper".to_string())
}

/// Reports code in the case, because it runs with the rights of whoever runs the case.
fn check_code(control: &Dictionary, found: &mut Findings) {
    check_libraries(control, found);
    let Ok(functions) = control.dictionary_at("functions") else { return };
    for key in functions.keys() {
        let Some(Entry::Dictionary(function)) = functions.get_any(&key.text) else { continue };
        check_libraries(function, found);
        let kind = function.text("type").unwrap_or_default();
        if kind.starts_with("coded") {
            let advice =
                "This function is source code that the run compiles and starts, with all your rights";
            found.doubt([CONTROL, &functions.path_of(&key.text)], &kind, "", advice);
        }
    }
}

fn check_libraries(dictionary: &Dictionary, found: &mut Findings) {
    let Ok(tokens) = dictionary.value("libs") else { return };
    let strange = |text: &str| !["(", ")"].contains(&text) && !LIBRARIES.contains(&text);
    for token in tokens.iter().filter(|token| strange(&token.text)) {
        let advice = "This library does not come with OpenFOAM or MSDD as far as is known here: running the case runs its code, \
                      with all your rights. Run it only if you trust who wrote it";
        found.doubt([CONTROL, &dictionary.path_of("libs")], &token.text, "", advice);
    }
}
