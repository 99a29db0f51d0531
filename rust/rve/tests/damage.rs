//! Damaged databases and CSVs: a flipped, cut or replaced part is either detected or changes nothing that is read.
//! MSDD_FLIPS sets the number of flips.

use msdd_rve::database::{
    Dataset, PROVENANCE, Plan, Run, check, export_csv, generate, inspect, merge, read, read_all, seal,
};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

const PLAN: &str = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 3\n\
    [[thermal]]\ndiscs = 40\nporosities = [0.14, 0.16]\ncompressions = [\"isotropic\"]\nrepeats = 1\nstops = [0.01]\n";

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("damage-{name}"));
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}

/// Bytes of a small database.
fn database() -> &'static [u8] {
    static MADE: OnceLock<Vec<u8>> = OnceLock::new();
    MADE.get_or_init(|| {
        let file = folder("made").join("a.msdd");
        let plan = Plan::parse(PLAN, "plan").unwrap();
        generate(&plan, &file, &Run::default(), |_| ControlFlow::Continue(())).unwrap();
        std::fs::read(&file).unwrap()
    })
}

/// Bytes of a database whose pages are full of rows.
fn full_database() -> &'static [u8] {
    static MADE: OnceLock<Vec<u8>> = OnceLock::new();
    MADE.get_or_init(|| {
        let file = folder("full").join("a.msdd");
        let text = PLAN.replace("repeats = 1", "repeats = 3").replace("[0.01]", "[0.002, 0.005, 0.01]");
        let plan = Plan::parse(&text, "plan").unwrap();
        generate(&plan, &file, &Run::default(), |_| ControlFlow::Continue(())).unwrap();
        std::fs::read(&file).unwrap()
    })
}

/// Writes that database to a file, and returns the file with the rows and provenance in it.
fn copy(name: &str) -> (PathBuf, Dataset) {
    let file = folder(name).join("a.msdd");
    std::fs::write(&file, database()).unwrap();
    let dataset = read(&file).unwrap();
    (file, dataset)
}

fn execute(file: &Path, statement: &str) {
    rusqlite::Connection::open(file).unwrap().execute_batch(statement).unwrap();
}

fn message(file: &Path) -> String {
    read(file).unwrap_err().to_string()
}

/// SplitMix64 (Steele, Lea, Flood 2014).
fn random(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// Flips single bits of the bytes and writes them to `file`: either all readers detect the flip, or what is read is the
/// same.
fn flips(name: &str, file: &Path, sound: &[u8], dataset: &Dataset) {
    let count = std::env::var("MSDD_FLIPS").ok().and_then(|text| text.parse().ok()).unwrap_or(200);
    let (mut state, mut found, mut same) = (11, 0, 0);
    for _ in 0..count {
        let bit = random(&mut state) as usize % (8 * sound.len());
        let mut bytes = sound.to_vec();
        bytes[bit / 8] ^= 1 << (bit % 8);
        std::fs::write(file, &bytes).unwrap();
        let all = read_all(&[file.to_path_buf()]);
        match read(file) {
            Ok(read) => {
                assert_eq!(&read, dataset, "bit {bit} changes what is read");
                same += 1;
            }
            Err(error) => {
                found += 1;
                assert!(error.to_string().contains("damage-"), "bit {bit}: no file in: {error}");
                assert!(all.is_err(), "bit {bit}: training reads what `read` refuses");
                let looked = inspect(file).is_ok_and(|(dataset, damage)| {
                    damage.is_empty() && check::violations(&dataset).is_empty()
                });
                assert!(!looked, "bit {bit}: a check passes what `read` refuses");
            }
        }
    }
    println!("{name}: {count} flips, {found} found, {same} change nothing that is read");
    assert!(found > count / 3, "{found} of {count}");
}

#[test]
fn every_flipped_bit_of_a_database_is_found_or_changes_nothing() {
    let file = folder("flips").join("a.msdd");
    std::fs::write(&file, full_database()).unwrap();
    let dataset = read(&file).unwrap();
    flips("database", &file, full_database(), &dataset);
}

#[test]
fn every_flipped_bit_of_a_csv_or_its_provenance_is_found_or_changes_nothing() {
    let (database, _) = copy("csv");
    for name in ["a.csv", "b.csv.gz"] {
        let csv = database.with_file_name(name);
        export_csv(&database, &csv, None).unwrap();
        let dataset = read(&csv).unwrap();
        let provenance = database.with_file_name(format!("{}.provenance.json", &name[..1]));
        for file in [&csv, &provenance] {
            let sound = std::fs::read(file).unwrap();
            let read_whole = |bytes: &[u8]| {
                std::fs::write(file, bytes).unwrap();
                read(&csv)
            };
            let (mut state, mut found) = (5, 0);
            for _ in 0..200 {
                let bit = random(&mut state) as usize % (8 * sound.len());
                let mut bytes = sound.clone();
                bytes[bit / 8] ^= 1 << (bit % 8);
                match read_whole(&bytes) {
                    Ok(read) => assert_eq!(read, dataset, "bit {bit} of {}", file.display()),
                    Err(_) => found += 1,
                }
            }
            println!("{}: {found} of 200 found, the others change nothing that is read", file.display());
            assert!(found > 150, "{found} of 200");
            read_whole(&sound).unwrap();
        }
    }
}

/// Text that is not UTF-8, or a value of the wrong kind, gives an error that names table, row and column.
#[test]
fn text_that_is_no_text_is_named_by_table_row_and_column() {
    for (statement, place) in [
        (
            "UPDATE states SET outcome = CAST(x'80ff' AS TEXT) WHERE rowid = 2",
            "states, row 2, column outcome: byte 0",
        ),
        (
            "UPDATE states SET kind = CAST(x'7480' AS TEXT) WHERE rowid = 1",
            "states, row 1, column kind: byte 1",
        ),
        ("UPDATE provenance SET value = CAST(x'80' AS TEXT) WHERE key = 'plan'", "column value: byte 0"),
        (
            "UPDATE columns SET unit = CAST(x'6d80' AS TEXT) WHERE rowid = 3",
            "columns, row 3, column unit: byte 1",
        ),
        (
            "UPDATE states SET porosity = 'much' WHERE rowid = 1",
            "states, row 1, column porosity: 'much', allowed: a",
        ),
        ("UPDATE states SET discs = -1 WHERE rowid = 1", "column discs: -1, allowed: a whole number from 0"),
        (
            "UPDATE states SET ramp = 'sideways' WHERE rowid = 4",
            "row 4, column ramp: unknown variant `sideways`",
        ),
        ("UPDATE states SET strain = 9e999 WHERE rowid = 1", "column strain: inf, allowed: a finite number"),
    ] {
        let (file, _) = copy("text");
        execute(&file, statement);
        let text = message(&file);
        assert!(text.contains("a.msdd: ") && text.contains(place), "{statement}: {text}");
    }
}

/// Runs of random bytes, mostly in the pages of the rows: 480 files, none of which may cause a panic.
#[test]
fn garbage_is_an_error() {
    let file = folder("garbage").join("a.msdd");
    std::fs::write(&file, full_database()).unwrap();
    let dataset = read(&file).unwrap();
    let (mut state, mut refused) = (1, 0);
    for _ in 0..480 {
        let mut bytes = full_database().to_vec();
        let (at, length) = (random(&mut state) as usize % bytes.len(), random(&mut state) as usize % 300);
        let end = (at + length).min(bytes.len());
        let pattern = random(&mut state) as u8 | 0x80;
        bytes[at..end].iter_mut().for_each(|byte| *byte = pattern.max(*byte));
        std::fs::write(&file, &bytes).unwrap();
        match read(&file) {
            Ok(read) => assert_eq!(read, dataset),
            Err(_) => refused += 1,
        }
        let plan = Plan::parse(PLAN, "plan").unwrap();
        let _ = generate(&plan, &file, &Run::default(), |_| ControlFlow::Break(()));
    }
    println!("garbage: {refused} of 480 refused, the others are read as they were");
    assert!(refused > 200);
}

#[test]
fn what_is_no_table_of_ours_is_not_read() {
    let endless = "CREATE VIEW states AS WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) SELECT x AS packing \
                   FROM c;";
    for (statement, problem) in [
        (format!("DROP TABLE states; {endless}"), "view states does not belong to a database"),
        (
            "CREATE TRIGGER t AFTER INSERT ON states BEGIN DELETE FROM states; END".to_string(),
            "trigger t does not belong to a database",
        ),
        (
            "ALTER TABLE states ADD COLUMN more REAL".to_string(),
            "table states does not belong to a database or was",
        ),
        ("DROP TABLE columns".to_string(), "is missing"),
    ] {
        let (file, _) = copy("tables");
        execute(&file, &statement);
        let text = message(&file);
        assert!(text.contains(problem), "{text}");
        let plan = Plan::parse(PLAN, "plan").unwrap();
        let error = generate(&plan, &file, &Run::default(), |_| ControlFlow::Continue(())).unwrap_err();
        assert_eq!(error.to_string(), text);
    }
}

#[test]
fn what_breaks_a_law_is_not_trained_on_and_older_files_can_be_sealed() {
    let (file, dataset) = copy("laws");
    execute(&file, "UPDATE states SET strain = 0.0101 WHERE rowid = 2");
    assert!(message(&file).contains("is damaged: its rows are not what was written"));
    // The same file without checksums, as an older program would have written it.
    execute(&file, "DELETE FROM provenance WHERE key LIKE '%_sha256'");
    assert!(!read(&file).unwrap().has_checksum());
    let error = read_all(std::slice::from_ref(&file)).unwrap_err().to_string();
    assert!(
        error.contains("a.msdd: 1 violations of exact laws, the first: packing 0, ramp up, stop 1: mass"),
        "{error}"
    );
    assert_eq!(seal(&file).unwrap_err().to_string(), error);
    execute(&file, "UPDATE states SET strain = 0.01 WHERE rowid = 2");
    assert_eq!(seal(&file).unwrap(), 6);
    assert_eq!((read(&file).unwrap(), std::fs::read(&file).unwrap().as_slice()), (dataset, database()));
    let csv = file.with_file_name("a.csv");
    // Exports with few digits need a larger tolerance in the laws.
    export_csv(&file, &csv, Some(6)).unwrap();
    let rounded = read(&csv).unwrap();
    assert_eq!(rounded.provenance["digits"], "6");
    let known = |key: &str| PROVENANCE.iter().any(|(name, ..)| *name == key);
    assert_eq!(rounded.provenance.keys().find(|key| !known(key)), None);
    assert_eq!(check::violations(&rounded), []);
    let provenance = file.with_file_name("a.provenance.json");
    let sealed = std::fs::read(&provenance).unwrap();
    let mut older = rounded.provenance.clone();
    older.retain(|key, _| !key.ends_with("_sha256") && key != "digits");
    std::fs::write(&provenance, serde_json::json!(older).to_string()).unwrap();
    assert!(!read(&csv).unwrap().has_checksum());
    seal(&csv).unwrap();
    assert_eq!(std::fs::read(&provenance).unwrap(), sealed);
}

#[test]
fn the_same_packing_does_not_stand_on_both_sides_of_a_split() {
    let (file, _) = copy("twice");
    let csv = file.with_file_name("rounded.csv.gz");
    export_csv(&file, &csv, Some(7)).unwrap();
    let copied = file.with_file_name("b.msdd");
    std::fs::copy(&file, &copied).unwrap();
    for other in [&file, &copied, &csv] {
        let error = read_all(&[file.clone(), other.clone()]).unwrap_err().to_string();
        let named = error.starts_with(&format!("{}: packing 0 is packing 0 of", other.display()));
        assert!(named && error.contains("a.msdd: the same grains"), "{error}");
    }
    // Another seed makes other packings.
    let plan = Plan::parse(&PLAN.replace("seed = 3", "seed = 4"), "plan").unwrap();
    let other = file.with_file_name("other.msdd");
    generate(&plan, &other, &Run::default(), |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(read_all(&[file, other]).unwrap().records.len(), 12);
}

#[test]
fn a_csv_needs_every_column_and_its_order_of_rows_plays_no_part() {
    let (file, dataset) = copy("columns");
    let csv = file.with_file_name("a.csv");
    export_csv(&file, &csv, None).unwrap();
    let text = std::fs::read_to_string(&csv).unwrap();
    let mut lines: Vec<&str> = text.lines().collect();
    lines[1..].reverse();
    lines.swap(2, 4);
    std::fs::write(&csv, lines.join("\n")).unwrap();
    assert_eq!(read(&csv).unwrap(), dataset);
    let refused = |text: &str, problem: &str| {
        std::fs::write(&csv, text).unwrap();
        let found = message(&csv);
        assert!(found.contains("a.csv: ") && found.contains(problem), "{found}");
    };
    let shorter: Vec<&str> = text.lines().map(|line| line.rsplit_once(',').unwrap().0).collect();
    refused(&shorter.join("\n"), "column mean_radius is missing");
    refused(&text.replacen("packing,", "kind,", 1), "column 'kind' is unknown or stands twice");
    refused(&text.replacen("packing,", "packings,", 1), "column 'packings' is unknown");
    refused(&format!("{text}{}\n", lines[1]), "stands twice");
    refused(&text.replacen(",40,", ",forty,", 1), "row 1, column discs: 'forty', allowed: a whole number");
    refused(&text.replacen(",40,", &format!(",{},", "4".repeat(1_000_000)), 1), "characters left out");
    refused(&lines[0].repeat(2000), "a line has more than 1048576 bytes");
    refused("a,b\n1,2\n", "column 'a' is unknown");
}

/// Rows of an older engine may lack a column, once the file has been sealed without it.
#[test]
fn an_older_csv_without_a_column_can_be_sealed() {
    let (file, _) = copy("older");
    let csv = file.with_file_name("a.csv");
    export_csv(&file, &csv, None).unwrap();
    let text = std::fs::read_to_string(&csv).unwrap();
    let place = text.lines().next().unwrap().split(',').position(|name| name == "wall_friction").unwrap();
    let cut = |line: &str| {
        let mut fields: Vec<&str> = line.split(',').collect();
        fields.remove(place);
        fields.join(",")
    };
    std::fs::write(&csv, text.lines().map(cut).collect::<Vec<_>>().join("\n")).unwrap();
    let provenance = file.with_file_name("a.provenance.json");
    let text = std::fs::read_to_string(&provenance).unwrap();
    assert!(seal(&csv).unwrap_err().to_string().contains("column wall_friction is missing"));
    let mut older: std::collections::BTreeMap<String, String> = serde_json::from_str(&text).unwrap();
    older.retain(|key, _| !key.ends_with("_sha256"));
    std::fs::write(&provenance, serde_json::json!(older).to_string()).unwrap();
    assert!(seal(&csv).unwrap_err().to_string().contains("column wall_friction is missing"));
    older.insert("engine_version".to_string(), "3".to_string());
    std::fs::write(&provenance, serde_json::json!(older).to_string()).unwrap();
    assert!(message(&csv).contains("column wall_friction is missing"));
    assert_eq!(seal(&csv).unwrap(), 6);
    assert!(read(&csv).unwrap().records.iter().all(|record| record.wall_friction.is_none()));
}

/// The columns that files of schema 2 do not have.
const LATER: [&str; 7] = ["from_stop", "step_thermal", "step_xx", "step_yy", "step_xy", "probe", "fabric_xy"];

/// A database as the program before those columns wrote it: its rows have the same checksum without them.
fn of_schema_two(file: &Path) {
    for column in LATER {
        execute(file, &format!("ALTER TABLE states DROP COLUMN {column}"));
        execute(file, &format!("DELETE FROM columns WHERE name = '{column}'"));
    }
    execute(file, "UPDATE provenance SET value = '2' WHERE key = 'schema'");
    execute(file, "DELETE FROM provenance WHERE key LIKE '%_sha256'");
}

#[test]
fn databases_from_before_paths_are_read_merged_exported_and_sealed() {
    let (file, now) = copy("schema");
    of_schema_two(&file);
    let mut expected = now.records;
    expected.iter_mut().for_each(|record| record.fabric_xy = None);
    assert_eq!(read(&file).unwrap().records, expected);
    // It is not continued: further rows would have columns that the first have not.
    let plan = Plan::parse(PLAN, "plan").unwrap();
    let error = generate(&plan, &file, &Run::default(), |_| ControlFlow::Continue(())).unwrap_err();
    assert!(error.to_string().contains("was made with schema = 2, now it is 3"), "{error}");
    let merged = file.with_file_name("merged.msdd");
    assert_eq!(merge(std::slice::from_ref(&file), &merged).unwrap(), 6);
    let merged = read(&merged).unwrap();
    assert_eq!((merged.records, merged.provenance["schema"].as_str()), (expected.clone(), "3"));
    let csv = file.with_file_name("a.csv");
    export_csv(&file, &csv, None).unwrap();
    assert_eq!(read(&csv).unwrap().records, expected);
    assert_eq!(seal(&file).unwrap(), 6);
    assert_eq!(read(&file).unwrap().records, expected);
    // Both schemas at once, or a schema that the tables do not have, are none.
    let (file, _) = copy("schema-mixed");
    execute(&file, "ALTER TABLE states DROP COLUMN fabric_xy");
    assert!(message(&file).contains("table states does not belong to a database or was changed"));
    let (file, _) = copy("schema-number");
    execute(&file, "UPDATE provenance SET value = '2' WHERE key = 'schema'");
    assert!(message(&file).contains("was made with schema = 2, now it is 3"));
}

/// A CSV that was sealed before the later columns existed still agrees with its checksum; one that was sealed with them
/// does not when they are taken away.
#[test]
fn the_checksum_of_a_csv_from_before_paths_still_agrees() {
    let (file, _) = copy("schema-csv");
    let older = file.with_file_name("older.msdd");
    std::fs::copy(&file, &older).unwrap();
    of_schema_two(&older);
    for (database, agrees) in [(&older, true), (&file, false)] {
        let csv = file.with_file_name("a.csv");
        export_csv(database, &csv, Some(9)).unwrap();
        let whole = read(&csv).unwrap();
        let text = std::fs::read_to_string(&csv).unwrap();
        let head: Vec<&str> = text.lines().next().unwrap().split(',').collect();
        let cut = |line: &str| {
            let fields = line.split(',').zip(&head).filter(|(_, name)| !LATER.contains(name));
            fields.map(|(field, _)| field).collect::<Vec<_>>().join(",")
        };
        std::fs::write(&csv, text.lines().map(cut).collect::<Vec<_>>().join("\n")).unwrap();
        match agrees {
            true => assert_eq!(read(&csv).unwrap(), whole),
            false => assert!(message(&csv).contains("its rows are not what was written")),
        }
    }
}

/// The one of boxes between walls is older than the columns of paths.
#[test]
fn the_committed_databases_are_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/database");
    for (name, rows, older) in [("full", 19488, true), ("periodic", 20354, false)] {
        let dataset = read(&folder.join(format!("{name}.csv.gz"))).unwrap();
        assert!(dataset.has_checksum());
        assert_eq!(dataset.records.len(), rows);
        assert!(dataset.records.iter().all(|r| r.increment().is_none()));
        assert_eq!(dataset.records.iter().all(|r| r.fabric_xy.is_none()), older);
    }
}

#[test]
fn names_are_names_of_files() {
    let folder = folder("names");
    for name in ["file:x?mode=memory", ":memory:", "with blank.msdd"] {
        let file = folder.join(name);
        std::fs::write(&file, database()).unwrap();
        assert_eq!(read(&file).unwrap().records.len(), 6);
    }
    let plan = Plan::parse(PLAN, "plan").unwrap();
    for (name, kind) in [("/dev/null", "a device"), ("/", "no name of a file")] {
        let error =
            generate(&plan, Path::new(name), &Run::default(), |_| ControlFlow::Continue(())).unwrap_err();
        assert!(error.to_string().contains(kind), "{error}");
    }
    let link = folder.join("link.msdd");
    std::os::unix::fs::symlink("absent", &link).unwrap();
    let error = generate(&plan, &link, &Run::default(), |_| ControlFlow::Continue(())).unwrap_err();
    assert!(error.to_string().contains("symbolic link to absent"), "{error}");
    let error = merge(&[folder.join(":memory:")], &link).unwrap_err();
    assert!(error.to_string().contains("symbolic link to absent"), "{error}");
    assert!(message(Path::new("/dev/zero")).contains("no regular file"));
}

#[test]
fn a_second_generator_ends_before_it_makes_anything() {
    let file = folder("generators").join("a.msdd");
    let plan = Plan::parse(PLAN, "plan").unwrap();
    let mut seen = Vec::new();
    generate(&plan, &file, &Run::default(), |first| {
        let second = generate(&plan, &file, &Run::default(), |_| unreachable!("it has begun"));
        seen.push((first.done, second.unwrap_err().to_string()));
        ControlFlow::Continue(())
    })
    .unwrap();
    assert_eq!(seen.len(), 3);
    let holder = format!("process {}", std::process::id());
    assert!(seen.iter().all(|(_, error)| error.contains("a.msdd") && error.contains(&holder)), "{seen:?}");
    assert_eq!(std::fs::read(&file).unwrap(), database());
    assert_eq!(std::fs::read_dir(file.parent().unwrap()).unwrap().count(), 1, "nothing is left beside it");
}

/// A small compressed file that unpacks to a huge one.
#[test]
fn a_bomb_is_refused() {
    use std::io::Write;
    let (file, _) = copy("bomb");
    let csv = file.with_file_name("a.csv.gz");
    export_csv(&file, &csv, None).unwrap();
    for line in ["0\n", "0"] {
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        let block = line.repeat(1 << 20);
        (0..16).for_each(|_| encoder.write_all(block.as_bytes()).unwrap());
        std::fs::write(&csv, encoder.finish().unwrap()).unwrap();
        let text = message(&csv);
        assert!(text.contains("a.csv.gz: "), "{text}");
    }
}
