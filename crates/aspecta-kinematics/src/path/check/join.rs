//! How samples become curves.

use crate::path::curve::Curve;
use crate::path::spline::{Point, Spline};
use aspecta_robot::num::padded;
use serde::{Deserialize, Serialize};

/// How the samples of a path are joined.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Joined {
    /// By straight segments in pose (or joint) coordinates, angles as real numbers: a turn from 3 to −3 rad
    /// goes the long way.
    #[default]
    Straight,
    /// By one cubic spline, twice continuously differentiable, over the lengths of the chords: each
    /// coordinate is divided by the robot's characteristic length, or by a radian. Samples that repeat the
    /// one before are passed over. Its ends are not-a-knot: four samples give one cubic, three a parabola.
    Spline,
    /// Not at all: nothing is known between them.
    None,
}

/// Returns one curve from each sample to the next; for [`Joined::None`] one that stays, at each sample.
/// `units` make coordinates comparable.
pub(super) fn join(samples: &[Vec<f64>], units: &[f64], joined: Joined) -> Vec<Curve> {
    match joined {
        Joined::Straight => samples.windows(2).map(|w| Curve::segment(&w[0], &w[1])).collect(),
        Joined::None => samples.iter().map(|x| Curve::segment(x, x)).collect(),
        Joined::Spline => spline(samples, units),
    }
}

/// A sample that repeats the one before adds a curve that stays there.
fn spline(samples: &[Vec<f64>], units: &[f64]) -> Vec<Curve> {
    let (mut knots, mut points) = (vec![0.0], vec![padded(&samples[0])]);
    // The knot at which each curve ends.
    let mut ends = Vec::new();
    for w in samples.windows(2) {
        let chord = (0..units.len()).map(|i| ((w[1][i] - w[0][i]) / units[i]).powi(2)).sum::<f64>().sqrt();
        let knot = knots[knots.len() - 1] + chord;
        let moves = knot > knots[knots.len() - 1];
        if moves {
            knots.push(knot);
            points.push(padded(&w[1]));
        }
        ends.push(moves.then(|| knots.len() - 1));
    }
    let spline = Spline::new(knots, points);
    let knots = spline.knots();
    let curve = |(end, w): (&Option<usize>, &[Vec<f64>])| {
        let Some(end) = *end else { return Curve::segment(&w[0], &w[1]) };
        let length = knots[end] - knots[end - 1];
        // With respect to t ∈ [0, 1].
        let speed = |s: f64| -> Point { spline.at(end - 1, s)[1].map(|v| v * length) };
        let speeds = [speed(knots[end - 1]), speed(knots[end])];
        let n = w[0].len();
        Curve::cubic(&w[0], &w[1], [&speeds[0][..n], &speeds[1][..n]])
    };
    ends.iter().zip(samples.windows(2)).map(curve).collect()
}
