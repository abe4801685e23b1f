//! The two geometric models of a robot and what is read off them, in one place.

use super::constraints::{self, Bound};
use super::{
    DirectSolutions, Jacobians, KinematicsError, LegSolutions, OutOfReach, Poses, Solution, State,
    check_joints, check_pose, direct, for_platform, inverse, jacobian, out_of_reach, singularity,
};
use aspecta_robot::{Robot, WorkingMode};

/// The inverse and the direct geometric model of a robot, its Jacobians and its singularities.
pub trait Kinematics {
    /// Returns all inverse solutions of `pose` within reach, one per working mode, in the order of
    /// [`Robot::working_modes`]; empty if the pose is out of reach. Solutions beyond joint limits are
    /// listed too, with `within_limits` false.
    ///
    /// *Certified* means: interval arithmetic proves H_j > 0 for every leg, so by the closed form
    /// ([`eliminate`](aspecta_robot::Actuator::eliminate)) exactly one configuration of each working mode exists here.
    ///
    /// # Errors
    /// [`KinematicsError`] if `pose` has the wrong length or is not finite.
    ///
    /// # Examples
    /// ```
    /// use aspecta_kinematics::Kinematics;
    /// use aspecta_robot::catalogue;
    ///
    /// let robot = catalogue::find("five-bar").unwrap();
    /// let solutions = robot.inverse(&[4.0, 7.0])?; // x, y
    /// let modes: Vec<String> = solutions.iter().map(|s| s.mode.to_string()).collect();
    /// assert_eq!(modes, ["++", "+-", "--", "-+"]);
    /// assert!(solutions.iter().all(|s| s.certified && s.residual < 1e-12));
    /// assert!(robot.inverse(&[40.0, 0.0])?.is_empty());
    /// # Ok::<(), aspecta_kinematics::KinematicsError>(())
    /// ```
    fn inverse(&self, pose: &[f64]) -> Result<Vec<Solution>, KinematicsError>;

    /// g_i(X) of (5): the joint vector of `pose` in `mode`, or `None` out of reach. Limits are not looked at.
    ///
    /// # Errors
    /// [`KinematicsError`] if `pose` has the wrong length or is not finite.
    ///
    /// # Examples
    /// ```
    /// use aspecta_kinematics::Kinematics;
    /// use aspecta_robot::catalogue;
    ///
    /// let robot = catalogue::find("five-bar").unwrap();
    /// let q = robot.inverse_in(&[4.0, 7.0], "+-".parse().unwrap())?.unwrap();
    /// assert_eq!(q.len(), 2); // rad
    /// assert!(robot.state(&[4.0, 7.0], &q)?.residual < 1e-12);
    /// # Ok::<(), aspecta_kinematics::KinematicsError>(())
    /// ```
    fn inverse_in(&self, pose: &[f64], mode: WorkingMode) -> Result<Option<Vec<f64>>, KinematicsError>;

    /// Returns the inverse solutions of each leg at `pose`.
    ///
    /// # Errors
    /// [`KinematicsError`] if `pose` has the wrong length or is not finite.
    ///
    /// # Examples
    /// ```
    /// use aspecta_kinematics::Kinematics;
    /// use aspecta_robot::catalogue;
    ///
    /// let robot = catalogue::find("five-bar").unwrap();
    /// let legs = robot.leg_solutions(&[4.0, 7.0])?;
    /// assert!(legs[0].certified && legs[0].reach > 0.0); // leg 1 closes, away from its serial singularity
    /// # Ok::<(), aspecta_kinematics::KinematicsError>(())
    /// ```
    fn leg_solutions(&self, pose: &[f64]) -> Result<Vec<LegSolutions>, KinematicsError>;

    /// The legs that have no inverse solution at `pose` (proved by intervals), limits not looked at.
    /// Empty exactly if [`Kinematics::inverse`] has solutions.
    ///
    /// # Errors
    /// [`KinematicsError`] if `pose` has the wrong length or is not finite.
    ///
    /// # Examples
    /// ```
    /// use aspecta_kinematics::Kinematics;
    /// use aspecta_robot::catalogue;
    ///
    /// let robot = catalogue::find("five-bar").unwrap();
    /// let beyond = robot.out_of_reach(&[15.0, 0.0])?; // leg 1 is 13 long at most
    /// assert_eq!(beyond[0].leg.number(), 1);
    /// assert!((beyond[0].gap - 2.0).abs() < 1e-12);
    /// # Ok::<(), aspecta_kinematics::KinematicsError>(())
    /// ```
    fn out_of_reach(&self, pose: &[f64]) -> Result<Vec<OutOfReach>, KinematicsError>;

    /// Returns all real poses X with f(X, q) = 0: the direct solutions of q in every working mode. Solutions
    /// beyond joint limits are listed too, with `within_limits` false.
    ///
    /// *Certified* means: there is a box round the pose in which the Krawczyk operator proves exactly one
    /// solution, for every q within a few units in the last place (for bodies that turn in space a ball in homogeneous coordinates, and a
    /// theorem of the same kind). Near a parallel singularity, where two
    /// solutions meet, that may not be possible; a pose whose leg equations hold to rounding is then returned once
    /// or twice, uncertified. [`Kinematics::direct_certified`] tells, too, whether the list is proved complete.
    ///
    /// # Errors
    /// [`KinematicsError`] if `q` has the wrong length or is not finite, if a strut's length is not positive, or if the
    /// solutions are infinitely many.
    ///
    /// # Examples
    /// ```
    /// use aspecta_kinematics::Kinematics;
    /// use aspecta_robot::catalogue;
    ///
    /// let robot = catalogue::find("five-bar").unwrap();
    /// let q = robot.inverse(&[4.0, 7.0])?[0].q.clone();
    /// let poses: Vec<Vec<f64>> = robot.direct(&q)?.into_iter().map(|s| s.pose).collect();
    /// assert_eq!(poses.len(), 2); // two circles
    /// assert!(poses.iter().any(|pose| (pose[0] - 4.0).abs() < 1e-9 && (pose[1] - 7.0).abs() < 1e-9));
    /// # Ok::<(), aspecta_kinematics::KinematicsError>(())
    /// ```
    fn direct(&self, q: &[f64]) -> Result<Vec<Solution>, KinematicsError>;

    /// [`Kinematics::direct`] with the proof that no solution is missing, where there is one.
    ///
    /// # Errors
    /// As [`Kinematics::direct`].
    ///
    /// # Examples
    /// ```
    /// use aspecta_kinematics::Kinematics;
    /// use aspecta_robot::catalogue;
    ///
    /// // The struts of Innocenti & Parenti-Castelli: six poses.
    /// let robot = catalogue::find("3-rpr").unwrap();
    /// let found = robot.direct_certified(&[14.98, 15.38, 12.0])?;
    /// assert_eq!((found.solutions.len(), found.complete), (6, true));
    /// # Ok::<(), aspecta_kinematics::KinematicsError>(())
    /// ```
    fn direct_certified(&self, q: &[f64]) -> Result<DirectSolutions, KinematicsError>;

    /// The poses of [`Kinematics::direct`] alone: no labels, no certificates, no allocation. For control loops.
    ///
    /// # Errors
    /// As [`Kinematics::direct`].
    fn direct_poses(&self, q: &[f64]) -> Result<Poses, KinematicsError>;

    /// A, B and the residual of the leg equations at (X, q), whether or not they hold there.
    ///
    /// # Errors
    /// [`KinematicsError`] if a vector has the wrong length or is not finite.
    ///
    /// # Examples
    /// ```
    /// use aspecta_kinematics::Kinematics;
    /// use aspecta_robot::catalogue;
    ///
    /// let robot = catalogue::find("five-bar").unwrap();
    /// let solution = &robot.inverse(&[4.0, 7.0])?[0];
    /// let jacobians = robot.jacobians(&solution.pose, &solution.q)?;
    /// assert_eq!(jacobians.det_a(), solution.det_a);
    /// assert_eq!(jacobians.mode(), solution.mode);
    /// # Ok::<(), aspecta_kinematics::KinematicsError>(())
    /// ```
    fn jacobians(&self, pose: &[f64], q: &[f64]) -> Result<Jacobians, KinematicsError>;

    /// The state of the configuration (`pose`, `q`). The two need not belong together: look at
    /// [`State::residual`].
    ///
    /// # Errors
    /// [`KinematicsError`] if `pose` or `q` has the wrong length or is not finite.
    ///
    /// # Examples
    /// ```
    /// use aspecta_kinematics::{Kinematics, LegIndex, Singularity};
    /// use aspecta_robot::catalogue;
    ///
    /// let robot = catalogue::find("five-bar").unwrap();
    /// let q = robot.inverse(&[4.0, 7.0])?[0].q.clone();
    /// let state = robot.state(&[4.0, 7.0], &q)?;
    /// assert_eq!(state.singularity, Singularity::Regular);
    /// assert!(state.parallel_measure > 0.1 && state.condition_a < 10.0);
    ///
    /// // Leg 1 stretched: Definition 4.
    /// let stretched = robot.inverse(&[13.0, 0.0])?[0].q.clone();
    /// assert_eq!(robot.state(&[13.0, 0.0], &stretched)?.serial_legs, [LegIndex::new(0)]);
    /// # Ok::<(), aspecta_kinematics::KinematicsError>(())
    /// ```
    fn state(&self, pose: &[f64], q: &[f64]) -> Result<State, KinematicsError>;

    /// What a configuration of a working mode goes beyond: joint limits, and the ends of the robot's window.
    /// None where `within_limits` is true.
    ///
    /// # Errors
    /// [`KinematicsError`] if `pose` has the wrong length or is not finite.
    ///
    /// # Examples
    /// ```
    /// use aspecta_kinematics::Kinematics;
    /// use aspecta_robot::catalogue;
    ///
    /// let robot = catalogue::find("2-prr").unwrap(); // its sliders go from 0 to 800
    /// let broken = robot.broken_limits(&[0.0, 100.0], "+-".parse().unwrap())?;
    /// let names: Vec<String> = broken.iter().map(|bound| bound.named(&robot)).collect();
    /// assert_eq!(names, ["actuator limit of leg 2"]);
    /// # Ok::<(), aspecta_kinematics::KinematicsError>(())
    /// ```
    fn broken_limits(&self, pose: &[f64], mode: WorkingMode) -> Result<Vec<Bound>, KinematicsError>;
}

impl Kinematics for Robot {
    fn inverse(&self, pose: &[f64]) -> Result<Vec<Solution>, KinematicsError> {
        inverse::inverse(self, pose)
    }

    fn inverse_in(&self, pose: &[f64], mode: WorkingMode) -> Result<Option<Vec<f64>>, KinematicsError> {
        inverse::inverse_in(self, pose, mode)
    }

    fn leg_solutions(&self, pose: &[f64]) -> Result<Vec<LegSolutions>, KinematicsError> {
        inverse::leg_solutions(self, pose)
    }

    fn out_of_reach(&self, pose: &[f64]) -> Result<Vec<OutOfReach>, KinematicsError> {
        out_of_reach::out_of_reach(self, pose)
    }

    fn direct(&self, q: &[f64]) -> Result<Vec<Solution>, KinematicsError> {
        direct::direct(self, q)
    }

    fn direct_certified(&self, q: &[f64]) -> Result<DirectSolutions, KinematicsError> {
        direct::direct_certified(self, q)
    }

    fn direct_poses(&self, q: &[f64]) -> Result<Poses, KinematicsError> {
        direct::direct_poses(self, q)
    }

    fn jacobians(&self, pose: &[f64], q: &[f64]) -> Result<Jacobians, KinematicsError> {
        check_pose(self, pose)?;
        check_joints(self, q)?;
        Ok(jacobians(self, pose, q))
    }

    fn state(&self, pose: &[f64], q: &[f64]) -> Result<State, KinematicsError> {
        singularity::state(self, pose, q)
    }

    fn broken_limits(&self, pose: &[f64], mode: WorkingMode) -> Result<Vec<Bound>, KinematicsError> {
        check_pose(self, pose)?;
        Ok(broken_limits(self, pose, mode))
    }
}

fn broken_limits(robot: &Robot, pose: &[f64], mode: WorkingMode) -> Vec<Bound> {
    use constraints::broken_limits;
    for_platform!(robot.platform, broken_limits(robot, pose, mode))
}

fn jacobians(robot: &Robot, pose: &[f64], q: &[f64]) -> Jacobians {
    use jacobian::jacobians;
    for_platform!(robot.platform, jacobians(robot, pose, q))
}
