//! Conductivity of a periodic box: the network of its conductances is solved for a unit gradient along each axis.
//!
//! Contacts and gas are two networks whose conductivities add, K = k_s κ_c + k_g κ_g: each of κ_c and κ_g is free of the
//! other's material. One network of both conducts a little more.

use crate::conductances::Link;
use crate::solve::{conjugate_gradients, inner};
use msdd_spheres::space::dot;

/// Residual over the right-hand side at which a solution counts as found.
const RESIDUAL: f64 = 1e-11;

/// Conductivity of a network in a periodic box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductivity {
    /// K \[W/(m K)\], at equilibrium of the heat at each sphere.
    pub network: [[f64; 3]; 3],
    /// K if each sphere had the temperature of the mean gradient at its centre: an upper bound.
    pub affine: [[f64; 3]; 3],
}

/// A third of the trace.
pub fn mean(tensor: &[[f64; 3]; 3]) -> f64 {
    (tensor[0][0] + tensor[1][1] + tensor[2][2]) / 3.0
}

/// Conductivity of `links` between `count` spheres in a periodic box of `volume` \[m³\]. Clusters that do not reach across
/// the box conduct nothing. None when the iteration does not converge: conductances that are not finite, or of too
/// unequal size.
pub fn conductivity(links: &[Link], count: usize, volume: f64) -> Option<Conductivity> {
    let mut diagonal = vec![0.0; count];
    for link in links {
        diagonal[link.i] += link.conductance;
        diagonal[link.j] += link.conductance;
    }
    diagonal.iter_mut().filter(|sum| **sum == 0.0).for_each(|sum| *sum = 1.0);
    let mut sums = Conductivity { network: [[0.0; 3]; 3], affine: [[0.0; 3]; 3] };
    for axis in 0..3 {
        let deviation = temperatures(links, &diagonal, axis)?;
        for link in links {
            let straight = link.branch[axis];
            let rise = straight + deviation[link.j] - deviation[link.i];
            for along in 0..3 {
                let per_volume = link.conductance * link.branch[along] / volume;
                sums.network[along][axis] += per_volume * rise;
                sums.affine[along][axis] += per_volume * straight;
            }
        }
    }
    Some(sums)
}

/// Deviations from the mean temperature field x_axis, so that no heat stays at any sphere: conjugate gradients with the
/// diagonal as the preconditioner. The network is free of a reference temperature, which does no harm: the heat of each
/// cluster sums to 0.
fn temperatures(links: &[Link], diagonal: &[f64], axis: usize) -> Option<Vec<f64>> {
    let mut residual = vec![0.0; diagonal.len()];
    for link in links {
        let heat = link.conductance * link.branch[axis];
        residual[link.i] += heat;
        residual[link.j] -= heat;
    }
    // The scale of the heat, for crystals, whose residuals are all round-off from the beginning.
    let scale = links
        .iter()
        .map(|link| link.conductance * link.conductance * dot(link.branch, link.branch))
        .sum::<f64>();
    let apply = |direction: &[f64], flow: &mut [f64]| {
        for link in links {
            let heat = link.conductance * (direction[link.i] - direction[link.j]);
            flow[link.i] += heat;
            flow[link.j] -= heat;
        }
    };
    let enough = |residual: &[f64]| inner(residual, residual) <= RESIDUAL * RESIDUAL * scale;
    conjugate_gradients(apply, diagonal, &mut residual, enough)
}
