//! The partition of an aspect as plain values.

use super::RegionId;
use super::labels::Labels;
use super::mesh::Mesh;
use super::sheet::Sheet;
use crate::aspect::{Analysis, AspectId, DetSign, Measure};
use aspecta_robot::num::without_turns;
use aspecta_robot::{Robot, Unbounded, Window, WorkingMode, text};
use serde::{Deserialize, Serialize};

/// How finely an aspect is partitioned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DomainOptions {
    /// Cells are 1/`cells` of the workspace's width in each coordinate.
    pub cells: usize,
    /// Random poses at which the partition is compared with the direct model.
    pub samples: usize,
}

impl Default for DomainOptions {
    fn default() -> Self {
        Self { cells: 100, samples: 100_000 }
    }
}

impl DomainOptions {
    /// Returns how finely regions are usually found and checked where so many coordinates are free, by what the
    /// direct problem costs.
    ///
    /// # Examples
    /// ```
    /// use aspecta::{DomainOptions, Robot};
    ///
    /// let robot = Robot::resolve("3-rrr")?;
    /// assert_eq!(DomainOptions::usual(&robot, 3), DomainOptions::default());
    /// assert_eq!(DomainOptions::usual(&robot, 2).cells, 500);
    /// # Ok::<(), aspecta::Error>(())
    /// ```
    pub fn usual(robot: &Robot, free: usize) -> Self {
        let usual = Self::default();
        match (robot.dof(), free) {
            (6, 2) => Self { cells: 100, samples: 2000 },
            (6, 3) => Self { cells: 30, samples: 2000 },
            (6, _) => Self { cells: 500, samples: 2000 },
            (_, 3) => usual,
            _ => Self { cells: 500, ..usual },
        }
    }
}

/// Why an aspect has no partition.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DomainError {
    /// No such aspect.
    #[error("there is no aspect {id}: the analysis found {count}, numbered from 1")]
    NoAspect {
        /// The one asked for.
        id: AspectId,
        /// How many there are.
        count: usize,
    },
    /// Nothing bounds a coordinate, if only a slice does not vary it: the other poses of a joint vector may be anywhere.
    #[error(transparent)]
    Unbounded(#[from] Unbounded),
    /// Too many nodes.
    #[error("a grid of {nodes} nodes is too large (at most {most}): ask for fewer cells")]
    TooFine {
        /// Nodes asked for.
        nodes: usize,
        /// Most there may be.
        most: usize,
    },
    /// Cancelled.
    #[error("cancelled")]
    Cancelled,
}

/// The basic regions and uniqueness domains of one aspect. Numerical, true to a cell of the grid.
///
/// Of an aspect of a slice they are those of the class (working mode and sign of det A) in the whole workspace, as far as they meet the
/// slice: the class is taken for one aspect of the whole, which no slice can tell. If it is several, each region is still part of one basic region or
/// a piece of one, and the uniqueness domains are still such that a joint vector means one pose.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Domains {
    /// The aspect.
    pub aspect: AspectId,
    /// Its working mode.
    pub mode: WorkingMode,
    /// The sign of det A in it.
    pub det_a: DetSign,
    /// The quantity that is measured, and its unit.
    #[serde(skip_deserializing)]
    pub unit: Measure,
    /// Width of a cell, per coordinate.
    pub cell: Vec<f64>,
    /// Measure of the aspect: that of its nodes' cells.
    pub measure: f64,
    /// Its basic regions, largest first.
    pub regions: Vec<BasicRegion>,
    /// The nodes in parts thinner than two cells, which could not be joined to a region, and, where two
    /// coordinates vary of three at most, those next to which such a part passes between the nodes.
    pub unresolved: Unresolved,
    /// Pairs of regions that touch.
    pub adjacent: Vec<(RegionId, RegionId)>,
    /// Pairs of regions whose images have joint vectors in common.
    pub coincidences: Vec<Coincidence>,
    /// On a slice, pairs of regions seen to be parts of one basic region, joined outside the slice.
    #[serde(default)]
    pub joined: Vec<(RegionId, RegionId)>,
    /// On a slice, pairs of regions with the same number of solutions whose images may coincide or be disjoint: no way tried has shown which.
    #[serde(default)]
    pub undecided: Vec<(RegionId, RegionId)>,
    /// The maximal uniqueness domains, largest first. On a slice, its parts of uniqueness domains: none holds two regions of which it is
    /// undecided whether their images coincide, so there may be larger ones.
    pub uniqueness: Vec<UniquenessDomain>,
    /// Whether `uniqueness` holds all of them, to a cell of the grid: all sets of regions were looked at, and
    /// nothing was seen to pass between the nodes. (Poses that disagree with the direct model are listed in
    /// `agreement`.)
    pub complete: bool,
    /// Two poses with one joint vector in one basic region, if found: Theorem 2 does not hold there.
    pub violations: Vec<Violation>,
    /// The partition against the direct model at random poses.
    pub agreement: Agreement,
    /// Nodes at which the direct model failed.
    pub failed: usize,
    /// The grid behind it.
    #[serde(skip)]
    pub labels: Labels,
    /// The poses that were cut up.
    #[serde(skip)]
    pub(crate) window: Window,
    /// How their coordinates are called.
    #[serde(skip)]
    pub(crate) pose: text::Labels,
}

impl Domains {
    /// The basic region that a pose lies in; `None` outside the aspect, and where the grid is too coarse to tell.
    pub fn region_at(&self, analysis: &Analysis, pose: &[f64]) -> Option<RegionId> {
        self.region_on(&Sheet::new(analysis, self.aspect)?, pose)
    }

    /// Returns the basic region of `pose`, as [`Self::region_at`] does, on the aspect given.
    pub(super) fn region_on(&self, sheet: &Sheet<'_>, pose: &[f64]) -> Option<RegionId> {
        let solutions = |region: u32| self.regions.get(region as usize).map(|found| found.solutions);
        let region = self.labels.region_of(sheet, solutions, pose)?;
        self.regions.get(region as usize).map(|found| found.number)
    }

    /// Finds out how far from the characteristic surfaces partition and direct model disagree: within a cell or two it is the grid that is
    /// too coarse.
    pub fn measure_disagreements(&mut self, surfaces: &Mesh, window: &Window) {
        let axes = window.axes();
        let apart = |pose: &[f64], vertex: &[f64]| {
            let part = |(axis, &k): (usize, &usize)| {
                let gap = pose[k] - vertex[axis];
                (if window.glued[k] { without_turns(gap) } else { gap }).abs() / self.cell[axis]
            };
            axes.iter().enumerate().map(part).fold(0.0, f64::max)
        };
        for found in &mut self.agreement.disagreements {
            found.distance =
                surfaces.vertices.iter().map(|vertex| apart(&found.pose, vertex)).reduce(f64::min);
        }
    }

    /// Whether the images of two basic regions meet: then their basic components coincide.
    pub fn coincide(&self, a: RegionId, b: RegionId) -> bool {
        self.coincidences.iter().any(|c| c.regions == (a.min(b), a.max(b)))
    }
}

/// WAb_ijk.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[non_exhaustive]
pub struct BasicRegion {
    /// Its number in the partition.
    pub number: RegionId,
    /// Measure.
    pub measure: f64,
    /// Direct solutions in the aspect of each of its joint vectors; on a slice, in the class, outside the slice too.
    pub solutions: u8,
    /// A pose in it.
    pub pose: Vec<f64>,
}

/// Parts of an aspect too thin for the grid: they may be basic regions or belong to one. A finer grid has less of them.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Unresolved {
    /// How many connected sets of nodes.
    pub parts: usize,
    /// Measure of all of them.
    pub measure: f64,
}

/// Two regions with joint vectors in common.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Coincidence {
    /// The regions, the lesser number first.
    pub regions: (RegionId, RegionId),
    /// The share of the first region's joint vectors that have a pose in the second, and the other way round, away from the
    /// surfaces. By the consequence of Theorem 2 both are 1. `None` if the images were seen to coincide outside a slice.
    pub shares: Option<(f64, f64)>,
}

/// Wu_ik.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[non_exhaustive]
pub struct UniquenessDomain {
    /// Its regions.
    pub regions: Vec<RegionId>,
    /// Measure.
    pub measure: f64,
    /// Share of the aspect.
    pub of_aspect: f64,
    /// Share of the workspace, as the analysis knows it (inner measure of the mode's aspects and all others, overlaps once).
    pub of_workspace: Option<f64>,
}

/// Two poses in one basic region with the same joint vector.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Violation {
    /// The region.
    pub region: RegionId,
    /// The poses.
    pub poses: [Vec<f64>; 2],
    /// Their joint vector.
    pub q: Vec<f64>,
}

/// How often the partition and the direct model say the same.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Agreement {
    /// Random poses of the aspect looked at.
    pub samples: usize,
    /// Of these, poses farther than a cell from all surfaces.
    pub away: usize,
    /// Of those, poses with as many direct solutions as their region has.
    pub agree: usize,
    /// The others.
    pub disagreements: Vec<Disagreement>,
}

/// A pose away from the surfaces at which partition and direct model do not agree.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Disagreement {
    /// The pose.
    pub pose: Vec<f64>,
    /// The region it should lie in.
    pub region: RegionId,
    /// Direct solutions in the aspect.
    pub solutions: u8,
    /// How far it is from the nearest vertex of the characteristic surfaces, in cells, coordinate by coordinate; `None` until
    /// [`Domains::measure_disagreements`].
    pub distance: Option<f64>,
}
