//! What bounds an aspect and its regions, as meshes.

use super::boundary::Boundary;
use super::characteristic::{Characteristic, GivenUp};
use super::{Domains, Mesh, slice};
use crate::Error;
use crate::aspect::Analysis;
use serde::{Deserialize, Serialize};

/// The meshes of an aspect.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Surfaces {
    /// Its boundary.
    pub boundary: Mesh,
    /// Its characteristic surfaces.
    pub characteristic: Mesh,
    /// The parts of these that were given up.
    pub given_up: GivenUp,
}

impl Surfaces {
    /// The meshes of an aspect that was cut into regions, about as fine as these: `cells` is that of
    /// [`DomainOptions`](super::DomainOptions). Numerical.
    ///
    /// # Errors
    /// One coordinate alone varies, or the aspect is not one of the analysis.
    ///
    /// # Examples
    /// ```
    /// use aspecta::domain::Surfaces;
    /// use aspecta::{AspectId, Budget, Control, DomainOptions, Options, Robot};
    ///
    /// let robot = Robot::resolve("five-bar")?;
    /// let budget = Budget { depth: Some(6), ..Budget::default() };
    /// let options = Options { budget, ..Options::default() };
    /// let analysis = aspecta::analyze(&robot, &options, &Control::unwatched())?;
    /// let coarse = DomainOptions { cells: 20, samples: 100 };
    /// let domains = aspecta::domains(&analysis, AspectId::new(1), &coarse, &Control::unwatched())?;
    /// let surfaces = Surfaces::of(&analysis, &domains, coarse.cells)?;
    /// assert!(surfaces.boundary.vertices.iter().all(|pose| pose.len() == 2));
    /// # Ok::<(), aspecta::Error>(())
    /// ```
    pub fn of(analysis: &Analysis, domains: &Domains, cells: usize) -> Result<Self, Error> {
        let cells = cells.clamp(4, if domains.cell.len() == 2 { 2000 } else { 300 });
        let boundary = Boundary::new(analysis, domains.aspect, cells)?;
        if !analysis.fixed.is_empty() {
            return Ok(Self::on_slice(&boundary, slice::surfaces(analysis, domains)));
        }
        Ok(Self::new(&boundary, &Characteristic::new(analysis, &boundary)?))
    }

    /// The meshes of a boundary and of what it maps to.
    pub fn new(boundary: &Boundary, characteristic: &Characteristic) -> Self {
        let given_up = characteristic.given_up;
        Self { boundary: boundary.into(), characteristic: characteristic.into(), given_up }
    }

    /// The meshes on a slice: a boundary, and what [`slice::surfaces`] found.
    pub fn on_slice(boundary: &Boundary, characteristic: Mesh) -> Self {
        let mut boundary_mesh = Mesh::from(boundary);
        for pose in &mut boundary_mesh.vertices {
            *pose = boundary.axes.iter().map(|&k| pose[k]).collect();
        }
        Self { boundary: boundary_mesh, characteristic, given_up: GivenUp::default() }
    }
}
