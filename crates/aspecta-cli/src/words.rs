//! Words that go with numbers.

pub use aspecta::num::count;

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
