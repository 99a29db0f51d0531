//! Runs the check on the cases of this project, in which it must find nothing, and on the bad input of the solver's tests.
//! Needs OpenFOAM's foamDictionary, as scripts/setup installs it.

use msdd_case::check::{Findings, check};
use std::fs;
use std::path::{Path, PathBuf};

fn checkout() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn lines(found: &Findings) -> Vec<String> {
    found.0.iter().map(ToString::to_string).collect()
}

#[test]
fn shipped_cases_have_no_errors() {
    let cases = checkout().join("cases");
    let mut count = 0;
    for name in names(&cases).iter().filter(|name| cases.join(name).join("system/controlDict").exists()) {
        let found = check(&cases.join(name));
        println!("{name}: {:#?}", lines(&found));
        assert_eq!(found.counts()[0], 0, "{name}: {:#?}", lines(&found));
        count += 1;
    }
    assert_eq!(count, 16);
}

/// Copies the case that the solver's tests start from, with its includes spelled out; text is appended to one of its files.
fn changed(work: &Path, file: &str, text: &str) {
    let checkout = checkout();
    let small = checkout.join("tests/openfoam/small");
    for folder in ["0", "constant", "system"] {
        fs::create_dir_all(work.join(folder)).unwrap();
        for name in names(&small.join(folder)).iter().filter(|name| small.join(folder).join(name).is_file()) {
            let whole = fs::read_to_string(small.join(folder).join(name)).unwrap();
            let whole = whole.replace("../../../../cases", checkout.join("cases").to_str().unwrap());
            let more = if format!("{folder}/{name}") == file { text } else { "" };
            fs::write(work.join(folder).join(name), whole + more).unwrap();
        }
    }
    fs::write(work.join("system/damaged.json"), "{\"schema\": \"msdd-increment-model-1\", ").unwrap();
}

fn found_in(name: &str, file: &str, text: &str) -> Vec<String> {
    let work = std::env::temp_dir().join(format!("msdd-check-{}-{name}", std::process::id()));
    changed(&work, file, text);
    let found = check(&work);
    fs::remove_dir_all(&work).unwrap();
    lines(&found)
}

#[test]
fn the_case_of_the_tests_is_sound() {
    assert_eq!(found_in("good", "none", ""), Vec::<String>::new());
}

#[test]
fn what_is_doubtful_or_missing_is_said() {
    let properties = "constant/granularProperties";
    for (name, file, text, wanted) in [
        (
            "typo",
            properties,
            "surrogate { modle builtin; }",
            "doubt: constant/granularProperties: surrogate/modle",
        ),
        ("loose", "0/porosity", "internalField uniform 0.2;", "doubt: 0/porosity: internalField = up to 0.2"),
        (
            "apart",
            "0/porosity",
            "internalField uniform 0.25;",
            "error: 0/porosity: internalField = up to 0.25",
        ),
        (
            "dense",
            "0/porosity",
            "internalField uniform 0.02;",
            "doubt: 0/porosity: internalField = down to 0.02",
        ),
        ("percent", "0/porosity", "internalField uniform 12.5;", "error: 0/porosity: internalField = 12.5"),
        (
            "strain",
            properties,
            "thermalExpansion 5e-3;",
            "doubt: constant/granularProperties: thermalExpansion = 0.005",
        ),
        ("grains", properties, "meanRadius 0.05;", "doubt: system/blockMeshDict: blocks = "),
        (
            "wall",
            "0/T",
            "boundaryField { right { type fixedValue; value uniform -300; } }",
            "error: 0/T: boundaryField/right = -300 K",
        ),
        ("patch", "0/T", "boundaryField { rigth { type zeroGradient; } }", "doubt: 0/T: boundaryField/rigth"),
        (
            "short",
            "system/controlDict",
            "endTime 1e-3; deltaT 1e-4;",
            "doubt: system/controlDict: endTime = 0.001 s",
        ),
        ("long", "system/controlDict", "endTime 1e6;", "doubt: system/controlDict: endTime = 1000000 s"),
        ("coarse", "system/controlDict", "endTime 20; deltaT 5;", "doubt: system/controlDict: deltaT = 5 s"),
        ("control", "system/controlDict", "adjustTimestep yes;", "doubt: system/controlDict: adjustTimestep"),
        (
            "code",
            "system/controlDict",
            "libs (\"libmine.so\");",
            "doubt: system/controlDict: libs = libmine.so",
        ),
        (
            "quiet",
            properties,
            "equilibriumCoeffs {}",
            "doubt: constant/granularProperties: equilibriumCoeffs",
        ),
        (
            "word",
            "system/controlDict",
            "writeControl runtime;",
            "error: system/controlDict: writeControl = runtime",
        ),
        ("from", "system/controlDict", "startFrom start;", "error: system/controlDict: startFrom = start"),
        ("stop", "system/controlDict", "stopAt never;", "error: system/controlDict: stopAt = never"),
        (
            "unwritten",
            "system/controlDict",
            "writeControl runTime; writeInterval 1.1;",
            "doubt: system/controlDict: writeInterval = 1.1 s, allowed: at most the length of the run, 1 s",
        ),
        (
            "unwritten-steps",
            "system/controlDict",
            "writeControl timeStep; writeInterval 21;",
            "doubt: system/controlDict: writeInterval = 21 steps",
        ),
        (
            "function",
            properties,
            "thermalConductivity table ((0 1) (900 2));",
            "error: constant/granularProperties: thermalConductivity = table",
        ),
        (
            "falling",
            properties,
            "heatCapacity table ((900 1) (0 2));",
            "error: constant/granularProperties: heatCapacity = ( ( 900 1 ) ( 0 2 ) )",
        ),
        (
            "cold",
            properties,
            "heatCapacity table ((50 -1) (51 1) (300 1));",
            "error: constant/granularProperties: heatCapacity = -1 J/(kg K) at 50 K, allowed: > 0 J/(kg K)",
        ),
        (
            "hot",
            properties,
            "heatCapacity table ((50 1) (60 -1) (300 1));",
            "doubt: constant/granularProperties: heatCapacity = 0 J/(kg K) at 55 K, allowed: > 0 J/(kg K)",
        ),
        (
            "braces",
            properties,
            "heatCapacity { type table; values ((0 1) (900 2)); }",
            "error: constant/granularProperties: heatCapacity = { type table; ... }, allowed: heatCapacity table",
        ),
        (
            "free",
            properties,
            "mechanics equilibrium; equilibriumCoeffs { walls { \".*\" { type pressure; pressure 0; } top { type frictionless; } } }",
            "error: constant/granularProperties: equilibriumCoeffs/walls = nothing against motion along (1 0 0)",
        ),
        ("open", "system/fvSolution", "msddFoam {", "error: system/fvSolution: "),
        (
            "linear",
            "system/fvSolution",
            "solvers { T { solver PBiCGStab; preconditioner DILU; } }",
            "error: system/fvSolution: solvers/T/preconditioner = DILU, allowed: DIC, FDIC, diagonal, none",
        ),
        ("schemes", "system/fvSchemes", "gradSchemes 1;", "error: system/fvSchemes: gradSchemes = missing"),
        (
            "flux",
            "system/controlDict",
            "functions { one { type wallHeatFlux; libs (fieldFunctionObjects); } }",
            "error: system/controlDict: functions/one/type = wallHeatFlux",
        ),
        (
            "conductor",
            properties,
            "thermalConductivity 1e13;",
            "doubt: constant/granularProperties: thermalConductivity = 10000000000000",
        ),
    ] {
        let found = found_in(name, file, text);
        println!("{name}: {found:#?}");
        assert!(found.iter().any(|line| line.starts_with(wanted)), "{name}: {wanted}\n{found:#?}");
    }
    let quiet = found_in("last", "system/controlDict", "writeControl runTime; writeInterval 1;");
    assert!(!quiet.iter().any(|line| line.contains("writeInterval")), "{quiet:?}");
    let found = found_in("with a blank", "none", "");
    assert!(found.len() == 1 && found[0].starts_with("error: folder: "), "{found:?}");
    let empty = std::env::temp_dir().join(format!("msdd-check-{}-empty", std::process::id()));
    fs::create_dir_all(&empty).unwrap();
    let found = lines(&check(&empty));
    fs::remove_dir_all(&empty).unwrap();
    for file in ["system/controlDict", "0/T", "constant/granularProperties", "system/blockMeshDict"] {
        assert!(found.iter().any(|line| line.starts_with(&format!("error: {file}: missing"))), "{found:#?}");
    }
    assert!(lines(&check(Path::new("no-such-folder")))[0].contains("no such folder"));
}

#[test]
fn what_the_solver_takes_is_not_refused() {
    let right = "boundaryField { right { type uniformFixedValue; value uniform 50;";
    for (name, file, text) in [
        ("units", "0/T", "dimensions [K];".to_string()),
        ("five", "0/fabricIndex", "dimensions [0 0 0 0 0];".to_string()),
        ("density", "constant/granularProperties", "density rho [kg/m^3] $density;".to_string()),
        ("falling", "0/T", format!("{right} uniformValue polynomial ((60 0) (-10 1)); }} }}")),
        ("counted", "0/T", format!("{right} uniformValue table 2 ((-10 50) (1 60)); }} }}")),
        (
            "coefficients",
            "0/T",
            format!(
                "{right} uniformValue table; uniformValueCoeffs {{ uniformValue table ((0 50) (1 60)); }} }} }}"
            ),
        ),
        (
            "inside",
            "0/T",
            format!("{right} uniformValue {{ type table; uniformValue table ((0 50) (1 60)); }} }} }}"),
        ),
        ("warm", "constant/granularProperties", "heatCapacity table ((-1 0) (10 1) (300 1));".to_string()),
        ("libraries", "system/controlDict", "libs (sampling \"libfvOptions.so\");".to_string()),
        ("now", "system/controlDict", "stopAt writeNow;".to_string()),
        ("ignored", "system/controlDict", "startTime 10;".to_string()),
    ] {
        assert_eq!(found_in(name, file, &text), Vec::<String>::new(), "{name}");
    }
    let work = std::env::temp_dir().join(format!("msdd-check-{}-start", std::process::id()));
    changed(&work, "system/controlDict", "endTime 6;");
    fs::rename(work.join("0"), work.join("5")).unwrap();
    let later = lines(&check(&work));
    fs::write(work.join("5/T"), "dimensions [m];").unwrap();
    let wrong = lines(&check(&work));
    fs::remove_dir_all(&work).unwrap();
    assert_eq!(later, Vec::<String>::new());
    assert!(wrong[0].starts_with("error: 5/T: FoamFile = missing, allowed: { version 2.0;"), "{wrong:?}");
    assert!(wrong[1].starts_with("error: 5/T: dimensions = [ m ]"), "{wrong:?}");
}

/// A copy of cases/blanket beside cases/common, with a text appended to one of its files; an empty text removes the file.
fn found_in_blanket(name: &str, file: &str, text: &str) -> Vec<String> {
    let work = std::env::temp_dir().join(format!("msdd-check-regions-{}-{name}", std::process::id()));
    for folder in ["blanket", "common"] {
        copy(&checkout().join("cases").join(folder), &work.join(folder));
    }
    let path = work.join("blanket").join(file);
    if text.is_empty() {
        fs::remove_file(&path).unwrap();
    } else {
        fs::write(&path, fs::read_to_string(&path).unwrap() + text).unwrap();
    }
    let found = check(&work.join("blanket"));
    fs::remove_dir_all(&work).unwrap();
    lines(&found)
}

/// Copies a folder without results and meshes.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for name in names(from) {
        let (old, new) = (from.join(&name), to.join(&name));
        if old.is_dir() {
            if !["polyMesh", "postProcessing"].contains(&name.as_str()) {
                copy(&old, &new);
            }
        } else {
            fs::copy(&old, &new).unwrap();
        }
    }
}

#[test]
fn beds_of_several_regions_are_checked_with_their_paths() {
    for (name, file, text, wanted) in [
        (
            "fluid",
            "constant/regionProperties",
            "regions ( fluid (bed) solid () );",
            "error: constant/regionProperties: regions/fluid = bed",
        ),
        (
            "none",
            "constant/bed/thermophysicalProperties",
            "thermoType heSolidThermo;",
            "doubt: constant/regionProperties: regions/solid",
        ),
        (
            "typing",
            "constant/bed/thermophysicalProperties",
            "crosTolerance 0.1;",
            "error: constant/bed/thermophysicalProperties: crosTolerance = 0.1",
        ),
        (
            "mechanics",
            "constant/bed/granularProperties",
            "mechanics equilibrium;",
            "error: constant/bed/granularProperties: mechanics = equilibrium, allowed: none in a region",
        ),
        (
            "radius",
            "constant/bed/granularProperties",
            "meanRadius -1;",
            "error: constant/bed/granularProperties: meanRadius = -1",
        ),
        ("no-p", "0/bed/p", "", "error: 0/bed/p: missing"),
        ("no-g", "constant/g", "", "error: constant/g: missing"),
        (
            "percent",
            "0/bed/porosity",
            "internalField uniform 14;",
            "error: 0/bed/porosity: internalField = 14",
        ),
        (
            "solver",
            "system/bed/fvSolution",
            "solvers { \"h|hFinal\" none; }",
            "error: system/bed/fvSolution: solvers/h = missing",
        ),
        (
            "library",
            "system/controlDict",
            "libs (\"libgranularModels.so\");",
            "error: system/controlDict: libs, allowed: a list with \"libgranularThermo.so\"",
        ),
    ] {
        let found = found_in_blanket(name, file, text);
        assert!(found.iter().any(|line| line.starts_with(wanted)), "{name}: {found:#?}, expected {wanted}");
    }
}

#[test]
fn stress_beside_rest_stress_is_refused_unless_the_whole_state_is_there() {
    let work = std::env::temp_dir().join(format!("msdd-check-{}-state", std::process::id()));
    let more = "surrogate { type spheres; spheresCoeffs { poissonRatio 0.3; } } restStress { lateral 0.6; }";
    changed(&work, "constant/granularProperties", more);
    let header = "FoamFile { version 2.0; format ascii; class dictionary; object g; }";
    let gravity = format!("{header} dimensions [0 1 -2 0 0 0 0]; value (0 -9.81 0);");
    fs::write(work.join("constant/g"), gravity).unwrap();
    let stress = "dimensions [1 -1 -2 0 0 0 0]; internalField uniform (-3 0 0 -3 0 -3);
        boundaryField { \".*\" { type zeroGradient; } }";
    fs::write(work.join("0/stress"), format!("{header} {stress}")).unwrap();
    let twice =
        || lines(&check(&work)).iter().any(|line| line.contains("The stress at the start is given twice"));
    let [last, others @ ..] = msdd_surrogate::spheres::model::NAMES.map(msdd_case::check::grains::field_name);
    for name in others {
        fs::write(work.join("0").join(name), "").unwrap();
    }
    assert!(twice());
    fs::write(work.join("0").join(last), "").unwrap();
    let mended = !twice();
    fs::remove_dir_all(&work).unwrap();
    assert!(mended);
}
