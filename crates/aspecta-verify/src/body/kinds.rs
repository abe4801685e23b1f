//! The checker's own formulas for each kind of leg, in the leg's frame, with d = C − A.

use super::square;
use aspecta_robot::num::{Interval, Scalar};
use aspecta_robot::{Actuator, Prismatic, Revolute, Spherical, Strut};

/// H, the discriminant of the leg equation; `None` if that has no zero to keep away from. With d = (α, β, γ),
/// f = k − a cos q − b sin q has solutions where H = a² + b² − k² ≥ 0, and there ∂f/∂q = ±√H.
pub(super) fn reach<T: Scalar, const D: usize>(actuator: &Actuator, d: &[T; D]) -> Option<T> {
    match actuator {
        Actuator::Revolute(leg) => Some(Harmonic::of_revolute(leg, d).discriminant()),
        Actuator::Prismatic(Prismatic { rod }) => {
            Some((1..D).fold(T::constant(rod.square()), |rest, k| rest - d[k].square()))
        }
        Actuator::Strut(Strut) => None,
        Actuator::Spherical(leg) => Some(Harmonic::of_spherical(leg, d).discriminant()),
    }
}

/// A bound of H that is sharp where the rod is too short to reach across: of a crank about the third axis,
/// H = 4L²(M² − γ²) − (‖d‖² − L² − M²)². (At γ = M the discriminant touches zero.)
pub(super) fn most_reach<const D: usize>(actuator: &Actuator, d: &[Interval; D]) -> f64 {
    match (actuator, d.get(2)) {
        (Actuator::Revolute(Revolute { crank, rod }), Some(across)) => {
            (Interval::point(4.0) * crank.square() * (rod.square() - across.square())).hi
        }
        (Actuator::Revolute(_) | Actuator::Prismatic(_) | Actuator::Strut(_) | Actuator::Spherical(_), _) => {
            f64::INFINITY
        }
    }
}

/// The numbers in the leg equation but for the coordinates of points.
pub(crate) fn constants(actuator: &Actuator) -> Vec<Interval> {
    match *actuator {
        Actuator::Revolute(Revolute { crank, rod }) => vec![crank, rod],
        Actuator::Prismatic(Prismatic { rod }) => vec![rod],
        Actuator::Strut(Strut) => Vec::new(),
        Actuator::Spherical(Spherical { proximal: (cos, sin), distal_cos }) => vec![cos, sin, distal_cos],
    }
}

/// The length of the rod, if it has one.
pub(crate) fn rod_length(actuator: &Actuator) -> Option<Interval> {
    match *actuator {
        Actuator::Revolute(Revolute { rod, .. }) | Actuator::Prismatic(Prismatic { rod }) => Some(rod),
        Actuator::Strut(_) | Actuator::Spherical(_) => None,
    }
}

/// |∂f/∂q| per √H.
pub(crate) fn slope_per_root(actuator: &Actuator) -> f64 {
    match actuator {
        Actuator::Prismatic(_) => 2.0,
        Actuator::Revolute(_) | Actuator::Strut(_) | Actuator::Spherical(_) => 1.0,
    }
}

/// Returns how far inside a range of driven lengths q is.
pub(super) fn length_margin<T: Scalar, const D: usize>(
    actuator: &Actuator,
    d: &[T; D],
    q: T,
    (min, max): (Interval, Interval),
) -> T {
    match actuator {
        Actuator::Strut(Strut) => {
            let length2 = square(d);
            (length2 - T::constant(min.square())) * (T::constant(max.square()) - length2)
        }
        Actuator::Revolute(_) | Actuator::Prismatic(_) | Actuator::Spherical(_) => {
            (q - T::constant(min)) * (T::constant(max) - q)
        }
    }
}

/// (2LM cos ψ, 2LM) of a revolute leg, ψ being the angle between crank and rod.
pub(super) fn bend<T: Scalar, const D: usize>(actuator: &Actuator, d: &[T; D]) -> (T, Interval) {
    match *actuator {
        Actuator::Revolute(Revolute { crank, rod }) => {
            (square(d) - T::constant(crank.square() + rod.square()), Interval::point(2.0) * crank * rod)
        }
        Actuator::Prismatic(_) | Actuator::Strut(_) | Actuator::Spherical(_) => {
            (T::constant(Interval::ENTIRE), Interval::ENTIRE)
        }
    }
}

/// B − A, zero where there is no B; `turn` gives (sin q, cos q).
pub(super) fn elbow<T: Scalar, const D: usize>(
    actuator: &Actuator,
    q: T,
    turn: impl FnOnce() -> (T, T),
) -> [T; D] {
    let mut elbow = [T::zero(); D];
    match *actuator {
        Actuator::Revolute(Revolute { crank, .. }) => {
            let (sin, cos) = turn();
            (elbow[0], elbow[1]) = (cos.scale(crank), sin.scale(crank));
        }
        Actuator::Prismatic(_) => elbow[0] = q,
        Actuator::Strut(_) | Actuator::Spherical(_) => {}
    }
    elbow
}

/// The direction of the rod (of the strut); `turn` gives (sin q, cos q).
pub(super) fn rod<T: Scalar, const D: usize>(
    actuator: &Actuator,
    d: &[T; D],
    q: T,
    turn: impl FnOnce() -> (T, T),
) -> [T; D] {
    let mut rod = *d;
    let length = match *actuator {
        Actuator::Revolute(Revolute { crank, rod: length }) => {
            let (sin, cos) = turn();
            (rod[0], rod[1]) = (rod[0] - cos.scale(crank), rod[1] - sin.scale(crank));
            T::constant(length)
        }
        Actuator::Prismatic(Prismatic { rod: length }) => {
            rod[0] = rod[0] - q;
            T::constant(length)
        }
        Actuator::Strut(_) | Actuator::Spherical(_) => q,
    };
    rod.map(|x| x / length)
}

/// q of a leg in posture s = `sign`, for all spans in `d`, H being in `reach`.
///
/// With (a, b) = ρ(cos θ, sin θ) the equation is k = ρ cos(q − θ), and ∂f/∂q = ρ sin(q − θ) = s√H: q is θ
/// plus the angle of (k, s√H).
pub(crate) fn joint<const D: usize>(
    actuator: &Actuator,
    d: &[Interval; D],
    reach: Option<Interval>,
    sign: f64,
) -> Interval {
    let h = reach.map_or(Interval::point(0.0), |h| h.sqrt()) * Interval::point(sign);
    let anything = Interval::new(-Interval::PI.hi, Interval::PI.hi);
    let angle = |c, s| Interval::angle(c, s).unwrap_or(anything);
    let root = |Harmonic { a, b, k }: Harmonic<Interval>| angle(a, b) + angle(k, h);
    match actuator {
        Actuator::Revolute(leg) => root(Harmonic::of_revolute(leg, d)),
        Actuator::Prismatic(_) => d[0] + h,
        Actuator::Strut(_) => square(d).sqrt(),
        Actuator::Spherical(leg) => root(Harmonic::of_spherical(leg, d)),
    }
}

/// The links of a spherical leg.
pub(super) fn spherical(actuator: &Actuator) -> Option<Spherical> {
    match *actuator {
        Actuator::Spherical(leg) => Some(leg),
        Actuator::Revolute(_) | Actuator::Prismatic(_) | Actuator::Strut(_) => None,
    }
}

/// The coefficients of f = k − a cos q − b sin q, for legs whose q is an angle.
struct Harmonic<T> {
    a: T,
    b: T,
    k: T,
}

impl<T: Scalar> Harmonic<T> {
    fn of_revolute<const D: usize>(Revolute { crank, rod }: &Revolute, d: &[T; D]) -> Self {
        let twice = *crank + *crank;
        let k = square(d) + T::constant(crank.square() - rod.square());
        Self { a: d[0].scale(twice), b: d[1].scale(twice), k }
    }

    fn of_spherical<const D: usize>(leg: &Spherical, d: &[T; D]) -> Self {
        let Spherical { proximal: (cos, sin), distal_cos } = leg;
        let k = d[D - 1].scale(*cos) - T::constant(*distal_cos);
        Self { a: -d[0].scale(*sin), b: -d[1].scale(*sin), k }
    }

    fn discriminant(self) -> T {
        self.a.square() + self.b.square() - self.k.square()
    }
}
