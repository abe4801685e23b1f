//! The direct solutions into which a cusp splits by a small step in the joint space.

use super::equations::System;
use crate::Kinematics;
use aspecta_robot::num::{Jet, without_turns};
use serde::Serialize;

/// Two joint vectors beside that of a cusp, and the direct solutions they have near it: three on one side,
/// one on the other.
#[derive(Clone, Debug, Serialize)]
pub struct Unfolding {
    /// A joint vector with three direct solutions near the cusp.
    pub three: Vec<f64>,
    /// These, angles in rad.
    pub poses: Vec<Vec<f64>>,
    /// A joint vector with one.
    pub one: Vec<f64>,
}

/// Steps off the singular surface, relative to the robot; the solutions then part by about the root of it.
const STEPS: [f64; 4] = [1e-5, 1e-6, 1e-4, 1e-7];
/// Solutions this many roots of the step away count as near.
const NEAR: f64 = 40.0;

/// Steps from the cusp across the singular surface det A = 0, once to either side.
///
/// With X = X₀ + s v + w the leg equations reduce to c s³ + a s + … = 0, where a is the derivative of det A
/// along w, but for a factor. So the joint vector of X₀ + w has three solutions near X₀ for one sign of w,
/// and one for the other.
pub(super) fn unfold<const D: usize, const N: usize>(
    system: &System<'_, D>,
    pose: &[f64; N],
    q: &[f64],
) -> Option<Unfolding> {
    let unit = system.units::<N>();
    // The gradient of det A in coordinates of order one, along the slice.
    let pivot = system.pivot(pose);
    let variables: [_; N] = std::array::from_fn(|k| Jet::<f64, N>::variable(pose[k], k));
    let equations = system.values(&variables, pivot).equations;
    let scaled = |f: &Jet<f64, N>| -> [f64; N] { std::array::from_fn(|k| f.gradient[k] * unit[k]) };
    let mut across = scaled(&equations[0]);
    if system.held.is_some() {
        let along = scaled(&equations[N - 1]);
        let share = product(&across, &along) / product(&along, &along);
        across = std::array::from_fn(|k| across[k] - share * along[k]);
    }
    let length = product(&across, &across).sqrt();
    let near = |q: &[f64], radius: f64| -> Option<Vec<Vec<f64>>> {
        let mut poses: Vec<_> = system.robot.direct_poses(q).ok()?.iter().map(<[f64]>::to_vec).collect();
        poses.retain(|x| distance(system, x, pose, &unit) < radius);
        Some(poses)
    };
    STEPS.into_iter().find_map(|step| {
        let joints = |side: f64| {
            let x: [f64; N] = std::array::from_fn(|k| pose[k] + side * step * unit[k] * across[k] / length);
            let mut moved = system.robot.inverse_in(&x, system.mode).ok()??;
            if let Some((k, _)) = system.held {
                moved[k] = q[k];
            }
            Some(moved)
        };
        let sides = [joints(1.0)?, joints(-1.0)?];
        let radius = NEAR * step.sqrt();
        let poses = [near(&sides[0], radius)?, near(&sides[1], radius)?];
        let three = (0..2).find(|&side| poses[side].len() == 3 && poses[1 - side].len() == 1)?;
        let [a, b] = sides;
        let (three_q, one) = if three == 0 { (a, b) } else { (b, a) };
        Some(Unfolding { three: three_q, poses: poses[three].clone(), one })
    })
}

fn product<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Distance of two poses in coordinates of order one.
fn distance<const D: usize, const N: usize>(
    system: &System<'_, D>,
    a: &[f64],
    b: &[f64; N],
    unit: &[f64; N],
) -> f64 {
    let coordinates = system.robot.platform.coordinates();
    let gap = |k: usize| {
        let gap = a[k] - b[k];
        if coordinates[k].angle { without_turns(gap) } else { gap / unit[k] }
    };
    (0..N).map(|k| gap(k).powi(2)).sum::<f64>().sqrt()
}
