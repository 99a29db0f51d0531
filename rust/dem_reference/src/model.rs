//! The initial model (section 3.2.1 of the paper): the box full of discs, packed until they are at rest, and its statistics.
//!
//! The discs are placed loosely in a longer box, which is then compressed along x. It ends at exactly the size of the case,
//! so the total area of the discs determines the porosity with overlaps counted twice. The friction during packing
//! determines the porosity at which the discs jam, and so the pressure. The grains and the long walls move with the mean
//! strain of the box: if the long walls stayed, their friction would leave one end of the box at three times the pressure
//! of the other.

use crate::ReferenceError;
use msdd_case::Case;
pub use msdd_case::packing::PACKING_FRICTION;
use msdd_dem::{Disc, Material, Simulation, Walls};
use msdd_rve::message::number;
use msdd_rve::pack::free_drag;
use msdd_rve::place::{Random, radii, scatter};
use msdd_rve::region::whole_box;
use msdd_rve::scale::rate_factor;
use msdd_rve::settle::{Settled, settle};
use msdd_rve::{Cut, Relaxation, homogenise_in, windows};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Number of discs in the box of the paper's cases.
pub const DISCS: usize = 15_000;
/// Porosity with overlaps counted twice, 1 − Σ π r² / area of the box. With the packing friction used it leads to the
/// paper's porosity of 12.5 %, in which overlaps are counted once. (15 000 discs of the paper's radii have 10.5 % on average,
/// so they are made 0.05 % larger.)
pub const SUM_POROSITY: f64 = 0.104;
/// Area fraction of the discs when they are placed. A denser start makes the sub-regions more equal and the fabric index
/// larger.
const START_DENSITY: f64 = 0.55;
/// Strain rate of the box [1/s] while grains hardly touch, and below the porosity `DENSE_POROSITY` (overlaps counted twice);
/// scaled from the paper's grains to others.
const LOOSE_RATE: f64 = 0.1;
const DENSE_RATE: f64 = 0.02;
const DENSE_POROSITY: f64 = 0.25;
/// Steps after which the remaining displacement of the wall is looked at again.
const RUN: u64 = 50;
/// Sub-regions of the box along x and y (section 3.2.1).
pub const SUB_REGIONS: [usize; 2] = [10, 3];

/// What to pack. The size of the box and the grains are those of the case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelSpec {
    /// Number of discs. Unless it is that of [`Filling::discs`], the box is smaller or larger than the case's, of the same shape.
    pub discs: usize,
    pub seed: u64,
    pub filling: Filling,
}

/// How full the box is, of which radii, and from where it was closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filling {
    /// Porosity with overlaps counted twice [-].
    pub porosity: f64,
    /// Smallest and largest radius over the mean radius [-].
    pub radii: [f64; 2],
    /// Whether the box was closed along x and y by the same strain, instead of along x alone.
    pub isotropic: bool,
}

impl Filling {
    /// As full as the paper's cases, with the radii of this case.
    pub fn of(case: &Case) -> Self {
        Self { porosity: SUM_POROSITY, radii: case.radii, isotropic: false }
    }

    /// Number of discs that fill the case's box; [`DISCS`], as in the paper, if that is right within 1 %.
    pub fn discs(&self, case: &Case) -> usize {
        let [low, high] = self.radii.map(|ratio| ratio * case.mean_radius);
        // Mean of r² for radii that are uniformly distributed between the two.
        let disc = PI * (low * low + low * high + high * high) / 3.0;
        let filling = (1.0 - self.porosity) * case.size[0] * case.size[1] / disc;
        if (filling / DISCS as f64 - 1.0).abs() < 0.01 { DISCS } else { filling.round() as usize }
    }
}

/// A packed box at rest.
#[derive(Clone, Debug)]
pub struct Model {
    pub simulation: Simulation,
    pub settled: Settled,
}

/// Statistics of the initial model, compared with the values that the paper gives for its own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Statistics {
    /// Porosity of the box, overlaps counted once; paper: 0.125.
    pub porosity: f64,
    /// 1 less the sum of the areas of the grains over the area: overlaps counted twice.
    pub porosity_sum_of_areas: f64,
    /// Least and largest porosity of the sub-regions; paper (over windows): 0.117 to 0.131.
    pub porosity_range: [f64; 2],
    /// F_xx − F_yy of the box; paper: 0.050.
    pub fabric_index: f64,
    /// Least and largest of the sub-regions; paper (over windows): 0.030 to 0.064.
    pub fabric_range: [f64; 2],
    /// Pressure, compression positive \[Pa\].
    pub pressure: f64,
    /// σ_xx/σ_yy of the box.
    pub stress_ratio: f64,
    /// σ_xx of the first and of the last tenth along x, which shows how even the packing is \[Pa\].
    pub stress_xx_ends: [f64; 2],
    /// K/k, xx and yy, affine.
    pub conductivity: [f64; 2],
    /// K/k, xx and yy, network.
    pub conductivity_network: [f64; 2],
    /// Contacts of a grain that has any.
    pub coordination: f64,
    /// Number of grains without contact.
    pub rattlers: u64,
}

impl ModelSpec {
    /// Size of the box over that of the case [-].
    pub fn scale(&self, case: &Case) -> f64 {
        (self.discs as f64 / self.filling.discs(case) as f64).sqrt()
    }

    fn check(&self) -> Result<(), ReferenceError> {
        if (100..=1_000_000).contains(&self.discs) {
            return Ok(());
        }
        let (value, allowed) = (self.discs.to_string(), "100 to 1000000".to_string());
        Err(ReferenceError::Parameter { key: "discs", value, allowed })
    }
}

/// Packs the box of a case; results do not depend on `threads`. `progress` is called with the share that is done, 0 to 1.
///
/// # Errors
/// [`ReferenceError::Parameter`] when the case's grains do not fill the box; [`ReferenceError::Rve`] when the packing
/// fails.
pub fn pack(
    spec: ModelSpec,
    case: &Case,
    threads: usize,
    mut progress: impl FnMut(f64),
) -> Result<Model, ReferenceError> {
    spec.check()?;
    case.material.check().map_err(msdd_rve::RveError::from)?;
    let [width, height] = case.size.map(|length| length * spec.scale(case));
    let mut random = Random::new(spec.seed);
    let radii = fitting_radii(&mut random, spec, case, width * height)?;
    let looser = (1.0 - spec.filling.porosity) / START_DENSITY;
    let [start_width, start_height] = match spec.filling.isotropic {
        true => [width, height].map(|length| length * looser.sqrt()),
        false => [(1.0 - spec.filling.porosity) * width / START_DENSITY, height],
    };
    // The discs are placed with x and y exchanged, so that they are numbered column by column and neighbours are near each
    // other in memory.
    let discs = scatter(&mut random, radii, start_height, start_width, case.material.density)?;
    let discs = discs.into_iter().map(|disc| Disc { x: disc.y, y: disc.x, ..disc }).collect();
    // No grain slides less easily while it is packed than afterwards.
    let friction_angle = PACKING_FRICTION.atan().min(case.material.friction_angle);
    let slippery = Material { friction_angle, ..case.material.clone() };
    let mut simulation = Simulation::new(slippery, discs, Walls::around(start_width, start_height));
    simulation.free_drag = free_drag(&simulation);
    simulation.set_threads(threads)?;
    close(&mut simulation, [width, height], |done| progress(0.9 * done))?;
    simulation.material = case.material.clone();
    let settled = settle(&mut simulation, Relaxation::Damped, 0)?;
    progress(1.0);
    simulation.reset_strain();
    (simulation.time, simulation.steps) = (0.0, 0);
    Ok(Model { simulation, settled })
}

/// Radii of the case's distribution, scaled a little so that they fill the area [m²] to the wanted porosity.
fn fitting_radii(
    random: &mut Random,
    spec: ModelSpec,
    case: &Case,
    area: f64,
) -> Result<Vec<f64>, ReferenceError> {
    let [low, high] = spec.filling.radii.map(|ratio| ratio * case.mean_radius);
    let mut radii = radii(random, spec.discs, low, high);
    let filled: f64 = radii.iter().map(|r| PI * r * r).sum();
    let factor = ((1.0 - spec.filling.porosity) * area / filled).sqrt();
    // The mean square of random radii scatters more with fewer discs; with 15 000 the factor scatters by 0.2 %.
    let slack = 0.01 * (DISCS as f64 / spec.discs as f64).sqrt().max(1.0);
    if (factor - 1.0).abs() > slack {
        return Err(ReferenceError::Parameter {
            key: "meanRadius",
            value: format!("{} m", case.mean_radius),
            allowed: format!(
                "about {:.4e} m, for {} discs to fill their share of the box of {:?} m",
                factor * case.mean_radius,
                spec.discs,
                case.size
            ),
        });
    }
    radii.iter_mut().for_each(|radius| *radius *= factor);
    Ok(radii)
}

/// Moves the right wall and the top to a width and a height [m], so that both arrive at once; the grains move with the mean
/// strain of the box.
fn close(
    simulation: &mut Simulation,
    [width, height]: [f64; 2],
    mut progress: impl FnMut(f64),
) -> Result<(), ReferenceError> {
    let way = simulation.walls.width() - width;
    let solid: f64 = simulation.discs.iter().map(Disc::area).sum();
    let faster = rate_factor(&simulation.material, simulation.mean_radius());
    (simulation.affine, simulation.affine_walls) = (true, true);
    loop {
        let left = simulation.walls.width() - width;
        let lower = simulation.walls.height() - height;
        let loose = 1.0 - solid / simulation.walls.area() > DENSE_POROSITY;
        let speed = simulation.walls.width() * faster * if loose { LOOSE_RATE } else { DENSE_RATE };
        let steps = (left / (speed * simulation.time_step)).ceil();
        if steps < 1.0 || left < 1e-12 {
            break;
        }
        let time = steps * simulation.time_step;
        simulation.walls.normal_velocity = [0.0, -left / time, 0.0, -lower / time];
        simulation.run((steps as u64).min(RUN))?;
        progress(1.0 - left / way);
    }
    simulation.walls.stop();
    [simulation.walls.position[1], simulation.walls.position[3]] = [width, height];
    (simulation.affine, simulation.affine_walls) = (false, false);
    Ok(())
}

/// Statistics of a box.
pub fn statistics(simulation: &Simulation) -> Statistics {
    let whole = homogenise_in(simulation, &whole_box(simulation), Cut::Clip);
    let tenths = windows(simulation, SUB_REGIONS[0], 1);
    let (mut porosity_range, mut fabric_range) = ([f64::INFINITY, f64::NEG_INFINITY], [1.0, -1.0f64]);
    for part in windows(simulation, SUB_REGIONS[0], SUB_REGIONS[1]) {
        let widen = |range: &mut [f64; 2], v: f64| *range = [range[0].min(v), range[1].max(v)];
        widen(&mut porosity_range, part.averages.porosity);
        widen(&mut fabric_range, part.averages.fabric_index);
    }
    Statistics {
        porosity: whole.porosity,
        porosity_sum_of_areas: whole.porosity_sum_of_areas,
        porosity_range,
        fabric_index: whole.fabric_index,
        fabric_range,
        pressure: whole.pressure,
        stress_ratio: whole.stress_xx / whole.stress_yy,
        stress_xx_ends: [tenths[0].averages.stress_xx, tenths[SUB_REGIONS[0] - 1].averages.stress_xx],
        conductivity: [whole.conductivity_xx, whole.conductivity_yy],
        conductivity_network: [whole.conductivity_network_xx, whole.conductivity_network_yy],
        coordination: whole.coordination,
        rattlers: whole.rattlers,
    }
}

/// What is behind a state that does not fit.
const OTHER: &str = "as in the case, which has changed since it was packed: pack it again (msdd reference pack --force) or name another --state";

/// Refuses a state that is not a packed box of this case.
///
/// # Errors
/// [`ReferenceError::Parameter`] with what differs.
pub fn check_state(simulation: &Simulation, case: &Case) -> Result<(), ReferenceError> {
    let refuse = |key, value: String, allowed: String| Err(ReferenceError::Parameter { key, value, allowed });
    let (found, wanted) = (simulation.material.parameters(), case.material.parameters());
    if let Some((found, wanted)) = found.iter().zip(&wanted).find(|(found, wanted)| found.1 != wanted.1) {
        let (value, allowed) = (number(found.1), number(wanted.1));
        return refuse(found.0, format!("{value} in the state"), format!("{allowed}, {OTHER}"));
    }
    // With few discs the mean of random radii scatters: by 2 % with 100.
    let (radius, wanted) = (simulation.mean_radius(), case.mean_radius);
    if (radius / wanted - 1.0).abs() > 0.1 {
        let allowed = format!("about {} m, {OTHER}", number(wanted));
        return refuse("mean radius", format!("{} m in the state", number(radius)), allowed);
    }
    let radii = || simulation.discs.iter().map(|disc| disc.radius);
    let ratio = radii().fold(0.0, f64::max) / radii().fold(f64::INFINITY, f64::min);
    let wanted = case.radii[1] / case.radii[0];
    if (ratio / wanted - 1.0).abs() > 0.15 {
        let allowed = format!("about {}, {OTHER}", number(wanted));
        return refuse("largest over smallest radius", format!("{} in the state", number(ratio)), allowed);
    }
    let (width, height) = (simulation.walls.width(), simulation.walls.height());
    if ((width / height) / (case.size[0] / case.size[1]) - 1.0).abs() > 1e-9 {
        let allowed = format!("the shape of the case's box, {:?} m; {OTHER}", case.size);
        return refuse("box of the state", format!("{width} x {height} m"), allowed);
    }
    Ok(())
}
