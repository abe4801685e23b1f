//! Whether the charts cover what they must, and how they meet.

use super::body::Body;
use super::cells::Cells;
use super::place::{Coordinates, Place, Setting};
use crate::certificate::Certificate;
use crate::kinematics::chart::{Chart, Fold};
use crate::num::{Interval, Scalar};
use crate::paving::ClassSet;
use crate::robot::{Actuator, Platform, Robot, Window};

/// The window of a chart, given that of the poses.
pub(super) fn window_of(chart: &Chart, poses: &Window) -> Window {
    let turn = (-Interval::PI.hi, Interval::PI.hi);
    // The coordinates that take the place of those of the pose, and how many of them are angles.
    let (ranges, angles) = match chart {
        Chart::Pose => ([None; 3], 0),
        Chart::Fold(fold) => ([Some(turn), Some((-fold.half_width, fold.half_width)), fold.axial], 1),
        Chart::Chain(_) => ([Some(turn); 3], 3),
    };
    let mut window = poses.clone();
    for (k, range) in ranges.into_iter().enumerate().filter_map(|(k, range)| Some((k, range?))) {
        window.ranges[k] = range;
        window.glued[k] = k < angles;
        window.angles[k] = k < angles;
        window.cut[k] = (false, false);
    }
    window
}

/// The charts of a certificate, by sheet from 1.
pub(super) fn of(certificate: &Certificate) -> Vec<&Chart> {
    certificate.sheets.iter().skip(1).map(|sheet| &sheet.chart).collect()
}

/// What is wrong with the window of the poses.
pub(super) fn fault_of_window(certificate: &Certificate) -> Option<String> {
    let held: Vec<(usize, f64)> = certificate.window.held().collect();
    match certificate.robot.slice(&held) {
        Ok(window) if window == certificate.window => None,
        Ok(_) => Some("the window is not the one that holds the workspace of the robot".into()),
        Err(error) => Some(error.to_string()),
    }
}

/// What is wrong with the chart of a fold.
pub(super) fn fault_of_fold(robot: &Robot, poses: &Window, fold: &Fold) -> Option<&'static str> {
    let translations = if robot.platform == Platform::TranslatingBody { 0..3 } else { 0..2 };
    let whole = |k: usize| poses.ranges[k].0 < poses.ranges[k].1 && poses.cut[k] == (false, false);
    if !translations.into_iter().all(whole) {
        return Some("the chart of a fold, but a translation is held or cut by the window");
    }
    let actuator = Actuator::Revolute { crank: fold.crank, rod: fold.rod };
    if robot.legs[fold.leg].actuator != actuator {
        return Some("the lengths of the fold are not those of the robot's leg");
    }
    let widest = fold.axial.map_or(0.0, |(lo, hi)| lo.abs().max(hi.abs()));
    let across = Interval::point(fold.half_width).square() + Interval::point(widest).square();
    (across.hi >= 1.0).then_some("the chart of a fold reaches round to where the rod points outwards")
}

/// Most boxes into which a chart is cut to prove it disjoint from another.
const EFFORT: usize = 100_000;

/// Whether no configuration is in two charts; `setting` is that of the first.
pub(super) fn are_disjoint<const D: usize>(
    setting: &Setting<'_>,
    chart: &Chart,
    other_chart: &Chart,
) -> bool {
    let (Chart::Fold(fold), Chart::Fold(other)) = (chart, other_chart) else { return false };
    if fold.leg == other.leg {
        return match (fold.axial, other.axial) {
            (Some(a), Some(b)) => a.1 < b.0 || b.1 < a.0,
            _ => false,
        };
    }
    let range =
        |k: usize| setting.window.ranges.get(k).map_or(Interval::point(0.0), |r| Interval::new(r.0, r.1));
    let mut open: Vec<Coordinates> = vec![std::array::from_fn(range)];
    for _ in 0..EFFORT {
        let Some(y) = open.pop() else { return true };
        if !Place::<D>::new(setting, y).is_clear_of(other_chart) {
            open.extend(setting.halves(&y));
        }
    }
    false
}

/// The poses of a box of a chart.
pub(super) fn poses<const D: usize>(setting: &Setting<'_>, y: &Coordinates) -> Coordinates {
    let mut pose = *y;
    if let Chart::Chain(_) = setting.chart {
        let body = Body::<Interval, 3>::new(setting.robot, setting.chart, y);
        pose[..3].copy_from_slice(&body.roll_pitch_yaw());
    } else {
        pose[..D].copy_from_slice(Body::<Interval, D>::new(setting.robot, setting.chart, y).origin());
    }
    pose
}

/// Most times a face is halved to see what it touches.
const HALVINGS: u32 = 12;

/// The leaves of sheet 0 that a leaf of another chart may meet on its outer faces: for a fold those of p, and of w in space. They
/// are not covered and have a class in common with it.
pub(super) fn met_outside<const D: usize>(
    setting: &Setting<'_>,
    cells: &Cells,
    leaf: usize,
    sheet_0: &Cells,
) -> Vec<usize> {
    let claims = cells.leaves[leaf].claims;
    let y = cells.of(leaf);
    let mut found = Vec::new();
    if setting.chart.is_whole() {
        return found;
    }
    for k in 1..D {
        let [low, high] = cells.at_ends(leaf, k);
        for (_, end) in [(low, y[k].lo), (high, y[k].hi)].into_iter().filter(|(outer, _)| *outer) {
            let mut face = y;
            face[k] = Interval::point(end);
            meet::<D>(setting, &face, claims.inside | claims.undecided, sheet_0, HALVINGS, &mut found);
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

fn meet<const D: usize>(
    setting: &Setting<'_>,
    face: &Coordinates,
    classes: ClassSet,
    sheet_0: &Cells,
    halvings: u32,
    found: &mut Vec<usize>,
) {
    let pose = poses::<D>(setting, face);
    let mut here = Vec::new();
    sheet_0.meeting(&pose, &mut |leaf| {
        let claims = sheet_0.leaves[leaf].claims;
        if !claims.covered && (claims.inside | claims.undecided) & classes != 0 {
            here.push(leaf);
        }
    });
    let small = here.iter().all(|&leaf| {
        let cell = sheet_0.of(leaf);
        (0..pose.len()).all(|k| pose[k].width() <= 0.5 * cell[k].width())
    });
    if small || halvings == 0 {
        found.extend(here);
        return;
    }
    let [low, high] = setting.halves(face);
    meet::<D>(setting, &low, classes, sheet_0, halvings - 1, found);
    meet::<D>(setting, &high, classes, sheet_0, halvings - 1, found);
}
