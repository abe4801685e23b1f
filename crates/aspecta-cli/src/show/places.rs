//! Prints where configurations lie.

use crate::args::given::Query;
use crate::failure::Failure;
use crate::input::Columns;
use crate::output::{Align, Labels, Shown, Table, exact};
use crate::work::solve::Found;
use aspecta::aspect::{AspectId, DetSign};
use aspecta::domain::{Map, Nowhere, RegionId};
use aspecta::kinematics::{Solution, WorkingMode};
use aspecta::robot::Robot;
use serde::Serialize;
use std::io::Write;

/// A configuration and where it lies.
#[derive(Serialize)]
pub struct Place {
    mode: WorkingMode,
    det_a: Option<DetSign>,
    pose: Vec<f64>,
    q: Vec<f64>,
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

impl Place {
    fn new(map: &Map, s: Solution) -> Self {
        let located = map.locate(&s.pose, s.mode);
        let mut place = Self {
            mode: s.mode,
            det_a: None,
            pose: s.pose,
            q: s.q,
            aspect: None,
            region: None,
            solutions: None,
            uniqueness: Vec::new(),
            why: None,
        };
        let location = match located {
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

/// A vector and where its configurations lie.
pub struct Located {
    query: Query,
    complete: Option<bool>,
    places: Vec<Place>,
}

impl Located {
    /// Looks them up in a map.
    pub fn new(map: &Map, found: Found) -> Self {
        let places = found.solutions.into_iter().map(|s| Place::new(map, s)).collect();
        Self { query: found.query, complete: found.complete, places }
    }
}

/// Places of configurations, as they are shown.
pub struct Places<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// Whether people read angles in degrees.
    pub degrees: bool,
}

#[derive(Serialize)]
struct Answer<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    complete: Option<bool>,
    places: &'a [Place],
}

impl Shown for Places<'_> {
    type Found = Located;

    fn robot(&self) -> &Robot {
        self.robot
    }

    fn line(&self, found: &Located) -> Option<u64> {
        found.query.line
    }

    /// Whether all have a region.
    fn is_positive(&self, found: &Located) -> bool {
        !found.places.is_empty() && found.places.iter().all(|place| place.region.is_some())
    }

    fn json(&self, found: &Located) -> impl Serialize {
        Answer { complete: found.complete, places: &found.places }
    }

    fn columns(&self) -> Vec<String> {
        let labels =
            ["mode", "det_a", "aspect", "region", "solutions", "uniqueness", "why"].map(String::from);
        Columns::pose(self.robot).and(&Columns::joints(self.robot)).names.into_iter().chain(labels).collect()
    }

    fn records(&self, found: &Located) -> Vec<Vec<String>> {
        let numbers =
            |place: &Place| place.pose.iter().chain(&place.q).map(|x| exact(*x)).collect::<Vec<_>>();
        let record = |place| numbers(place).into_iter().chain(labels_of(place)).collect();
        found.places.iter().map(record).collect()
    }

    fn lines(&self, found: &Located) -> usize {
        found.places.len()
    }

    fn table(&self, out: &mut dyn Write, found: &[Located]) -> Result<(), Failure> {
        print_table(out, self.robot, found, self.degrees)
    }
}

fn print_table(out: &mut dyn Write, robot: &Robot, found: &[Located], degrees: bool) -> Result<(), Failure> {
    let (pose, joints) = (Labels::pose(robot, degrees), Labels::joints(robot, degrees));
    let right = |name: String| (name, Align::Right);
    let left = |name: &str| (name.to_owned(), Align::Left);
    let numbered = found.iter().any(|f| f.query.line.is_some());
    let first = numbered.then(|| right("line".into()));
    let vectors = pose.headings().chain(joints.headings()).map(right);
    let labels = [left("mode"), left("det A"), right("aspect".into()), right("region".into())];
    let more = [right("solutions".into()), left("uniqueness domains"), left("")];
    let mut table = Table::new(first.into_iter().chain(vectors).chain(labels).chain(more));
    for f in found {
        for place in &f.places {
            let first = f.query.line.map(|line| line.to_string());
            let vectors = pose.numbers(&place.pose).chain(joints.numbers(&place.q));
            table.row(first.into_iter().chain(vectors).chain(labels_of(place)));
        }
    }
    write!(out, "{table}")?;
    if found.iter().any(|f| f.complete == Some(false)) {
        writeln!(out, "not proved to be all direct solutions")?;
    }
    Ok(())
}

/// Mode, sign of det A, aspect, region, solutions, uniqueness domains, and why something is missing.
fn labels_of(place: &Place) -> [String; 7] {
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
