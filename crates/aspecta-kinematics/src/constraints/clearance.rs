//! The distance of a part of a leg from an obstacle as a smooth function that is positive where the part is clear of it.

use super::LegAt;
use super::limit::rod_direction;
use aspecta_robot::legs::sum_of_squares;
use aspecta_robot::num::{Interval, Scalar, dot, each};
use aspecta_robot::{Clearance, Leg, LinkPart, Solid, into_frame};

/// How far a part of a leg, in the posture of `sh` = s h, is from an obstacle: distances less the least one for walls, for round ones the square of
/// the distance from the centre less that of the radius and the least distance.
///
/// The square of the distance of a point from a link is the least of smooth functions, ‖a − t e‖² over t ∈ [0, 1], and smooth itself, because one t only attains it: with
/// τ = a·e/‖e‖² it is ‖a‖² − ‖e‖² ψ(τ), where ψ is [`Scalar::clamped_square`].
pub(super) fn margin<T: Scalar, const D: usize>(clearance: &Clearance, at: &LegAt<'_, T, D>, sh: T) -> T {
    let Clearance { solid, part, distance, .. } = clearance;
    let links = Links::of(at, sh);
    match solid {
        Solid::Ball { centre, radius } => {
            let from_anchor: [Interval; D] = std::array::from_fn(|k| centre[k] - at.leg.anchor[k]);
            let centre = into_frame(at.leg, &from_anchor);
            let least = T::constant((*radius + *distance).square());
            let back = |point: &[T; D]| -> [T; D] { each!(|k| point[k] - T::constant(centre[k])) };
            let square = match part {
                LinkPart::Crank => {
                    let away: [T; D] = each!(|k| T::constant(centre[k]));
                    from_link(&away, &links.crank, links.crank_square(at.leg))
                }
                LinkPart::Rod => from_link(&back(at.span), &links.rod, links.rod_square(at.leg)),
                LinkPart::Elbow => sum_of_squares(&back(&links.crank)),
                LinkPart::End => sum_of_squares(&back(at.span)),
            };
            square - least
        }
        Solid::Wall { normal, offset } => {
            let towards: [Interval; D] = std::array::from_fn(|k| normal[k]);
            let from_anchor = (0..D).fold(-*offset, |sum, k| sum + normal[k] * at.leg.anchor[k]) - *distance;
            let normal: [T; D] = into_frame(at.leg, &towards).map(T::constant);
            let point = match part {
                LinkPart::Elbow => &links.crank,
                // Of links the ends are asked for.
                LinkPart::End | LinkPart::Crank | LinkPart::Rod => at.span,
            };
            dot(&normal, point) + T::constant(from_anchor)
        }
    }
}

/// The links of a leg in its frame: B − A and C − B; of a strut, which has no B, all of it is the rod.
pub(super) struct Links<T, const D: usize> {
    pub crank: [T; D],
    pub rod: [T; D],
}

impl<T: Scalar, const D: usize> Links<T, D> {
    pub fn of(at: &LegAt<'_, T, D>, sh: T) -> Self {
        if at.leg.actuator.rigid_rod().is_none() {
            return Self { crank: [T::zero(); D], rod: *at.span };
        }
        let direction = rod_direction(at, sh);
        let twice = at.closure.weight + at.closure.weight;
        let rod: [T; D] = each!(|k| direction[k] / twice);
        Self { crank: each!(|k| at.span[k] - rod[k]), rod }
    }

    pub fn crank_square(&self, leg: &Leg) -> T {
        match leg.actuator.as_revolute() {
            Some(links) => T::constant(links.crank.square()),
            None => sum_of_squares(&self.crank),
        }
    }

    /// ‖∂f/∂d‖² is four times that of the rod.
    pub fn rod_square(&self, leg: &Leg) -> T {
        match leg.actuator.rigid_rod() {
            Some(_) => leg.actuator.force(&self.rod).square().scale(Interval::point(0.25)),
            None => sum_of_squares(&self.rod),
        }
    }
}

/// The square of the distance of the origin from the points a − t e, 0 ≤ t ≤ 1, of a link with ‖e‖² = `square`.
pub(super) fn from_link<T: Scalar, const D: usize>(a: &[T; D], e: &[T; D], square: T) -> T {
    sum_of_squares(a) - square * (dot(a, e) / square).clamped_square()
}
