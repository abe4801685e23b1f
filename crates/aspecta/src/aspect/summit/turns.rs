//! Turns of a planar machine's joints that cannot be at once.
//!
//! Thin links touch where three joints lie on one line, and links share joints: functions that bound an aspect are then equal, opposite, or bound to
//! one another, wherever the robot is. What cannot be positive at once bounds nothing, but no enclosure of the functions one by one shows it.

use arrayvec::ArrayVec;
use aspecta_kinematics::constraints::{Joint, Turn};
use aspecta_robot::num::Interval;

/// A point of the plane.
pub(super) type Place = [Interval; 2];

/// Most joints that are looked at together.
const MOST_JOINTS: usize = 10;

/// Whether some of the turns cannot be at once, the joints being where `places` has them.
pub(super) fn are_impossible(turns: &[Turn], places: &[(Joint, Place)]) -> bool {
    let opposite = |a: &Turn| turns.iter().any(|b| a.joints() == b.joints() && a != b);
    turns.iter().any(opposite) || have_impossible_four(turns, places)
}

/// Whether the turns of some four joints, which follow one another along some direction in this order, change more than once in the order 123, 124, 134, 234.
///
/// With the abscissae x and the ordinates f the second divided differences f_ijk have the signs of the turns, and
/// f_124 − f_123 = D (x_4 − x_3), f_134 − f_123 = D (x_4 − x_2), f_234 − f_123 = D (x_4 − x_1) with the third, D: f_123, f_124, f_134, f_234 is monotone.
fn have_impossible_four(turns: &[Turn], places: &[(Joint, Place)]) -> bool {
    let mut joints: ArrayVec<(Joint, Place), MOST_JOINTS> = ArrayVec::new();
    for place in places {
        let is_new = joints.iter().all(|(joint, _)| *joint != place.0);
        if is_new && joints.try_push(*place).is_err() {
            return false;
        }
    }
    let n = joints.len();
    let among = (0u32..1 << n).filter(|some| some.count_ones() == 4);
    among.into_iter().any(|some| {
        let four: ArrayVec<(Joint, Place), 4> =
            (0..n).filter(|k| some >> k & 1 == 1).map(|k| joints[k]).collect();
        let known = turns
            .iter()
            .filter(|turn| turn.joints().iter().all(|joint| four.iter().any(|(j, _)| j == joint)));
        known.count() >= 3 && in_order(&four).is_some_and(|four| changes_twice(&four, turns))
    })
}

/// The four as they follow one another along some direction, if they surely do.
fn in_order(four: &[(Joint, Place)]) -> Option<[Joint; 4]> {
    let middle = |k: usize| four[k].1.map(Interval::mid);
    let apart = |i: usize, j: usize| [0, 1].map(|axis| middle(j)[axis] - middle(i)[axis]);
    let square = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
    let pairs = (0..4).flat_map(|i| (0..i).map(move |j| (i, j)));
    let (i, j) = pairs.max_by(|a, b| square(apart(a.0, a.1)).total_cmp(&square(apart(b.0, b.1))))?;
    let way = apart(i, j).map(Interval::point);
    let along = |place: &Place| place[0] * way[0] + place[1] * way[1];
    let mut order: ArrayVec<(Joint, Interval), 4> =
        four.iter().map(|(joint, place)| (*joint, along(place))).collect();
    order.sort_by(|a, b| a.1.lo.total_cmp(&b.1.lo));
    let follow = order.windows(2).all(|two| two[0].1.hi < two[1].1.lo);
    follow.then(|| std::array::from_fn(|k| order[k].0))
}

/// Whether what is known of these turns changes at least twice.
fn changes_twice(&[a, b, c, d]: &[Joint; 4], turns: &[Turn]) -> bool {
    let left = |joints: [Joint; 3]| turns.iter().find_map(|turn| turn.is_left(joints));
    let known: ArrayVec<bool, 4> =
        [[a, b, c], [a, b, d], [a, c, d], [b, c, d]].into_iter().filter_map(left).collect();
    known.windows(2).filter(|two| two[0] != two[1]).count() >= 2
}

/// The turn that is implied where both ends of a body, `other`, are beyond the end of another one that points in direction `out`: if that end is
/// surely beside the body, seen along it, then it is on the side from which it points there.
///
/// With the end E = X + τ (Y − X) + h n, 0 < τ < 1 and n a quarter turn ahead of Y − X, it follows from out·(X − E) > 0 and out·(Y − E) > 0 that
/// −h out·n = (1 − τ) out·(X − E) + τ out·(Y − E) > 0.
pub(super) fn implied(end: (Joint, Place), out: Place, other: [(Joint, Place); 2]) -> Option<Turn> {
    let minus = |a: &Place, b: &Place| [a[0] - b[0], a[1] - b[1]];
    let dot = |a: &Place, b: &Place| a[0] * b[0] + a[1] * b[1];
    let [(x, at_x), (y, at_y)] = other;
    let along = minus(&at_y, &at_x);
    let (after, before) = (dot(&along, &minus(&end.1, &at_x)), dot(&along, &minus(&at_y, &end.1)));
    let across = along[0] * out[1] - along[1] * out[0];
    let is_beside = after.is_positive() && before.is_positive() && across.sign() != 0;
    is_beside.then(|| Turn::new([x, y, end.0], across.is_negative()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use aspecta_robot::num::Random;
    use aspecta_robot::{Body, catalogue};

    /// Four joints, of two bodies of a platform.
    fn joints() -> [Joint; 4] {
        let robot = catalogue::find("3-rrr").unwrap();
        let [[a, b], [c, d]] = [1, 2].map(|number| Joint::of(&robot, Body::Platform(number)));
        [a, b, c, d]
    }

    fn across([a, b, c]: [[f64; 2]; 3]) -> f64 {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    fn boxed(point: [f64; 2], radius: f64) -> Place {
        point.map(|x| Interval::new(x - radius, x + radius))
    }

    /// Turns that four points have are possible, whatever is known of where they are; and of their sixteen opposites those are told
    /// that change more than once.
    #[test]
    fn what_points_do_is_possible() {
        let (random, joints) = (&mut Random::new(7), joints());
        let mut told = 0;
        for _ in 0..5000 {
            let flat = 10f64.powf(random.within((-6.0, 0.0)));
            let points: [[f64; 2]; 4] =
                std::array::from_fn(|_| [random.within((-1.0, 1.0)), flat * random.within((-1.0, 1.0))]);
            let radius = 10f64.powf(random.within((-8.0, -1.0)));
            let places: Vec<(Joint, Place)> = (0..4).map(|k| (joints[k], boxed(points[k], radius))).collect();
            let triples = [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]];
            let turns = |flipped: usize| -> Vec<Turn> {
                let left = |k: usize| across(triples[k].map(|i| points[i])) > 0.0;
                (0..4)
                    .map(|k| Turn::new(triples[k].map(|i| joints[i]), left(k) != (flipped >> k & 1 == 1)))
                    .collect()
            };
            assert!(!are_impossible(&turns(0), &places), "{points:?} {radius}");
            let found = (1..16).filter(|flipped| are_impossible(&turns(*flipped), &places)).count();
            // Of sixteen choices eight change at most once.
            assert!(found == 0 || found == 8, "{found}");
            told += usize::from(found == 8);
        }
        assert!(told > 1000, "{told}");
        let turn = Turn::new([joints[0], joints[1], joints[2]], true);
        assert!(are_impossible(&[turn, Turn::new([joints[1], joints[0], joints[2]], true)], &[]));
        assert!(!are_impossible(&[turn, Turn::new([joints[1], joints[2], joints[0]], true)], &[]));
    }

    /// Where both ends of a body are beyond the end of another, the turn that is said to follow does.
    #[test]
    fn what_is_implied_follows() {
        let (random, joints) = (&mut Random::new(11), joints());
        let mut seen = 0;
        for _ in 0..20_000 {
            let mut point = || [random.within((-1.0, 1.0)), random.within((-1.0, 1.0))];
            let [from, end, x, y] = [point(), point(), point(), point()];
            let out = [0, 1].map(|k| end[k] - from[k]);
            let beyond = |p: [f64; 2]| (0..2).map(|k| out[k] * (p[k] - end[k])).sum::<f64>() > 0.0;
            if !(beyond(x) && beyond(y)) {
                continue;
            }
            let at = |joint: usize, p: [f64; 2]| (joints[joint], boxed(p, 0.0));
            if let Some(turn) = implied(at(1, end), boxed(out, 0.0), [at(2, x), at(3, y)]) {
                let said = turn.is_left([joints[2], joints[3], joints[1]]).unwrap();
                assert_eq!(said, across([x, y, end]) > 0.0);
                seen += 1;
            }
        }
        assert!(seen > 500, "{seen}");
    }
}
