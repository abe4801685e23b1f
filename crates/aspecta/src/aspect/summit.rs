//! No hiding: the proof that no aspect has its highest point in a box.
//!
//! # Theorem
//! Let g_1, …, g_r be the functions whose common positivity region is S_{s,σ} (σ det A, the h_j = √H_j, the
//! limits, the distances to the faces at which the user's window cuts the workspace), each divided by a
//! positive constant, and
//!
//! > P = min_k g_k.
//!
//! S_{s,σ} is bounded and P vanishes on its boundary, so P has a maximum, a *summit*, in each of its
//! components. At a summit no tangent vector makes all the g_k that attain the minimum grow. Hence, if a box
//! comes with tangent vectors e(X) such that e·∇g_k > 0 on all of box ∩ S_{s,σ} for every g_k that can attain
//! the minimum there, no aspect has a summit in the box.
//!
//! Nothing is assumed of the robot: where the test fails, nothing is concluded. It succeeds in every small
//! enough box whose singular functions have linearly independent gradients *in the variables (X, h)*, which
//! is what `docs/theory.md`, 5, calls a generic robot.
//!
//! # The vectors
//! ∂det A/∂X grows without bound where some h_j = √H_j vanishes, but det A is smooth in (X, h) with 2h_j
//! ḣ_j = ∇H_j·Ẋ. For the legs J that are singular in the box, the vectors are combinations of
//!
//! - t, tangent to every {H_j = const}, j ∈ J: ḣ_j = 0 for j ∈ J;
//! - h_j m_j, with m_j tangent to {H_i = const} for the other i ∈ J: ḣ_j = ½ ∇H_j·m_j and ḣ_i = 0,
//!
//! n in all, along which everything is bounded with h_j ∈ [0, h̄_j] as a variable of its own.

mod climb;
mod coaxial;
mod determinant;
mod form;
mod frame;
mod leg;
mod limit;
mod pair;
mod turns;
mod view;
mod way;

use super::saddle::no_local_maximum;
use crate::paving::{ClassSet, MODES, Paving};
use arrayvec::ArrayVec;
use aspecta_kinematics::constraints::{Scale, Turn};
use aspecta_robot::Robot;
use aspecta_robot::WorkingMode;
use aspecta_robot::num::{Interval, LANES, Mask, Pack};
use aspecta_robot::work;
use climb::can_climb;
use determinant::Determinant;
use frame::Frame;
use std::cell::LazyCell;
use view::View;
use way::{Bounds, Way};

/// Constraints that are compared over one box: more than any robot file brings to bear at once. Of a box with
/// more nothing is proved.
const MOST: usize = 64;

/// Returns, of the classes asked of each box, those proved to have no summit there.
pub(super) fn summitless<const D: usize, const N: usize, const M: usize>(
    robot: &Robot,
    paving: &Paving,
    scale: &Scale,
    asked: &[(u32, ClassSet)],
) -> Vec<ClassSet> {
    let found = by_eights::<Found, D, N, M>(robot, paving, scale, asked, |boxes| boxes.look());
    let mut proved: Vec<ClassSet> = found.iter().map(|found| found.proved).collect();
    if coaxial::folds_up(robot, paving) {
        for (proved, &(node, classes)) in proved.iter_mut().zip(asked) {
            *proved |= classes & coaxial::summitless_in_the_middle(robot, paving, node);
        }
    }
    // Those left over are looked at once more, side by side with their like: what takes one of them many
    // parts takes as many in all eight.
    let depth = |i: usize| paving.depth_of(asked[i].0);
    let mut left: Vec<usize> = (0..asked.len())
        .filter(|&i| asked[i].1 & !proved[i] != 0 && (found[i].singular != 0 || depth(i) >= DEEP))
        .collect();
    left.sort_by_key(|&i| (found[i].singular, depth(i)));
    let again: Vec<(u32, ClassSet)> = left.iter().map(|&i| (asked[i].0, asked[i].1 & !proved[i])).collect();
    let more = by_eights::<ClassSet, D, N, M>(robot, paving, scale, &again, |boxes| boxes.look_closer());
    left.iter().zip(more).for_each(|(&i, more)| proved[i] |= more);
    proved
}

/// Returns the result of `look` for each box, eight boxes at a time.
fn by_eights<T: Send, const D: usize, const N: usize, const M: usize>(
    robot: &Robot,
    paving: &Paving,
    scale: &Scale,
    asked: &[(u32, ClassSet)],
    look: impl Fn(&Eight<'_, D, N, M>) -> Vec<T> + Sync,
) -> Vec<T> {
    let of_eight = |boxes: &[(u32, ClassSet)]| {
        let eight = eight(boxes);
        let over = view::over(robot, paving, &eight);
        let view = View::new(robot, paving, scale, &eight, &over);
        look(&Eight::new(&view, boxes))
    };
    let packs: Vec<_> = asked.chunks(LANES).collect();
    work::flat_map(&packs, |boxes| of_eight(boxes))
}

/// The result of a first look at a box.
struct Found {
    /// The classes without a summit in it.
    proved: ClassSet,
    /// The legs, as bits, that may be singular in it.
    singular: u8,
}

/// Up to eight boxes, and what is asked of them.
struct Eight<'a, const D: usize, const N: usize, const M: usize> {
    view: &'a View<'a, D, N, M>,
    boxes: &'a [(u32, ClassSet)],
    asked: [ClassSet; LANES],
}

/// The boxes, the last of them more often if they are less than eight.
fn eight(boxes: &[(u32, ClassSet)]) -> [u32; LANES] {
    std::array::from_fn(|l| boxes[l.min(boxes.len() - 1)].0)
}

impl<'a, const D: usize, const N: usize, const M: usize> Eight<'a, D, N, M> {
    fn new(view: &'a View<'a, D, N, M>, boxes: &'a [(u32, ClassSet)]) -> Self {
        let asked = std::array::from_fn(|l| if l < boxes.len() && view.usable[l] { boxes[l].1 } else { 0 });
        Self { view, boxes, asked }
    }

    /// With the whole range of h.
    fn look(&self) -> Vec<Found> {
        let proved = self.over(&self.whole(), &self.asked);
        let singular =
            |l: usize| (0..N).filter(|&j| self.view.may_be_singular(j, l)).fold(0, |set, j| set | 1 << j);
        (0..self.boxes.len()).map(|l| Found { proved: proved[l], singular: singular(l) }).collect()
    }

    /// With the range of h cut into parts, and then to second order.
    fn look_closer(&self) -> Vec<ClassSet> {
        let mut proved = self.by_parts();
        let regular = LazyCell::new(|| Way::new(self.view, &[[false; LANES]; N]));
        for (l, &(node, _)) in
            self.boxes.iter().enumerate().filter(|(_, b)| self.view.paving.depth_of(b.0) >= DEEP)
        {
            let left = self.asked[l] & !proved[l];
            for (m, &mode) in
                self.view.paving.modes.iter().enumerate().filter(|(m, _)| left >> (2 * m) & 3 != 0)
            {
                proved[l] |= left & self.saddles(&regular, node, l, (m, mode));
            }
        }
        proved.into_iter().take(self.boxes.len()).collect()
    }

    /// Near a serial singularity h varies like the root of the box's width: its range is cut, and each part
    /// looked at.
    fn by_parts(&self) -> [ClassSet; LANES] {
        let singular = std::array::from_fn(|j| {
            self.view.twin_of[j].is_none()
                && (0..LANES).any(|l| self.asked[l] != 0 && self.view.may_be_singular(j, l))
        });
        if !singular.contains(&true) {
            return [0; LANES];
        }
        let depth = self.boxes.iter().map(|b| self.view.paving.depth_of(b.0)).max().unwrap_or(0);
        let mut ways = self.whole();
        let mut held = self.asked;
        for mut heights in parts(&self.view.heights, &singular, depth) {
            for (j, twin) in self.view.twin_of.iter().enumerate() {
                heights[j] = twin.map_or(heights[j], |twin| heights[twin]);
            }
            ways.iter_mut().for_each(|way| way.set(&heights));
            let found = self.over(&ways, &held);
            (0..LANES).for_each(|l| held[l] &= found[l]);
            if held == [0; LANES] {
                break;
            }
        }
        held
    }

    /// The robot with the whole range of h, for each choice of singular legs.
    fn whole(&self) -> Vec<Way<'a, D, N, M>> {
        self.view.choices().iter().map(|singular| Way::new(self.view, singular)).collect()
    }

    /// Returns, of the classes asked, those proved to have no summit by any of some choices of singular legs.
    fn over(&self, ways: &[Way<'_, D, N, M>], asked: &[ClassSet; LANES]) -> [ClassSet; LANES] {
        let mut proved = [0; LANES];
        for way in ways {
            let left: [ClassSet; LANES] = std::array::from_fn(|l| asked[l] & !proved[l]);
            let found = self.by(way, &left);
            (0..LANES).for_each(|l| proved[l] |= found[l]);
        }
        proved
    }

    /// Returns, of the classes asked, those proved to have no summit by one choice of singular legs.
    fn by(&self, way: &Way<'_, D, N, M>, asked: &[ClassSet; LANES]) -> [ClassSet; LANES] {
        let view = &self.view;
        let any = asked.iter().fold(0, |any, classes| any | classes);
        let modes = || view.paving.modes.iter().enumerate();
        let dets: ArrayVec<Option<Determinant<N, M>>, MODES> = modes()
            .map(|(m, &mode)| {
                let is_asked = any >> (2 * m) & 3 != 0 && !view.paving.vanishes_in(m);
                is_asked.then(|| Determinant::new(view, &way.legs, mode))
            })
            .collect();
        let mut proved = [0; LANES];
        let mut bounds = Bounds::new();
        for l in (0..LANES).filter(|&l| asked[l] != 0) {
            let Some(frame) = Frame::new(view, &way.legs, l) else { continue };
            way.common(&frame, l, &mut bounds);
            for (m, &mode) in modes().filter(|(m, _)| asked[l] >> (2 * m) & 3 != 0) {
                way.constrain(&frame, mode, l, &mut bounds);
                if !bounds.are_all {
                    continue;
                }
                let det = dets[m].as_ref().map(|det| det.growth(&frame, mode, view.scale, l));
                for (sign, bit) in [(1.0, 1 << (2 * m)), (-1.0, 2 << (2 * m))] {
                    if asked[l] & bit == 0 {
                        continue;
                    }
                    let known: Vec<Turn> = match bounds.parted.is_empty() {
                        true => Vec::new(),
                        false => Turn::known(view.robot, mode, if det.is_some() { sign as i8 } else { 0 })
                            .collect(),
                    };
                    if can_climb(&bounds, det.map(|det| det.signed(sign)).as_ref(), &known) {
                        proved[l] |= bit;
                    }
                }
            }
        }
        proved
    }

    /// The classes of a mode without a summit in one box by the second-order test ([`no_local_maximum`]),
    /// none of the `legs` being singular.
    fn saddles(
        &self,
        way: &Way<'_, D, N, M>,
        node: u32,
        lane: usize,
        (m, mode): (usize, WorkingMode),
    ) -> ClassSet {
        let view = &self.view;
        if view.paving.vanishes_in(m) {
            return 0;
        }
        let Some(frame) = Frame::new(view, &way.legs, lane) else { return 0 };
        let mut all = Bounds::new();
        way.common(&frame, lane, &mut all);
        way.constrain(&frame, mode, lane, &mut all);
        if !all.are_all {
            return 0;
        }
        let parted = all.parted.iter().flatten().flatten().map(|side| &side.growth);
        let least = all.all.iter().chain(parted).fold(f64::INFINITY, |least, g| least.min(g.value.lo));
        let det = Determinant::new(view, &way.legs, mode).growth(&frame, mode, view.scale, lane).value;
        if least <= 0.0 || det.magnitude() >= least {
            return 0;
        }
        let [plus, minus] = no_local_maximum::<D, N, M>(view.robot, view.paving, node, mode);
        (ClassSet::from(plus) | ClassSet::from(minus) << 1) << (2 * m)
    }
}

/// From this depth on the second-order test is tried: double points of det A = 0 are rare, and it costs more.
const DEEP: u32 = 9;

/// The ranges of h, those of the marked legs cut into parts, in all combinations. The range shrinks like the
/// root of the box's width, so that it takes more parts in smaller boxes to match what the width leaves
/// uncertain.
fn parts<const N: usize>(
    heights: &[Pack; N],
    cut: &[bool; N],
    depth: u32,
) -> impl Iterator<Item = [Pack; N]> {
    let heights = *heights;
    let cuts: ArrayVec<usize, N> = (0..N).filter(|&j| cut[j]).collect();
    let (few, most) = [(1, 1), (4, 64), (3, 12), (2, 4)][cuts.len().min(3)];
    let each = (few << (depth.saturating_sub(DEEP) / 2).min(8)).min(most);
    (0..usize::pow(each, cuts.len() as u32)).map(move |mut index| {
        let mut part = heights;
        for &j in &cuts {
            let (k, of) = ((index % each) as f64, each as f64);
            index /= each;
            part[j] = Pack::from_fn(|l| {
                let whole = heights[j].lane(l);
                // The same formula for the end of one part and the start of the next: no gap.
                let at =
                    |k: f64| if k == of { whole.hi } else { whole.lo + (whole.hi - whole.lo) * (k / of) };
                Interval::new(at(k), at(k + 1.0))
            });
        }
        part
    })
}

impl<const D: usize, const N: usize, const M: usize> View<'_, D, N, M> {
    /// Whether leg j may meet a serial singularity in a box, or nearly.
    fn may_be_singular(&self, j: usize, lane: usize) -> bool {
        self.rooted[j] && is_singular(self.reach[j].value.lane(lane))
    }

    /// The choices of singular legs to try, per leg and box. A choice is valid if it has all legs that can be
    /// singular; it is mostly better if it has all that nearly are, because ∇det A is then nearly parallel to
    /// ∇H_j.
    fn choices(&self) -> ArrayVec<[Mask; N], 2> {
        let reach = |j: usize, l: usize| self.reach[j].value.lane(l);
        let must: [Mask; N] =
            std::array::from_fn(|j| std::array::from_fn(|l| self.rooted[j] && is_singular(reach(j, l))));
        let may: [Mask; N] = std::array::from_fn(|j| {
            std::array::from_fn(|l| {
                must[j][l] || self.rooted[j] && reach(j, l).hi <= NEARLY * self.scale.reach[j]
            })
        });
        let mut choices: ArrayVec<_, 2> = [may].into_iter().collect();
        if may != must {
            choices.push(must);
        }
        choices
    }
}

/// A leg is nearly singular in a box if its H, relative to its scale, is less than this.
const NEARLY: f64 = 0.3;

/// Whether H may vanish, or nearly.
fn is_singular(reach: Interval) -> bool {
    reach.lo <= 0.1 * reach.hi
}
