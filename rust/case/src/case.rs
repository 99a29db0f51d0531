//! Reads a case for the reference simulation from the solver's own files, so that every parameter stands in one place.

use crate::CaseError;
use crate::dictionary::{Dictionary, Entry, Token, joined};
use crate::model::ModelGrains;
use crate::numbers::{plain, short};
use crate::walls::{self, WallOverTime, heat_of_walls};
use msdd_dem::{Material, Thermal};
use std::path::{Path, PathBuf};

/// Keys of `constant/granularProperties` for properties of the grains.
pub const GRAIN_KEYS: [&str; 6] =
    ["density", "youngModulus", "thermalConductivity", "heatCapacity", "thermalExpansion", "meanRadius"];
/// Keys there that concern the solver alone.
const SOLVER_KEYS: [&str; 6] =
    ["FoamFile", "surrogate", "conductivityFactor", "bulkDensity", "mechanics", "equilibriumCoeffs"];
/// Parameters of a case.
#[derive(Clone, Debug)]
pub struct Case {
    pub folder: PathBuf,
    /// Name of the folder.
    pub name: String,
    /// Material with the density and E of the case; the other parameters are those of its surrogate, see [`ModelGrains`].
    pub material: Material,
    pub thermal: Thermal,
    /// r̄ of the grains \[m\].
    pub mean_radius: f64,
    /// Smallest and largest radius over r̄ \[-\], likewise of the surrogate.
    pub radii: [f64; 2],
    /// The surrogate that says so.
    pub source: String,
    /// Initial temperature of all grains \[K\].
    pub initial_temperature: f64,
    /// Thermal boundary conditions, in the order of `Side`.
    pub walls: [WallOverTime; 4],
    /// Lower left corner of the box in the case's coordinates \[m\].
    pub origin: [f64; 2],
    /// Width and height of the box \[m\].
    pub size: [f64; 2],
    /// End of the simulation \[s\].
    pub end_time: f64,
    /// Points where T is recorded \[m\], relative to the lower left corner of the box.
    pub probes: Vec<[f64; 2]>,
}

impl Case {
    /// Highest less lowest temperature of the walls at any time and of the start \[K\].
    pub fn temperature_range(&self) -> f64 {
        let [least, most] = walls::temperatures(self.initial_temperature, &self.walls);
        most - least
    }

    /// What the surrogate says of the grains, in words.
    pub fn grains_of_surrogate(&self) -> String {
        let [low, high] = self.radii.map(short);
        format!(
            "friction angle {} rad, stiffness ratio {}, radii from {low} to {high} of the mean, as in the {}",
            plain(self.material.friction_angle),
            plain(self.material.stiffness_ratio),
            self.source
        )
    }

    /// Reads `0/T`, `constant/granularProperties`, `system/controlDict` and `system/blockMeshDict` of a folder.
    ///
    /// # Errors
    /// [`CaseError`] with file, key, value and what is allowed, for everything that this reader does not understand, and for
    /// gravity, heat sources and a surrogate whose grains are not known; nothing that could change the result is ignored.
    pub fn read(folder: &Path) -> Result<Self, CaseError> {
        let temperature = Dictionary::expanded(&folder.join("0/T"))?;
        let grains = Dictionary::expanded(&folder.join("constant/granularProperties"))?;
        let control = Dictionary::expanded(&folder.join("system/controlDict"))?;
        let model = ModelGrains::of(folder, &grains)?;
        let mesh = Dictionary::expanded(&folder.join("system/blockMeshDict"))?;
        check_gravity(folder)?;
        check_sources(folder)?;
        let (low, high) = bounds(&mesh)?;
        let (material, thermal, mean_radius) = read_grains(&grains, &model)?;
        let name = folder.canonicalize().ok().and_then(|path| Some(path.file_name()?.to_owned()));
        Ok(Self {
            folder: folder.to_path_buf(),
            name: name.unwrap_or_default().to_string_lossy().into_owned(),
            material,
            thermal,
            mean_radius,
            radii: model.radii,
            source: model.source,
            initial_temperature: initial_temperature(&temperature)?,
            walls: heat_of_walls(&temperature)?,
            origin: low,
            size: [high[0] - low[0], high[1] - low[1]],
            end_time: end_time(&control)?,
            probes: probes(&control)?.into_iter().map(|[x, y]| [x - low[0], y - low[1]]).collect(),
        })
    }

    /// The case with its heat capacity and all times divided by a number of at least 1. Grains in equilibrium have the same
    /// temperatures and stresses then, at times divided by it.
    #[must_use]
    pub fn sped_up(mut self, factor: f64) -> Self {
        self.thermal.heat_capacity /= factor;
        self.end_time /= factor;
        for wall in &mut self.walls {
            if let WallOverTime::Table(rows) = wall {
                rows.iter_mut().for_each(|row| row[0] /= factor);
            }
        }
        self
    }
}

/// A file of a case, which may be packed; `None` if it is not there.
///
/// # Errors
/// Those of [`Dictionary::expanded`].
pub fn optional(folder: &Path, name: &str) -> Result<Option<Dictionary>, CaseError> {
    let is_there = folder.join(name).exists() || folder.join(format!("{name}.gz")).exists();
    is_there.then(|| Dictionary::expanded(&folder.join(name))).transpose()
}

/// Discs have no weight.
fn check_gravity(folder: &Path) -> Result<(), CaseError> {
    let Some(gravity) = optional(folder, "constant/g")? else { return Ok(()) };
    let tokens = gravity.value("value")?;
    let mut numbers = tokens.iter().filter(|token| !["(", ")"].contains(&token.text.as_str()));
    match numbers.all(|token| token.text.parse() == Ok(0.0)) {
        true => Ok(()),
        false => Err(gravity.refuse("value", &joined(tokens), "(0 0 0): discs have no weight")),
    }
}

/// Discs know no heat from inside.
fn check_sources(folder: &Path) -> Result<(), CaseError> {
    for name in ["constant/fvOptions", "system/fvOptions"] {
        let Some(sources) = optional(folder, name)? else { continue };
        if let Some(key) = sources.keys().find(|key| key.text != "FoamFile") {
            return Err(sources.refuse(&key.text, "{...}", "no sources: discs have no heat from inside"));
        }
    }
    Ok(())
}

fn read_grains(file: &Dictionary, model: &ModelGrains) -> Result<(Material, Thermal, f64), CaseError> {
    file.check_keys(&[&GRAIN_KEYS, &SOLVER_KEYS])?;
    let positive = |key| file.number(key, |v| v > 0.0 && v.is_finite(), "> 0");
    let material = Material {
        density: positive("density")?,
        young_modulus: positive("youngModulus")?,
        ..model.material.clone()
    };
    let thermal = Thermal {
        conductivity: positive("thermalConductivity")?,
        heat_capacity: positive("heatCapacity")?,
        expansion: file.number("thermalExpansion", |v| v >= 0.0 && v.is_finite(), ">= 0")?,
    };
    Ok((material, thermal, positive("meanRadius")?))
}

fn initial_temperature(file: &Dictionary) -> Result<f64, CaseError> {
    file.check_keys(&[&["FoamFile", "dimensions", "internalField", "boundaryField"]])?;
    let dimensions = file.text("dimensions")?;
    if dimensions != "[ 0 0 0 1 0 0 0 ]" {
        return Err(file.refuse("dimensions", &dimensions, "[ 0 0 0 1 0 0 0 ]"));
    }
    file.uniform("internalField")
}

fn end_time(file: &Dictionary) -> Result<f64, CaseError> {
    file.number("startTime", |v| v == 0.0, "0, as the grains start at rest")?;
    let stop = file.text("stopAt")?;
    if stop != "endTime" {
        return Err(file.refuse("stopAt", &stop, "endTime"));
    }
    file.number("endTime", |v| v > 0.0 && v.is_finite(), "> 0 s")
}

/// The points of the function object `probes`; empty without it.
fn probes(file: &Dictionary) -> Result<Vec<[f64; 2]>, CaseError> {
    let Some(Entry::Dictionary(functions)) = file.get("functions") else { return Ok(Vec::new()) };
    let Some(Entry::Dictionary(probes)) = functions.get("probes") else { return Ok(Vec::new()) };
    let tokens = probes.value("probeLocations")?;
    points(tokens)
        .map(|points| points.into_iter().map(|[x, y, _]| [x, y]).collect())
        .ok_or_else(|| probes.refuse("probeLocations", &joined(tokens), "a list of points (x y z)"))
}

/// Lower left and upper right corner of the box in the plane [m].
pub(crate) fn bounds(file: &Dictionary) -> Result<([f64; 2], [f64; 2]), CaseError> {
    let key = if file.get("scale").is_some() { "scale" } else { "convertToMeters" };
    let scale = file.number(key, |v| v > 0.0 && v.is_finite(), "> 0")?;
    let tokens = file.value("vertices")?;
    let points = points(tokens).filter(|points| points.len() == 8);
    let points =
        points.ok_or_else(|| file.refuse("vertices", &joined(tokens), "the 8 corners of one block"))?;
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in &points {
        for k in 0..2 {
            low[k] = low[k].min(scale * point[k]);
            high[k] = high[k].max(scale * point[k]);
        }
    }
    let corner = |p: &[f64; 3]| (0..2).all(|k| scale * p[k] == low[k] || scale * p[k] == high[k]);
    if !points.iter().all(corner) || low[0] >= high[0] || low[1] >= high[1] {
        return Err(file.refuse("vertices", &joined(tokens), "the corners of a box along the axes"));
    }
    Ok((low, high))
}

/// All corners of the blocks [m], if they can be read.
pub fn corners(file: &Dictionary) -> Option<Vec<[f64; 3]>> {
    let key = if file.get("scale").is_some() { "scale" } else { "convertToMeters" };
    let scale = match file.get(key) {
        Some(_) => file.number(key, |v| v > 0.0 && v.is_finite(), "> 0").ok()?,
        None => 1.0,
    };
    let points = points(file.value("vertices").ok()?)?;
    Some(points.into_iter().map(|point| point.map(|x| scale * x)).collect())
}

/// Reads `( ( x y z ) ... )`, also with the number of points in front.
pub fn points(tokens: &[Token]) -> Option<Vec<[f64; 3]>> {
    let inner = match tokens {
        [open, inner @ .., close] if open.text == "(" && close.text == ")" => inner,
        [_, open, inner @ .., close] if open.text == "(" && close.text == ")" => inner,
        _ => return None,
    };
    let point = |chunk: &[Token]| match chunk {
        [open, x, y, z, close] if open.text == "(" && close.text == ")" => {
            Some([x.text.parse().ok()?, y.text.parse().ok()?, z.text.parse().ok()?])
        }
        _ => None,
    };
    inner.chunks(5).map(point).collect()
}

#[cfg(test)]
#[path = "case_tests.rs"]
mod tests;
