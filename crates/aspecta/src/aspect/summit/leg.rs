//! One leg over eight boxes, with its h in a given range.

use super::view::{Field, Form, View, range};
use aspecta_kinematics::limits::{LegAt, margin, unit};
use aspecta_kinematics::placement::Placement;
use aspecta_robot::Limit;
use aspecta_robot::num::{Jet, Mask, Pack, Scalar, Slope, each};

/// What depends on the range of h.
pub(super) struct LegPart<const N: usize, const M: usize> {
    /// The leg's row of A for both postures.
    pub rows: [[Form<M>; N]; 2],
    /// Per posture and limit: the margin.
    pub limits: [Vec<Limited<M>>; 2],
    /// The range of h.
    pub height: Pack,
    /// The lanes in which the leg counts as singular, and its h as a variable of its own.
    pub singular: Mask,
}

/// A limit's margin.
pub(super) struct Limited<const M: usize> {
    /// As a function of the pose, at fixed h if the leg is singular.
    pub field: Field<M>,
    /// Its derivative with respect to s h.
    pub own: Pack,
}

impl<const D: usize, const N: usize, const M: usize> View<'_, D, N, M> {
    /// Leg j with h in `height`.
    pub(super) fn leg(&self, j: usize, height: Pack, singular: Mask) -> LegPart<N, M> {
        let leg = &self.robot.legs[j];
        let fixed = self.fixed[j];
        let (heights, rows) = if self.rooted[j] {
            let h = self.height(j, height, &singular);
            let swing: [Form<M>; N] = each!(|k| h * self.swing[j][k]);
            let up = each!(|k| (fixed[k] + swing[k]).tightened());
            ([h, -h], [up, each!(|k| (fixed[k] - swing[k]).tightened())])
        } else {
            (self.legs[j].heights(), [fixed; 2])
        };
        let limits = match leg.limits.as_slice() {
            [] => Default::default(),
            limits => {
                let at = self.legs[j].limited(leg);
                let limited = |sh, limit| Limited::new(limit, &at, sh, &self.placement);
                heights.map(|sh| limits.iter().map(|limit| limited(sh, limit)).collect())
            }
        };
        LegPart { rows, limits, height, singular }
    }

    /// h of leg j: √H, or, where it counts as singular, a number in `height`.
    fn height(&self, j: usize, height: Pack, singular: &Mask) -> Form<M> {
        let smooth = self.smooth[j];
        // H need not be above zero at the centre: h's own slopes are of no use near a singularity.
        let own = match height == self.heights[j] {
            true => smooth.value,
            false => Slope { range: height, centre: height, slope: [Pack::zero(); M] },
        };
        select(singular, &Form::fixed(own), &smooth)
    }
}

impl<const M: usize> Limited<M> {
    fn new<const D: usize>(
        limit: &Limit,
        at: &LegAt<'_, Form<M>, D>,
        sh: Form<M>,
        placement: &Placement<Form<M>, D>,
    ) -> Self {
        let inside = margin(limit, at, sh, placement) / unit(limit, at, sh);
        let still = |f: Form<M>| Jet::<_, 1>::fixed(f.value);
        let (at, placement, sh) = (at.map(still), placement.map(still), Jet::variable(sh.value, 0));
        let moved = margin(limit, &at, sh, &placement) / unit(limit, &at, sh);
        Self { field: Field::of(&inside), own: range(moved.gradient[0]) }
    }
}

/// Lane by lane, `yes` where the mask holds, else `no`.
fn select<const M: usize>(mask: &Mask, yes: &Form<M>, no: &Form<M>) -> Form<M> {
    let slope = |yes: &Slope<Pack, M>, no: &Slope<Pack, M>| Slope {
        range: Pack::select(mask, yes.range, no.range),
        centre: Pack::select(mask, yes.centre, no.centre),
        slope: each!(|k| Pack::select(mask, yes.slope[k], no.slope[k])),
    };
    Form {
        value: slope(&yes.value, &no.value),
        gradient: each!(|k| slope(&yes.gradient[k], &no.gradient[k])),
    }
}
