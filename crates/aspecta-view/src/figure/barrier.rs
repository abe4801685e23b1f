//! The functions whose zeros bound the aspects of a working mode, in plain f64 (*numerical*).
//!
//! The same [`closures`] as in the proofs gives them, with h = √max(H, 0): so they go on continuously
//! beyond the reach of the legs, and a contour meets the boundary H = 0 without a gap.

use aspecta::kinematics::WorkingMode;
use aspecta::kinematics::constraints::{Configuration, Constraint};
use aspecta::kinematics::modal::closures;
use aspecta::kinematics::placement::{Placement, determinant, out_of_frame, wrench};
use aspecta::robot::{LegIndex, Platform, Robot};

/// The kind of curve that bounds an aspect.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// B_jj = 0 (Definition 4).
    Serial,
    /// det A = 0 in the mode (Definition 3).
    Parallel,
    /// A joint limit.
    Limit,
    /// Two bodies, or a link and an obstacle, touch: which of the robot's [`contacts`].
    Contact(usize),
}

/// What can touch, in the order of the numbers in [`Kind::Contact`].
pub fn contacts(robot: &Robot) -> impl Iterator<Item = Constraint> + '_ {
    Constraint::of(robot).filter(|constraint| constraint.is_contact(robot))
}

/// All barriers of a mode at a pose; an aspect is where every `margins` entry is positive and det A keeps its
/// sign.
#[derive(Clone, Debug)]
pub struct Barriers {
    /// A positive multiple of det A(X, g_s(X)).
    pub det: f64,
    /// The reach H_j of each leg (none for struts), then the margin of each joint limit and contact.
    pub margins: Vec<(Kind, f64)>,
    /// q = g_s(X), also on the boundary; angles within the ranges of their joints.
    pub q: Vec<f64>,
    /// A leg whose C is so near to the axis of its crank that it is folded, and its q free, as far as a picture
    /// shows.
    pub folded: Option<LegIndex>,
}

/// The distance from C to the axis of a crank, by the length of the crank, at which the leg counts as folded.
const FOLDED: f64 = 1e-4;

impl Barriers {
    /// The barriers at `pose`, which must have the robot's number of coordinates.
    pub fn at(robot: &Robot, mode: WorkingMode, pose: &[f64]) -> Self {
        match robot.platform {
            Platform::PlanePoint => barriers::<2, 2>(robot, mode, pose),
            Platform::PlaneBody => barriers::<2, 3>(robot, mode, pose),
            Platform::TranslatingBody | Platform::TurningBody => barriers::<3, 3>(robot, mode, pose),
            Platform::FreeBody => barriers::<3, 6>(robot, mode, pose),
        }
    }
}

fn barriers<const D: usize, const N: usize>(robot: &Robot, mode: WorkingMode, pose: &[f64]) -> Barriers {
    let placement = Placement::<f64, D>::at(robot.platform, pose);
    let legs = closures::<f64, D, N>(robot, &placement);
    let heights: [[f64; 2]; N] = std::array::from_fn(|j| legs[j].heights());
    let mut rows = [[0.0; N]; N];
    let (mut margins, mut q, mut folded) = (Vec::new(), Vec::new(), None);
    for (j, (leg, at)) in robot.legs.iter().zip(&legs).enumerate() {
        let closure = &at.closure;
        let sh = heights[j][usize::from(mode.sign(j) < 0)];
        let gradient: [f64; D] = std::array::from_fn(|k| closure.fixed[k] + sh * closure.swing[k]);
        rows[j] = wrench(robot.platform, &out_of_frame(leg, &gradient), &at.arm);
        if leg.actuator.postures() == 2 {
            margins.push((Kind::Serial, closure.reach));
        }
        if leg.actuator.usual_weight().is_some_and(|usual| closure.weight < usual * FOLDED.powi(2)) {
            folded = Some(LegIndex::new(j));
        }
        q.push(leg.joint_value(leg.actuator.drive(&at.span, closure, sh)));
    }
    let at = Configuration { robot, placement: &placement, legs: &legs, heights: &heights, mode };
    let mut touching = 0;
    margins.extend(at.limits().map(|(constraint, margin)| match constraint.is_contact(robot) {
        true => {
            touching += 1;
            (Kind::Contact(touching - 1), margin)
        }
        false => (Kind::Limit, margin),
    }));
    Barriers { det: determinant(&rows), margins, q, folded }
}
