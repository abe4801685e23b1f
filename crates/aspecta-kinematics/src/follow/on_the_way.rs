//! Enclosures of functions over a tube: along a stretch, t ∈ [0, 1].

use aspecta_robot::num::{Ball, Scalar, Slope};

const ZERO: Ball = Ball::point(0.0);

/// A scalar that encloses a function over the tube.
pub(super) trait OnTheWay: Scalar {
    /// A number that is the same all along.
    fn fixed(x: Ball) -> Self;

    /// (1 − t) `back` + `noise`.
    fn on_the_way(back: Ball, noise: Ball) -> Self;

    /// Encloses all values.
    fn range(self) -> Ball;

    /// The integral over [t, 1], for every t.
    fn so_far(self) -> Ball;

    /// (sin, cos) of a small angle.
    fn small_sin_cos(self) -> (Self, Self);
}

/// A ball, which does not depend on the place on the way.
impl OnTheWay for Ball {
    #[inline(always)]
    fn fixed(x: Ball) -> Self {
        x
    }
    #[inline(always)]
    fn on_the_way(back: Ball, noise: Ball) -> Self {
        back.towards_zero() + noise
    }
    #[inline(always)]
    fn range(self) -> Ball {
        self
    }
    #[inline(always)]
    fn so_far(self) -> Ball {
        self.towards_zero()
    }
    #[inline(always)]
    fn small_sin_cos(self) -> (Self, Self) {
        Ball::small_sin_cos(self)
    }
}

/// A function of the place on the way: linear in t, with a remainder.
impl OnTheWay for Slope<Ball, 1> {
    fn fixed(x: Ball) -> Self {
        Self { range: x, centre: x, slope: [ZERO] }
    }
    fn on_the_way(back: Ball, noise: Ball) -> Self {
        let half = back * Ball::point(0.5);
        Self { range: back.towards_zero() + noise, centre: half + noise, slope: [half] }
    }
    fn range(self) -> Ball {
        self.tightened().range
    }
    /// With τ = 1 − 2t' the function is g + m τ + r(τ) τ, |r(τ)| ≤ rad. Over [t, 1] g gives (1 − t) g, m τ
    /// gives m t (1 − t), at most a quarter of m, and the rest at most rad ∫|τ| dt' = rad / 2.
    fn so_far(self) -> Ball {
        let m = self.slope[0];
        let bound = Ball::about_zero(0.25 * m.mid.abs()) + Ball::about_zero(0.5 * m.rad);
        (self.centre.towards_zero() + bound).narrower(self.range().towards_zero())
    }
    fn small_sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.range.small_sin_cos();
        let (sin_c, cos_c) = self.centre.small_sin_cos();
        // By the mean-value theorem the quotients lie in the range of the derivative.
        (self.chain(sin, sin_c, cos), self.chain(cos, cos_c, -sin))
    }
}
