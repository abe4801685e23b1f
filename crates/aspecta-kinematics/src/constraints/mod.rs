//! The functions that bound the aspects of a robot: one list, from which every reader has them.
//!
//! An aspect is a component of where all of them are positive. [`Constraint::of`] lists them,
//! [`Constraints::visit`] evaluates them all at a point or over a box, and [`Configuration`] one limit in one
//! choice of postures, for readers that treat singularities in a form of their own. What depends on which
//! postures is told by [`Constraint::postures`].
//!
//! The ends of a window that cuts the workspace are no constraints of the robot: they are functions of one
//! coordinate, the same in all modes, and change with the question that is asked. Where P is formed and where
//! boundaries are drawn they stand beside this list.

mod configuration;
mod demand;
mod limit;
mod margins;

pub(crate) use configuration::within_limits;
pub use configuration::{Configuration, is_limited};
pub use demand::{Constraints, Demand};
pub use limit::{LegAt, margin, unit};
pub use margins::{Margins, measures, unit_of_moments};

pub use aspecta_robot::constraint::{Constraint, Kind, Scale, constraint, if_any};
