//! Demands on a configuration: to lie in an aspect, and if wanted well away from its singularities.

use super::margins::{least_reach, unit_of_det};
use super::{Configuration, Constraint, Kind, Margins};
use crate::modal::{LegClosure, ModalRows};
use crate::placement::Placement;
use aspecta_robot::num::{Interval, Scalar, each};
use aspecta_robot::{LegIndex, Robot, WorkingMode};
use std::cell::LazyCell;

/// The demand on the configurations of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand {
    /// The working mode.
    pub mode: WorkingMode,
    /// The sign of det A: +1 or −1; 0 if nothing is asked of det A.
    pub sign: i8,
    /// The margins by which they stay away from singularities.
    pub margins: Margins,
    /// Whether they keep the limits of the machine.
    pub limits: bool,
    /// A leg that may come to its serial singularity: all else is asked of both its postures,
    /// wherever they exist and where they meet.
    pub crossing: Option<LegIndex>,
}

impl Demand {
    /// Returns the demand to lie in S_{s,σ}, however near its boundary.
    pub fn class(mode: WorkingMode, sign: i8) -> Self {
        Self { mode, sign, margins: Margins::default(), limits: true, crossing: None }
    }
}

/// A pose, or a box of them, at which the constraints are evaluated.
#[derive(Clone, Copy)]
pub struct Constraints<'a, T, const D: usize, const N: usize> {
    /// The robot.
    pub robot: &'a Robot,
    /// Where the platform is.
    pub placement: &'a Placement<T, D>,
    /// The legs as a chart has them; where it is a leg's own, s B_jj stands for H_j.
    pub legs: &'a [LegClosure<T, D>; N],
    /// The legs, as bits, that are taken to be at their serial singularity, with h = 0.
    pub flat: u8,
}

impl<'a, T: Scalar, const D: usize, const N: usize> Constraints<'a, T, D, N> {
    /// Returns the constraints at a pose.
    pub fn new(robot: &'a Robot, placement: &'a Placement<T, D>, legs: &'a [LegClosure<T, D>; N]) -> Self {
        Self { robot, placement, legs, flat: 0 }
    }

    /// Visits functions that are all positive if and only if the demand is met: with no margins and no
    /// crossing they are those whose common positivity region is S_{s,σ} — H_j, c_k and σ det A (times the
    /// weights). First come the reaches, without which the others do not exist. `visit` returns whether to go
    /// on.
    pub fn visit(&self, demand: &Demand, mut visit: impl FnMut(Constraint, T) -> bool) {
        let Self { robot, placement, legs, .. } = *self;
        for constraint in Constraint::of(robot) {
            if let Kind::Serial(j) = constraint.kind()
                && !visit(constraint, self.reach(j.index(), demand))
            {
                return;
            }
        }
        let is_flat = |j: usize| self.flat >> j & 1 == 1;
        let heights: [[T; 2]; N] =
            std::array::from_fn(|j| if is_flat(j) { [T::zero(), -T::zero()] } else { legs[j].heights() });
        let rows = LazyCell::new(|| ModalRows::<T, N>::new(robot, legs, &each!(|j| heights[j][0])));
        let other = demand.crossing.map(|j| demand.mode.with_other_posture(j));
        for mode in std::iter::once(demand.mode).chain(other) {
            let at = Configuration { robot, placement, legs, heights: &heights, mode };
            for constraint in Constraint::of(robot) {
                let value = match constraint.kind() {
                    Kind::Serial(_) => continue,
                    Kind::Limit if !demand.limits => continue,
                    Kind::Parallel if demand.sign == 0 => continue,
                    Kind::Limit => at.margin(constraint),
                    Kind::Parallel => self.det(&rows, mode, demand),
                };
                if !visit(constraint, value) {
                    return;
                }
            }
        }
    }

    /// H_j, or s B_jj, less what is asked of it.
    fn reach(&self, j: usize, demand: &Demand) -> T {
        if let Some(fold) = &self.legs[j].fold {
            return if demand.mode.sign(j) > 0 { fold.b } else { -fold.b };
        }
        let reach = self.legs[j].closure.reach;
        let least = if demand.crossing == Some(LegIndex::new(j)) { 0.0 } else { demand.margins.serial };
        if least > 0.0 { reach - T::constant(least_reach(self.robot, j, least)) } else { reach }
    }

    /// σ det A, less what is asked of it.
    fn det(&self, rows: &ModalRows<T, N>, mode: WorkingMode, demand: &Demand) -> T {
        let det = rows.det(mode);
        let det = if demand.sign > 0 { det } else { -det };
        if demand.margins.parallel > 0.0 {
            let unit = unit_of_det(self.robot, self.legs, rows, mode);
            return det - unit.scale(Interval::point(demand.margins.parallel));
        }
        det
    }
}
