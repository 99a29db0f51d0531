//! README, book and READMEs of this checkout.

use super::found;
use msdd_docs::{commands, fill, links, math, pages, print};
use std::path::{Path, PathBuf};

pub fn root() -> PathBuf {
    pages::checkout(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap()
}

#[test]
fn every_number_is_the_one_in_the_results() {
    let wrong = found(fill::fill(&root(), &pages::all(&root()).unwrap(), true));
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_equation_parses_and_of_every_block_of_commands_it_is_said_whether_it_is_run() {
    let mut wrong = Vec::new();
    for file in pages::all(&root()).unwrap().into_iter().filter(|file| file.starts_with(pages::BOOK)) {
        let page = print::page(&root(), &file).unwrap();
        wrong.extend(found(math::with_mathml(&page)));
        wrong.extend(found(commands::script(&page, true)));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_link_and_path_leads_somewhere_and_every_page_is_in_the_table_of_contents() {
    let wrong = found(links::check(&root(), &pages::all(&root()).unwrap()));
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn figures_of_the_book_are_those_of_the_case() {
    for name in ["stress.svg", "displacement.svg"] {
        let [book, case] = ["docs/src/quality", "cases/HC"]
            .map(|folder| std::fs::read(root().join(folder).join(name)).unwrap());
        assert!(book == case, "docs/src/quality/{name} is not cases/HC/{name}: copy it");
    }
}

#[test]
fn the_report_behind_the_numbers_is_whole() {
    let results = msdd_docs::results::Results::read(&root()).unwrap();
    let jobs: usize = results.value("report.jobs").unwrap().value.replace('\u{a0}', "").parse().unwrap();
    assert!(jobs > 500, "{jobs} jobs");
}
