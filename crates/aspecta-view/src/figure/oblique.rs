//! Sheets that lie on each other, seen obliquely from above.

use super::axes::{Axis, Chart};
use super::svg::{Anchor, Number, Svg};

/// Longest side of a sheet, pixels.
pub const SIDE: f64 = 420.0;
/// How far the far edge is drawn up and to the right, as a share of the depth.
const UP: f64 = 0.45;
const ASIDE: f64 = 0.4;
/// From a sheet to the next, as a share of its height in the picture.
const GAP: f64 = 0.95;
/// Room on the left, above, and below for ticks.
pub const LEFT: f64 = 96.0;
const TOP: f64 = 56.0;
pub const BELOW: f64 = 44.0;
const PAPER: &str = "stroke:#aaa;stroke-width:0.8;fill:#fff;fill-opacity:0.55";
const TICK: &str = "fill:none;stroke:#222;stroke-width:0.8";

/// The oblique projection of the sheets.
pub struct View {
    /// A sheet as it is, its upper left corner at the origin.
    pub chart: Chart,
    /// Pixels from the top of the picture to the near edge of the floor.
    pub bottom: f64,
}

impl View {
    /// Room for so many sheets over a floor with these axes.
    pub fn new([x, y]: [Axis; 2], sheets: usize) -> Self {
        let chart = Chart::fit(x, y, 0.0, 0.0, SIDE, SIDE);
        let mut view = Self { chart, bottom: 0.0 };
        view.bottom = TOP + view.height() + sheets as f64 * view.gap();
        view
    }

    /// Of a sheet in the picture.
    fn height(&self) -> f64 {
        UP * self.chart.height
    }

    fn gap(&self) -> f64 {
        GAP * self.height()
    }

    /// Of the picture.
    pub fn width(&self) -> f64 {
        LEFT + self.chart.width + ASIDE * self.chart.height + 24.0
    }

    /// Returns the place in the picture of a pixel of a sheet; sheet 0 is the floor.
    pub fn at(&self, [x, y]: [f64; 2], sheet: usize) -> [f64; 2] {
        let depth = self.chart.height - y;
        [LEFT + x + ASIDE * depth, self.bottom - sheet as f64 * self.gap() - UP * depth]
    }

    /// Opens a group in which the chart is drawn flat.
    pub fn open(&self, svg: &mut Svg, sheet: usize) {
        let [x, y] = self.at([0.0, 0.0], sheet);
        svg.open(&format!("transform=\"matrix(1 0 {} {UP} {} {})\"", -ASIDE, Number(x), Number(y)));
    }

    /// An empty sheet.
    pub fn paper(&self, svg: &mut Svg, sheet: usize) {
        let Chart { width, height, .. } = self.chart;
        let corners = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
        svg.polyline(&corners.map(|corner| self.at(corner, sheet)), true, PAPER);
    }

    /// Ticks and labels of the floor.
    pub fn frame(&self, svg: &mut Svg) {
        let Chart { x, y, width, height, .. } = &self.chart;
        for (value, text) in x.ticks(*width) {
            let [px, py] = self.at([self.chart.at([value, y.range.0])[0], *height], 0);
            svg.line([px, py], [px, py + 4.0], TICK);
            svg.text([px, py + 15.0], Anchor::Middle, 10.0, "", &text);
        }
        svg.text([LEFT + 0.5 * width, self.bottom + 30.0], Anchor::Middle, 11.0, "", &x.label);
        for (value, text) in y.ticks(UP * height) {
            let [px, py] = self.at([0.0, self.chart.at([x.range.0, value])[1]], 0);
            svg.line([px - 4.0, py], [px, py], TICK);
            svg.text([px - 6.0, py + 3.5], Anchor::End, 10.0, "", &text);
        }
        let [px, py] = self.at([0.0, 0.62 * height], 0);
        svg.text([px - 36.0, py + 3.5], Anchor::End, 11.0, "", &y.label);
    }
}
