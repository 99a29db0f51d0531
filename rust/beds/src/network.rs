//! The network of a bed at rest: what conducts between which spheres and plates, and how well at given temperatures.

use crate::conductances::{Near, near_pairs};
use crate::effective::{contact_factor, gas_alone, pair_factor};
use crate::exchange::Exchange;
use crate::gas::{Gas, unequal_conductance};
use crate::named_gases::GasName;
use crate::plate_view_areas::{Facing, facing};
use crate::property::Property;
use crate::radiation::STEFAN_BOLTZMANN;
use crate::radiation::{Dark, black, factor};
use crate::solid::{Roughness, Solid};
use msdd_spheres::{Partner, Simulation, Surface};

/// What the bed is made of, as far as heat is concerned.
#[derive(Clone, Debug, PartialEq)]
pub struct Materials {
    /// k_s \[W/(m K)\] of the spheres.
    pub conductivity: Property,
    /// c \[J/(kg K)\] of the spheres.
    pub heat_capacity: Property,
    /// E* \[Pa\] of two spheres, of the real material.
    pub effective_modulus: f64,
    pub roughness: Option<Roughness>,
    pub gas: GasName,
    /// \[Pa\]
    pub gas_pressure: f64,
    /// α \[-\] of the gas at all surfaces.
    pub accommodation: f64,
    /// φ \[-\] with which spheres that conduct poorly follow the closure of [`crate::effective`]; none: pairs alone.
    pub solid_fraction: Option<f64>,
}

/// A wall of given temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plate {
    /// By the number of the wall.
    pub wall: usize,
    pub law: PlateLaw,
}

/// How a plate passes heat on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlateLaw {
    /// All spheres with their centre within a diameter of the plate have its temperature: the most that a plate can do.
    Held,
    /// Through contacts and gas between it and each sphere.
    Resisting {
        /// k \[W/(m K)\] of the plate; none: its surface has one temperature.
        conductivity: Option<f64>,
        /// E* \[Pa\] of a sphere and the plate.
        effective_modulus: f64,
        roughness: Option<Roughness>,
    },
}

/// A contact between two spheres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    pub i: usize,
    pub j: usize,
    /// Conductance over k_s \[m\].
    pub size: f64,
    /// 2 R* \[m\], as of [`Near`].
    pub radius: f64,
}

/// A sphere next to a plate.
#[derive(Clone, Debug, PartialEq)]
pub struct Beside {
    pub plate: usize,
    /// Conductance of the contact over the harmonic mean of both conductivities \[m\]; 0 if they do not touch.
    pub size: f64,
    /// k \[W/(m K)\] of the plate.
    pub conductivity: Option<f64>,
    pub radius: f64,
    /// Which sphere, and its part of the plate.
    pub facing: Facing,
}

/// Surfaces that exchange heat by radiation.
#[derive(Clone, Debug, PartialEq)]
pub struct Surfaces {
    /// ε of the spheres, and with which rays were traced.
    pub emissivity: Property,
    pub traced: f64,
    /// ε A s \[m²\] between spheres, and between a sphere and a plate, by their numbers.
    pub spheres: Vec<(usize, usize, f64)>,
    pub plates: Vec<(usize, usize, f64)>,
}

/// φ by which an emissivity that varies is scaled where no other is given; it hardly matters.
const REFERENCE_FRACTION: f64 = 0.6;

/// A bed at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Network {
    pub materials: Materials,
    /// m \[kg\] of each sphere, and its radius \[m\].
    pub mass: Vec<f64>,
    pub radii: Vec<f64>,
    /// Heat that each sphere releases, over its volume \[W/m³\].
    pub source: f64,
    pub contacts: Vec<Joint>,
    pub gaps: Vec<Near>,
    pub beside: Vec<Beside>,
    /// For each sphere that has the temperature of a plate, the plate.
    pub held: Vec<Option<usize>>,
    /// None: without radiation.
    pub surfaces: Option<Surfaces>,
}

/// Conductances \[W/K\] at some temperatures.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Conductances {
    /// Between spheres i and j.
    pub links: Vec<(usize, usize, f64)>,
    /// Between a sphere and a plate, by their numbers.
    pub plates: Vec<(usize, usize, f64)>,
}

/// Of a sphere \[m³\].
pub(crate) fn volume(radius: f64) -> f64 {
    4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius
}

impl Network {
    pub fn new(simulation: &Simulation, materials: Materials, plates: &[Plate]) -> Self {
        let solid = Solid {
            conductivity: 1.0,
            effective_modulus: materials.effective_modulus,
            roughness: materials.roughness,
        };
        let mut contacts = Vec::new();
        // Force on each sphere from each wall.
        let mut at_walls = std::collections::BTreeMap::new();
        simulation.for_each_contact(|contact| match contact.i {
            Partner::Sphere(i) => {
                let size = solid.contact_size(contact.normal_force, contact.effective_radius);
                contacts.push(Joint { i, j: contact.j, size, radius: 2.0 * contact.effective_radius });
            }
            Partner::Wall(wall) => {
                at_walls.insert((wall, contact.j), contact.normal_force);
            }
        });
        let count = simulation.spheres.len();
        let mut network = Self {
            materials,
            mass: simulation.spheres.iter().map(|sphere| sphere.mass).collect(),
            radii: simulation.spheres.iter().map(|sphere| sphere.radius).collect(),
            source: 0.0,
            contacts,
            gaps: near_pairs(simulation),
            beside: Vec::new(),
            held: vec![None; count],
            surfaces: None,
        };
        for (number, plate) in plates.iter().enumerate() {
            match plate.law {
                PlateLaw::Held => {
                    let wall = simulation.boundary.walls()[plate.wall];
                    for (held, sphere) in network.held.iter_mut().zip(&simulation.spheres) {
                        if wall.distance(sphere.position) < 2.0 * sphere.radius {
                            *held = Some(number);
                        }
                    }
                }
                PlateLaw::Resisting { conductivity, effective_modulus, roughness } => {
                    let pair = Solid { conductivity: 1.0, effective_modulus, roughness };
                    // Of the sphere and the wall: 1 over it is the root of the product of both curvatures' sums.
                    let round = |radius: f64| match simulation.boundary.walls()[plate.wall].surface {
                        Surface::Flat { .. } => radius,
                        Surface::Cylinder { radius: side, .. } => radius / (1.0 - radius / side).sqrt(),
                    };
                    network.beside.extend(facing(simulation, plate.wall).into_iter().map(|facing| {
                        let force = at_walls.get(&(plate.wall, facing.sphere)).copied().unwrap_or_default();
                        let radius = simulation.spheres[facing.sphere].radius;
                        let size = pair.contact_size(force, round(radius));
                        Beside { plate: number, size, conductivity, radius, facing }
                    }));
                }
            }
        }
        network
    }

    /// Heat that the spheres release which no plate holds \[W\].
    pub fn released(&self) -> f64 {
        let free = self.held.iter().zip(&self.radii).filter(|(held, _)| held.is_none());
        self.source * free.map(|(_, radius)| volume(*radius)).sum::<f64>()
    }

    /// The same with radiation, if there is any, between the spheres, and between them and the plates, whose walls have these numbers.
    /// `emissivity`: of the spheres, unless it is the one with which rays were traced.
    pub fn radiating(
        mut self,
        exchange: Option<&Exchange>,
        emissivity: Option<Property>,
        walls: &[usize],
    ) -> Self {
        let Some(exchange) = exchange else { return self };
        let at = |(plate, wall): (usize, &usize)| {
            exchange.at_wall(*wall).into_iter().map(move |(sphere, size)| (sphere, plate, size))
        };
        self.surfaces = Some(Surfaces {
            emissivity: emissivity.unwrap_or(Property::Constant(exchange.emissivities.spheres)),
            traced: exchange.emissivities.spheres,
            spheres: exchange.pairs(),
            plates: walls.iter().enumerate().flat_map(at).collect(),
        });
        self
    }

    /// The conductivity by radiation of a bed of spheres as each one, over that of spheres of one temperature with the emissivity with
    /// which rays were traced ([`crate::radiation`]).
    fn left(&self, surfaces: &Surfaces, temperatures: &[f64]) -> Vec<f64> {
        let m = &self.materials;
        let fraction = m.solid_fraction.unwrap_or(REFERENCE_FRACTION);
        let traced = factor(surfaces.traced, fraction);
        let of = |(t, radius): (&f64, &f64)| {
            let emissivity = surfaces.emissivity.at(*t);
            let Some(solid_fraction) = m.solid_fraction else { return factor(emissivity, fraction) / traced };
            let (solid, gas) = (m.conductivity.at(*t), m.gas.at(*t, m.gas_pressure, m.accommodation));
            let conductivity = gas.as_ref().map_or(0.0, |gas| gas_alone(gas, solid, *radius, solid_fraction));
            let gas = gas.map_or(0.0, |gas| gas.conductivity);
            let bed = Dark { conductivity, solid, gas, solid_fraction };
            let black = black(*t, 2.0 * radius);
            bed.radiation(black, emissivity) / (black * traced)
        };
        temperatures.iter().zip(&self.radii).map(of).collect()
    }

    /// Adds those of radiation: σ (T₁² + T₂²)(T₁ + T₂) ε A s, so that the heat is that of σ (T₁⁴ − T₂⁴).
    fn add_radiation(&self, found: &mut Conductances, temperatures: &[f64], plates: &[f64]) {
        let Some(surfaces) = &self.surfaces else { return };
        let left = self.left(surfaces, temperatures);
        let between = |a: f64, b: f64| STEFAN_BOLTZMANN * (a * a + b * b) * (a + b);
        found.links.extend(surfaces.spheres.iter().map(|&(i, j, size)| {
            (i, j, 0.5 * (left[i] + left[j]) * size * between(temperatures[i], temperatures[j]))
        }));
        found.plates.extend(
            surfaces.plates.iter().map(|&(i, plate, size)| {
                (i, plate, left[i] * size * between(temperatures[i], plates[plate]))
            }),
        );
    }

    /// Conductances with the properties at the temperatures of the spheres and of the plates \[K\], which are averaged over the
    /// two ends of each link.
    pub fn conductances(&self, temperatures: &[f64], plates: &[f64]) -> Conductances {
        let m = &self.materials;
        let mean = |i: usize, j: usize| 0.5 * (temperatures[i] + temperatures[j]);
        // Properties of the gas by sphere: there are several times fewer spheres than pairs.
        let gas = |t: f64| m.gas.at(t, m.gas_pressure, m.accommodation);
        let gases: Option<Vec<_>> = temperatures.iter().map(|&t| gas(t)).collect();
        let adds = |c: &Joint, solid: f64| match (&gases, m.solid_fraction) {
            (Some(gases), Some(_)) => {
                let gas = 0.5 * (gases[c.i].conductivity + gases[c.j].conductivity);
                contact_factor(solid / gas, 0.5 * c.size / c.radius)
            }
            _ => 1.0,
        };
        let mut links: Vec<(usize, usize, f64)> = (self.contacts.iter())
            .map(|c| {
                let solid = m.conductivity.at(mean(c.i, c.j));
                (c.i, c.j, solid * c.size * adds(c, solid))
            })
            .collect();
        let poor = |gas: &Gas, solid: f64, radius: f64| {
            m.solid_fraction.map_or(1.0, |phi| pair_factor(gas, solid, radius, phi))
        };
        if let Some(gases) = &gases {
            for near in &self.gaps {
                let (a, b) = (&gases[near.i], &gases[near.j]);
                let solid = m.conductivity.at(mean(near.i, near.j));
                let least =
                    0.5 * (a.least_distance(near.radius, solid) + b.least_distance(near.radius, solid));
                let factor = 0.5 * (poor(a, solid, near.radius) + poor(b, solid, near.radius));
                let conductivity = 0.5 * factor * (a.conductivity + b.conductivity);
                let (radius, smaller, distance) = (near.radius, near.smaller, near.gap + least);
                links.push((near.i, near.j, unequal_conductance(conductivity, radius, smaller, distance)));
            }
        }
        let beside = |b: &Beside| {
            let sphere = b.facing.sphere;
            let between = 0.5 * (temperatures[sphere] + plates[b.plate]);
            let solid = m.conductivity.at(between);
            let harmonic = b.conductivity.map_or(2.0 * solid, |plate| 2.0 * solid * plate / (solid + plate));
            let by_gas = gas(between).map_or(0.0, |gas| {
                let distance = gas.plate_distance(0.0, b.radius, solid);
                poor(&gas, solid, b.radius) * gas.conductivity * b.facing.size(distance)
            });
            let adds = gas(between)
                .filter(|_| m.solid_fraction.is_some())
                .map_or(1.0, |gas| contact_factor(solid / gas.conductivity, 0.5 * b.size / b.radius));
            (sphere, b.plate, harmonic * b.size * adds + by_gas)
        };
        let mut found = Conductances { links, plates: self.beside.iter().map(beside).collect() };
        self.add_radiation(&mut found, temperatures, plates);
        found
    }
}
