//! What a robot is made of, in a few lines.

use crate::output::number;
use aspecta::robot::legs::Size;
use aspecta::robot::{Leg, Robot};
use std::io::{self, Write};

/// Prints the legs of a robot with their lengths and limits, and its window.
pub fn print(out: &mut dyn Write, robot: &Robot) -> io::Result<()> {
    writeln!(
        out,
        "robot `{}`: {}, {} legs, lengths in {}",
        robot.name,
        robot.platform,
        robot.dof(),
        robot.length_unit
    )?;
    for (k, leg) in robot.legs.iter().enumerate() {
        writeln!(out, "  leg {}: {}", k + 1, of_leg(leg, robot))?;
    }
    robot.rod_angles.iter().try_for_each(|limit| writeln!(out, "  {}", limit.in_words()))?;
    bodies(out, robot)?;
    let coordinates = robot.platform.coordinates().iter().zip(&robot.window);
    let cut = coordinates.filter_map(|(c, range)| {
        range.map(|(lo, hi)| format!("{} {} to {}", c.name, number(lo), number(hi)))
    });
    let cut: Vec<String> = cut.collect();
    let window = if cut.is_empty() { "none".to_owned() } else { cut.join(", ") };
    writeln!(out, "  window: {window}")
}

/// Prints the bodies of a robot, and which of them keep clear of one another.
pub fn bodies(out: &mut dyn Write, robot: &Robot) -> io::Result<()> {
    if robot.bodies.is_empty() {
        return Ok(());
    }
    let all: Vec<String> = robot.bodies.iter().map(|capsule| capsule.in_words(&robot.length_unit)).collect();
    writeln!(out, "  bodies: {}", all.join("; "))?;
    writeln!(out, "  kept apart: {}", robot.kept_apart())
}

fn of_leg(leg: &Leg, robot: &Robot) -> String {
    let vector = |v: &[aspecta::num::Interval; 3]| {
        let parts: Vec<String> = v[..robot.platform.space()].iter().map(|x| number(x.mid())).collect();
        format!("({})", parts.join(", "))
    };
    let mut parts = vec![
        leg.actuator.kind().name().to_owned(),
        format!("A {}", vector(&leg.anchor)),
        format!("C {}", vector(&leg.attachment)),
    ];
    for dimension in leg.actuator.dimensions(leg) {
        match dimension.size {
            Some(Size::Length(length)) => parts.push(format!("{} {}", dimension.name, number(length))),
            Some(Size::Angle(angle)) => parts.push(format!("{} {} rad", dimension.name, number(angle))),
            // A range is a limit, which follows.
            Some(Size::Lengths(..)) | None => {}
        }
    }
    parts.extend(leg.limits.iter().map(|limit| limit.in_words(&robot.length_unit)));
    parts.join(", ")
}
