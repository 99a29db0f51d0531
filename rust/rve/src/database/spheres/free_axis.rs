//! A box that yields along one axis, so that the stress along that axis stays as it was packed.
//!
//! How far it yields in an increment is not known before: it is chosen from a guess of its stiffness, and from how much earlier
//! increments missed the stress. So the stress stays within some per cent of what it should be, and each row of the database has the strain
//! that was made.

use crate::spheres::Strain;
use msdd_beds::averages::stress;
use msdd_spheres::Simulation;

/// p/E* over v^(3/2) of usual packings, with the compression v.
const REFERENCE_BULK: f64 = 0.06;
/// Stiffness along an axis over dp/dv.
const ALONG: f64 = 1.6;
/// How far a box yields over how far it closes along each of the two other axes, at first; and the largest.
const FIRST: f64 = 1.2;
const MOST: f64 = 4.0;
/// Share of a difference of the stress by which that ratio is changed.
const LEARNED: f64 = 0.3;

/// What is known of how far the box yields.
pub(super) struct FreeAxis {
    /// Stress of the packed state.
    packed: [f64; 3],
    ratio: f64,
    /// Closing along the other axes by the last increment.
    closed: f64,
}

impl FreeAxis {
    pub(super) fn of(packed: &Simulation) -> Self {
        Self { packed: along_axes(packed), ratio: FIRST, closed: 0.0 }
    }

    /// Extension along the axis in an increment from this state, which closes the two other axes by `step`.
    pub(super) fn next(&mut self, simulation: &Simulation, axis: usize, step: &Strain) -> f64 {
        let now = along_axes(simulation);
        let pressure = (now.iter().sum::<f64>() / 3.0).max(f64::MIN_POSITIVE);
        let compression = libm::pow(pressure / REFERENCE_BULK, 2.0 / 3.0);
        let missing = (now[axis] - self.packed[axis]) * compression / (ALONG * 1.5 * pressure);
        if self.closed != 0.0 {
            self.ratio = (self.ratio + LEARNED * missing / self.closed).clamp(0.0, MOST);
        }
        self.closed = -0.5 * (step.stretch.iter().take(3).sum::<f64>() - step.stretch[axis]);
        let most = MOST * self.closed.abs();
        (self.ratio * self.closed + missing).clamp(-most, most)
    }
}

/// Stress along x, y and z over E*, compression positive.
fn along_axes(simulation: &Simulation) -> [f64; 3] {
    let stress = stress(simulation);
    std::array::from_fn(|axis| stress[axis][axis])
}
