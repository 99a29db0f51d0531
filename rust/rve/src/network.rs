//! Conductivity of a region from the network of its contacts, solved for a unit gradient along x and along y.
//!
//! Temperatures are T = G·x + T′, with the imposed gradient G. The affine estimate (Eq. 9) sets T′ = 0 everywhere;
//! since the heat of the discs is then not in balance, it is an upper bound. Here T′ is such that the heat of every
//! disc in the region is in balance, and T′ = 0 outside of it. This boundary condition has little influence: windows of
//! 500 discs solved with a margin of 8 mean radii give the same within 0.1 %. The equations contain only branch vectors
//! and no positions, so contacts across the border of a periodic cell need no special treatment.

use crate::region::{Cut, Polygon, contact_share};
use crate::resistors::Resistors;
use msdd_dem::heat::conductance;
use msdd_dem::{Disc, Simulation};

/// A contact as a resistor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    pub i: usize,
    pub j: usize,
    /// From i to j \[m\].
    pub branch: [f64; 2],
    /// A/|d|: conductance over k, for 1 m depth [-].
    pub conductance: f64,
    /// Share of the branch that counts in the average over the region, 0 to 1.
    pub share: f64,
}

/// Discs and their contacts. The heat of the discs in `free` is in balance; the other discs keep the affine
/// temperature.
#[derive(Clone, Debug, PartialEq)]
pub struct Network {
    pub links: Vec<Link>,
    /// The discs whose T′ is unknown, in the order of elimination; neighbours should be close together in it.
    pub free: Vec<usize>,
}

impl Network {
    /// The network of a region. Discs with their centre inside that touch no wall are free. Discs at a wall must not be
    /// free: the wall is no part of the network and would act as an insulator where the gradient is imposed (results up
    /// to 7 % low). Wall contacts are left out of the average. In a periodic box all discs are free, as it has no
    /// border.
    pub fn of_region(simulation: &Simulation, region: &Polygon, cut: Cut) -> Self {
        let cell = simulation.periodic.is_some();
        let mut free: Vec<bool> =
            simulation.discs.iter().map(|d| cell || region.contains([d.x, d.y])).collect();
        simulation.for_each_contact(|contact| {
            if contact.i.is_err() {
                free[contact.j] = false;
            }
        });
        let mut links = Vec::new();
        simulation.for_each_contact(|contact| {
            let Ok(i) = contact.i else { return };
            let share = contact_share(simulation, region, cut, [i, contact.j]);
            if share > 0.0 || free[i] || free[contact.j] {
                let conductance = conductance(&contact, &simulation.discs, 1.0);
                links.push(Link { i, j: contact.j, branch: contact.branch, conductance, share });
            }
        });
        Self { links, free: sorted_along(simulation, 0, |k| free[k]) }
    }

    /// K/k [-] as xx, yy, xy: Σ share · flow · branch / area, the mean flux for a unit gradient, with the weights of
    /// Eq. 9. The two mixed components K_xy and K_yx differ because the border cuts contacts; xy is their mean. `area`
    /// is that of the region \[m²\].
    pub fn conductivity(&self, area: f64) -> [f64; 3] {
        let fluctuation = self.fluctuations();
        let mut sums = [[0.0; 2]; 2];
        for link in &self.links {
            let ([i, j], [dx, dy]) = ([fluctuation(link.i), fluctuation(link.j)], link.branch);
            for (axis, along) in [dx, dy].into_iter().enumerate() {
                let flow = link.share * link.conductance * (along + j[axis] - i[axis]);
                sums[axis][0] += flow * dx;
                sums[axis][1] += flow * dy;
            }
        }
        [sums[0][0] / area, sums[1][1] / area, 0.5 * (sums[0][1] + sums[1][0]) / area]
    }

    /// T′ of each disc for a unit gradient along x and along y [K per K/m].
    pub(crate) fn fluctuations(&self) -> impl Fn(usize) -> [f64; 2] {
        const KNOWN: usize = usize::MAX;
        let largest = self.links.iter().map(|l| l.i.max(l.j)).chain(self.free.iter().copied()).max();
        let mut unknown = vec![KNOWN; largest.map_or(0, |k| k + 1)];
        self.free.iter().enumerate().for_each(|(row, &disc)| unknown[disc] = row);
        let mut resistors = Resistors::new(self.free.len(), 2);
        for link in self.links.iter().filter(|link| link.conductance != 0.0) {
            let (i, j) = (unknown[link.i], unknown[link.j]);
            match (i, j) {
                (KNOWN, KNOWN) => {}
                (KNOWN, row) | (row, KNOWN) => resistors.ground[row] += link.conductance,
                _ => resistors.links.push((i, j, link.conductance)),
            }
            for (axis, along) in link.branch.into_iter().enumerate() {
                // Heat flow from j to i at the affine temperatures.
                let flow = link.conductance * along;
                if i != KNOWN {
                    resistors.heat[(i, axis)] += flow;
                }
                if j != KNOWN {
                    resistors.heat[(j, axis)] -= flow;
                }
            }
        }
        let solution = resistors.temperatures();
        move |disc| match (unknown[disc], &solution) {
            (_, None) => [f64::NAN; 2],
            (KNOWN, _) => [0.0; 2],
            (row, Some(t)) => [t[(row, 0)], t[(row, 1)]],
        }
    }
}

/// The chosen discs sorted along x (`axis` 0) or y (1), which keeps the fill-in of the factorisation small.
pub(crate) fn sorted_along(
    simulation: &Simulation,
    axis: usize,
    chosen: impl Fn(usize) -> bool,
) -> Vec<usize> {
    let at = |k: usize| {
        let Disc { x, y, .. } = simulation.discs[k];
        // The periodic cell is folded about its middle, so that discs on both sides of its border come close together
        // in the order.
        simulation.cell().map_or([x, y], |cell| cell.fraction(x, y).map(|f| (f - f.floor() - 0.5).abs()))
            [axis]
    };
    let mut order: Vec<usize> = (0..simulation.discs.len()).filter(|&k| chosen(k)).collect();
    order.sort_by(|&a, &b| at(a).total_cmp(&at(b)));
    order
}

#[cfg(test)]
#[path = "network_tests.rs"]
mod tests;
