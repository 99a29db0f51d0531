//! What a bed of discrete elements is like at the start, as the law of spheres needs it.

use crate::error::CliError;
use msdd_beds::mobilised::mobilised;
use msdd_beds::packings::at_start;
use msdd_files::read_text;
use std::path::{Path, PathBuf};

/// The first row of an `elements.csv`. SI units, compression positive; vectors along x, y, z, in a cylinder along the radius,
/// around the axis, and along it.
pub struct Start {
    pub file: PathBuf,
    pub depth: f64,
    pub stress: [f64; 3],
    pub coordination: f64,
    /// In the law's measure.
    pub mobilised: f64,
    pub fabric: [f64; 3],
    /// Where the averages are taken.
    pub porosity: f64,
    /// Between the radius of the averages and the centres of the first layer beside the side.
    pub porosity_outside: Option<f64>,
}

impl Start {
    /// Reads the results of `msdd bed run`.
    ///
    /// # Errors
    /// A file that cannot be read, or has no first row with these columns.
    pub fn read(file: &Path) -> Result<Self, CliError> {
        let text = read_text(file)?;
        let number = |name: &str| {
            at_start(&text, name).ok_or_else(|| {
                CliError::Message(format!(
                    "{}: no column {name} with a first value, allowed: elements.csv of this version's 'msdd bed run'",
                    file.display()
                ))
            })
        };
        let three = |name: &str| -> Result<[f64; 3], CliError> {
            Ok([number(&format!("{name}_1"))?, number(&format!("{name}_2"))?, number(&format!("{name}_3"))?])
        };
        Ok(Self {
            file: file.to_path_buf(),
            depth: number("depth")?,
            stress: three("stress")?,
            coordination: number("coordination")?,
            mobilised: mobilised(number("mobilisation")?),
            fabric: three("fabric")?,
            porosity: number("porosity")?,
            porosity_outside: at_start(&text, "porosity_outside"),
        })
    }
}
