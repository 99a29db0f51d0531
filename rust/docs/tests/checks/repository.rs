//! README, book and READMEs of this checkout.

use super::found;
use msdd_docs::{commands, fill, links, math, pages, print};
use std::path::{Path, PathBuf};

pub fn root() -> PathBuf {
    pages::checkout(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap()
}

#[test]
fn numbers_links_paths_equations_and_comments_of_commands_are_right() {
    let all = pages::all(&root()).unwrap();
    let mut wrong = found(fill::fill(&root(), &all, true));
    wrong.extend(found(links::check(&root(), &all)));
    for file in all.into_iter().filter(|file| file.starts_with(pages::BOOK)) {
        let page = print::page(&root(), &file).unwrap();
        wrong.extend(found(math::with_mathml(&page)));
        wrong.extend(found(commands::script(&page, true)));
    }
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
