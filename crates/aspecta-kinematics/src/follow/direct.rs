//! The direct problem along a stream of joint vectors.

use super::refusal::{BadInput, Refusal, StartError};
use super::tube::{Located, Model, plain};
use super::{Padded, between, check_numbers, in_stretches, unpadded};
use crate::constraints::within_limits;
use crate::path::units;
use crate::{KinematicsError, WorkingMode, for_platform};
use aspecta_robot::num::padded;
use aspecta_robot::{LegIndex, Robot};
use nalgebra::SMatrix;

/// Follows one direct solution: given the next joint vector, the pose on the same branch, certified. See [`super`] for the
/// theorem.
///
/// Angles are real numbers: q and the pose's angle φ go on past ±π without a jump, and a joint vector that jumps by a full turn is a full turn to
/// be made. (Of roll, pitch and yaw, roll and yaw do so as long as the pitch stays within ±π/2.)
///
/// # Examples
/// ```
/// use aspecta_kinematics::Kinematics;
/// use aspecta_kinematics::follow::Follower;
/// use aspecta_robot::catalogue;
///
/// let robot = catalogue::find("five-bar").unwrap();
/// let q = robot.inverse(&[4.0, 7.0]).unwrap()[0].q.clone();
/// let mut follower = Follower::new(&robot, &[4.0, 7.0], &q).unwrap();
/// for k in 1..=10 {
///     let step = follower.step(&[q[0] + 0.01 * f64::from(k), q[1]])?; // what the encoders say
///     assert!(step.mode_kept && step.length_error < 1e-9);
/// }
/// assert!((follower.pose()[0] - 4.0).abs() < 2.0);
/// # Ok::<(), aspecta_kinematics::follow::Refusal>(())
/// ```
#[derive(Clone, Debug)]
pub struct Follower {
    robot: Robot,
    /// The units in which displacements are of order one.
    unit: Padded,
    state: State,
}

/// The last good state.
#[derive(Clone, Copy, Debug)]
struct State {
    pose: Padded,
    q: Padded,
    radius: f64,
    inverse: [Padded; 6],
    mode: WorkingMode,
}

/// A certified step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    pose: Padded,
    dof: usize,
    /// The working mode at the end: the signs of B_jj. Proved if `mode_kept`, else numerical.
    pub mode: WorkingMode,
    /// Whether it is proved that no B_jj vanishes along the step either. Then the configuration stayed in its generalized
    /// aspect; else a leg may have met a serial singularity, which is no error here.
    pub mode_kept: bool,
    /// Whether, at the end, every joint is within its limits and the pose in the robot's window. Numerical.
    pub within_limits: bool,
    /// A proved bound of the error of each translation of `pose`, in the robot's unit.
    pub length_error: f64,
    /// A proved bound of the rotation, about each axis, by which the orientation of `pose` is off; rad.
    pub angle_error: f64,
    /// Stretches that were tried: 1 where the step was proved at once.
    pub stretches: u32,
}

impl Step {
    /// X, as [`aspecta_robot::Platform::coordinates`] orders it.
    pub fn pose(&self) -> &[f64] {
        &self.pose[..self.dof]
    }
}

impl Follower {
    /// Starts at the direct solution of `q` that `pose` means: it is proved to be the only one in a box that holds both
    /// it and `pose`.
    ///
    /// # Errors
    /// [`StartError`] if the vectors do not fit the robot, or if there is no such proof.
    pub fn new(robot: &Robot, pose: &[f64], q: &[f64]) -> Result<Self, StartError> {
        crate::check_pose(robot, pose)?;
        crate::check_joints(robot, q)?;
        if let Some(j) = short_strut(robot, q) {
            return Err(KinematicsError::StrutLength { leg: LegIndex::new(j), value: q[j] }.into());
        }
        let unit = units(robot);
        let state =
            for_platform!(robot.platform, start(robot, &unit, pose, q)).ok_or(StartError::NoSolution)?;
        Ok(Self { robot: robot.clone(), unit, state })
    }

    /// The robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// X, of the last good step.
    pub fn pose(&self) -> &[f64] {
        &self.state.pose[..self.robot.dof()]
    }

    /// q, of the last good step.
    pub fn q(&self) -> &[f64] {
        &self.state.q[..self.robot.dof()]
    }

    /// The working mode there.
    pub fn mode(&self) -> WorkingMode {
        self.state.mode
    }

    /// Goes on to the joint vector `q`. The pose returned is proved to be where the solution curve of the straight segment
    /// from the last joint vector to `q` ends; the curve exists, is unique, and meets no parallel singularity.
    ///
    /// At most 64 stretches are tried, each by a Newton iteration and one evaluation of the equations and their derivatives over
    /// enclosures. Nothing is allocated.
    ///
    /// # Errors
    /// [`Refusal`]; the state is then as before.
    pub fn step(&mut self, q: &[f64]) -> Result<Step, Refusal> {
        check_joints(&self.robot, q)?;
        for_platform!(self.robot.platform, advance(self, q))
    }

    /// Returns the model that proofs look at, and the last good state.
    pub(super) fn model_and_state<const D: usize, const N: usize>(&self) -> (Model<'_, D, N>, Located<N>) {
        (Model::new(&self.robot, &self.unit), self.state.located())
    }

    pub(super) fn set_state<const N: usize>(&mut self, at: &Located<N>, mode: WorkingMode) {
        self.state = State::of(at, mode);
    }
}

/// Whether a joint vector can be used.
pub(super) fn check_joints(robot: &Robot, q: &[f64]) -> Result<(), BadInput> {
    check_numbers(robot, q)?;
    match short_strut(robot, q) {
        Some(j) => Err(BadInput::StrutLength { leg: LegIndex::new(j), value: q[j] }),
        None => Ok(()),
    }
}

/// A strut whose length is not positive.
fn short_strut(robot: &Robot, q: &[f64]) -> Option<usize> {
    robot.legs.iter().zip(q).position(|(leg, q)| leg.actuator.forbids(*q))
}

fn start<const D: usize, const N: usize>(
    robot: &Robot,
    unit: &Padded,
    pose: &[f64],
    q: &[f64],
) -> Option<State> {
    let model = Model::<D, N>::new(robot, unit);
    let (pose, q) = (unpadded(&padded(pose)), unpadded(&padded(q)));
    let inverse = model.linearised(&pose, &q, &plain(&model.turns(&q))).1.try_inverse()?;
    let proof = model.prove_alone(&Located { pose, q, radius: 0.0, inverse })?;
    Some(State::of(&proof.end, model.mode(&proof)))
}

fn advance<const D: usize, const N: usize>(follower: &mut Follower, q: &[f64]) -> Result<Step, Refusal> {
    let (model, start) = follower.model_and_state::<D, N>();
    let goal = unpadded::<N>(&padded(q));
    // What rounding may move the joint vectors between stretches by: at most 2.5 ε max |q|.
    let slack: [f64; N] = std::array::from_fn(|j| 4.0 * f64::EPSILON * start.q[j].abs().max(goal[j].abs()));
    let (mut last, mut mode, mut mode_kept) = (start, follower.state.mode, true);
    let mut careful = false;
    let (proved, stretches) = in_stretches(|to| {
        let q = between(&start.q, &goal, to);
        let quick = if careful { None } else { model.prove(&last, &q, &slack) };
        careful = quick.is_none();
        let Some(proof) = quick.or_else(|| model.prove_carefully(&last, &q, &slack)) else { return false };
        mode_kept &= !proof.signs.contains(&0);
        mode = model.mode(&proof);
        last = proof.end;
        true
    });
    if proved < 1.0 {
        return Err(model.refusal(&last, &start.q, &goal, proved));
    }
    let within_limits = within_limits::<D, N>(&follower.robot, &last.pose)(mode);
    let [length_error, angle_error] = model.errors(&last);
    follower.state = State::of(&last, mode);
    Ok(Step {
        pose: follower.state.pose,
        dof: N,
        mode,
        mode_kept,
        within_limits,
        length_error,
        angle_error,
        stretches,
    })
}

impl State {
    fn of<const N: usize>(at: &Located<N>, mode: WorkingMode) -> Self {
        let inverse = std::array::from_fn(|i| {
            std::array::from_fn(|k| if i < N && k < N { at.inverse[(i, k)] } else { 0.0 })
        });
        Self { pose: padded(&at.pose), q: padded(&at.q), radius: at.radius, inverse, mode }
    }

    fn located<const N: usize>(&self) -> Located<N> {
        Located {
            pose: unpadded(&self.pose),
            q: unpadded(&self.q),
            radius: self.radius,
            inverse: SMatrix::from_fn(|i, k| self.inverse[i][k]),
        }
    }
}
