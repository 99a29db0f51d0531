//! A bug in the library (a panic, made by the feature `inject-panic`) gives status 255 and a text, and prints nothing.
#![allow(unsafe_code)] // the C interface is what is tested

mod common;

use common::{Cells, Model, last_error};
use msdd::abi::MSDD_INTERNAL;
use msdd::exports::msdd_database_generate;
use std::process::Command;
use std::ptr::null_mut;

/// Set in the child process, whose output the parent reads.
const CHILD: &str = "MSDD_PANICS_CHILD";

#[test]
fn a_panic_becomes_a_status_with_text_and_place() {
    let model = Model::load("builtin").expect("good");
    for _ in 0..3 {
        let (status, message) = Model::load("panic").err().expect("a panic");
        assert_eq!(status, MSDD_INTERNAL as i32);
        assert!(
            message.starts_with("internal error (a bug in msdd): ") && message.contains("injected"),
            "{message}"
        );
        assert!(message.contains("load.rs:"), "{message}");
    }
    // The library goes on as before, on this thread and others.
    Cells::new(&model, 9).advance(&model);
    std::thread::scope(|scope| scope.spawn(|| Cells::new(&model, 9).advance(&model)).join())
        .expect("no panic");
}

#[test]
fn so_does_one_on_a_thread_of_ours() {
    let path = std::env::temp_dir().join("msdd-never-made.msdd");
    let path = std::ffi::CString::new(path.to_string_lossy().as_bytes()).expect("no NUL");
    // SAFETY: C strings, no call-back.
    let status = unsafe { msdd_database_generate(c"panic".as_ptr(), path.as_ptr(), 2, None, null_mut()) };
    assert_eq!(status, MSDD_INTERNAL as i32);
    let message = last_error();
    assert!(message.contains("a worker") && message.contains("injected into a thread"), "{message}");
}

/// Runs all of the above in a child process, where the test harness does not capture output: nothing may appear on its
/// standard error. A panic of its own afterwards is printed as usual.
#[test]
fn nothing_is_printed() {
    if std::env::var_os(CHILD).is_some() {
        a_panic_becomes_a_status_with_text_and_place();
        so_does_one_on_a_thread_of_ours();
        std::thread::spawn(|| panic!("the program's own")).join().expect_err("panics");
        return;
    }
    let test = std::env::current_exe().expect("running");
    let child = Command::new(test)
        .args(["--exact", "nothing_is_printed", "--nocapture", "--test-threads=1"])
        .env(CHILD, "1")
        .output()
        .expect("runs");
    let errors = String::from_utf8_lossy(&child.stderr);
    assert!(child.status.success() && !errors.contains("injected"), "{errors}");
    assert_eq!(errors.matches("panicked at").count(), 1, "{errors}");
    assert!(errors.contains("the program's own"), "{errors}");
}
