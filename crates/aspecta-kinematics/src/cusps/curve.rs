//! The curves of cusps of a robot with three degrees of freedom, followed numerically from slices.

use super::equations::System;
use super::{CuspError, Options, check, cusps};
use crate::Kinematics;
use crate::chart::Chart;
use aspecta_robot::num::{Jet, without_turns};
use aspecta_robot::work::{Control, Progress};
use aspecta_robot::{Actuator, LegIndex, Platform, Robot, Window, WorkingMode};
use nalgebra::{Matrix3, Vector3};
use serde::Serialize;
use std::f64::consts::PI;

/// Slices in which curves are looked for.
const SLICES: usize = 12;
/// Greatest step along a curve, in coordinates of order one (lengths by [`Robot::characteristic_length`],
/// angles in rad).
const GREATEST: f64 = 0.05;
/// Steps smaller than this mean that the curve cannot be followed.
const LEAST: f64 = 1e-6;
/// Points of a curve.
const MOST: usize = 20_000;

/// The curves of cusps that pass through some slices. *Numerical*: the cusps of the slices are certified,
/// what lies between them is followed in floating point, and curves that meet no slice are not found.
#[derive(Clone, Debug, Serialize)]
pub struct CuspCurves {
    /// Robot name.
    pub robot: String,
    /// The unit of lengths.
    pub length_unit: String,
    /// The joint whose slices were searched: `q1`, `q2`, …
    pub joint: String,
    /// Its values there (length unit or rad).
    pub slices: Vec<f64>,
    /// Whether the search of every slice is complete.
    pub slices_complete: bool,
    /// Whether it was stopped before all slices were searched.
    pub stopped: bool,
    /// The curves, by working mode.
    pub curves: Vec<CuspCurve>,
}

/// One curve of cusps.
#[derive(Clone, Debug, Serialize)]
pub struct CuspCurve {
    /// The working mode.
    pub mode: WorkingMode,
    /// Points along it, at most 0.05 apart (lengths by [`Robot::characteristic_length`], angles in rad).
    pub points: Vec<CurvePoint>,
    /// The ends of the curve, at the first point and at the last.
    pub ends: [CurveEnd; 2],
}

/// A point of a curve of cusps: a configuration.
#[derive(Clone, Debug, Serialize)]
pub struct CurvePoint {
    /// X; angles in rad.
    pub pose: Vec<f64>,
    /// q; angles in rad.
    pub q: Vec<f64>,
    /// Whether every joint is within its limits.
    pub within_limits: bool,
}

/// The way in which a curve ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum CurveEnd {
    /// It is closed: the last point is followed by the first.
    Closed,
    /// The border of the robot's [`Window`].
    Window,
    /// A serial singularity: it goes on in another working mode.
    Serial,
    /// C of a leg comes to lie on the axis of its crank: the joint is free there, and the curve may go on.
    #[serde(rename = "free-joint")]
    FreeJoint,
    /// It could not be followed: a degenerate cusp, or a singularity of the coordinates.
    Lost,
}

/// The curves of cusps of a robot with n = 3, of which no joint is held; the boxes of the options are for all
/// slices together. None for platforms that do not turn. Once cancelled, those found so far.
///
/// # Errors
/// [`CuspError`] as [`cusps`]; [`CuspError::NoRange`] if no joint has a range to slice.
pub fn cusp_curves(robot: &Robot, options: &Options, control: &Control<'_>) -> Result<CuspCurves, CuspError> {
    let (joint, (lo, hi)) =
        joint_range(robot).ok_or_else(|| CuspError::NoRange { robot: robot.name.clone() })?;
    let mut left = options.boxes;
    let slice = |value, boxes| Options { fix: vec![(joint, value)], mode: options.mode, boxes };
    let slices: Vec<f64> = (0..SLICES).map(|i| lo + (hi - lo) * (i as f64 + 0.5) / SLICES as f64).collect();
    check(robot, &slice(slices[0], None))?;
    let mut all = CuspCurves {
        robot: robot.name.clone(),
        length_unit: robot.length_unit.clone(),
        joint: format!("q{joint}"),
        slices,
        slices_complete: true,
        stopped: false,
        curves: Vec::new(),
    };
    let window = robot.slice(&[])?;
    for (done, value) in all.slices.clone().into_iter().enumerate() {
        let quiet = Control { cancelled: control.cancelled, progress: &|_| {} };
        let share = left.map(|left| left.div_ceil((SLICES - done) as u64));
        let found = cusps(robot, &slice(value, share), &quiet)?;
        left = left.map(|left| left.saturating_sub(found.boxes));
        all.slices_complete &= found.complete;
        all.stopped = control.is_cancelled();
        if all.stopped {
            break;
        }
        for cusp in &found.cusps {
            let seed = Vector3::from_column_slice(&cusp.pose);
            let curve = match robot.platform {
                Platform::TurningBody => {
                    Tracker::<3>::new(robot, &window, cusp.mode).curve(seed, &all.curves)
                }
                Platform::PlanePoint
                | Platform::PlaneBody
                | Platform::TranslatingBody
                | Platform::FreeBody => Tracker::<2>::new(robot, &window, cusp.mode).curve(seed, &all.curves),
            };
            all.curves.extend(curve);
        }
        let (done, total) = (done as u64 + 1, SLICES as u64);
        (control.progress)(Progress { stage: "following curves of cusps", done, total });
    }
    let modes = robot.working_modes();
    all.curves.sort_by_key(|c| modes.iter().position(|m| *m == c.mode));
    Ok(all)
}

/// The first joint with a range.
fn joint_range(robot: &Robot) -> Option<(LegIndex, (f64, f64))> {
    robot.legs.iter().enumerate().find_map(|(j, leg)| {
        let lengths = || leg.length_range().map(|(min, max)| (min.mid(), max.mid()));
        let range = if leg.actuator.is_angle() { Some((-PI, PI)) } else { lengths() };
        range.map(|r| (LegIndex::new(j), r))
    })
}

/// Follows the curve det A = κ = 0 by steps along its tangent and Newton's method across it.
struct Tracker<'a, const D: usize> {
    system: System<'a, D>,
    window: &'a Window,
    unit: Vector3<f64>,
}

/// A point on the curve and the unit tangent there, in coordinates of order one.
#[derive(Clone, Copy)]
struct Place {
    at: Vector3<f64>,
    tangent: Vector3<f64>,
}

/// det A and κ at a point, divided by the lengths of their gradients.
struct Linear {
    values: [f64; 2],
    /// Unit vectors.
    gradients: [Vector3<f64>; 2],
    tangent: Vector3<f64>,
}

impl<'a, const D: usize> Tracker<'a, D> {
    fn new(robot: &'a Robot, window: &'a Window, mode: WorkingMode) -> Self {
        let system = System::new(robot, Chart::Pose, mode, None);
        let unit = Vector3::from(system.units::<3>());
        Self { system, window, unit }
    }

    /// The curve through the pose `seed`, unless it is one of `known`.
    fn curve(&self, seed: Vector3<f64>, known: &[CuspCurve]) -> Option<CuspCurve> {
        let at = seed.component_div(&self.unit);
        let near =
            |curve: &CuspCurve| curve.mode == self.system.mode && self.distance(curve, &at) < 0.2 * GREATEST;
        if known.iter().any(near) {
            return None;
        }
        let start = Place { at, tangent: self.linearised(&at)?.tangent };
        let (mut places, last) = self.follow(start);
        let mut ends = [last; 2];
        if last != CurveEnd::Closed {
            let (back, first) = self.follow(Place { tangent: -start.tangent, ..start });
            places = back.into_iter().skip(1).rev().chain(places).collect();
            ends[0] = first;
        }
        let points = places.iter().filter_map(|at| self.point(at)).collect();
        Some(CuspCurve { mode: self.system.mode, points, ends })
    }

    /// The equations near a point. `None` beyond a serial singularity.
    fn linearised(&self, at: &Vector3<f64>) -> Option<Linear> {
        let y: [f64; 3] = at.component_mul(&self.unit).into();
        let variables: [_; 3] = std::array::from_fn(|k| Jet::<f64, 3>::variable(y[k], k));
        let values = self.system.values(&variables, self.system.pivot(&y));
        if values.closing.iter().any(|f| f.value <= 0.0) {
            return None;
        }
        let [f, g, _] = values.equations;
        let gradient = |f: &Jet<f64, 3>| Vector3::from(f.gradient).component_mul(&self.unit);
        let (df, dg) = (gradient(&f), gradient(&g));
        let (a, b) = (df.norm(), dg.norm());
        let (df, dg) = (df / a, dg / b);
        let tangent = df.cross(&dg).try_normalize(1e-9)?;
        Some(Linear { values: [f.value / a, g.value / b], gradients: [df, dg], tangent })
    }

    /// The point of the curve in the plane across `ahead.tangent` at `ahead.at`.
    fn corrected(&self, ahead: Place) -> Option<Place> {
        let mut at = ahead.at;
        for _ in 0..8 {
            let Linear { values: f, gradients: [df, dg], tangent } = self.linearised(&at)?;
            let rows = Matrix3::from_rows(&[df.transpose(), dg.transpose(), ahead.tangent.transpose()]);
            let right = Vector3::new(f[0], f[1], ahead.tangent.dot(&(at - ahead.at)));
            let step = rows.lu().solve(&right)?;
            at -= step;
            if step.norm() < 1e-10 {
                let side = if tangent.dot(&ahead.tangent) < 0.0 { -1.0 } else { 1.0 };
                return Some(Place { at, tangent: side * tangent });
            }
        }
        None
    }

    /// Follows the curve from `start` on; returns its points, and what ended it.
    fn follow(&self, start: Place) -> (Vec<Vector3<f64>>, CurveEnd) {
        let mut points = vec![start.at];
        let (mut here, mut step) = (start, 0.2 * GREATEST);
        while points.len() < MOST {
            let ahead = Place { at: here.at + step * here.tangent, ..here };
            let next = self.corrected(ahead).filter(|next| {
                (next.at - ahead.at).norm() < 0.2 * step && next.tangent.dot(&here.tangent) > 0.98
            });
            let Some(next) = next else {
                step *= 0.5;
                if step < LEAST {
                    return (points, self.end(&here));
                }
                continue;
            };
            if self.is_outside(&next.at) {
                return (points, CurveEnd::Window);
            }
            let left = self.gap(&start.at, &next.at);
            if points.len() > 3 && left.norm() < step && next.tangent.dot(&start.tangent) > 0.9 {
                return (points, CurveEnd::Closed);
            }
            points.push(next.at);
            here = next;
            step = (1.4 * step).min(GREATEST);
        }
        (points, CurveEnd::Lost)
    }

    /// Why the curve goes on no further: in X it has a kink where a leg's reach, or the weight of its row, is
    /// all but zero.
    fn end(&self, here: &Place) -> CurveEnd {
        const SMALL: f64 = 1e-3;
        let y: [f64; 3] = here.at.component_mul(&self.unit).into();
        let values = self.system.values(&y, self.system.pivot(&y));
        let legs = || self.system.robot.legs.iter().map(|leg| leg.actuator).enumerate();
        let free = |(j, actuator): (usize, Actuator)| {
            actuator.usual_weight().is_some_and(|usual| values.weights[j] < SMALL * usual)
        };
        let serial = |(j, actuator): (usize, Actuator)| {
            actuator.greatest_reach().is_some_and(|most| values.closing[j] < SMALL * most.mid())
        };
        match (legs().any(free), legs().any(serial)) {
            (true, _) => CurveEnd::FreeJoint,
            (_, true) => CurveEnd::Serial,
            _ => CurveEnd::Lost,
        }
    }

    fn is_outside(&self, at: &Vector3<f64>) -> bool {
        let y = at.component_mul(&self.unit);
        (0..3).any(|k| {
            let (lo, hi) = self.window.ranges[k];
            !self.window.glued[k] && !(lo..=hi).contains(&y[k])
        })
    }

    /// a − b, angles to the nearest turn.
    fn gap(&self, a: &Vector3<f64>, b: &Vector3<f64>) -> Vector3<f64> {
        let gap = a - b;
        let nearest = |k: usize| if self.window.glued[k] { without_turns(gap[k]) } else { gap[k] };
        Vector3::from_fn(|k, _| nearest(k))
    }

    /// Returns how far `at` is from the segments of a curve.
    fn distance(&self, curve: &CuspCurve, at: &Vector3<f64>) -> f64 {
        let from = |point: &CurvePoint| {
            self.gap(&Vector3::from_column_slice(&point.pose).component_div(&self.unit), at)
        };
        let closing = (curve.ends[0] == CurveEnd::Closed).then(|| curve.points.first()).flatten();
        let after = curve.points.iter().skip(1).chain(closing);
        let segment = |(p, q): (&CurvePoint, &CurvePoint)| {
            let a = from(p);
            let along = self.gap(&from(q), &a);
            let share = (-a.dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
            (a + share * along).norm()
        };
        curve.points.iter().zip(after).map(segment).fold(f64::INFINITY, f64::min)
    }

    fn point(&self, at: &Vector3<f64>) -> Option<CurvePoint> {
        let y = at.component_mul(&self.unit);
        let pose = self.window.turned(y.as_slice());
        let solutions = self.system.robot.inverse(&pose).ok()?;
        let solution = solutions.into_iter().find(|s| s.mode == self.system.mode)?;
        Some(CurvePoint { pose, q: solution.q, within_limits: solution.within_limits })
    }
}
