//! One standalone `report.html` and each of its figures as a file.

mod doubts;
pub mod motion;
mod page;
mod tables;
mod volume;

use crate::figure::{self, maps, slices, strips, survey::Survey};
use crate::file::put;
use aspecta::aspect::{Analysis, AspectClass, Cell, ClassId, Sample};
use rayon::prelude::*;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A figure: its file name without extension, and the SVG.
type Figure = (String, String);

/// The figures of a report, as the page arranges them.
struct Figures {
    robot: Option<Figure>,
    postures: Figure,
    /// One free coordinate: all classes as strips.
    strips: Option<Figure>,
    /// Two free coordinates: figure 9, one figure per class, Definitions 5 and 6.
    flat: Option<FlatFigures>,
    /// Three free coordinates: one figure of slices per mode.
    slices: Vec<Figure>,
}

struct FlatFigures {
    /// Figure 9, or its likeness of a slice.
    overview: Figure,
    classes: Vec<Figure>,
    /// Parallel and serial aspects, if the analysis has them.
    earlier: Option<[Figure; 2]>,
}

/// Writes `report.html` and `figures/*.svg` into `dir`, which is created if need be, and returns the paths written.
///
/// The page is self-contained: it opens from a file, with no network. Equal analyses give equal files but for the
/// seconds the run took. Each file appears under its name only when it is complete.
///
/// # Errors
/// Those of the file system.
pub fn write(analysis: &Analysis, dir: &Path) -> io::Result<Vec<PathBuf>> {
    let cells = cells(analysis);
    let figures = draw(analysis, &cells);
    let volume = if analysis.window.axes().len() == 3 { Some(volume::json(analysis, &cells)?) } else { None };
    let folder = dir.join("figures");
    fs::create_dir_all(&folder)?;
    let mut written = vec![put(dir, "report.html", page::page(analysis, &figures, volume.as_deref()))?];
    for (name, svg) in figures.all() {
        written.push(put(&folder, &format!("{name}.svg"), svg)?);
    }
    Ok(written)
}

/// The picture of all aspects of a robot, or of a slice, of which one or two coordinates vary: figure 9, or strips.
/// `None` of three.
pub fn overview(analysis: &Analysis) -> Option<String> {
    let cells = cells(analysis);
    match analysis.window.axes().len() {
        1 => Some(strips::strips(analysis, &cells)),
        2 => Some(maps::figure_9(&survey(analysis, &cells))),
        _ => None,
    }
}

fn cells(analysis: &Analysis) -> Vec<Vec<Cell>> {
    (0..analysis.classes.len()).map(|k| analysis.cells(ClassId::new(k))).collect()
}

fn survey<'a>(analysis: &'a Analysis, cells: &[Vec<Cell>]) -> Survey<'a> {
    let side = analysis.window.axes().into_iter().map(|k| side(analysis, k)).max().unwrap_or(1);
    Survey::new(analysis, cells, side)
}

impl Figures {
    fn all(&self) -> impl Iterator<Item = &Figure> {
        let flat = self
            .flat
            .iter()
            .flat_map(|f| [&f.overview].into_iter().chain(&f.classes).chain(f.earlier.iter().flatten()));
        self.robot.iter().chain([&self.postures]).chain(&self.strips).chain(flat).chain(&self.slices)
    }
}

fn draw(analysis: &Analysis, cells: &[Vec<Cell>]) -> Figures {
    let robot = &analysis.robot;
    let free = analysis.window.axes().len();
    Figures {
        robot: sample(analysis).map(|s| ("robot".into(), figure::robot::robot(robot, s))),
        postures: ("postures".into(), figure::robot::postures(robot, &analysis.modes)),
        strips: (free == 1).then(|| ("strips".into(), strips::strips(analysis, cells))),
        flat: (free == 2).then(|| flat(analysis, cells)),
        slices: if free == 3 { mode_slices(analysis, cells) } else { Vec::new() },
    }
}

/// A configuration to draw the robot in: that of the first mode that has one.
fn sample(analysis: &Analysis) -> Option<&Sample> {
    analysis.modes.iter().find_map(|m| m.sample.as_ref())
}

fn flat(analysis: &Analysis, cells: &[Vec<Cell>]) -> FlatFigures {
    let survey = survey(analysis, cells);
    let overview = if analysis.fixed.is_empty() { "figure9" } else { "overview" };
    let class =
        |c: &AspectClass| (maps::class_name(&survey, c.mode, c.det_a), maps::class(&survey, c.mode, c.det_a));
    FlatFigures {
        overview: (overview.into(), maps::figure_9(&survey)),
        classes: analysis.classes.iter().map(class).collect(),
        earlier: (!analysis.parallel_aspects.is_empty()).then(|| {
            [
                ("parallel-aspects".into(), maps::parallel_aspects(&survey)),
                ("serial-aspects".into(), maps::serial_aspects(&survey)),
            ]
        }),
    }
}

fn mode_slices(analysis: &Analysis, cells: &[Vec<Cell>]) -> Vec<Figure> {
    let free = analysis.window.axes();
    let sides = std::array::from_fn(|a| side(analysis, free[a]));
    let figure = |m: &aspecta::aspect::ModeReport| {
        let with_cells = analysis.classes.iter().zip(cells);
        let classes: Vec<(&AspectClass, &[Cell])> =
            with_cells.filter(|(c, _)| c.mode == m.mode).map(|(c, cells)| (c, &cells[..])).collect();
        let mode = slices::ModeCells { mode: m.mode, number: m.number, classes: &classes };
        (format!("slices-mf{}", m.number), slices::slices(&analysis.robot, &analysis.window, sides, &mode))
    };
    analysis.modes.par_iter().map(figure).collect()
}

/// Returns how many finest cells there are along a coordinate that varies.
fn side(analysis: &Analysis, axis: usize) -> usize {
    let (lo, hi) = analysis.window.ranges[axis];
    (((hi - lo) / analysis.run.resolution[axis]).round() as usize).max(1)
}
