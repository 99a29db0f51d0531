//! Columns of the caller: arrays with one value per cell. They are raw pointers and not slices, because a caller may pass
//! the same column as input and output.

use crate::status::Failure;
use msdd_surrogate::kernel::{LANES, Lanes};
use msdd_surrogate::network::padded;

/// A readable column of the caller.
#[derive(Clone, Copy)]
pub(crate) struct Input<'a> {
    pub name: &'a str,
    start: *const f64,
    length: usize,
}

/// A writable column of the caller, or NULL when the output is not wanted.
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

    /// The cells of a block from `first` on.
    pub fn lanes(&self, first: usize) -> Lanes {
        if first + LANES <= self.length {
            // SAFETY: in bounds, and readable by the contract of `new`; an array is aligned as its elements are.
            return unsafe { self.start.add(first).cast::<Lanes>().read() };
        }
        padded(self.length - first, |lane| self.at(first + lane))
    }

    /// First cell whose value satisfies `is`. Tests whole blocks without branches, since there usually is no such value.
    pub fn position(&self, is: impl Fn(f64) -> bool) -> Option<usize> {
        let hit = |first: &usize| self.lanes(*first).into_iter().fold(false, |hit, value| hit | is(value));
        let first = (0..self.length).step_by(LANES).find(hit)?;
        (first..self.length).find(|&cell| is(self.at(cell)))
    }

    /// Refuses values outside of a range, whose ends belong to it.
    pub fn check_range(&self, low: f64, high: f64, allowed: &str) -> Result<(), Failure> {
        match self.position(|value| !(low <= value && value <= high)) {
            None => Ok(()),
            Some(cell) => Err(Failure::number(format!("{}[{cell}]", self.name), self.at(cell), allowed)),
        }
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
        if first + LANES <= self.length {
            // SAFETY: in bounds, and writable by the contract of `new`; an array is aligned as its elements are.
            return unsafe { self.start.add(first).cast::<[T; LANES]>().write(*values) };
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Tries every length around that of a block, and every place in it. Miri runs this test, too.
    #[test]
    fn columns_read_and_write_their_cells_and_no_others() {
        for length in 0..20 {
            let values: Vec<f64> = (0..length).map(|i| i as f64 + 0.5).collect();
            let mut written = vec![-7.0; length + 1];
            // SAFETY: as many values; the last of `written` is not part of the column.
            let (input, output) = unsafe {
                (
                    Input::new("x", values.as_ptr(), length).expect("not null"),
                    Output::new(written.as_mut_ptr(), length),
                )
            };
            for first in (0..length).step_by(LANES) {
                output.write(first, &input.lanes(first));
            }
            assert!(written[..length] == values && written[length] == -7.0);
            output.write_all(&vec![1.0; length]);
            if length > 0 {
                output.write_one(length - 1, 2.0);
                assert_eq!((written[length - 1], input.at(length - 1)), (2.0, length as f64 - 0.5));
            }
            // SAFETY: nobody writes to `values`.
            assert_eq!(unsafe { input.slice() }, values);
            assert!(input.check_finite().is_ok() && input.position(|v| v > 3.0) == (length > 3).then_some(3));
        }
    }

    #[test]
    fn one_column_may_be_input_and_output() {
        let mut column: Vec<f64> = (0..13).map(f64::from).collect();
        let start = column.as_mut_ptr();
        // SAFETY: thirteen values, which nobody else touches.
        let (input, output) =
            unsafe { (Input::new("x", start, 13).expect("not null"), Output::new(start, 13)) };
        for first in (0..13).step_by(LANES) {
            output.write(first, &input.lanes(first).map(|value| 2.0 * value));
        }
        assert_eq!(column, (0..13).map(|i| f64::from(2 * i)).collect::<Vec<f64>>());
    }

    #[test]
    fn null_is_no_column_but_of_no_cells() {
        // SAFETY: null.
        let (none, empty) =
            unsafe { (Input::new("x", std::ptr::null(), 3), Input::new("x", std::ptr::null(), 0)) };
        assert!(none.is_err_and(|error| error.to_string() == "x is NULL"));
        // SAFETY: empty; null outputs are not written.
        unsafe {
            assert!(empty.expect("empty").slice().is_empty());
            Output::<f64>::new(std::ptr::null_mut(), 3).write(0, &[1.0; LANES]);
            Output::<u8>::new(std::ptr::null_mut(), 2).write_all(&[1, 2]);
        }
    }
}
