//! The committed databases: what `msdd database check` found, and when they were made.

use crate::error::DocsError;
use crate::gather::json::{INPUTS, Json};
use crate::gather::print::grouped;
use crate::results::Section;
use std::path::Path;

/// Name, what is in it.
const DATABASES: [(&str, &str); 4] = [
    ("periodic", "periodic boxes"),
    ("full", "boxes between walls, as in the paper"),
    ("paths", "periodic boxes on paths of strain, there and back and around"),
    ("front", "periodic boxes as layers of a bed that a front of temperature passes"),
];

/// # Errors
/// Files that are missing or lack an entry.
pub fn section(root: &Path) -> Result<Section, DocsError> {
    let mut section = Section::default();
    let mut rows = Vec::new();
    for (name, words) in DATABASES {
        let file = format!("{INPUTS}/check_{name}.txt");
        let text = msdd_files::read_text(&root.join(&file))?;
        let line = |begin: &str| text.lines().find_map(|line| line.strip_prefix(begin)).map(str::trim);
        let missing =
            |what: &str| DocsError::Json { file: file.clone().into(), text: format!("'{what}' is missing") };
        let count = line("exact laws: hold on all")
            .and_then(|rest| rest.split_whitespace().next()?.parse::<f64>().ok());
        let count = grouped(count.ok_or_else(|| missing("exact laws: hold on all … rows"))?);
        let provenance = Json::read(root, &format!("cases/database/{name}.provenance.json"))?;
        let commit: String = provenance.text("/commit")?.chars().take(7).collect();
        let meaning = format!("states in the database of {words}");
        section.number(&format!("{name}.rows"), count.clone(), "1", &meaning, "msdd database check");
        rows.push(vec![format!("`cases/database/{name}.csv.gz`"), words.to_string(), count, commit]);
    }
    let columns = ["database", "what", "states, all of which pass the exact laws", "made with commit"];
    section.add_table(
        "databases",
        "the committed databases",
        "msdd database check; provenance",
        &columns,
        rows,
    );
    Ok(section)
}
