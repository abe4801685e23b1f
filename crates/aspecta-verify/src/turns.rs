//! Which way three joints of a planar machine turn, and turns that cannot be at once (docs/theory.md, 5).

use super::in_mode::InMode;
use super::twins::is_one_number;
use aspecta_robot::num::Interval;
use aspecta_robot::{Body, LegIndex, Platform, Robot};

/// A joint; those that are always one point have one name.
pub(super) type Name = (u8, usize, usize);

/// A joint and where it is.
pub(super) type Joint = (Name, [Interval; 2]);

/// Three joints, and whether they follow one another counter-clockwise.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Turn {
    joints: [Name; 3],
    left: bool,
}

impl Turn {
    pub(super) fn new(joints: [Name; 3], left: bool) -> Self {
        let mut sorted = joints;
        sorted.sort_unstable();
        // An odd permutation turns the other way.
        let place = |name: &Name| joints.iter().position(|joint| joint == name).unwrap_or(0);
        let [a, b, c] = sorted.each_ref().map(place);
        let odd = usize::from(a > b) + usize::from(a > c) + usize::from(b > c);
        Self { joints: sorted, left: left == odd.is_multiple_of(2) }
    }
}

/// The names of the joints at the ends of a body.
pub(super) fn joints(robot: &Robot, body: Body) -> [Name; 2] {
    let like = |leg: LegIndex, same: &dyn Fn(usize) -> bool| {
        (0..leg.index()).find(|&i| same(i)).unwrap_or(leg.index())
    };
    let anchor =
        |leg: LegIndex| (0, like(leg, &|i| is_one(&robot.legs[i].anchor, &robot.leg(leg).anchor)), 0);
    let end =
        |leg: LegIndex| (2, like(leg, &|i| is_one(&robot.legs[i].attachment, &robot.leg(leg).attachment)), 0);
    match body {
        Body::Crank(leg) => [anchor(leg), (1, leg.index(), 0)],
        Body::Rod(leg) if robot.leg(leg).actuator.postures() == 1 => [anchor(leg), end(leg)],
        Body::Rod(leg) => [(1, leg.index(), 0), end(leg)],
        Body::Platform(number) => [(3, number, 0), (3, number, 1)],
        Body::Obstacle(number) => [(4, number, 0), (4, number, 1)],
    }
}

/// Whether two points are one: the same numbers, known to rounding.
fn is_one(a: &[Interval; 3], b: &[Interval; 3]) -> bool {
    a == b && a.iter().all(is_one_number)
}

impl<const D: usize> InMode<'_, '_, D> {
    /// Turns that the mode and the sign of det A fix. Of a leg with a crank f = ‖C − B‖² − M² has ∂f/∂q = −2 (B − A) × (C − B); of a point in the plane det A is 4 (C − B_1) × (C − B_2).
    pub(super) fn turns(&self, det: f64) -> Vec<Turn> {
        let robot = self.place.setting.robot;
        let of_leg = |j: usize| {
            let (leg, is_crank) = (LegIndex::new(j), robot.legs[j].actuator.kind().facts().has_elbow);
            let [[anchor, elbow], [_, end]] =
                [joints(robot, Body::Crank(leg)), joints(robot, Body::Rod(leg))];
            (D == 2 && is_crank).then(|| Turn::new([anchor, elbow, end], self.mode.sign(j) < 0))
        };
        let mut all: Vec<Turn> = (0..robot.legs.len()).filter_map(of_leg).collect();
        let setting = self.place.setting;
        let [[first, end], [second, other]] = [0, 1].map(|j| joints(robot, Body::Rod(LegIndex::new(j))));
        let is_of_rods = robot.platform == Platform::PlanePoint && end == other;
        if is_of_rods && !setting.vanishes_in(self.mode) && setting.replaced_in(self.mode).next().is_none() {
            all.push(Turn::new([end, first, second], det > 0.0));
        }
        all
    }
}

/// Whether some of the turns are opposite, or of four joints in a row turn one way, the other and the first again in the order 123, 124, 134, 234: second
/// divided differences of four points are monotone in this order.
pub(super) fn are_impossible(turns: &[Turn], all: &[Joint]) -> bool {
    if turns.iter().any(|a| turns.iter().any(|b| a.joints == b.joints && a.left != b.left)) {
        return true;
    }
    let mut row: Vec<Joint> = Vec::new();
    for joint in all {
        if row.iter().all(|(name, _)| *name != joint.0) {
            row.push(*joint);
        }
    }
    let n = row.len();
    let fours = (0..n)
        .flat_map(|a| (0..a).flat_map(move |b| (0..b).flat_map(move |c| (0..c).map(move |d| [a, b, c, d]))));
    fours.into_iter().any(|four| {
        let four = four.map(|k| row[k]);
        sorted(four).is_some_and(|four| {
            let [a, b, c, d] = four.map(|(name, _)| name);
            let way = |joints: [Name; 3]| {
                let asked = Turn::new(joints, true);
                turns.iter().find(|turn| turn.joints == asked.joints).map(|turn| turn.left == asked.left)
            };
            let ways: Vec<bool> =
                [[a, b, c], [a, b, d], [a, c, d], [b, c, d]].into_iter().filter_map(way).collect();
            ways.windows(2).filter(|two| two[0] != two[1]).count() > 1
        })
    })
}

/// Four joints in the order in which they surely follow one another along the direction from one to another.
fn sorted(four: [Joint; 4]) -> Option<[Joint; 4]> {
    let ways = (0..4).flat_map(|i| (0..i).map(move |j| [i, j]));
    ways.into_iter().find_map(|[i, j]| {
        let way = [0, 1].map(|axis| Interval::point(four[i].1[axis].mid() - four[j].1[axis].mid()));
        let along = |joint: &Joint| joint.1[0] * way[0] + joint.1[1] * way[1];
        let mut four = four;
        four.sort_by(|a, b| along(a).lo.total_cmp(&along(b).lo));
        four.windows(2).all(|two| along(&two[0]).hi < along(&two[1]).lo).then_some(four)
    })
}

/// The turn that follows if both ends of a segment are farther in direction `out` than a point E that is surely beside it. With its ends X and Y,
/// E = X + τ (Y − X) + h n and n at a right angle, left of Y − X: out·(X − E) and out·(Y − E) have the mean −h out·n, weighted with 1 − τ and τ.
pub(super) fn beside(end: Joint, out: [Interval; 2], [x, y]: [Joint; 2]) -> Option<Turn> {
    let minus = |a: [Interval; 2], b: [Interval; 2]| [a[0] - b[0], a[1] - b[1]];
    let dot = |a: [Interval; 2], b: [Interval; 2]| a[0] * b[0] + a[1] * b[1];
    let along = minus(y.1, x.1);
    let inside = dot(along, minus(end.1, x.1)).is_positive() && dot(along, minus(y.1, end.1)).is_positive();
    let normal = [-along[1], along[0]];
    match dot(normal, out) {
        side if inside && side.is_positive() => Some(Turn::new([x.0, y.0, end.0], false)),
        side if inside && side.is_negative() => Some(Turn::new([x.0, y.0, end.0], true)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use aspecta_robot::num::Random;

    const NAMES: [Name; 4] = [(3, 1, 0), (3, 1, 1), (3, 2, 0), (3, 2, 1)];

    fn across([a, b, c]: [[f64; 2]; 3]) -> f64 {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    fn joint(k: usize, point: [f64; 2], radius: f64) -> Joint {
        (NAMES[k], point.map(|x| Interval::new(x - radius, x + radius)))
    }

    /// Turns that points have are possible; of their opposites half are not, where the points are known to follow one another.
    #[test]
    fn what_points_do_is_possible() {
        let random = &mut Random::new(5);
        let mut told = 0;
        for _ in 0..3000 {
            let flat = 10f64.powf(random.within((-6.0, 0.0)));
            let points: [[f64; 2]; 4] =
                std::array::from_fn(|_| [random.within((-1.0, 1.0)), flat * random.within((-1.0, 1.0))]);
            let radius = 10f64.powf(random.within((-8.0, -1.0)));
            let all: Vec<Joint> = (0..4).map(|k| joint(k, points[k], radius)).collect();
            let triples = [[3, 1, 2], [0, 1, 3], [2, 0, 3], [1, 2, 0]];
            let turns = |flipped: usize| -> Vec<Turn> {
                let left = |k: usize| across(triples[k].map(|i| points[i])) > 0.0;
                (0..4)
                    .map(|k| Turn::new(triples[k].map(|i| NAMES[i]), left(k) != (flipped >> k & 1 == 1)))
                    .collect()
            };
            assert!(!are_impossible(&turns(0), &all), "{points:?} {radius}");
            let found = (1..16).filter(|flipped| are_impossible(&turns(*flipped), &all)).count();
            assert!(found == 0 || found == 8, "{found}");
            told += usize::from(found == 8);
        }
        assert!(told > 600, "{told}");
    }

    #[test]
    fn what_follows_beside_an_end_is_so() {
        let random = &mut Random::new(3);
        let mut seen = 0;
        for _ in 0..20_000 {
            let mut point = || [random.within((-1.0, 1.0)), random.within((-1.0, 1.0))];
            let [from, end, x, y] = [point(), point(), point(), point()];
            let out = [0, 1].map(|k| end[k] - from[k]);
            let beyond = |p: [f64; 2]| (0..2).map(|k| out[k] * (p[k] - end[k])).sum::<f64>() > 0.0;
            if beyond(x) && beyond(y) {
                let found = beside(
                    joint(1, end, 0.0),
                    out.map(Interval::point),
                    [joint(2, x, 0.0), joint(3, y, 0.0)],
                );
                let expected = Turn::new([NAMES[2], NAMES[3], NAMES[1]], across([x, y, end]) > 0.0);
                assert!(found.is_none_or(|turn| turn == expected));
                seen += usize::from(found.is_some());
            }
        }
        assert!(seen > 500, "{seen}");
    }
}
