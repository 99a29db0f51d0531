//! Seeds of packings.

use sha2::{Digest, Sha256};

/// Seed of one packing. It depends on the plan's seed and the index only, not on order or threads. It has 53 bits, so
/// that CSV readers which hold numbers as f64 keep it exactly.
pub(super) fn packing_seed(plan_seed: u64, packing: u64) -> u64 {
    let mut bytes = plan_seed.to_le_bytes().to_vec();
    bytes.extend(packing.to_le_bytes());
    let digest = Sha256::digest(&bytes);
    let first = digest.iter().take(8).fold(0u64, |value, &byte| value << 8 | u64::from(byte));
    first >> 11
}
