//! The C interface from Rust: models, boxes of grains and databases through their exported functions.

mod answers;
mod refusals;
mod rves;
mod spheres;

#[path = "../../tests/common/mod.rs"]
mod common;

use crate::abi;
use crate::exports::*;
use common::{
    Cells, MATERIAL, Model, NOT_GIVEN, START, STEP, Tables, UNWANTED, input, inputs, last_error, output,
    outputs, text,
};
use std::ptr::{null, null_mut};

/// The header's constants as statuses.
const MSDD_OK: i32 = abi::MSDD_OK as i32;
const MSDD_INVALID_ARGUMENT: i32 = abi::MSDD_INVALID_ARGUMENT as i32;
const MSDD_IO: i32 = abi::MSDD_IO as i32;
const MSDD_MODEL: i32 = abi::MSDD_MODEL as i32;
const MSDD_NON_FINITE: i32 = abi::MSDD_NON_FINITE as i32;
const MSDD_RVE: i32 = abi::MSDD_RVE as i32;
const MSDD_CANCELLED: i32 = abi::MSDD_CANCELLED as i32;
const MSDD_INTERNAL: i32 = abi::MSDD_INTERNAL as i32;

fn load(source: &str) -> Model {
    Model::load(source).unwrap_or_else(|error| panic!("{source}: {error:?}"))
}

/// Cells that only swell.
fn swelling(model: &Model, cells: usize) -> Cells {
    let mut result = Cells::new(model, cells);
    result.strain = std::array::from_fn(|_| vec![0.0; cells]);
    result
}
