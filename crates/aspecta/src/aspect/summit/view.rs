//! The robot over eight boxes, with derivatives that stay bounded at serial singularities.

use super::MOST;
use super::climb::Growth;
use super::frame::Frame;
use crate::aspect::scale::Scale;
use crate::kinematics::WorkingMode;
use crate::kinematics::condition::Conditioner;
use crate::kinematics::limits::{margin, unit};
use crate::kinematics::modal::LegClosure;
use crate::kinematics::placement::{Placement, cofactors, out_of_frame, wrench};
use crate::num::{Interval, Jet, LANES, Mask, Pack, Scalar, Slope, each};
use crate::paving::Paving;
use crate::robot::Robot;
use arrayvec::ArrayVec;

/// Centred forms over eight boxes, differentiated with respect to the coordinates that vary (at most three, scaled to [−1, 1] in
/// each box) and, fourth, to the s h of the one singular leg it depends on.
type Form<const M: usize> = Jet<Slope<Pack, M>, 4>;

/// The place of s h among the derivatives.
const OWN: usize = 3;

/// The robot over eight boxes.
pub(super) struct View<'a, const D: usize, const N: usize, const M: usize> {
    pub paving: &'a Paving,
    boxes: [u32; LANES],
    placement: Placement<Form<M>, D>,
    legs: [LegClosure<Form<M>, D>; N],
    /// H_j and its gradient.
    pub reach: [Field<M>; N],
    /// The range of h_j.
    pub heights: [Pack; N],
    /// The parts of ∂f/∂d: fixed + s h swing.
    fixed: [[Form<M>; D]; N],
    swing: [[Form<M>; D]; N],
    /// Which legs have a serial singularity with a root in it.
    pub rooted: [bool; N],
    /// Lanes in which every row of A is bounded.
    pub usable: Mask,
}

/// What depends on the range of h too.
pub(super) struct Part<const N: usize, const M: usize> {
    /// Rows of A for both postures.
    rows: [[[Form<M>; N]; 2]; N],
    /// Per leg, posture and limit: the margin.
    limits: [[Vec<Limited<M>>; 2]; N],
    pub heights: [Pack; N],
    /// Per leg: the lanes in which it counts as singular, and its h as a variable of its own.
    pub singular: [Mask; N],
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

/// Values and gradient of a function over eight boxes.
#[derive(Clone, Copy)]
pub(super) struct Field<const M: usize> {
    pub value: Pack,
    gradient: [Pack; M],
}

impl<const N: usize, const M: usize> Determinant<N, M> {
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
            value: self.value.lane(lane) / Interval::point(scale.det),
            along: frame.along(&self.gradient.map(|g| g.lane(lane)), &own),
        }
    }
}

/// A limit's margin: it depends on its leg's s h too.
struct Limited<const M: usize> {
    field: Field<M>,
    own: Pack,
}

/// det A: it depends on every leg's s h.
pub(super) struct Determinant<const N: usize, const M: usize> {
    value: Pack,
    gradient: [Pack; M],
    own: [Pack; N],
}

fn range<const M: usize>(f: Slope<Pack, M>) -> Pack {
    f.tightened().range
}

impl<const M: usize> Field<M> {
    fn of(f: &Form<M>) -> Self {
        Self { value: range(f.value), gradient: each!(|a| range(f.gradient[a])) }
    }

    pub(super) fn gradient_in(&self, lane: usize) -> [Interval; M] {
        self.gradient.map(|g| g.lane(lane))
    }
}

impl<'a, const D: usize, const N: usize, const M: usize> View<'a, D, N, M> {
    pub(super) fn new(robot: &Robot, paving: &'a Paving, boxes: &[u32; LANES]) -> Self {
        let cells = boxes.map(|node| paving.bounds(node));
        let y: [Form<M>; N] = std::array::from_fn(|k| match paving.axes.iter().position(|&axis| axis == k) {
            None => Form::constant(Interval::point(paving.window.ranges[k].0)),
            Some(a) => {
                let extent = cells.map(|(lo, hi)| Interval::new(lo[a], hi[a]));
                let middle = Pack::from_fn(|l| Interval::point(extent[l].mid()));
                let extent = Pack::from_fn(|l| extent[l]);
                let r = Pack::from_fn(|l| Interval::point((extent.lane(l) - middle.lane(l)).magnitude()));
                let mut y = Form::fixed(Slope::variable(extent, middle, r, a));
                y.gradient[a] = Slope { range: r, centre: r, slope: [Pack::zero(); M] };
                y
            }
        });
        let (placement, legs) = paving.chart.at::<Form<M>, D, N>(robot, &y, |k| y[k].sin_cos());
        let mut usable = [true; LANES];
        let mut fixed = [[Form::zero(); D]; N];
        let mut swing = [[Form::zero(); D]; N];
        for (j, leg) in robot.legs.iter().enumerate() {
            let closure = &legs[j].closure;
            (fixed[j], swing[j]) = (closure.fixed, closure.swing);
            // Rows of A itself, not times the weight: what varies least is enclosed best.
            if legs[j].is_weighted(leg) {
                let weight = closure.weight.tightened();
                let positive = weight.value.range.positive();
                (0..LANES).for_each(|l| usable[l] &= positive[l]);
                let inverse = (Form::constant(Interval::point(1.0)) / weight).tightened();
                let by_weight = |v: &[Form<M>; D]| each!(|k| (v[k].tightened() * inverse).tightened());
                (fixed[j], swing[j]) = (by_weight(&closure.fixed), by_weight(&closure.swing));
            }
        }
        let rooted =
            std::array::from_fn(|j| legs[j].fold.is_none() && robot.legs[j].actuator.postures() == 2);
        let reach: [Field<M>; N] = std::array::from_fn(|j| Field::of(&legs[j].closure.reach));
        let heights = each!(|j| reach[j].value.sqrt());
        Self { paving, boxes: *boxes, placement, legs, reach, heights, fixed, swing, rooted, usable }
    }

    pub(super) fn part(&self, robot: &Robot, heights: &[Pack; N], singular: &[Mask; N]) -> Part<N, M> {
        let mut rows = [[[Form::zero(); N]; 2]; N];
        let mut limits: [[Vec<Limited<M>>; 2]; N] = std::array::from_fn(|_| Default::default());
        for (j, leg) in robot.legs.iter().enumerate() {
            let signed = if self.rooted[j] {
                // H need not be above zero at the centre: h's own slopes are of no use near a singularity.
                let whole = |range| Slope { range, centre: range, slope: [Pack::zero(); M] };
                let smooth = self.legs[j].closure.reach.tightened().sqrt();
                let h =
                    if is_whole(&heights[j], &self.heights[j]) { smooth.value } else { whole(heights[j]) };
                [(h, smooth), (-h, -smooth)]
                    .map(|(own, smooth)| select(&singular[j], &Form::variable(own, OWN), &smooth))
            } else {
                self.legs[j].heights()
            };
            let at = self.legs[j].limited(leg);
            for (posture, row) in rows[j].iter_mut().enumerate() {
                let sh = signed[posture];
                let g: [Form<M>; D] = match self.rooted[j] {
                    true => each!(|k| self.fixed[j][k] + sh * self.swing[j][k]),
                    false => self.fixed[j],
                };
                let row_of_a: [Form<M>; N] =
                    wrench(robot.platform, &out_of_frame(leg, &g), &self.legs[j].arm);
                *row = each!(|k| row_of_a[k].tightened());
                for limit in &leg.limits {
                    let inside = margin(limit, &at, sh, &self.placement) / unit(limit, &at, sh);
                    limits[j][posture]
                        .push(Limited { field: Field::of(&inside), own: range(inside.gradient[OWN]) });
                }
            }
        }
        Part { rows, limits, heights: *heights, singular: *singular }
    }

    /// All constraints but det A, in one box.
    pub(super) fn constraints(
        &self,
        robot: &Robot,
        scale: &Scale,
        part: &Part<N, M>,
        frame: &Frame<N, M>,
        mode: WorkingMode,
        lane: usize,
    ) -> ArrayVec<Growth<M>, MOST> {
        let mut all = ArrayVec::new();
        let mut add = |value: Interval, scale: f64, along| {
            let _ = all.try_push(Growth { value: value / Interval::point(scale), along });
        };
        for (j, leg) in robot.legs.iter().enumerate() {
            let sign = f64::from(mode.sign(j));
            if leg.actuator.postures() == 2 {
                let reach = self.reach[j].value.lane(lane).meet(part.heights[j].lane(lane).square());
                let height = (reach / Interval::point(scale.reach[j])).sqrt();
                add(height, 1.0, self.reach_along(frame, j, sign, lane));
            }
            let limits = &part.limits[j][usize::from(mode.sign(j) < 0)];
            for (limit, &scale) in limits.iter().zip(&scale.limits[j]) {
                let own = (j, sign, limit.own.lane(lane));
                let along = frame.along(&limit.field.gradient_in(lane), &[own]);
                add(limit.field.value.lane(lane), scale, along);
            }
        }
        let (lo, hi) = self.paving.bounds(self.boxes[lane]);
        for (a, &k) in self.paving.axes.iter().enumerate() {
            let (first, last) = self.paving.window.ranges[k];
            let (cut_first, cut_last) = self.paving.window.cut[k];
            let extent = Interval::new(lo[a], hi[a]);
            for (cut, distance, sign) in [
                (cut_first, extent - Interval::point(first), 1.0),
                (cut_last, Interval::point(last) - extent, -1.0),
            ] {
                if cut {
                    let gradient = std::array::from_fn(|b| Interval::point(if a == b { sign } else { 0.0 }));
                    add(distance, last - first, frame.along(&gradient, &[]));
                }
            }
        }
        all
    }

    /// The derivatives of H_j, or of an increasing function of it.
    fn reach_along(&self, frame: &Frame<N, M>, j: usize, sign: f64, lane: usize) -> [Interval; M] {
        match &self.legs[j].fold {
            Some(fold) => {
                let gradient = Field::of(&fold.b).gradient_in(lane);
                frame.along(&gradient.map(|g| g * Interval::point(sign)), &[])
            }
            None if frame.singular[j] => std::array::from_fn(|i| frame.climb[i][j]),
            None => frame.along(&self.reach[j].gradient_in(lane), &[]),
        }
    }

    pub(super) fn determinant(&self, part: &Part<N, M>, mode: WorkingMode) -> Determinant<N, M> {
        let posture = |j: usize| usize::from(mode.sign(j) < 0);
        let mut rows: [[Slope<Pack, M>; N]; N] =
            std::array::from_fn(|j| each!(|i| part.rows[j][posture(j)][i].value));
        // det A = det(A Z) / det Z, for the derivatives too.
        let by = (N > 3).then(|| Conditioner::new(&rows));
        let conditioned = |row: [Slope<Pack, M>; N]| by.as_ref().map_or(row, |by| by.row(&row));
        rows = rows.map(conditioned);
        let mut minors = cofactors(&rows);
        for minor in minors.as_flattened_mut() {
            *minor = minor.tightened();
        }
        let mut det = rows[0][0] * minors[0][0];
        for i in 1..N {
            det = det + rows[0][i] * minors[0][i];
        }
        let partial = |j: usize, k: usize| {
            let row = &part.rows[j][posture(j)];
            let row = conditioned(each!(|i| row[i].gradient[k]));
            let mut sum = minors[j][0] * row[0];
            for i in 1..N {
                sum = sum + minors[j][i] * row[i];
            }
            sum
        };
        let range = |f: Slope<Pack, M>| by.as_ref().map_or(range(f), |by| range(f) / by.det);
        let gradient: [Pack; M] = each!(|a| {
            let mut sum = partial(0, a);
            for j in 1..N {
                sum = sum + partial(j, a);
            }
            range(sum)
        });
        // The mean-value theorem, where the gradient is the whole of the derivative.
        let middle = by.as_ref().map_or(det.centre, |by| det.centre / by.det);
        let around = (0..M).fold(middle, |sum, a| sum + gradient[a].symmetric());
        let whole: Mask = std::array::from_fn(|l| !(0..N).any(|j| part.singular[j][l]));
        let value = range(det);
        Determinant {
            value: Pack::select(&whole, value.meet(around), value),
            gradient,
            own: each!(|j| if self.rooted[j] { range(partial(j, OWN)) } else { Pack::zero() }),
        }
    }
}

fn is_whole(part: &Pack, whole: &Pack) -> bool {
    part.lo == whole.lo && part.hi == whole.hi
}
