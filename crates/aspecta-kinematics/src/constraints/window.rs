//! How far inside the user's window a placement is. The window bounds no aspect of the robot, but the paths
//! asked about.

use crate::placement::Placement;
use aspecta_robot::Robot;
use aspecta_robot::num::{Interval, Scalar};

/// Per coordinate that the user's window cuts, its index and a function that is > 0 strictly inside; angles
/// count by full turns.
pub(crate) fn window_margins<T: Scalar, const D: usize>(
    robot: &Robot,
    at: &Placement<T, D>,
) -> Vec<(usize, T)> {
    let cut = (0..robot.dof()).filter_map(|k| robot.window_range(k).map(|range| (k, range)));
    cut.map(|(k, range)| (k, margin(robot, at, k, range))).collect()
}

fn margin<T: Scalar, const D: usize>(
    robot: &Robot,
    at: &Placement<T, D>,
    k: usize,
    (low, high): (f64, f64),
) -> T {
    let [low, high] = [low, high].map(Interval::point);
    let between = |x: T, low: Interval, high: Interval| (x - T::constant(low)) * (T::constant(high) - x);
    let Some(r) = at.rotation().filter(|_| robot.platform.coordinates()[k].angle) else {
        return between(at.origin()[k], low, high);
    };
    // R = R_z(yaw) R_y(pitch) R_x(roll): its last row is (−sin pitch, cos pitch sin roll, cos pitch cos roll),
    // its first column (cos yaw cos pitch, sin yaw cos pitch, −sin pitch).
    let last = D - 1;
    let turned = |(sin, cos): (T, T)| {
        let half = Interval::point(0.5);
        let ((sin_m, cos_m), (_, cos_h)) = (((low + high) * half).sin_cos(), ((high - low) * half).sin_cos());
        cos.scale(cos_m) + sin.scale(sin_m) - (sin * sin + cos * cos).sqrt().scale(cos_h)
    };
    match robot.platform.turns() {
        Some([roll, ..]) if k == roll => turned((r[last][1], r[last][last])),
        Some([_, pitch, _]) if k == pitch => between(-r[last][0], low.sin_cos().0, high.sin_cos().0),
        _ => turned((r[1][0], r[0][0])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::for_platform;
    use aspecta_robot::catalogue;
    use aspecta_robot::num::Random;

    fn is_inside<const D: usize, const N: usize>(robot: &Robot, pose: &[f64]) -> bool {
        let margins = window_margins(robot, &Placement::<f64, D>::at(robot.platform, pose));
        margins.iter().all(|(_, margin)| *margin > 0.0)
    }

    /// Of placements and of poses, in whatever turns and beyond whatever poles, the same is said.
    #[test]
    fn placements_are_inside_where_poses_are() {
        let random = &mut Random::new(5);
        let mut inside = 0;
        for name in ["five-bar", "3-rrr", "irb-360", "spherical-3-rrr", "gough-stewart"] {
            let mut robot = catalogue::find(name).unwrap();
            let coordinates = robot.platform.coordinates();
            for _ in 0..2000 {
                for (k, c) in coordinates.iter().enumerate() {
                    let most = if c.periodic { 3.0 } else { 1.5 };
                    let [a, b] = [(); 2].map(|()| random.within((-most, most)));
                    robot.window[k] = (random.unit() < 0.5).then_some((a.min(b), a.max(b)));
                }
                let pose: Vec<f64> = coordinates
                    .iter()
                    .map(|c| random.within(if c.angle { (-7.0, 7.0) } else { (-1.5, 1.5) }))
                    .collect();
                let holds = robot.beyond_window(&pose).is_none();
                assert_eq!(
                    holds,
                    for_platform!(robot.platform, is_inside(&robot, &pose)),
                    "{robot:?} {pose:?}"
                );
                inside += usize::from(holds);
            }
        }
        assert!(inside > 1000, "{inside}");
    }
}
