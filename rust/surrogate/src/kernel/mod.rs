//! The networks' arithmetic in blocks of cells, compiled once per instruction set.
//!
//! Every operation acts on each lane alone and in one fixed order, and a multiplication is fused with an addition exactly
//! where it is written so: all instruction sets give the same bits, and a cell's answer does not depend on its neighbours.
//! A processor without fused multiply-add (x86-64 before 2013) gets them from the mathematical library, slowly.
//! No operation raises invalid, divide-by-zero or overflow for finite inputs and weights up to
//! [`WEIGHT_LIMIT`](crate::network::WEIGHT_LIMIT).
#![allow(unsafe_code)] // calls of functions compiled for an instruction set, and buffers without values

mod elementary;
pub mod vector;
#[cfg(target_arch = "x86_64")]
mod x86;

use crate::network::{HIDDEN, INPUTS, OUTPUTS, WEIGHTS};
use crate::perceptron::{MAX_LAYERS, Neurons, WIDTH};
use crate::state::model::Core;
use crate::state::rates::{RateInputs, Rates};
use crate::surrogate::{Answer, StateLanes};
use std::mem::MaybeUninit;
use std::sync::atomic::{AtomicU8, Ordering};
use vector::{Portable, Vector};

/// Cells in a block: two AVX-512 registers of f64, whose chains of dependent operations overlap.
pub const LANES: usize = 16;

/// One quantity of a block of cells.
pub type Lanes = [f64; LANES];

/// Values of all neurons of the paper's network for a block of cells.
pub struct Activations {
    pub hidden_1: [Lanes; HIDDEN],
    pub hidden_2: [Lanes; HIDDEN],
    pub outputs: [Lanes; OUTPUTS],
}

/// Instruction sets by rank: what [`limit`] allows at most.
const SETS: [&str; 3] = ["scalar", "avx2", "avx512"];
static ALLOWED: AtomicU8 = AtomicU8::new(SETS.len() as u8 - 1);

/// Makes the kernels of this process use no wider set than this one ("scalar", "avx2", "avx512"): for measurements; the
/// bits are the same. Unknown names change nothing.
pub fn limit(set: &str) {
    if let Some(rank) = SETS.iter().position(|known| *known == set) {
        ALLOWED.store(rank as u8, Ordering::Relaxed);
    }
}

#[cfg(target_arch = "x86_64")]
#[inline]
fn has_avx512() -> bool {
    is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("fma")
        && ALLOWED.load(Ordering::Relaxed) >= 2
}

#[cfg(target_arch = "x86_64")]
#[inline]
fn has_avx2() -> bool {
    is_x86_feature_detected!("avx2")
        && is_x86_feature_detected!("fma")
        && ALLOWED.load(Ordering::Relaxed) >= 1
}

/// Instruction set that the kernels take on this machine: "avx512", "avx2" or "scalar".
pub fn simd() -> &'static str {
    #[cfg(target_arch = "x86_64")]
    {
        if has_avx512() {
            return "avx512";
        }
        if has_avx2() {
            return "avx2";
        }
    }
    "scalar"
}

/// Compiles a function of one vector type once per instruction set; calls take the widest that the machine has.
macro_rules! dispatch {
    ($(#[$doc:meta])* pub fn $name:ident($($argument:ident: $kind:ty),*) = $generic:expr) => {
        $(#[$doc])*
        pub fn $name($($argument: $kind),*) {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx512f,avx512dq,fma")]
                unsafe fn avx512($($argument: $kind),*) {
                    type V = x86::Avx512;
                    $generic
                }
                #[target_feature(enable = "avx2,fma")]
                unsafe fn avx2($($argument: $kind),*) {
                    type V = x86::Avx2;
                    $generic
                }
                if has_avx512() {
                    // SAFETY: the processor has the instructions; the function has no other requirement.
                    return unsafe { avx512($($argument),*) };
                }
                if has_avx2() {
                    // SAFETY: the processor has the instructions; the function has no other requirement.
                    return unsafe { avx2($($argument),*) };
                }
            }
            type V = Portable;
            $generic
        }
    };
}

dispatch! {
    /// Queries of a state model by a block of cells.
    pub fn state_block(core: &Core, state: &StateLanes, strain: &Lanes, virgin: &Lanes, answer: &mut Answer) =
        core.block_into::<V>(state, strain, virgin, answer)
}

dispatch! {
    /// Advances a block of states by the rates: [`Rates::advanced`]; leaves all neurons' values.
    pub fn advance(
        rates: &Rates,
        from: RateInputs<'_>,
        neurons: &mut Neurons,
        next: &mut StateLanes
    ) = advance_generic::<V>(rates, from, neurons, next)
}

#[inline(always)]
fn advance_generic<V: Vector>(
    rates: &Rates,
    from: RateInputs<'_>,
    neurons: &mut Neurons,
    next: &mut StateLanes,
) {
    neurons.layers[0][..from.features.even.len()].copy_from_slice(&from.features.even);
    forward_generic::<V>(&rates.network.sizes, &rates.network.weights, neurons);
    let outputs = &neurons.layers[rates.network.sizes.len() - 1];
    rates.advanced::<V>(&from, outputs, next);
}

dispatch! {
    /// Runs a [`crate::perceptron::Perceptron`] on the inputs in layer 0; leaves all neurons' values.
    pub fn forward(sizes: &[usize], weights: &[f64], neurons: &mut Neurons) =
        forward_generic::<V>(sizes, weights, neurons)
}

#[inline(always)]
fn forward_generic<V: Vector>(sizes: &[usize], weights: &[f64], neurons: &mut Neurons) {
    let mut rest = weights;
    for layer in 1..sizes.len() {
        let (inputs, count) = (sizes[layer - 1], sizes[layer]);
        let (here, after) = rest.split_at((inputs + 1) * count);
        rest = after;
        let (before, behind) = neurons.layers.split_at_mut(layer);
        let (before, values) = (&before[layer - 1][..inputs], &mut behind[0][..count]);
        layer_of::<V>(here, before, over(values), layer + 1 < sizes.len());
    }
}

/// Room for the values of all layers but the inputs. Clearing it would cost as much as a layer, hence the type.
pub type Buffers = [[MaybeUninit<Lanes>; WIDTH]; MAX_LAYERS - 1];

/// Buffers for [`outputs`].
#[inline(always)]
pub fn buffers() -> Buffers {
    [[MaybeUninit::uninit(); WIDTH]; MAX_LAYERS - 1]
}

/// The outputs of a [`crate::perceptron::Perceptron`], for callers that are compiled per instruction set themselves.
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

/// One layer; all of `values` is written. `weights`: per neuron those of the neurons before, then its bias. Four neurons at
/// a time: their chains of additions and tanh overlap in the pipeline.
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
    // SAFETY: fours, twos and the last are all of them, and `neurons_of` wrote each; the layout is the same.
    unsafe { &*(std::ptr::from_ref(values) as *const [Lanes]) }
}

/// N neurons of one layer, which depend on each other in nothing; all of `values` is written.
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

/// Values that are there, as a place for new ones.
#[inline(always)]
fn over(values: &mut [Lanes]) -> &mut [MaybeUninit<Lanes>] {
    // SAFETY: the same layout, and in this module nothing but whole values is written to it.
    unsafe { &mut *(std::ptr::from_mut(values) as *mut [MaybeUninit<Lanes>]) }
}

/// Runs the paper's network on a block of scaled inputs.
pub fn activations(weights: &[f64; WEIGHTS], inputs: &[Lanes; INPUTS]) -> Activations {
    let zero = [0.0; LANES];
    let mut all =
        Activations { hidden_1: [zero; HIDDEN], hidden_2: [zero; HIDDEN], outputs: [zero; OUTPUTS] };
    activate(weights, inputs, &mut all);
    all
}

dispatch! {
    /// As [`activations`].
    pub fn activate(weights: &[f64; WEIGHTS], inputs: &[Lanes; INPUTS], all: &mut Activations) =
        activate_generic::<V>(weights, inputs, all)
}

#[inline(always)]
fn activate_generic<V: Vector>(weights: &[f64; WEIGHTS], inputs: &[Lanes; INPUTS], all: &mut Activations) {
    let (first, rest) = weights.split_at(HIDDEN * (INPUTS + 1));
    let (second, third) = rest.split_at(HIDDEN * (HIDDEN + 1));
    layer_of::<V>(first, inputs, over(&mut all.hidden_1), true);
    layer_of::<V>(second, &all.hidden_1, over(&mut all.hidden_2), true);
    layer_of::<V>(third, &all.hidden_2, over(&mut all.outputs), false);
}

dispatch! {
    /// Adds Σ_rows row ⊗ row to the lower triangle of `matrix`, `width` × `width`, row by row; `width` is a multiple
    /// of 16. Every sum runs in one fixed order: the same bits with every instruction set.
    pub fn add_outer_products(rows: &[f64], width: usize, matrix: &mut [f64]) =
        outer_generic::<V>(rows, width, matrix)
}

/// Rows of a register tile; its columns are one vector's.
const TILE: usize = 4;

#[inline(always)]
fn outer_generic<V: Vector>(rows: &[f64], width: usize, matrix: &mut [f64]) {
    for first in (0..width).step_by(TILE) {
        for column in (0..first + TILE).step_by(LANES) {
            let mut sums = [V::zero(); TILE];
            for row in rows.chunks_exact(width) {
                let right = V::read(row[column..].first_chunk().expect("width is a multiple of the lanes"));
                let left: &[f64; TILE] =
                    row[first..].first_chunk().expect("width is a multiple of the lanes");
                for (sum, left) in sums.iter_mut().zip(left) {
                    *sum = right.fused(V::all(*left), *sum);
                }
            }
            for (i, sum) in sums.iter().enumerate() {
                let entries = &mut matrix[(first + i) * width + column..];
                let entries = entries.first_chunk_mut().expect("width is a multiple of the lanes");
                (V::read(entries) + *sum).write(entries);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn every_instruction_set_gives_the_same_bits() {
        let weights: [f64; WEIGHTS] = std::array::from_fn(|i| ((i * 37 % 101) as f64 - 50.0) * 0.03);
        let inputs: [Lanes; INPUTS] =
            std::array::from_fn(|k| std::array::from_fn(|lane| ((k * 8 + lane) as f64 * 0.71).sin()));
        let bits = |a: &Activations| a.outputs.map(|lanes| lanes.map(f64::to_bits));
        let best = activations(&weights, &inputs);
        let mut other = activations(&weights, &[[0.0; LANES]; INPUTS]);
        activate_generic::<Portable>(&weights, &inputs, &mut other);
        assert_eq!(bits(&best), bits(&other));
        #[cfg(target_arch = "x86_64")]
        if has_avx2() {
            #[target_feature(enable = "avx2,fma")]
            unsafe fn avx2(weights: &[f64; WEIGHTS], inputs: &[Lanes; INPUTS], all: &mut Activations) {
                activate_generic::<x86::Avx2>(weights, inputs, all);
            }
            other = activations(&weights, &[[0.0; LANES]; INPUTS]);
            // SAFETY: checked above.
            unsafe { avx2(&weights, &inputs, &mut other) };
            assert_eq!(bits(&best), bits(&other));
        }
    }
}
