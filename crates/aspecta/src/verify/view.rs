//! What intervals prove of one box of a chart.

use super::body::{Body, LegState, MOST, joint};
use super::curvature::has_no_maximum;
use super::direction::climbable;
use crate::aspect::Scale;
use crate::kinematics::WorkingMode;
use crate::kinematics::chart::{Chart, Fold};
use crate::kinematics::leg::equation;
use crate::num::{Interval, Jet, Scalar};
use crate::robot::{Actuator, Robot, Window};

/// An enclosure of a function over a box, and of its derivatives with respect to the coordinates and to each leg's q.
type Function = Jet<Interval, 6>;

/// A velocity: of the coordinates, then of each leg's q.
type Velocity = [Interval; 6];

const ZERO: Interval = Interval::point(0.0);
const ONE: Interval = Interval::point(1.0);

/// Coordinates and what the checks of one sheet need to know.
pub(super) struct Setting<'a> {
    pub robot: &'a Robot,
    pub chart: &'a Chart,
    pub window: Window,
    pub scale: &'a Scale,
}

impl Setting<'_> {
    /// Whether leg j is that of the fold, so that its q is the first coordinate.
    pub(super) fn is_fold(&self, j: usize) -> bool {
        matches!(self.chart, Chart::Fold(fold) if fold.leg == j)
    }
}

/// A box of coordinates; entries beyond the last coordinate are zero.
pub(super) type Coordinates = [Interval; MOST];

/// A leg in one posture over the box.
struct Posture {
    /// All q there.
    q: Interval,
    /// q at the box's middle, or, where the leg is loose, any q.
    middle: Interval,
    /// Whether q is treated as a coordinate of its own: it is not proved to be a smooth function of the others on all the box.
    loose: bool,
    /// ∂q/∂y elsewhere.
    rate: [Interval; MOST],
    over: LegState<Function>,
    at_middle: LegState<Interval>,
    /// Range of s B_jj: positive in the posture.
    slope: Interval,
    limits: Vec<Interval>,
}

/// The robot over a box.
pub(super) struct View<'a> {
    setting: &'a Setting<'a>,
    y: Coordinates,
    /// y minus its middle.
    about: Coordinates,
    /// Range of H_j; [1, 1] for struts.
    reach: [Interval; MOST],
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
        match setting.robot.platform.space() {
            2 => Self::in_space::<2>(setting, y),
            _ => Self::in_space::<3>(setting, y),
        }
    }

    fn in_space<const D: usize>(setting: &'a Setting<'a>, y: Coordinates) -> Self {
        let middle = y.map(|x| Interval::point(x.mid()));
        let about = std::array::from_fn(|k| y[k] - middle[k]);
        let over = Body::<Function, D>::new(
            setting.robot,
            setting.chart,
            &std::array::from_fn(|k| Function::variable(y[k], k)),
        );
        let at_middle = Body::<Interval, D>::new(setting.robot, setting.chart, &middle);
        let mut view =
            Self { setting, y, about, reach: [ONE; MOST], postures: std::array::from_fn(|_| [None, None]) };
        for j in 0..setting.robot.dof() {
            let span = (over.span(j), at_middle.span(j));
            if let (Some(over), Some(at_middle)) = (over.reach(j, &span.0), at_middle.reach(j, &span.1)) {
                view.reach[j] = view.range_in_coordinates(&over, at_middle);
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
        let is_coordinate = self.setting.is_fold(j);
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
        if !self.reach[j].is_positive() || slope.sign() == 0 {
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
    fn legs(&self, mode: WorkingMode) -> Option<[Option<&Posture>; MOST]> {
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

    fn determinant_of(&self, legs: &[Option<&Posture>; MOST]) -> (Function, Interval) {
        let rows = |j: usize| legs[j].map_or([Function::zero(); MOST], |leg| leg.over.row);
        let middle_rows = |j: usize| legs[j].map_or([ZERO; MOST], |leg| leg.at_middle.row);
        let n = self.setting.robot.dof();
        let over = determinant(n, &std::array::from_fn(rows));
        let at_middle = determinant(n, &std::array::from_fn(middle_rows));
        let range = self.range(&over, at_middle, legs);
        (over, range)
    }

    /// Whether P certainly has no maximum in the box, in the class of a mode and the sign of det A (module documentation).
    pub(super) fn is_summitless(&self, mode: WorkingMode, sign: f64) -> bool {
        let Some(legs) = self.legs(mode) else { return true };
        let constraints = self.constraints(mode, sign, &legs);
        let least = constraints.iter().fold(f64::INFINITY, |least, c| least.min(c.value.hi));
        if least <= 0.0 {
            return true;
        }
        let active: Vec<&Constraint> = constraints.iter().filter(|c| c.value.lo <= least).collect();
        let det_alone = active.len() == 1 && constraints[0].value.lo <= least;
        if det_alone && legs.iter().flatten().all(|leg| !leg.loose) && self.det_has_no_maximum(sign, &legs) {
            return true;
        }
        self.choices_of_loose(&legs).into_iter().any(|loose| {
            self.velocities(&legs, &loose).is_some_and(|velocities| {
                let growth = |c: &&Constraint| -> Vec<Interval> {
                    velocities
                        .iter()
                        .map(|v| (0..6).fold(ZERO, |sum, k| sum + c.gradient[k] * v[k]))
                        .collect()
                };
                climbable(&active.iter().map(growth).collect::<Vec<_>>())
            })
        })
    }

    fn det_has_no_maximum(&self, sign: f64, legs: &[Option<&Posture>; MOST]) -> bool {
        let over = legs.map(|leg| leg.map_or(ZERO, |leg| leg.q));
        let at_middle = legs.map(|leg| leg.map_or(0.0, |leg| leg.middle.mid()));
        match self.setting.robot.platform.space() {
            2 => has_no_maximum::<2>(self.setting, &self.y, (&over, &at_middle), sign),
            _ => has_no_maximum::<3>(self.setting, &self.y, (&over, &at_middle), sign),
        }
    }

    /// The functions whose least is P, scaled, and gradients of increasing functions of them.
    fn constraints(&self, mode: WorkingMode, sign: f64, legs: &[Option<&Posture>; MOST]) -> Vec<Constraint> {
        let scale = self.setting.scale;
        let exact = Interval::point;
        let (det, range) = self.determinant_of(legs);
        let mut all = vec![Constraint {
            value: range * exact(sign) / exact(scale.det),
            gradient: det.gradient.map(|g| g * exact(sign)),
        }];
        for (j, leg) in legs.iter().enumerate().filter_map(|(j, leg)| Some((j, (*leg)?))) {
            if self.setting.robot.legs[j].actuator.postures() == 2 {
                // H = B² (B²/4): where s B > 0 it grows as s B does.
                let s = exact(f64::from(mode.sign(j)));
                let gradient = leg.over.slope.gradient.map(|g| g * s);
                all.push(Constraint { value: self.reach[j] / exact(scale.reach[j]), gradient });
            }
            for (k, limit) in leg.over.limits.iter().enumerate() {
                let value = leg.limits[k] / exact(scale.limits[j][k]);
                all.push(Constraint { value, gradient: limit.gradient });
            }
        }
        for k in 0..self.setting.robot.dof() {
            let (lo, hi) = self.setting.window.ranges[k];
            let cut = self.setting.window.cut[k];
            let width = exact(hi) - exact(lo);
            for (cut, distance, sign) in
                [(cut.0, self.y[k] - exact(lo), 1.0), (cut.1, exact(hi) - self.y[k], -1.0)]
            {
                if cut && lo < hi {
                    let mut gradient = [ZERO; 6];
                    gradient[k] = exact(sign);
                    all.push(Constraint { value: distance / width, gradient });
                }
            }
        }
        all
    }

    /// Sets of legs for which velocities are chosen with care: those whose B_jj may vanish must be among them; those
    /// whose B_jj varies much may better be.
    fn choices_of_loose(&self, legs: &[Option<&Posture>; MOST]) -> Vec<Vec<usize>> {
        let among = |wanted: &dyn Fn(&Posture) -> bool| -> Vec<usize> {
            let fit = |j: &usize| !self.setting.is_fold(*j) && legs[*j].is_some_and(wanted);
            (0..MOST).filter(fit).collect()
        };
        let must = among(&|p| p.loose);
        let varied = |p: &Posture| {
            let b = p.over.slope.value;
            p.loose || b.lo.abs().min(b.hi.abs()) < 0.5 * b.magnitude()
        };
        let may = among(&varied);
        if must == may { vec![must] } else { vec![may, must] }
    }

    /// As many tangent vectors of the configurations as there are coordinates that vary. With n_j = ∂f_j/∂y they fulfil
    /// n_j·ẏ + B_jj q̇_j = 0 exactly at every point of the box. For the loose legs, either n_j·ẏ = 0 and q̇_j = 0, by an exact cross
    /// product, or ẏ = −B_jj c and q̇_j = n_j·c.
    fn velocities(&self, legs: &[Option<&Posture>; MOST], loose: &[usize]) -> Option<Vec<Velocity>> {
        let axes = self.setting.window.axes();
        let normal = |j: usize| -> Coordinates {
            let gradient = legs[j].map_or([ZERO; 6], |leg| leg.over.equation.gradient);
            std::array::from_fn(|a| axes.get(a).map_or(ZERO, |&k| gradient[k]))
        };
        let normals: Vec<Coordinates> = loose.iter().map(|&j| normal(j)).collect();
        let mut all = Vec::new();
        for (direction, own) in directions(axes.len(), &normals)? {
            let mut velocity = [ZERO; 6];
            let own = own.map(|i| (loose[i], normals[i]));
            let factor = own.and_then(|(j, _)| legs[j]).map_or(ONE, |leg| -leg.over.slope.value);
            for (a, &k) in axes.iter().enumerate() {
                velocity[k] = direction[a] * factor;
            }
            for (j, leg) in legs.iter().enumerate().filter_map(|(j, leg)| Some((j, (*leg)?))) {
                velocity[MOST + j] = match own {
                    Some((i, normal)) if i == j => dot(&normal, &direction),
                    _ if loose.contains(&j) => ZERO,
                    _ => (0..MOST).fold(ZERO, |sum, k| sum + leg.rate[k] * velocity[k]),
                };
            }
            all.push(velocity);
        }
        Some(all)
    }

    /// Whether the chart of a fold holds all configurations of the box (of pose coordinates).
    pub(super) fn is_covered_by(&self, fold: &Fold) -> bool {
        self.fold_margins(fold).iter().all(|m| m.lo >= 0.0)
    }

    /// Whether the chart of a fold holds no configuration of the box.
    pub(super) fn is_clear_of(&self, fold: &Fold) -> bool {
        self.cannot_close() || self.fold_margins(fold).iter().any(|m| m.is_negative())
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

/// One of the functions whose least is P.
struct Constraint {
    value: Interval,
    gradient: [Interval; 6],
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

fn dot(a: &Coordinates, b: &Coordinates) -> Interval {
    (0..MOST).fold(ZERO, |sum, k| sum + a[k] * b[k])
}

fn cross(a: &Coordinates, b: &Coordinates) -> Coordinates {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

/// The middle of a vector, at length one.
fn unit(v: &Coordinates) -> Coordinates {
    let middle = v.map(Interval::mid);
    let length = middle.iter().map(|x| x * x).sum::<f64>().sqrt();
    middle.map(|x| Interval::point(if length.is_normal() { x / length } else { x }))
}

/// `count` directions: first those perpendicular to all the normals, then for each normal (its index given) one that is
/// perpendicular to all the others. `None` if there are more normals than directions.
fn directions(count: usize, normals: &[Coordinates]) -> Option<Vec<(Coordinates, Option<usize>)>> {
    let axis = |a: usize| std::array::from_fn(|k| if k == a { ONE } else { ZERO });
    // Perpendicular to a vector of the first two axes, in their plane.
    let quarter = |v: &Coordinates| [-v[1], v[0], ZERO];
    Some(match (count, normals) {
        (_, []) => (0..count).map(|a| (axis(a), None)).collect(),
        (1, [_]) => vec![(axis(0), Some(0))],
        (2, [n]) => vec![(quarter(n), None), (unit(n), Some(0))],
        (2, [n, m]) => vec![(quarter(m), Some(0)), (quarter(n), Some(1))],
        (3, [n]) => {
            let middle = unit(n);
            let flattest = (0..3).min_by(|&a, &b| middle[a].magnitude().total_cmp(&middle[b].magnitude()))?;
            let first = unit(&cross(&middle, &axis(flattest)));
            let second = unit(&cross(&middle, &first));
            vec![(cross(n, &first), None), (cross(n, &second), None), (middle, Some(0))]
        }
        (3, [n, m]) => {
            let edge = unit(&cross(&unit(n), &unit(m)));
            vec![(cross(n, m), None), (cross(m, &edge), Some(0)), (cross(n, &edge), Some(1))]
        }
        (3, [n, m, l]) => vec![(cross(m, l), Some(0)), (cross(l, n), Some(1)), (cross(n, m), Some(2))],
        _ => return None,
    })
}
