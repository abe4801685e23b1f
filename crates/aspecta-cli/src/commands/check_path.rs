//! `aspecta check-path`: whether a path meets a singularity, or comes too near to one.

use crate::args::format::FormatArgs;
use crate::args::help::help;
use crate::args::out::OutDir;
use crate::args::path::PathArgs;
use crate::failure::{Answer, Failure};
use crate::input::Columns;
use crate::output::{About, Format, exact, json};
use aspecta::motion::PathCheck;
use aspecta::text::PathSummary;
use aspecta_view::{Motion, figure_11, file};
use clap::Args;
use serde::Serialize;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Arguments of `check-path`.
#[derive(Args)]
#[command(mut_args(help("out", OUT)))]
#[command(after_help = "\
A path of poses is checked in a working mode, a path of joint vectors from the pose on in which it starts. What is said holds \
between the lines of the file too: it is proved by interval arithmetic, or said to be undecided.\n\
A spline passes through all lines, with continuous curvature, over the lengths of its chords (lengths divided by the robot's \
characteristic length, angles in radians); its ends are not-a-knot. Angles are real numbers: they go on past 180 degrees, and \
a step from 179 to -179 degrees is nearly a full turn.\n\
The clearances are the least |det A| (in the paper's unit), |det Â| (moments divided by the greatest arm of the \
platform and then rows scaled to length 1: 1 at most) and |B_jj| as a share of the greatest, along the path or up to where it meets a singularity.\n\n\
  aspecta check-path 3-rrr path.csv --mode +++\n\
  aspecta check-path 3-rrr path.csv --mode +++ --joined spline --avoid 0.05,0.1\n\
  aspecta check-path 3-rrr joints.csv --start -15.468,0.781,0.073 --csv")]
pub struct CheckPath {
    #[command(flatten)]
    path: PathArgs,
    #[command(flatten)]
    out: OutDir,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    about: About<'a>,
    #[serde(flatten)]
    check: &'a PathCheck,
}

const OUT: &str = "\
    Draw det A and the B_jj along the path, and the robot moving along it: figure11.svg and \
    motion.html in this directory";

impl CheckPath {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let check = self.path.check()?;
        let draw = |directory: &Path| draw(directory, &check).map_err(Failure::in_directory(directory));
        let drawn = self.out.directory().map(draw).transpose()?;
        let format = self.format.beside(self.path.deg);
        match format {
            Format::Json => {
                json(out, &Document { about: About::of(&check.robot), check: &check })?;
            }
            Format::Csv => print_profile(out, &check)?,
            Format::Table => {
                write!(out, "{}", PathSummary { check: &check, degrees: self.path.deg })?;
            }
        }
        if let Some([figure, motion]) = drawn {
            let written = format!("figure: {}\nmotion: {}", figure.display(), motion.display());
            format.say(out, &written)?;
        }
        Ok(Answer::from(check.is_sound()))
    }
}

/// Writes figure 11 and the motion into a directory.
fn draw(directory: &Path, check: &PathCheck) -> io::Result<[PathBuf; 2]> {
    let robot = &check.robot;
    let motion = Motion::new(robot).then(check.mode, &check.profile).stopped_by(check.obstacle.as_ref());
    Ok([
        file::put(directory, "figure11.svg", figure_11(robot, check, check.samples))?,
        file::put(directory, "motion.html", motion.page())?,
    ])
}

/// The path: poses, joint vectors, and figure 11, det A and the B_jj, each divided by its largest modulus.
fn print_profile(out: &mut dyn Write, check: &PathCheck) -> Result<(), Failure> {
    let robot = &check.robot;
    let mut csv = csv::Writer::from_writer(out);
    let names = Columns::pose(robot).and(&Columns::joints(robot)).names;
    let b = (1..=robot.dof()).map(|j| format!("relative_b_{j}{j}"));
    let first = ["segment", "t"].map(String::from);
    let last = ["mode".to_owned()];
    csv.write_record(first.into_iter().chain(names).chain(["relative_det_a".into()]).chain(b).chain(last))?;
    for p in &check.profile {
        let numbers =
            [&p.t].into_iter().chain(&p.pose).chain(&p.q).chain([&p.relative_det_a]).chain(&p.relative_b);
        let segment = [p.segment.to_string()];
        csv.write_record(segment.into_iter().chain(numbers.map(|x| exact(*x))).chain([p.mode.to_string()]))?;
    }
    csv.flush()?;
    Ok(())
}
