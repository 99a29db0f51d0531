//! Modules form layers: in no crate do two modules use each other, directly or through others. So a law can be read, tested
//! and replaced without the simulation that uses it.
//!
//! A module uses another when its code, tests excluded, names something that the other defines: `use crate::walls::Side;`,
//! `super::Row`, `kernel::advance`. A name that a module passes on by `pub use` counts as the defining module's; passing
//! on alone is no use. Methods that are found by their type alone are not seen.

use super::print::sources;
use regex_lite::Regex;
use std::collections::{BTreeMap, BTreeSet};

/// Of all crates by path, `case::spheres::wall`: texts of modules, or what a name stands for.
type ByPath = BTreeMap<String, String>;

fn regex(pattern: &str) -> Regex {
    Regex::new(pattern).unwrap()
}

/// Modules without comments, literals, and what `#[cfg(test)]` stands before. Files that only tests have may stay: nothing
/// else can use them. `files`: paths and texts.
fn modules(files: &[(String, String)]) -> ByPath {
    let no_code = regex(r##"//.*|(?s:/\*.*?\*/|r#".*?"#|"(?:\\.|[^"\\])*")|'(?:\\[^']+|[^\\'])'"##);
    let of_tests = regex(r"(?ms)^#\[cfg\(test\)\]\n(?:#[^\n]*\n)*[^\n]*(?:;$|\{\n.*?^\})");
    let own_file = regex("(::(lib|main|mod))?[.]rs$");
    let mut texts = ByPath::new();
    for (file, text) in files {
        let module = own_file
            .replace(&file.replace("rust/", "").replace("/src/", "::").replace('/', "::"), "")
            .into_owned();
        let text = no_code.replace_all(text, "");
        *texts.entry(module).or_default() += &of_tests.replace_all(&text, "");
    }
    texts
}

/// Paths of a tree of `use`, and the name of each.
fn tree(text: &str) -> Vec<(String, String)> {
    let (mut text, brackets) = (text.to_string(), regex(r"([\w:]+::)?\{([^{}]*)\}"));
    while let Some(found) = brackets.captures(&text) {
        let before = found.get(1).map_or("", |path| path.as_str());
        let parts: Vec<String> = found[2].split(',').map(|part| format!("{before}{}", part.trim())).collect();
        text = text.replacen(&found[0], &parts.join(","), 1);
    }
    let parts = text.split(',').map(|part| part.trim().replace("::self", ""));
    parts
        .map(|part| {
            (part.split(" as ").next().unwrap().into(), part.rsplit([' ', ':']).next().unwrap().into())
        })
        .collect()
}

/// A path from the root of its crate; None when it begins in another one.
fn from_root(module: &str, path: &str, known: &ByPath) -> Option<String> {
    let above = |path: &str| path.rsplit_once("::").map(|(above, _)| above.to_string());
    let mut parts = path.split("::");
    let begin = match parts.next()? {
        "crate" => module.split("::").next()?.to_string(),
        "self" => module.to_string(),
        "super" => above(module)?,
        name => known.get(name)?.clone(),
    };
    parts.try_fold(begin, |at, part| if part == "super" { above(&at) } else { Some(format!("{at}::{part}")) })
}

/// The module that defines what is named: up the path to a module, and on where a name is passed on.
fn home(texts: &ByPath, passed_on: &ByPath, path: &str) -> String {
    let ends = [path.len()].into_iter().chain(path.rmatch_indices("::").map(|(end, _)| end));
    for end in ends {
        if texts.contains_key(&path[..end]) {
            return path[..end].to_string();
        }
        if let Some(target) = passed_on.get(&path[..end]) {
            return home(texts, passed_on, &format!("{target}{}", &path[end..]));
        }
    }
    panic!("{path}: no such module")
}

/// Which module uses which, as lines: those on circles, and between circles.
fn circles(files: &[(String, String)]) -> Vec<String> {
    let texts = modules(files);
    let [uses, paths] = [r"(\bpub(?:\([^)]*\))? )?\buse ([^;]+);", r"\b\w+(?:::\w+)+"].map(regex);
    let (mut named, mut passed_on) = (BTreeSet::new(), ByPath::new());
    for (module, text) in &texts {
        let below =
            |path: &String| Some((path.strip_prefix(module)?.strip_prefix("::")?.to_string(), path.clone()));
        let mut known: ByPath = texts.keys().filter_map(below).collect();
        for found in uses.captures_iter(text) {
            for (path, name) in tree(&found[2]) {
                let Some(path) = from_root(module, &path, &known) else { continue };
                if found.get(1).is_some() && path.starts_with(&format!("{module}::")) {
                    passed_on.insert(format!("{module}::{name}"), path);
                } else {
                    known.insert(name, path.clone());
                    named.insert((module, path));
                }
            }
        }
        let code = uses.replace_all(text, "");
        named.extend(
            paths.find_iter(&code).filter_map(|p| Some((module, from_root(module, p.as_str(), &known)?))),
        );
    }
    let edges = named.into_iter().map(|(module, path)| (module.clone(), home(&texts, &passed_on, &path)));
    let mut edges: BTreeSet<(String, String)> = edges.filter(|(from, to)| from != to).collect();
    loop {
        let before = edges.clone();
        let [using, used]: [BTreeSet<_>; 2] =
            [before.iter().map(|e| &e.0).collect(), before.iter().map(|e| &e.1).collect()];
        edges.retain(|(from, to)| using.contains(to) && used.contains(from));
        if edges.len() == before.len() {
            return edges.iter().map(|(from, to)| format!("{from} uses {to}")).collect();
        }
    }
}

#[test]
fn no_crate_has_a_circle_of_modules() {
    let files = sources(&["rust/*/src/*"]);
    let wrong = circles(&files);
    assert!(
        files.len() > 300 && wrong.is_empty(),
        "{} files; on circles:\n{}",
        files.len(),
        wrong.join("\n")
    );
}

#[test]
fn circles_are_found_and_tests_and_passing_on_are_no_use() {
    let circles = |kernel: &str, motion: &str| {
        let files = [
            ("rust/a/src/lib.rs", "pub mod law; mod kernel; pub use kernel::Simd;"),
            ("rust/a/src/law.rs", "use crate::{Simd, kernel::{self as loops}}; fn f() { loops::run() }"),
            ("rust/a/src/kernel/mod.rs", kernel),
            ("rust/a/src/kernel/motion.rs", motion),
        ];
        circles(&files.map(|(file, text)| (file.to_string(), text.to_string())))
    };
    let kernel = "mod motion; pub(crate) use motion::{Motion, run}; pub struct Simd;";
    let found = circles(kernel, "fn f() -> impl Sized + use<'a> { g!(super::super::law::f()); } fn run() {}");
    assert_eq!(found, ["a::kernel::motion uses a::law", "a::law uses a::kernel::motion"]);
    let tests = "// crate::law\n#[cfg(test)]\nmod tests {\nuse crate::law;\n}";
    assert_eq!(circles(kernel, tests), [""; 0]);
}
