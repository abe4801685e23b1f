//! What a file without mistakes means.

use super::*;
use aspecta::Kinematics;
use aspecta::num::Interval;
use aspecta::robot::Limit;

const SCHEMA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/robot.schema.json");

#[test]
fn spatial_frames() {
    let robot = Robot::from_toml(SPACE, "t").unwrap();
    let exact = |rows: [[f64; 3]; 3]| rows.map(|r| r.map(Interval::point));
    assert_eq!(robot.legs[0].frame, exact([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]));
    assert_eq!(robot.legs[1].frame[0], exact([[0.0, 1.0, 0.0]; 3])[0]);
    assert_eq!(robot.legs[0].attachment, [Interval::point(0.0); 3]);
}

/// Limits keep their meaning: each is checked against the joint it limits, over the whole range of the joint.
#[test]
fn limits_cut_where_they_say() {
    let limit = |l: &str| PLANE.replacen("rod = 5 }", &format!("rod = 5 }}\nlimits = {{ {l} }}"), 1);
    type Joint = fn(&[f64], &[f64]) -> f64;
    let q: Joint = |_, q| q[0];
    let rod: Joint = |x, q| (x[1] - 8.0 * q[0].sin()).atan2(x[0] - 8.0 * q[0].cos());
    let elbow: Joint = |x, q| {
        let (r, c) = ((x[1] - 8.0 * q[0].sin(), x[0] - 8.0 * q[0].cos()), q[0]);
        (c.cos() * r.0 - c.sin() * r.1).atan2(c.cos() * r.1 + c.sin() * r.0)
    };
    let cases: [(&str, f64, f64, Joint); 6] = [
        ("actuator = { deg = [-20, 100] }", -20.0, 100.0, q),
        ("actuator = { deg = [100, 340] }", 100.0, 340.0, q),
        ("actuator = { rad = [0.5, 1.25] }", 0.5f64.to_degrees(), 1.25f64.to_degrees(), q),
        ("elbow = { deg = [5, 175] }", 5.0, 175.0, elbow),
        ("base-joint = { deg = [-60, 30] }", -60.0, 30.0, rod),
        ("platform-joint = { deg = [170, 200] }", 170.0, 200.0, rod),
    ];
    for (text, min, max, joint) in cases {
        let robot = Robot::from_toml(&limit(text), "t").unwrap_or_else(|e| panic!("{e}"));
        let mut seen = [0, 0];
        for k in 0..4000 {
            let x = [-3.0 + 16.0 * f64::from(k % 63) / 63.0, -12.5 + 25.0 * f64::from(k / 63) / 63.0];
            for s in robot.inverse(&x).unwrap() {
                let angle = joint(&x, &s.q).to_degrees();
                let inside = (angle - min).rem_euclid(360.0) < max - min;
                assert_eq!(s.within_limits, inside, "{text}: {angle}");
                seen[usize::from(inside)] += 1;
            }
        }
        assert!(seen.iter().all(|&n| n > 20), "{text}: {seen:?}");
    }
}

/// Cones in space, on a leg whose own frame is turned, and the elbow's range.
#[test]
fn spatial_limits_cut_where_they_say() {
    let delta = include_str!("../../../../../robots/delta.toml");
    let limited = |l: &str| {
        let text =
            delta.replacen("zero = [0, -1, 0] }", &format!("zero = [0, -1, 0] }}\nlimits = {{ {l} }}"), 1);
        Robot::from_toml(&text, "t").unwrap_or_else(|e| panic!("{e}"))
    };
    let cosine = |a: [f64; 3], b: [f64; 3]| {
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        dot(a, b) / (dot(a, a) * dot(b, b)).sqrt()
    };
    let cone = limited("base-joint = { axis = [1, -1, -3], within = { deg = 40 } }");
    let platform = limited("platform-joint = { axis = [1, -1, -3], within = { deg = 40 } }");
    let elbow = limited("elbow = { deg = [30, 90] }");
    let mut seen = [[0; 2]; 2];
    for k in 0..1000_i32 {
        let x = [
            f64::from(k % 10 - 5) * 150.0,
            f64::from(k / 10 % 10 - 5) * 150.0,
            -1500.0 + f64::from(k / 100) * 120.0,
        ];
        for ((a, b), c) in cone
            .inverse(&x)
            .unwrap()
            .iter()
            .zip(platform.inverse(&x).unwrap())
            .zip(elbow.inverse(&x).unwrap())
        {
            let crank = [0.0, -524.0 * a.q[0].cos(), -524.0 * a.q[0].sin()];
            let rod = [x[0] - crank[0], x[1] - 44.0 + 164.0 - crank[1], x[2] - crank[2]];
            let in_cone = cosine(rod, [1.0, -1.0, -3.0]) > 40f64.to_radians().cos();
            assert_eq!((a.within_limits, b.within_limits), (in_cone, in_cone), "{x:?}");
            let bend = cosine(rod, crank).acos().to_degrees();
            assert_eq!(c.within_limits, 30.0 < bend && bend < 90.0, "{x:?} {bend}");
            seen[0][usize::from(in_cone)] += 1;
            seen[1][usize::from(c.within_limits)] += 1;
        }
    }
    assert!(seen.iter().flatten().all(|&n| n > 50), "{seen:?}");
    assert!(matches!(elbow.legs[0].limits[..], [Limit::SpatialElbow { .. }]));
}

#[test]
fn a_window_in_degrees_is_kept_in_radians() {
    let text = include_str!("../../../../../robots/3-rrr.toml").replacen(
        "[[legs]]",
        "[window]\nx = [-10, 5.5]\nphi = { deg = [-60, 60] }\n\n[[legs]]",
        1,
    );
    let robot = Robot::from_toml(&text, "t").unwrap();
    assert_eq!(robot.window[0], Some((-10.0, 5.5)));
    assert_eq!(robot.window[1], None);
    let (lo, hi) = robot.window[2].unwrap();
    let third = std::f64::consts::FRAC_PI_3;
    assert!(lo <= -third && -third - lo < 1e-15 && hi >= third && hi - third < 1e-15);
}

/// Regenerate with `UPDATE_SCHEMA=1 cargo test -p aspecta schema`.
#[test]
fn the_published_schema_is_that_of_the_code() {
    let schema = serde_json::to_string_pretty(&Robot::file_schema()).unwrap() + "\n";
    if std::env::var_os("UPDATE_SCHEMA").is_some() {
        std::fs::write(SCHEMA, &schema).unwrap();
    }
    let published = std::fs::read_to_string(SCHEMA).unwrap_or_default();
    assert!(schema == published, "robots/robot.schema.json is out of date: run with UPDATE_SCHEMA=1");
}

/// The documentation's examples are robots.
#[test]
fn the_examples_of_the_documentation_load() {
    let text = include_str!("../../../../../docs/robot-files.md");
    let mut examples = 0;
    for block in text.split("```toml\n").skip(1) {
        let block = &block[..block.find("```").unwrap()];
        if block.contains("name =") {
            Robot::from_toml(block, "docs/robot-files.md").unwrap_or_else(|e| panic!("{e}"));
            examples += 1;
        }
    }
    assert!(examples >= 2, "{examples}");
}
