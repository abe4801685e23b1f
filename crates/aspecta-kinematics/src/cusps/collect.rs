//! The findings of searches in several charts, as poses.

use super::search::{Findings, Search};
use super::{Cusps, Doubt, Undecided};
use crate::chart::Chart;
use crate::chart::Coordinates;
use aspecta_robot::Window;
use aspecta_robot::num::Interval;

/// A cusp that has been found.
pub(super) struct Known<const N: usize> {
    chart: Chart,
    /// The box of the chart in which it is the only one.
    alone: [Interval; N],
    pub pose: [Interval; N],
}

/// Adds what a search found, each cusp once: two that were proved to be alone are the same if one lies in the
/// other's box, and different if their enclosures have no pose in common.
pub(super) fn collect<const D: usize, const N: usize>(
    search: &Search<'_, D, N>,
    window: &Window,
    findings: &Findings<N>,
    known: &mut Vec<Known<N>>,
    all: &mut Cusps,
) {
    let chart = &search.system.chart;
    let pose = |region: &[Interval; N]| turned_in(window, chart.pose::<D, N>(search.system.robot, region));
    let mut undecided = |pose: [Interval; N], why| {
        let undecided = Undecided { mode: search.system.mode, enclosure: pose.to_vec(), why };
        merge(&mut all.undecided, undecided);
    };
    for found in &findings.found {
        let here = pose(&found.tight);
        let same = |k: &Known<N>| {
            let coordinates = if k.chart == *chart { &found.tight } else { &here };
            let comparable = k.chart == *chart || k.chart == Chart::Pose;
            comparable && is_within(coordinates, &k.alone, &search.window)
        };
        if known.iter().any(same) {
            continue;
        }
        if known.iter().any(|k| touches(&k.pose, &here)) {
            undecided(here, Doubt::Degenerate);
            continue;
        }
        known.push(Known { chart: chart.clone(), alone: found.alone, pose: here });
    }
    for (region, why) in &findings.doubts {
        undecided(pose(region), *why);
    }
}

fn turn() -> Interval {
    Interval::PI * Interval::point(2.0)
}

/// Full turns taken off angles whose middle is beyond the window.
fn turned_in<const N: usize>(window: &Window, pose: [Interval; N]) -> [Interval; N] {
    std::array::from_fn(|k| {
        let middle = pose[k].mid();
        match window.turned_in(k, middle) {
            x if x < middle - 1.0 => pose[k] - turn(),
            x if x > middle + 1.0 => pose[k] + turn(),
            _ => pose[k],
        }
    })
}

/// Whether `inner` lies in `outer`, up to full turns.
fn is_within<const N: usize>(inner: &[Interval; N], outer: &[Interval; N], window: &Window) -> bool {
    (0..N).all(|k| {
        let inside = |x: Interval| outer[k].lo <= x.lo && x.hi <= outer[k].hi;
        let turns = if window.glued[k] {
            vec![inner[k], inner[k] - turn(), inner[k] + turn()]
        } else {
            vec![inner[k]]
        };
        turns.into_iter().any(inside)
    })
}

fn touches(a: &[Interval], b: &[Interval]) -> bool {
    a.iter().zip(b).all(|(a, b)| a.lo <= b.hi && b.lo <= a.hi)
}

/// Adds an undecided box, in one with those that it touches and that are undecided for the same reason.
fn merge(all: &mut Vec<Undecided>, mut one: Undecided) {
    while let Some(k) = all
        .iter()
        .position(|u| u.mode == one.mode && u.why == one.why && touches(&u.enclosure, &one.enclosure))
    {
        let other = all.swap_remove(k);
        one.enclosure = one.enclosure.iter().zip(&other.enclosure).map(|(a, b)| a.hull(*b)).collect();
    }
    all.push(one);
}
