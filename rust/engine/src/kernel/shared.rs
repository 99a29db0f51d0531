//! One array of grains used by several threads. Each thread writes the grains of its own rows, and also reads grains of
//! other threads' rows that no thread writes.

use super::fetch::{Cache, fetch};
use crate::rows::Slab;
use std::marker::PhantomData;
use std::ops::Range;

/// The grains as one slab sees them.
///
/// A slab (consecutive rows, the work of one thread) writes the rows that no pair of an earlier slab refers to, and
/// reads all grains up to its own reach. No slab reads what another slab writes; [`SharedGrains::divide`] checks this.
pub struct SharedGrains<'a, G> {
    first: *mut G,
    read: Range<usize>,
    write: Range<usize>,
    grains: PhantomData<&'a mut [G]>,
}

// SAFETY: no slab reads or writes what another slab writes, and grains are plain data.
unsafe impl<G: Copy + Send + Sync> Send for SharedGrains<'_, G> {}

impl<'a, G: Copy> SharedGrains<'a, G> {
    /// One view of the grains per slab.
    ///
    /// # Panics
    /// When the slabs are not such a division of the array.
    pub fn divide(grains: &'a mut [G], slabs: &[Slab]) -> Vec<Self> {
        let (first, count) = (grains.as_mut_ptr(), grains.len());
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
        let view = |slab| Self { first, read: read(slab), write: write(slab), grains: PhantomData };
        slabs.iter().map(view).collect()
    }

    /// The rows that this slab may write.
    pub fn own(&self) -> Range<usize> {
        self.write.clone()
    }

    /// Grains of rows that this slab may read.
    ///
    /// # Panics
    /// When it may not.
    pub fn rows(&self, rows: Range<usize>) -> &[G] {
        assert!(self.read.start <= rows.start && rows.start <= rows.end && rows.end <= self.read.end);
        // SAFETY: inside the array; nobody but this view writes there, and it is borrowed.
        unsafe { std::slice::from_raw_parts(self.first.add(rows.start), rows.len()) }
    }

    /// Asks for grains that will soon be read, as far as this slab may read them.
    pub fn fetch(&self, rows: Range<usize>) {
        for row in rows.start.max(self.read.start)..rows.end.min(self.read.end) {
            fetch(self.first.wrapping_add(row).cast_const(), Cache::Second);
        }
    }

    /// Grains of rows that this slab may write.
    ///
    /// # Panics
    /// When it may not.
    pub fn rows_mut(&mut self, rows: Range<usize>) -> &mut [G] {
        assert!(self.write.start <= rows.start && rows.start <= rows.end && rows.end <= self.write.end);
        // SAFETY: inside the array; no other view reads or writes there, and this one is borrowed for it.
        unsafe { std::slice::from_raw_parts_mut(self.first.add(rows.start), rows.len()) }
    }
}
