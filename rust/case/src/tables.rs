//! Tables that function objects have written, joined over the parts of a run: the one place that says which of several files is
//! that of the present run.
//!
//! A run that is killed and continued has parts. `msddFoam` lists their files in [`LIST`]. From the start of a later part on its
//! rows replace those of the parts before. Without a list, or for a function object that is not in it, each folder of a start
//! counts as a part, with the file in it that was changed last.

use crate::CaseError;
use msdd_files::{list, read_text};
use serde::Deserialize;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The solver's list of the files of a run.
pub const LIST: &str = "postProcessing/msddFoam/tables.json";
const SCHEMA: &str = "msdd-tables-1";

#[derive(Deserialize)]
struct Listed {
    schema: String,
    runs: Vec<Run>,
}

#[derive(Deserialize)]
struct Run {
    start: f64,
    files: Vec<String>,
}

/// A file of a function object: time at which its part of the run began \[s\], and its path.
pub type Part = (f64, PathBuf);

/// The rows of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The file of the last part.
    pub file: PathBuf,
    /// Its lines that begin with #.
    pub head: Vec<String>,
    /// Its rows and those of the parts before, as they were written, in the order of time.
    pub rows: Vec<String>,
}

/// The files of a function object in the parts of the run, in the order of time.
///
/// `name`: its folder in `postProcessing`, such as `probes`, or `bed/wallPressure` of a region. `file`: name of the file, such as
/// `T`; `None` if there is only one.
///
/// # Errors
/// [`CaseError::Read`], if there is none, or several and `file` is `None`.
pub fn parts(case: &Path, name: &str, file: Option<&str>) -> Result<Vec<Part>, CaseError> {
    let folder = case.join("postProcessing").join(name);
    let wrong = |problem: String| CaseError::Read { file: folder.clone(), problem };
    let mut found = listed(case, &folder)?;
    if found.is_empty() {
        found = unlisted(&folder);
    }
    let names: BTreeSet<String> = found.iter().map(|part| base(&part.1)).collect();
    let only = || names.iter().cloned().collect::<Vec<_>>();
    let wanted = match (file, names.len()) {
        (Some(file), _) => file.to_string(),
        (None, 1) => only().remove(0),
        (None, 0) => return Err(wrong("no table in it".to_string())),
        (None, _) => return Err(wrong(format!("several tables: {}", only().join(", ")))),
    };
    found.retain(|part| base(&part.1) == wanted);
    // Of files of one start the last counts: in the list by its place, without one by the time of its last change.
    found.reverse();
    found.dedup_by(|other, kept| other.0 == kept.0);
    found.reverse();
    if found.is_empty() { Err(wrong(format!("no {wanted} in it"))) } else { Ok(found) }
}

/// All tables of a case: names of function objects, of those of regions with the region, and their files.
pub fn all(case: &Path) -> Vec<(String, String)> {
    let post = case.join("postProcessing");
    let folders = |folder: &Path| -> Vec<PathBuf> {
        list(folder).unwrap_or_default().into_iter().filter(|path| path.is_dir()).collect()
    };
    let first = folders(&post);
    let inner: Vec<PathBuf> = first.iter().flat_map(|folder| folders(folder)).collect();
    let mut found = BTreeSet::new();
    for folder in first.into_iter().chain(inner) {
        let name = folder.strip_prefix(&post).unwrap_or(&folder).display().to_string();
        found.extend(unlisted(&folder).into_iter().map(|part| (name.clone(), base(&part.1))));
    }
    found.into_iter().collect()
}

/// A table of a function object; `name` and `file` as in [`parts`]. Rows from the start of a later part on are those of that
/// part.
///
/// # Errors
/// [`CaseError::Read`], also if the parts have other points or columns.
pub fn read(case: &Path, name: &str, file: Option<&str>) -> Result<Table, CaseError> {
    let mut table = Table { file: PathBuf::new(), head: Vec::new(), rows: Vec::new() };
    for (start, path) in parts(case, name, file)? {
        let text = read_text(&path)?;
        let (head, rows): (Vec<&str>, Vec<&str>) = text
            .lines()
            .filter(|line| !line.trim().is_empty())
            .partition(|line| line.trim_start().starts_with('#'));
        let head: Vec<String> = head.into_iter().map(str::to_string).collect();
        // Nothing has been written yet.
        if head.is_empty() && rows.is_empty() {
            continue;
        }
        if !table.file.as_os_str().is_empty() && columns(&head) != columns(&table.head) {
            let problem = format!("other points or columns than in {}", table.file.display());
            return Err(CaseError::Read { file: path, problem });
        }
        let first = rows.first().map_or(f64::INFINITY, |row| time(row));
        // A row without a time stays, to be refused when its numbers are read.
        let replaced = |row: &str| time(row) > start || time(row) >= first;
        table.rows.retain(|row| !replaced(row));
        table.rows.extend(rows.into_iter().map(str::to_string));
        table.head = head;
        table.file = path;
    }
    Ok(table)
}

impl Table {
    /// The names of the columns, from the last line of the head.
    pub fn columns(&self) -> Vec<&str> {
        let last = self.head.last().map_or("", |line| line.trim_start_matches(['#', ' ']));
        last.split_whitespace().collect()
    }

    /// The numbers in the rows, without brackets.
    ///
    /// # Errors
    /// [`CaseError::Read`] for a word that is no finite number.
    pub fn numbers(&self) -> Result<Vec<Vec<f64>>, CaseError> {
        let number = |word: &str, line: &str| match word.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(CaseError::Read { file: self.file.clone(), problem: format!("'{word}' in '{line}'") }),
        };
        let row = |line: &String| {
            line.replace(['(', ')'], " ").split_whitespace().map(|word| number(word, line)).collect()
        };
        self.rows.iter().map(row).collect()
    }
}

/// The files of a function object in the solver's list; none without a list.
fn listed(case: &Path, folder: &Path) -> Result<Vec<Part>, CaseError> {
    let file = case.join(LIST);
    if !file.exists() {
        return Ok(Vec::new());
    }
    let wrong = |problem: String| CaseError::Read { file: file.clone(), problem };
    let all: Listed = serde_json::from_str(&read_text(&file)?).map_err(|error| wrong(error.to_string()))?;
    if all.schema != SCHEMA {
        return Err(wrong(format!("schema '{}', allowed: {SCHEMA}", all.schema)));
    }
    let post = case.join("postProcessing");
    let paths = all.runs.iter().flat_map(|run| run.files.iter().map(|name| (run.start, post.join(name))));
    Ok(paths.filter(|part| part.1.parent().and_then(Path::parent) == Some(folder)).collect())
}

/// All files of a function object, by the folders of the starts, the file that was changed last at the end.
fn unlisted(folder: &Path) -> Vec<Part> {
    let start = |path: &Path| path.file_name()?.to_str()?.parse::<f64>().ok();
    let mut starts: Vec<Part> =
        list(folder).unwrap_or_default().into_iter().filter_map(|path| Some((start(&path)?, path))).collect();
    starts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let files = |(start, path): Part| {
        let mut files = list(&path).unwrap_or_default();
        files.retain(|file| file.is_file());
        files.sort_by_key(|file| file.metadata().and_then(|data| data.modified()).ok());
        files.into_iter().map(move |file| (start, file))
    };
    starts.into_iter().flat_map(files).collect()
}

/// The name that a file has where no other was there before: OpenFOAM adds the start to the name of a second one.
fn base(path: &Path) -> String {
    let text = |name: Option<&std::ffi::OsStr>| name.unwrap_or_default().to_string_lossy().into_owned();
    let (name, start) = (text(path.file_name()), text(path.parent().and_then(Path::file_name)));
    match name.strip_suffix(&format!("_{start}.dat")) {
        Some(stem) => format!("{stem}.dat"),
        None => name,
    }
}

/// The points and names of columns in a head, by words.
fn columns(head: &[String]) -> Vec<Vec<&str>> {
    head.iter()
        .map(|line| line.trim_start_matches(['#', ' ']).split_whitespace().collect::<Vec<_>>())
        .filter(|words| words.first().is_some_and(|word| ["Probe", "Time"].contains(word)))
        .collect()
}

/// The time of a row; NaN of one that has none.
fn time(row: &str) -> f64 {
    row.split_whitespace().next().and_then(|word| word.parse().ok()).unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Files that are written, what is read then, and what is found.
    type Step<'a> = (&'a [(&'a str, &'a str)], &'a str, Option<&'a str>, &'a str);

    #[test]
    fn tables_are_those_of_the_parts_of_a_run_by_the_list_or_the_newest_of_each_start() {
        let case = std::env::temp_dir().join(format!("msdd-case-tables-{}", std::process::id()));
        let post = case.join("postProcessing");
        msdd_files::write(&post.join("u/2/u.dat"), b"2 0\n").unwrap();
        let first = std::fs::File::options().append(true).open(post.join("u/2/u.dat")).unwrap();
        first.set_modified(std::time::SystemTime::UNIX_EPOCH).unwrap();
        let list = r#"{"schema": "msdd-tables-1", "runs": [{"start": 0, "files": ["p/0/p_0.dat", "q/0/T"]},
            {"start": 0.5, "files": ["p/0.5/p_0.5.dat"]}]}"#;
        let steps: [Step; 13] = [
            (
                &[("u/10/u.dat", "10 3\n11 3\n"), ("u/2/u_2.dat", "2 1\n3 1\n12 1\n")],
                "none",
                None,
                "no table in it",
            ),
            (&[], "u", None, "[[2.0, 1.0], [3.0, 1.0], [10.0, 3.0], [11.0, 3.0]]"),
            (&[("u/2/other.dat", "1 1\n")], "u", None, "several tables: other.dat, u.dat"),
            (&[("D/0/D", "# Probe 0 (1 2 3)\n 0.1 (1 2 3)\n")], "D", None, "[[0.1, 1.0, 2.0, 3.0]]"),
            (&[("D/1/D", "# Probe 0 (1 2 4)\n 1.1 (1 2 3)\n")], "D", None, "other points or columns"),
            (&[("D/1/D", "# Probe 0 (1 2 3)\n 1.1 (1 nan 3)\n")], "D", None, "'nan' in ' 1.1 (1 nan 3)'"),
            (&[("msddFoam/tables.json", list), ("r/0/r.dat", "# Time b\n3 1\n")], "r", None, "[[3.0, 1.0]]"),
            (
                &[("p/0/p.dat", "# Time a\n0 1\n1 1\n"), ("p/0.5/p.dat", "# Time a\n0.6 7\n")],
                "q",
                None,
                "q/0/T",
            ),
            // The last is made by postProcess
            (
                &[
                    ("p/0/p_0.dat", "# note\n# Time a\n0 5\n0.5 5\n0.6 5\n"),
                    ("p/0.5/p_0.5.dat", "# Time  a\n0.6 8\n0.7 8\n"),
                    ("p/1/p.dat", "# Time a\n0.5 9\n"),
                ],
                "p",
                None,
                "[[0.0, 5.0], [0.5, 5.0], [0.6, 8.0], [0.7, 8.0]]",
            ),
            (&[], "p", Some("p.dat"), "[[0.0, 5.0], [0.5, 5.0], [0.6, 8.0], [0.7, 8.0]]"),
            (&[], "p", Some("q.dat"), "no q.dat in it"),
            (&[("p/0.5/p_0.5.dat", "# Time b\n0.6 8\n")], "p", None, "other points or columns than in"),
            (&[("msddFoam/tables.json", r#"{"schema": "other", "runs": []}"#)], "p", None, "schema 'other'"),
        ];
        for (files, name, file, expected) in steps {
            for (file, text) in files {
                msdd_files::write(&post.join(file), text.as_bytes()).unwrap();
            }
            let found = read(&case, name, file).and_then(|table| table.numbers());
            let found = found.map_or_else(|error| error.to_string(), |rows| format!("{rows:?}"));
            assert!(found.contains(expected), "{name}: {found}");
        }
        std::fs::remove_dir_all(&case).unwrap();
    }
}
