//! AVX2 (four lanes) and AVX-512 (eight lanes).
//!
//! A group of spheres is loaded line by line and transposed in registers. There are no closures over vectors here: the
//! compiler does not inline them reliably into functions with the instruction set, and calls are several times slower.

use super::lanes::SphereLanes;
use crate::forces::Load;
use crate::sphere::{Columns, Sphere};
use msdd_engine::kernel::{Avx2, Avx512, transpose4, transpose8};
use std::arch::x86_64::*;

/// The spheres of a group: consecutive ones, or by index.
#[inline(always)]
unsafe fn field(spheres: *const Sphere, index: *const u32, lane: usize, part: usize) -> *const f64 {
    unsafe { spheres.wrapping_add(*index.add(lane) as usize).cast::<f64>().wrapping_add(4 * part) }
}

/// Quarter `part` (four fields) of four spheres by index, as columns.
#[inline(always)]
unsafe fn gather_quarter(spheres: *const Sphere, index: *const u32, part: usize) -> [__m256d; 4] {
    unsafe {
        transpose4([
            _mm256_load_pd(field(spheres, index, 0, part)),
            _mm256_load_pd(field(spheres, index, 1, part)),
            _mm256_load_pd(field(spheres, index, 2, part)),
            _mm256_load_pd(field(spheres, index, 3, part)),
        ])
    }
}

/// Four numbers of each of four records of `stride` numbers, as columns.
#[inline(always)]
unsafe fn read_quarter(from: *const f64, stride: usize) -> [__m256d; 4] {
    unsafe {
        transpose4([
            _mm256_load_pd(from),
            _mm256_load_pd(from.add(stride)),
            _mm256_load_pd(from.add(2 * stride)),
            _mm256_load_pd(from.add(3 * stride)),
        ])
    }
}

/// Writes four fields of four spheres back.
#[inline(always)]
unsafe fn write_quarter(columns: [__m256d; 4], spheres: *mut Sphere, part: usize) {
    unsafe {
        let rows = transpose4(columns);
        for (lane, row) in rows.into_iter().enumerate() {
            _mm256_store_pd(spheres.add(lane).cast::<f64>().add(4 * part), row);
        }
    }
}

/// Writes three fields of four spheres back and leaves the fourth as it is.
#[inline(always)]
unsafe fn write_three([x, y, z]: [__m256d; 3], spheres: *mut Sphere, part: usize) {
    unsafe {
        let rows = transpose4([x, y, z, _mm256_setzero_pd()]);
        for (lane, row) in rows.into_iter().enumerate() {
            let to = spheres.add(lane).cast::<f64>().add(4 * part);
            _mm256_store_pd(to, _mm256_blend_pd::<0b1000>(row, _mm256_load_pd(to)));
        }
    }
}

/// Adds force and torques of four lanes to the loads of j and i.
#[inline(always)]
unsafe fn scatter4(loads: *mut Load, i: *const u32, j: *const u32, columns: [[__m256d; 3]; 3]) {
    unsafe {
        let zero = _mm256_setzero_pd();
        let [[fx, fy, fz], [ix, iy, iz], [jx, jy, jz]] = columns;
        let forces = transpose4([fx, fy, fz, zero]);
        let of_i = transpose4([ix, iy, iz, zero]);
        let of_j = transpose4([jx, jy, jz, zero]);
        for lane in 0..4 {
            let on_j = loads.wrapping_add(*j.add(lane) as usize).cast::<f64>();
            _mm256_store_pd(on_j, _mm256_add_pd(_mm256_load_pd(on_j), forces[lane]));
            _mm256_store_pd(on_j.add(4), _mm256_add_pd(_mm256_load_pd(on_j.add(4)), of_j[lane]));
            let on_i = loads.wrapping_add(*i.add(lane) as usize).cast::<f64>();
            _mm256_store_pd(on_i, _mm256_sub_pd(_mm256_load_pd(on_i), forces[lane]));
            _mm256_store_pd(on_i.add(4), _mm256_add_pd(_mm256_load_pd(on_i.add(4)), of_i[lane]));
        }
    }
}

/// Numbers in a sphere and in a load.
const SPHERE: usize = size_of::<Sphere>() / 8;
const LOAD: usize = size_of::<Load>() / 8;

#[inline(always)]
unsafe fn four(v: __m256d) -> Avx2 {
    unsafe { Avx2::new(v) }
}

#[inline(always)]
unsafe fn columns4(a: [__m256d; 4], b: [__m256d; 4], c: [__m256d; 4]) -> Columns<Avx2> {
    unsafe {
        [
            four(a[0]),
            four(a[1]),
            four(a[2]),
            four(a[3]),
            four(b[0]),
            four(b[1]),
            four(b[2]),
            four(b[3]),
            four(c[0]),
            four(c[1]),
            four(c[2]),
        ]
    }
}

impl SphereLanes for Avx2 {
    #[inline(always)]
    unsafe fn gather(spheres: *const Sphere, index: *const u32) -> Columns<Self> {
        unsafe {
            columns4(
                gather_quarter(spheres, index, 0),
                gather_quarter(spheres, index, 1),
                gather_quarter(spheres, index, 2),
            )
        }
    }
    #[inline(always)]
    unsafe fn read_spheres(spheres: *const Sphere) -> Columns<Self> {
        unsafe {
            let from = spheres.cast::<f64>();
            columns4(
                read_quarter(from, SPHERE),
                read_quarter(from.add(4), SPHERE),
                read_quarter(from.add(8), SPHERE),
            )
        }
    }
    #[inline(always)]
    unsafe fn write_spheres(columns: Columns<Self>, spheres: *mut Sphere) {
        unsafe {
            let [x, y, z, r, vx, vy, vz, m, wx, wy, wz] = columns;
            write_quarter([x.register(), y.register(), z.register(), r.register()], spheres, 0);
            write_quarter([vx.register(), vy.register(), vz.register(), m.register()], spheres, 1);
            write_three([wx.register(), wy.register(), wz.register()], spheres, 2);
        }
    }
    #[inline(always)]
    unsafe fn read_loads(loads: *const Load) -> [[Self; 3]; 2] {
        unsafe {
            let [fx, fy, fz, _] = read_quarter(loads.cast(), LOAD);
            let [tx, ty, tz, _] = read_quarter(loads.cast::<f64>().add(4), LOAD);
            [[four(fx), four(fy), four(fz)], [four(tx), four(ty), four(tz)]]
        }
    }
    #[inline(always)]
    unsafe fn scatter(loads: *mut Load, i: *const u32, j: *const u32, columns: [[Self; 3]; 3]) {
        unsafe {
            let [[fx, fy, fz], [ix, iy, iz], [jx, jy, jz]] = columns;
            let force = [fx.register(), fy.register(), fz.register()];
            let of_i = [ix.register(), iy.register(), iz.register()];
            let of_j = [jx.register(), jy.register(), jz.register()];
            scatter4(loads, i, j, [force, of_i, of_j]);
        }
    }
}

/// Two vectors of four lanes as one of eight.
#[inline(always)]
unsafe fn join(low: __m256d, high: __m256d) -> Avx512 {
    unsafe { Avx512::new(_mm512_insertf64x4::<1>(_mm512_castpd256_pd512(low), high)) }
}

#[inline(always)]
unsafe fn low([x, y, z]: [Avx512; 3]) -> [__m256d; 3] {
    unsafe {
        [
            _mm512_castpd512_pd256(x.register()),
            _mm512_castpd512_pd256(y.register()),
            _mm512_castpd512_pd256(z.register()),
        ]
    }
}

#[inline(always)]
unsafe fn high([x, y, z]: [Avx512; 3]) -> [__m256d; 3] {
    unsafe {
        [
            _mm512_extractf64x4_pd::<1>(x.register()),
            _mm512_extractf64x4_pd::<1>(y.register()),
            _mm512_extractf64x4_pd::<1>(z.register()),
        ]
    }
}

/// Columns of eight spheres from their first lines and their third quarters.
#[inline(always)]
unsafe fn columns8(lines: [__m512d; 8], first: [__m256d; 4], second: [__m256d; 4]) -> Columns<Avx512> {
    unsafe {
        let [x, y, z, r, vx, vy, vz, m] = transpose8(lines);
        [
            Avx512::new(x),
            Avx512::new(y),
            Avx512::new(z),
            Avx512::new(r),
            Avx512::new(vx),
            Avx512::new(vy),
            Avx512::new(vz),
            Avx512::new(m),
            join(first[0], second[0]),
            join(first[1], second[1]),
            join(first[2], second[2]),
        ]
    }
}

impl SphereLanes for Avx512 {
    #[inline(always)]
    unsafe fn gather(spheres: *const Sphere, index: *const u32) -> Columns<Self> {
        unsafe {
            let mut lines = [_mm512_setzero_pd(); 8];
            for (lane, line) in lines.iter_mut().enumerate() {
                *line = _mm512_load_pd(field(spheres, index, lane, 0));
            }
            columns8(lines, gather_quarter(spheres, index, 2), gather_quarter(spheres, index.add(4), 2))
        }
    }
    #[inline(always)]
    unsafe fn read_spheres(spheres: *const Sphere) -> Columns<Self> {
        unsafe {
            let from = spheres.cast::<f64>();
            let mut lines = [_mm512_setzero_pd(); 8];
            for (lane, line) in lines.iter_mut().enumerate() {
                *line = _mm512_load_pd(from.add(lane * SPHERE));
            }
            let second = from.add(4 * SPHERE + 8);
            columns8(lines, read_quarter(from.add(8), SPHERE), read_quarter(second, SPHERE))
        }
    }
    #[inline(always)]
    unsafe fn write_spheres(columns: Columns<Self>, spheres: *mut Sphere) {
        unsafe {
            let [x, y, z, r, vx, vy, vz, m, wx, wy, wz] = columns;
            let lines = transpose8([
                x.register(),
                y.register(),
                z.register(),
                r.register(),
                vx.register(),
                vy.register(),
                vz.register(),
                m.register(),
            ]);
            for (lane, line) in lines.into_iter().enumerate() {
                _mm512_store_pd(spheres.add(lane).cast(), line);
            }
            write_three(low([wx, wy, wz]), spheres, 2);
            write_three(high([wx, wy, wz]), spheres.add(4), 2);
        }
    }
    #[inline(always)]
    unsafe fn read_loads(loads: *const Load) -> [[Self; 3]; 2] {
        unsafe {
            let from = loads.cast::<f64>();
            let (a, b) = (read_quarter(from, LOAD), read_quarter(from.add(4 * LOAD), LOAD));
            let (c, d) = (read_quarter(from.add(4), LOAD), read_quarter(from.add(4 * LOAD + 4), LOAD));
            [
                [join(a[0], b[0]), join(a[1], b[1]), join(a[2], b[2])],
                [join(c[0], d[0]), join(c[1], d[1]), join(c[2], d[2])],
            ]
        }
    }
    #[inline(always)]
    unsafe fn scatter(loads: *mut Load, i: *const u32, j: *const u32, columns: [[Self; 3]; 3]) {
        unsafe {
            let [force, of_i, of_j] = columns;
            scatter4(loads, i, j, [low(force), low(of_i), low(of_j)]);
            scatter4(loads, i.add(4), j.add(4), [high(force), high(of_i), high(of_j)]);
        }
    }
}
