//! Values of cells at the start, given by a caller and checked.

use crate::abi::msdd_start;
use crate::columns::{Input, check_length};
use crate::si::LARGEST_STRESS;
use crate::status::Failure;
use crate::step::{components, inputs, optional_inputs};

/// Columns of cells at the start. Lists that the caller does not give are empty, otherwise they have a column for each component.
pub(crate) struct Start<'a> {
    pub cells: usize,
    pub porosity: Option<Input<'a>>,
    pub solid_fraction: Option<Input<'a>>,
    pub fabric_index: Option<Input<'a>>,
    pub fabric_xy: Option<Input<'a>>,
    /// \[Pa\]
    pub stress: Vec<Option<Input<'a>>>,
    /// \[W/(m K)\]
    pub conductivity: Vec<Option<Input<'a>>>,
    pub fabric: Vec<Input<'a>>,
    pub coordination: Option<Input<'a>>,
    pub mobilised: Option<Input<'a>>,
}

impl<'a> Start<'a> {
    /// # Safety
    /// The columns, unless null, have `cells` values, and the tables one column for each component.
    pub unsafe fn new(given: &msdd_start, of_model: usize) -> Result<Self, Failure> {
        let cells = given.cells;
        let parts = components(given.components, of_model)?;
        check_length(cells)?;
        // SAFETY: the columns are as this function's contract says.
        let start = unsafe {
            Self {
                cells,
                porosity: Input::optional("porosity", given.porosity, cells)?,
                solid_fraction: Input::optional("solid_fraction", given.solid_fraction, cells)?,
                fabric_index: Input::optional("fabric_index", given.fabric_index, cells)?,
                fabric_xy: Input::optional("fabric_xy", given.fabric_xy, cells)?,
                stress: optional_inputs(parts.stress.iter().copied(), given.stress, cells)?,
                conductivity: optional_inputs(parts.conductivity.iter().copied(), given.conductivity, cells)?,
                fabric: match given.fabric.is_null() {
                    true => Vec::new(),
                    false => inputs(parts.fabric.iter().copied(), given.fabric, cells)?,
                },
                coordination: Input::optional("coordination", given.coordination, cells)?,
                mobilised: Input::optional("mobilised", given.mobilised, cells)?,
            }
        };
        start.check()?;
        Ok(start)
    }

    fn check(&self) -> Result<(), Failure> {
        let ranges: [(&Option<Input>, f64, f64, &str); 6] = [
            (&self.porosity, 0.0, 1.0, "0 to 1"),
            (&self.solid_fraction, 0.3, 0.8, "0.3 to 0.8"),
            (&self.fabric_index, -1.0, 1.0, "-1 to 1"),
            (&self.fabric_xy, -1.0, 1.0, "-1 to 1"),
            (&self.coordination, 0.0, 12.0, "0 to 12"),
            (&self.mobilised, 0.0, 1.0, "0 to 1"),
        ];
        for (column, low, high, allowed) in ranges {
            if let Some(column) = column {
                column.check_range(low, high, allowed)?;
            }
        }
        for column in self.stress.iter().flatten() {
            column.check_range(-LARGEST_STRESS, LARGEST_STRESS, "-1e30 to 1e30 Pa")?;
        }
        for column in self.conductivity.iter().flatten() {
            let (low, allowed) = match column.name.ends_with("[xx]") || column.name.ends_with("[yy]") {
                true => (f64::MIN_POSITIVE, "above 0, to 1e30 W/(m K)"),
                false => (-LARGEST_STRESS, "-1e30 to 1e30 W/(m K)"),
            };
            column.check_range(low, LARGEST_STRESS, allowed)?;
        }
        for column in &self.fabric {
            column.check_range(-1.0, 1.0, "-1 to 1")?;
        }
        Ok(())
    }

    /// A column that a model needs.
    pub fn needed(column: &Option<Input<'a>>, name: &str, cells: usize) -> Result<Input<'a>, Failure> {
        match column {
            Some(column) => Ok(*column),
            // SAFETY: without cells nothing is read.
            None if cells == 0 => unsafe {
                Input::new("", crate::abi::msdd_input { values: std::ptr::null(), stride: 1 }, 0)
            },
            None => Err(Failure::null(name)),
        }
    }
}

/// Columns of a tensor in the plane: xx and yy, and xy if it is given.
pub(crate) type InPlane<'a> = ([Input<'a>; 2], Option<Input<'a>>);

/// The components xx, yy and xy of a tensor in the plane: xx and yy both or none, xy 0 unless given. None if nothing is given.
pub(crate) fn in_plane<'a>(
    name: &str,
    columns: &[Option<Input<'a>>],
) -> Result<Option<InPlane<'a>>, Failure> {
    match columns {
        [] | [None, None, None] => Ok(None),
        [Some(xx), Some(yy), xy] => Ok(Some(([*xx, *yy], *xy))),
        [None, None, Some(xy)] => {
            let allowed = format!("NULL without {name}[xx] and {name}[yy]");
            Err(Failure::argument(xy.name, "not NULL", allowed))
        }
        _ => Err(Failure::argument(format!("{name}[xx], {name}[yy]"), "one of them", "both or none")),
    }
}
