//! Certificates for the tests of the checker.

use super::atlas::seams;
use super::search::Search;
use crate::certificate::{Certificate, Claim, Join, Seam};
use crate::paving::{Budget, Control, Mark, Node};
use crate::robot::Robot;
use std::sync::atomic::AtomicBool;

/// What a search proves of a robot, or of the slice `fix`: its leaves, joins and seams. Nothing is claimed.
pub(crate) fn certified(robot: &Robot, fix: &[(usize, f64)], budget: &Budget) -> Certificate {
    let window = robot.slice(fix).unwrap();
    let control = Control { cancelled: &AtomicBool::new(false), progress: &|_| {} };
    let modes = robot.working_modes();
    let search = Search::run(robot, &window, &modes, budget, &control);
    let sheets = &search.atlas.sheets;
    let joins = search.counted.iter().flat_map(|(_, counted)| &counted.joins);
    let joins =
        joins.map(|join| Join { class: join.class.trailing_zeros() as usize, path: join.path.clone() });
    let mut all_seams = Vec::new();
    for class in 0..2 * modes.len() {
        let sight = |node: &Node| node.of_classes(1 << class);
        let inside = |(sheet, node): (usize, u32)| sight(&sheets[sheet].nodes[node as usize]) == Mark::Inside;
        seams(robot, sheets, &sight, &mut |a, b, surely| {
            if surely && inside(a) && inside(b) {
                let (sheet, node) = b;
                all_seams.push(Seam { class, sheet, point: sheets[sheet].centre(node) });
            }
        });
    }
    let nothing = vec![Claim { low: 0, high: None }; 2 * modes.len()];
    Certificate::new(robot, &search.atlas.scale, sheets, joins.collect(), all_seams, nothing)
}
