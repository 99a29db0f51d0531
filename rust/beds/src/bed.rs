//! A bed that was measured, from pouring to temperatures: pour, press, turn, heat.

use crate::BedError;
use crate::case::BedCase;
use crate::exchange::Exchange;
use crate::experiment::Record;
use crate::network::{Network, Plate, PlateLaw};
use crate::pour::{Container, pour};
use crate::press::{close, press};
use crate::profile::{Probe, Slab, Width, slab, solid_fraction};
use crate::settle::{Rest, progress, settle, turn};
use crate::solid::Roughness;
use crate::transient::Transient;
use msdd_spheres::space::dot;
use msdd_spheres::{Simulation, Sphere, Surface, Wall};

/// Time of turning \[s\], for grains of a diameter \[m\] under a gravity \[m/s²\]; it is in proportion to √(d/g).
const TURNING: [f64; 3] = [0.2, 6.4e-3, 9.81];
/// First time step of heat \[s\].
const FIRST_STEP: f64 = 0.1;

/// The two ways in which a plate is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PlateKind {
    /// The first layer of grains has the plate's temperature.
    Held,
    /// Contacts and gas between plate and grains resist.
    Resisting,
}

named!(PlateKind);

impl PlateKind {
    pub const ALL: [Self; 2] = [Self::Held, Self::Resisting];
}

/// A bed at rest before it is heated.
#[derive(Clone, Debug)]
pub struct Bed {
    pub simulation: Simulation,
    /// Stages, and how each came to rest.
    pub stages: Vec<(&'static str, Rest)>,
    /// Number of the wall that is heated.
    pub plate: usize,
    /// Radiation between its spheres and the plate, if they radiate.
    pub exchange: Option<Exchange>,
}

/// A bed that was heated.
#[derive(Clone, Debug)]
pub struct Heated {
    pub kind: PlateKind,
    /// T at each probe.
    pub records: Vec<Record>,
    /// T \[K\] of the spheres at the end.
    pub temperatures: Vec<f64>,
    /// Heat that the spheres stored, and the residual of its balance \[J\].
    pub stored: f64,
    pub residual: f64,
    pub steps: u64,
}

/// Pours, presses and turns. `watch` receives the stage, and how far it has come, from 0 to 1.
///
/// # Errors
/// Those of the stages; a stage that does not come to rest.
pub fn prepare(
    case: &BedCase,
    threads: usize,
    mut watch: impl FnMut(&'static str, f64),
) -> Result<Bed, BedError> {
    let grains = &case.grains;
    let (d, g) = (grains.diameter, case.container.gravity);
    let pouring = grains.pouring(case.seed, case.vessel(), g, threads);
    let allowed = pouring.longest;
    let number = |name: &str| case.wall(name).unwrap_or_default();
    let (mut simulation, rest) = pour(&pouring, |agitation| watch("pour", progress(agitation)))?;
    let mut stages = vec![rest.of("pour")?];
    if let Some(lid) = &case.lid {
        let (wall, area) = (number("lid"), pouring.container.area());
        let watch = |agitation| watch("lid", progress(agitation));
        let rest = match (lid.depth(grains.volume(), area), lid.pressure) {
            (Some(depth), _) => close(&mut simulation, wall, depth, allowed, watch)?,
            (None, pressure) => {
                press(&mut simulation, wall, (pressure.unwrap_or_default(), area), allowed, watch)?
            }
        };
        stages.push(rest.of("lid")?);
    }
    if let Some(turned) = &case.turn {
        let Surface::Flat { normal } = simulation.boundary.walls()[number(&turned.down)].surface else {
            return Err(BedError::NotFlat);
        };
        turn(
            &mut simulation,
            normal.map(|n| -n),
            TURNING[0] * (d / TURNING[1] * (TURNING[2] / g)).sqrt(),
            |_| watch("turn", 0.0),
        )?;
        let rest = settle(&mut simulation, allowed, |a| watch("turn", progress(a)))?;
        stages.push(rest.of("turn")?);
    }
    let plate = number(&case.plate().wall);
    if let Some(pressure) = case.plate().pressure {
        let load = (pressure, parallel_area(&case.vessel(), &simulation, plate));
        let rest = press(&mut simulation, plate, load, allowed, |a| watch("plate", progress(a)))?;
        stages.push(rest.of("plate")?);
    }
    let walls = [(plate, case.plate().emissivity)];
    let exchange = grains.exchange(&simulation, &walls, case.temperatures(), (case.seed, threads))?;
    Ok(Bed { simulation, stages, plate, exchange })
}

/// Area of the bed parallel to a flat wall \[m²\].
fn parallel_area(container: &Container, simulation: &Simulation, wall: usize) -> f64 {
    let walls = simulation.boundary.walls();
    let Surface::Flat { normal } = walls[wall].surface else { return container.area() };
    if normal[2].abs() > 0.5 {
        return container.area();
    }
    // A side of a box: to the lid, or to the highest grain below it.
    let Container::Box { base: [x, y] } = *container else { return container.area() };
    let lid = walls[walls.len() - 1].point[2];
    let highest = simulation.spheres.iter().map(|s| s.position[2] + s.radius).fold(0.0, f64::max);
    lid.min(highest) * if normal[0].abs() > 0.5 { y } else { x }
}

impl Bed {
    pub fn wall(&self) -> Wall {
        self.simulation.boundary.walls()[self.plate]
    }

    /// Area of the bed parallel to the plate \[m²\].
    pub fn area(&self, case: &BedCase) -> f64 {
        parallel_area(&case.vessel(), &self.simulation, self.plate)
    }

    /// Force of the grains on the plate, across it, without friction \[N\].
    pub fn plate_force(&self) -> f64 {
        match self.wall().surface {
            Surface::Flat { normal } => -dot(self.simulation.wall_force[self.plate], normal),
            Surface::Cylinder { .. } => f64::NAN,
        }
    }

    /// What a lid that stopped at a porosity presses with \[Pa\], without friction.
    pub fn lid_pressure(&self, case: &BedCase) -> Option<f64> {
        case.lid.as_ref()?.porosity?;
        let lid = case.wall("lid")?;
        Some(self.simulation.wall_load(lid) / case.vessel().area())
    }

    /// φ \[-\] of the middle half of the bed.
    fn solid_fraction(&self, case: &BedCase) -> f64 {
        let wall = self.wall();
        let depth = self.simulation.spheres.iter().map(|s| wall.distance(s.position) + s.radius);
        let depth = depth.fold(0.0, f64::max);
        let middle = [0.25, 0.75].map(|part| part * depth);
        solid_fraction(&self.simulation, &wall, middle, Width::Whole(self.area(case)))
    }

    /// The network of the bed with a plate of a kind.
    pub fn network(&self, case: &BedCase, kind: PlateKind) -> Network {
        let (grains, keys) = (&case.grains, case.plate());
        let materials = grains.materials(&case.gas, self.solid_fraction(case));
        // 1/E* is the sum of (1 − ν²)/E of both.
        let compliance = |young: f64, poisson: f64| (1.0 - poisson * poisson) / young;
        let both = compliance(grains.young_modulus, grains.poisson_ratio)
            + compliance(keys.young_modulus, keys.poisson_ratio);
        let law = match kind {
            PlateKind::Held => PlateLaw::Held,
            PlateKind::Resisting => PlateLaw::Resisting {
                conductivity: keys.conductivity,
                effective_modulus: 1.0 / both,
                roughness: Roughness::given(keys.roughness, keys.hardness),
            },
        };
        let network = Network::new(&self.simulation, materials, &[Plate { wall: self.plate, law }]);
        network.radiating(self.exchange.as_ref(), grains.emissivity.clone(), &[self.plate])
    }

    /// Averages between two distances from the plate \[m\], at the initial temperature.
    pub fn slab(&self, case: &BedCase, between: [f64; 2]) -> Option<Slab> {
        let network = self.network(case, PlateKind::Held);
        let (wall, width) = (self.wall(), Width::Whole(self.area(case)));
        slab(&self.simulation, &network, &wall, between, width, case.time.initial_temperature)
    }

    /// Heats. `watch` receives how far it has come, from 0 to 1.
    ///
    /// # Errors
    /// No grain next to the plate; a probe without grains; heat that does not converge.
    pub fn heat(
        &self,
        case: &BedCase,
        kind: PlateKind,
        mut watch: impl FnMut(f64),
    ) -> Result<Heated, BedError> {
        let (network, wall, heat) = (self.network(case, kind), self.wall(), &case.time);
        let Surface::Flat { normal } = wall.surface else { return Err(BedError::NotFlat) };
        let touches = |sphere: &Sphere| wall.distance(sphere.position) < 2.0 * sphere.radius;
        if !self.simulation.spheres.iter().any(touches) {
            return Err(BedError::WallNotTouching { wall: case.plate().wall.clone() });
        }
        let probe = |&distance: &f64| {
            Probe::new(&self.simulation, &wall, normal, distance)
                .ok_or(BedError::NoGrains { key: "record.distances", distance })
        };
        let probes: Vec<Probe> = case.record.distances.iter().map(probe).collect::<Result<_, _>>()?;
        let mut transient =
            Transient::new(&network, heat.initial_temperature, vec![case.plate().temperature]);
        let record = |&distance: &f64| Record { distance, rows: Vec::new() };
        let mut records: Vec<Record> = case.record.distances.iter().map(record).collect();
        let (outputs, mut step) =
            ((heat.end / heat.output_every - 1e-9).ceil() as u64, FIRST_STEP.min(heat.output_every));
        for output in 0..=outputs {
            let time = (output as f64 * heat.output_every).min(heat.end);
            transient.run_to(time, heat.tolerance, &mut step)?;
            for (record, probe) in records.iter_mut().zip(&probes) {
                record.rows.push((time, probe.temperature(&transient.temperatures)));
            }
            watch(time / heat.end);
        }
        Ok(Heated {
            kind,
            records,
            stored: transient.stored(),
            residual: transient.residual(),
            steps: transient.steps,
            temperatures: transient.temperatures,
        })
    }
}
