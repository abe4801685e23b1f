//! Proofs by intervals about one working mode in a box: whether it exists, and the sign of det A.

use super::body::MOST;
use super::determinant::Turned;
use super::place::{ANY, Along, Function, Heights, OWN, Place, Posture, ZERO};
use arrayvec::ArrayVec;
use aspecta_robot::AXES;
use aspecta_robot::WorkingMode;
use aspecta_robot::constraint::Constraint;
use aspecta_robot::num::{Interval, Scalar, dot};
use std::cell::OnceCell;
use std::rc::Rc;

/// Whether a working mode is proved to exist in a box, or not to exist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Existence {
    /// Everywhere, legs strictly closed and limits strictly kept.
    Everywhere,
    /// Nowhere.
    Nowhere,
    Unknown,
}

/// The robot in one working mode over a box, or over the part of its configurations where some h_j are in
/// given ranges.
pub(super) struct InMode<'p, 'a, const D: usize> {
    pub place: &'p Place<'a, D>,
    pub mode: WorkingMode,
    pub legs: ArrayVec<Rc<Posture>, MOST>,
    determinant: OnceCell<Determinant>,
}

/// det A over a box.
pub(super) struct Determinant {
    pub range: Interval,
    /// Derivatives along the axes, all q being fixed.
    pub along: [Interval; AXES],
    /// Derivatives with respect to the q's.
    pub by_joint: [Interval; MOST],
    pub turned: Turned,
}

impl<'p, 'a, const D: usize> InMode<'p, 'a, D> {
    pub(super) fn new(place: &'p Place<'a, D>, mode: WorkingMode, legs: ArrayVec<Rc<Posture>, MOST>) -> Self {
        Self { place, mode, legs, determinant: OnceCell::new() }
    }

    /// Whether some leg is loose.
    pub(super) fn is_loose(&self) -> bool {
        self.legs.iter().any(|leg| leg.loose)
    }

    /// The ranges of h_j of the legs that are near a serial singularity for the size of the box, or `None` if
    /// none is.
    pub(super) fn heights_near_zero(&self) -> Option<Heights> {
        let is_near =
            |j: usize, leg: &Posture| self.place.setting.has_root(j) && leg.reach.lo <= NEAR * leg.reach.hi;
        let height = |j: usize| match self.legs.get(j) {
            // Legs that are one and the same have one h.
            Some(_) if self.place.setting.first_of(j) != j => ANY,
            Some(leg) if leg.loose || is_near(j, leg) => leg.reach.sqrt(),
            _ => ANY,
        };
        let heights = std::array::from_fn(height);
        heights.iter().any(|&range| range != ANY).then_some(heights)
    }

    /// The configurations whose h_j are in these ranges, if there are any.
    pub(super) fn part(&self, heights: &Heights) -> Option<Self> {
        let leg = |j: usize| {
            let height = heights[self.place.setting.first_of(j)];
            if height == ANY {
                return Some(self.legs[j].clone());
            }
            let posture = usize::from(self.mode.sign(j) < 0);
            let leg = self.place.posture(j, posture, part(self.place.reach[j], height)?);
            let is_replaced = self.place.setting.replaced_in(self.mode).any(|pair| pair.contains(&j));
            Some(if is_replaced {
                leg.with_row(self.legs[j].over.row, self.legs[j].at_middle.row)
            } else {
                Rc::new(leg)
            })
        };
        let legs = (0..self.legs.len()).map(leg).collect::<Option<_>>()?;
        Some(Self::new(self.place, self.mode, legs))
    }

    /// Whether the mode exists.
    pub(super) fn existence(&self) -> Existence {
        let mut known = Existence::Everywhere;
        for constraint in Constraint::of(self.place.setting.robot) {
            let values: ArrayVec<Interval, 2> = match constraint {
                Constraint::Reach(j) => [self.legs[j.index()].reach, self.legs[j.index()].slope].into(),
                Constraint::Limit(j, k) => [self.legs[j.index()].limits[k]].into_iter().collect(),
                Constraint::RodAngle(_, k) => {
                    let limit = &self.place.setting.robot.rod_angles[k];
                    std::iter::once(self.rod_angle(limit).range).collect()
                }
                Constraint::Apart(_, k) => {
                    std::iter::once(self.clearance_of(&self.place.setting.robot.pairs[k])).collect()
                }
                // Its sign is not the mode's.
                Constraint::Det => continue,
            };
            for value in values {
                if value.hi <= 0.0 {
                    return Existence::Nowhere;
                }
                if !value.is_positive() {
                    known = Existence::Unknown;
                }
            }
        }
        known
    }

    pub(super) fn determinant(&self) -> &Determinant {
        self.determinant.get_or_init(|| self.expand())
    }

    fn expand(&self) -> Determinant {
        let n = self.legs.len();
        let over = self.rows(|leg, i| {
            let f = &leg.over.row[i];
            Along { value: f.value, gradient: std::array::from_fn(|a| leg.along(f, a)) }
        });
        let at_middle = self.rows(Posture::entry_at_middle);
        let turned = Turned::near(&at_middle);
        let (cofactors, middle) = (turned.cofactors(&over), turned.cofactors(&at_middle));
        let cofactor = |j: usize, i: usize| self.place.centred(&cofactors[j][i], middle[j][i]);
        let cofactors: [[Interval; MOST]; MOST] =
            std::array::from_fn(|j| std::array::from_fn(|i| cofactor(j, i)));
        let sum = |j: usize, derivative: &dyn Fn(&Function) -> Interval| {
            (0..n).fold(ZERO, |sum, i| sum + cofactors[j][i] * derivative(&self.legs[j].over.row[i]))
        };
        let by_joint = std::array::from_fn(|j| if j < n { sum(j, &|f| f.gradient[OWN]) } else { ZERO });
        let along = |a: usize| (0..n).fold(ZERO, |all, j| all + sum(j, &|f| f.gradient[a]));
        let total = |a: usize| (0..n).fold(ZERO, |all, j| all + sum(j, &|f| self.legs[j].along(f, a)));
        // By each row too: a wide row then counts once.
        let narrowest = |rows: &[[Interval; MOST]], cofactors: &[[Interval; MOST]; MOST]| {
            let by_row = rows.iter().zip(cofactors).map(|(row, cofactors)| dot(row, cofactors));
            by_row.fold(turned.determinant(rows), Interval::meet)
        };
        let value = narrowest(&self.rows(|leg, i| leg.over.row[i].value), &cofactors);
        let over = Along { value, gradient: std::array::from_fn(total) };
        let mut range = self.place.centred(&over, narrowest(&at_middle, &middle));
        if self.is_loose() {
            // The q's of loose legs counted from their middles: near a serial singularity this is often the
            // narrower.
            let still = turned.determinant(&self.rows(|leg, i| leg.at_middle.row[i]));
            let loose = self.legs.iter().zip(by_joint).filter(|(leg, _)| leg.loose);
            let moved = loose.fold(still, |sum, (leg, slope)| sum + slope * (leg.q - leg.middle));
            range = range.meet(self.place.centred(&over, moved));
        }
        Determinant { range, along: std::array::from_fn(along), by_joint, turned }
    }

    /// Entries of A, by leg and column.
    fn rows<T>(&self, entry: impl Fn(&Posture, usize) -> T) -> ArrayVec<[T; MOST], MOST> {
        self.legs.iter().map(|leg| std::array::from_fn(|i| entry(leg, i))).collect()
    }
}

/// A leg is near a serial singularity if H may be less than this much of its greatest value in the box.
const NEAR: f64 = 0.5;

/// The part of a range of H where √H is in `height`, if there is one.
fn part(reach: Interval, height: Interval) -> Option<Interval> {
    let square = height.square();
    let (lo, hi) = (reach.lo.max(square.lo), reach.hi.min(square.hi));
    (lo <= hi).then(|| Interval::new(lo, hi))
}
