//! Charts: coordinates in which the robot in a working mode is described.
//!
//! The pose X is enough almost everywhere. It is not where a leg can fold its rod back onto its crank so that
//! C comes to lie on the crank's axis: in the plane if L = M, at d = C − A = 0; in space if L ≤ M, at d = (0,
//! 0, ±√(M² − L²)). There one pose has a whole circle of q_j, aspects that are apart in W × Q touch in W, and
//! det A depends on the direction from which the point is approached. The leg's own coordinates open this up.
//!
//! Neither is it enough to turn about a point: roll and yaw are one at the poles of the pitch. There the
//! joint angles of one leg, from the base to the platform, are coordinates of all configurations; and where
//! another leg folds, its own are.

use crate::leg_index::as_index;
use crate::num::{Interval, Scalar, cross};
use crate::{LegIndex, Robot, Window};
use serde::{Deserialize, Serialize};

/// Coordinates of configurations (X, q).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Chart {
    /// X.
    Pose,
    /// One leg's own coordinates instead of the platform's translations.
    Fold(Fold),
    /// The joint angles of one spherical leg, everywhere or near its fold.
    Chain(Chain),
}

impl Chart {
    /// The leg whose own coordinates these are; its q is the first of them.
    pub fn leg(&self) -> Option<LegIndex> {
        match self {
            Self::Pose => None,
            Self::Fold(fold) => Some(fold.leg),
            Self::Chain(chain) => Some(chain.leg),
        }
    }

    /// Whether it holds all configurations.
    pub fn is_whole(&self) -> bool {
        matches!(self, Self::Pose | Self::Chain(Chain { bend: None, .. }))
    }

    /// The coordinates at whose ends the chart ends, other charts going on there.
    pub fn bounded(&self, robot: &Robot) -> std::ops::Range<usize> {
        match self {
            Self::Fold(_) => 1..robot.platform.space(),
            Self::Chain(Chain { bend: Some(_), .. }) => 1..2,
            Self::Pose | Self::Chain(_) => 0..0,
        }
    }

    /// The window of the chart, given that of the poses.
    pub fn window(&self, poses: &Window) -> Window {
        let fold = match self {
            Self::Pose => return poses.clone(),
            Self::Fold(fold) => fold,
            Self::Chain(chain) => return chain.window(),
        };
        let mut window = poses.clone();
        let p = fold.half_width;
        let lengths = [Some((-Interval::PI.hi, Interval::PI.hi)), Some((-p, p)), fold.axial];
        for (k, range) in lengths.into_iter().flatten().enumerate() {
            window.ranges[k] = range;
            window.angles[k] = k == 0;
            window.glued[k] = k == 0;
            window.cut[k] = (false, false);
        }
        window
    }
}

/// The configurations in which one revolute leg is nearly folded.
///
/// Coordinates: the crank's angle q_j = α; p, the rod's direction along the crank's direction of motion; in
/// space also w, its direction along the crank's axis; then the platform's angle, if it has one. In the
/// crank's frame (radial, tangential, axial) the rod points along
///
/// > u = (−√(1 − p² − w²), p, w),  d = L e_radial + M u,  ∂f/∂C = 2M u,  B_jj = ∂f/∂q = −2LM p.
///
/// Nothing here has a root that vanishes: leg j's serial singularity is the coordinate plane p = 0, its
/// posture is the sign of −p, and its row of A is smooth across both.
///
/// The chart covers, in W, exactly the poses with ‖d‖² < L² + M², H_j ≤ (2LM p₀)² and, in space,
/// γ/M in the range of w (`Fold::cover`): M u_radial = (‖d‖² − L² − M²)/2L, H_j = (2LM p)² and γ = M w.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fold {
    /// Leg j.
    #[serde(with = "as_index")]
    pub leg: LegIndex,
    /// L.
    pub crank: Interval,
    /// M.
    pub rod: Interval,
    /// p₀: the chart holds −p₀ ≤ p ≤ p₀.
    pub half_width: f64,
    /// Range of w.
    pub axial: Option<(f64, f64)>,
}

/// One leg j of a platform that turns about a point, from the base to the platform.
///
/// Coordinates: the motor's angle q_j, the elbow's angle ψ, the angle ϑ of the platform about its joint; all
/// full turns. Let w be the elbow's axis, t the direction in which the motor moves it and n = t × w, so that
/// in the leg's frame
///
/// > w = (sin a cos q, sin a sin q, cos a),  n = (cos a cos q, cos a sin q, −sin a),  t = (−sin q, cos q, 0),
///
/// a and b being the angles of the proximal and the distal link. Then
///
/// > v = cos b w + sin b (cos ψ n + sin ψ t),  ∂f/∂v = w,  B_jj = ∂f/∂q = sin a sin b sin ψ.
///
/// These are coordinates of all (X, q_j), in both postures of the leg, without any singularity: no poles of
/// the pitch, no fold, no root; the leg's serial singularities are ψ = 0 and ψ = π.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chain {
    /// Leg j.
    #[serde(with = "as_index")]
    pub leg: LegIndex,
    /// The part of the configurations that the chart holds; `None` if it holds all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bend: Option<Bend>,
}

/// The configurations in which the elbow is near an end of its way. The chart's second coordinate is then ψ
/// less ψ₀, 0 or π.
///
/// It covers exactly the orientations with ±e·v ≥ ±cos a cos b + sin a sin b cos(half width), + for ψ₀ = π,
/// since e·v = cos a cos b − sin a sin b cos ψ, e being the motor's axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bend {
    /// Whether ψ₀ = π, where the distal link lies back along the proximal one and v is nearest to the motor's
    /// axis; or ψ₀ = 0, where it is nearest to the opposite of that axis.
    pub back: bool,
    /// The chart holds −half_width ≤ ψ − ψ₀ ≤ half_width (rad).
    pub half_width: f64,
}

impl Chain {
    /// Right-handed orthonormal axes of the platform: those that lie along m, sin b w − cos b (cos ψ n + sin
    /// ψ t) and v where ϑ = 0, with m = cos ψ t − sin ψ n.
    pub fn body(&self, robot: &Robot) -> [[Interval; 3]; 3] {
        axes_about(&robot.leg(self.leg).attachment)
    }

    /// The window of the chart: all of each angle, or what is near the fold.
    fn window(&self) -> Window {
        let turn = (-Interval::PI.hi, Interval::PI.hi);
        let elbow = self.bend.as_ref().map_or(turn, |bend| (-bend.half_width, bend.half_width));
        Window {
            ranges: vec![turn, elbow, turn],
            glued: vec![true, self.bend.is_none(), true],
            angles: vec![true; 3],
            cut: vec![(false, false); 3],
        }
    }
}

/// Right-handed orthonormal axes, the third being the unit vector `c`.
fn axes_about(c: &[Interval; 3]) -> [[Interval; 3]; 3] {
    let least = (0..3).min_by(|&i, &j| c[i].magnitude().total_cmp(&c[j].magnitude())).unwrap_or(0);
    let (i, j) = ((least + 1) % 3, (least + 2) % 3);
    let length = (c[i].square() + c[j].square()).sqrt();
    // e × c for the axis e that c is farthest from; then c × that.
    let mut first = [Interval::point(0.0); 3];
    (first[i], first[j]) = (-c[j] / length, c[i] / length);
    [first, cross(c, &first), *c]
}
