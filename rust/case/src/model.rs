//! The grains that the surrogate of a case was made for: their friction, stiffness ratio and radii, which the case's own files do not
//! hold.

use crate::CaseError;
use crate::dictionary::{Dictionary, Entry};
use crate::disc_model::of_training;
use crate::packing::RADIUS_RANGE;
use msdd_dem::Material;
use msdd_surrogate::models;
use std::path::Path;

/// Discs with the friction, stiffness ratio, wall stiffness and damping of the surrogate.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelGrains {
    /// Density and Young's modulus are those of the training.
    pub material: Material,
    /// Smallest and largest radius over the mean radius [-].
    pub radii: [f64; 2],
    /// Which surrogate says so.
    pub source: String,
}

impl ModelGrains {
    /// The grains of the surrogate of a case; `properties`: its `constant/granularProperties`.
    ///
    /// # Errors
    /// [`CaseError::Key`] for a bed of spheres, for a plug-in, and for a model file that cannot be read or does not hold its grains.
    pub fn of(folder: &Path, properties: &Dictionary) -> Result<Self, CaseError> {
        let surrogate = properties.dictionary_at("surrogate")?;
        let kind = surrogate.text("type")?;
        let own = match surrogate.get(&format!("{kind}Coeffs")) {
            Some(Entry::Dictionary(own)) => own,
            _ => surrogate,
        };
        match kind.as_str() {
            "network" => Self::of_model(folder, own, own.text("model")?),
            "constant" if own.get("model").is_none() => Self::of_model(folder, own, models::BUILTIN.into()),
            "constant" => Self::of_model(folder, own, own.text("model")?),
            "onlineRve" => Self::of_boxes(own),
            "spheres" => Err(surrogate.refuse(
                "type",
                &kind,
                "a surrogate of discs. This case has spheres: use 'msdd bed run'; 'msdd bed from-case' writes the bed.toml that it \
                 requires",
            )),
            _ => Err(surrogate.refuse(
                "type",
                &kind,
                "network, constant, onlineRve, which hold friction and radii of their grains",
            )),
        }
    }

    /// Of a model that is compiled in, or of a model file relative to the case folder.
    fn of_model(folder: &Path, own: &Dictionary, name: String) -> Result<Self, CaseError> {
        let failed =
            |problem: String| own.refuse("model", &name, &format!("a model file of discs: {problem}"));
        let read = match name == models::BUILTIN || name.starts_with("builtin:") {
            true => models::builtin(&name),
            false => {
                let text = msdd_files::read_text(&folder.join(&name));
                models::read(&text.map_err(|error| failed(error.to_string()))?)
            }
        };
        let model = read.map_err(|error| failed(error.to_string()))?;
        let (material, radii) = of_training(&model.training().database).map_err(failed)?;
        Ok(Self { material, radii, source: format!("model {name}") })
    }

    /// Of the boxes that the solver packs itself.
    fn of_boxes(own: &Dictionary) -> Result<Self, CaseError> {
        let usual = Material::default();
        let material = Material {
            friction_angle: own.number_or("frictionAngle", usual.friction_angle)?,
            stiffness_ratio: own.number_or("stiffnessRatio", usual.stiffness_ratio)?,
            ..usual
        };
        Ok(Self { material, radii: RADIUS_RANGE, source: "surrogate onlineRve".to_string() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grains_are_those_of_the_surrogate_and_unknown_ones_are_refused() {
        let of = |surrogate: &str| {
            let text = format!("surrogate {{ {surrogate} }}");
            let file = Dictionary::parse(Path::new("constant/granularProperties"), &text).unwrap();
            ModelGrains::of(Path::new("."), &file).map_err(|error| error.to_string())
        };
        for (surrogate, friction_angle) in [
            ("type network; model builtin;", 0.5),
            ("type constant; constantCoeffs { stress (1 0 0 1 0 1); }", 0.5),
            ("type onlineRve; onlineRveCoeffs { frictionAngle 0.3; }", 0.3),
        ] {
            let (grains, usual) = (of(surrogate).unwrap(), Material::default());
            let expected = (Material { friction_angle, ..usual }, RADIUS_RANGE);
            assert_eq!((grains.material, grains.radii), expected, "{surrogate}");
        }
        for (surrogate, message) in [
            ("type network; model none.json;", "surrogate/model = none.json, allowed: a model file of discs"),
            (
                "type plugin; library \"l.so\";",
                "surrogate/type = plugin, allowed: network, constant, onlineRve",
            ),
        ] {
            let error = of(surrogate).unwrap_err();
            assert!(error.contains(message), "{error}");
        }
    }
}
