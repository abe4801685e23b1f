//! Long work: the interpreter stays free, progress is told, Ctrl-C is obeyed at once.

use crate::threads;
use aspecta::Control;
use aspecta::robot::work::Progress;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

/// How often signals are looked for and progress is told.
const TICK: Duration = Duration::from_millis(50);

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
pub enum Watched<T> {
    /// Its result.
    Done(T),
    /// The exception that interrupted it, `KeyboardInterrupt` or one that `progress` raised; what it has so far
    /// is still to come.
    Interrupted(PyErr, Receiver<T>),
}

impl<T: Send + 'static> Watched<T> {
    /// The result, or the exception.
    pub fn whole(self) -> PyResult<T> {
        match self {
            Self::Done(result) => Ok(result),
            Self::Interrupted(exception, _) => Err(exception),
        }
    }

    /// The result as `convert` hands it to Python; or the exception, whose `partial` is a [`Partial`].
    pub fn or_partial<R>(
        self,
        py: Python<'_>,
        convert: impl Fn(T) -> PyResult<R> + Send + 'static,
    ) -> PyResult<Py<PyAny>>
    where
        R: for<'py> IntoPyObject<'py>,
    {
        match self {
            Self::Done(result) => convert(result)?.into_py_any(py),
            Self::Interrupted(exception, mut results) => {
                let poll = move |py: Python<'_>| {
                    let coming = &mut results;
                    match py.detach(move || coming.recv_timeout(TICK)) {
                        Ok(result) => Ok(Some(convert(result)?.into_py_any(py)?)),
                        Err(RecvTimeoutError::Timeout) => Ok(None),
                        Err(RecvTimeoutError::Disconnected) => Ok(Some(py.None())),
                    }
                };
                let partial = Partial(Mutex::new(Coming::Later(Box::new(poll))));
                exception.value(py).setattr("partial", Py::new(py, partial)?)?;
                Err(exception)
            }
        }
    }
}

/// The result of work that was interrupted, as far as it came.
#[pyclass(frozen, module = "aspecta._native")]
pub struct Partial(Mutex<Coming>);

/// Waits a moment for the result.
type Poll = Box<dyn FnMut(Python<'_>) -> PyResult<Option<Py<PyAny>>> + Send>;

enum Coming {
    Later(Poll),
    Here(Py<PyAny>),
}

#[pymethods]
impl Partial {
    /// Returns the result so far, and waits for the step that was under way; None if there is none.
    fn wait(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        let mut coming = self.0.lock_py_attached(py).unwrap_or_else(PoisonError::into_inner);
        loop {
            let poll = match &mut *coming {
                Coming::Here(result) => return Ok(result.clone_ref(py)),
                Coming::Later(poll) => poll,
            };
            if let Some(result) = poll(py)? {
                *coming = Coming::Here(result);
            }
            py.check_signals()?;
        }
    }
}

/// Does work on a thread of its own, with no lock on the interpreter. `progress(stage, done, total)` is called
/// now and then, on the thread that waits. Work that is interrupted is told to stop, and left to itself.
pub fn watched<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Control<'_>) -> T + Send + 'static,
) -> PyResult<Watched<T>> {
    watched_within(py, None, progress, work)
}

/// As [`watched`]; after so many seconds the work is told to stop, and waited for.
pub fn watched_within<T: Send + 'static>(
    py: Python<'_>,
    seconds: Option<f64>,
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
    // A time too long to be told is no limit.
    let limit = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    let mut left = limit;
    loop {
        let coming = &mut results;
        let tick = left.map_or(TICK, |left| left.min(TICK));
        match py.detach(move || coming.recv_timeout(tick)) {
            Ok(result) => return Ok(Watched::Done(result)),
            Err(RecvTimeoutError::Timeout) => {
                left = left.and_then(|left| left.checked_sub(tick)).filter(|left| !left.is_zero());
                if limit.is_some() && left.is_none() {
                    shared.cancelled.store(true, Ordering::Relaxed);
                }
            }
            Err(RecvTimeoutError::Disconnected) => match worker.join() {
                Err(panic) => resume_unwind(panic),
                Ok(()) => unreachable!("a worker sends its result"),
            },
        }
        if let Err(exception) = py.check_signals().and_then(|()| tell(progress, shared.latest())) {
            shared.cancelled.store(true, Ordering::Relaxed);
            return Ok(Watched::Interrupted(exception, results));
        }
    }
}

fn tell(progress: Option<&Bound<'_, PyAny>>, now: Option<Progress>) -> PyResult<()> {
    if let (Some(call), Some(Progress { stage, done, total })) = (progress, now) {
        call.call1((stage, done, total))?;
    }
    Ok(())
}
