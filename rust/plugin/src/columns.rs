//! Columns (arrays with one value per cell) that are passed to a plug-in: copies of the inputs, and outputs of our own.

/// Copies of a caller's columns. A plug-in that writes to its inputs, which it must not, changes only these copies.
pub(crate) struct Inputs {
    /// All columns, one after the other. They are kept here only because the plug-in reads them through the pointers.
    _values: Vec<f64>,
    pointers: Vec<*const f64>,
}

impl Inputs {
    /// # Panics
    /// When columns differ in length from `cells`.
    pub fn new(columns: &[&[f64]], cells: usize) -> Self {
        check_lengths(columns, cells);
        let mut values = Vec::with_capacity(columns.len() * cells);
        columns.iter().for_each(|column| values.extend_from_slice(column));
        let start: *mut f64 = values.as_mut_ptr();
        let pointers = (0..columns.len()).map(|k| start.wrapping_add(k * cells).cast_const()).collect();
        Self { _values: values, pointers }
    }

    /// Starts of the columns.
    pub fn pointers(&self) -> *const *const f64 {
        self.pointers.as_ptr()
    }

    /// Start of one column.
    pub fn pointer(&self, column: usize) -> *const f64 {
        self.pointers[column]
    }
}

/// A column of NaN for a plug-in to fill in: values that it does not write are found, because NaN is refused.
pub(crate) fn unwritten(cells: usize) -> Vec<f64> {
    vec![f64::NAN; cells]
}

pub(crate) fn pointers(columns: &mut [Vec<f64>]) -> Vec<*mut f64> {
    columns.iter_mut().map(|column| column.as_mut_ptr()).collect()
}

pub(crate) fn check_lengths(columns: &[&[f64]], cells: usize) {
    assert!(columns.iter().all(|column| column.len() == cells), "columns of {cells} values");
}
