//! The paths of `[[paths]]`: the increments of strain that each consists of.

use super::kind::RampName;
use super::seed::seed_of;
use crate::Strains;
use crate::place::Random;
use std::f64::consts::PI;

/// Thermal strains of `equivalence` [-], each applied from the packed state, with either sign.
const EQUIVALENT: [f64; 3] = [0.005, 0.01, 0.02];
/// Radius of `circle`, in increments.
const CIRCLE_RADIUS: f64 = 5.0;
/// Chords of a turn of `circle`, and turns.
const CHORDS: i32 = 20;
const TURNS: i32 = 3;
/// Increments of `turning`, while the axes of strain turn by 3π/2.
const TURNING: i32 = 60;
/// Straight pieces of `mixed` and `mechanical`; fewest increments of one, and how many more it may have.
const SEGMENTS: i32 = 8;
const SHORTEST: usize = 4;
const LONGER: usize = 8;
/// Increments of `front` there, back and there again, and how far its normal strain may exceed that of the grains.
const FRONT: [usize; 3] = [24, 16, 8];
const LARGEST_NORMAL: f64 = 2.0;
/// Size of the thermal part of a random direction relative to the other parts.
const THERMAL_SHARE: f64 = 0.5;

/// How the paths of a block are walked.
#[derive(Clone, Debug, PartialEq)]
pub struct Steps {
    /// Size of an increment h [-].
    pub size: f64,
    /// Magnitudes of the strains that are tried on copies of the box [-].
    pub probes: Vec<f64>,
    /// Increments between two states that are probed.
    pub probe_every: usize,
}

/// A change of the strains that leads from one row to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Increment {
    /// Stop of the same path from whose state it starts; 0 is the packed state.
    pub from_stop: i64,
    /// Relative to that state [-].
    pub step: Strains,
    /// Whether it is tried on a copy of the box: the path goes on as if it had not been.
    pub probe: bool,
}

/// A planned row of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planned {
    /// Running number on the path, from 1.
    pub stop: i64,
    pub increment: Increment,
    /// Strains relative to the packed state after the increment [-].
    pub strains: Strains,
}

/// The rows of a path, in the order in which they are made. They depend on the seed of the packing, the name of the path
/// and `plan` alone. `probe_packed`: whether the packed state is probed as well.
pub fn planned(path: RampName, seed: u64, plan: &Steps, probe_packed: bool) -> Vec<Planned> {
    let mut rows: Vec<Planned> = Vec::new();
    let mut add = |(from_stop, from): (i64, Strains), step: Strains, probe: bool| {
        let increment = Increment { from_stop, step, probe };
        let row = Planned { stop: rows.len() as i64 + 1, increment, strains: from.then(step) };
        rows.push(row);
        (row.stop, row.strains)
    };
    let packed = (0, Strains::default());
    let probes = probes(&plan.probes);
    if probe_packed {
        for &probe in &probes {
            add(packed, probe, true);
        }
    }
    let mut here = packed;
    for (k, step) in steps(path, seed, plan.size).into_iter().enumerate() {
        if path == RampName::Equivalence {
            add(packed, step, false);
            continue;
        }
        here = add(here, step, false);
        if (k + 1) % plan.probe_every.max(1) == 0 {
            for &probe in &probes {
                add(here, probe, true);
            }
        }
    }
    rows
}

/// The strains that are tried at a state: along x, along y and shear, each with either sign.
fn probes(magnitudes: &[f64]) -> Vec<Strains> {
    let of = |size: f64| {
        [1.0, -1.0].map(|sign| {
            let size = sign * size;
            [along(0, size), along(1, size), Strains { xy: size, ..Strains::default() }]
        })
    };
    magnitudes.iter().flat_map(|&size| of(size)).flatten().collect()
}

/// The increments of a path, each relative to the state before it; of `equivalence`, relative to the packed state. `h`:
/// size of an increment [-].
fn steps(path: RampName, seed: u64, h: f64) -> Vec<Strains> {
    let mut random = Random::new(seed_of(seed, path.to_string().as_bytes()));
    let sense = if random.uniform(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 };
    let h_signed = sense * h;
    match path {
        RampName::Uniaxial => {
            let axis = usize::from(random.uniform(0.0, 1.0) < 0.5);
            there_and_back(along(axis, h_signed), [25, 25, 15])
        }
        RampName::Biaxial => {
            there_and_back(Strains { xx: h_signed, yy: -h_signed, ..Strains::default() }, [15, 25, 15])
        }
        RampName::Shear => there_and_back(Strains { xy: 2.0 * h_signed, ..Strains::default() }, [15, 25, 15]),
        RampName::Isotropic => {
            there_and_back(Strains { xx: h_signed, yy: h_signed, ..Strains::default() }, [12, 18, 10])
        }
        RampName::Thermal => there_and_back(Strains::thermal(h_signed), [20, 35, 15]),
        RampName::Circle => circle(random.uniform(0.0, 2.0 * PI), sense, h),
        RampName::Turning => turning(h),
        RampName::Mixed => segments(&mut random, h, THERMAL_SHARE),
        RampName::Mechanical => segments(&mut random, h, 0.0),
        RampName::Front => front(&mut random, h_signed),
        RampName::Equivalence => equivalence(),
        _ => Vec::new(),
    }
}

/// Extension along x (0) or y (1).
fn along(axis: usize, size: f64) -> Strains {
    match axis {
        0 => Strains { xx: size, ..Strains::default() },
        _ => Strains { yy: size, ..Strains::default() },
    }
}

/// `factor` times the strains. Adding 0 makes 0 of −0, which would be written with its sign.
fn times(factor: f64, strains: Strains) -> Strains {
    let [thermal, xx, yy, xy] = strains.parts().map(|strain| factor * strain + 0.0);
    Strains { thermal, xx, yy, xy }
}

/// So many increments there, then back, then there again.
fn there_and_back(step: Strains, counts: [usize; 3]) -> Vec<Strains> {
    let legs = counts.into_iter().zip([1.0, -1.0, 1.0]);
    legs.flat_map(|(count, sense)| std::iter::repeat_n(times(sense, step), count)).collect()
}

/// Chords of a circle through the start in the plane of the extensions relative to the packed state. `begin`: angle of
/// the start, seen from the centre [rad].
fn circle(begin: f64, sense: f64, h: f64) -> Vec<Strains> {
    let point = |k: i32| {
        let angle = begin + sense * 2.0 * PI * f64::from(k % CHORDS) / f64::from(CHORDS);
        let radius = CIRCLE_RADIUS * h;
        [radius * (libm::cos(angle) - libm::cos(begin)), radius * (libm::sin(angle) - libm::sin(begin))]
    };
    let chord = |k: i32| {
        let (from, to) = (point(k), point(k + 1));
        let [xx, yy] = [0, 1].map(|axis| (to[axis] - from[axis]) / (1.0 + from[axis]));
        Strains { xx, yy, ..Strains::default() }
    };
    (0..TURNS * CHORDS).map(chord).collect()
}

fn turning(h: f64) -> Vec<Strains> {
    let step = |k: i32| {
        let angle = 3.0 * PI * f64::from(k) / f64::from(TURNING - 1);
        let (sin, cos) = libm::sincos(angle);
        Strains { xx: h * cos, yy: -h * cos, xy: 2.0 * h * sin, ..Strains::default() }
    };
    (0..TURNING).map(step).collect()
}

/// Straight pieces, each in a random direction whose largest part is `h`. `thermal`: size of the thermal part relative to
/// the others, on average.
fn segments(random: &mut Random, h: f64, thermal: f64) -> Vec<Strains> {
    let mut steps = Vec::new();
    for _ in 0..SEGMENTS {
        let count = SHORTEST + (random.uniform(0.0, (LONGER + 1) as f64) as usize).min(LONGER);
        let parts: [f64; 4] = std::array::from_fn(|_| random.uniform(-1.0, 1.0));
        let direction =
            Strains { thermal: thermal * parts[0] + 0.0, xx: parts[1], yy: parts[2], xy: parts[3] };
        let [t, xx, yy, xy] = direction.parts().map(f64::abs);
        let largest = t.max(xx).max(yy).max(xy).max(f64::MIN_POSITIVE);
        steps.extend(std::iter::repeat_n(times(h / largest, direction), count));
    }
    steps
}

/// A layer of a bed that a front of temperature passes: its grains change size by `h` an increment, the bed around holds it
/// along one axis, and along the other it follows its grains more or less. Of each piece the axis is the same, the share by
/// which it follows is another.
fn front(random: &mut Random, h: f64) -> Vec<Strains> {
    let axis = usize::from(random.uniform(0.0, 1.0) < 0.5);
    let legs = FRONT.into_iter().zip([h, -h, h]);
    let leg = |(count, thermal): (usize, f64)| {
        let share = random.uniform(0.0, LARGEST_NORMAL);
        std::iter::repeat_n(Strains { thermal, ..along(axis, share * thermal) }, count)
    };
    legs.flat_map(leg).collect()
}

/// Growth of the radii by 1 + ε in a fixed box, and its twin: the box shrinks by the same factor around fixed radii. Both
/// give the same packing, but for its scale.
fn equivalence() -> Vec<Strains> {
    let pair = |strain: f64| {
        let box_strain = 1.0 / (1.0 + strain) - 1.0;
        [Strains::thermal(strain), Strains { xx: box_strain, yy: box_strain, ..Strains::default() }]
    };
    EQUIVALENT.into_iter().flat_map(|size| [pair(size), pair(-size)]).flatten().collect()
}

#[cfg(test)]
#[path = "paths_tests.rs"]
mod tests;
