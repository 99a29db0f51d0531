//! The runs of a search, and how far they are apart.

use crate::ChoiceError;
use crate::bands::{Law, Lengths, sensitivity};
use crate::bed::BandInputs;
use crate::found::{Share, Tried};
use crate::quantity::Quantity;
use crate::series::Series;
use crate::settings::Settings;
use crate::trial::Outcome;

/// What can be chosen.
#[derive(Clone, Debug)]
pub struct SearchTarget {
    /// Wanted accuracy of T [% of its range].
    pub accuracy: f64,
    /// Wanted accuracy of p [% of its range], if it is asked for.
    pub pressure: Option<f64>,
    /// Cells along each direction of the user's mesh; empty if it has to be taken as it is.
    pub cells: Vec<usize>,
    /// Which of these directions mirror; none if empty.
    pub mirrors: Vec<bool>,
    /// Whether grains move, if the user says so.
    pub moves: Option<bool>,
    /// Whether the conductivity may be constant.
    pub constant: bool,
    pub bed: BandInputs,
    pub law: Law,
}

/// Errors of T and of p \[% of the range of T\]: that of p in its share of what is asked of p, 0 if nothing is.
pub type Each = [f64; 2];

/// The larger of both.
pub fn larger(each: Each) -> f64 {
    each[0].max(each[1])
}

/// Makes one run, given the range of T \[K\] once it is known.
pub type Run<'a> = dyn FnMut(&Settings, Option<f64>) -> Result<Outcome, ChoiceError> + 'a;

/// The runs so far.
pub struct Runs<'a> {
    run: &'a mut Run<'a>,
    target: &'a SearchTarget,
    /// Range of T \[K\] and of p \[Pa\] over all runs.
    pub range: f64,
    pub pressure_range: f64,
    pub tried: Vec<Tried>,
}

impl<'a> Runs<'a> {
    pub fn new(target: &'a SearchTarget, run: &'a mut Run<'a>) -> Self {
        Self { run, target, range: 0.0, pressure_range: 0.0, tried: Vec::new() }
    }

    /// Runs a combination and compares it with another run.
    ///
    /// # Errors
    /// Those of the run.
    pub fn compare(
        &mut self,
        what: &str,
        settings: Settings,
        with: Option<&Outcome>,
    ) -> Result<Outcome, ChoiceError> {
        let range = (self.range > 0.0).then_some(self.range);
        let outcome = (self.run)(&settings, range)?;
        self.range = self.range.max(outcome.range);
        if let Some(pressure) = outcome.values.get(&Quantity::Pressure) {
            let mut all = pressure.clone();
            all.values.push(outcome.start_pressure.clone());
            self.pressure_range = self.pressure_range.max(all.range());
        }
        let away = with.map(|other| self.percent(&outcome, other));
        let (cells, seconds) = (outcome.cells, outcome.seconds);
        self.tried.push(Tried { what: what.to_string(), settings, cells, seconds, away });
        Ok(outcome)
    }

    /// How far two runs are apart [% of the range of T].
    pub fn percent(&self, a: &Outcome, b: &Outcome) -> f64 {
        larger(self.apart(a, b))
    }

    /// How far two runs are apart in T and in p [% of the range of T].
    pub fn apart(&self, a: &Outcome, b: &Outcome) -> Each {
        let away = |quantity| Some(a.values.get(&quantity)?.distance(b.values.get(&quantity)?));
        self.each(away(Quantity::Temperature).unwrap_or(0.0), away(Quantity::Pressure).unwrap_or(0.0))
    }

    /// Of errors of T [K] and p [Pa].
    fn each(&self, temperature: f64, pressure: f64) -> Each {
        let pressure = match self.target.pressure {
            Some(wanted) if self.pressure_range > 0.0 => {
                100.0 * pressure / self.pressure_range * self.target.accuracy / wanted
            }
            _ => 0.0,
        };
        [100.0 * temperature / self.range, pressure]
    }

    /// What model and packing leave open, from a run with another conductivity: its parts, of T or of p, whichever is the larger
    /// share of what is asked for; both for T and p; and the change of T with the logarithm of the conductivity.
    pub fn open(&self, base: &Outcome, other: &Outcome) -> (Vec<Share>, Each, Series) {
        let sensitivity = sensitivity(base, other);
        let bed = &self.target.bed;
        let lengths = Lengths::new(bed, base, &sensitivity);
        let part = |k: usize| {
            let of = |quantity| self.target.law.uncertainty(quantity, k, &lengths);
            self.each(of(Quantity::Temperature), of(Quantity::Pressure))
        };
        let parts = [part(0), part(1)];
        let all = [0, 1].map(|quantity| parts[0][quantity].hypot(parts[1][quantity]));
        let worse = usize::from(all[1] > all[0]);
        let model = "effect of the error of the conductivity, calibrated on beds computed by DEM".to_string();
        let packing = format!("scatter of beds of {:.0} grains", bed.grains);
        let shares = [("model", 0, model), ("packing", 1, packing)];
        let share = |(source, k, how): (&str, usize, String)| Share {
            source: source.to_string(),
            percent: parts[k][worse],
            how,
        };
        (shares.into_iter().map(share).collect(), all, sensitivity)
    }
}
