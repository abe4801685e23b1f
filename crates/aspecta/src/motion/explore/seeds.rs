//! Poses of joint vectors drawn within the limits of the actuators: where joint limits leave little, poses drawn at random hit nothing, but every
//! direct solution is within the limits of the driven joints.

use super::body::Pose;
use crate::aspect::DetSign;
use crate::kinematics::WorkingMode;
use crate::num::{Random, padded};
use crate::paving::Control;
use crate::robot::{Leg, Limit, Robot};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Joint vectors drawn.
const DRAWS: u64 = 4096;

/// A pose and the class it seems to lie in.
type Seed = (WorkingMode, DetSign, Pose);

/// Direct solutions of random joint vectors.
pub(super) struct Seeds(Vec<Seed>);

impl Seeds {
    /// None if nothing bounds a driven length.
    pub fn draw(robot: &Robot, control: &Control<'_>) -> Self {
        let Some(ranges) = robot.legs.iter().map(range).collect::<Option<Vec<_>>>() else {
            return Self(Vec::new());
        };
        let of = |draw: u64| {
            if control.is_cancelled() {
                return Vec::new();
            }
            let random = &mut Random::of(&[draw, DRAWS]);
            let q: Vec<f64> = ranges.iter().map(|&range| random.within(range)).collect();
            let Ok(found) = robot.direct(&q) else { return Vec::new() };
            let sign = |det: f64| if det > 0.0 { DetSign::Positive } else { DetSign::Negative };
            found.iter().map(|s| (s.mode, sign(s.det_a), padded(&s.pose))).collect()
        };
        Self((0..DRAWS).into_par_iter().flat_map_iter(of).collect())
    }

    /// Those that seem to lie in a class.
    pub fn of(&self, mode: WorkingMode, det_a: DetSign) -> impl Iterator<Item = Pose> {
        self.0.iter().filter(move |seed| (seed.0, seed.1) == (mode, det_a)).map(|seed| seed.2)
    }
}

/// What a joint may be driven to: rad, or length units.
fn range(leg: &Leg) -> Option<(f64, f64)> {
    if !leg.actuator.is_angle() {
        return leg.length_range().map(|(min, max)| (min.lo, max.hi));
    }
    let limited = leg.limits.iter().find_map(|limit| match limit {
        Limit::ActuatorAngle { middle: (cos, sin), half_cos } => {
            let (middle, half) = (sin.mid().atan2(cos.mid()), half_cos.mid().acos());
            Some((middle - half, middle + half))
        }
        _ => None,
    });
    Some(limited.unwrap_or((-PI, PI)))
}
