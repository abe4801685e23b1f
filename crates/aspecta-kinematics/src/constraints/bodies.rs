//! How far apart two bodies are.
//!
//! Bodies are segments with a radius, so that two of them are clear of one another where F − ρ² > 0, F being the square of the least distance
//! of the segments. In space that is smooth enough as it stands. In the plane it has corners, and P is made of smooth pieces of it
//! (docs/theory.md, 5): where the segments do not cross, F is the least of the distances of the four ends from the other segment; and that
//! they do not cross is said by a line that parts them. Of thin bodies this alone is asked.
//!
//! Functions are outlined: over the scalars of the paving each is thousands of instructions, and most bodies are far apart.

use super::LegAt;
use super::clearance::{Links, from_link};
use crate::modal::LegClosure;
use crate::placement::{Placement, out_of_frame};
use aspecta_robot::legs::sum_of_squares;
use aspecta_robot::num::{Interval, Scalar, TwoLinks, dot, dot_constant, each};
use aspecta_robot::{Body, BodyPair, LegIndex, Robot};
use std::ops::Range;

/// A part of what keeps two bodies apart, smooth where it counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// The distance of the bodies.
    Distance,
    /// That of an end from the other body: ends 0 and 1 are the first body's, 2 and 3 the second's.
    End(usize),
    /// On which side of a line the two ends of a body are: the line and the ends, 0 and 1 of the one body or of the other.
    Side(Line, usize),
}

/// A line that may part two bodies: one along a body, on this or that side of it, or across it at this or that end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Line {
    /// Whose it is: 0 or 1.
    pub along: usize,
    /// On which side of it the other body is.
    pub side: Beside,
}

/// A side of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beside {
    /// Left of it.
    Left,
    /// Right of it.
    Right,
    /// Beyond its second end.
    Beyond,
    /// Before its first end.
    Before,
}

impl Line {
    /// All of them. Two segments that do not touch are parted by one.
    pub fn all() -> impl Iterator<Item = Self> {
        let sides = [Beside::Left, Beside::Right, Beside::Beyond, Beside::Before];
        (0..2).flat_map(move |along| sides.into_iter().map(move |side| Self { along, side }))
    }
}

impl Feature {
    /// The distances of which the least counts.
    pub fn distances(robot: &Robot, pair: &BodyPair) -> impl Iterator<Item = Self> {
        let whole = (robot.platform.space() == 3 && robot.wall_of(pair).is_none()).then_some(Self::Distance);
        whole.into_iter().chain(ends(robot, pair).map(Self::End))
    }
}

/// The ends of two bodies of which the least distance from the other body counts, in the plane, and in space from a wall: of a body that is a point,
/// that alone.
fn ends(robot: &Robot, pair: &BodyPair) -> Range<usize> {
    if let Some((wall, ..)) = robot.wall_of(pair) {
        let first = 2 * (1 - wall);
        return first..first + if robot.is_point(pair.bodies[1 - wall]) { 1 } else { 2 };
    }
    match pair.bodies.iter().position(|body| robot.is_point(*body)) {
        _ if robot.platform.space() == 3 || pair.is_thin() => 0..0,
        Some(first) => 2 * first..2 * first + 1,
        None => 0..4,
    }
}

/// The axis of a body.
struct Axis<T, const D: usize> {
    from: [T; D],
    along: [T; D],
    /// Its length squared.
    square: T,
    /// Whether that is 0.
    is_point: bool,
}

impl<T: Scalar, const D: usize> Axis<T, D> {
    #[inline(never)]
    fn of(
        robot: &Robot,
        body: Body,
        placement: &Placement<T, D>,
        legs: &[LegClosure<T, D>],
        heights: &[T],
    ) -> Self {
        let link = |j: LegIndex| {
            let at = LegAt::of(robot.leg(j), &legs[j.index()]);
            let links = Links::of(&at, heights[j.index()]);
            let anchor: [T; D] = each!(|k| T::constant(at.leg.anchor[k]));
            (at.leg, links, anchor)
        };
        let fixed = || {
            let zero = [Interval::point(0.0); 3];
            let given = robot.capsule(body).and_then(|capsule| capsule.shape.ends());
            let [from, to] = given.unwrap_or([zero; 2]);
            let along: [Interval; 3] = std::array::from_fn(|k| to[k] - from[k]);
            (from, along, T::constant(dot(&along, &along)), from == to)
        };
        match body {
            Body::Crank(j) => {
                let (leg, links, from) = link(j);
                let square = links.crank_square(leg);
                Self { from, along: out_of_frame(leg, &links.crank), square, is_point: false }
            }
            Body::Rod(j) => {
                let (leg, links, anchor) = link(j);
                let crank = out_of_frame(leg, &links.crank);
                let from = match leg.actuator.rigid_rod() {
                    Some(_) => each!(|k| anchor[k] + crank[k]),
                    None => anchor,
                };
                let square = links.rod_square(leg);
                Self { from, along: out_of_frame(leg, &links.rod), square, is_point: false }
            }
            Body::Platform(_) => {
                let (from, along, square, is_point) = fixed();
                let (arm, origin) = (placement.turned(&from), placement.origin());
                let from = each!(|k| origin[k] + arm[k]);
                Self { from, along: placement.turned(&along), square, is_point }
            }
            Body::Obstacle(_) => {
                let (from, along, square, is_point) = fixed();
                let vector = |v: &[Interval; 3]| each!(|k| T::constant(v[k]));
                Self { from: vector(&from), along: vector(&along), square, is_point }
            }
        }
    }

    fn end(&self, which: usize) -> [T; D] {
        if which == 0 { self.from } else { each!(|k| self.from[k] + self.along[k]) }
    }
}

/// A pair of bodies in a configuration. The unit of all that is said of them is 1 ([`Configuration::unit`](super::Configuration::unit)).
pub struct TwoBodies<T, const D: usize> {
    axes: [Axis<T, D>; 2],
    distance: Interval,
    is_thin: bool,
    /// The unit vector out of the wall and its offset, if one is a wall; then its axis means nothing.
    wall: Option<([Interval; D], Interval)>,
    /// The ends of which the least distance counts, in the plane and from a wall.
    ends: Range<usize>,
}

impl<T: Scalar, const D: usize> TwoBodies<T, D> {
    /// With the legs at a pose, and s h of each.
    pub(super) fn of(
        robot: &Robot,
        pair: &BodyPair,
        placement: &Placement<T, D>,
        legs: &[LegClosure<T, D>],
        heights: &[T],
    ) -> Self {
        let axes = pair.bodies.map(|body| Axis::of(robot, body, placement, legs, heights));
        let wall = robot.wall_of(pair).map(|(_, normal, offset)| (each!(|k| normal[k]), offset));
        Self { axes, distance: pair.distance, is_thin: pair.is_thin(), wall, ends: ends(robot, pair) }
    }

    /// Positive just where they are clear of one another.
    #[inline(never)]
    pub fn margin(&self) -> T {
        if self.is_thin {
            let parted = |line: Line| self.side(line, 0).least(self.side(line, 1));
            let first = parted(Line { along: 0, side: Beside::Left });
            return Line::all().skip(1).fold(first, |greatest, line| greatest.greatest(parted(line)));
        }
        if self.wall.is_some() {
            let end = |end: usize| self.feature(Feature::End(end));
            let first = end(self.ends.start);
            return self.ends.clone().skip(1).fold(first, |least, other| least.least(end(other)));
        }
        // None of the pieces is less, but where links are nearly parallel they are enclosed better.
        self.ends
            .clone()
            .fold(self.feature(Feature::Distance), |least, end| least.least(self.feature(Feature::End(end))))
    }

    /// Positive only where they are clear of one another, as discs or balls round them show: it costs less than [`Self::margin`].
    #[inline(never)]
    pub fn margin_of_surroundings(&self) -> T {
        if self.wall.is_some() {
            return self.margin();
        }
        let [first, second] = &self.axes;
        let half = Interval::point(0.5);
        let between: [T; D] =
            each!(|k| first.from[k] - second.from[k] + (first.along[k] - second.along[k]).scale(half));
        let reach = (first.square.sqrt() + second.square.sqrt()).scale(half) + T::constant(self.distance);
        sum_of_squares(&between) - reach.square()
    }

    /// An end of one of the bodies, numbered as [`Feature::End`] is.
    pub fn end(&self, end: usize) -> [T; D] {
        self.axes[end / 2].end(end % 2)
    }

    /// One of its pieces.
    #[inline(never)]
    pub fn feature(&self, feature: Feature) -> T {
        let least = T::constant(self.distance.square());
        if let (Some((normal, offset)), Feature::End(end)) = (&self.wall, feature) {
            return dot_constant(normal, &self.end(end)) - T::constant(*offset + self.distance);
        }
        match feature {
            Feature::Distance => T::least_square(&self.links()) - least,
            Feature::End(end) => {
                let (point, other) = (self.end(end), &self.axes[1 - end / 2]);
                let away: [T; D] = each!(|k| point[k] - other.from[k]);
                let square = match other.is_point {
                    true => sum_of_squares(&away),
                    false => from_link(&away, &other.along, other.square),
                };
                square - least
            }
            Feature::Side(line, end) => self.side(line, end),
        }
    }

    /// How far an end of one body is on the side of a line along, or across, the other.
    #[inline(never)]
    fn side(&self, line: Line, end: usize) -> T {
        let (axis, point) = (&self.axes[line.along], self.axes[1 - line.along].end(end));
        let away: [T; D] = each!(|k| point[k] - axis.from[k]);
        let across = || axis.along[0] * away[1] - axis.along[1] * away[0];
        match line.side {
            Beside::Left => across(),
            Beside::Right => -across(),
            Beside::Beyond => dot(&axis.along, &away) - axis.square,
            Beside::Before => -dot(&axis.along, &away),
        }
    }

    fn links(&self) -> TwoLinks<T, D> {
        let [first, second] = &self.axes;
        let gap = each!(|k| first.from[k] - second.from[k]);
        TwoLinks { gap, first: first.along, second: second.along }
    }
}
