//! The data of maps of a robot with two free coordinates, computed once and drawn by several figures.

use super::axes::Axis;
use super::barrier::Kind;
use super::curves::{Plane, Sheet};
use super::image::image;
use super::level::Grid;
use super::raster::{Label, Raster, pixels};
use aspecta::aspect::{Analysis, AspectClass, Cell, DetSign, Held};
use aspecta::kinematics::WorkingMode;
use aspecta::robot::{Robot, Window};
use aspecta::text::subscript;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Grid cells per side in which singular curves are looked for.
const GRID: usize = 512;
/// Pixels per side of the Q-aspects.
const PIXELS: usize = 768;

/// W, and of a robot with two joints Q, all classes; two coordinates vary, the others are held.
#[derive(Clone, Debug)]
pub struct Survey<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// The fixed coordinates, as [`slice_name`] writes them.
    pub slice: Option<String>,
    /// The coordinates that vary.
    pub axes: [usize; 2],
    /// Their axes.
    pub pose_axes: [Axis; 2],
    /// q₁ and q₂; `None` if there are more joints.
    pub joint_axes: Option<[Axis; 2]>,
    /// One entry a class.
    pub classes: Vec<ClassMap<'a>>,
    /// The boundary curves, one entry a working mode that was analysed.
    pub curves: Vec<ModeCurves>,
}

/// One class.
#[derive(Clone, Debug)]
pub struct ClassMap<'a> {
    /// Its numbers.
    pub class: &'a AspectClass,
    /// W-aspects: the certified cells.
    pub w: Raster<Label>,
    /// Q-aspects: their images, if Q is a plane.
    pub q: Option<Raster<Label>>,
}

/// Lines of one kind, as polylines.
pub type Lines = Vec<(Kind, Vec<[f64; 2]>)>;

/// The boundary curves of a mode.
#[derive(Clone, Debug)]
pub struct ModeCurves {
    /// The mode.
    pub mode: WorkingMode,
    /// In W.
    pub w: Lines,
    /// Their images in Q, if that is a plane; angles unwound.
    pub q: Lines,
}

impl<'a> Survey<'a> {
    /// Maps of all classes; two coordinates must vary. `cells[k]` are the cells of class k and `side` is the
    /// number of finest cells along an axis.
    pub fn new(analysis: &'a Analysis, cells: &[Vec<Cell>], side: usize) -> Self {
        let (robot, window, classes) = (&analysis.robot, &analysis.window, &analysis.classes);
        let varying = window.axes();
        let axes = [varying[0], varying[1]];
        let plane = Plane { through: window.ranges.iter().map(|r| r.0).collect(), axes };
        let pose_axes = axes.map(|k| pose_axis(robot, window, k));
        let joint_axes = (robot.dof() == 2).then(|| joint_axes(robot, classes));
        let side = side.clamp(1, 1024);
        let sheet = |mode| Sheet { robot, mode, plane: &plane };
        let maps = classes.par_iter().zip(cells).map(|(class, cells)| ClassMap {
            class,
            w: cell_raster(cells, &pose_axes, [0, 1], [side, side]),
            q: joint_axes.as_ref().map(|q| image(&sheet(class.mode), class.det_a, cells, q, PIXELS)),
        });
        let classes = maps.collect();
        let grid = Grid { x: pose_axes[0].range, y: pose_axes[1].range, n: GRID };
        let curves = analysis
            .modes
            .par_iter()
            .map(|report| mode_curves(&sheet(report.mode), &grid, joint_axes.as_ref()))
            .collect();
        Self { robot, slice: slice_name(&analysis.fixed), axes, pose_axes, joint_axes, classes, curves }
    }

    /// The map of a mode and sign, and the mode's curves.
    pub fn of(&self, mode: WorkingMode, sign: DetSign) -> Option<(&ClassMap<'a>, &ModeCurves)> {
        let map = self.classes.iter().find(|c| c.class.mode == mode && c.class.det_a == sign)?;
        Some((map, self.curves.iter().find(|c| c.mode == mode)?))
    }
}

fn mode_curves(sheet: &Sheet<'_>, grid: &Grid, joint_axes: Option<&[Axis; 2]>) -> ModeCurves {
    let curves = sheet.curves(grid);
    let images = |axes: &[Axis; 2]| {
        let step = [0, 1].map(|k| axes[k].span() / 200.0);
        let images = curves.iter().flat_map(|curve| sheet.images(curve, &step));
        images.map(|(kind, line)| (kind, line.iter().map(|q| [q[0], q[1]]).collect())).collect()
    };
    let q = joint_axes.map_or(Vec::new(), images);
    ModeCurves { mode: sheet.mode, q, w: curves.into_iter().map(|c| (c.kind, c.points)).collect() }
}

/// `slice φ = 0.5 rad`, if anything is held.
pub fn slice_name(fixed: &[Held]) -> Option<String> {
    let part = |h: &Held| format!("{} = {} {}", coordinate_name(h.coordinate), h.value, h.unit);
    let parts: Vec<_> = fixed.iter().map(part).collect();
    (!parts.is_empty()).then(|| format!("slice {}", parts.join(", ")).replace('-', "−"))
}

/// The axis of a pose coordinate.
pub fn pose_axis(robot: &Robot, window: &Window, k: usize) -> Axis {
    let c = robot.platform.coordinates()[k];
    let unit = if c.angle { "rad" } else { &robot.length_unit };
    Axis { label: format!("{} [{unit}]", coordinate_name(c.name)), range: window.ranges[k], angle: c.angle }
}

/// A coordinate's name as it is written in formulas.
pub fn coordinate_name(name: &str) -> &str {
    if name == "phi" { "φ" } else { name }
}

/// The joint's own range for angles, a full turn if it has none; the bounds over all aspects for lengths.
fn joint_axes(robot: &Robot, classes: &[AspectClass]) -> [Axis; 2] {
    [0, 1].map(|k| {
        let angle = robot.legs[k].actuator.is_angle();
        let bounds = || classes.iter().flat_map(|c| &c.aspects).map(|a| a.q_bounds[k]);
        let (lo, hi) =
            (bounds().map(|b| b.0).fold(f64::MAX, f64::min), bounds().map(|b| b.1).fold(f64::MIN, f64::max));
        let range = if angle {
            robot.legs[k].drive_range().unwrap_or((-PI, PI))
        } else if lo < hi {
            (lo, hi)
        } else {
            (0.0, 1.0)
        };
        joint_axis(robot, k, range)
    })
}

/// The axis of a joint, over a range.
pub fn joint_axis(robot: &Robot, k: usize, range: (f64, f64)) -> Axis {
    let angle = robot.legs[k].actuator.is_angle();
    let unit = if angle { "rad" } else { &robot.length_unit };
    Axis { label: format!("q{} [{unit}]", subscript(k + 1)), range, angle }
}

/// Cells as pixels over a plane of poses. Where cells are smaller than a pixel, undecided ones come first and
/// inner ones before what is outside: nothing is lost, and no boundary moves by more than a pixel.
pub fn cell_raster(cells: &[Cell], axes: &[Axis; 2], which: [usize; 2], size: [usize; 2]) -> Raster<Label> {
    let mut raster = Raster::filled(size[0], size[1], Label::Outside);
    let inner = cells.iter().filter(|c| c.aspect.is_some());
    for cell in inner.chain(cells.iter().filter(|c| c.aspect.is_none())) {
        let range = |k: usize| pixels((cell.lo[which[k]], cell.hi[which[k]]), axes[k].range, size[k]);
        raster.paint(range(0), range(1), cell.aspect.map_or(Label::Undecided, Label::Aspect));
    }
    raster
}
