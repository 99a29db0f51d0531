//! Tables of keys and columns that the solver's sources declare.

use msdd_docs::print::keys::tables;
use std::collections::BTreeSet;
use std::path::Path;

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

#[test]
fn every_table_of_the_sources_is_printed_on_one_page() {
    let pages = std::fs::read_dir(root().join("docs/src/reference")).unwrap();
    let text: String = pages.map(|page| std::fs::read_to_string(page.unwrap().path()).unwrap()).collect();
    for (name, _) in tables(root()).unwrap() {
        let count = text.matches(&format!("<!-- print: keys {name} -->")).count();
        assert_eq!(count, 1, "keyTable '{name}' is printed {count} times");
    }
}

#[test]
fn entries_are_complete() {
    for (table, entries) in tables(root()).unwrap() {
        let keys = entries.iter().any(|entry| entry.len() > 3);
        let mut names = BTreeSet::new();
        for entry in entries {
            let complete = if keys { entry.len() == 5 || entry.len() == 6 } else { entry.len() == 3 };
            assert!(complete && entry.iter().all(|text| !text.is_empty()), "{table}: {entry:?}");
            assert!(names.insert(entry[0].clone()), "{table}: {} stands twice", entry[0]);
        }
    }
}
