use super::*;
use crate::Boundary;
use crate::database::recipe::Recipe;

const GOOD: &str = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 1\n\
    [[thermal]]\ndiscs = 100\nporosities = [0.1, 0.15]\ncompressions = [\"isotropic\", \"intermediate\"]\n\
    packing_friction_angles = [0.5, 0.3]\nrepeats = 2\nramps = [\"up\", \"down\", \"up_down\"]\nstops = [0.002, 0.01]\n\
    [[mechanics]]\ndiscs = 50\nporosities = [0.1]\ncompressions = [\"horizontal\"]\nrepeats = 1\nstops = [0.01, 0.04]\n\
    [[wall_shear]]\ndiscs = 50\nporosities = [0.1]\ncompressions = [\"horizontal\"]\nrepeats = 1\nstops = [0.004]\n";

fn error(text: &str) -> String {
    Plan::parse(text, "plan.toml").unwrap_err().to_string()
}

#[test]
fn a_plan_lists_its_packings_and_their_rows() {
    let plan = Plan::parse(GOOD, "plan.toml").unwrap();
    let jobs = plan.jobs();
    assert_eq!(jobs.len(), 18);
    let kinds: Vec<Kind> = jobs[15..].iter().map(|job| job.kind).collect();
    assert_eq!(kinds, [Kind::Thermal, Kind::Mechanics, Kind::WallShear]);
    assert_eq!(jobs[0].preparation.friction_angle, Some(0.5));
    assert_eq!(jobs[2].preparation.friction_angle, Some(0.3));
    assert_eq!(jobs[16].preparation.friction_angle, Some(Material::default().friction_angle));
    assert_eq!((jobs[16].preparation.aspect, jobs[17].preparation.aspect), (1.0, 2.0));
    assert_eq!(jobs[0].stops_of(RampName::Down), [(1, -0.002), (2, -0.01)]);
    assert_eq!(jobs[0].stops_of(RampName::UpDown), [(1, 0.002), (2, 0.0)]);
    assert_eq!(jobs[16].stops_of(RampName::Yy), [(-1, -0.01), (-2, -0.04), (1, 0.01), (2, 0.04)]);
    assert_eq!(plan.rows(), 16 * 7 + 9 + 2);
    assert_ne!(jobs[0].spec.seed, jobs[1].spec.seed);
    assert_eq!(plan.hash().len(), 64);
}

#[test]
fn bad_plans_name_file_key_value_and_range() {
    assert!(error(&GOOD.replace("seed", "sead")).starts_with("plan.toml: "));
    assert!(error(&GOOD.replace("0.15", "0.9")).contains("porosity = 0.9, allowed: 0.01 to 0.3"));
    let bad = error(&GOOD.replace("[0.01, 0.04]", "[0.04, 0.01]"));
    assert!(bad.contains("[[mechanics]] 1: stops: [0.04, 0.01], allowed: growing"), "{bad}");
    let bad = error(&GOOD.replace("\"up\", \"down\"", "\"down\""));
    assert!(bad.contains("[[thermal]] 1: ramps: up_down: up must stand before it"), "{bad}");
    let bad = error(&GOOD.replace("\"down\"", "\"xx\""));
    assert!(bad.contains("ramps: xx: allowed: up, down, up_down, down_up"), "{bad}");
    let bad = error(&GOOD.replace("[0.5, 0.3]", "[0.5, 1.6]"));
    assert!(bad.contains("packing_friction_angles: 1.6"), "{bad}");
    assert!(
        error(&format!("{GOOD}return_stops = [0.005]\n")).contains("return_stops: [0.005], allowed: falling")
    );
    assert!(
        error(&GOOD.replace("repeats = 2", "repeats = 2\nrelease_walls = true"))
            .contains("release_walls: allowed in")
    );
    let empty = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 1\n";
    assert!(error(empty).contains("at least one block"));
    assert!(error(&format!("{GOOD}[material]\nfriction_angle = 2.0\n")).contains("material"));
}

const PATHS: &str = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 1\n\
    [[paths]]\ndiscs = 100\nporosities = [0.1]\ncompressions = [\"isotropic\", \"sheared\"]\nrepeats = 2\n\
    paths = [\"shear\", \"thermal\"]\nstep = 2e-3\nprobes = [1e-4, 1e-3]\nprobe_every = 10\n";

#[test]
fn a_block_of_paths_lists_its_rows() {
    let plan = Plan::parse(PATHS, "plan.toml").unwrap();
    let jobs = plan.jobs();
    assert_eq!(jobs.len(), 4);
    assert!(jobs.iter().all(|job| job.kind == Kind::Paths && job.spec.boundary == Boundary::Periodic));
    // 55 and 70 increments, and twelve probes at the packed state, once, and after each tenth increment.
    assert_eq!(plan.rows(), 4 * (1 + 55 + 70 + (1 + 5 + 7) * 12));
    let rows = jobs[0].rows();
    assert_eq!(rows[..2], [(RampName::Packed, 0), (RampName::Shear, 1)]);
    assert_eq!(rows.last(), Some(&(RampName::Thermal, 70 + 7 * 12)));
    let step = |job: &Job| job.path(RampName::Thermal)[0].increment.step.thermal;
    assert_eq!(step(&jobs[0]).abs(), 2e-3);
    assert!(jobs.iter().any(|job| step(job) > 0.0) && jobs.iter().any(|job| step(job) < 0.0));
    let usual = PATHS.split("step").next().unwrap();
    let block = &Plan::parse(usual, "plan.toml").unwrap().paths[0];
    assert_eq!((block.step, block.probes.len(), block.probe_every), (1e-3, 0, 20));
}

#[test]
fn bad_blocks_of_paths_name_key_value_and_range() {
    for (good, bad, problem) in [
        ("\"thermal\"]", "\"up\"]", "[[paths]] 1: paths: up: allowed: uniaxial, biaxial, shear, isotropic,"),
        ("\"thermal\"]", "\"sideways\"]", "unknown variant `sideways`"),
        ("\"thermal\"]", "\"shear\"]", "[[paths]] 1: paths: shear: is named twice"),
        ("[\"shear\", \"thermal\"]", "[]", "[[paths]] 1: paths: at least one is needed"),
        ("repeats = 2", "repeats = 2\nboundary = \"walls\"", "unknown field `boundary`"),
        ("repeats = 2", "repeats = 0", "[[paths]] 1: porosities, compressions and repeats"),
        ("step = 2e-3", "step = 2e-2", "step: 0.02, allowed: 1e-5 to 1e-2"),
        ("step = 2e-3", "step = 9e-6", "step: 0.000009, allowed: 1e-5 to 1e-2"),
        ("step = 2e-3", "step = nan", "step: NaN, allowed"),
        ("1e-3]", "1e-4]", "probes: [0.0001, 0.0001], allowed: growing, 1e-6 to 1e-2"),
        ("1e-3]", "0.02]", "probes: [0.0001, 0.02], allowed: growing"),
        ("probe_every = 10", "probe_every = 0", "probe_every: 0, allowed: at least 1"),
        ("probe_every = 10", "stops = [0.01]", "unknown field `stops`"),
    ] {
        let found = error(&PATHS.replace(good, bad));
        assert!(found.starts_with("plan.toml: ") && found.contains(problem), "{bad}: {found}");
    }
    let found = error(&GOOD.replace("\"up\", \"down\", \"up_down\"", "\"shear\""));
    assert!(found.contains("ramps: shear: allowed: up, down, up_down, down_up"), "{found}");
}
