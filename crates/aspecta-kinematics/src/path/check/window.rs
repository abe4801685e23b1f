//! Whether a path of poses stays within the user's window.

use super::{Asked, Bound, Joined, Obstacle};
use crate::path::curve::Curve;
use aspecta_robot::Robot;
use aspecta_robot::num::{Interval, Scalar, turned_to};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Stretches of t shorter than this are not bisected further,
const SHORTEST: f64 = 1e-12;
/// nor those shorter than this beyond the first that is in doubt.
const SHORTEST_BEYOND: f64 = 1e-3;

/// The first place at which a path is proved to leave the window, whose ends belong to it, or else may leave
/// it. Angles go on along the path as real numbers, from the turn of its start.
pub(super) fn first_beyond(
    robot: &Robot,
    poses: &[Vec<f64>],
    curves: &[Curve],
    joined: Joined,
) -> Option<Obstacle> {
    if joined == Joined::None {
        return poses.iter().enumerate().find_map(|(i, pose)| {
            let bound = bound(robot, robot.beyond_window(pose)?);
            let pose = pose.clone();
            Some(Obstacle { asked: Asked::Limit, segment: i + 1, t: (0.0, 0.0), pose, bound, proved: true })
        });
    }
    let sides = Side::all(robot, &poses[0]);
    let mut doubt = None;
    for (i, curve) in curves.iter().enumerate() {
        // A segment is where its ends are.
        let ends = (joined == Joined::Straight).then(|| [&poses[i], &poses[i + 1]]);
        let stays = |side: &Side| ends.is_some_and(|ends| ends.iter().all(|pose| side.holds(pose)));
        let crossed = sides.iter().filter(|side| !stays(side)).filter_map(|side| side.left_by(curve));
        let mut left: Vec<Left> = crossed.collect();
        left.sort_by(|a, b| a.t.0.total_cmp(&b.t.0));
        let here = |&Left { coordinate, t: (from, to), proved, .. }: &Left| {
            let pose = curve.at(0.5 * (from + to))[..robot.dof()].to_vec();
            let bound = bound(robot, coordinate);
            Obstacle { asked: Asked::Limit, segment: i + 1, t: (from, to), pose, bound, proved }
        };
        let until_lost = left.iter().take_while(|left| left.known);
        if let Some(proved) = until_lost.clone().find(|left| left.proved) {
            return Some(here(proved));
        }
        doubt = doubt.or_else(|| left.first().map(here));
        if until_lost.count() < left.len() {
            break;
        }
    }
    doubt
}

fn bound(robot: &Robot, coordinate: usize) -> Bound {
    Bound::Window { coordinate: robot.platform.coordinates()[coordinate].name }
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
    /// Whether more is known of what comes after.
    known: bool,
}

impl Side {
    /// The sides of a path, in the turns of its start. Beyond pitch = ±90° poses are told by half a turn more
    /// of roll and yaw: what is told beyond is looked at from there, and where roll or yaw are cut no more is
    /// known once the pole is passed.
    fn all(robot: &Robot, start: &[f64]) -> Vec<Self> {
        let turns = robot.platform.turns();
        let flipped = turns.is_some_and(|[_, pitch, _]| start[pitch].cos() < 0.0);
        let mut sides = Vec::new();
        for k in 0..robot.dof() {
            let Some((low, high)) = robot.window_range(k) else { continue };
            let [low, high] = [low, high].map(Interval::point);
            match turns {
                Some([_, pitch, _]) if k == pitch => {
                    sides.extend(Self::of_pitch(k, (low, high), start[k]));
                }
                Some([roll, _, yaw]) if flipped && (k == roll || k == yaw) => {
                    sides.push(Self::periodic(k, (low - Interval::PI, high - Interval::PI), start[k]));
                }
                _ if robot.platform.coordinates()[k].periodic => {
                    sides.push(Self::periodic(k, (low, high), start[k]));
                }
                _ => sides.push(Self { coordinate: k, low, high, decides: true }),
            }
        }
        if let Some([roll, pitch, yaw]) = turns
            && sides.iter().any(|side| side.coordinate == roll || side.coordinate == yaw)
        {
            let quarter = Interval::PI * Interval::point(0.5);
            let half_turns = Interval::point((start[pitch] / PI).round()) * Interval::PI;
            let (low, high) = (half_turns - quarter, half_turns + quarter);
            sides.push(Self { coordinate: pitch, low, high, decides: false });
        }
        sides
    }

    /// The range by the turns next to the start.
    fn periodic(k: usize, (low, high): (Interval, Interval), start: f64) -> Self {
        let inside = low.hi <= start && start <= high.lo;
        let turns = ((start - turned_to(start, 0.5 * (low.mid() + high.mid()))) / TAU).round();
        let turn = Interval::PI * Interval::point(2.0 * turns);
        let at = |end: Interval| if inside || turns == 0.0 { end } else { end + turn };
        Self { coordinate: k, low: at(low), high: at(high), decides: true }
    }

    /// A pitch goes back from where it is ±90°: a range that ends there goes on to its other end.
    fn of_pitch(k: usize, (low, high): (Interval, Interval), start: f64) -> Option<Self> {
        let (to_top, to_bottom) = (high.lo >= FRAC_PI_2, low.hi <= -FRAC_PI_2);
        let above = if to_top { Interval::PI - low } else { high };
        let below = if to_bottom { -Interval::PI - high } else { low };
        if to_top && to_bottom {
            return None;
        }
        // From the half turn of the start the pitch is told forwards or backwards.
        let half_turns = (start / PI).round();
        let about = Interval::PI * Interval::point(half_turns);
        let forwards = half_turns.rem_euclid(2.0) == 0.0;
        let (low, high) = match (half_turns == 0.0, forwards) {
            (true, _) => (below, above),
            (false, true) => (about + below, about + above),
            (false, false) => (about - above, about - below),
        };
        Some(Self { coordinate: k, low, high, decides: true })
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
                let here =
                    |proved| Left { coordinate: self.coordinate, t: (from, to), proved, known: self.decides };
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
