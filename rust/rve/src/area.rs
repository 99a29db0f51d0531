//! Exact area of a union of discs inside a convex polygon, and from it the porosity with overlaps counted once.
//!
//! The border of (union ∩ polygon) consists of the arcs of discs that lie in no other disc and inside the polygon,
//! and of the parts of the polygon's edges that lie in a disc. Green's theorem, ½ ∮ (x dy − y dx), sums them in
//! closed form: exact for any number of overlaps, and for discs that stick out of the walls.
//!
//! The packing procedure stops at a porosity that is computed here, so this module uses no function of the platform's
//! mathematical library, whose last digits differ between platforms (`libm` instead).

use crate::region::{Polygon, whole_box};
use libm::{acos, atan2, cos, sin};
use msdd_dem::{Cell, Disc, Simulation};
use std::f64::consts::{PI, TAU};

/// Porosity of the region [-], overlaps counted once: 1 − area(union ∩ region) / area(region). For a periodic box it is
/// always the porosity of the whole cell, whatever the region.
pub fn porosity(simulation: &Simulation, region: &Polygon) -> f64 {
    if let Some(cell) = simulation.cell() {
        return 1.0 - covered_cell(simulation, &cell) / simulation.walls.area();
    }
    1.0 - union_area(&simulation.discs, &overlapping(simulation), region) / region.area()
}

/// Porosity of the whole box [-].
pub fn porosity_of_box(simulation: &Simulation) -> f64 {
    porosity(simulation, &whole_box(simulation))
}

/// Area of the union of all discs and their images in the cell [m²], computed over the rectangle W × H with all images
/// that reach into it.
fn covered_cell(simulation: &Simulation, cell: &Cell) -> f64 {
    let discs = &simulation.discs;
    let images = cell.images(discs, discs.iter().map(|d| d.radius).fold(0.0, f64::max));
    let mut of_owner = vec![Vec::new(); discs.len()];
    for (k, image) in images.iter().enumerate() {
        of_owner[image.owner as usize].push(k);
    }
    let mut partners = vec![Vec::new(); images.len()];
    simulation.for_each_contact(|contact| {
        let Ok(i) = contact.i else { return };
        for &p in &of_owner[i] {
            let touched = [0, 1].map(|k| images[p].shift[k] + contact.shift[k]);
            // Images outside of `images` are too far from the rectangle to cover a part of it.
            if let Some(&q) = of_owner[contact.j].iter().find(|&&q| images[q].shift == touched) {
                partners[p].push(q);
                partners[q].push(p);
            }
        }
    });
    let placed: Vec<Disc> =
        images.iter().map(|image| cell.image(&discs[image.owner as usize], image.shift)).collect();
    union_area(&placed, &partners, &whole_box(simulation))
}

/// For each disc the numbers of the discs that overlap it.
fn overlapping(simulation: &Simulation) -> Vec<Vec<usize>> {
    let mut partners = vec![Vec::new(); simulation.discs.len()];
    simulation.for_each_contact(|contact| {
        if let Ok(i) = contact.i {
            partners[i].push(contact.j);
            partners[contact.j].push(i);
        }
    });
    partners
}

/// Area of (union of the discs) ∩ region \[m²\]. `partners[i]` lists the discs that overlap disc i.
pub fn union_area(discs: &[Disc], partners: &[Vec<usize>], region: &Polygon) -> f64 {
    // Coordinates relative to a corner keep the cancelling terms small.
    let origin = region.corners[0];
    let arcs: f64 = (0..discs.len()).map(|i| free_arcs(i, discs, &partners[i], region, origin)).sum();
    let edges: f64 = region.edges().map(|(a, b)| covered_edge(a, b, discs, origin)).sum();
    arcs + edges
}

/// Σ area(disc ∩ region) \[m²\]: an area that n discs cover counts n times.
pub fn sum_of_areas(discs: &[Disc], region: &Polygon) -> f64 {
    discs.iter().map(|disc| union_area(std::slice::from_ref(disc), &[Vec::new()], region)).sum()
}

/// ½ ∮ over the arcs of disc `i` that lie in none of its partners and inside the region.
fn free_arcs(i: usize, discs: &[Disc], partners: &[usize], region: &Polygon, origin: [f64; 2]) -> f64 {
    let disc = &discs[i];
    let mut hidden = Vec::new();
    for &j in partners {
        let other = &discs[j];
        let (dx, dy) = (other.x - disc.x, other.y - disc.y);
        let d = (dx * dx + dy * dy).sqrt();
        if d + disc.radius <= other.radius {
            return 0.0;
        }
        if d + other.radius > disc.radius {
            let cosine =
                (d * d + disc.radius * disc.radius - other.radius * other.radius) / (2.0 * d * disc.radius);
            hide(&mut hidden, atan2(dy, dx), acos(cosine.clamp(-1.0, 1.0)));
        }
    }
    for (a, b) in region.edges() {
        let length = distance(a, b);
        let outward = [(b[1] - a[1]) / length, (a[0] - b[0]) / length];
        let inside = -((disc.x - a[0]) * outward[0] + (disc.y - a[1]) * outward[1]);
        if inside <= -disc.radius {
            return 0.0;
        }
        if inside < disc.radius {
            hide(&mut hidden, atan2(outward[1], outward[0]), acos(inside / disc.radius));
        }
    }
    let (x, y, r) = (disc.x - origin[0], disc.y - origin[1], disc.radius);
    gaps(&mut hidden, 0.0, TAU)
        .map(|(from, to)| {
            let (sine, cosine) = (sin(to) - sin(from), cos(to) - cos(from));
            0.5 * r * (r * (to - from) + x * sine - y * cosine)
        })
        .sum()
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    (dx * dx + dy * dy).sqrt()
}

/// Adds the angles within `half` of `middle` to the intervals, wrapped into [0, 2π].
fn hide(hidden: &mut Vec<(f64, f64)>, middle: f64, half: f64) {
    if half >= PI {
        hidden.push((0.0, TAU));
        return;
    }
    let from = (middle - half).rem_euclid(TAU);
    let to = from + 2.0 * half;
    hidden.push((from, to.min(TAU)));
    if to > TAU {
        hidden.push((0.0, to - TAU));
    }
}

/// The parts of [low, high] that no interval covers.
fn gaps(intervals: &mut [(f64, f64)], low: f64, high: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
    intervals.sort_by(|a, b| a.0.total_cmp(&b.0));
    let end = std::iter::once((high, high));
    let mut reached = low;
    intervals.iter().copied().chain(end).filter_map(move |(from, to)| {
        let gap = (from > reached).then_some((reached, from));
        reached = reached.max(to);
        gap
    })
}

/// ½ ∮ over the part of the edge a–b that lies in some disc.
fn covered_edge(a: [f64; 2], b: [f64; 2], discs: &[Disc], origin: [f64; 2]) -> f64 {
    let length = distance(a, b);
    let along = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
    let mut covered: Vec<(f64, f64)> = discs
        .iter()
        .filter_map(|disc| {
            let (dx, dy) = (disc.x - a[0], disc.y - a[1]);
            let foot = dx * along[0] + dy * along[1];
            let height = dx * along[1] - dy * along[0];
            let half2 = disc.radius * disc.radius - height * height;
            let half = half2.max(0.0).sqrt();
            let (from, to) = ((foot - half).max(0.0), (foot + half).min(length));
            (half2 > 0.0 && from < to).then_some((from, to))
        })
        .collect();
    let open: f64 = gaps(&mut covered, 0.0, length).map(|(from, to)| to - from).sum();
    // x dy − y dx along a straight line is its moment about the origin times the length.
    let moment = (a[0] - origin[0]) * along[1] - (a[1] - origin[1]) * along[0];
    0.5 * moment * (length - open)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc(x: f64, y: f64, r: f64) -> Disc {
        Disc::at_rest(x, y, r, 1.0)
    }

    fn all_overlaps(discs: &[Disc]) -> Vec<Vec<usize>> {
        let touch = |a: &Disc, b: &Disc| (a.x - b.x).hypot(a.y - b.y) < a.radius + b.radius;
        let others = |i: usize| (0..discs.len()).filter(move |&j| j != i);
        (0..discs.len()).map(|i| others(i).filter(|&j| touch(&discs[i], &discs[j])).collect()).collect()
    }

    fn area(discs: &[Disc], region: &Polygon) -> f64 {
        union_area(discs, &all_overlaps(discs), region)
    }

    #[test]
    fn one_disc_whole_halved_quartered() {
        let d = [disc(0.0, 0.0, 1.0)];
        for (low, share) in [([-2.0, -2.0], 1.0), ([0.0, -2.0], 0.5), ([0.0, 0.0], 0.25)] {
            let region = Polygon::rectangle(low, [2.0, 2.0]);
            assert!((area(&d, &region) - share * PI).abs() < 1e-14);
        }
    }

    #[test]
    fn two_discs_lose_their_lens() {
        let d = [disc(0.0, 0.0, 1.0), disc(1.0, 0.0, 1.0)];
        let lens = 2.0 * PI / 3.0 - 0.75f64.sqrt();
        let region = Polygon::rectangle([-3.0, -3.0], [3.0, 3.0]);
        assert!((area(&d, &region) - (2.0 * PI - lens)).abs() < 1e-14);
        assert!((sum_of_areas(&d, &region) - 2.0 * PI).abs() < 1e-14);
    }

    /// Three discs with a common part, cut by a triangle, compared with counting the points of a fine grid.
    #[test]
    fn triple_overlap_in_a_triangle_agrees_with_counting() {
        let d = [disc(0.0, 0.0, 1.0), disc(0.8, 0.1, 0.7), disc(0.3, 0.7, 0.6), disc(-0.2, 0.1, 0.2)];
        let region = Polygon { corners: vec![[-0.9, -0.4], [1.3, -0.2], [0.4, 1.2]] };
        let n = 2000;
        let cell = 3.0 / f64::from(n);
        let count = (0..n * n)
            .filter(|k| {
                let p = [-1.5 + cell * (f64::from(k % n) + 0.5), -1.5 + cell * (f64::from(k / n) + 0.5)];
                region.contains(p) && d.iter().any(|d| (d.x - p[0]).hypot(d.y - p[1]) < d.radius)
            })
            .count();
        let counted = count as f64 * cell * cell;
        assert!((area(&d, &region) - counted).abs() < 2e-4, "{} {counted}", area(&d, &region));
    }
}
