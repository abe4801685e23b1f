//! The robot in motion: one view of all its configurations.

use super::parts::legend;
use super::robot::{Drawing, View, label};
use super::shape::Shapes;
use super::skeleton::Skeleton;
use super::svg::Svg;
use aspecta::robot::{Platform, Robot};

/// Configurations of a motion that names are kept clear of.
const CLEAR_OF: usize = 40;

/// A robot in motion, in one view that shows it all.
pub struct Film {
    /// The still background, to draw on.
    pub svg: Svg,
    /// The robot in each configuration: the same shapes, elsewhere.
    pub frames: Vec<Shapes>,
    /// The platform's position in each: its frame's origin, or of a platform that only turns the end of its
    /// third unit vector.
    pub path: Vec<[f64; 2]>,
}

/// The robot in configurations (X, q), with the names of its base joints and a legend.
pub fn film(robot: &Robot, configurations: &[(&[f64], &[f64])]) -> Film {
    let (width, height) = (620.0, 520.0);
    let mut svg = Svg::new("robot", width, height, &format!("Robot {} in motion", robot.name));
    let skeletons: Vec<Skeleton> = configurations.iter().map(|(x, q)| Skeleton::at(robot, x, q)).collect();
    let all: Vec<&Skeleton> = skeletons.iter().collect();
    let view = View::fit(robot, &all, [62.0, 28.0, width - 82.0, height - 108.0]);
    view.backdrop(&mut svg, "", &robot.length_unit);
    legend(&mut svg, robot, [62.0, width - 20.0, height - 14.0]);
    let drawing = |skeleton| Drawing { robot, skeleton, view: &view, large: true };
    // Names that stand still are clear of the robot wherever it goes.
    let every = skeletons.len().div_ceil(CLEAR_OF);
    let lines = skeletons.iter().step_by(every.max(1)).flat_map(|s| drawing(s).lines()).collect();
    let bases = skeletons.first().map_or(Vec::new(), |first| drawing(first).names());
    let bases = bases.into_iter().filter(|(_, name)| name.starts_with('A')).collect();
    let mut names = Shapes::default();
    label(&mut names, &view, lines, bases);
    let frame = |skeleton| {
        let mut shapes = drawing(skeleton).shapes();
        shapes.0.extend(names.0.iter().cloned());
        shapes
    };
    let turns = robot.platform == Platform::TurningBody;
    let place = |s: &Skeleton| view.at(if turns { s.axes[2] } else { s.origin });
    Film { frames: skeletons.iter().map(frame).collect(), path: skeletons.iter().map(place).collect(), svg }
}
