//! The functions that bound the aspects of a robot: one list, from which every reader has them.
//!
//! An aspect is a component of where all of them are positive. [`Constraint::of`] lists them,
//! [`Constraints::visit`] evaluates them all at a point or over a box, and [`Configuration`] one limit in one
//! choice of postures, for readers that treat singularities in a form of their own. What depends on which
//! postures is told by [`Constraint::postures`].
//!
//! The ends of a window that cuts the workspace are no constraints of the robot: they are functions of one
//! coordinate, the same in all modes, and change with the question that is asked. Where P is formed, where
//! boundaries are drawn and where solutions and paths are told to be within limits they stand beside this list.

mod bodies;
mod bound;
mod clearance;
mod configuration;
mod demand;
mod limit;
mod margins;
mod rods;
mod turn;
mod window;

pub use bodies::{Beside, Feature, Line, TwoBodies};
pub use bound::Bound;
pub(crate) use bound::broken_limits;
pub(crate) use configuration::within_limits;
pub use configuration::{Configuration, is_limited};
pub use demand::{Constraints, Demand};
pub use limit::{LegAt, margin, unit};
pub use margins::{Margins, measures};
pub use turn::{Joint, Turn};
pub(crate) use window::window_margins;

pub use aspecta_robot::constraint::{Constraint, Kind, Scale, constraint, if_any};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modal::closures;
    use crate::placement::Placement;
    use aspecta_robot::LegIndex;
    use aspecta_robot::catalogue;

    fn names(constraints: impl IntoIterator<Item = Constraint>) -> String {
        constraints.into_iter().map(|c| c.to_string()).collect::<Vec<_>>().join(", ")
    }

    /// Struts have no H, and det A comes last.
    #[test]
    fn constraints_are_listed_leg_by_leg() {
        let listed = |name: &str| names(Constraint::of(&catalogue::find(name).unwrap()));
        assert_eq!(listed("five-bar"), "H_1, H_2, det A");
        assert_eq!(listed("2-prr"), "H_1, joint limit 1 of leg 1, H_2, joint limit 1 of leg 2, det A");
        let limits = "joint limit 1 of leg 1, joint limit 1 of leg 2, joint limit 1 of leg 3";
        assert_eq!(listed("3-rpr"), format!("{limits}, det A"));
    }

    /// All that are listed are visited once: reaches first, and limits only if they are asked for.
    #[test]
    fn all_that_is_listed_is_visited() {
        let robot = catalogue::find("irb-360").unwrap();
        let placement = Placement::<f64, 3>::at(robot.platform, &[0.0, 0.0, -900.0]);
        let legs = closures::<f64, 3, 3>(&robot, &placement);
        let visited = |limits: bool| {
            let mut all = Vec::new();
            let demand = Demand { limits, ..Demand::class("---".parse().unwrap(), -1) };
            Constraints::new(&robot, &placement, &legs).visit(&demand, |constraint, value| {
                assert!(value > 0.0, "{constraint}: {value}");
                all.push(constraint);
                true
            });
            all
        };
        let (mut all, regular) = (visited(true), visited(false));
        assert_eq!(names(regular.clone()), "H_1, H_2, H_3, det A");
        assert_eq!(all[..3], regular[..3]);
        all.sort_by_key(|constraint| constraint.leg().map_or(usize::MAX, LegIndex::index));
        assert_eq!(names(all), names(Constraint::of(&robot)));
    }
}
