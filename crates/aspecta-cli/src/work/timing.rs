//! Motions under joint limits: what `time` and the commands that plan share.

use crate::failure::Failure;
use crate::input::Columns;
use crate::output::{Target, exact, number};
use aspecta::Kinematics;
use aspecta::motion::time::{JointLimits, Trajectory};
use aspecta::robot::Robot;
use aspecta_view::words::count;
use std::io::Write;
use std::path::Path;

/// The limits given to `--speed` and `--acceleration`.
pub fn limits(robot: &Robot, speed: &str, acceleration: &str, degrees: bool) -> Result<JointLimits, Failure> {
    Ok(JointLimits {
        speed: limit(robot, "--speed", speed, degrees)?,
        acceleration: limit(robot, "--acceleration", acceleration, degrees)?,
    })
}

/// Returns one limit for each joint.
fn limit(robot: &Robot, option: &str, text: &str, degrees: bool) -> Result<Vec<f64>, Failure> {
    let joints = Columns::joints(robot);
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|x| x.trim().parse()).collect();
    let bad = |why: &str| {
        Failure::Input(format!(
            "{option}: `{text}` {why}; give one positive number, or {} separated by commas",
            robot.dof()
        ))
    };
    let mut numbers = numbers.map_err(|_| bad("is not a list of numbers"))?;
    if let [one] = numbers[..] {
        numbers = vec![one; robot.dof()];
    }
    if numbers.len() != robot.dof() {
        return Err(bad(&format!("has {} numbers", numbers.len())));
    }
    let turned = |(x, angle): (f64, &bool)| if *angle && degrees { x.to_radians() } else { x };
    Ok(numbers.into_iter().zip(&joints.angles).map(turned).collect())
}

/// Whether a motion at this rate has a number of rows that makes sense.
pub fn check_length(motion: &Trajectory, rate: f64) -> Result<(), Failure> {
    let seconds = motion.total_time();
    let many =
        || Failure::Input(format!("--rate: {rate} a second for {} s are too many rows", number(seconds)));
    motion.is_usable_rate(rate).then_some(()).ok_or_else(many)
}

/// Writes the CSV file given to `option`, which is there only when it is complete, and says so.
pub fn write(
    option: &str,
    path: &Path,
    robot: &Robot,
    motion: &Trajectory,
    rate: f64,
) -> Result<String, Failure> {
    let mut content = Vec::new();
    rows(&mut content, robot, motion, rate)?;
    let written = Target::new(option, path)?.write(content)?;
    let rows = count(motion.rows(rate).count(), "row", "rows");
    Ok(format!("{rows}, {rate} a second: {}", written.display()))
}

/// The motion as CSV, the working mode last.
pub fn rows(out: &mut dyn Write, robot: &Robot, motion: &Trajectory, rate: f64) -> Result<(), Failure> {
    let mut csv = csv::Writer::from_writer(out);
    let names = Columns::pose(robot).and(&Columns::joints(robot)).names;
    let rates = |letter: char| (1..=robot.dof()).map(move |j| format!("{letter}{j}"));
    csv.write_record(
        ["time".to_owned()]
            .into_iter()
            .chain(names)
            .chain(rates('v'))
            .chain(rates('a'))
            .chain(["mode".into()]),
    )?;
    for row in motion.rows(rate) {
        let numbers = [&row.time]
            .into_iter()
            .chain(&row.pose)
            .chain(&row.q)
            .chain(&row.velocity)
            .chain(&row.acceleration);
        // The posture of every leg there, numerical.
        let mode = robot.jacobians(&row.pose, &row.q)?.mode().to_string();
        csv.write_record(numbers.map(|x| exact(*x)).chain([mode]))?;
    }
    csv.flush()?;
    Ok(())
}
