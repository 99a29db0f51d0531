//! Loose random discs to start from: random radii at random places without overlap (random sequential addition).

use crate::RveError;
pub use msdd_beds::random::Random;
use msdd_dem::Disc;

/// Attempts per disc before giving up; at the density used in `pack` the last disc needs about ten.
const ATTEMPTS: u32 = 100_000;

/// `count` radii, uniform in [low, high) \[m\].
pub fn radii(random: &mut Random, count: usize, low: f64, high: f64) -> Vec<f64> {
    (0..count).map(|_| random.uniform(low, high)).collect()
}

/// Places discs of the given radii in [0, width] × [0, height] without overlap, the largest first. They are returned in
/// the order of their places (grid cells, line by line), so that neighbours are near each other in memory.
pub fn scatter(
    random: &mut Random,
    radii: Vec<f64>,
    width: f64,
    height: f64,
    density: f64,
) -> Result<Vec<Disc>, RveError> {
    let cell = 2.0 * largest(&radii);
    let [columns, lines] = [width, height].map(|length| (length / cell) as usize + 1);
    place(radii, columns * lines, density, |cells, radius| {
        let x = random.uniform(radius, width - radius);
        let y = random.uniform(radius, height - radius);
        let (column, line) = ((x / cell) as usize, (y / cell) as usize);
        let clash = around(column, columns).any(|c| {
            around(line, lines).any(|l| {
                cells[l * columns + c].iter().any(|d| overlap([d.x - x, d.y - y], d.radius + radius))
            })
        });
        (!clash).then_some((x, y, line * columns + column))
    })
}

/// As [`scatter`], in a periodic box: discs may lie across its border and must not overlap images of others.
pub(crate) fn scatter_periodic(
    random: &mut Random,
    radii: Vec<f64>,
    width: f64,
    height: f64,
    density: f64,
) -> Result<Vec<Disc>, RveError> {
    let size = 2.0 * largest(&radii);
    // The box is a whole number of grid cells, so that neighbours across the border are in adjacent cells, too.
    let [columns, lines] = [width, height].map(|length| ((length / size) as usize).max(1));
    let index = |x: f64, length: f64, count: usize| ((x / length * count as f64) as usize).min(count - 1);
    let nearest = |d: f64, length: f64| d - length * (d / length).round();
    place(radii, columns * lines, density, |cells, radius| {
        let (x, y) = (random.uniform(0.0, width), random.uniform(0.0, height));
        let (column, line) = (index(x, width, columns), index(y, height, lines));
        let clash = [columns - 1, 0, 1].into_iter().any(|c| {
            [lines - 1, 0, 1].into_iter().any(|l| {
                cells[(line + l) % lines * columns + (column + c) % columns]
                    .iter()
                    .any(|d| overlap([nearest(d.x - x, width), nearest(d.y - y, height)], d.radius + radius))
            })
        });
        (!clash).then_some((x, y, line * columns + column))
    })
}

fn largest(radii: &[f64]) -> f64 {
    radii.iter().copied().max_by(f64::total_cmp).unwrap_or(1.0)
}

fn overlap([dx, dy]: [f64; 2], reach: f64) -> bool {
    dx * dx + dy * dy < reach * reach
}

/// Places discs into grid cells, the largest first. `attempt` tries one place for a radius: x, y and the number of the cell.
fn place(
    mut radii: Vec<f64>,
    cells: usize,
    density: f64,
    mut attempt: impl FnMut(&[Vec<Disc>], f64) -> Option<(f64, f64, usize)>,
) -> Result<Vec<Disc>, RveError> {
    let wanted = radii.len();
    radii.sort_by(|a, b| b.total_cmp(a));
    let mut cells: Vec<Vec<Disc>> = vec![Vec::new(); cells];
    for (placed, radius) in radii.into_iter().enumerate() {
        let free = (0..ATTEMPTS).find_map(|_| attempt(&cells, radius));
        let (x, y, home) = free.ok_or(RveError::NoRoom { placed, wanted })?;
        cells[home].push(Disc::at_rest(x, y, radius, density));
    }
    Ok(cells.into_iter().flatten().collect())
}

fn around(index: usize, count: usize) -> std::ops::RangeInclusive<usize> {
    index.saturating_sub(1)..=(index + 1).min(count - 1)
}
