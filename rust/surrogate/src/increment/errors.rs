//! Errors of a law along paths of strain.

use super::core::{Core, FABRIC_INDEX, POROSITY};
use super::paths::{States, conductivities, follow, stresses};
use crate::tracks::{PathErrors, Track};

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
