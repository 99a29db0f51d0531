//! Direct solutions of the heat equation in a periodic box of spheres, to hold the laws of [`msdd_beds::gas`] against.
//!
//! The box is cut into N³ voxels with one temperature each. Between the middles of two neighbours heat goes along columns of a finer
//! grid, in each through what there is of solid and gas one after the other: exact for layers along and across. The error falls with
//! 1/N (the spots where spheres touch are never resolved), so solutions at two N are extrapolated.
//!
//! Surfaces that radiate exchange heat along rays ([`msdd_beds::rays`]) between the voxels just below them.

use msdd_beds::rays::Spot;
use msdd_beds::solve::{conjugate_gradients, inner};
use msdd_spheres::space::plus;

/// Finer cells in a voxel, along each axis.
const FINE: usize = 4;
/// Residual over the right-hand side at which a solution counts as found.
const RESIDUAL: f64 = 1e-5;

/// A sphere in a box of edge 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    pub centre: [f64; 3],
    pub radius: f64,
}

/// A ray from one voxel to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    from: u32,
    to: u32,
    /// From the one to the image of the other, in voxels.
    way: [i16; 3],
}

/// A periodic cube of spheres on voxels.
#[derive(Clone, Debug)]
pub struct Voxels {
    count: usize,
    /// For each axis and voxel: how many of the finer cells between its middle and that of the next voxel are solid, by column.
    columns: [Vec<[u8; FINE * FINE]>; 3],
    /// Volume of the balls over the volume, overlaps counted once.
    pub solid_fraction: f64,
}

impl Voxels {
    /// `count` voxels along each edge.
    pub fn new(balls: &[Ball], count: usize) -> Self {
        let fine = count * FINE;
        let solid = raster(balls, fine);
        let filled = solid.iter().filter(|&&solid| solid).count() as f64;
        let at = |place: [usize; 3]| usize::from(solid[(place[2] * fine + place[1]) * fine + place[0]]);
        let columns = std::array::from_fn(|axis| {
            let across = [(axis + 1) % 3, (axis + 2) % 3];
            let voxel = |n: usize| {
                let corner = [n % count, n / count % count, n / count / count].map(|c| c * FINE);
                std::array::from_fn(|column| {
                    let mut place = corner;
                    place[across[0]] += column % FINE;
                    place[across[1]] += column / FINE;
                    let along = (0..FINE).map(|step| {
                        place[axis] = (corner[axis] + FINE / 2 + step) % fine;
                        at(place)
                    });
                    along.sum::<usize>() as u8
                })
            };
            (0..count * count * count).map(voxel).collect()
        });
        Self { count, columns, solid_fraction: filled / (fine * fine * fine) as f64 }
    }

    /// A ray between two points of the surfaces of balls.
    pub fn sight(&self, from: &Spot, to: &Spot) -> Sight {
        let count = self.count as i64;
        let place = |spot: &Spot| {
            let below = plus(spot.point, -0.5 / count as f64, spot.normal);
            below.map(|x| (x * count as f64).floor() as i64)
        };
        let number = |place: [i64; 3]| {
            let [x, y, z] = place.map(|x| x.rem_euclid(count));
            ((z * count + y) * count + x) as u32
        };
        let (from, to) = (place(from), place(to));
        let way = std::array::from_fn(|k| (to[k] - from[k]) as i16);
        Sight { from: number(from), to: number(to), way }
    }

    /// K/k_g along an axis for k_s/k_g = `ratio`; none if the iteration does not converge.
    pub fn conductivity(&self, ratio: f64, axis: usize) -> Option<f64> {
        self.radiating(ratio, axis, (&[], 0.0))
    }

    /// The same with surfaces that exchange heat along each of some rays with a conductance, over k_g and the edge of the cube.
    pub fn radiating(&self, ratio: f64, axis: usize, (sights, each): (&[Sight], f64)) -> Option<f64> {
        let count = self.count;
        let each = each * count as f64;
        let column: [f64; FINE + 1] = std::array::from_fn(|solid| {
            let gas = (FINE - solid) as f64;
            1.0 / (solid as f64 / ratio + gas) / FINE as f64
        });
        let faces: [Vec<f64>; 3] = std::array::from_fn(|a| {
            let face = |solid: &[u8; FINE * FINE]| solid.iter().map(|&s| column[usize::from(s)]).sum::<f64>();
            self.columns[a].iter().map(face).collect()
        });
        let stride = [1, count, count * count];
        let next = |n: usize, a: usize| {
            let last = n / stride[a] % count == count - 1;
            if last { n + stride[a] - stride[a] * count } else { n + stride[a] }
        };
        let total = count * count * count;
        let (mut diagonal, mut residual) = (vec![0.0; total], vec![0.0; total]);
        for (a, faces) in faces.iter().enumerate() {
            for (n, &face) in faces.iter().enumerate() {
                let other = next(n, a);
                diagonal[n] += face;
                diagonal[other] += face;
                if a == axis {
                    residual[n] += face;
                    residual[other] -= face;
                }
            }
        }
        for sight in sights {
            let (from, to) = (sight.from as usize, sight.to as usize);
            let heat = each * f64::from(sight.way[axis]);
            diagonal[from] += each;
            diagonal[to] += each;
            residual[from] += heat;
            residual[to] -= heat;
        }
        let scale = inner(&residual, &residual);
        let apply = |direction: &[f64], flow: &mut [f64]| {
            for (a, faces) in faces.iter().enumerate() {
                for (n, face) in faces.iter().enumerate() {
                    let other = next(n, a);
                    let heat = face * (direction[n] - direction[other]);
                    flow[n] += heat;
                    flow[other] -= heat;
                }
            }
            for sight in sights {
                let (from, to) = (sight.from as usize, sight.to as usize);
                let heat = each * (direction[from] - direction[to]);
                flow[from] += heat;
                flow[to] -= heat;
            }
        };
        let enough = |residual: &[f64]| inner(residual, residual) <= RESIDUAL * RESIDUAL * scale;
        let found = conjugate_gradients(apply, &diagonal, &mut residual, enough)?;
        let flux = (0..total).map(|n| faces[axis][n] * (1.0 + found[next(n, axis)] - found[n])).sum::<f64>();
        let along = |sight: &Sight| {
            let way = f64::from(sight.way[axis]);
            each * way * (way + found[sight.to as usize] - found[sight.from as usize])
        };
        Some((flux + sights.iter().map(along).sum::<f64>()) / total as f64)
    }
}

/// Which cells of a grid have their middle in a ball.
fn raster(balls: &[Ball], fine: usize) -> Vec<bool> {
    let mut solid = vec![false; fine * fine * fine];
    let edge = 1.0 / fine as f64;
    for ball in balls {
        let ends = ball.centre.map(|c| {
            [((c - ball.radius) / edge - 0.5).ceil() as i64, ((c + ball.radius) / edge - 0.5).floor() as i64]
        });
        let wrapped = |k: i64| k.rem_euclid(fine as i64) as usize;
        let off = |k: i64, axis: usize| (k as f64 + 0.5) * edge - ball.centre[axis];
        for z in ends[2][0]..=ends[2][1] {
            for y in ends[1][0]..=ends[1][1] {
                let left = ball.radius * ball.radius - off(z, 2).powi(2) - off(y, 1).powi(2);
                let row = (wrapped(z) * fine + wrapped(y)) * fine;
                for x in (ends[0][0]..=ends[0][1]).filter(|&x| off(x, 0).powi(2) <= left) {
                    solid[row + wrapped(x)] = true;
                }
            }
        }
    }
    solid
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Simple cubic spheres of this radius over the edge.
    fn cubic(radius: f64, count: usize) -> Voxels {
        Voxels::new(&[Ball { centre: [0.5; 3], radius }], count)
    }

    /// To the second order in k_s − k_g the conductivity of an isotropic or cubic medium is ⟨k⟩ − φ(1 − φ) (k_s − k_g)²/(3 ⟨k⟩)
    /// (Torquato, Random Heterogeneous Materials, 2002, section 20.2).
    #[test]
    fn little_contrast_is_exact() {
        let voxels = cubic(0.45, 24);
        let (phi, contrast) = (voxels.solid_fraction, 0.05);
        assert!((phi - 4.0 / 3.0 * std::f64::consts::PI * 0.45f64.powi(3)).abs() < 2e-3);
        let mean = 1.0 + phi * contrast;
        let expected = mean - phi * (1.0 - phi) * contrast * contrast / (3.0 * mean);
        let found = voxels.conductivity(1.0 + contrast, 0).unwrap();
        assert!((found / expected - 1.0).abs() < 2e-5, "{found} {expected}");
    }

    /// Spheres of κ = 10 on a cubic lattice by the series of Rayleigh as far as φ^(10/3) (McPhedran and McKenzie, Proc. R. Soc. A 359,
    /// 45, 1978): exact within 1e-4 at φ = 0.3.
    #[test]
    fn cubic_spheres_have_the_conductivity_of_rayleigh() {
        let radius = (0.3 * 3.0 / (4.0 * std::f64::consts::PI)).cbrt();
        let (phi, ratio) = (0.3f64, 10.0);
        let beta = |n: f64| (ratio - 1.0) / (ratio + (n + 1.0) / n);
        let over = 1.0 / beta(1.0);
        let expected = 1.0 + 3.0 * phi / (over - phi - 1.3047 * beta(3.0) * phi.powf(10.0 / 3.0));
        let [coarse, fine] = [16, 32].map(|count| cubic(radius, count).conductivity(ratio, 2).unwrap());
        let found = 2.0 * fine - coarse;
        assert!((found / expected - 1.0).abs() < 3e-3, "{coarse} {fine} {expected}");
    }
}
