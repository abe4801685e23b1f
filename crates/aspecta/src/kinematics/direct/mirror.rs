//! Platforms that do not turn: both direct solutions are mirror images in the line (the plane) of the centres.

use super::locked::{Locked, polish, rounds_to_zero};
use super::{Roots, SelfMotion};
use crate::num::Interval;
use crate::robot::Platform;

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
    let decided = pair.square.is_positive();
    // Newton's method closes in on two poses that meet from outside, one from either side.
    let height = if decided { pair.square.mid() } else { pair.square.hi }.max(0.0).sqrt();
    for side in [height, -height] {
        let start = std::array::from_fn(|k| pair.foot[k].mid() + side * pair.normal[k].mid());
        let pose = polish::<D, D>(platform, legs, start, f64::INFINITY);
        if decided {
            roots.push(pose)?;
        } else if rounds_to_zero::<D, D>(platform, legs, &pose) {
            roots.push_new(platform, legs, pose)?;
        }
    }
    Ok(roots)
}
