//! The initial state of a new case: means over small periodic boxes of its grains, packed by DEM.

use crate::disc_model::DiscModel;
use crate::grains::Grains;
use crate::numbers::short;
use crate::ranges::allow;
use crate::{CaseError, refused};
use msdd_rve::message::number;
use msdd_rve::{
    Averages, Boundary, Compression, PackingSpec, Preparation, RegionKind, Relaxation, homogenise, pack_as,
};
use msdd_surrogate::surrogate::{Answer, InitialData};
use rayon::prelude::*;

pub use crate::disc_model::{PACKING_FRICTION, POROSITIES};

/// Smallest and largest radius over the mean radius; in the paper 3, 7 and 5 mm.
pub const RADIUS_RANGE: [f64; 2] = [0.6, 1.4];
/// Number of grains in each box.
const GRAINS: usize = 500;
/// Largest relative difference between the pressure that was wanted and that of the packings.
const PRESSURE_TOLERANCE: f64 = 0.01;
/// Largest number of rounds of packing to find the porosity with the wanted pressure.
const ROUNDS: usize = 8;
/// Slope of η over √p̃, from the packings of the shipped model.
const REFERENCE_SLOPE: f64 = -0.47;

/// The quantity that the initial packing has to have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InitialPacking {
    /// η [-], overlaps counted once.
    Porosity(f64),
    /// p \[Pa\], compression positive.
    Pressure(f64),
}

/// The discs that are packed.
#[derive(Clone, Copy, Debug)]
pub struct Discs<'a> {
    pub grains: &'a Grains,
    /// Their friction and their radii are those that it was trained with.
    pub model: &'a DiscModel,
    pub compression: Compression,
}

/// Mean over the boxes, and scatter between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    pub mean: f64,
    /// Standard deviation between boxes.
    pub deviation: f64,
}

/// The initial state. Compression positive.
#[derive(Clone, Debug, PartialEq)]
pub struct Packing {
    pub boxes: usize,
    /// Number of grains in each box.
    pub grains: usize,
    pub compression: Compression,
    /// η [-], overlaps counted once.
    pub porosity: Spread,
    /// f = F_xx − F_yy [-].
    pub fabric_index: Spread,
    /// σ_xx, σ_yy \[Pa\].
    pub stress: [Spread; 2],
    /// p \[Pa\].
    pub pressure: Spread,
    /// (K_xx + K_yy)/(2 k) [-], resistor network of the contacts solved.
    pub conductivity: Spread,
}

/// How many boxes are packed, and on how many threads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Number of boxes that are averaged.
    pub boxes: usize,
    /// Seed of the first box.
    pub seed: u64,
    /// Number of threads; results do not depend on it.
    pub threads: usize,
}

/// Packs boxes of the grains and averages them. `progress` is called with the number of boxes that are done, and with the
/// number of all boxes as far as it is known then.
///
/// # Errors
/// [`CaseError::Parameter`] for a porosity or pressure that such grains do not have or the shipped model does not know;
/// [`CaseError::Rve`] when a packing fails.
pub fn pack(
    discs: Discs,
    start: InitialPacking,
    effort: Effort,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Packing, CaseError> {
    discs.grains.check()?;
    check(discs, start)?;
    match start {
        InitialPacking::Porosity(porosity) => {
            boxes_of(discs, porosity, effort, &|done| progress(done, effort.boxes))
        }
        InitialPacking::Pressure(pressure) => to_pressure(discs, pressure, effort, progress),
    }
}

/// Refuses a start that is out of range, before anything is packed.
///
/// # Errors
/// [`CaseError::Parameter`].
pub fn check(discs: Discs, start: InitialPacking) -> Result<(), CaseError> {
    let [least, most] = discs.model.porosities();
    match start {
        InitialPacking::Porosity(porosity) => {
            allow("porosity", porosity, (least..=most).contains(&porosity), || {
                format!(
                    "{least} to {most}, the packings of discs that the model was trained with (in two dimensions; looser discs \
                     hardly touch, denser ones overlap too much)"
                )
            })
        }
        InitialPacking::Pressure(pressure) => {
            let [low, high] = discs.pressures();
            if (low..=high).contains(&pressure) {
                return Ok(());
            }
            let allowed = format!(
                "{} to {} Pa for these grains, which is what packings of a porosity from {most} to {least} have. Pressure is \
                 in proportion to youngModulus times meanRadius, while conduction depends on the porosity alone: with a \
                 smaller youngModulus, as is usual in discrete element simulations, there is less pressure",
                short(low),
                short(high)
            );
            Err(refused("pressure", format!("{} Pa", number(pressure)), allowed))
        }
    }
}

impl Discs<'_> {
    /// Pressures [Pa] of the loosest and of the densest packing that are allowed, by the model.
    fn pressures(&self) -> [f64; 2] {
        let [least, most] = self.model.porosities();
        [most, least].map(|porosity| self.grains.stress_scale() * self.expected(porosity))
    }

    /// The mean packing of a porosity, by the model.
    pub(crate) fn usual(&self, porosity: f64) -> Answer {
        let law = self.model.law();
        let known =
            InitialData { porosity, fabric_index: usual_fabric(self.compression), ..InitialData::default() };
        law.evaluate(&law.initial_state(&known), 0.0)
    }

    /// Its reduced pressure p̃ [-].
    fn expected(&self, porosity: f64) -> f64 {
        let answer = self.usual(porosity);
        0.5 * (answer.stress[0][0] + answer.stress[1][0])
    }

    /// Porosity at which the model's mean packing has this pressure \[Pa\].
    pub(crate) fn porosity_at(&self, pressure: f64) -> f64 {
        let reduced = pressure / self.grains.stress_scale();
        let [mut dense, mut loose] = self.model.porosities();
        for _ in 0..40 {
            let middle = 0.5 * (dense + loose);
            if self.expected(middle) > reduced { dense = middle } else { loose = middle }
        }
        0.5 * (dense + loose)
    }
}

/// Approximate fabric index of packings that were compressed in this way [-].
pub fn usual_fabric(compression: Compression) -> f64 {
    match compression {
        Compression::Isotropic => 0.0,
        _ => 0.045,
    }
}

/// Porosity with overlaps counted twice of packings with this porosity, overlaps counted once, by the shipped model.
///
/// # Errors
/// [`CaseError::Parameter`] for a porosity outside of [`POROSITIES`]; [`CaseError::Model`] when the model cannot be read.
pub fn sum_porosity(porosity: f64) -> Result<f64, CaseError> {
    let [least, most] = POROSITIES;
    let allowed = || format!("{least} to {most} for a packing of discs");
    allow("porosity", porosity, (least..=most).contains(&porosity), allowed)?;
    Ok(1.0 - msdd_surrogate::models::builtin(msdd_surrogate::models::BUILTIN)?.solid_fraction(porosity))
}

/// Finds the porosity with a given pressure. The porosity is nearly linear in √p, so each round interpolates between the two
/// packings whose √p is nearest to the wanted one.
fn to_pressure(
    discs: Discs,
    pressure: f64,
    effort: Effort,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Packing, CaseError> {
    let scale = discs.grains.stress_scale();
    let wanted = (pressure / scale).sqrt();
    let mut porosity = discs.porosity_at(pressure);
    let mut known: Vec<[f64; 2]> = Vec::new();
    for round in 0..ROUNDS {
        let done = round * effort.boxes;
        let all = effort.boxes * (round + 1).max(2);
        let packing = boxes_of(discs, porosity, effort, &|here| progress(done + here, all))?;
        if (packing.pressure.mean / pressure - 1.0).abs() < PRESSURE_TOLERANCE {
            return Ok(packing);
        }
        known.push([porosity, (packing.pressure.mean / scale).max(0.0).sqrt()]);
        known.sort_by(|a, b| (a[1] - wanted).abs().total_cmp(&(b[1] - wanted).abs()));
        // Two packings of almost the same porosity may have rearranged: then their slope says nothing.
        let slope = match known.as_slice() {
            [a, b, ..] if a[1] != b[1] => {
                ((a[0] - b[0]) / (a[1] - b[1])).clamp(2.0 * REFERENCE_SLOPE, 0.5 * REFERENCE_SLOPE)
            }
            _ => REFERENCE_SLOPE,
        };
        let [least, most] = discs.model.porosities();
        porosity = (known[0][0] + slope * (wanted - known[0][1])).clamp(least - 0.01, most + 0.01);
    }
    let allowed = format!("one that packings of these grains reach; {ROUNDS} rounds of packing did not");
    Err(refused("pressure", format!("{} Pa", number(pressure)), allowed))
}

fn boxes_of(
    discs: Discs,
    porosity: f64,
    effort: Effort,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Packing, CaseError> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(effort.threads.max(1)).build();
    let pool = pool.map_err(|error| CaseError::Threads(std::io::Error::other(error)))?;
    let done = std::sync::atomic::AtomicUsize::new(0);
    let one = |k: usize| {
        let averages = packed(discs, porosity, effort.seed + k as u64);
        progress(done.fetch_add(1, std::sync::atomic::Ordering::Relaxed) + 1);
        averages
    };
    let averages: Result<Vec<Averages>, CaseError> =
        pool.install(|| (0..effort.boxes.max(1)).into_par_iter().map(one).collect());
    Ok(Packing::of(&averages?, discs.compression))
}

fn packed(discs: Discs, porosity: f64, seed: u64) -> Result<Averages, CaseError> {
    let [radius_min, radius_max] = discs.model.radii().map(|ratio| ratio * discs.grains.mean_radius);
    let boundary = Boundary::Periodic;
    let relaxation = Relaxation::Fire;
    let spec = PackingSpec {
        discs: GRAINS,
        seed,
        porosity,
        compression: discs.compression,
        radius_min,
        radius_max,
        boundary,
        relaxation,
    };
    let preparation =
        Preparation { friction_angle: Some(discs.model.packing_angle()), ..Preparation::default() };
    let packed = pack_as(&spec, &preparation, &discs.model.material(discs.grains))?;
    Ok(homogenise(&packed.simulation, RegionKind::Cell))
}

impl Packing {
    /// Mean over the boxes. In packings that were compressed equally in both directions, differences between x and y are
    /// random, so each is averaged with itself turned by 90°.
    fn of(averages: &[Averages], compression: Compression) -> Self {
        let alike = compression == Compression::Isotropic;
        let spread = |value: fn(&Averages) -> f64| Spread::of(averages.iter().map(value));
        let odd = |value: fn(&Averages) -> f64| {
            let found = spread(value);
            if alike { Spread { mean: 0.0, ..found } } else { found }
        };
        let pressure = spread(|a| a.pressure);
        let stress = [spread(|a| a.stress_xx), spread(|a| a.stress_yy)]
            .map(|found| if alike { Spread { mean: pressure.mean, ..found } } else { found });
        Self {
            boxes: averages.len(),
            grains: GRAINS,
            compression,
            porosity: spread(|a| a.porosity),
            fabric_index: odd(|a| a.fabric_index),
            stress,
            pressure,
            conductivity: spread(|a| 0.5 * (a.conductivity_network_xx + a.conductivity_network_yy)),
        }
    }
}

impl Spread {
    fn of(values: impl Iterator<Item = f64> + Clone) -> Self {
        let count = values.clone().count().max(1) as f64;
        let mean = values.clone().sum::<f64>() / count;
        let square: f64 = values.map(|value| (value - mean) * (value - mean)).sum();
        Self { mean, deviation: (square / (count - 1.0).max(1.0)).sqrt() }
    }
}

#[cfg(test)]
#[path = "packing_tests.rs"]
mod tests;
