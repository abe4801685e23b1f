//! Poses of joint vectors drawn within the limits of the actuators: where joint limits leave little, poses
//! drawn at random hit nothing, but every direct solution is within the limits of the driven joints.

use super::body::Pose;
use crate::aspect::DetSign;
use aspecta_kinematics::Kinematics;
use aspecta_kinematics::{Solution, WorkingMode};
use aspecta_robot::num::{Random, padded};
use aspecta_robot::work;
use aspecta_robot::{Leg, Robot};
use std::f64::consts::PI;

/// Joint vectors drawn.
const DRAWS: u64 = 4096;

/// A pose and the class it seems to lie in.
type Seed = (WorkingMode, DetSign, Pose);

/// Direct solutions of random joint vectors.
pub(super) struct Seeds(Vec<Seed>);

impl Seeds {
    /// None if nothing bounds a driven length; fewer if `is_over` says so before the last.
    pub fn draw(robot: &Robot, is_over: impl Fn() -> bool + Sync) -> Self {
        let range = |leg: &Leg| leg.drive_range().or(leg.actuator.is_angle().then_some((-PI, PI)));
        let Some(ranges) = robot.legs.iter().map(range).collect::<Option<Vec<_>>>() else {
            return Self(Vec::new());
        };
        let of = |draw: u64| {
            let random = &mut Random::of(&[draw, DRAWS]);
            let q: Vec<f64> = ranges.iter().map(|&range| random.within(range)).collect();
            let found = if is_over() { None } else { robot.direct(&q).ok() };
            let seed = |s: &Solution| (s.mode, DetSign::of(s.det_a), padded(&s.pose));
            found.iter().flat_map(|found| found.iter()).map(seed).collect::<Vec<Seed>>()
        };
        Self(work::flat_map_range(DRAWS as usize, |draw| of(draw as u64)))
    }

    /// Returns the poses that seem to lie in a class.
    pub fn of(&self, mode: WorkingMode, det_a: DetSign) -> impl Iterator<Item = Pose> {
        self.0.iter().filter(move |seed| (seed.0, seed.1) == (mode, det_a)).map(|seed| seed.2)
    }
}
