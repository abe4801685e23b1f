//! `aspecta locate`: in which aspect, basic region and uniqueness domains a configuration lies.

use crate::args::format::ShownArgs;
use crate::args::given::{PosesOrJoints, Query};
use crate::args::help::help;
use crate::args::making::Making;
use crate::args::mode::ModeArg;
use crate::args::threads::Threads;
use crate::failure::{Answer, Failure};
use crate::input::{self, Columns};
use crate::output::{note, print_each};
use crate::show::places::{Located, Places};
use crate::work::mapping::{Part, Source};
use crate::work::solve::{self, Found};
use crate::work::watch::watched;
use aspecta::aspect::{Analysis, AspectId, ClassId};
use aspecta::robot::Robot;
use clap::Args;
use std::collections::BTreeSet;
use std::io::Write;

/// Arguments of `locate`.
#[derive(Args)]
#[command(mut_args(help("mode", "Only in this working mode, such as `+-`")))]
pub struct Locate {
    /// A file written by `aspecta domains --save`; or the name from `aspecta robots` or the robot file of a
    /// robot, whose aspects are then found and cut into regions first
    robot: String,
    #[command(flatten)]
    given: PosesOrJoints,
    /// The rows of --file are joint vectors, not poses
    #[arg(long)]
    joints: bool,
    #[command(flatten)]
    mode: ModeArg,
    #[command(flatten)]
    making: Making,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    shown: ShownArgs,
}

impl Locate {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let source = Source::new(&self.robot)?;
        let robot = source.robot().clone();
        let layout = [self.layout(&robot)?];
        let found = self.configurations(&robot, &layout)?;
        // From a map they are answered as they come; a map that is to be made is that of the aspects they are
        // in.
        let computed = matches!(source, Source::Robot(_));
        let (held, coming) = if computed { (input::held(found)?, None) } else { (Vec::new(), Some(found)) };
        let (map, _) = watched(self.threads, |control| {
            source
                .map(&self.making, Part::default(), false, control, |analysis| Ok(concerned(analysis, &held)))
        })??;
        if computed {
            let (robot, name) = (&self.robot, &map.robot.name);
            note(&format!(
                "computed for this once; `aspecta domains {robot} --save {name}.aspecta` keeps it, and `aspecta locate {name}.aspecta` \
                 answers at once"
            ));
        }
        let all = held.into_iter().map(Ok).chain(coming.into_iter().flatten());
        let located = all.map(|found| Ok(Located::new(&map, found?)));
        let shown = Places { robot: &robot, degrees: self.shown.deg };
        print_each(out, &shown, self.shown.format(), located)
    }

    /// The columns of the rows asked about.
    fn layout(&self, robot: &Robot) -> Result<Columns, Failure> {
        if self.joints && !self.given.is_file() {
            return Err(Failure::Input("--joints is about the rows of --file: give one, or --q".into()));
        }
        Ok(if self.are_joints() { Columns::joints(robot) } else { Columns::pose(robot) })
    }

    fn are_joints(&self) -> bool {
        self.joints || self.given.is_joints()
    }

    /// The inverse solutions of the poses, or the direct ones of the joint vectors, in the working mode if
    /// there is one.
    fn configurations<'a>(
        &'a self,
        robot: &'a Robot,
        layout: &'a [Columns],
    ) -> Result<Box<dyn Iterator<Item = Result<Found, Failure>> + 'a>, Failure> {
        let mode = self.mode.of(robot)?;
        let solved = move |query: Query| {
            if self.are_joints() {
                return solve::direct(robot, query, mode);
            }
            let mut solutions = solve::inverse(robot, &query.values, query.line)?;
            solutions.retain(|s| mode.is_none_or(|m| s.mode == m));
            Ok(Found { query, solutions, complete: None })
        };
        Ok(Box::new(self.given.read(layout, self.shown.deg)?.map(move |query| solved(query?))))
    }
}

/// The aspects in which these configurations lie, or may.
fn concerned(analysis: &Analysis, found: &[Found]) -> Vec<AspectId> {
    let mut ids = BTreeSet::new();
    for s in found.iter().flat_map(|f| &f.solutions) {
        let classes = analysis.classes.iter().enumerate();
        let class = classes.filter(|(_, c)| c.mode == s.mode && f64::from(c.det_a.factor()) * s.det_a > 0.0);
        for (k, class) in class {
            match analysis.aspect_at(&s.pose, ClassId::new(k)) {
                Some(id) => drop(ids.insert(id)),
                None => ids.extend(class.aspects.iter().map(|aspect| aspect.id)),
            }
        }
    }
    ids.into_iter().collect()
}
