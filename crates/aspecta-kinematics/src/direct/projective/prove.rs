//! Proofs that quadrics have a common point, and that points are different.

use super::Point;
use super::forms::Quadrics;
use super::linear::Factors;
use aspecta_robot::num::{Disc, Interval};
use nalgebra::Complex;

/// A ball in the affine chart x̄ · y = 1 of the centre x that is proved to hold exactly one common point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Proved<const V: usize> {
    pub centre: Point<V>,
    /// In the norm max |yₖ|.
    pub radius: f64,
}

/// Quadrics whose coefficients are known to lie in intervals.
pub(crate) type Enclosed<const V: usize, const F: usize> = [[[Interval; V]; V]; F];

impl<const V: usize> Proved<V> {
    /// Proves that F = V − 1 quadrics have exactly one common point near the approximate one `x`, for all
    /// coefficients in `forms`.
    ///
    /// *Theorem* (Kantorovich's idea; Moore's test in its a priori form). Let P be the map of the V − 1 forms
    /// and x̄ · y − 1, Y any matrix, and
    ///
    /// > η ≥ ‖Y P(x)‖,  κ ≥ ‖I − Y P′(x)‖,  μ ≥ ‖Y P″‖
    ///
    /// in the maximum norm. If η + κ r + μ r²/2 < r and κ + μ r < 1, then T(y) = y − Y P(y) maps the closed
    /// ball of radius r round x into itself and contracts it, because T′(y) = I − Y P′(x) − Y P″ (y − x), P″
    /// being constant: it holds exactly one zero of Y P, and Y is regular because κ < 1.
    ///
    /// If x and the coefficients are real the ball is its own conjugate, so its only point is real.
    pub fn near<const F: usize>(
        forms: &Enclosed<V, F>,
        approximate: &Quadrics<V, F>,
        x: &Point<V>,
    ) -> Option<Self> {
        let patch = x.conjugate();
        let at = approximate.at(x);
        let mut matrix = [patch; V];
        for k in 0..F {
            matrix[k] = at.halves[k].scaled(Complex::from(2.0));
        }
        let inverse = Factors::of(matrix)?.inverse();
        let here: [Disc; V] = std::array::from_fn(|k| Disc::point(x.re[k], x.im[k]));
        let (values, gradients, bends) = enclose(forms, &here, &patch);
        let (mut eta, mut kappa, mut mu) = (0.0f64, 0.0f64, 0.0f64);
        for i in 0..V {
            let y: [Disc; V] = std::array::from_fn(|k| Disc::point(inverse[k].re[i], inverse[k].im[i]));
            let mut shift = Disc::point(0.0, 0.0);
            let mut bend = 0.0;
            for k in 0..V {
                shift = shift + y[k] * values[k];
                bend = add_up(bend, y[k].magnitude() * bends[k]);
            }
            let mut defect = 0.0;
            for j in 0..V {
                let mut entry = Disc::point(if i == j { -1.0 } else { 0.0 }, 0.0);
                for k in 0..V {
                    entry = entry + y[k] * gradients[k][j];
                }
                defect = add_up(defect, entry.magnitude());
            }
            eta = eta.max(shift.magnitude());
            kappa = kappa.max(defect);
            mu = mu.max(bend);
        }
        let radius = 2.0 * eta;
        let image = add_up(add_up(eta, kappa * radius), 0.5 * mu * radius * radius);
        // Also false for NaN.
        (image < radius && add_up(kappa, mu * radius) < 1.0).then_some(Self { centre: *x, radius })
    }

    /// The coordinates of the point.
    pub fn coordinates(&self) -> [Disc; V] {
        std::array::from_fn(|k| Disc { re: self.centre.re[k], im: self.centre.im[k], rad: self.radius })
    }

    /// The proof of the conjugate point, which real forms have in common too.
    pub fn conjugate(&self) -> Self {
        Self { centre: self.centre.conjugate(), ..*self }
    }

    /// Whether the first four coordinates are proved to be a quaternion of a rotation: e · e ≠ 0.
    pub fn is_rotation(&self) -> bool {
        let x = self.coordinates();
        (1..4).fold(x[0] * x[0], |sum, k| sum + x[k] * x[k]).excludes_zero()
    }
}

/// a + b from above, b being a product that was rounded a few times; not less than 0.
fn add_up(a: f64, b: f64) -> f64 {
    (a + b) * (1.0 + 8.0 * f64::EPSILON) + f64::MIN_POSITIVE
}

/// P(x), P′(x) and bounds of P″ row by row.
fn enclose<const V: usize, const F: usize>(
    forms: &Enclosed<V, F>,
    x: &[Disc; V],
    patch: &Point<V>,
) -> ([Disc; V], [[Disc; V]; V], [f64; V]) {
    let zero = Disc::point(0.0, 0.0);
    let (mut values, mut gradients, mut bends) = ([zero; V], [[zero; V]; V], [0.0; V]);
    for (k, form) in forms.iter().enumerate() {
        for b in 0..V {
            let mut half = zero;
            for a in 0..V {
                if form[b][a] != Interval::point(0.0) {
                    half = half + Disc::from(form[b][a]) * x[a];
                    bends[k] = add_up(bends[k], 2.0 * form[b][a].magnitude());
                }
            }
            values[k] = values[k] + half * x[b];
            gradients[k][b] = half + half;
        }
    }
    let last = V - 1;
    values[last] = Disc::point(-1.0, 0.0);
    for k in 0..V {
        gradients[last][k] = Disc::point(patch.re[k], patch.im[k]);
        values[last] = values[last] + gradients[last][k] * x[k];
    }
    (values, gradients, bends)
}

/// Whether two proved points are different points of projective space: some minor of their coordinates is not
/// zero.
pub(crate) fn differ<const V: usize>(a: &Proved<V>, b: &Proved<V>) -> bool {
    let (x, y) = (a.coordinates(), b.coordinates());
    let size = |k: usize| a.centre.get(k).norm_sqr();
    let i = (0..V).fold(0, |best, k| if size(k) > size(best) { k } else { best });
    (0..V).any(|j| j != i && (x[i] * y[j] - x[j] * y[i]).excludes_zero())
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

    /// x₁ x₀ = 0, x₂ x₀ = 0 and x₃² − square x₀² = 0, which (1, 0, 0, ±√square) have in common.
    fn forms(square: Interval) -> Enclosed<4, 3> {
        let (zero, half) = (Interval::point(0.0), Interval::point(0.5));
        let mut forms = [[[zero; 4]; 4]; 3];
        for k in [0, 1] {
            (forms[k][0][k + 1], forms[k][k + 1][0]) = (half, half);
        }
        (forms[2][0][0], forms[2][3][3]) = (-square, Interval::point(1.0));
        forms
    }

    fn near(square: Interval, x: [f64; 4]) -> Option<Proved<4>> {
        let forms = forms(square);
        let middle = |c: &[Interval; 4]| Point::real(c.map(Interval::mid));
        let quadrics = Quadrics { forms: forms.each_ref().map(|form| form.each_ref().map(middle)) };
        Proved::near(&forms, &quadrics, &Point::real(x).normalised())
    }

    #[test]
    fn common_points_are_proved_and_told_apart() {
        let quarter = Interval::point(0.25);
        let [up, down] = [0.5, -0.5].map(|z| near(quarter, [1.0, 0.0, 0.0, z]).unwrap());
        assert!(differ(&up, &down) && !differ(&up, &up) && up.is_rotation());
        // From a little aside, too: the radius says how far.
        let aside = near(quarter, [1.0, 1e-6, 0.0, 0.5]).unwrap();
        assert!(aside.radius > 1e-7 && !differ(&aside, &up) && differ(&aside, &down));
    }

    #[test]
    fn what_is_not_there_is_not_proved() {
        for x in [UNIT, [0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 0.05], [1.0, 2.0, 0.0, 0.5]] {
            assert!(near(Interval::point(0.25), x).is_none(), "{x:?}");
        }
        // Double, nearly so, and not real at all.
        for square in [0.0, 1e-18, -0.25] {
            assert!(near(Interval::point(square), UNIT).is_none(), "{square}");
        }
        // One for some coefficients within the bounds, none or a double one for others.
        assert!(near(Interval::new(-0.1, 0.6), [1.0, 0.0, 0.0, 0.5]).is_none());
    }

    /// Wherever a ball is proved to hold one of the two points it does, and not the other.
    #[test]
    fn balls_hold_one_point() {
        let mut proved = 0;
        for i in -300..=300 {
            let z = f64::from(i) * 0.01;
            let Some(ball) = near(Interval::point(0.25), [1.0, 0.0, 0.0, z]) else { continue };
            let holds = |root: f64| {
                let (x, y) = (ball.centre.re, [1.0, 0.0, 0.0, root]);
                let scale: f64 = (0..4).map(|k| x[k] * y[k]).sum();
                (0..4).all(|k| (y[k] / scale - x[k]).abs() <= ball.radius * (1.0 + 1e-9))
            };
            assert!(holds(0.5) != holds(-0.5), "{z}");
            proved += 1;
        }
        assert!((50..500).contains(&proved), "{proved}");
    }

    #[test]
    fn null_quaternions_are_no_rotations() {
        let x = Point { re: [1.0, 0.0, 0.0, 0.0], im: [0.0, 1.0, 0.0, 0.0] };
        assert!(!Proved { centre: x, radius: 0.0 }.is_rotation());
    }
}
