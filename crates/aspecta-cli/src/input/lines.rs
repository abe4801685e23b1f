//! The lines of a file or of a stream.

use std::io::{self, BufRead, Read};

/// The most bytes of a line: a hundred times what a robot of six legs needs.
pub const LONGEST: usize = 1 << 16;

/// Lines as they come, each within [`LONGEST`], so that one without end is not waited for.
pub struct Lines {
    input: Box<dyn BufRead>,
}

impl Lines {
    pub fn of(input: Box<dyn BufRead>) -> Self {
        Self { input }
    }
}

impl Iterator for Lines {
    type Item = io::Result<String>;

    fn next(&mut self) -> Option<Self::Item> {
        let mut line = Vec::new();
        let read = self.input.by_ref().take(LONGEST as u64 + 1).read_until(b'\n', &mut line);
        match read {
            Ok(0) => return None,
            Ok(_) => {}
            Err(e) => return Some(Err(e)),
        }
        let end = line.last() == Some(&b'\n');
        if line.len() - usize::from(end) > LONGEST {
            return Some(Err(io::Error::other(format!("a line of more than {LONGEST} bytes"))));
        }
        let text = String::from_utf8(line);
        Some(text.map_err(|_| io::Error::other("stream did not contain valid UTF-8")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_without_end_is_refused() {
        let mut lines = Lines::of(Box::new(io::BufReader::new(io::repeat(b'1'))));
        assert!(lines.next().unwrap().unwrap_err().to_string().contains("65536 bytes"));
    }

    #[test]
    fn the_longest_line_is_read() {
        for end in ["\n", "\r\n", ""] {
            let text = format!("{}{end}", "1".repeat(LONGEST - end.len().saturating_sub(1)));
            let mut lines = Lines::of(Box::new(io::Cursor::new(text.clone())));
            assert_eq!(lines.next().unwrap().unwrap(), text);
            assert!(lines.next().is_none());
        }
    }
}
