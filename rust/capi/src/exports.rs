//! Functions of `msdd.h`. Each turns pointers into references and calls safe code; none lets a panic out.

use crate::batch;
use crate::columns::{Input, Output};
use crate::ffi::{MSDD_ABI_VERSION, msdd_batch, msdd_material, msdd_surrogate};
use crate::status::{Failure, c_string, last_error, status, utf8, value};
use ::msdd_surrogate::Model;
use ::msdd_surrogate::kernel::LANES;
use std::ffi::{CStr, c_char};
use std::ptr::null;

const VERSION: &CStr = match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
    Ok(version) => version,
    Err(_) => panic!("a version has no NUL"),
};

/// `msdd_abi_version`
#[unsafe(no_mangle)]
pub extern "C" fn msdd_abi_version() -> u32 {
    MSDD_ABI_VERSION
}

/// `msdd_version`
#[unsafe(no_mangle)]
pub extern "C" fn msdd_version() -> *const c_char {
    VERSION.as_ptr()
}

/// `msdd_last_error`
#[unsafe(no_mangle)]
pub extern "C" fn msdd_last_error() -> *const c_char {
    value(c"".as_ptr(), last_error)
}

/// `msdd_surrogate_load`
///
/// # Safety
/// `source` is null or a C string; `out` is null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_load(source: *const c_char, out: *mut *mut msdd_surrogate) -> i32 {
    status(|| {
        if out.is_null() {
            return Err(Failure::Null("out"));
        }
        let source = if source.is_null() {
            BUILTIN.to_string()
        } else {
            // SAFETY: not null, a C string by this function's contract.
            utf8("source", unsafe { CStr::from_ptr(source) })?
        };
        let handle = Box::into_raw(Box::new(load(source)?));
        // SAFETY: not null, writable by this function's contract.
        unsafe { out.write(handle) };
        Ok(())
    })
}

/// Name of the model compiled into the library.
const BUILTIN: &str = "builtin";

fn load(path: String) -> Result<msdd_surrogate, Failure> {
    let model = if path == BUILTIN {
        Model::builtin()
    } else {
        match std::fs::read_to_string(&path) {
            Ok(text) => Model::from_json(&text),
            Err(error) => return Err(Failure::File { path, error }),
        }
    };
    let model = model.map_err(|error| Failure::Model { path, error })?;
    let (hash, description) = (c_string(model.hash()), c_string(&model.description()));
    Ok(msdd_surrogate { model, hash, description })
}

/// `msdd_surrogate_hash`
///
/// # Safety
/// `surrogate` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_hash(surrogate: *const msdd_surrogate) -> *const c_char {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { surrogate.as_ref() };
    value(null(), || handle.map_or(null(), |handle| handle.hash.as_ptr()))
}

/// `msdd_surrogate_describe`
///
/// # Safety
/// `surrogate` is null or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_describe(surrogate: *const msdd_surrogate) -> *const c_char {
    // SAFETY: null or live by this function's contract.
    let handle = unsafe { surrogate.as_ref() };
    value(null(), || handle.map_or(null(), |handle| handle.description.as_ptr()))
}

/// `msdd_surrogate_evaluate`
///
/// # Safety
/// `surrogate` is null or a live handle; the others are null or point to their struct (to its `struct_size` at least);
/// the batch's columns are null or hold `cells` values, those of outputs writable by this thread alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_evaluate(
    surrogate: *const msdd_surrogate,
    material: *const msdd_material,
    batch: *mut msdd_batch,
) -> i32 {
    status(|| {
        // SAFETY: null or live by this function's contract.
        let handle = unsafe { surrogate.as_ref() }.ok_or(Failure::Null("surrogate"))?;
        // SAFETY: null or pointing to their structs, by this function's contract.
        let (material, columns) =
            unsafe { (sized("material", material)?, sized("batch", batch.cast_const())?) };
        // SAFETY: the columns are as this function's contract says.
        let clamped_cells = unsafe { batch::evaluate(&handle.model, &material, &columns)? };
        // SAFETY: not null, and of full size, as checked.
        unsafe { (*batch).clamped_cells = clamped_cells };
        Ok(())
    })
}

/// Copy of a caller's struct, whose first field is its size.
///
/// # Safety
/// `pointer` is null or points to a struct that is as long as its first field says and, if that is long enough, a `T`.
unsafe fn sized<T: Copy>(name: &'static str, pointer: *const T) -> Result<T, Failure> {
    if pointer.is_null() {
        return Err(Failure::Null(name));
    }
    // SAFETY: not null; every such struct starts with its size.
    let size = unsafe { pointer.cast::<usize>().read() };
    if size != size_of::<T>() {
        return Err(Failure::argument(format!("{name}.struct_size"), size, size_of::<T>()));
    }
    // SAFETY: as long as a `T`, hence one, by this function's contract.
    Ok(unsafe { pointer.read() })
}

/// `msdd_surrogate_solid_fraction`
///
/// # Safety
/// `surrogate` is null or a live handle; the columns are null or hold `cells` values, the output's writable by this
/// thread alone.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_solid_fraction(
    surrogate: *const msdd_surrogate,
    cells: usize,
    porosity: *const f64,
    solid_fraction: *mut f64,
) -> i32 {
    status(|| {
        // SAFETY: null or live by this function's contract.
        let handle = unsafe { surrogate.as_ref() }.ok_or(Failure::Null("surrogate"))?;
        // SAFETY: null or `cells` values by this function's contract.
        let (input, output) =
            unsafe { (Input::new("porosity", porosity, cells)?, Output::new(solid_fraction, cells)) };
        if solid_fraction.is_null() && cells > 0 {
            return Err(Failure::Null("solid_fraction"));
        }
        input.check_finite()?;
        for first in (0..cells).step_by(LANES) {
            output.write(first, &input.lanes(first).map(|porosity| handle.model.solid_fraction(porosity)));
        }
        Ok(())
    })
}

/// `msdd_surrogate_free`
///
/// # Safety
/// `surrogate` is null or a live handle, which nobody uses from now on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_surrogate_free(surrogate: *mut msdd_surrogate) {
    if !surrogate.is_null() {
        // SAFETY: made by `Box::into_raw` in `msdd_surrogate_load`, and freed once, by this function's contract.
        value((), || drop(unsafe { Box::from_raw(surrogate) }));
    }
}
