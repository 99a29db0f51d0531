//! Generation, continuation, shards and export of small databases of spheres; packings against what is known of them.

use msdd_rve::database::{
    DatabaseError, Grains, PathName, Plan, Recipe, Run, Shard, SpherePlan, SphereRecord, export_csv,
    generate, grains, read, read_spheres,
};
use msdd_rve::spheres::{Averages, Preparation, Strain, advance, averages, prepare};
use msdd_spheres::Simulation;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

const PLAN: &str = "seed = 3\n[[spheres]]\nspheres = 60\npacking_frictions = [0.3, 0.0]\n\
    compressions = [\"isotropic\", \"sheared\"]\npressures = [1e-5, 1e-3]\nrepeats = 1\n\
    paths = [\"thermal\", \"mixed\"]\nstrain = 4e-3\nstep = 2e-3\n";

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}

fn plan() -> SpherePlan {
    SpherePlan::parse(PLAN, "plan").unwrap()
}

fn make(path: &Path, threads: usize, shard: &str) {
    let run = Run { threads, shard: shard.parse::<Shard>().unwrap(), ..Run::default() };
    generate(&plan(), path, &run, |_| ControlFlow::Continue(())).unwrap();
}

/// Contents of the files of a database.
fn bytes(path: &Path) -> Vec<Vec<u8>> {
    msdd_files::list(path).unwrap().iter().map(|file| std::fs::read(file).unwrap()).collect()
}

#[test]
fn rows_do_not_depend_on_threads_interruptions_and_shards() {
    let folder = folder("spheres");
    let file = |name: &str| folder.join(name);
    make(&file("one"), 1, "1/1");
    make(&file("three"), 3, "1/1");
    assert_eq!(bytes(&file("one")), bytes(&file("three")));
    // What a killed run leaves: some packings.
    let third = |done: usize| if done < 3 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
    let run = Run { threads: 1, ..Run::default() };
    generate(&plan(), &file("killed"), &run, |progress| third(progress.done)).unwrap();
    assert_ne!(bytes(&file("one")), bytes(&file("killed")));
    make(&file("killed"), 1, "1/1");
    assert_eq!(bytes(&file("one")), bytes(&file("killed")));
    for shard in ["1/3", "2/3"] {
        make(&file("parts"), 1, shard);
    }
    let missing = read_spheres(&file("parts")).unwrap_err().to_string();
    assert!(missing.contains("2 of 8 packings are missing"), "{missing}");
    make(&file("parts"), 1, "3/3");
    assert_eq!(bytes(&file("one")), bytes(&file("parts")));
    assert_eq!(read_spheres(&file("parts")).unwrap().records.len(), plan().rows());
}

#[test]
fn a_csv_reads_back_and_readers_of_discs_refuse_it() {
    let folder = folder("spheres-csv");
    let (database, csv) = (folder.join("a.msdd"), folder.join("a.csv.gz"));
    make(&database, 2, "1/1");
    assert_eq!(export_csv(&database, &csv, None).unwrap(), plan().rows());
    assert!(read_spheres(&database).unwrap().records == read_spheres(&csv).unwrap().records);
    for path in [&database, &csv] {
        assert_eq!(grains(path).unwrap(), Grains::Spheres);
        let error = read(path).unwrap_err().to_string();
        assert!(error.ends_with("holds rows of spheres, allowed: rows of discs"), "{error}");
    }
    let records = read_spheres(&csv).unwrap().records;
    assert_eq!(records.iter().filter(|r| r.path == PathName::Packed).count(), 8);
    // A database of spheres is not continued by a plan of discs.
    let discs = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 3\n[[thermal]]\ndiscs = 40\nporosities = [0.14]\n\
        compressions = [\"isotropic\"]\nrepeats = 1\nstops = [0.01]\n";
    let discs = Plan::parse(discs, "plan").unwrap();
    let error = generate(&discs, &database, &Run::default(), |_| ControlFlow::Continue(())).unwrap_err();
    assert!(matches!(error, DatabaseError::Mismatch { key: "schema", .. }), "{error}");
}

/// Boxes that were packed without friction and shaken are dense, but every contact was made under friction: there are few, many are
/// about to slide, and the boxes are softer than before.
#[test]
fn shaken_boxes_are_dense_and_soft() {
    let preparation = |shaking: f64| Preparation {
        spheres: 300,
        sizes: None,
        seed: 12,
        poisson_ratio: 0.25,
        restitution: 0.3,
        packing_friction: 0.0,
        friction: 0.3,
        rates: [1.0; 3],
        shaking,
        pressure: 1e-6,
    };
    let [plain, shaken] = [0.0, 0.005].map(|shaking| prepare(&preparation(shaking)).unwrap().simulation);
    let pressed = |simulation: &Simulation| {
        let before = averages(simulation).unwrap();
        let mut simulation = simulation.clone();
        advance(&mut simulation, Strain::single(2, -1e-4)).unwrap();
        (before, averages(&simulation).unwrap())
    };
    let ((plain, stiff), (shaken, soft)) = (pressed(&plain), pressed(&shaken));
    assert!((shaken.pressure() / 1e-6 - 1.0).abs() < 0.05, "{shaken:?}");
    assert!(shaken.solid_fraction > 0.61 && plain.solid_fraction > 0.62, "{plain:?} {shaken:?}");
    assert!(plain.coordination > 5.5 && shaken.coordination < 4.6, "{plain:?} {shaken:?}");
    let grown = |before: &Averages, after: &Averages| after.pressure() - before.pressure();
    assert!(grown(&shaken, &soft) < 0.7 * grown(&plain, &stiff), "{soft:?} {stiff:?}");
    // The same seed packs the same box.
    let again = prepare(&preparation(0.005)).unwrap().simulation;
    assert_eq!(averages(&again), Some(shaken));
}

/// What 1000 spheres of friction 0.3 are like at p/E* = 1e-5 (a trial with LAMMPS: φ 0.588 ± 0.01, z 4.56, C 0.926 for E* of ν = 0.3,
/// κ_g 14.2 at ℓ = 8.5), and that (p/E*)^(2/3) grows in proportion to ln φ: there with the slope 0.122 to 0.168 for p/E, which is 0.18 to
/// 0.25 for p/E*. Here of 300 spheres.
#[test]
fn packings_are_like_those_of_others() {
    let preparation = Preparation {
        spheres: 300,
        sizes: None,
        seed: 11,
        poisson_ratio: 0.25,
        restitution: 0.3,
        packing_friction: 0.3,
        friction: 0.3,
        rates: [1.0; 3],
        shaking: 0.0,
        pressure: 1e-5,
    };
    let mut simulation = prepare(&preparation).unwrap().simulation;
    let packed = averages(&simulation).unwrap();
    assert!((packed.solid_fraction - 0.583).abs() < 0.012, "{packed:?}");
    assert!((packed.coordination - 4.5).abs() < 0.3, "{packed:?}");
    let [x, y, z, ..] = packed.contact_conductivity;
    let factor = (x + y + z) / 3.0 / packed.pressure().cbrt();
    assert!((factor - 0.92).abs() < 0.08, "{factor}");
    assert!((packed.gas_conductivity[2] / 14.0 - 1.0).abs() < 0.08, "{packed:?}");
    let mut powers = vec![packed.pressure().powf(2.0 / 3.0)];
    for _ in 0..3 {
        advance(&mut simulation, Strain::thermal(2e-3)).unwrap();
        powers.push(averages(&simulation).unwrap().pressure().powf(2.0 / 3.0));
    }
    for pair in powers.windows(2) {
        let slope = (pair[1] - pair[0]) / (3.0 * 2e-3);
        assert!(slope > 0.17 && slope < 0.26, "{slope}");
    }
}

/// A loose box that is sheared in a fixed volume loses its load, and the rest of the path says so.
#[test]
fn a_path_ends_where_the_box_bears_no_load() {
    let database = folder("spheres-end").join("a.msdd");
    let plan = "seed = 1\n[[spheres]]\nspheres = 60\ncompressions = [\"isotropic\"]\npressures = [1e-6]\nrepeats = 2\n\
        paths = [\"shear\"]\nstrain = 0.05\nstep = 1e-2\n";
    let plan = SpherePlan::parse(plan, "plan").unwrap();
    generate(&plan, &database, &Run::default(), |_| ControlFlow::Continue(())).unwrap();
    let records = read_spheres(&database).unwrap().records;
    assert_eq!(records.len(), plan.rows());
    let end = records.iter().position(|record| record.outcome == "unjammed").unwrap();
    let (packing, stop) = (records[end].packing, records[end].stop);
    assert!(records[end].pressure.unwrap() < 1e-10);
    let after: Vec<_> = records.iter().filter(|r| r.packing == packing && r.stop > stop).collect();
    assert!(!after.is_empty());
    for record in after {
        let expected = format!("the path ended at stop {stop}, without load");
        assert_eq!(record.failure.as_deref(), Some(expected.as_str()));
        assert!(record.outcome == "failed" && record.pressure.is_none());
    }
}

/// A box that is closed along two axes and opened again keeps its stress along the third, and yields for that; the rows say by how
/// much, and their strains add up.
#[test]
fn a_pressed_box_keeps_its_stress_along_one_axis() {
    let plan = "seed = 3\n[[spheres]]\nspheres = 400\nshaking = 0.005\ncompressions = [\"isotropic\"]\npressures = [1e-4]\n\
        repeats = 1\npaths = [\"pressed\"]\nstrain = 4e-3\nstep = 5e-4\ncycles = 2\n";
    let path = folder("spheres-pressed").join("a.msdd");
    let plan = SpherePlan::parse(plan, "plan").unwrap();
    generate(&plan, &path, &Run::default(), |_| ControlFlow::Continue(())).unwrap();
    let records = read_spheres(&path).unwrap().records;
    let (packed, rows) = records.split_first().unwrap();
    let stress = |r: &SphereRecord| [r.stress_xx, r.stress_yy, r.stress_zz].map(|part| part.unwrap());
    let strain = |r: &SphereRecord| [r.strain_xx, r.strain_yy, r.strain_zz];
    let end = strain(&rows[rows.len() - 1]);
    let free_axis = (0..3).find(|axis| (end[*axis] + 2.4e-3).abs() > 1e-12).unwrap();
    let held = rows.iter().map(|row| stress(row)[free_axis] / stress(packed)[free_axis]);
    let off = (held.map(|ratio| (ratio - 1.0).powi(2)).sum::<f64>() / rows.len() as f64).sqrt();
    assert!(off < 0.1, "{off}");
    let largest =
        |of: fn(f64, f64) -> f64, part: &dyn Fn(&SphereRecord) -> f64| rows.iter().map(part).fold(0.0, of);
    let across = |r: &SphereRecord| stress(r)[(free_axis + 1) % 3] / stress(packed)[(free_axis + 1) % 3];
    assert!(largest(f64::max, &across) > 1.3, "{}", largest(f64::max, &across));
    assert!(largest(f64::max, &|r| strain(r)[free_axis]) > 2e-3);
}
