//! The robot over eight boxes, with derivatives that stay bounded at serial singularities.

use super::form::{Field, Form};
use crate::paving::Paving;
use aspecta_kinematics::chart::Coordinates;
use aspecta_kinematics::constraints::Scale;
use aspecta_kinematics::modal::LegClosure;
use aspecta_kinematics::placement::{Placement, out_of_frame, wrench};
use aspecta_robot::num::{Affine, Interval, LANES, Line, Mask, Pack, Scalar, each};
use aspecta_robot::{LegIndex, Robot};
use std::cell::OnceCell;

/// The placement and the legs over eight boxes: some hundred kilobytes, which are not moved about.
pub(super) type Over<const D: usize, const N: usize, const M: usize> =
    (Placement<Form<M>, D>, [LegClosure<Form<M>, D>; N]);

/// Evaluates the robot over eight boxes.
pub(super) fn over<const D: usize, const N: usize, const M: usize>(
    robot: &Robot,
    paving: &Paving,
    boxes: &[u32; LANES],
) -> Over<D, N, M> {
    let cells = boxes.map(|node| paving.bounds(node));
    let y: [Form<M>; N] = std::array::from_fn(|k| match paving.axes.iter().position(|&axis| axis == k) {
        None => Form::constant(Interval::point(paving.window.ranges[k].0)),
        Some(a) => {
            let extent = cells.map(|(lo, hi)| Interval::new(lo[a], hi[a]));
            let middle = extent.map(Interval::mid);
            let r: [f64; LANES] =
                std::array::from_fn(|l| (extent[l] - Interval::point(middle[l])).magnitude());
            let mut y = Form::fixed(Affine::along(a, |l| Line::variable(middle[l], r[l])));
            y.gradient[a] = Affine::within(&Pack::from_fn(|l| Interval::point(r[l])));
            y
        }
    });
    paving.chart.at::<Form<M>, D, N>(robot, &y, |k| y[k].sin_cos())
}

/// The robot over eight boxes.
pub(super) struct View<'a, const D: usize, const N: usize, const M: usize> {
    pub robot: &'a Robot,
    pub paving: &'a Paving,
    pub scale: &'a Scale,
    pub boxes: [u32; LANES],
    pub placement: &'a Placement<Form<M>, D>,
    pub legs: &'a [LegClosure<Form<M>, D>; N],
    /// H_j and its gradient.
    pub reach: [Field<M>; N],
    /// The range of h_j.
    pub heights: [Pack; N],
    /// The rows of A.
    pub rows: Vec<Row<N, M>>,
    /// Which legs have a serial singularity with a root in it.
    pub rooted: [bool; N],
    /// For a leg that is one with an earlier one, that: both have the same h.
    pub twin_of: [Option<usize>; N],
    /// The legs that are one with another: of det A their h is taken out ([`ModalRows::parted`](aspecta_kinematics::modal::ModalRows::parted)).
    pub parted: [bool; N],
    /// Lanes in which every row of A is bounded.
    pub usable: Mask,
    /// The placement and the legs without derivatives, once they are asked for.
    plain: OnceCell<Plain<D, N, M>>,
}

/// A leg's row of A.
pub(super) struct Row<const N: usize, const M: usize> {
    /// h = √H, where that may be differentiated.
    pub smooth: Form<M>,
    /// The parts of the row: fixed + s h swing.
    pub fixed: [Form<M>; N],
    pub swing: [Form<M>; N],
    /// Lanes in which it is bounded.
    bounded: Mask,
}

/// Centred forms over eight boxes.
type Plain<const D: usize, const N: usize, const M: usize> =
    (Placement<Affine<M>, D>, [LegClosure<Affine<M>, D>; N]);

impl<'a, const D: usize, const N: usize, const M: usize> View<'a, D, N, M> {
    pub(super) fn new(
        robot: &'a Robot,
        paving: &'a Paving,
        scale: &'a Scale,
        boxes: &[u32; LANES],
        (placement, legs): &'a Over<D, N, M>,
    ) -> Self {
        let reach: [Field<M>; N] = std::array::from_fn(|j| Field::of(&legs[j].closure.reach));
        let mut view = Self {
            robot,
            paving,
            scale,
            boxes: *boxes,
            placement,
            twin_of: [None; N],
            parted: [false; N],
            rooted: std::array::from_fn(|j| legs[j].fold.is_none() && robot.legs[j].actuator.postures() == 2),
            legs,
            heights: each!(|j| reach[j].value.sqrt()),
            reach,
            rows: Vec::new(),
            usable: [true; LANES],
            plain: OnceCell::new(),
        };
        for [first, second] in paving.twins.iter().map(|twins| twins.map(LegIndex::index)) {
            view.twin_of[second] = Some(first);
            (view.parted[first], view.parted[second]) = (true, true);
        }
        view.rows = (0..N).map(|j| view.row(j)).collect();
        view.usable = std::array::from_fn(|l| view.rows.iter().all(|row| row.bounded[l]));
        // One H, in one enclosure: which of them count as singular must not differ, though their frames may.
        for (second, first) in (0..N).filter_map(|j| Some((j, view.twin_of[j]?))) {
            view.reach[second] = view.reach[first];
            view.heights[second] = view.heights[first];
            view.rows[second].smooth = view.rows[first].smooth;
        }
        view
    }

    /// The placement and the legs without derivatives.
    pub(super) fn plain(&self) -> &Plain<D, N, M> {
        self.plain.get_or_init(|| {
            let value = |f: Form<M>| f.value;
            (self.placement.map(value), self.legs.each_ref().map(|leg| leg.map(value)))
        })
    }

    /// Row j of A itself, not times the weight: what varies least is enclosed best. What stands in place of the row of a leg that is one with
    /// an earlier one is a polynomial, times the weight.
    fn row(&self, j: usize) -> Row<N, M> {
        let (robot, leg) = (self.robot, &self.robot.legs[j]);
        let LegClosure { closure, arm, .. } = &self.legs[j];
        let has_twin = self.twin_of[j].is_some();
        let weight = (self.legs[j].is_weighted(leg) && !has_twin).then(|| closure.weight.tightened());
        let bounded = weight.map_or([true; LANES], |weight| weight.value.range().positive());
        let inverse = weight.map(|weight| (Form::constant(Interval::point(1.0)) / weight).tightened());
        let row = |part: &[Form<M>; D]| -> [Form<M>; N] {
            let part = match &inverse {
                Some(inverse) => &each!(|k| (part[k].tightened() * *inverse).tightened()),
                None => part,
            };
            let row: [Form<M>; N] = wrench(robot.platform, &out_of_frame(leg, part), arm);
            each!(|k| row[k].tightened())
        };
        let zero = [Form::zero(); N];
        Row {
            smooth: if self.rooted[j] { closure.reach.tightened().sqrt() } else { Form::zero() },
            fixed: if has_twin { zero } else { row(&closure.fixed) },
            swing: if self.rooted[j] && (!self.parted[j] || has_twin) { row(&closure.swing) } else { zero },
            bounded,
        }
    }
}
