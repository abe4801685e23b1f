//! How far a paving goes, and how a caller watches and stops it.

use crate::robot::Window;
use serde::Serialize;
use std::sync::atomic::{AtomicBool, Ordering};

/// How far a paving goes. Whatever is met first ends it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Budget {
    /// Wall-clock seconds of an analysis: [`PAVING_SHARE`] of them for the paving, the rest for what is done with it.
    /// Results then depend on the machine's speed.
    pub seconds: Option<f64>,
    /// Boxes classified. Deterministic.
    pub boxes: Option<u64>,
    /// Subdivisions of the window: cells are window / 2^depth, at most [`MAX_DEPTH`]. Deterministic.
    pub depth: Option<u32>,
    /// Width of the finest cells in length units. Deterministic.
    pub resolution: Option<f64>,
}

/// Greatest depth a paving can have.
pub const MAX_DEPTH: u32 = 20;
/// Greatest number of boxes a paving holds (28 bytes each, so about 1 GiB); larger budgets are cut to it.
pub const MAX_BOXES: u64 = 40_000_000;

/// The share of a time budget after which the paving ends; counting its components takes about as long again.
pub const PAVING_SHARE: f64 = 0.4;

impl Budget {
    /// The depth at which this budget ends in `window`: the one asked for or that of the resolution, whichever is
    /// met first; 16, 11 or 8 where 1, 2 or 3 coordinates vary (a few seconds of work) if nothing is asked for at all, some
    /// levels more if only time or boxes are given.
    pub(super) fn depth_in(&self, window: &Window) -> u32 {
        let lengths = window.ranges.iter().zip(&window.angles).filter(|(_, angle)| !**angle);
        let widest = lengths.map(|(r, _)| r.1 - r.0).fold(0.0, f64::max);
        // A robot without lengths has no resolution to reach.
        let resolution = self.resolution.filter(|_| widest > 0.0);
        let finest = resolution.map(|r| (widest / r).log2().ceil().max(1.0) as u32);
        let (usual, deep) = match window.axes().len() {
            1 => (16, MAX_DEPTH),
            2 => (11, 14),
            _ => (8, 11),
        };
        let open = self.seconds.is_some() || self.boxes.is_some();
        let asked = self.depth.into_iter().chain(finest).min();
        asked.unwrap_or(if open { deep } else { usual }).clamp(1, MAX_DEPTH)
    }
}

/// How far the work has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// What is being done.
    pub stage: &'static str,
    /// Steps done in this stage.
    pub done: u64,
    /// Steps this stage is known to need.
    pub total: u64,
}

/// How a caller watches and stops long work.
#[derive(Clone, Copy)]
pub struct Control<'a> {
    /// Set it to true to stop: the result so far is returned.
    pub cancelled: &'a AtomicBool,
    /// Called now and then, from any thread.
    pub progress: &'a (dyn Fn(Progress) + Sync),
}

impl Control<'_> {
    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }
}

/// Why a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Stop {
    /// The resolution asked for was reached, or nothing was left undecided.
    Resolution,
    /// The box budget was spent.
    Boxes,
    /// The time budget was spent.
    Time,
    /// Cancelled by the user.
    Cancelled,
}
