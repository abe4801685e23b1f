//! Places for short names beside the points they name, clear of lines and of each other.

use std::f64::consts::TAU;

/// From a point to the middle of its name, pixels.
const DISTANCE: f64 = 15.0;
/// Nothing farther than this disturbs a name.
const CLEAR: f64 = 15.0;
/// Directions tried, from upper right on.
const DIRECTIONS: usize = 16;

/// The points, in pixels, that names should keep clear of.
pub struct Labels {
    taken: Vec<[f64; 2]>,
}

impl Labels {
    /// Names among these lines.
    pub fn among(lines: impl Iterator<Item = [[f64; 2]; 2]>) -> Self {
        let points = |[a, b]: [[f64; 2]; 2]| {
            let steps = ((b[0] - a[0]).hypot(b[1] - a[1]) / 4.0).ceil().max(1.0);
            let at = move |t: f64| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
            (0..=steps as usize).map(move |k| at(k as f64 / steps))
        };
        Self { taken: lines.flat_map(points).collect() }
    }

    /// The middle of the name of the point `at`: in the direction in which the next line or name is farthest.
    pub fn beside(&mut self, at: [f64; 2]) -> [f64; 2] {
        let candidate = |k: usize| {
            let turn = TAU * (k as f64 / DIRECTIONS as f64 - 0.125);
            [at[0] + DISTANCE * turn.cos(), at[1] + DISTANCE * turn.sin()]
        };
        let room = |p: [f64; 2]| {
            let distances = self.taken.iter().map(|t| (t[0] - p[0]).hypot(t[1] - p[1]));
            distances.fold(CLEAR, f64::min)
        };
        let best = (0..DIRECTIONS).map(candidate).reduce(|a, b| if room(b) > room(a) { b } else { a });
        let best = best.unwrap_or(at);
        // A name is two letters wide.
        self.taken.extend([-5.0, 0.0, 5.0].map(|dx| [best[0] + dx, best[1]]));
        best
    }
}
