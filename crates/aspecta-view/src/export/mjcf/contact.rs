//! What keeps clear of one another, as geoms of which MuJoCo finds the contacts.
//!
//! Only what the robot keeps apart can touch. Two bodies are in contact, and push one another, where they are nearer than the
//! clearance between them. (Of a `gap` MuJoCo 4 makes something else than its versions before.)

use super::element::Element;
use super::leg::Limb;
use crate::figure::skeleton::{Point, times};
use aspecta::num::Interval;
use aspecta::robot::{Body, Capsule, Clearance, LegIndex, Limit, LinkPart, Robot, Solid};
use std::collections::BTreeMap;

/// Two bodies that keep clear of one another: a pair of the robot's, or a link and an obstacle that it has limits at.
#[derive(Clone, Copy)]
pub struct Contact {
    pub bodies: [Body; 2],
    /// What is left between them.
    clearance: Interval,
}

impl Contact {
    /// All that a model can have: contacts of bodies with a thickness, and of struts that their two parts cover at any length.
    pub fn of(robot: &Robot) -> Vec<Self> {
        let of_pair = robot.pairs.iter().map(|pair| {
            let [first, second] = pair.bodies.map(|body| radius(robot, body));
            Self { bodies: pair.bodies, clearance: pair.distance - first - second }
        });
        let mut all: Vec<Self> = of_pair.collect();
        for (leg, limit) in clearances(robot) {
            let link = link_of(robot, leg, limit.part);
            let bodies = [link, Body::Obstacle(limit.obstacle)];
            if all.iter().all(|contact| contact.bodies != bodies) {
                all.push(Self { bodies, clearance: limit.distance - radius(robot, link) });
            }
        }
        all.retain(|contact| contact.bodies.iter().all(|body| is_solid(robot, *body)));
        all
    }

    /// What makes MuJoCo look for it: a pair for each part of a strut.
    fn elements(&self, limbs: &[Limb<'_>]) -> Vec<Element> {
        let [first, second] = self.bodies.map(|body| geoms(limbs, body));
        // What rounding alone leaves is nothing.
        let margin = if self.clearance.is_positive() { self.clearance.mid() } else { 0.0 };
        let pair = |one: &String, other: &String| {
            let pair = Element::new("pair").with("geom1", one).with("geom2", other).with("condim", 1);
            pair.numbers("margin", &[margin])
        };
        first.iter().flat_map(|one| second.iter().map(move |other| pair(one, other))).collect()
    }
}

/// The pairs that MuJoCo looks at.
pub fn pairs(contacts: &[Contact], limbs: &[Limb<'_>]) -> Element {
    Element::new("contact").children(contacts.iter().flat_map(|contact| contact.elements(limbs)))
}

/// The obstacles that have a thickness, in the base.
pub fn obstacles(robot: &Robot) -> Vec<Element> {
    let solids =
        robot.obstacles().into_iter().map(|(number, solid)| (number, Some(self::solid(number, &solid))));
    let bars = robot.bodies.iter().filter_map(|capsule| match capsule.body {
        Body::Obstacle(number) => Some((number, bar(capsule, obstacle_name(number)))),
        Body::Crank(_) | Body::Rod(_) | Body::Platform(_) => None,
    });
    // Discs of which bodies of the platform keep clear are in both lists.
    let all: BTreeMap<usize, Option<Element>> = bars.chain(solids).collect();
    all.into_values().flatten().collect()
}

/// The bodies of the platform that have a thickness.
pub fn plates(robot: &Robot) -> Vec<Element> {
    let plates = robot.bodies.iter().filter_map(|capsule| match capsule.body {
        Body::Platform(number) => bar(capsule, plate_name(number)),
        Body::Obstacle(_) | Body::Crank(_) | Body::Rod(_) => None,
    });
    plates.collect()
}

/// Half the thickness of a link of a leg, if it has one.
pub fn thickness(robot: &Robot, leg: LegIndex, part: LinkPart) -> Option<f64> {
    let radius = radius(robot, link_of(robot, leg, part));
    radius.is_positive().then(|| radius.mid())
}

/// The limits at obstacles and pairs of bodies that a model does not have, as `contact of crank of leg 1 and rod of leg 2`.
pub fn left_out(robot: &Robot) -> Vec<String> {
    let has = Contact::of(robot);
    let lacks = |bodies: &[Body; 2]| has.iter().all(|contact| contact.bodies != *bodies);
    let limits = clearances(robot).filter_map(|(leg, limit)| {
        let bodies = [link_of(robot, leg, limit.part), Body::Obstacle(limit.obstacle)];
        let name = || format!("obstacle {} at the {} of leg {leg}", limit.obstacle, limit.part.name());
        lacks(&bodies).then(name)
    });
    let pairs =
        robot.pairs.iter().filter(|pair| lacks(&pair.bodies)).map(|pair| format!("contact of {pair}"));
    limits.chain(pairs).collect()
}

fn clearances(robot: &Robot) -> impl Iterator<Item = (LegIndex, &Clearance)> {
    (0..robot.dof()).map(LegIndex::new).flat_map(|leg| {
        let limits = robot.leg(leg).limits.iter().filter_map(Limit::as_clearance);
        limits.map(move |limit| (leg, limit))
    })
}

/// The link that a part of a leg belongs to. An elbow is the end of the crank, or, of sliders, that of the rod.
fn link_of(robot: &Robot, leg: LegIndex, part: LinkPart) -> Body {
    let has_crank = robot.leg(leg).actuator.kind().facts().has_elbow;
    match part {
        LinkPart::Crank => Body::Crank(leg),
        LinkPart::Elbow if has_crank => Body::Crank(leg),
        LinkPart::Elbow | LinkPart::Rod | LinkPart::End => Body::Rod(leg),
    }
}

/// Half the thickness of a body.
fn radius(robot: &Robot, body: Body) -> Interval {
    robot.capsule(body).map_or(Interval::point(0.0), |capsule| capsule.radius)
}

/// Whether geoms are what a body is.
fn is_solid(robot: &Robot, body: Body) -> bool {
    let is_whole = |leg: LegIndex| {
        let leg = robot.leg(leg);
        let is_strut = leg.actuator.kind().facts().is_positive;
        !is_strut || leg.telescope().is_some()
    };
    match body {
        Body::Obstacle(number) if robot.obstacles().contains_key(&number) => true,
        Body::Rod(leg) => is_whole(leg) && radius(robot, body).is_positive(),
        Body::Crank(_) | Body::Platform(_) | Body::Obstacle(_) => radius(robot, body).is_positive(),
    }
}

/// The names of the geoms of a body.
fn geoms(limbs: &[Limb<'_>], body: Body) -> Vec<String> {
    match body {
        Body::Crank(leg) => limbs[leg.index()].geoms(LinkPart::Crank),
        Body::Rod(leg) => limbs[leg.index()].geoms(LinkPart::Rod),
        Body::Platform(number) => vec![plate_name(number)],
        Body::Obstacle(number) => vec![obstacle_name(number)],
    }
}

fn plate_name(number: usize) -> String {
    format!("body{number}")
}

fn obstacle_name(number: usize) -> String {
    format!("obstacle{number}")
}

/// A body with ends, in the frame that they are in, if it has a thickness.
fn bar(capsule: &Capsule, name: String) -> Option<Element> {
    let [from, to] = capsule.shape.ends()?.map(|end| end.map(Interval::mid));
    let geom = Element::new("geom").with("name", name);
    let geom = match from == to {
        true => geom.with("type", "sphere").vector("pos", from),
        false => geom.with("type", "capsule").numbers("fromto", &[from, to].concat()),
    };
    capsule.radius.is_positive().then(|| geom.numbers("size", &[capsule.radius.mid()]))
}

/// A disc, ball or wall. What is planar lies in one plane, so that a ball does for a disc.
fn solid(number: usize, solid: &Solid) -> Element {
    let geom = Element::new("geom").with("name", obstacle_name(number));
    match solid {
        Solid::Ball { centre, radius } => {
            let geom = geom.with("type", "sphere").numbers("size", &[radius.mid()]);
            geom.vector("pos", centre.map(Interval::mid))
        }
        Solid::Wall { normal, offset } => {
            let normal: Point = normal.map(Interval::mid);
            let geom = geom.with("type", "plane").vector("pos", times(offset.mid(), normal));
            // Without end, drawn with lines 1 apart.
            geom.vector("zaxis", normal).vector("size", [0.0, 0.0, 1.0])
        }
    }
}
