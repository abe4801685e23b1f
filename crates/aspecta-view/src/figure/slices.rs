//! Robots with three free coordinates: slices of the W-aspects, one figure a working mode.

use super::axes::{Axis, Chart};
use super::barrier::Kind;
use super::curves::{Plane, Sheet};
use super::level::Grid;
use super::maps::{draw_lines, fill, label_colour, limit_samples, sample_line, sign_text, swatch};
use super::palette::{self, UNDECIDED};
use super::raster::{Label, Raster};
use super::robot::signs;
use super::survey::{cell_raster, coordinate_name, pose_axis};
use super::svg::{Anchor, Number, Svg};
use aspecta::aspect::{AspectClass, Cell};
use aspecta::kinematics::WorkingMode;
use aspecta::robot::{Robot, Window};

/// Slices in a figure, in rows of three.
const SLICES: usize = 9;
/// Longest side of a slice, pixels.
const SIDE: f64 = 270.0;
/// Grid cells per side in which singular curves are looked for.
const GRID: usize = 128;
/// Most pixels along a side.
const PIXELS: usize = 256;

/// Both classes of a mode.
#[derive(Clone, Copy, Debug)]
pub struct ModeCells<'a> {
    /// The mode.
    pub mode: WorkingMode,
    /// Number of the mode, from 1.
    pub number: usize,
    /// Its classes, each with its cells.
    pub classes: &'a [(&'a AspectClass, &'a [Cell])],
}

/// Slices of a mode's W-aspects across the third coordinate that varies, both signs of det A together, with
/// singular curves.
///
/// `sides` are the numbers of finest cells along the axes.
pub fn slices(robot: &Robot, window: &Window, sides: [usize; 3], mode: &ModeCells<'_>) -> String {
    let free = window.axes();
    let (across, through) = (free[2], window.ranges.iter().map(|r| r.0).collect::<Vec<_>>());
    let axes = [0, 1].map(|a| pose_axis(robot, window, free[a]));
    let range = extent(mode, window.ranges[across]);
    let panels = Panels::new(axes.clone(), SIDE, 3, 0.0);
    let (width, height) = panels.size(SLICES);
    let size = (width.max(700.0), height + 52.0);
    let text = signs(&mode.mode.to_string());
    let mut svg =
        Svg::new(&format!("slices-mf{}", mode.number), size.0, size.1, &format!("Slices of mode ({text})"));
    let mut kinds = Vec::new();
    for k in 0..SLICES {
        let at = range.0 + (range.1 - range.0) * (k as f64 + 0.5) / SLICES as f64;
        let chart = panels.chart(k);
        let raster = slice(mode, &axes, [sides[0].min(PIXELS), sides[1].min(PIXELS)], at);
        fill(&mut svg, &chart, &raster, label_colour);
        let mut through = through.clone();
        through[across] = at;
        let plane = Plane { through, axes: [free[0], free[1]] };
        let sheet = Sheet { robot, mode: mode.mode, plane: &plane };
        let grid = Grid { x: axes[0].range, y: axes[1].range, n: GRID };
        let lines: Vec<_> = sheet.curves(&grid).into_iter().map(|c| (c.kind, c.points)).collect();
        kinds.extend(lines.iter().map(|line| line.0));
        draw_lines(&mut svg, &chart, &lines, [false; 2]);
        chart.frame(&mut svg, &format!("({text}), {}", place(robot, across, at)));
    }
    aspects(&mut svg, mode, [panels.left, size.1 - 30.0], size.0);
    legend(&mut svg, &kinds, [panels.left, size.1 - 12.0]);
    svg.finish()
}

/// Returns the place of a slice, such as `φ = 0.5 rad`.
pub(crate) fn place(robot: &Robot, coordinate: usize, at: f64) -> String {
    let coordinate = robot.platform.coordinates()[coordinate];
    let unit = if coordinate.angle { "rad" } else { &robot.length_unit };
    format!("{} = {} {unit}", coordinate_name(coordinate.name), Number(at)).replace('-', "−")
}

/// Plots of the same shape in rows.
pub(super) struct Panels {
    shape: Chart,
    columns: usize,
    /// Pixels left of a plot.
    pub left: f64,
    top: f64,
}

impl Panels {
    /// Plots of at most `side` pixels, the first row `top` pixels down.
    pub fn new([x, y]: [Axis; 2], side: f64, columns: usize, top: f64) -> Self {
        let shape = Chart::fit(x, y, 0.0, 0.0, side, side);
        Self { left: shape.margin().max(48.0), shape, columns, top }
    }

    /// Returns the distances from one plot to the next, across and down.
    fn step(&self) -> (f64, f64) {
        (self.left + self.shape.width + 8.0, 26.0 + self.shape.height + 40.0)
    }

    /// Width and height of so many.
    pub fn size(&self, count: usize) -> (f64, f64) {
        let step = self.step();
        let rows = count.div_ceil(self.columns) as f64;
        (self.columns as f64 * step.0 + 10.0, self.top + rows * step.1)
    }

    /// The plot with this number, from 0.
    pub fn chart(&self, k: usize) -> Chart {
        let (step, column, row) = (self.step(), (k % self.columns) as f64, (k / self.columns) as f64);
        let (left, top) = (self.left + column * step.0, self.top + 26.0 + row * step.1);
        Chart { left, top, ..self.shape.clone() }
    }
}

/// Returns the range of the third coordinate that the mode's cells cover within the window: elsewhere slices
/// would be empty.
fn extent(mode: &ModeCells<'_>, window: (f64, f64)) -> (f64, f64) {
    let cells = mode.classes.iter().flat_map(|(_, cells)| cells.iter());
    let hull =
        cells.fold((f64::INFINITY, f64::NEG_INFINITY), |hull, c| (hull.0.min(c.lo[2]), hull.1.max(c.hi[2])));
    let range = (hull.0.max(window.0), hull.1.min(window.1));
    if range.0 < range.1 { range } else { window }
}

/// Labels the plane `at` by the mode's classes: an aspect where either has one.
fn slice(mode: &ModeCells<'_>, axes: &[Axis; 2], size: [usize; 2], at: f64) -> Raster<Label> {
    let rasters: Vec<_> = mode.classes.iter().map(|(_, cells)| cut(cells, axes, size, at)).collect();
    Raster::from_fn(size[0], size[1], |c, r| {
        rasters.iter().map(|raster| raster.at(c, r)).max().unwrap_or(Label::Outside)
    })
}

/// Labels the plane in which the third coordinate is `at` by the cells of a class.
pub(crate) fn cut(cells: &[Cell], axes: &[Axis; 2], size: [usize; 2], at: f64) -> Raster<Label> {
    let cut: Vec<Cell> = cells.iter().filter(|c| c.lo[2] <= at && at < c.hi[2]).copied().collect();
    cell_raster(&cut, axes, [0, 1], size)
}

/// Names the colours of the mode's aspects, the largest first, as many as there is room for.
fn aspects(svg: &mut Svg, mode: &ModeCells<'_>, [mut x, y]: [f64; 2], width: f64) {
    let mut all: Vec<_> = mode
        .classes
        .iter()
        .flat_map(|(class, _)| class.aspects.iter().map(|a| (a.measure, a.id, class.det_a)))
        .collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (_, id, sign) in all {
        if x > width - 150.0 {
            svg.text([x, y], Anchor::Start, 11.0, "", "…");
            return;
        }
        x = swatch(svg, [x, y], palette::aspect(id), &format!("aspect {id}, {}", sign_text(sign)));
    }
}

fn legend(svg: &mut Svg, kinds: &[Kind], at: [f64; 2]) {
    let x = swatch(svg, at, UNDECIDED, "undecided cells");
    let x = sample_line(svg, [x, at[1]], Kind::Parallel, "det A = 0");
    let x = sample_line(svg, [x, at[1]], Kind::Serial, "det B = 0");
    limit_samples(svg, [x, at[1]], kinds.iter().copied());
}
