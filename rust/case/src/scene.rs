//! What a new case is about: box, walls, grains, start, end. Nothing here is written or printed.

use crate::CaseError;
use crate::grains::Grains;
use crate::packing::{self, Start, usual_fabric};
use crate::walls::WallOverTime;
use msdd_dem::WallHeat;
use msdd_rve::Compression;
use msdd_rve::message::number;
use msdd_surrogate::models;
use msdd_surrogate::surrogate::Known;

/// Side of a cell over the mean radius that is proposed: a square of it holds nearly five grains, as in the paper's mesh.
pub const CELL_RADII: f64 = 4.3;
/// Cells along the longer side at most, when nothing else is wished.
const PROPOSED_CELLS: f64 = 100.0;
/// Cells of a case at most, which is beyond what one would wait for.
const MOST_CELLS: usize = 4_000_000;
/// Names of the walls, in the order of [`msdd_dem::Side`].
pub const WALLS: [&str; 4] = ["left", "right", "bottom", "top"];

/// Whether the grains move until the stress is in equilibrium.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mechanics {
    /// They do not: the paper's algorithm.
    None,
    #[default]
    Equilibrium,
}

/// All that a new case is made from. SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Width and height of the box [m].
    pub size: [f64; 2],
    /// Cells along x and y.
    pub cells: [usize; 2],
    /// In the order of [`WALLS`].
    pub walls: [WallOverTime; 4],
    /// T at the start, everywhere [K].
    pub initial_temperature: f64,
    /// Name of the material, for the comments.
    pub material: String,
    pub grains: Grains,
    pub start: Start,
    pub compression: Compression,
    pub mechanics: Mechanics,
    /// Heat released in the bed [W/m³], negative for a sink.
    pub heat_source: Option<f64>,
    /// [s]
    pub end_time: f64,
    /// Error of T that a step may make [K]; a thousandth of the range of T when absent.
    pub tolerance: Option<f64>,
    /// Where T is recorded [m].
    pub probes: Vec<[f64; 2]>,
}

/// A number with so many digits that count.
pub fn rounded(value: f64, digits: i32) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let places = (digits as usize).saturating_sub(1);
    format!("{value:.places$e}").parse().unwrap_or(value)
}

/// Cells of a box [m] when nothing is wished: about [`CELL_RADII`] wide, or wider in large boxes.
pub fn proposed_cells(size: [f64; 2], mean_radius: f64) -> [usize; 2] {
    let cell = (CELL_RADII * mean_radius).max(size[0].max(size[1]) / PROPOSED_CELLS);
    cells_of(size, cell)
}

/// Cells of about this side [m].
pub fn cells_of(size: [f64; 2], cell: f64) -> [usize; 2] {
    size.map(|length| (length / cell).round().max(1.0) as usize)
}

/// Three places along the middle of the box [m]: near the left wall, in the middle, near the right wall.
pub fn proposed_probes(size: [f64; 2]) -> Vec<[f64; 2]> {
    let near = (0.5 * size[1]).min(0.25 * size[0]);
    [near, 0.5 * size[0], size[0] - near].map(|x| [rounded(x, 6), rounded(0.5 * size[1], 6)]).to_vec()
}

impl Scene {
    /// Refuses what makes no case; names the first such wish.
    ///
    /// # Errors
    /// [`CaseError::Parameter`].
    pub fn check(&self) -> Result<(), CaseError> {
        self.grains.check()?;
        let radius = self.grains.mean_radius;
        let least = 8.0 * radius;
        for (key, length) in ["width of the box", "height of the box"].into_iter().zip(self.size) {
            allow(key, length, length >= least && length <= 1e6, || {
                format!(
                    "{} to 1e6 m, since a box has at least four grains side by side",
                    number(rounded(least, 3))
                )
            })?;
        }
        let cells = self.cells[0].saturating_mul(self.cells[1]);
        allow("cells", cells as f64, (1..=MOST_CELLS).contains(&cells), || {
            format!("1 to {MOST_CELLS} in all")
        })?;
        let temperature = |key: &str, value: f64| {
            allow(key, value, (0.0..=1e5).contains(&value), || {
                "0 to 1e5 K; temperatures are in Kelvin".to_string()
            })
        };
        temperature("initial temperature", self.initial_temperature)?;
        for (name, wall) in WALLS.into_iter().zip(&self.walls) {
            for value in wall_temperatures(wall) {
                temperature(name, value)?;
            }
        }
        allow("end time", self.end_time, (1e-9..=1e12).contains(&self.end_time), || {
            "1e-9 to 1e12 s".to_string()
        })?;
        if let Some(value) = self.tolerance {
            allow("tolerance", value, (1e-12..=1e6).contains(&value), || "1e-12 to 1e6 K".to_string())?;
        }
        if let Some(value) = self.heat_source {
            allow("heat source", value, value.abs() <= 1e15, || "-1e15 to 1e15 W/m3".to_string())?;
        }
        let inside =
            |[x, y]: [f64; 2]| (0.0..=self.size[0]).contains(&x) && (0.0..=self.size[1]).contains(&y);
        if let Some([x, y]) = self.probes.iter().copied().find(|&probe| !inside(probe)) {
            let allowed = format!("inside of the box, 0,0 to {},{} m", self.size[0], self.size[1]);
            return Err(CaseError::Parameter {
                key: "probe".to_string(),
                value: format!("{x},{y}"),
                allowed,
            });
        }
        packing::check(&self.grains, self.start, self.compression)
    }

    /// Sides of a cell [m].
    pub fn cell(&self) -> [f64; 2] {
        [0, 1].map(|k| self.size[k] / self.cells[k] as f64)
    }

    /// Least and largest temperature of the start and of the walls at any time [K].
    pub fn temperatures(&self) -> [f64; 2] {
        let walls = self.walls.iter().flat_map(wall_temperatures);
        walls.fold([self.initial_temperature; 2], |[least, most], value| [least.min(value), most.max(value)])
    }

    /// Length over which heat has to spread [m]: half the box where both walls have a temperature, all of it where one has, the
    /// shorter of both directions.
    pub fn heat_way(&self) -> f64 {
        let warm = |wall: usize| !wall_temperatures(&self.walls[wall]).is_empty();
        let ways = [0, 1].map(|k| match (warm(2 * k), warm(2 * k + 1)) {
            (true, true) => 0.5 * self.size[k],
            (false, false) => f64::INFINITY,
            _ => self.size[k],
        });
        let way = ways[0].min(ways[1]);
        if way.is_finite() { way } else { self.size[0].max(self.size[1]) }
    }

    /// Thermal diffusivity of the bed, K/(ρ c (1 − η)) [m²/s], and mean conductivity K [W/(m K)], as the shipped model knows
    /// packings of about this start.
    ///
    /// # Errors
    /// [`CaseError::Model`] when the shipped model cannot be read.
    pub fn diffusivity(&self) -> Result<[f64; 2], CaseError> {
        let porosity = match self.start {
            Start::Porosity(porosity) => porosity,
            Start::Pressure(pressure) => {
                packing::model_porosity(pressure / self.grains.stress_scale(), self.compression)?
            }
        };
        let model = models::builtin(models::BUILTIN)?;
        let known = Known { porosity, fabric_index: usual_fabric(self.compression), ..Known::default() };
        let answer = model.evaluate(&model.initial_state(&known), 0.0);
        let share = 0.5 * (answer.conductivity[0][0] + answer.conductivity[1][0]);
        let conductivity = share * self.grains.thermal_conductivity;
        let storage = self.grains.density * self.grains.heat_capacity * model.solid_fraction(porosity);
        Ok([conductivity / storage, conductivity])
    }

    /// L²/D [s], in which most of the heat has spread over the length L = [`Scene::heat_way`]; two digits.
    ///
    /// # Errors
    /// [`CaseError::Model`].
    pub fn proposed_end(&self) -> Result<f64, CaseError> {
        let way = self.heat_way();
        Ok(rounded(way * way / self.diffusivity()?[0], 2))
    }

    /// The first time step [s]: a twentieth of the time in which heat crosses a cell, two digits.
    ///
    /// # Errors
    /// [`CaseError::Model`].
    pub fn first_step(&self) -> Result<f64, CaseError> {
        let [x, y] = self.cell();
        let crossed = x.min(y) * x.min(y) / self.diffusivity()?[0];
        Ok(rounded((0.05 * crossed).min(0.01 * self.end_time), 2))
    }
}

/// Temperatures that a wall has at some time [K]; none when no temperature is set.
pub fn wall_temperatures(wall: &WallOverTime) -> Vec<f64> {
    match wall {
        WallOverTime::Steady(WallHeat::Temperature(value)) => vec![*value],
        WallOverTime::Steady(_) => Vec::new(),
        WallOverTime::Table(rows) => rows.iter().map(|row| row[1]).collect(),
    }
}

fn allow(key: &str, value: f64, good: bool, allowed: impl FnOnce() -> String) -> Result<(), CaseError> {
    if good {
        return Ok(());
    }
    Err(CaseError::Parameter { key: key.to_string(), value: number(value), allowed: allowed() })
}

/// `0.6x0.2`: two numbers with an x between.
///
/// # Errors
/// What is allowed.
pub fn parse_pair<T: std::str::FromStr>(text: &str) -> Result<[T; 2], String> {
    let parts: Option<Vec<T>> = text.split(['x', 'X', '×']).map(|part| part.trim().parse().ok()).collect();
    match parts.map(<[T; 2]>::try_from) {
        Some(Ok(pair)) => Ok(pair),
        _ => {
            Err("two numbers with an x between, such as 0.6x0.2 [m] for a box or 30x10 for cells".to_string())
        }
    }
}

/// `0.1,0.05`: x and y [m].
///
/// # Errors
/// What is allowed.
pub fn parse_point(text: &str) -> Result<[f64; 2], String> {
    let parts: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    match parts.map(<[f64; 2]>::try_from) {
        Some(Ok(point)) => Ok(point),
        _ => Err("x,y in metres from the lower left corner, such as 0.1,0.05".to_string()),
    }
}

/// `insulated`, a temperature [K], or `time:T,time:T,...`.
///
/// # Errors
/// What is allowed.
pub fn parse_wall(text: &str) -> Result<WallOverTime, String> {
    let text = text.trim();
    let allowed = || {
        "insulated, a temperature in Kelvin such as 350, or temperatures over time such as 0:300,60:350, times [s] from 0 on \
         and rising"
            .to_string()
    };
    if text == "insulated" {
        return Ok(WallOverTime::Steady(WallHeat::Insulated));
    }
    if let Ok(value) = text.parse::<f64>() {
        return Ok(WallOverTime::Steady(WallHeat::Temperature(value)));
    }
    let row = |part: &str| {
        let (time, value) = part.split_once(':')?;
        Some([time.trim().parse().ok()?, value.trim().parse().ok()?])
    };
    let rows: Vec<[f64; 2]> = text.split(',').map(row).collect::<Option<_>>().ok_or_else(allowed)?;
    WallOverTime::table(rows).ok_or_else(allowed)
}

#[cfg(test)]
#[path = "scene_tests.rs"]
mod tests;
