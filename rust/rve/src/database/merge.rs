//! Merges the shards of one plan into one file.

use super::plan::Plan;
use super::recipe::Recipe;
use super::spheres::SpherePlan;
use super::store::{Store, join_commits};
use super::table::Row;
use super::{DatabaseError, Dataset, Grains, Shard, grains};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Provenance keys that must agree between shards; all other entries follow from these.
const SAME: [&str; 3] = ["schema", "engine_version", "plan_hash"];

/// Joins databases of one plan into `out`, which becomes identical byte for byte to the file that one process would
/// have written. Returns the number of rows.
///
/// # Errors
/// [`DatabaseError::Mismatch`] for another plan, schema or engine version; [`DatabaseError::Damaged`];
/// [`DatabaseError::Merge`] when packings are missing or occur in two files; errors of reading and writing.
pub fn merge(shards: &[PathBuf], out: &Path) -> Result<usize, DatabaseError> {
    match shards.first().map(|path| grains(path)).transpose()? {
        Some(Grains::Spheres) => merge_by::<SpherePlan>(shards, out),
        _ => merge_by::<Plan>(shards, out),
    }
}

fn merge_by<P: Recipe>(shards: &[PathBuf], out: &Path) -> Result<usize, DatabaseError> {
    msdd_files::check_target(out)?;
    let mut packings: Packings<P::Row> = BTreeMap::new();
    let mut first: Option<BTreeMap<String, String>> = None;
    let mut commits = Vec::new();
    for path in shards {
        let Dataset { records, provenance } = Store::<P::Row>::open(path)?.dataset()?;
        commits.push(provenance.get("commit").cloned().unwrap_or_default());
        agree(path, first.get_or_insert_with(|| provenance.clone()), &provenance)?;
        for record in records {
            let (source, rows) = packings.entry(record.packing()).or_insert((path, Vec::new()));
            if source != path {
                let problem = format!("packing {} stands in {} too", record.packing(), source.display());
                return Err(DatabaseError::Merge { path: path.clone(), problem });
            }
            rows.push(record);
        }
    }
    let problem =
        |problem: &str| DatabaseError::Merge { path: out.to_path_buf(), problem: problem.to_string() };
    let mut provenance = first.ok_or_else(|| problem("no databases to merge"))?;
    let text = provenance.get("plan").ok_or_else(|| problem("no plan in the provenance"))?;
    complete(&P::parse(text, "the plan in the provenance")?, &packings, out)?;
    provenance.insert("commit".to_string(), join_commits(commits.iter().map(String::as_str)));
    provenance.insert("shard".to_string(), Shard::default().to_string());
    let records: Vec<P::Row> = packings.into_values().flat_map(|(_, rows)| rows).collect();
    Store::write_whole(out, provenance, &records)?;
    Ok(records.len())
}

/// Rows by packing, with the file that they stand in.
type Packings<'a, R> = BTreeMap<i64, (&'a Path, Vec<R>)>;

fn agree(
    path: &Path,
    first: &BTreeMap<String, String>,
    other: &BTreeMap<String, String>,
) -> Result<(), DatabaseError> {
    let text = |from: &BTreeMap<String, String>, key| from.get(key).cloned().unwrap_or_default();
    for key in SAME {
        let (expected, found) = (text(first, key), text(other, key));
        if found != expected {
            return Err(DatabaseError::Mismatch { path: path.to_path_buf(), key, found, expected });
        }
    }
    Ok(())
}

/// Checks that there is every packing of the plan with all its rows, and no other.
fn complete<P: Recipe>(plan: &P, packings: &Packings<P::Row>, out: &Path) -> Result<(), DatabaseError> {
    let problem = |path: &Path, problem| Err(DatabaseError::Merge { path: path.to_path_buf(), problem });
    let jobs = plan.jobs();
    let missing: Vec<String> = jobs
        .iter()
        .map(|job| P::packing(job).0)
        .filter(|packing| !packings.contains_key(packing))
        .map(|packing| packing.to_string())
        .collect();
    if !missing.is_empty() {
        let (count, total) = (missing.len(), jobs.len());
        let list = missing[..count.min(20)].join(", ");
        let more = if count > 20 { ", …" } else { "" };
        return problem(out, format!("{count} of {total} packings are missing: {list}{more}"));
    }
    for (packing, (path, rows)) in packings {
        let expected = usize::try_from(*packing).ok().and_then(|k| jobs.get(k)).map(P::places);
        if expected.is_none_or(|expected| !rows.iter().map(Row::place).eq(expected)) {
            return problem(path, format!("packing {packing} has not the rows of the plan"));
        }
    }
    Ok(())
}
