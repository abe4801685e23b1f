//! `aspecta explore`: the whole pose space of a free body, by a roadmap.

use crate::args::budget;
use crate::args::format::TableArgs;
use crate::args::robot::RobotArg;
use crate::args::threads::Threads;
use crate::failure::{Answer, Failure};
use crate::input;
use crate::output::{Align, FORMAT_VERSION, Labels, Table, brief, json, note};
use crate::show::doubts::warn_of_architecture;
use crate::work::watch::watched;
use aspecta::motion::explore::{End, Exploration, ExploredClass, explore};
use aspecta::paving::Budget;
use aspecta::robot::Robot;
use aspecta_view::words::count;
use clap::Args;
use serde::Serialize;
use std::io::Write;

/// Arguments of `explore`.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub struct Explore {
    #[command(flatten)]
    robot: RobotArg,
    /// Only this working mode, such as `+--+-+`; again for several
    #[arg(long, allow_hyphen_values = true)]
    mode: Vec<String>,
    /// How many poses are drawn in each class, steps into the unknown included
    #[arg(long, value_name = "N", default_value_t = 1024, value_parser = clap::value_parser!(u32).range(1..))]
    samples: u32,
    /// When to stop, whatever the samples: a time, such as 30s or 5min
    #[arg(long, value_parser = budget::parse, allow_hyphen_values = true)]
    budget: Option<Budget>,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    shown: TableArgs,
}

const EXAMPLES: &str = "\
Examples:
  aspecta explore gough-stewart
  aspecta explore hexa --mode ------ --samples 4096
Six coordinates are too many for boxes. Poses are drawn in each class (a working mode and a sign of det A) and joined by motions.
Certified: that a pose lies in its class, that poses of one component are joined without a singularity and within limits, that classes
are apart. Numerical: how many components a class has, which is what was seen within the budget and bounds nothing.
Exit status: 0 explored; 2 bad input.";

/// Components of a class that are listed.
const LISTED: usize = 5;

#[derive(Serialize)]
struct Document<'a> {
    format_version: u32,
    #[serde(flatten)]
    found: &'a Exploration,
}

impl Explore {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = self.robot.load()?;
        let modes = input::modes(&robot, &self.mode)?;
        let effort = budget::effort(self.budget, self.samples)?;
        warn_of_architecture(&robot);
        let found = watched(self.threads, |control| explore(&robot, &modes, &effort, control))??;
        let stopped = found.classes.iter().any(|class| class.end == End::Cancelled);
        if stopped {
            note("stopped: this is what was seen so far");
        }
        if self.shown.json() {
            json(out, &Document { format_version: FORMAT_VERSION, found: &found })?;
        } else {
            print(out, &robot, &found, self.shown.deg)?;
        }
        Ok(Answer::from(!stopped))
    }
}

fn print(out: &mut dyn Write, robot: &Robot, found: &Exploration, degrees: bool) -> Result<(), Failure> {
    let labels = Labels::pose(robot, degrees);
    let left = |name: &str| (name.to_owned(), Align::Left);
    let right = |name: &str| (name.to_owned(), Align::Right);
    let first = [left("mode"), left("det A"), right("samples"), right("component"), right("drawn in it")];
    let heading = labels.headings().map(|name| (name, Align::Right));
    let mut table = Table::new(first.into_iter().chain([right("|det Â|")]).chain(heading));
    for class in &found.classes {
        rows(class, &labels, &mut table);
    }
    write!(out, "{table}")?;
    if found.at_least == 0 {
        return nothing(out, found);
    }
    writeln!(
        out,
        "\n{}: at least {}, certified: so many classes (working mode, sign of det A) have a pose proved to lie in them",
        found.robot,
        count(found.at_least, "generalized aspect", "generalized aspects")
    )?;
    writeln!(
        out,
        "poses of one component are joined by segments proved free of singularities and within limits: certified"
    )?;
    let parted = found.classes.iter().filter(|class| class.components.len() > 1).count();
    if parted > 0 {
        writeln!(
            out,
            "in {} not all was joined within the budget; components of a class may still lie in one aspect",
            classes(parted)
        )?;
    }
    let empty = found.classes.iter().filter(|class| class.components.is_empty()).count();
    if empty > 0 {
        writeln!(
            out,
            "in {} no pose was found before the end, which does not prove that there is none",
            classes(empty)
        )?;
    }
    writeln!(
        out,
        "the number of components is what was seen: it bounds the number of aspects neither way (numerical)"
    )?;
    Ok(())
}

/// Prints the message if no pose was found in any class.
fn nothing(out: &mut dyn Write, found: &Exploration) -> Result<(), Failure> {
    writeln!(
        out,
        "\n{}: no pose was found in {}, which does not prove that there is none: nothing is known of the number of aspects; \
         more --samples or wider limits may find poses",
        found.robot,
        classes(found.classes.len())
    )?;
    Ok(())
}

fn classes(n: usize) -> String {
    count(n, "class", "classes")
}

/// The largest components of a class, and how many more there are.
fn rows(class: &ExploredClass, labels: &Labels, table: &mut Table) {
    let (mode, det_a, samples) = (class.mode.to_string(), class.det_a.to_string(), class.samples.to_string());
    let count = class.components.len();
    if count == 0 {
        table.row([mode, det_a, samples, "none seen".into()]);
        return;
    }
    for (k, component) in class.components.iter().take(LISTED).enumerate() {
        let of = format!("{} of {count}", k + 1);
        let numbers = [of, component.samples.to_string(), brief(component.clearance)];
        let first = [mode.clone(), det_a.clone(), samples.clone()];
        table.row(first.into_iter().chain(numbers).chain(labels.numbers(&component.representative)));
    }
    if count > LISTED {
        table.row([mode, det_a, samples, format!("{} more", count - LISTED)]);
    }
}
