//! Contact forces of all pairs.

use super::lanes::SphereLanes;
use crate::contacts::Pairs;
use crate::forces::Load;
use crate::law::{self, ContactLaw};
use crate::sphere::{Columns, Sphere};
use msdd_engine::Simd;
#[cfg(target_arch = "x86_64")]
use msdd_engine::kernel::{Avx2, Avx512};
use msdd_engine::kernel::{Cache, fetch};

/// Adds the forces of `pairs` to `loads` and updates their friction history. The first element of `spheres` is sphere
/// `pairs.first`, and the first of `loads` the one to which `pairs.loads` refers by that number.
///
/// For each pair in order, the force is added to the load of j and then to that of i: the result does not depend on
/// `simd`.
pub(crate) fn add_pairs(simd: Simd, law: &ContactLaw, spheres: &[Sphere], pairs: Pairs, loads: &mut [Load]) {
    assert!(pairs.reach - pairs.first <= spheres.len() && pairs.loads_reach - pairs.first <= loads.len());
    let count = pairs.i.len();
    assert!(count == pairs.j.len() && pairs.history.iter().all(|column| column.len() == count));
    assert!(pairs.loads.iter().all(|column| column.len() == count));
    assert!(simd.available());
    let all = Loop {
        law,
        // Pointers that are indexed by sphere number and never dereferenced below pairs.first. They may point outside of
        // the array, so spheres are addressed with wrapping_add: `add` requires a pointer inside.
        spheres: spheres.as_ptr().wrapping_sub(pairs.first),
        loads: loads.as_mut_ptr().wrapping_sub(pairs.first),
        pairs,
    };
    // SAFETY: the machine has the instruction set; the indices are in first..reach and first..loads_reach (see [`Pairs`]),
    // which the slices cover.
    unsafe {
        match simd {
            Simd::Scalar => all.add_any::<f64>(count),
            #[cfg(target_arch = "x86_64")]
            Simd::Avx2 => all.add_avx2(count),
            #[cfg(target_arch = "x86_64")]
            Simd::Avx512 => all.add_avx512(count),
            #[cfg(not(target_arch = "x86_64"))]
            _ => unreachable!("not available on this machine"),
        }
    }
}

struct Loop<'a> {
    law: &'a ContactLaw,
    spheres: *const Sphere,
    loads: *mut Load,
    pairs: Pairs<'a>,
}

impl Loop<'_> {
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    unsafe fn add_avx2(self, count: usize) {
        unsafe { self.add_any::<Avx2>(count) }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512dq")]
    unsafe fn add_avx512(self, count: usize) {
        unsafe { self.add_any::<Avx512>(count) }
    }

    #[inline(always)]
    unsafe fn add_any<V: SphereLanes>(self, count: usize) {
        unsafe {
            match (self.law.hertz, self.law.damped()) {
                (true, true) => self.add::<V, true, true>(count),
                (true, false) => self.add::<V, true, false>(count),
                (false, true) => self.add::<V, false, true>(count),
                (false, false) => self.add::<V, false, false>(count),
            }
        }
    }

    /// Computes the forces of a whole block of pairs first and then adds them up sphere by sphere. A single loop would
    /// have to wait for each load that the pair before has just written.
    #[inline(always)]
    unsafe fn add<V: SphereLanes, const HERTZ: bool, const DAMPED: bool>(mut self, count: usize) {
        let mut forces = Block([[[0.0; BLOCK]; 3]; 3]);
        for begin in (0..count).step_by(BLOCK) {
            let end = count.min(begin + BLOCK);
            let groups = begin + (end - begin) / V::LANES * V::LANES;
            unsafe {
                for k in (begin..groups).step_by(V::LANES) {
                    if self.pairs.far {
                        self.fetch(k + AHEAD, V::LANES);
                        self.fetch_pairs(k + FAR_AHEAD);
                    }
                    self.compute::<V, HERTZ, DAMPED>(k, &mut forces, k - begin);
                }
                for k in groups..end {
                    self.compute::<f64, HERTZ, DAMPED>(k, &mut forces, k - begin);
                }
                for k in (begin..groups).step_by(V::LANES) {
                    self.sum::<V>(k, &forces, k - begin);
                }
                for k in groups..end {
                    self.sum::<f64>(k, &forces, k - begin);
                }
            }
        }
    }

    /// Asks for the spheres and loads j of `count` pairs from `k` on; those of i stand one after the other.
    #[inline(always)]
    unsafe fn fetch(&self, k: usize, count: usize) {
        for k in k..(k + count).min(self.pairs.j.len()) {
            let [j, load] =
                unsafe { [self.pairs.j, self.pairs.loads[1]].map(|column| *column.get_unchecked(k)) };
            fetch(self.spheres.wrapping_add(j as usize), Cache::First);
            fetch(self.loads.wrapping_add(load as usize).cast_const(), Cache::First);
        }
    }

    /// Asks for the pairs from `k` on, which may be beyond the last one.
    #[inline(always)]
    fn fetch_pairs(&self, k: usize) {
        for column in [self.pairs.i, self.pairs.j] {
            fetch(column.as_ptr().wrapping_add(k), Cache::First);
        }
        for column in &self.pairs.history {
            fetch(column.as_ptr().wrapping_add(k), Cache::First);
        }
    }

    /// Forces of the LANES pairs from `k` on, into place `at` of the block.
    #[inline(always)]
    unsafe fn compute<V: SphereLanes, const HERTZ: bool, const DAMPED: bool>(
        &mut self,
        k: usize,
        block: &mut Block,
        at: usize,
    ) {
        unsafe {
            let (i, j) = (self.pairs.i.as_ptr().add(k), self.pairs.j.as_ptr().add(k));
            let a: Columns<V> = V::gather(self.spheres, i);
            let b: Columns<V> = V::gather(self.spheres, j);
            let [hx, hy, hz, ha] = &mut self.pairs.history;
            let [hx, hy, hz, ha] = [
                hx.as_mut_ptr().add(k),
                hy.as_mut_ptr().add(k),
                hz.as_mut_ptr().add(k),
                ha.as_mut_ptr().add(k),
            ];
            let old = [V::read(hx), V::read(hy), V::read(hz), V::read(ha)];
            let force = law::pair_force::<V, HERTZ, DAMPED>(self.law, &a, &b, old);
            let [x, y, z, size] = force.history;
            x.write(hx);
            y.write(hy);
            z.write(hz);
            size.write(ha);
            block.write(at, [force.on_j, force.torque[0], force.torque[1]]);
        }
    }

    /// Adds the forces at place `at` of the block onto the loads of the LANES pairs from `k` on.
    #[inline(always)]
    unsafe fn sum<V: SphereLanes>(&mut self, k: usize, block: &Block, at: usize) {
        unsafe {
            let [i, j] = self.pairs.loads.map(|column| column.as_ptr().add(k));
            V::scatter(self.loads, i, j, block.read(at));
        }
    }
}

/// Pairs ahead of which their spheres, and they themselves, are asked for.
const AHEAD: usize = 32;
const FAR_AHEAD: usize = 128;
/// Pairs in a block: their forces fit into the first-level cache.
const BLOCK: usize = 128;
/// Force on j, torque on i, torque on j of a block of pairs, by columns.
#[repr(C, align(64))]
struct Block([[[f64; BLOCK]; 3]; 3]);

impl Block {
    #[inline(always)]
    unsafe fn write<V: SphereLanes>(&mut self, at: usize, columns: [[V; 3]; 3]) {
        for (column, [x, y, z]) in self.0.iter_mut().zip(columns) {
            unsafe {
                x.write(column[0].as_mut_ptr().add(at));
                y.write(column[1].as_mut_ptr().add(at));
                z.write(column[2].as_mut_ptr().add(at));
            }
        }
    }

    #[inline(always)]
    unsafe fn read<V: SphereLanes>(&self, at: usize) -> [[V; 3]; 3] {
        let [force, of_i, of_j] = &self.0;
        unsafe { [read_three(force, at), read_three(of_i, at), read_three(of_j, at)] }
    }
}

#[inline(always)]
unsafe fn read_three<V: SphereLanes>([x, y, z]: &[[f64; BLOCK]; 3], at: usize) -> [V; 3] {
    unsafe { [V::read(x.as_ptr().add(at)), V::read(y.as_ptr().add(at)), V::read(z.as_ptr().add(at))] }
}
