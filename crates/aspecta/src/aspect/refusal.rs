//! The robots and slices that cannot be analysed.

use super::options::Options;
use crate::paving::{AXES, MODES};
use aspecta_robot::WorkingMode;
use aspecta_robot::{Robot, SliceError};

/// Why a robot cannot be analysed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AnalysisError {
    /// The workspace, or the slice of it, has no window.
    #[error(transparent)]
    Slice(#[from] SliceError),
    /// No working mode of the robot.
    #[error("`{mode}` is not a working mode of robot `{robot}`")]
    Mode {
        /// Robot name.
        robot: String,
        /// The mode asked for.
        mode: WorkingMode,
    },
    /// Too many free coordinates to be paved.
    #[error(
        "robot `{robot}` has {dof} degrees of freedom, {free} of them free, but aspects are computed for up to 3 free \
         coordinates: analyse a slice"
    )]
    Dimension {
        /// Robot name.
        robot: String,
        /// Its degrees of freedom.
        dof: usize,
        /// How many coordinates are not held.
        free: usize,
        /// Coordinates to hold and values, `name=value` separated by commas: a slice with three free coordinates.
        hold: String,
    },
    /// No certificate can be made.
    #[error(
        "a certificate holds up to {MODES} working modes, and {modes} of robot `{robot}` are analysed: choose some"
    )]
    Certificate {
        /// Robot name.
        robot: String,
        /// How many working modes are analysed.
        modes: usize,
    },
}

/// Returns an error for a robot that cannot be analysed, whatever the slice.
pub(super) fn refuse(robot: &Robot, options: &Options) -> Result<(), AnalysisError> {
    let dof = robot.dof();
    let held = |k: usize| options.fix.iter().any(|&(held, _)| held == k);
    let free: Vec<usize> = (0..dof).filter(|&k| !held(k)).collect();
    if free.len() > AXES {
        let hold = |k: usize| {
            let middle =
                robot.window[k].filter(|r| !(r.0..=r.1).contains(&0.0)).map_or(0.0, |r| 0.5 * (r.0 + r.1));
            let value = options.fix.iter().find(|&&(held, _)| held == k).map_or(middle, |&(_, value)| value);
            format!("{}={value}", robot.platform.coordinates()[k].name)
        };
        let all = (0..dof).filter(|&k| held(k) || free[AXES..].contains(&k));
        let hold = all.map(hold).collect::<Vec<_>>().join(",");
        return Err(AnalysisError::Dimension { robot: robot.name.clone(), dof, free: free.len(), hold });
    }
    let modes = if options.modes.is_empty() { robot.working_modes().len() } else { options.modes.len() };
    if options.certificate && modes > MODES {
        return Err(AnalysisError::Certificate { robot: robot.name.clone(), modes });
    }
    Ok(())
}
