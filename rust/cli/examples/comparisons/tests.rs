//! The shipped scenes: their plan, their tables, and one of them computed again.

use crate::dem::data::{TABLES, lines, read};
use crate::dem::discs::{packed, simulate};
use crate::dem::{Plan, Use};
use msdd_rve::state;
use std::path::PathBuf;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../cases/scenes")
}

fn plan() -> Plan {
    Plan::read(&folder().join("plan.toml")).unwrap()
}

#[test]
fn half_of_the_scenes_calibrate_and_half_judge() {
    let plan = plan();
    let count = |purpose| plan.scenes.iter().filter(|scene| scene.purpose == purpose).count();
    assert_eq!(count(Use::Calibrate), 12);
    assert_eq!(count(Use::Judge), 12);
    assert!(count(Use::Outside) >= 6);
    assert!(plan.scenes.iter().all(|scene| scene.seeds.len() == 3));
    let inside = plan.scenes.iter().filter(|scene| scene.purpose != Use::Outside);
    let unusual = |scene: &&crate::dem::PlannedScene| {
        scene.friction.is_some() || scene.radii != msdd_case::packing::RADIUS_RANGE
    };
    assert_eq!(
        inside.filter(unusual).count(),
        0,
        "the shipped model has one friction and one shape of radii"
    );
}

#[test]
fn the_tables_have_all_packings_and_times_and_finite_numbers() {
    let plan = plan();
    for (name, columns, _) in TABLES {
        let columns: Vec<&str> = columns.iter().map(|(column, ..)| *column).collect();
        let text = read(&folder(), name).unwrap();
        let mut rows = text.lines();
        assert_eq!(rows.next().unwrap(), format!("scene,use,seed,{}", columns.join(",")), "{name}");
        let mut rows = rows.peekable();
        for scene in &plan.scenes {
            for seed in &scene.seeds {
                let head = format!("{},{},{seed},", scene.name, scene.purpose.as_str());
                let (mut times, mut count) = (Vec::new(), 0);
                while let Some(numbers) = rows.peek().and_then(|row| row.strip_prefix(&head)) {
                    let numbers: Vec<f64> = numbers.split(',').map(|n| n.parse().unwrap()).collect();
                    assert!(
                        numbers.len() == columns.len() && numbers.iter().all(|n| n.is_finite()),
                        "{head}"
                    );
                    if times.last() != Some(&numbers[0]) {
                        times.push(numbers[0]);
                    }
                    count += 1;
                    rows.next();
                }
                if columns[0] != "time" {
                    assert_eq!(count, 1, "{name}: {head}");
                    continue;
                }
                assert_eq!(times.len(), plan.outputs + 1, "{name}: {head}");
                assert_eq!(count % times.len(), 0, "{name}: {head}");
                assert!((times[plan.outputs] / scene.end - 1.0).abs() < 1e-6 && times[0] == 0.0);
            }
        }
        assert_eq!(rows.next(), None, "{name}: a row that is not of the plan");
    }
}

/// The smallest scene, packed and simulated anew, has the shipped rows to the last digit.
#[test]
fn a_scene_computed_again_gives_the_shipped_rows() {
    let plan = plan();
    let scene = plan.scenes.iter().find(|scene| scene.name == "three-hot").unwrap();
    let seed = scene.seeds[0];
    // As through the file of the packed box, which has no list of neighbours.
    let box_of_discs = packed(scene, seed, 1).unwrap();
    let start = state::from_json(&state::to_file(&box_of_discs).unwrap()).unwrap();
    let results = simulate(&plan, scene, &start, seed, 1).unwrap();
    for (name, _, part) in TABLES {
        let again = lines(scene, &results, part(&results));
        assert!(!again.is_empty() && read(&folder(), name).unwrap().contains(&again), "{name}\n{again}");
    }
}

#[test]
fn a_plan_that_is_wrong_is_refused_by_file_scene_key_value_and_range() {
    let good = std::fs::read_to_string(folder().join("plan.toml")).unwrap();
    let file = std::env::temp_dir().join(format!("msdd-plan-{}.toml", std::process::id()));
    for (from, to, problem) in [
        ("seeds = [11, 12, 13]", "seeds = [11, 12, 21]", "scene all-cold-isotropic: seeds = 21, allowed:"),
        ("seeds = [11, 12, 13]", "seeds = [11]", "scene all-hot: seeds = 1, allowed: two at least"),
        ("box = [60, 60]", "box = [60, 7]", "scene all-hot: height of the box = "),
        ("box = [60, 60]", "box = [600, 600]", "allowed: 100 to 20000 discs"),
        ("friction = 0.656", "friction = -1", "friction = -1, allowed: 0 to 10"),
        ("left = \"100\"", "left = \"hot\"", "scene all-hot: left = hot, allowed: insulated"),
        ("left = \"100\"", "lef = \"100\"", "unknown field `lef`"),
        ("outputs = 4", "outputs = 0", "outputs = 0, allowed: 1 to 100"),
    ] {
        std::fs::write(&file, good.replacen(from, to, 1)).unwrap();
        let error = Plan::read(&file).unwrap_err().to_string();
        assert!(error.contains(problem) && error.contains("msdd-plan-"), "{error}");
    }
    std::fs::remove_file(&file).unwrap();
}
