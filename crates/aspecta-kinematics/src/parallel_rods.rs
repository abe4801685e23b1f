//! Surfaces on which three or more rods of a translating platform are parallel: there det A vanishes to
//! higher order.

use super::placement::Placement;
use aspecta_robot::legs::{Elbow, RigidRod};
use aspecta_robot::num::without_turns;
use aspecta_robot::{Leg, LegIndex, Limit, Platform, Robot, Window};
use nalgebra::Vector3;
use serde::Serialize;

/// Legs with equal rods whose elbows can coincide once each is moved back by −C_i.
///
/// A translating platform reaches X with f_i = ‖X − P_i(q_i)‖² − M², where P_i = B_i − C_i runs on a circle
/// (a line for sliders). If m of these meet in a point P, then with the joints standing there X may be
/// anywhere on the sphere round P with radius M: the m rods are parallel, A has rank n − m + 1, and det A
/// vanishes to order m − 1, on a surface, in each working mode on a part of it. For m ≥ 3 its sign need not
/// change there, and 0 is no regular value of it (docs/theory.md, section 5): no paving decides the boxes on
/// the sphere.
///
/// A free body that keeps its orientation reaches X in the same way, its arms turned. Its wrenches (u, r_i ×
/// u) along m parallel rods have rank 3 at most, so det A vanishes to order m − 3: for m ≥ 5 to the second
/// order and more.
///
/// Every Delta whose legs are placed symmetrically round an axis has two such points on it, if its cranks are
/// long enough and not kept from pointing there by their limits.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParallelRods {
    /// The legs.
    pub legs: Vec<LegIndex>,
    /// P, in base coordinates.
    pub centre: [f64; 3],
    /// M: the poses are those at this distance from P.
    pub radius: f64,
    /// The joint vector (rad or length unit).
    pub q: Vec<f64>,
    /// The order to which det A vanishes there, at least.
    pub order: usize,
}

/// How far from each other, relative to the rod, curves may pass and still count as meeting.
const TOLERANCE: f64 = 1e-9;

/// Returns all sets of legs of a robot that can have parallel rods within the limits of their actuators,
/// three or more of a translating platform, five or more of a free one in a slice of fixed orientation.
/// Numerical: curves closer than 10⁻⁹ rods are said to meet. Empty for other platforms and slices.
pub fn parallel_rods(robot: &Robot, window: &Window) -> Vec<ParallelRods> {
    let still: Vec<f64> = window.ranges.iter().map(|r| r.0).collect();
    let (placement, least) = match robot.platform {
        Platform::TranslatingBody => (Placement::<f64, 3>::at(robot.platform, &still), 3),
        Platform::FreeBody if window.held().map(|(k, _)| k).eq(3..6) => {
            (Placement::at(robot.platform, &still), 5)
        }
        Platform::PlanePoint | Platform::PlaneBody | Platform::TurningBody | Platform::FreeBody => {
            return Vec::new();
        }
    };
    let tracks: Vec<Track<'_>> =
        robot.legs.iter().filter_map(|leg| Track::of(leg, placement.arm(leg))).collect();
    let mut found: Vec<ParallelRods> = Vec::new();
    for (i, a) in tracks.iter().enumerate() {
        for point in tracks[i + 1..].iter().flat_map(|b| a.meet(b)) {
            let at = |(leg, t): (usize, &Track<'_>)| {
                let equal = (t.rod - a.rod).abs() <= TOLERANCE * a.rod;
                t.joint_at(&point).filter(|_| equal).map(|q| (LegIndex::new(leg), q))
            };
            let (legs, q): (Vec<LegIndex>, Vec<f64>) = tracks.iter().enumerate().filter_map(at).unzip();
            let near = |other: &ParallelRods| {
                (Vector3::from(other.centre) - point).norm() <= 1e3 * TOLERANCE * a.rod
            };
            // Limits may keep two of the rods apart.
            let kept_apart = robot
                .rod_angles
                .iter()
                .any(|limit| limit.min_cos.is_some() && limit.legs.iter().all(|leg| legs.contains(leg)));
            if legs.len() >= least && !kept_apart && !found.iter().any(near) {
                let order = legs.len() + 2 - least;
                found.push(ParallelRods { legs, centre: point.into(), radius: a.rod, q, order });
            }
        }
    }
    found
}

/// The curve of P_i: C + r (cos q u + sin q v), or C + q u.
struct Track<'a> {
    leg: &'a Leg,
    centre: Vector3<f64>,
    frame: [Vector3<f64>; 3],
    elbow: Elbow,
    rod: f64,
}

impl<'a> Track<'a> {
    /// `arm`: from the platform's origin to C, in the base.
    fn of(leg: &'a Leg, arm: [f64; 3]) -> Option<Self> {
        let RigidRod { length: rod, elbow } = leg.actuator.rigid_rod()?;
        let vector = |v: &[aspecta_robot::num::Interval; 3]| Vector3::from(v.map(|x| x.mid()));
        let centre = vector(&leg.anchor) - Vector3::from(arm);
        Some(Self { leg, centre, frame: leg.frame.each_ref().map(vector), elbow, rod })
    }

    fn at(&self, q: f64) -> Vector3<f64> {
        let [u, v, _] = self.frame;
        self.centre
            + match self.elbow {
                Elbow::Circle(r) => r * (q.cos() * u + q.sin() * v),
                Elbow::Line => q * u,
            }
    }

    /// The joint coordinate that brings the elbow to `point`, if one does, within the actuator's limits.
    fn joint_at(&self, point: &Vector3<f64>) -> Option<f64> {
        let [u, v, _] = self.frame;
        let d = point - self.centre;
        let q = match self.elbow {
            Elbow::Circle(_) => d.dot(&v).atan2(d.dot(&u)),
            Elbow::Line => d.dot(&u),
        };
        let allowed = |limit: &Limit| match limit {
            Limit::ActuatorAngle { middle: (cos, sin), half_cos, .. } => {
                without_turns(q - sin.mid().atan2(cos.mid())).cos() > half_cos.mid()
            }
            Limit::ActuatorLength { min, max } => min.mid() < q && q < max.mid(),
            Limit::Elbow { .. }
            | Limit::SpatialElbow { .. }
            | Limit::BaseCone { .. }
            | Limit::PlatformCone { .. }
            | Limit::Clearance(_) => true,
        };
        let there = (self.at(q) - point).norm() <= TOLERANCE * self.rod;
        (there && self.leg.limits.iter().all(allowed)).then_some(q)
    }

    /// Points of `other` in the plane of this circle, or nearest to this line; none if the two are parallel.
    fn meet(&self, other: &Self) -> Vec<Vector3<f64>> {
        let gap = self.centre - other.centre;
        let [u, v, w] = other.frame;
        let normal = match self.elbow {
            Elbow::Circle(_) => self.frame[2],
            Elbow::Line => self.frame[0].cross(&u.cross(&self.frame[0])),
        };
        let (a, b, k) = (normal.dot(&u), normal.dot(&v), normal.dot(&gap));
        match (self.elbow, other.elbow) {
            (_, Elbow::Line) if a.abs() > TOLERANCE => vec![other.at(k / a)],
            (_, Elbow::Line) => Vec::new(),
            // A line against a circle: the other way round.
            (Elbow::Line, Elbow::Circle(_)) => {
                let speed = w.dot(&self.frame[0]);
                if speed.abs() > TOLERANCE { vec![self.at(-w.dot(&gap) / speed)] } else { Vec::new() }
            }
            (Elbow::Circle(_), Elbow::Circle(r)) => {
                let reach = r * a.hypot(b);
                if reach <= TOLERANCE * r || k.abs() > reach {
                    return Vec::new();
                }
                let (middle, half) = (b.atan2(a), (k / reach).acos());
                vec![other.at(middle + half), other.at(middle - half)]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kinematics;
    use aspecta_robot::catalogue::find;

    fn rods_of(robot: &Robot) -> Vec<ParallelRods> {
        parallel_rods(robot, &robot.workspace_window().unwrap())
    }

    /// The least |det A| over the inverse solutions at a pose.
    fn least_det_a(robot: &Robot, pose: &[f64]) -> f64 {
        robot.inverse(pose).unwrap().iter().map(|s| s.det_a.abs()).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn a_symmetric_delta_has_two_spheres_on_which_det_a_vanishes_to_second_order() {
        let robot = find("delta").unwrap();
        let found = rods_of(&robot);
        assert_eq!(found.len(), 2);
        for rods in &found {
            assert_eq!(rods.legs, [0, 1, 2].map(LegIndex::new));
            // 164 − 44 + 524 cos q = 0, by hand.
            let height = (524f64.powi(2) - 120f64.powi(2)).sqrt();
            assert!(
                rods.centre[0].hypot(rods.centre[1]) < 1e-9 && (rods.centre[2].abs() - height).abs() < 1e-9
            );
            assert!(rods.q.iter().all(|q| (q.cos() + 120.0 / 524.0).abs() < 1e-12));
            let out = |distance: f64| {
                let n = Vector3::new(0.3, -0.5, rods.centre[2].signum() * -0.9).normalize();
                let pose: [f64; 3] = (Vector3::from(rods.centre) + (rods.radius + distance) * n).into();
                least_det_a(&robot, &pose)
            };
            // Half the distance, a quarter of det A.
            let ratio = out(0.02) / out(0.01);
            assert!((ratio - 4.0).abs() < 0.1, "{ratio}");
        }
    }

    #[test]
    fn limits_lines_and_unequal_rods_are_heeded() {
        let mut robot = find("delta").unwrap();
        robot.legs[1].limits = find("irb-360").unwrap().legs[1].limits.clone();
        assert_eq!(rods_of(&robot), [], "leg 2 is kept from pointing there");
        // The rails meet in the origin, which their limits keep the sliders from.
        let mut orthoglide = find("orthoglide").unwrap();
        assert_eq!(rods_of(&orthoglide), []);
        orthoglide.legs.iter_mut().for_each(|leg| leg.limits.clear());
        let found = rods_of(&orthoglide);
        assert_eq!(found.len(), 1, "{found:?}");
        orthoglide.legs[2].actuator =
            aspecta_robot::Prismatic { rod: aspecta_robot::num::Interval::point(300.0) }.into();
        assert_eq!(rods_of(&orthoglide), []);
        assert_eq!(rods_of(&find("linear-delta").unwrap()), [], "parallel rails never meet");
    }
}
