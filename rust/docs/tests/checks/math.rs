//! Equations as MathML.

use super::found;
use msdd_docs::math::{preprocess, with_mathml};
use msdd_docs::pages::Page;
use serde_json::{Value, json};
use std::path::Path;

fn made(text: &str) -> Result<String, msdd_docs::DocsError> {
    with_mathml(&Page::new("docs/src/a.md", text))
}

#[test]
fn equations_become_mathml_in_lines_or_blocks_and_code_and_prices_stay() {
    let text = made("The $a_1 * b_2$ of `$x$` for \\$5.\n\n    $y$\n\n$\\Bigl( x$\n").unwrap();
    let (equation, rest) = text.strip_prefix("The <math").unwrap().split_once("</math>").unwrap();
    assert!(rest.starts_with(" of `$x$` for \\$5.\n\n    $y$\n\n<math"), "{text}");
    assert!(
        equation.contains("<msub>") && !equation.contains("a_1") && !equation.contains("> * <"),
        "{text}"
    );
    assert!(rest.contains("stretchy=\"true\" minsize="), "{text}");
    let text = made("Before\n$$\n\\frac{a}{b}\n= \\begin{cases} 1 & x \\\\ 2 & y \\end{cases}\n$$\nafter.\n")
        .unwrap();
    let (before, rest) = text.split_once("<div class=\"equation\">").unwrap();
    let (block, after) = rest.split_once("</div>").unwrap();
    assert!(before.ends_with("\n\n") && after.starts_with("\n\n") && !block.contains('\n'), "{text}");
    assert!(block.contains("display=\"block\"") && block.contains("<mfrac>"), "{text}");
}

#[test]
fn what_does_not_parse_is_named_with_page_and_line() {
    for (text, message) in [
        ("a\n\nb $\\frac{1}$\n", "docs/src/a.md:3: the equation '\\frac{1}' does not parse"),
        ("a\n\nb $\\nonsense$\n", "docs/src/a.md:3: the equation '\\nonsense' does not parse"),
        ("a\n\nb $x\n", "docs/src/a.md:3: a $ that belongs to no equation"),
        ("a\n\nb \\\\(x\\\\)\n", "docs/src/a.md:3: an equation between \\( and"),
    ] {
        let wrong = found(made(text));
        assert!(wrong.len() == 1 && wrong[0].starts_with(message), "{wrong:?}");
    }
}

#[test]
fn a_book_is_changed_in_all_its_chapters() {
    let chapter = |name: &str, text: &str, inner: Value| json!({"Chapter": {"name": "n", "content": text, "source_path": name, "sub_items": inner}});
    let book = |text: &str| {
        let first = chapter("a.md", "$x$", json!([chapter("deep/b.md", text, json!([]))]));
        json!([{"root": "."}, {"items": ["Separator", first]}]).to_string()
    };
    let made = preprocess(Path::new("."), &book("$y$")).unwrap();
    assert_eq!(made.matches("</math>").count(), 2, "{made}");
    assert!(made.starts_with('{') && made.contains("Separator"));
    let wrong = found(preprocess(Path::new("."), &book("a\n\n$\\nonsense$")));
    assert!(wrong.len() == 1 && wrong[0].starts_with("docs/src/deep/b.md:3: "), "{wrong:?}");
}
