//! Labels on a regular lattice, and their outlines as compact SVG paths.

use aspecta::aspect::AspectId;
use std::collections::BTreeMap;
use std::fmt::Write;

/// The label of a place with respect to one class of aspects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Label {
    /// Certainly in no aspect of the class.
    Outside,
    /// Not decided at this resolution.
    Undecided,
    /// In this aspect.
    Aspect(AspectId),
}

/// A columns × rows lattice of labels; the first row is the lowest.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster<T> {
    columns: usize,
    rows: usize,
    pixels: Vec<T>,
}

impl<T: Copy + PartialEq> Raster<T> {
    /// A lattice filled with one label.
    pub fn filled(columns: usize, rows: usize, label: T) -> Self {
        Self { columns, rows, pixels: vec![label; columns * rows] }
    }

    /// A lattice with `label(column, row)` everywhere.
    pub fn from_fn(columns: usize, rows: usize, mut label: impl FnMut(usize, usize) -> T) -> Self {
        let pixels = (0..rows * columns).map(|k| label(k % columns, k / columns)).collect();
        Self { columns, rows, pixels }
    }

    /// (columns, rows).
    pub fn size(&self) -> (usize, usize) {
        (self.columns, self.rows)
    }

    /// The label of a pixel.
    pub fn at(&self, column: usize, row: usize) -> T {
        self.pixels[row * self.columns + column]
    }

    /// Labels every pixel of the columns and rows in the given half-open ranges.
    pub fn paint(&mut self, columns: std::ops::Range<usize>, rows: std::ops::Range<usize>, label: T) {
        for row in rows.start..rows.end.min(self.rows) {
            let line = &mut self.pixels[row * self.columns..(row + 1) * self.columns];
            line[columns.start.min(columns.end)..columns.end.min(self.columns)].fill(label);
        }
    }

    /// The labels that occur, each once, in order.
    pub fn labels(&self) -> Vec<T>
    where
        T: Ord,
    {
        let mut all = self.pixels.clone();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The largest square of pixels with each label: the labels in order, each with the square's lower left
    /// (column, row) and its side.
    pub fn squares(&self) -> Vec<(T, (usize, usize), usize)>
    where
        T: Ord,
    {
        let mut largest: BTreeMap<T, ((usize, usize), usize)> = BTreeMap::new();
        // Sides of the squares that end at the pixels of the row below, and of this row so far.
        let (mut below, mut sides) = (vec![0; self.columns], vec![0; self.columns]);
        for row in 0..self.rows {
            std::mem::swap(&mut below, &mut sides);
            for column in 0..self.columns {
                let label = self.at(column, row);
                let alike = column > 0
                    && row > 0
                    && [(1, 0), (0, 1), (1, 1)].iter().all(|(c, r)| self.at(column - c, row - r) == label);
                let around = || sides[column - 1].min(below[column]).min(below[column - 1]);
                let side = 1 + if alike { around() } else { 0 };
                sides[column] = side;
                let best = largest.entry(label).or_insert(((column, row), 0));
                if side > best.1 {
                    *best = ((column + 1 - side, row + 1 - side), side);
                }
            }
        }
        largest.into_iter().map(|(label, (corner, side))| (label, corner, side)).collect()
    }

    /// The outline of all pixels with `label` as an SVG path in lattice units, counter-clockwise outside, so
    /// that it can be filled without seams.
    pub fn outline(&self, label: T) -> String {
        let is = |x: i32, y: i32| {
            let inside = (0..self.columns as i32).contains(&x) && (0..self.rows as i32).contains(&y);
            inside && self.at(x as usize, y as usize) == label
        };
        // The pixels to the left and to the right of the edge that leaves (x, y) in direction 0..4 = +x, +y,
        // −x, −y.
        let is_edge = |x: i32, y: i32, direction: usize| {
            let (left, right) = match direction {
                0 => ((x, y), (x, y - 1)),
                1 => ((x - 1, y), (x, y)),
                2 => ((x - 1, y - 1), (x - 1, y)),
                _ => ((x, y - 1), (x - 1, y - 1)),
            };
            is(left.0, left.1) && !is(right.0, right.1)
        };
        let mut seen = vec![false; self.pixels.len()];
        let mut d = String::new();
        for k in 0..self.pixels.len() {
            let start = ((k % self.columns) as i32, (k / self.columns) as i32);
            if seen[k] || !is_edge(start.0, start.1, 0) {
                continue;
            }
            let _ = write!(d, "M{} {}", start.0, start.1);
            let (mut x, mut y, mut direction, mut run) = (start.0, start.1, 0, 0);
            loop {
                if direction == 0 {
                    seen[y as usize * self.columns + x as usize] = true;
                }
                let (dx, dy) = [(1, 0), (0, 1), (-1, 0), (0, -1)][direction];
                (x, y, run) = (x + dx, y + dy, run + dx + dy);
                // Left first: pixels that touch at a corner only get outlines of their own.
                let turns = [1, 0, 3].map(|t| (direction + t) % 4);
                let next = turns.into_iter().find(|&t| is_edge(x, y, t)).unwrap_or(0);
                let closed = (x, y) == start && next == 0;
                if next != direction || closed {
                    let _ = write!(d, "{}{run}", if direction % 2 == 0 { 'h' } else { 'v' });
                    (direction, run) = (next, 0);
                }
                if closed {
                    d.push('z');
                    break;
                }
            }
        }
        d
    }
}

/// The lattice lines that enclose [lo, hi] ⊂ range when cut into n: a half-open range of pixels. Bounds that
/// lie on a line up to rounding count as on it; at least one pixel.
pub fn pixels((lo, hi): (f64, f64), range: (f64, f64), n: usize) -> std::ops::Range<usize> {
    let scale = n as f64 / (range.1 - range.0);
    let slack = 1e-6;
    let first = ((lo - range.0) * scale + slack).floor().max(0.0) as usize;
    let last = ((hi - range.0) * scale - slack).ceil().max(0.0) as usize;
    first..last.max(first + 1).min(n)
}
