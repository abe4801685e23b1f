//! Prints where configurations lie.

use crate::failure::Failure;
use crate::input::Columns;
use crate::output::{Align, Format, Labels, Table, exact, json_of_each};
use crate::work::solve::Found;
use aspecta::aspect::{AspectId, DetSign};
use aspecta::domain::{Map, Nowhere, RegionId};
use aspecta::kinematics::{Solution, WorkingMode};
use aspecta::robot::Robot;
use serde::Serialize;
use std::io::Write;

/// A configuration and where it lies.
#[derive(Serialize)]
struct Place<'a> {
    mode: WorkingMode,
    det_a: Option<DetSign>,
    pose: &'a [f64],
    q: &'a [f64],
    aspect: Option<AspectId>,
    region: Option<RegionId>,
    /// Direct solutions in the aspect of the joint vectors of the region.
    solutions: Option<u8>,
    /// Numbers of the uniqueness domains of the aspect that hold the region.
    uniqueness: Vec<usize>,
    /// Why it is in no aspect, or not known in which.
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<String>,
}

impl<'a> Place<'a> {
    fn new(map: &Map, s: &'a Solution) -> Self {
        let mut place = Self {
            mode: s.mode,
            det_a: None,
            pose: &s.pose,
            q: &s.q,
            aspect: None,
            region: None,
            solutions: None,
            uniqueness: Vec::new(),
            why: None,
        };
        let location = match map.locate(&s.pose, s.mode) {
            Ok(location) => location,
            Err(nowhere) => return Self { why: Some(why(&map.robot, &nowhere)), ..place },
        };
        (place.det_a, place.aspect, place.region) = (Some(location.det_a), location.aspect, location.region);
        let domains = location.aspect.and_then(|aspect| map.domains(aspect));
        match (location.aspect, domains, location.region) {
            (Some(aspect), Some(domains), Some(region)) => {
                place.solutions = domains.regions.get(region.number() - 1).map(|region| region.solutions);
                place.uniqueness = map.uniqueness(aspect, region).collect();
            }
            (Some(_), Some(_), None) => {
                place.why = Some("in a part that the map does not resolve (--cells)".into())
            }
            (Some(_), None, _) => place.why = Some("its regions are not in the file".into()),
            (None, ..) => place.why = Some("no mapped aspect could be proved to hold it".into()),
        }
        place
    }
}

fn why(robot: &Robot, nowhere: &Nowhere) -> String {
    match nowhere {
        Nowhere::Limit(constraint) => format!("beyond the {}", constraint.named(robot)),
        _ => nowhere.to_string(),
    }
}

#[derive(Serialize)]
struct Answer<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    complete: Option<bool>,
    places: Vec<Place<'a>>,
}

/// Prints where all configurations found lie. Whether all have a region.
pub fn print(
    out: &mut dyn Write,
    map: &Map,
    found: &[Found],
    format: Format,
    degrees: bool,
) -> Result<bool, Failure> {
    let places: Vec<Vec<Place<'_>>> =
        found.iter().map(|f| f.solutions.iter().map(|s| Place::new(map, s)).collect()).collect();
    let known = places.iter().flatten().all(|place| place.region.is_some());
    match format {
        Format::Json => print_json(out, map, found, places)?,
        Format::Csv => print_csv(out, map, found, &places)?,
        Format::Table => print_table(out, map, found, &places, degrees)?,
    }
    Ok(known)
}

fn print_json(
    out: &mut dyn Write,
    map: &Map,
    found: &[Found],
    places: Vec<Vec<Place<'_>>>,
) -> Result<(), Failure> {
    let answers = found.iter().zip(places);
    let answers = answers.map(|(f, places)| (f.query.line, Answer { complete: f.complete, places }));
    json_of_each(out, &map.robot, answers.collect())
}

fn print_csv(
    out: &mut dyn Write,
    map: &Map,
    found: &[Found],
    places: &[Vec<Place<'_>>],
) -> Result<(), Failure> {
    let mut csv = csv::Writer::from_writer(out);
    let names = Columns::pose(&map.robot).and(&Columns::joints(&map.robot)).names;
    let labels = ["mode", "det_a", "aspect", "region", "solutions", "uniqueness", "why"].map(String::from);
    csv.write_record(["line".to_owned()].into_iter().chain(names).chain(labels))?;
    for (f, places) in found.iter().zip(places) {
        for place in places {
            let numbers = place.pose.iter().chain(place.q).map(|x| exact(*x));
            csv.write_record([line(f)].into_iter().chain(numbers).chain(labels_of(place)))?;
        }
    }
    csv.flush()?;
    Ok(())
}

fn print_table(
    out: &mut dyn Write,
    map: &Map,
    found: &[Found],
    places: &[Vec<Place<'_>>],
    degrees: bool,
) -> Result<(), Failure> {
    let (pose, joints) = (Labels::pose(&map.robot, degrees), Labels::joints(&map.robot, degrees));
    let right = |name: String| (name, Align::Right);
    let left = |name: &str| (name.to_owned(), Align::Left);
    let numbered = found.iter().any(|f| f.query.line.is_some());
    let first = numbered.then(|| right("line".into()));
    let vectors = pose.headings().chain(joints.headings()).map(right);
    let labels = [left("mode"), left("det A"), right("aspect".into()), right("region".into())];
    let more = [right("solutions".into()), left("uniqueness domains"), left("")];
    let mut table = Table::new(first.into_iter().chain(vectors).chain(labels).chain(more));
    for (f, places) in found.iter().zip(places) {
        for place in places {
            let first = numbered.then(|| line(f));
            let vectors = pose.numbers(place.pose).chain(joints.numbers(place.q));
            table.row(first.into_iter().chain(vectors).chain(labels_of(place)));
        }
    }
    write!(out, "{table}")?;
    if found.iter().any(|f| f.complete == Some(false)) {
        writeln!(out, "not proved to be all direct solutions")?;
    }
    Ok(())
}

fn line(found: &Found) -> String {
    found.query.line.map_or(String::new(), |line| line.to_string())
}

/// Mode, sign of det A, aspect, region, solutions, uniqueness domains, and why something is missing.
fn labels_of(place: &Place<'_>) -> [String; 7] {
    fn text(number: Option<impl ToString>) -> String {
        number.map_or(String::new(), |number| number.to_string())
    }
    [
        place.mode.to_string(),
        text(place.det_a),
        text(place.aspect),
        text(place.region),
        text(place.solutions),
        place.uniqueness.iter().map(usize::to_string).collect::<Vec<_>>().join(" "),
        place.why.clone().unwrap_or_default(),
    ]
}
