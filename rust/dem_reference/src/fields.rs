//! Initial fields for the solver: averages in windows of the packed box around the cells of a mesh.

use crate::ReferenceError;
use crate::observe::{MARGIN, shear_stress};
use msdd_case::fields::{FieldKind, list};
use msdd_dem::Simulation;
use msdd_rve::window::crop;
use msdd_rve::{Averages, window_around};
use rayon::prelude::*;

/// Side of a window in mean radii, 215 mm with the paper's grains: about 500 discs (section 3.2.1).
pub const WINDOW: f64 = 43.0;
/// Height of a band of the box over the side of a window.
const BAND: f64 = 0.25;

/// Averages over a window of side `window` \[m\] around each of the centres \[m\], on `threads` threads; results do not depend
/// on their number.
///
/// # Errors
/// [`ReferenceError::Parameter`] with a centre outside the box; the error of the system when it cannot start threads.
pub fn around(
    simulation: &Simulation,
    centres: &[[f64; 2]],
    window: f64,
    threads: usize,
) -> Result<Vec<Averages>, ReferenceError> {
    let [left, right, bottom, top] = simulation.walls.position;
    let inside = |[x, y]: [f64; 2]| (left..=right).contains(&x) && (bottom..=top).contains(&y);
    if let Some(centre) = centres.iter().find(|&&centre| !inside(centre)) {
        let (value, allowed) = (format!("{centre:?} m"), format!("inside {:?} m", simulation.walls.position));
        return Err(ReferenceError::Parameter { key: "cell centre", value, allowed });
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.max(1)).build();
    let pool = pool.map_err(std::io::Error::other)?;
    let bands = bands(simulation, window);
    let margin = MARGIN * simulation.mean_radius();
    let average = |&centre: &[f64; 2]| {
        let band = (((centre[1] - bottom) / (BAND * window)) as usize).min(bands.len() - 1);
        window_around(&bands[band], centre, window, margin).averages
    };
    Ok(pool.install(|| centres.par_iter().map(average).collect()))
}

/// Cuts the box into overlapping bands. Each has all discs that the windows around the centres in it depend on, so that
/// averaging over a window has to look at few discs only.
fn bands(simulation: &Simulation, window: f64) -> Vec<Simulation> {
    let [left, right, bottom, top] = simulation.walls.position;
    let height = BAND * window;
    let count = ((top - bottom) / height).ceil() as usize;
    let band = |k: usize| {
        // A window at a wall is shifted inwards by up to half of its side.
        let reach = window + MARGIN * simulation.mean_radius();
        let (low, high) = (bottom + k as f64 * height - reach, bottom + (k + 1) as f64 * height + reach);
        crop(simulation, [left, low], [right, high])
    };
    (0..count).map(band).collect()
}

/// The files of the fields: name and text. `grains`: conductivity of the grains [W/(m K)]; `note` says where the values come
/// from.
pub fn files(averages: &[Averages], grains: f64, note: &str) -> Vec<(&'static str, String)> {
    let scalar = |name, what: &str, value: fn(&Averages) -> f64| {
        let lines = averages.iter().map(|a| format!("{:.6}", value(a)));
        (name, list(name, FieldKind::Ratio, &format!("{what}. {note}"), lines))
    };
    // OpenFOAM's stress: tension positive. The grains are in a plane, so components with z are zero.
    let stress = averages.iter().map(|a| {
        let [xx, xy, yy] = [a.stress_xx, shear_stress(a), a.stress_yy].map(|stress| -stress);
        format!("({xx:.2} {xy:.2} 0 {yy:.2} 0 0)")
    });
    let conductivity = averages.iter().map(|a| {
        let network = [a.conductivity_network_xx, a.conductivity_network_xy, a.conductivity_network_yy]
            .map(|k| k * grains);
        format!("({:.4} {:.4} 0 {:.4} 0 0)", network[0], network[1], network[2])
    });
    let conductivity_note =
        format!("Initial conductivity [W/(m K)], resistor network of the contacts solved. {note}");
    let stress_note = format!("Initial stress [Pa], tension positive. {note}");
    vec![
        scalar("porosity", "Initial porosity, overlaps counted once", |a| a.porosity),
        scalar("fabricIndex", "Initial fabric index F_xx - F_yy", |a| a.fabric_index),
        ("conductivity", list("conductivity", FieldKind::Conductivity, &conductivity_note, conductivity)),
        ("stress", list("stress", FieldKind::Stress, &stress_note, stress)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use msdd_dem::{Disc, Material, Walls};

    /// Overlapping discs in different rows, in a box of several bands.
    fn heap() -> Simulation {
        let disc = |k: u32| {
            let (x, y) = (f64::from(k % 40), f64::from(k / 40));
            let (dx, dy) = (0.1 * (y * 3.7).sin(), 0.1 * (x * 2.3).cos());
            Disc::at_rest(0.01 * (0.5 + x + dx), 0.01 * (0.5 + y + dy), 5.8e-3, 1.0)
        };
        Simulation::new(Material::default(), (0..1600).map(disc).collect(), Walls::around(0.4, 0.4))
    }

    #[test]
    fn a_window_of_a_band_is_that_of_the_whole() {
        let heap = heap();
        let centres = [[0.01, 0.01], [0.2, 0.149], [0.3, 0.21], [0.39, 0.399]];
        for (centre, found) in centres.iter().zip(around(&heap, &centres, 0.2, 2).unwrap()) {
            let whole = window_around(&heap, *centre, 0.2, MARGIN * heap.mean_radius()).averages;
            assert_eq!(found, whole, "{centre:?}");
        }
        let error = around(&heap, &[[0.5, 0.1]], 0.2, 1).unwrap_err().to_string();
        assert!(error.contains("cell centre = [0.5, 0.1] m"), "{error}");
    }

    #[test]
    fn stress_is_written_tension_positive() {
        let heap = heap();
        let averages = around(&heap, &[[0.2, 0.2]], 0.2, 1).unwrap();
        let files = files(&averages, 100.0, "note");
        let text = &files.iter().find(|file| file.0 == "stress").unwrap().1;
        let line = text.lines().skip_while(|line| *line != "(").nth(1).unwrap();
        let values: Vec<f64> =
            line.trim_matches(['(', ')']).split(' ').map(|word| word.parse().unwrap()).collect();
        assert!(averages[0].stress_xx > 0.0, "the heap is compressed");
        assert!(
            (values[0] + averages[0].stress_xx).abs() < 0.01
                && (values[3] + averages[0].stress_yy).abs() < 0.01
        );
    }
}
