//! Against core-math, whose functions are correctly rounded: the exact value lies within half an ulp of
//! theirs. The theorem says that it is rounded to another double than theirs at most one case in two, and
//! then to its neighbour, and that the enclosure made of ours holds the exact value.

use super::*;
use crate::num::{Interval, Random, Scalar};
use std::f64::consts::TAU;

/// `ASPECTA_CASES` sets the number of arguments of each function.
fn cases() -> u64 {
    std::env::var("ASPECTA_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(200_000)
}

/// A number of either sign whose magnitude is anything from 2^lo to 2^hi alike.
fn wide(random: &mut Random, lo: f64, hi: f64) -> f64 {
    let magnitude = random.within((lo, hi)).exp2();
    if random.below(2) == 0 { magnitude } else { -magnitude }
}

/// How many values are those correctly rounded, and how many their neighbours. There is nothing else.
#[derive(Debug)]
struct Agreement {
    /// The greatest value there is.
    most: f64,
    equal: u64,
    next: u64,
}

impl Agreement {
    fn up_to(most: f64) -> Self {
        Self { most, equal: 0, next: 0 }
    }

    /// Of a value and what is made of it with the value correctly rounded.
    fn compare(&mut self, found: f64, enclosure: Interval, rounded: f64, what: impl Fn() -> String) {
        let (below, above) = (rounded.next_down(), rounded.next_up());
        if found == rounded {
            self.equal += 1;
        } else {
            assert!(found == below || found == above, "{}: {found:e}, not {rounded:e}", what());
            self.next += 1;
        }
        let (lo, hi) = if found == rounded { (below, above) } else { (rounded, rounded) };
        let held = enclosure.lo <= lo.max(-self.most) && hi.min(self.most) <= enclosure.hi;
        let width = (enclosure.hi - enclosure.lo) / (above - rounded).max(rounded - below);
        assert!(held && width <= 4.0, "{}: {enclosure:?} for {rounded:e}", what());
    }

    /// The double that is returned is v ± ¼u|v|, rounded: seldom another one than v rounded.
    fn is_close(&self) {
        assert!(self.next * 50 < self.equal, "{self:?}");
    }
}

fn compare_sin_cos(x: f64, sin: &mut Agreement, cos: &mut Agreement) {
    let (turned, enclosures) = (sin_cos(x), Interval::point(x).sin_cos());
    sin.compare(turned.sin, enclosures.0, core_math::sin(x), || format!("sin {x:e}"));
    cos.compare(turned.cos, enclosures.1, core_math::cos(x), || format!("cos {x:e}"));
    // The quarter of the turn that the signs name.
    let quarter = match (core_math::sin(x) > 0.0, core_math::cos(x) > 0.0) {
        (true, true) => 0,
        (true, false) => 1,
        (false, false) => 2,
        (false, true) => 3,
    };
    assert_eq!((turned.floor & 3, turned.ceil), (quarter, turned.floor + 1), "{x:e}");
    assert!((x / FRAC_PI_2 - turned.floor as f64 - 0.5).abs() < 0.5 + 1e-6, "{x:e}");
}

#[test]
fn sine_and_cosine_are_next_to_those_correctly_rounded() {
    let (mut sin, mut cos) = (Agreement::up_to(1.0), Agreement::up_to(1.0));
    let mut random = Random::new(19);
    for case in 0..cases() {
        let x = match case % 8 {
            0 => random.within((-TAU, TAU)),
            1 => random.within((-0.8, 0.8)),
            2 => random.within((-MOST_ANGLE, MOST_ANGLE)),
            3 => wide(&mut random, -1.0, 29.89),
            4 => wide(&mut random, -60.0, 0.0),
            5 => wide(&mut random, -1074.0, -20.0),
            _ => {
                // Next to a multiple of π/2, half of them to one met in practice.
                let k = if case % 16 < 8 { random.below(1000) } else { random.below(636_000_000) };
                let x = k as f64 * FRAC_PI_2;
                [x, x.next_up(), x.next_down(), -x][random.below(4)]
            }
        };
        if x != 0.0 {
            compare_sin_cos(x, &mut sin, &mut cos);
        }
    }
    sin.is_close();
    cos.is_close();
}

/// The doubles next to multiples of π/2 (continued fractions of 2ⁿ π/2 yield them) and next to changes of k.
#[test]
fn the_reduction_holds_where_it_is_hardest() {
    let (mut sin, mut cos) = (Agreement::up_to(1.0), Agreement::up_to(1.0));
    let nearest = [
        45.553_093_477_052_0,
        std::f64::consts::FRAC_PI_2,
        4.712_388_980_384_69,
        46_067.145_922_642_23,
        321_308.748_563_287_7,
        1_698_673.283_033_208_5,
        14_461_176.671_140_78,
        925_515_306.953_009_9,
    ];
    let ends = (0..2000).map(|k| (f64::from(k) + 0.5) * FRAC_PI_2);
    let last =
        [f64::from_bits(1), f64::MIN_POSITIVE, power(-538), power(-400), power(-27), MOST_ANGLE.next_down()];
    for x in nearest.into_iter().chain(ends).chain(last) {
        for x in [x, x.next_up(), x.next_down()]
            .into_iter()
            .filter(|x| (f64::from_bits(1)..MOST_ANGLE).contains(x))
        {
            compare_sin_cos(x, &mut sin, &mut cos);
            compare_sin_cos(-x, &mut sin, &mut cos);
        }
    }
    sin.is_close();
    cos.is_close();
}

#[test]
fn angles_of_vectors_are_next_to_those_correctly_rounded() {
    let mut angles = Agreement::up_to(f64::INFINITY);
    let mut random = Random::new(20);
    for case in 0..cases() {
        let (y, x) = match case % 5 {
            0 => (random.within((-1.0, 1.0)), random.within((-1.0, 1.0))),
            1 => (wide(&mut random, -60.0, 60.0), wide(&mut random, -60.0, 60.0)),
            2 => (wide(&mut random, -1074.0, 1023.9), wide(&mut random, -1074.0, 1023.9)),
            3 => {
                // About the same magnitude, whatever it is.
                let scale = random.within((-1070.0, 1020.0)).exp2();
                (scale * wide(&mut random, -4.0, 3.0), scale * wide(&mut random, -4.0, 3.0))
            }
            _ => {
                // At a tangent where another entry of the table takes over, or at the entry.
                let x = wide(&mut random, -3.0, 3.0);
                let y = x * (random.below(9) as f64 / 8.0);
                [(y, x), (x, y.next_up()), (y.next_down(), -x), (-x, y)][random.below(4)]
            }
        };
        let enclosure =
            Interval::angle(Interval::point(x), Interval::point(y)).expect("a vector that does not vanish");
        angles.compare(atan2(y, x), enclosure, core_math::atan2(y, x), || format!("atan2({y:e}, {x:e})"));
    }
    angles.is_close();
}

#[test]
fn the_angle_zero_is_exact_and_angles_without_bound_are_any() {
    for zero in [0.0, -0.0] {
        assert_eq!(Interval::point(zero).sin_cos(), (Interval::point(0.0), Interval::point(1.0)));
    }
    let any = Interval::new(-1.0, 1.0);
    for x in [Interval::point(MOST_ANGLE), Interval::new(0.0, f64::INFINITY), Interval::ENTIRE] {
        assert_eq!(x.sin_cos(), (any, any));
    }
}

#[test]
fn zeros_and_infinities_have_the_angles_of_c() {
    let magnitudes = [0.0, f64::from_bits(1), f64::MIN_POSITIVE, 1.0, f64::MAX, f64::INFINITY];
    let all: Vec<f64> = magnitudes.into_iter().flat_map(|x| [x, -x]).collect();
    for &y in &all {
        for &x in &all {
            assert_eq!(atan2(y, x).to_bits(), core_math::atan2(y, x).to_bits(), "atan2({y:e}, {x:e})");
        }
    }
}
