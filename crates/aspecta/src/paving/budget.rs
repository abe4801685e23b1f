//! How far a paving goes, and why it ended.

use aspecta_robot::MAX_BOXES;
use aspecta_robot::Window;
use serde::Serialize;

/// How far a paving goes. Whatever is met first ends it.
///
/// # Examples
/// ```
/// use aspecta::{Budget, Robot};
///
/// let budget = Budget { resolution: Some(0.1), ..Budget::default() };
/// let window = Robot::resolve("five-bar")?.slice(&[])?;
/// assert_eq!(budget.finest(&window), Some(9)); // the window is less than 0.1 · 2⁹ wide
/// # Ok::<(), aspecta::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Budget {
    /// Wall-clock seconds of an analysis: [`PAVING_SHARE`] of them for the paving, the rest for what is done with it.
    /// Results then depend on the machine's speed.
    pub seconds: Option<f64>,
    /// Boxes classified. Deterministic.
    pub boxes: Option<u64>,
    /// Subdivisions of the window: cells are window / 2^depth, at most [`MAX_DEPTH`]. Deterministic.
    pub depth: Option<u32>,
    /// Width of the finest cells in length units, or in radians where angles alone vary. Deterministic.
    pub resolution: Option<f64>,
}

/// Greatest depth a paving can have: boxes are then some 10⁻⁸ of the window wide, still a million times the spacing of doubles.
pub const MAX_DEPTH: u32 = 26;

/// The share of a time budget after which the paving ends; counting its components takes about as long again.
pub const PAVING_SHARE: f64 = 0.4;

impl Budget {
    /// Returns the budget that is fine enough to work with aspects where so many coordinates are free.
    ///
    /// # Examples
    /// ```
    /// use aspecta::Budget;
    ///
    /// assert_eq!(Budget::coarse(2), Budget { depth: Some(11), ..Budget::default() });
    /// ```
    pub fn coarse(free: usize) -> Self {
        let depth = match free {
            0 | 1 => 16,
            2 => 11,
            _ => 7,
        };
        Self { depth: Some(depth), ..Self::default() }
    }

    /// The depth at which this budget ends in `window`, if it names one: the depth asked for or that of the resolution, whichever is
    /// met first.
    pub fn finest(&self, window: &Window) -> Option<u32> {
        let widest = |are_angles: bool| {
            let alike = window.ranges.iter().zip(&window.angles).filter(|(_, angle)| **angle == are_angles);
            alike.map(|(r, _)| r.1 - r.0).fold(0.0, f64::max)
        };
        let widest = if widest(false) > 0.0 { widest(false) } else { widest(true) };
        let finest = self.resolution.map(|r| (widest / r).log2().ceil().max(1.0) as u32);
        self.depth.into_iter().chain(finest).min().map(|depth| depth.clamp(1, MAX_DEPTH))
    }

    /// An equal share of what is left of it for one of several passes still to come, when `boxes` and `seconds` are spent.
    pub(crate) fn share(&self, passes: usize, (boxes, seconds): (u64, f64)) -> Self {
        let most = self.boxes.unwrap_or(MAX_BOXES).min(MAX_BOXES);
        Self {
            boxes: Some(most.saturating_sub(boxes) / passes as u64),
            seconds: self.seconds.map(|all| (all - seconds).max(0.0) / passes as f64),
            ..*self
        }
    }

    /// The budget of the even paving that a search starts with: depth 10 on a line, 7 in the plane and 5 in space, or what is
    /// asked for if that is less.
    pub fn start(&self, window: &Window) -> Self {
        let usual = [10, 7, 5][window.axes().len().clamp(1, 3) - 1];
        Self { depth: Some(self.finest(window).map_or(usual, |depth| depth.min(usual))), ..*self }
    }

    /// The depth to which everything undecided is split in the end, for measures and pictures: what is asked for, or 16 on a line,
    /// 11 in the plane and 7 in space.
    pub fn even(&self, window: &Window) -> u32 {
        self.finest(window).unwrap_or([16, 11, 7][window.axes().len().clamp(1, 3) - 1])
    }
}

/// Why a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Stop {
    /// The bounds on the number of aspects met.
    Exact,
    /// The resolution asked for was reached, or nothing was left undecided.
    Resolution,
    /// The box budget was spent.
    Boxes,
    /// The time budget was spent.
    Time,
    /// Cancelled by the user.
    Cancelled,
}

impl Stop {
    /// Returns, of two, the one that left more undone.
    pub(crate) fn worse(self, other: Self) -> Self {
        if (other as u8) > self as u8 { other } else { self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use aspecta_robot::catalogue;

    #[test]
    fn a_resolution_is_of_angles_where_no_length_varies() {
        let depth = |name: &str, fix: &[(usize, f64)], resolution: f64| {
            let window = catalogue::find(name).unwrap().slice(fix).unwrap();
            Budget { resolution: Some(resolution), ..Budget::default() }.finest(&window)
        };
        // 2π / 2^6 < 0.1 < 2π / 2^5.
        assert_eq!(depth("spherical-3-rrr", &[], 0.1), Some(6));
        assert_eq!(depth("3-rrr", &[(0, 0.0), (1, 0.0)], 0.1), Some(6));
        assert_eq!(depth("3-rrr", &[], 1e6), Some(1));
        assert_eq!(depth("five-bar", &[], 1e-300), Some(MAX_DEPTH));
    }
}
