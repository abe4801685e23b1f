//! `aspecta traverse`: which aspects hold a whole set of poses.

use crate::args::det::DetArg;
use crate::args::format::TableArgs;
use crate::args::help::help;
use crate::args::mode::ModeArg;
use crate::args::planning::Analysing;
use crate::args::robot::RobotArg;
use crate::failure::{Answer, Failure};
use crate::input::{self, Columns};
use crate::output::{About, Align, Labels, Table, json, note};
use crate::show::groups::AS_FAR;
use crate::work::mapping::Source;
use crate::work::watch::abandoned_if_cancelled;
use aspecta::aspect::AspectId;
use aspecta::domain::{Map, RegionId};
use aspecta::kinematics::constraints::{Constraint, Kind};
use aspecta::motion::modes::ModeGraph;
use aspecta::motion::traverse::{ClassHolds, Holds, PoseSet, Traversability, traversability};
use aspecta::paving::Control;
use aspecta::robot::Robot;
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::sync::Arc;

/// Arguments of `traverse`.
#[derive(Args)]
#[command(mut_args(help("deg", "Angles of the input and of the tables are in degrees")))]
#[command(mut_args(help("mode", "Only aspects of this working mode, such as `+-`")))]
#[command(mut_args(help("det", "Only aspects with this sign of det A")))]
#[command(after_help = EXAMPLES)]
pub struct Traverse {
    #[command(flatten)]
    robot: RobotArg,
    #[command(flatten)]
    set: Set,
    /// The radius of --disc or --ball
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    radius: Option<f64>,
    #[command(flatten)]
    mode: ModeArg,
    #[command(flatten)]
    det: DetArg,
    /// With --poses: also say through which groups of aspects every pose can be reached if legs change their
    /// postures
    #[arg(long, conflicts_with_all = ["mode", "det"])]
    through_modes: bool,
    /// A file written by `aspecta domains --save`: also say which uniqueness domains hold the set (numerical)
    #[arg(long, value_name = "FILE")]
    map: Option<String>,
    #[command(flatten)]
    analysing: Analysing,
    #[command(flatten)]
    shown: TableArgs,
}

#[derive(Args)]
#[group(required = true, multiple = false)]
struct Set {
    /// A box of poses: a range lo:hi (or one value) per coordinate, as in 2:6,8:10 or 0:1,0:1,-0.1:0.1
    #[arg(long = "box", value_name = "RANGES", allow_hyphen_values = true)]
    ranges: Option<String>,
    /// A disc, or with a range of z a cylinder: x and y lie within --radius of those given, the other
    /// coordinates in the ranges (or at the values) given, as in 0,0,-1100:-900
    #[arg(
        long,
        value_name = "RANGES",
        visible_alias = "cylinder",
        allow_hyphen_values = true,
        requires = "radius"
    )]
    disc: Option<String>,
    /// A ball: x, y and z lie within --radius of those given; angles in the ranges (or at the values) given
    #[arg(long, value_name = "RANGES", allow_hyphen_values = true, requires = "radius")]
    ball: Option<String>,
    /// A CSV file of poses to be visited in any order; `-` reads stdin
    #[arg(long, value_name = "CSV")]
    poses: Option<String>,
    /// A CSV file of poses that are a path of straight segments; again for several paths
    #[arg(long, value_name = "CSV")]
    path: Vec<String>,
}

const EXAMPLES: &str = "\
Examples:
  aspecta traverse five-bar --box 2:6,8:10
  aspecta traverse five-bar --box 2:6,8:10 --mode +- --det +
  aspecta traverse irb-360 --cylinder 0,0,-1100:-900 --radius 400
  aspecta traverse five-bar --poses points.csv --through-modes
A connected set (a box, a disc, a cylinder, a ball, a path) that one aspect holds can be traversed on any continuous path in it; separate poses that one aspect
holds can be visited in any order. Answers are certified unless they say otherwise.
Exit status: 0 some aspect (or, with --through-modes, some group of aspects) holds the set; 1 none, or undecided; 2 bad input.";

#[derive(Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    about: About<'a>,
    #[serde(flatten)]
    found: &'a Traversability,
    #[serde(skip_serializing_if = "Option::is_none")]
    uniqueness: Option<&'a [InDomain]>,
}

/// A uniqueness domain that holds the set.
#[derive(Serialize)]
struct InDomain {
    aspect: AspectId,
    domain: usize,
}

impl Traverse {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = self.robot.load()?;
        if self.through_modes && self.set.poses.is_none() {
            return Err(Failure::Input(
                "--through-modes is about separate poses: give them with --poses".into(),
            ));
        }
        let set = self.set.read(&robot, self.radius, self.shown.deg)?;
        set.check(&robot)?;
        let map = self.map.as_deref().map(|path| read_map(path, &robot)).transpose()?;
        let (mode, det_a) = (self.mode.of(&robot)?, self.det.sign());
        let modes: Vec<_> = mode.into_iter().collect();
        let through_modes = self.through_modes;
        let found = self.analysing.with(&robot, &modes, |analysis, control| {
            let (analysis, set) = (Arc::clone(analysis), set.clone());
            let look = move || {
                let graph = through_modes.then(|| ModeGraph::new(&analysis, &Control::unwatched()));
                traversability(&analysis, graph.as_ref(), set)
            };
            Ok(abandoned_if_cancelled(control, look).transpose()?)
        })?;
        let Some(mut found) = found else {
            note("stopped before anything was decided");
            return Ok(Answer::No);
        };
        let is_asked = |class: &ClassHolds| {
            mode.is_none_or(|mode| class.mode == mode) && det_a.is_none_or(|sign| class.det_a == sign)
        };
        found.classes.retain(is_asked);
        let domains = map.as_ref().map(|map| domains_of(map, &found));
        if self.shown.json() {
            let about = About::of(&robot);
            json(out, &Document { about, found: &found, uniqueness: domains.as_deref() })?;
        } else {
            print(out, &robot, &found, self.shown.deg)?;
            if self.through_modes {
                print_groups(out, &found)?;
            }
            if let Some(domains) = &domains {
                print_domains(out, domains)?;
            }
        }
        let whole = found.classes.iter().any(|class| matches!(class.holds, Holds::Whole { .. }));
        Ok(Answer::from(whole || !found.groups.is_empty()))
    }
}

impl Set {
    fn read(&self, robot: &Robot, radius: Option<f64>, degrees: bool) -> Result<PoseSet, Failure> {
        let layout = [Columns::pose(robot)];
        let poses = |path: &String| -> Result<Vec<Vec<f64>>, Failure> {
            Ok(input::rows(path, &layout, degrees)?.into_iter().map(|row| row.values).collect())
        };
        match self {
            Self { ranges: Some(text), .. } => Ok(PoseSet::Box(ranges(robot, "--box", text, degrees)?)),
            Self { disc: Some(text), .. } => round(robot, ("--disc", text), &["x", "y"], radius, degrees),
            Self { ball: Some(text), .. } => {
                round(robot, ("--ball", text), &["x", "y", "z"], radius, degrees)
            }
            Self { poses: Some(path), .. } => Ok(PoseSet::Poses(poses(path)?)),
            Self { path, .. } => Ok(PoseSet::Paths(path.iter().map(poses).collect::<Result<_, _>>()?)),
        }
    }
}

/// A set within a circle or a sphere of some coordinates, of which one value each is given.
fn round(
    robot: &Robot,
    (option, text): (&str, &str),
    names: &[&str],
    radius: Option<f64>,
    degrees: bool,
) -> Result<PoseSet, Failure> {
    let ranges = ranges(robot, option, text, degrees)?;
    let radius = radius.filter(|r| *r > 0.0 && r.is_finite());
    let radius = radius.ok_or_else(|| Failure::Input("--radius: give a positive number".into()))?;
    let coordinates = robot.platform.coordinates();
    let find = |name: &&str| {
        coordinates.iter().position(|c| c.name == *name).ok_or_else(|| {
            Failure::Input(format!("{option}: the platform of `{}` has no coordinate {name}", robot.name))
        })
    };
    let round = names.iter().map(find).collect::<Result<Vec<_>, _>>()?;
    if let Some(&k) = round.iter().find(|&&k| ranges.get(k).is_some_and(|range| range.0 != range.1)) {
        let name = coordinates[k].name;
        return Err(Failure::Input(format!(
            "{option} `{text}`: give one value of {name}, that of the centre"
        )));
    }
    Ok(PoseSet::round(ranges, round, radius))
}

/// `2:6,8:10`: a range, or a value, per coordinate.
fn ranges(robot: &Robot, option: &str, text: &str, degrees: bool) -> Result<Vec<(f64, f64)>, Failure> {
    let columns = Columns::pose(robot);
    let ends = |upper: bool| -> String {
        let part = |range: &str| {
            range.split_once(':').map_or(range, |(lo, hi)| if upper { hi } else { lo }).to_owned()
        };
        text.split(',').map(part).collect::<Vec<_>>().join(",")
    };
    let [lo, hi] = [
        input::list(option, &ends(false), &columns, degrees)?,
        input::list(option, &ends(true), &columns, degrees)?,
    ];
    if let Some(k) = (0..lo.len()).find(|&k| lo[k] > hi[k]) {
        return Err(Failure::Input(format!("{option} `{text}`: range {} ends before it begins", k + 1)));
    }
    Ok(lo.into_iter().zip(hi).collect())
}

fn read_map(path: &str, robot: &Robot) -> Result<Map, Failure> {
    match Source::new(path)? {
        Source::Map(map) if map.robot == *robot => Ok(*map),
        Source::Map(map) => Err(Failure::Input(format!(
            "--map {path}: that is a map of `{}`, or of a `{}` with other figures",
            map.robot.name, robot.name
        ))),
        Source::Robot(_) => {
            Err(Failure::Input(format!("--map {path}: give a file written by `aspecta domains --save`")))
        }
    }
}

/// The uniqueness domains that hold every pose of the set, or a grid of poses in it.
fn domains_of(map: &Map, found: &Traversability) -> Vec<InDomain> {
    let poses = sampled(&found.set);
    let held = |class: &ClassHolds| {
        let regions: Option<Vec<(AspectId, RegionId)>> = poses
            .iter()
            .map(|pose| {
                let place = map.locate(pose, class.mode).ok().filter(|place| place.det_a == class.det_a)?;
                Some((place.aspect?, place.region?))
            })
            .collect();
        let mut all: Option<Vec<InDomain>> = None;
        for (aspect, region) in regions.unwrap_or_default() {
            let here: Vec<usize> = map.uniqueness(aspect, region).collect();
            let fresh = || here.iter().map(|&domain| InDomain { aspect, domain }).collect();
            let mut left = all.take().unwrap_or_else(fresh);
            left.retain(|held| held.aspect == aspect && here.contains(&held.domain));
            all = Some(left);
        }
        all.unwrap_or_default()
    };
    found.classes.iter().filter(|class| matches!(class.holds, Holds::Whole { .. })).flat_map(held).collect()
}

/// Poses of a set, close together.
fn sampled(set: &PoseSet) -> Vec<Vec<f64>> {
    const ACROSS: usize = 24;
    match set {
        PoseSet::Poses(poses) => poses.clone(),
        PoseSet::Paths(paths) => {
            let between = |ends: &[Vec<f64>]| {
                let at = |i: usize| {
                    ends[0].iter().zip(&ends[1]).map(|(a, b)| a + i as f64 / 100.0 * (b - a)).collect()
                };
                (0..=100).map(at).collect::<Vec<Vec<f64>>>()
            };
            paths.iter().flat_map(|path| path.windows(2).flat_map(between)).collect()
        }
        PoseSet::Round { ranges, round, radius } => {
            let off = |pose: &[f64], k: usize| pose[k] - 0.5 * (ranges[k].0 + ranges[k].1);
            let is_within =
                |pose: &Vec<f64>| round.iter().map(|&k| off(pose, k).powi(2)).sum::<f64>() <= radius * radius;
            sampled(&PoseSet::Box(ranges.clone())).into_iter().filter(is_within).collect()
        }
        PoseSet::Box(ranges) => {
            let mut poses = vec![Vec::new()];
            for (lo, hi) in ranges {
                let steps = if lo == hi { 0 } else { ACROSS };
                let along = |i: usize| if i == 0 { *lo } else { lo + (hi - lo) * i as f64 / ACROSS as f64 };
                poses = poses
                    .iter()
                    .flat_map(|pose: &Vec<f64>| (0..=steps).map(move |i| [&pose[..], &[along(i)]].concat()))
                    .collect();
            }
            poses
        }
    }
}

fn print(out: &mut dyn Write, robot: &Robot, found: &Traversability, degrees: bool) -> Result<(), Failure> {
    let labels = Labels::pose(robot, degrees);
    let left = |name: &str| (name.to_owned(), Align::Left);
    let mut table = Table::new([left("mode"), left("det A"), left("holds the set")]);
    for class in &found.classes {
        let verdict = match &class.holds {
            Holds::Whole { aspect: Some(id) } => format!("yes, certified: aspect {id}"),
            Holds::Whole { aspect: None } => {
                "yes, certified (one aspect; its number is not known at this resolution)".into()
            }
            Holds::NotWhole { pose, constraint } => {
                format!("no, certified: {}, near {}", what(robot, *constraint), labels.sentence(pose))
            }
            Holds::Undecided { pose } => format!("undecided, near {}", labels.sentence(pose)),
        };
        table.row([class.mode.to_string(), class.det_a.to_string(), verdict]);
    }
    write!(out, "{table}")?;
    Ok(())
}

/// Returns the name of the constraint that keeps a pose out.
fn what(robot: &Robot, constraint: Option<Constraint>) -> String {
    match constraint {
        None => "another aspect, or beyond the robot's window".into(),
        Some(constraint) => match constraint.kind() {
            Kind::Parallel => format!("the other sign of {constraint}"),
            Kind::Serial(leg) => format!("leg {leg} does not reach"),
            Kind::Limit => constraint.named(robot),
        },
    }
}

fn print_groups(out: &mut dyn Write, found: &Traversability) -> Result<(), Failure> {
    if found.groups.is_empty() {
        writeln!(
            out,
            "through changes of working mode: no group of linked aspects is known to hold every pose"
        )?;
    }
    for group in &found.groups {
        let ids = group.aspects.iter().map(AspectId::to_string).collect::<Vec<_>>().join(", ");
        let word = if group.certified { "certified" } else { AS_FAR };
        writeln!(
            out,
            "through changes of working mode: every pose can be reached within aspects {ids} ({word})"
        )?;
    }
    Ok(())
}

fn print_domains(out: &mut dyn Write, domains: &[InDomain]) -> Result<(), Failure> {
    if domains.is_empty() {
        writeln!(out, "no uniqueness domain of the map holds it (numerical)")?;
    }
    for InDomain { aspect, domain } in domains {
        writeln!(
            out,
            "uniqueness domain {domain} of aspect {aspect} holds it (numerical): there a joint vector means one pose"
        )?;
    }
    Ok(())
}
