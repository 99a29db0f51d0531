//! Ranges of single values of a new case: for the whole of it, and for each answer as soon as it is given.

use crate::numbers::rounded;
use crate::walls::WallOverTime;
use crate::{CaseError, refused};
use msdd_beds::named_gases::GasName;
use msdd_rve::message::number;

/// Largest number of cells of a case; a run with more would take too long to be useful.
pub const MAX_CELLS: usize = 4_000_000;

/// Refuses a value that is not `good`; `key`: its name.
///
/// # Errors
/// [`CaseError::Parameter`], as of all functions here.
pub fn allow(key: &str, value: f64, good: bool, allowed: impl FnOnce() -> String) -> Result<(), CaseError> {
    if good { Ok(()) } else { Err(refused(key, number(value), allowed())) }
}

/// A length of a bed \[m\] with at least four grains of this radius side by side; the radius of a cylinder is half of its width.
pub fn length(key: &str, value: f64, radius: f64, what: &str) -> Result<(), CaseError> {
    let least = if key.starts_with("radius") { 4.0 * radius } else { 8.0 * radius };
    allow(key, value, (least..=1e6).contains(&value), || {
        format!("{} to 1e6 m, since a {what} side by side", number(rounded(least, 3)))
    })
}

/// Numbers of cells along each direction.
pub fn cells(along: &[usize]) -> Result<(), CaseError> {
    let all = along.iter().fold(1_usize, |product, &count| product.saturating_mul(count));
    allow("cells", all as f64, (1..=MAX_CELLS).contains(&all), || format!("1 to {MAX_CELLS} in all"))
}

/// What a temperature of a bed of discs may be \[K\].
const DISC_TEMPERATURES: [f64; 2] = [0.0, 1e5];

/// A temperature of a bed of discs \[K\].
pub fn temperature(key: &str, value: f64) -> Result<(), CaseError> {
    let [low, high] = DISC_TEMPERATURES;
    allow(key, value, (low..=high).contains(&value), || {
        format!("{low} to {high:e} K; temperatures are in kelvin")
    })
}

/// A temperature at which the gas between spheres is known \[K\].
pub fn temperature_with(gas: GasName, key: &str, value: f64) -> Result<(), CaseError> {
    let [low, high] = gas.range();
    let high = high.min(1e5);
    allow(key, value, (low..=high).contains(&value), || {
        let (low, high) = (number(low), number(high));
        format!("{low} to {high} K, the table of {gas}; temperatures are in kelvin")
    })
}

/// All temperatures of a wall over time, its coefficient and its flux.
pub fn wall(wall: &WallOverTime, check: impl Fn(f64) -> Result<(), CaseError>) -> Result<(), CaseError> {
    match *wall {
        WallOverTime::Coefficient { coefficient: h, .. } => {
            let allowed = || "more than 0, at most 1e6 W/(m2 K)".to_string();
            allow("heat transfer coefficient h of a wall", h, h > 0.0 && h <= 1e6, allowed)?;
        }
        WallOverTime::Flux(q) => {
            allow("heat flux q of a wall", q, q.abs() <= 1e9, || "-1e9 to 1e9 W/m2".to_string())?;
        }
        _ => (),
    }
    wall.temperatures().into_iter().try_for_each(check)
}

/// \[Pa\]
pub fn gas_pressure(value: f64) -> Result<(), CaseError> {
    allow("gas pressure", value, (1e-3..=1e9).contains(&value), || "1e-3 to 1e9 Pa".to_string())
}

/// \[m/s²\]
pub fn gravity(value: f64) -> Result<(), CaseError> {
    allow("gravity", value, (0.0..=1e3).contains(&value), || "0 to 1000 m/s2 downwards".to_string())
}

/// A coefficient of friction. The solver declares the upper limit of its key.
pub fn wall_friction(value: f64) -> Result<(), CaseError> {
    allow("wall friction", value, (0.0..f64::INFINITY).contains(&value), || ">= 0".to_string())
}

/// \[W/m³\]
pub fn heat_source(value: f64) -> Result<(), CaseError> {
    allow("heat source", value, value.abs() <= 1e15, || "-1e15 to 1e15 W/m3".to_string())
}

/// What the end of a run may be \[s\].
const END_TIMES: [f64; 2] = [1e-9, 1e12];

/// \[s\]
pub fn end_time(value: f64) -> Result<(), CaseError> {
    let [low, high] = END_TIMES;
    allow("end time", value, (low..=high).contains(&value), || format!("{low:e} to {high:e} s"))
}

/// Largest error of T that a time step may add \[K\].
pub fn tolerance(value: f64) -> Result<(), CaseError> {
    allow("tolerance", value, (1e-12..=1e6).contains(&value), || "1e-12 to 1e6 K".to_string())
}
