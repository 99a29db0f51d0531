//! Symmetric tensors of three dimensions: xx, yy, zz, xy, xz, yz.

use super::number::Number;

/// Components xx, yy, zz, xy, xz, yz.
pub type Tensor<N = f64> = [N; 6];

/// A rotation matrix, row by row.
pub type Rotation = [[f64; 3]; 3];

/// A third of the trace.
pub fn mean<N: Number>([xx, yy, zz, ..]: Tensor<N>) -> N {
    (xx + yy + zz).times(1.0 / 3.0)
}

/// The tensor without its mean.
pub fn deviator<N: Number>(tensor: Tensor<N>) -> Tensor<N> {
    let mean = mean(tensor);
    let [xx, yy, zz, xy, xz, yz] = tensor;
    [xx - mean, yy - mean, zz - mean, xy, xz, yz]
}

/// Σ_ij a_ij b_ij.
pub fn contraction<N: Number>(a: &Tensor<N>, b: &Tensor<N>) -> N {
    let normal = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    normal + (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]).times(2.0)
}

pub fn sum<N: Number>(a: &Tensor<N>, b: &Tensor<N>) -> Tensor<N> {
    std::array::from_fn(|k| a[k] + b[k])
}

pub fn scaled<N: Number>(tensor: &Tensor<N>, factor: N) -> Tensor<N> {
    tensor.map(|component| component * factor)
}

/// T T.
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

/// R T Rᵀ.
pub fn turned<N: Number>(tensor: &Tensor<N>, rotation: &Rotation) -> Tensor<N> {
    let [xx, yy, zz, xy, xz, yz] = *tensor;
    let full = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let half: [[N; 3]; 3] = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            full[0][j].times(rotation[i][0])
                + full[1][j].times(rotation[i][1])
                + full[2][j].times(rotation[i][2])
        })
    });
    let at = |i: usize, j: usize| {
        half[i][0].times(rotation[j][0]) + half[i][1].times(rotation[j][1]) + half[i][2].times(rotation[j][2])
    };
    [at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(0, 2), at(1, 2)]
}

/// The rotation about the direction of a vector by twice the arc tangent of half of its length (Cayley), which for small angles is
/// the length \[rad\]; counter-clockwise seen from the vector's tip.
pub fn rotation([x, y, z]: [f64; 3]) -> Rotation {
    let [x, y, z] = [0.5 * x, 0.5 * y, 0.5 * z];
    let square = x * x + y * y + z * z;
    let over = 1.0 / (1.0 + square);
    let part = |a: f64, b: f64, c: f64| 2.0 * over * (a * b + c);
    let diagonal = |a: f64| over * (1.0 - square + 2.0 * a * a);
    [
        [diagonal(x), part(x, y, -z), part(x, z, y)],
        [part(x, y, z), diagonal(y), part(y, z, -x)],
        [part(x, z, -y), part(y, z, x), diagonal(z)],
    ]
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
