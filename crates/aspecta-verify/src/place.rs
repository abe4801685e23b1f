//! Enclosures over one box of a chart, leg by leg.

use super::body::{Body, LegState, Links, MOST, joint, slope_per_root};
use super::contact::Point;
use super::in_mode::InMode;
use super::{right_angles, twins};
use arrayvec::ArrayVec;
use aspecta_robot::AXES;
use aspecta_robot::WorkingMode;
use aspecta_robot::chart::{Bend, Chain, Chart, Fold};
use aspecta_robot::constraint::Scale;
use aspecta_robot::num::{Interval, Jet, Scalar};
use aspecta_robot::{Body as RobotBody, Robot, Window};
use std::cell::OnceCell;
use std::rc::Rc;

/// An enclosure of a function over a box, and of its derivatives with respect to the coordinates that vary and, of a function of one leg, to its q.
pub(super) type Function = Jet<Interval, { AXES + 1 }>;

/// The place of the derivative with respect to the leg's q.
pub(super) const OWN: usize = AXES;

/// A function of the pose with its derivatives along the axes only.
pub(super) type Along = Jet<Interval, AXES>;

pub(super) const ZERO: Interval = Interval::point(0.0);
pub(super) const ONE: Interval = Interval::point(1.0);

/// Coordinates and what the checks of one sheet need to know.
pub(super) struct Setting<'a> {
    pub robot: &'a Robot,
    pub chart: &'a Chart,
    pub window: Window,
    /// The coordinates that vary, up to [`AXES`].
    pub axes: ArrayVec<usize, AXES>,
    pub scale: &'a Scale,
    /// Pairs of legs that are one and the same.
    pub twins: Vec<[usize; 2]>,
    /// Of a robot with right angles only.
    pub handedness: Option<i8>,
}

impl<'a> Setting<'a> {
    pub(super) fn new(robot: &'a Robot, chart: &'a Chart, window: Window, scale: &'a Scale) -> Self {
        let axes = window.axes().into_iter().collect();
        let (twins, handedness) = (twins::of(robot), right_angles::handedness(robot));
        Self { robot, chart, window, axes, scale, twins, handedness }
    }

    /// Whether leg j is the chart's own, so that its q is the first coordinate.
    pub(super) fn is_own(&self, j: usize) -> bool {
        self.chart.leg().is_some_and(|leg| leg.index() == j)
    }

    /// Whether q of leg j comes from the pose by the root of H_j.
    pub(super) fn has_root(&self, j: usize) -> bool {
        !self.is_own(j) && self.robot.legs[j].actuator.postures() == 2
    }

    /// A box cut in two across the coordinate in which it is widest, in proportion to the window.
    pub(super) fn halves(&self, y: &Coordinates) -> [Coordinates; 2] {
        let whole = |k: usize| self.window.ranges.get(k).map_or(0.0, |range| range.1 - range.0);
        halves(y, |k| if whole(k) > 0.0 { (y[k].hi - y[k].lo) / whole(k) } else { 0.0 })
    }

    /// Coordinate k, which has the range x, as a function.
    fn coordinate(&self, x: Interval, k: usize) -> Function {
        match self.axes.iter().position(|&axis| axis == k) {
            Some(a) => Function::variable(x, a),
            None => Function::fixed(x),
        }
    }
}

/// Ranges, of which one is cut in two: that with the greatest share.
pub(super) fn halves(ranges: &[Interval; MOST], share: impl Fn(usize) -> f64) -> [[Interval; MOST]; 2] {
    let widest = (0..MOST).max_by(|&a, &b| share(a).total_cmp(&share(b))).unwrap_or(0);
    let (mut low, mut high) = (*ranges, *ranges);
    low[widest].hi = ranges[widest].mid();
    high[widest].lo = ranges[widest].mid();
    [low, high]
}

/// A box of coordinates; entries beyond the last coordinate are zero.
pub(super) type Coordinates = [Interval; MOST];

/// Ranges of h_j = √H_j.
pub(super) type Heights = [Interval; MOST];

/// The interval [0, ∞), for a non-negative quantity about which nothing is known.
pub(super) const ANY: Interval = Interval { lo: 0.0, hi: f64::INFINITY };

/// A leg in one posture over a box.
#[derive(Clone)]
pub(super) struct Posture {
    /// The range of H_j that is looked at; [1, 1] for struts.
    pub reach: Interval,
    /// All q there.
    pub q: Interval,
    /// q at the box's middle, or, where the leg is loose, any q.
    pub middle: Interval,
    /// Whether q is treated as a coordinate of its own: it is not proved to be a smooth function of the others on all the box.
    pub loose: bool,
    /// Derivatives of q along the axes elsewhere.
    pub rate: [Interval; AXES],
    pub over: LegState<Function>,
    pub at_middle: LegState<Interval>,
    /// Range of s B_jj: positive in the posture.
    pub slope: Interval,
    pub limits: Vec<Interval>,
}

impl Posture {
    /// The leg with another row of A, a function of the pose alone (module `twins`).
    pub(super) fn with_row(&self, over: [Function; MOST], at_middle: [Interval; MOST]) -> Rc<Self> {
        let mut leg = self.clone();
        (leg.over.row, leg.at_middle.row) = (over, at_middle);
        Rc::new(leg)
    }

    /// The derivative of a function of the leg along an axis, q being what it is there; at fixed q if the leg is loose.
    pub(super) fn along(&self, f: &Function, axis: usize) -> Interval {
        if self.loose { f.gradient[axis] } else { f.gradient[axis] + f.gradient[OWN] * self.rate[axis] }
    }

    /// Entry i of the leg's row of A where the axes are at their middle: for all q, if the leg is loose.
    pub(super) fn entry_at_middle(&self, i: usize) -> Interval {
        self.there(self.at_middle.row[i], &self.over.row[i])
    }

    /// A, B or C.
    pub(super) fn joint(&self, which: usize) -> [Point; 3] {
        std::array::from_fn(|k| Point {
            over: self.over.joints[which][k],
            at_middle: self.at_middle.joints[which][k],
        })
    }

    /// The like of ∂f/∂C.
    pub(super) fn push_at_middle(&self, k: usize) -> Interval {
        self.there(self.at_middle.push[k], &self.over.push[k])
    }

    fn there(&self, at_middle: Interval, over: &Function) -> Interval {
        if self.loose { at_middle + over.gradient[OWN] * (self.q - self.middle) } else { at_middle }
    }
}

/// A box of coordinates, and what can be said of it without a working mode.
pub(super) struct Place<'a, const D: usize> {
    pub setting: &'a Setting<'a>,
    pub y: Coordinates,
    /// The axes of y minus its middle.
    about: [Interval; AXES],
    over: Body<'a, Function, D>,
    at_middle: Body<'a, Interval, D>,
    /// C − A of each leg.
    spans: ArrayVec<Span<D>, MOST>,
    /// Range of H_j; [1, 1] for struts.
    pub reach: [Interval; MOST],
    /// ∇H_j along the axes; zero for struts.
    pub ascent: [[Interval; AXES]; MOST],
    /// For s = + and s = −, once they are asked for; a strut has the second only.
    postures: [[OnceCell<Rc<Posture>>; 2]; MOST],
}

/// C − A of a leg in its frame, over the box and at its middle.
struct Span<const D: usize> {
    over: [Function; D],
    at_middle: [Interval; D],
}

impl<'a, const D: usize> Place<'a, D> {
    pub(super) fn new(setting: &'a Setting<'a>, y: Coordinates) -> Self {
        let middle = y.map(|x| Interval::point(x.mid()));
        let axis = |a: usize| setting.axes.get(a).map_or(ZERO, |&k| y[k] - middle[k]);
        let coordinates = std::array::from_fn(|k| setting.coordinate(y[k], k));
        let over = Body::<Function, D>::new(setting.robot, setting.chart, &coordinates);
        let at_middle = Body::<Interval, D>::new(setting.robot, setting.chart, &middle);
        let span = |j: usize| Span { over: over.span(j), at_middle: at_middle.span(j) };
        let spans = (0..setting.robot.dof()).map(span).collect();
        let about = std::array::from_fn(axis);
        let postures = Default::default();
        let (reach, ascent) = ([ONE; MOST], [[ZERO; AXES]; MOST]);
        let mut place = Self { setting, y, about, over, at_middle, spans, reach, ascent, postures };
        for (j, span) in place.spans.iter().enumerate() {
            if let (Some(over), Some(middle)) =
                (place.over.reach(j, &span.over), place.at_middle.reach(j, &span.at_middle))
            {
                let range = place.range(&over, middle, None);
                let most = place.over.most_reach(j, &span.over.map(|x| x.value)).min(range.hi);
                place.reach[j] = Interval { lo: range.lo.min(most), hi: most };
                place.ascent[j] = std::array::from_fn(|a| over.gradient[a]);
            }
        }
        place
    }

    /// The ends of a body of the platform or of an obstacle.
    pub(super) fn ends(&self, body: RobotBody) -> [[Point; 3]; 2] {
        let ends = self.setting.robot.capsule(body).and_then(|capsule| capsule.shape.ends());
        ends.unwrap_or([[ZERO; 3]; 2]).map(|end| match body {
            RobotBody::Platform(_) => {
                let (over, at_middle) = (self.over.point(&end), self.at_middle.point(&end));
                std::array::from_fn(|k| Point { over: over[k], at_middle: at_middle[k] })
            }
            RobotBody::Obstacle(_) | RobotBody::Crank(_) | RobotBody::Rod(_) => {
                end.map(|x| Point { over: Function::fixed(x), at_middle: x })
            }
        })
    }

    /// Whether some leg certainly cannot close.
    pub(super) fn cannot_close(&self) -> bool {
        self.reach.iter().any(|h| h.hi < 0.0)
    }

    /// The robot in a mode, or `None` if a leg cannot close.
    pub(super) fn in_mode(&self, mode: WorkingMode) -> Option<InMode<'_, 'a, D>> {
        if self.cannot_close() {
            return None;
        }
        let leg = |j: usize| {
            let posture = usize::from(mode.sign(j) < 0);
            let found = || Rc::new(self.posture(j, posture, self.reach[j]));
            self.postures[j][posture].get_or_init(found).clone()
        };
        let mut legs: ArrayVec<Rc<Posture>, MOST> = (0..mode.legs()).map(leg).collect();
        for [first, second] in self.setting.replaced_in(mode) {
            let is_angle = self.setting.robot.legs[first].actuator.is_angle();
            let over = self.over.parts(first, &self.spans[first].over, is_angle);
            let at_middle = self.at_middle.parts(first, &self.spans[first].at_middle, is_angle);
            let sign = Interval::point(f64::from(mode.sign(second)));
            legs[first] = legs[first].with_row(over.fixed, at_middle.fixed);
            legs[second] =
                legs[second].with_row(over.swing.map(|x| x.scale(sign)), at_middle.swing.map(|x| x * sign));
        }
        Some(InMode::new(self, mode, legs))
    }

    /// A leg in one posture, where H_j is in `reach`, a part of its range.
    pub(super) fn posture(&self, j: usize, posture: usize, reach: Interval) -> Posture {
        let sign = if posture == 0 { 1.0 } else { -1.0 };
        let actuator = &self.setting.robot.legs[j].actuator;
        let is_coordinate = self.setting.is_own(j);
        let span = &self.spans[j];
        let found = if is_coordinate {
            let middle = Interval::point(self.y[0].mid());
            Joint { q: self.y[0], middle, loose: false, rate: [ZERO; AXES] }
        } else {
            self.joint(j, sign, reach)
        };
        let q = if is_coordinate {
            self.setting.coordinate(self.y[0], 0)
        } else {
            Function::variable(found.q, OWN)
        };
        let mut over = self.over.leg(j, &span.over, q);
        let at_middle = self.at_middle.leg(j, &span.at_middle, found.middle);
        if self.setting.has_root(j) {
            let root = reach.sqrt() * Interval::point(slope_per_root(actuator) * sign);
            over.slope.value = over.slope.value.meet(root);
        }
        let Joint { q, middle, loose, rate } = found;
        let mut posture =
            Posture { reach, q, middle, loose, rate, over, at_middle, slope: ZERO, limits: Vec::new() };
        let range = |over: &Function, at_middle: Interval| self.range(over, at_middle, Some(&posture));
        let slope = range(&posture.over.slope, posture.at_middle.slope) * Interval::point(sign);
        let limits = posture.over.limits.iter().zip(&posture.at_middle.limits);
        let limits = limits.map(|(over, at_middle)| range(over, *at_middle)).collect();
        (posture.slope, posture.limits) = (slope, limits);
        posture
    }

    /// q of a leg that is not the chart's own.
    fn joint(&self, j: usize, sign: f64, reach: Interval) -> Joint {
        let actuator = &self.setting.robot.legs[j].actuator;
        let Span { over, at_middle } = &self.spans[j];
        let narrow: [Interval; D] = std::array::from_fn(|k| self.range(&over[k], at_middle[k], None));
        let two = actuator.postures() == 2;
        let mut q = joint(actuator, &narrow, two.then_some(reach), sign);
        let f = actuator.equation(over, Function::variable(q, OWN));
        let slope = f.gradient[OWN];
        // A mean value needs the slope on the way from the middle, which may be in another part of H_j.
        let in_part = reach != self.reach[j];
        if in_part || !self.reach[j].is_positive() || slope.sign() == 0 {
            let middle = Interval::point(q.mid());
            return Joint { q, middle, loose: true, rate: [ZERO; AXES] };
        }
        let rate: [Interval; AXES] = std::array::from_fn(|a| -(f.gradient[a] / slope));
        let middle = joint(actuator, at_middle, self.at_middle.reach(j, at_middle), sign);
        let middle = if actuator.is_angle() { nearest_turn(middle, q) } else { middle };
        let centred = (0..AXES).fold(middle, |sum, a| sum + rate[a] * self.about[a]);
        // Two arcs of less than half a turn have one arc in common.
        if !actuator.is_angle() || (centred.width() < 3.0 && q.width() < 3.0) {
            q = q.meet(centred);
        }
        Joint { q, middle, loose: false, rate }
    }

    /// The range of a function of the coordinates, and of the q of a leg in its posture: the common part of its natural enclosure and the mean
    /// value form. Where q is a smooth function of the coordinates on all the box it is differentiated as such; otherwise it
    /// counts as a coordinate.
    fn range(&self, over: &Function, at_middle: Interval, posture: Option<&Posture>) -> Interval {
        let along = |a: usize| posture.map_or(over.gradient[a], |posture| posture.along(over, a));
        let mut sum = (0..AXES).fold(at_middle, |sum, a| sum + along(a) * self.about[a]);
        if let Some(posture) = posture.filter(|posture| posture.loose) {
            sum = sum + over.gradient[OWN] * (posture.q - posture.middle);
        }
        over.value.meet(sum)
    }

    /// The range of a function along the axes.
    pub(super) fn centred(&self, over: &Along, at_middle: Interval) -> Interval {
        let sum = over.gradient.iter().zip(&self.about).fold(at_middle, |sum, (slope, x)| sum + *slope * *x);
        over.value.meet(sum)
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
            Chart::Chain(Chain { leg, bend: Some(bend) }) => vec![self.bend_margin(leg.index(), bend)],
            Chart::Pose | Chart::Chain(_) => Vec::new(),
        }
    }

    /// Returns how far beyond the boundary of a bend's chart v is along the motor's axis e: e·v = cos a cos b
    /// − sin a sin b cos ψ, ψ being the elbow's angle.
    fn bend_margin(&self, leg: usize, bend: &Bend) -> Interval {
        let Some(links) = Links::of(&self.setting.robot.legs[leg]) else { return Interval::ENTIRE };
        let ((cos_a, sin_a), (cos_b, sin_b)) = (links.proximal, links.distal);
        let span = &self.spans[leg];
        let along = self.range(&span.over[D - 1], span.at_middle[D - 1], None);
        let at_end = sin_a * sin_b * Interval::point(bend.half_width).sin_cos().1;
        let beyond = along - cos_a * cos_b;
        (if bend.back { beyond } else { -beyond }) - at_end
    }

    /// Functions of the leg of a fold that are all ≥ 0 where its chart holds the configurations, as far as the leg closes: the rod's
    /// direction in the crank's frame has −2LM u_radial = L² + M² − ‖d‖², (2LM p)² = H and M w = γ.
    fn fold_margins(&self, fold: &Fold) -> Vec<Interval> {
        let span = &self.spans[fold.leg.index()];
        let bend = self.over.bend(fold.leg.index(), &span.over).0;
        let middle_bend = self.at_middle.bend(fold.leg.index(), &span.at_middle).0;
        let widest = Interval::point(2.0 * fold.half_width) * fold.crank * fold.rod;
        let mut margins =
            vec![-self.range(&bend, middle_bend, None), widest.square() - self.reach[fold.leg.index()]];
        if let Some((lo, hi)) = fold.axial {
            let height = self.range(&span.over[D - 1], span.at_middle[D - 1], None);
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
    rate: [Interval; AXES],
}

/// An angle, turned to be near another.
fn nearest_turn(angle: Interval, near: Interval) -> Interval {
    let turns = ((near.mid() - angle.mid()) / std::f64::consts::TAU).round();
    angle + Interval::PI * Interval::point(2.0 * turns)
}
