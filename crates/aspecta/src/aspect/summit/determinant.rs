//! det A over eight boxes.

use super::climb::Growth;
use super::frame::Frame;
use super::leg::LegPart;
use super::view::View;
use aspecta_kinematics::condition::Conditioner;
use aspecta_kinematics::constraints::{Constraint, Scale};
use aspecta_kinematics::placement::cofactors;
use aspecta_robot::WorkingMode;
use aspecta_robot::num::{Affine, Interval, Pack, Scalar, each};

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
        let mut rows: [[Affine<M>; N]; N] =
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
        let expanded = |j: usize, row: [&Affine<M>; N]| {
            (1..N).fold(minors[j][0] * *row[0], |sum, i| sum + minors[j][i] * *row[i])
        };
        let partial = |j: usize, row: [&Affine<M>; N]| match &by {
            Some(by) => expanded(j, by.row(&row.map(|x| *x)).each_ref()),
            None => expanded(j, row),
        };
        let range = |f: Affine<M>| by.as_ref().map_or(f.range(), |by| f.range() / by.det);
        let gradient: [Pack; M] = each!(|a| {
            let along = |j: usize| std::array::from_fn(|i| &part[j].rows[posture(j)][i].gradient[a]);
            let mut sum = partial(0, along(0));
            for j in 1..N {
                sum = sum + partial(j, along(j));
            }
            range(sum)
        });
        Self {
            value: range(det),
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
