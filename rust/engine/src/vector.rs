//! Arithmetic on one or several grains at a time: the trait in which the contact laws are written, and its
//! implementation for a single number.

use std::ops::{Add, Div, Mul, Sub};

/// Arithmetic on vectors of f64: IEEE operations lane by lane, never fused.
pub trait Vector:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    type Mask: Copy;
    /// The same value in all lanes.
    fn like(self, value: f64) -> Self;
    fn sqrt(self) -> Self;
    /// The larger one; `other` when they are equal or one is NaN (as x86's maxpd). See [`larger`] for one that keeps
    /// NaN.
    fn max(self, other: Self) -> Self;
    fn min(self, other: Self) -> Self;
    fn greater(self, other: Self) -> Self::Mask;
    fn any(mask: Self::Mask) -> bool;
    /// `this` where the mask is set, `other` elsewhere.
    fn select(mask: Self::Mask, this: Self, other: Self) -> Self;
}

impl Vector for f64 {
    type Mask = bool;

    #[inline(always)]
    fn like(self, value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    #[inline(always)]
    fn greater(self, other: Self) -> bool {
        self > other
    }
    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn select(mask: bool, this: Self, other: Self) -> Self {
        if mask { this } else { other }
    }
}

/// The larger of two numbers; NaN when either is NaN. [`f64::max`] ignores NaN, which would turn an unknown motion into
/// a valid bound.
pub fn larger(a: f64, b: f64) -> f64 {
    if a > b || a.is_nan() { a } else { b }
}
