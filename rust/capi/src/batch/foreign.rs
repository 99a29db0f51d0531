//! One step of a batch by a plug-in: it writes the whole batch into columns of ours, which are checked, then converted to
//! SI and copied into the caller's columns.

use super::Columns;
use crate::columns::{Input, Output};
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
        let wanted = self.tangent.iter().any(Output::is_wanted);
        let tangent = if wanted { plugin.tangent(&state)? } else { None };
        let spread = if self.spread.is_wanted() { plugin.spread(&state)? } else { None };
        // Stiffnesses are computed first, because the total strain that they need may be in a column that is written below.
        let stiffness = |column: &Vec<f64>| self.converted(column, |lanes, total| si.stress(lanes, total));
        let tangent = tangent.map(|[c11, c22, c12, porosity, fabric_index]| {
            [stiffness(&c11), stiffness(&c22), stiffness(&c12), porosity, fabric_index]
        });
        self.write_answer(&answer, si);
        if let Some(columns) = tangent {
            self.tangent.iter().zip(&columns).for_each(|(output, values)| output.write_all(values));
        }
        self.spread.write_all(&spread.unwrap_or_else(|| vec![f64::NAN; self.cells]));
        Ok((0..self.cells).filter(|&cell| is_outside(&answer, cell)).count())
    }

    fn ask<'s>(&'s self, plugin: &Plugin) -> Result<Answer, Failure> {
        let zero = vec![0.0; if self.deforms() { self.cells } else { 0 }];
        // SAFETY: outputs are written after the last use of these slices, and the header forbids other threads to write.
        let slice = |column: &'s Input<'_>| unsafe { column.slice() };
        let state: Vec<&[f64]> = self.state.iter().map(slice).collect();
        let strain = self.strain.each_ref().map(|column| column.as_ref().map_or(zero.as_slice(), slice));
        let step = Step {
            state: &state,
            thermal_strain: slice(&self.thermal_strain),
            virgin_share: self.virgin_share.as_ref().map(slice),
            strain: self.deforms().then_some(strain),
        };
        Ok(plugin.advance(&step)?)
    }

    fn write_answer(&self, answer: &Answer, si: &Si) {
        let stress = answer
            .stress
            .each_ref()
            .map(|column| self.converted(column, |lanes, total| si.stress(lanes, total)));
        let conductivity = answer.conductivity.each_ref();
        let conductivity =
            conductivity.map(|column| self.converted(column, |lanes, _| si.conductivity(lanes)));
        self.next_state.iter().zip(&answer.state).for_each(|(output, values)| output.write_all(values));
        for k in [0, 1] {
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
