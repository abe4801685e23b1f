//! The leg equations of a plane body with its position eliminated.

use super::triangle::{Complex, Triangle, conjugate_times, minus, norm2, number, plus, scaled, times};
use aspecta_robot::num::{Interval, Scalar};

impl<T: Scalar> Triangle<T> {
    /// F(φ) = ‖G‖² − R₁² Δ² with G = g₂ w₃ − g₃ w₂ and Δ = w₂ × w₃, a trigonometric polynomial of degree 3.
    ///
    /// Where Δ ≠ 0 the linear equations have the one solution u = −i G / Δ, so F = 0 is then ‖u‖² = R₁².
    /// Where Δ = 0, F = 0 says that they are consistent; u is then one of up to two points of a line, and F
    /// has a double root, for both squares vanish. Hence *a simple root of F is exactly one pose*, and an
    /// orientation that is no root has none. Up to a factor, F is the Cayley-Menger determinant of the four
    /// points of the plane that the problem asks for.
    ///
    /// G = Σ Gₙ zⁿ, n = −1 … 2, so degree 4 cannot occur.
    pub fn eliminant(&self) -> TrigonometricCubic<T> {
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
        let turned = double(scaled(mu, self.r2[0] * delta));
        TrigonometricCubic {
            mean: g.into_iter().map(norm2).reduce(|a, b| a + b).unwrap_or_else(T::zero)
                - self.r2[0] * (delta.square() + norm2(mu) * number(0.5)),
            harmonics: [
                plus(double(h(1)), [-turned[1], turned[0]]),
                plus(double(h(2)), scaled(times(mu, mu), self.r2[0] * number(0.5))),
                double(h(3)),
            ],
        }
    }
}

/// F = mean + Re Σ hₙ zⁿ, n = 1 … 3.
#[derive(Clone, Copy, Debug)]
pub(super) struct TrigonometricCubic<T> {
    mean: T,
    harmonics: [Complex<T>; 3],
}

impl<T: Scalar> TrigonometricCubic<T> {
    /// z replaced by z ζ, |ζ| = 1.
    pub fn turned(&self, zeta: Complex<T>) -> Self {
        let zeta2 = times(zeta, zeta);
        let [a, b, c] = self.harmonics;
        Self { mean: self.mean, harmonics: [times(a, zeta), times(b, zeta2), times(c, times(zeta, zeta2))] }
    }

    /// φ replaced by φ + π.
    pub fn opposite(&self) -> Self {
        let [a, b, c] = self.harmonics;
        Self { mean: self.mean, harmonics: [a.map(|x| -x), b, c.map(|x| -x)] }
    }

    /// Bernstein coefficients on the half circle −π/2 ≤ φ ≤ π/2 of F (a² + b²)³, where a = 1 − τ, b = τ and
    /// z = (2ab + i (b² − a²)) / (a² + b²): the half-angle substitution, with both ends at finite τ.
    pub fn bernstein(&self) -> [T; 7] {
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
