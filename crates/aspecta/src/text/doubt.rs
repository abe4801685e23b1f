//! Wording of the places where the bounds on the number of aspects are apart, in units for people.

use crate::aspect::{Analysis, Doubt};
use aspecta_kinematics::parallel_rods::ParallelRods;
use aspecta_robot::text::brief;
use aspecta_robot::{LegIndex, Robot};

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

/// The place of a doubt, in the coordinates that vary: those of the pose, or where a leg is folded its own
/// instead of the platform's translations.
pub fn place(robot: &Robot, doubt: &Doubt) -> Vec<Coordinate> {
    let length = &robot.length_unit;
    let unit = |angle: bool| Some(if angle { "rad" } else { length }.to_owned());
    let own = |leg: LegIndex| [(format!("q{leg}"), unit(true)), ("p".into(), None), ("w".into(), None)];
    let own = doubt.fold.map(own).into_iter().flatten().take(robot.platform.space());
    let pose = robot.platform.coordinates().iter().map(|c| (c.name.to_owned(), unit(c.angle)));
    let names = own.clone().chain(pose.skip(own.count()));
    let all = names.zip(&doubt.place).map(|((name, unit), &range)| Coordinate { name, unit, range });
    all.filter(|c| c.range.0 < c.range.1).collect()
}

/// The message about a robot that is nearly singular at every pose.
pub fn nearly_singular(measure: f64) -> String {
    format!(
        "det A nearly vanishes at every pose that was looked at: no smallest singular value of the homogeneous A is above {} (numerical). \
         Platform and base may be similar, for instance, and det A differ from 0 only by the decimals in which they are written down: \
         such a robot gives way with all actuators locked, whatever is proved of its aspects.",
        brief(measure)
    )
}

/// The message about a robot that is singular at every pose.
pub const ARCHITECTURE: &str = "det A vanishes at every pose that was looked at (numerical): with all actuators locked the platform still moves, wherever it is. \
     Two legs may be one and the same, or joints lie in one point or line. Such a robot has no aspects.";

/// Why no refinement ends the doubts round some surfaces: a sentence each; none if the bounds meet.
pub fn reasons(analysis: &Analysis) -> Vec<String> {
    let unit = &analysis.robot.length_unit;
    let reason = |rods: &ParallelRods| {
        let legs = rods.legs.iter().map(LegIndex::to_string).collect::<Vec<_>>().join(", ");
        let decimals = (4 - rods.radius.log10().floor() as i32).max(0) as usize;
        // Adding zero turns a rounded −0 into 0.
        let scale = 10f64.powi(decimals as i32);
        let shown = |x: f64| format!("{:.decimals$}", (x * scale).round() / scale + 0.0);
        format!(
            "det A vanishes to order {} on a surface, where the rods of legs {legs} are parallel: poses at {} {unit} from ({}), q{} = {:.4}. \
             Its sign need not change there, so boxes on it are never decided; limits that keep the joints from there would help.",
            rods.order,
            shown(rods.radius),
            rods.centre.map(shown).join(", "),
            rods.legs[0],
            rods.q[0],
        )
    };
    if analysis.doubts.is_empty() {
        return Vec::new();
    }
    let folds = (!analysis.uncharted_folds.is_empty()).then(|| {
        let legs: Vec<String> = analysis.uncharted_folds.iter().map(LegIndex::to_string).collect();
        format!(
            "Two legs can fold at once whose links are equal, or complete each other to half a turn: the platform's joint comes onto the motor's axis, where \
             the motor is free. Leg 1 may fold, but boxes round the orientations in which leg {} does are never decided.",
            legs.join(" or ")
        )
    });
    let singular = analysis.architecturally_singular.then(|| ARCHITECTURE.to_owned());
    singular.into_iter().chain(analysis.parallel_rods.iter().map(reason)).chain(folds).collect()
}

/// The doubts of a kind, those over the most poses first.
pub fn largest_first<'a>(doubts: impl Iterator<Item = &'a Doubt>) -> Vec<&'a Doubt> {
    let mut sorted: Vec<&Doubt> = doubts.collect();
    sorted.sort_by(|a, b| b.measure.total_cmp(&a.measure).then(b.boxes.cmp(&a.boxes)));
    sorted
}
