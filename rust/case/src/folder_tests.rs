//! Tests of the files of a new case, and of the folders that are refused.

use super::*;
use crate::Case;
use crate::scenes_for_tests::{discs, text};
use msdd_rve::Compression;

fn made(scene: &DiscCase) -> Vec<File> {
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
    files(scene, &packing, "bed", Path::new("/checkout"))
}

/// Needs OpenFOAM, because it reads the files through foamDictionary.
#[test]
fn the_reference_reads_what_is_written_and_refuses_gravity_and_heat_sources() {
    if std::process::Command::new("foamDictionary").arg("-help").output().is_err() {
        return;
    }
    let folder = std::env::temp_dir().join(format!("msdd-case-{}", std::process::id()));
    let files = made(&DiscCase { heat_source: Some(3000.0), tolerance: Some(0.05), ..discs() });
    write(&folder, &files).unwrap();
    for (path, words) in [
        ("system/controlDict", "spaceProbes"),
        ("system/fvSolution", "\n    temperatureTolerance    0.05;"),
        ("0/stress", "uniform (-13000000 0 0 -7000000 0 0);"),
        ("README.md", "| left wall | 350 K | `0/T` |\n| right wall | insulated |"),
    ] {
        assert!(text(&files, path).contains(words), "{path}: {words}");
    }
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
        let gravity = File::foam("constant/g", "uniformDimensionedVectorField", &text);
        write(&folder, &[gravity]).unwrap();
    };
    weigh("(0 -9.81 0)");
    refused("constant/g: value = ( 0 -9.81 0 ), allowed: (0 0 0): discs have");
    weigh("(0 0 0)");
    let (case, scene) = (Case::read(&folder).unwrap(), discs());
    assert_eq!((case.size, case.end_time, case.mean_radius), (scene.size, 60.0, 1e-3));
    assert_eq!((case.material.young_modulus, case.initial_temperature), (193e9, 293.15));
    assert_eq!((case.walls, case.probes), (scene.walls, scene.probes));
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
    let error = check_folder(&folder.join("a"), true).unwrap_err().to_string();
    assert!(error.contains("allowed: a folder, or a name"), "{error}");
    fs::remove_dir_all(&parent).unwrap();
}
