//! The positions of a robot's parts in a configuration.

use aspecta::kinematics::placement::Placement;
use aspecta::legs::Points;
use aspecta::num::Interval;
use aspecta::robot::{Leg, Platform, Robot};

/// A point of space; the third coordinate is 0 in the plane.
pub type Point = [f64; 3];

/// A robot in a configuration, as points in base coordinates.
#[derive(Clone, Debug)]
pub struct Skeleton {
    /// One entry a leg.
    pub legs: Vec<LegShape>,
    /// Origin of the platform frame.
    pub origin: Point,
    /// Its unit vectors.
    pub axes: [Point; 3],
    /// A typical length, for symbols.
    pub size: f64,
}

/// The positions of a leg's joints.
pub type LegShape = Points<f64, 3>;

impl Skeleton {
    /// The robot at (X, q).
    pub fn at(robot: &Robot, pose: &[f64], q: &[f64]) -> Self {
        let mut skeleton = if robot.platform.space() == 2 {
            skeleton::<2>(robot, pose, q)
        } else {
            skeleton::<3>(robot, pose, q)
        };
        let anchors: Vec<Point> = skeleton.points().collect();
        let spread = |k: usize| {
            let of = anchors.iter().map(|p| p[k]);
            of.clone().fold(f64::MIN, f64::max) - of.fold(f64::MAX, f64::min)
        };
        skeleton.size = (0..3).map(spread).fold(0.0, f64::max);
        skeleton
    }

    /// Returns all named points.
    pub fn points(&self) -> impl Iterator<Item = Point> {
        let leg = |l: &LegShape| {
            [Some(l.a), l.b, Some(l.c)].into_iter().chain(l.rail.into_iter().flatten().map(Some))
        };
        self.legs.iter().flat_map(leg).flatten().chain([self.origin])
    }

    /// Whether all C_i are one point: the platform is then drawn as a point.
    pub fn is_point(&self) -> bool {
        let c = self.legs[0].c;
        self.legs.iter().all(|l| l.c.iter().zip(c).all(|(x, y)| (x - y).abs() < 1e-9 * (1.0 + self.size)))
    }
}

fn skeleton<const D: usize>(robot: &Robot, pose: &[f64], q: &[f64]) -> Skeleton {
    let placement = Placement::<f64, D>::at(robot.platform, pose);
    let axes = std::array::from_fn(|k| {
        let unit = std::array::from_fn(|i| Interval::point(if i == k { 1.0 } else { 0.0 }));
        lift(placement.turned(&unit))
    });
    let legs: Vec<LegShape> = robot.legs.iter().zip(q).map(|(leg, &q)| shape(leg, &placement, q)).collect();
    let arm = lift(placement.arm(&robot.legs[0]));
    let origin = match robot.platform {
        Platform::TurningBody => [0.0; 3],
        _ => minus(legs[0].c, arm),
    };
    Skeleton { legs, origin, axes, size: 0.0 }
}

fn shape<const D: usize>(leg: &Leg, placement: &Placement<f64, D>, q: f64) -> LegShape {
    let arm = placement.arm(leg);
    leg.actuator.points(leg, &placement.span(leg, &arm), &arm, q).in_space()
}

fn lift<const D: usize>(v: [f64; D]) -> Point {
    std::array::from_fn(|k| v.get(k).copied().unwrap_or(0.0))
}

pub(crate) fn plus(a: Point, b: Point) -> Point {
    std::array::from_fn(|k| a[k] + b[k])
}

pub(crate) fn minus(a: Point, b: Point) -> Point {
    std::array::from_fn(|k| a[k] - b[k])
}

pub(crate) fn times(s: f64, a: Point) -> Point {
    a.map(|x| s * x)
}
