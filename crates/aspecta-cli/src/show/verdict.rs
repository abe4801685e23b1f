//! Text on a checked path, for people.

use crate::args::path::PathArgs;
use crate::failure::Failure;
use crate::output::{Labels, det_a_unit, number, unsigned};
use aspecta::motion::{Joined, Least, Obstacle, PathCheck};
use aspecta::robot::Robot;
use aspecta_view::failure;
use std::io::Write;

/// Prints the verdicts, obstacles, clearances and ends.
pub fn print(
    out: &mut dyn Write,
    robot: &Robot,
    check: &PathCheck,
    path: &PathArgs,
    lines: usize,
) -> Result<(), Failure> {
    let pose = Labels::pose(robot, path.deg);
    writeln!(out, "{}, working mode {}, {}", robot.name, check.mode, path.describe(lines))?;
    verdicts(out, robot, check)?;
    let at = |o: &Obstacle| (describe(robot, o, check.joined), pose.sentence(&o.pose));
    for (k, obstacle) in check.obstacle.iter().chain(&check.further).enumerate() {
        let (what, near) = at(obstacle);
        writeln!(out, "{:<18}{what}\n{:<18}near {near}", if k == 0 { "obstacle" } else { "further on" }, "")?;
    }
    if let Some(clearance) = &check.clearance {
        let blocked = match check.singularity_free {
            Some(true) => "",
            Some(false) => ", up to the singularity",
            None => ", up to the obstacle",
        };
        let mut print = |name: &str, least: &Least, unit: &str| -> Result<(), Failure> {
            let place = place(least.segment, least.t, check.joined);
            writeln!(out, "{name:<18}{}{unit}, {place}{blocked}", bounds(least))?;
            Ok(writeln!(out, "{:<18}at {}", "", pose.sentence(&least.pose))?)
        };
        print("min |det A|", &clearance.det_a, &det_a_unit(robot))?;
        print("min |det Â|", &clearance.parallel, "")?;
        for (j, least) in (1..).zip(&clearance.serial) {
            if robot.legs[j - 1].actuator.postures() == 2 {
                print(&format!("min |B_{j}{j}|/max"), least, "")?;
            }
        }
    }
    ends(out, robot, check, path)
}

fn verdicts(out: &mut dyn Write, robot: &Robot, check: &PathCheck) -> Result<(), Failure> {
    let apart = check.joined == Joined::None;
    let all_along = if apart { "at every sample" } else { "all along" };
    let free = match check.singularity_free {
        Some(true) => format!("yes, certified: det A keeps its sign and no B_jj vanishes {all_along}"),
        Some(false) => "no, certified".into(),
        None => "undecided".into(),
    };
    writeln!(out, "singularity-free  {free}")?;
    let margins = check.margins;
    if margins.parallel > 0.0 || margins.serial > 0.0 {
        let keeps = match check.keeps_margins {
            Some(true) => format!("yes, certified {all_along}"),
            Some(false) => "no, certified".into(),
            None => "undecided".into(),
        };
        let asked = format!("|det Â| ≥ {} and every |B_jj|/max ≥ {}", margins.parallel, margins.serial);
        writeln!(out, "keeps away        {keeps}: {asked}")?;
    }
    let within = match check.within_limits {
        Some(true) if robot.legs.iter().all(|leg| leg.limits.is_empty()) => "yes (the robot has no limits)",
        Some(true) => "yes, certified",
        Some(false) => "no, certified",
        None => "undecided",
    };
    Ok(writeln!(out, "within limits     {within}")?)
}

/// The unknowns at both ends.
fn ends(out: &mut dyn Write, robot: &Robot, check: &PathCheck, path: &PathArgs) -> Result<(), Failure> {
    let (name, labels, ends) = if path.is_of_joints() {
        ("pose", Labels::pose(robot, path.deg), &check.end_poses)
    } else {
        ("joints", Labels::joints(robot, path.deg), &check.ends)
    };
    for (which, end) in ["start", "end"].iter().zip(ends) {
        let missing = if path.is_of_joints() { "not proved to be reached" } else { "out of reach" };
        let end = end.as_ref().map_or(missing.to_owned(), |x| labels.sentence(x));
        writeln!(out, "{:<18}{end}", format!("{name}, {which}"))?;
    }
    if let (true, Some(last)) = (path.is_of_joints(), check.profile.last())
        && last.mode != check.mode
    {
        writeln!(out, "mode, end         {}: a leg has passed its serial singularity", last.mode)?;
    }
    Ok(())
}

/// Returns a description of what fails, and where along the path.
pub fn describe(robot: &Robot, obstacle: &Obstacle, joined: Joined) -> String {
    let failure = failure(robot, obstacle);
    if joined == Joined::None {
        return format!("{failure}, sample {}", obstacle.segment);
    }
    let (from, to) = obstacle.t;
    format!("{failure}, segment {}, t = {} … {}", obstacle.segment, number(from), number(to))
}

fn place(segment: usize, t: f64, joined: Joined) -> String {
    if joined == Joined::None {
        format!("sample {segment}")
    } else {
        format!("segment {segment}, t = {}", number(t))
    }
}

/// A proved minimum: both bounds in six digits, rounded outward.
pub fn bounds(least: &Least) -> String {
    let exponent = least.at_most.max(f64::MIN_POSITIVE).log10().floor() as i32;
    let plain = (-4..7).contains(&exponent);
    let digits = if plain { 5 - exponent } else { 5 };
    let (unit, scale) = (if plain { 1.0 } else { 10f64.powi(exponent) }, 10f64.powi(digits));
    let decimals = digits.max(0) as usize;
    let (low, high) = ((least.at_least / unit * scale).floor(), (least.at_most / unit * scale).ceil());
    let tail = if plain { String::new() } else { format!("e{exponent}") };
    format!("{:.decimals$}{tail} … {:.decimals$}{tail}", unsigned(low / scale), unsigned(high / scale))
}
