//! What the commands that plan motions share: the analysis they plan over, and how plans are shown.

use super::away::Away;
use super::budget;
use super::queries::Labels;
use super::route;
use super::timing;
use super::watch::watched;
use crate::failure::{Answer, Failure};
use crate::output::{FORMAT_VERSION, Format, ShownArgs, brief, json, note};
use aspecta::aspect::{Analysis, Options, analyze};
use aspecta::kinematics::WorkingMode;
use aspecta::motion::crossing::Crossing;
use aspecta::motion::explore::{self, Effort, NoWay};
use aspecta::motion::modes::{Configuration, NoRoute, Route, check_ends};
use aspecta::motion::plan::{PlanOptions, Planner, Refusal};
use aspecta::motion::time::{Waypoint, trajectory};
use aspecta::motion::{PathCheck, ProfilePoint};
use aspecta::paving::{Budget, Stop};
use aspecta::robot::Robot;
use aspecta_view::{Motion, file};
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;

/// How the robot is analysed before anything is planned.
#[derive(Args)]
pub struct Analysing {
    /// When to stop telling the aspects apart, as for `analyze` [default: depth=11 for 2 coordinates, depth=7 for 3]
    #[arg(long, value_parser = budget::parse, allow_hyphen_values = true)]
    budget: Option<Budget>,
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
}

impl Analysing {
    /// The aspects of a robot, or of some of its modes (none: all), and what `work` makes of them.
    pub fn with<T>(
        &self,
        robot: &Robot,
        modes: &[WorkingMode],
        work: impl FnOnce(&Analysis, &aspecta::paving::Control<'_>) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let budget = self.budget.unwrap_or_else(|| budget::coarse(robot.dof()));
        // In the plane all modes cost nothing to speak of, and aspects then have the numbers of `analyze`.
        let modes = if robot.dof() == 2 { &[] } else { modes };
        let options = Options { budget, modes: modes.to_vec(), ..Options::default() };
        watched(self.threads, |control| {
            let analysis = analyze(robot, &options, control)?;
            if analysis.run.stop == Stop::Cancelled {
                note("interrupted: what follows rests on the aspects found so far");
            }
            work(&analysis, control)
        })?
    }
}

/// Samples of a roadmap that is to join given poses, if no number is given.
const SAMPLES: u32 = 20_000;

impl Planning {
    /// What the ends of a motion alone tell, which is told before aspects are looked for: why there is none. For robots that are no
    /// free bodies.
    pub fn refused(
        &self,
        robot: &Robot,
        [start, goal]: [Configuration<'_>; 2],
        through: bool,
        options: &PlanOptions,
    ) -> Result<Option<Planned>, Failure> {
        self.paved(robot)?;
        let refusal = robot.slice(&[]).ok().and_then(|window| {
            if through {
                return check_ends(robot, &window, [start, goal]).err();
            }
            let ends = [start.pose, goal.pose];
            Planner::check_ends(robot, &window, start.mode, ends, options).err().map(NoRoute::from)
        });
        Ok(refusal.map(|refusal| Planned { result: Err(refusal), page: None }))
    }

    /// How a robot that is no free body is analysed.
    pub fn paved(&self, robot: &Robot) -> Result<&Analysing, Failure> {
        match self.samples {
            None => Ok(&self.analysing),
            Some(samples) => Err(Failure::Input(format!(
                "--samples {samples}: `{}` is no free body, its aspects are paved with boxes (--budget)",
                robot.name
            ))),
        }
    }

    /// What `work` makes of a free body, with the effort its roadmaps may take.
    pub fn explore<T>(
        &self,
        work: impl FnOnce(&Effort, &aspecta::paving::Control<'_>) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let effort = budget::effort(self.analysing.budget, self.samples.unwrap_or(SAMPLES))?;
        watched(self.analysing.threads, |control| work(&effort, control))?
    }
}

/// The path over a roadmap of a free body, or why there is none.
///
/// # Errors
/// [`Failure::Explore`].
pub fn plan_over_roadmap(
    robot: &Robot,
    mode: WorkingMode,
    ends: [&[f64]; 2],
    options: &PlanOptions,
    (effort, control): (&Effort, &aspecta::paving::Control<'_>),
) -> Result<Result<Route, NoRoute>, Failure> {
    match explore::plan(robot, mode, ends, options, effort, control) {
        Ok(plan) => Ok(Ok(plan.into())),
        Err(NoWay::Refused(refusal)) => Ok(Err(refusal.into())),
        Err(NoWay::Robot(error)) => Err(error.into()),
    }
}

/// What kind of path is wanted.
#[derive(Args)]
struct Wishes {
    /// How much nearness to singularities counts: a unit of length costs c^-W, c being the smaller of the normalised |det A| and the
    /// |B_jj|/max. 0: the shortest path; 8: as good as only the least clearance
    #[arg(long, value_name = "W", default_value_t = 1.0, allow_negative_numbers = true)]
    weight: f64,
    #[command(flatten)]
    away: Away,
}

impl Planning {
    /// What kind of path is wanted; that the directory of `--out` can be written to is seen to before the work begins.
    pub fn options(&self) -> Result<PlanOptions, Failure> {
        if let Some(directory) = &self.moving.out {
            file::writable(directory).map_err(Failure::in_directory(directory))?;
        }
        self.wishes.options()
    }
}

impl Wishes {
    /// As the library takes them.
    fn options(&self) -> Result<PlanOptions, Failure> {
        if !(self.weight >= 0.0 && self.weight <= 64.0) {
            return Err(Failure::Input(format!("--weight {}: give a number from 0 to 64", self.weight)));
        }
        Ok(PlanOptions { weight: self.weight, margins: self.away.margins()? })
    }
}

#[derive(Serialize)]
struct Document<'a> {
    format_version: u32,
    robot: &'a str,
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

/// The motion to be written besides.
#[derive(Args)]
pub struct Moving {
    /// Write the motion under joint limits to this CSV file: time, pose, joints, their speeds and accelerations. It needs --speed and --acceleration. The robot rests at each
    /// waypoint, but not where a leg changes its posture
    #[arg(long, value_name = "FILE", requires = "speed", requires = "acceleration")]
    trajectory: Option<PathBuf>,
    /// The greatest speed of the joints: one number for all, or one a joint
    #[arg(long, value_name = "V[,V…]", requires = "trajectory", allow_hyphen_values = true)]
    speed: Option<String>,
    /// The greatest acceleration of the joints: one number for all, or one a joint
    #[arg(long, value_name = "A[,A…]", requires = "trajectory", allow_hyphen_values = true)]
    acceleration: Option<String>,
    /// Rows a second
    #[arg(long, value_name = "HZ", default_value_t = 100.0)]
    rate: f64,
    /// Write motion.html into this directory: the robot moving, its aspect and the determinants together
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// What every command that plans is told.
#[derive(Args)]
pub struct Planning {
    #[command(flatten)]
    wishes: Wishes,
    #[command(flatten)]
    pub moving: Moving,
    #[command(flatten)]
    analysing: Analysing,
    /// Free bodies are not analysed but explored by a roadmap: how many poses it draws at most [default: 20000]. A --budget is then a time
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    samples: Option<u32>,
    #[command(flatten)]
    pub shown: ShownArgs,
}

/// What came of planning.
pub struct Planned {
    /// The route, or why there is none.
    pub result: Result<Route, NoRoute>,
    /// The page that plays it, if it was asked for.
    pub page: Option<String>,
}

impl Moving {
    /// The result with the page that plays it, if that is wanted: with the aspects that were analysed.
    pub fn film(
        &self,
        robot: &Robot,
        analysis: Option<&Analysis>,
        result: Result<Route, NoRoute>,
    ) -> Planned {
        let route = result.as_ref().ok().filter(|_| self.out.is_some());
        let page = route.map(|route| {
            let pieces = route.pieces(robot);
            let mut motion = Motion::new(robot);
            if let Some(analysis) = analysis {
                motion = motion.within(analysis);
            }
            for samples in pieces.iter().flat_map(|piece| piece.samples.chunk_by(|a, b| a.mode == b.mode)) {
                motion = motion.then(samples[0].mode, &profile(samples));
            }
            motion.page()
        });
        Planned { result, page }
    }

    /// Writes what was asked for, and says so.
    fn write(&self, robot: &Robot, route: &Route, degrees: bool) -> Result<Option<String>, Failure> {
        let (Some(path), Some(speed), Some(acceleration)) =
            (&self.trajectory, &self.speed, &self.acceleration)
        else {
            return Ok(None);
        };
        timing::check_rate(self.rate)?;
        let limits = timing::limits(robot, speed, acceleration, degrees)?;
        let motion = trajectory(&route.pieces(robot), &limits)?;
        timing::check_length(&motion, self.rate)?;
        let written = timing::write("--trajectory", path, robot, &motion, self.rate)?;
        let (time, strays) =
            (brief(motion.total_time()), Labels::joints(robot, degrees).sentence(motion.path_error()));
        Ok(Some(format!("{written}\ntotal time: {time} s; joints stray from the plan by about {strays}")))
    }
}

/// Samples as the page of a motion takes them, which computes the determinants itself.
fn profile(samples: &[Waypoint]) -> Vec<ProfilePoint> {
    let last = samples.len().saturating_sub(1).max(1) as f64;
    let point = |(k, at): (usize, &Waypoint)| ProfilePoint {
        segment: 1,
        t: k as f64 / last,
        pose: at.pose.clone(),
        q: at.q.clone(),
        mode: at.mode,
        relative_det_a: 0.0,
        relative_b: Vec::new(),
    };
    samples.iter().enumerate().map(point).collect()
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
    let mut document = Document {
        format_version: FORMAT_VERSION,
        robot: name,
        route: None,
        checks: Vec::new(),
        refusal: None,
    };
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
            let checks = route::checks(robot, route)?;
            let crossed = |c: &Crossing| c.is_proved(robot, route.stretches[0].margins);
            let is_proved = checks.iter().all(PathCheck::is_sound) && route.crossings.iter().all(crossed);
            let mut written = moving.write(robot, route, shown.deg)?.into_iter().collect::<Vec<_>>();
            if let (Some(directory), Some(page)) = (&moving.out, &planned.page) {
                let path =
                    file::put(directory, "motion.html", page).map_err(Failure::in_directory(directory))?;
                written.push(format!("motion: {}", path.display()));
            }
            match format {
                Format::Json => {
                    (document.route, document.checks) = (Some(route), checks);
                    json(out, &document)?;
                }
                Format::Csv => route::print_csv(out, robot, route)?,
                Format::Table => route::print_table(out, robot, route, &checks, is_proved, shown.deg)?,
            }
            for line in written {
                if format == Format::Table { writeln!(out, "{line}")? } else { note(&line) }
            }
            Ok(Answer::from(is_proved))
        }
    }
}

/// Which option may help.
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
