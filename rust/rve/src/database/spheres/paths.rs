//! The paths of `[[spheres]]`: the increments of strain that each consists of.
//!
//! What a strain does depends on the pressure: it changes p^(2/3), roughly by half of the strain of each axis. So the first
//! increment of a path is `FIRST` times (p/E*)^(2/3) at most, and the following ones grow to the size that the plan says.

use super::kind::PathName;
use crate::database::seed::seed_of;
use crate::place::Random;
use crate::spheres::Strain;

/// Largest first increment over (p/E*)^(2/3).
const FIRST: f64 = 0.5;
/// Growth of the increments, and the first one after a turn over the usual one.
const GROWTH: f64 = 1.5;
const TURN: f64 = 0.125;
/// p/E* from which on some paths begin with opening, their share, and how far they open over (p/E*)^(2/3): less than what the box can
/// carry, which is about 1.6.
const OPENING_FROM: f64 = 0.99e-5;
const OPENING_SHARE: f64 = 0.3;
const OPENING: f64 = 1.2;
/// How far `biaxial` opens along one axis over how far it closes along another.
const BIAXIAL_OPENS: f64 = 0.5;
/// Straight pieces of `mixed`, and their lengths over the strain of the block.
const SEGMENTS: usize = 8;
const LENGTHS: [f64; 2] = [0.15, 0.6];
/// Size of the thermal part of a random direction relative to the other parts.
const THERMAL_SHARE: f64 = 0.5;
/// Least compression at the end of a piece over the strain of the block, and attempts to find such a direction: loose boxes that change
/// their shape only lose their load at once.
const MIN_COMPRESSION: f64 = 0.5;
const ATTEMPTS: usize = 100;
/// Strains of `equivalence` over (p/E*)^(2/3), and the largest.
const EQUIVALENT: [f64; 4] = [0.3, -0.3, 1.0, 3.0];
const LARGEST_EQUIVALENT: f64 = 0.01;

/// How the paths of a packing are walked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steps {
    /// Seed of the packing.
    pub seed: u64,
    /// p/E* of the packed state, as planned.
    pub pressure: f64,
    /// How far a path goes \[-\].
    pub strain: f64,
    /// Size of an increment \[-\].
    pub size: f64,
    /// How often a path goes there and back, before it goes there once more.
    pub cycles: u32,
}

/// A change of the strains that leads from one row to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Increment {
    /// Stop of the same path from whose state it starts; 0 is the packed state.
    pub from_stop: i64,
    /// Relative to that state.
    pub step: Strain,
    /// Whether it is made in a box with other names of its axes, see [`crate::spheres::turn`].
    pub turned: bool,
}

/// A planned row of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planned {
    /// Running number on the path, from 1.
    pub stop: i64,
    pub increment: Increment,
    /// Strain relative to the packed state after the increment.
    pub strain: Strain,
    /// The axis along which the box yields so that its stress stays: that component of the strain is not planned, and 0 here.
    pub free_axis: Option<usize>,
}

/// The rows of a path, in the order in which they are made. They depend on the seed of the packing, the name of the path and
/// `steps` alone.
pub fn planned(path: PathName, steps: &Steps) -> Vec<Planned> {
    if path == PathName::Equivalence {
        return equivalence(steps);
    }
    let mut random = Random::new(seed_of(steps.seed, path.to_string().as_bytes()));
    let (targets, free_axis) = match path {
        PathName::Mixed => (mixed(&mut random, steps), None),
        path => {
            let along = direction(path, &mut random);
            let free_axis = (0..3).find(|axis| path == PathName::Pressed && along.stretch[*axis] == 0.0);
            (there_and_back(path, along, &mut random, steps), free_axis)
        }
    };
    let mut here = Strain::default();
    let row = |(stop, target): (i64, Strain)| {
        let step = here.to(target);
        here = here.then(step);
        Planned {
            stop,
            increment: Increment { from_stop: stop - 1, step, turned: false },
            strain: here,
            free_axis,
        }
    };
    (1..).zip(targets).map(row).collect()
}

/// A whole number from 0 to `count` − 1.
fn choice(random: &mut Random, count: usize) -> usize {
    (random.uniform(0.0, count as f64) as usize).min(count - 1)
}

/// The first increment of a path.
fn first(steps: &Steps) -> f64 {
    steps.size.min(FIRST * libm::pow(steps.pressure, 2.0 / 3.0))
}

/// Distances from the start of a straight piece at which it stops: increments that grow from `first` to the usual size.
fn stops(first: f64, length: f64, steps: &Steps) -> Vec<f64> {
    let (mut size, mut at, mut stops) = (first, 0.0, Vec::new());
    // What is left at the end is shared with the last increment.
    while at + 1.5 * size < length {
        at += size;
        stops.push(at);
        size = (GROWTH * size).min(steps.size);
    }
    stops.push(length);
    stops
}

/// Strains, relative to the packed state, of a path that goes along one line.
fn there_and_back(path: PathName, along: Strain, random: &mut Random, steps: &Steps) -> Vec<Strain> {
    let opens = steps.pressure >= OPENING_FROM && random.uniform(0.0, 1.0) < OPENING_SHARE;
    let [there, back, end] = match path {
        // To shear it one way or the other is the same on average.
        PathName::Shear => [1.0, -0.6, 0.8],
        PathName::Pressed => [1.0, 0.0, 0.6],
        _ if opens => {
            let open = OPENING * libm::pow(steps.pressure, 2.0 / 3.0) / steps.strain;
            [-open.min(1.0), 0.6, 0.0]
        }
        PathName::Thermal => [1.0, 0.0, 0.6],
        _ => [1.0, 0.2, 0.7],
    };
    let (mut from, mut targets) = (0.0, Vec::new());
    let turns = (0..steps.cycles).flat_map(|_| [there, back]).chain([end]);
    for (k, turn) in turns.enumerate() {
        let to = turn * steps.strain;
        let begin = if k == 0 { first(steps) } else { TURN * steps.size };
        let sense = f64::signum(to - from);
        let distances = stops(begin, (to - from).abs(), steps);
        targets.extend(distances.into_iter().map(|distance| along.times(from + sense * distance)));
        from = to;
    }
    targets
}

/// The strain of size 1 of a path, closing positive.
fn direction(path: PathName, random: &mut Random) -> Strain {
    match path {
        PathName::Thermal => Strain::thermal(1.0),
        PathName::Uniaxial => Strain::single(choice(random, 3), -1.0),
        PathName::Biaxial => {
            let closes = choice(random, 3);
            let opens = (closes + 1 + choice(random, 2)) % 3;
            let mut strain = Strain::single(closes, -1.0);
            strain.stretch[opens] = BIAXIAL_OPENS;
            strain
        }
        PathName::Pressed => {
            let mut strain = Strain::isotropic(-1.0);
            strain.stretch[choice(random, 3)] = 0.0;
            strain
        }
        PathName::Shear => Strain::single(3 + choice(random, 3), 2.0),
        _ => Strain::isotropic(-1.0),
    }
}

/// Straight pieces, each in a random direction whose largest part is 1, of those after which the box is still compressed.
fn mixed(random: &mut Random, steps: &Steps) -> Vec<Strain> {
    let (mut here, mut compression) = (Strain::default(), 0.0);
    let mut targets = Vec::new();
    for segment in 0..SEGMENTS {
        let length = steps.strain * random.uniform(LENGTHS[0], LENGTHS[1]);
        let compressed =
            |along: &Strain| compression + length * along.compression() >= MIN_COMPRESSION * steps.strain;
        let along = (0..ATTEMPTS).map(|_| any_direction(random)).find(compressed);
        let along = along.unwrap_or(Strain::isotropic(-1.0));
        compression += length * along.compression();
        let begin = if segment == 0 { first(steps) } else { TURN * steps.size };
        let mut before = 0.0;
        for at in stops(begin, length, steps) {
            here = here.then(along.times(at - before));
            before = at;
            targets.push(here);
        }
    }
    targets
}

/// A random strain whose largest part is 1.
fn any_direction(random: &mut Random) -> Strain {
    let parts: [f64; 7] = std::array::from_fn(|_| random.uniform(-1.0, 1.0));
    let [thermal, x, y, z, xy, xz, yz] = parts;
    let strain = Strain { thermal: THERMAL_SHARE * thermal, stretch: [x, y, z, xy, xz, yz] };
    strain.times(1.0 / strain.largest().max(f64::MIN_POSITIVE))
}

/// Growth of the radii by 1 + ε in a fixed box, and its twin: the box shrinks by the same factor around fixed radii. Then the box
/// closes along x, and its twin: the same in a box with other names of its axes.
fn equivalence(steps: &Steps) -> Vec<Planned> {
    let power = libm::pow(steps.pressure, 2.0 / 3.0);
    let mut rows: Vec<Planned> = Vec::new();
    for factor in EQUIVALENT {
        let size = (factor * power).min(LARGEST_EQUIVALENT);
        let (grown, shrunk) = (Strain::thermal(size), Strain::isotropic(1.0 / (1.0 + size) - 1.0));
        let along = Strain::single(0, -size);
        for (step, turned) in [(grown, false), (shrunk, false), (along, false), (along, true)] {
            let stop = rows.len() as i64 + 1;
            let increment = Increment { from_stop: 0, step, turned };
            rows.push(Planned { stop, increment, strain: step, free_axis: None });
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEPS: Steps = Steps { seed: 7, pressure: 1e-6, strain: 0.01, size: 5e-4, cycles: 1 };

    #[test]
    fn paths_turn_where_they_should_and_strains_add_up() {
        for path in PathName::ALL {
            let rows = planned(path, &STEPS);
            assert_eq!(rows, planned(path, &STEPS));
            assert!(rows.iter().zip(1..).all(|(row, stop)| row.stop == stop), "{path:?}");
            if path == PathName::Equivalence {
                assert_eq!(rows.len(), 16);
                continue;
            }
            let mut here = Strain::default();
            for row in &rows {
                here = here.then(row.increment.step);
                assert_eq!(here, row.strain);
                assert_eq!(row.increment.from_stop, row.stop - 1);
                let size = row.increment.step.largest();
                assert!(size > 0.0 && size < 2.0 * 1.5 * 5.1e-4, "{path:?} {size}");
            }
            assert!(rows[0].increment.step.largest() < 2.01 * FIRST * 1e-4, "{path:?}");
        }
        let thermal = planned(PathName::Thermal, &STEPS);
        let largest = thermal.iter().map(|row| row.strain.thermal).fold(0.0, f64::max);
        assert!(
            (largest - 0.01).abs() < 1e-15 && (thermal.last().unwrap().strain.thermal - 0.006).abs() < 1e-15
        );
        assert!(thermal.iter().any(|row| row.strain.thermal.abs() < 1e-15));
        let turns = |cycles: u32| {
            let rows = planned(PathName::Uniaxial, &Steps { cycles, ..STEPS });
            let closes: Vec<bool> = rows.iter().map(|row| row.increment.step.compression() > 0.0).collect();
            closes.windows(2).filter(|two| two[0] != two[1]).count()
        };
        assert_eq!((turns(1), turns(10)), (2, 20));
        for path in PathName::ALL {
            let axes = planned(path, &STEPS)
                .into_iter()
                .map(|row| row.free_axis.map(|axis| row.strain.stretch[axis]));
            assert!(axes.into_iter().all(|planned| planned == (path == PathName::Pressed).then_some(0.0)));
        }
    }

    /// Random ways end nearer than they began.
    #[test]
    fn mixed_paths_do_not_open() {
        for seed in 0..20 {
            let rows = planned(PathName::Mixed, &Steps { seed, ..STEPS });
            let end = rows.last().unwrap().strain;
            assert!(end.compression() > 4e-3, "{seed}: {end:?}");
        }
    }
}
