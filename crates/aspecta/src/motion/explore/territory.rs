//! One class of aspects of a free body: what lies in it, and which ways through it are proved.

use super::body::{Body, Pose, beside};
use crate::motion::plan::Proof;
use crate::motion::plan::cost::Cost;
use aspecta_kinematics::constraints::{Constraints, Demand};
use aspecta_kinematics::modal::closures;
use aspecta_kinematics::placement::Placement;
use aspecta_robot::num::{Random, padded};
use aspecta_robot::{Robot, Unbounded, Window};

/// The longest step of a way that is felt for, as a share of the window.
const STEP: f64 = 0.06;
/// How often a step that fails is halved.
const HALVINGS: u32 = 3;
/// Neighbourhoods of a pose, each half as wide as the one before, and draws from each.
const SMALLEST: i32 = 12;
const DRAWS: usize = 4;
/// The places at which a segment is checked numerically before it is proved.
const GLANCES: [f64; 7] = [1.0, 0.5, 0.25, 0.75, 0.125, 0.375, 0.875];

/// S_{s,σ}, with margins if they are asked for, and motions in it.
pub(super) struct Territory<'a> {
    pub proof: Proof<'a>,
    pub cost: Cost<'a, 6>,
    /// Which angles nothing bounds.
    free: [bool; 3],
}

/// The window of a free body, in which angles are any real numbers where the robot file sets no range.
///
/// If it bounds none of them the pitch goes on past ±π/2, to coordinates of orientations that have others
/// within it.
pub(super) fn roaming_window(robot: &Robot) -> Result<Window, Unbounded> {
    let mut window = robot.workspace_window()?;
    if robot.window[3..].iter().all(Option::is_none) {
        window.ranges[4] = window.ranges[3];
        window.glued[4] = true;
    }
    Ok(window)
}

impl<'a> Territory<'a> {
    /// `window` is a [`roaming_window`]; `weight` that of [`Cost`].
    pub fn new(robot: &'a Robot, window: &'a Window, demand: &'a Demand, weight: f64) -> Self {
        Self {
            proof: Proof { robot, window, demand },
            cost: Cost::new(robot, window, demand, weight),
            free: std::array::from_fn(|k| window.glued[3 + k]),
        }
    }

    /// Returns how far apart two poses are.
    pub fn distance(&self, a: &Body, b: &Body) -> f64 {
        a.distance(b, self.proof.robot.characteristic_length())
    }

    /// The coordinates of a body, within the window if it lies in it.
    fn pose(&self, body: &Body) -> Pose {
        padded(&self.proof.window.turned(&body.pose()))
    }

    /// The coordinates of `b` that are joined to `a` by a straight line.
    pub fn beside(&self, a: &Pose, b: &Pose) -> Pose {
        beside(a, b, self.free, |pose| self.cost.distance(a, pose))
    }

    /// Whether a pose lies in the class, in numbers.
    pub fn seems_to_hold(&self, pose: &Pose) -> bool {
        let placement = Placement::<f64, 3>::at(self.proof.robot.platform, pose);
        let mut inside = self.proof.window.holds(pose);
        let legs = closures::<f64, 3, 6>(self.proof.robot, &placement);
        Constraints::new(self.proof.robot, &placement, &legs).visit(self.proof.demand, |_, value| {
            inside &= value > 0.0;
            inside
        });
        inside
    }

    /// Whether the straight segment from `a` to `b`, put beside it, is proved to lie in the class.
    pub fn joins(&self, a: &Pose, b: &Pose) -> bool {
        let b = self.beside(a, b);
        let at = |t: &f64| -> Pose { std::array::from_fn(|k| a[k] + t * (b[k] - a[k])) };
        GLANCES.iter().all(|t| self.seems_to_hold(&at(t))) && self.proof.holds(a, &b)
    }

    /// A pose drawn evenly from the window.
    pub fn draw(&self, random: &mut Random) -> Pose {
        let ranges = &self.proof.window.ranges;
        let mut pose: Pose = std::array::from_fn(|k| random.within(ranges[k]));
        if self.free == [true; 3] {
            let turn = Body::even_turn([random.unit(), random.unit(), random.unit()]);
            pose = self.pose(&Body::new([pose[0], pose[1], pose[2]], turn));
        }
        pose
    }

    /// A pose drawn evenly from the class, and proved to lie in it; none if `tries` draws find none.
    pub fn draw_member(&self, random: &mut Random, tries: usize) -> Option<Pose> {
        let is_member = |pose: &Pose| self.seems_to_hold(pose) && self.proof.holds(pose, pose);
        (0..tries).map(|_| self.draw(random)).find(is_member)
    }

    /// A pose somewhere near, drawn from ever smaller neighbourhoods until one is joined to `from` and
    /// further from singularities: none if nothing near is.
    pub fn climb(&self, from: &Pose, random: &mut Random) -> Option<Pose> {
        let clearance = |pose: &Pose| {
            let measures = self.cost.measures(pose);
            measures.parallel.min(measures.serial)
        };
        let (least, length) = (clearance(from), self.proof.robot.characteristic_length());
        let near = |k: i32| {
            let shares: [f64; 6] = std::array::from_fn(|_| random.within((-1.0, 1.0)));
            let size = STEP * self.cost.size * 0.5_f64.powi(k);
            self.pose(&Body::at(from).moved(shares.map(|share| share * size), length))
        };
        let is_better = |pose: &Pose| clearance(pose) > least && self.joins(from, pose);
        (0..SMALLEST).flat_map(|k| [k; DRAWS]).map(near).find(is_better)
    }

    /// Goes from a pose of the class towards another pose, in at most `steps` steps; returns the poses met,
    /// each joined to the one before by a proved segment, the last of them `to` if it was reached.
    pub fn advance(&self, from: &Pose, to: &Pose, steps: usize) -> Vec<Pose> {
        let goal = Body::at(to);
        let mut way: Vec<Pose> = Vec::new();
        for _ in 0..steps {
            let at = *way.last().unwrap_or(from);
            if self.joins(&at, to) {
                way.push(*to);
                break;
            }
            let here = Body::at(&at);
            let whole = (STEP * self.cost.size / self.distance(&here, &goal)).min(0.5);
            let step = |k: u32| self.pose(&here.towards(&goal, whole * 0.5_f64.powi(k as i32)));
            let Some(next) = (0..=HALVINGS).map(step).find(|next| self.joins(&at, next)) else { break };
            way.push(next);
        }
        way
    }
}
