//! Tests of the files of a new case, and of the folders that are refused.

use super::*;
use crate::Case;
use crate::scene::Mechanics;
use crate::scenes_for_tests::{are_whole, discs, text};
use msdd_rve::Compression;

fn made(change: impl Fn(&mut Scene)) -> Vec<File> {
    let mut scene = discs();
    change(&mut scene);
    let spread = |mean: f64| Spread { mean, deviation: 0.01 * mean };
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

#[test]
fn every_place_of_every_template_is_filled_and_every_dictionary_is_read() {
    for mechanics in [Mechanics::None, Mechanics::Equilibrium] {
        let files = made(|scene| {
            (scene.mechanics, scene.heat_source, scene.tolerance) = (mechanics, Some(3000.0), Some(0.05));
        });
        are_whole(&files);
        assert_eq!(files.len(), 14);
        let moves = mechanics == Mechanics::Equilibrium;
        for (path, words, there) in [
            ("system/controlDict", "spaceProbes", moves),
            ("system/fvSolution", "\n    temperatureTolerance    0.05;", true),
            ("constant/fvOptions", "(3000 0)", true),
            ("0/stress", "uniform (-13000000 0 0 -7000000 0 0);", true),
            ("Allrun", "MSDD=${MSDD:-/checkout}", true),
            ("README.md", "| left wall | 350 K | `0/T` |\n| right wall | insulated |", true),
        ] {
            assert_eq!(text(&files, path).contains(words), there, "{path}: {words}");
        }
    }
}

/// Needs OpenFOAM, because it reads the files through foamDictionary.
#[test]
fn the_reference_reads_what_is_written_and_refuses_gravity_and_heat_sources() {
    if std::process::Command::new("foamDictionary").arg("-help").output().is_err() {
        return;
    }
    let folder = std::env::temp_dir().join(format!("msdd-case-{}", std::process::id()));
    write(&folder, &made(|scene| scene.heat_source = Some(3000.0))).unwrap();
    let refused = |words: &str| {
        let error = Case::read(&folder).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    refused("constant/fvOptions: ");
    fs::rename(folder.join("constant/fvOptions"), folder.join("system/fvOptions")).unwrap();
    refused("system/fvOptions: heating = {...}, allowed: no sources");
    fs::remove_file(folder.join("system/fvOptions")).unwrap();
    let weigh = |value: &str| {
        let text = format!("dimensions [0 1 -2 0 0 0 0]; value {value};");
        fs::write(folder.join("constant/g"), head("uniformDimensionedVectorField", "g") + &text).unwrap();
    };
    weigh("(0 -9.81 0)");
    refused("constant/g: value = ( 0 -9.81 0 ), allowed: (0 0 0): discs have");
    weigh("(0 0 0)");
    let (case, scene) = (Case::read(&folder).unwrap(), discs());
    assert_eq!((case.size, case.end_time, case.mean_radius), (scene.size, 60.0, 1e-3));
    assert_eq!((case.material.young_modulus, case.initial_temperature), (193e9, 293.15));
    assert_eq!((case.walls, case.probes), (scene.walls, scene.probes));
    let mode = fs::metadata(folder.join("Allrun")).unwrap().permissions().mode();
    assert_eq!(mode & 0o111, (mode & 0o444) >> 2);
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_folder_has_its_name_when_all_files_are_in_it_and_others_are_refused() {
    let parent = std::env::temp_dir().join(format!("msdd-making-{}", std::process::id()));
    let (folder, making) = (parent.join("bed"), parent.join("bed.making"));
    // What a killed program left
    msdd_files::write(&making.join("old"), b"").unwrap();
    // The second file cannot be written below the first
    let file = |path: &'static str| File { path, text: String::new(), program: false };
    assert!(write(&folder, &[file("a"), file("a/b")]).is_err());
    assert!(!folder.exists() && check_folder(&folder, false).is_ok());
    write(&folder, &[file("a"), file("c/b")]).unwrap();
    assert!(folder.join("a").exists() && folder.join("c/b").exists());
    assert!(!folder.join("old").exists() && !making.exists() && check_folder(&folder, true).is_ok());
    for (path, force, allowed) in [
        (&folder, false, "an empty folder"),
        (&parent.join("a case"), true, "a path without blanks"),
        (&folder.join("a"), true, "a folder, or a name"),
    ] {
        let error = check_folder(path, force).unwrap_err().to_string();
        assert!(error.contains(&format!("allowed: {allowed}")), "{error}");
    }
    fs::remove_dir_all(&parent).unwrap();
}
