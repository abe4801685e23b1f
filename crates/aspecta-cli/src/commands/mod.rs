//! The subcommands, one file each: what they are given (`args`), what several of them do (`work`) and how
//! they show it (`show`) is next door.

mod analyze;
mod assembly;
mod check;
mod check_path;
mod completions;
mod cusps;
mod domains;
mod explore;
mod export;
mod fk;
mod follow;
mod ik;
mod locate;
mod modes;
mod plan;
mod robots;
mod schema;
mod state;
mod time;
mod traverse;
mod verify;

use crate::failure::{Answer, Failure};
use clap::Subcommand;
use std::io::Write;

/// What `aspecta` can do.
#[derive(Subcommand)]
pub enum Command {
    /// Working modes and generalized aspects of a robot, with certified bounds on their number
    Analyze(analyze::Analyze),
    /// Basic regions and uniqueness domains of an aspect: where a joint vector means one pose
    Domains(domains::Domains),
    /// In which aspect, basic region and uniqueness domains a pose lies, or the poses of a joint vector
    Locate(locate::Locate),
    /// Check a certificate of the number of aspects, independently of what computed it
    Verify(verify::Verify),
    /// All inverse solutions of a pose, one per working mode
    Ik(ik::Ik),
    /// All direct solutions of a joint vector
    Fk(fk::Fk),
    /// Jacobians, working mode and nearness to singularities of a configuration
    State(state::State),
    /// Cusps: where three direct solutions meet, all of a slice or curves through the whole robot
    Cusps(cusps::Cusps),
    /// Prove that a path meets no singularity, or find where it does
    CheckPath(check_path::CheckPath),
    /// Plan a motion without singularities, certified, within an aspect or through changes of working mode
    Plan(plan::Plan),
    /// The poses of a joint vector by aspects, and how to change from one to another without a singularity
    Assembly(assembly::Assembly),
    /// Which aspects are joined by legs that change their postures: the graph of working-mode changes
    Modes(modes::Modes),
    /// The pose space of a free body (six coordinates) by a roadmap: classes of aspects, and what is joined
    /// within them
    Explore(explore::Explore),
    /// Which aspects and uniqueness domains hold a whole set of poses: a box, a list, paths
    Traverse(traverse::Traverse),
    /// Run through a path as fast as joint speeds and accelerations allow, once it is proved to be sound
    Time(time::Time),
    /// Follow one solution along a stream of joint vectors (or poses), every step certified, as it comes
    Follow(follow::Follow),
    /// The robot as a file for another program
    Export(export::Export),
    /// List the robots of the catalogue, or show one's file
    Robots(robots::Robots),
    /// Check a robot file
    Check(check::Check),
    /// Print the JSON Schema of robot files
    Schema(schema::Schema),
    /// Print a shell's completion script
    Completions(completions::Completions),
}

impl Command {
    /// Runs it, results going to `out`.
    pub fn run(self, out: &mut dyn Write) -> Result<Answer, Failure> {
        match self {
            Self::Analyze(command) => command.run(out),
            Self::Domains(command) => command.run(out),
            Self::Locate(command) => command.run(out),
            Self::Verify(command) => command.run(out),
            Self::Ik(command) => command.run(out),
            Self::Fk(command) => command.run(out),
            Self::State(command) => command.run(out),
            Self::Cusps(command) => command.run(out),
            Self::CheckPath(command) => command.run(out),
            Self::Plan(command) => command.run(out),
            Self::Assembly(command) => command.run(out),
            Self::Modes(command) => command.run(out),
            Self::Explore(command) => command.run(out),
            Self::Traverse(command) => command.run(out),
            Self::Time(command) => command.run(out),
            Self::Follow(command) => command.run(out),
            Self::Export(command) => command.run(out),
            Self::Robots(command) => command.run(out),
            Self::Check(command) => command.run(out),
            Self::Schema(command) => command.run(out),
            Self::Completions(command) => command.run(out),
        }
    }
}
