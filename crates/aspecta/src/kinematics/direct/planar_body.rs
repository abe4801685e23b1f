//! A body in the plane on three legs: the 3-RPR problem, at most six poses.

use super::bernstein::{Arc, Piece, isolate};
use super::locked::{Locked, polish};
use super::{Roots, SelfMotion, cluster};
use crate::num::{Interval, Scalar};
use crate::robot::Platform;

/// A vector of the plane as a complex number (re, im).
pub(super) type Complex<T> = [T; 2];

pub(super) fn plus<T: Scalar>(a: Complex<T>, b: Complex<T>) -> Complex<T> {
    [a[0] + b[0], a[1] + b[1]]
}

pub(super) fn minus<T: Scalar>(a: Complex<T>, b: Complex<T>) -> Complex<T> {
    [a[0] - b[0], a[1] - b[1]]
}

pub(super) fn times<T: Scalar>(a: Complex<T>, b: Complex<T>) -> Complex<T> {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// ā b = (a · b) + i (a × b).
pub(super) fn conjugate_times<T: Scalar>(a: Complex<T>, b: Complex<T>) -> Complex<T> {
    [a[0] * b[0] + a[1] * b[1], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn norm2<T: Scalar>(a: Complex<T>) -> T {
    a[0].square() + a[1].square()
}

pub(super) fn dot<T: Scalar>(a: Complex<T>, b: Complex<T>) -> T {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn scaled<T: Scalar>(a: Complex<T>, c: T) -> Complex<T> {
    [a[0] * c, a[1] * c]
}

fn number<T: Scalar>(c: f64) -> T {
    T::constant(Interval::point(c))
}

/// The three locked legs, seen from the first: with u = C₁ − P₁ and z = e^{iφ}, Cᵢ − Pᵢ = u + eᵢ z − Dᵢ.
/// Subtracting the first leg equation from the others leaves, with wᵢ = eᵢ z − Dᵢ,
///
/// > u · wᵢ = gᵢ = (Rᵢ² − R₁² − ‖wᵢ‖²)/2,  i = 2, 3,   and   ‖u‖² = R₁².
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle<T> {
    /// P₁.
    base: Complex<T>,
    /// c₁.
    attachment: Complex<T>,
    /// eᵢ = cᵢ − c₁.
    e: [Complex<T>; 2],
    /// Dᵢ = Pᵢ − P₁.
    d: [Complex<T>; 2],
    /// (Rᵢ² − R₁² − ‖eᵢ‖² − ‖Dᵢ‖²)/2, so that gᵢ = kᵢ + D̄ᵢ eᵢ · z̄ (real part).
    k: [T; 2],
    /// R₁².
    pub r2: T,
}

/// u · wᵢ = gᵢ at one orientation, for i = 2, 3, and their difference.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lines<T> {
    pub w: [Complex<T>; 3],
    pub g: [T; 3],
}

impl Triangle<Interval> {
    fn new(legs: &[Locked]) -> Self {
        let base = |j: usize| [legs[j].leg.anchor[0], legs[j].leg.anchor[1]];
        let attachment = |j: usize| [legs[j].leg.attachment[0], legs[j].leg.attachment[1]];
        let r2 = |j: usize| legs[j].q.square();
        let e = [1, 2].map(|j| minus(attachment(j), attachment(0)));
        let d = [1, 2].map(|j| minus(base(j), base(0)));
        let k = [0, 1].map(|i| (r2(i + 1) - r2(0) - norm2(e[i]) - norm2(d[i])) * Interval::point(0.5));
        Self { base: base(0), attachment: attachment(0), e, d, k, r2: r2(0) }
    }

    /// The same over another scalar; `f64` takes the middle.
    pub fn over<T: Scalar>(&self) -> Triangle<T> {
        let vector = |a: Complex<Interval>| a.map(T::constant);
        Triangle {
            base: vector(self.base),
            attachment: vector(self.attachment),
            e: self.e.map(vector),
            d: self.d.map(vector),
            k: self.k.map(T::constant),
            r2: T::constant(self.r2),
        }
    }
}

impl<T: Scalar> Triangle<T> {
    /// The linear equations for u at the orientation z = (cos φ, sin φ).
    pub fn lines(&self, z: Complex<T>) -> Lines<T> {
        let w = [0, 1].map(|i| minus(times(self.e[i], z), self.d[i]));
        let g = [0, 1].map(|i| self.k[i] + conjugate_times(self.d[i], times(self.e[i], z))[0]);
        Lines { w: [w[0], w[1], minus(w[1], w[0])], g: [g[0], g[1], g[1] - g[0]] }
    }

    /// (x, y) from z and u.
    pub fn position(&self, z: Complex<T>, u: Complex<T>) -> Complex<T> {
        minus(plus(self.base, u), times(self.attachment, z))
    }

    /// The point of the line u · w = g on the circle ‖u‖² = R₁², on the left of w (`side` = 1) or on the right
    /// (−1); the nearest point of the line if it misses the circle.
    pub fn on_circle(&self, w: Complex<T>, g: T, side: f64) -> Complex<T> {
        let along = g / norm2(w);
        let across = (self.r2 / norm2(w) - along.square()).sqrt() * number(side);
        times(w, [along, across])
    }

    /// F(φ) = ‖G‖² − R₁² Δ² with G = g₂ w₃ − g₃ w₂ and Δ = w₂ × w₃, a trigonometric polynomial of degree 3.
    ///
    /// Where Δ ≠ 0 the linear equations have the one solution u = −i G / Δ, so F = 0 is then ‖u‖² = R₁².
    /// Where Δ = 0, F = 0 says that they are consistent; u is then one of up to two points of a line, and F
    /// has a double root, for both squares vanish. Hence *a simple root of F is exactly one pose*, and an
    /// orientation that is no root has none. Up to a factor, F is the Cayley-Menger determinant of the four
    /// points of the plane that the problem asks for.
    ///
    /// G = Σ Gₙ zⁿ, n = −1 … 2, so degree 4 cannot occur.
    fn eliminant(&self) -> TrigonometricCubic<T> {
        let [e2, e3] = self.e;
        let [d2, d3] = self.d;
        let [k2, k3] = self.k;
        let half = |a: Complex<T>| a.map(|x| x * number(0.5));
        let conjugate = |a: Complex<T>| [a[0], -a[1]];
        let (m2, m3) = (conjugate_times(d2, e2), conjugate_times(d3, e3));
        let g = [
            half(times(times(d2, d3), conjugate(minus(e3, e2)))),
            plus(
                minus(scaled(d2, k3), scaled(d3, k2)),
                half(minus(conjugate_times(m2, e3), conjugate_times(m3, e2))),
            ),
            plus(minus(scaled(e3, k2), scaled(e2, k3)), half(minus(times(m3, d2), times(m2, d3)))),
            half(times(times(e2, e3), conjugate(minus(d2, d3)))),
        ];
        // ‖G‖² = H₀ + 2 Re Σ Hₙ zⁿ, Hₙ = Σ Gⱼ₊ₙ Ḡⱼ.
        let h = |n: usize| {
            (1..4 - n).fold(conjugate_times(g[0], g[n]), |s, j| plus(s, conjugate_times(g[j], g[j + n])))
        };
        // Δ = δ + Im(μ z), Δ² = δ² + ‖μ‖²/2 + Re(−2 i δ μ z) − Re(μ² z²)/2.
        let delta = conjugate_times(e2, e3)[1] + conjugate_times(d2, d3)[1];
        let mu = minus(conjugate_times(d3, e2), conjugate_times(d2, e3));
        let double = |a: Complex<T>| a.map(|x| x + x);
        let turned = double(scaled(mu, self.r2 * delta));
        TrigonometricCubic {
            mean: g.into_iter().map(norm2).reduce(|a, b| a + b).unwrap_or_else(T::zero)
                - self.r2 * (delta.square() + norm2(mu) * number(0.5)),
            harmonics: [
                plus(double(h(1)), [-turned[1], turned[0]]),
                plus(double(h(2)), scaled(times(mu, mu), self.r2 * number(0.5))),
                double(h(3)),
            ],
        }
    }
}

/// F = mean + Re Σ hₙ zⁿ, n = 1 … 3.
#[derive(Clone, Copy, Debug)]
struct TrigonometricCubic<T> {
    mean: T,
    harmonics: [Complex<T>; 3],
}

impl<T: Scalar> TrigonometricCubic<T> {
    /// z replaced by z ζ, |ζ| = 1.
    fn turned(&self, zeta: Complex<T>) -> Self {
        let zeta2 = times(zeta, zeta);
        let [a, b, c] = self.harmonics;
        Self { mean: self.mean, harmonics: [times(a, zeta), times(b, zeta2), times(c, times(zeta, zeta2))] }
    }

    /// φ replaced by φ + π.
    fn opposite(&self) -> Self {
        let [a, b, c] = self.harmonics;
        Self { mean: self.mean, harmonics: [a.map(|x| -x), b, c.map(|x| -x)] }
    }

    /// Bernstein coefficients on the half circle −π/2 ≤ φ ≤ π/2 of F (a² + b²)³, where a = 1 − τ, b = τ and
    /// z = (2ab + i (b² − a²)) / (a² + b²): the half-angle substitution, with both ends at finite τ.
    fn bernstein(&self) -> [T; 7] {
        // F = mean + Σ cₙ cos nφ + sₙ sin nφ.
        let [c1, c2, c3] = self.harmonics.map(|h| h[0]);
        let [s1, s2, s3] = self.harmonics.map(|h| -h[1]);
        let by = |x: T, c: f64| x * T::constant(Interval::decimal(c));
        let (even, odd) = (self.mean - c2, s1 - s3);
        let (even2, odd2) = (by(self.mean, 0.2) + by(c2, 1.0 / 3.0), by(s1, 1.0 / 15.0) + s3);
        let (even1, odd1) = (by(c1, 1.0 / 3.0) - c3, by(s2, 2.0 / 3.0));
        [even - odd, even1 - odd1, even2 - odd2, by(c1, 0.2) + c3, even2 + odd2, even1 + odd1, even + odd]
    }
}

/// Half a circle of orientations: z = (2ab + i (b² − a²)) / (a² + b²) · ζ with a = 1 − τ, b = τ ∈ [0, 1].
#[derive(Clone, Copy, Debug)]
struct Chart {
    zeta: Complex<f64>,
    eliminant: Arc<7>,
}

impl Chart {
    fn new(zeta: Complex<f64>, eliminant: &TrigonometricCubic<Interval>) -> Self {
        let coefficients = eliminant.bernstein();
        let radius = |c: &Interval| (c.hi - c.mid()).max(c.mid() - c.lo).next_up();
        let slack = coefficients.iter().map(radius).fold(0.0, f64::max);
        Self { zeta, eliminant: Arc::new(coefficients.map(Interval::mid), slack) }
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

/// Two half circles on whose ends the sign of F is known, so that no root sits on a cut; `None` if F is within
/// rounding of zero wherever the circle is cut.
fn charts(eliminant: &TrigonometricCubic<Interval>) -> Option<[Chart; 2]> {
    // Directions of rational points: seven pairs of ends, of which six roots spoil at most six.
    const CUTS: [Complex<f64>; 7] = [
        [1.0, 0.0],
        [0.8, 0.6],
        [0.6, 0.8],
        [12.0 / 13.0, 5.0 / 13.0],
        [5.0 / 13.0, 12.0 / 13.0],
        [15.0 / 17.0, 8.0 / 17.0],
        [8.0 / 17.0, 15.0 / 17.0],
    ];
    CUTS.into_iter().find_map(|zeta| {
        // Enough of an interval to hold the unit vector itself.
        let turned = eliminant.turned(zeta.map(Interval::decimal));
        let chart = Chart::new(zeta, &turned);
        let other = Chart::new([-zeta[0], -zeta[1]], &turned.opposite());
        chart.eliminant.has_decided_ends().then_some([chart, other])
    })
}

/// All poses of a plane body whose `legs` are locked.
pub(super) fn solve(legs: &[Locked]) -> Result<Roots<3>, SelfMotion> {
    let triangle = Triangle::new(legs);
    let numeric = triangle.over();
    let mut roots = Roots::none();
    let Some(charts) = charts(&triangle.eliminant()) else {
        let circle = Interval::new(-Interval::PI.hi, Interval::PI.hi);
        cluster::resolve(legs, &triangle, circle, &mut roots)?;
        return Ok(roots);
    };
    for chart in &charts {
        for piece in &isolate(chart.eliminant) {
            match piece {
                Piece::Root(arc) => {
                    if let Some(pose) = pose(legs, &numeric, chart, arc) {
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

/// The one pose with an orientation on `arc`: from the root of F, polished on the leg equations. `None` if Newton's
/// method leaves the arc, for then it has found another pose.
fn pose(legs: &[Locked], triangle: &Triangle<f64>, chart: &Chart, arc: &Arc<7>) -> Option<[f64; 3]> {
    let (from, to) = (chart.direction(arc.lo), chart.direction(arc.hi));
    let follows = |a, b| conjugate_times(a, b)[1] >= -1e-14;
    [1e-4, 1e-15].into_iter().find_map(|tolerance| {
        let z = chart.direction(arc.root(tolerance));
        let [x, y] = triangle.position(z, triangle.reach(z));
        let pose = polish::<2, 3>(Platform::PlaneBody, legs, [x, y, z[1].atan2(z[0])]);
        let (sin, cos) = pose[2].sin_cos();
        (follows(from, [cos, sin]) && follows([cos, sin], to)).then_some(pose)
    })
}

impl Triangle<f64> {
    /// u at a root of F: −i G / Δ, or where Δ is all but zero the point of the better of the lines u · wᵢ = gᵢ
    /// that lies on the circle and on the same side.
    fn reach(&self, z: Complex<f64>) -> Complex<f64> {
        let Lines { w, g } = self.lines(z);
        let area = conjugate_times(w[0], w[1])[1];
        let big = minus(scaled(w[1], g[0]), scaled(w[0], g[1]));
        if area.abs() > 1e-4 * (norm2(w[0]) * norm2(w[1])).sqrt() {
            return [big[1] / area, -big[0] / area];
        }
        let best = if norm2(w[0]) > norm2(w[1]) { 0 } else { 1 };
        let side = -conjugate_times(w[best], big)[0] * area;
        self.on_circle(w[best], g[best], side.signum())
    }
}
