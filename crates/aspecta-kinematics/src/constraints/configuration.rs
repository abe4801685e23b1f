//! The limits of the machine at one configuration.

use super::bodies::TwoBodies;
use super::rods::TwoLegs;
use super::{Constraint, LegAt, margin, unit};
use crate::modal::{LegClosure, closures};
use crate::placement::Placement;
use aspecta_robot::WorkingMode;
use aspecta_robot::num::{Interval, Jet, Scalar, each};
use aspecta_robot::{LegIndex, Robot};

/// A configuration, or a box of them: the pose and the postures of the legs.
#[derive(Clone, Copy)]
pub struct Configuration<'a, T, const D: usize, const N: usize> {
    /// The robot.
    pub robot: &'a Robot,
    /// Where the platform is.
    pub placement: &'a Placement<T, D>,
    /// The legs there.
    pub legs: &'a [LegClosure<T, D>; N],
    /// s h of every leg in both postures ([`LegClosure::heights`]).
    pub heights: &'a [[T; 2]; N],
    /// The postures.
    pub mode: WorkingMode,
}

impl<'a, T: Scalar, const D: usize, const N: usize> Configuration<'a, T, D, N> {
    fn leg(&self, j: usize) -> LegAt<'a, T, D> {
        LegAt::of(&self.robot.legs[j], &self.legs[j])
    }

    /// s h of leg j.
    fn height(&self, j: usize) -> T {
        self.heights[j][usize::from(self.mode.sign(j) < 0)]
    }

    /// Two legs.
    fn two(&self, legs: [LegIndex; 2]) -> TwoLegs<'a, T, D> {
        TwoLegs(legs.map(|j| (self.leg(j.index()), self.height(j.index()))))
    }

    /// Pair k of bodies.
    pub fn bodies(&self, k: usize) -> TwoBodies<T, D> {
        let heights: [T; N] = each!(|j| self.height(j));
        TwoBodies::of(self.robot, &self.robot.pairs[k], self.placement, self.legs, &heights)
    }

    /// Returns how far inside a limit it is; only the sign has a meaning. Of singularities, which need more
    /// than this, nothing is said.
    pub fn margin(&self, constraint: Constraint) -> T {
        match constraint {
            Constraint::Limit(j, k) => margin(
                &self.robot.leg(j).limits[k],
                &self.leg(j.index()),
                self.height(j.index()),
                self.placement,
            ),
            Constraint::RodAngle(legs, k) => self.two(legs).margin(&self.robot.rod_angles[k]),
            Constraint::Apart(_, k) => self.bodies(k).margin(),
            Constraint::Reach(_) | Constraint::Det => T::constant(Interval::ENTIRE),
        }
    }

    /// Returns the divisor of [`Self::margin`] that makes it one and the same function of the
    /// configuration, whatever coordinates it was computed in.
    pub fn unit(&self, constraint: Constraint) -> T {
        match constraint {
            Constraint::Limit(j, k) => {
                unit(&self.robot.leg(j).limits[k], &self.leg(j.index()), self.height(j.index()))
            }
            Constraint::RodAngle(legs, k) => self.two(legs).unit(&self.robot.rod_angles[k]),
            Constraint::Apart(..) => T::constant(Interval::point(1.0)),
            Constraint::Reach(_) | Constraint::Det => T::constant(Interval::ENTIRE),
        }
    }

    /// The derivative of margin / unit with respect to s h of leg `of`, on which it depends, at a fixed pose. `value` is what it is of
    /// functions of the pose: they count as numbers. Of two bodies nothing is said: [`Self::bodies_by_height`] has them.
    pub fn by_height<U: Scalar>(&self, constraint: Constraint, of: usize, value: impl Fn(T) -> U) -> U {
        let still = |f: T| Jet::<U, 1>::fixed(value(f));
        let height = |j: usize| self.varied(j, of, &value);
        match constraint {
            Constraint::Limit(j, k) => {
                // One by one: as a tuple they would be copied twice, which is seen in the proof that nothing is hidden.
                let leg = self.legs[j.index()].map(still);
                let placement = self.placement.map(still);
                let sh = height(j.index());
                let (limit, at) = (&self.robot.leg(j).limits[k], LegAt::of(self.robot.leg(j), &leg));
                (margin(limit, &at, sh, &placement) / unit(limit, &at, sh)).gradient[0]
            }
            Constraint::RodAngle(legs, k) => {
                let closures = legs.map(|j| self.legs[j.index()].map(still));
                let of =
                    |i: usize| (LegAt::of(self.robot.leg(legs[i]), &closures[i]), height(legs[i].index()));
                let (two, limit) = (TwoLegs([of(0), of(1)]), &self.robot.rod_angles[k]);
                (two.margin(limit) / two.unit(limit)).gradient[0]
            }
            Constraint::Apart(..) | Constraint::Reach(_) | Constraint::Det => U::constant(Interval::ENTIRE),
        }
    }

    /// Pair k of bodies with s h of leg `of` as the only variable, as in [`Self::by_height`].
    pub fn bodies_by_height<U: Scalar>(
        &self,
        k: usize,
        of: usize,
        value: impl Fn(T) -> U,
    ) -> TwoBodies<Jet<U, 1>, D> {
        let still = |f: T| Jet::<U, 1>::fixed(value(f));
        let (placement, legs) = (self.placement.map(still), self.legs.each_ref().map(|leg| leg.map(still)));
        let heights: [_; N] = each!(|j| self.varied(j, of, &value));
        TwoBodies::of(self.robot, &self.robot.pairs[k], &placement, &legs, &heights)
    }

    /// s h of leg j, a variable if it is leg `of`.
    fn varied<U: Scalar>(&self, j: usize, of: usize, value: &impl Fn(T) -> U) -> Jet<U, 1> {
        match j == of {
            true => Jet::variable(value(self.height(j)), 0),
            false => Jet::fixed(value(self.height(j))),
        }
    }

    /// The limits and their margins.
    pub fn limits(&self) -> impl Iterator<Item = (Constraint, T)> {
        let limits = Constraint::of(self.robot).filter(|constraint| constraint.is_limit());
        limits.map(|constraint| (constraint, self.margin(constraint)))
    }
}

/// Whether anything but singularities bounds the aspects of a robot.
pub fn is_limited(robot: &Robot) -> bool {
    Constraint::of(robot).any(Constraint::is_limit)
}

/// Whether the user's window holds a pose and all limits are strictly kept there, for every mode asked about.
pub(crate) fn within_limits<const D: usize, const N: usize>(
    robot: &Robot,
    pose: &[f64],
) -> impl Fn(WorkingMode) -> bool {
    let there = is_limited(robot).then(|| {
        let placement = Placement::<f64, D>::at(robot.platform, pose);
        let legs = closures::<f64, D, N>(robot, &placement);
        let heights: [[f64; 2]; N] = std::array::from_fn(|j| legs[j].heights());
        (placement, legs, heights)
    });
    let in_window = robot.beyond_window(pose).is_none();
    move |mode| {
        in_window
            && there.as_ref().is_none_or(|(placement, legs, heights)| {
                let at = Configuration { robot, placement, legs, heights, mode };
                at.limits().all(|(_, margin)| margin > 0.0)
            })
    }
}
