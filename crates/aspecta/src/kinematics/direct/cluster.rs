//! Orientations at which the eliminant of a plane body cannot be told from zero.
//!
//! The eliminant F has a double root for two reasons: two poses meet (a parallel singularity), or two poses of
//! one orientation, far apart and each regular, make both linear equations one (Δ = 0). To the second, F is
//! blind: it takes the whole system to count the poses, here by the Krawczyk operator over boxes.

use super::certify::{Verdict, judge};
use super::locked::{Locked, polish, rounds_to_zero};
use super::planar_body::{Lines, Triangle, norm2, times};
use super::{Roots, SelfMotion};
use crate::num::{Interval, Scalar};
use crate::robot::Platform;
use arrayvec::ArrayVec;

/// What is known of the poses with an orientation in some range.
enum Known {
    /// There are none, or at most one in each of these boxes.
    Boxes(ArrayVec<[Interval; 3], 2>),
    /// Not enough: cut the range.
    Open {
        /// Whether no equation ties down (x, y) but ‖u‖ = R₁.
        free: bool,
    },
}

/// Adds to `roots` the poses with orientation in `phi` and counts them if it can.
///
/// The range is cut until every part is settled or more than a few parts stay open at once, which is what
/// poses that meet do; the solutions there are then approximated and their number stays open.
pub(super) fn resolve(
    legs: &[Locked],
    triangle: &Triangle<Interval>,
    numeric: &Triangle<f64>,
    phi: Interval,
    roots: &mut Roots<3>,
) -> Result<(), SelfMotion> {
    const MOST_OPEN: usize = 32;
    const FINEST: f64 = 1e-14;
    /// Six poses of one orientation spread no wider when the equations are off by a rounding.
    const WIDEST: f64 = 0.05;
    let mut open: Vec<Interval> = vec![phi];
    loop {
        let mut parts = Vec::new();
        for &phi in &open {
            match examine(legs, triangle, phi) {
                Known::Boxes(boxes) => {
                    for region in &boxes {
                        roots.at_most = roots.at_most.map(|n| n + 1);
                        let middle = region.map(Interval::mid);
                        roots.push(polish::<2, 3>(Platform::PlaneBody, legs, middle, f64::INFINITY))?;
                    }
                }
                Known::Open { free: true } if phi.width() < FINEST => return Err(SelfMotion),
                Known::Open { .. } => {
                    // Off the middle, where symmetric robots like to have their solutions.
                    let cut = phi.lo + 0.47 * (phi.hi - phi.lo);
                    parts.extend([Interval::new(phi.lo, cut), Interval::new(cut, phi.hi)]);
                }
            }
        }
        open = parts;
        let Some(first) = open.first() else { return Ok(()) };
        if open.len() > MOST_OPEN || first.width() < FINEST {
            break;
        }
    }
    let left = open.into_iter().reduce(Interval::hull).unwrap_or(phi);
    if left.width() > WIDEST {
        return Err(SelfMotion);
    }
    approximate(legs, numeric, left, roots)
}

fn examine(legs: &[Locked], triangle: &Triangle<Interval>, phi: Interval) -> Known {
    let (sin, cos) = phi.sin_cos();
    let z = [cos, sin];
    let Lines { w, g } = triangle.lines(z);
    let mut boxes = ArrayVec::new();
    let misses = |i: usize| (triangle.r2 * norm2(w[i]) - g[i].square()).is_negative();
    if (0..3).any(misses) {
        return Known::Boxes(boxes);
    }
    let best = (0..3).reduce(|a, b| if norm2(w[a]).lo >= norm2(w[b]).lo { a } else { b }).unwrap_or(0);
    let length2 = norm2(w[best]);
    if !length2.is_positive() {
        return Known::Open { free: (0..3).all(|i| g[i].contains(0.0)) };
    }
    // u = w (along ± i across), across² = R₁²/‖w‖² − along².
    let along = g[best] / length2;
    let across2 = triangle.r2 / length2 - along.square();
    let across = across2.sqrt();
    let sides: ArrayVec<Interval, 2> = if across2.is_positive() {
        [across, -across].into()
    } else {
        std::iter::once(across.hull(-across)).collect()
    };
    for side in sides {
        let u = times(w[best], [along, side]);
        let on_line = |i: usize| (u[0] * w[i][0] + u[1] * w[i][1] - g[i]).contains(0.0);
        if !(0..3).all(on_line) {
            continue;
        }
        let [x, y] = triangle.position(z, u);
        // K(X) in the interior of X wants a little air round the poses.
        let air = |a: Interval| a + Interval::new(-0.1, 0.1) * Interval::point(a.width());
        match judge::<2, 3>(Platform::PlaneBody, legs, &[x, y, phi].map(air)) {
            Verdict::None => {}
            Verdict::One(at) if at[2].hi < phi.lo || phi.hi < at[2].lo => {}
            Verdict::One(at) => boxes.push(at),
            Verdict::Unknown => return Known::Open { free: false },
        }
    }
    Known::Boxes(boxes)
}

/// The poses near orientations `phi` at which the equations hold to rounding.
fn approximate(
    legs: &[Locked],
    triangle: &Triangle<f64>,
    phi: Interval,
    roots: &mut Roots<3>,
) -> Result<(), SelfMotion> {
    roots.at_most = None;
    // Newton's method closes in on two poses that meet from outside, one from either side.
    for angle in [phi.lo, phi.hi, phi.mid()] {
        let (sin, cos) = angle.sin_cos();
        let Lines { w, g } = triangle.lines([cos, sin]);
        let best = (0..3).reduce(|a, b| if norm2(w[a]) >= norm2(w[b]) { a } else { b }).unwrap_or(0);
        for side in [1.0, -1.0] {
            let u = triangle.on_circle(w[best], g[best], side);
            let [x, y] = triangle.position([cos, sin], u);
            let pose = polish::<2, 3>(Platform::PlaneBody, legs, [x, y, angle], 2.0 * phi.width());
            if rounds_to_zero::<2, 3>(Platform::PlaneBody, legs, &pose) {
                roots.push_new(Platform::PlaneBody, legs, pose)?;
            }
        }
    }
    Ok(())
}
