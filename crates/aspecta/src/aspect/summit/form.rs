//! Functions over eight boxes.

use aspecta_robot::num::{Affine, Interval, Jet, Pack, each};

/// Affine forms over eight boxes, differentiated with respect to the coordinates that vary, scaled to [−1,
/// 1] in each box.
pub(super) type Form<const M: usize> = Jet<Affine<M>, M>;

/// Values and gradient of a function over eight boxes.
#[derive(Clone, Copy)]
pub(super) struct Field<const M: usize> {
    pub value: Pack,
    pub gradient: [Pack; M],
}

impl<const M: usize> Field<M> {
    pub(super) fn of(f: &Form<M>) -> Self {
        Self { value: f.value.range(), gradient: each!(|a| f.gradient[a].range()) }
    }

    pub(super) fn gradient_in(&self, lane: usize) -> [Interval; M] {
        self.gradient.map(|g| g.lane(lane))
    }
}
