//! What a paving claims, held against configurations recomputed from scratch on random robots of every platform that
//! can be paved. `ASPECTA_CASES` sets the number of robots tried of each kind (20 by default).

use crate::obstacles::to_spare;
use aspecta::Kinematics;
use aspecta::aspect::{Analysis, AspectId, ClassId, DetSign, Options, Place, analyze};
use aspecta::kinematics::WorkingMode;
use aspecta::kinematics::chart::Chart;
use aspecta::kinematics::constraints::{Constraint, Demand};
use aspecta::kinematics::path::curve::{Along, Curve, along};
use aspecta::num::Interval;
use aspecta::paving::{Budget, Control, Mark, Node, Paving, Stop};
use aspecta::robot::{Actuator, Leg, LegIndex, Limit, Platform, Revolute, Robot, Strut, catalogue};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;
use std::sync::atomic::AtomicBool;

fn to_depth(depth: u32) -> Budget {
    Budget { depth: Some(depth), ..Budget::default() }
}

// Random robots, as robot files.

/// Numbers in [0, 1) handed out one by one.
struct Dice<'a>(std::slice::Iter<'a, f64>);

impl Dice<'_> {
    fn between(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.0.next().expect("enough dice")
    }
    fn vector(&mut self, space: usize, size: f64) -> String {
        let v: Vec<String> = (0..space).map(|_| format!("{:.4}", self.between(-size, size))).collect();
        format!("[{}]", v.join(", "))
    }
    /// A range of angles, 100° to 300° wide.
    fn angles(&mut self) -> String {
        let (middle, half) = (self.between(-180.0, 180.0), self.between(50.0, 150.0));
        format!("{{ deg = [{:.3}, {:.3}] }}", middle - half, middle + half)
    }
    fn chance(&mut self, probability: f64) -> bool {
        self.between(0.0, 1.0) < probability
    }
}

fn leg(dice: &mut Dice, platform: Platform, kind: &str) -> String {
    let space = platform.space();
    let mut limits = Vec::new();
    let mut text = String::from("\n[[legs]]\n");
    if kind != "spherical" {
        text += &format!("anchor = {}\n", dice.vector(space, 6.0));
    }
    let attachment = dice.vector(space, if kind == "spherical" { 1.0 } else { 3.0 });
    if platform != Platform::PlanePoint {
        text += &format!("attachment = {attachment}\n");
    }
    let turning = format!("axis = {}, zero = {}", dice.vector(3, 1.0), dice.vector(3, 1.0));
    let (crank, rod) = (dice.between(4.0, 9.0), dice.between(4.0, 9.0));
    let keys = match kind {
        "revolute" if space == 2 => format!("crank = {crank:.4}, rod = {rod:.4}"),
        "revolute" => format!("crank = {crank:.4}, rod = {rod:.4}, {turning}"),
        "prismatic" => format!("direction = {}, rod = {rod:.4}", dice.vector(space, 1.0)),
        "spherical" => {
            let (a, b) = (dice.between(40.0, 100.0), dice.between(40.0, 100.0));
            format!("proximal = {{ deg = {a:.3} }}, distal = {{ deg = {b:.3} }}, {turning}")
        }
        _ => String::new(),
    };
    let comma = if keys.is_empty() { "" } else { ", " };
    text += &format!("actuator = {{ kind = \"{kind}\"{comma}{keys} }}\n");
    match kind {
        "prismatic" => limits.push(format!(
            "actuator = [{:.3}, {:.3}]",
            dice.between(-9.0, -3.0),
            dice.between(3.0, 9.0)
        )),
        "strut" => {
            limits.push(format!("actuator = [{:.3}, {:.3}]", dice.between(0.0, 4.0), dice.between(8.0, 15.0)))
        }
        _ if dice.chance(0.3) => limits.push(format!("actuator = {}", dice.angles())),
        _ => {}
    }
    if kind == "revolute" && dice.chance(0.3) {
        let range = if space == 2 {
            dice.angles()
        } else {
            format!("{{ deg = [{:.3}, {:.3}] }}", dice.between(1.0, 60.0), dice.between(100.0, 179.0))
        };
        limits.push(format!("elbow = {range}"));
    }
    for joint in ["base-joint", "platform-joint"] {
        if kind != "spherical" && dice.chance(0.2) {
            let range = if space == 2 {
                dice.angles()
            } else {
                let within = dice.between(60.0, 140.0);
                format!("{{ axis = {}, within = {{ deg = {within:.3} }} }}", dice.vector(3, 1.0))
            };
            limits.push(format!("{joint} = {range}"));
        }
    }
    text + &format!("limits = {{ {} }}\n", limits.join(", "))
}

/// A random robot, if its legs meet; in two cases of three it is looked at through a window about a random pose, where boxes are small.
fn robot(family: usize, dice: &[f64]) -> Option<Robot> {
    let mut dice = Dice(dice.iter());
    let (platform, kinds) = match family {
        0 => (Platform::PlanePoint, ["revolute"; 3]),
        1 => (Platform::PlanePoint, ["prismatic", "strut", "prismatic"]),
        2 => (Platform::PlaneBody, ["revolute"; 3]),
        3 => (Platform::PlaneBody, ["strut"; 3]),
        4 => (Platform::PlaneBody, ["prismatic", "revolute", "prismatic"]),
        5 => (Platform::TranslatingBody, ["revolute"; 3]),
        6 => (Platform::TranslatingBody, ["prismatic", "strut", "revolute"]),
        _ => (Platform::TurningBody, ["spherical"; 3]),
    };
    let mut text = format!("name = \"random\"\nplatform = \"{platform}\"\n");
    for kind in &kinds[..platform.dof()] {
        text += &leg(&mut dice, platform, kind);
    }
    let mut robot = match Robot::from_toml(&text, "random") {
        Ok(robot) => robot,
        Err(e) if e.to_string().contains("never meet") => return None,
        Err(e) => panic!("{e}\n{text}"),
    };
    if dice.chance(0.67) {
        for (k, c) in platform.coordinates().iter().enumerate() {
            let (middle, half) = match (c.angle, c.periodic) {
                (true, true) => (dice.between(-2.5, 2.5), 0.6),
                (true, false) => (dice.between(-1.0, 1.0), 0.5),
                _ => (dice.between(-5.0, 5.0), 2.0),
            };
            robot.window[k] = Some((middle - half, middle + half));
        }
    }
    Some(robot)
}

const FAMILIES: usize = 8;

/// The same sequence of values at every run.
fn samples<S: Strategy>(strategy: S, count: usize) -> impl Iterator<Item = S::Value> {
    let mut runner = TestRunner::deterministic();
    (0..count).map(move |_| strategy.new_tree(&mut runner).unwrap().current())
}

/// Tries in each family: its number, the robot and 600 numbers to go with it.
fn robots() -> impl Iterator<Item = (usize, Robot, Vec<f64>)> {
    let each: usize = std::env::var("ASPECTA_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(20);
    let dice = prop::collection::vec(0.0..1.0f64, 100);
    samples((dice, prop::collection::vec(0.0..1.0f64, 600)), each * FAMILIES)
        .enumerate()
        .filter_map(|(i, (dice, rest))| Some((i % FAMILIES, robot(i % FAMILIES, &dice)?, rest)))
}

// Configurations, recomputed from the definitions.

type Vector = [f64; 3];

fn mid(v: &[Interval; 3]) -> Vector {
    v.map(|x| x.mid())
}
fn dot(a: &Vector, b: &Vector) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
fn sub(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| a[k] - b[k])
}
fn unit(a: &Vector) -> Vector {
    let norm = dot(a, a).sqrt();
    a.map(|x| x / norm)
}

/// R = R_z R_y R_x and the origin of the platform.
fn placement(platform: Platform, x: &[f64]) -> ([Vector; 3], Vector) {
    let about = |axis: usize, t: f64, v: Vector| {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut w = v;
        (w[i], w[j]) = (t.cos() * v[i] - t.sin() * v[j], t.sin() * v[i] + t.cos() * v[j]);
        w
    };
    let (angles, origin) = match platform {
        Platform::PlanePoint => ([0.0; 3], [x[0], x[1], 0.0]),
        Platform::PlaneBody => ([0.0, 0.0, x[2]], [x[0], x[1], 0.0]),
        Platform::TranslatingBody => ([0.0; 3], [x[0], x[1], x[2]]),
        Platform::TurningBody => ([x[0], x[1], x[2]], [0.0; 3]),
        Platform::FreeBody => ([x[3], x[4], x[5]], [x[0], x[1], x[2]]),
    };
    let column = |k: usize| {
        let mut e = [0.0; 3];
        e[k] = 1.0;
        about(2, angles[2], about(1, angles[1], about(0, angles[0], e)))
    };
    let columns = [column(0), column(1), column(2)];
    (std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i])), origin)
}

/// How far q is inside a limit, relative, from the geometry of the links.
fn margin(limit: &Limit, leg: &Leg, platform: Platform, x: &[f64], q: f64) -> f64 {
    let (turn, origin) = placement(platform, x);
    let turned = |v: &Vector| turn.map(|row| dot(&row, v));
    let c: Vector = std::array::from_fn(|k| turned(&mid(&leg.attachment))[k] + origin[k]);
    let frame: [Vector; 3] = std::array::from_fn(|k| mid(&leg.frame[k]));
    let out = |v: Vector| -> Vector { std::array::from_fn(|k| (0..3).map(|i| v[i] * frame[i][k]).sum()) };
    let (driver, rod, b) = match leg.actuator {
        Actuator::Revolute(Revolute { crank, .. }) => {
            let u = out([q.cos(), q.sin(), 0.0]);
            let b: Vector = std::array::from_fn(|k| mid(&leg.anchor)[k] + crank.mid() * u[k]);
            (u, unit(&sub(&c, &b)), b)
        }
        Actuator::Prismatic(_) => {
            let b: Vector = std::array::from_fn(|k| mid(&leg.anchor)[k] + q * frame[0][k]);
            (frame[0], unit(&sub(&c, &b)), b)
        }
        _ => ([0.0; 3], unit(&sub(&c, &mid(&leg.anchor))), mid(&leg.anchor)),
    };
    match limit {
        Limit::ActuatorAngle { middle, half_cos, .. } => {
            q.cos() * middle.0.mid() + q.sin() * middle.1.mid() - half_cos.mid()
        }
        Limit::ActuatorLength { min, max } => (q - min.mid()).min(max.mid() - q) / 10.0,
        Limit::Elbow { middle, half_cos } => {
            let (cos, sin) = (dot(&driver, &rod), driver[0] * rod[1] - driver[1] * rod[0]);
            cos * middle.0.mid() + sin * middle.1.mid() - half_cos.mid()
        }
        Limit::SpatialElbow { min_cos, max_cos } => {
            let cos = dot(&driver, &rod);
            (min_cos.mid() - cos).min(cos - max_cos.mid())
        }
        Limit::BaseCone { axis, half_cos } => dot(&out(mid(axis)), &rod) - half_cos.mid(),
        Limit::PlatformCone { axis, half_cos } => dot(&turned(&mid(axis)), &rod) - half_cos.mid(),
        Limit::Clearance(clearance) => to_spare(clearance, [mid(&leg.anchor), b, c]) / 10.0,
    }
}

/// How far a pose is inside the mode (its least margin), and det A relative to its rows.
fn recomputed(robot: &Robot, mode: WorkingMode, x: &[f64]) -> (f64, f64) {
    let legs = robot.leg_solutions(x).unwrap();
    let mut least = f64::INFINITY;
    let mut q = Vec::new();
    for (j, (solutions, leg)) in legs.iter().zip(&robot.legs).enumerate() {
        least = least.min(solutions.reach);
        let Some(qj) = solutions.q[usize::from(mode.sign(j) < 0)] else { return (least.min(0.0), 0.0) };
        for limit in &leg.limits {
            least = least.min(margin(limit, leg, robot.platform, x, qj));
        }
        q.push(qj);
    }
    let jacobians = robot.jacobians(x, &q).unwrap();
    if least > NOISE {
        assert!(jacobians.residual < 1e-6, "{mode} {x:?} {q:?}: {}", jacobians.residual);
        let strut = |j: usize| robot.legs[j].actuator == Actuator::Strut(Strut);
        assert!((0..q.len()).all(|j| strut(j) || (jacobians.b[j] > 0.0) == (mode.sign(j) > 0)));
    }
    let rows: f64 = jacobians.a.iter().map(|r| r.iter().map(|a| a * a).sum::<f64>().sqrt()).product();
    (least, jacobians.det_a() / rows)
}

/// Below this, relative, a recomputed sign says nothing.
const NOISE: f64 = 1e-9;

/// Whether a pose is in the class: `None` too near to the boundary to tell in doubles.
fn member(robot: &Robot, mode: WorkingMode, sign: DetSign, x: &[f64]) -> Option<bool> {
    let (least, det) = recomputed(robot, mode, x);
    let depth = least.min(det * f64::from(sign.factor()));
    (depth.abs() > NOISE).then_some(depth > 0.0)
}

/// A pose of a box; every fourth on its boundary.
fn pose_in(paving: &Paving, node: u32, dice: &mut Dice) -> Vec<f64> {
    let (lo, hi) = paving.bounds(node);
    let edge = dice.chance(0.25);
    let mut pose = paving.centre(node);
    for (a, k) in paving.window.axes().into_iter().enumerate() {
        let t = dice.between(0.0, 1.0);
        pose[k] =
            if edge && t < 0.5 { if t < 0.25 { lo[a] } else { hi[a] } } else { lo[a] + t * (hi[a] - lo[a]) };
    }
    pose
}

/// Robots of each family, analysed, with further numbers drawn for each.
static ANALYSED: LazyLock<Vec<(usize, Analysis, Vec<f64>)>> = LazyLock::new(|| {
    let analysed = |(family, robot, rest)| Some((family, analyzed_slice(&robot, Vec::new())?, rest));
    robots().filter_map(analysed).collect()
});

fn analyzed_slice(robot: &Robot, fix: Vec<(usize, f64)>) -> Option<Analysis> {
    let depth = [10, 7, 4][robot.dof() - fix.len() - 1];
    // The windows of some random robots are empty.
    analyze(robot, &Options { budget: to_depth(depth), fix, ..Options::default() }, &Control::unwatched())
        .ok()
}

fn classes(paving: &Paving) -> impl Iterator<Item = (usize, WorkingMode, DetSign)> {
    let modes: Vec<_> = paving.modes.iter().copied().enumerate().collect();
    modes
        .into_iter()
        .flat_map(|(m, mode)| [(2 * m, mode, DetSign::Positive), (2 * m + 1, mode, DetSign::Negative)])
}

/// Inside, outside and closed boxes are what they claim, at random poses of random boxes of every size.
#[test]
fn certificates_hold() {
    let mut seen = [[0usize; 4]; FAMILIES];
    for (family, analysis, rest) in &*ANALYSED {
        let (robot, paving) = (&analysis.robot, &analysis.pavings[0]);
        let mut dice = Dice(rest.iter());
        let seen = &mut seen[*family];
        for _ in 0..100 {
            let node =
                (dice.between(0.0, paving.nodes.len() as f64) as u32).min(paving.nodes.len() as u32 - 1);
            let x = pose_in(paving, node, &mut dice);
            check_box(robot, &paving.nodes[node as usize], paving, &x, seen);
        }
    }
    // Of every family the test has seen boxes inside, outside with the mode existing, closed, and out of reach.
    assert!(seen.iter().flatten().all(|&n| n >= 20), "{seen:?}");
}

/// The same of slices, one or two coordinates being held anywhere in the window.
#[test]
fn certificates_hold_in_slices() {
    let mut seen = [[0usize; 4]; FAMILIES];
    for (family, robot, rest) in robots() {
        let mut dice = Dice(rest.iter());
        let Ok(window) = robot.workspace_window() else { continue };
        let first = dice.between(0.0, robot.dof() as f64) as usize;
        let mut held = BTreeSet::from([first]);
        if robot.dof() == 3 && dice.chance(0.3) {
            held.insert((first + 1) % 3);
        }
        let value = |k: usize, dice: &mut Dice| dice.between(window.ranges[k].0, window.ranges[k].1);
        let fix: Vec<_> = held.iter().map(|&k| (k, value(k, &mut dice))).collect();
        let Some(analysis) = analyzed_slice(&robot, fix.clone()) else { continue };
        let paving = &analysis.pavings[0];
        assert_eq!(paving.axes.len() + held.len(), robot.dof());
        for _ in 0..100 {
            let node =
                (dice.between(0.0, paving.nodes.len() as f64) as u32).min(paving.nodes.len() as u32 - 1);
            let x = pose_in(paving, node, &mut dice);
            assert!(fix.iter().all(|&(k, value)| x[k] == value), "{x:?} {fix:?}");
            check_box(&robot, &paving.nodes[node as usize], paving, &x, &mut seen[family]);
        }
    }
    assert!(seen.iter().flatten().all(|&n| n >= 20), "{seen:?}");
}

fn check_box(robot: &Robot, node: &Node, paving: &Paving, x: &[f64], seen: &mut [usize; 4]) {
    for (class, mode, sign) in classes(paving) {
        let told = || format!("{mode} {sign} at {x:?}, {node:?} of {robot:?}");
        let (least, _) = recomputed(robot, mode, x);
        let is_member = member(robot, mode, sign, x);
        match node.of_classes(1 << class) {
            Mark::Inside => {
                seen[0] += 1;
                assert_ne!(is_member, Some(false), "{}", told());
            }
            Mark::Outside => {
                seen[1] += usize::from(least > NOISE);
                assert_ne!(is_member, Some(true), "{}", told());
            }
            Mark::Open => {}
        }
        match node.of_mode(class / 2) {
            Mark::Inside => {
                seen[2] += 1;
                assert!(least > -NOISE, "{least}: {}", told());
            }
            Mark::Outside => {
                seen[3] += 1;
                assert!(least < NOISE, "{least}: {}", told());
            }
            Mark::Open => {}
        }
    }
}

/// Where `locate` puts a pose it is; the aspect's bounds in W and Q hold it.
#[test]
fn located_poses_are_where_they_are_said_to_be() {
    let mut seen = [0usize; 2];
    for (_, analysis, rest) in &*ANALYSED {
        let robot = &analysis.robot;
        let mut dice = Dice(rest.iter());
        for _ in 0..100 {
            let x = pose_in(&analysis.pavings[0], 0, &mut dice);
            for (class, mode, sign) in classes(&analysis.pavings[0]) {
                let is_member = member(robot, mode, sign, &x);
                match analysis.locate(&x, ClassId::new(class)) {
                    Place::Inside(id) => {
                        seen[0] += 1;
                        assert_ne!(is_member, Some(false), "{mode} {sign} {x:?} {robot:?}");
                        assert_eq!(
                            (analysis.classes[class].mode, analysis.classes[class].det_a),
                            (mode, sign)
                        );
                        check_bounds(analysis, class, id, &x);
                    }
                    Place::Outside => {
                        seen[1] += 1;
                        assert_ne!(is_member, Some(true), "{mode} {sign} {x:?} {robot:?}");
                    }
                    Place::Undecided => {}
                }
            }
        }
    }
    assert!(seen.iter().all(|&n| n > 1000), "{seen:?}");
}

fn check_bounds(analysis: &Analysis, class: usize, id: AspectId, x: &[f64]) {
    let class = &analysis.classes[class];
    let aspect = class.aspects.iter().find(|a| a.id == id).expect("an aspect of the class");
    let within = |(lo, hi): (f64, f64), v: f64, angle: bool| {
        let slack = 1e-6;
        let hold = |v: f64| lo - slack <= v && v <= hi + slack;
        hold(v) || angle && (hold(v + TAU) || hold(v - TAU))
    };
    for (k, &v) in x.iter().enumerate() {
        assert!(within(aspect.w_bounds[k], v, analysis.window.glued[k]), "{x:?} {:?}", aspect.w_bounds);
    }
    let q = analysis.robot.inverse_in(x, class.mode).unwrap().unwrap();
    for (k, &v) in q.iter().enumerate() {
        let angle = analysis.robot.legs[k].actuator.is_angle();
        assert!(within(aspect.q_bounds[k], v, angle), "q {q:?} of {x:?} not in {:?}", aspect.q_bounds);
    }
}

/// Segments: inside means every sample is, outside that the stretch has a sample that fails (or one within noise of it).
#[test]
fn segments_are_what_is_claimed() {
    let mut seen = [0usize; 3];
    for (_, mut robot, rest) in robots() {
        robot.window.fill(None);
        let mut dice = Dice(rest.iter());
        for _ in 0..4 {
            let start: Vec<f64> = robot
                .platform
                .coordinates()
                .iter()
                .map(|c| {
                    let size = if c.angle { PI } else { 6.0 };
                    dice.between(-size, size)
                })
                .collect();
            // Angles run over ±π on the way.
            let size = dice.between(0.05, 2.0);
            let end: Vec<f64> = start.iter().map(|x| x + dice.between(-size, size)).collect();
            for (_, mode, sign) in robot
                .working_modes()
                .into_iter()
                .flat_map(|m| [(0, m, DetSign::Positive), (0, m, DetSign::Negative)])
            {
                let at =
                    |t: f64| -> Vec<f64> { start.iter().zip(&end).map(|(a, b)| a + t * (b - a)).collect() };
                let told = |t: f64| format!("{mode} {sign} t = {t} from {start:?} to {end:?} of {robot:?}");
                match along(&robot, &Demand::class(mode, sign.factor()), &Curve::segment(&start, &end), 3000)
                {
                    Along::Inside => {
                        seen[0] += 1;
                        for t in (0..=400).map(|i| f64::from(i) / 400.0) {
                            assert_ne!(member(&robot, mode, sign, &at(t)), Some(false), "{}", told(t));
                        }
                    }
                    Along::Outside { from, to, .. } => {
                        seen[1] += 1;
                        assert!(0.0 <= from && from < to && to <= 1.0);
                        let fails = |i: u32| {
                            let t = from + (to - from) * f64::from(i) / 64.0;
                            member(&robot, mode, sign, &at(t)) != Some(true)
                        };
                        assert!((0..=64).any(fails), "{}", told(from));
                        // Up to there all is well or in doubt, so a sample that clearly fails is not passed over.
                        let before = (0..=64).map(|i| from * f64::from(i) / 64.0);
                        for t in before.filter(|t| *t < from - 1e-9) {
                            assert_ne!(member(&robot, mode, sign, &at(t)), Some(false), "{}", told(t));
                        }
                    }
                    Along::Crossed { .. } => panic!("no leg was to cross"),
                    Along::Undecided { .. } => seen[2] += 1,
                }
            }
        }
    }
    assert!(seen[0] > 30 && seen[1] > 300 && 20 * seen[2] < seen[1], "{seen:?}");
}

/// The first strut just clears its least length half-way, too narrowly for intervals to tell; the second then falls below
/// its own. The failure that is proved is the second's.
#[test]
fn the_constraint_named_is_the_one_that_fails() {
    let mut legs = vec![Leg::strut([0.0, 0.0], [0.0, 0.0]), Leg::strut([9.0, 0.0], [0.0, 0.0])];
    let at_least = |min: f64| Limit::ActuatorLength { min: Interval::point(min), max: Interval::point(50.0) };
    legs[0].limits.push(at_least(3f64.next_down()));
    legs[1].limits.push(at_least(5.0));
    let robot = Robot::new("two struts", Platform::PlanePoint, legs).unwrap();
    let mode = "--".parse().unwrap();
    let decide = |end: f64, sign| {
        along(&robot, &Demand::class(mode, sign), &Curve::segment(&[-5.0, 3.0], &[end, 3.0]), 100_000)
    };
    let sign = robot.jacobians(&[-5.0, 3.0], &[34f64.sqrt(), 205f64.sqrt()]).unwrap().det_a().signum() as i8;
    let Along::Undecided { constraint, .. } = decide(4.0, sign) else { panic!("{:?}", decide(4.0, sign)) };
    assert_eq!(constraint, Constraint::Limit(LegIndex::new(0), 0));
    let Along::Outside { constraint, from, to } = decide(7.0, sign) else {
        panic!("{:?}", decide(7.0, sign))
    };
    // x = 5 is t = 10/12.
    assert_eq!(constraint, Constraint::Limit(LegIndex::new(1), 0));
    assert!(from <= 10.0 / 12.0 && 10.0 / 12.0 < to, "{from} {to}");
    // Well clear of the first limit nothing is in doubt before the failure.
    let Along::Outside { from, to, .. } =
        along(&robot, &Demand::class(mode, sign), &Curve::segment(&[1.0, 3.0], &[7.0, 3.0]), 100_000)
    else {
        panic!()
    };
    assert!(from <= 4.0 / 6.0 && 4.0 / 6.0 < to && to - from < 1e-11, "{from} {to}");
}

// The tree.

fn paved(robot: &Robot, depth: u32) -> Paving {
    paved_slice(robot, depth, &[])
}

fn paved_slice(robot: &Robot, depth: u32, fix: &[(usize, f64)]) -> Paving {
    let window = robot.slice(fix).unwrap();
    Paving::new(robot, &window, &robot.working_modes(), &to_depth(depth), &Control::unwatched())
}

/// Range of a box per axis in units of the finest cells.
fn cells(paving: &Paving, node: u32) -> Vec<(u64, u64)> {
    let size = 1u64 << (paving.depth - paving.depth_of(node));
    let corner = paving.nodes[node as usize].corner;
    corner[..paving.axes.len()].iter().map(|&c| (u64::from(c) * size, (u64::from(c) + 1) * size)).collect()
}

/// Whether two closed boxes share a point, by arithmetic on their corners.
fn share_a_point(paving: &Paving, a: &[(u64, u64)], b: &[(u64, u64)]) -> bool {
    let whole = 1u64 << paving.depth;
    let axes = paving.window.axes();
    (0..paving.axes.len()).all(|k| {
        let meet = |shift: i64| {
            let (lo, hi) = (b[k].0 as i64 + shift, b[k].1 as i64 + shift);
            a[k].0 as i64 <= hi && lo <= a[k].1 as i64
        };
        meet(0) || paving.window.glued[axes[k]] && (meet(whole as i64) || meet(-(whole as i64)))
    })
}

fn check_adjacency(paving: &Paving, sight: &impl Fn(&Node) -> Mark) -> usize {
    let mut boxes = Vec::new();
    paving.boxes_of(sight, &mut |at| boxes.push(at));
    let extents: Vec<_> = boxes.iter().map(|&at| cells(paving, at)).collect();
    let mut expected = BTreeSet::new();
    for i in 0..boxes.len() {
        for j in 0..i {
            if share_a_point(paving, &extents[i], &extents[j]) {
                expected.insert((boxes[i].min(boxes[j]), boxes[i].max(boxes[j])));
            }
        }
    }
    let mut visited = BTreeSet::new();
    // A box that spans a glued coordinate touches itself across it.
    paving.touching(sight, &mut |a, b| {
        if a != b {
            visited.insert((a.min(b), a.max(b)));
        }
    });
    assert!(visited == expected, "{} visited, {} expected", visited.len(), expected.len());
    expected.len()
}

/// `touching` finds the pairs that brute force over all pairs finds, for every class, mode and union of classes.
#[test]
fn touching_boxes_are_those_that_share_a_point() {
    let mut pairs = 0;
    for (name, depth) in
        [("five-bar", 5), ("2-prr", 5), ("3-rrr", 3), ("3-rpr", 3), ("delta", 3), ("spherical-3-rrr", 3)]
    {
        let paving = paved(&catalogue::find(name).unwrap(), depth);
        for m in 0..paving.modes.len().min(3) {
            pairs += check_adjacency(&paving, &|node| node.of_classes(1 << (2 * m)));
            pairs += check_adjacency(&paving, &|node| node.of_mode(m));
        }
        pairs += check_adjacency(&paving, &|node| node.of_classes(0xAAAA));
    }
    assert!(pairs > 10_000, "{pairs}");
}

/// The same in one and two dimensions, with none, one or both of them glued.
#[test]
fn touching_boxes_of_slices_are_those_that_share_a_point() {
    for (name, depth, fix) in [
        ("five-bar", 8, vec![(1, 2.0)]),
        ("3-rrr", 5, vec![(2, 0.3)]),
        ("3-rrr", 5, vec![(0, -5.0)]),
        ("3-rrr", 8, vec![(0, -5.0), (1, -5.0)]),
        ("3-rpr", 7, vec![(0, 9.0), (2, 0.3)]),
        ("spherical-3-rrr", 4, vec![(1, 0.3)]),
        ("spherical-3-rrr", 4, vec![(0, 0.3)]),
        ("delta", 4, vec![(2, -900.0)]),
    ] {
        let paving = paved_slice(&catalogue::find(name).unwrap(), depth, &fix);
        let mut pairs = 0;
        for m in 0..paving.modes.len().min(3) {
            pairs += check_adjacency(&paving, &|node| node.of_classes(1 << (2 * m)));
            pairs += check_adjacency(&paving, &|node| node.of_mode(m));
        }
        assert!(pairs > 10, "{name} {fix:?}: {pairs}");
    }
}

/// The boxes of a set and the boxes outside it fill the window without gap or overlap.
#[test]
fn boxes_tile_the_window() {
    fn outside(
        paving: &Paving,
        at: u32,
        sight: &impl Fn(&Node) -> Mark,
        sum: &mut u64,
        volume: &impl Fn(u32) -> u64,
    ) {
        match sight(&paving.nodes[at as usize]) {
            Mark::Outside => *sum += volume(at),
            Mark::Open => paving.children(at).for_each(|c| outside(paving, c, sight, sum, volume)),
            Mark::Inside => {}
        }
    }
    for (name, depth) in [("five-bar", 7), ("3-rpr", 4), ("3-rrr", 4), ("spherical-3-rrr", 4)] {
        let paving = paved(&catalogue::find(name).unwrap(), depth);
        let volume = |at: u32| 1u64 << (paving.axes.len() as u32 * (paving.depth - paving.depth_of(at)));
        let whole: f64 = paving
            .window
            .axes()
            .iter()
            .map(|&k| paving.window.ranges[k].1 - paving.window.ranges[k].0)
            .product();
        for class in 0..2 * paving.modes.len() {
            let sight = |node: &Node| node.of_classes(1 << class);
            let (mut sum, mut measure) = (0, 0.0);
            paving.boxes_of(&sight, &mut |at| {
                sum += volume(at);
                let (lo, hi) = paving.bounds(at);
                let product: f64 = (0..paving.axes.len()).map(|a| hi[a] - lo[a]).product();
                assert!((product / paving.measure(paving.depth_of(at)) - 1.0).abs() < 1e-9);
                measure += product;
            });
            let covered = sum;
            outside(&paving, 0, &sight, &mut sum, &volume);
            assert_eq!(sum, volume(0));
            assert!((measure / whole - covered as f64 / volume(0) as f64).abs() < 1e-9);
        }
    }
}

// Budgets.

#[test]
fn a_box_budget_is_kept() {
    let robot = catalogue::find("3-rrr").unwrap();
    let window = robot.workspace_window().unwrap();
    for boxes in [0, 7, 8, 100, 1000, 5000] {
        let budget = Budget { boxes: Some(boxes), ..Budget::default() };
        let paving = Paving::new(&robot, &window, &robot.working_modes(), &budget, &Control::unwatched());
        assert!(paving.boxes <= boxes && paving.stop == Stop::Boxes);
        // Nothing is wasted: what is left does not pay for one more parent.
        assert!(boxes - paving.boxes < 8);
        assert_eq!(paving.boxes as usize, paving.nodes.len() - 1);
    }
}

#[test]
fn depth_and_resolution_are_honoured() {
    let robot = catalogue::find("five-bar").unwrap();
    let run =
        |budget| analyze(&robot, &Options { budget, ..Options::default() }, &Control::unwatched()).unwrap();
    let analysis = run(to_depth(6));
    assert_eq!((analysis.run.depth, analysis.run.stop), (6, Stop::Resolution));
    let analysis = run(Budget { resolution: Some(0.5), ..Budget::default() });
    let finest = analysis.run.resolution.iter().fold(0.0, |a: f64, &b| a.max(b));
    assert!(finest <= 0.5 && finest > 0.25, "{finest}");
    // Whatever is met first ends it.
    let both =
        |depth| run(Budget { resolution: Some(0.5), depth: Some(depth), ..Budget::default() }).run.depth;
    assert_eq!(both(3), 3);
    assert_eq!(both(9), analysis.run.depth);
}

/// A resolution is in length units: it says nothing of a robot that only turns.
#[test]
fn a_resolution_does_not_stop_a_robot_without_lengths() {
    let robot = catalogue::find("spherical-3-rrr").unwrap();
    let window = robot.workspace_window().unwrap();
    let budget = Budget { resolution: Some(0.1), boxes: Some(2000), ..Budget::default() };
    let paving = Paving::new(&robot, &window, &robot.working_modes(), &budget, &Control::unwatched());
    assert_eq!(paving.stop, Stop::Boxes);
}

#[test]
fn a_cancelled_run_is_sound() {
    let cancelled = AtomicBool::new(true);
    let control = Control { cancelled: &cancelled, progress: &|_| () };
    for name in ["five-bar", "3-rpr"] {
        let robot = catalogue::find(name).unwrap();
        let analysis = analyze(&robot, &Options::default(), &control).unwrap();
        assert_eq!((analysis.run.stop, analysis.run.boxes, analysis.run.depth), (Stop::Cancelled, 0, 0));
        assert_eq!((analysis.aspects.low, analysis.aspects.high), (0, None));
        assert!(analysis.classes.iter().all(|c| c.measure == 0.0 && c.undecided > 0.0));
        assert_eq!(analysis.locate(&[1.0; 3][..robot.dof()], ClassId::new(0)), Place::Undecided);
    }
}

/// Cancelled half-way, the tree is whole: every node has all its children or none, and certificates hold.
#[test]
fn a_run_cancelled_half_way_is_sound() {
    let cancelled = AtomicBool::new(false);
    let progress = |p: aspecta::paving::Progress| {
        if p.stage == "paving" && p.done == 6 {
            cancelled.store(true, std::sync::atomic::Ordering::Relaxed);
        }
    };
    let control = Control { cancelled: &cancelled, progress: &progress };
    let robot = catalogue::find("five-bar").unwrap();
    let window = robot.workspace_window().unwrap();
    let paving = Paving::new(&robot, &window, &robot.working_modes(), &to_depth(9), &control);
    assert_eq!((paving.stop, paving.depth), (Stop::Cancelled, 6));
    assert_eq!(paving.nodes.len() as u64 - 1, paving.boxes);
    let mut unseen = [0; 4];
    for (i, at) in (0..paving.nodes.len() as u32).enumerate() {
        let dice: Vec<f64> = (0..4).map(|k| ((i * 4 + k) as f64 * 0.618_034) % 1.0).collect();
        let x = pose_in(&paving, at, &mut Dice(dice.iter()));
        check_box(&robot, &paving.nodes[at as usize], &paving, &x, &mut unseen);
    }
}

/// However deep the boxes are: 2^78 of them fill a window in space.
#[test]
fn the_smallest_boxes_have_a_measure() {
    let robot = catalogue::find("spherical-3-rrr").unwrap();
    let window = robot.slice(&[]).unwrap();
    let whole: f64 = window.ranges.iter().map(|r| r.1 - r.0).product();
    let paving = Paving::blank(&robot, Chart::Pose, window, &robot.working_modes());
    for depth in 0..=26 {
        let parts = 8f64.powi(depth as i32);
        assert!((paving.measure(depth) * parts / whole - 1.0).abs() < 1e-12, "{depth}");
    }
}
