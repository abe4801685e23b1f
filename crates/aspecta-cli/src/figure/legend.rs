//! What stands below pictures of regions: their colours and the lines.

use super::barrier::Kind;
use super::maps::{sample_line, styled_line, swatch};
use super::regions::{CHARACTERISTIC, Cut};
use super::section::kind;
use super::svg::{Anchor, Svg};

/// Height of a line of text, and how many entries there are at most.
const LINE: f64 = 17.0;
const LISTED: usize = 48;

/// A legend.
pub(super) struct Legend<'a> {
    /// What bounds the aspect.
    pub cut: &'a Cut<'a>,
    /// Colours and what they mean, set in columns.
    pub entries: Vec<(String, String)>,
    /// Width of an entry, pixels.
    pub entry: f64,
    /// More colours, in a line, …
    pub notes: Vec<(&'static str, &'static str)>,
    /// … and what else is to be said.
    pub caption: &'static str,
    /// Before the names of the boundary's lines.
    pub of: &'static str,
    /// What thin lines are, if there are any.
    pub thin: Option<&'static str>,
    /// Left edge.
    pub left: f64,
    /// Right edge.
    pub right: f64,
}

impl Legend<'_> {
    fn listed(&self) -> &[(String, String)] {
        &self.entries[..self.entries.len().min(LISTED)]
    }

    fn rows(&self) -> usize {
        self.listed().len().div_ceil((((self.right - self.left) / self.entry) as usize).max(1))
    }

    /// Height, pixels.
    pub fn height(&self) -> f64 {
        LINE * (self.rows() + usize::from(self.entries.len() > LISTED) + 2) as f64
    }

    /// Draws it; the first line of text stands at `y`.
    pub fn draw(&self, svg: &mut Svg, mut y: f64) {
        let rows = self.rows();
        for (k, (colour, text)) in self.listed().iter().enumerate() {
            let at = [self.left + self.entry * (k / rows) as f64, y + LINE * (k % rows) as f64];
            swatch(svg, at, colour, text);
        }
        y += LINE * rows as f64;
        if self.entries.len() > LISTED {
            let text = format!("… and {} smaller ones", self.entries.len() - LISTED);
            svg.text([self.left, y], Anchor::Start, 11.0, "", &text);
            y += LINE;
        }
        let mut x = self.left;
        for (colour, text) in &self.notes {
            x = swatch(svg, [x, y], colour, text);
        }
        svg.text([x, y], Anchor::Start, 11.0, "", self.caption);
        self.lines(svg, y + LINE);
    }

    /// The kinds of lines there are.
    fn lines(&self, svg: &mut Svg, y: f64) {
        let names = [
            (Kind::Parallel, "det A = 0"),
            (Kind::Serial, "det B = 0"),
            (Kind::Limit, "joint limit, window"),
        ];
        let mut x = self.left;
        for (of, text) in names {
            if self.cut.boundary.simplices.iter().any(|s| kind(s.face) == of) {
                x = sample_line(svg, [x, y], of, &format!("{}{text}", self.of));
            }
        }
        if let Some(text) = self.thin {
            styled_line(svg, [x, y], CHARACTERISTIC, text);
        }
    }
}
