//! Lanes in x86-64 registers: sixteen, which are two of AVX-512 or four of AVX2, or as many as one register has.
//!
//! Only this module and [`super::dispatch`] use these types, and `dispatch` only inside functions that are compiled for
//! the instruction set and called on machines that have it. This makes the intrinsics below sound.
#![allow(unsafe_code)]

use super::vector::{Arithmetic, INTEGER, INTEGER_AND_BIAS, MANTISSA, Part, ROOT_HALF, TO_EXPONENT, Vector};
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
        $name:ident: $register:ty, [$($k:literal)*] of $width:literal, $features:literal;
        $load:ident $store:ident $set:ident $fused:ident $sqrt:ident $max:ident $min:ident $and:ident $andnot:ident $or:ident;
        $add:ident $sub:ident $mul:ident $div:ident;
        integers: $bits:ident $integers:ident $set_integer:ident $add_integer:ident $right:ident $and_integer:ident $or_integer:ident;
        power: $v:ident => $power:expr; greater: ($a:ident, $b:ident, $this:ident, $other:ident) => $greater:expr, any: $any:expr
    ) => {
        #[derive(Clone, Copy)]
        pub(super) struct $name([$register; [$($k),*].len()]);

        vector!(operator $name, [$($k)*], Add, add, $add);
        vector!(operator $name, [$($k)*], Sub, sub, $sub);
        vector!(operator $name, [$($k)*], Mul, mul, $mul);
        vector!(operator $name, [$($k)*], Div, div, $div);

        impl Vector for $name {
            const WIDTH: usize = $width * [$($k),*].len();

            #[inline(always)]
            fn read(lanes: &[f64]) -> Self {
                let lanes = &lanes[..Self::WIDTH];
                each!([$($k)*] $name, k => $load(lanes[$width * k..].as_ptr()))
            }
            #[inline(always)]
            fn write(self, lanes: &mut [f64]) {
                let lanes = &mut lanes[..Self::WIDTH];
                // SAFETY: see the module; `lanes` is as long as the registers are.
                $(unsafe { $store(lanes.as_mut_ptr().add($width * $k), self.0[$k]) };)*
            }
        }

        impl Arithmetic for $name {
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
            fn split(self) -> (Self, Self) {
                let mantissa = each!([$($k)*] $name, k => {
                    let bits = $add_integer($bits(self.0[k]), $set_integer(TO_EXPONENT.cast_signed()));
                    $integers($add_integer($and_integer(bits, $set_integer(MANTISSA.cast_signed())), $set_integer(ROOT_HALF.cast_signed())))
                });
                let exponent: Self = each!([$($k)*] $name, k => {
                    let bits = $add_integer($bits(self.0[k]), $set_integer(TO_EXPONENT.cast_signed()));
                    $integers($or_integer($right::<52>(bits), $set_integer(INTEGER.cast_signed())))
                });
                (mantissa, exponent - Self::all(INTEGER_AND_BIAS))
            }
            #[inline(always)]
            fn where_greater(self, than: Self, this: Self, other: Self) -> Self {
                each!([$($k)*] $name, k => {
                    let ($a, $b, $this, $other) = (self.0[k], than.0[k], this.0[k], other.0[k]);
                    $greater
                })
            }
            #[inline(always)]
            fn any_greater(self, than: Self) -> bool {
                let mut any = false;
                $({
                    let ($a, $b) = (self.0[$k], than.0[$k]);
                    // SAFETY: see the module.
                    any |= unsafe { $any };
                })*
                any
            }
            #[inline(always)]
            fn apart(part: impl Part) {
                #[target_feature(enable = $features)]
                #[inline(never)]
                fn compiled(part: impl Part) {
                    part.run();
                }
                // SAFETY: see the module.
                unsafe { compiled(part) };
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

macro_rules! avx512 {
    ($name:ident, [$($k:literal)*]) => {
        vector! {
            $name: __m512d, [$($k)*] of 8, "avx512f,avx512dq,fma";
            _mm512_loadu_pd _mm512_storeu_pd _mm512_set1_pd _mm512_fmadd_pd _mm512_sqrt_pd _mm512_max_pd _mm512_min_pd
                _mm512_and_pd _mm512_andnot_pd _mm512_or_pd;
            _mm512_add_pd _mm512_sub_pd _mm512_mul_pd _mm512_div_pd;
            integers: _mm512_castpd_si512 _mm512_castsi512_pd _mm512_set1_epi64 _mm512_add_epi64 _mm512_srli_epi64
                _mm512_and_si512 _mm512_or_si512;
            power: v => _mm512_castsi512_pd(_mm512_add_epi64(
                _mm512_slli_epi64::<52>(_mm512_castpd_si512(v)),
                _mm512_set1_epi64(1023 << 52),
            ));
            greater: (a, b, this, other) => _mm512_mask_blend_pd(_mm512_cmp_pd_mask::<_CMP_GT_OQ>(a, b), other, this),
                any: _mm512_cmp_pd_mask::<_CMP_GT_OQ>(a, b) != 0
        }
    };
}
avx512!(Avx512, [0 1]);
avx512!(OneAvx512, [0]);

macro_rules! avx2 {
    ($name:ident, [$($k:literal)*]) => {
        vector! {
            $name: __m256d, [$($k)*] of 4, "avx2,fma";
            _mm256_loadu_pd _mm256_storeu_pd _mm256_set1_pd _mm256_fmadd_pd _mm256_sqrt_pd _mm256_max_pd _mm256_min_pd
                _mm256_and_pd _mm256_andnot_pd _mm256_or_pd;
            _mm256_add_pd _mm256_sub_pd _mm256_mul_pd _mm256_div_pd;
            integers: _mm256_castpd_si256 _mm256_castsi256_pd _mm256_set1_epi64x _mm256_add_epi64 _mm256_srli_epi64
                _mm256_and_si256 _mm256_or_si256;
            power: v => _mm256_castsi256_pd(_mm256_add_epi64(
                _mm256_slli_epi64::<52>(_mm256_castpd_si256(v)),
                _mm256_set1_epi64x(1023 << 52),
            ));
            greater: (a, b, this, other) => _mm256_blendv_pd(other, this, _mm256_cmp_pd::<_CMP_GT_OQ>(a, b)),
                any: _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_GT_OQ>(a, b)) != 0
        }
    };
}
avx2!(Avx2, [0 1 2 3]);
avx2!(OneAvx2, [0]);
