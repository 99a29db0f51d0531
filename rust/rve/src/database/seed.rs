//! How many packings a plan may have, and seeds of packings and of their paths.

use sha2::{Digest, Sha256};

/// A plan with more packings is taken as a typing error: it would compute for months.
const MAX_PACKINGS: u64 = 1_000_000;

/// Refuses too many packings of blocks.
pub(super) fn check_count(packings: impl Iterator<Item = u64>) -> Result<(), String> {
    let packings = packings.fold(0, u64::saturating_add);
    match packings > MAX_PACKINGS {
        true => Err(format!("{packings} packings, allowed: {MAX_PACKINGS}")),
        false => Ok(()),
    }
}

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
