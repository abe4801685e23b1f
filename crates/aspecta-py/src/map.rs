//! Maps: basic regions and uniqueness domains.

use crate::error;
use crate::surface;
use crate::threads;
use aspecta::WorkingMode;
use aspecta::aspect::AspectId;
use aspecta::domain::{Labels, MappedAspect, Mesh, OUTSIDE};
use aspecta::robot::{LegIndex, work};
use aspecta_view::{Choice, Cut, figure, write_domains};
use numpy::PyReadonlyArray2;
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::collections::BTreeMap;
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

/// The regions of an aspect on a grid: the coordinates that vary, the grid's lower ends, widths and number of cells, and the region
/// of each cell, the first coordinate running fastest (0: outside the aspect, -1: too thin to tell).
type Grid<'py> = (Vec<usize>, Vec<f64>, Vec<f64>, Vec<usize>, Bound<'py, PyArray1<i64>>);

#[pymethods]
impl Map {
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let map = threads::detached(py, || aspecta::Map::load(&path));
        Ok(map.map_err(|reason| error::at(&path, reason))?.into())
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

    /// The names of the pose coordinates.
    #[getter]
    fn coordinates(&self) -> Vec<&'static str> {
        self.0.robot.platform.coordinates().iter().map(|coordinate| coordinate.name).collect()
    }

    /// The pose coordinates with their units, by name.
    #[getter]
    fn labels(&self) -> BTreeMap<&'static str, String> {
        let robot = &self.0.robot;
        let unit = |angle| if angle { "rad" } else { &robot.length_unit };
        let coordinates = robot.platform.coordinates().iter();
        coordinates.map(|c| (c.name, format!("{} [{}]", c.name, unit(c.angle)))).collect()
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

    /// The regions on a grid, if the aspect is mapped.
    fn grid<'py>(&self, py: Python<'py>, aspect: usize) -> Option<Grid<'py>> {
        let domains = self.0.domains(AspectId::new(aspect))?;
        let Labels { grid, region } = &domains.labels;
        let axes: Vec<usize> = (0..grid.axes()).map(|axis| grid.coordinate(axis)).collect();
        let first = grid.pose(0);
        let low = (0..axes.len()).map(|axis| first[axes[axis]] - 0.5 * grid.step[axis]).collect();
        let number = |&label: &u32| match label {
            OUTSIDE => 0,
            label if (label as usize) < domains.regions.len() => i64::from(label) + 1,
            _ => -1,
        };
        let labels: Vec<i64> = region.iter().map(number).collect();
        let (step, count) = (grid.step[..axes.len()].to_vec(), grid.count[..axes.len()].to_vec());
        Some((axes, low, step, count, labels.into_pyarray(py)))
    }

    /// The surfaces of an aspect, if they were computed.
    fn surfaces<'py>(&self, py: Python<'py>, aspect: usize) -> Option<Vec<surface::Surface<'py>>> {
        let sheet = self.sheet(aspect)?;
        sheet.surfaces.as_ref().map(|surfaces| surface::of(py, &self.0, &sheet.domains, surfaces))
    }

    /// The picture of the regions of an aspect, as SVG.
    fn picture(&self, py: Python<'_>, aspect: usize) -> Option<String> {
        let sheet = self.sheet(aspect)?;
        let none = Mesh::default();
        let (boundary, surface) =
            sheet.surfaces.as_ref().map_or((&none, &none), |s| (&s.boundary, &s.characteristic));
        let cut = Cut { map: &self.0, domains: &sheet.domains, boundary, surface };
        (sheet.domains.cell.len() > 1).then(|| threads::detached(py, || figure::regions::regions(&cut)))
    }

    /// Writes pictures and meshes of an aspect into a directory; returns the paths written, or nothing if its surfaces were not
    /// computed.
    fn draw(
        &self,
        py: Python<'_>,
        aspect: usize,
        directory: PathBuf,
        meshes: Vec<String>,
        held: usize,
    ) -> PyResult<Option<Vec<PathBuf>>> {
        let Some(MappedAspect { domains, surfaces: Some(surfaces) }) = self.sheet(aspect) else {
            return Ok(None);
        };
        let meshes = meshes.iter().map(|name| surface::format(name)).collect::<PyResult<_>>()?;
        let choice = Choice { meshes, held: LegIndex::new(held) };
        let cut =
            Cut { map: &self.0, domains, boundary: &surfaces.boundary, surface: &surfaces.characteristic };
        let written = threads::detached(py, || write_domains(&cut, &choice, &directory));
        written.map(Some).map_err(|reason| error::at(&directory, reason))
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
    fn sheet(&self, aspect: usize) -> Option<&MappedAspect> {
        self.0.sheets.iter().find(|sheet| sheet.domains.aspect == AspectId::new(aspect))
    }

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
