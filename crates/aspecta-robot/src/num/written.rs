//! Numbers in messages.

use std::fmt::Display;

/// `1 box`, `2 boxes`: how many there are of what.
pub fn count<N: Display + PartialEq + From<u8>>(n: N, one: &str, many: &str) -> String {
    let what = if n == N::from(1) { one } else { many };
    format!("{n} {what}")
}

/// A number as people write it: plain, or with a power of ten where its digits would fill lines. Zero has no
/// sign.
pub fn written(x: f64) -> String {
    let size = x.abs();
    let plain = size == 0.0 || (1e-9..1e16).contains(&size) || !x.is_finite();
    if plain { (x + 0.0).to_string() } else { format!("{x:e}") }
}

#[cfg(test)]
mod tests {
    use super::{count, written};

    #[test]
    fn one_is_no_plural() {
        let counted = [0usize, 1, 2, 11].map(|n| count(n, "leaf", "leaves"));
        assert_eq!(counted, ["0 leaves", "1 leaf", "2 leaves", "11 leaves"]);
    }

    #[test]
    fn no_number_fills_lines() {
        let cases = [
            (8.0, "8"),
            (-0.5, "-0.5"),
            (-0.0, "0"),
            (123456789.25, "123456789.25"),
            (1e300, "1e300"),
            (-1.5e16, "-1.5e16"),
            (f64::MIN_POSITIVE, "2.2250738585072014e-308"),
            (f64::NAN, "NaN"),
            (f64::NEG_INFINITY, "-inf"),
        ];
        for (x, wanted) in cases {
            assert_eq!(written(x), wanted);
        }
    }
}
