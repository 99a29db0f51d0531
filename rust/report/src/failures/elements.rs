//! Limits of DEM.

use crate::jobs::job::Job;
use crate::plan;

/// The shipped models of discs.
pub const MODELS: [&str; 2] = ["rust/surrogate/models/increment.json", "rust/surrogate/models/paper.json"];

/// Largest stable time steps of 500 discs: `porosity`, `mechanical` and `thermal` \[s\], each by the bound and as measured.
pub fn stability(quick: bool) -> Job {
    let porosities = if quick { "0.09,0.12" } else { "0.06,0.07,0.08,0.09,0.1,0.12,0.14,0.17" };
    plan::tool(&format!("bench stability --porosity {porosities}"), &["rust/cli/examples/bench"], None, 300)
}

/// Rates of ramps, balance of forces, speed of walls and loss of contact, with the units of `bench limits`, an example of `rust/cli`.
pub fn limits(quick: bool) -> Job {
    let [first, second] = MODELS;
    let packings = if quick { 1 } else { 8 };
    let run =
        format!("bench limits --packings {packings} --model {first} --model {second} --out WORK/limits.json");
    plan::tool(
        &run,
        &["rust/cli/examples/bench", "rust/surrogate/src", first, second],
        Some("limits.json"),
        600,
    )
}
