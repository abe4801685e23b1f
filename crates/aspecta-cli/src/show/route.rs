//! A planned motion, as it is shown.

use super::verdict::bounds;
use crate::failure::Failure;
use crate::output::{Align, Labels, Table, brief, det_a_unit, exact};
use aspecta::kinematics::WorkingMode;
use aspecta::motion::modes::Route;
use aspecta::motion::plan::Plan;
use aspecta::motion::{Clearance, Joined, Least, PathCheck, PathOptions, check_poses};
use aspecta::robot::{Platform, Robot};
use aspecta_view::words::count;
use std::io::Write;

/// The stretches of a route as they are driven: each with the way to its crossing and back.
fn driven(route: &Route) -> Vec<(WorkingMode, Vec<Vec<f64>>)> {
    let mut all = Vec::new();
    for (k, stretch) in route.stretches.iter().enumerate() {
        let before = k.checked_sub(1).map(|k| route.crossings[k].pose.clone());
        let after = route.crossings.get(k).map(|crossing| crossing.pose.clone());
        let poses = before.into_iter().chain(stretch.waypoints.iter().cloned()).chain(after);
        all.push((stretch.mode, poses.collect()));
    }
    all
}

/// The check of each stretch of a route, which knows nothing of how it was planned.
pub(super) fn checks(robot: &Robot, route: &Route) -> Result<Vec<PathCheck>, Failure> {
    let check = |s: &Plan| {
        let options = PathOptions { joined: Joined::Straight, margins: s.margins };
        Ok(check_poses(robot, &s.waypoints, s.mode, &options)?)
    };
    route.stretches.iter().map(check).collect()
}

/// The waypoints, their modes and what is proved.
pub(super) fn print_table(
    out: &mut dyn Write,
    robot: &Robot,
    route: &Route,
    checks: &[PathCheck],
    is_proved: bool,
    degrees: bool,
) -> Result<(), Failure> {
    let labels = Labels::pose(robot, degrees);
    let headings = labels.headings().map(|name| (name, Align::Right));
    let mut table = Table::new(
        [("mode".to_owned(), Align::Left)].into_iter().chain(headings).chain([(String::new(), Align::Left)]),
    );
    for (k, (mode, poses)) in driven(route).iter().enumerate() {
        for (i, pose) in poses.iter().enumerate() {
            let crossing = if i + 1 == poses.len() { route.crossings.get(k) } else { None };
            let note = crossing.map_or(String::new(), |c| {
                format!(
                    "leg {} through its serial singularity, to mode {}",
                    c.leg,
                    c.modes[usize::from(c.modes[0] == *mode)]
                )
            });
            table.row([mode.to_string()].into_iter().chain(labels.numbers(pose)).chain([note]));
        }
    }
    write!(out, "{table}")?;
    let length: f64 = route.stretches.iter().map(|s| s.length).sum();
    let unit = match robot.platform {
        Platform::TurningBody => "rad",
        Platform::PlanePoint | Platform::TranslatingBody => &robot.length_unit,
        Platform::PlaneBody | Platform::FreeBody => {
            &format!("{} (angles times the characteristic length)", robot.length_unit)
        }
    };
    writeln!(out, "length            {} {unit}", brief(length))?;
    let word = match (is_proved, route.crossings.len()) {
        (false, _) => "not proved".into(),
        (true, 0) => "yes, certified, limits and margins included".into(),
        (true, changes) => format!(
            "no parallel one, and serial ones only at {}: certified, limits and margins included",
            count(changes, "change of posture", "changes of posture")
        ),
    };
    writeln!(out, "singularity-free  {word}")?;
    let least = |of: fn(&Clearance) -> &Least| {
        let all = checks.iter().filter_map(|c| Some(of(c.clearance.as_ref()?)));
        all.min_by(|a, b| a.at_least.total_cmp(&b.at_least))
    };
    let named = [
        ("min |det A|", least(|c| &c.det_a), det_a_unit(robot)),
        ("min |det Â|", least(|c| &c.parallel), String::new()),
    ];
    let legs = (0..robot.dof()).filter(|&j| robot.legs[j].actuator.postures() == 2);
    let all =
        legs.flat_map(|j| checks.iter().filter_map(move |c| Some((j, &c.clearance.as_ref()?.serial[j]))));
    let serial = all.min_by(|a, b| a.1.at_least.total_cmp(&b.1.at_least));
    let serial = serial.map(|(j, least)| (format!("min |B_{0}{0}|/max", j + 1), Some(least), String::new()));
    for (name, least, unit) in
        named.into_iter().map(|(name, least, unit)| (name.to_owned(), least, unit)).chain(serial)
    {
        let Some(least) = least else { continue };
        writeln!(out, "{name:<18}{}{unit}, at {}", bounds(least), labels.sentence(&least.pose))?;
    }
    for crossing in &route.crossings {
        writeln!(
            out,
            "crossing          leg {} stretched or folded at {}; clearance of all else {}, certified",
            crossing.leg,
            labels.sentence(&crossing.pose),
            brief(crossing.clearance)
        )?;
    }
    Ok(())
}

/// The waypoints as CSV: the mode, then the pose; where the mode changes, the crossing comes twice.
pub(super) fn print_csv(out: &mut dyn Write, robot: &Robot, route: &Route) -> Result<(), Failure> {
    let mut csv = csv::Writer::from_writer(out);
    let names = crate::input::Columns::pose(robot).names;
    csv.write_record(["mode".to_owned()].into_iter().chain(names))?;
    for (mode, poses) in driven(route) {
        for pose in poses {
            csv.write_record([mode.to_string()].into_iter().chain(pose.iter().map(|x| exact(*x))))?;
        }
    }
    csv.flush()?;
    Ok(())
}
