//! Readers of texts, and what each of them must guarantee for any text.

use crate::common::{self, Cells, Model, OK, last_error};
use ::msdd_rve::database::{Plan, Recipe};
use msdd::abi::{self, msdd_averages, msdd_rve};
use msdd::exports::*;
use std::ffi::{CString, c_void};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::ptr::null_mut;

const INTERNAL: i32 = abi::MSDD_INTERNAL as i32;

/// Path of a file that only this thread uses.
pub fn scratch(name: &str) -> PathBuf {
    let thread = format!("{:?}", std::thread::current().id());
    let number: String = thread.chars().filter(char::is_ascii_digit).collect();
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("fuzz-{name}-{number}"))
}

/// Overwrites a file without truncating it to zero length first: some file systems write a file that was truncated and
/// replaced to the disk at once, which is slow.
pub fn write(file: &Path, text: &str) {
    let mut open = std::fs::OpenOptions::new();
    let mut file = open.create(true).truncate(false).write(true).open(file).expect("writable");
    file.write_all(text.as_bytes()).expect("writable");
    file.set_len(text.len() as u64).expect("writable");
}

/// A model that is accepted must give results that grains can have, for cells inside and far outside of its range.
pub fn model(text: &str) -> Result<bool, String> {
    let file = scratch("model-file");
    write(&file, text);
    let model = match Model::load(&file.to_string_lossy()) {
        Ok(model) => model,
        Err((INTERNAL, message)) => return Err(message),
        Err(_) => return Ok(false),
    };
    let mut cells = Cells::new(&model, 24);
    for (cell, value) in [1e-3, 0.9, -1.0, 1e6, -1e200, f64::MAX].into_iter().enumerate() {
        cells.state[cell % 2][cell] = value;
        cells.thermal_strain[6 + cell] = value.clamp(-0.9, 1e6);
        cells.state.last_mut().expect("columns")[12 + cell] = value;
    }
    for _ in 0..3 {
        match cells.advance_with(&model, |_| ()) {
            OK => (),
            _ => return Err(last_error()),
        }
        let finite = cells.next.iter().chain(&cells.outputs[..6]).flatten().all(|value| value.is_finite());
        let grains = cells.outputs[..2].iter().flatten().all(|k| *k > 0.0)
            && cells.outputs[2..4].iter().flatten().all(|s| *s >= 0.0);
        let tangent =
            !model.has_tangent() || cells.outputs[6..].iter().flatten().all(|value| value.is_finite());
        let spread = cells.spread.iter().all(|s| s.is_nan() || *s >= 0.0);
        if !(finite && grains && tangent && spread) {
            let found = (finite, grains, tangent, spread);
            return Err(format!(
                "accepted, but (finite, grains, tangent, spread) = {found:?}: {:?}",
                cells.outputs
            ));
        }
        cells.state.clone_from(&cells.next);
    }
    let (porosity, mut solid) = ([0.0, 0.1, 0.9], [f64::NAN; 3]);
    // SAFETY: live handle, columns of three.
    let status = unsafe { msdd_model_solid_fraction(model.0, 3, porosity.as_ptr(), solid.as_mut_ptr()) };
    match status == OK && solid.iter().all(|s| s.is_finite()) {
        true => Ok(true),
        false => Err(format!("accepted, but its solid fractions are {solid:?}")),
    }
}

/// A state that is accepted must have finite averages, and must be the same when it is written and read again.
pub fn state(text: &str) -> Result<bool, String> {
    let Ok(text) = CString::new(text) else { return Ok(false) };
    let mut rve = null_mut();
    // SAFETY: a C string, and `rve` is writable.
    match unsafe { msdd_rve_from_json(text.as_ptr(), &mut rve) } {
        OK => (),
        INTERNAL => return Err(last_error()),
        _ => return Ok(false),
    }
    // SAFETY: live, and freed once.
    let result = unsafe {
        let result = sound(rve);
        msdd_rve_free(rve);
        result
    };
    result.map(|()| true)
}

/// # Safety
/// A live handle.
unsafe fn sound(rve: *mut msdd_rve) -> Result<(), String> {
    // SAFETY: live handles by this function's contract, a struct of numbers, and writable outputs.
    unsafe {
        let mut averages: msdd_averages = std::mem::zeroed();
        averages.struct_size = size_of::<msdd_averages>();
        let status = msdd_rve_homogenise(rve, &mut averages);
        if status == INTERNAL {
            return Err(last_error());
        }
        let numbers = [averages.porosity, averages.fabric_index, averages.conductivity_xx, averages.pressure];
        if status == OK && !numbers.iter().all(|value| value.is_finite()) {
            return Err(format!("accepted, but its averages are {averages:?}"));
        }
        let (mut first, mut again, mut second) = (null_mut(), null_mut(), null_mut());
        if msdd_rve_to_json(rve, &mut first) != OK || msdd_rve_from_json(first, &mut again) != OK {
            return Err(format!("accepted, but its own text is not: {}", last_error()));
        }
        assert_eq!(msdd_rve_to_json(again, &mut second), OK);
        let same = common::text(first) == common::text(second);
        msdd_rve_free(again);
        msdd_text_free(first);
        msdd_text_free(second);
        if same { Ok(()) } else { Err("accepted, but its text changes when read".to_string()) }
    }
}

/// A plan that is accepted must have packings with valid specifications, and finite strains at which they are recorded.
pub fn plan(text: &str) -> Result<bool, String> {
    let Ok(plan) = Plan::parse(text, "plan") else { return Ok(false) };
    let jobs = plan.jobs();
    let sound = jobs.iter().all(|job| {
        job.spec.discs > 0
            && job.spec.porosity > 0.0
            && job.spec.porosity < 1.0
            && job.stops.iter().all(|s| s.is_finite())
    });
    match !jobs.is_empty() && jobs.len() <= 1_000_000 && sound && plan.mean_radius() > 0.0 {
        true => Ok(true),
        false => Err(format!("accepted, but {} packings, sound: {sound}", jobs.len())),
    }
}

/// A plan that the C interface accepts must start, and stop at the first call of `progress`.
pub fn plan_through_c(text: &str) -> Result<bool, String> {
    extern "C" fn stop(_user: *mut c_void, _done: u64, _total: u64, _failed: u64) -> i32 {
        1
    }
    let parsed = Plan::parse(text, "plan").map(|plan| plan.jobs().len());
    let path = scratch("database");
    let _ = std::fs::remove_dir_all(&path);
    let (Ok(plan), Ok(name)) = (CString::new(text), CString::new(path.to_string_lossy().as_bytes())) else {
        return Ok(false);
    };
    // SAFETY: C strings, and a call-back that takes any user.
    let status = unsafe { msdd_database_generate(plan.as_ptr(), name.as_ptr(), 1, Some(stop), null_mut()) };
    match (parsed, status) {
        (_, INTERNAL) => Err(last_error()),
        // A plan without packings never calls `progress`.
        (Ok(0), OK) => Ok(true),
        (Ok(_), status) if status == abi::MSDD_CANCELLED as i32 => Ok(true),
        (Err(_), status) if status == abi::MSDD_RVE as i32 => Ok(false),
        (parsed, status) => Err(format!("{parsed:?}, but status {status}: {}", last_error())),
    }
}

/// Whether a specification, if the text is one, is packed in milliseconds: it has few grains, and they are not so stiff
/// that moving the walls takes many more time steps than usual (their number is proportional to the root of E r/rho).
fn soon_packed(text: &str) -> bool {
    let Ok(value) = serde_json::from_str::<serde_json::Value>(text) else { return true };
    let number =
        |pointer: &str, usual: f64| value.pointer(pointer).map_or(Some(usual), |found| found.as_f64());
    let numbers = [
        number("/discs", 500.0),
        number("/material/young_modulus", 1e7),
        number("/radius_max", 7e-3),
        number("/material/density", 3e3),
    ];
    let [Some(discs), Some(young_modulus), Some(radius), Some(density)] = numbers else { return true };
    // Infinite and NaN values are refused before any packing.
    let stiffness = young_modulus * radius / density;
    discs <= 24.0 && (stiffness <= 1e4 || !stiffness.is_finite())
}

/// A specification of few grains must be packed, or refused with a text.
pub fn specification(text: &str) -> Result<bool, String> {
    let few = soon_packed(text);
    let (Ok(text), true) = (CString::new(text), few) else { return Ok(false) };
    let mut rve = null_mut();
    // SAFETY: a C string, and `rve` is writable; a live handle is freed once.
    unsafe {
        match msdd_rve_pack(text.as_ptr(), &mut rve) {
            OK => {
                let result = sound(rve);
                msdd_rve_free(rve);
                result.map(|()| true)
            }
            INTERNAL => Err(last_error()),
            _ if rve.is_null() && !last_error().is_empty() => Ok(false),
            status => Err(format!("status {status}, text \"{}\", handle {rve:?}", last_error())),
        }
    }
}
