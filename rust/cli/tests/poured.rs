//! Beds that were poured as data for the law of spheres: `msdd score --database FOLDER`.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder for one test, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("msdd-cli-poured-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    /// Copies a shipped bed.
    fn with(&self, bed: &str) -> PathBuf {
        let (from, to) = (root().join("cases/database/poured").join(bed), self.0.join(bed));
        std::fs::create_dir_all(&to).unwrap();
        for file in std::fs::read_dir(from).unwrap().map(|file| file.unwrap().path()) {
            std::fs::copy(&file, to.join(file.file_name().unwrap())).unwrap();
        }
        to
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn score(database: &Path) -> Output {
    let model = root().join("rust/surrogate/models/spheres.json");
    let mut command = Command::new(env!("CARGO_BIN_EXE_msdd"));
    command.args(["score", "--model"]).arg(model).arg("--database").arg(database).output().unwrap()
}

fn refused(database: &Path) -> String {
    let output = score(database);
    assert_eq!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stdout));
    String::from_utf8(output.stderr).unwrap()
}

/// A lid that is moved, one that keeps its pressure, and the same in a cylinder: two packings each, with 35, 30 and 30 states after
/// the first.
#[test]
fn the_law_is_followed_along_the_strain_inside() {
    let folder = Folder::new("score");
    folder.with("path20");
    folder.with("kept40");
    folder.with("round40");
    let output = score(&folder.0);
    let told = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let row = told.lines().find(|line| line.starts_with("poured")).expect("a row of beds");
    let cells: Vec<&str> = row.split_whitespace().collect();
    assert_eq!(&cells[1..3], ["6", "190"], "{row}");
    // Errors of pressure, deviator and conductivities by contacts and gas in per cent, each before its scatter, which is not known.
    for error in [cells[3], cells[5], cells[7], cells[9]] {
        let error: f64 = error.parse().unwrap();
        assert!(error > 0.1 && error < 40.0, "{row}");
    }
    assert!(!told.contains("NaN"), "{told}");
}

/// Beds tell nothing of the gas, so that a law of them alone would be wrong next to it.
#[test]
fn a_law_of_beds_alone_is_refused() {
    let folder = Folder::new("alone");
    for bed in ["path20", "kept40", "load20", "closed40"] {
        folder.with(bed);
    }
    let out = folder.0.join("law.json");
    let mut command = Command::new(env!("CARGO_BIN_EXE_msdd"));
    command.args(["train", "--model", "spheres", "--database"]).arg(&folder.0).arg("--out").arg(&out);
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(
        String::from_utf8(output.stderr).unwrap().contains("allowed: poured beds together with boxes")
            && !out.exists()
    );
}

#[test]
fn what_is_no_bed_with_strains_is_refused() {
    let folder = Folder::new("refused");
    assert!(refused(&folder.0).contains("no folder with bed.toml, allowed: a folder of beds"));
    let bed = folder.with("path20");
    let change = |file: &str, from: &str, to: &str| {
        let text = std::fs::read_to_string(bed.join(file)).unwrap();
        assert!(text.contains(from), "{from}");
        std::fs::write(bed.join(file), text.replacen(from, to, 1)).unwrap();
    };
    change("dem-18.csv", "strain_3", "other");
    assert!(refused(&folder.0).contains("dem-18.csv: no column strain_3 of numbers"));
    std::fs::remove_file(bed.join("dem-18.csv")).unwrap();
    change("bed.toml", "friction = 0.3", "roughness = 3e-7\nhardness = 7e9\nfriction = 0.3");
    assert!(refused(&folder.0).contains("bed.toml: spheres that are rough"));
    std::fs::remove_file(bed.join("dem-17.csv")).unwrap();
    assert!(refused(&folder.0).contains("path20: no file dem-<seed>.csv"));
}
