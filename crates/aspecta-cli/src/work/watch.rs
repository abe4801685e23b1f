//! How long work is watched and stopped.

use crate::args::threads::Threads;
use crate::failure::Failure;
use crate::output::{note, stream};
use aspecta::paving::{Control, Progress};
use aspecta::robot::work::Stopwatch;
use aspecta_view::file;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{self, IsTerminal};
use std::panic::resume_unwind;
use std::process;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

/// Set by Ctrl-C, once [`interrupts`] is called.
static CANCELLED: AtomicBool = AtomicBool::new(false);

/// Whether the work that is under way keeps a result when it is stopped; else Ctrl-C ends the program.
static KEEPS: AtomicBool = AtomicBool::new(false);

/// Does long work on a number of threads (all cores if none is given), shows how far it has come, and lets
/// Ctrl-C stop it. Afterwards Ctrl-C ends the program at once, between two files.
pub fn watched<T>(threads: Threads, work: impl FnOnce(&Control<'_>) -> T) -> Result<T, Failure> {
    limit(threads)?;
    interrupts()?;
    let (bar, lines) = (progress_bar(), Lines::new());
    let show = |p: Progress| {
        bar.set_length(p.total);
        bar.set_position(p.done);
        bar.set_message(p.stage);
        lines.say(p);
    };
    KEEPS.store(true, Ordering::Relaxed);
    let result = work(&Control { cancelled: &CANCELLED, progress: &show });
    KEEPS.store(false, Ordering::Relaxed);
    bar.finish_and_clear();
    Ok(result)
}

/// Does a part of watched work of which nothing is kept when it is stopped: Ctrl-C ends the program at once.
pub fn unkept<T>(work: impl FnOnce() -> T) -> T {
    KEEPS.store(false, Ordering::Relaxed);
    let result = work();
    KEEPS.store(true, Ordering::Relaxed);
    result
}

/// Does work that cannot be stopped on a thread of its own, which is left to itself when the rest is cancelled:
/// then there is no result.
pub fn abandoned_if_cancelled<T: Send + 'static>(
    control: &Control<'_>,
    work: impl FnOnce() -> T + Send + 'static,
) -> Option<T> {
    let (done, result) = mpsc::channel();
    let worker = thread::spawn(move || done.send(work()));
    loop {
        match result.recv_timeout(TICK) {
            Ok(result) => return Some(result),
            Err(RecvTimeoutError::Timeout) if control.is_cancelled() => return None,
            Err(RecvTimeoutError::Timeout) => {}
            // It panicked, and so do we.
            Err(RecvTimeoutError::Disconnected) => {
                return worker.join().map_or_else(|e| resume_unwind(e), |_| None);
            }
        }
    }
}

/// Tells how far work has come where there is no terminal to draw a bar on: now and then a line.
struct Lines {
    begin: Stopwatch,
    /// When the next is due, in seconds; never on a terminal.
    due: Mutex<f64>,
}

/// Seconds between two lines.
const BETWEEN: f64 = 10.0;

impl Lines {
    fn new() -> Self {
        let due = if io::stderr().is_terminal() { f64::INFINITY } else { BETWEEN };
        Self { begin: Stopwatch::start(), due: Mutex::new(due) }
    }

    fn say(&self, Progress { stage, done, total }: Progress) {
        let Ok(mut due) = self.due.try_lock() else { return };
        let now = self.begin.seconds();
        if now >= *due {
            *due = now + BETWEEN;
            note(&format!("after {now:.0} s: {stage}, {done} of {total}"));
        }
    }
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

/// Does work that is cancelled after so many seconds, if a number is given.
pub fn within_seconds<T>(
    seconds: Option<f64>,
    control: &Control<'_>,
    work: impl FnOnce(&Control<'_>) -> T,
) -> T {
    let Some(seconds) = seconds else { return work(control) };
    within(Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX), control, work).0
}

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

/// The first Ctrl-C asks the work to stop and keep its result, if it has one; the second ends the program.
fn interrupts() -> Result<(), Failure> {
    let interrupted = || {
        if CANCELLED.swap(true, Ordering::Relaxed) || !KEEPS.load(Ordering::Relaxed) {
            quit();
        }
        note("stopping; again to quit at once");
    };
    ctrlc::set_handler(interrupted).map_err(|e| Failure::Input(format!("cannot watch for Ctrl-C: {e}")))
}

/// Ends the program, with no file half-written and no document on stdout cut off.
fn quit() -> ! {
    stream::end();
    let _no_file_is_written = file::between_writes();
    process::exit(130)
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
