//! Search for pairs of discs that are near each other, by sorting the discs into a grid of square cells.

use crate::contacts::PairList;
use crate::disc::Disc;
use crate::periodic::{Cell, Image, forward, index_of};

/// Uniform grid over the bounding box of the centres: `first[c]..first[c + 1]` of `disc` are the discs of cell c.
struct Grid {
    origin: [f64; 2],
    cell: f64,
    columns: usize,
    lines: usize,
    first: Vec<u32>,
    disc: Vec<u32>,
}

impl Grid {
    fn new(discs: &[Disc], cell: f64) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for d in discs {
            low = [low[0].min(d.x), low[1].min(d.y)];
            high = [high[0].max(d.x), high[1].max(d.y)];
        }
        // Limits the grid to a few cells per disc: a single disc far away from the others must not make it huge.
        let extent = (high[0] - low[0]).max(high[1] - low[1]);
        let cell = cell.max(extent / (4.0 * discs.len() as f64).sqrt().max(1.0) / 4.0);
        let count = |k: usize| ((high[k] - low[k]) / cell) as usize + 1;
        let mut grid = Self {
            origin: low,
            cell,
            columns: count(0),
            lines: count(1),
            first: Vec::new(),
            disc: vec![0; discs.len()],
        };
        grid.fill(discs);
        grid
    }

    fn column_and_line(&self, disc: &Disc) -> (usize, usize) {
        let index = |x: f64, k: usize| ((x - self.origin[k]) / self.cell) as usize;
        (index(disc.x, 0), index(disc.y, 1))
    }

    /// Counting sort of the discs by cell.
    fn fill(&mut self, discs: &[Disc]) {
        let cell_of = |grid: &Self, disc: &Disc| {
            let (column, line) = grid.column_and_line(disc);
            line * grid.columns + column
        };
        let mut first = vec![0u32; self.columns * self.lines + 1];
        for disc in discs {
            first[cell_of(self, disc) + 1] += 1;
        }
        for c in 1..first.len() {
            first[c] += first[c - 1];
        }
        let mut next = first.clone();
        for (i, disc) in (0u32..).zip(discs) {
            let slot = &mut next[cell_of(self, disc)];
            self.disc[*slot as usize] = i;
            *slot += 1;
        }
        self.first = first;
    }

    /// Calls `visit` with every disc in the 3 × 3 grid cells around `disc`.
    fn around(&self, disc: &Disc, mut visit: impl FnMut(u32)) {
        let (column, line) = self.column_and_line(disc);
        let columns = column.saturating_sub(1)..=(column + 1).min(self.columns - 1);
        for l in line.saturating_sub(1)..=(line + 1).min(self.lines - 1) {
            // The cells of one grid line are adjacent in memory, so the three neighbours are one range.
            let from = self.first[l * self.columns + columns.start()] as usize;
            let to = self.first[l * self.columns + columns.end() + 1] as usize;
            self.disc[from..to].iter().for_each(|&j| visit(j));
        }
    }
}

/// All pairs whose surfaces are closer than `skin` [m].
pub(crate) fn pairs_within(discs: &[Disc], skin: f64) -> PairList {
    if discs.is_empty() {
        return PairList::build(0, |_, _| ());
    }
    let largest = discs.iter().fold(0.0f64, |r, d| r.max(d.radius));
    let grid = Grid::new(discs, 2.0 * largest + skin);
    PairList::build(discs.len(), |i, row| {
        let a = &discs[i];
        grid.around(a, |j| {
            let b = &discs[j as usize];
            let reach = a.radius + b.radius + skin;
            let (dx, dy) = (b.x - a.x, b.y - a.y);
            if j as usize > i && dx * dx + dy * dy < reach * reach {
                row.push(j);
            }
        });
    })
}

/// All pairs closer than `skin` [m], images across the periodic border included; and these images (ghosts), which are
/// numbered after the discs.
pub(crate) fn pairs_within_cell(discs: &[Disc], skin: f64, cell: &Cell) -> (PairList, Vec<Image>) {
    let largest = discs.iter().fold(0.0f64, |r, d| r.max(d.radius));
    let images = cell.images(discs, 2.0 * largest + skin);
    let placed: Vec<Disc> =
        images.iter().map(|image| cell.image(&discs[image.owner as usize], image.shift)).collect();
    let mut rows: Vec<Vec<Image>> = vec![Vec::new(); discs.len()];
    if !discs.is_empty() {
        let grid = Grid::new(&placed, 2.0 * largest + skin);
        for (i, row) in rows.iter_mut().enumerate() {
            grid.around(&placed[i], |m| {
                let (a, b, image) = (&placed[i], &placed[m as usize], &images[m as usize]);
                let shift = [0, 1].map(|k| image.shift[k].wrapping_sub(images[i].shift[k]));
                let reach = a.radius + b.radius + skin;
                let (dx, dy) = (b.x - a.x, b.y - a.y);
                if forward(i as u32, image.owner, shift) && dx * dx + dy * dy < reach * reach {
                    row.push(Image { owner: image.owner, shift });
                }
            });
        }
    }
    let mut ghosts: Vec<Image> = rows.iter().flatten().copied().filter(|g| g.shift != [0, 0]).collect();
    ghosts.sort_unstable();
    ghosts.dedup();
    let count = discs.len();
    let list = PairList::build_over(count, count + ghosts.len(), (1, count.max(1)), |i, row| {
        row.extend(rows[i].iter().map(|partner| index_of(partner, count, &ghosts).unwrap_or(u32::MAX)));
    });
    (list, ghosts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grid_finds_what_brute_force_finds() {
        // Points without regular structure: fractional parts of multiples of irrational numbers.
        let discs: Vec<Disc> = (1..=300)
            .map(|k| {
                let u = |a: f64| (a * f64::from(k)).fract();
                Disc::at_rest(u(0.618_034), u(0.414_214), 0.01 + 0.02 * u(0.732_051), 1.0)
            })
            .collect();
        let skin = 0.01;
        let found = pairs_within(&discs, skin);
        for i in 0..discs.len() {
            let expected: Vec<u32> = (i + 1..discs.len())
                .filter(|&j| {
                    let (a, b) = (&discs[i], &discs[j]);
                    (b.x - a.x).hypot(b.y - a.y) < a.radius + b.radius + skin
                })
                .map(|j| j as u32)
                .collect();
            assert_eq!(&found.j()[found.of_rows(i..i + 1)], &expected, "row {i}");
        }
    }
}
