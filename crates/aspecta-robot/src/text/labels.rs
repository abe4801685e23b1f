//! Vectors as people read them.

use super::numbers;
use crate::Robot;

/// Prints vectors as people read them: names, units, degrees if asked for.
#[derive(Clone, Debug, Default)]
pub struct Labels {
    names: Vec<String>,
    angles: Vec<bool>,
    units: Vec<String>,
    degrees: bool,
}

impl Labels {
    /// Labels of pose coordinates.
    pub fn pose(robot: &Robot, degrees: bool) -> Self {
        let coordinates = robot.platform.coordinates();
        let names = coordinates.iter().map(|c| c.name.to_owned()).collect();
        Self::of(names, coordinates.iter().map(|c| c.angle).collect(), robot, degrees)
    }

    /// Labels of joint coordinates.
    pub fn joints(robot: &Robot, degrees: bool) -> Self {
        let names = (1..=robot.dof()).map(|k| format!("q{k}")).collect();
        Self::of(names, robot.legs.iter().map(|leg| leg.actuator.is_angle()).collect(), robot, degrees)
    }

    fn of(names: Vec<String>, angles: Vec<bool>, robot: &Robot, degrees: bool) -> Self {
        let angle = if degrees { "deg" } else { "rad" };
        let unit = |is_angle: &bool| if *is_angle { angle } else { &*robot.length_unit }.to_owned();
        Self { units: angles.iter().map(unit).collect(), names, angles, degrees }
    }

    /// Returns the same labels with angles in degrees.
    pub fn in_degrees(mut self) -> Self {
        let angles = self.units.iter_mut().zip(&self.angles).filter(|(_, angle)| **angle);
        angles.for_each(|(unit, _)| *unit = "deg".into());
        Self { degrees: true, ..self }
    }

    /// Returns the labels of some coordinates, by index.
    pub fn only(mut self, which: &[usize]) -> Self {
        self.names = which.iter().map(|&k| self.names[k].clone()).collect();
        self.angles = which.iter().map(|&k| self.angles[k]).collect();
        self.units = which.iter().map(|&k| self.units[k].clone()).collect();
        self
    }

    /// Column headings: `x [mm]`.
    pub fn headings(&self) -> impl Iterator<Item = String> + '_ {
        self.names.iter().zip(&self.units).map(|(name, unit)| format!("{name} [{unit}]"))
    }

    /// The numbers alone.
    pub fn numbers<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = String> + 'a {
        self.shown(values).map(numbers::number)
    }

    /// The numbers alone, in five digits.
    pub fn briefly<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = String> + 'a {
        self.shown(values).map(numbers::brief)
    }

    fn shown<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let shown = |(x, angle): (&f64, &bool)| if *angle && self.degrees { x.to_degrees() } else { *x };
        values.iter().zip(&self.angles).map(shown)
    }

    /// `x = 1.0000, y = …`: five digits, no units but degrees.
    pub fn brief(&self, values: &[f64]) -> String {
        let names = self.names.iter().zip(&self.angles);
        let unit = |angle: &bool| if *angle && self.degrees { " deg" } else { "" };
        let part = |((name, angle), x): ((&String, &bool), String)| format!("{name} = {x}{}", unit(angle));
        names.zip(self.briefly(values)).map(part).collect::<Vec<_>>().join(", ")
    }

    /// `x = 1.000000 mm, y = …`.
    pub fn sentence(&self, values: &[f64]) -> String {
        let names = self.names.iter().zip(&self.units);
        let parts = names.zip(self.numbers(values)).map(|((name, unit), x)| format!("{name} = {x} {unit}"));
        parts.collect::<Vec<_>>().join(", ")
    }
}

/// The unit of det A: every row of A is a length, every moment a length more; numbers for robots that only
/// turn.
pub fn det_a_unit(robot: &Robot) -> String {
    let coordinates = robot.platform.coordinates();
    let angles = coordinates.iter().filter(|c| c.angle).count();
    if angles == coordinates.len() {
        return String::new();
    }
    format!(" [{}^{}]", robot.length_unit, coordinates.len() + angles)
}
