//! The quantities that change from frame to frame, as whole numbers: coordinates of pictures and the values
//! beside them.

use std::collections::HashMap;
use std::fmt::Write;

/// Units of a track that is a coordinate of a picture: hundredths of a pixel, as in every figure.
pub const PIXEL: f64 = 100.0;

/// Tracks by their numbers; equal ones are kept once.
#[derive(Default)]
pub struct Tracks {
    json: Vec<String>,
    numbers: HashMap<String, usize>,
}

impl Tracks {
    /// The number of the track with these values, one a frame, in units of 1 / `scale`.
    pub fn add(&mut self, values: impl Iterator<Item = f64>, scale: f64) -> usize {
        let mut json = String::from("[");
        let (mut last, mut trailing) = (0, 0);
        for (k, value) in values.enumerate() {
            let value = (value * scale).round() as i64;
            if k > 0 && value == last {
                trailing += 1;
                continue;
            }
            // What does not change again is left out at the end.
            json.extend(std::iter::repeat_n(",0", trailing));
            let _ = write!(json, "{}{}", if k > 0 { "," } else { "" }, value - last);
            (last, trailing) = (value, 0);
        }
        json.push(']');
        *self.numbers.entry(json).or_insert_with_key(|json| {
            self.json.push(json.clone());
            self.json.len() - 1
        })
    }

    /// A list of lists: the first value of each track, then the steps; after the last step nothing changes.
    pub fn json(&self) -> String {
        format!("[{}]", self.json.join(",\n"))
    }
}
