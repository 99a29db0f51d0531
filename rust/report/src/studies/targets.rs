//! The accuracy that the validation has to reach with grains that move and the conductivity of the resistor network.

use crate::plan::FAMILIES;
use crate::studies::validation::Validated;
use msdd_dem_reference::compare::FieldError;
use serde::Serialize;

/// A target and the value that was reached.
#[derive(Clone, Debug, Serialize)]
pub struct Target {
    pub case: String,
    pub what: String,
    pub target: f64,
    pub reached: Option<f64>,
    /// Whether the target was met. `None`: not judged, because the target is for finer meshes and more packings.
    pub met: Option<bool>,
    /// The same error over another region, with the name of the region.
    pub beside: String,
}

/// Targets of the validation with grains that move and the conductivity of the resistor network. They are for the mesh of the
/// shipped cases and the mean of three packings. A `quick` report has neither, so it gives the errors without judging them.
pub fn targets(validation: &[Validated], quick: bool) -> Vec<Target> {
    let of = |case: &str| {
        let found = validation.iter().find(|v| v.case == case && v.family == FAMILIES[1]);
        found.and_then(|v| v.errors.as_ref())
    };
    let target = |case: &str, what: &str, target: f64, reached: Option<f64>| Target {
        case: case.to_string(),
        what: what.to_string(),
        target,
        reached: reached.map(f64::abs),
        met: (!quick).then(|| reached.is_some_and(|value| value.abs() <= target)),
        beside: String::new(),
    };
    let mut list = Vec::new();
    for (case, limit) in [("H", 1.0), ("C", 3.0), ("HC", 1.0)] {
        for probe in 0..3 {
            let what = format!("T at P{} [% of the range]", probe + 1);
            list.push(target(case, &what, limit, of(case).map(|e| e.temperature[probe])));
        }
        if case != "HC" {
            // Compared with the inner region, because the solver's cells do not describe the looser layers of discs at the walls.
            let what = "pressure, discs off the walls [% of the paper's range]";
            let whole = of(case).map(|e| format!("whole box: {:.2}", e.pressure.abs())).unwrap_or_default();
            let inner = of(case).and_then(|e| e.pressure_inner);
            list.push(Target { beside: whole, ..target(case, what, 2.5, inner) });
        }
    }
    let field = |quantity: &str| of("HC").and_then(|e| e.field(quantity)).cloned();
    let percent = |quantity: &str, scale: &dyn Fn(&FieldError) -> f64| {
        let found = field(quantity);
        let inner = |f: &FieldError| format!("8 x 1 inner sub-regions: {:.2}", scale(f) * f.rms_inner);
        (found.as_ref().map(|f| scale(f) * f.rms), found.as_ref().map(inner).unwrap_or_default())
    };
    let (porosity, beside) = percent("porosity", &|_| 100.0);
    let what = "porosity at the end, rms [%, absolute]";
    list.push(Target { beside, ..target("HC", what, 0.4, porosity) });
    let (conductivity, beside) = percent("conductivity_xx", &|f| 100.0 / f.means[1]);
    list.push(Target { beside, ..target("HC", "K_xx at the end, rms [%]", 5.0, conductivity) });
    list.push(target("HC", "displacement at the end [%]", 15.0, of("HC").and_then(|e| e.displacement)));
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quick_report_judges_no_target() {
        assert!(targets(&[], true).iter().all(|target| target.met.is_none()));
        let full = targets(&[], false);
        assert_eq!(full.len(), 14);
        assert!(full.iter().all(|target| target.met == Some(false) && target.reached.is_none()));
    }
}
