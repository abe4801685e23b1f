//! The coordinates of a nearly folded leg, and where a robot has such folds.

use super::largest_apart;
use crate::modal::{Folded, LegClosure, closures};
use crate::placement::{Placement, out_of_frame};
use arrayvec::ArrayVec;
use aspecta_robot::chart::Fold;
use aspecta_robot::legs::{Closure, Revolute, sum_of_squares};
use aspecta_robot::num::{Interval, Scalar, each};
use aspecta_robot::{LegIndex, Platform, Robot, Window};

/// [`super::Coordinates::at`].
pub(super) fn at<T: Scalar, const D: usize, const N: usize>(
    fold: &Fold,
    robot: &Robot,
    y: &[T; N],
    turn: impl Fn(usize) -> (T, T),
) -> (Placement<T, D>, [LegClosure<T, D>; N]) {
    let leg = robot.leg(fold.leg);
    let (crank, rod) = (fold.crank, fold.rod);
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
    legs[fold.leg.index()] = LegClosure {
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
pub(crate) fn cover<T: Scalar, const D: usize>(fold: &Fold, leg: &LegClosure<T, D>) -> ArrayVec<T, 4> {
    let constant = |c: Interval| T::constant(c);
    let bend = sum_of_squares(&leg.span) - constant(fold.crank.square() + fold.rod.square());
    let b = Interval::point(2.0 * fold.half_width) * fold.crank * fold.rod;
    let mut margins: ArrayVec<T, 4> = [-bend, constant(b.square()) - leg.closure.reach].into_iter().collect();
    if let Some((lo, hi)) = fold.axial {
        let height = leg.span[D - 1];
        margins.push(height - constant(fold.rod * Interval::point(lo)));
        margins.push(constant(fold.rod * Interval::point(hi)) - height);
    }
    margins
}

/// The folds of a robot that need a chart of their own, each with a chart small enough to be disjoint from
/// the others; legs whose folds cannot be told apart get none.
///
/// A fold is charted if the platform's translations are free in `window` and C can come onto the crank's
/// axis, or so near (|L − M| below a twentieth of L + M in the plane) that the pose would need very small
/// boxes.
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

/// A fold and where in the leg's frame it is: within `radius` of (0, 0, `height`).
struct Place {
    fold: Fold,
    height: f64,
    radius: f64,
}

impl Place {
    /// The folds of a leg, charted to about `size` cranks from the axis.
    fn of_leg(robot: &Robot, leg: usize, size: f64) -> Vec<Self> {
        let Some(&Revolute { crank, rod }) = robot.legs[leg].actuator.as_revolute() else {
            return Vec::new();
        };
        let (l, m) = (crank.mid(), rod.mid());
        let p = size * l / m;
        if robot.platform.space() == 2 {
            // d² = L² + M² − 2LM √(1 − p²) at most.
            let radius = (l * l + m * m - 2.0 * l * m * (1.0 - p * p).max(0.0).sqrt()).sqrt();
            let near = (l - m).abs() < 0.05 * (l + m) && p < 0.9;
            let fold = Fold { leg: LegIndex::new(leg), crank, rod, half_width: p, axial: None };
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
            Self {
                fold: Fold { leg: LegIndex::new(leg), crank, rod, half_width: p, axial: Some((lo, hi)) },
                height,
                radius,
            }
        };
        ranges.into_iter().map(place).collect()
    }

    /// Whether no pose is in both charts, by the triangle inequality; the twentieth to spare is far beyond
    /// rounding.
    fn is_apart_from(&self, other: &Self, robot: &Robot, window: &Window) -> bool {
        let centre = |place: &Self| {
            let leg = robot.leg(place.fold.leg);
            std::array::from_fn::<f64, 3, _>(|k| leg.anchor[k].mid() + place.height * leg.frame[2][k].mid())
        };
        let still: Vec<f64> = window.ranges.iter().map(|r| r.0).collect();
        let arm = |place: &Self| -> [f64; 3] {
            let leg = robot.leg(place.fold.leg);
            match robot.platform {
                Platform::FreeBody => Placement::<f64, 3>::at(robot.platform, &still).arm(leg),
                Platform::PlanePoint
                | Platform::PlaneBody
                | Platform::TranslatingBody
                | Platform::TurningBody => leg.attachment.map(|c| c.mid()),
            }
        };
        let between = |a: [f64; 3], b: [f64; 3]| std::array::from_fn::<f64, 3, _>(|k| a[k] - b[k]);
        let norm = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let (base, body) = (between(centre(self), centre(other)), between(arm(self), arm(other)));
        let distance = match robot.platform {
            Platform::PlaneBody => (norm(base) - norm(body)).abs(),
            Platform::PlanePoint | Platform::TranslatingBody | Platform::TurningBody | Platform::FreeBody => {
                norm(between(base, body))
            }
        };
        distance > 1.05 * (self.radius + other.radius)
    }
}
