//! `aspecta time`: a path as a motion under joint speed and acceleration limits.

use crate::args::format::FormatArgs;
use crate::args::path::PathArgs;
use crate::args::rate::Rate;
use crate::failure::{Answer, Failure};
use crate::output::{About, Format, Labels, json, note, number};
use crate::work::timing;
use aspecta::motion::time::{Limited, Sampled, Trajectory, trajectory};
use aspecta::motion::{Joined, Obstacle, PathCheck};
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Arguments of `time`.
#[derive(Args)]
#[command(after_help = "\
The path is checked first, as `aspecta check-path` does, and refused (exit status 1) unless it is proved to be sound. Then every joint moves \
as fast as its speed and acceleration allow, from rest to rest: the robot stops at each line of a path of straight segments, \
and goes through those of a spline. Limits are in the units of the joints, per second and per second squared; with --deg those of angles are in degrees.\n\
Timing is numerical. Limits hold at every time; the whole is the fastest but for about one part in a thousand.\n\n\
  aspecta time 3-rrr path.csv --mode +++ --speed 2 --acceleration 10 --rate 500 --out motion.csv\n\
  aspecta time five-bar joints.csv --start 4,7 --joined spline --speed 1,1.5 --acceleration 4")]
pub struct Time {
    #[command(flatten)]
    path: PathArgs,
    /// The greatest speed of the joints: one number for all, or one a joint
    #[arg(long, value_name = "V[,V…]", allow_hyphen_values = true)]
    speed: String,
    /// The greatest acceleration of the joints: one number for all, or one a joint
    #[arg(long, value_name = "A[,A…]", allow_hyphen_values = true)]
    acceleration: String,
    #[command(flatten)]
    rate: Rate,
    /// Write the motion to this CSV file
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    about: About<'a>,
    mode: String,
    sound: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    obstacle: Option<&'a Obstacle>,
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    motion: Option<Sampled>,
}

/// The most segments, each from rest to rest, on a grid of its own.
const MOST_SEGMENTS: usize = 20_000;

/// Whether a robot that stops at each line has a number of stops that makes sense.
fn check_stops(check: &PathCheck) -> Result<(), Failure> {
    let segments = check.pieces().len();
    let many = || {
        Failure::Input(format!(
            "the robot would stop on {segments} segments, more than {MOST_SEGMENTS}; to go through them, give --joined spline"
        ))
    };
    (segments <= MOST_SEGMENTS).then_some(()).ok_or_else(many)
}

impl Time {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        self.rate.check()?;
        if self.path.joined() == Joined::None {
            return Err(Failure::Input(
                "--joined none: a motion needs to know what lies between the lines".into(),
            ));
        }
        let check = self.path.check()?;
        check_stops(&check)?;
        let robot = &check.robot;
        let limits = timing::limits(robot, &self.speed, &self.acceleration, self.path.deg)?;
        if !check.is_sound() {
            return self.refuse(out, &check);
        }
        let motion = trajectory(&check.pieces(), &limits)?;
        timing::check_length(&motion, self.rate.rate)?;
        let write = |path: &Path| timing::write("--out", path, robot, &motion, self.rate.rate);
        let written = self.out.as_deref().map(write).transpose()?;
        let format = self.format.beside(self.path.deg);
        match format {
            Format::Json => json(out, &self.document(&check, Some(&motion)))?,
            Format::Csv => timing::rows(out, robot, &motion, self.rate.rate)?,
            Format::Table => self.summary(out, &check, &motion)?,
        }
        if let Some(written) = written {
            format.say(out, &written)?;
        }
        Ok(Answer::Yes)
    }

    fn refuse(&self, out: &mut dyn Write, check: &PathCheck) -> Result<Answer, Failure> {
        if self.format.beside(false) == Format::Json {
            json(out, &self.document(check, None))?;
        }
        let why = check.obstacle.as_ref().map_or(String::new(), |o| format!(": {}", check.in_words(o)));
        note(&format!("the path is not proved to be sound{why}\n`aspecta check-path` says more"));
        Ok(Answer::No)
    }

    fn document<'a>(&self, check: &'a PathCheck, motion: Option<&Trajectory>) -> Document<'a> {
        Document {
            about: About::of(&check.robot),
            mode: check.mode.to_string(),
            sound: check.is_sound(),
            obstacle: check.obstacle.as_ref(),
            motion: motion.map(|motion| motion.sampled(self.rate.rate)),
        }
    }

    fn summary(&self, out: &mut dyn Write, check: &PathCheck, motion: &Trajectory) -> Result<(), Failure> {
        let joints = Labels::joints(&check.robot, self.path.deg);
        writeln!(out, "{}", check.heading())?;
        writeln!(out, "sound             yes, certified")?;
        let stops = check.pieces().len();
        let rests = if stops == 1 { "from rest to rest" } else { "from rest to rest on each segment" };
        writeln!(out, "total time        {} s, {rests}", number(motion.total_time()))?;
        for (k, binding) in motion.bindings().iter().take(3).enumerate() {
            let what = match binding.limit {
                Limited::Speed => "speed",
                Limited::Acceleration => "acceleration",
            };
            let share = 100.0 * binding.share;
            let name = if k == 0 { "what limits it" } else { "" };
            writeln!(out, "{name:<18}the {what} of joint {}, {share:.0} % of the time", binding.joint)?;
        }
        writeln!(out, "strays by about   {}", joints.sentence(motion.path_error()))?;
        Ok(())
    }
}
