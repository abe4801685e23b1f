//! Numbers in messages.

/// A number as people write it: plain, or with a power of ten where its digits would fill lines. Zero has no sign.
pub(crate) fn written(x: f64) -> String {
    let size = x.abs();
    let plain = size == 0.0 || (1e-9..1e16).contains(&size) || !x.is_finite();
    if plain { (x + 0.0).to_string() } else { format!("{x:e}") }
}

#[cfg(test)]
mod tests {
    use super::written;

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
