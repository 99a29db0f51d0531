//! Contact forces of all pairs.

use super::lanes::DiscLanes;
use crate::contacts::Pairs;
use crate::disc::Columns;
use crate::disc::Disc;
use crate::forces::Load;
use crate::law::{self, PairLaw};
use msdd_engine::Simd;
#[cfg(target_arch = "x86_64")]
use msdd_engine::kernel::{Avx2, Avx512};

/// Adds the forces of `pairs` to `loads` and updates their friction history. The first elements of `discs` and `loads`
/// belong to disc `pairs.first`.
///
/// For each pair in order, the force is added to the load of j and then to that of i: the result does not depend on
/// `simd`.
pub(crate) fn add_pairs(simd: Simd, law: PairLaw, discs: &[Disc], pairs: Pairs, loads: &mut [Load]) {
    let reached = pairs.reach - pairs.first;
    assert!(reached <= discs.len() && reached <= loads.len());
    let count = pairs.i.len();
    assert!(count == pairs.j.len() && count == pairs.tangential.len() && simd.available());
    assert!(pairs.conductance.len() == if law.conductivity.is_some() { count } else { 0 });
    let all = Loop {
        law,
        // Pointer that is indexed by disc number and never dereferenced below pairs.first. It may point outside of the
        // array, so discs are addressed with wrapping_add: `add` requires a pointer inside.
        discs: discs.as_ptr().wrapping_sub(pairs.first),
        loads: loads.as_mut_ptr().wrapping_sub(pairs.first),
        pairs,
    };
    // SAFETY: the machine has the instruction set; the indices are in first..reach (see [`Pairs`]), which both slices
    // cover.
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
    law: PairLaw,
    discs: *const Disc,
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
    unsafe fn add_any<V: DiscLanes>(self, count: usize) {
        match self.law.conductivity {
            None => unsafe { self.add::<V, false>(count, 0.0) },
            Some(conductivity) => unsafe { self.add::<V, true>(count, conductivity) },
        }
    }

    /// Computes the forces of a whole block of pairs first and then adds them up disc by disc. A single loop would have
    /// to wait for each load that the pair before has just written (37 instead of 31.5 ns per disc and step, 500 discs,
    /// AVX-512).
    #[inline(always)]
    unsafe fn add<V: DiscLanes, const HEAT: bool>(mut self, count: usize, conductivity: f64) {
        let mut forces = Block([[0.0; BLOCK]; 4]);
        for begin in (0..count).step_by(BLOCK) {
            let end = count.min(begin + BLOCK);
            let groups = begin + (end - begin) / V::LANES * V::LANES;
            unsafe {
                for k in (begin..groups).step_by(V::LANES) {
                    self.compute::<V, HEAT>(k, conductivity, forces.at(k - begin));
                }
                for k in groups..end {
                    self.compute::<f64, HEAT>(k, conductivity, forces.at(k - begin));
                }
                for k in (begin..groups).step_by(V::LANES) {
                    self.sum::<V>(k, forces.at(k - begin));
                }
                for k in groups..end {
                    self.sum::<f64>(k, forces.at(k - begin));
                }
            }
        }
    }

    /// Forces of the LANES pairs from `k` on, into the columns `to`.
    #[inline(always)]
    unsafe fn compute<V: DiscLanes, const HEAT: bool>(
        &mut self,
        k: usize,
        conductivity: f64,
        to: [*mut f64; 4],
    ) {
        unsafe {
            let (i, j) = (self.pairs.i.as_ptr().add(k), self.pairs.j.as_ptr().add(k));
            let history = self.pairs.tangential.as_mut_ptr().add(k);
            let a: Columns<V> = V::gather(self.discs, i);
            let b: Columns<V> = V::gather(self.discs, j);
            let zero = V::splat(0.0);
            let force = law::pair_force::<V, HEAT>(&self.law, &a, &b, V::read(history));
            let (tangential, conductance, columns) = match force {
                None => (zero, zero, [zero; 4]),
                Some(force) => {
                    let ([fx, fy], [on_i, on_j]) = (force.on_j, force.torque);
                    (force.tangential, force.conductance, [fx, fy, on_i, on_j])
                }
            };
            tangential.write(history);
            if HEAT {
                (V::splat(conductivity) * conductance).write(self.pairs.conductance.as_mut_ptr().add(k));
            }
            columns[0].write(to[0]);
            columns[1].write(to[1]);
            columns[2].write(to[2]);
            columns[3].write(to[3]);
        }
    }

    /// Adds the columns `from` onto the loads of the LANES pairs from `k` on.
    #[inline(always)]
    unsafe fn sum<V: DiscLanes>(&mut self, k: usize, from: [*mut f64; 4]) {
        unsafe {
            let (i, j) = (self.pairs.i.as_ptr().add(k), self.pairs.j.as_ptr().add(k));
            let force = [V::read(from[0]), V::read(from[1])];
            V::scatter(self.loads, i, j, force, [V::read(from[2]), V::read(from[3])]);
        }
    }
}

/// Pairs in a block: their forces fit into the first-level cache.
const BLOCK: usize = 128;

/// Columns fx, fy, torque on i, torque on j of a block of pairs.
#[repr(C, align(64))]
struct Block([[f64; BLOCK]; 4]);

impl Block {
    /// Where the columns of pair `k` of the block begin.
    #[inline(always)]
    fn at(&mut self, k: usize) -> [*mut f64; 4] {
        let [fx, fy, on_i, on_j] = &mut self.0;
        [&raw mut fx[k], &raw mut fy[k], &raw mut on_i[k], &raw mut on_j[k]]
    }
}
