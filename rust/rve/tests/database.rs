//! Generation, storage, continuation, shards and export of small databases.

use msdd_rve::database::{
    DatabaseError, Kind, Plan, RampName, Recipe, Run, check, export_csv, generate, inspect, read,
    record::COLUMNS, table::Row,
};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

const PLAN: &str = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 3\n\
    [[thermal]]\ndiscs = 60\nporosities = [0.14, 0.16]\ncompressions = [\"isotropic\", \"intermediate\"]\n\
    packing_friction_angles = [0.3]\nrepeats = 1\nramps = [\"up\", \"down\", \"up_down\"]\nstops = [0.01, 0.02]\n\
    [[mechanics]]\ndiscs = 60\nporosities = [0.13]\ncompressions = [\"isotropic\"]\nrepeats = 1\nstops = [0.01]\n\
    [[wall_shear]]\ndiscs = 60\nporosities = [0.13]\ncompressions = [\"isotropic\"]\nrepeats = 1\nstops = [0.002]\n\
    [[paths]]\ndiscs = 40\nporosities = [0.12]\ncompressions = [\"isotropic\"]\nrepeats = 1\n\
    paths = [\"biaxial\", \"equivalence\"]\nstep = 2e-3\nprobes = [1e-3]\nprobe_every = 30\n";
/// The path has 55 increments, and six probes at the packed state and after the 30th.
const PATH_ROWS: usize = 1 + 55 + 12 + 12;
const ROWS: usize = 4 * 7 + 5 + 2 + PATH_ROWS;

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}

fn plan() -> Plan {
    Plan::parse(PLAN, "plan").unwrap()
}

fn make(plan: &Plan, path: &Path, threads: usize) {
    generate(plan, path, &Run { threads, ..Run::default() }, |_| ControlFlow::Continue(())).unwrap();
}

/// Names and contents of the files of a database, or of one file.
fn bytes(path: &Path) -> Vec<(String, Vec<u8>)> {
    let files = if path.is_dir() { msdd_files::list(path).unwrap() } else { vec![path.to_path_buf()] };
    let name = |file: &PathBuf| file.file_name().unwrap().to_string_lossy().into_owned();
    files.iter().map(|file| (name(file), std::fs::read(file).unwrap())).collect()
}

#[test]
fn rows_do_not_depend_on_threads_and_csv_reads_back() {
    let folder = folder("threads");
    let csv = |threads: usize, name: &str| {
        let database = folder.join(format!("{threads}.msdd"));
        let csv = folder.join(format!("{threads}.{name}"));
        make(&plan(), &database, threads);
        assert_eq!(export_csv(&database, &csv, None).unwrap(), ROWS);
        assert!(read(&database).unwrap().records == read(&csv).unwrap().records);
        std::fs::read(&csv).unwrap()
    };
    assert_eq!(csv(1, "csv"), csv(3, "csv"));
    assert!(csv(1, "csv.gz").len() * 2 < csv(1, "csv").len());
    assert!(folder.join("1.columns.csv").exists() && folder.join("1.provenance.json").exists());
    let records = read(&folder.join("1.csv")).unwrap().records;
    let strains: Vec<f64> = records[..7].iter().map(|r| r.strain).collect();
    assert_eq!(strains, [0.0, 0.01, 0.02, -0.01, -0.02, 0.01, 0.0]);
    assert_eq!((records[6].ramp, records[6].stop), (RampName::UpDown, 2));
    assert_eq!(records[1].initial_porosity, records[0].porosity);
    assert!(records.iter().all(|r| r.failure.is_none() && r.porosity.is_some() && r.fabric_xy.is_some()));
    // Because of friction the way back passes through other states, but not very different ones.
    let (there, back) = (records[1].pressure.unwrap(), records[5].pressure.unwrap());
    assert!(there != back && (back / there - 1.0).abs() < 0.3, "{there} {back}");
}

#[test]
fn rounded_exports_keep_whole_numbers_and_nine_digits() {
    let folder = folder("rounded");
    let (database, csv) = (folder.join("a.msdd"), folder.join("a.csv.gz"));
    make(&plan(), &database, 2);
    export_csv(&database, &csv, Some(9)).unwrap();
    for (exact, rounded) in read(&database).unwrap().records.iter().zip(read(&csv).unwrap().records) {
        assert_eq!(
            (exact.seed, exact.steps, exact.rattlers),
            (rounded.seed, rounded.steps, rounded.rattlers)
        );
        let (a, b) = (exact.pressure.unwrap(), rounded.pressure.unwrap());
        assert!((a / b - 1.0).abs() < 5.1e-9 && format!("{b:e}").len() <= 14, "{a} {b}");
    }
}

#[test]
fn walls_move_and_slip_as_planned() {
    let database = folder("walls").join("a.msdd");
    make(&plan(), &database, 2);
    let records = read(&database).unwrap().records;
    let of = |kind: Kind| records.iter().filter(move |r| r.kind == kind);
    let mechanics: Vec<_> = of(Kind::Mechanics).collect();
    let places: Vec<_> = mechanics.iter().map(|r| (r.ramp, r.stop, r.strain_xx, r.strain_yy)).collect();
    let expected = [
        (RampName::Packed, 0, 0.0, 0.0),
        (RampName::Xx, -1, -0.01, 0.0),
        (RampName::Xx, 1, 0.01, 0.0),
        (RampName::Yy, -1, 0.0, -0.01),
        (RampName::Yy, 1, 0.0, 0.01),
    ];
    assert_eq!(places, expected);
    let [packed, closed, opened] = [0, 1, 2].map(|k| mechanics[k].stress_xx.unwrap());
    assert!(closed > packed && packed > opened, "{closed} {packed} {opened}");
    let shear: Vec<_> = of(Kind::WallShear).collect();
    assert_eq!(shear[1].wall_slip, 0.002);
    let friction = shear[1].wall_friction.unwrap();
    assert!(friction > 0.0 && friction < 0.5f64.tan(), "{friction}");
    assert!(shear[0].wall_friction.unwrap().abs() < friction, "{shear:?}");
    assert!(mechanics.iter().all(|r| r.wall_friction.is_none()));
}

#[test]
fn a_stopped_run_resumes_to_the_same_bytes_and_another_plan_is_refused() {
    let folder = folder("resume");
    let (whole, halved) = (folder.join("whole.msdd"), folder.join("halved.msdd"));
    make(&plan(), &whole, 2);
    let run = Run { threads: 2, ..Run::default() };
    // What a killed run leaves: some packings.
    let third = |done: usize| if done < 3 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
    generate(&plan(), &halved, &run, |progress| third(progress.done)).unwrap();
    let unfinished = read(&halved).unwrap_err().to_string();
    assert!(unfinished.contains("4 of 7 packings are missing: "), "{unfinished}");
    assert!(inspect::<msdd_rve::database::Record>(&halved).unwrap().records.len() < ROWS);
    let mut seen = Vec::new();
    generate(&plan(), &halved, &run, |progress| {
        seen.push(progress.done);
        ControlFlow::Continue(())
    })
    .unwrap();
    assert_eq!(seen, [3, 4, 5, 6, 7]);
    assert_eq!(bytes(&whole), bytes(&halved));
    make(&plan(), &halved, 1);
    assert_eq!(bytes(&whole), bytes(&halved));

    let other = Plan::parse(&PLAN.replace("seed = 3", "seed = 4"), "plan").unwrap();
    let error = generate(&other, &whole, &run, |_| ControlFlow::Continue(())).unwrap_err();
    assert!(matches!(&error, DatabaseError::Mismatch { key: "plan_hash", .. }), "{error}");
}

#[test]
fn shards_in_one_folder_make_the_files_of_one_process() {
    let folder = folder("shards");
    let (whole, parts) = (folder.join("whole"), folder.join("parts"));
    make(&plan(), &whole, 2);
    std::thread::scope(|scope| {
        for shard in ["1/3", "2/3", "3/3"] {
            let run = Run { shard: shard.parse().unwrap(), threads: 1, ..Run::default() };
            let parts = &parts;
            scope.spawn(move || generate(&plan(), parts, &run, |_| ControlFlow::Continue(())).unwrap());
        }
    });
    assert_eq!(bytes(&whole), bytes(&parts));
    // What is missing is made again, whatever the parts.
    std::fs::remove_file(parts.join("packing-000005.csv.gz")).unwrap();
    make(&plan(), &parts, 1);
    assert_eq!(bytes(&whole), bytes(&parts));
    // A packing under the name of another one.
    std::fs::rename(parts.join("packing-000005.csv.gz"), parts.join("packing-000006.csv.gz")).unwrap();
    let error = read(&parts).unwrap_err().to_string();
    assert!(
        error.contains("packing-000006.csv.gz: not an msdd database (it has a row of packing 5"),
        "{error}"
    );
}

/// The rows of a path by what stands in them; a row further on starts from the last that is no probe.
#[test]
fn paths_go_on_from_row_to_row_and_probes_leave_them_alone() {
    let database = folder("paths").join("a.msdd");
    make(&plan(), &database, 2);
    let records = read(&database).unwrap().records;
    let of = |ramp: RampName| {
        records.iter().filter(move |r| r.kind == Kind::Paths && r.ramp == ramp).collect::<Vec<_>>()
    };
    let packed = of(RampName::Packed);
    assert_eq!((packed.len(), packed[0].from_stop, packed[0].probe), (1, None, None));
    assert!(records.iter().all(|r| (r.ramp.is_path()) == r.step_xx.is_some()));
    let path = of(RampName::Biaxial);
    assert!(path.iter().zip(1..).all(|(row, stop)| row.stop == stop) && path.len() == 67);
    assert!(path.iter().all(|row| row.region == "cell" && row.outcome == "settled"), "{path:?}");
    let mut here = 0;
    for row in &path {
        assert_eq!(row.from_stop, Some(here), "{}", row.name());
        here = if row.probe == Some(0) { row.stop } else { here };
    }
    // Two probes of opposite sense stand about the state that they start from.
    let pressure = |stop: usize| path[stop - 1].pressure.unwrap();
    let (open, closed) = (pressure(1), pressure(4));
    assert!(open < packed[0].pressure.unwrap() && packed[0].pressure.unwrap() < closed, "{open} {closed}");
    let equivalence = of(RampName::Equivalence);
    assert!(equivalence.len() == 12 && equivalence.iter().all(|row| row.from_stop == Some(0)));
}

/// The same path without probes has the same states: what is tried on a copy leaves no trace.
#[test]
fn probes_change_nothing_on_the_path() {
    let folder = folder("probes");
    let states = |text: &str, name: &str| {
        let database = folder.join(name);
        make(&Plan::parse(text, "plan").unwrap(), &database, 2);
        let mut records = read(&database).unwrap().records;
        records.retain(|r| r.ramp == RampName::Biaxial && r.probe == Some(0));
        records.iter().map(|r| (r.porosity, r.stress_xy, r.fabric_xy, r.steps)).collect::<Vec<_>>()
    };
    let without = PLAN.replace("probes = [1e-3]", "probes = []");
    let with = states(PLAN, "with.msdd");
    assert_eq!(with.len(), 55);
    assert_eq!(with, states(&without, "without.msdd"));
}

/// A loose box that opens carries no load in the end: the path ends there, and the rows after it say so.
#[test]
fn a_path_ends_where_the_box_bears_no_load() {
    let text = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 3\n\
        [[paths]]\ndiscs = 60\nporosities = [0.17]\ncompressions = [\"isotropic\"]\nrepeats = 4\n\
        paths = [\"isotropic\", \"thermal\"]\nstep = 1e-2\n";
    let folder = folder("ended");
    let (database, csv) = (folder.join("a.msdd"), folder.join("a.csv"));
    make(&Plan::parse(text, "plan").unwrap(), &database, 2);
    export_csv(&database, &csv, Some(7)).unwrap();
    let dataset = read(&csv).unwrap();
    assert_eq!(check::violations(&dataset), []);
    let mut ended = 0;
    for path in dataset.records.chunk_by(|a, b| (a.packing, a.ramp) == (b.packing, b.ramp)) {
        let Some(end) = path.iter().position(|row| row.outcome == "unjammed") else { continue };
        ended += 1;
        let reason = format!("the path ended at stop {}, without load", path[end].stop);
        assert!(path[end].porosity.is_some() && path[end].failure.is_none());
        for row in &path[end + 1..] {
            assert_eq!((row.outcome.as_str(), row.failure.as_ref()), ("failed", Some(&reason)));
            assert!(row.porosity.is_none() && row.step_thermal.is_some());
        }
    }
    assert!(ended > 2, "{ended} paths have ended");
}

#[test]
fn failures_are_rows() {
    let folder = folder("failed");
    // To fill 99 % of a small box, and then to expand by 10 %, discs must overlap more than any run allows.
    let text = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 3\n\
        [[thermal]]\ndiscs = 20\nporosities = [0.01]\ncompressions = [\"isotropic\", \"horizontal\"]\nrepeats = 4\n\
        ramps = [\"up\", \"up_down\"]\nstops = [0.01, 0.2]\n";
    let database = folder.join("failed.msdd");
    make(&Plan::parse(text, "plan").unwrap(), &database, 2);
    let records = read(&database).unwrap().records;
    assert_eq!(records.len(), 8 * 5);
    let failed: Vec<_> = records.iter().filter(|r| r.outcome == "failed").collect();
    let sound = |reason: &Option<String>| reason.as_ref().is_some_and(|text| text.contains("overlap"));
    assert!(failed.iter().all(|r| sound(&r.failure) && r.porosity.is_none()), "{failed:?}");
    // The way back (`up_down`) cannot be made when the ramp `up` has failed.
    let back = failed.iter().find(|r| r.ramp == RampName::UpDown).expect("some ramp has failed");
    assert!(
        records.iter().any(|r| r.packing == back.packing && r.ramp == RampName::Up && r.failure.is_some())
    );
}

#[test]
fn every_column_has_unit_and_meaning() {
    assert!(
        COLUMNS
            .iter()
            .all(|c| !c.2.is_empty() && c.3.len() > 5 && ["INTEGER", "REAL", "TEXT"].contains(&c.1))
    );
}

#[test]
fn what_is_no_database_is_refused_with_its_name() {
    let path = folder("wrong").join("wrong.csv");
    std::fs::write(&path, "a,b\n1,2\n").unwrap();
    assert!(read(&path).unwrap_err().to_string().contains("wrong.csv"));
    // A folder of other things is neither read nor written to; nor is a database of version 0.2, one SQLite file.
    let other = path.parent().unwrap();
    assert!(read(other).unwrap_err().to_string().contains("there is no provenance.json in it"));
    let error = generate(&plan(), other, &Run::default(), |_| ControlFlow::Continue(())).unwrap_err();
    assert!(error.to_string().contains("it has files, but no provenance.json"), "{error}");
    assert_eq!(msdd_files::list(other).unwrap().len(), 1);
    let old = other.join("old.msdd");
    std::fs::write(&old, b"SQLite format 3\0 and more").unwrap();
    let error = read(&old).unwrap_err().to_string();
    assert!(error.contains("an SQLite file of version 0.2; export it as CSV by that version"), "{error}");
    let error =
        generate(&plan(), &old, &Run::default(), |_| ControlFlow::Continue(())).unwrap_err().to_string();
    assert!(error.contains("an SQLite file of version 0.2"), "{error}");
}
