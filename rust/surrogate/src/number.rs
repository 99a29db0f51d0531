//! Numbers in which the models are evaluated: values of one cell or of several, or values with their derivatives by strains, so
//! that the tangent is the derivative of exactly the stress that is answered.

use crate::kernel::elementary;
use crate::kernel::vector::{Arithmetic, Part};
use std::ops::{Add, Mul, Sub};

pub trait Number: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    type Values: Arithmetic;

    /// Values that do not depend on the strain.
    fn of(values: Self::Values) -> Self;
    fn value(self) -> Self::Values;
    /// f(self), from values and derivatives of f there.
    fn chain(self, value: Self::Values, derivative: Self::Values) -> Self;
    /// The values with another added, whose derivative is 0.
    fn plus_values(self, addend: Self::Values) -> Self;
    /// `this` where `self` > `than`, `other` elsewhere.
    fn where_above(self, than: Self, this: Self, other: Self) -> Self;
    /// Does a part of the work, where derivatives make it long by [`Arithmetic::apart`].
    fn apart(part: impl Part);

    /// The same value in all cells.
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self::of(Self::Values::all(value))
    }
    #[inline(always)]
    fn plus(self, addend: f64) -> Self {
        self.plus_values(Self::Values::all(addend))
    }
    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        self.by(Self::Values::all(factor))
    }
    #[inline(always)]
    fn by(self, factor: Self::Values) -> Self {
        self.chain(self.value() * factor, factor)
    }
    #[inline(always)]
    fn squared(self) -> Self {
        self.chain(self.value() * self.value(), self.value() + self.value())
    }
    /// Of values above 0.
    #[inline(always)]
    fn root(self) -> Self {
        let root = self.value().sqrt();
        self.chain(root, Self::Values::all(0.5) / root)
    }
    #[inline(always)]
    fn inverse(self) -> Self {
        let inverse = Self::Values::all(1.0) / self.value();
        self.chain(inverse, Self::Values::zero() - inverse * inverse)
    }
    /// Of values from -700 to 700; beyond, it is that of these.
    #[inline(always)]
    fn exp(self) -> Self {
        let value = elementary::exp(self.value());
        self.chain(value, value)
    }
    /// Of values above 1e-307.
    #[inline(always)]
    fn ln(self) -> Self {
        let value = self.value();
        self.chain(elementary::ln(value), Self::Values::all(1.0) / value)
    }
    /// Of values above 1e-307.
    #[inline(always)]
    fn power(self, exponent: f64) -> Self {
        self.ln().times(exponent).exp()
    }
    #[inline(always)]
    fn not_below(self, least: f64) -> Self {
        self.not_below_number(Self::constant(least))
    }
    #[inline(always)]
    fn not_above(self, most: f64) -> Self {
        self.not_above_number(Self::constant(most))
    }
    /// The larger one; `least` when they are equal.
    #[inline(always)]
    fn not_below_number(self, least: Self) -> Self {
        self.where_above(least, self, least)
    }
    /// The smaller one; `most` when they are equal.
    #[inline(always)]
    fn not_above_number(self, most: Self) -> Self {
        most.where_above(self, self, most)
    }
}

impl<V: Arithmetic> Number for V {
    type Values = V;

    #[inline(always)]
    fn of(values: V) -> Self {
        values
    }
    #[inline(always)]
    fn value(self) -> V {
        self
    }
    #[inline(always)]
    fn chain(self, value: V, _: V) -> Self {
        value
    }
    #[inline(always)]
    fn plus_values(self, addend: V) -> Self {
        self + addend
    }
    #[inline(always)]
    fn where_above(self, than: Self, this: Self, other: Self) -> Self {
        self.where_greater(than, this, other)
    }
    #[inline(always)]
    fn apart(part: impl Part) {
        part.run();
    }
}

/// An array of what a loop gives. A closure would not always be compiled for the instruction set of its caller.
macro_rules! each {
    ($k:ident => $of:expr) => {{
        let mut all = [V::zero(); D];
        for $k in 0..D {
            all[$k] = $of;
        }
        all
    }};
}

/// Values and their derivatives by the first `D` strains.
#[derive(Clone, Copy, Debug)]
pub struct Dual<V, const D: usize> {
    pub value: V,
    pub by: [V; D],
}

impl<V: Arithmetic, const D: usize> Dual<V, D> {
    /// A strain itself: its derivative by strain number `k` is 1.
    #[inline(always)]
    pub fn strain(value: V, k: usize) -> Self {
        let mut by = [V::zero(); D];
        by[k] = V::all(1.0);
        Self { value, by }
    }
}

impl<V: Arithmetic, const D: usize> Number for Dual<V, D> {
    type Values = V;

    #[inline(always)]
    fn of(values: V) -> Self {
        Self { value: values, by: [V::zero(); D] }
    }
    #[inline(always)]
    fn value(self) -> V {
        self.value
    }
    #[inline(always)]
    fn chain(self, value: V, derivative: V) -> Self {
        Self { value, by: each!(k => self.by[k] * derivative) }
    }
    #[inline(always)]
    fn plus_values(self, addend: V) -> Self {
        Self { value: self.value + addend, ..self }
    }
    #[inline(always)]
    fn where_above(self, than: Self, this: Self, other: Self) -> Self {
        let (a, b) = (self.value, than.value);
        Self {
            value: a.where_greater(b, this.value, other.value),
            by: each!(k => a.where_greater(b, this.by[k], other.by[k])),
        }
    }
    #[inline(always)]
    fn apart(part: impl Part) {
        V::apart(part);
    }
}

impl<V: Arithmetic, const D: usize> Add for Dual<V, D> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, by: each!(k => self.by[k] + other.by[k]) }
    }
}

impl<V: Arithmetic, const D: usize> Sub for Dual<V, D> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, by: each!(k => self.by[k] - other.by[k]) }
    }
}

impl<V: Arithmetic, const D: usize> Mul for Dual<V, D> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            by: each!(k => self.by[k].fused(other.value, other.by[k] * self.value)),
        }
    }
}
