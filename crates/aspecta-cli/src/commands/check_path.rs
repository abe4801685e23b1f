//! `aspecta check-path`: whether a path of straight segments meets a singularity.

use super::queries::{Labels, det_a_unit};
use crate::failure::{Answer, Failure};
use crate::input::{self, Columns};
use crate::output::{FORMAT_VERSION, Format, FormatArgs, exact, json, note, number};
use aspecta::motion::{Obstacle, PathCheck, check_path};
use aspecta::robot::Robot;
use aspecta_cli::figure::profile::{failure, figure_11};
use aspecta_cli::file;
use aspecta_cli::report::motion::Motion;
use clap::Args;
use serde::Serialize;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Arguments of `check-path`.
#[derive(Args)]
pub struct CheckPath {
    /// Name from `aspecta robots`, or path of a robot file
    robot: String,
    /// A CSV file of poses, one a line, joined by straight segments; `-` reads stdin
    path: String,
    /// The working mode the robot stays in, such as `+-+`
    #[arg(long, allow_hyphen_values = true)]
    mode: String,
    /// Angles of the file and of what people read are in degrees
    #[arg(long)]
    deg: bool,
    /// Draw det A and the B_jj along the path, and the robot moving along it: figure11.svg and motion.html in this directory
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct Document<'a> {
    format_version: u32,
    robot: &'a str,
    #[serde(flatten)]
    check: &'a PathCheck,
}

impl CheckPath {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = input::robot(&self.robot)?;
        let mode = input::mode(&robot, &self.mode)?;
        let rows = input::rows(&self.path, &[Columns::pose(&robot)], self.deg)?;
        let poses: Vec<_> = rows.into_iter().map(|row| row.values).collect();
        let check = check_path(&robot, &poses, mode)?;
        let draw = |directory: &PathBuf| {
            draw(directory, &robot, &check, poses.len()).map_err(Failure::in_directory(directory))
        };
        let drawn = self.out.as_ref().map(draw).transpose()?;
        match self.format.format() {
            Format::Json => {
                json(out, &Document { format_version: FORMAT_VERSION, robot: &robot.name, check: &check })?;
            }
            Format::Csv => print_profile(out, &robot, &check)?,
            Format::Table => print(out, &robot, &check, poses.len(), self.deg)?,
        }
        if let Some([figure, motion]) = drawn {
            let written = format!("figure: {}\nmotion: {}", figure.display(), motion.display());
            match self.format.format() {
                Format::Table => writeln!(out, "{written}")?,
                Format::Json | Format::Csv => note(&written),
            }
        }
        Ok(Answer::from(check.singularity_free == Some(true) && check.within_limits == Some(true)))
    }
}

/// Writes figure 11 and the motion into a directory, which is created if need be.
fn draw(directory: &Path, robot: &Robot, check: &PathCheck, points: usize) -> io::Result<[PathBuf; 2]> {
    fs::create_dir_all(directory)?;
    let motion = Motion::new(robot).then(check.mode, &check.profile).stopped_by(check.obstacle.as_ref());
    Ok([
        file::put(directory, "figure11.svg", figure_11(robot, check, points))?,
        file::put(directory, "motion.html", motion.page())?,
    ])
}

/// Figure 11: det A and the B_jj along the path, each divided by its largest modulus.
fn print_profile(out: &mut dyn Write, robot: &Robot, check: &PathCheck) -> Result<(), Failure> {
    let mut csv = csv::Writer::from_writer(out);
    let names = Columns::pose(robot).and(&Columns::joints(robot)).names;
    let b = (1..=robot.dof()).map(|j| format!("relative_b_{j}{j}"));
    let first = ["segment", "t"].map(String::from);
    csv.write_record(first.into_iter().chain(names).chain(["relative_det_a".into()]).chain(b))?;
    for p in &check.profile {
        let numbers =
            [&p.t].into_iter().chain(&p.pose).chain(&p.q).chain([&p.relative_det_a]).chain(&p.relative_b);
        csv.write_record([p.segment.to_string()].into_iter().chain(numbers.map(|x| exact(*x))))?;
    }
    csv.flush()?;
    Ok(())
}

fn print(
    out: &mut dyn Write,
    robot: &Robot,
    check: &PathCheck,
    poses: usize,
    degrees: bool,
) -> Result<(), Failure> {
    let (pose, joints) = (Labels::pose(robot, degrees), Labels::joints(robot, degrees));
    writeln!(out, "{}, working mode {}, {poses} poses joined by straight segments", robot.name, check.mode)?;
    let free = match check.singularity_free {
        Some(true) => "yes, certified: det A keeps its sign and no B_jj vanishes all along",
        Some(false) => "no, certified",
        None => "undecided",
    };
    writeln!(out, "singularity-free  {free}")?;
    let within = match check.within_limits {
        Some(true) if robot.legs.iter().all(|leg| leg.limits.is_empty()) => "yes (the robot has no limits)",
        Some(true) => "yes, certified",
        Some(false) => "no, certified",
        None => "undecided",
    };
    writeln!(out, "within limits     {within}")?;
    if let Some(obstacle) = &check.obstacle {
        writeln!(out, "obstacle          {}", describe(obstacle))?;
        writeln!(out, "                  near {}", pose.sentence(&obstacle.pose))?;
    }
    let least = &check.min_abs_det_a;
    let unit = det_a_unit(robot);
    writeln!(
        out,
        "min |det A|       {}{unit}, segment {}, t = {}",
        number(least.value),
        least.segment,
        number(least.t)
    )?;
    writeln!(out, "                  at {}", pose.sentence(&least.pose))?;
    for (name, q) in ["start", "end"].iter().zip(&check.ends) {
        let q = q.as_ref().map_or("out of reach".to_owned(), |q| joints.sentence(q));
        writeln!(out, "{:<18}{q}", format!("joints, {name}"))?;
    }
    Ok(())
}

/// What fails, and where along the path.
fn describe(obstacle: &Obstacle) -> String {
    let (from, to) = obstacle.t;
    format!("{}, segment {}, t = {} … {}", failure(obstacle), obstacle.segment, number(from), number(to))
}
