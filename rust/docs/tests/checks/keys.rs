//! Tables of keys and columns that the solver's sources declare.

use super::repository::root;
use msdd_docs::print::keys::tables;
use std::collections::BTreeSet;

#[test]
fn every_table_of_the_sources_is_complete_and_printed_on_one_page() {
    let pages = std::fs::read_dir(root().join("docs/src/reference")).unwrap();
    let text: String = pages.map(|page| std::fs::read_to_string(page.unwrap().path()).unwrap()).collect();
    for (table, entries) in tables(&root()).unwrap() {
        let count = text.matches(&format!("<!-- print: keys {table} -->")).count();
        assert_eq!(count, 1, "keyTable '{table}' is printed {count} times");
        let lengths = if entries.iter().any(|entry| entry.len() > 3) { 5..=6 } else { 3..=3 };
        let mut names = BTreeSet::new();
        for entry in entries {
            let complete = lengths.contains(&entry.len()) && entry.iter().all(|text| !text.is_empty());
            assert!(complete && names.insert(entry[0].clone()), "{table}: not whole, or twice: {entry:?}");
        }
    }
}
