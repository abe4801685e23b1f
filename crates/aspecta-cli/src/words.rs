//! Words that go with numbers.

use std::fmt::Display;

/// `1 box`, `2 boxes`: how many there are of what.
pub fn count<N: Display + PartialEq + From<u8>>(n: N, one: &str, many: &str) -> String {
    let what = if n == N::from(1) { one } else { many };
    format!("{n} {what}")
}

#[cfg(test)]
mod tests {
    use super::count;

    #[test]
    fn one_is_no_plural() {
        let counted = [0usize, 1, 2, 11].map(|n| count(n, "leaf", "leaves"));
        assert_eq!(counted, ["0 leaves", "1 leaf", "2 leaves", "11 leaves"]);
    }
}
