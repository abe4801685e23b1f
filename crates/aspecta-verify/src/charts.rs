//! Whether the charts cover what they must, and how they meet.

use super::Sheet;
use super::body::{Body, Links};
use super::place::{Coordinates, Place, Setting};
use crate::certificate::Certificate;
use aspecta_robot::chart::{Chain, Chart, Fold};
use aspecta_robot::num::{Interval, Scalar, cross, dot};
use aspecta_robot::{Platform, Revolute, Robot, Window, work};

/// The window of a chart, given that of the poses.
pub(super) fn window_of(chart: &Chart, poses: &Window) -> Window {
    let turn = (-Interval::PI.hi, Interval::PI.hi);
    let about_zero = |half_width: f64| (-half_width, half_width);
    // The coordinates that take the place of those of the pose, and which of them are angles.
    let (ranges, angles) = match chart {
        Chart::Pose => ([None; 3], [false; 3]),
        Chart::Fold(fold) => {
            ([Some(turn), Some(about_zero(fold.half_width)), fold.axial], [true, false, false])
        }
        Chart::Chain(chain) => {
            let elbow = chain.bend.as_ref().map_or(turn, |bend| about_zero(bend.half_width));
            ([Some(turn), Some(elbow), Some(turn)], [true; 3])
        }
    };
    let mut window = poses.clone();
    for (k, range) in ranges.into_iter().enumerate().filter_map(|(k, range)| Some((k, range?))) {
        window.ranges[k] = range;
        window.glued[k] = range == turn;
        window.angles[k] = angles[k];
        window.cut[k] = (false, false);
    }
    window
}

/// The charts of a certificate, by sheet from 1.
pub(super) fn of(certificate: &Certificate) -> Vec<&Chart> {
    certificate.sheets.iter().skip(1).map(|sheet| &sheet.chart).collect()
}

/// The sheet whose leaves, and those that replace some of them, hold all configurations: that of a chain that
/// holds all, or of the poses.
pub(super) fn base_of(charts: &[&Chart]) -> usize {
    usize::from(charts.first().is_some_and(|chart| chart.is_whole()))
}

/// The sheet over which a sheet from 1 on lies: the base, or for the base itself the poses.
pub(super) fn beneath(sheet: usize, base: usize) -> usize {
    if sheet > base { base } else { 0 }
}

/// Returns the fault of the window of poses, if it has one.
pub(super) fn fault_of_window(certificate: &Certificate) -> Option<String> {
    let held: Vec<(usize, f64)> = certificate.window.held().collect();
    match certificate.robot.slice(&held) {
        Ok(window) if window == certificate.window => None,
        Ok(_) => Some("the window is not the one that holds the workspace of the robot".into()),
        Err(error) => Some(error.to_string()),
    }
}

/// Returns the fault of the chart of a fold, if it has one.
pub(super) fn fault_of_fold(robot: &Robot, poses: &Window, fold: &Fold) -> Option<&'static str> {
    let translations = if robot.platform == Platform::TranslatingBody { 0..3 } else { 0..2 };
    let whole = |k: usize| poses.ranges[k].0 < poses.ranges[k].1 && poses.cut[k] == (false, false);
    if !translations.into_iter().all(whole) {
        return Some("the chart of a fold, but a translation is held or cut by the window");
    }
    let actuator = Revolute { crank: fold.crank, rod: fold.rod };
    if robot.leg(fold.leg).actuator != actuator.into() {
        return Some("the lengths of the fold are not those of the robot's leg");
    }
    let widest = fold.axial.map_or(0.0, |(lo, hi)| lo.abs().max(hi.abs()));
    let across = Interval::point(fold.half_width).square() + Interval::point(widest).square();
    (across.hi >= 1.0).then_some("the chart of a fold reaches round to where the rod points outwards")
}

/// Most boxes into which a chart is cut to prove it disjoint from another.
const EFFORT: usize = 100_000;

/// Whether no configuration is in two charts, each a part of all of them; `setting` is that of the first.
pub(super) fn are_disjoint<const D: usize>(
    setting: &Setting<'_>,
    chart: &Chart,
    other_chart: &Chart,
) -> bool {
    match (chart, other_chart) {
        (Chart::Fold(fold), Chart::Fold(other)) if fold.leg == other.leg => {
            return match (fold.axial, other.axial) {
                (Some(a), Some(b)) => a.1 < b.0 || b.1 < a.0,
                _ => false,
            };
        }
        (Chart::Fold(_), Chart::Fold(_)) => {}
        (Chart::Chain(chain), Chart::Chain(other)) => {
            let caps = Cap::of(setting.robot, chain).zip(Cap::of(setting.robot, other));
            return caps.is_some_and(|(cap, other)| cap.is_apart_from(&other));
        }
        _ => return false,
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

/// The orientations of a bend: the platform's joint v is within `radius` (rad) of an end of the motor's axis.
struct Cap {
    end: [Interval; 3],
    joint: [Interval; 3],
    radius: Interval,
}

impl Cap {
    fn of(robot: &Robot, chain: &Chain) -> Option<Self> {
        let (leg, bend) = (robot.leg(chain.leg), chain.bend.as_ref()?);
        let links = Links::of(leg)?;
        let ((cos_a, sin_a), (cos_b, sin_b)) = (links.proximal, links.distal);
        let side = Interval::point(if bend.back { 1.0 } else { -1.0 });
        let cos = side * cos_a * cos_b + sin_a * sin_b * Interval::point(bend.half_width).sin_cos().1;
        let radius = Interval::angle(cos, (Interval::point(1.0) - cos.square()).sqrt())?;
        Some(Self { end: leg.frame[2].map(|x| side * x), joint: leg.attachment, radius })
    }

    /// If an orientation were in both, each joint would be near its end: the angle between the joints and
    /// that between the ends would differ by no more than the radii, by the triangle inequality on the
    /// sphere.
    fn is_apart_from(&self, other: &Self) -> bool {
        let (Some(ends), Some(joints)) = (between(&self.end, &other.end), between(&self.joint, &other.joint))
        else {
            return false;
        };
        let apart = if ends.lo > joints.lo { ends - joints } else { joints - ends };
        (apart - self.radius - other.radius).is_positive()
    }
}

/// The angle between two vectors, in [0, π].
fn between(x: &[Interval; 3], y: &[Interval; 3]) -> Option<Interval> {
    let [a, b, c] = cross(x, y).map(Interval::square);
    Interval::angle(dot(x, y), (a + b + c).sqrt())
}

/// Encloses a box of a sheet in the coordinates of the sheet beneath, whose chart is `under`, in each posture
/// of a chain's leg.
pub(super) fn images<const D: usize>(
    setting: &Setting<'_>,
    y: &Coordinates,
    under: &Chart,
) -> Vec<Coordinates> {
    let body = Body::<Interval, D>::new(setting.robot, setting.chart, y);
    let mut image = *y;
    match (under, setting.chart) {
        (Chart::Chain(chain), _) => return body.joint_angles(chain).into(),
        (_, Chart::Chain(_)) => image[..3].copy_from_slice(&body.roll_pitch_yaw()),
        _ => image[..D].copy_from_slice(body.origin()),
    }
    vec![image]
}

/// Most times a face is halved to see what it touches.
const HALVINGS: u32 = 4;

/// Per leaf of the base, whether a chart may hold some of its configurations and not all.
pub(super) fn partly_in<const D: usize>(base: &Sheet<'_>, chart: &Chart) -> Vec<bool> {
    let is_partly_in = |leaf: usize| {
        let claims = base.cells.leaves[leaf].claims;
        !claims.covered
            && claims.inside | claims.undecided != 0
            && !Place::<D>::new(&base.setting, base.cells.of(leaf)).is_clear_of(chart)
    };
    work::map_range(base.cells.leaves.len(), is_partly_in)
}

/// The leaves of the base that a leaf of a later sheet may meet on the outer faces of its chart, of those
/// that are `partly` in it. They have a class in common with it.
pub(super) fn met_outside<const D: usize>(
    sheet: &Sheet<'_>,
    leaf: usize,
    base: &Sheet<'_>,
    partly: &[bool],
) -> Vec<usize> {
    let Sheet { setting, cells } = sheet;
    let claims = cells.leaves[leaf].claims;
    let y = cells.of(leaf);
    let mut found = Vec::new();
    let ends = match setting.chart {
        // p, and w in space.
        Chart::Fold(_) => 1..D,
        // The elbow's angle.
        Chart::Chain(Chain { bend: Some(_), .. }) => 1..2,
        Chart::Pose | Chart::Chain(_) => 0..0,
    };
    let classes = claims.inside | claims.undecided;
    let matters = |other: usize| {
        let others = base.cells.leaves[other].claims;
        partly[other] && (others.inside | others.undecided) & classes != 0
    };
    for k in ends {
        let [low, high] = cells.at_ends(leaf, k);
        for (_, end) in [(low, y[k].lo), (high, y[k].hi)].into_iter().filter(|(outer, _)| *outer) {
            let mut face = y;
            face[k] = Interval::point(end);
            meet::<D>(setting, &face, base, &matters, HALVINGS, &mut found);
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

fn meet<const D: usize>(
    setting: &Setting<'_>,
    face: &Coordinates,
    base: &Sheet<'_>,
    matters: &impl Fn(usize) -> bool,
    halvings: u32,
    found: &mut Vec<usize>,
) {
    let mut here = Vec::new();
    let mut small = true;
    for image in images::<D>(setting, face, base.setting.chart) {
        base.cells.meeting(&image, &mut |leaf| {
            if matters(leaf) {
                let cell = base.cells.of(leaf);
                small &= (0..image.len()).all(|k| image[k].width() <= 0.5 * cell[k].width());
                here.push(leaf);
            }
        });
    }
    if small || halvings == 0 {
        found.extend(here);
        return;
    }
    let [low, high] = setting.halves(face);
    meet::<D>(setting, &low, base, matters, halvings - 1, found);
    meet::<D>(setting, &high, base, matters, halvings - 1, found);
}
