//! The tables of a leg, read key by key: what the kinds of legs ask for.

use super::convert::Context;
use super::error::Problem;
use super::format::{ActuatorTable, At, LegTable, Value, Vector, hint};
use super::locate::Fault;
use crate::frame::{crank_frame, rail_frame, unit};
use crate::legs::Kind;
use crate::num::Interval;
use crate::{BASE_FRAME, Frame, Platform};
use std::ops::Range as Span;

const ORIGIN: [Interval; 3] = [Interval::point(0.0); 3];

/// The tables of a leg in a robot file, but for its limits.
pub(crate) struct LegKeys<'a> {
    context: &'a Context<'a>,
    leg: &'a At<LegTable>,
}

impl<'a> LegKeys<'a> {
    pub(super) fn new(context: &'a Context<'a>, leg: &'a At<LegTable>) -> Self {
        Self { context, leg }
    }

    /// A and C of a leg from point to point.
    pub fn points(&self) -> Result<([Interval; 3], [Interval; 3]), Fault> {
        let LegTable { anchor, attachment, .. } = &self.leg.value;
        let anchor = self.context.vector(required(anchor, "anchor", &self.leg.span)?)?;
        let Some(given) = attachment else { return Ok((anchor, ORIGIN)) };
        let attachment = self.context.vector(given)?;
        if self.context.platform == Platform::PlanePoint && attachment != ORIGIN {
            let reason = "all legs of a `plane-point` end in the point itself, which has no frame of its own: leave the attachment out";
            return Err(Fault::new(&given.span, Problem::OutOfPlace { reason: reason.into() }));
        }
        Ok((anchor, attachment))
    }

    /// The centre and the platform joint of a leg on a sphere.
    pub fn joints_on_sphere(&self) -> Result<([Interval; 3], [Interval; 3]), Fault> {
        let LegTable { anchor, attachment, .. } = &self.leg.value;
        if let Some(anchor) = anchor {
            let reason = "spherical legs pivot about the origin: leave the anchor out".into();
            return Err(Fault::new(&anchor.span, Problem::OutOfPlace { reason }));
        }
        let joint = required(attachment, "attachment", &self.leg.span)?;
        let direction = self.context.vector(joint)?;
        Ok((ORIGIN, unit(&direction).ok_or(Fault::new(&joint.span, Problem::ZeroVector))?))
    }

    /// The frame of a crank: that of the base in the plane, else from `axis` and `zero`.
    pub fn crank_frame(&self) -> Result<Frame, Fault> {
        if self.context.platform.space() == 2 {
            return Ok(BASE_FRAME);
        }
        let (axis, zero) = (self.vector("axis")?, self.vector("zero")?);
        let (w, u) = (self.context.vector(axis)?, self.context.vector(zero)?);
        for (vector, at) in [(&w, axis), (&u, zero)] {
            unit(vector).ok_or(Fault::new(&at.span, Problem::ZeroVector))?;
        }
        crank_frame(&w, &u).ok_or(Fault::new(&zero.span, Problem::Parallel))
    }

    /// The frame of a rail, from `direction`.
    pub fn rail_frame(&self) -> Result<Frame, Fault> {
        let direction = self.vector("direction")?;
        rail_frame(&self.context.vector(direction)?, self.context.platform.space())
            .ok_or(Fault::new(&direction.span, Problem::ZeroVector))
    }

    /// The length of a link.
    pub fn length(&self, key: &str) -> Result<Interval, Fault> {
        match self.actuator().value_of(key) {
            Some(Value::Number(length)) => self.context.length(length),
            _ => Err(self.missing(key)),
        }
    }

    /// (cos, sin) of the angle of a spherical link.
    pub fn link(&self, key: &str) -> Result<(Interval, Interval), Fault> {
        const RANGE: &str = "between 0° and 180°, ends excluded";
        match self.actuator().value_of(key) {
            Some(Value::Angle(angle)) => {
                self.context.open_angle(angle, "the angle of a spherical link", RANGE)
            }
            _ => Err(self.missing(key)),
        }
    }

    fn vector(&self, key: &str) -> Result<&'a At<Vector>, Fault> {
        match self.actuator().value_of(key) {
            Some(Value::Vector(vector)) => Ok(vector),
            _ => Err(self.missing(key)),
        }
    }

    fn actuator(&self) -> &'a ActuatorTable {
        &self.leg.value.actuator.value
    }

    fn missing(&self, key: &str) -> Fault {
        let problem = Problem::MissingKey { key: key.into(), hint: hint(key) };
        Fault::new(&self.leg.value.actuator.span, problem)
    }

    /// Every key the actuator needs, and no other.
    pub(super) fn check(&self) -> Result<(), Fault> {
        let kind = self.actuator().kind.value;
        let wanted = kind.facts().keys(self.context.platform.space());
        for (key, value) in self.actuator().values() {
            match value {
                Some(value) if !wanted.contains(&key) => {
                    let problem = Problem::OutOfPlace { reason: self.out_of_place(kind, key) };
                    return Err(Fault { span: value.span(), problem });
                }
                None if wanted.contains(&key) => return Err(self.missing(key)),
                _ => {}
            }
        }
        Ok(())
    }

    fn out_of_place(&self, kind: Kind, key: &str) -> String {
        let facts = kind.facts();
        if facts.spatial_keys.contains(&key) {
            return format!(
                "in the plane cranks turn about the normal, counter-clockwise from the x axis: leave `{key}` out"
            );
        }
        let keys = facts.keys(self.context.platform.space());
        let keys = keys.iter().fold("`kind`".to_owned(), |all, k| format!("{all}, `{k}`"));
        format!("a `{}` actuator has no `{key}`; its keys are {keys}", facts.name)
    }
}

/// A key of a leg that must be there.
fn required<'a, T>(value: &'a Option<T>, key: &str, span: &Span<usize>) -> Result<&'a T, Fault> {
    let missing = || Fault::new(span, Problem::MissingKey { key: key.into(), hint: hint(key) });
    value.as_ref().ok_or_else(missing)
}
