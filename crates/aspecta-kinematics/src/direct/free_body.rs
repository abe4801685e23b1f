//! A free body on six legs: the Gough-Stewart problem, at most 40 poses.

mod closure;
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
///
/// Fewer are finite where a platform is special; the others are then found elsewhere in the closure of the
/// poses ([`elsewhere`]).
pub(super) const MOST: usize = 40;

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

pub(super) use closure::elsewhere;

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
}
