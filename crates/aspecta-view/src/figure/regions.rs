//! Basic regions and uniqueness domains (figures 12 to 15): one map of a robot with two coordinates, slices
//! of one with three.
//!
//! *Numerical*: colours are true to a cell of the grid, lines to the mesh they are cut from.

use super::axes::{Axis, Chart};
use super::cut::Cut;
use super::hues::Hues;
use super::legend::Legend;
use super::maps::{LEGEND, NUMBER, draw_lines, draw_styled, fill, sign_text};
use super::palette::{CHARACTERISTIC, PALE, UNDECIDED};
use super::raster::Raster;
use super::robot::signs;
use super::section::{Mesh, Plane};
use super::slices::{Panels, place};
use super::survey::pose_axis;
use super::svg::{Anchor, Svg};
use crate::words::{measure_unit, number as number_text};
use aspecta::domain::{BasicRegion, Domains, Map, OUTSIDE, RegionId};

/// Most slices in a figure, and how many are in a row.
pub(super) const SLICES: usize = 12;
pub(super) const COLUMNS: usize = 4;
/// Longest side of a slice, and of the map of a robot with two coordinates, pixels.
pub(super) const SLICE: f64 = 230.0;
pub(super) const MAP: f64 = 560.0;
/// Room for the heading.
pub(super) const HEADING: f64 = 20.0;
/// Width of a region's entry in the legend.
pub(super) const ENTRY: f64 = 190.0;
/// Least side of the square in which a label stands, and width of a character, pixels.
const ROOM: f64 = 12.0;
const CHARACTER: f64 = 6.5;
const CAPTION: &str = "n: direct solutions in the aspect; regions of one hue have coincident images";
const SLICE_CAPTION: &str =
    "n: direct solutions in the class, on the slice or off it; one hue: coincident images";

/// The basic regions of an aspect.
pub fn regions(cut: &Cut<'_>) -> String {
    let colours = colours(cut.domains);
    sheet(cut, "regions", "Basic regions", &colours, &|_| true)
}

/// The largest uniqueness domain of an aspect: its regions in their colours, the others pale. Without any,
/// all are.
pub fn uniqueness(cut: &Cut<'_>) -> String {
    let largest = cut.domains.uniqueness.first().map_or(&[][..], |domain| &domain.regions);
    let mut colours = colours(cut.domains);
    for (region, colour) in cut.domains.regions.iter().zip(&mut colours) {
        if !largest.contains(&region.number) {
            PALE.clone_into(colour);
        }
    }
    sheet(cut, "uniqueness", "Largest uniqueness domain", &colours, &|region| largest.contains(&region))
}

/// A colour for each region.
pub(super) fn colours(domains: &Domains) -> Vec<String> {
    let hues = Hues::new(domains);
    (0..domains.regions.len()).map(|region| hues.region(region)).collect()
}

fn sheet(
    cut: &Cut<'_>,
    name: &str,
    title: &str,
    colours: &[String],
    is_shown: &dyn Fn(RegionId) -> bool,
) -> String {
    let Cut { map: Map { robot, window, .. }, domains, .. } = cut;
    let grid = &domains.labels.grid;
    let in_plane = grid.axes() == 2;
    let layers = if in_plane { vec![0] } else { layers(domains) };
    let count = SLICES.min(layers.len());
    let axes = [0, 1].map(|axis| {
        let k = grid.coordinate(axis);
        let low = grid.pose(0)[k] - 0.5 * grid.step[axis];
        let range = (low, low + grid.step[axis] * grid.count[axis] as f64);
        Axis { range, ..pose_axis(robot, window, k) }
    });
    let third = grid.coordinate(2);
    let (side, columns) = if in_plane { (MAP, 1) } else { (SLICE, COLUMNS) };
    let held: Vec<String> = window.held().map(|(k, value)| place(robot, k, value)).collect();
    let top = if held.is_empty() { HEADING } else { 2.0 * HEADING };
    let panels = Panels::new(axes, side, columns, top);
    let (width, height) = panels.size(count);
    let width = width.max(LEGEND);
    let entries = entries(cut, colours, is_shown);
    let hidden = entries.len() < domains.regions.len();
    let legend = Legend {
        cut,
        entry: ENTRY,
        notes: hidden.then_some((PALE, "other regions")).into_iter().chain(thin(domains)).collect(),
        caption: if held.is_empty() { CAPTION } else { SLICE_CAPTION },
        of: "",
        thin: (!cut.surface.simplices.is_empty()).then_some("characteristic surface"),
        left: panels.left,
        right: width,
        entries,
    };
    let title = heading(title, domains);
    let id = format!("{name}-{}", domains.aspect);
    let mut svg = Svg::new(&id, width, height + legend.height() + 12.0, &title);
    svg.text([panels.left, 16.0], Anchor::Start, 13.0, "font-weight:600", &title);
    if !held.is_empty() {
        svg.text([panels.left, 16.0 + HEADING], Anchor::Start, 11.0, "", &held.join(", "));
    }
    let [boundary, surface] = [cut.boundary, cut.surface].map(|mesh| Mesh::of_poses(mesh, window));
    for k in 0..count {
        let layer = layers[(2 * k + 1) * layers.len() / (2 * count)];
        let at = (!in_plane).then(|| grid.pose(layer * grid.count[0] * grid.count[1])[third]);
        let plane = at.map(|at| Plane { at, glued: window.glued[third] });
        let chart = panels.chart(k);
        let raster = layer_of(domains, layer);
        fill(&mut svg, &chart, &raster, |label| colour(colours, label));
        let inner: Vec<_> = surface.kinds(plane).into_iter().map(|(_, line)| line).collect();
        draw_surfaces(&mut svg, &chart, &boundary, plane, &inner);
        number(&mut svg, &chart, &raster, |label| {
            let number = label as usize + 1;
            (number <= domains.regions.len() && is_shown(RegionId::new(number))).then(|| number.to_string())
        });
        chart.frame(&mut svg, &at.map_or(String::new(), |at| place(robot, third, at)));
    }
    legend.draw(&mut svg, height + 10.0);
    svg.finish()
}

/// Returns the heading of a picture: what it shows, and of which aspect.
pub(super) fn heading(what: &str, domains: &Domains) -> String {
    let mode = signs(&domains.mode.to_string());
    format!("{what} of aspect {}: mode ({mode}), {}", domains.aspect, sign_text(domains.det_a))
}

/// The note on nodes without a region, if there are any.
pub(super) fn thin(domains: &Domains) -> Option<(&'static str, &'static str)> {
    (domains.unresolved.parts > 0).then_some((UNDECIDED, "thinner than two cells"))
}

/// The layers across the third coordinate that meet the aspect.
fn layers(domains: &Domains) -> Vec<usize> {
    let [columns, rows, _] = domains.labels.grid.count;
    let layers = domains.labels.region.chunks(columns * rows).enumerate();
    layers.filter(|(_, nodes)| nodes.iter().any(|&r| r != OUTSIDE)).map(|(layer, _)| layer).collect()
}

/// The labels of the nodes of a layer across the third coordinate.
fn layer_of(domains: &Domains, layer: usize) -> Raster<u32> {
    let [columns, rows, _] = domains.labels.grid.count;
    let region = &domains.labels.region;
    Raster::from_fn(columns, rows, |c, r| region[c + columns * (r + rows * layer)])
}

fn colour(colours: &[String], label: u32) -> Option<&str> {
    (label != OUTSIDE).then(|| colours.get(label as usize).map_or(UNDECIDED, String::as_str))
}

/// Lines of the boundary over thin ones.
pub(super) fn draw_surfaces(
    svg: &mut Svg,
    chart: &Chart,
    boundary: &Mesh<'_>,
    plane: Option<Plane>,
    thin: &[Vec<[f64; 2]>],
) {
    chart.clip(svg);
    draw_styled(svg, chart, thin.iter(), boundary.turns, CHARACTERISTIC);
    svg.close();
    draw_lines(svg, chart, &boundary.kinds(plane), boundary.turns);
}

/// The text of each label, if it has one, in the middle of the largest square of it, if there is room.
pub(super) fn number(
    svg: &mut Svg,
    chart: &Chart,
    raster: &Raster<u32>,
    text: impl Fn(u32) -> Option<String>,
) {
    let pixel = [chart.width / raster.size().0 as f64, chart.height / raster.size().1 as f64];
    for (label, corner, side) in raster.squares() {
        let Some(text) = text(label) else { continue };
        let room = pixel.map(|pixel| side as f64 * pixel);
        if room[0] < ROOM.max(CHARACTER * text.chars().count() as f64) || room[1] < ROOM {
            continue;
        }
        let half = 0.5 * side as f64;
        let x = chart.left + (corner.0 as f64 + half) * pixel[0];
        let y = chart.top + chart.height - (corner.1 as f64 + half) * pixel[1];
        svg.text([x, y + 4.0], Anchor::Middle, 11.0, NUMBER, &text);
    }
}

/// The entries of regions, by their numbers.
pub(super) fn entries(
    cut: &Cut<'_>,
    colours: &[String],
    is_shown: &dyn Fn(RegionId) -> bool,
) -> Vec<(String, String)> {
    let unit = measure_unit(&cut.domains.unit);
    let shown = cut.domains.regions.iter().filter(|region| is_shown(region.number));
    let entry = |region: &BasicRegion| {
        let measure = number_text(region.measure);
        let text = format!("{}: n = {}, {measure} {unit}", region.number, region.solutions);
        (colours[region.number.number() - 1].clone(), text)
    };
    shown.map(entry).collect()
}
