//! All zeros of the equations of cusps in a box: branch and prune.

use super::Doubt;
use super::equations::{Pivot, System, Values};
use crate::chart::{Chart, Fold, cover};
use crate::modal::closures;
use crate::placement::Placement;
use aspecta_robot::num::{Interval, Jet, Slope};
use aspecta_robot::work;
use aspecta_robot::work::{Control, Progress};
use aspecta_robot::{LegIndex, Window};
use nalgebra::SMatrix;

/// A box of the chart's coordinates.
pub(super) type Region<const N: usize> = [Interval; N];

/// Boxes narrower than this part of the window in every coordinate are split no more.
const FINEST: f64 = 1e-7;

/// Boxes between two looks at whether to stop.
const CHUNK: usize = 1024;

/// A cusp proved to exist.
#[derive(Clone, Debug)]
pub(super) struct Found<const N: usize> {
    /// It is the only one in here.
    pub alone: Region<N>,
    /// It is in here.
    pub tight: Region<N>,
}

/// The findings of a search.
#[derive(Clone, Debug)]
pub(super) struct Findings<const N: usize> {
    pub found: Vec<Found<N>>,
    pub doubts: Vec<(Region<N>, Doubt)>,
    /// Boxes looked at.
    pub boxes: u64,
}

impl<const N: usize> Findings<N> {
    fn add(&mut self, outcome: Outcome<N>, next: &mut Vec<Region<N>>) {
        match outcome {
            Outcome::Empty => {}
            Outcome::Found(found) => self.found.push(found),
            Outcome::Split(halves) => next.extend(halves),
            Outcome::Doubtful(region, why) => self.doubts.push((region, why)),
        }
    }
}

/// The outcome of looking at a box.
enum Outcome<const N: usize> {
    Empty,
    Found(Found<N>),
    Split([Region<N>; 2]),
    Doubtful(Region<N>, Doubt),
}

/// A search for cusps: the system, and the box to search.
pub(super) struct Search<'a, const D: usize, const N: usize> {
    pub system: System<'a, D>,
    /// The window of the chart.
    pub window: Window,
    /// Charts that are searched by themselves.
    pub elsewhere: &'a [Fold],
}

impl<const D: usize, const N: usize> Search<'_, D, N> {
    /// Searches the window, level by level, with at most `budget` boxes. Deterministic, whatever the number
    /// of threads.
    pub fn run(&self, budget: u64, control: &Control<'_>) -> Findings<N> {
        let whole: Region<N> =
            std::array::from_fn(|k| Interval::new(self.window.ranges[k].0, self.window.ranges[k].1));
        let mut all = Findings { found: Vec::new(), doubts: Vec::new(), boxes: 0 };
        let mut level = vec![whole];
        while !level.is_empty() {
            let mut next = Vec::new();
            let mut chunks = level.chunks(CHUNK);
            for chunk in chunks.by_ref() {
                let stopped = control.is_cancelled();
                if stopped || all.boxes + chunk.len() as u64 > budget {
                    let why = if stopped { Doubt::Cancelled } else { Doubt::Boxes };
                    let rest = chunk.iter().chain(chunks.flatten()).chain(&next);
                    all.doubts.extend(rest.map(|region| (*region, why)));
                    return all;
                }
                all.boxes += chunk.len() as u64;
                let outcomes: Vec<_> = work::map(chunk, |region| self.settle(*region));
                outcomes.into_iter().for_each(|outcome| all.add(outcome, &mut next));
                let total = all.boxes + (level.len() + next.len()) as u64;
                (control.progress)(Progress { stage: "searching for cusps", done: all.boxes, total });
            }
            level = next;
        }
        all
    }

    /// Width of the window in coordinate `k`.
    fn unit(&self, k: usize) -> f64 {
        self.window.ranges[k].1 - self.window.ranges[k].0
    }

    fn settle(&self, mut region: Region<N>) -> Outcome<N> {
        const MOST_STEPS: usize = 10;
        if self.is_elsewhere(&region) {
            return Outcome::Empty;
        }
        let mut strict = false;
        for _ in 0..MOST_STEPS {
            let Some(step) = self.contract(&region) else { return Outcome::Empty };
            strict |= step.strict;
            let shrunk = (0..N).any(|k| step.region[k].width() < 0.6 * region[k].width());
            region = step.region;
            if !shrunk {
                break;
            }
        }
        let width = |k: usize| region[k].width() / self.unit(k);
        let widest = (0..N).max_by(|a, b| width(*a).total_cmp(&width(*b))).unwrap_or(0);
        if (strict || width(widest) < 1e-3)
            && let Some(found) = self.certify(&region)
        {
            return if self.is_outside(&found.tight) { Outcome::Empty } else { Outcome::Found(found) };
        }
        if width(widest) < FINEST {
            return Outcome::Doubtful(region, self.doubt(&region));
        }
        let mid = region[widest].mid();
        let half = |part: Interval| std::array::from_fn(|k| if k == widest { part } else { region[k] });
        let (lo, hi) = (Interval::new(region[widest].lo, mid), Interval::new(mid, region[widest].hi));
        Outcome::Split([half(lo), half(hi)])
    }

    /// Whether the whole box is covered by charts that are searched by themselves.
    fn is_elsewhere(&self, region: &Region<N>) -> bool {
        if self.elsewhere.is_empty() || self.system.chart != Chart::Pose {
            return false;
        }
        let robot = self.system.robot;
        let legs = closures::<Interval, D, N>(robot, &Placement::at(robot.platform, region));
        self.elsewhere.iter().any(|fold| cover(fold, &legs[fold.leg.index()]).iter().all(|m| m.is_positive()))
    }

    /// Whether a box lies beyond the window.
    fn is_outside(&self, region: &Region<N>) -> bool {
        (0..N).any(|k| {
            let (lo, hi) = self.window.ranges[k];
            !self.window.glued[k] && (region[k].hi < lo || hi < region[k].lo)
        })
    }

    /// Returns one step of pruning: `None` if no cusp is in the box.
    ///
    /// The centred form f(c) + S t ∋ f(x), x = c + r∘t, excludes the box or leaves the linear equations Y
    /// f(c) + Y S t ∋ 0, Y ≈ S⁻¹, which bound one tₖ after the other (Hansen and Sengupta 1981): no zero is
    /// lost.
    fn contract(&self, region: &Region<N>) -> Option<Contracted<N>> {
        let centre = region.map(Interval::mid);
        let radius: [f64; N] = std::array::from_fn(|k| {
            (Interval::point(region[k].hi) - Interval::point(centre[k]))
                .hi
                .max((Interval::point(centre[k]) - Interval::point(region[k].lo)).hi)
        });
        let pivot = self.system.pivot(&centre);
        let variables: [_; N] = std::array::from_fn(|k| {
            let (c, r) = (Interval::point(centre[k]), Interval::point(radius[k]));
            Slope::<Interval, N>::variable(region[k], c, r, k)
        });
        let values = self.system.values(&variables, pivot);
        if is_empty(&values, |f| f.range) {
            return None;
        }
        let f = values.equations;
        let same = Contracted { region: *region, strict: false };
        let middle = SMatrix::<f64, N, N>::from_fn(|i, k| f[i].slope[k].mid());
        let Some(inverse) = middle.try_inverse().filter(|y| y.iter().all(|v| v.is_finite())) else {
            return Some(same);
        };
        let weighted = |i: usize, of: &dyn Fn(usize) -> Interval| {
            (0..N).fold(Interval::point(0.0), |sum, k| sum + Interval::point(inverse[(i, k)]) * of(k))
        };
        let mut t = [Interval::new(-1.0, 1.0); N];
        let mut strict = true;
        for i in 0..N {
            let row: [Interval; N] = std::array::from_fn(|j| weighted(i, &|k| f[k].slope[j]));
            let rest =
                (0..N).filter(|&j| j != i).fold(weighted(i, &|k| f[k].centre), |sum, j| sum + row[j] * t[j]);
            if row[i].contains(0.0) {
                strict = false;
                continue;
            }
            let image = -rest / row[i];
            strict &= -1.0 < image.lo && image.hi < 1.0;
            if image.hi < t[i].lo || t[i].hi < image.lo {
                return None;
            }
            t[i] = t[i].meet(image);
        }
        let moved = |k: usize| region[k].meet(Interval::point(centre[k]) + Interval::point(radius[k]) * t[k]);
        Some(Contracted { region: std::array::from_fn(moved), strict })
    }

    /// The cusp of a box, if it is proved to be one and alone in a box a little larger.
    ///
    /// By Krawczyk's theorem (Neumaier 1990, 5.1.8): if m − Y f(m) + (I − Y F(X))(X − m), F(X) enclosing f′
    /// over X, lies in the interior of X, then f has exactly one zero in X. That zero is a cusp if the pivot
    /// is not zero in X, and an ordinary one, at which exactly three solutions meet, as f′ is regular.
    fn certify(&self, region: &Region<N>) -> Option<Found<N>> {
        const STEPS: usize = 12;
        let grown = |k: usize| {
            let margin = 0.1 * region[k].width() + 1e-12 * self.unit(k);
            Interval::new(region[k].lo - margin, region[k].hi + margin)
        };
        let alone: Region<N> = std::array::from_fn(grown);
        let pivot = self.system.pivot(&alone.map(Interval::mid));
        let image = self.krawczyk(&alone, pivot)?;
        if !(0..N).all(|k| alone[k].lo < image[k].lo && image[k].hi < alone[k].hi) {
            return None;
        }
        let mut tight = image;
        for _ in 0..STEPS {
            let Some(image) = self.krawczyk(&tight, pivot) else { break };
            let next: Region<N> = std::array::from_fn(|k| tight[k].meet(image[k]));
            let shrunk = (0..N).any(|k| next[k].width() < 0.9 * tight[k].width());
            tight = next;
            if !shrunk {
                break;
            }
        }
        Some(Found { alone, tight })
    }

    /// Krawczyk's operator on a box without singularities of other kinds.
    fn krawczyk(&self, region: &Region<N>, pivot: Pivot) -> Option<Region<N>> {
        let centre = region.map(Interval::mid);
        let variables: [_; N] = std::array::from_fn(|k| Jet::<Interval, N>::variable(region[k], k));
        let over = self.system.values(&variables, pivot);
        let regular = |f: &Jet<Interval, N>| f.value.is_positive();
        if over.pivot.value.sign() == 0 || !over.closing.iter().chain(&over.weights).all(regular) {
            return None;
        }
        let f = over.equations;
        let at = self.system.values(&centre.map(Interval::point), pivot).equations;
        let middle = SMatrix::<f64, N, N>::from_fn(|i, k| f[i].gradient[k].mid());
        let inverse = middle.try_inverse().filter(|y| y.iter().all(|v| v.is_finite()))?;
        let entry = |i: usize, k: usize| Interval::point(inverse[(i, k)]);
        Some(std::array::from_fn(|i| {
            let shift = (0..N).fold(Interval::point(0.0), |sum, k| sum + entry(i, k) * at[k]);
            (0..N).fold(Interval::point(centre[i]) - shift, |image, j| {
                let identity = Interval::point(f64::from(u8::from(i == j)));
                let defect = (0..N).fold(identity, |sum, k| sum - entry(i, k) * f[k].gradient[j]);
                image + defect * (region[j] - Interval::point(centre[j]))
            })
        }))
    }

    /// Why a box as small as this is undecided.
    fn doubt(&self, region: &Region<N>) -> Doubt {
        let values = self.system.values(region, self.system.pivot(&region.map(Interval::mid)));
        let touched = |of: &[Interval; N]| of.iter().position(|f| !f.is_positive());
        if let Some(leg) = touched(&values.weights) {
            return Doubt::FreeJoint { leg: LegIndex::new(leg) };
        }
        if let Some(leg) = touched(&values.closing) {
            return Doubt::Serial { leg: LegIndex::new(leg) };
        }
        let cofactors = self.system.cofactors(region);
        if cofactors.iter().flatten().all(|c| c.contains(0.0)) { Doubt::Rank } else { Doubt::Degenerate }
    }
}

/// A box after contraction.
struct Contracted<const N: usize> {
    region: Region<N>,
    /// Whether every bound moved inward.
    strict: bool,
}

/// Whether a function that is zero at cusps is not, or one that is positive or zero is negative.
fn is_empty<T, const N: usize>(values: &Values<T, N>, range: impl Fn(&T) -> Interval) -> bool {
    values.closing.iter().any(|f| range(f).is_negative())
        || values.equations.iter().any(|f| range(f).sign() != 0)
}
