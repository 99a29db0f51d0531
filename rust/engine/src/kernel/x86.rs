//! AVX2 (four lanes) and AVX-512 (eight lanes).

use super::lanes::Lanes;
use crate::vector::Vector;
use std::arch::x86_64::*;

/// Transposes rows a..d of four f64 each into columns.
///
/// # Safety
/// The machine must have AVX2.
#[inline(always)]
pub unsafe fn transpose4([a, b, c, d]: [__m256d; 4]) -> [__m256d; 4] {
    unsafe {
        let (ab_lo, ab_hi) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
        let (cd_lo, cd_hi) = (_mm256_unpacklo_pd(c, d), _mm256_unpackhi_pd(c, d));
        [
            _mm256_permute2f128_pd::<0x20>(ab_lo, cd_lo),
            _mm256_permute2f128_pd::<0x20>(ab_hi, cd_hi),
            _mm256_permute2f128_pd::<0x31>(ab_lo, cd_lo),
            _mm256_permute2f128_pd::<0x31>(ab_hi, cd_hi),
        ]
    }
}

/// Transposes eight rows of eight f64 each into columns.
///
/// # Safety
/// The machine must have AVX-512 (F, DQ).
#[inline(always)]
pub unsafe fn transpose8(r: [__m512d; 8]) -> [__m512d; 8] {
    unsafe {
        let mut pairs = [_mm512_setzero_pd(); 8];
        for k in 0..4 {
            pairs[2 * k] = _mm512_unpacklo_pd(r[2 * k], r[2 * k + 1]);
            pairs[2 * k + 1] = _mm512_unpackhi_pd(r[2 * k], r[2 * k + 1]);
        }
        // pairs[even]: columns 0 2 4 6 of two rows; pairs[odd]: columns 1 3 5 7.
        let mut quads = [_mm512_setzero_pd(); 8];
        for (half, base) in [(0, 0), (4, 4)] {
            for odd in 0..2 {
                let (p, q) = (pairs[base + odd], pairs[base + 2 + odd]);
                // Columns (odd, odd + 4) and (odd + 2, odd + 6) of four rows.
                quads[half + odd] = _mm512_shuffle_f64x2::<0b10_00_10_00>(p, q);
                quads[half + 2 + odd] = _mm512_shuffle_f64x2::<0b11_01_11_01>(p, q);
            }
        }
        let mut columns = [_mm512_setzero_pd(); 8];
        for k in 0..4 {
            columns[k] = _mm512_shuffle_f64x2::<0b10_00_10_00>(quads[k], quads[4 + k]);
            columns[k + 4] = _mm512_shuffle_f64x2::<0b11_01_11_01>(quads[k], quads[4 + k]);
        }
        columns
    }
}

/// A vector type of that many lanes. Its arithmetic is safe to call, because a value can exist only where the instruction set does
/// (see [`Lanes`]).
macro_rules! vector {
    (
        $vector:ident: $register:ty, $mask:ty, $lanes:literal;
        $add:ident $sub:ident $mul:ident $div:ident $sqrt:ident $max:ident $min:ident $splat:ident $read:ident $write:ident;
        $a:ident > $b:ident: $greater:expr;
        $chosen:ident: any $any:expr, select($this:ident, $other:ident) $select:expr
    ) => {
        vector!(@operator $vector Add add $add);
        vector!(@operator $vector Sub sub $sub);
        vector!(@operator $vector Mul mul $mul);
        vector!(@operator $vector Div div $div);

        impl Vector for $vector {
            type Mask = $mask;

            #[inline(always)]
            fn like(self, value: f64) -> Self {
                unsafe { Self::splat(value) }
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                unsafe { Self($sqrt(self.0)) }
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                unsafe { Self($max(self.0, other.0)) }
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                unsafe { Self($min(self.0, other.0)) }
            }
            #[inline(always)]
            fn greater(self, other: Self) -> $mask {
                let ($a, $b) = (self.0, other.0);
                unsafe { $greater }
            }
            #[inline(always)]
            fn any($chosen: $mask) -> bool {
                $any
            }
            #[inline(always)]
            fn select($chosen: $mask, this: Self, other: Self) -> Self {
                let ($this, $other) = (this.0, other.0);
                unsafe { Self($select) }
            }
        }

        impl Lanes for $vector {
            const LANES: usize = $lanes;

            #[inline(always)]
            unsafe fn splat(value: f64) -> Self {
                unsafe { Self($splat(value)) }
            }
            #[inline(always)]
            unsafe fn read(from: *const f64) -> Self {
                unsafe { Self($read(from)) }
            }
            #[inline(always)]
            unsafe fn write(self, to: *mut f64) {
                unsafe { $write(to, self.0) }
            }
        }

        impl $vector {
            /// # Safety
            /// The machine must have the instruction set.
            #[inline(always)]
            pub unsafe fn new(register: $register) -> Self {
                Self(register)
            }
            /// The register that holds the lanes.
            #[inline(always)]
            pub fn register(self) -> $register {
                self.0
            }
        }
    };
    (@operator $vector:ident $operator:ident $method:ident $intrinsic:ident) => {
        impl std::ops::$operator for $vector {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                unsafe { Self($intrinsic(self.0, other.0)) }
            }
        }
    };
}

/// Four lanes.
#[derive(Clone, Copy)]
pub struct Avx2(__m256d);

vector! {
    Avx2: __m256d, __m256d, 4;
    _mm256_add_pd _mm256_sub_pd _mm256_mul_pd _mm256_div_pd _mm256_sqrt_pd _mm256_max_pd _mm256_min_pd _mm256_set1_pd
        _mm256_loadu_pd _mm256_storeu_pd;
    a > b: _mm256_cmp_pd::<_CMP_GT_OQ>(a, b);
    mask: any unsafe { _mm256_movemask_pd(mask) != 0 }, select(this, other) _mm256_blendv_pd(other, this, mask)
}

/// Eight lanes.
#[derive(Clone, Copy)]
pub struct Avx512(__m512d);

vector! {
    Avx512: __m512d, __mmask8, 8;
    _mm512_add_pd _mm512_sub_pd _mm512_mul_pd _mm512_div_pd _mm512_sqrt_pd _mm512_max_pd _mm512_min_pd _mm512_set1_pd
        _mm512_loadu_pd _mm512_storeu_pd;
    a > b: _mm512_cmp_pd_mask::<_CMP_GT_OQ>(a, b);
    mask: any mask != 0, select(this, other) _mm512_mask_mov_pd(other, mask, this)
}
