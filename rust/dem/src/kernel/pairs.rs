//! Contact forces of all pairs.

use super::Simd;
use super::vector::{Columns, Lanes};
#[cfg(target_arch = "x86_64")]
use super::x86::{Avx2, Avx512};
use crate::contacts::PairSlab;
use crate::disc::Disc;
use crate::forces::Load;
use crate::law::{self, PairLaw};

/// Adds the forces of the pairs of a slab to `loads`, whose first element belongs to disc `slab.first`, and updates
/// their friction history.
///
/// For each pair in order, the load of j is added to and then that of i: the sums do not depend on `simd`.
pub(crate) fn add_pairs(simd: Simd, law: PairLaw, discs: &[Disc], slab: PairSlab, loads: &mut [Load]) {
    assert!(slab.reach <= discs.len() && slab.first + loads.len() >= slab.reach);
    assert!(slab.i.len() == slab.j.len() && slab.i.len() == slab.tangential.len() && simd.available());
    let count = slab.i.len();
    let all = Pairs {
        law,
        discs: discs.as_ptr(),
        // Addressed by disc number; never dereferenced below slab.first.
        loads: loads.as_mut_ptr().wrapping_sub(slab.first),
        slab,
    };
    // SAFETY: the machine has the instruction set; the indices of a PairSlab are in first..reach (see
    // PairList::parts), which lies in both slices.
    unsafe {
        match simd {
            Simd::Scalar => all.add::<f64>(count),
            #[cfg(target_arch = "x86_64")]
            Simd::Avx2 => all.add_avx2(count),
            #[cfg(target_arch = "x86_64")]
            Simd::Avx512 => all.add_avx512(count),
            #[cfg(not(target_arch = "x86_64"))]
            _ => unreachable!("not available on this machine"),
        }
    }
}

struct Pairs<'a> {
    law: PairLaw,
    discs: *const Disc,
    loads: *mut Load,
    slab: PairSlab<'a>,
}

impl Pairs<'_> {
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    unsafe fn add_avx2(self, count: usize) {
        unsafe { self.add::<Avx2>(count) }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512dq")]
    unsafe fn add_avx512(self, count: usize) {
        unsafe { self.add::<Avx512>(count) }
    }

    /// Forces of a block of pairs first, then their sums disc by disc: one loop would wait for each load that a pair
    /// before it has just written (37 against 31.5 ns a disc and step, 500 discs, AVX-512).
    #[inline(always)]
    unsafe fn add<V: Lanes>(mut self, count: usize) {
        let mut forces = Block([[0.0; BLOCK]; 4]);
        for begin in (0..count).step_by(BLOCK) {
            let end = count.min(begin + BLOCK);
            let groups = begin + (end - begin) / V::LANES * V::LANES;
            unsafe {
                for k in (begin..groups).step_by(V::LANES) {
                    self.compute::<V>(k, forces.at(k - begin));
                }
                for k in groups..end {
                    self.compute::<f64>(k, forces.at(k - begin));
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
    unsafe fn compute<V: Lanes>(&mut self, k: usize, to: [*mut f64; 4]) {
        unsafe {
            let (i, j) = (self.slab.i.as_ptr().add(k), self.slab.j.as_ptr().add(k));
            let history = self.slab.tangential.as_mut_ptr().add(k);
            let a: Columns<V> = V::gather(self.discs, i);
            let b: Columns<V> = V::gather(self.discs, j);
            let zero = V::splat(0.0);
            let (tangential, columns) = match law::pair_force(&self.law, &a, &b, V::read(history)) {
                None => (zero, [zero; 4]),
                Some(force) => {
                    let ([fx, fy], [on_i, on_j]) = (force.on_j, force.torque);
                    (force.tangential, [fx, fy, on_i, on_j])
                }
            };
            tangential.write(history);
            columns[0].write(to[0]);
            columns[1].write(to[1]);
            columns[2].write(to[2]);
            columns[3].write(to[3]);
        }
    }

    /// Adds the columns `from` onto the loads of the LANES pairs from `k` on.
    #[inline(always)]
    unsafe fn sum<V: Lanes>(&mut self, k: usize, from: [*mut f64; 4]) {
        unsafe {
            let (i, j) = (self.slab.i.as_ptr().add(k), self.slab.j.as_ptr().add(k));
            let force = [V::read(from[0]), V::read(from[1])];
            V::scatter(self.loads, i, j, force, [V::read(from[2]), V::read(from[3])]);
        }
    }
}

/// Pairs in a block: its forces stay in the first-level cache.
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
