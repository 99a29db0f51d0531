//! Damping and symplectic Euler (Eqs. 3 and 4) for consecutive discs.

use super::lanes::DiscLanes;
use crate::disc::Columns;
use crate::disc::Disc;
use crate::forces::Load;
use crate::law::damping_scale;
use msdd_engine::Simd;
#[cfg(target_arch = "x86_64")]
use msdd_engine::kernel::{Avx2, Avx512};
use msdd_engine::vector::larger;

/// How the discs move in one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    /// μ of Table 1.
    pub damping: f64,
    /// Factor on the velocities of discs without contact force (drag); 1 leaves them undamped, as Table 1 does.
    pub keep_free: f64,
    /// Δt [s].
    pub dt: f64,
}

/// Advances velocities, then positions, by one step. Returns the square of the largest speed [m²/s²]; NaN when any
/// speed is NaN.
pub(crate) fn advance(simd: Simd, motion: Motion, discs: &mut [Disc], loads: &[Load]) -> f64 {
    assert!(loads.len() == discs.len() && simd.available());
    let count = discs.len();
    let (discs, loads) = (discs.as_mut_ptr(), loads.as_ptr());
    // SAFETY: the machine has the instruction set; both slices have `count` elements.
    unsafe {
        match simd {
            Simd::Scalar => motion.advance::<f64>(discs, loads, count),
            #[cfg(target_arch = "x86_64")]
            Simd::Avx2 => motion.advance_avx2(discs, loads, count),
            #[cfg(target_arch = "x86_64")]
            Simd::Avx512 => motion.advance_avx512(discs, loads, count),
            #[cfg(not(target_arch = "x86_64"))]
            _ => unreachable!("not available on this machine"),
        }
    }
}

impl Motion {
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    unsafe fn advance_avx2(self, discs: *mut Disc, loads: *const Load, count: usize) -> f64 {
        unsafe { self.advance::<Avx2>(discs, loads, count) }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512dq")]
    unsafe fn advance_avx512(self, discs: *mut Disc, loads: *const Load, count: usize) -> f64 {
        unsafe { self.advance::<Avx512>(discs, loads, count) }
    }

    #[inline(always)]
    unsafe fn advance<V: DiscLanes>(self, discs: *mut Disc, loads: *const Load, count: usize) -> f64 {
        unsafe {
            let groups = count / V::LANES * V::LANES;
            // The maximum over the lanes ignores NaN but the sum keeps it, so both are taken.
            let (mut largest, mut sum) = (V::splat(0.0), V::splat(0.0));
            for k in (0..groups).step_by(V::LANES) {
                let speed2 = self.advance_group::<V>(discs.add(k), loads.add(k));
                (largest, sum) = (speed2.max(largest), sum + speed2);
            }
            let (mut lanes, mut sums) = ([0.0; 8], [0.0; 8]);
            largest.write(lanes.as_mut_ptr());
            sum.write(sums.as_mut_ptr());
            let unknown = sums.iter().any(|sum: &f64| sum.is_nan());
            let mut result = if unknown { f64::NAN } else { lanes.into_iter().fold(0.0, larger) };
            for k in groups..count {
                result = larger(result, self.advance_group::<f64>(discs.add(k), loads.add(k)));
            }
            result
        }
    }

    /// Returns the squares of the speeds.
    #[inline(always)]
    unsafe fn advance_group<V: DiscLanes>(self, discs: *mut Disc, loads: *const Load) -> V {
        unsafe {
            let [x, y, radius, vx, vy, spin, mass, temperature]: Columns<V> = V::read_discs(discs);
            let [fx, fy, torque, _] = V::read_loads(loads);
            let dt = V::splat(self.dt);
            let force2 = fx * fx + fy * fy;
            let scale = damping_scale(V::splat(self.damping), force2, vx * vx + vy * vy);
            let touched = force2.greater(V::splat(0.0));
            let keep = V::select(touched, V::splat(1.0), V::splat(self.keep_free));
            // Moment of inertia I = m r²/2 with the current radius. One division serves both 1/m and 1/I.
            let radius2 = radius * radius;
            let half_per_inertia = dt / (mass * radius2);
            let per_mass = half_per_inertia * radius2;
            let vx = keep * (vx + per_mass * (fx - scale * vx));
            let vy = keep * (vy + per_mass * (fy - scale * vy));
            let spin = keep * (spin + V::splat(2.0) * half_per_inertia * torque);
            let (x, y) = (x + dt * vx, y + dt * vy);
            V::write_discs([x, y, radius, vx, vy, spin, mass, temperature], discs);
            vx * vx + vy * vy
        }
    }
}
