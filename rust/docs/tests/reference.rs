//! The tables of the book's Reference hold what the sources have: every key, option, field, file entry, column and function,
//! none missing and none extra, with the defaults, ranges and values that stand in the sources as literals.
//!
//! A table is named by the comment `<!-- checked: NAME -->` before it. What belongs into it is read out of the sources by
//! patterns, in one module a part of the project. What a pattern cannot see stands in a list with its reason.
#![forbid(unsafe_code)]

#[path = "reference/book.rs"]
mod book;
#[path = "reference/commands.rs"]
mod commands;
#[path = "reference/cpp.rs"]
mod cpp;
#[path = "reference/files.rs"]
mod files;
#[path = "reference/grains.rs"]
mod grains;
#[path = "reference/header.rs"]
mod header;
#[path = "reference/set.rs"]
mod set;
#[path = "reference/solver.rs"]
mod solver;
#[path = "reference/sources.rs"]
mod sources;

use book::Book;
use set::{Set, problems};
use std::collections::BTreeSet;

fn hold(sets: &[Set]) {
    let book = Book::read();
    let found: Vec<String> = sets.iter().flat_map(|set| problems(&book, set)).collect();
    assert!(found.is_empty(), "{} differences\n{}", found.len(), found.join("\n"));
}

#[test]
fn keys_of_the_solver() {
    hold(&solver::sets());
}

/// Also where nothing is refused, as in controlDict: a key that is looked up stands in some table.
#[test]
fn every_key_that_is_looked_up_is_in_the_book() {
    let known: BTreeSet<String> = Book::read().tables.values().flat_map(|table| table.names()).collect();
    let missing: Vec<String> = solver::lookups()
        .into_iter()
        .filter(|(_, key)| !known.contains(key) && !solver::NO_KEYS.iter().any(|(name, _)| name == key))
        .map(|(file, key)| {
            format!("docs/src/{}: `{key}`, which {file} reads, stands in no table", solver::page_of(&file))
        })
        .collect();
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}

#[test]
fn fields_and_files() {
    hold(&files::sets());
}

#[test]
fn plans_and_databases() {
    hold(&grains::sets());
}

#[test]
fn c_interface() {
    hold(&header::sets());
}

#[test]
fn commands_and_scripts() {
    hold(&commands::sets());
}

#[test]
fn every_table_with_a_name_is_compared() {
    let sets = [solver::sets(), files::sets(), grains::sets(), header::sets(), commands::sets()].concat();
    let compared: BTreeSet<&str> = sets.iter().map(|set| set.table.as_str()).collect();
    let book = Book::read();
    let left: Vec<String> = book
        .tables
        .iter()
        .filter(|(name, _)| *name != "symbols" && !compared.contains(name.as_str()))
        .map(|(name, table)| format!("{}: '{name}' is compared with nothing", table.place))
        .collect();
    assert!(left.is_empty(), "{}", left.join("\n"));
}

/// The names in code that the table of symbols gives are words of the sources.
#[test]
fn symbols_have_their_names_in_the_code() {
    let table =
        Book::read().table("symbols").expect("docs/src/theory/symbols.md has the table 'symbols'").clone();
    let words = sources::words();
    let column = table.column("in the code").expect("a column 'in the code'");
    let strange: Vec<String> = table
        .rows
        .iter()
        .flat_map(|row| book::quoted(&row[column]))
        .flat_map(|name| name.split(['.', ' ']).map(str::to_string).collect::<Vec<_>>())
        .filter(|name| !name.is_empty() && !words.contains(name))
        .map(|name| format!("{}: `{name}` is no word of the sources", table.place))
        .collect();
    assert!(strange.is_empty(), "{}", strange.join("\n"));
}
