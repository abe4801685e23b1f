//! All common points of a family's target, tracked, completed by their conjugates, and proved.

use super::Point;
use super::forms::{Family, Quadrics};
use super::prove::{Enclosed, Proved, differ};
use super::track::{End, Ends, Pace, Tracker, polish, settle};
use aspecta_robot::num::Interval;

/// A problem with real coefficients.
pub(crate) struct Problem<'a, const V: usize, const F: usize> {
    /// A generic member of its family.
    start: &'a Quadrics<V, F>,
    /// Its common points.
    points: &'a [Point<V>],
    /// The enclosures of the coefficients,
    forms: Enclosed<V, F>,
    /// and their midpoints.
    target: Quadrics<V, F>,
}

/// Points of norm one whose difference is below this are taken for one.
const SAME: f64 = 1e-9;
/// Regular points with imaginary parts below this are tried as real ones.
const NEARLY_REAL: f64 = 1e-6;
/// Before they are as good as they can be, their imaginary parts may be as large as this.
const MAY_BE_REAL: f64 = 1e-3;

impl<'a, const V: usize, const F: usize> Problem<'a, V, F> {
    /// The quadrics `forms`, of the family of `start` with its common `points`.
    pub fn new(start: &'a Quadrics<V, F>, points: &'a [Point<V>], forms: Enclosed<V, F>) -> Self {
        let column = |c: &[Interval; V]| Point::real(c.map(Interval::mid));
        let target = Quadrics { forms: forms.each_ref().map(|form| form.each_ref().map(column)) };
        Self { start, points, forms, target }
    }

    /// The enclosures of its forms.
    pub fn forms(&self) -> &Enclosed<V, F> {
        &self.forms
    }

    /// Follows all paths; again and with care those that were lost or came to the same point as another.
    ///
    /// The ends are different points, as far as numbers tell; real ones have real coordinates.
    pub fn solve(&self) -> Ends<V> {
        let mut tracker = Tracker::new(Family { start: self.start, target: &self.target });
        let mut follow = |x: &Point<V>, pace: Pace| {
            let end = tracker.follow(x, pace);
            // Whether it is real must not hang on a step that is still to come.
            let may_be_real = end.arrived && most_imaginary(&end.point) < MAY_BE_REAL;
            if may_be_real { End { point: settle(&self.target, end.point), ..end } } else { end }
        };
        let mut ends: Ends<V> = self.points.iter().map(|x| follow(x, Pace::QUICK)).collect();
        for pace in [Pace::CAREFUL, Pace::PATIENT] {
            let doubtful = |i: &usize| {
                !ends[*i].arrived || (0..ends.len()).any(|j| j != *i && coincide(&ends[*i], &ends[j]))
            };
            let again: Vec<usize> = (0..ends.len()).filter(doubtful).collect();
            for i in again {
                ends[i] = follow(&self.points[i], pace);
            }
        }
        let mut found = Ends::new();
        for end in ends {
            let point = if end.arrived { as_real(&self.target, end.point) } else { end.point };
            add(&mut found, End { point, ..end });
        }
        // Real quadrics have the conjugates in common too.
        for k in 0..found.len() {
            let end = found[k];
            if end.arrived && !end.point.is_real() {
                add(&mut found, End { point: end.point.conjugate(), ..end });
            }
        }
        found
    }

    /// The common points next to real points that are good approximations; `None` if two of them come out as
    /// one.
    pub fn near(&self, points: &[Point<V>]) -> Option<Ends<V>> {
        let mut ends = Ends::new();
        for x in points {
            add(&mut ends, End { point: polish(&self.target, *x), arrived: true });
        }
        (ends.len() == points.len()).then_some(ends)
    }

    /// The proofs of the ends that are proved to be common points, each different from all the others and, unless it has real coordinates, not
    /// real.
    pub fn prove(&self, ends: &Ends<V>) -> Vec<Option<Proved<V>>> {
        let mut proofs: Vec<Option<Proved<V>>> = Vec::with_capacity(ends.len());
        for end in ends {
            let proof = if end.arrived { Proved::near(&self.forms, &self.target, &end.point) } else { None };
            // A point that may be real, without being known as such, must not count as one that is not.
            let is_known = |new: &Proved<V>| end.point.is_real() || differ(new, &new.conjugate());
            let proof = proof.filter(is_known);
            proofs.push(proof.filter(|new| proofs.iter().flatten().all(|old| differ(old, new))));
        }
        proofs
    }
}

/// Whether a point is next to a real one, without having its coordinates.
pub(crate) fn is_nearly_real<const V: usize>(x: &Point<V>) -> bool {
    !x.is_real() && most_imaginary(x) <= NEARLY_REAL
}

fn most_imaginary<const V: usize>(x: &Point<V>) -> f64 {
    x.im.iter().fold(0.0f64, |most, y| most.max(y.abs()))
}

/// The real point next to a nearly real one, if it is there: if the method that looks for it stays.
fn as_real<const V: usize, const F: usize>(target: &Quadrics<V, F>, x: Point<V>) -> Point<V> {
    if !is_nearly_real(&x) {
        return x;
    }
    let off = most_imaginary(&x);
    let real = settle(target, Point::real(x.re));
    if distance(&real, &x) <= 10.0 * off + SAME { real } else { x }
}

/// Returns the sine of the angle between points of norm one.
fn distance<const V: usize>(a: &Point<V>, b: &Point<V>) -> f64 {
    let mut gap = *a;
    gap.add_scaled(-b.conjugate().dot(a), b);
    gap.norm()
}

fn coincide<const V: usize>(a: &End<V>, b: &End<V>) -> bool {
    a.arrived && b.arrived && distance(&a.point, &b.point) < SAME
}

/// Adds an end that is not there already, as long as there is room.
fn add<const V: usize>(found: &mut Ends<V>, end: End<V>) {
    if !found.is_full() && found.iter().all(|other| !coincide(other, &end)) {
        found.push(end);
    }
}
