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
                "a surrogate of discs. This case has spheres: use 'msdd bed run'; 'msdd bed from-case' writes the elements.toml that it \
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
        let value = |key: &str, usual: f64| match own.get(key) {
            Some(_) => own.number(key, f64::is_finite, "a number"),
            None => Ok(usual),
        };
        let material = Material {
            friction_angle: value("frictionAngle", usual.friction_angle)?,
            stiffness_ratio: value("stiffnessRatio", usual.stiffness_ratio)?,
            ..usual
        };
        Ok(Self { material, radii: RADIUS_RANGE, source: "surrogate onlineRve".to_string() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(surrogate: &str) -> Result<ModelGrains, String> {
        let text = format!("surrogate {{ {surrogate} }}");
        let file = Dictionary::parse(Path::new("constant/granularProperties"), &text).unwrap();
        ModelGrains::of(Path::new("."), &file).map_err(|error| error.to_string())
    }

    #[test]
    fn grains_of_shipped_models_and_of_boxes() {
        let paper = ModelGrains {
            material: Material::default(),
            radii: RADIUS_RANGE,
            source: "model builtin".to_string(),
        };
        for text in
            ["type network; model builtin;", "type constant; constantCoeffs { stress (1 0 0 1 0 1); }"]
        {
            assert_eq!(of(text).unwrap(), paper);
        }
        let boxes = of("type onlineRve; onlineRveCoeffs { frictionAngle 0.3; }").unwrap();
        assert_eq!((boxes.material.friction_angle, boxes.material.stiffness_ratio), (0.3, 0.8));
    }

    #[test]
    fn grains_of_a_model_file_and_of_one_without_them() {
        let folder = std::env::temp_dir().join(format!("msdd-model-{}", std::process::id()));
        let shipped = models::builtin("builtin:paper").unwrap().to_json();
        let text = "type network; networkCoeffs { model m.json; }";
        let read = |json: &str| {
            msdd_files::write(&folder.join("m.json"), json.as_bytes()).unwrap();
            let text = format!("surrogate {{ {text} }}");
            let file = Dictionary::parse(Path::new("constant/granularProperties"), &text).unwrap();
            ModelGrains::of(&folder, &file).map_err(|error| error.to_string())
        };
        let smooth = shipped.replace("\"friction_angle\": 0.5", "\"friction_angle\": 0.3");
        let smooth = smooth.replace("\"radius_min\": 0.003", "\"radius_min\": 0.004");
        let smooth = read(&smooth.replace("\"radius_max\": 0.007", "\"radius_max\": 0.006")).unwrap();
        assert_eq!((smooth.material.friction_angle, smooth.radii), (0.3, [0.8, 1.2]));
        let error = read(&shipped.replace("\"stiffness_ratio\": 0.8,", "")).unwrap_err();
        assert!(
            error.contains("model = m.json") && error.contains("missing field `stiffness_ratio`"),
            "{error}"
        );
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn other_surrogates_are_refused_with_what_to_do() {
        let error = of("type spheres; spheresCoeffs { gas air; }").unwrap_err();
        assert!(error.contains("This case has spheres: use 'msdd bed run'"), "{error}");
        let error = of("type plugin; pluginCoeffs { library \"l.so\"; }").unwrap_err();
        assert!(error.contains("surrogate/type = plugin, allowed: network, constant, onlineRve"), "{error}");
    }
}
