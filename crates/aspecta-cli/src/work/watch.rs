//! How long work is watched and stopped.

use crate::args::threads::Threads;
use crate::failure::Failure;
use crate::output::note;
use aspecta::paving::{Control, Progress};
use aspecta::robot::work::Stopwatch;
use indicatif::{ProgressBar, ProgressStyle};
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

/// Set by Ctrl-C, once [`interrupts`] is called.
static CANCELLED: AtomicBool = AtomicBool::new(false);

/// Does long work on a number of threads (all cores if none is given), shows how far it has come, and lets
/// Ctrl-C stop it.
pub fn watched<T>(threads: Threads, work: impl FnOnce(&Control<'_>) -> T) -> Result<T, Failure> {
    limit(threads)?;
    interrupts()?;
    let bar = progress_bar();
    let show = |p: Progress| {
        bar.set_length(p.total);
        bar.set_position(p.done);
        bar.set_message(p.stage);
    };
    let result = work(&Control { cancelled: &CANCELLED, progress: &show });
    bar.finish_and_clear();
    Ok(result)
}

/// Says so when it is dropped.
struct Done<'a>(&'a AtomicBool);

impl Drop for Done<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// How often a deadline is looked at.
const TICK: Duration = Duration::from_millis(20);

/// Does work that is cancelled after a time; returns whether it ended before.
pub fn within<T>(time: Duration, control: &Control<'_>, work: impl FnOnce(&Control<'_>) -> T) -> (T, bool) {
    let (cancelled, done, late) = (AtomicBool::new(false), AtomicBool::new(false), AtomicBool::new(false));
    let begin = Stopwatch::start();
    thread::scope(|scope| {
        scope.spawn(|| {
            while !done.load(Ordering::Relaxed) {
                let is_late = begin.seconds() >= time.as_secs_f64();
                late.fetch_or(is_late, Ordering::Relaxed);
                cancelled.fetch_or(is_late || control.is_cancelled(), Ordering::Relaxed);
                thread::park_timeout(TICK);
            }
        });
        // Also if the work panics: the watch is waited for.
        let _done = Done(&done);
        let result = work(&Control { cancelled: &cancelled, progress: control.progress });
        (result, !late.load(Ordering::Relaxed))
    })
}

/// The first Ctrl-C asks the work to stop and keep its result, the second ends the program.
fn interrupts() -> Result<(), Failure> {
    let interrupted = || {
        if CANCELLED.swap(true, Ordering::Relaxed) {
            process::exit(130);
        }
        note("stopping; again to quit at once");
    };
    ctrlc::set_handler(interrupted).map_err(|e| Failure::Input(format!("cannot watch for Ctrl-C: {e}")))
}

/// On stderr, and only if that is a terminal.
fn progress_bar() -> ProgressBar {
    let style = ProgressStyle::with_template("{spinner} {elapsed} {wide_bar} {percent:>3} % {msg}");
    let bar = ProgressBar::new(1).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

/// Limits the work to a number of threads.
fn limit(threads: Threads) -> Result<(), Failure> {
    let Some(threads) = threads.threads else { return Ok(()) };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
    pool.map_err(|e| Failure::Input(format!("--threads {threads}: {e}")))
}
