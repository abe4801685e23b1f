//! Cusps against brute force on closed forms that share nothing with the library, and against the direct model.

use aspecta::Kinematics;
use aspecta::domain::cusps::{Cusp, CuspError, Cusps, Doubt, Options, Proof, cusp_curves, cusps};
use aspecta::num::Interval;
use aspecta::paving::Control;
use aspecta::robot::{Leg, LegIndex, Limit, Platform, Robot};
use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

fn search(robot: &Robot, options: &Options) -> Result<Cusps, CuspError> {
    cusps(robot, options, &Control { cancelled: &AtomicBool::new(false), progress: &|_| {} })
}

fn slice(robot: &Robot, joint: usize, value: f64, mode: &str) -> Cusps {
    let options =
        Options { fix: vec![(LegIndex::new(joint), value)], mode: Some(mode.parse().unwrap()), boxes: None };
    let found = search(robot, &options).unwrap();
    assert!(found.complete && found.proof == Proof::Intervals, "{:?}", found.undecided);
    found
}

/// The difference of two angles, in (−π, π].
fn between(a: f64, b: f64) -> f64 {
    (a - b) - TAU * ((a - b) / TAU).round()
}

type Vector = [f64; 2];

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

/// A planar robot whose first leg is locked: C₁ runs on a circle of angle α, and the platform, with C₁ as its origin, has the angle φ.
struct Locked<F> {
    /// Centre and radius of the circle of C₁.
    circle: (Vector, f64),
    /// C₂ and C₃ in the platform.
    attachments: [Vector; 2],
    /// The vector of leg 2 (0) or 3 (1) from the end of what its actuator holds to C, for C; `None` out of reach.
    rod: F,
}

impl<F: Fn(usize, Vector) -> Option<Vector>> Locked<F> {
    /// ∂f_i/∂(α, φ) of legs 2 and 3, with their actuators locked.
    fn rows(&self, [alpha, phi]: Vector) -> Option<[Vector; 2]> {
        let (centre, radius) = self.circle;
        let (s, c) = phi.sin_cos();
        let first = [radius * alpha.cos(), radius * alpha.sin()];
        let mut rows = [[0.0; 2]; 2];
        for (i, a) in self.attachments.iter().enumerate() {
            let arm = [c * a[0] - s * a[1], s * a[0] + c * a[1]];
            let end = [centre[0] + first[0] + arm[0], centre[1] + first[1] + arm[1]];
            let rod = (self.rod)(i, end)?;
            rows[i] = [dot(rod, [-first[1], first[0]]), dot(rod, [-arm[1], arm[0]])];
        }
        Some(rows)
    }

    /// The determinant that vanishes where two solutions meet.
    fn det(&self, at: Vector) -> Option<f64> {
        let [a, b] = self.rows(at)?;
        Some(a[0] * b[1] - a[1] * b[0])
    }

    /// The motion that is left there, on the side of `like`.
    fn kernel(&self, at: Vector, like: Vector) -> Option<Vector> {
        let [a, b] = self.rows(at)?;
        let row = if dot(a, a) > dot(b, b) { a } else { b };
        let n = dot(row, row).sqrt() * if dot([-row[1], row[0]], like) < 0.0 { -1.0 } else { 1.0 };
        Some([-row[1] / n, row[0] / n])
    }

    /// How the determinant changes along that motion: zero where three solutions meet.
    fn slope(&self, at: Vector, v: Vector) -> Option<f64> {
        const H: f64 = 1e-5;
        let ahead = self.det([at[0] + H * v[0], at[1] + H * v[1]])?;
        let behind = self.det([at[0] - H * v[0], at[1] - H * v[1]])?;
        Some((ahead - behind) / (2.0 * H))
    }

    /// A cusp near `at`, by Newton's method.
    fn polish(&self, mut at: Vector) -> Option<Vector> {
        const H: f64 = 1e-4;
        let like = self.kernel(at, [1.0, 0.3])?;
        let f = |at: Vector| Some([self.det(at)?, self.slope(at, self.kernel(at, like)?)?]);
        let start = at;
        for _ in 0..20 {
            let value = f(at)?;
            let along = |k: usize| {
                let step = |h: f64| f(std::array::from_fn(|j| if j == k { at[j] + h } else { at[j] }));
                Some(minus(step(H)?, step(-H)?).map(|d| d / (2.0 * H)))
            };
            let (x, y) = (along(0)?, along(1)?);
            let area = x[0] * y[1] - x[1] * y[0];
            let step =
                [(value[0] * y[1] - value[1] * y[0]) / area, (x[0] * value[1] - x[1] * value[0]) / area];
            at = minus(at, step);
            if step[0].abs().max(step[1].abs()) < 1e-8 {
                return (minus(at, start).iter().all(|d| d.abs() < 0.05)).then_some(at);
            }
        }
        None
    }

    /// All cusps that a grid of n × n cells shows: the slope changes its sign along the curve det = 0 in a cell.
    fn brute_force(&self, n: usize) -> Vec<Vector> {
        let angle = |k: usize| (k as f64 + 0.37) * TAU / n as f64;
        let row =
            |i: usize| -> Vec<Option<f64>> { (0..=n).map(|k| self.det([angle(i), angle(k)])).collect() };
        let mut found: Vec<Vector> = Vec::new();
        let mut below = row(0);
        for i in 0..n {
            let above = row(i + 1);
            for k in 0..n {
                let corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
                    .map(|(a, b)| ([angle(i + a), angle(k + b)], [&below, &above][a][k + b]));
                if corners.iter().any(|c| c.1.is_none()) {
                    continue;
                }
                let crossings: Vec<Vector> =
                    (0..4).filter_map(|e| crossing(corners[e], corners[(e + 1) % 4])).collect();
                let Some(first) = crossings.first() else { continue };
                let like = self.kernel(*first, [1.0, 0.3]).unwrap();
                let slopes: Vec<f64> =
                    crossings.iter().filter_map(|at| self.slope(*at, self.kernel(*at, like)?)).collect();
                if slopes.iter().all(|s| *s > 0.0) || slopes.iter().all(|s| *s < 0.0) {
                    continue;
                }
                let Some(cusp) = self.polish(*first) else { continue };
                let near = |c: &Vector| (0..2).all(|j| between(c[j], cusp[j]).abs() < 1e-6);
                if !found.iter().any(near) {
                    found.push(cusp);
                }
            }
            below = above;
        }
        found
    }

    /// x, y, φ.
    fn pose(&self, [alpha, phi]: Vector) -> [f64; 3] {
        let (c, r) = self.circle;
        [c[0] + r * alpha.cos(), c[1] + r * alpha.sin(), phi]
    }
}

/// Where a function with these values at two points is zero between them, by a straight line.
fn crossing((a, f): (Vector, Option<f64>), (b, g): (Vector, Option<f64>)) -> Option<Vector> {
    let (f, g) = (f?, g?);
    ((f > 0.0) != (g > 0.0)).then(|| std::array::from_fn(|k| a[k] + (b[k] - a[k]) * f / (f - g)))
}

#[track_caller]
fn assert_same_poses(found: &[Cusp], wanted: &[[f64; 3]]) {
    let poses: Vec<_> = found.iter().map(|c| c.pose.clone()).collect();
    assert_eq!(poses.len(), wanted.len(), "{poses:?}\n{wanted:?}");
    for w in wanted {
        let same = |p: &&Vec<f64>| {
            (p[0] - w[0]).abs() < 1e-5 && (p[1] - w[1]).abs() < 1e-5 && between(p[2], w[2]).abs() < 1e-6
        };
        assert!(poses.iter().any(|p| same(&p)), "{w:?} is not in {poses:?}");
    }
}

/// The catalogue's 3-RPR, its numbers typed again.
const A2: Vector = [15.91, 0.0];
const A3: Vector = [0.0, 10.0];
const C2: Vector = [17.04, 0.0];

fn c3() -> Vector {
    let x = (17.04_f64.powi(2) + 20.84_f64.powi(2) - 16.54_f64.powi(2)) / (2.0 * 17.04);
    [x, (20.84_f64.powi(2) - x * x).sqrt()]
}

/// (McAree & Daniel 1999; Zein, Wenger & Chablat 2008 draw six at ρ₁ = 14.98 and other numbers elsewhere.)
#[test]
fn the_3_rpr_has_the_cusps_that_brute_force_finds() {
    let robot = Robot::resolve("3-rpr").unwrap();
    for rho in [14.98, 17.0, 25.0] {
        let found = slice(&robot, 0, rho, "---");
        let free = Locked {
            circle: ([0.0, 0.0], rho),
            attachments: [C2, c3()],
            rod: |i: usize, end| Some(minus(end, [A2, A3][i])),
        };
        let wanted: Vec<_> = free.brute_force(1200).into_iter().map(|at| free.pose(at)).collect();
        assert_same_poses(&found.cusps, &wanted);
        if rho == 14.98 {
            assert_eq!(found.cusps.len(), 6);
        }
    }
}

/// The eliminant of the 3-RPR (Innocenti & Parenti-Castelli 1992): with C₁ = u, the differences of the leg equations are u·wᵢ = gᵢ; Cramer's
/// rule and ‖u‖ = ρ₁ leave one function of φ whose roots are the direct solutions.
fn eliminant(phi: f64, rho: &[f64]) -> f64 {
    let (s, c) = phi.sin_cos();
    let line = |a: Vector, base: Vector, r: f64| {
        let w = minus([c * a[0] - s * a[1], s * a[0] + c * a[1]], base);
        (w, 0.5 * (r * r - rho[0] * rho[0] - dot(w, w)))
    };
    let ((w2, g2), (w3, g3)) = (line(C2, A2, rho[1]), line(c3(), A3, rho[2]));
    let area = w2[0] * w3[1] - w2[1] * w3[0];
    let u = [g2 * w3[1] - g3 * w2[1], w2[0] * g3 - w3[0] * g2];
    (dot(u, u) - (rho[0] * area).powi(2)) / 20.0_f64.powi(6)
}

#[test]
fn at_a_cusp_the_direct_problem_has_a_triple_root() {
    let robot = Robot::resolve("3-rpr").unwrap();
    for cusp in slice(&robot, 0, 14.98, "---").cusps {
        const H: f64 = 2e-3;
        let f = |k: f64| eliminant(cusp.pose[2] + k * H, &cusp.q);
        let first = (f(-2.0) - 8.0 * f(-1.0) + 8.0 * f(1.0) - f(2.0)) / (12.0 * H);
        let second = (-f(-2.0) + 16.0 * f(-1.0) - 30.0 * f(0.0) + 16.0 * f(1.0) - f(2.0)) / (12.0 * H * H);
        let third = (f(2.0) - 2.0 * f(1.0) + 2.0 * f(-1.0) - f(-2.0)) / (2.0 * H.powi(3));
        let vanish = |x: f64| x.abs() < 1e-6 * third.abs();
        assert!(
            third.abs() > 1e-3 && [f(0.0), first, second].into_iter().all(vanish),
            "{first} {second} {third}"
        );
    }
}

fn three_rrr() -> Robot {
    Robot::resolve("3-rrr").unwrap()
}

/// The elbow of a leg with L = M = 10 at `anchor`, to the side that makes ∂f/∂q positive (`side` = 1) or negative.
fn elbow(anchor: Vector, end: Vector, side: f64) -> Option<Vector> {
    let d = minus(end, anchor);
    let square = dot(d, d);
    let height = (100.0 / square - 0.25).sqrt();
    // B = 2 L (sin q dₓ − cos q d_y) is positive with the crank to the left of d.
    height.is_finite().then(|| {
        let b = [0.5 * d[0] - side * height * d[1], 0.5 * d[1] + side * height * d[0]];
        minus(d, b)
    })
}

#[test]
fn the_3_rrr_has_the_cusps_that_brute_force_finds() {
    for (mode, sides) in [("+++", [1.0, 1.0]), ("+-+", [-1.0, 1.0])] {
        let found = slice(&three_rrr(), 0, 0.5, mode);
        let (s, c) = 0.5_f64.sin_cos();
        let free = Locked {
            circle: ([-10.0 + 10.0 * c, -10.0 + 10.0 * s], 10.0),
            attachments: [[10.0, 0.0], [10.0, 10.0]],
            rod: |i: usize, end| elbow([[10.0, -10.0], [0.0, 10.0]][i], end, sides[i]),
        };
        // The brute force does not know leg 1's posture: ∂f₁/∂q₁ > 0.
        let posture = |x: &[f64; 3]| s * (x[0] + 10.0) - c * (x[1] + 10.0) > 0.0;
        let poses = free.brute_force(1200).into_iter().map(|at| free.pose(at));
        let wanted: Vec<_> = poses.filter(posture).collect();
        assert!(!wanted.is_empty());
        assert_same_poses(&found.cusps, &wanted);
    }
}

/// On one side of a cusp three direct solutions are near it, on the other one: two fewer in all.
#[test]
fn three_direct_solutions_meet_at_the_cusps_of_a_3_rrr() {
    let robot = three_rrr();
    let options = Options { fix: vec![(LegIndex::new(1), 2.0)], ..Options::default() };
    let found = search(&robot, &options).unwrap();
    assert!(found.complete && found.modes.len() == 8 && !found.cusps.is_empty());
    for cusp in &found.cusps {
        let beside = cusp.unfolding.as_ref().expect("the direct model tells");
        let all = [&beside.three, &beside.one].map(|q| robot.direct_certified(q).unwrap());
        assert!(all[0].complete && all[1].complete, "{beside:?}");
        assert_eq!(all[0].solutions.len(), all[1].solutions.len() + 2);
        assert!((0..3).all(|k| between(beside.three[k], cusp.q[k]).abs() < 1e-3), "{cusp:?}");
        let near = |x: &&aspecta::kinematics::Solution| {
            (0..2).all(|k| (x.pose[k] - cusp.pose[k]).abs() < 1.5)
                && between(x.pose[2], cusp.pose[2]).abs() < 0.15
        };
        let three: Vec<_> = all[0].solutions.iter().filter(near).collect();
        assert_eq!(three.len(), 3, "{cusp:?}");
        assert!(three.iter().all(|x| x.mode == cusp.mode && x.certified));
        // One of the three is on the other side of the singularity.
        let signs: f64 = three.iter().map(|x| x.det_a.signum()).sum();
        assert_eq!(signs.abs(), 1.0);
    }
}

/// The 3-RPR, scaled, turned and moved.
fn moved(scale: f64, angle: f64, shift: Vector) -> Robot {
    let (s, c) = angle.sin_cos();
    let leg = |anchor: Vector, attachment: Vector| {
        let a = [
            shift[0] + scale * (c * anchor[0] - s * anchor[1]),
            shift[1] + scale * (s * anchor[0] + c * anchor[1]),
        ];
        let mut leg = Leg::strut(a, attachment.map(|x| scale * x));
        let [min, max] = [10.0, 32.0].map(|x| Interval::point(scale * x));
        leg.limits = vec![Limit::ActuatorLength { min, max }];
        leg
    };
    let legs = vec![leg([0.0, 0.0], [0.0, 0.0]), leg(A2, C2), leg(A3, c3())];
    Robot::new("moved", Platform::PlaneBody, legs).unwrap()
}

#[test]
fn cusps_move_with_the_robot() {
    let (scale, angle, shift) = (0.03, 2.5_f64, [7.0, -4.0]);
    let here = slice(&Robot::resolve("3-rpr").unwrap(), 0, 14.98, "---");
    let there = slice(&moved(scale, angle, shift), 0, 14.98 * scale, "---");
    let (s, c) = angle.sin_cos();
    let carried = |p: &Cusp| {
        let [x, y] = [scale * p.pose[0], scale * p.pose[1]];
        [shift[0] + c * x - s * y, shift[1] + s * x + c * y, p.pose[2] + angle]
    };
    assert_same_poses(&there.cusps, &here.cusps.iter().map(carried).collect::<Vec<_>>());
    let within = |found: &Cusps| found.cusps.iter().filter(|c| c.within_limits).count();
    assert_eq!((within(&here), within(&there)), (4, 4));
}

#[test]
fn platforms_that_do_not_turn_have_none() {
    let none = search(&Robot::resolve("five-bar").unwrap(), &Options::default()).unwrap();
    assert!(none.cusps.is_empty() && none.complete && none.proof == Proof::Quadratic);
    let fix = vec![(LegIndex::new(0), 0.3)];
    let none = search(&Robot::resolve("delta").unwrap(), &Options { fix, ..Options::default() }).unwrap();
    assert!(none.cusps.is_empty() && none.complete);
}

#[test]
fn what_a_budget_leaves_is_undecided_not_dropped() {
    let robot = Robot::resolve("3-rpr").unwrap();
    let options = Options { fix: vec![(LegIndex::new(0), 14.98)], boxes: Some(300), ..Options::default() };
    let found = search(&robot, &options).unwrap();
    assert!(!found.complete && found.boxes <= 300);
    let all = slice(&robot, 0, 14.98, "---");
    for cusp in &all.cusps {
        let holds = |e: &[Interval]| e.iter().zip(&cusp.pose).all(|(e, x)| e.contains(*x));
        let known = found
            .cusps
            .iter()
            .any(|c| c.enclosure.iter().zip(&cusp.pose).all(|(e, x)| (e.mid() - x).abs() < 1e-8));
        assert!(known || found.undecided.iter().any(|u| u.why == Doubt::Boxes && holds(&u.enclosure)));
    }
}

#[test]
fn options_that_do_not_fit_are_refused() {
    let robot = three_rrr();
    let refused = |fix: &[(usize, f64)]| {
        let fix = fix.iter().map(|&(j, value)| (LegIndex::new(j), value)).collect();
        search(&robot, &Options { fix, ..Options::default() }).unwrap_err().to_string()
    };
    assert!(refused(&[]).contains("with 1 of the 3 joints held, not 0"));
    assert!(refused(&[(0, 1.0), (1, 1.0)]).contains("not 2"));
    assert!(refused(&[(3, 1.0)]).contains("there is no joint 4"));
    assert!(refused(&[(0, f64::NAN)]).contains("is NaN"));
    let strut = Options { fix: vec![(LegIndex::new(0), -1.0)], ..Options::default() };
    assert!(matches!(search(&Robot::resolve("3-rpr").unwrap(), &strut), Err(CuspError::Value(_))));
    assert!(matches!(search(&Robot::resolve("hexa").unwrap(), &strut), Err(CuspError::Dimension { .. })));
    let mode = Options { fix: vec![(LegIndex::new(0), 14.98)], mode: "+++".parse().ok(), boxes: None };
    assert!(matches!(search(&Robot::resolve("3-rpr").unwrap(), &mode), Err(CuspError::Mode { .. })));
}

/// Curves followed from slices pass through the cusps of slices that they did not start from, and nowhere else.
#[test]
fn the_curves_of_the_3_rpr_pass_through_the_cusps_of_other_slices() {
    let robot = Robot::resolve("3-rpr").unwrap();
    let control = Control { cancelled: &AtomicBool::new(false), progress: &|_| {} };
    let curves = cusp_curves(&robot, &Options::default(), &control).unwrap();
    assert!(curves.slices_complete && !curves.curves.is_empty());
    let distance =
        |a: &[f64], b: &[f64]| ((a[0] - b[0]) / 20.0).hypot((a[1] - b[1]) / 20.0).hypot(between(a[2], b[2]));
    let points = || curves.curves.iter().flat_map(|c| &c.points);
    for rho in [13.37, 19.3, 27.1] {
        for cusp in slice(&robot, 0, rho, "---").cusps {
            let nearest = points().map(|p| distance(&p.pose, &cusp.pose)).fold(f64::INFINITY, f64::min);
            assert!(nearest < 0.05, "{rho} {cusp:?}");
        }
    }
    for point in points().step_by(97) {
        let cusps = slice(&robot, 0, point.q[0], "---").cusps;
        let nearest = cusps.iter().map(|c| distance(&point.pose, &c.pose)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-6, "{point:?}");
    }
    for curve in &curves.curves {
        let steps = curve.points.windows(2).map(|w| distance(&w[0].pose, &w[1].pose));
        assert!(steps.fold(0.0, f64::max) < 0.06);
    }
}
