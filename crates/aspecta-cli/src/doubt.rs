//! Where the bounds on the number of aspects are apart, in the words and units of people.

use aspecta::aspect::Doubt;
use aspecta::robot::Robot;

/// A coordinate of the place of a doubt.
pub struct Coordinate {
    /// Its name: `x`, or `q1` for the crank's angle of a folded leg.
    pub name: String,
    /// Its unit; `None` for the direction of a folded rod (p, and in space w), which is a number.
    pub unit: Option<String>,
    /// Its range.
    pub range: (f64, f64),
}

impl Coordinate {
    /// The middle of the range.
    pub fn middle(&self) -> f64 {
        0.5 * (self.range.0 + self.range.1)
    }
}

/// The place of a doubt, in the coordinates that vary: those of the pose, or where a leg is folded its own instead of the platform's
/// translations.
pub fn place(robot: &Robot, doubt: &Doubt) -> Vec<Coordinate> {
    let length = &robot.length_unit;
    let unit = |angle: bool| Some(if angle { "rad" } else { length }.to_owned());
    let own = |leg: usize| [(format!("q{leg}"), unit(true)), ("p".into(), None), ("w".into(), None)];
    let own = doubt.fold.map(own).into_iter().flatten().take(robot.platform.space());
    let pose = robot.platform.coordinates().iter().map(|c| (c.name.to_owned(), unit(c.angle)));
    let names = own.clone().chain(pose.skip(own.count()));
    let all = names.zip(&doubt.place).map(|((name, unit), &range)| Coordinate { name, unit, range });
    all.filter(|c| c.range.0 < c.range.1).collect()
}

/// The doubts of a kind, those over the most poses first.
pub fn largest_first<'a>(doubts: impl Iterator<Item = &'a Doubt>) -> Vec<&'a Doubt> {
    let mut sorted: Vec<&Doubt> = doubts.collect();
    sorted.sort_by(|a, b| b.measure.total_cmp(&a.measure).then(b.boxes.cmp(&a.boxes)));
    sorted
}
