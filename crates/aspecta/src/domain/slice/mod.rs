//! Characteristic surfaces on a slice (Definition 9): where a pose X′ with the joint vector of X, outside the
//! slice as a rule, meets the boundary of the class.
//!
//! On a slice the points X′ of that boundary are not at hand, so the surfaces are found from the side of X.
//! *Numerical*: between neighbouring nodes of the grid that lie in different regions the other poses are
//! followed (`track`) to where the first is lost, and these places are joined simplex by simplex, the cells
//! being cut into simplices along their diagonals. The surfaces stop a cell short of the boundary of the
//! aspect, and what lies between the nodes is a chord.

mod beyond;
mod track;

pub(super) use beyond::Beyond;

use super::boundary::{Simplex, orders};
use super::face::Face;
use super::grid::Pose;
use super::labels::{Labels, OUTSIDE};
use super::mesh::Mesh;
use super::result::Domains;
use super::sheet::Sheet;
use crate::aspect::Analysis;
use arrayvec::ArrayVec;
use aspecta_kinematics::constraints::Constraint;
use aspecta_robot::work;
use std::collections::BTreeMap;

/// Two neighbouring nodes, the lesser first.
type Edge = (usize, usize);

/// A place on a surface between two nodes.
#[derive(Clone, Copy)]
struct Crossing {
    pose: Pose,
    face: Face,
}

/// The characteristic surfaces on a slice that was cut into regions: segments in two coordinates, triangles
/// in three (those that vary; vertices have no others). Empty on a slice of one, and for a whole workspace,
/// whose surfaces are [`super::characteristic`]'s.
pub fn surfaces(analysis: &Analysis, domains: &Domains) -> Mesh {
    let labels = &domains.labels;
    let Some(sheet) = Sheet::new(analysis, domains.aspect).filter(|_| !analysis.fixed.is_empty()) else {
        return Mesh::default();
    };
    let simplices: Vec<_> = (0..labels.grid.len()).flat_map(|node| cut_simplices(labels, node)).collect();
    let mut edges: Vec<Edge> = simplices.iter().flat_map(|corners| cut_edges(labels, corners)).collect();
    edges.sort_unstable();
    edges.dedup();
    let crossings: Vec<Crossing> = work::map(&edges, |&edge| crossing(&sheet, labels, edge));
    let index = edges.into_iter().zip(0..).collect();
    let mut net = Net { labels, index, middles: BTreeMap::new(), crossings, simplices: Vec::new() };
    simplices.iter().for_each(|corners| net.add(corners));
    net.mesh()
}

/// The nodes of a simplex: three in two dimensions, four in three.
type Corners = ArrayVec<usize, 4>;

/// The simplices of the cell after a node that lie in the aspect, in more than one region.
fn cut_simplices(labels: &Labels, node: usize) -> impl Iterator<Item = Corners> + '_ {
    let walked = move |order: &&[usize]| -> Option<Corners> {
        let mut corners = Corners::from_iter([node]);
        for &axis in *order {
            corners.push(labels.grid.next(*corners.last()?, axis)?);
        }
        Some(corners)
    };
    let is_cut = |corners: &Corners| {
        let of = |node: &usize| labels.region[*node];
        corners.iter().all(|node| of(node) != OUTSIDE)
            && corners.iter().any(|node| of(node) != of(&corners[0]))
    };
    orders(labels.grid.axes()).iter().filter_map(walked).filter(is_cut)
}

/// The edges of a simplex whose ends lie in different regions.
fn cut_edges<'a>(labels: &'a Labels, corners: &'a [usize]) -> impl Iterator<Item = Edge> + 'a {
    let pairs = corners.iter().enumerate().flat_map(|(k, &a)| corners[k + 1..].iter().map(move |&b| (a, b)));
    let ordered = pairs.map(|(a, b)| (a.min(b), a.max(b)));
    ordered.filter(|&(a, b)| labels.region[a] != labels.region[b])
}

/// Returns the place at which the other poses of the first end are lost on the way to the second, or else
/// those of the second on the way to the first. The middle, if none are: then the regions were told apart by
/// what lies between the nodes.
fn crossing(sheet: &Sheet<'_>, labels: &Labels, (a, b): Edge) -> Crossing {
    let from = labels.grid.pose(a);
    let to = labels.grid.turned_to(&from, b);
    let dof = labels.grid.dof();
    let first_loss = |from: &Pose, to: &Pose| {
        let others = sheet.all_others(&from[..dof]).unwrap_or_default();
        let losses = others.iter().filter_map(|other| track::loss(sheet, from, to, other));
        losses.min_by(|a, b| a.at.total_cmp(&b.at))
    };
    let there = || first_loss(&from, &to).map(|loss| (loss.at, loss.face));
    let back = || first_loss(&to, &from).map(|loss| (1.0 - loss.at, loss.face));
    let (at, face) = there().or_else(back).unwrap_or((0.5, Face::Of(Constraint::Det)));
    Crossing { pose: std::array::from_fn(|k| from[k] + at * (to[k] - from[k])), face }
}

/// The crossings, and what joins them.
struct Net<'a> {
    labels: &'a Labels,
    index: BTreeMap<Edge, u32>,
    /// The vertices amid triangles in which three regions meet, and amid tetrahedra.
    middles: BTreeMap<Corners, u32>,
    crossings: Vec<Crossing>,
    simplices: Vec<Simplex>,
}

impl Net<'_> {
    /// Adds what crosses a simplex.
    fn add(&mut self, corners: &[usize]) {
        let Some(&first) = cut_edges(self.labels, corners).next().and_then(|edge| self.index.get(&edge))
        else {
            return;
        };
        let face = self.crossings[first as usize].face;
        if corners.len() == 3 {
            let segments = self.segments(corners);
            self.simplices.extend(segments.into_iter().map(|[u, v]| Simplex { corners: [u, v, v], face }));
            return;
        }
        // In space: a cone over the segments on the four sides.
        let top = self.middle(corners);
        for without in 0..corners.len() {
            let side: Corners = (0..corners.len()).filter(|&k| k != without).map(|k| corners[k]).collect();
            let segments = self.segments(&side);
            self.simplices.extend(segments.into_iter().map(|[u, v]| Simplex { corners: [u, v, top], face }));
        }
    }

    /// The segments that part the regions of a triangle: one between two of them; three, which meet amid it,
    /// between three.
    fn segments(&mut self, corners: &[usize]) -> ArrayVec<[u32; 2], 3> {
        let cut: ArrayVec<u32, 3> = cut_edges(self.labels, corners).map(|edge| self.index[&edge]).collect();
        match cut[..] {
            [a, b] => ArrayVec::from_iter([[a, b]]),
            [_, _, _] => {
                let middle = self.middle(corners);
                cut.iter().map(|&a| [a, middle]).collect()
            }
            _ => ArrayVec::new(),
        }
    }

    /// The vertex amid the crossings of a simplex.
    fn middle(&mut self, corners: &[usize]) -> u32 {
        let mut key: Corners = corners.iter().copied().collect();
        key.sort_unstable();
        if let Some(&known) = self.middles.get(&key) {
            return known;
        }
        let cut: ArrayVec<Crossing, 6> =
            cut_edges(self.labels, corners).map(|edge| self.crossings[self.index[&edge] as usize]).collect();
        let near = self.labels.grid.pose(corners[0]);
        let turned = |pose: &Pose| self.labels.grid.beside(&near, pose);
        let sum = |k: usize| cut.iter().map(|crossing| turned(&crossing.pose)[k]).sum::<f64>();
        let pose = std::array::from_fn(|k| sum(k) / cut.len() as f64);
        let number = self.crossings.len() as u32;
        self.crossings.push(Crossing { pose, face: cut[0].face });
        self.middles.insert(key, number);
        number
    }

    fn mesh(self) -> Mesh {
        let grid = &self.labels.grid;
        let varying = |c: &Crossing| (0..grid.axes()).map(|axis| c.pose[grid.coordinate(axis)]).collect();
        Mesh {
            vertices: self.crossings.iter().map(varying).collect(),
            sources: Vec::new(),
            simplices: self.simplices,
        }
    }
}
