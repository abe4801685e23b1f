//! The fastest way along one spline, on a grid.

use crate::path::spline::{Point, Spline};

/// Steps of the grid, at least.
const STEPS: f64 = 1000.0;
/// Bisections that find a double.
const BISECTIONS: usize = 100;
/// The places on a step at which limits are imposed: between these q̈ is one parabola.
pub(super) const AT: [f64; 3] = [0.0, 0.5, 1.0];

/// One step: s̈ is the same all along it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    /// The spline's piece it lies on.
    pub piece: usize,
    /// Its start, s,
    pub start: f64,
    /// and its length.
    pub length: f64,
    /// ṡ² at its start.
    pub speed2: f64,
    /// s̈.
    pub rate: f64,
}

impl Step {
    /// ṡ² at a share of the step.
    fn speed2_at(&self, share: f64) -> f64 {
        (self.speed2 + 2.0 * share * self.length * self.rate).max(0.0)
    }

    /// Returns how long it takes.
    pub fn time(&self) -> f64 {
        2.0 * self.length / (self.speed2.sqrt() + self.speed2_at(1.0).sqrt())
    }

    /// q̇ and q̈ at a share of the step.
    pub fn motion(&self, spline: &Spline, share: f64) -> [Point; 2] {
        let [_, speed, acceleration] = self.at(spline, share, self.speed2_at(share).sqrt());
        [speed, acceleration]
    }

    /// q, q̇ and q̈ at a share of the step, where ṡ is `speed`.
    pub fn at(&self, spline: &Spline, share: f64, speed: f64) -> [Point; 3] {
        let [value, first, second] = spline.at(self.piece, self.start + share * self.length);
        let acceleration = std::array::from_fn(|j| second[j] * speed * speed + first[j] * self.rate);
        [value, first.map(|d| d * speed), acceleration]
    }
}

/// The fastest steps along a spline whose coordinates may change by 1 a second at most, and by `acceleration`
/// a second squared; from rest to rest.
pub(super) fn fastest(spline: &Spline, acceleration: &[f64]) -> Vec<Step> {
    let mut steps = cut(spline);
    let rows: Vec<_> = steps.iter().map(|step| Rows::new(spline, step, acceleration)).collect();
    // The greatest ṡ² at the start of each step from which the end can be reached at rest.
    let mut most = vec![0.0; steps.len() + 1];
    for k in (1..steps.len()).rev() {
        most[k] = rows[k].greatest(most[k + 1]);
    }
    let mut speed2: f64 = 0.0;
    for (k, step) in steps.iter_mut().enumerate() {
        step.speed2 = speed2;
        let [low, high] = rows[k].rates(speed2, most[k + 1]);
        // Rounding may leave nothing between.
        step.rate = if low <= high { high } else { 0.5 * (low + high) };
        speed2 = step.speed2_at(1.0);
    }
    steps
}

/// The grid: knots are among its nodes.
fn cut(spline: &Spline) -> Vec<Step> {
    let knots = spline.knots();
    let all = knots[knots.len() - 1] - knots[0];
    let pieces = knots.windows(2).enumerate();
    pieces
        .flat_map(|(piece, w)| {
            let count = (STEPS * (w[1] - w[0]) / all).ceil().max(1.0) as usize;
            let length = (w[1] - w[0]) / count as f64;
            let start = w[0];
            (0..count).map(move |i| Step {
                piece,
                start: start + i as f64 * length,
                length,
                speed2: 0.0,
                rate: 0.0,
            })
        })
        .collect()
}

/// The limits on one step, linear in u = s̈ and x = ṡ² at its start.
struct Rows {
    length: f64,
    /// (c, d, b): |c u + d x| ≤ b.
    both: Vec<[f64; 3]>,
    /// (c, d, b): c u + d x ≤ b.
    one: Vec<[f64; 3]>,
}

impl Rows {
    fn new(spline: &Spline, step: &Step, acceleration: &[f64]) -> Self {
        let (mut both, mut one) = (Vec::new(), Vec::new());
        for share in AT {
            let [_, first, second] = spline.at(step.piece, step.start + share * step.length);
            // ṡ² there is x + 2 δ u.
            let gain = 2.0 * share * step.length;
            for (j, most) in acceleration.iter().enumerate() {
                both.push([first[j] + gain * second[j], second[j], *most]);
                let square = first[j] * first[j];
                one.push([gain * square, square, 1.0]);
            }
        }
        Self { length: step.length, both, one }
    }

    /// The s̈ that are allowed at ṡ² = `x`, if ṡ² at the end is to be at most `next`: [low, high], low > high
    /// if there are none.
    fn rates(&self, x: f64, next: f64) -> [f64; 2] {
        let gain = 2.0 * self.length;
        let mut range = [-x / gain, (next - x) / gain];
        let mut cut = |c: f64, most: f64| {
            if c > 0.0 {
                range[1] = range[1].min(most / c);
            } else if c < 0.0 {
                range[0] = range[0].max(most / c);
            } else if most < 0.0 {
                range = [f64::INFINITY, f64::NEG_INFINITY];
            }
        };
        for [c, d, b] in &self.both {
            cut(*c, b - d * x);
            cut(-c, b + d * x);
        }
        for [c, d, b] in &self.one {
            cut(*c, b - d * x);
        }
        range
    }

    /// The greatest ṡ² at the start at which there is an s̈. What is allowed is convex and holds (0, 0):
    /// bisection finds it.
    fn greatest(&self, next: f64) -> f64 {
        let is_allowed = |x: f64| {
            let [low, high] = self.rates(x, next);
            low <= high
        };
        // The speed limits at the start bound it.
        let bound = self.one.iter().filter(|[_, d, _]| *d > 0.0).map(|[_, d, b]| b / d);
        let (mut low, mut high) = (0.0, bound.fold(f64::MAX, f64::min));
        if is_allowed(high) {
            return high;
        }
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if is_allowed(middle) { low = middle } else { high = middle }
        }
        low
    }
}
