//! A small SVG writer: equal axes need sub-pixel coordinates, which is all this adds to `write!`.

use crate::xml::escape;
use std::fmt::Write;

/// The font stack of every figure: fonts of the reader's system.
pub const FONT: &str = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

/// A figure under construction. Lengths in CSS pixels, y downward.
#[derive(Debug)]
pub struct Svg {
    id: String,
    size: (f64, f64),
    title: String,
    body: String,
    clips: usize,
}

/// The placement of a text relative to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// The text begins at the point.
    Start,
    /// The text is centred on the point.
    Middle,
    /// The text ends at the point.
    End,
}

impl Svg {
    /// An empty figure. `id` is a prefix unique within a page, so that several figures can share one; `title`
    /// is read out by screen readers and shown as a tooltip.
    pub fn new(id: &str, width: f64, height: f64, title: &str) -> Self {
        Self { id: id.into(), size: (width, height), title: title.into(), body: String::new(), clips: 0 }
    }

    /// Raw markup.
    pub fn raw(&mut self, markup: &str) {
        self.body.push_str(markup);
    }

    /// Opens a group with the given attributes.
    pub fn open(&mut self, attributes: &str) {
        let _ = write!(self.body, "<g {attributes}>");
    }

    /// Opens a group clipped to a rectangle.
    pub fn open_clipped(&mut self, x: f64, y: f64, width: f64, height: f64) {
        let id = format!("{}-clip{}", self.id, self.clips);
        self.clips += 1;
        let _ = write!(
            self.body,
            "<clipPath id=\"{id}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath><g clip-path=\"url(#{id})\">",
            Number(x),
            Number(y),
            Number(width),
            Number(height)
        );
    }

    /// Closes the group opened last.
    pub fn close(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// A path.
    pub fn path(&mut self, d: &str, style: &str) {
        let _ = write!(self.body, "<path d=\"{d}\" style=\"{style}\"/>");
    }

    /// An open (or closed) polyline.
    pub fn polyline(&mut self, points: &[[f64; 2]], closed: bool, style: &str) {
        let mut d = String::new();
        for (k, p) in points.iter().enumerate() {
            let _ = write!(d, "{}{} {}", if k == 0 { "M" } else { "L" }, Number(p[0]), Number(p[1]));
        }
        if closed {
            d.push('Z');
        }
        self.path(&d, style);
    }

    /// A segment.
    pub fn line(&mut self, a: [f64; 2], b: [f64; 2], style: &str) {
        self.polyline(&[a, b], false, style);
    }

    /// A rectangle.
    pub fn rect(&mut self, x: f64, y: f64, width: f64, height: f64, style: &str) {
        let _ = write!(
            self.body,
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" style=\"{style}\"/>",
            Number(x),
            Number(y),
            Number(width),
            Number(height)
        );
    }

    /// A circle.
    pub fn circle(&mut self, c: [f64; 2], r: f64, style: &str) {
        let _ = write!(
            self.body,
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" style=\"{style}\"/>",
            Number(c[0]),
            Number(c[1]),
            Number(r)
        );
    }

    /// A line of text.
    pub fn text(&mut self, at: [f64; 2], anchor: Anchor, size: f64, style: &str, text: &str) {
        self.text_turned(at, 0.0, anchor, size, style, text);
    }

    /// A line of text turned by `angle` degrees, clockwise.
    pub fn text_turned(
        &mut self,
        at: [f64; 2],
        angle: f64,
        anchor: Anchor,
        size: f64,
        style: &str,
        text: &str,
    ) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let place = if angle == 0.0 {
            format!("x=\"{}\" y=\"{}\"", Number(at[0]), Number(at[1]))
        } else {
            format!("transform=\"translate({} {}) rotate({})\"", Number(at[0]), Number(at[1]), Number(angle))
        };
        let _ = write!(
            self.body,
            "<text {place} text-anchor=\"{anchor}\" font-size=\"{}\" style=\"{style}\">{}</text>",
            Number(size),
            escape(text)
        );
    }

    /// The whole document.
    pub fn finish(self) -> String {
        let (w, h) = (Number(self.size.0), Number(self.size.1));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" role=\"img\" \
             aria-labelledby=\"{id}-title\" font-family=\"{FONT}\" fill=\"#222\">\n<title id=\"{id}-title\">{}</title>\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{}</svg>\n",
            escape(&self.title),
            self.body,
            id = self.id,
        )
    }
}

/// A coordinate to a hundredth of a pixel, as short as possible.
#[derive(Clone, Copy, Debug)]
pub struct Number(pub f64);

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let text = format!("{:.2}", self.0);
        let short = text.trim_end_matches('0').trim_end_matches('.');
        f.write_str(if short == "-0" { "0" } else { short })
    }
}
