//! Numbers for people.

use crate::num::count;

/// A number for people: six decimals, or six digits and a power of ten where these would not show it.
pub fn number(x: f64) -> String {
    let size = x.abs();
    if size == 0.0 || (1e-3..1e7).contains(&size) {
        format!("{:.6}", unsigned(x))
    } else {
        format!("{x:.5e}")
    }
}

/// A number for people, in five digits.
pub fn brief(x: f64) -> String {
    let size = x.abs();
    if size == 0.0 {
        return "0".into();
    }
    if !(1e-4..1e6).contains(&size) {
        return format!("{x:.3e}");
    }
    let decimals = (4 - size.log10().floor() as i32).clamp(0, 4) as usize;
    format!("{x:.decimals$}")
}

/// The number with a zero that has no sign: nobody asks from which side it is one.
pub fn unsigned(x: f64) -> f64 {
    x + 0.0
}

/// Returns the number in subscript digits: `₁₂`.
pub fn subscript(n: usize) -> String {
    n.to_string().chars().filter_map(|c| char::from_u32(0x2080 + c.to_digit(10)?)).collect()
}

/// How many there are, by the bounds that are proved: `1 box`, `2 to 3 boxes`, `at least 2 boxes`.
pub fn between(low: usize, high: Option<usize>, one: &str, many: &str) -> String {
    match high {
        Some(high) if high == low => count(low, one, many),
        Some(high) => format!("{low} to {}", count(high, one, many)),
        None => format!("at least {}", count(low, one, many)),
    }
}

#[cfg(test)]
mod tests {
    use super::between;

    #[test]
    fn bounds_that_meet_are_a_number() {
        let said = [(1, Some(1)), (0, Some(1)), (2, Some(3)), (1, None)]
            .map(|(low, high)| between(low, high, "leaf", "leaves"));
        assert_eq!(said, ["1 leaf", "0 to 1 leaf", "2 to 3 leaves", "at least 1 leaf"]);
    }
}
