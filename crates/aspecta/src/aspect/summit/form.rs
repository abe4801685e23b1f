//! Functions over eight boxes.

use aspecta_robot::num::{Interval, Jet, Pack, Scalar, Slope, each};

/// Centred forms over eight boxes, differentiated with respect to the coordinates that vary, scaled to [−1,
/// 1] in each box.
pub(super) type Form<const M: usize> = Jet<Slope<Pack, M>, M>;

/// Values and gradient of a function over eight boxes.
#[derive(Clone, Copy)]
pub(super) struct Field<const M: usize> {
    pub value: Pack,
    pub gradient: [Pack; M],
}

impl<const M: usize> Field<M> {
    pub(super) fn of(f: &Form<M>) -> Self {
        Self { value: range(f.value), gradient: each!(|a| range(f.gradient[a])) }
    }

    pub(super) fn gradient_in(&self, lane: usize) -> [Interval; M] {
        self.gradient.map(|g| g.lane(lane))
    }
}

/// The range of a function.
pub(super) fn range<const M: usize>(f: Slope<Pack, M>) -> Pack {
    f.tightened().range
}
