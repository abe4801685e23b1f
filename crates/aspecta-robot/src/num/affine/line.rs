//! Functions of one coordinate of a box.

use super::super::lanes::ROUNDING;
use super::super::{Interval, Scalar};
use super::UNDERFLOW;

/// An affine form of one variable over one box: one coordinate, or a function of it.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    pub(super) range: Interval,
    pub(super) centre: f64,
    pub(super) slope: f64,
    pub(super) radius: f64,
}

impl Line {
    /// middle + radius t.
    pub fn variable(middle: f64, radius: f64) -> Self {
        let range = Interval::point(middle) + Interval::new(-radius, radius);
        Self { range, centre: middle, slope: radius, radius: 0.0 }
    }

    /// (sin, cos) of middle + radius t.
    pub fn turn(middle: f64, radius: f64) -> (Self, Self) {
        let [sin, cos] = Curve::turn(middle, radius).map(|Curve { factor, value, over }| {
            let (centre, slope) = (value.mid(), factor * radius);
            let loose = (value - Interval::point(centre)).magnitude();
            let radius = (loose + slope.abs() * ROUNDING) * (1.0 + ROUNDING) + UNDERFLOW;
            Self { range: over, centre, slope, radius }
        });
        (sin, cos)
    }
}

/// A function of x near c: within `value` + `factor` (x − c), and within `over`.
pub(super) struct Curve {
    pub(super) factor: f64,
    pub(super) value: Interval,
    pub(super) over: Interval,
}

impl Curve {
    /// sin and cos of x with |x − c| ≤ ρ.
    ///
    /// By Taylor, sin x = sin c + cos c (x − c) − ½ sin ξ (x − c)²; or else its range, whichever is narrower.
    pub(super) fn turn(c: f64, rho: f64) -> [Self; 2] {
        let away = Interval::new(-rho, rho);
        let half_square = Interval::new(0.0, rho).square() * Interval::point(0.5);
        let (sin, cos) = Interval::point(c).sin_cos();
        let (sin_over, cos_over) = (Interval::point(c) + away).sin_cos();
        let wave = |at: Interval, derivative: Interval, over: Interval| {
            let factor = derivative.mid();
            let value = at + (derivative - Interval::point(factor)) * away - half_square * over;
            let (factor, value) = if value.width() < over.width() { (factor, value) } else { (0.0, over) };
            Self { factor, value, over }
        };
        [wave(sin, cos, sin_over), wave(cos, -sin, cos_over)]
    }
}
