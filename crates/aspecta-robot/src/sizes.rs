//! Lengths of a robot that do not belong together.

use crate::Robot;
use crate::legs::Size;
use crate::num::Interval;

/// Lengths of one robot differ by less: by this much only if some are in other units than others.
const APART: f64 = 100.0;

/// Two lengths of a robot that are so far apart that they seem to be in different units
/// ([`Robot::mixed_units`]).
#[derive(Clone, Debug, PartialEq)]
pub struct MixedUnits {
    /// The small one: what it is, and its size.
    pub small: (String, f64),
    /// The large one.
    pub large: (String, f64),
}

impl Robot {
    /// Whether some lengths of the robot seem to be in metres, say, and others in millimetres: the size of the
    /// base (the greatest distance of two anchors), that of the platform, and the links of the legs. Lengths of
    /// zero do not count.
    ///
    /// # Examples
    /// ```
    /// use aspecta_robot::{Leg, Robot};
    ///
    /// let mut robot = Robot::resolve("five-bar")?;
    /// assert!(robot.mixed_units().is_none());
    ///
    /// robot.legs[1] = Leg::revolute([9.0, 0.0], [0.0, 0.0], 5.0, 8000.0);
    /// assert_eq!(robot.mixed_units().unwrap().large.0, "the rod of leg 2");
    /// # Ok::<(), aspecta_robot::FileError>(())
    /// ```
    pub fn mixed_units(&self) -> Option<MixedUnits> {
        let points = |of: fn(&crate::Leg) -> [Interval; 3]| self.legs.iter().map(of).collect::<Vec<_>>();
        let mut sizes = vec![
            ("the base".to_owned(), spread(&points(|leg| leg.anchor))),
            ("the platform".to_owned(), spread(&points(|leg| leg.attachment))),
        ];
        for (j, leg) in self.legs.iter().enumerate() {
            for dimension in leg.actuator.dimensions(leg) {
                let size = match dimension.size {
                    Some(Size::Length(length) | Size::Lengths(_, length)) => length,
                    Some(Size::Angle(_)) | None => continue,
                };
                sizes.push((format!("the {} of leg {}", dimension.name, j + 1), size));
            }
        }
        sizes.retain(|(_, size)| *size > 0.0);
        let small = sizes.iter().min_by(|a, b| a.1.total_cmp(&b.1))?.clone();
        let large = sizes.iter().max_by(|a, b| a.1.total_cmp(&b.1))?.clone();
        (large.1 > APART * small.1).then_some(MixedUnits { small, large })
    }
}

/// The greatest distance of two points.
fn spread(points: &[[Interval; 3]]) -> f64 {
    let distance = |a: &[Interval; 3], b: &[Interval; 3]| {
        (0..3).map(|k| (a[k].mid() - b[k].mid()).powi(2)).sum::<f64>().sqrt()
    };
    points.iter().flat_map(|a| points.iter().map(move |b| distance(a, b))).fold(0.0, f64::max)
}
