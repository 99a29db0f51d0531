//! Heat through the contacts: thermal pipes between discs and to walls (Eq. 5 and Table 1, last row).
//!
//! Conductances are taken once a mechanical step from the geometry; within it, temperatures advance by explicit Euler
//! in as many sub-steps as stability asks for. The thermal limit is the smaller one in dense assemblies: a single
//! squeezed small disc sets it.

use crate::contact::Contact;
use crate::disc::Disc;
use crate::simulation::Simulation;
use crate::walls::Side;

/// Thermal parameters of the grains (Table 2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thermal {
    /// k [W/(m K)].
    pub conductivity: f64,
    /// c [J/(kg K)].
    pub heat_capacity: f64,
    /// α [1/K], linear.
    pub expansion: f64,
}

impl Default for Thermal {
    /// Table 2 of the paper.
    fn default() -> Self {
        Self { conductivity: 100.0, heat_capacity: 1.0, expansion: 1e-3 }
    }
}

/// What a wall does to heat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WallHeat {
    Insulated,
    /// Fixed temperature [K].
    Temperature(f64),
    /// Heat into the grains [W] in all, shared among the touching discs in proportion to their conductances. With no disc
    /// touching none flows.
    Flux(f64),
}

/// Sub-steps are at most this times the stability limit 2/λ_max: Euler is non-oscillatory below 1/2, and the power
/// iteration approaches λ_max from below.
pub const SAFETY: f64 = 0.45;
/// Power iterations between two mechanical steps; the vector is kept, so they add up as the network changes slowly.
const POWER_ITERATIONS: usize = 2;

/// The pipes of one assembly, and what has flowed.
#[derive(Clone, Debug)]
pub struct HeatPipes {
    pub thermal: Thermal,
    pub walls: [WallHeat; 4],
    /// T at which each disc has its reference radius [K].
    pub(crate) reference_temperature: Vec<f64>,
    /// Heat that came in through each wall so far [J].
    pub wall_heat: [f64; 4],
    /// Sub-steps taken so far, for the cost report.
    pub substeps: u64,
    /// Touching pairs and their conductance k A/|d| [W/K].
    pairs: Vec<(u32, u32, f64)>,
    /// Per wall: disc, conductance [W/K].
    at_wall: [Vec<(u32, f64)>; 4],
    /// Net heat flow into each disc [W].
    flow: Vec<f64>,
    /// Estimate of the stiffest mode.
    mode: Vec<f64>,
    largest_rate: f64,
}

/// Length of the common chord of two circles at centre distance `d` [m]: the contact area on 1 m depth.
pub fn chord([r1, r2]: [f64; 2], d: f64) -> f64 {
    // Distance of the chord from the first centre.
    let to_chord = (d * d + r1 * r1 - r2 * r2) / (2.0 * d);
    2.0 * (r1 * r1 - to_chord * to_chord).max(0.0).sqrt()
}

/// k A/|d| of a contact [W/K]: A the chord of the two circles, at a wall the chord in the wall and |d| the distance of
/// the centre from it.
pub fn conductance(contact: &Contact, discs: &[Disc], conductivity: f64) -> f64 {
    let [x, y] = contact.branch;
    let length = (x * x + y * y).sqrt();
    let radius = discs[contact.j].radius;
    let area = match contact.i {
        Ok(i) => chord([discs[i].radius, radius], length),
        Err(_) => 2.0 * (radius * radius - length * length).max(0.0).sqrt(),
    };
    conductivity * area / length
}

impl HeatPipes {
    pub(crate) fn new(thermal: Thermal, walls: [WallHeat; 4], discs: &[Disc]) -> Self {
        Self {
            thermal,
            walls,
            reference_temperature: discs.iter().map(|d| d.temperature).collect(),
            wall_heat: [0.0; 4],
            substeps: 0,
            pairs: Vec::new(),
            at_wall: Default::default(),
            flow: vec![0.0; discs.len()],
            // No disc may be missing from the first guess of the stiffest mode; signs alternate as the mode's do.
            mode: (0..discs.len()).map(|k| if k % 2 == 0 { 1.0 } else { -0.9 }).collect(),
            largest_rate: 0.0,
        }
    }

    /// Takes the conductances from the present geometry.
    pub(crate) fn connect(&mut self, simulation: &Simulation) {
        self.pairs.clear();
        self.at_wall.iter_mut().for_each(Vec::clear);
        let conductivity = self.thermal.conductivity;
        simulation.for_each_contact(|contact| {
            let value = conductance(&contact, &simulation.discs, conductivity);
            match contact.i {
                Ok(i) => self.pairs.push((i as u32, contact.j as u32, value)),
                Err(side) => self.at_wall[side as usize].push((contact.j as u32, value)),
            }
        });
        self.estimate_largest_rate(&simulation.discs);
    }

    /// λ_max of C⁻¹ L [1/s] by power iteration, C the heat capacities and L the conductance matrix.
    ///
    /// The Rayleigh quotient is a lower bound; it is raised to the largest diagonal entry, which is one too.
    fn estimate_largest_rate(&mut self, discs: &[Disc]) {
        let capacity = |k: usize| discs[k].mass * self.thermal.heat_capacity;
        let mut diagonal = vec![0.0; discs.len()];
        for &(i, j, value) in &self.pairs {
            diagonal[i as usize] += value;
            diagonal[j as usize] += value;
        }
        for (wall, contacts) in self.walls.iter().zip(&self.at_wall) {
            if matches!(wall, WallHeat::Temperature(_)) {
                contacts.iter().for_each(|&(disc, value)| diagonal[disc as usize] += value);
            }
        }
        let mut rate = diagonal.iter().enumerate().map(|(k, value)| value / capacity(k)).fold(0.0, f64::max);
        for _ in 0..POWER_ITERATIONS {
            let mut image: Vec<f64> = diagonal.iter().zip(&self.mode).map(|(d, v)| d * v).collect();
            for &(i, j, value) in &self.pairs {
                image[i as usize] -= value * self.mode[j as usize];
                image[j as usize] -= value * self.mode[i as usize];
            }
            let (mut over, mut under, mut largest) = (0.0, 0.0, 0.0f64);
            for (k, value) in image.iter_mut().enumerate() {
                over += self.mode[k] * *value;
                under += self.mode[k] * self.mode[k] * capacity(k);
                *value /= capacity(k);
                largest = largest.max(value.abs());
            }
            if !(under > 0.0 && largest > 0.0) {
                break;
            }
            rate = rate.max(over / under);
            // A little of the old vector stays, so that a disc without contact can come back into the mode.
            let old = &self.mode;
            self.mode = image.iter().zip(old).map(|(v, o)| v / largest + 1e-3 * o).collect();
        }
        self.largest_rate = rate;
    }

    /// Stability limit of explicit Euler, 2/λ_max [s], at the last connection.
    pub fn stable_step(&self) -> f64 {
        2.0 / self.largest_rate
    }

    /// Conducts over `dt` [s] through the connected pipes.
    pub(crate) fn conduct(&mut self, discs: &mut [Disc], dt: f64) {
        let count = (dt / (SAFETY * self.stable_step())).ceil().max(1.0);
        (0..count as u64).for_each(|_| self.substep(discs, dt / count));
        self.substeps += count as u64;
    }

    pub(crate) fn substep(&mut self, discs: &mut [Disc], dt: f64) {
        self.flow.fill(0.0);
        for &(i, j, value) in &self.pairs {
            let (i, j) = (i as usize, j as usize);
            let flow = value * (discs[j].temperature - discs[i].temperature);
            self.flow[i] += flow;
            self.flow[j] -= flow;
        }
        for side in Side::ALL {
            let inflow = self.add_wall_flow(side, discs);
            self.wall_heat[side as usize] += dt * inflow;
        }
        let capacity = self.thermal.heat_capacity;
        for (disc, flow) in discs.iter_mut().zip(&self.flow) {
            disc.temperature += dt * flow / (disc.mass * capacity);
        }
    }

    /// Adds the flow from one wall and returns its sum [W].
    fn add_wall_flow(&mut self, side: Side, discs: &[Disc]) -> f64 {
        let contacts = &self.at_wall[side as usize];
        let mut inflow = 0.0;
        match self.walls[side as usize] {
            WallHeat::Insulated => {}
            WallHeat::Temperature(temperature) => {
                for &(disc, value) in contacts {
                    let flow = value * (temperature - discs[disc as usize].temperature);
                    self.flow[disc as usize] += flow;
                    inflow += flow;
                }
            }
            WallHeat::Flux(total) => {
                let sum: f64 = contacts.iter().map(|c| c.1).sum();
                for &(disc, value) in contacts {
                    let flow = total * value / sum;
                    self.flow[disc as usize] += flow;
                    inflow += flow;
                }
            }
        }
        inflow
    }
}

#[cfg(test)]
#[path = "heat_tests.rs"]
mod tests;
