//! Columns of the caller: one value per cell, at a stride. They are raw pointers and not slices, because a caller may pass the
//! same column as input and output, and columns may interleave, like the components in an array of tensors.

use crate::abi::{msdd_input, msdd_output};
use crate::status::Failure;
use msdd_surrogate::kernel::{LANES, Lanes};
use msdd_surrogate::network::padded;

/// A readable column of the caller.
#[derive(Clone, Copy)]
pub(crate) struct Input<'a> {
    pub name: &'a str,
    start: *const f64,
    stride: usize,
    length: usize,
}

/// A writable column of the caller, or NULL when the output is not wanted.
#[derive(Clone, Copy)]
pub(crate) struct Output<T> {
    pub name: &'static str,
    start: *mut T,
    stride: usize,
    length: usize,
}

/// Refuses numbers of cells whose columns cannot fit into memory: pointers to the end of a column would wrap around.
pub(crate) fn check_length(cells: usize) -> Result<(), Failure> {
    match cells > isize::MAX as usize / size_of::<f64>() {
        true => Err(Failure::argument("cells", cells, "number of cells")),
        false => Ok(()),
    }
}

/// Refuses a stride of 0, and one with which the column would not fit into memory.
fn check_stride(name: &str, stride: usize, length: usize) -> Result<(), Failure> {
    let longest = isize::MAX as usize / size_of::<f64>();
    match stride > 0 && (length <= 1 || stride <= longest / length) {
        true => Ok(()),
        false => Err(Failure::argument(
            format!("{name}.stride"),
            stride,
            "1 or more, in doubles, so that the column fits into memory",
        )),
    }
}

impl<'a> Input<'a> {
    /// # Safety
    /// The column, unless null, has `length` values at its stride that stay readable while it is in use.
    pub unsafe fn new(name: &'a str, column: msdd_input, length: usize) -> Result<Self, Failure> {
        // A batch of no cells may come without columns.
        if length > 0 {
            if column.values.is_null() {
                return Err(Failure::null(name));
            }
            check_stride(name, column.stride, length)?;
        }
        Ok(Self { name, start: column.values, stride: column.stride, length })
    }

    /// As [`Input::new`]; None for null.
    ///
    /// # Safety
    /// As for [`Input::new`].
    pub unsafe fn optional(
        name: &'a str,
        column: msdd_input,
        length: usize,
    ) -> Result<Option<Self>, Failure> {
        match column.values.is_null() {
            true => Ok(None),
            // SAFETY: by this function's contract.
            false => unsafe { Self::new(name, column, length) }.map(Some),
        }
    }

    /// A column of stride 1.
    ///
    /// # Safety
    /// As for [`Input::new`].
    pub unsafe fn contiguous(name: &'a str, values: *const f64, length: usize) -> Result<Self, Failure> {
        // SAFETY: by this function's contract.
        unsafe { Self::new(name, msdd_input { values, stride: 1 }, length) }
    }

    pub fn length(&self) -> usize {
        self.length
    }

    /// A copy of all of the column.
    pub fn to_vec(self) -> Vec<f64> {
        (0..self.length).map(|cell| self.at(cell)).collect()
    }

    /// Value of one cell. Out of bounds is a bug and panics.
    pub fn at(&self, cell: usize) -> f64 {
        assert!(cell < self.length);
        // SAFETY: in bounds, and readable by the contract of `new`. Any bits are an f64.
        unsafe { self.start.add(cell * self.stride).read() }
    }

    /// The cells of a block from `first` on.
    pub fn lanes(&self, first: usize) -> Lanes {
        if first + LANES > self.length {
            return padded(self.length - first, |lane| self.at(first + lane));
        }
        if self.stride == 1 {
            // SAFETY: in bounds, and readable by the contract of `new`; an array is aligned as its elements are.
            return unsafe { self.start.add(first).cast::<Lanes>().read() };
        }
        // SAFETY: in bounds, and readable by the contract of `new`.
        std::array::from_fn(|lane| unsafe { self.start.add((first + lane) * self.stride).read() })
    }

    /// First cell whose value satisfies `is`. Tests whole blocks without branches, since there usually is no such value.
    pub fn position(&self, is: impl Fn(f64) -> bool) -> Option<usize> {
        let hit = |first: &usize| self.lanes(*first).into_iter().fold(false, |hit, value| hit | is(value));
        let first = (0..self.length).step_by(LANES).find(hit)?;
        (first..self.length).find(|&cell| is(self.at(cell)))
    }

    /// Refuses values outside of a range, whose ends belong to it, NaN and infinity.
    pub fn check_range(&self, low: f64, high: f64, allowed: &str) -> Result<(), Failure> {
        self.refuse(|value| !(low <= value && value <= high), allowed)
    }

    /// As [`Input::check_range`]; the lower end does not belong to the range.
    pub fn check_above(&self, low: f64, high: f64, allowed: &str) -> Result<(), Failure> {
        self.refuse(|value| !(low < value && value <= high), allowed)
    }

    fn refuse(&self, is: impl Fn(f64) -> bool, allowed: &str) -> Result<(), Failure> {
        match self.position(is) {
            None => Ok(()),
            Some(cell) if self.at(cell).is_finite() => {
                Err(Failure::number(format!("{}[{cell}]", self.name), self.at(cell), allowed))
            }
            Some(_) => self.check_finite(),
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

    /// Where its values are.
    pub fn place(&self) -> Place<'_> {
        Place::new(self.name, self.start.addr(), self.stride, self.length, false)
    }
}

impl Output<f64> {
    /// # Safety
    /// The column, unless null, has `length` values at its stride that stay writable while it is in use, and no other thread
    /// touches them.
    pub unsafe fn new(name: &'static str, column: msdd_output, length: usize) -> Result<Self, Failure> {
        if !column.values.is_null() && length > 0 {
            check_stride(name, column.stride, length)?;
        }
        Ok(Self { name, start: column.values, stride: column.stride, length })
    }
}

impl<T: Copy> Output<T> {
    /// # Safety
    /// `start`, unless null, points to `length` values that stay writable while the column is in use, and no other
    /// thread touches them.
    pub unsafe fn contiguous(name: &'static str, start: *mut T, length: usize) -> Self {
        Self { name, start, stride: 1, length }
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
            unsafe { self.start.add(cell * self.stride).write(value) };
        }
    }

    /// Writes the cells from `first` on; values beyond the column's end are padding.
    pub fn write(&self, first: usize, values: &[T; LANES]) {
        if self.start.is_null() {
            return;
        }
        if self.stride == 1 && first + LANES <= self.length {
            // SAFETY: in bounds, and writable by the contract of `new`; an array is aligned as its elements are.
            return unsafe { self.start.add(first).cast::<[T; LANES]>().write(*values) };
        }
        let count = self.length.saturating_sub(first).min(LANES);
        for (lane, value) in values[..count].iter().enumerate() {
            // SAFETY: in bounds, and writable by the contract of `new`.
            unsafe { self.start.add((first + lane) * self.stride).write(*value) };
        }
    }

    /// Writes the whole column.
    pub fn write_all(&self, values: &[T]) {
        assert_eq!(values.len(), self.length);
        values.iter().enumerate().for_each(|(cell, value)| self.write_one(cell, *value));
    }

    /// Where its values are.
    pub fn place(&self) -> Place<'_> {
        Place {
            size: size_of::<T>(),
            ..Place::new(self.name, self.start.addr(), self.stride, self.length, true)
        }
    }
}

/// Where the values of a column are.
#[derive(Clone, Copy)]
pub(crate) struct Place<'a> {
    name: &'a str,
    start: usize,
    stride: usize,
    length: usize,
    size: usize,
    is_output: bool,
}

impl<'a> Place<'a> {
    fn new(name: &'a str, start: usize, stride: usize, length: usize, is_output: bool) -> Self {
        Self {
            name,
            start,
            stride,
            length: if start == 0 { 0 } else { length },
            size: size_of::<f64>(),
            is_output,
        }
    }

    fn step(&self) -> usize {
        self.stride * self.size
    }

    /// The first byte behind the column.
    fn end(&self) -> usize {
        self.start + (self.length - 1) * self.step() + self.size
    }

    /// Whether the two have a byte in common. Columns of different strides whose ranges meet are taken as overlapping.
    fn meets(&self, other: &Self) -> bool {
        let apart = other.start >= self.end() || self.start >= other.end();
        let step = self.step();
        let between = || {
            let offset = self.start.abs_diff(other.start) % step;
            step == other.step() && offset >= self.size && offset + other.size <= step
        };
        !apart && !between()
    }
}

/// Columns of a call with all outputs, about.
const MANY: usize = 192;

/// Refuses outputs that overlap each other, or an input without being the same column.
pub(crate) fn check_apart<'a>(places: impl Iterator<Item = Place<'a>>) -> Result<(), Failure> {
    // The check is a part of each call: starts and numbers alone are sorted, in memory that is taken once.
    let mut all: Vec<Place> = Vec::with_capacity(MANY);
    all.extend(places.filter(|place| place.length > 0));
    let mut order: Vec<(usize, usize)> = Vec::with_capacity(all.len());
    order.extend(all.iter().enumerate().map(|(k, place)| (place.start, k)));
    order.sort_unstable();
    for (n, &(_, k)) in order.iter().enumerate() {
        let (one, end) = (&all[k], all[k].end());
        for &(_, other) in order[n + 1..].iter().take_while(|(start, _)| *start < end) {
            let other = &all[other];
            let same = (one.start, one.step()) == (other.start, other.step());
            let allowed = match one.is_output as u8 + other.is_output as u8 {
                0 => true,
                1 => same,
                _ => false,
            };
            if !allowed && one.meets(other) {
                let (output, with) = if one.is_output { (one, other) } else { (other, one) };
                let allowed = "columns without common values; an output may be exactly an input's column";
                return Err(Failure::argument(output.name, format!("overlapping {}", with.name), allowed));
            }
        }
    }
    Ok(())
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
                    Input::contiguous("x", values.as_ptr(), length).expect("not null"),
                    Output::contiguous("y", written.as_mut_ptr(), length),
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
            assert_eq!(input.to_vec(), values);
            assert!(input.check_finite().is_ok() && input.position(|v| v > 3.0) == (length > 3).then_some(3));
        }
    }

    #[test]
    fn one_column_may_be_input_and_output() {
        let mut column: Vec<f64> = (0..13).map(f64::from).collect();
        let start = column.as_mut_ptr();
        // SAFETY: thirteen values, which nobody else touches.
        let (input, output) = unsafe {
            (Input::contiguous("x", start, 13).expect("not null"), Output::contiguous("y", start, 13))
        };
        for first in (0..13).step_by(LANES) {
            output.write(first, &input.lanes(first).map(|value| 2.0 * value));
        }
        assert_eq!(column, (0..13).map(|i| f64::from(2 * i)).collect::<Vec<f64>>());
    }

    #[test]
    fn null_is_no_column_but_of_no_cells() {
        // SAFETY: null.
        let (none, empty) = unsafe {
            (Input::contiguous("x", std::ptr::null(), 3), Input::contiguous("x", std::ptr::null(), 0))
        };
        assert!(none.is_err_and(|error| error.to_string() == "x is NULL"));
        // SAFETY: empty; null outputs are not written.
        unsafe {
            assert!(empty.expect("empty").to_vec().is_empty());
            Output::<f64>::contiguous("y", std::ptr::null_mut(), 3).write(0, &[1.0; LANES]);
            Output::<u8>::contiguous("y", std::ptr::null_mut(), 2).write_all(&[1, 2]);
        }
    }

    /// Strided columns touch their own cells alone, at each length around that of a block.
    #[test]
    fn strided_columns_interleave() {
        for length in 1..20 {
            let mut memory = vec![-7.0; 3 * length];
            let start = memory.as_mut_ptr();
            for part in [2, 0] {
                // SAFETY: inside of `memory`, which nobody else touches.
                let (input, output) = unsafe {
                    let place = start.add(part);
                    (
                        Input::new("x", msdd_input { values: place, stride: 3 }, length).expect("good"),
                        Output::new("y", msdd_output { values: place, stride: 3 }, length).expect("good"),
                    )
                };
                for first in (0..length).step_by(LANES) {
                    output.write(first, &std::array::from_fn(|lane| (first + lane + part) as f64));
                    assert_eq!(input.lanes(first)[0], (first + part) as f64);
                }
                assert_eq!(input.to_vec(), (0..length).map(|i| (i + part) as f64).collect::<Vec<f64>>());
            }
            assert!((0..length).all(|i| memory[3 * i + 1] == -7.0 && memory[3 * i] == i as f64));
        }
    }
}
