//! The cost of a path: its length, weighted the more the nearer it comes to a singularity. Numerical: it
//! decides which of the sound paths is taken, never whether a path is sound.

use aspecta_kinematics::constraints::{Demand, Margins, measures};
use aspecta_kinematics::for_platform;
use aspecta_kinematics::placement::Placement;
use aspecta_robot::{Platform, Robot, Window};
use std::f64::consts::TAU;

/// Samples of a segment's cost, at least.
const FEWEST: f64 = 3.0;
/// And at most.
const MOST: f64 = 16.0;

/// The cost of paths in one class of aspects, through poses of at most K coordinates.
pub(in crate::motion) struct Cost<'a, const K: usize> {
    robot: &'a Robot,
    demand: &'a Demand,
    /// The weight of a unit of each coordinate: 1 for lengths, the characteristic length for angles.
    scale: [f64; K],
    glued: [bool; K],
    /// How much nearness to singularities counts.
    weight: f64,
    /// The diagonal of the window.
    pub size: f64,
}

impl<'a, const K: usize> Cost<'a, K> {
    pub fn new(robot: &'a Robot, window: &Window, demand: &'a Demand, weight: f64) -> Self {
        let coordinates = robot.platform.coordinates();
        let turning = coordinates.iter().all(|c| c.angle);
        let mut scale = [0.0; K];
        for (scale, c) in scale.iter_mut().zip(coordinates) {
            *scale = if c.angle && !turning { robot.characteristic_length() } else { 1.0 };
        }
        let glued = std::array::from_fn(|k| window.glued.get(k) == Some(&true));
        let mut cost = Self { robot, demand, scale, glued, weight, size: 0.0 };
        let corner = |upper: bool| {
            let mut corner = [0.0; K];
            corner.iter_mut().zip(&window.ranges).for_each(|(x, r)| *x = if upper { r.1 } else { r.0 });
            corner
        };
        let (low, high) = (corner(false), corner(true));
        cost.size = (0..K).map(|k| ((high[k] - low[k]) * scale[k]).powi(2)).sum::<f64>().sqrt();
        cost
    }

    /// Length of the straight segment: translations and angles times the characteristic length. Of a free
    /// body it is the angle it turns through.
    pub fn distance(&self, a: &[f64; K], b: &[f64; K]) -> f64 {
        let step: [f64; K] = std::array::from_fn(|k| (b[k] - a[k]) * self.scale[k]);
        let apart: f64 = step.iter().map(|x| x * x).sum();
        if self.robot.platform != Platform::FreeBody {
            return apart.sqrt();
        }
        // With R = R_z R_y R_x, |ω|² = the sum of squares − 2 sin(pitch) · (rate of roll) · (rate of yaw).
        let (roll, pitch, yaw) = (K - 3, K - 2, K - 1);
        let speed = |t: f64| {
            let sin = (a[pitch] + t * (b[pitch] - a[pitch])).sin();
            (apart - 2.0 * sin * step[roll] * step[yaw]).max(0.0).sqrt()
        };
        // Gauss's rule with three points.
        let off = 0.5 * 0.6_f64.sqrt();
        (5.0 * speed(0.5 - off) + 8.0 * speed(0.5) + 5.0 * speed(0.5 + off)) / 18.0
    }

    /// The pose `b`, turned by full turns to be next to `a`.
    pub fn beside(&self, a: &[f64; K], b: &[f64; K]) -> [f64; K] {
        // Where no turn is needed the pose stays what it is, to the last bit.
        let turns = |k: usize| if self.glued[k] { ((a[k] - b[k]) / TAU).round() } else { 0.0 };
        std::array::from_fn(|k| b[k] + turns(k) * TAU)
    }

    /// A step of a given length along coordinate k.
    pub fn step(&self, length: f64, k: usize) -> f64 {
        length / self.scale[k]
    }

    /// |det Â| and the least |B_jj| / max |B_jj|; zeros where the pose is not in the class.
    pub fn measures(&self, x: &[f64; K]) -> Margins {
        let pose = &x[..self.robot.dof()];
        for_platform!(self.robot.platform, measured(self.robot, self.demand, pose))
    }

    /// Whether nothing but length counts.
    pub fn is_length(&self) -> bool {
        self.weight == 0.0
    }

    /// Cost of a unit of length at a pose so far from singularities.
    pub fn density(&self, measures: Margins) -> f64 {
        if self.is_length() { 1.0 } else { measures.parallel.min(measures.serial).powf(-self.weight) }
    }

    /// Cost of a straight segment.
    pub fn of(&self, a: &[f64; K], b: &[f64; K]) -> f64 {
        let length = self.distance(a, b);
        if self.is_length() {
            return length;
        }
        let count = (24.0 * length / self.size).clamp(FEWEST, MOST).ceil() as usize;
        let at = |i: usize| -> [f64; K] {
            let t = (i as f64 + 0.5) / count as f64;
            std::array::from_fn(|k| a[k] + t * (b[k] - a[k]))
        };
        let sum: f64 = (0..count).map(|i| self.density(self.measures(&at(i)))).sum();
        length * sum / count as f64
    }

    /// Cost of a polyline.
    pub fn of_all(&self, path: &[[f64; K]]) -> f64 {
        path.windows(2).map(|ends| self.of(&ends[0], &ends[1])).sum()
    }
}

fn measured<const D: usize, const N: usize>(robot: &Robot, demand: &Demand, pose: &[f64]) -> Margins {
    let placement = Placement::<f64, D>::at(robot.platform, pose);
    let (parallel, serial) = measures::<f64, D, N>(robot, &placement, demand.mode);
    // A NaN is no measure.
    let positive = |x: f64| if x > 0.0 { x } else { 0.0 };
    let serial = serial.iter().copied().map(positive).fold(1.0, f64::min);
    Margins { parallel: positive(parallel * f64::from(demand.sign)), serial }
}
