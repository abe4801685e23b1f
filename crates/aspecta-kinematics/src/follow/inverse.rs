//! The inverse problem along a stream of poses.

use super::refusal::{Refusal, StartError};
use super::{Padded, between, check_numbers, in_stretches, unpadded};
use crate::constraints::within_limits;
use crate::modal::{ModalRows, closures};
use crate::placement::Placement;
use crate::{Kinematics, WorkingMode, for_platform};
use aspecta_robot::legs::Drive;
use aspecta_robot::num::{Interval, Scalar, each, padded, turned_to};
use aspecta_robot::{LegIndex, Robot};

/// Follows the inverse solution of one working mode: given the next pose, the joint vector in the same mode, certified,
/// with angles that go on past ±π without a jump. See [`super`] for the theorem.
///
/// # Examples
/// ```
/// use aspecta_kinematics::follow::InverseFollower;
/// use aspecta_robot::catalogue;
///
/// let robot = catalogue::find("five-bar").unwrap();
/// let mut follower = InverseFollower::new(&robot, &[4.0, 7.0], "+-".parse().unwrap()).unwrap();
/// let step = follower.step(&[4.1, 7.1])?;
/// assert_eq!(step.q().len(), 2);
/// // Beyond the reach of leg 2 no step is taken.
/// assert!(follower.step(&[4.0, 14.0]).is_err());
/// assert_eq!(follower.pose(), [4.1, 7.1]);
/// # Ok::<(), aspecta_kinematics::follow::Refusal>(())
/// ```
#[derive(Clone, Debug)]
pub struct InverseFollower {
    robot: Robot,
    mode: WorkingMode,
    pose: Padded,
    q: Padded,
}

/// A certified inverse step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointStep {
    q: Padded,
    dof: usize,
    /// Whether it is proved that det A does not vanish along the step either: the configuration stayed in its
    /// generalized aspect. Else the path may have met a parallel singularity.
    pub regular: bool,
    /// Whether, at the end, every joint is within its limits and the pose in the robot's window. Numerical.
    pub within_limits: bool,
    /// Stretches that were tried: 1 where the step was proved at once.
    pub stretches: u32,
}

impl JointStep {
    /// q; angles in rad, continuous.
    pub fn q(&self) -> &[f64] {
        &self.q[..self.dof]
    }
}

impl InverseFollower {
    /// Starts at `pose` in `mode`, angles in (−π, π].
    ///
    /// # Errors
    /// [`StartError`] if the pose or the mode does not fit the robot, or if a leg is not proved to close strictly.
    pub fn new(robot: &Robot, pose: &[f64], mode: WorkingMode) -> Result<Self, StartError> {
        let legs = robot.leg_solutions(pose)?;
        if !robot.working_modes().contains(&mode) {
            return Err(StartError::Mode { mode });
        }
        if let Some(j) = legs.iter().position(|leg| !leg.certified) {
            return Err(StartError::OutOfReach { leg: LegIndex::new(j) });
        }
        let mut q = [0.0; 6];
        for (j, leg) in legs.iter().enumerate() {
            q[j] = leg.q[usize::from(mode.sign(j) < 0)].unwrap_or_default();
        }
        Ok(Self { robot: robot.clone(), mode, pose: padded(pose), q })
    }

    /// The robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// X, of the last good step.
    pub fn pose(&self) -> &[f64] {
        &self.pose[..self.robot.dof()]
    }

    /// q, of the last good step.
    pub fn q(&self) -> &[f64] {
        &self.q[..self.robot.dof()]
    }

    /// The working mode.
    pub fn mode(&self) -> WorkingMode {
        self.mode
    }

    /// Goes on to `pose` along a straight segment in pose coordinates. That no leg meets a serial singularity on
    /// it is proved, and so are the turns of the angles; the digits of q are those of doubles.
    ///
    /// At most 64 stretches are tried, and 64 more where those do not tell whether det A keeps its sign, each one evaluation of the inverse
    /// model in intervals. Nothing is allocated.
    ///
    /// # Errors
    /// [`Refusal`]; the state is then as before.
    pub fn step(&mut self, pose: &[f64]) -> Result<JointStep, Refusal> {
        check_numbers(&self.robot, pose)?;
        for_platform!(self.robot.platform, advance(self, pose))
    }
}

fn advance<const D: usize, const N: usize>(
    follower: &mut InverseFollower,
    pose: &[f64],
) -> Result<JointStep, Refusal> {
    let (robot, mode) = (&follower.robot, follower.mode);
    let segment = Segment { start: unpadded::<N>(&follower.pose), goal: unpadded(&padded(pose)) };
    let mut q = unpadded::<N>(&follower.q);
    let (mut from, mut regular, mut open) = (0.0, true, 0);
    let (proved, stretches) =
        in_stretches(|to| match stretch::<D, N>(robot, mode, &segment.stretch(from, to)) {
            Err(leg) => {
                open = leg;
                false
            }
            Ok(kept) => {
                let next = joints::<D, N>(robot, mode, &segment.at(to));
                for (j, leg) in robot.legs.iter().enumerate().take(N) {
                    q[j] = if leg.actuator.is_angle() { turned_to(next[j], q[j]) } else { next[j] };
                }
                (from, regular) = (to, regular && kept);
                true
            }
        });
    if proved < 1.0 {
        return Err(refusal::<D, N>(robot, &segment, open, proved));
    }
    let regular = regular || keeps_det_sign::<D, N>(robot, mode, &segment);
    let within_limits = within_limits::<D, N>(robot, &segment.goal)(mode);
    (follower.pose, follower.q) = (padded(&segment.goal), padded(&q));
    Ok(JointStep { q: follower.q, dof: N, regular, within_limits, stretches })
}

/// Whether det A is proved to keep its sign along the segment, in stretches that may be shorter than those the legs need.
fn keeps_det_sign<const D: usize, const N: usize>(
    robot: &Robot,
    mode: WorkingMode,
    segment: &Segment<N>,
) -> bool {
    let mut from = 0.0;
    let (proved, _) = in_stretches(|to| {
        let kept = stretch::<D, N>(robot, mode, &segment.stretch(from, to)) == Ok(true);
        if kept {
            from = to;
        }
        kept
    });
    proved == 1.0
}

/// Poses X₀ + t (X₁ − X₀).
struct Segment<const N: usize> {
    start: [f64; N],
    goal: [f64; N],
}

impl<const N: usize> Segment<N> {
    /// In doubles; exact at both ends.
    fn at(&self, t: f64) -> [f64; N] {
        between(&self.start, &self.goal, t)
    }

    /// A box round the part t ∈ [from, to].
    fn stretch(&self, from: f64, to: f64) -> [Interval; N] {
        let (range, point) = (Interval::new(from, to), Interval::point);
        each!(|k| point(self.start[k]) + range * (point(self.goal[k]) - point(self.start[k])))
    }
}

/// Proves that all legs close strictly over `region` and that no joint turns by π in it: `Ok`, with whether det A keeps
/// its sign as well. Else `Err`, with a leg (from 0) for which there is no proof.
fn stretch<const D: usize, const N: usize>(
    robot: &Robot,
    mode: WorkingMode,
    region: &[Interval; N],
) -> Result<bool, usize> {
    // Below π, with room for the rounding of the ends.
    const MOST_TURN: f64 = 3.0;
    let legs = closures::<_, D, N>(robot, &Placement::at(robot.platform, region));
    for (j, at) in legs.iter().enumerate() {
        if !at.closure.reach.is_positive() {
            return Err(j);
        }
        if let Drive::Angle { cos, sin, .. } = at.drive(&robot.legs[j], mode.sign(j))
            && !Interval::angle(cos, sin).is_some_and(|angle| angle.width() < MOST_TURN)
        {
            return Err(j);
        }
    }
    let heights: [Interval; N] = each!(|j| legs[j].closure.reach.sqrt());
    Ok(ModalRows::<_, N>::new(robot, &legs, &heights).det(mode).sign() != 0)
}

/// The joint vector of a pose in reach, angles in (−π, π].
fn joints<const D: usize, const N: usize>(robot: &Robot, mode: WorkingMode, pose: &[f64; N]) -> [f64; N] {
    let legs = closures::<f64, D, N>(robot, &Placement::at(robot.platform, pose));
    std::array::from_fn(|j| legs[j].drive(&robot.legs[j], mode.sign(j)).value())
}

/// Why there is no proof beyond t = `proved`, where `leg` (from 0) is in doubt: H, which is mostly linear where it
/// vanishes, is extrapolated. Numerical.
fn refusal<const D: usize, const N: usize>(
    robot: &Robot,
    segment: &Segment<N>,
    leg: usize,
    proved: f64,
) -> Refusal {
    const APART: f64 = 1e-6;
    let reach = |t: f64| {
        closures::<f64, D, N>(robot, &Placement::at(robot.platform, &segment.at(t)))[leg].closure.reach
    };
    let most = robot.legs[leg]
        .actuator
        .greatest_reach()
        .map_or_else(|| robot.characteristic_length().powi(2), Interval::mid);
    let here = reach(proved);
    let distance = (here.max(0.0) / most).sqrt();
    let rate = (reach(proved + APART) - here) / APART;
    let singular_at = proved - here / rate;
    if singular_at >= proved && singular_at <= proved + 1.0 {
        Refusal::Serial { leg: LegIndex::new(leg), proved, singular_at, distance }
    } else {
        Refusal::TooLong { proved, distance }
    }
}
