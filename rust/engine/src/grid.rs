//! Search for pairs of grains that are near each other, by sorting the grains into a grid of cubic cells (square ones in
//! the plane).

use crate::grain::{Grain, difference, largest_radius, square};
use crate::lattice::{Image, Lattice, forward, index_of};
use crate::rows::Rows;

/// Uniform grid over the bounding box of the centres: `first[c]..first[c + 1]` of `grain` are the grains of cell c.
/// Cells that follow each other along x follow each other in memory; such a row of cells is a line.
struct Grid<const D: usize> {
    origin: [f64; D],
    cell: f64,
    count: [usize; D],
    first: Vec<u32>,
    grain: Vec<u32>,
}

impl<const D: usize> Grid<D> {
    fn new(grains: &[impl Grain<D>], cell: f64) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
        for grain in grains {
            let centre = grain.centre();
            low = std::array::from_fn(|k| low[k].min(centre[k]));
            high = std::array::from_fn(|k| high[k].max(centre[k]));
        }
        // Limits the grid to a few cells per grain: a single grain far away from the others must not make it huge.
        let extent = difference(high, low).into_iter().fold(0.0, f64::max);
        let along = (4.0 * grains.len() as f64).powf(1.0 / D as f64).max(1.0);
        let cell = cell.max(extent / along / 4.0);
        let count = std::array::from_fn(|k| ((high[k] - low[k]) / cell) as usize + 1);
        let mut grid = Self { origin: low, cell, count, first: Vec::new(), grain: vec![0; grains.len()] };
        grid.fill(grains);
        grid
    }

    /// Numbers of the cell of a point along each axis.
    fn place(&self, centre: [f64; D]) -> [usize; D] {
        std::array::from_fn(|k| ((centre[k] - self.origin[k]) / self.cell) as usize)
    }

    /// Number of the cell.
    fn number(&self, place: [usize; D]) -> usize {
        (0..D).rev().fold(0, |number, k| number * self.count[k] + place[k])
    }

    /// Counting sort of the grains by cell.
    fn fill(&mut self, grains: &[impl Grain<D>]) {
        let cells: Vec<u32> =
            grains.iter().map(|grain| self.number(self.place(grain.centre())) as u32).collect();
        let mut first = vec![0u32; self.count.iter().product::<usize>() + 1];
        for &cell in &cells {
            first[cell as usize + 1] += 1;
        }
        for c in 1..first.len() {
            first[c] += first[c - 1];
        }
        let mut next = first.clone();
        for (i, &cell) in (0u32..).zip(&cells) {
            let slot = &mut next[cell as usize];
            self.grain[*slot as usize] = i;
            *slot += 1;
        }
        self.first = first;
    }

    /// Calls `visit` with every grain in the 3 × 3 (× 3) cells around `centre`.
    fn around(&self, centre: [f64; D], mut visit: impl FnMut(u32)) {
        let place = self.place(centre);
        let range = |k: usize| place[k].saturating_sub(1)..(place[k] + 2).min(self.count[k]);
        let along = range(0);
        // The lines around: 3 in the plane, 9 in space.
        'lines: for line in 0..3usize.pow(D as u32 - 1) {
            let (mut corner, mut rest) = (place, line);
            for (k, number) in corner.iter_mut().enumerate().skip(1) {
                *number = (*number + rest % 3).wrapping_sub(1);
                rest /= 3;
                if !range(k).contains(number) {
                    continue 'lines;
                }
            }
            corner[0] = along.start;
            let from = self.number(corner);
            let (from, to) = (self.first[from] as usize, self.first[from + along.len()] as usize);
            self.grain[from..to].iter().for_each(|&j| visit(j));
        }
    }
}

/// Whether the surfaces of two grains are closer than `skin` [m].
fn near<const D: usize>(a: &impl Grain<D>, b: &impl Grain<D>, skin: f64) -> bool {
    let reach = a.radius() + b.radius() + skin;
    square(difference(b.centre(), a.centre())) < reach * reach
}

/// All pairs whose surfaces are closer than `skin` \[m\].
pub fn pairs_within<const D: usize>(grains: &[impl Grain<D>], skin: f64) -> Rows {
    if grains.is_empty() {
        return Rows::build(0, |_, _| ());
    }
    let grid = Grid::new(grains, 2.0 * largest_radius(grains) + skin);
    Rows::build(grains.len(), |i, row| {
        let a = &grains[i];
        grid.around(a.centre(), |j| {
            if j as usize > i && near(a, &grains[j as usize], skin) {
                row.push(j);
            }
        });
    })
}

/// Where a grain or an image of it is.
#[derive(Clone, Copy)]
struct Placed<const D: usize> {
    centre: [f64; D],
    radius: f64,
}

impl<const D: usize> Grain<D> for Placed<D> {
    fn centre(&self) -> [f64; D] {
        self.centre
    }
    fn radius(&self) -> f64 {
        self.radius
    }
    fn at(self, centre: [f64; D]) -> Self {
        Self { centre, ..self }
    }
}

/// All pairs closer than `skin` \[m\], images across the periodic border included; and these images (ghosts), which are
/// numbered after the grains. `apart`: see [`Rows::build_periodic`].
pub fn pairs_within_cell<const D: usize>(
    grains: &[impl Grain<D>],
    skin: f64,
    cell: &Lattice<D>,
    apart: bool,
) -> (Rows, Vec<Image<D>>) {
    let reach = 2.0 * largest_radius(grains) + skin;
    let images = cell.images(grains, reach);
    let placed = |image: &Image<D>| {
        let grain = &grains[image.owner as usize];
        cell.image(&Placed { centre: grain.centre(), radius: grain.radius() }, image.shift)
    };
    let placed: Vec<Placed<D>> = images.iter().map(placed).collect();
    let between = |i: usize, m: u32| {
        let image = &images[m as usize];
        let shift = std::array::from_fn(|k| image.shift[k].wrapping_sub(images[i].shift[k]));
        Image { owner: image.owner, shift }
    };
    // Partners of each grain, as numbers of images.
    let (mut partners, mut end) = (Vec::new(), vec![0]);
    if !grains.is_empty() {
        let grid = Grid::new(&placed, reach);
        for (i, a) in placed[..grains.len()].iter().enumerate() {
            grid.around(a.centre(), |m| {
                let partner = between(i, m);
                if forward(i as u32, partner.owner, partner.shift) && near(a, &placed[m as usize], skin) {
                    partners.push(m);
                }
            });
            end.push(partners.len());
        }
    }
    drop(placed);
    let count = grains.len();
    let of = |i: usize| partners[end[i]..end[i + 1]].iter().map(move |&m| between(i, m));
    let mut ghosts: Vec<Image<D>> = (0..count).flat_map(of).filter(|g| g.shift != [0; D]).collect();
    ghosts.sort_unstable();
    ghosts.dedup();
    let rows = Rows::build_periodic([count, count + ghosts.len(), partners.len()], apart, |i, row| {
        row.extend(of(i).map(|partner| index_of(&partner, count, &ghosts).unwrap_or(u32::MAX)));
    });
    (rows, ghosts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Copy)]
    struct Point<const D: usize>([f64; D], f64);

    impl<const D: usize> Grain<D> for Point<D> {
        fn centre(&self) -> [f64; D] {
            self.0
        }
        fn radius(&self) -> f64 {
            self.1
        }
        fn at(self, centre: [f64; D]) -> Self {
            Self(centre, self.1)
        }
    }

    /// Points without regular structure: fractional parts of multiples of irrational numbers.
    fn points<const D: usize>(count: u32, radius: f64) -> Vec<Point<D>> {
        let u = |k: u32, a: f64| (a * f64::from(k)).fract();
        let axes = [0.618_034, 0.414_214, 0.324_718];
        let at = |k| std::array::from_fn(|axis| u(k, axes[axis]));
        (1..=count).map(|k| Point(at(k), radius * (1.0 + 2.0 * u(k, 0.732_051)))).collect()
    }

    fn compare<const D: usize>(grains: &[Point<D>], skin: f64) {
        let found = pairs_within(grains, skin);
        for i in 0..grains.len() {
            let expected: Vec<u32> = (i + 1..grains.len())
                .filter(|&j| near(&grains[i], &grains[j], skin))
                .map(|j| j as u32)
                .collect();
            assert_eq!(&found.j()[found.of_rows(i..i + 1)], &expected, "row {i}");
        }
        assert!(found.len() > 100);
    }

    #[test]
    fn grid_finds_what_brute_force_finds() {
        compare(&points::<2>(300, 0.01), 0.01);
        compare(&points::<3>(300, 0.02), 0.02);
    }

    /// In a tilted cell, all pairs of a grain and an image of another one (or of itself) are found once.
    #[test]
    fn images_across_the_border_are_found_once() {
        let cell =
            Lattice { origin: [0.1, -0.2, 0.3], edges: [[1.0, 0.0, 0.0], [0.3, 0.9, 0.0], [-0.2, 0.4, 1.1]] };
        let mut grains = points::<3>(80, 0.05);
        for grain in &mut grains {
            // Grains may lie anywhere, in other cells, too.
            grain.0 = cell.point(grain.0.map(|x| 3.0 * x - 1.0));
        }
        let skin = 0.05;
        let (rows, ghosts) = pairs_within_cell(&grains, skin, &cell, false);
        let mut found: Vec<(u32, Image<3>)> = Vec::new();
        for (&i, &j) in rows.i().iter().zip(rows.j()) {
            let image = match (j as usize).checked_sub(grains.len()) {
                None => Image { owner: j, shift: [0; 3] },
                Some(ghost) => ghosts[ghost],
            };
            found.push((i, image));
        }
        let mut expected = Vec::new();
        let number = |code: i32, place: u32| code / 13i32.pow(place) % 13 - 6;
        for i in 0..grains.len() as u32 {
            for j in 0..grains.len() as u32 {
                for code in 0..13i32.pow(3) {
                    let shift = [number(code, 0), number(code, 1), number(code, 2)];
                    let b = cell.image(&grains[j as usize], shift);
                    if forward(i, j, shift) && near(&grains[i as usize], &b, skin) {
                        expected.push((i, Image { owner: j, shift }));
                    }
                }
            }
        }
        found.sort_unstable();
        expected.sort_unstable();
        assert_eq!(found, expected);
        assert!(found.len() > 100);
    }
}
