//! Which way three joints of a planar machine turn.

use super::bodies::{Beside, Line};
use aspecta_robot::num::Interval;
use aspecta_robot::{Body, BodyPair, Leg, LegIndex, Platform, Robot, WorkingMode};

/// On which side of a line through two joints a third is: left, if the joints follow one another counter-clockwise.
///
/// Links share joints, so that one and the same turn counts for several pairs of bodies; and of some the class itself says which way they go.
/// Two that contradict one another are one function with both signs: no enclosure of it tells that they are never both positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Turn {
    joints: [Joint; 3],
    left: bool,
}

/// A point of the machine; those that are always one have one name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Joint(Point);

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Point {
    Anchor(usize),
    Elbow(usize),
    Attachment(usize),
    OfPlatform(usize, usize),
    OfObstacle(usize, usize),
}

impl Turn {
    /// That the three are one after the other counter-clockwise, or not.
    pub fn new(mut joints: [Joint; 3], mut left: bool) -> Self {
        for (i, j) in [(0, 1), (1, 2), (0, 1)] {
            if joints[i] > joints[j] {
                joints.swap(i, j);
                left = !left;
            }
        }
        Self { joints, left }
    }

    /// The joints.
    pub fn joints(&self) -> &[Joint; 3] {
        &self.joints
    }

    /// Whether these, if they are its joints, go counter-clockwise.
    pub fn is_left(&self, joints: [Joint; 3]) -> Option<bool> {
        let asked = Self::new(joints, true);
        (asked.joints == self.joints).then_some(asked.left == self.left)
    }

    /// The turn that an end takes on this side of a line along a body; across it none.
    pub fn of(robot: &Robot, pair: &BodyPair, line: Line, end: usize) -> Option<Self> {
        let left = match line.side {
            Beside::Left => true,
            Beside::Right => false,
            Beside::Beyond | Beside::Before => return None,
        };
        let [from, to] = Joint::of(robot, pair.bodies[line.along]);
        Some(Self::new([from, to, Joint::of(robot, pair.bodies[1 - line.along])[end]], left))
    }

    /// Those that a working mode and a sign of det A fix, where that is 0 those of the mode alone: the elbows', as B_jj = −2 (B − A) × (C − B), and that
    /// of the two rods of a point in the plane, as det A = 4 (C − B_1) × (C − B_2).
    pub fn known(robot: &Robot, mode: WorkingMode, det: i8) -> impl Iterator<Item = Self> {
        let is_flat = robot.platform.space() == 2;
        let of_leg = move |j: usize| {
            let leg = LegIndex::new(j);
            let has_elbow = is_flat && robot.legs[j].actuator.as_revolute().is_some();
            let [anchor, elbow] = Joint::of(robot, Body::Crank(leg));
            let [_, end] = Joint::of(robot, Body::Rod(leg));
            has_elbow.then(|| Self::new([anchor, elbow, end], mode.sign(j) < 0))
        };
        let of_rods = (robot.platform == Platform::PlanePoint && det != 0).then(|| {
            let [first, second] = [0, 1].map(|j| Joint::of(robot, Body::Rod(LegIndex::new(j))));
            Self::new([second[0], second[1], first[0]], det > 0)
        });
        (0..robot.legs.len()).filter_map(of_leg).chain(of_rods)
    }
}

impl Joint {
    /// The joints at the ends of a body.
    pub fn of(robot: &Robot, body: Body) -> [Self; 2] {
        let first = |of: fn(&Leg) -> [Interval; 3], j: LegIndex| {
            robot.legs.iter().position(|leg| of(leg) == of(robot.leg(j))).unwrap_or(j.index())
        };
        let anchor = |j: LegIndex| Point::Anchor(first(|leg| leg.anchor, j));
        let attachment = |j: LegIndex| Point::Attachment(first(|leg| leg.attachment, j));
        let points = match body {
            Body::Crank(j) => [anchor(j), Point::Elbow(j.index())],
            Body::Rod(j) if robot.leg(j).actuator.rigid_rod().is_some() => {
                [Point::Elbow(j.index()), attachment(j)]
            }
            Body::Rod(j) => [anchor(j), attachment(j)],
            Body::Platform(number) => [0, 1].map(|end| Point::OfPlatform(number, end)),
            Body::Obstacle(number) => [0, 1].map(|end| Point::OfObstacle(number, end)),
        };
        points.map(Self)
    }
}
