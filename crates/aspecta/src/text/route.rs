//! A planned motion for people.

use super::{Align, Labels, Table, brief, det_a_unit};
use crate::motion::crossing::Crossing;
use crate::motion::modes::Route;
use crate::motion::plan::Plan;
use crate::motion::{Clearance, Least, PathCheck};
use aspecta_robot::num::count;
use aspecta_robot::{Platform, Robot, WorkingMode};
use std::fmt::{self, Write};

/// A route as a summary that a person reads, with its checks.
///
/// # Examples
/// ```
/// use aspecta::motion::explore::{Effort, plan};
/// use aspecta::{Control, PlanOptions, Robot, Route, RouteSummary};
///
/// # fn main() -> Result<(), aspecta::Error> {
/// let robot = Robot::resolve("gough-stewart")?;
/// let mode = robot.working_modes()[0];
/// let pose = [0.535, -0.75, -0.39, -2.785, -0.973, 1.06];
/// let goal = [0.55, -0.75, -0.39, -2.785, -0.973, 1.06];
/// let effort = Effort { samples: 100, ..Effort::default() };
/// let found = plan(&robot, [&pose, &goal], mode, &PlanOptions::default(), &effort, &Control::unwatched())?;
///
/// let route = Route::from(found);
/// let checks = route.checks()?;
/// let summary = RouteSummary { route: &route, checks: &checks, degrees: true }.to_string();
/// assert!(summary.contains("roll [deg]"));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct RouteSummary<'a> {
    /// The route.
    pub route: &'a Route,
    /// Its checks: [`Route::checks`].
    pub checks: &'a [PathCheck],
    /// Whether angles are in degrees; else in radians.
    pub degrees: bool,
}

/// Prints the waypoints, the length, what is proved, how near it comes to singularities, and the crossings; angles in radians
/// ([`RouteSummary`]: or in degrees). What is said is what a check finds ([`Route::checks`]), which is made to be printed.
///
/// # Examples
/// ```
/// use aspecta::motion::modes::Configuration;
/// use aspecta::{Budget, Control, ModeGraph, Options, PlanOptions, Planner, Robot, analyze};
///
/// # fn main() -> Result<(), aspecta::Error> {
/// let robot = Robot::resolve("five-bar")?;
/// let budget = Budget { depth: Some(8), ..Budget::default() };
/// let options = Options { budget, ..Options::default() };
/// let analysis = analyze(&robot, &options, &Control::unwatched())?;
///
/// let start = Configuration { pose: &[4.0, 7.0], mode: "++".parse()? };
/// let goal = Configuration { mode: "--".parse()?, ..start };
/// let graph = ModeGraph::new(&analysis, &Control::unwatched());
/// let route = Planner::new(&analysis).route(&graph, start, goal, &PlanOptions::default())?;
/// let summary = route.to_string();
/// assert!(summary.contains("singularity-free  no parallel one, and serial ones only at 2 changes of posture"));
/// # Ok(())
/// # }
/// ```
impl fmt::Display for Route {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Waypoints that are no path of the robot are not proved.
        let checks = self.checks().unwrap_or_default();
        RouteSummary { route: self, checks: &checks, degrees: false }.fmt(f)
    }
}

/// Prints the waypoints, the length, what is proved, and how near it comes to singularities; angles in radians. What is said is what
/// a check finds ([`Plan::check`]), which is made to be printed.
///
/// # Examples
/// ```
/// use aspecta::{Budget, Control, Options, PlanOptions, Planner, Robot, analyze};
///
/// # fn main() -> Result<(), aspecta::Error> {
/// let robot = Robot::resolve("five-bar")?;
/// let budget = Budget { depth: Some(8), ..Budget::default() };
/// let modes = vec!["++".parse()?];
/// let options = Options { budget, modes, ..Options::default() };
/// let analysis = analyze(&robot, &options, &Control::unwatched())?;
///
/// let mut planner = Planner::new(&analysis);
/// let plan = planner.plan(&[4.0, 7.0], &[5.0, 6.0], "++".parse()?, &PlanOptions::default())?;
/// assert!(plan.to_string().contains("singularity-free  yes, certified, limits and margins included"));
/// # Ok(())
/// # }
/// ```
impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Route::from(self.clone()).fmt(f)
    }
}

impl fmt::Display for RouteSummary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { route, checks, degrees } = *self;
        let Some(Plan { robot, .. }) = route.stretches.first() else { return Ok(()) };
        let labels = Labels::pose(robot, degrees);
        write!(f, "{}", table(route, &labels))?;
        let length: f64 = route.stretches.iter().map(|s| s.length).sum();
        writeln!(f, "length            {} {}", brief(length), length_unit(robot))?;
        writeln!(f, "singularity-free  {}", verdict(route, checks))?;
        clearances(f, robot, checks, &labels)?;
        route.crossings.iter().try_for_each(|crossing| {
            writeln!(
                f,
                "crossing          leg {} stretched or folded at {}; clearance of all else {}, certified",
                crossing.leg,
                labels.sentence(&crossing.pose),
                brief(crossing.clearance)
            )
        })
    }
}

/// The waypoints and their modes.
fn table(route: &Route, labels: &Labels) -> Table {
    let headings = labels.headings().map(|name| (name, Align::Right));
    let mut table = Table::new(
        [("mode".to_owned(), Align::Left)].into_iter().chain(headings).chain([(String::new(), Align::Left)]),
    );
    for (k, (mode, poses)) in route.driven().iter().enumerate() {
        for (i, pose) in poses.iter().enumerate() {
            let crossing = if i + 1 == poses.len() { route.crossings.get(k) } else { None };
            let note = crossing.map_or(String::new(), |crossing| change(crossing, *mode));
            table.row([mode.to_string()].into_iter().chain(labels.numbers(pose)).chain([note]));
        }
    }
    table
}

/// What happens at a crossing that is come to in `mode`.
fn change(crossing: &Crossing, mode: WorkingMode) -> String {
    let next = crossing.modes[usize::from(crossing.modes[0] == mode)];
    format!("leg {} through its serial singularity, to mode {next}", crossing.leg)
}

fn length_unit(robot: &Robot) -> String {
    match robot.platform {
        Platform::TurningBody => "rad".into(),
        Platform::PlanePoint | Platform::TranslatingBody => robot.length_unit.clone(),
        Platform::PlaneBody | Platform::FreeBody => {
            format!("{} (angles times the characteristic length)", robot.length_unit)
        }
    }
}

fn verdict(route: &Route, checks: &[PathCheck]) -> String {
    match (route.is_proved(checks), route.crossings.len()) {
        (false, _) => "not proved".into(),
        (true, 0) => "yes, certified, limits and margins included".into(),
        (true, changes) => format!(
            "no parallel one, and serial ones only at {}: certified, limits and margins included",
            count(changes, "change of posture", "changes of posture")
        ),
    }
}

/// The least of all stretches.
fn clearances(out: &mut dyn Write, robot: &Robot, checks: &[PathCheck], labels: &Labels) -> fmt::Result {
    let found = || checks.iter().filter_map(|check| check.clearance.as_ref());
    let least =
        |of: fn(&Clearance) -> &Least| found().map(of).min_by(|a, b| a.at_least.total_cmp(&b.at_least));
    let legs = (1..).zip(&robot.legs).filter(|(_, leg)| leg.actuator.postures() == 2);
    let all = legs.flat_map(|(j, _)| found().map(move |c| (j, &c.serial[j - 1])));
    let serial = all.min_by(|a, b| a.1.at_least.total_cmp(&b.1.at_least));
    let serial = serial.map(|(j, least)| (format!("min |B_{j}{j}|/max"), Some(least), String::new()));
    let named = [
        ("min |det A|".to_owned(), least(|c| &c.det_a), det_a_unit(robot)),
        ("min |det Â|".to_owned(), least(|c| &c.parallel), String::new()),
    ];
    for (name, least, unit) in named.into_iter().chain(serial) {
        let Some(least) = least else { continue };
        writeln!(out, "{name:<18}{least}{unit}, at {}", labels.sentence(&least.pose))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::{Budget, Control, Options, PlanOptions, Planner, Robot, analyze};

    #[test]
    fn what_was_changed_since_it_was_planned_is_not_proved() {
        let robot = Robot::resolve("five-bar").unwrap();
        let mode = "++".parse().unwrap();
        let budget = Budget { depth: Some(7), ..Budget::default() };
        let options = Options { budget, modes: vec![mode], ..Options::default() };
        let analysis = analyze(&robot, &options, &Control::unwatched()).unwrap();
        let plan = Planner::new(&analysis).plan(&[4.0, 7.0], &[5.0, 6.0], mode, &PlanOptions::default());
        let mut plan = plan.unwrap();
        for end in [vec![4.0, 14.0], vec![f64::NAN]] {
            *plan.waypoints.last_mut().unwrap() = end;
            assert!(plan.to_string().contains("\nsingularity-free  not proved\n"), "{plan}");
        }
    }
}
