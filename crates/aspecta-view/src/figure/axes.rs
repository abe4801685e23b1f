//! A plot with axes: ticks, units and equal scale.

use super::svg::{Anchor, Number, Svg};
use std::f64::consts::{PI, TAU};

/// Frames and ticks, in [`super::palette::INK`].
const THIN: &str = "fill:none;stroke:#222;stroke-width:0.8";

/// One axis of a plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Name and unit, such as `x [mm]`.
    pub label: String,
    /// Shown range, lower end first.
    pub range: (f64, f64),
    /// Whether the coordinate is an angle (rad): ticks at multiples of π.
    pub angle: bool,
}

impl Axis {
    /// Whether its two ends are the same angle.
    pub fn is_full_turn(&self) -> bool {
        self.angle && self.span() > TAU - 1e-9
    }
}

/// A plot: a rectangle of the figure that shows a rectangle of the plane, y upward.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Left edge of the plot, pixels.
    pub left: f64,
    /// Upper edge of the plot, pixels.
    pub top: f64,
    /// Width, pixels.
    pub width: f64,
    /// Height, pixels.
    pub height: f64,
}

impl Chart {
    /// A chart within a box of pixels, at equal scale if both axes measure the same thing (two lengths or
    /// two angles), filling the box otherwise.
    pub fn fit(x: Axis, y: Axis, left: f64, top: f64, width: f64, height: f64) -> Self {
        let mut chart = Self { left, top, width, height, x, y };
        if chart.x.angle == chart.y.angle {
            let scale = (width / chart.x.span()).min(height / chart.y.span());
            chart.width = scale * chart.x.span();
            chart.height = scale * chart.y.span();
        }
        chart
    }

    /// Pixels of a point of the plane.
    pub fn at(&self, p: [f64; 2]) -> [f64; 2] {
        let across = (p[0] - self.x.range.0) / self.x.span();
        let up = (p[1] - self.y.range.0) / self.y.span();
        [self.left + across * self.width, self.top + (1.0 - up) * self.height]
    }

    /// Opens a group in which nothing is drawn beyond the plot.
    pub fn clip(&self, svg: &mut Svg) {
        svg.open_clipped(self.left, self.top, self.width, self.height);
    }

    /// Opens a group whose unit square, y upward, is cut into `columns` × `rows` and covers the plot.
    pub fn open_lattice(&self, svg: &mut Svg, columns: usize, rows: usize) {
        let scale = (self.width / columns as f64, -self.height / rows as f64);
        svg.open(&format!(
            "transform=\"translate({} {}) scale({:.6} {:.6})\"",
            Number(self.left),
            Number(self.top + self.height),
            scale.0,
            scale.1
        ));
    }

    /// Frame, ticks and label of the horizontal axis, and title.
    pub fn frame_across(&self, svg: &mut Svg, title: &str) {
        svg.rect(self.left, self.top, self.width, self.height, THIN);
        let (bottom, middle) = (self.top + self.height, self.left + self.width / 2.0);
        for (value, text) in self.x.ticks(self.width) {
            let px = self.at([value, 0.0])[0];
            svg.line([px, bottom], [px, bottom + 4.0], THIN);
            svg.text([px, bottom + 15.0], Anchor::Middle, 10.0, "", &text);
        }
        svg.text([middle, bottom + 29.0], Anchor::Middle, 11.0, "", &self.x.label);
        svg.text([middle, self.top - 7.0], Anchor::Middle, 12.0, "font-weight:600", title);
    }

    /// Returns the distance from the baseline of the vertical axis' label to the plot, pixels.
    fn label_distance(&self) -> f64 {
        let texts = self.y.ticks(self.height).into_iter().map(|(_, text)| text.chars().count());
        13.0 + 6.0 * texts.max().unwrap_or(0) as f64
    }

    /// Pixels [`Chart::frame`] takes on the left of the plot.
    pub fn margin(&self) -> f64 {
        self.label_distance() + 10.0
    }

    /// Frame, ticks, labels and title.
    pub fn frame(&self, svg: &mut Svg, title: &str) {
        self.frame_across(svg, title);
        for (value, text) in self.y.ticks(self.height) {
            let py = self.at([0.0, value])[1];
            svg.line([self.left - 4.0, py], [self.left, py], THIN);
            svg.text([self.left - 6.0, py + 3.5], Anchor::End, 10.0, "", &text);
        }
        let beside = [self.left - self.label_distance(), self.top + self.height / 2.0];
        svg.text_turned(beside, -90.0, Anchor::Middle, 11.0, "", &self.y.label);
    }
}

impl Axis {
    /// Upper end minus lower end.
    pub fn span(&self) -> f64 {
        self.range.1 - self.range.0
    }

    /// Positions and texts of the ticks on an axis of `pixels`.
    pub fn ticks(&self, pixels: f64) -> Vec<(f64, String)> {
        let room = (pixels / 45.0).max(1.0);
        if self.angle && self.span() > 1.5 { self.turns(room) } else { self.decimals(room) }
    }

    /// Multiples of a simple fraction of π.
    fn turns(&self, room: f64) -> Vec<(f64, String)> {
        let parts = [12_i64, 6, 4, 2, 1];
        let part = parts.into_iter().find(|&p| self.span() * p as f64 / PI <= room).unwrap_or(1);
        let step = PI / part as f64;
        whole_numbers(self.range, step).map(|k| (k as f64 * step, fraction_of_pi(k, part))).collect()
    }

    /// Multiples of 1, 2 or 5 times a power of ten.
    fn decimals(&self, room: f64) -> Vec<(f64, String)> {
        let rough = self.span() / room;
        let power = 10_f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0]
            .into_iter()
            .map(|m| m * power)
            .find(|&s| s >= rough)
            .unwrap_or(power * 10.0);
        let digits = (-(step * 1.0000001).log10().floor()).max(0.0) as usize;
        let text = |v: f64| if v == 0.0 { "0".into() } else { format!("{v:.digits$}").replace('-', "−") };
        whole_numbers(self.range, step).map(|k| (k as f64 * step, text(k as f64 * step))).collect()
    }
}

/// Returns all k with lo ≤ k·step ≤ hi, up to rounding.
fn whole_numbers((lo, hi): (f64, f64), step: f64) -> impl Iterator<Item = i64> {
    let slack = 1e-6;
    (lo / step - slack).ceil() as i64..=(hi / step + slack).floor() as i64
}

fn fraction_of_pi(k: i64, part: i64) -> String {
    let gcd = (1..=part).rev().find(|g| k % g == 0 && part % g == 0).unwrap_or(1);
    let (n, d) = (k / gcd, part / gcd);
    let sign = if n < 0 { "−" } else { "" };
    let factor = if n.abs() == 1 { String::new() } else { n.abs().to_string() };
    match (n, d) {
        (0, _) => "0".into(),
        (_, 1) => format!("{sign}{factor}π"),
        _ => format!("{sign}{factor}π/{d}"),
    }
}
