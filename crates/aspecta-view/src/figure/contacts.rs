//! Which bodies touch at a line: a letter at the line, and what it stands for below the figure.

use super::axes::Chart;
use super::barrier::{Kind, contacts};
use super::maps::NUMBER;
use super::survey::{Lines, Survey};
use super::svg::{Anchor, Svg};
use aspecta::kinematics::WorkingMode;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

/// Height of a row.
const ROW: f64 = 16.0;
/// Width of a column, of which there are two.
const COLUMN: f64 = 360.0;

/// What the letters in a figure stand for.
pub(super) struct Key(Vec<String>);

impl Key {
    /// The contacts at which aspects of some modes end.
    pub fn of(survey: &Survey<'_>, modes: &[WorkingMode]) -> Self {
        let curves = survey.curves.iter().filter(|curves| modes.contains(&curves.mode));
        let seen: BTreeSet<usize> =
            curves.flat_map(|curves| &curves.w).filter_map(|line| number(line.0)).collect();
        let named = contacts(survey.robot).enumerate().filter(|(k, _)| seen.contains(k));
        Self(named.map(|(k, contact)| format!("{}: {}", letter(k), contact.named(survey.robot))).collect())
    }

    /// How high it is.
    pub fn height(&self) -> f64 {
        ROW * self.0.len().div_ceil(2) as f64
    }

    /// Draws it, the first row at this height.
    pub fn draw(&self, svg: &mut Svg, [x, y]: [f64; 2]) {
        for (k, text) in self.0.iter().enumerate() {
            let at = [x + COLUMN * (k % 2) as f64, y + ROW * (k / 2) as f64];
            svg.text(at, Anchor::Start, 11.0, "", text);
        }
    }
}

/// Puts its letter at the longest line of each contact; `turns` names the coordinates in which they wrap round.
pub(super) fn name_contacts(svg: &mut Svg, chart: &Chart, lines: &Lines, turns: [bool; 2]) {
    let mut longest: BTreeMap<usize, &Vec<[f64; 2]>> = BTreeMap::new();
    for (kind, line) in lines {
        let Some(number) = number(*kind) else { continue };
        let best = longest.entry(number).or_insert(line);
        if length(line) > length(best) {
            *best = line;
        }
    }
    let ranges = [chart.x.range, chart.y.range];
    for (number, line) in longest {
        let middle = line[line.len() / 2];
        let at = [0, 1].map(|k| {
            let over = ((middle[k] - ranges[k].0) / TAU).floor();
            if turns[k] { middle[k] - TAU * over } else { middle[k] }
        });
        let [x, y] = chart.at(at);
        svg.text([x, y + 3.5], Anchor::Middle, 10.0, NUMBER, &letter(number));
    }
}

fn number(kind: Kind) -> Option<usize> {
    match kind {
        Kind::Contact(number) => Some(number),
        Kind::Serial | Kind::Parallel | Kind::Limit => None,
    }
}

fn length(line: &[[f64; 2]]) -> f64 {
    line.windows(2).map(|ends| (ends[1][0] - ends[0][0]).hypot(ends[1][1] - ends[0][1])).sum()
}

/// a, b, … z, a1, b1, …
fn letter(number: usize) -> String {
    let letter = char::from(b'a' + (number % 26) as u8);
    match number / 26 {
        0 => letter.to_string(),
        round => format!("{letter}{round}"),
    }
}
