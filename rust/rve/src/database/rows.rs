//! The rows of one packing: every stop of every ramp of its job.

use super::kind::{Kind, RampName};
use super::path_rows;
use super::plan::{Job, Plan};
use super::record::{Place, Record, State};
use crate::slide::{Sliding, at_rest};
use crate::{
    Averages, Packed, Protocol, Ramp, RegionKind, RveError, Simulation, Stop, Strains, follow, homogenise,
    pack_as, slide, stopwatch,
};
use msdd_dem::Side;
use std::collections::BTreeMap;

/// Makes a packing and takes it through its ramps. A stop that was not reached has a row, too, with the reason.
pub(super) fn rows(plan: &Plan, job: &Job) -> Vec<Record> {
    let material = &plan.material;
    let packed = match pack_as(&job.spec, &job.preparation, material) {
        Ok(packed) => packed,
        Err(error) => return unreached(plan, job, &format!("packing: {error}")),
    };
    let averages = stopwatch::time(stopwatch::Stage::Averaging, || {
        homogenise(&packed.simulation, RegionKind::default())
    });
    let shear = (job.kind == Kind::WallShear).then(|| at_rest(&packed.simulation));
    let state = State { settled: packed.settled, averages, sliding: shear };
    let mut walk = Walk { plan, job, packed: &packed, initial: &averages, ends: BTreeMap::new() };
    let start = place(RampName::Packed, (0, 0.0));
    let mut records = vec![Record::new(job, material, start, Ok(&state), Some(&averages))];
    for &ramp in &job.ramps {
        records.extend(walk.ramp(ramp));
    }
    records
}

fn unreached(plan: &Plan, job: &Job, reason: &str) -> Vec<Record> {
    let ramps = std::iter::once(RampName::Packed).chain(job.ramps.iter().copied());
    let places = ramps.flat_map(|ramp| places(job, ramp));
    places.map(|place| Record::new(job, &plan.material, place, Err(reason), None)).collect()
}

/// The places of a ramp or path, in the order in which they are reached.
fn places(job: &Job, ramp: RampName) -> Vec<Place> {
    match ramp.is_path() {
        true => job.path(ramp).into_iter().map(|planned| path_rows::place(ramp, planned)).collect(),
        false => job.stops_of(ramp).into_iter().map(|stop| place(ramp, stop)).collect(),
    }
}

/// The place of a stop of a ramp: `value` as the strain or slip that the ramp varies.
fn place(ramp: RampName, (stop, value): (i64, f64)) -> Place {
    let mut place = Place { ramp, stop, strains: Strains::default(), slip: 0.0, increment: None };
    match ramp {
        RampName::Up | RampName::Down | RampName::UpDown | RampName::DownUp => place.strains.thermal = value,
        RampName::Xx => place.strains.xx = value,
        RampName::Yy => place.strains.yy = value,
        RampName::Xy => place.strains.xy = value,
        RampName::WallShear => place.slip = value,
        // The packed state; and the paths, whose strains follow from their increments.
        _ => (),
    }
    place
}

/// The ramps of one packing.
struct Walk<'a> {
    plan: &'a Plan,
    job: &'a Job,
    packed: &'a Packed,
    initial: &'a Averages,
    /// Final states of the ramps from which other ramps start; or why a ramp did not reach its end.
    ends: BTreeMap<RampName, Result<Simulation, String>>,
}

impl Walk<'_> {
    fn protocol(&self) -> Protocol {
        Protocol { relaxation: self.plan.relaxation, ..Protocol::usual(&self.packed.simulation) }
    }

    fn ramp(&mut self, ramp: RampName) -> Vec<Record> {
        let stops = places(self.job, ramp);
        match self.job.kind {
            Kind::Thermal => self.thermal(ramp, &stops),
            Kind::Mechanics => {
                // Closing and opening each start from the packed state, and so do the two directions of shear.
                let (closing, opening) = stops.split_at(stops.partition_point(|place| place.stop < 0));
                [closing, opening].into_iter().flat_map(|branch| self.strain(branch)).collect()
            }
            Kind::WallShear => self.slide(&stops),
            Kind::Paths => self.path(&stops),
        }
    }

    fn thermal(&mut self, ramp: RampName, stops: &[Place]) -> Vec<Record> {
        let (mut simulation, turn) = match ramp.starts_from() {
            None => (self.packed.simulation.clone(), 0.0),
            Some(first) => match self.ends.remove(&first) {
                Some(Ok(end)) => {
                    let turn = self.job.stops_of(first).last().map_or(0.0, |&(_, strain)| strain);
                    (end, turn)
                }
                Some(Err(reason)) => return self.failed(stops, &format!("{first}: {reason}")),
                None => return self.failed(stops, &format!("{first} was not made")),
            },
        };
        // The strains of the path count from the state where it starts.
        let strain = |place: &Place| match ramp.starts_from() {
            None => place.strains,
            Some(_) => Strains::thermal((1.0 + place.strains.thermal) / (1.0 + turn) - 1.0),
        };
        let path: Vec<Strains> = stops.iter().map(strain).collect();
        let result = follow(&mut simulation, &path, self.protocol(), |_, _| ());
        let records = self.records(stops, &result, &[]);
        let goes_on = self.job.ramps.iter().any(|next| next.starts_from() == Some(ramp));
        if goes_on {
            let failure = result.map_or_else(Some, |ramp| ramp.failure);
            let end = failure.map_or(Ok(simulation), |failure| Err(failure.to_string()));
            self.ends.insert(ramp, end);
        }
        records
    }

    fn strain(&self, stops: &[Place]) -> Vec<Record> {
        let path: Vec<Strains> = stops.iter().map(|place| place.strains).collect();
        let mut simulation = self.packed.simulation.clone();
        self.records(stops, &follow(&mut simulation, &path, self.protocol(), |_, _| ()), &[])
    }

    fn path(&self, stops: &[Place]) -> Vec<Record> {
        let results = path_rows::follow_all(self.packed, self.plan.relaxation, stops);
        let row = |(place, result): (&Place, Result<State, String>)| {
            let state = result.as_ref().map_err(String::as_str);
            Record::new(self.job, &self.plan.material, *place, state, Some(self.initial))
        };
        stops.iter().zip(results).map(row).collect()
    }

    fn slide(&self, stops: &[Place]) -> Vec<Record> {
        let slips: Vec<f64> = stops.iter().map(|place| place.slip).collect();
        let mut met = Vec::new();
        let mut simulation = self.packed.simulation.clone();
        if self.job.release_walls {
            simulation.release_friction(Side::Bottom);
            simulation.release_friction(Side::Top);
        }
        let ramp = slide(&mut simulation, &slips, self.plan.relaxation, |_, sliding| met.push(sliding));
        self.records(stops, &ramp, &met)
    }

    /// One row per stop: the states reached, then for each further stop the failure that ended the ramp.
    fn records(&self, stops: &[Place], ramp: &Result<Ramp, RveError>, met: &[Sliding]) -> Vec<Record> {
        let (reached, failure): (&[Stop], Option<&RveError>) = match ramp {
            Ok(ramp) => (&ramp.stops, ramp.failure.as_ref()),
            Err(error) => (&[], Some(error)),
        };
        let row = |(k, (place, stop)): (usize, (&Place, &Stop))| {
            let state =
                State { settled: stop.settled, averages: stop.averages, sliding: met.get(k).copied() };
            Record::new(self.job, &self.plan.material, *place, Ok(&state), Some(self.initial))
        };
        let mut records: Vec<Record> = stops.iter().zip(reached).enumerate().map(row).collect();
        let reason = failure.map_or_else(|| "not reached".to_string(), ToString::to_string);
        records.extend(self.failed(&stops[reached.len()..], &reason));
        records
    }

    fn failed(&self, stops: &[Place], reason: &str) -> Vec<Record> {
        let row = |place: &Place| {
            Record::new(self.job, &self.plan.material, *place, Err(reason), Some(self.initial))
        };
        stops.iter().map(row).collect()
    }
}
