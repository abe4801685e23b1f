//! Orientations at which the eliminant of a plane body cannot be told from zero.
//!
//! The eliminant F has a double root for two reasons: two poses meet (a parallel singularity), or two poses
//! of one orientation, far apart and each regular, make both linear equations one (Δ = 0). To the second, F
//! is blind. Here u is found from one line u · w = g and the circle, on either side of w, and what is left of
//! the system is
//!
//! > h±(φ) = u±(φ) · w′ − g′,
//!
//! a function of φ alone, for another line (w′, g′). Its roots are the poses on that side, and they are
//! simple wherever the pose is regular.

use super::locked::Locked;
use super::triangle::{Complex, Lines, Triangle, conjugate_times, dot, norm2};
use super::{Roots, SelfMotion};
use arrayvec::ArrayVec;
use aspecta_robot::Platform;
use aspecta_robot::num::{Interval, Jet, Scalar};

/// The knowledge of the poses whose orientation lies in some range.
enum Known {
    /// There is exactly one near each of these.
    Poses(ArrayVec<[f64; 3], 2>),
    /// Not enough: cut the range.
    Open,
}

/// A function of φ and its derivative.
type Slope = Jet<Interval, 1>;

/// The three locked legs over all scalars that are needed here.
struct Problem<'a> {
    legs: &'a [Locked],
    exact: Triangle<Interval>,
    sloped: Triangle<Slope>,
    curved: Triangle<Jet<Slope, 1>>,
    numeric: Triangle<f64>,
}

/// Ranges of orientations, in rad, that are not cut any more.
const FINEST: f64 = 1e-14;

/// Adds to `roots` the poses with orientation in `phi` and counts them if it can.
///
/// The range is cut until every part is settled or more than a few parts stay open at once, which is what
/// poses that meet do; the solutions there are then approximated and their number stays open.
pub(super) fn resolve(
    legs: &[Locked],
    triangle: &Triangle<Interval>,
    phi: Interval,
    roots: &mut Roots<3>,
) -> Result<(), SelfMotion> {
    const MOST_OPEN: usize = 16;
    // Even six poses that meet spread less when the equations are off by a rounding (ε^(1/6) ≈ 0.002).
    const WIDEST: f64 = 0.05;
    let problem = Problem {
        legs,
        exact: *triangle,
        sloped: triangle.over(),
        curved: triangle.over(),
        numeric: triangle.over(),
    };
    let mut open: Vec<Interval> = vec![phi];
    loop {
        let mut parts = Vec::new();
        for &phi in &open {
            match problem.examine(phi) {
                Known::Poses(poses) => {
                    roots.at_most = roots.at_most.map(|n| n + poses.len());
                    for pose in poses {
                        roots.push(pose)?;
                    }
                }
                Known::Open => parts.extend(halves(phi)),
            }
        }
        open = parts;
        let Some(first) = open.first() else { return Ok(()) };
        if open.len() > MOST_OPEN || first.width() < FINEST {
            break;
        }
    }
    let (lo, hi) = (open[0].lo, open[open.len() - 1].hi);
    if hi - lo > WIDEST || open.iter().any(|&phi| problem.stays_free(phi)) {
        return Err(SelfMotion);
    }
    let mut cuts: Vec<f64> = open.iter().map(|part| part.lo).collect();
    cuts.push(hi);
    problem.approximate(&cuts, roots)
}

/// R₁² ‖w‖² − g², positive where the line u · w = g cuts the circle: ‖w‖² times the square of half the chord.
fn discriminants<T: Scalar>(triangle: &Triangle<T>, Lines { w, g }: &Lines<T>) -> [T; 3] {
    std::array::from_fn(|i| triangle.r2[0] * norm2(w[i]) - g[i].square())
}

/// The line on which to look for u, which ties it down best, and the next best.
fn choose(discriminants: [f64; 3]) -> (usize, usize) {
    let mut order = [0, 1, 2];
    order.sort_unstable_by(|&a, &b| discriminants[b].total_cmp(&discriminants[a]));
    (order[0], order[1])
}

/// z = e^{iφ}.
fn direction<T: Scalar>(phi: T) -> Complex<T> {
    let (sin, cos) = phi.sin_cos();
    [cos, sin]
}

/// The lines at the orientation φ.
fn lines_at<T: Scalar>(triangle: &Triangle<T>, phi: T) -> Lines<T> {
    triangle.lines(direction(phi))
}

/// A function of φ and its first derivative.
fn slope_of<T: Scalar>([value, first, _]: [T; 3]) -> Jet<T, 1> {
    Jet { value, gradient: [first] }
}

/// h on one side of the line `at`, with the line `other`.
fn mismatch<T: Scalar>(
    triangle: &Triangle<T>,
    Lines { w, g }: &Lines<T>,
    at: usize,
    other: usize,
    side: f64,
) -> T {
    dot(triangle.on_circle(w[at], g[at], side), w[other]) - g[other]
}

/// Whether double precision cannot tell that there is any line: wᵢ = 0 and gᵢ = 0 for all i.
fn nothing_ties(Lines { w, g }: &Lines<Interval>) -> bool {
    (0..3).all(|i| norm2(w[i]).contains(0.0) && g[i].contains(0.0))
}

/// Two parts, cut off the middle, where symmetric robots like to have their solutions.
fn halves(phi: Interval) -> [Interval; 2] {
    let cut = phi.lo + 0.47 * (phi.hi - phi.lo);
    [Interval::new(phi.lo, cut), Interval::new(cut, phi.hi)]
}

impl Problem<'_> {
    /// Whether `phi` holds an orientation at which, as far as double precision can tell, nothing ties down
    /// (x, y) but ‖u‖ = R₁.
    fn stays_free(&self, phi: Interval) -> bool {
        let lines = lines_at(&self.exact, phi);
        let cuts = discriminants(&self.exact, &lines);
        !cuts.iter().any(|d| d.is_negative() || d.is_positive())
            && nothing_ties(&lines)
            && (phi.width() < FINEST || halves(phi).into_iter().any(|part| self.stays_free(part)))
    }

    /// Counts the poses in `phi`: on a side on which h is proved monotonous, the signs at the ends tell.
    fn examine(&self, phi: Interval) -> Known {
        let mut poses = ArrayVec::new();
        let cuts = discriminants(&self.exact, &lines_at(&self.exact, phi));
        if cuts.iter().any(|d| d.is_negative()) {
            return Known::Poses(poses);
        }
        let (at, other) = choose(cuts.map(|d| d.lo));
        if !cuts[at].is_positive() {
            return Known::Open;
        }
        // Mean-value forms of h′ and of h, for narrow enclosures near an extremum of h.
        let middle = Interval::point(phi.mid());
        let lines_at_middle = self.exact.lines_in_phi(direction(middle), slope_of);
        let lines_over = self.exact.lines_in_phi(direction(phi), |f| Jet {
            value: slope_of(f),
            gradient: [Jet { value: f[1], gradient: [f[2]] }],
        });
        for side in [1.0, -1.0] {
            let at_middle = mismatch(&self.sloped, &lines_at_middle, at, other, side);
            let over = mismatch(&self.curved, &lines_over, at, other, side);
            let [Jet { value: slope, gradient: [curvature] }] = over.gradient;
            let slope = slope.meet(at_middle.gradient[0] + curvature * (phi - middle));
            let range = at_middle.value + slope * (phi - middle);
            if !range.contains(0.0) {
                continue;
            }
            let sign_at = |phi: f64| {
                let lines = lines_at(&self.exact, Interval::point(phi));
                mismatch(&self.exact, &lines, at, other, side).sign()
            };
            match sign_at(phi.lo) * sign_at(phi.hi) * slope.sign().abs() {
                0 => return Known::Open,
                1 => {}
                _ => poses.push(self.pose(phi, at, other, side)),
            }
        }
        Known::Poses(poses)
    }

    /// The poses between the first and the last of `cuts` at which the equations hold to rounding: where h is
    /// zero, and where it turns without reaching zero; or, where so many poses meet that h is no guide, the
    /// nearest.
    fn approximate(&self, cuts: &[f64], roots: &mut Roots<3>) -> Result<(), SelfMotion> {
        roots.at_most = None;
        let known = roots.poses.len();
        let (at, other) =
            choose(discriminants(&self.numeric, &lines_at(&self.numeric, cuts[cuts.len() / 2])));
        let turning: Triangle<Jet<f64, 1>> = self.exact.over();
        for side in [1.0, -1.0] {
            let positive = |phi: f64| self.mismatch(phi, at, other, side) > 0.0;
            let rises = |phi: f64| {
                let lines = self.numeric.lines_in_phi(direction(phi), slope_of);
                mismatch(&turning, &lines, at, other, side).gradient[0] > 0.0
            };
            let mut points = cuts.to_vec();
            for pair in cuts.windows(2).filter(|p| rises(p[0]) != rises(p[1])) {
                let turn = bisect(pair[0], pair[1], |phi| rises(phi) == rises(pair[0]));
                points.push(turn);
                if positive(pair[0]) == positive(turn) && positive(turn) == positive(pair[1]) {
                    let (u, z) = self.start(turn, at, side);
                    let pose = self.numeric.pose(z, u);
                    roots.push_if_solution::<2>(Platform::PlaneBody, self.legs, pose)?;
                }
            }
            points.sort_unstable_by(f64::total_cmp);
            for pair in points.windows(2).filter(|p| positive(p[0]) != positive(p[1])) {
                let pose = self.pose(Interval::new(pair[0], pair[1]), at, other, side);
                roots.push_if_solution::<2>(Platform::PlaneBody, self.legs, pose)?;
            }
        }
        if roots.poses.len() == known { self.meeting(cuts, roots) } else { Ok(()) }
    }

    /// The pose where several poses meet and all struts are parallel: every line touches the circle, so that
    /// h is on the brink of existence. What is left is to look for the orientation of least residual.
    fn meeting(&self, cuts: &[f64], roots: &mut Roots<3>) -> Result<(), SelfMotion> {
        let residual = |phi: f64, at: usize, side: f64| {
            let (u, z) = self.start(phi, at, side);
            self.numeric.residual(u, z)
        };
        let searches = cuts.windows(2).flat_map(|range| {
            (0..3).flat_map(move |at| {
                [1.0, -1.0].map(|side| {
                    let phi = minimise(range[0], range[1], |phi| residual(phi, at, side));
                    (phi, at, side, residual(phi, at, side))
                })
            })
        });
        let Some((phi, at, side, _)) = searches.min_by(|a, b| a.3.total_cmp(&b.3)) else { return Ok(()) };
        let (u, z) = self.start(phi, at, side);
        roots.push_if_solution::<2>(Platform::PlaneBody, self.legs, self.numeric.pose(z, u))
    }

    /// The pose at the one root of h in `range`: by bisection, polished if Newton's method stays there.
    fn pose(&self, range: Interval, at: usize, other: usize, side: f64) -> [f64; 3] {
        let positive = |phi: f64| self.mismatch(phi, at, other, side) > 0.0;
        let root = bisect(range.lo, range.hi, |phi| positive(phi) == positive(range.lo));
        let (u, z) = self.start(root, at, side);
        let (better_u, better_z) = self.numeric.polish(u, z);
        // Within the range, seen from its middle: its angles go beyond π.
        let (sin, cos) = range.mid().sin_cos();
        let [along, across] = conjugate_times([cos, sin], better_z);
        let stays = across.atan2(along).abs() <= 0.5 * (range.hi - range.lo);
        if stays { self.numeric.pose(better_z, better_u) } else { self.numeric.pose(z, u) }
    }

    /// h at an orientation, numerical.
    fn mismatch(&self, phi: f64, at: usize, other: usize, side: f64) -> f64 {
        mismatch(&self.numeric, &lines_at(&self.numeric, phi), at, other, side)
    }

    /// (u, z) on one side of the line `at`, whether or not it is on the other line.
    fn start(&self, phi: f64, at: usize, side: f64) -> (Complex<f64>, Complex<f64>) {
        let z = direction(phi);
        let Lines { w, g } = self.numeric.lines(z);
        (self.numeric.on_circle(w[at], g[at], side), z)
    }
}

/// Halves [lo, hi] until no double lies between; `first` holds at lo and not at hi, and at the point returned
/// but not at the next.
fn bisect(mut lo: f64, mut hi: f64, first: impl Fn(f64) -> bool) -> f64 {
    loop {
        let middle = 0.5 * (lo + hi);
        if middle <= lo || hi <= middle {
            return lo;
        }
        *(if first(middle) { &mut lo } else { &mut hi }) = middle;
    }
}

/// Returns the place in [lo, hi] where `f`, which falls and then rises, is least, by cutting into thirds.
fn minimise(mut lo: f64, mut hi: f64, f: impl Fn(f64) -> f64) -> f64 {
    // (2/3)^90 < ε.
    for _ in 0..90 {
        let third = (hi - lo) / 3.0;
        if f(lo + third) <= f(hi - third) {
            hi -= third;
        } else {
            lo += third;
        }
    }
    lo
}
