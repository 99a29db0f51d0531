//! Damaged databases and CSVs: a flipped, cut or replaced part is either detected or changes nothing that is read.
//! MSDD_FLIPS sets the number of flips.

use msdd_rve::database::{Dataset, Plan, Recipe, Run, check, export_csv, generate, inspect, read, read_all};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

const PLAN: &str = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 3\n\
    [[thermal]]\ndiscs = 40\nporosities = [0.14, 0.16]\ncompressions = [\"isotropic\"]\nrepeats = 1\nstops = [0.01]\n";

/// A small database in a folder of its own.
fn database(name: &str) -> (PathBuf, Dataset) {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("damage-{name}"));
    let _ = std::fs::remove_dir_all(&path);
    let database = path.join("a");
    let plan = Plan::parse(PLAN, "plan").unwrap();
    generate(&plan, &database, &Run::default(), |_| ControlFlow::Continue(())).unwrap();
    let dataset = read(&database).unwrap();
    (database, dataset)
}

/// SplitMix64 (Steele, Lea, Flood 2014).
fn random(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// Flips single bits of a file: either all readers of `path` detect the flip, or what they read is the same. Returns the
/// number that is found, of those that are flipped.
fn flips(path: &Path, file: &Path, dataset: &Dataset) -> (usize, usize) {
    let count = std::env::var("MSDD_FLIPS").ok().and_then(|text| text.parse().ok()).unwrap_or(200);
    let sound = std::fs::read(file).unwrap();
    let (mut state, mut found) = (11, 0);
    for _ in 0..count {
        let bit = random(&mut state) as usize % (8 * sound.len());
        let mut bytes = sound.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        std::fs::write(file, &bytes).unwrap();
        let all = read_all(&[path.to_path_buf()]);
        match read(path) {
            Ok(read) => assert_eq!(
                &read.records,
                &dataset.records,
                "bit {bit} of {} changes what is read",
                file.display()
            ),
            Err(error) => {
                found += 1;
                assert!(error.to_string().contains("damage-"), "bit {bit}: no file in: {error}");
                assert!(all.is_err(), "bit {bit}: training reads what `read` refuses");
            }
        }
    }
    std::fs::write(file, &sound).unwrap();
    assert_eq!(read(path).unwrap().records, dataset.records);
    println!("{}: {found} of {count} flips found, the others change nothing that is read", file.display());
    (found, count)
}

#[test]
fn every_flipped_bit_of_a_packing_or_its_provenance_is_found_or_changes_nothing() {
    let (database, dataset) = database("folder");
    let (found, count) = flips(&database, &database.join("packing-000001.csv.gz"), &dataset);
    assert!(found > count * 9 / 10, "{found} of {count}");
    // Of the provenance the plan, its hash and the grains are checked; the commit may be anything.
    let (found, count) = flips(&database, &database.join("provenance.json"), &dataset);
    assert!(found > count * 8 / 10, "{found} of {count}");
}

#[test]
fn every_flipped_bit_of_a_csv_or_its_provenance_is_found_or_changes_nothing() {
    let (database, _) = database("csv");
    for name in ["a.csv", "b.csv.gz"] {
        let csv = database.with_file_name(name);
        export_csv(&database, &csv, None).unwrap();
        let dataset = read(&csv).unwrap();
        let provenance = database.with_file_name(format!("{}.provenance.json", &name[..1]));
        for file in [&csv, &provenance] {
            let (found, count) = flips(&csv, file, &dataset);
            assert!(found > count * 9 / 10, "{found} of {count}");
        }
    }
}

/// Text that is not UTF-8, or a value of the wrong kind, gives an error that names row and column.
#[test]
fn text_that_is_no_text_is_named_by_row_and_column() {
    let (database, _) = database("text");
    let csv = database.with_file_name("a.csv");
    export_csv(&database, &csv, None).unwrap();
    let text = std::fs::read(&csv).unwrap();
    // As a CSV of version 0.2, without a hash.
    let provenance = database.with_file_name("a.provenance.json");
    let mut entries: serde_json::Value =
        serde_json::from_slice(&std::fs::read(&provenance).unwrap()).unwrap();
    entries.as_object_mut().unwrap().remove("sha256");
    std::fs::write(&provenance, entries.to_string()).unwrap();
    assert!(read(&csv).is_ok());
    for (old, new, problem) in [
        ("settled", &b"\x80ettled"[..], "row 1, column outcome: byte 0 is not UTF-8"),
        (",settled,", b",,", "row 1, column outcome: empty, allowed: a text"),
        (",thermal,", b",thormal,", "row 1, column kind: "),
        ("40,", b"4o,", "row 1, column discs: '4o', allowed: a whole number"),
        ("0.14,", b"1e999,", "row 1, column target_porosity: inf, allowed: a finite number"),
    ] {
        let at = text.windows(old.len()).position(|part| part == old.as_bytes()).unwrap();
        let changed = [&text[..at], new, &text[at + old.len()..]].concat();
        std::fs::write(&csv, changed).unwrap();
        let error = read(&csv).unwrap_err().to_string();
        assert!(error.contains(problem), "{problem}: {error}");
    }
    // A row that stands twice, and a file that unpacks to the same row for ever.
    let lines: Vec<&[u8]> = text.split_inclusive(|byte| *byte == b'\n').collect();
    std::fs::write(&csv, [lines[0], lines[1], lines[1]].concat()).unwrap();
    let error = read(&csv).unwrap_err().to_string();
    assert!(error.contains("row 2, column stop: packing 0, ramp packed, stop 0 stands twice"), "{error}");
}

/// Rows that violate a law are refused for training, and named.
#[test]
fn rows_that_violate_a_law_are_not_trained_with() {
    let (database, _) = database("law");
    let csv = database.with_file_name("a.csv");
    export_csv(&database, &csv, None).unwrap();
    let provenance = database.with_file_name("a.provenance.json");
    let mut entries: serde_json::Value =
        serde_json::from_slice(&std::fs::read(&provenance).unwrap()).unwrap();
    entries.as_object_mut().unwrap().remove("sha256");
    std::fs::write(&provenance, entries.to_string()).unwrap();
    let text = std::fs::read_to_string(&csv).unwrap();
    // A strain that the area of the grains does not have.
    assert!(text.contains(",0.01,"));
    std::fs::write(&csv, text.replacen(",0.01,", ",0.0101,", 1)).unwrap();
    assert!(!check::violations(&inspect::<msdd_rve::database::Record>(&csv).unwrap()).is_empty());
    let error = read_all(&[csv]).unwrap_err().to_string();
    assert!(error.contains("violations of exact laws, the first: "), "{error}");
}
