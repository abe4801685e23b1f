//! Legs that are one and the same: where det A is zero everywhere, and what it is a multiple of elsewhere.
//!
//! At one pose a leg's row of A is r = c + s h v in its posture s = ±1, h = √H, v being a function of the pose alone. In one posture two
//! such legs have one row. In opposite ones det (r, r′) = det (c + s h v, c − s h v) = 2h det (c, s′ v), s′ = −s: the determinant with c and s′ v in place of
//! these rows has the sign of det A where h > 0, and need not vanish with h. It, but for a positive factor, is looked at in the place of det A.

use super::body::{Body, MOST, constants};
use super::place::{Place, Setting};
use aspecta_robot::chart::Chart;
use aspecta_robot::num::{Interval, Scalar};
use aspecta_robot::{Leg, Platform, Robot, WorkingMode};

/// The greatest width, relative to it or to 1, of what encloses one number: that of a file, or made of some by a few roundings. Of numbers
/// within a tolerance, equal tolerances do not say that they are equal.
const ONE_NUMBER: f64 = 1e-14;

/// The pairs of legs that are one and the same: where both are in one posture they have the same q, hence the same row of A, and det A
/// is zero at all poses. Numbers given by the same doubles are taken for the same.
pub(super) fn of(robot: &Robot) -> Vec<[usize; 2]> {
    let legs = &robot.legs;
    let data = |leg: &Leg| (leg.anchor, leg.attachment, *axis(leg), leg.actuator);
    let are_one = |&[i, j]: &[usize; 2]| data(&legs[i]) == data(&legs[j]) && is_exact(&legs[i]);
    (1..legs.len()).flat_map(|j| (0..j).map(move |i| [i, j])).filter(are_one).collect()
}

impl Setting<'_> {
    /// Whether det A is zero everywhere in a mode.
    pub(super) fn vanishes_in(&self, mode: WorkingMode) -> bool {
        self.twins.iter().any(|&[i, j]| mode.sign(i) == mode.sign(j))
    }

    /// The pairs of legs whose rows of A are replaced in a mode.
    pub(super) fn replaced_in(&self, mode: WorkingMode) -> impl Iterator<Item = [usize; 2]> {
        self.twins.iter().copied().filter(move |[i, j]| mode.sign(*i) != mode.sign(*j))
    }

    /// The first of the legs that are one and the same as leg j.
    pub(super) fn first_of(&self, j: usize) -> usize {
        self.twins.iter().find(|[_, second]| *second == j).map_or(j, |&[first, _]| first)
    }
}

/// The parts of a leg's row of A: c + s h v.
pub(super) struct Parts<T> {
    /// c.
    pub fixed: [T; MOST],
    /// v, but for a positive factor.
    pub swing: [T; MOST],
}

/// Coefficients of k − a cos q − b sin q.
struct Harmonic<T> {
    k: T,
    a: T,
    b: T,
}

impl<T: Scalar> Harmonic<T> {
    /// From the values at q = 0, π and π/2.
    fn new(origin: T, opposite: T, quarter: T) -> Self {
        let half = Interval::point(0.5);
        let k = (origin + opposite).scale(half);
        Self { k, a: (opposite - origin).scale(half), b: k - quarter }
    }

    /// a² + b².
    fn size(&self) -> T {
        self.a.square() + self.b.square()
    }
}

impl<T: Scalar, const D: usize> Body<'_, T, D> {
    /// The parts of the row of leg j at C − A = `span`.
    ///
    /// With f = k − a cos q − b sin q the row is K − A cos q − B sin q, so c = K − k (a A + b B)/(a² + b²), v = (b A − a B)/(a² + b²): of v
    /// the numerator is taken, divided by what a² + b² is for C − A = (1, 0, …). Of a driven length, f = q² − 2αq + …, v = ∂r/∂q and c is r
    /// for q = α.
    pub(super) fn parts(&self, j: usize, span: &[T; D], is_angle: bool) -> Parts<T> {
        let at = |span: &[T; D], q: Interval| self.leg(j, span, T::constant(q));
        let origin = at(span, Interval::point(0.0));
        if !is_angle {
            let further = at(span, Interval::point(1.0));
            let swing: [T; MOST] = std::array::from_fn(|i| further.row[i] - origin.row[i]);
            let alpha = -origin.slope.scale(Interval::point(0.5));
            return Parts { fixed: std::array::from_fn(|i| origin.row[i] + alpha * swing[i]), swing };
        }
        let quarter_turn = Interval::PI * Interval::point(0.5);
        let (opposite, quarter) = (at(span, Interval::PI), at(span, quarter_turn));
        let unit: [T; D] =
            std::array::from_fn(|k| if k == 0 { T::constant(Interval::point(1.0)) } else { T::zero() });
        let at_unit = |q: Interval| at(&unit, q).equation;
        let unit_size =
            Harmonic::new(at_unit(Interval::point(0.0)), at_unit(Interval::PI), at_unit(quarter_turn)).size();
        let f = Harmonic::new(origin.equation, opposite.equation, quarter.equation);
        let size = f.size();
        let row: [Harmonic<T>; MOST] =
            std::array::from_fn(|i| Harmonic::new(origin.row[i], opposite.row[i], quarter.row[i]));
        Parts {
            fixed: std::array::from_fn(|i| row[i].k - f.k * (f.a * row[i].a + f.b * row[i].b) / size),
            swing: std::array::from_fn(|i| (f.b * row[i].a - f.a * row[i].b) / unit_size),
        }
    }
}

impl<const D: usize> Place<'_, D> {
    /// Whether P certainly has no maximum in the box, in a mode of a plane point whose legs are one, with links of one length L: they fold up where
    /// r = ‖C − A‖ = 0. H = r² (4L² − r²) and ‖c × v‖ = r² grow with r for r² < 2L², and r = 0 has H = 0; that is all if nothing else bounds the aspects. The
    /// rods are at an angle with the cosine 1 in one posture, r²/2L² − 1 in opposite ones: beyond a limit of it there is nothing of the mode.
    pub(super) fn is_about_fold_of_twins(&self, mode: WorkingMode) -> bool {
        let Setting { robot, chart, window, axes, twins, .. } = self.setting;
        let leg = &robot.legs[0];
        let in_poses = robot.platform == Platform::PlanePoint && **chart == Chart::Pose && axes.len() == 2;
        let is_cut = window.cut.iter().any(|&(first, last)| first || last);
        if !in_poses || twins.is_empty() || is_cut {
            return false;
        }
        let [crank, rod] = constants(&leg.actuator)[..] else { return false };
        if crank != rod {
            return false;
        }
        let square = |k: usize| (self.y[k] + leg.attachment[k] - leg.anchor[k]).square();
        let angle = (square(0) + square(1)) / (crank.square() + rod.square()) - Interval::point(1.0);
        let free = robot.legs.iter().all(|leg| leg.limits.is_empty()) && robot.pairs.is_empty();
        let grows = angle.is_negative() && free;
        if self.setting.vanishes_in(mode) {
            return grows || robot.rod_angles.iter().any(|limit| limit.min_cos.is_some());
        }
        let is_beyond = |max: Interval| angle.hi < max.lo;
        grows && robot.rod_angles.is_empty()
            || robot.rod_angles.iter().any(|limit| limit.max_cos.is_some_and(is_beyond))
    }
}

fn is_exact(leg: &Leg) -> bool {
    let places = leg.anchor.iter().chain(&leg.attachment).chain(axis(leg));
    places.chain(&constants(&leg.actuator)).all(is_one_number)
}

/// Whether an enclosure is of one number, known to rounding: a wider one is a tolerance.
pub(super) fn is_one_number(x: &Interval) -> bool {
    x.hi - x.lo <= ONE_NUMBER * x.lo.abs().max(x.hi.abs()).max(1.0)
}

/// The axis about which the motor turns, or the direction in which it pushes: all of its frame that A depends on.
fn axis(leg: &Leg) -> &[Interval; 3] {
    &leg.frame[if leg.actuator.is_angle() { 2 } else { 0 }]
}
