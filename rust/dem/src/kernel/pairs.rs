//! Contact forces of all pairs.

use super::Simd;
use super::vector::{Columns, Lanes};
#[cfg(target_arch = "x86_64")]
use super::x86::{Avx2, Avx512};
use crate::contacts::PairList;
use crate::disc::Disc;
use crate::forces::Load;
use crate::law::{self, PairLaw};
use std::ops::Range;

/// Adds the forces of the pairs `range` of `pairs` to `loads` and updates their friction history.
///
/// For each pair in order, `loads[j]` is added to and then `loads[i]`: the sums do not depend on `simd`.
pub(crate) fn add_pairs(
    simd: Simd,
    law: PairLaw,
    discs: &[Disc],
    pairs: &mut PairList,
    range: Range<usize>,
    loads: &mut [Load],
) {
    assert!(range.end <= pairs.len() && pairs.discs() == discs.len() && loads.len() == discs.len());
    assert!(simd.available());
    let all = Pairs { law, discs: discs.as_ptr(), loads: loads.as_mut_ptr(), pairs };
    // SAFETY: the machine has the instruction set; the indices of a PairList are below discs(), which is the length
    // of both slices.
    unsafe {
        match simd {
            Simd::Scalar => all.add::<f64>(range),
            #[cfg(target_arch = "x86_64")]
            Simd::Avx2 => all.add_avx2(range),
            #[cfg(target_arch = "x86_64")]
            Simd::Avx512 => all.add_avx512(range),
            #[cfg(not(target_arch = "x86_64"))]
            _ => unreachable!("not available on this machine"),
        }
    }
}

struct Pairs<'a> {
    law: PairLaw,
    discs: *const Disc,
    loads: *mut Load,
    pairs: &'a mut PairList,
}

impl Pairs<'_> {
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    unsafe fn add_avx2(self, range: Range<usize>) {
        unsafe { self.add::<Avx2>(range) }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512dq")]
    unsafe fn add_avx512(self, range: Range<usize>) {
        unsafe { self.add::<Avx512>(range) }
    }

    /// Groups of LANES pairs, then the rest one by one.
    #[inline(always)]
    unsafe fn add<V: Lanes>(mut self, range: Range<usize>) {
        let groups = range.start + range.len() / V::LANES * V::LANES;
        unsafe {
            for k in (range.start..groups).step_by(V::LANES) {
                self.add_group::<V>(k);
            }
            for k in groups..range.end {
                self.add_group::<f64>(k);
            }
        }
    }

    #[inline(always)]
    unsafe fn add_group<V: Lanes>(&mut self, k: usize) {
        unsafe {
            let (i, j) = (self.pairs.i().as_ptr().add(k), self.pairs.j().as_ptr().add(k));
            let history = self.pairs.tangential.as_mut_ptr().add(k);
            let a: Columns<V> = V::gather(self.discs, i);
            let b: Columns<V> = V::gather(self.discs, j);
            match law::pair_force(&self.law, &a, &b, V::read(history)) {
                None => V::splat(0.0).write(history),
                Some(force) => {
                    force.tangential.write(history);
                    V::scatter(self.loads, i, j, force.on_j, force.torque);
                }
            }
        }
    }
}
