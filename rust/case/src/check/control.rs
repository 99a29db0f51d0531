//! Checks `system/controlDict` and `system/fvSolution`.

use super::finding::Findings;
use super::keys;
use super::libraries::{self, BEDS};
use crate::dictionary::{Dictionary, Entry};
use msdd_rve::message::number;

/// Path in the case folder.
pub const CONTROL: &str = "system/controlDict";
/// Path in the case folder.
pub const SOLUTION: &str = "system/fvSolution";
/// Path in the case folder.
pub const DECOMPOSITION: &str = "system/decomposeParDict";

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

/// Times of the case, which checks of other files need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Times {
    /// Time of the start \[s\].
    pub start: f64,
    /// Length of the simulation \[s\].
    pub end: f64,
    /// Time step, or the first one when steps are adaptive \[s\].
    pub step: f64,
    /// Whether steps are adaptive: their length follows from their error.
    pub adaptive: bool,
}

/// Checks both files; returns the times when they are known. `start`: time of the start \[s\].
pub fn check(
    control: &Dictionary,
    solution: Option<&Dictionary>,
    start: f64,
    found: &mut Findings,
) -> Option<Times> {
    check_keys(control, found);
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
    libraries::check(CONTROL, control, found);
    times(control, start, adaptive, found)
}

/// Checks `system/controlDict` of a case of several regions, in which the regions have their own `fvSolution`.
pub fn check_of_regions(control: &Dictionary, start: f64, found: &mut Findings) -> Option<Times> {
    check_keys(control, found);
    if !control.value("libs").is_ok_and(libraries::has_beds) {
        let allowed = format!("a list with \"{BEDS}\"");
        found.error([CONTROL, "libs"], "", &allowed, "The library that makes a region a bed");
    }
    libraries::check(CONTROL, control, found);
    times(control, start, is_adaptive(control), found)
}

/// Methods of other libraries are there by name alone in Debian's OpenFOAM, and end decomposePar.
pub fn check_decomposition(dictionary: &Dictionary, found: &mut Findings) {
    let Ok(method) = dictionary.text("method") else { return };
    if ["scotch", "ptscotch", "metis", "kahip"].contains(&method.as_str()) {
        let advice =
            "Debian's OpenFOAM is built without this method, and its decomposePar ends with an error";
        found.doubt([DECOMPOSITION, "method"], &method, "simple, hierarchical, manual", advice);
    }
}

fn is_adaptive(control: &Dictionary) -> bool {
    matches!(control.text("adjustTimeStep").as_deref(), Ok("yes" | "on" | "true"))
}

fn check_keys(control: &Dictionary, found: &mut Findings) {
    let is = |key: &str, word: &str| control.text(key).is_ok_and(|text| text == word);
    // Only with startFrom startTime is it read
    let is_read = |key: &&keys::Key| key.name != "startTime" || is("startFrom", "startTime");
    for key in keys::CONTROL.iter().filter(is_read) {
        keys::value(control, CONTROL, key, found);
    }
    for (key, needed) in [("endTime", stops_at_end(control)), ("startTime", is("startFrom", "startTime"))] {
        if needed && control.get(key).is_none() {
            found.error([CONTROL, key], "missing", "a time [s]", "The solver needs it; add it");
        }
    }
}

/// Whether the run ends at endTime, not at the next time at which it writes.
fn stops_at_end(control: &Dictionary) -> bool {
    control.text("stopAt").map_or(true, |stop| stop == "endTime")
}

fn times(control: &Dictionary, start: f64, adaptive: bool, found: &mut Findings) -> Option<Times> {
    if !stops_at_end(control) {
        return None;
    }
    let (end, step) = (keys::number(control, "endTime", "")?, keys::number(control, "deltaT", "")?);
    if step > 0.0 && end - start <= 0.5 * step {
        let allowed = format!("more than half of deltaT = {step} s after the start at {start} s");
        found.error([CONTROL, "endTime"], &end.to_string(), &allowed, "No step would be taken");
        return None;
    }
    let times = Times { start, end: end - start, step, adaptive };
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
    let solves = matches!(solution.dictionary_at("solvers"), Ok(solvers) if matches!(solvers.matching("T"), Some(Entry::Dictionary(_))));
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn lines(text: &str, start: f64) -> Vec<String> {
        let control = Dictionary::parse(Path::new(CONTROL), text).unwrap();
        let mut found = Findings::default();
        check(&control, None, start, &mut found);
        found.0.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn methods_that_debian_lacks_are_doubtful() {
        for (method, count) in [("scotch", 1), ("simple", 0)] {
            let text = format!("numberOfSubdomains 2; method {method};");
            let mut found = Findings::default();
            let dictionary = Dictionary::parse(Path::new(DECOMPOSITION), &text).unwrap();
            check_decomposition(&dictionary, &mut found);
            assert_eq!(found.counts(), [0, count], "{method}");
        }
    }

    #[test]
    fn times_are_those_of_the_start_and_the_end_that_is_meant() {
        let good = "startFrom latestTime; startTime 10; endTime 2; deltaT 0.5;";
        assert_eq!(lines(good, 0.0), Vec::<String>::new());
        assert_eq!(
            lines("startFrom startTime; startTime -1; endTime 2; deltaT 0.5;", -1.0),
            Vec::<String>::new()
        );
        assert_eq!(lines("stopAt writeNow; deltaT 0.5;", 0.0), Vec::<String>::new());
        let infinite = "startTime inf; endTime 2; deltaT 0.5;";
        assert_eq!(lines(&format!("startFrom latestTime; {infinite}"), 0.0), Vec::<String>::new());
        assert!(lines(&format!("startFrom startTime; {infinite}"), 0.0)[0].contains("startTime = inf"));
        assert!(lines("stopAt endTime; deltaT 0.5;", 0.0)[0].contains("endTime = missing"));
        assert!(lines("startFrom startTime; endTime 2; deltaT 0.5;", 0.0)[0].contains("startTime = missing"));
        assert_eq!(
            lines(good, 5.0),
            [
                "error: system/controlDict: endTime = 2, allowed: more than half of deltaT = 0.5 s after the start at 5 s. No step would be taken"
            ]
        );
    }
}
