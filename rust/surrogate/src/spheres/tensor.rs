//! Symmetric tensors of three dimensions: xx, yy, zz, xy, xz, yz.

use super::components::{six, three};
use super::number::Number;

/// Components xx, yy, zz, xy, xz, yz.
pub type Tensor<N = f64> = [N; 6];

/// A rotation matrix, row by row.
pub type Rotation<V = f64> = [[V; 3]; 3];

/// A third of the trace.
#[inline(always)]
pub fn mean<N: Number>([xx, yy, zz, ..]: Tensor<N>) -> N {
    (xx + yy + zz).times(1.0 / 3.0)
}

/// The tensor without its mean.
#[inline(always)]
pub fn deviator<N: Number>(tensor: Tensor<N>) -> Tensor<N> {
    let mean = mean(tensor);
    let [xx, yy, zz, xy, xz, yz] = tensor;
    [xx - mean, yy - mean, zz - mean, xy, xz, yz]
}

/// Σ_ij a_ij b_ij.
#[inline(always)]
pub fn contraction<N: Number>(a: &Tensor<N>, b: &Tensor<N>) -> N {
    let normal = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    normal + (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]).times(2.0)
}

#[inline(always)]
pub fn sum<N: Number>(a: &Tensor<N>, b: &Tensor<N>) -> Tensor<N> {
    six!(k => a[k] + b[k])
}

#[inline(always)]
pub fn scaled<N: Number>(tensor: &Tensor<N>, factor: N) -> Tensor<N> {
    six!(k => tensor[k] * factor)
}

/// T T.
#[inline(always)]
pub fn square<N: Number>(tensor: &Tensor<N>) -> Tensor<N> {
    let [xx, yy, zz, xy, xz, yz] = *tensor;
    [
        xx * xx + xy * xy + xz * xz,
        xy * xy + yy * yy + yz * yz,
        xz * xz + yz * yz + zz * zz,
        xx * xy + xy * yy + xz * yz,
        xx * xz + xy * yz + xz * zz,
        xy * xz + yy * yz + yz * zz,
    ]
}

/// Σ_i v_i a_i.
#[inline(always)]
fn along<N: Number>([x, y, z]: [N; 3], axis: [N::Values; 3]) -> N {
    x.by(axis[0]) + y.by(axis[1]) + z.by(axis[2])
}

/// R T Rᵀ.
#[inline(always)]
pub fn turned<N: Number>(tensor: &Tensor<N>, rotation: &Rotation<N::Values>) -> Tensor<N> {
    let [xx, yy, zz, xy, xz, yz] = *tensor;
    let full = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let half = three!(i => three!(j => along(full[j], rotation[i])));
    let [x, y, z] = *rotation;
    [
        along(half[0], x),
        along(half[1], y),
        along(half[2], z),
        along(half[0], y),
        along(half[0], z),
        along(half[1], z),
    ]
}

/// The rotation about the direction of a vector by twice the arc tangent of half of its length (Cayley), which for small angles is
/// the length \[rad\]; counter-clockwise seen from the vector's tip.
#[inline(always)]
pub fn rotation<V: Number>(vector: [V; 3]) -> Rotation<V> {
    let [x, y, z] = three!(k => vector[k].times(0.5));
    let square = x * x + y * y + z * z;
    let over = square.plus(1.0).inverse();
    let (twice, rest) = (over.times(2.0), over - square * over);
    let [xx, yy, zz] = [x * x * twice + rest, y * y * twice + rest, z * z * twice + rest];
    let [xy, xz, yz] = [x * y * twice, x * z * twice, y * z * twice];
    let [x, y, z] = [x * twice, y * twice, z * twice];
    [[xx, xy - z, xz + y], [xy + z, yy, yz - x], [xz - y, yz + x, zz]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotations_keep_lengths_and_turn_counter_clockwise() {
        let turn = rotation([0.0, 0.0, 1e-3]);
        assert!((turn[1][0] - 1e-3).abs() < 1e-9 && (turn[0][1] + 1e-3).abs() < 1e-9);
        let tensor = [3.0, -1.0, 0.5, 0.2, -0.7, 1.1];
        let there = rotation([0.4, -0.9, 0.3]);
        let back = rotation([-0.4, 0.9, -0.3]);
        let moved = turned(&tensor, &there);
        assert!((contraction(&moved, &moved) - contraction(&tensor, &tensor)).abs() < 1e-13);
        assert!((mean(moved) - mean(tensor)).abs() < 1e-15);
        let again = turned(&moved, &back);
        assert!((0..6).all(|k| (again[k] - tensor[k]).abs() < 1e-14), "{again:?}");
        // xx becomes yy by a quarter of a turn about z.
        let quarter = turned(&[1.0, 0.0, 0.0, 0.0, 0.0, 0.0], &rotation([0.0, 0.0, 2.0]));
        assert!((quarter[1] - 1.0).abs() < 1e-15, "{quarter:?}");
    }
}
