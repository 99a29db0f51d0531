//! Threads that work on one step together.
//!
//! A step takes a few hundred microseconds, and waking a sleeping thread would cost a tenth of that. So the threads of
//! the pool stay awake for many steps and yield to other jobs of the machine whenever they find nothing to do.

use rayon::{ThreadPool, Yield};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Number of times a thread looks for work before it yields its core to other jobs.
const ROUNDS: u32 = 100;

/// Runs `work` on a thread of the pool while the other threads stay awake to help with the tasks it shares.
pub fn together(pool: &ThreadPool, work: impl FnOnce() + Send) {
    let over = AtomicBool::new(false);
    pool.scope(|scope| {
        let leader = rayon::current_thread_index();
        let over = &over;
        scope.spawn_broadcast(move |_, helper| {
            if Some(helper.index()) != leader {
                help_until(|| over.load(Ordering::Acquire));
            }
        });
        // `Ended` is set on drop, so also on a panic: otherwise the other threads would wait for ever.
        let _end = Ended(over);
        work();
    });
}

/// Does `work` on each task, on whatever threads of the pool are awake. Returns the results in the order of the tasks.
pub fn share<T: Send, R: Send>(tasks: Vec<T>, work: impl Fn(T) -> R + Sync) -> Vec<R> {
    let left = AtomicUsize::new(tasks.len());
    let mut results: Vec<Option<R>> = tasks.iter().map(|_| None).collect();
    rayon::in_place_scope(|scope| {
        for (task, result) in tasks.into_iter().zip(&mut results) {
            let (left, work) = (&left, &work);
            scope.spawn(move |_| {
                // `Counted` counts on drop, so also on a panic, which the scope then passes on.
                let _done = Counted(left);
                *result = Some(work(task));
            });
        }
        help_until(|| left.load(Ordering::Acquire) == 0);
    });
    results.into_iter().flatten().collect()
}

/// Does work that other threads have shared until `over` returns true.
fn help_until(over: impl Fn() -> bool) {
    let mut idle = 0;
    while !over() {
        if rayon::yield_now() == Some(Yield::Executed) {
            idle = 0;
        } else if idle < ROUNDS {
            idle += 1;
            std::hint::spin_loop();
        } else {
            std::thread::yield_now();
        }
    }
}

struct Ended<'a>(&'a AtomicBool);

impl Drop for Ended<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Release);
    }
}

struct Counted<'a>(&'a AtomicUsize);

impl Drop for Counted<'_> {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::AcqRel);
    }
}
