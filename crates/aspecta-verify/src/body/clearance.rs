//! How far parts of a leg are from obstacles.

use super::kinds::{elbow, rod_length};
use super::{Body, into_frame, product, square};
use aspecta_robot::num::{Interval, Scalar};
use aspecta_robot::{Clearance, LinkPart, Solid};

impl<T: Scalar, const D: usize> Body<'_, T, D> {
    /// How far a part of leg j is from an obstacle at C − A = d and q: positive where it is clear of it.
    ///
    /// The points of a link from P to Q = P + e are P + t e, t ∈ [0, 1]. Of the centre o of a disc or ball ‖P + t e − o‖² is least at t = τ = (o − P)·e/‖e‖², or at the end of [0, 1] next to it:
    /// ‖o − P‖² less 2∫ ‖e‖² min(max(τ, 0), 1) dτ from 0. A wall is nearest to an end of a link.
    pub(super) fn clearance(&self, j: usize, clearance: &Clearance, d: &[T; D], q: T) -> T {
        let leg = &self.robot.legs[j];
        let Clearance { solid, part, distance, .. } = clearance;
        let elbow = elbow(&leg.actuator, q, || self.crank(j, q));
        let to_end = || std::array::from_fn(|k| d[k] - elbow[k]);
        // From A, in the leg's frame.
        let there = |v: &[Interval; 3]| -> [T; D] {
            into_frame(leg, &std::array::from_fn::<T, D, _>(|k| T::constant(v[k] - leg.anchor[k])))
        };
        match solid {
            Solid::Ball { centre, radius } => {
                let centre = there(centre);
                let from = |p: &[T; D]| -> [T; D] { std::array::from_fn(|k| centre[k] - p[k]) };
                let nearest = match part {
                    LinkPart::Crank => beside(&centre, &elbow, square(&elbow)),
                    LinkPart::Rod => {
                        let (rod, known) = (to_end(), rod_length(&leg.actuator));
                        let length = known.map_or_else(|| square(&rod), |rod| T::constant(rod.square()));
                        beside(&from(&elbow), &rod, length)
                    }
                    LinkPart::Elbow => square(&from(&elbow)),
                    LinkPart::End => square(&from(d)),
                };
                nearest - T::constant((*radius + *distance).square())
            }
            Solid::Wall { normal, offset } => {
                let out: [T; D] = std::array::from_fn(|k| T::constant(normal[k]));
                let at_anchor = (0..D).fold(-*offset, |sum, k| sum + normal[k] * leg.anchor[k]);
                let joint = if *part == LinkPart::Elbow { &elbow } else { d };
                product(&into_frame(leg, &out), joint) + T::constant(at_anchor - *distance)
            }
        }
    }
}

/// The least ‖a − t e‖², t ∈ [0, 1], with ‖e‖² = `length`.
fn beside<T: Scalar, const D: usize>(a: &[T; D], e: &[T; D], length: T) -> T {
    square(a) - length * (product(a, e) / length).clamped_square()
}
