//! Functions of `msdd.h` about what was compared, and about gases.

use super::{string, writable};
use crate::sphere_material::{named, ranged};
use crate::status::{Failure, status};
use ::msdd_surrogate::compared::ranges;
use msdd_beds::named_gases::GasName;
use std::ffi::c_char;

/// Pressure \[Pa\] and accommodation, on which the conductivity of a gas does not depend.
const ANY: (f64, f64) = (1e5, 1.0);

/// `msdd_compared`
///
/// # Safety
/// `hash` and `quantity` are null or C strings; `least` and `most` are null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_compared(
    hash: *const c_char,
    quantity: *const c_char,
    least: *mut f64,
    most: *mut f64,
) -> i32 {
    status(|| {
        // SAFETY: null or C strings by this function's contract.
        let (hash, quantity) = unsafe { (string("hash", hash)?, string("quantity", quantity)?) };
        let (least, most) = (writable("least", least)?, writable("most", most)?);
        let known = ranges(&hash)
            .ok_or_else(|| Failure::argument("hash", &hash, "that of a default model, which was compared"))?;
        let names = || known.keys().map(String::as_str).collect::<Vec<_>>().join(", ");
        let range = known.get(&quantity).ok_or_else(|| Failure::argument("quantity", &quantity, names()))?;
        // SAFETY: not null, writable by this function's contract.
        unsafe {
            least.write(range[0]);
            most.write(range[1]);
        }
        Ok(())
    })
}

/// `msdd_gas_conductivity`
///
/// # Safety
/// `gas` is null or a C string; `conductivity` is null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_gas_conductivity(
    gas: *const c_char,
    temperature: f64,
    conductivity: *mut f64,
) -> i32 {
    status(|| {
        let out = writable("conductivity", conductivity)?;
        let gas = match gas.is_null() {
            true => GasName::Vacuum,
            // SAFETY: not null, a C string by this function's contract.
            false => named("gas", &unsafe { string("gas", gas)? })?,
        };
        let temperature = ranged("temperature", temperature, [1.0, 1e5], "1 to 1e5 K")?;
        let [low, high] = gas.range();
        let found = gas.at(temperature.clamp(low, high), ANY.0, ANY.1);
        // SAFETY: not null, writable by this function's contract.
        unsafe { out.write(found.map_or(0.0, |gas| gas.conductivity)) };
        Ok(())
    })
}

/// `msdd_gas_properties`
///
/// # Safety
/// `gas` is null or a C string; `properties` is null or holds six writable numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_gas_properties(
    gas: *const c_char,
    temperature: f64,
    properties: *mut f64,
) -> i32 {
    status(|| {
        let out = writable("properties", properties)?;
        // SAFETY: null or a C string by this function's contract.
        let gas = named("gas", &unsafe { string("gas", gas)? })?;
        let temperature = ranged("temperature", temperature, [1.0, 1e5], "1 to 1e5 K")?;
        let [low, high] = gas.range();
        let Some(found) = gas.flowing(temperature.clamp(low, high)) else {
            return Err(Failure::argument("gas", "vacuum", "a gas that flows"));
        };
        let values = [found.viscosity, found.conductivity, found.heat_capacity, found.molar_mass, low, high];
        // SAFETY: not null, six writable numbers by this function's contract.
        unsafe { out.cast::<[f64; 6]>().write(values) };
        Ok(())
    })
}
