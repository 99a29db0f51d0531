//! Links, anchors, paths and the table of contents.

use super::{checkout, found};
use msdd_docs::{links, pages};

const SUMMARY: (&str, &str) =
    ("docs/src/SUMMARY.md", "# Summary\n\n- [One](one.md)\n  - [Two](deep/two.md)\n");
const ONE: (&str, &str) =
    ("docs/src/one.md", "# One\n\n## A heading: `code`, a?\n\n## Twice\n\n## Twice\n\n<a id=\"mark\"></a>\n");

/// What is found with this text on the second page.
fn with(name: &str, text: &str) -> Vec<String> {
    let readme = ("README.md", "[book](docs/src/one.md#one)\n");
    let files = [SUMMARY, ONE, ("rust/dem/src/law.rs", ""), ("docs/src/deep/two.md", text), readme];
    let root = checkout(name, &files);
    found(links::check(&root, &pages::all(&root).unwrap()))
}

#[test]
fn good_links_anchors_and_paths_pass() {
    let text = "# Two\n\n[a](../one.md) [b](../one.md#a-heading-code-a) [c](#two) [d](../one.md#twice-1) [e](../one.md#mark) \
                [f](https://example.org/none) [g](../rustdoc/msdd_dem/index.html) [h](../msdd.h.html)\n\n`rust/dem/src/law.rs`, \
                `rust/dem/src/*.rs`, `rust/dem/`, `rust/dem/src/law.rs:12`, `rust/dem --flag`, `cases/<case>/none`, `cases/H/postProcessing/0`, \
                `other/none`, `cases/mine/0/T`\n\n```\nrust/none\ncp -r cases/H cases/mine\n```\n";
    assert_eq!(with("good", text), [""; 0]);
}

#[test]
fn each_bad_one_is_named_with_its_place() {
    for (name, text, message) in [
        ("missing", "[a](../none.md)", "leads to docs/src/none.md, which is missing"),
        ("anchor", "[a](../one.md#none)", "docs/src/one.md has no heading '#none'"),
        ("own-anchor", "[a](#none)", "docs/src/deep/two.md has no heading '#none'"),
        ("third", "[a](../one.md#twice-2)", "has no heading '#twice-2'"),
        ("outside-book", "[a](../../../README.md)", "leads out of docs/src"),
        ("outside", "[a](../../../../README.md)", "leads out of the checkout"),
        ("image", "![a](none.svg)", "leads to docs/src/deep/none.svg"),
        ("rustdoc", "[a](../rustdoc/msdd_none/index.html)", "rustdoc has no crate msdd_none"),
        ("path", "`rust/dem/src/none.rs`", "`rust/dem/src/none.rs` is named"),
        ("path-command", "`scripts/none --quick`", "`scripts/none` is named"),
        ("path-star", "`rust/*/none`", "`rust/*/none` is named"),
    ] {
        let wrong = with(&format!("bad-{name}"), &format!("# Two\n\n{text}\n"));
        let named = wrong.len() == 1 && wrong[0].starts_with("docs/src/deep/two.md:3: ");
        assert!(named && wrong[0].contains(message), "{wrong:?}");
    }
}

#[test]
fn the_table_of_contents_and_the_pages_are_the_same() {
    let extra = ("docs/src/three.md", "# Three\n\n[a listed page that is missing](deep/two.md)\n");
    let root = checkout("contents", &[SUMMARY, ONE, extra]);
    let wrong = found(links::check(&root, &pages::all(&root).unwrap()));
    assert_eq!(
        wrong,
        [
            "docs/src/SUMMARY.md:4: the link 'deep/two.md' leads to docs/src/deep/two.md, which is missing",
            "docs/src/three.md:1: SUMMARY.md does not list this page, so the book leaves it out",
        ]
    );
}
