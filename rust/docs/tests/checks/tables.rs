//! What the sources of columns, keys and the Python package print, and that every marker of the book can be printed.

use super::checkout;
use super::repository::root;
use msdd_docs::print::{page, text};
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
const KEYS: &str = "class keyTable; // keyTable no (\"no\", {})\nstatic const keyTable a::keys(\"walls\", // in the book\n{\n\
    {\"slip\", \"way \\\"s\\\" of\"\n\" grains\", \"m\", \"2e-7 r to 2 r\", \"13 r\", \"rigid or shell\"},\n\
    {\"kind\", \"\", \"-\", \"one, two\", \"two\"}\n});\nkeys.number(dict, \"slip\", '\"', 1);\n";

#[test]
fn sources_are_printed_with_units_ranges_and_defaults() {
    let rust = [("rust/b/box.rs", BEDS), ("rust/b/way.rs", WAYS), ("rust/b/rows.rs", COLUMNS)];
    let others = [("rust/python/msdd/_wall.py", MODULE), ("openfoam/keys.C", KEYS)];
    let root = checkout("printed", &[&rust[..], &others].concat());
    for (call, wanted) in [
        ("structs rust/b/box.rs Box", "| `wide` | Width of the box at the start | m | 1e-12 to 10 | 0.5 |"),
        ("structs rust/b/box.rs Box", "| `way` | How it closes | – | `all_sides`, `one_side` | `one_side` |"),
        ("structs rust/b/box.rs Box", "| `lid` | Its lid | – | – | no lid |"),
        ("structs rust/b/box.rs Box", "| `seed` | Seed | – | – | required |"),
        ("structs rust/b/way.rs Way", "| `all_sides` | At once |\n| `one_side` | Along x |\n"),
        ("structs rust/b/box.rs Bowl", "rust/b/box.rs: no struct Bowl"),
        ("columns rust/b/rows.rs ROWS", "| `time` | s | time |\n| `p` | – | p/E* |\n"),
        ("columns rust/b/rows.rs LINES", "rust/b/rows.rs: no columns LINES"),
        ("python load", "### load\n\n`load(path, kind=None)` → `Wall`\n\nLoads a wall.\n"),
        ("python load", "| `path` | `str or path` | – | of the file |"),
        ("python load", "| `kind` | `str` | `None` | \"a\" or &lt;b> |"),
        ("python load", "Raises `FileError` for a file that is missing.\n"),
        ("python load Wall", "### Wall\n\n`Wall(friction=0.3)`\n\nA wall.\n"),
        ("python Wall", "| `friction` | `float` | `0.3` | at the wall [-], 0 to 10 |"),
        ("python table FileError", "| `FileError` | `OSError` | No file. |\n"),
        ("python save", "rust/python/msdd has no save"),
        ("keys walls", "| `slip` | of `rigid`, `shell`: way \"s\" of grains | m | 2e-7 r to 2 r | 13 r |\n"),
        ("keys walls", "| `kind` |  | – | `one`, `two` | `two` |\n"),
    ] {
        let (source, argument) = call.split_once(' ').unwrap();
        let printed = text(&root, source, argument).unwrap_or_else(|error| error.to_string());
        assert!(printed.contains(wanted), "{wanted}\n{printed}");
    }
}

/// In this checkout.
#[test]
fn the_page_of_the_package_has_every_public_name_once() {
    let page = |name: &str| page(&root(), &Path::new("docs/src/reference").join(name)).unwrap().text;
    let python = page("python.md");
    let init = std::fs::read_to_string(root().join("rust/python/msdd/__init__.py")).unwrap();
    let names = init.split_once("__all__ = [").unwrap().1.split_once(']').unwrap().0;
    for name in names.split('"').skip(1).step_by(2) {
        let places = [format!("\n### {name}\n"), format!("\n| `{name}` |")];
        assert_eq!(places.map(|place| python.matches(&place).count()).iter().sum::<usize>(), 1, "{name}");
    }
    for (name, row) in [
        ("commands", "| `constant`, `paper`, `increment`, `spheres` | `increment` |"),
        ("commands", "| – | required |"),
        (
            "beds",
            "| `friction` | Coefficient of friction of two grains | – | 0 to 10; by the solver 0.1 to 0.5 | 0.3 |",
        ),
        ("database", "| `wall_slip` | m | way of bottom and top along x since the packed state |"),
        ("scenes", "| `end` | End of the run | s | 1e-9 to 1e12 | required |"),
    ] {
        assert!(page(&format!("{name}.md")).contains(row), "{name}: {row}");
    }
}
