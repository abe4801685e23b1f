//! From an aspect to its domains.

use super::grid::Grid;
use super::images::Images;
use super::labels::OUTSIDE;
use super::partition::{Partition, Region};
use super::result::*;
use super::sheet::Sheet;
use super::uniqueness::maximal_sets;
use crate::aspect::Analysis;
use crate::num::Random;
use crate::paving::Control;
use std::collections::BTreeSet;

/// Most nodes of a grid.
const MOST_NODES: usize = 200_000_000;

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
    if !analysis.fixed.is_empty() {
        return Err(DomainError::Slice);
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
    if control.is_cancelled() {
        return Err(DomainError::Cancelled);
    }
    let all = partition.regions();
    let (regions, slivers) = all.split_at(all.iter().take_while(|region| region.is_resolved()).count());
    let cell = partition.labels.grid.measure();
    let measure_of = |regions: &[Region]| regions.iter().map(|r| r.nodes as f64 * cell).sum::<f64>();
    let images = partition.images(&all);
    let adjacent = among(regions, partition.labels.adjacent());
    let meeting = among(regions, images.meeting());
    let (uniqueness, complete) = uniqueness(analysis, &partition, regions, &adjacent, &meeting);
    let entry = &analysis.classes[class];
    Ok(Domains {
        aspect: id,
        mode: entry.mode,
        det_a: entry.det_a,
        unit: analysis.measure.clone(),
        cell: partition.labels.grid.step[..partition.labels.grid.axes()].to_vec(),
        measure: measure_of(&all),
        unresolved: Unresolved { parts: slivers.len(), measure: measure_of(slivers) },
        regions: (1..).zip(regions).map(|(number, r)| basic_region(&partition, number, r)).collect(),
        adjacent: adjacent.into_iter().map(|(a, b)| (a + 1, b + 1)).collect(),
        coincidences: coincidences(&images, &meeting),
        uniqueness,
        complete,
        violations: violations(&sheet, &partition, &images, regions.len()),
        agreement: agreement(&sheet, &partition, regions, options.samples),
        failed: partition.failed,
        labels: partition.labels,
    })
}

/// Pairs of regions, by index, the lesser first.
type Pairs = BTreeSet<(usize, usize)>;

/// The pairs of resolved regions.
fn among(regions: &[Region], pairs: Pairs) -> Pairs {
    pairs.into_iter().filter(|pair| pair.1 < regions.len()).collect()
}

fn uniqueness(
    analysis: &Analysis,
    partition: &Partition,
    regions: &[Region],
    adjacent: &Pairs,
    meeting: &Pairs,
) -> (Vec<UniquenessDomain>, bool) {
    let (sets, complete) = maximal_sets(regions.len(), adjacent, meeting);
    let cell = partition.labels.grid.measure();
    let aspect = partition.solutions.iter().filter(|count| **count > 0).count() as f64 * cell;
    let workspace = workspace(analysis);
    let domain = |set: Vec<usize>| {
        let measure = set.iter().map(|&r| regions[r].nodes as f64 * cell).sum();
        UniquenessDomain {
            regions: set.into_iter().map(|r| r + 1).collect(),
            measure,
            of_aspect: measure / aspect,
            // More than all of it: the boxes are too coarse to compare with.
            of_workspace: workspace.map(|w| measure / w).filter(|share| *share <= 1.0),
        }
    };
    let mut domains: Vec<UniquenessDomain> = sets.into_iter().map(domain).collect();
    domains.sort_by(|a, b| b.measure.total_cmp(&a.measure));
    (domains, complete)
}

/// Inner measure of the workspace: that of the union of all modes.
fn workspace(analysis: &Analysis) -> Option<f64> {
    let [paving] = &analysis.pavings[..] else { return None };
    let mut sum = 0.0;
    paving.boxes_of(&|node| node.of_classes(!0), &mut |node| {
        if paving.nodes[node as usize].inside != 0 {
            sum += paving.measure(paving.depth_of(node));
        }
    });
    (sum > 0.0).then_some(sum)
}

fn basic_region(partition: &Partition, number: usize, region: &Region) -> BasicRegion {
    let grid = &partition.labels.grid;
    BasicRegion {
        number,
        measure: region.nodes as f64 * grid.measure(),
        solutions: region.solutions,
        pose: grid.pose(region.sample)[..grid.axes()].to_vec(),
    }
}

fn coincidences(images: &Images, meeting: &Pairs) -> Vec<Coincidence> {
    let meeting = meeting.iter().filter(|(a, b)| a != b);
    let entry = |&(a, b): &(usize, usize)| Coincidence {
        regions: (a + 1, b + 1),
        shares: (images.share(a, b), images.share(b, a)),
    };
    meeting.map(entry).collect()
}

fn violations(sheet: &Sheet<'_>, partition: &Partition, images: &Images, regions: usize) -> Vec<Violation> {
    let grid = &partition.labels.grid;
    let violation = |region: usize| {
        let pose = grid.pose(images.within(region)?)[..grid.axes()].to_vec();
        let joints = sheet.joints(&pose)?;
        let mut twin = None;
        sheet.others(&pose, &joints, |other| {
            if twin.is_none() && partition.labels.region_round(other) == Some(region as u32) {
                twin = Some(other.to_vec());
            }
        });
        Some(Violation { region: region + 1, q: joints[..pose.len()].to_vec(), poses: [pose, twin?] })
    };
    (0..regions).filter_map(violation).collect()
}

/// Compares the partition with the direct model at random poses.
fn agreement(sheet: &Sheet<'_>, partition: &Partition, regions: &[Region], samples: usize) -> Agreement {
    let grid = &partition.labels.grid;
    let mut agreement = Agreement::default();
    let mut random = Random::new(0x9e37_79b9_7f4a_7c15);
    let mut uniform = || random.unit();
    let inside: Vec<usize> =
        (0..grid.len()).filter(|&node| partition.labels.region[node] != OUTSIDE).collect();
    for _ in (0..samples).take_while(|_| !inside.is_empty()) {
        let node = inside[(uniform() * inside.len() as f64) as usize];
        let mut pose = grid.pose(node);
        for (k, x) in pose.iter_mut().enumerate().take(grid.axes()) {
            *x += grid.step[k] * (uniform() - 0.5);
        }
        let pose = &pose[..grid.axes()];
        let Some(joints) = sheet.joints(pose) else { continue };
        agreement.samples += 1;
        let Some(region) = partition.labels.region_round(pose).filter(|r| (*r as usize) < regions.len())
        else {
            continue;
        };
        agreement.away += 1;
        let mut count = 1;
        sheet.others(pose, &joints, |_| count += 1);
        if count == regions[region as usize].solutions {
            agreement.agree += 1;
        } else {
            let (pose, region) = (pose.to_vec(), region as usize + 1);
            agreement.disagreements.push(Disagreement { pose, region, solutions: count, distance: None });
        }
    }
    agreement
}
