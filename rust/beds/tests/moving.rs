//! Beds whose walls move while heat flows, at small size: balances of heat and force, the path of the lid, the stiffness of the shell,
//! nothing moves without a reason; bad descriptions.

use msdd_beds::case::{BedCase, FILE};
use msdd_beds::coupled::{Prepared, Run, prepare, run, side_friction};
use msdd_beds::effective::poor_spheres;
use std::path::PathBuf;

/// With places for the container, the keys of the lid, the walls, further sections, and what is recorded.
const TEXT: &str = r#"
seed = 2
[grains]
number = 250
diameter = 6.4e-3
density = 7800
young_modulus = 2e10
poisson_ratio = 0.3
simulated_young_modulus = 5e7
friction = 0.3
wall_friction = 0
restitution = 0.5
thermal_expansion = 1.2e-5
conductivity = 46
heat_capacity = 475
yield_stress = 2e9
[container]
CONTAINER
[lid]
pressure = 20000
LID
[gas]
name = "air"
accommodation = 0.9
HEATED
[time]
initial_temperature = 293.15
end = 1200
interval = 200
steps = 3000
output_every = 400
[record]
RECORD
"#;

const ENDLESS: &str = "base = [0.032, 0.032]\nendless = true";
const COLUMN: &str = "wall = \"floor\"\ndistances = [0.02, 0.04]\nheights = [0.015, 0.045]";
const FLOOR: &str = "[[heated]]\nwall = \"floor\"\ntemperature = [[0, 293.15], [400, 323.15]]";

/// A folder with a description, removed at the end.
struct Folder(PathBuf);

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn read(text: &str) -> Result<BedCase, String> {
    use std::sync::atomic::{AtomicU32, Ordering};
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let folder = Folder(std::env::temp_dir().join(format!("msdd-moving-{}-{number}", std::process::id())));
    std::fs::create_dir_all(&folder.0).unwrap();
    std::fs::write(folder.0.join(FILE), text).unwrap();
    BedCase::read(&folder.0).map_err(|error| error.to_string())
}

fn text([container, lid, heated, record]: [&str; 4]) -> String {
    let parts = [("CONTAINER", container), ("LID", lid), ("HEATED", heated), ("RECORD", record)];
    parts.into_iter().fold(TEXT.to_string(), |text, (place, part)| text.replace(place, part))
}

fn bed(parts: [&str; 4]) -> (BedCase, Prepared, Run) {
    let scene = read(&text(parts)).unwrap();
    let prepared = prepare(&scene, 1, |_, _| ()).unwrap();
    let found = run(&scene, &prepared, |_| ()).unwrap();
    (scene, prepared, found)
}

/// The lid follows its path; what the bed carries above and below is in balance, and is the stress in its middle; heat is kept.
#[test]
fn a_column_is_pressed_and_heated() {
    let (_, _, found) = bed([ENDLESS, "strain = [[0, 0], [400, 1e-3], [1200, 5e-4]]", FLOOR, COLUMN]);
    assert!(
        found.stored > 1.0 && found.residual.abs() < 1e-8 * found.stored,
        "{} {}",
        found.stored,
        found.residual
    );
    let depth = found.rows[0].depth;
    for (row, strain) in found.rows.iter().zip([0.0, 1e-3, 7.5e-4, 5e-4]) {
        assert!((row.depth / depth - 1.0 + strain).abs() < 1e-9, "{} {depth} {strain}", row.depth);
        assert!(row.unbalanced < 1.5e-3, "{row:?}");
        let [floor, lid] = [row.walls[0], row.walls[1]];
        // The weight lies between: half of the bed is above the middle.
        let middle = 0.5 * (floor + lid);
        assert!((row.stress[2] / middle - 1.0).abs() < 0.05, "{row:?}");
    }
    let pressed = &found.rows[1];
    assert!(pressed.stress[2] > 2.0 * found.rows[0].stress[2], "{pressed:?}");
    assert!(pressed.contact_conductivity > found.rows[0].contact_conductivity, "{pressed:?}");
    // It is hot below, and not yet above.
    assert!(pressed.temperatures[0] > pressed.temperatures[1] + 0.1, "{pressed:?}");
}

/// Nothing is heated, nothing is moved: no heat flows, and no wall moves. The few spheres still creep a little where the lid no longer
/// follows, which takes a tenth of the pressure; with 20 000 it is less than a hundredth.
#[test]
fn a_bed_at_rest_stays_at_rest() {
    let heated = "[[heated]]\nwall = \"floor\"\ntemperature = 293.15";
    let (_, _, found) = bed([ENDLESS, "", heated, COLUMN]);
    let (first, last) = (&found.rows[0], &found.rows[3]);
    for k in 0..3 {
        let kept = last.stress[k] / first.stress[k];
        assert!((0.85..1.01).contains(&kept), "{first:?} {last:?}");
    }
    assert!((last.temperatures[0] - 293.15).abs() < 1e-9 && found.stored.abs() < 1e-6, "{last:?}");
    assert_eq!(first.depth, last.depth);
}

/// What spheres press each other with as they harden leaves through the lid, although the wall around them is rough: the floor carries
/// the lid and the weight.
#[test]
fn rough_walls_hold_no_stress_of_the_hardening() {
    let heated = "[[heated]]\nwall = \"floor\"\ntemperature = 293.15";
    let record = COLUMN.to_string() + "\nradius = 0.012";
    let rough =
        text(["radius = 0.02", "", heated, &record]).replace("wall_friction = 0", "wall_friction = 0.4");
    let scene = read(&rough).unwrap();
    let prepared = prepare(&scene, 1, |_, _| ()).unwrap();
    assert_eq!(prepared.simulation.material.wall_friction, 0.4);
    let found = run(&scene, &prepared, |_| ()).unwrap();
    let [floor, side, lid] = found.rows[0].walls[..] else { panic!("{:?}", found.rows[0]) };
    let weight = 250.0 * 7800.0 * 9.81 * std::f64::consts::PI / 6.0 * 6.4e-3f64.powi(3);
    let expected = lid + weight / (std::f64::consts::PI * 0.02 * 0.02);
    assert!((floor / expected - 1.0).abs() < 0.01, "{floor} {expected}");
    let friction = side_friction(&scene, &found.rows[0]).unwrap();
    assert!(
        (friction - (floor - expected) * 0.5 * 0.02 / (found.rows[0].depth * side)).abs() < 1e-3,
        "{friction}"
    );
}

/// The shell stands where its stiffness and the pressure on it say, and a warm one beyond that; the lid keeps its pressure.
#[test]
fn a_shell_yields() {
    let heated = "[[heated]]\nwall = \"side\"\ntemperature = [[0, 293.15], [400, 323.15]]\n\
                  [shell]\nyoung_modulus = 2e9\nthickness = 1e-3\nthermal_expansion = 2e-6";
    let record = "wall = \"side\"\ndistances = [0.008]\nheights = [0.012, 0.04]\nradius = 0.014";
    let (_, _, found) = bed(["radius = 0.02", "pressing = 20000", heated, record]);
    let stiffness = 2e9 * 1e-3 / (0.02f64 * 0.02);
    let start = found.rows[0].walls[1];
    for row in &found.rows[1..] {
        let expected = (row.walls[1] - start) / stiffness + 2e-6 * 30.0 * 0.02;
        let found = row.radius - 0.02;
        assert!((found - expected).abs() < 0.02 * expected.abs() + 1e-9, "{row:?} {expected}");
        assert!((row.walls[2] / 20000.0 - 1.0).abs() < 0.02, "{row:?}");
    }
    assert!(found.rows[3].walls[1] > 1.05 * start, "{:?}", found.rows[3]);
}

/// With few steps in an interval the bed lags while it swells and shrinks, and waits: it does not press the lid away.
#[test]
fn a_bed_waits_where_it_lags() {
    let heated = ["floor", "lid"].map(|wall| {
        format!("[[heated]]\nwall = \"{wall}\"\ntemperature = [[0, 293.15], [400, 323.15], [800, 293.15]]")
    });
    let text = text([ENDLESS, "pressing = 20000", &heated.join("\n"), COLUMN]);
    let scene =
        text.replace("steps = 3000", "steps = 200").replace("heat_capacity = 475", "heat_capacity = 1");
    let scene = read(&scene).unwrap();
    let prepared = prepare(&scene, 1, |_, _| ()).unwrap();
    let found = run(&scene, &prepared, |_| ()).unwrap();
    let few = 6 * 200;
    assert!(found.steps - prepared.simulation.steps > 2 * few, "{}", found.steps);
    for row in &found.rows {
        assert!((row.walls[1] / 20000.0 - 1.0).abs() < 2.5e-3 && row.unbalanced < 1.5e-3, "{row:?}");
    }
    let [warm, cold] = [1, 2].map(|k| found.rows[k].stress[0]);
    assert!(warm > 1.2 * cold, "{warm} {cold}");
    assert_eq!((found.intervals, found.hurried, found.restless), (6, 0, 0));
}

/// A lid that keeps a small pressure while the spheres swell by much in few steps: the bed carries across what it does with many steps.
/// Hurried after 20 times the steps, as it once was, it carries 9 % less.
#[test]
fn few_steps_do_not_hurry_a_bed() {
    let heated = ["floor", "lid"]
        .map(|wall| format!("[[heated]]\nwall = \"{wall}\"\ntemperature = [[0, 293.15], [800, 333.15]]"));
    let text = text([ENDLESS, "pressing = 20000", &heated.join("\n"), COLUMN]);
    let [few, many] = ["steps = 100", "steps = 6000"].map(|steps| {
        let scene = text.replace("steps = 3000", steps).replace("heat_capacity = 475", "heat_capacity = 1");
        let scene = read(&scene.replace("20000", "4000")).unwrap();
        let prepared = prepare(&scene, 1, |_, _| ()).unwrap();
        let found = run(&scene, &prepared, |_| ()).unwrap();
        assert_eq!(found.hurried, 0);
        let [x, y, _] = found.rows.last().unwrap().stress;
        x + y
    });
    assert!((few / many - 1.0).abs() < 0.05, "{few} {many}");
}

/// The bed without sides rests on its floor alone, and its spheres touch beyond the sides.
#[test]
fn an_endless_bed_reaches_beyond_its_sides() {
    let scene = read(&text([ENDLESS, "", FLOOR, COLUMN])).unwrap();
    let Prepared { simulation, stages, .. } = prepare(&scene, 1, |_, _| ()).unwrap();
    assert_eq!(stages.iter().map(|stage| stage.0).collect::<Vec<_>>(), ["pour", "lid", "harden"]);
    let weight: f64 = simulation.spheres.iter().map(|s| 9.81 * s.mass).sum();
    let floor = -simulation.wall_force[0][2];
    let lid = 2e4 * 0.032 * 0.032;
    assert!((floor / (weight + lid) - 1.0).abs() < 5e-3, "{floor} {weight} {lid}");
    let mut beyond = 0;
    simulation.for_each_contact(|contact| beyond += usize::from(contact.shift != [0; 3]));
    assert!(beyond > 50, "{beyond}");
    let again = prepare(&scene, 2, |_, _| ()).unwrap().simulation;
    assert_eq!(again.spheres, simulation.spheres);
}

/// The base of a bed without sides follows its path exactly, the lid its own. All stresses grow by nearly one factor where all strains are the same.
#[test]
fn a_bed_without_sides_is_strained_across() {
    let closed = "strain = [[0, 0], [400, 3e-4]]\n[sides]\nstrain_x = [[0, 0], [400, -3e-4]]\nstrain_y = [[0, 0], [400, -3e-4]]";
    let heated = "[[heated]]\nwall = \"floor\"\ntemperature = 293.15";
    let (_, _, found) = bed([ENDLESS, closed, heated, COLUMN]);
    let (first, last) = (&found.rows[0], &found.rows[1]);
    for k in 0..2 {
        assert!((last.strain[k] / -3e-4 - 1.0).abs() < 1e-9, "{last:?}");
    }
    let [x, y, z] = [0, 1, 2].map(|k| last.stress[k] / first.stress[k]);
    assert!(z > 2.0 && (x / z - 1.0).abs() < 0.1 && (y / z - 1.0).abs() < 0.1, "{first:?} {last:?}");
    // Floor and lid carry the stress inside on a base that is smaller now.
    assert!((0.5 * (last.walls[0] + last.walls[1]) / last.stress[2] - 1.0).abs() < 0.05, "{last:?}");
}

/// Glass in helium: the run says that a closure is used, and the middle of the bed conducts what that says.
#[test]
fn grains_that_conduct_poorly_follow_the_closure() {
    let good = text([ENDLESS, "", FLOOR, COLUMN]);
    assert_eq!(read(&good).unwrap().closure(), None);
    let poor = good.replace("conductivity = 46", "conductivity = 1").replace("\"air\"", "\"helium\"");
    let scene = read(&poor).unwrap();
    let said = scene.closure().unwrap();
    assert!(said.contains("conduct 6.2 to 6.6 times as well") && said.contains("within 2 %"), "{said}");
    let prepared = prepare(&scene, 1, |_, _| ()).unwrap();
    let found = run(&scene, &prepared, |_| ()).unwrap();
    let row = &found.rows[0];
    let helium = scene.gas.name.at(293.15, 101_325.0, scene.gas.accommodation).unwrap();
    let expected = helium.conductivity * poor_spheres(1.0 - row.porosity, 1.0 / helium.conductivity);
    assert!((row.gas_conductivity / expected - 1.0).abs() < 0.1, "{row:?} {expected}");
    assert!(row.contact_conductivity < 0.05 * expected, "{row:?}");
    assert!(found.residual.abs() < 1e-9 * found.stored, "{} {}", found.residual, found.stored);
}

#[test]
fn a_region_of_averages_lies_in_the_bed_and_in_the_container() {
    let round = "radius = 0.02";
    let error = |record: &str| read(&text([round, "", FLOOR, record])).unwrap_err();
    let wide = error("wall = \"side\"\ndistances = [0.008]\nheights = [0.012, 0.04]\nradius = 0.021");
    assert!(wide.contains("record.radius = 0.021, allowed: 0.0064 to 0.02 m"), "{wide}");
    let high = "wall = \"floor\"\ndistances = [0.02]\nheights = [0.015, 0.2]";
    let scene = read(&text([ENDLESS, "", FLOOR, high])).unwrap();
    let error = run(&scene, &prepare(&scene, 1, |_, _| ()).unwrap(), |_| ()).unwrap_err().to_string();
    assert!(
        error.starts_with("record.heights: up to 0.2 m, allowed: up to the depth of the poured bed, 0.0"),
        "{error}"
    );
}

/// Spheres that grow by some per cent between plates that stay: the law of Hertz ends.
#[test]
fn overlaps_that_no_law_of_contacts_has_end_the_run() {
    let hot = FLOOR.replace("323.15", "310");
    let growing = |expansion: &str| {
        let scene = read(&text([ENDLESS, "", &hot, COLUMN]).replace("1.2e-5", expansion)).unwrap();
        run(&scene, &prepare(&scene, 1, |_, _| ()).unwrap(), |_| ())
    };
    let error = growing("1e-2").unwrap_err().to_string();
    assert!(error.contains("spheres overlap by") && error.contains("allowed: up to 25 %"), "{error}");
    let usual = growing("1.2e-5").unwrap();
    assert!(usual.overlap > 1e-4 && usual.overlap < 0.01, "{}", usual.overlap);
}

#[test]
fn bad_descriptions_are_refused_with_key_and_value() {
    let good = text([ENDLESS, "", FLOOR, COLUMN]);
    assert!(read(&good).is_ok());
    let usual = read(&good.replace("accommodation = 0.9\n", "")).unwrap();
    assert_eq!(usual.gas.accommodation, 0.9);
    for (from, to, message) in [
        (
            "pressure = 20000",
            "pressure = 20000\nstrain = 0\npressing = 1",
            "lid = strain and pressing, allowed: one of",
        ),
        (
            "pressure = 20000",
            "pressure = 20000\nstrain = [[0, 0], [1, 0.5]]",
            "lid.strain = 0.5, allowed: -0.2 to 0.2",
        ),
        ("wall = \"floor\"\nt", "wall = \"x_low\"\nt", "heated.wall = x_low, allowed: floor, lid"),
        ("interval = 200", "interval = 500", "time.interval = 500, allowed:"),
        ("steps = 3000", "steps = 3", "time.steps = 3, allowed: 100 to"),
        ("[time]", "[shell]\nyoung_modulus = 1e9\nthickness = 1e-3\n[time]", "shell = a box, allowed:"),
        (
            "[time]",
            "[sides]\nstrain_x = 0.3\nstrain_y = 0\n[time]",
            "sides.strain_x = 0.3, allowed: -0.2 to 0.2",
        ),
        (
            "endless = true",
            "endless = false\n[sides]\nstrain_x = 0\nstrain_y = 0",
            "sides = given, allowed: a bed without sides",
        ),
        ("endless = true", "radius = 0.1", "container = both or neither"),
        ("base = [0.032, 0.032]", "base = [0.01, 0.032]", "container.base = 0.01, allowed: two and a half"),
        ("1.2e-5", "-1", "grains.thermal_expansion = -1, allowed: 0 to 0.01"),
        (
            "[400, 323.15]",
            "[0, 323.15]",
            "heated.temperature = times 0 s and 0 s in this order, allowed: rising",
        ),
        (
            "conductivity = 46",
            "conductivity = 0.01",
            "times that of the gas, allowed: grains that conduct 1 times as well as the gas, at least",
        ),
        ("heights = [0.015, 0.045]", "heights = [0.045, 0.015]", "record.heights = [0.045, 0.015], allowed:"),
        (
            "heights = [0.015, 0.045]",
            "heights = [0.02, 0.0201]",
            "record.heights = [0.02, 0.0201], allowed: two heights above the floor, 2 diameters apart at least: 0.0128 m",
        ),
        ("heights = [0.015, 0.045]", "heights = [-0.01, 0.045]", "record.heights = [-0.01, 0.045], allowed:"),
        (
            "diameter = 6.4e-3",
            "diameter = 12e-3",
            "about 20 spheres, allowed: a region of 30 spheres at least",
        ),
        (
            "endless = true",
            "endless = true\ngravity = 1e-12",
            "container.gravity = 0.000000000001, allowed: about",
        ),
        ("seed = 2", "seeds = 2", "unknown field `seeds`"),
    ] {
        assert!(good.contains(from), "{from}");
        let error = read(&good.replacen(from, to, 1)).unwrap_err();
        assert!(error.contains(message) && error.contains(FILE), "{message}: {error}");
    }
}
