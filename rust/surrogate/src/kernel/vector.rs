//! A block of cells, arithmetic on it, and its portable implementation.

use std::ops::{Add, Div, Mul, Sub};

/// Cells in a block. They fill two AVX-512 registers of f64, so that the chains of dependent operations of the two
/// overlap.
pub const LANES: usize = 16;

/// One quantity of a block of cells.
pub type Lanes = [f64; LANES];

/// One quantity of a block of cells in registers. Every operation acts on each lane separately, rounds as IEEE 754
/// prescribes, and gives the same bits in all implementations.
pub trait Vector:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    fn read(lanes: &Lanes) -> Self;
    fn write(self, lanes: &mut Lanes);
    /// The same value in all lanes.
    fn all(value: f64) -> Self;
    /// self · factor + addend, rounded once.
    fn fused(self, factor: Self, addend: Self) -> Self;
    fn sqrt(self) -> Self;
    fn abs(self) -> Self;
    fn copysign(self, sign: Self) -> Self;
    /// The larger one; `other` when they are equal.
    fn at_least(self, other: Self) -> Self;
    /// The smaller one; `other` when they are equal.
    fn at_most(self, other: Self) -> Self;
    /// 2^n, where the integer n stands in the low bits of the number's bit pattern.
    fn power_of_low_bits(self) -> Self;
    /// `this` where `self` > `than`, `other` elsewhere.
    fn where_greater(self, than: Self, this: Self, other: Self) -> Self;

    #[inline(always)]
    fn zero() -> Self {
        Self::all(0.0)
    }

    /// The value limited to [low, high].
    #[inline(always)]
    fn within(self, low: Self, high: Self) -> Self {
        self.at_least(low).at_most(high)
    }
}

/// The implementation for any machine.
#[derive(Clone, Copy)]
pub struct Portable(Lanes);

impl Portable {
    #[inline(always)]
    fn of(value: impl Fn(usize) -> f64) -> Self {
        Self(std::array::from_fn(value))
    }

    /// The value of the first lane.
    pub fn into_first(self) -> f64 {
        self.0[0]
    }
}

macro_rules! operator {
    ($name:ident, $function:ident, $symbol:tt) => {
        impl $name for Portable {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self::of(|k| self.0[k] $symbol other.0[k])
            }
        }
    };
}
operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl Vector for Portable {
    #[inline(always)]
    fn read(lanes: &Lanes) -> Self {
        Self(*lanes)
    }
    #[inline(always)]
    fn write(self, lanes: &mut Lanes) {
        *lanes = self.0;
    }
    #[inline(always)]
    fn all(value: f64) -> Self {
        Self([value; LANES])
    }
    #[inline(always)]
    fn fused(self, factor: Self, addend: Self) -> Self {
        Self::of(|k| self.0[k].mul_add(factor.0[k], addend.0[k]))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.map(f64::abs))
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self::of(|k| self.0[k].copysign(sign.0[k]))
    }
    #[inline(always)]
    fn at_least(self, other: Self) -> Self {
        Self::of(|k| if self.0[k] > other.0[k] { self.0[k] } else { other.0[k] })
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> Self {
        Self::of(|k| if self.0[k] < other.0[k] { self.0[k] } else { other.0[k] })
    }
    #[inline(always)]
    fn power_of_low_bits(self) -> Self {
        Self(self.0.map(|v| f64::from_bits((v.to_bits() << 52).wrapping_add(1023 << 52))))
    }
    #[inline(always)]
    fn where_greater(self, than: Self, this: Self, other: Self) -> Self {
        Self::of(|k| if self.0[k] > than.0[k] { this.0[k] } else { other.0[k] })
    }
}
