//! Maps of fields at the shown times, and the least, mean and largest values of the last one.

use super::run::Run;
use super::units::scaled;
use crate::error::CliError;
use msdd_case::results::{Field, Values};
use msdd_draw::map::range_of;
use msdd_draw::{Cells, Map, Sheet};

/// Values that differ by less than this share are the same.
const SAME: f64 = 1e-9;

/// How a field becomes a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Scalar,
    /// A third of the trace; of discs, whose zz is 0, a half.
    Trace,
    Magnitude,
}

/// A quantity that is shown.
pub struct Quantity {
    pub field: &'static str,
    pub name: &'static str,
    pub unit: &'static str,
    pub kind: Kind,
}

pub const QUANTITIES: [Quantity; 6] = [
    Quantity { field: "T", name: "temperature T", unit: "K", kind: Kind::Scalar },
    Quantity { field: "gasTemperature", name: "temperature of the gas", unit: "K", kind: Kind::Scalar },
    Quantity { field: "pressure", name: "pressure p of the grains", unit: "Pa", kind: Kind::Scalar },
    Quantity {
        field: "conductivity",
        name: "conductivity K, mean of its directions",
        unit: "W/(m K)",
        kind: Kind::Trace,
    },
    Quantity { field: "D", name: "displacement |D|", unit: "m", kind: Kind::Magnitude },
    Quantity { field: "porosity", name: "porosity", unit: "-", kind: Kind::Scalar },
];

impl Kind {
    fn of(self, row: &[f64]) -> f64 {
        match (self, row) {
            (Self::Scalar, [value]) => *value,
            (Self::Trace, [xx, _, _, yy, _, zz]) if *zz == 0.0 => 0.5 * (xx + yy),
            (Self::Trace, [xx, _, _, yy, _, zz]) => (xx + yy + zz) / 3.0,
            (Self::Magnitude, row) => row.iter().map(|x| x * x).sum::<f64>().sqrt(),
            _ => f64::NAN,
        }
    }

    fn all(self, values: &Values, cells: usize) -> Vec<f64> {
        (0..cells).map(|cell| self.of(values.row(cell))).collect()
    }
}

impl Quantity {
    /// Its values in the cells of a region at a time; none if it was not written.
    pub fn values(&self, run: &Run, part: usize, time: usize) -> Result<Option<Vec<f64>>, CliError> {
        let cells = run.parts[part].mesh.volumes.len();
        let field: Option<Field> = run.field(part, time, self.field)?;
        Ok(field.map(|field| self.kind.all(&field.cells, cells)))
    }
}

/// Least, mean and largest value in the bed at a time, the mean by volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    pub least: f64,
    pub mean: f64,
    pub most: f64,
}

pub fn spread(run: &Run, quantity: &Quantity, time: usize) -> Result<Option<Spread>, CliError> {
    let Some(values) = quantity.values(run, 0, time)? else { return Ok(None) };
    let volumes = &run.parts[0].mesh.volumes;
    let (least, most) = range_of(values.iter());
    let mean = values.iter().zip(volumes).map(|(v, w)| v * w).sum::<f64>() / volumes.iter().sum::<f64>();
    Ok(Some(Spread { least, mean, most }))
}

/// The two sections next to each other, the polygons of some regions as one list.
fn cells(run: &Run, drawn: &[bool]) -> (Cells, Vec<(usize, usize)>) {
    let (mut points, mut polygons, mut owners) = (Vec::new(), Vec::new(), Vec::new());
    let mut right = 0.0;
    for section in &run.sections {
        let (low, high) = range_of(section.points.iter().map(|p| &p[0]));
        let first = points.len();
        // A gap of a tenth of the width
        let shift = if first == 0 { 0.0 } else { right + 0.1 * (high - low) - low };
        points.extend(section.points.iter().map(|p| [p[0] + shift, p[1]]));
        for (own, owner) in section.polygons.iter().zip(&section.cells).filter(|(_, owner)| drawn[owner.0]) {
            polygons.push(own.iter().map(|p| p + first).collect());
            owners.push(*owner);
        }
        right = high + shift;
    }
    (Cells::Polygons { points, cells: polygons }, owners)
}

/// Maps of all quantities that were written: names of the fields and their figures. `times`: numbers of the times.
pub fn all(run: &Run, times: &[usize], shades: usize) -> Result<Vec<(&'static str, String)>, CliError> {
    each(run, times, shades, msdd_draw::maps)
}

/// The same with a figure for each time, all with the colours of the first to the last.
pub fn frames(
    run: &Run,
    times: &[usize],
    shades: usize,
) -> Result<Vec<(&'static str, Vec<String>)>, CliError> {
    each(run, times, shades, |sheet, list| {
        list.iter().map(|one| msdd_draw::maps(sheet, std::slice::from_ref(one))).collect()
    })
}

fn each<T>(
    run: &Run,
    times: &[usize],
    shades: usize,
    draw: impl Fn(&Sheet, &[Map]) -> T,
) -> Result<Vec<(&'static str, T)>, CliError> {
    let mut figures = Vec::new();
    for quantity in &QUANTITIES {
        let read = |&time: &usize| {
            (0..run.parts.len()).map(|part| quantity.values(run, part, time)).collect::<Result<Vec<_>, _>>()
        };
        let fields: Vec<Vec<Option<Vec<f64>>>> = times.iter().map(read).collect::<Result<_, _>>()?;
        let drawn: Vec<bool> =
            (0..run.parts.len()).map(|part| fields.iter().any(|at| at[part].is_some())).collect();
        if !drawn.contains(&true) {
            continue;
        }
        let (cells, owners) = cells(run, &drawn);
        let value = |at: &Vec<Option<Vec<f64>>>, (part, cell): (usize, usize)| {
            at[part].as_ref().map_or(f64::NAN, |all| all[cell])
        };
        let mut lists: Vec<Vec<f64>> =
            fields.iter().map(|at| owners.iter().map(|owner| value(at, *owner)).collect()).collect();
        let (low, high) = range_of(lists.iter().flatten());
        // What is the same everywhere and always needs no map; T has one in any case
        if quantity.field != QUANTITIES[0].field && high - low <= SAME * high.abs() {
            continue;
        }
        let (unit, factor) = scaled(high.abs().max(low.abs()), quantity.unit);
        lists.iter_mut().flatten().for_each(|value| *value *= factor);
        let names: Vec<String> = times.iter().map(|&time| run.time(time)).collect();
        let label = format!("[{unit}]");
        let range = Some(range_of(lists.iter().flatten()));
        let sheet = Sheet { title: quantity.name, label: &label, range, shades, ..Sheet::default() };
        let list: Vec<Map> =
            names.iter().zip(&lists).map(|(name, values)| Map { name, cells: &cells, values }).collect();
        figures.push((quantity.field, draw(&sheet, &list)));
    }
    Ok(figures)
}
