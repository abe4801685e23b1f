//! The path that `check-path` and `time` are given, checked.

use super::away::Away;
use super::robot::RobotArg;
use crate::failure::Failure;
use crate::input::{self, Columns};
use aspecta::motion::{Joined, PathCheck, PathError, PathOptions, check_joints, check_poses};
use clap::{Args, ValueEnum};

/// Which path, and what is asked of it.
#[derive(Args)]
pub struct PathArgs {
    #[command(flatten)]
    robot: RobotArg,
    /// A CSV file of poses or joint vectors, one a line; `-` reads stdin
    path: String,
    #[command(flatten)]
    from: From,
    /// What joins the lines: straight segments, a smooth spline, or nothing (then nothing is claimed between)
    #[arg(long, value_enum, default_value = "straight")]
    joined: How,
    #[command(flatten)]
    away: Away,
    /// Angles of the input and of what people read are in degrees
    #[arg(long)]
    pub deg: bool,
}

/// Where the path is.
#[derive(Args)]
#[group(required = true, multiple = true)]
struct From {
    /// The lines are poses: the working mode the robot stays in, such as `+-+`
    #[arg(long, allow_hyphen_values = true, conflicts_with_all = ["joints", "start"])]
    mode: Option<String>,
    /// The lines are joint vectors
    #[arg(long)]
    joints: bool,
    /// The lines are joint vectors: the pose that the first one means, at least roughly (not needed if it has
    /// one only)
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    start: Option<String>,
}

#[derive(Clone, Copy, ValueEnum)]
enum How {
    Straight,
    Spline,
    None,
}

impl PathArgs {
    /// Reads the path and checks it.
    pub fn check(&self) -> Result<PathCheck, Failure> {
        let robot = self.robot.load()?;
        let options = PathOptions { joined: self.joined(), margins: self.away.margins()? };
        let mode = self.from.mode.as_deref().map(|m| input::mode(&robot, m)).transpose()?;
        let (pose, joints) = (Columns::pose(&robot), Columns::joints(&robot));
        let start =
            self.from.start.as_deref().map(|s| input::list("--start", s, &pose, self.deg)).transpose()?;
        let layout = [if mode.is_some() { pose } else { joints }];
        let rows = input::rows(&self.path, &layout, self.deg)?;
        if let Some(mode) = mode
            && let Some((line, other)) = rows.iter().find_map(|row| {
                let other = row.mode.as_ref().filter(|other| **other != mode.to_string())?;
                Some((row.line, other))
            })
        {
            return Err(Failure::Input(format!(
                "{}:{line}: this line is in working mode {other}, but --mode is {mode}: check the lines of each mode by themselves",
                if self.path == "-" { "stdin" } else { &self.path }
            )));
        }
        let lines: Vec<_> = rows.into_iter().map(|row| row.values).collect();
        match mode {
            Some(mode) => Ok(check_poses(&robot, &lines, mode, &options)?),
            None => check_joints(&robot, &lines, start.as_deref(), &options).map_err(with_advice),
        }
    }

    pub fn joined(&self) -> Joined {
        match self.joined {
            How::Straight => Joined::Straight,
            How::Spline => Joined::Spline,
            How::None => Joined::None,
        }
    }
}

fn with_advice(error: PathError) -> Failure {
    match error {
        PathError::WhichSolution { .. } => Failure::Input(format!("{error}\ngive it with --start")),
        PathError::Unjoined => Failure::Input(format!("--joined none: {error}")),
        _ => error.into(),
    }
}
