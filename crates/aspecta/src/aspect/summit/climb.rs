//! Whether a box has a direction in which all grows that may be the least there.

use super::MOST;
use crate::num::Interval;
use arrayvec::ArrayVec;

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

/// Whether some fixed combination of the frame makes every constraint grow that can be the least one in the box.
pub(super) fn can_climb<const M: usize>(common: &[Growth<M>], det: &Growth<M>) -> bool {
    let all = || common.iter().chain([det]);
    let least = all().fold(f64::INFINITY, |least, g| least.min(g.value.hi));
    if least <= 0.0 {
        return true;
    }
    let active: ArrayVec<&[Interval; M], MOST> =
        all().filter(|g| g.value.lo <= least).map(|g| &g.along).take(MOST).collect();
    active.len() < MOST && direction(&active).is_some()
}

/// Most corrections of a direction.
const CORRECTIONS: usize = 60;

/// v with v·γ > 0 for every γ in every box of `forms`, found by the perceptron's rule: add the worst vector, until there is none.
fn direction<const M: usize>(forms: &[&[Interval; M]]) -> Option<[f64; M]> {
    let weight = balance(forms);
    let mut v = [0.0; M];
    for form in forms {
        add(&mut v, &form.map(|i| i.mid()), &weight);
    }
    for _ in 0..CORRECTIONS {
        let value = |form: &[Interval; M]| {
            (0..M).fold(Interval::point(0.0), |sum, i| sum + form[i] * Interval::point(v[i]))
        };
        let worst = forms.iter().min_by(|a, b| value(a).lo.total_cmp(&value(b).lo))?;
        if value(worst).is_positive() {
            return Some(v);
        }
        let corner = std::array::from_fn(|i| if v[i] > 0.0 { worst[i].lo } else { worst[i].hi });
        if !add(&mut v, &corner, &weight) {
            return None;
        }
    }
    None
}

/// Squared units of the vectors' lengths in which the derivatives along them are of like size: a vector along which all change
/// little is given more weight. The search alone depends on it.
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
