//! A leg as pictures, tables and models need it.

use crate::num::{Interval, Scalar, each};
use crate::{Leg, LinkPart, out_of_frame};

/// The positions of a leg's joints, in base coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Points<T, const D: usize> {
    /// A_i (spherical: the unit vector of the base joint).
    pub a: [T; D],
    /// B_i, absent for struts.
    pub b: Option<[T; D]>,
    /// C_i (spherical: the unit vector of the platform joint).
    pub c: [T; D],
    /// The part of a slider's line that is drawn.
    pub rail: Option<[[T; D]; 2]>,
}

impl<T: Scalar, const D: usize> Points<T, D> {
    /// A and C of a leg from point to point, and nothing between.
    pub(super) fn ends(leg: &Leg, span: &[T; D]) -> Self {
        Self { a: each!(|k| T::constant(leg.anchor[k])), b: None, c: beyond_anchor(leg, span), rail: None }
    }
}

/// A + v in the base, v being in the leg's frame.
pub(super) fn beyond_anchor<T: Scalar, const D: usize>(leg: &Leg, v: &[T; D]) -> [T; D] {
    let v = out_of_frame(leg, v);
    each!(|k| T::constant(leg.anchor[k]) + v[k])
}

impl<const D: usize> Points<f64, D> {
    /// Returns the positions as points of space; in the plane the third coordinate is 0.
    pub fn in_space(&self) -> Points<f64, 3> {
        let lift = |v: [f64; D]| std::array::from_fn(|k| v.get(k).copied().unwrap_or(0.0));
        Points { a: lift(self.a), b: self.b.map(lift), c: lift(self.c), rail: self.rail.map(|r| r.map(lift)) }
    }
}

/// A part of a drawn leg.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// The role that its colour shows.
    pub role: Role,
    /// Its name in a legend, in the words of robot files.
    pub name: &'static str,
}

/// The role of a part of a leg.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// It is driven.
    Driven,
    /// It guides what is driven.
    Guide,
    /// It follows.
    Follower,
}

impl Part {
    /// [`Part`]s, for constants.
    pub(super) const fn new(role: Role, name: &'static str) -> Self {
        Self { role, name }
    }
}

/// A rigid body of a leg, straight between two points. Until it moves its axes are those of the base.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Its name.
    pub name: &'static str,
    /// Its origin, from that of the body before it (the base's for the first).
    pub place: [f64; 3],
    /// Its ends, from its origin.
    pub ends: [[f64; 3]; 2],
    /// The link that it is, or a part of it.
    pub link: Option<LinkPart>,
    /// How it hangs on the body before it.
    pub joint: Joint,
}

/// How a body of a leg hangs on the one before it.
#[derive(Clone, Copy, Debug)]
pub enum Joint {
    /// By the driven joint, which turns about the axis or slides along it.
    Driven {
        /// The axis.
        axis: [f64; 3],
    },
    /// By a passive joint at its origin: about the plane's normal, or a ball in space.
    Passive {
        /// Its name.
        name: &'static str,
    },
    /// By a passive joint about an axis.
    Hinge {
        /// Its name.
        name: &'static str,
        /// The axis.
        axis: [f64; 3],
    },
}

/// A length or an angle of a leg.
#[derive(Clone, Copy, Debug)]
pub struct Dimension {
    /// Its name, as in robot files.
    pub name: &'static str,
    /// How great it is, approximately; `None` if that is open.
    pub size: Option<Size>,
}

/// How great a dimension is.
#[derive(Clone, Copy, Debug)]
pub enum Size {
    /// A length.
    Length(f64),
    /// From one length to another.
    Lengths(f64, f64),
    /// An angle, rad.
    Angle(f64),
}

impl Dimension {
    /// A length that the robot file gives.
    pub(super) fn length(name: &'static str, length: Interval) -> Self {
        Self { name, size: Some(Size::Length(length.mid())) }
    }
}

/// a − b.
pub(super) fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

/// s a.
pub(super) fn times(s: f64, a: [f64; 3]) -> [f64; 3] {
    a.map(|x| s * x)
}

/// Vector k of a leg's frame, in the base.
pub(super) fn axis(leg: &Leg, k: usize) -> [f64; 3] {
    leg.frame[k].map(Interval::mid)
}
