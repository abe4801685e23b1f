//! Words that go with numbers.

use aspecta::aspect::Measure;
pub use aspecta::num::count;
pub use aspecta::text::between;

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
