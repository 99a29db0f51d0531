//! Layers of tanh networks on blocks of cells.

use super::elementary;
use super::vector::{Lanes, Vector};

/// Computes one layer and writes all of `values`, for callers that are themselves compiled per instruction set. `weights`
/// holds for each neuron the weights of the neurons of the layer before, then its bias. Four neurons are computed at a
/// time, so that their chains of additions and tanh overlap in the pipeline.
#[inline(always)]
pub fn layer<V: Vector>(weights: &[f64], before: &[Lanes], values: &mut [Lanes], hidden: bool) {
    let width = before.len() + 1;
    let (fours, rest) = values.as_chunks_mut::<4>();
    let (rows, rest_rows) = weights.split_at(4 * width * fours.len());
    for (values, rows) in fours.iter_mut().zip(rows.chunks_exact(4 * width)) {
        neurons::<V, 4>(values, rows, before, hidden);
    }
    let (twos, last) = rest.as_chunks_mut::<2>();
    let (rows, last_row) = rest_rows.split_at(2 * width * twos.len());
    for (values, rows) in twos.iter_mut().zip(rows.chunks_exact(2 * width)) {
        neurons::<V, 2>(values, rows, before, hidden);
    }
    if let [last] = last {
        neurons::<V, 1>(std::array::from_mut(last), last_row, before, hidden);
    }
}

/// Computes N independent neurons of one layer and writes all of `values`.
#[inline(always)]
fn neurons<V: Vector, const N: usize>(values: &mut [Lanes; N], rows: &[f64], before: &[Lanes], hidden: bool) {
    let width = before.len() + 1;
    let rows = &rows[..N * width];
    let mut sums = [V::zero(); N];
    for (n, sum) in sums.iter_mut().enumerate() {
        *sum = V::all(rows[n * width + before.len()]);
    }
    for (k, input) in before.iter().enumerate() {
        let input = V::read(input);
        for (n, sum) in sums.iter_mut().enumerate() {
            *sum = input.fused(V::all(rows[n * width + k]), *sum);
        }
    }
    if hidden {
        elementary::tanh(&mut sums);
    }
    for (value, sum) in values.iter_mut().zip(sums) {
        sum.write(value);
    }
}
