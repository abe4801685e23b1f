//! A point of the plane on two legs: two circles.

use super::mirror::{MirrorPair, Pair};
use aspecta_robot::num::{Interval, Scalar};

/// The common points of the circles round `p` with radii `r`.
///
/// With d = P₂ − P₁ and J d = d turned by a right angle they are
///
/// > (P₁ + P₂)/2 + d (R₁² − R₂²) / (2‖d‖²) ± J d √N / (2‖d‖²),
/// > N = ((R₁ + R₂)² − ‖d‖²) (‖d‖² − (R₁ − R₂)²),
///
/// 16 times the square of the triangle's area (Heron). It treats the circles alike and divides only by the
/// distance of their centres. It replaces (9) of the paper, which divides by zero where a = 0.
pub(super) fn intersect(p: &[[Interval; 2]; 2], r: &[Interval; 2]) -> Pair<2> {
    let d = [p[1][0] - p[0][0], p[1][1] - p[0][1]];
    let distance2 = d[0].square() + d[1].square();
    let (sum, difference) = (r[0] + r[1], r[0] - r[1]);
    let beyond = sum.square() - distance2;
    let within = distance2 - difference.square();
    if beyond.is_negative() || within.is_negative() {
        return Pair::None;
    }
    if !distance2.is_positive() {
        return Pair::SelfMotion;
    }
    let along = sum * difference / distance2.scale(Interval::point(2.0));
    let half = Interval::point(0.5);
    let foot = std::array::from_fn(|k| (p[0][k] + p[1][k]) * half + d[k] * along);
    let normal = [-d[1], d[0]];
    let height = distance2.scale(Interval::point(2.0));
    Pair::Mirrored(MirrorPair { foot, normal, square: beyond * within / height.square() })
}
