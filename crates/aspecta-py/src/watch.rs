//! Long work: the interpreter stays free, progress is told, Ctrl-C is obeyed at once.

use crate::threads;
use aspecta::Control;
use aspecta::robot::work::Progress;
use pyo3::prelude::*;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

/// How often signals are looked for and progress is told.
const TICK: Duration = Duration::from_millis(50);
/// How long interrupted work is waited for: some can give what it has so far, some has to be left alone.
const GRACE: Duration = Duration::from_millis(100);

/// What the work and its watch share.
#[derive(Default)]
struct Shared {
    cancelled: AtomicBool,
    now: Mutex<Option<Progress>>,
}

impl Shared {
    fn latest(&self) -> Option<Progress> {
        self.now.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

/// The outcome of work that was watched.
pub struct Watched<T> {
    /// The result; `None` if it was interrupted and has none.
    pub result: Option<T>,
    /// The exception that interrupted it: `KeyboardInterrupt`, or one that `progress` raised.
    pub interrupted: Option<PyErr>,
}

impl<T> Watched<T> {
    /// The result, or the exception.
    pub fn whole(self) -> PyResult<T> {
        match (self.interrupted, self.result) {
            (Some(interrupted), _) => Err(interrupted),
            (None, Some(result)) => Ok(result),
            (None, None) => unreachable!("work that nothing interrupts has a result"),
        }
    }
}

/// Does work on a thread of its own, with no lock on the interpreter. `progress(stage, done, total)` is called
/// now and then, on the thread that waits.
pub fn watched<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Control<'_>) -> T + Send + 'static,
) -> PyResult<Watched<T>> {
    let shared = Arc::new(Shared::default());
    let (done, mut results) = mpsc::channel();
    let theirs = Arc::clone(&shared);
    let worker = thread::Builder::new().name("aspecta".into()).spawn(move || {
        let tell = |now| *theirs.now.lock().unwrap_or_else(PoisonError::into_inner) = Some(now);
        let control = Control { cancelled: &theirs.cancelled, progress: &tell };
        let result = threads::on_all(|| work(&control));
        // Nobody may be waiting any more.
        drop(done.send(result));
    })?;
    let mut interrupted = None;
    loop {
        let patience = if interrupted.is_some() { GRACE } else { TICK };
        let coming = &mut results;
        match py.detach(move || coming.recv_timeout(patience)) {
            Ok(result) => return Ok(Watched { result: Some(result), interrupted }),
            Err(RecvTimeoutError::Timeout) if interrupted.is_some() => {
                return Ok(Watched { result: None, interrupted });
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => match worker.join() {
                Err(panic) => resume_unwind(panic),
                Ok(()) => unreachable!("a worker sends its result"),
            },
        }
        if let Err(exception) = py.check_signals().and_then(|()| tell(progress, shared.latest())) {
            shared.cancelled.store(true, Ordering::Relaxed);
            interrupted = Some(exception);
        }
    }
}

fn tell(progress: Option<&Bound<'_, PyAny>>, now: Option<Progress>) -> PyResult<()> {
    if let (Some(call), Some(Progress { stage, done, total })) = (progress, now) {
        call.call1((stage, done, total))?;
    }
    Ok(())
}
