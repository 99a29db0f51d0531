//! A caller's columns. Raw pointers, not slices, because a caller may pass one column as input and output.

use crate::status::Failure;
use msdd_surrogate::kernel::{LANES, Lanes};
use msdd_surrogate::network::padded;

/// A readable column of the caller's.
#[derive(Clone, Copy)]
pub(crate) struct Input<'a> {
    pub name: &'a str,
    start: *const f64,
    length: usize,
}

/// A writable column of the caller's, or none.
#[derive(Clone, Copy)]
pub(crate) struct Output<T> {
    start: *mut T,
    length: usize,
}

impl<'a> Input<'a> {
    /// # Safety
    /// `start`, unless null, points to `length` values that stay readable while the column is in use.
    pub unsafe fn new(name: &'a str, start: *const f64, length: usize) -> Result<Self, Failure> {
        // A batch of no cells may come without columns.
        if start.is_null() && length > 0 {
            Err(Failure::Null(name.to_string()))
        } else {
            Ok(Self { name, start, length })
        }
    }

    pub fn length(&self) -> usize {
        self.length
    }

    /// All of the column.
    ///
    /// # Safety
    /// Nobody writes to the column while the slice is in use.
    pub unsafe fn slice(&self) -> &[f64] {
        match self.start.is_null() {
            true => &[],
            // SAFETY: readable by the contract of `new`, and not written to by this function's.
            false => unsafe { std::slice::from_raw_parts(self.start, self.length) },
        }
    }

    /// Value of one cell. Out of bounds is a bug and panics.
    pub fn at(&self, cell: usize) -> f64 {
        assert!(cell < self.length);
        // SAFETY: in bounds, and readable by the contract of `new`. Any bits are an f64.
        unsafe { self.start.add(cell).read() }
    }

    /// Up to eight cells from `first` on.
    pub fn lanes(&self, first: usize) -> Lanes {
        if first + LANES <= self.length {
            // SAFETY: in bounds, and readable by the contract of `new`; an array is aligned as its elements are.
            return unsafe { self.start.add(first).cast::<Lanes>().read() };
        }
        padded(self.length - first, |lane| self.at(first + lane))
    }

    /// First cell whose value is so.
    pub fn position(&self, is: impl Fn(f64) -> bool) -> Option<usize> {
        (0..self.length).find(|&cell| is(self.at(cell)))
    }

    /// Refuses NaN and infinity.
    pub fn check_finite(&self) -> Result<(), Failure> {
        match self.position(|value| !value.is_finite()) {
            None => Ok(()),
            Some(index) => {
                Err(Failure::NonFinite { column: self.name.to_string(), index, value: self.at(index) })
            }
        }
    }
}

impl<T: Copy> Output<T> {
    /// # Safety
    /// `start`, unless null, points to `length` values that stay writable while the column is in use, and no other
    /// thread touches them.
    pub unsafe fn new(start: *mut T, length: usize) -> Self {
        Self { start, length }
    }

    /// Whether the caller gave the column.
    pub fn is_wanted(&self) -> bool {
        !self.start.is_null()
    }

    /// Writes one cell. Out of bounds is a bug and panics.
    pub fn write_one(&self, cell: usize, value: T) {
        assert!(cell < self.length);
        if !self.start.is_null() {
            // SAFETY: in bounds, and writable by the contract of `new`.
            unsafe { self.start.add(cell).write(value) };
        }
    }

    /// Writes the cells from `first` on; values beyond the column's end are padding.
    pub fn write(&self, first: usize, values: &[T; LANES]) {
        if self.start.is_null() {
            return;
        }
        let count = self.length.saturating_sub(first).min(LANES);
        // SAFETY: `count` values from `first` on lie inside the column, writable by the contract of `new`; `values` is
        // ours, so the two do not overlap.
        unsafe { self.start.add(first).copy_from_nonoverlapping(values.as_ptr(), count) };
    }

    /// Writes the whole column.
    pub fn write_all(&self, values: &[T]) {
        assert_eq!(values.len(), self.length);
        if !self.start.is_null() {
            // SAFETY: as many values as the column has, writable by the contract of `new`; `values` is ours, so the two do
            // not overlap.
            unsafe { self.start.copy_from_nonoverlapping(values.as_ptr(), self.length) };
        }
    }
}
