//! Writes down what an analysis rests on.

use super::ascent::Class;
use super::atlas::{Atlas, Leaf};
use super::count::Counted;
use crate::paving::Paving;
use aspecta_robot::Robot;
use aspecta_verify::certificate::{
    self, Certificate, Claim, Entry, FORMAT_VERSION, Join, Scale, Seam, Sheet, Tree,
};

/// Returns the certificate of all that the bounds rest on.
pub(super) fn certificate(atlas: &Atlas<'_>, counted: &[(Class, Counted)]) -> Certificate {
    let claim = |(class, c): &(Class, Counted)| match class.vanishes() {
        false => Claim { low: c.low(), high: c.high() },
        true => Claim { low: 0, high: Some(0) },
    };
    let claims = counted.iter().map(claim).collect();
    let counted = || counted.iter().filter(|(class, _)| !class.vanishes());
    let index = |class: &Class| class.bit.trailing_zeros() as usize;
    let joins = counted().flat_map(|(class, c)| {
        c.joins.iter().map(|join| Join { class: index(class), sheet: join.sheet, path: join.points.clone() })
    });
    let seams = counted().flat_map(|(class, c)| {
        let seam = |&(sheet, node): &Leaf| Seam {
            class: index(class),
            sheet,
            point: atlas.sheets[sheet].centre(node),
        };
        c.components.seams.iter().map(seam)
    });
    certify(atlas.robot, &atlas.scale, &atlas.sheets, joins.collect(), seams.collect(), claims)
}

/// Returns the certificate of what the pavings `sheets` (all with the same modes; the first in pose
/// coordinates) and the lists prove of `robot`.
pub fn certify(
    robot: &Robot,
    scale: &Scale,
    sheets: &[Paving],
    joins: Vec<Join>,
    seams: Vec<Seam>,
    claims: Vec<Claim>,
) -> Certificate {
    let sheet = |paving: &Paving| Sheet { chart: paving.chart.clone(), tree: tree(paving) };
    Certificate {
        certificate_version: FORMAT_VERSION,
        robot: robot.clone(),
        window: sheets[0].window.clone(),
        modes: sheets[0].modes.clone(),
        scale: scale.clone(),
        claims,
        sheets: sheets.iter().map(sheet).collect(),
        joins,
        seams,
    }
}

/// The leaves of a paving.
fn tree(paving: &Paving) -> Tree {
    let mut entries = Vec::with_capacity(paving.nodes.len());
    let vanishing = paving.vanishing();
    let mut open = vec![0];
    while let Some(at) = open.pop() {
        let node = &paving.nodes[at as usize];
        if node.first_child == 0 {
            let (inside, undecided) = (node.inside & !vanishing, node.undecided & !vanishing);
            let summitless = node.summitless & (inside | undecided);
            entries.push(Entry::Leaf(certificate::Leaf {
                inside,
                undecided,
                summitless,
                covered: node.covered,
            }));
        } else {
            entries.push(Entry::Split);
            open.extend(paving.children(at).rev());
        }
    }
    Tree(entries)
}
