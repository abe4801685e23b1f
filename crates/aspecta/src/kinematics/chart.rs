//! Charts: coordinates in which the robot in a working mode is described.
//!
//! The pose X is enough almost everywhere. It is not where a leg can fold its rod back onto its crank so that C comes to
//! lie on the crank's axis: in the plane if L = M, at d = C − A = 0; in space if L ≤ M, at
//! d = (0, 0, ±√(M² − L²)). There one pose has a whole circle of q_j, aspects that are apart in W × Q touch in W, and det A
//! depends on the direction from which the point is approached. The leg's own coordinates open this up.
//!
//! Neither is it enough to turn about a point: roll and yaw are one at the poles of the pitch. There the joint angles of one leg,
//! from the base to the platform, are coordinates of all configurations; and where another leg folds, its own are.

mod bend;
mod chain;

pub use bend::uncharted_folds;
pub use chain::{Bend, Chain};

use super::leg::{Closure, sum_of_squares};
use super::modal::{LegClosure, closures};
use super::placement::{Placement, out_of_frame};
use crate::num::{Interval, Scalar, each};
use crate::robot::{Actuator, Platform, Robot, Window};
use arrayvec::ArrayVec;
use serde::{Deserialize, Serialize};

/// Coordinates of configurations (X, q).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Chart {
    /// X.
    Pose,
    /// One leg's own coordinates instead of the platform's translations.
    Fold(Fold),
    /// The joint angles of one spherical leg, everywhere or near its fold.
    Chain(Chain),
}

/// The configurations in which one revolute leg is nearly folded.
///
/// Coordinates: the crank's angle q_j = α; p, the rod's direction along the crank's direction of motion; in
/// space also w, its direction along the crank's axis; then the platform's angle, if it has one. In the crank's frame
/// (radial, tangential, axial) the rod points along
///
/// > u = (−√(1 − p² − w²), p, w),  d = L e_radial + M u,  ∂f/∂C = 2M u,  B_jj = ∂f/∂q = −2LM p.
///
/// Nothing here has a root that vanishes: leg j's serial singularity is the coordinate plane p = 0, its posture is the
/// sign of −p, and its row of A is smooth across both.
///
/// The chart covers, in W, exactly the poses with ‖d‖² < L² + M², H_j ≤ (2LM p₀)² and, in space,
/// γ/M in the range of w ([`Fold::cover`]): M u_radial = (‖d‖² − L² − M²)/2L, H_j = (2LM p)² and γ = M w.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fold {
    /// Leg j, from 0.
    pub leg: usize,
    /// L.
    pub crank: Interval,
    /// M.
    pub rod: Interval,
    /// p₀: the chart holds −p₀ ≤ p ≤ p₀.
    pub half_width: f64,
    /// Range of w.
    pub axial: Option<(f64, f64)>,
}

/// What a folded leg knows of itself.
#[derive(Clone, Copy, Debug)]
pub struct Folded<T> {
    /// cos q.
    pub cos: T,
    /// sin q.
    pub sin: T,
    /// B_jj = −2LM p: the posture s has s B_jj > 0.
    pub b: T,
}

impl Chart {
    /// The leg whose own coordinates these are, from 0; its q is the first of them.
    pub fn leg(&self) -> Option<usize> {
        match self {
            Self::Pose => None,
            Self::Fold(fold) => Some(fold.leg),
            Self::Chain(chain) => Some(chain.leg),
        }
    }

    /// The placement of the platform and the state of the legs at the point `y` of the chart; `turn(k)` gives (sin, cos) of the
    /// angle `y[k]`.
    pub fn at<T: Scalar, const D: usize, const N: usize>(
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
            Self::Fold(fold) => fold.at(robot, y, turn),
            Self::Chain(chain) => chain.at(robot, turn),
        }
    }

    /// Whether it holds all configurations.
    pub fn is_whole(&self) -> bool {
        matches!(self, Self::Pose | Self::Chain(Chain { bend: None, .. }))
    }

    /// Functions of the legs at a pose: where all are positive and the legs close, the chart covers the pose.
    pub fn cover<T: Scalar, const D: usize, const N: usize>(
        &self,
        robot: &Robot,
        legs: &[LegClosure<T, D>; N],
    ) -> ArrayVec<T, 4> {
        match self {
            Self::Fold(fold) => fold.cover(&legs[fold.leg]),
            Self::Chain(Chain { leg, bend: Some(bend) }) => {
                std::iter::once(bend.cover(&robot.legs[*leg].actuator, &legs[*leg].span)).collect()
            }
            Self::Pose | Self::Chain(_) => ArrayVec::new(),
        }
    }

    /// The coordinates at whose ends the chart ends, other charts going on there.
    pub fn bounded(&self, robot: &Robot) -> std::ops::Range<usize> {
        match self {
            Self::Fold(_) => 1..robot.platform.space(),
            Self::Chain(Chain { bend: Some(_), .. }) => 1..2,
            Self::Pose | Self::Chain(_) => 0..0,
        }
    }

    /// Poses that hold all configurations whose coordinates are in `y`.
    pub fn pose<const D: usize, const N: usize>(&self, robot: &Robot, y: &[Interval; N]) -> [Interval; N] {
        let placement = || self.at::<Interval, D, N>(robot, y, |k| y[k].sin_cos()).0;
        match self {
            Self::Pose => *y,
            Self::Fold(_) => moved_to(&placement(), y),
            Self::Chain(_) => chain::pose(&placement()),
        }
    }

    /// The pose of a point of the chart, numerically.
    pub fn pose_at<const D: usize, const N: usize>(&self, robot: &Robot, y: &[f64; N]) -> [f64; N] {
        let placement = || self.at::<f64, D, N>(robot, y, |k| y[k].sin_cos()).0;
        match self {
            Self::Pose => *y,
            Self::Fold(_) => moved_to(&placement(), y),
            Self::Chain(_) => chain::pose_at(&placement()),
        }
    }

    /// The window of the chart, given that of the poses.
    pub fn window(&self, poses: &Window) -> Window {
        let fold = match self {
            Self::Pose => return poses.clone(),
            Self::Fold(fold) => fold,
            Self::Chain(chain) => return chain.window(),
        };
        let mut window = poses.clone();
        let p = fold.half_width;
        let lengths = [Some((-Interval::PI.hi, Interval::PI.hi)), Some((-p, p)), fold.axial];
        for (k, range) in lengths.into_iter().flatten().enumerate() {
            window.ranges[k] = range;
            window.angles[k] = k == 0;
            window.glued[k] = k == 0;
            window.cut[k] = (false, false);
        }
        window
    }
}

/// The pose of a fold: its coordinates stand for the translations.
fn moved_to<T: Scalar, const D: usize, const N: usize>(placement: &Placement<T, D>, y: &[T; N]) -> [T; N] {
    each!(|k| if k < D { placement.origin()[k] } else { y[k] })
}

impl Fold {
    fn at<T: Scalar, const D: usize, const N: usize>(
        &self,
        robot: &Robot,
        y: &[T; N],
        turn: impl Fn(usize) -> (T, T),
    ) -> (Placement<T, D>, [LegClosure<T, D>; N]) {
        let leg = &robot.legs[self.leg];
        let (crank, rod) = (self.crank, self.rod);
        let one = T::constant(Interval::point(1.0));
        let (sin, cos) = turn(0);
        let tangential = y[1];
        let across = if D == 3 { y[1].square() + y[2].square() } else { y[1].square() };
        let radial = -(one - across).sqrt();
        let mut u = [T::zero(); D];
        (u[0], u[1]) = (radial * cos - tangential * sin, radial * sin + tangential * cos);
        if D == 3 {
            u[D - 1] = y[2];
        }
        let reach = radial.scale(rod) + T::constant(crank);
        let offset = tangential.scale(rod);
        let mut span = [T::zero(); D];
        (span[0], span[1]) = (reach * cos - offset * sin, reach * sin + offset * cos);
        if D == 3 {
            span[D - 1] = y[2].scale(rod);
        }
        let placement = Placement::with_end(robot.platform, leg, &out_of_frame(leg, &span), turn);
        let mut legs = closures(robot, &placement);
        let b = -tangential.scale(Interval::point(2.0) * crank * rod);
        legs[self.leg] = LegClosure {
            arm: placement.arm(leg),
            span,
            closure: Closure {
                reach: b.square(),
                weight: one,
                fixed: each!(|k| u[k].scale(rod + rod)),
                swing: [T::zero(); D],
            },
            fold: Some(Folded { cos, sin, b }),
        };
        (placement, legs)
    }

    /// Functions of leg j at a pose: where all are positive and the leg closes, the chart covers the pose.
    pub fn cover<T: Scalar, const D: usize>(&self, leg: &LegClosure<T, D>) -> ArrayVec<T, 4> {
        let constant = |c: Interval| T::constant(c);
        let bend = sum_of_squares(&leg.span) - constant(self.crank.square() + self.rod.square());
        let b = Interval::point(2.0 * self.half_width) * self.crank * self.rod;
        let mut margins: ArrayVec<T, 4> =
            [-bend, constant(b.square()) - leg.closure.reach].into_iter().collect();
        if let Some((lo, hi)) = self.axial {
            let height = leg.span[D - 1];
            margins.push(height - constant(self.rod * Interval::point(lo)));
            margins.push(constant(self.rod * Interval::point(hi)) - height);
        }
        margins
    }
}

/// Least half-width of a fold's chart that is worth having, relative to the crank (of an elbow's angle, in rad).
const LEAST: f64 = 1e-3;

/// The charts that replace the pose where it is not enough: for a platform that turns about a point, if the window is all of its
/// orientations, one leg's joint angles everywhere, and those of others where these fold; else the robot's folds.
pub fn charts(robot: &Robot, window: &Window) -> Vec<Chart> {
    match Chain::of(robot, window) {
        Some(chain) => {
            let bends = bend::bends(robot, &chain);
            std::iter::once(chain).chain(bends).map(Chart::Chain).collect()
        }
        None => folds(robot, window).into_iter().map(Chart::Fold).collect(),
    }
}

/// The folds of a robot that need a chart of their own, each with a chart small enough to be disjoint from the others; legs
/// whose folds cannot be told apart get none.
///
/// A fold is charted if the platform's translations are free in `window` and C can come onto the crank's axis, or so
/// near (|L − M| below a twentieth of L + M in the plane) that the pose would need very small boxes.
pub fn folds(robot: &Robot, window: &Window) -> Vec<Fold> {
    let translations = match robot.platform {
        Platform::PlanePoint | Platform::PlaneBody => 2,
        Platform::TranslatingBody => 3,
        // The platform keeps its orientation, as a translating one does.
        Platform::FreeBody if window.held().map(|(k, _)| k).eq(3..6) => 3,
        Platform::TurningBody | Platform::FreeBody => return Vec::new(),
    };
    if (0..translations).any(|k| window.ranges[k].0 == window.ranges[k].1 || window.cut[k] != (false, false))
    {
        return Vec::new();
    }
    let places = |size: f64| (0..robot.dof()).flat_map(|leg| Place::of_leg(robot, leg, size)).collect();
    let found = largest_apart(places, |a: &Place, b: &Place| a.is_apart_from(b, robot, window));
    found.into_iter().map(|place| place.fold).collect()
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

/// A fold and where in the leg's frame it is: within `radius` of (0, 0, `height`).
struct Place {
    fold: Fold,
    height: f64,
    radius: f64,
}

impl Place {
    /// The folds of a leg, charted to about `size` cranks from the axis.
    fn of_leg(robot: &Robot, leg: usize, size: f64) -> Vec<Self> {
        let Actuator::Revolute { crank, rod } = robot.legs[leg].actuator else { return Vec::new() };
        let (l, m) = (crank.mid(), rod.mid());
        let p = size * l / m;
        if robot.platform.space() == 2 {
            // d² = L² + M² − 2LM √(1 − p²) at most.
            let radius = (l * l + m * m - 2.0 * l * m * (1.0 - p * p).max(0.0).sqrt()).sqrt();
            let near = (l - m).abs() < 0.05 * (l + m) && p < 0.9;
            let fold = Fold { leg, crank, rod, half_width: p, axial: None };
            return near.then_some(Self { fold, height: 0.0, radius: 1.01 * radius }).into_iter().collect();
        }
        if m < l * (1.0 - 1e-9) {
            return Vec::new();
        }
        let axial = |end: f64| (1.0 - (end * l / m).powi(2)).max(0.0).sqrt();
        let (inner, outer) = (axial(1.0 + size), axial(1.0 - size));
        if p * p + outer * outer > 0.98 {
            return Vec::new();
        }
        // The two tips of one axis share a chart if it reaches from one to the other.
        let ranges =
            if inner == 0.0 { vec![(-outer, outer)] } else { vec![(inner, outer), (-outer, -inner)] };
        let place = |(lo, hi): (f64, f64)| {
            let (height, half) = (0.5 * m * (lo + hi), 0.5 * m * (hi - lo));
            // Off the axis at most |L + M u_radial| and M |p|.
            let radial = (l - m * (1.0 - p * p - outer * outer).sqrt()).abs().max((m - l).min(size * l));
            let radius = 1.01 * (half * half + radial * radial + (m * p).powi(2)).sqrt();
            Self { fold: Fold { leg, crank, rod, half_width: p, axial: Some((lo, hi)) }, height, radius }
        };
        ranges.into_iter().map(place).collect()
    }

    /// Whether no pose is in both charts, by the triangle inequality; the twentieth to spare is far beyond rounding.
    fn is_apart_from(&self, other: &Self, robot: &Robot, window: &Window) -> bool {
        let centre = |place: &Self| {
            let leg = &robot.legs[place.fold.leg];
            std::array::from_fn::<f64, 3, _>(|k| leg.anchor[k].mid() + place.height * leg.frame[2][k].mid())
        };
        let still: Vec<f64> = window.ranges.iter().map(|r| r.0).collect();
        let arm = |place: &Self| -> [f64; 3] {
            let leg = &robot.legs[place.fold.leg];
            match robot.platform {
                Platform::FreeBody => Placement::<f64, 3>::at(robot.platform, &still).arm(leg),
                _ => leg.attachment.map(|c| c.mid()),
            }
        };
        let between = |a: [f64; 3], b: [f64; 3]| std::array::from_fn::<f64, 3, _>(|k| a[k] - b[k]);
        let norm = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let (base, body) = (between(centre(self), centre(other)), between(arm(self), arm(other)));
        let distance = match robot.platform {
            Platform::PlaneBody => (norm(base) - norm(body)).abs(),
            _ => norm(between(base, body)),
        };
        distance > 1.05 * (self.radius + other.radius)
    }
}
