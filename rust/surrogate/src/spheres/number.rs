//! The numbers of [`crate::number`] by the six strains of space.

use super::components::six;
use crate::kernel::vector::Arithmetic;
pub use crate::number::{Dual, Number};

/// Number of strains.
const STRAINS: usize = 6;

/// Values, or values with derivatives, of a strain.
pub trait Differentiable<V: Arithmetic>: Number<Values = V> {
    /// Whether they have derivatives.
    const DIFFERENTIATES: bool;

    /// The strains themselves.
    fn strains(values: [V; STRAINS]) -> [Self; STRAINS];
    /// Derivatives by the strains; 0 without.
    fn derivatives(self) -> [V; STRAINS];
}

impl<V: Arithmetic> Differentiable<V> for V {
    const DIFFERENTIATES: bool = false;

    #[inline(always)]
    fn strains(values: [V; STRAINS]) -> [Self; STRAINS] {
        values
    }
    #[inline(always)]
    fn derivatives(self) -> [V; STRAINS] {
        [V::zero(); STRAINS]
    }
}

impl<V: Arithmetic, const D: usize> Differentiable<V> for Dual<V, D> {
    const DIFFERENTIATES: bool = true;

    #[inline(always)]
    fn strains(values: [V; STRAINS]) -> [Self; STRAINS] {
        six!(k => if k < D { Self::strain(values[k], k) } else { Self::of(values[k]) })
    }
    #[inline(always)]
    fn derivatives(self) -> [V; STRAINS] {
        six!(k => if k < D { self.by[k] } else { V::zero() })
    }
}
