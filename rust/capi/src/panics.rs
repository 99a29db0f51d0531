//! Catches panics inside of exported functions, without printing.
//!
//! Rust's panic hook prints a message before the stack is unwound. There is only one hook in a process, so it cannot be
//! switched off for one call. Our own hook is therefore installed once, at the first call, around the hook found: it stores
//! the text of a panic that happens inside of a guarded call (a call of an exported function), and passes all other panics
//! (of a Rust program that uses this library) to the hook found. It needs no signal handler and has no state that C can
//! see, and nothing has to be restored after a call. If a program later sets a hook of its own, that one replaces ours and
//! prints a line per panic; the statuses and texts of the calls are the same.

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, PanicHookInfo, catch_unwind, set_hook, take_hook};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, Once};

thread_local! {
    /// Number of guarded calls on this thread that are inside of one another.
    static DEPTH: Cell<usize> = const { Cell::new(0) };
    /// Text of the last panic in them.
    static TEXT: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Number of guarded calls on all threads.
static ACTIVE: AtomicUsize = AtomicUsize::new(0);
/// Text of the last panic on a thread that a guarded call started. Such a thread has no name, and its `DEPTH` is 0.
static WORKER: Mutex<Option<String>> = Mutex::new(None);

/// Result of a call, or the text of its panic and the place where it happened.
///
/// The caller has to make sure that no broken state is left behind when `call` unwinds.
pub(crate) fn caught<T>(call: impl FnOnce() -> T) -> Result<T, String> {
    static HOOK: Once = Once::new();
    // A hook must not be set while a panic of the caller unwinds; then a panic in here prints a line in addition.
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
        // Dropping the payload could panic again; leaking a few bytes is safer.
        std::mem::forget(payload);
        worker.map_or(here.clone(), |worker| format!("{here}; before, on a thread of ours: {worker}"))
    })
}

/// Calls somebody else's code from inside of a guarded call: its panics are printed as usual.
pub(crate) fn foreign<T>(call: impl FnOnce() -> T) -> T {
    let _outside = Depth::set(0);
    call()
}

/// Restores the value of `DEPTH` that it holds when it is dropped.
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
