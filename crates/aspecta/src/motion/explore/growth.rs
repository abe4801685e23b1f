//! How a roadmap grows: poses are drawn and joined to what is near, and components feel their way towards
//! each other.

use super::body::Pose;
use super::roadmap::{Roadmap, Way};
use super::territory::Territory;
use super::{Effort, End};
use crate::paving::{Control, Progress};
use aspecta_robot::num::Random;
use aspecta_robot::work;
use aspecta_robot::work::Stopwatch;

/// Tasks of a round. They see the roadmap as it was before the round, so that their order does not matter.
const TASKS: u64 = 32;
/// Poses drawn at once in search of one in the class.
const TRIES: usize = 500;
/// Rounds without any pose in the class after which none is expected.
const PATIENCE: u64 = 16;
/// Poses that a roadmap begins with where draws have found none.
const SEEDS: usize = 16;
/// Components that a new pose is joined to at most.
const NEAR: usize = 8;
/// Steps of a component into the unknown, and towards another.
const STEPS: (usize, usize) = (6, 40);

/// The finding of one task.
enum Found {
    Nothing,
    /// A pose of the class, and ways to it from spots: all but the last pose of each.
    Sample(Pose, Vec<Way>),
    /// A way into the unknown, and ways from other components towards its end, with whether they got there.
    Branch(Way, Vec<(Way, bool)>),
}

/// A roadmap that grows.
pub(super) struct Growth<'a> {
    pub territory: Territory<'a>,
    pub roadmap: Roadmap,
    /// The poses that are to be joined; if there are none, all are.
    targets: Vec<u32>,
    /// Poses drawn.
    pub samples: usize,
    rounds: u64,
}

impl<'a> Growth<'a> {
    /// A roadmap that holds the targets, which must lie in the class.
    pub fn new(territory: Territory<'a>, targets: &[Pose]) -> Self {
        let mut roadmap = Roadmap::default();
        let targets = targets.iter().map(|pose| roadmap.add(*pose, true)).collect();
        Self { territory, roadmap, targets, samples: 0, rounds: 0 }
    }

    /// Adds those poses that are proved to lie in the class, [`SEEDS`] at most; whether there are any.
    pub fn plant(&mut self, poses: impl Iterator<Item = Pose>) -> bool {
        let territory = &self.territory;
        let members = poses.filter(|pose| territory.seems_to_hold(pose) && territory.proof.holds(pose, pose));
        members.take(SEEDS).for_each(|pose| {
            self.roadmap.add(pose, true);
        });
        self.roadmap.name_components();
        self.roadmap.len() > 0
    }

    /// Grows until all targets are joined (with none: as long as it may).
    pub fn run(&mut self, effort: &Effort, begin: Stopwatch, control: &Control<'_>) -> End {
        loop {
            if !self.targets.is_empty() && self.open().len() < 2 {
                return End::Joined;
            }
            if self.samples >= effort.samples || (self.roadmap.len() == 0 && self.rounds >= PATIENCE) {
                return End::Samples;
            }
            if effort.is_spent(begin) {
                return End::Time;
            }
            if control.is_cancelled() {
                return End::Cancelled;
            }
            // What the last draws have left apart is given time to be joined.
            self.round(4 * self.samples < 3 * effort.samples);
            let (done, total) = (self.samples as u64, effort.samples as u64);
            (control.progress)(Progress { stage: "exploring", done, total });
        }
    }

    /// The components that are to be joined.
    fn open(&self) -> Vec<u32> {
        let mut open: Vec<u32> = self.targets.iter().map(|&k| self.roadmap.component(k)).collect();
        if self.targets.is_empty() {
            open = self.roadmap.components().iter().map(|component| component[0]).collect();
        }
        open.sort_unstable();
        open.dedup();
        open
    }

    /// All tasks once; `draws` says whether some of them draw poses although there are components to be
    /// joined.
    fn round(&mut self, draws: bool) {
        let open = self.open();
        let first = self.rounds * TASKS;
        self.rounds += 1;
        let found: Vec<Found> = work::map_range(TASKS as usize, |task| {
            let task = first + task as u64;
            let random = &mut Random::of(&[task]);
            let grows = open.len() > 1 && (task % 2 == 1 || !draws);
            if grows { self.branch(&open, random) } else { self.sample(random) }
        });
        self.samples += TASKS as usize;
        found.into_iter().for_each(|found| self.keep(found));
        self.roadmap.name_components();
    }

    /// Draws a pose and joins it to the components near it.
    fn sample(&self, random: &mut Random) -> Found {
        let Some(pose) = self.territory.draw_member(random, TRIES) else { return Found::Nothing };
        let near = self.roadmap.nearest(&self.territory, &pose, NEAR, |_| true);
        let way = |&from: &u32| {
            let mut over = self.territory.advance(&self.roadmap.spot(from).pose, &pose, STEPS.1);
            over.pop_if(|last| *last == pose).map(|_| Way { from, over, to: None })
        };
        Found::Sample(pose, near.iter().filter_map(way).collect())
    }

    /// Leads a component somewhere, or away from singularities, and others after it.
    fn branch(&self, open: &[u32], random: &mut Random) -> Found {
        let mine = open[random.below(open.len())];
        let towards = if random.below(2) == 0 {
            self.territory.draw(random)
        } else {
            self.roadmap.spot(open[random.below(open.len())]).pose
        };
        let from = self.roadmap.nearest(&self.territory, &towards, 1, |component| component == mine);
        let Some(&from) = from.first() else { return Found::Nothing };
        let start = self.roadmap.spot(from).pose;
        let mut over = self.territory.advance(&start, &towards, STEPS.0);
        if over.is_empty() {
            over.extend(self.territory.climb(&start, random));
        }
        let Some(&tip) = over.last() else { return Found::Nothing };
        let others = self.roadmap.nearest(&self.territory, &tip, 2, |component| component != mine);
        let follow = |&from: &u32| {
            let mut over = self.territory.advance(&self.roadmap.spot(from).pose, &tip, STEPS.1);
            let arrived = over.pop_if(|last| *last == tip).is_some();
            (Way { from, over, to: None }, arrived)
        };
        Found::Branch(Way { from, over, to: None }, others.iter().map(follow).collect())
    }

    /// Takes what was found into the roadmap.
    fn keep(&mut self, found: Found) {
        match found {
            Found::Nothing => {}
            Found::Sample(pose, ways) => {
                let to = Some(self.roadmap.add(pose, true));
                for way in ways {
                    self.roadmap.take(Way { to, ..way });
                }
            }
            Found::Branch(way, others) => {
                let tip = self.roadmap.take(way);
                for (way, arrived) in others {
                    self.roadmap.take(Way { to: arrived.then_some(tip), ..way });
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::explore::territory::roaming_window;
    use aspecta_kinematics::Kinematics;
    use aspecta_kinematics::constraints::Demand;
    use aspecta_robot::catalogue;
    use aspecta_robot::num::padded;

    /// Whatever is offered, only what is proved to lie in the class takes root.
    #[test]
    fn poses_of_other_classes_are_not_planted() {
        let robot = catalogue::find("gough-stewart").unwrap();
        let window = roaming_window(&robot).unwrap();
        let q = [1.0, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071];
        let found = robot.direct(&q).unwrap();
        let poses = |sign: f64| found.iter().filter(move |s| s.det_a * sign > 0.0).map(|s| padded(&s.pose));
        let demand = Demand::class(robot.working_modes()[0], 1);
        let mut growth = Growth::new(Territory::new(&robot, &window, &demand, 0.0), &[]);
        assert!(!growth.plant(poses(-1.0)) && growth.roadmap.len() == 0);
        assert!(growth.plant(poses(-1.0).chain(poses(1.0))));
        assert_eq!(growth.roadmap.len(), poses(1.0).count().min(SEEDS));
    }
}
