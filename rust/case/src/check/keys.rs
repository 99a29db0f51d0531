//! Tables of the keys of the solver's dictionaries and their allowed values. A test compares them with the solver's sources.

use super::dimensions::Dimensions;
use super::finding::Findings;
use crate::dictionary::{Dictionary, Entry, Token, joined};
use msdd_rve::message::number as number_text;

/// Kind and range of the value of a key.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A number above 0: its unit, and its dimensions as OpenFOAM writes them.
    Positive(&'static str, &'static str),
    /// The same, or a function of the temperature \[K\] in a form of OpenFOAM's Function1.
    OfTemperature(&'static str, &'static str),
    /// A number of 0 or above: its unit, and its dimensions as OpenFOAM writes them.
    NotNegative(&'static str, &'static str),
    /// A number from the first to the second, and its unit.
    Range(f64, f64, &'static str),
    /// One of these words.
    Word(&'static [&'static str]),
    Dictionary,
    /// Any value here: it is checked elsewhere, or by OpenFOAM itself.
    Any,
}

/// Forms of a function of the temperature, of OpenFOAM's Function1.
pub const FUNCTIONS: &[&str] = &["constant", "polynomial", "table", "tableFile", "csvFile"];

/// A key of a dictionary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    pub name: &'static str,
    pub required: bool,
    pub kind: Kind,
}

const fn must(name: &'static str, kind: Kind) -> Key {
    Key { name, required: true, kind }
}

const fn may(name: &'static str, kind: Kind) -> Key {
    Key { name, required: false, kind }
}

/// `constant/granularProperties`.
pub const GRAINS: &[Key] = &[
    may("FoamFile", Kind::Any),
    must("surrogate", Kind::Dictionary),
    must("density", Kind::Positive("kg/m3", "[ 1 -3 0 0 0 0 0 ]")),
    must("youngModulus", Kind::Positive("Pa", "[ 1 -1 -2 0 0 0 0 ]")),
    must("thermalConductivity", Kind::OfTemperature("W/(m K)", "[ 1 1 -3 -1 0 0 0 ]")),
    must("heatCapacity", Kind::OfTemperature("J/(kg K)", "[ 0 2 -2 -1 0 0 0 ]")),
    must("thermalExpansion", Kind::NotNegative("1/K", "[ 0 0 0 -1 0 0 0 ]")),
    must("meanRadius", Kind::Positive("m", "[ 0 1 0 0 0 0 0 ]")),
    may("conductivityFactor", Kind::Range(0.1, 10.0, "")),
    may("bulkDensity", Kind::Word(&["massConsistent", "paper"])),
    may("mechanics", Kind::Word(&["equilibrium", "none"])),
    may("equilibriumCoeffs", Kind::Dictionary),
    may("restStress", Kind::Dictionary),
    may("initialTemperature", Kind::Range(0.0, 1e5, "K")),
];

/// `restStress`.
pub const REST_STRESS: &[Key] =
    &[must("lateral", Kind::Range(0.0, 10.0, "")), may("surface", Kind::Range(0.0, 1e12, "Pa"))];

/// `constant/<region>/thermophysicalProperties` of a bed.
pub const THERMO: &[Key] = &[
    may("FoamFile", Kind::Any),
    must("thermoType", Kind::Word(&["granularSolidThermo"])),
    may("coordinateSystem", Kind::Dictionary),
    may("crossTolerance", Kind::Range(0.0, 1.0, "")),
    may("accept", Kind::Any),
    may("updateT", Kind::Any),
    may("dpdt", Kind::Any),
];

/// `surrogate` in `constant/granularProperties`, whatever its type.
pub const SURROGATE: &[Key] = &[
    must("type", Kind::Word(&["constant", "network", "onlineRve", "plugin", "spheres"])),
    may("smallestStrain", Kind::Range(0.0, 0.01, "")),
    may("outOfRegion", Kind::Dictionary),
    may("networkCoeffs", Kind::Dictionary),
    may("constantCoeffs", Kind::Dictionary),
    may("pluginCoeffs", Kind::Dictionary),
    may("onlineRveCoeffs", Kind::Dictionary),
    may("spheresCoeffs", Kind::Dictionary),
];

/// `networkCoeffs`.
pub const NETWORK: &[Key] = &[
    must("model", Kind::Any),
    may("hash", Kind::Any),
    may("conductivity", Kind::Word(&["affine", "network"])),
];

/// `constantCoeffs`.
pub const CONSTANT: &[Key] = &[
    may("model", Kind::Any),
    may("hash", Kind::Any),
    may("conductivity", Kind::Any),
    may("stress", Kind::Any),
];

/// `pluginCoeffs`.
pub const PLUGIN: &[Key] = &[must("library", Kind::Any), may("hash", Kind::Any)];

/// `onlineRveCoeffs`.
pub const ONLINE_RVE: &[Key] = &[
    may("discs", Kind::Range(20.0, 1e6, "")),
    may("seed", Kind::Range(0.0, 1e9, "")),
    may("compression", Kind::Word(&["isotropic", "horizontal", "intermediate", "sheared"])),
    may("boundary", Kind::Word(&["periodic", "walls"])),
    may("relaxation", Kind::Word(&["fire", "damped"])),
    may("conductivity", Kind::Word(&["affine", "network"])),
    may("stiffnessRatio", Kind::Range(0.01, 10.0, "")),
    may("frictionAngle", Kind::Range(0.0, 1.5, "rad")),
    may("porosityTolerance", Kind::Range(1e-6, 1.0, "")),
    may("fabricTolerance", Kind::Range(1e-6, 2.0, "")),
    may("rvePer", Kind::Word(&["cell", "history"])),
    may("strainTolerance", Kind::Range(1e-6, 0.1, "")),
];

/// `spheresCoeffs`.
pub const SPHERES: &[Key] = &[
    may("model", Kind::Any),
    may("hash", Kind::Any),
    must("poissonRatio", Kind::Range(-0.99, 0.5, "")),
    may("roughness", Kind::Range(0.0, 1.0, "m")),
    may("hardness", Kind::Range(1.0, 1e15, "Pa")),
    may("gas", Kind::Word(&["air", "argon", "helium", "nitrogen", "vacuum"])),
    may("gasPressure", Kind::Range(1e-3, 1e9, "Pa")),
    may("accommodation", Kind::Range(0.01, 1.0, "")),
    may("emissivity", Kind::Range(0.01, 1.0, "")),
    may("coordination", Kind::Range(0.0, 12.0, "")),
    may("mobilised", Kind::Range(0.0, 1.0, "")),
    may("fabric", Kind::Any),
    may("wall", Kind::Dictionary),
];

/// `wall` of `spheresCoeffs`.
pub const SPHERE_WALL: &[Key] = &[
    must("thermalConductivity", Kind::Range(1e-12, 1e12, "W/(m K)")),
    must("youngModulus", Kind::Range(1e-9, 1e15, "Pa")),
    must("poissonRatio", Kind::Range(-0.99, 0.5, "")),
    may("roughness", Kind::Range(0.0, 1.0, "m")),
    may("hardness", Kind::Range(1.0, 1e15, "Pa")),
    may("spheres", Kind::Range(0.01, 1.16, "")),
];

/// What the solver does when a state is outside of the model's trained range.
pub const POLICY: Kind = Kind::Word(&["clamp", "cutStep", "error", "warn"]);

/// `outOfRegion`; a model may have further state columns.
pub const OUT_OF_REGION: &[Key] = &[
    may("maxFraction", Kind::Range(0.0, 1.0, "")),
    may("porosity", Kind::Dictionary),
    may("fabricIndex", Kind::Dictionary),
    may("fabricShear", Kind::Dictionary),
    may("jammingFraction", Kind::Dictionary),
    may("elasticCompression", Kind::Dictionary),
    may("thermalStrain", Kind::Dictionary),
];

/// The dictionary of a column in `outOfRegion`.
pub const SIDES: &[Key] = &[may("below", POLICY), may("above", POLICY)];

/// `equilibriumCoeffs`; the ranges of residual, maxResidual, slip and layer depend on the grains.
pub const EQUILIBRIUM: &[Key] = &[
    may("law", Kind::Word(&["grains", "elastic"])),
    may("elasticCoeffs", Kind::Dictionary),
    may("residual", Kind::Any),
    may("maxIterations", Kind::Range(1.0, 1000.0, "")),
    may("maxResidual", Kind::Any),
    may("walls", Kind::Dictionary),
    may("wallCompliance", Kind::Range(0.0, 1000.0, "mean radii")),
];

/// `elasticCoeffs` of `equilibriumCoeffs`.
pub const ELASTIC: &[Key] = &[
    must("youngModulus", Kind::Positive("Pa", "[1 -1 -2 0 0 0 0]")),
    must("poissonRatio", Kind::Range(-0.99, 0.49999, "")),
];

/// `equilibrium` of `solvers` in `fvSolution`.
pub const LINEAR: &[Key] = &[
    may("solver", Kind::Word(&["GMRES", "PBiCGStab"])),
    may("preconditioner", Kind::Word(&["Cholesky", "AMG", "componentAMG"])),
    may("relTol", Kind::Range(1e-14, 0.9, "")),
    may("maxIter", Kind::Range(1.0, 1e5, "")),
    may("petsc", Kind::Dictionary),
];

/// The dictionary of a wall in `walls` of `equilibriumCoeffs`.
pub const WALL: &[Key] = &[
    may(
        "type",
        Kind::Word(&["rigid", "frictionless", "symmetry", "displacement", "pressure", "piston", "shell"]),
    ),
    may("friction", Kind::Range(0.0, 10.0, "")),
    may("slip", Kind::Any),
    may("layer", Kind::Any),
    may("layerStrength", Kind::Range(0.1, 3.0, "")),
    may("displacement", Kind::Any),
    may("pressure", Kind::Any),
    may("displacementCoeffs", Kind::Dictionary),
    may("pressureCoeffs", Kind::Dictionary),
    may("give", Kind::Range(0.0, 1000.0, "mean diameters")),
    may("giveBack", Kind::Range(0.0, 1.0, "")),
    may("youngModulus", Kind::Positive("Pa", "")),
    may("thickness", Kind::Positive("m", "")),
    may("radius", Kind::Positive("m", "")),
    may("thermalExpansion", Kind::Range(0.0, 1e-2, "1/K")),
    may("temperature", Kind::Any),
];

/// `msddFoam` of `system/fvSolution`.
pub const SOLVER: &[Key] = &[
    may("accuracy", Kind::Range(0.0, 100.0, "%")),
    may("pressureAccuracy", Kind::Range(0.0, 100.0, "%")),
    may("grains", Kind::Range(1.0, 1e15, "")),
    may("timeScheme", Kind::Word(&["paper", "secondOrder"])),
    may("nNonOrthogonalCorrectors", Kind::Range(0.0, 100.0, "")),
    may("temperatureTolerance", Kind::Range(1e-12, 1e6, "K")),
    may("stateTolerance", Kind::Range(1e-9, 100.0, "%")),
    may("logInterval", Kind::Range(1.0, 1e9, "steps")),
    may("waitLimit", Kind::Range(0.0, 1e9, "s")),
];

/// Words and numbers of `system/controlDict`; all its other keys are checked by OpenFOAM itself.
pub const CONTROL: &[Key] = &[
    may("startFrom", Kind::Word(&["startTime", "firstTime", "latestTime"])),
    may("startTime", Kind::Range(-1e300, 1e300, "s")),
    may("stopAt", Kind::Word(&["endTime", "noWriteNow", "writeNow", "nextWrite"])),
    may("endTime", Kind::Range(-1e300, 1e300, "s")),
    must("deltaT", Kind::Positive("s", "")),
    may("maxDeltaT", Kind::Positive("s", "")),
    may("minDeltaT", Kind::Positive("s", "")),
    may(
        "writeControl",
        Kind::Word(&[
            "none",
            "timeStep",
            "runTime",
            "adjustable",
            "adjustableRunTime",
            "clockTime",
            "cpuTime",
        ]),
    ),
    may("writeInterval", Kind::Positive("s or steps", "")),
];

/// Checks a dictionary against the keys that it may have. `known`: further names that are allowed.
pub fn check(dictionary: &Dictionary, file: &str, keys: &[Key], known: &[&str], found: &mut Findings) {
    for key in dictionary.keys() {
        let name = key.text.as_str();
        if !keys.iter().any(|key| key.name == name) && !known.contains(&name) {
            let names: Vec<&str> =
                keys.iter().map(|key| key.name).filter(|&name| name != "FoamFile").collect();
            let advice = match nearest(name, &names) {
                Some(near) => format!("No such key: is '{near}' meant?"),
                None => "No such key".to_string(),
            };
            found.error(
                [file, &dictionary.path_of(name)],
                &shown(dictionary, name),
                &names.join(", "),
                &advice,
            );
        }
    }
    for key in keys {
        value(dictionary, file, key, found);
    }
}

/// Checks the value of one key.
pub fn value(dictionary: &Dictionary, file: &str, key: &Key, found: &mut Findings) {
    let place = dictionary.path_of(key.name);
    let allowed = key.kind.allowed();
    let Some(entry) = dictionary.get(key.name) else {
        if key.required {
            found.error([file, &place], "missing", &allowed, "The solver needs it; add it");
        }
        return;
    };
    let good = match (key.kind, entry) {
        (Kind::Any, _) | (Kind::Dictionary, Entry::Dictionary(_)) => true,
        (Kind::Word(words), Entry::Value(tokens)) => words.contains(&joined(tokens).as_str()),
        (Kind::Positive(_, dimensions), Entry::Value(_)) => {
            number(dictionary, key.name, dimensions).is_some_and(|value| value > 0.0)
        }
        (Kind::OfTemperature(_, dimensions), Entry::Value(tokens)) => {
            number(dictionary, key.name, dimensions).is_some_and(|value| value > 0.0)
                || tokens.first().is_some_and(|word| FUNCTIONS.contains(&word.text.as_str()))
        }
        (Kind::OfTemperature(..), Entry::Dictionary(own)) => {
            own.text("type").is_ok_and(|kind| FUNCTIONS.contains(&kind.as_str()))
        }
        (Kind::NotNegative(_, dimensions), Entry::Value(_)) => {
            number(dictionary, key.name, dimensions).is_some_and(|value| value >= 0.0)
        }
        (Kind::Range(least, most, _), Entry::Value(_)) => {
            number(dictionary, key.name, "").is_some_and(|value| (least..=most).contains(&value))
        }
        _ => false,
    };
    if !good {
        let advice = match (key.kind, entry) {
            (Kind::Word(words), Entry::Value(tokens)) => {
                nearest(&joined(tokens), words).map(|near| format!("Is '{near}' meant?")).unwrap_or_default()
            }
            _ => String::new(),
        };
        found.error([file, &place], &shown(dictionary, key.name), &allowed, &advice);
    }
}

/// Reads a number, which may have a name and dimensions in front; the dimensions must then be those given here.
pub fn number(dictionary: &Dictionary, key: &str, dimensions: &str) -> Option<f64> {
    let (given, value) = parts(dictionary.value(key).ok()?)?;
    let factor = match given {
        [] => 1.0,
        given => {
            Dimensions::read(given).filter(|given| !dimensions.is_empty() && given.are(dimensions))?.factor
        }
    };
    Some(value * factor)
}

/// The same with any dimensions, which are checked elsewhere.
pub fn size(dictionary: &Dictionary, key: &str) -> Option<f64> {
    let (given, value) = parts(dictionary.value(key).ok()?)?;
    Some(value * if given.is_empty() { 1.0 } else { Dimensions::read(given)?.factor })
}

/// Whether a key holds a function of the temperature and not a number.
pub fn is_function(dictionary: &Dictionary, key: &str) -> bool {
    match dictionary.get(key) {
        Some(Entry::Dictionary(_)) => true,
        Some(Entry::Value(tokens)) => {
            tokens.first().is_some_and(|word| FUNCTIONS.contains(&word.text.as_str()))
        }
        None => false,
    }
}

/// Dimensions and number of `name [0 1 0 0 0 0 0] 0.01`; name and dimensions may be missing.
fn parts(tokens: &[Token]) -> Option<(&[Token], f64)> {
    let (last, front) = tokens.split_last()?;
    let value: f64 = last.text.parse().ok().filter(|value: &f64| value.is_finite())?;
    let is_name = |token: &Token| token.text != "[" && token.text.parse::<f64>().is_err();
    match front {
        [name, rest @ ..] if is_name(name) => Some((rest, value)),
        rest => Some((rest, value)),
    }
}

fn shown(dictionary: &Dictionary, key: &str) -> String {
    match dictionary.get(key) {
        Some(Entry::Value(tokens)) => joined(tokens),
        Some(Entry::Dictionary(_)) => "{...}".to_string(),
        None => "missing".to_string(),
    }
}

impl Kind {
    /// The allowed values, for messages.
    pub fn allowed(self) -> String {
        match self {
            Self::Positive(unit, dimensions) => format!("> 0 {unit} {}", of(dimensions)).trim().to_string(),
            Self::OfTemperature(unit, dimensions) => {
                let number = Self::Positive(unit, dimensions).allowed();
                format!("{number}; or a function of the temperature [K]: {}", FUNCTIONS.join(", "))
            }
            Self::NotNegative(unit, dimensions) => {
                format!(">= 0 {unit} {}", of(dimensions)).trim().to_string()
            }
            Self::Range(least, most, unit) => {
                format!("{} to {} {unit}", number_text(least), number_text(most)).trim().to_string()
            }
            Self::Word(words) => words.join(", "),
            Self::Dictionary => "a dictionary in braces".to_string(),
            Self::Any => "a value".to_string(),
        }
    }
}

fn of(dimensions: &str) -> String {
    if dimensions.is_empty() { String::new() } else { format!("{dimensions}, if dimensions are given") }
}

/// The name that is most similar to a mistyped one, if any is similar enough.
pub fn nearest<'a>(name: &str, names: &[&'a str]) -> Option<&'a str> {
    let far = |other: &str| strsim::damerau_levenshtein(&name.to_lowercase(), &other.to_lowercase());
    let near = names.iter().copied().min_by_key(|other| far(other))?;
    (far(near) <= 1 + name.chars().count() / 4).then_some(near)
}

#[cfg(test)]
#[path = "keys_tests.rs"]
mod tests;
