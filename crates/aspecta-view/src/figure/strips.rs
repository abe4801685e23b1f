//! Slices with one free coordinate: a strip for each class.

use super::axes::{Axis, Chart};
use super::maps::{NUMBER, sign_text, swatch};
use super::palette::{self, UNDECIDED};
use super::robot::signs;
use super::survey::{pose_axis, slice_name};
use super::svg::{Anchor, Svg};
use aspecta::aspect::{Analysis, AspectClass, AspectId, Cell};

/// Pixels left of the strips, for their names, and above them.
const LEFT: f64 = 132.0;
const TOP: f64 = 32.0;
/// Length of a strip, its height, and the distance of two.
const LENGTH: f64 = 620.0;
const HEIGHT: f64 = 14.0;
const STEP: f64 = 20.0;
/// Least length of a coloured part, so that none is overlooked.
const LEAST: f64 = 1.0;

/// The aspects of every class along the one coordinate that varies. Certified but for parts shorter than a
/// pixel, which are drawn a pixel long, undecided ones above the others.
pub fn strips(analysis: &Analysis, cells: &[Vec<Cell>]) -> String {
    let axis = analysis.window.axes()[0];
    let height = STEP * analysis.classes.len() as f64;
    let slice = slice_name(&analysis.fixed).unwrap_or_default();
    let title = format!("W-aspects of {}, {slice}", analysis.robot.name);
    let mut svg = Svg::new("strips", LEFT + LENGTH + 20.0, TOP + height + 74.0, &title);
    let x = pose_axis(&analysis.robot, &analysis.window, axis);
    let y = Axis { label: String::new(), range: (0.0, 1.0), angle: false };
    let chart = Chart { x, y, left: LEFT, top: TOP, width: LENGTH, height };
    for (k, (class, cells)) in analysis.classes.iter().zip(cells).enumerate() {
        strip(&mut svg, &chart, class, cells, TOP + STEP * k as f64 + 0.5 * (STEP - HEIGHT));
        number(&mut svg, &chart, class, axis, TOP + STEP * (k as f64 + 0.5) + 4.0);
    }
    chart.frame_across(&mut svg, &slice);
    let below = TOP + height + 60.0;
    let x =
        swatch(&mut svg, [LEFT, below], palette::aspect(AspectId::new(1)), "aspect, numbered at a sample");
    swatch(&mut svg, [x, below], UNDECIDED, "undecided cells");
    svg.finish()
}

/// One class: its name and its parts, neighbouring cells of one aspect together.
fn strip(svg: &mut Svg, chart: &Chart, class: &AspectClass, cells: &[Cell], top: f64) {
    let name = format!("({}), {}", signs(&class.mode.to_string()), sign_text(class.det_a));
    svg.text([LEFT - 8.0, top + HEIGHT - 3.0], Anchor::End, 11.0, "", &name);
    let mut sorted: Vec<&Cell> = cells.iter().collect();
    sorted.sort_by(|a, b| a.aspect.is_none().cmp(&b.aspect.is_none()).then(a.lo[0].total_cmp(&b.lo[0])));
    for part in sorted.chunk_by(|a, b| a.aspect == b.aspect && a.hi[0] == b.lo[0]) {
        let [from, to] = [part[0].lo[0], part[part.len() - 1].hi[0]].map(|x| chart.at([x, 0.0])[0]);
        let missing = (LEAST - (to - from)).max(0.0) / 2.0;
        let colour = part[0].aspect.map_or(UNDECIDED, palette::aspect);
        svg.rect(from - missing, top, to - from + 2.0 * missing, HEIGHT, &format!("fill:{colour}"));
    }
}

/// The aspects' numbers at their sample configurations.
fn number(svg: &mut Svg, chart: &Chart, class: &AspectClass, axis: usize, baseline: f64) {
    for aspect in &class.aspects {
        let x = chart.at([aspect.sample.pose[axis], 0.0])[0];
        svg.text([x, baseline], Anchor::Middle, 11.0, NUMBER, &aspect.id.to_string());
    }
}
