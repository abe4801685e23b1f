//! Basic components (figure 14): the images of the basic regions in joint space, those that coincide in one
//! colour.

use super::components::{JointSpace, Section};
use super::legend::Legend;
use super::maps::{LEGEND, fill};
use super::palette::UNDECIDED;
use super::raster::Raster;
use super::regions::{COLUMNS, HEADING, MAP, SLICE, SLICES, draw_surfaces, heading, number, thin};
use super::section::Plane;
use super::slices::Panels;
use super::svg::{Anchor, Number, Svg};
use aspecta::domain::OUTSIDE;

/// Width of a component's entry in the legend.
const ENTRY: f64 = 230.0;

/// The meaning of the thin lines.
pub(super) const CHANGE: &str = "change of n, also at folded legs";
/// Pixels over which a group of regions lies, but not which, in [`JointSpace::groups`].
pub(super) const UNKNOWN: u32 = u32::MAX - 1;

impl JointSpace<'_> {
    /// The values of the held joint at which sections are drawn; one of no meaning if none is held.
    pub(super) fn places(&self) -> Vec<f64> {
        let Some(held) = &self.held else { return vec![0.0] };
        (0..SLICES).map(|k| held.range.0 + held.span() * (k as f64 + 0.5) / SLICES as f64).collect()
    }

    /// The plane in which lines are cut.
    pub(super) fn plane(&self, at: f64) -> Option<Plane> {
        self.held.as_ref().map(|held| Plane { at, glued: held.angle })
    }

    /// `q₃ = 0.5 rad`.
    pub(super) fn place(&self, at: f64) -> String {
        let Some(held) = &self.held else { return String::new() };
        let (name, unit) = held.label.split_once(' ').unwrap_or((&held.label, ""));
        let unit = unit.trim_matches(['[', ']']);
        format!("{name} = {} {unit}", Number(at)).replace('-', "−")
    }

    /// Per pixel, the group of regions over it, by its first region; [`OUTSIDE`] where there is none.
    pub(super) fn groups(&self, section: &Section) -> Raster<u32> {
        let of_set = |set: &Vec<u32>| match (set.is_empty(), self.group(set)) {
            (true, _) => OUTSIDE,
            (_, group) => group.map_or(UNKNOWN, |group| group as u32),
        };
        let group: Vec<u32> = section.sets.iter().map(of_set).collect();
        let (columns, rows) = section.raster.size();
        Raster::from_fn(columns, rows, |c, r| group[section.raster.at(c, r) as usize])
    }

    /// Per region, how many pixels it lies over whose sets are such as asked.
    pub(super) fn pixels(&self, section: &Section, is_fit: impl Fn(&[u32]) -> bool) -> Vec<usize> {
        let (columns, rows) = section.raster.size();
        let mut pixels = vec![0; self.cut.domains.regions.len()];
        for pixel in 0..columns * rows {
            let set = &section.sets[section.raster.at(pixel % columns, pixel / columns) as usize];
            for &region in set.iter().filter(|region| **region != OUTSIDE && is_fit(set)) {
                pixels[region as usize] += 1;
            }
        }
        pixels
    }

    /// The colour of a group.
    pub(super) fn colour(&self, group: u32) -> Option<&'static str> {
        match group {
            OUTSIDE => None,
            UNKNOWN => Some(UNDECIDED),
            group => Some(self.hues.image(group as usize)),
        }
    }

    /// The groups, each with the regions in it.
    fn components(&self) -> impl Iterator<Item = (usize, Vec<usize>)> {
        let firsts = (0..self.cut.domains.regions.len()).filter(|&region| self.hues.group(region) == region);
        firsts.map(|first| (first, self.hues.members(first).collect()))
    }

    fn entries(&self) -> Vec<(String, String)> {
        let entry = |(first, members): (usize, Vec<usize>)| {
            let solutions = self.cut.domains.regions[first].solutions;
            let word = if members.len() == 1 { "region" } else { "regions" };
            let text = format!("{word} {}: n = {solutions}", numbers(&members));
            (self.hues.image(first).to_owned(), text)
        };
        self.components().map(entry).collect()
    }
}

/// Numbers from 1: `2, 5, 7`.
fn numbers(regions: &[usize]) -> String {
    regions.iter().map(|region| (region + 1).to_string()).collect::<Vec<_>>().join(", ")
}

/// The basic components of an aspect: one map of a robot with two joints, sections of one with three.
pub fn components(space: &JointSpace<'_>) -> String {
    let in_plane = space.held.is_none();
    let (side, columns) = if in_plane { (MAP, 1) } else { (SLICE, COLUMNS) };
    let panels = Panels::new(space.axes.clone(), side, columns, HEADING);
    let places = space.places();
    let (width, height) = panels.size(places.len());
    let domains = space.cut.domains;
    let legend = Legend {
        cut: space.cut,
        entries: space.entries(),
        entry: ENTRY,
        notes: thin(domains).into_iter().collect(),
        caption: "n: direct solutions in the aspect; components of one colour coincide",
        of: "image of ",
        thin: Some(CHANGE),
        left: panels.left,
        right: width.max(LEGEND),
    };
    let title = heading("Basic components", domains);
    let id = format!("components-{}", domains.aspect);
    let mut svg = Svg::new(&id, legend.right, height + legend.height() + 12.0, &title);
    svg.text([panels.left, 16.0], Anchor::Start, 13.0, "font-weight:600", &title);
    let boundary = space.boundary();
    for (k, at) in places.into_iter().enumerate() {
        let chart = panels.chart(k);
        let section = space.section(at, side as usize);
        let groups = space.groups(&section);
        fill(&mut svg, &chart, &groups, |group| space.colour(group));
        draw_surfaces(&mut svg, &chart, &boundary, space.plane(at), &space.changes(&section, at));
        number(&mut svg, &chart, &groups, |group| {
            let members = || space.hues.members(group as usize).collect::<Vec<_>>();
            (group < UNKNOWN).then(|| numbers(&members()).replace(", ", "·"))
        });
        chart.frame(&mut svg, &space.place(at));
    }
    legend.draw(&mut svg, height + 10.0);
    svg.finish()
}
