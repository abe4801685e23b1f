//! The points of two links that are nearest to one another.

use super::{Interval, Scalar, dot, each};

/// Two links, the points first + u e and second + v e′, u, v ∈ [0, 1].
#[derive(Clone, Copy, Debug)]
pub struct TwoLinks<T, const D: usize> {
    /// From where the second starts to where the first does.
    pub gap: [T; D],
    /// e.
    pub first: [T; D],
    /// e′.
    pub second: [T; D],
}

/// The (u, v) at which two links are nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest<T> {
    /// u.
    pub first: T,
    /// v.
    pub second: T,
}

impl<T> Nearest<T> {
    /// In another scalar.
    pub fn map<U>(self, to: impl Fn(T) -> U) -> Nearest<U> {
        Nearest { first: to(self.first), second: to(self.second) }
    }
}

impl<T: Scalar, const D: usize> TwoLinks<T, D> {
    /// In another scalar.
    pub fn map<U: Scalar>(&self, to: impl Fn(T) -> U) -> TwoLinks<U, D> {
        let vector = |v: &[T; D]| each!(|k| to(v[k]));
        TwoLinks { gap: vector(&self.gap), first: vector(&self.first), second: vector(&self.second) }
    }

    /// From a point of the second link to one of the first.
    pub fn between(&self, at: &Nearest<T>) -> [T; D] {
        each!(|k| self.gap[k] + at.first * self.first[k] - at.second * self.second[k])
    }

    fn products(&self) -> Products<T> {
        Products {
            first: dot(&self.first, &self.first),
            both: dot(&self.first, &self.second),
            second: dot(&self.second, &self.second),
            along_first: dot(&self.first, &self.gap),
            along_second: dot(&self.second, &self.gap),
        }
    }
}

/// What ‖gap + u e − v e′‖² is made of.
struct Products<T> {
    /// e·e.
    first: T,
    /// e·e′.
    both: T,
    /// e′·e′.
    second: T,
    /// e·gap.
    along_first: T,
    /// e′·gap.
    along_second: T,
}

impl Products<Interval> {
    /// The v that are best for these u.
    fn second_for(&self, u: Interval) -> Interval {
        if self.second.contains(0.0) {
            return Interval::new(0.0, 1.0);
        }
        ((u * self.both + self.along_second) / self.second).clamped()
    }

    /// The u that are best for these v.
    fn first_for(&self, v: Interval) -> Interval {
        if self.first.contains(0.0) {
            return Interval::new(0.0, 1.0);
        }
        ((v * self.both - self.along_first) / self.first).clamped()
    }

    /// Half the derivative by u of the least value over v.
    fn slope(&self, u: f64) -> Interval {
        let u = Interval::point(u);
        self.along_first + u * self.first - self.both * self.second_for(u)
    }
}

/// Halvings of the range of u from either end.
const HALVINGS: usize = 8;
/// How often it is then narrowed by what is best for the other link.
const NARROWINGS: usize = 3;

impl<const D: usize> TwoLinks<Interval, D> {
    /// The least value over v is convex in u: where its derivative is surely positive the nearest points lie before, where it is negative after.
    pub(super) fn nearest_enclosed(&self) -> Nearest<Interval> {
        let products = self.products();
        let before = |u: f64| products.slope(u).is_positive();
        let after = |u: f64| products.slope(u).is_negative();
        let first = match () {
            () if before(0.0) => Interval::point(0.0),
            () if after(1.0) => Interval::point(1.0),
            () => {
                let (mut lo, mut hi, mut outer) = (0.0, 1.0, [1.0, 0.0]);
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (lo + outer[0]);
                    if after(middle) {
                        lo = middle
                    } else {
                        outer[0] = middle
                    }
                    let middle = 0.5 * (hi + outer[1]);
                    if before(middle) { hi = middle } else { outer[1] = middle }
                }
                Interval::new(lo, hi)
            }
        };
        let mut first = first;
        for _ in 0..NARROWINGS {
            first = products.first_for(products.second_for(first)).meet(first);
        }
        // A link without length is one point.
        let none = |length: Interval, at: Interval| if length.hi == 0.0 { Interval::point(0.0) } else { at };
        Nearest {
            first: none(products.first, first),
            second: none(products.second, products.second_for(first)),
        }
    }
}

impl<const D: usize> TwoLinks<Interval, D> {
    /// The square of the distance is convex in (u, v): a tangent plane is below it, best where it is about level; and any (u, v) has no less than
    /// the least.
    pub(super) fn least_square_enclosed(&self) -> Interval {
        let all = self.nearest_enclosed();
        let at = self.map(Interval::mid).nearest_numbers().map(Interval::point);
        let between = self.between(&at);
        let square = (1..D).fold(between[0].square(), |sum, k| sum + between[k].square());
        let slopes = [dot(&between, &self.first), -dot(&between, &self.second)];
        let ways = [all.first - at.first, all.second - at.second];
        let way = slopes.iter().zip(ways).fold(Interval::point(0.0), |sum, (slope, way)| sum + *slope * way);
        let tangent = square + way + way;
        Interval { lo: tangent.lo.max(0.0).min(square.hi), hi: square.hi }
    }
}

impl<const D: usize> TwoLinks<f64, D> {
    /// Of the lines, then of the links: Ericson, Real-Time Collision Detection, 5.1.9.
    pub(super) fn nearest_numbers(&self) -> Nearest<f64> {
        let Products { first, both, second, along_first, along_second } = self.products();
        let ratio = |a: f64, b: f64| if b > 0.0 { (a / b).clamp(0.0, 1.0) } else { 0.0 };
        let parallel = first * second - both * both;
        let u = ratio(both * along_second - second * along_first, parallel);
        let v = ratio(u * both + along_second, second);
        Nearest { first: ratio(v * both - along_first, first), second: v }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::{Jet, Random, Slope};

    fn links(random: &mut Random) -> TwoLinks<f64, 3> {
        let mut vector = |size: f64| std::array::from_fn(|_| random.within((-size, size)));
        TwoLinks { gap: vector(1.0), first: vector(1.5), second: vector(1.5) }
    }

    /// By a search over the square that knows nothing of derivatives.
    fn least_by_search(links: &TwoLinks<f64, 3>) -> f64 {
        let square = |first: f64, second: f64| {
            let v = links.between(&Nearest { first, second });
            dot(&v, &v)
        };
        let (mut best, mut width) = ([0.5, 0.5], 0.5);
        for _ in 0..60 {
            let near = |k: usize, i: i32| (best[k] + width * f64::from(i) / 4.0).clamp(0.0, 1.0);
            let all = (-4..=4).flat_map(|i| (-4..=4).map(move |j| (i, j)));
            let all = all.map(|(i, j)| [near(0, i), near(1, j)]);
            best = all.min_by(|a, b| square(a[0], a[1]).total_cmp(&square(b[0], b[1]))).unwrap();
            width *= 0.6;
        }
        square(best[0], best[1])
    }

    #[test]
    fn the_least_distance_is_that_of_a_search() {
        let random = &mut Random::new(4);
        for i in 0..2000 {
            let mut links = links(random);
            if i % 10 == 0 {
                links.second = links.first.map(|x| -0.7 * x);
            }
            let (found, wanted) = (f64::least_square(&links), least_by_search(&links));
            assert!((found - wanted).abs() < 1e-9, "{links:?}: {found} {wanted}");
        }
    }

    /// Ranges, centred forms and derivatives hold what numbers are.
    #[test]
    fn enclosures_hold_the_least_distance() {
        let random = &mut Random::new(9);
        for _ in 0..2000 {
            let middle = links(random);
            let size = 10f64.powf(random.within((-6.0, -0.5)));
            let direction = links(random);
            let at = |t: f64| {
                let moved = |a: &[f64; 3], b: &[f64; 3]| std::array::from_fn(|k| a[k] + t * size * b[k]);
                TwoLinks {
                    gap: moved(&middle.gap, &direction.gap),
                    first: moved(&middle.first, &direction.first),
                    second: moved(&middle.second, &direction.second),
                }
            };
            let t = random.within((-1.0, 1.0));
            let exact = f64::least_square(&at(t));
            let along = |a: &[f64; 3], b: &[f64; 3]| -> [Slope<Interval, 1>; 3] {
                std::array::from_fn(|k| {
                    let (centre, reach) = (Interval::point(a[k]), Interval::point(size * b[k]));
                    Slope { range: centre + Interval::new(-1.0, 1.0) * reach, centre, slope: [reach] }
                })
            };
            let over = TwoLinks {
                gap: along(&middle.gap, &direction.gap),
                first: along(&middle.first, &direction.first),
                second: along(&middle.second, &direction.second),
            };
            let form = Slope::least_square(&over);
            let linear = form.centre + form.slope[0] * Interval::point(t);
            for range in [form.range, linear, form.tightened().range] {
                assert!(range.lo - 1e-12 <= exact && exact <= range.hi + 1e-12, "{range} {exact}");
            }
            // Numbers differ by what rounding makes of the nearest points.
            let jet = |t: f64| {
                let at = at(t);
                let one = |a: &[f64; 3], b: &[f64; 3]| -> [Jet<f64, 1>; 3] {
                    std::array::from_fn(|k| Jet { value: a[k], gradient: [size * b[k]] })
                };
                Jet::least_square(&TwoLinks {
                    gap: one(&at.gap, &direction.gap),
                    first: one(&at.first, &direction.first),
                    second: one(&at.second, &direction.second),
                })
            };
            let (slope, h) = (jet(t).gradient[0], 1e-4);
            let quotient = (f64::least_square(&at(t + h)) - f64::least_square(&at(t - h))) / (2.0 * h);
            assert!((slope - quotient).abs() < 1e-3 * size.max(1e-3), "{slope} {quotient}");
        }
    }

    /// Of links that are known the distance is too, to rounding.
    #[test]
    fn numbers_are_enclosed_tightly() {
        let random = &mut Random::new(5);
        for _ in 0..2000 {
            let links = links(random);
            let range = Interval::least_square(&links.map(Interval::point));
            assert!(range.width() < 1e-12 && range.contains(f64::least_square(&links)), "{range} {links:?}");
        }
    }

    #[test]
    fn the_greater_is_enclosed() {
        let random = &mut Random::new(3);
        for _ in 0..2000 {
            let mut line = || {
                let (a, b) = (random.within((-1.0, 1.0)), random.within((-1.0, 1.0)));
                let (centre, reach) = (Interval::point(a), Interval::point(b));
                let range = centre + Interval::new(-1.0, 1.0) * reach;
                (move |t: f64| a + b * t, Slope::<Interval, 1> { range, centre, slope: [reach] })
            };
            let ((f, f_over), (g, g_over)) = (line(), line());
            let t = random.within((-1.0, 1.0));
            let over = f_over.greatest(g_over);
            let linear = over.centre + over.slope[0] * Interval::point(t);
            let exact = f(t).max(g(t));
            for range in [over.range, linear] {
                assert!(range.lo - 1e-12 <= exact && exact <= range.hi + 1e-12, "{range} {exact}");
            }
            let other = f_over.least(g_over);
            assert!(other.range.lo - 1e-12 <= f(t).min(g(t)) && f(t).min(g(t)) <= other.range.hi + 1e-12);
        }
    }
}
