//! The definitions the generalized aspects replace: parallel aspects (Def. 5) and serial aspects (Def. 6).
//!
//! The paper applies them to a robot with several inverse *and* several direct solutions to show that neither separates
//! them (section 3.3, figures 6 and 7): the domains overlap.

use super::components::Components;
use super::result::{EarlierAspects, EarlierDomain, Sample};
use crate::kinematics::WorkingMode;
use crate::paving::{ClassSet, Mark, Node, Paving};
use crate::robot::Robot;
use rayon::prelude::*;

/// Definition 5: where det A > 0 in some working mode, and where it is < 0 in some.
pub(super) fn parallel_aspects(robot: &Robot, paving: &Paving) -> Vec<EarlierAspects> {
    let plus: ClassSet = 0x5555;
    let minus: ClassSet = 0xAAAA;
    let both = |node: &Node| intersection(node.of_classes(plus), node.of_classes(minus));
    let overlap = measure(paving, &both);
    [("det A > 0", plus), ("det A < 0", minus)]
        .into_par_iter()
        .map(|(name, classes)| EarlierAspects {
            name: name.into(),
            domains: domains(robot, paving, &|node| node.of_classes(classes), &|node| {
                mode_in(paving, node, classes)
            }),
            overlap,
        })
        .collect()
}

/// Definition 6: where each combination of signs of the B_jj exists.
pub(super) fn serial_aspects(robot: &Robot, paving: &Paving) -> Vec<EarlierAspects> {
    let count = paving.modes.len();
    let entry = |(m, mode): (usize, &WorkingMode)| {
        let next = (m + 1) % count;
        let shared = |node: &Node| intersection(node.of_mode(m), node.of_mode(next));
        EarlierAspects {
            name: mode.to_string(),
            domains: domains(robot, paving, &|node| node.of_mode(m), &|_| *mode),
            overlap: if next == m { 0.0 } else { measure(paving, &shared) },
        }
    };
    paving.modes.par_iter().enumerate().map(entry).collect()
}

fn intersection(a: Mark, b: Mark) -> Mark {
    match (a, b) {
        (Mark::Outside, _) | (_, Mark::Outside) => Mark::Outside,
        (Mark::Inside, Mark::Inside) => Mark::Inside,
        _ => Mark::Open,
    }
}

/// A mode whose class among `classes` the node lies inside of.
fn mode_in(paving: &Paving, node: &Node, classes: ClassSet) -> WorkingMode {
    paving.modes[(node.inside & classes).trailing_zeros() as usize / 2]
}

/// Certified inner measure of a set.
fn measure(paving: &Paving, sight: &impl Fn(&Node) -> Mark) -> f64 {
    let mut sum = 0.0;
    paving.boxes_of(sight, &mut |at| {
        if sight(&paving.nodes[at as usize]) == Mark::Inside {
            sum += paving.measure(paving.depth_of(at));
        }
    });
    sum
}

/// The domains of a set: one entry per component of inside and undecided boxes that holds an inside box, largest first.
fn domains(
    robot: &Robot,
    paving: &Paving,
    sight: &impl Fn(&Node) -> Mark,
    mode: &impl Fn(&Node) -> WorkingMode,
) -> Vec<EarlierDomain> {
    let components = Components::new(robot, paving, sight);
    let mut by_component = std::collections::BTreeMap::<u32, (f64, u32)>::new();
    for piece in &components.pieces {
        let (sum, largest) = by_component.entry(piece.component).or_insert((0.0, piece.largest));
        *sum += piece.measure;
        *largest = (*largest).min(piece.largest);
    }
    let domain = |(measure, largest): (f64, u32)| {
        let pose = paving.centre(largest);
        let q = robot.inverse_in(&pose, mode(&paving.nodes[largest as usize])).ok().flatten();
        EarlierDomain { measure, sample: Sample { pose, q: q.unwrap_or_default() } }
    };
    let mut found: Vec<EarlierDomain> = by_component.into_values().map(domain).collect();
    found.sort_by(|a, b| b.measure.total_cmp(&a.measure));
    found
}
