//! Functions, structures and constants of `msdd.h`.

use crate::set::{Cell, Set};
use crate::sources::{all, firsts, text};

const PAGE: &str = "reference/c-interface.md";
const HEADER: &str = "rust/capi/include/msdd.h";
const STRUCTURES: [&str; 10] = [
    "msdd_material",
    "msdd_batch",
    "msdd_initial",
    "msdd_sphere_material",
    "msdd_sphere_wall",
    "msdd_sphere_batch",
    "msdd_averages",
    "msdd_plugin_start",
    "msdd_plugin_step",
    "msdd_plugin_v2",
];
/// Beginnings of the functions' names, and the table that has them.
const GROUPS: [(&str, &str); 6] = [
    ("msdd_surrogate_", "functions of models"),
    ("msdd_spheres_", "functions of spheres"),
    ("msdd_rve_", "functions of boxes"),
    ("msdd_database_", "functions of databases"),
    ("msdd_plugin_", "functions of plug-ins"),
    ("msdd_", "functions of the library"),
];

pub fn sets() -> Vec<Set> {
    let header = text(HEADER);
    let header: String =
        all(r"(?s)/\*.*?\*/|([^/]+|/)", &header).into_iter().map(|found| found[1].clone()).collect();
    let mut sets = vec![constants(&header)];
    sets.extend(["msdd_status", "msdd_outcome"].map(|name| enumeration(&header, name)));
    sets.extend(functions(&header));
    sets.push(function_types(&header));
    let found = firsts(r"(?s)typedef struct (\w+) \{", &header);
    for name in &found {
        assert!(
            STRUCTURES.contains(&name.as_str()),
            "{HEADER}: structure {name} is new: add a table to {PAGE}"
        );
    }
    sets.extend(STRUCTURES.iter().map(|name| structure(&header, name)));
    sets
}

fn constants(header: &str) -> Set {
    let names =
        firsts(r"(?m)^#define (MSDD_[A-Z_]+)[ \n]", header).into_iter().filter(|name| name != "MSDD_H");
    let mut set = Set::new(PAGE, "constants", HEADER, names);
    for found in all(r"(?m)^#define (MSDD_\w+) (\d+)u$", header) {
        set = set.with(&found[1], "value", Cell::Text(found[2].clone()));
    }
    set
}

fn enumeration(header: &str, name: &str) -> Set {
    let body = &firsts(&format!(r"(?s)enum {name} \{{(.*?)\}};"), header)[0];
    let entries = all(r"(MSDD_\w+) = (\d+)", body);
    let mut set = Set::new(PAGE, name, HEADER, entries.iter().map(|entry| entry[1].clone()));
    for entry in entries {
        set = set.with(&entry[1], "value", Cell::Text(entry[2].clone()));
    }
    set
}

/// Every function stands in the table of the first group that its name begins with.
fn functions(header: &str) -> Vec<Set> {
    let declaration = r"(?m)^(?:MSDD_PLUGIN_EXPORT )?((?:const )?\w+ \*?)(msdd_\w+)\(([^;]*)\);";
    let found = all(declaration, header);
    let set = |(k, (begin, table)): (usize, &(&str, &str))| {
        let earlier = |name: &str| GROUPS[..k].iter().any(|(other, _)| name.starts_with(other));
        let mine = found.iter().filter(|f| f[2].starts_with(begin) && !earlier(&f[2]));
        let mut set = Set::new(PAGE, table, HEADER, mine.clone().map(|f| f[2].clone()));
        for f in mine {
            set = set.with(&f[2], "returns", Cell::Text(f[1].clone()));
            set = set.with(&f[2], "arguments", Cell::Text(f[3].clone()));
        }
        set
    };
    GROUPS.iter().enumerate().map(set).collect()
}

fn function_types(header: &str) -> Set {
    let found = all(r"typedef (\w+) \(\*(\w+)\)\(([^)]*)\);", header);
    let mut set = Set::new(PAGE, "types of functions", HEADER, found.iter().map(|f| f[2].clone()));
    for f in found {
        set = set.with(&f[2], "returns", Cell::Text(f[1].clone()));
        set = set.with(&f[2], "arguments", Cell::Text(f[3].clone()));
    }
    set
}

/// Fields of a structure, functions among them.
fn structure(header: &str, name: &str) -> Set {
    let body = &firsts(&format!(r"(?s)typedef struct {name} \{{(.*?)\}} {name};"), header)[0];
    let fields = all(r"(?s)\(\*(\w+)\)\([^;]*\);|(\w+);", body);
    let names =
        fields.into_iter().map(|found| if found[1].is_empty() { found[2].clone() } else { found[1].clone() });
    Set::new(PAGE, &format!("struct {name}"), HEADER, names)
}
