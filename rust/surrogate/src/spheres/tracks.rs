//! Paths of strain of boxes of spheres, and the law along them.

use super::law::{Known, Law, State, Strain};
use super::tensor::{Tensor, rotation};

/// A state of a box. Stresses over E*, compression positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// φ, overlaps counted twice \[-\].
    pub solid: f64,
    pub stress: Tensor,
    /// Conductivity by contacts over that of the solid.
    pub contact: Tensor,
    /// Conductivity by gas over that of the gas, at [`super::readout::GAS_NUMBERS`].
    pub gas: [f64; 3],
    /// Contacts per sphere, all spheres counted.
    pub coordination: f64,
    /// Mean of n n over the contacts, with the normals n.
    pub fabric: Tensor,
    /// Mobilised part of the friction: the friction while packing over that afterwards, 1 for packings that were shaken.
    pub mobilised: f64,
}

impl Point {
    /// What is known of the packing beside solid fraction and stress.
    pub fn known(&self) -> Known {
        Known {
            coordination: Some(self.coordination),
            fabric: Some(self.fabric),
            mobilised: Some(self.mobilised),
        }
    }

    /// The law's state of this packing.
    pub fn state(&self, law: &Law) -> State {
        law.start(self.solid, self.stress, &self.known())
    }
}

/// An increment from an earlier state of the track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Number of the state from which it starts: 0 is the packing, k + 1 the state after step k.
    pub from: usize,
    /// Growth of the radii.
    pub thermal: f64,
    /// F − 1 of the box, which is 0 below the diagonal: xx, yy, zz, then xy, xz, yz as displacement over distance; extension positive.
    pub stretch: Tensor,
    pub to: Point,
}

/// A packing and what was done with it, as far as it bears load.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    pub packing: i64,
    pub name: String,
    /// How the packing was made, for telling packings that were made alike; and whether it was without a direction.
    pub recipe: String,
    pub is_isotropic: bool,
    /// Number of spheres.
    pub spheres: usize,
    pub packed: Point,
    pub steps: Vec<Step>,
}

impl Track {
    /// The state number `k`, see [`Step::from`].
    pub fn point(&self, k: usize) -> &Point {
        if k == 0 { &self.packed } else { &self.steps[k - 1].to }
    }
}

/// Largest strain that is applied in one part.
const PART: f64 = 2.5e-4;
const MOST_PARTS: f64 = 40.0;

/// The law's states along a track: number k as [`Step::from`].
pub fn follow(law: &Law, track: &Track) -> Vec<State> {
    follow_from(law, track, track.packed.state(law))
}

/// The same where the packing has this state.
pub fn follow_from(law: &Law, track: &Track, packed: State) -> Vec<State> {
    let mut states = vec![packed];
    for step in &track.steps {
        let next = advanced(law, &states[step.from], step.thermal, step.stretch);
        states.push(next);
    }
    states
}

/// In how many parts a strain is applied.
pub fn parts(thermal: f64, stretch: Tensor) -> f64 {
    let largest = stretch.iter().fold(thermal.abs(), |a, b| a.max(b.abs()));
    (largest / PART).ceil().clamp(1.0, MOST_PARTS)
}

/// The state after a straight line of strain, in as many parts as it is long.
pub fn advanced(law: &Law, state: &State, thermal: f64, stretch: Tensor) -> State {
    let parts = parts(thermal, stretch);
    (0..parts as u32).fold(*state, |state, part| {
        let of = |whole: f64| whole / (parts + whole * f64::from(part));
        let [xx, yy, zz, xy, xz, yz] = stretch.map(of);
        // What is above the diagonal turns the box by half of the shear.
        let half = rotation([0.25 * -yz, 0.25 * xz, 0.25 * -xy]);
        law.advanced(&state, &Strain { thermal: of(thermal), cell: [xx, yy, zz, xy, xz, yz] }, &half)
    })
}
