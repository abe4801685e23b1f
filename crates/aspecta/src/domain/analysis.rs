//! From an aspect to its domains.

use super::RegionId;
use super::grid::{Grid, Pose};
use super::images::Images;
use super::labels::{Labels, OUTSIDE};
use super::partition::{Partition, Region};
use super::result::*;
use super::sheet::Sheet;
use super::slice::Beyond;
use super::uniqueness::maximal_sets;
use crate::aspect::{Analysis, AspectId};
use crate::paving::Control;
use aspecta_robot::num::Random;
use aspecta_robot::{text, work};
use std::collections::BTreeSet;

/// Most nodes of a grid.
const MOST_NODES: usize = 200_000_000;

/// The basic regions, their images and the uniqueness domains of an aspect.
///
/// # Errors
/// [`DomainError`].
///
/// # Examples
/// ```
/// use aspecta::{AspectId, Budget, Control, DomainOptions, Options, Robot, analyze, domains};
///
/// # fn main() -> Result<(), aspecta::Error> {
/// let robot = Robot::resolve("five-bar")?;
/// let budget = Budget { depth: Some(7), ..Budget::default() };
/// let modes = vec!["++".parse()?];
/// let options = Options { budget, modes, ..Options::default() };
/// let analysis = analyze(&robot, &options, &Control::unwatched())?;
///
/// let options = DomainOptions { cells: 20, samples: 100 };
/// let found = domains(&analysis, AspectId::new(1), &options, &Control::unwatched())?;
/// assert!(!found.regions.is_empty() && !found.uniqueness.is_empty());
/// assert!(found.uniqueness[0].of_aspect <= 1.0);
/// assert!(domains(&analysis, AspectId::new(99), &options, &Control::unwatched()).is_err());
/// # Ok(())
/// # }
/// ```
pub fn domains(
    analysis: &Analysis,
    aspect: AspectId,
    options: &DomainOptions,
    control: &Control<'_>,
) -> Result<Domains, DomainError> {
    let whole = analysis.robot.workspace_window()?;
    let (Some(sheet), Some((class, found))) = (Sheet::new(analysis, aspect), analysis.aspect(aspect)) else {
        return Err(DomainError::NoAspect { id: aspect, count: analysis.aspects.low });
    };
    let grid = Grid::new(&analysis.window, &whole, &found.w_bounds, options.cells);
    if grid.len() > MOST_NODES {
        return Err(DomainError::TooFine { nodes: grid.len(), most: MOST_NODES });
    }
    let partition = Partition::new(&sheet, grid, control);
    let go_on = || if control.is_cancelled() { Err(DomainError::Cancelled) } else { Ok(()) };
    go_on()?;
    let all = partition.regions();
    let (regions, slivers) = all.split_at(all.iter().take_while(|region| region.is_resolved()).count());
    let cell = partition.labels.grid.measure();
    let measure_of = |regions: &[Region]| regions.iter().map(|r| r.nodes as f64 * cell).sum::<f64>();
    let between = partition.thin.len() as f64 * cell;
    let unresolved = Unresolved {
        parts: slivers.len() + parts(&partition.labels.grid, &partition.thin),
        measure: measure_of(slivers) + between,
    };
    let images = partition.images(&all);
    go_on()?;
    let adjacent = among(regions, partition.labels.adjacent());
    let beyond = Beyond::new(&sheet, &partition, regions, control).unwrap_or_default();
    let mut meeting = among(regions, images.meeting());
    meeting.extend(&beyond.coincident);
    let conflict = meeting.union(&beyond.undecided).copied().collect();
    let (uniqueness, complete) = uniqueness(analysis, &partition, regions, &adjacent, &conflict);
    let numbered = |pairs: &Pairs| pairs.iter().map(|&(a, b)| (number(a), number(b))).collect();
    let agreement = agreement(&sheet, &partition, regions, options.samples, control);
    go_on()?;
    let entry = &analysis.classes[class.index()];
    Ok(Domains {
        aspect,
        mode: entry.mode,
        det_a: entry.det_a,
        unit: analysis.measure.clone(),
        cell: partition.labels.grid.step[..partition.labels.grid.axes()].to_vec(),
        measure: measure_of(&all) + between,
        regions: regions.iter().enumerate().map(|(k, r)| basic_region(&partition, number(k), r)).collect(),
        adjacent: numbered(&adjacent),
        coincidences: coincidences(&images, &beyond, &meeting),
        joined: numbered(&beyond.joined),
        undecided: numbered(&beyond.undecided),
        uniqueness,
        complete: complete && partition.thin.is_empty(),
        unresolved,
        violations: violations(&sheet, &partition, &images, &beyond, regions.len()),
        agreement,
        failed: partition.failed,
        labels: partition.labels,
        window: analysis.window.clone(),
        pose: text::Labels::pose(&analysis.robot, false),
    })
}

/// Into how many parts some nodes fall, of which neighbours, diagonal ones too, are in one.
fn parts(grid: &Grid, nodes: &BTreeSet<usize>) -> usize {
    let mut left = nodes.clone();
    let mut parts = 0;
    while let Some(first) = left.pop_first() {
        parts += 1;
        let mut open = vec![first];
        while let Some(node) = open.pop() {
            grid.within(node, 1, |other| {
                if left.remove(&other) {
                    open.push(other);
                }
            });
        }
    }
    parts
}

/// The number of the region with this index.
fn number(index: usize) -> RegionId {
    RegionId::new(index + 1)
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
    conflict: &Pairs,
) -> (Vec<UniquenessDomain>, bool) {
    let (sets, complete) = maximal_sets(regions.len(), adjacent, conflict);
    let cell = partition.labels.grid.measure();
    let aspect = partition.solutions.iter().filter(|count| **count > 0).count() as f64 * cell;
    let workspace = workspace(analysis);
    let domain = |set: Vec<usize>| {
        let measure = set.iter().map(|&r| regions[r].nodes as f64 * cell).sum();
        UniquenessDomain {
            regions: set.into_iter().map(number).collect(),
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

fn basic_region(partition: &Partition, number: RegionId, region: &Region) -> BasicRegion {
    let grid = &partition.labels.grid;
    BasicRegion {
        number,
        measure: region.nodes as f64 * grid.measure(),
        solutions: region.solutions,
        pose: grid.pose(region.sample)[..grid.dof()].to_vec(),
    }
}

fn coincidences(images: &Images, beyond: &Beyond, meeting: &Pairs) -> Vec<Coincidence> {
    let meeting = meeting.iter().filter(|(a, b)| a != b);
    let entry = |pair: &(usize, usize)| {
        let (a, b) = *pair;
        let seen_on_the_slice = !beyond.coincident.contains(pair);
        let shares = seen_on_the_slice.then(|| (images.share(a, b), images.share(b, a)));
        Coincidence { regions: (number(a), number(b)), shares }
    };
    meeting.map(entry).collect()
}

fn violations(
    sheet: &Sheet<'_>,
    partition: &Partition,
    images: &Images,
    beyond: &Beyond,
    regions: usize,
) -> Vec<Violation> {
    let dof = partition.labels.grid.dof();
    let violation = |region: usize, [pose, twin]: [&[f64]; 2]| {
        let q = sheet.joints(pose)?[..dof].to_vec();
        Some(Violation { region: number(region), q, poses: [pose.to_vec(), twin.to_vec()] })
    };
    let on_grid = |region: usize| {
        let pose = partition.labels.grid.pose(images.within(region)?);
        let mut twin = None;
        sheet.others(&pose[..dof], &sheet.joints(&pose[..dof])?, |other| {
            if twin.is_none() && partition.labels.region_round(other) == Some(region as u32) {
                twin = Some(other.to_vec());
            }
        });
        violation(region, [&pose[..dof], &twin?])
    };
    let off_grid = beyond
        .twins
        .iter()
        .filter_map(|(region, [pose, twin])| violation(*region, [&pose[..dof], &twin[..dof]]));
    (0..regions).filter_map(on_grid).chain(off_grid).collect()
}

/// Compares the partition with the direct model at random poses; once cancelled, at no more.
fn agreement(
    sheet: &Sheet<'_>,
    partition: &Partition,
    regions: &[Region],
    samples: usize,
    control: &Control<'_>,
) -> Agreement {
    let poses = random_poses(&partition.labels, samples);
    let looked_at = |pose: &Pose| {
        let pose = &pose[..partition.labels.grid.dof()];
        let joints = sheet.joints(pose).filter(|_| !control.is_cancelled())?;
        let round = partition.labels.region_round(pose).map(|region| region as usize);
        let away = round.filter(|region| *region < regions.len()).map(|region| {
            let mut count = 1;
            sheet.others(pose, &joints, |_| count += 1);
            (region, count)
        });
        Some((pose.to_vec(), away))
    };
    let all: Vec<_> = work::flat_map(&poses, looked_at);
    let mut agreement = Agreement { samples: all.len(), ..Agreement::default() };
    for (pose, (region, solutions)) in all.into_iter().filter_map(|(pose, away)| Some((pose, away?))) {
        agreement.away += 1;
        if solutions == regions[region].solutions {
            agreement.agree += 1;
        } else {
            agreement.disagreements.push(Disagreement {
                pose,
                region: number(region),
                solutions,
                distance: None,
            });
        }
    }
    agreement
}

/// Poses drawn evenly from the cells of nodes of the aspect.
fn random_poses(labels: &Labels, count: usize) -> Vec<Pose> {
    let grid = &labels.grid;
    let inside: Vec<usize> = (0..grid.len()).filter(|&node| labels.region[node] != OUTSIDE).collect();
    let mut random = Random::new(0x9e37_79b9_7f4a_7c15);
    let mut draw = || {
        let mut pose = grid.pose(inside[(random.unit() * inside.len() as f64) as usize]);
        for axis in 0..grid.axes() {
            pose[grid.coordinate(axis)] += grid.step[axis] * (random.unit() - 0.5);
        }
        pose
    };
    (0..count).take_while(|_| !inside.is_empty()).map(|_| draw()).collect()
}
