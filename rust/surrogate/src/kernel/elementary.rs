//! Functions of blocks of cells. They take the same steps everywhere, raise no floating-point exceptions, and do not depend on the
//! system's mathematical library.

use super::vector::{Arithmetic, Vector};

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

/// The largest size of an exponent of [`exp`].
const MAX_EXPONENT: f64 = 700.0;

/// e^x in two parts, with |x| at most 700: 2^n, and e^r − 1 with e^x = 2^n e^r and |r| <= ln 2 / 2. It has no fused operations, which
/// a processor may lack, since single numbers need it, too.
#[inline(always)]
fn power_of_two_and_rest<V: Arithmetic>(x: V) -> (V, V) {
    let x = x.within(V::all(-MAX_EXPONENT), V::all(MAX_EXPONENT));
    let rounded = x * V::all(std::f64::consts::LOG2_E) + V::all(ROUNDER);
    let n = rounded - V::all(ROUNDER);
    let r = (x - n * V::all(LN2_HIGH)) - n * V::all(LN2_LOW);
    let r2 = r * r;
    let r4 = r2 * r2;
    let low = pair(r, 0) + r2 * pair(r, 2);
    let middle = pair(r, 4) + r2 * pair(r, 6);
    let high = pair(r, 8) + r2 * pair(r, 10);
    (rounded.power_of_low_bits(), r + r2 * (low + r4 * (middle + r4 * high)))
}

/// Two terms of the series of e^r.
#[inline(always)]
fn pair<V: Arithmetic>(r: V, k: usize) -> V {
    V::all(INVERSE_FACTORIALS[k]) + r * V::all(INVERSE_FACTORIALS[k + 1])
}

/// e^x; that of ±700 for x beyond. The error is at most 1 unit in the last place.
#[inline(always)]
pub fn exp<V: Arithmetic>(x: V) -> V {
    let (power, rest) = power_of_two_and_rest(x);
    power + power * rest
}

/// e^x − 1, without cancellation near zero.
#[inline(always)]
pub fn exp_less_one<V: Arithmetic>(x: V) -> V {
    let (power, rest) = power_of_two_and_rest(x);
    (power - V::all(1.0)) + power * rest
}

/// Number of terms of the series of [`ln`]; the next is below 1e-17 of the sum.
const TERMS: usize = 11;

/// ln x, of numbers from 2^-1021 on. The error is at most 2 units in the last place.
#[inline(always)]
pub fn ln<V: Arithmetic>(x: V) -> V {
    let (mantissa, n) = x.split();
    // ln m = 2 artanh s = 2 (s + s³/3 + …) with s = (m − 1)/(m + 1), of which |s| <= 0.172; 2 s = f − s f with f = m − 1, and so f
    // counts without rounding.
    let f = mantissa - V::all(1.0);
    let s = f / (f + V::all(2.0));
    let z = s * s;
    let mut sum = V::all(2.0 / (2 * TERMS + 1) as f64);
    for k in (1..TERMS).rev() {
        sum = sum * z + V::all(2.0 / (2 * k + 1) as f64);
    }
    n * V::all(LN2_HIGH) + (f - (s * (f - z * sum) - n * V::all(LN2_LOW)))
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
    use crate::kernel::vector::{Arithmetic, Portable};
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

    #[test]
    fn exponentials_and_logarithms_agree_with_the_mathematical_library() {
        let [mut of_exp, mut of_less, mut of_ln] = [0.0f64; 3];
        for i in -40_000..=40_000 {
            for x in [f64::from(i) * 1.7e-2, f64::from(i) * 3.1e-4, f64::from(i) * 1e-12] {
                of_exp = of_exp.max(half_units(exp(x), libm::exp(x)));
                of_less = of_less.max(half_units(exp_less_one(x), libm::expm1(x)));
                let y = libm::exp(x);
                of_ln = of_ln.max(half_units(ln(y), libm::log(y)));
                of_ln = of_ln.max(half_units(ln(1.0 + x.abs()), libm::log(1.0 + x.abs())));
            }
        }
        assert!(of_exp <= 3.0 && of_less <= 4.0 && of_ln <= 4.0, "{of_exp} {of_less} {of_ln} half units");
        assert_eq!([exp(1e3), exp(-1e3), ln(1.0), exp(0.0)], [exp(700.0), exp(-700.0), 0.0, 1.0]);
        assert_eq!((ln(2.0f64), exp_less_one(-0.0f64)), (std::f64::consts::LN_2, 0.0));
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
