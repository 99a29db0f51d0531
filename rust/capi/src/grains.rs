//! Grains, and the gas between them, as a caller gives them.

use crate::abi::msdd_grains;
use crate::status::{Failure, utf8};
use std::ffi::CStr;

/// A copy of the caller's struct, which owns its text. The models check the numbers that they use.
pub(crate) struct Grains {
    pub numbers: msdd_grains,
    pub gas: Option<String>,
}

impl Grains {
    /// # Safety
    /// `gas` is null or a C string.
    pub unsafe fn new(numbers: msdd_grains) -> Result<Self, Failure> {
        let gas = match numbers.gas.is_null() {
            true => None,
            // SAFETY: not null, a C string by this function's contract.
            false => Some(utf8("material.gas", unsafe { CStr::from_ptr(numbers.gas) })?),
        };
        Ok(Self { numbers, gas })
    }
}
