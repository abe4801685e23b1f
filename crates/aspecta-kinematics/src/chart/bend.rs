//! The charts of orientations at which a leg of a platform that turns about a point folds.
//!
//! If the links of a leg are equal, v can come onto the motor's axis, and if they complete each other to half
//! a turn, onto its other end. There the motor is free: one orientation has a whole circle of q_j. In the
//! leg's own joint angles nothing is special there.

use super::chain;
use super::{LEAST, largest_apart};
use aspecta_robot::chart::{Bend, Chain};
use aspecta_robot::legs::Spherical;
use aspecta_robot::num::{Interval, dot};
use aspecta_robot::{LegIndex, Robot, Window};

/// How near (rad) v comes to the motor's axis if the leg counts as one that folds: else the boxes round the
/// nearest orientations would have to be very small.
const NEAR: f64 = 0.05;

/// The charts of the folds of all legs but that of the chart `all`, which holds its own; each so small that
/// no orientation is in two of them, or is a fold of that leg too. None if two legs can fold at once.
pub(super) fn bends(robot: &Robot, all: &Chain) -> Vec<Chain> {
    let found = largest_apart(|size| caps(robot, size), |a: &Cap, b: &Cap| a.is_apart_from(b, robot));
    found.into_iter().map(|cap| cap.chain).filter(|chain| chain.leg != all.leg).collect()
}

/// The legs that can fold where no chart opens it up: other ones than that of the chart of all
/// configurations, if two legs can fold at once. Boxes there are never decided.
pub fn uncharted_folds(robot: &Robot, window: &Window) -> Vec<LegIndex> {
    let Some(all) = chain::of(robot, window) else { return Vec::new() };
    let charted = bends(robot, &all);
    let mut legs: Vec<LegIndex> = caps(robot, LEAST)
        .into_iter()
        .filter(|cap| {
            cap.reaches && cap.chain.leg != all.leg && !charted.iter().any(|c| c.leg == cap.chain.leg)
        })
        .map(|cap| cap.chain.leg)
        .collect();
    legs.dedup();
    legs
}

fn caps(robot: &Robot, half_width: f64) -> Vec<Cap> {
    (0..robot.dof()).flat_map(|leg| Cap::of_leg(robot, leg, half_width)).collect()
}

/// A fold: orientations with v_j within `radius` (rad) of the motor's axis, or of its other end.
struct Cap {
    chain: Chain,
    /// The end of the axis, in the base.
    end: [f64; 3],
    radius: f64,
    /// Whether v can reach the axis, as well as the constants of the robot are known.
    reaches: bool,
}

impl Cap {
    /// The folds of a leg, charted to `half_width` of the elbow.
    fn of_leg(robot: &Robot, leg: usize, half_width: f64) -> Vec<Self> {
        let Some(links) = robot.legs[leg].actuator.as_spherical() else { return Vec::new() };
        let &Spherical { proximal: (cos_a, sin_a), distal_cos: cos_b } = links;
        let (a, b) = (sin_a.mid().atan2(cos_a.mid()), cos_b.mid().acos());
        let cap = |back: bool| {
            let (side, least) =
                if back { (1.0, (a - b).abs()) } else { (-1.0, (std::f64::consts::PI - a - b).abs()) };
            let reaches = (cos_a - cos_b * Interval::point(side)).contains(0.0);
            let radius = (side * a.cos() * b.cos() + a.sin() * b.sin() * half_width.cos()).acos();
            let end = robot.legs[leg].frame[2].map(|x| side * x.mid());
            let chain = Chain { leg: LegIndex::new(leg), bend: Some(Bend { back, half_width }) };
            (least < NEAR).then_some(Self { chain, end, radius, reaches })
        };
        [true, false].into_iter().filter_map(cap).collect()
    }

    /// Whether no orientation is in both, by the triangle inequality on the sphere; the twentieth to spare is
    /// far beyond rounding.
    fn is_apart_from(&self, other: &Self, robot: &Robot) -> bool {
        let joint = |cap: &Self| robot.leg(cap.chain.leg).attachment.map(|x| x.mid());
        let between = |x: [f64; 3], y: [f64; 3]| dot(&x, &y).clamp(-1.0, 1.0).acos();
        let (base, body) = (between(self.end, other.end), between(joint(self), joint(other)));
        (base - body).abs() > 1.05 * (self.radius + other.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::Coordinates;
    use crate::chart::{Chart, charts};
    use aspecta_robot::num::Random;
    use aspecta_robot::{Limit, catalogue};
    use std::f64::consts::PI;

    const FOLDING: &str = include_str!("../../../aspecta/tests/fixtures/folding_sphere.toml");

    fn folding() -> Robot {
        Robot::from_toml(FOLDING, "folding_sphere.toml").unwrap()
    }

    fn charted(robot: &Robot) -> Vec<Option<usize>> {
        let charts = charts(robot, &robot.slice(&[]).unwrap());
        charts.iter().map(|chart| chart.leg().map(LegIndex::index)).collect()
    }

    /// Returns a robot with right angles only, in general position, so that each leg folds at both ends of
    /// its motor's axis, and no two at once.
    fn six_folds() -> Robot {
        let mut robot = folding();
        for (leg, joint) in
            robot.legs.iter_mut().zip([[0.6, -0.8, 0.0], [0.0, 0.28, -0.96], [-1.0, 0.0, 0.0]])
        {
            let (cos, sin) = (Interval::point(0.0), Interval::point(1.0));
            leg.actuator = Spherical { proximal: (cos, sin), distal_cos: cos }.into();
            leg.attachment = joint.map(Interval::point);
        }
        robot
    }

    #[test]
    fn legs_that_fold_have_charts() {
        assert_eq!(charted(&folding()), [Some(0), Some(2)]);
        assert_eq!(charted(&six_folds()), [0, 1, 1, 2, 2].map(Some));
        for robot in [folding(), six_folds()] {
            assert_eq!(uncharted_folds(&robot, &robot.slice(&[]).unwrap()), []);
        }
        // All legs of the Agile Eye can fold at once: only without limits is all of it known.
        let mut eye = catalogue::find("spherical-3-rrr").unwrap();
        assert_eq!(charted(&eye), []);
        assert_eq!(uncharted_folds(&eye, &eye.slice(&[]).unwrap()), []);
        let (middle, half_cos) = ((Interval::point(1.0), Interval::point(0.0)), Interval::point(0.5));
        eye.legs[0].limits.push(Limit::ActuatorAngle { middle, half_cos, turns: 0 });
        assert_eq!(charted(&eye), [Some(0)]);
        assert_eq!(uncharted_folds(&eye, &eye.slice(&[]).unwrap()), [1, 2].map(LegIndex::new));
    }

    /// A chart covers an orientation just if the elbow is as near to its end as the chart says; and no two
    /// cover the same.
    #[test]
    fn charts_cover_what_they_hold() {
        let robot = six_folds();
        let found = bends(&robot, &Chain { leg: LegIndex::new(9), bend: None });
        assert_eq!(found.len(), 6);
        let mut random = Random::new(3);
        let mut covered = [0; 6];
        for _ in 0..100_000 {
            let pose: [f64; 3] = std::array::from_fn(|_| random.within((-3.1, 3.1)));
            let (placement, legs) = Chart::Pose.at::<f64, 3, 3>(&robot, &pose, |k| pose[k].sin_cos());
            let mut here = Vec::new();
            for (k, chain) in found.iter().enumerate() {
                let bend = chain.bend.as_ref().unwrap();
                let margin =
                    chain::cover(bend, &robot.leg(chain.leg).actuator, &legs[chain.leg.index()].span);
                let all = Chain { leg: chain.leg, bend: None };
                let [y, _] = chain::coordinates::<3, 3>(&all, &robot, &placement.map(Interval::point));
                let end = if bend.back { PI } else { 0.0 };
                if margin.abs() > 1e-9 {
                    assert_eq!(
                        margin > 0.0,
                        (y[1].mid() - end).abs() < bend.half_width,
                        "{chain:?} {pose:?}"
                    );
                }
                if margin > 0.0 {
                    here.push(k);
                    covered[k] += 1;
                }
            }
            assert!(here.len() <= 1, "{here:?}");
        }
        assert!(covered.iter().all(|&n| n > 20), "{covered:?}");
    }

    /// Coordinates of one leg's chart, taken to another's, are those of the same placement.
    #[test]
    fn coordinates_lead_back() {
        let robot = six_folds();
        let mut random = Random::new(4);
        let mut compared = 0;
        for chain in bends(&robot, &Chain { leg: LegIndex::new(0), bend: None }) {
            let all = Chain { leg: LegIndex::new(0), bend: None };
            for _ in 0..200 {
                let half_width = chain.bend.as_ref().unwrap().half_width;
                let y = [3.1, half_width, 3.1].map(|end| random.within((-end, end)));
                let chart = Chart::Chain(chain.clone());
                let (placement, _) = chart.at::<f64, 3, 3>(&robot, &y, |k| y[k].sin_cos());
                let rows = placement.rotation().unwrap();
                for image in chain::coordinates::<3, 3>(&all, &robot, &placement.map(Interval::point)) {
                    if image.iter().any(|x| x.width() > 1e-6) {
                        continue;
                    }
                    let z = image.map(|x| x.mid());
                    let (again, _) =
                        Chart::Chain(all.clone()).at::<f64, 3, 3>(&robot, &z, |k| z[k].sin_cos());
                    let there = again.rotation().unwrap();
                    let apart =
                        (0..9).map(|k| (rows[k / 3][k % 3] - there[k / 3][k % 3]).abs()).fold(0.0, f64::max);
                    assert!(apart < 1e-6, "{chain:?} {y:?}: {apart}");
                    assert!(z[1].sin() * image[1].mid().signum() >= 0.0);
                    compared += 1;
                }
            }
        }
        assert!(compared > 1000, "{compared}");
    }
}
