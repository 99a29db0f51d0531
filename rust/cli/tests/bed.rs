//! The program `msdd bed run`: its files, the same bytes again, and what it refuses.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder for one test, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("msdd-cli-bed-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The shipped case, with fewer grains in a smaller box, for a shorter time.
fn case(folder: &Path, change: impl Fn(String) -> String) -> PathBuf {
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/beaulieu");
    let text = std::fs::read_to_string(shipped.join("bed.toml")).unwrap();
    let small = [
        ("number = 8849", "number = 350"),
        ("base = [0.1, 0.2]", "base = [0.032, 0.1]"),
        ("end = 4000", "end = 400"),
        ("simulated_young_modulus = 50e6", "simulated_young_modulus = 10e6"),
    ];
    let text = small.into_iter().fold(text, |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    });
    let case = folder.join("case");
    std::fs::create_dir_all(&case).unwrap();
    std::fs::write(case.join("bed.toml"), change(text)).unwrap();
    std::fs::copy(shipped.join("experiment.csv"), case.join("experiment.csv")).unwrap();
    case
}

fn run(case: &Path, out: &Path, more: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_msdd"));
    command.args(["bed", "run"]).arg(case).arg("--out").arg(out).args(more).output().unwrap()
}

#[test]
fn all_files_are_written_and_are_the_same_again() {
    let folder = Folder::new("files");
    let vary = "\n[[vary]]\nkey = \"gas.accommodation\"\nvalue = 0.9\n[[vary]]\nkey = \"seed\"\nvalue = 2\n";
    let case = case(&folder.0, |text| text[..text.find("[[vary]]").unwrap_or(text.len())].to_string() + vary);
    let outs = ["one", "two"].map(|name| folder.0.join(name));
    let output = run(&case, &outs[0], &["--threads", "1", "--vary"]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{message}");
    let told = String::from_utf8(output.stdout).unwrap();
    for words in [
        "350 grains, seed 1",
        "held",
        "resisting",
        "gas.accommodation = 0.9",
        "seed = 2",
        "simulated less measured",
    ] {
        assert!(told.contains(words), "no {words} in {told}");
    }
    assert!(run(&case, &outs[1], &["--threads", "2", "--vary"]).status.success());
    for name in ["temperature.csv", "comparison.csv", "bed.json", "grains.vtp", "temperature.svg"] {
        let [one, two] = [0, 1].map(|k| std::fs::read_to_string(outs[k].join(name)).unwrap());
        assert!(one == two, "{name} differs between one thread and two");
        assert!(one.len() > 200, "{name}: {one}");
    }
    let text = |name: &str| std::fs::read_to_string(outs[0].join(name)).unwrap();
    // Two ways to take the plate, three probes, 21 times.
    assert_eq!(text("temperature.csv").lines().count(), 1 + 2 * 3 * 21);
    // Two ways, three distances and all; and all with two values changed.
    assert_eq!(text("comparison.csv").lines().count(), 1 + 2 * 4 + 2 * 2);
    let json: serde_json::Value = serde_json::from_str(&text("bed.json")).unwrap();
    assert_eq!(json["stages"].as_array().unwrap().len(), 4);
    assert_eq!(json["grains"], 350);
    assert!(text("temperature.svg").ends_with("</svg>\n") && text("grains.vtp").ends_with("</VTKFile>\n"));
    let too_large = run(&case, &folder.0.join("large"), &["--seed", "9223372036854775808"]);
    assert_eq!(too_large.status.code(), Some(2));
    let other = folder.0.join("seed");
    assert!(run(&case, &other, &["--seed", "5"]).status.success());
    assert!(std::fs::read_to_string(other.join("temperature.csv")).unwrap() != text("temperature.csv"));
}

/// Measurements after the end are told, and where none is left there is no number; heat that comes in steps of a third of the end has
/// four rows.
#[test]
fn what_is_not_compared_is_told() {
    let folder = Folder::new("left-out");
    let case = case(&folder.0, |text| {
        let text = text[..text.find("[[vary]]").unwrap_or(text.len())].to_string();
        text.replace("end = 400", "end = 0.3").replace("output_every = 20", "output_every = 0.1")
    });
    let rows = "distance_m,time_s,temperature_C\n0.04,0.1,20\n0.06,0.5,20\n0.073,9,21\n";
    std::fs::write(case.join("experiment.csv"), rows).unwrap();
    let out = folder.0.join("out");
    let output = run(&case, &out, &[]);
    let told = String::from_utf8(output.stdout).unwrap();
    assert!(told.contains("Note: 2 of 3 measurements lie outside the time of the run"), "{told}");
    assert!(told.contains("–       –       –"), "{told}");
    let text = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    assert!(text("comparison.csv").contains("held,,,0.06,0,,,\n"), "{}", text("comparison.csv"));
    assert_eq!(text("temperature.csv").lines().count(), 1 + 2 * 3 * 4);
}

#[test]
fn what_is_wrong_is_named_before_anything_is_computed() {
    let folder = Folder::new("wrong");
    let refused = |out: &Path, change: &dyn Fn(String) -> String| {
        let case = case(&folder.0, change);
        let output = run(&case, out, &[]);
        assert_eq!(output.status.code(), Some(1));
        String::from_utf8(output.stderr).unwrap()
    };
    let out = folder.0.join("out");
    let text = refused(&out, &|text| text.replace("poisson_ratio = 0.29", "poisson_ratio = 0.9"));
    assert!(text.contains("bed.toml: grains.poisson_ratio = 0.9, allowed: 0 to 0.5"), "{text}");
    let text = refused(&out, &|text| text.replace("experiment.csv", "nothing.csv"));
    assert!(text.contains("cannot read") && text.contains("nothing.csv"), "{text}");
    let text = refused(&out, &|text| text.replace("[0.04, 0.06, 0.073]", "[0.04, 0.06]"));
    assert!(text.contains("distance_m = 0.073 is none of record.distances"), "{text}");
    assert!(!out.exists());
    std::fs::create_dir_all(out.join("bed.json")).unwrap();
    let text = refused(&out, &|text| text);
    assert!(text.contains("bed.json: is a folder"), "{text}");
}

/// The shipped case `column`, with few grains and for a short time.
fn moving(folder: &Path) -> PathBuf {
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/column/bed.toml");
    let small = [
        ("number = 20000", "number = 120"),
        ("base = [0.16, 0.16]", "base = [0.0256, 0.0256]"),
        ("distances = [0.03, 0.06, 0.09, 0.12, 0.15]", "distances = [0.01, 0.02]"),
        ("heights = [0.03, 0.15]", "heights = [0.008, 0.03]"),
        ("end = 24000", "end = 1200"),
        ("steps = 4000", "steps = 500"),
        ("output_every = 1200", "output_every = 600"),
    ];
    let text = small.into_iter().fold(std::fs::read_to_string(shipped).unwrap(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    });
    let case = folder.join("moving");
    std::fs::create_dir_all(&case).unwrap();
    std::fs::write(case.join("bed.toml"), text).unwrap();
    case
}

/// Several packings: each has the bytes it has alone, the mean is theirs, and what was computed is not computed again unless the
/// case is another.
#[test]
fn packings_are_joined_and_a_run_goes_on_where_it_was_killed() {
    let folder = Folder::new("packings");
    let case = moving(&folder.0);
    let outs = ["alone", "all"].map(|name| folder.0.join(name));
    let text = |out: &Path, name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    let output = run(&case, &outs[0], &["--seed", "2"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(run(&case, &outs[1], &["--packings", "2"]).status.success());
    let one = text(&outs[1], "dem-2.csv");
    assert_eq!(one.split_once('\n').unwrap().1, text(&outs[0], "dem.csv"));
    let cells = |text: &str, column: &str| -> Vec<f64> {
        let mut rows = text.lines().filter(|line| !line.starts_with('#'));
        let place = rows.next().unwrap().split(',').position(|name| name == column).unwrap();
        rows.map(|row| row.split(',').nth(place).unwrap().parse().unwrap()).collect()
    };
    let files = ["dem-1.csv", "dem-2.csv", "dem.csv", "dem-scatter.csv"];
    for column in ["T_0.01", "p", "K", "coordination"] {
        let [a, b, mean, scatter] = files.map(|name| cells(&text(&outs[1], name), column));
        assert_eq!(mean.len(), 3);
        for k in 0..3 {
            let near = |found: f64, wanted: f64| (found - wanted).abs() <= 1e-6 * a[k].abs();
            assert!(near(mean[k], 0.5 * (a[k] + b[k])), "{column}");
            assert!(near(scatter[k], (a[k] - b[k]).abs() / 2f64.sqrt()), "{column}");
        }
    }
    // As after a kill: one packing is there, the other and the mean are not.
    let whole = text(&outs[1], "dem.csv");
    std::fs::remove_file(outs[1].join("dem-1.csv")).unwrap();
    std::fs::remove_file(outs[1].join("dem.csv")).unwrap();
    let told = String::from_utf8(run(&case, &outs[1], &["--packings", "2"]).stdout).unwrap();
    assert!(told.contains("packing 2 of 2, seed 2: taken from") && !told.contains("seed 1: taken"), "{told}");
    assert_eq!(text(&outs[1], "dem.csv"), whole);
    // Another case in the same folder of results is computed afresh.
    let changed = text(&case, "bed.toml").replace("pressure = 20000", "pressure = 30000");
    std::fs::write(case.join("bed.toml"), changed).unwrap();
    let told = String::from_utf8(run(&case, &outs[1], &["--packings", "2"]).stdout).unwrap();
    assert!(!told.contains("taken from"), "{told}");
    assert_ne!(text(&outs[1], "dem.csv"), whole);
}

#[test]
fn packings_are_for_moving_beds_and_more_than_one() {
    let folder = Folder::new("packings-wrong");
    let out = folder.0.join("out");
    let refused = run(&case(&folder.0, |text| text), &out, &["--packings", "2"]);
    assert_eq!(refused.status.code(), Some(1));
    assert!(
        String::from_utf8(refused.stderr).unwrap().contains("--packings, allowed: of a bed without a plate")
    );
    let case = moving(&folder.0);
    assert_eq!(run(&case, &out, &["--packings", "1"]).status.code(), Some(2));
    let refused = run(&case, &out, &["--seed", "9223372036854775807", "--packings", "2"]);
    assert_eq!(refused.status.code(), Some(1));
    assert!(String::from_utf8(refused.stderr).unwrap().contains("would be too large"));
    assert!(!out.exists());
    // A folder that cannot be made is reported before anything is computed.
    let under_a_file = case.join("bed.toml/out");
    for more in [&[][..], &["--packings", "2"]] {
        let refused = run(&case, &under_a_file, more);
        assert_eq!(refused.status.code(), Some(1));
        assert!(refused.stdout.is_empty());
        assert!(String::from_utf8(refused.stderr).unwrap().contains("bed.toml/out"));
    }
}
