//! Checks of the results of a plug-in: values that no packing of grains can have are refused, with column and cell.

use crate::PluginError;
use crate::questions::Answer;

/// Values that a column may hold.
#[derive(Clone, Copy)]
pub(crate) struct Allowed {
    low: f64,
    high: f64,
    text: &'static str,
}

pub(crate) const FINITE: Allowed = Allowed { low: f64::MIN, high: f64::MAX, text: "finite" };
/// Range of the diagonal of K/k; times any k that the library accepts it is still finite.
pub(crate) const CONDUCTIVITY: Allowed =
    Allowed { low: 1e-30, high: 1e30, text: "finite, above 0: 1e-30 to 1e30" };
pub(crate) const STRESS: Allowed = Allowed {
    low: 0.0,
    high: 1e30,
    text: "0 to 1e30: compression is positive, and loose grains do not pull",
};
pub(crate) const STIFFNESS: Allowed = Allowed { low: -1e30, high: 1e30, text: "-1e30 to 1e30" };
pub(crate) const SPREAD: Allowed = Allowed { low: 0.0, high: f64::MAX, text: "finite, not negative" };
pub(crate) const SOLID_FRACTION: Allowed =
    Allowed { low: f64::MIN_POSITIVE, high: 2.0, text: "above 0, to 2" };
const POROSITY: Allowed = Allowed { low: 0.0, high: 1.0, text: "0 to 1" };
const FABRIC_INDEX: Allowed = Allowed { low: -1.0, high: 1.0, text: "-1 to 1" };

impl Allowed {
    fn has(&self, value: f64) -> bool {
        // Both comparisons are false for NaN.
        self.low <= value && value <= self.high
    }
}

/// A call of one function of a plug-in, named in messages.
#[derive(Clone, Copy)]
pub(crate) struct Question<'a> {
    /// Name and path of the plug-in.
    pub plugin: &'a str,
    pub function: &'static str,
    pub state_names: &'a [String],
}

/// A column (one value per cell) with its name and the range of its values.
pub(crate) type Column<'a> = (String, &'a [f64], Allowed);
type Checked = Result<(), PluginError>;

impl Question<'_> {
    fn refused(&self, column: &str, cell: usize, value: f64, allowed: &'static str) -> Checked {
        let (plugin, column) = (self.plugin.to_string(), column.to_string());
        Err(PluginError::Answer { plugin, function: self.function, column, cell, value, allowed })
    }

    pub fn column(&self, name: &str, values: &[f64], allowed: Allowed) -> Checked {
        match values.iter().position(|value| !allowed.has(*value)) {
            None => Ok(()),
            Some(cell) => self.refused(name, cell, values[cell], allowed.text),
        }
    }

    /// Checks that all values of these columns are in their ranges.
    pub fn columns(&self, columns: &[Column]) -> Checked {
        columns.iter().try_for_each(|(name, values, allowed)| self.column(name, values, *allowed))
    }

    /// Checks that the first two columns of an initial state, porosity and fabric index, are those given.
    pub fn start(&self, state: &[Vec<f64>], given: [&[f64]; 2]) -> Checked {
        for (k, given) in given.into_iter().enumerate() {
            if let Some(cell) = (0..given.len()).find(|&cell| state[k][cell] != given[cell]) {
                return self.refused(&self.state_names[k], cell, state[k][cell], "that given");
            }
        }
        Ok(())
    }

    /// Checks that porosity is from 0 to 1 and fabric index from -1 to 1, unless the cell's value before the step was
    /// already outside.
    pub fn packing(&self, given: &[&[f64]], state: &[Vec<f64>]) -> Checked {
        for (k, allowed) in [POROSITY, FABRIC_INDEX].into_iter().enumerate() {
            let bad = |cell: &usize| !allowed.has(state[k][*cell]) && allowed.has(given[k][*cell]);
            if let Some(cell) = (0..given[k].len()).find(bad) {
                return self.refused(
                    &format!("state {}", self.state_names[k]),
                    cell,
                    state[k][cell],
                    allowed.text,
                );
            }
        }
        Ok(())
    }

    /// Checks that the state is unchanged where all `strains` are zero and nothing is outside of the plug-in's own range.
    pub fn rest(
        &self,
        given: &[&[f64]],
        strains: &[&[f64]],
        state: &[Vec<f64>],
        outside: &[Vec<f64>],
    ) -> Checked {
        let at_rest = |cell: usize| {
            strains.iter().all(|strain| strain[cell] == 0.0) && outside.iter().all(|o| o[cell] == 0.0)
        };
        for (given, (name, state, _)) in given.iter().zip(self.state(state)) {
            if let Some(cell) = (0..given.len()).find(|&cell| state[cell] != given[cell] && at_rest(cell)) {
                let allowed = "that before the step, for the strain is zero and the cell inside the range";
                return self.refused(&name, cell, state[cell], allowed);
            }
        }
        Ok(())
    }

    /// Checks that two calls with the same inputs gave the same bits.
    pub fn again(&self, first: &[Column], second: &[Column]) -> Checked {
        for ((name, first, _), (_, second, _)) in first.iter().zip(second) {
            let differs = |cell: &usize| first[*cell].to_bits() != second[*cell].to_bits();
            if let Some(cell) = (0..first.len()).find(differs) {
                let allowed = "the result of the call before, which had the same inputs";
                return self.refused(name, cell, second[cell], allowed);
            }
        }
        Ok(())
    }

    /// Checks that K is positive and that the stress is nowhere tension, in any direction. The diagonals have been checked.
    pub fn tensors(&self, answer: &Answer) -> Checked {
        let bad = |tensor: &[Vec<f64>; 3], slack: f64| {
            let [xx, yy, xy] = tensor;
            (0..xx.len()).find(|&cell| xy[cell] * xy[cell] > xx[cell] * yy[cell] * slack)
        };
        if let Some(cell) = bad(&answer.conductivity, 1.0 - 1e-12) {
            let value = answer.conductivity[2][cell];
            return self.refused(
                "conductivity_xy",
                cell,
                value,
                "conductivity_xy^2 below that of xx times yy",
            );
        }
        match bad(&answer.stress, 1.0 + 1e-9) {
            None => Ok(()),
            Some(cell) => {
                let allowed = "stress_xy^2 up to that of xx times yy: loose grains do not pull";
                self.refused("stress_xy", cell, answer.stress[2][cell], allowed)
            }
        }
    }
}

impl Question<'_> {
    /// Columns of a state, with their names and ranges.
    pub fn state<'s>(&self, state: &'s [Vec<f64>]) -> Vec<Column<'s>> {
        let names = self.state_names.iter().map(|name| format!("state {name}"));
        names.zip(state).map(|(name, column)| (name, column.as_slice(), FINITE)).collect()
    }

    /// Columns of a result of `advance`, with their names and ranges.
    pub fn answer<'s>(&self, answer: &'s Answer) -> Vec<Column<'s>> {
        let mut columns = self.state(&answer.state);
        let ([kxx, kyy, kxy], [sxx, syy, sxy]) = (&answer.conductivity, &answer.stress);
        columns.push(("conductivity_xx".to_string(), kxx, CONDUCTIVITY));
        columns.push(("conductivity_yy".to_string(), kyy, CONDUCTIVITY));
        columns.push(("conductivity_xy".to_string(), kxy, FINITE));
        columns.push(("stress_xx".to_string(), sxx, STRESS));
        columns.push(("stress_yy".to_string(), syy, STRESS));
        columns.push(("stress_xy".to_string(), sxy, FINITE));
        for (k, column) in answer.tangent.iter().flatten().enumerate() {
            columns.push((format!("tangent[{k}]"), column, STIFFNESS));
        }
        let inputs = self.state_names.iter().map(String::as_str).chain(["thermal_strain"]);
        columns.extend(
            inputs.zip(&answer.outside).map(|(name, o)| (format!("outside {name}"), o.as_slice(), FINITE)),
        );
        columns
    }
}
