//! Errors along paths: of the law, and between packings.

use serde::Serialize;

/// Root mean squares along paths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Errors {
    /// Of pressure and deviator, over [`super::fit::scales`].
    pub pressure: f64,
    pub deviator: f64,
    /// Relative, of the conductivities by contacts, and by gas at ln(R/h) = 8.5; that is NaN where the latter is not known.
    pub contact: f64,
    pub gas: f64,
}

/// Sums of squares of [`Errors`], over all states, and over those that conduct well.
#[derive(Default)]
pub struct Sums {
    stress: [f64; 2],
    contact: f64,
    gas: f64,
    states: usize,
    conducting: usize,
    with_gas: usize,
}

impl Sums {
    pub fn add_stress(&mut self, squares: [f64; 2]) {
        self.states += 1;
        (0..2).for_each(|k| self.stress[k] += squares[k]);
    }

    /// Of a state whose conductivities are known; the second is NaN where that by gas is not.
    pub fn add_conductivity(&mut self, [contact, gas]: [f64; 2]) {
        self.conducting += 1;
        self.contact += contact;
        if gas.is_finite() {
            self.with_gas += 1;
            self.gas += gas;
        }
    }

    pub fn states(&self) -> usize {
        self.states
    }

    pub fn conducting(&self) -> usize {
        self.conducting
    }

    /// `None` without states.
    pub fn errors(&self) -> Option<Errors> {
        let root = |sum: f64, count: usize| (sum / count.max(1) as f64).sqrt();
        let [pressure, deviator] = self.stress.map(|sum| root(sum, self.states));
        let contact = root(self.contact, self.conducting);
        let gas = if self.with_gas > 0 { root(self.gas, self.with_gas) } else { f64::NAN };
        (self.states > 0).then_some(Errors { pressure, deviator, contact, gas })
    }
}

/// Least p/E* of states whose conductivity is judged.
pub const MIN_PRESSURE: f64 = 1e-7;
