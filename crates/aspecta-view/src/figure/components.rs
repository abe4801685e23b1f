//! Basic components (Definition 11): what lies over joint vectors.
//!
//! *Numerical*: the number of direct solutions at a joint vector is that of the direct model; which regions
//! they lie in is true to a cell of the regions' grid.

use super::axes::Axis;
use super::barrier::Barriers;
use super::cut::Cut;
use super::hues::Hues;
use super::level::{Grid, edges};
use super::raster::Raster;
use super::section::Mesh;
use super::survey::joint_axis;
use aspecta::domain::boundary::Simplex;
use aspecta::domain::{OUTSIDE, Sheet};
use aspecta::num::without_turns;
use aspecta::robot::{Leg, LegIndex};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

/// About how many nodes are asked for their joint vectors to find the range of these.
const SAMPLES: usize = 100_000;
/// Angles are shown all round unless none of them lies in an arc as wide as this.
const FREE: f64 = PI / 3.0;
/// Of angles shown all round, the circle is cut in the emptiest of so many sectors.
const SECTORS: usize = 24;
/// How finely lines are found.
const HALVINGS: u32 = 10;
/// At a folded leg (C = A) its joint is free: pieces of the boundary that are mapped this wide are not drawn,
/// but the change of n is.
const WIDE: f64 = PI / 3.0;
/// Room round the image, as a share of its width.
const MARGIN: f64 = 0.02;

/// The joint space of an aspect, or planes of it: of three joints one is held.
pub struct JointSpace<'a> {
    /// The aspect.
    pub cut: &'a Cut<'a>,
    pub(super) hues: Hues,
    sheet: Sheet<'a>,
    /// Which joints are drawn, from 0: across and up; and the one held.
    joints: [usize; 3],
    /// The first two.
    pub axes: [Axis; 2],
    /// The joint held, if there are three.
    pub held: Option<Axis>,
    /// The joint vectors of the vertices of the boundary, and its pieces but for those at a folded leg.
    boundary: (Vec<[f64; 3]>, Vec<Simplex>),
}

/// The sets of regions that lie over the joint vectors of a plane.
#[derive(Clone, Debug)]
pub struct Section {
    /// Per pixel, which of `sets` lies over it.
    pub raster: Raster<u32>,
    /// Regions (from 0) that direct solutions lie in, one entry a solution; [`OUTSIDE`] for those of which it
    /// cannot be told.
    pub sets: Vec<Vec<u32>>,
}

impl<'a> JointSpace<'a> {
    /// The joint space of an aspect; `None` for one of a slice. `held` is the joint to hold, by its leg,
    /// if there are three.
    pub fn new(cut: &'a Cut<'a>, held: LegIndex) -> Option<Self> {
        let Cut { map, domains, boundary, .. } = *cut;
        let robot = &map.robot;
        if map.window.held().next().is_some() {
            return None;
        }
        let sheet = map.sheet(domains.aspect)?;
        let joints = match (robot.dof(), held.index()) {
            (2, _) => [0, 1, 2],
            (_, held) => [usize::from(held == 0), 2 - usize::from(held == 2), held],
        };
        let chosen = |q: &[f64]| joints.map(|j| q.get(j).copied().unwrap_or(0.0));
        let on = |pose: &Vec<f64>| chosen(&Barriers::at(robot, domains.mode, pose).q);
        let vertices: Vec<[f64; 3]> = boundary.vertices.iter().map(on).collect();
        let angles = [0, 1, 2].map(|k| robot.legs.get(joints[k]).is_some_and(|leg| leg.actuator.is_angle()));
        let is_narrow = |simplex: &&Simplex| {
            let [a, b, c] = simplex.corners.map(|v| vertices[v as usize]);
            let near = |p: [f64; 3], q: [f64; 3]| {
                (0..3).all(|k| !angles[k] || without_turns(p[k] - q[k]).abs() < WIDE)
            };
            near(a, b) && near(b, c) && near(c, a)
        };
        let pieces = boundary.simplices.iter().filter(is_narrow).copied().collect();
        let grid = &domains.labels.grid;
        let nodes: Vec<usize> =
            (0..grid.len()).filter(|&node| domains.labels.region[node] != OUTSIDE).collect();
        let some: Vec<usize> = nodes.iter().copied().step_by(1 + nodes.len() / SAMPLES).collect();
        let inside: Vec<[f64; 3]> = some
            .par_iter()
            .filter_map(|&node| sheet.joints(&grid.pose(node)[..grid.dof()]).map(|q| chosen(&q)))
            .collect();
        let axis = |k: usize| {
            let values = inside.iter().chain(&vertices).map(|q| q[k]).collect();
            joint_axis(robot, joints[k], range(values, &robot.legs[joints[k]]))
        };
        Some(Self {
            hues: Hues::new(domains),
            axes: [axis(0), axis(1)],
            held: (robot.dof() == 3).then(|| axis(2)),
            cut,
            sheet,
            joints,
            boundary: (vertices, pieces),
        })
    }

    /// The image of the boundary.
    pub(super) fn boundary(&self) -> Mesh<'_> {
        Mesh {
            vertices: self.boundary.0.iter().map(|q| &q[..]).collect(),
            simplices: &self.boundary.1,
            turns: [0, 1].map(|k| self.axes[k].angle),
        }
    }

    /// Returns the regions over the plane in which the fixed joint, if there is one, is `at`, with `pixels` a
    /// side, two at least.
    pub fn section(&self, at: f64, pixels: usize) -> Section {
        let centres = self.centres(pixels);
        let over = |pixel: usize| self.over(centres.node(pixel % pixels, pixel / pixels), at);
        let all: Vec<Vec<u32>> = (0..pixels * pixels).into_par_iter().map(over).collect();
        let mut numbers: BTreeMap<&[u32], u32> = BTreeMap::new();
        for set in &all {
            let next = numbers.len() as u32;
            numbers.entry(set).or_insert(next);
        }
        let raster = Raster::from_fn(pixels, pixels, |c, r| numbers[&all[c + pixels * r][..]]);
        let mut sets = vec![Vec::new(); numbers.len()];
        numbers.into_iter().for_each(|(set, number)| sets[number as usize] = set.to_vec());
        Section { raster, sets }
    }

    /// The centres of the pixels.
    fn centres(&self, pixels: usize) -> Grid {
        let inner = |axis: &Axis| {
            let half = 0.5 * axis.span() / pixels as f64;
            (axis.range.0 + half, axis.range.1 - half)
        };
        Grid { x: inner(&self.axes[0]), y: inner(&self.axes[1]), n: pixels - 1 }
    }

    /// The lines in a section on which the number of direct solutions changes, to a thousandth of a pixel.
    pub fn changes(&self, section: &Section, at: f64) -> Vec<Vec<[f64; 2]>> {
        let pixels = section.raster.size().0;
        let count =
            |pixel: usize| section.sets[section.raster.at(pixel % pixels, pixel / pixels) as usize].len();
        let counts: Vec<usize> = (0..pixels * pixels).map(count).collect();
        let most = counts.iter().copied().max().unwrap_or(0);
        let lines = |least: usize| {
            let nodes: Vec<bool> = counts.iter().map(|count| *count >= least).collect();
            let is_in = |shown| self.sheet.poses(&self.joints_at(shown, at)).len() >= least;
            edges(&self.centres(pixels), &nodes, is_in, HALVINGS)
        };
        (1..=most).into_par_iter().flat_map_iter(lines).collect()
    }

    /// The joint vector at a place.
    fn joints_at(&self, [across, up]: [f64; 2], at: f64) -> [f64; 6] {
        let mut q = [0.0; 6];
        self.joints.iter().zip([across, up, at]).for_each(|(&joint, value)| q[joint] = value);
        q
    }

    /// The regions of the direct solutions in the aspect at a place.
    fn over(&self, shown: [f64; 2], at: f64) -> Vec<u32> {
        let poses = self.sheet.poses(&self.joints_at(shown, at));
        let known = |region: &u32| {
            let regions = &self.cut.domains.regions;
            regions.get(*region as usize).is_some_and(|r| usize::from(r.solutions) == poses.len())
        };
        // All lie in one group: where one pose is amid its region, it says which.
        let labels = &self.cut.domains.labels;
        let round = |pose: &[f64; 6]| labels.region_round(&pose[..labels.grid.dof()]).filter(known);
        let group = poses.iter().find_map(round).map(|region| self.hues.group(region as usize));
        let fit = |region: &u32| {
            known(region) && group.is_none_or(|group| self.hues.group(*region as usize) == group)
        };
        let mut set: Vec<u32> = poses.iter().map(|pose| self.region(pose, fit)).collect();
        set.sort_unstable();
        set
    }

    /// The region of a pose: that of the nearest node round it in a region that fits.
    fn region(&self, pose: &[f64; 6], fit: impl Fn(&u32) -> bool) -> u32 {
        let labels = &self.cut.domains.labels;
        let grid = &labels.grid;
        let mut nearest = (f64::INFINITY, OUTSIDE);
        grid.around(&pose[..grid.dof()], |node| {
            let at = grid.turned_to(pose, node);
            let gap: f64 = (0..grid.axes()).map(|k| ((at[k] - pose[k]) / grid.step[k]).powi(2)).sum();
            if gap < nearest.0 && fit(&labels.region[node]) {
                nearest = (gap, labels.region[node]);
            }
        });
        nearest.1
    }

    /// The group of regions that a set belongs to; `None` if it cannot be told.
    pub(super) fn group(&self, set: &[u32]) -> Option<usize> {
        set.iter().find(|region| **region != OUTSIDE).map(|region| self.hues.group(*region as usize))
    }
}

/// The range of values of the joint of a leg.
fn range(mut values: Vec<f64>, leg: &Leg) -> (f64, f64) {
    values.sort_unstable_by(f64::total_cmp);
    let (Some(&first), Some(&last)) = (values.first(), values.last()) else { return (0.0, 1.0) };
    if !leg.actuator.is_angle() {
        let margin = MARGIN * if last > first { last - first } else { 1.0 };
        return (first - margin, last + margin);
    }
    let next = values.iter().skip(1).copied().chain([first + TAU]);
    let gaps = values.iter().zip(next).map(|(a, b)| (b - a, b));
    let (gap, start) = gaps.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, -PI));
    if gap < FREE {
        let mut counts = [0; SECTORS];
        let sector = |angle: &f64| ((angle + PI).rem_euclid(TAU) / TAU * SECTORS as f64) as usize % SECTORS;
        values.iter().for_each(|angle| counts[sector(angle)] += 1);
        let cut = (0..SECTORS).min_by_key(|&k| counts[k]).unwrap_or(0);
        // In its middle, so that sections are not at multiples of a right angle, where robots are special.
        let start = -PI + TAU * (cut as f64 + 0.5) / SECTORS as f64;
        return leg.drive_range().unwrap_or((start, start + TAU));
    }
    let half = 0.5 * (1.0 + 2.0 * MARGIN) * (TAU - gap);
    let middle = leg.in_range(without_turns(start + 0.5 * (TAU - gap)));
    let (least, most) = leg.drive_range().unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
    ((middle - half).max(least), (middle + half).min(most))
}
