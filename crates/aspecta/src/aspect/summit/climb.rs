//! Whether a box has a direction in which all grows that may be the least there.

use super::MOST;
use super::pair::{LINES, Side};
use super::turns::{Place, are_impossible};
use super::way::Bounds;
use arrayvec::ArrayVec;
use aspecta_kinematics::constraints::{Joint, Turn};
use aspecta_robot::num::Interval;

/// A constraint over a box: its scaled values and its derivatives along the vectors of the frame.
#[derive(Clone, Copy)]
pub(super) struct Growth<const M: usize> {
    pub value: Interval,
    pub along: [Interval; M],
}

impl<const M: usize> Growth<M> {
    pub(super) fn signed(&self, sign: f64) -> Self {
        if sign > 0.0 { *self } else { Self { value: -self.value, along: self.along.map(|x| -x) } }
    }
}

/// Whether there is no summit in the box: for every choice of lines that part thin bodies, all grows along one direction that can be the
/// least.
///
/// P is the greatest over these choices of the least of the functions chosen. Where a choice attains P, P grows at least as that does. A choice
/// of turns that cannot be at once, those `known` of the class among them, is nowhere above zero.
pub(super) fn can_climb<const M: usize>(bounds: &Bounds<M>, det: Option<&Growth<M>>, known: &[Turn]) -> bool {
    match bounds.parted.is_empty() {
        true => can_climb_all(&bounds.all, det),
        false => choose((&bounds.all, known), &bounds.parted, det, &bounds.places),
    }
}

/// [`can_climb`] for every choice of the lines still to be chosen.
fn choose<const M: usize>(
    (chosen, turns): (&ArrayVec<Growth<M>, MOST>, &[Turn]),
    parted: &[ArrayVec<[Side<M>; 2], LINES>],
    det: Option<&Growth<M>>,
    places: &[(Joint, Place)],
) -> bool {
    let Some((first, others)) = parted.split_first() else { return can_climb_all(chosen, det) };
    first.iter().all(|line| {
        let turns: Vec<Turn> =
            turns.iter().copied().chain(line.iter().filter_map(|side| side.turn)).collect();
        if are_impossible(&turns, places) {
            return true;
        }
        let mut chosen = chosen.clone();
        let fits = line.iter().all(|side| chosen.try_push(side.growth).is_ok());
        fits && choose((&chosen, &turns), others, det, places)
    })
}

/// Whether some fixed combination of the frame makes every constraint grow that can be the least one in the
/// box.
fn can_climb_all<const M: usize>(common: &[Growth<M>], det: Option<&Growth<M>>) -> bool {
    let all = || common.iter().chain(det);
    let least = all().fold(f64::INFINITY, |least, g| least.min(g.value.hi));
    if least <= 0.0 {
        return true;
    }
    let active: ArrayVec<&[Interval; M], MOST> =
        all().filter(|g| g.value.lo <= least).map(|g| &g.along).take(MOST).collect();
    active.len() < MOST && !is_hopeless(&active) && (by_corrections(&active) || by_vertices(&active))
}

/// Most corrections of a direction.
const CORRECTIONS: usize = 60;

/// Whether no v can be found because one form may vanish, or two may be opposite: most boxes that are too
/// large are told so.
fn is_hopeless<const M: usize>(forms: &[&[Interval; M]]) -> bool {
    let vanishes = |form: &&[Interval; M]| form.iter().all(|x| x.contains(0.0));
    forms.iter().any(vanishes)
        || forms.iter().enumerate().any(|(i, a)| forms[..i].iter().any(|b| may_be_opposite(a, b)))
}

/// Whether α = −λβ for some α and β in two boxes and some λ > 0.
fn may_be_opposite<const M: usize>(a: &[Interval; M], b: &[Interval; M]) -> bool {
    let (mut least, mut most) = (0.0f64, f64::INFINITY);
    for (a, b) in a.iter().zip(b) {
        // a.lo ≤ −λ b.lo and −λ b.hi ≤ a.hi.
        for (factor, bound) in [(-b.lo, a.lo), (b.hi, -a.hi)] {
            match () {
                () if factor > 0.0 => least = least.max(bound / factor),
                () if factor < 0.0 => most = most.min(bound / factor),
                () if bound > 0.0 => return false,
                () => {}
            }
        }
    }
    least <= most && most > 0.0
}

/// The least value that v·γ takes for γ in a box.
fn least<const M: usize>(form: &[Interval; M], v: &[f64; M]) -> f64 {
    (0..M).fold(Interval::point(0.0), |sum, i| sum + form[i] * Interval::point(v[i])).lo
}

/// Whether there is a v with v·γ > 0 for every γ in every box of `forms`; sought by the perceptron's rule:
/// add the worst vector, until there is none.
fn by_corrections<const M: usize>(forms: &[&[Interval; M]]) -> bool {
    let weight = balance(forms);
    let mut v = [0.0; M];
    for form in forms {
        add(&mut v, &form.map(|i| i.mid()), &weight);
    }
    for _ in 0..CORRECTIONS {
        let Some(worst) = forms.iter().min_by(|a, b| least(a, &v).total_cmp(&least(b, &v))) else { break };
        if least(worst, &v) > 0.0 {
            return true;
        }
        let corner = std::array::from_fn(|i| if v[i] > 0.0 { worst[i].lo } else { worst[i].hi });
        if !add(&mut v, &corner, &weight) {
            return false;
        }
    }
    false
}

/// Whether such a direction is found among the vertices: as many forms as components of v are made equal to
/// their size, the other components are 0. A system with a solution has one of this kind, however different
/// the sizes of its coefficients are, on which corrections founder.
fn by_vertices<const M: usize>(forms: &[&[Interval; M]]) -> bool {
    let rows = 1u32 << forms.len().min(MOST_TIGHT);
    (1..rows).filter(|tight| tight.count_ones() as usize <= M).any(|tight| {
        let tight: ArrayVec<&[Interval; M], M> =
            (0..MOST_TIGHT).filter(|i| tight >> i & 1 == 1).map(|i| forms[i]).collect();
        (1u32..1 << M).filter(|free| free.count_ones() as usize == tight.len()).any(|free| {
            let free: ArrayVec<usize, M> = (0..M).filter(|k| free >> k & 1 == 1).collect();
            vertex(&tight, &free).is_some_and(|v| forms.iter().all(|form| least(form, &v) > 0.0))
        })
    })
}

/// Most forms that are tried for tightness.
const MOST_TIGHT: usize = 8;

/// v with the `free` components only, at which the worst values of the forms equal their sizes: first for the
/// middles of the forms, then for their corners in the orthant that v lies in.
fn vertex<const M: usize>(tight: &[&[Interval; M]], free: &[usize]) -> Option<[f64; M]> {
    let n = free.len();
    let size: ArrayVec<f64, M> =
        tight.iter().map(|form| form.iter().map(|x| x.magnitude()).fold(0.0, f64::max)).collect();
    let mut v = [0.0; M];
    for corners in [false, true] {
        let entry = |i: usize, k: usize| match tight[i][k] {
            x if !corners => x.mid(),
            x if v[k] > 0.0 => x.lo,
            x => x.hi,
        };
        let mut system = [[0.0; 4]; M];
        for i in 0..n {
            (0..n).for_each(|c| system[i][c] = entry(i, free[c]) / size[i]);
            system[i][3] = 1.0;
        }
        let solution = solve(&mut system[..n])?;
        (0..n).for_each(|c| v[free[c]] = solution[c]);
    }
    Some(v)
}

/// The solution of up to three linear equations, the right sides in the last column, by elimination.
fn solve(system: &mut [[f64; 4]]) -> Option<[f64; 3]> {
    let n = system.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| system[a][k].abs().total_cmp(&system[b][k].abs()))?;
        system.swap(k, pivot);
        let top = system[k];
        for row in system.iter_mut().skip(k + 1) {
            let factor = row[k] / top[k];
            (k..4).for_each(|c| row[c] -= factor * top[c]);
        }
    }
    let mut x = [0.0; 3];
    for k in (0..n).rev() {
        let sum: f64 = (k + 1..n).map(|c| system[k][c] * x[c]).sum();
        x[k] = (system[k][3] - sum) / system[k][k];
    }
    x.iter().all(|x| x.is_finite()).then_some(x)
}

/// Squared units of the vectors' lengths in which the derivatives along them are of like size: a vector along
/// which all change little is given more weight. The search alone depends on it.
fn balance<const M: usize>(forms: &[&[Interval; M]]) -> [f64; M] {
    let mut weight = [1.0f64; M];
    for _ in 0..3 {
        let mut largest = [0.0f64; M];
        for form in forms {
            let sized: [f64; M] = std::array::from_fn(|i| form[i].magnitude() * weight[i].sqrt());
            let most = sized.iter().copied().fold(0.0, f64::max);
            (0..M).for_each(|i| largest[i] = largest[i].max(sized[i] / most));
        }
        for i in 0..M {
            let scaled = weight[i] / largest[i].powi(2);
            weight[i] = if scaled.is_normal() { scaled } else { weight[i] };
        }
    }
    weight
}

/// Adds the unit vector along `w` in the metric of `weight`, if it has a direction.
fn add<const M: usize>(v: &mut [f64; M], w: &[f64; M], weight: &[f64; M]) -> bool {
    let length = (0..M).map(|i| w[i] * w[i] * weight[i]).sum::<f64>().sqrt();
    let fit = length.is_normal();
    if fit {
        (0..M).for_each(|i| v[i] += w[i] * weight[i] / length);
    }
    fit
}

#[cfg(test)]
mod tests {
    use super::*;

    fn forms(rows: &[[(f64, f64); 3]]) -> Vec<[Interval; 3]> {
        rows.iter().map(|row| row.map(|(lo, hi)| Interval::new(lo, hi))).collect()
    }

    fn found(rows: &[[(f64, f64); 3]]) -> [bool; 3] {
        let forms = forms(rows);
        let forms: Vec<&[Interval; 3]> = forms.iter().collect();
        [by_corrections(&forms), by_vertices(&forms), is_hopeless(&forms)]
    }

    /// Seen near a spherical robot's double serial singularity: derivatives along one vector are 10⁴ times
    /// those along another.
    #[test]
    fn vertices_are_found_where_corrections_founder() {
        let rows = [
            [(-9.557e-10, -9.546e-10), (-3.75e-16, 3.75e-16), (-2.323e-10, 0.0)],
            [(0.0, 0.0), (0.0, 0.0), (1.076e-5, 1.077e-5)],
            [(-1.516e-9, -1.44e-9), (-7.734e-11, 1.219e-10), (-1.925e-5, -1.895e-5)],
        ];
        assert_eq!(found(&rows), [false, true, false]);
    }

    #[test]
    fn nothing_is_found_where_there_is_nothing() {
        let opposite = [[(1.0, 1.1), (2.0, 2.2), (-1.0, -0.9)], [(-4.0, -3.0), (-8.0, -6.0), (2.0, 4.0)]];
        assert_eq!(found(&opposite), [false, false, true]);
        let vanishing = [[(-1.0, 1.0), (0.0, 2.0), (-3.0, 0.0)], [(1.0, 1.0), (0.0, 0.0), (0.0, 0.0)]];
        assert_eq!(found(&vanishing), [false, false, true]);
        // 0 is a combination of three, but of no two.
        let round = [
            [(1.0, 1.0), (0.0, 0.0), (0.0, 0.0)],
            [(-1.0, -1.0), (1.0, 1.0), (0.0, 0.0)],
            [(-1.0, -1.0), (-2.0, -2.0), (0.0, 0.0)],
        ];
        assert_eq!(found(&round), [false, false, false]);
        let apart = [[(1.0, 1.1), (2.0, 2.2), (-1.0, -0.9)], [(-4.0, -3.0), (-4.0, -3.0), (2.0, 4.0)]];
        assert_eq!(found(&apart), [true, true, false]);
    }
}
