//! A direction in which several functions grow.

use crate::num::Interval;

/// Most corrections of a direction.
const CORRECTIONS: usize = 40;

/// Whether some fixed v has v·γ > 0 for every γ in each of the boxes `growth`. How v is found does not matter: it is checked.
pub(super) fn climbable(growth: &[Vec<Interval>]) -> bool {
    let Some(count) = growth.first().map(Vec::len) else { return false };
    let size: Vec<f64> = (0..count)
        .map(|i| growth.iter().map(|g| g[i].magnitude()).fold(0.0, f64::max))
        .map(|x| if x.is_normal() { x } else { 1.0 })
        .collect();
    let worst_of = |v: &[f64]| {
        let value = |g: &Vec<Interval>| {
            let terms = g.iter().zip(v).map(|(g, v)| *g * Interval::point(*v));
            terms.fold(Interval::point(0.0), |sum, term| sum + term)
        };
        growth.iter().map(|g| (value(g).lo, g)).min_by(|a, b| a.0.total_cmp(&b.0))
    };
    // The perceptron's rule, in units in which the components are alike: add the worst vector until there is none.
    let mut v = vec![0.0; count];
    let add = |v: &mut Vec<f64>, towards: &dyn Fn(usize) -> f64| {
        let scaled: Vec<f64> = (0..count).map(|i| towards(i) / size[i]).collect();
        let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length.is_normal() {
            (0..count).for_each(|i| v[i] += scaled[i] / length / size[i]);
        }
    };
    for g in growth {
        add(&mut v, &|i| g[i].mid());
    }
    for _ in 0..CORRECTIONS {
        let Some((least, worst)) = worst_of(&v) else { return false };
        if least > 0.0 {
            return true;
        }
        let before = v.clone();
        add(&mut v, &|i| if before[i] > 0.0 { worst[i].lo } else { worst[i].hi });
    }
    false
}
