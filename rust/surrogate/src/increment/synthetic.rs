//! A law like the shipped one, and paths that follow it, for tests only.

use super::core::{COMPRESSION, Core, FABRIC_INDEX, FABRIC_SHEAR, JAMMING, POROSITY, SHEAR, STRENGTH};
use super::law::{Element, Law};
use super::readout::{Conductivity, Readout};
use super::start::start;
use crate::dataset::ConductivityKind;
use crate::kernel::LANES;
use crate::surrogate::{Answer, Increment, MAX_STATE};
use crate::tracks::{Point, Step, Track};

/// A law like the shipped one.
pub fn core() -> Core {
    let element = |share, strength, dilatancy| Element { share, strength, dilatancy };
    Core {
        law: Law {
            bulk: [0.484, 0.533, 0.052],
            looseness: [-5.0, 0.0, 0.0],
            onset: 5e-4,
            shear: [0.357, 0.0162, 0.15],
            elements: [element(0.6, 0.05, -0.034), element(0.4, 0.245, -0.196)],
            dilatancy_of_looseness: 7.68,
            opening_densification: 0.05,
        },
        readout: Readout { overlap: [0.045, 1.85, -0.6, 0.5, 1.2], fabric: [0.15, 1.0, -0.7, -2.0] },
        ranges: [super::core::ANY; super::core::COLUMNS + 1],
        conductivity: Conductivity {
            kind: ConductivityKind::Network,
            mean: [1.3, 0.5, -0.5, -0.5, 0.0, -4.0, 3.0, 0.0, 0.0, 0.0, 0.0],
            direction: [0.335, 0.0, 1.0],
        },
    }
}

/// The state of a packing with this porosity, pressure and ratio of deviator to pressure.
pub fn packed(core: &Core, porosity: f64, pressure: f64, ratio: [f64; 2]) -> [f64; MAX_STATE] {
    let found = start(&core.law, &core.readout, porosity, pressure, ratio.map(|r| r * pressure));
    let mut state = [0.0; MAX_STATE];
    state[POROSITY] = porosity;
    [state[FABRIC_INDEX], state[FABRIC_SHEAR]] = ratio.map(|r| 0.1 * r);
    (state[JAMMING], state[COMPRESSION]) = (found.jamming, found.compression);
    state[SHEAR..STRENGTH].copy_from_slice(found.shear.as_flattened());
    state[STRENGTH] = found.strength;
    state
}

/// The state after thermal, xx, yy and xy, and what a simulation would show of it.
fn strained(core: &Core, state: &[f64; MAX_STATE], strain: [f64; 4]) -> ([f64; MAX_STATE], Point) {
    let [thermal, xx, yy, xy] = strain.map(|value| [value; LANES]);
    let increment = Increment { thermal, xx, yy, xy, rotation: xy.map(|xy| -0.5 * xy) };
    let mut answer = Answer::default();
    core.advance(&state.map(|value| [value; LANES]), &increment, &mut answer, None);
    let state = answer.state.map(|column| column[0]);
    let conductivity = answer.conductivity.map(|column| column[0]);
    let point = Point {
        porosity: state[POROSITY],
        solid: state[JAMMING] * (1.0 + state[COMPRESSION]),
        stress: answer.stress.map(|column| column[0]),
        affine: conductivity.map(|k| 1.1 * k),
        network: Some(conductivity),
        fabric_index: state[FABRIC_INDEX],
        fabric_shear: Some(state[FABRIC_SHEAR]),
        load_bearing: true,
    };
    (state, point)
}

/// Paths of `packings` packings, `stops` steps each: growth of the grains, their contraction, a shear, and a compression along x.
pub fn tracks(packings: i64, stops: usize) -> Vec<Track> {
    let core = core();
    let mut all = Vec::new();
    for packing in 0..packings {
        let share = (packing as f64 + 0.5) / packings as f64;
        let (porosity, angle) = (0.08 + 0.1 * share, 2.4 * packing as f64);
        let ratio = [0.2 * angle.sin(), 0.1 * angle.cos()];
        let start = packed(&core, porosity, 0.1 * (0.2 - porosity) / 0.12, ratio);
        for (name, strain) in [
            ("up", [2e-3, 0.0, 0.0, 0.0]),
            ("down", [-5e-4, 0.0, 0.0, 0.0]),
            ("shear", [0.0, 0.0, 0.0, 4e-3]),
            ("compression", [0.0, -3e-3, 0.0, 0.0]),
        ] {
            let (mut state, point) = strained(&core, &start, [0.0; 4]);
            let mut track =
                Track { packing, name: name.to_string(), discs: 500, packed: point, steps: Vec::new() };
            for from in 0..stops {
                let (next, to) = strained(&core, &state, strain);
                track.steps.push(Step { from, strain, to, probe: false });
                state = next;
            }
            all.push(track);
        }
    }
    all
}
