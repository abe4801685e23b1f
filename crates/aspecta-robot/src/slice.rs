//! Slices of the pose space: some coordinates held at a value, the others free.

use super::{GREATEST, Robot, Unbounded, Window};
use crate::num::written;

/// Why a robot, or a slice of it, has no window to pave.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SliceError {
    /// A free coordinate has no bounds.
    #[error(transparent)]
    Unbounded(#[from] Unbounded),
    /// Nothing is left to analyse.
    #[error("robot `{robot}`: the window and the limits leave no range for the coordinate `{coordinate}`")]
    Empty {
        /// Robot name.
        robot: String,
        /// The coordinate.
        coordinate: &'static str,
    },
    /// No such coordinate.
    #[error(
        "robot `{robot}` has {count} coordinates ({names}): there is no number {index} to hold, counted from 0"
    )]
    NoSuchCoordinate {
        /// Robot name.
        robot: String,
        /// Index given.
        index: usize,
        /// Number of its coordinates.
        count: usize,
        /// Their names.
        names: String,
    },
    /// NaN, infinity, or too large for double precision to mean anything.
    #[error("robot `{robot}`: `{coordinate}` cannot be held at {}: give a finite number within ±1e7", written(*.value))]
    Value {
        /// Robot name.
        robot: String,
        /// The coordinate.
        coordinate: &'static str,
        /// Value given.
        value: f64,
    },
    /// One coordinate, two values.
    #[error("robot `{robot}`: `{coordinate}` is held twice: give it one value")]
    Twice {
        /// Robot name.
        robot: String,
        /// The coordinate.
        coordinate: &'static str,
    },
    /// A point is no slice.
    #[error("robot `{robot}`: all coordinates ({names}) are held: leave at least one free")]
    AllHeld {
        /// Robot name.
        robot: String,
        /// Names of its coordinates.
        names: String,
    },
    /// The workspace does not get there.
    #[error(
        "robot `{robot}`: `{coordinate}` cannot be held at {} {unit}: links, limits and window keep it from {} to \
         {} {unit}; give a value between", written(*.value), short(.lo), short(.hi)
    )]
    Outside {
        /// Robot name.
        robot: String,
        /// The coordinate.
        coordinate: &'static str,
        /// Value given.
        value: f64,
        /// Its unit.
        unit: String,
        /// Least value it can have.
        lo: f64,
        /// Greatest value it can have.
        hi: f64,
    },
}

/// In six digits.
fn short(x: &f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(*x)
}

impl Robot {
    /// The window of a slice: a box that holds all poses of the workspace whose coordinates have the values given in `fix`, as
    /// pairs of a coordinate's index and its value (the double itself; length unit or rad). An angle may be given in any turn
    /// and is held within the window's. Nothing given: the whole workspace, as [`Robot::workspace_window`].
    ///
    /// # Errors
    /// [`SliceError`]: a free coordinate without bounds, an empty workspace, or values that cannot be held.
    ///
    /// # Examples
    /// ```
    /// let robot = aspecta_robot::catalogue::find("3-rrr").unwrap();
    /// let window = robot.slice(&[(2, 0.5)])?; // phi = 0.5 rad
    /// assert_eq!((window.axes(), window.ranges[2]), (vec![0, 1], (0.5, 0.5)));
    /// # Ok::<(), aspecta_robot::SliceError>(())
    /// ```
    pub fn slice(&self, fix: &[(usize, f64)]) -> Result<Window, SliceError> {
        let held = self.held_values(fix)?;
        let mut window = Window::default();
        for (k, held) in held.into_iter().enumerate() {
            window.push(self, k);
            if window.ranges[k].0 >= window.ranges[k].1 {
                return Err(SliceError::Empty {
                    robot: self.name.clone(),
                    coordinate: self.coordinate_name(k),
                });
            }
            match held {
                Some(value) => self.hold(&mut window, k, value)?,
                None => window.check_bounded(self, k)?,
            }
        }
        self.end_pitch(&mut window);
        Ok(window)
    }

    /// Beyond pitch = ±π/2 poses go on at half a turn of roll and yaw. Where one of these is held that is off the slice, and where one is cut it may be
    /// out of the window: which ends there.
    fn end_pitch(&self, window: &mut Window) {
        let Some([roll, pitch, yaw]) = self.platform.turns() else { return };
        let is_held = |k: usize| window.ranges[k].0 == window.ranges[k].1;
        let goes_on = window.glued[roll] && window.glued[yaw];
        if !goes_on && !is_held(pitch) {
            window.cut[pitch] = (true, true);
        }
    }

    /// The value of each coordinate that is held.
    fn held_values(&self, fix: &[(usize, f64)]) -> Result<Vec<Option<f64>>, SliceError> {
        let robot = || self.name.clone();
        let names = || self.platform.coordinates().iter().map(|c| c.name).collect::<Vec<_>>().join(", ");
        let mut held = vec![None; self.dof()];
        for &(index, value) in fix {
            if index >= held.len() {
                let count = held.len();
                return Err(SliceError::NoSuchCoordinate { robot: robot(), index, count, names: names() });
            }
            let coordinate = self.coordinate_name(index);
            if !value.is_finite() || value.abs() > GREATEST {
                return Err(SliceError::Value { robot: robot(), coordinate, value });
            }
            if held[index].replace(value).is_some() {
                return Err(SliceError::Twice { robot: robot(), coordinate });
            }
        }
        if held.iter().all(Option::is_some) {
            return Err(SliceError::AllHeld { robot: robot(), names: names() });
        }
        Ok(held)
    }

    /// Narrows the range of coordinate `k` to one value of it.
    fn hold(&self, window: &mut Window, k: usize, given: f64) -> Result<(), SliceError> {
        let (lo, hi) = window.ranges[k];
        let value = window.turned_in(k, given);
        if !(lo..=hi).contains(&value) {
            let unit = if window.angles[k] { "rad" } else { &self.length_unit }.to_owned();
            let (robot, coordinate) = (self.name.clone(), self.coordinate_name(k));
            return Err(SliceError::Outside { robot, coordinate, value: given, unit, lo, hi });
        }
        window.ranges[k] = (value, value);
        window.glued[k] = false;
        window.cut[k] = (false, false);
        Ok(())
    }

    fn coordinate_name(&self, k: usize) -> &'static str {
        self.platform.coordinates()[k].name
    }
}
