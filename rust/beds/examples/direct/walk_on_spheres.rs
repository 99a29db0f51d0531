//! Direct solutions of the heat equation in the gas between isothermal spheres and plates, by random walks: to hold the laws of
//! [`msdd_beds::plate_view_areas`] and [`msdd_beds::conductances`] against, for spheres that conduct without limit.
//!
//! In a body without sources the temperature at a point is the mean over any sphere around it. So a walk that jumps to a random point
//! of the largest sphere around it without a surface inside, again and again, ends at each surface as often as that surface's
//! temperature counts at the start (Muller, Ann. Math. Stat. 27, 569, 1956). There is no grid; the error is that of the number of walks.
//!
//! Two isothermal bodies of many exchange G (T₁ − T₂), with a G that depends on all of them: so the G found are those of an exact
//! network.

use super::voxels::Ball;
use msdd_beds::random::Random;
use std::f64::consts::{PI, TAU};

/// A walk ends so near to a surface, over the largest radius.
const END: f64 = 1e-4;

/// Balls between a plate at z = 0 and one at z = `depth`, repeated along x and y.
#[derive(Clone, Debug)]
pub struct Room {
    /// Periods along x and y, four radii at least.
    edges: [f64; 2],
    depth: f64,
    balls: Vec<Ball>,
    cells: Vec<Vec<u32>>,
    counts: [usize; 3],
    largest: f64,
}

/// Where walks from a body ended, as conductances over k_g.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exchange {
    pub balls: Vec<f64>,
    /// At z = 0 and z = depth.
    pub plates: [f64; 2],
}

/// What a walk meets.
#[derive(Clone, Copy)]
enum End {
    Ball(usize),
    Plate(usize),
}

impl Room {
    pub fn new(edges: [f64; 2], depth: f64, mut balls: Vec<Ball>) -> Self {
        let largest = balls.iter().map(|ball| ball.radius).fold(0.0, f64::max);
        let largest = if balls.is_empty() { depth } else { largest };
        let counts =
            [edges[0], edges[1], depth].map(|length| ((0.5 * length / largest) as usize).clamp(1, 200));
        for ball in &mut balls {
            (0..2).for_each(|k| ball.centre[k] = ball.centre[k].rem_euclid(edges[k]));
        }
        let cells = vec![Vec::new(); counts.iter().product()];
        let mut room = Self { edges, depth, balls, cells, counts, largest };
        for k in 0..room.balls.len() {
            let home = room.number(room.place(room.balls[k].centre));
            room.cells[home].push(k as u32);
        }
        room
    }

    fn place(&self, point: [f64; 3]) -> [usize; 3] {
        let lengths = [self.edges[0], self.edges[1], self.depth];
        std::array::from_fn(|k| {
            let cell = (point[k].max(0.0) / lengths[k] * self.counts[k] as f64) as usize;
            cell.min(self.counts[k] - 1)
        })
    }

    fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.counts[1] + y) * self.counts[0] + x
    }

    /// Distance to the nearest ball but one, at most the largest radius, and its number.
    fn nearest(&self, point: [f64; 3], but: Option<usize>) -> (f64, Option<usize>) {
        let home = self.place(point);
        let mut best = (self.largest, None);
        // Three cells around, or all if there are fewer.
        let around = |axis: usize| (0..self.counts[axis].min(3)).map(move |step| (axis, step));
        let across =
            |(axis, step): (usize, usize)| (home[axis] + self.counts[axis] + step - 1) % self.counts[axis];
        for z in home[2].saturating_sub(1)..(home[2] + 2).min(self.counts[2]) {
            for y in around(1).map(across) {
                for x in around(0).map(across) {
                    for &k in &self.cells[self.number([x, y, z])] {
                        let k = k as usize;
                        let ball = &self.balls[k];
                        let square: f64 = self.away(point, ball.centre).map(|x| x * x).iter().sum();
                        let reach = best.0 + ball.radius;
                        if square < reach * reach && but != Some(k) {
                            best = (square.sqrt() - ball.radius, Some(k));
                        }
                    }
                }
            }
        }
        best
    }

    /// From a point to the nearest image of another.
    fn away(&self, from: [f64; 3], to: [f64; 3]) -> [f64; 3] {
        let mut away: [f64; 3] = std::array::from_fn(|k| to[k] - from[k]);
        for (away, edge) in away.iter_mut().zip(self.edges) {
            *away -= edge * (*away / edge).round();
        }
        away
    }

    fn walk(&self, mut point: [f64; 3], random: &mut Random) -> End {
        let end = END * self.largest;
        loop {
            (0..2).for_each(|k| point[k] = point[k].rem_euclid(self.edges[k]));
            if point[2] < end {
                return End::Plate(0);
            }
            if self.depth - point[2] < end {
                return End::Plate(1);
            }
            let (distance, ball) = self.nearest(point, None);
            match ball {
                Some(ball) if distance < end => return End::Ball(ball),
                _ => {}
            }
            let step = distance.min(point[2]).min(self.depth - point[2]);
            let direction = direction(random.uniform(-1.0, 1.0), random);
            point = std::array::from_fn(|k| point[k] + step * direction[k]);
        }
    }

    /// Between the plate at z = 0 and all else, by `side`² walks from its part from the origin to `part`. The flux at a point is 3/(2 r)
    /// of the mean temperature on half a ball of radius r around it, weighted by the cosine.
    pub fn exchange_of_plate(&self, part: [f64; 2], side: usize, random: &mut Random) -> Exchange {
        let mut found = Exchange { balls: vec![0.0; self.balls.len()], plates: [0.0; 2] };
        let area = part[0] * part[1] / (side * side) as f64;
        for place in 0..side * side {
            let place = [place % side, place / side];
            let across = |k: usize, random: &mut Random| {
                (place[k] as f64 + random.uniform(0.0, 1.0)) / side as f64 * part[k]
            };
            let start = [across(0, random), across(1, random), 0.0];
            let r = self.nearest(start, None).0.min(self.depth);
            let direction = direction(random.uniform(0.0, 1.0).sqrt(), random);
            let end = self.walk(std::array::from_fn(|k| start[k] + r * direction[k]), random);
            found.count(end, 1.5 * area / r);
        }
        found
    }

    /// Between a ball and all else, by walks from a sphere around it that just meets the nearest surface. None if another
    /// surface touches it.
    pub fn exchange_of_ball(&self, number: usize, walks: usize, random: &mut Random) -> Option<Exchange> {
        let Ball { centre, radius } = self.balls[number];
        let others = self.balls.iter().enumerate().filter(|(k, _)| *k != number).map(|(_, other)| {
            let away = self.away(centre, other.centre);
            away.map(|x| x * x).iter().sum::<f64>().sqrt() - other.radius
        });
        let plates = [centre[2], self.depth - centre[2]].into_iter();
        let free = others.chain(plates).fold(2.0 * radius, f64::min) - radius;
        if free <= END * self.largest {
            return None;
        }
        let mut found = Exchange { balls: vec![0.0; self.balls.len()], plates: [0.0; 2] };
        let each = 4.0 * PI * radius * (radius + free) / free / walks as f64;
        for _ in 0..walks {
            let direction = direction(random.uniform(-1.0, 1.0), random);
            let start = std::array::from_fn(|k| centre[k] + (radius + free) * direction[k]);
            found.count(self.walk(start, random), each);
        }
        found.balls[number] = 0.0;
        Some(found)
    }
}

impl Exchange {
    fn count(&mut self, end: End, conductance: f64) {
        match end {
            End::Ball(ball) => self.balls[ball] += conductance,
            End::Plate(plate) => self.plates[plate] += conductance,
        }
    }
}

/// The unit vector with a component along z and a random angle around it.
fn direction(along: f64, random: &mut Random) -> [f64; 3] {
    let angle = random.uniform(0.0, TAU);
    let across = (1.0 - along * along).max(0.0).sqrt();
    [across * libm::cos(angle), across * libm::sin(angle), along]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Between two plates without balls: area over distance.
    #[test]
    fn plates_exchange_area_over_distance() {
        let room = Room::new([3.0, 2.0], 1.5, Vec::new());
        let found = room.exchange_of_plate([3.0, 2.0], 100, &mut Random::new(1));
        assert!((found.plates[1] / 4.0 - 1.0).abs() < 0.02, "{found:?}");
    }

    /// A ball before a plate that is alone: 4π R sinh α Σ 1/sinh(n α) with cosh α = D/R (two spheres of opposite potential; Smythe, Static
    /// and Dynamic Electricity, 1950, section 5.08). The plate at the other side and the images of the ball are far away.
    #[test]
    fn a_ball_and_a_plate_exchange_what_images_say() {
        let (radius, distance) = (1.0, 1.1f64);
        let alpha = distance.acosh();
        let sum: f64 = (1..200).map(|n| 1.0 / (f64::from(n) * alpha).sinh()).sum();
        let expected = 4.0 * PI * radius * alpha.sinh() * sum;
        let room = Room::new([16.0; 2], 16.0, vec![Ball { centre: [8.0, 8.0, distance], radius }]);
        let found = room.exchange_of_ball(0, 100_000, &mut Random::new(2)).expect("it touches nothing");
        // Of the field lines that leave upwards, some go to the plate at the other side instead.
        let all = found.plates[0] + found.plates[1];
        assert!((all / expected - 1.0).abs() < 0.02, "{found:?} {expected}");
        let back = room.exchange_of_plate([16.0; 2], 400, &mut Random::new(3));
        assert!((back.balls[0] / found.plates[0] - 1.0).abs() < 0.04, "{back:?} {found:?}");
    }
}
