//! What intervals prove of one box of a chart.

use super::body::{Body, LegState, MOST, joint};
use crate::aspect::Scale;
use crate::kinematics::WorkingMode;
use crate::kinematics::chart::{Chart, Fold};
use crate::kinematics::leg::equation;
use crate::num::{Interval, Jet, Scalar};
use crate::robot::{Actuator, Robot, Window};

/// An enclosure of a function over a box, and of its derivatives with respect to the coordinates and to each leg's q.
pub(super) type Function = Jet<Interval, 6>;

pub(super) const ZERO: Interval = Interval::point(0.0);
pub(super) const ONE: Interval = Interval::point(1.0);

/// Coordinates and what the checks of one sheet need to know.
pub(super) struct Setting<'a> {
    pub robot: &'a Robot,
    pub chart: &'a Chart,
    pub window: Window,
    pub scale: &'a Scale,
}

impl Setting<'_> {
    /// Whether leg j is the chart's own, so that its q is the first coordinate.
    pub(super) fn is_own(&self, j: usize) -> bool {
        self.chart.leg() == Some(j)
    }
}

/// A box of coordinates; entries beyond the last coordinate are zero.
pub(super) type Coordinates = [Interval; MOST];

/// Ranges of h_j = √H_j.
pub(super) type Heights = [Interval; MOST];

/// All that can be.
const ANY: Heights = [Interval { lo: 0.0, hi: f64::INFINITY }; MOST];

/// The part of a range of H where √H is in `height`; negative if there is none.
fn part(reach: Interval, height: Interval) -> Interval {
    if height == ANY[0] {
        return reach;
    }
    let (lo, hi) = (reach.lo.max(height.square().lo), reach.hi.min(height.square().hi));
    if lo <= hi { Interval::new(lo, hi) } else { Interval::point(-1.0) }
}

/// A leg in one posture over the box.
pub(super) struct Posture {
    /// All q there.
    pub q: Interval,
    /// q at the box's middle, or, where the leg is loose, any q.
    pub middle: Interval,
    /// Whether q is treated as a coordinate of its own: it is not proved to be a smooth function of the others on all the box.
    pub loose: bool,
    /// ∂q/∂y elsewhere.
    pub rate: [Interval; MOST],
    pub over: LegState<Function>,
    at_middle: LegState<Interval>,
    /// Range of s B_jj: positive in the posture.
    slope: Interval,
    pub limits: Vec<Interval>,
}

/// The robot over a box.
pub(super) struct View<'a> {
    pub setting: &'a Setting<'a>,
    pub y: Coordinates,
    /// y minus its middle.
    about: Coordinates,
    /// Range of H_j; [1, 1] for struts.
    whole: [Interval; MOST],
    /// The part of it that is looked at.
    pub reach: [Interval; MOST],
    /// For s = + and s = −; a strut has the second only, and a leg that cannot close anywhere in the box has none.
    postures: [[Option<Posture>; 2]; MOST],
}

/// What is proved of a working mode in a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Existence {
    /// Everywhere, legs strictly closed and limits strictly kept.
    Everywhere,
    /// Nowhere.
    Nowhere,
    Unknown,
}

impl<'a> View<'a> {
    pub(super) fn new(setting: &'a Setting<'a>, y: Coordinates) -> Self {
        Self::of_part(setting, y, &ANY)
    }

    /// The configurations in the box for which each h_j = √H_j is in a range.
    pub(super) fn of_part(setting: &'a Setting<'a>, y: Coordinates, heights: &Heights) -> Self {
        match setting.robot.platform.space() {
            2 => Self::in_space::<2>(setting, y, heights),
            _ => Self::in_space::<3>(setting, y, heights),
        }
    }

    fn in_space<const D: usize>(setting: &'a Setting<'a>, y: Coordinates, heights: &Heights) -> Self {
        let middle = y.map(|x| Interval::point(x.mid()));
        let about = std::array::from_fn(|k| y[k] - middle[k]);
        let over = Body::<Function, D>::new(
            setting.robot,
            setting.chart,
            &std::array::from_fn(|k| Function::variable(y[k], k)),
        );
        let at_middle = Body::<Interval, D>::new(setting.robot, setting.chart, &middle);
        let postures = std::array::from_fn(|_| [None, None]);
        let mut view = Self { setting, y, about, whole: [ONE; MOST], reach: [ONE; MOST], postures };
        for j in 0..setting.robot.dof() {
            let span = (over.span(j), at_middle.span(j));
            if let (Some(over), Some(at_middle)) = (over.reach(j, &span.0), at_middle.reach(j, &span.1)) {
                view.whole[j] = view.range_in_coordinates(&over, at_middle);
                view.reach[j] = part(view.whole[j], heights[j]);
            }
            if view.reach[j].hi < 0.0 {
                continue;
            }
            for posture in 0..2 {
                if posture == 1 || setting.robot.legs[j].actuator.postures() == 2 {
                    view.postures[j][posture] =
                        Some(view.posture(j, posture, (&over, &at_middle), (&span.0, &span.1)));
                }
            }
        }
        view
    }

    fn posture<const D: usize>(
        &self,
        j: usize,
        posture: usize,
        (over, at_middle): (&Body<'_, Function, D>, &Body<'_, Interval, D>),
        (span, middle_span): (&[Function; D], &[Interval; D]),
    ) -> Posture {
        let sign = if posture == 0 { 1.0 } else { -1.0 };
        let actuator = &self.setting.robot.legs[j].actuator;
        let is_coordinate = self.setting.is_own(j);
        let mut found = Joint {
            q: self.y[0],
            middle: Interval::point(self.y[0].mid()),
            loose: false,
            rate: [ZERO; MOST],
        };
        if !is_coordinate {
            let narrow: [Interval; D] =
                std::array::from_fn(|k| self.range_in_coordinates(&span[k], middle_span[k]));
            found = self.joint(j, sign, (span, &narrow), middle_span);
        }
        let q = if is_coordinate {
            Function::variable(self.y[0], 0)
        } else {
            Function::variable(found.q, MOST + j)
        };
        let mut over = over.leg(j, span, q);
        let at_middle = at_middle.leg(j, middle_span, found.middle);
        if !is_coordinate && actuator.postures() == 2 {
            // |B_jj| is √H, twice that for prismatic legs.
            let factor = if matches!(actuator, Actuator::Prismatic { .. }) { 2.0 } else { 1.0 };
            let root = self.reach[j].sqrt() * Interval::point(factor * sign);
            over.slope.value = over.slope.value.meet(root);
        }
        let mut posture = Posture {
            q: found.q,
            middle: found.middle,
            loose: found.loose,
            rate: found.rate,
            over,
            at_middle,
            slope: ZERO,
            limits: Vec::new(),
        };
        let range = |over: &Function, at_middle: Interval| {
            let mut all: [Option<&Posture>; MOST] = [None; MOST];
            all[j] = Some(&posture);
            self.range(over, at_middle, &all)
        };
        let slope = range(&posture.over.slope, posture.at_middle.slope) * Interval::point(sign);
        let limits = posture.over.limits.iter().zip(&posture.at_middle.limits);
        let limits = limits.map(|(over, at_middle)| range(over, *at_middle)).collect();
        (posture.slope, posture.limits) = (slope, limits);
        posture
    }

    /// q of a leg that is not the fold's.
    fn joint<const D: usize>(
        &self,
        j: usize,
        sign: f64,
        (span, narrow): (&[Function; D], &[Interval; D]),
        middle_span: &[Interval; D],
    ) -> Joint {
        let actuator = &self.setting.robot.legs[j].actuator;
        let reach = (actuator.postures() == 2).then_some(self.reach[j]);
        let mut q = joint(actuator, narrow, reach, sign);
        let f = equation(actuator, span, Function::variable(q, MOST + j));
        let slope = f.gradient[MOST + j];
        if !self.whole[j].is_positive() || slope.sign() == 0 {
            let middle = Interval::point(q.mid());
            return Joint { q, middle, loose: true, rate: [ZERO; MOST] };
        }
        let rate: [Interval; MOST] = std::array::from_fn(|k| -(f.gradient[k] / slope));
        let body = Body::<Interval, D>::new(
            self.setting.robot,
            self.setting.chart,
            &self.y.map(|x| Interval::point(x.mid())),
        );
        let middle = joint(actuator, middle_span, body.reach(j, middle_span), sign);
        let middle = if actuator.is_angle() { nearest_turn(middle, q) } else { middle };
        let centred = (0..MOST).fold(middle, |sum, k| sum + rate[k] * self.about[k]);
        // Two arcs of less than half a turn have one arc in common.
        if !actuator.is_angle() || (centred.width() < 3.0 && q.width() < 3.0) {
            q = q.meet(centred);
        }
        Joint { q, middle, loose: false, rate }
    }

    /// The ranges of h_j of the legs that are loose in a mode, or `None` if none is.
    pub(super) fn heights_of_loose(&self, mode: WorkingMode) -> Option<Heights> {
        let legs = self.legs(mode)?;
        let is_loose = |j: usize| legs[j].is_some_and(|leg| leg.loose);
        let heights = std::array::from_fn(|j| if is_loose(j) { self.reach[j].sqrt() } else { ANY[j] });
        (0..MOST).any(is_loose).then_some(heights)
    }

    /// The range of a function of the coordinates alone.
    fn range_in_coordinates(&self, over: &Function, at_middle: Interval) -> Interval {
        self.range(over, at_middle, &[None; MOST])
    }

    /// The range of a function of the coordinates and of the q's of the given postures: the common part of its natural
    /// enclosure and the mean value form. Where q_j is a smooth function of the coordinates on all the box it is
    /// differentiated as such; otherwise it counts as a coordinate.
    fn range(&self, over: &Function, at_middle: Interval, postures: &[Option<&Posture>; MOST]) -> Interval {
        let mut sum = at_middle;
        for k in 0..MOST {
            let tight = postures.iter().enumerate().filter_map(|(j, p)| Some((j, p.filter(|p| !p.loose)?)));
            let slope =
                tight.fold(over.gradient[k], |slope, (j, p)| slope + over.gradient[MOST + j] * p.rate[k]);
            sum = sum + slope * self.about[k];
        }
        for (j, p) in postures.iter().enumerate() {
            if let Some(p) = p.filter(|p| p.loose) {
                sum = sum + over.gradient[MOST + j] * (p.q - p.middle);
            }
        }
        over.value.meet(sum)
    }

    /// The legs in a mode, or `None` if one cannot close.
    pub(super) fn legs(&self, mode: WorkingMode) -> Option<[Option<&Posture>; MOST]> {
        let mut legs = [None; MOST];
        for (j, leg) in legs.iter_mut().enumerate().take(mode.legs()) {
            *leg = Some(self.postures[j][usize::from(mode.sign(j) < 0)].as_ref()?);
        }
        Some(legs)
    }

    /// Whether some leg certainly cannot close.
    pub(super) fn cannot_close(&self) -> bool {
        self.reach.iter().any(|h| h.hi < 0.0)
    }

    /// Whether a mode exists in the box.
    pub(super) fn existence(&self, mode: WorkingMode) -> Existence {
        let Some(legs) = self.legs(mode) else { return Existence::Nowhere };
        let mut known = Existence::Everywhere;
        for (j, leg) in legs.iter().enumerate().filter_map(|(j, leg)| Some((j, (*leg)?))) {
            // A strut has one posture, and det A = 0 where its length is 0.
            let two = self.setting.robot.legs[j].actuator.postures() == 2;
            let in_posture = two.then_some([self.reach[j], leg.slope]);
            for value in in_posture.iter().flatten().chain(&leg.limits) {
                if value.hi <= 0.0 {
                    return Existence::Nowhere;
                }
                if !value.is_positive() {
                    known = Existence::Unknown;
                }
            }
        }
        known
    }

    /// The range of det A in a mode that may exist.
    pub(super) fn determinant(&self, mode: WorkingMode) -> Interval {
        self.legs(mode).map_or(ZERO, |legs| self.determinant_of(&legs).1)
    }

    pub(super) fn determinant_of(&self, legs: &[Option<&Posture>; MOST]) -> (Function, Interval) {
        let rows = |j: usize| legs[j].map_or([Function::zero(); MOST], |leg| leg.over.row);
        let middle_rows = |j: usize| legs[j].map_or([ZERO; MOST], |leg| leg.at_middle.row);
        let n = self.setting.robot.dof();
        let over = determinant(n, &std::array::from_fn(rows));
        let at_middle = determinant(n, &std::array::from_fn(middle_rows));
        let range = self.range(&over, at_middle, legs);
        (over, range)
    }

    /// Whether a chart holds all configurations of the box (of pose coordinates).
    pub(super) fn is_covered_by(&self, chart: &Chart) -> bool {
        self.margins_of(chart).iter().all(|m| m.lo >= 0.0)
    }

    /// Whether a chart holds no configuration of the box.
    pub(super) fn is_clear_of(&self, chart: &Chart) -> bool {
        self.cannot_close() || self.margins_of(chart).iter().any(|m| m.is_negative())
    }

    /// Functions that are all ≥ 0 where the chart holds the configurations, as far as the legs close: none if it holds all.
    fn margins_of(&self, chart: &Chart) -> Vec<Interval> {
        match chart {
            Chart::Fold(fold) => self.fold_margins(fold),
            Chart::Pose | Chart::Chain(_) => Vec::new(),
        }
    }

    /// Functions of the leg of a fold that are all ≥ 0 where its chart holds the configurations, as far as the leg closes: the rod's
    /// direction in the crank's frame has −2LM u_radial = L² + M² − ‖d‖², (2LM p)² = H and M w = γ.
    fn fold_margins(&self, fold: &Fold) -> Vec<Interval> {
        match self.setting.robot.platform.space() {
            2 => self.fold_margins_in::<2>(fold),
            _ => self.fold_margins_in::<3>(fold),
        }
    }

    fn fold_margins_in<const D: usize>(&self, fold: &Fold) -> Vec<Interval> {
        let (robot, chart) = (self.setting.robot, self.setting.chart);
        let over = Body::<Function, D>::new(
            robot,
            chart,
            &std::array::from_fn(|k| Function::variable(self.y[k], k)),
        );
        let at_middle = Body::<Interval, D>::new(robot, chart, &self.y.map(|x| Interval::point(x.mid())));
        let (span, middle_span) = (over.span(fold.leg), at_middle.span(fold.leg));
        let bend = over.bend(fold.leg, &span).0;
        let middle_bend = at_middle.bend(fold.leg, &middle_span).0;
        let widest = Interval::point(2.0 * fold.half_width) * fold.crank * fold.rod;
        let mut margins =
            vec![-self.range_in_coordinates(&bend, middle_bend), widest.square() - self.reach[fold.leg]];
        if let Some((lo, hi)) = fold.axial {
            let height = self.range_in_coordinates(&span[D - 1], middle_span[D - 1]);
            margins.push(height - fold.rod * Interval::point(lo));
            margins.push(fold.rod * Interval::point(hi) - height);
        }
        margins
    }
}

struct Joint {
    q: Interval,
    middle: Interval,
    loose: bool,
    rate: [Interval; MOST],
}

/// An angle, turned to be near another.
fn nearest_turn(angle: Interval, near: Interval) -> Interval {
    let turns = ((near.mid() - angle.mid()) / std::f64::consts::TAU).round();
    angle + Interval::PI * Interval::point(2.0 * turns)
}

/// The determinant of the first n rows and columns, n = 2 or 3.
pub(super) fn determinant<T: Scalar>(n: usize, m: &[[T; MOST]; MOST]) -> T {
    let minor = |i: usize, j: usize| m[1][i] * m[2][j] - m[1][j] * m[2][i];
    match n {
        2 => m[0][0] * m[1][1] - m[0][1] * m[1][0],
        _ => m[0][0] * minor(1, 2) + m[0][1] * minor(2, 0) + m[0][2] * minor(0, 1),
    }
}
