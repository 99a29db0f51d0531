//! Generation, storage, resume and export of small databases.

use msdd_rve::database::{DatabaseError, Plan, export_csv, generate, read};
use std::path::{Path, PathBuf};

const PLAN: &str = "discs = 60\nradius_min = 3e-3\nradius_max = 7e-3\nseed = 3\nporosities = [0.14, 0.16]\n\
                    compressions = [\"isotropic\", \"horizontal\"]\nrepeats = 1\nstrains = [0.01, 0.02, -0.01]\n";

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}

fn make(plan: &Plan, path: &Path, threads: usize) {
    generate(plan, path, threads, |_| ()).unwrap();
}

#[test]
fn rows_do_not_depend_on_threads_and_csv_reads_back() {
    let folder = folder("threads");
    let plan = Plan::parse(PLAN, "plan").unwrap();
    let csv = |threads: usize| {
        let database = folder.join(format!("{threads}.msdd"));
        let csv = folder.join(format!("{threads}.csv"));
        make(&plan, &database, threads);
        assert_eq!(export_csv(&database, &csv).unwrap(), 16);
        assert_eq!(read(&database).unwrap(), read(&csv).unwrap());
        std::fs::read(csv).unwrap()
    };
    assert_eq!(csv(1), csv(3));
    let records = read(&folder.join("1.csv")).unwrap().records;
    assert!(records.iter().all(|r| r.outcome == "settled" && r.porosity.is_some()));
    let strains: Vec<f64> = records[..4].iter().map(|r| r.strain).collect();
    assert_eq!(strains, [0.0, 0.01, 0.02, -0.01]);
    assert_eq!(records[1].initial_porosity, records[0].porosity);
}

#[test]
fn a_stopped_run_resumes_and_another_plan_is_refused() {
    let folder = folder("resume");
    let (whole, halved) = (folder.join("whole.msdd"), folder.join("halved.msdd"));
    let plan = Plan::parse(PLAN, "plan").unwrap();
    make(&plan, &whole, 2);
    make(&plan, &halved, 2);
    let connection = rusqlite::Connection::open(&halved).unwrap();
    connection.execute("DELETE FROM states WHERE packing >= 2", []).unwrap();
    drop(connection);
    let mut seen = Vec::new();
    generate(&plan, &halved, 2, |progress| seen.push(progress.done)).unwrap();
    assert_eq!(seen, [2, 3, 4]);
    assert_eq!(read(&whole).unwrap(), read(&halved).unwrap());

    let other = Plan::parse(&PLAN.replace("seed = 3", "seed = 4"), "plan").unwrap();
    let error = generate(&other, &whole, 1, |_| ()).unwrap_err();
    assert!(matches!(&error, DatabaseError::Mismatch { key: "plan_hash", .. }), "{error}");
}

#[test]
fn a_failed_packing_is_a_row() {
    let folder = folder("failed");
    // To fill 99 % of the box, the discs of a small one have to overlap beyond all sense.
    let text = PLAN.replace("[0.14, 0.16]", "[0.01]").replace("discs = 60", "discs = 10");
    let database = folder.join("failed.msdd");
    make(&Plan::parse(&text, "plan").unwrap(), &database, 1);
    let records = read(&database).unwrap().records;
    assert_eq!(records.iter().map(|r| r.packing).max(), Some(1));
    let failed: Vec<_> = records.iter().filter(|r| r.outcome.starts_with("failed: t = ")).collect();
    assert!(!failed.is_empty());
    assert!(failed.iter().all(|r| r.outcome.contains("overlap") && r.porosity.is_none()), "{failed:?}");
}

#[test]
fn what_is_no_database_is_refused_with_its_name() {
    let path = folder("wrong").join("wrong.csv");
    std::fs::write(&path, "a,b\n1,2\n").unwrap();
    assert!(read(&path).unwrap_err().to_string().contains("wrong.csv"));
}
