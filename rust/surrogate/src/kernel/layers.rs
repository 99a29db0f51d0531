//! Layers of tanh networks on blocks of cells.

use super::dispatch::{Task, dispatch};
use super::elementary;
use super::vector::{Lanes, Vector};
use std::mem::MaybeUninit;

/// Largest number of inputs, neurons of a hidden layer, or outputs.
pub const WIDTH: usize = 16;
/// Largest number of layers: inputs, two hidden layers, outputs.
pub const MAX_LAYERS: usize = 4;

/// Values of all neurons of a block of cells, layer by layer; the inputs are layer 0.
pub type LayerValues = [[Lanes; WIDTH]; MAX_LAYERS];

struct Forward<'a> {
    sizes: &'a [usize],
    weights: &'a [f64],
    layers: &'a mut LayerValues,
}

impl Task for Forward<'_> {
    #[inline(always)]
    fn run<V: Vector>(self) {
        all_layers::<V>(self.sizes, self.weights, self.layers);
    }
}

/// Runs a [`crate::perceptron::Perceptron`] on the inputs in layer 0; `layers` then holds the values of all neurons.
pub fn forward(sizes: &[usize], weights: &[f64], layers: &mut LayerValues) {
    dispatch(Forward { sizes, weights, layers });
}

/// As [`forward`], for callers that are themselves compiled per instruction set.
#[inline(always)]
pub fn all_layers<V: Vector>(sizes: &[usize], weights: &[f64], layers: &mut LayerValues) {
    let mut rest = weights;
    for index in 1..sizes.len() {
        let (inputs, count) = (sizes[index - 1], sizes[index]);
        let (here, after) = rest.split_at((inputs + 1) * count);
        rest = after;
        let (before, behind) = layers.split_at_mut(index);
        let (before, values) = (&before[index - 1][..inputs], &mut behind[0][..count]);
        layer::<V>(here, before, values, index + 1 < sizes.len());
    }
}

/// Memory for the values of all layers except the inputs. It is uninitialised, because clearing it would cost as much
/// as a layer.
pub type Buffers = [[MaybeUninit<Lanes>; WIDTH]; MAX_LAYERS - 1];

/// Buffers for [`outputs`].
#[inline(always)]
pub fn buffers() -> Buffers {
    [[MaybeUninit::uninit(); WIDTH]; MAX_LAYERS - 1]
}

/// The outputs of a [`crate::perceptron::Perceptron`], for callers that are themselves compiled per instruction set.
#[inline(always)]
pub fn outputs<'a, V: Vector>(
    sizes: &[usize],
    weights: &[f64],
    inputs: &'a [Lanes],
    buffers: &'a mut Buffers,
) -> &'a [Lanes] {
    let (mut rest, mut values) = (weights, &inputs[..sizes[0]]);
    for (layer, buffer) in (1..sizes.len()).zip(buffers) {
        let (here, after) = rest.split_at((sizes[layer - 1] + 1) * sizes[layer]);
        values = layer_of::<V>(here, values, &mut buffer[..sizes[layer]], layer + 1 < sizes.len());
        rest = after;
    }
    values
}

/// Computes one layer and writes all of `values`. `weights` holds for each neuron the weights of the neurons of the
/// layer before, then its bias. Four neurons are computed at a time, so that their chains of additions and tanh overlap
/// in the pipeline.
#[inline(always)]
fn layer_of<'a, V: Vector>(
    weights: &[f64],
    before: &[Lanes],
    values: &'a mut [MaybeUninit<Lanes>],
    hidden: bool,
) -> &'a [Lanes] {
    let width = before.len() + 1;
    let (fours, rest) = values.as_chunks_mut::<4>();
    let (rows, rest_rows) = weights.split_at(4 * width * fours.len());
    for (values, rows) in fours.iter_mut().zip(rows.chunks_exact(4 * width)) {
        neurons_of::<V, 4>(values, rows, before, hidden);
    }
    let (twos, last) = rest.as_chunks_mut::<2>();
    let (rows, last_row) = rest_rows.split_at(2 * width * twos.len());
    for (values, rows) in twos.iter_mut().zip(rows.chunks_exact(2 * width)) {
        neurons_of::<V, 2>(values, rows, before, hidden);
    }
    if let [last] = last {
        neurons_of::<V, 1>(std::array::from_mut(last), last_row, before, hidden);
    }
    // SAFETY: groups of four, of two and the last neuron cover all of them, and `neurons_of` has written each; the
    // layout is the same.
    unsafe { &*(std::ptr::from_ref(values) as *const [Lanes]) }
}

/// Computes N independent neurons of one layer and writes all of `values`.
#[inline(always)]
fn neurons_of<V: Vector, const N: usize>(
    values: &mut [MaybeUninit<Lanes>; N],
    rows: &[f64],
    before: &[Lanes],
    hidden: bool,
) {
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
        sum.write_new(value);
    }
}

/// Computes one layer into initialised memory, for callers that are themselves compiled per instruction set.
#[inline(always)]
pub fn layer<V: Vector>(weights: &[f64], before: &[Lanes], values: &mut [Lanes], hidden: bool) {
    layer_of::<V>(weights, before, over(values), hidden);
}

/// Initialised values, viewed as memory for new ones.
#[inline(always)]
fn over(values: &mut [Lanes]) -> &mut [MaybeUninit<Lanes>] {
    // SAFETY: the layout is the same, and this module writes only whole values to it.
    unsafe { &mut *(std::ptr::from_mut(values) as *mut [MaybeUninit<Lanes>]) }
}
