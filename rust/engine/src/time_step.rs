//! How the mechanical time step is chosen. The bound on it belongs to the contact law of each engine.

/// Default step over the bound. Runs of discs were measured to blow up at the bound itself; 0.4 resolves the period of
/// a contact.
pub const SAFETY: f64 = 0.4;

/// How the mechanical time step is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepChoice {
    /// `safety` times the stability bound, adapted as the contacts change.
    Adaptive { safety: f64 },
    /// A fixed step \[s\].
    Fixed { step: f64, on_excess: Excess },
}

/// What happens when a fixed step exceeds the bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Excess {
    /// The run ends with the failure that the step is too large.
    Refuse,
    /// The step is cut to [`SAFETY`] times the bound for as long as needed.
    Cut,
}

impl StepChoice {
    /// The step \[s\] for the present stability `bound` \[s\]; none when a fixed step that must not be cut exceeds it.
    pub fn step(self, bound: f64) -> Option<f64> {
        match self {
            Self::Adaptive { safety } => Some(safety * bound),
            Self::Fixed { step, .. } if step <= bound => Some(step),
            Self::Fixed { on_excess: Excess::Cut, .. } => Some(SAFETY * bound),
            Self::Fixed { on_excess: Excess::Refuse, .. } => None,
        }
    }
}
