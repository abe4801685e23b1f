//! Charts: coordinates in which the robot in a working mode is described.
//!
//! The pose X is enough almost everywhere. It is not where a leg can fold its rod back onto its crank so that
//! C comes to lie on the crank's axis: in the plane if L = M, at d = C − A = 0; in space if L ≤ M, at d = (0,
//! 0, ±√(M² − L²)). There one pose has a whole circle of q_j, aspects that are apart in W × Q touch in W, and
//! det A depends on the direction from which the point is approached. The leg's own coordinates open this up.
//!
//! Neither is it enough to turn about a point: roll and yaw are one at the poles of the pitch. There the
//! joint angles of one leg, from the base to the platform, are coordinates of all configurations; and where
//! another leg folds, its own are.

mod bend;
mod chain;
mod fold;

pub use bend::uncharted_folds;
pub use chain::coordinates;
pub(crate) use fold::cover;
pub use fold::folds;

use super::modal::{LegClosure, closures};
use super::placement::Placement;
use arrayvec::ArrayVec;
pub use aspecta_robot::chart::{Bend, Chain, Chart, Fold};
use aspecta_robot::num::{Interval, Scalar, each};
use aspecta_robot::{Robot, Window};

/// A chart put to use: where a point of it puts the robot.
pub trait Coordinates {
    /// The placement of the platform and the state of the legs at the point `y` of the chart; `turn(k)` gives
    /// (sin, cos) of the angle `y[k]`.
    fn at<T: Scalar, const D: usize, const N: usize>(
        &self,
        robot: &Robot,
        y: &[T; N],
        turn: impl Fn(usize) -> (T, T),
    ) -> (Placement<T, D>, [LegClosure<T, D>; N]);

    /// Functions of the legs at a pose: where all are positive and the legs close, the chart covers the pose.
    fn cover<T: Scalar, const D: usize, const N: usize>(
        &self,
        robot: &Robot,
        legs: &[LegClosure<T, D>; N],
    ) -> ArrayVec<T, 4>;

    /// Poses that hold all configurations whose coordinates are in `y`.
    fn pose<const D: usize, const N: usize>(&self, robot: &Robot, y: &[Interval; N]) -> [Interval; N];

    /// The pose of a point of the chart, numerically.
    fn pose_at<const D: usize, const N: usize>(&self, robot: &Robot, y: &[f64; N]) -> [f64; N];
}

impl Coordinates for Chart {
    fn at<T: Scalar, const D: usize, const N: usize>(
        &self,
        robot: &Robot,
        y: &[T; N],
        turn: impl Fn(usize) -> (T, T),
    ) -> (Placement<T, D>, [LegClosure<T, D>; N]) {
        match self {
            Self::Pose => {
                let placement = Placement::new(robot.platform, y, turn);
                let legs = closures(robot, &placement);
                (placement, legs)
            }
            Self::Fold(fold) => fold::at(fold, robot, y, turn),
            Self::Chain(chain) => chain::at(chain, robot, turn),
        }
    }

    fn cover<T: Scalar, const D: usize, const N: usize>(
        &self,
        robot: &Robot,
        legs: &[LegClosure<T, D>; N],
    ) -> ArrayVec<T, 4> {
        match self {
            Self::Fold(fold) => fold::cover(fold, &legs[fold.leg.index()]),
            Self::Chain(Chain { leg, bend: Some(bend) }) => {
                std::iter::once(chain::cover(bend, &robot.leg(*leg).actuator, &legs[leg.index()].span))
                    .collect()
            }
            Self::Pose | Self::Chain(_) => ArrayVec::new(),
        }
    }

    fn pose<const D: usize, const N: usize>(&self, robot: &Robot, y: &[Interval; N]) -> [Interval; N] {
        let placement = || self.at::<Interval, D, N>(robot, y, |k| y[k].sin_cos()).0;
        match self {
            Self::Pose => *y,
            Self::Fold(_) => moved_to(&placement(), y),
            Self::Chain(_) => chain::pose(&placement()),
        }
    }

    fn pose_at<const D: usize, const N: usize>(&self, robot: &Robot, y: &[f64; N]) -> [f64; N] {
        let placement = || self.at::<f64, D, N>(robot, y, |k| y[k].sin_cos()).0;
        match self {
            Self::Pose => *y,
            Self::Fold(_) => moved_to(&placement(), y),
            Self::Chain(_) => chain::pose_at(&placement()),
        }
    }
}

/// The pose of a fold: its coordinates stand for the translations.
fn moved_to<T: Scalar, const D: usize, const N: usize>(placement: &Placement<T, D>, y: &[T; N]) -> [T; N] {
    each!(|k| if k < D { placement.origin()[k] } else { y[k] })
}

/// Least half-width of a fold's chart that is worth having, relative to the crank (of an elbow's angle, in
/// rad).
const LEAST: f64 = 1e-3;

/// The charts that replace the pose where it is not enough: for a platform that turns about a point, if the
/// window is all of its orientations, one leg's joint angles everywhere, and those of others where these
/// fold; else the robot's folds.
pub fn charts(robot: &Robot, window: &Window) -> Vec<Chart> {
    match chain::of(robot, window) {
        Some(chain) => {
            let bends = bend::bends(robot, &chain);
            std::iter::once(chain).chain(bends).map(Chart::Chain).collect()
        }
        None => folds(robot, window).into_iter().map(Chart::Fold).collect(),
    }
}

/// Places of the greatest size at which they are all `apart`; none if they are never.
fn largest_apart<P>(places: impl Fn(f64) -> Vec<P>, apart: impl Fn(&P, &P) -> bool) -> Vec<P> {
    let mut size = 0.3;
    while size > LEAST {
        let found = places(size);
        if found.iter().enumerate().all(|(i, a)| found[i + 1..].iter().all(|b| apart(a, b))) {
            return found;
        }
        size *= 0.7;
    }
    Vec::new()
}
