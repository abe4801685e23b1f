//! On which side of a line a body is: what parts two bodies, and whether they cross.

use super::{Axis, product, square};
use crate::turns::{Joint, Turn, beside};
use aspecta_robot::num::{Interval, Scalar};

/// On which side of a line the end of a body is: lines 0 to 3 are those of the first body, and the end is of the second.
pub(super) fn on_side<T: Scalar, const D: usize>(axes: &[Axis<T, D>; 2], line: usize, end: usize) -> T {
    let (own, point) = (&axes[line / 4], axes[1 - line / 4].end(end));
    let away: [T; D] = std::array::from_fn(|k| point[k] - own.from[k]);
    let across = own.along[0] * away[1] - own.along[1] * away[0];
    match line % 4 {
        0 => across,
        1 => -across,
        2 => product(&own.along, &away) - square(&own.along),
        _ => -product(&own.along, &away),
    }
}

/// How far the other body is on one side of each line.
pub(super) fn lesser_sides<const D: usize>(axes: &[Axis<Interval, D>; 2]) -> [Interval; 8] {
    std::array::from_fn(|line| on_side(axes, line, 0).least(on_side(axes, line, 1)))
}

/// Whether the axes of two bodies cross: the ends of each are on two sides of the other.
pub(super) fn do_cross<const D: usize>(axes: &[Axis<Interval, D>; 2]) -> bool {
    let opposite = |line: usize| on_side(axes, line, 0).sign() * on_side(axes, line, 1).sign() < 0;
    opposite(0) && opposite(4)
}

/// Whether a line parts the axes of two bodies.
pub(super) fn are_parted<const D: usize>(axes: &[Axis<Interval, D>; 2]) -> bool {
    lesser_sides(axes).iter().any(|side| side.is_positive())
}

/// The lines that may part two bodies best.
pub(super) fn lines<const D: usize>(axes: &[Axis<Interval, D>; 2]) -> impl Iterator<Item = usize> + use<D> {
    let lesser = lesser_sides(axes);
    let best = lesser.iter().fold(f64::NEG_INFINITY, |best, line| best.max(line.lo));
    (0..8).filter(move |line| lesser[*line].hi >= best)
}

/// The turns that the ends of the other body take on the side of a line; or that one, of an end of the line's body, that follows.
pub(super) fn turns_at(line: usize, joints: &[Joint; 4]) -> Vec<Turn> {
    let own = [joints[line / 4 * 2], joints[line / 4 * 2 + 1]];
    let other = [joints[2 - line / 4 * 2], joints[3 - line / 4 * 2]];
    let minus = |a: Joint, b: Joint| [a.1[0] - b.1[0], a.1[1] - b.1[1]];
    match line % 4 {
        side @ 0..2 => other.map(|end| Turn::new([own[0].0, own[1].0, end.0], side == 0)).to_vec(),
        2 => beside(own[1], minus(own[1], own[0]), other).into_iter().collect(),
        _ => beside(own[0], minus(own[0], own[1]), other).into_iter().collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use aspecta_robot::num::Random;

    fn axis([from, to]: [[f64; 2]; 2], off: f64) -> Axis<Interval, 2> {
        let boxed = |x: f64| Interval::new(x - off, x + off);
        let from = from.map(boxed);
        Axis { from, along: [0, 1].map(|k| boxed(to[k]) - from[k]) }
    }

    /// Whether two segments have a point in common, by where their lines meet.
    fn meet([[a, b], [c, d]]: [[[f64; 2]; 2]; 2]) -> bool {
        let minus = |p: [f64; 2], q: [f64; 2]| [p[0] - q[0], p[1] - q[1]];
        let cross = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
        let (first, second, gap) = (minus(b, a), minus(d, c), minus(c, a));
        let both = cross(first, second);
        let (u, v) = (cross(gap, second) / both, cross(gap, first) / both);
        (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v)
    }

    /// Known segments cross, or some line parts them; of those known less nothing is said that is not so.
    #[test]
    fn segments_cross_or_are_parted() {
        let random = &mut Random::new(3);
        let mut told = [0; 2];
        for _ in 0..5000 {
            let mut point = || [random.within((-1.0, 1.0)), random.within((-1.0, 1.0))];
            let ends = [[point(), point()], [point(), point()]];
            let exact = ends.map(|ends| axis(ends, 0.0));
            let crossing = meet(ends);
            assert_eq!((do_cross(&exact), are_parted(&exact)), (crossing, !crossing), "{ends:?}");
            let off = 10f64.powf(random.within((-4.0, -0.5)));
            let rough = ends.map(|ends| axis(ends, off));
            assert!(!do_cross(&rough) || crossing, "{ends:?} {off}");
            assert!(!are_parted(&rough) || !crossing, "{ends:?} {off}");
            told[0] += usize::from(do_cross(&rough));
            told[1] += usize::from(are_parted(&rough));
            // The best lines are among those that are looked at.
            let lesser = lesser_sides(&exact);
            let best = (0..8).max_by(|a, b| lesser[*a].mid().total_cmp(&lesser[*b].mid())).unwrap();
            assert!(lines(&rough).any(|line| line == best));
        }
        assert!(told.iter().all(|count| *count > 200), "{told:?}");
    }
}
