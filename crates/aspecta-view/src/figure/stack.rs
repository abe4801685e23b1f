//! The stack of sheets (figures 14 and 15): an aspect seen over joint space, region by region, in an oblique
//! view.
//!
//! Sheet 1 holds the regions of the largest uniqueness domain, every other region lies in the lowest sheet
//! where no image meets its own: so as many sheets lie over a joint vector as it has direct solutions.

use super::axes::{Axis, Chart};
use super::barrier::Kind;
use super::components::{JointSpace, Section};
use super::joints::{CHANGE, UNKNOWN};
use super::legend::Legend;
use super::maps::{LEGEND, NUMBER, draw_lines, draw_styled, fill};
use super::oblique::{BELOW, LEFT, SIDE, View};
use super::palette::{CHARACTERISTIC, INK};
use super::raster::Raster;
use super::regions::{ENTRY, colours, entries, heading, thin};
use super::svg::{Anchor, Svg};
use aspecta::domain::{Domains, OUTSIDE};
use std::f64::consts::TAU;

/// Pixels along a side to look for the plane to show.
const COARSE: usize = 96;
/// Share of the plane that a region must cover to be shown.
const SHOWN: f64 = 5e-4;
/// Pixels between verticals, and most of them.
const APART: f64 = 14.0;
const VERTICALS: usize = 4;
const VERTICAL: &str = "stroke:#222;stroke-width:0.9;stroke-dasharray:2 2.5";

/// The sheet of each region, from 0.
fn sheets(domains: &Domains) -> Vec<usize> {
    let first = domains.uniqueness.first().map_or(&[][..], |domain| &domain.regions);
    let number = |region: usize| domains.regions[region].number;
    let regions = 0..domains.regions.len();
    let mut sheet: Vec<Option<usize>> =
        regions.map(|region| first.contains(&number(region)).then_some(0)).collect();
    for region in 0..sheet.len() {
        let taken = |level: usize| {
            let on_it = |other: &usize| sheet[*other] == Some(level) && *other != region;
            (0..sheet.len()).filter(on_it).any(|other| domains.coincide(number(region), number(other)))
        };
        let free = sheet[region].unwrap_or_else(|| (0..).find(|&level| !taken(level)).unwrap_or(0));
        sheet[region] = Some(free);
    }
    sheet.into_iter().flatten().collect()
}

/// The stack of an aspect's sheets over its joint space or, of three joints, over the plane of joint vectors
/// in which most regions show.
pub fn stack(space: &JointSpace<'_>) -> String {
    let domains = space.cut.domains;
    let at = fullest(space);
    let section = space.section(at, SIDE as usize);
    let shown = covered(space, &section);
    let sheet = sheets(domains);
    // Levels without a region here are left out.
    let mut levels: Vec<usize> = shown.iter().map(|&region| sheet[region]).collect();
    levels.sort_unstable();
    levels.dedup();
    let view = View::new(space.axes.clone(), levels.len());
    let stack = Stack {
        sheets: levels.iter().map(|&l| shown.iter().copied().filter(|&r| sheet[r] == l).collect()).collect(),
        verticals: verticals(space, &section, &view, &shown),
        lines: Lines::new(space, &section, at),
        colours: colours(domains),
        view,
        space,
        section,
    };
    let legend = Legend {
        cut: space.cut,
        entries: entries(space.cut, &stack.colours, &|region| shown.contains(&(region.number() - 1))),
        entry: ENTRY,
        notes: thin(domains).into_iter().collect(),
        caption: "n: direct solutions in the aspect, as many as sheets; sheet 1 holds the largest uniqueness domain",
        of: "image of ",
        thin: Some(CHANGE),
        left: 12.0,
        right: stack.view.width().max(LEGEND),
    };
    let title = heading("Sheets over joint space", domains);
    let top = stack.view.bottom + BELOW + 14.0;
    let mut svg =
        Svg::new(&format!("sheets-{}", domains.aspect), legend.right, top + legend.height(), &title);
    svg.text([12.0, 16.0], Anchor::Start, 13.0, "font-weight:600", &title);
    svg.text([12.0, 33.0], Anchor::Start, 12.0, "", &space.place(at));
    stack.draw(&mut svg);
    legend.draw(&mut svg, top);
    svg.finish()
}

/// Returns the value of the fixed joint that shows many and large regions with several solutions, or many
/// regions if none has several. Only joint vectors count all of whose solutions lie in known regions.
fn fullest(space: &JointSpace<'_>) -> f64 {
    let richness = |at: f64| {
        let section = space.section(at, COARSE);
        [2, 1].map(|least| -> f64 {
            let is_sheer = |set: &[u32]| set.len() >= least && set.iter().all(|region| *region != OUTSIDE);
            space.pixels(&section, is_sheer).into_iter().map(|pixels| (pixels as f64).sqrt()).sum()
        })
    };
    let rich = space.places().into_iter().map(|at| (at, richness(at)));
    let richer = |a: &[f64; 2], b: &[f64; 2]| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]));
    rich.max_by(|a, b| richer(&a.1, &b.1)).map_or(0.0, |(at, _)| at)
}

/// The regions that cover enough of a section to be seen.
fn covered(space: &JointSpace<'_>, section: &Section) -> Vec<usize> {
    let (columns, rows) = section.raster.size();
    let least = SHOWN * (columns * rows) as f64;
    let pixels = space.pixels(section, |_| true);
    (0..pixels.len()).filter(|&region| pixels[region] as f64 >= least).collect()
}

/// Places of a sheet, in pixels, each with the regions over it if all are known: most solutions first. No two
/// stand above each other in the picture.
fn verticals(space: &JointSpace<'_>, section: &Section, view: &View, shown: &[usize]) -> Vec<Vertical> {
    let groups = space.groups(section);
    let pixels = groups.size().0 as f64;
    let (across, up) = (view.chart.width / pixels, view.chart.height / pixels);
    let members = |group: u32| space.hues.members(group as usize).collect::<Vec<_>>();
    let is_whole = |group: u32| {
        let (members, regions) = (members(group), &space.cut.domains.regions);
        let solutions = |region: &usize| usize::from(regions[*region].solutions);
        members.iter().all(|region| shown.contains(region) && solutions(region) == members.len())
    };
    let mut squares = groups.squares();
    squares.retain(|(group, _, _)| *group < UNKNOWN && is_whole(*group));
    squares.sort_by_key(|(group, _, side)| std::cmp::Reverse((members(*group).len(), *side)));
    let mut found: Vec<Vertical> = Vec::new();
    for (group, (column, row), side) in squares.into_iter().take(VERTICALS) {
        let at = |share: f64| {
            let (column, row) = (column as f64 + share * side as f64, row as f64 + 0.5 * side as f64);
            [across * column, view.chart.height - up * row]
        };
        let is_free = |place: &[f64; 2]| {
            let apart = |other: &Vertical| (view.at(other.0, 0)[0] - view.at(*place, 0)[0]).abs() > APART;
            found.iter().all(apart)
        };
        let place = [0.5, 0.85, 0.15].map(at).into_iter().find(is_free).unwrap_or(at(0.5));
        found.push((place, members(group)));
    }
    found
}

/// A place, and the regions (from 0) over it.
type Vertical = ([f64; 2], Vec<usize>);

/// The picture of the stack, with the data it is drawn from.
struct Stack<'a> {
    space: &'a JointSpace<'a>,
    view: View,
    section: Section,
    /// Per sheet, from the lowest, its regions (from 0).
    sheets: Vec<Vec<usize>>,
    /// A colour for each region.
    colours: Vec<String>,
    lines: Lines,
    verticals: Vec<Vertical>,
}

impl Stack<'_> {
    fn draw(&self, svg: &mut Svg) {
        self.view.paper(svg, 0);
        self.view.open(svg, 0);
        fill(svg, &self.view.chart, &self.space.groups(&self.section), |group| self.space.colour(group));
        self.lines.draw(svg, &self.view.chart);
        svg.close();
        svg.text([LEFT - 40.0, self.view.bottom + 4.0], Anchor::End, 11.0, "font-weight:600", "Q");
        for (k, regions) in self.sheets.iter().enumerate() {
            self.rise(svg, k);
            self.sheet(svg, k + 1, regions);
        }
        // Not under the sheets, which are not quite clear.
        self.view.frame(svg);
        for (at, regions) in &self.verticals {
            self.label(svg, *at, regions);
        }
    }

    /// The region of a sheet over each pixel.
    fn raster(&self, regions: &[usize]) -> Raster<u32> {
        let on_it = |set: &Vec<u32>| {
            let region = set.iter().find(|region| regions.contains(&(**region as usize)));
            region.copied().unwrap_or(OUTSIDE)
        };
        let of_set: Vec<u32> = self.section.sets.iter().map(on_it).collect();
        let (columns, rows) = self.section.raster.size();
        Raster::from_fn(columns, rows, |c, r| of_set[self.section.raster.at(c, r) as usize])
    }

    fn sheet(&self, svg: &mut Svg, sheet: usize, regions: &[usize]) {
        let (view, raster) = (&self.view, self.raster(regions));
        view.paper(svg, sheet);
        view.open(svg, sheet);
        fill(svg, &view.chart, &raster, |region| self.colours.get(region as usize));
        self.lines.draw_round(svg, &view.chart, &raster);
        svg.close();
        let [_, y] = view.at([0.0, view.chart.height], sheet);
        svg.text([LEFT - 10.0, y + 4.0], Anchor::End, 11.0, "font-weight:600", &format!("sheet {sheet}"));
    }

    /// Draws the parts from sheet `from` to the next of the verticals that go on.
    fn rise(&self, svg: &mut Svg, from: usize) {
        let goes_on = |regions: &[usize]| self.sheets[from..].iter().flatten().any(|r| regions.contains(r));
        for (at, _) in self.verticals.iter().filter(|(_, regions)| goes_on(regions)) {
            svg.line(self.view.at(*at, from), self.view.at(*at, from + 1), VERTICAL);
        }
    }

    /// Marks where a vertical meets its regions, and how often.
    fn label(&self, svg: &mut Svg, at: [f64; 2], regions: &[usize]) {
        let mut top = self.view.at(at, 0);
        for (k, sheet) in self.sheets.iter().enumerate() {
            for region in sheet.iter().filter(|region| regions.contains(region)) {
                top = self.view.at(at, k + 1);
                svg.circle(top, 2.6, &format!("fill:{INK};stroke:#fff;stroke-width:0.8"));
                let beside = [top[0] + 6.0, top[1] + 4.0];
                svg.text(beside, Anchor::Start, 11.0, NUMBER, &(region + 1).to_string());
            }
        }
        let n = self.space.cut.domains.regions[regions[0]].solutions;
        svg.text([top[0], top[1] - 9.0], Anchor::Middle, 12.0, NUMBER, &format!("n = {n}"));
    }
}

/// The lines in the plane shown.
struct Lines {
    /// The curves on which the number of solutions changes.
    changes: Vec<Vec<[f64; 2]>>,
    /// The image of the boundary.
    boundary: super::survey::Lines,
    turns: [bool; 2],
}

impl Lines {
    fn new(space: &JointSpace<'_>, section: &Section, at: f64) -> Self {
        let boundary = space.boundary();
        let changes = space.changes(section, at);
        Self { changes, boundary: boundary.kinds(space.plane(at)), turns: boundary.turns }
    }

    /// Draws all of them.
    fn draw(&self, svg: &mut Svg, chart: &Chart) {
        draw_styled(svg, chart, self.changes.iter(), self.turns, CHARACTERISTIC);
        draw_lines(svg, chart, &self.boundary, self.turns);
    }

    /// Draws the parts that run along regions.
    fn draw_round(&self, svg: &mut Svg, chart: &Chart, raster: &Raster<u32>) {
        let along = |line: &Vec<[f64; 2]>| -> Vec<Vec<[f64; 2]>> {
            let is_along = |point: &[f64; 2]| self.is_along(chart, raster, *point);
            let runs = line.chunk_by(|a, b| is_along(a) == is_along(b));
            runs.filter(|run| is_along(&run[0])).map(<[_]>::to_vec).collect()
        };
        let changes: Vec<_> = self.changes.iter().flat_map(along).collect();
        let of_line = |(kind, line): &(Kind, Vec<[f64; 2]>)| {
            let kind = *kind;
            along(line).into_iter().map(move |part| (kind, part))
        };
        draw_styled(svg, chart, changes.iter(), self.turns, CHARACTERISTIC);
        draw_lines(svg, chart, &self.boundary.iter().flat_map(of_line).collect(), self.turns);
    }

    /// Whether a region is at most a pixel away.
    fn is_along(&self, chart: &Chart, raster: &Raster<u32>, point: [f64; 2]) -> bool {
        let (columns, rows) = raster.size();
        let pixel = |k: usize, axis: &Axis, of: usize| {
            let from = point[k] - axis.range.0;
            let from = if self.turns[k] { from.rem_euclid(TAU) } else { from };
            (from / axis.span() * of as f64).floor() as i64
        };
        let (column, row) = (pixel(0, &chart.x, columns), pixel(1, &chart.y, rows));
        let round = (column - 1..=column + 1).flat_map(|c| (row - 1..=row + 1).map(move |r| (c, r)));
        let is_inside =
            |&(c, r): &(i64, i64)| (0..columns as i64).contains(&c) && (0..rows as i64).contains(&r);
        round.filter(is_inside).any(|(c, r)| raster.at(c as usize, r as usize) != OUTSIDE)
    }
}
