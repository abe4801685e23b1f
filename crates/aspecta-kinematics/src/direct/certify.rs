//! Proofs that a direct solution exists and is alone: the Krawczyk operator.

use super::locked::{Locked, equations, linearised};
use aspecta_robot::Platform;
use aspecta_robot::num::{Interval, Jet};
use nalgebra::SMatrix;

/// f(·, q) linearised at a point m, for the Krawczyk operator on boxes X round m,
///
/// > K(X) = m − Y f(m) + (I − Y F(X)) (X − m),
///
/// with Y ≈ f′(m)⁻¹ and F(X) an enclosure of f′ over X.
///
/// *Theorem* (Krawczyk 1969; Neumaier, *Interval Methods for Systems of Equations*, 1990, theorem 5.1.8). If
/// K(X) lies in the interior of X, then f has exactly one zero in X, and f′ is regular there.
///
/// Robot constants and q are intervals here, so this holds for every robot and every q inside them.
struct Krawczyk<'a, const D: usize, const N: usize> {
    platform: Platform,
    legs: &'a [Locked],
    centre: [f64; N],
    inverse: SMatrix<f64, N, N>,
    /// −Y f(m).
    shift: [Interval; N],
}

impl<'a, const D: usize, const N: usize> Krawczyk<'a, D, N> {
    /// `None` if f′(m) has no inverse.
    fn at(platform: Platform, legs: &'a [Locked], centre: [f64; N]) -> Option<Self> {
        let (_, jacobian) = linearised::<D, N>(platform, legs, &centre);
        let inverse = jacobian.try_inverse().filter(|y| y.iter().all(|v| v.is_finite()))?;
        let f = equations::<Interval, D, N>(platform, legs, &centre.map(Interval::point));
        let shift = std::array::from_fn(|i| {
            (0..N).fold(Interval::point(0.0), |sum, k| sum - Interval::point(inverse[(i, k)]) * f[k])
        });
        Some(Self { platform, legs, centre, inverse, shift })
    }

    /// K(X) for a box X that holds m.
    fn image(&self, region: &[Interval; N]) -> [Interval; N] {
        let variables = std::array::from_fn(|k| Jet::<Interval, N>::variable(region[k], k));
        let f = equations::<_, D, N>(self.platform, self.legs, &variables);
        std::array::from_fn(|i| {
            let mut image = Interval::point(self.centre[i]) + self.shift[i];
            for j in 0..N {
                let mut defect = Interval::point(if i == j { 1.0 } else { 0.0 });
                for k in 0..N {
                    defect = defect - Interval::point(self.inverse[(i, k)]) * f[k].gradient[j];
                }
                image = image + defect * (region[j] - Interval::point(self.centre[j]));
            }
            image
        })
    }
}

fn inside<const N: usize>(inner: &[Interval; N], outer: &[Interval; N]) -> bool {
    (0..N).all(|k| outer[k].lo < inner[k].lo && inner[k].hi < outer[k].hi)
}

/// A box round the approximate solution `pose` proved to hold exactly one solution, or `None`.
///
/// The box is found by inflation: twice what the operator makes of the point, then of that, a few times.
pub(super) fn certify<const D: usize, const N: usize>(
    platform: Platform,
    legs: &[Locked],
    pose: [f64; N],
) -> Option<[Interval; N]> {
    const INFLATIONS: usize = 4;
    let operator = Krawczyk::<D, N>::at(platform, legs, pose)?;
    let around = |m: f64, reach: f64| {
        let radius = 2.0 * reach + f64::EPSILON * m.abs() + f64::MIN_POSITIVE;
        Interval::point(m) + Interval::new(-radius, radius)
    };
    let mut region: [_; N] = std::array::from_fn(|k| around(pose[k], operator.shift[k].magnitude()));
    for _ in 0..INFLATIONS {
        let image = operator.image(&region);
        if inside(&image, &region) {
            return Some(region);
        }
        region = std::array::from_fn(|k| around(pose[k], (image[k] - Interval::point(pose[k])).magnitude()));
    }
    None
}

/// Whether two boxes of poses have no pose in common; angles are compared modulo 2π.
pub(super) fn disjoint<const N: usize>(platform: Platform, a: &[Interval; N], b: &[Interval; N]) -> bool {
    let turn = Interval::PI * Interval::point(2.0);
    (0..N).any(|k| {
        let gap = a[k] - b[k];
        let apart = |g: Interval| !g.contains(0.0);
        apart(gap) && (!platform.coordinates()[k].periodic || (apart(gap - turn) && apart(gap + turn)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use aspecta_robot::Leg;

    /// Two circles of one radius round (±3, 0).
    fn circles(radius: f64) -> [Locked; 2] {
        [-3.0, 3.0].map(|x| Locked::new::<2>(&Leg::strut([x, 0.0], [0.0, 0.0]), radius))
    }

    #[test]
    fn a_certificate_is_a_narrow_box_round_the_solution() {
        let legs = circles(5.0);
        let certify = |pose| certify::<2, 2>(Platform::PlanePoint, &legs, pose);
        let up = certify([1e-9, 4.0]).unwrap();
        assert!(up[0].contains(0.0) && up[1].contains(4.0) && up[1].width() < 1e-7);
        let down = certify([0.0, -4.0]).unwrap();
        assert!(disjoint(Platform::PlanePoint, &up, &down) && !disjoint(Platform::PlanePoint, &up, &up));
    }

    #[test]
    fn none_without_a_solution_or_at_a_double_one() {
        for (radius, pose) in [(5.0, [0.0, 0.0]), (3.0, [0.0, 0.0]), (3.0, [0.0, 1e-8]), (2.9, [0.0, 0.1])] {
            assert_eq!(certify::<2, 2>(Platform::PlanePoint, &circles(radius), pose), None);
        }
    }

    #[test]
    fn angles_are_compared_modulo_a_turn() {
        let at =
            |phi: f64| [Interval::point(1.0), Interval::point(2.0), Interval::new(phi - 1e-9, phi + 1e-9)];
        let pi = std::f64::consts::PI;
        assert!(!disjoint(Platform::PlaneBody, &at(pi), &at(-pi)));
        assert!(disjoint(Platform::PlaneBody, &at(pi), &at(-pi + 1e-6)));
    }
}
