//! W- and Q-aspects of robots with two coordinates: figures 6, 7 and 9. Of slices with two free coordinates
//! the same without Q, where they are surfaces.

use super::axes::{Axis, Chart};
use super::barrier::Kind;
use super::contacts::{Key, name_contacts};
use super::level::simplify;
use super::palette::{self, INK, UNDECIDED};
use super::raster::{Label, Raster};
use super::robot::signs;
use super::survey::{Lines, Survey};
use super::svg::{Anchor, Number, Svg};
use aspecta::aspect::{Aspect, AspectId, DetSign};
use aspecta::kinematics::WorkingMode;
use std::f64::consts::TAU;
use std::fmt::{Display, Write};

/// Pixels round a plot for its texts; on the left more if the numbers there need it.
const LEFT: f64 = 48.0;
const TOP: f64 = 26.0;
const BELOW: f64 = 40.0;
const BESIDE: f64 = 10.0;
/// Least width of a figure with a legend.
pub(super) const LEGEND: f64 = 720.0;
/// The style of an aspect's number: legible on every colour.
pub(super) const NUMBER: &str =
    "font-weight:600;paint-order:stroke;stroke:#fff;stroke-width:2.5px;stroke-linejoin:round";
/// Height of the line that names a slice.
const HEADING: f64 = 20.0;

/// Figure 9: a row a mode, W and Q for det A > 0 and for det A < 0; without Q two modes a row.
pub fn figure_9(survey: &Survey<'_>) -> String {
    let modes: Vec<_> = survey.curves.iter().map(|curves| curves.mode).collect();
    let layout = Layout::new(survey, 225.0);
    let (width, height) = layout.size(2 * modes.len());
    let key = Key::of(survey, &modes);
    let size = (width, height + key.height());
    let spaces = if survey.joint_axes.is_some() { "W-aspects and Q-aspects" } else { "W-aspects" };
    let mut svg = open("figure9", size, &format!("{spaces} of {}", survey.robot.name), survey);
    for (k, &mode) in modes.iter().enumerate() {
        for (c, sign) in [DetSign::Positive, DetSign::Negative].into_iter().enumerate() {
            class_panels(&mut svg, survey, mode, sign, &layout.charts(2 * k + c));
        }
    }
    legend(&mut svg, survey, AspectId::new(1), [LEFT, height - 12.0]);
    key.draw(&mut svg, [LEFT, height + 5.0]);
    svg.finish()
}

/// Returns one class: its W-aspects beside its Q-aspects.
pub fn class(survey: &Survey<'_>, mode: WorkingMode, sign: DetSign) -> String {
    let layout = Layout::new(survey, 400.0);
    let (width, height) = layout.size(1);
    let key = Key::of(survey, &[mode]);
    let size = (width, height + key.height());
    let title = format!("Aspects of mode {} with {}", signs(&mode.to_string()), sign_text(sign));
    let mut svg = open(&class_name(survey, mode, sign), size, &title, survey);
    class_panels(&mut svg, survey, mode, sign, &layout.charts(0));
    let first = survey.of(mode, sign).and_then(|(map, _)| map.class.aspects.first());
    legend(&mut svg, survey, first.map_or(AspectId::new(1), |a| a.id), [LEFT, height - 12.0]);
    key.draw(&mut svg, [LEFT, height + 5.0]);
    svg.finish()
}

/// The file name of a class's figure, without its extension.
pub fn class_name(survey: &Survey<'_>, mode: WorkingMode, sign: DetSign) -> String {
    let number = survey.robot.working_modes().iter().position(|&m| m == mode).map_or(0, |k| k + 1);
    let sign = if sign == DetSign::Positive { "positive" } else { "negative" };
    format!("aspects-mf{number}-{sign}")
}

/// `det A > 0` or `det A < 0`.
pub fn sign_text(sign: DetSign) -> &'static str {
    if sign == DetSign::Positive { "det A > 0" } else { "det A < 0" }
}

/// An empty figure; of a slice it says of which.
fn open(id: &str, size: (f64, f64), title: &str, survey: &Survey<'_>) -> Svg {
    let Some(slice) = &survey.slice else { return Svg::new(id, size.0, size.1, title) };
    let mut svg = Svg::new(id, size.0, size.1, &format!("{title}, {slice}"));
    svg.text([LEFT, 14.0], Anchor::Start, 12.0, "font-weight:600", slice);
    svg
}

/// Pairs of plots, W beside Q if there is one, in rows of two pairs, or of four plots if they are single.
struct Layout {
    w: Chart,
    q: Option<Chart>,
    /// The top of the first row.
    top: f64,
    /// Pixels left of a plot.
    left: f64,
    /// The width of the legend.
    legend: f64,
}

impl Layout {
    /// Plots of at most `side` pixels.
    fn new(survey: &Survey<'_>, side: f64) -> Self {
        let fit = |[x, y]: [Axis; 2]| Chart::fit(x, y, 0.0, 0.0, side, side);
        let top = if survey.slice.is_some() { HEADING } else { 0.0 };
        let (w, q) = (fit(survey.pose_axes.clone()), survey.joint_axes.clone().map(fit));
        let left = q.iter().chain([&w]).map(Chart::margin).fold(LEFT, f64::max);
        let legend = LEGEND + limits(kinds(survey)).map(|(_, name)| sample_width(name)).sum::<f64>();
        Self { w, q, top, left, legend }
    }

    /// Width of a pair.
    fn pair(&self) -> f64 {
        let width = |chart: &Chart| self.left + BESIDE + chart.width;
        width(&self.w) + self.q.as_ref().map_or(0.0, width)
    }

    /// Height of a row.
    fn row(&self) -> f64 {
        TOP + self.w.height.max(self.q.as_ref().map_or(0.0, |q| q.height)) + BELOW
    }

    /// Pairs in a row.
    fn columns(&self) -> usize {
        if self.q.is_some() { 2 } else { 4 }
    }

    /// Width and height of a figure of so many pairs, and a legend below.
    fn size(&self, pairs: usize) -> (f64, f64) {
        let columns = self.columns().min(pairs);
        let width = (columns as f64 * self.pair() + 10.0).max(self.legend);
        (width, self.top + pairs.div_ceil(columns) as f64 * self.row() + 34.0)
    }

    /// The plots of W and Q of a pair, by its number from 0.
    fn charts(&self, number: usize) -> (Chart, Option<Chart>) {
        let (column, row) = (number % self.columns(), number / self.columns());
        let left = self.left + column as f64 * self.pair();
        let top = self.top + TOP + row as f64 * self.row();
        let q_left = left + self.w.width + BESIDE + self.left;
        let q = self.q.clone().map(|q| Chart { left: q_left, top, ..q });
        (Chart { left, top, ..self.w.clone() }, q)
    }
}

fn class_panels(
    svg: &mut Svg,
    survey: &Survey<'_>,
    mode: WorkingMode,
    sign: DetSign,
    (chart, q_chart): &(Chart, Option<Chart>),
) {
    let Some((map, curves)) = survey.of(mode, sign) else { return };
    let name = format!("({}), {}", signs(&mode.to_string()), sign_text(sign));
    let aspects = &map.class.aspects;

    fill(svg, chart, &map.w, label_colour);
    draw_lines(svg, chart, &curves.w, [false; 2]);
    name_contacts(svg, chart, &curves.w, [false; 2]);
    number(svg, chart, aspects, |a| survey.axes.map(|k| a.sample.pose[k]));
    chart.frame(svg, &format!("W {name}"));

    let (Some(chart), Some(q)) = (q_chart, &map.q) else { return };
    fill(svg, chart, q, label_colour);
    let turns = [chart.x.angle, chart.y.angle];
    draw_lines(svg, chart, &curves.q, turns);
    name_contacts(svg, chart, &curves.q, turns);
    number(svg, chart, aspects, |a| [a.sample.q[0], a.sample.q[1]]);
    chart.frame(svg, &format!("Q {name}"));
}

pub(super) fn label_colour(label: Label) -> Option<&'static str> {
    match label {
        Label::Outside => None,
        Label::Undecided => Some(UNDECIDED),
        Label::Aspect(id) => Some(palette::aspect(id)),
    }
}

/// Fills the pixels of every label that has a colour.
pub(crate) fn fill<T: Copy + Ord, C: Display>(
    svg: &mut Svg,
    chart: &Chart,
    raster: &Raster<T>,
    colour: impl Fn(T) -> Option<C>,
) {
    let (columns, rows) = raster.size();
    chart.open_lattice(svg, columns, rows);
    for label in raster.labels() {
        if let Some(colour) = colour(label) {
            svg.path(&raster.outline(label), &format!("fill:{colour}"));
        }
    }
    svg.close();
}

/// Curves, within the plot; `turns` names the coordinates in which they wrap round. Unwound lines are drawn
/// once for each turn that brings a part of them into the plot.
pub(crate) fn draw_lines(svg: &mut Svg, chart: &Chart, lines: &Lines, turns: [bool; 2]) {
    chart.clip(svg);
    let styles = [Kind::Limit, Kind::Contact(0), Kind::Serial, Kind::Parallel].map(line_style);
    for style in styles {
        let of_style = lines.iter().filter(|l| line_style(l.0) == style).map(|l| &l.1);
        draw_styled(svg, chart, of_style, turns, style);
    }
    svg.close();
}

/// Curves in one style; else as [`draw_lines`], but not clipped.
pub(super) fn draw_styled<'a>(
    svg: &mut Svg,
    chart: &Chart,
    lines: impl Iterator<Item = &'a Vec<[f64; 2]>>,
    turns: [bool; 2],
    style: &str,
) {
    let mut d = String::new();
    for line in lines {
        let copies = [0, 1]
            .map(|k| copies(line.iter().map(|p| p[k]), if turns[k] { chart_range(chart, k) } else { None }));
        for (i, j) in copies[0].clone().flat_map(|i| copies[1].clone().map(move |j| (i, j))) {
            let shifted: Vec<[f64; 2]> =
                line.iter().map(|p| chart.at([p[0] + TAU * i as f64, p[1] + TAU * j as f64])).collect();
            for (k, p) in simplify(&shifted, 0.05).iter().enumerate() {
                let _ = write!(d, "{}{} {}", if k == 0 { 'M' } else { 'L' }, Number(p[0]), Number(p[1]));
            }
        }
    }
    if !d.is_empty() {
        svg.path(&d, style);
    }
}

fn chart_range(chart: &Chart, axis: usize) -> Option<(f64, f64)> {
    Some(if axis == 0 { chart.x.range } else { chart.y.range })
}

/// The whole turns to add to a line so that all of it is seen once in the range.
fn copies(
    values: impl Iterator<Item = f64> + Clone,
    range: Option<(f64, f64)>,
) -> std::ops::RangeInclusive<i64> {
    let Some((lo, hi)) = range else { return 0..=0 };
    let (least, most) = (values.clone().fold(f64::MAX, f64::min), values.fold(f64::MIN, f64::max));
    ((lo - most) / TAU).ceil() as i64..=((hi - least) / TAU).floor() as i64
}

pub(super) fn line_style(kind: Kind) -> &'static str {
    match kind {
        Kind::Serial => "fill:none;stroke:#222;stroke-width:1.2;stroke-dasharray:5 2.5;stroke-linejoin:round",
        Kind::Parallel => "fill:none;stroke:#222;stroke-width:1.4;stroke-linejoin:round",
        Kind::Limit => "fill:none;stroke:#222;stroke-width:1;stroke-dasharray:1.2 2.2;stroke-linejoin:round",
        Kind::Contact(_) => {
            "fill:none;stroke:#222;stroke-width:1;stroke-dasharray:5 1.6 1.2 1.6;stroke-linejoin:round"
        }
    }
}

/// The aspects' numbers at their sample configurations, so that none is overlooked however small.
pub(super) fn number(svg: &mut Svg, chart: &Chart, aspects: &[Aspect], at: impl Fn(&Aspect) -> [f64; 2]) {
    for aspect in aspects {
        let [x, y] = chart.at(at(aspect));
        svg.circle([x, y], 1.8, &format!("fill:{INK};stroke:#fff;stroke-width:0.8"));
        let high = y < chart.top + 14.0;
        let far = x > chart.left + chart.width - 16.0;
        let (dx, anchor) = if far { (-4.0, Anchor::End) } else { (4.0, Anchor::Start) };
        svg.text(
            [x + dx, if high { y + 11.0 } else { y - 3.0 }],
            anchor,
            11.0,
            NUMBER,
            &aspect.id.to_string(),
        );
    }
}

/// The legend; `shown` is an aspect in the figure.
fn legend(svg: &mut Svg, survey: &Survey<'_>, shown: AspectId, at: [f64; 2]) {
    let mut x = swatch(svg, at, palette::aspect(shown), "aspect, numbered at a sample");
    x = swatch(svg, [x, at[1]], UNDECIDED, "undecided cells");
    x = sample_line(svg, [x, at[1]], Kind::Parallel, "det A = 0 (parallel)");
    x = sample_line(svg, [x, at[1]], Kind::Serial, "det B = 0 (serial)");
    limit_samples(svg, [x, at[1]], kinds(survey));
}

fn kinds(survey: &Survey<'_>) -> impl Iterator<Item = Kind> + Clone {
    survey.curves.iter().flat_map(|curves| &curves.w).map(|line| line.0)
}

/// Samples of lines that are no singularities, if there are some.
pub(crate) fn limit_samples(svg: &mut Svg, at: [f64; 2], kinds: impl Iterator<Item = Kind> + Clone) {
    limits(kinds).fold(at[0], |x, (kind, name)| sample_line(svg, [x, at[1]], kind, name));
}

/// The kinds of lines that are no singularities, and their names.
fn limits(kinds: impl Iterator<Item = Kind> + Clone) -> impl Iterator<Item = (Kind, &'static str)> {
    let all = [(Kind::Limit, "joint limit"), (Kind::Contact(0), "contact")];
    all.into_iter().filter(move |(of, _)| kinds.clone().any(|kind| line_style(kind) == line_style(*of)))
}

pub(crate) fn swatch(svg: &mut Svg, at: [f64; 2], colour: &str, text: &str) -> f64 {
    svg.rect(at[0], at[1] - 9.0, 18.0, 10.0, &format!("fill:{colour};stroke:#666;stroke-width:0.4"));
    svg.text([at[0] + 24.0, at[1]], Anchor::Start, 11.0, "", text);
    at[0] + 42.0 + 5.6 * text.chars().count() as f64
}

pub(crate) fn sample_line(svg: &mut Svg, at: [f64; 2], kind: Kind, text: &str) -> f64 {
    styled_line(svg, at, line_style(kind), text)
}

pub(super) fn styled_line(svg: &mut Svg, at: [f64; 2], style: &str, text: &str) -> f64 {
    svg.line([at[0], at[1] - 4.0], [at[0] + 24.0, at[1] - 4.0], style);
    svg.text([at[0] + 30.0, at[1]], Anchor::Start, 11.0, "", text);
    at[0] + sample_width(text)
}

/// Returns the distance from a sample line to the next, if this text stands at it.
pub(super) fn sample_width(text: &str) -> f64 {
    48.0 + 5.6 * text.chars().count() as f64
}

/// How many configurations of a set of classes lie over a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Over {
    Certainly(usize),
    Undecided,
}

fn overlay<'a>(rasters: impl Iterator<Item = &'a Raster<Label>> + Clone) -> Option<Raster<Over>> {
    let (columns, rows) = rasters.clone().next()?.size();
    Some(Raster::from_fn(columns, rows, |c, r| {
        let labels = rasters.clone().map(|raster| raster.at(c, r));
        let sure = labels.clone().filter(|l| matches!(l, Label::Aspect(_))).count();
        let doubtful = sure == 0 && labels.clone().any(|l| l == Label::Undecided);
        if doubtful { Over::Undecided } else { Over::Certainly(sure) }
    }))
}

/// Figures 6 and 7: the aspects of Definition 5 (det A of one sign, all modes together) in W and in Q. The
/// shade counts the configurations over a place.
pub fn parallel_aspects(survey: &Survey<'_>) -> String {
    let rows = [DetSign::Positive, DetSign::Negative].map(|s| (sign_text(s).to_owned(), Some(s), None));
    overlaid(survey, "parallel-aspects", "Parallel aspects (Definition 5)", &rows)
}

/// The aspects of Definition 6 (one mode, both signs of det A) in W and in Q, counted alike.
pub fn serial_aspects(survey: &Survey<'_>) -> String {
    let modes = survey.curves.iter().map(|curves| curves.mode);
    let rows: Vec<_> = modes.map(|m| (format!("mode ({})", signs(&m.to_string())), None, Some(m))).collect();
    overlaid(survey, "serial-aspects", "Serial aspects (Definition 6)", &rows)
}

type Row = (String, Option<DetSign>, Option<WorkingMode>);

fn overlaid(survey: &Survey<'_>, id: &str, title: &str, rows: &[Row]) -> String {
    let layout = Layout::new(survey, 240.0);
    let size = layout.size(rows.len());
    let mut svg = open(id, size, title, survey);
    let mut most = 1;
    for (k, (name, sign, mode)) in rows.iter().enumerate() {
        let chosen = || {
            let wanted = |c: &&super::survey::ClassMap<'_>| {
                sign.is_none_or(|s| s == c.class.det_a) && mode.is_none_or(|m| m == c.class.mode)
            };
            survey.classes.iter().filter(wanted)
        };
        let (chart, q_chart) = layout.charts(k);
        let w = ("W", overlay(chosen().map(|c| &c.w)), Some(chart));
        let q = ("Q", overlay(chosen().filter_map(|c| c.q.as_ref())), q_chart);
        for (space, counts, chart) in [w, q] {
            let (Some(counts), Some(chart)) = (counts, chart) else { continue };
            for over in counts.labels() {
                if let Over::Certainly(n) = over {
                    most = most.max(n);
                }
            }
            fill(&mut svg, &chart, &counts, |over| match over {
                Over::Certainly(0) => None,
                Over::Certainly(n) => Some(palette::count(n)),
                Over::Undecided => Some(UNDECIDED),
            });
            chart.frame(&mut svg, &format!("{space}, {name}"));
        }
    }
    let mut x = LEFT;
    for n in 1..=most {
        let text = if n == 1 { "1 configuration".into() } else { n.to_string() };
        x = swatch(&mut svg, [x, size.1 - 12.0], palette::count(n), &text);
    }
    swatch(&mut svg, [x, size.1 - 12.0], UNDECIDED, "undecided");
    svg.finish()
}
