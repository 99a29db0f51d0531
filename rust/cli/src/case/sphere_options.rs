//! The user's choices for a new case of a bed of spheres: options in addition to those of all beds, and questions.

use super::common_options::{CommonOptions, ask_walls, coldest};
use super::prompts::{Prompter, number, temperature, wrong};
use crate::error::CliError;
use crate::named::{choice, parser};
use clap::Args;
use msdd_beds::case::{BedCase, End, Flow, GasKeys, Lid, RecordKeys, Shell, SolverKeys, Time, Vessel};
use msdd_beds::named_gases::GasName;
use msdd_beds::property::Property;
use msdd_beds::schedule::Schedule;
use msdd_case::CaseError;
use msdd_case::material::OF_SPHERES;
use msdd_case::numbers::{plain, rounded, short};
use msdd_case::ranges;
use msdd_case::scene::{Mechanics, parse_sides, parse_wall};
use msdd_case::spheres::material::Spheres;
use msdd_case::spheres::scene::{
    BED_HAS, GRAVITY, Lid as Top, SphereCase, check_porosity, check_pressure, heated, usual_porosity,
};
use msdd_case::spheres::shape::Shape;
use msdd_case::spheres::wall::{self, WallMaterial};
use msdd_case::values::{describe, when};
use msdd_case::walls::WallOverTime;
use serde::Deserialize;
use std::f64::consts::PI;

/// Proposed pressure on the top [Pa].
const PRESSURE: f64 = 2e4;
/// Proposed pressure of the gas \[Pa\].
const GAS_PRESSURE: f64 = 101_300.0;
/// Proposed lengths of a bed in diameters of a sphere: width, depth and height of a box, radius and height of a cylinder.
const BOX: [f64; 3] = [40.0, 15.0, 15.0];
const CYLINDER: [f64; 2] = [15.0, 60.0];
const SHAPES: [&str; 2] = ["box", "cylinder"];
const GASES: [&str; 5] = ["air", "nitrogen", "helium", "argon", "vacuum"];
const TOPS: [&str; 2] = ["presses", "stays"];

#[derive(Args)]
#[command(next_help_heading = "Spheres (with --spheres)")]
pub struct SphereOptions {
    /// Shape of the bed. Default: cylinder if --radius, --height or --side is given, else box.
    #[arg(long, value_parser = parser::<ShapeName>(&SHAPES), requires = "spheres")]
    shape: Option<ShapeName>,
    /// Radius of the cylinder [m]. Allowed: four radii of a sphere to 1e6. Default: a proposal.
    #[arg(long, value_name = "M", requires = "spheres", conflicts_with = "size")]
    radius: Option<f64>,
    /// Height of the cylinder [m]. Allowed: eight radii of a sphere to 1e6. Default: a proposal.
    #[arg(long, value_name = "M", requires = "spheres", conflicts_with = "size")]
    height: Option<f64>,
    /// Side of the cylinder; values as for --left. Default: 50 K above the start; insulated if another wall is given.
    #[arg(long, value_name = "WALL", value_parser = parse_wall, requires = "spheres", conflicts_with = "size")]
    side: Option<WallOverTime>,
    /// Front wall of the box, where y is 0; values as for --left. Default: insulated.
    #[arg(long, value_name = "WALL", value_parser = parse_wall, requires = "spheres")]
    front: Option<WallOverTime>,
    /// Back wall of the box; values as for --left. Default: insulated.
    #[arg(long, value_name = "WALL", value_parser = parse_wall, requires = "spheres")]
    back: Option<WallOverTime>,
    /// Poisson's ratio of the spheres. Allowed: -0.99 to 0.5. Default: from the material.
    #[arg(long, value_name = "NU", allow_negative_numbers = true, requires = "spheres")]
    poisson_ratio: Option<f64>,
    /// Height of the asperities (root mean square) over their slope [m]; 0: smooth. Allowed: 0 to a hundredth of the radius.
    /// Default: from the material.
    #[arg(long, value_name = "M", requires = "spheres")]
    roughness: Option<f64>,
    /// Hardness of the surface of the spheres [Pa], which counts where they are rough. Allowed: 1 to 1e15. Default: from
    /// the material.
    #[arg(long, value_name = "PA", requires = "spheres")]
    hardness: Option<f64>,
    /// Emissivity of the surface of the spheres; 0: without radiation. Allowed: 0 to 1. Default: from the material.
    #[arg(long, value_name = "E", requires = "spheres")]
    emissivity: Option<f64>,
    /// Standard deviation of the diameters over their mean, both weighted by surface, and --diameter is the mean (Sauter's).
    /// Allowed: 0 (equal spheres) to 0.25. Default: 0.
    #[arg(long, value_name = "W", requires = "spheres")]
    size_spread: Option<f64>,
    /// Gas between the spheres, which must conduct less than they do. Allowed: `air`, `nitrogen`, `helium`, `argon`,
    /// `vacuum`. Default: `air`.
    #[arg(long, value_name = "NAME", value_parser = choice::<GasName>(&GASES), requires = "spheres")]
    gas: Option<GasName>,
    /// Pressure of the gas [Pa]. Allowed: 1e-3 to 1e9. Default: 1.013e5.
    #[arg(long, value_name = "PA", requires = "spheres")]
    gas_pressure: Option<f64>,
    /// Mass flow of the gas through the whole bed [kg/s], from its top to its bottom or as `--flow-from` says; 0: no flow.
    /// Default: no flow.
    #[arg(long, value_name = "KG/S", requires = "spheres", requires = "flow_temperature")]
    flow: Option<f64>,
    /// Temperature of the gas that flows in [K], or with a unit.
    #[arg(long, value_name = "K", value_parser = temperature, requires = "flow")]
    flow_temperature: Option<f64>,
    /// Where the gas flows in. Default: `top`.
    #[arg(long, value_parser = parser::<End>(&["top", "bottom"]), requires = "flow")]
    flow_from: Option<End>,
    /// Top wall: constant load (`presses`: a stiff plate with the initial pressure) or fixed (`stays`). Default: `presses`.
    #[arg(long, value_parser = parser::<Top>(&TOPS), requires = "spheres")]
    lid: Option<Top>,
    /// The side of the cylinder as a thin elastic vessel: Young's modulus [Pa], thickness [m] and linear thermal expansion
    /// coefficient [1/K], such as `200e9,0.002,1.2e-5` of steel. It is at its initial place at the initial temperature.
    /// Allowed: modulus 1 to 1e15, thickness up to a fifth of the radius, expansion 0 to 0.01. Default: a rigid side.
    #[arg(long, value_name = "PA,M,1/K", value_parser = parse_shell, requires = "spheres")]
    shell: Option<Shell>,
    /// Slack of spheres at a fixed bottom and top, in diameters of bed. Allowed: 0 to 1000. Default: 1; 0 under a
    /// top that presses.
    #[arg(long, alias = "give", value_name = "D", requires = "spheres")]
    slack_layer: Option<f64>,
    /// Coefficient of friction of a sphere on the walls; 0: smooth walls. A bed slips along them at less, which is what
    /// the case has: 0.154 for 0.3. Allowed: >= 0. Default: 0.3, as between the spheres; 0 with `--mechanics none`.
    #[arg(long, value_name = "MU", requires = "spheres")]
    wall_friction: Option<f64>,
    /// Material of the walls that heat passes, from which the resistance between wall and spheres follows; `none`: walls have
    /// their temperature where the mesh ends. Allowed: `steel`, `stainless-steel`, `aluminium`, `glass`, `none`. Default: `steel`.
    #[arg(long, value_name = "NAME", value_parser = parse_wall_material, requires = "spheres")]
    wall_material: Option<String>,
    /// Gravity [m/s2], downwards; 0: a bed without weight. Allowed: 0 to 1000; 0 with `--mechanics none`. Default: 9.81; 0
    /// with `--mechanics none`.
    #[arg(long, value_name = "M/S2", requires = "spheres")]
    gravity: Option<f64>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum ShapeName {
    Box,
    Cylinder,
}

fn parse_wall_material(text: &str) -> Result<String, String> {
    WallMaterial::named(Some(text)).map(|_| text.to_string()).map_err(|error| match error {
        CaseError::Parameter { allowed, .. } => allowed,
        other => other.to_string(),
    })
}

fn parse_shell(text: &str) -> Result<Shell, String> {
    let numbers: Vec<f64> = text.split(',').map_while(|part| number(part.trim()).ok()).collect();
    match (numbers.as_slice(), text.split(',').count()) {
        (&[young_modulus, thickness, thermal_expansion], 3) => {
            Ok(Shell { young_modulus, thickness, thermal_expansion })
        }
        _ => Err("Young's modulus [Pa], thickness [m] and thermal expansion coefficient [1/K] with commas between, such as \
                  200e9,0.002,1.2e-5"
            .to_string()),
    }
}

impl SphereOptions {
    /// The scene, once all questions are answered; `common` are the options of all beds.
    ///
    /// # Errors
    /// The errors of [`SphereCase::check`], and options that the shape of the bed does not have.
    pub fn scene(&self, common: &CommonOptions, prompter: &Prompter) -> Result<SphereCase, CliError> {
        let (material, spheres, usual) = self.ask_spheres(common, prompter)?;
        let shape = self.ask_shape(common, prompter, 2.0 * spheres.radius())?;
        let given = self.given_walls(common, &shape)?;
        // Before the temperatures, whose range is that of the gas
        let gas = self.ask_gas(prompter)?;
        let known = |name: &str, value: f64| ranges::temperature_with(gas.name, name, value);
        let initial_temperature = common.ask_initial(prompter, coldest(&given).unwrap_or(usual), known)?;
        let spheres = spheres.starting_at(initial_temperature);
        let read = prompter.within(parse_wall, |wall| ranges::wall(wall, |value| known("wall", value)));
        let flow = self.given_flow();
        let kind = [flow.is_some(), shape.name() == "box"];
        let walls = ask_walls(prompter, shape.walls(), given, initial_temperature, kind, read)?;
        let (porosity, pressure) = ask_start(common, prompter, &spheres)?;
        let mechanics = common.ask_mechanics(prompter, Mechanics::Equilibrium)?;
        let (lid, wall_friction, gravity) = self.ask_load(prompter, mechanics)?;
        let heat = common.ask_heat(prompter)?.filter(|&value| value != 0.0);
        let (base, radius, height) = match shape {
            Shape::Box([x, y, z]) => (Some([x, y]), None, z),
            Shape::Cylinder { radius, height } => (None, Some(radius), height),
        };
        let presses = lid == Top::Presses;
        let mut bed = BedCase {
            seed: 1,
            // By the volume of the spheres.
            heat_source: heat.map(|heat| heat / (1.0 - porosity)),
            grains: spheres.keys(wall_friction),
            container: Vessel {
                base,
                radius,
                endless: false,
                gravity,
                height: Some(height),
                porosity: Some(porosity),
            },
            lid: Some(Lid {
                pressure: Some(pressure),
                pressing: presses.then_some(Schedule::Constant(pressure)),
                ..Lid::default()
            }),
            turn: None,
            gas,
            heated: shape
                .bed_walls()
                .iter()
                .zip(&walls)
                .filter_map(|(name, wall)| heated(name, wall))
                .collect(),
            plate: None,
            flow,
            shell: self.shell.clone(),
            sides: None,
            time: Time::new(initial_temperature, 1.0),
            record: RecordKeys::default(),
            solver: SolverKeys {
                cells: None,
                mechanics: Some(mechanics),
                slack_layer: self.slack_layer,
                wall_material: self.wall_material.clone(),
                tolerance: common.tolerance,
                steady: common.steady,
                probes: common.probes.iter().map(|point| point.0.clone()).collect(),
            },
            experiment: None,
            vary: Vec::new(),
        };
        let scene = SphereCase::new(&bed, &material)?;
        let lengths: Vec<f64> = shape.lengths().iter().map(|(_, length)| *length).collect();
        let help = "The bed is divided into cells, which should not be smaller than a sphere. More cells resolve more and take longer.";
        bed.solver.cells = Some(common.ask_cells(prompter, help, &lengths, &scene.cells)?);
        let scene = SphereCase::new(&bed, &material)?;
        bed.time.end = common.ask_end(prompter, scene.proposed_end()?)?;
        Ok(SphereCase::new(&bed, &material)?)
    }

    /// The name of the material, the spheres, and the usual temperature [K].
    fn ask_spheres(
        &self,
        common: &CommonOptions,
        prompter: &Prompter,
    ) -> Result<(String, Spheres, f64), CliError> {
        let (base, material, grains) = common.grains.ask(prompter, &OF_SPHERES)?;
        let mut own = base.clone();
        own.poisson_ratio = self.poisson_ratio.or(own.poisson_ratio);
        own.roughness = self.roughness.or(own.roughness);
        own.hardness = self.hardness.or(own.hardness);
        own.emissivity = self.emissivity.map(Property::Constant).or(own.emissivity);
        let mut spheres = Spheres::of(&own, grains)?;
        spheres.size_spread = self.size_spread.unwrap_or(0.0);
        spheres.check()?;
        let options = [
            ("poissonRatio", own.poisson_ratio != base.poisson_ratio),
            ("roughness", own.roughness != base.roughness),
            ("hardness", own.hardness != base.hardness),
            ("emissivity", own.emissivity != base.emissivity),
            ("sizeSpread", spheres.size_spread > 0.0),
        ];
        let changed: Vec<&str> = options.into_iter().filter(|one| one.1).map(|one| one.0).collect();
        let material = match changed.is_empty() {
            true => material,
            false => format!("{material}; {} of your own", changed.join(", ")),
        };
        Ok((material, spheres, base.temperature))
    }

    fn ask_shape(
        &self,
        common: &CommonOptions,
        prompter: &Prompter,
        diameter: f64,
    ) -> Result<Shape, CliError> {
        let round = self.radius.is_some() || self.height.is_some() || self.side.is_some();
        let kind = prompter.value(
            self.shape
                .or(common.size.as_ref().map(|_| ShapeName::Box))
                .or(round.then_some(ShapeName::Cylinder)),
            "The bed fills a box in space, or an upright cylinder, which is computed as a wedge.",
            "Shape (box or cylinder)",
            "box",
            choice(&SHAPES),
        )?;
        let proposed = |diameters: f64| plain(rounded(diameters * diameter, 2));
        let long_enough = |shape: Shape| {
            let mut lengths = shape.lengths().into_iter();
            lengths.try_for_each(|(name, length)| ranges::length(name, length, 0.5 * diameter, BED_HAS))
        };
        match kind {
            ShapeName::Box => {
                if round {
                    return Err(wrong("--radius, --height, --side", "given", "with --shape cylinder"));
                }
                let allowed = "three lengths, width x depth x height, such as 0.3x0.1x0.2 [m]";
                let given = common.size.as_ref().map(|sides| sides.exactly("box", allowed)).transpose()?;
                let sides = prompter.value(
                    given,
                    "Width, depth and height of the box, along x, y and z. One cell is enough along directions in which nothing changes.",
                    "Width x depth x height [m]",
                    &BOX.map(proposed).join("x"),
                    prompter.within(
                        |text| parse_sides(text)?.exactly("box", allowed).map_err(|_| allowed.to_string()),
                        |&sides| long_enough(Shape::Box(sides)),
                    ),
                )?;
                Ok(Shape::Box(sides))
            }
            ShapeName::Cylinder => {
                if common.size.is_some() {
                    return Err(wrong(
                        "--box",
                        "given",
                        "with --shape box; a cylinder has --radius and --height",
                    ));
                }
                let [radius, height] = CYLINDER.map(proposed);
                let help = "The radius of the cylinder, inside of its wall.";
                let read =
                    prompter.within(number, |&radius| long_enough(Shape::Cylinder { radius, height: 1e6 }));
                let radius =
                    prompter.value(self.radius, help, "Radius of the cylinder [m]", &radius, read)?;
                let help = "The height of the bed.";
                let read =
                    prompter.within(number, |&height| long_enough(Shape::Cylinder { radius: 1e6, height }));
                let height =
                    prompter.value(self.height, help, "Height of the cylinder [m]", &height, read)?;
                Ok(Shape::Cylinder { radius, height })
            }
        }
    }

    /// Walls that options give, in the order of [`Shape::walls`].
    fn given_walls(
        &self,
        common: &CommonOptions,
        shape: &Shape,
    ) -> Result<Vec<Option<WallOverTime>>, CliError> {
        let options = [
            ("left", &common.left),
            ("right", &common.right),
            ("front", &self.front),
            ("back", &self.back),
            ("bottom", &common.bottom),
            ("top", &common.top),
            ("side", &self.side),
        ];
        let walls = shape.walls();
        if let Some((name, _)) = options.iter().find(|(name, given)| given.is_some() && !walls.contains(name))
        {
            let allowed = format!("the walls of a {}: {}", shape.name(), walls.join(", "));
            return Err(wrong(&format!("--{name}"), "given", &allowed));
        }
        let given = |wall: &&str| {
            options.iter().find(|(name, _)| name == wall).and_then(|(_, given)| (*given).clone())
        };
        Ok(walls.iter().map(given).collect())
    }

    fn ask_gas(&self, prompter: &Prompter) -> Result<GasKeys, CliError> {
        let name = prompter.value(
            self.gas,
            "The gas between the spheres: air, nitrogen, helium, argon or vacuum.",
            "Gas",
            "air",
            choice(&GASES),
        )?;
        let pressure = match (name, self.gas_pressure) {
            (GasName::Vacuum, None) => GAS_PRESSURE,
            (_, given) => prompter.value(
                given,
                "The pressure of the gas. A thin gas conducts less.",
                "Pressure of the gas [Pa]",
                &plain(GAS_PRESSURE),
                prompter.within(number, |&value| ranges::gas_pressure(value)),
            )?,
        };
        Ok(GasKeys::new(name, pressure))
    }

    fn given_flow(&self) -> Option<Flow> {
        let (mass, temperature) = (self.flow?, self.flow_temperature?);
        let from = self.flow_from.unwrap_or_default();
        (mass != 0.0).then_some(Flow { mass, temperature, from })
    }

    /// What the top does, the friction of walls, and gravity, where spheres move.
    fn ask_load(&self, prompter: &Prompter, mechanics: Mechanics) -> Result<(Top, f64, f64), CliError> {
        if mechanics == Mechanics::None {
            let options = [
                ("--lid", self.lid.is_some()),
                ("--slack-layer", self.slack_layer.is_some()),
                ("--wall-friction", self.wall_friction.is_some()),
            ];
            if let Some((option, _)) = options.iter().find(|(_, given)| *given) {
                return Err(wrong(option, "given", "with --mechanics equilibrium, where spheres move"));
            }
            return Ok((Top::Presses, 0.0, self.gravity.unwrap_or(0.0)));
        }
        let lid = prompter.value(
            self.lid,
            "The top of the bed keeps pressing with the initial pressure and moves; or it stays where it is, and the \
             pressure rises where the spheres grow.",
            "Top (presses or stays)",
            "presses",
            choice(&TOPS),
        )?;
        let help = "The coefficient of friction of a sphere on the walls; 0: smooth walls. Friction at the side of a tall bed \
                    carries much of its weight and keeps it from rising as it is heated.";
        let read = prompter.within(number, |&value| ranges::wall_friction(value));
        let question = "Friction of the walls";
        let wall_friction =
            prompter.value(self.wall_friction, help, question, &plain(wall::OF_SPHERE), read)?;
        let help = "Gravity points downwards; 0 leaves the weight of the bed out.";
        let read = prompter.within(number, |&value| ranges::gravity(value));
        let gravity = prompter.value(self.gravity, help, "Gravity [m/s2]", &plain(GRAVITY), read)?;
        Ok((lid, wall_friction, gravity))
    }
}

/// Porosity and pressure on the top \[Pa\]. The pressure comes first, because the range of the porosity depends on it.
fn ask_start(common: &CommonOptions, prompter: &Prompter, spheres: &Spheres) -> Result<(f64, f64), CliError> {
    let pressure = prompter.value(
        common.pressure,
        "The pressure on the top of the bed at the start; contacts conduct as its cube root.",
        "Pressure on the top [Pa]",
        &plain(PRESSURE),
        prompter.within(number, |&value| check_pressure(spheres, value)),
    )?;
    let porosity = prompter.value(
        common.porosity,
        "The porosity at the start: 1 - volume of the spheres over the volume. Beds that were poured have 0.38 to 0.42.",
        "Porosity",
        &plain(usual_porosity(spheres)),
        prompter.within(number, |&value| check_porosity(spheres, pressure, value)),
    )?;
    Ok((porosity, pressure))
}

/// Summary of the case that will be made, for the terminal.
///
/// # Errors
/// Those of [`SphereCase::start`].
pub fn summary(scene: &SphereCase) -> Result<String, CliError> {
    let lengths: Vec<String> = scene.shape.lengths().iter().map(|(_, length)| plain(*length)).collect();
    let cells: Vec<String> = scene.cells.iter().map(ToString::to_string).collect();
    let walls = scene.shape.walls().iter().zip(&scene.walls);
    let walls: Vec<String> = walls.map(|(name, wall)| format!("{name} {}", describe(wall))).collect();
    let start = scene.start()?;
    let rough = || format!("\nwalls: {}", wall::sentence(scene.wall_friction));
    let friction = when(scene.wall_friction > 0.0, rough);
    let crushed = scene.spheres.crush_load.map_or(String::new(), |load| {
        let (d, solid) = (2.0 * scene.spheres.radius(), 1.0 - scene.porosity);
        let force = scene.pressure * PI * d * d / (solid * start.coordination);
        let share = short(100.0 * force / load);
        format!("\ncontacts under the top carry {} N on average, {share} % of the crush load", short(force))
    });
    Ok(format!(
        "{} {} m, {} cells, about {} spheres; {}; {} K at the start; {} s\n\
         at the start the bed conducts {} W/(m K), {} across gas gaps ({}), {} across contacts and {} by radiation, with \
         {} contacts per sphere{friction}{crushed}",
        scene.shape.name(),
        lengths.join(" x "),
        cells.join(" x "),
        plain(rounded(scene.number(), 2)),
        walls.join("; "),
        plain(scene.initial_temperature),
        plain(scene.end_time),
        short(start.conductivity),
        short(start.by_gas),
        scene.gas.name,
        short(start.conductivity - start.by_gas - start.by_radiation),
        short(start.by_radiation),
        short(start.coordination),
    ))
}
