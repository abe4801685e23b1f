//! Merging pieces by certified ascent: from a small piece, climb U = log σ det A + Σ log h_j + Σ log c_k.
//!
//! U → −∞ at every boundary of S_{s,σ}, so a climb never leaves its aspect; each step is a segment proved by
//! intervals to lie in S_{s,σ} ([`aspecta_kinematics::path::curve::along`]). Pieces that a climb meets are
//! one aspect with the piece it began in.

use super::components::{Components, UnionFind};
use super::result::DetSign;
use crate::paving::{ClassSet, Paving};
use aspecta_kinematics::chart::Chart;
use aspecta_kinematics::chart::Coordinates;
use aspecta_kinematics::constraints::{Constraints, Demand, Kind};
use aspecta_kinematics::path::curve::Along;
use aspecta_kinematics::{WorkingMode, for_platform};
use aspecta_robot::Robot;
use aspecta_robot::num::{Interval, Jet, Scalar};
use aspecta_robot::work;
use nalgebra::{DMatrix, SMatrix, SVector};

/// Most steps of a climb.
const STEPS: usize = 60;
/// Most interval evaluations a step may take to be proved.
const EFFORT: usize = 64;

/// A class of aspects: a working mode and a sign of det A, with the bit it has in a paving. The sign is 0 in a mode in which det A
/// vanishes identically: nothing is asked of it then.
#[derive(Clone, Copy)]
pub(super) struct Class {
    pub mode: WorkingMode,
    pub sign: i8,
    pub bit: ClassSet,
}

impl Class {
    /// Both classes of the mode with this number in a paving, det A > 0 first.
    pub(super) fn both(paving: &Paving, m: usize) -> [Self; 2] {
        let signs = if paving.vanishes_in(m) { [0; 2] } else { [1, -1] };
        let mode = paving.modes[m];
        [(signs[0], 1 << (2 * m)), (signs[1], 2 << (2 * m))].map(|(sign, bit)| Self { mode, sign, bit })
    }

    /// Whether det A vanishes identically in its mode.
    pub(super) fn vanishes(self) -> bool {
        self.sign == 0
    }

    pub(super) fn det_a(self) -> DetSign {
        if self.bit.trailing_zeros().is_multiple_of(2) { DetSign::Positive } else { DetSign::Negative }
    }
}

/// Which pieces are proved to be one: sets of piece numbers, and the paths that prove it. Climbs start from
/// the pieces that are `worth` it, except the largest such piece of each component, which waits for the
/// others. They climb in the chart of their largest box.
pub(super) fn merge(
    robot: &Robot,
    sheets: &[Paving],
    class: Class,
    components: &Components,
    worth: &[bool],
    stop: &(impl Fn() -> bool + Sync),
) -> (UnionFind, Vec<Path>) {
    let pieces = &components.pieces;
    let mut largest = std::collections::HashMap::new();
    for (k, piece) in pieces.iter().enumerate().filter(|(k, _)| worth[*k]) {
        let best = largest.entry(piece.component).or_insert(k);
        if piece.measure > pieces[*best].measure {
            *best = k;
        }
    }
    let waits = |k: usize| largest[&pieces[k].component] == k;
    let climbers: Vec<usize> = (0..pieces.len()).filter(|&k| worth[k] && !waits(k)).collect();
    let climbs: Vec<Climb> = work::map(&climbers, |&k| {
        if stop() {
            return Climb::default();
        }
        let goal = largest[&pieces[k].component] as u32;
        for_platform!(robot.platform, climb(robot, sheets, class, components, k as u32, goal))
    });
    let mut sets = UnionFind::new(pieces.len());
    let mut joins = Vec::new();
    for (&k, climb) in climbers.iter().zip(climbs) {
        for &other in &climb.met {
            sets.union(k as u32, other);
        }
        if !climb.met.is_empty() {
            joins.push(climb.path);
        }
    }
    (sets, joins)
}

/// A polyline in the coordinates of a sheet.
#[derive(Default)]
pub(super) struct Path {
    pub sheet: usize,
    pub points: Vec<Vec<f64>>,
}

/// A climb: the pieces met, and the path up to the last of them.
#[derive(Default)]
struct Climb {
    met: Vec<u32>,
    path: Path,
}

/// The climb from piece `from`, which ends at a maximum of U, at piece `goal`, or where no step can be proved
/// any more.
fn climb<const D: usize, const N: usize>(
    robot: &Robot,
    sheets: &[Paving],
    class: Class,
    components: &Components,
    from: u32,
    goal: u32,
) -> Climb {
    let (sheet, largest) = components.pieces[from as usize].largest;
    let paving = &sheets[sheet];
    let start = paving.centre(largest);
    let mut climb = Climb { met: Vec::new(), path: Path { sheet, points: Vec::new() } };
    let mut path = vec![start.clone()];
    ascend::<D, N>(robot, paving, class, &start, &mut |point| {
        path.push(point.to_vec());
        let here = paving.find(&|node| node.of_classes(class.bit), point);
        let piece =
            here.filter(|(_, surely)| *surely).and_then(|(node, _)| components.piece_at((sheet, node)));
        if let Some(piece) = piece.filter(|&piece| piece != from) {
            climb.met.push(piece);
            climb.path.points.clone_from(&path);
        }
        piece == Some(goal)
    });
    climb
}

/// Climbs from `start`, which must lie in the class, until `reached` says so of a pose, to a maximum of U, or
/// to where no step can be proved any more.
pub(super) fn ascend<const D: usize, const N: usize>(
    robot: &Robot,
    paving: &Paving,
    class: Class,
    start: &[f64],
    reached: &mut impl FnMut(&[f64]) -> bool,
) {
    let mut x = SVector::<f64, N>::from_column_slice(start);
    let free: [bool; N] = std::array::from_fn(|k| paving.axes.contains(&k));
    for _ in 0..STEPS {
        let Some((height, direction)) = uphill::<D, N>(robot, &paving.chart, class, &x, &free) else { break };
        let Some(next) = step::<D, N>(robot, paving, class, &x, height, &direction) else { break };
        x = next;
        if reached(x.as_slice()) {
            break;
        }
    }
}

/// The longest certified step along `direction`, halved up to 30 times, on which U grows.
fn step<const D: usize, const N: usize>(
    robot: &Robot,
    paving: &Paving,
    class: Class,
    x: &SVector<f64, N>,
    height: f64,
    direction: &SVector<f64, N>,
) -> Option<SVector<f64, N>> {
    let demand = Demand::class(class.mode, class.sign);
    let mut length = 1.0;
    for _ in 0..30 {
        let next = x + direction * length;
        let higher =
            potential::<f64, D, N>(robot, &paving.chart, class, &next.into()).is_some_and(|u| u > height);
        if higher
            && paving.find(&|node| node.of_classes(class.bit), next.as_slice()).is_some()
            && Along::is_inside_of(robot, &paving.chart, &demand, [x.as_slice(), next.as_slice()], EFFORT)
        {
            return Some(next);
        }
        length *= 0.5;
    }
    None
}

/// U at x and a Newton direction, bent so that it leads uphill; `None` at a maximum or outside.
fn uphill<const D: usize, const N: usize>(
    robot: &Robot,
    chart: &Chart,
    class: Class,
    x: &SVector<f64, N>,
    free: &[bool; N],
) -> Option<(f64, SVector<f64, N>)> {
    let variable = |k: usize| {
        let inner = Jet::<f64, N>::variable(x[k], k);
        Jet::<Jet<f64, N>, N>::variable(inner, k)
    };
    let jets: [_; N] = std::array::from_fn(variable);
    let u = potential::<Jet<Jet<f64, N>, N>, D, N>(robot, chart, class, &jets)?;
    let mut gradient = SVector::<f64, N>::from_fn(|k, _| u.gradient[k].value);
    let mut curvature = SMatrix::<f64, N, N>::from_fn(|i, j| -u.gradient[i].gradient[j]);
    for k in (0..N).filter(|&k| !free[k]) {
        gradient[k] = 0.0;
        curvature.row_mut(k).fill(0.0);
        curvature.column_mut(k).fill(0.0);
        curvature[(k, k)] = 1.0;
    }
    // −∇²U made positive definite: eigenvalues by modulus, so that saddles are left, not sought.
    // (nalgebra solves the eigenproblem of a generic fixed size only through its dynamic one.)
    let eigen = DMatrix::from_column_slice(N, N, curvature.as_slice()).symmetric_eigen();
    let scale = eigen.eigenvalues.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let mut direction = SVector::<f64, N>::zeros();
    for k in 0..N {
        let axis = SVector::<f64, N>::from_column_slice(eigen.eigenvectors.column(k).as_slice());
        let value = eigen.eigenvalues[k].abs().max(1e-12 * scale);
        direction += axis * (axis.dot(&gradient) / value);
    }
    // Rounding must not lead a climb off the slice.
    (0..N).filter(|&k| !free[k]).for_each(|k| direction[k] = 0.0);
    let gain = direction.dot(&gradient);
    (gain.is_finite() && gain > 1e-8).then_some((u.value.value, direction))
}

/// U at a point of a chart, or `None` outside S_{s,σ}.
fn potential<T: Logarithm, const D: usize, const N: usize>(
    robot: &Robot,
    chart: &Chart,
    class: Class,
    x: &[T; N],
) -> Option<T> {
    let (placement, legs) = chart.at::<T, D, N>(robot, x, |k| x[k].sin_cos());
    let mut sum = Some(T::zero());
    let demand = Demand::class(class.mode, class.sign);
    Constraints::new(robot, &placement, &legs).visit(&demand, |constraint, value| {
        let weight = match constraint.kind() {
            Kind::Serial(_) => 0.5,
            Kind::Parallel | Kind::Limit => 1.0,
        };
        sum = sum.filter(|_| value.number() > 0.0).map(|s| s + value.ln().scale(Interval::point(weight)));
        sum.is_some()
    });
    sum
}

/// Scalars with a logarithm; none of it is certified.
trait Logarithm: Scalar {
    fn ln(self) -> Self;
    fn number(self) -> f64;
}

impl Logarithm for f64 {
    fn ln(self) -> Self {
        f64::ln(self)
    }
    fn number(self) -> f64 {
        self
    }
}

impl<T: Logarithm, const N: usize> Logarithm for Jet<T, N> {
    fn ln(self) -> Self {
        self.chain(self.value.ln(), T::constant(Interval::point(1.0)) / self.value)
    }
    fn number(self) -> f64 {
        self.value.number()
    }
}
