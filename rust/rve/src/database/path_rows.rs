//! Follows a path of strain: one increment after the other, and probes on copies of the box.

use super::kind::RampName;
use super::paths::{Increment, Planned};
use super::record::{Place, State};
use crate::{Outcome, Packed, Protocol, Relaxation, Settled, Simulation, follow};

/// The place of a planned row.
pub(super) fn place(ramp: RampName, planned: Planned) -> Place {
    let Planned { stop, increment, strains } = planned;
    Place { ramp, stop, strains, slip: 0.0, increment: Some(increment) }
}

/// The states at the places of one path, or why they were not reached. A path ends where a failure happens or where the
/// box carries no load any more.
pub(super) fn follow_all(
    packed: &Packed,
    relaxation: Relaxation,
    places: &[Place],
) -> Vec<Result<State, String>> {
    let start = goes_on(packed.simulation.clone(), packed.settled, 0);
    let mut here = start.clone();
    let mut results = Vec::new();
    for place in places {
        let Some(increment) = place.increment else {
            results.push(Err("no increment leads here".to_string()));
            continue;
        };
        let from = if increment.from_stop == 0 { &start } else { &here };
        let reached = from.clone().and_then(|simulation| step(simulation, increment, relaxation));
        let (result, next) = match reached {
            Ok((state, simulation)) => (Ok(state), goes_on(simulation, state.settled, place.stop)),
            Err(reason) => (Err(reason.clone()), Err(reason)),
        };
        results.push(result);
        if !increment.probe {
            here = next;
        }
    }
    results
}

/// The box from which the path goes on; or why it ends here.
pub(super) fn goes_on<S>(simulation: S, settled: Settled, stop: i64) -> Result<S, String> {
    match settled.outcome {
        Outcome::Unjammed => Err(format!("the path ended at stop {stop}, without load")),
        Outcome::Settled | Outcome::Capped => Ok(simulation),
    }
}

/// Applies one increment to the box, at the usual rates for its present state, and lets it come to rest.
fn step(
    mut simulation: Simulation,
    increment: Increment,
    relaxation: Relaxation,
) -> Result<(State, Simulation), String> {
    let protocol = Protocol { relaxation, ..Protocol::usual(&simulation) };
    let ramp = follow(&mut simulation, &[increment.step], protocol, |_, _| ());
    let ramp = ramp.map_err(|error| error.to_string())?;
    match (ramp.failure, ramp.stops.first()) {
        (None, Some(stop)) => {
            let state = State { settled: stop.settled, averages: stop.averages, sliding: None };
            Ok((state, simulation))
        }
        (failure, _) => Err(failure.map_or_else(|| "not reached".to_string(), |error| error.to_string())),
    }
}
