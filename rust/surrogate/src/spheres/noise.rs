//! Scatter between packings of the same recipe at the same strain: what no law of the recipe could be better than.
//!
//! It is measured as the errors of the law are: as half of the mean square of the differences of all pairs, of which the deviator's is
//! the length of the difference of two tensors. Where packings have no directions of their own, their axes are named so that their
//! strains agree.

use super::errors::{Errors, LEAST_PRESSURE, Sums};
use super::fit::scales;
use super::tensor::{Tensor, contraction, deviator, mean};
use super::tracks::Track;

/// Names of the axes: those of the first two keep z, along which packings were pressed; and senses.
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 0, 2], [0, 2, 1], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
const SENSES: [[f64; 3]; 4] = [[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, -1.0]];

type Axes = ([usize; 3], [f64; 3]);

/// Scatter between the pairs of these tracks; `None` without pairs.
pub fn noise(tracks: &[&Track]) -> Option<Errors> {
    let mut sums = Sums::default();
    for (k, one) in tracks.iter().enumerate() {
        for other in &tracks[k + 1..] {
            let Some(axes) = common_axes(one, other) else { continue };
            let scales = scales(one).into_iter().zip(scales(other));
            for ((a, b), (first, second)) in one.steps.iter().zip(&other.steps).zip(scales) {
                let (a, b, scale) = (&a.to, &b.to, 0.5 * (first + second));
                let named = renamed(&b.stress, axes);
                let wrong = deviator(std::array::from_fn(|k| (a.stress[k] - named[k]) / scale));
                let pressure = (mean(a.stress) - mean(b.stress)) / scale;
                sums.add_stress([0.5 * pressure * pressure, 0.5 * contraction(&wrong, &wrong)]);
                let least = mean(a.stress).min(mean(b.stress));
                if least >= LEAST_PRESSURE && mean(a.contact) > 0.0 && mean(b.contact) > 0.0 {
                    let contact = mean(a.contact) / mean(b.contact) - 1.0;
                    let gas = a.gas[2] / b.gas[2] - 1.0;
                    sums.add_conductivity([0.5 * contact * contact, 0.5 * gas * gas]);
                }
            }
        }
    }
    sums.errors()
}

/// T of axes i, j is that of the axes `order`_i, `order`_j, with the senses.
fn renamed(tensor: &Tensor, (order, senses): Axes) -> Tensor {
    let [xx, yy, zz, xy, xz, yz] = *tensor;
    let full = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let at = |i: usize, j: usize| senses[i] * senses[j] * full[order[i]][order[j]];
    [at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(0, 2), at(1, 2)]
}

/// The names of the second packing's axes with which it is strained as the first, if both have the same recipe.
fn common_axes(a: &Track, b: &Track) -> Option<Axes> {
    if a.packing == b.packing || a.recipe != b.recipe || a.steps.is_empty() || b.steps.is_empty() {
        return None;
    }
    let near = |a: f64, b: f64| (a - b).abs() < 1e-6 * (a.abs() + b.abs()) + 1e-15;
    let orders = if a.is_isotropic { &ORDERS[..] } else { &ORDERS[..2] };
    let all = orders.iter().flat_map(|order| SENSES.map(|senses| (*order, senses)));
    let mut steps = all.filter(|axes| {
        a.steps.iter().zip(&b.steps).all(|(a, b)| {
            let named = renamed(&b.stretch, *axes);
            near(a.thermal, b.thermal) && (0..6).all(|k| near(a.stretch[k], named[k]))
        })
    });
    steps.next()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spheres::tracks::{Point, Step};

    /// A packing that was sheared, or closed along an axis.
    fn track(packing: i64, stretch: Tensor, stress: Tensor) -> Track {
        let [gas, coordination, fabric] = [1.0, 5.0, 1.0 / 3.0];
        let contact = [0.01, 0.01, 0.01, 0.0, 0.0, 0.0];
        let point = Point {
            solid: 0.6,
            stress,
            contact,
            gas: [gas; 3],
            gas_along: [f64::NAN; 2],
            coordination,
            fabric: [fabric, fabric, fabric, 0.0, 0.0, 0.0],
            mobilised: 1.0,
        };
        Track {
            packing,
            name: "any".to_string(),
            recipe: String::new(),
            is_isotropic: true,
            spheres: 1000,
            weight: 1.0,
            packed: point,
            steps: vec![Step { from: 0, thermal: 0.0, stretch, gives_way: None, to: point }],
        }
    }

    #[test]
    fn the_names_of_axes_do_not_count_where_packings_have_no_direction() {
        let p = 1e-5;
        let along_x = track(0, [-1e-3, 0.0, 0.0, 0.0, 0.0, 0.0], [2.0 * p, p, p, 0.0, 0.0, 0.0]);
        let along_z = track(1, [0.0, 0.0, -1e-3, 0.0, 0.0, 0.0], [p, p, 2.0 * p, 0.0, 0.0, 0.0]);
        let same = noise(&[&along_x, &along_z]).expect("a pair");
        assert!(same.pressure < 1e-12 && same.deviator < 1e-12, "{same:?}");
        let sheared = |number, sense: f64| {
            track(number, [0.0, 0.0, 0.0, sense * 1e-3, 0.0, 0.0], [p, p, p, -sense * 0.3 * p, 0.0, 0.0])
        };
        let same = noise(&[&sheared(2, 1.0), &sheared(3, -1.0)]).expect("a pair");
        assert!(same.deviator < 1e-12, "{same:?}");
        // A deviator of the same length in another direction is another one.
        let other = track(4, [0.0, 0.0, -1e-3, 0.0, 0.0, 0.0], [p, 2.0 * p, p, 0.0, 0.0, 0.0]);
        let found = noise(&[&along_x, &other]).expect("a pair");
        let length = (2.0 * p * p).sqrt() / scales(&other)[0];
        assert!((found.deviator - length / 2f64.sqrt()).abs() < 1e-9, "{found:?}");
        // Packings with a direction of their own keep it.
        let pressed = |track: &Track| Track { is_isotropic: false, ..track.clone() };
        assert_eq!(noise(&[&pressed(&along_x), &pressed(&along_z)]), None);
        assert_eq!(noise(&[&along_x, &sheared(5, 1.0)]), None);
    }
}
