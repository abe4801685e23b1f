//! Where ω is not zero: it has a plane, spanned by p and q, and S is a form on it.

use super::{Form, LEGS, Start, dot, twice};
use crate::direct::projective::{Number, Point, System, zero};
use aspecta_robot::num::Disc;
use nalgebra::Complex;

/// Coordinates: p, q, then s, a, b, c, r.
pub(super) const V: usize = 13;
const S: usize = 8;
const A: usize = 9;
const B: usize = 10;
const C: usize = 11;
const R: usize = 12;
/// The last two equations, after those of six legs and five of the chart.
const CONE: usize = 11;
const NORM: usize = 12;

/// The equations
///
/// > r + a p · F p + 2 b p · F q + c q · F q + 2 s p · K q = 0 for each leg, a c = b²,
/// > s² ((p · p)(q · q) − (p · q)²) = r (a p · p + 2 b p · q + c q · q),
///
/// with ω = s p ∧ q and S = a p pᵀ + b (p qᵀ + q pᵀ) + c q qᵀ, in a chart: p and q have the products with two vectors that
/// they have at its centre, and (s, a, b, c, r) with another. F and K are the parts of the leg's form in e, and in e and g.
pub(super) struct Spanned<'a> {
    forms: &'a [Form],
    /// The conjugates of p and q at the centre, orthonormal there.
    frame: [[Complex<f64>; 4]; 2],
    weight: [Complex<f64>; 5],
}

impl<'a> Spanned<'a> {
    /// The equations in a chart round an approximate point, and the point in it.
    pub(super) fn near(forms: &'a [Form], start: &Start) -> Option<(Self, Point<V>)> {
        let Start { p, q, a, r } = start;
        let s = q.norm();
        let q = q.scaled((1.0 / s).into());
        let last = Point::<5>::from_fn(|k| [s.into(), *a, zero(), zero(), *r][k]);
        let last = last.scaled((1.0 / last.norm()).into());
        let conjugates = |z: &Point<4>| std::array::from_fn(|k| z.get(k).conj());
        let weight = std::array::from_fn(|k| last.get(k).conj());
        let point = Point::from_fn(|k| match k {
            0..4 => p.get(k),
            4..8 => q.get(k - 4),
            _ => last.get(k - 8),
        });
        s.is_normal().then_some((Self { forms, frame: [conjugates(p), conjugates(&q)], weight }, point))
    }

    /// ω, S and r.
    pub(super) fn image(u: &[Disc; V]) -> super::Image {
        super::image(&u[..4], &u[4..8], u[S], [u[A], u[B], u[C]], u[R])
    }
}

/// A leg's form, r + a p · F p + 2 b p · F q + c q · F q + 2 s p · K q, multiplied by p and q from one side.
struct Leg<T> {
    /// F p.
    p: [T; 4],
    /// F q.
    q: [T; 4],
    /// K q.
    mixed: [T; 4],
    /// Kᵀ p.
    turned: [T; 4],
}

impl<T: Number> Leg<T> {
    fn at(form: &Form, p: &[T], q: &[T]) -> Self {
        let sum = |part: &dyn Fn(usize) -> T| (0..4).fold(zero::<T>(), |sum, j| sum + part(j));
        let times =
            |from: usize, z: &[T]| std::array::from_fn(|i| sum(&|j| T::real(form[i][j + from]) * z[j]));
        let turned = std::array::from_fn(|i| sum(&|j| T::real(form[j][i + 4]) * p[j]));
        Self { p: times(0, p), q: times(0, q), mixed: times(4, q), turned }
    }
}

impl System<V> for Spanned<'_> {
    fn at<T: Number>(&self, u: &[T; V]) -> ([T; V], [[T; V]; V]) {
        let (p, q) = (&u[..4], &u[4..8]);
        let one = T::of(1.0.into());
        let (mut values, mut rows) = ([zero(); V], [[zero(); V]; V]);
        for (k, form) in self.forms.iter().take(LEGS).enumerate() {
            let leg = Leg::at(form, p, q);
            let [pp, pq, qq, mixed] = [dot(&leg.p, p), dot(&leg.p, q), dot(&leg.q, q), dot(&leg.mixed, p)];
            values[k] = u[R] + u[A] * pp + twice(u[B] * pq) + u[C] * qq + twice(u[S] * mixed);
            for i in 0..4 {
                rows[k][i] = twice(u[A] * leg.p[i] + u[B] * leg.q[i] + u[S] * leg.mixed[i]);
                rows[k][i + 4] = twice(u[B] * leg.p[i] + u[C] * leg.q[i] + u[S] * leg.turned[i]);
            }
            (rows[k][S], rows[k][A], rows[k][B]) = (twice(mixed), pp, twice(pq));
            (rows[k][C], rows[k][R]) = (qq, one);
        }
        let mut chart = |k: usize, entries: &[Complex<f64>], from: usize, value: T| {
            entries.iter().enumerate().for_each(|(i, z)| rows[LEGS + k][from + i] = T::of(*z));
            values[LEGS + k] = dot(&rows[LEGS + k], u) - value;
        };
        for (k, of) in self.frame.iter().enumerate() {
            for (j, from) in [0, 4].into_iter().enumerate() {
                chart(2 * k + j, of, from, if j == k { one } else { zero() });
            }
        }
        chart(4, &self.weight, S, one);
        (values[CONE], rows[CONE][A]) = (u[A] * u[C] - u[B] * u[B], u[C]);
        (rows[CONE][B], rows[CONE][C]) = (-twice(u[B]), u[A]);
        let [pp, pq, qq] = [dot(p, p), dot(p, q), dot(q, q)];
        let (area, trace) = (pp * qq - pq * pq, u[A] * pp + twice(u[B] * pq) + u[C] * qq);
        let square = u[S] * u[S];
        values[NORM] = square * area - u[R] * trace;
        let norm = &mut rows[NORM];
        for i in 0..4 {
            let along = |x: T, y: T| twice(x * p[i] + y * q[i]);
            norm[i] = along(square * qq - u[R] * u[A], -(square * pq) - u[R] * u[B]);
            norm[i + 4] = along(-(square * pq) - u[R] * u[B], square * pp - u[R] * u[C]);
        }
        (norm[S], norm[R]) = (twice(u[S] * area), -trace);
        (norm[A], norm[B], norm[C]) = (-(u[R] * pp), -twice(u[R] * pq), -(u[R] * qq));
        (values, rows)
    }

    fn bends<T: Number>(&self, u: &[T; V], d: &[T; V]) -> [T; V] {
        let (p, q, dp, dq) = (&u[..4], &u[4..8], &d[..4], &d[4..8]);
        let mut bends = [zero(); V];
        for (bend, form) in bends.iter_mut().zip(self.forms.iter().take(LEGS)) {
            let (here, along) = (Leg::at(form, p, q), Leg::at(form, dp, dq));
            let mixed = dot(&along.p, q) + dot(&here.p, dq);
            let scaled = dot(&here.mixed, dp) + dot(&along.mixed, p);
            let of_scalars = d[A] * dot(&here.p, dp) + d[B] * mixed + d[C] * dot(&here.q, dq) + d[S] * scaled;
            let of_vectors = u[A] * dot(&along.p, dp)
                + twice(u[B] * dot(&along.p, dq) + u[S] * dot(&along.mixed, dp))
                + u[C] * dot(&along.q, dq);
            *bend = twice(twice(of_scalars) + of_vectors);
        }
        bends[CONE] = twice(d[A] * d[C] - d[B] * d[B]);
        // Values of p · p, p · q, q · q with their first and second derivatives.
        let [pp, pq, qq] = [
            [dot(p, p), twice(dot(p, dp)), twice(dot(dp, dp))],
            [dot(p, q), dot(dp, q) + dot(p, dq), twice(dot(dp, dq))],
            [dot(q, q), twice(dot(q, dq)), twice(dot(dq, dq))],
        ];
        let area = [
            pp[0] * qq[0] - pq[0] * pq[0],
            pp[1] * qq[0] + pp[0] * qq[1] - twice(pq[0] * pq[1]),
            pp[2] * qq[0] + twice(pp[1] * qq[1] - pq[1] * pq[1] - pq[0] * pq[2]) + pp[0] * qq[2],
        ];
        let first =
            d[A] * pp[0] + u[A] * pp[1] + twice(d[B] * pq[0] + u[B] * pq[1]) + d[C] * qq[0] + u[C] * qq[1];
        let second = twice(d[A] * pp[1] + d[C] * qq[1])
            + u[A] * pp[2]
            + twice(twice(d[B] * pq[1]) + u[B] * pq[2])
            + u[C] * qq[2];
        let (square, growth) = (u[S] * u[S], u[S] * d[S]);
        bends[NORM] = square * area[2] + twice(twice(growth * area[1]) + d[S] * d[S] * area[0])
            - twice(d[R] * first)
            - u[R] * second;
        bends
    }
}
