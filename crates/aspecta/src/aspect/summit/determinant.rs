//! det A over eight boxes.

use super::climb::Growth;
use super::form::range;
use super::frame::Frame;
use super::leg::LegPart;
use super::view::View;
use aspecta_kinematics::condition::Conditioner;
use aspecta_kinematics::constraints::{Constraint, Scale};
use aspecta_kinematics::placement::cofactors;
use aspecta_robot::WorkingMode;
use aspecta_robot::num::{Interval, Mask, Pack, Scalar, Slope, each};

/// det A: it depends on every leg's s h.
pub(super) struct Determinant<const N: usize, const M: usize> {
    value: Pack,
    gradient: [Pack; M],
    own: [Pack; N],
}

impl<const N: usize, const M: usize> Determinant<N, M> {
    /// With the legs in a range of h each.
    pub(super) fn new<const D: usize>(
        view: &View<'_, D, N, M>,
        part: &[LegPart<N, M>],
        mode: WorkingMode,
    ) -> Self {
        let posture = |j: usize| usize::from(mode.sign(j) < 0);
        let mut rows: [[Slope<Pack, M>; N]; N] =
            std::array::from_fn(|j| each!(|i| part[j].rows[posture(j)][i].value));
        // det A = det(A Z) / det Z, for the derivatives too.
        let by = (N > 3).then(|| Conditioner::new(&rows));
        if let Some(by) = &by {
            rows = rows.map(|row| by.row(&row));
        }
        let mut minors = cofactors(&rows);
        for minor in minors.as_flattened_mut() {
            *minor = minor.tightened();
        }
        let mut det = rows[0][0] * minors[0][0];
        for i in 1..N {
            det = det + rows[0][i] * minors[0][i];
        }
        let expanded = |j: usize, row: [&Slope<Pack, M>; N]| {
            (1..N).fold(minors[j][0] * *row[0], |sum, i| sum + minors[j][i] * *row[i])
        };
        let partial = |j: usize, row: [&Slope<Pack, M>; N]| match &by {
            Some(by) => expanded(j, by.row(&row.map(|x| *x)).each_ref()),
            None => expanded(j, row),
        };
        let range = |f: Slope<Pack, M>| by.as_ref().map_or(range(f), |by| range(f) / by.det);
        let gradient: [Pack; M] = each!(|a| {
            let along = |j: usize| std::array::from_fn(|i| &part[j].rows[posture(j)][i].gradient[a]);
            let mut sum = partial(0, along(0));
            for j in 1..N {
                sum = sum + partial(j, along(j));
            }
            range(sum)
        });
        // The mean-value theorem, where the gradient is the whole of the derivative.
        let middle = by.as_ref().map_or(det.centre, |by| det.centre / by.det);
        let around = (0..M).fold(middle, |sum, a| sum + gradient[a].symmetric());
        let depends = |j: usize, l: usize| part[j].singular[l] && !view.parted[j];
        let whole: Mask = std::array::from_fn(|l| !(0..N).any(|j| depends(j, l)));
        let value = range(det);
        Self {
            value: Pack::select(&whole, value.meet(around), value),
            gradient,
            own: each!(|j| match view.rooted[j] && !view.parted[j] {
                true => range(partial(j, std::array::from_fn(|i| &view.rows[j].swing[i].value))),
                false => Pack::zero(),
            }),
        }
    }

    /// In one box.
    pub(super) fn growth(
        &self,
        frame: &Frame<N, M>,
        mode: WorkingMode,
        scale: &Scale,
        lane: usize,
    ) -> Growth<M> {
        let own: [_; N] = std::array::from_fn(|j| (j, f64::from(mode.sign(j)), self.own[j].lane(lane)));
        Growth {
            value: self.value.lane(lane) / Interval::point(scale[Constraint::Det]),
            along: frame.along(&self.gradient.map(|g| g.lane(lane)), &own),
        }
    }
}
