//! Sixteen lanes in x86-64 registers: two of AVX-512, four of AVX2.
//!
//! Only this module and [`super::dispatch`] use these types, and `dispatch` only inside functions that are compiled for
//! the instruction set and called on machines that have it. This makes the intrinsics below sound.
#![allow(unsafe_code)]

use super::vector::{LANES, Lanes, Vector};
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Sub};

/// Applies an expression to the registers of some vectors, one by one.
macro_rules! each {
    ([$($k:literal)*] $name:ident, $register:ident => $expression:expr) => {
        // SAFETY: see the module.
        unsafe { $name([$({ let $register = $k; $expression }),*]) }
    };
}

/// A vector type of `$count` registers that hold `$width` lanes each.
macro_rules! vector {
    (
        $name:ident: $register:ty, [$($k:literal)*] of $width:literal;
        $load:ident $store:ident $set:ident $fused:ident $sqrt:ident $max:ident $min:ident $and:ident $andnot:ident $or:ident;
        $add:ident $sub:ident $mul:ident $div:ident;
        power: $v:ident => $power:expr; greater: ($a:ident, $b:ident, $this:ident, $other:ident) => $greater:expr
    ) => {
        #[derive(Clone, Copy)]
        pub(super) struct $name([$register; LANES / $width]);

        vector!(operator $name, [$($k)*], Add, add, $add);
        vector!(operator $name, [$($k)*], Sub, sub, $sub);
        vector!(operator $name, [$($k)*], Mul, mul, $mul);
        vector!(operator $name, [$($k)*], Div, div, $div);

        impl Vector for $name {
            #[inline(always)]
            fn read(lanes: &Lanes) -> Self {
                each!([$($k)*] $name, k => $load(lanes[$width * k..].as_ptr()))
            }
            #[inline(always)]
            fn write(self, lanes: &mut Lanes) {
                // SAFETY: see the module; the registers' lanes are those of `lanes`.
                $(unsafe { $store(lanes.as_mut_ptr().add($width * $k), self.0[$k]) };)*
            }
            #[inline(always)]
            fn all(value: f64) -> Self {
                each!([$($k)*] $name, _k => $set(value))
            }
            #[inline(always)]
            fn fused(self, factor: Self, addend: Self) -> Self {
                each!([$($k)*] $name, k => $fused(self.0[k], factor.0[k], addend.0[k]))
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                each!([$($k)*] $name, k => $sqrt(self.0[k]))
            }
            #[inline(always)]
            fn abs(self) -> Self {
                each!([$($k)*] $name, k => $andnot($set(-0.0), self.0[k]))
            }
            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                let bit = Self::all(-0.0);
                each!([$($k)*] $name, k => $or($andnot(bit.0[k], self.0[k]), $and(bit.0[k], sign.0[k])))
            }
            #[inline(always)]
            fn at_least(self, other: Self) -> Self {
                each!([$($k)*] $name, k => $max(self.0[k], other.0[k]))
            }
            #[inline(always)]
            fn at_most(self, other: Self) -> Self {
                each!([$($k)*] $name, k => $min(self.0[k], other.0[k]))
            }
            #[inline(always)]
            fn power_of_low_bits(self) -> Self {
                each!([$($k)*] $name, k => { let $v = self.0[k]; $power })
            }
            #[inline(always)]
            fn where_greater(self, than: Self, this: Self, other: Self) -> Self {
                each!([$($k)*] $name, k => {
                    let ($a, $b, $this, $other) = (self.0[k], than.0[k], this.0[k], other.0[k]);
                    $greater
                })
            }
        }
    };
    (operator $name:ident, [$($k:literal)*], $trait:ident, $function:ident, $intrinsic:ident) => {
        impl $trait for $name {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                each!([$($k)*] $name, k => $intrinsic(self.0[k], other.0[k]))
            }
        }
    };
}

vector! {
    Avx512: __m512d, [0 1] of 8;
    _mm512_loadu_pd _mm512_storeu_pd _mm512_set1_pd _mm512_fmadd_pd _mm512_sqrt_pd _mm512_max_pd _mm512_min_pd
        _mm512_and_pd _mm512_andnot_pd _mm512_or_pd;
    _mm512_add_pd _mm512_sub_pd _mm512_mul_pd _mm512_div_pd;
    power: v => _mm512_castsi512_pd(_mm512_add_epi64(
        _mm512_slli_epi64::<52>(_mm512_castpd_si512(v)),
        _mm512_set1_epi64(1023 << 52),
    ));
    greater: (a, b, this, other) => _mm512_mask_blend_pd(_mm512_cmp_pd_mask::<_CMP_GT_OQ>(a, b), other, this)
}

vector! {
    Avx2: __m256d, [0 1 2 3] of 4;
    _mm256_loadu_pd _mm256_storeu_pd _mm256_set1_pd _mm256_fmadd_pd _mm256_sqrt_pd _mm256_max_pd _mm256_min_pd
        _mm256_and_pd _mm256_andnot_pd _mm256_or_pd;
    _mm256_add_pd _mm256_sub_pd _mm256_mul_pd _mm256_div_pd;
    power: v => _mm256_castsi256_pd(_mm256_add_epi64(
        _mm256_slli_epi64::<52>(_mm256_castpd_si256(v)),
        _mm256_set1_epi64x(1023 << 52),
    ));
    greater: (a, b, this, other) => _mm256_blendv_pd(other, this, _mm256_cmp_pd::<_CMP_GT_OQ>(a, b))
}
