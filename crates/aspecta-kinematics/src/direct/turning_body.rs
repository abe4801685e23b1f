//! A body that turns about a point, on three legs: at most eight orientations.

use super::locked::Locked;
use super::projective::{Point, Problem, Quadrics, turned_product};
use crate::placement::out_of_frame;
use aspecta_robot::legs::LockedEnd;
use aspecta_robot::num::Interval;
use std::sync::LazyLock;

/// w(q) · R v = cos(distal), times ‖e‖²: a quadratic form in the quaternion e.
///
/// Three quadrics of P³ have at most 2³ = 8 isolated common points (Bézout; Fulton, *Intersection Theory*,
/// 12.3.1), and ±e is one point of P³ and one orientation. So eight different proved points are all.
pub(super) const MOST: usize = 8;

/// w(q) · R v = cos(distal) of a locked leg.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    /// The joint between the links, in the base: a unit vector.
    pub w: [Interval; 3],
    /// The joint of the platform, in the platform: a unit vector.
    pub v: [Interval; 3],
    /// The cosine of the angle between them.
    pub cosine: Interval,
}

/// The three cones of locked legs; `None` for legs of other kinds, which `Robot::new` lets no turning body
/// have.
pub(super) fn cones(legs: &[Locked]) -> Option<[Cone; 3]> {
    let cone = |locked: &Locked| {
        let (axis, cosine) = match locked.leg.actuator.locked(locked.q) {
            LockedEnd::Cone { axis, cosine } => (axis, cosine),
            LockedEnd::Sphere { .. } => return None,
        };
        Some(Cone { w: out_of_frame(&locked.leg, &axis), v: locked.leg.attachment, cosine })
    };
    Some([cone(legs.first()?)?, cone(legs.get(1)?)?, cone(legs.get(2)?)?])
}

impl Cone {
    fn form(&self) -> [[Interval; 4]; 4] {
        let mut m = turned_product(&self.w, &self.v);
        for (k, row) in m.iter_mut().enumerate() {
            row[k] = row[k] - self.cosine;
        }
        m
    }
}

pub(super) fn problem(cones: &[Cone; 3]) -> Problem<'static, 4, 3> {
    Problem::new(&START.0, &START.1, cones.each_ref().map(Cone::form))
}

/// γₖ (eₖ² − e₀²) = 0, k = 1, 2, 3, which (1, ±1, ±1, ±1) solve. The γₖ are any complex numbers.
static START: LazyLock<(Quadrics<4, 3>, Vec<Point<4>>)> = LazyLock::new(|| {
    const GAMMA: [[f64; 2]; 3] = [[0.734, -0.679], [-0.402, 0.916], [0.178, 0.984]];
    let mut system = Quadrics::ZERO;
    for (k, [re, im]) in GAMMA.into_iter().enumerate() {
        let form = &mut system.forms[k];
        (form[0].re[0], form[0].im[0]) = (-re, -im);
        (form[k + 1].re[k + 1], form[k + 1].im[k + 1]) = (re, im);
    }
    let sign = |bits: usize, k: usize| if bits >> k & 1 == 1 { -1.0 } else { 1.0 };
    let points = (0..8).map(|bits| Point::real([1.0, sign(bits, 0), sign(bits, 1), sign(bits, 2)]));
    (system, points.collect())
});
