//! The boundary's mesh with the direct solutions at its vertices, and how they pair along its edges.

use super::{APART, Characteristic, CharacteristicVertex, GivenUp, SAME_JOINTS};
use crate::aspect::Analysis;
use crate::domain::boundary::{Boundary, BoundaryVertex, Simplex, onto};
use crate::domain::face::Face;
use crate::domain::field::Field;
use arrayvec::ArrayVec;
use aspecta_kinematics::Kinematics;
use aspecta_robot::work;
use std::collections::HashMap;

/// Most direct solutions in one aspect, with room to spare: 6 in the plane, 2 in space.
const MOST: usize = 16;
/// Newton's method arrives at a solution this near to it, in widths of the window.
const ARRIVED: f64 = 1e-8;
/// How much faster than X a solution may move and be paired with the last one left.
const LEAP: f64 = 4.0;

/// A vertex of the boundary, its joint vector and the other direct solutions in the aspect.
struct Station<const N: usize> {
    x: [f64; N],
    q: [f64; N],
    others: ArrayVec<[f64; N], MOST>,
    unsolved: bool,
    unlocated: usize,
}

/// The partner at the other end of an edge of each solution at the first.
type Pairing = ArrayVec<Option<u8>, MOST>;

/// The pairings of the edges, lower index first, in order.
pub struct Pairings {
    edges: Vec<(u32, u32)>,
    pairs: Vec<Pairing>,
}

impl Pairings {
    fn of(&self, u: u32, v: u32) -> Option<&Pairing> {
        self.edges.binary_search(&(u.min(v), u.max(v))).ok().map(|k| &self.pairs[k])
    }

    /// The partner at v of solution i at u.
    fn partner(&self, u: u32, i: u8, v: u32) -> Option<u8> {
        let pairing = self.of(u, v)?;
        match u < v {
            true => pairing[usize::from(i)],
            false => pairing.iter().position(|p| *p == Some(i)).map(|k| k as u8),
        }
    }
}

/// The mesh, and the characteristic surface as far as it is done.
pub struct Net<'a, const D: usize, const N: usize> {
    analysis: &'a Analysis,
    boundary: &'a Boundary,
    field: Field<'a, D, N>,
    dimension: usize,
    sources: Vec<BoundaryVertex>,
    stations: Vec<Station<N>>,
    vertices: Vec<CharacteristicVertex>,
    /// The index in `vertices` of a solution (vertex of the boundary, number).
    index: HashMap<(u32, u8), u32>,
    simplices: Vec<Simplex>,
}

impl<'a, const D: usize, const N: usize> Net<'a, D, N> {
    /// Solves the direct problem at all vertices of the boundary.
    pub fn new(analysis: &'a Analysis, boundary: &'a Boundary, field: Field<'a, D, N>) -> Self {
        let mut net = Self {
            analysis,
            boundary,
            field,
            dimension: boundary.axes.len(),
            sources: Vec::new(),
            stations: Vec::new(),
            vertices: Vec::new(),
            index: HashMap::new(),
            simplices: Vec::new(),
        };
        net.extend(boundary.vertices.clone());
        net
    }

    fn extend(&mut self, vertices: Vec<BoundaryVertex>) {
        let stations: Vec<_> = work::map(&vertices, |vertex| self.station(vertex));
        self.sources.extend(vertices);
        self.stations.extend(stations);
    }

    /// Whether a face is a limit of a driven joint.
    pub fn is_driven_limit(&self, face: Face) -> bool {
        matches!(face, Face::Of(constraint) if constraint.is_of_drives(self.field.robot))
    }

    fn station(&self, vertex: &BoundaryVertex) -> Station<N> {
        let x: [f64; N] = std::array::from_fn(|k| vertex.pose[k]);
        let q = self.field.joints(&x, &vertex.faces);
        let mut station = Station { x, q, others: ArrayVec::new(), unsolved: true, unlocated: 0 };
        if !vertex.placed() {
            return station;
        }
        let Ok(poses) = self.field.robot.direct_poses(&q) else { return station };
        station.unsolved = false;
        // A driven joint at its limit is there in all solutions: rounding must not decide on which side.
        let exempt = vertex.faces.map(|face| face.filter(|&f| self.is_driven_limit(f)));
        for pose in poses.iter() {
            let near: [f64; N] = std::array::from_fn(|k| pose[k]);
            let Some(other) = self.field.close(&near, &q) else { continue };
            let is = |known: &[f64; N]| self.field.distance(known, &other) < APART;
            let in_class = self.field.violated(&other, &exempt).is_none()
                && !self.field.is_folded(&other)
                && self.field.joint_distance(&self.field.joints(&other, &[None; 3]), &q) <= SAME_JOINTS;
            if !in_class || is(&x) || station.others.iter().any(is) {
                continue;
            }
            match self.boundary.holds(self.analysis, &self.field, &other) {
                Some(true) => station.others.push(other),
                Some(false) => {}
                None => station.unlocated += 1,
            }
        }
        station
    }

    /// Pairs the solutions along all edges of the simplices.
    pub fn pairings(&self, simplices: &[Simplex]) -> Pairings {
        let mut edges: Vec<_> = simplices.iter().flat_map(|s| s.edges(self.dimension)).collect();
        edges.sort_unstable();
        edges.dedup();
        let pairs = work::map(&edges, |&(u, v)| self.pair(u, v));
        Pairings { edges, pairs }
    }

    /// Solutions are partners if Newton's method leads from each to the other; and so are the last two that
    /// are left over, if they are no farther apart than [`LEAP`] times the edge is long. (Near a cusp
    /// Newton's method reaches only as far as the solution is from X, however short the edge.)
    fn pair(&self, u: u32, v: u32) -> Pairing {
        let (a, b) = (&self.stations[u as usize], &self.stations[v as usize]);
        let arrives = |from: &[f64; N], to: &Station<N>| {
            let end = self.field.close(from, &to.q)?;
            to.others.iter().position(|x| self.field.distance(x, &end) < ARRIVED)
        };
        let partner = |(i, x): (usize, &[f64; N])| {
            let k = arrives(x, b)?;
            (arrives(&b.others[k], a) == Some(i)).then_some(k as u8)
        };
        let mut pairing: Pairing = a.others.iter().enumerate().map(partner).collect();
        let mut left = (0..b.others.len()).filter(|&k| !pairing.contains(&Some(k as u8)));
        let mut lonely = (0..pairing.len()).filter(|&i| pairing[i].is_none());
        if let (Some(k), None, Some(i), None) = (left.next(), left.next(), lonely.next(), lonely.next())
            && self.field.distance(&a.others[i], &b.others[k]) <= LEAP * self.field.distance(&a.x, &b.x)
        {
            pairing[i] = Some(k as u8);
        }
        pairing
    }

    /// Whether all solutions at the ends of an edge pair, none farther from its partner than the diagonal of
    /// a cell.
    fn is_fine(&self, pairings: &Pairings, (u, v): (u32, u32)) -> bool {
        let (a, b) = (&self.stations[u as usize].others, &self.stations[v as usize].others);
        let is_short = |(x, partner): (&[f64; N], &Option<u8>)| {
            partner.is_some_and(|k| self.field.distance(x, &b[usize::from(k)]) <= self.boundary.cell)
        };
        a.len() == b.len() && pairings.of(u, v).is_some_and(|p| a.iter().zip(p).all(is_short))
    }

    /// Whether all solutions at the corners pair along all edges, and nearby.
    pub fn is_clear(&self, pairings: &Pairings, simplex: &Simplex) -> bool {
        simplex.edges(self.dimension).all(|edge| self.is_fine(pairings, edge))
    }

    /// Whether all corners have equally many solutions.
    pub fn is_level(&self, simplex: &Simplex) -> bool {
        let [a, b, c] = simplex.corners.map(|v| self.stations[v as usize].others.len());
        a == b && b == c
    }

    /// Adds the images of a simplex, one for each solution that pairs all round it. Returns whether no
    /// solution is left over.
    pub fn emit(&mut self, pairings: &Pairings, simplex: &Simplex) -> bool {
        let [a, b, c] = simplex.corners;
        let count = |v: u32| self.stations[v as usize].others.len();
        let images: Vec<[u8; 3]> = (0..count(a) as u8)
            .filter_map(|i| {
                let j = pairings.partner(a, i, b)?;
                if self.dimension == 2 {
                    return Some([i, j, j]);
                }
                let k = pairings.partner(a, i, c)?;
                (pairings.partner(b, j, c) == Some(k)).then_some([i, j, k])
            })
            .collect();
        let all = [a, b, c].iter().all(|&v| count(v) == images.len());
        for [i, j, k] in images {
            let corners = [self.vertex(a, i), self.vertex(b, j), self.vertex(c, k)];
            self.simplices.push(Simplex { corners, face: simplex.face });
        }
        all
    }

    fn vertex(&mut self, source: u32, number: u8) -> u32 {
        *self.index.entry((source, number)).or_insert_with(|| {
            let pose = self.stations[source as usize].others[usize::from(number)].to_vec();
            self.vertices.push(CharacteristicVertex { pose, source });
            self.vertices.len() as u32 - 1
        })
    }

    /// Halves the edges that are not fine and splits the simplices that have them.
    pub fn halve(&mut self, pairings: &Pairings, simplices: &[Simplex]) -> Vec<Simplex> {
        let edges = simplices.iter().flat_map(|s| s.edges(self.dimension).map(|edge| (edge, s.face)));
        let mut bad: Vec<((u32, u32), Face)> =
            edges.filter(|(edge, _)| !self.is_fine(pairings, *edge)).collect();
        bad.sort_by_key(|(edge, _)| *edge);
        bad.dedup_by_key(|(edge, _)| *edge);
        let middles: Vec<_> = work::map(&bad, |&((u, v), face)| self.middle(u, v, face));
        let first = self.sources.len() as u32;
        self.extend(middles);
        let middle = |u: u32, v: u32| {
            let found = bad.binary_search_by_key(&(u.min(v), u.max(v)), |(edge, _)| *edge);
            found.ok().map(|k| first + k as u32)
        };
        let mut parts = Vec::with_capacity(4 * simplices.len());
        for simplex in simplices {
            let [a, b, c] = simplex.corners;
            let mut push = |corners: [u32; 3]| parts.push(Simplex { corners, face: simplex.face });
            match (self.dimension, [middle(a, b), middle(b, c), middle(c, a)]) {
                (2, [Some(m), ..]) => [[a, m, m], [m, b, b]].into_iter().for_each(push),
                (2, _) => push(simplex.corners),
                (_, middles) => split([a, b, c], middles).into_iter().for_each(push),
            }
        }
        parts
    }

    /// The point of the boundary half-way along an edge; not placed if it is not found.
    fn middle(&self, u: u32, v: u32, face: Face) -> BoundaryVertex {
        let (a, b) = (&self.sources[u as usize], &self.sources[v as usize]);
        let pose = |vertex: &BoundaryVertex| -> [f64; N] { std::array::from_fn(|k| vertex.pose[k]) };
        let at = self.field.between(&pose(a), &pose(b), 0.5);
        let common = a.faces.map(|f| f.filter(|_| b.faces.contains(&f)));
        let choices = [common, [Some(face), None, None]];
        let found = choices.into_iter().filter(|f| f.iter().any(Option::is_some));
        let mut found = found.filter_map(|faces| onto(&self.field, &at, faces, self.boundary.cell));
        found.next().unwrap_or(BoundaryVertex {
            pose: at.to_vec(),
            faces: [Some(face), None, None],
            offset: f64::INFINITY,
        })
    }

    /// The result.
    pub fn finish(self, given_up: GivenUp) -> Characteristic {
        Characteristic {
            aspect: self.boundary.aspect,
            dimension: self.dimension,
            given_up: GivenUp {
                unsolved: self.stations.iter().filter(|s| s.unsolved).count(),
                unlocated: self.stations.iter().map(|s| s.unlocated).sum(),
                ..given_up
            },
            sources: self.sources,
            vertices: self.vertices,
            simplices: self.simplices,
        }
    }
}

/// A triangle split along the edges ab, bc, ca that have a middle.
fn split([a, b, c]: [u32; 3], middles: [Option<u32>; 3]) -> Vec<[u32; 3]> {
    match middles {
        [None, None, None] => vec![[a, b, c]],
        [Some(m), None, None] => vec![[a, m, c], [m, b, c]],
        [Some(m), Some(n), None] => vec![[a, m, c], [m, b, n], [m, n, c]],
        [Some(m), Some(n), Some(o)] => vec![[a, m, o], [m, b, n], [o, n, c], [m, n, o]],
        // The same with the corners renamed.
        [p, q, r] => split([b, c, a], [q, r, p]),
    }
}
