use super::*;

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
        error(&GOOD.replace("repeats = 2", "repeats = 2\nslide = \"same\"")).contains("slide: allowed in")
    );
    let empty = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 1\n";
    assert!(error(empty).contains("at least one block"));
    assert!(error(&format!("{GOOD}[material]\nfriction_angle = 2.0\n")).contains("material"));
}
