//! Platforms that do not turn: both direct solutions are mirror images in the line (the plane) of the centres.

use super::locked::{Locked, polish};
use super::{Roots, SelfMotion};
use crate::num::Interval;
use crate::robot::Platform;
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

/// What D circles or spheres have in common.
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
/// There are at most two. If intervals cannot tell the sign of `square`, the pair is within rounding of a parallel
/// singularity; then those candidates are returned whose leg equations hold to rounding.
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
    let mut roots = Roots::none();
    roots.at_most = Some(2);
    for side in [1.0, -1.0] {
        let pose = polish::<D, D>(platform, legs, point(&pair, &centres[0], radii[0], side));
        if pair.square.is_positive() {
            roots.push(pose)?;
        } else {
            roots.push_if_solution::<D>(platform, legs, pose)?;
        }
    }
    Ok(roots)
}

/// foot ± h · normal on the first circle or sphere. The foot carries a rounding error, which is large where the
/// centres almost coincide; h is what fits the foot as it is, and the point nearest to the foot where none fits.
fn point<const D: usize>(
    pair: &MirrorPair<D>,
    centre: &[Interval; D],
    radius: Interval,
    side: f64,
) -> [f64; D] {
    let vector = |of: &[Interval; D]| SVector::<f64, D>::from_fn(|k, _| of[k].mid());
    let (centre, normal, radius) = (vector(centre), vector(&pair.normal), radius.mid());
    let arm = vector(&pair.foot) - centre;
    let height = (radius * radius - arm.norm_squared()).max(0.0).sqrt();
    let arm = arm + normal.normalize() * (side * height);
    (centre + arm * (radius / arm.norm())).into()
}
