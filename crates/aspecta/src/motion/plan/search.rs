//! What a path is looked for by, the straight way, and what becomes of a path that is found.

use super::cost::Cost;
use super::{FINAL, Plan, PlanOptions, Pose, Proof, Refusal, around, shorten};
use crate::aspect::{AspectId, DetSign};
use aspecta_kinematics::WorkingMode;
use aspecta_kinematics::constraints::Demand;
use aspecta_robot::{Robot, Window};

/// Samples of the clearance along the straight way.
const SAMPLES: u32 = 32;

/// What a path is looked for by.
pub(super) struct Search<'a> {
    robot: &'a Robot,
    window: &'a Window,
    det_a: DetSign,
    demand: Demand,
    weight: f64,
}

impl<'a> Search<'a> {
    pub fn new(
        robot: &'a Robot,
        window: &'a Window,
        mode: WorkingMode,
        det_a: DetSign,
        options: &PlanOptions,
    ) -> Self {
        let demand = Demand { margins: options.margins, ..Demand::class(mode, det_a.factor()) };
        Self { robot, window, det_a, demand, weight: options.weight }
    }

    pub fn cost(&self) -> Cost<'_, 3> {
        Cost::new(self.robot, self.window, &self.demand, self.weight)
    }

    pub fn proof(&self) -> Proof<'_> {
        Proof { robot: self.robot, window: self.window, demand: &self.demand }
    }

    /// The straight way, if it is proved and no other is likely to be much better.
    pub fn straight(&self, [start, goal]: [Pose; 2]) -> Option<Vec<Pose>> {
        let cost = self.cost();
        let goal = cost.beside(&start, &goal);
        let clearance = |t: f64| {
            let x: Pose = std::array::from_fn(|k| start[k] + t * (goal[k] - start[k]));
            let measures = cost.measures(&x);
            measures.parallel.min(measures.serial)
        };
        let least = clearance(0.0).min(clearance(1.0));
        let is_clear = || (1..SAMPLES).all(|i| clearance(f64::from(i) / f64::from(SAMPLES)) >= least);
        // Of a length alone nothing is shorter.
        let is_good = cost.is_length() || (self.weight <= 1.0 && is_clear());
        (is_good && self.proof().holds(&start, &goal)).then(|| vec![start, goal])
    }

    /// A way round what is in between, if one is soon found and length counts as much as nearness to singularities.
    pub fn around(&self, ends: [Pose; 2]) -> Option<Vec<Pose>> {
        if self.weight > 1.0 { None } else { around::path(&self.proof(), &self.cost(), ends) }
    }

    /// The plan along a proved path, made cheaper.
    pub fn finish(&self, path: Vec<Pose>, aspect: Option<AspectId>) -> Result<Plan, Refusal> {
        let (cost, proof) = (self.cost(), self.proof());
        let path = shorten::improve(&proof, &cost, path);
        let pose = |x: &Pose| x[..self.robot.dof()].to_vec();
        if let Some(k) = path.windows(2).position(|ends| !proof.holds_within(&ends[0], &ends[1], FINAL)) {
            return Err(Refusal::Unproved { pose: pose(&path[k]) });
        }
        Ok(Plan {
            robot: self.robot.clone(),
            mode: self.demand.mode,
            det_a: self.det_a,
            aspect,
            length: path.windows(2).map(|ends| cost.distance(&ends[0], &ends[1])).sum(),
            waypoints: path.iter().map(pose).collect(),
            margins: self.demand.margins,
        })
    }
}
