//! Functions of `msdd.h`. Each turns pointers into references and calls safe code, and catches panics.

mod compared;
mod database;
mod model;
mod rve;
mod train;
mod wall;

pub use compared::*;
pub use database::*;
pub use model::*;
pub use rve::*;
pub use train::*;
pub use wall::*;

use crate::abi::MSDD_ABI_VERSION;
use crate::status::{Failure, c_string, last_error, utf8, value};
use std::ffi::{CStr, CString, c_char};

const VERSION: &CStr = match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
    Ok(version) => version,
    Err(_) => panic!("a version has no NUL"),
};

/// `msdd_abi_version`
///
/// # Safety
/// No conditions.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_abi_version() -> u32 {
    MSDD_ABI_VERSION
}

/// `msdd_version`
///
/// # Safety
/// No conditions.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_version() -> *const c_char {
    VERSION.as_ptr()
}

/// `msdd_last_error`
///
/// # Safety
/// No conditions.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_last_error() -> *const c_char {
    value(c"".as_ptr(), last_error)
}

/// `msdd_text_free`
///
/// # Safety
/// `text` is null or came from a function of this library, and is used no more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_text_free(text: *mut c_char) {
    if !text.is_null() {
        // SAFETY: made by `CString::into_raw` in `give_text`, and freed once, by this function's contract.
        value((), || drop(unsafe { CString::from_raw(text) }));
    }
}

/// Gives a text to the caller, who frees it with `msdd_text_free`.
///
/// # Safety
/// `out` is writable.
unsafe fn give_text(out: *mut *mut c_char, text: &str) {
    // SAFETY: writable by this function's contract.
    unsafe { out.write(c_string(text).into_raw()) };
}

/// Reads a string of the caller.
///
/// # Safety
/// `text` is null or a C string.
unsafe fn string(name: &'static str, text: *const c_char) -> Result<String, Failure> {
    if text.is_null() {
        return Err(Failure::null(name));
    }
    // SAFETY: not null, a C string by this function's contract.
    utf8(name, unsafe { CStr::from_ptr(text) })
}

/// Refuses a null `out`.
fn writable<T>(name: &'static str, out: *mut T) -> Result<*mut T, Failure> {
    if out.is_null() { Err(Failure::null(name)) } else { Ok(out) }
}

/// Copy of a caller's struct, whose first field is its size.
///
/// # Safety
/// `pointer` is null or points to a struct that is as long as its first field says and, if that is long enough, a `T`.
unsafe fn sized<T: Copy>(name: &'static str, pointer: *const T) -> Result<T, Failure> {
    if pointer.is_null() {
        return Err(Failure::null(name));
    }
    // SAFETY: not null; every such struct starts with its size.
    let size = unsafe { pointer.cast::<usize>().read() };
    if size != size_of::<T>() {
        return Err(Failure::argument(format!("{name}.struct_size"), size, size_of::<T>()));
    }
    // SAFETY: as long as a `T`, hence one, by this function's contract.
    Ok(unsafe { pointer.read() })
}
