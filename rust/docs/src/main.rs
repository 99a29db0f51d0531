//! What builds and checks the book in `docs` and the README.
#![forbid(unsafe_code)]

fn main() {}
