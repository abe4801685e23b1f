//! The proof that P has no maximum in a box: tangent vectors along which all grows that can be the least.

use super::body::MOST;
use super::curvature::has_no_maximum;
use super::direction::climbable;
use super::view::{Coordinates, ONE, Posture, View, ZERO};
use crate::kinematics::WorkingMode;
use crate::num::{Interval, Scalar};

/// A velocity: of the coordinates, then of each leg's q.
type Velocity = [Interval; 6];

/// One of the functions whose least is P.
struct Constraint {
    value: Interval,
    gradient: [Interval; 6],
}

impl View<'_> {
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
                // √H = |B| (|B|/2) grows as s B does where that is positive.
                let s = exact(f64::from(mode.sign(j)));
                let gradient = leg.over.slope.gradient.map(|g| g * s);
                let value = (self.reach[j] / exact(scale.reach[j])).sqrt();
                all.push(Constraint { value, gradient });
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

    /// Sets of legs for which velocities are chosen with care: those whose B_jj may vanish must be among them; it helps if those are
    /// whose H_j is small, because the gradients of det A and H_j are nearly parallel there.
    fn choices_of_loose(&self, legs: &[Option<&Posture>; MOST]) -> Vec<Vec<usize>> {
        let rooted = |j: usize| {
            legs[j].is_some()
                && !self.setting.is_own(j)
                && self.setting.robot.legs[j].actuator.postures() == 2
        };
        let must = |j: usize| legs[j].is_some_and(|leg| leg.loose);
        let among = |most: f64| -> Vec<usize> {
            let is_small = |j: usize| rooted(j) && self.reach[j].hi <= most * self.setting.scale.reach[j];
            (0..MOST).filter(|&j| must(j) || is_small(j)).collect()
        };
        let mut choices: Vec<Vec<usize>> = [0.0, 0.1, 0.3, 1.0].map(among).to_vec();
        choices.dedup();
        choices
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
