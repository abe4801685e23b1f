//! The leg frames of a robot file: orthonormal frames and directions from vectors of any length.
//!
//! The arithmetic here keeps what is exact exact. Enclosures that are single doubles are added,
//! multiplied, divided and rooted without being widened wherever the double result is the true one, so
//! an axis-aligned direction has entries 0 and ±1, which cost the kinematics nothing, and (3, 4) has
//! length 5.

use super::leg::Frame;
use crate::num::{Interval, Scalar};

const O: Interval = Interval::point(0.0);
const I: Interval = Interval::point(1.0);

/// Below this magnitude the rounding error of a product may itself underflow and pass for zero.
const TINY: f64 = 1e-280;

/// The double behind a single-double enclosure.
fn single(a: Interval) -> Option<f64> {
    (a.lo == a.hi && a.lo.is_finite()).then_some(a.lo)
}

/// a + b, exact where the double sum is: where the rounding error of TwoSum is zero.
pub(super) fn sum(a: Interval, b: Interval) -> Interval {
    if let (Some(x), Some(y)) = (single(a), single(b)) {
        let s = x + y;
        let t = s - x;
        if (x - (s - t)) + (y - t) == 0.0 {
            return Interval::point(s);
        }
    }
    match (a == O, b == O) {
        (true, _) => b,
        (_, true) => a,
        _ => a + b,
    }
}

/// a · b, exact where the double product is: where its fused residual xy − p is zero.
pub(super) fn product(a: Interval, b: Interval) -> Interval {
    if a == O || b == O {
        return O;
    }
    if let (Some(x), Some(y)) = (single(a), single(b)) {
        let p = x * y;
        if p.abs() > TINY && x.mul_add(y, -p) == 0.0 {
            return Interval::point(p);
        }
    }
    match (single(a), single(b)) {
        (Some(1.0), _) => b,
        (_, Some(1.0)) => a,
        (Some(-1.0), _) => -b,
        (_, Some(-1.0)) => -a,
        _ => a * b,
    }
}

/// a / b, exact where the double quotient is: where q b = a, by the fused residual.
fn quotient(a: Interval, b: Interval) -> Interval {
    if a == O {
        return O;
    }
    if let (Some(x), Some(y)) = (single(a), single(b)) {
        let q = x / y;
        if x.abs() > TINY && q.mul_add(y, -x) == 0.0 {
            return Interval::point(q);
        }
    }
    a / b
}

/// √a, exact where the double root is.
fn root(a: Interval) -> Interval {
    if let Some(x) = single(a) {
        let r = x.sqrt();
        if x > TINY && r.mul_add(r, -x) == 0.0 {
            return Interval::point(r);
        }
    }
    a.sqrt()
}

fn difference(a: Interval, b: Interval) -> Interval {
    sum(a, -b)
}

pub(super) fn dot(a: &[Interval; 3], b: &[Interval; 3]) -> Interval {
    (0..3).fold(O, |s, k| sum(s, product(a[k], b[k])))
}

fn cross(a: &[Interval; 3], b: &[Interval; 3]) -> [Interval; 3] {
    let minor = |i: usize, j: usize| difference(product(a[i], b[j]), product(a[j], b[i]));
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// v / ‖v‖, or `None` if v is not provably different from zero.
pub(super) fn unit(v: &[Interval; 3]) -> Option<[Interval; 3]> {
    let mut others = (0..3).filter(|&k| v[k] != O);
    if let (Some(k), None) = (others.next(), others.next()) {
        let mut e = [O; 3];
        e[k] = if v[k].is_positive() { I } else { -I };
        return (v[k].sign() != 0).then_some(e);
    }
    let square = dot(v, v);
    let norm = root(square);
    (square.is_positive() && norm.is_positive()).then(|| v.map(|x| quotient(x, norm)))
}

/// The frame of a crank that turns about `axis` and points, at q = 0, along the part of `zero` across it:
/// w = axis / ‖axis‖, u the direction of zero − (zero·w) w, v = w × u. `None` if either is zero or they
/// are parallel, as far as can be proved.
///
/// v is the direction of axis × zero and u that of (axis × zero) × axis: what lies along the axis cancels
/// before it is computed, and small integers stay exact.
pub fn crank_frame(axis: &[Interval; 3], zero: &[Interval; 3]) -> Option<Frame> {
    let side = cross(axis, zero);
    Some([unit(&cross(&side, axis))?, unit(&side)?, unit(axis)?])
}

/// A right-handed frame whose u is along `direction`; in the plane v is u turned by +90°. `None` if
/// `direction` is zero.
pub fn rail_frame(direction: &[Interval; 3], space: usize) -> Option<Frame> {
    let d = direction;
    if space == 2 {
        let u = unit(d)?;
        return Some([u, [-u[1], u[0], O], [O, O, I]]);
    }
    // Crossed with the base vector that is most nearly perpendicular, for well-conditioned v and w.
    let size = |k: usize| d[k].magnitude();
    let k = (0..3).fold(0, |best, k| if size(k) < size(best) { k } else { best });
    let mut e = [O; 3];
    e[k] = I;
    let w = cross(d, &e);
    Some([unit(d)?, unit(&cross(&w, d))?, unit(&w)?])
}

/// A base vector in a frame.
pub(super) fn into(frame: &Frame, v: &[Interval; 3]) -> [Interval; 3] {
    std::array::from_fn(|k| dot(&frame[k], v))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn exact(v: [f64; 3]) -> [Interval; 3] {
        v.map(Interval::point)
    }

    #[test]
    fn axis_aligned_frames_are_exact() {
        for k in 0..3 {
            for sign in [1.0, -1.0] {
                let mut d = [0.0; 3];
                d[k] = 2.5 * sign;
                let entries =
                    |f: Frame| f.concat().iter().all(|x| [-1.0, 0.0, 1.0].contains(&x.lo) && x.lo == x.hi);
                assert!(entries(rail_frame(&exact(d), 3).unwrap()));
                let mut z = [0.7; 3];
                z[(k + 1) % 3] = 0.0;
                assert!(entries(crank_frame(&exact(d), &exact(z)).unwrap()));
            }
        }
        let diagonal = crank_frame(&exact([1.0, 1.0, 0.0]), &exact([1.0, 0.0, 0.0])).unwrap();
        assert_eq!(diagonal[1], exact([0.0, 0.0, -1.0]));
        assert_eq!((diagonal[0][2], diagonal[2][2]), (O, O));
    }

    #[test]
    fn three_four_five() {
        let u = unit(&exact([3.0, 4.0, 0.0])).unwrap();
        assert_eq!(
            u,
            [Interval::point(3.0) / Interval::point(5.0), Interval::point(4.0) / Interval::point(5.0), O]
        );
        assert_eq!(root(Interval::point(25.0)), Interval::point(5.0));
    }

    #[test]
    fn zero_and_parallel_vectors_have_no_frame() {
        assert!(unit(&exact([0.0; 3])).is_none());
        assert!(crank_frame(&exact([1.0, 2.0, 3.0]), &exact([2.0, 4.0, 6.0])).is_none());
        let decimal = |v: [f64; 3]| v.map(Interval::decimal);
        assert!(crank_frame(&decimal([0.1, 0.2, 0.3]), &decimal([0.2, 0.4, 0.6])).is_none());
    }

    proptest! {
        /// Each entry is narrow about the number computed by plain doubles, and the rows are orthonormal.
        #[test]
        fn frames_enclose_the_orthonormal_frame(
            a in prop::array::uniform3(-9.0..9.0f64), z in prop::array::uniform3(-9.0..9.0f64),
        ) {
            let n = nalgebra::Vector3::from(a);
            let zero = nalgebra::Vector3::from(z);
            let sine = n.cross(&zero).norm() / (n.norm() * zero.norm());
            prop_assume!(n.norm() > 1e-3 && zero.norm() > 1e-3 && sine > 1e-2);
            let w = n.normalize();
            let u = (zero - w * w.dot(&zero)).normalize();
            let rows = [u, w.cross(&u), w];
            let frame = crank_frame(&exact(a), &exact(z)).unwrap();
            let rail = rail_frame(&exact(a), 3).unwrap();
            for i in 0..3 {
                for j in 0..3 {
                    prop_assert!((frame[i][j].mid() - rows[i][j]).abs() < 1e-12 && frame[i][j].width() < 1e-12);
                    let d = if i == j { 1.0 } else { 0.0 };
                    prop_assert!((dot(&frame[i], &frame[j]) - Interval::point(d)).contains(0.0));
                    prop_assert!((dot(&rail[i], &rail[j]) - Interval::point(d)).contains(0.0));
                }
            }
            let hand = dot(&cross(&rail[0], &rail[1]), &rail[2]);
            prop_assert!(hand.contains(1.0) && (rail[0][0].mid() - w[0]).abs() < 1e-12);
        }

        /// sum and product are never narrower than the truth: they agree with the widened operations.
        #[test]
        fn exact_operations_lie_in_the_widened_ones(x in -1e6..1e6f64, y in -1e6..1e6f64) {
            let (a, b) = (Interval::point(x), Interval::point(y));
            for (narrow, wide) in [(sum(a, b), a + b), (product(a, b), a * b), (quotient(a, b), a / b)] {
                prop_assert!(wide.lo <= narrow.lo && narrow.hi <= wide.hi);
            }
            let p = x * y;
            prop_assert_eq!(product(a, b).lo == product(a, b).hi, x.mul_add(y, -p) == 0.0);
        }
    }
}
