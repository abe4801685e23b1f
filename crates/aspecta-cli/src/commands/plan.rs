//! `aspecta plan`: from one pose to another without a singularity, or the proof that there is no such way.

use crate::args::planning::Planning;
use crate::args::robot::RobotArg;
use crate::failure::{Answer, Failure};
use crate::input::{self, Columns};
use crate::show::motion;
use crate::work::planning::{plan_over_roadmap, route, without_aspects};
use aspecta::kinematics::WorkingMode;
use aspecta::motion::modes::{Configuration, NoRoute};
use aspecta::motion::plan::PlanOptions;
use aspecta::motion::traverse::PoseSet;
use aspecta::robot::{Platform, Robot};
use clap::Args;
use std::io::Write;

/// Arguments of `plan`.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Plan {
    #[command(flatten)]
    robot: RobotArg,
    /// The pose to start from: x,y | x,y,phi | x,y,z | roll,pitch,yaw | x,y,z,roll,pitch,yaw
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    from: String,
    /// The pose to go to; angles count modulo a full turn
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    to: String,
    /// The working mode, such as `+-`
    #[arg(long, allow_hyphen_values = true)]
    mode: String,
    /// The working mode to arrive in, if it is another: legs then change their postures on the way
    #[arg(long, value_name = "MODE", allow_hyphen_values = true)]
    to_mode: Option<String>,
    /// Legs may change their postures on the way although the mode is the same at both ends
    #[arg(long)]
    through_modes: bool,
    #[command(flatten)]
    planning: Planning,
}

const EXAMPLES: &str = "\
Examples:
  aspecta plan five-bar --from 4,7 --to 1,10 --mode +-
  aspecta plan five-bar --from 4,7 --to 4,7 --mode ++ --to-mode --
  aspecta plan 3-rrr --from -15.468,0.781,0.073 --to -9.902,-7.091,1.081 --mode +++ --weight 8
  aspecta plan gough-stewart --from 0.9955,-0.0511,0.0814,-2.1256,-0.0302,2.8076 --to 0.8032,-0.2960,0.5169,-2.2956,-0.1545,1.2114 --mode ------
Every segment is proved by intervals. Robots with six coordinates are planned over a roadmap (aspecta explore). With --csv the waypoints can be read by `aspecta check-path` (one mode).
Exit status: 0 planned; 1 no such path (it says whether that is proved); 2 bad input.";

impl Plan {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = self.robot.load()?;
        let options = self.planning.options()?;
        let columns = Columns::pose(&robot);
        let from = input::list("--from", &self.from, &columns, self.planning.shown.deg)?;
        let to = input::list("--to", &self.to, &columns, self.planning.shown.deg)?;
        // What does not fit the robot is told before the aspects are looked for.
        PoseSet::Poses(vec![from.clone(), to.clone()]).check(&robot)?;
        let mode = input::mode(&robot, &self.mode)?;
        let to_mode = self.to_mode.as_deref().map_or(Ok(mode), |text| input::mode(&robot, text))?;
        let through = self.through_modes || mode != to_mode;
        if robot.platform == Platform::FreeBody {
            return self.over_roadmap(out, &robot, (mode, through), [&from, &to], &options);
        }
        let ends = [Configuration { pose: &from, mode }, Configuration { pose: &to, mode: to_mode }];
        if let Some(refused) = self.planning.refused(&robot, ends, through, &options)? {
            return motion::print(out, &robot, &refused, &self.planning);
        }
        // A picture shows the aspect; else none is needed if a way is found, and of three coordinates aspects
        // take long.
        if robot.dof() == 3
            && !through
            && self.planning.moving.out.directory().is_none()
            && let Some(plan) = without_aspects(&robot, [&from, &to], mode, &options)
        {
            let planned = self.planning.film(&robot, None, Ok(plan.into()))?;
            return motion::print(out, &robot, &planned, &self.planning);
        }
        let modes: &[WorkingMode] = if through { &[] } else { &[mode] };
        let planned = self.planning.paved(&robot)?.with_finer(&robot, modes, |analysis, control| {
            let result = route(analysis, ends, through, &options, control);
            let more = result.as_ref().is_err_and(NoRoute::is_of_resolution);
            Ok((self.planning.film(&robot, Some(analysis), result)?, more))
        })?;
        motion::print(out, &robot, &planned, &self.planning)
    }

    /// Plans a motion of a free body, over a roadmap.
    fn over_roadmap(
        &self,
        out: &mut dyn Write,
        robot: &Robot,
        (mode, through): (WorkingMode, bool),
        ends: [&[f64]; 2],
        options: &PlanOptions,
    ) -> Result<Answer, Failure> {
        if through {
            return Err(Failure::Input(format!(
                "`{}` is a free body: changes of working mode are not planned for it; give the same mode for both ends, without \
                 --through-modes",
                robot.name
            )));
        }
        let planned = self.planning.explore(|effort, control| {
            let result = plan_over_roadmap(robot, ends, mode, options, (effort, control))?;
            self.planning.film(robot, None, result)
        })?;
        motion::print(out, robot, &planned, &self.planning)
    }
}
