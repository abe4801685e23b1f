//! One generalized aspect as a function: its poses, their joint vectors, and the other poses with the same
//! joint vector.

use super::field::Field;
use super::grid::{Grid, Pose};
use crate::aspect::{Analysis, AspectId, DetSign};
use arrayvec::ArrayVec;
use aspecta_kinematics::Kinematics;
use aspecta_kinematics::direct::CAPACITY;
use aspecta_kinematics::placement::Placement;
use aspecta_kinematics::{WorkingMode, for_platform};
use aspecta_robot::num::{padded, without_turns};
use aspecta_robot::{Platform, Robot, Window};

/// Which pose of a second list each pose of a first one has become.
pub type Match = ArrayVec<usize, CAPACITY>;

/// Joint coordinates; those beyond the robot's are 0.
pub type Joints = [f64; 6];

/// An aspect A_ij: the poses of WA_ij, and g_i on them.
///
/// Whether a pose lies in the class (working mode and sign of det A) is computed in doubles, hence numerical
/// at distances from its boundary that rounding blurs. Which aspect of the class it lies in is certified
/// ([`Analysis::aspect_at`]), except that where the analysis found one aspect only, the whole class counts as
/// it.
///
/// On a slice an aspect is one of the slice's, while the other poses with a joint vector are those of the
/// whole class, most of them outside the slice.
pub struct Sheet<'a> {
    robot: &'a Robot,
    window: &'a Window,
    /// The window with nothing held, if `window` is a slice.
    whole: Option<Window>,
    mode: WorkingMode,
    sign: DetSign,
    belongs: Option<Belongs<'a>>,
}

/// Whether a pose of a class lies in the aspect.
pub(super) type Belongs<'a> = Box<dyn Fn(&[f64]) -> bool + Sync + 'a>;

impl<'a> Sheet<'a> {
    /// The aspect as a function. `None` if there is no such one, and on a slice of a robot that nothing else
    /// bounds.
    pub fn new(analysis: &'a Analysis, aspect: AspectId) -> Option<Self> {
        let (class, _) = analysis.aspect(aspect)?;
        let Analysis { robot, window, classes, .. } = analysis;
        let entry = &classes[class.index()];
        let alone = entry.aspects.len() == 1;
        let belongs = (!alone).then(|| -> Belongs<'a> {
            Box::new(move |pose| analysis.aspect_at(pose, class) == Some(aspect))
        });
        let whole = if analysis.fixed.is_empty() { None } else { Some(robot.workspace_window().ok()?) };
        Some(Self { whole, ..Self::of(robot, window, (entry.mode, entry.det_a), belongs) })
    }

    /// The poses of a class that belong to an aspect, or all of them.
    pub(super) fn of(
        robot: &'a Robot,
        window: &'a Window,
        (mode, sign): (WorkingMode, DetSign),
        belongs: Option<Belongs<'a>>,
    ) -> Self {
        Self { robot, window, whole: None, mode, sign, belongs }
    }

    /// The robot.
    pub(super) fn robot(&self) -> &'a Robot {
        self.robot
    }

    /// The working mode of the class.
    pub(super) fn mode(&self) -> WorkingMode {
        self.mode
    }

    /// On a slice: the class, of which the slice is a part.
    pub(super) fn beyond(&self) -> Option<Sheet<'_>> {
        let whole = self.whole.as_ref()?;
        Some(Sheet::of(self.robot, whole, (self.mode, self.sign), None))
    }

    /// The window in which the other poses lie.
    pub(super) fn whole(&self) -> &Window {
        self.whole.as_ref().unwrap_or(self.window)
    }

    /// The class, the other poses of the aspect included.
    pub(super) fn field<const D: usize, const N: usize>(&self, mode: WorkingMode) -> Field<'_, D, N> {
        Field { robot: self.robot, mode, sign: self.sign, window: self.whole() }
    }

    /// g_i(X), if X lies in the aspect.
    pub fn joints(&self, pose: &[f64]) -> Option<Joints> {
        let joints = self.joints_within(self.window, pose)?;
        self.belongs.as_ref().is_none_or(|belongs| belongs(pose)).then_some(joints)
    }

    /// g_i(X), if X may be one of the other poses of the aspect: on a slice, of the class. Poses at a serial
    /// singularity, which the direct model finds to rounding, are on its boundary.
    fn other_joints(&self, pose: &[f64]) -> Option<Joints> {
        let joints = match &self.whole {
            Some(whole) => self.joints_within(whole, pose),
            None => self.joints(pose),
        }?;
        (!for_platform!(self.robot.platform, is_folded(self, pose))).then_some(joints)
    }

    fn joints_within(&self, window: &Window, pose: &[f64]) -> Option<Joints> {
        let within =
            pose.iter().enumerate().all(|(k, &x)| window.fraction(k, window.turned_in(k, x)).is_some());
        within.then(|| for_platform!(self.robot.platform, in_class(self, window, pose)))?
    }

    /// Visits the other poses X′ of the aspect with g_i(X′) = q = g_i(X). False if the direct model fails: a
    /// joint vector with infinitely many poses, or poses of which none is X.
    pub fn others(&self, pose: &[f64], joints: &Joints, mut visit: impl FnMut(&[f64])) -> bool {
        let robot = self.robot;
        let Ok(poses) = robot.direct_poses(&joints[..robot.dof()]) else { return false };
        let gaps = poses.iter().map(|other| self.gap(pose, other)).enumerate();
        let Some((own, _)) = gaps.min_by(|a, b| a.1.total_cmp(&b.1)) else { return false };
        for (_, other) in poses.iter().enumerate().filter(|(k, _)| *k != own) {
            if self.other_joints(other).is_some_and(|q| self.is_posture(other, &q, joints)) {
                visit(other);
            }
        }
        true
    }

    /// How many direct solutions the joint vector of a pose has in the aspect, the pose among them; `None`
    /// outside the aspect, and where the direct model fails.
    pub fn count(&self, pose: &[f64]) -> Option<u8> {
        let joints = self.joints(pose)?;
        let mut count = 1;
        self.others(pose, &joints, |_| count += 1).then_some(count)
    }

    /// The other poses of the aspect with the joint vector of a pose; `None` outside the aspect.
    pub fn all_others(&self, pose: &[f64]) -> Option<ArrayVec<Pose, CAPACITY>> {
        let joints = self.joints(pose)?;
        let mut others = ArrayVec::new();
        self.others(pose, &joints, |other| {
            // The direct model never has more.
            let _ = others.try_push(padded(other));
        });
        Some(others)
    }

    /// The poses of the aspect with a joint vector; none where the direct model fails.
    pub fn poses(&self, joints: &Joints) -> ArrayVec<Pose, CAPACITY> {
        let robot = self.robot;
        let Ok(poses) = robot.direct_poses(&joints[..robot.dof()]) else { return ArrayVec::new() };
        let of_aspect = poses
            .iter()
            .filter(|pose| self.other_joints(pose).is_some_and(|q| self.is_posture(pose, &q, joints)));
        of_aspect.map(padded).collect()
    }

    /// Follows the other poses with the joint vectors along a segment from one end to the other: which of
    /// `of_b` each of `of_a` becomes.
    ///
    /// They must move continuously: by at most [`Sheet::STRIDE`] cells between points of the segment,
    /// 2^`parts` or as many more as it takes, but no nearer each other than 2^−[`Sheet::FINEST`] of it.
    /// `None` where they do not: one of them leaves the aspect, or another enters it.
    pub fn follow(
        &self,
        grid: &Grid,
        (a, of_a): (Pose, &[Pose]),
        (b, of_b): (Pose, &[Pose]),
        parts: u32,
    ) -> Option<Match> {
        self.follow_on(grid, (a, of_a), (b, of_b), (parts, Self::FINEST))
    }

    /// How far, in cells, a pose may jump and still count as moving continuously.
    pub const STRIDE: f64 = 2.0;
    /// How often a segment is halved.
    pub const FINEST: u32 = 10;

    fn follow_on(
        &self,
        grid: &Grid,
        (a, of_a): (Pose, &[Pose]),
        (b, of_b): (Pose, &[Pose]),
        (parts, left): (u32, u32),
    ) -> Option<Match> {
        if of_a.len() != of_b.len() {
            return None;
        }
        if parts == 0
            && let Some(found) = self.nearest(grid, of_a, of_b)
        {
            return Some(found);
        }
        if left == 0 {
            return None;
        }
        let middle: Pose = std::array::from_fn(|k| 0.5 * (a[k] + b[k]));
        let others = self.all_others(&middle[..grid.dof()])?;
        let next = (parts.saturating_sub(1), left - 1);
        let first = self.follow_on(grid, (a, of_a), (middle, &others), next)?;
        let second = self.follow_on(grid, (middle, &others), (b, of_b), next)?;
        Some(first.iter().map(|&i| second[i]).collect())
    }

    /// Returns which pose of `to` each of `from` is nearest to, if each is so near that it can have moved
    /// there, and no two to one.
    fn nearest(&self, grid: &Grid, from: &[Pose], to: &[Pose]) -> Option<Match> {
        let cell = grid.cell();
        let gap = |x: &Pose, y: &Pose| self.apart(x, y, &cell[..grid.dof()]);
        let mut found = Match::new();
        for x in from {
            let nearest = (0..to.len()).min_by(|&i, &j| gap(x, &to[i]).total_cmp(&gap(x, &to[j])))?;
            if gap(x, &to[nearest]) > Self::STRIDE || found.contains(&nearest) {
                return None;
            }
            found.push(nearest);
        }
        Some(found)
    }

    /// The greatest difference of two poses, coordinate by coordinate in parts of the window.
    pub(super) fn gap(&self, a: &[f64], b: &[f64]) -> f64 {
        let window = self.whole();
        let width: Pose = std::array::from_fn(|k| window.ranges.get(k).map_or(1.0, |r| r.1 - r.0));
        self.apart(a, b, &width[..a.len()])
    }

    /// The greatest difference of two poses, coordinate by coordinate in its own `unit`, full turns not
    /// counted. Turns in space count by their angle, in the least of the units of their coordinates: at the
    /// poles of the pitch these say little.
    fn apart(&self, a: &[f64], b: &[f64], unit: &[f64]) -> f64 {
        let angles = &self.whole().angles;
        let part = |k: usize| {
            let gap = a[k] - b[k];
            (if angles[k] { without_turns(gap) } else { gap }).abs() / unit[k]
        };
        let platform = self.robot.platform;
        if !platform.turns_in_space() {
            return (0..unit.len()).map(part).fold(0.0, f64::max);
        }
        let (moves, turns) = unit.split_at(unit.len() - 3);
        let turn = angle_between(platform, a, b) / turns.iter().copied().fold(f64::INFINITY, f64::min);
        (0..moves.len()).map(part).fold(turn, f64::max)
    }

    /// Whether the joint vector `found` of a pose in this mode is the one asked for, leg by leg nearer to it
    /// than that of the other posture.
    fn is_posture(&self, pose: &[f64], found: &Joints, asked: &Joints) -> bool {
        let robot = self.robot;
        let turned_over = for_platform!(robot.platform, turned_over(self, pose));
        robot.legs.iter().enumerate().filter(|(_, leg)| leg.actuator.postures() == 2).all(|(j, leg)| {
            let gap = |q: f64| {
                (if leg.actuator.is_angle() { without_turns(q - asked[j]) } else { q - asked[j] }).abs()
            };
            gap(found[j]) <= gap(turned_over[j])
        })
    }
}

/// The angle of the rotation from one orientation in space to another: in [0, π].
fn angle_between(platform: Platform, a: &[f64], b: &[f64]) -> f64 {
    let of = |pose: &[f64]| Placement::<f64, 3>::at(platform, pose).rotation().copied().unwrap_or_default();
    let (a, b) = (of(a), of(b));
    let square: f64 = a.as_flattened().iter().zip(b.as_flattened()).map(|(x, y)| (x - y) * (x - y)).sum();
    // The norm of the difference is 2 √2 sin(angle / 2).
    2.0 * (square / 8.0).sqrt().min(1.0).asin()
}

/// g_s(X) in a class within a window, if X lies in it.
fn in_class<const D: usize, const N: usize>(
    sheet: &Sheet<'_>,
    window: &Window,
    pose: &[f64],
) -> Option<Joints> {
    let field = Field { window, ..sheet.field::<D, N>(sheet.mode) };
    let x = std::array::from_fn(|k| pose[k]);
    field.violated(&x, &[]).is_none().then(|| padded(&field.joints(&x, &[None; 3])))
}

/// Whether a leg is at its serial singularity.
fn is_folded<const D: usize, const N: usize>(sheet: &Sheet<'_>, pose: &[f64]) -> bool {
    sheet.field::<D, N>(sheet.mode).is_folded(&std::array::from_fn(|k| pose[k]))
}

/// The joint vector in the other posture of every leg.
fn turned_over<const D: usize, const N: usize>(sheet: &Sheet<'_>, pose: &[f64]) -> Joints {
    let field = sheet.field::<D, N>(sheet.mode.opposite());
    padded(&field.joints(&std::array::from_fn(|k| pose[k]), &[None; 3]))
}
