//! The slack of spheres next to two plates.
//!
//! Spheres at a plate find no hold: a bed between plates is shortened by more than its strain. What the plates have moved towards each other
//! beyond the strain of the inside times the depth is ascribed to an extra thickness of bed at each plate, which is strained as
//! the inside is, less what the spheres have grown. Where the bed is let up, only a share of it comes back. These are the keys `slackLayer`
//! and `slackRecovery` of the solver's walls.

use crate::packings::column;

/// Change of the load below which nothing is counted, over the load: where a lid keeps its pressure, the load tells nothing.
const MIN_CHANGE: f64 = 0.01;

/// What a bed has given at its plates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Give {
    /// Thickness of bed at each plate, in diameters, while the bed was pressed.
    pub thickness: f64,
    /// The same while it was let up.
    pub back: f64,
}

/// Of a table that [`crate::rows::elements`] writes, of spheres of this diameter \[m\]; `None` if it lacks the strain inside. A value is
/// NaN if the bed was never pressed, or never let up.
pub fn give(text: &str, diameter: f64) -> Option<Give> {
    let [depth, thermal, strain, load] =
        ["depth", "thermal_strain", "strain_3", "p_lid"].map(|name| column(text, name));
    let (depth, thermal, strain, load) = (depth?, thermal?, strain?, load?);
    let (mut pressed, mut let_up) = ([0.0; 2], [0.0; 2]);
    for k in 1..depth.len() {
        let lengthening = (strain[k] - thermal[k]) - (strain[k - 1] - thermal[k - 1]);
        let change = load[k] - load[k - 1];
        if change.abs() < MIN_CHANGE * load[k - 1] || lengthening * change >= 0.0 {
            continue;
        }
        // Towards each other, beyond the strain of the whole depth.
        let way = depth[k - 1] - depth[k] + depth[0] * (strain[k] - strain[k - 1]);
        let sums = if lengthening < 0.0 { &mut pressed } else { &mut let_up };
        sums[0] += way;
        sums[1] -= lengthening;
    }
    let each = |[way, shortening]: [f64; 2]| way / shortening / (2.0 * diameter);
    Some(Give { thickness: each(pressed), back: each(let_up) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plates_that_give_are_told_from_the_strain_inside() {
        // A bed of 0.1 m, d = 0.01 m, whose plates have 1.5 diameters each, and give back a fifth: spheres grow by 1e-4 between plates
        // that stay, the lid presses, goes up, and at last keeps its pressure.
        let mut text = "depth,thermal_strain,strain_3,p_lid\n0.1,0,0,1000\n".to_string();
        let (mut depth, mut before) = (0.1, (0.0, 0.0));
        for (thermal, mechanical, load) in
            [(1e-4, -2e-4, 3000), (1e-4, -3e-4, 6000), (1e-4, -1e-4, 3000), (2e-4, 1e-4, 3000)]
        {
            let change: f64 = mechanical - before.1;
            depth += 0.1 * (thermal - before.0 + change)
                + 2.0 * 1.5 * 0.01 * if change < 0.0 { change } else { 0.2 * change };
            before = (thermal, mechanical);
            text += &format!("{depth},{thermal},{},{load}\n", thermal + mechanical);
        }
        let found = give(&text, 0.01).unwrap();
        assert!((found.thickness - 1.5).abs() < 1e-9, "{found:?}");
        assert!((found.back - 0.3).abs() < 1e-9, "{found:?}");
        assert!(give("depth,thermal_strain,strain_3,p_lid\n0.1,0,0,1\n", 0.01).unwrap().thickness.is_nan());
        assert_eq!(give("depth,p_lid\n0.1,1\n", 0.01), None);
    }
}
