//! Seeds of packings and of their paths.

use sha2::{Digest, Sha256};

/// Seed of one packing. It depends on the plan's seed and the index only, not on order or threads. It has 53 bits, so
/// that CSV readers which hold numbers as f64 keep it exactly.
pub(super) fn packing_seed(plan_seed: u64, packing: u64) -> u64 {
    seed_of(plan_seed, &packing.to_le_bytes()) >> 11
}

/// A seed that follows from another one and from what it is for, as the name of a path.
pub(super) fn seed_of(seed: u64, what: &[u8]) -> u64 {
    let digest = Sha256::digest([&seed.to_le_bytes(), what].concat());
    digest.iter().take(8).fold(0, |value, &byte| value << 8 | u64::from(byte))
}
