//! Paths of strain of boxes of spheres, and the law along them.

use super::law::{Law, Strain};
use super::readout::Readout;
use super::state::{PackingData, State};
use super::tensor::{Tensor, contraction, mean, rotation};
use std::collections::BTreeMap;

/// A state of a box. Stresses over E*, compression positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// φ, overlaps counted twice \[-\].
    pub solid: f64,
    pub stress: Tensor,
    /// Conductivity by contacts over that of the solid; NaN across z where it is known along z alone.
    pub contact: Tensor,
    /// Conductivity by gas over that of the gas in the mean, at [`super::readout::GAS_NUMBERS`]; NaN where it is not known.
    pub gas: [f64; 3],
    /// Where it is known along z alone: the number of the gas, and the conductivity by gas along z over that of the gas; else NaN.
    pub gas_along: [f64; 2],
    /// Contacts per sphere, all spheres counted.
    pub coordination: f64,
    /// Mean of n n over the contacts, with the normals n.
    pub fabric: Tensor,
    /// Mobilised part of the friction: the friction while packing over that afterwards, 1 for packings that were shaken; of beds that
    /// were poured that of boxes whose contacts carry as large a share of it.
    pub mobilised: f64,
}

impl Point {
    /// What is known of the packing apart from solid fraction and stress.
    pub fn known(&self) -> PackingData {
        PackingData {
            coordination: Some(self.coordination),
            fabric: Some(self.fabric),
            mobilised: Some(self.mobilised),
        }
    }

    /// What of a conductivity by contacts is compared with this state's: its mean, or the part along z where no other is known.
    pub fn compared(&self, contact: &Tensor) -> f64 {
        if self.contact[0].is_finite() { mean(*contact) } else { contact[2] }
    }

    /// Relative error of the conductivity by gas of a state: of its mean at the largest of the numbers, or of the part along z where no
    /// other is known; NaN where neither is.
    pub fn gas_error(&self, readout: &Readout, state: &State) -> f64 {
        let [number, along] = self.gas_along;
        match along.is_finite() {
            true => readout.gas(state, number) * (1.0 + readout.gas_deviator(state)[2]) / along - 1.0,
            false => readout.gases(state)[2] / self.gas[2] - 1.0,
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
    /// Of a box that yields along an axis so that its stress stays: that axis. The law is followed with the stress of the data there,
    /// not with the strain.
    pub free_axis: Option<usize>,
    pub to: Point,
}

impl Step {
    /// Strain of the cell less the growth of the radii, its shears not doubled.
    pub fn strain(&self) -> Tensor {
        let [xx, yy, zz, xy, xz, yz] = self.stretch;
        [xx - self.thermal, yy - self.thermal, zz - self.thermal, 0.5 * xy, 0.5 * xz, 0.5 * yz]
    }
}

/// A packing and what was done with it, as far as it carries load.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    pub packing: i64,
    pub name: String,
    /// How the packing was made, to distinguish packings that were made equally; and whether it was without a direction.
    pub recipe: String,
    pub is_isotropic: bool,
    /// Number of spheres.
    pub spheres: usize,
    /// Factor of its errors of stress and fabric in the training, and weight of the squares of those of the number of contacts. Of
    /// those of conductivities by contacts its root is the weight, so that boxes are met next to the beds that have large weights.
    pub weight: f64,
    pub packed: Point,
    /// The solid fraction of the packing less the mean of its recipe \[-\], see [`set_aside`].
    pub aside: f64,
    pub steps: Vec<Step>,
    /// Whether the path goes on after these steps, and the packing carries no load after the next one.
    pub loses_load: bool,
}

impl Track {
    /// The state number `k`, see [`Step::from`].
    pub fn point(&self, k: usize) -> &Point {
        if k == 0 { &self.packed } else { &self.steps[k - 1].to }
    }

    /// The law's state of the packing, with the solid fraction of its recipe.
    pub fn start(&self, law: &Law) -> State {
        law.start(self.packed.solid - self.aside, self.packed.stress, &self.packed.known())
    }

    /// A state on the path with the solid fraction of this packing instead of that of its recipe.
    pub fn of_packing(&self, state: &State) -> State {
        State { jamming: state.jamming + self.aside, ..*state }
    }

    /// How often the path turns back.
    pub fn turns(&self) -> usize {
        let back = |(k, pair): &(usize, &[Step])| {
            pair[1].from == k + 1 && contraction(&pair[0].strain(), &pair[1].strain()) < 0.0
        };
        self.steps.windows(2).enumerate().filter(back).count()
    }
}

/// Largest strain that is applied in one part.
const SUBSTEP: f64 = 2.5e-4;
const MAX_SUBSTEPS: f64 = 40.0;

/// Takes the mean solid fraction of a recipe for that of its packings. Boxes of a thousand spheres that were made equally jam at solid
/// fractions which scatter, and which tell little of what a box does when it is strained; those of recipes differ by more, and tell it.
pub fn set_aside(tracks: &mut [Track]) {
    let mut recipes: BTreeMap<String, BTreeMap<i64, f64>> = BTreeMap::new();
    for track in tracks.iter() {
        recipes.entry(track.recipe.clone()).or_default().insert(track.packing, track.packed.solid);
    }
    for track in tracks {
        let packings = &recipes[&track.recipe];
        track.aside = track.packed.solid - packings.values().sum::<f64>() / packings.len() as f64;
    }
}

/// The law's states along a track: number k as [`Step::from`].
pub fn follow(law: &Law, track: &Track) -> Vec<State> {
    follow_from(law, track, track.start(law))
}

/// The same where the packing has this state.
pub fn follow_from(law: &Law, track: &Track, packed: State) -> Vec<State> {
    let mut states = vec![packed];
    for step in &track.steps {
        let from = &states[step.from];
        let next = match step.free_axis {
            Some(axis) => given_way(law, from, step, axis),
            None => advanced(law, from, step.thermal, step.stretch),
        };
        states.push(next);
    }
    states
}

/// Evaluations of the law in the search for a strain, and the relative error of the stress from which no more are needed.
const EVALUATIONS: u32 = 60;
const NEAR: f64 = 1e-6;

/// The state after a step in which the cell yields along an axis until it has the stress of the data there, or the nearest that was
/// found. The stress falls with the extension, so two extensions with too much and too little stress are searched for and then drawn
/// together by the rule of Illinois, with bisection where it is slow. The number of substeps is that of the recorded strain: if it depended
/// on the strain that is sought, the stress would jump with it.
fn given_way(law: &Law, from: &State, step: &Step, axis: usize) -> State {
    let target = step.to.stress[axis];
    let substeps = substeps(step.thermal, step.stretch);
    let near = NEAR * target.abs();
    let (mut best, mut least) = (*from, f64::INFINITY);
    let mut missed = |extension: f64| {
        let mut stretch = step.stretch;
        stretch[axis] = extension;
        let state = in_substeps(law, from, step.thermal, stretch, substeps);
        let missed = law.stress(&state)[axis] - target;
        if missed.abs() < least {
            (best, least) = (state, missed.abs());
        }
        missed
    };
    let longest = step.stretch.iter().fold(step.thermal.abs(), |a, b| a.max(b.abs()));
    let first = step.stretch[axis];
    let (mut closed, mut open) = ((first, missed(first)), (first, 0.0));
    open.1 = closed.1;
    let mut width = 0.1 * longest;
    let mut evaluations = EVALUATIONS;
    while evaluations > 0 && (closed.1 < 0.0 || open.1 > 0.0) {
        if closed.1 < 0.0 {
            open = closed;
            closed = (closed.0 - width, missed(closed.0 - width));
        } else {
            closed = open;
            open = (open.0 + width, missed(open.0 + width));
        }
        width *= 2.0;
        evaluations -= 1;
    }
    // Weights of the stresses, less for an end that stays while the other moves twice.
    let (mut weights, mut before, mut closer) = ([1.0, 1.0], f64::INFINITY, None);
    while evaluations > 0 && closed.1.min(-open.1) > near {
        let (high, low) = (weights[0] * closed.1, weights[1] * -open.1);
        let length = open.0 - closed.0;
        let share = if length > 0.5 * before { 0.5 } else { high / (high + low) };
        before = length;
        let middle = closed.0 + share * length;
        let stress = missed(middle);
        let end = usize::from(stress <= 0.0);
        *[&mut closed, &mut open][end] = (middle, stress);
        weights[end] = 1.0;
        weights[1 - end] *= if closer == Some(end) { 0.5 } else { 1.0 };
        closer = Some(end);
        evaluations -= 1;
    }
    best
}

/// In how many substeps a strain is applied.
pub fn substeps(thermal: f64, stretch: Tensor) -> f64 {
    let largest = stretch.iter().fold(thermal.abs(), |a, b| a.max(b.abs()));
    (largest / SUBSTEP).ceil().clamp(1.0, MAX_SUBSTEPS)
}

/// The state after a straight line of strain, in as many substeps as it is long.
pub fn advanced(law: &Law, state: &State, thermal: f64, stretch: Tensor) -> State {
    in_substeps(law, state, thermal, stretch, substeps(thermal, stretch))
}

/// The same in so many substeps.
fn in_substeps(law: &Law, state: &State, thermal: f64, stretch: Tensor, substeps: f64) -> State {
    (0..substeps as u32).fold(*state, |state, part| {
        let of = |whole: f64| whole / (substeps + whole * f64::from(part));
        let [xx, yy, zz, xy, xz, yz] = stretch.map(of);
        // What is above the diagonal turns the box by half of the shear.
        let half = rotation([0.25 * -yz, 0.25 * xz, 0.25 * -xy]);
        law.advanced(&state, &Strain { thermal: of(thermal), cell: [xx, yy, zz, xy, xz, yz] }, &half)
    })
}
