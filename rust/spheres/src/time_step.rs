//! The mechanical time step: its stability bound; its choice is the same for all grains.

use crate::contact::{Partner, Touching};
use crate::law::ContactLaw;
use crate::sphere::Sphere;
use msdd_engine::run::LOOK_EVERY;

pub use msdd_engine::time_step::{Excess, SAFETY, StepChoice};

/// Least number of contacts that a sphere is assumed to have, so that a step chosen in a loose state stays stable when
/// the assembly jams.
const FEWEST_CONTACTS: f64 = 4.0;
/// Least overlap over the radius that these contacts are assumed to have.
const MIN_OVERLAP: f64 = 1e-6;

/// Δt_max = 2 / √(max_i Σ_c (2 k_n + 5 k_t) / m_i) [s], the sum over the contacts of sphere i: Gershgorin's circles for
/// the stiffness matrix over the masses. The 5 is 2 r²m/I of a sphere, for rotation against its neighbours. `speed`
/// [m/s] is the largest: at least the stiffness of a collision at that speed is assumed, and at the speed that `gravity`
/// [m/s²] adds to it until the bound is looked at again.
pub(crate) fn stable_step(touching: &Touching, speed: f64, gravity: f64) -> f64 {
    let present = present_stiffness(touching);
    let heaviest = heaviest(touching);
    let bound = |speed: f64| {
        let ratio = |(sphere, sum): (&Sphere, &f64)| {
            sum.max(collision_stiffness(&touching.law, sphere, heaviest, speed)) / sphere.mass
        };
        2.0 / touching.spheres.iter().zip(&present).map(ratio).fold(0.0, f64::max).sqrt()
    };
    let now = bound(speed);
    if gravity > 0.0 { bound(speed + gravity * LOOK_EVERY as f64 * now) } else { now }
}

/// Σ_c (2 k_n + 5 k_t) [N/m] over the contacts of each sphere; at least that of [`FEWEST_CONTACTS`] contacts in a collision.
pub(crate) fn contact_stiffness(touching: &Touching, speed: f64) -> Vec<f64> {
    let (present, heaviest) = (present_stiffness(touching), heaviest(touching));
    let present = present.into_iter().zip(touching.spheres);
    present
        .map(|(sum, sphere)| sum.max(collision_stiffness(&touching.law, sphere, heaviest, speed)))
        .collect()
}

/// 2 k_n + 5 k_t of a contact over its size.
fn stiffness_per_size(law: &ContactLaw) -> f64 {
    // The tangent of 4/3 E* a δ is 2 E* a, 3/2 times the secant.
    let tangent = if law.hertz { 1.5 } else { 1.0 };
    2.0 * tangent * law.normal + 5.0 * law.tangential
}

/// The sum over the contacts that are there.
fn present_stiffness(touching: &Touching) -> Vec<f64> {
    let per_size = stiffness_per_size(&touching.law);
    let mut stiffness = vec![0.0; touching.spheres.len()];
    touching.for_each(|contact| {
        let both = per_size * touching.law.size(contact.overlap, contact.effective_radius);
        // A wall does not move: half of what two spheres that move against each other have.
        let factor = if matches!(contact.i, Partner::Wall(_)) { 0.5 } else { 1.0 };
        contact.spheres().for_each(|sphere| stiffness[sphere] += factor * both);
    });
    stiffness
}

/// Largest mass \[kg\].
fn heaviest(touching: &Touching) -> f64 {
    touching.spheres.iter().fold(0.0, |heaviest, sphere| sphere.mass.max(heaviest))
}

/// The sum over [`FEWEST_CONTACTS`] contacts in a collision with the heaviest sphere at twice the speed. The ratio of the radii is taken from the
/// masses, which do not change with temperature; it is exact for equal spheres.
fn collision_stiffness(law: &ContactLaw, sphere: &Sphere, heaviest: f64, speed: f64) -> f64 {
    let lighter = sphere.mass / heaviest;
    let smaller = if lighter == 1.0 { 1.0 } else { libm::cbrt(lighter) };
    let effective_radius = sphere.radius / (1.0 + smaller);
    // Largest overlap, by the energy of the elastic law: 2/5 k δ^(5/2) = m* v²/2 with k = 4/3 E* √R*.
    let overlap = if law.hertz {
        let energy = 0.5 * (sphere.mass / (1.0 + lighter)) * 4.0 * speed * speed;
        let spring = 0.4 * law.normal * effective_radius.sqrt();
        libm::pow(energy / spring, 0.4).max(MIN_OVERLAP * sphere.radius)
    } else {
        sphere.radius
    };
    FEWEST_CONTACTS * stiffness_per_size(law) * law.size(overlap, effective_radius)
}
