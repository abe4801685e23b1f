//! The threads that work is spread over: a pool for each process.
//!
//! A process that was forked has its parent's memory, but none of its threads: work given to the parent's pool would never
//! be done. Python forks (`multiprocessing` on Linux), so the pool is asked for by the process that uses it.

use pyo3::prelude::*;
use rayon::ThreadPool;
use std::mem;
use std::process;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// How many threads a pool has; 0: one a core.
static COUNT: AtomicUsize = AtomicUsize::new(0);

/// The pool, and the process it belongs to.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// The pool of this process; `None` if no threads can be had.
fn pool() -> Option<Arc<ThreadPool>> {
    let mut known = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let here = process::id();
    match &*known {
        Some((process, pool)) if *process == here => Some(Arc::clone(pool)),
        _ => {
            let pool = Arc::new(
                rayon::ThreadPoolBuilder::new().num_threads(COUNT.load(Ordering::Relaxed)).build().ok()?,
            );
            // A parent's pool cannot be ended from here: there is nobody in it.
            mem::forget(known.replace((here, Arc::clone(&pool))));
            Some(pool)
        }
    }
}

/// Lets work that begins from now on have so many threads; 0: one a core.
#[pyfunction]
pub fn set_threads(count: usize) {
    COUNT.store(count, Ordering::Relaxed);
    let former = POOL.lock().unwrap_or_else(PoisonError::into_inner).take();
    if former.as_ref().is_some_and(|(process, _)| *process != process::id()) {
        // A parent's pool cannot be ended from here.
        mem::forget(former);
    }
}

/// Does work whose parts are spread over all threads.
pub fn on_all<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    match pool() {
        Some(pool) => pool.install(work),
        None => work(),
    }
}

/// Does such work with no lock on the interpreter.
pub fn detached<R: Send>(py: Python<'_>, work: impl FnOnce() -> R + Send) -> R {
    py.detach(|| on_all(work))
}
