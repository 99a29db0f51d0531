//! What is printed into pages, and what pages hold by hand of the sources.

use super::found;
use super::repository::root;
use msdd_docs::pages::Page;
use msdd_docs::print::{self, expanded, header};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

#[test]
fn a_marker_becomes_what_its_source_prints_and_lines_stay_those_of_the_page() {
    let page = Page::new("docs/src/a.md", "# A\n\n<!-- print: commands -->\n\nEnd.\n");
    let page = expanded(&root(), &page).unwrap();
    let (_, train) = page.text.split_once("\n### msdd train\n").unwrap();
    let row = |option: &str| train.lines().find(|line| line.starts_with(&format!("| `{option}"))).unwrap();
    assert!(
        row("--model").ends_with("| `constant`, `paper`, `increment`, `spheres` | `increment` |"),
        "{}",
        row("--model")
    );
    assert!(row("--out FILE").ends_with("| – | required |"), "{}", row("--out FILE"));
    let slurm = page.text.split_once("\n### msdd database slurm\n").unwrap().1;
    assert!(slurm.contains("--wait` | 1 to 3600 | `10` |"), "the range of a parser");
    let line = |text: &str| page.line(page.text.find(text).unwrap());
    assert_eq!([line("# A"), line("### msdd train"), line("End.")], [1, 3, 5]);
}

#[test]
fn what_cannot_be_printed_is_named_with_page_and_line() {
    for (marker, message) in [
        (
            "<!-- print: nonsense a -->",
            "docs/src/a.md:3: nothing is printed from 'nonsense', allowed: columns, commands, ",
        ),
        ("<!-- print: commands train -->", "docs/src/a.md:3: 'train': all commands are printed"),
        (
            "<!-- print: header nonsense -->",
            "docs/src/a.md:3: rust/capi/include/msdd.h has no section 'nonsense', allowed: library, ",
        ),
        ("<!-- print: scripts scripts/none -->", "docs/src/a.md:3: cannot read "),
        (
            "Text <!-- print: commands -->",
            "docs/src/a.md:3: a line <!-- print: SOURCE ARGUMENT --> holds nothing else",
        ),
    ] {
        let wrong = found(expanded(&root(), &Page::new("docs/src/a.md", format!("# A\n\n{marker}\n"))));
        assert!(wrong.len() == 1 && wrong[0].starts_with(message), "{wrong:?}");
    }
}

/// A new section of the header needs a marker on the page.
#[test]
fn every_function_and_structure_of_the_header_is_on_its_page() {
    let text = fs::read_to_string(root().join(header::FILE)).unwrap();
    let page = print::page(&root(), Path::new("docs/src/reference/c-interface.md")).unwrap().text;
    let declared =
        text.lines().filter(|line| !line.starts_with([' ', '/', '#'])).flat_map(|line| words(line, "msdd_"));
    let missing: Vec<&str> = declared.filter(|name| !page.contains(&format!("\n### {name}\n"))).collect();
    assert!(
        missing.is_empty()
            && page.contains("| `young_modulus` | `double` | E of the grains [Pa], 1e-9 to 1e15 |"),
        "{missing:?}"
    );
}

/// How variables are read.
const READ: [&str; 8] = [
    "var(\"MSDD_",
    "var_os(\"MSDD_",
    "getEnv(\"MSDD_",
    "getenv(\"MSDD_",
    "environ.get(\"MSDD_",
    "environ[\"MSDD_",
    "${MSDD_",
    "$MSDD_",
];

/// What a line of a comment or docstring begins with.
const COMMENT: [&str; 3] = ["//", "#", "\"\"\""];

/// Variables are read at many places in four languages, so their table is written by hand, unless the head of a script says
/// it. A variable that a test alone reads is explained by a comment of the file that reads it.
#[test]
fn every_environment_variable_of_this_project_is_on_the_page_or_explained_by_its_test() {
    let page = print::page(&root(), Path::new("docs/src/reference/commands.md")).unwrap().text;
    let mut missing = BTreeSet::new();
    for (path, text) in ["rust", "openfoam", "scripts", "tests", "cases"]
        .iter()
        .flat_map(|folder| sources(&root().join(folder)))
    {
        let path = path.trim_start_matches(&root().display().to_string()).to_string();
        let test = path.contains("/tests/") || path.contains("_tests.");
        let comments = text.lines().filter(|line| COMMENT.iter().any(|begin| line.trim().starts_with(begin)));
        let comments: String = comments.filter(|_| test).collect();
        for before in READ {
            let quoted = text.split(before).skip(1);
            let names = quoted
                .filter_map(|rest| words(&format!("MSDD_{rest}"), "MSDD_").first().map(ToString::to_string));
            missing.extend(
                names
                    .filter(|name| !page.contains(&format!("`{name}`")) && !comments.contains(name.as_str()))
                    .map(|name| format!("{path}: {name}")),
            );
        }
    }
    assert!(missing.is_empty(), "{missing:?}");
}

/// The names in code that the table of symbols gives are words of the sources.
#[test]
fn symbols_have_their_names_in_the_code() {
    let page = Page::read(&root(), Path::new("docs/src/theory/symbols.md")).unwrap().text;
    let sources: Vec<(String, String)> =
        ["rust", "openfoam", "cases"].iter().flat_map(|folder| sources(&root().join(folder))).collect();
    let known: BTreeSet<&str> = sources.iter().flat_map(|(_, text)| words(text, "")).collect();
    let names = page.lines().filter(|line| line.starts_with("| ")).filter_map(|line| line.rsplit('|').nth(1));
    let quoted = names.flat_map(|cell| cell.split('`').skip(1).step_by(2));
    let strange: Vec<&str> =
        quoted.flat_map(|name| name.split(['.', ' '])).filter(|name| !known.contains(name)).collect();
    assert!(strange.is_empty(), "{strange:?}");
}

fn words<'a>(text: &'a str, begin: &str) -> Vec<&'a str> {
    let words = text.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    words.filter(|word| !word.is_empty() && word.starts_with(begin)).collect()
}

/// Paths and texts of the files below a folder, but for what is built or written by runs, and this crate.
fn sources(folder: &Path) -> Vec<(String, String)> {
    const OTHERS: [&str; 6] = ["target", "lnInclude", "platforms", "results", "postProcessing", "docs"];
    let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    if folder.is_dir() {
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let kept = !OTHERS.contains(&name.as_str());
        return entries.filter(|_| kept).flat_map(|path| sources(&path)).collect();
    }
    let wanted = [".rs", ".C", ".H", ".h", ".hpp", ".py", ".sh"].iter().any(|ending| name.ends_with(ending));
    let text = (wanted || !name.contains('.')).then(|| fs::read_to_string(folder).ok()).flatten();
    text.map(|text| (folder.display().to_string(), text)).into_iter().collect()
}
