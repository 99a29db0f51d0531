//! Averages over rectangles of the large model.

use msdd_dem::{Disc, Side, Simulation};
use msdd_rve::region::Polygon;
use msdd_rve::{Averages, Cut, homogenise_in};

/// The rectangle of at most the given size [m] around a point, shifted inside at the walls: its corners.
pub fn corners_around(simulation: &Simulation, centre: [f64; 2], size: f64) -> ([f64; 2], [f64; 2]) {
    let [left, right, bottom, top] = simulation.walls.position;
    let span = |at: f64, low: f64, high: f64| {
        let half = 0.5 * size.min(high - low);
        let middle = at.min(high - half).max(low + half);
        (middle - half, middle + half)
    };
    let ((x0, x1), (y0, y1)) = (span(centre[0], left, right), span(centre[1], bottom, top));
    ([x0, y0], [x1, y1])
}

/// The box cut into `columns` × `lines` equal rectangles, x fastest: their corners.
pub fn grid(simulation: &Simulation, columns: usize, lines: usize) -> Vec<([f64; 2], [f64; 2])> {
    let [left, right, bottom, top] = simulation.walls.position;
    let cut = |low: f64, high: f64, k: usize, n: usize| low + (high - low) * k as f64 / n as f64;
    let x = |k| cut(left, right, k, columns);
    let y = |l| cut(bottom, top, l, lines);
    let cells = (0..lines).flat_map(|l| (0..columns).map(move |k| (k, l)));
    cells.map(|(k, l)| ([x(k), y(l)], [x(k + 1), y(l + 1)])).collect()
}

/// Averages over the rectangle, contacts clipped at its border. What an RVE counts in its whole box (sum-of-areas
/// porosity, coordination, rattlers, mean radius) is of the rectangle's neighbourhood here.
pub fn window(simulation: &Simulation, low: [f64; 2], high: [f64; 2]) -> Averages {
    homogenise_in(&crop(simulation, low, high), &Polygon::rectangle(low, high), Cut::Clip)
}

/// The discs in or near a rectangle with their contacts, in the same walls: all that averages over it depend on.
pub fn crop(simulation: &Simulation, low: [f64; 2], high: [f64; 2]) -> Simulation {
    const GONE: usize = usize::MAX;
    let largest = simulation.discs.iter().map(|d| d.radius).fold(0.0, f64::max);
    let mut number = vec![GONE; simulation.discs.len()];
    let mut discs = Vec::new();
    for (k, disc) in simulation.discs.iter().enumerate() {
        // Partners of discs that reach into the rectangle.
        if near(disc, low, high, 3.0 * largest) {
            number[k] = discs.len();
            discs.push(*disc);
        }
    }
    let mut part = Simulation::new(simulation.material.clone(), discs, simulation.walls.clone());
    simulation.for_each_contact(|contact| {
        let i: Result<usize, Side> = contact.i.map(|i| number[i]);
        if i != Ok(GONE) && number[contact.j] != GONE {
            part.set_tangential_force(i, number[contact.j], contact.tangential_force);
        }
    });
    part
}

/// Whether the centre lies in the rectangle grown by `margin` on all sides.
pub fn near(disc: &Disc, low: [f64; 2], high: [f64; 2], margin: f64) -> bool {
    let within = |at: f64, low: f64, high: f64| (low - margin..=high + margin).contains(&at);
    within(disc.x, low[0], high[0]) && within(disc.y, low[1], high[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use msdd_dem::{Material, Walls};

    /// A loose pile of overlapping discs: no two alike.
    fn heap() -> Simulation {
        let disc = |k: u32| {
            let (x, y) = (f64::from(k % 20), f64::from(k / 20));
            Disc::at_rest(0.5 + x + 0.1 * (y * 3.7).sin(), 0.5 + y + 0.1 * (x * 2.3).cos(), 0.58, 1.0)
        };
        Simulation::new(Material::default(), (0..200).map(disc).collect(), Walls::around(20.0, 10.0))
    }

    #[test]
    fn a_crop_knows_what_the_whole_knows() {
        let heap = heap();
        let (low, high) = ([3.0, 0.0], [9.0, 5.0]);
        let whole = homogenise_in(&heap, &Polygon::rectangle(low, high), Cut::Clip);
        let part = window(&heap, low, high);
        assert!((whole.porosity - part.porosity).abs() < 1e-12);
        assert!((whole.stress_xx / part.stress_xx - 1.0).abs() < 1e-12);
        assert_eq!((whole.fabric_index, whole.contacts), (part.fabric_index, part.contacts));
    }

    #[test]
    fn windows_stay_inside() {
        let heap = heap();
        assert_eq!(corners_around(&heap, [1.0, 5.0], 4.0), ([0.0, 3.0], [4.0, 7.0]));
        assert_eq!(corners_around(&heap, [19.9, 9.0], 4.0), ([16.0, 6.0], [20.0, 10.0]));
        assert_eq!(corners_around(&heap, [10.0, 9.0], 12.0), ([4.0, 0.0], [16.0, 10.0]));
    }

    #[test]
    fn a_grid_covers_the_box() {
        let cells = grid(&heap(), 4, 2);
        assert_eq!(cells.len(), 8);
        assert_eq!((cells[0].0, cells[0].1), ([0.0, 0.0], [5.0, 5.0]));
        assert_eq!((cells[7].0, cells[7].1), ([15.0, 5.0], [20.0, 10.0]));
    }
}
