//! The parameters of a new case of a bed of spheres: shape, walls, spheres, gas, start, end. Nothing is written or printed here.

use super::material::Spheres;
use super::shape::Shape;
use super::start::{InitialBed, PouredBed};
use super::wall::{self, WallMaterial};
use crate::numbers::{plain, rounded};
use crate::ranges::{self, allow};
use crate::scene::Mechanics;
use crate::walls::{self, WallOverTime};
use crate::{CaseError, refused};
use msdd_beds::case::{BedCase, Flow, GasKeys, Heated, Shell};
use msdd_beds::effective::MIN_RATIO;
use msdd_beds::named_gases::GasName;
use msdd_beds::property::VALUES;
use msdd_beds::schedule::Schedule;
use msdd_dem::WallHeat;
use msdd_rve::message::number;
use serde::Deserialize;
use std::f64::consts::PI;

/// What the top of the bed does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Lid {
    /// It keeps the pressure of the start, and moves.
    #[default]
    Presses,
    /// It stays where it is.
    Stays,
}

/// All parameters of a new case, from the description of a bed. SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereCase {
    pub shape: Shape,
    /// Cells along each direction of the shape.
    pub cells: Vec<usize>,
    /// Thermal boundary conditions, in the order of [`Shape::walls`].
    pub walls: Vec<WallOverTime>,
    /// Initial temperature of the whole bed \[K\].
    pub initial_temperature: f64,
    /// Name of the material, for comments in the files.
    pub material: String,
    pub spheres: Spheres,
    pub gas: GasKeys,
    pub flow: Option<Flow>,
    /// 1 − volume of the spheres over the volume.
    pub porosity: f64,
    /// Pressure on the top at the start, which is the vertical stress there \[Pa\].
    pub pressure: f64,
    pub mechanics: Mechanics,
    pub lid: Lid,
    pub shell: Option<Shell>,
    /// Slack of the spheres at bottom and top where these stay \[mean diameters\].
    pub slack_layer: f64,
    /// Coefficient of friction of spheres and walls; 0: smooth.
    pub wall_friction: f64,
    /// Material of the walls that heat passes; none: they have their temperature where the mesh ends.
    pub wall_material: Option<WallMaterial>,
    /// Acceleration downwards \[m/s²\].
    pub gravity: f64,
    /// Heat released in the bed \[W/m³\], negative for a sink.
    pub heat_source: Option<f64>,
    /// End of the simulation \[s\].
    pub end_time: f64,
    /// Largest error of T that a time step may add \[K\]; `None`: a thousandth of the range of T.
    pub tolerance: Option<f64>,
    /// Whether the run ends before, once it is steady.
    pub steady: bool,
    /// Points where T is recorded \[m\]: x, y, z, or distance from the axis and height.
    pub probes: Vec<Vec<f64>>,
}

/// Slack of the spheres at plates that stay: about the mean of the poured beds, see `msdd bed slack`.
const SLACK: f64 = 1.0;
/// Porosity of poured beds of equal spheres.
const POROSITY: f64 = 0.4;
/// Gravity on earth \[m/s²\].
pub const GRAVITY: f64 = 9.81;
/// What a bed has, for messages.
pub const BED_HAS: &str = "bed has at least four spheres";

fn refuse<T>(key: &str, value: &str, allowed: &str) -> Result<T, CaseError> {
    Err(refused(key, value, allowed))
}

/// Refuses a vertical stress on the top \[Pa\] that the law does not know of these spheres.
///
/// # Errors
/// [`CaseError::Parameter`]; [`CaseError::Model`] when the shipped law cannot be read.
pub fn check_pressure(spheres: &Spheres, pressure: f64) -> Result<(), CaseError> {
    let short = |value: f64| number(rounded(value, 3));
    let [least, most] = PouredBed::new(spheres.clone(), pressure)?.pressures();
    allow("pressure", pressure, (least..=most).contains(&pressure), || {
        format!("{} to {} Pa, the range of the law for these", short(least), short(most))
    })
}

/// Refuses a porosity that the law does not know under this stress \[Pa\].
///
/// # Errors
/// As for [`check_pressure`].
pub fn check_porosity(spheres: &Spheres, pressure: f64, porosity: f64) -> Result<(), CaseError> {
    let known = PouredBed::new(spheres.clone(), pressure)?.porosities();
    let inside = known.is_some_and(|[least, most]| (least..=most).contains(&porosity));
    allow("porosity", porosity, inside, || match known {
        Some([least, most]) => format!(
            "{least} to {most}, the training range of the law of spheres, under {} Pa",
            number(pressure)
        ),
        None => "none under this pressure: take another".to_string(),
    })
}

/// Usual porosity of beds that were poured with a friction of 0.3, to three digits.
pub fn usual_porosity(spheres: &Spheres) -> f64 {
    rounded(1.0 - (1.0 - POROSITY) / spheres.equal_density(), 3)
}

/// The box or the cylinder of a bed.
fn shape_of(bed: &BedCase) -> Result<Shape, CaseError> {
    let vessel = &bed.container;
    let Some(height) = vessel.height else {
        return refuse("container.height", "not given", "the height of the bed [m]");
    };
    match (vessel.base, vessel.radius) {
        (Some([x, y]), None) => Ok(Shape::Box([x, y, height])),
        (None, Some(radius)) => Ok(Shape::Cylinder { radius, height }),
        _ => refuse("container", "both or neither of base and radius", "one of base and radius"),
    }
}

/// The conditions of the walls, in the order of [`Shape::walls`].
fn walls_of(heated: &[Heated], shape: &Shape) -> Result<Vec<WallOverTime>, CaseError> {
    let names = shape.bed_walls();
    if let Some(heated) = heated.iter().find(|heated| !names.contains(&heated.wall.as_str())) {
        return refuse("heated.wall", &heated.wall, &names.join(", "));
    }
    let condition = |name: &&str| {
        let Some(own) = heated.iter().find(|heated| heated.wall == *name) else {
            return Ok(WallOverTime::Steady(WallHeat::Insulated));
        };
        match (&own.temperature, own.coefficient, own.outside, own.flux) {
            (Some(Schedule::Constant(value)), None, _, None) => {
                Ok(WallOverTime::Steady(WallHeat::Temperature(*value)))
            }
            (Some(Schedule::Table(rows)), None, _, None) => WallOverTime::table(rows.clone())
                .ok_or_else(|| refused("heated.temperature", *name, "a table of rising times from 0 on")),
            (None, Some(coefficient), Some(outside), None) => {
                Ok(WallOverTime::Coefficient { coefficient, outside })
            }
            (None, None, None, Some(flux)) => Ok(WallOverTime::Flux(flux)),
            _ => refuse("heated", name, "one of temperature, flux, or coefficient with outside"),
        }
    };
    names.iter().map(condition).collect()
}

/// A wall that heat passes, as the description of a bed has it.
pub fn heated(wall: &str, condition: &WallOverTime) -> Option<Heated> {
    let named = Heated { wall: wall.to_string(), ..Heated::default() };
    match condition.clone() {
        WallOverTime::Steady(WallHeat::Temperature(value)) => {
            Some(Heated::new(wall, Schedule::Constant(value)))
        }
        WallOverTime::Table(rows) => Some(Heated::new(wall, Schedule::Table(rows))),
        WallOverTime::Coefficient { coefficient, outside } => {
            Some(Heated { coefficient: Some(coefficient), outside: Some(outside), ..named })
        }
        WallOverTime::Flux(flux) => Some(Heated { flux: Some(flux), ..named }),
        WallOverTime::Steady(_) => None,
    }
}

impl SphereCase {
    /// The case of a bed; `material`: its name, for comments in the files.
    ///
    /// # Errors
    /// What only DEM computes; the errors of [`Self::check`].
    pub fn new(bed: &BedCase, material: &str) -> Result<Self, CaseError> {
        let (strain, pressing) = bed.lid_moves();
        let of_dem = [
            ("plate", bed.plate.is_some()),
            ("turn", bed.turn.is_some()),
            ("sides", bed.sides.is_some()),
            ("container.endless", bed.container.endless),
            ("lid.strain", strain.is_some()),
        ];
        if let Some((key, _)) = of_dem.into_iter().find(|(_, given)| *given) {
            return refuse(key, "given", "only by 'msdd bed run' and 'msdd bed case'");
        }
        let lid = match pressing {
            None => Lid::Stays,
            Some(Schedule::Constant(value)) if *value == bed.pressure() => Lid::Presses,
            Some(_) => return refuse("lid.pressing", "another pressure", "lid.pressure, or none"),
        };
        let (keys, shape) = (&bed.solver, shape_of(bed)?);
        let initial_temperature = bed.time.initial_temperature;
        let spheres = Spheres::of_bed(&bed.grains, initial_temperature);
        let porosity = bed.container.porosity.unwrap_or_else(|| usual_porosity(&spheres));
        let mechanics = keys.mechanics.unwrap_or_default();
        let slack = if lid == Lid::Stays && mechanics == Mechanics::Equilibrium { SLACK } else { 0.0 };
        let mut scene = Self {
            cells: keys.cells.clone().unwrap_or_default(),
            walls: walls_of(&bed.heated, &shape)?,
            shape,
            initial_temperature,
            material: material.to_string(),
            spheres,
            gas: bed.gas.clone(),
            flow: bed.flow,
            porosity,
            pressure: bed.pressure(),
            mechanics,
            lid,
            shell: bed.shell.clone(),
            slack_layer: keys.slack_layer.unwrap_or(slack),
            wall_friction: bed.grains.wall_friction,
            wall_material: WallMaterial::named(keys.wall_material.as_deref())?,
            gravity: bed.container.gravity,
            // By the volume of the bed; twelve digits, so that a number comes back as it was given.
            heat_source: bed.heat_source.map(|heat| rounded(heat * (1.0 - porosity), 12)),
            end_time: bed.time.end,
            tolerance: keys.tolerance,
            steady: keys.steady,
            probes: keys.probes.clone(),
        };
        if keys.cells.is_none() {
            scene.cells = scene.shape.proposed_cells(&scene.varies(), 2.0 * scene.spheres.radius());
        }
        scene.check()?;
        if scene.probes.is_empty() {
            scene.probes = scene.shape.proposed_probes(scene.steepest());
        }
        scene.check()?;
        Ok(scene)
    }

    /// Refuses values out of range; the error names the first of them.
    ///
    /// # Errors
    /// [`CaseError::Parameter`]; [`CaseError::Model`] when the shipped law cannot be read.
    pub fn check(&self) -> Result<(), CaseError> {
        self.spheres.check()?;
        self.check_mesh()?;
        self.check_heat()?;
        self.check_flow()?;
        self.check_properties()?;
        check_pressure(&self.spheres, self.pressure)?;
        check_porosity(&self.spheres, self.pressure, self.porosity)?;
        self.check_mechanics()?;
        ranges::end_time(self.end_time)?;
        self.tolerance.map_or(Ok(()), ranges::tolerance)
    }

    fn check_mesh(&self) -> Result<(), CaseError> {
        for (key, length) in self.shape.lengths() {
            ranges::length(key, length, self.spheres.radius(), BED_HAS)?;
        }
        let directions = self.shape.lengths().len();
        if self.cells.len() != directions {
            return refuse("cells", &format!("{:?}", self.cells), &format!("{directions} numbers"));
        }
        ranges::cells(&self.cells)?;
        match self.probes.iter().find(|probe| !self.shape.holds(probe)) {
            Some(probe) => {
                let value = probe.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
                refuse("probe", &value, &self.shape.points_allowed())
            }
            None => Ok(()),
        }
    }

    fn check_heat(&self) -> Result<(), CaseError> {
        let gas = self.gas.name;
        ranges::temperature_with(gas, "initial temperature", self.initial_temperature)?;
        for (name, wall) in self.shape.walls().iter().zip(&self.walls) {
            ranges::wall(wall, |value| ranges::temperature_with(gas, name, value))?;
        }
        ranges::gas_pressure(self.gas.pressure)?;
        for temperature in self.temperatures() {
            let Some(between) = gas.at(temperature, self.gas.pressure, 1.0) else { continue };
            let solid = self.spheres.conductivity.at(temperature);
            let least = MIN_RATIO * between.conductivity;
            allow("thermalConductivity", solid, solid >= least, || {
                let (least, at) = (number(rounded(least, 3)), number(temperature));
                format!("at least the conductivity of the gas ({gas}), {least} W/(m K) at {at} K")
            })?;
        }
        self.heat_source.map_or(Ok(()), ranges::heat_source)
    }

    /// Tables over T have to cover the temperatures of the run, those of the gas that flows in among them.
    fn check_properties(&self) -> Result<(), CaseError> {
        let spheres = &self.spheres;
        for (key, property) in [
            ("thermalConductivity", &spheres.conductivity),
            ("heatCapacity", &spheres.heat_capacity),
            ("emissivity", &spheres.emissivity),
        ] {
            if let Err((value, allowed)) = property.check(self.temperatures(), [0.0, VALUES[1]]) {
                return refuse(key, &value, &allowed);
            }
        }
        Ok(())
    }

    fn check_flow(&self) -> Result<(), CaseError> {
        let Some(flow) = self.flow else { return Ok(()) };
        allow("flow", flow.mass, flow.mass > 0.0 && flow.mass <= 1e6, || {
            "more than 0, at most 1e6 kg/s".to_string()
        })?;
        ranges::temperature_with(self.gas.name, "flow temperature", flow.temperature)?;
        if self.gas.name == GasName::Vacuum {
            return refuse("gas", "vacuum", "with a flow: air, nitrogen, helium, argon");
        }
        let mut walls = self.shape.walls().iter().zip(self.warm());
        match walls.find(|(name, warm)| *warm && flow.ends().contains(name)) {
            Some((name, _)) => refuse(name, "not insulated", "insulated: the gas flows through this wall"),
            None => Ok(()),
        }
    }

    fn check_mechanics(&self) -> Result<(), CaseError> {
        ranges::gravity(self.gravity)?;
        allow("slackLayer", self.slack_layer, (0.0..=1000.0).contains(&self.slack_layer), || {
            "0 to 1000 diameters of a sphere".to_string()
        })?;
        ranges::wall_friction(self.wall_friction)?;
        let still = self.mechanics == Mechanics::None;
        for (key, value) in [("wall friction", self.wall_friction), ("gravity", self.gravity)] {
            let allowed = || "0 with mechanics none, where spheres stay where they are".to_string();
            allow(key, value, !still || value <= 0.0, allowed)?;
        }
        let Some(shell) = &self.shell else { return Ok(()) };
        let Shape::Cylinder { radius, .. } = self.shape else {
            return refuse("shell", "given", "with the shape cylinder, whose side it is");
        };
        if still {
            return refuse("shell", "given", "with mechanics equilibrium");
        }
        let (modulus, expansion, thickness) = (shell.young_modulus, shell.thermal_expansion, shell.thickness);
        let good = (1.0..=1e15).contains(&modulus);
        allow("Young's modulus of the shell", modulus, good, || "1 to 1e15 Pa".to_string())?;
        let good = (0.0..=0.01).contains(&expansion);
        allow("thermal expansion of the shell", expansion, good, || "0 to 0.01 1/K".to_string())?;
        let most = 0.2 * radius;
        allow("thickness of the shell", thickness, 0.0 < thickness && thickness <= most, || {
            format!("more than 0, at most a fifth of the radius, {} m", number(rounded(most, 3)))
        })
    }

    fn bed(&self) -> Result<PouredBed, CaseError> {
        PouredBed::new(self.spheres.clone(), self.pressure)
    }

    /// The bed at the start.
    ///
    /// # Errors
    /// [`CaseError::Model`] when the shipped law cannot be read.
    pub fn start(&self) -> Result<InitialBed, CaseError> {
        Ok(self.bed()?.start(self.porosity, &self.gas, self.initial_temperature))
    }

    /// Number of spheres of the whole bed.
    pub fn number(&self) -> f64 {
        let radius = self.spheres.radius();
        self.shape.volume() * (1.0 - self.porosity) / (4.0 / 3.0 * PI * radius * radius * radius)
    }

    /// What the weight of the bed adds to the vertical stress at the bottom on earth \[Pa\].
    pub fn weight(&self) -> f64 {
        self.spheres.grains.density * (1.0 - self.porosity) * GRAVITY * self.shape.height()
    }

    /// Least and largest temperature of the initial state and of the walls at any time \[K\].
    pub fn temperatures(&self) -> [f64; 2] {
        let [least, most] = walls::temperatures(self.initial_temperature, &self.walls);
        match self.flow {
            Some(flow) => [least.min(flow.temperature), most.max(flow.temperature)],
            None => [least, most],
        }
    }

    /// Which walls heat passes.
    pub fn warm(&self) -> Vec<bool> {
        self.walls.iter().map(WallOverTime::conducts).collect()
    }

    /// Directions of the shape along which the bed is not uniform: where walls have a temperature, upwards under gravity, and all of them
    /// between rough walls.
    pub fn varies(&self) -> Vec<bool> {
        let mut varies: Vec<bool> =
            self.shape.heat_ways(&self.warm()).into_iter().map(f64::is_finite).collect();
        if let Some(up) = varies.last_mut() {
            *up |= self.gravity > 0.0 || self.flow.is_some();
        }
        if self.wall_friction > 0.0 {
            varies.fill(true);
        }
        varies
    }

    /// The direction along which heat has the shortest way; the first if no wall has a temperature.
    pub fn steepest(&self) -> usize {
        let ways = self.shape.heat_ways(&self.warm());
        if self.flow.is_some() {
            return ways.len() - 1;
        }
        (0..ways.len()).min_by(|&a, &b| ways[a].total_cmp(&ways[b])).unwrap_or(0)
    }

    /// Length over which heat has to spread \[m\]: the shortest of the directions along which walls have a temperature, else the
    /// longest side of the bed.
    pub fn heat_way(&self) -> f64 {
        let way = self.shape.heat_ways(&self.warm()).into_iter().fold(f64::INFINITY, f64::min);
        if way.is_finite() {
            return way;
        }
        self.shape.lengths().iter().fold(0.0, |most, (_, length)| most.max(*length))
    }

    /// Thermal diffusivity of the bed at the start, K/(ρ c (1 − η)) \[m²/s\].
    ///
    /// # Errors
    /// As for [`SphereCase::start`].
    pub fn diffusivity(&self) -> Result<f64, CaseError> {
        let grains = &self.spheres.grains;
        let storage = grains.density * grains.heat_capacity * (1.0 - self.porosity);
        Ok(self.start()?.conductivity / storage)
    }

    /// Proposed end time \[s\], rounded to two digits: with a flow the time in which its front crosses the bed, else L²/D with the
    /// length L = [`SphereCase::heat_way`].
    ///
    /// # Errors
    /// As for [`SphereCase::start`].
    pub fn proposed_end(&self) -> Result<f64, CaseError> {
        if let Some(flow) = self.flow
            && let Some(gas) = self.gas.name.flowing(flow.temperature)
        {
            let grains = &self.spheres.grains;
            let stored = grains.density * grains.heat_capacity * (1.0 - self.porosity) * self.shape.volume();
            return Ok(rounded(stored / (flow.mass * gas.heat_capacity), 2));
        }
        let way = self.heat_way();
        Ok(rounded(way * way / self.diffusivity()?, 2))
    }

    /// The first time step \[s\], rounded to two digits: a twentieth of the time in which heat crosses a cell, at most a hundredth of
    /// the run.
    ///
    /// # Errors
    /// As for [`SphereCase::start`].
    pub fn first_step(&self) -> Result<f64, CaseError> {
        let sides = self.shape.lengths().into_iter().zip(&self.cells);
        let cell = sides.fold(f64::INFINITY, |least, ((_, length), &count)| least.min(length / count as f64));
        let crossed = cell * cell / self.diffusivity()?;
        Ok(rounded((0.05 * crossed).min(0.01 * self.end_time), 2))
    }

    /// What the case leaves out that may matter, in sentences.
    pub fn notes(&self) -> Vec<String> {
        if self.mechanics == Mechanics::None {
            return Vec::new();
        }
        let (weight, slenderness) = (self.weight(), self.shape.height() / self.shape.breadth());
        let light = self.gravity == 0.0 && weight > 0.2 * self.pressure;
        let weight = light.then(|| {
            format!(
                "the weight of the bed, up to {} Pa at the bottom, is left out; --gravity {GRAVITY} adds it",
                plain(rounded(weight, 2))
            )
        });
        let smooth = (self.wall_friction == 0.0 && slenderness > 1.0).then(|| {
            format!(
                "the sides are smooth; friction at sides keeps a bed that is taller than wide from rising as it is heated, and \
                 raises its pressure: --wall-friction {} adds it",
                wall::OF_SPHERE
            )
        });
        [weight, smooth].into_iter().flatten().collect()
    }
}

#[cfg(test)]
#[path = "scene_tests.rs"]
mod tests;
