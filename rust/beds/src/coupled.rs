//! A bed whose walls move while heat flows through it: grains grow with their temperature, walls yield or follow a path, and
//! contacts conduct as they are pressed.
//!
//! The grains are poured with `simulated_young_modulus`, the lid is pressed on, and then they harden to `young_modulus` while the lid
//! keeps its pressure. Meanwhile walls are smooth: rough ones would carry part of what the modulus adds to the stress, in a small bed as
//! deep as it is wide a third of the load. From there on they have the stiffness of their material.
//!
//! Time goes on in intervals. In each, heat flows through the contacts as they are at its start; then radii and walls change evenly in
//! half of the steps of DEM, and come to rest in the other half. Both halves take longer where the bed lags: radii and
//! walls wait while more than 2 % of the load is out of balance, and an interval ends when less than 0.1 % is. A bed that lags lets
//! contacts slide that would not slide at rest. Where 400 times the steps are not enough, the rest of the motion is hurried, and after
//! 100 times the steps of the rest the interval ends as it is; the summary then warns and says how many intervals that were. A heated
//! wall holds all spheres whose centre is within a diameter of it at its temperature, or passes heat to them as its key `resists` says;
//! other walls are insulated.
//!
//! The motion is not the motion in real time: it shows how a bed at rest changes, and how far from rest it is is recorded.

use crate::BedError;
use crate::case::{BedCase, Heated};
use crate::exchange::Exchange;
use crate::harden::harden;
use crate::network::{Network, Plate, PlateLaw};
use crate::pour::pour;
use crate::press::press;
use crate::profile::{Probe, Width, slab, solid_fraction};
use crate::region::{Region, lengths};
use crate::settle::{Rest, progress};
use crate::transient::Transient;
use crate::wall_control::{BLOCK, Moving, WallControl, drag, steered, wall_area};
use msdd_spheres::Simulation;
use msdd_spheres::space::length;
use std::f64::consts::PI;

/// First time step of heat \[s\].
const FIRST_STEP: f64 = 0.1;
/// Share of the load that is out of balance \[-\] above which radii and walls wait, and then change by half as much at a time. A bed
/// that moves lags by its drag and inertia: where a lid was off by a tenth of its pressure, contacts slid that would not slide in a
/// bed at rest, and the pressure was 3 to 5 % off.
const MAX_LAG: f64 = 0.02;
/// The same below which a bed is near rest, and they change by twice as much at a time, at most by an even part of the interval.
const LITTLE_LAG: f64 = 0.005;
/// The same below which a bed is at rest, which ends an interval.
const AT_REST: f64 = 1e-3;
/// The least share of an interval by which they change at a time is an even part of it over this.
const PARTS: u64 = 20;
/// Times the steps of the motion after which what is left of it is hurried although the bed lags. Contacts slide then that would not
/// slide in a bed at rest: one that needs 90 times its steps, and was hurried after 20 times, carried a fifth too little across its load.
const LONGEST: u64 = 400;
/// Times the steps of the rest after which an interval ends although the bed is not at rest: some creep for long.
const LONGEST_REST: u64 = 100;

/// Overlap of a contact over the radius above which Hertz's law is an extrapolation, and above which it has no meaning. It holds for
/// contacts small compared with the spheres (K. L. Johnson, Contact Mechanics, 1985, section 4.2): at these the contact's radius is 0.16 and 0.35
/// of that of the spheres.
pub const MAX_OVERLAP: f64 = 0.05;
const ABSURD_OVERLAP: f64 = 0.25;
/// A share of the friction above 1 by less than this is rounding and damping.
const MAX_MOBILISED: f64 = 1.01;

/// A bed at rest under its lid.
#[derive(Clone, Debug)]
pub struct Prepared {
    pub simulation: Simulation,
    /// Radiation between its spheres and heated walls, if they radiate: as they are now, since a bed hardly moves.
    pub exchange: Option<Exchange>,
    /// Stages, and how each came to rest.
    pub stages: Vec<(&'static str, Rest)>,
}

/// What a bed is like at one time. Compression is positive.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// t \[s\]
    pub time: f64,
    /// T \[K\] at the distances of the scene, and the mean of the grains in its region.
    pub temperatures: Vec<f64>,
    pub mean_temperature: f64,
    /// Pressure of the grains on each wall \[Pa\].
    pub walls: Vec<f64>,
    /// Mean stresses \[Pa\] in the region, see [`Region::stress`].
    pub stress: [f64; 3],
    /// Mean growth of the radii of the grains in the region, and the strain of the bed there since the start, see [`Region::strain`] \[-\].
    pub thermal_strain: f64,
    pub strain: [f64; 3],
    /// In the region.
    pub porosity: f64,
    /// Between its heights, from its radius to where the centres of the first layer next to the side are, or to the side if that resists;
    /// NaN in a box.
    pub porosity_outside: f64,
    pub coordination: f64,
    /// The fabric in the region, see [`Region::fabric`], and how much of the friction is mobilised there, see [`crate::mobilised`] \[-\].
    pub fabric: [f64; 3],
    pub mobilisation: f64,
    /// K \[W/(m K)\] along z in the region, by contacts, gas and radiation.
    pub contact_conductivity: f64,
    pub gas_conductivity: f64,
    pub radiation_conductivity: f64,
    /// Of the bed \[m\], and the radius of the cylinder \[m\], NaN in a box.
    pub depth: f64,
    pub radius: f64,
    /// Force along z that is not in balance, over that on the lid.
    pub unbalanced: f64,
    /// Contacts that yield, over all; largest of Hertz's peak stresses over the one at which yielding begins. NaN without a yield stress.
    pub yielding: f64,
    pub peak: f64,
}

impl Row {
    /// K \[W/(m K)\] of all ways.
    pub fn conductivity(&self) -> f64 {
        self.contact_conductivity + self.gas_conductivity + self.radiation_conductivity
    }

    /// Refuses averages that no bed has, as of a region with hardly a contact.
    fn check(&self) -> Result<(), BedError> {
        let mobilisation = if self.mobilisation <= MAX_MOBILISED { self.mobilisation } else { f64::NAN };
        let several = [
            ("T", self.temperatures.as_slice()),
            ("stress", self.stress.as_slice()),
            ("strain", self.strain.as_slice()),
            ("fabric", self.fabric.as_slice()),
            ("porosity", &[self.porosity][..]),
            ("coordination", &[self.coordination][..]),
            ("mobilisation", &[mobilisation][..]),
            ("K", &[self.contact_conductivity, self.gas_conductivity, self.radiation_conductivity][..]),
        ];
        match several.into_iter().find(|(_, values)| values.iter().any(|value| !value.is_finite())) {
            None => Ok(()),
            Some((name, _)) => Err(BedError::Averages { name, time: self.time }),
        }
    }
}

/// Tangential over normal force of the side of a cylinder on the grains, above 0 where it holds the bed down: what the floor carries
/// more than lid and weight comes from the side. `None` without a side.
pub fn side_friction(scene: &BedCase, row: &Row) -> Option<f64> {
    let [floor, side, lid] =
        ["floor", "side", "lid"].map(|name| scene.wall(name).map(|wall| row.walls[wall]));
    let (grains, area) = (&scene.grains, PI * row.radius * row.radius);
    let weight = grains.volume() * grains.density * scene.container.gravity;
    let normal = side? * 2.0 * PI * row.radius * row.depth;
    Some(((floor? - lid?) * area - weight) / normal)
}

/// A bed over time.
#[derive(Clone, Debug, Default)]
pub struct Run {
    pub rows: Vec<Row>,
    /// Heat that the grains stored which no wall holds, and the residual of its balance \[J\].
    pub stored: f64,
    pub residual: f64,
    /// Largest overlap of a contact over the radius, at the times of the rows.
    pub overlap: f64,
    /// Of DEM.
    pub steps: u64,
    /// Intervals, those of them whose motion had to be hurried, and those that ended with more out of balance than beds near rest have.
    pub intervals: u64,
    pub hurried: u64,
    pub restless: u64,
}

/// Pours, presses the lid on, and hardens. `watch` receives the stage, and how far it has come, from 0 to 1.
///
/// # Errors
/// Those of the stages; a stage that does not come to rest.
pub fn prepare(
    scene: &BedCase,
    threads: usize,
    mut watch: impl FnMut(&'static str, f64),
) -> Result<Prepared, BedError> {
    let (grains, container) = (&scene.grains, scene.vessel());
    let pouring = grains.pouring(scene.seed, container, scene.container.gravity, threads);
    let allowed = pouring.longest;
    let (mut simulation, rest) = pour(&pouring, |agitation| watch("pour", progress(agitation)))?;
    let mut stages = vec![rest.of("pour")?];
    let (lid, load) = (scene.wall("lid").unwrap_or_default(), (scene.pressure(), container.area()));
    let rest = press(&mut simulation, lid, load, allowed, |a| watch("lid", progress(a)))?;
    stages.push(rest.of("lid")?);
    let depth = simulation.boundary.walls()[lid].point[2];
    if grains.young_modulus > grains.simulated_young_modulus {
        // Rough walls would hold the stress that the modulus adds inside, which the lid lets go.
        simulation.material.wall_friction = 0.0;
    }
    let rest =
        harden(&mut simulation, grains.young_modulus, lid, load, depth, |share| watch("harden", share))?;
    simulation.material.wall_friction = grains.wall_friction;
    stages.push(rest.of("harden")?);
    let walls: Vec<(usize, Option<f64>)> = heated_walls(scene).map(|wall| (wall, None)).collect();
    let exchange = grains.exchange(&simulation, &walls, scene.temperatures(), (scene.seed, threads))?;
    Ok(Prepared { simulation, stages, exchange })
}

/// The bed on its way.
struct Coupled<'a> {
    scene: &'a BedCase,
    exchange: Option<&'a Exchange>,
    simulation: Simulation,
    network: Network,
    /// Which spheres have the temperature of which heated wall, from the start on.
    held: Vec<Option<usize>>,
    temperatures: Vec<f64>,
    /// Radii at the initial temperature, and where the spheres were then.
    radii: Vec<f64>,
    places: Vec<[f64; 3]>,
    lid: Moving,
    shell: Option<Moving>,
    depth_at_start: f64,
    /// Lengths of the base of a bed without sides that are aimed at \[m\].
    sides: Option<[f64; 2]>,
    /// Part of an interval's motion that is made before the lag is looked at again.
    part: f64,
    run: Run,
}

/// Heats and moves. `watch` receives how far it has come, from 0 to 1.
///
/// # Errors
/// A distance without grains; heat that does not converge; those of [`Simulation::run`].
pub fn run(scene: &BedCase, prepared: &Prepared, mut watch: impl FnMut(f64)) -> Result<Run, BedError> {
    let mut bed = Coupled::new(scene, prepared);
    let (high, depth) = (scene.record.heights[1], bed.depth());
    if high > depth {
        return Err(BedError::Heights { high, depth });
    }
    let time = &scene.time;
    bed.record(0.0)?;
    let outputs = (time.end / time.output_every - 1e-9).ceil() as u64;
    let (mut step, mut now) = (FIRST_STEP.min(time.interval), 0.0);
    for output in 1..=outputs {
        let next = (output as f64 * time.output_every).min(time.end);
        let intervals = ((next - now) / time.interval - 1e-9).ceil().max(1.0) as u64;
        let begin = now;
        for interval in 1..=intervals {
            let end = begin + (next - begin) * interval as f64 / intervals as f64;
            bed.heat([now, end], &mut step)?;
            bed.motion([now, end])?;
            now = end;
            watch(now / time.end);
        }
        bed.record(now)?;
    }
    Ok(bed.run)
}

impl<'a> Coupled<'a> {
    fn new(scene: &'a BedCase, prepared: &'a Prepared) -> Self {
        let (simulation, exchange) = (prepared.simulation.clone(), prepared.exchange.as_ref());
        let number = |name: &str| scene.wall(name).unwrap_or_default();
        let lid = number("lid");
        let network = network(scene, (&simulation, exchange), depth(&simulation, lid));
        let start = scene.time.initial_temperature;
        let mut bed = Self {
            scene,
            exchange,
            held: network.held.clone(),
            network,
            temperatures: vec![start; simulation.spheres.len()],
            radii: simulation.spheres.iter().map(|sphere| sphere.radius).collect(),
            places: simulation.spheres.iter().map(|sphere| sphere.position).collect(),
            lid: Moving::new(lid, WallControl::Place { moved: 0.0 }),
            shell: scene
                .shell
                .as_ref()
                .map(|_| Moving::new(number("side"), WallControl::Place { moved: 0.0 })),
            depth_at_start: 0.0,
            sides: None,
            part: 0.0,
            run: Run { steps: simulation.steps, ..Run::default() },
            simulation,
        };
        bed.depth_at_start = bed.depth();
        let at_start = bed.shell.as_ref().map_or(0.0, |shell| bed.pressure(shell.wall));
        if let (Some(shell), Some(keys), Some(radius)) =
            (&mut bed.shell, &scene.shell, scene.container.radius)
        {
            let stiffness = keys.young_modulus * keys.thickness / (radius * radius);
            shell.hold = WallControl::Shell { stiffness, at_start, grown: 0.0 };
        }
        bed
    }

    /// Of the bed, from the floor to the lid \[m\].
    fn depth(&self) -> f64 {
        depth(&self.simulation, self.lid.wall)
    }

    /// Of the floor \[m²\].
    fn area(&self) -> f64 {
        area(self.scene, &self.simulation)
    }

    /// Of the grains on a wall \[Pa\].
    fn pressure(&self, wall: usize) -> f64 {
        let area = wall_area(&self.simulation, wall, self.area(), self.depth());
        self.simulation.wall_load(wall) / area
    }

    fn heat(&mut self, [from, to]: [f64; 2], step: &mut f64) -> Result<(), BedError> {
        let at = |time: f64| -> Vec<f64> { self.scene.heated.iter().map(|h| h.at(time)).collect() };
        let mut transient = Transient::from(&self.network, &self.temperatures, at(0.5 * (from + to)));
        transient.run_to(to - from, self.scene.time.tolerance, step)?;
        self.run.stored += transient.stored();
        self.run.residual += transient.residual();
        let plates = at(to);
        for ((temperature, found), held) in
            self.temperatures.iter_mut().zip(&transient.temperatures).zip(&self.held)
        {
            *temperature = held.map_or(*found, |plate| plates[plate]);
        }
        Ok(())
    }

    /// Moves grains and walls from where they are to where the end of the interval wants them.
    fn motion(&mut self, [from, to]: [f64; 2]) -> Result<(), BedError> {
        let expansion = self.scene.grains.thermal_expansion.unwrap_or(0.0);
        let start = self.scene.time.initial_temperature;
        let before: Vec<f64> = self.simulation.spheres.iter().map(|sphere| sphere.radius).collect();
        let after: Vec<f64> = (self.radii.iter().zip(&self.temperatures))
            .map(|(radius, temperature)| radius * (1.0 + expansion * (temperature - start)))
            .collect();
        let least = self.scene.time.steps.div_ceil(2 * BLOCK);
        let longest = 1.0 / least as f64;
        let (mut blocks, mut share, mut hurried) = (0, 0.0, false);
        let mut radii = before.clone();
        while share < 1.0 {
            let (lag, late) = (self.lag(), blocks >= LONGEST * least);
            self.part = match lag {
                lag if lag > MAX_LAG => 0.5 * self.part,
                lag if lag < LITTLE_LAG => 2.0 * self.part,
                _ => self.part,
            };
            self.part = self.part.clamp(longest / PARTS as f64, longest);
            if lag <= MAX_LAG || late {
                hurried |= late;
                share = f64::min(share + if late { longest } else { self.part }, 1.0);
                for ((radius, a), b) in radii.iter_mut().zip(&before).zip(&after) {
                    *radius = a + share * (b - a);
                }
                self.simulation.resize(&radii);
                self.aim(from + share * (to - from));
            }
            self.block()?;
            blocks += 1;
        }
        let mut rested = 0;
        while rested < least || (self.lag() > AT_REST && rested < LONGEST_REST * least) {
            self.block()?;
            rested += 1;
        }
        self.run.intervals += 1;
        self.run.hurried += u64::from(hurried);
        self.run.restless += u64::from(self.lag() > LITTLE_LAG);
        self.simulation.drag = 0.0;
        self.lid.stop(&mut self.simulation);
        if let Some(shell) = &mut self.shell {
            shell.stop(&mut self.simulation);
        }
        self.simulation.set_velocity_gradient([[0.0; 3]; 3]);
        self.network = network(self.scene, (&self.simulation, self.exchange), self.depth());
        self.network.held.clone_from(&self.held);
        Ok(())
    }

    /// A few steps, in which walls move as what holds them says.
    fn block(&mut self) -> Result<(), BedError> {
        self.simulation.drag = drag(&self.simulation, self.depth());
        let (area, depth, sides) = (self.area(), self.depth(), self.sides);
        let walls = [Some(&mut self.lid), self.shell.as_mut()];
        let mut walls: Vec<&mut Moving> = walls.into_iter().flatten().collect();
        steered(&mut self.simulation, |simulation, dt, left| {
            for wall in &mut walls {
                let pressure =
                    simulation.wall_load(wall.wall) / wall_area(simulation, wall.wall, area, depth);
                wall.steer(simulation, pressure, dt, left);
            }
            spread(simulation, sides, left);
        })?;
        Ok(())
    }

    /// The force on the lid, or the weight if that is larger \[N\].
    fn load(&self) -> f64 {
        self.simulation.wall_load(self.lid.wall).max(self.weight())
    }

    fn weight(&self) -> f64 {
        let mass: f64 = self.simulation.spheres.iter().map(|sphere| sphere.mass).sum();
        mass * length(self.simulation.gravity)
    }

    /// Force along z that is not in balance, over the load.
    fn unbalanced(&self) -> f64 {
        let along: f64 = self.simulation.wall_force.iter().map(|force| force[2]).sum();
        (along + self.weight()).abs() / self.load()
    }

    /// What is not in balance over the load: along z, and on compliant walls.
    fn lag(&self) -> f64 {
        let walls = [Some(&self.lid), self.shell.as_ref()].into_iter().flatten();
        let pressure = self.load() / self.area();
        let of_walls = walls.map(|wall| wall.lag(self.pressure(wall.wall)) / pressure);
        of_walls.fold(self.unbalanced(), f64::max)
    }

    /// What holds the walls at a time \[s\].
    fn aim(&mut self, time: f64) {
        self.lid.hold = match self.scene.lid_moves() {
            (Some(strain), _) => WallControl::Place { moved: strain.at(time) * self.depth_at_start },
            (None, Some(pressing)) => WallControl::Pressure { pressure: pressing.at(time) },
            (None, None) => WallControl::Place { moved: 0.0 },
        };
        self.sides = self.scene.sides.as_ref().zip(self.scene.container.base).map(|(sides, [x, y])| {
            [x * (1.0 + sides.strain_x.at(time)), y * (1.0 + sides.strain_y.at(time))]
        });
        let (strain, radius) = (self.shell_strain(time), self.scene.container.radius.unwrap_or(0.0));
        let Some(shell) = &mut self.shell else { return };
        if let WallControl::Shell { grown, .. } = &mut shell.hold {
            *grown = strain * radius;
        }
        if self.scene.grains.wall_friction > 0.0 {
            shell.stretch = strain;
        }
    }

    /// Strain of a shell by its own temperature, which is that of the heated side, else that of the start \[-\].
    fn shell_strain(&self, time: f64) -> f64 {
        let expansion = self.scene.shell.as_ref().map_or(0.0, |shell| shell.thermal_expansion);
        let side = self.scene.heated.iter().find(|heated| heated.wall == "side");
        let rise = side.map_or(0.0, |side| side.at(time) - self.scene.time.initial_temperature);
        expansion * rise
    }

    /// The largest overlap of a contact over the radius.
    fn overlap(&self) -> f64 {
        let mut largest = 0.0f64;
        self.simulation.for_each_contact(|contact| {
            let radius =
                contact.spheres().map(|k| self.simulation.spheres[k].radius).fold(f64::INFINITY, f64::min);
            largest = largest.max(contact.overlap / radius);
        });
        largest
    }

    fn record(&mut self, time: f64) -> Result<(), BedError> {
        let (scene, simulation) = (self.scene, &self.simulation);
        let keys = &scene.record;
        let region = region(scene, simulation);
        let wall = simulation.boundary.walls()[scene.wall(&keys.wall).unwrap_or_default()];
        let round = scene.wall("side") == scene.wall(&keys.wall);
        let temperature = |&distance: &f64| {
            let used = |z: f64| !round || (keys.heights[0]..keys.heights[1]).contains(&z);
            let probe = Probe::layer(simulation, &wall, distance, |sphere| used(sphere.position[2]));
            let probe = probe.ok_or(BedError::NoGrains { key: "record.distances", distance })?;
            Ok(probe.temperature(&self.temperatures))
        };
        let temperatures = keys.distances.iter().map(temperature).collect::<Result<_, BedError>>()?;
        let inside =
            simulation.spheres.iter().zip(&self.temperatures).filter(|(s, _)| region.holds(s.position));
        let (sum, count) = inside.fold((0.0, 0.0), |(sum, count), (_, t)| (sum + t, count + 1.0));
        let mean_temperature: f64 = sum / count;
        if !mean_temperature.is_finite() {
            return Err(BedError::NoGrains { key: "record.heights", distance: keys.heights[0] });
        }
        let floor = simulation.boundary.walls()[0];
        let width = keys.radius.map_or(Width::Whole(region.area), |radius| Width::Ring([0.0, radius]));
        let averages = slab(simulation, &self.network, &floor, keys.heights, width, mean_temperature)
            .ok_or(BedError::NoGrains { key: "record.heights", distance: keys.heights[0] })?;
        let radius = (scene.container.radius)
            .map(|radius| radius - self.shell.as_ref().map_or(0.0, |shell| shell.moved));
        let outside = keys.radius.zip(radius).map(|(inner, radius)| {
            let rim = if scene.resists("side") { 0.0 } else { 0.5 * scene.grains.diameter };
            let ring = Width::Ring([inner, radius - rim]);
            1.0 - solid_fraction(simulation, &floor, keys.heights, ring)
        });
        let (peak, overlap) = (scene.grains.peak_stress(simulation), self.overlap());
        if overlap > ABSURD_OVERLAP {
            return Err(BedError::Overlap { time, overlap, most: ABSURD_OVERLAP });
        }
        self.run.overlap = self.run.overlap.max(overlap);
        self.run.steps = simulation.steps;
        let row = Row {
            time,
            temperatures,
            mean_temperature,
            walls: (0..simulation.wall_force.len()).map(|wall| self.pressure(wall)).collect(),
            stress: region.stress(simulation),
            thermal_strain: scene.grains.thermal_expansion.unwrap_or(0.0)
                * (mean_temperature - scene.time.initial_temperature),
            strain: region.strain(
                simulation,
                &self.places,
                scene.container.base.filter(|_| scene.container.endless),
            ),
            porosity: 1.0 - averages.solid_fraction,
            porosity_outside: outside.unwrap_or(f64::NAN),
            coordination: averages.coordination,
            fabric: region.fabric(simulation),
            mobilisation: region.mobilisation(simulation),
            contact_conductivity: averages.contact_conductivity,
            gas_conductivity: averages.gas_conductivity,
            radiation_conductivity: averages.radiation_conductivity,
            depth: self.depth(),
            radius: radius.unwrap_or(f64::NAN),
            unbalanced: self.unbalanced(),
            yielding: peak.map_or(f64::NAN, |peak| peak.beyond as f64 / peak.contacts.max(1) as f64),
            peak: peak.map_or(f64::NAN, |peak| peak.largest / (crate::solid::YIELD_AT * peak.yield_stress)),
        };
        row.check()?;
        self.run.rows.push(row);
        Ok(())
    }
}

fn depth(simulation: &Simulation, lid: usize) -> f64 {
    let walls = simulation.boundary.walls();
    walls[lid].point[2] - walls[0].point[2]
}

/// Where the averages are taken.
fn region(scene: &BedCase, simulation: &Simulation) -> Region {
    let keys = &scene.record;
    Region { heights: keys.heights, radius: keys.radius, area: area(scene, simulation) }
}

/// Of the floor \[m²\]; the base of a bed without sides may be strained.
fn area(scene: &BedCase, simulation: &Simulation) -> f64 {
    lengths(simulation).map_or_else(|| scene.vessel().area(), |[x, y]| x * y)
}

/// Strains a bed without sides so that its base has these lengths \[m\] after `left` \[s\].
fn spread(simulation: &mut Simulation, aim: Option<[f64; 2]>, left: f64) {
    if let Some((aim, now)) = aim.zip(lengths(simulation)) {
        let [x, y] = [0, 1].map(|k| (aim[k] / now[k] - 1.0) / left);
        simulation.set_velocity_gradient([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0; 3]]);
    }
}

/// The network of a bed whose heated walls hold the first layer of grains.
fn network(scene: &BedCase, (simulation, exchange): (&Simulation, Option<&Exchange>), depth: f64) -> Network {
    let grains = &scene.grains;
    let middle = [0.25, 0.75].map(|part| part * depth);
    let floor = simulation.boundary.walls()[0];
    let width = Width::Whole(area(scene, simulation));
    let materials = grains.materials(&scene.gas, solid_fraction(simulation, &floor, middle, width));
    let walls: Vec<usize> = heated_walls(scene).collect();
    // Of the material of the spheres, and polished: the asperities are theirs.
    let law = |heated: &Heated| match heated.resists {
        false => PlateLaw::Held,
        true => PlateLaw::Resisting {
            conductivity: None,
            effective_modulus: materials.effective_modulus,
            roughness: materials.roughness,
        },
    };
    let plates: Vec<Plate> =
        walls.iter().zip(&scene.heated).map(|(&wall, heated)| Plate { wall, law: law(heated) }).collect();
    let mut network = Network::new(simulation, materials, &plates);
    network.source = scene.heat_source.unwrap_or(0.0);
    network.radiating(exchange, grains.emissivity.clone(), &walls)
}

/// Numbers of the heated walls.
fn heated_walls(scene: &BedCase) -> impl Iterator<Item = usize> {
    scene.heated.iter().map(|heated| scene.wall(&heated.wall).unwrap_or_default())
}
