//! Straight rays between spheres and walls: which surface does a ray meet first?
//!
//! The spheres lie in a grid of cells along the edges of the periodic cell, so that a sheared cell is no special case: a ray is straight in
//! fractions of the edges, too. A ray goes from cell to cell and meets the spheres that reach into each.

use crate::random::Random;
use msdd_engine::Lattice;
use msdd_spheres::boundary::{Surface, Wall};
use msdd_spheres::space::{cross, dot, length, minus, plus, scaled};
use msdd_spheres::{Boundary, Simulation};
use std::f64::consts::TAU;

/// Edge of a cell of the grid over the largest diameter, about the least costly.
const CELL: f64 = 0.7;

/// What a ray meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Body {
    Sphere(u32),
    /// By the number of the wall.
    Wall(u32),
    /// Nothing: the ray leaves through an open side.
    Open,
}

/// Where a ray is or ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    pub body: Body,
    /// Which image of the body, in numbers of cells along the edges.
    pub shift: [i32; 3],
    /// \[m\], not wrapped into the cell.
    pub point: [f64; 3],
    /// Unit normal of the surface towards the space between the bodies.
    pub normal: [f64; 3],
}

/// An image of a sphere that reaches into a cell of the grid.
#[derive(Clone, Copy, Debug)]
struct Near {
    sphere: u32,
    shift: [i32; 3],
    centre: [f64; 3],
}

/// Spheres and walls between which rays go.
#[derive(Clone, Debug)]
pub struct Enclosure {
    lattice: Lattice<3>,
    /// Along which edges all repeats itself.
    periodic: [bool; 3],
    counts: [usize; 3],
    first: Vec<u32>,
    near: Vec<Near>,
    centres: Vec<[f64; 3]>,
    radii: Vec<f64>,
    walls: Vec<Wall>,
}

impl Enclosure {
    pub fn new(simulation: &Simulation) -> Self {
        let spheres: Vec<([f64; 3], f64)> =
            simulation.spheres.iter().map(|sphere| (sphere.position, sphere.radius)).collect();
        let around = |axis: usize| {
            let ends =
                |sign: f64| spheres.iter().map(move |(c, r)| sign * c[axis] + r).fold(-1e300, f64::max);
            [-ends(-1.0), ends(1.0)]
        };
        let (lattice, periodic) = match &simulation.boundary {
            Boundary::Periodic(cell) => (cell.lattice, [true; 3]),
            Boundary::Between(cell, _) => {
                let [low, high] = around(2);
                let (mut origin, [a, b, _]) = (cell.lattice.origin, cell.lattice.edges);
                origin[2] = low;
                (Lattice { origin, edges: [a, b, [0.0, 0.0, high - low]] }, [true, true, false])
            }
            Boundary::Walls(_) => {
                let ends = [0, 1, 2].map(around);
                let edge =
                    |k: usize| std::array::from_fn(|m| if m == k { ends[k][1] - ends[k][0] } else { 0.0 });
                (Lattice { origin: ends.map(|end| end[0]), edges: [0, 1, 2].map(edge) }, [false; 3])
            }
        };
        Self::of(&spheres, lattice, periodic, simulation.boundary.walls().to_vec())
    }

    /// Spheres (centre and radius \[m\]) in a cell that repeats itself along some edges, and walls.
    pub fn of(
        spheres: &[([f64; 3], f64)],
        lattice: Lattice<3>,
        periodic: [bool; 3],
        walls: Vec<Wall>,
    ) -> Self {
        let largest = spheres.iter().fold(0.0f64, |largest, (_, radius)| largest.max(*radius));
        // Heights of the cell over its faces, by which a length becomes a fraction of an edge.
        let [a, b, c] = lattice.edges;
        let volume = dot(a, cross(b, c)).abs();
        let heights = [cross(b, c), cross(c, a), cross(a, b)].map(|area| volume / length(area));
        let most = if spheres.is_empty() { 1 } else { 1000 };
        let counts = heights.map(|height| ((height / (2.0 * CELL * largest)) as usize).clamp(1, most));
        let mut cells: Vec<Vec<Near>> = vec![Vec::new(); counts.iter().product()];
        for (sphere, &(centre, radius)) in (0u32..).zip(spheres) {
            let fraction = lattice.fraction(centre);
            let ends: [[i64; 2]; 3] = std::array::from_fn(|k| {
                let half = radius / heights[k] * (1.0 + 1e-9);
                let count = counts[k] as f64;
                let ends = [fraction[k] - half, fraction[k] + half].map(|f| (f * count).floor() as i64);
                if periodic[k] { ends } else { ends.map(|end| end.clamp(0, counts[k] as i64 - 1)) }
            });
            for z in ends[2][0]..=ends[2][1] {
                for y in ends[1][0]..=ends[1][1] {
                    for x in ends[0][0]..=ends[0][1] {
                        let place = [x, y, z];
                        let (home, shift) = wrapped(place, counts);
                        let back = lattice.displacement(shift.map(|s| -s));
                        let near = Near { sphere, shift: shift.map(|s| -s), centre: plus(centre, 1.0, back) };
                        cells[home].push(near);
                    }
                }
            }
        }
        let mut first = vec![0];
        for cell in &cells {
            first.push(first[first.len() - 1] + cell.len() as u32);
        }
        let near = cells.into_iter().flatten().collect();
        let (centres, radii) = spheres.iter().copied().unzip();
        Self { lattice, periodic, counts, first, near, centres, radii, walls }
    }

    pub fn walls(&self) -> &[Wall] {
        &self.walls
    }

    pub fn radii(&self) -> &[f64] {
        &self.radii
    }

    /// From the centre of a sphere to that of an image of another \[m\].
    pub fn branch(&self, from: usize, to: usize, shift: [i32; 3]) -> [f64; 3] {
        minus(plus(self.centres[to], 1.0, self.lattice.displacement(shift)), self.centres[from])
    }

    /// A random point of the surface of a sphere.
    pub fn on_sphere(&self, sphere: usize, random: &mut Random) -> Spot {
        let (up, angle) = (random.uniform(-1.0, 1.0), random.uniform(0.0, TAU));
        let across = (1.0 - up * up).max(0.0).sqrt();
        let normal = [across * libm::cos(angle), across * libm::sin(angle), up];
        let point = plus(self.centres[sphere], self.radii[sphere], normal);
        Spot { body: Body::Sphere(sphere as u32), shift: [0; 3], point, normal }
    }

    /// Follows a ray from a spot until it is absorbed. `absorbed`: the share that a body absorbs, 1 for [`Body::Open`]. Surfaces emit and
    /// reflect diffusely.
    pub fn follow(&self, mut from: Spot, absorbed: impl Fn(Body) -> f64, random: &mut Random) -> Spot {
        loop {
            from = self.next(&from, diffuse(from.normal, random));
            if from.body == Body::Open || random.uniform(0.0, 1.0) < absorbed(from.body) {
                return from;
            }
        }
    }

    /// What a ray meets that leaves a spot in a direction (a unit vector).
    pub fn next(&self, from: &Spot, direction: [f64; 3]) -> Spot {
        let mut hit = self.wall_ahead(from, direction);
        let start = self.lattice.fraction(from.point);
        let rates = minus(self.lattice.fraction(plus(from.point, 1.0, direction)), start);
        let counts = self.counts.map(|count| count as f64);
        let place: [f64; 3] = std::array::from_fn(|k| start[k] * counts[k]);
        let rates: [f64; 3] = std::array::from_fn(|k| rates[k] * counts[k]);
        let mut cell = place.map(|x| x.floor() as i64);
        // Lengths of the ray to the next border along each edge.
        let mut border: [f64; 3] = std::array::from_fn(|k| {
            let ahead = if rates[k] > 0.0 { cell[k] as f64 + 1.0 } else { cell[k] as f64 };
            if rates[k] == 0.0 { f64::INFINITY } else { (ahead - place[k]) / rates[k] }
        });
        let mut entered = 0.0;
        // Spheres end where the grid does, along edges that do not repeat themselves.
        let beyond = |cell: &[i64; 3]| {
            (0..3).any(|k| {
                let last = self.counts[k] as i64 - 1;
                !self.periodic[k] && ((cell[k] < 0 && rates[k] <= 0.0) || (cell[k] > last && rates[k] >= 0.0))
            })
        };
        while entered < hit.0 && !beyond(&cell) {
            self.spheres_in(cell, from, direction, &mut hit);
            let k = (0..3).fold(0, |k, m| if border[m] < border[k] { m } else { k });
            entered = border[k];
            border[k] += 1.0 / rates[k].abs();
            cell[k] += if rates[k] > 0.0 { 1 } else { -1 };
        }
        let (distance, body, shift) = hit;
        let point = plus(from.point, if distance.is_finite() { distance } else { 0.0 }, direction);
        let normal = match body {
            Body::Sphere(j) => {
                let centre = plus(self.centres[j as usize], 1.0, self.lattice.displacement(shift));
                let out = minus(point, centre);
                scaled(1.0 / length(out), out)
            }
            Body::Wall(wall) => self.walls[wall as usize].foot(point).1,
            Body::Open => [0.0; 3],
        };
        Spot { body, shift, point, normal }
    }

    /// The nearest sphere of a cell that a ray meets, if that is before `hit`. A point within a sphere that touches the one it
    /// lies on has met it.
    fn spheres_in(&self, cell: [i64; 3], from: &Spot, direction: [f64; 3], hit: &mut (f64, Body, [i32; 3])) {
        let inside = (0..3).all(|k| self.periodic[k] || (0..self.counts[k] as i64).contains(&cell[k]));
        if !inside {
            return;
        }
        let (home, shift) = wrapped(cell, self.counts);
        let origin = minus(from.point, self.lattice.displacement(shift));
        for near in &self.near[self.first[home] as usize..self.first[home + 1] as usize] {
            let image: [i32; 3] = std::array::from_fn(|k| near.shift[k] + shift[k]);
            let to = minus(near.centre, origin);
            let along = dot(to, direction);
            let radius = self.radii[near.sphere as usize];
            let left = along * along - dot(to, to) + radius * radius;
            if left <= 0.0 || along + left.sqrt() <= 0.0 {
                continue;
            }
            let distance = (along - left.sqrt()).max(0.0);
            let own = from.body == Body::Sphere(near.sphere) && from.shift == image;
            if distance < hit.0 && !own {
                *hit = (distance, Body::Sphere(near.sphere), image);
            }
        }
    }

    /// The first wall that a ray meets.
    fn wall_ahead(&self, from: &Spot, direction: [f64; 3]) -> (f64, Body, [i32; 3]) {
        let mut hit = (f64::INFINITY, Body::Open, [0; 3]);
        for (number, wall) in (0u32..).zip(&self.walls) {
            let distance = match wall.surface {
                Surface::Flat { normal } => {
                    let towards = -dot(direction, normal);
                    if towards <= 0.0 || from.body == Body::Wall(number) {
                        continue;
                    }
                    wall.distance(from.point) / towards
                }
                Surface::Cylinder { axis, radius, .. } => {
                    let flat = |v: [f64; 3]| plus(v, -dot(v, axis), axis);
                    let (off, along) = (flat(minus(from.point, wall.point)), flat(direction));
                    let (a, b) = (dot(along, along), dot(off, along));
                    if a == 0.0 {
                        continue;
                    }
                    (-b + (b * b + a * (radius * radius - dot(off, off))).max(0.0).sqrt()) / a
                }
            };
            if distance.max(0.0) < hit.0 {
                hit = (distance.max(0.0), Body::Wall(number), [0; 3]);
            }
        }
        hit
    }
}

/// Number of a cell of the grid within the periodic cell, and in which image of that it lies.
fn wrapped(place: [i64; 3], counts: [usize; 3]) -> (usize, [i32; 3]) {
    let home = |k: usize| place[k].rem_euclid(counts[k] as i64) as usize;
    let shift = std::array::from_fn(|k| place[k].div_euclid(counts[k] as i64) as i32);
    ((home(2) * counts[1] + home(1)) * counts[0] + home(0), shift)
}

/// A random direction about a normal by Lambert's law.
fn diffuse(normal: [f64; 3], random: &mut Random) -> [f64; 3] {
    let (square, angle) = (random.uniform(0.0, 1.0), random.uniform(0.0, TAU));
    let other = if normal[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let first = cross(normal, other);
    let first = scaled(1.0 / length(first), first);
    let second = cross(normal, first);
    let across = square.sqrt();
    let direction = plus(
        plus(scaled((1.0 - square).sqrt(), normal), across * libm::cos(angle), first),
        across * libm::sin(angle),
        second,
    );
    scaled(1.0 / length(direction), direction)
}
