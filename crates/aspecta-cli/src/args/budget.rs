//! `--budget`: how far an analysis goes.

use crate::failure::Failure;
use aspecta::motion::explore::Effort;
use aspecta::paving::{Budget, MAX_DEPTH};
use std::time::Duration;

/// Returns the effort of a roadmap, whose budget is a time.
///
/// # Errors
/// [`Failure::Input`] if it is something else.
pub fn effort(budget: Option<Budget>, samples: u32) -> Result<Effort, Failure> {
    let budget = budget.unwrap_or_default();
    if budget.boxes.is_some() || budget.depth.is_some() || budget.resolution.is_some() {
        return Err(Failure::Input(
            "--budget: a free body is explored by a roadmap, which has no boxes: give a time, such as 30s, or --samples".into(),
        ));
    }
    Ok(Effort { samples: samples as usize, seconds: budget.seconds })
}

/// Reads a time: `30s`, `5min`, `1h`.
///
/// # Errors
/// A sentence that says what would do.
pub fn parse_time(text: &str) -> Result<Duration, String> {
    let Budget { seconds: Some(seconds), boxes: None, depth: None, resolution: None } = parse(text)? else {
        return Err("give a time, such as 30s or 5min".into());
    };
    Duration::try_from_secs_f64(seconds)
        .map_err(|_| format!("`{text}` is longer than any time; give one such as 5min"))
}

/// Reads a comma-separated budget: `30s`, `5min`, `1h`, `2e6boxes`, `depth=9`, `res=0.1`.
///
/// # Errors
/// A sentence that names the part at fault and what would do.
pub fn parse(text: &str) -> Result<Budget, String> {
    let mut budget = Budget::default();
    for part in text.split(',').map(str::trim) {
        let twice = match quantity(part)? {
            Quantity::Seconds(x) => budget.seconds.replace(x).is_some(),
            Quantity::Boxes(n) => budget.boxes.replace(n).is_some(),
            Quantity::Depth(n) => budget.depth.replace(n).is_some(),
            Quantity::Resolution(x) => budget.resolution.replace(x).is_some(),
        };
        if twice {
            return Err(format!("`{part}` sets again what is set already in `{text}`"));
        }
    }
    Ok(budget)
}

enum Quantity {
    Seconds(f64),
    Boxes(u64),
    Depth(u32),
    Resolution(f64),
}

fn quantity(part: &str) -> Result<Quantity, String> {
    let positive = |number: &str| match number.trim().parse::<f64>() {
        Ok(x) if x > 0.0 && x.is_finite() => Ok(x),
        _ => Err(format!("`{number}` in `{part}` is not a positive number")),
    };
    let seconds = |number: &str, factor: f64| Ok(Quantity::Seconds(positive(number)? * factor));
    if let Some(depth) = part.strip_prefix("depth=") {
        return match depth.parse() {
            Ok(depth) if (1..=MAX_DEPTH).contains(&depth) => Ok(Quantity::Depth(depth)),
            _ => Err(format!("`{depth}` in `{part}` is not a whole number from 1 to {MAX_DEPTH}")),
        };
    }
    if let Some(width) = part.strip_prefix("res=") {
        return Ok(Quantity::Resolution(positive(width)?));
    }
    // `boxes` before `s`, which it ends with.
    if let Some(boxes) = part.strip_suffix("boxes") {
        return match positive(boxes)? {
            n if n >= 1.0 && n.fract() == 0.0 => Ok(Quantity::Boxes(n as u64)),
            _ => Err(format!("`{boxes}` in `{part}` is not a whole number")),
        };
    }
    for (suffix, factor) in [("min", 60.0), ("h", 3600.0), ("s", 1.0)] {
        if let Some(number) = part.strip_suffix(suffix) {
            return seconds(number, factor);
        }
    }
    Err(format!(
        "`{part}` is not a budget: write a time (30s, 5min, 1h), boxes (2e6boxes), a depth (depth=9) or \
         the width of the finest cells (res=0.1: in length units, or in radians where angles alone vary), several \
         separated by commas"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_form() {
        let all = parse("30s, 2e6boxes,depth=9,res=0.1").unwrap();
        let wanted =
            Budget { seconds: Some(30.0), boxes: Some(2_000_000), depth: Some(9), resolution: Some(0.1) };
        assert_eq!(all, wanted);
        assert_eq!(parse("5min").unwrap().seconds, Some(300.0));
        assert_eq!(parse("1.5h").unwrap().seconds, Some(5400.0));
        assert_eq!(parse("7 boxes").unwrap().boxes, Some(7));
    }

    #[test]
    fn every_mistake_is_named() {
        for (text, complaint) in [
            ("", "`` is not a budget"),
            ("30", "`30` is not a budget"),
            ("30s,1min", "`1min` sets again"),
            ("-3s", "`-3` in `-3s` is not a positive number"),
            ("nans", "not a positive number"),
            ("0.5boxes", "not a whole number"),
            ("depth=0", "from 1 to"),
            ("depth=99", "from 1 to"),
            ("res=inf", "not a positive number"),
        ] {
            let message = parse(text).unwrap_err();
            assert!(message.contains(complaint), "{text}: {message}");
        }
    }
}
