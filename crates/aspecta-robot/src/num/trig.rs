//! sin, cos and the angle of a vector, to within the neighbouring doubles.
//!
//! **Theorem.** The exact sin x, cos x (|x| < 10⁹) and atan2(y, x) lie between the two neighbours of the
//! double that is returned here. So what [`Interval`](super::Interval) makes of it, x ∓ (|x|φ + η), encloses
//! them.
//!
//! *Lemma.* Let h be v′ rounded to nearest and |v − v′| ≤ ½u|v|(1 − 4u), u = 2⁻⁵³. Then v lies between the
//! neighbours of h: these are at least u|h| away, v′ is within half that distance of h, and v within the
//! other half of v′. The bounds below are ¼u or less.
//!
//! Everything is additions, multiplications, divisions of doubles, each correctly rounded as IEEE 754 has it.
//! A pair (h, l) stands for h + l. What [`super::exact`] does is exact. Errors are given in multiples of u.
//!
//! *Reduction.* k is x·2/π to the nearest integer, |k| < 2^29.3, but for an error of 2⁻²²: |x − kπ/2| <
//! 0.7855. Let k ≠ 0, x > 0.
//! - x − k Q₀ is exact (Sterbenz): the two are within a factor two of each other. For k = 1 that needs x ≥
//!   Q₀/2, and x·2/π was not below ½, so x ≥ (1 − 4u)π/4, while Q₀ < (1 − 2⁻²⁵)π/2.
//! - Less k Q₁ it is exact: a multiple of 2⁻⁵³ (x is one, from ½ on) below 1.
//! - k Q₂ = p + e exactly. e + k Q₃ is below 2⁻⁷⁰, so its roundings and the rest of π/2 are below 2⁻¹²¹; the
//!   sum with the rounding error of the difference adds u²|r|. No double is closer to a multiple of π/2 than
//!   2⁻⁶¹ (Kahan 1983; Muller, *Elementary Functions*, 2016, table 11.1; here, from 29 π/2, 2^−60.5). So r +
//!   ρ is the angle to a relative 2⁻⁵⁹, which changes sine and cosine by as much at most, and r has its sign:
//!   0.016.
//!
//! *Sine* of r + ρ, relative to |r|; z + δ = r² exactly, z ≤ 0.617; m + μ = (z + δ)/6. sin r = r − r(m + μ) +
//! r z² S(z).
//! - The alternating series ends with z⁸/17!; what is left out is below z⁹/19!: 0.001.
//! - S ≤ 1/120 errs by a relative 2.1 (its first coefficient and the last sum; the rest is small), z² and the
//!   product by one each, and δ, left out, makes 2: 6.1 · z²/120 ≤ 0.020.
//! - Five roundings of numbers below z²/120 |r| follow: 0.016. r m = p + π exactly, and r − p is split
//!   exactly.
//! - sin(r + ρ) = sin r + ρ cos r to ρ², with 1 − z/2 for cos r, which differ by z²/24: 0.016.
//!
//! Together 0.053, and sin r > 0.9 |r|: 0.06, with the reduction's 0.016 less than 0.08.
//!
//! *Cosine*, absolute. cos r = 1 − (z + δ)/2 + z² C(z); 1 − z/2 is split exactly.
//! - The alternating series ends with z⁹/18!; what is left out is below z¹⁰/20!: 0.001.
//! - C ≤ 1/24 errs as S does: 6.1 · z²/24 ≤ 0.097.
//! - Three roundings of numbers below z²/24: 0.048. − ρ sin r, with r − p for sin r, which differ by z²/120
//!   |r|: 0.003.
//!
//! Together 0.149, and cos r > 0.707: 0.211, with the reduction's 0.016 less than 0.23.
//!
//! *Angle* θ of a/b, 0 < a < b, relative. With c the nearest quarter, w = (a − cb)/(b + ca) is a tangent |w|
//! ≤ ⅛, and θ = atan c + atan w. Where a/b < 2⁻²⁷ it is a/b itself, but for t²/3 ≤ 0.17.
//! - w + ω is the quotient of sums without error, to u². atan w = w − w³ P(w²) ends with w¹⁹/19; left out is
//!   below w²¹/21: 0.001.
//! - P ≤ ⅓ errs by 2.1, w², w w² and the product by one each, and ω, left out, makes 3: 8.1 · w²/3 ≤ 0.043.
//! - Three roundings of numbers below w³/3: 0.016.
//!
//! Together 0.06, relative to |w| ≤ 1.01 θ. Measured from 0, π/2 or π the angle is θ or more, and π/2 and π
//! are pairs: no more is lost.
//!
//! *Underflow* adds 2⁻¹⁰⁷⁵ to what an operation errs by. Where r² underflows to 0, so do all corrections, and
//! sin r is r; where it does not, |r| > 2⁻⁵³⁸, of which u² is more. In the angle, a and b are scaled.

use super::exact::{fast_two_sum, two_product, two_sum};
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, PI};

/// [`sin_cos`] takes angles below this.
pub(super) const MOST_ANGLE: f64 = 1e9;

/// π/2 = Q₀ + Q₁ + Q₂ + Q₃ to 2⁻¹⁵⁹. Q₀ and Q₁ have no bits below 2⁻²² and 2⁻⁴⁵: their products with integers
/// below 2³⁰ are exact.
const QUARTER: [f64; 4] =
    [1.570_796_251_296_997, 7.549_789_415_861_596e-8, 5.390_302_858_158_119e-15, 8.478_427_660_368_9e-32];

/// 1/6, a pair.
const SIXTH: (f64, f64) = (1.0 / 6.0, 9.251_858_538_542_97e-18);

/// S(z) = 1/5! − z/7! + …
const SINE: [f64; 7] = [
    1.0 / 120.0,
    -1.0 / 5040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
    -1.0 / 1_307_674_368_000.0,
    1.0 / 355_687_428_096_000.0,
];

/// C(z) = 1/4! − z/6! + …
const COSINE: [f64; 8] = [
    1.0 / 24.0,
    -1.0 / 720.0,
    1.0 / 40_320.0,
    -1.0 / 3_628_800.0,
    1.0 / 479_001_600.0,
    -1.0 / 87_178_291_200.0,
    1.0 / 20_922_789_888_000.0,
    -1.0 / 6_402_373_705_728_000.0,
];

/// P(z) = 1/3 − z/5 + …
const TANGENT: [f64; 9] = [
    1.0 / 3.0,
    -1.0 / 5.0,
    1.0 / 7.0,
    -1.0 / 9.0,
    1.0 / 11.0,
    -1.0 / 13.0,
    1.0 / 15.0,
    -1.0 / 17.0,
    1.0 / 19.0,
];

/// atan 0, ¼, ½, ¾ and 1, pairs.
const ANGLES: [(f64, f64); 5] = [
    (0.0, 0.0),
    (0.244_978_663_126_864_14, 1.069_875_561_873_445_1e-17),
    (0.463_647_609_000_806_1, 2.269_877_745_296_168_7e-17),
    (0.643_501_108_793_284_4, 1.583_478_505_144_428_6e-17),
    (FRAC_PI_4, 3.061_616_997_868_383e-17),
];

/// The sine and the cosine of an angle, and where it lies among the multiples of π/2.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turned {
    /// The exact sine lies between the neighbours of this one; it is zero for the angle zero alone.
    pub sin: f64,
    /// The exact cosine lies between the neighbours of this one.
    pub cos: f64,
    /// The greatest multiple of π/2 at or below the angle.
    pub floor: i64,
    /// The least multiple of π/2 at or above the angle.
    pub ceil: i64,
}

/// Returns sine and cosine of an angle, |x| < [`MOST_ANGLE`]. Free of branches, for packs.
#[inline(always)]
pub(super) fn sin_cos(x: f64) -> Turned {
    /// 1.5 · 2⁵²: a sum with it is rounded to an integer, which the last bits of the sum are.
    const UNITS: f64 = 6_755_399_441_055_744.0;
    let shifted = x * FRAC_2_PI + UNITS;
    let (k, turns) = (shifted - UNITS, shifted.to_bits() as i64 - UNITS.to_bits() as i64);
    let (p, e) = two_product(k, QUARTER[2]);
    let (r, rounded) = two_sum((x - k * QUARTER[0]) - k * QUARTER[1], -p);
    let (r, rest) = fast_two_sum(r, rounded - (e + k * QUARTER[3]));
    let (sin, cos) = sin_cos_near_zero(r, rest);
    let (s, c) = if turns & 1 == 0 { (sin, cos) } else { (cos, sin) };
    Turned {
        sin: if turns & 2 == 0 { s } else { -s },
        cos: if (turns + 1) & 2 == 0 { c } else { -c },
        floor: turns - i64::from(r < 0.0),
        ceil: turns + i64::from(r > 0.0),
    }
}

/// Returns sine and cosine of r + ρ within an eighth of a turn of 0.
#[inline(always)]
fn sin_cos_near_zero(r: f64, rho: f64) -> (f64, f64) {
    let (z, dz) = two_product(r, r);
    let (c, dc) = fast_two_sum(1.0, -0.5 * z);
    let dc = dc + (z * z * polynomial(&COSINE, z) - 0.5 * dz);
    let (m, dm) = two_product(z, SIXTH.0);
    let dm = dm + (z * SIXTH.1 + dz * SIXTH.0);
    let (p, dp) = two_product(r, m);
    let (s, ds) = fast_two_sum(r, -p);
    let ds = ds + (r * (z * z * polynomial(&SINE, z) - dm) - dp);
    (s + (ds + rho * c), c + (dc - rho * s))
}

/// Returns the angle of the vector (x, y), as C's atan2 has it: in [−π, π], of the sign of y also where y is
/// a zero; between the neighbours of what is returned lies the exact one.
pub(super) fn atan2(y: f64, x: f64) -> f64 {
    let steep = y.abs() > x.abs();
    let (angle, rest) = if steep { first_octant(x.abs(), y.abs()) } else { first_octant(y.abs(), x.abs()) };
    let back = x.is_sign_negative();
    let (base, rest_of_base) = match (steep, back) {
        (false, false) => (0.0, 0.0),
        (true, _) => (FRAC_PI_2, 6.123_233_995_736_766e-17),
        (false, true) => (PI, 1.224_646_799_147_353_2e-16),
    };
    let (angle, rest) = if steep == back { (angle, rest) } else { (-angle, -rest) };
    let (sum, rounded) = two_sum(base, angle);
    (sum + (rounded + (rest_of_base + rest))).copysign(y)
}

/// Returns the angle whose tangent is a/b, 0 ≤ a ≤ b, as a pair.
fn first_octant(a: f64, b: f64) -> (f64, f64) {
    if a == b {
        return ANGLES[if a == 0.0 { 0 } else { 4 }];
    }
    let tangent = a / b;
    if tangent < power(-27) {
        return (tangent, 0.0);
    }
    let scale = match b {
        b if b > power(500) => power(-600),
        b if b < power(-400) => power(600),
        _ => 1.0,
    };
    let (a, b) = (a * scale, b * scale);
    let quarter = (4.0 * tangent + 0.5) as usize;
    let c = 0.25 * quarter as f64;
    let (cb, dcb) = two_product(c, b);
    let (ca, dca) = two_product(c, a);
    let (n, dn) = two_sum(a, -cb);
    let (d, dd) = fast_two_sum(b, ca);
    let w = n / d;
    let (wd, dwd) = two_product(w, d);
    let dw = (((n - wd) - dwd) + ((dn - dcb) - w * (dd + dca))) / d;
    let z = w * w;
    let (sum, rounded) = fast_two_sum(ANGLES[quarter].0, w);
    (sum, rounded + (ANGLES[quarter].1 + (dw - w * z * polynomial(&TANGENT, z))))
}

/// Returns c₀ + c₁ z + c₂ z² + …, by Horner's rule.
#[inline(always)]
fn polynomial<const K: usize>(c: &[f64; K], z: f64) -> f64 {
    let mut sum = c[K - 1];
    for k in (0..K - 1).rev() {
        sum = sum * z + c[k];
    }
    sum
}

/// Returns 2ⁿ for a normal double.
const fn power(n: i32) -> f64 {
    f64::from_bits(((1023 + n) as u64) << 52)
}

#[cfg(test)]
mod tests;
