//! AVX2 (four lanes) and AVX-512 (eight lanes).
//!
//! A disc is 64 bytes, one cache line. Groups of discs are loaded line by line and transposed in registers; gather
//! instructions were measured to be no faster.

use super::lanes::Lanes;
use crate::disc::Disc;
use crate::forces::Load;
use crate::vector::{Columns, Vector};
use std::arch::x86_64::*;

/// Transposes rows a..d of four f64 each into columns.
#[inline(always)]
unsafe fn transpose4([a, b, c, d]: [__m256d; 4]) -> [__m256d; 4] {
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
#[inline(always)]
unsafe fn transpose8(r: [__m512d; 8]) -> [__m512d; 8] {
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

/// Adds (fx, fy, torque_j, torque_i) of four lanes to the loads of j and i.
#[inline(always)]
unsafe fn scatter4(loads: *mut Load, i: *const u32, j: *const u32, columns: [__m256d; 4]) {
    unsafe {
        for (lane, row) in transpose4(columns).into_iter().enumerate() {
            let on_j = loads.wrapping_add(*j.add(lane) as usize).cast::<f64>();
            _mm256_store_pd(on_j, _mm256_add_pd(_mm256_load_pd(on_j), row));
            let on_i = loads.wrapping_add(*i.add(lane) as usize).cast::<f64>();
            // fx, fy, torque_i, torque_j
            let swapped = _mm256_permute_pd::<0b0110>(row);
            _mm256_store_pd(on_i, _mm256_sub_pd(_mm256_load_pd(on_i), swapped));
        }
    }
}

/// Arithmetic of a vector type. It is safe to call, because a value can exist only where the instruction set does (see
/// [`Lanes`]).
macro_rules! arithmetic {
    ($vector:ident, $add:ident $sub:ident $mul:ident $div:ident $sqrt:ident $max:ident $min:ident $splat:ident) => {
        arithmetic!(@operator $vector Add add $add);
        arithmetic!(@operator $vector Sub sub $sub);
        arithmetic!(@operator $vector Mul mul $mul);
        arithmetic!(@operator $vector Div div $div);
        impl $vector {
            #[inline(always)]
            fn root(self) -> Self {
                unsafe { Self($sqrt(self.0)) }
            }
            #[inline(always)]
            fn larger(self, other: Self) -> Self {
                unsafe { Self($max(self.0, other.0)) }
            }
            #[inline(always)]
            fn smaller(self, other: Self) -> Self {
                unsafe { Self($min(self.0, other.0)) }
            }
            #[inline(always)]
            unsafe fn all(value: f64) -> Self {
                unsafe { Self($splat(value)) }
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

#[derive(Clone, Copy)]
pub(crate) struct Avx2(__m256d);

arithmetic!(Avx2, _mm256_add_pd _mm256_sub_pd _mm256_mul_pd _mm256_div_pd _mm256_sqrt_pd _mm256_max_pd _mm256_min_pd _mm256_set1_pd);

impl Vector for Avx2 {
    type Mask = __m256d;

    #[inline(always)]
    fn like(self, value: f64) -> Self {
        unsafe { Self::all(value) }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.root()
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.larger(other)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.smaller(other)
    }
    #[inline(always)]
    fn greater(self, other: Self) -> __m256d {
        unsafe { _mm256_cmp_pd::<_CMP_GT_OQ>(self.0, other.0) }
    }
    #[inline(always)]
    fn any(mask: __m256d) -> bool {
        unsafe { _mm256_movemask_pd(mask) != 0 }
    }
    #[inline(always)]
    fn select(mask: __m256d, this: Self, other: Self) -> Self {
        unsafe { Self(_mm256_blendv_pd(other.0, this.0, mask)) }
    }
}

impl Lanes for Avx2 {
    const LANES: usize = 4;

    #[inline(always)]
    unsafe fn splat(value: f64) -> Self {
        unsafe { Self::all(value) }
    }
    #[inline(always)]
    unsafe fn read(from: *const f64) -> Self {
        unsafe { Self(_mm256_loadu_pd(from)) }
    }
    #[inline(always)]
    unsafe fn write(self, to: *mut f64) {
        unsafe { _mm256_storeu_pd(to, self.0) }
    }
    #[inline(always)]
    unsafe fn gather(discs: *const Disc, index: *const u32) -> Columns<Self> {
        unsafe { columns4([0, 1, 2, 3].map(|lane| discs.wrapping_add(*index.add(lane) as usize))) }
    }
    #[inline(always)]
    unsafe fn read_discs(discs: *const Disc) -> Columns<Self> {
        unsafe { columns4([0, 1, 2, 3].map(|lane| discs.add(lane))) }
    }
    #[inline(always)]
    unsafe fn write_discs(columns: Columns<Self>, discs: *mut Disc) {
        unsafe {
            let [a, b, c, d, e, f, g, h] = columns.map(|column| column.0);
            let (low, high) = (transpose4([a, b, c, d]), transpose4([e, f, g, h]));
            for lane in 0..4 {
                let to = discs.add(lane).cast::<f64>();
                _mm256_store_pd(to, low[lane]);
                _mm256_store_pd(to.add(4), high[lane]);
            }
        }
    }
    #[inline(always)]
    unsafe fn read_loads(loads: *const Load) -> [Self; 4] {
        unsafe { transpose4([0, 1, 2, 3].map(|lane| _mm256_load_pd(loads.add(lane).cast()))).map(Self) }
    }
    #[inline(always)]
    unsafe fn scatter(loads: *mut Load, i: *const u32, j: *const u32, force: [Self; 2], torque: [Self; 2]) {
        unsafe { scatter4(loads, i, j, [force[0].0, force[1].0, torque[1].0, torque[0].0]) }
    }
}

/// Fields of four discs.
#[inline(always)]
unsafe fn columns4(discs: [*const Disc; 4]) -> Columns<Avx2> {
    unsafe {
        let low = transpose4(discs.map(|disc| _mm256_load_pd(disc.cast::<f64>())));
        let high = transpose4(discs.map(|disc| _mm256_load_pd(disc.cast::<f64>().add(4))));
        let [a, b, c, d] = low.map(Avx2);
        let [e, f, g, h] = high.map(Avx2);
        [a, b, c, d, e, f, g, h]
    }
}

/// Fields of eight discs, one cache line each.
#[inline(always)]
unsafe fn columns8(lines: [__m512d; 8]) -> Columns<Avx512> {
    unsafe {
        let [a, b, c, d, e, f, g, h] = transpose8(lines);
        [Avx512(a), Avx512(b), Avx512(c), Avx512(d), Avx512(e), Avx512(f), Avx512(g), Avx512(h)]
    }
}

#[derive(Clone, Copy)]
pub(crate) struct Avx512(__m512d);

arithmetic!(Avx512, _mm512_add_pd _mm512_sub_pd _mm512_mul_pd _mm512_div_pd _mm512_sqrt_pd _mm512_max_pd _mm512_min_pd _mm512_set1_pd);

impl Vector for Avx512 {
    type Mask = __mmask8;

    #[inline(always)]
    fn like(self, value: f64) -> Self {
        unsafe { Self::all(value) }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.root()
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.larger(other)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.smaller(other)
    }
    #[inline(always)]
    fn greater(self, other: Self) -> __mmask8 {
        unsafe { _mm512_cmp_pd_mask::<_CMP_GT_OQ>(self.0, other.0) }
    }
    #[inline(always)]
    fn any(mask: __mmask8) -> bool {
        mask != 0
    }
    #[inline(always)]
    fn select(mask: __mmask8, this: Self, other: Self) -> Self {
        unsafe { Self(_mm512_mask_mov_pd(other.0, mask, this.0)) }
    }
}

impl Lanes for Avx512 {
    const LANES: usize = 8;

    #[inline(always)]
    unsafe fn splat(value: f64) -> Self {
        unsafe { Self::all(value) }
    }
    #[inline(always)]
    unsafe fn read(from: *const f64) -> Self {
        unsafe { Self(_mm512_loadu_pd(from)) }
    }
    #[inline(always)]
    unsafe fn write(self, to: *mut f64) {
        unsafe { _mm512_storeu_pd(to, self.0) }
    }
    #[inline(always)]
    unsafe fn gather(discs: *const Disc, index: *const u32) -> Columns<Self> {
        unsafe {
            let mut lines = [_mm512_setzero_pd(); 8];
            for (lane, line) in lines.iter_mut().enumerate() {
                *line = _mm512_load_pd(discs.wrapping_add(*index.add(lane) as usize).cast());
            }
            columns8(lines)
        }
    }
    #[inline(always)]
    unsafe fn read_discs(discs: *const Disc) -> Columns<Self> {
        unsafe {
            let mut lines = [_mm512_setzero_pd(); 8];
            for (lane, line) in lines.iter_mut().enumerate() {
                *line = _mm512_load_pd(discs.add(lane).cast());
            }
            columns8(lines)
        }
    }
    #[inline(always)]
    unsafe fn write_discs(columns: Columns<Self>, discs: *mut Disc) {
        unsafe {
            let [a, b, c, d, e, f, g, h] = columns;
            let lines = transpose8([a.0, b.0, c.0, d.0, e.0, f.0, g.0, h.0]);
            for (lane, line) in lines.into_iter().enumerate() {
                _mm512_store_pd(discs.add(lane).cast(), line);
            }
        }
    }
    #[inline(always)]
    unsafe fn read_loads(loads: *const Load) -> [Self; 4] {
        unsafe {
            let mut rows = [_mm256_setzero_pd(); 8];
            for (lane, row) in rows.iter_mut().enumerate() {
                *row = _mm256_load_pd(loads.add(lane).cast());
            }
            let low = transpose4([rows[0], rows[1], rows[2], rows[3]]);
            let high = transpose4([rows[4], rows[5], rows[6], rows[7]]);
            let join = |k: usize| Self(_mm512_insertf64x4::<1>(_mm512_castpd256_pd512(low[k]), high[k]));
            [join(0), join(1), join(2), join(3)]
        }
    }
    #[inline(always)]
    unsafe fn scatter(loads: *mut Load, i: *const u32, j: *const u32, force: [Self; 2], torque: [Self; 2]) {
        unsafe {
            let low = |v: Self| _mm512_castpd512_pd256(v.0);
            let high = |v: Self| _mm512_extractf64x4_pd::<1>(v.0);
            let [fx, fy] = force;
            let [on_i, on_j] = torque;
            scatter4(loads, i, j, [low(fx), low(fy), low(on_j), low(on_i)]);
            scatter4(loads, i.add(4), j.add(4), [high(fx), high(fy), high(on_j), high(on_i)]);
        }
    }
}
