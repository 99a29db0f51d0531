//! The tables of all packings of a plan, as they are shipped: `packings.csv`, `probes.csv.gz`, `windows.csv.gz`.

use super::SceneResults;
use super::discs::{PACKING_COLUMNS, PROBE_COLUMNS, WINDOW_COLUMNS};
use super::plan::PlannedScene;
use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use msdd_dem_reference::ReferenceError;
use msdd_dem_reference::results::Table;
use msdd_files::Column;
use std::fmt::Write as _;
use std::io::{Read, Write};
use std::path::Path;

/// A table: file, columns in addition to scene and seed, and where a packing has its rows.
type Part = (&'static str, &'static [Column], fn(&SceneResults) -> &Table);

/// The tables.
pub const TABLES: [Part; 3] = [
    ("packings.csv", &PACKING_COLUMNS, |results| &results.packing),
    ("probes.csv.gz", &PROBE_COLUMNS, |results| &results.probes),
    ("windows.csv.gz", &WINDOW_COLUMNS, |results| &results.windows),
];

/// Lines of one packing in a table, without a head.
pub fn lines(scene: &PlannedScene, results: &SceneResults, table: &Table) -> String {
    let mut text = String::new();
    for row in &table.rows {
        let numbers: Vec<String> = row.iter().map(|&value| msdd_case::numbers::plain(value)).collect();
        let _ = writeln!(
            text,
            "{},{},{},{}",
            scene.name,
            scene.purpose.as_str(),
            results.seed,
            numbers.join(",")
        );
    }
    text
}

/// The texts of [`TABLES`], with one line of names at the top.
pub fn tables(all: &[(&PlannedScene, SceneResults)]) -> [String; 3] {
    TABLES.map(|(_, columns, part)| {
        let names: Vec<&str> = columns.iter().map(|(name, _, _)| *name).collect();
        let head = format!("scene,use,seed,{}\n", names.join(","));
        all.iter().fold(head, |text, (scene, results)| text + &lines(scene, results, part(results)))
    })
}

/// Writes the tables into a folder; those whose name ends in `.gz` are compressed, the same text to the same bytes.
///
/// # Errors
/// [`ReferenceError::File`].
pub fn write(folder: &Path, all: &[(&PlannedScene, SceneResults)]) -> Result<(), ReferenceError> {
    for ((name, ..), text) in TABLES.iter().zip(tables(all)) {
        let bytes = if name.ends_with(".gz") { compressed(&text)? } else { text.into_bytes() };
        msdd_files::write(&folder.join(name), &bytes)?;
    }
    Ok(())
}

/// gzip without name or date in its header.
fn compressed(text: &str) -> std::io::Result<Vec<u8>> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(text.as_bytes())?;
    encoder.finish()
}

/// The text of a table that [`write()`] has written.
///
/// # Errors
/// [`ReferenceError::File`], [`ReferenceError::Read`].
pub fn read(folder: &Path, name: &str) -> Result<String, ReferenceError> {
    let file = folder.join(name);
    let bytes = msdd_files::read(&file, msdd_files::MAX_BYTES)?;
    let mut text = String::new();
    let done = match name.ends_with(".gz") {
        true => GzDecoder::new(&bytes[..]).read_to_string(&mut text),
        false => (&bytes[..]).read_to_string(&mut text),
    };
    done.map_err(|error| ReferenceError::Read { file, problem: error.to_string() })?;
    Ok(text)
}
