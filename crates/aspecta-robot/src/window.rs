//! The part of the pose space that holds the whole workspace.

use super::{Leg, Platform, Robot};
use crate::num::{Interval, padded};
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A box of poses that holds every pose the robot can take, as proved from its link lengths, cut by
/// the window the user may have set.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Window {
    /// Range of each coordinate; (−π, π) rounded outward for a full turn, (v, v) for a coordinate held at v.
    pub ranges: Vec<(f64, f64)>,
    /// Which coordinates close up on themselves (a full turn).
    pub glued: Vec<bool>,
    /// Which coordinates are angles (rad).
    pub angles: Vec<bool>,
    /// Which ends of each range the user's window cuts: the workspace may go on beyond them.
    pub cut: Vec<(bool, bool)>,
}

/// A coordinate that nothing bounds.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "robot `{robot}`: nothing bounds the coordinate `{coordinate}`; give limits to the actuators of the \
     prismatic legs or struts, or a range for `{coordinate}` in the [window] table"
)]
pub struct Unbounded {
    /// The robot's name.
    pub robot: String,
    /// The coordinate.
    pub coordinate: &'static str,
}

impl Robot {
    /// A box that holds the workspace W.
    ///
    /// A leg keeps C within a ball about each place its actuator can put the rod's end (crank + rod
    /// about the anchor, the rod about the slider's segment, the longest strut), and the platform's
    /// origin within ‖c_i‖ more; the box is the common part over the legs.
    ///
    /// # Errors
    /// [`Unbounded`] if some coordinate has no bound.
    pub fn workspace_window(&self) -> Result<Window, Unbounded> {
        let mut window = Window::default();
        for k in 0..self.dof() {
            window.push(self, k);
            window.check_bounded(self, k)?;
        }
        Ok(window)
    }

    /// The range of coordinate `k` in the user's window; `None` where that leaves it free. A range of a full
    /// turn is no limit.
    pub fn window_range(&self, k: usize) -> Option<(f64, f64)> {
        let periodic = self.platform.coordinates()[k].periodic;
        self.window[k].filter(|(low, high)| !(periodic && high - low >= TAU - 1e-12))
    }

    /// The first coordinate of a pose that lies beyond the user's window, angles by any full turns; `None` if
    /// all lie within it, its ends included.
    ///
    /// # Examples
    /// ```
    /// let mut robot = aspecta_robot::Robot::resolve("3-rrr")?;
    /// robot.window[2] = Some((-0.5, 0.5)); // phi
    /// assert_eq!(robot.beyond_window(&[0.0, 0.0, 0.5]), None);
    /// assert_eq!(robot.beyond_window(&[0.0, 0.0, 0.1 - std::f64::consts::TAU]), None);
    /// assert_eq!(robot.beyond_window(&[0.0, 0.0, 0.6]), Some(2));
    /// # Ok::<(), aspecta_robot::FileError>(())
    /// ```
    pub fn beyond_window(&self, pose: &[f64]) -> Option<usize> {
        self.all_beyond_window(pose).next()
    }

    /// All coordinates of a pose that lie beyond the user's window, as [`Robot::beyond_window`] tells the
    /// first.
    pub fn all_beyond_window(&self, pose: &[f64]) -> impl Iterator<Item = usize> {
        let asked = if self.window.iter().all(Option::is_none) { 0 } else { self.dof() };
        let pose = if asked == 0 { padded(pose) } else { self.with_level_pitch(padded(pose)) };
        (0..asked).filter(move |&k| {
            self.window_range(k).is_some_and(|range| {
                let x =
                    if self.platform.coordinates()[k].periodic { turned_up(pose[k], range) } else { pose[k] };
                !(range.0..=range.1).contains(&x)
            })
        })
    }

    /// The same pose with a pitch within ±90°.
    fn with_level_pitch(&self, mut pose: [f64; 6]) -> [f64; 6] {
        if let Some(turns) = self.platform.turns()
            && let Ok(angles) = pose.get_disjoint_mut(turns)
        {
            level(angles);
        }
        pose
    }

    /// The extent of coordinate `k`, infinite where nothing bounds it.
    fn extent(&self, k: usize) -> Extent {
        let c = self.platform.coordinates()[k];
        let natural = if c.angle { angle_range(c.periodic) } else { self.length_reach(k) };
        let asked = self.window_range(k);
        let range = match asked {
            Some((lo, hi)) if !c.periodic => (natural.0.max(lo), natural.1.min(hi)),
            Some(range) => range,
            None => natural,
        };
        let cuts = |inside: bool| asked.is_some() && (c.periodic || inside);
        Extent {
            range,
            glued: c.periodic && asked.is_none(),
            // The natural ends of a pitch fold back into the range; those of a full turn are one.
            cut: (cuts(range.0 > natural.0), cuts(range.1 < natural.1)),
        }
    }

    /// Bounds of translation `k` from all legs.
    fn length_reach(&self, k: usize) -> (f64, f64) {
        let all = Interval::ENTIRE;
        let range = self.legs.iter().fold(all, |r, leg| {
            let (lo, hi) = leg.reach(k, self.platform);
            Interval { lo: r.lo.max(lo), hi: r.hi.min(hi) }
        });
        (range.lo, range.hi)
    }
}

/// How far one coordinate goes: see [`Window`].
struct Extent {
    range: (f64, f64),
    glued: bool,
    cut: (bool, bool),
}

impl Window {
    /// Appends coordinate `k`, which may have an infinite or an empty range.
    pub(super) fn push(&mut self, robot: &Robot, k: usize) {
        let Extent { range, glued, cut } = robot.extent(k);
        self.ranges.push(range);
        self.glued.push(glued);
        self.cut.push(cut);
        self.angles.push(robot.platform.coordinates()[k].angle);
    }

    /// [`Unbounded`] if the range of coordinate `k` is infinite.
    pub(super) fn check_bounded(&self, robot: &Robot, k: usize) -> Result<(), Unbounded> {
        let (lo, hi) = self.ranges[k];
        let unbounded =
            || Unbounded { robot: robot.name.clone(), coordinate: robot.platform.coordinates()[k].name };
        if lo.is_finite() && hi.is_finite() { Ok(()) } else { Err(unbounded()) }
    }

    /// Whether the user's window cuts the workspace somewhere.
    pub fn is_cut(&self) -> bool {
        self.cut.iter().any(|&(first, last)| first || last)
    }

    /// The coordinates that are held at a value, and the values (see [`Robot::slice`]).
    pub fn held(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.ranges.iter().enumerate().filter(|(_, r)| r.0 == r.1).map(|(k, r)| (k, r.0))
    }

    /// Whether a pose lies in it. It is convex, but for coordinates that are glued, along which it has no
    /// ends.
    pub fn holds(&self, pose: &[f64]) -> bool {
        pose.iter().enumerate().all(|(k, &x)| self.fraction(k, x).is_some())
    }

    /// The coordinates that vary.
    pub fn axes(&self) -> Vec<usize> {
        (0..self.ranges.len()).filter(|&k| self.ranges[k].0 < self.ranges[k].1).collect()
    }

    /// Line `index` of 2^depth equal parts of coordinate k. The same line has the same double at every depth,
    /// so cells of all depths fit without gaps.
    pub fn grid_line(&self, k: usize, index: u32, depth: u32) -> f64 {
        let (lo, hi) = self.ranges[k];
        if index == 1 << depth {
            return hi;
        }
        let part = f64::from(index) / (1u64 << depth) as f64;
        lo + (hi - lo) * part
    }

    /// Returns the share, in [0, 1], of the range of coordinate k that lies below the value; `None` outside.
    /// A fixed coordinate has one value, whose share is 0.
    pub fn fraction(&self, k: usize, x: f64) -> Option<f64> {
        let (lo, hi) = self.ranges[k];
        if lo == hi {
            return (x == lo).then_some(0.0);
        }
        let x = if self.glued[k] { lo + (x - lo).rem_euclid(std::f64::consts::TAU) } else { x };
        (lo <= x && x <= hi).then(|| (x - lo) / (hi - lo))
    }

    /// A pose with each angle turned into the window ([`Window::turned_in`]), and of a body that turns in space
    /// told with a pitch within ±90°, unless the window is one in which the pitch goes round.
    pub fn turned(&self, pose: &[f64]) -> Vec<f64> {
        let mut pose = pose.to_vec();
        if let [.., roll, pitch, yaw] = &mut pose[..]
            && let [.., true, true, true] = self.angles[..]
            && !self.glued[self.glued.len() - 2]
        {
            level([roll, pitch, yaw]);
        }
        pose.iter().enumerate().map(|(k, &x)| self.turned_in(k, x)).collect()
    }

    /// `x`, or, if coordinate k is an angle that lies in the window but for full turns, the angle in the
    /// window. A held angle is met if x is a full turn away from it up to the rounding of either.
    pub fn turned_in(&self, k: usize, x: f64) -> f64 {
        let (lo, hi) = self.ranges[k];
        if !self.angles[k] || (lo..=hi).contains(&x) {
            return x;
        }
        if lo == hi {
            let turns = ((x - lo) / TAU).round();
            let rounding = 4.0 * f64::EPSILON * x.abs().max(lo.abs());
            return if turns != 0.0 && (x - lo - turns * TAU).abs() <= rounding { lo } else { x };
        }
        let turned = turned_up(x, (lo, hi));
        if turned <= hi { turned } else { x }
    }
}

/// Tells an orientation with a pitch within ±90°; one that has it keeps its digits.
fn level([roll, pitch, yaw]: [&mut f64; 3]) {
    if pitch.abs() <= FRAC_PI_2 {
        return;
    }
    let (sin, cos) = pitch.sin_cos();
    *pitch = sin.atan2(cos.abs());
    if cos < 0.0 {
        *roll += PI;
        *yaw += PI;
    }
}

/// An angle by full turns at or above the lower end of a range; one that lies in it keeps its digits.
fn turned_up(x: f64, (low, high): (f64, f64)) -> f64 {
    if (low..=high).contains(&x) { x } else { low + (x - low).rem_euclid(TAU) }
}

fn angle_range(full_turn: bool) -> (f64, f64) {
    let half = if full_turn { Interval::PI } else { Interval::PI * Interval::point(0.5) };
    (-half.hi, half.hi)
}

impl Leg {
    /// Bounds of the platform's coordinate `k` that this leg alone proves.
    fn reach(&self, k: usize, platform: Platform) -> (f64, f64) {
        let Some((centre, radius)) = self.actuator.extent(self, k) else {
            return (f64::NEG_INFINITY, f64::INFINITY);
        };
        let offset = if turns(platform) { self.arm_about_origin() } else { self.attachment[k] };
        let c = centre - offset;
        ((c - radius).lo, (c + radius).hi)
    }

    /// [−‖c‖, ‖c‖]: any component of the attachment, however the platform is turned.
    fn arm_about_origin(&self) -> Interval {
        use crate::num::{Scalar, dot};
        let arm = dot(&self.attachment, &self.attachment).sqrt().hi;
        Interval::new(-arm, arm)
    }
}

fn turns(platform: Platform) -> bool {
    matches!(platform, Platform::PlaneBody | Platform::FreeBody)
}
