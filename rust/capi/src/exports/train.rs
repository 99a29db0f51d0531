//! The function of `msdd.h` that trains models.

use super::{give_text, string, writable};
use crate::status::{Failure, status};
use msdd_training::{Request, train};
use std::ffi::c_char;

/// `msdd_train`
///
/// # Safety
/// `request` is null or a C string; `model` is null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_train(request: *const c_char, model: *mut *mut c_char) -> i32 {
    status(|| {
        // SAFETY: null or a C string by this function's contract.
        let text = unsafe { string("request", request)? };
        let model = writable("model", model)?;
        let allowed = "a JSON object with \"database\" and other keys of msdd_train";
        let request: Request = serde_json::from_str(&text).map_err(|error| {
            Failure::argument("request", msdd_rve::message::shortened(&text), format!("{allowed}: {error}"))
        })?;
        let trained = train(&request)?;
        // SAFETY: writable by this function's contract.
        unsafe { give_text(model, &trained.to_json()) };
        Ok(())
    })
}
