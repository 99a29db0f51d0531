//! Straining of a packed RVE: radii grow or shrink in fixed walls, with stops (section 2.4); or the walls move, too.

use crate::homogenise::{Averages, homogenise};
use crate::region::RegionKind;
use crate::scale::rate_factor;
use crate::settle::{KEEP_EVERY, Relaxation, Settled, UNBALANCED_LIMIT, settle_to};
use crate::stopwatch::{self, Stage};
use crate::{RveError, Simulation};

/// How a path of strains is followed: the rate of the strain that changes most [1/s], separately for paths that close
/// contacts and paths that open them, and how forces are brought into balance at the stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Protocol {
    pub expansion_rate: f64,
    pub contraction_rate: f64,
    pub relaxation: Relaxation,
    /// Limit of the force balance at the stops: mean |resultant| over mean contact force [-].
    pub unbalanced_limit: f64,
}

impl Default for Protocol {
    /// Values for the paper's grains. Expansion hardly depends on the rate; near unjamming, contraction does (to −2 %
    /// at 2 /s: σ 12 % low).
    fn default() -> Self {
        Self {
            expansion_rate: 0.1,
            contraction_rate: 0.02,
            relaxation: Relaxation::default(),
            unbalanced_limit: UNBALANCED_LIMIT,
        }
    }
}

impl Protocol {
    /// The default for the grains of `simulation`: scaled so that the path is as fast, relative to the motion of the
    /// grains, as the default is for the paper's grains.
    pub fn usual(simulation: &Simulation) -> Self {
        let usual = Self::default();
        let factor = rate_factor(&simulation.material, simulation.mean_radius());
        Self {
            expansion_rate: factor * usual.expansion_rate,
            contraction_rate: factor * usual.contraction_rate,
            ..usual
        }
    }
}

/// Largest number of steps between two updates of the time step.
const RUN: u64 = 50;

/// Strains relative to the start of a path [-].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Strains {
    /// ε of the radii.
    pub thermal: f64,
    /// Extension of the box along x and y, positive: longer. Both walls (or borders) move by half of it.
    pub xx: f64,
    pub yy: f64,
    /// γ_xy of a periodic box: displacement of the upper border along x over the height at the start of the path. If
    /// the box is sheared already, its shear offset s becomes (1 + xx) s + xy H.
    pub xy: f64,
}

impl Strains {
    pub fn thermal(strain: f64) -> Self {
        Self { thermal: strain, ..Self::default() }
    }

    /// Thermal, along x, along y, shear.
    pub fn parts(self) -> [f64; 4] {
        [self.thermal, self.xx, self.yy, self.xy]
    }

    /// The strains relative to the start after these and then `next`, which is relative to the state in between.
    pub fn then(self, next: Self) -> Self {
        let compound = |a: f64, b: f64| a + b + a * b;
        Self {
            thermal: compound(self.thermal, next.thermal),
            xx: compound(self.xx, next.xx),
            yy: compound(self.yy, next.yy),
            // The shear offset is stretched along with the width, and `next.xy` counts over the height in between.
            xy: self.xy * (1.0 + next.xx) + next.xy * (1.0 + self.yy),
        }
    }
}

/// The state at one stop of a path.
#[derive(Clone, Debug)]
pub struct Stop {
    pub strains: Strains,
    pub settled: Settled,
    pub averages: Averages,
}

/// The states of a ramp, as far as it could be followed.
#[derive(Clone, Debug)]
pub struct Ramp {
    pub stops: Vec<Stop>,
    /// Why the ramp ended before its last stop; none when it did not.
    pub failure: Option<RveError>,
}

/// Follows a path of thermal strain and wall strain from stop to stop, with straight lines in between. The simulation
/// ends at the last stop reached; `visit` is called with it at each stop. After a failure,
/// [`Simulation::take_last_good`] returns the last good state.
///
/// # Errors
/// [`RveError::Parameter`] for strains or rates that are not allowed. A failure during the path is in
/// [`Ramp::failure`].
pub fn follow(
    simulation: &mut Simulation,
    path: &[Strains],
    protocol: Protocol,
    mut visit: impl FnMut(&Stop, &Simulation),
) -> Result<Ramp, RveError> {
    check(path, protocol, rate_factor(&simulation.material, simulation.mean_radius()))?;
    if let Some(strains) = path.iter().find(|s| s.xy != 0.0 && simulation.periodic.is_none()) {
        return RveError::parameter("xy", strains.xy, "0 between walls; shear needs a periodic box");
    }
    simulation.reset_strain();
    simulation.keep_last_good(KEEP_EVERY);
    let start = UnstrainedBox::of(simulation);
    let mut ramp = Ramp { stops: Vec::new(), failure: None };
    for &strains in path {
        match advance_to(simulation, strains, start, protocol) {
            Ok(stop) => {
                visit(&stop, simulation);
                ramp.stops.push(stop);
            }
            Err(failure) => {
                ramp.failure = Some(failure);
                return Ok(ramp);
            }
        }
    }
    simulation.take_last_good();
    Ok(ramp)
}

/// `factor`: ratio of the rates suitable for these grains to those for the paper's grains.
fn check(path: &[Strains], protocol: Protocol, factor: f64) -> Result<(), RveError> {
    for (key, rate) in
        [("expansion rate", protocol.expansion_rate), ("contraction rate", protocol.contraction_rate)]
    {
        if !(1e-6 * factor..=100.0 * factor).contains(&rate) {
            let allowed =
                "1e-6 to 100 1/s for the paper's grains, others as their contacts swing faster or slower";
            return RveError::parameter(key, rate, allowed);
        }
    }
    if !(1e-12..=1.0).contains(&protocol.unbalanced_limit) {
        return RveError::parameter("unbalanced limit", protocol.unbalanced_limit, "1e-12 to 1");
    }
    let values =
        path.iter().flat_map(|s| [("thermal strain", s.thermal), ("xx", s.xx), ("yy", s.yy), ("xy", s.xy)]);
    for (key, value) in values {
        if !(-0.2..=0.2).contains(&value) {
            return RveError::parameter(key, value, "-0.2 to 0.2");
        }
    }
    Ok(())
}

/// The box at zero strain [m].
#[derive(Clone, Copy)]
struct UnstrainedBox {
    width: f64,
    height: f64,
    shear_offset: f64,
}

impl UnstrainedBox {
    fn of(simulation: &Simulation) -> Self {
        Self {
            width: simulation.walls.width(),
            height: simulation.walls.height(),
            shear_offset: simulation.periodic.map_or(0.0, |periodic| periodic.shear_offset),
        }
    }

    /// Differences of width, height and shear offset from their values at `target` [m].
    fn missing(&self, simulation: &Simulation, target: Strains) -> [f64; 3] {
        let now = Self::of(simulation);
        let sheared = self.shear_offset * (1.0 + target.xx) + target.xy * self.height;
        [
            self.width * (1.0 + target.xx) - now.width,
            self.height * (1.0 + target.yy) - now.height,
            sheared - now.shear_offset,
        ]
    }
}

fn stop_box(simulation: &mut Simulation) {
    simulation.walls.stop();
    if let Some(periodic) = &mut simulation.periodic {
        periodic.shear_rate = 0.0;
    }
}

/// Sets the velocities at which the box changes by `missing` in `time` [s].
fn set_box_velocity(simulation: &mut Simulation, [dx, dy, ds]: [f64; 3], time: f64) {
    let (vx, vy) = (0.5 * dx / time, 0.5 * dy / time);
    simulation.walls.normal_velocity = [-vx, vx, -vy, vy];
    let (width, height) = (simulation.walls.width(), simulation.walls.height());
    if let Some(periodic) = &mut simulation.periodic {
        // The affine flow stretches the shear offset along with the width.
        let stretched = periodic.shear_offset * dx / width;
        periodic.shear_rate = (ds - stretched) / time / height;
    }
}

/// Strains in a straight line to `target`, then relaxes until the forces balance.
fn advance_to(
    simulation: &mut Simulation,
    target: Strains,
    start: UnstrainedBox,
    protocol: Protocol,
) -> Result<Stop, RveError> {
    let since = simulation.steps;
    stopwatch::time(Stage::Strain, || strain_to(simulation, target, start, protocol))?;
    rest(simulation, target, protocol, since)
}

/// Relaxes with walls at rest and averages.
pub(crate) fn rest(
    simulation: &mut Simulation,
    strains: Strains,
    protocol: Protocol,
    since: u64,
) -> Result<Stop, RveError> {
    simulation.set_strain_rate(0.0);
    stop_box(simulation);
    let settled = stopwatch::time(Stage::StrainSettle, || {
        settle_to(simulation, protocol.relaxation, protocol.unbalanced_limit, since)
    })?;
    let averages = stopwatch::time(Stage::Averaging, || homogenise(simulation, RegionKind::default()));
    Ok(Stop { strains, settled, averages })
}

fn strain_to(
    simulation: &mut Simulation,
    target: Strains,
    start: UnstrainedBox,
    protocol: Protocol,
) -> Result<(), RveError> {
    loop {
        let thermal = target.thermal - simulation.strain();
        let missing = start.missing(simulation, target);
        let [dx, dy, ds] = missing;
        let (width, height) = (start.width, start.height);
        let largest = thermal.abs().max(dx.abs() / width).max(dy.abs() / height).max(ds.abs() / height);
        // Whether contacts rather open: radii shrink or walls recede.
        let loosening = 2.0 * thermal < dx / width + dy / height;
        let rate = if loosening { protocol.contraction_rate } else { protocol.expansion_rate };
        let steps = (largest / (rate * simulation.time_step)).ceil();
        if steps < 1.0 || largest < 1e-12 {
            return Ok(());
        }
        // Equal steps that end exactly at the stop, or the first `RUN` of them.
        let time = steps * simulation.time_step;
        simulation.set_strain_rate(thermal / time);
        set_box_velocity(simulation, missing, time);
        simulation.run((steps as u64).min(RUN))?;
    }
}
