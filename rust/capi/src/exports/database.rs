//! Functions of `msdd.h` about databases.

use super::string;
use crate::abi::msdd_progress;
use crate::panics;
use crate::status::{Failure, status};
use ::msdd_rve::database::{Plan, Recipe, Run, export_csv, generate};
use std::ffi::{c_char, c_void};
use std::ops::ControlFlow;
use std::path::Path;

/// Largest number of threads that is accepted; more is taken for a mistake.
const MAX_THREADS: u32 = 1024;

/// `msdd_database_generate`
///
/// # Safety
/// `plan` and `path` are null or C strings; `progress` is null or a function that may be called with `user`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_database_generate(
    plan: *const c_char,
    path: *const c_char,
    threads: u32,
    progress: msdd_progress,
    user: *mut c_void,
) -> i32 {
    status(|| {
        // SAFETY: null or C strings by this function's contract.
        let (plan, path) = unsafe { (string("plan", plan)?, string("path", path)?) };
        #[cfg(feature = "inject-panic")]
        if plan == "panic" {
            std::thread::scope(|scope| scope.spawn(|| panic!("injected into a thread")).join())
                .expect("a worker");
        }
        let plan = Plan::parse(&plan, "plan")?;
        if threads > MAX_THREADS {
            return Err(Failure::argument("threads", threads, format!("0 to {MAX_THREADS}")));
        }
        let run = Run { threads: threads.max(1) as usize, ..Run::default() };
        let mut cancelled = false;
        generate(&plan, Path::new(&path), &run, |state| {
            let Some(progress) = progress else { return ControlFlow::Continue(()) };
            // SAFETY: `progress` may be called with `user`, by this function's contract; this is the caller's thread.
            let hear =
                || unsafe { progress(user, state.done as u64, state.total as u64, state.failed as u64) };
            let answer = panics::foreign(hear);
            cancelled = answer != 0;
            if cancelled { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })?;
        if cancelled { Err(Failure::Cancelled) } else { Ok(()) }
    })
}

/// `msdd_database_export_csv`
///
/// # Safety
/// `database` and `csv` are null or C strings; `rows` is null or writable.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn msdd_database_export_csv(
    database: *const c_char,
    csv: *const c_char,
    rows: *mut u64,
) -> i32 {
    status(|| {
        // SAFETY: null or C strings by this function's contract.
        let (database, csv) = unsafe { (string("database", database)?, string("csv", csv)?) };
        let count = export_csv(Path::new(&database), Path::new(&csv), None)?;
        if !rows.is_null() {
            // SAFETY: not null, writable by this function's contract.
            unsafe { rows.write(count as u64) };
        }
        Ok(())
    })
}
