//! Which part of a plate, flat or the side of a cylinder, belongs to which sphere of a bed, and how far heat goes from there through the gas.
//!
//! Each point of the plate belongs to one sphere, the one of which it has the least power ρ² + D² − R² (of equal spheres, the nearest):
//! ρ is how far the point is from the foot of the centre, D how far the centre is from the plate. So the spheres share the plate without
//! overlap, and one that lies behind others has no part in it. The parts end at the other walls, and repeat with a periodic cell.
//!
//! From its point heat goes along the circular arc that meets both plate and sphere at right angles, as the field between two
//! isothermal bodies does near them. Its circle passes through the two points √(D² − R²) before and behind the foot, and its length is
//!
//! l = (ρ² + D² − R²)/ρ · arctan(ρ/(D + R)),
//!
//! which is the gap D − R at ρ = 0, as straight lines have it. At the side of a cylinder ρ and D are those of the plane that touches it
//! at the point, with which the arc is the same. The heat per area and kelvin is k_g/(l + e), with the distance e that
//! jumps and spreading in the solid add ([`crate::gas`]). No number is fitted. In beds whose spheres all have one temperature, the heat
//! through a plate is 2 to 6 % more by this law than by direct solutions (`examples/plates.rs`).

use msdd_spheres::space::{cross, dot, length, minus, plus, scaled};
use msdd_spheres::{Simulation, Sphere, Surface, Wall};
use std::f64::consts::PI;

/// Rings around the foot of a sphere, sectors of each at the side of a cylinder, and the radius of the last one over the sphere's: no point of the plate is farther from the
/// foot of its sphere in a bed.
const RINGS: usize = 64;
const SECTORS: usize = 32;
const REACH: f64 = 4.0;
/// Spheres so many radii farther than the nearest one are behind others.
const DEPTH: f64 = 8.0;

/// A part of a ring around the foot of a sphere, on the plate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// \[m²\]
    pub area: f64,
    /// l at its inner and outer edge \[m\].
    pub lengths: [f64; 2],
}

/// A sphere and its part of a plate.
#[derive(Clone, Debug, PartialEq)]
pub struct Facing {
    pub sphere: usize,
    /// Distance of the surfaces \[m\], 0 if they touch.
    pub gap: f64,
    pub rings: Vec<Ring>,
}

impl Facing {
    /// Conductance over k_g \[m\], with e \[m\]. In a ring l is taken to be linear in ρ², which is exact where it matters, next to a
    /// contact.
    pub fn size(&self, extra: f64) -> f64 {
        let ring = |ring: &Ring| {
            let [near, far] = ring.lengths.map(|l| l + extra);
            let rise = far / near - 1.0;
            ring.area / near * if rise < 1e-6 { 1.0 - 0.5 * rise } else { libm::log1p(rise) / rise }
        };
        self.rings.iter().map(ring).sum()
    }

    /// Of its part \[m²\].
    pub fn area(&self) -> f64 {
        self.rings.iter().map(|ring| ring.area).sum()
    }
}

/// l \[m\] from a point of the plate, for the distance D of the centre.
fn arc(off: f64, distance: f64, radius: f64) -> f64 {
    let gap = (distance - radius).max(0.0);
    if off == 0.0 {
        return gap;
    }
    let both = gap + 2.0 * radius;
    (off + gap * both / off) * libm::atan(off / both)
}

/// A sphere or its image, seen from the plate.
struct Seen {
    /// None: an image, which takes its part of the plate outside the cell.
    sphere: Option<usize>,
    foot: [f64; 2],
    distance: f64,
    radius: f64,
    /// D² − R².
    power: f64,
}

/// Spheres with a part of a wall, in order of their numbers.
pub fn facing(simulation: &Simulation, wall: usize) -> Vec<Facing> {
    let walls = simulation.boundary.walls();
    let plate = walls[wall];
    let normal = match plate.surface {
        Surface::Flat { normal } => normal,
        Surface::Cylinder { axis, radius, .. } => return around(simulation, &plate, (axis, radius)),
    };
    let axes = axes(normal);
    let seen = seen(simulation, &plate, axes);
    let cuts: Vec<Cut> = (walls.iter().enumerate())
        .filter(|(k, _)| *k != wall)
        .filter_map(|(_, w)| Cut::new(w, &plate, axes))
        .collect();
    let mut all: Vec<Facing> = (0..seen.len()).filter_map(|k| part(&seen, k, &cuts)).collect();
    all.sort_by_key(|facing| facing.sphere);
    all
}

/// Spheres with a part of the side of a cylinder of this axis and radius, between the other walls. No images: a cell next to a cylinder
/// does not repeat itself.
fn around(simulation: &Simulation, side: &Wall, (axis, radius): ([f64; 3], f64)) -> Vec<Facing> {
    let spheres = &simulation.spheres;
    let largest = spheres.iter().fold(0.0f64, |largest, s| largest.max(s.radius));
    let gap = |s: &Sphere| side.distance(s.position) - s.radius;
    let deepest = spheres.iter().map(gap).fold(f64::INFINITY, f64::min).max(0.0) + DEPTH * largest;
    let height = |k: usize| dot(minus(spheres[k].position, side.point), axis);
    let mut near: Vec<usize> = (0..spheres.len()).filter(|&k| gap(&spheres[k]) < deepest).collect();
    near.sort_by(|&a, &b| height(a).total_cmp(&height(b)).then(a.cmp(&b)));
    let ends: Vec<Wall> = simulation
        .boundary
        .walls()
        .iter()
        .filter(|w| matches!(w.surface, Surface::Flat { .. }))
        .copied()
        .collect();
    let mut all = Vec::new();
    for (place, &k) in near.iter().enumerate() {
        let me = &spheres[k];
        let reach = REACH * me.radius;
        let close = |other: &&usize| (height(**other) - height(k)).abs() < 2.0 * reach;
        let others: Vec<&Sphere> = (near[..place].iter().rev().take_while(close))
            .chain(near[place + 1..].iter().take_while(close))
            .map(|&other| &spheres[other])
            .filter(|other| length(minus(other.position, me.position)) < 2.0 * reach)
            .collect();
        let from = minus(me.position, side.point);
        let foot = dot(from, axis);
        let out = plus(from, -foot, axis);
        let off = length(out);
        // A sphere on the axis has no foot, and none of the side if others are there.
        if off < 1e-9 * radius {
            continue;
        }
        let out = scaled(1.0 / off, out);
        let across = cross(axis, out);
        // Distances along the side, along the axis and around it, from the foot.
        let point = |along: f64, around: f64| {
            let (sine, cosine) = (libm::sin(around / radius), libm::cos(around / radius));
            let outward: [f64; 3] = std::array::from_fn(|i| cosine * out[i] + sine * across[i]);
            (plus(plus(side.point, foot + along, axis), radius, outward), outward)
        };
        let power = |s: &Sphere, at: [f64; 3]| {
            let to = minus(s.position, at);
            dot(to, to) - s.radius * s.radius
        };
        let arc_from = |(at, outward): ([f64; 3], [f64; 3])| {
            let to = minus(me.position, at);
            let distance = -dot(to, outward);
            arc((dot(to, to) - distance * distance).max(0.0).sqrt(), distance, me.radius)
        };
        let mut rings = Vec::new();
        for ring in 0..RINGS {
            let edges = [ring, ring + 1].map(|edge| edge as f64 * reach / RINGS as f64);
            let middle = 0.5 * (edges[0] + edges[1]);
            let (mut own, mut sums) = (0, [0.0; 2]);
            for sector in 0..SECTORS {
                let angle = 2.0 * PI * (sector as f64 + 0.5) / SECTORS as f64;
                let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
                let (at, _) = point(middle * cosine, middle * sine);
                let mine = power(me, at);
                if ends.iter().all(|end| end.distance(at) > 0.0) && others.iter().all(|s| power(s, at) > mine)
                {
                    own += 1;
                    for (sum, edge) in sums.iter_mut().zip(edges) {
                        *sum += arc_from(point(edge * cosine, edge * sine));
                    }
                }
            }
            if own > 0 {
                let share = f64::from(own) / SECTORS as f64;
                let area = share * PI * (edges[1] * edges[1] - edges[0] * edges[0]);
                rings.push(Ring { area, lengths: sums.map(|sum| sum / f64::from(own)) });
            }
        }
        if !rings.is_empty() {
            all.push(Facing { sphere: k, gap: gap(me).max(0.0), rings });
        }
    }
    all.sort_by_key(|facing| facing.sphere);
    all
}

/// Two unit vectors along a plane.
fn axes(normal: [f64; 3]) -> [[f64; 3]; 2] {
    let least = if normal[0].abs() < 0.6 { 0 } else { 1 };
    let other: [f64; 3] = std::array::from_fn(|k| f64::from(u8::from(k == least)));
    let along = plus(other, -dot(other, normal), normal);
    let first = scaled(1.0 / length(along), along);
    [first, cross(normal, first)]
}

/// The spheres near the plate and their images, by the first coordinate of their feet.
fn seen(simulation: &Simulation, plate: &Wall, axes: [[f64; 3]; 2]) -> Vec<Seen> {
    let spheres = &simulation.spheres;
    let largest = spheres.iter().fold(0.0f64, |largest, s| largest.max(s.radius));
    let gap = |s: &Sphere| plate.distance(s.position) - s.radius;
    let deepest = spheres.iter().map(gap).fold(f64::INFINITY, f64::min).max(0.0) + DEPTH * largest;
    let mut seen: Vec<Seen> = Vec::new();
    let mut add = |sphere: Option<usize>, s: &Sphere| {
        let (from, distance) = (minus(s.position, plate.point), plate.distance(s.position));
        if distance > 0.0 && distance - s.radius < deepest {
            let (foot, radius) = (axes.map(|axis| dot(from, axis)), s.radius);
            let power = distance * distance - radius * radius;
            seen.push(Seen { sphere, foot, distance, radius, power });
        }
    };
    spheres.iter().enumerate().for_each(|(k, s)| add(Some(k), s));
    if let Some(cell) = simulation.cell() {
        let shortest = (0..3).map(|k| cell.lattice.edges[k][k]).fold(f64::INFINITY, f64::min);
        let margin = (2.0 * REACH * largest).min(0.999 * shortest);
        let images = cell.lattice.images(spheres, margin);
        for image in images.iter().filter(|image| image.shift != [0; 3]) {
            add(None, &cell.lattice.image(&spheres[image.owner as usize], image.shift));
        }
    }
    seen.sort_by(|a, b| a.foot[0].total_cmp(&b.foot[0]).then(a.foot[1].total_cmp(&b.foot[1])));
    seen
}

/// The end of the plate at another wall.
enum Cut {
    /// Points whose product with the unit vector is larger than this \[m\] are beyond.
    Straight([f64; 2], f64),
    /// Points farther from the centre than the radius \[m\] are beyond.
    Round([f64; 2], f64),
}

impl Cut {
    fn new(wall: &Wall, plate: &Wall, axes: [[f64; 3]; 2]) -> Option<Self> {
        let flat = |vector: [f64; 3]| axes.map(|axis| dot(vector, axis));
        let from = minus(wall.point, plate.point);
        match wall.surface {
            Surface::Flat { normal } => {
                let out = flat(normal).map(|n| -n);
                let length = libm::hypot(out[0], out[1]);
                (length > 0.999).then(|| Self::Straight(out, dot(from, scaled(-1.0, normal))))
            }
            Surface::Cylinder { axis, radius, .. } => {
                let along = flat(axis);
                (libm::hypot(along[0], along[1]) < 1e-3).then(|| Self::Round(flat(from), radius))
            }
        }
    }

    /// Angle of the middle and half of the width \[rad\] of what it takes from a ring of radius `off` around a foot.
    fn takes(&self, foot: [f64; 2], off: f64) -> (f64, f64) {
        match *self {
            Self::Straight(out, at) => {
                let left = at - out[0] * foot[0] - out[1] * foot[1];
                (libm::atan2(out[1], out[0]), libm::acos((left / off).clamp(-1.0, 1.0)))
            }
            Self::Round(centre, radius) => {
                let from = [foot[0] - centre[0], foot[1] - centre[1]];
                let square = from[0] * from[0] + from[1] * from[1];
                let cosine = (radius * radius - off * off - square) / (2.0 * off * square.sqrt()).max(1e-300);
                (libm::atan2(from[1], from[0]), libm::acos(cosine.clamp(-1.0, 1.0)))
            }
        }
    }
}

/// The part of one sphere, if it has any.
fn part(seen: &[Seen], number: usize, cuts: &[Cut]) -> Option<Facing> {
    let me = &seen[number];
    let sphere = me.sphere?;
    // Where the part ends at another sphere: a straight line.
    let mut ends: Vec<Cut> = Vec::new();
    let reach = REACH * me.radius;
    let mut end = |other: &Seen| {
        let to = [other.foot[0] - me.foot[0], other.foot[1] - me.foot[1]];
        let apart = libm::hypot(to[0], to[1]);
        let less = other.power - me.power;
        if apart > 0.0 && 0.5 * (apart * apart + less) / apart < reach {
            let out = to.map(|x| x / apart);
            let at = out[0] * me.foot[0] + out[1] * me.foot[1] + 0.5 * (apart + less / apart);
            ends.push(Cut::Straight(out, at));
        }
        // Exactly behind another one.
        apart > 0.0 || less > 0.0
    };
    let near = |other: &&Seen| (other.foot[0] - me.foot[0]).abs() < 2.0 * reach;
    let open = seen[..number].iter().rev().take_while(near).all(&mut end)
        && seen[number + 1..].iter().take_while(near).all(&mut end);
    if !open {
        return None;
    }
    let mut rings = Vec::new();
    for k in 0..RINGS {
        let edges = [k, k + 1].map(|edge| edge as f64 * reach / RINGS as f64);
        let middle = 0.5 * (edges[0] + edges[1]);
        let taken: Vec<(f64, f64)> = (ends.iter().chain(cuts))
            .map(|cut| cut.takes(me.foot, middle))
            .filter(|(_, half)| *half > 0.0)
            .collect();
        let share = 1.0 - covered(&taken) / (2.0 * PI);
        if share > 1e-12 {
            let area = share * PI * (edges[1] * edges[1] - edges[0] * edges[0]);
            rings.push(Ring { area, lengths: edges.map(|off| arc(off, me.distance, me.radius)) });
        }
    }
    let gap = (me.distance - me.radius).max(0.0);
    (!rings.is_empty()).then_some(Facing { sphere, gap, rings })
}

/// Length of the union of arcs of the unit circle, each by its middle and half of its width \[rad\].
fn covered(arcs: &[(f64, f64)]) -> f64 {
    let mut pieces: Vec<[f64; 2]> = Vec::with_capacity(2 * arcs.len());
    for &(middle, half) in arcs {
        let low = (middle - half).rem_euclid(2.0 * PI);
        pieces.extend([[low, low + 2.0 * half], [low - 2.0 * PI, low - 2.0 * PI + 2.0 * half]]);
    }
    pieces.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let (mut sum, mut end) = (0.0, 0.0f64);
    for [low, high] in pieces {
        let (low, high) = (low.max(end), high.min(2.0 * PI));
        if high > low {
            sum += high - low;
            end = high;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direct::voxels::Ball;
    use crate::direct::walk_on_spheres::Room;
    use crate::gas::plate_conductance;
    use crate::random::Random;
    use crate::scatter::scatter;
    use msdd_spheres::{Boundary, Cell, Material, Stiffness};

    fn bed(spheres: &[([f64; 3], f64)], boundary: Boundary) -> Simulation {
        let stiffness = Stiffness::HertzMindlin { young_modulus: 1e9, poisson_ratio: 0.3 };
        let material =
            Material { density: 1.0, stiffness, friction: 0.0, wall_friction: 0.0, restitution: 1.0 };
        let spheres = spheres.iter().map(|&(centre, radius)| Sphere::at_rest(centre, radius, 1.0)).collect();
        Simulation::new(material, spheres, boundary).expect("a box of spheres")
    }

    fn sides([x, y]: [f64; 2]) -> Vec<Wall> {
        Wall::block([x, y, 50.0])
    }

    /// The floor of [`sides`].
    const FLOOR: usize = 4;

    /// Spheres share the plate: in a box, in a cylinder, and in a cell that repeats itself.
    #[test]
    fn the_plate_is_shared_without_overlap() {
        let centres = scatter(&mut Random::new(4), &[0.5; 60], [6.0, 5.0, 4.0]).expect("room");
        let centres: Vec<[f64; 3]> = centres.into_iter().map(|(centre, _)| centre).collect();
        let total = |simulation: &Simulation, wall: usize| -> f64 {
            facing(simulation, wall).iter().map(Facing::area).sum()
        };
        let inside = |c: &[f64; 3]| c[0] > 0.5 && c[0] < 5.5 && c[1] > 0.5 && c[1] < 4.5 && c[2] > 0.5;
        let some: Vec<_> = centres.iter().filter(|c| inside(c)).map(|&c| (c, 0.5)).collect();
        let boxed = bed(&some, Boundary::Walls(sides([6.0, 5.0])));
        assert!((total(&boxed, FLOOR) / 30.0 - 1.0).abs() < 5e-3, "{}", total(&boxed, FLOOR));
        let floor = Wall::at_rest([0.0; 3], [0.0, 0.0, 1.0]);
        let above: Vec<_> = centres.iter().map(|&[x, y, z]| ([x, y, z + 0.5], 0.5)).collect();
        let endless = bed(&above, Boundary::Between(Cell::block([6.0, 5.0, 20.0]), vec![floor]));
        assert!((total(&endless, 0) / 30.0 - 1.0).abs() < 5e-3, "{}", total(&endless, 0));
        let round: Vec<_> = centres.iter().map(|&[x, y, z]| ([x - 3.0, y - 2.5, z + 0.5], 0.5)).collect();
        let round: Vec<_> = round.into_iter().filter(|(c, _)| c[0].hypot(c[1]) < 2.0).collect();
        let side = Wall::cylinder([0.0; 3], [0.0, 0.0, 1.0], 2.5);
        let column = bed(&round, Boundary::Walls(vec![side, floor]));
        assert!((total(&column, 1) / (PI * 6.25) - 1.0).abs() < 5e-3, "{}", total(&column, 1));
    }

    /// The side of a cylinder is shared, too; a wide one is a flat wall, and a narrow one is nearer to a sphere that touches it.
    #[test]
    fn the_side_of_a_cylinder_is_shared_and_flat_where_it_is_wide() {
        let side = |radius| Wall::cylinder([0.0; 3], [0.0, 0.0, 1.0], radius);
        let ends =
            [Wall::at_rest([0.0; 3], [0.0, 0.0, 1.0]), Wall::at_rest([0.0, 0.0, 6.0], [0.0, 0.0, -1.0])];
        let bed = |spheres: &[([f64; 3], f64)], wall: Wall| {
            bed(spheres, Boundary::Walls(vec![wall, ends[0], ends[1]]))
        };
        let centres = scatter(&mut Random::new(4), &[0.5; 90], [5.0, 5.0, 6.0]).expect("room");
        let round: Vec<_> = centres.into_iter().map(|([x, y, z], r)| ([x - 2.5, y - 2.5, z], r)).collect();
        let inside = |c: &[f64; 3]| c[0].hypot(c[1]) < 2.0 && c[2] > 0.5 && c[2] < 5.5;
        let round: Vec<_> = round.into_iter().filter(|(c, _)| inside(c)).collect();
        let area: f64 = facing(&bed(&round, side(2.5)), 0).iter().map(Facing::area).sum();
        assert!((area / (PI * 30.0) - 1.0).abs() < 0.01, "{area}");
        let pair = |x: f64| [([x, 0.0, 2.5], 0.5), ([x, 0.0, 3.5], 0.5)];
        let flat = bed(&pair(0.5), Wall::at_rest([0.0; 3], [1.0, 0.0, 0.0]));
        let size = |simulation: &Simulation| facing(simulation, 0)[0].size(1e-3);
        let wide = size(&bed(&pair(499.5), side(500.0)));
        assert!((wide / size(&flat) - 1.0).abs() < 0.02, "{wide} {}", size(&flat));
        let narrow = size(&bed(&pair(2.0), side(2.5)));
        assert!(narrow > 1.05 * wide, "{narrow} {wide}");
    }

    /// A sphere behind another one has no part; one next to it shares the plate evenly.
    #[test]
    fn a_hidden_sphere_gets_nothing() {
        let walls = || Boundary::Walls(sides([4.0, 2.0]));
        let behind = facing(&bed(&[([2.0, 1.0, 0.5], 0.5), ([2.0, 1.0, 1.6], 0.5)], walls()), FLOOR);
        assert_eq!(behind.iter().map(|f| f.sphere).collect::<Vec<_>>(), [0]);
        let beside = facing(&bed(&[([1.0, 1.0, 0.5], 0.5), ([3.0, 1.0, 0.5], 0.5)], walls()), FLOOR);
        assert_eq!(beside.len(), 2);
        assert!(
            (beside[0].area() / 4.0 - 1.0).abs() < 5e-3
                && (beside[0].size(1e-3) / beside[1].size(1e-3) - 1.0).abs() < 1e-9
        );
    }

    /// Beside a contact the law is that of straight lines, whose integral is closed: what heat gains when e falls is the same. A thin gas
    /// passes k_g/e on the whole plate.
    #[test]
    fn contacts_and_thin_gases_are_those_of_straight_lines() {
        let (radius, walls) = (0.5, Boundary::Walls(sides([1.2, 1.2])));
        let lone = &facing(&bed(&[([0.6, 0.6, 0.5], 0.5)], walls), FLOOR)[0];
        let gain = |law: &dyn Fn(f64) -> f64| law(1e-6 * radius) - law(1e-4 * radius);
        let (found, lines) = (gain(&|e| lone.size(e)), gain(&|e| plate_conductance(1.0, radius, e, 0.0)));
        assert!((found / lines - 1.0).abs() < 2e-3, "{found} {lines}");
        assert!((lone.size(1e6) * 1e6 / lone.area() - 1.0).abs() < 1e-5);
    }

    /// Two layers of spheres at the corners of squares, the second one in the hollows of the first, which stands off the plate: within
    /// 5 % of walks.
    #[test]
    fn the_law_is_near_direct_solutions() {
        let layers = |gap: f64| {
            let (low, high) = (0.5 + gap, 0.5 + gap + 0.5f64.sqrt() + 0.02);
            let places = (0..9).map(|k| [f64::from(k % 3) * 1.01, f64::from(k / 3) * 1.01]);
            places
                .flat_map(|[x, y]| [[x + 0.3, y + 0.3, low], [x + 0.805, y + 0.805, high]])
                .collect::<Vec<[f64; 3]>>()
        };
        for gap in [0.01, 0.1] {
            let balls = layers(gap).iter().map(|&centre| Ball { centre, radius: 0.5 }).collect();
            let walks =
                Room::new([3.03; 2], 5.0, balls).exchange_of_plate([3.03; 2], 250, &mut Random::new(6));
            let floor = Wall::at_rest([0.0; 3], [0.0, 0.0, 1.0]);
            let spheres: Vec<_> = layers(gap).into_iter().map(|centre| (centre, 0.5)).collect();
            let cell = Cell::block([3.03, 3.03, 20.0]);
            let law = facing(&bed(&spheres, Boundary::Between(cell, vec![floor])), 0);
            let (law, direct): (f64, f64) = (law.iter().map(|f| f.size(0.0)).sum(), walks.balls.iter().sum());
            assert!((law / direct - 1.0).abs() < 0.05, "{gap}: {law} {direct}");
        }
    }
}
