//! What the sources of columns, keys and the Python package print, and that every marker of the book can be printed.

use crate::checkout;
use msdd_docs::pages::Page;
use msdd_docs::print::{expanded, text};
use std::path::Path;

const BEDS: &str = "const WIDTHS: [f64; 2] = [1e-12, 10.0];\n\n/// A box.\npub struct Box {\n    /// Width of the box\n    \
    /// at the start \\[m\\]. Allowed: `WIDTHS`.\n    #[serde(default = \"usual\", rename = \"wide\")]\n    pub width: f64,\n    \
    /// How it closes.\n    #[serde(default)]\n    pub way: Way,\n    /// Its lid. Default: no lid.\n    pub lid: Option<f64>,\n    \
    /// Seed.\n    pub seed: u64,\n}\n\nfn usual() -> f64 {\n    0.5\n}\n";
const WAYS: &str =
    "pub enum Way {\n    /// At once.\n    AllSides,\n    /// Along x.\n    #[default]\n    OneSide,\n}\n";
const COLUMNS: &str = "pub const ROWS: [Column; 2] = [\n    (\"time\", \"s\", \"time\"),\n    (\n        \"p\",\n        \"-\",\n        \
    \"p/E*\",\n    ),\n];\n";
const MODULE: &str = "@dataclass(frozen=True)\nclass Wall:\n    \"\"\"A wall.\"\"\"\n\n    friction: float = 0.3\n    \
    \"\"\"at the wall [-], 0 to 10\"\"\"\n\n\ndef load(path: PathLike, kind: Optional[str] = None) -> Wall:\n    \"\"\"Loads a wall.\n\n    \
    Parameters\n    ----------\n    path\n        of the file\n    kind\n        \"a\" or <b>\n\n    Raises\n    ------\n    FileError\n        \
    for a file that is missing.\n    \"\"\"\n    return Wall()\n\n\nclass FileError(MsddError, OSError):\n    \"\"\"No file.\"\"\"\n";

#[test]
fn keys_have_their_unit_range_and_default() {
    let files =
        [("rust/beds/src/case.rs", BEDS), ("rust/beds/src/way.rs", WAYS), ("rust/beds/src/rows.rs", COLUMNS)];
    let root = checkout("structs", &files);
    let printed = text(&root, "structs", "rust/beds/src/case.rs Box").unwrap();
    for row in [
        "| `wide` | Width of the box at the start | m | 1e-12 to 10 | 0.5 |",
        "| `way` | How it closes | – | `all_sides`, `one_side` | `one_side` |",
        "| `lid` | Its lid | – | – | no lid |",
        "| `seed` | Seed | – | – | required |",
    ] {
        assert!(printed.contains(row), "{row}\n{printed}");
    }
    let names = text(&root, "structs", "rust/beds/src/way.rs Way").unwrap();
    assert!(names.ends_with("| `all_sides` | At once |\n| `one_side` | Along x |\n"), "{names}");
    let error = text(&root, "structs", "rust/beds/src/case.rs Bowl").unwrap_err().to_string();
    assert_eq!(error, "rust/beds/src/case.rs: no struct Bowl");
    let columns = text(&root, "columns", "rust/beds/src/rows.rs ROWS").unwrap();
    assert!(columns.ends_with("| `time` | s | time |\n| `p` | – | p/E* |\n"), "{columns}");
    let error = text(&root, "columns", "rust/beds/src/rows.rs LINES").unwrap_err().to_string();
    assert_eq!(error, "rust/beds/src/rows.rs: no columns LINES");
}

#[test]
fn python_has_signatures_and_docstrings() {
    let root = checkout("python", &[("rust/python/msdd/_wall.py", MODULE)]);
    let printed = text(&root, "python", "load Wall").unwrap();
    for line in [
        "### load\n\n`load(path, kind=None)` → `Wall`\n\nLoads a wall.\n",
        "| `path` | `str or path` | – | of the file |",
        "| `kind` | `str` | `None` | \"a\" or &lt;b> |",
        "Raises `FileError` for a file that is missing.\n",
        "### Wall\n\n`Wall(friction=0.3)`\n\nA wall.\n",
        "| `friction` | `float` | `0.3` | at the wall [-], 0 to 10 |",
    ] {
        assert!(printed.contains(line), "{line}\n{printed}");
    }
    let rows = text(&root, "python", "table FileError").unwrap();
    assert!(rows.ends_with("| `FileError` | `OSError` | No file. |\n"), "{rows}");
    let error = text(&root, "python", "save").unwrap_err().to_string();
    assert_eq!(error, "rust/python/msdd has no save");
}

/// In this checkout.
#[test]
fn the_page_of_the_package_has_every_public_name_once() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let page =
        expanded(&root, &Page::read(&root, Path::new("docs/src/reference/python.md")).unwrap()).unwrap();
    let init = std::fs::read_to_string(root.join("rust/python/msdd/__init__.py")).unwrap();
    let names = init.split_once("__all__ = [").unwrap().1.split_once(']').unwrap().0;
    for name in names.split('"').skip(1).step_by(2) {
        let places = page.text.matches(&format!("\n### {name}\n")).count()
            + page.text.matches(&format!("\n| `{name}` |")).count();
        assert_eq!(places, 1, "{name}");
    }
    for (page, row) in [
        ("beds", "| `friction` | Coefficient of friction of two grains | – | 0 to 10 | required |"),
        ("plan", "| `step` | Size of an increment h | – | 1e-5 to 1e-2 | 1e-3 |"),
        ("database", "| `wall_slip` | m | way of bottom and top along x since the packed state |"),
        ("scenes", "| `end` | End of the run | s | 1e-9 to 1e12 | required |"),
    ] {
        let file = format!("docs/src/reference/{page}.md");
        let page = expanded(&root, &Page::read(&root, Path::new(&file)).unwrap()).unwrap();
        assert!(page.text.contains(row), "{file}: {row}");
    }
}
