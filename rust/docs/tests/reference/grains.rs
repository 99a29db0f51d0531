//! Plans, databases and other files of the Rust programs.

use crate::set::{Cell, Set};
use crate::sources::{all, between, files, firsts, strings};

const PLAN: &str = "reference/plan.md";
const BEDS: &str = "reference/beds.md";
const SCENE: &str = "reference/scenes.md";
const DATABASE: &str = "reference/database.md";
const C_INTERFACE: &str = "reference/c-interface.md";
const RVE: &str = "rust/rve/src";

pub fn sets() -> Vec<Set> {
    [plan(), spheres(), database(), other_files(), scenes(), beds()].concat()
}

fn beds() -> Vec<Set> {
    const CASE: &str = "rust/beds/src/case";
    const FILES: &str = "rust/cli/src/bed/files.rs";
    let section = |table: &str, name: &str| with_required(fields_of(BEDS, table, CASE, name), CASE, name);
    let columns = |table: &str, name: &str| {
        let text = crate::sources::text(FILES);
        let list = between(&text, &format!(r"const {name}: \[&str; \d+\] ="), ";", FILES);
        Set::new(BEDS, table, FILES, strings(&list))
    };
    const SCENE: &str = "rust/beds/src/scene";
    const ROWS: &str = "rust/beds/src/rows.rs";
    let moving = |table: &str, name: &str| with_required(fields_of(BEDS, table, SCENE, name), SCENE, name);
    let text = crate::sources::text(ROWS);
    let rows = strings(&between(&text, r"const MOVING: \[&str; \d+\] =", ";", ROWS));
    vec![
        fields_of(BEDS, "moving bed", SCENE, "Scene"),
        fields_of(BEDS, "lid of moving beds", SCENE, "LidKeys"),
        moving("heated", "Heated"),
        moving("shell of moving beds", "Shell"),
        moving("time of moving beds", "Time"),
        fields_of(BEDS, "record", SCENE, "RecordKeys"),
        Set::new(BEDS, "rows of moving beds", ROWS, rows),
        fields_of(BEDS, "bed", CASE, "BedCase"),
        fields_of(BEDS, "grains of beds", CASE, "Grains"),
        fields_of(BEDS, "container", CASE, "Vessel"),
        fields_of(BEDS, "lid", CASE, "Lid"),
        section("turn", "Turn"),
        section("gas", "GasKeys").with_words(
            "name",
            "allowed",
            &variants("rust/beds/src/named_gases", "GasName"),
        ),
        fields_of(BEDS, "plate", CASE, "PlateKeys"),
        section("heat of beds", "Heat"),
        section("experiment", "ExperimentKeys"),
        section("vary", "Vary"),
        columns("temperatures of beds", "TEMPERATURE"),
        columns("comparison of beds", "COMPARISON"),
    ]
}

fn scenes() -> Vec<Set> {
    const SCENES: &str = "rust/reference/src/scenes";
    let scene = with_required(fields_of(SCENE, "scene", SCENES, "PlannedScene"), SCENES, "PlannedScene")
        .with_words("use", "allowed", &variants(SCENES, "Use"))
        .with_words("compression", "allowed", &variants(SCENES, "Closing"));
    let columns = |table: &str, file: &str, name: &str| {
        let text = crate::sources::text(file);
        let list = between(&text, &format!(r"const {name}: \[&str; \d+\] ="), ";", file);
        Set::new(SCENE, table, file, strings(&list))
    };
    let discs = "rust/reference/src/scenes/discs.rs";
    vec![
        scene,
        columns("packings of scenes", discs, "PACKING_COLUMNS"),
        columns("probes of scenes", discs, "PROBE_COLUMNS"),
        columns("windows of scenes", discs, "WINDOW_COLUMNS"),
        columns("bands of scenes", "rust/cli/src/reference/bands.rs", "COLUMNS"),
        columns("requests of scenes", "rust/cli/src/reference/requests.rs", "COLUMNS"),
        with_required(fields_of(SCENE, "plan of beds", SCENES, "PlannedBed"), SCENES, "PlannedBed")
            .with_words("use", "allowed", &variants(SCENES, "Use")),
        columns("errors of beds", "rust/cli/src/reference/beds.rs", "COLUMNS"),
    ]
}

fn plan() -> Vec<Set> {
    let ramps = variants(RVE, "RampName");
    let compressions = variants(RVE, "Compression");
    let block = with_required(fields_of(PLAN, "block", RVE, "Block"), RVE, "Block")
        .with("boundary", "default", default_variant(RVE, "Boundary"))
        .with("slide", "default", default_variant(RVE, "Slide"))
        .with_words("compressions", "allowed", &compressions)
        .with_words("boundary", "allowed", &variants(RVE, "Boundary"))
        .with_words("slide", "allowed", &variants(RVE, "Slide"));
    let paths = path_block(&compressions);
    let relaxations = variants(RVE, "Relaxation");
    let plan = with_required(fields_of(PLAN, "plan", RVE, "Plan"), RVE, "Plan")
        .with_words("relaxation", "allowed", &relaxations)
        .with("relaxation", "default", default_variant(RVE, "Relaxation"));
    let specification = fields_of(C_INTERFACE, "specification", "rust/capi/src", "Specification")
        .with_words("compression", "allowed", &compressions)
        .with_words("boundary", "allowed", &variants(RVE, "Boundary"))
        .with("boundary", "default", default_variant(RVE, "Boundary"))
        .with("relaxation", "default", default_variant(RVE, "Relaxation"))
        .with_words("relaxation", "allowed", &relaxations);
    let specification = with_defaults(specification, RVE, "PackingSpec");
    let material = fields_of(PLAN, "material", "rust/dem/src", "Material");
    let material = with_defaults(material, "rust/dem/src", "Material");
    vec![
        plan,
        block,
        paths,
        with_ranges(
            material,
            "rust/dem/src",
            r#"\("(\w+)", self\.[^"]*"([^"]*)"\)|\(\s*"(\w+)",\s*self\.[^"]*"([^"]*)",\s*\)"#,
        ),
        Set::new(PLAN, "compressions", RVE, compressions),
        Set::new(PLAN, "ramps", RVE, ramps),
        with_ranges(specification, RVE, r#"parameter\("(\w+)", [^"]*, "([^"]*)"\)()()"#),
    ]
}

/// Defaults are what functions return, ranges are constants.
fn path_block(compressions: &[String]) -> Set {
    const SOURCE: &str = "rust/rve/src/database/block.rs";
    let set = with_required(fields_of(PLAN, "path block", RVE, "PathBlock"), RVE, "PathBlock").with_words(
        "compressions",
        "allowed",
        compressions,
    );
    let set = usual(set, SOURCE, &[("step", "usual_step"), ("probe_every", "usual_probe_every")]);
    within(set, SOURCE, &[("step", "STEPS"), ("probes", "PROBES")])
}

fn spheres() -> Vec<Set> {
    const SOURCE: &str = "rust/rve/src/database/spheres/plan.rs";
    let plan = with_required(fields_of(PLAN, "sphere plan", RVE, "SpherePlan"), RVE, "SpherePlan");
    let defaults = [
        ("friction", "usual_friction"),
        ("poisson_ratio", "usual_poisson_ratio"),
        ("restitution", "usual_restitution"),
    ];
    let plan = usual(plan, SOURCE, &defaults);
    let compressions = variants(RVE, "SphereCompression");
    let block = with_required(fields_of(PLAN, "sphere block", RVE, "SphereBlock"), RVE, "SphereBlock")
        .with_words("compressions", "allowed", &compressions);
    let block = usual(block, SOURCE, &[("strain", "usual_strain"), ("step", "usual_step")]);
    let block = within(block, SOURCE, &[("strain", "STRAINS"), ("step", "STEPS")]);
    let packed = [("pressures", "PRESSURES"), ("spheres", "SPHERES")];
    vec![
        plan,
        within(block, "rust/rve/src/spheres/prepare.rs", &packed),
        Set::new(PLAN, "sphere compressions", RVE, compressions),
        Set::new(PLAN, "sphere paths", RVE, variants(RVE, "PathName")),
    ]
}

/// Defaults that functions of a source return.
fn usual(mut set: Set, source: &str, functions: &[(&str, &str)]) -> Set {
    let text = crate::sources::text(source);
    for (key, name) in functions {
        let found = firsts(&format!(r"fn {name}\(\) -> \w+ \{{\s+(\S+)\s"), &text);
        let number = found.first().and_then(|number| number.parse().ok());
        let number = number.unwrap_or_else(|| panic!("{source}: no number in {name}"));
        set = set.with(key, "default", Cell::Number(number));
    }
    set
}

/// Ranges that are constants of a source.
fn within(mut set: Set, source: &str, constants: &[(&str, &str)]) -> Set {
    let text = crate::sources::text(source);
    for (key, name) in constants {
        let found = all(&format!(r"const {name}: \[\w+; 2\] = \[(\S+), (\S+)\];"), &text);
        assert!(found.len() == 1, "{source}: {} times {name}", found.len());
        set = set.with_range(key, &format!("{} {}", found[0][1], found[0][2]).replace('_', ""));
    }
    set
}

fn database() -> Vec<Set> {
    let all_text: String =
        files(&format!("{RVE}/database"), &["rs"]).into_iter().map(|(_, text)| text).collect();
    let tables = firsts(r"CREATE TABLE (\w+)", &all_text);
    vec![
        columns_of("columns", "rust/rve/src/database/record.rs"),
        columns_of("sphere columns", "rust/rve/src/database/spheres/record.rs"),
        Set::new(DATABASE, "tables", RVE, tables),
        Set::new(DATABASE, "provenance", RVE, provenance(&all_text)),
    ]
}

/// The columns of a row, with their units.
fn columns_of(table: &str, source: &str) -> Set {
    let text = crate::sources::text(source);
    let column = r#"(?m)^    (\w+): [\w<>]+, "(?:INTEGER|REAL|TEXT)", "([^"]*)", ""#;
    let columns = Set::new(DATABASE, table, source, firsts(column, &text));
    all(column, &text)
        .into_iter()
        .fold(columns, |columns, found| columns.with(&found[1], "unit", Cell::Text(found[2].clone())))
}

/// Keys of the list that a new database begins with, and those that are inserted later, by their constants.
fn provenance(text: &str) -> Vec<String> {
    let list = between(text, r"^fn provenance<P: Recipe>\(plan", r"^\}", RVE);
    let mut keys = firsts(r#"\("(\w+)","#, &list);
    for source in ["discs.rs", "spheres/recipe.rs"] {
        let source = format!("{RVE}/database/{source}");
        let list = between(&crate::sources::text(&source), r"^    fn grains\(&self\)", r"^    \}", &source);
        keys.extend(firsts(r#"\("(\w+)","#, &list));
    }
    for found in all(r#"provenance\.insert\((?:"(\w+)"|([A-Z_]+)|[\w:]+::([A-Z_]+))\.to_string\(\)"#, text) {
        if !found[1].is_empty() {
            keys.push(found[1].clone());
            continue;
        }
        let constant =
            [&found[2], &found[3]].into_iter().find(|name| !name.is_empty()).expect("one of three");
        let value = format!(r#"const {constant}: &str = "(\w+)""#);
        keys.extend(firsts(&value, text));
    }
    keys
}

fn other_files() -> Vec<Set> {
    let state = ["File", "Bounds", "Particles", "Contacts", "Run"];
    let names = state.iter().flat_map(|name| structure("rust/rve/src/state", name));
    let of_spheres = ["File", "Box", "Particles", "Contacts", "Run"];
    let of_spheres = of_spheres.iter().flat_map(|name| structure("rust/rve/src/spheres/state", name));
    let of_spheres = of_spheres.chain(structure("rust/spheres/src/material", "Material"));
    vec![
        Set::new(DATABASE, "state file", "rust/rve/src/state.rs", names),
        Set::new(DATABASE, "state file of spheres", "rust/rve/src/spheres/state.rs", of_spheres),
        fields_of(DATABASE, "increment model", "rust/surrogate/src/increment", "File"),
        fields_of(DATABASE, "paper model", "rust/surrogate/src", "ModelFile"),
        fields_of(DATABASE, "reference results", "rust/reference/src", "Results"),
        fields_of(DATABASE, "reference model", "rust/reference/src", "Statistics"),
    ]
}

/// A table that lists the fields of one structure.
pub fn fields_of(page: &'static str, table: &str, place: &str, name: &str) -> Set {
    Set::new(page, table, &format!("struct {name} of {place}"), structure(place, name))
}

/// Names that serde gives to the fields of a structure, in the one file below a folder, or that begins so, which has it.
pub fn structure(place: &str, name: &str) -> Vec<String> {
    let body = body_of(place, &format!(r"struct {name}(?:<[^>]*>)? \{{"));
    let mut names = Vec::new();
    let mut attributes = String::new();
    for line in body.lines().map(str::trim) {
        if line.starts_with("#[") {
            attributes.push_str(line);
            continue;
        }
        let Some(field) = firsts(r"^(?:pub(?:\([^)]*\))? )?(\w+): ", line).pop() else { continue };
        let renamed = firsts(r#"rename = "(\w+)""#, &attributes).pop();
        if !attributes.contains("serde(skip)") {
            names.push(renamed.unwrap_or(field));
        }
        attributes.clear();
    }
    names
}

/// Names that serde gives to the variants of an enumeration.
fn variants(place: &str, name: &str) -> Vec<String> {
    let body = body_of(place, &format!(r"enum {name} \{{"));
    let snake = |variant: String| {
        let parts = firsts("([A-Z][a-z0-9]*)", &variant);
        parts.iter().map(|part| part.to_lowercase()).collect::<Vec<_>>().join("_")
    };
    firsts(r"(?m)^\s+([A-Z]\w*),$", &body).into_iter().map(snake).collect()
}

/// What stands between a head and the brace that ends it, in the one file that has the head.
fn body_of(place: &str, head: &str) -> String {
    let (folder, beginning) = place.rsplit_once('/').expect("a folder below rust");
    let inside =
        if crate::sources::checkout().join(place).is_dir() { (place, "") } else { (folder, beginning) };
    let pattern = format!(r"(?ms){head}\n(.*?)^\}}");
    let found: Vec<String> = files(inside.0, &["rs"])
        .into_iter()
        .filter(|(path, _)| path.starts_with(&format!("{folder}/{beginning}")))
        .flat_map(|(_, text)| firsts(&pattern, &text))
        .collect();
    assert!(found.len() == 1, "{place}: {} times {head}, 1 is needed", found.len());
    found[0].clone()
}

/// Adds the numbers and variants of `impl Default`.
fn with_defaults(mut set: Set, place: &str, name: &str) -> Set {
    let body = body_of(place, &format!(r"impl Default for {name} \{{"));
    for found in all(r"(?m)^\s+(\w+): ([^\s,]+),$", &body) {
        let default = match found[2].rsplit_once("::") {
            None => found[2].parse().ok().map(Cell::Number),
            Some((_, variant)) if variant.contains('(') => None,
            Some((_, variant)) => Some(Cell::Text(variant.to_lowercase())),
        };
        if let Some(default) = default {
            set = set.with(&found[1], "default", default);
        }
    }
    set
}

/// Adds ranges from the messages that refuse a value: a pattern of key and range, in either two of four groups.
fn with_ranges(mut set: Set, folder: &str, pattern: &str) -> Set {
    let text: String = files(folder, &["rs"]).into_iter().map(|(_, text)| text).collect();
    let found = all(pattern, &text);
    assert!(!found.is_empty(), "{folder}: no ranges for {}: have the messages another form now?", set.table);
    for range in found {
        let (key, text) = if range[1].is_empty() { (&range[3], &range[4]) } else { (&range[1], &range[2]) };
        set = set.with_range(key, text);
    }
    set
}

/// Says of keys without `#[serde(default)]` that they are required, which is none of the other defaults.
fn with_required(mut set: Set, place: &str, name: &str) -> Set {
    let body = body_of(place, &format!(r"struct {name}(?:<[^>]*>)? \{{"));
    let fields = all(r"(?m)((?:^ +#\[[^\n]*\n)*)^ +pub (\w+): ", &body);
    for field in fields.iter().filter(|field| !field[1].contains("serde")) {
        set = set.with(&field[2], "default", Cell::Begins("required"));
    }
    set
}

/// The variant that is marked as default.
fn default_variant(place: &str, name: &str) -> Cell {
    let body = body_of(place, &format!(r"enum {name} \{{"));
    let found = firsts(r"#\[default\]\s+(\w+),", &body);
    Cell::Text(found.first().unwrap_or_else(|| panic!("{name} has no default")).to_lowercase())
}

#[test]
fn structures_are_read_as_serde_does() {
    assert!(structure(RVE, "Plan").contains(&"radius_min".to_string()));
    assert!(!structure(RVE, "Plan").contains(&"text".to_string()), "text is skipped");
    assert!(structure("rust/reference/src", "Results").contains(&"box".to_string()), "size is called box");
    assert_eq!(variants(RVE, "RampName")[3..5], ["up_down", "down_up"]);
}
