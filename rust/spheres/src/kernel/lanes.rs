//! Loading and storing groups of spheres and of loads, one sphere per lane, and the implementation with one lane.

use crate::forces::Load;
use crate::sphere::{Columns, Sphere};
use msdd_engine::kernel::Lanes;

/// Groups of spheres from and to memory.
///
/// # Safety
/// As for [`Lanes`].
#[allow(clippy::missing_safety_doc)] // stated once, above
pub(crate) trait SphereLanes: Lanes {
    /// Fields of the spheres with numbers `index[0..LANES]`. The address `spheres` may lie outside of the array;
    /// `spheres` + index must lie inside.
    unsafe fn gather(spheres: *const Sphere, index: *const u32) -> Columns<Self>;
    /// Fields of LANES consecutive spheres.
    unsafe fn read_spheres(spheres: *const Sphere) -> Columns<Self>;
    /// Writes position and velocities of LANES consecutive spheres; the other columns must be those that were read.
    unsafe fn write_spheres(columns: Columns<Self>, spheres: *mut Sphere);
    /// Columns of force and torque of LANES consecutive loads.
    unsafe fn read_loads(loads: *const Load) -> [[Self; 3]; 2];
    /// `columns` are the force on j, the torque on i and that on j. Lane by lane, in order: force and torque of j are
    /// added to loads[j], then the force is subtracted from loads[i] and the torque of i added to it.
    unsafe fn scatter(loads: *mut Load, i: *const u32, j: *const u32, columns: [[Self; 3]; 3]);
}

impl SphereLanes for f64 {
    #[inline(always)]
    unsafe fn gather(spheres: *const Sphere, index: *const u32) -> Columns<Self> {
        unsafe { Self::read_spheres(spheres.wrapping_add(*index as usize)) }
    }
    #[inline(always)]
    unsafe fn read_spheres(spheres: *const Sphere) -> Columns<Self> {
        let sphere = unsafe { &*spheres };
        let ([x, y, z], [vx, vy, vz]) = (sphere.position, sphere.velocity);
        let [wx, wy, wz] = sphere.angular_velocity;
        [x, y, z, sphere.radius, vx, vy, vz, sphere.mass, wx, wy, wz]
    }
    #[inline(always)]
    unsafe fn write_spheres(columns: Columns<Self>, spheres: *mut Sphere) {
        let sphere = unsafe { &mut *spheres };
        let [x, y, z, _, vx, vy, vz, _, wx, wy, wz] = columns;
        sphere.position = [x, y, z];
        sphere.velocity = [vx, vy, vz];
        sphere.angular_velocity = [wx, wy, wz];
    }
    #[inline(always)]
    unsafe fn read_loads(loads: *const Load) -> [[Self; 3]; 2] {
        let load = unsafe { &*loads };
        [load.force, load.torque]
    }
    #[inline(always)]
    unsafe fn scatter(loads: *mut Load, i: *const u32, j: *const u32, columns: [[Self; 3]; 3]) {
        let [force, of_i, of_j] = columns;
        let on_j = unsafe { &mut *loads.wrapping_add(*j as usize) };
        for k in 0..3 {
            on_j.force[k] += force[k];
            on_j.torque[k] += of_j[k];
        }
        let on_i = unsafe { &mut *loads.wrapping_add(*i as usize) };
        for k in 0..3 {
            on_i.force[k] -= force[k];
            on_i.torque[k] += of_i[k];
        }
    }
}
