//! Scatter between packings of the same recipe at the same strain: what no law of the recipe could be better than.
//!
//! It is measured as the errors of the law are, over the same states: each packing of a pair is judged as if the other were a law that
//! foretells it. Since both scatter, half of the mean square counts. The deviator's difference is the length of the difference of two
//! tensors. Where packings have no directions of their own, their axes are named so that their strains agree. Where one of them has
//! just lost its load, it has no stress and conducts nothing by contacts; what it would do later is not known, and neither that nor the
//! law's error there is counted. Stresses count over the mean of both packings' scales, since one of them may be about to lose its load.

use super::errors::{Errors, MIN_PRESSURE, Sums};
use super::fit::scales;
use super::tensor::{Tensor, contraction, deviator, mean};
use super::tracks::Track;

/// Names of the axes: those of the first two keep z, along which packings were pressed; and senses.
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 0, 2], [0, 2, 1], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
const SENSES: [[f64; 3]; 4] = [[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, -1.0]];

type Axes = ([usize; 3], [f64; 3]);

/// A track, another one to which it is compared, and the axes of the second with which it is strained as the first.
pub struct Pair<'a> {
    pub one: &'a Track,
    other: &'a Track,
    axes: Axes,
}

/// Each track with each other one to which it is compared.
pub fn pairs<'a>(tracks: &[&'a Track]) -> Vec<Pair<'a>> {
    let others = |one: &'a Track| {
        tracks.iter().filter_map(move |other| common_axes(one, other).map(|axes| Pair { one, other, axes }))
    };
    tracks.iter().flat_map(|one| others(one)).collect()
}

/// Scatter between these pairs; `None` without any.
pub fn noise(pairs: &[Pair]) -> Option<Errors> {
    let mut sums = Sums::default();
    pairs.iter().for_each(|pair| pair.add(&mut sums));
    sums.errors()
}

impl Pair<'_> {
    /// How many states of the track are compared: as far as both carry load, and where the other one loses it.
    pub fn states(&self) -> usize {
        self.one.steps.len().min(self.other.steps.len() + usize::from(self.other.loses_load))
    }

    /// Adds the differences of the other track at the states of the one.
    fn add(&self, sums: &mut Sums) {
        let Self { one, other, axes } = self;
        let of_other = scales(other);
        for (k, (step, scale)) in one.steps.iter().zip(scales(one)).take(self.states()).enumerate() {
            let a = &step.to;
            let scale = of_other.get(k).map_or(scale, |other| 0.5 * (scale + other));
            let (stress, contact, gas) = match other.steps.get(k) {
                Some(b) => (renamed(&b.to.stress, *axes), mean(b.to.contact), b.to.gas[2]),
                None => ([0.0; 6], 0.0, f64::NAN),
            };
            let wrong = deviator(std::array::from_fn(|k| (a.stress[k] - stress[k]) / scale));
            let pressure = (mean(a.stress) - mean(stress)) / scale;
            sums.add_stress([0.5 * pressure * pressure, 0.5 * contraction(&wrong, &wrong)]);
            if mean(a.stress) >= MIN_PRESSURE && mean(a.contact) > 0.0 {
                let [contact, gas] = [contact / mean(a.contact) - 1.0, gas / a.gas[2] - 1.0];
                sums.add_conductivity([0.5 * contact * contact, 0.5 * gas * gas]);
            }
        }
    }
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
    use crate::spheres::tracks::{Point, Step, set_aside};

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
            aside: 0.0,
            steps: vec![Step { from: 0, thermal: 0.0, stretch, free_axis: None, to: point }],
            loses_load: false,
        }
    }

    #[test]
    fn a_packing_starts_from_the_solid_fraction_of_its_recipe_and_tells_its_own() {
        let law = crate::spheres::parameters::beginning();
        let p = 1e-5;
        let made = |number, recipe: &str, solid| {
            let mut track = track(number, [1e-4, 0.0, 0.0, 0.0, 0.0, 0.0], [p, p, p, 0.0, 0.0, 0.0]);
            track.packed.solid = solid;
            Track { recipe: recipe.to_string(), ..track }
        };
        // A packing counts once, however many paths it has.
        let mut tracks =
            [made(0, "a", 0.60), made(0, "a", 0.60), made(1, "a", 0.62), made(2, "b", 0.64)].to_vec();
        set_aside(&mut tracks);
        for (track, solid) in tracks.iter().zip([0.61, 0.61, 0.61, 0.64]) {
            let start = track.start(&law);
            assert!((start.solid() - solid).abs() < 1e-12, "{} for {solid}", start.solid());
            assert!((mean(law.stress(&start)) / p - 1.0).abs() < 1e-6);
            let own = track.of_packing(&start).solid();
            assert!((own - track.packed.solid).abs() < 1e-4, "{own} for {}", track.packed.solid);
        }
    }

    #[test]
    fn the_names_of_axes_do_not_count_where_packings_have_no_direction() {
        let p = 1e-5;
        let along_x = track(0, [-1e-3, 0.0, 0.0, 0.0, 0.0, 0.0], [2.0 * p, p, p, 0.0, 0.0, 0.0]);
        let along_z = track(1, [0.0, 0.0, -1e-3, 0.0, 0.0, 0.0], [p, p, 2.0 * p, 0.0, 0.0, 0.0]);
        let same = noise(&pairs(&[&along_x, &along_z])).expect("a pair");
        assert!(same.pressure < 1e-12 && same.deviator < 1e-12, "{same:?}");
        let sheared = |number, sense: f64| {
            track(number, [0.0, 0.0, 0.0, sense * 1e-3, 0.0, 0.0], [p, p, p, -sense * 0.3 * p, 0.0, 0.0])
        };
        let same = noise(&pairs(&[&sheared(2, 1.0), &sheared(3, -1.0)])).expect("a pair");
        assert!(same.deviator < 1e-12, "{same:?}");
        // A deviator of the same length in another direction is another one.
        let other = track(4, [0.0, 0.0, -1e-3, 0.0, 0.0, 0.0], [p, 2.0 * p, p, 0.0, 0.0, 0.0]);
        let found = noise(&pairs(&[&along_x, &other])).expect("a pair");
        let length = (2.0 * p * p).sqrt() / scales(&other)[0];
        assert!((found.deviator - length / 2f64.sqrt()).abs() < 1e-9, "{found:?}");
        // One that loses its load foretells nought where it has lost it.
        let longer = Track {
            packing: 7,
            steps: [along_x.steps.clone(), along_x.steps.clone()].concat(),
            ..along_x.clone()
        };
        let shorter = Track { packing: 8, loses_load: true, ..along_x.clone() };
        let found = noise(&pairs(&[&longer, &shorter])).expect("a pair");
        // Of three states two are met, and at the third the other one has no load.
        assert!((found.contact - (0.5f64 / 3.0).sqrt()).abs() < 1e-9, "{found:?}");
        assert!(found.gas < 1e-12, "{found:?}");
        assert!(noise(&pairs(&[&longer, &along_x])).expect("a pair").contact < 1e-12);
        // Its states are compared as long as the other one is known.
        let much_longer = Track { packing: 9, steps: vec![along_x.steps[0]; 5], ..along_x.clone() };
        let compared: Vec<usize> = pairs(&[&much_longer, &shorter]).iter().map(Pair::states).collect();
        assert_eq!(compared, [2, 1]);
        // Packings with a direction of their own keep it.
        let pressed = |track: &Track| Track { is_isotropic: false, ..track.clone() };
        assert_eq!(noise(&pairs(&[&pressed(&along_x), &pressed(&along_z)])), None);
        assert_eq!(noise(&pairs(&[&along_x, &sheared(5, 1.0)])), None);
    }
}
