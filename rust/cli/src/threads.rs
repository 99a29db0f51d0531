//! Arguments that are numbers of threads.

use clap::builder::{RangedI64ValueParser, TypedValueParser};

/// Largest number that is accepted, the same as in the C interface; more is taken for a mistake.
const MAX_THREADS: i64 = 1024;

/// The parser of all arguments that are a number of threads.
pub fn parser() -> impl TypedValueParser<Value = u32> {
    RangedI64ValueParser::<u32>::new().range(1..=MAX_THREADS)
}
