//! The state of a packing whose porosity, fabric and stress are known.

use super::law::{ELEMENTS, Elastic, Law};
use super::readout::{Features, Readout};
use crate::kernel::vector::{Arithmetic, Portable};

/// The elastic state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticState {
    pub jamming: f64,
    pub compression: f64,
    pub shear: [[f64; 2]; ELEMENTS],
    pub strength: f64,
}

/// Largest number of trials for v; about ten are enough.
const TRIALS: usize = 100;
/// Relative error of p̃ that is rounding.
const ROUNDING: f64 = 1e-14;
/// Largest number of rounds in which φ_s and v, which depend on each other by the overlaps, are found.
const ROUNDS: usize = 20;
/// Largest factor of the strengths: grains that carry twice as much are not known.
const MAX_STRENGTH: f64 = 2.0;
/// Far below all pressures, and such that no quotient overflows.
const MIN_PRESSURE: f64 = 1e-100;
/// Largest v that is looked for.
const LARGEST: f64 = 0.6;

/// Relative difference up to which a pressure counts as the known one.
const NEAR: f64 = 0.01;

type Cell = Portable;

fn cell(value: f64) -> Cell {
    Portable::all(value)
}

fn number(cell: Cell) -> f64 {
    cell.into_first()
}

/// The state with porosity η, pressure p̃ and deviator (q̃₁, q̃₂).
pub fn start(law: &Law, readout: &Readout, porosity: f64, pressure: f64, deviator: [f64; 2]) -> ElasticState {
    let mut solid = 1.0 - porosity;
    for _ in 0..ROUNDS {
        let (state, stress) = loaded(law, solid, pressure, deviator);
        // In the first rounds the solid fraction may be one with which no compression has this pressure.
        let near = (number(stress[0]) - pressure).abs() <= NEAR * pressure || pressure <= 0.0;
        let known = [pressure, deviator[0], deviator[1]].map(cell);
        let features = Features::of(if near { &stress } else { &known }, state.looseness());
        // Overlaps that no packing has are limited, because the rounds would diverge.
        let found = 1.0 - porosity + number(readout.overlap(&features)).clamp(0.0, 1.0);
        let change = (found - solid).abs();
        solid = found;
        if change < ROUNDING {
            break;
        }
    }
    start_of_solid(law, solid, pressure, deviator)
}

/// The state with the solid fraction φ_s, pressure p̃ and deviator (q̃₁, q̃₂). The elements share the deviator as after a
/// proportional load from zero: each carries its part of the shear strain until it slides. A packing that carries a deviator larger
/// than all strengths has larger strengths, by a common factor.
pub fn start_of_solid(law: &Law, solid: f64, pressure: f64, deviator: [f64; 2]) -> ElasticState {
    let (state, _) = loaded(law, solid, pressure, deviator);
    ElasticState {
        jamming: number(state.jamming),
        compression: number(state.compression),
        shear: state.shear.map(|shear| shear.map(number)),
        strength: number(state.strength),
    }
}

fn loaded(law: &Law, solid: f64, pressure: f64, deviator: [f64; 2]) -> (Elastic<Cell>, [Cell; 3]) {
    let size = deviator[0].hypot(deviator[1]);
    // Denominators are never 0, not even where the quotient is not used: compilers divide in advance, and callers may trap
    // floating-point exceptions.
    let direction = deviator.map(|q| q / size.max(f64::MIN_POSITIVE));
    let beyond = |v: f64| number(at(law, solid, v, size, direction).1[0]) - pressure;
    let compression = if pressure > 0.0 { least_compression(beyond, ROUNDING * pressure) } else { 0.0 };
    at(law, solid, compression, size, direction)
}

/// The compression up to which the pressure is `low`. In a law that softens with looseness the pressure falls again at large
/// compressions, since a packing of the same solid fraction is then looser without stress: the least one counts.
fn least_compression(beyond: impl Fn(f64) -> f64, error: f64) -> f64 {
    if beyond(LARGEST) > 0.0 {
        return root(beyond, [0.0, LARGEST], error);
    }
    let place = |k: u32| LARGEST * f64::from(k) / f64::from(PLACES);
    match (1..=PLACES).find(|k| beyond(place(*k)) > 0.0) {
        Some(k) => root(beyond, [place(k - 1), place(k)], error),
        None => LARGEST,
    }
}

/// Number of compressions at which a pressure is looked for that the largest compression does not have.
const PLACES: u32 = 60;

/// State and stress at a compression whose elements carry a deviator of this size.
fn at(law: &Law, solid: f64, compression: f64, size: f64, direction: [f64; 2]) -> (Elastic<Cell>, [Cell; 3]) {
    let (jamming, v) = (cell(solid / (1.0 + compression)), cell(compression));
    let unsheared =
        Elastic { jamming, compression: v, shear: [[cell(0.0); 2]; ELEMENTS], strength: cell(1.0) };
    let moduli = law.moduli(v, unsheared.looseness());
    let (ratio, pressure) = (number(moduli.ratio), number(moduli.pressure));
    let load = size / (law.strength() * pressure.max(MIN_PRESSURE));
    let strength = if pressure > 0.0 { load.clamp(1.0, law.most_strength().min(MAX_STRENGTH)) } else { 1.0 };
    let limits = law.elements.map(|element| strength * element.strength / (element.share * ratio));
    let common = shared(law, limits, ratio * pressure, size);
    let shear = limits.map(|limit| direction.map(|d| cell(d * common.min(limit))));
    let state = Elastic { shear, strength: cell(strength), ..unsheared };
    (state, law.stress(&state, &moduli))
}

/// The shear strain that all elements have which do not slide, when together they carry a deviator of this size.
fn shared(law: &Law, limits: [f64; ELEMENTS], stiffness: f64, size: f64) -> f64 {
    let mut order: [usize; ELEMENTS] = std::array::from_fn(|k| k);
    order.sort_by(|a, b| limits[*a].total_cmp(&limits[*b]));
    let mut rest = size / stiffness.max(MIN_PRESSURE);
    let mut shares: f64 = law.elements.iter().map(|element| element.share).sum();
    let mut common = 0.0;
    for k in order {
        common = rest / shares;
        if common <= limits[k] {
            break;
        }
        rest -= law.elements[k].share * limits[k];
        shares -= law.elements[k].share;
        common = limits[k];
    }
    common
}

/// The root of an increasing function in an interval within `error`, else the end that is nearer to it: regula falsi with the
/// end that stays weighted less and less (Dowell and Jarratt, 1971).
fn root(function: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2], error: f64) -> f64 {
    let (mut below, mut above) = (function(low), function(high));
    if below >= 0.0 {
        return low;
    }
    if above <= 0.0 {
        return high;
    }
    let mut side = 0;
    for _ in 0..TRIALS {
        let between = (low * above - high * below) / (above - below);
        let value = function(between);
        if value.abs() <= error || between <= low || between >= high {
            return between;
        }
        if value > 0.0 {
            (high, above) = (between, value);
            below *= if side > 0 { 0.5 } else { 1.0 };
            side = 1;
        } else {
            (low, below) = (between, value);
            above *= if side < 0 { 0.5 } else { 1.0 };
            side = -1;
        }
    }
    0.5 * (low + high)
}
