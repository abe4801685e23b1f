//! Long work: how a caller watches and stops it, how it is spread over threads, and how it is timed.

mod clock;
mod threads;

pub use clock::Stopwatch;
pub use threads::{flat_map, flat_map_range, join, map, map_range, thread_count, update, with_stack};

use std::sync::atomic::{AtomicBool, Ordering};

/// How far the work has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The name of the stage.
    pub stage: &'static str,
    /// Steps done in this stage.
    pub done: u64,
    /// Steps this stage is known to need.
    pub total: u64,
}

/// How a caller watches and stops long work.
///
/// # Examples
/// ```
/// use aspecta_robot::work::Control;
/// use std::sync::atomic::{AtomicBool, Ordering};
///
/// let cancelled = AtomicBool::new(false);
/// let control = Control { cancelled: &cancelled, progress: &|now| eprintln!("{}: {}", now.stage, now.done) };
/// assert!(!control.is_cancelled());
/// cancelled.store(true, Ordering::Relaxed); // from another thread, say
/// assert!(control.is_cancelled());
/// ```
#[derive(Clone, Copy)]
pub struct Control<'a> {
    /// Set it to true to stop: the result so far is returned.
    pub cancelled: &'a AtomicBool,
    /// Called now and then, from any thread.
    pub progress: &'a (dyn Fn(Progress) + Sync),
}

impl Control<'static> {
    /// Returns the control of work that no one watches: progress is not shown and nothing stops it.
    pub fn unwatched() -> Self {
        static NEVER: AtomicBool = AtomicBool::new(false);
        Self { cancelled: &NEVER, progress: &|_| {} }
    }
}

impl Control<'_> {
    /// Whether the caller wants the work to stop.
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }
}
