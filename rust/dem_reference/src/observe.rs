//! Records of a state: one row of the time series, the table of sub-regions, profiles along x.
//!
//! Compression positive. T at a probe is given twice: that of the closest disc, as in the paper, which may be a rattler
//! (a disc without contacts), and the mean of the discs in a window around the probe, weighted by their mass.

use crate::model::SUB_REGIONS;
use crate::results::{Grains, Table};
use msdd_dem::{Side, Simulation};
use msdd_files::{Column, names};
use msdd_rve::network::Network;
use msdd_rve::region::{Polygon, whole_box};
use msdd_rve::{Averages, Cut, homogenise_affine_in, windows};

/// Distance of windows from the walls, in mean radii. The grains next to a wall are packed more loosely, which lowers the
/// conductivity of a window by up to 2 %; but they conduct heat to the wall as well as the bulk does, so the windows leave
/// them out.
pub const MARGIN: f64 = 2.0;
/// Side of the window around a probe, in mean radii: 40 mm with the paper's grains, some 18 discs. A larger one smooths the
/// curve of T more, a smaller one leaves more of the differences between neighbouring discs.
pub const PROBE_WINDOW: f64 = 8.0;
/// Side of the window whose discs are listed one by one, in mean radii.
pub const GRAINS_WINDOW: f64 = 24.0;
/// Bins of a profile.
const BINS: usize = 20;
/// Columns of K/k: affine estimate (Eq. 9) and solved resistor network of the contacts.
const CONDUCTIVITIES: [&str; 4] =
    ["conductivity_xx", "conductivity_yy", "conductivity_network_xx", "conductivity_network_yy"];
const WALL_NAMES: [&str; 4] = ["left", "right", "bottom", "top"];

/// Columns of the time series: `<N>` is the number of each probe, from 1, and `<wall>` each of the four walls.
const SERIES: [Column; 20] = [
    ("time", "s", "time"),
    ("T_P<N>_disc", "K", "T of the grain that is nearest to the probe; it may have no contact"),
    ("T_P<N>_window", "K", "mean T of the grains in the window around the probe, weighted by mass"),
    ("T_mean", "K", "mean T of the box"),
    ("porosity", "-", "porosity of the box, overlaps counted once"),
    ("fabric_index", "-", "F_xx - F_yy of the box"),
    ("pressure", "Pa", "(stress_xx + stress_yy)/2 of the box, compression positive"),
    ("stress_xx", "Pa", "stress of the box along x"),
    ("stress_yy", "Pa", "stress of the box along y"),
    ("stress_xy", "Pa", "shear stress, the mean of both that Love's formula has"),
    ("conductivity_xx", "-", "K_xx/k of the box, affine"),
    ("conductivity_yy", "-", "K_yy/k of the box, affine"),
    ("normal_force_<wall>", "N", "normal force of the grains on the wall, outwards positive"),
    ("tangential_force_<wall>", "N", "force along the wall, positive along the axis"),
    (
        "mobilised_friction_<wall>",
        "-",
        "sum of the tangential forces over the sum of the normal forces there",
    ),
    ("heat_<wall>", "J", "heat from the wall since the start"),
    ("porosity_inner", "-", "porosity of the box less two mean radii at the walls"),
    ("pressure_inner", "Pa", "pressure there"),
    ("stress_xx_inner", "Pa", "stress along x there"),
    ("stress_yy_inner", "Pa", "stress along y there"),
];

/// Names of the columns of the time series for a number of probes.
pub fn series_columns(probes: usize) -> Vec<String> {
    let expanded = |name: &str| -> Vec<String> {
        match name {
            _ if name.contains("<N>") => (1..=probes).map(|k| name.replace("<N>", &k.to_string())).collect(),
            _ if name.contains("<wall>") => WALL_NAMES.map(|wall| name.replace("<wall>", wall)).to_vec(),
            _ => vec![name.to_string()],
        }
    };
    names(&SERIES).into_iter().flat_map(expanded).collect()
}

/// One row of the time series; `window` is the side of the windows around the probes \[m\]. Temperatures in K, conductivities
/// over k, stresses in Pa, forces in N, energies in J.
pub fn series_row(simulation: &Simulation, probes: &[[f64; 2]], window: f64) -> Vec<f64> {
    let mut row = vec![simulation.time];
    row.extend(probes.iter().map(|&at| temperature_of_closest(simulation, at)));
    row.extend(probes.iter().map(|&at| {
        let corner = |side: f64| at.map(|x| x + side * 0.5 * window);
        mean_temperature(simulation, corner(-1.0), corner(1.0))
    }));
    let whole = homogenise_affine_in(simulation, &whole_box(simulation), Cut::Clip);
    let [left, right, bottom, top] = simulation.walls.position;
    row.push(mean_temperature(simulation, [left, bottom], [right, top]));
    row.extend([whole.porosity, whole.fabric_index, whole.pressure]);
    row.extend([whole.stress_xx, whole.stress_yy, shear_stress(&whole)]);
    row.extend([whole.conductivity_xx, whole.conductivity_yy]);
    let walls = wall_loads(simulation);
    row.extend(walls.map(|load| load.normal));
    row.extend(walls.map(|load| load.tangential));
    row.extend(walls.map(|load| load.mobilised));
    row.extend(simulation.heat().map_or([0.0; 4], |heat| heat.wall_heat));
    let inner = homogenise_affine_in(simulation, &inner_box(simulation), Cut::Clip);
    row.extend([inner.porosity, inner.pressure, inner.stress_xx, inner.stress_yy]);
    row
}

/// The box without a margin of [`MARGIN`] mean radii along its walls, where grains are packed more loosely. The windows of
/// the solver's initial fields together cover the same region.
fn inner_box(simulation: &Simulation) -> Polygon {
    let [left, right, bottom, top] = simulation.walls.position;
    let margin = MARGIN * simulation.mean_radius();
    Polygon::rectangle([left + margin, bottom + margin], [right - margin, top - margin])
}

/// σ_xy, the mean of the two that Love's formula has.
pub fn shear_stress(averages: &Averages) -> f64 {
    0.5 * (averages.stress_xy + averages.stress_yx)
}

/// An empty table of the box's conductivity by the solved resistor network, which takes too long for every row of the series.
pub fn network_table() -> Table {
    let columns = ["time", "conductivity_network_xx", "conductivity_network_yy"];
    Table::new(columns.map(str::to_string).to_vec())
}

/// Adds a row with the present K/k.
pub fn add_network(table: &mut Table, simulation: &Simulation) {
    let region = whole_box(simulation);
    let [xx, yy, _] = Network::of_region(simulation, &region, Cut::Clip).conductivity(region.area());
    table.push(vec![simulation.time, xx, yy]);
}

fn conductivities(a: &Averages) -> [f64; 4] {
    [a.conductivity_xx, a.conductivity_yy, a.conductivity_network_xx, a.conductivity_network_yy]
}

fn temperature_of_closest(simulation: &Simulation, [x, y]: [f64; 2]) -> f64 {
    let square = |d: &&msdd_dem::Disc| (d.x - x) * (d.x - x) + (d.y - y) * (d.y - y);
    let closest = simulation.discs.iter().min_by(|a, b| square(a).total_cmp(&square(b)));
    closest.map_or(f64::NAN, |disc| disc.temperature)
}

/// Mean T of the discs with their centre in the rectangle, weighted by mass, so that it corresponds to their heat.
pub fn mean_temperature(simulation: &Simulation, low: [f64; 2], high: [f64; 2]) -> f64 {
    let (mut heat, mut mass) = (0.0, 0.0);
    let inside =
        |at: &&msdd_dem::Disc| (low[0]..=high[0]).contains(&at.x) && (low[1]..=high[1]).contains(&at.y);
    for disc in simulation.discs.iter().filter(inside) {
        heat += disc.mass * disc.temperature;
        mass += disc.mass;
    }
    heat / mass
}

/// Forces of the grains on a wall.
#[derive(Clone, Copy, Debug, Default)]
pub struct WallLoad {
    /// Normal force \[N\], outwards positive.
    pub normal: f64,
    /// Tangential force \[N\], positive along the positive coordinate axis.
    pub tangential: f64,
    /// Mobilised friction Σ |f_t| / Σ f_n of its contacts [-].
    pub mobilised: f64,
}

/// Loads of the four walls, in the order of [`Side`].
pub fn wall_loads(simulation: &Simulation) -> [WallLoad; 4] {
    let mut loads = [WallLoad::default(); 4];
    simulation.for_each_contact(|contact| {
        if let Err(side) = contact.i {
            let load = &mut loads[side as usize];
            load.normal += contact.normal_force();
            load.tangential += tangential_on_wall(side, contact.force());
            load.mobilised += contact.tangential_force.abs();
        }
    });
    for load in &mut loads {
        load.mobilised = if load.normal > 0.0 { load.mobilised / load.normal } else { 0.0 };
    }
    loads
}

/// Component along the wall of the force on the wall, from the force on the disc.
fn tangential_on_wall(side: Side, [fx, fy]: [f64; 2]) -> f64 {
    match side {
        Side::Left | Side::Right => -fy,
        Side::Bottom | Side::Top => -fx,
    }
}

/// Table of the sub-regions, x index fastest: centre \[m\], η, f, K/k, σ \[Pa\], T \[K\].
pub fn sub_regions(simulation: &Simulation) -> Table {
    let mut columns = vec!["x", "y", "porosity", "fabric_index"];
    columns.extend(CONDUCTIVITIES);
    columns.extend(["stress_xx", "stress_yy", "stress_xy", "T"]);
    let mut table = Table::new(columns.into_iter().map(str::to_string).collect());
    for part in windows(simulation, SUB_REGIONS[0], SUB_REGIONS[1]) {
        let (a, low, high) = (&part.averages, part.low, part.high);
        let mut row = [0, 1].map(|k| 0.5 * (low[k] + high[k])).to_vec();
        row.extend([a.porosity, a.fabric_index]);
        row.extend(conductivities(a));
        row.extend([a.stress_xx, a.stress_yy, shear_stress(a), mean_temperature(simulation, low, high)]);
        table.push(row);
    }
    table
}

/// Table of the sub-regions, x index fastest: centre, and mean displacement \[m\] of the discs that were in the sub-region at
/// the start (`start` are their centres).
pub fn displacements(simulation: &Simulation, start: &[[f64; 2]]) -> Table {
    let [left, right, bottom, top] = simulation.walls.position;
    let [nx, ny] = SUB_REGIONS;
    let (width, height) = ((right - left) / nx as f64, (top - bottom) / ny as f64);
    let place = |at: f64, low: f64, size: f64, count: usize| (((at - low) / size) as usize).min(count - 1);
    let (mut moved, mut count) = (vec![[0.0; 2]; nx * ny], vec![0.0f64; nx * ny]);
    for (disc, [x, y]) in simulation.discs.iter().zip(start) {
        let k = place(*x, left, width, nx) + nx * place(*y, bottom, height, ny);
        moved[k][0] += disc.x - x;
        moved[k][1] += disc.y - y;
        count[k] += 1.0;
    }
    let mut table = Table::new(["x", "y", "displacement_x", "displacement_y"].map(str::to_string).to_vec());
    for (k, ([ux, uy], n)) in moved.into_iter().zip(count).enumerate() {
        let centre = [left + ((k % nx) as f64 + 0.5) * width, bottom + ((k / nx) as f64 + 0.5) * height];
        table.push(vec![centre[0], centre[1], ux / n.max(1.0), uy / n.max(1.0)]);
    }
    table
}

/// The discs that reach into the window of side `side` \[m\] around a point, at the start and now; at the start all have the
/// temperature `initial` \[K\].
pub fn grains(start: &Simulation, initial: f64, now: &Simulation, [x, y]: [f64; 2], side: f64) -> Grains {
    let half = 0.5 * side;
    let listed = |simulation: &Simulation, temperature: Option<f64>| {
        let mut table = Table::new(["disc", "x", "y", "r", "T"].map(str::to_string).to_vec());
        for (k, disc) in simulation.discs.iter().enumerate() {
            let reach = half + disc.radius;
            if (disc.x - x).abs() < reach && (disc.y - y).abs() < reach {
                let temperature = temperature.unwrap_or(disc.temperature);
                table.push(vec![k as f64, disc.x, disc.y, disc.radius, temperature]);
            }
        }
        table
    };
    let window = [[x - half, y - half], [x + half, y + half]];
    Grains { window, start: listed(start, Some(initial)), end: listed(now, None) }
}

/// An empty table of profiles.
pub fn profile_table() -> Table {
    let columns = [
        "time",
        "x",
        "T",
        "displacement_x",
        "porosity",
        "stress_xx",
        "stress_yy",
        "stress_xy",
        "friction_bottom",
        "friction_top",
        "pressure_bottom",
        "pressure_top",
    ];
    Table::new(columns.map(str::to_string).to_vec())
}

/// Adds the present profile along x. For each bin: T of the discs in it, displacement of the discs that were in it at the
/// start \[m\] (`start` are their centres), stress \[Pa\], and forces on bottom and top over the length of the bin \[Pa\].
pub fn add_profile(table: &mut Table, simulation: &Simulation, start: &[[f64; 2]]) {
    let [left, right, ..] = simulation.walls.position;
    let width = (right - left) / BINS as f64;
    let bin = |x: f64| (((x - left) / width) as usize).min(BINS - 1);
    let (mut moved, mut count) = ([0.0; BINS], [0.0f64; BINS]);
    for (disc, [x, _]) in simulation.discs.iter().zip(start) {
        moved[bin(*x)] += disc.x - x;
        count[bin(*x)] += 1.0;
    }
    let (mut friction, mut pressure) = ([[0.0; 2]; BINS], [[0.0; 2]; BINS]);
    simulation.for_each_contact(|contact| {
        if let Err(side @ (Side::Bottom | Side::Top)) = contact.i {
            let (k, wall) = (bin(simulation.discs[contact.j].x), usize::from(side == Side::Top));
            friction[k][wall] += tangential_on_wall(side, contact.force()) / width;
            pressure[k][wall] += contact.normal_force() / width;
        }
    });
    for (k, part) in windows(simulation, BINS, 1).iter().enumerate() {
        let (a, low, high) = (&part.averages, part.low, part.high);
        let mut row =
            vec![simulation.time, 0.5 * (low[0] + high[0]), mean_temperature(simulation, low, high)];
        row.extend([moved[k] / count[k].max(1.0), a.porosity, a.stress_xx, a.stress_yy, shear_stress(a)]);
        row.extend(friction[k].into_iter().chain(pressure[k]));
        table.push(row);
    }
}

#[cfg(test)]
#[path = "observe_tests.rs"]
mod tests;
