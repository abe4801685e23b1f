//! One leg over eight boxes, with its h in a given range.

use super::form::Form;
use super::view::{Row, View};
use aspecta_robot::num::{Affine, Interval, Mask, Pack, Scalar, each};

/// The part of a leg's functions that depends on the range of h.
pub(super) struct LegPart<const N: usize, const M: usize> {
    /// The leg's row of A for both postures.
    pub rows: [[Form<M>; N]; 2],
    /// The range of h.
    pub height: Pack,
    /// The lanes in which the leg counts as singular, and its h as a variable of its own.
    pub singular: Mask,
}

impl<const N: usize, const M: usize> LegPart<N, M> {
    /// Leg j with h in `height`.
    pub(super) fn new<const D: usize>(
        view: &View<'_, D, N, M>,
        j: usize,
        height: Pack,
        singular: Mask,
    ) -> Self {
        let Row { fixed, swing, .. } = &view.rows[j];
        let rows = if view.rooted[j] {
            let h = if view.parted[j] {
                Form::constant(Interval::point(1.0))
            } else {
                view.height(j, height, &singular)
            };
            let swing: [Form<M>; N] = each!(|k| h * swing[k]);
            let up = each!(|k| (fixed[k] + swing[k]).tightened());
            [up, each!(|k| (fixed[k] - swing[k]).tightened())]
        } else {
            [*fixed; 2]
        };
        Self { rows, height, singular }
    }
}

impl<const D: usize, const N: usize, const M: usize> View<'_, D, N, M> {
    /// h of leg j: √H, or, where it counts as singular, a number in `height`.
    fn height(&self, j: usize, height: Pack, singular: &Mask) -> Form<M> {
        let smooth = &self.rows[j].smooth;
        // H need not be above zero at the centre: h's own slopes are of no use near a singularity.
        let own = match height == self.heights[j] {
            true => smooth.value,
            false => Affine::within(&height),
        };
        select(singular, &Form::fixed(own), smooth)
    }

    /// s h of leg j in both postures.
    pub(super) fn postures(&self, j: usize, part: &LegPart<N, M>) -> [Form<M>; 2] {
        if !self.rooted[j] {
            return self.legs[j].heights();
        }
        let h = self.height(j, part.height, &part.singular);
        [h, -h]
    }
}

/// Lane by lane, `yes` where the mask holds, else `no`.
fn select<const M: usize>(mask: &Mask, yes: &Form<M>, no: &Form<M>) -> Form<M> {
    Form {
        value: Affine::select(mask, &yes.value, &no.value),
        gradient: each!(|k| Affine::select(mask, &yes.gradient[k], &no.gradient[k])),
    }
}
