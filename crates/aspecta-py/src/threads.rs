//! The threads that work is spread over: a pool for each process.
//!
//! A process that was forked has its parent's memory, but none of its threads: work given to the parent's pool would never
//! be done. Python forks (`multiprocessing` on Linux), so the pool is asked for by the process that uses it.

use pyo3::Python;
use rayon::ThreadPool;
use std::mem;
use std::process;
use std::sync::{Arc, Mutex, PoisonError};

/// The pool, and the process it belongs to.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// The pool of this process; `None` if no threads can be had.
fn pool() -> Option<Arc<ThreadPool>> {
    let mut known = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let here = process::id();
    match &*known {
        Some((process, pool)) if *process == here => Some(Arc::clone(pool)),
        _ => {
            let pool = Arc::new(rayon::ThreadPoolBuilder::new().build().ok()?);
            // A parent's pool cannot be ended from here: there is nobody in it.
            mem::forget(known.replace((here, Arc::clone(&pool))));
            Some(pool)
        }
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
