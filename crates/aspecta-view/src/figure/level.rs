//! Level curves f = 0 in a rectangle: marching squares on a grid, every vertex polished onto the curve.

use std::collections::HashMap;
use std::hash::Hash;

/// A rectangle cut into n × n cells.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    /// Range of the first coordinate.
    pub x: (f64, f64),
    /// Range of the second coordinate.
    pub y: (f64, f64),
    /// Cells per side.
    pub n: usize,
}

impl Grid {
    /// Node (i, j), 0 ≤ i, j ≤ n.
    pub fn node(&self, i: usize, j: usize) -> [f64; 2] {
        let at = |(lo, hi): (f64, f64), k: usize| lo + (hi - lo) * k as f64 / self.n as f64;
        [at(self.x, i), at(self.y, j)]
    }

    /// Values of a function at all nodes, row by row.
    pub fn sample<T>(&self, f: impl Fn([f64; 2]) -> T) -> Vec<T> {
        let side = self.n + 1;
        (0..side * side).map(|k| f(self.node(k % side, k / side))).collect()
    }
}

/// The curves f = 0, given the values of f at the nodes: polylines whose vertices are the zeros of f on the
/// grid's edges, each found to the last bits of its coordinate. A closed curve repeats its first vertex.
pub fn contours(grid: &Grid, values: &[f64], f: impl Fn([f64; 2]) -> f64) -> Vec<Vec<[f64; 2]>> {
    traced(grid, values, &f, |a, b| root(a, b, &f))
}

/// The edges of a set, given which nodes are in it; vertices are found by so many halvings of the grid's
/// edges.
pub fn edges(
    grid: &Grid,
    nodes: &[bool],
    is_in: impl Fn([f64; 2]) -> bool,
    halvings: u32,
) -> Vec<Vec<[f64; 2]>> {
    let sign = |is_in: bool| if is_in { 1.0 } else { -1.0 };
    let values: Vec<f64> = nodes.iter().map(|&node| sign(node)).collect();
    let middle = |a: [f64; 2], b: [f64; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    traced(grid, &values, &|p| sign(is_in(p)), |mut a, mut b| {
        let start = is_in(a);
        for _ in 0..halvings {
            let m = middle(a, b);
            if is_in(m) == start { a = m } else { b = m }
        }
        middle(a, b)
    })
}

/// The polylines through the edges of the grid on which f changes sign, at the places that `zero` finds
/// between two nodes.
fn traced(
    grid: &Grid,
    values: &[f64],
    f: &impl Fn([f64; 2]) -> f64,
    zero: impl Fn([f64; 2], [f64; 2]) -> [f64; 2],
) -> Vec<Vec<[f64; 2]>> {
    let on_edge = |&(i, j, up): &Edge| {
        let far = if up { (i, j + 1) } else { (i + 1, j) };
        zero(grid.node(i, j), grid.node(far.0, far.1))
    };
    chain(&segments(grid, values, f)).iter().map(|edges| edges.iter().map(on_edge).collect()).collect()
}

/// An edge of the grid: from node (i, j) upward or to the right.
type Edge = (usize, usize, bool);

/// The pairs of edges joined by the curve within each cell.
fn segments(grid: &Grid, values: &[f64], f: &impl Fn([f64; 2]) -> f64) -> Vec<(Edge, Edge)> {
    let side = grid.n + 1;
    let positive = |i: usize, j: usize| values[j * side + i] >= 0.0;
    let mut found = Vec::new();
    for (i, j) in (0..grid.n * grid.n).map(|k| (k % grid.n, k / grid.n)) {
        // Corners counter-clockwise from the lower left; edge k joins corner k and the next.
        let corners = [positive(i, j), positive(i + 1, j), positive(i + 1, j + 1), positive(i, j + 1)];
        let edges = [(i, j, false), (i + 1, j, true), (i, j + 1, false), (i, j, true)];
        let crossed: Vec<usize> = (0..4).filter(|&k| corners[k] != corners[(k + 1) % 4]).collect();
        match crossed[..] {
            [a, b] => found.push((edges[a], edges[b])),
            [_, _, _, _] => {
                let (low, high) = (grid.node(i, j), grid.node(i + 1, j + 1));
                let middle = f([0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])]) >= 0.0;
                // The middle joins corners 0 and 2 if it has their sign: the curve then cuts off 1 and 3.
                let pairs = if middle == corners[0] { [(0, 1), (2, 3)] } else { [(3, 0), (1, 2)] };
                found.extend(pairs.map(|(a, b)| (edges[a], edges[b])));
            }
            _ => {}
        }
    }
    found
}

/// Segments, each given by its ends, linked end to end, open chains first.
pub fn chain<E: Copy + Eq + Hash>(segments: &[(E, E)]) -> Vec<Vec<E>> {
    let mut touching: HashMap<E, Vec<usize>> = HashMap::new();
    for (k, s) in segments.iter().enumerate() {
        touching.entry(s.0).or_default().push(k);
        touching.entry(s.1).or_default().push(k);
    }
    let mut used = vec![false; segments.len()];
    let mut chains = Vec::new();
    let ends = |s: &(E, E)| [s.0, s.1].into_iter().find(|e| touching[e].len() == 1);
    let open = segments.iter().enumerate().filter_map(|(k, s)| ends(s).map(|e| (k, e)));
    let closed = segments.iter().enumerate().map(|(k, s)| (k, s.0));
    for (first, from) in open.chain(closed).collect::<Vec<_>>() {
        if used[first] {
            continue;
        }
        let (mut edges, mut next) = (vec![from], Some(first));
        while let Some(k) = next {
            used[k] = true;
            let (a, b) = segments[k];
            let end = if edges.last() == Some(&a) { b } else { a };
            edges.push(end);
            next = touching[&end].iter().copied().find(|&s| !used[s]);
        }
        chains.push(edges);
    }
    chains
}

/// The zero of f between a and b, where f changes sign, to the last bits: two false-position steps, then a
/// bisection, over and over.
fn root(a: [f64; 2], b: [f64; 2], f: &impl Fn([f64; 2]) -> f64) -> [f64; 2] {
    let at = |t: f64| [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
    let (mut low, mut high) = ((0.0, f(a)), (1.0, f(b)));
    for step in 0..150 {
        let width = high.0 - low.0;
        let middle = 0.5 * (low.0 + high.0);
        let secant = low.0 - low.1 * width / (high.1 - low.1);
        // A little beyond the secant's zero: so the bracket closes from both sides.
        let push = if secant < middle { 1e-3 } else { -1e-3 } * width;
        let t = [secant, secant + push, middle][step % 3];
        let t = if t > low.0 && t < high.0 { t } else { middle };
        if width < 1e-15 || t <= low.0 || t >= high.0 {
            break;
        }
        let value = f(at(t));
        if (value >= 0.0) == (low.1 >= 0.0) { low = (t, value) } else { high = (t, value) }
    }
    at(if low.1.abs() < high.1.abs() { low.0 } else { high.0 })
}

/// The point of the curve on the normal through the point `t` of the chord from a to b, if it is within a
/// chord's length.
pub fn project(a: [f64; 2], b: [f64; 2], t: f64, f: &impl Fn([f64; 2]) -> f64) -> Option<[f64; 2]> {
    let chord = [b[0] - a[0], b[1] - a[1]];
    let foot = [a[0] + t * chord[0], a[1] + t * chord[1]];
    let beside = |s: f64| [foot[0] - s * chord[1], foot[1] + s * chord[0]];
    let differ = |s: f64| (f(beside(-s)) >= 0.0) != (f(beside(s)) >= 0.0);
    let width = [1e-3, 0.03, 0.3, 1.0].into_iter().find(|&s| differ(s))?;
    Some(root(beside(-width), beside(width), f))
}

/// Leaves out vertices that lie within `tolerance` of the polyline through those kept (Douglas & Peucker).
pub fn simplify(points: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    let mut keep = vec![false; points.len()];
    let mut spans = vec![(0, points.len().saturating_sub(1))];
    while let Some((a, b)) = spans.pop() {
        keep.iter_mut().skip(a).step_by((b - a).max(1)).take(2).for_each(|k| *k = true);
        let off = |k: usize| distance(points[k], points[a], points[b]);
        if let Some(far) =
            (a + 1..b).max_by(|&i, &j| off(i).total_cmp(&off(j))).filter(|&k| off(k) > tolerance)
        {
            spans.extend([(a, far), (far, b)]);
        }
    }
    points.iter().zip(keep).filter_map(|(p, k)| k.then_some(*p)).collect()
}

/// Distance of p from the segment ab.
fn distance(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (ab, ap) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let length2 = ab[0] * ab[0] + ab[1] * ab[1];
    let t = if length2 > 0.0 { ((ap[0] * ab[0] + ap[1] * ab[1]) / length2).clamp(0.0, 1.0) } else { 0.0 };
    (ap[0] - t * ab[0]).hypot(ap[1] - t * ab[1])
}
