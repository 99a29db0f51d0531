//! Averages of an assembly over a region (section 2.3).

use crate::area::{porosity, sum_of_areas};
use crate::network::Network;
use crate::region::{Cut, Polygon, RegionKind, contact_share, region};
use msdd_dem::heat::chord;
use msdd_dem::{Contact, Simulation};

/// Macroscopic state of an assembly. Compression positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Averages {
    /// η [-], overlaps counted once, of the region.
    pub porosity: f64,
    /// 1 − Σ π r² / box area [-], for the whole box: obeys 1−η = (1−η₀)(1+ε)² exactly in fixed walls.
    pub porosity_sum_of_areas: f64,
    /// Part of the region that is covered more than once [-], counted once for each additional cover. 1 − η + this is
    /// the solid fraction by the mass of the grains.
    pub overlap_fraction: f64,
    /// f = F_xx − F_yy [-], each contact counting 1 (Eq. 8).
    pub fabric_index: f64,
    /// F_xx, F_yy [-]: mean of n n over the contacts (Eq. 8); 1 in sum.
    pub fabric_xx: f64,
    pub fabric_yy: f64,
    /// F_xy [-]: mean of n_x n_y over the contacts; positive when more of them point up to the right than down to it.
    pub fabric_xy: f64,
    /// f_K = (K_xx − K_yy)/(K_xx + K_yy) [-].
    pub fabric_conductivity: f64,
    /// K/k [-], affine estimate (Eq. 9: all temperatures linear in the position).
    pub conductivity_xx: f64,
    pub conductivity_yy: f64,
    pub conductivity_xy: f64,
    /// K/k [-] from the network of contacts solved for a unit gradient ([`crate::network`]); the affine estimate is
    /// higher.
    pub conductivity_network_xx: f64,
    pub conductivity_network_yy: f64,
    pub conductivity_network_xy: f64,
    /// σ \[Pa\], Love's formula (Eq. 10), compression positive; σ_ab sums branch_a force_b.
    pub stress_xx: f64,
    pub stress_yy: f64,
    pub stress_xy: f64,
    pub stress_yx: f64,
    /// p = (σ_xx + σ_yy)/2 \[Pa\] (Eq. 11).
    pub pressure: f64,
    /// Mean number of force-bearing contacts, walls included, of the discs with a contact [-].
    pub coordination: f64,
    /// Discs without force-bearing contact, in the whole box.
    pub rattlers: u64,
    /// Number of pair contacts that were counted, wholly or in part.
    pub contacts: u64,
    /// r̄ \[m\], current.
    pub mean_radius: f64,
}

/// Sums over the contacts of a region.
#[derive(Default)]
struct Sums {
    contacts: u64,
    fabric: f64,
    fabric_squares: [f64; 2],
    fabric_product: f64,
    conductance: [f64; 3],
    stress: [f64; 4],
}

impl Sums {
    /// Adds a pair contact; `weight` is the share of its branch that lies inside the region. `radii` are those of i and
    /// j [m].
    fn add(&mut self, contact: &Contact, radii: [f64; 2], weight: f64) {
        let ([nx, ny], [dx, dy]) = (contact.normal, contact.branch);
        self.contacts += 1;
        self.fabric += nx * nx - ny * ny;
        self.fabric_squares[0] += nx * nx;
        self.fabric_squares[1] += ny * ny;
        self.fabric_product += nx * ny;
        // k A |d| n⊗n with k = 1, where A is the common chord of the two circles times 1 m.
        let strength = weight * chord(radii, dx.hypot(dy)) * dx.hypot(dy);
        self.conductance[0] += strength * nx * nx;
        self.conductance[1] += strength * ny * ny;
        // The brackets make the result the same, bit for bit up to the sign, after a quarter turn of the assembly.
        self.conductance[2] += strength * (nx * ny);
        let [fx, fy] = contact.force();
        for (sum, moment) in self.stress.iter_mut().zip([dx * fx, dy * fy, dx * fy, dy * fx]) {
            *sum += weight * moment;
        }
    }
}

/// Averages over the region of the given kind, contacts clipped at its border. Wall contacts are left out.
pub fn homogenise(simulation: &Simulation, kind: RegionKind) -> Averages {
    homogenise_in(simulation, &region(simulation, kind), Cut::Clip)
}

/// Averages over a given region; for a periodic box the region must be its cell, see [`region`].
pub fn homogenise_in(simulation: &Simulation, region: &Polygon, cut: Cut) -> Averages {
    let [xx, yy, xy] = Network::of_region(simulation, region, cut).conductivity(region.area());
    Averages {
        conductivity_network_xx: xx,
        conductivity_network_yy: yy,
        conductivity_network_xy: xy,
        ..homogenise_affine_in(simulation, region, cut)
    }
}

/// As [`homogenise_in`], but without solving the network, which takes the longer, the larger the region. The network
/// conductivities are NaN.
pub fn homogenise_affine_in(simulation: &Simulation, region: &Polygon, cut: Cut) -> Averages {
    let mut sums = Sums::default();
    let mut degree = vec![0u32; simulation.discs.len()];
    simulation.for_each_contact(|contact| {
        contact.discs().for_each(|k| degree[k] += 1);
        if let Ok(i) = contact.i {
            let (a, b) = (&simulation.discs[i], &simulation.discs[contact.j]);
            let weight = contact_share(simulation, region, cut, [i, contact.j]);
            if weight > 0.0 {
                sums.add(&contact, [a.radius, b.radius], weight);
            }
        }
    });
    let rattlers = degree.iter().filter(|&&d| d == 0).count();
    let bearing = (degree.len() - rattlers).max(1);
    let per_area = 1.0 / region.area();
    let [kxx, kyy, kxy] = sums.conductance.map(|sum| sum * per_area);
    let [sxx, syy, sxy, syx] = sums.stress.map(|sum| sum * per_area);
    let disc_area: f64 = simulation.discs.iter().map(|d| d.area()).sum();
    let porosity = porosity(simulation, region);
    let whole = simulation.periodic.is_some();
    let covered = if whole { disc_area } else { sum_of_areas(&simulation.discs, region) };
    Averages {
        porosity,
        overlap_fraction: covered * per_area - (1.0 - porosity),
        porosity_sum_of_areas: 1.0 - disc_area / simulation.walls.area(),
        fabric_index: sums.fabric / (sums.contacts.max(1)) as f64,
        fabric_xx: sums.fabric_squares[0] / (sums.contacts.max(1)) as f64,
        fabric_yy: sums.fabric_squares[1] / (sums.contacts.max(1)) as f64,
        fabric_xy: sums.fabric_product / (sums.contacts.max(1)) as f64,
        fabric_conductivity: if kxx + kyy > 0.0 { (kxx - kyy) / (kxx + kyy) } else { 0.0 },
        conductivity_xx: kxx,
        conductivity_yy: kyy,
        conductivity_xy: kxy,
        conductivity_network_xx: f64::NAN,
        conductivity_network_yy: f64::NAN,
        conductivity_network_xy: f64::NAN,
        stress_xx: sxx,
        stress_yy: syy,
        stress_xy: sxy,
        stress_yx: syx,
        pressure: 0.5 * (sxx + syy),
        coordination: f64::from(degree.iter().sum::<u32>()) / bearing as f64,
        rattlers: rattlers as u64,
        contacts: sums.contacts,
        mean_radius: simulation.mean_radius(),
    }
}

#[cfg(test)]
#[path = "homogenise_tests.rs"]
mod tests;
