//! Compares the tables of keys with the solver's sources, and tests the checks that use them.

use super::*;
use regex::Regex;
use std::path::Path;

/// Words of the list that follows `checkKeys(DICTIONARY, {` in a source of the solver.
fn list_in(source: &str, dictionary: &str) -> Vec<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../openfoam").join(source);
    let text = std::fs::read_to_string(&path).unwrap();
    let call = Regex::new(&format!(
        r"checkKeys[ \n]*\([ \n]*{}[ \n]*,[ \n]*\{{([^}}]*)\}}",
        regex::escape(dictionary)
    ))
    .unwrap();
    let inside =
        call.captures(&text).unwrap_or_else(|| panic!("{source}: no list for {dictionary}"))[1].to_string();
    Regex::new("\"([^\"]*)\"").unwrap().captures_iter(&inside).map(|word| word[1].to_string()).collect()
}

#[test]
fn tables_hold_exactly_the_keys_that_the_solver_allows() {
    let models = "granularModels";
    for (source, dictionary, keys) in [
        ("granularProperties/granularProperties.C", "*this", GRAINS),
        ("granularState/granularStateStart.C", "dict", REST_STRESS),
        ("networkModel/networkModel.C", "coeffs_", NETWORK),
        ("constantModel/constantModel.C", "coeffs_", CONSTANT),
        ("pluginModel/pluginModel.C", "coeffs_", PLUGIN),
        ("onlineRveModel/onlineRveModel.C", "coeffs_", ONLINE_RVE),
        ("spheresModel/spheresModel.C", "coeffs_", SPHERES),
        ("spheresModel/spheresModel.C", "dict", SPHERE_WALL),
        ("granularMechanics/equilibrium.C", "dict_", EQUILIBRIUM),
        ("granularMechanics/wallConditions.C", "dict", WALL),
        ("granularMechanics/stressLaw.C", "dict", ELASTIC),
        ("granularMechanics/equilibriumSolver.C", "controls", LINEAR),
        ("regionPolicy/regionPolicy.C", "dict", SIDES),
        ("../msddFoam/timeScheme/timeScheme.C", "dict", SOLVER),
        ("../granularThermo/granularSolidThermo/granularSolidThermo.C", "*this", THERMO),
    ] {
        let mut ours: Vec<&str> = keys.iter().map(|key| key.name).collect();
        let mut theirs = list_in(&format!("{models}/{source}"), dictionary);
        ours.sort_unstable();
        theirs.sort();
        assert_eq!(ours, theirs, "{source}");
    }
}

#[test]
fn mistypes_are_told_from_what_is_far_off() {
    assert_eq!(nearest("thermalExpantion", &["thermalExpansion", "density"]), Some("thermalExpansion"));
    assert_eq!(nearest("Density", &["density"]), Some("density"));
    assert_eq!(nearest("viscosity", &["density", "meanRadius"]), None);
}

#[test]
fn each_kind_of_value_is_refused_with_its_range() {
    let text = "density -1; youngModulus young [1 -1 -1 0 0 0 0] 1e7; thermalConductivity [0 0 0 0 0 0 0] 5; heatCapacity x;
        thermalExpansion -1e-3; mechanics equilibrum; surrogate network; porosty 0.1;";
    let file = Dictionary::parse(Path::new("constant/granularProperties"), text).unwrap();
    let mut found = Findings::default();
    check(&file, "constant/granularProperties", GRAINS, &[], &mut found);
    let lines: Vec<String> = found.0.iter().map(ToString::to_string).collect();
    let expected = [
        "porosty = 0.1, allowed: surrogate, density,",
        "surrogate = network, allowed: a dictionary in braces",
        "density = -1, allowed: > 0 kg/m3",
        "youngModulus = young [ 1 -1 -1 0 0 0 0 ] 1e7, allowed: > 0 Pa",
        "thermalConductivity = [ 0 0 0 0 0 0 0 ] 5, allowed: > 0 W/(m K) [ 1 1 -3 -1 0 0 0 ], if dimensions are given",
        "heatCapacity = x, allowed: > 0",
        "thermalExpansion = -1e-3, allowed: >= 0 1/K",
        "meanRadius = missing, allowed: > 0 m",
        "mechanics = equilibrum, allowed: equilibrium, none. Is 'equilibrium' meant?",
    ];
    assert_eq!(lines.len(), expected.len(), "{lines:#?}");
    for (line, expected) in lines.iter().zip(expected) {
        assert!(
            line.starts_with(&format!("error: constant/granularProperties: {expected}")),
            "{line}\n{expected}"
        );
    }
}

#[test]
fn numbers_have_any_name_and_any_form_of_their_dimensions() {
    let density = |text: &str| {
        let file = Dictionary::parse(Path::new("constant/granularProperties"), text).unwrap();
        number(&file, "density", "[ 1 -3 0 0 0 0 0 ]")
    };
    for text in
        ["3000", "density 3000", "rho [1 -3 0 0 0 0 0] 3000", "[1 -3 0 0 0] 3000", "[ kg / m^3 ] 3000"]
    {
        assert_eq!(density(&format!("density {text};")), Some(3000.0), "{text}");
    }
    for text in ["rho [1 -2 0 0 0 0 0] 3000", "1 3000", "3000 rho", "[kg/m^3 3000"] {
        assert_eq!(density(&format!("density {text};")), None, "{text}");
    }
    let file = Dictionary::parse(Path::new("constant/granularProperties"), "meanRadius r [mm] 5;").unwrap();
    assert_eq!(number(&file, "meanRadius", "[ 0 1 0 0 0 0 0 ]"), Some(0.005));
    assert_eq!(size(&file, "meanRadius"), Some(0.005));
    assert_eq!(number(&file, "meanRadius", ""), None);
}
