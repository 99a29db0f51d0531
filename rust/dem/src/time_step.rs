//! The mechanical time step: its stability bound and its choice. (Heat has its own sub-steps, see [`crate::heat`].)

use crate::contact::Touching;

/// Default step over the bound. Runs were measured to blow up at the bound itself; 0.4 resolves the period of a
/// contact.
pub const SAFETY: f64 = 0.4;

/// How the mechanical time step is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepChoice {
    /// `safety` times the stability bound, adapted as the contacts change.
    Adaptive { safety: f64 },
    /// A fixed step [s].
    Fixed { step: f64, on_excess: Excess },
}

/// What happens when a fixed step exceeds the bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Excess {
    /// The run ends with [`crate::failure::Failure::TimeStep`].
    Refuse,
    /// The step is cut to [`SAFETY`] times the bound for as long as needed.
    Cut,
}

/// Least number of contacts that a disc is assumed to have, so that a step chosen in a loose state stays stable when
/// the assembly jams.
const FEWEST_CONTACTS: f64 = 4.0;

/// Δt_max = 2 / √(2 max_i Σ_c s_n / m_i) [s], the sum over the contacts of disc i (Gershgorin's circle for the
/// stiffness matrix over the masses).
pub(crate) fn stable_step(touching: &Touching) -> f64 {
    let stiffness = contact_stiffness(touching);
    let ratios = touching.discs.iter().zip(&stiffness).map(|(disc, sum)| sum / disc.mass);
    2.0 / (2.0 * ratios.fold(0.0, f64::max)).sqrt()
}

/// Σ_c s_n [N/m] over the contacts of each disc; at least that of [`FEWEST_CONTACTS`] contacts.
pub(crate) fn contact_stiffness(touching: &Touching) -> Vec<f64> {
    let least = FEWEST_CONTACTS * touching.material.young_modulus;
    let mut stiffness = vec![0.0; touching.discs.len()];
    touching.for_each(|contact| {
        for disc in contact.discs() {
            stiffness[disc] += contact.stiffness;
        }
    });
    for (sum, disc) in stiffness.iter_mut().zip(touching.discs) {
        *sum = sum.max(least * disc.radius);
    }
    stiffness
}
