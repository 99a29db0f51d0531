//! Panics stop here, and print nothing.
//!
//! Rust's panic hook prints before anything is unwound, and there is no way to keep it from that for one call: the hook is
//! one for the process. So ours is put around the one found, once, at the first call: it keeps the text of a panic that
//! happens inside of a guarded call, and hands all others (of a Rust program that uses this library) to the hook found. No
//! signal handler, no C-visible state, and nothing to restore: between calls it is as if it were not there. A program that
//! sets a hook of its own later replaces ours, and then sees a line per panic; statuses and texts stay.

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, PanicHookInfo, catch_unwind, set_hook, take_hook};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, Once};

thread_local! {
    /// Guarded calls on this thread, one inside the other.
    static DEPTH: Cell<usize> = const { Cell::new(0) };
    /// Of the last panic in them.
    static TEXT: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Guarded calls on all threads.
static ACTIVE: AtomicUsize = AtomicUsize::new(0);
/// Text of the last panic on a thread that a guarded call started: such threads have no name and no depth.
static WORKER: Mutex<Option<String>> = Mutex::new(None);

/// Result of a call, or the text of its panic and the place where it happened.
///
/// Unwind safety is the caller's to argue.
pub(crate) fn caught<T>(call: impl FnOnce() -> T) -> Result<T, String> {
    static HOOK: Once = Once::new();
    // Called while a panic of the caller's unwinds, a hook may not be set; then the panic is reported with a line more.
    if !std::thread::panicking() {
        HOOK.call_once(put_hook);
    }
    let result = {
        let _inside = Depth::set(DEPTH.get() + 1);
        ACTIVE.fetch_add(1, Ordering::Relaxed);
        let result = catch_unwind(AssertUnwindSafe(call));
        ACTIVE.fetch_sub(1, Ordering::Relaxed);
        result
    };
    result.map_err(|payload| {
        let here = TEXT.take().unwrap_or_else(|| text(&*payload).to_string());
        let worker = WORKER.lock().ok().and_then(|mut text| text.take());
        // Dropping a payload may panic in turn; a few leaked bytes are the safer choice.
        std::mem::forget(payload);
        worker.map_or(here.clone(), |worker| format!("{here}; before, on a thread of ours: {worker}"))
    })
}

/// A call of somebody else's code out of a guarded call: its panics are its own, and are printed.
pub(crate) fn foreign<T>(call: impl FnOnce() -> T) -> T {
    let _outside = Depth::set(0);
    call()
}

/// The depth before, put back at the end.
struct Depth(usize);

impl Depth {
    fn set(depth: usize) -> Self {
        Self(DEPTH.replace(depth))
    }
}

impl Drop for Depth {
    fn drop(&mut self) {
        DEPTH.set(self.0);
    }
}

fn put_hook() {
    let found = take_hook();
    set_hook(Box::new(move |info| {
        if DEPTH.get() > 0 {
            TEXT.set(Some(described(info)));
        } else if ACTIVE.load(Ordering::Relaxed) > 0 && std::thread::current().name().is_none() {
            if let Ok(mut text) = WORKER.lock() {
                *text = Some(described(info));
            }
        } else {
            found(info);
        }
    }));
}

fn described(info: &PanicHookInfo) -> String {
    let place =
        info.location().map_or(String::new(), |place| format!(" ({}:{})", place.file(), place.line()));
    format!("{}{place}", text(info.payload()))
}

fn text(payload: &(dyn Any + Send)) -> &str {
    let text = payload.downcast_ref::<&str>().copied();
    text.or_else(|| payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("no text")
}
