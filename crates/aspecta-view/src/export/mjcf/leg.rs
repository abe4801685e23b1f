//! A leg as bodies and joints.
//!
//! In the start configuration all bodies of legs are aligned with the base, so positions and axes are written
//! in its axes.

use super::contact;
use super::element::Element;
use crate::figure::skeleton::{LegShape, Point, times};
use aspecta::legs::{Body, Joint};
use aspecta::robot::{Leg, LegIndex, Limit, LinkPart, Robot};

/// Mass of a link. All forces are inertial, so only ratios of masses matter.
const LINK: f64 = 0.1;
/// The driven joint's inertia is this many times that of what it moves, so that the servo alone says where it
/// is.
const DRIVEN: f64 = 1000.0;
/// The servo is critically damped, with this natural frequency (rad/s).
const FREQUENCY: f64 = 100.0;
/// Passive joints lose their speed with this rate (1/s): rods between balls turn idly about themselves.
const DAMPING: f64 = 1.0;

/// A leg in the start configuration.
pub struct Limb<'a> {
    /// Its number, from 1.
    pub number: usize,
    pub robot: &'a Robot,
    pub leg: &'a Leg,
    pub shape: &'a LegShape,
    /// Its driven joint.
    pub q: f64,
    /// Half the thickness of what is drawn and has none of its own.
    pub thickness: f64,
}

impl Limb<'_> {
    /// Returns its first body, with the other in it; that one has the site `end…`, which belongs at the
    /// platform's `attachment…`.
    pub fn body(&self) -> Element {
        let [first, last] = self.bodies();
        self.link(&first).child(self.ended(self.link(&last), last.ends[1]))
    }

    /// Returns the constraint that holds the leg and the platform together.
    pub fn closure(&self) -> Element {
        Element::new("connect")
            .with("name", self.named("closure"))
            .with("site1", self.named("end"))
            .with("site2", self.named("attachment"))
    }

    /// The servo of the driven joint.
    pub fn servo(&self) -> Element {
        let stiffness = self.armature() * FREQUENCY * FREQUENCY;
        let servo = Element::new("position").with("name", self.named("q")).with("joint", self.named("q"));
        servo.numbers("kp", &[stiffness]).numbers("kv", &[2.0 * stiffness / FREQUENCY])
    }

    /// The names of the geoms of a link.
    pub fn geoms(&self, link: LinkPart) -> Vec<String> {
        let of_link = self.bodies().into_iter().filter(|body| body.link == Some(link));
        of_link.map(|body| self.named(body.name)).collect()
    }

    fn bodies(&self) -> [Body; 2] {
        self.leg.actuator.bodies(self.leg, self.shape, self.q)
    }

    fn named(&self, name: &str) -> String {
        format!("{name}{}", self.number)
    }

    /// A body and the joint that it hangs on.
    fn link(&self, body: &Body) -> Element {
        let ends = body.ends;
        let middle = times(0.5, [0, 1, 2].map(|k| ends[0][k] + ends[1][k]));
        let inertia = LINK * self.size().powi(2);
        let inertial = Element::new("inertial").vector("pos", middle).numbers("mass", &[LINK]);
        let own =
            body.link.and_then(|link| contact::thickness(self.robot, LegIndex::new(self.number - 1), link));
        let shape = match own {
            Some(_) => Element::new("geom").with("name", self.named(body.name)),
            None => Element::new("geom"),
        };
        let shape = shape.with("type", "capsule").numbers("size", &[own.unwrap_or(self.thickness)]);
        Element::new("body")
            .with("name", self.named(body.name))
            .vector("pos", body.place)
            .child(inertial.vector("diaginertia", [inertia; 3]))
            .child(shape.numbers("fromto", &ends.concat()))
            .child(match body.joint {
                Joint::Driven { axis } => self.driven(axis),
                Joint::Passive { name } => self.passive(name),
                Joint::Hinge { name, axis } => self.hinge(name, axis),
            })
    }

    fn ended(&self, body: Element, place: Point) -> Element {
        body.child(Element::new("site").with("name", self.named("end")).vector("pos", place))
    }

    /// The driven joint `q…`, which reads q in the start configuration.
    fn driven(&self, axis: Point) -> Element {
        let kind = if self.leg.actuator.is_angle() { "hinge" } else { "slide" };
        let joint =
            Element::new("joint").with("name", self.named("q")).with("type", kind).vector("axis", axis);
        let joint = joint.numbers("ref", &[self.q]).numbers("armature", &[self.armature()]);
        match self.leg.drive_range() {
            Some((low, high)) => joint.numbers("range", &[low, high]),
            None => joint,
        }
    }

    /// A passive joint at the body's origin: about the plane's normal, or a ball.
    fn passive(&self, name: &str) -> Element {
        if self.robot.platform.space() == 2 {
            return self.hinge(name, [0.0, 0.0, 1.0]);
        }
        self.damped(Element::new("joint").with("name", self.named(name)).with("type", "ball"))
    }

    fn hinge(&self, name: &str, axis: Point) -> Element {
        let joint = Element::new("joint").with("name", self.named(name)).with("type", "hinge");
        self.damped(joint.vector("axis", axis))
    }

    fn damped(&self, joint: Element) -> Element {
        joint.numbers("damping", &[DAMPING * LINK * self.size().powi(2)])
    }

    /// A typical length of the leg.
    fn size(&self) -> f64 {
        self.leg.actuator.size_at(self.q)
    }

    fn armature(&self) -> f64 {
        if self.leg.actuator.is_angle() { DRIVEN * self.size().powi(2) } else { DRIVEN }
    }
}

/// The limits of passive joints, which the model does not have, as `elbow of leg 1`.
pub fn left_out(legs: &[Leg]) -> Vec<String> {
    let name = |leg: usize, limit: &Limit| match limit {
        Limit::ActuatorAngle { .. } | Limit::ActuatorLength { .. } | Limit::Clearance(_) => None,
        Limit::Elbow { .. } | Limit::SpatialElbow { .. } => Some(format!("elbow of leg {leg}")),
        Limit::BaseCone { .. } => Some(format!("base-joint of leg {leg}")),
        Limit::PlatformCone { .. } => Some(format!("platform-joint of leg {leg}")),
    };
    let of = |(k, leg): (usize, &Leg)| -> Vec<String> {
        leg.limits.iter().filter_map(|limit| name(k + 1, limit)).collect()
    };
    legs.iter().enumerate().flat_map(of).collect()
}
