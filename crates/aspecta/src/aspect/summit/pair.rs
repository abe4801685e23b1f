//! Two bodies over eight boxes, in one choice of the postures on which they depend.
//!
//! Most pairs are far apart wherever some other function is small: their margin is evaluated by its range alone first, and the smooth pieces of
//! it only where it can be the least.

use super::climb::Growth;
use super::form::{Field, Form};
use super::frame::Frame;
use super::turns::{Place, implied};
use super::view::View;
use arrayvec::ArrayVec;
use aspecta_kinematics::constraints::{Beside, Configuration, Constraint, Feature, Joint, Line, Turn};
use aspecta_robot::num::{Affine, Interval, Pack, Scalar};
use aspecta_robot::{LegIndex, Robot, WorkingMode};
use std::cell::OnceCell;

/// A pair of bodies.
pub(super) struct PairPart<const N: usize, const M: usize> {
    /// Which pair.
    k: usize,
    constraint: Constraint,
    /// The postures; those of legs on which it does not depend mean nothing.
    mode: WorkingMode,
    /// The range of the margin.
    margin: Pack,
    /// In the plane, where the ends of both bodies are.
    ends: [[Pack; 2]; 4],
    pieces: OnceCell<Vec<Piece<N, M>>>,
}

/// A smooth piece of the margin.
struct Piece<const N: usize, const M: usize> {
    /// The line that it belongs to, of thin bodies, and the turn that it is.
    line: Option<Line>,
    turn: Option<Turn>,
    field: Field<M>,
    /// The legs on which it depends, and its derivatives with respect to their s h.
    own: ArrayVec<(usize, Pack), N>,
}

/// What is known of a pair in one box.
pub(super) enum Found<const M: usize> {
    /// Something else is less.
    Far,
    /// The distances of which the least counts.
    Least(ArrayVec<Growth<M>, 4>),
    /// Of the two of some line the least; and where the ends of the bodies are.
    Parted(ArrayVec<[Side<M>; 2], LINES>, [(Joint, Place); 4]),
}

/// The lines of which one parts two bodies.
pub(super) const LINES: usize = 8;

/// An end of a thin body on one side of a line.
#[derive(Clone, Copy)]
pub(super) struct Side<const M: usize> {
    pub growth: Growth<M>,
    pub turn: Option<Turn>,
}

impl<const N: usize, const M: usize> PairPart<N, M> {
    pub(super) fn new<const D: usize>(
        view: &View<'_, D, N, M>,
        heights: &[[Form<M>; 2]; N],
        (constraint, k): (Constraint, usize),
        mode: WorkingMode,
    ) -> Self {
        let (placement, legs) = view.plain();
        let heights: [[Affine<M>; 2]; N] = heights.each_ref().map(|both| both.map(|h| h.value));
        let at = Configuration { robot: view.robot, placement, legs, heights: &heights, mode };
        let bodies = at.bodies(k);
        let place = |end: usize| {
            let end = bodies.end(end);
            [end[0], end[1]].map(|x| x.range())
        };
        let ends = match view.robot.pairs[k].is_thin() {
            true => std::array::from_fn(place),
            false => [[Pack::zero(); 2]; 4],
        };
        Self { k, constraint, mode, margin: bodies.margin().range(), ends, pieces: OnceCell::new() }
    }

    /// The pair with other h.
    pub(super) fn with<const D: usize>(&self, view: &View<'_, D, N, M>, heights: &[[Form<M>; 2]; N]) -> Self {
        Self::new(view, heights, (self.constraint, self.k), self.mode)
    }

    /// Whether it depends on s h of this leg.
    pub(super) fn depends_on(&self, j: usize) -> bool {
        self.constraint.postures().holds(LegIndex::new(j))
    }

    /// Whether this is the pair in the postures of `mode`.
    pub(super) fn is_in(&self, mode: WorkingMode) -> bool {
        self.constraint.postures().are_alike(self.mode, mode)
    }

    fn pieces<const D: usize>(
        &self,
        view: &View<'_, D, N, M>,
        heights: impl Fn() -> [[Form<M>; 2]; N],
    ) -> &[Piece<N, M>] {
        self.pieces.get_or_init(|| {
            let View { robot, placement, legs, .. } = view;
            let at = Configuration { robot, placement, legs, heights: &heights(), mode: self.mode };
            let pair = &robot.pairs[self.k];
            let bodies = at.bodies(self.k);
            let legs = (0..N).filter(|&j| self.depends_on(j));
            let by_height: ArrayVec<_, N> =
                legs.map(|j| (j, at.bodies_by_height(self.k, j, |f| f.value))).collect();
            let piece = |feature: Feature| {
                let (line, turn) = match feature {
                    Feature::Side(line, end) => (Some(line), Turn::of(robot, pair, line, end)),
                    Feature::Distance | Feature::End(_) => (None, None),
                };
                Piece {
                    line,
                    turn,
                    field: Field::of(&bodies.feature(feature)),
                    own: by_height
                        .iter()
                        .map(|(j, by)| (*j, by.feature(feature).gradient[0].range()))
                        .collect(),
                }
            };
            match pair.is_thin() {
                true => {
                    let ends = |line| (0..2).map(move |end| Feature::Side(line, end));
                    Line::all().flat_map(ends).map(piece).collect()
                }
                false => Feature::distances(robot, pair).map(piece).collect(),
            }
        })
    }

    /// What is known of it in one box, where P is at most `least`.
    pub(super) fn found<const D: usize>(
        &self,
        view: &View<'_, D, N, M>,
        heights: impl Fn() -> [[Form<M>; 2]; N],
        (frame, mode, lane): (&Frame<N, M>, WorkingMode, usize),
        least: f64,
    ) -> Found<M> {
        let scale = Interval::point(view.scale[self.constraint]);
        let by_root = self.constraint.counts_by_root(view.robot);
        let scaled = |value: Interval| in_p(value / scale, by_root);
        let margin = self.margin.lane(lane);
        if margin.is_positive() && scaled(margin).lo > least {
            return Found::Far;
        }
        let growth = |piece: &Piece<N, M>| {
            let sign = |j: usize| f64::from(mode.sign(j));
            let own: ArrayVec<_, N> =
                piece.own.iter().map(|(j, own)| (*j, sign(*j), own.lane(lane))).collect();
            let along = frame.along(&piece.field.gradient_in(lane), &own);
            Growth { value: scaled(piece.field.value.lane(lane)), along }
        };
        let pieces = self.pieces(view, heights);
        if !view.robot.pairs[self.k].is_thin() {
            return Found::Least(
                pieces.iter().map(growth).filter(|growth| growth.value.lo <= least).collect(),
            );
        }
        let ends = self.ends_in(view.robot, lane);
        let side = |piece: &Piece<N, M>| {
            let turn = piece.turn.or(piece.line.and_then(|line| implied_by(line, &ends)));
            Side { growth: growth(piece), turn }
        };
        let lines = || pieces.chunks_exact(2).map(|ends| [side(&ends[0]), side(&ends[1])]);
        let lowest = |[one, other]: &[Side<M>; 2]| one.growth.value.lo.min(other.growth.value.lo);
        let highest = |[one, other]: &[Side<M>; 2]| one.growth.value.hi.min(other.growth.value.hi);
        let best = lines().map(|ends| lowest(&ends)).fold(f64::NEG_INFINITY, f64::max);
        // A line that is never the best does not say what the margin is.
        Found::Parted(lines().filter(|ends| highest(ends) >= best).collect(), ends)
    }

    /// The joints at the ends of both bodies, and where they are.
    fn ends_in(&self, robot: &Robot, lane: usize) -> [(Joint, Place); 4] {
        let [first, second] = robot.pairs[self.k].bodies.map(|body| Joint::of(robot, body));
        let joints = [first[0], first[1], second[0], second[1]];
        std::array::from_fn(|end| (joints[end], self.ends[end].map(|x| x.lane(lane))))
    }
}

/// A function, or its root, as it enters P. A root of what is below zero would be zero, or rounded outward a little more: that stays as it is.
pub(super) fn in_p(value: Interval, by_root: bool) -> Interval {
    if by_root && value.hi > 0.0 { value.sqrt() } else { value }
}

/// The turn that follows from the other body's being beyond an end of this one.
fn implied_by(line: Line, ends: &[(Joint, Place); 4]) -> Option<Turn> {
    let own = [ends[2 * line.along], ends[2 * line.along + 1]];
    let (from, to) = match line.side {
        Beside::Beyond => (own[0], own[1]),
        Beside::Before => (own[1], own[0]),
        Beside::Left | Beside::Right => return None,
    };
    let out = [to.1[0] - from.1[0], to.1[1] - from.1[1]];
    implied(to, out, [ends[2 - 2 * line.along], ends[3 - 2 * line.along]])
}
