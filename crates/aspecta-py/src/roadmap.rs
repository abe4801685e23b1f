//! Roadmaps of free bodies, and cusps.

use crate::analysis::{Planned, Wanted, plan_options, planned};
use crate::error;
use crate::robot::Robot;
use crate::watch::{watched, watched_within};
use aspecta::kinematics::cusps::cusp_curves;
use aspecta::motion::explore::{self as roadmap, NoWay};
use aspecta::{CuspOptions, Effort, Kinematics, LegIndex};
use pyo3::prelude::*;
use std::sync::Arc;

/// The classes of a free body, explored: JSON.
#[pyfunction]
pub fn explore(
    py: Python<'_>,
    robot: &Robot,
    modes: Vec<String>,
    effort: (usize, Option<f64>),
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Py<PyAny>> {
    let modes = modes.iter().map(|mode| robot.mode(mode)).collect::<PyResult<Vec<_>>>()?;
    let (robot, effort) = (Arc::clone(&robot.robot), Effort { samples: effort.0, seconds: effort.1 });
    let found =
        watched(py, progress.as_ref(), move |control| roadmap::explore(&robot, &modes, &effort, control))?;
    found.or_partial(py, |found| error::json(&found.map_err(error::of)?))
}

/// Which direct solutions of a joint vector of a free body are joined by proved motions: JSON.
#[pyfunction]
pub fn join_solutions(
    py: Python<'_>,
    robot: &Robot,
    q: Vec<f64>,
    effort: (usize, Option<f64>),
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Py<PyAny>> {
    let (robot, effort) = (Arc::clone(&robot.robot), Effort { samples: effort.0, seconds: effort.1 });
    let found = watched(py, progress.as_ref(), move |control| {
        let found = robot.direct_certified(&q)?;
        Ok::<_, aspecta::Error>(roadmap::join_solutions(&robot, &q, found, &effort, control)?)
    })?;
    found.or_partial(py, |found| error::json(&found.map_err(error::of)?))
}

/// A motion of a free body over a roadmap.
#[pyfunction]
pub fn plan_over_roadmap(
    py: Python<'_>,
    robot: &Robot,
    ends: [Vec<f64>; 2],
    mode: &str,
    wanted: Wanted,
    effort: (usize, Option<f64>),
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Planned> {
    let (mode, options) = (robot.mode(mode)?, plan_options(wanted));
    let (robot, effort) = (Arc::clone(&robot.robot), Effort { samples: effort.0, seconds: effort.1 });
    let found = watched(py, progress.as_ref(), move |control| {
        roadmap::plan(&robot, [&ends[0], &ends[1]], mode, &options, &effort, control)
    })?;
    match found.whole()? {
        Ok(plan) => planned(&plan.into()),
        Err(NoWay::Refused(refusal)) => Err(error::no_plan(py, &refusal.into())),
        Err(NoWay::Robot(refusal)) => Err(error::of(refusal)),
    }
}

/// The cusps of a slice, or the curves of cusps of a whole robot: JSON.
#[pyfunction]
pub fn cusps(
    py: Python<'_>,
    robot: &Robot,
    fix: Vec<(usize, f64)>,
    mode: Option<&str>,
    boxes: Option<u64>,
    seconds: Option<f64>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Py<PyAny>> {
    let usual = CuspOptions::default();
    let mode = mode.map(|mode| robot.mode(mode)).transpose()?;
    let fix = fix.into_iter().map(|(joint, value)| (LegIndex::new(joint), value)).collect();
    let options = CuspOptions { fix, mode, boxes: boxes.or(usual.boxes) };
    let robot = Arc::clone(&robot.robot);
    let found = watched_within(py, seconds, progress.as_ref(), move |control| {
        let curves = options.fix.is_empty() && robot.dof() == 3;
        Ok::<_, aspecta::Error>(if curves {
            serde_json::to_string(&cusp_curves(&robot, &options, control)?)?
        } else {
            serde_json::to_string(&aspecta::cusps(&robot, &options, control)?)?
        })
    })?;
    found.or_partial(py, |found| found.map_err(error::of))
}
