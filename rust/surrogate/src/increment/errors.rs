//! Errors of a law along paths of strain.

use super::core::{Core, FABRIC_INDEX, POROSITY};
use super::paths::{States, conductivities, follow, stresses};
use crate::tracks::{PathErrors, ProbeErrors, Track};

/// Errors by name of the path and number of grains.
pub fn path_errors(core: &Core, tracks: &[Track]) -> Vec<PathErrors> {
    let states = follow(core, tracks);
    let found: Vec<Vec<[f64; 3]>> = states.iter().map(|states| stresses(core, states)).collect();
    errors_of(core, tracks, &states, &found)
}

/// As [`path_errors`], with the states along each track and their stress (p̃, q̃₁, q̃₂) from elsewhere.
pub fn errors_of(
    core: &Core,
    tracks: &[Track],
    states: &[States],
    stress: &[Vec<[f64; 3]>],
) -> Vec<PathErrors> {
    let mut kinds: Vec<(&str, usize)> = tracks.iter().map(|t| (t.name.as_str(), t.discs)).collect();
    kinds.sort_unstable();
    kinds.dedup();
    let mut all = Vec::new();
    for (name, discs) in kinds {
        let (mut sums, mut count, mut paths) = ([0.0; 6], 0, 0);
        let followed = tracks.iter().zip(states).zip(stress);
        for ((track, states), found) in followed.filter(|((t, _), _)| t.name == name && t.discs == discs) {
            let means = conductivities(core, states);
            let over = 1.0 / track.pressure().max(f64::MIN_POSITIVE);
            paths += 1;
            for (k, step) in track.steps.iter().enumerate().filter(|(_, s)| s.to.load_bearing && !s.probe) {
                let (data, law, state) = (step.to.invariants(), found[k + 1], &states[k + 1]);
                let error = [0, 1, 2].map(|c| (law[c] - data[c]) * over);
                sums[0] += error[0] * error[0];
                sums[1] += error[1] * error[1] + error[2] * error[2];
                if let Some([xx, yy, xy]) = step.to.conductivity(core.conductivity.kind) {
                    let [x, y, z] = means[k + 1];
                    sums[2] += ((x + y) / (xx + yy) - 1.0).powi(2);
                    let direction = |xx: f64, yy: f64, xy: f64| [(xx - yy) / (xx + yy), 2.0 * xy / (xx + yy)];
                    let (a, b) = (direction(x, y, z), direction(xx, yy, xy));
                    sums[3] += (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2);
                }
                sums[4] += (state[POROSITY] - step.to.porosity).powi(2);
                sums[5] += (state[FABRIC_INDEX] - step.to.fabric_index).powi(2);
                count += 1;
            }
        }
        let rms = sums.map(|sum| (sum / f64::from(count.max(1))).sqrt());
        all.push(PathErrors {
            name: name.to_string(),
            discs,
            paths,
            states: count as usize,
            pressure: rms[0],
            deviator: rms[1],
            conductivity: rms[2],
            anisotropy: rms[3],
            porosity: rms[4],
            fabric_index: rms[5],
        });
    }
    all
}

/// Errors of the probes by their size and number of grains.
pub fn probe_errors(core: &Core, tracks: &[Track]) -> Vec<ProbeErrors> {
    let mut probes = Vec::new();
    for (track, states) in tracks.iter().zip(follow(core, tracks)) {
        let law = stresses(core, &states);
        for (k, step) in track.steps.iter().enumerate().filter(|(_, step)| step.probe) {
            let from = track.point(step.from).invariants();
            let data = std::array::from_fn(|c| step.to.invariants()[c] - from[c]);
            let law = std::array::from_fn(|c| law[k + 1][c] - law[step.from][c]);
            probes.extend(Probe::of(step.strain, track.discs, data, law));
        }
    }
    let mut kinds: Vec<(usize, f64)> = probes.iter().map(|probe| (probe.discs, probe.size)).collect();
    kinds.sort_by(|a, b| a.partial_cmp(b).expect("finite strains"));
    kinds.dedup();
    let of = |(discs, size)| {
        probes.iter().filter(move |probe: &&Probe| (probe.discs, probe.size) == (discs, size))
    };
    kinds.into_iter().filter_map(|kind| mean_errors(kind, &of(kind).collect::<Vec<_>>())).collect()
}

/// Stiffnesses that a small strain has shown.
struct Probe {
    size: f64,
    discs: usize,
    /// The column of the strain: 0 for xx, 1 for yy, 2 for xy.
    column: usize,
    /// Loss of the stress xx, yy, xy over the strain: of the discs, and of the law.
    data: [f64; 3],
    law: [f64; 3],
}

impl Probe {
    /// With changes of p̃, q̃₁ and q̃₂; none for a strain of several components.
    fn of([thermal, xx, yy, xy]: [f64; 4], discs: usize, data: [f64; 3], law: [f64; 3]) -> Option<Self> {
        let strains = [xx, yy, xy];
        let column = strains.iter().position(|&strain| strain != 0.0)?;
        if thermal != 0.0 || strains[column + 1..].iter().any(|&strain| strain != 0.0) {
            return None;
        }
        let strain = strains[column];
        let stiffness = |[p, q1, q2]: [f64; 3]| [p + q1, p - q1, q2].map(|stress| -stress / strain);
        Some(Self { size: strain.abs(), discs, column, data: stiffness(data), law: stiffness(law) })
    }
}

fn mean_errors((discs, size): (usize, f64), probes: &[&Probe]) -> Option<ProbeErrors> {
    let (mut squares, mut entries) = (0.0, 0.0);
    // Sums over the diagonal: of the discs and of the law, for strains along an axis and for shear.
    let mut sums = [[0.0; 2]; 2];
    let mut along = 0.0;
    for probe in probes {
        let shear = probe.column == 2;
        for row in if shear { 2..3 } else { 0..2 } {
            squares += (probe.law[row] - probe.data[row]).powi(2);
            entries += 1.0;
        }
        let sum = &mut sums[usize::from(shear)];
        sum[0] += probe.data[probe.column];
        sum[1] += probe.law[probe.column];
        along += f64::from(u8::from(!shear));
    }
    let [normal, shear] = sums.map(|[data, law]| law / data - 1.0);
    let tangent = (squares / entries).sqrt() / (sums[0][0] / along);
    let all = tangent.is_finite() && shear.is_finite();
    all.then_some(ProbeErrors { size, discs, probes: probes.len(), tangent, normal, shear })
}
