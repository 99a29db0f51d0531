//! Numbers of threads.

use clap::builder::{RangedI64ValueParser, TypedValueParser};

/// More than anybody can mean; that of the C interface, too.
const MOST: i64 = 1024;

/// The parser of all arguments that are one.
pub fn parser() -> impl TypedValueParser<Value = u32> {
    RangedI64ValueParser::<u32>::new().range(1..=MOST)
}
