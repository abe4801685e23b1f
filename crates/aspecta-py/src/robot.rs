//! Robots and what is asked of single configurations.

use crate::analysis::Analysis;
use crate::batch::{Columns, Parts, parts};
use crate::error;
use crate::threads;
use crate::watch::watched;
use aspecta::kinematics::{DirectSolutions, KinematicsError, start};
use aspecta::paving::Budget;
use aspecta::robot::work;
use aspecta::{Kinematics, Options, Purpose, Solution, WorkingMode};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

/// Rows that one thread solves before it looks for more.
const CHUNK: usize = 256;

/// A robot and the text it was read from.
#[pyclass(frozen, module = "aspecta._native")]
#[derive(Clone)]
pub struct Robot {
    pub robot: Arc<aspecta::Robot>,
    #[pyo3(get)]
    text: String,
}

#[pymethods]
impl Robot {
    /// The robot that a text describes; `file` is its name in messages.
    #[staticmethod]
    fn from_toml(text: String, file: &str) -> PyResult<Self> {
        let robot = Arc::new(aspecta::Robot::from_toml(&text, file).map_err(error::of)?);
        Ok(Self { robot, text })
    }

    /// The robot of the catalogue, or of a file.
    #[staticmethod]
    fn resolve(name_or_path: &str) -> PyResult<Self> {
        if let Some(entry) = aspecta::catalogue::all().iter().find(|entry| entry.name == name_or_path) {
            return Self::from_toml(entry.text.to_owned(), &format!("{name_or_path}.toml"));
        }
        // It knows what may be a file, how large one may be, and what is wrong with it.
        aspecta::Robot::resolve(name_or_path).map_err(error::of)?;
        Self::from_toml(fs::read_to_string(name_or_path)?, name_or_path)
    }

    /// The robot of a file.
    #[staticmethod]
    fn load(path: PathBuf) -> PyResult<Self> {
        aspecta::Robot::load(&path).map_err(error::of)?;
        Self::from_toml(fs::read_to_string(&path)?, &path.display().to_string())
    }

    #[getter]
    fn name(&self) -> &str {
        &self.robot.name
    }

    #[getter]
    fn title(&self) -> &str {
        &self.robot.title
    }

    #[getter]
    fn length_unit(&self) -> &str {
        &self.robot.length_unit
    }

    #[getter]
    fn platform(&self) -> String {
        self.robot.platform.to_string()
    }

    #[getter]
    fn dof(&self) -> usize {
        self.robot.dof()
    }

    /// Names of the pose coordinates, and whether they are angles.
    #[getter]
    fn coordinates(&self) -> Vec<(&'static str, bool)> {
        self.robot.platform.coordinates().iter().map(|c| (c.name, c.angle)).collect()
    }

    /// Whether each joint coordinate is an angle.
    #[getter]
    fn joint_angles(&self) -> Vec<bool> {
        self.robot.legs.iter().map(|leg| leg.actuator.is_angle()).collect()
    }

    #[getter]
    fn modes(&self) -> Vec<String> {
        self.robot.working_modes().iter().map(ToString::to_string).collect()
    }

    /// The signs of a working mode, which may be given by the names of its postures.
    fn signs(&self, mode: &str) -> PyResult<String> {
        Ok(self.mode(mode)?.to_string())
    }

    /// A mode by the names of its postures, if any leg has one with a name.
    fn words(&self, mode: &str) -> PyResult<Option<String>> {
        Ok(self.robot.mode_in_words(self.mode(mode)?))
    }

    /// The names of the limits that the robot goes beyond at a pose, in a mode.
    fn beyond(&self, pose: Vec<f64>, mode: &str) -> PyResult<Vec<String>> {
        let unreached = self.robot.out_of_reach(&pose).map_err(error::of)?;
        if !unreached.is_empty() {
            let legs: Vec<String> = unreached.iter().map(|leg| format!("leg {}", leg.leg)).collect();
            return Err(error::Error::new_err(format!(
                "the pose is out of reach of {}: no joint vector belongs to it, so none is beyond its limits",
                legs.join(", ")
            )));
        }
        let broken = self.robot.broken_limits(&pose, self.mode(mode)?).map_err(error::of)?;
        Ok(broken.into_iter().map(|bound| bound.named(&self.robot)).collect())
    }

    /// The robot as it was understood, as JSON.
    fn json(&self) -> PyResult<String> {
        error::json(&*self.robot)
    }

    /// The warning of lengths in several units, if there is reason for one.
    fn mixed_units(&self) -> Option<(String, f64, String, f64)> {
        let mixed = self.robot.mixed_units()?;
        Some((mixed.small.0.to_string(), mixed.small.1, mixed.large.0.to_string(), mixed.large.1))
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.robot == other.robot
    }

    /// All inverse solutions of one pose.
    fn inverse_one<'py>(
        &self,
        py: Python<'py>,
        pose: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Vec<Parts<'py>>> {
        let found = self.robot.inverse(pose.as_slice()?).map_err(error::of)?;
        found.iter().map(|solution| parts(py, solution)).collect()
    }

    /// All direct solutions of one joint vector, and whether they are proved to be all.
    fn direct_one<'py>(
        &self,
        py: Python<'py>,
        q: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<(Vec<Parts<'py>>, bool)> {
        let q = q.as_slice()?;
        let found = py.detach(|| self.robot.direct_certified(q)).map_err(error::of)?;
        Ok((
            found.solutions.iter().map(|solution| parts(py, solution)).collect::<PyResult<_>>()?,
            found.complete,
        ))
    }

    /// All inverse solutions of each row.
    fn inverse<'py>(
        &self,
        py: Python<'py>,
        poses: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        self.solve(py, &poses, |robot, pose| Ok((robot.inverse(pose)?, None)))
    }

    /// All direct solutions of each row.
    fn direct<'py>(
        &self,
        py: Python<'py>,
        joints: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        self.solve(py, &joints, |robot, q| {
            robot
                .direct_certified(q)
                .map(|DirectSolutions { solutions, complete }| (solutions, Some(complete)))
        })
    }

    /// The state of a configuration, as JSON.
    fn state(&self, pose: Vec<f64>, q: Vec<f64>) -> PyResult<String> {
        error::json(&self.robot.state(&pose, &q).map_err(error::of)?)
    }

    /// The analysis of the robot or of a slice.
    #[pyo3(signature = (fix, modes, seconds, boxes, depth, resolution, certificate, numbers_only, progress))]
    #[expect(clippy::too_many_arguments, reason = "the keywords of Python's `analyze`, which calls it")]
    fn analyze(
        &self,
        py: Python<'_>,
        fix: Vec<(usize, f64)>,
        modes: Vec<String>,
        seconds: Option<f64>,
        boxes: Option<u64>,
        depth: Option<u32>,
        resolution: Option<f64>,
        certificate: bool,
        numbers_only: bool,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Py<PyAny>> {
        let modes = modes.iter().map(|mode| self.mode(mode)).collect::<PyResult<Vec<_>>>()?;
        let budget = Budget { seconds, boxes, depth, resolution };
        let purpose = if numbers_only { Purpose::Numbers } else { Purpose::Pictures };
        let options = Options { budget, fix, modes, certificate, purpose };
        let robot = Arc::clone(&self.robot);
        let found =
            watched(py, progress.as_ref(), move |control| aspecta::analyze(&robot, &options, control))?;
        found.or_partial(py, |analysis| Ok(Analysis::from(analysis.map_err(error::of)?)))
    }

    /// The path from pose to pose that is found without aspects, as [`Analysis::plan`](crate::analysis) returns
    /// it; `None` if it takes more to tell.
    fn plan_without_aspects(
        &self,
        py: Python<'_>,
        ends: [Vec<f64>; 2],
        mode: &str,
        wanted: crate::analysis::Wanted,
    ) -> PyResult<Option<crate::analysis::Planned>> {
        let mode = self.mode(mode)?;
        let Ok(window) = self.robot.slice(&[]) else { return Ok(None) };
        let options = crate::analysis::plan_options(wanted);
        let ends = [&ends[0][..], &ends[1]];
        let find = || aspecta::Planner::without_aspects(&self.robot, &window, ends, mode, &options);
        let plan = threads::detached(py, find).map_err(|refusal| error::no_plan(py, &refusal.into()))?;
        plan.map(|plan| crate::analysis::planned(&plan.into())).transpose()
    }

    /// The robot as a model for MuJoCo that starts in this configuration, and the names of limits it lacks.
    fn mjcf(
        &self,
        py: Python<'_>,
        pose: Option<Vec<f64>>,
        mode: Option<&str>,
    ) -> PyResult<(String, Vec<String>)> {
        let mode = mode.map(|mode| self.mode(mode)).transpose()?;
        let start = threads::detached(py, || match &pose {
            Some(pose) => start::at(&self.robot, pose, mode),
            None => start::anywhere(&self.robot, mode),
        });
        let start = start.map_err(error::of)?;
        let left_out = aspecta_view::mjcf::left_out(&self.robot);
        let left_out = left_out.iter().map(ToString::to_string).collect();
        Ok((aspecta_view::mjcf::model(&self.robot, &start), left_out))
    }
}

impl Robot {
    /// A working mode by its signs, or by the names of its postures.
    pub fn mode(&self, text: &str) -> PyResult<WorkingMode> {
        self.robot.working_mode(text).map_err(error::of)
    }

    /// Solves every row of an array, on all threads.
    fn solve<'py>(
        &self,
        py: Python<'py>,
        rows: &PyReadonlyArray2<'py, f64>,
        solve: impl Fn(&aspecta::Robot, &[f64]) -> Result<(Vec<Solution>, Option<bool>), KinematicsError> + Sync,
    ) -> PyResult<Bound<'py, PyDict>> {
        let dof = self.robot.dof();
        let (count, width) = (rows.as_array().nrows(), rows.as_array().ncols());
        let values = rows.as_slice()?;
        let robot = &*self.robot;
        let chunk = |k: usize| {
            let mut columns = Columns::default();
            for row in k * CHUNK..count.min((k + 1) * CHUNK) {
                let given = &values[row * width..(row + 1) * width];
                let (solutions, complete) = solve(robot, given).map_err(|error| (row, error))?;
                columns.push(row, dof, &solutions, complete);
            }
            Ok(columns)
        };
        let columns = threads::detached(py, || {
            let parts = work::map_range(count.div_ceil(CHUNK), chunk);
            Ok(Columns::joined(parts.into_iter().collect::<Result<_, _>>()?))
        });
        let in_row = |(row, e): (usize, KinematicsError)| error::Error::new_err(format!("row {row}: {e}"));
        columns.map_err(in_row)?.into_arrays(py, dof)
    }
}
