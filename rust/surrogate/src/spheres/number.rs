//! Numbers in which the law is evaluated: values, or values with their derivatives by the six strains, so that the tangent
//! is the derivative of exactly the stress that is answered.

use std::ops::{Add, Mul, Sub};

/// Number of strains by which is differentiated.
const STRAINS: usize = 6;

pub trait Number: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// A value that does not depend on the strain.
    fn of(value: f64) -> Self;
    fn value(self) -> f64;
    /// f(self), from value and derivative of f there.
    fn chain(self, value: f64, derivative: f64) -> Self;

    fn plus(self, addend: f64) -> Self {
        self.chain(self.value() + addend, 1.0)
    }
    fn times(self, factor: f64) -> Self {
        self.chain(self.value() * factor, factor)
    }
    fn squared(self) -> Self {
        self.chain(self.value() * self.value(), 2.0 * self.value())
    }
    /// Of values above 0.
    fn sqrt(self) -> Self {
        let root = self.value().sqrt();
        self.chain(root, 0.5 / root)
    }
    fn inverse(self) -> Self {
        let inverse = 1.0 / self.value();
        self.chain(inverse, -inverse * inverse)
    }
    fn exp(self) -> Self {
        let value = libm::exp(self.value());
        self.chain(value, value)
    }
    /// Of values above 0.
    fn ln(self) -> Self {
        let value = self.value();
        self.chain(libm::log(value), 1.0 / value)
    }
    /// Of values above 0.
    fn power(self, exponent: f64) -> Self {
        let value = libm::pow(self.value(), exponent);
        self.chain(value, exponent * value / self.value())
    }
    fn at_least(self, least: f64) -> Self {
        if self.value() > least { self } else { Self::of(least) }
    }
    fn at_most(self, most: f64) -> Self {
        if self.value() < most { self } else { Self::of(most) }
    }
}

impl Number for f64 {
    fn of(value: f64) -> Self {
        value
    }
    fn value(self) -> f64 {
        self
    }
    fn chain(self, value: f64, _: f64) -> Self {
        value
    }
}

/// A value and its derivatives by the strains.
#[derive(Clone, Copy, Debug)]
pub struct Dual {
    pub value: f64,
    pub by: [f64; STRAINS],
}

impl Dual {
    /// Strain number `k` itself.
    pub fn strain(value: f64, k: usize) -> Self {
        let mut by = [0.0; STRAINS];
        by[k] = 1.0;
        Self { value, by }
    }
}

impl Number for Dual {
    fn of(value: f64) -> Self {
        Self { value, by: [0.0; STRAINS] }
    }
    fn value(self) -> f64 {
        self.value
    }
    fn chain(self, value: f64, derivative: f64) -> Self {
        Self { value, by: self.by.map(|by| by * derivative) }
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, by: std::array::from_fn(|k| self.by[k] + other.by[k]) }
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, by: std::array::from_fn(|k| self.by[k] - other.by[k]) }
    }
}

impl Mul for Dual {
    type Output = Self;
    // The product rule adds.
    #[expect(clippy::suspicious_arithmetic_impl)]
    fn mul(self, other: Self) -> Self {
        let by = std::array::from_fn(|k| self.by[k] * other.value + other.by[k] * self.value);
        Self { value: self.value * other.value, by }
    }
}
