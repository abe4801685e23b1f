//! No hiding: the proof that no aspect has its highest point in a box.
//!
//! # Theorem
//! Let g_1, …, g_r be the functions whose common positivity region is S_{s,σ} (σ det A, the h_j = √H_j, the limits, the distances to
//! the faces at which the user's window cuts the workspace), each divided by a positive constant, and
//!
//! > P = min_k g_k.
//!
//! S_{s,σ} is bounded and P vanishes on its boundary, so P has a maximum, a *summit*, in each of its components. At a summit
//! no tangent vector makes all the g_k that attain the minimum grow. Hence, if a box comes with tangent vectors e(X) such that
//! e·∇g_k > 0 on all of box ∩ S_{s,σ} for every g_k that can attain the minimum there, no aspect has a summit in the box.
//!
//! Nothing is assumed of the robot: where the test fails, nothing is concluded. It succeeds in every small enough box
//! whose singular functions have linearly independent gradients *in the variables (X, h)*, which is what
//! `docs/theory.md`, 5, calls a generic robot.
//!
//! # The vectors
//! ∂det A/∂X grows without bound where some h_j = √H_j vanishes, but det A is smooth in (X, h) with 2h_j ḣ_j = ∇H_j·Ẋ. For
//! the legs J that are singular in the box, the vectors are combinations of
//!
//! - t, tangent to every {H_j = const}, j ∈ J: ḣ_j = 0 for j ∈ J;
//! - h_j m_j, with m_j tangent to {H_i = const} for the other i ∈ J: ḣ_j = ½ ∇H_j·m_j and ḣ_i = 0,
//!
//! n in all, along which everything is bounded with h_j ∈ [0, h̄_j] as a variable of its own.

mod climb;
mod frame;
mod view;

use super::saddle::no_local_maximum;
use super::scale::Scale;
use crate::kinematics::WorkingMode;
use crate::num::{Interval, LANES, Mask, Pack};
use crate::paving::{ClassSet, Paving};
use crate::robot::Robot;
use arrayvec::ArrayVec;
use climb::can_climb;
use frame::Frame;
use view::{Part, View};

/// More constraints than any robot file can bring to bear on one box at once.
const MOST: usize = 64;

/// Of the classes `asked` of up to eight boxes, those that surely have no summit there.
pub(super) fn summitless<const D: usize, const N: usize, const M: usize>(
    robot: &Robot,
    paving: &Paving,
    scale: &Scale,
    boxes: &[(u32, ClassSet)],
) -> [ClassSet; LANES] {
    let view = View::<D, N, M>::new(robot, paving, &std::array::from_fn(|l| boxes[l.min(boxes.len() - 1)].0));
    let mut asked = [0; LANES];
    (0..boxes.len()).filter(|&l| view.usable[l]).for_each(|l| asked[l] = boxes[l].1);
    let mut proved = view.look(robot, scale, &view.heights, &asked);
    // Near a serial singularity h varies like the root of the box's width: cut its range and look at each part.
    let left: [ClassSet; LANES] = std::array::from_fn(|l| asked[l] & !proved[l]);
    let singular = view.singular(&left);
    if singular.contains(&true) {
        let mut held = left;
        let depth = boxes.iter().map(|b| paving.depth_of(b.0)).max().unwrap_or(0);
        for heights in parts(&view.heights, &singular, depth) {
            let found = view.look(robot, scale, &heights, &held);
            (0..LANES).for_each(|l| held[l] &= found[l]);
            if held == [0; LANES] {
                break;
            }
        }
        (0..LANES).for_each(|l| proved[l] |= held[l]);
    }
    for (l, &(node, _)) in
        boxes.iter().enumerate().filter(|(_, b)| u32::from(paving.nodes[b.0 as usize].depth) >= DEEP)
    {
        let left = asked[l] & !proved[l];
        for (m, &mode) in paving.modes.iter().enumerate().filter(|(m, _)| left >> (2 * m) & 3 != 0) {
            proved[l] |= left & view.saddles::<D>(robot, scale, node, l, (m, mode));
        }
    }
    proved
}

/// From this depth on the second-order test is tried: double points of det A = 0 are rare, and it costs more.
const DEEP: u32 = 9;

/// The ranges of h, those of the marked legs cut into parts, in all combinations. The range shrinks like the root of the box's width, so that
/// it takes more parts in smaller boxes to match what the width leaves uncertain.
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

impl<'a, const D: usize, const N: usize, const M: usize> View<'a, D, N, M> {
    /// The legs that are singular in some box in which something is asked.
    fn singular(&self, asked: &[ClassSet; LANES]) -> [bool; N] {
        std::array::from_fn(|j| {
            self.rooted[j] && (0..LANES).any(|l| asked[l] != 0 && is_singular(self.reach[j].value.lane(l)))
        })
    }

    /// Of the classes asked, those without a summit where the h_j are in the given ranges.
    fn look(
        &self,
        robot: &Robot,
        scale: &Scale,
        heights: &[Pack; N],
        asked: &[ClassSet; LANES],
    ) -> [ClassSet; LANES] {
        let mut proved = [0; LANES];
        for singular in self.choices(scale) {
            let left: [ClassSet; LANES] = std::array::from_fn(|l| asked[l] & !proved[l]);
            let part = self.part(robot, heights, &singular);
            let found = self.look_from(robot, scale, &part, &left);
            (0..LANES).for_each(|l| proved[l] |= found[l]);
        }
        proved
    }

    /// The same with the singular legs chosen.
    fn look_from(
        &self,
        robot: &Robot,
        scale: &Scale,
        part: &Part<N, M>,
        asked: &[ClassSet; LANES],
    ) -> [ClassSet; LANES] {
        let frame = |l: usize| (asked[l] != 0).then(|| Frame::new(self, part, l)).flatten();
        let frames: [Option<Frame<N, M>>; LANES] = std::array::from_fn(frame);
        let any = asked.iter().fold(0, |any, classes| any | classes);
        let mut proved = [0; LANES];
        for (m, &mode) in self.paving.modes.iter().enumerate().filter(|(m, _)| any >> (2 * m) & 3 != 0) {
            let det = self.determinant(part, mode);
            for (l, frame) in frames.iter().enumerate().filter(|(l, _)| asked[*l] >> (2 * m) & 3 != 0) {
                let Some(frame) = frame else { continue };
                let common = self.constraints(robot, scale, part, frame, mode, l);
                let det = det.growth(frame, mode, scale, l);
                for (sign, bit) in [(1.0, 1 << (2 * m)), (-1.0, 2 << (2 * m))] {
                    if asked[l] & bit != 0 && can_climb(&common, &det.signed(sign)) {
                        proved[l] |= bit;
                    }
                }
            }
        }
        proved
    }

    /// The classes of a mode without a summit in one box by the second-order test ([`no_local_maximum`]).
    fn saddles<const SPACE: usize>(
        &self,
        robot: &Robot,
        scale: &Scale,
        node: u32,
        lane: usize,
        (m, mode): (usize, WorkingMode),
    ) -> ClassSet {
        let part = self.part(robot, &self.heights, &[[false; LANES]; N]);
        let Some(frame) = Frame::new(self, &part, lane) else { return 0 };
        let least = self
            .constraints(robot, scale, &part, &frame, mode, lane)
            .iter()
            .fold(f64::INFINITY, |least, g| least.min(g.value.lo));
        let det = self.determinant(&part, mode).growth(&frame, mode, scale, lane).value;
        if least <= 0.0 || det.magnitude() >= least {
            return 0;
        }
        let [plus, minus] = no_local_maximum::<SPACE, N, M>(robot, self.paving, node, mode);
        (ClassSet::from(plus) | ClassSet::from(minus) << 1) << (2 * m)
    }

    /// The choices of singular legs to try, per leg and box. A choice is valid if it has all legs that can be singular; it is mostly
    /// better if it has all that nearly are, because ∇det A is then nearly parallel to ∇H_j.
    fn choices(&self, scale: &Scale) -> ArrayVec<[Mask; N], 2> {
        let reach = |j: usize, l: usize| self.reach[j].value.lane(l);
        let must: [Mask; N] =
            std::array::from_fn(|j| std::array::from_fn(|l| self.rooted[j] && is_singular(reach(j, l))));
        let may: [Mask; N] = std::array::from_fn(|j| {
            std::array::from_fn(|l| must[j][l] || self.rooted[j] && reach(j, l).hi <= NEARLY * scale.reach[j])
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
