//! Maps: basic regions and uniqueness domains.

use crate::error;
use crate::threads;
use aspecta::WorkingMode;
use aspecta::aspect::AspectId;
use aspecta::robot::work;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;
use std::sync::Arc;

/// The aspects of a robot, of which some are cut into basic regions.
#[pyclass(frozen, module = "aspecta._native")]
pub struct Map(Arc<aspecta::Map>);

impl From<aspecta::Map> for Map {
    fn from(map: aspecta::Map) -> Self {
        Self(Arc::new(map))
    }
}

/// The location of a pose: the sign of det A, the aspect, the region (0: not known), the uniqueness domains; and
/// why it is in no aspect, if so.
type Location = (i8, usize, usize, Vec<usize>, Option<String>);

#[pymethods]
impl Map {
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Ok(threads::detached(py, || aspecta::Map::load(&path)).map_err(error::of)?.into())
    }

    #[staticmethod]
    fn from_bytes(py: Python<'_>, file: &[u8]) -> PyResult<Self> {
        Ok(threads::detached(py, || aspecta::Map::from_bytes(file)).map_err(error::of)?.into())
    }

    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        Ok(PyBytes::new(py, &threads::detached(py, || self.0.to_bytes()).map_err(error::of)?))
    }

    /// The name of its robot, and the robot as JSON.
    #[getter]
    fn robot(&self) -> PyResult<(String, String)> {
        Ok((self.0.robot.name.clone(), error::json(&self.0.robot)?))
    }

    #[getter]
    fn dof(&self) -> usize {
        self.0.robot.dof()
    }

    /// The numbers of the aspects that are cut into regions.
    #[getter]
    fn aspects(&self) -> Vec<usize> {
        self.0.sheets.iter().map(|sheet| sheet.domains.aspect.number()).collect()
    }

    /// The regions and domains of an aspect: JSON and summary.
    fn domains(&self, aspect: usize) -> PyResult<Option<(String, String)>> {
        let domains = self.0.domains(AspectId::new(aspect));
        domains.map(|domains| Ok((error::json(domains)?, domains.to_string()))).transpose()
    }

    /// Locates every row of an array.
    fn locate<'py>(
        &self,
        py: Python<'py>,
        poses: PyReadonlyArray2<'py, f64>,
        mode: &str,
    ) -> PyResult<Vec<Location>> {
        let mode = self.0.robot.working_mode(mode).map_err(error::of)?;
        let (count, width) = (poses.as_array().nrows(), poses.as_array().ncols());
        let dof = self.0.robot.dof();
        if width != dof {
            let name = &self.0.robot.name;
            return Err(error::Error::new_err(format!(
                "a pose of `{name}` has {dof} coordinates, not {width}"
            )));
        }
        let values = poses.as_slice()?;
        let row = |k: usize| self.location(&values[k * width..(k + 1) * width], mode);
        Ok(threads::detached(py, || work::map_range(count, row)))
    }
}

impl Map {
    fn location(&self, pose: &[f64], mode: WorkingMode) -> Location {
        let found = match self.0.locate(pose, mode) {
            Ok(found) => found,
            Err(nowhere) => return (0, 0, 0, Vec::new(), Some(nowhere.to_string())),
        };
        let domains = match (found.aspect, found.region) {
            (Some(aspect), Some(region)) => self.0.uniqueness(aspect, region).collect(),
            _ => Vec::new(),
        };
        let (aspect, region) =
            (found.aspect.map_or(0, AspectId::number), found.region.map_or(0, |r| r.number()));
        (found.det_a.factor(), aspect, region, domains, None)
    }
}
