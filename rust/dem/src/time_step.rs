//! The mechanical time step: its stability bound; its choice is the same for all grains. (Heat has its own sub-steps, see [`crate::heat`].)

use crate::contact::Touching;

pub use msdd_engine::time_step::{Excess, SAFETY, StepChoice};

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
