//! Poses of a free body, as coordinates and as what they mean.

use nalgebra::{UnitQuaternion, Vector3};
use std::f64::consts::{PI, TAU};

/// x, y, z, roll, pitch, yaw; angles are any real numbers.
pub(super) type Pose = [f64; 6];

/// The position and orientation of the platform, independent of coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Body {
    origin: Vector3<f64>,
    turn: UnitQuaternion<f64>,
}

impl Body {
    pub fn new(origin: [f64; 3], turn: UnitQuaternion<f64>) -> Self {
        Self { origin: origin.into(), turn }
    }

    pub fn at(pose: &Pose) -> Self {
        let turn = UnitQuaternion::from_euler_angles(pose[3], pose[4], pose[5]);
        Self::new([pose[0], pose[1], pose[2]], turn)
    }

    /// Returns its coordinates, the pitch within ±π/2.
    pub fn pose(&self) -> Pose {
        let (roll, pitch, yaw) = self.turn.euler_angles();
        [self.origin.x, self.origin.y, self.origin.z, roll, pitch, yaw]
    }

    /// Returns the distance between two bodies: translation, and the angle of the rotation times `length`.
    pub fn distance(&self, other: &Self, length: f64) -> f64 {
        let cos = self.turn.coords.dot(&other.turn.coords).abs().min(1.0);
        (self.origin - other.origin).norm().hypot(2.0 * cos.acos() * length)
    }

    /// A share t of the way to another: straight, and turning about one axis by the lesser angle.
    pub fn towards(&self, other: &Self, t: f64) -> Self {
        let turn = self.turn.rotation_to(&other.turn).powf(t) * self.turn;
        Self { origin: self.origin.lerp(&other.origin, t), turn }
    }

    /// Moved by three lengths and turned by a rotation vector of three lengths over `length`.
    pub fn moved(&self, [x, y, z, a, b, c]: Pose, length: f64) -> Self {
        let turn = UnitQuaternion::from_scaled_axis(Vector3::new(a, b, c) / length);
        Self { origin: self.origin + Vector3::new(x, y, z), turn: turn * self.turn }
    }

    /// A rotation drawn evenly from all, by three shares in [0, 1) (Shoemake 1992).
    pub fn even_turn([a, b, c]: [f64; 3]) -> UnitQuaternion<f64> {
        let (low, high) = ((1.0 - a).sqrt(), a.sqrt());
        let ((s, k), (t, l)) = ((TAU * b).sin_cos(), (TAU * c).sin_cos());
        UnitQuaternion::new_normalize(nalgebra::Quaternion::new(low * s, low * k, high * t, high * l))
    }
}

/// The coordinates of the pose `b` among which the straight line from `a` is shortest, as `length` measures
/// it: with full turns of the angles that are `free`, and if all are with (roll + π, π − pitch, yaw + π),
/// which is the same orientation.
pub(super) fn beside(a: &Pose, b: &Pose, free: [bool; 3], length: impl Fn(&Pose) -> f64) -> Pose {
    let mut best = (f64::INFINITY, *b);
    let over = [b[0], b[1], b[2], b[3] + PI, PI - b[4], b[5] + PI];
    let meant = if free == [true; 3] { &[*b, over][..] } else { &[*b][..] };
    for other in meant {
        // Near the poles of the pitch a turn of the roll undoes one of the yaw, so the nearest angles need
        // not be nearest together.
        for more in [0.0, TAU, -TAU] {
            let mut pose = *other;
            for k in 3..6 {
                let turns = if free[k - 3] { ((a[k] - pose[k]) / TAU).round() * TAU } else { 0.0 };
                // Where no turn is needed the pose stays what it is, to the last bit.
                pose[k] += turns;
            }
            pose[5] += if free[2] { more } else { 0.0 };
            let far = length(&pose);
            if far < best.0 {
                best = (far, pose);
            }
        }
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;
    use aspecta_robot::num::Random;

    fn random_body(random: &mut Random) -> Body {
        let shares = [random.unit(), random.unit(), random.unit()];
        Body::new(std::array::from_fn(|_| random.within((-2.0, 2.0))), Body::even_turn(shares))
    }

    /// R = R_z R_y R_x, as everywhere in this crate.
    #[test]
    fn coordinates_mean_what_they_mean_elsewhere() {
        let mut random = Random::new(1);
        for _ in 0..100 {
            let pose: Pose = std::array::from_fn(|_| random.within((-7.0, 7.0)));
            let placement = aspecta_kinematics::placement::Placement::<f64, 3>::at(
                aspecta_robot::Platform::FreeBody,
                &pose,
            );
            let rotation = Body::at(&pose).turn.to_rotation_matrix();
            for (i, row) in placement.rotation().unwrap().iter().enumerate() {
                for (k, x) in row.iter().enumerate() {
                    assert!((rotation[(i, k)] - x).abs() < 1e-12);
                }
            }
            assert!(Body::at(&Body::at(&pose).pose()).distance(&Body::at(&pose), 1.0) < 1e-7);
        }
    }

    #[test]
    fn the_way_between_two_bodies_is_the_shortest_and_even() {
        let mut random = Random::new(2);
        for _ in 0..100 {
            let (a, b) = (random_body(&mut random), random_body(&mut random));
            let (t, whole) = (random.unit(), a.distance(&b, 1.3));
            let middle = a.towards(&b, t);
            assert!((a.distance(&middle, 1.3) - t * whole).abs() < 1e-6);
            assert!((middle.distance(&b, 1.3) - (1.0 - t) * whole).abs() < 1e-6);
        }
    }

    /// A body put beside a pose keeps its orientation, and is no further than before.
    #[test]
    fn beside_means_the_same_pose() {
        let mut random = Random::new(3);
        for _ in 0..200 {
            let (a, b) = (random_body(&mut random).pose(), random_body(&mut random).pose());
            let far = |x: &Pose| (3..6).map(|k| (x[k] - a[k]).abs()).sum::<f64>();
            for free in [[true; 3], [true, false, true], [false; 3]] {
                let c = beside(&a, &b, free, far);
                assert!(Body::at(&b).distance(&Body::at(&c), 1.0) < 1e-7, "{b:?} {c:?}");
                assert!(far(&c) <= far(&b));
                assert!((0..3).all(|k| free[k] || c[3 + k] == b[3 + k]));
            }
        }
    }
}
