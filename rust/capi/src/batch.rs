//! One step of a batch: all inputs are checked first, then cells are evaluated block by block and written into the caller's
//! columns.

mod foreign;

use crate::abi::msdd_batch;
use crate::columns::{Input, Output};
use crate::si::Si;
use crate::status::Failure;
use msdd_surrogate::Surrogate;
use msdd_surrogate::kernel::{LANES, Lanes};
use msdd_surrogate::surrogate::{Answer, Increment, MAX_STATE, StateLanes, Tangent};

/// Columns of a batch.
pub(crate) struct Columns<'a> {
    cells: usize,
    state: Vec<Input<'a>>,
    thermal_strain: Input<'a>,
    total_thermal_strain: Option<Input<'a>>,
    /// Strains xx, yy, 2 xy of the cells.
    strain: [Option<Input<'a>>; 3],
    rotation: Option<Input<'a>>,
    next_state: Vec<Output<f64>>,
    conductivity: [Output<f64>; 3],
    stress: [Output<f64>; 3],
    /// Empty, or nine columns.
    tangent: Vec<Output<f64>>,
    clamped: Output<u8>,
    /// Empty, or one for every state column and one for the thermal strain.
    outside: Vec<Output<f64>>,
    spread: Output<f64>,
}

/// Largest thermal strain: grains of eleven times their size, which no model describes, and still far from overflow.
const LARGEST_STRAIN: f64 = 10.0;
/// Largest strain of a cell, and angle [rad] by which it turns, in one step: the law integrates a step at once, so larger ones
/// have to be divided.
const LARGEST_STEP: f64 = 0.2;

/// Columns of the tangent.
const TANGENT: usize = 9;

/// Refuses numbers of cells whose columns cannot fit into memory: pointers to the end of a column would wrap around.
pub(crate) fn check_length(cells: usize) -> Result<(), Failure> {
    match cells > isize::MAX as usize / size_of::<f64>() {
        true => Err(Failure::argument("cells", cells, "number of cells")),
        false => Ok(()),
    }
}

/// Writable columns from a caller's array of them; each may be null.
///
/// # Safety
/// `columns`, unless null, points to `count` pointers, each null or to `cells` values that this thread alone uses.
pub(crate) unsafe fn outputs(
    name: &'static str,
    columns: *const *mut f64,
    count: usize,
    cells: usize,
) -> Result<Vec<Output<f64>>, Failure> {
    if columns.is_null() {
        return Err(Failure::null(name));
    }
    // SAFETY: `count` pointers, and what they point to, by this function's contract.
    Ok((0..count).map(|k| unsafe { Output::new(columns.add(k).read(), cells) }).collect())
}

impl<'a> Columns<'a> {
    /// # Safety
    /// The batch's pointers, unless null, point to `cells` values, those of `state` and `next_state` to as many columns
    /// as the model's state has, `outside` to one more; outputs are writable by this thread alone.
    pub unsafe fn new(names: &'a [String], batch: &msdd_batch) -> Result<Self, Failure> {
        let cells = batch.cells;
        check_length(cells)?;
        if batch.state.is_null() {
            return Err(Failure::null("state"));
        }
        let optional = |name, start: *const f64| match start.is_null() {
            true => Ok(None),
            // SAFETY: the caller guarantees it, by this function's contract.
            false => unsafe { Input::new(name, start, cells) }.map(Some),
        };
        let several = |name, columns: *const *mut f64, count| match columns.is_null() {
            true => Ok(Vec::new()),
            // SAFETY: the caller guarantees it, by this function's contract.
            false => unsafe { outputs(name, columns, count, cells) },
        };
        // SAFETY: the caller guarantees it for all columns, by this function's contract.
        unsafe {
            let state =
                names.iter().enumerate().map(|(k, name)| Input::new(name, batch.state.add(k).read(), cells));
            let output = |start: *mut f64| Output::new(start, cells);
            Ok(Self {
                cells,
                state: state.collect::<Result<_, _>>()?,
                thermal_strain: Input::new("thermal_strain", batch.thermal_strain, cells)?,
                total_thermal_strain: optional("total_thermal_strain", batch.total_thermal_strain)?,
                strain: [
                    optional("strain_xx", batch.strain_xx)?,
                    optional("strain_yy", batch.strain_yy)?,
                    optional("strain_xy", batch.strain_xy)?,
                ],
                rotation: optional("rotation", batch.rotation)?,
                next_state: several("next_state", batch.next_state, names.len())?,
                conductivity: [batch.conductivity_xx, batch.conductivity_yy, batch.conductivity_xy]
                    .map(output),
                stress: [batch.stress_xx, batch.stress_yy, batch.stress_xy].map(output),
                tangent: several("tangent", batch.tangent, TANGENT)?,
                clamped: Output::new(batch.clamped, cells),
                outside: several("outside", batch.outside, names.len() + 1)?,
                spread: output(batch.spread),
            })
        }
    }

    /// Takes all cells through the step; returns the number with an input outside the trained range.
    pub fn advance(&self, model: &dyn Surrogate, si: &Si) -> Result<usize, Failure> {
        self.check(model.name(), model.has_tangent())?;
        let (mut answer, mut tangent) = (Answer::default(), Tangent::default());
        let blocks = (0..self.cells).step_by(LANES);
        Ok(blocks.map(|first| self.fill(model, si, first, (&mut answer, &mut tangent))).sum())
    }

    fn check(&self, name: &str, has_tangent: bool) -> Result<(), Failure> {
        let inputs = self.state.iter().chain([&self.thermal_strain]).chain(&self.total_thermal_strain);
        inputs.chain(self.strain.iter().flatten()).chain(&self.rotation).try_for_each(Input::check_finite)?;
        // The lower end does not belong to these ranges.
        let range = |column: &Input, low: f64, high: f64, allowed: &str| {
            let Some(cell) = column.position(|value| value <= low || value > high) else { return Ok(()) };
            Err(Failure::number(format!("{}[{cell}]", column.name), column.at(cell), allowed))
        };
        if let Some(column) = &self.total_thermal_strain {
            range(column, -1.0, LARGEST_STRAIN, "above -1, to 10")?;
        }
        for column in self.strain.iter().flatten().chain(&self.rotation) {
            range(column, -LARGEST_STEP, LARGEST_STEP, "above -0.2, to 0.2")?;
        }
        if !has_tangent && (self.deforms() || self.wants_tangent()) {
            let wanted = "strain_xx, strain_yy, strain_xy, rotation, tangent";
            let allowed = format!("NULL: model \"{name}\" has no mechanical tangent");
            return Err(Failure::argument(wanted, "not NULL", allowed));
        }
        Ok(())
    }

    fn wants_tangent(&self) -> bool {
        self.tangent.iter().any(Output::is_wanted)
    }

    fn deforms(&self) -> bool {
        self.strain.iter().chain([&self.rotation]).any(Option::is_some)
    }

    /// Evaluates the block of cells from `first` on; returns how many of them had an input outside the trained range.
    /// `answer` and `tangent` are scratch space for the results of a block.
    fn fill(
        &self,
        model: &dyn Surrogate,
        si: &Si,
        first: usize,
        (answer, tangent): (&mut Answer, &mut Tangent),
    ) -> usize {
        // All inputs of a block are read before any output is written, because the same column may be both.
        let lanes_or_zero =
            |column: &Option<Input>| column.map_or([0.0; LANES], |column| column.lanes(first));
        let mut state: StateLanes = [[0.0; LANES]; MAX_STATE];
        for (lanes, column) in state.iter_mut().zip(&self.state) {
            *lanes = column.lanes(first);
        }
        let total = lanes_or_zero(&self.total_thermal_strain);
        let [xx, yy, xy] = self.strain.each_ref().map(lanes_or_zero);
        let (thermal, rotation) = (self.thermal_strain.lanes(first), lanes_or_zero(&self.rotation));
        let strain = Increment { thermal, xx, yy, xy, rotation };
        model.advance(&state, &strain, answer, self.wants_tangent().then_some(&mut *tangent));
        for (column, lanes) in self.tangent.iter().zip(tangent.as_flattened()) {
            column.write(first, &si.stress(*lanes, &total));
        }
        let outside = answer.lanes_outside();
        self.write(model, si, first, answer, &outside, &total);
        outside[..LANES.min(self.cells - first)].iter().filter(|outside| **outside).count()
    }

    fn write(
        &self,
        model: &dyn Surrogate,
        si: &Si,
        first: usize,
        answer: &Answer,
        outside: &[bool; LANES],
        total: &Lanes,
    ) {
        // For a state near the largest floating-point number, far outside of every trained range, the next state and its
        // distance from the range would overflow to infinity; they are limited to the largest number instead.
        let largest = |lanes: &Lanes| lanes.map(|value| value.clamp(f64::MIN, f64::MAX));
        for (column, lanes) in self.next_state.iter().zip(&answer.state) {
            column.write(first, &largest(lanes));
        }
        for k in 0..3 {
            self.conductivity[k].write(first, &si.conductivity(answer.conductivity[k]));
            self.stress[k].write(first, &si.stress(answer.stress[k], total));
        }
        self.clamped.write(first, &outside.map(u8::from));
        let strain = [&answer.outside[MAX_STATE]];
        for (column, lanes) in
            self.outside.iter().zip(answer.outside[..self.state.len()].iter().chain(strain))
        {
            column.write(first, &largest(lanes));
        }
        let lane_state = |lane: usize| answer.state.map(|column| column[lane]);
        if self.spread.is_wanted() {
            let spread =
                |lane| model.uncertainty(&lane_state(lane)).map_or(f64::NAN, |d| d.conductivity_spread);
            self.spread.write(first, &std::array::from_fn(spread));
        }
    }
}
