//! A motion through working modes: as it is driven, checked once more, and ready to be timed.

use super::between;
use super::crossing::Crossing;
use super::plan::Plan;
use super::time::{Piece, Waypoint};
use super::{Joined, PathCheck, PathError, PathOptions, check_poses};
use aspecta_kinematics::Kinematics;
use aspecta_kinematics::path::go_on_from;
use aspecta_robot::{Robot, WorkingMode};
use serde::Serialize;

/// A motion through several working modes without a parallel singularity.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct Route {
    /// The motions within one mode, each proved. Each but the last ends at [`Crossing::inside`] of the crossing that follows.
    pub stretches: Vec<Plan>,
    /// The crossings between them: from `inside` to `pose`, and back to `inside` in the other posture.
    pub crossings: Vec<Crossing>,
}

/// Samples of a segment, and of each half of a crossing.
const SAMPLES: usize = 100;

impl From<Plan> for Route {
    /// A motion within one mode.
    fn from(plan: Plan) -> Self {
        Self { stretches: vec![plan], crossings: Vec::new() }
    }
}

impl Plan {
    /// Checks the waypoints once more, by what knows nothing of how they were planned.
    ///
    /// # Errors
    /// None of a plan as it was made: [`PathError`] if its waypoints were changed into what is no path of the robot.
    pub fn check(&self) -> Result<PathCheck, PathError> {
        let options = PathOptions { joined: Joined::Straight, margins: self.margins };
        check_poses(&self.robot, &self.waypoints, self.mode, &options)
    }
}

impl Route {
    /// Checks each stretch.
    ///
    /// # Errors
    /// As [`Plan::check`].
    pub fn checks(&self) -> Result<Vec<PathCheck>, PathError> {
        self.stretches.iter().map(Plan::check).collect()
    }

    /// Whether its checks prove every stretch, and each crossing is proved anew.
    pub fn is_proved(&self, checks: &[PathCheck]) -> bool {
        let crossed = |(crossing, plan): (&Crossing, &Plan)| crossing.is_proved(&plan.robot, plan.margins);
        checks.len() == self.stretches.len()
            && self.crossings.len() + 1 == self.stretches.len()
            && checks.iter().all(PathCheck::is_sound)
            && self.crossings.iter().zip(&self.stretches).all(crossed)
    }

    /// Returns the stretches as they are driven: the mode and the poses of each, with the way from the crossing before it and to that behind it.
    pub fn driven(&self) -> Vec<(WorkingMode, Vec<Vec<f64>>)> {
        let mut all = Vec::new();
        for (k, stretch) in self.stretches.iter().enumerate() {
            let before =
                k.checked_sub(1).and_then(|k| self.crossings.get(k)).map(|crossing| crossing.pose.clone());
            let after = self.crossings.get(k).map(|crossing| crossing.pose.clone());
            let poses = before.into_iter().chain(stretch.waypoints.iter().cloned()).chain(after);
            all.push((stretch.mode, poses.collect()));
        }
        all
    }

    /// The motion ready for [`trajectory`](super::time::trajectory): a piece a segment, and one for each crossing with the way there and back, on which
    /// the joints go on smoothly while the platform turns round. Numerical: the crossing leg's joint is computed in doubles.
    pub fn pieces(&self, robot: &Robot) -> Vec<Piece> {
        let mut pieces = Vec::new();
        for (k, stretch) in self.stretches.iter().enumerate() {
            for ends in stretch.waypoints.windows(2) {
                let segment = (0..=SAMPLES)
                    .map(|i| (between(&ends[0], &ends[1], i as f64 / SAMPLES as f64), stretch.mode));
                pieces.push(segment.collect());
            }
            if let Some(crossing) = self.crossings.get(k) {
                pieces.push(crossing.samples(stretch.mode));
            }
        }
        let mut last: Option<Vec<f64>> = None;
        let mut piece = |samples: Vec<(Vec<f64>, WorkingMode)>| {
            let mut waypoints = Vec::new();
            for (pose, mode) in samples {
                let Some(mut q) = robot.inverse_in(&pose, mode).ok().flatten() else { continue };
                if let Some(last) = &last {
                    go_on_from(robot, last, &mut q);
                }
                last = Some(q.clone());
                waypoints.push(Waypoint { pose, q, mode });
            }
            Piece { samples: waypoints }
        };
        pieces.into_iter().map(&mut piece).filter(|piece| piece.samples.len() > 1).collect()
    }
}

impl Crossing {
    /// Returns the samples to the singularity in `mode` and back in the other. The leg's joint goes like the root of the distance left, so its samples
    /// are even in that root.
    fn samples(&self, mode: WorkingMode) -> Vec<(Vec<f64>, WorkingMode)> {
        let other = mode.with_other_posture(self.leg);
        let sample = |i: usize| {
            let u = 1.0 - i as f64 / SAMPLES as f64;
            (between(&self.inside, &self.pose, 1.0 - u * u), if u >= 0.0 { mode } else { other })
        };
        (0..=2 * SAMPLES).map(sample).collect()
    }
}
