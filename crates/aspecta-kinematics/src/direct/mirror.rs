//! Platforms that do not turn: both direct solutions are mirror images in the line (the plane) of the
//! centres.

use super::locked::{Locked, linearised, polish};
use super::{Roots, SelfMotion};
use aspecta_robot::Platform;
use aspecta_robot::num::Interval;
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

/// The direct solutions of `platform` (plane point or translating body) with `legs` locked, where
/// `intersect` intersects their circles or spheres.
///
/// There are at most two. If intervals cannot tell the sign of `square`, the pair is within rounding of a
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
    for side in [height, -height] {
        let start = foot + normal * side;
        if pair.square.is_positive() {
            roots.push(polish::<D, D>(platform, legs, start.into()))?;
        } else {
            let start = settled(platform, legs, start, normal.normalize());
            roots.push_if_solution::<D>(platform, legs, polish::<D, D>(platform, legs, start.into()))?;
        }
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
