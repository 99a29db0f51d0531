//! Numbers in which the law is evaluated: values of a block of cells, or values with their derivatives by the strain, so
//! that the tangent is the derivative of exactly the stress that is answered.

use crate::kernel::vector::Arithmetic;
use std::ops::{Add, Mul, Sub};

/// A number of each cell of a block.
pub trait Number: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    type Values: Arithmetic;

    /// Values that do not depend on the strain.
    fn of(values: Self::Values) -> Self;
    fn value(self) -> Self::Values;
    /// Of values above 0.
    fn sqrt(self) -> Self;
    /// 1/self. Divisions are the slowest operations, so they are visible in the formulas.
    fn inverse(self) -> Self;
    /// `this` where `self` > `than`, `other` elsewhere.
    fn where_greater(self, than: Self, this: Self, other: Self) -> Self;

    /// The same value in all cells.
    #[inline(always)]
    fn all(value: f64) -> Self {
        Self::of(Self::Values::all(value))
    }

    fn times(self, factor: f64) -> Self;
    fn plus(self, addend: f64) -> Self;
}

/// Values alone.
#[derive(Clone, Copy)]
pub struct Plain<V>(pub V);

/// Values and their derivatives by three strains.
#[derive(Clone, Copy)]
pub struct Dual<V> {
    pub value: V,
    pub by: [V; 3],
}

impl<V: Arithmetic> Dual<V> {
    /// A strain itself: its derivative by strain number `k` is 1.
    #[inline(always)]
    pub fn strain(value: V, k: usize) -> Self {
        let mut by = [V::zero(); 3];
        by[k] = V::all(1.0);
        Self { value, by }
    }

    /// f(self), with the value and the derivative of f.
    #[inline(always)]
    fn chain(self, value: V, derivative: V) -> Self {
        let [a, b, c] = self.by;
        Self { value, by: [a * derivative, b * derivative, c * derivative] }
    }

    #[inline(always)]
    fn with(self, other: Self, value: V, derivatives: [V; 2]) -> Self {
        let ([a, b, c], [d, e, f], [own, others]) = (self.by, other.by, derivatives);
        Self { value, by: [a.fused(own, d * others), b.fused(own, e * others), c.fused(own, f * others)] }
    }
}

impl<V: Arithmetic> Number for Plain<V> {
    type Values = V;

    #[inline(always)]
    fn of(values: V) -> Self {
        Self(values)
    }
    #[inline(always)]
    fn value(self) -> V {
        self.0
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn inverse(self) -> Self {
        Self(V::all(1.0) / self.0)
    }
    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        Self(self.0 * V::all(factor))
    }
    #[inline(always)]
    fn plus(self, addend: f64) -> Self {
        Self(self.0 + V::all(addend))
    }
    #[inline(always)]
    fn where_greater(self, than: Self, this: Self, other: Self) -> Self {
        Self(self.0.where_greater(than.0, this.0, other.0))
    }
}

impl<V: Arithmetic> Number for Dual<V> {
    type Values = V;

    #[inline(always)]
    fn of(values: V) -> Self {
        Self { value: values, by: [V::zero(); 3] }
    }
    #[inline(always)]
    fn value(self) -> V {
        self.value
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, V::all(0.5) / root)
    }
    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        let factor = V::all(factor);
        self.chain(self.value * factor, factor)
    }
    #[inline(always)]
    fn plus(self, addend: f64) -> Self {
        Self { value: self.value + V::all(addend), ..self }
    }
    #[inline(always)]
    fn inverse(self) -> Self {
        let inverse = V::all(1.0) / self.value;
        self.chain(inverse, V::zero() - inverse * inverse)
    }
    #[inline(always)]
    fn where_greater(self, than: Self, this: Self, other: Self) -> Self {
        let (a, b) = (self.value, than.value);
        Self {
            value: a.where_greater(b, this.value, other.value),
            by: [
                a.where_greater(b, this.by[0], other.by[0]),
                a.where_greater(b, this.by[1], other.by[1]),
                a.where_greater(b, this.by[2], other.by[2]),
            ],
        }
    }
}

macro_rules! plain {
    ($name:ident, $function:ident, $symbol:tt) => {
        impl<V: Arithmetic> $name for Plain<V> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(self.0 $symbol other.0)
            }
        }
    };
}
plain!(Add, add, +);
plain!(Sub, sub, -);
plain!(Mul, mul, *);

impl<V: Arithmetic> Add for Dual<V> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.by, other.by);
        Self { value: self.value + other.value, by: [a + d, b + e, c + f] }
    }
}

impl<V: Arithmetic> Sub for Dual<V> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        let ([a, b, c], [d, e, f]) = (self.by, other.by);
        Self { value: self.value - other.value, by: [a - d, b - e, c - f] }
    }
}

impl<V: Arithmetic> Mul for Dual<V> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(other, self.value * other.value, [other.value, self.value])
    }
}
