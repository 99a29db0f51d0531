//! Functions of `msdd.h` about RVEs.

use super::{give_text, sized, string, writable};
use crate::abi::{MSDD_CAPPED, MSDD_SETTLED, MSDD_UNJAMMED, msdd_averages, msdd_rve};
use crate::handles::RveHandle;
use crate::status::{Failure, status, value};
use ::msdd_rve::{
    Boundary, Compression, Material, Outcome, PackingSpec, Protocol, RegionKind, Relaxation, Strains, follow,
    homogenise, pack, state,
};
use serde::Deserialize;
use serde_json::Value;
use std::ffi::c_char;

/// Largest number of characters of a specification that a message shows.
const MAX_SHOWN: usize = 200;

/// Specification of a packing, as JSON.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Specification {
    discs: usize,
    seed: u64,
    porosity: f64,
    compression: Compression,
    boundary: Boundary,
    radius_min: f64,
    radius_max: f64,
    relaxation: Relaxation,
    material: Grains,
}

/// The material of a specification: unlike in a state file, keys may be left out and then have their defaults.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Grains {
    density: f64,
    young_modulus: f64,
    stiffness_ratio: f64,
    friction_angle: f64,
    wall_stiffness_factor: f64,
    damping: f64,
}

impl Default for Grains {
    fn default() -> Self {
        let Material {
            density,
            young_modulus,
            stiffness_ratio,
            friction_angle,
            wall_stiffness_factor,
            damping,
        } = Material::default();
        Self { density, young_modulus, stiffness_ratio, friction_angle, wall_stiffness_factor, damping }
    }
}

impl From<Grains> for Material {
    fn from(grains: Grains) -> Self {
        let Grains {
            density,
            young_modulus,
            stiffness_ratio,
            friction_angle,
            wall_stiffness_factor,
            damping,
        } = grains;
        Self { density, young_modulus, stiffness_ratio, friction_angle, wall_stiffness_factor, damping }
    }
}

impl Default for Specification {
    fn default() -> Self {
        let usual = PackingSpec::default();
        Self {
            discs: usual.discs,
            seed: usual.seed,
            porosity: usual.porosity,
            compression: usual.compression,
            boundary: usual.boundary,
            radius_min: usual.radius_min,
            radius_max: usual.radius_max,
            relaxation: usual.relaxation,
            material: Grains::default(),
        }
    }
}

impl Specification {
    /// Reads a JSON object. Arrays are refused here, because serde would take them for an object without keys.
    fn read(text: &str) -> Result<Self, Failure> {
        let refused = |name: &str, allowed: String| {
            let start: String = text.chars().take(MAX_SHOWN).collect();
            let more = if start.len() < text.len() { " and more" } else { "" };
            Failure::argument(name, format!("{start}{more}"), allowed)
        };
        // The text of a serde error may quote a key of any length.
        let reason =
            |error: serde_json::Error| error.to_string().chars().take(2 * MAX_SHOWN).collect::<String>();
        let json = |error| refused("specification", format!("a JSON object: {}", reason(error)));
        let value: Value = serde_json::from_str(text).map_err(json)?;
        if !value.is_object() {
            return Err(refused("specification", "a JSON object, as {\"discs\": 500}".to_string()));
        }
        if value.get("material").is_some_and(|material| !material.is_object()) {
            let allowed = "with \"material\" a JSON object, as {\"friction_angle\": 0.5}";
            return Err(refused("specification", allowed.to_string()));
        }
        serde_json::from_str(text).map_err(json)
    }

    fn packed(self) -> Result<RveHandle, Failure> {
        let spec = PackingSpec {
            discs: self.discs,
            seed: self.seed,
            porosity: self.porosity,
            compression: self.compression,
            boundary: self.boundary,
            radius_min: self.radius_min,
            radius_max: self.radius_max,
            relaxation: self.relaxation,
        };
        let simulation = pack(&spec, &self.material.into())?.simulation;
        // Soft walls may let grains through. Such a state could be written, but not be read again: refuse it here.
        state::from_json(&state::to_json(&simulation)?)?;
        Ok(RveHandle { simulation })
    }
}

/// Gives a new RVE to the caller as a handle.
///
/// # Safety
/// `out` is writable.
unsafe fn give(out: *mut *mut msdd_rve, rve: RveHandle) {
    // SAFETY: writable by this function's contract.
    unsafe { out.write(Box::into_raw(Box::new(rve)).cast()) };
}

/// # Safety
/// `rve` is null or a live handle.
unsafe fn handle<'a>(rve: *const msdd_rve) -> Result<&'a RveHandle, Failure> {
    // SAFETY: null or live by this function's contract; live handles come from `give`.
    unsafe { rve.cast::<RveHandle>().as_ref() }.ok_or_else(|| Failure::null("rve"))
}

/// `msdd_rve_pack`
///
/// # Safety
/// `specification` is null or a C string; `out` is null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_rve_pack(specification: *const c_char, out: *mut *mut msdd_rve) -> i32 {
    status(|| {
        let out = writable("out", out)?;
        let specification = if specification.is_null() {
            Specification::default()
        } else {
            // SAFETY: a C string by this function's contract.
            Specification::read(&unsafe { string("specification", specification)? })?
        };
        let rve = specification.packed()?;
        // SAFETY: not null, writable by this function's contract.
        unsafe { give(out, rve) };
        Ok(())
    })
}

/// `msdd_rve_from_json`
///
/// # Safety
/// `text` is null or a C string; `out` is null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_rve_from_json(text: *const c_char, out: *mut *mut msdd_rve) -> i32 {
    status(|| {
        let out = writable("out", out)?;
        // SAFETY: null or a C string by this function's contract.
        let text = unsafe { string("text", text)? };
        let simulation = state::from_json(&text)?;
        // SAFETY: not null, writable by this function's contract.
        unsafe { give(out, RveHandle { simulation }) };
        Ok(())
    })
}

/// `msdd_rve_to_json`
///
/// # Safety
/// `rve` is null or a live handle; `out` is null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_rve_to_json(rve: *const msdd_rve, out: *mut *mut c_char) -> i32 {
    status(|| {
        let out = writable("out", out)?;
        // SAFETY: null or live by this function's contract.
        let text = state::to_json(&unsafe { handle(rve)? }.simulation)?;
        // SAFETY: not null, writable by this function's contract.
        unsafe { give_text(out, &text) };
        Ok(())
    })
}

/// `msdd_rve_clone`
///
/// # Safety
/// `rve` is null or a live handle; `out` is null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_rve_clone(rve: *const msdd_rve, out: *mut *mut msdd_rve) -> i32 {
    status(|| {
        let out = writable("out", out)?;
        // SAFETY: null or live, and `out` writable, by this function's contract.
        unsafe { give(out, handle(rve)?.clone()) };
        Ok(())
    })
}

/// `msdd_rve_strain`
///
/// # Safety
/// `rve` is null or a live handle that no other thread uses; `outcome` is null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_rve_strain(
    rve: *mut msdd_rve,
    thermal: f64,
    xx: f64,
    yy: f64,
    xy: f64,
    outcome: *mut i32,
) -> i32 {
    status(|| {
        // SAFETY: null or live, and this thread's alone, by this function's contract.
        let rve = unsafe { rve.cast::<RveHandle>().as_mut() }.ok_or_else(|| Failure::null("rve"))?;
        let mut simulation = rve.simulation.clone();
        let path = [Strains { thermal, xx, yy, xy }];
        let protocol = Protocol::usual(&simulation);
        let ramp = follow(&mut simulation, &path, protocol, |_, _| ())?;
        if let Some(failure) = ramp.failure {
            return Err(failure.into());
        }
        rve.simulation = simulation;
        let reached = match ramp.stops.last().map(|stop| stop.settled.outcome) {
            Some(Outcome::Unjammed) => MSDD_UNJAMMED,
            Some(Outcome::Capped) => MSDD_CAPPED,
            Some(Outcome::Settled) | None => MSDD_SETTLED,
        };
        if !outcome.is_null() {
            // SAFETY: not null, writable by this function's contract.
            unsafe { outcome.write(reached as i32) };
        }
        Ok(())
    })
}

/// `msdd_rve_homogenise`
///
/// # Safety
/// `rve` is null or a live handle; `averages` is null or points to its struct (to its `struct_size` at least), writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_rve_homogenise(rve: *const msdd_rve, averages: *mut msdd_averages) -> i32 {
    status(|| {
        // SAFETY: null or pointing to its struct, by this function's contract.
        let msdd_averages { struct_size, .. } = unsafe { sized("averages", averages.cast_const())? };
        // SAFETY: null or live by this function's contract.
        let a = homogenise(&unsafe { handle(rve)? }.simulation, RegionKind::default());
        let result = msdd_averages {
            struct_size,
            porosity: a.porosity,
            porosity_sum_of_areas: a.porosity_sum_of_areas,
            fabric_index: a.fabric_index,
            fabric_conductivity: a.fabric_conductivity,
            conductivity_xx: a.conductivity_xx,
            conductivity_yy: a.conductivity_yy,
            conductivity_xy: a.conductivity_xy,
            conductivity_network_xx: a.conductivity_network_xx,
            conductivity_network_yy: a.conductivity_network_yy,
            conductivity_network_xy: a.conductivity_network_xy,
            stress_xx: a.stress_xx,
            stress_yy: a.stress_yy,
            stress_xy: a.stress_xy,
            stress_yx: a.stress_yx,
            pressure: a.pressure,
            coordination: a.coordination,
            mean_radius: a.mean_radius,
            rattlers: a.rattlers,
            contacts: a.contacts,
        };
        // SAFETY: not null, and of full size, as checked.
        unsafe { averages.write(result) };
        Ok(())
    })
}

/// `msdd_rve_free`
///
/// # Safety
/// `rve` is null or a live handle, which nobody uses from now on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_rve_free(rve: *mut msdd_rve) {
    if !rve.is_null() {
        // SAFETY: made by `Box::into_raw` in `give`, and freed once, by this function's contract.
        value((), || drop(unsafe { Box::from_raw(rve.cast::<RveHandle>()) }));
    }
}
