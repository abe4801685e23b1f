//! Proofs that a system of equations has a common zero, or two next to each other.

use super::Point;
use super::linear::Factors;
use aspecta_robot::num::{Disc, Interval};
use nalgebra::Complex;
use std::ops::{Add, Mul, Neg, Sub};

/// Numbers in which equations are evaluated: complex ones, and discs that hold them.
pub(crate) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    fn of(z: Complex<f64>) -> Self;
    fn real(x: Interval) -> Self;
}

impl Number for Complex<f64> {
    fn of(z: Self) -> Self {
        z
    }
    fn real(x: Interval) -> Self {
        x.mid().into()
    }
}

impl Number for Disc {
    fn of(z: Complex<f64>) -> Self {
        Self::point(z.re, z.im)
    }
    fn real(x: Interval) -> Self {
        x.into()
    }
}

pub(crate) fn zero<T: Number>() -> T {
    T::of(Complex::default())
}

/// V equations F in as many unknowns.
pub(crate) trait System<const V: usize> {
    /// F and its gradients, row by row.
    fn at<T: Number>(&self, u: &[T; V]) -> ([T; V], [[T; V]; V]);
    /// F″(d, d).
    fn bends<T: Number>(&self, u: &[T; V], d: &[T; V]) -> [T; V];
}

/// Newton steps, and the step after which the next one is lost in rounding.
const STEPS: usize = 12;
const SETTLED: f64 = 1e-11;
/// The least radius within which two zeros are looked for.
const SMALLEST: f64 = 1e-7;
/// The share of the greatest motion that is allowed each unknown besides its own.
const SLACK: f64 = 0.02;
/// Makes up for the roundings of bounds: a few products and sums.
const ENLARGE: f64 = 1.0 + 16.0 * f64::EPSILON;

/// Discs in which the equations have one zero near `u`, and no other (the test of Krawczyk).
pub(crate) fn single<const V: usize>(system: &impl System<V>, mut u: Point<V>) -> Option<[Disc; V]> {
    for _ in 0..STEPS {
        let (values, rows) = system.at(&numbers(&u));
        let step = factors(&rows)?.solve(&vector(&values));
        u.add_scaled((-1.0).into(), &step);
        if step.norm() < SETTLED {
            break;
        }
    }
    let inverse = Inverse(factors(&system.at(&numbers(&u)).1)?.inverse());
    // Half of the radius is for what the slopes lack.
    let radius = 2.0 * norm(&inverse.times(&system.at(&std::array::from_fn(|k| disc(&u, k))).0));
    let round = std::array::from_fn(|k| Disc { rad: radius, ..disc(&u, k) });
    (inverse.defect(&system.at(&round).1).most < 0.5).then_some(round)
}

/// Discs in which the equations have two zeros near `u`, or one that is double, and no other.
///
/// With l and k next to the vectors that the gradients nearly annihilate from left and right, F(u) + τ l = 0
/// and k · (u − u₀) = s leave a curve u(s), τ(s) (Krawczyk's test for all |s| ≤ ρ at once), and the zeros of F are those
/// of τ, as often. Now τ has two zeros in |s| < ρ, like c s²/2 (Rouché), if
///
/// > |τ(0)| + |τ′(0)| ρ + sup |τ″ − c| ρ²/2 < |c| ρ²/2.
///
/// W is V + 1.
pub(crate) fn double<const V: usize, const W: usize>(
    system: &impl System<V>,
    start: Point<V>,
) -> Option<[Disc; V]> {
    let Fold { centre, left, right } = fold::<V, W>(system, start)?;
    let inverse = Inverse(factors(&bordered(&system.at(&numbers(&centre)).1, &left, &right))?.inverse());
    let along: [Disc; W] = std::array::from_fn(|k| Disc::point(if k == V { 1.0 } else { 0.0 }, 0.0));
    let off = inverse.times(&padded(&system.at(&std::array::from_fn(|k| disc(&centre, k))).0));
    let pace = inverse.times(&along);
    // u for |s| ≤ reach, a bound of τ(0), the derivative of both, and the defect of the inverse.
    let curve = |reach: f64| {
        let moved: [f64; W] = std::array::from_fn(|k| off[k].magnitude() + pace[k].magnitude() * reach);
        let most = moved.into_iter().fold(0.0, larger);
        // What is left of each radius is for the slopes, also where next to nothing moves.
        let radii = moved.map(|x| 2.0 * x + SLACK * most);
        let round: [Disc; V] = std::array::from_fn(|k| Disc { rad: radii[k], ..disc(&centre, k) });
        let defect = inverse.defect(&bordered(&system.at(&round).1, &left, &right));
        let widest = radii.into_iter().fold(0.0, larger);
        let holds = |k: usize| defect.rows[k] * widest * ENLARGE < radii[k] - moved[k] * ENLARGE;
        let tau = (off[V].magnitude() + defect.rows[V] * widest) * ENLARGE;
        ((0..W).all(holds) && defect.most < 0.5).then(|| (round, tau, inverse.solve(&along, &defect), defect))
    };
    let second = |round: &[Disc; V], speed: &[Disc; W], defect: &Defect<W>| {
        let bends = system.bends(round, &std::array::from_fn(|k| speed[k]));
        -inverse.solve(&padded(&bends), defect)[V]
    };
    let (here, tau, speed, defect) = curve(0.0)?;
    let slope = speed[V].magnitude();
    let bend = second(&here, &speed, &defect).magnitude();
    let reach = (8.0 * slope / bend).max((32.0 * tau / bend).sqrt()).max(SMALLEST);
    let (round, _, speed, defect) = curve(reach)?;
    let bend = second(&round, &speed, &defect);
    let half = 0.5 * reach * reach;
    let lost = (tau + slope * reach + bend.rad * half) * ENLARGE;
    let least = (bend.re * bend.re + bend.im * bend.im).sqrt() * half / ENLARGE;
    (lost < least).then_some(round)
}

/// A point near which two zeros may meet.
struct Fold<const V: usize> {
    centre: Point<V>,
    left: Point<V>,
    right: Point<V>,
}

/// Where τ is stationary near `u`, with l and k.
fn fold<const V: usize, const W: usize>(system: &impl System<V>, mut u: Point<V>) -> Option<Fold<V>> {
    let any = Point::from_fn(|k| Complex::new(1.0, 0.3 * k as f64));
    let (mut left, mut right) = (any, any);
    let along = Point::<W>::from_fn(|k| Complex::from(if k == V { 1.0 } else { 0.0 }));
    let part = |z: &Point<W>| Point::<V>::from_fn(|k| z.get(k));
    let unit = |z: &Point<W>| part(z).scaled((1.0 / part(z).norm()).into()).conjugate();
    for _ in 0..STEPS {
        let (values, rows) = system.at(&numbers(&u));
        let around = factors::<W>(&bordered(&rows, &left, &right))?;
        (left, right) = (unit(&around.solve_transposed(&along)), unit(&around.solve(&along)));
        let around = factors::<W>(&bordered(&rows, &left, &right))?;
        let off = part(&around.solve(&vector(&padded(&values))));
        u.add_scaled((-1.0).into(), &off);
        let speed = around.solve(&along);
        let bends = system.bends(&numbers(&u), &numbers(&part(&speed)));
        let step = speed.get(V) / around.solve(&vector(&padded(&bends))).get(V);
        let size = step.norm();
        if size.is_nan() || size > 1.0 {
            return None;
        }
        u.add_scaled(step, &part(&speed));
        if size + off.norm() < SETTLED {
            break;
        }
    }
    Some(Fold { centre: u, left, right })
}

/// Gradients with a column l and a row k.
fn bordered<T: Number, const V: usize, const W: usize>(
    rows: &[[T; V]; V],
    left: &Point<V>,
    right: &Point<V>,
) -> [[T; W]; W] {
    let entry = |i: usize, j: usize| match (i < V, j < V) {
        (true, true) => rows[i][j],
        (true, false) => T::of(left.get(i)),
        (false, true) => T::of(right.get(j)),
        (false, false) => zero(),
    };
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

fn padded<T: Number, const V: usize, const W: usize>(values: &[T; V]) -> [T; W] {
    std::array::from_fn(|k| values.get(k).copied().unwrap_or(zero()))
}

fn factors<const V: usize>(rows: &[[Complex<f64>; V]; V]) -> Option<Factors<V>> {
    Factors::of(rows.each_ref().map(vector))
}

fn vector<const V: usize>(z: &[Complex<f64>; V]) -> Point<V> {
    Point::from_fn(|k| z[k])
}

fn numbers<const V: usize>(u: &Point<V>) -> [Complex<f64>; V] {
    std::array::from_fn(|k| u.get(k))
}

/// A coordinate.
fn disc<const V: usize>(u: &Point<V>, k: usize) -> Disc {
    Disc::point(u.re[k], u.im[k])
}

/// An approximate inverse Y, by columns.
struct Inverse<const V: usize>([Point<V>; V]);

impl<const V: usize> Inverse<V> {
    /// Y b.
    fn times(&self, b: &[Disc; V]) -> [Disc; V] {
        std::array::from_fn(|i| {
            (0..V).fold(zero(), |sum, k| sum + Disc::point(self.0[k].re[i], self.0[k].im[i]) * b[k])
        })
    }

    /// I − Y J, J being given by rows.
    fn defect(&self, rows: &[[Disc; V]; V]) -> Defect<V> {
        let mut sums = [0.0f64; V];
        for j in 0..V {
            let column = self.times(&std::array::from_fn(|k| rows[k][j]));
            for (i, sum) in sums.iter_mut().enumerate() {
                let entry = if i == j { column[i] - Disc::point(1.0, 0.0) } else { column[i] };
                *sum = (*sum + entry.magnitude()) * ENLARGE;
            }
        }
        Defect { rows: sums, most: sums.into_iter().fold(0.0, larger) }
    }

    /// x with J x = b, where ‖I − Y J‖ < 1: off Y b by (I − Y J) x, and ‖x‖ ≤ ‖Y b‖/(1 − ‖I − Y J‖).
    fn solve(&self, b: &[Disc; V], defect: &Defect<V>) -> [Disc; V] {
        let mut x = self.times(b);
        let size = norm(&x) / (1.0 - defect.most) * ENLARGE;
        for (z, row) in x.iter_mut().zip(defect.rows) {
            z.rad = (z.rad + row * size) * ENLARGE;
        }
        x
    }
}

/// Bounds of the sums of moduli in the rows of I − Y J, and the largest: its maximum norm.
struct Defect<const V: usize> {
    rows: [f64; V],
    most: f64,
}

fn norm<const V: usize>(u: &[Disc; V]) -> f64 {
    u.iter().map(|z| z.magnitude()).fold(0.0, larger)
}

/// The larger number; NaN if one is.
fn larger(a: f64, b: f64) -> f64 {
    if a >= b { a } else { b + 0.0 * a }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// (x² + a x + b) (1 + c x) + y x and y + d x² − e: near x = 0 two zeros for small a and b.
    struct Pair([f64; 5]);

    impl System<2> for Pair {
        fn at<T: Number>(&self, &[x, y]: &[T; 2]) -> ([T; 2], [[T; 2]; 2]) {
            let [a, b, c, d, e] = self.0.map(|x| T::of(x.into()));
            let (two, one) = (T::of(2.0.into()), T::of(1.0.into()));
            let (square, factor) = (x * x + a * x + b, one + c * x);
            let slope = (two * x + a) * factor + square * c + y;
            ([square * factor + y * x, y + d * x * x - e], [[slope, x], [two * d * x, one]])
        }

        fn bends<T: Number>(&self, &[x, _]: &[T; 2], &[dx, dy]: &[T; 2]) -> [T; 2] {
            let [a, _, c, d, _] = self.0.map(|x| T::of(x.into()));
            let (two, one) = (T::of(2.0.into()), T::of(1.0.into()));
            let second = two * (one + c * x) + two * (two * x + a) * c;
            [second * dx * dx + two * dx * dy, two * d * dx * dx]
        }
    }

    fn pair(of: [f64; 5]) -> Option<[Disc; 2]> {
        double::<2, 3>(&Pair(of), Point::real([0.01, 0.02]))
    }

    proptest! {
        /// x² = −b and others that are as near to 0, with what belongs to another zero far away.
        #[test]
        fn two_zeros_that_meet_are_found(
            gap in -16i32..-3, c in -1.0..1.0f64, d in -1.0..1.0f64, sign in prop::bool::ANY,
        ) {
            let b = 10f64.powi(gap) * if sign { 1.0 } else { -1.0 };
            let round = pair([0.0, b, c, d, 0.0]);
            prop_assume!(gap < -6 || round.is_some());
            let [x, _] = round.unwrap();
            // Both zeros, ±√−b to first order, lie within.
            let reach = (x.re.hypot(x.im) - b.abs().sqrt()).abs();
            prop_assert!(reach <= x.rad + b.abs(), "{x:?}");
        }

        #[test]
        fn what_is_single_is_not_double(a in 0.2..1.0f64, c in -0.1..0.1f64, d in -0.1..0.1f64) {
            prop_assert!(pair([a, 0.0, c, d, 0.0]).is_none_or(|[x, _]| x.rad > 0.5 * a));
            let [x, y] = single(&Pair([a, 0.0, c, d, 0.0]), Point::real([0.01, 0.0])).unwrap();
            prop_assert!(x.re.abs() <= x.rad && y.re.abs() <= y.rad && x.rad < 1e-9);
        }
    }

    /// x³ + b and y: three zeros, never two.
    struct Three(f64);

    impl System<2> for Three {
        fn at<T: Number>(&self, &[x, y]: &[T; 2]) -> ([T; 2], [[T; 2]; 2]) {
            let slope = T::of(3.0.into()) * x * x;
            ([x * x * x + T::of(self.0.into()), y], [[slope, zero()], [zero(), T::of(1.0.into())]])
        }

        fn bends<T: Number>(&self, &[x, _]: &[T; 2], &[dx, _]: &[T; 2]) -> [T; 2] {
            [T::of(6.0.into()) * x * dx * dx, zero()]
        }
    }

    #[test]
    fn three_zeros_that_meet_are_neither_one_nor_two() {
        for b in [0.0, 1e-15, -1e-12, 1e-9] {
            for start in [[0.0, 0.0], [1e-3, 1e-3], [-1e-5, 0.0]] {
                assert!(double::<2, 3>(&Three(b), Point::real(start)).is_none(), "{b}");
                if b == 0.0 {
                    assert!(single(&Three(b), Point::real(start)).is_none());
                }
            }
        }
    }
}
