//! The robot over eight boxes, with the h of every leg in a given range: one way to look at them.

use super::MOST;
use super::climb::Growth;
use super::form::{Field, Form};
use super::frame::Frame;
use super::leg::LegPart;
use super::limit::LimitPart;
use super::pair::{Found, LINES, PairPart, Side, in_p};
use super::turns::Place;
use super::view::View;
use arrayvec::ArrayVec;
use aspecta_kinematics::constraints::{Constraint, Joint, Kind};
use aspecta_robot::num::{Interval, Mask, Pack, Scalar};
use aspecta_robot::{LegIndex, WorkingMode};
use std::cell::LazyCell;

/// The legs, and all that bounds the aspects but det A.
pub(super) struct Way<'a, const D: usize, const N: usize, const M: usize> {
    view: &'a View<'a, D, N, M>,
    pub legs: Vec<LegPart<N, M>>,
    /// In the order of [`Constraint::of`].
    bounds: Vec<Bound<N, M>>,
}

/// A constraint that bounds the aspects of some modes.
enum Bound<const N: usize, const M: usize> {
    /// The reach of this leg, in every mode.
    Reach(usize),
    /// A limit, in the modes of one choice of postures.
    Limit(Box<LimitPart<N, M>>),
    /// Two bodies, likewise.
    Pair(Box<PairPart<N, M>>),
}

/// What bounds the aspects of a mode in one box, but for det A.
pub(super) struct Bounds<const M: usize> {
    /// All of these.
    pub all: ArrayVec<Growth<M>, MOST>,
    /// How many of them, the first, bound the aspects of every mode.
    common: usize,
    /// Of each of these pairs of thin bodies one of the lines.
    pub parted: ArrayVec<ArrayVec<[Side<M>; 2], LINES>, MOST_PARTED>,
    /// Where the joints of these are.
    pub places: Vec<(Joint, Place)>,
    /// Whether these are all: if not, nothing may be proved of the box, for one that is left out could be the least.
    pub are_all: bool,
}

impl<const M: usize> Bounds<M> {
    /// Of nothing yet.
    pub(super) fn new() -> Self {
        Self { all: ArrayVec::new(), common: 0, parted: ArrayVec::new(), places: Vec::new(), are_all: true }
    }

    fn add(&mut self, growth: Growth<M>) {
        self.are_all &= self.all.try_push(growth).is_ok();
    }

    /// Forgets what is not common to all modes.
    fn restart(&mut self) {
        self.all.truncate(self.common);
        self.parted.clear();
        self.places.clear();
        self.are_all = true;
    }
}

/// Most pairs of thin bodies that may nearly touch in one box.
const MOST_PARTED: usize = 4;

impl<'a, const D: usize, const N: usize, const M: usize> Way<'a, D, N, M> {
    /// With the whole range of h, and these legs as singular in each box.
    pub(super) fn new(view: &'a View<'a, D, N, M>, singular: &[Mask; N]) -> Self {
        let legs: Vec<_> = (0..N).map(|j| LegPart::new(view, j, view.heights[j], singular[j])).collect();
        let bounds = bounds(view, &legs);
        Self { view, legs, bounds }
    }

    /// Changes the ranges of h.
    pub(super) fn set(&mut self, heights: &[Pack; N]) {
        let changed: [bool; N] = std::array::from_fn(|j| self.legs[j].height != heights[j]);
        for j in (0..N).filter(|&j| changed[j]) {
            self.legs[j] = LegPart::new(self.view, j, heights[j], self.legs[j].singular);
        }
        let depends = |part: &LimitPart<N, M>| part.own.iter().any(|&(j, _)| changed[j]);
        let (view, legs) = (self.view, &self.legs);
        let heights = LazyCell::new(|| postures(view, legs));
        for bound in &mut self.bounds {
            match bound {
                Bound::Limit(part) if depends(part) => **part = part.with(view, &heights),
                Bound::Pair(part) if (0..N).any(|j| changed[j] && part.depends_on(j)) => {
                    **part = part.with(view, &heights);
                }
                Bound::Limit(_) | Bound::Pair(_) | Bound::Reach(_) => {}
            }
        }
    }

    /// Begins the list of what bounds the aspects in one box anew, with what does so in every mode.
    pub(super) fn common(&self, frame: &Frame<N, M>, lane: usize, bounds: &mut Bounds<M>) {
        let view = self.view;
        bounds.common = 0;
        bounds.restart();
        for j in self.reaches().filter(|&j| view.legs[j].fold.is_none()) {
            bounds.add(self.reach(frame, j, 1.0, lane));
        }
        let (lo, hi) = view.paving.bounds(view.boxes[lane]);
        for (a, &k) in view.paving.axes.iter().enumerate() {
            let (first, last) = view.paving.window.ranges[k];
            let (cut_first, cut_last) = view.paving.window.cut[k];
            let extent = Interval::new(lo[a], hi[a]);
            for (cut, distance, sign) in [
                (cut_first, extent - Interval::point(first), 1.0),
                (cut_last, Interval::point(last) - extent, -1.0),
            ] {
                if cut {
                    let gradient = std::array::from_fn(|b| Interval::point(if a == b { sign } else { 0.0 }));
                    let value = distance / Interval::point(last - first);
                    bounds.add(Growth { value, along: frame.along(&gradient, &[]) });
                }
            }
        }
        bounds.common = bounds.all.len();
    }

    /// Goes on from what [`Way::common`] began, with all other constraints of a mode but det A.
    pub(super) fn constrain(
        &self,
        frame: &Frame<N, M>,
        mode: WorkingMode,
        lane: usize,
        bounds: &mut Bounds<M>,
    ) {
        let Self { view, legs, .. } = self;
        bounds.restart();
        let sign = |j: usize| f64::from(mode.sign(j));
        for bound in &self.bounds {
            match bound {
                &Bound::Reach(j) if view.legs[j].fold.is_some() => {
                    bounds.add(self.reach(frame, j, sign(j), lane));
                }
                Bound::Limit(part) if part.is_in(mode) => {
                    let own: ArrayVec<_, N> =
                        part.own.iter().map(|(j, own)| (*j, sign(*j), own.lane(lane))).collect();
                    let along = frame.along(&part.field.gradient_in(lane), &own);
                    let value = part.field.value.lane(lane) / Interval::point(view.scale[part.constraint]);
                    let by_root = part.constraint.counts_by_root(view.robot);
                    bounds.add(Growth { value: in_p(value, by_root), along });
                }
                Bound::Reach(_) | Bound::Limit(_) | Bound::Pair(_) => {}
            }
        }
        let heights = || postures(view, legs);
        for bound in &self.bounds {
            let Bound::Pair(part) = bound else { continue };
            if !part.is_in(mode) {
                continue;
            }
            let least = bounds.all.iter().fold(f64::INFINITY, |least, growth| least.min(growth.value.hi));
            match part.found(view, heights, (frame, mode, lane), least) {
                Found::Far => {}
                Found::Least(distances) => distances.into_iter().for_each(|one| bounds.add(one)),
                Found::Parted(lines, ends) => {
                    bounds.places.extend(ends);
                    bounds.are_all &= bounds.parted.try_push(lines).is_ok();
                }
            }
        }
    }

    /// The legs whose reach bounds the aspects.
    fn reaches(&self) -> impl Iterator<Item = usize> {
        self.bounds.iter().filter_map(|bound| match bound {
            Bound::Reach(j) => Some(*j),
            Bound::Limit(_) | Bound::Pair(_) => None,
        })
    }

    /// The reach of leg j, in the posture with this sign.
    fn reach(&self, frame: &Frame<N, M>, j: usize, sign: f64, lane: usize) -> Growth<M> {
        let (view, height) = (self.view, self.legs[j].height.lane(lane));
        let reach = view.reach[j].value.lane(lane).meet(height.square());
        let value = (reach / Interval::point(view.scale[Constraint::Reach(LegIndex::new(j))])).sqrt();
        Growth { value, along: self.reach_along(frame, j, sign, lane) }
    }

    /// The derivatives of H_j, or of an increasing function of it.
    fn reach_along(&self, frame: &Frame<N, M>, j: usize, sign: f64, lane: usize) -> [Interval; M] {
        match &self.view.legs[j].fold {
            Some(fold) => {
                let gradient = Field::of(&fold.b).gradient_in(lane);
                frame.along(&gradient.map(|g| g * Interval::point(sign)), &[])
            }
            None if frame.singular[j] => std::array::from_fn(|i| frame.climb[i][j]),
            None => frame.along(&self.view.reach[j].gradient_in(lane), &[]),
        }
    }
}

/// Returns all constraints but det A, which is of either sign: those who ask for it have it from
/// [`Determinant`](super::determinant::Determinant).
fn bounds<const D: usize, const N: usize, const M: usize>(
    view: &View<'_, D, N, M>,
    legs: &[LegPart<N, M>],
) -> Vec<Bound<N, M>> {
    let heights = LazyCell::new(|| postures(view, legs));
    let of = |constraint: Constraint| -> ArrayVec<Bound<N, M>, MOST> {
        match constraint.kind() {
            Kind::Serial(j) => std::iter::once(Bound::Reach(j.index())).collect(),
            Kind::Limit => {
                let part = |mode| match constraint {
                    Constraint::Apart(_, k) => {
                        Bound::Pair(Box::new(PairPart::new(view, &heights, (constraint, k), mode)))
                    }
                    Constraint::Limit(..)
                    | Constraint::RodAngle(..)
                    | Constraint::Reach(_)
                    | Constraint::Det => {
                        Bound::Limit(Box::new(LimitPart::new(view, &heights, constraint, mode)))
                    }
                };
                constraint.postures().choices(N).map(part).collect()
            }
            Kind::Parallel => ArrayVec::new(),
        }
    };
    Constraint::of(view.robot).flat_map(of).collect()
}

/// s h of every leg in both postures.
fn postures<const D: usize, const N: usize, const M: usize>(
    view: &View<'_, D, N, M>,
    legs: &[LegPart<N, M>],
) -> [[Form<M>; 2]; N] {
    std::array::from_fn(|j| view.postures(j, &legs[j]))
}
