//! The proof that P has no maximum in a box: tangent vectors along which all grows that can be the least.

mod parted;

use super::body::MOST;
use super::contact::{Apart, Line};
use super::curvature::has_no_maximum;
use super::direction::climbable;
use super::in_mode::{Existence, InMode};
use super::place::{ANY, Heights, ONE, OWN, Posture, ZERO, halves};
use super::turns::{Turn, are_impossible};
use aspecta_robot::AXES;
use aspecta_robot::constraint::Constraint;
use aspecta_robot::num::{Interval, Scalar, cross};
use parted::{Parted, possible};

/// A vector along the axes.
type Direction = [Interval; AXES];

/// A velocity, or the derivatives of a function: along the axes, then by each leg's q.
type Vector = [Interval; AXES + MOST];

/// One of the functions whose least is P.
struct Bound {
    value: Interval,
    gradient: Vector,
    /// The leg whose h_j it is.
    height_of: Option<usize>,
}

/// A tangent vector of the configurations.
struct Velocity {
    vector: Vector,
    /// The legs, as bits, whose h_j it does not change.
    level: u8,
}

impl Velocity {
    /// The derivative of a constraint along it.
    fn growth(&self, constraint: &Bound) -> Interval {
        match constraint.height_of {
            Some(j) if self.level >> j & 1 == 1 => ZERO,
            _ => dot(&constraint.gradient, &self.vector),
        }
    }
}

/// The coordinate that tangent vectors keep fixed for a leg that may be near a serial singularity.
#[derive(Clone, Copy, PartialEq)]
enum Held {
    /// q_j.
    Joint,
    /// h_j.
    Height,
}

/// Most choices of lines that part thin bodies.
const MOST_CHOICES: usize = 512;

/// Most parts into which ranges of h_j are cut.
const PARTS: usize = 200;

/// The share of each of these ranges below which a part is cut no more: the box is too wide then.
const SMALLEST: f64 = 1.0 / 256.0;

impl<const D: usize> InMode<'_, '_, D> {
    /// Whether P certainly has no maximum in the box, in the class of the mode and the sign of det A (module
    /// documentation).
    ///
    /// Near a serial singularity h_j varies like the root of the box's width, however small the box: other
    /// directions may lead uphill for other h_j, so their ranges are cut too.
    pub(super) fn is_summitless(&self, sign: f64) -> bool {
        if self.climbs(sign) {
            return true;
        }
        let Some(whole) = self.heights_near_zero() else { return false };
        let share = |heights: &Heights, j: usize| match whole[j] {
            whole if whole == ANY || whole.width() == 0.0 => 0.0,
            whole => heights[j].width() / whole.width(),
        };
        let cut = |heights: &Heights| halves(heights, |j| share(heights, j));
        let mut open = cut(&whole).to_vec();
        for _ in 0..PARTS {
            let Some(heights) = open.pop() else { return true };
            let may_be_high = |part: Self| part.existence() != Existence::Nowhere && !part.climbs(sign);
            if self.part(&heights).is_some_and(may_be_high) {
                if (0..MOST).all(|j| share(&heights, j) <= SMALLEST) {
                    return false;
                }
                open.extend(cut(&heights));
            }
        }
        false
    }

    /// [`Self::is_summitless`], the h_j being what they are here.
    ///
    /// Of two thin bodies some line must part them: P is the greatest, over all choices of such lines, of the least of the functions chosen, so that
    /// it has no maximum where none of these has one.
    fn climbs(&self, sign: f64) -> bool {
        let (bounds, parted) = self.constraints(sign);
        if parted.is_empty() {
            return self.climbs_by(&bounds.iter().collect::<Vec<_>>(), sign);
        }
        let (known, places) =
            (self.turns(sign), parted.iter().flat_map(|pair| pair.joints).collect::<Vec<_>>());
        let lines: usize = parted.iter().map(|pair| pair.lines.len()).product();
        lines <= MOST_CHOICES
            && (0..lines).all(|mut choice| {
                let line = |pair: &'_ Parted| {
                    let line = choice % pair.lines.len();
                    choice /= pair.lines.len();
                    line
                };
                let chosen: Vec<usize> = parted.iter().map(line).collect();
                let chosen = || parted.iter().zip(&chosen).map(|(pair, line)| &pair.lines[*line]);
                let turns: Vec<Turn> =
                    known.iter().copied().chain(chosen().flat_map(|line| line.1.iter().copied())).collect();
                let all = || bounds.iter().chain(chosen().flat_map(|line| &line.0)).collect::<Vec<_>>();
                are_impossible(&turns, &places) || self.climbs_by(&all(), sign)
            })
    }

    /// Whether all of these that can be the least grow along one vector; det A is the first.
    fn climbs_by(&self, bounds: &[&Bound], sign: f64) -> bool {
        let least = bounds.iter().fold(f64::INFINITY, |least, c| least.min(c.value.hi));
        if least <= 0.0 {
            return true;
        }
        let active: Vec<&Bound> = bounds.iter().filter(|c| c.value.lo <= least).copied().collect();
        let climbs = |held: Held, loose: &[usize]| {
            self.velocities(loose, held).is_some_and(|velocities| {
                let growth = |c: &&Bound| velocities.iter().map(|v| v.growth(c)).collect();
                climbable(&active.iter().map(growth).collect::<Vec<_>>())
            })
        };
        let climbs_with = |loose: Vec<usize>| {
            climbs(Held::Height, &loose) || !loose.is_empty() && climbs(Held::Joint, &loose)
        };
        let det_alone = active.len() == 1 && bounds[0].value.lo <= least;
        self.choices_of_loose().into_iter().any(climbs_with)
            || det_alone && !self.is_loose() && self.is_of_rows() && self.det_has_no_maximum(sign)
    }

    /// Whether it is the determinant of the rows of A that is looked at.
    fn is_of_rows(&self) -> bool {
        self.place.setting.replaced_in(self.mode).next().is_none()
    }

    fn det_has_no_maximum(&self, sign: f64) -> bool {
        let over = std::array::from_fn(|j| self.legs.get(j).map_or(ZERO, |leg| leg.q));
        let at_middle = std::array::from_fn(|j| self.legs.get(j).map_or(0.0, |leg| leg.middle.mid()));
        let turned = &self.determinant().turned;
        has_no_maximum::<D>(self.place.setting, &self.place.y, (&over, &at_middle), turned, sign)
    }

    /// The functions whose least is P, scaled, and gradients of increasing functions of them; and of pairs of thin bodies that may nearly
    /// touch the lines, one of which parts each pair.
    fn constraints(&self, sign: f64) -> (Vec<Bound>, Vec<Parted>) {
        let setting = self.place.setting;
        let scale = setting.scale;
        let exact = Interval::point;
        let in_p = |constraint: Constraint, value: Interval| {
            // Of what is below zero a root says nothing.
            let by_root = constraint.counts_by_root(setting.robot) && value.hi > 0.0;
            if by_root { value.sqrt() } else { value }
        };
        let of = |constraint: Constraint| {
            let size = exact(scale[constraint]);
            Some(match constraint {
                Constraint::Det => {
                    let det = self.determinant();
                    let gradient = joined(&det.along, &det.by_joint).map(|g| g * exact(sign));
                    Bound { value: det.range * exact(sign) / size, gradient, height_of: None }
                }
                Constraint::Reach(j) => {
                    // √H = |B| (|B|/2) grows as s B does where that is positive.
                    let (leg, s) = (&self.legs[j.index()], exact(f64::from(self.mode.sign(j.index()))));
                    let gradient = of_leg(j.index(), &leg.over.slope.gradient.map(|g| g * s));
                    Bound { value: (leg.reach / size).sqrt(), gradient, height_of: Some(j.index()) }
                }
                Constraint::Limit(j, k) => {
                    let leg = &self.legs[j.index()];
                    let gradient = of_leg(j.index(), &leg.over.limits[k].gradient);
                    let value = leg.limits[k] / size;
                    Bound { value: in_p(constraint, value), gradient, height_of: None }
                }
                Constraint::RodAngle(_, k) => self.rod_angle(&setting.robot.rod_angles[k]).bound(size),
                // They follow.
                Constraint::Apart(..) => return None,
            })
        };
        let mut all: Vec<Bound> = Constraint::of(setting.robot).filter_map(of).collect();
        // det A, the last, comes first.
        all.rotate_right(1);
        for (a, &k) in setting.axes.iter().enumerate() {
            let (lo, hi) = setting.window.ranges[k];
            let (y, cut) = (self.place.y[k], setting.window.cut[k]);
            let width = exact(hi) - exact(lo);
            for (cut, distance, sign) in [(cut.0, y - exact(lo), 1.0), (cut.1, exact(hi) - y, -1.0)] {
                if cut {
                    let mut gradient = [ZERO; AXES + MOST];
                    gradient[a] = exact(sign);
                    all.push(Bound { value: distance / width, gradient, height_of: None });
                }
            }
        }
        let mut parted = Vec::new();
        for (k, pair) in setting.robot.pairs.iter().enumerate() {
            let constraint = Constraint::Apart(pair.bodies, k);
            let least = all.iter().fold(f64::INFINITY, |least, bound| least.min(bound.value.hi));
            let size = exact(scale[constraint]);
            match self.apart(pair, scale[constraint], least) {
                Apart::Far => {}
                Apart::Least(distances) => all.extend(distances.iter().map(|distance| {
                    let bound = distance.bound(size);
                    Bound { value: in_p(constraint, bound.value), ..bound }
                })),
                Apart::Parted(lines, joints) => {
                    let bounds = |line: Line| (line.ends.each_ref().map(|end| end.bound(size)), line.turns);
                    let lines = possible(lines.into_iter().map(bounds).collect(), least);
                    parted.extend(lines.map(|lines| Parted { lines, joints: *joints }));
                }
            }
        }
        (all, parted)
    }

    /// Sets of legs for which velocities are chosen with care: those whose B_jj may vanish must be among
    /// them; it helps if those are whose H_j is small, because the gradients of det A and H_j are nearly
    /// parallel there.
    fn choices_of_loose(&self) -> Vec<Vec<usize>> {
        let setting = self.place.setting;
        let among = |most: f64| -> Vec<usize> {
            let is_small =
                |j: usize| setting.has_root(j) && self.legs[j].reach.hi <= most * setting.scale.reach[j];
            let is_among = |j: usize| self.legs[j].loose || is_small(j);
            // Those that are one and the same all or none.
            let first = |j: usize| setting.first_of(j);
            let firsts: Vec<usize> = (0..self.legs.len()).filter(|&j| is_among(j)).map(first).collect();
            (0..self.legs.len()).filter(|&j| firsts.contains(&first(j))).collect()
        };
        let mut choices: Vec<Vec<usize>> = [0.0, 0.1, 0.3, 1.0].map(among).to_vec();
        choices.dedup();
        choices
    }

    /// Returns as many tangent vectors of the configurations as there are axes. With n_j = ∂f_j/∂y they
    /// fulfil n_j·ẏ + B_jj q̇_j = 0 exactly at every configuration of the box with B_jj ≠ 0. For the loose
    /// legs, either ẏ = −B_jj c and q̇_j = n_j·c, or one of two is held by exact cross products:
    ///
    /// - q_j: n_j·ẏ = 0 and q̇_j = 0;
    /// - h_j: ∇H_j·ẏ = 0. As B_jj² is H_j, up to a constant, it does not change, and ∂B_jj/∂y·ẏ + ∂B_jj/∂q_j q̇_j = 0 gives q̇_j. A strut has no H_j.
    ///
    /// Legs i and j that are one and the same have B_jj = ±B_ii, so that −B_ii c moves q_j by ±n_j·c; and holding h_i holds h_j.
    fn velocities(&self, loose: &[usize], held: Held) -> Option<Vec<Velocity>> {
        let along_axes = |gradient: &[Interval]| -> Direction { std::array::from_fn(|a| gradient[a]) };
        let normal = |j: usize| along_axes(&self.legs[j].over.equation.gradient);
        let bend = |j: usize| self.legs[j].over.slope.gradient[OWN];
        let holds_height = |j: usize| held == Held::Height && self.place.setting.has_root(j);
        if loose.iter().any(|&j| holds_height(j) && bend(j).contains(0.0)) {
            return None;
        }
        let first_of = |j: usize| self.place.setting.first_of(j);
        let firsts: Vec<usize> = loose.iter().copied().filter(|&j| first_of(j) == j).collect();
        if held == Held::Joint && firsts.len() < loose.len() {
            return None;
        }
        let across = |&j: &usize| if holds_height(j) { self.place.ascent[j] } else { normal(j) };
        let normals: Vec<Direction> = firsts.iter().map(across).collect();
        let velocity = |(direction, own): (Direction, Option<usize>)| {
            let own = own.map(|i| firsts[i]);
            let factor = own.map_or(ONE, |j| -self.legs[j].over.slope.value);
            let along = direction.map(|x| x * factor);
            let is_own = |j: usize| own == Some(first_of(j));
            let is_level = |j: usize| !is_own(j) && holds_height(j);
            let as_first = |j: usize| f64::from(self.mode.sign(j) * self.mode.sign(first_of(j)));
            let joint = |(j, leg): (usize, &Posture)| match () {
                () if is_own(j) => dot(&normal(j), &direction) * Interval::point(as_first(j)),
                () if !loose.contains(&j) => dot(&leg.rate, &along),
                () if is_level(j) => -(dot(&along_axes(&leg.over.slope.gradient), &along) / bend(j)),
                () => ZERO,
            };
            let mut joints = [ZERO; MOST];
            let legs = self.legs.iter().map(|leg| &**leg);
            joints.iter_mut().zip(legs.enumerate().map(joint)).for_each(|(place, q)| *place = q);
            let level = loose.iter().filter(|j| is_level(**j)).fold(0, |level, j| level | 1 << j);
            Velocity { vector: joined(&along, &joints), level }
        };
        Some(directions(self.place.setting.axes.len(), &normals)?.into_iter().map(velocity).collect())
    }
}

fn joined(along: &Direction, by_joint: &[Interval; MOST]) -> Vector {
    std::array::from_fn(|k| if k < AXES { along[k] } else { by_joint[k - AXES] })
}

/// The derivatives of a function of leg j alone.
fn of_leg(j: usize, gradient: &[Interval; AXES + 1]) -> Vector {
    let mut all = [ZERO; AXES + MOST];
    all[..AXES].copy_from_slice(&gradient[..AXES]);
    all[AXES + j] = gradient[OWN];
    all
}

fn dot<const M: usize>(a: &[Interval; M], b: &[Interval; M]) -> Interval {
    a.iter().zip(b).fold(ZERO, |sum, (a, b)| sum + *a * *b)
}

/// The middle of a vector, at length one.
fn unit(v: &Direction) -> Direction {
    let middle = v.map(Interval::mid);
    let length = middle.iter().map(|x| x * x).sum::<f64>().sqrt();
    middle.map(|x| Interval::point(if length.is_normal() { x / length } else { x }))
}

/// `count` directions: first those perpendicular to all the normals, then for each normal (its index given)
/// one that is perpendicular to all the others. `None` if there are more normals than directions.
fn directions(count: usize, normals: &[Direction]) -> Option<Vec<(Direction, Option<usize>)>> {
    let axis = |a: usize| std::array::from_fn(|k| if k == a { ONE } else { ZERO });
    // Perpendicular to a vector of the first two axes, in their plane.
    let quarter = |v: &Direction| [-v[1], v[0], ZERO];
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::place::{Place, Setting};
    use aspecta_robot::chart::Chart;
    use aspecta_robot::constraint::Scale;
    use aspecta_robot::num::Random;
    use aspecta_robot::{Robot, catalogue};

    /// The derivative of a function along a velocity is 0, as nearly as a box so small can tell.
    #[track_caller]
    fn assert_constant(gradient: &Vector, velocity: &Velocity) {
        let change = dot(gradient, &velocity.vector);
        let size = |v: &Vector| v.iter().map(|x| x.magnitude()).sum::<f64>();
        let small = 1e-3 * size(gradient) * size(&velocity.vector);
        assert!(change.contains(0.0) && change.magnitude() <= small, "{change:?}, above {small:e}");
    }

    /// At random configurations of a robot, whichever legs count as loose; returns how many velocities held
    /// some h_j.
    fn look_at<const D: usize>(robot: &Robot) -> usize {
        let (window, modes) = (robot.slice(&[]).unwrap(), robot.working_modes());
        let scale = Scale::ones(robot);
        let setting = Setting::new(robot, &Chart::Pose, window, &scale);
        let (mut random, mut level) = (Random::new(5), 0);
        for k in 0..400 {
            let at = setting.window.ranges.iter().map(|&range| random.within(range)).collect::<Vec<_>>();
            let y = std::array::from_fn(|k| at.get(k).map_or(ZERO, |&x| Interval::new(x - 1e-9, x + 1e-9)));
            let place = Place::<D>::new(&setting, y);
            let Some(robot) = place.in_mode(modes[k % modes.len()]) else { continue };
            if robot.existence() != Existence::Everywhere {
                continue;
            }
            for (held, set) in
                [Held::Joint, Held::Height].into_iter().flat_map(|h| (0..8).map(move |s| (h, s)))
            {
                let loose: Vec<usize> = (0..robot.legs.len()).filter(|j| set >> j & 1 == 1).collect();
                for velocity in robot.velocities(&loose, held).unwrap_or_default() {
                    for (j, leg) in robot.legs.iter().enumerate() {
                        assert_constant(&of_leg(j, &leg.over.equation.gradient), &velocity);
                        if velocity.level >> j & 1 == 1 {
                            assert_constant(&of_leg(j, &leg.over.slope.gradient), &velocity);
                            level += 1;
                        }
                    }
                }
            }
        }
        level
    }

    #[test]
    fn velocities_are_tangent_and_hold_what_they_say() {
        for name in ["five-bar", "2-prr", "3-rrr", "3-prr", "3-rpr"] {
            // Struts have no h_j.
            assert_eq!(look_at::<2>(&catalogue::find(name).unwrap()) > 50, name != "3-rpr", "{name}");
        }
        for name in ["delta", "linear-delta", "orthoglide"] {
            assert!(look_at::<3>(&catalogue::find(name).unwrap()) > 50, "{name}");
        }
        let sphere = include_str!("../../aspecta/tests/fixtures/sphere.toml");
        assert!(look_at::<3>(&Robot::from_toml(sphere, "sphere.toml").unwrap()) > 50);
    }
}
