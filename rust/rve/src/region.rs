//! Averaging regions: convex polygons.

use msdd_dem::Simulation;
use serde::{Deserialize, Serialize};

/// Which part of an RVE is averaged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RegionKind {
    /// Convex hull of the centres of the discs that carry force and touch no wall (paper, section 2.4). Only
    /// force-bearing discs count, because a drifting rattler would move the hull.
    Hull,
    /// The box inset by 0.8 r̄ from the walls (authors' later code). It agrees with windows of a large assembly as well
    /// as the hull does, and varies more smoothly along ramps, see this crate's README.
    #[default]
    Inset,
    /// The whole box, wall contacts left out. A periodic box is always averaged over its whole cell.
    Cell,
}

msdd_beds::named!(RegionKind);

/// How contacts that cross the border of the region count in K and σ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cut {
    /// Weighted by the share of the branch that lies inside.
    #[default]
    Clip,
    /// With their whole branch (paper, section 2.4): overestimates by 3–6 % with 500 discs.
    Whole,
}

/// Share with which the contact between discs i and j counts in the averages over a region. In a periodic box, whose
/// averages are over its cell, every contact counts once with its whole branch.
pub(crate) fn contact_share(simulation: &Simulation, region: &Polygon, cut: Cut, [i, j]: [usize; 2]) -> f64 {
    if simulation.periodic.is_some() {
        return 1.0;
    }
    let (a, b) = (&simulation.discs[i], &simulation.discs[j]);
    match (region.share_inside([a.x, a.y], [b.x, b.y]), cut) {
        (share, Cut::Whole) if share > 0.0 => 1.0,
        (share, _) => share,
    }
}

/// Inset over the mean radius, authors' code.
const INSET: f64 = 0.8;

/// A convex polygon, counter-clockwise \[m\].
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    pub corners: Vec<[f64; 2]>,
}

fn cross(o: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
}

impl Polygon {
    pub fn rectangle(low: [f64; 2], high: [f64; 2]) -> Self {
        Self { corners: vec![low, [high[0], low[1]], high, [low[0], high[1]]] }
    }

    /// Convex hull by Andrew's monotone chain.
    pub fn hull(mut points: Vec<[f64; 2]>) -> Self {
        points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        let mut corners = half_hull(points.iter());
        corners.extend(half_hull(points.iter().rev()));
        Self { corners }
    }

    /// The edges as (from, to).
    pub fn edges(&self) -> impl Iterator<Item = ([f64; 2], [f64; 2])> + '_ {
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(next).map(|(&a, &b)| (a, b))
    }

    /// Area \[m²\]. The triangles from the middle of the bounding box are summed in the order of their size, so that the
    /// result is the same to the last bit whichever corner comes first, and after a quarter turn.
    pub fn area(&self) -> f64 {
        let Some(&first) = self.corners.first() else { return 0.0 };
        let (low, high) = self.corners.iter().fold((first, first), |(low, high), c| {
            ([low[0].min(c[0]), low[1].min(c[1])], [high[0].max(c[0]), high[1].max(c[1])])
        });
        let middle = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])];
        let mut triangles: Vec<f64> = self.edges().map(|(a, b)| cross(middle, a, b)).collect();
        triangles.sort_by(f64::total_cmp);
        0.5 * triangles.iter().sum::<f64>()
    }

    pub fn contains(&self, point: [f64; 2]) -> bool {
        self.edges().all(|(a, b)| cross(a, b, point) >= 0.0)
    }

    /// Share of the segment a–b that lies inside, 0 to 1 (Cyrus–Beck).
    pub fn share_inside(&self, a: [f64; 2], b: [f64; 2]) -> f64 {
        let (mut enter, mut leave) = (0.0f64, 1.0f64);
        for (p, q) in self.edges() {
            let (at_a, at_b) = (cross(p, q, a), cross(p, q, b));
            if at_a < 0.0 && at_b < 0.0 {
                return 0.0;
            }
            if at_a < 0.0 {
                enter = enter.max(at_a / (at_a - at_b));
            } else if at_b < 0.0 {
                leave = leave.min(at_a / (at_a - at_b));
            }
        }
        (leave - enter).max(0.0)
    }
}

/// One chain of the hull, without its last point.
fn half_hull<'a>(points: impl Iterator<Item = &'a [f64; 2]>) -> Vec<[f64; 2]> {
    let mut chain: Vec<[f64; 2]> = Vec::new();
    for &point in points {
        while chain.len() >= 2 && cross(chain[chain.len() - 2], chain[chain.len() - 1], point) <= 0.0 {
            chain.pop();
        }
        chain.push(point);
    }
    chain.pop();
    chain
}

/// The whole box; for a periodic box the rectangle W × H, which contains each point of the cell once.
pub fn whole_box(simulation: &Simulation) -> Polygon {
    let [left, right, bottom, top] = simulation.walls.position;
    Polygon::rectangle([left, bottom], [right, top])
}

/// The averaging region of an RVE; for a periodic box always its cell. When fewer than three discs span the hull, the
/// inset box is used instead.
pub fn region(simulation: &Simulation, kind: RegionKind) -> Polygon {
    let inset = || {
        let [left, right, bottom, top] = simulation.walls.position;
        let d = INSET * simulation.mean_radius();
        Polygon::rectangle([left + d, bottom + d], [right - d, top - d])
    };
    if let Some(cell) = simulation.cell() {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|fraction| cell.point(fraction));
        return Polygon { corners: corners.to_vec() };
    }
    match kind {
        RegionKind::Cell => whole_box(simulation),
        RegionKind::Inset => inset(),
        RegionKind::Hull => {
            let hull = Polygon::hull(inner_centres(simulation));
            if hull.corners.len() >= 3 { hull } else { inset() }
        }
    }
}

/// Centres of the discs that carry force and touch no wall.
fn inner_centres(simulation: &Simulation) -> Vec<[f64; 2]> {
    let mut carries = vec![false; simulation.discs.len()];
    let mut at_wall = carries.clone();
    simulation.for_each_contact(|contact| match contact.i {
        Ok(i) => (carries[i], carries[contact.j]) = (true, true),
        Err(_) => at_wall[contact.j] = true,
    });
    let discs = simulation.discs.iter().enumerate();
    discs.filter(|&(k, _)| carries[k] && !at_wall[k]).map(|(_, d)| [d.x, d.y]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hull_of_a_square_with_inner_points() {
        let mut points = vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.0], [1.0, 0.0]];
        points.push([0.5, 1.5]);
        let hull = Polygon::hull(points);
        assert_eq!(hull.corners.len(), 4);
        assert_eq!(hull.area(), 4.0);
        assert!(hull.contains([1.0, 1.9]) && !hull.contains([1.0, 2.1]));
    }

    #[test]
    fn share_of_a_segment() {
        let square = Polygon::rectangle([0.0, 0.0], [1.0, 1.0]);
        assert_eq!(square.share_inside([0.2, 0.5], [0.8, 0.5]), 1.0);
        assert_eq!(square.share_inside([-1.0, 0.5], [1.0, 0.5]), 0.5);
        assert_eq!(square.share_inside([-1.0, 0.5], [3.0, 0.5]), 0.25);
        assert_eq!(square.share_inside([-1.0, 0.5], [0.5, 2.0]), 0.0);
    }
}
