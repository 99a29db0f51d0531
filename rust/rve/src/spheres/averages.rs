//! Averages of a periodic box of spheres.

use super::strain::{PLACES, Tensor};
use msdd_beds::conductances::{contact_links, gas_links, near_pairs};
use msdd_beds::conductivity::{conductivity, mean};
use msdd_beds::solid::Solid;
use msdd_spheres::{Cell, Simulation};

/// ℓ = ln(R/h) of the gas, for which its reduced conductivity is found: h is the distance in the law of the gas
/// ([`msdd_beds::gas`]) of two spheres that touch. κ_g is nearly quadratic in ℓ, so these three give it for any gas between.
pub const GAS_NUMBERS: [f64; 3] = [3.5, 6.0, 8.5];

/// Averages of a periodic box. Compression is positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Averages {
    /// φ \[-\], overlaps counted twice.
    pub solid_fraction: f64,
    /// z \[-\], all spheres counted.
    pub coordination: f64,
    /// z* \[-\], without rattlers.
    pub backbone_coordination: f64,
    /// Part of the spheres that are rattlers.
    pub rattlers: f64,
    /// Spheres nearer than 1.18 diameters, the distance up to which gas conducts, per sphere.
    pub neighbours: f64,
    /// Mean of n n over the contacts; 0 without contacts.
    pub fabric: Tensor,
    /// σ/E* \[-\], the symmetric part of Love's stress.
    pub stress: Tensor,
    /// κ_c \[-\]: conductivity by the contacts over that of the solid.
    pub contact_conductivity: Tensor,
    /// κ_g \[-\] at [`GAS_NUMBERS`]: mean conductivity by the gas over that of the gas.
    pub gas_conductivity: [f64; 3],
}

impl Averages {
    /// p/E* \[-\].
    pub fn pressure(&self) -> f64 {
        (self.stress[0] + self.stress[1] + self.stress[2]) / 3.0
    }
}

/// Averages of a periodic box of a material with E* = 1. None between walls, or when a network is not solved.
pub fn averages(simulation: &Simulation) -> Option<Averages> {
    let volume = simulation.cell().map(Cell::volume)?;
    let count = simulation.spheres.len();
    let state = msdd_beds::averages(simulation);
    let solid = Solid { conductivity: 1.0, effective_modulus: 1.0, roughness: None };
    let contacts = conductivity(&contact_links(simulation, &solid), count, volume)?.network;
    let near = near_pairs(simulation);
    // One gas for all pairs: h is that of the mean radius where spheres are unequal.
    let masses = simulation.spheres.iter().map(|sphere| sphere.mass);
    let [light, heavy] = masses.fold([f64::INFINITY, 0.0], |[low, high], m| [m.min(low), m.max(high)]);
    let common = (light < heavy).then(|| simulation.mean_radius());
    let mut gas_conductivity = [0.0; 3];
    for (value, number) in gas_conductivity.iter_mut().zip(GAS_NUMBERS) {
        let distance = libm::exp(-number);
        let links = gas_links(&near, 1.0, |radius| distance * common.unwrap_or(radius));
        *value = mean(&conductivity(&links, count, volume)?.network);
    }
    Some(Averages {
        solid_fraction: state.solid_fraction,
        coordination: state.coordination,
        backbone_coordination: state.backbone_coordination,
        rattlers: state.rattlers,
        neighbours: 2.0 * near.len() as f64 / count as f64,
        fabric: fabric(simulation),
        stress: symmetric(&state.stress),
        contact_conductivity: symmetric(&contacts),
        gas_conductivity,
    })
}

/// The symmetric part.
fn symmetric(tensor: &[[f64; 3]; 3]) -> Tensor {
    PLACES.map(|(row, column)| 0.5 * (tensor[row][column] + tensor[column][row]))
}

fn fabric(simulation: &Simulation) -> Tensor {
    let (mut sum, mut count) = ([0.0; 6], 0.0f64);
    simulation.for_each_contact(|contact| {
        count += 1.0;
        for (sum, (row, column)) in sum.iter_mut().zip(PLACES) {
            *sum += contact.normal[row] * contact.normal[column];
        }
    });
    sum.map(|sum| sum / count.max(1.0))
}
