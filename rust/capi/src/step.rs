//! One step of a batch of cells: the columns that a caller gives and wants, checked before a model evaluates them.

use crate::abi::{msdd_input, msdd_output, msdd_step};
use crate::columns::{Input, Output, check_apart, check_length};
use crate::status::Failure;

/// Components of a symmetric tensor, as columns are named in messages: in the plane xx, yy, xy, in space all.
pub(crate) struct Components {
    pub strain: &'static [&'static str],
    pub stress: &'static [&'static str],
    pub conductivity: &'static [&'static str],
    pub fabric: &'static [&'static str],
    pub rotation: &'static [&'static str],
}

macro_rules! components {
    ([$($part:literal),*], [$($axis:literal),*]) => {
        Components {
            strain: &[$(concat!("strain[", $part, "]")),*],
            stress: &[$(concat!("stress[", $part, "]")),*],
            conductivity: &[$(concat!("conductivity[", $part, "]")),*],
            fabric: &[$(concat!("fabric[", $part, "]")),*],
            rotation: &[$(concat!("rotation[", $axis, "]")),*],
        }
    };
}

const PLANE: Components = components!(["xx", "yy", "xy"], ["z"]);
const SPACE: Components = components!(["xx", "yy", "zz", "xy", "xz", "yz"], ["x", "y", "z"]);

/// Largest strain of a cell, and angle \[rad\] by which it turns, in one step: the models integrate a step at once, so larger ones
/// have to be divided.
const LARGEST_STEP: f64 = 0.2;

/// The names for a model of 3 or 6 components; refuses a caller who expects another number.
pub(crate) fn components(given: usize, of_model: usize) -> Result<&'static Components, Failure> {
    match given == of_model {
        true => Ok(if of_model == 6 { &SPACE } else { &PLANE }),
        false => Err(Failure::argument("components", given, format!("{of_model}, those of the model"))),
    }
}

/// Columns of a step. Lists that the caller does not give are empty.
pub(crate) struct Step<'a> {
    pub cells: usize,
    pub state: Vec<Input<'a>>,
    pub thermal_strain: Option<Input<'a>>,
    pub total_thermal_strain: Option<Input<'a>>,
    pub strain: Vec<Option<Input<'a>>>,
    pub rotation: Vec<Option<Input<'a>>>,
    pub temperature: Option<Input<'a>>,
    pub solid_conductivity: Option<Input<'a>>,
    pub emissivity: Option<Input<'a>>,
    pub next_state: Vec<Output<f64>>,
    pub stress: Vec<Output<f64>>,
    pub tangent: Vec<Output<f64>>,
    pub conductivity: Vec<Output<f64>>,
    pub gas_conductivity: Output<f64>,
    pub radiation_conductivity: Output<f64>,
    pub solid_fraction: Output<f64>,
    pub spread: Output<f64>,
    pub distance: Vec<Output<f64>>,
    pub outside: Output<u8>,
}

/// Columns from a caller's table of them; none if the table is null.
///
/// # Safety
/// `table`, unless null, points to as many columns as there are names, each null or with `cells` values.
pub(crate) unsafe fn optional_inputs<'a>(
    names: impl IntoIterator<Item = &'a str>,
    table: *const msdd_input,
    cells: usize,
) -> Result<Vec<Option<Input<'a>>>, Failure> {
    if table.is_null() {
        return Ok(Vec::new());
    }
    let names = names.into_iter().enumerate();
    // SAFETY: as many columns, by this function's contract.
    names.map(|(k, name)| unsafe { Input::optional(name, table.add(k).read(), cells) }).collect()
}

/// As [`optional_inputs`], but each column is needed.
///
/// # Safety
/// As for [`optional_inputs`].
pub(crate) unsafe fn inputs<'a>(
    names: impl IntoIterator<Item = &'a str>,
    table: *const msdd_input,
    cells: usize,
) -> Result<Vec<Input<'a>>, Failure> {
    let names = names.into_iter().enumerate();
    // SAFETY: as many columns, by this function's contract.
    names.map(|(k, name)| unsafe { Input::new(name, table.add(k).read(), cells) }).collect()
}

/// Writable columns from a caller's table of them, each of which may be null; none if the table is null.
///
/// # Safety
/// `table`, unless null, points to `count` columns, each null or with `cells` values that this thread alone uses.
pub(crate) unsafe fn outputs(
    name: &'static str,
    table: *const msdd_output,
    count: usize,
    cells: usize,
) -> Result<Vec<Output<f64>>, Failure> {
    let count = if table.is_null() { 0 } else { count };
    // SAFETY: as many columns, by this function's contract.
    (0..count).map(|k| unsafe { Output::new(name, table.add(k).read(), cells) }).collect()
}

impl<'a> Step<'a> {
    /// # Safety
    /// The columns, unless null, have `cells` values, and the tables as many columns as the header says for a model with these
    /// state columns and this number of components. Outputs are writable by this thread alone.
    pub unsafe fn new(given: &msdd_step, state: &'a [String], of_model: usize) -> Result<Self, Failure> {
        let cells = given.cells;
        let parts = components(given.components, of_model)?;
        check_length(cells)?;
        if given.state.is_null() {
            return Err(Failure::null("state"));
        }
        let count = of_model;
        // SAFETY: the columns are as this function's contract says.
        let step = unsafe {
            Self {
                cells,
                state: inputs(state.iter().map(String::as_str), given.state, cells)?,
                thermal_strain: Input::optional("thermal_strain", given.thermal_strain, cells)?,
                total_thermal_strain: Input::optional(
                    "total_thermal_strain",
                    given.total_thermal_strain,
                    cells,
                )?,
                strain: optional_inputs(parts.strain.iter().copied(), given.strain, cells)?,
                rotation: optional_inputs(parts.rotation.iter().copied(), given.rotation, cells)?,
                temperature: Input::optional("temperature", given.temperature, cells)?,
                solid_conductivity: Input::optional("solid_conductivity", given.solid_conductivity, cells)?,
                emissivity: Input::optional("emissivity", given.emissivity, cells)?,
                next_state: outputs("next_state", given.next_state, state.len(), cells)?,
                stress: outputs("stress", given.stress, count, cells)?,
                tangent: outputs("tangent", given.tangent, count * count, cells)?,
                conductivity: outputs("conductivity", given.conductivity, count, cells)?,
                gas_conductivity: Output::new("gas_conductivity", given.gas_conductivity, cells)?,
                radiation_conductivity: Output::new(
                    "radiation_conductivity",
                    given.radiation_conductivity,
                    cells,
                )?,
                solid_fraction: Output::new("solid_fraction", given.solid_fraction, cells)?,
                spread: Output::new("spread", given.spread, cells)?,
                distance: outputs("distance", given.distance, state.len() + 1, cells)?,
                outside: Output::contiguous("outside", given.outside, cells),
            }
        };
        step.check()?;
        Ok(step)
    }

    fn inputs(&self) -> impl Iterator<Item = &Input<'a>> + use<'_, 'a> {
        let single = [
            &self.thermal_strain,
            &self.total_thermal_strain,
            &self.temperature,
            &self.solid_conductivity,
            &self.emissivity,
        ];
        let single = single.into_iter().chain(&self.strain).chain(&self.rotation).flatten();
        self.state.iter().chain(single)
    }

    fn outputs(&self) -> impl Iterator<Item = &Output<f64>> {
        let single =
            [&self.gas_conductivity, &self.radiation_conductivity, &self.solid_fraction, &self.spread];
        let tables = [&self.next_state, &self.stress, &self.tangent, &self.conductivity, &self.distance];
        tables.into_iter().flatten().chain(single)
    }

    fn check(&self) -> Result<(), Failure> {
        for column in self.strain.iter().chain(&self.rotation).flatten() {
            column.check_above(-LARGEST_STEP, LARGEST_STEP, "above -0.2, to 0.2")?;
        }
        let places = self.inputs().map(Input::place).chain(self.outputs().map(Output::place));
        check_apart(places.chain([self.outside.place()]))
    }

    /// Refuses the growth of grains by more than a model integrates in one step.
    pub fn check_thermal_step(&self) -> Result<(), Failure> {
        match &self.thermal_strain {
            Some(column) => column.check_above(-LARGEST_STEP, LARGEST_STEP, "above -0.2, to 0.2"),
            None => Ok(()),
        }
    }

    /// Refuses what a model cannot answer.
    pub fn refuse<'o>(
        &self,
        columns: impl IntoIterator<Item = &'o Output<f64>>,
        why: &str,
    ) -> Result<(), Failure> {
        match columns.into_iter().find(|column| column.is_wanted()) {
            Some(column) => Err(Failure::argument(column.name, "not NULL", format!("NULL: {why}"))),
            None => Ok(()),
        }
    }

    pub fn wants_tangent(&self) -> bool {
        self.tangent.iter().any(Output::is_wanted)
    }

    /// Whether the cells themselves are strained or turn.
    pub fn deforms(&self) -> bool {
        self.strain.iter().chain(&self.rotation).any(Option::is_some)
    }
}
