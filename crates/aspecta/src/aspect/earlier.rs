//! The definitions the generalized aspects replace: parallel aspects (Def. 5) and serial aspects (Def. 6).
//!
//! The paper applies them to a robot with several inverse *and* several direct solutions to show that neither
//! separates them (section 3.3, figures 6 and 7): the domains overlap.

use super::components::Components;
use super::result::{EarlierAspects, EarlierDomain, Sample};
use crate::paving::{ClassSet, Mark, Node, Paving};
use aspecta_kinematics::Kinematics;
use aspecta_kinematics::constraints::is_limited;
use aspecta_robot::Robot;
use aspecta_robot::WorkingMode;
use aspecta_robot::work;

/// Definition 5: where det A > 0 in some working mode, and where it is < 0 in some.
pub(super) fn parallel_aspects(robot: &Robot, paving: &Paving) -> Vec<EarlierAspects> {
    let plus: ClassSet = 0x5555 & !paving.vanishing();
    let minus: ClassSet = 0xAAAA & !paving.vanishing();
    let both = |node: &Node| intersection(node.of_classes(plus), node.of_classes(minus));
    let overlap = measure(paving, &both);
    work::map(&[("det A > 0", plus), ("det A < 0", minus)], |&(name, classes)| EarlierAspects {
        name: name.into(),
        domains: domains(robot, paving, &|node| node.of_classes(classes))
            .iter()
            .map(|d| d.report(robot, paving, |node| mode_in(paving, node, classes)))
            .collect(),
        overlap,
    })
}

/// Definition 6: where each combination of signs of the B_jj exists.
pub(super) fn serial_aspects(robot: &Robot, paving: &Paving) -> Vec<EarlierAspects> {
    let count = paving.modes.len();
    // Without limits every mode exists at the same poses.
    let different = if is_limited(robot) { count } else { 1 };
    let found: Vec<(Vec<Domain>, f64)> = work::map_range(different, |m| {
        let next = (m + 1) % count;
        let shared = |node: &Node| intersection(node.of_mode(m), node.of_mode(next));
        let overlap = if next == m { 0.0 } else { measure(paving, &shared) };
        (domains(robot, paving, &|node| node.of_mode(m)), overlap)
    });
    let entry = |(m, mode): (usize, &WorkingMode)| {
        let (domains, overlap) = &found[m % different];
        EarlierAspects {
            name: mode.to_string(),
            domains: domains.iter().map(|d| d.report(robot, paving, |_| *mode)).collect(),
            overlap: *overlap,
        }
    };
    paving.modes.iter().enumerate().map(entry).collect()
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
fn measure(paving: &Paving, classify: &impl Fn(&Node) -> Mark) -> f64 {
    let mut sum = 0.0;
    paving.boxes_of(classify, &mut |at| {
        if classify(&paving.nodes[at as usize]) == Mark::Inside {
            sum += paving.measure(paving.depth_of(at));
        }
    });
    sum
}

/// A domain: its certified inner measure and its largest box.
struct Domain {
    measure: f64,
    largest: u32,
}

impl Domain {
    fn report(&self, robot: &Robot, paving: &Paving, mode: impl Fn(&Node) -> WorkingMode) -> EarlierDomain {
        let pose = paving.centre(self.largest);
        let q = robot.inverse_in(&pose, mode(&paving.nodes[self.largest as usize])).ok().flatten();
        EarlierDomain { measure: self.measure, sample: Sample { pose, q: q.unwrap_or_default() } }
    }
}

/// The domains of a set: one entry per component of inside and undecided boxes that holds an inside box,
/// largest first.
fn domains(robot: &Robot, paving: &Paving, classify: &impl Fn(&Node) -> Mark) -> Vec<Domain> {
    let components = Components::new(robot, std::slice::from_ref(paving), classify);
    let mut by_component = std::collections::BTreeMap::<u32, Domain>::new();
    for piece in &components.pieces {
        let start = Domain { measure: 0.0, largest: piece.largest.1 };
        let domain = by_component.entry(piece.component).or_insert(start);
        domain.measure += piece.measure;
        domain.largest = paving.larger(domain.largest, piece.largest.1);
    }
    let mut found: Vec<Domain> = by_component.into_values().collect();
    found.sort_by(|a, b| b.measure.total_cmp(&a.measure));
    found
}
