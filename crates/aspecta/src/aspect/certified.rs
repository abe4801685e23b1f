//! Certificates for the tests of the checker.

use super::search::Search;
use crate::certificate::{Certificate, Claim, Join};
use crate::paving::{Budget, Control};
use crate::robot::Robot;
use std::sync::atomic::AtomicBool;

/// What a search proves of a robot, or of the slice `fix`: its leaves and joins. Nothing is claimed.
pub(crate) fn certified(robot: &Robot, fix: &[(usize, f64)], budget: &Budget) -> Certificate {
    let window = robot.slice(fix).unwrap();
    let control = Control { cancelled: &AtomicBool::new(false), progress: &|_| {} };
    let modes = robot.working_modes();
    let search = Search::run(robot, &window, &modes, budget, &control);
    let joins = search.counted.iter().flat_map(|(_, counted)| &counted.joins);
    let joins = joins.map(|join| Join { class: join.class.trailing_zeros() as usize, path: join.path.clone() });
    let nothing = vec![Claim { low: 0, high: None }; 2 * modes.len()];
    Certificate::new(robot, &search.atlas.scale, &search.atlas.sheets, joins.collect(), vec![], nothing)
}
