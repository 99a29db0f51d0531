//! tanh of blocks of cells.

use super::vector::Vector;

/// ln 2 in two parts; the high one has 21 trailing zero bits, so n · LN2_HIGH is exact for |n| < 2^20.
const LN2_HIGH: f64 = f64::from_bits(0x3FE6_2E42_FEE0_0000);
const LN2_LOW: f64 = f64::from_bits(0x3DEA_39EF_3579_3C76);
/// 1.5 · 2^52: adding this number to another rounds the sum to an integer, which then stands in its low bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;
/// 1/k! for k = 2 to 13. The next term is below 1.2e-17 of the sum for |r| <= ln 2 / 2.
const INVERSE_FACTORIALS: [f64; 12] = [
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5_040.0,
    1.0 / 40_320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
    1.0 / 39_916_800.0,
    1.0 / 479_001_600.0,
    1.0 / 6_227_020_800.0,
];

/// Σ r^k / (k + 2)! by Estrin's scheme, whose shorter chains of dependent operations take half the time of Horner's.
#[inline(always)]
fn series<V: Vector>(r: V) -> V {
    let r2 = r * r;
    let r4 = r2 * r2;
    let c = |k: usize| V::all(INVERSE_FACTORIALS[k]);
    let low = c(3).fused(r, c(2)).fused(r2, c(1).fused(r, c(0)));
    let middle = c(7).fused(r, c(6)).fused(r2, c(5).fused(r, c(4)));
    let high = c(11).fused(r, c(10)).fused(r2, c(9).fused(r, c(8)));
    high.fused(r4, middle).fused(r4, low)
}

/// e^{2|x|} − 1, without branches and without cancellation near zero.
#[inline(always)]
fn excess<V: Vector>(x: V) -> V {
    // tanh rounds to 1 beyond 19.1; the limit keeps e^{2x} small, and the product of four denominators as well.
    let magnitude = x.abs().at_most(V::all(20.0));
    let doubled = magnitude + magnitude;
    // e^doubled = 2^n e^r with |r| <= ln 2 / 2.
    let rounded = doubled.fused(V::all(std::f64::consts::LOG2_E), V::all(ROUNDER));
    let n = rounded - V::all(ROUNDER);
    let r = n.fused(V::all(-LN2_LOW), n.fused(V::all(-LN2_HIGH), doubled));
    // e^r − 1, then e^doubled − 1.
    let small = (r * r).fused(series(r), r);
    let power = rounded.power_of_low_bits();
    power.fused(small, power - V::all(1.0))
}

/// tanh x = (e^{2|x|} − 1) / (e^{2|x|} + 1) with the sign of x, for N neurons. Division is the slowest operation, so
/// four neurons share one division by the product of their denominators. The error is at most 4 units in the last
/// place, 8 with a shared division. libm's tanh is not used because it is not vectorised, differs between systems, and
/// may raise floating-point exceptions.
#[inline(always)]
pub(super) fn tanh<V: Vector, const N: usize>(neurons: &mut [V; N]) {
    let mut numerators = *neurons;
    for numerator in &mut numerators {
        *numerator = excess(*numerator);
    }
    let mut d = numerators;
    for d in &mut d {
        *d = *d + V::all(2.0);
    }
    invert(&mut d);
    for n in 0..N {
        neurons[n] = (numerators[n] * d[n]).copysign(neurons[n]);
    }
}

/// Replaces denominators from 2 to e^40 + 1 by their inverses.
#[inline(always)]
fn invert<V: Vector, const N: usize>(d: &mut [V; N]) {
    if N == 4 {
        let (low, high) = (d[0] * d[1], d[2] * d[3]);
        let inverse = V::all(1.0) / (low * high);
        let (low, high) = (inverse * high, inverse * low);
        (d[0], d[1]) = (low * d[1], low * d[0]);
        (d[2], d[3]) = (high * d[3], high * d[2]);
    } else {
        for d in d {
            *d = V::all(1.0) / *d;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::vector::Portable;
    use crate::kernel::{LANES, Lanes};

    fn of<const N: usize>(x: [f64; N]) -> [f64; N] {
        let mut neurons = x.map(Portable::all);
        tanh(&mut neurons);
        neurons.map(|neuron| {
            let mut lanes: Lanes = [0.0; LANES];
            neuron.write(&mut lanes);
            lanes[5]
        })
    }

    /// Distance in half units in the last place, for numbers as large as the largest between the same powers of two as
    /// `b`.
    fn half_units(a: f64, b: f64) -> f64 {
        (a - b).abs() / (b.abs().max(f64::MIN_POSITIVE) * f64::EPSILON / 2.0)
    }

    #[test]
    fn tanh_agrees_with_the_standard_library() {
        let (mut alone, mut shared) = (0.0f64, 0.0f64);
        for i in -40_000..=40_000 {
            for x in [f64::from(i) * 5.3e-4, f64::from(i) * 1e-12] {
                alone = alone.max(half_units(of([x])[0], x.tanh()));
                // Neurons of very different magnitude share a division.
                let four = [x, 1.7 - x, 400.0 * x, 1e-9 - 0.3 * x];
                let errors = four.iter().zip(of(four)).map(|(x, value)| half_units(value, x.tanh()));
                shared = errors.fold(shared, f64::max);
            }
        }
        assert!(alone <= 8.0 && shared <= 16.0, "{alone} and {shared} half units");
    }

    #[test]
    fn tanh_saturates_and_keeps_sign() {
        for huge in [19.5, 400.0, 1e10, f64::MAX] {
            assert_eq!(of([huge, -huge]), [1.0, -1.0]);
            assert!(of([huge, -huge, 0.3, -huge]).iter().all(|value| value.abs() <= 1.0));
        }
        let bits = |values: [f64; 2]| values.map(f64::to_bits);
        assert_eq!(bits(of([0.0, -0.0])), bits([0.0, -0.0]));
        assert_eq!(of([1e-300]), [1e-300]);
    }
}
