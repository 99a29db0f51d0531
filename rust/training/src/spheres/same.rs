//! Refuses data of spheres of different materials: one law cannot be fitted to both.

use crate::error::TrainingError;
use std::path::{Path, PathBuf};

/// What the materials of the data must agree in. Stresses are over E* and conductivities over that of the grains, so that these do not
/// matter; friction does, and Poisson's ratio does through the tangential stiffness of contacts. The restitution only decides how fast
/// boxes come to rest.
const KEYS: [&str; 2] = ["friction", "poisson_ratio"];

/// The values of the data read so far, with the file that each was read from first.
#[derive(Default)]
pub struct SeenValues([Option<(PathBuf, f64)>; 2]);

impl SeenValues {
    /// Compares a value with that of the data before; `None` if it is not known or may differ.
    ///
    /// # Errors
    /// [`TrainingError::Data`] with both files and both values.
    pub fn agree(&mut self, file: &Path, values: [Option<f64>; 2]) -> Result<(), TrainingError> {
        for ((key, known), value) in KEYS.iter().zip(&mut self.0).zip(values) {
            let Some(value) = value else { continue };
            let (first, expected) = known.get_or_insert_with(|| (file.to_path_buf(), value));
            if *expected != value {
                return Err(TrainingError::Data(format!(
                    "{}: material: {key} = {value}, allowed: {expected}, as in {}: one law is fitted to spheres of one material",
                    file.display(),
                    first.display()
                )));
            }
        }
        Ok(())
    }
}

/// The values in the provenance of a database.
pub fn of_database(material: &serde_json::Value) -> [Option<f64>; 2] {
    KEYS.map(|key| material[key].as_f64())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_files_and_values_are_named() {
        let material = |friction: f64, ratio: f64, restitution: f64| {
            of_database(&serde_json::json!({
                "friction": friction, "poisson_ratio": ratio, "restitution": restitution
            }))
        };
        let mut known = SeenValues::default();
        let mut add =
            |file: &str, values| known.agree(Path::new(file), values).map_err(|error| error.to_string());
        assert!(add("a.csv", material(0.3, 0.25, 0.3)).is_ok());
        assert!(add("b.csv", material(0.3, 0.25, 0.9)).is_ok());
        assert!(add("bed", [Some(0.3), None]).is_ok());
        let refused = "c.csv: material: friction = 0.5, allowed: 0.3, as in a.csv: one law is fitted to spheres of one material";
        assert_eq!(add("c.csv", material(0.5, 0.25, 0.3)).unwrap_err(), refused);
        assert!(
            add("d.csv", material(0.3, 0.3, 0.3)).unwrap_err().contains("poisson_ratio = 0.3, allowed: 0.25")
        );
        assert!(add("bed", [Some(0.1), None]).unwrap_err().starts_with("bed: material: friction = 0.1"));
    }
}
