//! The partition of an aspect as plain values.

use super::grid::Grid;
use super::images::Images;
use super::partition::{OUTSIDE, Partition, Region};
use super::sheet::Sheet;
use super::uniqueness::maximal_sets;
use crate::aspect::{Analysis, DetSign, Measure};
use crate::kinematics::WorkingMode;
use crate::paving::Control;
use crate::robot::Platform;
use serde::Serialize;
use std::collections::BTreeSet;

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

/// Why an aspect has no partition.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DomainError {
    /// No such aspect.
    #[error("there is no aspect {id}: the analysis found {count}, numbered from 1")]
    NoAspect {
        /// The number asked for.
        id: usize,
        /// How many there are.
        count: usize,
    },
    /// A slice.
    #[error(
        "a joint vector of a pose in a slice means poses outside the slice too: analyse the robot without --fix \
         to find its domains"
    )]
    Slice,
    /// No direct model.
    #[error("the direct model of a {0} is not there yet: its domains cannot be computed")]
    NoDirectModel(Platform),
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

/// Most nodes of a grid.
const MOST_NODES: usize = 200_000_000;

/// The basic regions and uniqueness domains of one aspect. Numerical, true to a cell of the grid.
#[derive(Clone, Debug, Serialize)]
pub struct Domains {
    /// The aspect: [`crate::aspect::Aspect::id`].
    pub aspect: usize,
    /// Its working mode.
    pub mode: WorkingMode,
    /// The sign of det A in it.
    pub det_a: DetSign,
    /// What all measures are of, and their unit.
    pub unit: Measure,
    /// Width of a cell, per coordinate.
    pub cell: Vec<f64>,
    /// Measure of the aspect: that of its nodes' cells.
    pub measure: f64,
    /// Its basic regions, largest first.
    pub regions: Vec<BasicRegion>,
    /// What is thinner than two cells and could not be joined to a region.
    pub unresolved: Unresolved,
    /// Pairs of regions (numbered from 1) that touch.
    pub adjacent: Vec<(usize, usize)>,
    /// Pairs of regions whose images have joint vectors in common.
    pub coincidences: Vec<Coincidence>,
    /// The maximal uniqueness domains, largest first.
    pub uniqueness: Vec<UniquenessDomain>,
    /// Whether `uniqueness` holds all of them.
    pub complete: bool,
    /// Two poses with one joint vector in one basic region, if found: Theorem 2 does not hold there.
    pub violations: Vec<Violation>,
    /// The partition against the direct model at random poses.
    pub agreement: Agreement,
    /// Nodes at which the direct model failed.
    pub failed: usize,
    /// The grid behind it.
    #[serde(skip)]
    pub partition: Partition,
}

impl Domains {
    /// The number of the basic region that a pose lies in; `None` outside the aspect, and where the grid is too coarse to tell.
    pub fn region_at(&self, analysis: &Analysis, pose: &[f64]) -> Option<usize> {
        let region = self.partition.region_of(&Sheet::new(analysis, self.aspect)?, pose)? as usize;
        self.regions.get(region).map(|found| found.number)
    }

    /// Whether the images of two basic regions (by number) meet: then their basic components coincide.
    pub fn coincide(&self, a: usize, b: usize) -> bool {
        self.coincidences.iter().any(|c| c.regions == (a.min(b), a.max(b)))
    }
}

/// WAb_ijk.
#[derive(Clone, Debug, Serialize)]
pub struct BasicRegion {
    /// From 1.
    pub number: usize,
    /// Measure.
    pub measure: f64,
    /// Direct solutions in the aspect of each of its joint vectors.
    pub solutions: u8,
    /// A pose in it.
    pub pose: Vec<f64>,
}

/// Parts of an aspect too thin for the grid: they may be basic regions or belong to one. A finer grid has less of them.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Unresolved {
    /// How many connected sets of nodes.
    pub parts: usize,
    /// Measure of all of them.
    pub measure: f64,
}

/// Two regions with joint vectors in common.
#[derive(Clone, Debug, Serialize)]
pub struct Coincidence {
    /// Their numbers.
    pub regions: (usize, usize),
    /// The share of the first region's joint vectors that have a pose in the second, and the other way round, away from the
    /// surfaces. By the consequence of Theorem 2 both are 1.
    pub shares: (f64, f64),
}

/// Wu_ik.
#[derive(Clone, Debug, Serialize)]
pub struct UniquenessDomain {
    /// Its regions.
    pub regions: Vec<usize>,
    /// Measure.
    pub measure: f64,
    /// Share of the aspect.
    pub of_aspect: f64,
    /// Share of the workspace, as the analysis knows it (inner measure of the mode's aspects and all others, overlaps once).
    pub of_workspace: Option<f64>,
}

/// Two poses in one basic region with the same joint vector.
#[derive(Clone, Debug, Serialize)]
pub struct Violation {
    /// The region.
    pub region: usize,
    /// The poses.
    pub poses: [Vec<f64>; 2],
    /// Their joint vector.
    pub q: Vec<f64>,
}

/// How often the partition and the direct model say the same.
#[derive(Clone, Debug, Default, Serialize)]
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
#[derive(Clone, Debug, Serialize)]
pub struct Disagreement {
    /// The pose.
    pub pose: Vec<f64>,
    /// The region it should lie in.
    pub region: usize,
    /// Direct solutions in the aspect.
    pub solutions: u8,
}

/// The basic regions, their images and the uniqueness domains of the aspect with the given [`crate::aspect::Aspect::id`].
///
/// # Errors
/// [`DomainError`].
pub fn domains(
    analysis: &Analysis,
    id: usize,
    options: DomainOptions,
    control: &Control<'_>,
) -> Result<Domains, DomainError> {
    let robot = &analysis.robot;
    if !analysis.fixed.is_empty() {
        return Err(DomainError::Slice);
    }
    if robot.platform == Platform::TurningBody {
        return Err(DomainError::NoDirectModel(robot.platform));
    }
    let missing = DomainError::NoAspect { id, count: analysis.aspects.low };
    let (Some(sheet), Some((class, aspect))) = (Sheet::new(analysis, id), analysis.aspect(id)) else {
        return Err(missing);
    };
    let grid = Grid::new(&analysis.window, &aspect.w_bounds, options.cells);
    if grid.len() > MOST_NODES {
        return Err(DomainError::TooFine { nodes: grid.len(), most: MOST_NODES });
    }
    let partition = Partition::new(&sheet, grid, control);
    let all = partition.regions();
    let regions = &all[..all.iter().take_while(|region| region.is_resolved()).count()];
    let images = partition.images(&all);
    let agreement = agreement(&sheet, &partition, regions, options.samples);
    if control.is_cancelled() {
        return Err(DomainError::Cancelled);
    }
    let adjacent: BTreeSet<(usize, usize)> = partition
        .adjacent()
        .into_keys()
        .map(|(a, b)| (a as usize, b as usize))
        .filter(|pair| pair.1 < regions.len())
        .collect();
    let meeting: BTreeSet<(usize, usize)> =
        images.meeting().into_iter().filter(|pair| pair.1 < regions.len()).collect();
    let (sets, complete) = maximal_sets(regions.len(), &adjacent, &meeting);
    let cell = partition.grid.measure();
    let measure_of = |regions: &[Region]| regions.iter().map(|r| r.nodes as f64 * cell).sum::<f64>();
    let measure = measure_of(&all);
    let slivers = &all[regions.len()..];
    let entry = &analysis.classes[class];
    let numbered = |(a, b): (usize, usize)| (a + 1, b + 1);
    let mut uniqueness: Vec<UniquenessDomain> = sets
        .into_iter()
        .map(|set| {
            let of_set: f64 = set.iter().map(|&r| regions[r].nodes as f64 * cell).sum();
            UniquenessDomain {
                regions: set.into_iter().map(|r| r + 1).collect(),
                measure: of_set,
                of_aspect: of_set / measure,
                of_workspace: workspace(analysis).map(|w| of_set / w),
            }
        })
        .collect();
    uniqueness.sort_by(|a, b| b.measure.total_cmp(&a.measure));
    Ok(Domains {
        aspect: id,
        mode: entry.mode,
        det_a: entry.det_a,
        unit: analysis.measure.clone(),
        cell: partition.grid.step[..partition.grid.axes()].to_vec(),
        measure,
        unresolved: Unresolved { parts: slivers.len(), measure: measure_of(slivers) },
        regions: (1..).zip(regions).map(|(number, r)| basic_region(&partition, number, r)).collect(),
        adjacent: adjacent.into_iter().map(numbered).collect(),
        coincidences: coincidences(&images, &meeting),
        uniqueness,
        complete,
        violations: violations(&sheet, &partition, &images, regions.len()),
        agreement,
        failed: partition.failed,
        partition,
    })
}

/// Inner measure of the workspace: that of the union of all modes.
fn workspace(analysis: &Analysis) -> Option<f64> {
    let mut sum = 0.0;
    let paving = &analysis.paving;
    paving.boxes_of(&|node| node.of_classes(!0), &mut |node| {
        if paving.nodes[node as usize].inside != 0 {
            sum += paving.measure(paving.depth_of(node));
        }
    });
    (sum > 0.0).then_some(sum)
}

fn basic_region(partition: &Partition, number: usize, region: &Region) -> BasicRegion {
    let grid = &partition.grid;
    BasicRegion {
        number,
        measure: region.nodes as f64 * grid.measure(),
        solutions: region.solutions,
        pose: grid.pose(region.sample)[..grid.axes()].to_vec(),
    }
}

fn coincidences(images: &Images, meeting: &BTreeSet<(usize, usize)>) -> Vec<Coincidence> {
    let meeting = meeting.iter().filter(|(a, b)| a != b);
    let entry = |&(a, b): &(usize, usize)| Coincidence {
        regions: (a + 1, b + 1),
        shares: (images.share(a, b), images.share(b, a)),
    };
    meeting.map(entry).collect()
}

fn violations(sheet: &Sheet<'_>, partition: &Partition, images: &Images, regions: usize) -> Vec<Violation> {
    let grid = &partition.grid;
    let violation = |region: usize| {
        let pose = grid.pose(images.within(region)?)[..grid.axes()].to_vec();
        let joints = sheet.joints(&pose)?;
        let mut twin = None;
        sheet.others(&pose, &joints, |other| {
            if twin.is_none() && partition.region_round(other) == Some(region as u32) {
                twin = Some(other.to_vec());
            }
        });
        Some(Violation { region: region + 1, q: joints[..pose.len()].to_vec(), poses: [pose, twin?] })
    };
    (0..regions).filter_map(violation).collect()
}

/// Compares the partition with the direct model at random poses.
fn agreement(sheet: &Sheet<'_>, partition: &Partition, regions: &[Region], samples: usize) -> Agreement {
    let grid = &partition.grid;
    let mut agreement = Agreement::default();
    let mut random = 0x9e37_79b9_7f4a_7c15_u64;
    let mut uniform = || {
        // SplitMix64 (Steele, Lea, Flood 2014).
        random = random.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = random;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    };
    let inside: Vec<usize> = (0..grid.len()).filter(|&node| partition.region[node] != OUTSIDE).collect();
    for _ in (0..samples).take_while(|_| !inside.is_empty()) {
        let node = inside[(uniform() * inside.len() as f64) as usize];
        let mut pose = grid.pose(node);
        for (k, x) in pose.iter_mut().enumerate().take(grid.axes()) {
            *x += grid.step[k] * (uniform() - 0.5);
        }
        let pose = &pose[..grid.axes()];
        let Some(joints) = sheet.joints(pose) else { continue };
        agreement.samples += 1;
        let Some(region) = partition.region_round(pose).filter(|r| (*r as usize) < regions.len()) else {
            continue;
        };
        agreement.away += 1;
        let mut count = 1;
        sheet.others(pose, &joints, |_| count += 1);
        if count == regions[region as usize].solutions {
            agreement.agree += 1;
        } else {
            let (pose, region) = (pose.to_vec(), region as usize + 1);
            agreement.disagreements.push(Disagreement { pose, region, solutions: count });
        }
    }
    agreement
}
