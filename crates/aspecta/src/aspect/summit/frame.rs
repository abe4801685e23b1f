//! Tangent vectors along which everything has bounded derivatives.

use super::leg::LegPart;
use super::view::View;
use arrayvec::ArrayVec;
use aspecta_robot::num::Interval;

/// M tangent vectors over a box, adapted to its singular legs.
pub(super) struct Frame<const N: usize, const M: usize> {
    /// Their components in the scaled coordinates.
    vectors: [[Interval; M]; M],
    /// ḣ_j along each, for j ∈ J.
    pub climb: [[Interval; N]; M],
    /// J.
    pub singular: [bool; N],
}

impl<const N: usize, const M: usize> Frame<N, M> {
    /// `None` if more legs are singular than there are coordinates.
    pub(super) fn new<const D: usize>(
        view: &View<'_, D, N, M>,
        legs: &[LegPart<N, M>],
        lane: usize,
    ) -> Option<Self> {
        let singular: [bool; N] = std::array::from_fn(|j| legs[j].singular[lane]);
        let half = Interval::point(0.5);
        let own_legs: ArrayVec<usize, N> =
            (0..N).filter(|&j| singular[j] && view.twin_of[j].is_none()).collect();
        if own_legs.len() > M {
            return None;
        }
        let gradients: [[Interval; M]; N] = std::array::from_fn(|j| view.reach[j].gradient_in(lane));
        let normals: ArrayVec<[Interval; M], M> = own_legs.iter().map(|&j| gradients[j]).collect();
        let (directions, own) = adapted(&normals)?;
        let heights: [Interval; N] = std::array::from_fn(|j| legs[j].height.lane(lane));
        let mut vectors = directions;
        let mut climb = [[Interval::point(0.0); N]; M];
        for i in 0..M {
            let leg = own[i].map(|k| own_legs[k]);
            if let Some(j) = leg {
                vectors[i] = directions[i].map(|x| x * heights[j]);
                climb[i][j] = dot(&gradients[j], &directions[i]) * half;
            }
        }
        for (j, twin) in view.twin_of.iter().enumerate() {
            if let Some(twin) = *twin {
                climb.iter_mut().for_each(|climb| climb[j] = climb[twin]);
            }
        }
        Some(Self { vectors, climb, singular })
    }

    /// The derivatives of a function along the vectors, from its gradient at fixed h and, for the legs in
    /// `own`, (leg, posture, derivative with respect to s h).
    pub(super) fn along(&self, gradient: &[Interval; M], own: &[(usize, f64, Interval)]) -> [Interval; M] {
        std::array::from_fn(|i| {
            own.iter().fold(dot(gradient, &self.vectors[i]), |sum, (j, sign, partial)| {
                sum + *partial * self.climb[i][*j] * Interval::point(*sign)
            })
        })
    }
}

/// M directions, and the surface each belongs to.
type Directions<const M: usize> = ([[Interval; M]; M], [Option<usize>; M]);

/// M directions: first those tangent to all the surfaces with the given normals, then for each surface k one
/// (marked k) tangent to all the others.
fn adapted<const M: usize>(normals: &[[Interval; M]]) -> Option<Directions<M>> {
    let mut directions = [[Interval::point(0.0); M]; M];
    let mut own = [None; M];
    let middles: ArrayVec<[f64; M], M> = normals.iter().map(|n| unit_vector(&n.map(|x| x.mid()))).collect();
    let exact = |v: [f64; M]| v.map(Interval::point);
    let axis = |i: usize| std::array::from_fn(|k| f64::from(u8::from(i == k)));
    match (M, normals) {
        (_, []) => (0..M).for_each(|i| directions[i] = exact(axis(i))),
        (1, [_]) => (directions[0], own[0]) = (exact(axis(0)), Some(0)),
        (2, [n]) => {
            directions =
                [turned(n), exact(middles[0])].into_iter().collect::<ArrayVec<_, M>>().into_inner().ok()?;
            own[1] = Some(0);
        }
        (2, [n, m]) => {
            (directions[0], own[0]) = (turned(m), Some(0));
            (directions[1], own[1]) = (turned(n), Some(1));
        }
        (3, [n]) => {
            let c = middles[0];
            let least = (0..M).min_by(|&a, &b| c[a].abs().total_cmp(&c[b].abs()))?;
            let u = unit_vector(&cross(&exact(c), &exact(axis(least))).map(|x| x.mid()));
            let v = unit_vector(&cross(&exact(c), &exact(u)).map(|x| x.mid()));
            (directions[0], directions[1]) = (cross(n, &exact(u)), cross(n, &exact(v)));
            (directions[2], own[2]) = (exact(c), Some(0));
        }
        (3, [n, m]) => {
            let edge = exact(unit_vector(&cross(&exact(middles[0]), &exact(middles[1])).map(|x| x.mid())));
            directions[0] = cross(n, m);
            (directions[1], own[1]) = (cross(m, &edge), Some(0));
            (directions[2], own[2]) = (cross(n, &edge), Some(1));
        }
        (3, [n, m, l]) => {
            (directions[0], own[0]) = (cross(m, l), Some(0));
            (directions[1], own[1]) = (cross(l, n), Some(1));
            (directions[2], own[2]) = (cross(n, m), Some(2));
        }
        _ => return None,
    }
    Some((directions, own))
}

fn dot<const M: usize>(a: &[Interval; M], b: &[Interval; M]) -> Interval {
    (0..M).fold(Interval::point(0.0), |sum, k| sum + a[k] * b[k])
}

fn unit_vector<const M: usize>(v: &[f64; M]) -> [f64; M] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length.is_normal() { v.map(|x| x / length) } else { *v }
}

/// A quarter turn in the plane: exactly perpendicular.
fn turned<const M: usize>(v: &[Interval; M]) -> [Interval; M] {
    let mut w = *v;
    (w[0], w[M - 1]) = (-v[M - 1], v[0]);
    w
}

/// The cross product in space: exactly perpendicular to both.
fn cross<const M: usize>(a: &[Interval; M], b: &[Interval; M]) -> [Interval; M] {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % M, (i + 2) % M);
        a[j] * b[k] - a[k] * b[j]
    })
}
