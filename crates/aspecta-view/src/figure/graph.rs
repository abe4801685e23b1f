//! The graph of aspects joined through serial singularities.

use super::palette::{self, INK};
use super::robot::signs;
use super::svg::{Anchor, Svg};
use aspecta::aspect::{AspectId, DetSign};
use aspecta::motion::modes::{GraphAspect, ModeGraph};
use aspecta::robot::{LegIndex, Robot};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Radius of a node, pixels.
const NODE: f64 = 23.0;
/// Room round the rings of nodes.
const MARGIN: f64 = 60.0;
/// Line styles of legs, cyclic: legs are told apart without colours too.
const DASHES: [&str; 6] = ["", "7 4", "2 3", "9 3 2 3", "12 5", "4 2"];

/// Two rings, one per sign of det A, which no crossing joins; a line between two aspects is a crossing, by
/// the leg that changes its posture.
pub fn mode_graph(robot: &Robot, graph: &ModeGraph) -> String {
    let of = |sign: DetSign| graph.aspects.iter().filter(|a| a.det_a == sign).collect::<Vec<_>>();
    let rings = [of(DetSign::Positive), of(DetSign::Negative)];
    let most = rings.iter().map(Vec::len).max().unwrap_or(1).max(3) as f64;
    let radius = (most * 3.2 * NODE / TAU).max(90.0);
    let side = 2.0 * (radius + MARGIN);
    let title = format!("{}: aspects joined by changes of working mode", robot.name);
    let mut svg = Svg::new("modes", 2.0 * side, side + 44.0, &title);
    for (k, (ring, sign)) in rings.iter().zip(["+", "\u{2212}"]).enumerate() {
        let centre = [side * (k as f64 + 0.5), 0.5 * side + 10.0];
        svg.text([centre[0], 18.0], Anchor::Middle, 13.0, "", &format!("det A {sign}"));
        draw_ring(&mut svg, graph, ring, centre, radius);
    }
    legend(&mut svg, robot, graph, [MARGIN, side + 26.0]);
    svg.finish()
}

fn draw_ring(svg: &mut Svg, graph: &ModeGraph, ring: &[&GraphAspect], centre: [f64; 2], radius: f64) {
    let at = |k: usize| {
        let angle = TAU * k as f64 / ring.len().max(1) as f64 - FRAC_PI_2;
        [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()]
    };
    let place = |id: AspectId| ring.iter().position(|aspect| aspect.id == id).map(at);
    for crossing in &graph.crossings {
        if let [Some(a), Some(b)] = crossing.aspects.map(place) {
            svg.line(a, b, &style(crossing.leg));
        }
    }
    for (k, aspect) in ring.iter().enumerate() {
        let [x, y] = at(k);
        let fill = palette::aspect(aspect.id);
        svg.circle([x, y], NODE, &format!("fill:#fff;stroke:{fill};stroke-width:4"));
        svg.text([x, y - 1.0], Anchor::Middle, 13.0, "font-weight:bold", &aspect.id.to_string());
        svg.text([x, y + 12.0], Anchor::Middle, 10.0, "", &signs(&aspect.mode.to_string()));
    }
}

/// The line of a leg's crossings.
fn style(leg: LegIndex) -> String {
    let dash = DASHES[leg.index() % DASHES.len()];
    let dash = if dash.is_empty() { String::new() } else { format!(";stroke-dasharray:{dash}") };
    format!("fill:none;stroke:{INK};stroke-width:1.6{dash}")
}

fn legend(svg: &mut Svg, robot: &Robot, graph: &ModeGraph, at: [f64; 2]) {
    let legs = (0..robot.dof()).map(LegIndex::new);
    let legs = legs.filter(|leg| graph.crossings.iter().any(|c| c.leg == *leg));
    let mut x = at[0];
    for leg in legs {
        svg.line([x, at[1] - 4.0], [x + 30.0, at[1] - 4.0], &style(leg));
        svg.text([x + 36.0, at[1]], Anchor::Start, 12.0, "", &format!("leg {leg} changes its posture"));
        x += 200.0;
    }
}
