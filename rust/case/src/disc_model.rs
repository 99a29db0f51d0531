//! The model of discs of a new case: the one that is compiled in, or a file that `msdd train` wrote. The start is packed from the grains
//! that the model was trained with.

use crate::grains::Grains;
use crate::numbers::{plain, rounded};
use crate::{CaseError, refused};
use msdd_dem::Material;
use msdd_surrogate::{DatabaseProvenance, Surrogate, models};
use std::path::Path;
use std::sync::Arc;

/// Where the case keeps the file of its model.
pub const FILE: &str = "constant/model.json";
/// Friction coefficient tan φ while a box is packed, which the paper does not give. Friction raises the porosity η at which
/// the grains jam, and the fabric index f: 0.3 leads to about η = 12.4 % and f = 0.036; with the material's own 0.546 the
/// grains jam at 12.9–13.1 %.
pub const PACKING_FRICTION: f64 = 0.42;
/// Least and largest initial porosity that is allowed [-]: those of the packings that the shipped model was trained with.
pub const POROSITIES: [f64; 2] = [0.06, 0.19];

/// A model, and the grains that it was trained with.
#[derive(Clone)]
pub struct DiscModel {
    law: Arc<dyn Surrogate>,
    /// Text of the file; none of the model that is compiled in.
    file: Option<String>,
    /// Density and Young's modulus are those of the training.
    material: Material,
    /// Smallest and largest radius over the mean one.
    radii: [f64; 2],
}

impl std::fmt::Debug for DiscModel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {}", self.law.name(), self.law.hash())
    }
}

impl PartialEq for DiscModel {
    fn eq(&self, other: &Self) -> bool {
        self.law.hash() == other.law.hash()
    }
}

impl DiscModel {
    /// The model that is compiled in.
    ///
    /// # Errors
    /// [`CaseError::Model`]; a test checks that there are none.
    pub fn shipped() -> Result<Self, CaseError> {
        Self::of(models::builtin(models::BUILTIN)?, None).map_err(Self::refuse(models::BUILTIN.as_ref()))
    }

    /// A model file of discs.
    ///
    /// # Errors
    /// [`CaseError::Parameter`] for a file that is none, or does not hold the grains that the model was trained with.
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        let refuse = Self::refuse(path);
        let text = msdd_files::read_text(path).map_err(|error| refuse(error.to_string()))?;
        let law = models::read(&text).map_err(|error| refuse(error.to_string()))?;
        Self::of(law, Some(text)).map_err(refuse)
    }

    fn refuse(path: &Path) -> impl Fn(String) -> CaseError {
        let value = path.display().to_string();
        move |problem| {
            let allowed = format!("a model file of discs, as 'msdd train' writes it: {problem}");
            refused("model", &value, allowed)
        }
    }

    fn of(law: Box<dyn Surrogate>, file: Option<String>) -> Result<Self, String> {
        let (material, radii) = of_training(&law.training().database)?;
        Ok(Self { law: law.into(), file, material, radii })
    }

    pub fn law(&self) -> &dyn Surrogate {
        self.law.as_ref()
    }

    /// Text of its file; none of the model that is compiled in.
    pub fn file(&self) -> Option<&str> {
        self.file.as_deref()
    }

    /// Smallest and largest radius over the mean one.
    pub fn radii(&self) -> [f64; 2] {
        self.radii
    }

    /// These grains for DEM: friction, stiffness ratio and damping are those of the training.
    pub fn material(&self, grains: &Grains) -> Material {
        Material { density: grains.density, young_modulus: grains.young_modulus, ..self.material.clone() }
    }

    /// Friction angle while grains are packed \[rad\]: no grain slides less easily then than afterwards.
    pub fn packing_angle(&self) -> f64 {
        PACKING_FRICTION.atan().min(self.material.friction_angle)
    }

    /// Least and largest initial porosity: those of the packings of the training.
    pub fn porosities(&self) -> [f64; 2] {
        match self.file {
            None => POROSITIES,
            Some(_) => self.law.packed_porosities().map(|porosity| rounded(porosity, 3)),
        }
    }

    /// The entries of `surrogate` in `constant/granularProperties` that name the model.
    pub(crate) fn entry(&self) -> String {
        match self.file {
            None => format!("model           {};", models::BUILTIN),
            Some(_) => format!("model           \"{FILE}\";\n    hash            \"{}\";", self.law.hash()),
        }
    }

    /// The model in words.
    pub(crate) fn about(&self) -> String {
        let (angle, ratio) = (plain(self.material.friction_angle), plain(self.material.stiffness_ratio));
        let grains = format!("trained with a friction angle of {angle} rad and a stiffness ratio of {ratio}");
        match self.file {
            None => format!("the law of the increments that is compiled into the library, {grains}"),
            Some(_) => format!("{} ({}), {grains}", self.law.name(), self.law.kind()),
        }
    }
}

/// Material, and smallest and largest radius over the mean one, of the discs that a model was trained with.
///
/// # Errors
/// What the provenance does not hold.
pub(crate) fn of_training(database: &DatabaseProvenance) -> Result<(Material, [f64; 2]), String> {
    let missing =
        |what: &str| format!("one that holds the grains of its training, as 'msdd train' writes it ({what})");
    let material =
        serde_json::from_value(database.material.clone()).map_err(|error| missing(&error.to_string()))?;
    let [least, most] = [database.radius_min, database.radius_max];
    if !(0.0 < least && least <= most && most.is_finite()) {
        return Err(missing("radius_min, radius_max"));
    }
    // Rounded, so that the radii of the shipped model are 0.6 and 1.4 of the mean to the last bit
    Ok((material, [least, most].map(|radius| rounded(2.0 * radius / (least + most), 12))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes_for_tests::disc;

    #[test]
    fn a_model_file_has_grains_of_its_own() {
        let shipped = DiscModel::shipped().unwrap();
        assert_eq!((shipped.radii(), shipped.porosities()), ([0.6, 1.4], POROSITIES));
        assert_eq!(shipped.material(&disc(0)), Material::default());
        assert_eq!(shipped.packing_angle(), PACKING_FRICTION.atan());
        let file = std::env::temp_dir().join(format!("msdd-disc-model-{}", std::process::id()));
        let read = |from: &str, to: &str| {
            let text = shipped.law().to_json().replace("\"radius_min\": 0.003", "\"radius_min\": 0.004");
            msdd_files::write(&file, text.replace(from, to).as_bytes()).unwrap();
            DiscModel::read(&file).map_err(|error| error.to_string())
        };
        let own = read("\"friction_angle\": 0.5", "\"friction_angle\": 0.3").unwrap();
        assert_ne!(own, shipped);
        assert_eq!((own.material(&disc(0)).friction_angle, own.packing_angle()), (0.3, 0.3));
        assert!((own.radii()[0] - 8.0 / 11.0).abs() < 1e-9);
        let error = read("\"stiffness_ratio\": 0.8,", "").unwrap_err();
        assert!(
            error.starts_with("model = ") && error.contains("missing field `stiffness_ratio`"),
            "{error}"
        );
        std::fs::remove_file(&file).unwrap();
    }
}
