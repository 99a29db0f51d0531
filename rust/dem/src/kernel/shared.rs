//! One array of discs used by several threads. Each thread writes the discs of its own rows, and also reads discs of
//! other threads' rows that no thread writes.

use crate::contacts::Slab;
use crate::disc::Disc;
use std::marker::PhantomData;
use std::ops::Range;

/// The discs as one slab sees them.
///
/// A slab (consecutive rows, the work of one thread) writes the rows that no pair of an earlier slab refers to, and
/// reads all discs up to its own reach. No slab reads what another slab writes; [`SharedDiscs::divide`] checks this.
pub(crate) struct SharedDiscs<'a> {
    first: *mut Disc,
    read: Range<usize>,
    write: Range<usize>,
    discs: PhantomData<&'a mut [Disc]>,
}

// SAFETY: no slab reads or writes what another slab writes, and a disc is plain data.
unsafe impl Send for SharedDiscs<'_> {}

impl<'a> SharedDiscs<'a> {
    /// One view of the discs per slab.
    pub fn divide(discs: &'a mut [Disc], slabs: &[Slab]) -> Vec<Self> {
        let (first, count) = (discs.as_mut_ptr(), discs.len());
        let read = |slab: &Slab| slab.rows.start..slab.reach;
        let write = |slab: &Slab| slab.shared..slab.rows.end;
        for (s, slab) in slabs.iter().enumerate() {
            let (own, to_write) = (read(slab), write(slab));
            assert!(own.start <= to_write.start && to_write.end <= own.end && own.end <= count);
            for (_, other) in slabs.iter().enumerate().filter(|&(t, _)| t != s) {
                let foreign = write(other);
                assert!(foreign.is_empty() || foreign.end <= own.start || own.end <= foreign.start);
            }
        }
        let view = |slab| Self { first, read: read(slab), write: write(slab), discs: PhantomData };
        slabs.iter().map(view).collect()
    }

    /// The rows that this slab may write.
    pub fn own(&self) -> Range<usize> {
        self.write.clone()
    }

    pub fn rows(&self, rows: Range<usize>) -> &[Disc] {
        assert!(self.read.start <= rows.start && rows.start <= rows.end && rows.end <= self.read.end);
        // SAFETY: inside the array; nobody but this view writes there, and it is borrowed.
        unsafe { std::slice::from_raw_parts(self.first.add(rows.start), rows.len()) }
    }

    pub fn rows_mut(&mut self, rows: Range<usize>) -> &mut [Disc] {
        assert!(self.write.start <= rows.start && rows.start <= rows.end && rows.end <= self.write.end);
        // SAFETY: inside the array; no other view reads or writes there, and this one is borrowed for it.
        unsafe { std::slice::from_raw_parts_mut(self.first.add(rows.start), rows.len()) }
    }
}
