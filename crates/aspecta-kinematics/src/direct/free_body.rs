//! A free body on six legs: the Gough-Stewart problem, at most 40 poses.

mod start;

use super::locked::Locked;
use super::projective::{Problem, turned_product};
use aspecta_robot::num::{Interval, Scalar};

/// In Study parameters (e, g), e · g = 0, the pose is R = R(e), p = vec(g ē) / ‖e‖². The leg equation
/// ‖p + R c − P‖² = ρ² times ‖e‖² is the quadratic form
///
/// > ‖g‖² + (‖c‖² + ‖P‖² − ρ²) ‖e‖² − 2 P · N(e) c + 2 (c − P) · (e₀ γ − g₀ ε) − 2 (c + P) · (ε × γ)
///
/// with ε, γ the vector parts of e, g (Husty 1996).
///
/// It is linear in 1, ‖p‖², p, Rᵀp and R: the poses are the points of a linear section of codimension six of
/// a variety of dimension six and degree 40 in P¹⁶ (Gallet, Nawratil & Schicho 2015; the number 40 is Ronga &
/// Vust's and Mourrain's, 1992 to 1996). So there are at most 40 isolated ones, complex ones included
/// (Fulton, 12.3.1), and when 40 are proved there is nothing else.
const MOST: usize = 40;

/// With the legs joined in three pairs, by the joints of the platform or by those of the base, at most 16.
///
/// Each joint C of a pair is on two spheres, a conic of P³ on which ‖C‖² is linear; so the three distances
/// between joints are bilinear, and three conics times three divisors of bidegree (1, 1) in (P³)³ have 2³ · 2
/// isolated points at most (Fulton, 12.3.1). Three joints that are not in line make one pose. For pairs at
/// the base, swap base and platform.
const MOST_IN_PAIRS: usize = 16;

/// An upper bound of the number of isolated poses. Joints whose coordinates are written alike in a robot file
/// are taken for one; ends of cranks and sliders are not, for each is known within the rounding of its own q.
pub(super) fn most(legs: &[Locked]) -> usize {
    let paired = |joint: fn(&Locked) -> &[Interval; 3]| {
        let written = |x: &Interval| x.width() <= Interval::decimal(x.mid()).width();
        let one =
            |j: usize, k: usize| joint(&legs[j]) == joint(&legs[k]) && joint(&legs[j]).iter().all(written);
        let alike = |k: usize| (0..legs.len()).filter(|&j| one(j, k)).count();
        let mut corners = (0..legs.len()).filter(|&k| (0..k).all(|j| joint(&legs[j]) != joint(&legs[k])));
        let corners = [corners.next(), corners.next(), corners.next()].map(|k| joint(&legs[k.unwrap_or(0)]));
        (0..legs.len()).all(|k| alike(k) == 2) && !in_line(corners)
    };
    if paired(|l| &l.leg.attachment) || paired(|l| &l.leg.anchor) { MOST_IN_PAIRS } else { MOST }
}

/// Whether three points cannot be proved not to lie in line.
fn in_line([a, b, c]: [&[Interval; 3]; 3]) -> bool {
    let edge = |to: &[Interval; 3], k: usize| to[k] - a[k];
    (0..3).all(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        (edge(b, i) * edge(c, j) - edge(b, j) * edge(c, i)).contains(0.0)
    })
}

/// The units and origins in which coordinates are of order one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Normalised {
    /// A point amid the ends P of the locked legs.
    base: [f64; 3],
    /// A point of the platform amid the joints c.
    platform: [f64; 3],
    /// A power of two.
    unit: f64,
}

impl Normalised {
    fn of(legs: &[Locked]) -> Self {
        let mean = |of: fn(&Locked) -> &[Interval; 3]| -> [f64; 3] {
            std::array::from_fn(|k| legs.iter().map(|l| of(l)[k].mid()).sum::<f64>() / legs.len() as f64)
        };
        let (base, platform) = (mean(|l| &l.leg.anchor), mean(|l| &l.leg.attachment));
        let spread = |l: &Locked| {
            let off =
                |v: &[Interval; 3], o: &[f64; 3]| (0..3).map(|k| (v[k].mid() - o[k]).powi(2)).sum::<f64>();
            off(&l.leg.anchor, &base) + off(&l.leg.attachment, &platform) + l.q.mid().powi(2)
        };
        let size = (legs.iter().map(spread).sum::<f64>() / (3.0 * legs.len() as f64)).sqrt();
        let unit = if size.is_normal() { size.log2().round().exp2() } else { 1.0 };
        Self { base, platform, unit }
    }

    fn form(&self, locked: &Locked) -> [[Interval; 8]; 8] {
        let scale = Interval::point(1.0 / self.unit);
        let from = |v: &[Interval; 3], o: &[f64; 3]| -> [Interval; 3] {
            std::array::from_fn(|k| (v[k] - Interval::point(o[k])) * scale)
        };
        let c = from(&locked.leg.attachment, &self.platform);
        let p = from(&locked.leg.anchor, &self.base);
        let square = |v: &[Interval; 3]| v[0].square() + v[1].square() + v[2].square();
        let constant = square(&c) + square(&p) - (locked.q * scale).square();
        let product = turned_product(&p, &c);
        let mut m = [[Interval::point(0.0); 8]; 8];
        for i in 0..4 {
            for j in 0..4 {
                m[i][j] = -(product[i][j] + product[i][j]);
            }
            m[i][i] = m[i][i] + constant;
            m[i + 4][i + 4] = Interval::point(1.0);
        }
        // The mixed part, half of it on either side of the diagonal.
        let mut mixed = |e: usize, g: usize, value: Interval| (m[e][g + 4], m[g + 4][e]) = (value, value);
        for k in 0..3 {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            mixed(0, k + 1, c[k] - p[k]);
            mixed(k + 1, 0, p[k] - c[k]);
            mixed(i + 1, j + 1, -(c[k] + p[k]));
            mixed(j + 1, i + 1, c[k] + p[k]);
        }
        m
    }

    /// The position of the platform's origin, from the rotation and Study's g.
    pub fn position(&self, e: [f64; 4], g: [f64; 4], rotation: &[[f64; 3]; 3]) -> [f64; 3] {
        let norm = e.iter().map(|x| x * x).sum::<f64>();
        let cross = |k: usize| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            e[i + 1] * g[j + 1] - e[j + 1] * g[i + 1]
        };
        std::array::from_fn(|k| {
            let p = (e[0] * g[k + 1] - g[0] * e[k + 1] + cross(k)) / norm * self.unit;
            let arm: f64 = (0..3).map(|j| rotation[k][j] * self.platform[j]).sum();
            p - arm + self.base[k]
        })
    }
}

pub(super) fn problem(legs: &[Locked]) -> (Problem<'static, 8, 7>, Normalised) {
    let (forms, units) = forms(legs);
    (Problem::new(start::system(), start::points(), forms), units)
}

/// The forms of six legs, and Study's.
fn forms(legs: &[Locked]) -> ([[[Interval; 8]; 8]; 7], Normalised) {
    let units = Normalised::of(legs);
    (std::array::from_fn(|k| legs.get(k).map_or_else(study, |leg| units.form(leg))), units)
}

/// 2 e · g, which is zero on all poses.
fn study() -> [[Interval; 8]; 8] {
    let one = |i: usize, j: usize| Interval::point(if i.abs_diff(j) == 4 { 1.0 } else { 0.0 });
    std::array::from_fn(|i| std::array::from_fn(|j| one(i, j)))
}

#[cfg(test)]
mod tests {
    use super::super::projective::Point;
    use super::*;
    use aspecta_robot::Leg;

    /// Struts whose platform joints meet in pairs.
    fn pairs() -> Vec<Locked> {
        let leg = |k: usize| {
            let mut leg = Leg::strut([k as f64, 0.3], [0.0, 0.0]);
            leg.attachment =
                [[0.1, 0.2, 0.0], [0.7, 0.3, 0.0], [0.4, 0.9, 0.1]][k / 2].map(Interval::decimal);
            Locked::new::<3>(&leg, 1.0)
        };
        (0..6).map(leg).collect()
    }

    /// A path that is left out, or followed twice, is a solution that is not counted: with Dietmaier's 40
    /// real ones no conjugate makes up for it.
    #[test]
    fn with_a_solution_less_nothing_is_complete() {
        let robot = aspecta_robot::catalogue::find("gough-stewart").unwrap();
        let q = [1.0, 0.645275, 1.086284, 1.503439, 1.281933, 0.771071];
        let legs: Vec<Locked> = robot.legs.iter().zip(q).map(|(leg, q)| Locked::new::<3>(leg, q)).collect();
        let proved = |starts: &[Point<8>]| {
            let problem = Problem::new(start::system(), starts, forms(&legs).0);
            problem.prove(&problem.solve()).iter().flatten().count()
        };
        let all = start::points();
        assert_eq!(proved(all), MOST);
        assert_eq!(proved(&all[1..]), MOST - 1);
        let twice: Vec<_> = all[1..].iter().chain(&all[1..2]).copied().collect();
        assert_eq!(proved(&twice), MOST - 1);
    }

    #[test]
    fn only_joints_that_are_written_alike_are_one() {
        assert_eq!(most(&pairs()), MOST_IN_PAIRS);
        let mut swapped = pairs();
        swapped.iter_mut().for_each(|l| std::mem::swap(&mut l.leg.anchor, &mut l.leg.attachment));
        assert_eq!(most(&swapped), MOST_IN_PAIRS);
        let mut rounded = swapped.clone();
        let ulps = Interval::new(-1e-15, 1e-15);
        rounded.iter_mut().for_each(|l| l.leg.anchor[0] = l.leg.anchor[0] + ulps);
        assert_eq!(most(&rounded), MOST);
        let mut in_line = pairs();
        in_line.iter_mut().enumerate().for_each(|(k, l)| {
            l.leg.attachment = [1.0, 2.0, 3.0].map(|x| Interval::point(x * (k / 2) as f64))
        });
        assert_eq!(most(&in_line), MOST);
    }
}
