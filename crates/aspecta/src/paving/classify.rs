//! What intervals prove of eight boxes at once, in every working mode.

use super::tree::{ClassSet, Node};
use crate::kinematics::WorkingMode;
use crate::kinematics::limits::{LegAt, margin};
use crate::kinematics::modal::{LegClosure, ModalRows, closures};
use crate::kinematics::placement::Placement;
use crate::num::{Interval, LANES, Mask, Pack, Scalar, Slope, each};
use crate::robot::{Robot, Window};

/// One coordinate of the boxes of one level, for every index along it: computed once a level, so that no sine is
/// evaluated in the inner loop.
#[derive(Clone, Copy)]
struct Slab {
    range: Interval,
    middle: Interval,
    /// (sin, cos) over the range and at the middle; unused for lengths.
    turn: (Interval, Interval),
    turn_middle: (Interval, Interval),
}

impl Slab {
    fn new(range: Interval, angle: bool) -> Self {
        let middle = Interval::point(range.mid());
        let zero = (Interval::point(0.0), Interval::point(0.0));
        let (turn, turn_middle) = if angle { (range.sin_cos(), middle.sin_cos()) } else { (zero, zero) };
        Self { range, middle, turn, turn_middle }
    }
}

/// Classifies the boxes of one level of a paving. D: dimension of space; N: degrees of freedom; M: coordinates
/// that vary.
pub(super) struct Classifier<'a, const D: usize, const N: usize, const M: usize> {
    robot: &'a Robot,
    modes: &'a [WorkingMode],
    /// Slabs of the coordinates that vary, by index, and of the others, alone.
    slabs: [Vec<Slab>; N],
    /// The coordinate each axis of the paving stands for.
    axes: [usize; M],
    /// Upper bounds of the distance from a box's middle to its ends, per axis.
    radius: [f64; M],
}

impl<'a, const D: usize, const N: usize, const M: usize> Classifier<'a, D, N, M> {
    pub(super) fn new(robot: &'a Robot, modes: &'a [WorkingMode], window: &Window, depth: u32) -> Self {
        let mut axes = [0; M];
        axes.copy_from_slice(&window.axes());
        let slabs: [Vec<Slab>; N] = std::array::from_fn(|k| {
            let count = if axes.contains(&k) { 1 << depth } else { 1 };
            let line = |i| if count == 1 { window.ranges[k].0 } else { window.grid_line(k, i, depth) };
            (0..count).map(|i| Slab::new(Interval::new(line(i), line(i + 1)), window.angles[k])).collect()
        });
        let radius =
            axes.map(|k| slabs[k].iter().map(|s| (s.range - s.middle).magnitude()).fold(0.0, f64::max));
        Self { robot, modes, slabs, axes, radius }
    }

    fn slab(&self, k: usize, corner: &[u32; 3]) -> &Slab {
        match self.axes.iter().position(|&axis| axis == k) {
            Some(a) => &self.slabs[k][corner[a] as usize],
            None => &self.slabs[k][0],
        }
    }

    /// Classifies eight boxes given by their corners; each inherits what its parent proved and has
    /// `inside`, `undecided` and `closed` set.
    pub(super) fn classify(&self, boxes: &mut [Node; LANES]) {
        let slabs: [[&Slab; LANES]; N] =
            std::array::from_fn(|k| std::array::from_fn(|l| self.slab(k, &boxes[l].corner)));
        let pack = |k: usize, f: fn(&Slab) -> Interval| Pack::from_fn(|l| f(slabs[k][l]));
        let function = |k: usize, range: Pack, centre: Pack, quotient: Option<Pack>| {
            let mut f = Slope::<Pack, M> { range, centre, slope: [Pack::zero(); M] };
            if let Some(a) = self.axes.iter().position(|&axis| axis == k) {
                let radius = Pack::constant(Interval::point(self.radius[a]));
                f.slope[a] = quotient.map_or(radius, |q| q * radius);
            }
            f
        };
        let x: [_; N] = each!(|k| function(k, pack(k, |s| s.range), pack(k, |s| s.middle), None));
        let placement = Placement::<Slope<Pack, M>, D>::new(self.robot.platform, &x, |k| {
            let (sin, cos) = (pack(k, |s| s.turn.0), pack(k, |s| s.turn.1));
            let (sin_c, cos_c) = (pack(k, |s| s.turn_middle.0), pack(k, |s| s.turn_middle.1));
            (function(k, sin, sin_c, Some(cos)), function(k, cos, cos_c, Some(-sin)))
        });
        self.decide(boxes, &placement);
    }

    fn decide(&self, boxes: &mut [Node; LANES], placement: &Placement<Slope<Pack, M>, D>) {
        let legs = closures::<_, D, N>(self.robot, placement);
        let mut closes = [true; LANES];
        let mut out = [false; LANES];
        for leg in &legs {
            let reach = leg.closure.reach.tightened().range;
            let (positive, negative) = (reach.positive(), reach.negative());
            for l in 0..LANES {
                // A strut closes everywhere (its H is q², zero only on a set that separates nothing).
                closes[l] &= positive[l];
                out[l] |= negative[l];
            }
        }
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
        let h: [_; N] = each!(|j| legs[j].closure.reach.sqrt());
        let limits = self.limits(&legs, &h, placement);
        let rows = ModalRows::new(self.robot, &legs, &h);
        rows.dets(self.modes, wanted, |m, det| {
            let det = det.tightened().range;
            let (positive, negative) = (det.positive(), det.negative());
            for l in 0..LANES {
                let (kept, broken) = limits.of(self.modes[m], l);
                boxes[l].settle(m, closes[l] && kept, broken, positive[l], negative[l]);
            }
        });
    }

    /// Whether the limits of each leg and posture are kept or broken.
    fn limits(
        &self,
        legs: &[LegClosure<Slope<Pack, M>, D>; N],
        h: &[Slope<Pack, M>; N],
        placement: &Placement<Slope<Pack, M>, D>,
    ) -> LimitMasks<N> {
        let mut masks = LimitMasks { kept: [[[true; LANES]; 2]; N], broken: [[[false; LANES]; 2]; N] };
        for (j, leg) in self.robot.legs.iter().enumerate().filter(|(_, leg)| !leg.limits.is_empty()) {
            let at = LegAt { leg, span: legs[j].span, closure: legs[j].closure, h: h[j] };
            for limit in &leg.limits {
                for (posture, sh) in [h[j], -h[j]].into_iter().enumerate() {
                    let range = margin(limit, &at, sh, placement).tightened().range;
                    let (positive, negative) = (range.positive(), range.negative());
                    for l in 0..LANES {
                        masks.kept[j][posture][l] &= positive[l];
                        masks.broken[j][posture][l] |= negative[l];
                    }
                }
            }
        }
        masks
    }
}

struct LimitMasks<const N: usize> {
    kept: [[Mask; 2]; N],
    broken: [[Mask; 2]; N],
}

impl<const N: usize> LimitMasks<N> {
    /// (all kept, some broken) in `mode`, for one lane.
    fn of(&self, mode: WorkingMode, lane: usize) -> (bool, bool) {
        let posture = |j: usize| usize::from(mode.sign(j) < 0);
        let kept = (0..N).all(|j| self.kept[j][posture(j)][lane]);
        (kept, (0..N).any(|j| self.broken[j][posture(j)][lane]))
    }
}

/// The modes that have a class in the set.
fn modes_of(classes: ClassSet) -> u8 {
    (0..8).filter(|m| classes >> (2 * m) & 3 != 0).fold(0, |set, m| set | 1 << m)
}

impl Node {
    /// Records what is proved of mode `m` here: that it exists all over the box, or nowhere; the sign of det A.
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
