//! The fields of one line of a CSV file.

use csv_core::{ReadRecordResult, Reader};

/// Splits lines into fields, without their quotes.
///
/// Each line is a record by itself, as no field goes over several: so a stream is answered as it comes, a line's
/// number is known though lines are skipped before it, and a quote that is never closed spoils one line. The
/// reader is kept: to make one costs more than to solve what a line asks.
pub struct Fields {
    reader: Reader,
    /// The fields, one behind the other.
    text: Vec<u8>,
    /// Where each ends.
    ends: Vec<usize>,
}

impl Default for Fields {
    fn default() -> Self {
        Self { reader: Reader::new(), text: Vec::new(), ends: Vec::new() }
    }
}

impl Fields {
    /// The fields of a line that is not empty.
    pub fn of(&mut self, line: &str) -> impl Iterator<Item = &str> {
        self.reader.reset();
        // Room for all that a line can hold, so that the reader never asks for more.
        self.text.resize(line.len().max(self.text.len()), 0);
        self.ends.resize((line.len() + 1).max(self.ends.len()), 0);
        let (state, _, written, found) =
            self.reader.read_record(line.as_bytes(), &mut self.text, &mut self.ends);
        let mut fields = found;
        if state == ReadRecordResult::InputEmpty {
            let (rest, ends) = (&mut self.text[written..], &mut self.ends[found..]);
            fields += self.reader.read_record(&[], rest, ends).3;
        }
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        let pieces = starts.zip(&self.ends[..fields]).map(|(start, &end)| &self.text[start..end]);
        let text = |field| std::str::from_utf8(field).expect("text is cut at commas and quotes only");
        pieces.map(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_split_one_by_one() {
        let mut fields = Fields::default();
        let mut split = |line| fields.of(line).map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(split("1,2.5,-3"), ["1", "2.5", "-3"]);
        assert_eq!(split("\"a,b\",\"say \"\"so\"\"\",é"), ["a,b", "say \"so\"", "é"]);
        assert_eq!(split(",,"), ["", "", ""]);
        assert_eq!(split("\"never closed,1"), ["never closed,1"]);
        assert_eq!(split("x"), ["x"]);
    }
}
