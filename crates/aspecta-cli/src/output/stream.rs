//! A JSON document that is written as its results come, and is whole however it ends.

use std::io::{self, Write};
use std::process;
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

/// How far the document on stdout has come.
#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    /// There is none, or all of it is out.
    None,
    /// A part of it is being written.
    Writing,
    /// All that is there is out, up to the end of a result, and the next is waited for.
    Waiting,
}

static STATE: Mutex<State> = Mutex::new(State::None);

/// What is missing then: the ends of the list and of the document.
const END: &[u8] = b"\n  ]\n}\n";

/// How often, and at most how many times, it is looked whether a part has been written.
const TICK: Duration = Duration::from_millis(10);
const TICKS: usize = 100;

fn set(from: State, to: State) {
    // Whoever ends the document keeps the state: nothing is written behind the end.
    let mut state = STATE.lock().unwrap_or_else(PoisonError::into_inner);
    if *state == from {
        *state = to;
    }
}

/// Begins a document: an interrupt ends it, and the program.
pub fn begin() {
    set(State::None, State::Writing);
    // Long work that came before watches for interrupts already, and ends the document too.
    let _is_watched = ctrlc::set_handler(|| {
        end();
        process::exit(130)
    });
}

/// All is out, and the next result is waited for.
pub fn wait() {
    set(State::Writing, State::Waiting);
}

/// It is there.
pub fn go_on() {
    set(State::Waiting, State::Writing);
}

/// The document is written.
pub fn done() {
    set(State::Writing, State::None);
}

/// Ends the document for a program that is about to end. Where a part is being written, that is waited for,
/// but not for a reader who takes nothing.
pub fn end() {
    for _ in 0..TICKS {
        let state = STATE.lock().unwrap_or_else(PoisonError::into_inner);
        match *state {
            State::None => return,
            State::Writing => {}
            State::Waiting => {
                let mut out = io::stdout().lock();
                // There is nobody to tell if stdout is closed.
                let _ = out.write_all(END).and_then(|()| out.flush());
                // Held until the program has ended.
                std::mem::forget(state);
                return;
            }
        }
        drop(state);
        thread::sleep(TICK);
    }
}
