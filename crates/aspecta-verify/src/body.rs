//! The robot at a configuration: f, ∂f/∂q, the row of A, H and the limits of each leg, from coordinates.
//!
//! Written for any scalar and independently of `kinematics`, but for the leg equation itself. Points have D =
//! 2 or 3 coordinates; there are up to six legs and coordinates, and entries beyond are zero.

mod chain;
mod clearance;
mod kinds;

pub(super) use chain::Links;
pub(super) use kinds::{constants, joint, rod_length, slope_per_root};

use aspecta_robot::chart::Chart;
use aspecta_robot::num::{Interval, Jet, Scalar};
use aspecta_robot::{Leg, Limit, Platform, Robot};

/// Most coordinates, and most legs.
pub(super) const MOST: usize = 6;

/// The platform where the coordinates put it.
pub(super) struct Body<'a, T, const D: usize> {
    robot: &'a Robot,
    origin: [T; D],
    /// Columns in the base; `None` for platforms that do not turn.
    rotation: Option<[[T; D]; D]>,
    own: Option<Own<T, D>>,
}

/// The leg whose own coordinates are used.
struct Own<T, const D: usize> {
    leg: usize,
    cos: T,
    sin: T,
    /// C − A in the crank's frame (radial, tangential, axial).
    span: [T; D],
    /// |∂f/∂q| per tangential component of C − A.
    swing: Interval,
}

/// A leg in one posture.
#[derive(Clone, Debug)]
pub(super) struct LegState<T> {
    /// f(C − A, q), 0 at configurations.
    pub equation: T,
    /// B_jj = ∂f/∂q.
    pub slope: T,
    /// ∂f/∂X: translations, then the rotation vector in the base frame.
    pub row: [T; MOST],
    /// ∂f/∂C in the base, if the platform's origin can move: twice the rod.
    pub push: [T; 3],
    /// How far inside each limit it is.
    pub limits: Vec<T>,
    /// A, B and C in the base, if any body is looked at: of a strut, which has no B, A twice.
    pub joints: [[T; 3]; 3],
}

/// c · v with a constant c; zeros cost nothing.
fn times<T: Scalar, const D: usize>(c: impl Fn(usize) -> Interval, v: &[T; D]) -> T {
    let zero = Interval::point(0.0);
    let terms = (0..D).filter(|&k| c(k) != zero).map(|k| v[k].scale(c(k)));
    terms.reduce(|a, b| a + b).unwrap_or_else(T::zero)
}

fn product<T: Scalar, const D: usize>(a: &[T; D], b: &[T; D]) -> T {
    (1..D).fold(a[0] * b[0], |sum, k| sum + a[k] * b[k])
}

fn square<T: Scalar, const D: usize>(a: &[T; D]) -> T {
    (1..D).fold(a[0].square(), |sum, k| sum + a[k].square())
}

fn into_frame<T: Scalar, const D: usize>(leg: &Leg, v: &[T; D]) -> [T; D] {
    std::array::from_fn(|k| times(|i| leg.frame[k][i], v))
}

fn out_of_frame<T: Scalar, const D: usize>(leg: &Leg, v: &[T; D]) -> [T; D] {
    std::array::from_fn(|k| times(|i| leg.frame[i][k], v))
}

/// v turned by the angle with this cosine and sine about the last axis.
fn turned<T: Scalar, const D: usize>(cos: T, sin: T, v: &[T; D]) -> [T; D] {
    let mut w = *v;
    (w[0], w[1]) = (cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]);
    w
}

impl<'a, T: Scalar, const D: usize> Body<'a, T, D> {
    /// The platform at the point y of the chart.
    pub(super) fn new(robot: &'a Robot, chart: &'a Chart, y: &[T; MOST]) -> Self {
        let zero = T::zero();
        let mut body = Self { robot, origin: [zero; D], rotation: rotation(robot.platform, y), own: None };
        match chart {
            Chart::Chain(chain) => body.turn_by(chain, y),
            Chart::Pose if robot.platform == Platform::TurningBody => {}
            Chart::Pose => body.origin = std::array::from_fn(|k| y[k]),
            Chart::Fold(fold) => {
                let leg = robot.leg(fold.leg);
                let (sin, cos) = y[0].sin_cos();
                let across = if D == 3 { y[1].square() + y[2].square() } else { y[1].square() };
                // The rod's unit vector in the crank's frame is (radial, p, w).
                let radial = -(T::constant(Interval::point(1.0)) - across).sqrt();
                let mut span = [zero; D];
                (span[0], span[1]) = (radial.scale(fold.rod) + T::constant(fold.crank), y[1].scale(fold.rod));
                if D == 3 {
                    span[D - 1] = y[2].scale(fold.rod);
                }
                let (d, arm) = (out_of_frame(leg, &turned(cos, sin, &span)), body.arm(leg));
                body.origin = std::array::from_fn(|k| d[k] + (T::constant(leg.anchor[k]) - arm[k]));
                body.own =
                    Some(Own { leg: fold.leg.index(), cos, sin, span, swing: fold.crank + fold.crank });
            }
        }
        body
    }

    /// Returns the position of the platform's origin.
    pub(super) fn origin(&self) -> &[T; D] {
        &self.origin
    }

    /// Leg j, if its own coordinates are used.
    fn own_of(&self, j: usize) -> Option<&Own<T, D>> {
        self.own.as_ref().filter(|own| own.leg == j)
    }

    fn turn(&self, v: &[Interval; 3]) -> [T; D] {
        match &self.rotation {
            None => std::array::from_fn(|k| T::constant(v[k])),
            Some(columns) => {
                std::array::from_fn(|k| times(|i| v[i], &std::array::from_fn::<T, D, _>(|i| columns[i][k])))
            }
        }
    }

    fn arm(&self, leg: &Leg) -> [T; D] {
        self.turn(&leg.attachment)
    }

    /// C − A in the frame of leg j.
    pub(super) fn span(&self, j: usize) -> [T; D] {
        let leg = &self.robot.legs[j];
        if let Some(own) = self.own_of(j) {
            return turned(own.cos, own.sin, &own.span);
        }
        let offset: [T; D] = match self.rotation {
            None => std::array::from_fn(|k| T::constant(leg.attachment[k] - leg.anchor[k])),
            Some(_) => {
                let arm = self.arm(leg);
                std::array::from_fn(|k| arm[k] - T::constant(leg.anchor[k]))
            }
        };
        into_frame(leg, &std::array::from_fn(|k| self.origin[k] + offset[k]))
    }

    /// Returns how the end of leg j moves as the platform does, in the leg's frame: one velocity per column
    /// of A.
    fn velocities(&self, j: usize) -> [[T; D]; MOST] {
        let leg = &self.robot.legs[j];
        let (zero, one) = (T::zero(), T::constant(Interval::point(1.0)));
        let unit = |i: usize| std::array::from_fn(|k| if i == k { one } else { zero });
        let arm = self.arm(leg);
        // e_i × arm.
        let about = |i: usize| {
            let mut v = [zero; D];
            (v[(i + 1) % 3], v[(i + 2) % 3]) = (-arm[(i + 2) % 3], arm[(i + 1) % 3]);
            v
        };
        let in_base = |i: usize| match self.robot.platform {
            Platform::PlaneBody if i == 2 => {
                let mut v = [zero; D];
                (v[0], v[1]) = (-arm[1], arm[0]);
                v
            }
            Platform::TurningBody => about(i),
            Platform::FreeBody if i >= D => about(i - D),
            Platform::PlanePoint | Platform::PlaneBody | Platform::TranslatingBody | Platform::FreeBody => {
                unit(i)
            }
        };
        let n = self.robot.dof();
        std::array::from_fn(|i| if i < n { into_frame(leg, &in_base(i)) } else { [zero; D] })
    }

    /// H of leg j, given C − A in its frame: the discriminant of its equation.
    pub(super) fn reach(&self, j: usize, d: &[T; D]) -> Option<T> {
        if let Some(own) = self.own_of(j) {
            // ∂f/∂q = −2L (C − A)_tangential, or sin a times it.
            return Some(own.span[1].scale(own.swing).square());
        }
        kinds::reach(&self.robot.legs[j].actuator, d)
    }

    /// What H of leg j is at most, given C − A in its frame: infinite where nothing else than [`Body::reach`]
    /// is known.
    pub(super) fn most_reach(&self, j: usize, d: &[Interval; D]) -> f64 {
        match self.own_of(j) {
            Some(_) => f64::INFINITY,
            None => kinds::most_reach(&self.robot.legs[j].actuator, d),
        }
    }

    /// Leg j with q given, at C − A = `span`. Where the leg's own coordinates are used q is one of them, and
    /// `q` is not looked at.
    pub(super) fn leg(&self, j: usize, span: &[T; D], q: T) -> LegState<T> {
        let leg = &self.robot.legs[j];
        let velocities = self.velocities(j);
        // f does not change if d and q turn together about the crank's axis: a leg in its own coordinates is
        // looked at in its crank's frame, where q = 0.
        let (d, moves, at) = match self.own_of(j) {
            Some(f) => (f.span, velocities.map(|v| turned(f.cos, -f.sin, &v)), T::zero()),
            None => (*span, velocities, q),
        };
        let jets: [Jet<T, 4>; D] = std::array::from_fn(|k| Jet::variable(d[k], k));
        let f = leg.actuator.equation(&jets, Jet::variable(at, 3));
        let slope = f.gradient[3];
        let limits = leg.limits.iter().map(|limit| self.margin(j, limit, span, q, slope)).collect();
        // ∂f/∂X by way of C − A.
        let mut row = [T::zero(); MOST];
        for (entry, v) in row.iter_mut().zip(&moves).take(self.robot.dof()) {
            *entry = (1..D).fold(f.gradient[0] * v[0], |sum, k| sum + f.gradient[k] * v[k]);
        }
        let push = std::array::from_fn(|k| if k < D { row[k] } else { T::zero() });
        let joints = if self.robot.pairs.is_empty() { [[T::zero(); 3]; 3] } else { self.joints(j, span, q) };
        LegState { equation: f.value, slope, row, push, limits, joints }
    }

    /// A, B and C of leg j in the base.
    fn joints(&self, j: usize, d: &[T; D], q: T) -> [[T; 3]; 3] {
        let leg = &self.robot.legs[j];
        let elbow = kinds::elbow(&leg.actuator, q, || self.crank(j, q));
        [[T::zero(); D], elbow, *d].map(|from_anchor| {
            let v = out_of_frame(leg, &from_anchor);
            std::array::from_fn(|k| if k < D { v[k] + T::constant(leg.anchor[k]) } else { T::zero() })
        })
    }

    /// A point of the platform, in the base.
    pub(super) fn point(&self, v: &[Interval; 3]) -> [T; 3] {
        let arm = self.turn(v);
        std::array::from_fn(|k| if k < D { self.origin[k] + arm[k] } else { T::zero() })
    }

    /// Returns how far inside a limit leg j is: a function of the configuration, positive strictly inside.
    fn margin(&self, j: usize, limit: &Limit, d: &[T; D], q: T, slope: T) -> T {
        let leg = &self.robot.legs[j];
        let constant = |c: Interval| T::constant(c);
        match limit {
            Limit::ActuatorAngle { middle, half_cos, .. } => {
                let (sin, cos) = self.crank(j, q);
                cos.scale(middle.0) + sin.scale(middle.1) - constant(*half_cos)
            }
            Limit::ActuatorLength { min, max } => kinds::length_margin(&leg.actuator, d, q, (*min, *max)),
            // ‖d‖² = L² + M² + 2LM cos ψ, ∂f/∂q = −2LM sin ψ.
            Limit::Elbow { middle, half_cos } => {
                let (bend, both) = self.bend(j, d);
                bend.scale(middle.0) - slope.scale(middle.1) - constant(both * *half_cos)
            }
            Limit::SpatialElbow { min_cos, max_cos } => {
                let (bend, both) = self.bend(j, d);
                (constant(both * *min_cos) - bend) * (bend - constant(both * *max_cos))
            }
            Limit::BaseCone { axis, half_cos } => {
                times(|k| axis[k], &self.rod(j, d, q)) - constant(*half_cos)
            }
            Limit::PlatformCone { axis, half_cos } => {
                let axis = into_frame(leg, &self.turn(axis));
                product(&axis, &self.rod(j, d, q)) - constant(*half_cos)
            }
            Limit::Clearance(clearance) => self.clearance(j, clearance, d, q),
        }
    }

    /// (sin q, cos q).
    fn crank(&self, j: usize, q: T) -> (T, T) {
        match self.own_of(j) {
            Some(own) => (own.sin, own.cos),
            None => q.sin_cos(),
        }
    }

    /// (2LM cos ψ, 2LM) of a revolute leg, ψ being the angle between crank and rod.
    pub(super) fn bend(&self, j: usize, d: &[T; D]) -> (T, Interval) {
        kinds::bend(&self.robot.legs[j].actuator, d)
    }

    /// The direction of the rod (of the strut), in the leg's frame.
    fn rod(&self, j: usize, d: &[T; D], q: T) -> [T; D] {
        kinds::rod(&self.robot.legs[j].actuator, d, q, || self.crank(j, q))
    }
}

/// The rotation of the platform in pose coordinates, whose angles are coordinates of every chart; by columns.
fn rotation<T: Scalar, const D: usize>(platform: Platform, y: &[T; MOST]) -> Option<[[T; D]; D]> {
    let mut columns = [[T::zero(); D]; D];
    match platform {
        Platform::PlaneBody => {
            let (sin, cos) = y[2].sin_cos();
            (columns[0][0], columns[0][1]) = (cos, sin);
            (columns[1][0], columns[1][1]) = (-sin, cos);
        }
        Platform::PlanePoint | Platform::TranslatingBody | Platform::TurningBody | Platform::FreeBody => {
            let [roll, pitch, yaw] = platform.turns()?;
            let ((sr, cr), (sp, cp), (sy, cy)) = (y[roll].sin_cos(), y[pitch].sin_cos(), y[yaw].sin_cos());
            // R_z(yaw) R_y(pitch) R_x(roll), the rightmost factor first.
            let about_x = |v: [T; 3]| [v[0], cr * v[1] - sr * v[2], sr * v[1] + cr * v[2]];
            let about_y = |v: [T; 3]| [cp * v[0] + sp * v[2], v[1], cp * v[2] - sp * v[0]];
            let about_z = |v: [T; 3]| [cy * v[0] - sy * v[1], sy * v[0] + cy * v[1], v[2]];
            let (zero, one) = (T::zero(), T::constant(Interval::point(1.0)));
            for i in 0..D {
                let unit = std::array::from_fn(|k| if i == k { one } else { zero });
                columns[i].copy_from_slice(&about_z(about_y(about_x(unit))));
            }
        }
    }
    Some(columns)
}
