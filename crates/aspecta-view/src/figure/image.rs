//! The image of a set of poses in the joint space: Q-aspects π_Q(A) (Definition 8), drawn on a raster
//! (*numerical*).

use super::axes::Axis;
use super::barrier::Barriers;
use super::curves::{Sheet, unwind};
use super::level::Grid;
use super::raster::{Label, Raster};
use aspecta::aspect::{Cell, DetSign};

/// A cell is cut into four until its image spans fewer pixels than this, …
const COARSE: f64 = 48.0;
/// … at most so often, …
const CUTS: u32 = 7;
/// … and then into a grid of quadrilaterals of about this size.
const FINE: f64 = 4.0;
/// Pixels within this distance (in pixels) of a quadrilateral are drawn too, so that neighbours leave no gap.
const SLACK: f64 = 0.6;

/// Draws the images g_s(cell) of a class of a robot with two coordinates on a raster over `axes`; angles wrap
/// round.
///
/// Undecided cells are drawn where f64 finds a configuration of the class at a corner of a piece of them, and
/// beneath the others.
pub fn image(
    sheet: &Sheet<'_>,
    sign: DetSign,
    cells: &[Cell],
    axes: &[Axis; 2],
    pixels: usize,
) -> Raster<Label> {
    let mut canvas = Canvas { sheet, sign, axes, raster: Raster::filled(pixels, pixels, Label::Outside) };
    let undecided = cells.iter().filter(|c| c.aspect.is_none());
    for cell in undecided.chain(cells.iter().filter(|c| c.aspect.is_some())) {
        canvas.draw(cell, [cell.lo[0], cell.lo[1]], [cell.hi[0], cell.hi[1]], CUTS);
    }
    canvas.raster
}

struct Canvas<'a> {
    sheet: &'a Sheet<'a>,
    sign: DetSign,
    axes: &'a [Axis; 2],
    raster: Raster<Label>,
}

impl Canvas<'_> {
    fn draw(&mut self, cell: &Cell, lo: [f64; 2], hi: [f64; 2], cuts: u32) {
        let middle = [0.5 * (lo[0] + hi[0]), 0.5 * (lo[1] + hi[1])];
        let centre = self.sheet.barriers(middle).q;
        let corners = [lo, [hi[0], lo[1]], hi, [lo[0], hi[1]]].map(|p| self.map(p, &centre).0);
        let [across, up] = extent(&corners);
        let size = (across.1 - across.0).max(up.1 - up.0);
        if cuts == 0 || size <= COARSE {
            self.draw_grid(cell, lo, hi, &centre, (size / FINE).ceil().clamp(1.0, COARSE) as usize);
            return;
        }
        for k in 0..4 {
            let pick = |axis: usize, high: bool| {
                if high { (middle[axis], hi[axis]) } else { (lo[axis], middle[axis]) }
            };
            let (x, y) = (pick(0, k & 1 == 1), pick(1, k & 2 == 2));
            self.draw(cell, [x.0, y.0], [x.1, y.1], cuts - 1);
        }
    }

    /// Draws a piece of a cell as n × n quadrilaterals, angles unwound to be near those of `centre`.
    fn draw_grid(&mut self, cell: &Cell, lo: [f64; 2], hi: [f64; 2], centre: &[f64], n: usize) {
        let grid = Grid { x: (lo[0], hi[0]), y: (lo[1], hi[1]), n };
        let nodes = grid.sample(|p| self.map(p, centre));
        for k in (0..n * n).map(|k| k % n + (k / n) * (n + 1)) {
            let quad = [k, k + 1, k + n + 2, k + n + 1].map(|node| nodes[node]);
            let label = cell.aspect.map_or(Label::Undecided, Label::Aspect);
            if cell.aspect.is_some() || quad.iter().any(|node| node.1) {
                self.fill(&quad.map(|node| node.0), label);
            }
        }
    }

    /// The image of a pose in pixels, and whether f64 finds it in the class.
    fn map(&self, p: [f64; 2], centre: &[f64]) -> ([f64; 2], bool) {
        let b = self.sheet.barriers(p);
        let belongs = self.belongs(&b);
        (self.to_pixels(&unwind(self.sheet.robot, b.q, centre)), belongs)
    }

    fn belongs(&self, b: &Barriers) -> bool {
        let positive = b.det > 0.0;
        positive == (self.sign == DetSign::Positive) && b.margins.iter().all(|m| m.1 > 0.0)
    }

    fn to_pixels(&self, q: &[f64]) -> [f64; 2] {
        let n = self.raster.size().0 as f64;
        std::array::from_fn(|k| (q[k] - self.axes[k].range.0) / self.axes[k].span() * n)
    }

    fn fill(&mut self, corners: &[[f64; 2]; 4], label: Label) {
        let [across, up] = extent(corners);
        let first = |x: f64| (x - SLACK - 0.5).ceil() as i64;
        let last = |x: f64| (x + SLACK - 0.5).floor() as i64;
        for row in first(up.0)..=last(up.1) {
            for column in first(across.0)..=last(across.1) {
                if near([column as f64 + 0.5, row as f64 + 0.5], corners)
                    && let (Some(column), Some(row)) = (self.wrap(column, 0), self.wrap(row, 1))
                {
                    self.raster.paint(column..column + 1, row..row + 1, label);
                }
            }
        }
    }

    /// The pixel itself, its copy on a full turn, or none beyond the plot.
    fn wrap(&self, pixel: i64, axis: usize) -> Option<usize> {
        let n = self.raster.size().0 as i64;
        let pixel = if self.axes[axis].is_full_turn() { pixel.rem_euclid(n) } else { pixel };
        (0..n).contains(&pixel).then_some(pixel as usize)
    }
}

/// The ranges of both coordinates.
fn extent(corners: &[[f64; 2]; 4]) -> [(f64, f64); 2] {
    [0, 1].map(|k| {
        let of = corners.iter().map(|c| c[k]);
        (of.clone().fold(f64::MAX, f64::min), of.fold(f64::MIN, f64::max))
    })
}

/// Whether p is in the quadrilateral or within [`SLACK`] of it.
fn near(p: [f64; 2], corners: &[[f64; 2]; 4]) -> bool {
    let mut winding = 0;
    for k in 0..4 {
        let (a, b) = (corners[k], corners[(k + 1) % 4]);
        let (ab, ap) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
        let cross = ab[0] * ap[1] - ab[1] * ap[0];
        let length2 = ab[0] * ab[0] + ab[1] * ab[1];
        let t = if length2 > 0.0 { ((ab[0] * ap[0] + ab[1] * ap[1]) / length2).clamp(0.0, 1.0) } else { 0.0 };
        if (ap[0] - t * ab[0]).hypot(ap[1] - t * ab[1]) <= SLACK {
            return true;
        }
        winding += i32::from(a[1] <= p[1] && b[1] > p[1] && cross > 0.0);
        winding -= i32::from(a[1] > p[1] && b[1] <= p[1] && cross < 0.0);
    }
    winding != 0
}
