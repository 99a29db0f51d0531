//! What a bed of DEM is like at the start, as the law of spheres needs it.

use crate::error::TrainingError;
use msdd_beds::mobilised::mobilised;
use msdd_beds::packings::at_start;
use msdd_files::{list, read_text};
use msdd_rve::message::number;
use std::path::{Path, PathBuf};

/// The first row of an `dem.csv`. SI units, compression positive; vectors along x, y, z, in a cylinder along the radius,
/// around the axis, and along it.
pub struct FirstRow {
    pub file: PathBuf,
    pub depth: f64,
    pub stress: [f64; 3],
    pub coordination: f64,
    /// In the law's measure.
    pub mobilised: f64,
    pub fabric: [f64; 3],
    /// Where the averages are taken.
    pub porosity: f64,
    /// Between the radius of the averages and the centres of the first layer next to the side.
    pub porosity_outside: Option<f64>,
}

/// Depths \[m\] and stresses \[Pa\] of any bed.
const DEPTH: [f64; 2] = [1e-12, 1e6];
const STRESS: [f64; 2] = [0.0, 1e15];
/// Porosities that the solver takes with spheres.
const POROSITY: [f64; 2] = [0.2, 0.7];
/// By how much the trace of a fabric may differ from 1: it is written rounded.
const UNIT_TRACE: f64 = 0.01;

impl FirstRow {
    /// Reads the results of `msdd bed run`.
    ///
    /// # Errors
    /// A file that cannot be read, or has no first row with these columns, or values in it that no bed has.
    pub fn read(file: &Path) -> Result<Self, TrainingError> {
        let text = read_text(file)?;
        let within = |name: &str, [low, high]: [f64; 2]| {
            let value = at_start(&text, name).ok_or_else(|| {
                TrainingError::Data(format!(
                    "{}: no column {name} with a first value, allowed: dem.csv of this version's 'msdd bed run'",
                    file.display()
                ))
            })?;
            match (low..=high).contains(&value) {
                true => Ok(value),
                false => Err(TrainingError::Data(format!(
                    "{}: {name} = {} in the first row, allowed: {} to {}",
                    file.display(),
                    number(value),
                    number(low),
                    number(high)
                ))),
            }
        };
        let three = |name: &str, range: [f64; 2]| -> Result<[f64; 3], TrainingError> {
            let part = |k: usize| within(&format!("{name}_{k}"), range);
            Ok([part(1)?, part(2)?, part(3)?])
        };
        let fabric = three("fabric", [0.0, 1.0])?;
        let trace: f64 = fabric.iter().sum();
        if (trace - 1.0).abs() > UNIT_TRACE {
            return Err(TrainingError::Data(format!(
                "{}: fabric_1 + fabric_2 + fabric_3 = {} in the first row, allowed: 1",
                file.display(),
                number(trace)
            )));
        }
        Ok(Self {
            file: file.to_path_buf(),
            depth: within("depth", DEPTH)?,
            stress: three("stress", STRESS)?,
            coordination: within("coordination", [0.0, 12.0])?,
            mobilised: mobilised(within("mobilisation", [0.0, 1.0])?),
            fabric,
            porosity: within("porosity", POROSITY)?,
            porosity_outside: at_start(&text, "porosity_outside"),
        })
    }
}

/// Seeds and files of the packings of a bed in its folder.
///
/// # Errors
/// A folder that cannot be read, or has no such file.
pub fn packings(folder: &Path) -> Result<Vec<(u64, PathBuf)>, TrainingError> {
    let seed = |file: &PathBuf| {
        file.file_name()?.to_str()?.strip_prefix("dem-")?.strip_suffix(".csv")?.parse::<u64>().ok()
    };
    let mut all: Vec<(u64, PathBuf)> =
        list(folder)?.into_iter().filter_map(|file| Some((seed(&file)?, file))).collect();
    all.sort();
    match all.is_empty() {
        true => Err(TrainingError::Data(format!(
            "{}: no file dem-<seed>.csv, allowed: results of 'msdd bed run --packings'",
            folder.display()
        ))),
        false => Ok(all),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_that_no_bed_has_are_refused_with_short_numbers() {
        let file = std::env::temp_dir().join(format!("msdd-start-{}.csv", std::process::id()));
        let text =
            "time,fabric_1,fabric_2,fabric_3,depth,stress_1,stress_2,stress_3\n0,0.3,0.3,0.4,0.1,1,1,-2.8\n";
        msdd_files::write(&file, text.as_bytes()).unwrap();
        let error = FirstRow::read(&file).err().unwrap().to_string();
        std::fs::remove_file(&file).unwrap();
        assert!(
            error.ends_with("stress_3 = -2.8 in the first row, allowed: 0 to 1000000000000000"),
            "{error}"
        );
    }
}
