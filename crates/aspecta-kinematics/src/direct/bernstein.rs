//! Real roots of a polynomial on [0, 1], isolated by subdivision of its Bernstein form.
//!
//! The coefficients are known within a *slack*: every true coefficient lies within it of the double that
//! stands for it. Subdivision takes convex combinations, so the slack carries over to the parts, plus their
//! rounding. What is said of a part holds for every polynomial within the slack, hence for the true one.

use arrayvec::ArrayVec;

/// The polynomial on a part [lo, hi] of [0, 1], by its `M` Bernstein coefficients (degree M − 1) there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arc<const M: usize> {
    pub lo: f64,
    pub hi: f64,
    pub coefficients: [f64; M],
    slack: f64,
}

/// A part of [0, 1] that may hold roots. The parts returned are in order and hold all roots.
#[derive(Clone, Copy, Debug)]
pub(super) enum Piece<const M: usize> {
    /// Exactly one root, and a simple one.
    Root(Arc<M>),
    /// On [lo, hi] the polynomial is within its slack of zero and the number of roots is open.
    Cluster(f64, f64),
}

/// Isolated roots and clusters. Touching clusters are merged, so the capacity is ample: should it ever be
/// short, the last pieces merge into a cluster, which promises less and stays true.
pub(super) type Pieces<const M: usize> = ArrayVec<Piece<M>, 16>;

const DEEPEST: usize = 48;

impl<const M: usize> Arc<M> {
    /// The polynomial on [0, 1].
    pub fn new(coefficients: [f64; M], slack: f64) -> Self {
        Self { lo: 0.0, hi: 1.0, coefficients, slack }
    }

    /// Whether the signs at both ends are known.
    pub fn has_decided_ends(&self) -> bool {
        self.coefficients[0].abs() > self.slack && self.coefficients[M - 1].abs() > self.slack
    }

    /// The greatest number of sign variations any polynomial within the slack has. By Descartes' rule it
    /// bounds the number of roots, counted with multiplicity.
    fn most_variations(&self) -> i32 {
        const NEVER: i32 = -100;
        // The most variations up to here if the last sign is + and if it is −.
        let (mut plus, mut minus) = (0, 0);
        for c in self.coefficients {
            let (p, m) = (plus.max(minus + 1), minus.max(plus + 1));
            plus = if c >= -self.slack { p } else { NEVER };
            minus = if c <= self.slack { m } else { NEVER };
        }
        // The first coefficient has counted a variation against a sign before it that is not there.
        plus.max(minus) - 1
    }

    /// Both parts, cut at the fraction `at` of the arc (de Casteljau).
    fn split(&self, at: f64) -> (Self, Self) {
        let middle = self.lo + (self.hi - self.lo) * at;
        let (mut left, mut right) = (*self, *self);
        (left.hi, right.lo) = (middle, middle);
        let largest = self.coefficients.iter().fold(0.0, |a: f64, c| a.max(c.abs()));
        // Each of the M − 1 levels rounds two products and a sum: less than 2 EPSILON times the largest.
        let slack = self.slack + (M - 1) as f64 * 2.0 * f64::EPSILON * largest;
        (left.slack, right.slack) = (slack, slack);
        let b = &mut right.coefficients;
        for level in 1..M {
            for k in 0..M - level {
                b[k] = (1.0 - at) * b[k] + at * b[k + 1];
            }
            left.coefficients[level] = b[0];
        }
        (left, right)
    }

    /// Both halves, cut a little off the middle where the sign in the middle is not known.
    fn halves(&self) -> (Self, Self) {
        let halves = self.split(0.5);
        if halves.1.coefficients[0].abs() > halves.1.slack {
            return halves;
        }
        let off_centre = [0.4375, 0.5625, 0.375, 0.625].map(|at| self.split(at));
        *off_centre.iter().find(|h| h.1.coefficients[0].abs() > h.1.slack).unwrap_or(&halves)
    }

    fn largest(&self) -> f64 {
        self.coefficients.iter().fold(0.0, |a, c| a.max(c.abs()))
    }

    /// The value and its derivative at the fraction `t` of the arc.
    fn value_and_slope(&self, t: f64) -> (f64, f64) {
        let mut b = self.coefficients;
        for level in 1..M - 1 {
            for k in 0..M - level {
                b[k] += t * (b[k + 1] - b[k]);
            }
        }
        (b[0] + t * (b[1] - b[0]), (M - 1) as f64 * (b[1] - b[0]))
    }

    /// The root of an arc with one root, in [0, 1] as the whole polynomial is, to `tolerance` times the arc:
    /// Newton's method within a shrinking bracket.
    pub fn root(&self, tolerance: f64) -> f64 {
        let (first, last) = (self.coefficients[0], self.coefficients[M - 1]);
        let (mut low, mut high) = (0.0, 1.0);
        let mut t = first / (first - last);
        for _ in 0..64 {
            let (value, slope) = self.value_and_slope(t);
            if (value > 0.0) == (last > 0.0) {
                high = t;
            } else {
                low = t;
            }
            let newton = t - value / slope;
            let next = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
            let step = (next - t).abs();
            t = next;
            if step <= tolerance {
                break;
            }
        }
        self.lo + (self.hi - self.lo) * t
    }
}

/// Isolates the roots of the polynomial in [0, 1].
pub(super) fn isolate<const M: usize>(whole: Arc<M>) -> Pieces<M> {
    let mut pieces = Pieces::new();
    let mut open: ArrayVec<(Arc<M>, usize), { DEEPEST + 2 }> = ArrayVec::new();
    open.push((whole, 0));
    while let Some((arc, depth)) = open.pop() {
        let variations = arc.most_variations();
        if variations == 0 {
            continue;
        }
        let opposite = arc.coefficients[0] * arc.coefficients[M - 1] < 0.0;
        if variations == 1 && opposite && arc.has_decided_ends() {
            add(&mut pieces, Piece::Root(arc));
        } else if depth == DEEPEST || arc.largest() <= 4.0 * arc.slack {
            add(&mut pieces, Piece::Cluster(arc.lo, arc.hi));
        } else {
            let (left, right) = arc.halves();
            open.push((right, depth + 1));
            open.push((left, depth + 1));
        }
    }
    pieces
}

impl<const M: usize> Piece<M> {
    fn range(&self) -> (f64, f64) {
        match self {
            Self::Root(arc) => (arc.lo, arc.hi),
            Self::Cluster(lo, hi) => (*lo, *hi),
        }
    }
}

fn add<const M: usize>(pieces: &mut Pieces<M>, piece: Piece<M>) {
    let full = pieces.is_full();
    match (pieces.last_mut(), piece) {
        (Some(Piece::Cluster(_, end)), Piece::Cluster(lo, hi)) if *end == lo => *end = hi,
        (Some(last), _) if full => *last = Piece::Cluster(last.range().0, piece.range().1),
        _ => pieces.push(piece),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Bernstein coefficients of Π (t − rₖ), by repeated multiplication with t − r = −r(1 − t) + (1 − r)t.
    fn from_roots(roots: [f64; 6]) -> [f64; 7] {
        let binomial = |n: usize, k: usize| (1..=k).fold(1.0, |b, i| b * (n + 1 - i) as f64 / i as f64);
        let mut scaled = vec![1.0];
        for r in roots {
            let mut next = vec![0.0; scaled.len() + 1];
            for (k, c) in scaled.iter().enumerate() {
                next[k] -= r * c;
                next[k + 1] += (1.0 - r) * c;
            }
            scaled = next;
        }
        std::array::from_fn(|k| scaled[k] / binomial(6, k))
    }

    proptest! {
        #[test]
        fn every_root_is_in_a_piece(roots in prop::array::uniform6(-0.5..1.5f64)) {
            let pieces = isolate(Arc::new(from_roots(roots), 1e-14));
            let inside = |r: &f64| 0.0 < *r && *r < 1.0;
            for r in roots.iter().filter(|r| inside(r)) {
                prop_assert!(pieces.iter().any(|p| p.range().0 <= r + 1e-12 && r - 1e-12 <= p.range().1));
            }
            if pieces.iter().all(|p| matches!(p, Piece::Root(_))) {
                prop_assert_eq!(pieces.len(), roots.iter().filter(|r| inside(r)).count());
                for p in &pieces {
                    let Piece::Root(arc) = p else { unreachable!() };
                    let t = arc.root(1e-15);
                    prop_assert!(roots.iter().any(|r| (r - t).abs() < 1e-4));
                }
            }
        }
    }

    #[test]
    fn a_double_root_is_one_cluster() {
        for r in [0.5, 0.3, 0.71] {
            let pieces = isolate(Arc::new(from_roots([r, r, -1.0, -2.0, 3.0, 0.9]), 1e-14));
            assert_eq!(pieces.len(), 2, "{r}: {pieces:?}");
            let Piece::Cluster(lo, hi) = pieces[0] else { panic!("{pieces:?}") };
            assert!(lo < r && r < hi && hi - lo < 1e-5);
        }
    }

    #[test]
    fn a_near_double_root_is_two_roots_or_none() {
        let with_gap = |shift: f64| {
            let mut c = from_roots([0.4, 0.4, -1.0, -2.0, 3.0, 4.0]);
            c.iter_mut().for_each(|c| *c += shift);
            isolate(Arc::new(c, 1e-15))
        };
        assert_eq!(with_gap(-1e-9).iter().filter(|p| matches!(p, Piece::Root(_))).count(), 2);
        assert!(with_gap(1e-9).is_empty());
    }

    #[test]
    fn roots_at_the_cuts_are_found_once() {
        let pieces = isolate(Arc::new(from_roots([0.5, 0.25, 0.75, 0.125, -1.0, 2.0]), 1e-15));
        assert!(pieces.len() == 4 && pieces.iter().all(|p| matches!(p, Piece::Root(_))), "{pieces:?}");
    }
}
