//! Loading and storing groups of discs and of loads, one disc per lane, and the implementation with one lane.

use crate::disc::{Columns, Disc};
use crate::forces::Load;
use msdd_engine::kernel::Lanes;

/// Groups of discs from and to memory.
///
/// # Safety
/// As for [`Lanes`].
#[allow(clippy::missing_safety_doc)] // stated once, above
pub(crate) trait DiscLanes: Lanes {
    /// Fields of the discs with numbers `index[0..LANES]`. The address `discs` may lie outside of the array; `discs` +
    /// index must lie inside.
    unsafe fn gather(discs: *const Disc, index: *const u32) -> Columns<Self>;
    /// Reads or writes the fields of LANES consecutive discs.
    unsafe fn read_discs(discs: *const Disc) -> Columns<Self>;
    unsafe fn write_discs(columns: Columns<Self>, discs: *mut Disc);
    /// Columns fx, fy, torque and padding of LANES consecutive loads.
    unsafe fn read_loads(loads: *const Load) -> [Self; 4];
    /// Lane by lane, in order: loads[j] += (fx, fy, torque_j), then loads[i] −= (fx, fy, torque_i).
    unsafe fn scatter(loads: *mut Load, i: *const u32, j: *const u32, force: [Self; 2], torque: [Self; 2]);
}

impl DiscLanes for f64 {
    #[inline(always)]
    unsafe fn gather(discs: *const Disc, index: *const u32) -> Columns<Self> {
        unsafe { Self::read_discs(discs.wrapping_add(*index as usize)) }
    }
    #[inline(always)]
    unsafe fn read_discs(discs: *const Disc) -> Columns<Self> {
        let d = unsafe { &*discs };
        [d.x, d.y, d.radius, d.vx, d.vy, d.angular_velocity, d.mass, d.temperature]
    }
    #[inline(always)]
    unsafe fn write_discs(columns: Columns<Self>, discs: *mut Disc) {
        let [x, y, radius, vx, vy, angular_velocity, mass, temperature] = columns;
        unsafe { *discs = Disc { x, y, radius, vx, vy, angular_velocity, mass, temperature } }
    }
    #[inline(always)]
    unsafe fn read_loads(loads: *const Load) -> [Self; 4] {
        let load = unsafe { &*loads };
        [load.fx, load.fy, load.torque, 0.0]
    }
    #[inline(always)]
    unsafe fn scatter(loads: *mut Load, i: *const u32, j: *const u32, force: [Self; 2], torque: [Self; 2]) {
        let on_j = unsafe { &mut *loads.wrapping_add(*j as usize) };
        on_j.fx += force[0];
        on_j.fy += force[1];
        on_j.torque += torque[1];
        let on_i = unsafe { &mut *loads.wrapping_add(*i as usize) };
        on_i.fx -= force[0];
        on_i.fy -= force[1];
        on_i.torque -= torque[0];
    }
}
