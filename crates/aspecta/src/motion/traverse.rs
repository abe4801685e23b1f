//! Traversability (parcourabilité): which aspects hold a whole set of poses.
//!
//! A connected set that lies in one W-aspect can be traversed along any continuous path in it, in that working mode, without a
//! singularity. For a set of separate poses the same aspect lets the robot go from any of them to any other, on a path that may
//! leave the set. With changes of working mode it is enough that each pose lies in some aspect of one group of [`ModeGraph::groups`].

mod circle;

use super::between;
use super::modes::ModeGraph;
use super::plan::refusal::aspect_at;
use super::plan::{PlanOptions, Planner};
use crate::aspect::{Analysis, AspectClass, AspectId, ClassId, DetSign};
use aspecta_kinematics::constraints::{self, Constraint, Constraints, Demand};
use aspecta_kinematics::modal::closures;
use aspecta_kinematics::path::curve::{Along, Curve, along};
use aspecta_kinematics::placement::Placement;
use aspecta_kinematics::{KinematicsError, WorkingMode, check_pose, for_platform};
use aspecta_robot::num::{Interval, Scalar, Slope};
use aspecta_robot::{Robot, Window};
use circle::Circle;
use serde::Serialize;
use std::collections::VecDeque;
use std::f64::consts::TAU;

/// Interval evaluations spent on a box, in each class.
const BOX_EFFORT: usize = 50_000;
/// And on a segment of a path.
const SEGMENT_EFFORT: usize = 50_000;

/// A set of poses; angles in rad, modulo 2π where the set is a list.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PoseSet {
    /// All poses with every coordinate in its range.
    Box(Vec<(f64, f64)>),
    /// The poses of a box of which some coordinates lie within a circle or a sphere: a disc, a cylinder, a
    /// ball.
    Round {
        /// The range of every coordinate; of those that are round, from one end of the circle or sphere to the
        /// other.
        ranges: Vec<(f64, f64)>,
        /// Which coordinates are round, by index.
        round: Vec<usize>,
        /// The radius.
        radius: f64,
    },
    /// Separate poses.
    Poses(Vec<Vec<f64>>),
    /// Polylines: every path through its poses by straight segments.
    Paths(Vec<Vec<Vec<f64>>>),
}

/// Whether a class holds the whole set.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "answer")]
pub enum Holds {
    /// All of it lies in one aspect (certified).
    Whole {
        /// The aspect; `None` if the set is proved to lie in one, but which is not known.
        aspect: Option<AspectId>,
    },
    /// It does not (certified): a pose of the set lies outside the class, or in another aspect of it than another pose of the set: this one, or
    /// on a path one next to it.
    NotWhole {
        /// The pose.
        pose: Vec<f64>,
        /// The constraint that fails there; `None` if it lies in another aspect, or beyond the window that
        /// the robot file sets.
        #[serde(serialize_with = "constraints::if_any")]
        constraint: Option<Constraint>,
    },
    /// Neither could be proved.
    Undecided {
        /// A pose of the set that is in doubt.
        pose: Vec<f64>,
    },
}

/// The relation of one class to a set of poses.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct ClassHolds {
    /// The working mode.
    pub mode: WorkingMode,
    /// The sign of det A.
    pub det_a: DetSign,
    /// Whether it holds the set.
    #[serde(flatten)]
    pub holds: Holds,
}

/// The aspects in which a set of poses can be traversed.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct Traversability {
    /// The set.
    pub set: PoseSet,
    /// Class by class.
    pub classes: Vec<ClassHolds>,
    /// For separate poses, with changes of working mode: the groups of linked aspects ([`ModeGraph::groups`]) of which every pose lies in at
    /// least one. Empty for boxes and paths.
    pub groups: Vec<LinkedAspects>,
}

/// Aspects that can be reached from one another through changes of working mode.
#[derive(Clone, Debug, Serialize)]
pub struct LinkedAspects {
    /// The aspects, by number.
    pub aspects: Vec<AspectId>,
    /// Whether that is proved: [`ModeGraph::is_proved`].
    pub certified: bool,
}

/// Returns which aspects hold a set, and, if there is a graph, which groups of aspects.
///
/// # Errors
/// [`KinematicsError`] if a pose does not fit the robot.
///
/// # Examples
/// ```
/// use aspecta::motion::traverse::Holds;
/// use aspecta::{Budget, Control, Options, PoseSet, Robot, analyze, traversability};
///
/// # fn main() -> Result<(), aspecta::Error> {
/// let robot = Robot::resolve("five-bar")?;
/// let budget = Budget { depth: Some(8), ..Budget::default() };
/// let modes = vec!["++".parse()?];
/// let options = Options { budget, modes, ..Options::default() };
/// let analysis = analyze(&robot, &options, &Control::unwatched())?;
///
/// let found = traversability(&analysis, None, PoseSet::Box(vec![(3.9, 4.1), (6.9, 7.1)]))?;
/// assert!(found.classes.iter().any(|class| matches!(class.holds, Holds::Whole { .. })));
/// # Ok(())
/// # }
/// ```
pub fn traversability(
    analysis: &Analysis,
    graph: Option<&ModeGraph>,
    set: PoseSet,
) -> Result<Traversability, KinematicsError> {
    set.check(&analysis.robot)?;
    let verdict = |(k, class): (usize, &AspectClass)| {
        let holds = holds(analysis, &set, ClassId::new(k));
        ClassHolds { mode: class.mode, det_a: class.det_a, holds }
    };
    let classes = analysis.classes.iter().enumerate().map(verdict).collect();
    let groups = match (&set, graph) {
        (PoseSet::Poses(poses), Some(graph)) => linked(analysis, graph, poses),
        _ => Vec::new(),
    };
    Ok(Traversability { set, classes, groups })
}

impl PoseSet {
    /// Whether it is a set of poses of a robot.
    ///
    /// # Errors
    /// [`KinematicsError`] if a pose does not fit the robot.
    pub fn check(&self, robot: &Robot) -> Result<(), KinematicsError> {
        self.parts().iter().flatten().try_for_each(|pose| check_pose(robot, pose))
    }

    /// Returns a round set: coordinates `round`, by index, lie within `radius` of the middles of their ranges,
    /// the others in theirs.
    ///
    /// # Examples
    /// ```
    /// use aspecta::PoseSet;
    ///
    /// // A cylinder: x and y within 0.2 of the z axis.
    /// let set = PoseSet::round(vec![(0.0, 0.0), (0.0, 0.0), (-1.3, -1.1)], vec![0, 1], 0.2);
    /// assert!(matches!(set, PoseSet::Round { ranges, .. } if ranges[0] == (-0.2, 0.2)));
    /// ```
    pub fn round(mut ranges: Vec<(f64, f64)>, round: Vec<usize>, radius: f64) -> Self {
        for (_, range) in ranges.iter_mut().enumerate().filter(|(k, _)| round.contains(k)) {
            *range = (range.0 - radius, range.1 + radius);
        }
        Self::Round { ranges, round, radius }
    }

    /// Poses of which it is the hull, one list for each part that hangs together: the corners of a box, what
    /// lies furthest along each coordinate of a round set, each pose by itself, each path.
    fn parts(&self) -> Vec<Vec<Vec<f64>>> {
        match self {
            Self::Round { ranges, .. } => {
                let centre = centre(ranges);
                let end = |k: usize, x: f64| {
                    let mut pose = centre.clone();
                    pose[k] = x;
                    pose
                };
                let ends = |k: usize| [end(k, ranges[k].0), end(k, ranges[k].1)];
                vec![(0..ranges.len()).flat_map(ends).collect()]
            }
            Self::Box(ranges) => {
                vec![vec![ranges.iter().map(|r| r.0).collect(), ranges.iter().map(|r| r.1).collect()]]
            }
            Self::Poses(poses) => poses.iter().map(|pose| vec![pose.clone()]).collect(),
            Self::Paths(paths) => paths.clone(),
        }
    }

    /// A pose that lies outside the window, and whether that is sure: each part is turned as a whole, since its
    /// angles are real numbers that must not jump. Of a part that is told beyond the pole of the pitch it is
    /// not known.
    fn beyond(&self, window: &Window) -> Option<(Vec<f64>, bool)> {
        let of_part = |part: Vec<Vec<f64>>| {
            let first = part.first()?;
            let turned_first = window.turned(first);
            let turns: Vec<f64> = turned_first.iter().zip(first).map(|(turned, x)| turned - x).collect();
            let full = |turn: &f64| ((turn / TAU).round() * TAU - turn).abs() < 1e-9;
            if !turns.iter().all(full) {
                // One pose can be told anew, more only together.
                let whole = part.len() == 1 && window.holds(&turned_first);
                return if whole { None } else { Some((first.clone(), part.len() == 1)) };
            }
            let turned =
                |pose: &Vec<f64>| pose.iter().zip(&turns).map(|(x, turn)| x + turn).collect::<Vec<_>>();
            part.iter().find(|pose| !window.holds(&turned(pose))).map(|pose| (pose.clone(), true))
        };
        self.parts().into_iter().find_map(of_part)
    }
}

fn holds(analysis: &Analysis, set: &PoseSet, class: ClassId) -> Holds {
    let entry = &analysis.classes[class.index()];
    let demand = Demand::class(entry.mode, entry.det_a.factor());
    let robot = &analysis.robot;
    if robot.window.iter().any(Option::is_some)
        && let Some((pose, sure)) = set.beyond(&analysis.window)
    {
        return if sure { Holds::NotWhole { pose, constraint: None } } else { Holds::Undecided { pose } };
    }
    let over_ranges = |ranges: &[(f64, f64)], circle: Option<Circle<'_>>| {
        let whole = for_platform!(robot.platform, over_box(robot, &demand, ranges, circle));
        whole.unwrap_or_else(|| Holds::Whole { aspect: aspect_at(analysis, &centre(ranges), class) })
    };
    match set {
        PoseSet::Box(ranges) => over_ranges(ranges, None),
        PoseSet::Round { ranges, round, radius } => {
            over_ranges(ranges, Some(Circle { centre: centre(ranges), round, radius: *radius }))
        }
        PoseSet::Poses(_) | PoseSet::Paths(_) => over_parts(analysis, &set.parts(), class, &demand),
    }
}

/// Every part proved to stay in the class, and all in one aspect.
fn over_parts(analysis: &Analysis, parts: &[Vec<Vec<f64>>], class: ClassId, demand: &Demand) -> Holds {
    let mut planner = Planner::new(analysis);
    let mut common: Option<(&[f64], Option<AspectId>)> = None;
    for part in parts.iter().filter(|part| !part.is_empty()) {
        if let Some(failed) = leaves_class(&analysis.robot, demand, part) {
            return failed;
        }
        let aspect = aspect_at(analysis, &part[0], class);
        let Some((first, known)) = common else {
            common = Some((&part[0], aspect));
            continue;
        };
        let pose = part[0].clone();
        match known.zip(aspect) {
            Some((a, b)) if a != b => return Holds::NotWhole { pose, constraint: None },
            Some((a, _)) if analysis.is_one(a) => {}
            // Where that is not proved of the aspect, a path may prove it of the poses.
            _ => {
                let shortest = PlanOptions { weight: 0.0, ..PlanOptions::default() };
                if planner.plan(first, &pose, demand.mode, &shortest).is_err() {
                    return Holds::Undecided { pose };
                }
            }
        }
    }
    Holds::Whole { aspect: common.and_then(|(_, aspect)| aspect) }
}

/// Returns the place at which a path leaves the class, or may. A path of one pose is a segment that stands
/// still.
fn leaves_class(robot: &Robot, demand: &Demand, path: &[Vec<f64>]) -> Option<Holds> {
    (0..path.len().saturating_sub(1).max(1)).find_map(|k| {
        let (start, end) = (&path[k], &path[(k + 1).min(path.len() - 1)]);
        let middle = |from: f64, to: f64| between(start, end, 0.5 * (from + to));
        match along(robot, demand, &Curve::segment(start, end), SEGMENT_EFFORT) {
            Along::Inside | Along::Crossed { .. } => None,
            Along::Outside { constraint, from, to } => {
                Some(Holds::NotWhole { pose: middle(from, to), constraint: Some(constraint) })
            }
            Along::Undecided { from, to, .. } => Some(Holds::Undecided { pose: middle(from, to) }),
        }
    })
}

fn centre(ranges: &[(f64, f64)]) -> Vec<f64> {
    ranges.iter().map(|r| 0.5 * (r.0 + r.1)).collect()
}

/// `None` if the box, or what a circle leaves of it, is proved to lie in the class: by bisection, all
/// constraints > 0 on every part that it meets. It is connected, so it lies in one aspect then.
fn over_box<const D: usize, const N: usize>(
    robot: &Robot,
    demand: &Demand,
    ranges: &[(f64, f64)],
    circle: Option<Circle<'_>>,
) -> Option<Holds> {
    let whole: [Interval; N] = std::array::from_fn(|k| Interval::new(ranges[k].0, ranges[k].1));
    // The largest parts first: one that fails as a whole ends it.
    let mut open = VecDeque::from([whole]);
    let mut spent = 0;
    while let Some(part) = open.pop_front() {
        spent += 1;
        let (centre, meets) = match &circle {
            Some(circle) => circle.nearest(&part),
            None => (part.iter().map(|x| x.mid()).collect(), Some(true)),
        };
        if meets == Some(false) {
            continue;
        }
        match over_part::<D, N>(robot, demand, &part) {
            Part::Inside => {}
            Part::Outside(constraint) if meets == Some(true) => {
                return Some(Holds::NotWhole { pose: centre, constraint: Some(constraint) });
            }
            Part::Outside(_) | Part::Open if spent >= BOX_EFFORT => {
                return Some(Holds::Undecided { pose: centre });
            }
            Part::Outside(_) | Part::Open => {
                // Across the side that is longest by the box asked about.
                let share = |k: &usize| part[*k].width() / whole[*k].width().max(f64::MIN_POSITIVE);
                let k = (0..N).max_by(|a, b| share(a).total_cmp(&share(b)))?;
                if part[k].lo == part[k].hi {
                    return Some(Holds::Undecided { pose: centre });
                }
                let middle = part[k].mid();
                let (mut low, mut high) = (part, part);
                low[k] = Interval::new(part[k].lo, middle);
                high[k] = Interval::new(middle, part[k].hi);
                open.extend([low, high]);
            }
        }
    }
    None
}

enum Part {
    Inside,
    Outside(Constraint),
    Open,
}

fn over_part<const D: usize, const N: usize>(robot: &Robot, demand: &Demand, part: &[Interval; N]) -> Part {
    let x: [Slope<Interval, N>; N] = std::array::from_fn(|k| {
        let middle = Interval::point(part[k].mid());
        let radius = Interval::point((part[k] - middle).magnitude());
        Slope::variable(part[k], middle, radius, k)
    });
    let mut result = Part::Inside;
    let placement = Placement::<_, D>::at(robot.platform, &x);
    let legs = closures::<_, D, N>(robot, &placement);
    Constraints::new(robot, &placement, &legs).visit(demand, |constraint, value| {
        let value = value.tightened().range;
        if value.is_negative() {
            result = Part::Outside(constraint);
            return false;
        }
        if !value.is_positive() {
            result = Part::Open;
        }
        true
    });
    result
}

/// The groups of which every pose lies in at least one aspect.
fn linked(analysis: &Analysis, graph: &ModeGraph, poses: &[Vec<f64>]) -> Vec<LinkedAspects> {
    let aspects_of = |pose: &Vec<f64>| -> Vec<AspectId> {
        let set = PoseSet::Poses(vec![pose.clone()]);
        let of = |k: usize| match holds(analysis, &set, ClassId::new(k)) {
            Holds::Whole { aspect } => aspect,
            Holds::NotWhole { .. } | Holds::Undecided { .. } => None,
        };
        (0..analysis.classes.len()).filter_map(of).collect()
    };
    let all: Vec<Vec<AspectId>> = poses.iter().map(aspects_of).collect();
    let holds = |group: &&Vec<AspectId>| all.iter().all(|of| of.iter().any(|id| group.contains(id)));
    let linked =
        |group: &Vec<AspectId>| LinkedAspects { aspects: group.clone(), certified: graph.is_proved(group) };
    graph.groups.iter().filter(holds).map(linked).collect()
}
