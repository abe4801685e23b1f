//! Sums and products of doubles with their rounding errors, which are doubles as well.
//!
//! No fused multiplication is asked for: baseline x86-64 and WebAssembly have none, and the call that
//! replaces it is slow.

/// Returns (s, e), s = x + y rounded and x + y = s + e exactly (TwoSum, Knuth 1969), barring overflow.
#[inline(always)]
pub(super) fn two_sum(x: f64, y: f64) -> (f64, f64) {
    let s = x + y;
    let b = s - x;
    (s, (x - (s - b)) + (y - b))
}

/// Returns the same in half the time where x = 0 or |x| ≥ |y| (Fast2Sum, Dekker 1971).
#[inline(always)]
pub(super) fn fast_two_sum(x: f64, y: f64) -> (f64, f64) {
    let s = x + y;
    (s, y - (s - x))
}

/// Returns (p, e), p = x y rounded and x y = p + e exactly (TwoProduct, Dekker 1971), for factors up to 2⁹⁹⁵
/// and products from 2⁻⁹⁶⁰ up to 2¹⁰²⁰ or exactly zero. Below, both are off by a few times 2⁻¹⁰⁷⁴.
#[inline(always)]
pub(super) fn two_product(x: f64, y: f64) -> (f64, f64) {
    let ((a, b), (c, d)) = (halves(x), halves(y));
    let p = x * y;
    (p, b * d - (((p - a * c) - b * c) - a * d))
}

/// Returns (a, b) with x = a + b, of 26 bits each: products of such halves are exact (Veltkamp 1968).
#[inline(always)]
fn halves(x: f64) -> (f64, f64) {
    let c = 134_217_729.0 * x; // 2²⁷ + 1
    let a = c - (c - x);
    (a, x - a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn errors_of_sums_and_products_are_exact(x in -1e9..1e9f64, y in -1e9..1e9f64, scale in -300..300i32) {
            let (x, y) = (x * 2f64.powi(scale), y * 2f64.powi(-scale / 2));
            let p = x * y;
            prop_assert_eq!(two_product(x, y), (p, x.mul_add(y, -p)));
            let (large, small) = if x.abs() < y.abs() { (y, x) } else { (x, y) };
            prop_assert_eq!(two_sum(x, y), fast_two_sum(large, small));
        }
    }
}
