//! Drawings of the robot: one pose, and every working mode's posture (figure 8).

use super::axes::{Axis, Chart};
use super::bodies::solid_points;
use super::label::Labels;
use super::palette::INK;
use super::parts::{BASE, CRANK, PLATFORM, ROD, SPHERE, legend};
use super::shape::Shapes;
use super::skeleton::{LegShape, Point, Skeleton, minus, plus, times};
use super::svg::{Anchor, Svg};
use aspecta::aspect::{ModeReport, Reachable, Sample};
use aspecta::robot::{Platform, Robot};
use aspecta::text::subscript;

/// The robot at `sample`, with the names of its points, both frames and a legend.
pub fn robot(robot: &Robot, sample: &Sample) -> String {
    let (width, height) = (620.0, 520.0);
    let mut svg = Svg::new("robot", width, height, &format!("Robot {} in a sample pose", robot.name));
    let skeleton = Skeleton::at(robot, &sample.pose, &sample.q);
    let view = View::fit(robot, &[&skeleton], [62.0, 28.0, width - 82.0, height - 108.0]);
    view.backdrop(&mut svg, "", &robot.length_unit);
    let drawing = Drawing { robot, skeleton: &skeleton, view: &view, large: true };
    let mut shapes = drawing.shapes();
    label(&mut shapes, &view, drawing.lines(), drawing.names());
    shapes.0.iter().for_each(|shape| svg.shape(shape));
    legend(&mut svg, robot, [62.0, width - 20.0, height - 14.0]);
    svg.finish()
}

/// Figure 8: the posture of each working mode, in the sample configuration found in it.
pub fn postures(robot: &Robot, modes: &[ModeReport]) -> String {
    let columns = modes.len().min(4);
    let rows = modes.len().div_ceil(columns.max(1));
    let (cell_w, cell_h) = (270.0, 270.0);
    let (width, height) = (20.0 + columns as f64 * cell_w, 24.0 + rows as f64 * cell_h);
    let mut svg = Svg::new("postures", width, height, &format!("Working modes of robot {}", robot.name));
    let skeletons: Vec<Option<Skeleton>> =
        modes.iter().map(|m| m.sample.as_ref().map(|s| Skeleton::at(robot, &s.pose, &s.q))).collect();
    let drawn: Vec<&Skeleton> = skeletons.iter().flatten().collect();
    for (k, (report, skeleton)) in modes.iter().zip(&skeletons).enumerate() {
        let (left, top) = (20.0 + (k % columns) as f64 * cell_w, 12.0 + (k / columns) as f64 * cell_h);
        let title = format!("Mf{} ({})", report.number, signs(&report.mode.to_string()));
        match skeleton {
            Some(skeleton) => {
                let view = View::fit(robot, &drawn, [left + 40.0, top + 22.0, cell_w - 60.0, cell_h - 66.0]);
                view.backdrop(&mut svg, &title, &robot.length_unit);
                let drawing = Drawing { robot, skeleton, view: &view, large: false };
                drawing.shapes().0.iter().for_each(|shape| svg.shape(shape));
            }
            None => {
                let word = match report.reachable {
                    Reachable::No => "not reachable (proved)",
                    Reachable::Undecided => "reachability undecided",
                    Reachable::Yes => "reachable, no sample",
                };
                let middle = [left + 40.0 + (cell_w - 60.0) / 2.0, top + 15.0];
                svg.text(middle, Anchor::Middle, 12.0, "font-weight:600", &title);
                svg.text([middle[0], top + cell_h / 2.0], Anchor::Middle, 12.0, "fill:#777", word);
            }
        }
    }
    svg.finish()
}

/// A mode's name with a minus sign as wide as the plus.
pub fn signs(mode: &str) -> String {
    mode.replace('-', "−")
}

/// How space is projected on the paper.
pub(super) struct View {
    pub chart: Chart,
    /// Rows: the paper's right and up, in base coordinates.
    project: [Point; 2],
    pub flat: bool,
    sphere: bool,
}

impl View {
    /// A view in a box of pixels (left, top, width, height) that shows all the skeletons.
    pub fn fit(robot: &Robot, skeletons: &[&Skeleton], [left, top, width, height]: [f64; 4]) -> Self {
        let flat = robot.platform.space() == 2;
        let (sin_a, cos_a) = (-0.95_f64).sin_cos();
        let (sin_e, cos_e) = 0.42_f64.sin_cos();
        let project = if flat {
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
        } else {
            [[-sin_a, cos_a, 0.0], [-sin_e * cos_a, -sin_e * sin_a, cos_e]]
        };
        let sphere = robot.platform == Platform::TurningBody;
        let unit: Vec<Point> = if sphere {
            vec![[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]
        } else {
            vec![]
        };
        let round = solid_points(robot);
        let points: Vec<Point> =
            skeletons.iter().flat_map(|s| s.points()).chain(unit).chain(round).chain([[0.0; 3]]).collect();
        let range = |k: usize| {
            let of = || points.iter().map(|p| dot(project[k], *p));
            let (lo, hi) = (of().fold(f64::MAX, f64::min), of().fold(f64::MIN, f64::max));
            (lo, hi.max(lo + 1e-12))
        };
        let (mut x, mut y) = (range(0), range(1));
        let margin = 0.14 * (x.1 - x.0).max(y.1 - y.0);
        (x, y) = ((x.0 - margin, x.1 + margin), (y.0 - margin, y.1 + margin));
        // Fill the box: equal scale leaves room along one axis.
        let scale = ((x.1 - x.0) / width).max((y.1 - y.0) / height);
        let grow = |r: (f64, f64), px: f64| (0.5 * (r.0 + r.1 - scale * px), 0.5 * (r.0 + r.1 + scale * px));
        let axis = |name: &str, range| Axis {
            label: format!("{name} [{}]", robot.length_unit),
            range,
            angle: false,
        };
        let chart =
            Chart { x: axis("x", grow(x, width)), y: axis("y", grow(y, height)), left, top, width, height };
        Self { chart, project, flat, sphere }
    }

    /// Returns the place of a point in the picture.
    pub fn at(&self, p: Point) -> [f64; 2] {
        self.chart.at([dot(self.project[0], p), dot(self.project[1], p)])
    }

    /// Axes in the plane, a scale bar in space but on the unit sphere, which has no unit.
    pub fn backdrop(&self, svg: &mut Svg, title: &str, unit: &str) {
        let c = &self.chart;
        if self.flat {
            c.frame(svg, title);
            return;
        }
        svg.text([c.left + c.width / 2.0, c.top - 7.0], Anchor::Middle, 12.0, "font-weight:600", title);
        if self.sphere {
            return;
        }
        let per_unit = c.width / c.x.span();
        let power = 10_f64.powf((60.0 / per_unit).log10().floor());
        let length = [1.0, 2.0, 5.0, 10.0]
            .map(|m| m * power)
            .into_iter()
            .find(|l| l * per_unit >= 45.0)
            .unwrap_or(power);
        let (x, y) = (c.left, c.top + c.height + 14.0);
        let style = format!("stroke:{INK};stroke-width:1.4");
        svg.line([x, y], [x + length * per_unit, y], &style);
        svg.line([x, y - 3.0], [x, y + 3.0], &style);
        svg.line([x + length * per_unit, y - 3.0], [x + length * per_unit, y + 3.0], &style);
        svg.text(
            [x + length * per_unit + 6.0, y + 4.0],
            Anchor::Start,
            10.0,
            "",
            &format!("{length} {unit}"),
        );
    }
}

/// How a configuration is drawn.
pub(super) struct Drawing<'a> {
    /// The robot,
    pub robot: &'a Robot,
    /// its configuration,
    pub skeleton: &'a Skeleton,
    /// and how it is seen.
    pub view: &'a View,
    /// Whether there is room for thick lines and for the names of axes.
    pub large: bool,
}

impl Drawing<'_> {
    /// Returns all but the names of points. Of one robot the same shapes in every configuration.
    pub fn shapes(&self) -> Shapes {
        let mut shapes = Shapes::default();
        let svg = &mut shapes;
        let spherical = self.robot.platform == Platform::TurningBody;
        if spherical {
            let c = self.view.at([0.0; 3]);
            svg.circle(c, self.view.pixels(1.0), &format!("fill:#f4f4f4;stroke:{SPHERE};stroke-width:1"));
        }
        self.solids(svg);
        for leg in &self.skeleton.legs {
            self.base(svg, leg);
        }
        let mut legs: Vec<usize> = (0..self.skeleton.legs.len()).collect();
        // In space the farther legs first; the view looks along the horizontal component of `project[1]`.
        legs.sort_by(|&i, &j| self.depth(j).total_cmp(&self.depth(i)));
        self.platform(svg);
        self.thick(svg);
        for k in legs {
            self.leg(svg, k);
        }
        self.frame(svg, [0.0; 3], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], INK);
        if self.robot.platform != Platform::PlanePoint {
            self.frame(svg, self.skeleton.origin, self.skeleton.axes, PLATFORM);
        }
        shapes
    }

    fn depth(&self, k: usize) -> f64 {
        let up = self.view.project[1];
        if self.view.flat { 0.0 } else { dot([up[0], up[1], 0.0], self.skeleton.legs[k].a) }
    }

    fn base(&self, svg: &mut Shapes, leg: &LegShape) {
        let a = self.view.at(leg.a);
        if let Some([from, to]) = leg.rail {
            svg.line(
                self.view.at(from),
                self.view.at(to),
                &format!("stroke:{BASE};stroke-width:2;stroke-dasharray:7 3"),
            );
            return;
        }
        let size = if self.large { 9.0 } else { 6.0 };
        let style = format!("fill:#ddd;stroke:{BASE};stroke-width:1");
        svg.polyline(&[a, [a[0] - size, a[1] + 1.5 * size], [a[0] + size, a[1] + 1.5 * size]], true, &style);
    }

    fn leg(&self, svg: &mut Shapes, k: usize) {
        let leg = &self.skeleton.legs[k];
        let thick = if self.large { 1.0 } else { 0.7 };
        let stroke = |colour: &str, width: f64| {
            format!("fill:none;stroke:{colour};stroke-width:{:.1};stroke-linecap:round", width * thick)
        };
        let arc = |a: Point, b: Point| -> Vec<[f64; 2]> {
            let spherical = self.robot.platform == Platform::TurningBody;
            let steps = if spherical { 24 } else { 1 };
            (0..=steps)
                .map(|i| {
                    let t = i as f64 / steps as f64;
                    let p = plus(times(1.0 - t, a), times(t, b));
                    self.view.at(if spherical { times(1.0 / dot(p, p).sqrt().max(1e-9), p) } else { p })
                })
                .collect()
        };
        match leg.b {
            Some(b) => {
                if self.robot.legs[k].actuator.is_angle() {
                    svg.polyline(&arc(leg.a, b), false, &stroke(CRANK, 5.0));
                }
                svg.polyline(&arc(b, leg.c), false, &stroke(ROD, 3.0));
                self.joint(svg, b, leg.rail.is_some());
            }
            None => {
                let half = plus(leg.a, times(0.55, minus(leg.c, leg.a)));
                svg.polyline(&arc(leg.a, leg.c), false, &stroke(ROD, 2.5));
                svg.polyline(&arc(leg.a, half), false, &stroke(CRANK, 6.0));
            }
        }
        if leg.rail.is_none() {
            self.joint(svg, leg.a, leg.b.is_some());
        }
        self.joint(svg, leg.c, false);
    }

    /// A passive joint is white, a driven one filled.
    fn joint(&self, svg: &mut Shapes, p: Point, driven: bool) {
        let (fill, r) = (if driven { CRANK } else { "#fff" }, if self.large { 4.5 } else { 3.0 });
        svg.circle(self.view.at(p), r, &format!("fill:{fill};stroke:{INK};stroke-width:1.1"));
    }

    fn platform(&self, svg: &mut Shapes) {
        if self.skeleton.is_point() {
            return;
        }
        let corners: Vec<[f64; 2]> = self.skeleton.legs.iter().map(|l| self.view.at(l.c)).collect();
        let style = format!(
            "fill:{PLATFORM};fill-opacity:0.25;stroke:{PLATFORM};stroke-width:2;stroke-linejoin:round"
        );
        svg.polyline(&corners, true, &style);
    }

    /// Length of a frame's axes.
    fn frame_length(&self) -> f64 {
        let share = if self.large { 0.1 } else { 0.12 };
        share * self.view.chart.x.span().min(self.view.chart.y.span())
    }

    fn frame(&self, svg: &mut Shapes, origin: Point, axes: [Point; 3], colour: &str) {
        let length = self.frame_length();
        let style = format!("stroke:{colour};stroke-width:1.2;fill:none");
        for (axis, name) in axes.into_iter().zip(["x", "y", "z"]).take(self.robot.platform.space()) {
            let (from, to) = (self.view.at(origin), self.view.at(plus(origin, times(length, axis))));
            svg.line(from, to, &style);
            let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
            // An axis that points at the reader has small barbs.
            let size = 5.0 / dx.hypot(dy).max(8.0);
            let (ux, uy) = (size * dx, size * dy);
            let barbs = [
                [to[0] - ux - 0.5 * uy, to[1] - uy + 0.5 * ux],
                to,
                [to[0] - ux + 0.5 * uy, to[1] - uy - 0.5 * ux],
            ];
            svg.polyline(&barbs, false, &style);
            if self.large {
                let at = [to[0] + 1.6 * ux, to[1] + 1.6 * uy + 3.5];
                svg.text(at, 11.0, &format!("font-style:italic;fill:{colour}"), name);
            }
        }
    }

    /// The points that have names.
    pub fn names(&self) -> Vec<(Point, String)> {
        let point = self.skeleton.is_point();
        let of_leg = |(k, leg): (usize, &LegShape)| {
            let index = subscript(k + 1);
            let c = (!point).then(|| (leg.c, format!("C{index}")));
            let b = leg.b.map(|b| (b, format!("B{index}")));
            [Some((leg.a, format!("A{index}"))), b, c].into_iter().flatten().collect::<Vec<_>>()
        };
        let mut names: Vec<_> = self.skeleton.legs.iter().enumerate().flat_map(of_leg).collect();
        if point {
            names.push((self.skeleton.legs[0].c, "C".into()));
        }
        names
    }

    /// The straight lines between the points that have names, and those of the frames.
    pub fn lines(&self) -> Vec<[Point; 2]> {
        let legs = &self.skeleton.legs;
        let mut lines: Vec<[Point; 2]> =
            legs.iter().flat_map(|l| [[l.a, l.b.unwrap_or(l.a)], [l.b.unwrap_or(l.a), l.c]]).collect();
        lines.extend((0..legs.len()).map(|k| [legs[k].c, legs[(k + 1) % legs.len()].c]));
        let length = self.frame_length();
        let base = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        lines.extend(base.map(|axis| [[0.0; 3], times(1.3 * length, axis)]));
        let origin = self.skeleton.origin;
        lines.extend(self.skeleton.axes.map(|axis| [origin, plus(origin, times(1.3 * length, axis))]));
        lines
    }
}

/// Names beside their points, clear of lines.
pub(super) fn label(shapes: &mut Shapes, view: &View, lines: Vec<[Point; 2]>, names: Vec<(Point, String)>) {
    let halo = "font-style:italic;paint-order:stroke;stroke:#fff;stroke-width:3px;stroke-linejoin:round";
    let mut labels = Labels::among(lines.into_iter().map(|line| line.map(|p| view.at(p))));
    for (p, name) in names {
        let [x, y] = labels.beside(view.at(p));
        shapes.text([x, y + 4.5], 13.0, halo, &name);
    }
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
