//! What a search finds, and what it has seen on the way.

use crate::quantity::Quantity;
use crate::series::Series;
use crate::settings::Settings;
use crate::trial::Outcome;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// One run of the search.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tried {
    pub what: String,
    pub settings: Settings,
    pub cells: usize,
    pub seconds: f64,
    /// How far it is from the run that it is compared with [% of the range of T].
    pub away: Option<f64>,
}

/// An estimate of what a choice leaves out, the root of the mean square over bed and run. Where p is asked for and takes a larger
/// share of its accuracy, that share of the accuracy of T.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Share {
    pub source: String,
    /// Error of T [% of its range].
    pub percent: f64,
    pub how: String,
}

/// The choice.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Found {
    pub settings: Settings,
    /// Range of T \[K\].
    pub range: f64,
    /// Of p \[Pa\].
    pub pressure_range: f64,
    /// Errors of the numerical method and of grains that stay.
    pub shares: Vec<Share>,
    /// What the model and the packing leave open.
    pub open: Vec<Share>,
    pub tried: Vec<Tried>,
    /// What could not be tried, and why.
    pub notes: Vec<String>,
}

impl Found {
    /// All together [% of the range of T]: the sum of the numerical errors, and what model and packing leave open, which is
    /// independent of it and of each other.
    pub fn total(&self) -> f64 {
        let numerical: f64 = self.shares.iter().map(|share| share.percent).sum();
        self.open.iter().fold(numerical, |all, share| all.hypot(share.percent))
    }
}

/// Values at points and times of several quantities.
pub type Values = BTreeMap<Quantity, Series>;

/// What the search has seen at each point and time, for the bands of the chosen run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Differences {
    /// Error of the chosen steps.
    pub time: Values,
    /// What changes if the grains move, where they stay in the chosen run.
    pub motion: Values,
    /// What changes with the model, where the conductivity is constant in the chosen run.
    pub constant: Values,
    /// Change of T with the logarithm of the conductivity \[K\].
    pub sensitivity: Series,
}

/// `a` minus `b`, times a factor.
pub fn difference(a: &Outcome, b: &Outcome, factor: f64) -> Values {
    let of = |(quantity, series): (&Quantity, &Series)| {
        Some((*quantity, series.minus(b.values.get(quantity)?, factor)))
    };
    a.values.iter().filter_map(of).collect()
}
