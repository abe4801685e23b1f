//! Words that go with numbers.

use std::fmt::Display;

/// `1 box`, `2 boxes`: how many there are of what.
pub fn count<N: Display + PartialEq + From<u8>>(n: N, one: &str, many: &str) -> String {
    let what = if n == N::from(1) { one } else { many };
    format!("{n} {what}")
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
    use super::{between, count};

    #[test]
    fn one_is_no_plural() {
        let counted = [0usize, 1, 2, 11].map(|n| count(n, "leaf", "leaves"));
        assert_eq!(counted, ["0 leaves", "1 leaf", "2 leaves", "11 leaves"]);
    }

    #[test]
    fn bounds_that_meet_are_a_number() {
        let said = [(1, Some(1)), (0, Some(1)), (2, Some(3)), (1, None)]
            .map(|(low, high)| between(low, high, "leaf", "leaves"));
        assert_eq!(said, ["1 leaf", "0 to 1 leaf", "2 to 3 leaves", "at least 1 leaf"]);
    }
}
