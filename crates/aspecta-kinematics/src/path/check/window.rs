//! Whether a path of poses stays within the user's window.

use super::{Asked, Bound, Joined, Obstacle};
use crate::path::curve::Curve;
use aspecta_robot::Robot;
use aspecta_robot::num::{Interval, Scalar, turned_to};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Stretches of t shorter than this are not bisected further,
const SHORTEST: f64 = 1e-12;
/// nor those shorter than this beyond the first that is in doubt.
const SHORTEST_BEYOND: f64 = 1e-3;

/// The first place at which a path is proved to leave the window, whose ends belong to it, or else may leave it.
/// Angles go on along the path as real numbers, from the turn of its start.
pub(super) fn first_beyond(
    robot: &Robot,
    poses: &[Vec<f64>],
    curves: &[Curve],
    joined: Joined,
) -> Option<Obstacle> {
    let cut = |k: usize| Some(Side::new(robot, k, robot.window_range(k)?, poses[0][k]));
    let mut sides: Vec<Side> = (0..robot.dof()).filter_map(cut).collect();
    sides.extend(pole(robot, &sides));
    let all = curves.iter().enumerate().filter_map(|(i, curve)| {
        // A segment is where its ends are.
        let ends = match joined {
            Joined::Straight => Some([&poses[i], &poses[i + 1]]),
            Joined::None => Some([&poses[i]; 2]),
            Joined::Spline => None,
        };
        let stays = |side: &Side| ends.is_some_and(|ends| ends.iter().all(|pose| side.holds(pose)));
        let left = sides.iter().filter(|side| !stays(side)).filter_map(|side| side.left_by(curve));
        let first = left.min_by(|a, b| b.proved.cmp(&a.proved).then(a.t.0.total_cmp(&b.t.0)));
        let Left { coordinate, t: (from, to), proved } = first?;
        let pose = curve.at(0.5 * (from + to))[..robot.dof()].to_vec();
        let bound = Bound::Window { coordinate: robot.platform.coordinates()[coordinate].name };
        Some(Obstacle { asked: Asked::Limit, segment: i + 1, t: (from, to), pose, bound, proved })
    });
    let mut doubt = None;
    for obstacle in all {
        if obstacle.proved {
            return Some(obstacle);
        }
        doubt.get_or_insert(obstacle);
    }
    doubt
}

/// Beyond pitch = ±90° poses are told by half a turn more of roll and yaw: where these are cut, no more is
/// known there.
fn pole(robot: &Robot, sides: &[Side]) -> Option<Side> {
    let [roll, pitch, yaw] = robot.platform.turns()?;
    let is_cut = |k: usize| sides.iter().any(|side| side.coordinate == k);
    let [low, high] = [-FRAC_PI_2, FRAC_PI_2].map(Interval::point);
    (is_cut(roll) || is_cut(yaw)).then_some(Side { coordinate: pitch, low, high, decides: false })
}

/// What the window lets a coordinate be along the path.
struct Side {
    coordinate: usize,
    low: Interval,
    high: Interval,
    /// Whether the window is left where the coordinate leaves the range; else it may be.
    decides: bool,
}

/// Where a coordinate leaves its range.
struct Left {
    coordinate: usize,
    t: (f64, f64),
    proved: bool,
}

impl Side {
    fn new(robot: &Robot, k: usize, (low, high): (f64, f64), start: f64) -> Self {
        let turns = if (low..=high).contains(&start) || !robot.platform.coordinates()[k].periodic {
            0.0
        } else {
            ((start - turned_to(start, 0.5 * (low + high))) / TAU).round()
        };
        let turn = Interval::PI * Interval::point(2.0 * turns);
        let end = |x: f64| if turns == 0.0 { Interval::point(x) } else { turn + Interval::point(x) };
        Self { coordinate: k, low: end(low), high: end(high), decides: true }
    }

    /// Whether a pose is within, to the rounding of full turns.
    fn holds(&self, pose: &[f64]) -> bool {
        (self.low.lo..=self.high.hi).contains(&pose[self.coordinate])
    }

    /// Where a piece of path is proved to leave the range for the first time, or else may.
    fn left_by(&self, curve: &Curve) -> Option<Left> {
        let mut doubt = None;
        let mut open = vec![(0.0, 1.0)];
        while let Some((from, to)) = open.pop() {
            let x = curve.over::<6>(Interval::new(from, to))[self.coordinate].tightened().range;
            if self.low.hi <= x.lo && x.hi <= self.high.lo {
                continue;
            }
            let outside = x.hi < self.low.lo || self.high.hi < x.lo;
            if outside || to - from < if doubt.is_none() { SHORTEST } else { SHORTEST_BEYOND } {
                let last = curve.over::<6>(Interval::point(to))[self.coordinate].range;
                let crossed = last.hi < self.low.lo || self.high.hi < last.lo;
                let here = |proved| Left { coordinate: self.coordinate, t: (from, to), proved };
                if crossed && self.decides {
                    return Some(here(true));
                }
                doubt.get_or_insert(here(false));
                continue;
            }
            let middle = 0.5 * (from + to);
            open.extend([(middle, to), (from, middle)]);
        }
        doubt
    }
}
