//! Cubic splines through points: twice continuously differentiable.

/// Up to six coordinates, of which the first n count.
pub(super) type Point = [f64; 6];

/// The cubic spline through points at increasing knots. Its ends are *not-a-knot*: the first two pieces are
/// one cubic, and so are the last two, so that four points give the cubic through them, three the parabola,
/// two the straight line. Error O(h⁴) at knots h apart.
#[derive(Clone, Debug)]
pub(super) struct Spline {
    knots: Vec<f64>,
    points: Vec<Point>,
    /// The second derivatives at the knots.
    bends: Vec<Point>,
}

impl Spline {
    /// Through `points` at strictly increasing `knots`; at least two of them.
    pub fn new(knots: Vec<f64>, points: Vec<Point>) -> Self {
        let bends = bends(&knots, &points);
        Self { knots, points, bends }
    }

    /// The knots.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The piece, from 0, on which `s` lies; the first or the last beyond the ends.
    pub fn piece(&self, s: f64) -> usize {
        self.knots.partition_point(|knot| *knot <= s).clamp(1, self.knots.len() - 1) - 1
    }

    /// The value and its first two derivatives at `s`, by piece k.
    pub fn at(&self, k: usize, s: f64) -> [Point; 3] {
        let h = self.knots[k + 1] - self.knots[k];
        let t = (s - self.knots[k]) / h;
        let u = 1.0 - t;
        let mut out = [[0.0; 6]; 3];
        for i in 0..6 {
            let (p, q) = (self.points[k][i], self.points[k + 1][i]);
            let (m, n) = (self.bends[k][i] * h * h / 6.0, self.bends[k + 1][i] * h * h / 6.0);
            out[0][i] = u * p + t * q - m * u * t * (1.0 + u) - n * u * t * (1.0 + t);
            out[1][i] = (q - p - m * (3.0 * u * u - 1.0) + n * (3.0 * t * t - 1.0)) / h;
            out[2][i] = u * self.bends[k][i] + t * self.bends[k + 1][i];
        }
        out
    }
}

/// The second derivatives at the knots: M of h₋M₋ + 2(h₋ + h)M + hM₊ = 6(slope − slope₋), the third
/// derivative being continuous at the first and the last inner knot.
fn bends(knots: &[f64], points: &[Point]) -> Vec<Point> {
    let n = knots.len();
    let mut bends = vec![[0.0; 6]; n];
    if n < 3 {
        return bends;
    }
    let h = |k: usize| knots[k + 1] - knots[k];
    // The row of inner knot k: below, diagonal, above; with M₀ and M of the last knot eliminated.
    let row = |k: usize| {
        let (a, b) = (h(k - 1), h(k));
        let mut row = [a, 2.0 * (a + b), b];
        if n == 3 {
            return [0.0, 3.0 * (a + b), 0.0];
        }
        if k == 1 {
            row = [0.0, row[1] + a * (a + b) / b, row[2] - a * a / b];
        }
        if k == n - 2 {
            row = [row[0] - b * b / a, row[1] + b * (a + b) / a, 0.0];
        }
        row
    };
    for i in 0..6 {
        let slope = |k: usize| (points[k + 1][i] - points[k][i]) / h(k);
        // Thomas' algorithm; the rows are diagonally dominant.
        let mut above = vec![0.0; n];
        for k in 1..n - 1 {
            let [low, diagonal, high] = row(k);
            let pivot = diagonal - low * above[k - 1];
            above[k] = high / pivot;
            bends[k][i] = (6.0 * (slope(k) - slope(k - 1)) - low * bends[k - 1][i]) / pivot;
        }
        for k in (1..n - 2).rev() {
            bends[k][i] -= above[k] * bends[k + 1][i];
        }
        let end = |a: f64, b: f64, near: f64, far: f64| ((a + b) * near - a * far) / b;
        if n == 3 {
            (bends[0][i], bends[2][i]) = (bends[1][i], bends[1][i]);
        } else {
            bends[0][i] = end(h(0), h(1), bends[1][i], bends[2][i]);
            bends[n - 1][i] = end(h(n - 2), h(n - 3), bends[n - 2][i], bends[n - 3][i]);
        }
    }
    bends
}

#[cfg(test)]
mod tests {
    use super::*;
    use aspecta_robot::num::padded;

    const KNOTS: [f64; 6] = [0.0, 0.5, 0.7, 2.0, 2.5, 4.0];

    fn through(f: impl Fn(f64) -> f64, knots: &[f64]) -> Spline {
        Spline::new(knots.to_vec(), knots.iter().map(|&s| padded(&[f(s), 2.0 * f(s)])).collect())
    }

    #[test]
    fn cubics_are_reproduced_and_so_are_parabolas_and_lines() {
        let cubic = |s: f64| 1.0 + s * (2.0 - s * (0.5 + 0.3 * s));
        let parabola = |s: f64| 1.0 + s * (2.0 - s * 0.5);
        let line = |s: f64| 1.0 + 2.0 * s;
        let reproduced = |f: &dyn Fn(f64) -> f64, points: usize| {
            let spline = through(f, &KNOTS[..points]);
            for i in 0..=40 {
                let s = KNOTS[points - 1] * f64::from(i) / 40.0;
                let [value, ..] = spline.at(spline.piece(s), s);
                assert!((value[0] - f(s)).abs() < 1e-12 && (value[1] - 2.0 * f(s)).abs() < 1e-12);
            }
        };
        (4..=6).for_each(|points| reproduced(&cubic, points));
        reproduced(&parabola, 3);
        reproduced(&line, 2);
    }

    #[test]
    fn derivatives_are_those_of_the_value_and_continuous() {
        let spline = through(f64::sin, &KNOTS);
        for k in 0..5 {
            let s = 0.3 * KNOTS[k] + 0.7 * KNOTS[k + 1];
            let [low, here, high] = [s - 1e-5, s, s + 1e-5].map(|s| spline.at(k, s));
            assert!(((high[0][0] - low[0][0]) / 2e-5 - here[1][0]).abs() < 1e-8);
            assert!(((high[1][0] - low[1][0]) / 2e-5 - here[2][0]).abs() < 1e-8);
        }
        for (k, s) in KNOTS.iter().enumerate().skip(1).take(4) {
            let (before, after) = (spline.at(k - 1, *s), spline.at(k, *s));
            for d in 0..3 {
                assert!((before[d][0] - after[d][0]).abs() < 1e-12, "derivative {d} at {s}");
            }
        }
    }
}
