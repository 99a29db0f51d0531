//! Beds that were measured: from the description to temperatures, at small size; bad descriptions and measurements.

use msdd_beds::bed::{PlateKind, prepare};
use msdd_beds::case::{BedCase, FILE, Vary};
use msdd_beds::effective::poor_spheres;
use msdd_beds::experiment::{self, misfits};
use std::path::{Path, PathBuf};

const TEXT: &str = r#"
[grains]
number = 300
diameter = 6.4e-3
density = 7747
young_modulus = 200e9
poisson_ratio = 0.29
simulated_young_modulus = 2e7
friction = 0.3
wall_friction = 0.3
restitution = 0.5
conductivity = [[280.0, 43.0], [340.0, 41.0]]
heat_capacity = 464
roughness = 3.4e-7
hardness = 3e9
yield_stress = 5e8
[container]
base = [0.032, 0.06]
[lid]
pressure = 1000
[turn]
down = "y_low"
[gas]
name = "air"
accommodation = 0.7
[plate]
wall = "y_high"
temperature = 326.15
pressure = 1000
young_modulus = 100e9
poisson_ratio = 0.33
conductivity = 250
[time]
initial_temperature = 293.15
end = 100
output_every = 10
[record]
wall = "y_high"
distances = [0.01, 0.03]
"#;

/// A folder with a description, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str, text: &str) -> Self {
        let path = std::env::temp_dir().join(format!("msdd-beds-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        std::fs::write(path.join(FILE), text).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn read(name: &str, text: &str) -> Result<BedCase, String> {
    let folder = Folder::new(name, text);
    BedCase::read(&folder.0).map_err(|error| error.to_string())
}

/// A bed is poured, pressed, turned, pressed again and heated; balances close, the far grains stay colder, and a plate that holds the
/// first layer heats more than one that resists.
#[test]
fn from_pouring_to_temperatures() {
    let case = read("whole", TEXT).unwrap();
    let mut stages = Vec::new();
    let bed = prepare(&case, 1, |stage, share| {
        assert!((0.0..=1.0).contains(&share));
        if stages.last() != Some(&stage) {
            stages.push(stage);
        }
    })
    .unwrap();
    assert_eq!(stages, ["pour", "lid", "turn", "plate"]);
    assert!(bed.stages.iter().all(|(_, rest)| rest.at_rest), "{:?}", bed.stages);
    let pressed = bed.plate_force() / bed.area(&case);
    assert!((pressed / 1000.0 - 1.0).abs() < 0.02, "{pressed}");
    let stress = case.grains.peak_stress(&bed.simulation).unwrap();
    assert!(stress.contacts > 500 && stress.largest > 1e8 && stress.largest < 5e9, "{stress:?}");
    let slab = bed.slab(&case, [0.016, 0.045]).unwrap();
    assert!((0.5..0.65).contains(&slab.solid_fraction) && slab.coordination > 3.5, "{slab:?}");
    assert!(slab.contact_conductivity > 0.02 && slab.gas_conductivity > 0.2, "{slab:?}");
    let mut stored = Vec::new();
    for kind in PlateKind::ALL {
        let heated = bed.heat(&case, kind, |_| ()).unwrap();
        assert!(heated.residual.abs() < 1e-9 * heated.stored, "{heated:?}");
        let [near, far] = [0, 1].map(|k| heated.records[k].rows.last().unwrap().1);
        assert!(near > far + 1.0 && far >= 293.15 && near < 326.15, "{near} {far}");
        assert_eq!(heated.records[0].rows.len(), 11);
        // Measurements that are its own rows are met.
        let measured: Vec<_> = heated.records[1]
            .rows
            .iter()
            .map(|&(time, temperature)| experiment::Measured { distance: 0.03, time, temperature })
            .collect();
        assert!(misfits(&measured, &heated.records)[2].rms < 1e-12);
        stored.push(heated.stored);
    }
    assert!(stored[0] > 1.2 * stored[1], "{stored:?}");
}

/// A lid that stops at a porosity stands where that says, and the bed carries what it presses with; one that would not touch the bed is refused,
/// as are both keys together and neither.
#[test]
fn a_lid_closes_to_a_porosity() {
    let with = |keys: &str| {
        let text = TEXT.replace("[lid]\npressure = 1000", &format!("[lid]\n{keys}"));
        read("closed", &text.replace("326.15\npressure = 1000", "326.15"))
    };
    let case = with("porosity = 0.45").unwrap();
    let bed = prepare(&case, 1, |_, _| ()).unwrap();
    assert!(bed.stages.iter().all(|(_, rest)| rest.at_rest), "{:?}", bed.stages);
    let lid = bed.simulation.boundary.walls().len() - 1;
    let solid = 300.0 * std::f64::consts::PI / 6.0 * 6.4e-3f64.powi(3);
    let depth = solid / (0.032 * 0.06 * (1.0 - 0.45));
    assert!((bed.simulation.boundary.walls()[lid].point[2] / depth - 1.0).abs() < 1e-6, "{depth}");
    let pressure = bed.simulation.wall_load(lid) / (0.032 * 0.06);
    assert!(pressure > 1e3, "{pressure}");
    assert!((bed.lid_pressure(&case).unwrap() / pressure - 1.0).abs() < 1e-12);
    assert_eq!(bed.lid_pressure(&read("pressed", TEXT).unwrap()), None);
    let text = prepare(&with("porosity = 0.65").unwrap(), 1, |_, _| ()).unwrap_err().to_string();
    assert!(
        text.contains("lid does not touch the grains") && text.contains("a smaller lid.porosity"),
        "{text}"
    );
    for (keys, told) in [
        ("porosity = 0.45\npressure = 1000", "lid = pressure and porosity, allowed: one of"),
        ("", "lid = neither pressure nor porosity, allowed: one of"),
        ("porosity = 0.9", "lid.porosity = 0.9, allowed: 0.35 to 0.7"),
    ] {
        let text = with(keys).unwrap_err();
        assert!(text.contains(told), "{text}");
    }
    let both = format!("{TEXT}\n[[vary]]\nkey = \"lid.porosity\"\nvalue = 0.45\n");
    let text = read("closed-vary", &both).unwrap_err();
    assert!(text.contains("vary lid.porosity: lid = pressure and porosity"), "{text}");
}

/// Grains that conduct 6 times as well as the gas: the run says that a closure is used, the bed conducts what that says, and the balance of heat
/// closes.
#[test]
fn grains_that_conduct_poorly_follow_the_closure() {
    assert_eq!(read("good", TEXT).unwrap().closure(), None);
    let poor = TEXT.replace("[[280.0, 43.0], [340.0, 41.0]]", "1.0").replace("\"air\"", "\"helium\"");
    let case = read("poor", &poor).unwrap();
    let said = case.closure().unwrap();
    assert!(said.contains("conduct 6.1 to 6.6 times as well") && said.contains("within 2 %"), "{said}");
    let bed = prepare(&case, 1, |_, _| ()).unwrap();
    let slab = bed.slab(&case, [0.016, 0.045]).unwrap();
    let helium = case.gas.name.at(293.15, 101_325.0, case.gas.accommodation).unwrap();
    let expected = helium.conductivity * poor_spheres(slab.solid_fraction, 1.0 / helium.conductivity);
    // The box is five spheres wide: the pairs at its sides are fewer.
    let found = slab.gas_conductivity;
    assert!((found / expected - 1.0).abs() < 0.15, "{found} {expected}");
    assert!(slab.contact_conductivity < 0.05 * found, "{slab:?}");
    let heated = bed.heat(&case, PlateKind::Resisting, |_| ()).unwrap();
    assert!(heated.residual.abs() < 1e-9 * heated.stored, "{heated:?}");
}

/// What has no result is an error that says what to change: a bed that never comes to rest, a plate that no grain is near.
#[test]
fn a_bed_that_moves_or_a_plate_apart_is_no_result() {
    let small = TEXT.replace("number = 300", "number = 60");
    let restless =
        small.replace("restitution = 0.5", "restitution = 1").replace("friction = 0.3", "friction = 0");
    let mut case = read("restless", &restless).unwrap();
    case.lid = None;
    case.plate.as_mut().unwrap().pressure = Some(1e-9);
    let text = prepare(&case, 1, |_, _| ()).unwrap_err().to_string();
    assert!(text.contains("the grains still move") && text.contains("try more friction"), "{text}");
    let mut case = read("apart", &small).unwrap();
    (case.lid, case.turn) = (None, None);
    case.plate.as_mut().unwrap().pressure = None;
    let mut bed = prepare(&case, 1, |_, _| ()).unwrap();
    bed.plate = 5;
    for kind in PlateKind::ALL {
        let text = bed.heat(&case, kind, |_| ()).unwrap_err().to_string();
        assert!(text.contains("with no grain next to it"), "{text}");
    }
}

/// Times scale with grains and gravity: a bed under a hundredth of gravity comes to rest as well.
#[test]
fn little_gravity_has_its_time() {
    let case = TEXT.replace("number = 300", "number = 100").replace("[lid]", "gravity = 0.1\n[lid]");
    let mut case = read("gravity", &case).unwrap();
    case.lid = None;
    case.plate.as_mut().unwrap().pressure = None;
    let bed = prepare(&case, 1, |_, _| ()).unwrap();
    assert!(bed.stages[0].1.time > 3.0, "{:?}", bed.stages);
}

/// What a softer simulation changes: the contacts, seen as those of the real material, conduct nearly the same.
#[test]
fn softness_hardly_changes_what_contacts_conduct() {
    let contacts = |modulus: &str| {
        let text =
            TEXT.replace("simulated_young_modulus = 2e7", &format!("simulated_young_modulus = {modulus}"));
        let case = read(modulus, &text.replace("number = 300", "number = 200")).unwrap();
        let bed = prepare(&case, 1, |_, _| ()).unwrap();
        bed.slab(&case, [0.012, 0.03]).unwrap().contact_conductivity
    };
    let (soft, hard) = (contacts("1e7"), contacts("8e7"));
    // Twice as large contacts with the softer grains, if they were not taken as the real ones; the packings differ, too.
    assert!((soft / hard - 1.0).abs() < 0.2, "{soft} {hard}");
}

#[test]
fn bad_descriptions_are_refused_with_file_key_value_and_range() {
    let refused = |name: &str, from: &str, to: &str| {
        assert!(TEXT.contains(from), "{from}");
        let text = read(name, &TEXT.replace(from, to)).unwrap_err();
        assert!(text.contains(FILE), "{text}");
        text
    };
    let text = refused("diameter", "diameter = 6.4e-3", "diameter = -1");
    assert!(text.ends_with("grains.diameter = -1, allowed: 1e-12 to 1e15"), "{text}");
    let text = refused("unknown", "[turn]", "spin = 3\n[turn]");
    assert!(text.contains("unknown field `spin`") && text.contains("pressure"), "{text}");
    let text = refused("wall", "wall = \"y_high\"", "wall = \"side\"");
    assert!(text.ends_with("plate.wall = side, allowed: floor, x_low, x_high, y_low, y_high, lid"), "{text}");
    let text = refused("gas", "\"air\"", "\"xenon\"");
    assert!(text.contains("`air`, `nitrogen`, `helium`, `argon`, `vacuum`"), "{text}");
    let text = refused("table", "[340.0, 41.0]", "[320.0, 41.0]");
    assert!(text.contains("grains.conductivity = known from 280 K to 320 K"), "{text}");
    let text = refused("ratio", "[[280.0, 43.0], [340.0, 41.0]]", "0.02");
    assert!(
        text.ends_with(
            "times that of the gas, allowed: grains that conduct 1 times as well as the gas, at least"
        ),
        "{text}"
    );
    let text = refused("both", "base = [0.032, 0.06]", "base = [0.032, 0.06]\nradius = 0.1");
    assert!(
        text.ends_with("container = both or neither of base and radius, allowed: one of base and radius")
    );
    let text = refused("hardness", "hardness = 3e9", "");
    assert!(
        text.contains("grains.hardness = not given") && text.contains("because a roughness is given"),
        "{text}"
    );
    for (name, key) in [("emissivity", "grains"), ("plate-emissivity", "plate")] {
        let section = format!("[{key}]\n");
        for value in ["0.005", "1.1", "nan"] {
            let text = refused(name, &section, &format!("{section}emissivity = {value}\n"));
            assert!(
                text.contains(&format!("{key}.emissivity = ")) && text.ends_with("or 0.01 to 1"),
                "{text}"
            );
        }
    }
    let table = "[grains]\nemissivity = [[280.0, 0.6], [340.0, 0.001]]\n";
    let text = refused("emissivities", "[grains]\n", table);
    assert!(text.ends_with("grains.emissivity = 0.001, allowed: 0.01 to 1"), "{text}");
    let varying = read("varying", &TEXT.replace("[grains]\n", &table.replace("0.001", "0.5"))).unwrap();
    let said = varying.varying_emissivity().unwrap();
    assert!(said.contains("rays are traced with 0.5") && said.contains("within 2 %"), "{said}");
    let text = refused("stiffer", "simulated_young_modulus = 2e7", "simulated_young_modulus = 2e12");
    assert!(text.contains("simulated_young_modulus = 2000000000000, allowed: 1e-12 to that of"), "{text}");
    let text = refused("dip", "[340.0, 41.0]", "[300.0, 0.01], [340.0, 41.0]");
    assert!(text.contains("allowed: grains that conduct 1 times as well"), "{text}");
    let text = refused("text", "[[280.0, 43.0], [340.0, 41.0]]", "\"x\"");
    assert!(text.contains("a number, or a table of pairs"), "{text}");
    let text = refused("hot", "temperature = 326.15", "temperature = 2500");
    assert!(text.contains("allowed: a table that covers"), "{text}");
    for base in ["[inf, 0.1]", "[nan, 0.1]", "[0.1, nan]", "[32.0, 60.0]", "[0.001, 0.06]"] {
        let text = refused("base", "base = [0.032, 0.06]", &format!("base = {base}"));
        assert!(text.contains("container.base = "), "{text}");
    }
    for radius in ["inf", "nan", "20", "0.001"] {
        let text = refused("radius", "base = [0.032, 0.06]", &format!("radius = {radius}"));
        assert!(text.contains("container.radius = "), "{text}");
    }
    let text = refused("bottom", "wall = \"y_high\"", "wall = \"y_low\"");
    assert!(text.contains("plate.wall = y_low with plate.pressure, allowed: no pressure"), "{text}");
    let floor = TEXT.replace("wall = \"y_high\"", "wall = \"floor\"").replace("[turn]\ndown = \"y_low\"", "");
    assert!(read("floor", &floor).unwrap_err().contains("plate.wall = floor with plate.pressure"));
    let lid = TEXT.replace("[lid]\npressure = 1000", "").replace("wall = \"y_high\"", "wall = \"lid\"");
    assert!(read("lid", &lid).is_ok());
    let lid = lid.replace("326.15\npressure = 1000", "326.15");
    assert!(read("no-lid", &lid).unwrap_err().contains("plate.wall = lid, allowed: a section [lid]"));
    let smooth = TEXT.replace("roughness = 3.4e-7\nhardness = 3e9", "roughness = 0");
    assert!(read("smooth", &smooth).is_ok());
    let folder = Folder::new("missing", TEXT);
    let error = BedCase::read(&folder.0.join("nowhere")).unwrap_err().to_string();
    assert!(error.contains("cannot read") && error.contains("nowhere"), "{error}");
}

#[test]
fn a_value_is_varied() {
    let folder = Folder::new("vary", TEXT);
    let case = BedCase::read(&folder.0).unwrap();
    let vary = |key: &str, value: f64| Vary { key: key.to_string(), value: value.into() };
    let varied =
        |key: &str, value: f64| case.varied(&folder.0, &vary(key, value)).map_err(|error| error.to_string());
    assert_eq!(varied("plate.temperature", 330.0).unwrap().plate().temperature, 330.0);
    let seed = Vary { key: "seed".to_string(), value: 7.into() };
    assert_eq!(case.varied(&folder.0, &seed).unwrap(), BedCase { seed: 7, ..case.clone() });
    assert!(seed.changes_packing() && vary("grains.friction", 0.5).changes_packing());
    assert!(
        !vary("gas.pressure", 1e4).changes_packing() && !vary("grains.roughness", 1e-6).changes_packing()
    );
    for key in ["plate.poisson_ratio", "grains.yield_stress"] {
        assert!(!vary(key, 0.3).changes_packing(), "{key}");
    }
    for key in ["experiment.file", "vary"] {
        assert!(varied(key, 1.0).unwrap_err().contains("allowed: a key of the bed"), "{key}");
    }
    assert!(varied("gas.accommodation", 2.0).unwrap_err().contains("gas.accommodation = 2"));
    assert!(varied("grains.colour", 1.0).unwrap_err().contains("unknown field `colour`"));
    let text = varied("glass.colour", 1.0).unwrap_err();
    assert!(text.contains("vary.key = glass.colour, allowed: a key of container, gas, grains"), "{text}");
    let text = read("vary-bad", &format!("{TEXT}\n[[vary]]\nkey = \"plate.wall\"\nvalue = 3\n")).unwrap_err();
    assert!(text.contains("vary plate.wall = 3"), "{text}");
}

#[test]
fn bad_measurements_are_refused_with_their_line() {
    let folder = Folder::new("measurements", TEXT);
    let file = folder.0.join("experiment.csv");
    let refused = |text: &str| {
        std::fs::write(&file, text).unwrap();
        let found = experiment::read(&file).map(|found| found.len());
        found.map_err(|error| error.to_string())
    };
    let head = experiment::HEADER;
    assert_eq!(refused(&format!("# a comment\n{head}\n0.01,5,20.5\n\n0.03,5,20.1\n")).unwrap(), 2);
    let text = refused(&format!("{head}\n0.01,5\n")).unwrap_err();
    assert!(text.ends_with("experiment.csv, line 2: '0.01,5', allowed: three finite numbers"), "{text}");
    assert!(
        refused("t,T\n").unwrap_err().contains("line 1: 't,T', allowed: distance_m,time_s,temperature_C")
    );
    assert!(refused(&format!("{head}\n0.01,NaN,3\n")).unwrap_err().contains("line 2"));
    std::fs::write(&file, format!("{head}\n0.02,5,20.5\n")).unwrap();
    let measured = experiment::read(&file).unwrap();
    let text = experiment::check(&file, &measured, &[0.01, 0.03]).unwrap_err().to_string();
    assert!(text.contains("distance_m = 0.02 is none of record.distances = [0.01, 0.03]"), "{text}");
}

/// The descriptions and the measurements that are shipped.
#[test]
fn the_shipped_cases_are_whole() {
    for name in ["beaulieu", "beaulieu/closed"] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases").join(name);
        let case = BedCase::read(&folder).unwrap();
        let file = folder.join(&case.experiment.as_ref().unwrap().file);
        let measured = experiment::read(&file).unwrap();
        experiment::check(&file, &measured, &case.record.distances).unwrap();
        assert_eq!(measured.len(), 216);
    }
}

/// The section `heat` and the name of the file before one description served all.
#[test]
fn former_descriptions_are_read() {
    let heat = "[heat]\ninitial_temperature = 293.15\nend = 100\noutput_every = 10\nprobes = [0.01, 0.03]\n";
    let vary = |key: &str| format!("[[vary]]\nkey = \"{key}\"\nvalue = 0.1\n");
    let (head, _) = TEXT.split_once("[time]").unwrap();
    let former = read("former", &(head.to_string() + heat + &vary("heat.tolerance"))).unwrap();
    assert_eq!(former, read("present", &(TEXT.to_string() + &vary("time.tolerance"))).unwrap());
    let folder = Folder::new("name", TEXT);
    std::fs::rename(folder.0.join(FILE), folder.0.join("elements.toml")).unwrap();
    assert_eq!(BedCase::read(&folder.0).unwrap(), read("again", TEXT).unwrap());
}
