//! One row of the database of spheres: one state of one packing.

use super::kind::{PathName, SphereCompression};
use super::paths::{Increment, Planned};
use super::plan::SphereJob;
use crate::Settled;
use crate::database::record::FAILED;
use crate::database::table::row;
use crate::spheres::{Averages, Strain, Tensor};

#[rustfmt::skip]
row! {
    /// One state of one packing of spheres. Lengths are in diameters, stresses over E*. Averages are absent when the state
    /// was not reached. Meaning and unit of each field are those of [`COLUMNS`].
    SphereRecord, "spheres 2", ["shaking"], path: PathName;
    packing: i64, "INTEGER", "-", "index of the packing in the plan";
    spheres: u64, "INTEGER", "-", "spheres in the packing";
    seed: u64, "INTEGER", "-", "seed of the packing";
    compression: SphereCompression, "TEXT", "-", "isotropic: the box closed along all axes alike; uniaxial: along z only; sheared: along z, while it opened along x and y, each a quarter as fast";
    packing_friction: f64, "REAL", "-", "friction while the box closed";
    shaking: Option<f64>, "REAL", "-", "how far the packed box was opened along all axes to be shaken and pressed again, with the friction of afterwards; absent when it was not";
    friction: f64, "REAL", "-", "friction afterwards";
    packing_pressure: f64, "REAL", "-", "pressure over E* requested for the packed state; it has this within 5 %, or more where a box loses its load on the way to so little";
    path: PathName, "TEXT", "-", "packed: before any strain; others: paths of strain";
    stop: i64, "INTEGER", "-", "running number on the path, from 1; 0 is the packed state";
    strain: f64, "REAL", "-", "radial thermal strain relative to the packed state, growth positive";
    strain_xx: f64, "REAL", "-", "extension of the box along x relative to the packed state, extension positive";
    strain_yy: f64, "REAL", "-", "extension of the box along y relative to the packed state, extension positive";
    strain_zz: f64, "REAL", "-", "extension of the box along z relative to the packed state, extension positive";
    strain_xy: f64, "REAL", "-", "shear of the box relative to the packed state: displacement along x over the distance along y";
    strain_xz: f64, "REAL", "-", "shear of the box relative to the packed state: displacement along x over the distance along z";
    strain_yz: f64, "REAL", "-", "shear of the box relative to the packed state: displacement along y over the distance along z";
    from_stop: Option<i64>, "INTEGER", "-", "stop of the same path from whose state the increment starts; 0 is the packed state";
    turned: Option<u64>, "INTEGER", "-", "1: the increment was made in a box with other names of its axes (x is y, y is z, z is x), and the averages were turned back; 0: it was not";
    step_thermal: Option<f64>, "REAL", "-", "increment of the radii relative to the state at from_stop, growth positive";
    step_xx: Option<f64>, "REAL", "-", "increment of the box along x relative to the state at from_stop, extension positive";
    step_yy: Option<f64>, "REAL", "-", "increment of the box along y relative to the state at from_stop, extension positive";
    step_zz: Option<f64>, "REAL", "-", "increment of the box along z relative to the state at from_stop, extension positive";
    step_xy: Option<f64>, "REAL", "-", "increment of the shear relative to the state at from_stop: displacement along x over the distance along y";
    step_xz: Option<f64>, "REAL", "-", "increment of the shear relative to the state at from_stop: displacement along x over the distance along z";
    step_yz: Option<f64>, "REAL", "-", "increment of the shear relative to the state at from_stop: displacement along y over the distance along z";
    outcome: String, "TEXT", "-", "settled; capped: step cap before balance; unjammed: carries no load; failed: see failure";
    failure: Option<String>, "TEXT", "-", "why the stop was not reached; absent when it was";
    steps: u64, "INTEGER", "-", "time steps from the previous stop";
    unbalanced: Option<f64>, "REAL", "-", "mean resultant force over mean contact force";
    solid_fraction: Option<f64>, "REAL", "-", "volume of the spheres over the volume of the box, overlaps counted twice";
    coordination: Option<f64>, "REAL", "-", "contacts per sphere, all spheres counted";
    backbone_coordination: Option<f64>, "REAL", "-", "contacts per sphere without rattlers and their contacts";
    rattlers: Option<f64>, "REAL", "-", "part of the spheres that are rattlers: fewer than 2 contacts (4 without friction)";
    neighbours: Option<f64>, "REAL", "-", "spheres nearer than 1.18 diameters, per sphere";
    pressure: Option<f64>, "REAL", "-", "(stress_xx + stress_yy + stress_zz)/3";
    stress_xx: Option<f64>, "REAL", "-", "xx component of Love's stress over E*, symmetric part, compression positive";
    stress_yy: Option<f64>, "REAL", "-", "yy component of Love's stress over E*, symmetric part, compression positive";
    stress_zz: Option<f64>, "REAL", "-", "zz component of Love's stress over E*, symmetric part, compression positive";
    stress_xy: Option<f64>, "REAL", "-", "xy component of Love's stress over E*, symmetric part, compression positive";
    stress_xz: Option<f64>, "REAL", "-", "xz component of Love's stress over E*, symmetric part, compression positive";
    stress_yz: Option<f64>, "REAL", "-", "yz component of Love's stress over E*, symmetric part, compression positive";
    fabric_xx: Option<f64>, "REAL", "-", "mean of n_x n_x over the contacts";
    fabric_yy: Option<f64>, "REAL", "-", "mean of n_y n_y over the contacts";
    fabric_zz: Option<f64>, "REAL", "-", "mean of n_z n_z over the contacts";
    fabric_xy: Option<f64>, "REAL", "-", "mean of n_x n_y over the contacts";
    fabric_xz: Option<f64>, "REAL", "-", "mean of n_x n_z over the contacts";
    fabric_yz: Option<f64>, "REAL", "-", "mean of n_y n_z over the contacts";
    contact_conductivity_xx: Option<f64>, "REAL", "-", "xx component of the conductivity by contacts over k of the solid, network solved, at the contacts' size under stress and E*";
    contact_conductivity_yy: Option<f64>, "REAL", "-", "yy component of the conductivity by contacts over k of the solid, network solved, at the contacts' size under stress and E*";
    contact_conductivity_zz: Option<f64>, "REAL", "-", "zz component of the conductivity by contacts over k of the solid, network solved, at the contacts' size under stress and E*";
    contact_conductivity_xy: Option<f64>, "REAL", "-", "xy component of the conductivity by contacts over k of the solid, network solved, at the contacts' size under stress and E*";
    contact_conductivity_xz: Option<f64>, "REAL", "-", "xz component of the conductivity by contacts over k of the solid, network solved, at the contacts' size under stress and E*";
    contact_conductivity_yz: Option<f64>, "REAL", "-", "yz component of the conductivity by contacts over k of the solid, network solved, at the contacts' size under stress and E*";
    gas_conductivity_3_5: Option<f64>, "REAL", "-", "conductivity by the gas over k of the gas, network solved, mean of xx, yy, zz, at the number ln(R/h) = 3.5 of the gas";
    gas_conductivity_6_0: Option<f64>, "REAL", "-", "conductivity by the gas over k of the gas, network solved, mean of xx, yy, zz, at the number ln(R/h) = 6 of the gas";
    gas_conductivity_8_5: Option<f64>, "REAL", "-", "conductivity by the gas over k of the gas, network solved, mean of xx, yy, zz, at the number ln(R/h) = 8.5 of the gas";
}

/// Functions that set and give the six columns of a tensor.
macro_rules! tensors {
    ($($set:ident $get:ident: $($part:ident)*;)*) => {
        impl SphereRecord {$(
            fn $set(&mut self, tensor: Tensor) {
                [$(self.$part),*] = tensor.map(Some);
            }

            fn $get(&self) -> Option<Tensor> {
                Some([$(self.$part?),*])
            }
        )*}
    };
}

tensors! {
    set_step step: step_xx step_yy step_zz step_xy step_xz step_yz;
    set_stress stress: stress_xx stress_yy stress_zz stress_xy stress_xz stress_yz;
    set_fabric fabric: fabric_xx fabric_yy fabric_zz fabric_xy fabric_xz fabric_yz;
    set_contact_conductivity contact_conductivity:
        contact_conductivity_xx contact_conductivity_yy contact_conductivity_zz
        contact_conductivity_xy contact_conductivity_xz contact_conductivity_yz;
}

impl SphereRecord {
    /// The packed state, not reached yet.
    fn of(job: &SphereJob) -> Self {
        let preparation = &job.preparation;
        Self {
            packing: job.packing,
            spheres: preparation.spheres as u64,
            seed: preparation.seed,
            compression: job.compression,
            packing_friction: preparation.packing_friction,
            shaking: (preparation.shaking > 0.0).then_some(preparation.shaking),
            friction: preparation.friction,
            packing_pressure: preparation.pressure,
            ..Self::default()
        }
    }

    /// The row of the packed state, or of the reason why it was not reached.
    pub(super) fn packed(job: &SphereJob, state: Result<&(Settled, Averages), &str>) -> Self {
        let mut record = Self::of(job);
        record.set_state(state);
        record
    }

    /// The row of a state on a path, or of the reason why it was not reached.
    pub(super) fn on_path(
        job: &SphereJob,
        path: PathName,
        planned: &Planned,
        state: Result<&(Settled, Averages), &str>,
    ) -> Self {
        let Planned { stop, increment: Increment { from_stop, step, turned }, strain, .. } = *planned;
        let mut record = Self { path, stop, strain: strain.thermal, ..Self::of(job) };
        let r = &mut record;
        [r.strain_xx, r.strain_yy, r.strain_zz, r.strain_xy, r.strain_xz, r.strain_yz] = strain.stretch;
        record.from_stop = Some(from_stop);
        record.turned = Some(u64::from(turned));
        record.step_thermal = Some(step.thermal);
        record.set_step(step.stretch);
        record.set_state(state);
        record
    }

    fn set_state(&mut self, state: Result<&(Settled, Averages), &str>) {
        match state {
            Ok((rest, averages)) => {
                self.outcome = rest.outcome.to_string();
                self.steps = rest.steps;
                self.unbalanced = Some(rest.unbalanced);
                self.set_averages(averages);
            }
            Err(reason) => {
                self.outcome = FAILED.to_string();
                self.failure = Some(reason.to_string());
            }
        }
    }

    fn set_averages(&mut self, a: &Averages) {
        self.solid_fraction = Some(a.solid_fraction);
        self.coordination = Some(a.coordination);
        self.backbone_coordination = Some(a.backbone_coordination);
        self.rattlers = Some(a.rattlers);
        self.neighbours = Some(a.neighbours);
        self.pressure = Some(a.pressure());
        self.set_stress(a.stress);
        self.set_fabric(a.fabric);
        self.set_contact_conductivity(a.contact_conductivity);
        [self.gas_conductivity_3_5, self.gas_conductivity_6_0, self.gas_conductivity_8_5] =
            a.gas_conductivity.map(Some);
    }

    /// Of a path: the increment that leads to the state; none of the packed state.
    pub fn increment(&self) -> Option<Increment> {
        let step = Strain { thermal: self.step_thermal?, stretch: self.step()? };
        Some(Increment { from_stop: self.from_stop?, step, turned: self.turned? != 0 })
    }

    /// Strain relative to the packed state.
    pub fn strain(&self) -> Strain {
        let stretch =
            [self.strain_xx, self.strain_yy, self.strain_zz, self.strain_xy, self.strain_xz, self.strain_yz];
        Strain { thermal: self.strain, stretch }
    }

    /// The averages; none when the state was not reached.
    pub fn averages(&self) -> Option<Averages> {
        Some(Averages {
            solid_fraction: self.solid_fraction?,
            coordination: self.coordination?,
            backbone_coordination: self.backbone_coordination?,
            rattlers: self.rattlers?,
            neighbours: self.neighbours?,
            fabric: self.fabric()?,
            stress: self.stress()?,
            contact_conductivity: self.contact_conductivity()?,
            gas_conductivity: [
                self.gas_conductivity_3_5?,
                self.gas_conductivity_6_0?,
                self.gas_conductivity_8_5?,
            ],
        })
    }
}
