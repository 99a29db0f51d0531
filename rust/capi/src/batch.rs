//! Evaluation of a batch: all checks first, then block by block straight into the caller's columns.

use crate::columns::{Input, Output};
use crate::ffi::{msdd_batch, msdd_material};
use crate::si::Si;
use crate::status::Failure;
use msdd_surrogate::Model;
use msdd_surrogate::kernel::{LANES, Lanes};

/// Columns of a batch.
struct Columns {
    inputs: [Input; 3],
    total_thermal_strain: Option<Input>,
    delta_porosity: Output<f64>,
    delta_fabric_index: Output<f64>,
    conductivity_xx: Output<f64>,
    conductivity_yy: Output<f64>,
    stress_xx: Output<f64>,
    stress_yy: Output<f64>,
    clamped: Output<u8>,
}

/// Evaluates the batch; returns the number of clamped cells.
///
/// # Safety
/// The batch's pointers, unless null, point to `cells` values; those of outputs are writable by this thread alone.
pub(crate) unsafe fn evaluate(
    model: &Model,
    material: &msdd_material,
    batch: &msdd_batch,
) -> Result<usize, Failure> {
    let si = Si::new(material)?;
    // SAFETY: passed on to the caller.
    let columns = unsafe { Columns::new(batch)? };
    columns.check()?;
    Ok((0..batch.cells).step_by(LANES).map(|first| columns.fill(model, &si, first, batch.cells)).sum())
}

impl Columns {
    /// # Safety
    /// As for [`evaluate`].
    unsafe fn new(batch: &msdd_batch) -> Result<Self, Failure> {
        let cells = batch.cells;
        // A column has to fit into memory; else pointers to its end would wrap.
        if cells > isize::MAX as usize / size_of::<f64>() {
            return Err(Failure::argument("batch.cells", cells, "number of cells"));
        }
        let total = batch.total_thermal_strain;
        // SAFETY: passed on to the caller, for all columns.
        unsafe {
            Ok(Self {
                inputs: [
                    Input::new("porosity", batch.porosity, cells)?,
                    Input::new("fabric_index", batch.fabric_index, cells)?,
                    Input::new("thermal_strain", batch.thermal_strain, cells)?,
                ],
                total_thermal_strain: match total.is_null() {
                    true => None,
                    false => Some(Input::new("total_thermal_strain", total, cells)?),
                },
                delta_porosity: Output::new(batch.delta_porosity, cells),
                delta_fabric_index: Output::new(batch.delta_fabric_index, cells),
                conductivity_xx: Output::new(batch.conductivity_xx, cells),
                conductivity_yy: Output::new(batch.conductivity_yy, cells),
                stress_xx: Output::new(batch.stress_xx, cells),
                stress_yy: Output::new(batch.stress_yy, cells),
                clamped: Output::new(batch.clamped, cells),
            })
        }
    }

    fn check(&self) -> Result<(), Failure> {
        self.inputs.iter().chain(&self.total_thermal_strain).try_for_each(Input::check_finite)?;
        let Some(total) = &self.total_thermal_strain else { return Ok(()) };
        match total.position(|strain| strain <= -1.0 || strain > LARGEST_STRAIN) {
            None => Ok(()),
            Some(cell) => {
                let name = format!("{}[{cell}]", total.name);
                Err(Failure::argument(name, total.at(cell), "above -1, to 10"))
            }
        }
    }

    /// Evaluates the cells `first` to `first + 7`; returns how many of them were clamped.
    fn fill(&self, model: &Model, si: &Si, first: usize, cells: usize) -> usize {
        // All of a block's inputs are read before any output is written: a column may be both.
        let block = model.block(&self.inputs.map(|column| column.lanes(first)));
        let total: Lanes = self.total_thermal_strain.map_or([0.0; LANES], |column| column.lanes(first));
        self.delta_porosity.write(first, &block.delta_porosity);
        self.delta_fabric_index.write(first, &block.delta_fabric_index);
        self.conductivity_xx.write(first, &si.conductivity(block.conductivity_xx));
        self.conductivity_yy.write(first, &si.conductivity(block.conductivity_yy));
        self.stress_xx.write(first, &si.stress(block.stress_xx, &total));
        self.stress_yy.write(first, &si.stress(block.stress_yy, &total));
        self.clamped.write(first, &block.clamped.map(u8::from));
        block.clamped.iter().take(cells - first).filter(|clamped| **clamped).count()
    }
}

/// Grains eleven times their size: no state that the model describes, and far from overflow.
const LARGEST_STRAIN: f64 = 10.0;
