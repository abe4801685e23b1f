//! Affine forms over eight boxes: functions up to an error, with slopes that are numbers.

mod line;
#[cfg(test)]
mod tests;

pub use line::Line;

use super::kernel::kernel;
use super::lanes::{Lanes, ROUNDING};
use super::{Interval, LANES, Mask, Nearest, Pack, Scalar, Slope, TwoLinks, each};
use line::Curve;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Functions f over eight boxes t ∈ [−1, 1]^M, lane by lane:
///
/// > |f(t) − c − Σ sₖ tₖ| ≤ r for all t,
///
/// and where f has its values, by interval arithmetic.
///
/// As with a [`Slope`], whose slopes are intervals, the error falls with the square of the box, in half the memory and with a quarter of
/// the operations: what is not linear, and all rounding, is in the one number r (Comba and Stolfi, 1993; `docs/theory.md`, 1).
///
/// In a lane in which nothing is known r is infinite or no number, whatever the range.
#[derive(Clone, Copy, Debug)]
pub struct Affine<const M: usize> {
    range: Pack,
    centre: Lanes,
    slope: [Lanes; M],
    radius: Lanes,
}

/// More than products lose that are too small for doubles, and far from being so small itself.
const UNDERFLOW: f64 = 1e-200;

/// `axes!(|k| e)`: [e(0), e(1), …]. (Calls of closures are not reliably inlined.)
macro_rules! axes {
    (|$k:ident| $entry:expr) => {{
        let mut axes = [Lanes::ZERO; M];
        for $k in 0..M {
            axes[$k] = $entry;
        }
        axes
    }};
}

impl<const M: usize> Affine<M> {
    /// The functions that vary with one coordinate of the box only, as these lines.
    pub fn along(axis: usize, line: impl Fn(usize) -> Line) -> Self {
        let lines: [Line; LANES] = std::array::from_fn(line);
        let mut slope = [Lanes::ZERO; M];
        slope[axis] = Lanes(lines.map(|line| line.slope));
        Self {
            range: Pack::from_fn(|l| lines[l].range),
            centre: Lanes(lines.map(|line| line.centre)),
            slope,
            radius: Lanes(lines.map(|line| line.radius)),
        }
    }

    /// Functions of which nothing is known but these ranges.
    pub fn within(range: &Pack) -> Self {
        let (lo, hi) = (Lanes(range.lo), Lanes(range.hi));
        let centre = (lo + hi) * Lanes::of(0.5);
        let radius = (centre - lo).greatest(hi - centre).above();
        Self { range: *range, centre, slope: [Lanes::ZERO; M], radius }
    }

    /// Their ranges, as tightly as both say.
    #[inline(always)]
    pub fn range(&self) -> Pack {
        let f = self;
        kernel!({const M: usize} (f: &Affine<M>) -> Pack { f.tight_range() })
    }

    #[inline(always)]
    fn tight_range(&self) -> Pack {
        let spread = (self.spread() + self.radius).above();
        let linear = Pack { lo: (self.centre - spread).down().0, hi: (self.centre + spread).up().0 };
        let tight = self.range.meet(linear);
        // Of a lane in which nothing is known interval arithmetic may have lost that; and they may contradict one another where there is
        // no number to enclose.
        let mut known = [false; LANES];
        for l in 0..LANES {
            known[l] = spread.0[l] < f64::INFINITY && tight.lo[l] <= tight.hi[l];
        }
        Pack::select(&known, tight, linear)
    }

    /// c, the sₖ and r in one lane.
    pub fn lane(&self, l: usize) -> (f64, [f64; M], f64) {
        (self.centre.0[l], self.slope.map(|s| s.0[l]), self.radius.0[l])
    }

    /// Lane by lane, `yes` where the mask holds, else `no`.
    pub fn select(mask: &Mask, yes: &Self, no: &Self) -> Self {
        Self {
            range: Pack::select(mask, yes.range, no.range),
            centre: Lanes::select(mask, yes.centre, no.centre),
            slope: axes!(|k| Lanes::select(mask, yes.slope[k], no.slope[k])),
            radius: Lanes::select(mask, yes.radius, no.radius),
        }
    }

    /// The product with numbers that do not depend on the point of the box.
    #[inline(always)]
    pub fn times(&self, c: &Pack) -> Self {
        let f = self;
        kernel!({const M: usize} (f: &Affine<M>, c: &Pack) -> Affine<M> { f.scaled(c, f.range * *c) })
    }

    /// Σ |sₖ|, rounded.
    #[inline(always)]
    fn spread(&self) -> Lanes {
        let mut sum = self.slope[0].abs();
        for k in 1..M {
            sum = sum + self.slope[k].abs();
        }
        sum
    }

    /// Every product c f, which is in this range.
    #[inline(always)]
    fn scaled(&self, c: &Pack, range: Pack) -> Self {
        let (lo, hi) = (Lanes(c.lo), Lanes(c.hi));
        let c = (lo + hi) * Lanes::of(0.5);
        let loose = (c - lo).greatest(hi - c);
        let (linear, size) = (self.centre.abs() + self.spread(), c.abs());
        let error = size * self.radius + loose * (linear + self.radius) + size * linear * Lanes::of(ROUNDING);
        Self {
            range,
            centre: c * self.centre,
            slope: axes!(|k| c * self.slope[k]),
            radius: error.above() + Lanes::of(UNDERFLOW),
        }
    }

    /// g with g(t) − k f(t) ∈ [lo, hi]: φ(f), if that is where φ(x) − k x is for all x in the range of f, and φ(x) in this range.
    #[inline(always)]
    fn bent(&self, k: Lanes, [lo, hi]: [Lanes; 2], range: Pack) -> Self {
        let offset = (lo + hi) * Lanes::of(0.5);
        let centre = k * self.centre;
        let linear = centre.abs() + k.abs() * self.spread() + lo.abs() + hi.abs();
        let error =
            k.abs() * self.radius + (offset - lo).greatest(hi - offset) + linear * Lanes::of(ROUNDING);
        Self {
            range,
            centre: centre + offset,
            slope: axes!(|a| k * self.slope[a]),
            radius: error.above() + Lanes::of(UNDERFLOW),
        }
    }

    /// 1/f, in lanes where f is surely not zero.
    ///
    /// With 0 < a ≤ |f| ≤ b and k = 1/(ab): 1/x + kx is least at 1/√k, 2√k, and greatest at a or b.
    fn reciprocal(&self) -> Self {
        let range = self.range();
        let (positive, negative) = (range.positive(), range.negative());
        let (lo, hi) = (Lanes(range.lo), Lanes(range.hi));
        let (a, b) = (Lanes::select(&negative, -hi, lo), Lanes::select(&negative, -lo, hi));
        let one = Lanes::of(1.0);
        let k = one / (a * b);
        let least = k.sqrt() * Lanes::of(2.0 * (1.0 - ROUNDING));
        let greatest = (one / a + k * a).greatest(one / b + k * b).above();
        let (lo, hi) =
            (Lanes::select(&negative, -greatest, least), Lanes::select(&negative, -least, greatest));
        let known: Mask = std::array::from_fn(|l| positive[l] || negative[l]);
        let over = Pack::constant(Interval::point(1.0)) / range;
        Self::select(&known, &self.bent(-k, [lo, hi], over), &Self::within(&Pack::constant(Interval::ENTIRE)))
    }

    /// About the slope of the secant of an increasing function over a range, at whose ends it has these values.
    fn secant(range: &Pack, lo: Lanes, hi: Lanes) -> Lanes {
        let width = Lanes(range.hi) - Lanes(range.lo);
        let slope = (hi - lo) / width;
        let is_slope = std::array::from_fn(|l| slope.0[l] >= 0.0 && slope.0[l].is_finite());
        Lanes::select(&is_slope, slope, Lanes::ZERO)
    }

    /// The same functions with slopes from c ± r. The range holds these too: what they need not be, but what quotients are between.
    fn sloped(&self) -> Slope<Pack, M> {
        let slope = each!(|k| Pack { lo: self.slope[k].0, hi: self.slope[k].0 });
        let (lo, hi) = ((self.centre - self.radius).down(), (self.centre + self.radius).up());
        let range = self.range();
        let both = Pack { lo: Lanes(range.lo).least(lo).0, hi: Lanes(range.hi).greatest(hi).0 };
        Slope { range: both, centre: Pack { lo: lo.0, hi: hi.0 }, slope }
    }

    /// Functions that have these slopes, and are in this range.
    fn of_slope(f: &Slope<Pack, M>, range: Pack) -> Self {
        let of_range = Self::within(&range);
        let mut form = Self::within(&f.centre);
        for k in 0..M {
            let slope = Affine::<0>::within(&f.slope[k]);
            form.slope[k] = slope.centre;
            form.radius = form.radius + slope.radius;
        }
        form.radius = form.radius.above();
        form.range = range;
        let is_flat: Mask =
            std::array::from_fn(|l| of_range.radius.0[l] <= form.radius.0[l] || form.radius.0[l].is_nan());
        Self::select(&is_flat, &of_range, &form)
    }
}

impl<const M: usize> Scalar for Affine<M> {
    fn constant(c: Interval) -> Self {
        Self::within(&Pack::constant(c))
    }

    #[inline(always)]
    fn square(self) -> Self {
        Self { range: self.range.square(), ..self * self }
    }

    /// The range cut by the affine form.
    #[inline(always)]
    fn tightened(self) -> Self {
        Self { range: self.range(), ..self }
    }

    /// Holds where f ≥ 0.
    ///
    /// With a = max(min f, 0), b = max f and k = 1/(√a + √b): √x − kx is least at a or b, and greatest at x = 1/(4k²): 1/(4k).
    fn sqrt(self) -> Self {
        let range = self.range();
        let a = Lanes(range.lo).greatest(Lanes::ZERO);
        let b = Lanes(range.hi).greatest(Lanes::of(UNDERFLOW));
        let (root_a, root_b) = (a.sqrt(), b.sqrt());
        let k = Lanes::of(1.0) / (root_a + root_b);
        let least = (root_a - k * a).least(root_b - k * b) - root_b * Lanes::of(ROUNDING);
        let greatest = (Lanes::of(0.25) / k).above();
        let over = range.sqrt();
        let root = self.bent(k, [least, greatest], over);
        // In a box in most of which there is no root the linear form is much wider than all roots.
        let (flat, width) = (Self::within(&over), root.spread() + root.radius);
        let is_flat = std::array::from_fn(|l| width.0[l] > 2.0 * flat.radius.0[l]);
        Self::select(&is_flat, &flat, &root)
    }

    fn sin_cos(self) -> (Self, Self) {
        let spread = (self.spread() + self.radius).above();
        let both: [[Curve; 2]; LANES] = std::array::from_fn(|l| Curve::turn(self.centre.0[l], spread.0[l]));
        let wave = |i: usize| {
            let of = |f: fn(&Curve) -> f64| Lanes(std::array::from_fn(|l| f(&both[l][i])));
            let still = Self { centre: Lanes::ZERO, ..self };
            let value = [of(|c| c.value.lo), of(|c| c.value.hi)];
            still.bent(of(|c| c.factor), value, Pack::from_fn(|l| both[l][i].over))
        };
        (wave(0), wave(1))
    }

    /// Between secant and corners: c(x) − kx is least and greatest at the ends of the range, at 0 or at 1.
    fn clamped(self) -> Self {
        let range = self.range();
        let value = range.clamped();
        let k = Self::secant(&range, Lanes(value.lo), Lanes(value.hi));
        let (lo, hi) = (Lanes(range.lo), Lanes(range.hi));
        let ends = [Lanes(value.lo) - k * lo, Lanes(value.hi) - k * hi];
        let corner = |x: f64, off: Lanes| {
            let is_within = std::array::from_fn(|l| lo.0[l] < x && x < hi.0[l]);
            Lanes::select(&is_within, off, ends[0])
        };
        let corners = [corner(0.0, Lanes::ZERO), corner(1.0, Lanes::of(1.0) - k)];
        let least = ends[0].least(ends[1]).least(corners[0]).least(corners[1]);
        let greatest = ends[0].greatest(ends[1]).greatest(corners[0]).greatest(corners[1]);
        let slack = (k * lo.abs().greatest(hi.abs()) + Lanes::of(1.0)) * Lanes::of(ROUNDING);
        self.bent(k, [least - slack, greatest + slack], value)
    }

    fn clamped_slope(self) -> Self {
        Self::within(&self.range().clamped_slope())
    }

    /// φ(x) − kx is convex, at least −k²/4 for 0 ≤ k ≤ 2, and greatest at an end of the range.
    fn clamped_square(self) -> Self {
        let range = self.range();
        let value = range.clamped_square();
        let k = Self::secant(&range, Lanes(value.lo), Lanes(value.hi)).least(Lanes::of(2.0));
        let (lo, hi) = (Lanes(range.lo), Lanes(range.hi));
        let size = (k + Lanes::of(2.0)) * lo.abs().greatest(hi.abs()) + Lanes::of(1.0);
        let slack = size * Lanes::of(ROUNDING);
        let greatest = (Lanes(value.lo) - k * lo).greatest(Lanes(value.hi) - k * hi) + slack;
        self.bent(k, [k * k * Lanes::of(-0.25) - slack, greatest], value)
    }

    /// g + (f − g)₊, and x₊ − kx is convex, 0 at 0 for 0 ≤ k ≤ 1, and greatest at an end of the range.
    fn greatest(self, other: Self) -> Self {
        let difference = self - other;
        let range = difference.range();
        let (lo, hi) = (Lanes(range.lo), Lanes(range.hi));
        let [below, above] = [lo, hi].map(|end| end.greatest(Lanes::ZERO));
        let k = Self::secant(&range, below, above).least(Lanes::of(1.0));
        let slack = lo.abs().greatest(hi.abs()) * Lanes::of(ROUNDING);
        let greatest = (below - k * lo).greatest(above - k * hi) + slack;
        let positive = difference.bent(k, [Lanes::ZERO - slack, greatest], Pack { lo: below.0, hi: above.0 });
        let sum = other + positive;
        let known = Self { range: self.range().greatest(other.range()), ..sum };
        Self::select(&range.positive(), &self, &Self::select(&range.negative(), &other, &known))
    }

    /// Where it may be either, half way between the two up to half of their difference.
    fn choose(self, yes: Self, no: Self) -> Self {
        let half = Lanes::of(0.5);
        let mut loose = (yes.centre - no.centre).abs();
        let mut size = yes.centre.abs() + no.centre.abs();
        for k in 0..M {
            loose = loose + (yes.slope[k] - no.slope[k]).abs();
            size = size + yes.slope[k].abs() + no.slope[k].abs();
        }
        let radius = yes.radius.greatest(no.radius) + half * loose + size * Lanes::of(ROUNDING);
        // Of two numbers of which one is none the other would be the greater.
        let unknown = (yes.radius + no.radius) * Lanes::ZERO;
        let either = Self {
            range: self.range().choose(yes.range(), no.range()),
            centre: (yes.centre + no.centre) * half,
            slope: axes!(|k| (yes.slope[k] + no.slope[k]) * half),
            radius: (radius + unknown).above(),
        };
        let range = self.range();
        Self::select(&range.positive(), &yes, &Self::select(&range.negative(), &no, &either))
    }

    fn nearest<const D: usize>(links: &TwoLinks<Self, D>) -> Nearest<Self> {
        Pack::nearest(&links.map(|x| x.range())).map(|range| Self::within(&range))
    }

    fn least_square<const D: usize>(links: &TwoLinks<Self, D>) -> Self {
        let range = Pack::least_square(&links.map(|x| x.range()));
        Self::of_slope(&Slope::least_square(&links.map(|x| x.sloped())), range)
    }

    #[inline(always)]
    fn zero() -> Self {
        let range = Pack { lo: [0.0; LANES], hi: [0.0; LANES] };
        Self { range, centre: Lanes::ZERO, slope: [Lanes::ZERO; M], radius: Lanes::ZERO }
    }

    #[inline(always)]
    fn scale(self, c: Interval) -> Self {
        if c == Interval::point(1.0) {
            return self;
        }
        let f = &self;
        let c = &c;
        kernel!({const M: usize} (f: &Affine<M>, c: &Interval) -> Affine<M> {
            f.scaled(&Pack::constant(*c), f.range.scale(*c))
        })
    }
}

impl<const M: usize> Neg for Affine<M> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            range: -self.range,
            centre: -self.centre,
            slope: axes!(|k| -self.slope[k]),
            radius: self.radius,
        }
    }
}

impl<const M: usize> Add for Affine<M> {
    type Output = Self;
    #[inline(always)]
    fn add(self, g: Self) -> Self {
        let (f, g) = (&self, &g);
        kernel!({const M: usize} (f: &Affine<M>, g: &Affine<M>) -> Affine<M> {
            let sum = Affine {
                range: f.range + g.range,
                centre: f.centre + g.centre,
                slope: axes!(|k| f.slope[k] + g.slope[k]),
                radius: f.radius,
            };
            let rounding = (sum.centre.abs() + sum.spread()) * Lanes::of(ROUNDING);
            Affine { radius: (f.radius + g.radius + rounding).above(), ..sum }
        })
    }
}

impl<const M: usize> Sub for Affine<M> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, g: Self) -> Self {
        self + -g
    }
}

impl<const M: usize> Mul for Affine<M> {
    type Output = Self;
    /// With a = Σ aₖtₖ and b likewise, ab = Σ aₖbₖ/2 up to Σᵢ|aᵢ| Σⱼ|bⱼ| − Σ|aₖbₖ|/2, because tₖ² = ½ ± ½.
    #[inline(always)]
    fn mul(self, g: Self) -> Self {
        let (f, g) = (&self, &g);
        kernel!({const M: usize} (f: &Affine<M>, g: &Affine<M>) -> Affine<M> {
            let (mut diagonal, mut size) = (Lanes::ZERO, Lanes::ZERO);
            for k in 0..M {
                let square = f.slope[k] * g.slope[k];
                diagonal = diagonal + square;
                size = size + square.abs();
            }
            let half = Lanes::of(0.5);
            let (a, b) = (f.spread(), g.spread());
            let (all_f, all_g) = (f.centre.abs() + a, g.centre.abs() + b);
            let bent = a * b - half * size;
            let error = bent + f.radius * (all_g + g.radius) + g.radius * all_f
                + all_f * all_g * Lanes::of(ROUNDING);
            Affine {
                range: f.range * g.range,
                centre: f.centre * g.centre + half * diagonal,
                slope: axes!(|k| f.centre * g.slope[k] + g.centre * f.slope[k]),
                radius: error.above() + Lanes::of(UNDERFLOW),
            }
        })
    }
}

impl<const M: usize> Div for Affine<M> {
    type Output = Self;
    fn div(self, g: Self) -> Self {
        self.mul(g.reciprocal())
    }
}
