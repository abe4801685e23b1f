//! Basic regions and uniqueness domains (figures 12 to 15): one map of a robot with two coordinates, slices of one with three.
//!
//! *Numerical*: colours are true to a cell of the grid, lines to the mesh they are cut from.

use super::axes::{Axis, Chart};
use super::barrier::Kind;
use super::maps::{NUMBER, draw_lines, draw_styled, fill, sample_line, sign_text, styled_line, swatch};
use super::palette::{self, PALE, SINGLE, UNDECIDED};
use super::raster::Raster;
use super::robot::signs;
use super::section::{Mesh, Plane, kind};
use super::slices::{Panels, place};
use super::survey::pose_axis;
use super::svg::{Anchor, Svg};
use crate::report::tables::{measure_unit, number as number_text};
use aspecta::domain::{self, BasicRegion, Domains, OUTSIDE};
use aspecta::robot::{Robot, Window};

/// Most slices in a figure, and how many are in a row.
const SLICES: usize = 12;
const COLUMNS: usize = 4;
/// Longest side of a slice, and of the map of a robot with two coordinates, pixels.
const SLICE: f64 = 230.0;
const MAP: f64 = 560.0;
/// Room for the heading, and for a line of the legend.
const HEADING: f64 = 20.0;
const LINE: f64 = 17.0;
/// Width of a region's entry in the legend, and how many there are at most.
const ENTRY: f64 = 190.0;
const LISTED: usize = 48;
/// Least side of the square in which a region's number stands, pixels.
const ROOM: f64 = 12.0;
const CHARACTERISTIC: &str = "fill:none;stroke:#222;stroke-width:0.6;stroke-linejoin:round";

/// What is drawn: an aspect cut into its regions, and the surfaces that bound them.
#[derive(Clone, Copy, Debug)]
pub struct Cut<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// The box that holds its workspace.
    pub window: &'a Window,
    /// The regions of one of its aspects.
    pub domains: &'a Domains,
    /// The boundary of that aspect.
    pub boundary: &'a domain::Mesh,
    /// Its characteristic surfaces.
    pub surface: &'a domain::Mesh,
}

/// The basic regions of an aspect.
pub fn regions(cut: &Cut<'_>) -> String {
    let colours = colours(cut.domains);
    sheet(cut, "regions", "Basic regions", &colours, &|_| true)
}

/// The largest uniqueness domain of an aspect: its regions in their colours, the others pale. Without any, all are.
pub fn uniqueness(cut: &Cut<'_>) -> String {
    let largest = cut.domains.uniqueness.first().map_or(&[][..], |domain| &domain.regions);
    let mut colours = colours(cut.domains);
    for (region, colour) in cut.domains.regions.iter().zip(&mut colours) {
        if !largest.contains(&region.number) {
            PALE.clone_into(colour);
        }
    }
    sheet(cut, "uniqueness", "Largest uniqueness domain", &colours, &|number| largest.contains(&number))
}

/// A colour for each region: those whose images meet, directly or through others, are shades of one hue.
fn colours(domains: &Domains) -> Vec<String> {
    let mut group: Vec<usize> = (0..domains.regions.len()).collect();
    for found in &domains.coincidences {
        let (a, b) = (group[found.regions.0 - 1], group[found.regions.1 - 1]);
        group.iter_mut().filter(|g| **g == a.max(b)).for_each(|g| *g = a.min(b));
    }
    let mut hues: Vec<usize> = Vec::new();
    let paint = |(k, region): (usize, &BasicRegion)| {
        if region.solutions < 2 {
            return SINGLE.to_owned();
        }
        if !hues.contains(&group[k]) {
            hues.push(group[k]);
        }
        let hue = hues.iter().position(|&g| g == group[k]).map_or(1, |hue| hue + 1);
        let alike = |range: std::ops::Range<usize>| range.filter(|&other| group[other] == group[k]).count();
        palette::shade(hue, alike(0..k), alike(0..group.len()))
    };
    domains.regions.iter().enumerate().map(paint).collect()
}

fn sheet(
    cut: &Cut<'_>,
    name: &str,
    title: &str,
    colours: &[String],
    is_shown: &dyn Fn(usize) -> bool,
) -> String {
    let Cut { robot, window, domains, .. } = cut;
    let grid = &domains.labels.grid;
    let in_plane = grid.axes() == 2;
    let layers = if in_plane { vec![0] } else { layers(domains) };
    let count = SLICES.min(layers.len());
    let axes = [0, 1].map(|k| {
        let low = grid.pose(0)[k] - 0.5 * grid.step[k];
        let range = (low, low + grid.step[k] * grid.count[k] as f64);
        Axis { range, ..pose_axis(robot, window, k) }
    });
    let (side, columns) = if in_plane { (MAP, 1) } else { (SLICE, COLUMNS) };
    let panels = Panels::new(axes, side, columns, HEADING);
    let (width, height) = panels.size(count);
    let width = width.max(720.0);
    let legend = Legend { cut, colours, is_shown, left: panels.left, width };
    let mode = signs(&domains.mode.to_string());
    let title = format!("{title} of aspect {}: mode ({mode}), {}", domains.aspect, sign_text(domains.det_a));
    let id = format!("{name}-{}", domains.aspect);
    let mut svg = Svg::new(&id, width, height + legend.height() + 12.0, &title);
    svg.text([panels.left, 16.0], Anchor::Start, 13.0, "font-weight:600", &title);
    for k in 0..count {
        let layer = layers[(2 * k + 1) * layers.len() / (2 * count)];
        let at = grid.pose(layer * grid.count[0] * grid.count[1])[2];
        let plane = (!in_plane).then(|| Plane { at, glued: window.glued[2] });
        let chart = panels.chart(k);
        let raster = layer_of(domains, layer);
        fill(&mut svg, &chart, &raster, |label| colour(colours, label));
        draw_surfaces(&mut svg, &chart, cut, plane);
        number(&mut svg, &chart, &raster, domains.regions.len(), is_shown);
        chart.frame(&mut svg, &if in_plane { String::new() } else { place(robot, at) });
    }
    legend.draw(&mut svg, height + 10.0);
    svg.finish()
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

/// The boundary over the characteristic surface.
fn draw_surfaces(svg: &mut Svg, chart: &Chart, cut: &Cut<'_>, plane: Option<Plane>) {
    const KINDS: [Kind; 3] = [Kind::Limit, Kind::Serial, Kind::Parallel];
    let (surface, boundary) = (Mesh::from(cut.surface), Mesh::from(cut.boundary));
    let inner: Vec<_> = KINDS.into_iter().flat_map(|kind| surface.lines(kind, plane)).collect();
    chart.clip(svg);
    draw_styled(svg, chart, inner.iter(), [false; 2], CHARACTERISTIC);
    svg.close();
    let lines_of = |kind| boundary.lines(kind, plane).into_iter().map(move |line| (kind, line));
    draw_lines(svg, chart, &KINDS.into_iter().flat_map(lines_of).collect(), [false; 2]);
}

/// Each region's number in the middle of the largest square of it, if there is room.
fn number(
    svg: &mut Svg,
    chart: &Chart,
    raster: &Raster<u32>,
    regions: usize,
    is_shown: &dyn Fn(usize) -> bool,
) {
    let pixel = [chart.width / raster.size().0 as f64, chart.height / raster.size().1 as f64];
    for (label, corner, side) in raster.squares() {
        let number = label as usize + 1;
        if number > regions || !is_shown(number) || side as f64 * pixel[0].min(pixel[1]) < ROOM {
            continue;
        }
        let half = 0.5 * side as f64;
        let x = chart.left + (corner.0 as f64 + half) * pixel[0];
        let y = chart.top + chart.height - (corner.1 as f64 + half) * pixel[1];
        svg.text([x, y + 4.0], Anchor::Middle, 11.0, NUMBER, &number.to_string());
    }
}

/// The regions in their colours, and the lines.
struct Legend<'a> {
    cut: &'a Cut<'a>,
    colours: &'a [String],
    is_shown: &'a dyn Fn(usize) -> bool,
    left: f64,
    width: f64,
}

impl Legend<'_> {
    fn columns(&self) -> usize {
        (((self.width - self.left) / ENTRY) as usize).max(1)
    }

    fn shown(&self) -> Vec<&BasicRegion> {
        self.cut.domains.regions.iter().filter(|region| (self.is_shown)(region.number)).collect()
    }

    fn height(&self) -> f64 {
        let entries = self.shown().len();
        LINE * (entries.min(LISTED).div_ceil(self.columns()) + usize::from(entries > LISTED) + 2) as f64
    }

    fn draw(&self, svg: &mut Svg, top: f64) {
        let (domains, shown) = (self.cut.domains, self.shown());
        let listed = &shown[..shown.len().min(LISTED)];
        let rows = listed.len().div_ceil(self.columns());
        let (mut y, unit) = (top, measure_unit(&self.cut.domains.unit));
        for (k, region) in listed.iter().enumerate() {
            let at = [self.left + ENTRY * (k / rows) as f64, y + LINE * (k % rows) as f64];
            let measure = number_text(region.measure);
            let text = format!("{}: n = {}, {measure} {unit}", region.number, region.solutions);
            swatch(svg, at, &self.colours[region.number - 1], &text);
        }
        y += LINE * rows as f64;
        if shown.len() > LISTED {
            let text = format!("… and {} smaller ones", shown.len() - LISTED);
            svg.text([self.left, y], Anchor::Start, 11.0, "", &text);
            y += LINE;
        }
        let mut x = self.left;
        if shown.len() < domains.regions.len() {
            x = swatch(svg, [x, y], PALE, "other regions");
        }
        if domains.unresolved.parts > 0 {
            x = swatch(svg, [x, y], UNDECIDED, "thinner than two cells");
        }
        let text = "n: direct solutions in the aspect; regions of one hue have coincident images";
        svg.text([x, y], Anchor::Start, 11.0, "", text);
        self.lines(svg, y + LINE);
    }

    /// The kinds of lines there are.
    fn lines(&self, svg: &mut Svg, y: f64) {
        let names = [
            (Kind::Parallel, "det A = 0"),
            (Kind::Serial, "det B = 0"),
            (Kind::Limit, "joint limit or end of the window"),
        ];
        let mut x = self.left;
        for (of, text) in names {
            if self.cut.boundary.simplices.iter().any(|s| kind(s.face) == of) {
                x = sample_line(svg, [x, y], of, text);
            }
        }
        if !self.cut.surface.simplices.is_empty() {
            styled_line(svg, [x, y], CHARACTERISTIC, "characteristic surface");
        }
    }
}
