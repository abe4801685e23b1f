//! Vectors as people read them.

use crate::input::Columns;
use crate::output;
use aspecta::robot::Robot;

/// Prints vectors as people read them: names, units, degrees if asked for.
pub struct Labels {
    columns: Columns,
    units: Vec<String>,
    degrees: bool,
}

impl Labels {
    /// Labels of pose coordinates.
    pub fn pose(robot: &Robot, degrees: bool) -> Self {
        Self::of(Columns::pose(robot), robot, degrees)
    }

    /// Labels of joint coordinates.
    pub fn joints(robot: &Robot, degrees: bool) -> Self {
        Self::of(Columns::joints(robot), robot, degrees)
    }

    fn of(columns: Columns, robot: &Robot, degrees: bool) -> Self {
        let angle = if degrees { "deg" } else { "rad" };
        let unit = |is_angle: &bool| if *is_angle { angle } else { &*robot.length_unit }.to_owned();
        Self { units: columns.angles.iter().map(unit).collect(), columns, degrees }
    }

    /// Those of some coordinates, by index.
    pub fn only(mut self, which: &[usize]) -> Self {
        self.columns.names = which.iter().map(|&k| self.columns.names[k].clone()).collect();
        self.columns.angles = which.iter().map(|&k| self.columns.angles[k]).collect();
        self.units = which.iter().map(|&k| self.units[k].clone()).collect();
        self
    }

    /// Column headings: `x [mm]`.
    pub fn headings(&self) -> impl Iterator<Item = String> + '_ {
        self.columns.names.iter().zip(&self.units).map(|(name, unit)| format!("{name} [{unit}]"))
    }

    /// The numbers alone.
    pub fn numbers<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = String> + 'a {
        let shown = |(x, angle): (&f64, &bool)| if *angle && self.degrees { x.to_degrees() } else { *x };
        values.iter().zip(&self.columns.angles).map(move |pair| output::number(shown(pair)))
    }

    /// `x = 1.0000, y = …`: five digits, no units.
    pub fn brief(&self, values: &[f64]) -> String {
        let parts =
            self.columns.names.iter().zip(values).map(|(name, x)| format!("{name} = {}", output::brief(*x)));
        parts.collect::<Vec<_>>().join(", ")
    }

    /// `x = 1.000000 mm, y = …`.
    pub fn sentence(&self, values: &[f64]) -> String {
        let names = self.columns.names.iter().zip(&self.units);
        let parts = names.zip(self.numbers(values)).map(|((name, unit), x)| format!("{name} = {x} {unit}"));
        parts.collect::<Vec<_>>().join(", ")
    }
}

/// The unit of det A: every row of A is a length, every moment a length more; numbers for robots that only turn.
pub fn det_a_unit(robot: &Robot) -> String {
    let coordinates = robot.platform.coordinates();
    let angles = coordinates.iter().filter(|c| c.angle).count();
    if angles == coordinates.len() {
        return String::new();
    }
    format!(" [{}^{}]", robot.length_unit, coordinates.len() + angles)
}
