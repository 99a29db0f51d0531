//! Heat through the contacts: thermal pipes between discs and to walls (Eq. 5 and Table 1, last row).
//!
//! The conductances are taken once per mechanical step from the geometry. Within the step, the temperatures advance by
//! explicit Euler in as many sub-steps as stability requires. In dense assemblies the thermal stability limit is
//! smaller than the mechanical step, because a single small disc that is squeezed between others determines it.

use crate::contact::{Contact, Touching};
use crate::disc::Disc;
use crate::neighbours::Neighbours;
use crate::network::Network;
use crate::walls::Side;
use serde::{Deserialize, Serialize};

/// Thermal parameters of the grains (Table 2).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
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
    /// Fixed temperature \[K\].
    Temperature(f64),
    /// Total heat flow into the grains \[W\], shared among the discs that touch the wall in proportion to their
    /// conductances. When no disc touches the wall, no heat flows.
    Flux(f64),
}

/// Largest sub-step over the stability limit 2/λ_max. Less than 1, because the power iteration approaches λ_max from
/// below and the network changes until the next estimate. The fastest modes decay within a few sub-steps all the same.
pub const SAFETY: f64 = 0.7;
/// Power iterations per estimate of λ_max. The vector is kept from estimate to estimate, so that the iteration
/// continues where it stood: the network changes slowly.
const POWER_ITERATIONS: usize = 3;
/// Mechanical steps that use the same estimate. Meanwhile λ_max changes by a few per cent; [`SAFETY`] leaves room for
/// 40 %.
const STEPS_AN_ESTIMATE: u32 = 20;

/// The thermal pipes of one assembly, and the heat that has flowed through the walls.
#[derive(Clone, Debug)]
pub struct HeatPipes {
    pub thermal: Thermal,
    pub walls: [WallHeat; 4],
    /// T at which each disc has its reference radius [K].
    pub(crate) reference_temperature: Vec<f64>,
    /// Heat that has come in through each wall since heat was turned on \[J\].
    pub wall_heat: [f64; 4],
    /// Sub-steps taken so far, to report what they cost.
    pub substeps: u64,
    /// Pipes between discs.
    network: Network,
    /// Count of neighbour searches at which the pipes were taken from the candidate pairs; none when they were taken
    /// otherwise.
    of_rebuild: Option<u64>,
    /// The contacts of each wall: disc number and conductance [W/K].
    at_wall: [Vec<(u32, f64)>; 4],
    /// 1/(m c) of each disc [K/J].
    per_capacity: Vec<f64>,
    /// T of each disc [K] and net heat flow into it [W].
    temperature: Vec<f64>,
    flow: Vec<f64>,
    /// Estimate of the fastest mode of temperature (eigenvector of λ_max).
    mode: Vec<f64>,
    largest_rate: f64,
    /// Steps since the estimate of `largest_rate`.
    since_estimate: u32,
}

/// The part of [`HeatPipes`] that must be stored, besides temperatures and radii, so that a run continues bit for bit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeatState {
    /// T at which each disc has its reference radius \[K\].
    pub reference_temperature: Vec<f64>,
    /// Heat that has come in through each wall since heat was turned on \[J\].
    pub wall_heat: [f64; 4],
    pub substeps: u64,
    /// Estimate of the fastest mode, one value per disc, its rate λ_max [1/s], and the number of steps since that
    /// estimate.
    pub mode: Vec<f64>,
    pub largest_rate: f64,
    pub since_estimate: u32,
}

/// Length of the common chord of two circles at centre distance `d` \[m\]: the contact area on 1 m depth.
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
            network: Network::default(),
            of_rebuild: None,
            at_wall: Default::default(),
            per_capacity: discs.iter().map(|d| 1.0 / (d.mass * thermal.heat_capacity)).collect(),
            temperature: Vec::new(),
            flow: vec![0.0; discs.len()],
            // The first guess of the fastest mode must contain every disc. Its signs alternate as those of the mode do.
            mode: (0..discs.len()).map(|k| if k % 2 == 0 { 1.0 } else { -0.9 }).collect(),
            largest_rate: 0.0,
            since_estimate: 0,
        }
    }

    /// The values that a checkpoint must store.
    pub fn state(&self) -> HeatState {
        HeatState {
            reference_temperature: self.reference_temperature.clone(),
            wall_heat: self.wall_heat,
            substeps: self.substeps,
            mode: self.mode.clone(),
            largest_rate: self.largest_rate,
            since_estimate: self.since_estimate,
        }
    }

    pub(crate) fn set_state(&mut self, state: HeatState) {
        self.reference_temperature = state.reference_temperature;
        self.wall_heat = state.wall_heat;
        self.substeps = state.substeps;
        self.mode = state.mode;
        self.largest_rate = state.largest_rate;
        self.since_estimate = state.since_estimate;
    }

    /// Sets up the pipes and their conductances from the present contacts.
    pub(crate) fn connect(&mut self, touching: &Touching) {
        let (mut ends, mut values) = (Vec::new(), Vec::new());
        let conductivity = self.thermal.conductivity;
        touching.for_each(|contact| {
            if let Ok(i) = contact.i {
                ends.push((i as u32, contact.j as u32));
                values.push(conductance(&contact, touching.discs, conductivity));
            }
        });
        self.network = Network::new(touching.discs.len(), ends.into_iter());
        self.network.set(false, &values);
        self.of_rebuild = None;
        self.connect_walls(touching);
        self.estimate_largest_rate();
    }

    /// Updates the conductances: of pairs, those that the step just taken has computed along with its forces; of walls,
    /// those of the present geometry. In parallel when `parallel`.
    pub(crate) fn follow(&mut self, touching: &Touching, parallel: bool) {
        let Neighbours { pairs, skin, .. } = touching.neighbours;
        let rebuilds = &skin.searches;
        if self.of_rebuild != Some(*rebuilds) {
            let partners = pairs.j().iter().map(|&j| touching.image_of(j).owner);
            let ends = pairs.i().iter().copied().zip(partners);
            self.network = Network::new(touching.discs.len(), ends);
            self.of_rebuild = Some(*rebuilds);
        }
        self.network.set(parallel, &pairs.conductance);
        self.connect_walls(touching);
        self.since_estimate += 1;
        if self.largest_rate == 0.0 || self.since_estimate >= STEPS_AN_ESTIMATE {
            self.estimate_largest_rate();
        }
    }

    fn connect_walls(&mut self, touching: &Touching) {
        self.at_wall.iter_mut().for_each(Vec::clear);
        touching.for_each_at_walls(|contact| {
            if let Err(side) = contact.i {
                let value = conductance(&contact, touching.discs, self.thermal.conductivity);
                self.at_wall[side as usize].push((contact.j as u32, value));
            }
        });
    }

    /// λ_max of C⁻¹ L [1/s] by power iteration, C the heat capacities and L the conductance matrix.
    ///
    /// The Rayleigh quotient is a lower bound of λ_max, and so is the largest diagonal entry: the larger of the two is
    /// taken.
    fn estimate_largest_rate(&mut self) {
        let mut to_walls = vec![0.0; self.mode.len()];
        for (wall, contacts) in self.walls.iter().zip(&self.at_wall) {
            if matches!(wall, WallHeat::Temperature(_)) {
                contacts.iter().for_each(|&(disc, value)| to_walls[disc as usize] += value);
            }
        }
        let diagonal =
            self.network.sums(self.mode.len()).into_iter().zip(&to_walls).map(|(pipes, walls)| pipes + walls);
        let mut rate = diagonal.zip(&self.per_capacity).map(|(sum, per)| sum * per).fold(0.0, f64::max);
        let mut image = vec![0.0; self.mode.len()];
        let mode = &mut self.mode;
        for _ in 0..POWER_ITERATIONS {
            self.network.inflow(false, mode, &mut image);
            let (mut over, mut under, mut largest) = (0.0, 0.0, 0.0f64);
            for (((image, mode), walls), per) in
                image.iter_mut().zip(mode.iter()).zip(&to_walls).zip(&self.per_capacity)
            {
                *image = walls * mode - *image;
                over += mode * *image;
                under += mode * mode / per;
                *image *= per;
                largest = largest.max(image.abs());
            }
            if !(under > 0.0 && largest > 0.0) {
                break;
            }
            rate = rate.max(over / under);
            // A small part of the old vector is kept, so that a disc whose contacts were all open can become part of
            // the mode again.
            for (mode, image) in mode.iter_mut().zip(&image) {
                *mode = image / largest + 1e-3 * *mode;
            }
        }
        self.largest_rate = rate;
        self.since_estimate = 0;
    }

    /// Stability limit of explicit Euler, 2/λ_max \[s\], by the last estimate.
    pub fn stable_step(&self) -> f64 {
        2.0 / self.largest_rate
    }

    /// Conducts heat over `dt` [s] through the connected pipes; in parallel when `parallel`.
    pub(crate) fn conduct(&mut self, parallel: bool, discs: &mut [Disc], dt: f64) {
        let count = (dt / (SAFETY * self.stable_step())).ceil().max(1.0);
        self.take_substeps(parallel, discs, count as u64, dt / count);
    }

    /// Takes `count` explicit Euler steps of `dt` [s].
    pub(crate) fn take_substeps(&mut self, parallel: bool, discs: &mut [Disc], count: u64, dt: f64) {
        self.temperature.clear();
        self.temperature.extend(discs.iter().map(|disc| disc.temperature));
        for _ in 0..count {
            self.network.inflow(parallel, &self.temperature, &mut self.flow);
            for side in Side::ALL {
                let inflow = self.add_wall_flow(side);
                self.wall_heat[side as usize] += dt * inflow;
            }
            for ((temperature, flow), per) in
                self.temperature.iter_mut().zip(&self.flow).zip(&self.per_capacity)
            {
                *temperature += dt * per * flow;
            }
        }
        for (disc, temperature) in discs.iter_mut().zip(&self.temperature) {
            disc.temperature = *temperature;
        }
        self.substeps += count;
    }

    /// Adds the heat flow from one wall into its discs and returns the total [W].
    fn add_wall_flow(&mut self, side: Side) -> f64 {
        let contacts = &self.at_wall[side as usize];
        let mut inflow = 0.0;
        match self.walls[side as usize] {
            WallHeat::Insulated => {}
            WallHeat::Temperature(temperature) => {
                for &(disc, value) in contacts {
                    let flow = value * (temperature - self.temperature[disc as usize]);
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
