//! Options of every command that plans motions.

use super::away::Away;
use super::budget;
use super::format::ShownArgs;
use super::help::help;
use super::out::OutDir;
use super::rate::Rate;
use super::threads::Threads;
use crate::failure::Failure;
use aspecta::motion::plan::PlanOptions;
use aspecta::paving::Budget;
use clap::Args;
use std::path::PathBuf;

/// How the robot is analysed before anything is planned.
#[derive(Args)]
pub struct Analysing {
    /// When to stop telling the aspects apart, as for `analyze`; half of a time is for that, the rest for what
    /// follows [default: depth=11 for 2 coordinates, depth=7 for 3; two deeper where a plan is not found]
    #[arg(long, value_parser = budget::parse, allow_hyphen_values = true)]
    pub budget: Option<Budget>,
    #[command(flatten)]
    pub threads: Threads,
}

/// What kind of path is wanted.
#[derive(Args)]
struct Wishes {
    /// How much nearness to singularities counts: a unit of length costs c^-W, c being the smaller of the
    /// normalised |det A| and the |B_jj|/max. 0: the shortest path; 8: as good as only the least clearance.
    /// Above 1 the whole aspect is looked at, which takes longer
    #[arg(long, value_name = "W", default_value_t = 1.0, allow_negative_numbers = true)]
    weight: f64,
    #[command(flatten)]
    away: Away,
}

impl Planning {
    /// Returns the kind of path that is wanted. Whether the directory of `--out` can be written to is checked
    /// before the work begins.
    pub fn options(&self) -> Result<PlanOptions, Failure> {
        self.moving.out.check()?;
        self.wishes.options()
    }
}

impl Wishes {
    /// Returns the wishes as the library takes them.
    fn options(&self) -> Result<PlanOptions, Failure> {
        if !(self.weight >= 0.0 && self.weight <= 64.0) {
            return Err(Failure::Input(format!("--weight {}: give a number from 0 to 64", self.weight)));
        }
        Ok(PlanOptions { weight: self.weight, margins: self.away.margins()? })
    }
}

const OUT: &str = "\
    Write motion.html into this directory: the robot moving, its aspect and the determinants \
    together";

/// The motion to be written besides.
#[derive(Args)]
#[command(mut_args(help("out", OUT)))]
pub struct Moving {
    /// Write the motion under joint limits to this CSV file: time, pose, joints, their speeds and
    /// accelerations. It needs --speed and --acceleration. The robot rests at each waypoint, but not where a
    /// leg changes its posture
    #[arg(long, value_name = "FILE", requires = "speed", requires = "acceleration")]
    pub trajectory: Option<PathBuf>,
    /// The greatest speed of the joints: one number for all, or one a joint
    #[arg(long, value_name = "V[,V…]", requires = "trajectory", allow_hyphen_values = true)]
    pub speed: Option<String>,
    /// The greatest acceleration of the joints: one number for all, or one a joint
    #[arg(long, value_name = "A[,A…]", requires = "trajectory", allow_hyphen_values = true)]
    pub acceleration: Option<String>,
    #[command(flatten)]
    pub rate: Rate,
    #[command(flatten)]
    pub out: OutDir,
}

/// What every command that plans is told.
#[derive(Args)]
pub struct Planning {
    #[command(flatten)]
    wishes: Wishes,
    #[command(flatten)]
    pub moving: Moving,
    #[command(flatten)]
    pub analysing: Analysing,
    /// Free bodies are not analysed but explored by a roadmap: how many poses it draws at most [default:
    /// 20000]. A --budget is then a time
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub samples: Option<u32>,
    #[command(flatten)]
    pub shown: ShownArgs,
}
