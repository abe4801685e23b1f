//! A motor turns a crank, a rod follows: RRR, RSS, RUS.

use super::closure::{Closure, Drive, Elbow, LockedEnd, RigidRod, outside, sum_of_squares};
use super::drawn::{Body, Dimension, Joint, Part, Points, Role, axis, beyond_anchor, minus};
use super::facts::{Facts, ROOTS_OF_A_QUADRATIC};
use super::{LegKind, Spherical};
use crate::num::{Interval, Scalar};
use crate::{Fault, Leg, LegKeys, LinkPart};
use serde::{Deserialize, Serialize};

/// A crank of length L turns by q (rad) from u towards v about w, a rod of length M follows:
/// f = ‖C − A − L(cos q u + sin q v)‖² − M².
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Revolute {
    /// L > 0.
    pub crank: Interval,
    /// M > 0.
    pub rod: Interval,
}

impl Leg {
    /// A revolute-driven leg in the plane: crank `l` turning from the x axis, rod `m`.
    pub fn revolute(anchor: [f64; 2], attachment: [f64; 2], l: f64, m: f64) -> Self {
        let data = Revolute { crank: Interval::decimal(l), rod: Interval::decimal(m) };
        Self::planar(anchor, attachment, data.into())
    }
}

impl Revolute {
    /// L(cos q, sin q).
    fn end_of_crank<T: Scalar, const D: usize>(&self, q: T) -> [T; D] {
        let (sin, cos) = q.sin_cos();
        let crank = T::constant(self.crank);
        let mut b = [T::zero(); D];
        (b[0], b[1]) = (cos * crank, sin * crank);
        b
    }
}

impl LegKind for Revolute {
    const FACTS: Facts = Facts {
        name: "revolute",
        planar_keys: &["crank", "rod"],
        spatial_keys: &["crank", "rod", "axis", "zero"],
        is_on_sphere: false,
        postures: 2,
        // The side of the way from A to C where B is; in space as seen against the motor's axis.
        posture_names: &["left", "right"],
        why_not_cuspidal: ROOTS_OF_A_QUADRATIC,
        is_angle: true,
        is_positive: false,
        has_elbow: true,
        has_rod: true,
        parts: &[Part::new(Role::Driven, "crank (driven joint filled)"), Part::new(Role::Follower, "rod")],
    };

    fn read(keys: &LegKeys<'_>) -> Result<Leg, Fault> {
        let (anchor, attachment) = keys.points()?;
        let frame = keys.crank_frame()?;
        let data = Self { crank: keys.length("crank")?, rod: keys.length("rod")? };
        Ok(Leg { anchor, attachment, frame, actuator: data.into(), limits: Vec::new() })
    }

    #[inline]
    fn equation_turned<T: Scalar, const D: usize>(
        &self,
        d: &[T; D],
        _: T,
        turn: impl FnOnce() -> (T, T),
    ) -> T {
        let (sin, cos) = turn();
        let mut b = *d;
        b[0] = b[0] - cos.scale(self.crank);
        b[1] = b[1] - sin.scale(self.crank);
        sum_of_squares(&b) - T::constant(self.rod.square())
    }

    /// f = k − a cos q − b sin q with (a, b) = 2L(α, β), k = ‖d‖² + L² − M². It has solutions
    /// where H = a² + b² − k² ≥ 0, namely (a² + b²)(cos q, sin q) = k(a, b) + s h(−b, a), and there
    /// ∂f/∂q = a sin q − b cos q = s h.
    fn eliminate<T: Scalar, const D: usize>(&self, d: &[T; D]) -> Closure<T, D> {
        let zero = T::zero();
        let (l2, m2) = (self.crank.square(), self.rod.square());
        let planar = d[0].square() + d[1].square();
        // weight = α² + β². H is written so that ‖d‖ appears once.
        let (lateral, span) = match d.get(2) {
            Some(g) => (g.square(), planar + g.square()),
            None => (zero, planar),
        };
        let mut head = T::constant(l2 * m2);
        if D == 3 {
            head = T::constant(l2) * (T::constant(m2) - lateral);
        }
        let reach = head.scale(Interval::point(4.0)) - (span - T::constant(l2 + m2)).square();
        // ρ ∂f/∂d = 2ρ d − k(α, β) − s h(−β, α), simplified: 2ρ − k = α² + β² − γ² − L² + M².
        let mut rest = planar + T::constant(m2 - l2);
        if D == 3 {
            rest = rest - lateral;
        }
        let mut fixed = [zero; D];
        let mut swing = [zero; D];
        fixed[0] = d[0] * rest;
        fixed[1] = d[1] * rest;
        swing[0] = d[1];
        swing[1] = -d[0];
        if D == 3 {
            fixed[2] = (planar * d[2]).scale(Interval::point(2.0));
        }
        Closure { reach, weight: planar, fixed, swing }
    }

    fn drive<T: Scalar, const D: usize>(&self, d: &[T; D], closure: &Closure<T, D>, sh: T) -> Drive<T> {
        let k = sum_of_squares(d) + T::constant(self.crank.square() - self.rod.square());
        let norm = closure.weight.scale(self.crank + self.crank);
        Drive::Angle { cos: k * d[0] - sh * d[1], sin: k * d[1] + sh * d[0], norm }
    }

    #[inline]
    fn signed_height<T: Scalar>(&self, slope: T) -> T {
        slope
    }

    #[inline]
    fn force<T: Scalar, const D: usize>(&self, _: &[T; D]) -> T {
        T::constant(self.rod + self.rod)
    }

    #[inline]
    fn row_length<T: Scalar, const D: usize>(&self, closure: &Closure<T, D>) -> T {
        closure.weight.scale(self.rod + self.rod)
    }

    fn constants(&self) -> Vec<Interval> {
        vec![self.crank, self.rod]
    }

    fn length_margin<T: Scalar, const D: usize>(&self, _: &[T; D], _: T, _: Interval, _: Interval) -> T {
        T::constant(Interval::ENTIRE)
    }

    /// ‖d‖² = L² + M² + 2LM cos ψ.
    fn bend<T: Scalar, const D: usize>(&self, d: &[T; D]) -> Option<(T, Interval)> {
        let Self { crank, rod } = *self;
        Some((
            sum_of_squares(d) - T::constant(crank.square() + rod.square()),
            Interval::point(2.0) * crank * rod,
        ))
    }

    fn greatest_reach(&self) -> Option<Interval> {
        Some(((self.crank + self.crank) * self.rod).square())
    }

    fn usual_weight(&self) -> Option<f64> {
        Some(self.crank.mid().powi(2))
    }

    fn equation_scale(&self, _: f64) -> f64 {
        self.size().powi(2)
    }

    fn size(&self) -> f64 {
        self.crank.mid() + self.rod.mid()
    }

    fn size_at(&self, _: f64) -> f64 {
        self.size()
    }

    fn rounded_size(&self, ends: f64, q: f64) -> f64 {
        (q.abs() + 1.0).max((ends + self.crank.hi + self.rod.hi) / self.crank.lo)
    }

    fn extent(&self, leg: &Leg, k: usize) -> Option<(Interval, Interval)> {
        Some((leg.anchor[k], self.crank + self.rod))
    }

    fn gap<const D: usize>(&self, d: &[f64; D]) -> f64 {
        let planar = d[0].hypot(d[1]);
        let off_plane = d.get(2).copied().unwrap_or(0.0);
        let (crank, rod) = (self.crank.mid(), self.rod.mid());
        outside(rod, (planar - crank).hypot(off_plane), (planar + crank).hypot(off_plane))
    }

    fn elbow<T: Scalar, const D: usize>(&self, q: T) -> Option<[T; D]> {
        Some(self.end_of_crank(q))
    }

    fn locked<const D: usize>(&self, q: Interval) -> LockedEnd<D> {
        LockedEnd::Sphere { centre: self.end_of_crank(q), radius: self.rod }
    }

    fn rigid_rod(&self) -> Option<RigidRod> {
        Some(RigidRod { length: self.rod.mid(), elbow: Elbow::Circle(self.crank.mid()) })
    }

    fn points<T: Scalar, const D: usize>(&self, leg: &Leg, span: &[T; D], _: &[T; D], q: T) -> Points<T, D> {
        let b = beyond_anchor(leg, &self.end_of_crank(q));
        Points { b: Some(b), ..Points::ends(leg, span) }
    }

    fn bodies(&self, leg: &Leg, at: &Points<f64, 3>, _: f64) -> [Body; 2] {
        let Points { a, c, .. } = *at;
        let b = at.b.unwrap_or(a);
        let place = minus(b, a);
        [
            Body {
                name: "crank",
                place: a,
                ends: [[0.0; 3], place],
                link: Some(LinkPart::Crank),
                joint: Joint::Driven { axis: axis(leg, 2) },
            },
            Body {
                name: "rod",
                place,
                ends: [[0.0; 3], minus(c, b)],
                link: Some(LinkPart::Rod),
                joint: Joint::Passive { name: "elbow" },
            },
        ]
    }

    fn dimensions(&self, _: &Leg) -> Vec<Dimension> {
        vec![Dimension::length("crank", self.crank), Dimension::length("rod", self.rod)]
    }

    fn as_revolute(&self) -> Option<&Self> {
        Some(self)
    }

    fn as_spherical(&self) -> Option<&Spherical> {
        None
    }
}
