//! Paths: whether they are sound, and how fast they can be run through.

use crate::analysis::Piece;
use crate::error;
use crate::robot::Robot;
use crate::watch::watched;
use aspecta::kinematics::constraints::Margins;
use aspecta::kinematics::path::PathError;
use aspecta::motion::time::{self, JointLimits, Waypoint};
use aspecta::{Joined, PathCheck, PathOptions};
use pyo3::prelude::*;
use std::sync::Arc;

/// A check: its JSON, and its summary.
type Checked = (String, String);

/// How samples are joined, and the margins asked for.
type Asked<'a> = (&'a str, f64, f64);

fn options((joined, parallel, serial): Asked<'_>) -> PyResult<PathOptions> {
    let joined = match joined {
        "straight" => Joined::Straight,
        "spline" => Joined::Spline,
        "none" => Joined::None,
        other => {
            let known =
                "samples are joined straight, by a spline or not: \"straight\", \"spline\" or \"none\"";
            return Err(error::Error::new_err(format!("joined = \"{other}\": {known}")));
        }
    };
    Ok(PathOptions { joined, margins: Margins { parallel, serial } })
}

fn checked(
    py: Python<'_>,
    check: impl FnOnce() -> Result<PathCheck, PathError> + Send + 'static,
) -> PyResult<Checked> {
    let check = watched(py, None, move |_| check())?.whole()?.map_err(error::of)?;
    Ok((error::json(&check)?, check.to_string()))
}

/// Checks a path of poses in a mode.
#[pyfunction]
pub fn check_poses(
    py: Python<'_>,
    robot: &Robot,
    poses: Vec<Vec<f64>>,
    mode: &str,
    asked: Asked<'_>,
) -> PyResult<Checked> {
    let (mode, options, robot) = (robot.mode(mode)?, options(asked)?, Arc::clone(&robot.robot));
    checked(py, move || aspecta::check_poses(&robot, &poses, mode, &options))
}

/// Checks a path of joint vectors.
#[pyfunction]
pub fn check_joints(
    py: Python<'_>,
    robot: &Robot,
    joints: Vec<Vec<f64>>,
    start: Option<Vec<f64>>,
    asked: Asked<'_>,
) -> PyResult<Checked> {
    let (options, robot) = (options(asked)?, Arc::clone(&robot.robot));
    checked(py, move || aspecta::check_joints(&robot, &joints, start.as_deref(), &options))
}

/// The fastest motion through some pieces, as JSON, with so many rows a second.
#[pyfunction]
pub fn trajectory(
    py: Python<'_>,
    pieces: Vec<Piece>,
    speed: Vec<f64>,
    acceleration: Vec<f64>,
    rate: f64,
) -> PyResult<String> {
    let waypoints = |(modes, poses, joints): Piece| {
        let samples = modes
            .iter()
            .zip(poses)
            .zip(joints)
            .map(|((mode, pose), q)| Ok(Waypoint { mode: mode.parse().map_err(error::of)?, pose, q }));
        Ok(time::Piece { samples: samples.collect::<PyResult<_>>()? })
    };
    let pieces: Vec<time::Piece> = pieces.into_iter().map(waypoints).collect::<PyResult<_>>()?;
    let limits = JointLimits { speed, acceleration };
    let motion = py.detach(|| time::trajectory(&pieces, &limits)).map_err(error::of)?;
    if !motion.is_usable_rate(rate) {
        let seconds = motion.total_time();
        return Err(error::Error::new_err(format!(
            "rate = {rate}: give a positive number of rows a second, few enough for {seconds} s"
        )));
    }
    error::json(&motion.sampled(rate))
}
