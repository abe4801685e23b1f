//! The orientations of a body on three cones, by one angle.
//!
//! w₁ · R v₁ = cos δ leaves R = E R_x(a) M R_x(b) Fᵀ, with frames E, F whose first vectors are w₁, v₁ and M
//! the turn by δ in their first two axes. Legs 2 and 3 then read α cos b + β sin b = γ with α, β, γ affine in
//! cos a, sin a, so that
//!
//! > F(a) = (γ₂β₃ − γ₃β₂)² + (α₂γ₃ − α₃γ₂)² − (α₂β₃ − α₃β₂)² = 0,
//!
//! a trigonometric polynomial of degree 4. Where Δ = α₂β₃ − α₃β₂ ≠ 0 the two lines have one solution (cos b,
//! sin b), of norm one if F = 0; where Δ = 0, F is a sum of squares and its zeros are double. So a simple
//! zero of F is exactly one orientation, and where all are simple these are all.

use super::bernstein::{Arc, Piece, isolate};
use super::projective::Point;
use super::turning_body::Cone;
use arrayvec::ArrayVec;
use aspecta_robot::num::{Ball, Interval, Scalar, dot};
use aspecta_robot::{Frame, crank_frame, rail_frame};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion};

/// Bernstein coefficients of degree 2, on half a circle, of what is affine in cos a and sin a: times (1 −
/// τ)² + τ², with cos a = 2(1 − τ)τ / …, sin a = (τ² − (1 − τ)²) / ….
type Quadratic = [Ball; 3];

/// The lines of legs 2 and 3 over half a circle of a: (α, β, γ).
type Lines = [[Quadratic; 3]; 2];

/// One choice of frames.
struct Sweep {
    base: [[Ball; 3]; 3],
    platform: [[Ball; 3]; 3],
    tilt: [Ball; 2],
}

impl Sweep {
    /// With a = 0 where a base vector says; `None` if that one is along w₁.
    fn new(first: &Cone, zero: usize) -> Option<Self> {
        let cos = Ball::constant(first.cosine);
        let mut direction = [Interval::point(0.0); 3];
        direction[zero] = Interval::point(1.0);
        let [u, v, w] = crank_frame(&first.w, &direction)?;
        let balls = |frame: Frame| frame.map(|axis| axis.map(Ball::constant));
        Some(Self {
            base: balls([w, u, v]),
            platform: balls(rail_frame(&first.v, 3)?),
            tilt: [cos, (Ball::point(1.0) - cos.square()).sqrt()],
        })
    }

    /// On the half circle about a = 0, or about a = π.
    fn line(&self, cone: &Cone, opposite: bool) -> [Quadratic; 3] {
        let w = self.base.map(|axis| dot(&axis, &cone.w.map(Ball::constant)));
        let v = self.platform.map(|axis| dot(&axis, &cone.v.map(Ball::constant)));
        let side = |q: Quadratic| if opposite { q.map(|x| -x) } else { q };
        // R_x(−a) w.
        let x = [[w[0], Ball::point(0.0), w[0]], side([-w[2], w[1], w[2]]), side([w[1], w[2], -w[1]])];
        let [c, s] = self.tilt;
        let y = [combine(c, &x[0], s, &x[1]), combine(c, &x[1], -s, &x[0]), x[2]];
        let right = [cone.cosine.into(), Ball::point(0.0), cone.cosine.into()];
        [
            combine(v[1], &y[1], v[2], &y[2]),
            combine(v[1], &y[2], -v[2], &y[1]),
            combine(Ball::point(1.0), &right, -v[0], &y[0]),
        ]
    }

    /// The quaternion of R at an angle a, from the lines there.
    fn orientation(&self, lines: &Lines, tau: f64, opposite: bool) -> Point<4> {
        let (x, y) = (1.0 - tau, tau);
        let at = |q: &Quadratic| q[0].mid * x * x + 2.0 * q[1].mid * x * y + q[2].mid * y * y;
        let [[a2, b2, c2], [a3, b3, c3]] = lines.each_ref().map(|line| line.each_ref().map(at));
        let b = ((a2 * c3 - a3 * c2) * (a2 * b3 - a3 * b2)).atan2((c2 * b3 - c3 * b2) * (a2 * b3 - a3 * b2));
        let side = if opposite { -1.0 } else { 1.0 };
        let a = (side * (y * y - x * x)).atan2(side * 2.0 * x * y);
        let about = |axis, angle| Rotation3::from_axis_angle(&axis, angle).into_inner();
        let [first, third] = [nalgebra::Vector3::x_axis(), nalgebra::Vector3::z_axis()];
        let columns = |f: &[[Ball; 3]; 3]| Matrix3::from_fn(|i, k| f[k][i].mid);
        let tilt = about(third, self.tilt[1].mid.atan2(self.tilt[0].mid));
        let r = columns(&self.base)
            * about(first, a)
            * tilt
            * about(first, b)
            * columns(&self.platform).transpose();
        let e = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(r));
        Point::real([e.w, e.i, e.j, e.k])
    }
}

/// s a + t b.
fn combine(s: Ball, a: &Quadratic, t: Ball, b: &Quadratic) -> Quadratic {
    std::array::from_fn(|k| s * a[k] + t * b[k])
}

/// The product of polynomials of degrees A − 1 and B − 1, in Bernstein form.
fn product<const A: usize, const B: usize, const C: usize>(a: &[Ball; A], b: &[Ball; B]) -> [Ball; C] {
    let choose = |n: usize, k: usize| (0..k).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64);
    let mut sum = [Ball::point(0.0); C];
    for i in 0..A {
        for j in 0..B {
            let weight =
                Interval::point(choose(A - 1, i) * choose(B - 1, j)) / Interval::point(choose(C - 1, i + j));
            sum[i + j] = sum[i + j] + (a[i] * b[j]).scale(weight);
        }
    }
    sum
}

/// F on half a circle, times ((1 − τ)² + τ²)⁴.
fn eliminant(lines: &Lines) -> [Ball; 9] {
    let [[a2, b2, c2], [a3, b3, c3]] = lines;
    let minor = |p: &Quadratic, q: &Quadratic, r: &Quadratic, s: &Quadratic| -> [Ball; 5] {
        let (one, other): ([Ball; 5], [Ball; 5]) = (product(p, q), product(r, s));
        std::array::from_fn(|k| one[k] - other[k])
    };
    let square = |p: [Ball; 5]| product::<5, 5, 9>(&p, &p);
    let [cos, sin, norm] = [minor(c2, b3, c3, b2), minor(a2, c3, a3, c2), minor(a2, b3, a3, b2)].map(square);
    std::array::from_fn(|k| cos[k] + sin[k] - norm[k])
}

/// Returns all orientations, approximately, as quaternions: as many as there are, proved. `None` if some
/// meet, or cannot be told from it, on the cone of every leg.
pub(super) fn sweep(cones: &[Cone; 3]) -> Option<ArrayVec<Point<4>, 16>> {
    (0..3).find_map(|first| {
        let order = [first, (first + 1) % 3, (first + 2) % 3].map(|k| cones[k]);
        // Cut elsewhere if a zero sits on a cut.
        (0..2).find_map(|zero| all_on(&order, &Sweep::new(&order[0], zero)?))
    })
}

fn all_on(cones: &[Cone; 3], sweep: &Sweep) -> Option<ArrayVec<Point<4>, 16>> {
    let mut found = ArrayVec::new();
    for opposite in [false, true] {
        let lines: Lines = [1, 2].map(|k| sweep.line(&cones[k], opposite));
        let coefficients = eliminant(&lines);
        let slack = coefficients.iter().map(|c| c.rad).fold(0.0, f64::max);
        let whole = Arc::new(coefficients.map(|c| c.mid), slack);
        // Else a zero may be counted on both halves, or on none.
        if !whole.has_decided_ends() {
            return None;
        }
        for piece in &isolate(whole) {
            let Piece::Root(arc) = piece else { return None };
            found.push(sweep.orientation(&lines, arc.root(1e-15), opposite));
        }
    }
    Some(found)
}
