//! Platforms that do not turn: both direct solutions are mirror images in the line (the plane) of the
//! centres.

use super::locked::{Locked, linearised, polish};
use super::{Roots, SelfMotion};
use aspecta_robot::Platform;
use aspecta_robot::num::{Interval, Scalar};
use nalgebra::SVector;

/// The points foot ± √square · normal.
#[derive(Clone, Copy, Debug)]
pub(super) struct MirrorPair<const D: usize> {
    /// Their midpoint, in the line (the plane) of the centres.
    pub foot: [Interval; D],
    /// Normal to that line (plane).
    pub normal: [Interval; D],
    /// Below zero where there are none.
    pub square: Interval,
}

impl<const D: usize> MirrorPair<D> {
    /// An enclosure of the point on one side, +1 or −1, if `square` is positive.
    fn point(&self, side: f64) -> [Interval; D] {
        let height = self.square.sqrt() * Interval::point(side);
        std::array::from_fn(|k| self.foot[k] + self.normal[k] * height)
    }
}

/// The common points of D circles or spheres.
#[derive(Clone, Copy, Debug)]
pub(super) enum Pair<const D: usize> {
    /// Nothing, proved.
    None,
    /// At most two points.
    Mirrored(MirrorPair<D>),
    /// Their centres are in line (they coincide), or cannot be told from it, and nothing keeps the
    /// circles and spheres apart.
    SelfMotion,
}

/// How wide an enclosure may be that says where a pose is, relative to half of their distance. Where the centres nearly coincide, or lie in one
/// line, it is wider than the robot.
const NARROW: f64 = 1e-9;

/// The direct solutions of `platform` (plane point or translating body) with `legs` locked, where
/// `intersect` intersects their circles or spheres.
///
/// There are at most two, and two if `square` is positive. Each then lies in the enclosure of its own formula, so it is proved where that is
/// narrow and the pose that is found lies in it as well. If intervals cannot tell the sign of `square`, the pair is within rounding of a
/// parallel singularity; then those candidates are returned whose leg equations hold to rounding.
pub(super) fn solve<const D: usize>(
    platform: Platform,
    legs: &[Locked],
    intersect: fn(&[[Interval; D]; D], &[Interval; D]) -> Pair<D>,
) -> Result<Roots<D>, SelfMotion> {
    let centres = std::array::from_fn(|j| legs[j].centre());
    let radii = std::array::from_fn(|j| legs[j].q);
    let pair = match intersect(&centres, &radii) {
        Pair::None => return Ok(Roots::none()),
        Pair::SelfMotion => return Err(SelfMotion),
        Pair::Mirrored(pair) => pair,
    };
    let vector = |of: &[Interval; D]| SVector::<f64, D>::from_fn(|k, _| of[k].mid());
    let (foot, normal) = (vector(&pair.foot), vector(&pair.normal));
    let height = pair.square.mid().max(0.0).sqrt();
    let mut roots = Roots::none();
    roots.at_most = Some(2);
    for side in [1.0, -1.0] {
        let start = foot + normal * (side * height);
        if pair.square.is_positive() {
            let range = pair.point(side);
            let narrow = range.iter().all(|range| range.width() <= NARROW * height * normal.norm());
            let pose = polish::<D, D>(platform, legs, start.into());
            let within = range.iter().zip(pose).all(|(range, x)| range.contains(x));
            roots.proved += usize::from(within && narrow);
            roots.push(pose)?;
        } else {
            let start = settled(platform, legs, start, normal.normalize());
            roots.push_if_solution::<D>(platform, legs, polish::<D, D>(platform, legs, start.into()))?;
        }
    }
    // What is proved stands first: both are or none.
    if roots.proved < 2 {
        roots.proved = 0;
    }
    Ok(roots)
}

/// The point at the same height over the line (the plane) of the centres that fulfils the leg equations best:
/// least squares by Gauss and Newton. Where the centres are almost in line, the formula of the foot is not
/// good enough.
fn settled<const D: usize>(
    platform: Platform,
    legs: &[Locked],
    mut x: SVector<f64, D>,
    normal: SVector<f64, D>,
) -> SVector<f64, D> {
    for _ in 0..3 {
        let (f, jacobian) = linearised::<D, D>(platform, legs, &x.into());
        let level = jacobian - jacobian * normal * normal.transpose();
        let squares = level.transpose() * level;
        let Some(inverse) = (squares + normal * normal.transpose() * squares.trace()).try_inverse() else {
            break;
        };
        x -= inverse * (level.transpose() * f);
    }
    x
}

#[cfg(test)]
mod tests {
    use super::super::{certify, circles, spheres};
    use super::*;
    use aspecta_robot::Leg;
    use aspecta_robot::num::Random;

    /// Struts of these lengths from these points.
    fn struts<const D: usize>(ends: &[([f64; 3], f64)]) -> Vec<Locked> {
        let leg = |(anchor, length): &([f64; 3], f64)| {
            let mut leg = Leg::strut([0.0; 2], [0.0; 2]);
            leg.anchor = anchor.map(Interval::point);
            Locked::new::<D>(&leg, *length)
        };
        ends.iter().map(leg).collect()
    }

    /// What the formula proves Krawczyk's test proves as well, of random legs and of such that nearly lie in line.
    fn agrees<const D: usize>(
        platform: Platform,
        intersect: fn(&[[Interval; D]; D], &[Interval; D]) -> Pair<D>,
    ) {
        let random = &mut Random::new(4);
        let (mut proved, mut alike) = (0, 0);
        for case in 0..2000 {
            let flat = if case % 2 == 0 { 1.0 } else { 1e-3 };
            let mut end = || {
                let anchor: [f64; 3] = std::array::from_fn(|k| {
                    let wide = if k == 0 { 1.0 } else { flat };
                    if k < D { random.within((-wide, wide)) } else { 0.0 }
                });
                (anchor, random.within((0.3, 2.0)))
            };
            let ends: Vec<_> = (0..D).map(|_| end()).collect();
            let legs = struts::<D>(&ends);
            let Ok(roots) = solve(platform, &legs, intersect) else { continue };
            if roots.proved == 0 {
                continue;
            }
            assert_eq!((roots.proved, roots.poses.len()), (2, 2));
            proved += 1;
            let boxes = roots.poses.iter().map(|&pose| certify::certify::<D, D>(platform, &legs, pose));
            if let Some(boxes) = boxes.collect::<Option<Vec<_>>>() {
                assert!(certify::disjoint(platform, &boxes[0], &boxes[1]));
                alike += 1;
            }
        }
        assert!(proved > 300 && 100 * alike >= 99 * proved, "{proved} {alike}");
    }

    #[test]
    fn circles_and_spheres_are_proved_by_their_formula() {
        agrees(Platform::PlanePoint, circles::intersect);
        agrees(Platform::TranslatingBody, spheres::intersect);
    }

    /// Motors on one axis, almost in one direction: the centres of the circles are 10⁻¹⁰ and less apart.
    #[test]
    fn nearly_equal_circles_do_not_prove_where_they_meet() {
        for gap in [1e-8, 1e-10, 1e-12, 1e-14, 5e-16] {
            let legs = struts::<2>(&[([0.07, 0.07, 0.0], 0.2), ([0.07 - gap, 0.07 + 0.9 * gap, 0.0], 0.2)]);
            let Ok(roots) = solve(Platform::PlanePoint, &legs, circles::intersect) else { continue };
            assert_eq!(roots.proved, 0, "{gap}");
        }
    }

    #[test]
    fn circles_that_touch_prove_nothing() {
        let legs = struts::<2>(&[([-1.0, 0.0, 0.0], 1.0), ([1.0, 0.0, 0.0], 1.0)]);
        let roots = solve(Platform::PlanePoint, &legs, circles::intersect).ok().unwrap();
        assert_eq!((roots.proved, roots.at_most), (0, Some(2)));
        let apart = struts::<2>(&[([-1.0, 0.0, 0.0], 0.99), ([1.0, 0.0, 0.0], 0.99)]);
        assert_eq!(solve(Platform::PlanePoint, &apart, circles::intersect).ok().unwrap().at_most, Some(0));
    }
}
