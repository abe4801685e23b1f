//! A checked path for people.

use super::{Asked, Bound, Joined, Least, Obstacle, PathCheck};
use crate::constraints::{Constraint, Kind, is_limited};
use aspecta_robot::Robot;
use aspecta_robot::text::{Labels, det_a_unit, number, subscript, unsigned};
use std::fmt::{self, Write};

/// A checked path as a summary that a person reads.
///
/// # Examples
/// ```
/// use aspecta_kinematics::path::{PathSummary, check_path};
/// use aspecta_robot::catalogue;
///
/// let robot = catalogue::find("five-bar").unwrap();
/// let check = check_path(&robot, &[vec![4.0, 7.0], vec![4.5, 7.5]], "++".parse().unwrap())?;
/// let summary = PathSummary { check: &check, degrees: true }.to_string();
/// assert!(summary.contains("joints, start     q1 = 96.526"));
/// # Ok::<(), aspecta_kinematics::path::PathError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct PathSummary<'a> {
    /// The check.
    pub check: &'a PathCheck,
    /// Whether angles are in degrees; else in radians.
    pub degrees: bool,
}

/// Prints the verdicts, the obstacles, the clearances and both ends; angles in radians ([`PathSummary`]: or in degrees).
///
/// # Examples
/// ```
/// use aspecta_kinematics::path::check_path;
/// use aspecta_robot::catalogue;
///
/// let robot = catalogue::find("five-bar").unwrap();
/// let check = check_path(&robot, &[vec![4.0, 7.0], vec![4.0, 14.0]], "++".parse().unwrap())?;
/// let summary = check.to_string();
/// assert!(summary.contains("obstacle          leg 2 is stretched or folded (serial singularity), segment 1, t = 0.714286"));
/// # Ok::<(), aspecta_kinematics::path::PathError>(())
/// ```
impl fmt::Display for PathCheck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        PathSummary { check: self, degrees: false }.fmt(f)
    }
}

impl fmt::Display for PathSummary<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { check, degrees } = *self;
        let pose = Labels::pose(&check.robot, degrees);
        writeln!(f, "{}", check.heading())?;
        verdicts(f, check)?;
        for (k, obstacle) in check.obstacle.iter().chain(&check.further).enumerate() {
            let name = if k == 0 { "obstacle" } else { "further on" };
            writeln!(f, "{name:<18}{}", check.in_words(obstacle))?;
            writeln!(f, "{:<18}near {}", "", pose.sentence(&obstacle.pose))?;
        }
        clearances(f, check, &pose)?;
        ends(f, check, degrees)
    }
}

impl PathCheck {
    /// Returns what was checked: `five-bar, working mode ++, 3 poses joined by straight segments`.
    pub fn heading(&self) -> String {
        let what = if self.of_joints { "joint vectors" } else { "poses" };
        let joined = match self.joined {
            Joined::Straight => " joined by straight segments",
            Joined::Spline => " joined by a spline",
            Joined::None => ", each by itself: nothing is claimed of what lies between",
        };
        format!("{}, working mode {}, {} {what}{joined}", self.robot.name, self.mode, self.samples)
    }

    /// Returns a description of what fails at an obstacle, and where along the path.
    pub fn in_words(&self, obstacle: &Obstacle) -> String {
        let Obstacle { segment, t: (from, to), .. } = *obstacle;
        let failure = obstacle.in_words(&self.robot);
        if self.joined == Joined::None {
            return format!("{failure}, sample {segment}");
        }
        // A place that is proved is the first: how far it goes on is not looked at.
        let first = if obstacle.proved { " (where it begins)" } else { "" };
        format!("{failure}, segment {segment}, t = {} … {}{first}", number(from), number(to))
    }
}

impl Obstacle {
    /// Returns a description of what fails, on a path of this robot.
    pub fn in_words(&self, robot: &Robot) -> String {
        let what = match self.bound {
            Bound::Constraint(constraint) => self.beyond(constraint, robot),
            Bound::Window { coordinate } => format!("{coordinate} is beyond the robot's window"),
        };
        if self.proved { what } else { format!("not excluded: {what}") }
    }

    fn beyond(&self, constraint: Constraint, robot: &Robot) -> String {
        match constraint.kind() {
            Kind::Parallel if self.asked == Asked::Margin => "|det Â| falls below its margin".to_owned(),
            Kind::Serial(j) if self.asked == Asked::Margin => {
                format!("|B{0}{0}|/max falls below its margin", subscript(j.number()))
            }
            Kind::Parallel => "det A vanishes or changes sign (parallel singularity)".to_owned(),
            Kind::Serial(j) => format!("leg {j} is stretched or folded (serial singularity)"),
            Kind::Limit => format!("beyond the {}", constraint.named(robot)),
        }
    }
}

/// Words for an answer that is proved, or is not known.
fn proved(answer: Option<bool>, yes: &str) -> String {
    match answer {
        Some(true) => format!("yes, certified{yes}"),
        Some(false) => "no, certified".into(),
        None => "undecided".into(),
    }
}

fn verdicts(out: &mut dyn Write, check: &PathCheck) -> fmt::Result {
    let all_along = if check.joined == Joined::None { "at every sample" } else { "all along" };
    let keeps = format!(": det A keeps its sign and no B_jj vanishes {all_along}");
    writeln!(out, "singularity-free  {}", proved(check.singularity_free, &keeps))?;
    let margins = check.margins;
    if margins.are_any() {
        let keeps = proved(check.keeps_margins, &format!(" {all_along}"));
        let asked = format!("|det Â| ≥ {} and every |B_jj|/max ≥ {}", margins.parallel, margins.serial);
        writeln!(out, "keeps away        {keeps}: {asked}")?;
    }
    let robot = &check.robot;
    let unlimited = !is_limited(robot) && (0..robot.dof()).all(|k| robot.window_range(k).is_none());
    let within = match check.within_limits {
        Some(true) if unlimited => "yes (the robot has no limits)".into(),
        answer => proved(answer, ""),
    };
    writeln!(out, "within limits     {within}")
}

/// How near the path comes to singularities: of legs that have two postures only.
fn clearances(out: &mut dyn Write, check: &PathCheck, pose: &Labels) -> fmt::Result {
    let Some(clearance) = &check.clearance else { return Ok(()) };
    let blocked = match check.singularity_free {
        Some(true) => "",
        Some(false) => ", up to the singularity",
        None => ", up to the obstacle",
    };
    let mut print = |name: &str, least: &Least, unit: &str| {
        let (segment, t) = (least.segment, number(least.t));
        let place = match check.joined {
            Joined::None => format!("sample {segment}"),
            Joined::Straight | Joined::Spline => format!("segment {segment}, t = {t}"),
        };
        writeln!(out, "{name:<18}{least}{unit}, {place}{blocked}")?;
        writeln!(out, "{:<18}at {}", "", pose.sentence(&least.pose))
    };
    print("min |det A|", &clearance.det_a, &det_a_unit(&check.robot))?;
    print("min |det Â|", &clearance.parallel, "")?;
    for ((j, least), leg) in (1..).zip(&clearance.serial).zip(&check.robot.legs) {
        if leg.actuator.postures() == 2 {
            print(&format!("min |B_{j}{j}|/max"), least, "")?;
        }
    }
    Ok(())
}

/// The unknowns at both ends.
fn ends(out: &mut dyn Write, check: &PathCheck, degrees: bool) -> fmt::Result {
    let (name, labels, ends, missing) = if check.of_joints {
        ("pose", Labels::pose(&check.robot, degrees), &check.end_poses, "not proved to be reached")
    } else {
        ("joints", Labels::joints(&check.robot, degrees), &check.ends, "out of reach")
    };
    for (which, end) in ["start", "end"].iter().zip(ends) {
        let end = end.as_ref().map_or(missing.to_owned(), |x| labels.sentence(x));
        writeln!(out, "{:<18}{end}", format!("{name}, {which}"))?;
    }
    if let (true, Some(last)) = (check.of_joints, check.profile.last())
        && last.mode != check.mode
    {
        writeln!(out, "mode, end         {}: a leg has passed its serial singularity", last.mode)?;
    }
    Ok(())
}

/// Prints both bounds in six digits, rounded outward: `0.123455 … 0.123457`.
impl fmt::Display for Least {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let exponent = self.at_most.max(f64::MIN_POSITIVE).log10().floor() as i32;
        let plain = (-4..7).contains(&exponent);
        let digits = if plain { 5 - exponent } else { 5 };
        let (unit, scale) = (if plain { 1.0 } else { 10f64.powi(exponent) }, 10f64.powi(digits));
        let decimals = digits.max(0) as usize;
        let (low, high) = ((self.at_least / unit * scale).floor(), (self.at_most / unit * scale).ceil());
        let tail = if plain { String::new() } else { format!("e{exponent}") };
        let [low, high] = [low, high].map(|x| unsigned(x / scale));
        write!(f, "{low:.decimals$}{tail} … {high:.decimals$}{tail}")
    }
}

#[cfg(test)]
mod tests {
    use super::Least;

    #[test]
    fn bounds_are_rounded_outward() {
        let said = [(0.1234561, 0.1234562), (0.0, 2.5e-9), (12.0, 12.0), (3e8, 3.00001e8)].map(|bounds| {
            let (at_least, at_most) = bounds;
            Least { at_least, at_most, segment: 1, t: 0.0, pose: vec![] }.to_string()
        });
        let wanted =
            ["0.123456 … 0.123457", "0.00000e-9 … 2.50000e-9", "12.0000 … 12.0000", "3.00000e8 … 3.00001e8"];
        assert_eq!(said, wanted);
    }
}
