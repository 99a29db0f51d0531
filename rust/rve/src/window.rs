//! Windows: rectangles of a large assembly, averaged like an RVE.

use crate::Simulation;
use crate::homogenise::{Averages, homogenise_in};
use crate::region::{Cut, Polygon};
use msdd_dem::{Disc, Side};

/// A rectangle of an assembly and its averages. Averages that an RVE has for its whole box (sum-of-areas porosity,
/// coordination, rattlers, mean radius) are here those of the discs in the window.
#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    /// Lower left and upper right corner \[m\].
    pub low: [f64; 2],
    pub high: [f64; 2],
    pub averages: Averages,
}

/// The box cut into `nx` × `ny` equal windows, x fastest. Contacts are clipped.
///
/// # Panics
/// When `nx` or `ny` is 0.
pub fn windows(simulation: &Simulation, nx: usize, ny: usize) -> Vec<Window> {
    assert!(nx > 0 && ny > 0, "{nx} x {ny} windows");
    let [left, right, bottom, top] = simulation.walls.position;
    let cut = |low: f64, high: f64, k: usize, n: usize| low + (high - low) * k as f64 / n as f64;
    let mut list = Vec::new();
    for l in 0..ny {
        let (low, high) = (cut(bottom, top, l, ny), cut(bottom, top, l + 1, ny));
        // The box is cropped to one row of windows at a time, so that cropping to each window passes over few discs.
        let row = crop(simulation, [left, low], [right, high]);
        for k in 0..nx {
            list.push(window(&row, [cut(left, right, k, nx), low], [cut(left, right, k + 1, nx), high]));
        }
    }
    list
}

/// The square window of side `size` \[m\] around a point, moved inwards where needed to keep the distance `margin` \[m\]
/// from the walls. Along an axis on which the box is too short for that, the window spans all but the margins. Contacts
/// are clipped.
pub fn window_around(simulation: &Simulation, centre: [f64; 2], size: f64, margin: f64) -> Window {
    let [left, right, bottom, top] = simulation.walls.position;
    let span = |at: f64, low: f64, high: f64| {
        let (low, high) = (low + margin, high - margin);
        let half = 0.5 * size.min(high - low);
        let middle = at.clamp(low + half, (high - half).max(low + half));
        (middle - half, middle + half)
    };
    let ((x0, x1), (y0, y1)) = (span(centre[0], left, right), span(centre[1], bottom, top));
    window(simulation, [x0, y0], [x1, y1])
}

/// Averages over the rectangle from `low` to `high`, contacts clipped.
pub fn window(simulation: &Simulation, low: [f64; 2], high: [f64; 2]) -> Window {
    let part = crop(simulation, low, high);
    let mut averages = homogenise_in(&part, &Polygon::rectangle(low, high), Cut::Clip);
    let inside: Vec<bool> = part.discs.iter().map(|d| near(d, low, high, 0.0)).collect();
    let mut degree = vec![0u32; part.discs.len()];
    part.for_each_contact(|contact| contact.discs().for_each(|k| degree[k] += 1));
    let (mut count, mut bearing, mut contacts, mut radii) = (0u64, 0u64, 0u32, 0.0);
    for (k, disc) in part.discs.iter().enumerate().filter(|&(k, _)| inside[k]) {
        count += 1;
        bearing += u64::from(degree[k] > 0);
        contacts += degree[k];
        radii += disc.radius;
    }
    averages.porosity_sum_of_areas = averages.porosity - averages.overlap_fraction;
    averages.coordination = f64::from(contacts) / bearing.max(1) as f64;
    averages.rattlers = count - bearing;
    averages.mean_radius = radii / count.max(1) as f64;
    Window { low, high, averages }
}

/// The discs in or near a rectangle with their contacts, in the same walls: everything that averages over the rectangle
/// depend on.
pub fn crop(simulation: &Simulation, low: [f64; 2], high: [f64; 2]) -> Simulation {
    const GONE: usize = usize::MAX;
    let largest = simulation.discs.iter().map(|d| d.radius).fold(0.0, f64::max);
    let mut number = vec![GONE; simulation.discs.len()];
    let mut discs = Vec::new();
    for (k, disc) in simulation.discs.iter().enumerate() {
        // Large enough to include the partners of all discs that reach into the rectangle.
        if near(disc, low, high, 3.0 * largest) {
            number[k] = discs.len();
            discs.push(*disc);
        }
    }
    let mut part = Simulation::new(simulation.material.clone(), discs, simulation.walls.clone());
    simulation.for_each_contact(|contact| {
        let i: Result<usize, Side> = contact.i.map(|i| number[i]);
        if i != Ok(GONE) && number[contact.j] != GONE {
            let known = part.set_tangential_force(i, number[contact.j], contact.tangential_force);
            debug_assert!(known, "contacts of a crop are contacts of the whole");
        }
    });
    part
}

/// Whether the centre lies in the rectangle enlarged by `margin` on all sides.
fn near(disc: &Disc, low: [f64; 2], high: [f64; 2], margin: f64) -> bool {
    let within = |at: f64, low: f64, high: f64| (low - margin..=high + margin).contains(&at);
    within(disc.x, low[0], high[0]) && within(disc.y, low[1], high[1])
}

#[cfg(test)]
#[path = "window_tests.rs"]
mod tests;
