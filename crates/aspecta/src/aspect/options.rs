//! How an analysis is done.

use crate::paving::Budget;
use aspecta_robot::WorkingMode;

/// How an analysis is done.
///
/// # Examples
/// ```
/// use aspecta::{Budget, Options};
///
/// // A slice of a 3-RRR, phi = 0.5 rad, with the proof of its bounds.
/// let options = Options {
///     budget: Budget { seconds: Some(30.0), ..Budget::default() },
///     fix: vec![(2, 0.5)],
///     certificate: true,
///     ..Options::default()
/// };
/// assert!(options.modes.is_empty()); // all of the robot
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// How far the paving goes. Where nothing says when to stop: until the bounds meet, or [`crate::paving::MAX_BOXES`] boxes; 4 million
    /// where [`Analysis::parallel_rods`](crate::Analysis::parallel_rods), [`Analysis::uncharted_folds`](crate::Analysis::uncharted_folds) or [`Analysis::architecturally_singular`](crate::Analysis::architecturally_singular) keep the bounds apart.
    pub budget: Budget,
    /// Coordinates to hold (index, value), as in [`aspecta_robot::Robot::slice`]: what is analysed are the poses that have these values.
    pub fix: Vec<(usize, f64)>,
    /// The working modes to analyse, in this order; empty: all of the robot. With some only, the classes, bounds and numbers are
    /// those of these modes, and Definitions 5 and 6 are left out, as they are for more modes than one pass takes
    /// ([`crate::paving::MODES`]).
    pub modes: Vec<WorkingMode>,
    /// Whether to keep the proof: [`Analysis::certificate`](crate::Analysis::certificate). For up to [`crate::paving::MODES`] working modes.
    pub certificate: bool,
    /// What the analysis is for.
    pub purpose: Purpose,
}

/// What an analysis is for, where its budget does not say how fine boxes are to be.
///
/// # Examples
/// ```
/// use aspecta::{Control, Options, Purpose, Robot, analyze};
///
/// // Counts and areas alone take a twentieth of the boxes that pictures take.
/// let robot = Robot::resolve("five-bar")?;
/// let options = Options { purpose: Purpose::Numbers, ..Options::default() };
/// let analysis = analyze(&robot, &options, &Control::unwatched())?;
/// assert!(analysis.aspects.certified && analysis.run.boxes < 20_000);
/// # Ok::<(), aspecta::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Purpose {
    /// Numbers and pictures: boxes on the boundary are as fine as pictures want them.
    #[default]
    Pictures,
    /// Numbers alone: boxes are as fine as the counts want them, and as leaves little of the measures undecided.
    Numbers,
    /// Domains and plans are made of the boxes: as for pictures, and where bounds will not meet at the depth asked for it is not said in which
    /// of the finest boxes an aspect could hide. Measures are those of whole boxes.
    Boxes,
}
