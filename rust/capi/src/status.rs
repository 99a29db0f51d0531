//! Conversion of errors to status codes and texts.

use crate::{abi, panics};
use msdd_plugin::{PluginError, shown};
use msdd_rve::database::DatabaseError;
use msdd_rve::{RveError, state::StateError};
use msdd_surrogate::SurrogateError;
use msdd_training::TrainingError;
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char};

/// What an export can fail with.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    #[error("{0} is NULL")]
    Null(String),
    #[error("{name} = {value}, allowed: {allowed}")]
    Argument { name: String, value: String, allowed: String },
    #[error("{column}[{index}] = {value} is not finite")]
    NonFinite { column: String, index: usize, value: f64 },
    #[error("cannot read model file \"{path}\": {error}")]
    File { path: String, error: std::io::Error },
    #[error("model \"{path}\": {error}")]
    Model { path: String, error: SurrogateError },
    #[error("{0}")]
    Plugin(#[from] PluginError),
    #[error("{0}")]
    Rve(#[from] RveError),
    #[error("{0}")]
    State(#[from] StateError),
    #[error("{0}")]
    Database(#[from] DatabaseError),
    #[error("{0}")]
    Training(#[from] TrainingError),
    #[error("stopped by the progress call-back")]
    Cancelled,
}

impl Failure {
    pub fn null(name: &str) -> Self {
        Self::Null(name.to_string())
    }

    pub fn argument(name: impl ToString, value: impl ToString, allowed: impl ToString) -> Self {
        Self::Argument { name: name.to_string(), value: value.to_string(), allowed: allowed.to_string() }
    }

    /// As [`Failure::argument`], for a number.
    pub fn number(name: impl ToString, value: f64, allowed: impl ToString) -> Self {
        Self::argument(name, shown(value), allowed)
    }

    fn status(&self) -> i32 {
        let status = match self {
            Self::Null(_) | Self::Argument { .. } | Self::Rve(RveError::Parameter { .. }) => {
                abi::MSDD_INVALID_ARGUMENT
            }
            Self::File { .. } | Self::Plugin(PluginError::Read { .. }) => abi::MSDD_IO,
            Self::Plugin(_) => abi::MSDD_PLUGIN,
            Self::Database(DatabaseError::Plan { .. }) | Self::Rve(_) | Self::State(_) => abi::MSDD_RVE,
            Self::Database(_) => abi::MSDD_IO,
            Self::Model { .. } | Self::Training(TrainingError::Surrogate { .. }) => abi::MSDD_MODEL,
            Self::Training(TrainingError::Data(_)) => abi::MSDD_INVALID_ARGUMENT,
            Self::Training(_) => abi::MSDD_IO,
            Self::NonFinite { .. } => abi::MSDD_NON_FINITE,
            Self::Cancelled => abi::MSDD_CANCELLED,
        };
        status as i32
    }
}

/// The header's constants as statuses.
pub(crate) const OK: i32 = abi::MSDD_OK as i32;
pub(crate) const INTERNAL: i32 = abi::MSDD_INTERNAL as i32;

thread_local! {
    static LAST_ERROR: RefCell<CString> = RefCell::default();
}

/// Runs the body of an export: the status of its result, its text kept for [`last_error`].
///
/// Unwind safety: a body has no state of its own, and writes to the caller's memory last, after everything that may
/// panic. If a bug leaves a batch half-written nevertheless, the status is [`INTERNAL`].
pub(crate) fn status(body: impl FnOnce() -> Result<(), Failure>) -> i32 {
    match panics::caught(body) {
        Ok(Ok(())) => OK,
        Ok(Err(failure)) => {
            remember(failure.to_string());
            failure.status()
        }
        Err(text) => {
            remember(format!("internal error (a bug in msdd): {text}"));
            INTERNAL
        }
    }
}

/// The same for an export that returns a value: `fallback` after a panic.
pub(crate) fn value<T>(fallback: T, body: impl FnOnce() -> T) -> T {
    let mut result = fallback;
    status(|| {
        result = body();
        Ok(())
    });
    result
}

fn remember(text: String) {
    LAST_ERROR.with(|last| *last.borrow_mut() = c_string(&text));
}

/// Valid until the next failure on this thread.
pub(crate) fn last_error() -> *const c_char {
    LAST_ERROR.with(|last| last.borrow().as_ptr())
}

/// A C string; NUL bytes, which it cannot hold, become U+FFFD.
pub(crate) fn c_string(text: &str) -> CString {
    CString::new(text.replace('\0', "\u{fffd}")).unwrap_or_default()
}

/// A caller's string as UTF-8.
pub(crate) fn utf8(name: &str, text: &CStr) -> Result<String, Failure> {
    let bytes = || text.to_string_lossy().into_owned();
    text.to_str().map(str::to_string).map_err(|_| Failure::argument(name, bytes(), "UTF-8 text"))
}
