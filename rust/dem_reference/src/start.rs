//! The start of a case compared with the packing that is simulated for it.

use crate::model::Statistics;
use crate::{Case, ReferenceError};
use msdd_case::case::optional;
use msdd_rve::message::number;

/// Differences of the porosity [-] and of the pressure (relative) that windows of a packing have from its whole box.
const SAME_POROSITY: f64 = 0.005;
const SAME_PRESSURE: f64 = 0.1;

/// Means over the cells of the fields in the folder `0` of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InitialMeans {
    /// η [-], overlaps counted once.
    pub porosity: f64,
    /// p \[Pa\], compression positive; `None` when the case leaves it to its surrogate.
    pub pressure: Option<f64>,
}

impl InitialMeans {
    /// The start of a case; `None` before it has a porosity.
    ///
    /// # Errors
    /// [`ReferenceError::Case`] for a field that is not understood.
    pub fn of(case: &Case) -> Result<Option<Self>, ReferenceError> {
        let field = |name: &str| optional(&case.folder, name);
        let Some(porosity) = field("0/porosity")? else { return Ok(None) };
        let stress = field("0/stress")?.map(|field| field.means::<6>("internalField")).transpose()?;
        Ok(Some(Self {
            porosity: porosity.mean("internalField")?,
            pressure: stress.map(|[xx, _, _, yy, _, _]| -0.5 * (xx + yy)),
        }))
    }

    /// What a packing differs in from this start, in words with numbers; `None` when they are the same.
    pub fn difference(&self, packing: &Statistics) -> Option<String> {
        let pressure = self.pressure.filter(|own| {
            (own - packing.pressure).abs() > SAME_PRESSURE * own.abs().max(packing.pressure.abs())
        });
        let same = (self.porosity - packing.porosity).abs() <= SAME_POROSITY && pressure.is_none();
        (!same).then(|| {
            let of_case = self.pressure.map_or("the pressure of its surrogate".to_string(), |pressure| {
                format!("pressure {} Pa", number((10.0 * pressure).round() / 10.0))
            });
            format!(
                "the packing has porosity {:.4}, pressure {:.1} Pa; the case starts with porosity {:.4}, {of_case}",
                packing.porosity, packing.pressure, self.porosity
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::Results;
    use std::path::Path;

    #[test]
    fn a_packing_under_another_pressure_is_another_start() {
        let checkout = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let file = checkout.join("cases/reference/results/corner_seed11.json");
        let packing = Results::read(&file).unwrap().model;
        let start =
            InitialMeans { porosity: packing.porosity + 0.001, pressure: Some(1.05 * packing.pressure) };
        assert_eq!(start.difference(&packing), None);
        let loose = InitialMeans { pressure: Some(0.5 * packing.pressure), ..start };
        let said = loose.difference(&packing).unwrap();
        assert!(said.contains("; the case starts with porosity 0.12") && said.contains(" Pa"), "{said}");
        let unknown = InitialMeans { porosity: 0.15, pressure: None }.difference(&packing).unwrap();
        assert!(unknown.ends_with("porosity 0.1500, the pressure of its surrogate"), "{unknown}");
    }
}
