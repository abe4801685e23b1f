//! Whether two bodies are clear of one another, over a box in a working mode.
//!
//! Bodies are segments with a radius. With the points P + u e and P′ + v e′ of two of them, (u, v) in the unit square, what counts is the least
//! of φ(u, v) = ‖P + u e − P′ − v e′‖², less the square of the distance asked for. The square is cut into parts, and those are dropped in which
//! φ is greater everywhere than somewhere else; what is left falls into clusters, and φ is looked at over each, u and v being anything there:
//! a vector along which φ grows for all of them is one along which the least grows (docs/theory.md, 5). φ is convex in (u, v), so that a tangent plane bounds it
//! from below.
//!
//! Thin bodies, with no distance asked for, do not touch where a line parts them: one along either of them, or across it at an end.

mod sides;

use super::body::MOST;
use super::in_mode::InMode;
use super::place::{Along, Function, OWN, ZERO};
use super::rods::Shared;
use super::turns::{Joint, Turn, joints};
use aspecta_robot::num::{Interval, Jet, Scalar};
use aspecta_robot::{AXES, Body, BodyPair};
use sides::{are_parted, do_cross, lines, on_side, turns_at};

/// A function of the axes and of the q of both bodies' legs.
pub(super) type Both = Jet<Interval, { AXES + 2 }>;

/// The axis of a body.
pub(super) struct Axis<T, const D: usize> {
    from: [T; D],
    along: [T; D],
}

/// A part of the unit square.
#[derive(Clone, Copy)]
struct Part {
    u: Interval,
    v: Interval,
}

/// A pair of bodies over a box, looked at in [`InMode::apart`].
pub(super) enum Apart {
    /// Something else is less.
    Far,
    /// Functions of which the least counts.
    Least(Vec<Shared>),
    /// Lines of which one must part the bodies, and the ends of both.
    Parted(Vec<Line>, Box<[Joint; 4]>),
}

/// A line that may part two bodies.
pub(super) struct Line {
    /// How far the ends of one body are on one side of it: the lesser counts.
    pub ends: [Shared; 2],
    /// The turns that the ends take there.
    pub turns: Vec<Turn>,
}

/// Cuts of the unit square, each into four.
const CUTS: usize = 4;
/// Parts this wide are not cut.
const NARROW: f64 = 1.0 / 16.0;
/// How often a part is narrowed.
const NARROWINGS: usize = 3;
/// Steps towards the least φ.
const STEPS: usize = 60;

impl<T: Scalar, const D: usize> Axis<T, D> {
    pub fn end(&self, which: usize) -> [T; D] {
        if which == 0 { self.from } else { std::array::from_fn(|k| self.from[k] + self.along[k]) }
    }

    fn map<U>(&self, to: impl Fn(T) -> U) -> Axis<U, D> {
        Axis { from: self.from.map(&to), along: self.along.map(&to) }
    }
}

fn product<T: Scalar, const D: usize>(a: &[T; D], b: &[T; D]) -> T {
    (1..D).fold(a[0] * b[0], |sum, k| sum + a[k] * b[k])
}

fn square<T: Scalar, const D: usize>(a: &[T; D]) -> T {
    a[1..].iter().fold(a[0].square(), |sum, x| sum + x.square())
}

/// All t in [0, 1] at which a t² − 2 b t is least there.
fn stationary(a: Interval, b: Interval) -> Interval {
    match a.is_positive() {
        true => (b / a).clamped(),
        false => Part::WHOLE.u,
    }
}

/// The common part, if there is one.
fn common(a: Interval, b: Interval) -> Option<Interval> {
    let (lo, hi) = (a.lo.max(b.lo), a.hi.min(b.hi));
    (lo <= hi).then_some(Interval { lo, hi })
}

/// From a point of the second body to one of the first.
fn between<T: Scalar, const D: usize>([first, second]: &[Axis<T, D>; 2], u: T, v: T) -> [T; D] {
    std::array::from_fn(|k| (first.from[k] - second.from[k]) + (u * first.along[k] - v * second.along[k]))
}

impl Part {
    const WHOLE: Self = Self { u: Interval { lo: 0.0, hi: 1.0 }, v: Interval { lo: 0.0, hi: 1.0 } };

    /// The edges of the square: segments in the plane that do not cross are nearest at an end of one of them.
    fn edges() -> [Self; 4] {
        let (start, end) = (Interval::point(0.0), Interval::point(1.0));
        let whole = Self::WHOLE;
        [
            Self { u: start, ..whole },
            Self { u: end, ..whole },
            Self { v: start, ..whole },
            Self { v: end, ..whole },
        ]
    }

    fn halves(self) -> impl Iterator<Item = Self> {
        let halves = |x: Interval| {
            let middle = x.mid();
            let upper = (x.lo < x.hi).then_some(Interval { lo: middle, hi: x.hi });
            std::iter::once(Interval { lo: x.lo, hi: if upper.is_some() { middle } else { x.hi } })
                .chain(upper)
        };
        halves(self.u).flat_map(move |u| halves(self.v).map(move |v| Self { u, v }))
    }

    fn touches(&self, other: &Self) -> bool {
        let touch = |a: Interval, b: Interval| a.lo <= b.hi && b.lo <= a.hi;
        touch(self.u, other.u) && touch(self.v, other.v)
    }

    /// What of these parts φ may be least in, in clusters of each.
    fn nearest<const D: usize>(axes: &[Axis<Interval, D>; 2], parts: &[Self]) -> Vec<Self> {
        let phi = |part: &Self| square(&between(axes, part.u, part.v));
        let at_middle = |part: &Self| {
            let point = |x: Interval| Interval::point(x.mid());
            phi(&Self { u: point(part.u), v: point(part.v) }).hi
        };
        let mut whole: Vec<Self> = parts.iter().filter_map(|part| part.narrowed(axes)).collect();
        // What φ is at most somewhere, in all configurations.
        let mut least = whole.iter().map(at_middle).fold(f64::INFINITY, f64::min);
        whole.retain(|part| phi(part).lo <= least);
        let pieces = |part: Self| {
            let mut pieces = vec![part];
            for _ in 0..CUTS {
                if pieces.iter().all(Self::is_narrow) {
                    break;
                }
                pieces = pieces.into_iter().flat_map(Self::halves).collect();
                least = pieces.iter().map(at_middle).fold(least, f64::min);
                pieces.retain(|part| phi(part).lo <= least);
            }
            Self::clusters(pieces)
        };
        whole.into_iter().flat_map(pieces).filter_map(|part| part.narrowed(axes)).collect()
    }

    fn is_narrow(&self) -> bool {
        self.u.width().max(self.v.width()) <= NARROW
    }

    /// Parts that hang together, as one each.
    fn clusters(parts: Vec<Self>) -> Vec<Self> {
        let mut clusters: Vec<Self> = Vec::new();
        for part in parts {
            let mut whole = part;
            // What is joined may touch others.
            while let Some(k) = clusters.iter().position(|cluster| cluster.touches(&whole)) {
                let other = clusters.swap_remove(k);
                whole = Self { u: whole.u.hull(other.u), v: whole.v.hull(other.v) };
            }
            clusters.push(whole);
        }
        clusters
    }

    /// What of the part can be nearest, if anything can. φ is least only where its derivative by u vanishes, or at an end of [0, 1] towards which it falls; and so by v.
    fn narrowed<const D: usize>(mut self, axes: &[Axis<Interval, D>; 2]) -> Option<Self> {
        for _ in 0..NARROWINGS {
            let [first, second] = axes;
            let gap: [Interval; D] = std::array::from_fn(|k| first.from[k] - second.from[k]);
            let both = product(&first.along, &second.along);
            let u = stationary(square(&first.along), self.v * both - product(&first.along, &gap));
            self.u = common(self.u, u)?;
            let v = stationary(square(&second.along), self.u * both + product(&second.along, &gap));
            self.v = common(self.v, v)?;
        }
        Some(self)
    }

    /// The least φ in the part.
    fn least<const D: usize>(&self, axes: &[Axis<Interval, D>; 2]) -> Interval {
        let numbers = axes.each_ref().map(|axis| axis.map(Interval::mid));
        let [first, second] = numbers.each_ref().map(|axis| square(&axis.along));
        let within = |x: f64, range: Interval| {
            if x.is_finite() { x.clamp(range.lo, range.hi) } else { range.mid() }
        };
        // Each of the two in turn is made best; whatever is found, a tangent plane there is below φ.
        let (mut u, mut v) = (self.u.mid(), self.v.mid());
        for _ in 0..STEPS {
            let before = (u, v);
            u = within(u - product(&between(&numbers, u, v), &numbers[0].along) / first, self.u);
            v = within(v + product(&between(&numbers, u, v), &numbers[1].along) / second, self.v);
            if (u, v) == before {
                break;
            }
        }
        let at = between(axes, Interval::point(u), Interval::point(v));
        let two = Interval::point(2.0);
        let slopes = [product(&at, &axes[0].along) * two, -product(&at, &axes[1].along) * two];
        let ways = [self.u - Interval::point(u), self.v - Interval::point(v)];
        let below = slopes.iter().zip(ways).fold(square(&at), |sum, (slope, way)| sum + *slope * way);
        Interval { lo: below.lo.max(0.0).min(below.hi), hi: square(&at).hi }
    }
}

impl<const D: usize> InMode<'_, '_, D> {
    /// How far apart two bodies are, where something else is at most `least` (scaled).
    pub(super) fn apart(&self, pair: &BodyPair, scale: f64, least: f64) -> Apart {
        if let Some(ends) = self.beyond_wall(pair) {
            return Apart::Least(ends);
        }
        let values = self.axes(pair, |_, f| f.over.value);
        if is_far(&values, pair, scale, least) {
            return Apart::Far;
        }
        match pair.is_thin() {
            false => {
                let parts = if D == 2 { &Part::edges()[..] } else { &[Part::WHOLE] };
                Apart::Least(self.least_in(pair, Part::nearest(&values, parts)))
            }
            true => {
                let (over, middle) = (self.axes(pair, lifted), self.axes(pair, |_, f| f.at_middle));
                let side = |line: usize, end: usize| {
                    self.shared(pair, on_side(&over, line, end), on_side(&middle, line, end))
                };
                let names = pair.bodies.map(|body| joints(self.place.setting.robot, body));
                let joint = |k: usize| {
                    let place = values[k / 2].end(k % 2);
                    (names[k / 2][k % 2], [place[0], place[1]])
                };
                let joints: [Joint; 4] = std::array::from_fn(joint);
                let line = |k: usize| Line { ends: [side(k, 0), side(k, 1)], turns: turns_at(k, &joints) };
                Apart::Parted(lines(&values).map(line).collect(), Box::new(joints))
            }
        }
    }

    /// How far they are apart: positive if they are clear of one another.
    pub(super) fn clearance_of(&self, pair: &BodyPair) -> Interval {
        if let Some(ends) = self.beyond_wall(pair) {
            return least_of(&ends);
        }
        if D == 2 && !pair.is_thin() && do_cross(&self.axes(pair, |_, f| f.over.value)) {
            return -pair.distance.square();
        }
        match self.apart(pair, 1.0, 0.0) {
            Apart::Far => Interval { lo: f64::MIN_POSITIVE, hi: f64::INFINITY },
            Apart::Least(all) => {
                let least = least_of(&all);
                // Nearest at an end, if they do not cross.
                let may_cross = || !are_parted(&self.axes(pair, |_, f| f.over.value));
                if D == 2 && least.hi > 0.0 && may_cross() {
                    least.least(self.distance_of(pair))
                } else {
                    least
                }
            }
            Apart::Parted(all, _) => {
                let lesser = all.iter().map(|line| line.ends[0].range.least(line.ends[1].range));
                lesser.fold(Interval::point(f64::NEG_INFINITY), Interval::greatest)
            }
        }
    }

    /// Their least distance squared, less that asked for, wherever on the bodies that is.
    fn distance_of(&self, pair: &BodyPair) -> Interval {
        let values = self.axes(pair, |_, f| f.over.value);
        least_of(&self.least_in(pair, Part::nearest(&values, &[Part::WHOLE])))
    }

    /// The least φ in each part, less the square of the distance asked for.
    fn least_in(&self, pair: &BodyPair, parts: Vec<Part>) -> Vec<Shared> {
        let (over, middle) = (self.axes(pair, lifted), self.axes(pair, |_, f| f.at_middle));
        let asked = pair.distance.square();
        let least = |part: Part| {
            let phi = square(&between(&over, Both::constant(part.u), Both::constant(part.v)));
            self.shared(pair, phi - Both::constant(asked), part.least(&middle) - asked)
        };
        parts.into_iter().map(least).collect()
    }

    /// The axes of two bodies.
    pub(super) fn axes<T: Scalar>(
        &self,
        pair: &BodyPair,
        value: impl Fn(usize, &Point) -> T,
    ) -> [Axis<T, D>; 2] {
        std::array::from_fn(|slot| {
            let body = pair.bodies[slot];
            let leg = body.leg().map(|j| &*self.legs[j.index()]);
            let ends = match (body, leg) {
                (Body::Crank(_), Some(leg)) => [leg.joint(0), leg.joint(1)],
                (Body::Rod(_), Some(leg)) => [leg.joint(1), leg.joint(2)],
                (Body::Platform(_) | Body::Obstacle(_) | Body::Crank(_) | Body::Rod(_), _) => {
                    self.place.ends(body)
                }
            };
            let [from, to] = ends.map(|end| -> [T; D] { std::array::from_fn(|k| value(slot, &end[k])) });
            Axis { from, along: std::array::from_fn(|k| to[k] - from[k]) }
        })
    }

    /// A function of both legs, and what it is where the axes and the q's of the legs are at their middle.
    pub(super) fn shared(&self, pair: &BodyPair, f: Both, at_middle: Interval) -> Shared {
        let legs = pair.bodies.map(|body| body.leg().map(|j| (j.index(), &*self.legs[j.index()])));
        let (mut by_joint, mut middle) = ([ZERO; MOST], at_middle);
        let mut total: [Interval; AXES] = std::array::from_fn(|a| f.gradient[a]);
        for (slot, (j, leg)) in legs.into_iter().enumerate().filter_map(|(slot, leg)| Some((slot, leg?))) {
            let slope = f.gradient[AXES + slot];
            by_joint[j] = slope;
            match leg.loose {
                true => middle = middle + slope * (leg.q - leg.middle),
                false => (0..AXES).for_each(|a| total[a] = total[a] + slope * leg.rate[a]),
            }
        }
        let range = self.place.centred(&Along { value: f.value, gradient: total }, middle);
        Shared { range, along: std::array::from_fn(|a| f.gradient[a]), by_joint }
    }
}

/// A coordinate of a point over the box and at its middle.
#[derive(Clone, Copy)]
pub(super) struct Point {
    pub over: Function,
    pub at_middle: Interval,
}

/// A function of one leg as one of both, that of the first or the second body. What is of no leg has no derivative by its q.
pub(super) fn lifted(slot: usize, f: &Point) -> Both {
    let mut gradient = [ZERO; AXES + 2];
    gradient[..AXES].copy_from_slice(&f.over.gradient[..AXES]);
    gradient[AXES + slot] = f.over.gradient[OWN];
    Both { value: f.over.value, gradient }
}

/// The least of several functions.
fn least_of(all: &[Shared]) -> Interval {
    all.iter().map(|one| one.range).fold(Interval::point(f64::INFINITY), Interval::least)
}

/// Whether the bodies are so far apart that their scaled margin is more than `least`: by the discs or balls round them.
fn is_far<const D: usize>(axes: &[Axis<Interval, D>; 2], pair: &BodyPair, scale: f64, least: f64) -> bool {
    let half = Interval::point(0.5);
    let reach = axes.iter().fold(pair.distance, |sum, axis| sum + square(&axis.along).sqrt() * half);
    let gap = square(&between(axes, half, half)).sqrt() - reach;
    if pair.is_thin() {
        // Some line parts them; of how far nothing is said, so that the others must be below zero.
        return gap.is_positive() && least <= 0.0;
    }
    // A distance of gap more than is asked for.
    gap.is_positive()
        && ((gap * (gap + pair.distance + pair.distance)) / Interval::point(scale)).sqrt().lo > least
}
