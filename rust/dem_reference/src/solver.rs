//! Reads the solver's results from a case folder: time series, sub-regions, the summary. They are written by the function
//! objects that the jobs of `scripts/report` have: `spaceProbes`, `wallPressure`, `subRegions`, `columns`.

use crate::ReferenceError;
use msdd_case::tables::{self, Table};
use msdd_files::{list, read_text};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// Start of the names of function objects that a single job adds.
pub const WATCH: &str = "watch";

/// Columns of the sub-regions, in the order that the solver writes them. K in W/(m K), stress in Pa, compression positive.
pub const COLUMNS: [&str; 8] = [
    "T",
    "porosity",
    "fabric_index",
    "conductivity_xx",
    "conductivity_yy",
    "stress_xx",
    "stress_yy",
    "pressure",
];

/// Results of a run of the solver.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// t \[s\], and T \[K\] at P1, P2, P3.
    pub temperature: Vec<[f64; 4]>,
    /// t \[s\], mean pressure \[Pa\].
    pub pressure: Vec<[f64; 2]>,
    /// A row of [`COLUMNS`] for each of the 10 x 3 sub-regions, from the lower left, x index fastest.
    pub sub_regions: Vec<Vec<f64>>,
    /// A row of [`COLUMNS`] for each of ten slices along x.
    pub columns: Vec<Vec<f64>>,
    /// Displacement along x in ten slices \[m\]; with grains that move only.
    pub displacement: Option<Vec<f64>>,
    /// Displacement along x and y of the grains that started in each sub-region \[m\]; with grains that move only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moved: Option<Vec<[f64; 2]>>,
    /// Rows of numbers of each function object that the job adds, by its name, which begins with [`WATCH`].
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub watched: BTreeMap<String, Vec<Vec<f64>>>,
    pub cells: u64,
    pub steps: u64,
    pub rejected_steps: u64,
    pub cell_queries: u64,
    pub cell_steps: u64,
    pub clamped_queries: u64,
    /// Mean pressure \[Pa\] and porosity at the end.
    pub end_pressure: f64,
    pub end_porosity: f64,
}

/// Reads the results in a case folder. `mesh`: number of cells along x and y, needed to average displacements over
/// sub-regions; `end_time`: end of the run \[s\].
///
/// # Errors
/// [`ReferenceError::File`], [`ReferenceError::Read`] for a file that is missing or has other contents.
pub fn read(folder: &Path, mesh: [usize; 2], end_time: f64) -> Result<Run, ReferenceError> {
    let post = folder.join("postProcessing");
    let summary = read_summary(&post.join("msddFoam/summary.json"))?;
    let count = |key: &str| summary[key].as_u64().unwrap_or_default();
    let end = |key: &str| summary["final"][key].as_f64().unwrap_or(f64::NAN);
    let moved = displacement(folder, end_time)?;
    let slices = |values: &Vec<Vec<f64>>| means_in(values, mesh, [10, 1]).iter().map(|u| u[0]).collect();
    Ok(Run {
        temperature: temperatures(folder)?,
        pressure: pressure_rows(folder)?,
        sub_regions: last_windows(folder, "subRegions", 30)?,
        columns: last_windows(folder, "columns", 10)?,
        displacement: moved.as_ref().map(slices),
        moved: moved.as_ref().map(|values| means_in(values, mesh, [10, 3])),
        watched: watched(folder)?,
        cells: count("cells"),
        steps: count("steps"),
        rejected_steps: count("rejected_steps"),
        cell_queries: count("cell_queries"),
        cell_steps: count("cell_steps"),
        clamped_queries: count("clamped_queries"),
        end_pressure: end("pressure"),
        end_porosity: end("porosity"),
    })
}

/// Time \[s\] and T \[K\] at P1, P2, P3: the means over windows of 40 mm around the probes, which `spaceProbes` writes.
///
/// # Errors
/// As [`read`].
pub fn temperatures(folder: &Path) -> Result<Vec<[f64; 4]>, ReferenceError> {
    let rows = probe_rows(folder)?;
    Ok(rows.iter().filter_map(|row| row.get(..4)?.try_into().ok()).collect())
}

/// The points \[m\] of the function object `spaceProbes`, from the head of its file: `# Probe 0 : (x y z)`.
///
/// # Errors
/// As [`read`].
pub fn probe_points(folder: &Path) -> Result<Vec<[f64; 2]>, ReferenceError> {
    let table = table(folder, "spaceProbes")?;
    let point = |line: &str| -> Option<[f64; 2]> {
        let mut numbers = line.split_once('(')?.1.trim_end_matches(')').split_whitespace().map(str::parse);
        Some([numbers.next()?.ok()?, numbers.next()?.ok()?])
    };
    let heads = table.head.iter().filter(|line| line.starts_with("# Probe "));
    let wrong = |line: &str| ReferenceError::Read {
        file: table.file.clone(),
        problem: format!("'{line}' has no point"),
    };
    heads.map(|line| point(line.trim_end()).ok_or_else(|| wrong(line))).collect()
}

/// Rows of time \[s\] and T \[K\] at each of the points of the function object `spaceProbes`, however many there are.
///
/// # Errors
/// As [`read`].
pub fn probe_rows(folder: &Path) -> Result<Vec<Vec<f64>>, ReferenceError> {
    Ok(table(folder, "spaceProbes")?.numbers()?)
}

/// Rows of time \[s\] and mean pressure \[Pa\], which `wallPressure` writes.
///
/// # Errors
/// As [`read`].
pub fn pressure_rows(folder: &Path) -> Result<Vec<[f64; 2]>, ReferenceError> {
    let rows = table(folder, "wallPressure")?.numbers()?;
    Ok(rows.iter().filter_map(|row| row.get(..2)?.try_into().ok()).collect())
}

fn read_summary(file: &Path) -> Result<Value, ReferenceError> {
    serde_json::from_str(&read_text(file)?)
        .map_err(|error| ReferenceError::Read { file: file.to_path_buf(), problem: error.to_string() })
}

/// The rows of the present run in the only table of a function object.
fn table(case: &Path, name: &str) -> Result<Table, ReferenceError> {
    Ok(tables::read(case, name, None)?)
}

/// The last rows of a table of sub-regions, without time and position.
fn last_windows(case: &Path, name: &str, count: usize) -> Result<Vec<Vec<f64>>, ReferenceError> {
    let table = table(case, name)?;
    let rows = table.numbers()?;
    let first = rows.len().checked_sub(count);
    let rows =
        first.map(|first| &rows[first..]).filter(|rows| rows.iter().all(|r| r.len() == 3 + COLUMNS.len()));
    match rows {
        Some(rows) => Ok(rows.iter().map(|row| row[3..].to_vec()).collect()),
        None => Err(ReferenceError::Read {
            file: table.file,
            problem: format!("not {count} windows of {} columns", COLUMNS.len()),
        }),
    }
}

/// The displacement of the cells [m], x index fastest; `None` when the solver wrote none.
fn displacement(folder: &Path, end: f64) -> Result<Option<Vec<Vec<f64>>>, ReferenceError> {
    let file = folder.join(format!("{end}/D"));
    if !file.exists() {
        return Ok(None);
    }
    let wrong = |problem| ReferenceError::Read { file: file.clone(), problem };
    nonuniform(&read_text(&file)?).map_err(wrong).map(Some)
}

/// Means of the first two components over regions of the mesh, which moves with the grains; `parts` is the number of regions
/// along x and y. 0 for a region without cells.
fn means_in(values: &[Vec<f64>], mesh: [usize; 2], parts: [usize; 2]) -> Vec<[f64; 2]> {
    let [nx, ny] = mesh.map(|n| n.max(1));
    let (mut sum, mut count) = (vec![[0.0; 2]; parts[0] * parts[1]], vec![0.0; parts[0] * parts[1]]);
    for (k, value) in values.iter().enumerate() {
        let part = parts[0] * (k % nx) / nx + parts[0] * (parts[1] * (k / nx) / ny);
        (0..2).for_each(|c| sum[part][c] += value[c]);
        count[part] += 1.0;
    }
    sum.iter().zip(count).map(|(s, n)| s.map(|u| u / f64::max(n, 1.0))).collect()
}

fn watched(case: &Path) -> Result<BTreeMap<String, Vec<Vec<f64>>>, ReferenceError> {
    let mut found = BTreeMap::new();
    for folder in list(&case.join("postProcessing"))? {
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name.starts_with(WATCH) {
            let rows = table(case, &name)?.numbers()?;
            found.insert(name, rows);
        }
    }
    Ok(found)
}

/// The values of a `nonuniform List` of scalars, vectors or tensors.
///
/// # Errors
/// What is wrong with the text.
pub fn nonuniform(text: &str) -> Result<Vec<Vec<f64>>, String> {
    let start = text.find("nonuniform List<").ok_or("no nonuniform internalField")?;
    let body = text[start..].split_once("\n(\n").ok_or("no list")?.1;
    let body = body.split_once("\n)").ok_or("the list has no end")?.0;
    body.lines()
        .map(|line| {
            let numbers = line.trim().trim_start_matches('(').trim_end_matches(')').split_whitespace();
            numbers.map(|n| n.parse().map_err(|_| format!("'{line}' is not a number"))).collect()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn displacement_by_parts_of_the_mesh() {
        // 20 x 6 cells; u_x is the index of the column, u_y that of the row
        let values: Vec<Vec<f64>> =
            (0..120).map(|k| vec![f64::from(k % 20), f64::from(k / 20), 0.0]).collect();
        let parts = means_in(&values, [20, 6], [10, 3]);
        assert_eq!((parts.len(), parts[0], parts[12]), (30, [0.5, 0.5], [4.5, 2.5]));
        assert_eq!(means_in(&values[..20], [20, 1], [10, 1])[9], [18.5, 0.0]);
    }
}
