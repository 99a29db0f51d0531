//! The bed of a case as DEM describes it.

use super::shape::{DIGITS, Extent, Mesh};
use super::walls::Walls;
use crate::error::CliError;
use msdd_beds::case::{
    BedCase, FRICTION, GasKeys, Grains, Heated, Lid, RESTITUTION, RecordKeys, Shell, SolverKeys, Time, Vessel,
};
use msdd_beds::named_gases::GasName;
use msdd_beds::property::Property;
use msdd_beds::schedule::Schedule;
use msdd_beds::sizes::{Moments, Sizes};
use msdd_case::case::{GRAIN_KEYS, optional, points};
use msdd_case::dictionary::{Dictionary, Entry, joined};
use msdd_case::functions::{property, schedule};
use msdd_case::numbers::{plain, rounded};
use std::f64::consts::PI;
use std::path::Path;

/// Without gravity in the case, the most that the weight of the bed adds to the stress at its bottom, over the pressure of the lid.
const LIGHT: f64 = 0.05;
const GRAVITY: f64 = 9.81;
/// Significant digits of what comes back exactly.
const EXACT: i32 = 12;
/// Spheres of which moments are taken while their number is not known.
const MANY: usize = 1000;
/// Keys of the properties that have no part in DEM, or are read here.
const KNOWN: [&str; 6] =
    ["FoamFile", "surrogate", "mechanics", "equilibriumCoeffs", "restStress", "bulkDensity"];

/// What a case is read from, and what of it is left out.
pub struct Reader<'a> {
    folder: &'a Path,
    properties: Dictionary,
    temperature: Dictionary,
    control: Dictionary,
    mesh: Mesh,
    pub notes: Vec<String>,
}

impl<'a> Reader<'a> {
    /// # Errors
    /// A file that cannot be read; a case without spheres; a mesh that is no box and no wedge.
    pub fn open(folder: &'a Path) -> Result<Self, CliError> {
        let file = |name: &str| Dictionary::expanded(&folder.join(name));
        let properties = file("constant/granularProperties")?;
        let surrogate = properties.dictionary_at("surrogate")?;
        let kind = surrogate.text("type")?;
        let flow = properties.text("flow").unwrap_or_else(|_| "none".to_string());
        if flow != "none" {
            return Err(properties.refuse("flow", &flow, "none: the gas of DEM is at rest").into());
        }
        if kind != "spheres" {
            return Err(surrogate.refuse("type", &kind, "spheres: of discs use 'msdd reference run'").into());
        }
        Ok(Self {
            folder,
            temperature: file("0/T")?,
            control: file("system/controlDict")?,
            mesh: Mesh::read(&file("system/blockMeshDict")?)?,
            properties,
            notes: Vec::new(),
        })
    }

    /// The description.
    ///
    /// # Errors
    /// A value that is missing or not understood.
    pub fn scene(&mut self) -> Result<BedCase, CliError> {
        let heated = self.heated()?;
        let mut grains = self.grains()?;
        let extent = self.mesh.extent(grains.diameter, &heated);
        let porosity = self.mean("0/porosity")?;
        let walls = Walls::read(&self.properties, &self.mesh, &mut self.notes)?;
        grains.wall_friction = walls.friction;
        let mass = grains.density * (1.0 - porosity) * extent.depth;
        let pressure = match walls.pressing.as_ref().map(|pressing| pressing.at(0.0)) {
            Some(pressing) => pressing / self.widening(&extent).powi(2),
            None => self.pressure_on_top(mass)?,
        };
        let mut container = self.container(&mut grains, porosity, &extent)?;
        container.gravity = self.gravity(mass, pressure)?;
        let time = self.time()?;
        let scaled = |pressing: Schedule| scaled(pressing, self.widening(&extent).powi(-2));
        let lid = Lid {
            pressure: Some(rounded(pressure, DIGITS)),
            porosity: None,
            strain: walls.strain,
            pressing: walls.pressing.map(scaled),
        };
        let shell = walls.shell.map(|shell| Shell {
            thickness: rounded(shell.thickness * self.widening(&extent), DIGITS),
            ..shell
        });
        let record = self.record(&extent, &heated);
        let heat_source = self.heat_source(porosity)?;
        self.left_out()?;
        if grains.size_spread.is_some() {
            let note = "sizes: the case has sizeSpread alone; a log-normal distribution of it is taken";
            self.notes.push(note.to_string());
        }
        Ok(BedCase {
            seed: 1,
            heat_source,
            grains,
            container,
            lid: Some(lid),
            turn: None,
            gas: self.gas()?,
            heated,
            plate: None,
            flow: None,
            shell,
            sides: None,
            time,
            record,
            solver: SolverKeys::default(),
            experiment: None,
            vary: Vec::new(),
        }
        .filled())
    }

    /// The radius of a cylinder over that of its mesh.
    fn widening(&self, extent: &Extent) -> f64 {
        extent.radius.zip(self.mesh.radii.last()).map_or(1.0, |(radius, mesh)| radius / mesh)
    }

    fn spheres(&self) -> Result<&Dictionary, CliError> {
        Ok(self.properties.dictionary_at("surrogate")?.dictionary_at("spheresCoeffs")?)
    }

    /// The mean of a field over the cells.
    fn mean(&mut self, name: &str) -> Result<f64, CliError> {
        let field = Dictionary::expanded(&self.folder.join(name))?;
        if field.text("internalField")?.starts_with("nonuniform") {
            self.notes.push(format!("{name}: the mean over the cells is taken"));
        }
        Ok(field.mean("internalField")?)
    }

    /// All but the number of the spheres and the friction of the walls.
    fn grains(&self) -> Result<Grains, CliError> {
        let (of, spheres) = (&self.properties, self.spheres()?);
        let positive = |key: &str| of.number(key, |value| value > 0.0 && value.is_finite(), "above 0");
        let over_temperature = |of: &Dictionary, key: &str| {
            let tokens = of.value(key)?;
            property(tokens)
                .ok_or_else(|| of.refuse(key, &joined(tokens), "a number, or table ((T value) ...)"))
        };
        let young_modulus = positive("youngModulus")?;
        let (roughness, hardness) =
            (spheres.number_or("roughness", 0.0)?, spheres.number_or("hardness", 0.0)?);
        let expansion = of.number_or("thermalExpansion", 0.0)?;
        let spread = spheres.number_or("sizeSpread", 0.0)?;
        let radiates = !spheres.text("radiation").is_ok_and(|on| on == "off");
        let emissivity = match spheres.get("emissivity") {
            Some(_) if radiates => Some(over_temperature(spheres, "emissivity")?),
            _ => None,
        };
        Ok(Grains {
            number: 0,
            diameter: rounded(2.0 * positive("meanRadius")?, DIGITS + 1),
            density: positive("density")?,
            young_modulus,
            poisson_ratio: spheres.number_or("poissonRatio", 0.3)?,
            simulated_young_modulus: f64::NAN,
            friction: spheres.number_or("friction", FRICTION)?,
            wall_friction: 0.0,
            restitution: RESTITUTION,
            conductivity: over_temperature(of, "thermalConductivity")?,
            heat_capacity: over_temperature(of, "heatCapacity")?,
            roughness: (roughness > 0.0).then_some(roughness),
            hardness: (roughness > 0.0).then_some(hardness),
            yield_stress: None,
            emissivity: emissivity.filter(|given| *given != Property::Constant(0.0)),
            rays: None,
            sizes: None,
            size_spread: (spread > 0.0).then_some(spread),
            crush_load: None,
            thermal_expansion: (expansion > 0.0).then_some(expansion),
        })
    }

    fn gas(&self) -> Result<GasKeys, CliError> {
        let spheres = self.spheres()?;
        let name = spheres.text("gas")?;
        let known = GasName::ALL.into_iter().find(|gas| gas.to_string() == name);
        let known =
            known.ok_or_else(|| spheres.refuse("gas", &name, "air, nitrogen, helium, argon, vacuum"))?;
        Ok(GasKeys {
            name: known,
            pressure: spheres.number_or("gasPressure", 101_325.0)?,
            accommodation: spheres.number_or("accommodation", 0.9)?,
        })
    }

    /// The walls that have a temperature. Other conditions than this and insulation are left out, and noted.
    fn heated(&mut self) -> Result<Vec<Heated>, CliError> {
        let patches = self.temperature.dictionary_at("boundaryField")?;
        let mut heated = Vec::new();
        for &(patch, wall) in &self.mesh.walls {
            let Some(Entry::Dictionary(condition)) = patches.matching(patch) else {
                return Err(patches.refuse(patch, "missing", "a condition of the wall").into());
            };
            let kind = condition.text("type")?;
            let mut resists = false;
            let function = match kind.as_str() {
                "fixedValue" => schedule(condition.value("value")?, 1, |value| value[0]),
                "uniformFixedValue" => match condition.get("uniformValue") {
                    Some(Entry::Value(tokens)) => schedule(tokens, 1, |value| value[0]),
                    _ => None,
                },
                "granularWall" if condition.get("temperature").is_some() => {
                    resists = true;
                    if !self.mesh.is_of_elements {
                        self.notes.push(format!(
                            "0/T: the surface of the wall {wall} has the temperature of '{patch}', and the stiffness and asperities of the spheres"
                        ));
                    }
                    schedule(condition.value("temperature")?, 1, |value| value[0])
                }
                "zeroGradient" => continue,
                "fixedGradient" if condition.uniform("gradient").is_ok_and(|gradient| gradient == 0.0) => {
                    continue;
                }
                _ => None,
            };
            match function {
                Some(temperature) => heated.push(Heated { resists, ..Heated::new(wall, temperature) }),
                None => self.notes.push(format!(
                    "0/T: the condition of '{patch}' (type {kind}) is left out, the wall {wall} is insulated; possible: a temperature, \
                     constant or a table over time"
                )),
            }
        }
        Ok(heated)
    }

    /// The number of spheres of the whole bed that the case holds for 'msdd case solve'.
    fn number_of_whole_bed(&self) -> Option<f64> {
        let solution = Dictionary::expanded(&self.folder.join("system/fvSolution")).ok()?;
        let keys = solution.dictionary_at("msddFoam").ok()?;
        keys.number("grains", |value| value >= 1.0, "at least 1").ok()
    }

    fn moments(&self, grains: &Grains) -> Moments {
        Moments::new(grains.size_spread.map(Sizes::of_spread).as_ref(), MANY)
    }

    /// Container without its gravity; the spheres fill it.
    fn container(&mut self, grains: &mut Grains, porosity: f64, extent: &Extent) -> Result<Vessel, CliError> {
        let volume = PI / 6.0 * grains.diameter.powi(3) * self.moments(grains).volume;
        let [[x0, x1], [y0, y1]] = self.mesh.sides;
        let area = extent.radius.map_or((x1 - x0) * (y1 - y0), |radius| PI * radius * radius);
        let filling = (area * extent.depth * (1.0 - porosity) / volume).round();
        // The mesh of 'msdd bed case' is a column or a wedge of a bed whose porosity differs near its walls.
        let whole = self.number_of_whole_bed().filter(|_| self.mesh.is_of_elements);
        grains.number = whole.unwrap_or(filling) as usize;
        let mut base = [x1 - x0, y1 - y0];
        if self.mesh.is_of_elements && extent.radius.is_none() {
            let side = (grains.number as f64 * volume / ((1.0 - porosity) * extent.depth)).sqrt();
            base = [side; 2];
            self.notes.push(format!(
                "the mesh is a column of the bed: the base, {} m wide, follows from the {} spheres of system/fvSolution, without sides",
                plain(rounded(side, 4)),
                grains.number
            ));
        }
        Ok(Vessel {
            base: extent.radius.is_none().then(|| base.map(|length| rounded(length, DIGITS))),
            radius: extent.radius.map(|radius| rounded(radius, DIGITS)),
            endless: self.mesh.is_endless,
            gravity: GRAVITY,
            height: Some(rounded(extent.depth, DIGITS)),
            porosity: Some(rounded(porosity, DIGITS)),
        })
    }

    /// The heat of a constant source in the whole bed, over the volume of the spheres [W/m³]; other sources are noted.
    fn heat_source(&mut self, porosity: f64) -> Result<Option<f64>, CliError> {
        let mut heat = None;
        for name in ["constant/fvOptions", "system/fvOptions"] {
            let Some(sources) = optional(self.folder, name)? else { continue };
            for key in sources.keys().filter(|key| key.text != "FoamFile") {
                match sources.dictionary_at(&key.text).ok().and_then(constant_source) {
                    Some(source) if source >= 0.0 => *heat.get_or_insert(0.0) += source,
                    _ => self.notes.push(format!(
                        "{name}: {} is left out; possible: a constant scalarSemiImplicitSource of T, specific, in all cells, of 0 or more",
                        key.text
                    )),
                }
            }
        }
        Ok(heat.map(|heat| rounded(heat / (1.0 - porosity), EXACT)))
    }

    /// Gravity of the case downwards [m/s²].
    fn downwards(&self) -> Result<f64, CliError> {
        let Some(file) = optional(self.folder, "constant/g")? else { return Ok(0.0) };
        let tokens = file.value("value")?;
        let numbers: Vec<f64> = tokens.iter().filter_map(|token| token.text.parse().ok()).collect();
        let (axis, _) = self.mesh.axis();
        match numbers.iter().enumerate().all(|(k, value)| k == axis || *value == 0.0) && numbers.len() == 3 {
            true if numbers[axis] <= 0.0 => Ok(-numbers[axis]),
            _ => Err(file
                .refuse("value", &joined(tokens), "a vector downwards, along the axis of the bed")
                .into()),
        }
    }

    /// The same, or where it is none one so small that the bed hardly weighs; `mass`: of the bed on an area [kg/m²], `pressure`: of the
    /// lid [Pa].
    fn gravity(&mut self, mass: f64, pressure: f64) -> Result<f64, CliError> {
        let down = self.downwards()?;
        if down > 0.0 {
            return Ok(down);
        }
        let gravity = rounded(GRAVITY.min(LIGHT * pressure / mass), 2);
        self.notes.push(format!(
            "the case has no gravity: the spheres are poured under {} m/s2, which adds up to {} Pa at the floor",
            plain(gravity),
            plain(rounded(gravity * mass, 2))
        ));
        Ok(gravity)
    }

    /// The vertical stress under the top at the start [Pa].
    fn pressure_on_top(&self, mass: f64) -> Result<f64, CliError> {
        if let Ok(rest) = self.properties.dictionary_at("restStress") {
            return Ok(rest.number_or("surface", 0.0)?);
        }
        let stress = Dictionary::expanded(&self.folder.join("0/stress"))?;
        let vertical = -stress.means::<6>("internalField")?[self.mesh.axis().1];
        // That of 'msdd bed case' is the mean in the bed: half of its weight is below.
        let below = if self.mesh.is_of_elements { 0.5 * self.downwards()? * mass } else { 0.0 };
        Ok(vertical - below)
    }

    fn time(&mut self) -> Result<Time, CliError> {
        let positive =
            |key: &str| self.control.number(key, |value| value > 0.0 && value.is_finite(), "above 0");
        let end = positive("endTime")?;
        let output_every = positive("writeInterval")?.min(end);
        Ok(Time { output_every, ..Time::new(self.mean("0/T")?, end) })
    }

    /// Temperatures are recorded at the case's probes, as distances from the first heated wall, and averages taken where 'msdd bed case'
    /// had them; the usual places otherwise.
    fn record(&mut self, extent: &Extent, heated: &[Heated]) -> RecordKeys {
        let wall = heated.first().map_or("floor", |heated| heated.wall.as_str());
        let [[x0, x1], [y0, y1]] = self.mesh.sides;
        let from = |[x, y, z]: [f64; 3]| {
            let (height, radius) = if self.mesh.is_wedge { (x, y.hypot(z)) } else { (z, 0.0) };
            match wall {
                "floor" => height - extent.floor,
                "lid" => extent.floor + extent.depth - height,
                "side" => extent.radius.unwrap_or_default() - radius,
                "x_low" => x - x0,
                "x_high" => x1 - x,
                "y_low" => y - y0,
                _ => y1 - y,
            }
        };
        let probes = self.control.dictionary_at("functions").and_then(|all| all.dictionary_at("probes"));
        let probes = probes.and_then(|probes| probes.value("probeLocations")).ok().and_then(points);
        let mut distances: Vec<f64> =
            probes.unwrap_or_default().into_iter().map(|point| rounded(from(point), DIGITS)).collect();
        distances.retain(|&distance| distance > 0.0);
        distances.sort_by(f64::total_cmp);
        distances.dedup();
        if distances.is_empty() {
            self.notes.push("the case has no probes: T is recorded in the middle".to_string());
        }
        let (heights, radius) = match (self.mesh.is_of_elements, self.mesh.levels.as_slice()) {
            (true, &[_, low, high, _]) => (
                [low, high].map(|height| rounded(height, DIGITS)),
                self.mesh.radii.get(1).map(|&radius| rounded(radius, DIGITS)),
            ),
            _ => Default::default(),
        };
        RecordKeys { wall: wall.to_string(), distances, heights, radius }
    }

    /// Notes what DEM does not have.
    fn left_out(&mut self) -> Result<(), CliError> {
        if self.properties.text("mechanics").is_ok_and(|mechanics| mechanics == "none") {
            self.notes.push("mechanics none: the spheres of DEM move all the same".to_string());
        }
        let known = |key: &str| KNOWN.contains(&key) || GRAIN_KEYS.contains(&key);
        let others = self.properties.keys().filter(|key| !known(&key.text));
        let others = others.map(|key| format!("constant/granularProperties: {} is left out", key.text));
        self.notes.extend(others.collect::<Vec<_>>());
        Ok(())
    }
}

/// The heat of a source that is constant in the whole volume [W/m³].
fn constant_source(source: &Dictionary) -> Option<f64> {
    let is = |key: &str, value: &str| source.text(key).is_ok_and(|text| text == value);
    let whole =
        is("type", "scalarSemiImplicitSource") && is("selectionMode", "all") && is("volumeMode", "specific");
    let off = source.text("active").is_ok_and(|on| ["no", "off", "false"].contains(&on.as_str()));
    let rates = source.dictionary_at("injectionRateSuSp").ok()?;
    let numbers: Vec<f64> =
        rates.value("T").ok()?.iter().filter_map(|token| token.text.parse().ok()).collect();
    match numbers.as_slice() {
        &[constant, slope] if whole && !off && slope == 0.0 => Some(constant),
        _ => None,
    }
}

/// All values times a factor.
fn scaled(schedule: Schedule, factor: f64) -> Schedule {
    match schedule {
        Schedule::Constant(value) => Schedule::Constant(rounded(value * factor, DIGITS)),
        Schedule::Table(rows) => Schedule::Table(
            rows.into_iter().map(|[time, value]| [time, rounded(value * factor, DIGITS)]).collect(),
        ),
    }
}
