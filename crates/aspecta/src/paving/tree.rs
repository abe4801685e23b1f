//! The tree of boxes.

use aspecta_kinematics::AgileEye;
use aspecta_kinematics::chart::Chart;
use aspecta_robot::WorkingMode;
use aspecta_robot::num::Interval;
use aspecta_robot::{ClassSet, LegIndex, Window};
use std::collections::BTreeMap;

/// A box: cell `corner` of the grid window / 2^depth.
///
/// A class is *inside* (the closed box lies in S_{s,σ}, proved), *undecided*, or neither: outside
/// (the closed box and S_{s,σ} are disjoint, proved). What a box proves its children inherit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Node {
    /// Index of the first of its 2^M children, which lie next to each other; 0 for a leaf.
    pub first_child: u32,
    /// Grid coordinates at the box's depth.
    pub corner: [u32; 3],
    /// Classes the box lies inside of.
    pub inside: ClassSet,
    /// Classes that are undecided.
    pub undecided: ClassSet,
    /// Classes that have no summit here: no aspect of the class is highest in this box, proved
    /// (`docs/theory.md`, 5).
    pub summitless: ClassSet,
    /// Modes (one bit each) that exist all over the box: every H_j > 0 and every limit kept, proved.
    pub closed: u8,
    /// Subdivisions of the window that lead to this box.
    pub depth: u8,
    /// Whether the chart of a fold covers all configurations of the box.
    pub covered: bool,
    /// Charts that cover part of this one (one bit each, in their order) and may hold some configurations of
    /// the box.
    pub partly: u16,
}

/// The classification of a node with respect to a set of poses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// The closed box lies in the set: proved.
    Inside,
    /// The closed box and the set are disjoint: proved.
    Outside,
    /// Neither is known of the box as a whole.
    Open,
}

impl Node {
    /// S_{s,σ} of a class (one bit), or the union over several classes.
    pub fn of_classes(&self, classes: ClassSet) -> Mark {
        if self.inside & classes != 0 {
            Mark::Inside
        } else if self.undecided & classes != 0 {
            Mark::Open
        } else {
            Mark::Outside
        }
    }

    /// The poses at which mode `m` exists, whatever det A is.
    pub fn of_mode(&self, m: usize) -> Mark {
        if self.closed >> m & 1 == 1 {
            Mark::Inside
        } else if self.undecided >> (2 * m) & 3 != 0 {
            Mark::Open
        } else {
            Mark::Outside
        }
    }
}

/// A box in pose coordinates: lower and upper corner.
pub type BoxOf = ([f64; 3], [f64; 3]);

/// A window cut into boxes: a tree whose every node has 2^M children or none, M = 1, 2 or 3 being the number
/// of coordinates that vary.
#[derive(Clone, Debug)]
pub struct Paving {
    /// The coordinates that are subdivided.
    pub chart: Chart,
    /// The box of coordinates that was paved.
    pub window: Window,
    /// The M coordinates that vary.
    pub axes: Vec<usize>,
    /// The modes, in the order of the class bits.
    pub modes: Vec<WorkingMode>,
    /// The legs that are one and the same ([`Robot::twins`](aspecta_robot::Robot::twins)). Where both are in one posture det A vanishes
    /// identically, and nothing is asked of it: the poses at which such a mode exists are in its first class, and none are in its second.
    pub twins: Vec<[LegIndex; 2]>,
    /// The robot as an Agile Eye, if it is one: then det A keeps one sign in each mode, and the classes of the other are empty.
    pub eye: Option<AgileEye>,
    /// All nodes, children after their parents. Node 0 is the window.
    pub nodes: Vec<Node>,
    /// Depth of the finest nodes.
    pub depth: u32,
    /// Boxes classified.
    pub boxes: u64,
    /// Why the refinement ended.
    pub stop: super::Stop,
}

impl Paving {
    /// Depth of the node with this index.
    pub fn depth_of(&self, node: u32) -> u32 {
        self.nodes[node as usize].depth.into()
    }

    /// Nodes, depth by depth, those of one depth in the order given.
    pub(super) fn by_depth(&self, nodes: impl Iterator<Item = u32>) -> BTreeMap<u32, Vec<u32>> {
        let mut by_depth = BTreeMap::<u32, Vec<u32>>::new();
        nodes.for_each(|node| by_depth.entry(self.depth_of(node)).or_default().push(node));
        by_depth
    }

    /// The larger of two boxes, the first of two equal ones.
    pub fn larger(&self, a: u32, b: u32) -> u32 {
        std::cmp::min((self.depth_of(a), a), (self.depth_of(b), b)).1
    }

    /// Length, area or volume of a box of depth `depth`, over the coordinates that vary.
    pub fn measure(&self, depth: u32) -> f64 {
        let whole: f64 =
            self.axes.iter().map(|&k| self.window.ranges[k].1 - self.window.ranges[k].0).product();
        // 2^(M depth) is beyond whole numbers of 64 bits from depth 22 on.
        whole / f64::powi(2.0, self.axes.len() as i32 * depth as i32)
    }

    /// Lower and upper corner in the pose coordinates that vary (unused entries 0).
    pub fn bounds(&self, node: u32) -> BoxOf {
        let depth = self.depth_of(node);
        let corner = self.nodes[node as usize].corner;
        let (mut lo, mut hi) = ([0.0; 3], [0.0; 3]);
        for (a, k) in self.axes.iter().copied().enumerate() {
            lo[a] = self.window.grid_line(k, corner[a], depth);
            hi[a] = self.window.grid_line(k, corner[a] + 1, depth);
        }
        (lo, hi)
    }

    /// The ranges of all coordinates over a box; those that do not vary have their fixed value.
    pub fn extent(&self, node: u32) -> Vec<Interval> {
        let (lo, hi) = self.bounds(node);
        let mut ranges: Vec<Interval> = self.window.ranges.iter().map(|r| Interval::point(r.0)).collect();
        for (a, &k) in self.axes.iter().enumerate() {
            ranges[k] = Interval::new(lo[a], hi[a]);
        }
        ranges
    }

    /// The pose at the centre of a box; coordinates that do not vary have their fixed value.
    pub fn centre(&self, node: u32) -> Vec<f64> {
        let (lo, hi) = self.bounds(node);
        let mut pose: Vec<f64> = self.window.ranges.iter().map(|r| r.0).collect();
        for (a, k) in self.axes.iter().copied().enumerate() {
            pose[k] = 0.5 * (lo[a] + hi[a]);
        }
        pose
    }

    /// The children of a node, first to last.
    pub fn children(&self, node: u32) -> std::ops::Range<u32> {
        match self.nodes[node as usize].first_child {
            0 => 0..0,
            first => first..first + (1 << self.axes.len()),
        }
    }

    /// Whether det A vanishes identically in mode `m`.
    pub fn vanishes_in(&self, m: usize) -> bool {
        let sign = |leg: &LegIndex| self.modes[m].sign(leg.index());
        self.twins.iter().any(|[i, j]| sign(i) == sign(j))
    }

    /// The sign that det A is known to have all over mode `m`. Where it vanishes identically what there is of the mode is in its first
    /// class.
    pub fn known_sign(&self, m: usize) -> Option<i8> {
        if self.vanishes_in(m) { Some(1) } else { self.eye.map(|eye| eye.sign_of_det_a(self.modes[m])) }
    }

    /// The classes of the modes in which det A vanishes identically.
    pub fn vanishing(&self) -> ClassSet {
        (0..self.modes.len()).filter(|&m| self.vanishes_in(m)).fold(0, |set, m| set | 3 << (2 * m))
    }

    /// Puts all poses outside the classes of modes in which det A vanishes identically: they have no aspects.
    pub(crate) fn leave_vanishing(&mut self) {
        let vanishing = self.vanishing();
        for node in &mut self.nodes {
            node.inside &= !vanishing;
            node.undecided &= !vanishing;
        }
    }

    /// Visits the boxes of a set that are not outside it: the coarsest ones inside it, and leaves in which it
    /// is undecided. In the order of the tree, depth first.
    pub fn boxes_of(&self, classify: &impl Fn(&Node) -> Mark, visit: &mut impl FnMut(u32)) {
        self.walk(0, classify, visit);
    }

    fn walk(&self, at: u32, classify: &impl Fn(&Node) -> Mark, visit: &mut impl FnMut(u32)) {
        match classify(&self.nodes[at as usize]) {
            Mark::Outside => {}
            Mark::Inside => visit(at),
            Mark::Open if self.nodes[at as usize].first_child == 0 => visit(at),
            Mark::Open => self.children(at).for_each(|child| self.walk(child, classify, visit)),
        }
    }

    /// Visits the boxes of a set (as in [`Paving::boxes_of`]) that may share a point with a box of poses,
    /// modulo full turns where these are glued.
    pub fn meeting(
        &self,
        classify: &impl Fn(&Node) -> Mark,
        poses: &[Interval],
        visit: &mut impl FnMut(u32),
    ) {
        self.descend(0, classify, poses, visit);
    }

    fn descend(
        &self,
        at: u32,
        classify: &impl Fn(&Node) -> Mark,
        poses: &[Interval],
        visit: &mut impl FnMut(u32),
    ) {
        let (lo, hi) = self.bounds(at);
        let meets = self.on_all_axes(poses, |a, x| x.lo <= hi[a] && lo[a] <= x.hi);
        if !meets {
            return;
        }
        match classify(&self.nodes[at as usize]) {
            Mark::Outside => {}
            Mark::Open if self.nodes[at as usize].first_child != 0 => {
                self.children(at).for_each(|child| self.descend(child, classify, poses, visit));
            }
            Mark::Open | Mark::Inside => visit(at),
        }
    }

    /// Whether all the poses lie in a box, modulo full turns where these are glued.
    pub fn holds(&self, node: u32, poses: &[Interval]) -> bool {
        let (lo, hi) = self.bounds(node);
        self.on_all_axes(poses, |a, x| lo[a] <= x.lo && x.hi <= hi[a])
    }

    /// Whether `holds` is true of the range of a box along every axis, modulo full turns where the axis is
    /// periodic.
    fn on_all_axes(&self, ranges: &[Interval], holds: impl Fn(usize, Interval) -> bool) -> bool {
        let turn = Interval::PI * Interval::point(2.0);
        self.axes.iter().enumerate().all(|(a, &k)| {
            let x = ranges[k];
            holds(a, x) || self.window.glued[k] && (holds(a, x + turn) || holds(a, x - turn))
        })
    }

    /// The box (as in [`Paving::boxes_of`], or one outside the set) that holds the pose, and whether the pose
    /// lies in it by more than rounding, so that it surely holds it. `None` outside the window, and off the
    /// slice if coordinates are held.
    pub fn find(&self, classify: &impl Fn(&Node) -> Mark, pose: &[f64]) -> Option<(u32, bool)> {
        self.descend_to(pose, &mut |at| classify(&self.nodes[at as usize]) != Mark::Open)
    }

    /// The first box on the way down to the pose at which `stop` holds, or the leaf, as in [`Paving::find`].
    pub fn descend_to(&self, pose: &[f64], stop: &mut impl FnMut(u32) -> bool) -> Option<(u32, bool)> {
        let mut unit = [0.0; 3];
        for (k, &x) in pose.iter().enumerate() {
            let fraction = self.window.fraction(k, x)?;
            if let Some(a) = self.axes.iter().position(|&axis| axis == k) {
                unit[a] = fraction;
            }
        }
        let unit = &unit[..self.axes.len()];
        let (mut at, mut depth) = (0, 0);
        loop {
            let node = &self.nodes[at as usize];
            let cells = (1u64 << depth) as f64;
            if node.first_child == 0 || stop(at) {
                // Positions are off by some 1e-15 of the window, boxes are at least 1e-8 of it wide.
                let surely = unit.iter().zip(node.corner).all(|(u, i)| {
                    let within = u * cells - f64::from(i);
                    (1e-6..=1.0 - 1e-6).contains(&within)
                });
                return Some((at, surely));
            }
            depth += 1;
            let bit = |u: &f64| (((u * 2.0 * cells) as u64).min((1 << depth) - 1) & 1) as u32;
            let child = unit.iter().enumerate().fold(0, |child, (a, u)| child | bit(u) << a);
            at = node.first_child + child;
        }
    }
}
