//! A body in the plane on three legs: the 3-RPR problem, at most six poses.

use super::bernstein::{Arc, Piece, isolate};
use super::eliminant::TrigonometricCubic;
use super::locked::Locked;
use super::triangle::{Complex, Triangle, conjugate_times, times};
use super::{Roots, SelfMotion, cluster};
use aspecta_robot::num::{Ball, Interval, Scalar};

/// Half a circle of orientations: z = (2ab + i (b² − a²)) / (a² + b²) · ζ with a = 1 − τ, b = τ ∈ [0, 1].
#[derive(Clone, Copy, Debug)]
struct Chart {
    zeta: Complex<f64>,
    eliminant: Arc<7>,
}

impl Chart {
    /// The half circles round ζ and −ζ of an eliminant turned by ζ, if the signs at their ends are known.
    fn pair(zeta: Complex<f64>, turned: &TrigonometricCubic<Ball>) -> Option<[Self; 2]> {
        let chart = |zeta, eliminant: &TrigonometricCubic<Ball>| {
            let coefficients = eliminant.bernstein();
            let slack = coefficients.iter().map(|c| c.rad).fold(0.0, f64::max);
            Self { zeta, eliminant: Arc::new(coefficients.map(|c| c.mid), slack) }
        };
        let near = chart(zeta, turned);
        let both = || [near, chart([-zeta[0], -zeta[1]], &turned.opposite())];
        near.eliminant.has_decided_ends().then(both)
    }

    fn direction(&self, tau: f64) -> Complex<f64> {
        let (a, b) = (1.0 - tau, tau);
        let n = 1.0 / (a * a + b * b);
        times(self.zeta, [2.0 * a * b * n, (b - a) * (b + a) * n])
    }

    /// The orientations between two values of τ, a little widened: τ and z carry some roundings.
    fn orientations(&self, lo: f64, hi: f64) -> Interval {
        const ROUNDINGS: f64 = 256.0 * f64::EPSILON;
        let (from, to) = (self.direction(lo), self.direction(hi));
        let [dot, cross] = conjugate_times(from, to);
        let start = from[1].atan2(from[0]);
        Interval::new(start - ROUNDINGS, start + cross.max(0.0).atan2(dot) + ROUNDINGS)
    }
}

/// Two half circles on whose ends the sign of F is known, so that no root sits on a cut; `None` if F is
/// within rounding of zero wherever the circle is cut.
fn charts(eliminant: &TrigonometricCubic<Ball>) -> Option<[Chart; 2]> {
    // With the real axis, directions of seven pairs of ends, of which six roots spoil at most six.
    const TURNS: [Complex<f64>; 6] = [
        [0.8, 0.6],
        [0.6, 0.8],
        [12.0 / 13.0, 5.0 / 13.0],
        [5.0 / 13.0, 12.0 / 13.0],
        [15.0 / 17.0, 8.0 / 17.0],
        [8.0 / 17.0, 15.0 / 17.0],
    ];
    // The decimal's interval holds the unit vector itself.
    let turned = |zeta: Complex<f64>| eliminant.turned(zeta.map(|x| Ball::constant(Interval::decimal(x))));
    Chart::pair([1.0, 0.0], eliminant)
        .or_else(|| TURNS.into_iter().find_map(|zeta| Chart::pair(zeta, &turned(zeta))))
}

/// Returns all poses of a plane body whose `legs` are locked.
pub(super) fn solve(legs: &[Locked]) -> Result<Roots<3>, SelfMotion> {
    let triangle = Triangle::new(legs);
    let numeric = triangle.over();
    let mut roots = Roots::none();
    let Some(charts) = charts(&triangle.over::<Ball>().eliminant()) else {
        let circle = Interval::new(-Interval::PI.hi, Interval::PI.hi);
        cluster::resolve(legs, &triangle, circle, &mut roots)?;
        return Ok(roots);
    };
    for chart in &charts {
        for piece in &isolate(chart.eliminant) {
            match piece {
                Piece::Root(arc) => {
                    if let Some(pose) = pose(&numeric, chart, arc) {
                        roots.push(pose)?;
                        roots.at_most = roots.at_most.map(|n| n + 1);
                    } else {
                        cluster::resolve(legs, &triangle, chart.orientations(arc.lo, arc.hi), &mut roots)?;
                    }
                }
                Piece::Cluster(lo, hi) => {
                    cluster::resolve(legs, &triangle, chart.orientations(*lo, *hi), &mut roots)?;
                }
            }
        }
    }
    Ok(roots)
}

/// The one pose with an orientation on `arc`: from the root of F, polished on the leg equations. `None` if
/// Newton's method leaves the arc, for then it has found another pose.
fn pose(triangle: &Triangle<f64>, chart: &Chart, arc: &Arc<7>) -> Option<[f64; 3]> {
    let (from, to) = (chart.direction(arc.lo), chart.direction(arc.hi));
    let follows = |a, b| conjugate_times(a, b)[1] >= -1e-14;
    [1e-4, 1e-15].into_iter().find_map(|tolerance| {
        let z = chart.direction(arc.root(tolerance));
        let (u, z) = triangle.polish(triangle.reach(z), z);
        (follows(from, z) && follows(z, to)).then(|| triangle.pose(z, u))
    })
}
