//! MuJoCo's models (MJCF): bodies and joints in trees, closed loops as `connect` constraints.
//!
//! Lengths are in the robot's unit, angles in radians. There is no gravity, only what the robot keeps apart can touch, and masses have
//! no meaning: the model moves as the robot's kinematics do. Joints read what the robot's coordinates are:
//! `q1`, `q2`, … the driven ones, `x`, `y`, `z` and `phi` those of the platform; an orientation in space is
//! that of the body `platform`.

mod contact;
mod element;
mod leg;

use crate::figure::skeleton::{Point, Skeleton};
use aspecta::kinematics::Solution;
use aspecta::num::Interval;
use aspecta::robot::{Platform, Robot, RodAngle};
use contact::Contact;
use element::Element;
use leg::Limb;

/// The robot as a model that starts in the configuration `start`. Position servos `q1`, `q2`, … drive it; the
/// keyframe `start` has the inputs that keep it where it is. Ranges of the driven joints are part of it, and so are bodies and
/// obstacles, but not what [`left_out`] names.
pub fn model(robot: &Robot, start: &Solution) -> String {
    let skeleton = Skeleton::at(robot, &start.pose, &start.q);
    let thickness = 0.01 * skeleton.size;
    let limb =
        |(k, leg)| Limb { number: k + 1, leg, shape: &skeleton.legs[k], robot, q: start.q[k], thickness };
    let limbs: Vec<Limb<'_>> = robot.legs.iter().enumerate().map(limb).collect();
    let inputs = &start.q;
    let contacts = Contact::of(robot);
    let bodies = limbs.iter().map(Limb::body).chain([platform(robot, start, &skeleton, thickness)]);
    let bodies = contact::obstacles(robot).into_iter().chain(bodies);
    let document = Element::new("mujoco")
        .with("model", &robot.name)
        .children(settings(!contacts.is_empty()))
        .child(facts(robot, start))
        .child(Element::new("worldbody").children(bodies))
        .children((!contacts.is_empty()).then(|| contact::pairs(&contacts, &limbs)))
        .child(Element::new("equality").children(limbs.iter().map(Limb::closure)))
        .child(Element::new("actuator").children(limbs.iter().map(Limb::servo)))
        .child(
            Element::new("keyframe").child(Element::new("key").with("name", "start").numbers("ctrl", inputs)),
        );
    format!("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n{document}")
}

/// The limits of the robot that its model does not have, as `elbow of leg 1`.
pub fn left_out(robot: &Robot) -> Vec<String> {
    let of =
        |limit: &RodAngle| format!("angle between the rods of legs {} and {}", limit.legs[0], limit.legs[1]);
    let angles = robot.rod_angles.iter().map(of);
    leg::left_out(&robot.legs).into_iter().chain(angles).chain(contact::left_out(robot)).collect()
}

/// Constraints are as stiff as time steps of 1 ms allow. Whatever is drawn passes through what it is not kept apart from.
fn settings(with_contacts: bool) -> [Element; 3] {
    let option = Element::new("option").numbers("timestep", &[0.001]).vector("gravity", [0.0; 3]);
    let option = option.with("integrator", "implicitfast").with("tolerance", "1e-14");
    let stiff = Element::new("equality").numbers("solref", &[0.002, 1.0]);
    let stiff = stiff.numbers("solimp", &[0.9999, 0.9999, 0.001]);
    let (option, default) = match with_contacts {
        true => {
            let passing = Element::new("geom").with("contype", 0).with("conaffinity", 0);
            (option, Element::new("default").child(passing))
        }
        false => (option.child(Element::new("flag").with("contact", "disable")), Element::new("default")),
    };
    [
        Element::new("compiler").with("angle", "radian").with("autolimits", "true"),
        option,
        default.child(stiff),
    ]
}

/// Returns the facts that a reader of the model cannot see in it.
fn facts(robot: &Robot, start: &Solution) -> Element {
    let text = |name, data: &str| Element::new("text").with("name", name).with("data", data);
    let pose: Vec<_> = robot.platform.coordinates().iter().map(|c| c.name).collect();
    let length = Element::new("numeric").with("name", "characteristic_length");
    Element::new("custom")
        .child(length.numbers("data", &[robot.characteristic_length()]))
        .child(text("length_unit", &robot.length_unit))
        .child(text("platform", robot.platform.name()))
        .child(text("pose", &pose.join(" ")))
        .child(text("working_mode", &start.mode.to_string()))
}

/// The platform, whose frame is that of the robot file.
fn platform(robot: &Robot, start: &Solution, skeleton: &Skeleton, thickness: f64) -> Element {
    let [x, y, _] = skeleton.axes;
    let length = robot.characteristic_length();
    let inertial = Element::new("inertial").vector("pos", [0.0; 3]).numbers("mass", &[1.0]);
    let ball = Element::new("geom").with("type", "sphere").numbers("size", &[2.0 * thickness]);
    Element::new("body")
        .with("name", "platform")
        .vector("pos", skeleton.origin)
        .numbers("xyaxes", &[x, y].concat())
        .child(inertial.vector("diaginertia", [length * length; 3]))
        .children(joints(robot.platform, &start.pose, &skeleton.axes))
        .child(ball)
        .children(contact::plates(robot))
        .children((1..).zip(&robot.legs).flat_map(|(number, leg)| {
            let end = leg.attachment.map(Interval::mid);
            attachment(number, end, thickness)
        }))
}

/// The site `attachment…`, and an arm that leads there.
fn attachment(number: usize, end: Point, thickness: f64) -> Vec<Element> {
    let site = Element::new("site").with("name", format!("attachment{number}")).vector("pos", end);
    let arm = Element::new("geom").with("type", "capsule").numbers("size", &[thickness]);
    let arm = arm.numbers("fromto", &[[0.0; 3], end].concat());
    if end == [0.0; 3] { vec![site] } else { vec![site, arm] }
}

/// The joints of the platform. Their axes are written in its own frame, though slides go along those of the
/// base.
fn joints(platform: Platform, pose: &[f64], axes: &[Point; 3]) -> Vec<Element> {
    let joint = |name: &str, kind: &str| Element::new("joint").with("name", name).with("type", kind);
    let coordinates = platform.coordinates().iter().zip(pose).enumerate();
    let mut all: Vec<Element> = Vec::new();
    for (k, (c, value)) in coordinates {
        if !c.angle {
            all.push(joint(c.name, "slide").vector("axis", axes.map(|a| a[k])).numbers("ref", &[*value]));
        } else if platform.space() == 2 {
            all.push(joint(c.name, "hinge").vector("axis", [0.0, 0.0, 1.0]).numbers("ref", &[*value]));
        }
    }
    if platform.turns_in_space() {
        all.push(joint("orientation", "ball"));
    }
    all
}
