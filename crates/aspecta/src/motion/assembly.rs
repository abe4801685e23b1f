//! Assembly modes: the poses of one joint vector, by the aspects they lie in, and what a motion from one to another goes round
//! (section 4.1.5 of the paper).
//!
//! Two direct solutions in one aspect can be changed into each other without meeting a singularity; two whose det A differs in sign
//! cannot, within a working mode.

use super::between;
use super::modes::Route;
use super::plan::refusal::aspect_at;
use super::plan::{Plan, PlanOptions, Planner};
use crate::aspect::{Analysis, AspectId, DetSign};
use crate::paving::Control;
use aspecta_kinematics::Kinematics;
use aspecta_kinematics::cusps::{Cusp, CuspError, Options, cusps};
use aspecta_kinematics::{KinematicsError, Solution, WorkingMode};
use aspecta_robot::num::without_turns;
use aspecta_robot::{LegIndex, Robot};
use serde::Serialize;
use std::collections::BTreeMap;

/// The direct solutions of a joint vector.
#[derive(Clone, Debug, Serialize)]
pub struct AssemblyModes {
    /// The joint vector.
    pub q: Vec<f64>,
    /// Whether it is proved that these are all.
    pub complete: bool,
    /// The solutions, in the order of [`Robot::direct`].
    pub solutions: Vec<AssemblyMode>,
    /// The modes among which aspects are numbered.
    pub numbered_among: Vec<WorkingMode>,
    /// The aspects that hold more than one of them, by number: changes between those without a singularity exist.
    pub shared: Vec<SharedAspect>,
}

/// One direct solution.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct AssemblyMode {
    /// Its number, from 1.
    pub number: usize,
    /// Pose, working mode, det A.
    #[serde(flatten)]
    pub solution: Solution,
    /// The aspect (certified); `None` if it is singular, beyond a limit or too near to either to tell.
    pub aspect: Option<AspectId>,
    /// Which of the aspects of its mode and sign of det A, the largest first, and of how many: [`Analysis::rank`].
    pub rank: Option<(usize, usize)>,
}

/// An aspect with several solutions.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SharedAspect {
    /// The aspect.
    pub aspect: AspectId,
    /// [`AssemblyMode::number`]s.
    pub solutions: Vec<usize>,
    /// Whether it is proved that they lie in one: the aspect is proved to be one ([`Analysis::is_one`]), or paths from each to the next are.
    pub certified: bool,
}

/// The direct solutions of `q`, by aspect. Modes that were not analysed have none.
///
/// # Errors
/// [`KinematicsError`] if `q` does not fit the robot or its direct problem cannot be solved.
///
/// # Examples
/// ```
/// use aspecta::{Budget, Control, Kinematics, Options, Robot, analyze, assembly_modes};
///
/// # fn main() -> Result<(), aspecta::Error> {
/// let robot = Robot::resolve("five-bar")?;
/// let budget = Budget { depth: Some(7), ..Budget::default() };
/// let options = Options { budget, ..Options::default() };
/// let analysis = analyze(&robot, &options, &Control::unwatched())?;
///
/// let q = robot.inverse(&[4.0, 7.0])?[0].q.clone();
/// let found = assembly_modes(&analysis, &q)?;
/// assert_eq!((found.solutions.len(), found.complete), (2, true));
/// assert!(found.shared.is_empty()); // the two have opposite signs of det A
/// # Ok(())
/// # }
/// ```
pub fn assembly_modes(analysis: &Analysis, q: &[f64]) -> Result<AssemblyModes, KinematicsError> {
    let found = analysis.robot.direct_certified(q)?;
    let complete = found.complete;
    let mode = |(k, solution): (usize, Solution)| {
        let sign = DetSign::of(solution.det_a);
        let class = analysis.class_of(solution.mode, sign).filter(|_| solution.within_limits);
        let aspect = class.and_then(|class| aspect_at(analysis, &solution.pose, class));
        let rank = aspect.and_then(|id| analysis.rank(id));
        AssemblyMode { number: k + 1, solution, aspect, rank }
    };
    let solutions: Vec<AssemblyMode> = found.solutions.into_iter().enumerate().map(mode).collect();
    let shared = shared(analysis, &solutions);
    let numbered_among = analysis.modes.iter().map(|m| m.mode).collect();
    Ok(AssemblyModes { q: q.to_vec(), complete, solutions, numbered_among, shared })
}

/// The aspects with several solutions.
fn shared(analysis: &Analysis, solutions: &[AssemblyMode]) -> Vec<SharedAspect> {
    let mut by_aspect: BTreeMap<AspectId, Vec<&AssemblyMode>> = BTreeMap::new();
    for solution in solutions {
        if let Some(aspect) = solution.aspect {
            by_aspect.entry(aspect).or_default().push(solution);
        }
    }
    let mut planner = Planner::new(analysis);
    let shortest = PlanOptions { weight: 0.0, ..PlanOptions::default() };
    let mut are_joined =
        |a: &Solution, b: &Solution| planner.plan(&a.pose, &b.pose, a.mode, &shortest).is_ok();
    let several = by_aspect.into_iter().filter(|(_, members)| members.len() > 1);
    let entry = several.map(|(aspect, members)| {
        let mut pairs = members.windows(2);
        let certified = analysis.is_one(aspect) || pairs.all(|p| are_joined(&p[0].solution, &p[1].solution));
        SharedAspect { aspect, solutions: members.iter().map(|s| s.number).collect(), certified }
    });
    entry.collect()
}

/// A place of a motion where the number of direct solutions changes: elsewhere, two poses of the same joint vector meet at a parallel
/// singularity and vanish, or appear. Numerical.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fold {
    /// The segment of the path, from 1,
    pub segment: usize,
    /// and t ∈ [0, 1] along it.
    pub t: f64,
    /// The joint vector there.
    pub q: Vec<f64>,
    /// Direct solutions before and after.
    pub solutions: (usize, usize),
    /// The pose at which two of them meet.
    pub meeting: Vec<f64>,
}

/// A cusp that a closed motion of the joints goes round.
#[derive(Clone, Debug, Serialize)]
pub struct CuspRound {
    /// The joint held to find it, by its leg, at its mean along the motion.
    pub held: LegIndex,
    /// The cusp (certified) in that slice of the joint space.
    pub cusp: Cusp,
    /// How often the motion, projected onto the slice, goes round it (counter-clockwise).
    pub turns: i32,
}

/// Returns the folds of a motion: the places at which its number of direct solutions changes.
pub fn folds(robot: &Robot, plan: &Plan) -> Vec<Fold> {
    let count = |q: &[f64]| robot.direct_poses(q).map(|poses| poses.len());
    let mut found = Vec::new();
    for (k, piece) in Route::from(plan.clone()).pieces(robot).iter().enumerate() {
        let step = 1.0 / (piece.samples.len() - 1) as f64;
        for (i, ends) in piece.samples.windows(2).enumerate() {
            let (Ok(before), Ok(after)) = (count(&ends[0].q), count(&ends[1].q)) else { continue };
            if before == after {
                continue;
            }
            let at = |t: f64| between(&ends[0].q, &ends[1].q, t);
            let (mut lo, mut hi) = (0.0, 1.0);
            for _ in 0..40 {
                let middle = 0.5 * (lo + hi);
                if count(&at(middle)).is_ok_and(|n| n == before) { lo = middle } else { hi = middle }
            }
            // On the side where there are more, those that meet are there, hardly apart.
            let q = at(if before > after { lo } else { hi });
            let Some(meeting) = most_singular(robot, &q) else { continue };
            let t = (i as f64 + lo) * step;
            found.push(Fold { segment: k + 1, t, q, solutions: (before, after), meeting });
        }
    }
    found
}

/// The direct solution with the least |det A|.
fn most_singular(robot: &Robot, q: &[f64]) -> Option<Vec<f64>> {
    let solutions = robot.direct(q).ok()?;
    solutions.into_iter().min_by(|a, b| a.det_a.abs().total_cmp(&b.det_a.abs())).map(|s| s.pose)
}

/// The cusps that a motion of a robot with three degrees of freedom goes round, if it begins and ends at one joint vector: in the slice of
/// the joint space in which the joint that varies least is held at its mean. Cusps are certified; going round them is counted on
/// the projection of the joint path, numerically.
///
/// # Errors
/// [`CuspError`].
pub fn cusps_round(robot: &Robot, plan: &Plan, control: &Control<'_>) -> Result<Vec<CuspRound>, CuspError> {
    let pieces = Route::from(plan.clone()).pieces(robot);
    let path: Vec<&[f64]> = pieces.iter().flat_map(|piece| &piece.samples).map(|at| &at.q[..]).collect();
    let range = |j: usize| {
        let values = path.iter().map(|q| q[j]);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(x), hi.max(x)))
    };
    let width = |j: &usize| range(*j).1 - range(*j).0;
    let Some(held) = (0..robot.dof()).min_by(|a, b| width(a).total_cmp(&width(b))) else {
        return Ok(Vec::new());
    };
    let mean = 0.5 * (range(held).0 + range(held).1);
    let options = Options { fix: vec![(LegIndex::new(held), mean)], mode: Some(plan.mode), boxes: None };
    let others: Vec<usize> = (0..robot.dof()).filter(|&j| j != held).collect();
    let &[a, b] = &others[..] else { return Ok(Vec::new()) };
    let round = |cusp: Cusp| {
        let turns = winding(path.iter().map(|q| [q[a] - cusp.q[a], q[b] - cusp.q[b]]));
        (turns != 0).then_some(CuspRound { held: LegIndex::new(held), cusp, turns })
    };
    Ok(cusps(robot, &options, control)?.cusps.into_iter().filter_map(round).collect())
}

/// Returns how often a closed polygon goes round the origin.
fn winding(points: impl Iterator<Item = [f64; 2]>) -> i32 {
    let angles: Vec<f64> = points.map(|[x, y]| y.atan2(x)).collect();
    let turned: f64 = angles.windows(2).map(|ends| without_turns(ends[1] - ends[0])).sum();
    (turned / std::f64::consts::TAU).round() as i32
}

#[cfg(test)]
mod tests {
    use super::winding;

    #[test]
    fn turns_are_counted_with_their_sign() {
        let square = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [1.0, 1.0]];
        assert_eq!(winding(square.into_iter()), 1);
        assert_eq!(winding(square.into_iter().rev()), -1);
        assert_eq!(winding(square.into_iter().map(|[x, y]| [x + 2.0, y])), 0);
    }
}
