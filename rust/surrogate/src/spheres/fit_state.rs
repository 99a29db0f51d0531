//! Fit of what depends on the state of the law: usual fabric, number of contacts, conductivities.

use super::contacts::{COEFFICIENTS, Contacts, MAX_SURPLUS, row};
use super::law::Law;
use super::readout::{Readout, contact_row, directions, gas_row, relative};
use super::state::{FABRIC, State};
use super::tensor::{contraction, deviator, mean};
use super::tracks::{Point, Track};
use crate::least_squares;

/// Least p/E* of states to which is fitted, less than that of a bed under its own weight.
const MIN_PRESSURE: f64 = 3e-9;
/// Numbers of [`Contacts::fading`] that are tried.
const OF_COMPRESSION: [f64; 6] = [0.0, 0.2, 0.3, 0.4, 0.5, 0.7];
const OF_SHEAR: [f64; 7] = [0.2, 0.4, 0.5, 0.6, 0.8, 1.2, 2.0];

/// The fabric's usual part of the stress ratio: that of the packings before any strain, by least squares.
pub fn usual_fabric(law: &Law, tracks: &[Track]) -> f64 {
    let (mut both, mut square) = (0.0, 0.0);
    for state in tracks.iter().map(|track| track.packed.state(law)) {
        let ratio = state.ratio();
        both += contraction(&ratio, &state.ratios[FABRIC]);
        square += contraction(&ratio, &ratio);
    }
    if square > 0.0 { (both / square).clamp(0.0, 1.0) } else { 0.0 }
}

/// The number of contacts along tracks whose packings have a known number, with the hidden state that the law has for stress and solid
/// fraction of the data.
pub fn contacts(law: &Law, tracks: &[Track]) -> Contacts {
    let states_of = |track: &Track| (0..=track.steps.len()).map(|k| track.point(k).state(law)).collect();
    let tracks: Vec<(&Track, Vec<State>)> = tracks.iter().map(|track| (track, states_of(track))).collect();
    let all = OF_COMPRESSION.into_iter().flat_map(|a| OF_SHEAR.map(|b| [a, b]));
    let found = all.map(|fading| contacts_that_fade(&tracks, fading));
    let best = found.reduce(|best, other| if other.1 < best.1 { other } else { best });
    best.map_or(law.contacts, |(contacts, _)| contacts)
}

fn contacts_that_fade(tracks: &[(&Track, Vec<State>)], fading: [f64; 2]) -> (Contacts, f64) {
    const NUMBERS: usize = COEFFICIENTS + 1;
    let mut contacts = Contacts { sheared: [0.0; COEFFICIENTS], surplus: 0.0, fading };
    let mut samples: Vec<([f64; NUMBERS], f64, f64)> = Vec::new();
    for (track, states) in tracks {
        let first = row(&states[0]);
        // Of each state: what is left of z − z̄ of the packing, and what has come since, over S.
        let mut all = vec![[1.0, 0.0]];
        for (step, to) in track.steps.iter().zip(&states[1..]) {
            let [xx, yy, zz, xy, xz, yz] = step.stretch;
            let strain = [xx, yy, zz, 0.5 * xy, 0.5 * xz, 0.5 * yz];
            let from = &states[step.from];
            let [left, more] = contacts.shares([from, to], contacts.usual(from).forgets, &strain);
            let [of_packing, since] = all[step.from];
            let [left, more] = [left * of_packing, left * since + more];
            all.push([left, more]);
            if mean(step.to.stress) < MIN_PRESSURE || to.compression <= 0.0 {
                continue;
            }
            let row = row(to);
            let numbers = std::array::from_fn(|k| match k {
                COEFFICIENTS => more,
                _ => row[k] - left * first[k],
            });
            samples.push((numbers, step.to.coordination - left * track.packed.coordination, track.weight));
        }
    }
    let found = least_squares::fit(samples.iter().copied());
    let error = |(numbers, z, weight): &([f64; NUMBERS], f64, f64)| {
        let sum: f64 = numbers.iter().zip(&found).map(|(a, b)| a * b).sum();
        weight * (sum - z) * (sum - z)
    };
    contacts.sheared = std::array::from_fn(|k| found[k]);
    contacts.surplus = found[COEFFICIENTS].clamp(0.0, MAX_SURPLUS);
    (contacts, samples.iter().map(error).sum())
}

/// Fits the conductivities to the states of the data with the hidden state that the law has there: its compression is that which
/// carries the pressure of the data.
pub fn readout(law: &Law, tracks: &[Track]) -> Readout {
    let mut all: Vec<(State, &Point, f64)> = Vec::new();
    for track in tracks {
        for k in 0..=track.steps.len() {
            let point = track.point(k);
            if mean(point.stress) >= MIN_PRESSURE {
                all.push((point.state(law), point, track.weight.sqrt()));
            }
        }
    }
    let direction =
        all.iter().filter(|(_, point, _)| mean(point.contact) > 0.0).flat_map(|(state, point, _)| {
            let (part, size) = (deviator(point.contact), mean(point.contact));
            let [elastic, fabric] = directions(state);
            (0..6).map(move |k| ([elastic[k], fabric[k]], part[k] / size, if k < 3 { 1.0 } else { 2.0 }))
        });
    let direction = least_squares::fit(direction);
    let contact = all.iter().filter_map(|(state, point, weight)| {
        // What is known of the conductivity, over the same of its mean.
        let known = point.compared(&point.contact) / point.compared(&relative(&direction, state));
        let size = known / libm::cbrt(mean(point.stress));
        (size > 0.0).then(|| (contact_row(&law.contacts, state).map(|x| x / size), 1.0, *weight))
    });
    let contact = least_squares::fit(contact);
    let gas = |number: usize| {
        let known = all.iter().filter(move |(_, point, _)| point.gas[number] > 0.0);
        least_squares::fit(
            known.map(move |(state, point, _)| (gas_row(state).map(|x| x / point.gas[number]), 1.0, 1.0)),
        )
    };
    let mut readout = Readout { contact, direction, gas: [gas(0), gas(1), gas(2)], gas_direction: 0.0 };
    let along = all.iter().filter(|(_, point, _)| point.gas_along[1] > 0.0).map(|(state, point, _)| {
        let missing = -point.gas_error(&readout, state);
        // Over what is known, as the error is.
        let mean = readout.gas(state, point.gas_along[0]) / point.gas_along[1];
        ([mean * state.ratios[FABRIC][2]], missing, 1.0)
    });
    [readout.gas_direction] = least_squares::fit(along);
    readout
}
