//! Where S is not zero: S = m ê êᵀ with a quaternion ê, and ω = ê ∧ ĝ.

use super::{Form, LEGS, Start, dot, twice};
use crate::direct::projective::{Number, Point, System, zero};
use aspecta_robot::num::Disc;
use nalgebra::Complex;

/// Coordinates: ê, ĝ, m, r.
pub(super) const V: usize = 10;
const M: usize = 8;
const R: usize = 9;
/// The last equation, after those of six legs and three of the chart.
const CLOSURE: usize = 9;

/// The equations
///
/// > r + m A(ê) + B(ê, ĝ) = 0 for each leg, (ĝ · ĝ − m r)(ê · ê) = (ê · ĝ)²,
///
/// A and B being the parts of the leg's form in e, and in e and g, in a chart: patch · ê = 1, patch · ĝ = 0,
/// weight · (ĝ, m, r) = 1.
pub(super) struct Turned<'a> {
    forms: &'a [Form],
    chart: [Point<V>; 3],
}

impl<'a> Turned<'a> {
    /// The equations in the chart of an approximate point, and the point in it.
    pub(super) fn near(forms: &'a [Form], start: &Start) -> (Self, Point<V>) {
        let Start { p, q, a, r } = start;
        let rest = Point::<6>::from_fn(|k| match k {
            4 => *a,
            5 => *r,
            _ => q.get(k),
        });
        let rest = rest.scaled((1.0 / rest.norm()).into());
        let at = |from: usize, entries: &dyn Fn(usize) -> Complex<f64>, len: usize| {
            Point::from_fn(|k| if (from..from + len).contains(&k) { entries(k - from) } else { zero() })
        };
        let patch = |k: usize| p.get(k).conj();
        let chart = [at(0, &patch, 4), at(4, &patch, 4), at(4, &|k| rest.get(k).conj(), 6)];
        (Self { forms, chart }, Point::from_fn(|k| if k < 4 { p.get(k) } else { rest.get(k - 4) }))
    }

    /// ω, S and r.
    pub(super) fn image(u: &[Disc; V]) -> super::Image {
        super::image(&u[..4], &u[4..8], Disc::point(1.0, 0.0), [u[M], zero(), zero()], u[R])
    }
}

/// A leg's form with ê: its parts A and B.
struct Leg<T> {
    /// A = ê · a.
    a: [T; 4],
    /// B = 2 ê · b = 2 c · ĝ.
    b: [T; 4],
    c: [T; 4],
}

impl<T: Number> Leg<T> {
    fn at(form: &Form, e: &[T], g: &[T]) -> Self {
        let real = |i: usize, j: usize| T::real(form[i][j]);
        let sum = |part: &dyn Fn(usize) -> T| (0..4).fold(zero::<T>(), |sum, j| sum + part(j));
        Self {
            a: std::array::from_fn(|i| sum(&|j| real(i, j) * e[j])),
            b: std::array::from_fn(|i| sum(&|j| real(i, j + 4) * g[j])),
            c: std::array::from_fn(|i| sum(&|j| real(j, i + 4) * e[j])),
        }
    }
}

impl System<V> for Turned<'_> {
    fn at<T: Number>(&self, u: &[T; V]) -> ([T; V], [[T; V]; V]) {
        let (e, g) = (&u[..4], &u[4..8]);
        let (mut values, mut rows) = ([zero(); V], [[zero(); V]; V]);
        for (k, form) in self.forms.iter().take(LEGS).enumerate() {
            let leg = Leg::at(form, e, g);
            let a = dot(&leg.a, e);
            values[k] = u[R] + u[M] * a + twice(dot(&leg.c, g));
            let gradient = &mut rows[k];
            for i in 0..4 {
                gradient[i] = twice(u[M] * leg.a[i] + leg.b[i]);
                gradient[i + 4] = twice(leg.c[i]);
            }
            (gradient[M], gradient[R]) = (a, T::of(1.0.into()));
        }
        for (k, row) in self.chart.iter().enumerate() {
            let row = std::array::from_fn(|i| T::of(row.get(i)));
            let one = if k == 1 { zero() } else { T::of(1.0.into()) };
            (values[LEGS + k], rows[LEGS + k]) = (dot(&row, u) - one, row);
        }
        let (q, t, s) = (dot(g, g) - u[M] * u[R], dot(e, e), dot(e, g));
        values[CLOSURE] = q * t - s * s;
        let gradient = &mut rows[CLOSURE];
        for i in 0..4 {
            gradient[i] = twice(q * e[i] - s * g[i]);
            gradient[i + 4] = twice(t * g[i] - s * e[i]);
        }
        (gradient[M], gradient[R]) = (-(u[R] * t), -(u[M] * t));
        (values, rows)
    }

    fn bends<T: Number>(&self, u: &[T; V], d: &[T; V]) -> [T; V] {
        let (e, g, de, dg) = (&u[..4], &u[4..8], &d[..4], &d[4..8]);
        let mut bends = [zero(); V];
        for (bend, form) in bends.iter_mut().zip(self.forms.iter().take(LEGS)) {
            let (here, along) = (Leg::at(form, e, g), Leg::at(form, de, dg));
            let turned = twice(d[M] * dot(&here.a, de)) + u[M] * dot(&along.a, de);
            *bend = twice(turned + twice(dot(&along.c, dg)));
        }
        let (q, t, s) = (dot(g, g) - u[M] * u[R], dot(e, e), dot(e, g));
        let (q1, q2) = (twice(dot(g, dg)) - d[M] * u[R] - u[M] * d[R], dot(dg, dg) - d[M] * d[R]);
        let (t1, s1) = (twice(dot(e, de)), dot(de, g) + dot(e, dg));
        bends[CLOSURE] = twice(q2 * t + q1 * t1 + q * dot(de, de) - s1 * s1 - twice(s * dot(de, dg)));
        bends
    }
}
