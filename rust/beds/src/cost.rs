//! How long a bed whose walls move takes to compute, by an estimate before it begins.

use crate::case::BedCase;

/// Processor time of a step of one sphere \[s\], on one core. From 400 spheres and 216 000 steps, 8.3 core-seconds.
const STEP: f64 = 1e-7;
/// Time in which a poured bed comes to rest after its grains have come down, over √(d/g); steps of the lid and of the hardening over
/// those of the pouring; steps of an interval over the least that it has. As in the beds of cases/beds.
const REST: f64 = 15.0;
const LID: f64 = 0.5;
const INTERVAL: f64 = 1.5;

/// An estimate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cost {
    /// Of DEM, from pouring to the end.
    pub steps: f64,
    /// \[s\]
    pub seconds: f64,
}

/// The cost of one packing of a bed.
pub fn estimate(scene: &BedCase, threads: usize) -> Cost {
    let (grains, gravity) = (&scene.grains, scene.container.gravity);
    let pouring = grains.pouring(scene.seed, scene.vessel(), gravity, threads);
    let down = pouring.fall() + REST * (grains.diameter / gravity).sqrt();
    let heated = INTERVAL * scene.time.steps as f64 * scene.time.end / scene.time.interval;
    let steps = (1.0 + LID) * down / pouring.step() + heated;
    Cost { steps, seconds: steps * grains.number as f64 * STEP / threads.max(1) as f64 }
}
