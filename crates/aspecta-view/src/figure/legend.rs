//! Legends of pictures of regions: their colours and the lines.

use super::barrier::Kind;
use super::cut::Cut;
use super::maps::{line_style, sample_width, styled_line, swatch};
use super::palette::CHARACTERISTIC;
use super::section::kind;
use super::svg::{Anchor, Svg};

/// Height of a line of text, and how many entries there are at most.
const LINE: f64 = 17.0;
const LISTED: usize = 48;

/// A legend.
pub(super) struct Legend<'a> {
    /// The aspect that is drawn, with the surfaces that bound it.
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
    /// The meaning of thin lines, if there are any.
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
        let lines = self.lines().iter().map(|line| line.at[1]).fold(0.0, f64::max);
        LINE * (self.rows() + usize::from(self.entries.len() > LISTED) + 2) as f64 + lines
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
        for Line { at, style, text } in self.lines() {
            styled_line(svg, [at[0], y + LINE + at[1]], style, &text);
        }
    }

    /// The kinds of lines there are, in as many rows as they need.
    fn lines(&self) -> Vec<Line> {
        let names = [
            (Kind::Parallel, "det A = 0"),
            (Kind::Serial, "det B = 0"),
            (Kind::Limit, "joint limit or end of the window"),
        ];
        let is_there = |of: Kind| self.cut.boundary.simplices.iter().any(|s| kind(s.face) == of);
        let bounds = names.into_iter().filter(|(of, _)| is_there(*of));
        let bounds = bounds.map(|(of, text)| (line_style(of), format!("{}{text}", self.of)));
        let mut lines: Vec<Line> = Vec::new();
        let mut next = [self.left, 0.0];
        for (style, text) in bounds.chain(self.thin.map(|text| (CHARACTERISTIC, text.to_owned()))) {
            let width = sample_width(&text);
            if next[0] > self.left && next[0] + width > self.right {
                next = [self.left, next[1] + LINE];
            }
            lines.push(Line { at: next, style, text });
            next[0] += width;
        }
        lines
    }
}

/// A sample of a line and what it is; its place from the left edge of the picture and the top of the samples.
struct Line {
    at: [f64; 2],
    style: &'static str,
    text: String,
}
