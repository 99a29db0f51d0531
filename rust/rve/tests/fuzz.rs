//! Readers of states, plans, databases, CSV and offenders are given mutated input: they must not panic, and what they
//! accept must be valid.

#[path = "common/mutations.rs"]
mod mutations;

use msdd_rve::database::{
    Dataset, Effort, Offenders, Plan, Recipe, Run, check, csv_file, export_csv, generate, read,
};
use msdd_rve::state::{from_json, to_file, to_json};
use msdd_rve::{Boundary, Material, PackingSpec, pack};
use std::ops::ControlFlow;
use std::path::Path;

const PLAN: &str = "radius_min = 3e-3\nradius_max = 7e-3\nseed = 3\n\
    [[thermal]]\ndiscs = 20\nporosities = [0.16]\ncompressions = [\"isotropic\"]\nrepeats = 2\nstops = [0.01]\n\
    [[wall_shear]]\ndiscs = 30\nporosities = [0.14]\ncompressions = [\"horizontal\"]\nrepeats = 1\nstops = [0.002]\n\
    [[paths]]\ndiscs = 30\nporosities = [0.14]\ncompressions = [\"horizontal\"]\nrepeats = 1\npaths = [\"equivalence\"]\n\
    step = 1e-3\nprobes = [1e-3]\nprobe_every = 4\n";
const OFFENDERS: &str = "{\"schema\": \"msdd-offenders-1\", \"model_hash\": \"00\", \"state_names\": [\"porosity\", \
    \"fabric_index\"], \"rows\": [{\"state\": [0.078, 0.0], \"strain\": 1e-5, \"column\": \"porosity\", \"side\": \"below\", \
    \"distance\": 0.03, \"cell\": 0, \"time\": 0.1}]}";

fn folder() -> &'static Path {
    Path::new(env!("CARGO_TARGET_TMPDIR"))
}

fn text(bytes: &[u8]) -> Option<&str> {
    std::str::from_utf8(bytes).ok()
}

/// A mutated state that is accepted, written and read again must be the same state.
#[test]
fn states() {
    let spec = PackingSpec { discs: 12, porosity: 0.16, ..PackingSpec::default() };
    let periodic = PackingSpec { boundary: Boundary::Periodic, discs: 30, ..spec };
    let corpus = [spec, periodic].map(|spec| {
        let packed = pack(&spec, &Material::default()).unwrap().simulation;
        [to_json(&packed).unwrap(), to_file(&packed).unwrap()].map(String::into_bytes)
    });
    let accepted = mutations::fuzz(("states", folder()), corpus.as_flattened(), 2000, |input| {
        let Some(Ok(state)) = text(input).map(from_json) else { return Ok(false) };
        let own = to_file(&state).map_err(|error| error.to_string())?;
        let again = from_json(&own).map_err(|error| format!("its own text is refused: {error}"))?;
        if to_file(&again).is_ok_and(|text| text == own) {
            Ok(true)
        } else {
            Err("its text changes".to_string())
        }
    });
    assert!(accepted > 4);
}

/// The same for states of spheres, between walls and in a periodic box.
#[test]
fn states_of_spheres() {
    use msdd_rve::spheres::{material, state};
    use msdd_spheres::{Boundary, Cell, Simulation, Sphere, Wall};
    let edge = 2.1;
    let places = (0..8).map(|k| [k % 2, k / 2 % 2, k / 4].map(|n| f64::from(n) * 0.98 + 0.5));
    let spheres: Vec<Sphere> = places.map(|place| Sphere::at_rest(place, 0.5, 1.0)).collect();
    let boundaries = [Boundary::Walls(Wall::block([edge; 3])), Boundary::Periodic(Cell::block([edge; 3]))];
    let corpus = boundaries.map(|boundary| {
        let mut simulation = Simulation::new(material(0.25, 0.3, 0.3), spheres.clone(), boundary).unwrap();
        simulation.spheres[0].velocity = [1e-3, 2e-3, -1e-3];
        simulation.run(100).unwrap();
        let whole = state::to_file(&simulation).unwrap();
        let mut open: serde_json::Value = serde_json::from_str(&whole).unwrap();
        open.as_object_mut().unwrap().remove("checksum");
        [whole, open.to_string()].map(String::into_bytes)
    });
    let accepted = mutations::fuzz(("sphere states", folder()), corpus.as_flattened(), 2000, |input| {
        let Some(Ok(found)) = text(input).map(state::from_json) else { return Ok(false) };
        let own = state::to_file(&found).map_err(|error| error.to_string())?;
        let again = state::from_json(&own).map_err(|error| format!("its own text is refused: {error}"))?;
        if state::to_file(&again).is_ok_and(|text| text == own) {
            Ok(true)
        } else {
            Err("its text changes".to_string())
        }
    });
    assert!(accepted > 4);
}

#[test]
fn plans() {
    let accepted = mutations::fuzz(("plans", folder()), &[PLAN.as_bytes().to_vec()], 2000, |input| {
        let Some(Ok(plan)) = text(input).map(|text| Plan::parse(text, "plan")) else { return Ok(false) };
        let sound =
            plan.jobs().iter().all(|job| job.spec.discs > 0 && job.stops.iter().all(|s| s.is_finite()));
        if sound { Ok(true) } else { Err("its packings cannot be made".to_string()) }
    });
    assert!(accepted > 10);
}

#[test]
fn csv_files() {
    let database = folder().join("fuzz-csv").join("database");
    let _ = std::fs::remove_dir_all(database.parent().unwrap());
    let plan = Plan::parse(PLAN, "plan").unwrap();
    generate(&plan, &database, &Run::default(), |_| ControlFlow::Continue(())).unwrap();
    let whole = read(&database).unwrap();
    let files = ["a.csv", "b.csv.gz"].map(|name| {
        let file = database.with_file_name(name);
        export_csv(&database, &file, None).unwrap();
        std::fs::read(file).unwrap()
    });
    let accepted = mutations::fuzz(("csv", folder()), &files, 2000, |input| {
        let Ok(records) = csv_file::records(Path::new("a.csv"), input, &[]) else { return Ok(false) };
        check::violations(&Dataset { records, provenance: whole.provenance.clone() });
        Ok(true)
    });
    assert!(accepted > 10);
}

#[test]
fn offenders() {
    let like = Plan::parse(PLAN, "plan").unwrap();
    let accepted =
        mutations::fuzz(("offenders", folder()), &[OFFENDERS.as_bytes().to_vec()], 2000, |input| {
            let Some(Ok(offenders)) = text(input).map(|text| Offenders::parse(text, "offenders")) else {
                return Ok(false);
            };
            let plan = offenders.plan(&like, Effort { discs: 20, repeats: 1 });
            plan.map(|plan| !plan.jobs().is_empty())
                .map_err(|error| format!("accepted, but no plan: {error}"))
        });
    assert!(accepted > 10);
}
