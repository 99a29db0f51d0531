//! What a bed is like between two distances from a plate.

use crate::network::Network;
use crate::solve::{add_flows, conjugate_gradients, inner};
use msdd_spheres::space::{dot, minus, plus, scaled};
use msdd_spheres::{Partner, Simulation, Sphere, Wall};
use std::f64::consts::PI;

/// Averages over a slab of a bed. Compression is positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab {
    /// φ \[-\]
    pub solid_fraction: f64,
    /// z \[-\]: contacts per sphere, with walls, of the spheres with their centre in the slab.
    pub coordination: f64,
    /// p = tr σ/3 \[Pa\].
    pub pressure: f64,
    /// K \[W/(m K)\] across the slab, by contacts, gas and radiation.
    pub contact_conductivity: f64,
    pub gas_conductivity: f64,
    pub radiation_conductivity: f64,
}

/// How wide a slab is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Width {
    /// The whole bed, which has this area parallel to the wall \[m²\].
    Whole(f64),
    /// Between two distances from the z axis \[m\].
    Ring([f64; 2]),
}

impl Width {
    /// \[m²\]
    pub fn area(&self) -> f64 {
        match *self {
            Self::Whole(area) => area,
            Self::Ring([inner, outer]) => PI * (outer * outer - inner * inner),
        }
    }

    fn holds(&self, [x, y, _]: [f64; 3]) -> bool {
        match *self {
            Self::Whole(_) => true,
            Self::Ring([inner, outer]) => (inner..outer).contains(&libm::hypot(x, y)),
        }
    }

    /// Share of a sphere that lies in it; the cylinders around the axis count as flat where they cut the sphere.
    fn share(&self, sphere: &Sphere) -> f64 {
        let Self::Ring([inner, outer]) = *self else { return 1.0 };
        let ([x, y, _], r) = (sphere.position, sphere.radius);
        let off = libm::hypot(x, y);
        (below(r, outer - off) - below(r, inner - off)) / below(r, r)
    }
}

/// The slab from `from` to `to` \[m\] from a wall, which is across the z axis if the slab is a ring. Heat flows through the whole bed, and
/// its flux through the middle of the slab is counted.
pub fn slab(
    simulation: &Simulation,
    network: &Network,
    wall: &Wall,
    [from, to]: [f64; 2],
    width: Width,
    temperature: f64,
) -> Option<Slab> {
    let distances: Vec<f64> = simulation.spheres.iter().map(|s| wall.distance(s.position)).collect();
    let inside = |place: [f64; 3]| (from..to).contains(&wall.distance(place)) && width.holds(place);
    let place = |k: usize| simulation.spheres[k].position;
    let volume = width.area() * (to - from);
    let (mut ends, mut work) = (0, 0.0);
    simulation.for_each_contact(|contact| {
        ends += contact.spheres().filter(|&k| inside(place(k))).count();
        let Partner::Sphere(i) = contact.i else { return };
        if inside(plus(place(i), 0.5, contact.branch)) {
            work += dot(contact.force(), contact.branch);
        }
    });
    let count = simulation.spheres.iter().filter(|s| inside(s.position)).count();
    let [contacts, gas, radiation] = conductances(network, temperature);
    let counts = |i: usize, j: usize| match width {
        Width::Whole(_) => true,
        Width::Ring(_) => width.holds(scaled(0.5, plus(place(i), 1.0, place(j)))),
    };
    let across =
        |links: &[(usize, usize, f64)]| Some(flux(links, &distances, [from, to], counts)? / width.area());
    Some(Slab {
        solid_fraction: solid_fraction(simulation, wall, [from, to], width),
        coordination: ends as f64 / count.max(1) as f64,
        pressure: work / volume / 3.0,
        contact_conductivity: across(&contacts)?,
        gas_conductivity: across(&gas)?,
        radiation_conductivity: across(&radiation)?,
    })
}

/// φ \[-\] between two distances from a wall \[m\].
pub fn solid_fraction(simulation: &Simulation, wall: &Wall, [from, to]: [f64; 2], width: Width) -> f64 {
    let solid = simulation.spheres.iter().map(|s| {
        let distance = wall.distance(s.position);
        (below(s.radius, to - distance) - below(s.radius, from - distance)) * width.share(s)
    });
    solid.sum::<f64>() / (width.area() * (to - from))
}

/// Volume of a sphere below a plane at `height` above its centre \[m³\].
fn below(radius: f64, height: f64) -> f64 {
    let h = (height + radius).clamp(0.0, 2.0 * radius);
    PI * h * h * (radius - h / 3.0)
}

type Links = Vec<(usize, usize, f64)>;

/// The links of a network of one temperature \[K\], through contacts, through gas, and by radiation.
fn conductances(network: &Network, temperature: f64) -> [Links; 3] {
    let temperatures = vec![temperature; network.mass.len()];
    let surfaces =
        network.surfaces.iter().flat_map(|surfaces| &surfaces.plates).map(|(_, plate, _)| plate + 1);
    let plates = network.beside.iter().map(|b| b.plate + 1).chain(surfaces).max().unwrap_or(0);
    let mut contacts = network.conductances(&temperatures, &vec![temperature; plates]).links;
    let mut gas = contacts.split_off(network.contacts.len());
    let rays = network.surfaces.as_ref().map_or(0, |surfaces| surfaces.spheres.len());
    let radiation = gas.split_off(gas.len() - rays);
    [contacts, gas, radiation]
}

/// Heat through the middle of a slab over the mean gradient \[W m/K\], by the links that count: all spheres outside have the temperature of an
/// even gradient, those inside find theirs. None when the solution fails.
pub fn flux(
    links: &[(usize, usize, f64)],
    distances: &[f64],
    [from, to]: [f64; 2],
    counts: impl Fn(usize, usize) -> bool,
) -> Option<f64> {
    let free: Vec<bool> = distances.iter().map(|&d| d > from && d < to).collect();
    let mut diagonal = vec![0.0; distances.len()];
    let mut residual = vec![0.0; distances.len()];
    for &(i, j, g) in links {
        for (a, b) in [(i, j), (j, i)] {
            diagonal[a] += g;
            if free[a] {
                residual[a] += g * (distances[b] - distances[a]);
            }
        }
    }
    diagonal.iter_mut().filter(|sum| **sum == 0.0).for_each(|sum| *sum = 1.0);
    let scale: f64 = links.iter().map(|&(i, j, g)| (g * (distances[i] - distances[j])).powi(2)).sum();
    let apply = |x: &[f64], y: &mut [f64]| add_flows(links, 1.0, |k| free[k], x, y);
    let change = conjugate_gradients(apply, &diagonal, &mut residual, |r| inner(r, r) <= 1e-20 * scale)?;
    let middle = 0.5 * (from + to);
    let flux: f64 = (links.iter())
        .filter(|&&(i, j, _)| (distances[i] < middle) != (distances[j] < middle) && counts(i, j))
        .map(|&(i, j, g)| g * (distances[j] + change[j] - distances[i] - change[i]).abs())
        .sum();
    // The sum of nothing is −0.
    Some(flux + 0.0)
}

/// The line through the temperatures of the spheres within 1.5 d of a distance from a wall, and two d of the middle of the bed along
/// the wall, at that distance; none if there are no spheres.
pub struct Probe {
    /// Number and distance of each sphere.
    spheres: Vec<(usize, f64)>,
    distance: f64,
}

impl Probe {
    pub fn new(simulation: &Simulation, wall: &Wall, normal: [f64; 3], distance: f64) -> Option<Self> {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for sphere in &simulation.spheres {
            for k in 0..3 {
                low[k] = low[k].min(sphere.position[k]);
                high[k] = high[k].max(sphere.position[k]);
            }
        }
        let middle: [f64; 3] = std::array::from_fn(|k| 0.5 * (low[k] + high[k]));
        Self::layer(simulation, wall, distance, |sphere| {
            let away = minus(sphere.position, middle);
            (0..3).all(|k| normal[k].abs() > 0.5 || away[k].abs() < 4.0 * sphere.radius)
        })
    }

    /// All spheres within 1.5 d of the distance that `used` takes.
    pub fn layer(
        simulation: &Simulation,
        wall: &Wall,
        distance: f64,
        used: impl Fn(&Sphere) -> bool,
    ) -> Option<Self> {
        let spheres: Vec<_> = (simulation.spheres.iter().enumerate())
            .map(|(number, sphere)| (number, sphere, wall.distance(sphere.position)))
            .filter(|(_, sphere, from)| (from - distance).abs() < 3.0 * sphere.radius && used(sphere))
            .map(|(number, _, from)| (number, from))
            .collect();
        (!spheres.is_empty()).then_some(Self { spheres, distance })
    }

    /// \[K\]
    pub fn temperature(&self, temperatures: &[f64]) -> f64 {
        let count = self.spheres.len() as f64;
        let mean = |of: &dyn Fn(&(usize, f64)) -> f64| self.spheres.iter().map(of).sum::<f64>() / count;
        let (x, t) = (mean(&|s| s.1), mean(&|s| temperatures[s.0]));
        let spread = mean(&|s| (s.1 - x) * (s.1 - x));
        if spread == 0.0 {
            return t;
        }
        t + (self.distance - x) * mean(&|s| (s.1 - x) * (temperatures[s.0] - t)) / spread
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chain_conducts_as_its_links() {
        // Ten nodes 1 apart, each link 2 W/K: K/area = 2 W/K over 1 m per area.
        let links: Links = (1..10).map(|j| (j - 1, j, 2.0)).collect();
        let distances: Vec<f64> = (0..10).map(f64::from).collect();
        let found = flux(&links, &distances, [2.4, 6.6], |_, _| true).unwrap();
        assert!((found - 2.0).abs() < 1e-12, "{found}");
        // One weak link in a slab of four: the series of all.
        let mut weak = links;
        weak[4].2 = 0.5;
        let found = flux(&weak, &distances, [2.4, 6.6], |_, _| true).unwrap();
        // Nodes 2 and 7 are held, 5 apart: 1/G = 4/2 + 1/0.5.
        assert!((found - 5.0 / (4.0 / 2.0 + 1.0 / 0.5)).abs() < 1e-9, "{found}");
        assert_eq!(flux(&weak, &distances, [2.4, 6.6], |_, _| false).unwrap(), 0.0);
    }

    #[test]
    fn halves_of_a_sphere_are_halves() {
        assert!((below(2.0, 0.0) / (4.0 / 3.0 * PI * 8.0) - 0.5).abs() < 1e-15);
        assert_eq!(below(2.0, -3.0), 0.0);
    }
}
