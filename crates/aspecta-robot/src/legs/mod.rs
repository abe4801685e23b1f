//! The kinds of legs: all that the program knows of a kind stands in the kind's file.
//!
//! Formulas are written in the leg's own frame u, v, w, with d = C − A = (α, β, γ) (γ is absent in the plane)
//! and for any scalar. `LegKind` lists the questions that a kind answers; [`Actuator`] is one of the kinds
//! and hands each question on to its file. Nobody outside asks of which kind a leg is, but the checker, which
//! has formulas of its own.
//!
//! This room and [`crate`] are one floor: a leg of a robot holds an actuator, and a kind makes a leg
//! from the keys of a robot file.

mod closure;
mod drawn;
mod facts;
mod prismatic;
mod revolute;
mod spherical;
mod strut;
#[cfg(test)]
mod tests;

pub use closure::{Closure, Drive, Elbow, LockedEnd, RigidRod, sum_of_squares};
pub use drawn::{Body, Dimension, Joint, Part, Points, Role, Size};
pub use facts::Facts;
pub use prismatic::Prismatic;
pub use revolute::Revolute;
pub use spherical::Spherical;
pub use strut::Strut;

use crate::num::{Interval, Scalar};
use crate::{Fault, Leg, LegKeys};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Makes [`Kind`] and [`Actuator`] from the one list of kinds. Each is named like the type of its data.
macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident),+ $(,)?) => {
        /// The kind of a leg's actuator.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "kebab-case")]
        pub enum Kind {
            $($(#[$doc])* $kind),+
        }

        impl Kind {
            /// All kinds.
            pub const ALL: &'static [Self] = &[$(Self::$kind),+];

            /// The facts that hold for all legs of the kind.
            pub const fn facts(self) -> &'static Facts {
                match self {
                    $(Self::$kind => &$kind::FACTS),+
                }
            }

            /// The leg that the keys of a robot file describe, without its limits.
            pub(crate) fn read(self, keys: &LegKeys<'_>) -> Result<Leg, Fault> {
                match self {
                    $(Self::$kind => $kind::read(keys)),+
                }
            }
        }

        /// The driven joint of a leg and the lengths behind it. u, v, w are the leg's frame.
        #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
        pub enum Actuator {
            $($(#[$doc])* $kind($kind)),+
        }

        impl Actuator {
            /// Returns its kind.
            pub const fn kind(&self) -> Kind {
                match self {
                    $(Self::$kind(_) => Kind::$kind),+
                }
            }
        }

        $(impl From<$kind> for Actuator {
            fn from(data: $kind) -> Self {
                Self::$kind(data)
            }
        })+
    };
}

kinds! {
    /// A motor turns a crank, a rod follows: RRR, RSS, RUS.
    Revolute,
    /// A slider on a rail, a rod follows: PRR, PSS, PUS.
    Prismatic,
    /// The distance from A to C is driven: RPR, UPS, SPS.
    Strut,
    /// RRR on a sphere about the origin.
    Spherical,
}

/// An expression about the data of an actuator, whatever its kind.
macro_rules! of_kind {
    ($actuator:expr, $data:ident => $asked:expr) => {
        match $actuator {
            Actuator::Revolute($data) => $asked,
            Actuator::Prismatic($data) => $asked,
            Actuator::Strut($data) => $asked,
            Actuator::Spherical($data) => $asked,
        }
    };
}

/// Makes the trait [`LegKind`] from a list of questions, and a method of [`Actuator`] for each of them.
macro_rules! questions {
    ($($(#[$doc:meta])* fn $name:ident $([$($generic:tt)+])? (&self $(, $given:ident: $type:ty)*) -> $answer:ty;)+) => {
        /// The questions that every kind of leg answers.
        pub(crate) trait LegKind: Copy + Into<Actuator> {
            /// The facts that hold for all legs of the kind.
            const FACTS: Facts;

            /// The leg that the keys of a robot file describe, without its limits.
            ///
            /// # Errors
            /// [`Fault`], where and why the keys make no such leg.
            fn read(keys: &LegKeys<'_>) -> Result<Leg, Fault>;

            $($(#[$doc])* fn $name $(<$($generic)+>)? (&self $(, $given: $type)*) -> $answer;)+
        }

        impl Actuator {
            $(
                $(#[$doc])*
                #[inline]
                pub fn $name $(<$($generic)+>)? (&self $(, $given: $type)*) -> $answer {
                    of_kind!(self, data => data.$name($($given),*))
                }
            )+
        }
    };
}

questions! {
    // ---- The leg equation.

    /// f(d, q), the left side of the leg equation f = 0, with (sin q, cos q) from `turn`, which is asked only
    /// where q is an angle. Lengths squared, except for spherical legs (a cosine).
    fn equation_turned[T: Scalar, const D: usize](&self, d: &[T; D], q: T, turn: impl FnOnce() -> (T, T)) -> T;

    /// Eliminates q from the leg equation.
    fn eliminate[T: Scalar, const D: usize](&self, d: &[T; D]) -> Closure<T, D>;

    /// The driven joint q in the posture given by `sh` = s h: g_i(X) of (5), leg by leg.
    fn drive[T: Scalar, const D: usize](&self, d: &[T; D], closure: &Closure<T, D>, sh: T) -> Drive<T>;

    /// s h at a configuration where ∂f/∂q is `slope`.
    fn signed_height[T: Scalar](&self, slope: T) -> T;

    /// ‖∂f/∂d‖ at a configuration, where ∂f/∂d is `gradient`.
    fn force[T: Scalar, const D: usize](&self, gradient: &[T; D]) -> T;

    /// ‖weight · ∂f/∂d‖ at the configurations of a closure: twice the rod's length times the weight.
    fn row_length[T: Scalar, const D: usize](&self, closure: &Closure<T, D>) -> T;

    /// The numbers of the leg equation but for the coordinates of points.
    fn constants(&self) -> Vec<Interval>;

    // ---- Limits.

    /// (q − min)(max − q), or a like product that has its sign, if q is a length; else it may be anything.
    fn length_margin[T: Scalar, const D: usize](&self, d: &[T; D], sh: T, min: Interval, max: Interval) -> T;

    /// (2LM cos ψ, 2LM) with ψ the angle at B from crank to rod, if there is one; then 2LM sin ψ = −s h.
    fn bend[T: Scalar, const D: usize](&self, d: &[T; D]) -> Option<(T, Interval)>;

    // ---- Sizes.

    /// The greatest H can be: (2LM)², M² or (sin sin)²; `None` for struts, whose H has no
    /// zero to keep away from. Makes reaches comparable.
    fn greatest_reach(&self) -> Option<Interval>;

    /// The size of [`Closure::weight`] where q is far from free, approximately; `None` if a driven joint that
    /// is nearly free is not looked for.
    fn usual_weight(&self) -> Option<f64>;

    /// The size of the terms of the leg equation, approximately, to judge a residual by.
    fn equation_scale(&self, q: f64) -> f64;

    /// The sum of the link lengths, approximately (1 for struts and spherical legs).
    fn size(&self) -> f64;

    /// [`Actuator::size`] of a leg whose driven joint is at q: the length of a strut.
    fn size_at(&self, q: f64) -> f64;

    /// The size of the numbers that go into q, of which rounding leaves a few units in the last place open,
    /// seen as an angle of the crank where q is one; `ends` is the size of the coordinates of A and C.
    fn rounded_size(&self, ends: f64, q: f64) -> f64;

    // ---- Reach.

    /// Bounds of the base coordinate k of C, as (centre, radius), that the leg alone proves; `None` if it
    /// proves none.
    fn extent(&self, leg: &Leg, k: usize) -> Option<(Interval, Interval)>;

    /// Returns how far the rod's length is from the range of distances between C and the places its other end
    /// can take, ≥ 0: a length, or an angle (rad) for spherical legs.
    fn gap[const D: usize](&self, d: &[f64; D]) -> f64;

    // ---- Places.

    /// B − A in the leg's frame, or the direction of the intermediate joint of a spherical leg; `None` if
    /// nothing is between the driven joint and C.
    fn elbow[T: Scalar, const D: usize](&self, q: T) -> Option<[T; D]>;

    /// Returns the points that C can reach while the actuator is locked at q.
    fn locked[const D: usize](&self, q: Interval) -> LockedEnd<D>;

    /// The rod of constant length that ends in C, and the curve of its other end, if the leg has one.
    fn rigid_rod(&self) -> Option<RigidRod>;

    /// Returns the joints' positions in the base; `span` is d, and `arm` goes from the platform's origin to
    /// C.
    fn points[T: Scalar, const D: usize](&self, leg: &Leg, span: &[T; D], arm: &[T; D], q: T) -> Points<T, D>;

    // ---- Descriptions.

    /// The leg as two bodies one after the other, joined to the base where its points are `at`.
    fn bodies(&self, leg: &Leg, at: &Points<f64, 3>, q: f64) -> [Body; 2];

    /// The lengths and angles that make the leg, for people.
    fn dimensions(&self, leg: &Leg) -> Vec<Dimension>;

    // ---- Charts, of which each kind that can fold has its own.

    /// Crank and rod, if they are what the leg consists of.
    fn as_revolute(&self) -> Option<&Revolute>;

    /// The links on a sphere, if they are what the leg consists of.
    fn as_spherical(&self) -> Option<&Spherical>;
}

impl Kind {
    /// The name used in robot files.
    pub const fn name(self) -> &'static str {
        self.facts().name
    }
}

impl Actuator {
    /// f(d, q), the left side of the leg equation f = 0. Lengths squared, except for spherical legs (a
    /// cosine).
    pub fn equation<T: Scalar, const D: usize>(&self, d: &[T; D], q: T) -> T {
        self.equation_turned(d, q, || q.sin_cos())
    }

    /// Returns how many inverse solutions the leg has: 2, or 1 for a strut.
    pub const fn postures(&self) -> usize {
        self.kind().facts().postures
    }

    /// Whether q is an angle (rad) rather than a length.
    pub const fn is_angle(&self) -> bool {
        self.kind().facts().is_angle
    }

    /// Whether no configuration has this q, since q is a length that is positive in all of them.
    pub fn forbids(&self, q: f64) -> bool {
        self.kind().facts().is_positive && q <= 0.0
    }
}
