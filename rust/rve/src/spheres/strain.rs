//! Strain of a periodic box and of the grains in it.

/// Components xx, yy, zz, xy, xz, yz.
pub type Tensor = [f64; 6];

/// Row and column of each component of a [`Tensor`].
pub const PLACES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// A change of the box and of the radii \[-\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Strain {
    /// ε of the radii, growth positive.
    pub thermal: f64,
    /// F − 1 of the box, extension positive. F is 0 below the diagonal, so that the first edge of the box stays along x and the
    /// second in the plane of x and y: xy is the displacement along x over the distance along y.
    pub stretch: Tensor,
}

impl Strain {
    pub fn thermal(thermal: f64) -> Self {
        Self { thermal, ..Self::default() }
    }

    /// The box closes or opens equally along all axes.
    pub fn isotropic(size: f64) -> Self {
        Self { stretch: [size, size, size, 0.0, 0.0, 0.0], ..Self::default() }
    }

    /// One component of the stretch, by its place in [`Tensor`].
    pub fn single(place: usize, size: f64) -> Self {
        let mut strain = Self::default();
        strain.stretch[place] = size;
        strain
    }

    /// The strain after this one and then `next`, which is relative to the state in between.
    pub fn then(self, next: Self) -> Self {
        let [ax, ay, az, axy, axz, ayz] = self.stretch;
        let [bx, by, bz, bxy, bxz, byz] = next.stretch;
        let compound = |a: f64, b: f64| a + b + a * b;
        Self {
            thermal: compound(self.thermal, next.thermal),
            stretch: [
                compound(ax, bx),
                compound(ay, by),
                compound(az, bz),
                (1.0 + bx) * axy + bxy * (1.0 + ay),
                (1.0 + bx) * axz + bxy * ayz + bxz * (1.0 + az),
                (1.0 + by) * ayz + byz * (1.0 + az),
            ],
        }
    }

    /// What leads from this strain to `target`, both relative to the same state: [`Strain::then`] of it gives the target.
    pub fn to(self, target: Self) -> Self {
        let change = std::array::from_fn(|place| target.stretch[place] - self.stretch[place]);
        Self {
            thermal: (target.thermal - self.thermal) / (1.0 + self.thermal),
            stretch: over(change, self.stretch),
        }
    }

    /// `factor` times the strain. Adding 0 makes 0 of −0, which would be written with its sign.
    pub fn times(self, factor: f64) -> Self {
        Self {
            thermal: factor * self.thermal + 0.0,
            stretch: self.stretch.map(|component| factor * component + 0.0),
        }
    }

    /// The largest component, without sign.
    pub fn largest(&self) -> f64 {
        self.stretch.iter().fold(self.thermal.abs(), |largest, component| largest.max(component.abs()))
    }

    /// Volume of the box after over before.
    pub fn volume_ratio(&self) -> f64 {
        let [x, y, z, ..] = self.stretch;
        (1.0 + x) * (1.0 + y) * (1.0 + z)
    }

    /// How much nearer the grains come to each other, to the first order: the decrease of ln of the volume of the box over that
    /// of the grains.
    pub fn compression(&self) -> f64 {
        let [x, y, z, ..] = self.stretch;
        3.0 * self.thermal - (x + y + z)
    }
}

/// H F⁻¹ with F = 1 + `stretch`, both 0 below the diagonal. Adding 0 makes 0 of −0.
pub(super) fn over(h: Tensor, stretch: Tensor) -> Tensor {
    let [x, y, z, fxy, fxz, fyz] = stretch;
    let [fx, fy, fz] = [x, y, z].map(|part| 1.0 + part);
    let [gx, gy, gz] = [h[0] / fx, h[1] / fy, h[2] / fz];
    let gxy = (h[3] - gx * fxy) / fy;
    let gxz = (h[4] - gx * fxz - gxy * fyz) / fz;
    let gyz = (h[5] - gy * fyz) / fz;
    [gx, gy, gz, gxy, gxz, gyz].map(|part| part + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strains_follow_each_other_like_matrices() {
        let a = Strain { thermal: 0.01, stretch: [0.1, -0.05, 0.02, 0.03, -0.04, 0.05] };
        let b = Strain { thermal: -0.02, stretch: [-0.02, 0.04, 0.01, 0.06, 0.02, -0.03] };
        let matrix = |strain: Strain| {
            let mut matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            for ((row, column), part) in PLACES.into_iter().zip(strain.stretch) {
                matrix[row][column] += part;
            }
            matrix
        };
        let (fa, fb, both) = (matrix(a), matrix(b), matrix(a.then(b)));
        for row in 0..3 {
            for column in 0..3 {
                let product: f64 = (0..3).map(|k| fb[row][k] * fa[k][column]).sum();
                assert!((product - both[row][column]).abs() < 1e-15);
            }
        }
        let back = a.to(a.then(b));
        assert!((back.thermal - b.thermal).abs() < 1e-15);
        assert!((0..6).all(|k| (back.stretch[k] - b.stretch[k]).abs() < 1e-15), "{back:?}");
        assert!((a.then(b).thermal - (1.01 * 0.98 - 1.0)).abs() < 1e-15);
        assert!((Strain::thermal(1e-3).compression() - Strain::isotropic(-1e-3).compression()).abs() < 1e-18);
    }
}
