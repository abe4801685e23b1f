//! Assembly modes of a free body: which direct solutions of a joint vector are joined by proved motions.

use super::body::Pose;
use super::growth::Growth;
use super::territory::Territory;
use super::{Effort, End, ExploreError, classes_of, roaming};
use crate::aspect::DetSign;
use crate::paving::Control;
use aspecta_kinematics::constraints::Demand;
use aspecta_kinematics::{DirectSolutions, Solution, WorkingMode};
use aspecta_robot::num::padded;
use aspecta_robot::work::Stopwatch;
use aspecta_robot::{Robot, Window};
use serde::Serialize;

/// The direct solutions of a joint vector, and which of them can be changed into each other without meeting a
/// singularity.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct JoinedSolutions {
    /// The joint vector.
    pub q: Vec<f64>,
    /// Whether it is proved that these are all.
    pub complete: bool,
    /// The solutions, as [`Kinematics::direct`](aspecta_kinematics::Kinematics::direct) orders them.
    pub solutions: Vec<NumberedSolution>,
    /// The classes they lie in.
    pub classes: Vec<SharedClass>,
}

/// One direct solution.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NumberedSolution {
    /// Its number, from 1.
    pub number: usize,
    /// Pose, working mode, det A.
    #[serde(flatten)]
    pub solution: Solution,
}

/// The solutions in one class of aspects.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SharedClass {
    /// The working mode.
    pub mode: WorkingMode,
    /// The sign of det A.
    pub det_a: DetSign,
    /// [`NumberedSolution::number`]s, those together that are joined: they lie in one aspect (certified).
    /// Sets that are apart could not be joined within the budget, which proves nothing. Solutions of
    /// different classes lie in different aspects (certified).
    pub joined: Vec<Vec<usize>>,
    /// Poses drawn.
    pub samples: usize,
    /// Why the roadmap grew no further.
    pub end: End,
}

/// Joins the direct solutions `found` of `q`, class by class. Solutions that are not proved to lie in a class
/// (singular, beyond a limit, or too near to either to tell) are in none.
///
/// # Errors
/// [`ExploreError`].
pub fn join_solutions(
    robot: &Robot,
    q: &[f64],
    found: DirectSolutions,
    effort: &Effort,
    control: &Control<'_>,
) -> Result<JoinedSolutions, ExploreError> {
    let (window, begin) = (roaming(robot)?, Stopwatch::start());
    let DirectSolutions { solutions, complete } = found;
    let mut modes: Vec<WorkingMode> = solutions.iter().map(|s| s.mode).collect();
    modes.sort_unstable();
    modes.dedup();
    let kinds = classes_of(&modes);
    let join = |(k, &kind): (usize, &(WorkingMode, DetSign))| {
        let effort = effort.part(k, kinds.len());
        join_class(robot, &window, kind, &solutions, |growth| growth.run(&effort, begin, control))
    };
    let classes = kinds.iter().enumerate().filter_map(join).collect();
    let numbered = (1..).zip(solutions.iter().cloned());
    let solutions = numbered.map(|(number, solution)| NumberedSolution { number, solution }).collect();
    Ok(JoinedSolutions { q: q.to_vec(), complete, solutions, classes })
}

/// The solutions of one class, if there are any.
fn join_class(
    robot: &Robot,
    window: &Window,
    (mode, det_a): (WorkingMode, DetSign),
    solutions: &[Solution],
    run: impl FnOnce(&mut Growth<'_>) -> End,
) -> Option<SharedClass> {
    let demand = Demand::class(mode, det_a.factor());
    let territory = Territory::new(robot, window, &demand, 0.0);
    let pose = |s: &Solution| -> Pose { padded(&window.turned(&s.pose)) };
    let is_member = |s: &Solution| s.mode == mode && territory.proof.holds(&pose(s), &pose(s));
    let members: Vec<usize> = (0..solutions.len()).filter(|&k| is_member(&solutions[k])).collect();
    if members.is_empty() {
        return None;
    }
    let targets: Vec<Pose> = members.iter().map(|&k| pose(&solutions[k])).collect();
    let mut growth = Growth::new(territory, &targets);
    let end = run(&mut growth);
    let mut joined: Vec<(u32, Vec<usize>)> = Vec::new();
    for (spot, &k) in (0..).zip(&members) {
        let component = growth.roadmap.component(spot);
        match joined.iter_mut().find(|(of, _)| *of == component) {
            Some((_, set)) => set.push(k + 1),
            None => joined.push((component, vec![k + 1])),
        }
    }
    let joined = joined.into_iter().map(|(_, set)| set).collect();
    Some(SharedClass { mode, det_a, joined, samples: growth.samples, end })
}
