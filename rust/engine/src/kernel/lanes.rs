//! Loading and storing vectors of f64 (one number per lane, one lane per grain or pair), and the implementation with one
//! lane.

use crate::vector::Vector;

/// Vectors from and to memory.
///
/// # Safety
/// The methods may be called only on a machine with the instruction set. They are the only way to make a value of the
/// type, so whoever has a value may use its arithmetic safely. Pointers must be valid for LANES elements.
#[allow(clippy::missing_safety_doc)] // stated once, above
pub trait Lanes: Vector {
    const LANES: usize;
    unsafe fn splat(value: f64) -> Self;
    unsafe fn read(from: *const f64) -> Self;
    unsafe fn write(self, to: *mut f64);
}

impl Lanes for f64 {
    const LANES: usize = 1;

    #[inline(always)]
    unsafe fn splat(value: f64) -> Self {
        value
    }
    #[inline(always)]
    unsafe fn read(from: *const f64) -> Self {
        unsafe { *from }
    }
    #[inline(always)]
    unsafe fn write(self, to: *mut f64) {
        unsafe { *to = self }
    }
}
