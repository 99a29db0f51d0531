//! Modules form layers: in no crate do two modules use each other, directly or through others. So a law can be read, tested
//! and replaced without the simulation that uses it.
//!
//! A module uses another when its code, tests excluded, names something that the other defines: `use crate::walls::Side;`,
//! `super::Row`, `kernel::advance`. A name that a module passes on by `pub use` counts as the defining module's; passing
//! on alone is no use. Methods that are found by their type alone are not seen.

#[path = "layers/sources.rs"]
mod sources;

use sources::{Module, modules, parse};
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::path::Path;

/// Who uses whom, by the names of modules.
type Uses = BTreeMap<String, BTreeSet<String>>;

#[test]
fn no_crate_has_a_circle_of_modules() {
    let rust = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut crates = 0;
    let mut circles = Vec::new();
    for entry in std::fs::read_dir(rust).unwrap() {
        let folder = entry.unwrap().path();
        if folder.join("src").is_dir() {
            crates += 1;
            let name = folder.file_name().unwrap().to_string_lossy().into_owned();
            let found = shortest_circles(&uses(&modules(&folder.join("src"))));
            circles.extend(found.into_iter().map(|circle| format!("rust/{name}: {}", circle.join(" uses "))));
        }
    }
    assert!(crates >= 10, "{crates} crates found");
    assert!(circles.is_empty(), "modules that use each other:\n{}", circles.join("\n"));
}

/// The modules that each module uses.
fn uses(modules: &BTreeMap<Vec<String>, Module>) -> Uses {
    let name = |path: &[String]| if path.is_empty() { "crate".to_string() } else { path.join("::") };
    let mut all = Uses::new();
    for (path, module) in modules {
        let used = all.entry(name(path)).or_default();
        for named in &module.named {
            let home = home_of(modules, named, 0);
            if home != *path {
                used.insert(name(&home));
            }
        }
    }
    all
}

/// The module that defines what is named: down the tree of modules, and on where a name is passed on.
fn home_of(modules: &BTreeMap<Vec<String>, Module>, named: &[String], hops: usize) -> Vec<String> {
    let depth = (0..=named.len()).rev().find(|&n| modules.contains_key(&named[..n])).unwrap_or(0);
    let home = named[..depth].to_vec();
    let rest = &named[depth..];
    let passed_on = rest.first().and_then(|item| modules.get(&home)?.passed_on.get(item));
    match passed_on {
        Some(target) if hops < 10 => home_of(modules, &[target.as_slice(), &rest[1..]].concat(), hops + 1),
        _ => home,
    }
}

/// For each module that is on a circle, the shortest through it; a circle is told once.
fn shortest_circles(uses: &Uses) -> Vec<Vec<String>> {
    let mut told = BTreeSet::new();
    let mut circles = Vec::new();
    for start in uses.keys() {
        if told.contains(start) {
            continue;
        }
        if let Some(circle) = circle_through(uses, start) {
            told.extend(circle.iter().cloned());
            circles.push(circle);
        }
    }
    circles
}

fn circle_through(uses: &Uses, start: &String) -> Option<Vec<String>> {
    let mut from: BTreeMap<&String, &String> = BTreeMap::new();
    let mut waiting = VecDeque::from([start]);
    while let Some(module) = waiting.pop_front() {
        for next in uses.get(module)? {
            if next == start {
                let mut circle = vec![start.clone()];
                let mut at = module;
                while at != start {
                    circle.push(at.clone());
                    at = from[at];
                }
                circle.push(start.clone());
                circle.reverse();
                return Some(circle);
            }
            if !from.contains_key(next) && uses.contains_key(next) {
                from.insert(next, module);
                waiting.push_back(next);
            }
        }
    }
    None
}

fn crate_of(files: &[(&str, &str)]) -> Uses {
    let path = |name: &str| -> Vec<String> {
        name.split("::").filter(|part| !part.is_empty()).map(str::to_string).collect()
    };
    let names: BTreeSet<Vec<String>> = files.iter().map(|(name, _)| path(name)).collect();
    uses(&files.iter().map(|(name, text)| (path(name), parse(&path(name), text, &names))).collect())
}

#[test]
fn a_circle_through_a_name_that_is_passed_on_is_found() {
    let files = [
        ("", "pub mod law; mod kernel; pub use kernel::Simd;"),
        ("law", "use crate::{Simd, kernel::{self as loops}}; fn f() { loops::run() }"),
        ("kernel", "mod motion; pub(crate) use motion::{Motion, run}; pub struct Simd;"),
        ("kernel::motion", "fn f() { let x = format!(\"{}\", crate::law::f()); } pub fn run() {}"),
    ];
    let found = shortest_circles(&crate_of(&files));
    assert_eq!(found, [["kernel::motion", "law", "kernel::motion"]]);
}

#[test]
fn tests_comments_and_passing_on_are_no_use() {
    let files = [
        ("", "pub mod a; pub mod b; pub use a::A; pub use b::*;"),
        (
            "a",
            "// crate::b::B\n/// [`crate::b::B`]\npub struct A; #[cfg(test)] mod tests { use crate::b::B; }",
        ),
        (
            "b",
            "use super::A; fn f<'a>() -> impl Iterator<Item = A> + use<'a> {} const TEXT: &str = \"use crate::b::B;\";",
        ),
    ];
    let found = crate_of(&files);
    assert!(shortest_circles(&found).is_empty());
    assert_eq!(found["b"], BTreeSet::from(["a".to_string()]));
    assert!(found["a"].is_empty() && found["crate"].is_empty());
}
