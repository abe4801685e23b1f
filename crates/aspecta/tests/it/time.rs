//! Motions under joint limits: closed forms, and limits that hold at every time.

use crate::random::Random;
use aspecta::Kinematics;
use aspecta::motion::time::{JointLimits, Limited, Piece, TimeError, Trajectory, Waypoint, trajectory};
use aspecta::motion::{Joined, PathOptions, check_poses};
use aspecta::robot::{LegIndex, catalogue};

fn piece(samples: impl IntoIterator<Item = Vec<f64>>) -> Piece {
    let mode = "++".parse().unwrap();
    Piece { samples: samples.into_iter().map(|q| Waypoint { pose: q.clone(), q, mode }).collect() }
}

fn limits(speed: &[f64], acceleration: &[f64]) -> JointLimits {
    JointLimits { speed: speed.to_vec(), acceleration: acceleration.to_vec() }
}

/// A smooth curve through joint space.
fn wave(random: &mut Random) -> Piece {
    let waves: Vec<[f64; 4]> =
        (0..2).map(|_| [1.0, 3.0, 1.0, 6.0].map(|size| random.within(-size, size))).collect();
    let joint = |[a, b, c, d]: &[f64; 4], t: f64| a * (b * t).sin() + c * t + 0.05 * (d * t).cos();
    piece((0..=300).map(|i| waves.iter().map(|w| joint(w, f64::from(i) / 150.0)).collect()))
}

/// The limits hold on a grid much finer than that of the computation, positions are the integrals of speeds, and these of accelerations.
fn holds(motion: &Trajectory, limits: &JointLimits) {
    let total = motion.total_time();
    let count = 40_000;
    let h = total / f64::from(count);
    let mut before = motion.at(0.0);
    for i in 0..=count {
        let row = motion.at(total * f64::from(i) / f64::from(count));
        for j in 0..limits.speed.len() {
            let (v, a) =
                (row.velocity[j].abs() / limits.speed[j], row.acceleration[j].abs() / limits.acceleration[j]);
            assert!(v <= 1.0 + 1e-6 && a <= 1.0 + 1e-6, "joint {j} at {}: {v}, {a}", row.time);
            let moved = 0.5 * h * (row.velocity[j] + before.velocity[j]);
            let gap = (row.q[j] - before.q[j] - moved).abs();
            assert!(gap <= h * h * limits.acceleration[j], "joint {j} at {}: {gap}", row.time);
            let jump = (row.velocity[j] - before.velocity[j]).abs();
            assert!(jump <= h * limits.acceleration[j] * 1.001, "joint {j} at {}: {jump}", row.time);
        }
        before = row;
    }
}

/// A straight line: a trapezoid of speed, or a triangle where it is too short.
#[test]
fn straight_lines_have_the_closed_form() {
    for (way, v, a) in [(2.0, 1.0, 4.0), (2.0, 10.0, 4.0), (0.3, 0.2, 0.1)] {
        // Joint 2 has a third of the way to go at the same limits: joint 1 decides.
        let line = piece([vec![0.5, 1.0], vec![0.5 + way, 1.0 - way / 3.0]]);
        let limits = limits(&[v, v], &[a, a]);
        let motion = trajectory(std::slice::from_ref(&line), &limits).unwrap();
        let expected = if way * a >= v * v { way / v + v / a } else { 2.0 * (way / a).sqrt() };
        let total = motion.total_time();
        assert!(
            (total / expected - 1.0).abs() < 1e-5 && total >= expected * (1.0 - 1e-9),
            "{total} {expected}"
        );
        holds(&motion, &limits);
        let (first, last) = (motion.at(0.0), motion.at(total));
        assert!(first.velocity.iter().chain(&last.velocity).all(|v| v.abs() < 1e-9));
        assert!((last.q[0] - 0.5 - way).abs() < 1e-12 && (last.q[1] - 1.0 + way / 3.0).abs() < 1e-12);
        let binding = motion.bindings();
        assert!(binding.iter().all(|b| b.joint == LegIndex::new(0)), "{binding:?}");
        let cruising = binding.iter().find(|b| b.limit == Limited::Speed).map_or(0.0, |b| b.share);
        let trapezoid = if way * a >= v * v { 1.0 - 2.0 * v / a / expected } else { 0.0 };
        assert!((cruising - trapezoid).abs() < 2e-2, "{cruising} {trapezoid}");
    }
}

#[test]
fn curves_keep_the_limits_and_time_scales() {
    let random = &mut Random(5);
    for _ in 0..20 {
        let curve = wave(random);
        let limit =
            limits(&[random.within(0.2, 3.0), 1.0], &[random.within(0.5, 9.0), random.within(0.5, 9.0)]);
        let motion = trajectory(std::slice::from_ref(&curve), &limit).unwrap();
        holds(&motion, &limit);
        let total = motion.total_time();
        // Some limit binds nearly always, or the motion would not be the fastest.
        let bound: f64 = motion.bindings().iter().map(|b| b.share).sum();
        assert!(bound > 0.9, "{bound}");
        // Backwards it takes as long.
        let mut back = curve.clone();
        back.samples.reverse();
        let reversed = trajectory(&[back], &limit).unwrap().total_time();
        assert!((reversed / total - 1.0).abs() < 1e-3, "{total} {reversed}");
        // Twice as fast, four times the acceleration: half the time.
        let twice = limits(
            &limit.speed.iter().map(|v| 2.0 * v).collect::<Vec<_>>(),
            &limit.acceleration.iter().map(|a| 4.0 * a).collect::<Vec<_>>(),
        );
        let half = trajectory(std::slice::from_ref(&curve), &twice).unwrap().total_time();
        assert!((2.0 * half / total - 1.0).abs() < 1e-9);
        assert!(motion.path_error().iter().all(|e| *e < 1e-6), "{:?}", motion.path_error());
    }
}

/// A circle at constant speed needs the acceleration v²/r: the fastest motion cruises at √(a r), where the limits of both joints share the work.
#[test]
fn curvature_limits_speed() {
    let circle = piece((0..=400).map(|i| {
        let t = f64::from(i) / 400.0 * std::f64::consts::TAU;
        vec![t.cos(), t.sin()]
    }));
    let limit = limits(&[100.0, 100.0], &[1.0, 1.0]);
    let motion = trajectory(&[circle], &limit).unwrap();
    holds(&motion, &limit);
    let fastest = motion.rows(200.0).map(|r| r.velocity[0].hypot(r.velocity[1])).fold(0.0, f64::max);
    // No faster than the acceleration √2 that both joints have together allows.
    assert!(fastest > 0.95 && fastest < 2f64.sqrt().sqrt() + 1e-6, "{fastest}");
}

/// The robot rests where pieces meet, and their times add up.
#[test]
fn it_stops_at_corners() {
    let corner = vec![1.0, 0.0];
    let pieces = [piece([vec![0.0, 0.0], corner.clone()]), piece([corner, vec![1.0, 2.0]])];
    let limit = limits(&[1.0, 1.0], &[1.0, 1.0]);
    let motion = trajectory(&pieces, &limit).unwrap();
    assert!((motion.total_time() - 2.0 - 3.0).abs() < 1e-4);
    let row = motion.at(2.0);
    assert!(row.velocity.iter().all(|v| v.abs() < 2e-3) && (row.q[0] - 1.0).abs() < 1e-5, "{row:?}");
    holds(&motion, &limit);
    let rows: Vec<_> = motion.rows(10.0).collect();
    assert!(rows.len() == 52 || rows.len() == 51, "{}", rows.len());
    assert_eq!(rows.last().unwrap().time, motion.total_time());
}

/// Joints, poses and modes of a checked path belong together at every time.
#[test]
fn poses_and_joints_belong_together() {
    let robot = catalogue::find("3-rrr").unwrap();
    let poses =
        [[-15.468, 0.781, 0.073], [-15.468, -7.091, 0.500], [-9.902, -7.091, 1.081]].map(|p| p.to_vec());
    for (joined, pieces) in [(Joined::Straight, 2), (Joined::Spline, 1)] {
        let options = PathOptions { joined, ..PathOptions::default() };
        let check = check_poses(&robot, &poses, "+++".parse().unwrap(), &options).unwrap();
        assert!(check.is_sound() && check.pieces().len() == pieces);
        let limit = limits(&[1.0; 3], &[4.0; 3]);
        let motion = trajectory(&check.pieces(), &limit).unwrap();
        holds(&motion, &limit);
        for row in motion.rows(50.0) {
            let residual = robot.state(&row.pose, &row.q).unwrap().residual;
            assert!(residual < 1e-6, "{residual} at {}", row.time);
        }
    }
}

#[test]
fn what_cannot_be_timed_is_refused() {
    let line = piece([vec![0.0, 0.0], vec![1.0, 1.0]]);
    let refused = |pieces: &[Piece], limit: JointLimits| trajectory(pieces, &limit).unwrap_err();
    let one = std::slice::from_ref(&line);
    let few = TimeError::Count { what: "speed", wanted: 2, found: 1 };
    assert_eq!(few.to_string(), "1 limit of speed given, but there are 2 joints");
    assert_eq!(refused(one, limits(&[1.0], &[1.0, 1.0])), few);
    let zero = TimeError::Limit { what: "acceleration", joint: 2, value: 0.0 };
    assert_eq!(refused(one, limits(&[1.0, 1.0], &[1.0, 0.0])), zero);
    let both = limits(&[1.0, 1.0], &[1.0, 1.0]);
    assert_eq!(refused(&[line.clone(), line.clone()], both.clone()), TimeError::Gap { piece: 2 });
    assert_eq!(refused(&[piece([vec![1.0, 2.0], vec![1.0, 2.0]])], both), TimeError::NoMotion);
}
