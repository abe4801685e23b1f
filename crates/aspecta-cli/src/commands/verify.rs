//! `aspecta verify`: whether a certificate proves what it claims.

use crate::args::budget;
use crate::args::format::JsonArg;
use crate::args::help::help;
use crate::args::threads::Threads;
use crate::failure::{Answer, Failure};
use crate::input;
use crate::output::{self, note};
use crate::show::facts;
use crate::work::watch::{watched, within};
use aspecta::certificate::{Certificate, CertificateError};
use aspecta::robot::{Limit, Robot, catalogue};
use aspecta::verify::verify;
use clap::Args;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Arguments of `verify`.
#[derive(Args)]
#[command(mut_args(help("json", "Print the verdict as JSON, and nothing else, on stdout")))]
pub struct Verify {
    /// The certificate
    file: PathBuf,
    /// The robot that it should be about: a name from `aspecta robots`, or the path of a robot file
    #[arg(long, value_name = "ROBOT")]
    robot: Option<String>,
    /// When to give up: a time, such as 60s or 5min
    #[arg(long, default_value = "1h", value_parser = budget::parse_time)]
    budget: Duration,
    #[command(flatten)]
    shown: JsonArg,
    #[command(flatten)]
    threads: Threads,
}

impl Verify {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let certificate = certificate(&self.file)?;
        if let Some(name) = &self.robot {
            let robot = input::robot(name)?;
            if !is_same(&robot, &certificate.robot) {
                note(&format!(
                    "not verified: `{}` is about `{}`, which is not the robot `{name}` leg by leg",
                    self.file.display(),
                    certificate.robot.name
                ));
                return Ok(Answer::No);
            }
        }
        let (verdict, in_time) = watched(self.threads, |control| {
            within(self.budget, control, |control| verify(&certificate, control))
        })?;
        if self.shown.json {
            output::json(out, &verdict)?;
        } else {
            facts::print(out, &certificate.robot)?;
            if is_namesake(&certificate.robot) {
                writeln!(out, "  this is not the `{}` of `aspecta robots`", certificate.robot.name)?;
            }
            write!(out, "{verdict}")?;
        }
        if !verdict.complete {
            let why = if in_time { "cancelled" } else { "the --budget has run out" };
            note(&format!("{why}: nothing is verified"));
        }
        Ok(Answer::from(verdict.is_verified()))
    }
}

/// The certificate in a file, which may be another kind of file.
fn certificate(path: &Path) -> Result<Certificate, Failure> {
    Certificate::load(path).map_err(|error| match error {
        CertificateError::Form(_) if is_robot_file(path) => Failure::Input(format!(
            "`{0}`: a robot file, not a certificate; `aspecta analyze {0} --certificate FILE` writes one",
            path.display()
        )),
        CertificateError::Form(_) => Failure::Input(format!(
            "`{}`: {error}; `aspecta analyze ROBOT --certificate FILE` writes certificates",
            path.display()
        )),
        other => other.into(),
    })
}

/// Whether a file that is no JSON is a robot file, by its name if it has mistakes. A pipe cannot be read again.
fn is_robot_file(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "toml")
        || path.is_file() && Robot::load(path).is_ok()
}

/// Whether a robot of the catalogue has this one's name and is another.
fn is_namesake(robot: &Robot) -> bool {
    catalogue::find(&robot.name).is_some_and(|known| !is_same(&known, robot))
}

/// Whether two robots are the same for the arithmetic, for which it does not matter by which turn a joint angle
/// is called.
fn is_same(a: &Robot, b: &Robot) -> bool {
    let legs = |robot: &Robot| {
        let mut legs = robot.legs.clone();
        for limit in legs.iter_mut().flat_map(|leg| &mut leg.limits) {
            if let Limit::ActuatorAngle { turns, .. } = limit {
                *turns = 0;
            }
        }
        legs
    };
    let shared = |robot: &Robot| {
        let mut shared = robot.rod_angles.clone();
        shared.iter_mut().for_each(|limit| limit.legs.sort_unstable());
        shared
    };
    let bodies = |robot: &Robot| (robot.bodies.clone(), robot.pairs.clone());
    (a.platform, legs(a), shared(a), bodies(a), &a.window)
        == (b.platform, legs(b), shared(b), bodies(b), &b.window)
}
