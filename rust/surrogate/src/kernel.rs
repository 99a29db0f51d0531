//! The network's arithmetic in blocks of eight cells, compiled once per instruction set.
//!
//! Every operation acts on each lane alone and in one fixed order, and Rust never fuses a multiplication with an
//! addition: so all instruction sets give the same bits, and a cell's answer does not depend on its neighbours.
//! No operation raises invalid, divide-by-zero or overflow for finite inputs and weights up to
//! [`WEIGHT_LIMIT`](crate::network::WEIGHT_LIMIT).
#![allow(unsafe_code)] // dispatch alone: see `activations`

use crate::network::{HIDDEN, INPUTS, OUTPUTS, WEIGHTS};
use crate::perceptron::Neurons;
use crate::state::model::Core;
use crate::surrogate::{Answer, StateLanes};

/// Cells in a block: one AVX-512 register of f64.
pub const LANES: usize = 8;

/// One quantity of a block of cells.
pub type Lanes = [f64; LANES];

/// Values of all neurons for a block of cells.
pub struct Activations {
    pub hidden_1: [Lanes; HIDDEN],
    pub hidden_2: [Lanes; HIDDEN],
    pub outputs: [Lanes; OUTPUTS],
}

/// Compiles a function once per instruction set; calls take the widest that the machine has.
macro_rules! dispatch {
    ($(#[$doc:meta])* pub fn $name:ident($($argument:ident: $kind:ty),*) = $portable:ident) => {
        $(#[$doc])*
        pub fn $name($($argument: $kind),*) {
            #[cfg(target_arch = "x86_64")]
            {
                #[target_feature(enable = "avx512f,avx512dq")]
                unsafe fn avx512($($argument: $kind),*) {
                    $portable($($argument),*);
                }
                #[target_feature(enable = "avx2")]
                unsafe fn avx2($($argument: $kind),*) {
                    $portable($($argument),*);
                }
                if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
                    // SAFETY: the processor has the instructions; the function has no other requirement.
                    return unsafe { avx512($($argument),*) };
                }
                if is_x86_feature_detected!("avx2") {
                    // SAFETY: the processor has the instructions; the function has no other requirement.
                    return unsafe { avx2($($argument),*) };
                }
            }
            $portable($($argument),*);
        }
    };
}

/// Instruction set that the kernels take on this machine: "avx512", "avx2" or "scalar".
pub fn simd() -> &'static str {
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
            return "avx512";
        }
        if is_x86_feature_detected!("avx2") {
            return "avx2";
        }
    }
    "scalar"
}

dispatch! {
    /// Eight queries of a state model, as [`Core::block`], which it is the whole of: compiled as one piece, so that not
    /// only the networks but the features and limits between them are vectorised.
    pub fn state_block(core: &Core, state: &StateLanes, strain: &Lanes, answer: &mut Answer) = state_block_portable
}

#[inline(always)]
fn state_block_portable(core: &Core, state: &StateLanes, strain: &Lanes, answer: &mut Answer) {
    core.block_into(state, strain, answer);
}

dispatch! {
    /// Runs a [`crate::perceptron::Perceptron`] on the inputs in layer 0; leaves all neurons' values.
    pub fn forward(sizes: &[usize], weights: &[f64], neurons: &mut Neurons) = forward_portable
}

/// As [`forward`], for callers that are compiled per instruction set themselves.
#[inline(always)]
pub fn forward_portable(sizes: &[usize], weights: &[f64], neurons: &mut Neurons) {
    let mut rest = weights;
    for layer in 1..sizes.len() {
        let (inputs, count) = (sizes[layer - 1], sizes[layer]);
        let (here, after) = rest.split_at((inputs + 1) * count);
        rest = after;
        let (before, behind) = neurons.layers.split_at_mut(layer);
        let (before, values) = (&before[layer - 1][..inputs], &mut behind[0][..count]);
        let hidden = layer + 1 < sizes.len();
        // Four neurons at a time: their chains of additions and tanh overlap in the pipeline.
        let mut fours = values.chunks_exact_mut(4);
        let mut rows = here.chunks_exact(4 * (inputs + 1));
        for (values, rows) in fours.by_ref().zip(rows.by_ref()) {
            neurons_of::<4>(values, rows, before, hidden);
        }
        let rest = rows.remainder().chunks_exact(inputs + 1);
        for (value, row) in fours.into_remainder().iter_mut().zip(rest) {
            neurons_of::<1>(std::slice::from_mut(value), row, before, hidden);
        }
    }
}

/// N neurons of one layer, which depend on each other in nothing.
#[inline(always)]
fn neurons_of<const N: usize>(values: &mut [Lanes], rows: &[f64], before: &[Lanes], hidden: bool) {
    let width = before.len() + 1;
    let mut sums: [Lanes; N] = std::array::from_fn(|n| [rows[n * width + before.len()]; LANES]);
    for (k, input) in before.iter().enumerate() {
        for (n, sum) in sums.iter_mut().enumerate() {
            let weight = rows[n * width + k];
            for lane in 0..LANES {
                sum[lane] += weight * input[lane];
            }
        }
    }
    if hidden {
        for value in sums.as_flattened_mut() {
            *value = tanh(*value);
        }
    }
    values[..N].copy_from_slice(&sums);
}

/// Runs the network on a block of scaled inputs, with the widest instruction set that the machine has.
pub fn activations(weights: &[f64; WEIGHTS], inputs: &[Lanes; INPUTS]) -> Activations {
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
            // SAFETY: the processor has the instructions; the function has no other requirement.
            return unsafe { activations_avx512(weights, inputs) };
        }
        if is_x86_feature_detected!("avx2") {
            // SAFETY: the processor has the instructions; the function has no other requirement.
            return unsafe { activations_avx2(weights, inputs) };
        }
    }
    activations_portable(weights, inputs)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq")]
unsafe fn activations_avx512(weights: &[f64; WEIGHTS], inputs: &[Lanes; INPUTS]) -> Activations {
    activations_portable(weights, inputs)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
unsafe fn activations_avx2(weights: &[f64; WEIGHTS], inputs: &[Lanes; INPUTS]) -> Activations {
    activations_portable(weights, inputs)
}

#[inline(always)]
fn activations_portable(weights: &[f64; WEIGHTS], inputs: &[Lanes; INPUTS]) -> Activations {
    let (first, rest) = weights.split_at(HIDDEN * (INPUTS + 1));
    let (second, third) = rest.split_at(HIDDEN * (HIDDEN + 1));
    let mut hidden_1 = layer::<INPUTS, HIDDEN>(first, inputs);
    tanh_all(&mut hidden_1);
    let mut hidden_2 = layer::<HIDDEN, HIDDEN>(second, &hidden_1);
    tanh_all(&mut hidden_2);
    let outputs = layer::<HIDDEN, OUTPUTS>(third, &hidden_2);
    Activations { hidden_1, hidden_2, outputs }
}

/// Weighted sums of one layer. `weights`: per neuron its I weights, then its bias.
#[inline(always)]
fn layer<const I: usize, const O: usize>(weights: &[f64], inputs: &[Lanes; I]) -> [Lanes; O] {
    let mut sums = [[0.0; LANES]; O];
    // Two neurons at a time: their additions overlap in the pipeline.
    for (pair, rows) in sums.chunks_exact_mut(2).zip(weights.chunks_exact(2 * (I + 1))) {
        let (row_a, row_b) = rows.split_at(I + 1);
        let (mut a, mut b) = ([row_a[I]; LANES], [row_b[I]; LANES]);
        for (k, input) in inputs.iter().enumerate() {
            for lane in 0..LANES {
                a[lane] += row_a[k] * input[lane];
                b[lane] += row_b[k] * input[lane];
            }
        }
        (pair[0], pair[1]) = (a, b);
    }
    sums
}

#[inline(always)]
fn tanh_all(values: &mut [Lanes; HIDDEN]) {
    for value in values.as_flattened_mut() {
        *value = tanh(*value);
    }
}

dispatch! {
    /// Adds Σ_rows row ⊗ row to the lower triangle of `matrix`, `width` × `width`, row by row; `width` is a multiple
    /// of 16. Every sum runs in one fixed order: the same bits with every instruction set.
    pub fn add_outer_products(rows: &[f64], width: usize, matrix: &mut [f64]) = outer_portable
}

/// Rows and columns of a register tile.
const TILE: [usize; 2] = [4, 16];

#[inline(always)]
fn outer_portable(rows: &[f64], width: usize, matrix: &mut [f64]) {
    for first in (0..width).step_by(TILE[0]) {
        for column in (0..first + TILE[0]).step_by(TILE[1]) {
            let mut sums = [[0.0; TILE[1]]; TILE[0]];
            for row in rows.chunks_exact(width) {
                let right: &[f64; TILE[1]] = row[column..].first_chunk().expect("width is a multiple of 16");
                let left: &[f64; TILE[0]] = row[first..].first_chunk().expect("width is a multiple of 16");
                for (sums, left) in sums.iter_mut().zip(left) {
                    for (sum, right) in sums.iter_mut().zip(right) {
                        *sum += left * right;
                    }
                }
            }
            for (i, sums) in sums.iter().enumerate() {
                for (entry, sum) in matrix[(first + i) * width + column..].iter_mut().zip(sums) {
                    *entry += sum;
                }
            }
        }
    }
}

/// ln 2 in two parts; the high one has 21 trailing zero bits, so n · LN2_HIGH is exact for |n| < 2^20.
const LN2_HIGH: f64 = f64::from_bits(0x3FE6_2E42_FEE0_0000);
const LN2_LOW: f64 = f64::from_bits(0x3DEA_39EF_3579_3C76);
/// 1.5 · 2^52: adding it rounds to an integer, which then stands in the low bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;
/// 1/k! for k = 2 to 13. The next term is below 1.2e-17 of the sum for |r| <= ln 2 / 2.
const INVERSE_FACTORIALS: [f64; 12] = [
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5_040.0,
    1.0 / 40_320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
    1.0 / 39_916_800.0,
    1.0 / 479_001_600.0,
    1.0 / 6_227_020_800.0,
];

/// Σ r^k / (k + 2)!, in Estrin's order: its short chains of dependent operations halve the time of Horner's.
#[inline(always)]
fn series(r: f64) -> f64 {
    let c = &INVERSE_FACTORIALS;
    let r2 = r * r;
    let r4 = r2 * r2;
    let low = (c[0] + c[1] * r) + (c[2] + c[3] * r) * r2;
    let middle = (c[4] + c[5] * r) + (c[6] + c[7] * r) * r2;
    let high = (c[8] + c[9] * r) + (c[10] + c[11] * r) * r2;
    low + (middle + high * r4) * r4
}

/// tanh x = (e^{2|x|} − 1) / (e^{2|x|} + 1) with the sign of x, to 4 units in the last place, without branches. libm's
/// tanh is not vectorised, differs between systems, and may raise floating-point exceptions.
#[inline(always)]
pub fn tanh(x: f64) -> f64 {
    let magnitude = x.abs();
    // tanh rounds to 1 beyond 19.1; the limit keeps e^{2x} small.
    let doubled = 2.0 * if magnitude < 20.0 { magnitude } else { 20.0 };
    // e^doubled = 2^n e^r with |r| <= ln 2 / 2.
    let rounded = doubled * std::f64::consts::LOG2_E + ROUNDER;
    let n = rounded - ROUNDER;
    let power = f64::from_bits((rounded.to_bits() << 52).wrapping_add(1023 << 52));
    let r = (doubled - n * LN2_HIGH) - n * LN2_LOW;
    // e^r − 1, then e^doubled − 1: no cancellation near zero, where n = 0.
    let small = r + r * r * series(r);
    let excess = power * small + (power - 1.0);
    (excess / (excess + 2.0)).copysign(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distance in units in the last place of `b`.
    fn ulps(a: f64, b: f64) -> f64 {
        (a - b).abs() / (b.abs().max(f64::MIN_POSITIVE) * f64::EPSILON / 2.0)
    }

    #[test]
    fn tanh_agrees_with_the_standard_library() {
        let mut worst = 0.0f64;
        for i in -40_000..=40_000 {
            let x = f64::from(i) * 5.3e-4;
            worst = worst.max(ulps(tanh(x), x.tanh()));
            let tiny = f64::from(i) * 1e-12;
            worst = worst.max(ulps(tanh(tiny), tiny.tanh()));
        }
        // Units of half an ulp of the largest number of the binade, so 8 here is 4 ulp at most.
        assert!(worst <= 8.0, "{worst} half units");
    }

    #[test]
    fn tanh_saturates_and_keeps_sign() {
        for huge in [19.5, 400.0, 1e10, f64::MAX] {
            assert_eq!(tanh(huge), 1.0);
            assert_eq!(tanh(-huge), -1.0);
        }
        assert_eq!(tanh(0.0).to_bits(), 0.0f64.to_bits());
        assert_eq!(tanh(-0.0).to_bits(), (-0.0f64).to_bits());
        assert_eq!(tanh(1e-300), 1e-300);
    }

    #[test]
    fn outer_products_are_those_of_the_definition_and_the_same_bits_in_every_instruction_set() {
        let (width, count) = (48, 13);
        let rows: Vec<f64> = (0..width * count).map(|i| ((i * 37 % 101) as f64 - 50.0) * 0.013).collect();
        let (mut matrix, mut portable) = (vec![0.5; width * width], vec![0.5; width * width]);
        add_outer_products(&rows, width, &mut matrix);
        outer_portable(&rows, width, &mut portable);
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
        let bits = |a: Activations| a.outputs.map(|lanes| lanes.map(f64::to_bits));
        let portable = bits(activations_portable(&weights, &inputs));
        assert_eq!(bits(activations(&weights, &inputs)), portable);
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx2") {
            // SAFETY: checked in the line above.
            assert_eq!(bits(unsafe { activations_avx2(&weights, &inputs) }), portable);
        }
    }
}
