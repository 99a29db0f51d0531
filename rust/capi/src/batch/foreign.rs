//! One step of a batch by a plug-in: it writes the whole batch into columns of ours, which are checked, then converted to
//! SI and copied into the caller's columns.

use super::Columns;
use crate::columns::Input;
use crate::si::Si;
use crate::status::Failure;
use msdd_plugin::{Answer, Plugin, Step};
use msdd_surrogate::kernel::{LANES, Lanes};
use msdd_surrogate::network::padded;

impl Columns<'_> {
    /// As [`Columns::advance`]. Nothing is written before all answers have been checked.
    pub fn advance_plugin(&self, plugin: &Plugin, si: &Si) -> Result<usize, Failure> {
        self.check(plugin.name(), plugin.has_tangent())?;
        let answer = self.ask(plugin)?;
        let state: Vec<&[f64]> = answer.state.iter().map(Vec::as_slice).collect();
        let spread = if self.spread.is_wanted() { plugin.spread(&state)? } else { None };
        self.write_answer(&answer, si);
        self.spread.write_all(&spread.unwrap_or_else(|| vec![f64::NAN; self.cells]));
        Ok((0..self.cells).filter(|&cell| is_outside(&answer, cell)).count())
    }

    fn ask<'s>(&'s self, plugin: &Plugin) -> Result<Answer, Failure> {
        let zero = vec![0.0; self.cells];
        // SAFETY: outputs are written after the last use of these slices, and the header forbids other threads to write.
        let slice = |column: &'s Input<'_>| unsafe { column.slice() };
        let state: Vec<&[f64]> = self.state.iter().map(slice).collect();
        let [xx, yy, xy] = self.strain.each_ref();
        let strain =
            [xx, yy, xy, &self.rotation].map(|column| column.as_ref().map_or(zero.as_slice(), slice));
        let step = Step {
            state: &state,
            thermal_strain: slice(&self.thermal_strain),
            strain: plugin.has_tangent().then_some(strain),
            wants_tangent: self.wants_tangent(),
        };
        Ok(plugin.advance(&step)?)
    }

    fn write_answer(&self, answer: &Answer, si: &Si) {
        // All that needs the total strain is computed first, because that may be in a column that is written below.
        let in_pascal = |column: &Vec<f64>| self.converted(column, |lanes, total| si.stress(lanes, total));
        let stress = answer.stress.each_ref().map(in_pascal);
        let tangent: Vec<Vec<f64>> = answer.tangent.iter().flatten().map(in_pascal).collect();
        let conductivity = answer.conductivity.each_ref();
        let conductivity =
            conductivity.map(|column| self.converted(column, |lanes, _| si.conductivity(lanes)));
        self.next_state.iter().zip(&answer.state).for_each(|(output, values)| output.write_all(values));
        self.tangent.iter().zip(&tangent).for_each(|(output, values)| output.write_all(values));
        for k in 0..3 {
            self.conductivity[k].write_all(&conductivity[k]);
            self.stress[k].write_all(&stress[k]);
        }
        self.outside.iter().zip(&answer.outside).for_each(|(output, values)| output.write_all(values));
        let clamped: Vec<u8> = (0..self.cells).map(|cell| u8::from(is_outside(answer, cell))).collect();
        self.clamped.write_all(&clamped);
    }

    /// Converts a column to SI with the function that converts the blocks of our own models, too.
    fn converted(&self, column: &[f64], convert: impl Fn(Lanes, &Lanes) -> Lanes) -> Vec<f64> {
        let mut result = Vec::with_capacity(self.cells);
        for first in (0..self.cells).step_by(LANES) {
            let here = LANES.min(self.cells - first);
            let total = self.total_thermal_strain.map_or([0.0; LANES], |column| column.lanes(first));
            let lanes = convert(padded(here, |lane| column[first + lane]), &total);
            result.extend_from_slice(&lanes[..here]);
        }
        result
    }
}

fn is_outside(answer: &Answer, cell: usize) -> bool {
    answer.outside.iter().any(|column| column[cell] != 0.0)
}
