//! Followers: one solution along a stream of joint vectors, or of poses.

use crate::error::{self, Error};
use crate::robot::Robot;
use aspecta::kinematics::follow::{JointStep, Refusal, Step};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

/// The refusal of a step, as the exception that says so.
fn refused(refusal: Refusal) -> PyErr {
    Error::new_err(refusal.to_string())
}

/// Follows one direct solution.
#[pyclass(module = "aspecta._native")]
pub struct Follower(aspecta::Follower);

/// A step: pose, mode, whether the mode is kept, limits, errors of length and angle, stretches.
type DirectStep<'py> = (Bound<'py, PyArray1<f64>>, String, bool, bool, f64, f64, u32);

#[pymethods]
impl Follower {
    #[new]
    fn new(robot: &Robot, pose: Vec<f64>, q: Vec<f64>) -> PyResult<Self> {
        aspecta::Follower::new(&robot.robot, &pose, &q).map(Self).map_err(error::of)
    }

    #[getter]
    fn pose(&self) -> Vec<f64> {
        self.0.pose().to_vec()
    }

    #[getter]
    fn q(&self) -> Vec<f64> {
        self.0.q().to_vec()
    }

    #[getter]
    fn mode(&self) -> String {
        self.0.mode().to_string()
    }

    fn step<'py>(&mut self, py: Python<'py>, q: PyReadonlyArray1<'py, f64>) -> PyResult<DirectStep<'py>> {
        let step: Step = self.0.step(q.as_slice()?).map_err(refused)?;
        let pose = PyArray1::from_slice(py, step.pose());
        let errors = (step.length_error, step.angle_error);
        Ok((
            pose,
            step.mode.to_string(),
            step.mode_kept,
            step.within_limits,
            errors.0,
            errors.1,
            step.stretches,
        ))
    }
}

/// Follows one inverse solution.
#[pyclass(module = "aspecta._native")]
pub struct InverseFollower(aspecta::InverseFollower);

#[pymethods]
impl InverseFollower {
    #[new]
    fn new(robot: &Robot, pose: Vec<f64>, mode: &str) -> PyResult<Self> {
        aspecta::InverseFollower::new(&robot.robot, &pose, robot.mode(mode)?).map(Self).map_err(error::of)
    }

    #[getter]
    fn pose(&self) -> Vec<f64> {
        self.0.pose().to_vec()
    }

    #[getter]
    fn q(&self) -> Vec<f64> {
        self.0.q().to_vec()
    }

    #[getter]
    fn mode(&self) -> String {
        self.0.mode().to_string()
    }

    /// A step: joint vector, whether det A keeps its sign, limits, stretches.
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        pose: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, bool, bool, u32)> {
        let step: JointStep = self.0.step(pose.as_slice()?).map_err(refused)?;
        Ok((PyArray1::from_slice(py, step.q()), step.regular, step.within_limits, step.stretches))
    }
}
