//! The user's choices for a new case: options, and questions about everything that is not given as an option.

use super::disc_options::GrainWishes;
use super::prompts::{Prompter, number, temperature, wrong};
use crate::error::CliError;
use crate::named::{choice, parser};
use clap::Args;
use msdd_case::CaseError;
use msdd_case::disc_model::DiscModel;
use msdd_case::material::OF_DISCS;
use msdd_case::numbers::{plain, short};
use msdd_case::packing::{self, Discs, InitialPacking};
use msdd_case::ranges;
use msdd_case::scene::{
    BOX_HAS, DiscCase, Mechanics, Numbers, SIDES, WALLS, cells_of, parse_point, parse_sides, parse_wall,
    proposed_cells, proposed_probes,
};
use msdd_case::values::{describe, mechanics_name};
use msdd_case::walls::WallOverTime;
use msdd_rve::Compression;
use std::path::PathBuf;

/// Proposed porosity of discs.
const POROSITY: f64 = 0.125;
/// End of a run that ends once it is steady, over the proposed end of others.
const LATER: f64 = 10.0;
/// Proposed difference between the hot wall's temperature and the initial one [K]; the paper's grains strain by 5 % then.
const HOTTER: f64 = 50.0;

const WALL_HELP: &str = "Each wall is insulated, or has a temperature [K], or one that changes over time: 0:300,60:350 is \
                                    300 K at 0 s, 350 K at 60 s, and linear between them. h=200,T=300 is a heat transfer \
                                    coefficient [W/(m2 K)] to the outside, q=500 a heat flux [W/m2] into the bed.";

#[derive(Args)]
pub struct CommonOptions {
    /// Width x height of the box [m], such as 0.6x0.2; of a box of spheres width x depth x height (x, y, z), such as
    /// 0.3x0.1x0.2. Allowed: each at least eight mean radii, at most 1e6. Default: a proposal.
    #[arg(long = "box", value_name = "WxH", value_parser = parse_sides::<f64>, help_heading = "Box")]
    pub(super) size: Option<Numbers<f64>>,
    /// Number of cells along x and y, such as 30x10; of a box of spheres along x, y and z, of a cylinder along radius and
    /// axis. Allowed: 1 to 4000000 in all. Default: of discs cells with sides of 4.3 mean radii, which hold nearly five
    /// grains, but at most 100 along the longer side; of spheres 1 where nothing changes, else at most 40, 24 or 12 along
    /// one, two or three directions.
    #[arg(long, value_name = "NXxNY", value_parser = parse_sides::<usize>, conflicts_with = "cell_size", help_heading = "Box")]
    pub(super) cells: Option<Numbers<usize>>,
    /// Approximate side of a cell [m], instead of the number of cells. Allowed: > 0.
    #[arg(long, value_name = "M", help_heading = "Box")]
    pub(super) cell_size: Option<f64>,
    /// Left wall: a temperature [K] or with a unit, such as `80C`, `insulated`, temperatures over time such as `0:300,60:350` (300 K at 0 s, 350 K at 60 s,
    /// linear between them), a heat transfer coefficient [W/(m2 K)] and the temperature outside such as `h=200,T=300`, or a heat
    /// flux into the bed [W/m2] such as `q=500`. Allowed: temperatures of 0 to 1e5; with spheres the range of the gas (air 200 to 2000, helium
    /// 273 to 1800). Default: 50 K above the start; insulated if another wall is given.
    #[arg(long, value_name = "WALL", value_parser = parse_wall, help_heading = "Walls and temperatures")]
    pub(super) left: Option<WallOverTime>,
    /// Right wall; values as for the left one. Default: the initial temperature; insulated if another wall is given.
    #[arg(long, value_name = "WALL", value_parser = parse_wall, help_heading = "Walls and temperatures")]
    pub(super) right: Option<WallOverTime>,
    /// Bottom wall; values as for the left one. Default: insulated.
    #[arg(long, value_name = "WALL", value_parser = parse_wall, help_heading = "Walls and temperatures")]
    pub(super) bottom: Option<WallOverTime>,
    /// Top wall; values as for the left one. Default: insulated.
    #[arg(long, value_name = "WALL", value_parser = parse_wall, help_heading = "Walls and temperatures")]
    pub(super) top: Option<WallOverTime>,
    /// Initial temperature of the whole bed [K], or with a unit, such as 80C. Allowed: as for walls. Default: the coldest wall's if walls of
    /// different temperatures are given, else a usual one of the material.
    #[arg(long, value_name = "K", value_parser = temperature, help_heading = "Walls and temperatures")]
    pub(super) initial_temperature: Option<f64>,
    /// Heat released inside of the bed [W per m3 of bed]; negative for heat that is taken away. Allowed: -1e15 to 1e15.
    /// Default: 0.
    #[arg(long, value_name = "W/M3", allow_negative_numbers = true, help_heading = "Walls and temperatures")]
    pub(super) heat_source: Option<f64>,
    #[command(flatten)]
    pub(super) grains: GrainWishes,
    /// Initial porosity: share of the plane without grains (overlaps counted once); of spheres 1 - volume of the spheres over
    /// the volume. Allowed: 0.06 (dense) to 0.19 (loose); of spheres the range of the law under this pressure, about 0.36 to
    /// 0.43. Default: 0.125, of spheres 0.4.
    #[arg(long, value_name = "ETA", help_heading = "Packing at the start")]
    pub(super) porosity: Option<f64>,
    /// Initial pressure [Pa] instead of the porosity; the porosity with this pressure is then found by packing. Of spheres:
    /// the vertical stress at the top, in addition to the porosity. Allowed: the range of packings with a porosity of 0.06
    /// to 0.19; of spheres the range of the law. Default: with spheres 20000.
    #[arg(long, value_name = "PA", help_heading = "Packing at the start")]
    pub(super) pressure: Option<f64>,
    /// Model file of `msdd train`, for discs of another friction. The case gets a copy (constant/model.json), and the start
    /// is packed with the friction and the spread of radii that it was trained with. Default: the model that is compiled in.
    #[arg(long, value_name = "FILE", help_heading = "Packing at the start")]
    pub(super) model: Option<PathBuf>,
    /// How the discs were compressed: equally from all sides, or along x alone, as `msdd reference` fills its box (then more
    /// contacts point along x, and the bed conducts better along x). Default: a proposal.
    #[arg(long, value_parser = parser::<Compression>(&COMPRESSIONS), help_heading = "Packing at the start")]
    pub(super) compression: Option<Compression>,
    /// Whether the grains move until the stress is in equilibrium, as real grains do, or stay where they are, as in the
    /// paper. Default: a proposal.
    #[arg(long, value_parser = parser::<Mechanics>(&MECHANICS), help_heading = "Computation")]
    pub(super) mechanics: Option<Mechanics>,
    /// End of the simulation [s]. Allowed: 1e-9 to 1e12. Default: the time in which heat spreads over the box.
    #[arg(long, value_name = "S", help_heading = "Computation")]
    pub(super) end_time: Option<f64>,
    /// The run ends before, once it is steady: key `stopWhenSteady` 1e-3 of `system/fvSolution`. The default of the end is then ten
    /// times as late.
    #[arg(long, help_heading = "Computation")]
    pub(super) steady: bool,
    /// Largest error of the temperature that one time step may add [K]. Allowed: 1e-12 to 1e6. Default: a thousandth of the
    /// range of temperatures.
    #[arg(long, value_name = "K", help_heading = "Computation")]
    pub(super) tolerance: Option<f64>,
    /// Point inside the bed where the temperature is recorded [m], such as 0.1,0.05; may be given several times. Three
    /// numbers in a box of spheres; radius,height in a cylinder, where radius 0 is the axis (recorded at 1 % of the radius).
    /// Default: three points along the middle.
    #[arg(long = "probe", value_name = "X,Y", value_parser = parse_point, help_heading = "Computation")]
    pub(super) probes: Vec<Numbers<f64>>,
}

const COMPRESSIONS: [&str; 2] = ["isotropic", "horizontal"];
const MECHANICS: [&str; 2] = ["equilibrium", "none"];

impl CommonOptions {
    /// The scene, once all questions are answered.
    ///
    /// # Errors
    /// The errors of [`DiscCase::check`], when no case can be made from the choices.
    pub fn scene(&self, prompter: &Prompter) -> Result<DiscCase, CliError> {
        let model = self.model.as_deref().map_or_else(DiscModel::shipped, DiscModel::read)?;
        let (base, material, grains) = self.grains.ask(prompter, &OF_DISCS)?;
        let (size, cells) = self.ask_box(prompter, grains.mean_radius)?;
        let proposal = coldest(self.given_walls()).unwrap_or(base.temperature);
        let initial_temperature = self.ask_initial(prompter, proposal, ranges::temperature)?;
        let read = prompter
            .within(parse_wall, |wall| ranges::wall(wall, |value| ranges::temperature("wall", value)));
        let given = self.given_walls().map(Option::clone).to_vec();
        let walls = ask_walls(prompter, &WALLS, given, initial_temperature, [false, true], read)?;
        let walls = walls.try_into().map_err(|_| CliError::Message("four walls".to_string()))?;
        let compression = self.ask_compression(prompter)?;
        let start = self.ask_start(prompter, Discs { grains: &grains, model: &model, compression })?;
        let usual = if model.law().has_tangent() { Mechanics::Equilibrium } else { Mechanics::None };
        let mut scene = DiscCase {
            size,
            cells,
            walls,
            initial_temperature,
            material,
            grains,
            model,
            start,
            compression,
            mechanics: self.ask_mechanics(prompter, usual)?,
            heat_source: self.ask_heat(prompter)?.filter(|&value| value != 0.0),
            end_time: 1.0,
            tolerance: self.tolerance,
            steady: self.steady,
            probes: self.points(size)?,
        };
        scene.check()?;
        scene.end_time = self.ask_end(prompter, scene.proposed_end())?;
        scene.check()?;
        Ok(scene)
    }

    /// `check` refuses a temperature with a name.
    pub(super) fn ask_initial(
        &self,
        prompter: &Prompter,
        proposal: f64,
        check: impl Fn(&str, f64) -> Result<(), CaseError>,
    ) -> Result<f64, CliError> {
        let help = "The whole bed has one temperature at the start. Temperatures are in kelvin, or have a unit, such as 80C.";
        let read = prompter.within(temperature, |&value| check("initial temperature", value));
        prompter.value(self.initial_temperature, help, "Temperature at the start [K]", &plain(proposal), read)
    }

    pub(super) fn ask_end(&self, prompter: &Prompter, proposal: f64) -> Result<f64, CliError> {
        let help = "Heat spreads over a length L in a time of about L^2/D (D: thermal diffusivity of the bed). The proposal is that \
                    time for this bed: most of the change has happened by then.";
        let read = prompter.within(number, |&value| ranges::end_time(value));
        let proposal = if self.steady { LATER * proposal } else { proposal };
        prompter.value(self.end_time, help, "End of the simulation [s]", &plain(proposal), read)
    }

    /// The cells that options give, of a bed with these sides [m].
    fn given_cells(&self, sides: &[f64]) -> Result<Option<Vec<usize>>, CliError> {
        match (self.cell_size, &self.cells) {
            (Some(cell), _) if cell > 0.0 && cell.is_finite() => Ok(Some(cells_of(sides, cell))),
            (Some(cell), _) => Err(wrong("cell size", &cell.to_string(), "> 0 m")),
            (None, Some(cells)) if cells.0.len() == sides.len() => Ok(Some(cells.0.clone())),
            (None, Some(cells)) => Err(wrong("cells", &cells.text(), &format!("{} numbers", sides.len()))),
            (None, None) => Ok(None),
        }
    }

    /// The cells of a bed with these sides [m].
    pub(super) fn ask_cells(
        &self,
        prompter: &Prompter,
        help: &str,
        sides: &[f64],
        proposal: &[usize],
    ) -> Result<Vec<usize>, CliError> {
        let proposal = proposal.iter().map(ToString::to_string).collect::<Vec<_>>().join("x");
        let allowed = || format!("{} numbers with an x between, such as {proposal}", sides.len());
        let read = |text: &str| {
            let cells = parse_sides(text).ok().map(|cells| cells.0);
            cells.filter(|cells| cells.len() == sides.len()).ok_or_else(allowed)
        };
        let read = prompter.within(read, |cells: &Vec<usize>| ranges::cells(cells));
        prompter.value(self.given_cells(sides)?, help, "Cells along each direction", &proposal, read)
    }

    fn points(&self, size: [f64; 2]) -> Result<Vec<[f64; 2]>, CliError> {
        if self.probes.is_empty() {
            return Ok(proposed_probes(size));
        }
        let points = self.probes.iter().map(|point| point.exactly("probe", "x,y: two numbers"));
        Ok(points.collect::<Result<_, _>>()?)
    }

    fn ask_box(&self, prompter: &Prompter, mean_radius: f64) -> Result<([f64; 2], [usize; 2]), CliError> {
        let proposal = [129.0, 43.0].map(|radii| short(radii * mean_radius));
        let allowed = "two lengths, as 0.6x0.2; three belong to --spheres";
        let given = self.size.as_ref().map(|sides| sides.exactly("box", allowed)).transpose()?;
        let pair = |text: &str| parse_sides(text)?.exactly("box", allowed).map_err(|_| allowed.to_string());
        let pair = prompter.within(pair, |sides: &[f64; 2]| {
            let mut named = SIDES.into_iter().zip(sides);
            named.try_for_each(|(name, &side)| ranges::length(name, side, mean_radius, BOX_HAS))
        });
        let size = prompter.value(
            given,
            &format!(
                "The bed fills a box with four walls. It is two-dimensional; mean radius of the grains: {} m.",
                plain(mean_radius)
            ),
            "Width x height of the box [m]",
            &proposal.join("x"),
            pair,
        )?;
        let help = "The box is divided into cells; each stands for the grains in it, which should be four or more. More cells resolve \
                    more and take longer.";
        let cells = self.ask_cells(prompter, help, &size, &proposed_cells(size, mean_radius))?;
        Ok((size, [cells[0], cells[1]]))
    }

    fn given_walls(&self) -> [&Option<WallOverTime>; 4] {
        [&self.left, &self.right, &self.bottom, &self.top]
    }

    fn ask_start(&self, prompter: &Prompter, discs: Discs) -> Result<InitialPacking, CliError> {
        let given = match (self.porosity, self.pressure) {
            (Some(_), Some(_)) => {
                let message =
                    "--porosity cannot be used with --pressure: in a bed of discs one follows from the other";
                return Err(CliError::Message(message.to_string()));
            }
            (Some(porosity), None) => Some(InitialPacking::Porosity(porosity)),
            (None, Some(pressure)) => Some(InitialPacking::Pressure(pressure)),
            (None, None) => None,
        };
        let [least, most] = discs.model.porosities();
        prompter.value(
            given,
            &format!(
                "How dense the bed is at the start: its porosity, the share of the plane without grains, from {least} (dense) \
                 to {most} (loose; discs in a plane pack denser than balls), or its pressure, such as '3000 Pa'."
            ),
            "Porosity, or pressure in Pa",
            &plain(POROSITY.clamp(least, most)),
            prompter.within(parse_start, |&start| packing::check(discs, start)),
        )
    }

    fn ask_compression(&self, prompter: &Prompter) -> Result<Compression, CliError> {
        prompter.value(
            self.compression,
            "How the grains were compressed: along x alone (horizontal), as 'msdd reference' does when it fills a box for \
             comparison, or equally from all sides (isotropic).",
            "Compression",
            "horizontal",
            choice(&COMPRESSIONS),
        )
    }

    pub(super) fn ask_mechanics(&self, prompter: &Prompter, usual: Mechanics) -> Result<Mechanics, CliError> {
        prompter.value(
            self.mechanics,
            "Grains that are heated push their neighbours away. With 'equilibrium' they move until all forces are in balance, \
             which agrees with DEM; with 'none' they stay where they are, as in the paper.",
            "Mechanics",
            mechanics_name(usual),
            choice(&MECHANICS),
        )
    }

    pub(super) fn ask_heat(&self, prompter: &Prompter) -> Result<Option<f64>, CliError> {
        let help = "Heat may be released inside of the bed, as by radiation or a reaction [W per m3 of bed].";
        let read = prompter.within(number, |&value| ranges::heat_source(value));
        prompter.value(self.heat_source, help, "Heat released inside [W/m3]", "0", read).map(Some)
    }
}

/// Where options gave any wall or gas flows, the others are insulated unless answered otherwise; else the first one is hot, and the second one of
/// a box has the temperature of the start.
pub(super) fn ask_walls(
    prompter: &Prompter,
    names: &[&str],
    given: Vec<Option<WallOverTime>>,
    initial: f64,
    [flows, is_box]: [bool; 2],
    read: impl Fn(&str) -> Result<WallOverTime, String>,
) -> Result<Vec<WallOverTime>, CliError> {
    let any = flows || given.iter().any(Option::is_some);
    let walls = names.iter().zip(given).enumerate().map(|(k, (name, given))| {
        let proposal = match k {
            0 if !any => plain(initial + HOTTER),
            1 if !any && is_box => plain(initial),
            _ => "insulated".to_string(),
        };
        prompter.value(given, WALL_HELP, &format!("Wall '{name}'"), &proposal, &read)
    });
    walls.collect()
}

/// The temperature of the coldest wall [K], if options gave walls of different temperatures: the bed then starts at it. A
/// single temperature would leave nothing to heat or cool; a wall below 0 K is refused as a wall, not as the start.
pub(super) fn coldest<'a>(given: impl IntoIterator<Item = &'a Option<WallOverTime>>) -> Option<f64> {
    let given = given.into_iter().flatten().flat_map(WallOverTime::temperatures);
    let [least, most] =
        given.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], t| [low.min(t), high.max(t)]);
    (0.0 <= least && least < most).then_some(least)
}

/// `0.125` or `3000 Pa`.
fn parse_start(text: &str) -> Result<InitialPacking, String> {
    let allowed = || "a porosity such as 0.125, or a pressure with its unit such as '3000 Pa'".to_string();
    match text.strip_suffix("Pa") {
        Some(pressure) => number(pressure.trim()).map(InitialPacking::Pressure).map_err(|_| allowed()),
        None => number(text).map(InitialPacking::Porosity).map_err(|_| allowed()),
    }
}

/// Summary of the case that will be made, for the terminal.
pub fn summary(scene: &DiscCase) -> String {
    let [width, height] = scene.size.map(plain);
    let walls: Vec<String> = WALLS
        .into_iter()
        .zip(&scene.walls)
        .map(|(name, wall)| format!("{name} {}", describe(wall)))
        .collect();
    format!(
        "box {width} x {height} m, {} x {} cells; {}; {} K at the start; {} s",
        scene.cells[0],
        scene.cells[1],
        walls.join("; "),
        plain(scene.initial_temperature),
        plain(scene.end_time)
    )
}
