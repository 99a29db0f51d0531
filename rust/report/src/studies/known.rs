//! Thermal states among those that the shipped model was trained with.

use crate::ReportError;
use msdd_rve::database::{Kind, read};
use msdd_rve::region::Polygon;
use std::path::Path;

/// Database of thermal ramps of the shipped model.
pub const DATABASE: &str = "cases/database/periodic.csv.gz";

/// Convex hulls of the states that carry load. Models are trained with these and with the same states turned by 90° (f with the
/// opposite sign), so the hulls contain both.
#[derive(Clone, Debug, Default)]
pub struct KnownStates {
    /// Porosity and fabric index [-].
    pub porosity_fabric: Vec<[f64; 2]>,
    /// Porosity and reduced pressure p ℓ/(E r̄) [-].
    pub porosity_pressure: Vec<[f64; 2]>,
    /// Porosity and thermal strain since packing [-].
    pub porosity_strain: Vec<[f64; 2]>,
    pub states: usize,
}

impl KnownStates {
    /// # Errors
    /// [`ReportError::Read`].
    pub fn read(file: &Path) -> Result<Self, ReportError> {
        let failed = |error: msdd_rve::database::DatabaseError| ReportError::Read {
            file: file.to_path_buf(),
            problem: error.to_string(),
        };
        let records = read(file).map_err(failed)?.records;
        let thermal = records.iter().filter(|r| r.kind == Kind::Thermal && r.carries_load());
        let states: Vec<[f64; 4]> = thermal
            .filter_map(|r| {
                let pressure = 0.5 * (r.stress_xx_reduced? + r.stress_yy_reduced?);
                Some([r.porosity?, r.fabric_index?, pressure, r.strain])
            })
            .collect();
        let turned = states.iter().flat_map(|s| [[s[0], s[1]], [s[0], -s[1]]]).collect();
        Ok(Self {
            porosity_fabric: Polygon::hull(turned).corners,
            porosity_pressure: Polygon::hull(states.iter().map(|s| [s[0], s[2]]).collect()).corners,
            porosity_strain: Polygon::hull(states.iter().map(|s| [s[0], s[3]]).collect()).corners,
            states: states.len(),
        })
    }

    /// Whether a point lies in a hull.
    pub fn holds(hull: &[[f64; 2]], point: [f64; 2]) -> bool {
        Polygon { corners: hull.to_vec() }.contains(point)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_database_holds_the_initial_state_of_the_cases() {
        let checkout = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let known = KnownStates::read(&checkout.join(DATABASE)).unwrap();
        assert!(known.states > 1000, "{}", known.states);
        assert!(KnownStates::holds(&known.porosity_fabric, [0.125, 0.05]));
        assert!(KnownStates::holds(&known.porosity_pressure, [0.125, 0.05]));
        assert!(!KnownStates::holds(&known.porosity_fabric, [0.125, 0.9]));
    }
}
