//! Which way three joints of a planar machine turn.

use super::bodies::{Beside, Line};
use aspecta_robot::num::Interval;
use aspecta_robot::{Body, BodyPair, Leg, LegIndex, Platform, Robot, WorkingMode, is_one_point};

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
            (first[1] == second[1]).then(|| Self::new([second[0], second[1], first[0]], det > 0))
        });
        (0..robot.legs.len()).filter_map(of_leg).chain(of_rods.flatten())
    }
}

impl Joint {
    /// The joints at the ends of a body.
    pub fn of(robot: &Robot, body: Body) -> [Self; 2] {
        let first = |of: fn(&Leg) -> [Interval; 3], j: LegIndex| {
            let is_here = |leg: &Leg| is_one_point(&of(leg), &of(robot.leg(j)));
            robot.legs.iter().position(is_here).unwrap_or(j.index())
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kinematics;
    use aspecta_robot::catalogue;
    use aspecta_robot::num::Random;
    use nalgebra::DMatrix;

    /// Every joint of the legs and where it is: C by the pose, B, or A of a strut, by the row 2 (C − B) of A.
    fn places(robot: &Robot, pose: &[f64], q: &[f64]) -> Vec<(Joint, [f64; 2])> {
        let rows = robot.jacobians(pose, q).unwrap().a;
        let (sin, cos) = pose.get(2).copied().unwrap_or(0.0).sin_cos();
        let of_leg = |j: usize| {
            let (leg, [x, y, _]) = (LegIndex::new(j), robot.legs[j].attachment.map(Interval::mid));
            let c = [pose[0] + cos * x - sin * y, pose[1] + sin * x + cos * y];
            let b = [0, 1].map(|k| c[k] - 0.5 * rows[j][k]);
            let a = [0, 1].map(|k| robot.legs[j].anchor[k].mid());
            let (crank, rod) = (Joint::of(robot, Body::Crank(leg)), Joint::of(robot, Body::Rod(leg)));
            [(crank[0], a), (rod[0], b), (rod[1], c)]
        };
        (0..robot.dof()).flat_map(of_leg).collect()
    }

    /// What a class is said to fix is so in every configuration.
    #[test]
    fn known_turns_are_those_of_the_robot() {
        let random = &mut Random::new(14);
        let mut seen = 0;
        for name in ["five-bar", "2-prr", "3-rrr", "3-rpr"] {
            let mut robot = catalogue::find(name).unwrap();
            robot.legs.iter_mut().for_each(|leg| leg.limits.clear());
            for _ in 0..500 {
                let pose: Vec<f64> = (0..robot.dof()).map(|_| random.within((-12.0, 12.0))).collect();
                for found in robot.inverse(&pose).unwrap() {
                    let (places, rows) =
                        (places(&robot, &pose, &found.q), robot.jacobians(&pose, &found.q).unwrap().a);
                    let det = DMatrix::from_fn(robot.dof(), robot.dof(), |i, k| rows[i][k]).determinant();
                    let place = |joint: &Joint| places.iter().find(|(other, _)| other == joint).unwrap().1;
                    for turn in Turn::known(&robot, found.mode, if det > 0.0 { 1 } else { -1 }) {
                        let [a, b, c] = turn.joints().each_ref().map(place);
                        let across = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
                        let said = turn.is_left(*turn.joints()).unwrap();
                        assert!(across.abs() < 1e-9 || said == (across > 0.0), "{name} {pose:?} {turn:?}");
                        seen += 1;
                    }
                }
            }
        }
        assert!(seen > 1000, "{seen}");
    }

    /// Rods that end in two points say nothing by det A; and points known with a tolerance are two.
    #[test]
    fn joints_are_one_only_where_they_are() {
        let mode = "++".parse().unwrap();
        let known = |robot: &Robot| Turn::known(robot, mode, 1).count();
        let mut robot = catalogue::find("five-bar").unwrap();
        assert_eq!(known(&robot), 3);
        robot.legs[1].attachment[0] = Interval::point(0.5);
        assert_eq!(known(&robot), 2);
        let wide = Interval::new(-0.1, 0.1);
        robot.legs.iter_mut().for_each(|leg| leg.attachment[0] = wide);
        assert_eq!(known(&robot), 2);
        robot.legs.iter_mut().for_each(|leg| leg.anchor[0] = wide);
        let [first, second] = [0, 1].map(|j| Joint::of(&robot, Body::Crank(LegIndex::new(j)))[0]);
        assert_ne!(first, second);
    }
}
