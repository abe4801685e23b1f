//! How near a path comes to singularities: minima along it, enclosed by branch and bound.

use crate::constraints::measures;
use crate::modal::{ModalRows, closures};
use crate::path::curve::Curve;
use crate::placement::Placement;
use crate::{WorkingMode, for_platform};
use aspecta_robot::Robot;
use aspecta_robot::num::{Interval, Scalar, Slope, each};
use serde::Serialize;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Bounds of a minimum are this close to each other, relative to it, unless it takes too many steps.
const CLOSE: f64 = 1e-6;
/// Bisections for one minimum, besides one for each stretch the path is given in.
const EFFORT: usize = 2000;

/// How near a path comes to singularities, up to the first that it meets if it does.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct Clearance {
    /// The least |det A|, in the unit of the leg equations: the paper's.
    pub det_a: Least,
    /// The least |det Â| ([`Margins`](crate::constraints::Margins)), which has no unit.
    pub parallel: Least,
    /// The least |B_jj| / max |B_jj| of every leg; 1 for struts.
    pub serial: Vec<Least>,
}

/// A minimum along a path. Certified: it lies within [`at_least`, `at_most`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Least {
    /// Proved lower bound along all of the path.
    pub at_least: f64,
    /// Proved upper bound: of the value at the place named below.
    pub at_most: f64,
    /// The segment, from 1 (the sample, where samples are not joined).
    pub segment: usize,
    /// t ∈ [0, 1] along the segment.
    pub t: f64,
    /// The pose.
    pub pose: Vec<f64>,
}

/// Enclosures of |det A|, |det Â| and of the |B_jj| / max |B_jj|.
pub(super) type Measures = [Interval; 8];

/// A place on a path.
pub(super) struct Place {
    pub segment: usize,
    pub t: f64,
    pub pose: Vec<f64>,
}

/// Part of a path that can be looked at more finely.
pub(super) trait Stretch: Sized + Clone {
    /// Over all of it.
    fn over(&self) -> Measures;

    /// At its start and its end.
    fn ends(&self) -> [(Place, Measures); 2];

    /// Both halves, unless it cannot be divided.
    fn halves(&self) -> Option<[Self; 2]>;
}

/// The clearance along stretches that make up a path of a robot with `legs` legs. `None` if there are none.
pub(super) fn clearance<S: Stretch>(stretches: &[S], legs: usize) -> Option<Clearance> {
    let seeds: Vec<_> = stretches.iter().map(|s| (s, s.over())).collect();
    let least = |k: usize| least(&seeds, k);
    let serial = (0..legs).map(|j| least(2 + j)).collect::<Option<_>>()?;
    Some(Clearance { det_a: least(0)?, parallel: least(1)?, serial })
}

/// Stretches are bisected where the lower bound is least, until it is close to the least value met.
fn least<S: Stretch>(seeds: &[(&S, Measures)], k: usize) -> Option<Least> {
    let mut open: BinaryHeap<Open<S>> =
        seeds.iter().map(|(s, measures)| Open { bound: measures[k].lo, stretch: (*s).clone() }).collect();
    let mut best: Option<(f64, Place)> = None;
    for spent in 0.. {
        let Open { bound, stretch } = open.pop()?;
        for (place, measures) in stretch.ends() {
            if best.as_ref().is_none_or(|(most, _)| measures[k].hi < *most) {
                best = Some((measures[k].hi, place));
            }
        }
        let most = best.as_ref().map_or(f64::INFINITY, |(most, _)| *most);
        let close = bound >= most * (1.0 - CLOSE) || spent >= EFFORT + seeds.len();
        let halves = if close { None } else { stretch.halves() };
        let Some(halves) = halves else {
            let (at_most, Place { segment, t, pose }) = best?;
            return Some(Least { at_least: bound.min(at_most), at_most, segment, t, pose });
        };
        for half in halves {
            // No less is known of a half than of the whole.
            let bound = half.over()[k].lo.max(bound);
            open.push(Open { bound, stretch: half });
        }
    }
    None
}

/// A stretch to be looked at; the least bound comes first.
struct Open<S> {
    bound: f64,
    stretch: S,
}

impl<S> Ord for Open<S> {
    fn cmp(&self, other: &Self) -> Ordering {
        other.bound.total_cmp(&self.bound)
    }
}

impl<S> PartialOrd for Open<S> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<S> PartialEq for Open<S> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<S> Eq for Open<S> {}

/// Part of a curve of poses, in a working mode that it is proved to stay in.
#[derive(Clone, Copy)]
pub(super) struct PoseStretch<'a> {
    pub robot: &'a Robot,
    pub mode: WorkingMode,
    pub curve: &'a Curve,
    pub segment: usize,
    pub from: f64,
    pub to: f64,
}

impl PoseStretch<'_> {
    fn measures(&self, range: Interval) -> Measures {
        for_platform!(self.robot.platform, measured(self.robot, self.mode, self.curve, range))
    }
}

impl Stretch for PoseStretch<'_> {
    fn over(&self) -> Measures {
        self.measures(Interval::new(self.from, self.to))
    }

    fn ends(&self) -> [(Place, Measures); 2] {
        [self.from, self.to].map(|t| {
            let pose = self.curve.at(t)[..self.robot.dof()].to_vec();
            (Place { segment: self.segment, t, pose }, self.measures(Interval::point(t)))
        })
    }

    fn halves(&self) -> Option<[Self; 2]> {
        let middle = 0.5 * (self.from + self.to);
        let divides = self.from < middle && middle < self.to;
        divides.then_some([Self { to: middle, ..*self }, Self { from: middle, ..*self }])
    }
}

/// The moduli at all t of `range`.
fn measured<const D: usize, const N: usize>(
    robot: &Robot,
    mode: WorkingMode,
    curve: &Curve,
    range: Interval,
) -> Measures {
    let x = curve.over::<N>(range);
    let placement = Placement::at(robot.platform, &x);
    let legs = closures::<Slope<Interval, 1>, D, N>(robot, &placement);
    let heights: [_; N] = each!(|j| legs[j].closure.reach.sqrt());
    let weighted = ModalRows::<_, N>::new(robot, &legs, &heights).det(mode);
    let det = legs.iter().fold(weighted, |det, leg| det / leg.closure.weight);
    let (parallel, serial) = measures::<_, D, N>(robot, &placement, mode);
    let mut all = [Interval::point(0.0); 8];
    all.iter_mut().zip([det, parallel].iter().chain(&serial)).for_each(|(to, x)| {
        *to = modulus(x.tightened().range);
    });
    all
}

/// |x|.
pub(super) fn modulus(x: Interval) -> Interval {
    let least = if x.contains(0.0) { 0.0 } else { x.lo.abs().min(x.hi.abs()) };
    Interval { lo: least, hi: x.magnitude() }
}
