//! Planned motions, or why there is none.

use crate::args::planning::Planning;
use crate::failure::{Answer, Failure};
use crate::input::Columns;
use crate::output::{About, Format, exact, json, note};
use crate::work::planning::Planned;
use aspecta::motion::PathCheck;
use aspecta::motion::modes::{NoRoute, Route};
use aspecta::motion::plan::Refusal;
use aspecta::robot::Robot;
use aspecta::text::RouteSummary;
use aspecta_view::file;
use serde::Serialize;
use std::io::Write;

#[derive(Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    about: About<'a>,
    #[serde(flatten)]
    route: Option<&'a Route>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    checks: Vec<PathCheck>,
    #[serde(skip_serializing_if = "Option::is_none")]
    refusal: Option<Refused>,
}

#[derive(Serialize)]
struct Refused {
    reason: String,
    /// Whether it is proved that there is no such motion.
    proved: bool,
}

/// Prints a route, checked once more, or why there is none.
///
/// # Errors
/// [`Failure::Input`] if what was asked for is no question about this robot.
pub fn print(
    out: &mut dyn Write,
    robot: &Robot,
    planned: &Planned,
    Planning { moving, shown, .. }: &Planning,
) -> Result<Answer, Failure> {
    let (format, name) = (shown.format(), &robot.name);
    let mut document = Document { about: About::of(robot), route: None, checks: Vec::new(), refusal: None };
    match &planned.result {
        Err(refusal) if refusal.is_bad_input() => Err(Failure::Input(refusal.to_string())),
        Err(refusal) => {
            let told = format!("{name}: {refusal}{}", advice(refusal));
            match format {
                Format::Json => {
                    let (reason, proved) = (refusal.to_string(), refusal.is_proof());
                    json(out, &Document { refusal: Some(Refused { reason, proved }), ..document })?;
                }
                Format::Csv => note(&told),
                Format::Table => writeln!(out, "{told}")?,
            }
            Ok(Answer::No)
        }
        Ok(route) => {
            let checks = route.checks()?;
            let is_proved = route.is_proved(&checks);
            let mut written = moving.write(robot, planned, shown.deg)?.into_iter().collect::<Vec<_>>();
            if let (Some(directory), Some(page)) = (moving.out.directory(), &planned.page) {
                let path =
                    file::put(directory, "motion.html", page).map_err(Failure::in_directory(directory))?;
                written.push(format!("motion: {}", path.display()));
            }
            match format {
                Format::Json => {
                    (document.route, document.checks) = (Some(route), checks);
                    json(out, &document)?;
                }
                Format::Csv => print_csv(out, robot, route)?,
                Format::Table => {
                    write!(out, "{}", RouteSummary { route, checks: &checks, degrees: shown.deg })?;
                }
            }
            for line in written {
                format.say(out, &line)?;
            }
            Ok(Answer::from(is_proved))
        }
    }
}

/// Returns which option may help.
fn advice(refusal: &NoRoute) -> &'static str {
    match refusal {
        NoRoute::SerialMargin => " (--avoid M,0)",
        NoRoute::Plan(Refusal::NotJoined { .. }) => " (--samples, --budget)",
        NoRoute::Unknown(_) | NoRoute::NotFound { .. } | NoRoute::Plan(Refusal::NotFound { .. }) => {
            " (--budget)"
        }
        _ => "",
    }
}

/// The waypoints as CSV: the mode, then the pose; where the mode changes, the crossing comes twice.
fn print_csv(out: &mut dyn Write, robot: &Robot, route: &Route) -> Result<(), Failure> {
    let mut csv = csv::Writer::from_writer(out);
    let names = Columns::pose(robot).names;
    csv.write_record(["mode".to_owned()].into_iter().chain(names))?;
    for (mode, poses) in route.driven() {
        for pose in poses {
            csv.write_record([mode.to_string()].into_iter().chain(pose.iter().map(|x| exact(*x))))?;
        }
    }
    csv.flush()?;
    Ok(())
}
