//! A motion along a path: what is where at each time.

use super::grid::{AT, Step, fastest};
use super::{JointLimits, Piece, Waypoint};
use crate::path::spline::{Point, Spline};
use aspecta_robot::LegIndex;
use aspecta_robot::num::padded;
use serde::Serialize;

/// The number of places on each step at which limits are checked once more.
const SHARES: usize = 8;
/// A limit is said to bind where it is used to this share.
const BINDS: f64 = 0.99;
/// Rows beyond which a rate is taken to be a mistake.
const MOST_ROWS: f64 = 1e7;
/// Samples closer together than this share of the way are one.
const SAME: f64 = 1e-12;

/// A motion along a path, from rest to rest on each of its pieces. Numerical.
#[derive(Clone, Debug)]
pub struct Trajectory {
    limits: JointLimits,
    legs: Vec<Leg>,
    total: f64,
    path_error: Vec<f64>,
}

/// One piece of it.
#[derive(Clone, Debug)]
struct Leg {
    /// q_j / speed limit of joint j, over s.
    joints: Spline,
    poses: Spline,
    steps: Vec<Step>,
    /// When each step starts, from the start of this piece, not yet slowed; and the end.
    times: Vec<f64>,
    /// The factor by which it is slowed down, ≥ 1.
    slower: f64,
    /// When it starts.
    start: f64,
}

/// The state of the robot at a time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Seconds from the start.
    pub time: f64,
    /// The pose.
    pub pose: Vec<f64>,
    /// q.
    pub q: Vec<f64>,
    /// q̇, a second.
    pub velocity: Vec<f64>,
    /// q̈, a second squared. It may jump.
    pub acceleration: Vec<f64>,
}

/// The quantity that is limited.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Limited {
    /// |q̇|.
    Speed,
    /// |q̈|.
    Acceleration,
}

/// A motion in rows, with what limits it: ready to be written. Angles are in rad, times in s.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sampled {
    /// Seconds from start to end.
    pub total_time: f64,
    /// The limits of speed.
    pub speed: Vec<f64>,
    /// The limits of acceleration.
    pub acceleration: Vec<f64>,
    /// [`Trajectory::bindings`].
    pub bindings: Vec<Binding>,
    /// [`Trajectory::path_error`].
    pub path_error: Vec<f64>,
    /// [`Trajectory::rows`].
    pub rows: Vec<Row>,
}

/// How long a limit is what keeps the robot from being faster.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Binding {
    /// The joint, by its leg.
    pub joint: LegIndex,
    /// Which of its limits.
    pub limit: Limited,
    /// The share of the time, in [0, 1].
    pub share: f64,
}

impl Trajectory {
    /// `None` if nothing moves.
    pub(super) fn new(pieces: &[Piece], limits: &JointLimits) -> Option<Self> {
        let mut total = 0.0;
        let mut legs = Vec::new();
        let mut path_error = vec![0.0; limits.speed.len()];
        for piece in pieces {
            let Some((joints, poses)) = splines(&piece.samples, limits) else { continue };
            for (j, error) in doubt(&joints).into_iter().take(path_error.len()).enumerate() {
                path_error[j] = f64::max(path_error[j], error * limits.speed[j]);
            }
            let leg = Leg::new(joints, poses, limits, total);
            total = leg.end();
            legs.push(leg);
        }
        (!legs.is_empty()).then(|| Self { limits: limits.clone(), legs, total, path_error })
    }

    /// Seconds from start to end.
    pub fn total_time(&self) -> f64 {
        self.total
    }

    /// Returns how far each joint strays from the path between the samples that were given: an estimate, from
    /// the spline through every other of them.
    pub fn path_error(&self) -> &[f64] {
        &self.path_error
    }

    /// Returns the state of the robot at a time, which is clamped to [0, total time].
    pub fn at(&self, time: f64) -> Row {
        let time = time.clamp(0.0, self.total);
        let k = self.legs.partition_point(|leg| leg.start <= time).max(1) - 1;
        let (leg, n) = (&self.legs[k], self.limits.speed.len());
        let (step, share, speed) = leg.locate(time);
        let [pose, ..] = leg.poses.at(step.piece, step.start + share * step.length);
        let [y, speed, acceleration] = step.at(&leg.joints, share, speed);
        let joints =
            |x: &Point, by: f64| (0..n).map(|j| x[j] * self.limits.speed[j] / by).collect::<Vec<_>>();
        Row {
            time,
            pose: pose[..n].to_vec(),
            q: joints(&y, 1.0),
            velocity: joints(&speed, leg.slower),
            acceleration: joints(&acceleration, leg.slower * leg.slower),
        }
    }

    /// Rows at equal distances of time, `rate` a second, and one at the end.
    pub fn rows(&self, rate: f64) -> impl Iterator<Item = Row> + '_ {
        // The last one is not wanted twice.
        let count = (self.total * rate * (1.0 - 1e-12)).ceil() as usize;
        (0..count).map(move |i| i as f64 / rate).chain([self.total]).map(|time| self.at(time))
    }

    /// Whether a rate is positive and gives a number of rows that makes sense, at most 10⁷.
    pub fn is_usable_rate(&self, rate: f64) -> bool {
        rate > 0.0 && self.total * rate <= MOST_ROWS
    }

    /// Returns all there is to write of the motion, with `rate` rows a second.
    pub fn sampled(&self, rate: f64) -> Sampled {
        Sampled {
            total_time: self.total,
            speed: self.limits.speed.clone(),
            acceleration: self.limits.acceleration.clone(),
            bindings: self.bindings(),
            path_error: self.path_error.clone(),
            rows: self.rows(rate).collect(),
        }
    }

    /// Returns which limits bind, the longest first.
    pub fn bindings(&self) -> Vec<Binding> {
        let mut all = Vec::new();
        for joint in 0..self.limits.speed.len() {
            for (i, limit) in [Limited::Speed, Limited::Acceleration].into_iter().enumerate() {
                let time: f64 = self.legs.iter().map(|leg| leg.bound(joint, i, &self.limits)).sum();
                let share = (time / self.total).min(1.0);
                if share > 0.0 {
                    all.push(Binding { joint: LegIndex::new(joint), limit, share });
                }
            }
        }
        all.sort_by(|a, b| b.share.total_cmp(&a.share));
        all
    }
}

impl Leg {
    fn new(joints: Spline, poses: Spline, limits: &JointLimits, start: f64) -> Self {
        let acceleration: Vec<_> =
            limits.acceleration.iter().zip(&limits.speed).map(|(a, v)| a / v).collect();
        let steps = fastest(&joints, &acceleration);
        let mut times = vec![0.0];
        for step in &steps {
            times.push(times[times.len() - 1] + step.time());
        }
        let slower = steps.iter().map(|step| excess(&joints, step, &acceleration)).fold(1.0, f64::max);
        Self { joints, poses, steps, times, slower, start }
    }

    fn end(&self) -> f64 {
        self.start + self.slower * self.times[self.steps.len()]
    }

    /// The step of a time, the share of it that has been gone, and ṡ.
    fn locate(&self, time: f64) -> (&Step, f64, f64) {
        let time = (time - self.start) / self.slower;
        let k = self.times.partition_point(|t| *t <= time).clamp(1, self.steps.len()) - 1;
        let step = &self.steps[k];
        let since = (time - self.times[k]).max(0.0);
        let speed = step.speed2.sqrt() + step.rate * since;
        let gone = 0.5 * since * (step.speed2.sqrt() + speed);
        (step, (gone / step.length).clamp(0.0, 1.0), speed.max(0.0))
    }

    /// Returns how long a limit of a joint binds: of its speed (0) or its acceleration (1). Before it is
    /// slowed down.
    fn bound(&self, joint: usize, which: usize, limits: &JointLimits) -> f64 {
        let most = if which == 0 { 1.0 } else { limits.acceleration[joint] / limits.speed[joint] };
        let binds = |step: &&Step| {
            AT.iter().any(|share| step.motion(&self.joints, *share)[which][joint].abs() >= BINDS * most)
        };
        self.slower * self.steps.iter().filter(binds).map(Step::time).sum::<f64>()
    }
}

/// Returns the factor by which a step is too fast: > 1 where limits are exceeded.
fn excess(spline: &Spline, step: &Step, acceleration: &[f64]) -> f64 {
    let shares = (0..=SHARES).map(|i| i as f64 / SHARES as f64);
    shares.fold(0.0, |most: f64, share| {
        let [speed, rate] = step.motion(spline, share);
        let of = |(j, limit): (usize, &f64)| speed[j].abs().max((rate[j].abs() / limit).sqrt());
        acceleration.iter().enumerate().map(of).fold(most, f64::max)
    })
}

/// The splines of joints, each divided by its speed limit, and of poses, over the length of chords. `None` if
/// nothing moves.
fn splines(samples: &[Waypoint], limits: &JointLimits) -> Option<(Spline, Spline)> {
    let scaled = |w: &Waypoint| -> Point {
        padded(&w.q.iter().zip(&limits.speed).map(|(q, v)| q / v).collect::<Vec<_>>())
    };
    let chord = |a: &Point, b: &Point| a.iter().zip(b).map(|(a, b)| (b - a).powi(2)).sum::<f64>().sqrt();
    let all: Vec<_> = samples.iter().map(scaled).collect();
    let length: f64 = all.windows(2).map(|w| chord(&w[0], &w[1])).sum();
    let (mut knots, mut joints, mut poses): (Vec<f64>, Vec<Point>, Vec<Point>) = Default::default();
    for (y, sample) in all.iter().zip(samples) {
        let knot = joints.last().map_or(0.0, |last| knots[knots.len() - 1] + chord(last, y));
        if knots.last().is_none_or(|last| knot - last > SAME * length) {
            knots.push(knot);
            joints.push(*y);
            poses.push(padded(&sample.pose));
        }
    }
    (knots.len() > 1).then(|| (Spline::new(knots.clone(), joints), Spline::new(knots, poses)))
}

/// Returns how far a spline may be from what it was sampled from: a sixteenth of how far the spline through
/// every other sample is from the ones left out, since its error goes with the fourth power of their
/// distance.
fn doubt(spline: &Spline) -> Point {
    let knots = spline.knots();
    let value = |k: usize| spline.at(k.min(knots.len() - 2), knots[k])[0];
    let kept: Vec<_> = (0..knots.len()).filter(|k| k % 2 == 0 || k + 1 == knots.len()).collect();
    let coarse =
        Spline::new(kept.iter().map(|&k| knots[k]).collect(), kept.iter().map(|&k| value(k)).collect());
    let mut most = [0.0; 6];
    for k in (1..knots.len()).step_by(2) {
        let there = coarse.at(coarse.piece(knots[k]), knots[k])[0];
        let here = value(k);
        for j in 0..6 {
            most[j] = f64::max(most[j], (there[j] - here[j]).abs() / 16.0);
        }
    }
    most
}
