//! Following the common points of quadrics while their coefficients change.

use super::Point;
use super::forms::{Family, Quadrics, Values};
use super::linear::Factors;
use arrayvec::ArrayVec;
use nalgebra::Complex;

/// How carefully paths are followed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pace {
    /// The greatest first correction of a predicted point of norm one.
    pub correction: f64,
    /// A correction after which the next one, about its square, is not waited for.
    pub last: f64,
    /// The greatest step of t.
    pub longest: f64,
}

impl Pace {
    pub const QUICK: Self = Self { correction: 2e-2, last: 1e-5, longest: 0.25 };
    pub const CAREFUL: Self = Self { correction: 1e-3, last: 1e-7, longest: 0.05 };
    pub const PATIENT: Self = Self { correction: 1e-5, last: 1e-9, longest: 0.01 };
}

/// The end to which a path was followed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct End<const V: usize> {
    /// The last point, of norm one.
    pub point: Point<V>,
    /// Whether it is a regular point at t = 1, to rounding. Otherwise the path could not be followed to its
    /// end: two of them meet there, or it leaves the regular points of the family.
    pub arrived: bool,
}

/// The ends of the paths, in the order of their starts.
pub(crate) type Ends<const V: usize> = ArrayVec<End<V>, 40>;

/// Steps of t below this say that a path cannot be followed further.
const SHORTEST: f64 = 1e-12;
/// Corrections of one point.
const MOST_CORRECTIONS: usize = 5;
/// Steps that make a point as good as double precision has it, and the length of one that ends them.
const MOST_STEPS_TO_SETTLE: usize = 10;
const SETTLED: f64 = 1e-13;
/// A path that takes more steps is given up.
const MOST_STEPS: usize = 2000;

/// Follows paths through one family.
pub(crate) struct Tracker<'a, const V: usize, const F: usize> {
    family: Family<'a, V, F>,
    /// Of the t last looked at.
    system: Quadrics<V, F>,
}

/// A point of a path with its derivative, in the affine chart patch · x = 1.
#[derive(Clone, Copy)]
struct Here<const V: usize> {
    t: f64,
    x: Point<V>,
    speed: Point<V>,
}

impl<'a, const V: usize, const F: usize> Tracker<'a, V, F> {
    pub fn new(family: Family<'a, V, F>) -> Self {
        Self { family, system: Quadrics::ZERO }
    }

    /// Follows the path that starts at x for t = 0.
    pub fn follow(&mut self, start: &Point<V>, pace: Pace) -> End<V> {
        #[cfg(target_arch = "x86_64")]
        {
            #[target_feature(enable = "avx2")]
            fn wide<const V: usize, const F: usize>(
                tracker: &mut Tracker<'_, V, F>,
                start: &Point<V>,
                pace: Pace,
            ) -> End<V> {
                tracker.follow_any(start, pace)
            }
            if is_x86_feature_detected!("avx2") {
                // SAFETY: the processor has the feature, as just checked.
                #[allow(unsafe_code)]
                return unsafe { wide(self, start, pace) };
            }
        }
        self.follow_any(start, pace)
    }

    #[inline(always)]
    fn follow_any(&mut self, start: &Point<V>, pace: Pace) -> End<V> {
        let mut patch = start.scaled(Complex::from(1.0 / start.norm())).conjugate();
        let x = patch.conjugate();
        let lost = |x: Point<V>| End { point: x.normalised(), arrived: false };
        let Some((mut here, _)) = self.correct(0.0, x, &patch, Pace { correction: f64::INFINITY, ..pace })
        else {
            return lost(x);
        };
        let mut before: Option<Here<V>> = None;
        let mut step = 0.1 * pace.longest;
        for _ in 0..MOST_STEPS {
            let left = 1.0 - here.t;
            let (t, last) = if step >= left { (1.0, true) } else { (here.t + step, false) };
            let predicted = predict(&here, before.as_ref(), t);
            match self.correct(t, predicted, &patch, pace) {
                Some((there, error)) => {
                    if last {
                        return End { point: self.polish(there.x), arrived: true };
                    }
                    // The error of a cubic grows with the fourth power of the step.
                    let growth = 0.8 * (pace.correction / error.max(1e-12)).sqrt().sqrt();
                    step = (step * growth.clamp(0.3, 2.5)).min(pace.longest);
                    before = Some(here);
                    here = there;
                    let norm = here.x.norm();
                    if norm > 2.0 {
                        patch = here.x.scaled(Complex::from(1.0 / norm)).conjugate();
                        here = in_patch(&here, &patch);
                        before = before.map(|b| in_patch(&b, &patch));
                    }
                }
                None => {
                    step = 0.4 * step.min(left);
                    if step < SHORTEST {
                        break;
                    }
                }
            }
        }
        lost(here.x)
    }

    /// Newton's method from x at t, in the chart of `patch`: the point with its derivative, and the first
    /// correction. `None` if that is more than the pace allows, or the next ones do not shrink.
    #[inline(always)]
    fn correct(&mut self, t: f64, mut x: Point<V>, patch: &Point<V>, pace: Pace) -> Option<(Here<V>, f64)> {
        self.family.mix(t, &mut self.system);
        let mut error = f64::NAN;
        let mut most = pace.correction;
        for iteration in 0..MOST_CORRECTIONS {
            let (factors, shift) = newton(&self.system, &x, patch)?;
            let size = shift.norm();
            if size > most || size.is_nan() {
                return None;
            }
            if iteration == 0 {
                error = size;
            }
            most = 0.2 * size;
            x.add_scaled(Complex::from(1.0), &shift);
            if size < pace.last {
                let change = self.family.change(t, &x);
                let speed = factors.solve(&right_side(&change, Complex::default()));
                return Some((Here { t, x, speed }, error));
            }
        }
        None
    }

    /// The common point of the target's quadrics near x, as well as double precision has it.
    #[inline(always)]
    fn polish(&self, x: Point<V>) -> Point<V> {
        polish(self.family.target, x)
    }
}

/// Two more steps of Newton's method; norm one.
#[inline(always)]
pub(crate) fn polish<const V: usize, const F: usize>(system: &Quadrics<V, F>, x: Point<V>) -> Point<V> {
    let mut x = x.normalised();
    for _ in 0..2 {
        let Some((_, shift)) = newton(system, &x, &x.conjugate()) else { break };
        x.add_scaled(Complex::from(1.0), &shift);
    }
    x.normalised()
}

/// Newton's method until the next step is lost in rounding: next to another point the steps shrink late. Norm one.
pub(crate) fn settle<const V: usize, const F: usize>(system: &Quadrics<V, F>, x: Point<V>) -> Point<V> {
    let mut x = x.normalised();
    for _ in 0..MOST_STEPS_TO_SETTLE {
        let Some((_, shift)) = newton(system, &x, &x.conjugate()) else { break };
        x.add_scaled(Complex::from(1.0), &shift);
        if shift.norm() < SETTLED {
            break;
        }
    }
    x.normalised()
}

/// The step of Newton's method for the forms and patch · x = 1, and what solved for it.
#[inline(always)]
fn newton<const V: usize, const F: usize>(
    system: &Quadrics<V, F>,
    x: &Point<V>,
    patch: &Point<V>,
) -> Option<(Factors<V>, Point<V>)> {
    let Values { values, halves } = system.at(x);
    let mut matrix = [*patch; V];
    matrix[..F].copy_from_slice(&halves);
    let factors = Factors::of(matrix)?;
    let shift = factors.solve(&right_side(&values, Complex::from(1.0) - patch.dot(x)));
    Some((factors, shift))
}

/// −values / 2 (the matrix has half gradients), then what the patch misses.
#[inline(always)]
fn right_side<const V: usize, const F: usize>(values: &[Complex<f64>; F], patch: Complex<f64>) -> Point<V> {
    let mut b = Point::ZERO;
    for (k, v) in values.iter().enumerate() {
        (b.re[k], b.im[k]) = (-0.5 * v.re, -0.5 * v.im);
    }
    (b.re[V - 1], b.im[V - 1]) = (patch.re, patch.im);
    b
}

/// The point at t on the cubic through two points of the path with their derivatives; on the tangent, if
/// there is only one.
#[inline(always)]
fn predict<const V: usize>(here: &Here<V>, before: Option<&Here<V>>, t: f64) -> Point<V> {
    let mut x = here.x;
    let Some(before) = before else {
        x.add_scaled(Complex::from(t - here.t), &here.speed);
        return x;
    };
    let width = here.t - before.t;
    let u = (t - before.t) / width;
    let (from, to) = ((u - 1.0).powi(2) * (1.0 + 2.0 * u), u * u * (3.0 - 2.0 * u));
    let (leave, arrive) = (u * (u - 1.0).powi(2) * width, u * u * (u - 1.0) * width);
    for k in 0..V {
        x.re[k] = from * before.x.re[k]
            + to * here.x.re[k]
            + leave * before.speed.re[k]
            + arrive * here.speed.re[k];
        x.im[k] = from * before.x.im[k]
            + to * here.x.im[k]
            + leave * before.speed.im[k]
            + arrive * here.speed.im[k];
    }
    x
}

/// Returns the point and derivative in another chart.
fn in_patch<const V: usize>(here: &Here<V>, patch: &Point<V>) -> Here<V> {
    let scale = patch.dot(&here.x).inv();
    let x = here.x.scaled(scale);
    let mut speed = here.speed.scaled(scale);
    speed.add_scaled(-patch.dot(&speed), &x);
    Here { t: here.t, x, speed }
}
