//! One limit over eight boxes, in one choice of the postures on which it depends.

use super::form::{Field, Form, range};
use super::view::View;
use arrayvec::ArrayVec;
use aspecta_kinematics::constraints::{Configuration, Constraint};
use aspecta_kinematics::modal::LegClosure;
use aspecta_kinematics::placement::Placement;
use aspecta_robot::WorkingMode;
use aspecta_robot::num::{Jet, Pack, Slope, each};

/// A limit's margin.
pub(super) struct LimitPart<const N: usize, const M: usize> {
    pub constraint: Constraint,
    /// The postures; those of legs on which it does not depend mean nothing.
    mode: WorkingMode,
    /// The margin as a function of the pose, at fixed h where a leg is singular.
    pub field: Field<M>,
    /// The legs on which it depends, and its derivatives with respect to their s h.
    pub own: ArrayVec<(usize, Pack), N>,
}

impl<const N: usize, const M: usize> LimitPart<N, M> {
    /// With the h of all legs as they are in `heights`, in both postures.
    pub(super) fn new<const D: usize>(
        view: &View<'_, D, N, M>,
        heights: &[[Form<M>; 2]; N],
        constraint: Constraint,
        mode: WorkingMode,
    ) -> Self {
        let View { robot, placement, legs, .. } = view;
        let at = Configuration { robot, placement, legs, heights, mode };
        let field = Field::of(&(at.margin(constraint) / at.unit(constraint)));
        let legs = (0..N).filter(|&j| constraint.postures().holds(j));
        let own = legs.map(|j| (j, by_height(view, heights, constraint, mode, j))).collect();
        Self { constraint, mode, field, own }
    }

    /// Returns the limit's functions with other h.
    pub(super) fn with<const D: usize>(&self, view: &View<'_, D, N, M>, heights: &[[Form<M>; 2]; N]) -> Self {
        Self::new(view, heights, self.constraint, self.mode)
    }

    /// Whether this is the limit in the postures of `mode`.
    pub(super) fn is_in(&self, mode: WorkingMode) -> bool {
        self.constraint.postures().are_alike(self.mode, mode)
    }
}

/// The derivative of a limit's margin with respect to s h of leg j.
fn by_height<const D: usize, const N: usize, const M: usize>(
    view: &View<'_, D, N, M>,
    heights: &[[Form<M>; 2]; N],
    constraint: Constraint,
    mode: WorkingMode,
    j: usize,
) -> Pack {
    let Still { placement, legs } = &**view.still.get_or_init(|| Box::new(Still::of(view)));
    let of_leg = |i: usize, sh: Form<M>| if i == j { Jet::variable(sh.value, 0) } else { still(sh) };
    let heights: [[Jet<Slope<Pack, M>, 1>; 2]; N] =
        std::array::from_fn(|i| each!(|posture| of_leg(i, heights[i][posture])));
    let at = Configuration { robot: view.robot, placement, legs, heights: &heights, mode };
    range((at.margin(constraint) / at.unit(constraint)).gradient[0])
}

/// Constant but for a variable of its own.
fn still<const M: usize>(f: Form<M>) -> Jet<Slope<Pack, M>, 1> {
    Jet::fixed(f.value)
}

/// The robot over eight boxes while nothing moves but some s h.
pub(super) struct Still<const D: usize, const N: usize, const M: usize> {
    placement: Placement<Jet<Slope<Pack, M>, 1>, D>,
    legs: [LegClosure<Jet<Slope<Pack, M>, 1>, D>; N],
}

impl<const D: usize, const N: usize, const M: usize> Still<D, N, M> {
    fn of(view: &View<'_, D, N, M>) -> Self {
        let legs = std::array::from_fn(|j| view.legs[j].map(still));
        Self { placement: view.placement.map(still), legs }
    }
}
