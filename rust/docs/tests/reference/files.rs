//! Fields and files that the solver reads and writes.

use crate::cpp::source;
use crate::grains::{fields_of, structure};
use crate::set::Set;
use crate::solver::all_sources;
use crate::sources::{all, between, firsts, strings};
use std::collections::BTreeSet;

const PAGE: &str = "reference/fields.md";
const RECORD: &str = "openfoam/granularModels/runRecord/runRecord.C";
const MESH: &str = "openfoam/granularModels/runRecord/meshNumbers.C";
const FOLDER: &str = "openfoam/granularModels/runRecord/timeFolder.C";
const SETTINGS: &str = "openfoam/granularModels/granularState/granularStateSettings.C";
const SUMMARY: &str = "openfoam/msddFoam/runSummary.C";
const REGION: &str = "openfoam/granularModels/regionPolicy/regionPolicy.C";
const TABLES: &str = "openfoam/granularModels/runRecord/runTables.C";
const BOXES: &str = "openfoam/granularModels/onlineRveModel/onlineRveFile.C";
const ONLINE: &str = "openfoam/granularModels/onlineRveModel/onlineRveModel.C";
/// `msdd summary`.
const GATHERED: &str = "rust/cli/src/summary";
const SURROGATE: &str = "openfoam/granularModels/surrogateModel/surrogateModel.C";

/// Entries of JSON that a C++ source writes: `\"name\":`.
const JSON_ENTRY: &str = r#"\\"(\w+)\\":"#;

pub fn sets() -> Vec<Set> {
    let mut record = firsts(r#"writeEntry\(\s*"(\w+)""#, &source(RECORD));
    let blocks = firsts(r"beginBlock\(([^;]*)\);", &source(RECORD));
    record.extend(blocks.iter().flat_map(|block| strings(block)));
    let folder = source(FOLDER);
    record.extend(firsts(r#"text \+= "(\w+)\\n\("#, &folder));
    record.extend(firsts(r#"lastLine = "(\w+) "#, &folder));
    let settings = source(SETTINGS);
    let mut names = firsts(r#"\badd\s*\(\s*"(\w+)""#, &settings);
    names.extend(firsts(r"number\(properties_\.(\w+)\(\)\)", &settings));
    let offenders = [structure("rust/rve/src", "Offenders"), structure("rust/rve/src", "Offender")].concat();
    let counters = between(&source(ONLINE), r"::count\(\) const$", r"^\}", ONLINE);
    vec![
        fields(),
        taken_names(),
        Set::new(PAGE, "onlineRve.json", BOXES, firsts(JSON_ENTRY, &source(BOXES))),
        Set::new(PAGE, "uniform/msddFoam", RECORD, record),
        Set::new(PAGE, "settings", SETTINGS, names),
        Set::new(PAGE, "meshes", MESH, firsts(r#"result\.add\("(\w+)""#, &source(MESH))),
        Set::new(PAGE, "summary.json", SUMMARY, firsts(JSON_ENTRY, &source(SUMMARY))),
        Set::new(PAGE, "counters of models", ONLINE, firsts(r#"\{"(\w+)","#, &counters)),
        Set::new(PAGE, "tables.json", TABLES, firsts(JSON_ENTRY, &source(TABLES))),
        Set::new(PAGE, "offenders.json", REGION, firsts(JSON_ENTRY, &source(REGION))),
        Set::new(PAGE, "offenders.json", "struct Offenders, which reads it", offenders),
        fields_of(PAGE, "results/summary.json", GATHERED, "Summary"),
        fields_of(PAGE, "cases of results/summary.json", GATHERED, "CaseResult"),
        comparison(),
    ]
}

/// The entries of errors have names of their own but for the temperature, which discs have, too.
fn comparison() -> Set {
    let names = ["Comparison", "Discs", "Errors"].map(|name| structure(GATHERED, name)).concat();
    Set::new(PAGE, "comparison of results/summary.json", GATHERED, names)
}

fn fields() -> Set {
    let mut names: BTreeSet<String> = BTreeSet::new();
    for (_, text) in all_sources() {
        names.extend(firsts(r#"\bio\(\s*"(\w+)""#, &text));
        names.extend(firsts(r#"\bgiven<\w+>\(\s*"(\w+)""#, &text));
        names.extend(firsts(r#"\.reset\(found\("(\w+)"\)\)"#, &text));
        // Read or written whole; `IOobject("Kxx", ...)` without more is neither.
        let objects = r#"IOobject\s*\(\s*"(\w+)",[^;()]*(?:\([^()]*\)[^;()]*)*IOobject::AUTO_WRITE"#;
        names.extend(firsts(objects, &text));
        names.extend(firsts(r"stateNames_\(\{([^}]*)\}\)", &text).iter().flat_map(|list| strings(list)));
    }
    names.extend(state_columns().iter().map(|column| field_name(column)));
    Set::new(PAGE, "fields", "openfoam/**/*.C and the states of rust/surrogate", names)
}

/// Columns that the built-in models carry.
fn state_columns() -> Vec<String> {
    const CORE: &str = "rust/surrogate/src/increment/core.rs";
    let names = between(&crate::sources::text(CORE), r"^pub const NAMES: [^=]*= \[", r"^\];", CORE);
    strings(&names)
}

/// As `fieldName` of surrogateModel.C has it.
fn field_name(column: &str) -> String {
    let mut parts = column.split('_');
    let first = parts.next().unwrap_or_default().to_string();
    let capital = |part: &str| part[..1].to_uppercase() + &part[1..];
    parts.fold(first, |name, part| name + &capital(part))
}

/// Names that no column of a model may have, without the fields.
fn taken_names() -> Set {
    let lists = all(r"wordList names\s*\(\{([^}]*)\}\)", &source(SURROGATE));
    let own = lists.iter().flat_map(|list| strings(&list[1]));
    let fields = fields().names;
    Set::new(PAGE, "names that are taken", SURROGATE, own.filter(|name| !fields.contains_key(name)))
}
