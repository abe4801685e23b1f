//! Pieces of path in pose coordinates, proved to lie in one aspect all along.

use crate::chart::{Chart, Coordinates};
use crate::constraints::{Constraint, Constraints, Demand};
use crate::for_platform;
use aspecta_robot::num::{Interval, Scalar, Slope};
use aspecta_robot::{LegIndex, Robot};

/// X(t), t ∈ [0, 1]: a polynomial of degree at most 3 in every pose coordinate; angles are real numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve {
    /// The coefficients of coordinate k, of 1, t, t², t³. They enclose the curve that is meant.
    coefficients: [[Interval; 4]; 6],
    degree: usize,
}

impl Curve {
    /// The straight segment between two poses (exact doubles).
    pub fn segment(start: &[f64], end: &[f64]) -> Self {
        let mut coefficients = [[Interval::point(0.0); 4]; 6];
        for ((c, start), end) in coefficients.iter_mut().zip(start).zip(end) {
            c[0] = Interval::point(*start);
            c[1] = Interval::point(*end) - c[0];
        }
        Self { coefficients, degree: 1 }
    }

    /// The cubic through two poses with the given derivatives with respect to t there (Hermite).
    pub fn cubic(start: &[f64], end: &[f64], speeds: [&[f64]; 2]) -> Self {
        let mut coefficients = [[Interval::point(0.0); 4]; 6];
        for (k, c) in coefficients.iter_mut().enumerate().take(start.len()) {
            let [a, b, u, v] = [start[k], end[k], speeds[0][k], speeds[1][k]].map(Interval::point);
            let gap = b - a;
            let (two, three) = (Interval::point(2.0), Interval::point(3.0));
            *c = [a, u, three * gap - two * u - v, u + v - two * gap];
        }
        Self { coefficients, degree: 3 }
    }

    /// The pose at t, numerically: exact at t = 0, to rounding elsewhere. n coordinates, then zeros.
    pub fn at(&self, t: f64) -> [f64; 6] {
        std::array::from_fn(|k| horner(&self.coefficients[k][..=self.degree], t))
    }

    /// The derivative with respect to t, numerically.
    pub fn speed(&self, t: f64) -> [f64; 6] {
        self.coefficients.map(|c| c[1].mid() + t * (2.0 * c[2].mid() + t * 3.0 * c[3].mid()))
    }

    /// Bounds of the moduli of the second derivatives with respect to t at all t of a stretch.
    pub fn bend(&self, stretch: Interval) -> [f64; 6] {
        let [two, six] = [2.0, 6.0].map(Interval::point);
        self.coefficients
            .map(|c| if self.degree < 2 { 0.0 } else { (two * c[2] + six * c[3] * stretch).magnitude() })
    }

    /// An enclosure of the poses at all t of a stretch, as a function of where in the stretch.
    pub fn over<const N: usize>(&self, stretch: Interval) -> [Slope<Interval, 1>; N] {
        let middle = Interval::point(stretch.mid());
        let radius = Interval::point((stretch - middle).magnitude());
        let t = Slope::variable(stretch, middle, radius, 0);
        std::array::from_fn(|k| horner(&self.coefficients[k][..=self.degree], t))
    }
}

fn horner<T: Scalar>(coefficients: &[Interval], t: T) -> T {
    let (last, rest) = coefficients.split_last().unwrap_or((&Interval::ENTIRE, &[]));
    rest.iter().rev().fold(T::constant(*last), |sum, &c| sum * t + T::constant(c))
}

/// The result of checking a demand along a curve by intervals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Along {
    /// It is met for all t: without a crossing, the curve lies in one generalized aspect.
    Inside,
    /// The crossing leg comes to its serial singularity on [`from`, `to`] for the first time, and all else
    /// that is demanded, of both its postures, is met from t = 0 up to there.
    Crossed {
        /// Start of the stretch, t.
        from: f64,
        /// End of the stretch, t: out of the leg's reach.
        to: f64,
    },
    /// The constraint certainly fails on part of [`from`, `to`].
    Outside {
        /// Which one.
        constraint: Constraint,
        /// Start of the stretch, t.
        from: f64,
        /// End of the stretch, t.
        to: f64,
    },
    /// Neither could be proved on [`from`, `to`] (t), shorter than 10⁻¹² or beyond the effort allowed.
    Undecided {
        /// Which constraint is in doubt.
        constraint: Constraint,
        /// Start of the stretch, t.
        from: f64,
        /// End of the stretch, t.
        to: f64,
    },
}

/// Stretches of t shorter than this are not bisected further.
const SHORTEST: f64 = 1e-12;

/// Decides whether a demand is met all along a curve, in at most `effort` interval evaluations.
///
/// Theorem. The range of a constraint over t ∈ T lies in the intersection of its natural interval extension
/// and its centred form about the middle of T ([`Slope`]). [0, 1] is bisected until each stretch has all
/// constraints > 0; the stretches cover [0, 1], so S_{s,σ} holds the whole curve, which is connected: it lies
/// in one aspect. Robot constants are intervals; the ends of a segment are taken as exact doubles, angles as
/// real numbers.
///
/// With a leg j that crosses, H_j is no condition; where H_j ≥ 0 the others are evaluated with h_j = √H_j, of
/// which [`Scalar::sqrt`] encloses all values. If H_j < 0 is proved at the end of stretches on which the
/// others are > 0, then H_j has a first zero t* there, and on [0, t*] both postures of leg j have all
/// others > 0: the robot can go to X(t*) in one posture and come back in the other, its det A ≠ 0 all the
/// while.
pub fn along(robot: &Robot, demand: &Demand, curve: &Curve, effort: usize) -> Along {
    along_in_chart(robot, &Chart::Pose, demand, curve, effort)
}

/// [`along`] for a curve in the coordinates of a chart. Its leg's own s B_jj > 0 is demanded in place of
/// H_j > 0; margins and crossings are those of poses.
fn along_in_chart(robot: &Robot, chart: &Chart, demand: &Demand, curve: &Curve, effort: usize) -> Along {
    for_platform!(robot.platform, along_in(robot, chart, demand, curve, effort))
}

fn along_in<const D: usize, const N: usize>(
    robot: &Robot,
    chart: &Chart,
    demand: &Demand,
    curve: &Curve,
    effort: usize,
) -> Along {
    let mut open = vec![(0.0, 1.0)];
    let mut spent = 0;
    let mut doubt: Option<(Constraint, f64, f64)> = None;
    // Since when the crossing leg may have been at its serial singularity.
    let mut since: Option<f64> = None;
    while let Some((from, to)) = open.pop() {
        spent += 1;
        match stretch::<D, N>(robot, chart, demand, curve, Interval::new(from, to)) {
            Stretch::Inside => since = None,
            Stretch::Crossing => _ = since.get_or_insert(from),
            Stretch::Beyond => {
                return match (doubt, demand.crossing) {
                    (None, Some(j)) if from == 0.0 => {
                        Along::Outside { constraint: Constraint::Reach(j), from, to }
                    }
                    (None, _) => Along::Crossed { from: since.unwrap_or(from), to },
                    (Some((constraint, from, to)), _) => Along::Undecided { constraint, from, to },
                };
            }
            // It may begin at the doubt before it, if any.
            Stretch::Outside(constraint) => {
                let from = doubt.map_or(from, |(_, from, _)| from);
                return Along::Outside { constraint, from, to };
            }
            Stretch::Open(constraint) if spent >= effort => {
                let (constraint, from, to) = doubt.unwrap_or((constraint, from, to));
                return Along::Undecided { constraint, from, to };
            }
            Stretch::Open(constraint) if to - from < SHORTEST => {
                doubt.get_or_insert((constraint, from, to));
            }
            Stretch::Open(_) => {
                let middle = 0.5 * (from + to);
                open.push((middle, to));
                open.push((from, middle));
            }
        }
    }
    let at_end = |_: &LegIndex| stretch::<D, N>(robot, chart, demand, curve, Interval::point(1.0));
    match (doubt, demand.crossing.as_ref().map(at_end)) {
        (Some((constraint, from, to)), _) => Along::Undecided { constraint, from, to },
        (None, Some(Stretch::Beyond)) => Along::Crossed { from: since.unwrap_or(0.0), to: 1.0 },
        (None, _) => Along::Inside,
    }
}

enum Stretch {
    /// All positive.
    Inside,
    /// All but the reach of the crossing leg.
    Crossing,
    /// The crossing leg does not reach it.
    Beyond,
    Outside(Constraint),
    Open(Constraint),
}

/// Returns one stretch of t.
fn stretch<const D: usize, const N: usize>(
    robot: &Robot,
    chart: &Chart,
    demand: &Demand,
    curve: &Curve,
    range: Interval,
) -> Stretch {
    let x = curve.over::<N>(range);
    let (placement, legs) = chart.at::<_, D, N>(robot, &x, |k| x[k].sin_cos());
    let mut result = Stretch::Inside;
    Constraints::new(robot, &placement, &legs).visit(demand, |constraint, value| {
        let value = value.tightened().range;
        if demand.crossing.is_some_and(|j| constraint == Constraint::Reach(j)) {
            if value.is_negative() {
                result = Stretch::Beyond;
            } else if !value.is_positive() && matches!(result, Stretch::Inside) {
                result = Stretch::Crossing;
            }
            return !value.is_negative();
        }
        if value.is_negative() {
            result = Stretch::Outside(constraint);
            return false;
        }
        if !value.is_positive() && !matches!(result, Stretch::Open(_)) {
            result = Stretch::Open(constraint);
        }
        true
    });
    result
}

impl Along {
    /// Whether the straight segment between two poses is proved to lie in a class of aspects.
    pub fn is_inside(robot: &Robot, demand: &Demand, ends: [&[f64]; 2], effort: usize) -> bool {
        Self::is_inside_of(robot, &Chart::Pose, demand, ends, effort)
    }

    /// Whether a segment that is straight in the coordinates of a chart is proved to meet the demand.
    pub fn is_inside_of(
        robot: &Robot,
        chart: &Chart,
        demand: &Demand,
        ends: [&[f64]; 2],
        effort: usize,
    ) -> bool {
        along_in_chart(robot, chart, demand, &Curve::segment(ends[0], ends[1]), effort) == Self::Inside
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use aspecta_robot::WorkingMode;
    use aspecta_robot::catalogue;

    fn five_bar() -> Robot {
        catalogue::find("five-bar").unwrap()
    }

    #[test]
    fn a_cubic_goes_through_its_ends_at_its_speeds() {
        let curve = Curve::cubic(&[1.0, 2.0], &[3.0, -1.0], [&[0.5, 0.0], &[-1.0, 4.0]]);
        let (at, speed) = (|t: f64| curve.at(t), |t: f64| curve.speed(t));
        assert_eq!(at(0.0)[..2], [1.0, 2.0]);
        assert!((at(1.0)[0] - 3.0).abs() < 1e-15 && (at(1.0)[1] + 1.0).abs() < 1e-15);
        assert_eq!(speed(0.0)[..2], [0.5, 0.0]);
        assert!((speed(1.0)[0] + 1.0).abs() < 1e-14 && (speed(1.0)[1] - 4.0).abs() < 1e-14);
        for i in 0..=100 {
            let t = f64::from(i) / 100.0;
            let over = curve.over::<2>(Interval::new((t - 0.05).max(0.0), (t + 0.05).min(1.0)));
            for (x, exact) in over.iter().zip(at(t)) {
                assert!(x.tightened().range.contains(exact), "{t}: {x:?} {exact}");
            }
        }
    }

    /// Up to where leg 1 of the five-bar is stretched (|A₁C₁| = 13), and not where det A vanishes on the way.
    #[test]
    fn a_leg_that_crosses_is_met_where_it_is_stretched() {
        let robot = five_bar();
        let mode: WorkingMode = "++".parse().unwrap();
        let towards = |end: [f64; 2], sign| {
            let demand = Demand { crossing: Some(LegIndex::new(0)), ..Demand::class(mode, sign) };
            along(&robot, &demand, &Curve::segment(&[5.8, 11.4], &end), 20_000)
        };
        let length = |t: f64, end: [f64; 2]| (5.8 + t * (end[0] - 5.8)).hypot(11.4 + t * (end[1] - 11.4));
        let end = [6.0, 12.0];
        let crossed = [1, -1].into_iter().find_map(|sign| match towards(end, sign) {
            Along::Crossed { from, to } => Some((from, to)),
            Along::Inside | Along::Outside { .. } | Along::Undecided { .. } => None,
        });
        let (from, to) = crossed.unwrap_or_else(|| panic!("{:?} {:?}", towards(end, 1), towards(end, -1)));
        assert!(length(from, end) <= 13.0 && length(to, end) > 13.0);
        for sign in [1, -1] {
            assert!(
                !matches!(towards([5.8, 11.5], sign), Along::Crossed { .. }),
                "leg 1 is not stretched there"
            );
        }
    }
}
