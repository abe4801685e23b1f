//! One limit over eight boxes, in one choice of the postures on which it depends.

use super::form::{Field, Form};
use super::view::View;
use arrayvec::ArrayVec;
use aspecta_kinematics::constraints::{Configuration, Constraint};
use aspecta_robot::num::Pack;
use aspecta_robot::{LegIndex, WorkingMode};

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
        let legs = (0..N).filter(|&j| constraint.postures().holds(LegIndex::new(j)));
        let own = legs.map(|j| (j, at.by_height(constraint, j, |f| f.value).range())).collect();
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
