//! Symplectic Euler for consecutive spheres.

use super::lanes::SphereLanes;
use crate::forces::Load;
use crate::space::{dot, plus, scaled};
use crate::sphere::{Columns, Sphere};
use msdd_engine::Simd;
#[cfg(target_arch = "x86_64")]
use msdd_engine::kernel::{Avx2, Avx512};
use msdd_engine::vector::larger;

/// How the spheres move in one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    /// g [m/s²].
    pub gravity: [f64; 3],
    /// Factor on all velocities (drag).
    pub keep: f64,
    /// Δt [s].
    pub dt: f64,
}

/// Advances velocities, then positions, by one step. Returns the square of the largest speed [m²/s²]; NaN when any
/// speed is NaN.
pub(crate) fn advance(simd: Simd, motion: Motion, spheres: &mut [Sphere], loads: &[Load]) -> f64 {
    assert!(loads.len() == spheres.len() && simd.available());
    let count = spheres.len();
    let (spheres, loads) = (spheres.as_mut_ptr(), loads.as_ptr());
    // SAFETY: the machine has the instruction set; both slices have `count` elements.
    unsafe {
        match simd {
            Simd::Scalar => motion.advance::<f64>(spheres, loads, count),
            #[cfg(target_arch = "x86_64")]
            Simd::Avx2 => motion.advance_avx2(spheres, loads, count),
            #[cfg(target_arch = "x86_64")]
            Simd::Avx512 => motion.advance_avx512(spheres, loads, count),
            #[cfg(not(target_arch = "x86_64"))]
            _ => unreachable!("not available on this machine"),
        }
    }
}

impl Motion {
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    unsafe fn advance_avx2(self, spheres: *mut Sphere, loads: *const Load, count: usize) -> f64 {
        unsafe { self.advance::<Avx2>(spheres, loads, count) }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512dq")]
    unsafe fn advance_avx512(self, spheres: *mut Sphere, loads: *const Load, count: usize) -> f64 {
        unsafe { self.advance::<Avx512>(spheres, loads, count) }
    }

    #[inline(always)]
    unsafe fn advance<V: SphereLanes>(self, spheres: *mut Sphere, loads: *const Load, count: usize) -> f64 {
        unsafe {
            let groups = count / V::LANES * V::LANES;
            // The maximum over the lanes ignores NaN but the sum keeps it, so both are taken.
            let (mut largest, mut sum) = (V::splat(0.0), V::splat(0.0));
            for k in (0..groups).step_by(V::LANES) {
                let speed2 = self.advance_group::<V>(spheres.add(k), loads.add(k));
                (largest, sum) = (speed2.max(largest), sum + speed2);
            }
            let (mut lanes, mut sums) = ([0.0; 8], [0.0; 8]);
            largest.write(lanes.as_mut_ptr());
            sum.write(sums.as_mut_ptr());
            let unknown = sums.iter().any(|sum: &f64| sum.is_nan());
            let mut result = if unknown { f64::NAN } else { lanes.into_iter().fold(0.0, larger) };
            for k in groups..count {
                result = larger(result, self.advance_group::<f64>(spheres.add(k), loads.add(k)));
            }
            result
        }
    }

    /// Returns the squares of the speeds.
    #[inline(always)]
    unsafe fn advance_group<V: SphereLanes>(self, spheres: *mut Sphere, loads: *const Load) -> V {
        unsafe {
            let [x, y, z, radius, vx, vy, vz, mass, wx, wy, wz]: Columns<V> = V::read_spheres(spheres);
            let [force, torque] = V::read_loads(loads);
            let (dt, keep) = (V::splat(self.dt), V::splat(self.keep));
            // I = 2/5 m r² with the current radius. One division serves both 1/m and 1/I.
            let radius2 = radius * radius;
            let per_inertia = dt / (mass * radius2);
            let per_mass = per_inertia * radius2;
            let [gx, gy, gz] = self.gravity;
            let falling = [V::splat(gx), V::splat(gy), V::splat(gz)];
            let velocity = plus(plus([vx, vy, vz], per_mass, force), dt, falling);
            let [vx, vy, vz] = scaled(keep, velocity);
            let [wx, wy, wz] = scaled(keep, plus([wx, wy, wz], V::splat(2.5) * per_inertia, torque));
            let [x, y, z] = plus([x, y, z], dt, [vx, vy, vz]);
            V::write_spheres([x, y, z, radius, vx, vy, vz, mass, wx, wy, wz], spheres);
            dot([vx, vy, vz], [vx, vy, vz])
        }
    }
}
