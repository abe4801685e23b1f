//! Bodies that turn in space: from common points of quadrics to poses.

use super::certify::certify;
use super::locked::{Locked, linearised, polish, rounds_to_zero, units};
use super::projective::{Ends, Point, Problem, Proved, is_nearly_real, rotation};
use super::{Roots, SelfMotion, cone, free_body, turning_body};
use crate::SINGULAR;
use crate::placement::{Placement, roll_pitch_yaw};
use aspecta_robot::Platform;
use nalgebra::{DMatrix, DVector, Dyn, SVD};

/// The orientations of a turning body: by the sweep of one leg's cone, or, where that cannot tell how many
/// there are, by all complex ones.
pub(super) fn turning(legs: &[Locked], prove: bool) -> Result<Roots<3>, SelfMotion> {
    let Some(cones) = turning_body::cones(legs) else { return Err(SelfMotion) };
    let problem = turning_body::problem(&cones);
    let pose = |x: &Point<4>| roll_pitch_yaw(&rotation(x.re));
    if let Some(points) = cone::sweep(&cones)
        && let Some(ends) = problem.near(&points)
        && (!prove || problem.prove(&ends).iter().all(Option::is_some))
    {
        let poses = ends.iter().map(|end| pose(&end.point)).collect();
        return Ok(Roots { poses, proved: if prove { ends.len() } else { 0 }, at_most: Some(ends.len()) });
    }
    found(Platform::TurningBody, legs, &problem, (turning_body::MOST, |_: &_, _: &_| 0), prove, pose)
}

/// The poses of a free body.
pub(super) fn free(legs: &[Locked], prove: bool) -> Result<Roots<6>, SelfMotion> {
    let (problem, units) = free_body::problem(legs);
    let pose = |x: &Point<8>| {
        let [e, g] = [0, 4].map(|from| std::array::from_fn(|k| x.re[from + k]));
        let r = rotation(e);
        let ([x, y, z], [roll, pitch, yaw]) = (units.position(e, g, &r), roll_pitch_yaw(&r));
        [x, y, z, roll, pitch, yaw]
    };
    let elsewhere = |ends: &_, proofs: &_| free_body::elsewhere(problem.forms(), ends, proofs);
    found(Platform::FreeBody, legs, &problem, (free_body::MOST, elsewhere), prove, pose)
}

/// The real ones among the common points of `problem`: at most `most`, and of those some may be proved to be `elsewhere`, where no
/// poses are, once these ends and proofs are known.
///
/// Where it is not proved that these are all, the other paths may have ended at poses that meet: those that
/// fulfil the leg equations to rounding are added.
fn found<const V: usize, const F: usize, const N: usize>(
    platform: Platform,
    legs: &[Locked],
    problem: &Problem<'_, V, F>,
    (most, elsewhere): (usize, impl FnOnce(&Ends<V>, &[Option<Proved<V>>]) -> usize),
    prove: bool,
    pose: impl Fn(&Point<V>) -> [f64; N],
) -> Result<Roots<N>, SelfMotion> {
    let ends = problem.solve();
    let proofs = if prove { problem.prove(&ends) } else { Vec::new() };
    let proved = |k: usize| proofs.get(k).is_some_and(|p| p.is_some_and(|p| p.is_rotation()));
    let is_clear = |k: usize| ends[k].arrived && !is_nearly_real(&ends[k].point);
    let taken = |k: usize| proved(k) || !prove && is_clear(k) && is_rotation(&ends[k].point);
    let mut roots = Roots::none();
    for k in (0..ends.len()).filter(|&k| taken(k) && ends[k].point.is_real()) {
        roots.push(pose(&ends[k].point))?;
    }
    let sure = roots.poses.len();
    roots.proved = if prove { sure } else { 0 };
    let counted = (0..ends.len()).filter(|&k| proved(k)).count();
    let all = prove && (counted == most || counted + elsewhere(&ends, &proofs) == most);
    roots.at_most = all.then_some(sure);
    if all {
        return Ok(roots);
    }
    for k in (0..ends.len()).filter(|&k| !taken(k)) {
        let start = pose(&ends[k].point);
        for near in [1.0, -1.0].map(|side| settled::<N>(platform, legs, start, side)) {
            let new = |x: &[f64; N]| !meet(platform, legs, x, &near);
            if rounds_to_zero::<3, N>(platform, legs, &near) && roots.poses.iter().all(new) {
                roots.push(near)?;
            }
        }
    }
    let regular = |pose: &[f64; N]| certify::<3, N>(platform, legs, *pose).is_some();
    if roots.poses[sure..].iter().any(|pose| !regular(pose) && moves::<N>(platform, legs, *pose)) {
        return Err(SelfMotion);
    }
    Ok(roots)
}

/// A pose near `start` that fulfils the leg equations, if there is one; of two that meet there, the one on
/// the given side (±1).
fn settled<const N: usize>(platform: Platform, legs: &[Locked], start: [f64; N], side: f64) -> [f64; N] {
    let mut x = on_fold::<N>(platform, legs, start, side).unwrap_or(start);
    if !rounds_to_zero::<3, N>(platform, legs, &x) {
        // On a self-motion, or regular.
        x = polish::<3, N>(platform, legs, onto::<N>(platform, legs, start).unwrap_or(start));
    }
    if let Some(r) = Placement::<f64, 3>::at(platform, &x).rotation() {
        x[N - 3..].copy_from_slice(&roll_pitch_yaw(r));
    }
    x
}

/// Along the direction v that the equations resist least, l · f = a + b s + c s²/2 + …, l being the
/// combination that sees v most: it is solved for s, at whose double root Newton's method would be lost,
/// while the other directions take its steps. `None` where numbers overflow.
fn on_fold<const N: usize>(
    platform: Platform,
    legs: &[Locked],
    mut x: [f64; N],
    side: f64,
) -> Option<[f64; N]> {
    const STEP: f64 = 1e-4;
    let unit = units::<N>(platform, legs);
    let mut oriented: Option<[DVector<f64>; 2]> = None;
    for _ in 0..8 {
        let (f, mut svd) = scaled::<N>(platform, legs, &x)?;
        let least = svd.singular_values.imin();
        let mut slope = svd.singular_values[least];
        let mut pair = [svd.u.as_ref()?.column(least).into_owned(), svd.v_t.as_ref()?.row(least).transpose()];
        // The signs of singular vectors are arbitrary: the side must not change with them.
        for (vector, before) in pair.iter_mut().zip(oriented.iter().flatten()) {
            if vector.dot(before) < 0.0 {
                vector.neg_mut();
                slope = -slope;
            }
        }
        let [l, v] = &pair;
        let slope_at = |s: f64| -> f64 {
            let y: [f64; N] = std::array::from_fn(|k| x[k] + s * unit[k] * v[k]);
            let (_, jacobian) = linearised::<3, N>(platform, legs, &y);
            let along = |i: usize| (0..N).map(|k| jacobian[(i, k)] * unit[k] * v[k]).sum::<f64>();
            (0..N).map(|i| l[i] * along(i)).sum()
        };
        let bend = (slope_at(STEP) - slope_at(-STEP)) / (2.0 * STEP);
        let root = (slope * slope - 2.0 * l.dot(&f) * bend).max(0.0).sqrt();
        let s = (side * root - slope) / bend;
        svd.singular_values[least] = 0.0;
        let others = svd.solve(&f, 0.0).ok()?;
        // Far away nothing is known of the fold.
        let s = if s.abs() < 1.0 { s } else { 0.0 };
        (0..N).for_each(|k| x[k] += unit[k] * (s * v[k] - others[k]));
        oriented = Some(pair);
    }
    Some(x)
}

/// The point of the solutions' set next to `x`, whatever its dimension: steps of Gauss and Newton across it.
fn onto<const N: usize>(platform: Platform, legs: &[Locked], mut x: [f64; N]) -> Option<[f64; N]> {
    let unit = units::<N>(platform, legs);
    for _ in 0..12 {
        let (f, svd) = scaled::<N>(platform, legs, &x)?;
        let shift = svd.solve(&f, 1e-4 * svd.singular_values.max()).ok()?;
        (0..N).for_each(|k| x[k] -= unit[k] * shift[k]);
    }
    Some(x)
}

/// Whether two poses are nearer than poses that meet can be told apart: √ε of the longest leg, of R.
fn meet<const N: usize>(platform: Platform, legs: &[Locked], a: &[f64; N], b: &[f64; N]) -> bool {
    const MEET: f64 = 1.5e-8;
    let unit = units::<N>(platform, legs)[0];
    let [a, b] = [a, b].map(|x| Placement::<f64, 3>::at(platform, x));
    let (Some(r), Some(s)) = (a.rotation(), b.rotation()) else { return false };
    let turned = (0..3).any(|i| (0..3).any(|j| (r[i][j] - s[i][j]).abs() > MEET));
    let moved = (0..3).any(|k| (a.origin()[k] - b.origin()[k]).abs() > MEET * unit);
    !turned && !moved
}

/// f and the singular values of ∂f/∂X in coordinates of order one; `None` where they overflow.
fn scaled<const N: usize>(
    platform: Platform,
    legs: &[Locked],
    x: &[f64; N],
) -> Option<(DVector<f64>, SVD<f64, Dyn, Dyn>)> {
    let unit = units::<N>(platform, legs);
    let (f, jacobian) = linearised::<3, N>(platform, legs, x);
    let matrix = DMatrix::from_fn(N, N, |i, k| jacobian[(i, k)] * unit[k]);
    let finite = matrix.iter().chain(f.iter()).all(|x| x.is_finite());
    finite.then(|| (DVector::from_column_slice(f.as_slice()), matrix.svd(true, true)))
}

/// Whether the real point x is far from e = 0, where there is no rotation.
fn is_rotation<const V: usize>(x: &Point<V>) -> bool {
    const FAR: f64 = 1e-7;
    (0..4).any(|k| x.re[k].abs() > FAR)
}

/// Whether the platform can move away from a pose with its actuators locked. *Numerical*: a pose is looked
/// for a twentieth of a radian, or of the longest leg, away in the direction that the leg equations resist
/// least, to rounding.
fn moves<const N: usize>(platform: Platform, legs: &[Locked], pose: [f64; N]) -> bool {
    const STEP: f64 = 0.05;
    let unit = units::<N>(platform, legs);
    let Some((_, svd)) = scaled::<N>(platform, legs, &pose) else { return false };
    let Some(directions) = &svd.v_t else { return false };
    let away = directions.row(svd.singular_values.imin());
    let ahead = std::array::from_fn(|k| pose[k] + STEP * unit[k] * away[k]);
    // Across the curve only: it is not run back along.
    let Some(x) = onto::<N>(platform, legs, ahead) else { return false };
    let gap = (0..N).map(|k| ((x[k] - pose[k]) / unit[k]).powi(2)).sum::<f64>().sqrt();
    // A pose of its own would be regular.
    let singular = scaled::<N>(platform, legs, &x)
        .is_some_and(|(_, svd)| svd.singular_values.min() < SINGULAR * svd.singular_values.max());
    singular && gap > 0.5 * STEP && rounds_to_zero::<3, N>(platform, legs, &x)
}
