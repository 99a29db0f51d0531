//! Tests of the files of a new case, and of the folders that are refused.

use super::*;
use crate::Case;
use crate::dictionary::Dictionary;
use crate::disc_model::DiscModel;
use crate::grains::PRESETS;
use crate::packing::Start;
use crate::scene::{Mechanics, parse_wall, proposed_cells, proposed_probes};
use msdd_rve::Compression;

fn spread(mean: f64) -> Spread {
    Spread { mean, deviation: 0.01 * mean }
}

fn made(change: impl Fn(&mut Scene)) -> Vec<File> {
    let size = [0.2, 0.1];
    let mut scene = Scene {
        size,
        cells: proposed_cells(size, 1e-3),
        walls: ["350", "insulated", "0:293,60:350", "insulated"].map(|text| parse_wall(text).unwrap()),
        initial_temperature: 293.15,
        material: "steel".to_string(),
        grains: PRESETS[1].grains,
        model: DiscModel::shipped().unwrap(),
        start: Start::Porosity(0.125),
        compression: Compression::Horizontal,
        mechanics: Mechanics::Equilibrium,
        heat_source: None,
        end_time: 60.0,
        tolerance: None,
        probes: proposed_probes(size),
    };
    change(&mut scene);
    let packing = Packing {
        boxes: 4,
        grains: 500,
        compression: Compression::Horizontal,
        porosity: spread(0.125),
        fabric_index: spread(0.04),
        stress: [spread(1.3e7), spread(7e6)],
        pressure: spread(1.01e7),
        conductivity: spread(0.3),
    };
    files(&scene, &packing, "bed", Path::new("/checkout"))
}

/// A text as OpenFOAM would expand it: without the line that includes the types of patches which are not walls.
fn expanded(text: &str) -> String {
    text.replace("    #includeEtc \"caseDicts/setConstraintTypes\"\n", "")
}

fn text<'a>(files: &'a [File], path: &str) -> &'a str {
    &files.iter().find(|file| file.path == path).unwrap().text
}

#[test]
fn every_place_of_every_template_is_filled_and_every_dictionary_is_read() {
    let place = regex::Regex::new("@[A-Za-z]+@").unwrap();
    for mechanics in [Mechanics::None, Mechanics::Equilibrium] {
        let files = made(|scene| {
            scene.mechanics = mechanics;
            scene.heat_source = Some(3000.0);
            scene.tolerance = Some(0.05);
        });
        assert_eq!(files.len(), 14);
        for File { path, text, program } in &files {
            assert!(!place.is_match(text), "{path}: {text}");
            assert_eq!(*program, path.starts_with("All"));
            if path.contains('/') {
                let dictionary = Dictionary::parse(Path::new(path), &expanded(text)).unwrap();
                assert_eq!(
                    dictionary.dictionary_at("FoamFile").unwrap().text("object").unwrap(),
                    path.rsplit('/').next().unwrap()
                );
            }
        }
        assert_eq!(
            text(&files, "system/controlDict").contains("spaceProbes"),
            mechanics == Mechanics::Equilibrium
        );
        assert!(text(&files, "system/fvSolution").contains("\n    temperatureTolerance    0.05;"));
        assert!(text(&files, "constant/fvOptions").contains("(3000 0)"));
    }
}

#[test]
fn values_stand_where_the_solver_looks_for_them() {
    let files = made(|_| ());
    let read = |path: &str| Dictionary::parse(Path::new(path), &expanded(text(&files, path))).unwrap();
    assert_eq!(read("constant/granularProperties").number("youngModulus", |_| true, "").unwrap(), 193e9);
    assert_eq!(read("0/stress").text("internalField").unwrap(), "uniform ( -13000000 0 0 -7000000 0 0 )");
    let temperature = read("0/T");
    assert_eq!(temperature.uniform("internalField").unwrap(), 293.15);
    let walls = crate::walls::heat_of_walls(&temperature).unwrap();
    assert_eq!(
        walls,
        ["350", "insulated", "0:293,60:350", "insulated"].map(|text| parse_wall(text).unwrap())
    );
    assert!(text(&files, "Allrun").contains("MSDD=${MSDD:-/checkout}"));
    assert!(text(&files, "README.md").contains("| left wall | 350 K | `0/T` |\n| right wall | insulated |"));
}

/// Needs OpenFOAM, because it reads the files through foamDictionary.
#[test]
fn the_reference_refuses_gravity_and_heat_sources() {
    if std::process::Command::new("foamDictionary").arg("-help").output().is_err() {
        return;
    }
    let folder = std::env::temp_dir().join(format!("msdd-loads-{}", std::process::id()));
    write(&folder, &made(|scene| scene.heat_source = Some(3000.0))).unwrap();
    let refused = || Case::read(&folder).unwrap_err().to_string();
    let error = refused();
    assert!(
        error.contains("constant/fvOptions: ") && error.contains("= {...}, allowed: no sources"),
        "{error}"
    );
    fs::rename(folder.join("constant/fvOptions"), folder.join("system/fvOptions")).unwrap();
    assert!(refused().contains("system/fvOptions: "));
    fs::remove_file(folder.join("system/fvOptions")).unwrap();
    let weigh = |value: &str| {
        let text = head("uniformDimensionedVectorField", "g")
            + &format!("dimensions [0 1 -2 0 0 0 0]; value {value};");
        fs::write(folder.join("constant/g"), text).unwrap();
    };
    weigh("(0 -9.81 0)");
    let error = refused();
    assert!(error.contains("constant/g: value = ( 0 -9.81 0 ), allowed: (0 0 0): discs have"), "{error}");
    weigh("(0 0 0)");
    assert!(Case::read(&folder).is_ok());
    fs::remove_dir_all(&folder).unwrap();
}

/// Needs OpenFOAM, because it reads the files through foamDictionary.
#[test]
fn the_reference_reads_what_is_written() {
    if std::process::Command::new("foamDictionary").arg("-help").output().is_err() {
        return;
    }
    let folder = std::env::temp_dir().join(format!("msdd-case-{}", std::process::id()));
    write(&folder, &made(|_| ())).unwrap();
    let case = Case::read(&folder).unwrap();
    assert_eq!((case.size, case.end_time, case.mean_radius), ([0.2, 0.1], 60.0, 1e-3));
    assert_eq!(
        case.walls,
        ["350", "insulated", "0:293,60:350", "insulated"].map(|text| parse_wall(text).unwrap())
    );
    assert_eq!(case.probes, proposed_probes([0.2, 0.1]));
    let mode = fs::metadata(folder.join("Allrun")).unwrap().permissions().mode();
    assert_eq!(mode & 0o111, (mode & 0o444) >> 2);
    assert!(check_folder(&folder, false).unwrap_err().to_string().contains("allowed: an empty folder"));
    assert!(check_folder(&folder, true).is_ok());
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn folders_that_are_none_are_refused() {
    let refused = |path: &str| check_folder(Path::new(path), true).unwrap_err().to_string();
    assert!(refused("/tmp/a case").contains("allowed: a path without blanks"));
    assert!(
        refused(concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml")).contains("allowed: a folder, or a name")
    );
    assert!(check_folder(Path::new("/tmp/no/such/folder/yet"), false).is_ok());
}

#[test]
fn a_folder_has_its_name_when_all_files_are_in_it() {
    let parent = std::env::temp_dir().join(format!("msdd-making-{}", std::process::id()));
    let (folder, making) = (parent.join("bed"), parent.join("bed.making"));
    // What a killed program left
    fs::create_dir_all(&making).unwrap();
    fs::write(making.join("old"), "").unwrap();
    // The second file cannot be written below the first
    let file = |path: &'static str| File { path, text: String::new(), program: false };
    assert!(write(&folder, &[file("a"), file("a/b")]).is_err());
    assert!(!folder.exists());
    write(&folder, &[file("a"), file("c/b")]).unwrap();
    assert!(folder.join("a").exists() && folder.join("c/b").exists());
    assert!(!folder.join("old").exists() && !making.exists());
    fs::remove_dir_all(&parent).unwrap();
}
