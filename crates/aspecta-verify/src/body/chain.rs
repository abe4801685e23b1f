//! The joint angles of a spherical leg: where they put the platform, and what they are.

use super::kinds::spherical;
use super::{Body, MOST, Own, into_frame, out_of_frame, product, times, turned};
use aspecta_robot::chart::Chain;
use aspecta_robot::num::{Interval, Scalar};
use aspecta_robot::{Leg, Spherical};

impl<T: Scalar, const D: usize> Body<'_, T, D> {
    /// Puts the platform where the angles of a chain do: R = R_z(q) R_y(a) R_z(ψ) R_y(b) R_z(ϑ) in the leg's
    /// frame, of a platform whose joint is along z.
    pub(super) fn turn_by(&mut self, chain: &Chain, y: &[T; MOST]) {
        let leg = self.robot.leg(chain.leg);
        let Some(links) = Links::of(leg) else { return };
        let ((sin_q, cos_q), mut elbow, (sin_t, cos_t)) = (y[0].sin_cos(), y[1].sin_cos(), y[2].sin_cos());
        if chain.bend.as_ref().is_some_and(|bend| bend.back) {
            // ψ is π more than the coordinate.
            elbow = (-elbow.0, -elbow.1);
        }
        let in_base = |v: [T; D]| {
            let in_crank = links.turned(elbow, turned(cos_t, sin_t, &v));
            out_of_frame(leg, &turned(cos_q, sin_q, &in_crank))
        };
        // The platform's axes, at ϑ = 0, lie along y, −x and z.
        let (x, y, z) = (in_base(unit(0)), in_base(unit(1)), in_base(unit(2)));
        let axes = [y, x.map(|x| -x), z];
        let body = chain.body(self.robot);
        self.rotation = Some(std::array::from_fn(|i| {
            std::array::from_fn(|k| times(|a| body[a][i], &axes.map(|v| v[k])))
        }));
        let (span, swing) = (links.turned(elbow, unit(2)), links.proximal.1);
        self.own = Some(Own { leg: chain.leg.index(), cos: cos_q, sin: sin_q, span, swing });
    }
}

impl<const D: usize> Body<'_, Interval, D> {
    /// The pose of a platform that turns about a point, as far as these are small intervals away from the
    /// poles of the pitch; else anything.
    pub(crate) fn roll_pitch_yaw(&self) -> [Interval; 3] {
        let Some(columns) = self.rotation else { return [Interval::ENTIRE; 3] };
        let (x, low) = (columns[0], columns.map(|column| column[D - 1]));
        let angle = |cos, sin| Interval::angle(cos, sin).unwrap_or(Interval::ENTIRE);
        let pitch = angle((x[0].square() + x[1].square()).sqrt(), -low[0]);
        [angle(low[D - 1], low[1]), pitch, angle(x[0], x[1])]
    }

    /// The coordinates of a chain that holds all configurations: those with sin ψ ≥ 0 and those with sin ψ ≤
    /// 0; entries beyond are zero.
    pub(crate) fn joint_angles(&self, chain: &Chain) -> [[Interval; MOST]; 2] {
        let (leg, zero) = (self.robot.leg(chain.leg), Interval::point(0.0));
        let anything = [Interval::ENTIRE, Interval::ENTIRE, Interval::ENTIRE, zero, zero, zero];
        let Some(links) = Links::of(leg) else { return [anything; 2] };
        let angle = |cos, sin| Interval::angle(cos, sin).unwrap_or(Interval::ENTIRE);
        let v = into_frame(leg, &self.arm(leg));
        let first = into_frame(leg, &self.turn(&chain.body(self.robot)[0]));
        let ((cos_a, sin_a), (cos_b, sin_b)) = (links.proximal, links.distal);
        let cos = ((cos_a * cos_b - v[D - 1]) / (sin_a * sin_b)).meet(Interval::new(-1.0, 1.0));
        let sin = (Interval::point(1.0) - cos.square()).sqrt();
        [sin, -sin].map(|sin| {
            let unturned: [Interval; D] = links.turned((sin, cos), unit(2));
            let q = angle(v[0], v[1]) - angle(unturned[0], unturned[1]);
            let (sin_q, cos_q) = q.sin_cos();
            // Back through the motor's angle: what is left of R is R_y(a) R_z(ψ) R_y(b) R_z(ϑ), and takes the
            // first axis to that of y.
            let back = turned(cos_q, -sin_q, &first);
            let (x, y) = (links.turned((sin, cos), unit(0)), links.turned((sin, cos), unit(1)));
            let theta = angle(product(&y, &back), -product(&x, &back));
            [q, angle(cos, sin), theta, zero, zero, zero]
        })
    }
}

/// (cos, sin) of the angles of a spherical leg's links.
pub(crate) struct Links {
    pub proximal: (Interval, Interval),
    pub distal: (Interval, Interval),
}

impl Links {
    pub(crate) fn of(leg: &Leg) -> Option<Self> {
        let Spherical { proximal, distal_cos } = spherical(&leg.actuator)?;
        let distal_sin = (Interval::point(1.0) - distal_cos.square()).sqrt();
        Some(Self { proximal, distal: (distal_cos, distal_sin) })
    }

    /// R_y(a) R_z(ψ) R_y(b) v, the elbow's angle ψ having this (sin, cos).
    fn turned<T: Scalar, const D: usize>(&self, (sin, cos): (T, T), v: [T; D]) -> [T; D] {
        let tilted = |(cos, sin): (Interval, Interval), v: [T; D]| {
            let (x, z) = (v[0], v[D - 1]);
            let mut w = v;
            (w[0], w[D - 1]) = (x.scale(cos) + z.scale(sin), z.scale(cos) - x.scale(sin));
            w
        };
        tilted(self.proximal, turned(cos, sin, &tilted(self.distal, v)))
    }
}

/// The unit vector along axis i.
fn unit<T: Scalar, const D: usize>(i: usize) -> [T; D] {
    std::array::from_fn(|k| T::constant(Interval::point(if i == k { 1.0 } else { 0.0 })))
}
