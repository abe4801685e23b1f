//! Maps of the workspace.

use super::Case;
use crate::common::{analysis, analysis_in, five_bar, three_rrr};
use aspecta::aspect::AspectId;
use aspecta::domain;
use aspecta::domain::boundary::Boundary;
use aspecta_view::figure::barrier::Kind;
use aspecta_view::figure::palette::{PALE, SINGLE, UNDECIDED};
use aspecta_view::figure::raster::Raster;
use aspecta_view::figure::regions::{regions, uniqueness};
use aspecta_view::figure::section::{Mesh, Plane};
use roxmltree::{Document, Node};
use std::collections::{BTreeMap, BTreeSet};

/// The colour of an element that is filled with nothing else but it.
fn filled(node: &Node<'_, '_>) -> Option<String> {
    node.attribute("style")?.strip_prefix("fill:#").map(|colour| format!("#{colour}"))
}

/// The colours of the areas of a picture.
pub fn areas(svg: &str) -> BTreeSet<String> {
    let document = Document::parse(svg).unwrap();
    document.descendants().filter(|n| n.has_tag_name("path")).filter_map(|n| filled(&n)).collect()
}

/// The colour each region has in the legend, by number.
fn legend(svg: &str) -> BTreeMap<usize, String> {
    let document = Document::parse(svg).unwrap();
    let entry = |text: Node<'_, '_>| {
        let number = text.text()?.split_once(": n = ")?.0.parse().ok()?;
        let swatch = text.prev_sibling_element()?.attribute("style")?;
        Some((number, swatch.strip_prefix("fill:")?.split(';').next()?.to_owned()))
    };
    document.descendants().filter(|n| n.has_tag_name("text")).filter_map(entry).collect()
}

pub fn set<'a>(colours: impl IntoIterator<Item = &'a str>) -> BTreeSet<String> {
    colours.into_iter().map(str::to_owned).collect()
}

/// Its aspects have no characteristic curves: each is one region, and its own uniqueness domain.
#[test]
fn an_aspect_of_the_five_bar_has_one_colour() {
    let case = Case::new(analysis(&five_bar(), 9), AspectId::new(1), 200, 200);
    assert!(case.surface.simplices.is_empty());
    for svg in [regions(&case.cut()), uniqueness(&case.cut())] {
        let coloured: BTreeSet<String> = &areas(&svg) - &set([UNDECIDED]);
        assert_eq!(coloured, set([SINGLE]));
        assert_eq!(legend(&svg), BTreeMap::from([(1, SINGLE.to_owned())]));
        assert!(svg.contains("x [unit]") && svg.contains("y [unit]"));
        assert!(!svg.contains("characteristic surface"));
    }
}

/// One colour a region, and twins share a hue.
#[test]
fn the_three_rpr_has_the_colours_of_ten_regions() {
    let case = Case::three_rpr(80, 12);
    assert_eq!(case.domains.regions.len(), 10);
    let svg = regions(&case.cut());
    let legend_colours = legend(&svg);
    let distinct: BTreeSet<String> = legend_colours.values().cloned().collect();
    assert_eq!((legend_colours.len(), distinct.len()), (10, 10));
    assert_eq!(&areas(&svg) - &set([UNDECIDED]), distinct);
    for found in &case.domains.coincidences {
        let [a, b] = [found.regions.0, found.regions.1].map(|n| hue(&legend_colours[&n.number()]));
        assert!((a - b).abs() < 4.0, "regions {:?}: hues {a} and {b}", found.regions);
    }
    assert_eq!(svg.matches("φ = ").count(), 12);

    // In its picture the largest uniqueness domain keeps its colours.
    let largest = &case.domains.uniqueness[0].regions;
    let kept = largest.iter().map(|n| legend_colours[&n.number()].as_str());
    let svg = uniqueness(&case.cut());
    assert_eq!(&areas(&svg) - &set([UNDECIDED]), set(kept.chain([PALE])));
    assert!(legend(&svg).into_keys().eq(largest.iter().map(|region| region.number())));
}

/// Of a colour, in degrees.
fn hue(colour: &str) -> f64 {
    let [r, g, b] = [1, 3, 5].map(|k| f64::from(u8::from_str_radix(&colour[k..k + 2], 16).unwrap()));
    (3_f64.sqrt() * (g - b)).atan2(2.0 * r - g - b).to_degrees()
}

/// Where a plane meets the serial part of the boundary, a leg of the 3-RRR is stretched: |AᵢCᵢ| = 20.
#[test]
fn sections_lie_on_the_boundary() {
    let analysis = analysis_in(&three_rrr(), "+++", 7);
    let boundary = domain::Mesh::from(&Boundary::new(&analysis, AspectId::new(1), 48).unwrap());
    let anchors = [[-10.0, -10.0], [10.0, -10.0], [0.0, 10.0_f64]];
    let attachments = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0_f64]];
    for at in [-0.6, 0.25, 2.0_f64] {
        let plane = Plane { at, glued: true };
        let lines = Mesh::of_poses(&boundary, &analysis.window).lines(Kind::Serial, Some(plane));
        assert!(lines.iter().flatten().count() > 10, "φ = {at}");
        for &[x, y] in lines.iter().flatten() {
            let length = |(a, c): (&[f64; 2], &[f64; 2])| {
                let across = x + c[0] * at.cos() - c[1] * at.sin() - a[0];
                across.hypot(y + c[0] * at.sin() + c[1] * at.cos() - a[1])
            };
            let off = anchors.iter().zip(&attachments).map(|leg| (length(leg) - 20.0).abs());
            // What is drawn is chords: well within a cell, which is 0.7 wide.
            let off = off.fold(f64::MAX, f64::min);
            assert!(off < 0.2, "{off} at {x} {y} {at}");
        }
    }
}

/// The largest square of each label, against all squares.
#[test]
fn squares_are_the_largest() {
    let raster = Raster::from_fn(23, 17, |c, r| (c / 5 + r / 4 + c * r / 40) % 3);
    let is_square = |label, column: usize, row: usize, side: usize| {
        column + side <= 23
            && row + side <= 17
            && (0..side * side).all(|k| raster.at(column + k % side, row + k / side) == label)
    };
    let found = raster.squares();
    assert_eq!(found.len(), 3);
    for (label, (column, row), side) in found {
        assert!(is_square(label, column, row, side));
        assert!((0..23 * 17).all(|k| !is_square(label, k % 23, k / 23, side + 1)));
    }
}
