//! `aspecta follow`: one solution along a stream, a line answered as soon as it is read.

use crate::args::format::ShownArgs;
use crate::args::help::help;
use crate::args::robot::RobotArg;
use crate::failure::{Answer, Failure};
use crate::input::{self, Columns, Row, Rows};
use crate::output::{FORMAT_VERSION, Format, Labels, exact, json_line, note};
use crate::show::beyond::names;
use aspecta::kinematics::WorkingMode;
use aspecta::motion::follow::{Follower, InverseFollower, JointStep, Refusal, Step};
use aspecta::num::turned_to;
use aspecta::robot::{GREATEST, Robot};
use aspecta_view::words::count;
use clap::Args;
use serde::Serialize;
use std::f64::consts::PI;
use std::io::Write;

/// Arguments of `follow`.
#[derive(Args)]
#[command(mut_args(help("deg", "Angles of the input and of what people read are in degrees")))]
#[command(after_help = "\
The first line must belong to the pose: it is proved which of its solutions is meant. Every further line is \
joined to the one before by a straight segment of joint vectors, and the pose printed is proved to be the end of the solution curve \
that starts at the last pose: no jump to another solution, no parallel singularity on the way. A line for which that is not proved \
is refused, and the next is taken from where the robot was. Angles are real numbers: they go on past 180 degrees.\n\
With --inverse the lines are poses, and the joint vector printed is the one of the mode, its angles continuous.")]
pub struct Follow {
    #[command(flatten)]
    robot: RobotArg,
    #[command(flatten)]
    start: Start,
    /// The lines are poses: follow the inverse solution of --mode
    #[arg(long, requires = "mode", conflicts_with = "pose")]
    inverse: bool,
    /// A CSV file, one joint vector (or pose) a line; `-` reads stdin
    #[arg(long, value_name = "CSV", default_value = "-")]
    file: String,
    /// Turn the angles of each line by full turns to be next to those of the line before: after 179 degrees -179 goes
    /// on by 2 instead of back by 358
    #[arg(long)]
    unwrap: bool,
    #[command(flatten)]
    shown: ShownArgs,
}

#[derive(Args)]
#[group(required = true, multiple = false)]
struct Start {
    /// The pose that the first joint vector means, at least roughly
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    pose: Option<String>,
    /// With --inverse: the working mode, such as `+-`
    #[arg(long, allow_hyphen_values = true, requires = "inverse")]
    mode: Option<String>,
}

/// The answer to one line of input. JSON has one such object a line.
#[derive(Serialize)]
struct Record<'a> {
    format_version: u32,
    line: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pose: Option<&'a [f64]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    q: Option<&'a [f64]>,
    #[serde(flatten)]
    outcome: Outcome,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Outcome {
    Certified {
        mode: WorkingMode,
        #[serde(skip_serializing_if = "Option::is_none")]
        mode_kept: Option<bool>,
        #[serde(skip_serializing_if = "Option::is_none")]
        regular: Option<bool>,
        within_limits: bool,
        beyond: Vec<String>,
        stretches: u32,
        #[serde(skip_serializing_if = "Option::is_none")]
        length_error: Option<f64>,
        #[serde(skip_serializing_if = "Option::is_none")]
        angle_error: Option<f64>,
    },
    Refused {
        refused: Refusal,
        message: String,
    },
}

/// Which problem is followed.
enum Any {
    Direct(Box<Follower>),
    Inverse(Box<InverseFollower>),
}

impl Follow {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = self.robot.load()?;
        let (pose, joints) = (Columns::pose(&robot), Columns::joints(&robot));
        let given = self
            .start
            .pose
            .as_deref()
            .map(|p| input::list("--pose", p, &pose, self.shown.deg))
            .transpose()?;
        let mode = self.start.mode.as_deref().map(|m| input::mode(&robot, m)).transpose()?;
        let layouts = [if self.inverse { pose } else { joints }];
        let mut rows = Rows::open(&self.file, &layouts, self.shown.deg)?.unbounded();
        let mut printer = Printer::new(&robot, self.inverse, self.shown.format(), self.shown.deg);
        let mut follower: Option<Any> = None;
        let mut turns = Turns { unwrap: self.unwrap, warned: false, last: Vec::new() };
        let (mut steps, mut refused, mut doubtful) = (0, 0, 0);
        while let Some(row) = rows.next() {
            let mut row = row?;
            turns.next(&mut row, &layouts[0]);
            let follower = match &mut follower {
                Some(follower) => follower,
                None => {
                    let started = Any::start(&robot, given.as_deref(), mode, &row);
                    let started = started.map_err(|e| rows.at(row.line, e))?;
                    printer.heading(out)?;
                    follower.insert(started)
                }
            };
            let (found, mut outcome) = match follower.step(&row) {
                Err(e) => (None, Outcome::Refused { refused: e, message: e.to_string() }),
                Ok((found, outcome)) => (Some(found), outcome),
            };
            if let Outcome::Certified { within_limits: false, mode, beyond, .. } = &mut outcome {
                let pose = if self.inverse { Some(&row.values) } else { found.as_ref() };
                *beyond = pose.map_or(Vec::new(), |pose| names(&robot, pose, *mode));
            }
            steps += 1;
            match found {
                Some(_) => turns.last.clone_from(&row.values),
                None => refused += 1,
            }
            doubtful += usize::from(matches!(outcome, Outcome::Certified { regular: Some(false), .. }));
            printer.print(out, &row, found.as_deref(), outcome)?;
            out.flush()?;
        }
        printer.ending(out, steps, refused, doubtful)?;
        Ok(Answer::from(refused == 0))
    }
}

impl Any {
    /// At the first row.
    fn start(
        robot: &Robot,
        pose: Option<&[f64]>,
        mode: Option<WorkingMode>,
        row: &Row,
    ) -> Result<Self, aspecta::motion::follow::StartError> {
        Ok(match mode {
            Some(mode) => Self::Inverse(Box::new(InverseFollower::new(robot, &row.values, mode)?)),
            None => Self::Direct(Box::new(Follower::new(robot, pose.unwrap_or_default(), &row.values)?)),
        })
    }

    fn step(&mut self, row: &Row) -> Result<(Vec<f64>, Outcome), Refusal> {
        match self {
            Self::Direct(follower) => {
                let step = follower.step(&row.values)?;
                let Step { mode, mode_kept, within_limits, length_error, angle_error, stretches, .. } = step;
                let outcome = Outcome::Certified {
                    mode,
                    mode_kept: Some(mode_kept),
                    regular: None,
                    within_limits,
                    beyond: Vec::new(),
                    stretches,
                    length_error: Some(length_error),
                    angle_error: Some(angle_error),
                };
                Ok((step.pose().to_vec(), outcome))
            }
            Self::Inverse(follower) => {
                let step = follower.step(&row.values)?;
                let JointStep { regular, within_limits, stretches, .. } = step;
                let outcome = Outcome::Certified {
                    mode: follower.mode(),
                    mode_kept: None,
                    regular: Some(regular),
                    within_limits,
                    beyond: Vec::new(),
                    stretches,
                    length_error: None,
                    angle_error: None,
                };
                Ok((step.q().to_vec(), outcome))
            }
        }
    }
}

/// Prints line by line.
struct Printer {
    inverse: bool,
    format: Format,
    found: Labels,
    names: Vec<String>,
}

impl Printer {
    fn new(robot: &Robot, inverse: bool, format: Format, degrees: bool) -> Self {
        let (pose, joints) = (Columns::pose(robot), Columns::joints(robot));
        let found = if inverse { Labels::joints(robot, degrees) } else { Labels::pose(robot, degrees) };
        Self { inverse, format, found, names: pose.and(&joints).names }
    }

    fn heading(&self, out: &mut dyn Write) -> Result<(), Failure> {
        if self.format == Format::Csv {
            let kept = if self.inverse { "regular" } else { "mode_kept" };
            let names = self.names.join(",");
            writeln!(
                out,
                "line,{names},mode,{kept},within_limits,stretches,refused,proved,singular_at,distance"
            )?;
        }
        Ok(())
    }

    fn print(
        &mut self,
        out: &mut dyn Write,
        row: &Row,
        found: Option<&[f64]>,
        outcome: Outcome,
    ) -> Result<(), Failure> {
        let given = Some(row.values.as_slice());
        let (pose, q) = if self.inverse { (given, found) } else { (found, given) };
        let record = Record { format_version: FORMAT_VERSION, line: row.line, pose, q, outcome };
        match self.format {
            Format::Json => json_line(out, &record)?,
            Format::Csv => writeln!(out, "{}", self.csv(&record))?,
            Format::Table => match (&record.outcome, found) {
                (Outcome::Certified { mode, mode_kept, regular, beyond, .. }, Some(found)) => {
                    let kept = if *mode_kept == Some(false) { ", a leg may have been singular" } else { "" };
                    let met = if *regular == Some(false) { ", det A may have vanished" } else { "" };
                    let limits = match beyond.as_slice() {
                        [] => String::new(),
                        beyond => format!(", beyond limits: {}", beyond.join(", ")),
                    };
                    let found = self.found.sentence(found);
                    writeln!(out, "{:>6}  {found}  mode {mode}{kept}{met}{limits}", row.line)?;
                }
                (Outcome::Refused { message, .. }, _) => {
                    writeln!(out, "{:>6}  refused: {message}", row.line)?;
                }
                _ => {}
            },
        }
        Ok(())
    }

    fn csv(&self, record: &Record) -> String {
        let numbers = |values: Option<&[f64]>| match values {
            Some(values) => values.iter().map(|x| exact(*x)).collect::<Vec<_>>().join(","),
            None => ",".repeat(self.names.len() / 2 - 1),
        };
        let vectors = format!("{},{},{}", record.line, numbers(record.pose), numbers(record.q));
        match &record.outcome {
            Outcome::Certified { mode, mode_kept, regular, within_limits, stretches, .. } => {
                let kept = mode_kept.or(*regular).unwrap_or_default();
                format!("{vectors},{mode},{kept},{within_limits},{stretches},,,,")
            }
            Outcome::Refused { refused, .. } => {
                let (name, proved, singular_at, distance) = match *refused {
                    Refusal::Parallel { proved, singular_at, distance } => {
                        ("parallel", proved, Some(singular_at), distance)
                    }
                    Refusal::Serial { proved, singular_at, distance, .. } => {
                        ("serial", proved, Some(singular_at), distance)
                    }
                    Refusal::TooLong { proved, distance } => ("too-long", proved, None, distance),
                    Refusal::Input(_) => ("input", 0.0, None, f64::NAN),
                };
                let singular_at = singular_at.map(exact).unwrap_or_default();
                format!("{vectors},,,,,{name},{},{singular_at},{}", exact(proved), exact(distance))
            }
        }
    }

    fn ending(
        &self,
        out: &mut dyn Write,
        steps: usize,
        refused: usize,
        doubtful: usize,
    ) -> Result<(), Failure> {
        if self.format == Format::Table {
            let (lines, certified) = (count(steps, "line", "lines"), steps - refused - doubtful);
            let open = if doubtful == 0 {
                String::new()
            } else {
                format!(", {doubtful} in the working mode, but perhaps through det A = 0")
            };
            writeln!(out, "{lines}: {certified} certified{open}, {refused} refused")?;
        }
        Ok(())
    }
}

/// Angles from one line to the next.
struct Turns {
    unwrap: bool,
    warned: bool,
    /// The last line that was not refused.
    last: Vec<f64>,
}

impl Turns {
    /// Turns the angles of a row to be next to those of the last one, or warns if one jumps by more than half a turn.
    fn next(&mut self, row: &mut Row, columns: &Columns) {
        for (k, last) in self.last.iter().enumerate().filter(|(k, _)| columns.angles[*k]) {
            let near = turned_to(row.values[k], *last);
            if self.unwrap && row.values[k].abs() < GREATEST {
                row.values[k] = near;
            } else if !self.unwrap && (row.values[k] - last).abs() > PI && !self.warned {
                self.warned = true;
                note(&format!(
                    "warning: line {}: {} jumps by {:.1} degrees; to go on by {:.1} instead, give --unwrap",
                    row.line,
                    columns.names[k],
                    (row.values[k] - last).to_degrees(),
                    (near - last).to_degrees()
                ));
            }
        }
    }
}
