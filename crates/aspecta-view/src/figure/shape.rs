//! Drawings as data: what a figure draws once and an animation draws for every sample, moving what differs.

use super::svg::{Anchor, Svg};

/// Something drawn. Lengths in CSS pixels, y downward.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// The points that place the shape: the corners, the centre, or the middle of a text's baseline.
    pub points: Vec<[f64; 2]>,
    /// The kind of shape.
    pub kind: Kind,
    /// Its style.
    pub style: String,
}

/// The kind of a [`Shape`].
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A polyline.
    Open,
    /// A polygon.
    Closed,
    /// A circle of a radius.
    Circle(f64),
    /// A text of a size.
    Text(f64, String),
}

/// Shapes in the order in which they are drawn.
#[derive(Clone, Debug, Default)]
pub struct Shapes(pub Vec<Shape>);

impl Shapes {
    /// An open (or closed) polyline.
    pub fn polyline(&mut self, points: &[[f64; 2]], closed: bool, style: &str) {
        self.put(points, if closed { Kind::Closed } else { Kind::Open }, style);
    }

    /// A segment.
    pub fn line(&mut self, a: [f64; 2], b: [f64; 2], style: &str) {
        self.put(&[a, b], Kind::Open, style);
    }

    /// A circle.
    pub fn circle(&mut self, centre: [f64; 2], radius: f64, style: &str) {
        self.put(&[centre], Kind::Circle(radius), style);
    }

    /// A line of text, centred.
    pub fn text(&mut self, at: [f64; 2], size: f64, style: &str, text: &str) {
        self.put(&[at], Kind::Text(size, text.to_owned()), style);
    }

    fn put(&mut self, points: &[[f64; 2]], kind: Kind, style: &str) {
        self.0.push(Shape { points: points.to_vec(), kind, style: style.to_owned() });
    }
}

impl Svg {
    /// Draws a shape.
    pub fn shape(&mut self, Shape { points, kind, style }: &Shape) {
        match (kind, points.first()) {
            (Kind::Open | Kind::Closed, _) => self.polyline(points, *kind == Kind::Closed, style),
            (Kind::Circle(radius), Some(&centre)) => self.circle(centre, *radius, style),
            (Kind::Text(size, text), Some(&at)) => self.text(at, Anchor::Middle, *size, style, text),
            (Kind::Circle(_) | Kind::Text(..), None) => {}
        }
    }
}
