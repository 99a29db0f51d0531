//! Asks for memory before it is needed, so that it is read while other work goes on.

/// Bytes that a processor reads at once.
#[cfg(target_arch = "x86_64")]
const LINE: usize = 64;

/// How near to the core the memory is brought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cache {
    First,
    Second,
}

/// Asks for what a pointer points to. It may point anywhere: nothing is read that the program would see.
#[inline(always)]
pub fn fetch<T>(pointer: *const T, cache: Cache) {
    #[cfg(target_arch = "x86_64")]
    for line in (0..size_of::<T>()).step_by(LINE) {
        use std::arch::x86_64::{_MM_HINT_T0, _MM_HINT_T1, _mm_prefetch};
        let begin = pointer.cast::<i8>().wrapping_add(line);
        // SAFETY: a prefetch of any address is allowed and reads nothing that the program sees.
        unsafe {
            match cache {
                Cache::First => _mm_prefetch::<_MM_HINT_T0>(begin),
                Cache::Second => _mm_prefetch::<_MM_HINT_T1>(begin),
            }
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (pointer, cache);
}
