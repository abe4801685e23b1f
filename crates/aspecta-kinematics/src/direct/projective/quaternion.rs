//! Rotations by quaternions e = (e₀, e₁, e₂, e₃), R(e) = N(e) / ‖e‖².

use aspecta_robot::num::{Interval, Scalar};

/// The symmetric matrix of the quadratic form w · N(e) v: ‖e‖² w · R v.
///
/// N(e) v = (e₀² − ε·ε) v + 2 (ε·v) ε + 2 e₀ ε × v with ε = (e₁, e₂, e₃).
pub(crate) fn turned_product(w: &[Interval; 3], v: &[Interval; 3]) -> [[Interval; 4]; 4] {
    let dot = w[0] * v[0] + w[1] * v[1] + w[2] * v[2];
    let mut m = [[Interval::point(0.0); 4]; 4];
    m[0][0] = dot;
    for i in 0..3 {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        // ε × v · w = ε · (v × w).
        let cross = v[j] * w[k] - v[k] * w[j];
        (m[0][i + 1], m[i + 1][0]) = (cross, cross);
        m[i + 1][i + 1] = w[i] * v[i] - w[j] * v[j] - w[k] * v[k];
        let mixed = w[i] * v[j] + w[j] * v[i];
        (m[i + 1][j + 1], m[j + 1][i + 1]) = (mixed, mixed);
    }
    m
}

/// R(e), row by row.
pub(crate) fn rotation<T: Scalar>(e: [T; 4]) -> [[T; 3]; 3] {
    let [a, b, c, d] = e;
    let norm = a.square() + b.square() + c.square() + d.square();
    let twice = |x: T| x + x;
    let rows = [
        [a.square() + b.square() - c.square() - d.square(), twice(b * c - a * d), twice(b * d + a * c)],
        [twice(b * c + a * d), a.square() - b.square() + c.square() - d.square(), twice(c * d - a * b)],
        [twice(b * d - a * c), twice(c * d + a * b), a.square() - b.square() - c.square() + d.square()],
    ];
    rows.map(|row| row.map(|x| x / norm))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::placement::{Placement, roll_pitch_yaw};
    use aspecta_robot::Platform;
    use aspecta_robot::num::{Interval, dot};
    use proptest::prelude::*;

    fn unit(e: [f64; 4]) -> [f64; 4] {
        let norm = e.iter().map(|x| x * x).sum::<f64>().sqrt();
        e.map(|x| x / norm)
    }

    proptest! {
        #[test]
        fn the_form_is_the_product_with_the_turned_vector(
            e in prop::array::uniform4(-1.0..1.0f64), w in prop::array::uniform3(-2.0..2.0f64),
            v in prop::array::uniform3(-2.0..2.0f64),
        ) {
            let norm: f64 = e.iter().map(|x| x * x).sum();
            prop_assume!(norm > 1e-3);
            let m = turned_product(&w.map(Interval::point), &v.map(Interval::point));
            let form: f64 = (0..4).flat_map(|i| (0..4).map(move |j| (i, j))).map(|(i, j)| m[i][j].mid() * e[i] * e[j]).sum();
            let turned = rotation(e).map(|row| dot(&row, &v));
            prop_assert!((form / norm - dot(&w, &turned)).abs() < 1e-12);
        }

        #[test]
        fn angles_give_the_rotation_back(e in prop::array::uniform4(-1.0..1.0f64), pole in 0..3usize) {
            prop_assume!(e.iter().map(|x| x * x).sum::<f64>() > 1e-3);
            // Also next to the pole, where R₃₁ = 2(e₁e₃ − e₀e₂) = ±1.
            let tilt = [0.0, 1e-9, 1.0][pole];
            let e = unit([e[0], e[1] * tilt, e[0] + tilt * e[2], tilt * e[3]]);
            let r = rotation(e);
            let angles = roll_pitch_yaw(&r);
            let placed = Placement::<f64, 3>::at(Platform::TurningBody, &angles);
            let back = placed.rotation().unwrap();
            for i in 0..3 {
                for j in 0..3 {
                    prop_assert!((back[i][j] - r[i][j]).abs() < 1e-14, "{r:?} {angles:?}");
                }
            }
        }
    }
}
