//! What bounds the configurations that are allowed: constraints, and the robot's window.

use super::{Configuration, Constraint, constraint as constraint_as_json};
use crate::modal::closures;
use crate::placement::Placement;
use aspecta_robot::{Robot, WorkingMode};
use serde::{Serialize, Serializer};

/// What a configuration, or a path, must not go beyond.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// What bounds the aspects of the robot.
    Constraint(Constraint),
    /// The robot's window.
    Window {
        /// The name of the coordinate that it bounds.
        coordinate: &'static str,
    },
}

impl Serialize for Bound {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        #[serde(tag = "kind", rename = "window")]
        struct Window {
            coordinate: &'static str,
        }
        match *self {
            Self::Constraint(constraint) => constraint_as_json(&constraint, serializer),
            Self::Window { coordinate } => Window { coordinate }.serialize(serializer),
        }
    }
}

impl Bound {
    /// Its name: `actuator limit of leg 1`, `window of y`.
    pub fn named(self, robot: &Robot) -> String {
        match self {
            Self::Constraint(constraint) => constraint.named(robot),
            Self::Window { coordinate } => format!("window of {coordinate}"),
        }
    }
}

/// The limits that are not strictly kept, and the ends of the window that are passed: none where
/// [`within_limits`](super::within_limits) says yes.
pub(crate) fn broken_limits<const D: usize, const N: usize>(
    robot: &Robot,
    pose: &[f64],
    mode: WorkingMode,
) -> Vec<Bound> {
    let placement = Placement::<f64, D>::at(robot.platform, pose);
    let legs = closures::<f64, D, N>(robot, &placement);
    let heights: [[f64; 2]; N] = std::array::from_fn(|j| legs[j].heights());
    let at = Configuration { robot, placement: &placement, legs: &legs, heights: &heights, mode };
    let is_broken = |(constraint, margin): (Constraint, f64)| {
        (margin.is_nan() || margin <= 0.0).then_some(Bound::Constraint(constraint))
    };
    let coordinate = |k: usize| Bound::Window { coordinate: robot.platform.coordinates()[k].name };
    at.limits().filter_map(is_broken).chain(robot.all_beyond_window(pose).map(coordinate)).collect()
}
