//! A block of cells, arithmetic on it, and its portable implementation.

use std::ops::{Add, Div, Mul, Sub};

/// Cells in a block. They fill two AVX-512 registers of f64, so that the chains of dependent operations of the two
/// overlap.
pub const LANES: usize = 16;

/// One quantity of a block of cells.
pub type Lanes = [f64; LANES];

/// A part of the work on blocks of cells that is compiled as a function of its own.
pub trait Part {
    /// Does the work. As [`Task::run`](super::Task::run), it and all that it calls must be `#[inline(always)]`.
    fn run(self);
}

/// Defines a function that lets `$apart` do its work as a [`Part`]. It writes what it finds where it is told: a
/// block's numbers are too many to be copied.
macro_rules! part {
    (
        $(#[$about:meta])*
        by $apart:path => fn $name:ident<$life:lifetime, $($generic:ident: $bound:path),*>(
            $($argument:ident: $type:ty),* $(,)?
        ) $body:block
    ) => {
        $(#[$about])*
        #[inline(always)]
        fn $name<$life, $($generic: $bound),*>($($argument: $type),*) {
            struct Work<$life, $($generic: $bound),*>($($type,)* std::marker::PhantomData<(&$life (), $($generic),*)>);
            impl<$life, $($generic: $bound),*> $crate::kernel::vector::Part for Work<$life, $($generic),*> {
                #[inline(always)]
                fn run(self) {
                    let Self($($argument,)* _) = self;
                    $body
                }
            }
            $apart(Work($($argument,)* std::marker::PhantomData::<(&(), $($generic),*)>));
        }
    };
}
pub(crate) use part;

/// Numbers of one cell or of several. Every operation acts on each cell separately, rounds as IEEE 754 prescribes, and gives the
/// same bits in all implementations.
pub trait Arithmetic:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
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
    /// m and n with self = m · 2^n and m from √½ to √2, of numbers from 2^-1021 on.
    fn split(self) -> (Self, Self);
    /// `this` where `self` > `than`, `other` elsewhere.
    fn where_greater(self, than: Self, this: Self, other: Self) -> Self;
    /// Whether `self` > `than` in any cell.
    fn any_greater(self, than: Self) -> bool;
    /// Does a part of the work in a function of its own, which is compiled for the same instruction set. The compiler needs much
    /// longer for one long function than for several short ones.
    fn apart(part: impl Part);

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

/// One quantity of several cells in registers.
pub trait Vector: Arithmetic {
    /// Number of cells.
    const WIDTH: usize;

    /// The first [`Vector::WIDTH`] of some numbers, which are as many at least.
    fn read(lanes: &[f64]) -> Self;
    /// Overwrites those.
    fn write(self, lanes: &mut [f64]);
}

/// What is added to the bits of a number so that their exponent is n + 1023 in [`Arithmetic::split`]: those of 1 less those of √½; and
/// then to the mantissa's bits.
pub(super) const TO_EXPONENT: u64 = 0x3FF0_0000_0000_0000 - ROOT_HALF;
pub(super) const ROOT_HALF: u64 = 0x3FE6_A09E_667F_3BCD;
pub(super) const MANTISSA: u64 = (1 << 52) - 1;
/// The bits of 2^52, in whose low bits an integer stands when it is added; and 2^52 + 1023.
pub(super) const INTEGER: u64 = 0x4330_0000_0000_0000;
pub(super) const INTEGER_AND_BIAS: f64 = 4_503_599_627_370_496.0 + 1023.0;

impl Arithmetic for f64 {
    #[inline(always)]
    fn all(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn fused(self, factor: Self, addend: Self) -> Self {
        self.mul_add(factor, addend)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        f64::copysign(self, sign)
    }
    #[inline(always)]
    fn at_least(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    #[inline(always)]
    fn power_of_low_bits(self) -> Self {
        f64::from_bits((self.to_bits() << 52).wrapping_add(1023 << 52))
    }
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        let bits = self.to_bits().wrapping_add(TO_EXPONENT);
        let mantissa = f64::from_bits((bits & MANTISSA) + ROOT_HALF);
        (mantissa, f64::from_bits((bits >> 52) | INTEGER) - INTEGER_AND_BIAS)
    }
    #[inline(always)]
    fn where_greater(self, than: Self, this: Self, other: Self) -> Self {
        if self > than { this } else { other }
    }
    #[inline(always)]
    fn any_greater(self, than: Self) -> bool {
        self > than
    }
    #[inline(never)]
    fn apart(part: impl Part) {
        part.run();
    }
}

impl Vector for f64 {
    const WIDTH: usize = 1;

    #[inline(always)]
    fn read(lanes: &[f64]) -> Self {
        lanes[0]
    }
    #[inline(always)]
    fn write(self, lanes: &mut [f64]) {
        lanes[0] = self;
    }
}

/// The implementation for any machine. On x86-64, where only processors from before 2013 need it, its longer
/// operations are functions of their own: inlined everywhere they take long to compile.
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
    const WIDTH: usize = LANES;

    #[inline(always)]
    fn read(lanes: &[f64]) -> Self {
        Self::of(|k| lanes[k])
    }
    #[inline(always)]
    fn write(self, lanes: &mut [f64]) {
        lanes[..LANES].copy_from_slice(&self.0);
    }
}

impl Arithmetic for Portable {
    #[inline(always)]
    fn all(value: f64) -> Self {
        Self([value; LANES])
    }
    #[cfg_attr(target_arch = "x86_64", inline(never))]
    #[cfg_attr(not(target_arch = "x86_64"), inline(always))]
    fn fused(self, factor: Self, addend: Self) -> Self {
        Self::of(|k| self.0[k].fused(factor.0[k], addend.0[k]))
    }
    #[cfg_attr(target_arch = "x86_64", inline(never))]
    #[cfg_attr(not(target_arch = "x86_64"), inline(always))]
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.map(f64::abs))
    }
    #[cfg_attr(target_arch = "x86_64", inline(never))]
    #[cfg_attr(not(target_arch = "x86_64"), inline(always))]
    fn copysign(self, sign: Self) -> Self {
        Self::of(|k| self.0[k].copysign(sign.0[k]))
    }
    #[inline(always)]
    fn at_least(self, other: Self) -> Self {
        Self::of(|k| self.0[k].at_least(other.0[k]))
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> Self {
        Self::of(|k| self.0[k].at_most(other.0[k]))
    }
    #[cfg_attr(target_arch = "x86_64", inline(never))]
    #[cfg_attr(not(target_arch = "x86_64"), inline(always))]
    fn power_of_low_bits(self) -> Self {
        Self(self.0.map(Arithmetic::power_of_low_bits))
    }
    #[cfg_attr(target_arch = "x86_64", inline(never))]
    #[cfg_attr(not(target_arch = "x86_64"), inline(always))]
    fn split(self) -> (Self, Self) {
        let both = self.0.map(Arithmetic::split);
        (Self::of(|k| both[k].0), Self::of(|k| both[k].1))
    }
    #[cfg_attr(target_arch = "x86_64", inline(never))]
    #[cfg_attr(not(target_arch = "x86_64"), inline(always))]
    fn where_greater(self, than: Self, this: Self, other: Self) -> Self {
        Self::of(|k| self.0[k].where_greater(than.0[k], this.0[k], other.0[k]))
    }
    #[cfg_attr(target_arch = "x86_64", inline(never))]
    #[cfg_attr(not(target_arch = "x86_64"), inline(always))]
    fn any_greater(self, than: Self) -> bool {
        self.0.iter().zip(&than.0).any(|(a, b)| a > b)
    }
    #[inline(never)]
    fn apart(part: impl Part) {
        part.run();
    }
}
