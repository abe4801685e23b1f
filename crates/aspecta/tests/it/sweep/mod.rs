//! Aspects of a five-bar counted by brute force, with nothing of the library: a sweep over leg 1's elbow angle.
//!
//! A configuration in which leg 1 has a given posture is an elbow angle |ψ| in (0, π) and a crank angle, or, turned by an angle that depends
//! on ψ alone, the direction β of A₁X. At one ψ the point X runs on a circle about A₁, of which leg 2 reaches up to two arcs. Their
//! parameter t meets the ends as the elbow angle of leg 2 does, at its extremes, so that det A is smooth there (it is not in β). On the arcs
//! zeros of det A are found by sampling, by a search of every minimum of |det A|, and by bisection; they part *runs* of one sign.
//! Runs of two neighbouring ψ are one component if both slices have the same arcs with as many runs, of the same signs, each of which
//! overlaps its counterpart in t. Where they do not, there is an event in between, and ψ is halved down to 10⁻¹⁰; then those of one sign
//! that overlap are one (in t; in β where the arcs themselves change). Nothing is filtered by size; what can be missed is what begins and ends between two slices or two samples, so
//! counts are to be trusted only if they stay when both numbers change and when the legs change places.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

/// Number of aspects by the signs of the B_jj and of det A.
pub type Table = BTreeMap<([i8; 2], i8), usize>;

/// Signs of (B₁₁, B₂₂).
pub const MODES: [[i8; 2]; 4] = [[1, 1], [1, -1], [-1, -1], [-1, 1]];

/// A five-bar with A₁ = (0, 0), A₂ = (`base`, 0).
#[derive(Clone, Copy, Debug)]
pub struct FiveBar {
    /// Crank and rod of each leg.
    pub links: [[f64; 2]; 2],
    pub base: f64,
    /// What is missing in the first entry of the second row of A: 0, or A₂ₓ for the paper's misprint.
    pub missing: f64,
}

/// How finely to look.
#[derive(Clone, Copy, Debug)]
pub struct Finesse {
    /// Elbow angles.
    pub slices: usize,
    /// Points of an arc.
    pub samples: usize,
}

impl FiveBar {
    pub fn count(&self, finesse: Finesse) -> Table {
        let mut table = Table::new();
        for mode in MODES {
            let sweep = Sweep::run(self, mode, finesse);
            for sign in [1, -1] {
                table.insert((mode, sign), sweep.components(sign));
            }
        }
        table
    }

    /// The same robot seen from behind, its legs renumbered: sweeps over the other elbow.
    pub fn count_from_behind(&self, finesse: Finesse) -> Table {
        assert_eq!(self.missing, 0.0, "the misprinted formula is not that of a robot");
        let behind = Self { links: [self.links[1], self.links[0]], ..*self };
        behind.count(finesse).into_iter().map(|(([a, b], sign), n)| (([b, a], -sign), n)).collect()
    }

    fn distance(&self, psi: f64) -> f64 {
        let [l, m] = self.links[0];
        // L² + M² + 2LM cos ψ, without cancellation at the folded leg.
        ((l - m).powi(2) + 4.0 * l * m * (psi / 2.0).cos().powi(2)).sqrt()
    }

    /// The arcs of the circle of radius `d` that leg 2 reaches.
    fn arcs(&self, d: f64) -> (Kind, Vec<(f64, f64)>) {
        let [l, m] = self.links[1];
        let cosine = |reach: f64| (d * d + self.base.powi(2) - reach.powi(2)) / (2.0 * d * self.base);
        let (near, far) = (cosine((l - m).abs()), cosine(l + m));
        if near <= -1.0 || far >= 1.0 {
            return (Kind::Nothing, vec![]);
        }
        let (from, to) = (near.min(1.0).acos(), far.max(-1.0).acos());
        match (near < 1.0, far > -1.0) {
            (false, false) => (Kind::Circle, vec![(CUT, CUT + TAU)]),
            (false, true) => (Kind::Right, vec![(-to, to)]),
            (true, false) => (Kind::Left, vec![(from, TAU - from)]),
            (true, true) => (Kind::Two, vec![(from, to), (-to, -from)]),
        }
    }

    /// det A at X = d (cos β, sin β) times a positive number.
    fn det(&self, mode: [i8; 2], psi: f64, d: f64, beta: f64) -> f64 {
        let (sin, cos) = beta.sin_cos();
        let rod = |j: usize, v: [f64; 2], square: f64, height: f64| {
            let [l, m] = self.links[j];
            let along = (square - (l * l - m * m)) / 2.0;
            let across = f64::from(mode[j]) * height;
            [along * v[0] + across * v[1], along * v[1] - across * v[0]]
        };
        let [l, m] = self.links[0];
        let first = rod(0, [cos, sin], d * d, l * m * psi.sin());
        let from = [d * cos - self.base, d * sin];
        let square = from[0].powi(2) + from[1].powi(2);
        let [l, m] = self.links[1];
        let closure = ((l + m).powi(2) - square) * (square - (l - m).powi(2));
        let mut second = rod(1, from, square, 0.5 * closure.max(0.0).sqrt());
        second[0] += self.missing * square;
        first[0] * second[1] - first[1] * second[0]
    }
}

/// Where a whole circle is cut.
const CUT: f64 = 0.37;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Nothing,
    Circle,
    Right,
    Left,
    Two,
}

/// A part of an arc on which det A has one sign.
#[derive(Clone, Copy, Debug)]
struct Run {
    arc: usize,
    sign: i8,
    t: (f64, f64),
    beta: (f64, f64),
    id: usize,
}

impl Run {
    fn overlaps_in_t(&self, other: &Self) -> bool {
        self.arc == other.arc && self.t.0 < other.t.1 && other.t.0 < self.t.1
    }

    fn overlaps_in_beta(&self, other: &Self) -> bool {
        let (a, b) = (self.beta, other.beta);
        [-TAU, 0.0, TAU].iter().any(|turn| a.0 < b.1 + turn && b.0 + turn < a.1)
    }
}

struct Slice {
    psi: f64,
    kind: Kind,
    runs: Vec<Run>,
}

impl Slice {
    fn matches(&self, other: &Self) -> bool {
        let same = |(a, b): (&Run, &Run)| a.sign == b.sign && a.overlaps_in_t(b);
        self.kind == other.kind
            && self.runs.len() == other.runs.len()
            && self.runs.iter().zip(&other.runs).all(same)
    }
}

struct Sweep<'a> {
    robot: &'a FiveBar,
    mode: [i8; 2],
    samples: usize,
    parent: Vec<usize>,
    signs: Vec<i8>,
}

impl<'a> Sweep<'a> {
    fn run(robot: &'a FiveBar, mode: [i8; 2], finesse: Finesse) -> Self {
        let mut sweep = Self { robot, mode, samples: finesse.samples, parent: vec![], signs: vec![] };
        let psi = |k: usize| (PI * k as f64 / finesse.slices as f64).clamp(1e-9, PI - 1e-9);
        let mut left = sweep.slice(psi(0));
        for k in 1..=finesse.slices {
            let right = sweep.slice(psi(k));
            sweep.link(&left, &right);
            left = right;
        }
        sweep
    }

    fn root(&self, mut id: usize) -> usize {
        while self.parent[id] != id {
            id = self.parent[id];
        }
        id
    }

    fn join(&mut self, a: &Run, b: &Run) {
        let (a, b) = (self.root(a.id), self.root(b.id));
        self.parent[a.max(b)] = a.min(b);
    }

    fn components(&self, sign: i8) -> usize {
        (0..self.parent.len()).filter(|&id| self.parent[id] == id && self.signs[id] == sign).count()
    }

    fn link(&mut self, left: &Slice, right: &Slice) {
        if left.matches(right) {
            left.runs.iter().zip(&right.runs).for_each(|(a, b)| self.join(a, b));
        } else if right.psi - left.psi > 1e-10 {
            let middle = self.slice(0.5 * (left.psi + right.psi));
            self.link(left, &middle);
            self.link(&middle, right);
        } else {
            let overlap = if left.kind == right.kind { Run::overlaps_in_t } else { Run::overlaps_in_beta };
            for a in &left.runs {
                right.runs.iter().filter(|b| a.sign == b.sign && overlap(a, b)).for_each(|b| self.join(a, b));
            }
        }
    }

    fn slice(&mut self, psi: f64) -> Slice {
        let d = self.robot.distance(psi);
        let (kind, arcs) = self.robot.arcs(d);
        let mut runs = Vec::new();
        for (arc, (lo, hi)) in arcs.into_iter().enumerate() {
            let beta = |t: f64| match kind {
                Kind::Circle => lo + (hi - lo) * t,
                _ => lo + (hi - lo) * (0.5 * PI * t).sin().powi(2),
            };
            let det = |t: f64| self.robot.det(self.mode, psi, d, beta(t));
            let (first, zeros) = zeros(&det, self.samples);
            let ends: Vec<f64> = std::iter::once(0.0).chain(zeros).chain([1.0]).collect();
            let mut sign = first;
            for pair in ends.windows(2) {
                let id = self.parent.len();
                self.parent.push(id);
                self.signs.push(sign);
                let [t, turned] = [pair, &[beta(pair[0]), beta(pair[1])]].map(|p| (p[0], p[1]));
                runs.push(Run { arc, sign, t, beta: turned, id });
                sign = -sign;
            }
        }
        if let (Kind::Circle, [first, .., last]) = (kind, &runs[..]) {
            assert_eq!(first.sign, last.sign);
            self.join(first, last);
        }
        Slice { psi, kind, runs }
    }
}

/// The sign of a function at 0 and its zeros in [0, 1].
fn zeros(f: &impl Fn(f64) -> f64, samples: usize) -> (i8, Vec<f64>) {
    let mut points: Vec<(f64, f64)> =
        (0..=samples).map(|i| i as f64 / samples as f64).map(|t| (t, f(t))).collect();
    let dips: Vec<(f64, f64)> = points.windows(3).filter_map(|three| dip(f, three)).collect();
    points.extend(dips);
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let zero = |pair: &[(f64, f64)]| {
        let ((mut lo, at), (mut hi, _)) = (pair[0], pair[1]);
        for _ in 0..60 {
            let middle = 0.5 * (lo + hi);
            *(if (f(middle) > 0.0) == (at > 0.0) { &mut lo } else { &mut hi }) = middle;
        }
        0.5 * (lo + hi)
    };
    let changes = points.windows(2).filter(|pair| (pair[0].1 > 0.0) != (pair[1].1 > 0.0));
    (if points[0].1 > 0.0 { 1 } else { -1 }, changes.map(zero).collect())
}

/// A point between three at which a function of one sign on them, least at the middle one, has the other sign.
fn dip(f: &impl Fn(f64) -> f64, three: &[(f64, f64)]) -> Option<(f64, f64)> {
    let sign = three[1].1.signum();
    let [a, b, c] = [0, 1, 2].map(|k| sign * three[k].1);
    if a < b || c < b {
        return None;
    }
    let (mut lo, mut hi) = (three[0].0, three[2].0);
    for _ in 0..40 {
        let (left, right) = (lo + 0.382 * (hi - lo), lo + 0.618 * (hi - lo));
        let (at_left, at_right) = (sign * f(left), sign * f(right));
        if at_left.min(at_right) < 0.0 {
            let t = if at_left < at_right { left } else { right };
            return Some((t, f(t)));
        }
        if at_left < at_right { hi = right } else { lo = left }
    }
    None
}
