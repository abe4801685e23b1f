//! What is enclosed over boxes, where a robot reaches only part of them too.

use crate::obstacles::{LINKS, five_bar};
use aspecta::kinematics::chart::{Chart, Coordinates};
use aspecta::kinematics::constraints::{Configuration, Constraint, Kind};
use aspecta::kinematics::modal::{LegClosure, ModalRows};
use aspecta::kinematics::placement::Placement;
use aspecta::num::{Affine, LANES, Line, Random, Scalar, each};
use aspecta::robot::{Robot, catalogue};

/// The margins of all limits and det A in every mode, as the paving evaluates them.
fn functions<T: Scalar, const D: usize, const N: usize>(
    robot: &Robot,
    (placement, legs): &(Placement<T, D>, [LegClosure<T, D>; N]),
) -> Vec<T> {
    let heights: [[T; 2]; N] = std::array::from_fn(|j| legs[j].heights());
    let rows = ModalRows::new(robot, legs, &each!(|j| heights[j][0]));
    let limits: Vec<Constraint> = Constraint::of(robot).filter(|c| c.kind() == Kind::Limit).collect();
    let in_mode = |mode| {
        let at = Configuration { robot, placement, legs, heights: &heights, mode };
        let margins: Vec<T> = limits.iter().map(|&limit| at.margin(limit)).collect();
        margins.into_iter().chain([rows.det(mode)])
    };
    robot.working_modes().into_iter().flat_map(in_mode).collect()
}

/// Returns how many values were looked at, at poses drawn in boxes, and asserts that each lies where it is said to be.
fn seen<const D: usize, const N: usize>(robot: &Robot, random: &mut Random, boxes: usize) -> usize {
    let window = robot.slice(&[]).unwrap();
    let mut seen = 0;
    for _ in 0..boxes {
        let size = f64::powi(2.0, -(1 + random.below(9) as i32));
        let radius: [f64; N] =
            std::array::from_fn(|k| 0.5 * size * (window.ranges[k].1 - window.ranges[k].0));
        let middle: [[f64; LANES]; N] =
            std::array::from_fn(|k| std::array::from_fn(|_| random.within(window.ranges[k])));
        let y: [Affine<N>; N] =
            std::array::from_fn(|k| Affine::along(k, |l| Line::variable(middle[k][l], radius[k])));
        let turn = |k: usize| y[k].sin_cos();
        let enclosures: Vec<Affine<N>> =
            functions(robot, &Chart::Pose.at::<Affine<N>, D, N>(robot, &y, turn));
        for lane in 0..LANES {
            for _ in 0..20 {
                let t: [f64; N] = std::array::from_fn(|_| random.within((-1.0, 1.0)));
                let x: [f64; N] = std::array::from_fn(|k| middle[k][lane] + radius[k] * t[k]);
                let at = Chart::Pose.at::<f64, D, N>(robot, &x, |k| x[k].sin_cos());
                if at.1.iter().any(|leg| leg.closure.reach < 0.0) {
                    continue;
                }
                for (form, value) in enclosures.iter().zip(functions(robot, &at)) {
                    let (centre, slope, error) = form.lane(lane);
                    let linear: f64 = centre + slope.iter().zip(t).map(|(s, t)| s * t).sum::<f64>();
                    let slack = 1e-9 * (1.0 + value.abs());
                    let range = form.range().lane(lane);
                    assert!(
                        range.lo - slack <= value && value <= range.hi + slack,
                        "{value} in {range:?} at {x:?}"
                    );
                    // Of large boxes nothing need be known: then the error is no number.
                    let is_far = (linear - value).abs() > error + slack;
                    assert!(!is_far, "{value}, {linear} ± {error} at {x:?}");
                    seen += 1;
                }
            }
        }
    }
    seen
}

#[test]
fn limits_and_det_a_lie_where_affine_forms_have_them() {
    let random = &mut Random::new(11);
    let anchors = [[0.0, 0.0], [9.0, 0.0]];
    for bodies in ["[bodies]\nradius = 0.0\n", "[bodies]\nradius = 0.7\nclearance = 0.1\n"] {
        assert!(seen::<2, 2>(&five_bar(anchors, LINKS, bodies), random, 1500) > 100_000);
    }
    for name in ["3-rrr", "3-prr", "3-rpr"] {
        assert!(seen::<2, 3>(&catalogue::find(name).unwrap(), random, 300) > 10_000, "{name}");
    }
    for name in ["irb-360", "linear-delta", "spherical-3-rrr"] {
        assert!(seen::<3, 3>(&catalogue::find(name).unwrap(), random, 300) > 1000, "{name}");
    }
}
