//! Loose random spheres to start from: random places without overlap (random sequential addition).

use crate::BedError;
use crate::random::Random;

/// Attempts per sphere before giving up. Random sequential addition of equal spheres ends at a solid fraction of 0.38.
const ATTEMPTS: u32 = 100_000;

/// Centres and radii of spheres without overlap in a periodic block from the origin to `edges` \[m\], placed in the order of `radii`
/// \[m\]; the largest ones come first, or they find no room. They are returned in the order of their places (cells of a grid, line by
/// line), so that neighbours are near each other in memory.
///
/// # Errors
/// [`BedError::NoRoom`].
pub fn scatter(
    random: &mut Random,
    radii: &[f64],
    edges: [f64; 3],
) -> Result<Vec<([f64; 3], f64)>, BedError> {
    let largest = radii.iter().copied().fold(0.0, f64::max);
    let sides = edges.map(|edge| ((edge / (2.0 * largest)) as usize).max(3));
    let mut cells: Vec<Vec<([f64; 3], f64)>> = vec![Vec::new(); sides.iter().product()];
    let home = |place: [usize; 3]| (place[2] * sides[1] + place[1]) * sides[0] + place[0];
    let near = |a: [f64; 3], (b, other): ([f64; 3], f64), radius: f64| {
        let square = (0..3).fold(0.0, |sum, k| {
            let d = (a[k] - b[k]).abs();
            let d = d.min(edges[k] - d);
            sum + d * d
        });
        square < (radius + other) * (radius + other)
    };
    for (placed, &radius) in radii.iter().enumerate() {
        let free = (0..ATTEMPTS).find_map(|_| {
            let centre: [f64; 3] = edges.map(|edge| random.uniform(0.0, edge));
            let place = std::array::from_fn(|k| {
                let cell = edges[k] / sides[k] as f64;
                ((centre[k] / cell) as usize).min(sides[k] - 1)
            });
            let clash = (0..27).any(|code| {
                let around = |k: usize, digit: usize| (place[k] + sides[k] + digit - 1) % sides[k];
                let neighbour = [around(0, code % 3), around(1, code / 3 % 3), around(2, code / 9)];
                cells[home(neighbour)].iter().any(|&other| near(centre, other, radius))
            });
            (!clash).then_some((centre, home(place)))
        });
        let (centre, home) = free.ok_or(BedError::NoRoom { placed, wanted: radii.len() })?;
        cells[home].push((centre, radius));
    }
    Ok(cells.into_iter().flatten().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spheres_do_not_overlap_and_a_full_box_is_refused() {
        let edge = 6.0;
        let unequal: Vec<f64> = (0..120).map(|k| 0.6 - 0.003 * f64::from(k)).collect();
        for radii in [vec![0.5; 120], unequal] {
            let spheres = scatter(&mut Random::new(3), &radii, [edge; 3]).unwrap();
            assert_eq!(spheres.len(), 120);
            for (k, (a, r)) in spheres.iter().enumerate() {
                for (b, other) in &spheres[..k] {
                    let square: f64 =
                        (0..3).map(|m| (a[m] - b[m]).abs()).map(|d| d.min(edge - d)).map(|d| d * d).sum();
                    assert!(square.sqrt() >= r + other);
                }
            }
            assert_eq!(spheres, scatter(&mut Random::new(3), &radii, [edge; 3]).unwrap());
        }
        let full = scatter(&mut Random::new(3), &[0.5; 400], [edge; 3]).unwrap_err();
        assert!(full.to_string().ends_with("of 400 spheres only"), "{full}");
    }
}
