//! The geometry of a plane body on three locked legs.

use super::locked::Locked;
use aspecta_robot::num::{Interval, Scalar};

/// A vector of the plane as a complex number (re, im).
pub(super) type Complex<T> = [T; 2];

#[inline(always)]
pub(super) fn plus<T: Scalar>(a: Complex<T>, b: Complex<T>) -> Complex<T> {
    [a[0] + b[0], a[1] + b[1]]
}

#[inline(always)]
pub(super) fn minus<T: Scalar>(a: Complex<T>, b: Complex<T>) -> Complex<T> {
    [a[0] - b[0], a[1] - b[1]]
}

#[inline(always)]
pub(super) fn times<T: Scalar>(a: Complex<T>, b: Complex<T>) -> Complex<T> {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// ā b = (a · b) + i (a × b).
#[inline(always)]
pub(super) fn conjugate_times<T: Scalar>(a: Complex<T>, b: Complex<T>) -> Complex<T> {
    [a[0] * b[0] + a[1] * b[1], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
pub(super) fn norm2<T: Scalar>(a: Complex<T>) -> T {
    a[0].square() + a[1].square()
}

#[inline(always)]
pub(super) fn dot<T: Scalar>(a: Complex<T>, b: Complex<T>) -> T {
    a[0] * b[0] + a[1] * b[1]
}

#[inline(always)]
pub(super) fn scaled<T: Scalar>(a: Complex<T>, c: T) -> Complex<T> {
    [a[0] * c, a[1] * c]
}

#[inline(always)]
pub(super) fn number<T: Scalar>(c: f64) -> T {
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
    pub e: [Complex<T>; 2],
    /// Dᵢ = Pᵢ − P₁.
    pub d: [Complex<T>; 2],
    /// (Rᵢ² − R₁² − ‖eᵢ‖² − ‖Dᵢ‖²)/2, so that gᵢ = kᵢ + D̄ᵢ eᵢ · z̄ (real part).
    pub k: [T; 2],
    /// Rᵢ², i = 1, 2, 3.
    pub r2: [T; 3],
}

/// u · wᵢ = gᵢ at one orientation, for i = 2, 3, and their difference.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lines<T> {
    pub w: [Complex<T>; 3],
    pub g: [T; 3],
}

impl Triangle<Interval> {
    pub fn new(legs: &[Locked]) -> Self {
        let base = |j: usize| [legs[j].leg.anchor[0], legs[j].leg.anchor[1]];
        let attachment = |j: usize| [legs[j].leg.attachment[0], legs[j].leg.attachment[1]];
        let r2 = [0, 1, 2].map(|j| legs[j].q.square());
        let e = [1, 2].map(|j| minus(attachment(j), attachment(0)));
        let d = [1, 2].map(|j| minus(base(j), base(0)));
        let k = [0, 1].map(|i| (r2[i + 1] - r2[0] - norm2(e[i]) - norm2(d[i])) * Interval::point(0.5));
        Self { base: base(0), attachment: attachment(0), e, d, k, r2 }
    }

    /// Converts the triangle to another scalar; `f64` takes the middle.
    pub fn over<T: Scalar>(&self) -> Triangle<T> {
        let vector = |a: Complex<Interval>| a.map(T::constant);
        Triangle {
            base: vector(self.base),
            attachment: vector(self.attachment),
            e: self.e.map(vector),
            d: self.d.map(vector),
            k: self.k.map(T::constant),
            r2: self.r2.map(T::constant),
        }
    }
}

impl<T: Scalar> Triangle<T> {
    /// The linear equations for u at the orientation z = (cos φ, sin φ).
    pub fn lines(&self, z: Complex<T>) -> Lines<T> {
        let arms = [times(self.e[0], z), times(self.e[1], z)];
        let w = [minus(arms[0], self.d[0]), minus(arms[1], self.d[1])];
        let g = [self.k[0] + dot(self.d[0], arms[0]), self.k[1] + dot(self.d[1], arms[1])];
        Lines { w: [w[0], w[1], minus(w[1], w[0])], g: [g[0], g[1], g[1] - g[0]] }
    }

    /// The lines as functions of φ, each number of them as `jet` makes it of its value and its first two
    /// derivatives: z′ = i z, so that products of jets, mostly of zeros, are not needed.
    pub fn lines_in_phi<U: Scalar>(&self, z: Complex<T>, jet: impl Fn([T; 3]) -> U) -> Lines<U> {
        let arms = [times(self.e[0], z), times(self.e[1], z)];
        let turned = arms.map(|[re, im]| [-im, re]);
        let w = [0, 1].map(|i| {
            let part = |k: usize| jet([arms[i][k] - self.d[i][k], turned[i][k], -arms[i][k]]);
            [part(0), part(1)]
        });
        let g = [0, 1].map(|i| {
            let along = dot(self.d[i], arms[i]);
            jet([self.k[i] + along, dot(self.d[i], turned[i]), -along])
        });
        Lines { w: [w[0], w[1], minus(w[1], w[0])], g: [g[0], g[1], g[1] - g[0]] }
    }

    /// (x, y) from z and u.
    pub fn position(&self, z: Complex<T>, u: Complex<T>) -> Complex<T> {
        minus(plus(self.base, u), times(self.attachment, z))
    }

    /// The point of the line u · w = g on the circle ‖u‖² = R₁², on the left of w (`side` = 1) or on the
    /// right (−1); the nearest point of the line if it misses the circle.
    pub fn on_circle(&self, w: Complex<T>, g: T, side: f64) -> Complex<T> {
        let along = g / norm2(w);
        let across = (self.r2[0] / norm2(w) - along.square()).sqrt() * number(side);
        times(w, [along, across])
    }
}

impl Triangle<f64> {
    /// The pose (x, y, φ) from z and u.
    pub fn pose(&self, z: Complex<f64>, u: Complex<f64>) -> [f64; 3] {
        let [x, y] = self.position(z, u);
        [x, y, z[1].atan2(z[0])]
    }

    /// Σ |sᵢ² − Rᵢ²|, with s₁ = u and sᵢ = u + wᵢ.
    pub fn residual(&self, u: Complex<f64>, z: Complex<f64>) -> f64 {
        let Lines { w, .. } = self.lines(z);
        let s = [u, plus(u, w[0]), plus(u, w[1])];
        (0..3).map(|i| (norm2(s[i]) - self.r2[i]).abs()).sum()
    }

    /// Newton's method from (u, z) on sᵢ² = Rᵢ², with s₁ = u and sᵢ = u + wᵢ: the best iterate. It stops
    /// after the first step so small that the next, quadratically smaller, is lost in rounding.
    pub fn polish(&self, mut u: Complex<f64>, mut z: Complex<f64>) -> (Complex<f64>, Complex<f64>) {
        const MOST_STEPS: usize = 12;
        const SMALL_STEP: f64 = 1e-10;
        let longest = self.r2.iter().fold(0.0, |a: f64, r2| a.max(*r2)).sqrt();
        let cross = |a, b| conjugate_times(a, b)[1];
        let (mut best, mut least) = ((u, z), f64::INFINITY);
        for _ in 0..MOST_STEPS {
            let arms = self.e.map(|e| times(e, z));
            let s = [u, minus(plus(u, arms[0]), self.d[0]), minus(plus(u, arms[1]), self.d[1])];
            let f: [f64; 3] = std::array::from_fn(|i| 0.5 * (norm2(s[i]) - self.r2[i]));
            let residual = f.iter().fold(0.0, |a: f64, f| a.max(f.abs()));
            if residual >= least || residual.is_nan() {
                break;
            }
            (best, least) = ((u, z), residual);
            // Rows of the Jacobian: (sᵢ, momentᵢ), the first moment being zero. Cramer's rule.
            let moment = [cross(arms[0], s[1]), cross(arms[1], s[2])];
            let (s12, s13, s23) = (cross(s[0], s[1]), cross(s[0], s[2]), cross(s[1], s[2]));
            let turn = (f[0] * s23 - f[1] * s13 + f[2] * s12) / (moment[1] * s12 - moment[0] * s13);
            let (k, area) = if s12.abs() > s13.abs() { (1, s12) } else { (2, s13) };
            let rest = f[k] - moment[k - 1] * turn;
            let step = [(f[0] * s[k][1] - rest * u[1]) / area, (rest * u[0] - f[0] * s[k][0]) / area];
            u = minus(u, step);
            // e^(−i turn), to third order.
            z = times(z, [1.0, -turn]);
            z = scaled(z, 1.0 / norm2(z).sqrt());
            if turn.abs() < SMALL_STEP && step[0].abs().max(step[1].abs()) < SMALL_STEP * longest {
                return (u, z);
            }
        }
        best
    }

    /// u at a root of F: −i G / Δ, or where Δ is all but zero the point of the better of the lines u · wᵢ =
    /// gᵢ that lies on the circle and on the same side.
    pub fn reach(&self, z: Complex<f64>) -> Complex<f64> {
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
