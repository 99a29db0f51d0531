//! Heat through the contacts: thermal pipes between discs and to walls (Eq. 5 and Table 1, last row).
//!
//! Conductances are taken once a mechanical step from the geometry; within it, temperatures advance by explicit Euler
//! in as many sub-steps as stability asks for. The thermal limit is the smaller one in dense assemblies: a single
//! squeezed small disc sets it.

use crate::contact::Contact;
use crate::disc::Disc;
use crate::pipes::Pipes;
use crate::simulation::Simulation;
use crate::walls::Side;
use serde::{Deserialize, Serialize};

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
/// Connections between two estimates of the stiffest mode, which changes slowly.
const ESTIMATE_EVERY: u64 = 25;
/// Power iterations of the first estimate, and of later ones: the vector is kept, so they add up.
const FIRST_ITERATIONS: usize = 40;
const POWER_ITERATIONS: usize = 4;

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
    /// Times that the conductances were taken.
    connections: u64,
    pipes: Pipes,
    /// Per wall: disc, conductance [W/K].
    at_wall: [Vec<(u32, f64)>; 4],
    /// T of the discs [K] while heat flows: one after the other in memory.
    temperature: Vec<f64>,
    /// 1/(m c) of the discs [K/J].
    over_capacity: Vec<f64>,
    /// Estimate of the stiffest mode.
    mode: Vec<f64>,
    largest_rate: f64,
}

/// What has to be kept of [`HeatPipes`], beside temperatures and radii, so that a run continues bit for bit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeatState {
    /// T at which each disc has its reference radius [K].
    pub reference_temperature: Vec<f64>,
    /// Heat that came in through each wall so far [J].
    pub wall_heat: [f64; 4],
    pub substeps: u64,
    pub connections: u64,
    /// Estimate of the stiffest mode, one value a disc, and its rate λ_max [1/s].
    pub mode: Vec<f64>,
    pub largest_rate: f64,
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
    match contact.i {
        Ok(i) => conductivity * chord([discs[i].radius, radius], length) / length,
        Err(_) => wall_conductance(radius, length, conductivity),
    }
}

/// k A/|d| [W/K] of a disc whose centre is `distance` [m] from a wall.
fn wall_conductance(radius: f64, distance: f64, conductivity: f64) -> f64 {
    conductivity * 2.0 * (radius * radius - distance * distance).max(0.0).sqrt() / distance
}

impl HeatPipes {
    pub(crate) fn new(thermal: Thermal, walls: [WallHeat; 4], discs: &[Disc]) -> Self {
        Self {
            thermal,
            walls,
            reference_temperature: discs.iter().map(|d| d.temperature).collect(),
            wall_heat: [0.0; 4],
            substeps: 0,
            connections: 0,
            pipes: Pipes::default(),
            at_wall: Default::default(),
            temperature: vec![0.0; discs.len()],
            over_capacity: discs.iter().map(|d| 1.0 / (d.mass * thermal.heat_capacity)).collect(),
            // No disc may be missing from the first guess of the stiffest mode; signs alternate as the mode's do.
            mode: (0..discs.len()).map(|k| if k % 2 == 0 { 1.0 } else { -0.9 }).collect(),
            largest_rate: 0.0,
        }
    }

    /// What a checkpoint has to hold.
    pub fn state(&self) -> HeatState {
        HeatState {
            reference_temperature: self.reference_temperature.clone(),
            wall_heat: self.wall_heat,
            substeps: self.substeps,
            connections: self.connections,
            mode: self.mode.clone(),
            largest_rate: self.largest_rate,
        }
    }

    pub(crate) fn set_state(&mut self, state: HeatState) {
        self.reference_temperature = state.reference_temperature;
        self.wall_heat = state.wall_heat;
        self.substeps = state.substeps;
        self.connections = state.connections;
        self.mode = state.mode;
        self.largest_rate = state.largest_rate;
    }

    /// Takes the conductances from the present geometry.
    pub(crate) fn connect(&mut self, simulation: &Simulation, parallel: bool) {
        let neighbours = &simulation.neighbours;
        self.pipes.connect(parallel, &neighbours.pairs, &simulation.discs, self.thermal.conductivity);
        for side in Side::ALL {
            let list = &mut self.at_wall[side as usize];
            list.clear();
            for &disc in &neighbours.walls[side as usize].disc {
                let Disc { x, y, radius, .. } = simulation.discs[disc as usize];
                let distance = simulation.walls.distance(side, x, y);
                if distance < radius {
                    list.push((disc, wall_conductance(radius, distance, self.thermal.conductivity)));
                }
            }
        }
        if self.connections.is_multiple_of(ESTIMATE_EVERY) {
            let first = self.connections == 0;
            self.estimate_largest_rate(if first { FIRST_ITERATIONS } else { POWER_ITERATIONS });
        }
        self.connections += 1;
    }

    /// λ_max of C⁻¹ L [1/s] by power iteration, C the heat capacities and L the conductance matrix.
    ///
    /// The Rayleigh quotient is a lower bound; it is raised to the largest diagonal entry, which is one too.
    fn estimate_largest_rate(&mut self, iterations: usize) {
        let over_capacity = &self.over_capacity;
        let mut diagonal = vec![0.0; over_capacity.len()];
        self.pipes.add_diagonal(&mut diagonal);
        for (wall, contacts) in self.walls.iter().zip(&self.at_wall) {
            if matches!(wall, WallHeat::Temperature(_)) {
                contacts.iter().for_each(|&(disc, value)| diagonal[disc as usize] += value);
            }
        }
        let mut rate = diagonal.iter().zip(over_capacity).map(|(value, o)| value * o).fold(0.0, f64::max);
        let mut image = vec![0.0; diagonal.len()];
        for _ in 0..iterations {
            let entries = image.iter_mut().zip(&diagonal).zip(&self.mode);
            entries.for_each(|((image, d), v)| *image = d * v);
            self.pipes.subtract_off_diagonal(&self.mode, &mut image);
            let (mut over, mut under, mut largest) = (0.0, 0.0, 0.0f64);
            for ((value, mode), o) in image.iter_mut().zip(&self.mode).zip(over_capacity) {
                over += mode * *value;
                under += mode * mode / o;
                *value *= o;
                largest = largest.max(value.abs());
            }
            if !(under > 0.0 && largest > 0.0) {
                break;
            }
            rate = rate.max(over / under);
            // A little of the old vector stays, so that a disc without contact can come back into the mode.
            self.mode.iter_mut().zip(&image).for_each(|(mode, v)| *mode = v / largest + 1e-3 * *mode);
        }
        self.largest_rate = rate;
    }

    /// Stability limit of explicit Euler, 2/λ_max [s], at the last estimate.
    pub fn stable_step(&self) -> f64 {
        2.0 / self.largest_rate
    }

    /// Conducts over `dt` [s] through the connected pipes.
    pub(crate) fn conduct(&mut self, parallel: bool, discs: &mut [Disc], dt: f64) {
        let count = (dt / (SAFETY * self.stable_step())).ceil().max(1.0);
        self.substeps(parallel, discs, dt / count, count as u64);
        self.substeps += count as u64;
    }

    /// `count` steps of explicit Euler of `dt` [s] each.
    pub(crate) fn substeps(&mut self, parallel: bool, discs: &mut [Disc], dt: f64, count: u64) {
        self.temperature.iter_mut().zip(&*discs).for_each(|(t, disc)| *t = disc.temperature);
        for _ in 0..count {
            self.pipes.sum_flow(parallel, &self.temperature);
            for side in Side::ALL {
                let inflow = self.add_wall_flow(side);
                self.wall_heat[side as usize] += dt * inflow;
            }
            self.pipes.warm(parallel, dt, &self.over_capacity, &mut self.temperature);
        }
        discs.iter_mut().zip(&self.temperature).for_each(|(disc, t)| disc.temperature = *t);
    }

    /// Adds the flow from one wall and returns its sum [W].
    fn add_wall_flow(&mut self, side: Side) -> f64 {
        let (contacts, temperature) = (&self.at_wall[side as usize], &self.temperature);
        let mut inflow = 0.0;
        match self.walls[side as usize] {
            WallHeat::Insulated => {}
            WallHeat::Temperature(wall) => self.pipes.add(contacts.iter().map(|&(disc, value)| {
                let flow = value * (wall - temperature[disc as usize]);
                inflow += flow;
                (disc as usize, flow)
            })),
            WallHeat::Flux(total) => {
                let sum: f64 = contacts.iter().map(|c| c.1).sum();
                self.pipes.add(contacts.iter().map(|&(disc, value)| {
                    let flow = total * value / sum;
                    inflow += flow;
                    (disc as usize, flow)
                }));
            }
        }
        inflow
    }
}

#[cfg(test)]
#[path = "heat_tests.rs"]
mod tests;
