//! Sums of outer products, from which normal equations are formed.

use super::dispatch::{Task, dispatch};
use super::vector::{LANES, Vector};

struct OuterProducts<'a> {
    rows: &'a [f64],
    width: usize,
    matrix: &'a mut [f64],
}

impl Task for OuterProducts<'_> {
    #[inline(always)]
    fn run<V: Vector>(self) {
        outer_generic::<V>(self.rows, self.width, self.matrix);
    }
}

/// Adds Σ_rows row ⊗ row to the lower triangle of `matrix`, `width` × `width`, stored by rows; `width` is a multiple of
/// 16. Each sum runs in one fixed order and so has the same bits with every instruction set.
pub fn add_outer_products(rows: &[f64], width: usize, matrix: &mut [f64]) {
    dispatch(OuterProducts { rows, width, matrix });
}

/// Rows of the part of the matrix that is kept in registers; it is one vector wide.
const TILE: usize = 4;

#[inline(always)]
fn outer_generic<V: Vector>(rows: &[f64], width: usize, matrix: &mut [f64]) {
    for first in (0..width).step_by(TILE) {
        for column in (0..first + TILE).step_by(LANES) {
            let mut sums = [V::zero(); TILE];
            for row in rows.chunks_exact(width) {
                let right = V::read(&row[column..]);
                let left: &[f64; TILE] =
                    row[first..].first_chunk().expect("width is a multiple of the lanes");
                for (sum, left) in sums.iter_mut().zip(left) {
                    *sum = right.fused(V::all(*left), *sum);
                }
            }
            for (i, sum) in sums.iter().enumerate() {
                let entries = &mut matrix[(first + i) * width + column..];
                (V::read(entries) + *sum).write(entries);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::vector::Portable;

    #[test]
    fn outer_products_are_those_of_the_definition_and_the_same_bits_in_every_instruction_set() {
        let (width, count) = (48, 13);
        let rows: Vec<f64> = (0..width * count).map(|i| ((i * 37 % 101) as f64 - 50.0) * 0.013).collect();
        let (mut matrix, mut portable) = (vec![0.5; width * width], vec![0.5; width * width]);
        add_outer_products(&rows, width, &mut matrix);
        outer_generic::<Portable>(&rows, width, &mut portable);
        assert!(matrix.iter().zip(&portable).all(|(a, b)| a.to_bits() == b.to_bits()));
        for i in 0..width {
            for j in 0..=i {
                let sum: f64 = rows.chunks_exact(width).map(|row| row[i] * row[j]).sum();
                assert!((matrix[i * width + j] - 0.5 - sum).abs() < 1e-12);
            }
        }
    }
}
