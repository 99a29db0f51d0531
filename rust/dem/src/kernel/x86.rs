//! AVX2 (four lanes) and AVX-512 (eight lanes).
//!
//! A disc is 64 bytes, one cache line. Groups of discs are loaded line by line and transposed in registers; gather
//! instructions were measured to be no faster.

use super::lanes::DiscLanes;
use crate::disc::{Columns, Disc};
use crate::forces::Load;
use msdd_engine::kernel::{Avx2, Avx512, transpose4, transpose8};
use std::arch::x86_64::*;

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

impl DiscLanes for Avx2 {
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
            let [a, b, c, d, e, f, g, h] = columns.map(Self::register);
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
        unsafe {
            transpose4([0, 1, 2, 3].map(|lane| _mm256_load_pd(loads.add(lane).cast())))
                .map(|column| Self::new(column))
        }
    }
    #[inline(always)]
    unsafe fn scatter(loads: *mut Load, i: *const u32, j: *const u32, force: [Self; 2], torque: [Self; 2]) {
        unsafe { scatter4(loads, i, j, [force[0], force[1], torque[1], torque[0]].map(Self::register)) }
    }
}

/// Fields of four discs.
#[inline(always)]
unsafe fn columns4(discs: [*const Disc; 4]) -> Columns<Avx2> {
    unsafe {
        let low = transpose4(discs.map(|disc| _mm256_load_pd(disc.cast::<f64>())));
        let high = transpose4(discs.map(|disc| _mm256_load_pd(disc.cast::<f64>().add(4))));
        let [a, b, c, d] = low.map(|column| Avx2::new(column));
        let [e, f, g, h] = high.map(|column| Avx2::new(column));
        [a, b, c, d, e, f, g, h]
    }
}

/// Fields of eight discs, one cache line each.
#[inline(always)]
unsafe fn columns8(lines: [__m512d; 8]) -> Columns<Avx512> {
    unsafe { transpose8(lines).map(|column| Avx512::new(column)) }
}

impl DiscLanes for Avx512 {
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
            let lines = transpose8(columns.map(Self::register));
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
            let join = |k: usize| Self::new(_mm512_insertf64x4::<1>(_mm512_castpd256_pd512(low[k]), high[k]));
            [join(0), join(1), join(2), join(3)]
        }
    }
    #[inline(always)]
    unsafe fn scatter(loads: *mut Load, i: *const u32, j: *const u32, force: [Self; 2], torque: [Self; 2]) {
        unsafe {
            let low = |v: Self| _mm512_castpd512_pd256(v.register());
            let high = |v: Self| _mm512_extractf64x4_pd::<1>(v.register());
            let [fx, fy] = force;
            let [on_i, on_j] = torque;
            scatter4(loads, i, j, [low(fx), low(fy), low(on_j), low(on_i)]);
            scatter4(loads, i.add(4), j.add(4), [high(fx), high(fy), high(on_j), high(on_i)]);
        }
    }
}
