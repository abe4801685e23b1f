//! Figure 11: det A and the B_jj along a path. The curves are *numerical*; the obstacle is what intervals
//! found.

use super::axes::{Axis, Chart};
use super::maps::{styled_line, swatch};
use super::palette::{self, INK, OBSTACLE};
use super::robot::signs;
use super::svg::{Anchor, Svg};
use aspecta::motion::{Joined, Obstacle, PathCheck, ProfilePoint};
use aspecta::robot::Robot;
use aspecta::text::subscript;

/// Pixels the label of a point takes, so that neighbours do not run into each other.
const LABEL: f64 = 52.0;
/// Narrowest band an obstacle is drawn as, pixels.
const BAND: f64 = 3.0;
/// Radius of a sample that is not joined to others, pixels.
const DOT: f64 = 2.5;

/// det A and the B_jj, each divided by its largest modulus, over segment + t: Point k of the path is at k.
///
/// `points` is the number of poses of the path; the figure ends where the check does.
pub fn figure_11(robot: &Robot, check: &PathCheck, points: usize) -> String {
    let runs: Vec<_> = runs(&check.profile).collect();
    let apart = check.joined == Joined::None;
    let plot = Plot { robot, runs: &runs, obstacle: check.obstacle.as_ref(), points, apart };
    let last = plot.last_point();
    let mode = signs(&check.mode.to_string());
    let rest = if last < points { format!(", up to point {last} of {points}") } else { String::new() };
    let title = format!("{}, mode ({mode}): det A and B along the path{rest}", robot.name);
    plot.draw(&title).0.finish()
}

/// The data shown by figure 11.
pub(crate) struct Plot<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// The samples in stretches without a gap.
    pub runs: &'a [&'a [ProfilePoint]],
    /// The place where the path fails.
    pub obstacle: Option<&'a Obstacle>,
    /// The points of the whole path.
    pub points: usize,
    /// Whether they are not joined.
    pub apart: bool,
}

impl Plot<'_> {
    /// The figure, to draw on, and where its points are: [`along`] to the right and the values upward.
    pub fn draw(&self, title: &str) -> (Svg, Chart) {
        let (last, apart) = (self.last_point(), self.apart);
        let chart = Chart {
            x: Axis {
                label: if apart { "sample" } else { "segment + t, with t from 0 to 1 along each segment" }
                    .into(),
                range: if apart { (0.5, last as f64 + 0.5) } else { (1.0, last as f64) },
                angle: false,
            },
            y: Axis { label: "value / largest modulus".into(), range: (-1.25, 1.25), angle: false },
            left: 58.0,
            top: 26.0,
            width: 640.0,
            height: 340.0,
        };
        let mut svg = Svg::new("figure11", 714.0, 446.0, title);
        svg.open("class=\"zero\"");
        let [y0, y1] = [chart.x.range.0, chart.x.range.1].map(|x| chart.at([x, 0.0]));
        svg.line(y0, y1, &format!("fill:none;stroke:{INK};stroke-width:0.8"));
        svg.close();
        mark_points(&mut svg, &chart, last);
        let curves = curves(self.robot);
        chart.clip(&mut svg);
        if let Some(obstacle) = self.obstacle {
            band(&mut svg, &chart, obstacle, apart);
        }
        for curve in &curves {
            svg.open("class=\"curve\"");
            for run in self.runs {
                let line: Vec<_> = run.iter().map(|p| chart.at([along(p), (curve.value)(p)])).collect();
                if apart {
                    let style = format!("{};stroke-dasharray:none", curve.style);
                    line.iter().for_each(|at| svg.circle(*at, DOT, &style));
                } else {
                    svg.polyline(&line, false, &curve.style);
                }
            }
            svg.close();
        }
        svg.close();
        if let Some(obstacle) = self.obstacle {
            name_obstacle(&mut svg, self.robot, &chart, obstacle, apart);
        }
        chart.frame(&mut svg, title);
        legend(&mut svg, &curves, self.obstacle.is_some(), [chart.left, 426.0]);
        (svg, chart)
    }

    /// The number of the point at which the samples, or the obstacle, end.
    fn last_point(&self) -> usize {
        let segments = self.runs.iter().filter_map(|run| run.last()).map(|p| p.segment);
        let last = segments.chain(self.obstacle.map(|o| o.segment)).max().unwrap_or(1) + 1;
        last.min(self.points.max(2))
    }
}

/// Returns the position of a sample along the path.
pub(crate) fn along(p: &ProfilePoint) -> f64 {
    p.segment as f64 + p.t
}

/// One of the determinants.
pub(crate) struct Curve {
    /// The name as it is written.
    pub name: String,
    /// Of its line.
    style: String,
    /// Its colour.
    pub colour: &'static str,
    /// Its value over its largest modulus.
    pub value: Box<dyn Fn(&ProfilePoint) -> f64>,
}

/// det A and, told apart by colour and dashes, the B_jj.
pub(crate) fn curves(robot: &Robot) -> Vec<Curve> {
    const DASHES: [&str; 3] = ["7 3", "2 2.5", "9 3 2 3"];
    let style = |colour: &str, rest: &str| format!("fill:none;stroke:{colour};{rest};stroke-linejoin:round");
    let det = Curve {
        name: "det A".into(),
        style: style(INK, "stroke-width:2"),
        colour: INK,
        value: Box::new(|p| p.relative_det_a),
    };
    let leg = |j: usize| Curve {
        name: format!("B{0}{0}", subscript(j + 1)),
        colour: palette::hue(j + 1),
        style: style(
            palette::hue(j + 1),
            &format!("stroke-width:1.8;stroke-dasharray:{}", DASHES[j % DASHES.len()]),
        ),
        value: Box::new(move |p| p.relative_b[j]),
    };
    [det].into_iter().chain((0..robot.dof()).map(leg)).collect()
}

/// The samples in stretches without a gap: there are none where the path is out of reach.
pub(crate) fn runs(profile: &[ProfilePoint]) -> impl Iterator<Item = &[ProfilePoint]> {
    let steps = profile.windows(2).map(|w| along(&w[1]) - along(&w[0]));
    let step = steps.filter(|&s| s > 0.0).fold(f64::INFINITY, f64::min);
    profile.chunk_by(move |a, b| along(b) - along(a) < 1.5 * step)
}

/// A thin line at every point of the path, and the names of the last and of as many others as there is room
/// for.
fn mark_points(svg: &mut Svg, chart: &Chart, last: usize) {
    let between = chart.width / (last - 1) as f64;
    let every = (LABEL / between).ceil() as usize;
    for k in 1..=last {
        let [x, top] = chart.at([k as f64, chart.y.range.1]);
        svg.line([x, top], [x, top + chart.height], "fill:none;stroke:#bbb;stroke-width:0.6");
        let room = (k - 1) % every == 0 && x + 2.0 * LABEL <= chart.left + chart.width;
        if room || k == last {
            let (dx, anchor) = if k == last { (-4.0, Anchor::End) } else { (4.0, Anchor::Start) };
            svg.text([x + dx, top + 14.0], anchor, 10.0, "", &format!("Point {k}"));
        }
    }
}

/// Left and right edge of an obstacle, pixels.
fn edges(chart: &Chart, obstacle: &Obstacle, apart: bool) -> [f64; 2] {
    let at = |t: f64| chart.at([obstacle.segment as f64 + t, 0.0])[0];
    let (from, to) = if apart { (at(0.0), at(0.0)) } else { (at(obstacle.t.0), at(obstacle.t.1)) };
    let missing = (BAND - (to - from)).max(0.0) / 2.0;
    [from - missing, to + missing]
}

fn band(svg: &mut Svg, chart: &Chart, obstacle: &Obstacle, apart: bool) {
    let [from, to] = edges(chart, obstacle, apart);
    svg.open("class=\"obstacle\"");
    svg.rect(from, chart.top, to - from, chart.height, &format!("fill:{OBSTACLE};fill-opacity:0.55"));
    svg.close();
}

/// Beside the band, on the side with more room, below all curves.
fn name_obstacle(svg: &mut Svg, robot: &Robot, chart: &Chart, obstacle: &Obstacle, apart: bool) {
    let [from, to] = edges(chart, obstacle, apart);
    let bottom = chart.top + chart.height - 9.0;
    let right = from + to < 2.0 * chart.left + chart.width;
    let (x, anchor) = if right { (to + 5.0, Anchor::Start) } else { (from - 5.0, Anchor::End) };
    svg.text([x, bottom], anchor, 11.0, &format!("fill:{OBSTACLE}"), &obstacle.in_words(robot));
}

fn legend(svg: &mut Svg, curves: &[Curve], obstacle: bool, at: [f64; 2]) {
    let mut x = at[0];
    for curve in curves {
        x = styled_line(svg, [x, at[1]], &curve.style, &curve.name);
    }
    if obstacle {
        swatch(svg, [x, at[1]], OBSTACLE, "obstacle");
    }
}
