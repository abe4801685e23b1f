//! Points that count among the forty without being poses: where solutions of special platforms have gone.
//!
//! A pose (e, g) is taken for the point (ω, S, r) of P¹⁶, ω = e ∧ g, S = e eᵀ, r = g · g, in which the leg equations
//! are linear. The closure X of the poses has dimension six and degree 40 (`docs/theory.md`, 11); with S = m ê êᵀ and ω = ê ∧ ĝ
//! it is where
//!
//! > (ĝ · ĝ − m r)(ê · ê) = (ê · ĝ)².
//!
//! Poses have tr S ≠ 0. Special platforms have other points among the forty: a plane of symmetry of base and platform
//! makes four of them, two pairs of joints that are one make four double ones, point symmetry eight single
//! and four double ones. Those of similar platforms are curves, which are not counted.

mod spanned;
mod turned;

use crate::direct::projective::{Ends, Number, Point, Proved, double, single, zero};
use arrayvec::ArrayVec;
use aspecta_robot::num::{Disc, Interval};
use nalgebra::{Complex, SMatrix};
use spanned::Spanned;
use turned::Turned;

const LEGS: usize = 6;

/// A leg's quadratic form in (e, g).
type Form = [[Interval; 8]; 8];
/// The discs in which a point of P¹⁶ lies.
type Image = [Disc; 17];

/// How many of the forty, with multiplicity, are proved to lie near ends of paths that are not proved to be poses, without
/// being real.
pub(crate) fn elsewhere(forms: &[Form], ends: &Ends<8>, proofs: &[Option<Proved<8>>]) -> usize {
    let poses = proofs.iter().map(|proof| proof.filter(Proved::is_rotation));
    let images = poses.clone().flatten().map(|pose| of_study(&pose.coordinates())).collect();
    let mut found = Found { images, count: 0 };
    let mut done: Vec<Point<4>> = Vec::new();
    for (end, _) in ends.iter().zip(poses).filter(|(_, pose)| pose.is_none()) {
        for start in Start::near(forms, &end.point) {
            // Two paths have a double point for their end.
            let is_old = |p: &Point<4>| 1.0 - p.conjugate().dot(&start.p).norm() < SAME;
            if !done.iter().any(is_old) && found.look(forms, &start) {
                done.extend([start.p, start.p.conjugate()]);
            }
        }
    }
    found.count
}

/// Sweeps of a singular value decomposition, which goes on for ever where numbers are not finite.
const MOST_SWEEPS: usize = 100;
/// Quaternions of norm one are taken for one if their product is nearer to one than this.
const SAME: f64 = 1e-12;

/// Points that are proved, each different from all others.
struct Found {
    images: Vec<Image>,
    count: usize,
}

impl Found {
    /// Looks for a point near an approximate one; returns whether a new one is there.
    fn look(&mut self, forms: &[Form], start: &Start) -> bool {
        let (turned, point) = Turned::near(forms, start);
        if single(&turned, point).is_some_and(|u| self.add(Turned::image(&u), 1))
            || double::<{ turned::V }, { turned::V + 1 }>(&turned, point)
                .is_some_and(|u| self.add(Turned::image(&u), 2))
        {
            return true;
        }
        let Some((spanned, point)) = Spanned::near(forms, start) else { return false };
        double::<{ spanned::V }, { spanned::V + 1 }>(&spanned, point)
            .is_some_and(|u| self.add(Spanned::image(&u), 2))
    }

    /// Counts a point with its multiplicity and its conjugate, which real forms have in common too, if they are proved to be
    /// others than those before, and not real. Returns whether the first is.
    fn add(&mut self, image: Image, times: usize) -> bool {
        let conjugate = image.map(|z| Disc { im: -z.im, ..z });
        let is_new = |images: &[Image], point: &Image| images.iter().all(|other| differ(point, other));
        if !differ(&image, &conjugate) || !is_new(&self.images, &image) {
            return false;
        }
        for point in [image, conjugate] {
            if is_new(&self.images, &point) {
                self.images.push(point);
                self.count += times;
            }
        }
        true
    }
}

/// ω, S and r of (e, g).
fn of_study(x: &[Disc; 8]) -> Image {
    let (e, g) = x.split_at(4);
    let one = Disc::point(1.0, 0.0);
    image(e, g, one, [one, zero(), zero()], dot(g, g))
}

/// ω = s p ∧ q, S = a p pᵀ + b (p qᵀ + q pᵀ) + c q qᵀ, r.
fn image(p: &[Disc], q: &[Disc], s: Disc, [a, b, c]: [Disc; 3], r: Disc) -> Image {
    let pairs = (0..4).flat_map(|i| (0..=i).map(move |j| (i, j)));
    let symmetric =
        pairs.clone().map(|(i, j)| a * p[i] * p[j] + b * (p[i] * q[j] + q[i] * p[j]) + c * q[i] * q[j]);
    let skew = pairs.filter(|(i, j)| i != j).map(|(i, j)| s * (p[i] * q[j] - q[i] * p[j]));
    let mut entries = symmetric.chain(skew);
    std::array::from_fn(|_| entries.next().unwrap_or(r))
}

/// Whether two points are proved to be different: some minor of their coordinates is not zero.
fn differ(a: &Image, b: &Image) -> bool {
    let size = |z: &Disc| z.re * z.re + z.im * z.im;
    let i = (0..17).fold(0, |best, k| if size(&a[k]) > size(&a[best]) { k } else { best });
    (0..17).any(|j| j != i && (a[i] * b[j] - a[j] * b[i]).excludes_zero())
}

fn twice<T: Number>(x: T) -> T {
    x + x
}

fn dot<T: Number>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).fold(zero(), |sum, (&x, &y)| sum + x * y)
}

/// An approximate point S = a p pᵀ, ω = p ∧ q, r, where p has norm one and q is orthogonal to it.
struct Start {
    p: Point<4>,
    q: Point<4>,
    a: Complex<f64>,
    r: Complex<f64>,
}

impl Start {
    /// The points that the end of a path may be next to.
    fn near(forms: &[Form], end: &Point<8>) -> ArrayVec<Self, 2> {
        let part = |from: usize| Point::<4>::from_fn(|k| end.get(from + k));
        let (e, g) = (part(0), part(4));
        let (length, size) = (e.norm(), g.norm());
        let p = e.scaled((1.0 / length).into());
        let mut q = g.scaled(length.into());
        q.add_scaled(-p.conjugate().dot(&q), &p);
        let mut starts = ArrayVec::from_iter([Self { p, q, a: (length * length).into(), r: g.dot(&g) }]);
        // Where e goes to nothing, g goes to a multiple of what it is like.
        if length < 0.05 * size {
            starts.extend(Self::on(forms, g.scaled((1.0 / size).into())));
        }
        starts
    }

    /// The q, a and r that fulfil the leg equations for p best, q being orthogonal to p and to its conjugate: they
    /// are linear in these.
    fn on(forms: &[Form], p: Point<4>) -> Option<Self> {
        let mut rows = SMatrix::<Complex<f64>, 8, 6>::zeros();
        for (k, form) in forms.iter().take(LEGS).enumerate() {
            let times = |from: usize, j: usize| (0..4).map(move |i| p.get(i) * form[i][j + from].mid());
            for j in 0..4 {
                rows[(k, j)] = times(4, j).sum::<Complex<f64>>() * 2.0;
                rows[(k, 4)] += times(0, j).sum::<Complex<f64>>() * p.get(j);
            }
            rows[(k, 5)] = 1.0.into();
        }
        for j in 0..4 {
            (rows[(6, j)], rows[(7, j)]) = (p.get(j).conj(), p.get(j));
        }
        let svd = rows.try_svd(false, true, 5.0 * f64::EPSILON, MOST_SWEEPS)?;
        let least = svd.singular_values.imin();
        let v = svd.v_t?;
        let found = |k: usize| v[(least, k)].conj();
        Some(Self { p, q: Point::from_fn(found), a: found(4), r: found(5) })
    }
}

#[cfg(test)]
mod tests {
    use super::super::{MOST, problem};
    use super::*;
    use crate::direct::locked::Locked;
    use crate::direct::projective::System;
    use aspecta_robot::Leg;
    use aspecta_robot::num::Random;

    fn point(random: &mut Random) -> [f64; 3] {
        std::array::from_fn(|_| random.within((-1.0, 1.0)))
    }

    /// Legs between joints that are alike on either side of a plane, at lengths of no pose in particular.
    fn mirrored(random: &mut Random) -> Vec<Locked> {
        let mut legs = Vec::new();
        while legs.len() < 6 {
            let (anchor, attachment) = (point(random), point(random));
            for side in [1.0, -1.0] {
                let mut leg = Leg::strut([0.0, 0.0], [0.0, 0.0]);
                leg.anchor = [anchor[0], side * anchor[1], anchor[2]].map(Interval::point);
                leg.attachment = [attachment[0], side * attachment[1], attachment[2]].map(Interval::point);
                legs.push(Locked::new::<3>(&leg, random.within((1.5, 2.5))));
            }
        }
        legs
    }

    /// Gradients and second derivatives are those that differences show, at any point.
    fn check<const V: usize>(system: &impl System<V>, random: &mut Random) {
        let mut any = || -> [Complex<f64>; V] {
            std::array::from_fn(|_| Complex::new(random.within((-1.0, 1.0)), random.within((-1.0, 1.0))))
        };
        let (u, d) = (any(), any());
        let beside = |h: f64| system.at::<Complex<f64>>(&std::array::from_fn(|k| u[k] + d[k] * h)).0;
        let (h, far) = (1e-4, 1e-3);
        let (here, rows) = system.at(&u);
        let bends = system.bends(&u, &d);
        for k in 0..V {
            let slope = (beside(h)[k] - beside(-h)[k]) / (2.0 * h);
            assert!((slope - dot(&rows[k], &d)).norm() < 1e-5 * (1.0 + slope.norm()), "gradient {k} of {V}");
            let bend = (beside(far)[k] - here[k] * 2.0 + beside(-far)[k]) / (far * far);
            assert!((bend - bends[k]).norm() < 1e-3 * (1.0 + bend.norm()), "second derivative {k} of {V}");
        }
    }

    #[test]
    fn derivatives_are_those_of_the_equations() {
        let mut random = Random::new(1);
        let legs = mirrored(&mut random);
        let (problem, _) = problem(&legs);
        let ends = problem.solve();
        for end in &ends {
            for start in Start::near(problem.forms(), &end.point) {
                check(&Turned::near(problem.forms(), &start).0, &mut random);
                check(&Spanned::near(problem.forms(), &start).unwrap().0, &mut random);
            }
        }
    }

    /// In both charts a common point of the quadrics fulfils the equations.
    #[test]
    fn poses_are_points_of_the_closure() {
        let legs = mirrored(&mut Random::new(2));
        let (problem, _) = problem(&legs);
        let ends = problem.solve();
        let proofs = problem.prove(&ends);
        let mut poses = 0;
        for (end, _) in ends.iter().zip(&proofs).filter(|(_, p)| p.is_some_and(|p| p.is_rotation())) {
            let start = &Start::near(problem.forms(), &end.point)[0];
            let (turned, u) = Turned::near(problem.forms(), start);
            let (spanned, v) = Spanned::near(problem.forms(), start).unwrap();
            let off = |values: &[Complex<f64>]| values.iter().map(|z| z.norm()).fold(0.0, f64::max);
            assert!(off(&turned.at::<Complex<f64>>(&std::array::from_fn(|k| u.get(k))).0) < 1e-9);
            assert!(off(&spanned.at::<Complex<f64>>(&std::array::from_fn(|k| v.get(k))).0) < 1e-9);
            poses += 1;
        }
        assert_eq!((poses, elsewhere(problem.forms(), &ends, &proofs)), (MOST - 4, 4));
    }

    /// A path that is left out or followed twice is a point that is not counted.
    #[test]
    fn with_a_point_less_nothing_is_complete() {
        let legs = mirrored(&mut Random::new(3));
        let (problem, _) = problem(&legs);
        let all = problem.solve();
        let count = |ends: &Ends<8>| elsewhere(problem.forms(), ends, &problem.prove(ends));
        let is_pose: Vec<bool> =
            problem.prove(&all).iter().map(|p| p.is_some_and(|p| p.is_rotation())).collect();
        let lost: Vec<usize> = (0..all.len()).filter(|&k| !is_pose[k]).collect();
        assert_eq!((lost.len(), count(&all)), (4, 4));
        // The conjugate of a point that is left out brings it back.
        let without = |gone: &[usize]| -> Ends<8> {
            (0..all.len()).filter(|k| !gone.contains(k)).map(|k| all[k]).collect()
        };
        assert_eq!(count(&without(&lost[..1])), 4);
        assert_eq!(count(&without(&lost)), 0);
        let mut twice = without(&lost[1..]);
        twice.extend([all[lost[0]]; 3]);
        assert_eq!(count(&twice), 2);
        // A pose that is not proved is no point elsewhere.
        let proofs: Vec<_> = problem.prove(&all).iter().map(|_| None).collect();
        let real = all.iter().filter(|end| end.point.is_real()).count();
        assert_eq!(elsewhere(problem.forms(), &all, &proofs), MOST - real);
    }
}
