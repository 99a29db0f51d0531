//! The parameters of a new case: box, walls, grains, initial state, end. Nothing is written or printed here.

use crate::disc_model::DiscModel;
use crate::grains::Grains;
use crate::numbers::rounded;
use crate::packing::{self, Discs, InitialPacking};
use crate::ranges;
use crate::walls::{self, WallOverTime};
use crate::{CaseError, refused};
pub use msdd_beds::case::Mechanics;
use msdd_beds::units::TEMPERATURE;
use msdd_dem::WallHeat;
use msdd_rve::Compression;

/// Proposed side of a cell over the mean radius: a square of this side holds nearly five grains, as in the paper's mesh.
pub const CELL_RADII: f64 = 4.3;
/// Largest number of cells along the longer side that is proposed.
const PROPOSED_CELLS: f64 = 100.0;
/// Names of the lengths of the box, and what it has, for messages.
pub const SIDES: [&str; 2] = ["width of the box", "height of the box"];
pub const BOX_HAS: &str = "box has at least four grains";
/// Names of the walls, in the order of [`msdd_dem::Side`].
pub const WALLS: [&str; 4] = ["left", "right", "bottom", "top"];

/// All parameters of a new case. SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct DiscCase {
    /// Width and height of the box \[m\].
    pub size: [f64; 2],
    /// Cells along x and y.
    pub cells: [usize; 2],
    /// Thermal boundary conditions, in the order of [`WALLS`].
    pub walls: [WallOverTime; 4],
    /// Initial temperature of the whole bed \[K\].
    pub initial_temperature: f64,
    /// Name of the material, for comments in the files.
    pub material: String,
    pub grains: Grains,
    pub model: DiscModel,
    pub start: InitialPacking,
    pub compression: Compression,
    pub mechanics: Mechanics,
    /// Heat released in the bed [W/m³], negative for a sink.
    pub heat_source: Option<f64>,
    /// End of the simulation \[s\].
    pub end_time: f64,
    /// Largest error of T that a time step may add \[K\]; `None`: a thousandth of the range of T.
    pub tolerance: Option<f64>,
    /// Whether the run ends before, once it is steady.
    pub steady: bool,
    /// Points where T is recorded \[m\].
    pub probes: Vec<[f64; 2]>,
}

/// Proposed numbers of cells along x and y of a box of this size \[m\]: cells are about [`CELL_RADII`] mean radii wide, or
/// wider in large boxes.
pub fn proposed_cells(size: [f64; 2], mean_radius: f64) -> [usize; 2] {
    let cell = (CELL_RADII * mean_radius).max(size[0].max(size[1]) / PROPOSED_CELLS);
    let cells = cells_of(&size, cell);
    [cells[0], cells[1]]
}

/// Numbers of cells along each direction if the cells have about this side \[m\].
pub fn cells_of(size: &[f64], cell: f64) -> Vec<usize> {
    size.iter().map(|length| (length / cell).round().max(1.0) as usize).collect()
}

/// Three points on the horizontal middle line of the box \[m\]: near the left wall, in the middle, near the right wall.
pub fn proposed_probes(size: [f64; 2]) -> Vec<[f64; 2]> {
    let near = (0.5 * size[1]).min(0.25 * size[0]);
    [near, 0.5 * size[0], size[0] - near].map(|x| [rounded(x, 6), rounded(0.5 * size[1], 6)]).to_vec()
}

impl DiscCase {
    /// Refuses values out of range; the error names the first of them.
    ///
    /// # Errors
    /// [`CaseError::Parameter`].
    pub fn check(&self) -> Result<(), CaseError> {
        self.grains.check()?;
        let radius = self.grains.mean_radius;
        for (key, length) in SIDES.into_iter().zip(self.size) {
            ranges::length(key, length, radius, BOX_HAS)?;
        }
        ranges::cells(&self.cells)?;
        ranges::temperature("initial temperature", self.initial_temperature)?;
        for (name, wall) in WALLS.into_iter().zip(&self.walls) {
            ranges::wall(wall, |value| ranges::temperature(name, value))?;
        }
        ranges::end_time(self.end_time)?;
        self.tolerance.map_or(Ok(()), ranges::tolerance)?;
        self.heat_source.map_or(Ok(()), ranges::heat_source)?;
        let inside =
            |[x, y]: [f64; 2]| (0.0..=self.size[0]).contains(&x) && (0.0..=self.size[1]).contains(&y);
        if let Some([x, y]) = self.probes.iter().copied().find(|&probe| !inside(probe)) {
            let allowed = format!("inside of the box, 0,0 to {},{} m", self.size[0], self.size[1]);
            return Err(refused("probe", format!("{x},{y}"), allowed));
        }
        if self.mechanics == Mechanics::Equilibrium && !self.model.law().has_tangent() {
            let name = self.model.law().name();
            let allowed = format!("none with the model {name}, which has no mechanical tangent");
            return Err(refused("mechanics", "equilibrium", allowed));
        }
        packing::check(self.discs(), self.start)
    }

    /// What is packed.
    pub fn discs(&self) -> Discs<'_> {
        Discs { grains: &self.grains, model: &self.model, compression: self.compression }
    }

    /// Sides of a cell \[m\].
    pub fn cell(&self) -> [f64; 2] {
        [0, 1].map(|k| self.size[k] / self.cells[k] as f64)
    }

    /// Least and largest temperature of the initial state and of the walls at any time \[K\].
    pub fn temperatures(&self) -> [f64; 2] {
        walls::temperatures(self.initial_temperature, &self.walls)
    }

    /// Length over which heat has to spread \[m\]: in each direction half of the box if heat passes both walls, the whole box
    /// if it passes one; the shorter of the two directions.
    pub fn heat_way(&self) -> f64 {
        let warm = |wall: usize| self.walls[wall].conducts();
        let ways = [0, 1].map(|k| match (warm(2 * k), warm(2 * k + 1)) {
            (true, true) => 0.5 * self.size[k],
            (false, false) => f64::INFINITY,
            _ => self.size[k],
        });
        let way = ways[0].min(ways[1]);
        if way.is_finite() { way } else { self.size[0].max(self.size[1]) }
    }

    /// Thermal diffusivity of the bed, K/(ρ c (1 − η)) [m²/s], and its mean conductivity K [W/(m K)], by the model for packings of
    /// about the initial porosity or pressure.
    pub fn diffusivity(&self) -> [f64; 2] {
        let porosity = match self.start {
            InitialPacking::Porosity(porosity) => porosity,
            InitialPacking::Pressure(pressure) => self.discs().porosity_at(pressure),
        };
        let answer = self.discs().usual(porosity);
        let share = 0.5 * (answer.conductivity[0][0] + answer.conductivity[1][0]);
        let conductivity = share * self.grains.thermal_conductivity;
        let solid = self.model.law().solid_fraction(porosity);
        [conductivity / (self.grains.density * self.grains.heat_capacity * solid), conductivity]
    }

    /// Proposed end time L²/D \[s\], rounded to two digits: the time in which most of the heat has spread over the length
    /// L = [`DiscCase::heat_way`].
    pub fn proposed_end(&self) -> f64 {
        let way = self.heat_way();
        rounded(way * way / self.diffusivity()[0], 2)
    }

    /// The first time step \[s\], rounded to two digits: a twentieth of the time in which heat crosses a cell.
    pub fn first_step(&self) -> f64 {
        let [x, y] = self.cell();
        let crossed = x.min(y) * x.min(y) / self.diffusivity()[0];
        rounded((0.05 * crossed).min(0.01 * self.end_time), 2)
    }
}

/// Two or three numbers, one for each direction: beds of discs have two, boxes of spheres three.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbers<T>(pub Vec<T>);

impl<T: Copy + std::fmt::Display> Numbers<T> {
    /// The numbers of `key` as an array.
    ///
    /// # Errors
    /// [`CaseError::Parameter`] for another count, with what is `allowed`.
    pub fn exactly<const N: usize>(&self, key: &str, allowed: &str) -> Result<[T; N], CaseError> {
        <[T; N]>::try_from(self.0.as_slice()).map_err(|_| refused(key, self.text(), allowed))
    }

    /// The numbers for messages.
    pub fn text(&self) -> String {
        self.0.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
    }
}

fn parse_numbers<T: std::str::FromStr>(text: &str, between: &[char]) -> Option<Numbers<T>> {
    let parts: Option<Vec<T>> = text.split(between).map(|part| part.trim().parse().ok()).collect();
    parts.filter(|parts| (2..=3).contains(&parts.len())).map(Numbers)
}

/// Reads two or three numbers with an x between them, such as `0.6x0.2`.
///
/// # Errors
/// A text that says what is allowed.
pub fn parse_sides<T: std::str::FromStr>(text: &str) -> Result<Numbers<T>, String> {
    parse_numbers(text, &['x', 'X', '×']).ok_or_else(|| {
        "two numbers with an x between, such as 0.6x0.2 [m] for a box or 30x10 for cells; a box of spheres has three"
            .to_string()
    })
}

/// Reads the place of a point \[m\], such as `0.1,0.05`.
///
/// # Errors
/// A text that says what is allowed.
pub fn parse_point(text: &str) -> Result<Numbers<f64>, String> {
    parse_numbers(text, &[',']).ok_or_else(|| {
        "x,y in metres from the lower left corner, such as 0.1,0.05; x,y,z in a box of spheres".to_string()
    })
}

/// Reads the condition of a wall: `insulated`, a temperature \[K\], `time:T,time:T,...`, `h=200,T=300` (heat transfer coefficient
/// \[W/(m² K)\] to the outside \[K\]), or `q=500` (heat flux into the bed \[W/m²\]).
///
/// # Errors
/// A text that says what is allowed.
pub fn parse_wall(text: &str) -> Result<WallOverTime, String> {
    let text = text.trim();
    let allowed = || {
        "insulated, a temperature in kelvin such as 350 or with a unit such as 80C, temperatures over time such as 0:300,60:350 (times [s] from 0 on and \
         rising), a heat transfer coefficient [W/(m2 K)] and the temperature outside such as h=200,T=300, or a heat flux into \
         the bed [W/m2] such as q=500"
            .to_string()
    };
    if text == "insulated" {
        return Ok(WallOverTime::Steady(WallHeat::Insulated));
    }
    if let Ok(value) = TEMPERATURE.parse(text) {
        return Ok(WallOverTime::Steady(WallHeat::Temperature(value)));
    }
    if text.contains('=') {
        return by_name(text).ok_or_else(allowed);
    }
    let row = |part: &str| {
        let (time, value) = part.split_once(':')?;
        Some([time.trim().parse().ok()?, TEMPERATURE.parse(value).ok()?])
    };
    let rows: Vec<[f64; 2]> = text.split(',').map(row).collect::<Option<_>>().ok_or_else(allowed)?;
    WallOverTime::table(rows).ok_or_else(allowed)
}

fn by_name(text: &str) -> Option<WallOverTime> {
    let text_of = |part: &'_ str, name: &str| -> Option<String> {
        let (key, value) = part.split_once('=')?;
        (key.trim() == name).then(|| value.trim().to_string())
    };
    let named = |part: &str, name: &str| -> Option<f64> { text_of(part, name)?.parse().ok() };
    match text.split_once(',') {
        Some((h, outside)) => Some(WallOverTime::Coefficient {
            coefficient: named(h, "h")?,
            outside: TEMPERATURE.parse(&text_of(outside, "T")?).ok()?,
        }),
        None => Some(WallOverTime::Flux(named(text, "q")?)),
    }
}

#[cfg(test)]
#[path = "scene_tests.rs"]
mod tests;
