//! Straight segments in pose coordinates, proved free of singularities between their ends.

use super::modal::{Constraint, constraints};
use super::placement::Placement;
use super::{WorkingMode, for_platform};
use crate::num::{Interval, Scalar, Slope};
use crate::robot::Robot;

/// What intervals prove of a working mode and a sign of det A along a segment X(t) = X₀ + t (X₁ − X₀), t ∈ [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Along {
    /// Every H_j > 0, every limit kept and det A of the given sign for all t: the segment lies in one
    /// generalized aspect.
    Inside,
    /// The constraint certainly fails on part of [`from`, `to`].
    Outside {
        /// Which one.
        constraint: Constraint,
        /// Start of the stretch, t.
        from: f64,
        /// End of the stretch, t.
        to: f64,
    },
    /// Neither could be proved on [`from`, `to`] (t), shorter than 10⁻¹² or beyond the effort allowed.
    Undecided {
        /// Which constraint is in doubt.
        constraint: Constraint,
        /// Start of the stretch, t.
        from: f64,
        /// End of the stretch, t.
        to: f64,
    },
}

/// Stretches of t shorter than this are not bisected further.
const SHORTEST: f64 = 1e-12;

/// Decides whether the segment from `start` to `end` lies in the aspect class (`mode`, det A of sign `sign`),
/// in at most `effort` interval evaluations.
///
/// Theorem. The range of a constraint over t ∈ T lies in the intersection of its natural interval extension and
/// its centred form about the middle of T ([`Slope`]). [0, 1] is bisected until each stretch has all constraints > 0; the
/// stretches cover [0, 1], so S_{s,σ} holds the whole segment, which is connected: it lies in one aspect.
/// Robot constants are intervals; `start` and `end` are taken as exact doubles, angles as real numbers.
pub fn along(robot: &Robot, mode: WorkingMode, sign: i8, start: &[f64], end: &[f64], effort: usize) -> Along {
    for_platform!(robot.platform, along_in(robot, mode, sign, start, end, effort))
}

fn along_in<const D: usize, const N: usize>(
    robot: &Robot,
    mode: WorkingMode,
    sign: i8,
    start: &[f64],
    end: &[f64],
    effort: usize,
) -> Along {
    let mut open = vec![(0.0, 1.0)];
    let mut spent = 0;
    let mut doubt: Option<(Constraint, f64, f64)> = None;
    while let Some((from, to)) = open.pop() {
        spent += 1;
        match stretch::<D, N>(robot, mode, sign, start, end, Interval::new(from, to)) {
            Stretch::Inside => {}
            // It may begin at the doubt before it, if any.
            Stretch::Outside(constraint) => {
                let from = doubt.map_or(from, |(_, from, _)| from);
                return Along::Outside { constraint, from, to };
            }
            Stretch::Open(constraint) if spent >= effort => {
                let (constraint, from, to) = doubt.unwrap_or((constraint, from, to));
                return Along::Undecided { constraint, from, to };
            }
            Stretch::Open(constraint) if to - from < SHORTEST => {
                doubt.get_or_insert((constraint, from, to));
            }
            Stretch::Open(_) => {
                let middle = 0.5 * (from + to);
                open.push((middle, to));
                open.push((from, middle));
            }
        }
    }
    match doubt {
        None => Along::Inside,
        Some((constraint, from, to)) => Along::Undecided { constraint, from, to },
    }
}

enum Stretch {
    Inside,
    Outside(Constraint),
    Open(Constraint),
}

/// One stretch t ∈ `range`.
fn stretch<const D: usize, const N: usize>(
    robot: &Robot,
    mode: WorkingMode,
    sign: i8,
    start: &[f64],
    end: &[f64],
    range: Interval,
) -> Stretch {
    let middle = Interval::point(range.mid());
    let radius = Interval::point((range - middle).magnitude());
    let x: [Slope<Interval, 1>; N] = std::array::from_fn(|k| {
        let origin = Interval::point(start[k]);
        let step = Interval::point(end[k]) - origin;
        Slope::variable(origin + range * step, origin + middle * step, radius * step, 0)
    });
    let mut result = Stretch::Inside;
    constraints::<_, D, N>(robot, &Placement::at(robot.platform, &x), mode, |constraint, value| {
        let value = value.tightened().range;
        let value = if constraint == Constraint::Det && sign < 0 { -value } else { value };
        if value.is_negative() {
            result = Stretch::Outside(constraint);
            return false;
        }
        if !value.is_positive() && matches!(result, Stretch::Inside) {
            result = Stretch::Open(constraint);
        }
        true
    });
    result
}
