//! Classification of eight boxes at once by intervals, in every working mode.

use super::ClassSet;
use super::MODES;
use super::share::{Known, Part, Share};
use super::tree::{Node, Paving};
use arrayvec::ArrayVec;
use aspecta_kinematics::chart::Chart;
use aspecta_kinematics::chart::Coordinates;
use aspecta_kinematics::constraints::{Configuration, Constraint, Kind};
use aspecta_kinematics::modal::{LegClosure, ModalRows};
use aspecta_kinematics::placement::Placement;
use aspecta_kinematics::{LegIndex, LegSet, WorkingMode};
use aspecta_robot::num::{Affine, Interval, LANES, Line, Mask, each};
use aspecta_robot::{Robot, Window};

/// One coordinate of the boxes of one level, for every index along it: computed once a level where the level
/// is well filled, so that no sine is evaluated in the inner loop.
#[derive(Clone, Copy)]
struct Slab {
    line: Line,
    /// (sin, cos); unused for lengths.
    turn: (Line, Line),
}

impl Slab {
    fn new(range: Interval, angle: bool) -> Self {
        let middle = range.mid();
        let radius = (range - Interval::point(middle)).magnitude();
        let line = Line::variable(middle, radius);
        Self { line, turn: if angle { Line::turn(middle, radius) } else { (line, line) } }
    }
}

/// Classifies the boxes of one level of a paving. D: dimension of space; N: degrees of freedom; M:
/// coordinates that vary.
pub(super) struct Classifier<'a, const D: usize, const N: usize, const M: usize> {
    robot: &'a Robot,
    modes: &'a [WorkingMode],
    /// The modes, one bit each, in which the sign of det A is known ([`Paving::known_sign`]) and nothing is asked of it.
    known: u8,
    twins: &'a [[LegIndex; 2]],
    chart: &'a Chart,
    /// The charts that cover part of this one.
    charts: &'a [Chart],
    window: &'a Window,
    depth: u32,
    /// Slabs by coordinate and index; a coordinate that does not vary has one, a level that is nearly empty
    /// has none.
    slabs: [Vec<Slab>; N],
    /// The coordinate each axis of the paving stands for.
    axes: [usize; M],
}

impl<'a, const D: usize, const N: usize, const M: usize> Classifier<'a, D, N, M> {
    /// Prepares to classify `boxes` boxes at `depth`.
    pub(super) fn new(
        robot: &'a Robot,
        paving: &'a Paving,
        charts: &'a [Chart],
        depth: u32,
        boxes: usize,
    ) -> Self {
        let mut axes = [0; M];
        axes.copy_from_slice(&paving.axes);
        let (modes, chart, window) = (&paving.modes, &paving.chart, &paving.window);
        let slabs = std::array::from_fn(|_| Vec::new());
        let is_known = |m: &usize| paving.known_sign(*m).is_some();
        let known = (0..modes.len()).filter(is_known).fold(0, |set, m| set | 1 << m);
        let mut classifier =
            Self { robot, modes, known, twins: &paving.twins, chart, charts, window, depth, slabs, axes };
        if boxes << 3 > 1 << depth {
            classifier.slabs = std::array::from_fn(|k| {
                let count = if axes.contains(&k) { 1 << depth } else { 1 };
                (0..count).map(|i| classifier.new_slab(k, i)).collect()
            });
        }
        classifier
    }

    fn new_slab(&self, k: usize, i: u32) -> Slab {
        let range = if self.axes.contains(&k) {
            Interval::new(
                self.window.grid_line(k, i, self.depth),
                self.window.grid_line(k, i + 1, self.depth),
            )
        } else {
            Interval::point(self.window.ranges[k].0)
        };
        Slab::new(range, self.window.angles[k])
    }

    fn slab(&self, k: usize, corner: &[u32; 3]) -> Slab {
        let i = self.axes.iter().position(|&axis| axis == k).map_or(0, |a| corner[a]);
        match self.slabs[k].get(i as usize) {
            Some(slab) => *slab,
            None => self.new_slab(k, i),
        }
    }

    /// Classifies eight boxes given by their corners; each inherits what its parent proved and has
    /// `inside`, `undecided` and `closed` set.
    pub(super) fn classify(&self, boxes: &mut [Node; LANES]) {
        let (placement, legs) = self.over(boxes);
        self.decide(boxes, &placement, &legs);
    }

    /// How much of each of eight boxes certainly lies in each class that is undecided there, and how much certainly does not.
    pub(super) fn shares(&self, boxes: &[Node; LANES]) -> [[Share; 2 * MODES]; LANES] {
        let (placement, legs) = self.over(boxes);
        let mut shares = [[Share::default(); 2 * MODES]; LANES];
        let wanted = boxes.iter().fold(0, |wanted, node| wanted | modes_of(node.undecided));
        let (closes, out) = closing::<Part, D, N, M>(&legs);
        let heights: [[_; 2]; N] = std::array::from_fn(|j| legs[j].heights());
        let known = self.existence(wanted, closes, (&placement, &legs, &heights));
        self.signs(wanted, boxes, (&placement, &legs, &heights), |m, [positive, negative]: [Part; 2]| {
            let (kept, broken) = (known.kept[m], known.broken[m].or(out));
            for (class, [with, against]) in
                [[positive, negative], [negative, positive]].into_iter().enumerate()
            {
                let (inside, outside) = (kept.and(with), broken.or(against));
                for (l, shares) in shares.iter_mut().enumerate() {
                    shares[2 * m + class] =
                        Share { inside: inside.0[l] as f32, outside: outside.0[l] as f32 };
                }
            }
        });
        shares
    }

    /// The robot over eight boxes.
    fn over(&self, boxes: &[Node; LANES]) -> (Placement<Affine<M>, D>, [LegClosure<Affine<M>, D>; N]) {
        let slabs: [[Slab; LANES]; N] =
            std::array::from_fn(|k| std::array::from_fn(|l| self.slab(k, &boxes[l].corner)));
        // What does not vary has no extent, along whatever axis.
        let axis = |k: usize| self.axes.iter().position(|&axis| axis == k).unwrap_or(0);
        let of = |k: usize, line: fn(&Slab) -> Line| Affine::<M>::along(axis(k), |l| line(&slabs[k][l]));
        let y: [_; N] = each!(|k| of(k, |slab| slab.line));
        self.chart
            .at::<Affine<M>, D, N>(self.robot, &y, |k| (of(k, |slab| slab.turn.0), of(k, |slab| slab.turn.1)))
    }

    fn decide(
        &self,
        boxes: &mut [Node; LANES],
        placement: &Placement<Affine<M>, D>,
        legs: &[LegClosure<Affine<M>, D>; N],
    ) {
        let (closes, out) = closing::<Mask, D, N, M>(legs);
        let mut wanted: u8 = 0;
        for (node, out) in boxes.iter_mut().zip(out) {
            if out {
                (node.undecided, node.closed) = (0, 0);
            }
            wanted |= modes_of(node.undecided);
        }
        if wanted == 0 {
            return;
        }
        for (k, chart) in self.charts.iter().enumerate() {
            let covers: ArrayVec<(Mask, Mask), 4> = chart
                .cover(self.robot, legs)
                .into_iter()
                .map(|margin| margin.range())
                .map(|margin| (margin.positive(), margin.negative()))
                .collect();
            for (l, node) in boxes.iter_mut().enumerate() {
                node.covered |= covers.iter().all(|(positive, _)| positive[l]);
                if covers.iter().any(|(_, negative)| negative[l]) {
                    node.partly &= !(1 << k);
                }
            }
        }
        let heights: [[_; 2]; N] = std::array::from_fn(|j| legs[j].heights());
        let known = self.existence(wanted, closes, (placement, legs, &heights));
        let undecided = *boxes;
        self.signs(wanted, &undecided, (placement, legs, &heights), |m, [positive, negative]: [Mask; 2]| {
            for l in 0..LANES {
                boxes[l].settle(m, known.kept[m][l], known.broken[m][l], positive[l], negative[l]);
            }
        });
    }

    /// How far each wanted mode exists, where its legs close and in spite of its limits.
    fn existence<K: Known>(
        &self,
        wanted: u8,
        closes: K,
        (placement, legs, heights): OfRobot<'_, D, N, M>,
    ) -> ByMode<K> {
        let mut known = ByMode { kept: [closes; MODES], broken: [K::NOWHERE; MODES] };
        for constraint in Constraint::of(self.robot) {
            match constraint.kind() {
                // Looked at in poses already; in a leg's own coordinates being in the posture is one of its
                // limits.
                Kind::Serial(j) => {
                    let Some(fold) = &legs[j.index()].fold else { continue };
                    let in_posture =
                        |mode: WorkingMode| if mode.sign(j.index()) > 0 { fold.b } else { -fold.b };
                    known.note(self.modes, wanted, LegSet::of(j), in_posture);
                }
                Kind::Limit => {
                    let at = |mode| Configuration { robot: self.robot, placement, legs, heights, mode };
                    let margin = |mode| match constraint {
                        // Most bodies are far apart.
                        Constraint::Apart(_, k) => {
                            let bodies = at(mode).bodies(k);
                            let far = bodies.margin_of_surroundings();
                            if far.range().positive() == [true; LANES] { far } else { bodies.margin() }
                        }
                        Constraint::Limit(..)
                        | Constraint::RodAngle(..)
                        | Constraint::Reach(_)
                        | Constraint::Det => at(mode).margin(constraint),
                    };
                    known.note(self.modes, wanted, constraint.postures(), margin);
                }
                // Follows, for all modes at once.
                Kind::Parallel => {}
            }
        }
        known
    }

    /// Visits each wanted mode with how far det A is positive in it, and how far negative.
    fn signs<K: Known>(
        &self,
        wanted: u8,
        boxes: &[Node; LANES],
        (_, legs, heights): OfRobot<'_, D, N, M>,
        mut visit: impl FnMut(usize, [K; 2]),
    ) {
        let rows = ModalRows::parted(self.robot, self.twins, legs, each!(|j| heights[j][0]));
        let of_one_sign = wanted & self.known;
        for m in (0..self.modes.len()).filter(|m| of_one_sign >> m & 1 == 1) {
            let sign = |bit: ClassSet| {
                K::where_all(std::array::from_fn(|l| boxes[l].undecided >> (2 * m) & bit != 0))
            };
            visit(m, [sign(1), sign(2)]);
        }
        rows.dets(self.modes, wanted & !self.known, |m, det| {
            let [mut positive, mut negative] = K::signs(&det);
            let open = |l: usize| boxes[l].undecided >> (2 * m) & 3 != 0;
            if N > 3 && (0..LANES).any(|l| open(l) && !K::is_all(&positive, l) && !K::is_all(&negative, l)) {
                let [also_positive, also_negative] = K::signs(&rows.conditioned_det(self.modes[m]));
                (positive, negative) = (positive.or(also_positive), negative.or(also_negative));
            }
            visit(m, [positive, negative]);
        });
    }
}

/// The placement of the platform, the legs and their heights over eight boxes.
type OfRobot<'a, const D: usize, const N: usize, const M: usize> =
    (&'a Placement<Affine<M>, D>, &'a [LegClosure<Affine<M>, D>; N], &'a [[Affine<M>; 2]; N]);

/// How far all legs close, and how far one of them surely does not.
fn closing<K: Known, const D: usize, const N: usize, const M: usize>(
    legs: &[LegClosure<Affine<M>, D>; N],
) -> (K, K) {
    let mut all = (K::EVERYWHERE, K::NOWHERE);
    // A strut closes everywhere (its H is q², zero only on a set that separates nothing).
    for leg in legs.iter().filter(|leg| leg.fold.is_none()) {
        let [positive, negative] = K::signs(&leg.closure.reach);
        all = (all.0.and(positive), all.1.or(negative));
    }
    all
}

/// What is proved of the existence of each mode, eight boxes at once.
struct ByMode<K> {
    /// How far all legs close and all limits are kept.
    kept: [K; MODES],
    /// How far some limit is broken.
    broken: [K; MODES],
}

impl<K> ByMode<K> {
    /// Takes account of a function that is positive within a limit, for the modes wanted; it is evaluated
    /// once for each choice of postures of the legs on which it depends.
    fn note<const M: usize>(
        &mut self,
        modes: &[WorkingMode],
        wanted: u8,
        legs: LegSet,
        function: impl Fn(WorkingMode) -> Affine<M>,
    ) where
        K: Known,
    {
        let mut left = wanted;
        while left != 0 {
            let mode = modes[left.trailing_zeros() as usize];
            let [positive, negative] = K::signs(&function(mode));
            let now = left;
            for m in (0..modes.len()).filter(|&m| now >> m & 1 == 1 && legs.are_alike(mode, modes[m])) {
                left &= !(1 << m);
                self.kept[m] = self.kept[m].and(positive);
                self.broken[m] = self.broken[m].or(negative);
            }
        }
    }
}

/// The modes that have a class in the set.
fn modes_of(classes: ClassSet) -> u8 {
    (0..8).filter(|m| classes >> (2 * m) & 3 != 0).fold(0, |set, m| set | 1 << m)
}

impl Node {
    /// Records what is proved of mode `m` here: that it exists all over the box, or nowhere; the sign of det
    /// A.
    fn settle(&mut self, m: usize, exists: bool, nowhere: bool, positive: bool, negative: bool) {
        let both: ClassSet = 3 << (2 * m);
        let open = self.undecided & both;
        let plus: ClassSet = 1 << (2 * m);
        let minus = plus << 1;
        self.closed |= u8::from(exists) << m;
        let signed = if positive {
            plus
        } else if negative {
            minus
        } else {
            both
        };
        let left = if nowhere { 0 } else { open & signed };
        self.undecided = (self.undecided & !both) | left;
        if exists && left.count_ones() == 1 && (positive || negative) {
            self.inside |= left;
            self.undecided &= !left;
        }
    }
}
