//! README, book and READMEs of this checkout.

use super::found;
use msdd_docs::pages::Page;
use msdd_docs::{commands, fill, links, math, pages};
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
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
        let page = Page::read(&root(), &file).unwrap();
        wrong.extend(found(math::with_mathml(&page)));
        wrong.extend(found(commands::script(&page, true)));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What is wrong with links: in the table of contents, and elsewhere.
fn wrong_links() -> (Vec<String>, Vec<String>) {
    let wrong = found(links::check(&root(), &pages::all(&root()).unwrap()));
    wrong.into_iter().partition(|line| line.starts_with(pages::SUMMARY))
}

#[test]
fn every_link_and_path_leads_somewhere() {
    let wrong = wrong_links().1;
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
#[ignore = "until all chapters are written"]
fn every_page_of_the_contents_is_there() {
    let wrong = wrong_links().0;
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
