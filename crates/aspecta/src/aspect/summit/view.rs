//! The robot over eight boxes, with derivatives that stay bounded at serial singularities.

use super::MOST;
use super::climb::Growth;
use super::frame::Frame;
use super::leg::LegPart;
use crate::paving::Paving;
use arrayvec::ArrayVec;
use aspecta_kinematics::chart::Coordinates;
use aspecta_kinematics::condition::Conditioner;
use aspecta_kinematics::modal::LegClosure;
use aspecta_kinematics::placement::{Placement, cofactors, out_of_frame, wrench};
use aspecta_robot::Robot;
use aspecta_robot::WorkingMode;
use aspecta_robot::num::{Interval, Jet, LANES, Mask, Pack, Scalar, Slope, each};
use aspecta_verify::certificate::Scale;

/// Centred forms over eight boxes, differentiated with respect to the coordinates that vary, scaled to [−1, 1] in each box.
pub(super) type Form<const M: usize> = Jet<Slope<Pack, M>, M>;

/// The robot over eight boxes.
pub(super) struct View<'a, const D: usize, const N: usize, const M: usize> {
    pub robot: &'a Robot,
    pub paving: &'a Paving,
    pub scale: &'a Scale,
    boxes: [u32; LANES],
    pub placement: Placement<Form<M>, D>,
    pub legs: [LegClosure<Form<M>, D>; N],
    /// H_j and its gradient.
    pub reach: [Field<M>; N],
    /// The range of h_j.
    pub heights: [Pack; N],
    /// h_j = √H_j, where that may be differentiated.
    pub smooth: [Form<M>; N],
    /// The parts of the rows of A: fixed + s h swing.
    pub fixed: [[Form<M>; N]; N],
    pub swing: [[Form<M>; N]; N],
    /// Which legs have a serial singularity with a root in it.
    pub rooted: [bool; N],
    /// Lanes in which every row of A is bounded.
    pub usable: Mask,
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

/// det A: it depends on every leg's s h.
pub(super) struct Determinant<const N: usize, const M: usize> {
    value: Pack,
    gradient: [Pack; M],
    own: [Pack; N],
}

pub(super) fn range<const M: usize>(f: Slope<Pack, M>) -> Pack {
    f.tightened().range
}

impl<const M: usize> Field<M> {
    pub(super) fn of(f: &Form<M>) -> Self {
        Self { value: range(f.value), gradient: each!(|a| range(f.gradient[a])) }
    }

    pub(super) fn gradient_in(&self, lane: usize) -> [Interval; M] {
        self.gradient.map(|g| g.lane(lane))
    }
}

impl<'a, const D: usize, const N: usize, const M: usize> View<'a, D, N, M> {
    pub(super) fn new(robot: &'a Robot, paving: &'a Paving, scale: &'a Scale, boxes: &[u32; LANES]) -> Self {
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
        let reach: [Field<M>; N] = std::array::from_fn(|j| Field::of(&legs[j].closure.reach));
        let mut view = Self {
            robot,
            paving,
            scale,
            boxes: *boxes,
            placement,
            rooted: std::array::from_fn(|j| legs[j].fold.is_none() && robot.legs[j].actuator.postures() == 2),
            legs,
            heights: each!(|j| reach[j].value.sqrt()),
            reach,
            smooth: [Form::zero(); N],
            fixed: [[Form::zero(); N]; N],
            swing: [[Form::zero(); N]; N],
            usable: [true; LANES],
        };
        (0..N).for_each(|j| view.set_rows(j));
        view
    }

    /// Row j of A itself, not times the weight: what varies least is enclosed best.
    fn set_rows(&mut self, j: usize) {
        let (robot, leg) = (self.robot, &self.robot.legs[j]);
        let LegClosure { closure, arm, .. } = &self.legs[j];
        let inverse = self.legs[j].is_weighted(leg).then(|| {
            let weight = closure.weight.tightened();
            let positive = weight.value.range.positive();
            (0..LANES).for_each(|l| self.usable[l] &= positive[l]);
            (Form::constant(Interval::point(1.0)) / weight).tightened()
        });
        let row = |part: &[Form<M>; D]| -> [Form<M>; N] {
            let part = match &inverse {
                Some(inverse) => &each!(|k| (part[k].tightened() * *inverse).tightened()),
                None => part,
            };
            let row: [Form<M>; N] = wrench(robot.platform, &out_of_frame(leg, part), arm);
            each!(|k| row[k].tightened())
        };
        self.fixed[j] = row(&closure.fixed);
        if self.rooted[j] {
            self.swing[j] = row(&closure.swing);
            self.smooth[j] = closure.reach.tightened().sqrt();
        }
    }

    /// All constraints but det A, in one box.
    pub(super) fn constraints(
        &self,
        part: &[LegPart<N, M>; N],
        frame: &Frame<N, M>,
        mode: WorkingMode,
        lane: usize,
    ) -> ArrayVec<Growth<M>, MOST> {
        let mut all = ArrayVec::new();
        let mut add = |value: Interval, scale: f64, along| {
            let _ = all.try_push(Growth { value: value / Interval::point(scale), along });
        };
        for (j, leg) in self.robot.legs.iter().enumerate() {
            let sign = f64::from(mode.sign(j));
            if leg.actuator.postures() == 2 {
                let reach = self.reach[j].value.lane(lane).meet(part[j].height.lane(lane).square());
                let height = (reach / Interval::point(self.scale.reach[j])).sqrt();
                add(height, 1.0, self.reach_along(frame, j, sign, lane));
            }
            let limits = &part[j].limits[usize::from(mode.sign(j) < 0)];
            for (limit, &scale) in limits.iter().zip(&self.scale.limits[j]) {
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

    pub(super) fn determinant(&self, part: &[LegPart<N, M>; N], mode: WorkingMode) -> Determinant<N, M> {
        let posture = |j: usize| usize::from(mode.sign(j) < 0);
        let mut rows: [[Slope<Pack, M>; N]; N] =
            std::array::from_fn(|j| each!(|i| part[j].rows[posture(j)][i].value));
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
        let partial = |j: usize, row: [Slope<Pack, M>; N]| {
            let row = conditioned(row);
            let mut sum = minors[j][0] * row[0];
            for i in 1..N {
                sum = sum + minors[j][i] * row[i];
            }
            sum
        };
        let range = |f: Slope<Pack, M>| by.as_ref().map_or(range(f), |by| range(f) / by.det);
        let gradient: [Pack; M] = each!(|a| {
            let along = |j: usize| each!(|i| part[j].rows[posture(j)][i].gradient[a]);
            let mut sum = partial(0, along(0));
            for j in 1..N {
                sum = sum + partial(j, along(j));
            }
            range(sum)
        });
        // The mean-value theorem, where the gradient is the whole of the derivative.
        let middle = by.as_ref().map_or(det.centre, |by| det.centre / by.det);
        let around = (0..M).fold(middle, |sum, a| sum + gradient[a].symmetric());
        let whole: Mask = std::array::from_fn(|l| !(0..N).any(|j| part[j].singular[l]));
        let value = range(det);
        Determinant {
            value: Pack::select(&whole, value.meet(around), value),
            gradient,
            own: each!(|j| match self.rooted[j] {
                true => range(partial(j, each!(|i| self.swing[j][i].value))),
                false => Pack::zero(),
            }),
        }
    }
}
