//! No hiding: the proof that no aspect has its highest point in a box.
//!
//! # Theorem
//! Let g_1, …, g_r be the functions whose common positivity region is S_{s,σ} (σ det A, the H_j, the limits, the distances to
//! the faces at which the user's window cuts the workspace), each divided by a positive constant, and
//!
//! > P = min_k g_k.
//!
//! S_{s,σ} is bounded and P vanishes on its boundary, so P has a maximum, a *summit*, in each of its components. At a summit
//! no tangent vector makes all the g_k that attain the minimum grow. Hence, if a box comes with tangent vectors e(X) such that
//! e·∇g_k > 0 on all of box ∩ S_{s,σ} for every g_k that can attain the minimum there, no aspect has a summit in the box.
//!
//! Nothing is assumed of the robot: where the test fails, nothing is concluded. It succeeds in every small enough box
//! whose singular functions have linearly independent gradients *in the variables (X, h)*, which is what
//! `docs/theory.md`, 5, calls a generic robot.
//!
//! # The vectors
//! ∂det A/∂X grows without bound where some h_j = √H_j vanishes, but det A is smooth in (X, h) with 2h_j ḣ_j = ∇H_j·Ẋ. For
//! the legs J that are singular in the box, the vectors are combinations of
//!
//! - t, tangent to every {H_j = const}, j ∈ J: ḣ_j = 0 for j ∈ J;
//! - h_j m_j, with m_j tangent to {H_i = const} for the other i ∈ J: ḣ_j = ½ ∇H_j·m_j and ḣ_i = 0,
//!
//! n in all, along which everything is bounded with h_j ∈ [0, h̄_j] as a variable of its own.

use super::saddle::no_local_maximum;
use super::scale::Scale;
use crate::kinematics::WorkingMode;
use crate::kinematics::limits::{margin, unit};
use crate::kinematics::modal::LegClosure;
use crate::kinematics::placement::{Placement, cofactors, out_of_frame, wrench};
use crate::num::{Interval, Jet, LANES, Mask, Pack, Scalar, Slope, each};
use crate::paving::{ClassSet, Paving};
use crate::robot::Robot;
use arrayvec::ArrayVec;

/// Centred forms over eight boxes, differentiated with respect to the coordinates that vary (at most three, scaled to [−1, 1] in
/// each box) and, fourth, to the leg's own s h.
type Form<const M: usize> = Jet<Slope<Pack, M>, 4>;

/// The place of s h among the derivatives.
const OWN: usize = 3;

/// More constraints than any robot file can bring to bear on one box at once.
const MOST: usize = 64;

/// Of the classes `asked` of up to eight boxes, those that surely have no summit there.
pub(super) fn summitless<const D: usize, const N: usize, const M: usize>(
    robot: &Robot,
    paving: &Paving,
    scale: &Scale,
    boxes: &[(u32, ClassSet)],
) -> [ClassSet; LANES] {
    let view = View::<D, N, M>::new(robot, paving, &std::array::from_fn(|l| boxes[l.min(boxes.len() - 1)].0));
    let mut asked = [0; LANES];
    (0..boxes.len()).filter(|&l| view.usable[l]).for_each(|l| asked[l] = boxes[l].1);
    let mut proved = view.look(robot, scale, &view.heights, &asked);
    // Near a serial singularity h varies like the root of the box's width: cut its range and look at each part.
    let left: [ClassSet; LANES] = std::array::from_fn(|l| asked[l] & !proved[l]);
    let singular = view.singular(&left);
    if singular.contains(&true) {
        let mut held = left;
        for heights in parts(&view.heights, &singular) {
            let found = view.look(robot, scale, &heights, &held);
            (0..LANES).for_each(|l| held[l] &= found[l]);
            if held == [0; LANES] {
                break;
            }
        }
        (0..LANES).for_each(|l| proved[l] |= held[l]);
    }
    for (l, &(node, _)) in
        boxes.iter().enumerate().filter(|(_, b)| u32::from(paving.nodes[b.0 as usize].depth) >= DEEP)
    {
        let left = asked[l] & !proved[l];
        for (m, &mode) in paving.modes.iter().enumerate().filter(|(m, _)| left >> (2 * m) & 3 != 0) {
            proved[l] |= left & view.saddles::<D>(robot, scale, node, l, (m, mode));
        }
    }
    proved
}

/// From this depth on the second-order test is tried: double points of det A = 0 are rare, and it costs more.
const DEEP: u32 = 9;

/// The ranges of h, those of the marked legs cut into parts, in all combinations.
fn parts<const N: usize>(heights: &[Pack; N], cut: &[bool; N]) -> impl Iterator<Item = [Pack; N]> {
    let heights = *heights;
    let cuts: ArrayVec<usize, N> = (0..N).filter(|&j| cut[j]).collect();
    let each = [1, 4, 3, 2][cuts.len().min(3)];
    (0..usize::pow(each, cuts.len() as u32)).map(move |mut index| {
        let mut part = heights;
        for &j in &cuts {
            let (k, of) = ((index % each) as f64, each as f64);
            index /= each;
            part[j] = Pack::from_fn(|l| {
                let whole = heights[j].lane(l);
                // The same formula for the end of one part and the start of the next: no gap.
                let at =
                    |k: f64| if k == of { whole.hi } else { whole.lo + (whole.hi - whole.lo) * (k / of) };
                Interval::new(at(k), at(k + 1.0))
            });
        }
        part
    })
}

/// A constraint over a box: its scaled values and its derivatives along the vectors of the frame.
#[derive(Clone, Copy)]
struct Growth<const M: usize> {
    value: Interval,
    along: [Interval; M],
}

impl<const M: usize> Growth<M> {
    fn signed(&self, sign: f64) -> Self {
        if sign > 0.0 { *self } else { Self { value: -self.value, along: self.along.map(|x| -x) } }
    }
}

/// Whether some fixed combination of the frame makes every constraint grow that can be the least one in the box.
fn can_climb<const M: usize>(common: &[Growth<M>], det: &Growth<M>) -> bool {
    let all = || common.iter().chain([det]);
    let least = all().fold(f64::INFINITY, |least, g| least.min(g.value.hi));
    let active: ArrayVec<&[Interval; M], MOST> =
        all().filter(|g| g.value.lo <= least).map(|g| &g.along).take(MOST).collect();
    active.len() < MOST && direction(&active).is_some()
}

/// Most corrections of a direction.
const CORRECTIONS: usize = 60;

/// v with v·γ > 0 for every γ in every box of `forms`, found by the perceptron's rule: add the worst vector, until there is none.
fn direction<const M: usize>(forms: &[&[Interval; M]]) -> Option<[f64; M]> {
    let weight = balance(forms);
    let mut v = [0.0; M];
    for form in forms {
        add(&mut v, &form.map(|i| i.mid()), &weight);
    }
    for _ in 0..CORRECTIONS {
        let value = |form: &[Interval; M]| {
            (0..M).fold(Interval::point(0.0), |sum, i| sum + form[i] * Interval::point(v[i]))
        };
        let worst = forms.iter().min_by(|a, b| value(a).lo.total_cmp(&value(b).lo))?;
        if value(worst).is_positive() {
            return Some(v);
        }
        let corner = std::array::from_fn(|i| if v[i] > 0.0 { worst[i].lo } else { worst[i].hi });
        if !add(&mut v, &corner, &weight) {
            return None;
        }
    }
    None
}

/// Squared units of the vectors' lengths in which the derivatives along them are of like size: a vector along which all change
/// little is given more weight. The search alone depends on it.
fn balance<const M: usize>(forms: &[&[Interval; M]]) -> [f64; M] {
    let mut weight = [1.0; M];
    for _ in 0..3 {
        let mut largest = [0.0f64; M];
        for form in forms {
            let sized: [f64; M] = std::array::from_fn(|i| form[i].magnitude() * weight[i].sqrt());
            let most = sized.iter().copied().fold(0.0, f64::max);
            (0..M).for_each(|i| largest[i] = largest[i].max(sized[i] / most));
        }
        for i in 0..M {
            let scaled = weight[i] / largest[i].powi(2);
            weight[i] = if scaled.is_normal() { scaled } else { weight[i] };
        }
    }
    weight
}

/// Adds the unit vector along `w` in the metric of `weight`, if it has a direction.
fn add<const M: usize>(v: &mut [f64; M], w: &[f64; M], weight: &[f64; M]) -> bool {
    let length = (0..M).map(|i| w[i] * w[i] * weight[i]).sum::<f64>().sqrt();
    let fit = length.is_normal();
    if fit {
        (0..M).for_each(|i| v[i] += w[i] * weight[i] / length);
    }
    fit
}

/// The robot over eight boxes.
struct View<'a, const D: usize, const N: usize, const M: usize> {
    paving: &'a Paving,
    boxes: [u32; LANES],
    placement: Placement<Form<M>, D>,
    legs: [LegClosure<Form<M>, D>; N],
    /// H_j and its gradient.
    reach: [Field<M>; N],
    /// The range of h_j.
    heights: [Pack; N],
    /// The parts of ∂f/∂d: fixed + s h swing.
    fixed: [[Form<M>; D]; N],
    swing: [[Form<M>; D]; N],
    /// Which legs have a serial singularity with a root in it.
    rooted: [bool; N],
    /// Lanes in which every row of A is bounded.
    usable: Mask,
}

/// What depends on the range of h too.
struct Part<const N: usize, const M: usize> {
    /// Rows of A for both postures.
    rows: [[[Form<M>; N]; 2]; N],
    /// Per leg, posture and limit: the margin.
    limits: [[Vec<Limited<M>>; 2]; N],
    heights: [Pack; N],
}

/// Values and gradient of a function over eight boxes.
#[derive(Clone, Copy)]
struct Field<const M: usize> {
    value: Pack,
    gradient: [Pack; M],
}

impl<const N: usize, const M: usize> Determinant<N, M> {
    /// In one box.
    fn growth(&self, frame: &Frame<N, M>, mode: WorkingMode, scale: &Scale, lane: usize) -> Growth<M> {
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
struct Determinant<const N: usize, const M: usize> {
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

    fn gradient_in(&self, lane: usize) -> [Interval; M] {
        self.gradient.map(|g| g.lane(lane))
    }
}

impl<'a, const D: usize, const N: usize, const M: usize> View<'a, D, N, M> {
    fn new(robot: &Robot, paving: &'a Paving, boxes: &[u32; LANES]) -> Self {
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

    /// The legs that are singular in some box in which something is asked.
    fn singular(&self, asked: &[ClassSet; LANES]) -> [bool; N] {
        std::array::from_fn(|j| {
            self.rooted[j] && (0..LANES).any(|l| asked[l] != 0 && is_singular(self.reach[j].value.lane(l)))
        })
    }

    /// Of the classes asked, those without a summit where the h_j are in the given ranges.
    fn look(
        &self,
        robot: &Robot,
        scale: &Scale,
        heights: &[Pack; N],
        asked: &[ClassSet; LANES],
    ) -> [ClassSet; LANES] {
        let part = self.part(robot, heights);
        let frames: [ArrayVec<Frame<N, M>, 2>; LANES] =
            std::array::from_fn(
                |l| {
                    if asked[l] == 0 { ArrayVec::new() } else { self.frames(&part, l, scale) }
                },
            );
        let any = asked.iter().fold(0, |any, classes| any | classes);
        let mut proved = [0; LANES];
        for (m, &mode) in self.paving.modes.iter().enumerate().filter(|(m, _)| any >> (2 * m) & 3 != 0) {
            let det = self.determinant(&part, mode);
            for l in (0..LANES).filter(|&l| asked[l] >> (2 * m) & 3 != 0) {
                for frame in &frames[l] {
                    let common = self.constraints(robot, scale, &part, frame, mode, l);
                    let det = det.growth(frame, mode, scale, l);
                    for (sign, bit) in [(1.0, 1 << (2 * m)), (-1.0, 2 << (2 * m))] {
                        if asked[l] & !proved[l] & bit != 0 && can_climb(&common, &det.signed(sign)) {
                            proved[l] |= bit;
                        }
                    }
                    if asked[l] & !proved[l] & (3 << (2 * m)) == 0 {
                        break;
                    }
                }
            }
        }
        proved
    }

    /// The classes of a mode without a summit in one box by the second-order test ([`no_local_maximum`]).
    fn saddles<const SPACE: usize>(
        &self,
        robot: &Robot,
        scale: &Scale,
        node: u32,
        lane: usize,
        (m, mode): (usize, WorkingMode),
    ) -> ClassSet {
        let part = self.part(robot, &self.heights);
        let Some(frame) = Frame::new(self, &part, lane, [false; N]) else { return 0 };
        let least = self
            .constraints(robot, scale, &part, &frame, mode, lane)
            .iter()
            .fold(f64::INFINITY, |least, g| least.min(g.value.lo));
        let det = self.determinant(&part, mode).growth(&frame, mode, scale, lane).value;
        if det.magnitude() >= least {
            return 0;
        }
        let [plus, minus] = no_local_maximum::<SPACE, N, M>(robot, self.paving, node, mode);
        (ClassSet::from(plus) | ClassSet::from(minus) << 1) << (2 * m)
    }

    /// Frames to try. A frame is valid whichever legs are counted as singular, as long as all are that can be; it is mostly better
    /// if all are that nearly are, because ∇det A is then nearly parallel to ∇H_j.
    fn frames(&self, part: &Part<N, M>, lane: usize, scale: &Scale) -> ArrayVec<Frame<N, M>, 2> {
        let reach = |j: usize| self.reach[j].value.lane(lane);
        let must: [bool; N] = std::array::from_fn(|j| self.rooted[j] && is_singular(reach(j)));
        let may: [bool; N] =
            std::array::from_fn(|j| must[j] || self.rooted[j] && reach(j).hi <= NEARLY * scale.reach[j]);
        let mut choices: ArrayVec<[bool; N], 2> = [may].into_iter().collect();
        if may != must {
            choices.push(must);
        }
        choices.into_iter().filter_map(|singular| Frame::new(self, part, lane, singular)).collect()
    }

    fn part(&self, robot: &Robot, heights: &[Pack; N]) -> Part<N, M> {
        let mut rows = [[[Form::zero(); N]; 2]; N];
        let mut limits: [[Vec<Limited<M>>; 2]; N] = std::array::from_fn(|_| Default::default());
        for (j, leg) in robot.legs.iter().enumerate() {
            let signed = if self.rooted[j] {
                // H need not be above zero at the centre: h's own slopes are of no use near a singularity.
                let whole = |range| Slope { range, centre: range, slope: [Pack::zero(); M] };
                let smooth = self.legs[j].closure.reach.value.tightened().sqrt();
                let h = if is_whole(&heights[j], &self.heights[j]) { smooth } else { whole(heights[j]) };
                [h, -h].map(|sh| Form::variable(sh, OWN))
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
        Part { rows, limits, heights: *heights }
    }

    /// All constraints but det A, in one box.
    fn constraints(
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
                add(reach, scale.reach[j], self.reach_along(frame, j, sign, lane));
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
                    let gradient = each_interval(|b| Interval::point(if a == b { sign } else { 0.0 }));
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
            None if frame.singular[j] => each_interval(|i| frame.climb[i][j]),
            None => frame.along(&self.reach[j].gradient_in(lane), &[]),
        }
    }

    fn determinant(&self, part: &Part<N, M>, mode: WorkingMode) -> Determinant<N, M> {
        let posture = |j: usize| usize::from(mode.sign(j) < 0);
        let rows: [[Slope<Pack, M>; N]; N] =
            std::array::from_fn(|j| each!(|i| part.rows[j][posture(j)][i].value));
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
            let mut sum = minors[j][0] * row[0].gradient[k];
            for i in 1..N {
                sum = sum + minors[j][i] * row[i].gradient[k];
            }
            sum
        };
        Determinant {
            value: range(det),
            gradient: each!(|a| {
                let mut sum = partial(0, a);
                for j in 1..N {
                    sum = sum + partial(j, a);
                }
                range(sum)
            }),
            own: each!(|j| if self.rooted[j] { range(partial(j, OWN)) } else { Pack::zero() }),
        }
    }
}

fn each_interval<const M: usize>(f: impl Fn(usize) -> Interval) -> [Interval; M] {
    std::array::from_fn(f)
}

/// A leg is nearly singular in a box if its H, relative to its scale, is less than this.
const NEARLY: f64 = 0.3;

/// Whether H may vanish, or nearly.
fn is_singular(reach: Interval) -> bool {
    reach.lo <= 0.1 * reach.hi
}

fn is_whole(part: &Pack, whole: &Pack) -> bool {
    part.lo == whole.lo && part.hi == whole.hi
}

/// M tangent vectors over a box, adapted to its singular legs.
struct Frame<const N: usize, const M: usize> {
    /// Their components in the scaled coordinates.
    vectors: [[Interval; M]; M],
    /// ḣ_j along each (of a singular leg along its own vector: divided by nothing, so bounded).
    climb: [[Interval; N]; M],
    /// J.
    singular: [bool; N],
}

impl<const N: usize, const M: usize> Frame<N, M> {
    /// `None` if more legs are singular than there are coordinates.
    fn new<const D: usize>(
        view: &View<'_, D, N, M>,
        part: &Part<N, M>,
        lane: usize,
        singular: [bool; N],
    ) -> Option<Self> {
        let half = Interval::point(0.5);
        let legs: ArrayVec<usize, N> = (0..N).filter(|&j| singular[j]).collect();
        if legs.len() > M {
            return None;
        }
        let gradients: [[Interval; M]; N] = std::array::from_fn(|j| view.reach[j].gradient_in(lane));
        let normals: ArrayVec<[Interval; M], M> = legs.iter().map(|&j| gradients[j]).collect();
        let (directions, own) = adapted(&normals)?;
        let heights: [Interval; N] = std::array::from_fn(|j| part.heights[j].lane(lane));
        let mut vectors = directions;
        let mut climb = [[Interval::point(0.0); N]; M];
        for i in 0..M {
            let leg = own[i].map(|k| legs[k]);
            if let Some(j) = leg {
                vectors[i] = directions[i].map(|x| x * heights[j]);
            }
            for j in (0..N).filter(|&j| view.rooted[j]) {
                climb[i][j] = match (singular[j], leg == Some(j)) {
                    (true, true) => dot(&gradients[j], &directions[i]) * half,
                    (true, false) => Interval::point(0.0),
                    (false, _) => dot(&gradients[j], &vectors[i]) * half / heights[j],
                };
            }
        }
        Some(Self { vectors, climb, singular })
    }

    /// The derivatives of a function along the vectors, from its gradient at fixed h and, for the legs in `own`, (leg, posture,
    /// derivative with respect to s h).
    fn along(&self, gradient: &[Interval; M], own: &[(usize, f64, Interval)]) -> [Interval; M] {
        each_interval(|i| {
            own.iter().fold(dot(gradient, &self.vectors[i]), |sum, (j, sign, partial)| {
                sum + *partial * self.climb[i][*j] * Interval::point(*sign)
            })
        })
    }
}

/// M directions: first those tangent to all the surfaces with the given normals, then for each surface k one (marked k) tangent to all
/// the others.
#[allow(clippy::type_complexity)]
fn adapted<const M: usize>(normals: &[[Interval; M]]) -> Option<([[Interval; M]; M], [Option<usize>; M])> {
    let mut directions = [[Interval::point(0.0); M]; M];
    let mut own = [None; M];
    let middles: ArrayVec<[f64; M], M> = normals.iter().map(|n| unit_vector(&n.map(|x| x.mid()))).collect();
    let exact = |v: [f64; M]| v.map(Interval::point);
    let axis = |i: usize| std::array::from_fn(|k| f64::from(u8::from(i == k)));
    match (M, normals) {
        (_, []) => (0..M).for_each(|i| directions[i] = exact(axis(i))),
        (1, [_]) => (directions[0], own[0]) = (exact(axis(0)), Some(0)),
        (2, [n]) => {
            directions =
                [turned(n), exact(middles[0])].into_iter().collect::<ArrayVec<_, M>>().into_inner().ok()?;
            own[1] = Some(0);
        }
        (2, [n, m]) => {
            (directions[0], own[0]) = (turned(m), Some(0));
            (directions[1], own[1]) = (turned(n), Some(1));
        }
        (3, [n]) => {
            let c = middles[0];
            let least = (0..M).min_by(|&a, &b| c[a].abs().total_cmp(&c[b].abs()))?;
            let u = unit_vector(&cross(&exact(c), &exact(axis(least))).map(|x| x.mid()));
            let v = unit_vector(&cross(&exact(c), &exact(u)).map(|x| x.mid()));
            (directions[0], directions[1]) = (cross(n, &exact(u)), cross(n, &exact(v)));
            (directions[2], own[2]) = (exact(c), Some(0));
        }
        (3, [n, m]) => {
            let edge = exact(unit_vector(&cross(&exact(middles[0]), &exact(middles[1])).map(|x| x.mid())));
            directions[0] = cross(n, m);
            (directions[1], own[1]) = (cross(m, &edge), Some(0));
            (directions[2], own[2]) = (cross(n, &edge), Some(1));
        }
        (3, [n, m, l]) => {
            (directions[0], own[0]) = (cross(m, l), Some(0));
            (directions[1], own[1]) = (cross(l, n), Some(1));
            (directions[2], own[2]) = (cross(n, m), Some(2));
        }
        _ => return None,
    }
    Some((directions, own))
}

fn dot<const M: usize>(a: &[Interval; M], b: &[Interval; M]) -> Interval {
    (0..M).fold(Interval::point(0.0), |sum, k| sum + a[k] * b[k])
}

fn unit_vector<const M: usize>(v: &[f64; M]) -> [f64; M] {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length.is_normal() { v.map(|x| x / length) } else { *v }
}

/// A quarter turn in the plane: exactly perpendicular.
fn turned<const M: usize>(v: &[Interval; M]) -> [Interval; M] {
    let mut w = *v;
    (w[0], w[M - 1]) = (-v[M - 1], v[0]);
    w
}

/// The cross product in space: exactly perpendicular to both.
fn cross<const M: usize>(a: &[Interval; M], b: &[Interval; M]) -> [Interval; M] {
    each_interval(|i| {
        let (j, k) = ((i + 1) % M, (i + 2) % M);
        a[j] * b[k] - a[k] * b[j]
    })
}
