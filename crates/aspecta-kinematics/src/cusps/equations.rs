//! The equations of a cusp, for any scalar.

use crate::chart::{Chart, Coordinates};
use crate::modal::LegClosure;
use crate::placement::{cofactors, into_frame, leg_gradient, out_of_frame, wrench};
use aspecta_robot::num::{Interval, Jet, Scalar, dot, each};
use aspecta_robot::{Leg, Platform, Robot, WorkingMode};

/// The equations of cusps in one working mode, in the coordinates of one chart.
///
/// Row i of A is taken times the leg's weight wᵢ ≥ 0, so that nothing is divided. With u and v a row and a
/// column of its adjugate,
///
/// > det A = 0,  κ = Σᵢ uᵢ wᵢ f̈ᵢ(v) = 0,  f_k(X, q_k) = 0 for the joint that is held.
///
/// f̈ᵢ(v) is the second derivative of fᵢ, q fixed, along the motion of constant twist v. Any other motion
/// that starts with v adds A a to f̈, a its acceleration, which u does not see where det A = 0. So at rank n
/// − 1 κ is a non-zero multiple of u·∂²f/∂X²(v, v), unless the column or the row was chosen where it is zero
/// ([`Values::pivot`]).
///
/// All of it is a polynomial in d and h = √H: continuous up to the serial singularities.
pub(super) struct System<'a, const D: usize> {
    pub robot: &'a Robot,
    pub chart: Chart,
    pub mode: WorkingMode,
    pub held: Option<(usize, f64)>,
    curvatures: Vec<[[Interval; D]; D]>,
}

/// The functions of a cusp at a point (or on a box).
#[derive(Clone, Copy, Debug)]
pub(super) struct Values<T, const N: usize> {
    /// det A, κ and the held leg's equation (n = 3), all zero at a cusp.
    pub equations: [T; N],
    /// Negative where the configuration does not exist in this mode: Hᵢ, or sᵢ Bᵢᵢ where Bᵢᵢ is at hand.
    /// Positive off the serial singularities.
    pub closing: [T; N],
    /// Zero where qᵢ is free; else 1, or positive.
    pub weights: [T; N],
    /// The entry of adj A that the chosen column and row share. Where it is not zero, A has rank n − 1 at
    /// least and κ = 0 means a cusp.
    pub pivot: T,
}

/// Which row and which column of A are struck out to find v and u.
pub(super) type Pivot = (usize, usize);

/// One leg as the equations see it.
#[derive(Clone, Copy)]
struct LegForce<T, const D: usize> {
    /// wᵢ ∂f/∂C, base frame.
    gradient: [T; D],
    arm: [T; D],
    weight: T,
    closing: T,
}

impl<'a, const D: usize> System<'a, D> {
    pub fn new(robot: &'a Robot, chart: Chart, mode: WorkingMode, held: Option<(usize, f64)>) -> Self {
        Self {
            robot,
            chart,
            mode,
            held,
            curvatures: robot.legs.iter().map(|leg| curvature(leg, [0.0; D], 1.0)).collect(),
        }
    }

    /// The legs at `y`, and the held leg's equation.
    fn legs<T: Scalar, const N: usize>(&self, y: &[T; N]) -> ([LegForce<T, D>; N], T) {
        let (_, closures) = self.chart.at::<T, D, N>(self.robot, y, |k| y[k].sin_cos());
        let one = T::constant(Interval::point(1.0));
        let still = [T::zero(); D];
        let mut legs = [LegForce { gradient: still, arm: still, weight: one, closing: one }; N];
        let mut held_equation = T::zero();
        for (j, at) in closures.iter().enumerate() {
            let sign = self.mode.sign(j);
            legs[j] = match self.held {
                Some((k, q)) if k == j => {
                    let (f, gradient, b) =
                        leg_gradient(&self.robot.legs[j], &at.span, T::constant(Interval::point(q)));
                    held_equation = f;
                    LegForce { gradient, arm: at.arm, weight: one, closing: if sign > 0 { b } else { -b } }
                }
                _ => eliminated(&self.robot.legs[j], at, sign),
            };
        }
        (legs, held_equation)
    }

    /// The rows of A, weighted, at `y`.
    fn rows<T: Scalar, const N: usize>(&self, legs: &[LegForce<T, D>; N]) -> [[T; N]; N] {
        std::array::from_fn(|j| {
            wrench(self.robot.platform, &legs[j].gradient, &legs[j].arm).map(T::tightened)
        })
    }

    /// adj A, transposed, at the point `y`.
    pub fn cofactors<T: Scalar, const N: usize>(&self, y: &[T; N]) -> [[T; N]; N] {
        cofactors(&self.rows(&self.legs(y).0)).map(|row| row.map(T::tightened))
    }

    /// The row and the column whose common entry in adj A is greatest at the point `y`.
    pub fn pivot<const N: usize>(&self, y: &[f64; N]) -> Pivot {
        let cofactors = self.cofactors(y);
        let unit = self.units::<N>();
        // A component of v that is an angle counts as the length that it moves.
        let size = |&(j, k): &Pivot| (cofactors[j][k] / unit[k]).abs();
        let all = (0..N).flat_map(|j| (0..N).map(move |k| (j, k)));
        all.max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or((0, 0))
    }

    /// Returns the units in which pose coordinates are of order one: the robot's size, or a radian.
    pub fn units<const N: usize>(&self) -> [f64; N] {
        let (coordinates, length) = (self.robot.platform.coordinates(), self.robot.characteristic_length());
        std::array::from_fn(|k| if coordinates[k].angle { 1.0 } else { length })
    }

    /// The twist v with A v ≈ 0 at the singular pose `y`, of unit length when lengths are in
    /// [`System::units`].
    pub fn kernel<const N: usize>(&self, y: &[f64; N]) -> [f64; N] {
        let unit = self.units::<N>();
        let v = self.cofactors(y)[self.pivot(y).0];
        let length = (0..N).map(|k| (v[k] / unit[k]).powi(2)).sum::<f64>().sqrt();
        v.map(|x| x / length)
    }

    /// Everything that holds at a cusp, with v and u found by striking out `pivot`.
    pub fn values<T: Scalar, const N: usize>(&self, y: &[T; N], pivot: Pivot) -> Values<T, N> {
        let (legs, held) = self.legs(y);
        let rows = self.rows(&legs);
        let cofactors = cofactors(&rows).map(|row| row.map(T::tightened));
        let (j, k) = pivot;
        let v = cofactors[j];
        let mut kappa = T::zero();
        for i in 0..N {
            kappa = kappa + cofactors[i][k] * self.second(i, &legs[i], &v).tightened();
        }
        let mut equations = [held; N];
        (equations[0], equations[1]) = (dot(&rows[j], &v), kappa);
        Values {
            equations: equations.map(T::tightened),
            closing: legs.map(|leg| leg.closing.tightened()),
            weights: legs.map(|leg| leg.weight.tightened()),
            pivot: v[k],
        }
    }

    /// wᵢ f̈ᵢ(v): with C′ and C″ the velocity and the acceleration of the leg's end, ∂²f/∂C²(C′, C′) + ∂f/∂C
    /// · C″.
    fn second<T: Scalar, const N: usize>(&self, i: usize, leg: &LegForce<T, D>, v: &[T; N]) -> T {
        let platform = self.robot.platform;
        let coordinates = platform.coordinates();
        let moved = into_frame(&self.robot.legs[i], &velocity(platform, &leg.arm, v)).map(T::tightened);
        let bent = quadratic(&self.curvatures[i], &moved) * leg.weight;
        if coordinates.iter().all(|c| !c.angle) {
            return bent;
        }
        let spin: [T; N] = each!(|k| if coordinates[k].angle { v[k] } else { T::zero() });
        let turned = velocity(platform, &leg.arm, &spin).map(T::tightened);
        bent + dot(&leg.gradient, &velocity(platform, &turned, &spin))
    }
}

/// A leg whose q is eliminated, in posture `sign`.
fn eliminated<T: Scalar, const D: usize>(leg: &Leg, at: &LegClosure<T, D>, sign: i8) -> LegForce<T, D> {
    let one = T::constant(Interval::point(1.0));
    let sh = at.heights()[usize::from(sign < 0)];
    let local: [T; D] = each!(|k| at.closure.fixed[k] + sh * at.closure.swing[k]);
    let closing = match &at.fold {
        Some(fold) if sign > 0 => fold.b,
        Some(fold) => -fold.b,
        None if leg.actuator.postures() == 2 => at.closure.reach,
        None => one,
    };
    LegForce { gradient: out_of_frame(leg, &local), arm: at.arm, weight: at.closure.weight, closing }
}

/// The velocity of the end of `arm` when the platform has the twist `v`, by the duality of twists and
/// wrenches.
fn velocity<T: Scalar, const D: usize, const N: usize>(
    platform: Platform,
    arm: &[T; D],
    v: &[T; N],
) -> [T; D] {
    std::array::from_fn(|k| {
        let mut unit = [T::zero(); D];
        unit[k] = T::constant(Interval::point(1.0));
        dot(&wrench::<T, D, N>(platform, &unit, arm), v)
    })
}

/// ∂²f/∂d² of a leg, in its own frame. Every leg equation is of second degree at most in d, and q is not in
/// its terms of second degree: so it is a constant, and `d` and `q` are free.
pub(super) fn curvature<const D: usize>(leg: &Leg, d: [f64; D], q: f64) -> [[Interval; D]; D] {
    let inner = |k: usize| Jet::<Interval, D>::variable(Interval::point(d[k]), k);
    let outer: [Jet<Jet<Interval, D>, D>; D] = std::array::from_fn(|k| Jet::variable(inner(k), k));
    let f = leg.actuator.equation(&outer, Scalar::constant(Interval::point(q)));
    f.gradient.map(|row| row.gradient)
}

/// cᵀ M c for a constant symmetric M.
fn quadratic<T: Scalar, const D: usize>(m: &[[Interval; D]; D], c: &[T; D]) -> T {
    let mut sum = T::zero();
    for a in 0..D {
        for b in (a..D).filter(|&b| m[a][b] != Interval::point(0.0)) {
            let term = if a == b { c[a].square() } else { (c[a] * c[b]).scale(Interval::point(2.0)) };
            sum = sum + term.scale(m[a][b]);
        }
    }
    sum
}
