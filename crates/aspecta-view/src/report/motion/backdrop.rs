//! The aspects that a motion is in: all of the plane, or sections across the third coordinate that change
//! while it is played.

use super::panel::Panel;
use super::tracks::Tracks;
use super::{Frame, breaks};
use crate::figure::axes::{Axis, Chart};
use crate::figure::barrier::Kind;
use crate::figure::curves::{Plane, Sheet};
use crate::figure::level::Grid;
use crate::figure::maps::{draw_lines, fill, limit_samples, sample_line, sign_text, swatch};
use crate::figure::palette::{self, UNDECIDED};
use crate::figure::raster::{Label, Raster};
use crate::figure::robot::signs;
use crate::figure::slices::{cut, place};
use crate::figure::survey::{Lines, cell_raster, pose_axis};
use crate::figure::svg::{Anchor, Svg};
use crate::report::side;
use aspecta::aspect::{Analysis, AspectId, Cell, ClassId};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Most sections of all a motion.
const SECTIONS: usize = 32;
/// Most pixels along a side, and cells of the grid in which curves are looked for: of a section, of a plane.
const PIXELS: [usize; 2] = [160, 512];
const GRID: [usize; 2] = [96, 384];
/// Poses of a stretch that are asked which aspect they lie in.
const ASKED: usize = 16;

/// A picture of a class, whole or cut.
#[derive(Clone, Copy, PartialEq)]
struct Section {
    class: ClassId,
    aspect: Option<AspectId>,
    /// The third coordinate.
    at: Option<f64>,
}

/// The picture; none if the robot has not two or three coordinates, all of them free.
pub fn panel(analysis: &Analysis, frames: &[Frame], tracks: &mut Tracks) -> Option<String> {
    let axes = analysis.window.axes().len();
    if !analysis.fixed.is_empty() || !(2..=3).contains(&axes) || frames.is_empty() {
        return None;
    }
    let of_frames = sections(analysis, frames);
    let mut sections: Vec<Section> = Vec::new();
    for section in of_frames.iter().flatten() {
        if !sections.contains(section) {
            sections.push(*section);
        }
    }
    let cells: BTreeMap<ClassId, Vec<Cell>> =
        sections.iter().map(|s| s.class).map(|class| (class, analysis.cells(class))).collect();
    let plot = Map::new(analysis, axes);
    let (width, height) =
        (plot.chart.left + plot.chart.width + 20.0, plot.chart.top + plot.chart.height + 76.0);
    let title = format!("W-aspects of {} along the motion", analysis.robot.name);
    let mut panel = Panel::new(Svg::new("aspect", width.max(480.0), height, &title), tracks);
    let number = |section: &Option<Section>| sections.iter().position(|s| Some(*s) == *section);
    let shown = panel.track(of_frames.iter().map(|section| number(section).map_or(-1.0, |k| k as f64)));
    let drawn: Vec<_> = sections.par_iter().map(|s| plot.compute(s, &cells[&s.class])).collect();
    for (k, (section, (raster, lines))) in sections.iter().zip(&drawn).enumerate() {
        panel.open_case(shown, k, number(&of_frames[0]) == Some(k));
        plot.draw(&mut panel.svg, section, raster, lines);
        panel.svg.close();
    }
    plot.chart.frame(&mut panel.svg, "");
    let path: Vec<[f64; 2]> = frames.iter().map(|f| plot.chart.at(plot.turned(&f.point.pose))).collect();
    let far = |a: usize, b: usize| {
        let jump = |k: usize| (path[a][k] - path[b][k]).abs();
        jump(0) > 0.5 * plot.chart.width || jump(1) > 0.5 * plot.chart.height
    };
    panel.trail(&path, &breaks(frames, far), 5.0);
    Some(panel.svg.finish())
}

/// Returns the section behind each frame; `None` where the frame is in no class that was analysed.
fn sections(analysis: &Analysis, frames: &[Frame]) -> Vec<Option<Section>> {
    let class = |frame: &Frame| analysis.class_of(frame.mode, frame.det_a?);
    let mut all = Vec::new();
    for stretch in frames.chunk_by(|a, b| class(a) == class(b)) {
        let Some(class) = class(&stretch[0]) else {
            all.extend(stretch.iter().map(|_| None));
            continue;
        };
        let mut asked = stretch.iter().step_by(stretch.len().div_ceil(ASKED));
        let aspect = asked.find_map(|frame| analysis.aspect_at(&frame.point.pose, class));
        let heights = heights(analysis, stretch, frames.len());
        all.extend(heights.into_iter().map(|at| Some(Section { class, aspect, at })));
    }
    all
}

/// Returns the height of each frame's section: as far apart as the finest cells, or further to be few.
fn heights(analysis: &Analysis, stretch: &[Frame], of: usize) -> Vec<Option<f64>> {
    if analysis.window.axes().len() < 3 {
        return vec![None; stretch.len()];
    }
    let third = || stretch.iter().map(|f| f.point.pose[2]);
    let (low, high) = (third().fold(f64::MAX, f64::min), third().fold(f64::MIN, f64::max));
    let few = (SECTIONS * stretch.len()).div_ceil(of).max(2) as f64;
    let count = ((high - low) / analysis.run.resolution[2]).ceil().clamp(1.0, few);
    let step = (high - low) / count;
    let number = |x: f64| if step > 0.0 { ((x - low) / step).floor().clamp(0.0, count - 1.0) } else { 0.0 };
    third().map(|x| Some(analysis.window.turned_in(2, low + (number(x) + 0.5) * step))).collect()
}

/// The plane of the first two coordinates.
struct Map<'a> {
    analysis: &'a Analysis,
    axes: [Axis; 2],
    chart: Chart,
    size: [usize; 2],
    grid: Grid,
}

impl<'a> Map<'a> {
    fn new(analysis: &'a Analysis, coordinates: usize) -> Self {
        let axes = [0, 1].map(|k| pose_axis(&analysis.robot, &analysis.window, k));
        let mut chart = Chart::fit(axes[0].clone(), axes[1].clone(), 0.0, 28.0, 520.0, 420.0);
        chart.left = chart.margin().max(48.0);
        let whole = usize::from(coordinates == 2);
        let grid = Grid { x: axes[0].range, y: axes[1].range, n: GRID[whole] };
        Self { analysis, chart, size: [0, 1].map(|k| side(analysis, k).min(PIXELS[whole])), grid, axes }
    }

    /// The first two coordinates, within the window.
    fn turned(&self, pose: &[f64]) -> [f64; 2] {
        [0, 1].map(|k| self.analysis.window.turned_in(k, pose[k]))
    }

    fn compute(&self, section: &Section, cells: &[Cell]) -> (Raster<Label>, Lines) {
        let raster = match section.at {
            Some(at) => cut(cells, &self.axes, self.size, at),
            None => cell_raster(cells, &self.axes, [0, 1], self.size),
        };
        let through = vec![section.at.unwrap_or(0.0); self.analysis.robot.dof()];
        let plane = Plane { through, axes: [0, 1] };
        let mode = self.analysis.classes[section.class.index()].mode;
        let sheet = Sheet { robot: &self.analysis.robot, mode, plane: &plane };
        (raster, sheet.curves(&self.grid).into_iter().map(|c| (c.kind, c.points)).collect())
    }

    fn draw(&self, svg: &mut Svg, section: &Section, raster: &Raster<Label>, lines: &Lines) {
        let class = &self.analysis.classes[section.class.index()];
        fill(svg, &self.chart, raster, |label| match label {
            Label::Outside => None,
            Label::Undecided => Some(UNDECIDED.to_owned()),
            Label::Aspect(id) if section.aspect.is_none_or(|own| own == id) => {
                Some(palette::aspect(id).to_owned())
            }
            Label::Aspect(id) => Some(palette::shade(id.number(), 1, 2)),
        });
        draw_lines(svg, &self.chart, lines, [false; 2]);
        let at = section.at.map_or(String::new(), |at| format!(", {}", place(&self.analysis.robot, 2, at)));
        let title = format!("W ({}), {}{at}", signs(&class.mode.to_string()), sign_text(class.det_a));
        let Chart { left, top, width, height, .. } = self.chart;
        svg.text([left + width / 2.0, top - 9.0], Anchor::Middle, 12.0, "font-weight:600", &title);
        let (mut x, y) = (left, top + height + 50.0);
        if let Some(id) = section.aspect {
            x = swatch(svg, [x, y], palette::aspect(id), &format!("aspect {id}"));
            if class.aspects.len() > 1 {
                let other = class.aspects.iter().map(|a| a.id).find(|other| *other != id).unwrap_or(id);
                x = swatch(svg, [x, y], &palette::shade(other.number(), 1, 2), "others");
            }
        }
        swatch(svg, [x, y], UNDECIDED, "undecided");
        // Lines in a row of their own: all samples in one are wider than the picture may be.
        let y = y + 17.0;
        let x = sample_line(svg, [left, y], Kind::Parallel, "det A = 0");
        let x = sample_line(svg, [x, y], Kind::Serial, "det B = 0");
        limit_samples(svg, [x, y], lines.iter().map(|line| line.0));
    }
}
