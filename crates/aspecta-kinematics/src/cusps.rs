//! Cusps: configurations where three direct solutions meet.
//!
//! With the joints locked the platform is held by f(X, q) = 0. Where A = ∂f/∂X has rank n − 1, with left and right null
//! vectors u and v, two direct solutions meet; where u·∂²f/∂X²(v, v) = 0 as well, three do (f = f′ = f″ = 0 along v). Round
//! the image of a cusp in the joint space the platform changes its assembly mode without meeting a singularity (McAree &
//! Daniel 1999; Zein, Wenger & Chablat 2008).
//!
//! Cusps have codimension two: with one joint held they are isolated points for n = 3. Platforms that do not turn have none:
//! the differences of their leg equations are linear in X, so of isolated direct solutions there are two at most.

mod collect;
mod curve;
mod equations;
mod search;
mod unfold;

use crate::chart::{Chart, folds};
use crate::{Kinematics, KinematicsError, LegIndex, WorkingMode};
use aspecta_robot::num::Interval;
use aspecta_robot::work::Control;
use aspecta_robot::{Platform, Robot, SliceError, Window};
use collect::{Known, collect};
use equations::System;
use search::Search;
use serde::Serialize;

pub use curve::{CurveEnd, CurvePoint, CuspCurve, CuspCurves, cusp_curves};
pub use unfold::Unfolding;

/// Boxes that a search looks at unless told otherwise.
pub const USUAL_BOXES: u64 = 1_000_000;

/// Options of the search for cusps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// The joints that are held, by their legs, and their values (length unit or rad). n − 2 of them.
    pub fix: Vec<(LegIndex, f64)>,
    /// One working mode, or all.
    pub mode: Option<WorkingMode>,
    /// Greatest number of boxes, over all modes [`USUAL_BOXES`].
    pub boxes: Option<u64>,
}

/// Why cusps cannot be looked for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CuspError {
    /// Six degrees of freedom.
    #[error("robot `{robot}` has {dof} degrees of freedom: cusps are found for 2 and 3")]
    Dimension {
        /// Robot name.
        robot: String,
        /// Its degrees of freedom.
        dof: usize,
    },
    /// Cusps are isolated with n − 2 joints held.
    #[error("robot `{robot}`: cusps are isolated points with {wanted} of the {dof} joints held, not {found}")]
    Held {
        /// Robot name.
        robot: String,
        /// Its degrees of freedom.
        dof: usize,
        /// Joints to hold.
        wanted: usize,
        /// Joints held.
        found: usize,
    },
    /// No such joint.
    #[error("robot `{robot}` has {dof} joints: there is no joint {leg} to hold")]
    NoSuchJoint {
        /// Robot name.
        robot: String,
        /// Its degrees of freedom.
        dof: usize,
        /// Joint given, by its leg.
        leg: LegIndex,
    },
    /// No joint has a range.
    #[error(
        "robot `{robot}`: no joint has a range to look for curves of cusps in; give limits to an actuator"
    )]
    NoRange {
        /// Robot name.
        robot: String,
    },
    /// Not one of the robot's modes.
    #[error("robot `{robot}` has no working mode {mode}")]
    Mode {
        /// Robot name.
        robot: String,
        /// Mode given.
        mode: WorkingMode,
    },
    /// A value that a joint cannot have.
    #[error(transparent)]
    Value(#[from] KinematicsError),
    /// The workspace has no bounds, or is empty.
    #[error(transparent)]
    Window(#[from] SliceError),
}

/// All cusps of a robot, or of a slice in which joints are held.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct Cusps {
    /// Robot name.
    pub robot: String,
    /// The unit of lengths.
    pub length_unit: String,
    /// The joints held.
    pub fixed: Vec<HeldJoint>,
    /// The working modes searched.
    pub modes: Vec<WorkingMode>,
    /// The cusps, by working mode, then by angle.
    pub cusps: Vec<Cusp>,
    /// Boxes of poses that may hold more.
    pub undecided: Vec<Undecided>,
    /// Whether it is proved that `cusps` are all: nothing is undecided.
    pub complete: bool,
    /// How that is known.
    pub proof: Proof,
    /// Boxes looked at.
    pub boxes: u64,
}

/// A joint held at a value.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HeldJoint {
    /// Its name: `q1`, `q2`, …
    pub joint: String,
    /// Its value.
    pub value: f64,
    /// The unit of the value: `rad` or that of lengths.
    pub unit: String,
}

impl HeldJoint {
    fn new(robot: &Robot, &(leg, value): &(LegIndex, f64)) -> Self {
        let unit = if robot.leg(leg).actuator.is_angle() { "rad" } else { &robot.length_unit };
        Self { joint: format!("q{leg}"), value, unit: unit.into() }
    }
}

/// How it is known that there are no other cusps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Proof {
    /// Intervals exclude cusps in the rest of the robot's [`Window`].
    Intervals,
    /// The platform does not turn: its direct problem is quadratic, so three solutions never meet.
    Quadratic,
}

/// A cusp, *certified*: intervals prove that exactly one is in `enclosure`, and that exactly three direct solutions meet
/// there (it is an ordinary cusp).
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct Cusp {
    /// The working mode.
    pub mode: WorkingMode,
    /// X; angles in rad.
    pub pose: Vec<f64>,
    /// q; angles in rad.
    pub q: Vec<f64>,
    /// Bounds of each coordinate of X.
    pub enclosure: Vec<Interval>,
    /// The twist in which the three solutions separate, of unit length (lengths by [`Robot::characteristic_length`]):
    /// translation, then angular velocity. Numerical.
    pub kernel: Vec<f64>,
    /// Whether every joint is within its limits. Numerical.
    pub within_limits: bool,
    /// The change of the direct solutions by a small step in the joint space. Numerical; `None` if the direct
    /// model cannot tell, or there is none.
    pub unfolding: Option<Unfolding>,
}

/// A box of poses where intervals could not decide.
#[derive(Clone, Debug, Serialize)]
pub struct Undecided {
    /// The working mode.
    pub mode: WorkingMode,
    /// Bounds of each coordinate of X.
    pub enclosure: Vec<Interval>,
    /// Why.
    pub why: Doubt,
}

/// Why a box is undecided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "reason")]
pub enum Doubt {
    /// A serial singularity: the two postures of a leg meet, and the equations are not smooth there.
    Serial {
        /// The leg.
        leg: LegIndex,
    },
    /// C of a leg is on the axis of its crank: its joint is free.
    FreeJoint {
        /// The leg.
        leg: LegIndex,
    },
    /// A loses two ranks, or nearly: four solutions may meet.
    Rank,
    /// The equations are degenerate: a cusp at which more than three solutions meet, cusps that meet, or a self-motion.
    Degenerate,
    /// The budget of boxes was spent.
    Boxes,
    /// The search was cancelled.
    Cancelled,
}

/// Returns all cusps of a plane robot (n = 2), or of a robot with n = 3 and one joint held, in its
/// [`Window`].
///
/// *Certified*: every cusp in the window, in the modes asked for, is in the list or in an undecided box. Cusps beyond joint
/// limits are listed too where the window holds them.
///
/// # Errors
/// [`CuspError`] for robots with six degrees of freedom, joints or values that do not fit, and unbounded workspaces.
///
/// # Examples
/// ```
/// use aspecta_kinematics::cusps::{Options, cusps};
/// use aspecta_robot::{LegIndex, catalogue};
/// use aspecta_robot::work::Control;
///
/// // A platform that does not turn has none: its direct problem is quadratic.
/// let robot = catalogue::find("five-bar").unwrap();
/// let found = cusps(&robot, &Options::default(), &Control::unwatched())?;
/// assert!(found.complete && found.cusps.is_empty());
///
/// // Of a 3-RPR one strut is held; a few boxes do not decide all of it.
/// let robot = catalogue::find("3-rpr").unwrap();
/// let options = Options { fix: vec![(LegIndex::new(0), 14.98)], boxes: Some(1000), ..Options::default() };
/// assert!(!cusps(&robot, &options, &Control::unwatched())?.complete);
/// # Ok::<(), aspecta_kinematics::cusps::CuspError>(())
/// ```
pub fn cusps(robot: &Robot, options: &Options, control: &Control<'_>) -> Result<Cusps, CuspError> {
    let modes = check(robot, options)?;
    let mut all = Cusps {
        robot: robot.name.clone(),
        length_unit: robot.length_unit.clone(),
        fixed: options.fix.iter().map(|held| HeldJoint::new(robot, held)).collect(),
        modes,
        cusps: Vec::new(),
        undecided: Vec::new(),
        complete: true,
        proof: Proof::Quadratic,
        boxes: 0,
    };
    let window = robot.slice(&[])?;
    match robot.platform {
        Platform::PlaneBody => find::<2, 3>(robot, options, &window, &mut all, control),
        Platform::TurningBody => find::<3, 3>(robot, options, &window, &mut all, control),
        Platform::PlanePoint | Platform::TranslatingBody | Platform::FreeBody => return Ok(all),
    }
    all.complete = all.undecided.is_empty();
    all.proof = Proof::Intervals;
    Ok(all)
}

/// The modes to search, if the options fit the robot.
fn check(robot: &Robot, options: &Options) -> Result<Vec<WorkingMode>, CuspError> {
    let (dof, found) = (robot.dof(), options.fix.len());
    let name = || robot.name.clone();
    if dof > 3 {
        return Err(CuspError::Dimension { robot: name(), dof });
    }
    if found + 2 != dof {
        return Err(CuspError::Held { robot: name(), dof, wanted: dof - 2, found });
    }
    // The values are those of a joint vector, so they are judged as one.
    let mut q = vec![1.0; dof];
    for &(leg, value) in &options.fix {
        let joint =
            q.get_mut(leg.index()).ok_or_else(|| CuspError::NoSuchJoint { robot: name(), dof, leg })?;
        *joint = value;
        if robot.leg(leg).actuator.forbids(value) {
            return Err(KinematicsError::StrutLength { leg, value }.into());
        }
    }
    crate::check_joints(robot, &q)?;
    let modes = robot.working_modes();
    match options.mode {
        None => Ok(modes),
        Some(mode) if modes.contains(&mode) => Ok(vec![mode]),
        Some(mode) => Err(CuspError::Mode { robot: name(), mode }),
    }
}

/// Searches every mode in every chart.
fn find<const D: usize, const N: usize>(
    robot: &Robot,
    options: &Options,
    window: &Window,
    all: &mut Cusps,
    control: &Control<'_>,
) {
    let held = options.fix.first().map(|&(leg, value)| (leg.index(), value));
    let mut folds = folds(robot, window);
    // The held leg's row is made from q itself.
    folds.retain(|fold| held.is_none_or(|(k, _)| k != fold.leg.index()));
    let charts = || std::iter::once(Chart::Pose).chain(folds.iter().cloned().map(Chart::Fold));
    let mut left = options.boxes.unwrap_or(USUAL_BOXES);
    let modes = all.modes.clone();
    for (done, mode) in modes.iter().copied().enumerate() {
        let mut known = Vec::new();
        // What a mode leaves of its share goes to those that follow.
        let mut share = left.div_ceil((modes.len() - done) as u64);
        for chart in charts() {
            let system = System::<D>::new(robot, chart, mode, held);
            let search = Search::<D, N> { window: system.chart.window(window), system, elsewhere: &folds };
            let findings = search.run(share, control);
            share -= findings.boxes;
            left -= findings.boxes;
            all.boxes += findings.boxes;
            collect(&search, window, &findings, &mut known, all);
        }
        known.sort_by(|a: &Known<N>, b| {
            let key = |k: &Known<N>| k.pose[N - 1].mid();
            key(a).total_cmp(&key(b))
        });
        all.cusps.extend(known.iter().map(|k| described::<D, N>(robot, mode, held, &k.pose)));
    }
}

/// Returns the description of a cusp: its pose, joints, proof and unfolding.
fn described<const D: usize, const N: usize>(
    robot: &Robot,
    mode: WorkingMode,
    held: Option<(usize, f64)>,
    enclosure: &[Interval; N],
) -> Cusp {
    let pose = enclosure.map(Interval::mid);
    let system = System::<D>::new(robot, Chart::Pose, mode, held);
    let solutions = robot.inverse(&pose).unwrap_or_default();
    let solution = solutions.into_iter().find(|s| s.mode == mode);
    let within_limits = solution.as_ref().is_some_and(|s| s.within_limits);
    let mut q = solution.map_or_else(Vec::new, |s| s.q);
    if let (Some((k, value)), false) = (held, q.is_empty()) {
        q[k] = value;
    }
    Cusp {
        mode,
        kernel: system.kernel(&pose).to_vec(),
        unfolding: unfold::unfold(&system, &pose, &q),
        pose: pose.to_vec(),
        q,
        enclosure: enclosure.to_vec(),
        within_limits,
    }
}

#[cfg(test)]
mod tests;
