//! The meaning of the colours of a drawn robot.

use super::svg::{Anchor, Svg};
use aspecta::legs::{Kind, Part, Role};
use aspecta::robot::{Body, Capsule, Platform, Robot};

pub(super) const BASE: &str = "#777";
pub(super) const CRANK: &str = "#0072b2";
pub(super) const ROD: &str = "#d55e00";
pub(super) const PLATFORM: &str = "#009e73";
pub(super) const SPHERE: &str = "#bbb";
pub(super) const SOLID: &str = "#e3d9c6";

/// Height of a line of the legend, pixels.
const LINE: f64 = 17.0;

type Entry = (&'static str, &'static str);

/// Draws the legend from `left` to `right` in as many lines as it needs, the last at `bottom`.
pub(super) fn legend(svg: &mut Svg, robot: &Robot, [left, right, bottom]: [f64; 3]) {
    let lines = lines(&entries(robot), right - left);
    let top = bottom - LINE * (lines.len() as f64 - 1.0);
    for (k, line) in lines.iter().enumerate() {
        let y = top + LINE * k as f64;
        let mut x = left;
        for &(colour, text) in line {
            svg.line([x, y - 4.0], [x + 20.0, y - 4.0], &format!("stroke:{colour};stroke-width:4"));
            svg.text([x + 26.0, y], Anchor::Start, 11.0, "", text);
            x += width(text);
        }
    }
}

/// Words are those of the robot's file.
fn entries(robot: &Robot) -> Vec<Entry> {
    let is_there = |kind: &&Kind| robot.legs.iter().any(|leg| leg.actuator.kind() == **kind);
    let parts: Vec<Part> =
        Kind::ALL.iter().filter(is_there).flat_map(|kind| kind.facts().parts).copied().collect();
    // A part that kinds share is named with the last of them.
    let once = parts.iter().enumerate().filter(|(k, part)| !parts[k + 1..].contains(part));
    let platform = [
        (robot.platform != Platform::PlanePoint, PLATFORM, "platform"),
        (robot.platform == Platform::TurningBody, SPHERE, "unit sphere"),
        (has_obstacle(robot), SOLID, "obstacle"),
    ];
    let platform = platform.into_iter().filter(|(there, ..)| *there).map(|(_, colour, text)| (colour, text));
    once.map(|(_, part)| (colour(part.role), part.name)).chain(platform).collect()
}

fn has_obstacle(robot: &Robot) -> bool {
    let is_one = |capsule: &Capsule| matches!(capsule.body, Body::Obstacle(_));
    !robot.obstacles().is_empty() || robot.bodies.iter().any(is_one)
}

fn colour(role: Role) -> &'static str {
    match role {
        Role::Driven => CRANK,
        Role::Guide => BASE,
        Role::Follower => ROD,
    }
}

/// Lines no wider than `room`, unless an entry alone is.
fn lines(entries: &[Entry], room: f64) -> Vec<Vec<Entry>> {
    let mut lines: Vec<Vec<Entry>> = Vec::new();
    let mut taken = f64::INFINITY;
    for &entry in entries {
        let width = width(entry.1);
        if taken + width > room {
            lines.push(Vec::new());
            taken = 0.0;
        }
        taken += width;
        if let Some(line) = lines.last_mut() {
            line.push(entry);
        }
    }
    lines
}

/// Returns the distance from an entry to the next.
fn width(text: &str) -> f64 {
    44.0 + 5.8 * text.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use aspecta::robot::catalogue;

    /// Three kinds of legs need two lines; every line ends within the picture.
    #[test]
    fn lines_are_as_wide_as_the_picture() {
        let legs = ["delta", "linear-delta", "gough-stewart"];
        let legs = legs.map(|name| catalogue::find(name).unwrap().legs.swap_remove(0));
        let mixed = Robot::new("mixed", Platform::TranslatingBody, legs.into()).unwrap();
        let mixed = entries(&mixed);
        let wrapped = lines(&mixed, 538.0);
        assert_eq!((mixed.len(), wrapped.len()), (5, 2));
        assert_eq!(wrapped.concat(), mixed);
        for line in wrapped {
            assert!(line.iter().map(|(_, text)| width(text)).sum::<f64>() <= 538.0);
        }
    }

    #[test]
    fn spherical_links_have_their_own_names() {
        let words: Vec<_> =
            entries(&catalogue::find("spherical-3-rrr").unwrap()).iter().map(|e| e.1).collect();
        assert_eq!(words, ["proximal link (driven joint filled)", "distal link", "platform", "unit sphere"]);
    }
}
