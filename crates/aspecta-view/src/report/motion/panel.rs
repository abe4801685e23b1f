//! A picture in which something moves. Elements say by `data-` attributes which tracks move them; `motion.js`
//! does so.

use super::PATH;
use super::tracks::{PIXEL, Tracks};
use crate::figure::level::simplify;
use crate::figure::shape::Shapes;
use crate::figure::svg::Svg;
use std::fmt::Display;

/// A picture and the tracks it adds to.
pub struct Panel<'a> {
    /// The picture, to draw the still parts on.
    pub svg: Svg,
    tracks: &'a mut Tracks,
}

impl<'a> Panel<'a> {
    /// A picture that goes on from a drawing.
    pub fn new(svg: Svg, tracks: &'a mut Tracks) -> Self {
        Self { svg, tracks }
    }

    /// Draws the same shapes in every frame, where that frame has them.
    pub fn moving(&mut self, frames: &[Shapes]) {
        let Some(first) = frames.first() else { return };
        for (k, shape) in first.0.iter().enumerate() {
            if frames.iter().all(|frame| frame.0[k].points == shape.points) {
                self.svg.shape(shape);
                continue;
            }
            let coordinates = (0..shape.points.len()).flat_map(|i| [(i, 0), (i, 1)]);
            let track = |(i, axis): (usize, usize)| {
                self.tracks.add(frames.iter().map(|frame| frame.0[k].points[i][axis]), PIXEL)
            };
            let numbers = list(coordinates.map(track));
            self.svg.open(&format!("data-points=\"{numbers}\""));
            self.svg.shape(shape);
            self.svg.close();
        }
    }

    /// A path that is drawn thin, and boldly as far as the motion has come, where there is a dot. It is
    /// interrupted before each frame of `breaks`.
    pub fn trail(&mut self, path: &[[f64; 2]], breaks: &[usize], dot: f64) {
        let style = |colour: &str, width: f64| {
            format!(
                "fill:none;stroke:{colour};stroke-width:{width};stroke-linejoin:round;stroke-linecap:round"
            )
        };
        let ends: Vec<usize> = [0].into_iter().chain(breaks.iter().copied()).chain([path.len()]).collect();
        let parts: Vec<_> = ends.windows(2).map(|part| simplify(&path[part[0]..part[1]], 0.05)).collect();
        for (colour, width) in [("#fff", 4.5), (PATH, 1.0)] {
            parts.iter().for_each(|part| self.svg.polyline(part, false, &style(colour, width)));
        }
        let [x, y] = [0, 1].map(|axis| self.tracks.add(path.iter().map(|p| p[axis]), PIXEL));
        self.svg.open(&format!("data-trail=\"{x} {y}\" data-breaks=\"{}\"", list(breaks)));
        self.svg.path("M0 0", &style(PATH, 2.4));
        self.svg.close();
        let here = |at: &[f64; 2]| {
            let mut shapes = Shapes::default();
            shapes.circle(*at, dot, &format!("fill:{PATH};stroke:#fff;stroke-width:1.5"));
            shapes
        };
        self.moving(&path.iter().map(here).collect::<Vec<_>>());
    }

    /// Opens a group that is seen in the frames in which a track has this value.
    pub fn open_case(&mut self, track: usize, value: usize, shown: bool) {
        let display = if shown { "" } else { " style=\"display:none\"" };
        self.svg.open(&format!("data-switch=\"{track}\" data-case=\"{value}\"{display}"));
    }

    /// A track of its own.
    pub fn track(&mut self, values: impl Iterator<Item = f64>) -> usize {
        self.tracks.add(values, 1.0)
    }
}

fn list(items: impl IntoIterator<Item = impl Display>) -> String {
    items.into_iter().map(|item| item.to_string()).collect::<Vec<_>>().join(" ")
}
