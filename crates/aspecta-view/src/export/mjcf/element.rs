//! XML elements and the numbers in them.

use crate::figure::skeleton::Point;
use crate::xml::escape;
use std::fmt::{self, Display, Formatter};

/// An element with attributes and children.
pub struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Element>,
}

impl Element {
    pub fn new(name: &'static str) -> Self {
        Self { name, attributes: Vec::new(), children: Vec::new() }
    }

    /// With an attribute.
    pub fn with(mut self, name: &'static str, value: impl Display) -> Self {
        self.attributes.push((name, value.to_string()));
        self
    }

    /// With an attribute that is a list of numbers.
    pub fn numbers(self, name: &'static str, values: &[f64]) -> Self {
        let digits: Vec<_> = values.iter().map(|x| digits(*x)).collect();
        self.with(name, digits.join(" "))
    }

    /// With a point or a vector.
    pub fn vector(self, name: &'static str, v: Point) -> Self {
        self.numbers(name, &v)
    }

    /// With a child after those it has.
    pub fn child(self, child: Self) -> Self {
        self.children([child])
    }

    /// With children after those it has.
    pub fn children(mut self, children: impl IntoIterator<Item = Self>) -> Self {
        self.children.extend(children);
        self
    }

    fn write(&self, f: &mut Formatter<'_>, indent: usize) -> fmt::Result {
        write!(f, "{:indent$}<{}", "", self.name)?;
        for (name, value) in &self.attributes {
            write!(f, " {name}=\"{}\"", escape(value))?;
        }
        if self.children.is_empty() {
            return writeln!(f, "/>");
        }
        writeln!(f, ">")?;
        self.children.iter().try_for_each(|child| child.write(f, indent + 2))?;
        writeln!(f, "{:indent$}</{}>", "", self.name)
    }
}

impl Display for Element {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.write(f, 0)
    }
}

/// Twelve significant digits: what differs between the sines of two machines does not show.
fn digits(x: f64) -> String {
    let rounded: f64 = format!("{x:.11e}").parse().unwrap_or(x);
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}
