//! A generic system of the family of six legs, with its 40 common points.

use crate::direct::projective::{Point, Quadrics};
use nalgebra::Complex;
use std::sync::LazyLock;

/// Numbers, one complex number a pair: a line of coefficients a leg, then a line of eight coordinates a
/// point. Written by the test `tests::the_start_system_is_found_from_one_point`.
const DATA: &str = include_str!("start.txt");

type Start = (Quadrics<8, 7>, Vec<Point<8>>);

static START: LazyLock<Start> = LazyLock::new(|| {
    let mut lines = DATA.lines().map(|line| {
        let numbers: Vec<f64> = line.split(' ').filter_map(|word| word.parse().ok()).collect();
        numbers.chunks(2).map(|z| Complex::new(z[0], z[1])).collect::<Vec<_>>()
    });
    let legs: Vec<_> = lines.by_ref().take(6).collect();
    let points = lines.map(|z| Point::from_fn(|k| z[k])).collect();
    (member(&legs), points)
});

pub(super) fn system() -> &'static Quadrics<8, 7> {
    &START.0
}

pub(super) fn points() -> &'static [Point<8>] {
    &START.1
}

/// The member of the family with these coefficients, 17 a leg: of the ten products of the eᵢ, of six eᵢ gⱼ −
/// eⱼ gᵢ, and of g · g; and the Study quadric.
fn member(legs: &[Vec<Complex<f64>>]) -> Quadrics<8, 7> {
    let mut system = Quadrics::ZERO;
    for (form, leg) in system.forms.iter_mut().zip(legs) {
        let mut z = leg.iter().copied();
        let mut set = |i: usize, j: usize, z: Complex<f64>| {
            for (i, j) in [(i, j), (j, i)] {
                (form[i].re[j], form[i].im[j]) = (z.re, z.im);
            }
        };
        for i in 0..4 {
            for j in 0..=i {
                set(i, j, z.next().unwrap_or_default());
            }
        }
        for i in 0..4 {
            for j in 0..i {
                let z = z.next().unwrap_or_default();
                set(i, j + 4, z);
                set(j, i + 4, -z);
            }
        }
        let square = z.next().unwrap_or_default();
        (0..4).for_each(|i| set(i + 4, i + 4, square));
    }
    for i in 0..4 {
        system.forms[6][i].re[i + 4] = 1.0;
        system.forms[6][i + 4].re[i] = 1.0;
    }
    system
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::direct::projective::{Family, Pace, Tracker, polish};
    use aspecta_robot::num::Random;

    const COEFFICIENTS: usize = 17;

    fn complex(random: &mut Random) -> Complex<f64> {
        Complex::new(random.within((-1.0, 1.0)), random.within((-1.0, 1.0)))
    }

    fn random_legs(random: &mut Random) -> Vec<Vec<Complex<f64>>> {
        (0..6).map(|_| (0..COEFFICIENTS).map(|_| complex(random)).collect()).collect()
    }

    /// A generic system and a point of it: the six coefficients of g · g are chosen so that it is one.
    fn seed(random: &mut Random) -> (Vec<Vec<Complex<f64>>>, Point<8>) {
        let mut x = Point::<8>::from_fn(|_| Complex::default());
        for k in 0..8 {
            let z = complex(random);
            (x.re[k], x.im[k]) = (z.re, z.im);
        }
        let dot: Complex<f64> = (1..4).map(|k| x.get(k) * x.get(k + 4)).sum();
        let g0 = -dot / x.get(0);
        (x.re[4], x.im[4]) = (g0.re, g0.im);
        let mut legs = random_legs(random);
        legs.iter_mut().for_each(|leg| leg[COEFFICIENTS - 1] = Complex::default());
        let values = member(&legs).at(&x).values;
        let square: Complex<f64> = (4..8).map(|k| x.get(k) * x.get(k)).sum();
        legs.iter_mut().zip(values).for_each(|(leg, v)| leg[COEFFICIENTS - 1] = -v / square);
        (legs, x)
    }

    /// Monodromy: along loops of systems through generic ones the points of a system change places, until all
    /// have been met.
    fn all_points(base: &Quadrics<8, 7>, first: Point<8>, random: &mut Random) -> Vec<Point<8>> {
        let mut points = vec![polish(base, first)];
        for _ in 0..40 {
            let loop_of = [member(&random_legs(random)), member(&random_legs(random))];
            let stations = [base, &loop_of[0], &loop_of[1], base];
            for k in 0..points.len() {
                let mut x = points[k];
                let mut arrived = true;
                for pair in stations.windows(2) {
                    let end =
                        Tracker::new(Family { start: pair[0], target: pair[1] }).follow(&x, Pace::CAREFUL);
                    x = end.point;
                    arrived &= end.arrived;
                }
                let new = |y: &Point<8>| 1.0 - y.conjugate().dot(&x).norm_sqr() > 1e-8;
                if arrived && points.iter().all(new) {
                    points.push(x);
                }
            }
            if points.len() >= 40 {
                break;
            }
        }
        points
    }

    /// Writes start.txt where `ASPECTA_WRITE_START` is set, and else finds what is there.
    #[test]
    fn the_start_system_is_found_from_one_point() {
        let mut random = Random::new(1);
        let (legs, x) = seed(&mut random);
        let base = member(&legs);
        let found = all_points(&base, x, &mut random);
        assert_eq!(found.len(), 40);
        if std::env::var_os("ASPECTA_WRITE_START").is_some() {
            let line = |z: &mut dyn Iterator<Item = Complex<f64>>| {
                z.map(|z| format!("{} {}", z.re, z.im)).collect::<Vec<_>>().join(" ") + "\n"
            };
            let mut text: String = legs.iter().map(|leg| line(&mut leg.iter().copied())).collect();
            text += &found.iter().map(|x| line(&mut (0..8).map(|k| x.get(k)))).collect::<String>();
            let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/direct/free_body/start.txt");
            std::fs::write(path, text).unwrap();
            return;
        }
        let apart = |a: &Point<8>, b: &Point<8>| 1.0 - a.conjugate().dot(b).norm_sqr();
        for (k, x) in points().iter().enumerate() {
            assert!(system().at(x).values.iter().all(|v| v.norm() < 1e-13), "point {k}");
            assert!(points()[..k].iter().all(|other| apart(x, other) > 1e-8), "point {k}");
            assert!(found.iter().any(|other| apart(x, other) < 1e-12), "point {k}");
        }
    }
}
