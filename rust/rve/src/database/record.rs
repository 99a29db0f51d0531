//! One row of the database: one state of one packing.

use super::kind::{Kind, RampName};
use super::paths::Increment;
use super::plan::Job;
use super::table::row;
use crate::slide::Sliding;
use crate::{Averages, Boundary, Compression, Material, RegionKind, Settled, Strains};

#[rustfmt::skip]
row! {
    /// One state at one stop of a ramp; every stop of the plan has a row. Averages are absent when the stop was not
    /// reached. Meaning and unit of each field are those of [`COLUMNS`].
    Record, "3", LATER, ramp: RampName;
    packing: i64, "INTEGER", "-", "index of the packing in the plan";
    kind: Kind, "TEXT", "-", "thermal: radii change in fixed walls; mechanics: walls move; wall_shear: bottom and top slip along the grains; paths: a periodic box follows paths of strain";
    discs: u64, "INTEGER", "-", "discs in the packing";
    seed: u64, "INTEGER", "-", "seed of the packing";
    compression: Compression, "TEXT", "-", "isotropic: walls close in x and y; horizontal: in x only; intermediate: twice as fast in x as in y; sheared: in x, while y opens an eighth as fast";
    target_porosity: f64, "REAL", "-", "porosity of the whole box at which the walls stopped, overlaps counted once";
    packing_friction_angle: f64, "REAL", "rad", "friction angle of the grains while the walls closed; the material's own afterwards";
    ramp: RampName, "TEXT", "-", "packed: before any strain; up, down: radii grow, shrink; up_down, down_up: back from the last stop of up, down; xx, yy: walls move along x, y; xy: shear of a periodic box; wall_shear: bottom and top move along x; others: paths of strain of a periodic box";
    stop: i64, "INTEGER", "-", "place on the ramp from 1; 0 is the packed state; of xx, yy and xy: negative closing or shear against x, positive opening or shear along x, both from the packed state; of paths: running number";
    strain: f64, "REAL", "-", "radial thermal strain relative to the packed state, growth positive";
    strain_xx: f64, "REAL", "-", "extension of the box along x relative to the packed state, extension positive";
    strain_yy: f64, "REAL", "-", "extension of the box along y relative to the packed state, extension positive";
    strain_xy: f64, "REAL", "-", "shear of the box, displacement along x over height, relative to the packed state";
    from_stop: Option<i64>, "INTEGER", "-", "of a path: stop from whose state the increment starts; 0 is the packed state";
    step_thermal: Option<f64>, "REAL", "-", "of a path: increment of the radii relative to the state at from_stop, growth positive";
    step_xx: Option<f64>, "REAL", "-", "of a path: increment of the box along x relative to the state at from_stop, extension positive";
    step_yy: Option<f64>, "REAL", "-", "of a path: increment of the box along y relative to the state at from_stop, extension positive";
    step_xy: Option<f64>, "REAL", "-", "of a path: shear increment, displacement along x over height, relative to the state at from_stop";
    probe: Option<u64>, "INTEGER", "-", "of a path: 1: tried on a copy of the box, the path goes on from from_stop; 0: the path goes on from here";
    wall_slip: f64, "REAL", "m", "way of bottom and top along x since the packed state";
    wall_slip_of_grains: Option<f64>, "REAL", "m", "wall_slip less the way of the grains that touch bottom or top, which the assembly behind them lets move; weighted by normal force";
    wall_friction: Option<f64>, "REAL", "-", "mobilised friction: tangential over normal force on the grains, along the motion, mean of bottom and top";
    region: String, "TEXT", "-", "averaging region; hull: of the centres of force-bearing discs that touch no wall; inset: box less 0.8 mean radii; cell: whole periodic cell";
    outcome: String, "TEXT", "-", "settled; capped: step cap before balance; unjammed: carries no load; failed: see failure";
    failure: Option<String>, "TEXT", "-", "why the stop was not reached; absent when it was";
    steps: u64, "INTEGER", "-", "time steps from the previous stop";
    unbalanced: Option<f64>, "REAL", "-", "mean resultant force over mean contact force";
    young_modulus: f64, "REAL", "Pa", "E of the grains";
    initial_porosity: Option<f64>, "REAL", "-", "porosity of the packed state (input of the paper's database)";
    initial_porosity_sum_of_areas: Option<f64>, "REAL", "-", "porosity_sum_of_areas of the packed state";
    initial_fabric_index: Option<f64>, "REAL", "-", "fabric index of the packed state (input of the paper's database)";
    initial_fabric_conductivity: Option<f64>, "REAL", "-", "fabric_conductivity of the packed state";
    initial_conductivity_xx: Option<f64>, "REAL", "-", "conductivity_xx of the packed state";
    initial_conductivity_yy: Option<f64>, "REAL", "-", "conductivity_yy of the packed state";
    initial_conductivity_network_xx: Option<f64>, "REAL", "-", "conductivity_network_xx of the packed state";
    initial_conductivity_network_yy: Option<f64>, "REAL", "-", "conductivity_network_yy of the packed state";
    initial_stress_xx: Option<f64>, "REAL", "Pa", "stress_xx of the packed state";
    initial_stress_yy: Option<f64>, "REAL", "Pa", "stress_yy of the packed state";
    initial_coordination: Option<f64>, "REAL", "-", "coordination of the packed state";
    initial_rattlers: Option<u64>, "INTEGER", "-", "rattlers of the packed state";
    porosity: Option<f64>, "REAL", "-", "of the region, overlaps counted once";
    porosity_sum_of_areas: Option<f64>, "REAL", "-", "1 - sum of disc areas / box area";
    overlap_fraction: Option<f64>, "REAL", "-", "part of the region covered more than once";
    fabric_index: Option<f64>, "REAL", "-", "F_xx - F_yy, Eq. 8";
    fabric_xx: Option<f64>, "REAL", "-", "F_xx, Eq. 8";
    fabric_yy: Option<f64>, "REAL", "-", "F_yy, Eq. 8";
    fabric_xy: Option<f64>, "REAL", "-", "F_xy: mean of n_x n_y over the contacts";
    fabric_conductivity: Option<f64>, "REAL", "-", "(K_xx - K_yy)/(K_xx + K_yy), affine";
    conductivity_xx: Option<f64>, "REAL", "-", "K_xx / k, affine, Eq. 9";
    conductivity_yy: Option<f64>, "REAL", "-", "K_yy / k, affine, Eq. 9";
    conductivity_xy: Option<f64>, "REAL", "-", "K_xy / k, affine, Eq. 9";
    conductivity_network_xx: Option<f64>, "REAL", "-", "K_xx / k, resistor network solved";
    conductivity_network_yy: Option<f64>, "REAL", "-", "K_yy / k, resistor network solved";
    conductivity_network_xy: Option<f64>, "REAL", "-", "K_xy / k, resistor network solved";
    stress_xx: Option<f64>, "REAL", "Pa", "Love stress, Eq. 10, compression positive";
    stress_yy: Option<f64>, "REAL", "Pa", "Love stress, Eq. 10, compression positive";
    stress_xy: Option<f64>, "REAL", "Pa", "Love stress, branch x, force y";
    stress_yx: Option<f64>, "REAL", "Pa", "Love stress, branch y, force x";
    pressure: Option<f64>, "REAL", "Pa", "(stress_xx + stress_yy)/2, Eq. 11";
    stress_xx_reduced: Option<f64>, "REAL", "-", "stress_xx l / (E mean_radius), l = 1 m: free of grain size";
    stress_yy_reduced: Option<f64>, "REAL", "-", "stress_yy l / (E mean_radius), l = 1 m: free of grain size";
    stress_xx_over_young_modulus: Option<f64>, "REAL", "-", "the paper's scaling; grows with the grain size";
    stress_yy_over_young_modulus: Option<f64>, "REAL", "-", "the paper's scaling; grows with the grain size";
    coordination: Option<f64>, "REAL", "-", "contacts of a disc that has any, walls included, mean";
    rattlers: Option<u64>, "INTEGER", "-", "discs without contact, whole box";
    contacts: Option<u64>, "INTEGER", "-", "pair contacts in the region";
    mean_radius: Option<f64>, "REAL", "m", "mean disc radius, current";
}

/// Columns that files of schema 2 do not have; they are empty there.
const LATER: [&str; 7] = ["from_stop", "step_thermal", "step_xx", "step_yy", "step_xy", "probe", "fabric_xy"];

/// Copies averages into the columns of the same name.
macro_rules! copy {
    ($from:ident => $to:ident: $($name:ident)*) => {
        $($to.$name = Some($from.$name);)*
    };
}

/// The ramp and stop of a row, with the strains or slip there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub ramp: RampName,
    pub stop: i64,
    pub strains: Strains,
    /// Slip of bottom and top [m].
    pub slip: f64,
    /// Of a path: what leads to the stop.
    pub increment: Option<Increment>,
}

/// Results at one stop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct State {
    pub settled: Settled,
    pub averages: Averages,
    pub sliding: Option<Sliding>,
}

impl Record {
    /// The row of a state, or of the reason why the stop was not reached. `initial` has the averages of the packed
    /// state.
    pub(crate) fn new(
        job: &Job,
        material: &Material,
        place: Place,
        state: Result<&State, &str>,
        initial: Option<&Averages>,
    ) -> Self {
        let mut record = initial.map_or_else(Self::default, Self::from_initial);
        if let Ok(state) = state {
            record.set_averages(&state.averages, material.young_modulus);
            record.outcome = state.settled.outcome.to_string();
            record.steps = state.settled.steps;
            record.unbalanced = Some(state.settled.unbalanced);
            record.wall_friction = state.sliding.map(|sliding| sliding.friction);
            record.wall_slip_of_grains = state.sliding.map(|sliding| sliding.slip);
        }
        if let Err(reason) = state {
            record.outcome = FAILED.to_string();
            record.failure = Some(reason.to_string());
        }
        let step = place.increment.map(|increment| increment.step.parts());
        let [step_thermal, step_xx, step_yy, step_xy] = [0, 1, 2, 3].map(|k| step.map(|parts| parts[k]));
        Self {
            packing: job.packing,
            kind: job.kind,
            discs: job.spec.discs as u64,
            seed: job.spec.seed,
            compression: job.spec.compression,
            target_porosity: job.spec.porosity,
            packing_friction_angle: job.preparation.friction_angle.unwrap_or(material.friction_angle),
            ramp: place.ramp,
            stop: place.stop,
            strain: place.strains.thermal,
            strain_xx: place.strains.xx,
            strain_yy: place.strains.yy,
            strain_xy: place.strains.xy,
            from_stop: place.increment.map(|increment| increment.from_stop),
            step_thermal,
            step_xx,
            step_yy,
            step_xy,
            probe: place.increment.map(|increment| u64::from(increment.probe)),
            wall_slip: place.slip,
            region: match job.spec.boundary {
                Boundary::Walls => RegionKind::default(),
                Boundary::Periodic => RegionKind::Cell,
            }
            .to_string(),
            young_modulus: material.young_modulus,
            ..record
        }
    }

    fn from_initial(a: &Averages) -> Self {
        Self {
            initial_porosity: Some(a.porosity),
            initial_porosity_sum_of_areas: Some(a.porosity_sum_of_areas),
            initial_fabric_index: Some(a.fabric_index),
            initial_fabric_conductivity: Some(a.fabric_conductivity),
            initial_conductivity_xx: Some(a.conductivity_xx),
            initial_conductivity_yy: Some(a.conductivity_yy),
            initial_conductivity_network_xx: Some(a.conductivity_network_xx),
            initial_conductivity_network_yy: Some(a.conductivity_network_yy),
            initial_stress_xx: Some(a.stress_xx),
            initial_stress_yy: Some(a.stress_yy),
            initial_coordination: Some(a.coordination),
            initial_rattlers: Some(a.rattlers),
            ..Self::default()
        }
    }

    fn set_averages(&mut self, a: &Averages, young_modulus: f64) {
        copy!(a => self: porosity porosity_sum_of_areas overlap_fraction);
        copy!(a => self: fabric_index fabric_xx fabric_yy fabric_xy fabric_conductivity);
        copy!(a => self: conductivity_xx conductivity_yy conductivity_xy);
        copy!(a => self: conductivity_network_xx conductivity_network_yy conductivity_network_xy);
        copy!(a => self: stress_xx stress_yy stress_xy stress_yx pressure);
        copy!(a => self: coordination rattlers contacts mean_radius);
        let reduced = young_modulus * a.mean_radius;
        self.stress_xx_reduced = Some(a.stress_xx / reduced);
        self.stress_yy_reduced = Some(a.stress_yy / reduced);
        self.stress_xx_over_young_modulus = Some(a.stress_xx / young_modulus);
        self.stress_yy_over_young_modulus = Some(a.stress_yy / young_modulus);
    }

    /// Of a path: the increment that leads to the state; none in other rows.
    pub fn increment(&self) -> Option<Increment> {
        let step =
            Strains { thermal: self.step_thermal?, xx: self.step_xx?, yy: self.step_yy?, xy: self.step_xy? };
        Some(Increment { from_stop: self.from_stop?, step, probe: self.probe? != 0 })
    }

    /// Strains relative to the packed state.
    pub fn strains(&self) -> Strains {
        Strains { thermal: self.strain, xx: self.strain_xx, yy: self.strain_yy, xy: self.strain_xy }
    }
}

/// [`Record::outcome`] of a stop that was not reached.
pub const FAILED: &str = "failed";
