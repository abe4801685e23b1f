//! Paths are checked everywhere between their samples: against closed forms and against brute force.

mod joints;
mod poses;

use crate::random::Random;
use aspecta::Kinematics;
use aspecta::kinematics::WorkingMode;
use aspecta::motion::{Joined, Least, PathCheck, PathOptions};
use aspecta::robot::{Robot, catalogue};

/// A robot of the catalogue.
pub fn robot(name: &str) -> Robot {
    catalogue::find(name).expect("a robot of the catalogue")
}

/// All of them, six-legged and spherical ones too.
pub fn robots() -> impl Iterator<Item = Robot> {
    catalogue::all().iter().map(|entry| robot(entry.name))
}

/// A working mode by its name.
pub fn mode(name: &str) -> WorkingMode {
    name.parse().unwrap()
}

/// Samples joined in this way, and nothing else asked.
pub fn options(joined: Joined) -> PathOptions {
    PathOptions { joined, ..PathOptions::default() }
}

/// A few samples round a random pose in reach, up to `size` apart (in the robot's lengths and in radians), and a mode.
pub fn samples(robot: &Robot, size: f64, count: usize, random: &mut Random) -> (Vec<Vec<f64>>, WorkingMode) {
    let window = robot.workspace_window().expect("a bounded robot");
    let length = robot.legs.iter().map(|l| l.actuator.size()).fold(robot.characteristic_length(), f64::max);
    loop {
        let pose: Vec<f64> = window.ranges.iter().map(|(lo, hi)| random.within(*lo, *hi)).collect();
        let solutions = robot.inverse(&pose).unwrap();
        if solutions.is_empty() {
            continue;
        }
        let mode = solutions[random.below(solutions.len())].mode;
        let coordinates = robot.platform.coordinates();
        let mut path = vec![pose];
        for k in 1..count {
            let next = path[k - 1]
                .iter()
                .zip(coordinates)
                .map(|(x, c)| x + random.within(-size, size) * if c.angle { 1.0 } else { length });
            path.push(next.collect());
        }
        return (path, mode);
    }
}

/// |det A|, |det Â| and the |B_jj| / max |B_jj| at each sample of a profile, computed again from its pose and joint vector.
pub fn measured(robot: &Robot, check: &PathCheck) -> Vec<Vec<f64>> {
    let at = |p: &aspecta::motion::ProfilePoint| {
        let state = robot.state(&p.pose, &p.q).unwrap();
        let mut all = vec![state.det_a.abs(), state.det_a.abs() / unit_of_det(robot, &state.a)];
        all.extend(state.serial_measures);
        all
    };
    check.profile.iter().map(at).collect()
}

/// det A over det Â, from the rows of A.
fn unit_of_det(robot: &Robot, a: &[Vec<f64>]) -> f64 {
    let coordinates = robot.platform.coordinates();
    let lengths = coordinates.iter().filter(|c| !c.angle).count();
    let length = if lengths == 0 { 1.0 } else { robot.characteristic_length() };
    let unit = |k: usize| if coordinates[k].angle { length } else { 1.0 };
    let norm =
        |row: &Vec<f64>| row.iter().enumerate().map(|(k, x)| (x / unit(k)).powi(2)).sum::<f64>().sqrt();
    a.iter().map(norm).product::<f64>() * length.powi((coordinates.len() - lengths) as i32)
}

/// The minima of a check, in the order of [`measured`].
pub fn minima(check: &PathCheck) -> Vec<&Least> {
    let clearance = check.clearance.as_ref().expect("a clearance");
    [&clearance.det_a, &clearance.parallel].into_iter().chain(&clearance.serial).collect()
}

/// No sample lies below the proved minima, these are close, and they are attained where it is said.
pub fn clearance_holds(robot: &Robot, check: &PathCheck, closeness: f64) {
    let sampled = measured(robot, check);
    for (k, least) in minima(check).into_iter().enumerate() {
        let low = sampled.iter().map(|m| m[k]).fold(f64::INFINITY, f64::min);
        // √ε of rounding near a serial singularity.
        let slack = 1e-7 * low.max(1e-2);
        assert!(least.at_least <= least.at_most && least.at_least >= 0.0, "{}: {least:?}", robot.name);
        assert!(low >= least.at_least - slack, "{}, {k}: {low} is below {least:?}", robot.name);
        assert!(
            least.at_most <= low * (1.0 + 2e-6) + slack,
            "{}, {k}: {low} is less than {least:?}",
            robot.name
        );
        assert!(
            least.at_most - least.at_least <= closeness * least.at_most + 1e-9,
            "{}, {k}: {least:?}",
            robot.name
        );
    }
}
