//! Words that go with numbers.

use aspecta::aspect::Measure;
pub use aspecta::num::count;

/// How many there are, by the bounds that are proved: `1 box`, `2 to 3 boxes`, `at least 2 boxes`.
pub fn between(low: usize, high: Option<usize>, one: &str, many: &str) -> String {
    match high {
        Some(high) if high == low => count(low, one, many),
        Some(high) => format!("{low} to {}", count(high, one, many)),
        None => format!("at least {}", count(low, one, many)),
    }
}

/// The unit of a measure of poses: `mm²·rad`.
pub fn measure_unit(measure: &Measure) -> String {
    let power = |(unit, n): &(String, usize)| format!("{unit}{}", ["", "", "²", "³"].get(*n).unwrap_or(&""));
    measure.unit.0.iter().map(power).collect::<Vec<_>>().join("·")
}

/// A number in four significant digits, with a true minus sign, as pages and pictures show it.
pub fn number(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return if x == 0.0 { "0".into() } else { x.to_string() };
    }
    let exponent = x.abs().log10().floor() as i32;
    let text = if (-4..7).contains(&exponent) {
        let digits = (3 - exponent).max(0) as usize;
        let fixed = format!("{x:.digits$}");
        if fixed.contains('.') { fixed.trim_end_matches('0').trim_end_matches('.').to_owned() } else { fixed }
    } else {
        format!("{x:.3e}")
    };
    text.replace('-', "−")
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
